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
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::{centre, twice_area};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Fragment};
use rasterproof_render::pipeline::multisample::{SAMPLES, masks_at};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::convention::{Quantum, Rounding, Shape, Ties, TriangleConvention};
use rasterproof_verify::mistakes::values::{self, ValueHypothesis, depths, sum, weights};
use rasterproof_verify::mistakes::{
    ENOUGH_WRONG, Explanation, Hypothesis, MistakeId, Mistakes, RULES, chosen_by, of_answers,
};
use rasterproof_verify::oracle::Oracle;

/// A case with its answers, and whether they are wrong.
pub struct Answered {
    pub questions: Vec<Question>,
    pub answers: Vec<Answer>,
    pub is_wrong: bool,
}

/// How often a program is asked for more wrong answers than it gave.
const MOST_ROUNDS: u64 = 4;
/// Cases that are drawn for a check, over all of its families.
const CASES: u64 = 400;
/// The questions are the same in every run.
const SEED: u64 = 7;

fn answered(
    program: &mut dyn Subject,
    check: Check,
    families: &[&str],
    truth: &Truth,
) -> Vec<Answered> {
    let mut all: Vec<Answered> = Vec::new();
    let mut deaths = 0;
    for (seed, name) in
        (SEED..SEED + MOST_ROUNDS).flat_map(|seed| families.iter().map(move |name| (seed, name)))
    {
        // Where few answers are wrong, some more are needed.
        let wrong = all.iter().filter(|a| a.is_wrong).count();
        if seed > SEED && (wrong == 0 || wrong >= ENOUGH_WRONG) {
            break;
        }
        let Some(family) = adapt_case::family(name) else { continue };
        for index in 0..CASES / families.len() as u64 {
            if deaths >= MOST_DEATHS {
                return all;
            }
            let case: Case = adapt_case::case(family, seed, index, &truth.declared);
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
) -> Option<Mistakes> {
    let all = answered(program, check, families(check), truth);
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
    let mut found = of_answers(hypotheses, &is_wrong)?;
    if !found.is_known() {
        found.common = Common::of(&all, tolerance).sentences();
    }
    Some(found)
}

/// What holds of every wrong pixel and of every wrong polygon so far.
#[derive(Default)]
struct Common {
    /// Both parts of each sentence, and whether it still holds.
    facts: Vec<([&'static str; 2], bool)>,
}

impl Common {
    fn of(all: &[Answered], tolerance: f64) -> Self {
        let mut common = Self::default();
        for Answered { questions, answers, .. } in all.iter().filter(|a| a.is_wrong) {
            for (question, answer) in questions.iter().zip(answers) {
                match (&question.of, answer) {
                    (Asked::Values(triangle), Answer::Values(fragments)) => {
                        fragments.iter().for_each(|f| {
                            common.add_value(triangle, f, window_of(question), tolerance);
                        });
                    }
                    (Asked::Samples(_), _) => common.add_masks(question, answer),
                    (Asked::Depth(list), _) => {
                        common.add_seen(&layers(list, window_of(question), CENTRE), answer);
                    }
                    (of, _) => {
                        let Some(triangle) = asked(of) else { continue };
                        let of_kind = |count| {
                            let near: Plane = |[_, _, z, w, _]| z + w;
                            behind(&clip_corners(&triangle), near) == count
                        };
                        let is_negative =
                            clip_corners(&triangle).iter().any(|corner| corner[3] < 0.0);
                        for (holds, what) in [
                            (of_kind(1), "1 of its corners behind z = -w"),
                            (of_kind(2), "2 of its corners behind z = -w"),
                            (is_negative, "a corner of negative w"),
                        ] {
                            common.note(["Every wrong triangle has ", what], holds);
                        }
                    }
                }
            }
        }
        common
    }

    fn note(&mut self, said: [&'static str; 2], holds: bool) {
        match self.facts.iter_mut().find(|(fact, _)| *fact == said) {
            Some((_, all)) => *all &= holds,
            None => self.facts.push((said, holds)),
        }
    }

    fn add_pixel(&mut self, pixel: [i32; 2], corners: &Corners, window: PixelRect) {
        let [x, y] = pixel;
        let borders = [
            (y == window.y0, "in the first row of the window"),
            (y == window.y1 - 1, "in the last row of the window"),
            (x == window.x0, "in the first column of the window"),
            (x == window.x1 - 1, "in the last column of the window"),
        ];
        let all = WHERE.map(|(holds, place)| (holds(pixel, corners), place));
        for (holds, place) in all.into_iter().chain(borders) {
            self.note(["All wrong pixels are ", place], holds);
        }
    }

    fn add_value(&mut self, t: &Triangle, f: &Fragment<DVec2>, window: PixelRect, tolerance: f64) {
        let is_right = |parts: &[usize]| {
            let [right, given] = values::pixel_of(t, f);
            let predict = |_| {
                let mut other = given;
                parts.iter().for_each(|&i| other[i] = right[i]);
                Some(other)
            };
            are_near(t, std::slice::from_ref(f), &predict, tolerance)
        };
        if is_right(&[0, 1, 2]) {
            return;
        }
        self.add_pixel([f.x_px, f.y_px], &t.corners(), window);
        for (parts, what) in [
            (&[0][..], "Depth is"),
            (&[1, 2], "Both attributes are"),
            (&[1], "The first attribute is"),
            (&[2], "The second attribute is"),
        ] {
            self.note([what, " right in all of them"], is_right(parts));
        }
    }

    fn add_masks(&mut self, question: &Question, answer: &Answer) {
        let Some((corners, window, drawn)) = masks_drawn(question, answer) else { return };
        let Some(right) = masks_at(&Oracle, *corners, window, &SAMPLES) else { return };
        for ((y, right), (_, drawn)) in right.rows().zip(drawn.rows()) {
            for (x, (right, drawn)) in (window.x0..).zip(right.iter().zip(drawn)) {
                if right == drawn {
                    continue;
                }
                self.add_pixel([x, y], corners, window);
                for (holds, said) in [
                    (drawn & !right == 0, ["Samples are missing,", " and none is extra"]),
                    (right & !drawn == 0, ["Samples are extra,", " and none is missing"]),
                    (*right != 0, ["Pixels of which no sample is covered", " are right"]),
                    (*right != 15, ["Pixels of which all samples are covered", " are right"]),
                ] {
                    self.note(said, holds);
                }
                let alone = [
                    "0 alone is wrong",
                    "1 alone is wrong",
                    "2 alone is wrong",
                    "3 alone is wrong",
                ];
                for (bit, what) in alone.into_iter().enumerate() {
                    self.note(["The sample with the number ", what], right ^ drawn == 1 << bit);
                }
            }
        }
    }

    fn add_seen(&mut self, layers: &Layers<'_>, answer: &Answer) {
        for (here, shown) in layers.of_pixels.iter().zip(shown(layers, answer)) {
            let Some(nearest) = here.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)) else {
                continue;
            };
            let seen = here.iter().find(|layer| layer.number as u8 + 1 == shown);
            // Of equal depths any may be shown.
            if seen.is_some_and(|seen| seen.depth <= nearest.depth) {
                continue;
            }
            self.add_pixel(nearest.pixel, &nearest.triangle.corners(), layers.window);
            let is = |order: fn(&usize, &usize) -> bool| {
                seen.is_some_and(|seen| order(&seen.number, &nearest.number))
            };
            for (holds, what) in [
                (shown == 0, "nothing"),
                (is(usize::gt), "a triangle that was drawn after the nearest one"),
                (is(usize::lt), "a triangle that was drawn before the nearest one"),
            ] {
                self.note(["Wrong pixels show ", what], holds);
            }
        }
    }

    fn sentences(self) -> Vec<String> {
        let held = self.facts.into_iter().filter(|(_, holds)| *holds);
        held.map(|(said, _)| said.concat() + ".").collect()
    }
}

fn hypotheses<'a>(
    check: Check,
    all: &'a [Answered],
    is_wrong: &[bool],
    truth: &Truth,
) -> Vec<Hypothesis<'a>> {
    // Where nothing is drawn, every mistake that may draw nothing explains it.
    if !all.is_empty() && all.iter().flat_map(|a| &a.answers).all(Answer::is_blank) {
        return Vec::new();
    }
    match check {
        Check::Values => of_values(all, is_wrong, truth.declared.tolerance),
        Check::Samples => of_samples(all, is_wrong),
        Check::Depth => of_depth(all, is_wrong),
        Check::Near | Check::Carried => of_near(all, is_wrong, &truth.declared),
        _ => Vec::new(),
    }
}

/// The mistakes that predict every one of these answers, of those that have an identifier.
#[must_use]
pub fn explaining(check: Check, all: &[Answered], truth: &Truth) -> Vec<MistakeId> {
    let explains = |known: &Hypothesis<'_>| (0..all.len()).all(|i| (known.predicts)(i));
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let all = hypotheses(check, all, &is_wrong, truth).into_iter().filter(explains);
    all.filter_map(|known| MistakeId::of(&known.says.does)).collect()
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
            // What a program does not draw has no values to compare.
            if here.len() != there.len() {
                return false;
            }
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

fn of_values<'a>(all: &'a [Answered], is_wrong: &[bool], tolerance: f64) -> Vec<Hypothesis<'a>> {
    let mut pixels = Vec::new();
    for answered in chosen_by(is_wrong).into_iter().map(|i| &all[i]) {
        for (question, answer) in answered.questions.iter().zip(&answered.answers) {
            if let (Asked::Values(triangle), Answer::Values(fragments)) = (&question.of, answer) {
                pixels.extend(fragments.iter().take(2).map(|f| values::pixel_of(triangle, f)));
            }
        }
    }
    let of = |known: ValueHypothesis| {
        hypothesis(all, known.says.clone(), move |question, answer| match (&question.of, answer) {
            (Asked::Values(triangle), Answer::Values(fragments)) => {
                let predict = |pixel| known.predict(triangle, pixel);
                are_near(triangle, fragments, &predict, tolerance)
            }
            _ => true,
        })
    };
    let chosen = chosen_by(is_wrong).into_iter().map(|i| &all[i]);
    let triangles: Vec<_> = chosen
        .flat_map(|a| a.questions.iter().zip(&a.answers))
        .filter_map(|(question, answer)| {
            let (Asked::Values(triangle), Answer::Values(fragments)) = (&question.of, answer)
            else {
                return None;
            };
            let right = |pixel| Some(values::right_at(triangle, pixel));
            Some((triangle, !are_near(triangle, fragments, &right, tolerance)))
        })
        .collect();
    values::of_values(values::scaled(&pixels), &triangles).into_iter().map(of).collect()
}

/// Whether it holds of a pixel of a triangle.
type Holds = fn([i32; 2], &Corners) -> bool;
/// Where a mistake may be alone, and how that is said.
const WHERE: [(Holds, &str); 8] = [
    (|_, corners| twice_area(corners) < 0, "of counterclockwise triangles"),
    (|_, corners| twice_area(corners) > 0, "of clockwise triangles"),
    (|[_, y], _| y % 2 == 0, "in rows of even numbers"),
    (|[_, y], _| y % 2 == 1, "in rows of odd numbers"),
    (|[x, _], _| x % 2 == 0, "in columns of even numbers"),
    (|[x, _], _| x % 2 == 1, "in columns of odd numbers"),
    (|[x, y], _| (x + y) % 2 == 0, "where row and column add up to an even number"),
    (|[x, y], _| (x + y) % 2 == 1, "where row and column add up to an odd number"),
];

/// Places of the four samples in 1/16 px, in the order of their bits.
type Pattern = [(i32, i32); 4];

/// The right places moved within the pixel, and how that is said.
fn moved_patterns() -> [(Pattern, &'static str); 4] {
    let moved = |by: fn((i32, i32)) -> (i32, i32)| SAMPLES.map(by);
    [
        (moved(|_| (8, 8)), MistakeId::SamplesAtCentre.name()),
        (moved(|(x, y)| (16 - x, y)), "tests samples that are mirrored left to right"),
        (moved(|(x, y)| (x, 16 - y)), "tests samples that are mirrored upside down"),
        (moved(|(x, y)| (y, x)), "tests samples with x and y exchanged"),
    ]
}

/// Patterns that are not the right one, and how they are said.
fn patterns() -> Vec<(Pattern, String)> {
    let plain: [(Pattern, &str); 3] = [
        ([(4, 4), (12, 4), (4, 12), (12, 12)], MistakeId::SamplesInSquare.name()),
        (
            SAMPLES.map(|(x, y)| (x - 8, y - 8)),
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
    for (pattern, said) in moved_patterns().into_iter().chain(plain) {
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

/// What becomes of the mask of a pixel, whose bit 4 is its centre; the number says more.
type Gate = fn(u8, [i32; 2], &Corners, u8) -> u8;

/// Masks that come from right ones, and how that is said.
fn gates() -> Vec<(Gate, u8, String)> {
    let mut all: Vec<(Gate, u8, String)> = vec![
        (
            |mask, _, _, _| if mask < 16 { 0 } else { mask & 15 },
            0,
            "tests the samples of pixels whose centre is covered, and of no others".to_owned(),
        ),
        (
            |mask, _, _, _| if mask < 16 { 0 } else { 15 },
            0,
            "draws all four samples of a pixel where its centre is covered".to_owned(),
        ),
    ];
    all.push((
        |mask, _, _, _| if mask < 16 { mask & 15 } else { 15 },
        0,
        "draws all four samples of a pixel where its centre is covered, and those that are covered elsewhere"
            .to_owned(),
    ));
    for bit in 0..4 {
        all.push((
            |mask, _, _, bit| mask & 15 & if mask < 16 { !(1 << bit) } else { 15 },
            bit,
            format!(
                "draws the sample with the number {bit} only in pixels whose centre is covered"
            ),
        ));
        all.push((
            |mask, _, _, bit| mask & 15 | if mask < 16 { 0 } else { 1 << bit },
            bit,
            format!("draws the sample with the number {bit} also where the centre is covered"),
        ));
    }
    for least in 1..=4 {
        let samples = ["any is", "two are", "three are", "all four are"][usize::from(least) - 1];
        all.push((
            |mask, _, _, least| if (mask & 15).count_ones() < least.into() { 0 } else { 15 },
            least,
            format!(
                "draws all four samples of a pixel where {samples} covered, and none elsewhere"
            ),
        ));
        all.push((
            |mask, _, _, least| if (mask & 15).count_ones() < least.into() { 0 } else { mask & 15 },
            least,
            format!("draws the samples of a pixel only where {samples} covered"),
        ));
        all.push((
            |mask, _, _, lost| mask & 15 & !(1 << (lost - 1)),
            least,
            format!("never draws the sample with the number {}", least - 1),
        ));
    }
    // Which sides of the box hold, and whether a centre on them counts.
    for sides in 1..32 {
        let said = ["left", "upper", "right", "lower"];
        let said: Vec<_> =
            (0..4).filter(|side| sides >> side & 1 == 1).map(|side| said[side]).collect();
        let (said, border) =
            (said.join(", "), ["in, or on the border of,", "in"][usize::from(sides >> 4)]);
        if !said.is_empty() {
            all.push((
                |mask, at, corners, sides| if is_centre_in_box(at, corners, sides) { mask & 15 } else { 0 },
                sides,
                format!(
                    "tests the samples of pixels whose centre lies {border} the box around the triangle ({said} side), and of no others"
                ),
            ));
        }
    }
    all
}

/// Whether the centre of a pixel lies within those sides of the box that are asked for.
fn is_centre_in_box(at: [i32; 2], corners: &Corners, sides: u8) -> bool {
    (0..4).filter(|side| sides >> side & 1 == 1).all(|side| {
        let v = corners.map(|c| i64::from([c.x, c.y][side % 2]));
        let centre = centre(at[side % 2]);
        let (v, centre) = if side < 2 { (v, centre) } else { (v.map(|v| -v), -centre) };
        v.iter().any(|v| *v < centre || (sides < 16 && *v == centre))
    })
}

/// Answers by which the places of samples are looked for.
const LOOKED_AT: usize = 24;

/// Where the samples seem to be tested, each on its own among all places of the pixel.
fn found_pattern(all: &[Answered], is_wrong: &[bool]) -> Option<Pattern> {
    let mut places: Vec<(i32, i32)> =
        (0..=16).flat_map(|y| (0..=16).map(move |x| (x, y))).collect();
    // The right places of the pixels around it, too.
    let around = (0..9).map(|k| (k % 3 * 16 - 16, k / 3 * 16 - 16)).filter(|by| *by != (0, 0));
    places.extend(around.flat_map(|(dx, dy)| SAMPLES.map(|(x, y)| (x + dx, y + dy))));
    let mut left = vec![15_u8; places.len()];
    for (corners, window, drawn) in all_masks(all, is_wrong, LOOKED_AT) {
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
    let same: Gate = |mask, _, _, _| mask & 15;
    let found = found_pattern(all, is_wrong).filter(|pattern| *pattern != SAMPLES);
    let found = found.map(|pattern| {
        let [a, b, c, d] = pattern.map(|(x, y)| format!("({x}, {y})"));
        let does = format!("tests samples at {a}, {b}, {c} and {d} of 1/16 px");
        (pattern, does, (same, 0))
    });
    let patterns = patterns().into_iter().map(|(pattern, does)| (pattern, does, (same, 0)));
    let pairs = (0..RULES.len() * RULES.len()).map(|p| (p, None));
    let alone = (0..4).flat_map(|bit| (0..RULES.len()).map(move |r| (7 * r, Some(bit))));
    let rules = pairs.chain(alone).filter(|(p, _)| *p > 0);
    let rules = rules.filter_map(|(p, bit)| sample_rule(all, p, bit));
    let table = found_masks(all, is_wrong).map(|masks| of_masks(all, masks));
    let gates = gates().into_iter().map(|(gate, number, does)| (SAMPLES, does, (gate, number)));
    patterns
        .chain(gates)
        .chain(found)
        .map(|([a, b, c, d], does, (gate, number))| {
            let says = Explanation::new(
                "places of the samples",
                does,
                "test each sample at its own place, in the order of the bits that the protocol states",
                "games101",
                "a pixel on an edge with the right mask",
            );
            // Bit 4 is the centre.
            let places = vec![a, b, c, d, (8, 8)];
            masks_become(all, says, places, move |mask, at, corners| {
                gate(mask, at, corners, number)
            })
        })
        .chain(rules)
        .chain(table)
        .chain(samples_somewhere(all))
        .chain(samples_on_grid(all))
        .collect()
}

/// That the samples are wrong in some pixels alone.
fn samples_somewhere(all: &[Answered]) -> impl Iterator<Item = Hypothesis<'_>> {
    // In all pixels, half a turn only numbers the right places in another order.
    let turned = SAMPLES.map(|(x, y)| (16 - x, 16 - y));
    let turned = (turned, "tests samples that are turned by half a turn");
    let moved = moved_patterns().into_iter().chain([turned]);
    let moved = moved.map(|(pattern, does)| (Some(pattern), does));
    let wrong = [(None, "draws no sample")].into_iter().chain(moved);
    let each = wrong.flat_map(|wrong| WHERE.map(|place| (wrong, place)));
    let kinds = each.flat_map(|(wrong, place)| [false, true].map(|partly| (wrong, place, partly)));
    kinds.map(|((pattern, does), (holds, place), partly)| {
        let of_partly = if partly { ", of pixels that are covered in part" } else { "" };
        let says = Explanation::new(
            "samples in some pixels",
            format!("{does} {place}{of_partly}"),
            "test the same four places in every pixel of every triangle",
            "games101",
            "such a pixel with the right mask",
        );
        let places = [SAMPLES, pattern.unwrap_or(SAMPLES)].concat();
        masks_become(all, says, places, move |mask, at, corners| match mask & 15 {
            right if !holds(at, corners) || (partly && right == 15) => right,
            _ if pattern.is_none() => 0,
            _ => mask >> 4,
        })
    })
}

/// That corners reach a coarser grid before samples are tested.
fn samples_on_grid(all: &[Answered]) -> impl Iterator<Item = Hypothesis<'_>> {
    let grids = [(16, "1/16 px"), (64, "1/4 px"), (256, "whole pixels")];
    let kinds = grids.into_iter().flat_map(|grid| [(grid, true), (grid, false)]);
    kinds.map(|((step, grid), is_cut)| {
        let says = Explanation::new(
            "places of the samples",
            format!(
                "tests samples of corners that are {} to {grid}",
                if is_cut { "cut" } else { "rounded" }
            ),
            "test samples of the corners by which pixels are covered",
            "games101",
            "a sample between two edges of a corner off that grid",
        );
        let rounding = if is_cut { Rounding::Down } else { Rounding::Near };
        let quantum = Quantum { step, rounding };
        by_masks(all, says, move |corners, window, drawn| {
            let moved = quantum.snap(corners);
            masks_at(&Oracle, moved, window, &SAMPLES).is_none_or(|masks| masks == *drawn)
        })
    })
}

/// The mask that is drawn for each right one, and the mask of which none was seen as it is.
fn found_masks(all: &[Answered], is_wrong: &[bool]) -> Option<[u8; 16]> {
    let mut table: [Option<u8>; 16] = [None; 16];
    for (corners, window, drawn) in all_masks(all, is_wrong, usize::MAX) {
        let right = masks_at(&Oracle, *corners, window, &SAMPLES)?;
        for ((_, right), (_, drawn)) in right.rows().zip(drawn.rows()) {
            for (right, drawn) in right.iter().zip(drawn) {
                if *table[usize::from(right & 15)].get_or_insert(*drawn) != *drawn {
                    return None;
                }
            }
        }
    }
    let mut masks = [0; 16];
    for (right, mask) in (0..).zip(&mut masks) {
        *mask = table[usize::from(right)].unwrap_or(right);
    }
    Some(masks)
}

/// That masks are turned into others.
fn of_masks(all: &[Answered], masks: [u8; 16]) -> Hypothesis<'_> {
    let samples = |mask: u8| -> String {
        let of = (0..4).filter(|bit| mask >> bit & 1 == 1).map(|bit| bit.to_string());
        let of: Vec<String> = of.collect();
        if of.is_empty() { "none".to_owned() } else { of.join(" and ") }
    };
    let changed: Vec<(u8, u8)> = (0..).zip(masks).filter(|(right, mask)| right != mask).collect();
    let said: Vec<String> = changed
        .iter()
        .take(3)
        .map(|(right, mask)| format!("{} for {}", samples(*mask), samples(*right)))
        .collect();
    let more = match changed.len().saturating_sub(3) {
        0 => String::new(),
        more => format!(", and {more} others"),
    };
    let says = Explanation::new(
        "masks of samples",
        format!("draws samples {}{more}, whatever the place", said.join(", ")),
        "draw the samples that are covered",
        "games101",
        "a pixel with such samples that is drawn rightly",
    );
    masks_become(all, says, SAMPLES.to_vec(), move |mask, _, _| masks[usize::from(mask & 15)])
}

/// That this becomes of the mask of some places, at each pixel.
fn masks_become<'a>(
    all: &'a [Answered],
    says: Explanation,
    places: Vec<(i32, i32)>,
    mask: impl Fn(u8, [i32; 2], &Corners) -> u8 + 'a,
) -> Hypothesis<'a> {
    by_masks(all, says, move |corners, window, drawn| {
        let Some(masks) = masks_at(&Oracle, *corners, window, &places) else { return true };
        masks.rows().zip(drawn.rows()).all(|((y, masks), (_, drawn))| {
            let pixels = (window.x0..).zip(masks.iter().zip(drawn));
            pixels.into_iter().all(|(x, (of, drawn))| mask(*of, [x, y], corners) == *drawn)
        })
    })
}

/// A hypothesis by the masks that are drawn of a triangle; it says nothing of other questions.
fn by_masks<'a>(
    all: &'a [Answered],
    says: Explanation,
    predicts: impl Fn(&Corners, PixelRect, &Frame<u8>) -> bool + 'a,
) -> Hypothesis<'a> {
    hypothesis(all, says, move |question, answer| {
        let drawn = masks_drawn(question, answer);
        drawn.is_none_or(|(corners, window, drawn)| predicts(corners, window, &drawn))
    })
}

/// The triangle of a question about samples, with the masks of its answer.
fn masks_drawn<'q>(
    question: &'q Question,
    answer: &Answer,
) -> Option<(&'q Corners, PixelRect, Frame<u8>)> {
    let (Asked::Samples(corners), Answer::Samples(runs)) = (&question.of, answer) else {
        return None;
    };
    let window = window_of(question);
    Some((corners, window, masks_of(runs, window)))
}

/// The same of all answers by which hypotheses are chosen, or of the first ones, which have one question each.
fn all_masks<'a>(
    all: &'a [Answered],
    is_wrong: &[bool],
    most: usize,
) -> impl Iterator<Item = (&'a Corners, PixelRect, Frame<u8>)> {
    let of = move |i: usize| masks_drawn(all[i].questions.first()?, all[i].answers.first()?);
    chosen_by(is_wrong).into_iter().take(most).filter_map(of)
}

/// Another rule for the samples of clockwise triangles, or of the others, or of both; or for one sample alone.
fn sample_rule(all: &[Answered], p: usize, alone: Option<usize>) -> Option<Hypothesis<'_>> {
    let rules = [p / RULES.len(), p % RULES.len()].map(|rule| RULES[rule]);
    let [clockwise, other] = [Ties::named(rules[0])?, Ties::named(rules[1])?];
    let of = alone.map_or("samples".to_owned(), |bit| format!("the sample with the number {bit}"));
    let does = match rules[0] == rules[1] {
        true => format!("follows the {} rule for {of} on edges", rules[0]),
        false => format!(
            "follows the {} rule for samples on edges of clockwise triangles and the {} rule for those of others",
            rules[0], rules[1]
        ),
    };
    let says = Explanation::new(
        "rule for samples",
        does,
        "test each sample by the rule that pixels follow",
        "ch02",
        "a sample on an edge that the top-left rule decides",
    );
    Some(by_masks(all, says, move |corners, window, drawn| {
        let ties = if twice_area(corners) > 0 { clockwise } else { other };
        let usual = TriangleConvention::default().ties;
        SAMPLES.iter().enumerate().all(|(bit, (x, y))| {
            let shape = Shape::Point { x: 16 * x, y: 16 * y };
            let ties = if alone.is_none_or(|alone| alone == bit) { ties } else { usual };
            let rule = TriangleConvention { shape, ties, ..TriangleConvention::default() };
            let Some(covered) = rule.cover(corners, window) else { return true };
            drawn.rows().all(|(y, row)| {
                (window.x0..).zip(row).all(|(x, mask)| {
                    (mask >> bit & 1 == 1) == covered.get(x, y).is_some_and(|hits| hits > 0)
                })
            })
        })
    }))
}

fn window_of(question: &Question) -> PixelRect {
    PixelRect::window(question.width, question.height)
}

/// A triangle at a pixel of a pile: its number, its depth there, and the triangle.
#[derive(Clone, Copy)]
struct Layer<'a> {
    number: usize,
    depth: f64,
    pixel: [i32; 2],
    triangle: &'a Triangle,
}

#[derive(Clone, Copy)]
struct DepthMistake {
    does: &'static str,
    repair: &'static str,
    refuted: &'static str,
    /// The number that is compared: the layer with the least one is seen.
    key: fn(&Layer<'_>) -> f64,
    /// Whether of equal ones the last is seen, or the first; nothing where it may be either.
    last: Option<bool>,
    place: Place,
}

/// Where depth is computed, from the pixel and the first one of its row.
#[derive(Clone, Copy)]
enum Place {
    /// At a place of each pixel, in pixels from its upper left corner.
    Pixel([f64; 2]),
    /// At the place of a block of so many pixels.
    Block(i32, f64),
    /// At the centre of the first pixel of the row.
    Row,
}

impl Place {
    fn of(self, x: i32, y: i32, first: i32) -> [f64; 2] {
        match self {
            Self::Pixel(place) => [f64::from(x) + place[0], f64::from(y) + place[1]],
            Self::Block(side, place) => [x, y].map(|v| f64::from(v / side * side) + place),
            Self::Row => [f64::from(first) + 0.5, f64::from(y) + 0.5],
        }
    }
}

fn extreme(t: &Triangle, start: f64, of: fn(f64, f64) -> f64) -> f64 {
    depths(t).into_iter().fold(start, of)
}

fn size(t: &Triangle) -> f64 {
    twice_area(&t.corners()).unsigned_abs() as f64
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

const CENTRE: Place = Place::Pixel([0.5, 0.5]);
const DEPTHS: &[DepthMistake] = &[
    DepthMistake {
        does: MistakeId::FarthestShown.name(),
        repair: "less depth is nearer: turn the comparison round, or clear the buffer with the farthest depth",
        refuted: "a pixel that shows the nearest one",
        key: |a| -a.depth,
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: MistakeId::LastShown.name(),
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
        does: MistakeId::SortedByMeanDepth.name(),
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
        does: MistakeId::UndividedDepthsCompared.name(),
        repair: "divide the weighted sum by the area",
        refuted: "a large triangle that is seen before a small one",
        key: |a| a.depth * size(a.triangle),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "keeps depth in floats of 16 bits",
        repair: "keep more bits of depth, or move the near plane away from the eye",
        refuted: "two depths that differ by less and are told apart",
        key: |a| values::rounded(a.depth, 2),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "compares how far depths lie from 1/2, as where the sign of depths from -1 to 1 is lost",
        repair: "compare the depths themselves",
        refuted: "a pixel that shows the nearest of two triangles before 1/2",
        key: |a| (a.depth - 0.5).abs(),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "turns the sign of the depths of counterclockwise triangles",
        repair: "divide the weighted sum by the area with its sign",
        refuted: "a counterclockwise triangle that lies behind and is not seen",
        key: |a| if twice_area(&a.triangle.corners()) < 0 { -a.depth } else { a.depth },
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "adds the slope of depth to the depths of a triangle (a bias for shadows)",
        repair: "compare the depths themselves",
        refuted: "a steep triangle that lies a little nearer than another and is seen",
        key: |a| a.depth + slope(a.triangle),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "takes the slope of depth off the depths of a triangle (a bias of lines on faces)",
        repair: "compare the depths themselves",
        refuted: "a steep triangle that lies a little farther than another and is not seen",
        key: |a| a.depth - slope(a.triangle),
        last: None,
        place: CENTRE,
    },
    DepthMistake {
        does: "sorts whole triangles by their middle corner",
        repair: "compare depths at every pixel",
        refuted: "two triangles through each other that are both seen",
        key: |a| {
            let [least, most] = [f64::min as fn(f64, f64) -> f64, f64::max]
                .map(|of| extreme(a.triangle, depths(a.triangle)[0], of));
            depths(a.triangle).iter().sum::<f64>() - least - most
        },
        last: None,
        place: CENTRE,
    },
];

/// How fast depth changes along x or y, whichever is faster.
fn slope(t: &Triangle) -> f64 {
    let at = |place| sum(weights(&t.corners(), place), depths(t));
    let from = at([0.0, 0.0]);
    (at([1.0, 0.0]) - from).abs().max((at([0.0, 1.0]) - from).abs())
}

fn at_another_place(place: Place, at: &str) -> (String, DepthMistake) {
    let mistake = DepthMistake {
        does: "",
        repair: "compute depth where coverage is sampled",
        refuted: "a pixel near a crossing that shows the right triangle",
        key: |a| a.depth,
        last: None,
        place,
    };
    (format!("computes depth{at}"), mistake)
}

/// The depth, with something added where a triangle is counterclockwise.
fn behind_by(a: &Layer<'_>, by: f64) -> f64 {
    a.depth + if twice_area(&a.triangle.corners()) < 0 { by } else { 0.0 }
}

/// Differences of depth that are tried, times a power of ten.
const DIGITS: [f64; 3] = [1.0, 2.0, 5.0];

fn of_depth<'a>(all: &'a [Answered], is_wrong: &[bool]) -> Vec<Hypothesis<'a>> {
    let mut hypotheses = Vec::new();
    let plain = DEPTHS.iter().map(|mistake| (mistake.does.to_owned(), *mistake));
    let elsewhere =
        values::PLACES[1..].iter().map(|&(place, at)| at_another_place(Place::Pixel(place), at));
    let blocks = [2, 4, 8].into_iter().flat_map(|side| {
        let place = |place: f64, at| {
            let at = format!(", once for a block of {side} x {side} px, {at}");
            at_another_place(Place::Block(side, place), &at)
        };
        [place(0.5, "in its first pixel"), place(f64::from(side) / 2.0, "in its middle")]
    });
    let row = at_another_place(Place::Row, " in the first pixel of a row, for all of the row");
    let elsewhere = elsewhere.chain(blocks).chain([row]);
    for (does, mistake) in plain.chain(elsewhere) {
        let DepthMistake { repair, refuted, key, last, place, .. } = mistake;
        for is_last in
            [true, false].into_iter().filter(|is_last| last.is_none_or(|l| l == *is_last))
        {
            let says = Explanation::new("order of depths", does.clone(), repair, "ch06", refuted);
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
    type Replaces = fn(&Layer<'_>, &Layer<'_>, f64) -> bool;
    let biased: [(Replaces, &str); 6] = [
        (
            |a, b, by| b.depth - a.depth < by * (b.number as f64 - a.number as f64),
            "takes {} off the depth of a triangle for each one before it",
        ),
        (
            |a, b, by| a.depth - b.depth > by * (b.number as f64 - a.number as f64),
            "adds {} to the depth of a triangle for each one before it",
        ),
        (|a, b, by| b.depth <= a.depth + by, "shows a later triangle that lies up to {} farther"),
        (|a, b, by| b.depth < a.depth - by, "shows a later triangle only where it is nearer by {}"),
        (
            |a, b, by| behind_by(b, by) < behind_by(a, by),
            "adds {} to the depth of counterclockwise triangles",
        ),
        (
            |a, b, by| behind_by(b, -by) < behind_by(a, -by),
            "takes {} off the depth of counterclockwise triangles",
        ),
    ];
    for (replaces, does) in biased {
        for by in (-7..0).flat_map(|power| DIGITS.map(|digit| digit * f64::from(10).powi(power))) {
            let says = Explanation::new(
                "a bias of depth",
                does.replace("{}", &format!("{by:e}")),
                "compare the depths themselves",
                "ch06",
                "two triangles that lie nearer to each other and are shown in the right order",
            );
            hypotheses.push(of_piles(&piles, says, move |layers, answer| {
                is_seen(layers, answer, &|a, b| replaces(a, b, by))
            }));
        }
    }
    // What wraps around, is not compared, or is compared the other way round in some pixels.
    for (times, bits) in (1..6).flat_map(|times| [0, 16].map(|bits| (times, bits))) {
        let shorter =
            if bits == 0 { String::new() } else { format!(" and are cut to {bits} bits") };
        let says = Explanation::new(
            "depth wraps around",
            format!("keeps depths that begin again at 0 after every 1/{}{shorter}", 1 << times),
            "scale depths to what a word holds, and clamp what goes beyond",
            "ch06",
            "two triangles on both sides of such a depth that are shown in the right order",
        );
        let scaled = move |layer: &Layer<'_>| layer.depth * f64::from(1 << times);
        let key = move |layer: &Layer<'_>| {
            let wrapped = scaled(layer).rem_euclid(1.0);
            if bits == 0 { wrapped } else { (wrapped * 65536.0).floor() }
        };
        hypotheses.push(of_piles(&piles, says, move |layers, answer| {
            layers.of_pixels.iter().zip(shown(layers, answer)).all(|(here, shown)| {
                // Where a depth begins again, or two come to the same, rounding decides: four times, in floats of 32 bits.
                let rounding = f64::from(4 << times) * f64::from(f32::EPSILON);
                let is_near = |depth: f64| (depth - depth.round()).abs() < rounding;
                let is_open = |i: usize| {
                    let depth = scaled(&here[i]);
                    is_near(depth) || here[..i].iter().any(|a| is_near(depth - scaled(a)))
                };
                (0..here.len()).any(is_open) || is_left(here, shown, &|a, b| key(b) < key(a))
            })
        }));
    }
    let turned: [(Replaces, &str); 3] = [
        (|_, _, _| true, "draws without a test of depth"),
        (|a, b, _| b.depth > a.depth, "shows the farther triangle"),
        (|_, _, _| false, "draws nothing over what is there"),
    ];
    for ((holds, place), (replaces, does)) in
        WHERE.into_iter().flat_map(|place| turned.map(|turned| (place, turned)))
    {
        let says = Explanation::new(
            "depth in some pixels",
            format!("{does} {place}"),
            "compare depths in every pixel of every triangle in the same way",
            "ch06",
            "such a pixel that shows the nearest triangle before another",
        );
        hypotheses.push(of_piles(&piles, says, move |layers, answer| {
            is_seen(layers, answer, &|a, b| match holds(b.pixel, &b.triangle.corners()) {
                true => replaces(a, b, 0.0),
                false => b.depth < a.depth,
            })
        }));
    }
    for (buffer, does, repair) in BUFFERS {
        for (is_last, which) in [(false, ""), (true, ", a tie going to the later one")] {
            let says = Explanation::new(
                "the buffer of depths",
                format!("{does}{which}"),
                repair,
                "ch06",
                "a pixel of three triangles that shows the nearest one",
            );
            hypotheses.push(of_piles(&piles, says, move |layers, answer| {
                let passes = |new: f64, kept: f64| new < kept || (is_last && new == kept);
                layers.of_pixels.iter().zip(shown(layers, answer)).all(|(here, shown)| {
                    let seen = (0..here.len())
                        .rfind(|&i| i == 0 || passes(here[i].depth, buffer(&here[..i])));
                    seen.map_or(0, |i| here[i].number as u8 + 1) == shown
                })
            }));
        }
    }
    // What is nearer than a depth, or farther, is cut away.
    let seen: Vec<(f64, bool)> = chosen_by(is_wrong)
        .iter()
        .filter_map(|&i| piles[i].as_ref())
        .flat_map(seen_and_lost)
        .collect();
    let of = |is_seen: bool| {
        seen.iter().filter(move |(_, seen)| *seen == is_seen).map(|(depth, _)| *depth)
    };
    let (least, most) = (of(true).reduce(f64::min), of(true).reduce(f64::max));
    let nearer = of(false).filter(|lost| least.is_some_and(|least| *lost < least));
    let farther = of(false).filter(|lost| most.is_some_and(|most| *lost > most));
    let middle = |lost: Option<f64>, seen: Option<f64>| Some(values::simplest(lost?, seen?));
    let low = middle(nearer.reduce(f64::max), least);
    let high = middle(farther.reduce(f64::min), most);
    let ranges = [
        low.map(|low| (low, f64::MAX, format!("draws nothing nearer than about {low:.3}"))),
        high.map(|high| (f64::MIN, high, format!("draws nothing farther than about {high:.3}"))),
    ];
    for (low, high, does) in ranges.into_iter().flatten() {
        let says = Explanation::new(
            "a range of depth",
            does,
            "clear the buffer with the farthest depth, and clip at the planes alone",
            "ch06",
            "a triangle beyond that depth that is seen",
        );
        hypotheses.push(of_piles(&piles, says, move |layers, answer| {
            let kept = |layer: &&Layer<'_>| layer.depth >= low && layer.depth < high;
            let of_pixels =
                layers.of_pixels.iter().map(|here| here.iter().filter(kept).copied().collect());
            let layers = Layers { window: layers.window, of_pixels: of_pixels.collect() };
            is_seen(&layers, answer, &|a, b| b.depth < a.depth)
        }));
    }
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
                hypotheses.push(of_piles(&piles, says, move |layers, answer| {
                    is_seen(layers, answer, &|a, b| {
                        let [a, b] = [a, b].map(|layer| quantise(layer.depth, bits));
                        b < a || (is_last && a == b)
                    })
                }));
            }
        }
    }
    hypotheses
}

/// What a new triangle is compared with, from the layers before it, of which there is one at least.
type Buffer = fn(&[Layer<'_>]) -> f64;
const BUFFERS: [(Buffer, &str, &str); 2] = [
    (
        |before| before[0].depth,
        "tests depths and does not write them: a pixel keeps the depth of its first triangle",
        "write the depth of each triangle that passes the test",
    ),
    (
        |before| before[before.len() - 1].depth,
        "writes the depth of a triangle also where the test fails",
        "write depths where the test passes, and nowhere else",
    ),
];

/// A hypothesis about what is shown of piles.
fn of_piles<'a>(
    piles: &Rc<Vec<Option<Pile<'a>>>>,
    says: Explanation,
    explains: impl Fn(&Layers<'_>, &Answer) -> bool + 'a,
) -> Hypothesis<'a> {
    let piles = Rc::clone(piles);
    let here = move |(layers, answer): &Pile<'a>| explains(layers, answer);
    let predicts = move |i: usize| piles[i].as_ref().is_none_or(&here);
    Hypothesis { predicts: Box::new(predicts), says }
}

/// The layers at the centre of each pixel of a case, and what was answered.
type Pile<'a> = (Layers<'a>, &'a Answer);

fn pile(answered: &Answered) -> Option<Pile<'_>> {
    let (question, answer) = (answered.questions.first()?, answered.answers.first()?);
    let Asked::Depth(list) = &question.of else { return None };
    Some((layers(list, window_of(question), CENTRE), answer))
}

/// The triangles that cover each pixel of a window, row by row, in drawing order.
struct Layers<'a> {
    window: PixelRect,
    of_pixels: Vec<Vec<Layer<'a>>>,
}

fn layers(list: &[Triangle], window: PixelRect, place: Place) -> Layers<'_> {
    let width = window.width() as usize;
    let mut of_pixels = vec![Vec::new(); width * window.height() as usize];
    for (number, triangle) in list.iter().enumerate() {
        let corners = triangle.corners();
        Oracle.spans(corners, window, &mut |span| {
            let row = (span.y_px - window.y0) as usize * width;
            for x in span.x0_px..span.x1_px {
                let at = place.of(x, span.y_px, span.x0_px);
                let depth = sum(weights(&corners, at), depths(triangle));
                let pixel = [x, span.y_px];
                let layer = Layer { number, depth, pixel, triangle };
                of_pixels[row + (x - window.x0) as usize].push(layer);
            }
        });
    }
    Layers { window, of_pixels }
}

/// The depths that are shown, and those that are lost: nearer ones than what is shown, or all where nothing is.
fn seen_and_lost((layers, answer): &(Layers<'_>, &Answer)) -> Vec<(f64, bool)> {
    let mut all = Vec::new();
    for (here, shown) in layers.of_pixels.iter().zip(shown(layers, answer)) {
        let seen = here.iter().find(|layer| layer.number as u8 + 1 == shown).map(|seen| seen.depth);
        all.extend(seen.map(|depth| (depth, true)));
        let lost = here
            .iter()
            .map(|layer| layer.depth)
            .filter(|depth| seen.is_none_or(|seen| *depth < seen));
        all.extend(lost.map(|depth| (depth, false)));
    }
    all
}

/// The number of the triangle that is shown at each pixel, and one; 0 where nothing is.
fn shown(layers: &Layers<'_>, answer: &Answer) -> Vec<u8> {
    let Answer::Seen(runs) = answer else { return Vec::new() };
    let shown: Vec<_> = runs.iter().map(|(run, number)| (*run, number + 1)).collect();
    masks_of(&shown, layers.window).rows().flat_map(|(_, row)| row.to_vec()).collect()
}

/// Whether an answer shows what is left where a layer replaces the one that was kept by this rule.
fn is_seen(
    layers: &Layers<'_>,
    answer: &Answer,
    replaces: &dyn Fn(&Layer<'_>, &Layer<'_>) -> bool,
) -> bool {
    layers
        .of_pixels
        .iter()
        .zip(shown(layers, answer))
        .all(|(here, shown)| is_left(here, shown, replaces))
}

/// Whether one pixel shows what is left of its layers by such a rule.
fn is_left(
    here: &[Layer<'_>],
    shown: u8,
    replaces: &dyn Fn(&Layer<'_>, &Layer<'_>) -> bool,
) -> bool {
    let kept = here.iter().reduce(|kept, new| if replaces(kept, new) { new } else { kept });
    kept.map_or(0, |kept| kept.number as u8 + 1) == shown
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
        does: MistakeId::NotClipped.name(),
        repair: "clip at the near plane before the division",
        refuted: "a corner behind that is cut off",
        clip: |c, _| c.to_vec(),
    },
    NearMistake {
        does: MistakeId::CutTrianglesDropped.name(),
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
        does: MistakeId::ClippedAtZero.name(),
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
        does: "clips at z = -|w|: the sign of w is lost",
        repair: "clip at z = -w, and keep the sign of w",
        refuted: "a corner of negative w that is cut off",
        clip: |c, _| clip(c, |[_, _, z, w, _]| z + w.abs(), between),
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
        does: "gives the corners of what is left the other way round, so that it turns its back",
        repair: "go round the triangle in the order of its corners",
        refuted: "a polygon in the order of the corners",
        clip: |c, near| {
            let mut left = clip(c, near, between);
            left.reverse();
            left
        },
    },
    NearMistake {
        does: "divides x, y, z and w of each corner by its own w before it clips",
        repair: "clip in clip space, and leave the division to the stage after it",
        refuted: "a corner whose w is not 1",
        clip: |c, _| {
            let divided = c.map(|[x, y, z, w, a]| [x / w, y / w, z / w, 1.0, a]);
            clip(divided, |[_, _, z, w, _]| z + w, between)
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

/// An edge that is cut: the corner that stays, the one that goes, and the part of the way between them; and whether the one
/// that stays comes first.
struct Edge {
    kept: ClipCorner,
    lost: ClipCorner,
    t: f64,
    is_forward: bool,
    /// What becomes of the part of the way, where that is a mistake.
    cut: Part,
}

impl Edge {
    /// The number where the part is counted from the end that comes first.
    fn of_first(&self, k: usize) -> f64 {
        match self.is_forward {
            true => self.with(k, (self.cut)(self.t)),
            false => self.lost[k] + (self.kept[k] - self.lost[k]) * (self.cut)(1.0 - self.t),
        }
    }

    /// The number where the edge is divided by other distances of its ends.
    fn divided(&self, k: usize, distance: fn(ClipCorner) -> f64) -> f64 {
        let [a, b] = [distance(self.kept), distance(self.lost)];
        self.kept[k] + (self.lost[k] - self.kept[k]) * (a / (a - b))
    }

    fn with(&self, k: usize, t: f64) -> f64 {
        self.kept[k] + (self.lost[k] - self.kept[k]) * t
    }

    /// The number of a corner that is divided by its w.
    fn over_w(&self, k: usize) -> f64 {
        let (a, b) = (self.kept[k] / self.kept[3], self.lost[k] / self.lost[3]);
        a + (b - a) * self.t
    }
}

/// What a new corner gets in place of a number.
type New = fn(&Edge, usize) -> f64;
const NEW: [(New, &str); 26] = [
    (|e, k| e.kept[k], "keeps {} of the corner that stays at a new corner"),
    (|e, k| e.lost[k], "keeps {} of the corner that is cut off at a new corner"),
    (
        |e, k| if e.is_forward { e.kept[k] } else { e.lost[k] },
        "keeps {} of the first end of an edge at a new corner",
    ),
    (
        |e, k| if e.is_forward { e.lost[k] } else { e.kept[k] },
        "keeps {} of the second end of an edge at a new corner",
    ),
    (|e, k| e.with(k, 0.5), "gives a new corner the mean of both ends for {}"),
    (
        |e, k| {
            let (a, b) = ((1.0 - e.t) / e.kept[3], e.t / e.lost[3]);
            (a * e.kept[k] + b * e.lost[k]) / (a + b)
        },
        "interpolates {} at a new corner with a correction for perspective",
    ),
    (
        |e, k| e.over_w(k) * e.with(3, e.t),
        "divides {} by w before it interpolates at a new corner, and multiplies by the new w",
    ),
    (|_, _| 0.0, "gives a new corner 0 for {}"),
    (|_, _| 1.0, "gives a new corner 1 for {}"),
    (
        |e, k| e.over_w(k),
        "divides {} by w before it interpolates at a new corner, and does not multiply back",
    ),
    (
        |e, k| {
            let (a, b) = (e.kept[k] * e.kept[3], e.lost[k] * e.lost[3]);
            (a + (b - a) * e.t) / e.with(3, e.t)
        },
        "multiplies {} by w before it interpolates at a new corner, and divides by the new w",
    ),
    (|e, k| e.divided(k, |p| p[2]), "divides {} of an edge by z alone, as if the plane were z = 0"),
    (|e, k| e.divided(k, |p| p[3]), "divides {} of an edge by w alone, as if the plane were w = 0"),
    (
        |e, k| e.divided(k, |p| p[2] / p[3] + 1.0),
        "divides {} of an edge by distances after the division by w",
    ),
    (|e, k| e.with(k, e.t).abs(), "loses the sign of {} of a new corner"),
    (|e, k| e.with(k, e.t) / e.with(3, e.t), "divides {} of a new corner by its w"),
    (|e, k| e.with(k, e.t) * e.with(3, e.t), "multiplies {} of a new corner by its w"),
    (
        |e, k| (e.with(k, e.t) * 255.0).round() / 255.0,
        "keeps {} of a new corner in steps of 1/255, rounded",
    ),
    (
        |e, k| (e.with(k, e.t) * 255.0 + 0.5).floor() / 255.0,
        "keeps {} of a new corner in steps of 1/255, rounded, halves up",
    ),
    (|e, k| values::rounded(e.with(k, e.t), 2), "keeps {} of a new corner in floats of 16 bits"),
    (|e, k| values::rounded(e.with(k, e.t), 0), "keeps {} of a new corner in floats of 32 bits"),
    (|e, k| e.with(k, e.t).max(0.1), "raises {} of a new corner to 0.1 at least"),
    (|e, k| e.with(k, e.t).max(0.01), "raises {} of a new corner to 0.01 at least"),
    (|e, k| e.with(k, e.t).max(1.0), "raises {} of a new corner to 1 at least"),
    (|e, k| e.with(k, e.t).clamp(0.0, 1.0), "clamps {} of a new corner to 0 to 1"),
    (|e, k| e.with([1, 0, 2, 3, 4][k], e.t), "exchanges {} of a new corner"),
];

/// What becomes of the part of the way between two corners.
type Part = fn(f64) -> f64;
const CUT: [(Part, &str); 12] = [
    (|t| 1.0 - t, "that is counted from the wrong end (t is 1 - t)"),
    (|t| t * t, "that is squared"),
    (|t| values::rounded(t, 2), "that is a float of 16 bits"),
    (|t| values::rounded(t, 0), "that is a float of 32 bits"),
    (|t| (t * 256.0).round() / 256.0, "that is rounded to 1/256"),
    (|t| (t * 256.0).floor() / 256.0, "that is cut to 1/256"),
    (|t| (t * 1024.0).round() / 1024.0, "that is rounded to 1/1024"),
    (|t| (t * 65536.0).round() / 65536.0, "that is rounded to 1/65536"),
    (|t| (t * 65536.0).floor() / 65536.0, "that is cut to 1/65536"),
    (|t| t.min(0.5), "that is 1/2 at most"),
    (|t| t.max(0.5), "that is 1/2 at least"),
    (|t| t / (2.0 * t - 1.0), "of the sum of the distances, where their difference is right"),
];

/// Another plane, on which all new corners lie, and how it is said.
fn found_plane(
    all: &[Answered],
    is_wrong: &[bool],
    tolerance: f64,
) -> Option<(usize, f64, String)> {
    let mut made: Vec<ClipCorner> = Vec::new();
    for &i in chosen_by(is_wrong).iter().filter(|&&i| is_wrong[i]) {
        for (question, answer) in all[i].questions.iter().zip(&all[i].answers) {
            let (Some(triangle), Some(polygon)) = (asked(&question.of), answer.polygon()) else {
                continue;
            };
            let corners = clip_corners(&triangle);
            let is_new = |p: &&ClipCorner| corners.iter().all(|corner| corner[..4] != p[..4]);
            made.extend(polygon.iter().filter(is_new));
        }
    }
    let first = made.first()?;
    [(0, "w = {}"), (1, "z = {}"), (2, "z = {} w"), (3, "z + w = {}")].into_iter().find_map(
        |(kind, said)| {
            let at = on_plane(*first, kind);
            // Where z is divided by w, both may be small.
            let off = |p: &ClipCorner| match kind {
                2 => (p[2] - at * p[3]).abs() / (p[2].abs() + p[3].abs()).max(f64::MIN_POSITIVE),
                _ => (on_plane(*p, kind) - at).abs() / at.abs().max(1.0),
            };
            let is_on = |p: &ClipCorner| off(p) <= 10.0 * tolerance;
            let at_said = (at * 1e6).round() / 1e6;
            (made.len() > 8 && made.iter().all(is_on))
                .then(|| (kind, at, said.replace("{}", &at_said.to_string())))
        },
    )
}

/// A number that is the same on all of a plane of this kind.
fn on_plane([_, _, z, w, _]: ClipCorner, kind: usize) -> f64 {
    [w, z, z / w, z + w][kind]
}

fn of_near<'a>(all: &'a [Answered], is_wrong: &[bool], declared: &Declared) -> Vec<Hypothesis<'a>> {
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
            let left = clip(corners);
            let is_same = |left: &[ClipCorner], times| {
                same_polygon(left, polygon, &corners, times * tolerance)
            };
            let right = self::clip(corners, near, between);
            // A division by 0 may give anything but the right polygon.
            if left.iter().flatten().any(|v| !v.is_finite()) {
                return !is_same(&right, 1.0);
            }
            // Predictions are rounded too; but what is as near to the right polygon explains nothing.
            is_same(&left, 1.0) || (is_same(&left, 10.0) && !is_same(&right, 10.0))
        })
    };
    let mut hypotheses: Vec<_> = NEAR
        .iter()
        .map(|m| of(m.does.to_owned(), m.repair, m.refuted, Box::new(move |c| (m.clip)(c, near))))
        .collect();
    for lost in 0..3 {
        let does =
            format!("loses the {} corner of a quadrilateral", ["first", "second", "third"][lost]);
        let clip = move |c| {
            let mut left = clip(c, near, between);
            if left.len() > 3 {
                left.remove(lost);
            }
            left
        };
        let (repair, refuted) =
            ("a triangle that is cut can have four corners", "an answer with four corners");
        hypotheses.push(of(does, repair, refuted, Box::new(clip)));
    }
    if let Some((kind, at, said)) = found_plane(all, is_wrong, tolerance) {
        let clip = move |corners| {
            clip(
                corners,
                |p| match kind {
                    2 => p[2] - at * p[3],
                    _ => on_plane(p, kind) - at,
                },
                between,
            )
        };
        let repair = "clip at the near plane that is declared";
        let refuted = "a new corner that lies elsewhere";
        hypotheses.push(of(format!("clips at {said}"), repair, refuted, Box::new(clip)));
    }
    let whole: Part = |t| t;
    let mut made: Vec<(New, Part, String)> =
        NEW.into_iter().map(|(new, does)| (new, whole, does.to_owned())).collect();
    for (cut, said) in CUT {
        let does = |from, at| format!("divides {{}} of an edge{at} by a part{from} {said}");
        let first = ", counted from its first end,";
        let [leaves, back] = [" that leaves", " that comes back"];
        let all: [(New, &str, &str); 5] = [
            (|e, k| e.with(k, (e.cut)(e.t)), "", ""),
            (Edge::of_first, first, ""),
            (|e, k| e.with(k, if e.is_forward { (e.cut)(e.t) } else { e.t }), "", leaves),
            (|e, k| e.with(k, if e.is_forward { e.t } else { (e.cut)(e.t) }), "", back),
            (|e, k| if e.is_forward { e.with(k, e.t) } else { e.of_first(k) }, first, back),
        ];
        made.extend(all.map(|(new, from, at)| (new, cut, does(from, at))));
    }
    for (numbers, said) in NUMBERS {
        // A corner in the plane may be given once more as a new one, or not.
        for ((new, cut, does), again) in made.iter().flat_map(|new| [(new, true), (new, false)]) {
            let (new, cut) = (*new, *cut);
            let repair = "a new corner divides the edge as the distances of its ends to the plane do, in all of x, y, z, w and attributes";
            let clip = move |corners| {
                clip(corners, near, |kept, lost, t| {
                    let mut made = between(kept, lost, t);
                    let is_forward =
                        (0..3).any(|i| corners[i] == kept && corners[(i + 1) % 3] == lost);
                    let edge = Edge { kept, lost, t, is_forward, cut };
                    for &k in numbers.iter().filter(|_| again || t > 0.0) {
                        made[k] = new(&edge, k);
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
    let bounds = bounds(corners, tolerance);
    let near = |p: &ClipCorner, q: &ClipCorner| {
        // Wrong numbers may be larger than those of the corners.
        let is_near =
            |((p, q), bound): ((&f64, &f64), f64)| (p - q).abs() <= bound.max(tolerance * p.abs());
        p.iter().zip(q).zip(bounds).all(is_near)
    };
    let has_area = |polygon: &[ClipCorner]| polygon.len() > 2;
    (!has_area(a) && !has_area(b)) || is_round(a.len(), b.len(), |i, j| near(&a[i], &b[j]))
}
