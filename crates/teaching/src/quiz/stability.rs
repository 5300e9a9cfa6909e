//! Stability: which check notices which fault.

use super::tools::{Px, corners, covered};
use super::{Solution, Text};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_faults::planted::{Mutant, TriangleMutant};
use rasterproof_invariants::find;
use rasterproof_invariants::implementations::Implementations;
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::oracle::Oracle;

solvers!(notices, orders, moved, metric);

/// Names of invariants, as the choices of [`NOTICES`].
const ASKED: [&str; 3] = ["constant-attribute", "contiguous-rows", "closed-fan"];

fn notices(_: &[Text]) -> Solution {
    let subject = Implementations::with(Mutant::Triangle(TriangleMutant::InclusiveEdges));
    let kills = |name| find(name).expect("an invariant's name").kills(&subject, 1, 42);
    Solution::choice(&ASKED.map(kills))
}

const TRIANGLE: Px = [[1.2, 1.1], [6.3, 2.4], [2.7, 6.6]];

fn orders(_: &[Text]) -> Solution {
    let [a, b, c] = corners(TRIANGLE);
    let orders = [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]];
    let window = PixelRect::window(8, 8);
    let draws = |&order: &Corners| {
        covered(&TriangleMutant::CullsOneWinding, &[order], window).covered() > 0
    };
    Solution::count(orders.iter().filter(|order| draws(order)).count() as u64)
}

/// Whether a rasterizer that cuts towards zero is wrong about the triangle moved by whole pixels.
fn is_wrong_moved(x_px: i32) -> bool {
    let moved = TRIANGLE.map(|[x, y]| [x + f64::from(x_px), y]);
    let corners: [SubpixelPoint; 3] = corners(moved);
    let window = PixelRect { x0: x_px, y0: 0, x1: x_px + 8, y1: 8 };
    let right = covered(&Oracle, &[corners], window);
    let actual = covered(&TriangleMutant::TruncatesTowardsZero, &[corners], window);
    Tally::between(&actual, &right).total() > 0
}

fn moved(_: &[Text]) -> Solution {
    assert!(!is_wrong_moved(0), "the question says so");
    Solution::choice(&[20, -20, 4000].map(is_wrong_moved))
}

const SIDE: u32 = 256;

fn metric(_: &[Text]) -> Solution {
    let window = PixelRect::window(SIDE, SIDE);
    let target = Coverage::new(window, 0);
    let mut actual = target.clone();
    actual.hit(100, 100, 101);
    let wrong = Tally::between(&actual, &target).total();
    let mean_square_error = wrong as f64 / f64::from(SIDE * SIDE);
    let value = (-10.0 * mean_square_error.log10()).round();
    Solution::number(value, 0).figure(wrong)
}
