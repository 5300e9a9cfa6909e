//! What rasterproof found, as text, JSON, pictures and a page: see `docs/ARCHITECTURE.md`.
//!
//! Users take them from the crate `rasterproof`, which shows these rooms under its own name.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod report;

// The floors below, under the paths that every room calls them by.
use rasterproof_engines::{
    contract, effects, exhaust, frame, grid, hazard, line, oracle, pipeline, raster, scene,
    specimen, triangle,
};
use rasterproof_judges::judge;
use rasterproof_lineup::lineup;
use rasterproof_measures::{cost, verify};
