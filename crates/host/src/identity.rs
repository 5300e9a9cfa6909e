//! Whether two names mean one file.

use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    place: PathBuf,
    /// Device and number of the file on it: the same for all hard links of a file.
    #[cfg(unix)]
    number: Option<(u64, u64)>,
}

impl Identity {
    /// The identity of the file that `path` names, whether it exists or is still to be written. A
    /// pipe or a device has none: what is written to it replaces nothing.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let data = std::fs::metadata(path).ok();
        if data.as_ref().is_some_and(|data| !data.is_file() && !data.is_dir()) {
            return None;
        }
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt as _;
            let number = data.map(|data| (data.dev(), data.ino()));
            Some(Self { place: place(path), number })
        }
        #[cfg(not(unix))]
        Some(Self { place: place(path) })
    }

    /// The path without links, `.` and `..`.
    #[must_use]
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Whether both are one file.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        self.has_number_of(other) || self.place == other.place
    }

    /// Whether both exist and the system gives them one number.
    pub(crate) fn has_number_of(&self, other: &Self) -> bool {
        #[cfg(unix)]
        return self.number.is_some() && self.number == other.number;
        #[cfg(not(unix))]
        {
            let _ = other;
            false
        }
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
}
