//! The sign of an orientation, and counts at a point between two vertices, all in exact arithmetic.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};

use super::{Point, Triangle};
use crate::oracle::rational::edge_value;
use crate::oracle::values::take_apart;

/// On which side of the line from `a` to `b` the point `c` lies: `Greater` on the left (counterclockwise where y points
/// up), `Equal` on the line. All coordinates are finite.
pub(super) fn orientation(a: Point, b: Point, c: Point) -> Ordering {
    let left = (b[0] - a[0]) * (c[1] - a[1]);
    let right = (b[1] - a[1]) * (c[0] - a[0]);
    let (value, size) = (left - right, left.abs() + right.abs());
    // With u = 2^-53, either product is within 3.01 u of its exact value, relatively, so that `value` has the wrong
    // sign only up to 3.02 u `size`; 4 u is twice the EPSILON of Rust. What underflows adds 2^-1074 at most, which the
    // remaining 0.9 u `size` exceeds; an overflow makes `size` infinite.
    if size > 1e-250 && size < f64::INFINITY && value.abs() > 2.0 * f64::EPSILON * size {
        return value.total_cmp(&0.0);
    }
    in_128_bits([a, b, c]).unwrap_or_else(|| edge_value(a, b, c).0)
}

/// The orientation where all coordinates are multiples below 2^61 of one power of two: differences are below 2^62, their
/// products below 2^124.
fn in_128_bits(points: [Point; 3]) -> Option<Ordering> {
    let parts = points.map(|point| point.map(take_apart));
    let nonzero = || parts.as_flattened().iter().filter(|(mantissa, _)| *mantissa != 0);
    let unit = nonzero().map(|&(_, exponent)| exponent).min().unwrap_or(0);
    let fits = |&(mantissa, exponent): &(i64, i32)| {
        i64::from(exponent) - i64::from(unit) + i64::from(64 - mantissa.abs().leading_zeros()) <= 61
    };
    if !nonzero().all(fits) {
        return None;
    }
    let whole = |(mantissa, exponent): (i64, i32)| match mantissa {
        0 => 0,
        _ => i128::from(mantissa) << (exponent - unit),
    };
    let [a, b, c] = parts.map(|point| point.map(whole));
    Some(((b[0] - a[0]) * (c[1] - a[1])).cmp(&((b[1] - a[1]) * (c[0] - a[0]))))
}

/// What covers the two sides of a piece of a line, next to one point inside it.
pub(super) struct Sides {
    /// The point, rounded.
    pub near: Point,
    /// The triangles on the left of the piece and on its right.
    pub covering: [Vec<usize>; 2],
    /// Whether the region is on the left of the piece and on its right.
    pub is_inside: [bool; 2],
}

/// Looks at both sides of the piece between `ends`, the lower one in the order of x and then y first. Triangles are
/// counterclockwise and have areas; `boundary` has the region on its left.
pub(super) fn sides(
    ends: [Point; 2],
    triangles: &[(usize, Triangle)],
    boundary: &[[Point; 2]],
) -> Sides {
    // A point between the ends at 1/2, 1/4, 3/4, 1/8 and so on of the way. An edge that is not on the line of the piece
    // contains one of these points at most, so the search ends.
    let mut bits = 1_u32;
    let mut part = 1_u64;
    loop {
        let frame = Frame::new(ends, bits, part, triangles, boundary);
        let is_free = |edge: &[Big; 2]| frame.side(edge) != Sign::NoSign || frame.is_along(edge);
        if frame.triangles.iter().flatten().chain(&frame.boundary).all(is_free) {
            return frame.count(ends, f64::from(part as u32) / 2_f64.powi(bits as i32), triangles);
        }
        part += 2;
        if part >> bits > 0 {
            (bits, part) = (bits + 1, 1);
        }
    }
}

type Big = [BigInt; 2];

/// Everything in multiples of one unit, so that a point between two vertices is a whole one, too.
struct Frame {
    ends: [Big; 2],
    point: Big,
    triangles: Vec<[[Big; 2]; 3]>,
    boundary: Vec<[Big; 2]>,
}

impl Frame {
    fn new(
        ends: [Point; 2],
        bits: u32,
        part: u64,
        triangles: &[(usize, Triangle)],
        boundary: &[[Point; 2]],
    ) -> Self {
        let corners = triangles.iter().flat_map(|(_, corners)| corners);
        let all = corners.chain(boundary.as_flattened()).chain(&ends).flatten();
        let unit = all.map(|&value| take_apart(value).1).min().unwrap_or(0);
        let whole = |value: f64| -> BigInt {
            let (mantissa, exponent) = take_apart(value);
            let shift = if mantissa == 0 { 0 } else { exponent - unit };
            BigInt::from(mantissa) << (shift as u32 + bits)
        };
        let big = |point: Point| point.map(whole);
        let [start, end] = ends.map(big);
        let between = |axis: usize| &start[axis] + ((&end[axis] - &start[axis]) >> bits) * part;
        Self {
            point: [between(0), between(1)],
            ends: [start.clone(), end.clone()],
            triangles: triangles
                .iter()
                .map(|&(_, [a, b, c])| [[a, b], [b, c], [c, a]].map(|edge| edge.map(big)))
                .collect(),
            boundary: boundary.iter().map(|edge| edge.map(big)).collect(),
        }
    }

    /// On which side of an edge the point lies.
    fn side(&self, [a, b]: &[Big; 2]) -> Sign {
        cross(a, b, &self.point)
    }

    fn is_along(&self, edge: &[Big; 2]) -> bool {
        edge.iter().all(|point| cross(&self.ends[0], &self.ends[1], point) == Sign::NoSign)
    }

    fn count(&self, ends: [Point; 2], part: f64, triangles: &[(usize, Triangle)]) -> Sides {
        // Beside the point, an edge on the line of the piece has its left side where the piece has it, or opposite.
        let contains = |[a, b]: &[Big; 2], is_left: bool| match self.side(&[a.clone(), b.clone()]) {
            Sign::NoSign => (a < b) == is_left,
            sign => sign == Sign::Plus,
        };
        let covering = |is_left: bool| {
            let inside = self
                .triangles
                .iter()
                .zip(triangles)
                .filter(|(edges, _)| edges.iter().all(|edge| contains(edge, is_left)));
            inside.map(|(_, &(number, _))| number).collect()
        };
        // Straight down from the point, edges to the right have the region above them, edges to the left below them.
        let is_inside = |is_left: bool| {
            let rounds = self.boundary.iter().map(|[a, b]| {
                let (low, high, round) = if a < b { (a, b, 1) } else { (b, a, -1) };
                let is_passed = *low <= self.point
                    && self.point < *high
                    && contains(&[low.clone(), high.clone()], is_left);
                if is_passed { round } else { 0 }
            });
            rounds.sum::<i32>() > 0
        };
        let [start, end] = ends;
        Sides {
            // Halves first, since the difference of two large numbers overflows.
            near: [0, 1].map(|axis| start[axis] * (1.0 - part) + end[axis] * part),
            covering: [covering(true), covering(false)],
            is_inside: [is_inside(true), is_inside(false)],
        }
    }
}

fn cross(a: &Big, b: &Big, c: &Big) -> Sign {
    ((&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])).sign()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::unsnapped::nudge_f64;

    /// Every path gives the same sign: the filter, 128 bits, and big integers.
    #[test]
    fn orientations_by_hand() {
        let tiny = f64::from_bits(1);
        for (points, expected) in [
            ([[0.0, 0.0], [4.0, 0.0], [1.0, 1.0]], Ordering::Greater),
            ([[0.0, 0.0], [4.0, 0.0], [1.0, -1.0]], Ordering::Less),
            ([[0.0, 0.0], [3.0, 3.0], [1.0, 1.0]], Ordering::Equal),
            ([[0.0, 0.0], [3.0, 3.0], [1.0, nudge_f64(1.0, 1)]], Ordering::Greater),
            ([[0.0, 0.0], [3.0, 3.0], [nudge_f64(1.0, 1), 1.0]], Ordering::Less),
            ([[0.0, 0.0], [1.0, 0.0], [0.5, tiny]], Ordering::Greater),
            ([[0.0, 0.0], [tiny, 0.0], [tiny, tiny]], Ordering::Greater),
            ([[0.0, 0.0], [1e300, 1e300], [1e-300, 2e-300]], Ordering::Greater),
            ([[-1e308, 0.0], [1e308, 1e308], [1e308, -1e308]], Ordering::Less),
        ] {
            let [a, b, c] = points;
            assert_eq!(orientation(a, b, c), expected, "{points:?}");
            assert_eq!(orientation(b, c, a), expected, "{points:?}");
            assert_eq!(orientation(b, a, c), expected.reverse(), "{points:?}");
            assert_eq!(edge_value(a, b, c).0, expected, "{points:?}");
        }
    }
}
