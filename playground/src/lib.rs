//! The playground of rasterproof: what its page asks, the answers, and the page itself; see
//! `docs/playground.md`.
#![deny(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
#[macro_use]
extern crate rasterproof_engines;

pub mod answer;
#[cfg(target_family = "wasm")]
pub mod door;
pub mod page;

// The floors below, under the paths that every room calls them by.
use rasterproof_engines::{
    contract, frame, grid, hazard, line, mutant, oracle, pipeline, raster, specimen, triangle,
};
use rasterproof_lineup::lineup;
