//! What the published algorithms follow, recognised from their answers in this process.

use rasterproof::convention::{
    Ask, Confidence, Diagnosis, Known, Question, Shape, Windings, diagnose,
};
use rasterproof::frame::Coverage;
use rasterproof::lineup::{self, Specimen, TriangleSpecimen};
use rasterproof::specimen::{Published, from_lattice};

struct InProcess(TriangleSpecimen);

impl Ask for InProcess {
    fn ask(&mut self, questions: &[Question]) -> Vec<Option<Coverage>> {
        let draw = |question: &Question| {
            let mut picture = Coverage::new(question.window, 0);
            let triangle = from_lattice(question.corners);
            let hit = |span: rasterproof::triangle::Span| {
                picture.hit(span.y_px, span.x0_px, span.x1_px);
            };
            self.0.cover(&triangle, question.window, hit).ok().map(|()| picture)
        };
        questions.iter().map(draw).collect()
    }
}

fn diagnosed(name: &str) -> Diagnosis {
    let Some(Specimen::Triangle(specimen)) = lineup::find(name).unwrap().specimen else {
        panic!("{name} draws no triangles")
    };
    diagnose(&mut InProcess(specimen), &Known::default(), 1)
}

#[test]
fn conventions_of_specimens_are_named() {
    let centre = Shape::Point { x: 128, y: 128 };
    let strict = diagnosed("games101-strict");
    assert_eq!((strict.convention.shape, strict.confidence), (centre, Confidence::Certain));
    assert_eq!(strict.convention.ties.edges, [false; 8]);
    assert!(strict.sentence().contains("draws nothing on an edge: neighbours leave holes"));
    let inclusive = diagnosed("sysu-inclusive");
    assert_eq!((inclusive.convention.shape, inclusive.confidence), (centre, Confidence::Certain));
    assert_eq!(inclusive.convention.ties.edges, [true; 8]);
    assert_ne!(inclusive.convention.draws, Windings::Neither);
    assert!(
        inclusive.sentence().contains("draws everything on an edge: neighbours are drawn twice")
    );
    // Sample positions through an int: y is up there, so the lower left corner.
    let whole = diagnosed("games101-int");
    println!("{}\n{}\n{}", strict.sentence(), inclusive.sentence(), whole.sentence());
    assert_eq!(whole.convention.shape, Shape::Point { x: 0, y: 256 });
    assert_eq!(whole.confidence, Confidence::Certain);
}
