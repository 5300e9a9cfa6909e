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
    // The least exponent of what is not 0.
    let mut unit = i32::MAX;
    for &(mantissa, exponent) in parts.as_flattened() {
        if mantissa != 0 {
            unit = unit.min(exponent);
        }
    }
    for &(mantissa, exponent) in parts.as_flattened() {
        let bits = i64::from(64 - mantissa.abs().leading_zeros());
        if mantissa != 0 && i64::from(exponent) - i64::from(unit) + bits > 61 {
            return None;
        }
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
    let mut edges = Vec::with_capacity(3 * triangles.len() + boundary.len());
    for &(_, [a, b, c]) in triangles {
        edges.extend([[a, b], [b, c], [c, a]]);
    }
    edges.extend_from_slice(boundary);
    // The largest power of two of which all coordinates are multiples.
    let mut unit = i32::MAX;
    for value in edges.iter().chain([&ends]).flatten().flatten() {
        unit = unit.min(take_apart(*value).1);
    }
    let mut frame = Frame::new(ends, unit, 1, 1);
    let mut left_of = Vec::with_capacity(edges.len());
    for &edge in &edges {
        left_of.push(side_of_edge(edge, ends));
    }
    // A point between the ends at 1/2, 1/4, 3/4, 1/8 and so on of the way. An edge that is not on the line of the piece
    // contains one of these points at most, so the search ends.
    while frame.is_on_any(&edges, &left_of) {
        let Frame { bits, part, .. } = frame;
        frame = match (part + 2) >> bits {
            0 => Frame::new(ends, unit, bits, part + 2),
            _ => Frame::new(ends, unit, bits + 1, 1),
        };
    }
    // Whether an edge has on its left what lies beside the point, on the left of the piece and on its right.
    let mut beside = Vec::with_capacity(edges.len());
    for (&[a, b], side) in edges.iter().zip(left_of) {
        beside.push(match side.unwrap_or_else(|| frame.side([a, b])) {
            // The edge runs along the piece.
            Ordering::Equal => {
                let is_along = order(&key(a), &key(b)).is_lt();
                [is_along, !is_along]
            }
            side => [side.is_gt(); 2],
        });
    }
    let (of_triangles, of_boundary) = beside.split_at(3 * triangles.len());
    let mut sides =
        Sides { near: frame.rounded(), covering: Default::default(), is_inside: [false; 2] };
    for which in 0..2 {
        for (edges, &(number, _)) in of_triangles.chunks(3).zip(triangles) {
            if edges.iter().all(|beside| beside[which]) {
                sides.covering[which].push(number);
            }
        }
        // Straight down from the point, edges to the right have the region above them, edges to the left below them.
        let mut rounds = 0;
        for (&[a, b], beside) in boundary.iter().zip(of_boundary) {
            let goes_on = order(&key(a), &key(b)).is_lt();
            let (low, high) = if goes_on { (a, b) } else { (b, a) };
            let is_above = beside[which] == goes_on;
            if is_above && frame.follows(low) && !frame.follows(high) {
                rounds += if goes_on { 1 } else { -1 };
            }
        }
        sides.is_inside[which] = rounds > 0;
    }
    sides
}

/// On which side of an edge all points between two ends lie; nothing where the edge passes between them.
fn side_of_edge([a, b]: [Point; 2], ends: [Point; 2]) -> Option<Ordering> {
    match [orientation(a, b, ends[0]), orientation(a, b, ends[1])] {
        [one, Ordering::Equal] => Some(one),
        [one, other] if one == other || one.is_eq() => Some(other),
        _ => None,
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
        let ([x0, y0], [x1, y1]) = (frame.big(ends[0]), frame.big(ends[1]));
        frame.point = [&x0 + ((x1 - &x0) >> bits) * part, &y0 + ((y1 - &y0) >> bits) * part];
        frame
    }

    fn big(&self, point: Point) -> Big {
        point.map_array(|value| {
            let (mantissa, exponent) = take_apart(value);
            let shift = if mantissa == 0 { 0 } else { exponent - self.unit };
            BigInt::from(mantissa) << (shift as u32 + self.bits)
        })
    }

    /// Whether the point lies on an edge of which its side is not known yet.
    fn is_on_any(&self, edges: &[[Point; 2]], sides: &[Option<Ordering>]) -> bool {
        edges.iter().zip(sides).any(|(edge, side)| side.is_none() && self.side(*edge).is_eq())
    }

    /// The point in floats. Halves come first, since the difference of two large numbers overflows.
    fn rounded(&self) -> Point {
        let ([start, end], part) = (self.ends, self.part as f64 / 2_f64.powi(self.bits as i32));
        [0, 1].map_array(|axis: usize| start[axis] * (1.0 - part) + end[axis] * part)
    }

    /// On which side of an edge the point lies.
    fn side(&self, [a, b]: [Point; 2]) -> Ordering {
        let ([a, b], c) = ([self.big(a), self.big(b)], &self.point);
        ((&b[0] - &a[0]) * (&c[1] - &a[1])).cmp(&((&b[1] - &a[1]) * (&c[0] - &a[0])))
    }

    /// Whether the point is this one or comes after it, by x and then by y. Those between which it lies say so of most.
    fn follows(&self, point: Point) -> bool {
        let [start, end] = self.ends.map_array(|end| order(&key(point), &key(end)));
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
