//! Those who judge the engines of rasterproof, and anybody else's: see `docs/ARCHITECTURE.md`.
//!
//! Users take them from the crate `rasterproof`, which shows these rooms under its own name.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
#[macro_use]
extern crate rasterproof_engines;

pub mod convention;
pub mod invariant;
pub mod judge;

// The floors below, under the paths that every room calls them by.
use rasterproof_engines::{
    contract, cores, each, effects, frame, grid, hazard, line, mutant, oracle, pipeline, raster,
    scene, specimen, tile, triangle,
};
use rasterproof_lineup::lineup;
use rasterproof_measures::verify;
