//! Chapter 2: lines.

use super::tools::hits;
use super::{Right, Solution, Text};
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::PixelPoint;
use rasterproof_verify::cases::named::plain_line;

solvers!(longer, halfway, drift);

/// The pixels of a line as the engine of the chapter draws it.
fn line(from: [i32; 2], to: [i32; 2], window: PixelRect) -> Coverage {
    let mut lit = Coverage::new(window, 0);
    let [from, to] = [from, to].map(|[x, y]| PixelPoint::new(x, y));
    let line = plain_line(from, to);
    Bresenham.draw(&line, window, |f| lit.hit(f.y_px, f.x_px, f.x_px + 1));
    lit
}

/// A line along y has a pixel for each row, not for each column.
fn longer(_: &[Text]) -> Solution {
    let lit = line([0, 0], [3, 9], PixelRect::window(4, 10));
    Solution::count(lit.covered()).grid("0,0 3,9", &lit, &lit)
}

/// The row of the middle column, where the line passes exactly between two rows.
fn halfway(_: &[Text]) -> Solution {
    let window = PixelRect::window(9, 4);
    let [there, back] = [line([0, 0], [8, 3], window), line([8, 3], [0, 0], window)];
    let row = (0..4).find(|&y| hits(&there, [4, y]) > 0).expect("every column is lit");
    // Either direction must light it.
    assert_eq!(there, back, "a line does not depend on its direction");
    Solution::new(Right::Pixel([4, row])).grid("0,0 8,3", &there, &there)
}

/// The row that ten additions of a rounded slope lead to, beside the right one.
fn drift(_: &[Text]) -> Solution {
    let right = line([0, 0], [20, 2], PixelRect::window(21, 3));
    let right = (0..3).find(|&y| hits(&right, [10, y]) > 0).expect("every column is lit");
    // 0.1 is no binary fraction, and the sum of ten is less than 1.
    let height: f64 = std::iter::repeat_n(2.0 / 20.0, 10).sum();
    Solution::count(height as u64).figure(right).figure(height)
}
