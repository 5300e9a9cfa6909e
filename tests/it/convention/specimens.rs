//! What the published algorithms follow, recognised from their answers in this process.

use rasterproof_convention::{
    Ask, Confidence, Convention, Diagnosis, Known, Quantum, Question, Rounding, Shape as Drawn,
    Windings, diagnose,
};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Coverage;
use rasterproof_faults::published::{Published, from_lattice};
use rasterproof_registry::engines::{self, Specimen};
use rasterproof_verify::cases::{self, Shape};
use rasterproof_verify::oracle::Oracle;

struct InProcess(&'static dyn Published);

impl Ask for InProcess {
    fn ask(&mut self, questions: &[Question]) -> Vec<Option<Coverage>> {
        let draw = |question: &Question| {
            let mut picture = Coverage::new(question.window, 0);
            let triangle = from_lattice(question.corners);
            let mut hit = |span: rasterproof_core::triangle::Span| {
                picture.hit(span.y_px, span.x0_px, span.x1_px);
            };
            self.0.cover(&triangle, question.window, &mut hit).ok().map(|()| picture)
        };
        questions.iter().map(draw).collect()
    }
}

fn diagnosed(name: &str) -> Diagnosis {
    let Some(Specimen::Triangle(specimen)) = engines::find(name).unwrap().specimen else {
        panic!("{name} draws no triangles")
    };
    diagnose(&mut InProcess(specimen), &Known::default(), 1)
}

#[test]
fn conventions_of_specimens_are_named() {
    let centre = Drawn::Point { x: 128, y: 128 };
    let strict = diagnosed("games101-strict");
    assert_eq!((strict.convention.shape, strict.confidence), (centre, Confidence::Certain));
    assert_eq!(strict.convention.ties.edges, [false; 8]);
    assert!(strict.sentence().contains("draws nothing on an edge: neighbours leave holes"));
    // Corners become whole pixels by a cast, and the sample is where they are.
    let inclusive = diagnosed("sysu-inclusive");
    let corner = Drawn::Point { x: 0, y: 0 };
    assert_eq!((inclusive.convention.shape, inclusive.confidence), (corner, Confidence::Certain));
    let cast = Quantum { step: 256, rounding: Rounding::TowardZero };
    assert_eq!(inclusive.convention.quantum, cast);
    assert_eq!(inclusive.convention.ties.edges, [true; 8]);
    assert_ne!(inclusive.convention.draws, Windings::Neither);
    assert!(
        inclusive.sentence().contains("draws everything on an edge: neighbours are drawn twice")
    );
    // Sample positions through an int: y is up there, so the lower left corner.
    let whole = diagnosed("games101-int");
    println!("{}\n{}\n{}", strict.sentence(), inclusive.sentence(), whole.sentence());
    assert_eq!(whole.convention.shape, Drawn::Point { x: 0, y: 256 });
    assert_eq!(whole.confidence, Confidence::Certain);
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
                let mut truth = Coverage::new(case.window, 0);
                Oracle.cover(corners, case.window, |s| truth.hit(s.y_px, s.x0_px, s.x1_px));
                let drawn = Convention::default().cover(&corners, case.window);
                assert_eq!(drawn.as_ref(), Some(&truth), "{} {corners:?}", family.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 500, "{compared}");
}
