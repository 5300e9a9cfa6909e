//! The engines of [rasterproof](https://docs.rs/rasterproof), the oracle they are held to, and what
//! is drawn with them: the floors 0 to 7 of the house, see `docs/ARCHITECTURE.md`.
//!
//! Users take them from the crate `rasterproof`, which shows these rooms under its own name.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Without `host` nobody looks through the windows that engines open for `exhaust`.
#![cfg_attr(not(feature = "host"), allow(dead_code))]

// These assert in constants, where the macros below cannot speak.
pub mod grid;
pub mod tile;

#[cfg_attr(test, macro_use)]
pub mod next;

pub mod angle;
pub mod contract;
#[cfg(feature = "host")]
pub mod cores;
pub mod each;
pub mod effects;
#[cfg(feature = "host")]
pub mod exhaust;
pub mod frame;
pub mod hazard;
pub mod ladder;
pub mod line;
pub mod mutant;
pub mod oracle;
pub mod paint;
pub mod pipeline;
pub mod raster;
pub mod scene;
pub mod specimen;
#[cfg(feature = "host")]
pub mod tiled;
pub mod triangle;
