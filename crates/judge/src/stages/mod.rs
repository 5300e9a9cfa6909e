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
use std::ops::Range;

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
use rasterproof_verify::cases::facts::{self, TOPICS, Topic};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::mistakes::values;
use rasterproof_verify::mistakes::{
    ENOUGH_WRONG, Explanation, Hypothesis, MistakeId, Mistakes, chosen_by, of_answers,
};
use sample_values::SampleShading;
use samples::SampleMask;
use search::{AnswerParts, Quantity, Spot, common, explains_all, no_parts};
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

/// Asks cases of some families until enough answers are wrong, and judges the answers.
async fn answered(
    asker: &StageAsker,
    check: Check,
    families: &[&str],
    truth: &Truth,
) -> Vec<Answered> {
    let mut all: Vec<Answered> = Vec::new();
    let (mut wrong, mut deaths) = (0, 0);
    for seed in SEED..SEED + MOST_ROUNDS {
        for &name in families {
            // After the first round, only where few answers are wrong some more are needed.
            if seed > SEED && (wrong == 0 || wrong >= ENOUGH_WRONG) {
                return all;
            }
            let (family, topic) = (adapt_case::family(name), topic(name));
            let mut rng = Rng::new(name, seed, 0);
            // Deep piles take long to look at.
            let is_deep = family.is_some_and(|family| family.name == PILES);
            let count = if is_deep { PILES_ASKED } else { CASES };
            for index in 0..count / families.len() as u64 {
                if deaths >= MOST_DEATHS {
                    return all;
                }
                let case: Case = match (family, topic) {
                    // Questions like those of the design, which itself takes seconds.
                    (_, Some(topic)) => adapt_case::put(topic.any(&mut rng), &truth.declared),
                    (Some(family), _) => adapt_case::case(family, seed, index, &truth.declared),
                    _ => break,
                };
                let mut questions = Vec::new();
                check.questions(&case, truth, &mut questions);
                let answers = asker.ask(&questions).await;
                deaths += answers.iter().filter(|answer| answer.is_death()).count() as u64;
                // Where an answer is missing, the case cannot be judged.
                if answers.len() < questions.len() || answers.iter().any(is_missing) {
                    continue;
                }
                let judged = check.judge(&case, &answers, truth);
                let is_wrong = match check {
                    // Their pixels are judged as coverage.
                    Check::Values => judged.finding.worst() > 1.0,
                    Check::SampleValues => judged.is_wrong(),
                    _ => judged.finding.tally.total() > 0,
                };
                wrong += usize::from(is_wrong);
                all.push(Answered { questions, answers, is_wrong });
            }
        }
    }
    all
}

/// The kind of question with this name.
fn topic(name: &str) -> Option<&'static Topic> {
    TOPICS.iter().find(|topic| topic.name == name)
}

/// Whether nothing can be judged in place of an answer.
fn is_missing(answer: &Answer) -> bool {
    matches!(answer, Answer::Refused(_) | Answer::Died(_))
}

/// The families in which the mistakes of a check differ.
fn families(check: Check) -> &'static [&'static str] {
    match check {
        Check::Values => values::FAMILIES,
        Check::Samples => &["uniform", "half-integer"],
        Check::SampleValues => &["w-4", facts::sample_values::TOPIC.name],
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

/// The mistake of those that are known, or what is learned where none of them predicts every answer.
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
    // What is known is tried first, by cases of the families.
    let mut all = answered(asker, check, families(check), truth).await;
    // Piles of many triangles are those of the design alone.
    if check == Check::Depth {
        all.extend(answered(asker, check, &[PILES], truth).await);
    }
    let found = known(check, &all, truth, programs);
    if found.as_ref().is_some_and(Mistakes::is_known) {
        return found;
    }
    // Then the learner asks questions of its own.
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
        _ => of_stage(check, all, &truth.declared, programs),
    }
}

/// The stage that a check judges, with no parts yet; nothing of values, whose mistakes are the recipes of
/// [`values`](rasterproof_verify::mistakes::values), and of other checks.
fn stage_of<'a>(check: Check) -> Option<Box<dyn AnswerParts<'a> + 'a>> {
    Some(match check {
        Check::Samples => no_parts::<SampleMask>(),
        Check::SampleValues => no_parts::<SampleShading>(),
        Check::Depth => no_parts::<DepthTest>(),
        Check::Near | Check::Carried => no_parts::<NearCut>(),
        Check::Wide => no_parts::<WideDrawn>(),
        Check::Area => no_parts::<AreaDrawn>(),
        _ => return None,
    })
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
            let mut found = Vec::new();
            for known in hypotheses_of_values(all, &is_wrong, truth.declared.tolerance) {
                if (0..all.len()).all(|i| (known.predicts)(i)) {
                    found.extend(MistakeId::of(&known.says.does));
                }
            }
            found
        }
        _ => identified(check, all, &truth.declared),
    }
}

/// Whether no answer shows anything.
fn is_blank(all: &[Answered]) -> bool {
    !all.is_empty() && all.iter().flat_map(|a| &a.answers).all(Answer::is_blank)
}

/// The parts of all answers, and which of them are those of each case.
struct PartsByCase<'a> {
    parts: Box<dyn AnswerParts<'a> + 'a>,
    /// The places of the parts of each case.
    cases: Vec<Range<usize>>,
}

impl<'a> PartsByCase<'a> {
    /// The parts of all answers for a check; nothing of checks that have no stage.
    fn new(check: Check, all: &'a [Answered], declared: &Declared, noise: f64) -> Option<Self> {
        let mut parts = stage_of(check)?;
        let mut cases = Vec::new();
        for answered in all {
            let first = parts.count();
            for (question, answer) in answered.questions.iter().zip(&answered.answers) {
                parts.add(question, answer, declared, noise);
            }
            cases.push(first..parts.count());
        }
        Some(Self { parts, cases })
    }

    /// The places of all parts.
    fn places(&self) -> Vec<usize> {
        (0..self.parts.count()).collect()
    }
}

/// The mistakes of one field that explain every part, of those that have an identifier.
fn identified(check: Check, all: &[Answered], declared: &Declared) -> Vec<MistakeId> {
    let mut found = Vec::new();
    let Some(stage) = stage_of(check) else { return found };
    for noise in stage.noises() {
        let Some(by_case) = PartsByCase::new(check, all, declared, *noise) else { break };
        let (parts, places) = (&*by_case.parts, by_case.places());
        for value in parts.singles(&places) {
            if explains_all(parts, &value, &places) {
                found.extend(MistakeId::of(&parts.says(&value, "").does));
            }
        }
    }
    found
}

/// The mistake in a stage, with the least noise of numbers that explains it.
fn of_stage(
    check: Check,
    all: &[Answered],
    declared: &Declared,
    programs: &[(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
    // Less noise explains less, so that what is found with the least is most certain.
    let mut found = None;
    for noise in stage_of(check)?.noises() {
        let PartsByCase { parts, cases } = PartsByCase::new(check, all, declared, *noise)?;
        let parts = &*parts;
        // Where nothing is drawn, every mistake that may draw nothing explains it.
        let mut hypotheses = Vec::new();
        if !is_blank(all) {
            for mistake in search::search(parts, &cases, &is_wrong) {
                let says = mistake.says(parts);
                let cases = &cases;
                let predicts =
                    move |i: usize| cases[i].clone().all(|place| mistake.explains(parts, place));
                hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
            }
        }
        found = concluded(hypotheses, all, &is_wrong, declared, programs);
        if found.as_ref().is_some_and(Mistakes::is_known) {
            return found;
        }
        // Without a mistake that explains all, it is said what the wrong parts have in common.
        if let Some(found) = &mut found {
            let right = parts.right();
            let mut wrong = Vec::new();
            for place in 0..parts.count() {
                if !parts.explains(&right, place) {
                    wrong.push(parts.observations(place));
                }
            }
            found.common = common(parts.whom(), &wrong);
        }
    }
    found
}

/// What is found by hypotheses and programs. A mistake that does not predict every answer is none.
fn concluded<'a>(
    mut hypotheses: Vec<Hypothesis<'a>>,
    all: &'a [Answered],
    is_wrong: &[bool],
    declared: &Declared,
    programs: &'a [(RefCell<Inside>, String)],
) -> Option<Mistakes> {
    // The planted faults and the published algorithms are hypotheses, too: each answers the same questions.
    let tolerance = declared.tolerance;
    for (known, about) in programs {
        let says = Explanation::of_program(known.borrow().name(), about.clone());
        hypotheses.push(hypothesis(all, says, move |question, answer| {
            let predicted = known.borrow_mut().ask(std::slice::from_ref(question), 1);
            predicted.first().is_some_and(|p| agree(question, answer, p, tolerance))
        }));
    }
    let mut found = of_answers(hypotheses, is_wrong)?;
    // A cause that misses an answer leads on at most, since something else must be wrong.
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
    // A value may be off by the tolerance, as a share of the largest one of its kind.
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
    // Without a mistake that explains all, it is said what the wrong pixels have in common.
    if !found.is_known() {
        let mut wrong = Vec::new();
        for answered in all.iter().filter(|answered| answered.is_wrong) {
            for (question, triangle, fragments) in answered.of_values() {
                let window = PixelRect::window(question.width, question.height);
                for fragment in fragments {
                    let pixel = ValuedPixel::new(triangle, fragment, window, declared.tolerance);
                    if pixel.is_right != [true; 3] {
                        wrong.push(pixel.quantities());
                    }
                }
            }
        }
        found.common = common("pixels", &wrong);
    }
    Some(found)
}

/// A pixel with the values that are right in it: depth and both attributes.
struct ValuedPixel {
    spot: Spot,
    /// Depth and both attributes.
    is_right: [bool; 3],
}

impl ValuedPixel {
    /// What may be said of it, beside its place: which of its values are right.
    fn quantities(&self) -> Vec<Quantity> {
        let mut all = self.spot.quantities();
        let [depth, first, second] = self.is_right;
        all.push(Quantity::whether(depth, "of right depth", ""));
        all.push(Quantity::whether(first, "of a right first attribute", ""));
        all.push(Quantity::whether(second, "of a right second attribute", ""));
        all
    }

    /// A pixel, with each of its values looked at alone: the other two are taken to be right.
    fn new(t: &Triangle, f: &Fragment<DVec2>, window: PixelRect, tolerance: f64) -> Self {
        // Each value is looked at in a pixel whose other values are right.
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

/// A question about the values of a triangle, with the fragments of its answer.
type ValuesAnswered<'a> = (&'a Question, &'a Triangle, &'a [Fragment<DVec2>]);

impl Answered {
    /// Its questions about values that were answered.
    fn of_values(&self) -> Vec<ValuesAnswered<'_>> {
        let mut found = Vec::new();
        for (question, answer) in self.questions.iter().zip(&self.answers) {
            if let (Asked::Values(triangle), Answer::Values(fragments)) = (&question.of, answer) {
                found.push((question, triangle, &fragments[..]));
            }
        }
        found
    }
}

/// The mistakes in values that may explain these answers: the recipes with the numbers that are read off some of them.
fn hypotheses_of_values<'a>(
    all: &'a [Answered],
    is_wrong: &[bool],
    tolerance: f64,
) -> Vec<Hypothesis<'a>> {
    // Of the chosen cases, two pixels of each triangle, and whether the triangle has a wrong value.
    let (mut pixels, mut triangles) = (Vec::new(), Vec::new());
    for chosen in chosen_by(is_wrong) {
        for (_, triangle, fragments) in all[chosen].of_values() {
            pixels.extend(fragments.iter().take(2).map(|f| values::pixel_of(triangle, f)));
            let right = |pixel| Some(values::right_at(triangle, pixel));
            triangles.push((triangle, !are_near(triangle, fragments, &right, tolerance)));
        }
    }
    let mut hypotheses = Vec::new();
    for recipe in values::of_values(values::scaled(&pixels), &triangles) {
        let says = recipe.says.clone();
        let predicts = move |question: &Question, answer: &Answer| match (&question.of, answer) {
            (Asked::Values(triangle), Answer::Values(fragments)) => {
                let predict = |pixel| recipe.predict(triangle, pixel);
                are_near(triangle, fragments, &predict, tolerance)
            }
            _ => true,
        };
        hypotheses.push(hypothesis(all, says, predicts));
    }
    hypotheses
}
