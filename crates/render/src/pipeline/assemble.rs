//! From vertices in clip space to triangles in the window: clip, divide, viewport, snap, cull (the
//! book's sections 8.2, 8.3 and 9.3, SYSU assignment 2, tasks 2, 3 and 7).
//!
//! Whether a triangle faces away is asked of its *snapped* corners, with whole numbers: the sign of
//! a float area may contradict what is drawn. The viewport is multiplied by the size, not by
//! size - 1 as in the book, so that a quad over the whole screen covers every pixel.

use std::fmt;

use glam::{DVec2, DVec4};

use super::clip::{self, Outcode, Polygon};
use super::{ClipVertex, Counters};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, Refusal, SubpixelPoint};
use rasterproof_core::triangle::{Corners, MAX_W, ScreenTriangle, ScreenVertex, Varying};

/// Which triangles are left out, by their winding as the eye sees them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum Cull {
    #[default]
    None,
    Clockwise,
    CounterClockwise,
}

impl Cull {
    /// Whether a triangle in the window is left out. One without area never is: it draws nothing.
    ///
    /// ```
    /// use rasterproof_core::grid::SubpixelPoint as P;
    /// use rasterproof_render::pipeline::assemble::Cull;
    /// let clockwise = [P::new(0, 0), P::new(256, 0), P::new(0, 256)];
    /// assert!(Cull::Clockwise.removes(clockwise));
    /// assert!(!Cull::CounterClockwise.removes(clockwise));
    /// ```
    #[must_use]
    pub fn removes(self, corners: Corners) -> bool {
        match self {
            Self::None => false,
            Self::Clockwise => twice_area(&corners) > 0,
            Self::CounterClockwise => twice_area(&corners) < 0,
        }
    }
}

/// Where clip space lands in the window.
#[derive(Clone, Copy, Debug)]
pub struct Viewport {
    size_px: DVec2,
}

impl Viewport {
    /// The window `bounds`, whole; its upper left pixel must be (0, 0).
    #[must_use]
    pub fn new(bounds: PixelRect) -> Self {
        Self { size_px: DVec2::new(f64::from(bounds.width()), f64::from(bounds.height())) }
    }

    /// Divides by w, stretches to the window, snaps. Window depth is (z/w + 1) / 2.
    ///
    /// # Errors
    /// [`Refusal`] for a vertex outside the view volume that has no place on the lattice.
    pub fn place<V: Copy>(&self, vertex: &ClipVertex<V>) -> Result<ScreenVertex<V>, Refusal> {
        let DVec4 { x, y, z, w } = vertex.position;
        let (x, y) = (x / w, y / w);
        ScreenVertex::new(
            (x + 1.0) / 2.0 * self.size_px.x,
            (1.0 - y) / 2.0 * self.size_px.y,
            (z / w + 1.0) / 2.0,
            w,
            vertex.varying,
        )
    }
}

/// A vertex that the vertex stage must not return.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadVertex {
    pub index: usize,
    pub refusal: Refusal,
}

impl fmt::Display for BadVertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "vertex {}: a clip coordinate {}", self.index, self.refusal)
    }
}

impl std::error::Error for BadVertex {}

/// Checks that the coordinates are finite and at most [`MAX_W`] in magnitude.
///
/// # Errors
/// [`BadVertex`] with `index` and the reason.
pub fn check_vertex<V>(index: usize, vertex: &ClipVertex<V>) -> Result<(), BadVertex> {
    let refusal = vertex.position.to_array().into_iter().find_map(|value| {
        if value.is_nan() {
            Some(Refusal::NotANumber)
        } else if value.is_infinite() {
            Some(Refusal::Infinite)
        } else if value.abs() > MAX_W {
            Some(Refusal::OutOfRange { value, min: -MAX_W, max: MAX_W })
        } else {
            None
        }
    });
    refusal.map_or(Ok(()), |refusal| Err(BadVertex { index, refusal }))
}

/// A position in clip space, its side of the planes, and its place in the window.
#[derive(Clone, Copy, Debug)]
pub struct ClipPoint {
    pub position: DVec4,
    code: Outcode,
    /// Nothing where a plane cuts, or outside the domain.
    place: Option<ScreenVertex<()>>,
}

impl ClipPoint {
    /// Where it lies in the window, if that was asked already.
    #[must_use]
    pub fn place(&self) -> Option<SubpixelPoint> {
        self.place.map(|vertex| vertex.position)
    }

    /// The same as a vertex.
    pub(crate) fn vertex(&self) -> Option<ScreenVertex<()>> {
        self.place
    }

    pub(crate) fn code(&self) -> Outcode {
        self.code
    }
}

/// Takes triangles from clip space to the window: clips, divides, snaps and culls them, into pieces
/// that a rasterizer draws.
#[derive(Clone, Copy, Debug)]
pub struct Assembler {
    viewport: Viewport,
    cull: Cull,
    /// Whether pieces that are clockwise as seen have varyings of their own.
    two_sided: bool,
    /// Planes that every triangle is cut by, asked for or not; the rest only where a vertex is out.
    always: Outcode,
    /// Planes that cut no triangle: a claim that none crosses them.
    never: Outcode,
    /// Ask for the winding even where nothing is left out.
    asks: bool,
}

impl Assembler {
    /// Clips by exactly the planes that a triangle crosses.
    #[must_use]
    pub fn new(bounds: PixelRect, cull: Cull) -> Self {
        let viewport = Viewport::new(bounds);
        Self { viewport, cull, two_sided: false, always: 0, never: 0, asks: false }
    }

    /// Runs every triangle through all the planes: what clipping costs without outcodes.
    #[must_use]
    pub fn with_every_plane(self) -> Self {
        Self { always: Outcode::MAX, ..self }
    }

    /// Cuts by none of these planes, whatever crosses them, which is wrong wherever something does. A
    /// triangle that lies outside one of them altogether is rejected all the same.
    #[must_use]
    pub fn without_planes(self, never: Outcode) -> Self {
        Self { never, ..self }
    }

    /// Asks for every winding, whether anything is left out or not.
    #[must_use]
    pub fn asking_for_winding(self) -> Self {
        Self { asks: true, ..self }
    }

    /// Asks for the varyings of the back where a piece is clockwise as seen.
    #[must_use]
    pub fn with_two_sides(self, two_sided: bool) -> Self {
        Self { two_sided, ..self }
    }

    /// Whether a piece has the varyings of the back: decided as culling is, by the snapped corners.
    #[must_use]
    pub fn is_back(&self, corners: Corners) -> bool {
        self.two_sided && Cull::Clockwise.removes(corners)
    }

    #[must_use]
    pub fn without_culling(self) -> Self {
        Self { cull: Cull::None, ..self }
    }

    /// What a position needs once, whichever triangles it is a corner of. It has passed
    /// [`check_vertex`].
    #[must_use]
    pub fn point(&self, position: DVec4) -> ClipPoint {
        let vertex = ClipVertex { position, varying: () };
        let code = clip::outcode(&vertex);
        let is_placed = (code | self.always) & !self.never == 0;
        let place = if is_placed { self.viewport.place(&vertex).ok() } else { None };
        ClipPoint { position, code, place }
    }

    /// Emits the pieces of one triangle that are in the window and not culled. `varyings` gives
    /// the varyings of its three corners, with `true` those of the back; it is called only if the
    /// triangle is cut, or is in the window and not culled.
    pub fn assemble<V: Varying>(
        &self,
        triangle: [&ClipPoint; 3],
        varyings: impl Fn(bool) -> [V; 3],
        counters: &mut Counters,
        emit: impl FnMut(&ScreenTriangle<V>),
    ) {
        let each = |is_back| {
            let varyings = varyings(is_back);
            move |corner: usize| varyings[corner]
        };
        self.assemble_each(triangle, each, counters, emit);
    }

    /// The same of varyings that are given corner by corner: large ones are written to their place.
    pub(crate) fn assemble_each<V: Varying, F: Fn(usize) -> V>(
        &self,
        triangle: [&ClipPoint; 3],
        varyings: impl Fn(bool) -> F,
        counters: &mut Counters,
        mut emit: impl FnMut(&ScreenTriangle<V>),
    ) {
        counters.triangles += 1;
        let [a, b, c] = triangle;
        if a.code & b.code & c.code != 0 {
            counters.rejected += 1;
            return;
        }
        let crossed = (a.code | b.code | c.code) & !self.never;
        let planes = crossed | (self.always & !self.never);
        if planes == 0 {
            // What a forgotten plane leaves outside the domain cannot be drawn; it is left out.
            let (Some(a), Some(b), Some(c)) = (a.place, b.place, c.place) else { return };
            let corners = [a.position, b.position, c.position];
            if self.keeps(corners, counters) {
                let of = varyings(self.is_back(corners));
                emit(&ScreenTriangle {
                    vertices: [a.with_varying(of(0)), b.with_varying(of(1)), c.with_varying(of(2))],
                });
            }
            return;
        }
        counters.clipped += u64::from(crossed != 0);
        let cut = |is_back: bool| {
            let of = varyings(is_back);
            let vertex =
                |point: &ClipPoint, varying| ClipVertex { position: point.position, varying };
            clip::clip(&[vertex(a, of(0)), vertex(b, of(1)), vertex(c, of(2))], planes)
        };
        let (polygon, tests): (Polygon<V>, u64) = cut(false);
        counters.plane_tests += tests;
        self.emit_fan(&polygon, &|| cut(true).0, counters, &mut emit);
    }

    /// Places the vertices of a convex polygon and emits the fan around the first. `back` is the polygon with the varyings of
    /// the back: which piece needs them is known only when it is placed.
    fn emit_fan<V: Varying>(
        &self,
        polygon: &Polygon<V>,
        back: &dyn Fn() -> Polygon<V>,
        counters: &mut Counters,
        emit: &mut impl FnMut(&ScreenTriangle<V>),
    ) {
        let place = |vertex: &ClipVertex<V>| self.viewport.place(vertex).ok();
        let mut placed = polygon.vertices().filter_map(place);
        let (Some(first), Some(mut previous)) = (placed.next(), placed.next()) else { return };
        for (number, next) in placed.enumerate() {
            let mut vertices = [first, previous, next];
            previous = next;
            let corners = vertices.map_array(|vertex| vertex.position);
            if !self.keeps(corners, counters) {
                continue;
            }
            if self.is_back(corners) {
                let back: Vec<_> = back().vertices().filter_map(place).collect();
                vertices = [back[0], back[number + 1], back[number + 2]];
            }
            emit(&ScreenTriangle { vertices });
        }
    }

    /// Counts a piece, and says whether culling leaves it.
    fn keeps(&self, corners: Corners, counters: &mut Counters) -> bool {
        counters.pieces += 1;
        if !self.asks && self.cull == Cull::None {
            return true;
        }
        counters.cull_tests += 1;
        let is_culled = self.cull.removes(corners);
        counters.culled += u64::from(is_culled);
        !is_culled
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::contract::Rasterize as _;
    use rasterproof_core::frame::Coverage;
    use rasterproof_oracle::Oracle;

    fn vertex(x: f64, y: f64, z: f64, w: f64) -> ClipVertex<glam::DVec2> {
        ClipVertex { position: DVec4::new(x, y, z, w), varying: glam::DVec2::ZERO }
    }

    /// The book multiplies by size - 1 and leaves the last row and column empty.
    #[test]
    fn a_quad_over_the_screen_covers_every_pixel() {
        for (width, height) in [(1, 1), (7, 5), (64, 48), (1919, 3)] {
            let bounds = PixelRect::window(width, height);
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let [a, b, c, d] = corners.map(|(x, y)| vertex(x * 3.0, y * 3.0, 0.0, 3.0));
            let mut hits = Coverage::new(bounds, 0);
            let assembler = Assembler::new(bounds, Cull::Clockwise);
            for triangle in [[a, b, c], [a, c, d]] {
                let points = triangle.map(|vertex| assembler.point(vertex.position));
                let varyings = |_| triangle.map(|vertex| vertex.varying);
                let hit = |piece: &ScreenTriangle<_>| {
                    Oracle.cover(piece.corners(), bounds, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                };
                assembler.assemble(points.each_ref(), varyings, &mut Counters::default(), hit);
            }
            assert!(hits.rows().all(|(_, row)| row.iter().all(|&hit| hit == 1)));
        }
    }

    /// Whole and cut, a triangle of two sides has the varyings of the side that its snapped corners show.
    #[test]
    fn a_piece_has_the_varyings_of_the_side_that_is_seen() {
        let bounds = PixelRect::window(8, 8);
        let inside = [(0.0, 0.0, 0.0, 1.0), (0.5, 0.0, 0.0, 1.0), (0.0, 0.5, 0.0, 1.0)];
        let crossing = [inside[0], inside[1], (0.0, 0.5, -3.0, 1.0)];
        for triangle in [inside, crossing] {
            for turned in [false, true] {
                let [a, b, c] = triangle;
                let corners = if turned { [a, c, b] } else { [a, b, c] };
                for two_sided in [false, true] {
                    let assembler = Assembler::new(bounds, Cull::None).with_two_sides(two_sided);
                    let points =
                        corners.map(|(x, y, z, w)| assembler.point(DVec4::new(x, y, z, w)));
                    let varyings = |is_back| [DVec2::splat(f64::from(u8::from(is_back))); 3];
                    let mut counters = Counters::default();
                    let mut pieces = 0;
                    assembler.assemble(points.each_ref(), varyings, &mut counters, |piece| {
                        let is_back = two_sided && twice_area(&piece.corners()) > 0;
                        let expected = DVec2::splat(f64::from(u8::from(is_back)));
                        assert!(piece.vertices.iter().all(|v| v.varying == expected));
                        pieces += 1;
                    });
                    assert_eq!(counters.pieces, pieces);
                    assert!(pieces > 0);
                }
            }
        }
    }

    #[test]
    fn counters_say_what_became_of_a_triangle() {
        let bounds = PixelRect::window(8, 8);
        let count = |corners: [(f64, f64, f64, f64); 3], cull| {
            let mut counters = Counters::default();
            let assembler = Assembler::new(bounds, cull);
            let points = corners.map(|(x, y, z, w)| assembler.point(DVec4::new(x, y, z, w)));
            let varyings = |_| [glam::DVec2::ZERO; 3];
            assembler.assemble(points.each_ref(), varyings, &mut counters, |_| {});
            [counters.rejected, counters.clipped, counters.pieces, counters.culled]
        };
        let inside = [(0.0, 0.0, 0.0, 1.0), (0.5, 0.0, 0.0, 1.0), (0.0, 0.5, 0.0, 1.0)];
        assert_eq!(count(inside, Cull::None), [0, 0, 1, 0]);
        assert_eq!(count(inside, Cull::CounterClockwise), [0, 0, 1, 1]);
        let behind = inside.map(|(x, y, z, _)| (x, y, z, -1.0));
        assert_eq!(count(behind, Cull::None), [1, 0, 0, 0]);
        let crossing = [inside[0], inside[1], (0.0, 0.0, -3.0, 1.0)];
        assert_eq!(count(crossing, Cull::None), [0, 1, 2, 0]);
    }
}
