//! Clipping a triangle to the view volume in homogeneous space (the book's chapters 7 and 8, SYSU
//! assignment 2, tasks 2 and 7; Sutherland and Hodgman 1974).
//!
//! Seven planes: w >= [`MIN_W`], then -w <= z, z <= w, and the same for x and y. Which side a vertex
//! lies on is decided once, by the sign of its distance, and carried as an outcode. A crossing is
//! always interpolated from its inner to its outer end and then *assigned* the plane's value. Both
//! depend on the edge alone, so the neighbour across an edge gets the same bits, and what is
//! assigned satisfies its plane exactly.
//!
//! **At most ten vertices.** A new vertex takes, for every other plane, the side of its ends where
//! these agree. Put between them it adds no change of side for any plane, and removing the outer
//! vertices adds none either. A triangle has at most two changes of side for a plane, so every
//! polygon on the way has at most two; a plane removes at least one vertex and adds two: one more
//! for each of seven planes. The argument does not mention convexity, so rounding cannot break it.
//! The book's stacks, which count on convexity, overflow (`clip_stack_overflow` in
//! `tests/data/book-bugs.json`).

use super::ClipVertex;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::triangle::{MIN_W, Varying};

/// The planes, in the order they cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum ClipPlane {
    /// w = [`MIN_W`], so that there is something to divide by.
    MinW,
    /// z = -w.
    Near,
    /// z = w.
    Far,
    /// x = -w.
    Left,
    /// x = w.
    Right,
    /// y = -w.
    Bottom,
    /// y = w.
    Top,
}

impl ClipPlane {
    pub const ALL: [Self; 7] =
        [Self::MinW, Self::Near, Self::Far, Self::Left, Self::Right, Self::Bottom, Self::Top];

    /// Its bit in an [`Outcode`].
    #[must_use]
    pub const fn bit(self) -> Outcode {
        1 << self as u8
    }

    /// How far inside a position lies; negative is outside.
    #[must_use]
    pub fn distance<V>(self, vertex: &ClipVertex<V>) -> f64 {
        let p = vertex.position;
        match self {
            Self::MinW => p.w - MIN_W,
            Self::Near => p.w + p.z,
            Self::Far => p.w - p.z,
            Self::Left => p.w + p.x,
            Self::Right => p.w - p.x,
            Self::Bottom => p.w + p.y,
            Self::Top => p.w - p.y,
        }
    }

    fn assign<V>(self, vertex: &mut ClipVertex<V>) {
        let p = &mut vertex.position;
        match self {
            Self::MinW => p.w = MIN_W,
            Self::Near => p.z = -p.w,
            Self::Far => p.z = p.w,
            Self::Left => p.x = -p.w,
            Self::Right => p.x = p.w,
            Self::Bottom => p.y = -p.w,
            Self::Top => p.y = p.w,
        }
    }
}

/// One bit for each plane that a vertex lies outside of.
pub type Outcode = u8;

#[must_use]
#[inline]
pub fn outcode<V>(vertex: &ClipVertex<V>) -> Outcode {
    ClipPlane::ALL
        .into_iter()
        .fold(0, |code, plane| code | if plane.distance(vertex) < 0.0 { plane.bit() } else { 0 })
}

/// The most vertices that seven planes leave of a triangle.
pub const MOST_VERTICES: usize = 3 + ClipPlane::ALL.len();

#[derive(Clone, Copy, Debug)]
struct Corner<V> {
    vertex: ClipVertex<V>,
    /// Sides for every plane; decided, never recomputed.
    outside: Outcode,
}

/// A convex polygon in clip space, in the winding of its triangle.
#[derive(Clone, Copy, Debug)]
pub struct Polygon<V> {
    corners: [Corner<V>; MOST_VERTICES],
    len: usize,
}

impl<V: Varying> Polygon<V> {
    fn push(&mut self, corner: Corner<V>) {
        self.corners[self.len] = corner;
        self.len += 1;
    }

    /// Its vertices; fewer than three where nothing is visible.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = &ClipVertex<V>> {
        self.corners[..self.len].iter().map(|corner| &corner.vertex)
    }
}

/// What `planes` (a set of [`ClipPlane::bit`]s) leave of a triangle.
///
/// A plane that no vertex lies outside of changes no bit of the result, so leaving it out of the
/// set does not either. Returns the polygon and how many vertices were tested against a plane.
#[must_use]
pub fn clip<V: Varying>(triangle: &[ClipVertex<V>; 3], planes: Outcode) -> (Polygon<V>, u64) {
    let corner = |vertex: ClipVertex<V>| Corner { outside: outcode(&vertex), vertex };
    let corners = triangle.map_array(corner);
    let mut polygon = Polygon { corners: [corners[0]; MOST_VERTICES], len: 0 };
    corners.into_iter().for_each(|corner| polygon.push(corner));
    let mut tests = 0;
    for plane in ClipPlane::ALL.into_iter().filter(|plane| planes & plane.bit() != 0) {
        tests += polygon.len as u64;
        polygon = cut(&polygon, plane);
    }
    (polygon, tests)
}

fn cut<V: Varying>(polygon: &Polygon<V>, plane: ClipPlane) -> Polygon<V> {
    let mut kept = Polygon { len: 0, ..*polygon };
    let is_inside = |corner: &Corner<V>| corner.outside & plane.bit() == 0;
    for i in 0..polygon.len {
        let start = &polygon.corners[i];
        let end = &polygon.corners[if i + 1 == polygon.len { 0 } else { i + 1 }];
        if is_inside(start) {
            kept.push(*start);
        }
        match (is_inside(start), is_inside(end)) {
            (true, false) => kept.push(crossing(start, end, plane)),
            (false, true) => kept.push(crossing(end, start, plane)),
            _ => {}
        }
    }
    kept
}

/// Where an edge leaves the inside of a plane.
fn crossing<V: Varying>(inner: &Corner<V>, outer: &Corner<V>, plane: ClipPlane) -> Corner<V> {
    // The sides are decided; a rounded distance may contradict them by its last bit.
    let inside = plane.distance(&inner.vertex).max(0.0);
    let outside = plane.distance(&outer.vertex).min(0.0);
    let t = if inside == 0.0 { 0.0 } else { inside / (inside - outside) };
    let (a, b) = (&inner.vertex, &outer.vertex);
    let mut vertex = ClipVertex {
        position: a.position + (b.position - a.position) * t,
        varying: a.varying + (b.varying - a.varying) * t,
    };
    if (inner.outside | outer.outside) & ClipPlane::MinW.bit() == 0 {
        vertex.position.w = vertex.position.w.max(MIN_W);
    }
    plane.assign(&mut vertex);
    // Agree with both ends where they agree; only elsewhere the coordinates decide.
    let mut sides = inner.outside & outer.outside;
    for other in ClipPlane::ALL.into_iter().filter(|other| *other != plane) {
        let bit = other.bit();
        if other.distance(&vertex) < 0.0 {
            if (inner.outside | outer.outside) & bit == 0 {
                other.assign(&mut vertex);
            } else {
                sides |= bit;
            }
        }
    }
    Corner { vertex, outside: sides & !plane.bit() }
}

#[cfg(test)]
mod tests {
    use glam::DVec4;

    use super::*;

    fn vertex(x: f64, y: f64, z: f64, w: f64) -> ClipVertex<f64> {
        ClipVertex { position: DVec4::new(x, y, z, w), varying: x }
    }

    fn cut_all(triangle: [ClipVertex<f64>; 3]) -> Vec<ClipVertex<f64>> {
        clip(&triangle, Outcode::MAX).0.vertices().copied().collect()
    }

    #[test]
    fn inside_is_untouched() {
        let triangle =
            [vertex(1.0, 0.0, -1.0, 1.0), vertex(0.0, 2.0, 0.0, 2.0), vertex(0.0, 0.0, 0.0, 1.0)];
        assert_eq!(cut_all(triangle), triangle);
    }

    #[test]
    fn one_corner_behind_the_near_plane_leaves_a_quad() {
        let (a, b, c) =
            (vertex(0.0, 0.5, 0.0, 1.0), vertex(0.5, 0.0, 0.0, 1.0), vertex(0.0, 0.0, -3.0, 1.0));
        let quad = cut_all([a, b, c]);
        // From z = 0 to z = -3 the plane z = -w = -1 is a third of the way.
        let third = |v: f64| v + (0.0 - v) * (1.0 / 3.0);
        assert_eq!(quad.len(), 4);
        assert_eq!(quad[2].position, DVec4::new(third(0.5), 0.0, -1.0, 1.0));
        assert_eq!(quad[3].position, DVec4::new(0.0, third(0.5), -1.0, 1.0));
        assert_eq!(quad[2].varying, third(0.5));
    }

    /// The book's example of section 8.3: six planes leave at most nine vertices; this one has nine.
    #[test]
    fn nine_vertices_are_reached() {
        let most = (0..200_000u64)
            .map(|seed| {
                let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
                let mut next = || {
                    state ^= state << 13;
                    state ^= state >> 7;
                    state ^= state << 17;
                    (state >> 11) as f64 / (1u64 << 53) as f64 * 6.0 - 3.0
                };
                let triangle = [0; 3].map(|_| vertex(next(), next(), next(), 1.0));
                cut_all(triangle).len()
            })
            .max();
        assert_eq!(most, Some(9));
    }
}
