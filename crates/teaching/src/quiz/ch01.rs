//! Chapter 1: pixels, the window and the lattice.

use super::answer::pixel;
use super::tools::{Px, published, truth};
use super::{Solution, Text};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_faults::published::games101_strict::Games101Strict;

solvers!(negative, tie, small);

fn negative(choices: &[Text]) -> Solution {
    let point = SubpixelPoint::from_px(-0.3, 0.2).expect("within the domain");
    let holds = [point.x, point.y].map(|sub| sub.div_euclid(SUBPIXELS));
    let all: Vec<_> = choices.iter().map(|text| pixel(&text[0]) == Some(holds)).collect();
    Solution::choice(&all).figure(point.x).figure(-0.3f64 as i32)
}

fn tie(_: &[Text]) -> Solution {
    let to = |sub: f64| snap(sub / f64::from(SUBPIXELS)).expect("within the domain");
    let value = f64::from(to(2.5));
    Solution::number(value, 0).figure(to(1.5)).figure(to(2.5)).figure(to(3.5))
}

const BETWEEN: Px = [[0.9, 0.9], [1.4, 0.9], [0.9, 1.4]];

fn small(_: &[Text]) -> Solution {
    let window = PixelRect::window(4, 4);
    let right = truth(&[BETWEEN], window);
    let cast = Games101Strict { whole_samples: true, true_w: false };
    let cast = published(&cast, &[BETWEEN], window);
    Solution::count(right.covered())
        .figure(cast.covered())
        .grid("games101-int", &cast, &right)
        .grid("oracle", &right, &right)
}
