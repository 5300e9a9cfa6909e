//! The text of the files whose code a certificate names: they are hashed by the crate `rasterproof-exhaustive`, which
//! could not include files of another package.

/// `grid.rs`.
pub const GRID: &str = include_str!("grid.rs");
/// `raster/scanline.rs`.
pub const SCANLINE: &str = include_str!("raster/scanline.rs");
/// `raster/edge_function.rs`.
pub const EDGE_FUNCTION: &str = include_str!("raster/edge_function.rs");
/// `line/dda.rs`.
pub const DDA: &str = include_str!("line/dda.rs");
/// `line/bresenham.rs`.
pub const BRESENHAM: &str = include_str!("line/bresenham.rs");
