//! Rasterization in tiles with vector instructions: [`coverage`] of lists of triangles, [`paint`] for lists in one
//! colour, and whole [`frames`] on several threads.
// What only whole frames on several threads call.
#![cfg_attr(not(feature = "parallel"), allow(dead_code))]

pub mod coverage;
#[cfg(feature = "parallel")]
pub mod frames;
pub mod paint;
