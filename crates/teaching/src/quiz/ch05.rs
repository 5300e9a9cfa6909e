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

fn middle(_: &[Text]) -> Solution {
    let f = fragment(triangle([1.0, 3.0], [0.0, 1.0]), WINDOW, [3, 0]);
    Solution::number(f.varying, 2).figure(f.depth)
}

/// Whether numbers at equal steps lie on a straight line.
fn is_straight(values: &[f64]) -> bool {
    values.windows(3).all(|v| (v[0] - 2.0 * v[1] + v[2]).abs() < 1e-12)
}

fn linear(_: &[Text]) -> Solution {
    let row = |values| {
        let all = fragments(triangle([1.0, 4.0], values), WINDOW);
        all.into_iter().filter(|f| f.y_px == 0).map(|f| f.varying).collect::<Vec<f64>>()
    };
    // The distance is a value like any other.
    let (v, w) = (row([2.0, 1.0]), row([1.0, 4.0]));
    let both = |f: fn(f64, f64) -> f64| v.iter().zip(&w).map(|(&v, &w)| f(v, w)).collect();
    let all: [Vec<f64>; 4] =
        [both(|v, _| v), both(|_, w| w), both(|v, w| v / w), both(|v, w| v * w)];
    Solution::choice(&all.map(|values| is_straight(&values)))
}

fn worst(_: &[Text]) -> Solution {
    let all = fragments(triangle([1.0, 4.0], [0.0, 1.0]), WINDOW);
    // Depth is interpolated without w; at the worst place, t' = 2/3, lies the centre of a pixel.
    let worst = all.iter().map(|f| (f.depth - f.varying).abs()).fold(0.0, f64::max);
    let at = all.iter().find(|f| (f.depth - f.varying).abs() == worst);
    let pixel = at.map_or(String::new(), |f| format!("({}, {})", f.x_px, f.y_px));
    Solution::number(worst, 2).figure(pixel)
}

fn constant(_: &[Text]) -> Solution {
    let changes = |triangle| fragments(triangle, WINDOW).iter().any(|f| f.varying != f.depth);
    let small = [[0.5, 0.5, 1.0, 0.0], [2.5, 0.5, 4.0, 1.0], [0.5, 2.5, 1.0, 0.0]];
    let cases = [triangle([3.0, 3.0], [0.0, 1.0]), triangle([1.0, 4.0], [0.0, 1.0]), small];
    Solution::choice(&cases.map(|case| !changes(case)))
}
