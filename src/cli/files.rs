//! The files that a command line names: no two options may name one file, and no output replaces a
//! file that is read, or one of somebody else.

use std::path::{Path, PathBuf};

use rasterproof_host::identity::Identity;
use rasterproof_host::output::{self, Over};
use rasterproof_host::text::printable_path;

use super::{InputError, usage};

/// What standard output is, as a file; a system without it has no file of this name.
pub(super) const STANDARD_OUTPUT: &str = "/dev/stdout";

/// A file that a command writes, and which file it may replace.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub path: PathBuf,
    pub over: Over,
}

impl Output {
    /// A file whose name was typed, which replaces any that is not read.
    pub(super) fn typed(path: &Path) -> Self {
        Self { path: path.to_owned(), over: Over::Any }
    }
}

/// What a command does with a file that it was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Reads,
    Writes(Over),
}

/// A file of a command line: the option that names it, its path, and what the command does with it.
pub(super) type Named<'a> = (&'a str, &'a Path, Use);

/// An output as an entry of the files of a command line.
pub(super) fn written<'a>(option: &'a str, output: &'a Output) -> Named<'a> {
    (option, &output.path, Use::Writes(output.over))
}

/// Refuses a command that would write over a file which it also reads or writes by another option, by
/// whatever names; or over one that it has read already, such as a texture of a model; or, where the
/// program chose the name, over a file that it did not make.
pub(super) fn check<'a>(files: impl IntoIterator<Item = Named<'a>>) -> Result<(), InputError> {
    // Where standard output is a file, it is one more that is written.
    let standard_output = ("standard output", Path::new(STANDARD_OUTPUT), Use::Writes(Over::Any));
    let standard_output = cfg!(unix).then_some(standard_output);
    let all = files.into_iter().chain(standard_output);
    let identified = |(option, path, of)| Some((option, path, of, Identity::of(path)?));
    let all: Vec<(&str, &Path, Use, Identity)> = all.filter_map(identified).collect();
    let is_written = |of: Use| of != Use::Reads;
    for (at, (option, path, of, identity)) in all.iter().enumerate() {
        let mut others = all.iter().enumerate().filter(|&(other, (.., use_of_it, _))| {
            is_written(*of) && other != at && (other > at || !is_written(*use_of_it))
        });
        if let Some((_, (other, ..))) = others.find(|(_, (.., other))| identity.is(other)) {
            return Err(usage(format!(
                "{}: {option} and {other} name this file; give each a file of its own",
                printable_path(path)
            )));
        }
    }
    for (option, path, of, _) in all {
        if let Use::Writes(over) = of {
            output::check(path, over).map_err(|error| usage(format!("{option}: {error}")))?;
        }
    }
    Ok(())
}
