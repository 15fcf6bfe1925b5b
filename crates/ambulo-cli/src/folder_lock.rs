//! One command at a time writes to a folder: a lock of the operating system, which ends with the process that took it.

use anyhow::{Context, Error, Result};
use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

const LOCK: &str = ".ambulo-lock";

/// The lock of a folder. Its file, and the folders that were made for it, are removed when it is dropped.
pub(crate) struct FolderLock {
    path: PathBuf,
    /// Folders that did not exist, the innermost first; removed again if they are empty.
    made: Vec<PathBuf>,
    _file: File,
}

impl FolderLock {
    /// Takes the lock of a folder, which is made if necessary; `None` if another process has it.
    pub(crate) fn take(folder: &Path) -> Result<Option<FolderLock>> {
        let made = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let made: Vec<PathBuf> = made.map(Path::to_owned).collect();
        let path = folder.join(LOCK);
        let failed =
            |error: std::io::Error| Error::new(error).context(format!("{}: cannot be written", path.display()));
        loop {
            fs::create_dir_all(folder)
                .with_context(|| format!("{}: this folder cannot be created", folder.display()))?;
            let file = match File::options().create(true).truncate(false).write(true).open(&path) {
                // A process that ended has removed the empty folder.
                Err(error) if error.kind() == ErrorKind::NotFound => continue,
                opened => opened.map_err(failed)?,
            };
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Ok(None),
                // A file system without locks: writing still is all or nothing.
                Err(TryLockError::Error(error)) if error.kind() != ErrorKind::Unsupported => return Err(failed(error)),
                _ if is_at(&file, &path) => return Ok(Some(FolderLock { path, made, _file: file })),
                // The process that had the lock has removed the file in the meantime.
                _ => {}
            }
        }
    }
}

/// Whether the file is still the one with this path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    file.metadata().ok().map(place) == fs::metadata(path).ok().map(place)
}

/// Elsewhere an open file keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // A file or an empty folder that remains does no harm.
        let _ = fs::remove_file(&self.path);
        for folder in &self.made {
            let _ = fs::remove_dir(folder);
        }
    }
}
