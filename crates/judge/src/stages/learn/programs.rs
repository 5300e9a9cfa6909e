//! Wrong programs as altered answers of a right engine: what is learned of each.

use glam::DVec2;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_registry::engines;
use rasterproof_verify::ask::Search;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::mistakes::values::{sum, weights};

use super::{Learned, learn};
use crate::ask::{Answer, Asked, Question, Subject};
use crate::check::{Check, Truth};
use crate::declared::Declared;
use crate::depth::Pile;
use crate::expected::{Expect as _, exact_values};
use crate::in_process::Inside;
use crate::pixels::masks_of;
use crate::run::MOST_DEATHS;

/// What is wrong of an answer to a question.
type Alter = fn(&Question, &mut Answer, &mut Inside);

struct AlteredEngine(Inside, Alter);

impl Subject for AlteredEngine {
    fn declared(&self) -> &Declared {
        self.0.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let mut answers = self.0.ask(questions, most_deaths);
        for (question, answer) in questions.iter().zip(&mut answers) {
            (self.1)(question, answer, &mut self.0);
        }
        answers
    }
}

/// What is learned of a program by so many questions.
fn learned_of(
    program: &mut dyn Subject,
    check: Check,
    truth: &Truth,
    most: usize,
) -> Option<Learned> {
    let mut search = Search::new(async |asker| learn(&asker, check, truth).await);
    search.allow(most);
    search.answered_by(|questions| program.ask(questions, MOST_DEATHS))
}

fn learned(check: Check, alter: Alter) -> Learned {
    let mut program = AlteredEngine(Inside::new(engines::find("scanline").unwrap()), alter);
    let truth = Truth::of(program.declared());
    let learned = learned_of(&mut program, check, &truth, usize::MAX).unwrap();
    println!("{}", learned.sentences().join("\n"));
    learned
}

/// That all is predicted, and what is said of it first.
fn explains(check: Check, alter: Alter, said: &str) {
    let learned = learned(check, alter);
    assert!(learned.is_certain, "{:?}", learned.sentences());
    assert!(learned.does.iter().any(|does| does.contains(said)), "{:?}", learned.does);
}

/// The answer to another question.
fn ask(engine: &mut Inside, question: &Question, of: Asked) -> Answer {
    engine.ask(&[Question { of, ..question.clone() }], 1).remove(0)
}

/// The triangles that are seen without some of them.
fn without(
    question: &Question,
    engine: &mut Inside,
    is_kept: &dyn Fn(usize, &Triangle) -> bool,
) -> Answer {
    let Asked::Depth(list) = &question.of else { panic!("depth") };
    // The others are asked alone, and get their own numbers back.
    let kept: Vec<usize> = (0..list.len()).filter(|&i| is_kept(i, &list[i])).collect();
    if kept.is_empty() {
        return Answer::Seen(Vec::new());
    }
    let some = kept.iter().map(|&i| list[i]).collect();
    match ask(engine, question, Asked::Depth(some)) {
        Answer::Seen(runs) => Answer::Seen(
            runs.into_iter().map(|(run, t)| (run, kept[usize::from(t)] as u8)).collect(),
        ),
        other => other,
    }
}

/// Each value of each pixel: which one, at which column and row.
fn each_value(answer: &mut Answer, alter: &dyn Fn(usize, [i32; 2], f64) -> f64) {
    let Answer::Values(fragments) = answer else { return };
    for f in fragments {
        let at = [f.x_px, f.y_px];
        f.depth = alter(0, at, f.depth);
        f.varying.x = alter(1, at, f.varying.x);
        f.varying.y = alter(2, at, f.varying.y);
    }
}

/// A list with a fixed length, whose end is lost.
#[test]
fn triangles_from_the_seventeenth_on_are_not_drawn() {
    let alter: Alter = |question, answer, engine| {
        *answer = without(question, engine, &|number, _| number < 16);
    };
    explains(
        Check::Depth,
        alter,
        "does not draw a triangle where its place in the list (from 1) is 17 or more",
    );
}

/// A tiled renderer whose bins are too small: what comes too late in a tile is lost there alone.
#[test]
fn bins_of_tiles_hold_five_triangles() {
    const SIDE: i32 = 16;
    const MOST: usize = 5;
    let alter: Alter = |question, answer, engine| {
        let Asked::Depth(list) = &question.of else { panic!("depth") };
        let tile = |x: i32, y: i32| [x / SIDE, y / SIDE];
        // Which triangles each tile has.
        let mut bins = std::collections::BTreeMap::<[i32; 2], Vec<usize>>::new();
        for (number, triangle) in list.iter().enumerate() {
            let Answer::Seen(runs) = ask(engine, question, Asked::Depth(vec![*triangle])) else {
                return;
            };
            for x_y in
                runs.iter().flat_map(|(run, _)| (run.x0_px..run.x1_px).map(|x| (x, run.y_px)))
            {
                let bin = bins.entry(tile(x_y.0, x_y.1)).or_default();
                if bin.len() < MOST && bin.last() != Some(&number) {
                    bin.push(number);
                }
            }
        }
        // Each tile is drawn by its own triangles.
        let mut seen = Vec::new();
        for (at, bin) in &bins {
            let Answer::Seen(runs) = without(question, engine, &|i, _| bin.contains(&i)) else {
                return;
            };
            for (run, number) in runs {
                let here = (run.x0_px..run.x1_px).filter(|x| tile(*x, run.y_px) == *at);
                seen.extend(here.map(|x| (Span { x0_px: x, x1_px: x + 1, ..run }, number)));
            }
        }
        seen.sort_by_key(|(run, _)| (run.y_px, run.x0_px));
        *answer = Answer::Seen(seen);
    };
    explains(
        Check::Depth,
        alter,
        "its place among the triangles that cover a pixel of its tile of 16 px is 6 or more",
    );
}

/// Fragments outside of the triangle must not end the search.
#[test]
fn values_below_the_triangle_are_looked_at() {
    let alter: Alter = |_, answer, _| {
        let Answer::Values(fragments) = answer else { return };
        fragments.iter_mut().for_each(|f| f.y_px += 5);
    };
    assert!(!learned(Check::Values, alter).sentences().is_empty());
}

/// A word that is too short, which matters for large triangles alone.
#[test]
fn twice_the_area_wraps_in_16_bits() {
    let alter: Alter = |question, answer, _| {
        let Asked::Values(triangle) = &question.of else { return };
        let area = twice_area(&triangle.corners());
        let growth = area as f64 / f64::from(area as i16);
        each_value(answer, &|which, _, value| if which == 0 { value * growth } else { value });
    };
    explains(
        Check::Values,
        alter,
        "twice the area was kept in a word of 16 bits that counts square subpixels",
    );
}

/// Values computed once for four columns, and only where a triangle is high.
#[test]
fn values_are_those_of_blocks_in_high_triangles() {
    let alter: Alter = |question, answer, _| {
        let Asked::Values(triangle) = &question.of else { return };
        let y = triangle.corners().map(|c| c.y);
        let height = y.into_iter().max().unwrap_or(0) - y.into_iter().min().unwrap_or(0);
        if height < 6 * SUBPIXELS {
            return;
        }
        let Answer::Values(fragments) = answer else { return };
        for f in fragments {
            // The values of the pixel in the first of its 4 columns.
            let back = f64::from(f.x_px % 4);
            let at = [f64::from(f.x_px) + 0.5 - back, f64::from(f.y_px) + 0.5];
            let linear = weights(&triangle.corners(), at);
            let parts = [0, 1, 2].map(|i| linear[i] * triangle.vertices[i].inv_w);
            let whole: f64 = parts.iter().sum();
            let corrected = parts.map(|part| part / whole);
            let v = &triangle.vertices;
            f.depth = sum(linear, v.map(|v| v.depth));
            f.varying.x = sum(corrected, v.map(|v| v.varying.x));
            f.varying.y = sum(corrected, v.map(|v| v.varying.y));
        }
    };
    explains(Check::Values, alter, "the right value of the first of its 4 columns");
}

/// No test of depth, where the window is wide.
#[test]
fn the_last_triangle_is_shown_in_wide_windows() {
    let alter: Alter = |question, answer, engine| {
        let Asked::Depth(list) = &question.of else { return };
        if question.width <= 12 {
            return;
        }
        // Of each pixel the last triangle that covers it: each is asked alone.
        let mut seen = std::collections::BTreeMap::new();
        for (number, triangle) in list.iter().enumerate() {
            let Answer::Seen(runs) = ask(engine, question, Asked::Depth(vec![*triangle])) else {
                return;
            };
            for (run, _) in runs {
                seen.extend((run.x0_px..run.x1_px).map(|x| ((run.y_px, x), number as u8)));
            }
        }
        let run = |(y_px, x): (i32, i32)| Span { y_px, x0_px: x, x1_px: x + 1 };
        *answer = Answer::Seen(seen.into_iter().map(|(at, number)| (run(at), number)).collect());
    };
    explains(Check::Depth, alter, "the width of the window");
}

/// A mask that loses a bit in every second row.
#[test]
fn the_last_sample_is_lost_in_odd_rows() {
    let alter: Alter = |question, answer, _| {
        let Answer::Samples(runs) = answer else { return };
        let window = PixelRect::window(question.width, question.height);
        let mut changed = Vec::new();
        for (y_px, row) in masks_of(runs, window).rows() {
            for (x, mask) in (0..).zip(row) {
                let mask = if y_px % 2 == 1 { mask & 7 } else { *mask };
                if mask > 0 {
                    changed.push((Span { y_px, x0_px: x, x1_px: x + 1 }, mask));
                }
            }
        }
        *runs = changed;
    };
    explains(Check::Samples, alter, "its row is odd");
}

/// A clipper that takes a negative w for a reason to drop.
#[test]
fn a_triangle_with_one_corner_behind_is_dropped_where_w_is_negative() {
    let alter: Alter = |question, answer, _| {
        let (Asked::Near(t), Answer::Polygon(corners)) = (&question.of, answer) else { return };
        if t.vertices[1].varying.x < 0.0 {
            corners.clear();
        }
    };
    explains(Check::Near, alter, "w of the second corner");
}

/// One attribute in place of another, where the column is odd.
#[test]
fn the_second_attribute_is_the_first_in_odd_columns() {
    let alter: Alter = |_, answer, _| {
        let Answer::Values(fragments) = answer else { return };
        for f in fragments.iter_mut().filter(|f| f.x_px % 2 == 1) {
            f.varying.y = f.varying.x;
        }
    };
    explains(Check::Values, alter, "gives the first attribute");
}

/// A number that is added, and a place with a limit.
#[test]
fn a_fraction_of_depth_is_added_in_the_right_half() {
    let alter: Alter = |_, answer, _| {
        each_value(answer, &|which, [x, _], v| if which == 0 && x >= 10 { v + 0.125 } else { v });
    };
    explains(Check::Values, alter, "gives the right value plus 0.125");
}

/// A program that is right by what it declares.
struct Conventional(Declared);

impl Subject for Conventional {
    fn declared(&self) -> &Declared {
        &self.0
    }

    fn ask(&mut self, questions: &[Question], _: u64) -> Vec<Answer> {
        questions.iter().map(|question| self.answer(question)).collect()
    }
}

impl Conventional {
    fn answer(&self, question: &Question) -> Answer {
        let window = PixelRect::window(question.width, question.height);
        match &question.of {
            Asked::Depth(list) => {
                let pile = Pile::new(list, window, &self.0, &self.0);
                Answer::Seen(pile.map_or_else(Vec::new, |pile| pile.runs()))
            }
            Asked::Values(triangle) => {
                // Every pixel that has to be drawn, with its exact values.
                let covered = self.0.picture(&triangle.corners(), window);
                let exact = exact_values(triangle, &self.0);
                let mut fragments = Vec::new();
                for (exact, span) in exact.iter().flat_map(|exact| {
                    covered.iter().flat_map(|c| &c.must).map(move |span| (exact, span))
                }) {
                    fragments.extend((span.x0_px..span.x1_px).map(|x_px| {
                        let (depth, [a, b]) = exact.at(x_px, span.y_px);
                        let varying = DVec2::new(a.to_f64(), b.to_f64());
                        let depth = depth.to_f64();
                        Fragment { x_px, y_px: span.y_px, depth, varying }
                    }));
                }
                Answer::Values(fragments)
            }
            _ => Answer::Refused("unsupported".to_owned()),
        }
    }
}

/// Right programs of other conventions have no wrong answer to learn from.
#[test]
fn right_programs_of_other_conventions_are_not_explained() {
    for words in [
        "",
        "origin=0,0",
        "origin=0.25,1 rule=bottom-right grid=16",
        "rule=strict winding=cw",
        "rule=inclusive window=20x20",
        "rule=none tolerance=1e-6",
    ] {
        let words = format!("HELLO 2 x depth attributes tolerance=1e-9 {words}");
        let mut program = Conventional(Declared::parse(&words).unwrap());
        let truth = Truth::of(&program.0);
        for check in [Check::Depth, Check::Values] {
            let learned = learned_of(&mut program, check, &truth, 700);
            assert!(learned.is_none(), "{words}: {:?}", learned.map(|l| l.sentences()));
        }
    }
}

/// Samples and the near plane have no other convention: the engine is right in them.
#[test]
fn right_samples_and_polygons_are_not_explained() {
    for check in [Check::Samples, Check::Near, Check::Carried] {
        let mut program = Inside::new(engines::find("scanline").unwrap());
        let truth = Truth::of(program.declared());
        let learned = learned_of(&mut program, check, &truth, 700);
        assert!(learned.is_none(), "{:?}", learned.map(|l| l.sentences()));
    }
}

/// A number that depends on all of an answer and on a place in it, as no rule does.
fn noise(answer: &Answer, place: usize) -> u64 {
    // A hash of the text, so that equal answers are changed alike.
    let text = format!("{answer:?}{place}");
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    }) >> 20
}

/// What follows no rule is not explained by one, but something is said of it.
#[test]
fn what_is_random_is_not_explained() {
    let in_values: Alter = |_, answer, _| {
        each_value(answer, &|which, [x, y], v| {
            let mixed = (x * 7919 + y * 104_729).wrapping_mul(31) % 17 + (v * 1e6) as i32 % 13;
            if which == 1 && mixed % 5 == 0 { v + f64::from(mixed) / 64.0 } else { v }
        });
    };
    let in_samples: Alter = |_, answer, _| {
        let before = answer.clone();
        let Answer::Samples(runs) = answer else { return };
        for (place, (_, mask)) in runs.iter_mut().enumerate() {
            let noise = noise(&before, place);
            *mask = if noise.is_multiple_of(5) { (noise / 5 % 15) as u8 + 1 } else { *mask };
        }
    };
    let in_depths: Alter = |question, answer, _| {
        let before = answer.clone();
        let (Asked::Depth(list), Answer::Seen(runs)) = (&question.of, answer) else { return };
        for (place, (_, shown)) in runs.iter_mut().enumerate() {
            let noise = noise(&before, place);
            let other = (noise / 5 % list.len() as u64) as u8;
            *shown = if noise.is_multiple_of(5) { other } else { *shown };
        }
    };
    let in_polygons: Alter = |_, answer, _| {
        let before = answer.clone();
        let Answer::Polygon(corners) = answer else { return };
        for (place, corner) in corners.iter_mut().enumerate() {
            let noise = noise(&before, place);
            corner[0] += if noise.is_multiple_of(5) { (noise / 5 % 64) as f64 / 16.0 } else { 0.0 };
        }
    };
    for (check, alter) in [
        (Check::Values, in_values),
        (Check::Samples, in_samples),
        (Check::Depth, in_depths),
        (Check::Near, in_polygons),
    ] {
        let learned = learned(check, alter);
        assert!(!learned.is_certain, "{:?}", learned.sentences());
        assert!(!learned.known.is_empty());
    }
}
