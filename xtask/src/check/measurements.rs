//! Whether the crate of measurements is linted and tested.
//!
//! `xtask/measure` has as much code as a crate of the product, and no user runs it. A check lints and tests it unless
//! one of these holds:
//!
//! - the same files have passed in this target folder: a hash of them is kept there;
//! - this is a branch, and no file differs from the commit at which it left `origin/main`, where CI has checked it.
//!
//! Otherwise it is only compiled, so that a changed signature of the library is noticed. `--full` lints and tests it
//! always.

use super::steps::PROFILE;
use crate::workspace;
use std::collections::BTreeSet;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::process::Command;

/// Name of the crate.
pub(super) const PACKAGE: &str = "xtask-measure";
/// The step that compiles it when it is not linted and tested.
pub(super) const STEP: &str = "measurements compile";

/// Files and folders that decide about its lints and tests, apart from the library.
const INPUTS: [&str; 6] = ["xtask", "Cargo.toml", "Cargo.lock", "clippy.toml", "rustfmt.toml", "docs/measured"];
/// The branch that CI checks.
const MAIN: &str = "origin/main";

/// What a check does with the crate, and why.
pub(super) struct Decision {
    pub(super) measured: bool,
    pub(super) reason: String,
    hash: Option<u64>,
}

impl Decision {
    pub(super) fn new(full: bool) -> Decision {
        let hash = hash();
        let passed = fs::read_to_string(stamp()).ok().and_then(|text| text.trim().parse().ok());
        let decision = |measured: bool, reason: String| Decision { measured, reason, hash };
        if full {
            return decision(true, "--full".to_owned());
        }
        if hash.is_some() && hash == passed {
            return decision(false, "the same files have passed here".to_owned());
        }
        match unchanged_since() {
            Some(commit) => decision(false, format!("no file differs from {commit} of {MAIN}")),
            None => {
                decision(true, "its files have changed, or it is not known since when they are the same".to_owned())
            }
        }
    }

    /// Keeps the hash after a check that has passed.
    pub(super) fn keep(&self) {
        if let (true, Some(hash)) = (self.measured, self.hash) {
            // Without the stamp the next check does more.
            let _ = fs::write(stamp(), format!("{hash}\n"));
        }
    }
}

fn stamp() -> PathBuf {
    workspace::target().join(PROFILE).join("measurements")
}

/// Hash of names and contents of all inputs; none without git.
fn hash() -> Option<u64> {
    let files = git(&[&["ls-files", "--cached", "--others", "--exclude-standard", "--"][..], &INPUTS].concat())?;
    let names: BTreeSet<&str> = files.lines().collect();
    let mut hasher = DefaultHasher::new();
    for name in names {
        (name, fs::read(workspace::root().join(name)).ok()).hash(&mut hasher);
    }
    Some(hasher.finish())
}

/// The commit at which this branch left `origin/main`, if the inputs are still those of that commit.
fn unchanged_since() -> Option<String> {
    let base = git(&["merge-base", MAIN, "HEAD"])?;
    let base = base.trim();
    if base == git(&["rev-parse", "HEAD"])?.trim() {
        return None;
    }
    let changed = git(&[&["diff", "--name-only", base, "--"][..], &INPUTS].concat())?;
    let added = git(&[&["ls-files", "--others", "--exclude-standard", "--"][..], &INPUTS].concat())?;
    (changed.is_empty() && added.is_empty()).then(|| base.chars().take(12).collect())
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").current_dir(workspace::root()).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_input_exists() {
        let missing = INPUTS.iter().find(|name| !workspace::root().join(name).exists());
        assert_eq!(missing, None);
    }
}
