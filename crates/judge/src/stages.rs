//! Mistakes beside coverage: in values, in the four samples of a pixel, in which triangle is seen, and at the near plane.
//!
//! As in [`rasterproof_verify::mistakes`], a mistake is a pure function from a question to an answer, and it is named if it
//! predicts the answers. To add one, add an entry to a table.

use std::cell::RefCell;
use std::rc::Rc;

use super::adapt_case;
use super::ask::{Answer, Asked, Question, Subject};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::in_process::Inside;
use super::near_plane::{asked, bounds, is_round};
use super::pixels::masks_of;
use super::run::MOST_DEATHS;
use glam::DVec2;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Fragment};
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::area2;
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::mistakes::values::{self, ValueHypothesis, depths, sum, weights};
use rasterproof_verify::mistakes::{Explanation, Hypothesis, Mistakes, chosen_by, of_answers};
use rasterproof_verify::oracle::Oracle;

/// A case with its answers, and whether they are wrong.
pub struct Answered {
    pub questions: Vec<Question>,
    pub answers: Vec<Answer>,
    pub is_wrong: bool,
}

/// Cases that are drawn for a check, over all of its families.
const CASES: u64 = 400;
/// The questions are the same in every run.
const SEED: u64 = 7;

fn answered(
    program: &mut dyn Subject,
    check: Check,
    families: &[&str],
    truth: &Truth,
    goes_on: &dyn Fn() -> bool,
) -> Vec<Answered> {
    let mut all = Vec::new();
    let mut deaths = 0;
    for name in families {
        let Some(family) = adapt_case::family(name) else { continue };
        for index in 0..CASES / families.len() as u64 {
            if !goes_on() || deaths >= MOST_DEATHS {
                return all;
            }
            let case: Case = adapt_case::put(family.case(SEED, index), &truth.declared);
            let mut questions = Vec::new();
            check.questions(&case, truth, &mut questions);
            let answers = program.ask(&questions, MOST_DEATHS);
            deaths += answers.iter().filter(|answer| answer.is_death()).count() as u64;
            if answers.len() < questions.len()
                || answers.iter().any(|a| matches!(a, Answer::Refused(_) | Answer::Died(_)))
            {
                continue;
            }
            let judged = check.judge(&case, &answers, truth);
            let is_wrong = match check {
                // Their pixels are judged as coverage.
                Check::Values => judged.finding.worst() > 1.0,
                _ => judged.finding.tally.total() > 0,
            };
            all.push(Answered { questions, answers, is_wrong });
        }
    }
    all
}

/// The families in which the mistakes of a check differ.
fn families(check: Check) -> &'static [&'static str] {
    match check {
        Check::Values => values::FAMILIES,
        Check::Samples => &["uniform", "half-integer"],
        Check::Depth => &["depth-order", "depth-near-tie"],
        Check::Near | Check::Carried => &["near-plane"],
        _ => &[],
    }
}

/// The mistake of a program in what this check judges, where it is wrong.
pub fn mistakes(
    program: &mut dyn Subject,
    check: Check,
    truth: &Truth,
    programs: &[(RefCell<Inside>, String)],
    goes_on: &dyn Fn() -> bool,
) -> Option<Mistakes> {
    let all = answered(program, check, families(check), truth, goes_on);
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let tolerance = truth.declared.tolerance;
    let mut hypotheses = hypotheses(check, &all, &is_wrong, truth);
    for (known, about) in programs {
        let says = Explanation::of_program(known.borrow().name(), about.clone());
        hypotheses.push(hypothesis(&all, says, move |question, answer| {
            let predicted = known.borrow_mut().ask(std::slice::from_ref(question), 1);
            predicted.first().is_some_and(|p| agree(question, answer, p, tolerance))
        }));
    }
    of_answers(hypotheses, &is_wrong)
}

fn hypotheses<'a>(
    check: Check,
    all: &'a [Answered],
    is_wrong: &[bool],
    truth: &Truth,
) -> Vec<Hypothesis<'a>> {
    match check {
        Check::Values => of_values(all, truth.declared.tolerance),
        Check::Samples => of_samples(all, is_wrong),
        Check::Depth => of_depth(all),
        Check::Near | Check::Carried => of_near(all, &truth.declared),
        _ => Vec::new(),
    }
}

/// What the mistakes do that predict every one of these answers.
#[must_use]
pub fn explaining(check: Check, all: &[Answered], truth: &Truth) -> Vec<String> {
    let explains = |known: &Hypothesis<'_>| (0..all.len()).all(|i| (known.predicts)(i));
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let all = hypotheses(check, all, &is_wrong, truth).into_iter().filter(explains);
    all.map(|known| known.says.does).collect()
}

/// That every answer is the one that a mistake predicts, by `predicts` of a question and its answer.
fn hypothesis<'a>(
    all: &'a [Answered],
    says: Explanation,
    predicts: impl Fn(&Question, &Answer) -> bool + 'a,
) -> Hypothesis<'a> {
    let predicts = move |i: usize| {
        let Answered { questions, answers, .. } = &all[i];
        questions.iter().zip(answers).all(|(question, answer)| predicts(question, answer))
    };
    Hypothesis { predicts: Box::new(predicts), says }
}

/// Whether two answers are the same within a tolerance.
fn agree(question: &Question, answer: &Answer, predicted: &Answer, tolerance: f64) -> bool {
    match (&question.of, answer, predicted) {
        (Asked::Values(triangle), Answer::Values(here), Answer::Values(there)) => {
            let at = |pixel: (i32, i32)| {
                let found = there.iter().find(|t| (t.x_px, t.y_px) == pixel)?;
                Some([found.depth, found.varying.x, found.varying.y])
            };
            are_near(triangle, here, &at, tolerance)
        }
        _ => answer == predicted,
    }
}

/// Whether a prediction explains the values of an answer.
fn are_near(
    triangle: &Triangle,
    answer: &[Fragment<DVec2>],
    predict: &dyn Fn((i32, i32)) -> Option<[f64; 3]>,
    tolerance: f64,
) -> bool {
    let v = &triangle.vertices;
    let sizes = [v.map(|v| v.depth), v.map(|v| v.varying.x), v.map(|v| v.varying.y)];
    let allowed = |predicted: [f64; 3]| {
        [0, 1, 2].map(|i| {
            let largest = sizes[i].into_iter().fold(predicted[i].abs(), |m, v| m.max(v.abs()));
            tolerance * largest + f64::MIN_POSITIVE
        })
    };
    values::are_explained(triangle, &mut few(answer), predict, &allowed)
}

fn of_values(all: &[Answered], tolerance: f64) -> Vec<Hypothesis<'_>> {
    let of = |known: ValueHypothesis| {
        hypothesis(all, known.says.clone(), move |question, answer| match (&question.of, answer) {
            (Asked::Values(triangle), Answer::Values(fragments)) => {
                let predict = |pixel| Some(known.predict(triangle, pixel));
                are_near(triangle, fragments, &predict, tolerance)
            }
            _ => true,
        })
    };
    values::of_values().into_iter().map(of).collect()
}

/// Places of the four samples in 1/16 px, in the order of their bits.
type Pattern = [(i32, i32); 4];

/// Patterns that are not the right one, and how they are said.
fn patterns() -> Vec<(Pattern, String)> {
    let mirrored = |by: fn((i32, i32)) -> (i32, i32)| SAMPLES.map(by);
    let plain: [(Pattern, &str); 7] = [
        ([(8, 8); 4], "tests all four samples at the centre"),
        (
            [(4, 4), (12, 4), (4, 12), (12, 12)],
            "tests the samples two by two, at quarters of the pixel",
        ),
        (mirrored(|(x, y)| (16 - x, y)), "tests samples that are mirrored left to right"),
        (mirrored(|(x, y)| (x, 16 - y)), "tests samples that are mirrored upside down"),
        (mirrored(|(x, y)| (y, x)), "tests samples with x and y exchanged"),
        (
            mirrored(|(x, y)| (x - 8, y - 8)),
            "tests the samples around the upper left corner of the pixel",
        ),
        (SAMPLES, "tests the right places"),
    ];
    let mut orders = Vec::new();
    for code in 0..256 {
        let order = [code >> 6, code >> 4, code >> 2, code].map(|digits| digits % 4);
        // Each number once.
        if order.iter().fold(0, |seen, number| seen | 1 << number) == 15 {
            orders.push(order);
        }
    }
    let mut all = Vec::new();
    for (pattern, said) in plain {
        for &order in &orders {
            let ordered = order.map(|i: usize| pattern[i]);
            let [a, b, c, d] = order;
            let how = match order {
                [0, 1, 2, 3] => String::new(),
                _ => format!(", and numbers them {a}, {b}, {c}, {d}"),
            };
            // A pattern of one place has one order.
            if ordered != SAMPLES && all.iter().all(|(other, _)| *other != ordered) {
                all.push((ordered, format!("{said}{how}")));
            }
        }
    }
    all
}

/// What becomes of the mask of a pixel, whose bit 4 is its centre.
type Gate = fn(u8, [i32; 2], &Corners) -> u8;
const GATES: [(Gate, &str); 6] = [
    (
        |mask, _, _| if mask < 16 { 0 } else { mask & 15 },
        "tests the samples of pixels whose centre is covered, and of no others",
    ),
    (
        |mask, _, _| if mask & 15 == 0 { 0 } else { 15 },
        "draws all four samples of a pixel where any is covered",
    ),
    (
        |mask, _, _| if mask & 15 == 15 { 15 } else { 0 },
        "draws a pixel only where all four samples are covered",
    ),
    (
        |mask, at, corners| if is_centre_in_box(at, corners, 0) { mask & 15 } else { 0 },
        "tests the samples of columns whose centre lies in the box around the triangle, and of no others",
    ),
    (
        |mask, at, corners| if is_centre_in_box(at, corners, 1) { mask & 15 } else { 0 },
        "tests the samples of rows whose centre lies in the box around the triangle, and of no others",
    ),
    (
        |mask, at, corners| match [0, 1].map(|axis| is_centre_in_box(at, corners, axis)) {
            [true, true] => mask & 15,
            _ => 0,
        },
        "tests the samples of pixels whose centre lies in the box around the triangle, and of no others",
    ),
];

fn is_centre_in_box(at: [i32; 2], corners: &Corners, axis: usize) -> bool {
    let v = corners.map(|c| i64::from([c.x, c.y][axis]));
    let centre = i64::from(at[axis]) * 256 + 128;
    v.iter().any(|v| *v <= centre) && v.iter().any(|v| *v >= centre)
}

/// Answers by which the places of samples are looked for.
const LOOKED_AT: usize = 24;

/// Where the samples seem to be tested, each on its own among all places of the pixel.
fn found_pattern(all: &[Answered], is_wrong: &[bool]) -> Option<Pattern> {
    let places: Vec<(i32, i32)> = (0..=16).flat_map(|y| (0..=16).map(move |x| (x, y))).collect();
    let mut left = vec![15_u8; places.len()];
    for &i in chosen_by(is_wrong).iter().take(LOOKED_AT) {
        let (Some(question), Some(Answer::Samples(runs))) =
            (all[i].questions.first(), all[i].answers.first())
        else {
            continue;
        };
        let Asked::Samples(corners) = &question.of else { continue };
        let window = window_of(question);
        let drawn = masks_of(runs, window);
        let open: Vec<usize> = (0..places.len()).filter(|&place| left[place] > 0).collect();
        for some in open.chunks(8) {
            let at: Vec<_> = some.iter().map(|&place| places[place]).collect();
            let masks = masks_at(&Oracle, *corners, window, &at)?;
            for ((_, masks), (_, drawn)) in masks.rows().zip(drawn.rows()) {
                for (mask, drawn) in masks.iter().zip(drawn) {
                    for (bit, &place) in some.iter().enumerate() {
                        left[place] &= if mask >> bit & 1 == 1 { *drawn } else { !*drawn };
                    }
                }
            }
        }
    }
    let [a, b, c, d] = [0, 1, 2, 3]
        .map(|bit| left.iter().position(|left| left >> bit & 1 == 1).map(|place| places[place]));
    Some([a?, b?, c?, d?])
}

fn of_samples<'a>(all: &'a [Answered], is_wrong: &[bool]) -> Vec<Hypothesis<'a>> {
    let same: Gate = |mask, _, _| mask & 15;
    let found = found_pattern(all, is_wrong).filter(|pattern| *pattern != SAMPLES);
    let found = found.map(|pattern| {
        let [a, b, c, d] = pattern.map(|(x, y)| format!("({x}, {y})"));
        let does = format!("tests samples at {a}, {b}, {c} and {d} of 1/16 px");
        (pattern, does, same)
    });
    let patterns = patterns().into_iter().map(|(pattern, does)| (pattern, does, same));
    let gates = GATES.map(|(gate, does)| (SAMPLES, does.to_owned(), gate));
    patterns
        .chain(gates)
        .chain(found)
        .map(|([a, b, c, d], does, gate)| {
            let says = Explanation::new(
                "places of the samples",
                does,
                "test each sample at its own place, in the order of the bits that the protocol states",
                "games101",
                "a pixel on an edge with the right mask",
            );
            // Bit 4 is the centre.
            let places = [a, b, c, d, (8, 8)];
            hypothesis(all, says, move |question, answer| {
                let (Asked::Samples(corners), Answer::Samples(runs)) = (&question.of, answer) else {
                    return true;
                };
                let window = window_of(question);
                let Some(masks) = masks_at(&Oracle, *corners, window, &places) else { return true };
                let drawn = masks_of(runs, window);
                masks.rows().zip(drawn.rows()).all(|((y, masks), (_, drawn))| {
                    (window.x0..).zip(masks.iter().zip(drawn)).all(|(x, (mask, drawn))| {
                        gate(*mask, [x, y], corners) == *drawn
                    })
                })
            })
        })
        .collect()
}

fn window_of(question: &Question) -> PixelRect {
    PixelRect::window(question.width, question.height)
}

/// A triangle at a pixel of a pile: its number, its depth there, and the triangle.
#[derive(Clone, Copy)]
struct Layer<'a> {
    number: usize,
    depth: f64,
    triangle: &'a Triangle,
}

struct DepthMistake {
    does: &'static str,
    repair: &'static str,
    refuted: &'static str,
    /// The number that is compared: the layer with the least one is seen.
    key: fn(&Layer<'_>) -> f64,
    /// Whether of equal ones the last is seen, or the first; nothing where it may be either.
    last: Option<bool>,
    /// Where in the pixel depth is computed.
    place: [f64; 2],
}

fn extreme(t: &Triangle, start: f64, of: fn(f64, f64) -> f64) -> f64 {
    depths(t).into_iter().fold(start, of)
}

fn size(t: &Triangle) -> f64 {
    area2(&t.corners()).unsigned_abs() as f64
}

type Quantise = fn(f64, i32) -> f64;
/// How a depth is brought to so many bits.
const QUANTISED: [(Quantise, &str); 5] = [
    (|depth, bits| (depth * f64::from(2).powi(bits)).floor(), "cut down"),
    (|depth, bits| (depth * (f64::from(2).powi(bits) - 1.0)).round(), "rounded"),
    (
        |depth, bits| (depth * (f64::from(2).powi(bits) - 1.0)).floor(),
        "cut down, the largest being 1",
    ),
    (|depth, bits| mantissa(depth, bits).round(), "of a float after the first one, rounded"),
    (|depth, bits| mantissa(depth, bits).floor(), "of a float after the first one, cut"),
];

/// A positive number that increases with depth as a float does, in steps of its last bit.
fn mantissa(depth: f64, bits: i32) -> f64 {
    if depth < f64::EPSILON {
        return 0.0;
    }
    let exponent = values::exponent(depth);
    let [scale, first] = [bits, exponent].map(|power| f64::from(2).powi(power));
    (f64::from(64 + exponent) + depth / first - 1.0) * scale
}

/// Depth buffers of more bits are not distinguished.
const MOST_BITS: i32 = 24;

const CENTRE: [f64; 2] = [0.5, 0.5];
const DEPTHS: &[DepthMistake] = &[
    DepthMistake {
        does: "shows the farthest triangle",
        repair: "less depth is nearer: turn the comparison round, or clear the buffer with the farthest depth",
        refuted: "a pixel that shows the nearest one",
        key: |a| -a.depth,
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "shows the triangle that was drawn last, without a test of depth",
        repair: "compare depths before a pixel is written",
        refuted: "a pixel that shows an earlier one",
        key: |_| 0.0,
        last: Some(true),
        place: CENTRE,
    },
    DepthMistake {
        does: "shows the triangle that was drawn first, without a test of depth",
        repair: "compare depths before a pixel is written",
        refuted: "a pixel that shows a later one",
        key: |_| 0.0,
        last: Some(false),
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by the mean depth of their corners (painter's algorithm)",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        key: |a| depths(a.triangle).iter().sum::<f64>() / 3.0,
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by their nearest corner",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        key: |a| extreme(a.triangle, f64::MAX, f64::min),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by their farthest corner",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        key: |a| extreme(a.triangle, f64::MIN, f64::max),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "compares the depth of the first corner for the whole triangle",
        repair: "interpolate depth",
        refuted: "a leaning triangle that is cut by another",
        key: |a| depths(a.triangle)[0],
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "compares the depth of the last corner for the whole triangle",
        repair: "interpolate depth",
        refuted: "a leaning triangle that is cut by another",
        key: |a| depths(a.triangle)[2],
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "compares depths that are not divided by the area of their triangle",
        repair: "divide the weighted sum by the area",
        refuted: "a large triangle that is seen before a small one",
        key: |a| a.depth * size(a.triangle),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "computes depth at the upper left corner of the pixel",
        repair: "compute depth where coverage is sampled",
        refuted: "a pixel near a crossing that shows the right triangle",
        key: |a| a.depth,
        last: None,
        place: [0.0, 0.0],
    },
    DepthMistake {
        does: "computes depth at the lower right corner of the pixel",
        repair: "compute depth where coverage is sampled",
        refuted: "a pixel near a crossing that shows the right triangle",
        key: |a| a.depth,
        last: None,
        place: [1.0, 1.0],
    },
];

fn of_depth(all: &[Answered]) -> Vec<Hypothesis<'_>> {
    let mut hypotheses = Vec::new();
    for mistake in DEPTHS {
        let DepthMistake { does, repair, refuted, key, last, place } = *mistake;
        for is_last in
            [true, false].into_iter().filter(|is_last| last.is_none_or(|l| l == *is_last))
        {
            let says =
                Explanation::new("order of depths", does.to_owned(), repair, "ch06", refuted);
            hypotheses.push(hypothesis(all, says, move |question, answer| {
                let Asked::Depth(list) = &question.of else { return true };
                let layers = layers(list, window_of(question), place);
                is_seen(&layers, answer, &|a, b| {
                    let (a, b) = (key(a), key(b));
                    b < a || (is_last && b == a)
                })
            }));
        }
    }
    // All at the same place, so the depths are computed once.
    let piles: Rc<Vec<_>> = Rc::new(all.iter().map(pile).collect());
    for bits in 4..=MOST_BITS {
        for (quantise, how) in QUANTISED {
            for (is_last, which) in [(false, "first"), (true, "last")] {
                let does = format!(
                    "keeps depth in {bits} bits ({how}), and of equal ones shows the {which} drawn"
                );
                let says = Explanation::new(
                    "bits of depth",
                    does,
                    "keep more bits of depth, or move the near plane away from the eye",
                    "ch06",
                    "two depths that differ by less and are told apart",
                );
                let piles = Rc::clone(&piles);
                let replaces = move |a: &Layer<'_>, b: &Layer<'_>| {
                    let [a, b] = [a, b].map(|layer| quantise(layer.depth, bits));
                    b < a || (is_last && a == b)
                };
                let predicts = move |i: usize| {
                    piles[i]
                        .as_ref()
                        .is_none_or(|(layers, answer)| is_seen(layers, answer, &replaces))
                };
                hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
            }
        }
    }
    hypotheses
}

/// The layers at the centre of each pixel of a case, and what was answered.
fn pile(answered: &Answered) -> Option<(Layers<'_>, &Answer)> {
    let (question, answer) = (answered.questions.first()?, answered.answers.first()?);
    let Asked::Depth(list) = &question.of else { return None };
    Some((layers(list, window_of(question), CENTRE), answer))
}

/// The triangles that cover each pixel of a window, row by row, in drawing order.
struct Layers<'a> {
    window: PixelRect,
    of_pixels: Vec<Vec<Layer<'a>>>,
}

fn layers(list: &[Triangle], window: PixelRect, place: [f64; 2]) -> Layers<'_> {
    let width = window.width() as usize;
    let mut of_pixels = vec![Vec::new(); width * window.height() as usize];
    for (number, triangle) in list.iter().enumerate() {
        let corners = triangle.corners();
        Oracle.spans(corners, window, &mut |span| {
            let row = (span.y_px - window.y0) as usize * width;
            for x in span.x0_px..span.x1_px {
                let at = [f64::from(x) + place[0], f64::from(span.y_px) + place[1]];
                let depth = sum(weights(&corners, at), depths(triangle));
                of_pixels[row + (x - window.x0) as usize].push(Layer { number, depth, triangle });
            }
        });
    }
    Layers { window, of_pixels }
}

/// Whether an answer shows what is left where a layer replaces the one that was kept by this rule.
fn is_seen(
    layers: &Layers<'_>,
    answer: &Answer,
    replaces: &dyn Fn(&Layer<'_>, &Layer<'_>) -> bool,
) -> bool {
    let Answer::Seen(runs) = answer else { return true };
    let shown: Vec<_> = runs.iter().map(|(run, number)| (*run, number + 1)).collect();
    let shown = masks_of(&shown, layers.window);
    let shown = shown.rows().flat_map(|(_, row)| row);
    layers.of_pixels.iter().zip(shown).all(|(here, shown)| {
        let kept = here.iter().reduce(|kept, new| if replaces(kept, new) { new } else { kept });
        kept.map_or(0, |kept| kept.number as u8 + 1) == *shown
    })
}

struct NearMistake {
    does: &'static str,
    repair: &'static str,
    refuted: &'static str,
    clip: fn([ClipCorner; 3], Plane) -> Vec<ClipCorner>,
}

/// Sutherland and Hodgman with a distance, and a way to make a corner from a kept and a lost one.
fn clip(
    corners: [ClipCorner; 3],
    distance: impl Fn(ClipCorner) -> f64,
    new: impl Fn(ClipCorner, ClipCorner, f64) -> ClipCorner,
) -> Vec<ClipCorner> {
    let mut left = Vec::new();
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % 3];
        if distance(from) >= 0.0 {
            left.push(from);
        }
        left.extend(crossing(from, to, &distance).map(|(kept, lost, t)| new(kept, lost, t)));
    }
    left
}

/// Where an edge crosses the plane: the corner that stays, the one that goes, and the part of the way between them.
fn crossing(
    from: ClipCorner,
    to: ClipCorner,
    distance: &dyn Fn(ClipCorner) -> f64,
) -> Option<(ClipCorner, ClipCorner, f64)> {
    let [a, b] = [distance(from), distance(to)];
    match [a >= 0.0, b >= 0.0] {
        [true, false] => Some((from, to, a / (a - b))),
        [false, true] => Some((to, from, b / (b - a))),
        _ => None,
    }
}

/// How far a corner lies before the near plane: z + w, or z where the plane is z = 0.
type Plane = fn(ClipCorner) -> f64;

fn between(from: ClipCorner, to: ClipCorner, t: f64) -> ClipCorner {
    [0, 1, 2, 3, 4].map(|k| from[k] + (to[k] - from[k]) * t)
}

const NEAR: &[NearMistake] = &[
    NearMistake {
        does: "does not clip",
        repair: "clip at the near plane before the division",
        refuted: "a corner behind that is cut off",
        clip: |c, _| c.to_vec(),
    },
    NearMistake {
        does: "drops a triangle with any corner behind the near plane",
        repair: "keep the part before the plane",
        refuted: "a triangle that is cut",
        clip: |c, near| if c.iter().all(|p| near(*p) >= 0.0) { c.to_vec() } else { Vec::new() },
    },
    NearMistake {
        does: "drops triangles that lie wholly behind and clips no others",
        repair: "cut what crosses the plane",
        refuted: "a triangle that is cut",
        clip: |c, near| if c.iter().any(|p| near(*p) >= 0.0) { c.to_vec() } else { Vec::new() },
    },
    NearMistake {
        does: "clips at w = 0 and not at the near plane",
        repair: "clip at the near plane",
        refuted: "a corner between both planes that is cut off",
        clip: |c, _| clip(c, |[_, _, _, w, _]| w, between),
    },
    NearMistake {
        does: "clips at z = 0, as Direct3D and Vulkan have it",
        repair: "clip at z = -w, as OpenGL has it",
        refuted: "a corner between both planes that is kept",
        clip: |c, _| clip(c, |[_, _, z, _, _]| z, between),
    },
    NearMistake {
        does: "clips at z = -w, as OpenGL has it",
        repair: "clip at z = 0, as Direct3D and Vulkan have it",
        refuted: "a corner between both planes that is cut off",
        clip: |c, _| clip(c, |[_, _, z, w, _]| z + w, between),
    },
    NearMistake {
        does: "clips at z = w, the far plane",
        repair: "clip at the near plane",
        refuted: "a corner beyond the far plane that is kept",
        clip: |c, _| clip(c, |[_, _, z, w, _]| w - z, between),
    },
    NearMistake {
        does: "keeps the part behind the near plane",
        repair: "turn the comparison round",
        refuted: "a corner before the plane that is kept",
        clip: |c, near| clip(c, |p| -near(p), between),
    },
    NearMistake {
        does: "keeps at most three corners, so that a quadrilateral loses one",
        repair: "a triangle that is cut can have four corners",
        refuted: "an answer with four corners",
        clip: |c, near| {
            let mut left = clip(c, near, between);
            left.truncate(3);
            left
        },
    },
    NearMistake {
        does: "moves corners behind the plane onto it (clamps z) and cuts nothing",
        repair: "divide the edges",
        refuted: "a new corner on an edge",
        clip: |c, near| c.map(|p @ [x, y, z, w, a]| [x, y, z - near(p).min(0.0), w, a]).to_vec(),
    },
    NearMistake {
        does: "moves corners behind the plane onto it (clamps z), cuts nothing, and drops what lies wholly behind",
        repair: "divide the edges",
        refuted: "a new corner on an edge",
        clip: |c, near| match behind(&c, near) {
            3 => Vec::new(),
            _ => c.map(|p @ [x, y, z, w, a]| [x, y, z - near(p).min(0.0), w, a]).to_vec(),
        },
    },
    NearMistake {
        does: "drops triangles with two corners behind the near plane",
        repair: "keep the part before the plane",
        refuted: "a triangle with one corner before the plane that is cut",
        clip: |c, near| if behind(&c, near) == 2 { Vec::new() } else { clip(c, near, between) },
    },
    NearMistake {
        does: "drops triangles with one corner behind the near plane",
        repair: "keep the part before the plane",
        refuted: "a triangle with two corners before the plane that is cut",
        clip: |c, near| if behind(&c, near) == 1 { Vec::new() } else { clip(c, near, between) },
    },
    NearMistake {
        does: "does not clip triangles with one corner behind the near plane",
        repair: "cut what crosses the plane",
        refuted: "a triangle with two corners before the plane that is cut",
        clip: |c, near| if behind(&c, near) == 1 { c.to_vec() } else { clip(c, near, between) },
    },
    NearMistake {
        does: "does not clip triangles with two corners behind the near plane",
        repair: "cut what crosses the plane",
        refuted: "a triangle with one corner before the plane that is cut",
        clip: |c, near| if behind(&c, near) == 2 { c.to_vec() } else { clip(c, near, between) },
    },
    NearMistake {
        does: "clips at z = -1, as if z were divided by w already",
        repair: "clip at z = -w",
        refuted: "a corner between both planes that is cut off",
        clip: |c, _| clip(c, |[_, _, z, _, _]| z + 1.0, between),
    },
    NearMistake {
        does: "divides x, y, z and w by w where only the clipped polygon should be divided",
        repair: "clip in clip space, and leave the division to the stage after it",
        refuted: "a corner whose w is not 1",
        clip: |c, near| {
            let left = clip(c, near, between);
            left.into_iter().map(|[x, y, z, w, a]| [x / w, y / w, z / w, 1.0, a]).collect()
        },
    },
    NearMistake {
        does: "gives the corners of a quadrilateral in a wrong order, so that its sides cross",
        repair: "go round the triangle, and make each new corner where its edge crosses the plane",
        refuted: "a quadrilateral whose sides do not cross",
        clip: |c, near| {
            let mut left = clip(c, near, between);
            if left.len() > 3 {
                left.swap(2, 3);
            }
            left
        },
    },
    NearMistake {
        does: "does not cut the edge from the first corner to the second",
        repair: "cut all three edges",
        refuted: "a corner on that edge",
        clip: |c, near| uncut(c, near, 0),
    },
    NearMistake {
        does: "does not cut the edge from the second corner to the third",
        repair: "cut all three edges",
        refuted: "a corner on that edge",
        clip: |c, near| uncut(c, near, 1),
    },
    NearMistake {
        does: "does not cut the edge from the third corner to the first",
        repair: "cut all three edges",
        refuted: "a corner on that edge",
        clip: |c, near| uncut(c, near, 2),
    },
];

/// How many corners lie behind the plane.
fn behind(corners: &[ClipCorner; 3], near: Plane) -> usize {
    corners.iter().filter(|p| near(**p) < 0.0).count()
}

/// Without the new corner on an edge.
fn uncut(corners: [ClipCorner; 3], near: Plane, edge: usize) -> Vec<ClipCorner> {
    let mut left = clip(corners, near, between);
    if let Some((kept, lost, t)) = crossing(corners[edge], corners[(edge + 1) % 3], &near) {
        let new = between(kept, lost, t);
        // An edge that begins in the plane gives its corner once more.
        if let Some(at) = left.iter().rposition(|corner| *corner == new) {
            left.remove(at);
        }
    }
    left
}

/// Which numbers of a new corner are wrong.
const NUMBERS: [(&[usize], &str); 9] = [
    (&[0, 1, 2, 3, 4], "all numbers"),
    (&[0, 1], "x and y"),
    (&[0], "x"),
    (&[1], "y"),
    (&[2], "z"),
    (&[3], "w"),
    (&[0, 1, 2], "x, y and z"),
    (&[2, 3], "z and w"),
    (&[4], "attributes"),
];

/// What a new corner gets in place of a number, from that of the corner that stays, of the one that goes, and the part of the way.
type New = fn(ClipCorner, ClipCorner, f64, usize) -> f64;
const NEW: [(New, &str); 9] = [
    (|kept, _, _, k| kept[k], "keeps {} of the corner that stays at a new corner"),
    (|_, lost, _, k| lost[k], "keeps {} of the corner that is cut off at a new corner"),
    (
        |kept, lost, t, k| lost[k] + (kept[k] - lost[k]) * t,
        "divides {} of an edge from the wrong end: t is 1 - t",
    ),
    (
        |kept, lost, _, k| (kept[k] + lost[k]) / 2.0,
        "gives a new corner the mean of both ends for {}",
    ),
    (
        |kept, lost, t, k| {
            let (a, b) = ((1.0 - t) / kept[3], t / lost[3]);
            (a * kept[k] + b * lost[k]) / (a + b)
        },
        "interpolates {} at a new corner with a correction for perspective",
    ),
    (
        |kept, lost, t, k| {
            let (a, b) = (kept[k] / kept[3], lost[k] / lost[3]);
            (a + (b - a) * t) * (kept[3] + (lost[3] - kept[3]) * t)
        },
        "divides {} by w before it interpolates at a new corner, and multiplies by the new w",
    ),
    (|_, _, _, _| 0.0, "gives a new corner 0 for {}"),
    (|_, _, _, _| 1.0, "gives a new corner 1 for {}"),
    (
        |kept, lost, _, k| kept[k] + (lost[k] - kept[k]) * (kept[2] / (kept[2] - lost[2])),
        "divides {} of an edge by z alone, as if the plane were z = 0",
    ),
];

fn of_near<'a>(all: &'a [Answered], declared: &Declared) -> Vec<Hypothesis<'a>> {
    let tolerance = declared.tolerance;
    let near: Plane = match declared.near_is_zero {
        true => |[_, _, z, _, _]| z,
        false => |[_, _, z, w, _]| z + w,
    };
    type Clip<'a> = Box<dyn Fn([ClipCorner; 3]) -> Vec<ClipCorner> + 'a>;
    let of = |does: String, repair: &'static str, refuted: &'static str, clip: Clip<'a>| {
        let says = Explanation::new("the near plane", does, repair, "ch07", refuted);
        hypothesis(all, says, move |question, answer| {
            let (Some(triangle), Some(polygon)) = (asked(&question.of), answer.polygon()) else {
                return true;
            };
            let corners = clip_corners(&triangle);
            same_polygon(&clip(corners), polygon, &corners, tolerance)
        })
    };
    let mut hypotheses: Vec<_> = NEAR
        .iter()
        .map(|m| of(m.does.to_owned(), m.repair, m.refuted, Box::new(move |c| (m.clip)(c, near))))
        .collect();
    for (numbers, said) in NUMBERS {
        // A corner in the plane may be given once more as a new one, or not.
        for ((new, does), again) in NEW.into_iter().flat_map(|new| [(new, true), (new, false)]) {
            let repair = "a new corner divides the edge as the distances of its ends to the plane do, in all of x, y, z, w and attributes";
            let clip = move |corners| {
                clip(corners, near, |kept, lost, t| {
                    let mut made = between(kept, lost, t);
                    for &k in numbers.iter().filter(|_| again || t > 0.0) {
                        made[k] = new(kept, lost, t, k);
                    }
                    made
                })
            };
            let refuted = "a new corner that is right in these numbers";
            hypotheses.push(of(does.replace("{}", said), repair, refuted, Box::new(clip)));
        }
    }
    hypotheses
}

/// Whether both are the same corners one way round; what has fewer than three may be left out.
fn same_polygon(
    a: &[ClipCorner],
    b: &[ClipCorner],
    corners: &[ClipCorner; 3],
    tolerance: f64,
) -> bool {
    let bounds = bounds(corners, 10.0 * tolerance);
    let near = |p: &ClipCorner, q: &ClipCorner| {
        p.iter().zip(q).zip(bounds).all(|((p, q), bound)| (p - q).abs() <= bound)
    };
    let has_area = |polygon: &[ClipCorner]| polygon.len() > 2;
    (!has_area(a) && !has_area(b)) || is_round(a.len(), b.len(), |i, j| near(&a[i], &b[j]))
}
