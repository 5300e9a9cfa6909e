//! Rasterization in tiles with vector instructions: [`coverage`] of lists of triangles, [`paint`] for lists in one
//! colour, and whole [`frames`] on several threads.

pub mod coverage;
#[cfg(feature = "parallel")]
pub mod frames;
pub mod paint;
