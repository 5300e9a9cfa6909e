//! Whether two names mean one file, and which files the command has read so far: no output of it may replace one.

use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    /// The path without links, `.` and `..`.
    place: PathBuf,
    number: Option<(u64, u64)>,
}

/// Device and number of a file on it: the same for all hard links. Some systems have none.
#[cfg(unix)]
pub(crate) fn number(data: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt as _;
    Some((data.dev(), data.ino()))
}

#[cfg(not(unix))]
pub(crate) fn number(_: &Metadata) -> Option<(u64, u64)> {
    None
}

impl Identity {
    /// The identity of the file that `path` names, whether it exists or is still to be written. A
    /// pipe or a device has none: what is written to it replaces nothing.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let data = std::fs::metadata(path).ok();
        if data.as_ref().is_some_and(|data| !data.is_file() && !data.is_dir()) {
            return None;
        }
        Some(Self { place: place(path), number: data.as_ref().and_then(number) })
    }

    /// Whether both are one file.
    pub(crate) fn is(&self, other: &Self) -> bool {
        self.has_number_of(other) || self.place == other.place
    }

    /// Whether both exist and the system gives them one number.
    fn has_number_of(&self, other: &Self) -> bool {
        self.number.is_some() && self.number == other.number
    }
}

/// The path without links, `.` and `..`. A file that does not exist is placed in its folder, and a
/// folder that does not exist in the one above it.
pub(crate) fn place(path: &Path) -> PathBuf {
    if let Ok(place) = path.canonicalize() {
        return place;
    }
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    match (path.parent(), path.file_name()) {
        (Some(folder), Some(name)) => place(folder).join(name),
        // The path ends with `..`.
        (Some(folder), None) => place(folder).parent().map_or_else(PathBuf::new, Path::to_owned),
        (None, _) => path,
    }
}

/// The files that this process has read. Threads of one command read files at the same time.
static READ: Mutex<Vec<Identity>> = Mutex::new(Vec::new());

fn list() -> MutexGuard<'static, Vec<Identity>> {
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Begins a new command, which has read nothing. A test runs several commands in one process.
pub fn forget_read_files() {
    list().clear();
}

/// Notes a file that is opened for reading.
pub(crate) fn note(path: &Path) {
    // Those below `/proc` cannot be replaced, and a program that judges others reads many of them.
    if let Some(read) = Identity::of(path).filter(|read| !read.place.starts_with("/proc")) {
        let mut list = list();
        if !list.contains(&read) {
            list.push(read);
        }
    }
}

/// Notes the file that is standard input, where it is one.
pub fn note_standard_input() {
    if cfg!(unix) {
        note(Path::new("/dev/stdin"));
    }
}

/// Whether a path names a file that was read, by whatever name.
pub(crate) fn was_read(path: &Path) -> bool {
    let Some(target) = Identity::of(path) else { return false };
    list().iter().any(|read| {
        // The number of a file that was removed may be given to a new one, so a file is recognised by its number
        // only while it is still where it was read.
        let is_still = || Identity::of(&read.place).is_some_and(|now| now.has_number_of(read));
        read.place == target.place || read.has_number_of(&target) && is_still()
    })
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the tests make the files in question")]
mod tests {
    use std::fs;

    use super::*;
    use crate::testing::Folder;

    fn are_one(a: &Path, b: &Path) -> bool {
        Identity::of(a).unwrap().is(&Identity::of(b).unwrap())
    }

    #[test]
    fn names_of_one_file_are_recognised() {
        let folder = Folder::new("identity");
        let file = folder.path("a.json");
        // Before the file exists, and after.
        for _ in 0..2 {
            assert!(are_one(&file, &folder.path("./a.json")));
            assert!(are_one(&file, &folder.path("no/../a.json")));
            assert!(!are_one(&file, &folder.path("b.json")));
            assert!(!are_one(&file, &folder.path("no/a.json")));
            fs::write(&file, "x").unwrap();
        }
        fs::hard_link(&file, folder.path("hard.json")).unwrap();
        assert!(are_one(&file, &folder.path("hard.json")));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a.json", folder.path("soft.json")).unwrap();
            assert!(are_one(&file, &folder.path("soft.json")));
            std::os::unix::fs::symlink(".", folder.path("here")).unwrap();
            assert!(are_one(&folder.path("new"), &folder.path("here/new")));
            assert_eq!(Identity::of(Path::new("/dev/null")), None);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_was_read_is_known_by_each_of_its_names_while_it_is_there() {
        let folder = Folder::new("read-files");
        let (file, hard, soft) = (folder.path("a"), folder.path("hard"), folder.path("soft"));
        fs::write(&file, "x").unwrap();
        fs::hard_link(&file, &hard).unwrap();
        std::os::unix::fs::symlink("a", &soft).unwrap();
        assert!(!was_read(&file));
        note(&file);
        for name in [&file, &hard, &soft, &folder.path("./no/../a")] {
            assert!(was_read(name), "{name:?}");
        }
        assert!(!was_read(&folder.path("b")));
        // As if a new file had got the number of the removed one.
        fs::remove_file(&file).unwrap();
        assert!(!was_read(&hard));
        assert!(was_read(&file));
    }
}
