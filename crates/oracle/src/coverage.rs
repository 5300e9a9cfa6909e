//! Exact coverage by the parity of crossings (the even-odd rule for a point in a polygon).
//!
//! The top-left rule is a statement about a sample that has been nudged: move it right by eps and
//! down by eps^2, where eps is smaller than any number, and no sample lies on an edge any more.
//! A sample on a left edge moves inside, one on a top edge too, one on a right or bottom edge moves
//! out. For the nudged sample (x + eps, y + eps^2), an end point (px, py) of an edge lies above it
//! iff py <= y, and an edge whose ends lie on different sides crosses its height left of it iff the
//! crossing at y is <= x. An odd number of crossings to the left means inside.

use super::Oracle;
use rasterproof_core::contract::Rasterize;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Span};

impl Rasterize for Oracle {
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        let rect = around(&corners).intersect(&bounds);
        if rect.is_empty() {
            return;
        }
        // Products of differences stay below 2^61 while both the triangle and the samples tested
        // lie within 2^29 subpixels of the origin; the samples lie within a pixel of the triangle.
        let near = corners
            .iter()
            .all(|corner| corner.x.unsigned_abs().max(corner.y.unsigned_abs()) < 1 << 29);
        if near {
            scan(&corners, rect, |a, b| a * b, emit);
        } else {
            scan(&corners, rect, |a, b| i128::from(a) * i128::from(b), emit);
        }
    }
}

/// All pixels whose squares touch the bounding box of the corners.
fn around(corners: &Corners) -> PixelRect {
    let low = |sub: i32| sub.div_euclid(SUBPIXELS);
    let xs = corners.map(|corner| low(corner.x));
    let ys = corners.map(|corner| low(corner.y));
    let ends =
        |v: [i32; 3]| (v.into_iter().min().unwrap_or(0), v.into_iter().max().unwrap_or(0) + 1);
    let ((x0, x1), (y0, y1)) = (ends(xs), ends(ys));
    PixelRect { x0, y0, x1, y1 }
}

fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// Tests the samples of `rect` one by one; `times` multiplies in a word that cannot overflow.
fn scan<T: Copy + PartialOrd>(
    corners: &Corners,
    rect: PixelRect,
    times: impl Fn(i64, i64) -> T,
    mut emit: impl FnMut(Span),
) {
    for y_px in rect.y0..rect.y1 {
        let y = centre(y_px);
        // Keep the edges that cross the height of the nudged samples, upper end first.
        let crossing = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| {
            let (a, b) = (corners[i], corners[j]);
            match (i64::from(a.y) <= y, i64::from(b.y) <= y) {
                (true, false) => Some(LeftOf::new(a, b, y, &times)),
                (false, true) => Some(LeftOf::new(b, a, y, &times)),
                _ => None,
            }
        });
        let mut start = None;
        for x_px in rect.x0..rect.x1 {
            let x = centre(x_px);
            let left = crossing.iter().flatten().filter(|edge| edge.of(x, &times)).count();
            match (left % 2 == 1, start) {
                (true, None) => start = Some(x_px),
                (false, Some(x0_px)) => {
                    emit(Span { y_px, x0_px, x1_px: x_px });
                    start = None;
                }
                _ => {}
            }
        }
        if let Some(x0_px) = start {
            emit(Span { y_px, x0_px, x1_px: rect.x1 });
        }
    }
}

/// An edge that crosses the current height.
struct LeftOf<T> {
    x: i64,
    dy: i64,
    down_dx: T,
}

impl<T: Copy + PartialOrd> LeftOf<T> {
    fn new(
        upper: SubpixelPoint,
        lower: SubpixelPoint,
        y: i64,
        times: &impl Fn(i64, i64) -> T,
    ) -> Self {
        let (dx, dy) =
            (i64::from(lower.x) - i64::from(upper.x), i64::from(lower.y) - i64::from(upper.y));
        Self { x: i64::from(upper.x), dy, down_dx: times(y - i64::from(upper.y), dx) }
    }

    /// Whether the crossing is at or left of x: upper.x + down dx / dy <= x, times dy.
    fn of(&self, x: i64, times: &impl Fn(i64, i64) -> T) -> bool {
        self.down_dx <= times(x - self.x, self.dy)
    }
}

/// How many samples of `bounds` lie exactly on the boundary of the triangle: the ties, where a
/// wrong rule shows.
#[must_use]
pub fn samples_on_boundary(corners: &Corners, bounds: PixelRect) -> u64 {
    // Each edge without its second end, so that a corner counts once.
    [(0, 1), (1, 2), (2, 0)]
        .map(|(i, j)| samples_on_edge(corners[i], corners[j], bounds))
        .into_iter()
        .sum()
}

fn samples_on_edge(a: SubpixelPoint, b: SubpixelPoint, bounds: PixelRect) -> u64 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i64::from);
    let is_second_end = |x: i64, y: i64| (x, y) == (bx, by);
    if ay == by {
        if (ay - i64::from(HALF_PIXEL)).rem_euclid(i64::from(SUBPIXELS)) != 0
            || !(bounds.y0..bounds.y1).contains(&((ay >> 8) as i32))
        {
            return 0;
        }
        let (low, high) = (ax.min(bx) >> 8, ax.max(bx) >> 8);
        return (low.max(i64::from(bounds.x0))..=high.min(i64::from(bounds.x1) - 1))
            .map(|x_px| x_px * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL))
            .filter(|&x| x >= ax.min(bx) && x <= ax.max(bx) && !is_second_end(x, ay))
            .count() as u64;
    }
    let (low, high) = (ay.min(by) >> 8, ay.max(by) >> 8);
    (low.max(i64::from(bounds.y0))..=high.min(i64::from(bounds.y1) - 1))
        .filter(|&y_px| {
            let y = y_px * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
            if y < ay.min(by) || y > ay.max(by) {
                return false;
            }
            let (across, dy) = (i128::from(y - ay) * i128::from(bx - ax), i128::from(by - ay));
            if across % dy != 0 {
                return false;
            }
            let x = ax + (across / dy) as i64;
            (x - i64::from(HALF_PIXEL)).rem_euclid(i64::from(SUBPIXELS)) == 0
                && (i64::from(bounds.x0)..i64::from(bounds.x1)).contains(&(x >> 8))
                && !is_second_end(x, y)
        })
        .count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x_px: f64, y_px: f64) -> SubpixelPoint {
        SubpixelPoint::from_px(x_px, y_px).unwrap()
    }

    /// The square with corners on centres 0.5 and 4.5: 4 x 4 samples belong, worked out by hand:
    /// the top row and the left column do, the bottom row and the right column do not.
    #[test]
    fn top_left_by_hand() {
        let [a, b, c, d] =
            [(0.5, 0.5), (4.5, 0.5), (4.5, 4.5), (0.5, 4.5)].map(|(x, y)| point(x, y));
        let mut spans = Vec::new();
        Oracle
            .cover([a, b, c], PixelRect::window(8, 8), |s| spans.push((s.y_px, s.x0_px, s.x1_px)));
        assert_eq!(spans, [(0, 0, 4), (1, 1, 4), (2, 2, 4), (3, 3, 4)]);
        spans.clear();
        Oracle
            .cover([a, c, d], PixelRect::window(8, 8), |s| spans.push((s.y_px, s.x0_px, s.x1_px)));
        assert_eq!(spans, [(1, 0, 1), (2, 0, 2), (3, 0, 3)]);
    }

    #[test]
    fn boundary_by_hand() {
        let window = PixelRect::window(8, 8);
        let triangle = [point(0.5, 0.5), point(4.5, 0.5), point(4.5, 4.5)];
        // Five samples on each side, the three corners shared.
        assert_eq!(samples_on_boundary(&triangle, window), 12);
        assert_eq!(
            samples_on_boundary(&triangle.map(|p| SubpixelPoint::new(p.x + 1, p.y + 2)), window),
            0
        );
        assert_eq!(samples_on_boundary(&triangle, PixelRect::window(3, 8)), 5);
    }
}
