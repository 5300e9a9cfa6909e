//! Writing files: whole or not at all.
//!
//! A regular file is written under a random name in the same folder and then renamed, so that no
//! reader sees half of it and a failed write leaves the old file as it was. A link is followed: the
//! file that it names is replaced, and the link stays. A pipe or a device is written to where it
//! is, and never replaced.

use std::fs::{File, OpenOptions};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::{FileError, refused};
use crate::limits::STALLED_WRITE_SECONDS;
use crate::text::printable_path;

/// Writes `bytes` to `path`, and makes the folder of `path` where it is missing.
///
/// The mode and, where that is permitted, the owner of a file that is replaced are kept. Where the file cannot be
/// written, the one that was there before is unchanged.
///
/// # Errors
/// [`FileError`] where the file cannot be written; a link that leads nowhere is refused.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |error: io::Error| refused(path, format!("cannot be written: {error}"));
    match std::fs::metadata(path) {
        Ok(data) if data.is_file() => {
            let target = std::fs::canonicalize(path).map_err(failed)?;
            replace(&target, bytes, Some(&data)).map_err(failed)
        }
        Ok(data) if data.is_dir() => Err(refused(path, "is a directory, not a file")),
        Ok(_) => write_in_place(path, bytes).map_err(failed),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if let Ok(target) = std::fs::read_link(path) {
                let target = printable_path(&target);
                return Err(refused(path, format!("is a link to {target}, which does not exist")));
            }
            create_folder(path)?;
            replace(path, bytes, None).map_err(failed)
        }
        Err(error) => Err(failed(error)),
    }
}

/// Makes the folder of a file where it is missing.
pub(crate) fn create_folder(path: &Path) -> Result<(), FileError> {
    let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) else {
        return Ok(());
    };
    #[allow(clippy::disallowed_methods, reason = "this is the one function that makes folders")]
    std::fs::create_dir_all(folder)
        .map_err(|error| refused(path, format!("its folder cannot be made: {error}")))
}

/// Removes a file that this program wrote. It is not an error if nothing has this name.
///
/// # Errors
/// [`FileError`] where the file is there and cannot be removed.
#[allow(clippy::disallowed_methods, reason = "this is the one function that removes a file")]
pub fn remove(path: &Path) -> Result<(), FileError> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(refused(path, format!("cannot be removed: {error}")))
        }
        _ => Ok(()),
    }
}

/// A file that is removed when it goes out of scope, unless it was renamed before.
struct Temporary(Option<PathBuf>);

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let _ = remove(&path);
        }
    }
}

#[allow(clippy::disallowed_methods, reason = "this is the one function that writes a file")]
fn replace(target: &Path, bytes: &[u8], old: Option<&std::fs::Metadata>) -> io::Result<()> {
    let (mut file, path) = create_beside(target)?;
    let mut temporary = Temporary(Some(path.clone()));
    if let Some(old) = old {
        keep_owner(&file, old);
        file.set_permissions(old.permissions())?;
    }
    file.write_all(bytes)?;
    drop(file);
    std::fs::rename(&path, target)?;
    temporary.0 = None;
    Ok(())
}

/// A user other than root cannot give a file away; then the new file belongs to who wrote it.
fn keep_owner(file: &File, old: &std::fs::Metadata) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let _ = std::os::unix::fs::fchown(file, Some(old.uid()), Some(old.gid()));
    }
    #[cfg(not(unix))]
    let _ = (file, old);
}

/// A new file in the folder of `target`. `create_new` refuses whatever has its name already, links
/// included, so that nothing of other people is written over.
#[allow(clippy::disallowed_methods, reason = "this is the one function that creates a file")]
fn create_beside(target: &Path) -> io::Result<(File, PathBuf)> {
    let folder = target.parent().unwrap_or(Path::new(""));
    loop {
        let path = folder.join(format!(".rasterproof-{:016x}.part", random()));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((file, path)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// A number that nobody can foresee: the standard library seeds its hash maps from the system.
fn random() -> u64 {
    RandomState::new().build_hasher().finish()
}

/// Writes to a pipe or a device, which may take its time but not for ever.
#[allow(clippy::disallowed_methods, reason = "this is the one function that writes to a device")]
fn write_in_place(path: &Path, mut bytes: &[u8]) -> io::Result<()> {
    let mut options = OpenOptions::new();
    options.write(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.custom_flags(rustix::fs::OFlags::NONBLOCK.bits() as i32);
    }
    let patience = Duration::from_secs(STALLED_WRITE_SECONDS);
    let mut since = Instant::now();
    let stalled = |since: Instant| since.elapsed() > patience;
    let mut file = loop {
        match options.open(path) {
            Ok(file) => break file,
            // A pipe that nobody reads yet.
            Err(error) if is_unread_pipe(&error) && !stalled(since) => nap(),
            Err(error) if is_unread_pipe(&error) => return Err(nobody_reads()),
            Err(error) => return Err(error),
        }
    };
    since = Instant::now();
    while !bytes.is_empty() {
        match file.write(bytes) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(written) => {
                bytes = &bytes[written..];
                since = Instant::now();
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if error.kind() == io::ErrorKind::WouldBlock && !stalled(since) => nap(),
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Err(nobody_reads()),
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

fn nap() {
    std::thread::sleep(Duration::from_millis(5));
}

fn nobody_reads() -> io::Error {
    io::Error::other(format!("nothing has read from it for {STALLED_WRITE_SECONDS} s"))
}

/// What opening a pipe for writing says while no program has it open for reading.
fn is_unread_pipe(error: &io::Error) -> bool {
    #[cfg(unix)]
    return error.raw_os_error() == Some(rustix::io::Errno::NXIO.raw_os_error());
    #[cfg(not(unix))]
    {
        let _ = error;
        false
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the tests make and read the files in question")]
pub(crate) mod tests {
    use std::fs;

    use super::*;

    /// An empty folder below the system's folder for such files, removed with what is in it.
    pub(crate) struct Folder(pub(crate) PathBuf);

    impl Folder {
        pub(crate) fn new(name: &str) -> Self {
            let folder = std::env::temp_dir().join(format!("rasterproof-{name}-{:016x}", random()));
            fs::create_dir(&folder).unwrap();
            Self(folder)
        }

        pub(crate) fn path(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).unwrap();
            let mut names: Vec<_> =
                entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[cfg(unix)]
    pub(crate) fn make_pipe(path: &Path) {
        let status = std::process::Command::new("mkfifo").arg(path).status().unwrap();
        assert!(status.success());
    }

    #[test]
    fn a_file_is_written_with_its_folder_and_nothing_else() {
        let folder = Folder::new("write");
        let file = folder.path("a/b/c.txt");
        write(&file, b"one").unwrap();
        write(&file, b"two").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"two");
        assert_eq!(fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
        assert_eq!(write(&folder.0, b"").unwrap_err().cause, "is a directory, not a file");
        remove(&file).unwrap();
        remove(&file).unwrap();
        assert!(!file.exists());
    }

    #[test]
    fn what_has_the_name_of_a_part_is_left_alone() {
        let folder = Folder::new("part");
        fs::write(folder.path("x.png.part"), "mine").unwrap();
        write(&folder.path("x.png"), b"picture").unwrap();
        assert_eq!(fs::read(folder.path("x.png.part")).unwrap(), b"mine");
        assert_eq!(folder.names(), ["x.png", "x.png.part"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_modes_are_kept() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = Folder::new("links");
        let (file, link) = (folder.path("file"), folder.path("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        symlink("file", &link).unwrap();
        write(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
        symlink("nothing", folder.path("lost")).unwrap();
        let error = write(&folder.path("lost"), b"new").unwrap_err();
        assert_eq!(error.cause, "is a link to nothing, which does not exist");
    }

    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_written_to() {
        use std::os::unix::fs::FileTypeExt as _;
        let folder = Folder::new("pipes");
        let pipe = folder.path("pipe");
        make_pipe(&pipe);
        let reader = {
            let pipe = pipe.clone();
            std::thread::spawn(move || fs::read(pipe).unwrap())
        };
        // More than a pipe holds.
        let bytes = vec![7; 300_000];
        write(&pipe, &bytes).unwrap();
        assert!(reader.join().unwrap() == bytes);
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
        // By links: a fault here must not replace the machine's devices.
        let (null, full) = (folder.path("null"), folder.path("full"));
        std::os::unix::fs::symlink("/dev/null", &null).unwrap();
        std::os::unix::fs::symlink("/dev/full", &full).unwrap();
        write(&null, b"gone").unwrap();
        assert!(write(&full, b"lost").unwrap_err().cause.contains("No space"));
        assert!(fs::symlink_metadata(&null).unwrap().is_symlink());
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_not_utf8_is_that_name() {
        use std::os::unix::ffi::OsStrExt as _;
        let folder = Folder::new("names");
        let file = folder.0.join(std::ffi::OsStr::from_bytes(b"a\xffb"));
        write(&file, b"x").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }
}
