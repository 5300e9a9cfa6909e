//! Chapter 2: edge functions.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Solution, Text};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_faults::published::sysu_inclusive::SysuInclusive;

solvers!(twice, holes, owned, base);

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
