//! The foundation of rasterproof: the 1/256 px grid, triangles, frames, the traits that a rasterizer implements
//! ([`contract`]), the scanline and edge-function rasterizers ([`raster`]), and the line drawers ([`line`](mod@line)).
//!
//! [`raster::scanline`] and [`raster::edge_function`] share no code beyond the grid and the contract, since they are
//! compared with each other.

#![warn(missing_docs)]

pub mod angle;
pub mod arrays;
pub mod contract;
pub mod frame;
pub mod grid;
pub mod line;
pub mod parallel;
pub mod raster;
#[doc(hidden)]
pub mod source_text;
pub mod triangle;
