//! Chapter 12: samples.

use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};

use super::tools::{Px, corners, hits, truth};
use super::{Solution, Text};

solvers!(pattern, outside, left_over, heights);

/// The row 0 of the chapter's example, eight pixels.
const ROW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 8, y1: 1 };
/// Four samples in a square grid, in sixteenths of a pixel, to be compared with the pattern.
const GRID: [(i32, i32); 4] = [(4, 4), (12, 4), (4, 12), (12, 12)];

/// The samples of each pixel of the row that a triangle covers, as bits.
fn masks(triangle: Px, samples: &[(i32, i32)]) -> Vec<u8> {
    let masks = masks_at(&EdgeFunction, corners(triangle), ROW, samples);
    masks.expect("exercises stay in the domain").row(0).to_vec()
}

/// How many samples of the pattern a rising edge leaves covered in a pixel, and how many of the grid.
fn pattern(_: &[Text]) -> Solution {
    let rising = [[0.0, 1.0], [8.0, 0.0], [8.0, 1.0]];
    let [pattern, grid] = [SAMPLES, GRID].map(|samples| masks(rising, &samples)[2].count_ones());
    Solution::count(pattern.into()).figure(grid)
}

/// In how many pixels a colour is computed although the centre, where that happens, lies outside.
fn outside(_: &[Text]) -> Solution {
    let falling = [[0.0, 0.0], [8.0, 1.0], [0.0, 1.0]];
    let centres = truth(&[falling], ROW);
    let mut count = 0;
    for (x, mask) in (0..8).zip(masks(falling, &SAMPLES)) {
        count += u64::from(mask != 0 && hits(&centres, [x, 0]) == 0);
    }
    Solution::count(count)
}

/// The white that is left where two black triangles share a pixel in halves and are mixed by their shares, one after the other.
fn left_over(_: &[Text]) -> Solution {
    let sides = [[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]];
    // By samples nothing is left: each belongs to one of the two.
    let [first, second] = sides.map(|side| masks(side, &SAMPLES)[0]);
    let white = 255.0 * (1.0 - 0.5) * (1.0 - 0.5);
    Solution::number(white, 2).figure(4 - (first | second).count_ones())
}

/// How far the share that samples at so many heights find is from the exact one, at most: a level edge is moved through the pixel.
fn worst_error(heights: u32) -> f64 {
    let mut worst = 0.0_f64;
    for step in 0..=4096 {
        let edge = f64::from(step) / 4096.0;
        let mut above = 0;
        for i in 0..heights {
            above += u32::from((f64::from(i) + 0.5) / f64::from(heights) < edge);
        }
        worst = worst.max((f64::from(above) / f64::from(heights) - edge).abs());
    }
    worst
}

/// How many samples a regular pattern needs for an error of at most a sixteenth.
fn heights(_: &[Text]) -> Solution {
    let found = (1..=64).find(|&heights| worst_error(heights) <= 1.0 / 16.0);
    let heights = found.expect("eight heights are enough");
    Solution::count(u64::from(heights).pow(2)).figure(heights)
}
