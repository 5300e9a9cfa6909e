//! Chapter 12: samples.

use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};

use super::tools::{Px, corners, hits, truth};
use super::{Solution, Text};

solvers!(pattern, outside, left_over, heights);

/// The row 0 of the chapter's example, eight pixels.
const ROW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 8, y1: 1 };
const GRID: [(i32, i32); 4] = [(4, 4), (12, 4), (4, 12), (12, 12)];

/// The samples of each pixel of the row that a triangle covers, as bits.
fn masks(triangle: Px, samples: &[(i32, i32)]) -> Vec<u8> {
    let masks = masks_at(&EdgeFunction, corners(triangle), ROW, samples);
    masks.expect("exercises stay in the domain").row(0).to_vec()
}

fn pattern(_: &[Text]) -> Solution {
    let rising = [[0.0, 1.0], [8.0, 0.0], [8.0, 1.0]];
    let [pattern, grid] = [SAMPLES, GRID].map(|samples| masks(rising, &samples)[2].count_ones());
    Solution::count(pattern.into()).figure(grid)
}

fn outside(_: &[Text]) -> Solution {
    let falling = [[0.0, 0.0], [8.0, 1.0], [0.0, 1.0]];
    let centres = truth(&[falling], ROW);
    let is_shaded = masks(falling, &SAMPLES).into_iter().map(|mask| mask != 0);
    let pixels = (0..8).zip(is_shaded);
    let counted = pixels.filter(|&(x, is_shaded)| is_shaded && hits(&centres, [x, 0]) == 0);
    Solution::count(counted.count() as u64)
}

fn left_over(_: &[Text]) -> Solution {
    let sides = [[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]];
    let [first, second] = sides.map(|side| masks(side, &SAMPLES)[0]);
    let white = 255.0 * (1.0 - 0.5) * (1.0 - 0.5);
    Solution::number(white, 2).figure(4 - (first | second).count_ones())
}

/// How far the share that samples at so many heights find is from the exact one, at most: a level edge is moved through the pixel.
fn worst_error(heights: u32) -> f64 {
    let height = |i: u32| (f64::from(i) + 0.5) / f64::from(heights);
    let error = |edge: f64| {
        let above = (0..heights).filter(|&i| height(i) < edge).count();
        (above as f64 / f64::from(heights) - edge).abs()
    };
    (0..=4096).map(|step| error(f64::from(step) / 4096.0)).fold(0.0, f64::max)
}

fn heights(_: &[Text]) -> Solution {
    let found = (1..=64).find(|&heights| worst_error(heights) <= 1.0 / 16.0);
    let heights = found.expect("eight heights are enough");
    Solution::count(u64::from(heights).pow(2)).figure(heights)
}
