//! What is found when an engine is compared: wrong pixels, differences of values, a panic.

use std::ops::AddAssign;

use crate::judge::EnginePanic;
use rasterproof_core::contract::Decisions;
use rasterproof_core::frame::Coverage;

/// Wrong pixels, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Tally {
    /// Hits that the target has and the actual one lacks.
    pub missing: u64,
    /// Pixels hit that the target does not hit.
    pub extra: u64,
    /// Hits beyond the target's on pixels that are hit before.
    pub twice: u64,
    /// Pixels of a line that come out in another order.
    pub order: u64,
}

impl Tally {
    /// All wrong pixels.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.missing + self.extra + self.twice + self.order
    }

    /// Compares hit counts pixel by pixel; both frames show the same window.
    #[must_use]
    pub fn between(actual: &Coverage, target: &Coverage) -> Self {
        let mut tally = Self::default();
        if actual == target {
            return tally;
        }
        for ((_, actual), (_, target)) in actual.rows().zip(target.rows()) {
            for (&actual, &target) in actual.iter().zip(target) {
                tally.missing += u64::from(target.saturating_sub(actual));
                let more = u64::from(actual.saturating_sub(target));
                if target == 0 {
                    tally.extra += more.min(1);
                    tally.twice += more.saturating_sub(1);
                } else {
                    tally.twice += more;
                }
            }
        }
        tally
    }

    /// The kinds that occur, in words; empty where nothing is wrong.
    #[must_use]
    pub fn describe(&self) -> String {
        let Self { missing, extra, twice, order } = *self;
        let counts =
            [(missing, "missing"), (extra, "extra"), (twice, "twice"), (order, "out of order")];
        let parts = counts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}"));
        parts.collect::<Vec<_>>().join(", ")
    }
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.missing += other.missing;
        self.extra += other.extra;
        self.twice += other.twice;
        self.order += other.order;
    }
}

/// What was found about a pair of engines in one case.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    /// Wrong pixels: the coverage of the one against that of the other.
    pub tally: Tally,
    /// The pixels of the engine's fragments against its own coverage; nobody else has a part in it.
    pub fragments: Tally,
    /// Largest difference of an attribute over its bound, or that it was known to reach.
    pub attribute: f64,
    /// Largest difference of a depth over its bound, likewise.
    pub depth: f64,
    /// Values compared.
    pub values: u64,
    /// How an engine for corners that are not snapped decided.
    pub decisions: Decisions,
    /// What an engine said when it panicked.
    pub panic: Option<String>,
    /// The pixels of both, where they do not agree or `keeps_pixels`; none of the oracle, and of one that panics.
    pub(super) drawn: [Option<Coverage>; 2],
    pub(super) keeps_pixels: bool,
}

impl Finding {
    /// Whether the two do not agree.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        self.tally.total() + self.fragments.total() > 0
            || self.panic.is_some()
            || self.attribute > 1.0
            || self.depth > 1.0
    }

    /// The larger of the two worst differences, each as a fraction of its bound.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.attribute.max(self.depth)
    }

    /// The disagreement in words.
    #[must_use]
    pub fn describe(&self) -> String {
        if let Some(message) = &self.panic {
            return format!("panics ({message})");
        }
        let mut parts = Vec::new();
        if self.tally.total() > 0 {
            parts.push(self.tally.describe());
        }
        if self.fragments.total() > 0 {
            let what = self.fragments.describe();
            parts.push(format!("its fragments against its own coverage: {what}"));
        }
        if self.attribute > 1.0 {
            parts.push(format!("an attribute off by {:.3e} times its bound", self.attribute));
        }
        if self.depth > 1.0 {
            parts.push(format!("a depth off by {:.3e} times its bound", self.depth));
        }
        if parts.is_empty() { "agrees".to_owned() } else { parts.join("; ") }
    }

    /// Where a comparison starts from: differences up to these were seen before, and need not be
    /// looked into. Seen before or not, what exceeds its bound is.
    #[must_use]
    pub fn known(attribute: f64, depth: f64) -> Self {
        Self { attribute: attribute.min(1.0), depth: depth.min(1.0), ..Self::default() }
    }

    /// Whether the answers to the same case, asked a second time, are the same as far as they are compared. What a panic says
    /// may change.
    pub(super) fn is_repeated_by(&self, again: &Self) -> bool {
        let values = |finding: &Self| [finding.attribute, finding.depth].map(f64::to_bits);
        self.drawn == again.drawn
            && [self.tally, self.fragments] == [again.tally, again.fragments]
            && values(self) == values(again)
            && self.panic.is_some() == again.panic.is_some()
    }

    /// Keeps the pixels of both, where somebody will look at them.
    pub(super) fn keep(&mut self, pixels: impl FnOnce() -> [Option<Coverage>; 2]) {
        if self.keeps_pixels || self.is_wrong() {
            self.drawn = pixels();
        }
    }

    /// Adds what comparing two coverages came to.
    pub(super) fn cover(&mut self, tally: Result<Tally, EnginePanic>) {
        match tally {
            Ok(tally) => self.tally += tally,
            Err(panic) => self.panic = Some(panic.0),
        }
    }

    /// Adds the differences of an attribute and a depth, each as a fraction of its bound.
    pub fn compare(&mut self, attribute: f64, depth: f64) {
        // A NaN ratio is a failure, and `f64::max` would drop it.
        let worse = |old: f64, new: f64| if new.is_nan() { f64::INFINITY } else { old.max(new) };
        self.attribute = worse(self.attribute, attribute);
        self.depth = worse(self.depth, depth);
        self.values += 1;
    }
}
