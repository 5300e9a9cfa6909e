//! Chapter 13: textures at a distance.

use glam::DVec2;

use rasterproof_render::pipeline::footprint::Footprint;
use rasterproof_render::pipeline::texture::Texture;

use super::tools::corners;
use super::{Solution, Text};

solvers!(level, reads, between, seam);

/// A surface that faces the eye: u and v change by so much from pixel to pixel. The texture has `side` texels along each side.
fn footprint(u: f64, v: f64, side: u32) -> Footprint {
    let places = [[0.0, 0.0], [64.0, 0.0], [0.0, 64.0]];
    let uv = places.map(|[x, y]| DVec2::new(u * x, v * y));
    Footprint::new(corners(places), [1.0; 3], uv, (side, side))
}

/// Pixels that meet 4 texels across and 32 along.
fn strip() -> Footprint {
    footprint(4.0 / 256.0, 32.0 / 256.0, 256)
}

fn level(_: &[Text]) -> Solution {
    Solution::number(strip().level(DVec2::ZERO, 1.0), 0)
}

/// How many reads along the longer axis stand for one of a high level.
fn reads(_: &[Text]) -> Solution {
    let taps = strip().taps(DVec2::ZERO, 1.0, 16);
    Solution::count(taps.count.into()).figure(taps.level)
}

/// What is read between two levels, and at both.
fn between(_: &[Text]) -> Solution {
    let row = Texture::grey(4, 1, vec![0, 40, 80, 200]).expect("four texels").with_mip_map();
    let at = |level| (255.0 * row.at_level(DVec2::new(0.1, 0.5), level).x).round();
    Solution::number(at(1.5), 0).figure(at(1.0)).figure(at(2.0))
}

/// The level that a wrapped difference leads to at the seam, beside the right one.
fn seam(_: &[Text]) -> Solution {
    let (left, right) = (0.99_f64, 1.01_f64);
    let level = |difference: f64| footprint(difference, 0.0, 512).level(DVec2::ZERO, 1.0);
    let wrapped = level(right.fract() - left.fract());
    Solution::number(wrapped, 1).figure(format!("{:.1}", level(right - left)))
}
