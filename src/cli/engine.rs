//! `rasterproof engine`: the line protocol on standard input and output, and who speaks it.

use std::path::Path;

use clap::builder::PossibleValue;
use rasterproof_host::identity;
use rasterproof_host::output::{self, Over, STANDARD_OUTPUT};

use super::{InputError, Status, Streams, exit};
use rasterproof_faults::planted::Mutant;
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_judge::server;
use rasterproof_registry::engines::{self, Entry};

/// The engine of this name, planted faults among them.
pub(super) fn find(name: &str) -> Result<Entry, InputError> {
    match engines::find(name).copied().or_else(|| engines::find_planted(name)) {
        Some(entry) => Ok(entry),
        None => Err(super::usage(format!("no engine is called '{name}'; see: rasterproof list"))),
    }
}

/// Answers one request after the other, until standard input ends.
pub fn run(name: &str, streams: &mut Streams<'_>) -> Status {
    // Answers must not go to the file from which the requests come.
    identity::note_standard_input();
    output::check(Path::new(STANDARD_OUTPUT), Over::Any).map_err(super::usage)?;
    server::serve(&find(name)?, &mut *streams.input, streams.output)?;
    Ok(exit::AGREES)
}

/// The names that `engine` takes; planted faults are not shown.
pub fn names() -> Vec<PossibleValue> {
    let mut names: Vec<_> =
        engines::speaking().map(|entry| PossibleValue::new(entry.name)).collect();
    let exact = ExactMutant::ALL.map(ExactMutant::name);
    for name in Mutant::all().iter().map(Mutant::name).chain(exact) {
        // Some are faults of what speaks no protocol.
        if engines::find_planted(name).is_some() {
            names.push(PossibleValue::new(name).hide(true));
        }
    }
    names
}
