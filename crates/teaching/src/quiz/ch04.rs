//! Chapter 4: homogeneous coordinates and projection.

use glam::{DVec3, DVec4};

use super::{Solution, Text};
use rasterproof_render::pipeline::transform::frustum;

solvers!(same, distance, film, halfway);

/// Points in homogeneous coordinates, one of which is the same place as (2, 1, 4, 2).
const FOUR: [DVec4; 3] = [
    DVec4::new(2.0, 1.0, 4.0, 1.0),
    DVec4::new(4.0, 2.0, 8.0, 4.0),
    DVec4::new(3.0, 2.0, 5.0, 3.0),
];

/// Points are compared after the division by w.
fn same(_: &[Text]) -> Solution {
    let place = |p: DVec4| p.truncate() / p.w;
    let there = place(DVec4::new(2.0, 1.0, 4.0, 2.0));
    let solution = Solution::choice(&FOUR.map(|p| place(p) == there));
    solution.figure(there.x).figure(there.y).figure(there.z)
}

/// A point in clip space; the film is 1 before the eye and reaches from -1 to 1.
fn project(p: DVec3) -> DVec4 {
    frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).expect("it is a frustum") * p.extend(1.0)
}

/// w of a projected point, which is its distance.
fn distance(_: &[Text]) -> Solution {
    let w = project(DVec3::new(2.0, 1.0, 4.0)).w;
    Solution::number(w, 0)
}

fn film(_: &[Text]) -> Solution {
    let p = project(DVec3::new(2.0, 1.0, 4.0));
    Solution::number(p.x / p.w, 2)
}

/// Which share of the way on the film the middle of a segment in space has.
fn halfway(_: &[Text]) -> Solution {
    let ends = [DVec3::new(-2.0, 0.0, 2.0), DVec3::new(6.0, 0.0, 6.0)];
    let on_film = |p: DVec3| project(p).x / project(p).w;
    let [a, middle, b] = [ends[0], (ends[0] + ends[1]) / 2.0, ends[1]].map(on_film);
    Solution::number((middle - a) / (b - a), 2)
}
