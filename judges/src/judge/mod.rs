//! The judge of other people's programs: anybody who answers questions is asked the cases of the
//! families and judged as our own engines are.
//!
//! [`ask`] is what is asked and answered, [`process`] asks a program through pipes and [`inside`] an
//! engine of the line-up without one. [`declared`] is what a program says of itself, [`place`] puts
//! the cases where it says it draws, [`expected`] knows the exact picture, [`check`] finds what is
//! wrong with a case ([`finding`]), `depth` and `near` of what is beside the rasterizer, [`run`] asks them all, [`recognise`] finds the
//! convention that is followed, and [`verdict`] says what came of it, property by property;
//! [`baseline`] knows failures that are known. [`serve`] is the other side: it answers as an engine.

pub mod ask;
pub mod baseline;
pub mod check;
pub mod declared;
mod depth;
pub mod expected;
pub mod finding;
pub mod group;
pub mod inside;
pub mod league;
mod leaving;
pub mod mesh;
mod near;
pub mod place;
pub mod process;
mod published;
pub mod recognise;
mod reply;
pub mod run;
pub mod serve;
mod served;
pub mod shrunk;
pub mod stages;
pub mod text;
pub mod verdict;

use std::time::Duration;

use ask::Ask;
use check::Truth;
use recognise::Recognised;
use verdict::Verdict;

/// What to judge.
#[derive(Clone, Debug)]
pub struct Options {
    /// Decides every generated case.
    pub seed: u64,
    /// Cases of each family.
    pub cases: u64,
    /// No new case is begun after this long.
    pub time_limit: Option<Duration>,
    /// Names of families; empty means all.
    pub families: Vec<String>,
    /// Only the case of this number.
    pub only: Option<u64>,
    /// How long the smallest failing case of a property is looked for.
    pub patience: Duration,
    /// Every case and every failure is remembered, for a baseline.
    pub remember: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            cases: 1000,
            time_limit: None,
            families: Vec::new(),
            only: None,
            patience: Duration::from_secs(5),
            remember: false,
        }
    }
}

/// Recognises the convention of a program by asking it; nothing where it draws as it declares.
pub type Recognise<'a> = &'a dyn Fn(&mut dyn Ask) -> Option<Recognised>;

/// Judges whoever answers; several are the same program and share the work.
///
/// # Panics
/// If nobody is there to be asked.
#[must_use]
pub fn judge(
    askers: &mut [Box<dyn Ask>],
    options: &Options,
    recognise: Recognise<'_>,
    progress: &(dyn Fn(u64) + Sync),
) -> Verdict {
    let first = askers.first_mut().expect("somebody to be asked");
    let declared = first.declared().clone();
    let mut truth = Truth::of(&declared);
    let windings = stages::windings(&mut **first, options.seed);
    truth.drawn = windings.seen().unwrap_or(truth.drawn);
    let recognised = recognise(&mut **first).map(|found| {
        truth.recognised = found.expect;
        found.said
    });
    let mut found = run::run(askers, options, &truth, progress);
    let first = &mut *askers[0];
    let failures = shrunk::failures(first, &found, options, &truth);
    found.strays.extend(first.strays());
    Verdict::new(declared, options, windings, recognised, found, failures, first.complaints())
}
