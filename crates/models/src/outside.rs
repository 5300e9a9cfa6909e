//! Files that a model names and that do not lie in its folder. They are read, since textures often are beside that folder, but no
//! message quotes their text: a model from elsewhere could otherwise show any file of the machine.

use std::path::Path;

use crate::BadFile;
use crate::textures::UNREADABLE;

/// What a message says in place of what it would quote.
pub(crate) const NOT_QUOTED: &str =
    "not quoted, since the file lies outside the folder of the model";

/// Whether a file lies outside a folder, links resolved.
pub(crate) fn is_outside(folder: &Path, file: &Path) -> bool {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match (folder.canonicalize(), file.canonicalize()) {
        (Ok(folder), Ok(file)) => !file.starts_with(folder),
        // A file that is not there has no text.
        _ => false,
    }
}

/// Why a picture cannot be decoded, without what the decoder quotes of it.
pub(crate) fn without_details(cause: &str) -> String {
    match cause.split_once(UNREADABLE) {
        Some((before, _)) => format!("{before}{UNREADABLE} (why is {NOT_QUOTED})"),
        None => cause.to_owned(),
    }
}

/// An error about a picture that a model in this folder names.
pub(crate) fn of_picture(folder: &Path, mut error: BadFile) -> BadFile {
    if is_outside(folder, &error.path) {
        error.cause = without_details(&error.cause);
    }
    error
}
