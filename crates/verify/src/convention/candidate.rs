//! A hypothesis about grid and shape, and what it says of a triangle while its ties are open.

use super::bench::TriangleAnswer;
use super::mask::Mask;
use super::place::{Place, turn};
use super::quantum::Quantum;
use super::rule::Windings;
use super::scan::Scan;
use super::shape::Shape;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

/// A hypothesis: all of a convention but its ties.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Candidate {
    pub(super) draws: Windings,
    pub(super) quantum: Quantum,
    pub(super) shape: Shape,
}

impl Candidate {
    /// The scan conversions of libraries that explain everything: what is nearly one of them is none of them.
    pub(super) fn scans(
        draws: Windings,
        answers: &[TriangleAnswer],
        window: PixelRect,
    ) -> impl Iterator<Item = Self> {
        Scan::ALL
            .map(|scan| Self { draws, quantum: Quantum::NONE, shape: Shape::Scan(scan) })
            .into_iter()
            .filter(move |scan| scan.errors(answers, window, 0) == 0)
    }

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
        let culled = self.draws != Windings::Both && turned != twice_area(corners).signum();
        culled || (turned == 0 && !self.shape.draws_flat())
    }

    /// Wrong pixels of the answers, ties apart. Stops counting beyond `enough`.
    pub(super) fn errors(&self, answers: &[TriangleAnswer], window: PixelRect, enough: u32) -> u32 {
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
    pub(super) fn differs(&self, other: &Self, corners: &Corners, window: PixelRect) -> bool {
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
                    Shape::Samples { x, y, pattern, least },
                    Shape::Samples { x: ox, y: oy, pattern: other, least: others },
                ) => near(x, ox) && near(y, oy) && (pattern, least) == (other, others),
                (
                    Shape::Rows { left, right, y },
                    Shape::Rows { left: other_left, right: other_right, y: oy },
                ) => near(left, other_left) && near(right, other_right) && near(y, oy),
                _ => false,
            }
    }

    /// Simpler ones first.
    pub(super) fn rank(&self) -> (u32, u32, u32) {
        let digits = |v: i32| 8 - v.trailing_zeros().min(8);
        let (kind, numbers) = match self.shape {
            Shape::Point { x, y } => (0, digits(x) + digits(y)),
            Shape::Rows { left, right, y } => (1, digits(left) + digits(right) + digits(y)),
            Shape::Stepped { x, y } => (2, digits(x) + digits(y)),
            Shape::Outline(tie) => (3, tie as u32),
            Shape::Samples { x, y, pattern, least } => {
                (4, digits(x) + digits(y) + pattern as u32 + u32::from(least))
            }
            Shape::Reach { x, y, reach, .. } => (5, digits(x) + digits(y) + digits(reach)),
            Shape::Share { x, y, percent } => {
                (6, digits(x) + digits(y) + u32::from(percent % 25 != 0))
            }
            Shape::Scan(scan) => (7, scan as u32),
        };
        let grid = if self.quantum.step == 1 { 0 } else { 1 + self.quantum.rounding as u32 };
        (kind, numbers, grid)
    }
}
