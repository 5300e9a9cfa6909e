//! Chapter 7: clipping.

use glam::DVec4;

use super::{Solution, Text};
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{ClipPlane, MOST_VERTICES, clip, outcode};

solvers!(share, corners, rejected, most);

/// A vertex in clip space with one attribute.
fn vertex(x: f64, y: f64, z: f64, w: f64, varying: f64) -> ClipVertex<f64> {
    ClipVertex { position: DVec4::new(x, y, z, w), varying }
}

/// Two corners at z = 2, and one behind the near plane, at z = -2; w is 1, so g = w + z is 3 and -1.
fn behind() -> [ClipVertex<f64>; 3] {
    [
        vertex(0.0, 0.5, 2.0, 1.0, 0.0),
        vertex(0.5, 0.0, 2.0, 1.0, 0.0),
        vertex(0.0, 0.0, -2.0, 1.0, 1.0),
    ]
}

/// Where the edges cross the near plane, as a share of their length.
fn share(_: &[Text]) -> Solution {
    let (polygon, _) = clip(&behind(), ClipPlane::Near.bit());
    // The attribute runs from 0 to 1 along the edge, so that it is t at the crossing.
    let t = polygon.vertices().map(|v| v.varying).fold(0.0, f64::max);
    Solution::number(t, 2)
}

/// A triangle with one corner cut off has four.
fn corners(_: &[Text]) -> Solution {
    let (polygon, _) = clip(&behind(), ClipPlane::Near.bit());
    Solution::count(polygon.vertices().len() as u64)
}

/// Corners as (x, y); z is 0 and w is 1, so the borders are at -1 and 1.
const CASES: [[[f64; 2]; 3]; 3] = [
    [[-0.5, 0.0], [0.5, 0.0], [0.0, 0.5]],
    [[2.0, 0.0], [3.0, 1.0], [2.0, -3.0]],
    [[-3.0, 0.0], [0.0, 3.0], [3.0, 0.0]],
];

/// Which triangle is dropped by its outcodes alone: all three corners have the bit of one plane.
fn rejected(_: &[Text]) -> Solution {
    let rejected = CASES.map(|case| {
        let [a, b, c] = case.map(|[x, y]| outcode(&vertex(x, y, 0.0, 1.0, 0.0)));
        a & b & c != 0
    });
    Solution::choice(&rejected)
}

/// Each plane adds at most one vertex to the three.
fn most(_: &[Text]) -> Solution {
    Solution::count(MOST_VERTICES as u64).figure(ClipPlane::ALL.len())
}
