//! Why a file was not opened, written or locked.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::text::printable_path;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    pub path: PathBuf,
    /// What is wrong, in words that follow the name of the file.
    pub cause: String,
    /// Whether nothing has this name, which some callers take for an empty file.
    pub missing: bool,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", printable_path(&self.path), self.cause)
    }
}

impl std::error::Error for FileError {}

pub(crate) fn refused(path: &Path, cause: impl Into<String>) -> FileError {
    FileError { path: path.to_owned(), cause: cause.into(), missing: false }
}
