//! `rasterproof engine`: the line protocol on standard input and output, and who speaks it.

use clap::builder::PossibleValue;

use super::{Failure, Status, Streams, exit};
use rasterproof_faults::planted::Mutant;
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_judge::server;
use rasterproof_registry::engines::{self, Entry};

pub const HELP: &str = "Requests and answers, one a line (numbers decimal or C99 hex floats):
  HELLO 1                                    HELLO 1 <name> <capability>...
  HELLO 2                                    HELLO 2 <name> <capability or declaration>...
  T id width height x0 y0 x1 y1 x2 y2        C id n  y x0 x1 ...      runs of covered pixels
  L id width height x0 y0 x1 y1              P id n  x y ...          pixels in drawing order
  I id width height (x y z w a b) x 3        F id n  x y z a b ...    fragments with values
  S id width height x0 y0 x1 y1 x2 y2        M id n  y x0 x1 mask ... samples covered, of four
  D id width height (x y z) x 3 a triangle   V id n  y x0 x1 t ...    runs that show triangle t
  N id (x y z w) x 3                         G id n  x y z w ...      what the near plane leaves
Anything else is answered E id reason. Positions are snapped to 1/256 px, except by the engines whose
names end in -exact; those answer T only. Example:
  echo 'T 1 8 8 0.5 0.5 5.5 0.5 5.5 5.5' | rasterproof engine scanline";

/// The engine of this name, planted faults among them.
pub(super) fn find(name: &str) -> Result<Entry, Failure> {
    let entry = engines::find(name).copied().or_else(|| engines::find_planted(name));
    entry
        .ok_or_else(|| super::usage(format!("no engine is called '{name}'; see: rasterproof list")))
}

pub fn run(name: &str, streams: &mut Streams<'_>) -> Status {
    server::serve(&find(name)?, &mut *streams.input, streams.output)?;
    Ok(exit::AGREES)
}

/// The names that `engine` takes; planted faults are not shown.
pub fn names() -> Vec<PossibleValue> {
    let shown = engines::ENTRIES.iter().chain(&engines::SPECIMENS).map(|entry| entry.name);
    let exact = ExactMutant::ALL.map(|mutant| mutant.name());
    let planted = Mutant::all().into_iter().map(|mutant| mutant.name()).chain(exact);
    let planted = planted.filter(|name| engines::find_planted(name).is_some());
    let hidden = planted.map(|name| PossibleValue::new(name).hide(true));
    shown.map(PossibleValue::new).chain(hidden).collect()
}
