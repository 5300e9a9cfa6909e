//! Drawing with stages of your own: a vertex stage and a fragment stage as plain functions, any
//! rasterizer between them (the book's section 9.2).
//!
//! ```
//! use glam::{DVec3, DVec4};
//! use rasterproof_render::pipeline::ClipVertex;
//! use rasterproof_render::pipeline::draw::Renderer;
//! use rasterproof_render::pipeline::target::{Antialias, Target, to_colour};
//! use rasterproof_core::raster::scanline::Scanline;
//!
//! let target = Target::new(64, 64, Antialias::None, Default::default())?;
//! let mut renderer = Renderer::new(Scanline, target);
//! let corners = [(DVec4::new(-1., -1., 0., 1.), DVec3::X), (DVec4::new(1., -1., 0., 1.), DVec3::Y),
//!                (DVec4::new(0., 1., 0., 1.), DVec3::Z)];
//! renderer.draw(
//!     &corners,
//!     &[[0, 1, 2]],
//!     |(position, colour)| ClipVertex { position: *position, varying: *colour },
//!     |colour| to_colour(*colour),
//! )?;
//! let picture = renderer.finish();
//! assert_eq!(picture.get(0, 0), Some([0, 0, 0, 255]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! It refuses to blend: every fragment is opaque.

use std::fmt;

use super::assemble::{Assembler, BadVertex, Cull, check_vertex};
use super::fill::{Way, each, fill};
use super::target::{Colour, Target};
use super::{ClipVertex, Counters};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::Frame;
use rasterproof_core::triangle::{ScreenTriangle, Varying};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawError {
    /// A vertex that the vertex stage must not return.
    Vertex(BadVertex),
    /// A triangle names a vertex that is not there.
    Index { triangle: usize, index: u32 },
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(bad) => write!(f, "{bad}"),
            Self::Index { triangle, index } => {
                write!(f, "triangle {triangle} names vertex {index}, which is not there")
            }
        }
    }
}

impl std::error::Error for DrawError {}

/// Draws into a target through one rasterizer.
#[derive(Clone, Debug)]
pub struct Renderer<E> {
    engine: E,
    target: Target,
    pub cull: Cull,
    /// Whether nearer fragments win, or later ones (the painter's algorithm).
    pub depth_test: bool,
    pub counters: Counters,
}

impl<E: Interpolate> Renderer<E> {
    /// A renderer with depth test and without culling.
    #[must_use]
    pub fn new(engine: E, target: Target) -> Self {
        Self { engine, target, cull: Cull::None, depth_test: true, counters: Counters::default() }
    }

    #[must_use]
    pub fn target(&self) -> &Target {
        &self.target
    }

    pub fn clear(&mut self, colour: Colour) {
        self.target.clear_colour(colour, &mut self.counters);
        self.target.clear_depth(&mut self.counters);
    }

    /// Runs the vertex stage on every vertex and the fragment stage on every visible fragment of
    /// the triangles, three indices each.
    ///
    /// # Errors
    /// [`DrawError`], before anything is drawn.
    pub fn draw<I, V: Varying>(
        &mut self,
        vertices: &[I],
        triangles: &[[u32; 3]],
        vertex_stage: impl Fn(&I) -> ClipVertex<V>,
        fragment_stage: impl Fn(&V) -> Colour,
    ) -> Result<(), DrawError> {
        let Self { engine, target, depth_test, .. } = self;
        let (depth_test, bounds) = (*depth_test, target.bounds());
        let mut fills = Counters::default();
        let assembler = Assembler::new(bounds, self.cull);
        let mut stage = each(|varying, _| fragment_stage(varying));
        assemble_all(&assembler, vertices, triangles, vertex_stage, &mut self.counters, |piece| {
            let way = Way { depth_test, ..Way::default() };
            fill(engine, piece, target, bounds, way, &mut stage, &mut fills);
        })?;
        self.counters += fills;
        Ok(())
    }

    /// Averages the samples and returns the picture.
    #[must_use]
    pub fn finish(&self) -> Frame<Colour> {
        self.target.resolve()
    }
}

/// Vertex stage and assembly of every triangle.
fn assemble_all<I, V: Varying>(
    assembler: &Assembler,
    vertices: &[I],
    triangles: &[[u32; 3]],
    vertex_stage: impl Fn(&I) -> ClipVertex<V>,
    counters: &mut Counters,
    mut emit: impl FnMut(&ScreenTriangle<V>),
) -> Result<(), DrawError> {
    let vertices: Vec<ClipVertex<V>> = vertices.iter().map(vertex_stage).collect();
    counters.vertices += vertices.len() as u64;
    for (index, vertex) in vertices.iter().enumerate() {
        check_vertex(index, vertex).map_err(DrawError::Vertex)?;
    }
    let missing = |(triangle, indices): (usize, &[u32; 3])| {
        let index = indices.iter().copied().find(|&index| index as usize >= vertices.len())?;
        Some(DrawError::Index { triangle, index })
    };
    if let Some(error) = triangles.iter().enumerate().find_map(missing) {
        return Err(error);
    }
    let points: Vec<_> = vertices.iter().map(|vertex| assembler.point(vertex.position)).collect();
    for &[a, b, c] in triangles {
        let indices = [a as usize, b as usize, c as usize];
        let varyings = |_| indices.map_array(|i| vertices[i].varying);
        assembler.assemble(indices.map_array(|i| &points[i]), varyings, counters, &mut emit);
    }
    Ok(())
}
