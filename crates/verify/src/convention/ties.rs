//! The compass: who owns a sample that lies exactly on an edge, read off for each direction that the
//! edge can face, once point and grid are known.

use super::bench::{Bench, TriangleAnswer};
use super::candidate::Candidate;
use super::general::drawable;
use super::place::Place;
use super::rule::{CornerRule, Ties, Windings};
use super::shape::Shape;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{greatest_divisor, twice_area};
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Count {
    /// How many were drawn, changed, or right.
    pub drawn: u64,
    pub of: u64,
}

impl Count {
    /// Counts one more.
    pub fn add(&mut self, yes: bool) {
        self.drawn += u64::from(yes);
        self.of += 1;
    }

    /// In percent; None of none.
    pub fn percent(&self) -> Option<f64> {
        (self.of > 0).then(|| 100.0 * self.drawn as f64 / self.of as f64)
    }

    /// Whether all or none were.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.drawn == 0 || self.drawn == self.of
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compass {
    /// Samples on one edge, for each direction the edge faces: see [`super::FACINGS`].
    pub edges: [Count; 8],
    /// Samples on several edges at once.
    pub corners: Count,
    /// Of these, those that are drawn where each of the edges would be, and else are not.
    pub corners_as_edges: Count,
    /// Pixels with exactly the share that is asked for.
    pub level: Count,
}

impl Compass {
    /// Whether each direction was always or never drawn.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.edges.iter().chain([&self.level]).all(Count::is_decided)
    }

    /// Directions with at least one sample.
    #[must_use]
    pub fn seen(&self) -> [bool; 8] {
        self.edges.map(|count| count.of > 0)
    }

    /// The rule that these counts speak for, each direction by its majority. Directions that no
    /// question can show are filled in from a rule with a name, if one fits.
    #[must_use]
    pub fn ties(&self) -> Ties {
        // A direction is drawn where most of its samples are.
        let most = |count: Count| 2 * count.drawn > count.of;
        let mut ties = Ties {
            edges: self.edges.map(most),
            corners: CornerRule::AsEdges,
            level: most(self.level),
        };
        if let Some(named) = ties.name(self.seen()).and_then(Ties::named) {
            ties.edges = named.edges;
        }
        let [never, always] = [self.corners.of - self.corners.drawn, self.corners.drawn];
        if self.corners_as_edges.drawn < never.max(always) {
            ties.corners = if always > never { CornerRule::Always } else { CornerRule::Never };
        }
        ties
    }

    /// Adds what the answers show of one shape's ties.
    fn read(&mut self, candidate: &Candidate, answers: &[TriangleAnswer], bench: &Bench<'_>) {
        self.each(candidate, answers, bench, |compass, place, drawn| match place {
            Place::Edge(facing) => compass.edges[facing].add(drawn),
            Place::Corner(_) => compass.corners.add(drawn),
            Place::Level => compass.level.add(drawn),
            Place::In | Place::Several { .. } => {}
        });
        // Once the edges are known.
        let edges = self.ties().edges;
        self.each(candidate, answers, bench, |compass, place, drawn| {
            if let Place::Corner(bits) = place {
                let every = (0..edges.len()).all(|i| bits >> i & 1 == 0 || edges[i]);
                compass.corners_as_edges.add(every == drawn);
            }
        });
    }

    fn each(
        &mut self,
        candidate: &Candidate,
        answers: &[TriangleAnswer],
        bench: &Bench<'_>,
        count: impl Fn(&mut Self, Place, bool),
    ) {
        for answer in answers.iter().filter(|answer| !candidate.is_silent(&answer.corners)) {
            let points = candidate.quantum.corners(&answer.corners);
            candidate.shape.trace(&points, bench.window, &mut |x, y, place| {
                count(self, place, answer.drawn.has(x, y));
            });
        }
    }
}

/// Triangles that are tried in search of samples on edges.
const TRIES: usize = 4000;

impl Bench<'_> {
    /// Triangles with samples on their edges, in all directions where that can be: about `wanted`
    /// samples for each direction, and on corners.
    pub(super) fn tie_questions(&mut self, candidate: &Candidate, wanted: u32) -> Vec<Corners> {
        let draws = candidate.draws;
        let mut found = [0; 10];
        let mut questions = Vec::new();
        for _ in 0..TRIES {
            if found.iter().take(9).all(|&count| count >= wanted) {
                break;
            }
            // Half of them have an edge through a sample, and the others lie on a coarse grid.
            let aimed = self.rng.chance(2).then(|| self.aimed(candidate)).flatten();
            let corners = drawable(aimed.unwrap_or_else(|| self.aligned(candidate)), draws);
            if twice_area(&corners) == 0 || candidate.is_silent(&corners) {
                continue;
            }
            let mut here = [0; 10];
            let points = candidate.quantum.corners(&corners);
            candidate.shape.trace(&points, self.window, &mut |_, _, place| match place {
                Place::In | Place::Several { .. } => {}
                Place::Edge(facing) => here[facing] += 1,
                Place::Corner(_) => here[8] += 1,
                Place::Level => here[9] += 1,
            });
            // Long edges would use up what is wanted of a direction.
            let useful = |i: usize| here[i] > 0 && found[i] < wanted;
            if (0..10).any(useful) {
                for (found, here) in found.iter_mut().zip(here) {
                    *found += here.min(4);
                }
                let turned = draws == Windings::Both && self.rng.chance(2);
                let [a, b, c] = corners;
                questions.push(if turned { [a, c, b] } else { corners });
            }
        }
        questions
    }

    /// Where in a pixel an edge meets the sample, for some edge.
    fn meeting(&mut self, shape: Shape) -> [i32; 2] {
        match shape {
            Shape::Point { x, y } | Shape::Stepped { x, y } | Shape::Share { x, y, .. } => [x, y],
            Shape::Reach { x, y, reach, square } => {
                let [right, down] =
                    [0, 0].map_array(|_| if self.rng.chance(2) { reach } else { -reach });
                match (square, self.rng.chance(2)) {
                    (true, _) => [x + right, y + down],
                    (false, true) => [x + right, y],
                    (false, false) => [x, y + down],
                }
            }
            Shape::Rows { left, right, y } => [if self.rng.chance(2) { left } else { right }, y],
            Shape::Samples { x, y, pattern, .. } => {
                let [dx, dy] = pattern.offsets()[self.rng.int(0, 3) as usize];
                [x + dx, y + dy]
            }
            Shape::Outline(_) => [0, 0],
            Shape::Scan(_) => [128, 128],
        }
    }

    /// A triangle with an edge through a sample: from a corner on the grid through the sample to the
    /// next point on the grid. None where that leaves the window.
    fn aimed(&mut self, candidate: &Candidate) -> Option<Corners> {
        let unit = candidate.quantum.step.max(self.grain);
        let at = self.meeting(candidate.shape);
        let side = self.side() * 256;
        let pixel = [0, 0].map_array(|_| self.rng.int(4, i64::from(self.side() - 5)) as i32 * 256);
        let mut point = |low: i32, high: i32| {
            [0, 1].map_array(|axis| {
                let v = pixel[axis] + self.rng.int(low.into(), high.into()) as i32;
                (v + unit / 2).div_euclid(unit) * unit
            })
        };
        let (from, third) = (point(-700, 700), point(-1000, 1000));
        let ahead = [0, 1].map_array(|axis| pixel[axis] + at[axis] - from[axis]);
        let [x, y, step] = [ahead[0], ahead[1], unit].map_array(i64::from);
        // The next point of the grid on the line through the sample.
        let times = unit / greatest_divisor(greatest_divisor(x, y), step) as i32;
        // Once more where that is the sample itself.
        let times = if times == 1 { 2 } else { times };
        let to = [0, 1].map_array(|axis| from[axis] + times * ahead[axis]);
        let corners = [from, to, third].map_array(|[x, y]| SubpixelPoint::new(x, y));
        to.iter().all(|v| (0..side).contains(v)).then_some(corners)
    }

    /// A small triangle on a grid on which samples like to lie on edges.
    fn aligned(&mut self, candidate: &Candidate) -> Corners {
        let unit = candidate.quantum.step.max(self.grain);
        let at = self.meeting(candidate.shape);
        let coarse = self.rng.chance(3);
        let away = |bench: &mut Self, at: i32| match bench.rng.int(0, if coarse { 5 } else { 2 }) {
            0..=2 => at,
            3 => at + 128,
            4 => 0,
            _ => bench.rng.int(0, 3) as i32 * 64,
        };
        let base = [self.rng.int(2, 8), self.rng.int(2, 8)].map_array(|v| v as i32 * 256);
        let mut corners = [SubpixelPoint::new(0, 0); 3];
        for corner in &mut corners {
            let [x, y] = [0, 1].map_array(|axis| {
                let v = base[axis] + self.rng.int(0, 6) as i32 * 256 + away(self, at[axis]);
                (v + unit / 2).div_euclid(unit) * unit
            });
            *corner = SubpixelPoint::new(x, y);
        }
        match self.rng.int(0, 5) {
            0 => corners[1].x = corners[0].x,
            1 => corners[1].y = corners[0].y,
            _ => {}
        }
        corners
    }

    /// The compass of a shape by the answers to such questions.
    pub(super) fn compass(&self, candidate: &Candidate, answers: &[TriangleAnswer]) -> Compass {
        let mut compass = Compass::default();
        compass.read(candidate, answers, self);
        compass
    }
}
