//! Mistakes beside coverage: in values, in the four samples of a pixel, in which triangle is seen, and at the near plane.
//!
//! As in [`rasterproof_verify::mistakes`], a mistake is a pure function from a question to an answer, and it is named if it
//! predicts the answers. To add one, add an entry to a table.

use std::cell::RefCell;
use std::rc::Rc;

use super::adapt_case;
use super::ask::{Answer, Ask, Asked, Question};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::in_process::Inside;
use super::near_plane::{asked, bounds, is_round};
use super::pixels::{masks_of, picks};
use super::run::MOST_DEATHS;
use glam::DVec2;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::area2;
use rasterproof_verify::mistakes::values::{self, ValueHypothesis, depths, sum, weights};
use rasterproof_verify::mistakes::{Explanation, Hypothesis, Mistakes, of_answers};
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
        Check::Values => values::FAMILIES,
        Check::Samples => &["uniform", "half-integer"],
        Check::Depth => &["depth-order", "depth-near-tie"],
        Check::Near | Check::Carried => &["near-plane"],
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
    let mut hypotheses = hypotheses(check, &all, truth);
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

fn hypotheses<'a>(check: Check, all: &'a [Answered], truth: &Truth) -> Vec<Hypothesis<'a>> {
    match check {
        Check::Values => of_values(all, truth.declared.tolerance),
        Check::Samples => of_samples(all),
        Check::Depth => of_depth(all),
        Check::Near | Check::Carried => of_near(all, &truth.declared),
        _ => Vec::new(),
    }
}

/// What the mistakes do that predict every one of these answers.
#[must_use]
pub fn explaining(check: Check, all: &[Answered], truth: &Truth) -> Vec<String> {
    let explains = |known: &Hypothesis<'_>| (0..all.len()).all(|i| (known.predicts)(i));
    let all = hypotheses(check, all, truth).into_iter().filter(explains);
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

fn of_values(all: &[Answered], tolerance: f64) -> Vec<Hypothesis<'_>> {
    let of = |known: ValueHypothesis| {
        hypothesis(all, known.says.clone(), move |question, answer| match (&question.of, answer) {
            (Asked::Values(triangle), Answer::Values(fragments)) => picks(fragments).all(|f| {
                is_near(triangle, f, known.predict(triangle, (f.x_px, f.y_px)), tolerance)
            }),
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

fn size(t: &Triangle) -> f64 {
    area2(&t.corners()).unsigned_abs() as f64
}

type Quantise = fn(f64, i32) -> f64;
/// How a depth is brought to so many bits.
const QUANTISED: [(Quantise, &str); 2] = [
    (|depth, bits| (depth * f64::from(2).powi(bits)).floor(), "cut down"),
    (|depth, bits| (depth * (f64::from(2).powi(bits) - 1.0)).round(), "rounded"),
];
/// Depth buffers of more bits are not distinguished.
const MOST_BITS: i32 = 24;

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
        does: "compares the mean depths of whole triangles",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        replaces: |a, b| mean(b.triangle) < mean(a.triangle),
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
        does: "compares depths that are not divided by the area of their triangle",
        repair: "divide the weighted sum by the area",
        refuted: "a large triangle that is seen before a small one",
        replaces: |a, b| b.depth * size(b.triangle) < a.depth * size(a.triangle),
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
    let mut hypotheses: Vec<_> = DEPTHS
        .iter()
        .map(|mistake| {
            let DepthMistake { does, repair, refuted, replaces, place } = mistake;
            let does = (*does).to_owned();
            let says = Explanation::new("order of depths", does, repair, "ch06", refuted);
            hypothesis(all, says, move |question, answer| {
                let Asked::Depth(list) = &question.of else { return true };
                let layers = layers(list, window_of(question), *place);
                is_seen(&layers, answer, &|a, b| replaces(a, b))
            })
        })
        .collect();
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
        Oracle.cover(corners, window, |span| {
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
        does: "divides an edge from the wrong end: t is 1 - t",
        repair: "t counts from the end whose distance is the numerator",
        refuted: "a new corner that lies in the plane",
        clip: |c, near| clip(c, near, |kept, lost, t| between(kept, lost, 1.0 - t)),
    },
    NearMistake {
        does: "puts the new corner in the middle of the edge",
        repair: "divide the edge as the distances of its ends do",
        refuted: "a new corner that lies in the plane",
        clip: |c, near| clip(c, near, |kept, lost, _| between(kept, lost, 0.5)),
    },
    NearMistake {
        does: "keeps the old w at a new corner",
        repair: "interpolate w as x, y and z",
        refuted: "a new corner with a w of its own",
        clip: |c, near| {
            clip(c, near, |kept, lost, t| {
                let new = between(kept, lost, t);
                [new[0], new[1], new[2], kept[3], new[4]]
            })
        },
    },
    NearMistake {
        does: "keeps the old x and y at a new corner",
        repair: "interpolate x and y as z and w",
        refuted: "a new corner with a position of its own",
        clip: |c, near| {
            clip(c, near, |kept, lost, t| {
                let new = between(kept, lost, t);
                [kept[0], kept[1], new[2], new[3], new[4]]
            })
        },
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
        does: "keeps the attribute of the corner that stays at a new corner",
        repair: "interpolate attributes as x, y, z and w",
        refuted: "a new corner with an attribute of its own",
        clip: |c, near| carried(c, near, |kept, _, _| kept[4]),
    },
    NearMistake {
        does: "keeps the attribute of the corner that is cut off at a new corner",
        repair: "interpolate attributes as x, y, z and w",
        refuted: "a new corner with an attribute of its own",
        clip: |c, near| carried(c, near, |_, lost, _| lost[4]),
    },
    NearMistake {
        does: "divides attributes from the wrong end: t is 1 - t",
        repair: "use the same t for attributes as for x, y, z and w",
        refuted: "a new corner with the attribute of its place",
        clip: |c, near| carried(c, near, |kept, lost, t| lost[4] + (kept[4] - lost[4]) * t),
    },
    NearMistake {
        does: "gives a new corner the mean of both attributes",
        repair: "divide attributes as the distances of the ends do",
        refuted: "a new corner with the attribute of its place",
        clip: |c, near| carried(c, near, |kept, lost, _| (kept[4] + lost[4]) / 2.0),
    },
    NearMistake {
        does: "interpolates attributes at a new corner with a correction for perspective",
        repair: "attributes are linear in clip space, before the division by w: interpolate them as x, y, z and w",
        refuted: "a new corner between unequal w with the attribute of its place",
        clip: |c, near| {
            carried(c, near, |kept, lost, t| {
                let (k, l) = ((1.0 - t) / kept[3], t / lost[3]);
                (k * kept[4] + l * lost[4]) / (k + l)
            })
        },
    },
    NearMistake {
        does: "gives a new corner the attribute 0",
        repair: "interpolate attributes as x, y, z and w",
        refuted: "a new corner with an attribute",
        clip: |c, near| carried(c, near, |_, _, _| 0.0),
    },
];

/// Right corners, with another attribute at new ones.
fn carried(
    corners: [ClipCorner; 3],
    near: Plane,
    attribute: fn(ClipCorner, ClipCorner, f64) -> f64,
) -> Vec<ClipCorner> {
    clip(corners, near, |kept, lost, t| {
        let [x, y, z, w, _] = between(kept, lost, t);
        [x, y, z, w, attribute(kept, lost, t)]
    })
}

fn of_near<'a>(all: &'a [Answered], declared: &Declared) -> Vec<Hypothesis<'a>> {
    let tolerance = declared.tolerance;
    let near: Plane = match declared.near_is_zero {
        true => |[_, _, z, _, _]| z,
        false => |[_, _, z, w, _]| z + w,
    };
    let of = |mistake: &'static NearMistake| {
        let NearMistake { does, repair, refuted, clip } = mistake;
        let says = Explanation::new("the near plane", (*does).to_owned(), repair, "ch07", refuted);
        hypothesis(all, says, move |question, answer| {
            let (Some(triangle), Some(polygon)) = (asked(&question.of), answer.polygon()) else {
                return true;
            };
            let corners = clip_corners(&triangle);
            same_polygon(&clip(corners, near), polygon, &corners, tolerance)
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
    let bounds = bounds(corners, 10.0 * tolerance);
    let near = |p: &ClipCorner, q: &ClipCorner| {
        p.iter().zip(q).zip(bounds).all(|((p, q), bound)| (p - q).abs() <= bound)
    };
    let has_area = |polygon: &[ClipCorner]| polygon.len() > 2;
    (!has_area(a) && !has_area(b)) || is_round(a.len(), b.len(), |i, j| near(&a[i], &b[j]))
}
