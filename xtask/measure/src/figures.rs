//! Draws the pictures of the documents from the output of the `ambulo` command: `cargo xtask figures`.
//!
//! `ambulo forces` (without recordings `ambulo demo`) writes SVG into `target/figures`; a headless Chromium renders the
//! figures that the documents use as PNG in `docs/images`.

use crate::workspace::{self, Walk};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Figures that the documents use, by name without ending.
const PICTURES: [&str; 1] = ["moments"];
/// Names of the Chromium program, in the order in which they are tried.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// CSS pixels per millimetre: 96 per inch.
const PIXELS_A_MILLIMETRE: f64 = 96.0 / 25.4;
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

/// Draws every picture and prints its path.
#[expect(clippy::print_stdout, reason = "the written files are the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let browser = find_browser()?;
    let folder = workspace::root().join("target/figures");
    let program = workspace::build_program()?;
    let mut command = match Walk::find() {
        Some(walk) => walk.command(&program, &folder),
        None => demo(&program, &folder),
    };
    // The folder may have results of an earlier version.
    command.arg("--force");
    // Exit code 1: the run ended with an infeasible verdict; its figures exist.
    let status =
        command.stdout(Stdio::null()).status().map_err(|e| format!("{}: cannot start: {e}", program.display()))?;
    if !matches!(status.code(), Some(0 | 1)) {
        return Err(format!("`ambulo` failed ({status}), see above"));
    }
    let images = workspace::root().join("docs/images");
    fs::create_dir_all(&images).map_err(|e| format!("{}: cannot create: {e}", images.display()))?;
    for name in PICTURES {
        let svg = folder.join("figures").join(name).with_extension("svg");
        let png = images.join(name).with_extension("png");
        draw_svg(browser, &svg, &png)?;
        println!("written: {}", png.display());
    }
    let png = images.join("report.png");
    draw(browser, &folder.join("report.html"), PAGE, &png)?;
    println!("written: {}", png.display());
    Ok(())
}

fn demo(program: &Path, folder: &Path) -> Command {
    let mut command = Command::new(program);
    command.arg("demo").arg("-o").arg(folder);
    command
}

fn find_browser() -> Result<&'static str, String> {
    let starts = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    BROWSERS.into_iter().find(starts).ok_or_else(|| {
        format!("none of {} is installed\nhint: on Debian, `apt-get install chromium`", BROWSERS.join(", "))
    })
}

/// Renders an SVG file as PNG.
fn draw_svg(browser: &str, svg: &Path, png: &Path) -> Result<(), String> {
    let at = svg.display();
    let text = fs::read_to_string(svg).map_err(|e| format!("{at}: cannot read: {e}"))?;
    draw(browser, svg, size(&text).map_err(|e| format!("{at}: {e}"))?, png)
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

/// Width and height of an SVG document in its units, rounded up.
fn size(svg: &str) -> Result<[u32; 2], String> {
    let begin = svg.find("<svg").ok_or("no <svg> element")?;
    let tag = svg[begin..].split('>').next().unwrap_or_default();
    Ok([length(tag, "width")?, length(tag, "height")?])
}

fn length(tag: &str, name: &str) -> Result<u32, String> {
    let after = tag.split_once(&format!(" {name}=\"")).ok_or_else(|| format!("<svg> has no {name}"))?.1;
    let value = after.split('"').next().unwrap_or_default();
    let (digits, pixels) = match value.strip_suffix("mm") {
        Some(digits) => (digits, PIXELS_A_MILLIMETRE),
        None => (value.trim_end_matches("px"), 1.0),
    };
    let number: f64 = digits.parse().map_err(|e| format!("<svg {name}=\"{value}\">: {e}"))?;
    let number = number * pixels;
    if !(number > 0.0 && number < 1e5) {
        return Err(format!("<svg {name}=\"{value}\">, expected a length above 0"));
    }
    Ok(number.ceil() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_is_that_of_the_svg_element_alone() {
        let svg = "<?xml version=\"1.0\"?>\n<svg width=\"990\" height=\"315.5px\" stroke-width=\"2\"><rect \
            width=\"5\"/></svg>";
        assert_eq!(size(svg), Ok([990, 316]));
        assert_eq!(size("<svg width=\"25.4mm\" height=\"50.8mm\">"), Ok([96, 192]));
        let message = size("<svg stroke-width=\"2\"><rect width=\"5\" height=\"5\"/></svg>").unwrap_err();
        assert_eq!(message, "<svg> has no width");
        assert!(size("<svg width=\"100%\" height=\"5\">").unwrap_err().starts_with("<svg width=\"100%\">"));
        assert!(size("<svg width=\"-1\" height=\"5\">").unwrap_err().ends_with("expected a length above 0"));
    }

    #[test]
    fn addresses_have_no_sign_that_a_browser_would_read_otherwise() {
        let path = std::env::temp_dir().join(format!("xtask figures #{}.svg", std::process::id()));
        fs::write(&path, "<svg/>").unwrap();
        let address = file_address(&path).unwrap();
        fs::remove_file(&path).unwrap();
        assert!(address.starts_with("file:///") && address.contains("xtask%20figures%20%23"), "{address}");
    }
}
