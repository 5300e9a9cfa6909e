//! Chapter 6: depth.

use glam::DVec3;

use super::{Solution, Text};
use rasterproof_core::geometry::ORDERS;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::pipeline::transform::frustum;

solvers!(equal, half, apart, order);

/// Draws fragments (key, grey) one after another into one pixel; the grey that is left.
fn drawn(fragments: &[(u64, u8)]) -> u8 {
    let mut target = Target::new(1, 1, Antialias::None, DepthFormat::Unorm32).expect("one pixel");
    for &(key, grey) in fragments {
        target.planes[0].test_and_write(0, 0, key, || [grey, grey, grey, 255]);
    }
    target.pixel(0, 0)[0]
}

/// Of two fragments of one depth the first one stays: the test lets nearer ones pass, and not equal ones.
fn equal(_: &[Text]) -> Solution {
    let shown = drawn(&[(7, 0), (7, 255)]);
    Solution::choice(&[shown == 0, shown == 255, shown == 128])
}

/// How many colours the six orders of three fragments lead to.
fn order(_: &[Text]) -> Solution {
    let all = [(5, 50), (3, 30), (8, 80)];
    let mut shown = ORDERS.map(|order| drawn(&order.map(|i| all[i]))).to_vec();
    // Equal colours become neighbours, of which one is kept.
    shown.sort_unstable();
    shown.dedup();
    Solution::count(shown.len() as u64)
}

/// The stored depth of a point at distance z, near plane 0.1, far plane 1000.
fn depth(z: f64) -> f64 {
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 0.1, 1000.0).expect("it is a frustum");
    let p = projection * DVec3::new(0.0, 0.0, z).extend(1.0);
    (p.z / p.w + 1.0) / 2.0
}

/// The depth at twice the distance of the near plane.
fn half(_: &[Text]) -> Solution {
    let solution = Solution::number(depth(0.2), 1);
    solution.figure(format!("{:.4}", depth(10.0)))
}

/// Which format tells two distances near the far plane apart.
fn apart(choices: &[Text]) -> Solution {
    let mut all = Vec::new();
    for text in choices {
        let format = DepthFormat::ALL.into_iter().find(|format| format.name() == text[0]);
        let format = format.expect("the choices are formats");
        all.push(format.key(depth(990.0)) != format.key(depth(990.1)));
    }
    Solution::choice(&all)
}
