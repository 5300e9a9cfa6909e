//! Stability: which check notices which fault.

use super::tools::{Px, corners, covered};
use super::{Solution, Text};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_faults::planted::{Mutant, TriangleMutant};
use rasterproof_invariants::find;
use rasterproof_invariants::implementations::Implementations;
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::oracle::Oracle;

solvers!(notices, orders, moved, metric);

/// Names of invariants, as the choices of [`NOTICES`].
const ASKED: [&str; 3] = ["constant-attribute", "contiguous-rows", "closed-fan"];

/// Which invariant notices a rule that draws every sample on an edge.
fn notices(_: &[Text]) -> Solution {
    let subject = Implementations::with(Mutant::Triangle(TriangleMutant::InclusiveEdges));
    let kills = |name| find(name).expect("an invariant's name").kills(&subject, 1, 42);
    Solution::choice(&ASKED.map(kills))
}

/// Its corners lie on no simple place.
const TRIANGLE: Px = [[1.2, 1.1], [6.3, 2.4], [2.7, 6.6]];

/// In how many orders of its corners a triangle is drawn by an engine that draws one winding.
fn orders(_: &[Text]) -> Solution {
    let [a, b, c] = corners(TRIANGLE);
    let orders = [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]];
    let window = PixelRect::window(8, 8);
    let mut count = 0;
    for order in orders {
        let drawn = covered(&TriangleMutant::CullsOneWinding, &[order], window);
        count += u64::from(drawn.covered() > 0);
    }
    Solution::count(count)
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

/// A cut towards zero goes the other way for negative coordinates alone.
fn moved(_: &[Text]) -> Solution {
    assert!(!is_wrong_moved(0), "the question says so");
    Solution::choice(&[20, -20, 4000].map(is_wrong_moved))
}

const SIDE: u32 = 256;

/// How good one wrong pixel looks to a metric that averages over the picture.
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
