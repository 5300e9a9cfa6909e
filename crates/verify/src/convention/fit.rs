//! Which grid and which shape explain the answers: hypotheses in order of simplicity, their
//! parameters bounded by where edges flip.

use super::candidate::Candidate;
use super::general::Flip;
use super::outline::LineTie;
use super::quantum::{Quantum, Rounding};
use super::samples::Pattern;
use super::search::{Observation, Range, Scored, Search};
use super::shape::Shape;
use rasterproof_core::arrays::MapArray as _;

/// Grids whose search goes on after the first look.
const GRIDS: usize = 6;

/// What hypotheses are fitted to.
pub(super) struct Fit<'a> {
    pub(super) seen: Observation<'a>,
    pub(super) flips: [Option<Flip>; 4],
    /// Subpixels between neighbouring coordinates that may be asked.
    pub(super) grain: i32,
}

impl<'a> Fit<'a> {
    /// Hypotheses with their wrong pixels, the best first: of the kinds up to the simplest that
    /// explains all, or of all kinds and, where none does, the scan conversions of libraries.
    pub(super) fn hypotheses(&self) -> Vec<Scored> {
        let kinds: [fn(&Self, Quantum) -> Vec<Search<'a>>; 5] =
            [Self::points, Self::rows, Self::samples, Self::reaches, Self::shares];
        let mut found = Vec::new();
        for (number, kind) in kinds.iter().enumerate() {
            let mut searches = Vec::new();
            for quantum in self.quanta() {
                searches.extend(kind(self, quantum));
            }
            // The first look says which grids are worth a second one.
            searches.sort_by_key(Search::least);
            for search in searches.into_iter().take(GRIDS) {
                found.extend(search.finish());
            }
            if number == 1 {
                found.extend(self.outlines());
            }
            if found.iter().any(|(errors, _)| *errors == 0) {
                break;
            }
        }
        if found.iter().all(|(errors, _)| *errors > 0) {
            let Observation { answers, window, draws } = self.seen;
            found.extend(Candidate::scans(draws, answers, window).map(|scan| (0, scan)));
        }
        found.sort_by_key(|(errors, candidate)| (*errors, candidate.rank()));
        found
    }

    /// Grids coarser than that of the questions. What rounds toward zero looks like what rounds
    /// down until corners are negative: see [`super::bench::Bench::separate`].
    fn quanta(&self) -> Vec<Quantum> {
        let ways = [Rounding::Near, Rounding::HalfEven, Rounding::Down];
        let mut quanta = vec![Quantum::NONE];
        for step in [4, 16, 64, 256] {
            if step > self.grain {
                quanta.extend(ways.map_array(|rounding| Quantum { step, rounding }));
            }
        }
        quanta
    }

    /// Of the left, right, upper and lower edge.
    fn flips_on(&self, quantum: Quantum) -> [Range; 4] {
        [0, 1, 2, 3].map_array(|which| self.flip(which, quantum))
    }

    /// The positions between which an edge flips, on the grid.
    fn flip(&self, which: usize, quantum: Quantum) -> Range {
        let base = self.seen.window.x1 / 2 * 256;
        let at = |sub: i32| (quantum.apply(base + sub) - i64::from(base)) as i32;
        self.flips[which].map_or(Range::of(-256, 512), |f| Range::of(at(f.low), at(f.high)))
    }

    /// One search, as a list.
    fn search(
        &self,
        quantum: Quantum,
        ranges: &[Range],
        make: fn(&[i32]) -> Shape,
    ) -> Vec<Search<'a>> {
        vec![Search::new(self.seen, quantum, ranges, make)]
    }

    /// A sample at one place, which all four flips bound.
    fn points(&self, quantum: Quantum) -> Vec<Search<'a>> {
        let [left, right, top, bottom] = self.flips_on(quantum);
        let (Some(x), Some(y)) = (left.meet(right), top.meet(bottom)) else { return Vec::new() };
        let mut found = self.search(quantum, &[x, y], |v| Shape::Point { x: v[0], y: v[1] });
        if quantum.step == 4 {
            let [x, y] = [x, y].map_array(|range| Range { finest: 4, ..range });
            found.extend(self.search(quantum, &[x, y], |v| Shape::Stepped { x: v[0], y: v[1] }));
        }
        found
    }

    /// Left and right ends of rows at places of their own, at one height.
    fn rows(&self, quantum: Quantum) -> Vec<Search<'a>> {
        let [left, right, top, bottom] = self.flips_on(quantum);
        let Some(y) = top.meet(bottom) else { return Vec::new() };
        let make = |v: &[i32]| Shape::Rows { left: v[0], right: v[1], y: v[2] };
        self.search(quantum, &[left, right, y], make)
    }

    /// Whole pixels with the sides as lines.
    fn outlines(&self) -> Vec<Scored> {
        let Observation { answers, window, draws } = self.seen;
        let mut found = Vec::new();
        for quantum in self.quanta() {
            // Ends of lines are whole pixels.
            if quantum.step.max(self.grain) != 256 {
                continue;
            }
            for tie in LineTie::ALL {
                let candidate = Candidate { draws, quantum, shape: Shape::Outline(tie) };
                found.push((candidate.errors(answers, window, u32::MAX), candidate));
            }
        }
        found
    }

    /// The middle between the flips of two opposite edges, and half their distance.
    fn middle(&self, quantum: Quantum, axis: usize) -> [Range; 2] {
        let (first, second) = (self.flip(2 * axis, quantum), self.flip(2 * axis + 1, quantum));
        let half = |v: i32| v.div_euclid(2);
        [
            Range::of(half(first.low + second.low), half(first.high + second.high + 1)),
            Range::of(half(first.low - second.high), half(first.high - second.low + 1)),
        ]
    }

    /// The middles along both axes, and the half distance that both have in common within some limits; nothing where there is none.
    fn middles(&self, quantum: Quantum, low: i32, high: i32) -> Option<[Range; 3]> {
        let [[x, reach], [y, down]] = [self.middle(quantum, 0), self.middle(quantum, 1)];
        Some([x, y, reach.meet(down)?.meet(Range::of(low, high))?])
    }

    /// Four samples about a middle, of which at least one to four are covered.
    fn samples(&self, quantum: Quantum) -> Vec<Search<'a>> {
        let [[x, _], [y, _]] = [self.middle(quantum, 0), self.middle(quantum, 1)];
        let makes: [fn(&[i32]) -> Shape; 2] =
            [|v| four(v, Pattern::Square), |v| four(v, Pattern::Rotated)];
        let least = Range { low: 1, high: 4, finest: 1 };
        self.search_each(quantum, &[x, y, least], makes)
    }

    /// Samples with a reach, in both axes at once or along each.
    fn reaches(&self, quantum: Quantum) -> Vec<Search<'a>> {
        let Some(ranges) = self.middles(quantum, 1, 512) else { return Vec::new() };
        let makes: [fn(&[i32]) -> Shape; 2] = [
            |v| Shape::Reach { x: v[0], y: v[1], reach: v[2], square: true },
            |v| Shape::Reach { x: v[0], y: v[1], reach: v[2], square: false },
        ];
        self.search_each(quantum, &ranges, makes)
    }

    /// Two kinds of shapes with the same ranges.
    fn search_each(
        &self,
        quantum: Quantum,
        ranges: &[Range],
        makes: [fn(&[i32]) -> Shape; 2],
    ) -> Vec<Search<'a>> {
        makes.map_array(|make| Search::new(self.seen, quantum, ranges, make)).into()
    }

    /// A share of the area of a pixel.
    fn shares(&self, quantum: Quantum) -> Vec<Search<'a>> {
        let Some([x, y, reach]) = self.middles(quantum, -128, 126) else { return Vec::new() };
        // An upright edge leaves the share 1/2 - reach/256 px of a pixel.
        let percent = |reach: i32| (100 * (128 - reach)).div_euclid(256);
        let low = percent(reach.high).max(1);
        let high = (percent(reach.low) + 1).min(100);
        let make = |v: &[i32]| Shape::Share { x: v[0], y: v[1], percent: v[2] };
        self.search(quantum, &[x, y, Range { low, high, finest: 1 }], make)
    }
}

/// Four samples about a middle.
fn four(v: &[i32], pattern: Pattern) -> Shape {
    Shape::Samples { x: v[0], y: v[1], pattern, least: v[2] as u8 }
}
