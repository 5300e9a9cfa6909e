//! Mistakes beside coverage: in values, in the four samples of a pixel, in which triangle is seen, and at the near plane.
//!
//! As in [`rasterproof_verify::mistakes`], a mistake is a pure function from a question to an answer, and it is named if it
//! predicts the answers. To add one, add an entry to a table.

use std::cell::RefCell;

use super::adapt_case;
use super::ask::{Answer, Ask, Asked, Question};
use super::check::{Check, Truth, masks_of, picks};
use super::in_process::Inside;
use super::near_plane::is_round;
use super::run::MOST_DEATHS;
use glam::DVec2;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Fragment};
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};
use rasterproof_verify::cases::near_plane::clip_corners;
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::area2;
use rasterproof_verify::mistakes::{Explanation, Hypothesis, Mistakes, of_answers};
use rasterproof_verify::oracle::Oracle;

/// A case with its answers, and whether they are wrong.
struct Answered {
    questions: Vec<Question>,
    answers: Vec<Answer>,
    is_wrong: bool,
}

/// Cases that are drawn for a check, over all of its families.
const CASES: u64 = 400;
/// The questions are the same in every run.
const SEED: u64 = 7;

fn answered(
    program: &mut dyn Ask,
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
            let finding = check.judge(&case, &answers, truth);
            let is_wrong = match check {
                // Their pixels are judged as coverage.
                Check::Values => finding.worst > 1.0,
                _ => finding.tally.total() > 0,
            };
            all.push(Answered { questions, answers, is_wrong });
        }
    }
    all
}

/// The families in which the mistakes of a check differ.
fn families(check: Check) -> &'static [&'static str] {
    match check {
        Check::Values => &["w-ratio", "uniform", "w-extreme", "fan"],
        Check::Samples => &["uniform", "half-integer"],
        Check::Depth => &["depth-order"],
        Check::Near => &["near-plane"],
        _ => &[],
    }
}

/// The mistake of a program in what this check judges, where it is wrong.
pub fn mistakes(
    program: &mut dyn Ask,
    check: Check,
    truth: &Truth,
    programs: &[RefCell<Inside>],
    goes_on: &dyn Fn() -> bool,
) -> Option<Mistakes> {
    let all = answered(program, check, families(check), truth, goes_on);
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let tolerance = truth.declared.tolerance;
    let mut hypotheses = match check {
        Check::Values => of_values(&all, tolerance),
        Check::Samples => of_samples(&all),
        Check::Depth => of_depth(&all),
        Check::Near => of_near(&all, tolerance),
        _ => Vec::new(),
    };
    for known in programs {
        let name = known.borrow().name();
        let about = format!("draws as the planted fault or published algorithm {name}");
        let says = Explanation::of_program(name, about);
        hypotheses.push(hypothesis(&all, says, move |question, answer| {
            let predicted = known.borrow_mut().ask(std::slice::from_ref(question), 1);
            predicted.first().is_some_and(|p| agree(question, answer, p, tolerance))
        }));
    }
    of_answers(hypotheses, &is_wrong)
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
            let at =
                |f: &Fragment<DVec2>| there.iter().find(|t| (t.x_px, t.y_px) == (f.x_px, f.y_px));
            picks(here).all(|f| {
                at(f).is_none_or(|t| {
                    is_near(triangle, f, [t.depth, t.varying.x, t.varying.y], tolerance)
                })
            })
        }
        _ => answer == predicted,
    }
}

/// Whether values are the predicted ones: within ten times the tolerance, as predictions are rounded too.
fn is_near(
    triangle: &Triangle,
    fragment: &Fragment<DVec2>,
    predicted: [f64; 3],
    tolerance: f64,
) -> bool {
    let v = &triangle.vertices;
    let sizes = [v.map(|v| v.depth), v.map(|v| v.varying.x), v.map(|v| v.varying.y)];
    let values = [fragment.depth, fragment.varying.x, fragment.varying.y];
    values.into_iter().zip(predicted).zip(sizes).all(|((value, predicted), size)| {
        let largest = size.into_iter().fold(predicted.abs(), |m: f64, v| m.max(v.abs()));
        (value - predicted).abs() <= 10.0 * tolerance * largest + f64::MIN_POSITIVE
    })
}

/// What is wrong with values, from the weights of the corners at a place.
struct ValueMistake {
    name: &'static str,
    does: &'static str,
    repair: &'static str,
    page: &'static str,
    refuted: &'static str,
    /// Depth and both attributes.
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
}

fn each(v: &Triangle, of: impl Fn(DVec2) -> f64) -> [f64; 3] {
    v.vertices.map(|v| of(v.varying))
}

fn depths(t: &Triangle) -> [f64; 3] {
    t.vertices.map(|v| v.depth)
}

fn sum(weights: [f64; 3], values: [f64; 3]) -> f64 {
    weights.into_iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// The weights of a corner's value after the perspective is corrected.
fn corrected(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let parts = [0, 1, 2].map(|i| weights[i] * t.vertices[i].inv_w);
    let whole: f64 = parts.iter().sum();
    parts.map(|part| part / whole)
}

fn attributes(t: &Triangle, weights: [f64; 3]) -> [f64; 2] {
    [sum(weights, each(t, |v| v.x)), sum(weights, each(t, |v| v.y))]
}

fn with(depth: f64, [a, b]: [f64; 2]) -> [f64; 3] {
    [depth, a, b]
}

fn right_values(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    with(sum(weights, depths(t)), attributes(t, corrected(t, weights)))
}

const VALUES: &[ValueMistake] = &[
    ValueMistake {
        name: "attributes ignore w",
        does: "interpolates attributes linearly on the screen and ignores w (affine)",
        repair: "interpolate a/w and 1/w, and divide at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(l, depths(t)), attributes(t, l)),
    },
    ValueMistake {
        name: "depth as an attribute",
        does: "interpolates depth as an attribute, with the correction for perspective",
        repair: "depth after the division by w is linear on the screen: interpolate it without correction",
        page: "ch06",
        refuted: "a triangle with unequal w whose depth is linear on the screen",
        values: |t, l| with(sum(corrected(t, l), depths(t)), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth and attributes exchanged",
        does: "corrects depth for perspective, and not the attributes",
        repair: "correct the attributes, and leave depth linear",
        page: "ch06",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(corrected(t, l), depths(t)), attributes(t, l)),
    },
    ValueMistake {
        name: "not divided back",
        does: "interpolates a/w and forgets to divide by the interpolated 1/w",
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with w other than 1 and right attributes",
        values: |t, l| {
            let over_w = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w);
            with(sum(l, depths(t)), attributes(t, over_w))
        },
    },
    ValueMistake {
        name: "w in place of 1/w",
        does: "weights the corners by w where 1/w is right",
        repair: "weight the corners by 1/w",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let parts = [0, 1, 2].map(|i| l[i] / t.vertices[i].inv_w);
            let whole: f64 = parts.iter().sum();
            with(sum(l, depths(t)), attributes(t, parts.map(|part| part / whole)))
        },
    },
    ValueMistake {
        name: "attributes exchanged",
        does: "exchanges the two attributes",
        repair: "keep their order from the corners to the pixels",
        page: "ch05",
        refuted: "a pixel whose first attribute is right",
        values: |t, l| {
            let [a, b] = attributes(t, corrected(t, l));
            with(sum(l, depths(t)), [b, a])
        },
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the values of the first corner",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| right_values(t, [1.0, 0.0, 0.0]),
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the values of the last corner",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| right_values(t, [0.0, 0.0, 1.0]),
    },
    ValueMistake {
        name: "the mean of the corners",
        does: "gives every pixel the mean of the corners",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| with(sum([1.0 / 3.0; 3], depths(t)), attributes(t, [1.0 / 3.0; 3])),
    },
    ValueMistake {
        name: "values are clamped",
        does: "clamps values to 0 to 1",
        repair: "clamp colours where they are stored, and nothing before",
        page: "ch05",
        refuted: "a value above 1",
        values: |t, l| right_values(t, l).map(|v| v.clamp(0.0, 1.0)),
    },
    ValueMistake {
        name: "w as depth",
        does: "gives w as depth",
        repair: "give z/w",
        page: "ch06",
        refuted: "a depth other than w",
        values: |t, l| {
            let w: f64 = 1.0 / sum(l, t.vertices.map(|v| v.inv_w));
            with(w, attributes(t, corrected(t, l)))
        },
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives the second corner the weight of the third and the third that of the second",
        repair: "keep a value with its corner where corners are sorted or exchanged",
        page: "ch05",
        refuted: "a pixel near the second corner with its values",
        values: |t, [a, b, c]| right_values(t, [a, c, b]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives the first corner the weight of the second and the second that of the first",
        repair: "keep a value with its corner where corners are sorted or exchanged",
        page: "ch05",
        refuted: "a pixel near the first corner with its values",
        values: |t, [a, b, c]| right_values(t, [b, a, c]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives each corner the weight of the next one",
        repair: "the weight of a corner is the area opposite to it",
        page: "ch05",
        refuted: "a pixel near a corner with its values",
        values: |t, [a, b, c]| right_values(t, [b, c, a]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives each corner the weight of the one before",
        repair: "the weight of a corner is the area opposite to it",
        page: "ch05",
        refuted: "a pixel near a corner with its values",
        values: |t, [a, b, c]| right_values(t, [c, a, b]),
    },
    ValueMistake {
        name: "corners keep their places when they are exchanged",
        does: "exchanges the weights of the second and the third corner of counterclockwise triangles",
        repair: "exchange the values with the corners",
        page: "ch05",
        refuted: "a counterclockwise triangle with right values",
        values: |t, [a, b, c]| {
            right_values(t, if area2(&t.corners()) < 0 { [a, c, b] } else { [a, b, c] })
        },
    },
    ValueMistake {
        name: "values at another place",
        does: "computes right values",
        repair: "compute values where coverage is sampled",
        page: "ch05",
        refuted: "a pixel with the values of its sample",
        values: right_values,
    },
];

/// Where values may be taken in a pixel, and how that is said.
const PLACES: [([f64; 2], &str); 5] = [
    ([0.5, 0.5], ""),
    ([0.0, 0.0], ", at the upper left corner of the pixel"),
    ([1.0, 1.0], ", at the lower right corner of the pixel"),
    ([0.0, 0.5], ", at the left side of the pixel"),
    ([0.5, 0.0], ", at the upper side of the pixel"),
];

fn px(p: SubpixelPoint) -> [f64; 2] {
    [p.x, p.y].map(|v| f64::from(v) / f64::from(SUBPIXELS))
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The weights of the corners at a place, in pixels.
fn weights(corners: &Corners, at: [f64; 2]) -> [f64; 3] {
    let [a, b, c] = corners.map(px);
    let area = cross(a, b, c);
    [cross(b, c, at), cross(c, a, at), cross(a, b, at)].map(|part| part / area)
}

type Moved = fn(i32) -> i32;
/// What becomes of corners before the weights are computed, and how that is said.
const CORNERS: [(Moved, &str); 3] = [
    (|v| v, ""),
    (|v| v.div_euclid(SUBPIXELS) * SUBPIXELS, ", from corners that are cut to whole pixels"),
    (
        |v| v.saturating_add(HALF_PIXEL).div_euclid(SUBPIXELS) * SUBPIXELS,
        ", from corners that are rounded to whole pixels",
    ),
];

fn of_values(all: &[Answered], tolerance: f64) -> Vec<Hypothesis<'_>> {
    let mut hypotheses = Vec::new();
    for (moved, from) in CORNERS {
        for (place, at) in PLACES {
            for mistake in VALUES {
                let ValueMistake { name, does, repair, page, refuted, values } = *mistake;
                let says =
                    Explanation::new(name, format!("{does}{at}{from}"), repair, page, refuted);
                hypotheses.push(hypothesis(all, says, move |question, answer| {
                    let (Asked::Values(triangle), Answer::Values(fragments)) =
                        (&question.of, answer)
                    else {
                        return true;
                    };
                    let corners =
                        triangle.corners().map(|p| SubpixelPoint::new(moved(p.x), moved(p.y)));
                    picks(fragments).all(|f| {
                        let at = [f64::from(f.x_px) + place[0], f64::from(f.y_px) + place[1]];
                        is_near(triangle, f, values(triangle, weights(&corners, at)), tolerance)
                    })
                }));
            }
        }
    }
    hypotheses
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

fn of_samples(all: &[Answered]) -> Vec<Hypothesis<'_>> {
    let gated = "tests the samples of pixels whose centre is covered, and of no others".to_owned();
    let patterns = patterns().into_iter().map(|(pattern, does)| (pattern, does, false));
    patterns
        .chain([(SAMPLES, gated, true)])
        .map(|([a, b, c, d], does, gated)| {
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
                let expected = |mask: u8| if gated && mask < 16 { 0 } else { mask & 15 };
                masks.rows().zip(drawn.rows()).all(|((_, masks), (_, drawn))| {
                    masks.iter().zip(drawn).all(|(mask, drawn)| expected(*mask) == *drawn)
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
    /// Whether the second one, drawn later, replaces the first.
    replaces: fn(&Layer<'_>, &Layer<'_>) -> bool,
    /// Where in the pixel depth is computed.
    place: [f64; 2],
}

fn extreme(t: &Triangle, start: f64, of: fn(f64, f64) -> f64) -> f64 {
    depths(t).into_iter().fold(start, of)
}

fn mean(t: &Triangle) -> f64 {
    depths(t).iter().sum::<f64>() / 3.0
}

/// Depth in so many bits: cut down to a step of 2^-bits.
fn bits(depth: f64, bits: i32) -> f64 {
    (depth * f64::from(2).powi(bits)).floor()
}

const CENTRE: [f64; 2] = [0.5, 0.5];
const DEPTHS: &[DepthMistake] = &[
    DepthMistake {
        does: "shows the farthest triangle",
        repair: "less depth is nearer: turn the comparison round, or clear the buffer with the farthest depth",
        refuted: "a pixel that shows the nearest one",
        replaces: |a, b| b.depth > a.depth,
        place: CENTRE,
    },
    DepthMistake {
        does: "shows the triangle that was drawn last, without a test of depth",
        repair: "compare depths before a pixel is written",
        refuted: "a pixel that shows an earlier one",
        replaces: |_, _| true,
        place: CENTRE,
    },
    DepthMistake {
        does: "shows the triangle that was drawn first, without a test of depth",
        repair: "compare depths before a pixel is written",
        refuted: "a pixel that shows a later one",
        replaces: |_, _| false,
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by the mean depth of their corners (painter's algorithm)",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        replaces: |a, b| mean(b.triangle) <= mean(a.triangle),
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by their nearest corner",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        replaces: |a, b| {
            extreme(b.triangle, f64::MAX, f64::min) <= extreme(a.triangle, f64::MAX, f64::min)
        },
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by their farthest corner",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        replaces: |a, b| {
            extreme(b.triangle, f64::MIN, f64::max) <= extreme(a.triangle, f64::MIN, f64::max)
        },
        place: CENTRE,
    },
    DepthMistake {
        does: "compares the depth of the first corner for the whole triangle",
        repair: "interpolate depth",
        refuted: "a leaning triangle that is cut by another",
        replaces: |a, b| depths(b.triangle)[0] < depths(a.triangle)[0],
        place: CENTRE,
    },
    DepthMistake {
        does: "keeps depth in 4 bits, the first of equals",
        repair: "keep more bits of depth",
        refuted: "two depths that differ by less and are told apart",
        replaces: |a, b| bits(b.depth, 4) < bits(a.depth, 4),
        place: CENTRE,
    },
    DepthMistake {
        does: "keeps depth in 8 bits, the first of equals",
        repair: "keep more bits of depth",
        refuted: "two depths that differ by less and are told apart",
        replaces: |a, b| bits(b.depth, 8) < bits(a.depth, 8),
        place: CENTRE,
    },
    DepthMistake {
        does: "keeps depth in 8 bits, the last of equals",
        repair: "keep more bits of depth",
        refuted: "two depths that differ by less and are told apart",
        replaces: |a, b| bits(b.depth, 8) <= bits(a.depth, 8),
        place: CENTRE,
    },
    DepthMistake {
        does: "keeps depth in 12 bits, the first of equals",
        repair: "keep more bits of depth",
        refuted: "two depths that differ by less and are told apart",
        replaces: |a, b| bits(b.depth, 12) < bits(a.depth, 12),
        place: CENTRE,
    },
    DepthMistake {
        does: "computes depth at the upper left corner of the pixel",
        repair: "compute depth where coverage is sampled",
        refuted: "a pixel near a crossing that shows the right triangle",
        replaces: |a, b| b.depth < a.depth,
        place: [0.0, 0.0],
    },
    DepthMistake {
        does: "computes depth at the lower right corner of the pixel",
        repair: "compute depth where coverage is sampled",
        refuted: "a pixel near a crossing that shows the right triangle",
        replaces: |a, b| b.depth < a.depth,
        place: [1.0, 1.0],
    },
];

fn of_depth(all: &[Answered]) -> Vec<Hypothesis<'_>> {
    let of = |mistake: &'static DepthMistake| {
        let DepthMistake { does, repair, refuted, .. } = mistake;
        let says = Explanation::new("order of depths", (*does).to_owned(), repair, "ch06", refuted);
        hypothesis(all, says, move |question, answer| {
            let (Asked::Depth(list), Answer::Seen(runs)) = (&question.of, answer) else {
                return true;
            };
            let window = window_of(question);
            let shown: Vec<_> = runs.iter().map(|(run, number)| (*run, number + 1)).collect();
            seen(list, window, mistake) == masks_of(&shown, window)
        })
    };
    DEPTHS.iter().map(of).collect()
}

/// One more than the number of the triangle that is seen at each pixel, 0 for none.
fn seen(list: &[Triangle], window: PixelRect, mistake: &DepthMistake) -> Frame<u8> {
    let mut held: Frame<Option<Layer<'_>>> = Frame::new(window, None);
    for (number, triangle) in list.iter().enumerate() {
        let corners = triangle.corners();
        Oracle.cover(corners, window, |span| {
            let row = held.span_mut(span.y_px, span.x0_px, span.x1_px);
            for (x, held) in (span.x0_px..).zip(row) {
                let at = [f64::from(x) + mistake.place[0], f64::from(span.y_px) + mistake.place[1]];
                let depth = sum(weights(&corners, at), depths(triangle));
                let new = Layer { number, depth, triangle };
                if held.as_ref().is_none_or(|held| (mistake.replaces)(held, &new)) {
                    *held = Some(new);
                }
            }
        });
    }
    let mut seen = Frame::new(window, 0);
    for (y, row) in held.rows() {
        for (seen, held) in seen.row_mut(y).iter_mut().zip(row) {
            *seen = held.map_or(0, |held| held.number as u8 + 1);
        }
    }
    seen
}

type ClipCorner = [f64; 4];

struct NearMistake {
    does: &'static str,
    repair: &'static str,
    refuted: &'static str,
    clip: fn([ClipCorner; 3]) -> Vec<ClipCorner>,
}

/// Sutherland and Hodgman with a distance, and a way to make a corner from a kept and a lost one.
fn clip(
    corners: [ClipCorner; 3],
    distance: fn(ClipCorner) -> f64,
    new: fn(ClipCorner, ClipCorner, f64) -> ClipCorner,
) -> Vec<ClipCorner> {
    let mut left = Vec::new();
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % 3];
        let [a, b] = [distance(from), distance(to)];
        if a >= 0.0 {
            left.push(from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            let (kept, lost, t) =
                if a >= 0.0 { (from, to, a / (a - b)) } else { (to, from, b / (b - a)) };
            left.push(new(kept, lost, t));
        }
    }
    left
}

fn near_plane([_, _, z, w]: ClipCorner) -> f64 {
    z + w
}

fn between(from: ClipCorner, to: ClipCorner, t: f64) -> ClipCorner {
    [0, 1, 2, 3].map(|k| from[k] + (to[k] - from[k]) * t)
}

const NEAR: &[NearMistake] = &[
    NearMistake {
        does: "does not clip",
        repair: "clip at z = -w before the division",
        refuted: "a corner behind that is cut off",
        clip: |c| c.to_vec(),
    },
    NearMistake {
        does: "drops a triangle with any corner behind the near plane",
        repair: "keep the part before the plane",
        refuted: "a triangle that is cut",
        clip: |c| if c.iter().all(|p| near_plane(*p) >= 0.0) { c.to_vec() } else { Vec::new() },
    },
    NearMistake {
        does: "drops triangles that lie wholly behind and clips no others",
        repair: "cut what crosses the plane",
        refuted: "a triangle that is cut",
        clip: |c| if c.iter().any(|p| near_plane(*p) >= 0.0) { c.to_vec() } else { Vec::new() },
    },
    NearMistake {
        does: "clips at w = 0 and not at the near plane",
        repair: "clip at z = -w",
        refuted: "a corner between both planes that is cut off",
        clip: |c| clip(c, |[_, _, _, w]| w, between),
    },
    NearMistake {
        does: "clips at z = 0, as Direct3D and Vulkan have it",
        repair: "clip at z = -w, as OpenGL has it",
        refuted: "a corner between both planes that is kept",
        clip: |c| clip(c, |[_, _, z, _]| z, between),
    },
    NearMistake {
        does: "clips at z = -w, as OpenGL has it",
        repair: "clip at z = 0, as Direct3D and Vulkan have it",
        refuted: "a corner between both planes that is cut off",
        clip: |c| clip(c, near_plane, between),
    },
    NearMistake {
        does: "clips at z = w, the far plane",
        repair: "clip at z = -w",
        refuted: "a corner beyond the far plane that is kept",
        clip: |c| clip(c, |[_, _, z, w]| w - z, between),
    },
    NearMistake {
        does: "keeps the part behind the near plane",
        repair: "turn the comparison round",
        refuted: "a corner before the plane that is kept",
        clip: |c| clip(c, |p| -near_plane(p), between),
    },
    NearMistake {
        does: "divides an edge from the wrong end: t is 1 - t",
        repair: "t counts from the end whose distance is the numerator",
        refuted: "a new corner that lies in the plane",
        clip: |c| clip(c, near_plane, |kept, lost, t| between(kept, lost, 1.0 - t)),
    },
    NearMistake {
        does: "puts the new corner in the middle of the edge",
        repair: "divide the edge as the distances of its ends do",
        refuted: "a new corner that lies in the plane",
        clip: |c| clip(c, near_plane, |kept, lost, _| between(kept, lost, 0.5)),
    },
    NearMistake {
        does: "keeps the old w at a new corner",
        repair: "interpolate w as x, y and z",
        refuted: "a new corner with a w of its own",
        clip: |c| {
            clip(c, near_plane, |kept, lost, t| {
                let new = between(kept, lost, t);
                [new[0], new[1], new[2], kept[3]]
            })
        },
    },
    NearMistake {
        does: "keeps the old x and y at a new corner",
        repair: "interpolate x and y as z and w",
        refuted: "a new corner with a position of its own",
        clip: |c| {
            clip(c, near_plane, |kept, lost, t| {
                let new = between(kept, lost, t);
                [kept[0], kept[1], new[2], new[3]]
            })
        },
    },
    NearMistake {
        does: "keeps at most three corners, so that a quadrilateral loses one",
        repair: "a triangle that is cut can have four corners",
        refuted: "an answer with four corners",
        clip: |c| {
            let mut left = clip(c, near_plane, between);
            left.truncate(3);
            left
        },
    },
    NearMistake {
        does: "moves corners behind the plane onto it (clamps z) and cuts nothing",
        repair: "divide the edges",
        refuted: "a new corner on an edge",
        clip: |c| c.map(|[x, y, z, w]| [x, y, z.max(-w), w]).to_vec(),
    },
];

fn of_near(all: &[Answered], tolerance: f64) -> Vec<Hypothesis<'_>> {
    let of = |mistake: &'static NearMistake| {
        let NearMistake { does, repair, refuted, clip } = mistake;
        let says = Explanation::new("the near plane", (*does).to_owned(), repair, "ch07", refuted);
        hypothesis(all, says, move |question, answer| {
            let (Asked::Near(triangle), Answer::Polygon(polygon)) = (&question.of, answer) else {
                return true;
            };
            let corners = clip_corners(triangle);
            same_polygon(&clip(corners), polygon, &corners, tolerance)
        })
    };
    NEAR.iter().map(of).collect()
}

/// Whether both are the same corners one way round; what has fewer than three may be left out.
fn same_polygon(
    a: &[ClipCorner],
    b: &[ClipCorner],
    corners: &[ClipCorner; 3],
    tolerance: f64,
) -> bool {
    let largest = corners.as_flattened().iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let near = |p: &ClipCorner, q: &ClipCorner| {
        p.iter()
            .zip(q)
            .all(|(p, q)| (p - q).abs() <= 10.0 * tolerance * largest + f64::MIN_POSITIVE)
    };
    let has_area = |polygon: &[ClipCorner]| polygon.len() > 2;
    (!has_area(a) && !has_area(b)) || is_round(a.len(), b.len(), |i, j| near(&a[i], &b[j]))
}
