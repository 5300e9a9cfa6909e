//! Chapter 1: pixels, the window and the lattice.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Solution, Text};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_faults::published::games101_strict::Games101Strict;

solvers!(negative, tie, small, base);

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

const STANDING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 0.5]];
const HANGING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 6.5]];

fn base(_: &[Text]) -> Solution {
    let window = PixelRect::window(8, 8);
    let [upper, lower] = [STANDING, HANGING].map(|triangle| truth(&[triangle], window));
    let owns = |coverage| (1..7).any(|x| hits(coverage, [x, 3]) > 0);
    let (above, below) = (owns(&upper), owns(&lower));
    let all = [above && !below, below && !above, above && below, !above && !below];
    let row = lower.row(3).iter().map(|&n| u32::from(n)).sum::<u32>();
    Solution::choice(&all).figure(row).grid("upper", &upper, &upper).grid("lower", &lower, &lower)
}
