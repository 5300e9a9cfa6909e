//! GAMES101 homework 2: samples, averages, the box, the depth.

use glam::{DVec2, DVec3};

use super::tools::draw;
use super::{Right, Solution, Text};
use rasterproof_faults::published::{games101_box, games101_depth};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};

solvers!(shaded, average, bounding_box, depth);

/// How often the fragment stage runs for pixel (3, 3), which lies wholly inside a triangle.
fn times_shaded(antialias: Antialias) -> usize {
    let corners = [[1.0, 1.0], [7.0, 1.5], [2.0, 7.0]];
    let positions = corners.map(|[x, y]| DVec3::new(x / 4.0 - 1.0, 1.0 - y / 4.0, 0.0));
    let (_, places) = draw(&positions, &[[0, 1, 2]], 8, antialias);
    places.into_iter().filter(|place| place.floor() == DVec2::splat(3.0)).count()
}

/// How often the colour of a pixel is computed by both kinds of samples.
fn shaded(_: &[Text]) -> Solution {
    let counts = [Antialias::Supersample(2), Antialias::Multisample4].map(times_shaded);
    let all = [[4, 4], [4, 1], [1, 4], [1, 1]];
    Solution::choice(&all.map(|pair| pair == counts))
}

/// One pixel of 2 x 2 samples; each is drawn with the colour at its place, or left black.
fn resolved(samples: [Option<Colour>; 4]) -> Colour {
    let mut target =
        Target::new(1, 1, Antialias::Supersample(2), Default::default()).expect("a small target");
    target.clear_colour([0, 0, 0, u8::MAX], &mut Counters::default());
    for ((x, y), colour) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().zip(samples) {
        if let Some(colour) = colour {
            target.planes[0].write(x, y, colour);
        }
    }
    target.pixel(0, 0)
}

/// What a pixel shows of a green and three blue samples if all of them are averaged at the end.
fn average(_: &[Text]) -> Solution {
    let (green, blue) = (Some([0, 255, 0, 255]), Some([0, 0, 255, 255]));
    let whole = resolved([green, blue, blue, blue]);
    // As published, blue's own average over black replaces what green left.
    let last = resolved([None, blue, blue, blue]);
    Solution::count(u64::from(whole[1])).figure(last[1]).figure(last[2])
}

/// Where a pixel beyond the right border lands in a list of rows.
fn bounding_box(_: &[Text]) -> Solution {
    let (x, y) = games101_box::lands(11, 4, 8);
    Solution::new(Right::Pixel([x, y])).figure(4 * 8 + 11)
}

/// The depth halfway between two corners by the homework's formula.
fn depth(_: &[Text]) -> Solution {
    let value = games101_depth::published([-1.0, 1.0], [1.0, 4.0], 0.5);
    Solution::number(value, 1)
}
