//! The line-up of [rasterproof](https://docs.rs/rasterproof), and the digest of all that it computes:
//! see `docs/ARCHITECTURE.md`.
//!
//! Users take them from the crate `rasterproof`, which shows these rooms under its own name.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(feature = "host")]
pub mod digest;
pub mod lineup;

// The floors below, under the paths that every room calls them by.
use rasterproof_engines::{
    contract, effects, frame, grid, line, mutant, oracle, pipeline, raster, scene, specimen, tile,
    triangle,
};
#[cfg(feature = "host")]
use rasterproof_engines::{cores, each, hazard};
