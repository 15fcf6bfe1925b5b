//! Draws the picture of the documents from the output of the `ambulo` command: `cargo xtask figures`.
//!
//! `ambulo demo` writes its report into `target/figures`, of which a headless Chromium takes a screenshot for
//! `docs/images`. It needs no recording.

use crate::workspace;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Names of the Chromium program, in the order in which they are tried.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// Time limit; Chromium needs about a second.
const TIMEOUT: Duration = Duration::from_secs(60);
/// Interval at which Chromium's end is checked.
const PAUSE: Duration = Duration::from_millis(20);
/// Window size for the report page [CSS pixels].
const PAGE: [u32; 2] = [1400, 1000];
/// Options: quiet, offline, no sandbox (containers forbid it), 3-D rendering in software, time to draw a page, two
/// pixels per CSS pixel.
const FLAGS: [&str; 10] = [
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--virtual-time-budget=6000",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--hide-scrollbars",
    "--force-device-scale-factor=2",
];

/// Draws the picture and prints its path.
#[expect(clippy::print_stdout, reason = "the written file is the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let browser = find_browser()?;
    let folder = workspace::root().join("target/figures");
    let program = workspace::build_program()?;
    let mut command = Command::new(&program);
    // The folder may have results of an earlier version.
    command.arg("demo").arg("-o").arg(&folder).arg("--force").stdout(Stdio::null());
    let status = command.status().map_err(|e| format!("{}: cannot start: {e}", program.display()))?;
    if !status.success() {
        return Err(format!("`ambulo demo` failed ({status}), see above"));
    }
    let images = workspace::root().join("docs/images");
    fs::create_dir_all(&images).map_err(|e| format!("{}: cannot create: {e}", images.display()))?;
    let png = images.join("report.png");
    draw(browser, &folder.join("report.html"), PAGE, &png)?;
    println!("written: {}", png.display());
    Ok(())
}

fn find_browser() -> Result<&'static str, String> {
    let starts = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    BROWSERS.into_iter().find(starts).ok_or_else(|| {
        format!("none of {} is installed\nhint: on Debian, `apt-get install chromium`", BROWSERS.join(", "))
    })
}

/// Takes a screenshot of a file in a browser window of this size, as PNG.
fn draw(browser: &str, file: &Path, [width, height]: [u32; 2], png: &Path) -> Result<(), String> {
    let address = file_address(file)?;
    // A separate profile: otherwise a running Chromium would take the request and draw nothing.
    let profile = std::env::temp_dir().join(format!("ambulo-figures-{}", std::process::id()));
    let written_before = modified(png);
    let mut command = Command::new(browser);
    command.args(FLAGS).arg(format!("--user-data-dir={}", profile.display()));
    command.arg(format!("--window-size={width},{height}"));
    command.arg(format!("--screenshot={}", png.display())).arg(address);
    let done = run_with_patience(command.stdout(Stdio::null()).stderr(Stdio::null()), browser);
    // A temporary profile that cannot be removed does no harm.
    let _ = fs::remove_dir_all(&profile);
    done?;
    let written = modified(png);
    if written.is_some() && written != written_before {
        return Ok(());
    }
    Err(format!("{browser} ended without writing {}", png.display()))
}

fn modified(path: &Path) -> Option<std::time::SystemTime> {
    fs::metadata(path).and_then(|m| m.modified()).ok()
}

fn run_with_patience(command: &mut Command, name: &str) -> Result<(), String> {
    let mut child = command.spawn().map_err(|e| format!("{name}: cannot start: {e}"))?;
    let start = Instant::now();
    loop {
        match child.try_wait().map_err(|e| format!("{name}: cannot wait for it: {e}"))? {
            Some(status) if status.success() => return Ok(()),
            Some(status) => return Err(format!("{name}: {status}")),
            None if start.elapsed() > TIMEOUT => {
                // It may have ended by itself in between; either way it is reported as hanging.
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("{name}: no picture within {} s, stopped", TIMEOUT.as_secs()));
            }
            None => sleep(PAUSE),
        }
    }
}

/// `file://` address of a file; every byte except plain letters and path signs is written as %XX.
fn file_address(path: &Path) -> Result<String, String> {
    let path: PathBuf = path.canonicalize().map_err(|e| format!("{}: {e}", path.display()))?;
    let mut address = "file://".to_owned();
    for byte in path.to_string_lossy().bytes() {
        match byte {
            b'/' | b'.' | b'-' | b'_' | b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' => address.push(char::from(byte)),
            _ => address.push_str(&format!("%{byte:02X}")),
        }
    }
    Ok(address)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_have_no_sign_that_a_browser_would_read_otherwise() {
        let path = std::env::temp_dir().join(format!("xtask figures #{}.svg", std::process::id()));
        fs::write(&path, "<svg/>").unwrap();
        let address = file_address(&path).unwrap();
        fs::remove_file(&path).unwrap();
        assert!(address.starts_with("file:///") && address.contains("xtask%20figures%20%23"), "{address}");
    }
}
