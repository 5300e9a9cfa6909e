//! Exact signs for the checks: which side of an edge a sample lies on, and who owns a tie.
//!
//! A rule for ties is a direction in which every sample is nudged by an amount smaller than any
//! number, and by the square of that amount in a second direction. Then no sample lies on an edge.
//! Neither engine and not the oracle works this way: they round up, add a bias, count crossings.

use rasterproof_core::geometry::{centre, pixel_box, twice_area};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;

/// Unit roundoff of f64.
pub const U: f64 = f64::EPSILON / 2.0;

/// Where samples are nudged: by eps along `first`, by eps squared along `second`.
#[derive(Clone, Copy, Debug)]
pub struct Nudge {
    pub first: [i32; 2],
    /// Decides where an edge runs along `first`.
    pub second: [i32; 2],
}

/// Right, then down: a left edge takes its samples in, and so does a top edge.
pub const TOP_LEFT: Nudge = Nudge { first: [1, 0], second: [0, 1] };

/// dx (y - a.y) - dy (x - a.x) for the edge from a to b: positive on its inner side if the corners
/// go round clockwise on the screen. Below 2^66 for all inputs.
pub fn edge(a: SubpixelPoint, b: SubpixelPoint, x_sub: i64, y_sub: i64) -> i128 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i128::from);
    (bx - ax) * (i128::from(y_sub) - ay) - (by - ay) * (i128::from(x_sub) - ax)
}

/// The corners in clockwise order, or nothing for a triangle of zero area.
pub fn clockwise(corners: &Corners) -> Option<Corners> {
    let [a, b, c] = *corners;
    match twice_area(corners).signum() {
        0 => None,
        1 => Some([a, b, c]),
        _ => Some([a, c, b]),
    }
}

/// The functions of the three edges at the centre of a pixel, each positive on the inside of a clockwise triangle.
pub fn edges([a, b, c]: &Corners, x_px: i32, y_px: i32) -> [i128; 3] {
    let (x, y) = (centre(x_px), centre(y_px));
    [edge(*b, *c, x, y), edge(*c, *a, x, y), edge(*a, *b, x, y)]
}

/// Whether the centre of a pixel belongs to a triangle of either winding, by the rule that a nudge of the samples stands for.
#[must_use]
pub fn owns(corners: &Corners, x_px: i32, y_px: i32, nudge: Nudge) -> bool {
    let Some([a, b, c]) = clockwise(corners) else { return false };
    let side = |a: SubpixelPoint, b: SubpixelPoint| {
        let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
        let grows = |[nx, ny]: [i32; 2]| i128::from(dx * i64::from(ny) - dy * i64::from(nx));
        // The edge function at the nudged sample, as a polynomial in eps: the first coefficient
        // that is not zero decides.
        let terms =
            [edge(a, b, centre(x_px), centre(y_px)), grows(nudge.first), grows(nudge.second)];
        terms.into_iter().find(|&term| term != 0).is_some_and(|term| term > 0)
    };
    side(a, b) && side(b, c) && side(c, a)
}

/// How often a closed polygon goes round the centre of a pixel, clockwise counted positive, with
/// the samples nudged as by [`TOP_LEFT`].
pub fn winding(ring: &[SubpixelPoint], x_px: i32, y_px: i32) -> i32 {
    let (x, y) = (centre(x_px), centre(y_px));
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(&a, &b)| {
            // A nudged sample is below every end at its own height, and right of every crossing
            // at its own column.
            match (i64::from(a.y) <= y, i64::from(b.y) <= y) {
                (true, false) => -i32::from(edge(a, b, x, y) <= 0),
                (false, true) => i32::from(edge(b, a, x, y) <= 0),
                _ => 0,
            }
        })
        .sum()
}

/// The pixels of `window` whose squares touch the bounding box of the points.
pub fn around(points: &[SubpixelPoint], window: PixelRect) -> PixelRect {
    pixel_box(points, 0).intersect(&window)
}

/// The pixels of a window, row after row.
pub fn pixels(rect: PixelRect) -> impl Iterator<Item = (i32, i32)> {
    (rect.y0..rect.y1).flat_map(move |y_px| (rect.x0..rect.x1).map(move |x_px| (x_px, y_px)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::geometry::centre_of;

    /// The square 0.5..2.5 px: the corner centre belongs to the top-left rule's side only.
    #[test]
    fn owners_by_hand() {
        let p = centre_of;
        let half = [p(0, 0), p(2, 0), p(2, 2)];
        let owned = |nudge| {
            let all = pixels(PixelRect::window(4, 4));
            all.filter(|&(x, y)| owns(&half, x, y, nudge)).collect::<Vec<_>>()
        };
        assert_eq!(owned(TOP_LEFT), [(0, 0), (1, 0), (1, 1)]);
        let bottom_right = Nudge { first: [-1, 0], second: [0, -1] };
        assert_eq!(owned(bottom_right), [(2, 1)]);
    }

    #[test]
    fn winding_by_hand() {
        let p = centre_of;
        let square = [p(0, 0), p(2, 0), p(2, 2), p(0, 2)];
        let inside: Vec<_> =
            pixels(PixelRect::window(4, 4)).filter(|&(x, y)| winding(&square, x, y) == 1).collect();
        assert_eq!(inside, [(0, 0), (1, 0), (0, 1), (1, 1)]);
        let mut back = square;
        back.reverse();
        assert_eq!(winding(&back, 1, 1), -1);
    }
}
