//! Mistakes beside coverage: in values, in the four samples of a pixel, in which triangle is seen, and at the near plane.
//!
//! What a program does in such a stage is a value: `depth::DepthTest`, `samples::SampleMask` or `near::NearCut`, whose
//! fields are right by default. One function predicts the answers of any value, and a mistake is one or two fields that are
//! wrong, everywhere or in some places: `search` looks for those that predict every answer. To add a mistake, add a value to a
//! field, with its words.

mod area;
mod depth;
mod grids;
mod learn;
mod near;
mod sample_values;
mod samples;
mod search;
#[cfg(test)]
mod tests;
mod wide;

use std::cell::RefCell;

use super::adapt_case;
use super::ask::{Answer, Asked, Question, Subject as _};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::in_process::Inside;
use super::run::MOST_DEATHS;
use area::AreaDrawn;
use depth::DepthTest;
use glam::DVec2;
use near::NearCut;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Fragment;
use rasterproof_verify::ask::{Asker, Search};
use rasterproof_verify::cases::facts::{self, TOPICS};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::mistakes::values::{self, ValueHypothesis};
use rasterproof_verify::mistakes::{
    ENOUGH_WRONG, Explanation, Hypothesis, MistakeId, Mistakes, chosen_by, of_answers,
};
use sample_values::SampleShading;
use samples::SampleMask;
use search::{Mistake, Quantity, Says, Spot, Stage, common, of_pixels};
use wide::WideDrawn;

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
/// The kind of question that has deep piles, and how many of them are asked.
const PILES: &str = facts::depth::TOPIC.name;
const PILES_ASKED: u64 = 150;
/// The questions are the same in every run.
const SEED: u64 = 7;

/// Asks the program that is judged, for the search of its mistake.
type StageAsker = Asker<Question, Answer>;

async fn answered(
    asker: &StageAsker,
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
        let family = adapt_case::family(name);
        let mut rng = Rng::new(name, seed, 0);
        // Deep piles take long to look at.
        let count = if family.is_some_and(|f| f.name == PILES) { PILES_ASKED } else { CASES };
        for index in 0..count / families.len() as u64 {
            if deaths >= MOST_DEATHS {
                return all;
            }
            let case: Case = match (family, TOPICS.iter().find(|topic| topic.name == *name)) {
                // Questions like those of the design, which itself takes seconds.
                (_, Some(topic)) => adapt_case::put(topic.any(&mut rng), &truth.declared),
                (Some(family), _) => adapt_case::case(family, seed, index, &truth.declared),
                _ => break,
            };
            let mut questions = Vec::new();
            check.questions(&case, truth, &mut questions);
            let answers = asker.ask(&questions).await;
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
                Check::SampleValues => judged.is_wrong(),
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
        Check::SampleValues => &["w-4", facts::values::TOPIC.name],
        Check::Depth => &["depth-order", "depth-near-tie"],
        Check::Near | Check::Carried => &["near-plane"],
        Check::Wide => &["wide-line"],
        Check::Area => &["area"],
        _ => &[],
    }
}

/// The search for the mistake of a program in what this check judges, where it is wrong. Where none of those that are known
/// explains it, it is learned what it does and when.
pub fn mistakes<'a>(
    check: Check,
    truth: &'a Truth,
    programs: &'a [(RefCell<Inside>, String)],
) -> Search<'a, Question, Answer, Option<Mistakes>> {
    Search::new(async move |asker| known_or_learned(&asker, check, truth, programs).await)
}

async fn known_or_learned(
    asker: &StageAsker,
    check: Check,
    truth: &Truth,
    programs: &[(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    // Of formulas the course knows the mistakes.
    if families(check).is_empty() {
        return None;
    }
    let mut all = answered(asker, check, families(check), truth).await;
    // Piles of many triangles are those of the design alone.
    if check == Check::Depth {
        all.extend(answered(asker, check, &[PILES], truth).await);
    }
    let found = known(check, &all, truth, programs);
    if found.as_ref().is_some_and(Mistakes::is_known) {
        return found;
    }
    let learned = learn::learn(asker, check, truth).await;
    // None of the answers so far may be wrong where others are.
    let found = found.or_else(|| {
        learned.as_ref()?;
        let mut none = Mistakes::default();
        none.wrong.of = all.len() as u64;
        Some(none)
    });
    found.map(|found| found.with_learned(learned))
}

/// The mistake of those that are known.
fn known(
    check: Check,
    all: &[Answered],
    truth: &Truth,
    programs: &[(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    match check {
        Check::Values => of_values(all, &truth.declared, programs),
        Check::Samples => of_stage::<SampleMask>(all, &truth.declared, programs),
        Check::SampleValues => of_stage::<SampleShading>(all, &truth.declared, programs),
        Check::Depth => of_stage::<DepthTest>(all, &truth.declared, programs),
        Check::Near | Check::Carried => of_stage::<NearCut>(all, &truth.declared, programs),
        Check::Wide => of_stage::<WideDrawn>(all, &truth.declared, programs),
        Check::Area => of_stage::<AreaDrawn>(all, &truth.declared, programs),
        _ => None,
    }
}

/// The mistakes that predict every one of these answers, of those that have an identifier.
#[must_use]
pub fn explaining(check: Check, all: &[Answered], truth: &Truth) -> Vec<MistakeId> {
    // Where nothing is drawn, every mistake that may draw nothing explains it.
    if is_blank(all) {
        return Vec::new();
    }
    match check {
        Check::Values => {
            let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
            let known = hypotheses_of_values(all, &is_wrong, truth.declared.tolerance);
            let explains = |known: &Hypothesis<'_>| (0..all.len()).all(|i| (known.predicts)(i));
            let known = known.into_iter().filter(explains);
            known.filter_map(|known| MistakeId::of(&known.says.does)).collect()
        }
        Check::Samples => identified::<SampleMask>(all, &truth.declared),
        Check::SampleValues => identified::<SampleShading>(all, &truth.declared),
        Check::Depth => identified::<DepthTest>(all, &truth.declared),
        Check::Near | Check::Carried => identified::<NearCut>(all, &truth.declared),
        Check::Wide => identified::<WideDrawn>(all, &truth.declared),
        Check::Area => identified::<AreaDrawn>(all, &truth.declared),
        _ => Vec::new(),
    }
}

fn is_blank(all: &[Answered]) -> bool {
    !all.is_empty() && all.iter().flat_map(|a| &a.answers).all(Answer::is_blank)
}

/// What is answered in each case.
fn parts<'a, S: Stage>(
    all: &'a [Answered],
    declared: &Declared,
    noise: f64,
) -> Vec<Vec<S::Part<'a>>> {
    let of_case = |a: &'a Answered| {
        let questions = a.questions.iter().zip(&a.answers);
        questions
            .flat_map(|(question, answer)| S::parts(question, answer, declared, noise))
            .collect()
    };
    all.iter().map(of_case).collect()
}

fn identified<S: Stage>(all: &[Answered], declared: &Declared) -> Vec<MistakeId> {
    let mut found = Vec::new();
    for noise in S::NOISE {
        let parts = parts::<S>(all, declared, *noise);
        let parts: Vec<_> = parts.iter().flatten().collect();
        let singles = search::singles::<S>(&parts).into_iter();
        let explaining = singles.filter(|value| parts.iter().all(|part| value.explains(part)));
        found.extend(
            explaining.filter_map(|value| MistakeId::of(&Mistake::plain(value).says().does)),
        );
    }
    found
}

/// The mistake in a stage, with the least noise of numbers that explains it.
fn of_stage<S: Stage>(
    all: &[Answered],
    declared: &Declared,
    programs: &[(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let mut found = None;
    for noise in S::NOISE {
        let cases = parts::<S>(all, declared, *noise);
        let mistakes =
            if is_blank(all) { Vec::new() } else { search::search::<S>(&cases, &is_wrong) };
        let hypotheses = mistakes.into_iter().map(|mistake| weighed(mistake, &cases)).collect();
        found = concluded(hypotheses, all, &is_wrong, declared, programs);
        if found.as_ref().is_some_and(Mistakes::is_known) {
            return found;
        }
        let right = S::default();
        let wrong: Vec<_> = cases.iter().flatten().filter(|part| !right.explains(part)).collect();
        if let Some(found) = &mut found {
            found.common = common(S::WHOM, &wrong, S::observations());
        }
    }
    found
}

fn weighed<'c, 'a, S: Stage>(
    mistake: Mistake<'a, S>,
    cases: &'c [Vec<S::Part<'a>>],
) -> Hypothesis<'c>
where
    'a: 'c,
{
    let says = mistake.says();
    let predicts = move |i: usize| cases[i].iter().all(|part| mistake.explains(part));
    Hypothesis { predicts: Box::new(predicts), says }
}

/// What is found by hypotheses and programs. A mistake that does not predict every answer is none.
fn concluded<'a>(
    mut hypotheses: Vec<Hypothesis<'a>>,
    all: &'a [Answered],
    is_wrong: &[bool],
    declared: &Declared,
    programs: &'a [(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    let tolerance = declared.tolerance;
    for (known, about) in programs {
        let says = Explanation::of_program(known.borrow().name(), about.clone());
        hypotheses.push(hypothesis(all, says, move |question, answer| {
            let predicted = known.borrow_mut().ask(std::slice::from_ref(question), 1);
            predicted.first().is_some_and(|p| agree(question, answer, p, tolerance))
        }));
    }
    let mut found = of_answers(hypotheses, is_wrong)?;
    let misses = |cause: &Explanation| {
        cause.wrong.drawn < cause.wrong.of || cause.right.drawn < cause.right.of
    };
    if let Some(at) = found.causes.iter().position(misses) {
        let missing = found.causes.remove(at);
        found.causes.retain(|cause| !misses(cause));
        found.lead = found.causes.is_empty().then_some(missing);
    }
    Some(found)
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
/// The mistake in values.
fn of_values(
    all: &[Answered],
    declared: &Declared,
    programs: &[(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    let hypotheses = match is_blank(all) {
        true => Vec::new(),
        false => hypotheses_of_values(all, &is_wrong, declared.tolerance),
    };
    let mut found = concluded(hypotheses, all, &is_wrong, declared, programs)?;
    if !found.is_known() {
        let mut pixels = Vec::new();
        for Answered { questions, answers, .. } in all.iter().filter(|a| a.is_wrong) {
            for (question, answer) in questions.iter().zip(answers) {
                let (Asked::Values(triangle), Answer::Values(fragments)) = (&question.of, answer)
                else {
                    continue;
                };
                let window = PixelRect::window(question.width, question.height);
                pixels.extend(
                    fragments
                        .iter()
                        .map(|f| ValuedPixel::new(triangle, f, window, declared.tolerance)),
                );
            }
        }
        let wrong: Vec<_> = pixels.iter().filter(|pixel| pixel.is_right != [true; 3]).collect();
        let whether =
            |of: fn(&ValuedPixel) -> f64, yes| Quantity { of, says: Says::Whether([yes, ""]) };
        let mut quantities = of_pixels::<ValuedPixel>();
        quantities.extend([
            whether(|p| f64::from(u8::from(p.is_right[0])), "of right depth"),
            whether(|p| f64::from(u8::from(p.is_right[1])), "of a right first attribute"),
            whether(|p| f64::from(u8::from(p.is_right[2])), "of a right second attribute"),
        ]);
        found.common = common("pixels", &wrong, quantities);
    }
    Some(found)
}

/// A pixel with the values that are right in it: depth and both attributes.
struct ValuedPixel {
    spot: Spot,
    is_right: [bool; 3],
}

impl AsRef<Spot> for ValuedPixel {
    fn as_ref(&self) -> &Spot {
        &self.spot
    }
}

impl ValuedPixel {
    fn new(t: &Triangle, f: &Fragment<DVec2>, window: PixelRect, tolerance: f64) -> Self {
        let [right, given] = values::pixel_of(t, f);
        let is_right = [0, 1, 2].map(|i| {
            let mut others = right;
            others[i] = given[i];
            let mut of_this = *f;
            (of_this.depth, of_this.varying) = (others[0], DVec2::new(others[1], others[2]));
            are_near(t, std::slice::from_ref(&of_this), &|_| Some(right), tolerance)
        });
        Self {
            spot: Spot { at: [f.x_px, f.y_px], is_clockwise: twice_area(&t.corners()) > 0, window },
            is_right,
        }
    }
}

fn hypotheses_of_values<'a>(
    all: &'a [Answered],
    is_wrong: &[bool],
    tolerance: f64,
) -> Vec<Hypothesis<'a>> {
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
