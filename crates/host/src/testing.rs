//! Folders and files for the unit tests of this crate.
#![allow(clippy::disallowed_methods, reason = "the tests make and read the files in question")]

use std::fs;
use std::path::{Path, PathBuf};

/// An empty folder below the build's folder, removed with what is in it.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    /// Each test has a name of its own; two processes may run one test at the same time.
    pub(crate) fn new(name: &str) -> Self {
        // The program of the tests is in `deps`, in the folder of the build's profile.
        let program = std::env::current_exe().unwrap();
        let folder = program.ancestors().nth(2).unwrap().join("unit-tests");
        let folder = folder.join(format!("{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn names(&self) -> Vec<String> {
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
