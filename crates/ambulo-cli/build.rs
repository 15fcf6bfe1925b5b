//! Puts the commit into `ambulo --version`, and links the program for a fixed address on Linux.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // A source archive without git has none.
    let commit = commit().map_or_else(String::new, |commit| format!(" ({commit})"));
    println!("cargo::rustc-env=AMBULO_VERSION={}{commit}", env!("CARGO_PKG_VERSION"));
    // Otherwise the system writes each of the 35,000 addresses in the program whenever it starts, which takes as long
    // as all the rest of a start.
    let target = ["CARGO_CFG_TARGET_OS", "CARGO_CFG_TARGET_ENV"].map(|name| env::var(name).unwrap_or_default());
    if target == ["linux", "gnu"] {
        println!("cargo::rustc-link-arg-bin=ambulo=-no-pie");
    }
}

/// The commit of this source tree, asked for again when it changes; `None` without git, or inside the repository of
/// something else.
fn commit() -> Option<String> {
    git(&["ls-files", "--error-unmatch", "build.rs"])?;
    for name in ["HEAD", "logs/HEAD"] {
        // In a second worktree they are not in `.git`. Cargo would run this program every time for a file that does not
        // exist.
        let file = git(&["rev-parse", "--git-path", name])?;
        if Path::new(&file).is_file() {
            println!("cargo::rerun-if-changed={file}");
        }
    }
    git(&["rev-parse", "--short=12", "HEAD"])
}

/// The output of git; `None` if git is missing, fails or prints nothing.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (!text.is_empty()).then_some(text)
}
