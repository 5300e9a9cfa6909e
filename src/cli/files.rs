//! The files that a command line names: no two options may name one file.

use std::path::Path;

use rasterproof_host::identity::Identity;
use rasterproof_host::text::printable_path;

use super::{Failure, usage};

/// What a command does with a file that it was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Reads,
    Writes,
}

/// Refuses a command that would write over a file which it also reads or writes by another option,
/// by whatever names. Each file comes with the option that names it.
pub(super) fn distinct(files: &[(&str, &Path, Use)]) -> Result<(), Failure> {
    // Where standard output is a file, it is one more that is written.
    let standard_output = cfg!(unix).then_some(Path::new("/dev/stdout"));
    let all = files.iter().copied();
    let all = all.chain(standard_output.map(|path| ("standard output", path, Use::Writes)));
    let identified = |(option, path, of)| Some((option, path, of, Identity::of(path)?));
    let all: Vec<(&str, &Path, Use, Identity)> = all.filter_map(identified).collect();
    let is_written = |of: Use| of == Use::Writes;
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
    Ok(())
}
