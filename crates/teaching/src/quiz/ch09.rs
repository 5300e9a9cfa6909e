//! Chapter 9: stages, culling, frames.

use glam::DVec3;

use super::tools::{Px, corners, draw};
use super::{Solution, Text};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::target::Antialias;

solvers!(winding, area, thin, shared);

/// The way the corners run: clockwise, counter-clockwise, neither.
fn turns(triangle: Px) -> [bool; 3] {
    let [clockwise, counter] =
        [Cull::Clockwise, Cull::CounterClockwise].map(|cull| cull.removes(corners(triangle)));
    [clockwise, counter, !clockwise && !counter]
}

const RIGHT_ANGLE: Px = [[1.0, 1.0], [6.0, 1.0], [1.0, 6.0]];

/// Which way a triangle runs, by the culling of the pipeline.
fn winding(_: &[Text]) -> Solution {
    Solution::choice(&turns(RIGHT_ANGLE))
}

fn area(_: &[Text]) -> Solution {
    let square = f64::from(SUBPIXELS).powi(2);
    let value = twice_area(&corners(RIGHT_ANGLE)) as f64 / square;
    Solution::number(value, 0)
}

/// Its third corner is less than half a subpixel from the first.
const SLIVER: Px = [[1.0, 1.0], [1.0, 5.0], [1.001, 1.0]];

/// A sliver has an area, and none after it is snapped.
fn thin(_: &[Text]) -> Solution {
    Solution::choice(&turns(SLIVER)).figure(corners(SLIVER)[2].x)
}

/// How often the vertex stage runs for a cube of indexed vertices, and how often it would run for corners.
fn shared(_: &[Text]) -> Solution {
    // The bits of its number are the coordinates of a vertex.
    let cube: Vec<_> =
        (0..8).map(|i| DVec3::from([i & 1, i >> 1 & 1, i >> 2].map(f64::from)) / 2.0).collect();
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    // Each face as two triangles, twelve in all.
    let triangles: Vec<[u32; 3]> =
        faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let (counters, _) = draw(&cube, &triangles, 4, Antialias::None);
    Solution::count(counters.vertices).figure(counters.triangles * 3)
}
