//! Chapter 2: lines and triangles.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Right, Solution, Text};
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_faults::published::sysu_inclusive::SysuInclusive;

solvers!(longer, halfway, twice, holes, owned);

fn line(from: [i32; 2], to: [i32; 2], window: PixelRect) -> Coverage {
    let end = |[x, y]: [i32; 2]| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 };
    let mut lit = Coverage::new(window, 0);
    let line = ScreenLine { ends: [end(from), end(to)] };
    Bresenham.draw(&line, window, |f| lit.hit(f.y_px, f.x_px, f.x_px + 1));
    lit
}

fn longer(_: &[Text]) -> Solution {
    let lit = line([0, 0], [3, 9], PixelRect::window(4, 10));
    Solution::count(lit.covered()).grid("0,0 3,9", &lit, &lit)
}

fn halfway(_: &[Text]) -> Solution {
    let window = PixelRect::window(9, 4);
    let [there, back] = [line([0, 0], [8, 3], window), line([8, 3], [0, 0], window)];
    let row = (0..4).find(|&y| hits(&there, [4, y]) > 0).expect("every column is lit");
    // Either direction must light it.
    assert_eq!(there, back, "a line does not depend on its direction");
    Solution::new(Right::Pixel([4, row])).grid("0,0 8,3", &there, &there)
}

/// A square of two halves with its corners on centres.
const CENTRED: [Px; 2] =
    [[[0.5, 0.5], [4.5, 0.5], [4.5, 4.5]], [[0.5, 0.5], [4.5, 4.5], [0.5, 4.5]]];

fn twice(choices: &[Text]) -> Solution {
    let window = PixelRect::window(6, 6);
    let inclusive = published(&SysuInclusive, &CENTRED, window);
    let right = truth(&CENTRED, window);
    let twice = |text: &Text| pixel(&text[0]).is_some_and(|p| hits(&inclusive, p) == 2);
    let all: Vec<_> = choices.iter().map(twice).collect();
    let doubles = inclusive.rows().flat_map(|(_, row)| row).filter(|&&n| n == 2).count();
    Solution::choice(&all)
        .figure(doubles)
        .grid("sysu-inclusive", &inclusive, &right)
        .grid("oracle", &right, &right)
}

fn holes(_: &[Text]) -> Solution {
    let window = PixelRect::window(6, 6);
    let right = truth(&CENTRED, window);
    let strict = Games101Strict { whole_samples: false, true_w: false };
    let strict = published(&strict, &CENTRED, window);
    let inclusive = published(&SysuInclusive, &CENTRED, window);
    let is_hole = |(a, t): (&u8, &u8)| *a == 0 && *t > 0;
    let has_hole = |c: &Coverage| {
        c.rows().zip(right.rows()).any(|((_, a), (_, t))| a.iter().zip(t).any(is_hole))
    };
    let all = [&strict, &inclusive, &right].map(has_hole);
    Solution::choice(&all)
        .figure(right.covered() - strict.covered())
        .grid("games101-strict", &strict, &right)
        .grid("sysu-inclusive", &inclusive, &right)
        .grid("oracle", &right, &right)
}

const RIGHT_ANGLE: Px = [[0.5, 0.5], [4.5, 0.5], [0.5, 4.5]];

fn owned(_: &[Text]) -> Solution {
    let window = PixelRect::window(6, 6);
    let right = truth(&[RIGHT_ANGLE], window);
    let strict = Games101Strict { whole_samples: false, true_w: false };
    let strict = published(&strict, &[RIGHT_ANGLE], window);
    let inclusive = published(&SysuInclusive, &[RIGHT_ANGLE], window);
    Solution::count(right.covered())
        .figure(strict.covered())
        .figure(inclusive.covered())
        .grid("oracle", &right, &right)
        .grid("sysu-inclusive", &inclusive, &right)
}
