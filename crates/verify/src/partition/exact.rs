//! The sign of an orientation, and counts at a point between two vertices, all in exact arithmetic.

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::{Point, Triangle, key, order};
use crate::oracle::rational::edge_value;
use crate::oracle::values::take_apart;
use rasterproof_core::arrays::MapArray as _;

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
    let parts = points.map_array(|point| point.map_array(take_apart));
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
    let [a, b, c] = parts.map_array(|point| point.map_array(whole));
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
    // On which side of an edge all points between the ends lie; nothing where the edge passes between them.
    let side = |[a, b]: [Point; 2]| match ends.map_array(|end| orientation(a, b, end)) {
        [one, Ordering::Equal] => Some(one),
        [one, other] if one == other || one.is_eq() => Some(other),
        _ => None,
    };
    let mut edges: Vec<[Point; 2]> =
        triangles.iter().flat_map(|&(_, [a, b, c])| [[a, b], [b, c], [c, a]]).collect();
    edges.extend(boundary);
    let sides: Vec<Option<Ordering>> = edges.iter().map(|&edge| side(edge)).collect();
    let sides = || edges.iter().copied().zip(sides.iter().copied());
    let values = edges.iter().chain([&ends]).flatten().flatten();
    let unit = values.map(|&value| take_apart(value).1).min().unwrap_or(0);
    let mut frame = Frame::new(ends, unit, 1, 1);
    // A point between the ends at 1/2, 1/4, 3/4, 1/8 and so on of the way. An edge that is not on the line of the piece
    // contains one of these points at most, so the search ends.
    while sides().any(|(edge, side)| side.is_none() && frame.side(edge).is_eq()) {
        let Frame { bits, part, .. } = frame;
        frame = match (part + 2) >> bits {
            0 => Frame::new(ends, unit, bits, part + 2),
            _ => Frame::new(ends, unit, bits + 1, 1),
        };
    }
    // Whether an edge has on its left what lies beside the point, on the left of the piece and on its right.
    let beside = sides().map(|([a, b], side)| match side.unwrap_or_else(|| frame.side([a, b])) {
        Ordering::Equal => [true, false].map(|is_left| order(&key(a), &key(b)).is_lt() == is_left),
        side => [side.is_gt(); 2],
    });
    let beside: Vec<[bool; 2]> = beside.collect();
    let (of_triangles, of_boundary) = beside.split_at(3 * triangles.len());
    let covering = |which: usize| {
        let inside = of_triangles.chunks(3).zip(triangles);
        let inside = inside.filter(|(edges, _)| edges.iter().all(|beside| beside[which]));
        inside.map(|(_, &(number, _))| number).collect()
    };
    // Straight down from the point, edges to the right have the region above them, edges to the left below them.
    let is_inside = |which: usize| {
        let rounds = boundary.iter().zip(of_boundary).map(|(&[a, b], beside)| {
            let goes_on = order(&key(a), &key(b)).is_lt();
            let (low, high, round) = if goes_on { (a, b, 1) } else { (b, a, -1) };
            let is_above = beside[which] == goes_on;
            if is_above && frame.follows(low) && !frame.follows(high) { round } else { 0 }
        });
        rounds.sum::<i32>() > 0
    };
    let ([start, end], part) = (ends, frame.part as f64 / 2_f64.powi(frame.bits as i32));
    Sides {
        // Halves first, since the difference of two large numbers overflows.
        near: [0, 1].map(|axis| start[axis] * (1.0 - part) + end[axis] * part),
        covering: [covering(0), covering(1)],
        is_inside: [is_inside(0), is_inside(1)],
    }
}

type Big = [BigInt; 2];

/// A point between two vertices, in multiples of a unit in which it and all vertices are whole.
struct Frame {
    ends: [Point; 2],
    unit: i32,
    bits: u32,
    part: u64,
    point: Big,
}

impl Frame {
    fn new(ends: [Point; 2], unit: i32, bits: u32, part: u64) -> Self {
        let mut frame = Self { ends, unit, bits, part, point: Big::default() };
        let [start, end] = ends.map(|end| frame.big(end));
        frame.point = [0, 1].map(|i| &start[i] + ((&end[i] - &start[i]) >> bits) * part);
        frame
    }

    fn big(&self, point: Point) -> Big {
        point.map(|value| {
            let (mantissa, exponent) = take_apart(value);
            let shift = if mantissa == 0 { 0 } else { exponent - self.unit };
            BigInt::from(mantissa) << (shift as u32 + self.bits)
        })
    }

    /// On which side of an edge the point lies.
    fn side(&self, [a, b]: [Point; 2]) -> Ordering {
        let ([a, b], c) = ([self.big(a), self.big(b)], &self.point);
        ((&b[0] - &a[0]) * (&c[1] - &a[1])).cmp(&((&b[1] - &a[1]) * (&c[0] - &a[0])))
    }

    /// Whether the point is this one or comes after it, by x and then by y. Those between which it lies say so of most.
    fn follows(&self, point: Point) -> bool {
        let [start, end] = self.ends.map(|end| order(&key(point), &key(end)));
        start.is_le() || (end.is_lt() && self.big(point) <= self.point)
    }
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
