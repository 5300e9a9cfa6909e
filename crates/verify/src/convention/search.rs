//! The search for the parameters of one kind of shape on one grid: a coarse lattice of values, then
//! finer steps around the best of them.

use std::collections::HashSet;

use super::bench::TriangleAnswer;
use super::candidate::Candidate;
use super::quantum::Quantum;
use super::rule::Windings;
use super::shape::Shape;
use rasterproof_core::grid::PixelRect;

pub(super) type Scored = (u32, Candidate);

/// The answers that hypotheses are compared with.
#[derive(Clone, Copy)]
pub(super) struct Observation<'a> {
    pub(super) answers: &'a [TriangleAnswer],
    pub(super) window: PixelRect,
    pub(super) draws: Windings,
}

/// Where a parameter may lie, and the finest step it is looked for in.
#[derive(Clone, Copy)]
pub(super) struct Range {
    pub(super) low: i32,
    pub(super) high: i32,
    pub(super) finest: i32,
}

/// Values of a parameter at the first look.
const FIRST_LOOK: i32 = 6;
/// Hypotheses that are kept while steps get finer, and in the end.
const BEAM: usize = 8;
const KEPT: usize = 24;
/// Answers that parameters are looked for with.
const FEW: usize = 24;

impl Range {
    /// Sample positions are looked for in 1/64 px, unless they are known more closely.
    pub(super) fn of(low: i32, high: i32) -> Self {
        let finest = if high - low <= 4 { 1 } else { 4 };
        Self { low, high, finest }
    }

    fn step(self) -> i32 {
        let mut step = self.finest;
        while (self.high - self.low) / step > FIRST_LOOK {
            step *= 2;
        }
        step
    }

    fn values(self) -> Vec<i32> {
        let step = self.step();
        let first = -(-self.low).div_euclid(step) * step;
        (0..).map(|i| first + i * step).take_while(|&v| v <= self.high).collect()
    }

    pub(super) fn meet(self, other: Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Self::of(low, high))
    }
}

pub(super) struct Search<'a> {
    seen: Observation<'a>,
    quantum: Quantum,
    ranges: Vec<Range>,
    make: fn(&[i32]) -> Shape,
    /// Looked at already.
    tried: HashSet<Vec<i32>>,
    /// The best values so far, with their wrong pixels.
    kept: Vec<(u32, Vec<i32>)>,
}

impl<'a> Search<'a> {
    /// Looks at a coarse lattice of values.
    pub(super) fn new(
        seen: Observation<'a>,
        quantum: Quantum,
        ranges: &[Range],
        make: fn(&[i32]) -> Shape,
    ) -> Self {
        let ranges = ranges.to_vec();
        let lattice: Vec<_> = ranges.iter().map(|range| range.values()).collect();
        let (tried, kept) = (HashSet::new(), Vec::new());
        let mut search = Self { seen, quantum, ranges, make, tried, kept };
        search.look(product(&lattice));
        search.sort();
        search
    }

    /// The fewest wrong pixels so far.
    pub(super) fn least(&self) -> u32 {
        self.kept.iter().map(|(errors, _)| *errors).min().unwrap_or(u32::MAX)
    }

    /// The hypothesis with these parameters.
    fn candidate(&self, values: &[i32]) -> Candidate {
        Candidate { draws: self.seen.draws, quantum: self.quantum, shape: (self.make)(values) }
    }

    /// Adds values that were not tried, with their errors on few answers.
    fn look(&mut self, list: Vec<Vec<i32>>) {
        let few = &self.seen.answers[..FEW.min(self.seen.answers.len())];
        let mut least = self.least();
        for values in list {
            if self.tried.insert(values.clone()) {
                let enough = least.saturating_mul(2).max(24);
                let errors = self.candidate(&values).errors(few, self.seen.window, enough);
                least = errors.min(least);
                self.kept.push((errors, values));
            }
        }
    }

    /// The best ones first, and of equal ones the simplest; the others are dropped.
    fn sort(&mut self) {
        let mut kept = std::mem::take(&mut self.kept);
        kept.sort_by_cached_key(|(errors, values)| (*errors, self.candidate(values).rank()));
        kept.truncate(KEPT);
        self.kept = kept;
    }

    /// Takes finer steps around the best values, and scores what remains on all answers.
    pub(super) fn finish(mut self) -> Vec<Scored> {
        // Steps are halved until the finest one is reached along each parameter.
        let mut steps: Vec<_> = self.ranges.iter().map(|range| range.step()).collect();
        while steps.iter().zip(&self.ranges).any(|(&step, range)| step > range.finest) {
            for (step, range) in steps.iter_mut().zip(&self.ranges) {
                *step = (*step / 2).max(range.finest);
            }
            let best: Vec<_> = self.kept.iter().take(BEAM).map(|(_, at)| at.clone()).collect();
            for at in best {
                self.look(self.around(&at, &steps));
            }
            self.sort();
        }
        let candidates = self.kept.iter().map(|(_, values)| self.candidate(values));
        let score = |c: Candidate| (c.errors(self.seen.answers, self.seen.window, u32::MAX), c);
        candidates.map(score).collect()
    }

    /// The values one step away along any parameters, within the ranges.
    fn around(&self, at: &[i32], steps: &[i32]) -> Vec<Vec<i32>> {
        let mut lattice = Vec::new();
        for ((&v, &step), range) in at.iter().zip(steps).zip(&self.ranges) {
            let near = [v - step, v, v + step];
            lattice
                .push(near.into_iter().filter(|v| (range.low..=range.high).contains(v)).collect());
        }
        product(&lattice)
    }
}

/// All lists with one value of each of these lists.
fn product(lists: &[Vec<i32>]) -> Vec<Vec<i32>> {
    let mut heads = vec![Vec::new()];
    for values in lists {
        // Each head goes on with each of the values.
        let mut longer = Vec::with_capacity(heads.len() * values.len());
        for head in &heads {
            for &v in values {
                let mut head: Vec<i32> = head.clone();
                head.push(v);
                longer.push(head);
            }
        }
        heads = longer;
    }
    heads
}
