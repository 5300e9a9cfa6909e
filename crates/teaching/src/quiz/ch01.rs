//! Chapter 1: pixels, the window and the lattice.

use super::answer::pixel;
use super::tools::{Px, published, truth};
use super::{Solution, Text};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_faults::published::games101_strict::Games101Strict;

solvers!(negative, tie, small);

/// The pixel that holds a point left of the window: the subpixels of its position are divided downwards, and a cast, which is shown
/// beside it, would divide towards zero.
fn negative(choices: &[Text]) -> Solution {
    let point = SubpixelPoint::from_px(-0.3, 0.2).expect("within the domain");
    let holds = [point.x, point.y].map(|sub| sub.div_euclid(SUBPIXELS));
    let all: Vec<_> = choices.iter().map(|text| pixel(&text[0]) == Some(holds)).collect();
    Solution::choice(&all).figure(point.x).figure(-0.3f64 as i32)
}

/// Where three positions halfway between two subpixels are snapped to: to the even one of the two.
fn tie(_: &[Text]) -> Solution {
    let to = |sub: f64| snap(sub / f64::from(SUBPIXELS)).expect("within the domain");
    let value = f64::from(to(2.5));
    Solution::number(value, 0).figure(to(1.5)).figure(to(2.5)).figure(to(3.5))
}

/// A triangle that covers no centre of a pixel, and the corner of one.
const BETWEEN: Px = [[0.9, 0.9], [1.4, 0.9], [0.9, 1.4]];

/// How many samples of a small triangle are covered where they are whole numbers.
fn small(_: &[Text]) -> Solution {
    let window = PixelRect::window(4, 4);
    // The homework cast its samples to whole numbers, which are the corners of pixels.
    let right = truth(&[BETWEEN], window);
    let cast = Games101Strict { whole_samples: true, true_w: false };
    let cast = published(&cast, &[BETWEEN], window);
    Solution::count(right.covered())
        .figure(cast.covered())
        .grid("games101-int", &cast, &right)
        .grid("oracle", &right, &right)
}
