//! Conventions are recognised from answers alone: made-up rasterizers, specimens, recordings.

mod lines;
mod recorded;
mod specimens;
mod synthetic;

use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_report::phrases::chinese;
use rasterproof_verify::ask::Search;
use rasterproof_verify::convention::{
    Confidence, Declarations, Diagnosis, LineDiagnosis, LineQuestion, LineTie, Mirror, Pattern,
    Quantum, Rounding, Scan, Shape, Ties, TriangleConvention, TriangleQuestion, Windings, diagnose,
    diagnose_lines,
};
use rayon::prelude::*;

use crate::program::every;
use crate::snapshots::check_words;
use recorded::{Recorder, Recording};
use synthetic::{Mirrored, Owner, Synthetic, hash, picture};

/// Every phrase of a sentence has one in Chinese: no English word is left, but names of directions.
pub(crate) fn assert_chinese(sentence: &str) {
    let said = chinese(sentence);
    let mut words = said.split(|c: char| !c.is_ascii_alphabetic());
    let known = ["", "px", "N", "NE", "E", "SE", "S", "SW", "W", "NW", "x", "y"];
    let left = words.find(|word| !known.contains(word));
    assert_eq!(left, None, "{sentence}\n{said}");
    assert!(said.ends_with('。'), "{said}");
}

struct Dice(u64);

impl Dice {
    fn roll(&mut self, of: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        hash(self.0) % of
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.roll(list.len() as u64) as usize]
    }

    /// A sample position: often a simple one, else any multiple of 1/64 px in the pixel.
    fn position(&mut self) -> i32 {
        match self.roll(3) {
            0 => self.pick(&[0, 128]),
            _ => self.roll(65) as i32 * 4,
        }
    }

    fn owner(&mut self) -> Owner {
        let named = ["top-left", "top-right", "bottom-left", "bottom-right", "inclusive", "strict"];
        if self.roll(4) == 0 {
            return Owner::Facing([0; 8].map(|_| self.roll(2) == 1));
        }
        Owner::Facing(Ties::named(self.pick(&named)).unwrap().edges)
    }
}

/// The convention of a rasterizer that draws so.
fn diagnosed(
    known: &Declarations,
    mut draw: impl FnMut(&TriangleQuestion) -> Option<Coverage>,
) -> Diagnosis {
    Search::new(async |asker| diagnose(&asker, known, 1).await)
        .answered_by(|questions| questions.iter().map(&mut draw).collect())
}

/// The same of a line drawer, in a window of this side.
fn diagnosed_lines(
    side_px: i32,
    is_ordered: bool,
    seed: u64,
    mut draw: impl FnMut(&LineQuestion) -> Option<Vec<[i32; 2]>>,
) -> LineDiagnosis {
    Search::new(async |asker| diagnose_lines(&asker, side_px, is_ordered, seed).await)
        .answered_by(|questions| questions.iter().map(&mut draw).collect())
}

fn shape(dice: &mut Dice, kind: u64) -> Shape {
    let (x, y) = (dice.position(), dice.position());
    match kind {
        0 => Shape::Point { x, y },
        1 => {
            let right = x - 4 * (1 + dice.roll(64) as i32);
            Shape::Rows { left: x, right, y }
        }
        2 => Shape::Stepped { x, y },
        3 => Shape::Outline(dice.pick(&LineTie::ALL)),
        4 => {
            let reach = dice.pick(&[32, 64, 96, 128, 192]);
            Shape::Reach { x, y, reach, square: dice.roll(2) == 0 }
        }
        _ => Shape::Share { x, y, percent: dice.pick(&[10, 25, 50, 75, 90]) },
    }
}

fn made_up(number: u64) -> Synthetic {
    let mut dice = Dice(number << 20);
    let kind = number % 6;
    let shape = shape(&mut dice, kind);
    let step = match kind {
        2 => 4,
        3 => 256,
        _ => dice.pick(&[1, 1, 4, 16, 64, 256]),
    };
    let rounding =
        dice.pick(&[Rounding::Near, Rounding::HalfEven, Rounding::Down, Rounding::TowardZero]);
    let draws = dice.pick(&[
        Windings::Both,
        Windings::Both,
        Windings::Clockwise,
        Windings::CounterClockwise,
    ]);
    Synthetic { draws, step, rounding, shape, owner: dice.owner(), noise: 0 }
}

fn differences(made: &Synthetic, found: &Diagnosis) -> Vec<String> {
    let mut wrong = Vec::new();
    let c = &found.convention;
    if c.draws != made.draws {
        wrong.push(format!("draws {:?}", c.draws));
    }
    let quantum = if made.step == 1 {
        Quantum::NONE
    } else {
        Quantum { step: made.step, rounding: made.rounding }
    };
    if c.quantum != quantum {
        wrong.push(format!("quantum {:?}", c.quantum));
    }
    if c.shape != made.shape {
        wrong.push(format!("shape {:?}", c.shape));
    }
    if let (Owner::Facing(edges), false) = (
        made.owner,
        matches!(made.shape, Shape::Stepped { .. } | Shape::Outline(_) | Shape::Share { .. }),
    ) {
        let seen = found.compass.seen();
        let off: Vec<_> = (0..8).filter(|&i| seen[i] && c.ties.edges[i] != edges[i]).collect();
        if !off.is_empty() || !found.compass.is_decided() {
            wrong.push(format!("compass {:?} not {edges:?}", found.compass.edges));
        }
    }
    wrong
}

/// How sure a diagnosis was, whether it named the convention, and what it said.
type NamingResult = (Confidence, bool, String);

/// Nineteen of twenty are named, and none wrongly with certainty.
fn check_named(found: &[NamingResult]) {
    let wrong: Vec<_> = found.iter().filter(|(_, is_named, _)| !is_named).collect();
    println!("{} of {} named", found.len() - wrong.len(), found.len());
    let is_sure = |(confidence, ..): &&&NamingResult| *confidence == Confidence::Certain;
    assert_eq!(wrong.iter().filter(is_sure).count(), 0, "{wrong:#?}");
    assert!(wrong.len() * 20 <= found.len(), "{wrong:#?}");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_made_up_are_named() {
    let named = |number| {
        let made = made_up(number);
        let found = diagnosed(&Declarations::default(), |q| Some(made.draw(q)));
        let wrong = differences(&made, &found);
        let is_named = wrong.is_empty() && found.confidence != Confidence::Unexplained;
        (found.confidence, is_named, format!("#{number} {made:?}: {wrong:?} {found:?}"))
    };
    // The six kinds of shapes take turns, so every fifth number meets all of them.
    let numbers: Vec<u64> = (0..120).step_by(every(5)).collect();
    check_named(&numbers.into_par_iter().map(named).collect::<Vec<_>>());
}

/// Four samples a pixel, of which one to four are asked for; and pictures that are turned over.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_samples_and_mirrors_are_named() {
    let mut list = Vec::new();
    for number in (0..40).step_by(every(3)) {
        let mut dice = Dice(number << 24);
        let made = made_up(6 * number);
        let pattern = dice.pick(&[Pattern::Square, Pattern::Rotated]);
        let (x, y) = dice.pick(&[(128, 128), (128, 128), (0, 0), (100, 132)]);
        let shape = Shape::Samples { x, y, pattern, least: 1 + (number % 4) as u8 };
        list.push((Synthetic { shape, ..made }, Mirror::None));
    }
    for number in (0..40).step_by(every(3)) {
        let mirror = Mirror::ALL[1 + number as usize % 4];
        list.push((made_up(number), mirror));
    }
    let named = |(made, mirror)| {
        let program = Mirrored(made, mirror);
        let found = diagnosed(&Declarations::default(), |q| Some(program.draw(q)));
        let mut wrong = differences(&made, &found);
        if found.convention.mirror != mirror {
            wrong.push(format!("{:?} not {mirror:?}", found.convention.mirror));
        }
        let sentence = found.sentence();
        assert_chinese(&sentence);
        (found.confidence, wrong.is_empty(), format!("{made:?}: {wrong:?} {sentence}"))
    };
    check_named(&list.into_par_iter().map(named).collect::<Vec<_>>());
}

/// What is expected of a mirrored program is mirrored too, in windows that are no squares.
#[test]
fn conventions_of_mirrors_predict() {
    for mirror in Mirror::ALL {
        let shape = Shape::Point { x: 128, y: 128 };
        let program =
            Mirrored(Synthetic { step: 1, shape, draws: Windings::Both, ..made_up(0) }, mirror);
        let found = diagnosed(&Declarations::default(), |q| Some(program.draw(q)));
        let side = if mirror == Mirror::Exchanged { 20 } else { 24 };
        let window = PixelRect::window(side, 20);
        let corners = [(256, 300), (4000, 700), (900, 4700)].map(|(x, y)| SubpixelPoint::new(x, y));
        let question = TriangleQuestion { corners, window };
        assert_eq!(found.expected(&question), Some(program.draw(&question)), "{mirror:?}");
        let said = found.sentence().contains("draws its picture ");
        assert_eq!(said, mirror != Mirror::None, "{}", found.sentence());
    }
}

/// The comparison above can fail: what is named is compared with another rasterizer.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_another_are_not_confused() {
    for number in 0..12 {
        let made = made_up(number);
        let found = diagnosed(&Declarations::default(), |q| Some(made.draw(q)));
        assert!(!differences(&made_up(number + 6), &found).is_empty(), "{number}");
    }
}

/// What no hypothesis explains is said to be unexplained, and nothing is expected of it.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_noise_are_unexplained() {
    let question = TriangleQuestion {
        corners: [(256, 256), (2560, 300), (700, 2560)].map(|(x, y)| SubpixelPoint::new(x, y)),
        window: PixelRect::window(16, 16),
    };
    (0..12u64).into_par_iter().for_each(|number| {
        let made = Synthetic { noise: 20 + 60 * number, ..made_up(number) };
        let found = diagnosed(&Declarations::default(), |q| Some(made.draw(q)));
        assert_eq!(found.confidence, Confidence::Unexplained, "{made:?}: {}", found.sentence());
        assert!(found.sentence().starts_with("Unexplained"));
        assert!(found.expected(&question).is_none());
    });
}

/// A rasterizer that is none: its hits are a function of its corners' box, or of nothing.
fn other(
    hits: fn(&TriangleQuestion, i32, i32) -> bool,
) -> impl Fn(&TriangleQuestion) -> Option<Coverage> {
    move |q| Some(picture(q.window, |x, y| hits(q, x, y)))
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_other_shapes_are_unexplained() {
    let boxes = |q: &TriangleQuestion, x: i32, y: i32| {
        let holds = |v: [i32; 3], px: i32| {
            let at = px * 256 + 128;
            v.iter().any(|&c| c <= at) && v.iter().any(|&c| c > at)
        };
        holds(q.corners.map(|c| c.x), x) && holds(q.corners.map(|c| c.y), y)
    };
    let discs = |q: &TriangleQuestion, x: i32, y: i32| {
        let at = |v: [i32; 3], px: i32| f64::from(v.iter().sum::<i32>()) / 768.0 - f64::from(px);
        at(q.corners.map(|c| c.x), x).hypot(at(q.corners.map(|c| c.y), y)) < 4.0
    };
    type Hits = fn(&TriangleQuestion, i32, i32) -> bool;
    let all: [(&str, Hits); 3] =
        [("boxes", boxes), ("discs", discs), ("everything", |_, _, _| true)];
    for (name, hits) in all {
        let found = diagnosed(&Declarations::default(), other(hits));
        assert_eq!(found.confidence, Confidence::Unexplained, "{name}: {}", found.sentence());
    }
    let found = diagnosed(&Declarations::default(), other(|_, _, _| false));
    assert_eq!(found.convention.draws, Windings::Neither);
    assert_eq!(found.sentence(), "It draws nothing.");
}

#[test]
fn conventions_of_the_silent_are_unknown() {
    let silent = |known: Declarations| {
        Search::new(async |asker| diagnose(&asker, &known, 1).await).answered_by(|_| Vec::new())
    };
    let found = silent(Declarations::default());
    assert_eq!((found.confidence, found.asked), (Confidence::Unexplained, found.refused));
    assert_eq!(found.sentence(), "Unexplained: it answered none of 20 questions.");
    let found = silent(Declarations { window_px: (8, 8), ..Declarations::default() });
    assert_eq!(found.sentence(), "Not asked: a window or range of 16 px is needed.");
}

/// Ties by the order of the corners: no direction is decided, and the order is named.
#[test]
fn conventions_by_corner_order_are_said_to_be_so() {
    let shape = Shape::Point { x: 128, y: 128 };
    let made = Synthetic { shape, owner: Owner::FirstEdge, draws: Windings::Both, ..made_up(0) };
    let made = Synthetic { step: 1, ..made };
    let found = diagnosed(&Declarations::default(), |q| Some(made.draw(q)));
    assert_eq!((found.convention.shape, found.confidence), (shape, Confidence::Certain));
    assert!(!found.compass.is_decided() && found.rotated.drawn > 10, "{found:?}");
    let text = found.sentence();
    assert!(
        text.contains("in no fixed way (N ") && text.contains("order of the corners"),
        "{text}"
    );
}

/// The scan conversions of libraries, drawn by themselves: each is named, and not where single pixels
/// are otherwise.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_scans_are_named() {
    // Of 1,000 pictures so many have a pixel more.
    let drawn = |convention: TriangleConvention, wrong: u64| {
        move |q: &TriangleQuestion| {
            let mut picture = convention.cover(&q.corners, q.window)?;
            let key = q.corners.iter().fold(7, |h, p| hash(h ^ p.x as u64) ^ p.y as u64);
            if hash(key) % 1000 < wrong {
                picture.hit(3, 3, 4);
            }
            Some(picture)
        }
    };
    for scan in Scan::ALL {
        let shape = Shape::Scan(scan);
        let convention = TriangleConvention { shape, ..TriangleConvention::default() };
        let found = diagnosed(&Declarations::default(), drawn(convention, 0));
        let text = found.sentence();
        let named = (found.convention.shape, found.confidence);
        assert_eq!(named, (shape, Confidence::Certain), "{text}");
        assert_chinese(&text);
        let found = diagnosed(&Declarations::default(), drawn(convention, 100));
        let is_sure = found.confidence == Confidence::Certain;
        assert!(!is_sure, "{scan:?}: {}", found.sentence());
    }
}

/// Where coordinates are whole pixels or 1/16 px, what is found predicts all answers on that grid.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_on_coarse_grids_predict() {
    let mut dice = Dice(77);
    for (number, grid) in (0..12).flat_map(|n| [(n, 1), (n, 16)]) {
        let made = Synthetic { step: 1, ..made_up(number) };
        if matches!(made.shape, Shape::Outline(_) | Shape::Stepped { .. }) {
            continue;
        }
        let known = Declarations { grid, window_px: (24, 20), ..Declarations::default() };
        let found = diagnosed(&known, |q| Some(made.draw(q)));
        let window = PixelRect::window(20, 20);
        let mut wrong = 0;
        for _ in 0..100 {
            let mut place = || dice.roll(20 * grid as u64) as i32 * (256 / grid);
            let corners = [0; 3].map(|_| SubpixelPoint::new(place(), place()));
            let question = TriangleQuestion { corners, window };
            if let Some(expected) = found.expected(&question) {
                wrong += u64::from(expected != made.draw(&question));
            }
        }
        assert!(found.confidence != Confidence::Unexplained, "{made:?}: {}", found.sentence());
        assert!(wrong <= 5, "{wrong} of 100 wrong: {made:?}: {}", found.sentence());
    }
}

const LIBRARIES: &str = "cairo gdal java2d-path mupdf opencv-convex opencv-fillpoly osmesa-llvmpipe \
    pillow sdl2 skia skimage";

/// What is said of the answers of libraries, and how many of the pictures it predicts.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn conventions_of_libraries_are_named() {
    let said = |name: &str| {
        let recording = Recording::read(name);
        let found = diagnosed(&Declarations::default(), |q| recording.triangle(q));
        let (c, as_found) = (found.convention, &found.as_found);
        let predicted = [as_found.general.triangles, as_found.ties.triangles]
            .map(|count| format!("{} of {}", count.drawn, count.of));
        let of =
            format!("{:?}\n{:?}, {:?}, draws {:?}", found.confidence, c.shape, c.quantum, c.draws);
        format!("{name}: {of}\npredicted: {}\n{}\n", predicted.join(", of ties "), found.sentence())
    };
    let said: Vec<_> = LIBRARIES.par_split(' ').map(said).collect();
    check_words("libraries", &said.join("\n"));
}

#[test]
fn conventions_of_library_lines_are_named() {
    let said = |name: &str| {
        let recording = Recording::read(name);
        let found = diagnosed_lines(40, false, 1, |q| recording.line(q));
        let (c, both) = (found.convention, found.both_ways);
        let of = format!("{:?}\n{c:?}, both ways {} of {}", found.confidence, both.drawn, both.of);
        format!("{name}: {of}\n{}\n", found.sentence())
    };
    let without_lines = ["cairo", "java2d-path"];
    let names = LIBRARIES.split(' ').filter(|name| !without_lines.contains(name));
    let said: Vec<_> = names.map(said).collect();
    check_words("library-lines", &said.join("\n"));
}

/// Records what a program answers, for `tests/data/wild`: `RECORD='NAME CMD ARGS' cargo test --test
/// it conventions_record -- --ignored`. It writes `target/wild/NAME.txt.gz`.
#[test]
#[ignore = "a tool"]
fn conventions_record() {
    let order = std::env::var("RECORD").expect("RECORD='NAME CMD ARGS'");
    let (name, command) = order.split_once(' ').expect("a name and a command");
    let mut recorder = Recorder::start(command);
    let found = diagnosed(&Declarations::default(), |q| recorder.triangle(q));
    println!("{:?}: {:?}\n{}", recorder.words, found.confidence, found.sentence());
    if recorder.words.iter().any(|word| word == "line") {
        let found = diagnosed_lines(40, false, 1, |q| recorder.line(q));
        println!("{:?}\n{} {found:?}", found.confidence, found.sentence());
    }
    let path = format!("{}/target/wild/{name}.txt.gz", env!("CARGO_MANIFEST_DIR"));
    recorder.write(std::path::Path::new(&path));
}
