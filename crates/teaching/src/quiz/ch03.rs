//! Chapter 3: interpolation.

use super::tools::{Px, corners};
use super::{Solution, Text};
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{Published as _, bare};
use rasterproof_verify::oracle::values::{ExactTriangle, along_line};

solvers!(rod, weight, outside, order);

/// The value three eighths along a rod, by the oracle's formula.
fn rod(_: &[Text]) -> Solution {
    let value = along_line([2.0, 10.0], 3, 8).to_f64();
    Solution::number(value, 0)
}

const RIGHT_ANGLE: Px = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];

/// The three weights at the centre of a pixel, exact, as the values of three unit attributes.
fn weights(x_px: i32, y_px: i32) -> [f64; 3] {
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let exact = ExactTriangle::new(&corners(RIGHT_ANGLE), [0.0; 3], [1.0; 3], units);
    exact.expect("it has an area").at(x_px, y_px).1.map(|weight| weight.to_f64())
}

/// The weight of the first corner; the others are figures of the reason.
fn weight(_: &[Text]) -> Solution {
    let [a, b, c] = weights(1, 2);
    Solution::number(a, 2).figure(b).figure(c)
}

/// How many weights are negative at a pixel on the other side of one edge.
fn outside(_: &[Text]) -> Solution {
    let [a, b, c] = weights(6, 6);
    let negative = [a, b, c].iter().filter(|&&weight| weight < 0.0).count();
    Solution::count(negative as u64).figure(a).figure(b).figure(c)
}

/// Whether weights in the wrong order change a value, and whether they change a pixel.
fn is_noticed(values: [f64; 3]) -> (bool, bool) {
    let mut triangle = bare([[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]]);
    for (vertex, value) in triangle.iter_mut().zip(values) {
        vertex.varying.x = value;
    }
    let exact = ExactTriangle::new(
        &corners([[1.5, 9.5], [9.5, 8.5], [4.5, 1.5]]),
        [0.0; 3],
        [1.0; 3],
        values.map(|value| [value]),
    );
    let exact = exact.expect("it has an area");
    // Its fragments against the exact values, and their number against that of the covered pixels.
    let (mut pixels, mut off) = ([0, 0], false);
    let window = PixelRect::window(11, 11);
    let emitted = SysuWeights.fragments(&triangle, window, &mut |f| {
        pixels[0] += 1;
        // The specimen counts in f32.
        off |= exact.at(f.x_px, f.y_px).1[0].distance(f.varying.x) > 1e-3;
    });
    let covered = SysuWeights.cover(&triangle, window, &mut |span| {
        pixels[1] += span.x1_px - span.x0_px;
    });
    assert_eq!((emitted, covered), (Ok(()), Ok(())));
    (off, pixels[0] != pixels[1])
}

/// Equal values hide exchanged weights, and no coverage shows them.
fn order(_: &[Text]) -> Solution {
    let (constant, _) = is_noticed([0.5; 3]);
    let (different, pixels) = is_noticed([0.0, 1.0, 3.0]);
    Solution::choice(&[pixels, constant, different])
}
