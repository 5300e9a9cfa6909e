//! The files that the command has read so far, which no output of it may replace.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::identity::Identity;

/// Those of this process. Threads of one command read files at the same time.
static READ: Mutex<Option<HashMap<PathBuf, Identity>>> = Mutex::new(None);

fn list() -> MutexGuard<'static, Option<HashMap<PathBuf, Identity>>> {
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Begins a new command, which has read nothing. A test runs several commands in one process.
pub fn forget() {
    *list() = None;
}

/// Notes a file that is opened for reading.
pub(crate) fn note(path: &Path) {
    let Some(identity) = Identity::of(path) else { return };
    // Those below it cannot be replaced, and a program that judges others reads many of them.
    if identity.place().starts_with("/proc") {
        return;
    }
    list().get_or_insert_default().insert(identity.place().to_owned(), identity);
}

/// Notes the file that is standard input, where it is one.
pub fn note_standard_input() {
    if cfg!(unix) {
        note(Path::new("/dev/stdin"));
    }
}

/// Whether a path names a file that was read, by whatever name.
pub(crate) fn hold(path: &Path) -> bool {
    let Some(target) = Identity::of(path) else { return false };
    let list = list();
    let mut read = list.iter().flat_map(HashMap::values);
    read.any(|read| {
        // The number of a file that was removed may be given to a new one, so a file is recognised by its number
        // only while it is still where it was read.
        read.place() == target.place()
            || read.has_number_of(&target)
                && Identity::of(read.place()).is_some_and(|now| now.has_number_of(read))
    })
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the tests make the files in question")]
mod tests {
    use std::fs;

    use super::*;
    use crate::testing::Folder;

    #[cfg(unix)]
    #[test]
    fn a_file_is_known_by_each_of_its_names_while_it_is_there() {
        let folder = Folder::new("read-files");
        let (file, hard, soft) = (folder.path("a"), folder.path("hard"), folder.path("soft"));
        fs::write(&file, "x").unwrap();
        fs::hard_link(&file, &hard).unwrap();
        std::os::unix::fs::symlink("a", &soft).unwrap();
        assert!(!hold(&file));
        note(&file);
        for name in [&file, &hard, &soft, &folder.path("./no/../a")] {
            assert!(hold(name), "{name:?}");
        }
        assert!(!hold(&folder.path("b")));
        // As if a new file had got the number of the removed one.
        fs::remove_file(&file).unwrap();
        assert!(!hold(&hard));
        assert!(hold(&file));
    }
}
