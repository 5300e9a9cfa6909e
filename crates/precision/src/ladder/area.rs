//! The exact shares of all pixels that a triangle covers, row by row: the reference of antialiasing.
//!
//! The share of one pixel is that of [`rasterproof_verify::oracle::area`]. Here the numbers of an edge are computed once for a row, and
//! pixels that are covered whole are one run.

use std::ops::Range;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SUBPIXEL_BITS, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::oracle::area::share;

const S: i64 = SUBPIXELS as i64;

/// Whether all numbers of a [`Part`] fit 64 bits, and its denominator is below what [`share`] takes without `BigInt`.
fn is_narrow([a, b]: [[i64; 2]; 2]) -> bool {
    let (dx, dy) = ((a[0] - b[0]).abs(), (a[1] - b[1]).abs());
    dx.max(dy) < 1 << 20 && 2 * dx * dy < 1 << 36
}

/// A narrow edge within a row of pixels, column by column.
struct Part {
    /// Of the edge within the row, with its sign.
    height: i64,
    /// n at the upper and the lower end, as seen from column 0.
    ends: [i64; 2],
    dx: i64,
    dy: i64,
}

impl Part {
    fn new([from, to]: [[i64; 2]; 2], y_px: i32) -> Self {
        let (sign, a, b) = if from[1] <= to[1] { (1, from, to) } else { (-1, to, from) };
        let top = i64::from(y_px) * S;
        let (y0, y1) = (a[1].max(top), b[1].min(top + S));
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let n = |y: i64| a[0] * dy + (y - a[1]) * dx;
        Self { height: sign * (y1 - y0).max(0), ends: [n(y0), n(y1)], dx, dy }
    }

    fn right_of(&self, x_px: i32) -> (i64, i64) {
        let &Self { height, ends: [n0, n1], dx, dy } = self;
        let (left, all) = (i64::from(x_px) * S * dy, S * dy);
        let (n0, n1) = (n0 - left, n1 - left);
        if height == 0 || n0.min(n1) >= all {
            return (0, 1);
        }
        if n0.max(n1) <= 0 {
            return (S * height, 1);
        }
        if dx == 0 {
            return ((all - n0) / dy * height, 1);
        }
        let p = |n: i64| {
            if n < all { 2 * all * n - n.max(0) * n } else { all * all }
        };
        let sign = height.signum() * dx.signum();
        (sign * (p(n1) - p(n0)), 2 * dy * dx.abs())
    }
}

/// The same bits as those of [`share`].
fn sum(parts: &[Part; 3], x_px: i32) -> f64 {
    let [(n0, d0), (n1, d1), (n2, d2)] = parts.each_ref().map_array(|part| part.right_of(x_px));
    let area = S * S;
    // Mostly one edge alone passes through a pixel, and the others are whole numbers.
    let most = d0.max(d1).max(d2);
    if d0 + d1 + d2 - most == 2 {
        let share = |n: i64, d: i64| if d == 1 { n * most } else { n };
        let n = share(n0, d0) + share(n1, d1) + share(n2, d2);
        return n.abs() as f64 / (most * area) as f64;
    }
    let [d0, d1, d2] = [d0, d1, d2].map_array(i128::from);
    let n = i128::from(n0) * d1 * d2 + i128::from(n1) * d0 * d2 + i128::from(n2) * d0 * d1;
    n.unsigned_abs() as f64 / (d0 * d1 * d2 * i128::from(area)) as f64
}

/// Emits (columns, row, share) for the pixels of `bounds` that the triangle covers in part, one by one, and whole, as one run.
pub fn shares(corners: &Corners, bounds: PixelRect, mut emit: impl FnMut(Range<i32>, i32, f64)) {
    let range = |v: [i32; 3]| {
        let [a, b, c] = v;
        let end = i64::from(a.max(b).max(c)) + S - 1;
        (a.min(b).min(c) >> SUBPIXEL_BITS, (end >> SUBPIXEL_BITS) as i32)
    };
    let (x0, x1) = range(corners.map_array(|p| p.x));
    let (y0, y1) = range(corners.map_array(|p| p.y));
    let rect = PixelRect { x0, y0, x1, y1 }.intersect(&bounds);
    let [a, b, c] = corners.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
    let side = |[a, b]: [[i64; 2]; 2], x: i64, y: i64| {
        i128::from(b[0] - a[0]) * i128::from(y - a[1])
            - i128::from(b[1] - a[1]) * i128::from(x - a[0])
    };
    let area = side([a, b], c[0], c[1]);
    if area == 0 || rect.is_empty() {
        return;
    }
    let edges = if area > 0 { [[a, b], [b, c], [c, a]] } else { [[a, c], [c, b], [b, a]] };
    let is_narrow = edges.into_iter().all(is_narrow);
    for y_px in rect.y0..rect.y1 {
        let parts = is_narrow.then(|| edges.map_array(|edge| Part::new(edge, y_px)));
        let (mut touched, mut whole) = ([rect.x0, rect.x1], [rect.x0, rect.x1]);
        for edge in edges {
            cut(&mut touched, edge, y_px, false);
            cut(&mut whole, edge, y_px, true);
        }
        let [from, to] = if whole[0] < whole[1] { whole } else { [touched[1]; 2] };
        for columns in [touched[0]..from, to..touched[1]] {
            for x_px in columns {
                let share = match &parts {
                    Some(parts) => sum(parts, x_px),
                    None => share(corners, x_px, y_px),
                };
                if share > 0.0 {
                    emit(x_px..x_px + 1, y_px, share);
                }
            }
        }
        if from < to {
            emit(from..to, y_px, 1.0);
        }
    }
}

/// Keeps of a row's columns those whose pixels have all corners strictly inside of an edge, or at least one.
///
/// Twice the area that a point spans with the edge is linear in x, so the corner that decides is the
/// same in the whole row, and one division finds the column where the sign changes.
fn cut(columns: &mut [i32; 2], [a, b]: [[i64; 2]; 2], y_px: i32, all: bool) {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let deciding = |grows: bool, px: i64| if grows != all { (px + 1) * S } else { px * S };
    let height = deciding(dx > 0, i64::from(y_px)) - a[1];
    let side = i128::from(dx) * i128::from(height);
    if dy == 0 {
        if side <= 0 {
            columns[1] = columns[0];
        }
        return;
    }
    // The corner of column 0, seen from a: inside where dy x < side, for x = shift + S column.
    let shift = deciding(dy < 0, 0) - a[0];
    let rest = side - i128::from(dy) * i128::from(shift);
    let step = i128::from(dy) * i128::from(S);
    let quotient = |n: i128, d: i128| match (i64::try_from(n), i64::try_from(d)) {
        (Ok(n), Ok(d)) => i128::from(n.div_euclid(d)),
        _ => n.div_euclid(d),
    };
    let [low, high] = columns.map_array(i128::from);
    // Positive steps: the columns before the quotient rounded up; negative ones: those after it.
    if dy > 0 {
        columns[1] = (-quotient(-rest, step)).clamp(low, high) as i32;
    } else {
        columns[0] = (quotient(-rest, -step) + 1).clamp(low, high) as i32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::random::Rng;

    fn corners(points: [[i32; 2]; 3]) -> Corners {
        points.map(|[x, y]| SubpixelPoint::new(x, y))
    }

    /// The shares of a triangle add up to its area, exactly up to the final roundings; either
    /// winding; and the wide denominators agree with the narrow ones.
    #[test]
    fn shares_add_up() {
        for index in 0..300 {
            let mut rng = Rng::new("area", 1, index);
            let reach = [300, 4000, 1 << 15][index as usize % 3];
            let [a, b, c] = [(); 3].map(|()| [rng.int(0, reach) as i32, rng.int(0, reach) as i32]);
            let window = PixelRect::window(129, 129);
            let sum = |corners: &Corners, window| {
                let mut sum = 0.0;
                shares(corners, window, |columns, y, share_here| {
                    assert!(share_here <= 1.0);
                    for x in columns {
                        assert_eq!(share_here, share(corners, x, y));
                        sum += share_here;
                    }
                });
                sum
            };
            let area = |[a, b, c]: [[i32; 2]; 3]| {
                let [a, b, c] = [a, b, c].map(|p| p.map(f64::from));
                ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() / 131_072.0
            };
            let there = sum(&corners([a, b, c]), window);
            assert_eq!(there, sum(&corners([a, c, b]), window), "winding");
            // Windows beside each other, one of which may have nothing of the triangle.
            let parts = [(0, 3), (3, 60), (60, 129)]
                .map(|(x0, x1)| sum(&corners([a, b, c]), PixelRect { x0, x1, ..window }));
            assert!(
                (there - parts.iter().sum::<f64>()).abs() <= there * 1e-12,
                "{a:?} {b:?} {c:?}"
            );
            assert!((there - area([a, b, c])).abs() <= there * 1e-12, "{a:?} {b:?} {c:?}");
        }
    }
}
