//! Chapter 2: the scanline.

use super::tools::{Px, corners, covered, truth};
use super::{Solution, Text};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;

solvers!(row, rows, middle);

/// The pixels in one row of a triangle whose corners are centres.
fn row(_: &[Text]) -> Solution {
    let drawn = truth(&[[[0.5, 0.5], [6.5, 0.5], [0.5, 6.5]]], PixelRect::window(8, 8));
    let pixels = drawn.row(2).iter().map(|&n| u64::from(n)).sum();
    Solution::count(pixels).grid("oracle", &drawn, &drawn)
}

/// The rows of a triangle that begins and ends at the height of centres: the first one has pixels and the last one has none.
fn rows(_: &[Text]) -> Solution {
    let drawn = truth(&[[[0.0, 1.5], [8.0, 1.5], [0.0, 5.5]]], PixelRect::window(8, 8));
    let rows = drawn.rows().filter(|(_, row)| row.iter().any(|&n| n > 0)).count();
    Solution::count(rows as u64).grid("oracle", &drawn, &drawn)
}

/// A triangle whose middle corner is at the height of centres.
const POINTED: Px = [[0.5, 0.5], [6.5, 3.5], [0.5, 6.5]];

/// The spans of both parts of a triangle that is cut at its middle corner, where each part has its last row too.
fn middle(_: &[Text]) -> Solution {
    let window = PixelRect::window(8, 8);
    let right = covered(&Scanline, &[corners(POINTED)], window);
    let mut drawn = Coverage::new(window, 0);
    for (y_px, x0_px, x1_px) in right.runs() {
        drawn.hit(y_px, x0_px, x1_px);
        // The centres of row 3 are at the height of the middle corner, where the upper part ends.
        if y_px == 3 {
            drawn.hit(y_px, x0_px, x1_px);
        }
    }
    let twice = drawn.rows().flat_map(|(_, row)| row).filter(|&&n| n == 2).count();
    Solution::count(twice as u64).grid("both ends", &drawn, &right).grid("scanline", &right, &right)
}
