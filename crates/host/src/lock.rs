//! A lock on a file that two processes would both replace, such as a checkpoint.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use crate::error::{FileError, refused};
use crate::identity::{number, place};
use crate::output::{create_folder, remove};
use crate::text::printable_path;

/// The right to replace a file, held until it goes out of scope. The lock is a file beside the one
/// it protects, with `.lock` added to the name; it is removed at the end. Two links to one file have
/// one lock.
#[derive(Debug)]
pub struct Lock {
    /// Open as long as the lock is held: the system ends a lock with its process.
    _file: File,
    path: PathBuf,
}

impl Lock {
    #[must_use]
    pub fn file_of(path: &Path) -> PathBuf {
        let mut name = place(path).into_os_string();
        name.push(".lock");
        PathBuf::from(name)
    }

    /// Locks `path`, or says which process has it. The folder of `path` is made where it is missing.
    ///
    /// # Errors
    /// [`FileError`] where another process holds the lock, where the file of the lock cannot be
    /// made, or where a file that is not a lock has its name.
    #[allow(clippy::disallowed_methods, reason = "the lock has to be the file that was opened")]
    pub fn acquire(path: &Path) -> Result<Self, FileError> {
        let refused = |cause: String| refused(path, cause);
        let failed = |error: std::io::Error| refused(format!("cannot be locked: {error}"));
        let lock = Self::file_of(path);
        create_folder(&lock)?;
        loop {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            #[cfg(unix)]
            {
                use std::os::unix::fs::OpenOptionsExt as _;
                let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOFOLLOW;
                options.custom_flags(flags.bits() as i32);
            }
            let mut file = options.open(&lock).map_err(failed)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    // A process that has just locked the file writes its number next.
                    let holder = holder(&mut file).flatten();
                    let holder = holder.map_or(String::new(), |number| format!(" {number}"));
                    return Err(refused(format!(
                        "is in use by another process{holder}; wait for its end, or name another file"
                    )));
                }
                Err(TryLockError::Error(error)) => return Err(failed(error)),
            }
            // The last holder may have removed the file between our opening and our locking it.
            if !is_at(&file, &lock) {
                continue;
            }
            // Another program may use this name for a file with content, such as Cargo.lock.
            if holder(&mut file).is_none() {
                let lock = printable_path(&lock);
                return Err(refused(format!(
                    "cannot be locked: {lock} exists and is not a lock; name another file"
                )));
            }
            let number = std::process::id();
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| writeln!(file, "{number}"))
                .map_err(failed)?;
            return Ok(Self { _file: file, path: lock });
        }
    }
}

/// The process whose number is in the file of a lock, or none where the file is empty. Nothing where
/// the file holds anything else.
fn holder(file: &mut File) -> Option<Option<u32>> {
    let mut text = String::new();
    file.take(20).read_to_string(&mut text).ok()?;
    if text.is_empty() {
        return Some(None);
    }
    text.strip_suffix('\n')?.parse().ok().map(Some)
}

/// Whether a path names an open file. Where files have no numbers, it is enough that it names one.
fn is_at(file: &File, path: &Path) -> bool {
    match (file.metadata(), std::fs::symlink_metadata(path)) {
        (Ok(open), Ok(named)) => number(&open) == number(&named),
        _ => false,
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = remove(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Folder;

    #[test]
    fn the_second_one_is_refused_until_the_first_has_ended() {
        let folder = Folder::new("lock");
        let file = folder.path("c.json");
        let first = Lock::acquire(&file).unwrap();
        let error = Lock::acquire(&file).unwrap_err();
        assert!(error.cause.starts_with("is in use by another process "), "{error}");
        assert!(error.cause.contains(&std::process::id().to_string()), "{error}");
        drop(first);
        assert!(!folder.path("c.json.lock").exists());
        Lock::acquire(&file).unwrap();
    }

    #[test]
    fn the_folder_is_made_and_links_share_a_lock() {
        let folder = Folder::new("lock-folder");
        let file = folder.path("a/b/c.json");
        let lock = Lock::acquire(&file).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a", folder.path("link")).unwrap();
            let error = Lock::acquire(&folder.path("link/b/c.json")).unwrap_err();
            assert!(error.cause.starts_with("is in use by another process "), "{error}");
        }
        drop(lock);
    }

    /// What a killed process leaves is taken over; a file of another program is left alone.
    #[test]
    #[allow(clippy::disallowed_methods, reason = "the test makes the files in question")]
    fn a_file_that_is_not_a_lock_is_left_alone() {
        let folder = Folder::new("lock-other");
        std::fs::write(folder.path("Cargo.lock"), "version = 4\n").unwrap();
        let error = Lock::acquire(&folder.path("Cargo")).unwrap_err();
        assert!(error.cause.contains("is not a lock"), "{error}");
        assert_eq!(std::fs::read(folder.path("Cargo.lock")).unwrap(), b"version = 4\n");
        std::fs::write(folder.path("c.json.lock"), "77\n").unwrap();
        Lock::acquire(&folder.path("c.json")).unwrap();
    }
}
