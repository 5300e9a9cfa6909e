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
    let mut seen: Vec<(&str, &Path, Use, Identity)> = Vec::new();
    for (option, path, of) in all {
        let Some(identity) = Identity::of(path) else { continue };
        let other = seen.iter().find(|(.., before, identified)| {
            (of == Use::Writes || *before == Use::Writes) && identity.is(identified)
        });
        if let Some((before, named, ..)) = other {
            return Err(usage(format!(
                "{}: {before} and {option} name this file; give each a file of its own",
                printable_path(named)
            )));
        }
        seen.push((option, path, of, identity));
    }
    Ok(())
}
