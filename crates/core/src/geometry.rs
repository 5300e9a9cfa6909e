//! What all code around the engines computes of the corners of a triangle.
//!
//! The engines and the exact oracle do not use this module. They are compared with each other, so each has this arithmetic
//! for itself, and a mistake here shows as a difference.

use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use crate::triangle::Corners;

/// The six orders of three corners: the three that keep the winding come first.
pub const ORDERS: [[usize; 3]; 6] =
    [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// The corners of a square around a point and the middles of its sides, from -1 to 1, once around.
pub const AROUND: [[f64; 2]; 8] = [
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
    [1.0, 0.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [-1.0, 1.0],
    [-1.0, 0.0],
];

/// Twice the signed area in square subpixels: positive where the corners run clockwise on a screen with y down. If the third
/// corner is a sample, the sign says on which side of the edge from the first to the second it lies.
///
/// ```
/// use rasterproof_core::geometry::twice_area;
/// use rasterproof_core::grid::SubpixelPoint as P;
/// let [a, b, c] = [P::new(0, 0), P::new(256, 0), P::new(0, 256)];
/// assert_eq!(twice_area(&[a, b, c]), 65_536);
/// assert_eq!(twice_area(&[a, c, b]), -65_536);
/// ```
#[must_use]
#[inline]
pub fn twice_area(&[a, b, c]: &Corners) -> i128 {
    // Differences of two `i32` fit in 33 bits, and their products only in 66.
    let (abx, aby) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
    let (acx, acy) = (i64::from(c.x) - i64::from(a.x), i64::from(c.y) - i64::from(a.y));
    i128::from(abx) * i128::from(acy) - i128::from(aby) * i128::from(acx)
}

/// The centre of a column or a row of pixels, in subpixels.
#[must_use]
#[inline]
pub fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// The centre of a pixel. A pixel outside the domain, which has no centre on the grid, gets a point near the end of the
/// domain on its side.
#[must_use]
#[inline]
pub fn centre_of(x_px: i32, y_px: i32) -> SubpixelPoint {
    let on_grid = |px: i32| px.saturating_mul(SUBPIXELS).saturating_add(HALF_PIXEL);
    SubpixelPoint::new(on_grid(x_px), on_grid(y_px))
}

/// The pixels whose squares the bounding box of some points touches, with `margin_px` more on each side; of no points,
/// those around the origin.
#[must_use]
pub fn pixel_box(points: &[SubpixelPoint], margin_px: i32) -> PixelRect {
    let mut least = points.first().map_or([0, 0], |p| [p.x, p.y]);
    let mut most = least;
    for p in points {
        least = [least[0].min(p.x), least[1].min(p.y)];
        most = [most[0].max(p.x), most[1].max(p.y)];
    }
    let first = |sub: i32| sub.div_euclid(SUBPIXELS) - margin_px;
    let end = |sub: i32| sub.div_euclid(SUBPIXELS) + 1 + margin_px;
    PixelRect { x0: first(least[0]), y0: first(least[1]), x1: end(most[0]), y1: end(most[1]) }
}

/// Three things in order, by three comparisons of neighbours; those of which neither is after the other stay as they were.
/// The sort of the standard library is compiled anew for each type and each order.
#[must_use]
#[inline]
pub fn sorted<T>(mut three: [T; 3], mut is_after: impl FnMut(&T, &T) -> bool) -> [T; 3] {
    for first in [0, 1, 0] {
        if is_after(&three[first], &three[first + 1]) {
            three.swap(first, first + 1);
        }
    }
    three
}

/// The greatest whole number that divides both, not negative; of 0 and 0 it is 0. Of the two sides of a line it says whether the
/// line passes halfway between pixels.
#[must_use]
pub fn greatest_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { greatest_divisor(b, a % b) }
}

/// An edge of a triangle, in its direction.
pub type Edge = [SubpixelPoint; 2];

/// The edges of a triangle, in the order of its corners.
#[must_use]
pub fn edges(&[a, b, c]: &Corners) -> [Edge; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Whether the interiors of all triangles are disjoint and none is degenerate: for convex shapes
/// iff an edge of one of the two separates them.
#[must_use]
pub fn is_disjoint(list: &[Corners]) -> bool {
    let separates = |one: &Corners, other: &Corners| {
        let inside = twice_area(one).signum();
        edges(one)
            .iter()
            .any(|[a, b]| other.iter().all(|p| twice_area(&[*a, *b, *p]) * inside <= 0))
    };
    list.iter().all(|t| twice_area(t) != 0)
        && list
            .iter()
            .enumerate()
            .all(|(i, a)| list[..i].iter().all(|b| separates(a, b) || separates(b, a)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_and_boxes_by_hand() {
        assert_eq!([centre(0), centre(-1), centre(2)], [128, -128, 640]);
        assert_eq!(centre_of(2, -1), SubpixelPoint::new(640, -128));
        assert_eq!(centre_of(i32::MAX, i32::MIN), SubpixelPoint::new(i32::MAX, i32::MIN + 128));
        let corners = [(255, 0), (-1, 256), (512, 100)].map(|(x, y)| SubpixelPoint::new(x, y));
        assert_eq!(pixel_box(&corners, 0), PixelRect { x0: -1, y0: 0, x1: 3, y1: 2 });
        assert_eq!(pixel_box(&corners, 1), PixelRect { x0: -2, y0: -1, x1: 4, y1: 3 });
    }

    /// The ends of the domain, where a difference needs 33 bits and the area 66.
    #[test]
    fn areas_do_not_overflow() {
        let [low, high] = [i32::MIN, i32::MAX];
        let corners = [(low, low), (high, low), (low, high)].map(|(x, y)| SubpixelPoint::new(x, y));
        let side = i128::from(high) - i128::from(low);
        assert_eq!(
            ORDERS.map(|order| twice_area(&order.map(|i| corners[i])).signum()),
            [1, 1, 1, -1, -1, -1]
        );
        assert_eq!(twice_area(&corners), side * side);
    }

    #[test]
    fn divisors_by_hand() {
        let pairs = [(12, 18), (-12, 18), (18, -12), (7, 0), (0, -7), (0, 0), (5, 7)];
        assert_eq!(pairs.map(|(a, b)| greatest_divisor(a, b)), [6, 6, 6, 7, 7, 0, 1]);
    }

    /// As the stable sort of the standard library, for all that three things can be.
    #[test]
    fn three_are_sorted() {
        for number in 0..27 {
            let three = [number / 9, number / 3 % 3, number % 3];
            let named = [(three[0], 'a'), (three[1], 'b'), (three[2], 'c')];
            let mut expected = named;
            expected.sort_by_key(|(key, _)| *key);
            assert_eq!(sorted(named, |a, b| a.0 > b.0), expected);
        }
    }

    #[test]
    fn overlap_is_noticed() {
        let p = |x: i32, y: i32| SubpixelPoint::new(x * 256, y * 256);
        let (a, b, c, d) = (p(1, 1), p(7, 1), p(7, 7), p(1, 7));
        assert!(is_disjoint(&[[a, b, c], [a, c, d]]));
        assert!(is_disjoint(&[[c, b, a]]), "the winding does not matter");
        assert!(!is_disjoint(&[[a, b, c], [a, c, d], [b, p(5, 2), c]]));
        assert!(!is_disjoint(&[[a, b, b]]), "degenerate");
    }
}
