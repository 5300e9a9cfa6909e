//! Writing files: whole or not at all, and over no file that the user would miss.
//!
//! A regular file is written under a random name in the same folder and then renamed, so that no
//! reader sees half of it and a failed write leaves the old file as it was. A link is followed: the
//! file that it names is replaced, and the link stays. A pipe or a device is written to where it
//! is, and never replaced.
//!
//! The file with the random name is locked while it is written. One that is not locked belongs to a process
//! that was killed, and the next write in its folder removes it.

use std::ffi::OsStr;
use std::fs::{File, OpenOptions, TryLockError};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::{self, Read as _, Seek as _, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::{FileError, refused};
use crate::identity::{self, Identity, number, place};
use crate::input::{self, without_waiting};
use crate::limits::STALLED_WRITE_SECONDS;
use crate::mark;
use crate::text::printable_path;

/// Which existing files a write may replace; any other is kept, and the write ends with an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Any that the command has not read: the user has typed its name.
    Any,
    /// Of these only one that this program made, by its mark: the program has chosen the name.
    Marked,
    /// Also one that the command has read, in order to write it anew.
    Updated,
    /// None: what is written is edited by hand, and then it is the user's.
    None,
}

/// A file that a command writes, and which file it may replace.
#[derive(Clone, Debug)]
pub struct Output {
    pub path: PathBuf,
    pub over: Over,
}

impl Output {
    /// A file whose name was typed, which replaces any that is not read.
    #[must_use]
    pub fn typed(path: &Path) -> Self {
        Self { path: path.to_owned(), over: Over::Any }
    }

    /// It as a file of a command line.
    #[must_use]
    pub fn named<'a>(&'a self, option: &'a str) -> Named<'a> {
        (option, &self.path, Use::Writes(self.over))
    }
}

/// What a command does with a file that it was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    Reads,
    Writes(Over),
}

/// A file of a command line: the option that names it, its path, and what the command does with it.
pub type Named<'a> = (&'a str, &'a Path, Use);

/// What standard output is, as a file; a system without it has no file of this name.
pub const STANDARD_OUTPUT: &str = "/dev/stdout";

/// Refuses a command that would write over a file which it also reads or writes by another option, by
/// whatever names; or over one that it has read already, such as a texture of a model; or, where the
/// program chose the name, over a file that it did not make.
///
/// # Errors
/// In words, with the option.
pub fn check_all<'a>(files: impl IntoIterator<Item = Named<'a>>) -> Result<(), String> {
    // Where standard output is a file, it is one more that is written.
    let standard_output = ("standard output", Path::new(STANDARD_OUTPUT), Use::Writes(Over::Any));
    let all = files.into_iter().chain(cfg!(unix).then_some(standard_output));
    let mut before: Vec<(Named<'_>, Identity)> = Vec::new();
    for named @ (option, path, of) in all {
        let Some(identity) = Identity::of(path) else { continue };
        for ((other, its_path, its_use), its_identity) in &before {
            let are_read = of == Use::Reads && *its_use == Use::Reads;
            if are_read || !identity.is(its_identity) {
                continue;
            }
            // What is written is named first.
            let [(first, path), (second, _)] = match its_use {
                Use::Reads => [(option, path), (*other, *its_path)],
                Use::Writes(_) => [(*other, *its_path), (option, path)],
            };
            let path = printable_path(path);
            return Err(format!(
                "{path}: {first} and {second} name this file; give each a file of its own"
            ));
        }
        before.push((named, identity));
    }
    for ((option, path, of), _) in before {
        if let Use::Writes(over) = of {
            check(path, over).map_err(|error| format!("{option}: {error}"))?;
        }
    }
    Ok(())
}

/// Refuses a file that may not be replaced.
///
/// # Errors
/// [`FileError`] where there is such a file.
pub fn check(path: &Path, over: Over) -> Result<(), FileError> {
    if over != Over::Updated && identity::was_read(path) {
        return Err(refused(path, "is read by this command; give the output another name"));
    }
    // What is written to a pipe or a device replaces nothing.
    let is_file = || std::fs::metadata(path).is_ok_and(|data| data.is_file());
    if over == Over::None && is_file() {
        return Err(refused(
            path,
            "exists, and may be edited by hand: give another name, or remove it",
        ));
    }
    if over == Over::Marked && is_file() && !mark::is_marked(&input::head(path, mark::HEAD_BYTES)) {
        return Err(refused(
            path,
            "exists, and rasterproof did not make it: name another folder, move the file, or replace it with --force",
        ));
    }
    Ok(())
}

/// Writes `bytes` to `path` with the mark of this program, and makes the folder of `path` where it is missing.
///
/// The mode and, where that is permitted, the owner of a file that is replaced are kept. Where the file cannot be
/// written, the one that was there before is unchanged.
///
/// # Errors
/// [`FileError`] where the file cannot be written, or may not be replaced; a link that leads nowhere is refused.
pub fn write(path: &Path, bytes: &[u8], over: Over) -> Result<(), FileError> {
    let bytes = &*mark::marked(bytes);
    let is_missing = |error: io::Error| error.kind() == io::ErrorKind::NotFound;
    if std::fs::symlink_metadata(path).is_err_and(is_missing) {
        create_folder(path)?;
    }
    // After that, since `new/../file` names a file only where there is a folder `new`.
    check(path, over)?;
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
            replace(path, bytes, None).map_err(failed)
        }
        Err(error) => Err(failed(error)),
    }
}

/// Makes the folder of a file where it is missing.
fn create_folder(path: &Path) -> Result<(), FileError> {
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

/// A file of this program beside another one. It is locked as long as it is open, since the system ends a lock with its
/// process, and removed when this goes out of scope.
#[derive(Debug)]
struct Own {
    file: File,
    path: PathBuf,
}

impl Drop for Own {
    fn drop(&mut self) {
        let _ = remove(&self.path);
    }
}

#[allow(clippy::disallowed_methods, reason = "this is the one function that writes a file")]
fn replace(target: &Path, bytes: &[u8], old: Option<&std::fs::Metadata>) -> io::Result<()> {
    remove_left_parts(folder_of(target));
    let mut tries = 0;
    loop {
        let mut part = part_beside(target)?;
        if let Some(old) = old {
            keep_owner(&part.file, old);
            part.file.set_permissions(old.permissions())?;
        }
        part.file.write_all(bytes)?;
        tries += 1;
        match std::fs::rename(&part.path, target) {
            // Another machine does not see the lock in every shared folder, and has taken the part for a left one.
            Err(error) if error.kind() == io::ErrorKind::NotFound && tries < 3 => {}
            result => return result,
        }
    }
}

fn folder_of(target: &Path) -> &Path {
    let folder = target.parent().unwrap_or(Path::new(""));
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

fn is_part_name(name: &OsStr) -> bool {
    let name = name.to_str().unwrap_or_default();
    let number = name.strip_prefix(".rasterproof-").and_then(|name| name.strip_suffix(".part"));
    let is_digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
    number.is_some_and(|number| number.len() == 16 && number.bytes().all(is_digit))
}

/// Removes the parts in a folder that no process writes. What cannot be looked at is left.
#[allow(clippy::disallowed_methods, reason = "the lock has to be that of the file")]
fn remove_left_parts(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let is_part =
            is_part_name(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_file());
        if !is_part {
            continue;
        }
        // Removed while it is locked: who has just made the file waits for the lock, and then sees that it is gone.
        if let Ok(file) = OpenOptions::new().write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = remove(&entry.path());
        }
    }
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

/// A new file under a random name in the folder of `target`, locked where the file system has locks, until it has its name.
/// `create_new` refuses whatever has its name already, links included, so that nothing of other people is written over.
#[allow(clippy::disallowed_methods, reason = "this is the one function that creates a file")]
fn part_beside(target: &Path) -> io::Result<Own> {
    loop {
        // A number that cannot be foreseen: the standard library seeds its hash maps from the system.
        let number = RandomState::new().build_hasher().finish();
        let path = folder_of(target).join(format!(".rasterproof-{number:016x}.part"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            // Another process may have removed it before it was locked.
            Ok(file) if file.lock().is_ok() && !path.exists() => {}
            Ok(file) => return Ok(Own { file, path }),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// Writes to a pipe or a device, which may take its time but not for ever.
#[allow(clippy::disallowed_methods, reason = "this is the one function that writes to a device")]
fn write_in_place(path: &Path, mut bytes: &[u8]) -> io::Result<()> {
    let mut options = OpenOptions::new();
    without_waiting(options.write(true));
    let mut file = patiently(|| options.open(path))?;
    while !bytes.is_empty() {
        match patiently(|| file.write(bytes))? {
            0 => return Err(io::ErrorKind::WriteZero.into()),
            written => bytes = &bytes[written..],
        }
    }
    Ok(())
}

/// Tries something again while no program reads from a pipe, but not for ever.
fn patiently<T>(mut attempt: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    let since = Instant::now();
    loop {
        match attempt() {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if is_unread_pipe(&error) || error.kind() == io::ErrorKind::WouldBlock => {
                if since.elapsed() > Duration::from_secs(STALLED_WRITE_SECONDS) {
                    return Err(io::Error::other(format!(
                        "nothing has read from it for {STALLED_WRITE_SECONDS} s"
                    )));
                }
                std::thread::sleep(Duration::from_millis(5));
            }
            result => return result,
        }
    }
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

/// The right to replace a file, held until it goes out of scope: a file beside the one that it protects, with `.lock` added to the
/// name. Two links to one file have one lock.
#[derive(Debug)]
pub struct Lock {
    _file: Own,
}

impl Lock {
    /// Where the lock of a file is: an output of the command may not have this name.
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
            // Whether the file is there or not, it is opened, and whoever locks it first has the lock.
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            // A link could name a file of somebody else, and a pipe would be waited for.
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
                    // None where a process has just locked the file, and writes its number next.
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
            // The lock is ours; who is refused reads here by whom.
            let number = std::process::id();
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| writeln!(file, "{number}"))
                .map_err(failed)?;
            return Ok(Self { _file: Own { file, path: lock } });
        }
    }
}

/// The process whose number is in the file of a lock: `Some(None)` of an empty file, whose holder has not written its number yet,
/// and `None` of a file with any other text, which is not a lock of this program.
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

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the tests make and read the files in question")]
mod tests {
    use std::fs;

    use super::*;
    use crate::testing::Folder;
    #[cfg(unix)]
    use crate::testing::make_pipe;

    #[test]
    fn a_file_is_written_with_its_folder_and_nothing_else() {
        let folder = Folder::new("write");
        let file = folder.path("a/b/c.txt");
        write(&file, b"one", Over::Any).unwrap();
        write(&file, b"two", Over::Any).unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"two");
        assert_eq!(fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
        assert_eq!(
            write(&folder.0, b"", Over::Any).unwrap_err().cause,
            "is a directory, not a file"
        );
        remove(&file).unwrap();
        remove(&file).unwrap();
        assert!(!file.exists());
    }

    #[test]
    fn only_parts_that_nobody_writes_are_removed() {
        let folder = Folder::new("parts");
        let kept = [
            ".rasterproof-0123456789abcdef.part",
            ".rasterproof-0123456789abcdeg.part",
            ".rasterproof-0123456789ABCDEF.part",
            ".rasterproof-0123.part",
            "rasterproof-0123456789abcdef.part",
        ];
        for name in kept {
            fs::write(folder.path(name), "x").unwrap();
        }
        fs::create_dir(folder.path(".rasterproof-00000000000000aa.part")).unwrap();
        fs::write(folder.path(".rasterproof-00000000000000bb.part"), "left").unwrap();
        let written = File::open(folder.path(kept[0])).unwrap();
        written.lock().unwrap();
        write(&folder.path("a.txt"), b"a", Over::Any).unwrap();
        let names = folder.names();
        assert!(kept.iter().all(|name| names.iter().any(|n| n == name)), "{names:?}");
        assert_eq!(names.len(), kept.len() + 2, "{names:?}");
        // Its process has ended.
        drop(written);
        write(&folder.path("a.txt"), b"b", Over::Any).unwrap();
        assert!(!folder.path(kept[0]).exists() && folder.path(kept[1]).exists());
    }

    /// Threads that write one file do not take each other's parts for left ones.
    #[test]
    fn many_may_write_in_one_folder() {
        let folder = Folder::new("many-writers");
        std::thread::scope(|scope| {
            for thread in 0..4u8 {
                let folder = &folder;
                scope.spawn(move || {
                    for _ in 0..100 {
                        write(&folder.path("one.txt"), &[thread; 9], Over::Any).unwrap();
                    }
                });
            }
        });
        assert_eq!(folder.names(), ["one.txt"]);
        let bytes = fs::read(folder.path("one.txt")).unwrap();
        assert!(bytes.len() == 9 && bytes.iter().all(|byte| *byte == bytes[0]), "{bytes:?}");
    }

    #[test]
    fn only_some_files_are_replaced() {
        let folder = Folder::new("over");
        let page = folder.path("a.html");
        fs::write(&page, "<!DOCTYPE html>\n<html></html>").unwrap();
        let error = write(&page, b"<!DOCTYPE html>\nb", Over::Marked).unwrap_err();
        assert!(error.cause.contains("did not make it") && error.cause.contains("--force"));
        assert_eq!(fs::read(&page).unwrap(), b"<!DOCTYPE html>\n<html></html>");
        write(&page, b"<!DOCTYPE html>\nb", Over::Any).unwrap();
        write(&page, b"<!DOCTYPE html>\nc", Over::Marked).unwrap();
        assert!(fs::read(&page).unwrap().ends_with(b"rasterproof -->\nc"));
        crate::input::read(&page, 99).unwrap();
        let kept = folder.path("a.py");
        write(&kept, b"mine", Over::None).unwrap();
        let error = write(&kept, b"new", Over::None).unwrap_err();
        assert!(error.cause.starts_with("exists, and may be edited"), "{error}");
        assert_eq!(fs::read(&kept).unwrap(), b"mine");
        for over in [Over::Any, Over::Marked] {
            let error = write(&page, b"d", over).unwrap_err();
            assert_eq!(error.cause, "is read by this command; give the output another name");
        }
        write(&page, b"d", Over::Updated).unwrap();
        assert_eq!(fs::read(&page).unwrap(), b"d");
    }

    #[test]
    fn what_has_the_name_of_a_part_is_left_alone() {
        let folder = Folder::new("part");
        fs::write(folder.path("x.png.part"), "mine").unwrap();
        write(&folder.path("x.png"), b"picture", Over::Any).unwrap();
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
        write(&link, b"new", Over::Any).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
        symlink("nothing", folder.path("lost")).unwrap();
        let error = write(&folder.path("lost"), b"new", Over::Any).unwrap_err();
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
        write(&pipe, &bytes, Over::Any).unwrap();
        assert!(reader.join().unwrap() == bytes);
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
        // By links: a fault here must not replace the machine's devices.
        let (null, full) = (folder.path("null"), folder.path("full"));
        std::os::unix::fs::symlink("/dev/null", &null).unwrap();
        std::os::unix::fs::symlink("/dev/full", &full).unwrap();
        write(&null, b"gone", Over::Any).unwrap();
        assert!(write(&full, b"lost", Over::Any).unwrap_err().cause.contains("No space"));
        assert!(fs::symlink_metadata(&null).unwrap().is_symlink());
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_not_utf8_is_that_name() {
        use std::os::unix::ffi::OsStrExt as _;
        let folder = Folder::new("names");
        let file = folder.0.join(std::ffi::OsStr::from_bytes(b"a\xffb"));
        write(&file, b"x", Over::Any).unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }

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
