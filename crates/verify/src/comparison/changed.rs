//! Engines that do not draw a case the same each time: every failing case is drawn twice.
//!
//! What such an engine draws says nothing about the next time. So the case is not shrunk, no cause is looked for, and both answers
//! are shown instead.

use super::finding::Finding;
use super::{Chosen, Compared, Failure, ORACLE, Options, Partial, expected};
use crate::cases::shrink::size;
use rasterproof_core::frame::Coverage;

/// Two different answers of an engine to the same case.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Changed {
    /// The name of the engine.
    pub engine: String,
    /// What it drew each time; nothing where it panicked.
    pub drawn: [Option<Coverage>; 2],
    /// What was found each time, in words.
    pub what: [String; 2],
}

impl Compared {
    pub(super) fn changed_engine(&self) -> Option<&String> {
        self.changed.as_ref().map(|changed| &changed.engine)
    }
}

/// A failing case in which a pair was found otherwise the second time.
#[derive(Clone)]
pub(super) struct Changing {
    /// The number of the pair.
    pub pair: usize,
    /// The number of the case.
    index: u64,
    /// What was found each time.
    found: [Finding; 2],
}

impl Changing {
    /// The pairs that were wrong and are found otherwise `again`.
    pub fn between(index: u64, findings: &[Finding], again: Vec<Finding>) -> Vec<Self> {
        let mut changing = Vec::new();
        for (pair, (first, again)) in findings.iter().zip(again).enumerate() {
            if first.is_wrong() && !first.is_repeated_by(&again) {
                changing.push(Self { pair, index, found: [first.clone(), again] });
            }
        }
        changing
    }

    fn failure(&self, of: &Chosen<'_>, options: &Options) -> Failure {
        let Self { pair, index, found: [first, again] } = self;
        let pair = of.pairs[*pair].clone();
        let case = options.terms.case(of.family, options.seed, *index);
        // Of two engines that are compared the one whose pixels changed; where only values did, the first.
        let who = usize::from(first.drawn[0] == again.drawn[0] && first.drawn[1] != again.drawn[1]);
        let changed = Changed {
            engine: pair[who].clone(),
            drawn: [first, again].map(|found| found.drawn[who].clone()),
            what: [first, again].map(Finding::describe),
        };
        let what = format!("first {}, then {}", changed.what[0], changed.what[1]);
        let [drawn, other] = first.drawn.clone();
        let expected = expected(&case, options.terms);
        let evidence = Compared { pair, drawn, other, expected, changed: Some(changed) };
        let (family, seed) = (of.family.name, options.seed);
        Failure { family, index: *index, seed, what, case, evidence }
    }
}

/// The first such case of each family and pair, small windows first. An engine that changes when the oracle judges it is not
/// reported again beside another engine.
pub(super) fn failures(
    partials: &[Partial],
    chosen: &[Chosen<'_>],
    options: &Options,
) -> Vec<Failure> {
    let mut failures = Vec::new();
    for (partial, of) in partials.iter().zip(chosen) {
        failures.extend(partial.changing.iter().map(|(_, changing)| changing.failure(of, options)));
    }
    let is_by_oracle = |failure: &Failure| failure.evidence.pair[1] == ORACLE;
    if failures.iter().any(is_by_oracle) {
        failures.retain(is_by_oracle);
    }
    let pixels = |failure: &Failure| {
        u64::from(failure.case.window.width()) * u64::from(failure.case.window.height())
    };
    failures.sort_by_cached_key(|failure| (pixels(failure), size(&failure.case)));
    failures
}
