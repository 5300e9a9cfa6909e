//! Chapter 2: edge functions.

use super::answer::pixel;
use super::tools::{Px, hits, published, truth};
use super::{Solution, Text};
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_faults::published::sysu_inclusive::SysuInclusive;
use rasterproof_verify::comparison::Tally;

solvers!(twice, holes, owned, base);

/// A square of two halves with its corners on centres.
const CENTRED: [Px; 2] =
    [[[0.5, 0.5], [4.5, 0.5], [4.5, 4.5]], [[0.5, 0.5], [4.5, 4.5], [0.5, 4.5]]];

/// The choice that names a pixel of the diagonal, which both halves draw if edges belong to both.
fn twice(choices: &[Text]) -> Solution {
    let window = PixelRect::window(6, 6);
    let inclusive = published(&SysuInclusive, &CENTRED, window);
    let right = truth(&CENTRED, window);
    let mut all = Vec::new();
    for text in choices {
        all.push(pixel(&text[0]).is_some_and(|p| hits(&inclusive, p) == 2));
    }
    let doubles = inclusive.rows().flat_map(|(_, row)| row).filter(|&&n| n == 2).count();
    Solution::choice(&all)
        .figure(doubles)
        .grid("sysu-inclusive", &inclusive, &right)
        .grid("oracle", &right, &right)
}

/// Which of three rules leaves a hole between the halves: a pixel that should be drawn and is not.
fn holes(_: &[Text]) -> Solution {
    let window = PixelRect::window(6, 6);
    let right = truth(&CENTRED, window);
    let strict = Games101Strict { whole_samples: false, true_w: false };
    let strict = published(&strict, &CENTRED, window);
    let inclusive = published(&SysuInclusive, &CENTRED, window);
    let all = [&strict, &inclusive, &right].map(|drawn| Tally::between(drawn, &right).missing > 0);
    Solution::choice(&all)
        .figure(right.covered() - strict.covered())
        .grid("games101-strict", &strict, &right)
        .grid("sysu-inclusive", &inclusive, &right)
        .grid("oracle", &right, &right)
}

/// Each of its edges passes through centres, and the top-left rule draws those on two of the three.
const RIGHT_ANGLE: Px = [[0.5, 0.5], [4.5, 0.5], [0.5, 4.5]];

/// How many pixels a triangle has by the top-left rule, and by the two others.
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

/// Two triangles with a common base, which is the lower edge of one and the upper edge of the other.
const STANDING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 0.5]];
const HANGING: Px = [[1.5, 3.5], [6.5, 3.5], [4.0, 6.5]];

/// Which of two triangles owns the pixels on their common base.
fn base(_: &[Text]) -> Solution {
    let window = PixelRect::window(8, 8);
    let [upper, lower] = [STANDING, HANGING].map(|triangle| truth(&[triangle], window));
    // The centres of row 3 lie on the base.
    let [above, below] =
        [&upper, &lower].map(|coverage| coverage.row(3)[1..7].iter().any(|&n| n > 0));
    let all = [above && !below, below && !above, above && below, !above && !below];
    let row = lower.row(3).iter().map(|&n| u32::from(n)).sum::<u32>();
    Solution::choice(&all).figure(row).grid("upper", &upper, &upper).grid("lower", &lower, &lower)
}
