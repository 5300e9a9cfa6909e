//! The foundation of rasterproof: the 1/256 px grid, triangles, frames, the traits that a rasterizer implements
//! ([`contract`]), the scanline and edge-function rasterizers ([`raster`]), and the line drawers ([`line`](mod@line)).
//!
//! [`raster::scanline`] and [`raster::edge_function`] share no code beyond the grid and the contract, since they are
//! compared with each other.

#![warn(missing_docs)]

// `grid` derives `serde::Serialize` in any case: its text is named by certificates, which take days to renew. Without
// the feature `serde` that path leads to the derive of `Default` below, which has no effect on anything else; with it
// the two types implement `Default` by hand, so that the feature only adds.
#[cfg(not(feature = "serde"))]
extern crate self as serde;
#[cfg(not(feature = "serde"))]
#[allow(unused_imports, reason = "named as `serde::Serialize`")]
pub(crate) use std::default::Default as Serialize;

#[cfg(feature = "serde")]
impl Default for grid::SubpixelPoint {
    fn default() -> Self {
        Self::new(0, 0)
    }
}

#[cfg(feature = "serde")]
impl Default for grid::PixelRect {
    fn default() -> Self {
        Self::window(0, 0)
    }
}

pub mod angle;
pub mod arrays;
pub mod contract;
pub mod frame;
pub mod geometry;
pub mod grid;
pub mod line;
mod named;
pub mod parallel;
pub mod random;
pub mod raster;
mod select;
#[doc(hidden)]
pub mod source_text;
pub mod triangle;
