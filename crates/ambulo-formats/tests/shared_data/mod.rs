//! Where recordings lie that are not part of the repository: `shared/data` next to it.

use std::path::{Path, PathBuf};

/// The folder; `None`, and said so, where there is none.
#[expect(clippy::print_stdout, reason = "a test that was skipped has to say so")]
pub(crate) fn data() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(std::env::var_os("CI").is_none(), "no recordings, and in CI no test may be skipped");
    println!("skipped: no data");
    None
}
