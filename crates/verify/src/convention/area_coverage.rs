//! The exact share of a pixel's area that lies in a triangle.
//!
//! A triangle's area within a box is a sum over its edges: walking an edge downward adds, walking it
//! upward takes away, the area between the box's left border and the edge (its x held to the box).
//! Each term is a fraction over twice the edge's height and width, so the sum is one fraction.

use super::place::{Emit, Place, Points, around, edges, turn};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

/// Corners within this many subpixels of each other keep every product within i128.
const MOST_EXTENT: i64 = 1 << 15;

/// A fraction with a positive denominator.
#[derive(Clone, Copy)]
struct Fraction(i128, i128);

impl Fraction {
    fn plus(self, other: Self) -> Self {
        Self(self.0 * other.1 + other.0 * self.1, self.1 * other.1)
    }
}

/// Twice the signed area between the line x = 0 and the edge from `p` to `q`, the latter's x held
/// to 0..=256 and its y to 0..=256.
fn under(p: [i64; 2], q: [i64; 2]) -> Fraction {
    let (dx, dy) = (i128::from(q[0] - p[0]), i128::from(q[1] - p[1]));
    if dy == 0 {
        return Fraction(0, 1);
    }
    let [px, py, qy] = [p[0], p[1], q[1]].map_array(i128::from);
    let (low, high) = (py.min(qy).max(0), py.max(qy).min(256));
    if low >= high {
        return Fraction(0, 1);
    }
    let sign = dy.signum();
    let height = dy.abs();
    if dx == 0 {
        return Fraction(2 * sign * px.clamp(0, 256) * (high - low), 1);
    }
    let width = dx.abs();
    // Heights where the edge meets x = 0 and x = 256, times the width.
    let at = |x: i128| py * width + (x - px) * dx.signum() * dy;
    let (low, high) = (low * width, high * width);
    let (zero, full) = (at(0).clamp(low, high), at(256).clamp(low, high));
    // Where the edge is right of the box, all of the box's width; where it is left, nothing.
    let right_of_box = if (dx > 0) == (dy > 0) { high - full } else { full - low };
    // Between, a trapezoid. Times the height, x = (px dy + (y - py) dx) / dy.
    let (from, to) = (zero.min(full), zero.max(full));
    let x = |y: i128| sign * (px * dy + (y - py * width) * dx.signum());
    let middle = (x(from) + x(to)) * (to - from);
    // x is over the height, heights are over the width.
    Fraction(sign * (middle + 2 * 256 * right_of_box * height), height * width)
}

/// Twice the area of the triangle in the box of one pixel at `corner`, as a fraction.
fn twice_area(points: &Points, corner: [i64; 2]) -> Fraction {
    let at = points.map_array(|p| [p[0] - corner[0], p[1] - corner[1]]);
    let [a, b, c] = edges(&at).map_array(|[p, q]| under(p, q));
    let Fraction(n, d) = a.plus(b).plus(c);
    // Clockwise on the screen goes down on its right side: that adds.
    Fraction(n * turn(points).signum(), d)
}

/// Whether an edge has the triangle on one side and the pixel at `corner` on the other: a quick way
/// to most pixels that have no share.
fn apart(points: &Points, corner: [i64; 2]) -> bool {
    let sign = turn(points).signum() as i64;
    edges(points).into_iter().any(|[p, q]| {
        let (a, b) = (sign * (p[1] - q[1]), sign * (q[0] - p[0]));
        // The corner of the pixel that lies farthest inside.
        let far =
            [(a, 0), (b, 1)].map_array(|(v, axis)| corner[axis] + if v > 0 { 256 } else { 0 });
        a * (far[0] - p[0]) + b * (far[1] - p[1]) <= 0
    })
}

/// As [`super::shape::Shape::trace`].
pub(super) fn trace(
    points: &Points,
    [x, y]: [i32; 2],
    percent: i32,
    window: PixelRect,
    emit: Emit<'_>,
) -> bool {
    let rect = around(points, 2);
    if i64::from(rect.width().max(rect.height())) * 256 > MOST_EXTENT {
        return false;
    }
    let rect = rect.intersect(&window);
    for y_px in rect.y0..rect.y1 {
        for x_px in rect.x0..rect.x1 {
            let corner =
                [(x_px, x), (y_px, y)].map_array(|(px, at)| i64::from(px * 256 + at - 128));
            if apart(points, corner) {
                continue;
            }
            let Fraction(n, d) = twice_area(points, corner);
            match (100 * n).cmp(&(i128::from(percent) * 2 * 65536 * d)) {
                std::cmp::Ordering::Greater => emit(x_px, y_px, Place::In),
                std::cmp::Ordering::Equal => emit(x_px, y_px, Place::Level),
                std::cmp::Ordering::Less => {}
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked out on paper.
    #[test]
    fn shares_by_hand() {
        let area = |points: Points, corner| {
            let Fraction(n, d) = twice_area(&points, corner);
            assert_eq!(n % d, 0, "{n}/{d}");
            n / d
        };
        // Half of a pixel, either winding.
        let half = [[0, 0], [256, 0], [0, 256]];
        assert_eq!(area(half, [0, 0]), 65536);
        assert_eq!(area([half[0], half[2], half[1]], [0, 0]), 65536);
        // A triangle of 2 x 2 px covers one pixel in full, two by half.
        let two = [[0, 0], [512, 0], [0, 512]];
        for (corner, twice) in [([0, 0], 131_072), ([256, 0], 65536), ([0, 256], 65536)] {
            assert_eq!(area(two, corner), twice, "{corner:?}");
        }
        assert_eq!(area(two, [256, 256]), 0);
        assert_eq!(area(two, [-256, 0]), 0);
        // A slope of 1 to 2 through a box: a triangle of 256 x 128.
        assert_eq!(area([[0, 0], [512, 256], [0, 256]], [0, 0]), 2 * 65536 - 256 * 128);
        assert_eq!(area([[0, 0], [512, 256], [0, 256]], [256, 0]), 256 * 128);
        // All pixels together hold the triangle.
        let any = [[33, 20], [900, 333], [211, 1100]];
        let all = (0..6)
            .flat_map(|y| (0..6).map(move |x| [x * 256, y * 256]))
            .map(|corner| twice_area(&any, corner))
            .map(|Fraction(n, d)| n as f64 / d as f64)
            .sum::<f64>();
        assert!((all - turn(&any) as f64).abs() < 1e-3, "{all}");
    }
}
