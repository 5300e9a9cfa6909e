//! Specimens: the triangle of the book as chapter 2 draws it (part 1, section 2.2, DrawTriangle2D)
//! and as chapter 3 does (sections 3.2.4 and 3.2.5), which has no clamp.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptoms: columns run from the truncated left edge to the right edge inclusive, so shared edges and the row
//! of the middle corner are drawn twice; the edges start at the corner's x without a step to the row's sample,
//! so row y shows the edge at y + the fraction of its start; the sum of slopes drifts; twice the area below
//! 1e-15 counts as none, above it as some. Without the clamp a flat edge that crosses a row boundary leaves the
//! triangle by thousands of pixels (figure 2-4). Chapter 3 adds values by equal steps: the first pixel of a row
//! gets the value at the crossing, and the steps down the edges ignore the fraction of the start as well.

use glam::DVec2;

use super::{
    BookScreen, Columns, DrawResult, Fragments, MOST_STEPS, NoResult, Published, RealTriangle,
    Spans, int_loop, to_int,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};

/// DrawTriangle2D of section 2.2: with the clamp.
#[derive(Clone, Copy, Debug)]
pub struct BookChapter2;

/// The fill of chapter 3: the same loops without the clamp, and with values.
#[derive(Clone, Copy, Debug)]
pub struct BookChapter3;

/// Below this twice the area counts as none.
pub(super) const AREA_LIMIT: f64 = 1e-15;

pub(super) fn twice_area([a, b, c]: [DVec2; 3]) -> f64 {
    a.x * b.y + b.x * c.y + c.x * a.y - a.x * c.y - b.x * a.y - c.x * b.y
}

/// The corners from the lowest up, by three exchanges of neighbours: `order[k]` is the number of
/// the corner at place k.
pub(super) fn sorted(corners: [DVec2; 3]) -> [usize; 3] {
    geometry::sorted([0, 1, 2], |&i: &usize, &j: &usize| corners[i].y > corners[j].y)
}

/// One side of a half: where x starts, where it ends, and how much it grows with each row.
#[derive(Clone, Copy, Debug)]
struct Side {
    start: DVec2,
    end: DVec2,
    /// Infinite or NaN where the side is flat; its sign decides the clamp.
    per_row: f64,
}

impl Side {
    fn new(start: DVec2, end: DVec2) -> Self {
        Self { start, end, per_row: (start.x - end.x) / (start.y - end.y) }
    }

    /// Holds x at the end of the side, in the direction it moves.
    fn clamp(self, x: f64) -> f64 {
        // A NaN slope, and one of zero, does not clamp.
        if self.per_row < 0.0 {
            if x > self.end.x { x } else { self.end.x }
        } else if self.per_row > 0.0 {
            if x < self.end.x { x } else { self.end.x }
        } else {
            x
        }
    }
}

/// A row of a half: `half` is 0 below the middle corner and 1 above.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub half: usize,
    pub y: i64,
    /// Where the sides cross the row, in pixels.
    pub left: f64,
    pub right: f64,
}

/// Walks the rows between the corners `low`, `left`, `right` (the two at the middle's height) and
/// `high`, from the truncated start of each half up to the window's last row.
pub(super) fn walk(
    [low, left, right, high]: [DVec2; 4],
    clamped: bool,
    rows: i64,
    mut visit: impl FnMut(Row) -> Result<(), NoResult>,
) -> Result<(), NoResult> {
    let halves = [
        (Side::new(low, left), Side::new(low, right)),
        (Side::new(left, high), Side::new(right, high)),
    ];
    for (half, (left, right)) in halves.into_iter().enumerate() {
        let first = to_int(left.start.y)?;
        if (-first) as f64 > MOST_STEPS {
            return Err(NoResult::TooFar(-first as f64));
        }
        let (mut left_x, mut right_x) = (left.start.x, right.start.x);
        let mut y = first;
        while (y as f64) < left.end.y && y < rows {
            if clamped {
                (left_x, right_x) = (left.clamp(left_x), right.clamp(right_x));
            }
            visit(Row { half, y, left: left_x, right: right_x })?;
            left_x += left.per_row;
            right_x += right.per_row;
            y += 1;
        }
    }
    Ok(())
}

/// The point of the long edge at the middle corner's height, and the share of the way up to it.
pub(super) fn split(low: DVec2, middle: DVec2, high: DVec2) -> (DVec2, f64) {
    let share = (middle.y - low.y) / (high.y - low.y);
    (DVec2::new((high.x - low.x) * share + low.x, middle.y), share)
}

/// Draws a triangle given in the book's own coordinates: y up, the whole numbers are samples, (0, 0)
/// is the window's lower left pixel. The published algorithm itself, without any conversion.
pub fn cover_book(
    corners: [DVec2; 3],
    bounds: PixelRect,
    clamped: bool,
    mut emit: impl FnMut(Span),
) -> Result<(), NoResult> {
    let screen = BookScreen { bounds };
    if twice_area(corners).abs() < AREA_LIMIT {
        return Ok(());
    }
    let [low, middle, high] = sorted(corners).map_array(|i| corners[i]);
    let (split, _) = split(low, middle, high);
    let (left, right) = if middle.x > split.x { (split, middle) } else { (middle, split) };
    walk([low, left, right, high], clamped, screen.size().1, |row| {
        if let Some((first, last)) = int_loop(row.left, row.right)? {
            screen.span(row.y, first, last).into_iter().for_each(&mut emit);
        }
        Ok(())
    })
}

fn cover(
    triangle: &RealTriangle,
    bounds: PixelRect,
    clamped: bool,
    emit: impl FnMut(Span),
) -> Result<(), NoResult> {
    let screen = BookScreen { bounds };
    cover_book(triangle.map_array(|v| screen.position(v.position_px)), bounds, clamped, emit)
}

impl BookChapter2 {
    /// As [`Published::cover`], compiled for its caller: `cost` times it beside choices that are.
    pub fn cover_inlined(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: impl FnMut(Span),
    ) -> Result<(), NoResult> {
        cover(triangle, bounds, true, emit)
    }
}

impl Published for BookChapter2 {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        cover(triangle, bounds, true, emit)
    }

    fn has_values(&self) -> bool {
        false
    }
}

impl Published for BookChapter3 {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        cover(triangle, bounds, false, emit)
    }

    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        let screen = BookScreen { bounds };
        let corners = triangle.map_array(|v| ValuedVertex {
            at: screen.position(v.position_px),
            value: v.varying.extend(v.depth),
        });
        let positions = corners.map_array(|corner| corner.at);
        if twice_area(positions).abs() < AREA_LIMIT {
            return Ok(());
        }
        let [low, middle, high] = sorted(positions).map_array(|i| corners[i]);
        let (at, share) = split(low.at, middle.at, high.at);
        let split = ValuedVertex { at, value: (high.value - low.value) * share + low.value };
        let (left, right) =
            if middle.at.x > split.at.x { (split, middle) } else { (middle, split) };
        let starts = [(low, low), (left, right)];
        let ends = [(left, right), (high, high)];
        let per_row =
            |from: ValuedVertex, to: ValuedVertex| (from.value - to.value) / (from.at.y - to.at.y);
        // Values at the ends of the row, and the half they belong to.
        let mut columns = Columns::default();
        let mut state = (usize::MAX, low.value, low.value);
        walk([low.at, left.at, right.at, high.at], false, screen.size().1, |row| {
            if state.0 != row.half {
                let (left, right) = starts[row.half];
                state = (row.half, left.value, right.value);
            }
            let (_, from, to) = state;
            let step = (to - from) / (row.right - row.left);
            if let Some((first, last)) = int_loop(row.left, row.right)? {
                let in_window = screen.span(row.y, first, last);
                if let Some(Span { y_px, .. }) = in_window {
                    columns.add(first)?;
                    let mut value = from;
                    for x in first..=last.min(screen.size().0 - 1) {
                        if x >= 0 {
                            let (x_px, _) = screen.pixel(x, row.y);
                            let (depth, varying) = (value.z, value.truncate());
                            emit(Fragment { x_px, y_px, depth, varying });
                        }
                        value += step;
                    }
                }
            }
            let ((left, right), (left_end, right_end)) = (starts[row.half], ends[row.half]);
            state.1 += per_row(left, left_end);
            state.2 += per_row(right, right_end);
            Ok(())
        })
    }
}

/// A corner with the value that travels: depth and two attributes, all treated alike.
#[derive(Clone, Copy)]
struct ValuedVertex {
    at: DVec2,
    value: glam::DVec3,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls of SetPixel outside a screen of 64 x 64, and the columns they reach.
    fn calls_outside(corners: [[f64; 2]; 3], clamped: bool) -> (i64, i64, i64) {
        let corners = corners.map(DVec2::from_array);
        let [low, middle, high] = sorted(corners).map(|i| corners[i]);
        let (split, _) = split(low, middle, high);
        let (left, right) = if middle.x > split.x { (split, middle) } else { (middle, split) };
        let (mut outside, mut lowest, mut highest) = (0, i64::MAX, i64::MIN);
        walk([low, left, right, high], clamped, i64::MAX, |row| {
            if let Some((first, last)) = int_loop(row.left, row.right)? {
                let inside =
                    if (0..64).contains(&row.y) { last.min(63) - first.max(0) + 1 } else { 0 };
                outside += last - first + 1 - inside.max(0);
                (lowest, highest) = (lowest.min(first), highest.max(last));
            }
            Ok(())
        })
        .unwrap();
        (outside, lowest, highest)
    }

    /// Recorded as `oob` and `ch3_unclamped` in `tests/data/book-bugs.json`.
    #[test]
    fn calls_outside_the_screen_as_recorded() {
        let (outside, _, _) = calls_outside([[-5.0, -5.0], [5.0, -5.0], [-5.0, 5.0]], true);
        assert_eq!(outside, 64);
        let flat = [[4.25, 2.99999], [3.5, 3.00001], [5.05, 3.00001]];
        assert_eq!(calls_outside(flat, false), (77_436, -37_495, 40_004));
        assert_eq!(calls_outside(flat, true), (0, 3, 5));
    }
}
