//! The workspace: its folder, its cargo, the files of another revision.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn root() -> PathBuf {
    let above = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    above.map(Path::to_path_buf).unwrap_or_default()
}

/// The folder that holds `data` and `reference`.
pub(crate) fn data() -> PathBuf {
    std::env::var_os("AMBULO_DATA").map_or_else(|| root().join("../shared"), PathBuf::from)
}

/// The same cargo that runs this program, in the workspace root.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// The profile of benchmarks, with its folder of the same name: all of the science is optimised.
pub(crate) const OPTIMISED: &str = "measure";

/// The folder that cargo builds into: this program is in `<target>/<profile>`.
pub(crate) fn target() -> PathBuf {
    let here = std::env::current_exe().unwrap_or_default();
    here.parent().and_then(Path::parent).map_or_else(|| root().join("target"), Path::to_path_buf)
}

/// The `ambulo` command that `cargo build` and `cargo test` have compiled.
pub(crate) fn debug_program() -> PathBuf {
    target().join("debug").join(format!("ambulo{}", std::env::consts::EXE_SUFFIX))
}

/// Unpacks a revision (a commit, a tag or a branch) into a folder. Its files are as old as the unpacking, so that cargo
/// compiles them.
pub(crate) fn unpack(name: &str, folder: &Path) -> Result<(), String> {
    let mut archive = Command::new("git");
    archive.current_dir(root()).args(["archive", "--format=tar", name]).stdout(Stdio::piped());
    let mut archive = archive.spawn().map_err(|e| format!("git: cannot start: {e}"))?;
    let mut tar = Command::new("tar");
    tar.args(["-x", "-m", "-C"]).arg(folder).stdin(archive.stdout.take().map_or_else(Stdio::null, Stdio::from));
    let unpacked = tar.status().map_err(|e| format!("tar: cannot start: {e}"))?;
    let read = archive.wait().map_err(|e| format!("git: {e}"))?;
    if read.success() && unpacked.success() {
        return Ok(());
    }
    Err(format!("the revision `{name}` could not be unpacked, see above\nhint: `git log` lists revisions"))
}

/// Files of one revision in a temporary folder, removed when dropped.
pub(crate) struct Revision {
    folder: PathBuf,
}

impl Revision {
    /// Unpacks a revision: a commit, a tag or a branch.
    pub(crate) fn unpack(name: &str) -> Result<Revision, String> {
        let revision =
            Revision { folder: std::env::temp_dir().join(format!("ambulo-revision-{}", std::process::id())) };
        std::fs::create_dir_all(&revision.folder)
            .map_err(|e| format!("{}: cannot create: {e}", revision.folder.display()))?;
        unpack(name, &revision.folder)?;
        Ok(revision)
    }

    /// The folder of the revision's `Cargo.toml`.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }
}

impl Drop for Revision {
    fn drop(&mut self) {
        // A temporary folder that cannot be removed does no harm.
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}
