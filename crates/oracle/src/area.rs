//! The exact share of a pixel that a triangle covers.
//!
//! Source: Green's theorem, as scan converters of fonts use it, in whole numbers. Let an edge go down
//! through a band of heights H of the pixel, from x0 to x1, and g(x) = S - x held to [0, S] be the
//! width of the pixel to its right. The area to its right is the integral of g over the height, which
//! is H / (x1 - x0) times the integral of g over x. With x as a whole number n of 1/dy and the
//! antiderivative P of g,
//!
//! area = (P(n1) - P(n0)) / (2 dy dx), since n1 - n0 = H dx.
//!
//! Edges that go down count with one sign and edges that go up with the other. The sum of the three
//! fractions is exact; only its quotient is rounded. It does not clip polygons, and it has no use
//! for a rule about samples on edges, since they have no area.

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::triangle::Corners;

const S: i64 = SUBPIXELS as i64;

/// The share of pixel (x, y) that the triangle covers, in [0, 1], either winding; exact but for the
/// rounding of numerator, denominator and quotient, at most 3 units of 2^-53.
#[must_use]
pub fn share(corners: &Corners, x_px: i32, y_px: i32) -> f64 {
    // The corners as seen from the upper left corner of the pixel.
    let seen = |sub: i32, px: i32| i64::from(sub) - i64::from(px) * S;
    let [a, b, c] = corners.map_array(|p| [seen(p.x, x_px), seen(p.y, y_px)]);
    let parts = [right_of(a, b), right_of(b, c), right_of(c, a)];
    let [(n0, d0), (n1, d1), (n2, d2)] = parts;
    // Each part is at most S^2 = 2^16, so the product of the denominators and 18 bits must fit.
    let product = d0.checked_mul(d1).and_then(|d| d.checked_mul(d2));
    if let Some(all) = product.filter(|all| *all < 1 << 108) {
        let sum = n0 * d1 * d2 + n1 * d0 * d2 + n2 * d0 * d1;
        return sum.unsigned_abs() as f64 / (all * i128::from(S * S)) as f64;
    }
    let [(n0, d0), (n1, d1), (n2, d2)] =
        parts.map_array(|(n, d)| (BigInt::from(n), BigInt::from(d)));
    let sum = n0 * &d1 * &d2 + n1 * &d0 * &d2 + n2 * &d0 * &d1;
    // Both have some 200 bits, which a float holds.
    let [sum, all] = [sum, d0 * d1 * d2 * BigInt::from(S * S)].map_array(|v| v.to_f64());
    sum.zip(all).map_or(0.0, |(sum, all)| (sum / all).abs())
}

/// The signed area to the right of an edge within the pixel [0, S) x [0, S), as a fraction.
fn right_of(from: [i64; 2], to: [i64; 2]) -> (i128, i128) {
    let (sign, a, b) = if from[1] <= to[1] { (1, from, to) } else { (-1, to, from) };
    let (y0, y1) = (a[1].max(0), b[1].min(S));
    if y0 >= y1 {
        return (0, 1);
    }
    let (dx, dy) = (i128::from(b[0] - a[0]), i128::from(b[1] - a[1]));
    if dx == 0 {
        let width = (S - a[0]).clamp(0, S);
        return (sign * i128::from(width * (y1 - y0)), 1);
    }
    let s = i128::from(S);
    let [n0, n1] = [y0, y1].map_array(|y| i128::from(a[0]) * dy + i128::from(y - a[1]) * dx);
    // Edges that pass by the pixel are whole numbers, which are not rounded.
    if n0.max(n1) <= 0 || n0.min(n1) >= s * dy {
        let width = if n0 < s * dy { s } else { 0 };
        return (sign * width * i128::from(y1 - y0), 1);
    }
    let (numerator, denominator) = (antiderivative(n1, dy) - antiderivative(n0, dy), 2 * dy * dx);
    if denominator < 0 {
        (-sign * numerator, -denominator)
    } else {
        (sign * numerator, denominator)
    }
}

/// Twice dy squared times the antiderivative of g.
fn antiderivative(n: i128, dy: i128) -> i128 {
    let s = i128::from(S);
    if n <= 0 {
        2 * s * n * dy
    } else if n < s * dy {
        2 * s * n * dy - n * n
    } else {
        s * s * dy * dy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    fn corners(points: [[i32; 2]; 3]) -> Corners {
        points.map(|[x, y]| SubpixelPoint::new(x, y))
    }

    #[test]
    fn shares_by_hand() {
        let half = corners([[0, 0], [256, 0], [0, 256]]);
        assert_eq!(share(&half, 0, 0), 0.5);
        assert_eq!((share(&half, 1, 0), share(&half, 0, 1), share(&half, -1, 0)), (0.0, 0.0, 0.0));
        // The legs are two pixels: a whole pixel and three corners of it.
        let large = corners([[0, 0], [512, 0], [0, 512]]);
        assert_eq!(
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| share(&large, x, y)),
            [1.0, 0.5, 0.5, 0.0]
        );
        // A column an eighth of a pixel wide within one pixel, cut off above and below by others.
        let thin = corners([[64, -2560], [96, -2560], [64, 1 << 20]]);
        let width = |y: f64| 32.0 * (1.0 - (y + 2560.0) / f64::from((1 << 20) + 2560));
        assert!((share(&thin, 0, 0) * 256.0 - width(128.0)).abs() < 1e-9);
    }
}
