//! A lock on a file that two processes would both replace, such as a checkpoint.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};

use crate::output::{OutputError, remove};

/// The right to replace a file, held until it goes out of scope. The lock is a file beside the one
/// it protects, with `.lock` added to the name; it is removed at the end.
#[derive(Debug)]
pub struct Lock {
    /// Open as long as the lock is held: the system ends a lock with its process.
    _file: File,
    path: PathBuf,
}

impl Lock {
    /// Locks `path`, or says which process has it.
    ///
    /// # Errors
    /// [`OutputError`] where another process holds the lock, or the file of the lock cannot be made.
    #[allow(clippy::disallowed_methods, reason = "the lock has to be the file that was opened")]
    pub fn acquire(path: &Path) -> Result<Self, OutputError> {
        let refused = |cause: String| OutputError { path: path.to_owned(), cause };
        let failed = |error: std::io::Error| refused(format!("cannot be locked: {error}"));
        let mut name = path.as_os_str().to_owned();
        name.push(".lock");
        let lock = PathBuf::from(name);
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
                    let mut holder = String::new();
                    let _ = file.take(20).read_to_string(&mut holder);
                    let holder = holder.trim().parse::<u32>();
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
            let number = std::process::id();
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| writeln!(file, "{number}"))
                .map_err(failed)?;
            return Ok(Self { _file: file, path: lock });
        }
    }
}

/// Whether `path` still names the file that is open.
fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let (Ok(open), Ok(named)) = (file.metadata(), std::fs::symlink_metadata(path)) else {
            return false;
        };
        (open.dev(), open.ino()) == (named.dev(), named.ino())
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
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
    use crate::output::tests::Folder;

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
}
