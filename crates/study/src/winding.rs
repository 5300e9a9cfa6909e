//! The winding of a triangle before its corners are snapped and after.

/// What snapping does to a triangle that has an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    None,
    /// It is wound the other way round.
    Over,
    /// It has no area left.
    Flat,
}

/// What doubles may be off in a sum of two products, in the sum of their sizes.
const OFF: f64 = 4.0 * f64::EPSILON;

/// Twice the area of three points, and 0 where doubles cannot tell its sign.
pub(crate) fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let (p, q) = ((b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1]));
    if (p - q).abs() > OFF * (p.abs() + q.abs()) { p - q } else { 0.0 }
}

/// What snapping does to a triangle, by its corners before, which may be off by `off_px`, and the sign of its area after.
pub(crate) fn change(given: [[f64; 2]; 3], off_px: f64, snapped: f64) -> Change {
    let [a, b, c] = given;
    let length = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| (ax - bx).abs() + (ay - by).abs();
    let around = length(a, b) + length(b, c) + length(c, a);
    let given = area(given);
    match snapped {
        // Seen from its edge, it has no winding that snapping could change.
        _ if given.abs() <= 2.0 * off_px * around => Change::None,
        0.0 => Change::Flat,
        sign if sign.signum() == given.signum() => Change::None,
        _ => Change::Over,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::arrays::MapArray as _;
    use rasterproof_core::geometry::twice_area;
    use rasterproof_core::grid::SubpixelPoint;

    #[test]
    fn thin_triangles_are_turned_or_flattened() {
        let of = |third: [f64; 2], off_px: f64| {
            let given = [[0.0, 0.0], [9.0, 5.0], third];
            let snapped = given.map_array(|[x, y]| {
                let [x, y] = [x, y].map(|at: f64| (at * 256.0).round_ties_even() as i32);
                SubpixelPoint::new(x, y)
            });
            change(given, off_px, twice_area(&snapped) as f64)
        };
        assert_eq!(of([4.0, 3.0], 0.0), Change::None);
        // To the left of the long edge by some millionths of a pixel, and snapped to its other side.
        let third = [4.065_213_2, 2.258_452];
        assert_eq!(of(third, 0.0), Change::Over);
        assert_eq!(of(third, 1e-6), Change::None, "seen from its edge, as far as doubles tell");
        assert_eq!(of([4.5, 2.501], 0.0), Change::Flat);
        assert_eq!(of([4.5, 2.5], 0.0), Change::None, "no area from the beginning");
    }
}
