//! Grids that a program may put corners and ends on.

use rasterproof_core::grid::SUBPIXELS;
use rasterproof_verify::convention::{Quantum, Rounding};

/// The grids from 1/128 px to whole pixels, each with the ways to round onto it.
pub fn grids(roundings: &[Rounding]) -> Vec<Quantum> {
    let mut all = Vec::new();
    for bits in 1..=8 {
        all.extend(roundings.iter().map(|&rounding| Quantum { step: 1 << bits, rounding }));
    }
    all
}

/// What becomes of a coordinate, such as 'cut to 1/16 px'.
pub fn rounded(grid: Quantum) -> String {
    let how = if grid.rounding == Rounding::Down { "cut" } else { "rounded" };
    format!("{how} to {}", unit(grid.step))
}

/// What a step of so many subpixels is called.
pub fn unit(step: i32) -> String {
    match SUBPIXELS / step {
        1 => "whole pixels".to_owned(),
        parts => format!("1/{parts} px"),
    }
}
