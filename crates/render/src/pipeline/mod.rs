//! The pipeline of the book's chapters 4 to 11 around a rasterizer: transform, clip, cull, viewport,
//! depth, shade, resolve.
//!
//! Every stage takes values and returns values, is generic over the rasterizer, and names none.
//! Conventions, stated once: object, world and camera space are left-handed, x right, y up, z away
//! from the eye (the book's); matrices multiply columns, `projection * view * model * p`; clip
//! space keeps -w <= x, y, z <= w; the window has x right and y **down**; window depth is 0 at the
//! near plane and 1 at the far plane. Counter-clockwise is what the eye sees.

pub mod assemble;
pub mod clip;
pub mod counters;
pub mod depth;
pub mod draw;
pub mod fill;
pub mod fog;
pub mod footprint;
pub mod fragments;
pub mod highlight;
pub mod layers;
pub mod linear;
pub mod multisample;
pub mod opacity;
pub mod physical;
mod plain;
pub mod present;
pub mod punctual;
mod sample;
pub mod see_through;
pub mod shade;
pub mod shadow;
pub mod target;
pub mod texture;
pub mod transform;
pub mod wireframe;
mod wrap;

use glam::DVec4;

pub use counters::Counters;

/// The least and the largest number; infinite ones of none.
pub(crate) fn ends(numbers: &[f64]) -> [f64; 2] {
    numbers.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], n| [a.min(*n), b.max(*n)])
}

/// A vertex in clip space, as the vertex stage returns it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex<V> {
    /// x, y, z, w, homogeneous; visible where -w <= x, y, z <= w.
    pub position: DVec4,
    /// What the fragment stage wants to know, linear in space.
    pub varying: V,
}
