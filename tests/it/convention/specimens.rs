//! What the published algorithms follow, recognised from their answers in this process.

use rasterproof_core::frame::Coverage;
use rasterproof_core::triangle::Span;
use rasterproof_faults::published::from_lattice;
use rasterproof_registry::engines::{self, Specimen};
use rasterproof_verify::cases::{self, Shape};
use rasterproof_verify::convention::{
    self, Confidence, Declarations, TriangleConvention, TriangleQuestion,
};
use rasterproof_verify::oracle::Oracle;

use super::diagnosed;
use crate::recorded::hits;

/// Sample positions through an int: y is up there, so the lower left corner. `judge_recognises_conventions` is about other
/// specimens.
#[test]
fn conventions_of_specimens_are_named() {
    let Some(Specimen::Triangle(specimen)) = engines::find("games101-int").unwrap().specimen else {
        panic!("it draws triangles")
    };
    let found = diagnosed(&Declarations::default(), |question: &TriangleQuestion| {
        let mut picture = Coverage::new(question.window, 0);
        let mut hit = |span: Span| picture.hit(span.y_px, span.x0_px, span.x1_px);
        specimen.cover(&from_lattice(question.corners), question.window, &mut hit).ok()?;
        Some(picture)
    });
    let corner = convention::Shape::Point { x: 0, y: 256 };
    let named = (found.convention.shape, found.confidence);
    assert_eq!(named, (corner, Confidence::Certain), "{}", found.sentence());
}

/// The convention of this project, drawn as hypotheses are, is what the oracle says: on every family,
/// huge triangles and degenerate ones included.
#[test]
fn conventions_own_is_the_oracles() {
    let mut compared = 0;
    for family in cases::families() {
        for case in (0..40).map(|index| family.case(3, index)) {
            let Shape::Triangles { list, .. } = case.shape else { continue };
            for corners in list.iter().map(|triangle| triangle.corners()) {
                let truth = hits(&Oracle, &[corners], case.window);
                let drawn = TriangleConvention::default().cover(&corners, case.window);
                assert_eq!(drawn.as_ref(), Some(&truth), "{} {corners:?}", family.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 500, "{compared}");
}
