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
    let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
    entry
        .ok_or_else(|| super::usage(format!("no engine is called '{name}'; see: rasterproof list")))
}

pub fn run(name: &str, streams: &mut Streams<'_>) -> Status {
    identity::note_standard_input();
    output::check(Path::new(STANDARD_OUTPUT), Over::Any).map_err(super::usage)?;
    server::serve(&find(name)?, &mut *streams.input, streams.output)?;
    Ok(exit::AGREES)
}

/// The names that `engine` takes; planted faults are not shown.
pub fn names() -> Vec<PossibleValue> {
    let shown = engines::speaking().map(|entry| entry.name);
    let exact = ExactMutant::ALL.map(|mutant| mutant.name());
    let planted = Mutant::all().into_iter().map(|mutant| mutant.name()).chain(exact);
    let planted = planted.filter(|name| engines::find_planted(name).is_some());
    let hidden = planted.map(|name| PossibleValue::new(name).hide(true));
    shown.map(PossibleValue::new).chain(hidden).collect()
}
