//! What the engines of rasterproof get wrong and what they cost: see `docs/ARCHITECTURE.md`.
//!
//! Users take them from the crate `rasterproof`, which shows these rooms under its own name.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
#[macro_use]
extern crate rasterproof_engines;

pub mod cost;
pub mod verify;

// The floors below, under the paths that every room calls them by.
use rasterproof_engines::{
    contract, cores, each, effects, frame, grid, hazard, ladder, line, oracle, pipeline, raster,
    scene, specimen, tile, tiled, triangle,
};
use rasterproof_lineup::lineup;
