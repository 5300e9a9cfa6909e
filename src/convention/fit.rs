//! Which grid and which shape explain the answers: hypotheses in order of simplicity, their
//! parameters bounded by where edges flip, and told apart by questions on which they differ.

use std::collections::HashSet;

use super::bench::{Answer, Bench};
use super::general::{Flip, area, drawable};
use super::mask::Mask;
use super::outline::LineTie;
use super::quantum::{Quantum, Rounding};
use super::rule::Windings;
use super::shape::{Place, Shape, turn};
use crate::grid::{PixelRect, SubpixelPoint};
use crate::triangle::Corners;

/// A hypothesis: all of a convention but its ties.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Candidate {
    pub(super) draws: Windings,
    pub(super) quantum: Quantum,
    pub(super) shape: Shape,
}

impl Candidate {
    /// What it is sure to draw, and what it may draw: with and without its ties. None where it says
    /// nothing. Where its shape is not defined for such corners, a contradiction.
    fn bounds(&self, corners: &Corners, window: PixelRect) -> Option<[Mask; 2]> {
        if self.is_silent(corners) {
            return None;
        }
        let points = self.quantum.corners(corners);
        let (mut inner, mut outer) = (Mask::default(), Mask::default());
        let defined = self.shape.trace(&points, window, &mut |x, y, place| {
            outer.set(x, y);
            if place == Place::In {
                inner.set(x, y);
            }
        });
        Some(if defined { [inner, outer] } else { [Mask::FULL, Mask::default()] })
    }

    /// Whether the triangle has lost its area or its winding on the grid, so that nothing is said.
    pub(super) fn is_silent(&self, corners: &Corners) -> bool {
        let turned = turn(&self.quantum.corners(corners)).signum();
        // Who culls may do so before or after.
        let culled = self.draws != Windings::Both && turned != area(corners).signum();
        culled || (turned == 0 && !matches!(self.shape, Shape::Outline(_)))
    }

    /// Wrong pixels of the answers, ties apart. Stops counting beyond `enough`.
    pub(super) fn errors(&self, answers: &[Answer], window: PixelRect, enough: u32) -> u32 {
        let mut wrong = 0;
        for answer in answers {
            if let Some([inner, outer]) = self.bounds(&answer.corners, window) {
                wrong += inner.beyond(&answer.drawn) + answer.drawn.beyond(&outer);
            }
            if wrong > enough {
                break;
            }
        }
        wrong
    }

    /// Whether an answer to the question refutes one of the two.
    fn differs(&self, other: &Self, corners: &Corners, window: PixelRect) -> bool {
        match (self.bounds(corners, window), other.bounds(corners, window)) {
            (Some([inner, outer]), Some([other_inner, other_outer])) => {
                inner.beyond(&other_outer) + other_inner.beyond(&outer) > 0
            }
            _ => false,
        }
    }

    /// Whether the two are the same but for a sample position less than 1/16 px away. In a window of
    /// 32 px, corners on whole pixels do not show more: an edge of 1 in 30 meets rows at multiples
    /// of 1/30 px.
    pub(super) fn is_near(&self, other: &Self) -> bool {
        let near = |a: i32, b: i32| (a - b).abs() < 16;
        self.quantum == other.quantum
            && match (self.shape, other.shape) {
                (Shape::Point { x, y }, Shape::Point { x: ox, y: oy }) => {
                    near(x, ox) && near(y, oy)
                }
                (
                    Shape::Rows { left, right, y },
                    Shape::Rows { left: other_left, right: other_right, y: oy },
                ) => near(left, other_left) && near(right, other_right) && near(y, oy),
                _ => false,
            }
    }

    /// Simpler ones first.
    fn rank(&self) -> (u32, u32, u32) {
        let digits = |v: i32| 8 - v.trailing_zeros().min(8);
        let (kind, numbers) = match self.shape {
            Shape::Point { x, y } => (0, digits(x) + digits(y)),
            Shape::Rows { left, right, y } => (1, digits(left) + digits(right) + digits(y)),
            Shape::Stepped { x, y } => (2, digits(x) + digits(y)),
            Shape::Outline(tie) => {
                (3, LineTie::ALL.iter().position(|&t| t == tie).unwrap_or(0) as u32)
            }
            Shape::Reach { x, y, reach, .. } => (4, digits(x) + digits(y) + digits(reach)),
            Shape::Share { x, y, percent } => {
                (5, digits(x) + digits(y) + u32::from(percent % 25 != 0))
            }
        };
        let grid = if self.quantum.step == 1 { 0 } else { 1 + self.quantum.rounding as u32 };
        (kind, numbers, grid)
    }
}

/// Where a parameter may lie, and the finest step it is looked for in.
#[derive(Clone, Copy)]
struct Range {
    low: i32,
    high: i32,
    finest: i32,
}

/// Values of a parameter at the first look.
const FIRST_LOOK: i32 = 6;
/// Hypotheses that are kept while the steps get finer.
const BEAM: usize = 24;
/// Answers of the first look.
const FEW: usize = 30;

impl Range {
    /// Sample positions are looked for in 1/64 px, unless they are known more closely.
    fn of(low: i32, high: i32) -> Self {
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

    fn meet(self, other: Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Self::of(low, high))
    }
}

/// A hypothesis with its wrong pixels.
pub(super) type Scored = (u32, Candidate);

/// What a search needs.
pub(super) struct Fit<'a> {
    pub(super) answers: &'a [Answer],
    pub(super) window: PixelRect,
    pub(super) flips: [Option<Flip>; 4],
    pub(super) grain: i32,
    pub(super) draws: Windings,
}

impl Fit<'_> {
    /// The best parameters of a kind of shape: a coarse grid of values, then finer steps around the
    /// best of them.
    fn search(
        &self,
        quantum: Quantum,
        ranges: &[Range],
        make: &dyn Fn(&[i32]) -> Shape,
    ) -> Vec<Scored> {
        let few = &self.answers[..FEW.min(self.answers.len())];
        let mut seen = HashSet::new();
        let mut best = u32::MAX;
        let look = |values: &[i32], answers: &[Answer], best: &mut u32| {
            let candidate = Candidate { draws: self.draws, quantum, shape: make(values) };
            let errors = candidate.errors(answers, self.window, best.saturating_mul(3).max(24));
            *best = errors.min(*best);
            errors
        };
        let mut kept: Vec<(u32, Vec<i32>)> = Vec::new();
        for values in product(ranges) {
            let errors = look(&values, few, &mut best);
            seen.insert(values.clone());
            kept.push((errors, values));
        }
        let mut steps: Vec<_> = ranges.iter().map(|range| range.step()).collect();
        loop {
            kept.sort_by_cached_key(|(errors, values)| {
                (*errors, Candidate { draws: self.draws, quantum, shape: make(values) }.rank())
            });
            kept.truncate(BEAM);
            if steps.iter().zip(ranges).all(|(&step, range)| step <= range.finest) {
                break;
            }
            for (step, range) in steps.iter_mut().zip(ranges) {
                *step = (*step / 2).max(range.finest);
            }
            for (_, at) in kept.clone() {
                for values in neighbours(&at, &steps, ranges) {
                    if seen.insert(values.clone()) {
                        let errors = look(&values, few, &mut best);
                        kept.push((errors, values));
                    }
                }
            }
        }
        let mut best = u32::MAX;
        kept.into_iter()
            .map(|(_, values)| {
                let errors = look(&values, self.answers, &mut best);
                (errors, Candidate { draws: self.draws, quantum, shape: make(&values) })
            })
            .collect()
    }

    /// The positions between which an edge flips, on the grid.
    fn flip(&self, which: usize, quantum: Quantum) -> Range {
        let base = self.window.x1 / 2 * 256;
        let at = |sub: i32| (quantum.apply(base + sub) - i64::from(base)) as i32;
        self.flips[which].map_or(Range::of(-256, 512), |f| Range::of(at(f.low), at(f.high)))
    }

    /// Every hypothesis of the simplest kind that explains all, or of all kinds.
    pub(super) fn hypotheses(&self) -> Vec<Scored> {
        let kinds: [fn(&Self, Quantum) -> Vec<Scored>; 5] =
            [Self::points, Self::rows, Self::outlines, Self::reaches, Self::shares];
        let mut found = Vec::new();
        for kind in kinds {
            for quantum in self.quanta() {
                found.extend(kind(self, quantum));
            }
            if found.iter().any(|(errors, _)| *errors == 0) {
                break;
            }
        }
        found.sort_by_key(|(errors, candidate)| (*errors, candidate.rank()));
        found
    }

    /// Grids coarser than that of the questions. What rounds toward zero looks like what rounds
    /// down until corners are negative: see [`Bench::separate`].
    fn quanta(&self) -> Vec<Quantum> {
        let ways = [Rounding::Near, Rounding::HalfEven, Rounding::Down];
        let steps = [4, 16, 64, 256].into_iter().filter(|&step| step > self.grain);
        std::iter::once(Quantum::NONE)
            .chain(steps.flat_map(|step| ways.map(|rounding| Quantum { step, rounding })))
            .collect()
    }

    fn points(&self, quantum: Quantum) -> Vec<Scored> {
        let [left, right, top, bottom] = [0, 1, 2, 3].map(|i| self.flip(i, quantum));
        let (Some(x), Some(y)) = (left.meet(right), top.meet(bottom)) else { return Vec::new() };
        let mut found = self.search(quantum, &[x, y], &|v| Shape::Point { x: v[0], y: v[1] });
        if quantum.step == 4 {
            let [x, y] = [x, y].map(|range| Range { finest: 4, ..range });
            found.extend(self.search(quantum, &[x, y], &|v| Shape::Stepped { x: v[0], y: v[1] }));
        }
        found
    }

    fn rows(&self, quantum: Quantum) -> Vec<Scored> {
        let [left, right, top, bottom] = [0, 1, 2, 3].map(|i| self.flip(i, quantum));
        let Some(y) = top.meet(bottom) else { return Vec::new() };
        self.search(quantum, &[left, right, y], &|v| Shape::Rows {
            left: v[0],
            right: v[1],
            y: v[2],
        })
    }

    fn outlines(&self, quantum: Quantum) -> Vec<Scored> {
        if quantum.step.max(self.grain) < 256 {
            return Vec::new();
        }
        LineTie::ALL
            .iter()
            .map(|&tie| {
                let candidate =
                    Candidate { draws: self.draws, quantum, shape: Shape::Outline(tie) };
                (candidate.errors(self.answers, self.window, u32::MAX), candidate)
            })
            .collect()
    }

    /// The middle between the flips of two opposite edges, and half their distance.
    fn middle(&self, quantum: Quantum, axis: usize) -> [Range; 2] {
        let [first, second] = [2 * axis, 2 * axis + 1].map(|i| self.flip(i, quantum));
        let half = |v: i32| v.div_euclid(2);
        [
            Range::of(half(first.low + second.low), half(first.high + second.high + 1)),
            Range::of(half(first.low - second.high), half(first.high - second.low + 1)),
        ]
    }

    fn reaches(&self, quantum: Quantum) -> Vec<Scored> {
        let [[x, reach], [y, down]] = [0, 1].map(|axis| self.middle(quantum, axis));
        let Some(reach) = reach.meet(down).and_then(|r| r.meet(Range::of(1, 512))) else {
            return Vec::new();
        };
        [true, false]
            .into_iter()
            .flat_map(|square| {
                self.search(quantum, &[x, y, reach], &|v| Shape::Reach {
                    x: v[0],
                    y: v[1],
                    reach: v[2],
                    square,
                })
            })
            .collect()
    }

    fn shares(&self, quantum: Quantum) -> Vec<Scored> {
        let [[x, reach], [y, down]] = [0, 1].map(|axis| self.middle(quantum, axis));
        let Some(reach) = reach.meet(down).and_then(|r| r.meet(Range::of(-128, 126))) else {
            return Vec::new();
        };
        // An upright edge leaves the share 1/2 - reach/256 px of a pixel.
        let percent = |reach: i32| (100 * (128 - reach)).div_euclid(256);
        let low = (percent(reach.high)).max(1);
        let high = (percent(reach.low) + 1).min(100);
        self.search(quantum, &[x, y, Range { low, high, finest: 1 }], &|v| Shape::Share {
            x: v[0],
            y: v[1],
            percent: v[2],
        })
    }
}

/// All combinations of the first look.
fn product(ranges: &[Range]) -> Vec<Vec<i32>> {
    ranges.iter().fold(vec![Vec::new()], |lists, range| {
        let values = range.values();
        lists
            .iter()
            .flat_map(|list| values.iter().map(|&v| [list.as_slice(), &[v]].concat()))
            .collect()
    })
}

/// The values one step away along any parameters, within the ranges.
fn neighbours(at: &[i32], steps: &[i32], ranges: &[Range]) -> Vec<Vec<i32>> {
    let around: Vec<_> = at
        .iter()
        .zip(steps)
        .zip(ranges)
        .map(|((&v, &step), range)| {
            [v - step, v, v + step].into_iter().filter(|v| (range.low..=range.high).contains(v))
        })
        .collect();
    around.into_iter().fold(vec![Vec::new()], |lists, values| {
        let values: Vec<_> = values.collect();
        lists
            .iter()
            .flat_map(|list: &Vec<i32>| values.iter().map(|&v| [list.as_slice(), &[v]].concat()))
            .collect()
    })
}

/// Hypotheses that are told apart by further questions.
const MOST_SURVIVORS: usize = 48;
/// Rounds of questions, and questions in a round.
const ROUNDS: usize = 6;
const A_ROUND: usize = 24;
/// Triangles that are tried in search of one on which two hypotheses differ.
const TRIES: usize = 2000;

impl Bench<'_> {
    /// Those of the hypotheses that further questions do not refute, the simplest first. All that
    /// explain the answers so far are asked about, or the best alone.
    pub(super) fn separate(&mut self, scored: &[Scored], draws: Windings) -> Vec<Candidate> {
        let least = scored.first().map_or(0, |(errors, _)| *errors);
        let mut survivors: Vec<_> = scored
            .iter()
            .filter(|(errors, _)| *errors == least)
            .map(|(_, candidate)| *candidate)
            .take(MOST_SURVIVORS)
            .collect();
        let down = |c: &&Candidate| c.quantum.step > 1 && c.quantum.rounding == Rounding::Down;
        let twins: Vec<_> = survivors
            .iter()
            .filter(down)
            .map(|c| {
                let quantum = Quantum { rounding: Rounding::TowardZero, ..c.quantum };
                Candidate { quantum, ..*c }
            })
            .collect();
        let negative = !twins.is_empty();
        survivors.extend(twins);
        for _ in 0..ROUNDS {
            let questions = self.telling(&survivors, draws, negative);
            let answers = self.draw(&questions);
            if answers.is_empty() {
                break;
            }
            let errors: Vec<_> =
                survivors.iter().map(|c| c.errors(&answers, self.window, u32::MAX)).collect();
            // Where none is right, the nearest go on; the share explained will tell.
            let least = errors.iter().copied().min().unwrap_or(0);
            let mut errors = errors.into_iter();
            survivors.retain(|_| errors.next() == Some(least));
        }
        survivors
    }

    /// Questions on which the simplest hypothesis differs from others.
    fn telling(&mut self, all: &[Candidate], draws: Windings, negative: bool) -> Vec<Corners> {
        let Some((first, rest)) = all.split_first() else { return Vec::new() };
        let mut open: Vec<_> = rest.iter().collect();
        let mut questions = Vec::new();
        for _ in 0..TRIES {
            if open.is_empty() || questions.len() == A_ROUND {
                break;
            }
            let corners = drawable(self.odd(negative), draws);
            if area(&corners) == 0 {
                continue;
            }
            let before = open.len();
            open.retain(|other| !first.differs(other, &corners, self.window));
            if open.len() < before {
                questions.push(corners);
            }
        }
        questions
    }

    /// A triangle whose corners lie halfway between those of some grid, or anywhere; left of and
    /// above the window too, if that is asked for.
    fn odd(&mut self, negative: bool) -> Corners {
        let mut corners = self.general();
        let step = 1 << self.rng.int(2, 8);
        let halves = !self.rng.chance(3);
        let shift = if negative { self.rng.int(0, 12) as i32 * 256 } else { 0 };
        for corner in &mut corners {
            let fit = |v: i32| {
                let v =
                    if halves && step / 2 >= self.grain { v / step * step + step / 2 } else { v };
                v - shift
            };
            *corner = SubpixelPoint::new(fit(corner.x), fit(corner.y));
        }
        corners
    }
}
