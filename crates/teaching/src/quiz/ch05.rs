//! Chapter 5: interpolation in perspective.

use super::tools::{fragment, fragments};
use super::{Solution, Text};
use rasterproof_core::grid::PixelRect;

solvers!(middle, linear, worst, constant);

const WINDOW: PixelRect = PixelRect::window(8, 8);

/// A triangle with its upper edge through the centres of row 0, from (0.5, 0.5) to (6.5, 0.5).
fn triangle(w: [f64; 2], values: [f64; 2]) -> [[f64; 4]; 3] {
    [[0.5, 0.5, w[0], values[0]], [6.5, 0.5, w[1], values[1]], [0.5, 6.5, w[0], values[0]]]
}

/// The value in the middle of an edge, and the one that is linear in the window.
fn middle(_: &[Text]) -> Solution {
    let f = fragment(triangle([1.0, 3.0], [0.0, 1.0]), WINDOW, [3, 0]);
    Solution::number(f.varying, 2).figure(f.depth)
}

/// Whether numbers at equal steps lie on a straight line.
fn is_straight(values: &[f64]) -> bool {
    // The second difference, of which rounding leaves some last bits.
    values.windows(3).all(|v| (v[0] - 2.0 * v[1] + v[2]).abs() < 1e-12)
}

/// Which of the value, w, value over w and their product is linear in the window.
fn linear(_: &[Text]) -> Solution {
    // The distance is a value like any other.
    let (v, w) = (first_row([2.0, 1.0]), first_row([1.0, 4.0]));
    let (mut over, mut times) = (Vec::new(), Vec::new());
    for (v, w) in v.iter().zip(&w) {
        over.push(v / w);
        times.push(v * w);
    }
    Solution::choice(&[v, w, over, times].map(|values| is_straight(&values)))
}

/// The values along the upper edge of a triangle from w = 1 to w = 4.
fn first_row(values: [f64; 2]) -> Vec<f64> {
    let mut row = fragments(triangle([1.0, 4.0], values), WINDOW);
    row.retain(|f| f.y_px == 0);
    row.into_iter().map(|f| f.varying).collect()
}

/// The largest difference between a value in perspective and one without, and where it is.
fn worst(_: &[Text]) -> Solution {
    // Depth is interpolated without w; at the worst place, t' = 2/3, lies the centre of a pixel.
    let (mut worst, mut pixel) = (0.0, String::new());
    for f in fragments(triangle([1.0, 4.0], [0.0, 1.0]), WINDOW) {
        let error = (f.depth - f.varying).abs();
        if error > worst {
            (worst, pixel) = (error, format!("({}, {})", f.x_px, f.y_px));
        }
    }
    Solution::number(worst, 2).figure(pixel)
}

/// For which triangles perspective changes no value.
fn constant(_: &[Text]) -> Solution {
    let small = [[0.5, 0.5, 1.0, 0.0], [2.5, 0.5, 4.0, 1.0], [0.5, 2.5, 1.0, 0.0]];
    let cases = [triangle([3.0, 3.0], [0.0, 1.0]), triangle([1.0, 4.0], [0.0, 1.0]), small];
    // Where perspective has no effect, a value is everywhere what is interpolated without w.
    Solution::choice(
        &cases.map(|case| fragments(case, WINDOW).iter().all(|f| f.varying == f.depth)),
    )
}
