//! The boundary of the region that a polygon describes.

use std::cmp::Ordering;
use std::error::Error;
use std::fmt;

use super::exact::orientation;
use super::{FillRule, Point, Polygon, key};

/// Why a polygon describes no region whose boundary has vertices of the polygon alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum InvalidPolygon {
    /// A coordinate is infinite or not a number.
    NotFinite(Point),
    /// Two edges cross at a point that is no vertex of the polygon.
    Crossing([[Point; 2]; 2]),
}

impl fmt::Display for InvalidPolygon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite([x, y]) => write!(
                f,
                "the vertex ({x}, {y}) of the polygon is not finite; expected finite coordinates"
            ),
            Self::Crossing([[a, b], [c, d]]) => write!(
                f,
                "the edges {a:?} to {b:?} and {c:?} to {d:?} of the polygon cross; expected edges that meet at \
                 vertices of the polygon alone, so add the crossing as a vertex of one of them"
            ),
        }
    }
}

impl Error for InvalidPolygon {}

/// What a polygon describes.
pub(super) struct Region {
    /// The boundary, cut at every vertex of the polygon that lies on it, with the region on the left of each edge.
    pub boundary: Vec<[Point; 2]>,
    /// The fewest and the most times that the contours run around a point, counterclockwise.
    pub rounds: [i64; 2],
}

pub(super) fn region(polygon: &Polygon, rule: FillRule) -> Result<Region, InvalidPolygon> {
    for &point in polygon.contours.iter().flatten() {
        if !point[0].is_finite() || !point[1].is_finite() {
            return Err(InvalidPolygon::NotFinite(key(point)));
        }
    }
    let points = super::distinct(&polygon.contours);
    let pieces = pieces(polygon, &points);
    let net = Net { points: &points, pieces };
    if let Some(crossing) = net.crossing() {
        return Err(crossing);
    }
    let mut boundary = Vec::new();
    let mut rounds = [0; 2];
    for &([low, high], along) in net.pieces.iter().filter(|(_, along)| *along != 0) {
        let below = net.rounds_below([low, high]);
        let ends = [points[low], points[high]];
        // Across a piece the number changes by how often contours run along it.
        let above = below + along;
        rounds = [rounds[0].min(below).min(above), rounds[1].max(below).max(above)];
        match (rule.fills(below), rule.fills(above)) {
            (false, true) => boundary.push(ends),
            (true, false) => boundary.push([ends[1], ends[0]]),
            _ => {}
        }
    }
    Ok(Region { boundary, rounds })
}

/// A piece of an edge by the numbers of its ends, the lower one first, and how often contours run along it minus how
/// often they run against it.
type Piece = ([usize; 2], i64);

/// All edges, cut at all vertices that lie on them, each piece once.
fn pieces(polygon: &Polygon, points: &[Point]) -> Vec<Piece> {
    let number = |&point: &Point| points.partition_point(|p| super::order(p, &key(point)).is_lt());
    let mut cut = Vec::new();
    for contour in &polygon.contours {
        let numbers: Vec<usize> = contour.iter().map(number).collect();
        for (i, &from) in numbers.iter().enumerate() {
            let to = numbers[(i + 1) % numbers.len()];
            let (low, high, along) = if from < to { (from, to, 1) } else { (to, from, -1) };
            if low == high {
                continue;
            }
            // Points are in order, so one on the line is on the edge if its number is between.
            let mut last = low;
            for between in low + 1..high {
                if is_in_rows(points, [low, high], between)
                    && orientation(points[low], points[high], points[between]).is_eq()
                {
                    cut.push(([last, between], along));
                    last = between;
                }
            }
            cut.push(([last, high], along));
        }
    }
    cut.sort_unstable();
    let mut pieces: Vec<Piece> = Vec::new();
    for (ends, along) in cut {
        match pieces.last_mut() {
            Some(last) if last.0 == ends => last.1 += along,
            _ => pieces.push((ends, along)),
        }
    }
    pieces
}

/// Whether a point is between the ends of an edge in y.
fn is_in_rows(points: &[Point], [low, high]: [usize; 2], point: usize) -> bool {
    let (a, b, y) = (points[low][1], points[high][1], points[point][1]);
    a.min(b) <= y && y <= a.max(b)
}

struct Net<'a> {
    points: &'a [Point],
    /// In order of their ends.
    pieces: Vec<Piece>,
}

impl Net<'_> {
    fn side(&self, [a, b]: [usize; 2], c: usize) -> Ordering {
        orientation(self.points[a], self.points[b], self.points[c])
    }

    /// Two pieces that cross. No vertex is inside a piece, so they cross where each has its ends on both sides of the other.
    fn crossing(&self) -> Option<InvalidPolygon> {
        for (i, &(one, _)) in self.pieces.iter().enumerate() {
            for &(other, _) in &self.pieces[i + 1..] {
                // Later pieces begin beyond this one.
                if other[0] >= one[1] {
                    break;
                }
                let meets = one.iter().any(|end| other.contains(end));
                if !meets
                    && !self.is_apart(one, other)
                    && self.splits(one, other)
                    && self.splits(other, one)
                {
                    return Some(InvalidPolygon::Crossing([self.ends(one), self.ends(other)]));
                }
            }
        }
        None
    }

    fn ends(&self, piece: [usize; 2]) -> [Point; 2] {
        [self.points[piece[0]], self.points[piece[1]]]
    }

    /// Whether one piece lies above the other.
    fn is_apart(&self, one: [usize; 2], other: [usize; 2]) -> bool {
        let ([[_, a], [_, b]], [[_, c], [_, d]]) = (self.ends(one), self.ends(other));
        a.max(b) < c.min(d) || c.max(d) < a.min(b)
    }

    /// Whether two points lie on different sides of the line through a piece.
    fn splits(&self, piece: [usize; 2], [p, q]: [usize; 2]) -> bool {
        let sides = [self.side(piece, p), self.side(piece, q)];
        sides[0].is_ne() && sides[0] == sides[1].reverse()
    }

    /// The winding number next to a piece, below it (on its right) and just beyond its lower end. Straight down from
    /// there, every piece to be counted has its lower end at or before that end, and its other end beyond it.
    fn rounds_below(&self, [low, high]: [usize; 2]) -> i64 {
        let mut rounds = 0;
        for &(piece, along) in &self.pieces {
            if piece[0] > low {
                break;
            }
            if piece[1] <= low || piece == [low, high] {
                continue;
            }
            let is_passed = match self.side(piece, low) {
                // It begins at the same point, or runs through it: what matters is which one lies above.
                Ordering::Equal => self.side([low, high], piece[1]).is_lt(),
                side => side.is_gt(),
            };
            if is_passed {
                rounds += along;
            }
        }
        rounds
    }
}
