//! Lines between whole pixels by the rule for ties, and triangles drawn with such an outline.

use super::half_planes;
use super::place::{Emit, Place, Points, edges};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use std::ops::RangeInclusive;

rasterproof_core::named! {
    /// Where a line goes that passes exactly between two pixels. 'Go' means on, in its minor direction,
    /// as seen from the end that is named; 'stay' means not yet.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum LineTie {
        /// The rule of this project's line drawers, which gives the same pixels from either end.
        SmallGo = "on, seen from the end with the smaller major coordinate",
        SmallStay = "not yet, seen from the end with the smaller major coordinate",
        FirstGo = "on, seen from the first end",
        /// Bresenham's algorithm as mostly printed.
        FirstStay = "not yet, seen from the first end",
        /// Of upright lines, from the upper end.
        LeftGo = "on, seen from the left end",
        LeftStay = "not yet, seen from the left end",
        TopGo = "on, seen from the upper end",
        TopStay = "not yet, seen from the upper end",
        /// The coordinate plus 1/2 is cut to a whole number, as `(int)(v + 0.5)` does above zero.
        Up = "toward larger coordinates",
        Down = "toward smaller coordinates",
        Even = "to the even pixel",
        UpperRight = "to the upper pixel of a flat line, to the right one of a steep one",
        LowerLeft = "to the lower pixel of a flat line, to the left one of a steep one",
    }
}

impl LineTie {
    /// Whether the minor coordinate, exactly at `below` + 1/2, becomes the larger one. `du` and
    /// `dv` run along the major and the minor axis.
    fn rises(self, line: &Line, below: i64) -> bool {
        let plus = line.dv > 0;
        let from = |end: End| plus == end.is_first(line);
        match self {
            Self::Up => true,
            Self::Down => false,
            Self::Even => below % 2 != 0,
            Self::UpperRight => line.steep,
            Self::LowerLeft => !line.steep,
            Self::FirstGo => from(End::First),
            Self::FirstStay => !from(End::First),
            Self::LeftGo => from(End::Left),
            Self::LeftStay => !from(End::Left),
            Self::TopGo => from(End::Top),
            Self::TopStay => !from(End::Top),
            Self::SmallGo => from(End::Small),
            Self::SmallStay => !from(End::Small),
        }
    }
}

rasterproof_core::named! {
    /// The end that a line is seen from.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum End {
        First = "the first end",
        Small = "the end with the smaller major coordinate",
        /// The left one; of upright lines, the upper.
        Left = "the left end",
        /// The upper one; of level lines, the right.
        Top = "the upper end",
    }
}

impl End {
    pub(super) fn is_first(self, line: &Line) -> bool {
        let [dx, dy] = if line.steep { [line.dv, line.du] } else { [line.du, line.dv] };
        match self {
            Self::First => true,
            Self::Small => line.du > 0,
            Self::Left => dx > 0 || (dx == 0 && dy > 0),
            Self::Top => dy > 0,
        }
    }
}

/// A line between two pixels, taken apart along its axes.
pub(super) struct Line {
    /// Whether the major axis is y.
    pub(super) steep: bool,
    /// The first end along the major and the minor axis.
    start: [i64; 2],
    pub(super) du: i64,
    pub(super) dv: i64,
}

impl Line {
    /// From pixel to pixel, [x, y].
    pub(super) fn new(from: [i64; 2], to: [i64; 2]) -> Self {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        if dy.abs() > dx.abs() {
            Self { steep: true, start: [from[1], from[0]], du: dy, dv: dx }
        } else {
            Self { steep: false, start: from, du: dx, dv: dy }
        }
    }

    /// Steps along the major axis.
    pub(super) fn steps(&self) -> i64 {
        self.du.abs()
    }

    /// The steps whose major coordinate lies in a window, and one before these; nothing where there is none.
    pub(super) fn steps_in(&self, window: PixelRect) -> Option<RangeInclusive<i64>> {
        let sides = if self.steep { [window.y0, window.y1] } else { [window.x0, window.x1] };
        // From the first end on, in the direction of the line.
        let [first, last] = match self.du < 0 {
            false => [i64::from(sides[0]) - self.start[0], i64::from(sides[1]) - 1 - self.start[0]],
            true => [self.start[0] - i64::from(sides[1]) + 1, self.start[0] - i64::from(sides[0])],
        };
        let steps = (first - 1).max(0)..=last.min(self.steps());
        (!steps.is_empty()).then_some(steps)
    }

    /// [x, y] of major and minor coordinates, as steps and pixels from the first end.
    pub(super) fn pixel(&self, step: i64, minor: i64) -> [i64; 2] {
        let (u, v) = (self.start[0] + step * self.du.signum(), self.start[1] + minor);
        if self.steep { [v, u] } else { [u, v] }
    }

    /// The minor coordinate after `step` steps, from the first end: the pixel below the line, and
    /// what remains, as a share of [`Line::steps`].
    pub(super) fn below(&self, step: i64) -> (i64, i64) {
        let length = self.steps().max(1);
        if let Some(along) = step.checked_mul(self.dv) {
            return (along.div_euclid(length), along.rem_euclid(length));
        }
        let (along, length) = (i128::from(step) * i128::from(self.dv), i128::from(length));
        // No more than the sides of the line.
        (along.div_euclid(length) as i64, along.rem_euclid(length) as i64)
    }

    /// As [`Line::below`], rounded to the nearest pixel.
    pub(super) fn nearest(&self, step: i64, tie: LineTie) -> i64 {
        let (below, rest) = self.below(step);
        let up = match (2 * rest).cmp(&self.steps()) {
            std::cmp::Ordering::Less => false,
            std::cmp::Ordering::Equal => self.steps() > 0 && tie.rises(self, self.start[1] + below),
            std::cmp::Ordering::Greater => true,
        };
        below + i64::from(up)
    }
}

/// Sides of more pixels than this are not walked.
const MOST_STEPS: i64 = 1 << 13;

/// As [`super::shape::Shape::trace`]: the pixels whose corner lies in the closed triangle, and the three sides.
/// Corners are multiples of a pixel.
pub(super) fn trace(points: &Points, tie: LineTie, window: PixelRect, emit: Emit<'_>) -> bool {
    let pixels = points.map_array(|p| p.map_array(|v| v.div_euclid(256)));
    let lines = edges(&pixels).map_array(|[from, to]| Line::new(from, to));
    if lines.iter().any(|line| line.steps() > MOST_STEPS) {
        return false;
    }
    half_planes::at(0, 0).trace(points, window, &mut |x, y, _| emit(x, y, Place::In));
    for line in lines {
        for step in 0..=line.steps() {
            let [x, y] = line.pixel(step, line.nearest(step, tie)).map_array(|v| v as i32);
            if window.contains(x, y) {
                emit(x, y, Place::In);
            }
        }
    }
    true
}
