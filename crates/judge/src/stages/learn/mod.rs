//! Learns when a stage is wrong and what it does then, where no enumerated mistake predicts every answer.
//!
//! An explanation is a chain of up to three steps. A step is WHEN x WHAT: a *condition* over facts of the question and of a part
//! of its answer (a pixel, a sample, a value, a polygon), and a *change*: a wrong value of the stage, one field or two, or what is
//! read off the answers. What a step explains is subtracted, and the rest is explained again. A chain is believed only where it
//! predicts every part of enough new answers, among them answers beside wrong ones and at both sides of each limit.

mod chain;
mod depth;
mod learnable;
mod near;
mod pixels;
#[cfg(test)]
mod programs;
mod samples;
mod search;
mod values;

use std::marker::PhantomData;

use glam::DVec2;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::ScreenVertex;
use rasterproof_verify::cases::shrink::SmallerSearch;
use rasterproof_verify::cases::{Case, Shape, Triangle};
use rasterproof_verify::learn::Learned;
use rasterproof_verify::learn::trial::{
    self, AT_ONCE, ENOUGH_INDEPENDENT, ENOUGH_WRONG, FIRST, LEAST_WRONG, Learn, Trial, Work,
    nearest,
};

use super::area::AreaDrawn;
use super::sample_values::SampleShading;
use super::wide::WideDrawn;
use super::{StageAsker, families};
use crate::adapt_case;
use crate::ask::Answer;
use crate::check::{Check, Truth};
use crate::shrink::ProgramSteps;
use chain::{Chain, predicts};
use learnable::{AnyLearnable, AnyParts, LearnableOf, LearnedCase, of_case};
use search::Search;

/// The stage that a check judges, where its mistakes are learned.
fn stage_of(check: Check) -> Option<&'static dyn AnyLearnable> {
    Some(match check {
        Check::Values => &LearnableOf::<values::Values>(PhantomData),
        Check::Samples => &LearnableOf::<samples::Samples>(PhantomData),
        Check::Depth => &LearnableOf::<depth::Depths>(PhantomData),
        Check::Near | Check::Carried => &LearnableOf::<near::Polygons>(PhantomData),
        Check::Wide => &LearnableOf::<pixels::Pixels<WideDrawn>>(PhantomData),
        Check::SampleValues => &LearnableOf::<pixels::Pixels<SampleShading>>(PhantomData),
        Check::Area => &LearnableOf::<pixels::Pixels<AreaDrawn>>(PhantomData),
        _ => return None,
    })
}

/// The kind of question by whose facts the mistakes of a check are learned.
#[cfg(test)]
pub(super) fn topic(check: Check) -> Option<&'static rasterproof_verify::cases::facts::Topic> {
    stage_of(check).map(|stage| stage.topic())
}

/// Learns of a program that is wrong in a check.
pub async fn learn(asker: &StageAsker, check: Check, truth: &Truth) -> Option<Learned> {
    Learner::new(asker, check, truth, stage_of(check)?).learn().await
}

/// All questions that a program gets, at most.
const MOST_TO_LEARN: usize = 2400;
/// Questions before the first search, at most.
const MOST_FIRST: usize = 900;
/// New questions of each round: independent ones, and those beside wrong ones.
const FRESH: [usize; 2] = [180, 150];
/// How many times the independent ones are repeated with new ones, as long as too few of them are wrong.
const MOST_FRESH: usize = 3;
/// Cases beside those nearest to a limit that are made, and those of them that the program gets.
const NEAR_TRIED: usize = 200;
/// The program gets the nearest of them.
const NEAR_ASKED: usize = 16;
/// Questions for the nearest right case: two thirds make the wrong one smaller.
const NEAREST_ASKED: usize = 180;
/// The largest window, in square pixels.
const MOST_AREA: i32 = 4096;
/// The questions are the same in every run.
const SEED: u64 = 11;

/// Learns of one program in one check: what it was asked so far, and what it still may be asked.
struct Learner<'a> {
    stage: &'static dyn AnyLearnable,
    asker: &'a StageAsker,
    check: Check,
    truth: &'a Truth,
    /// Questions that may still be asked.
    left: usize,
    rng: Rng,
    /// How many cases of families were asked.
    number: u64,
    answered: Vec<LearnedCase>,
    /// Whether any part of each answer is wrong.
    is_wrong: Vec<bool>,
    /// How much the searches may still do.
    work: Work,
}

impl<'a> Learner<'a> {
    fn new(
        asker: &'a StageAsker,
        check: Check,
        truth: &'a Truth,
        stage: &'static dyn AnyLearnable,
    ) -> Self {
        Self {
            stage,
            asker,
            check,
            truth,
            // Some questions are kept for the nearest right case.
            left: asker.at_most(MOST_TO_LEARN).saturating_sub(NEAREST_ASKED),
            rng: Rng::new(stage.topic().name, SEED, 0),
            number: 0,
            answered: Vec::new(),
            is_wrong: Vec::new(),
            work: Work::default(),
        }
    }

    /// Asks until enough is wrong, explains it, and says how well the explanation predicts new answers.
    async fn learn(mut self) -> Option<Learned> {
        // Too few wrong answers tell nothing.
        self.ask_first().await?;
        if self.wrong().len() < LEAST_WRONG {
            return None;
        }
        let (trial, chain) = trial::explained(&mut self).await?;
        Some(self.learned(trial, &chain).await)
    }

    /// The numbers of the wrong answers so far.
    fn wrong(&self) -> Vec<usize> {
        (0..self.answered.len()).filter(|&i| self.is_wrong[i]).collect()
    }

    /// All parts of an answer.
    fn parts<'c>(&self, asked: &'c LearnedCase) -> Box<dyn AnyParts<'c> + 'c> {
        let mut parts = self.stage.no_parts();
        parts.add(asked, &self.truth.declared);
        parts
    }

    /// Asks for more until there are enough wrong answers; nothing where the program stops answering.
    async fn ask_first(&mut self) -> Option<()> {
        while self.answered.len() < MOST_FIRST && self.left > 0 {
            let wrong = self.wrong();
            if self.answered.len() >= FIRST && wrong.len() >= ENOUGH_WRONG {
                break;
            }
            // Two thirds are independent, and one third lies beside wrong ones, where most is to be learned.
            let cases = (0..AT_ONCE).map(|i| self.case(&wrong, i % 3 == 2)).collect();
            self.ask(cases).await?;
        }
        Some(())
    }

    /// A case of a family or at random, or one beside one of some answered ones.
    fn case(&mut self, given: &[usize], is_beside: bool) -> Case {
        if is_beside && !given.is_empty() {
            // Facts of a wrong case, mixed with those of another one: so one fact after another is changed.
            let one = given[self.any_below(given.len())];
            let other = self.any_below(self.answered.len());
            let [one, other] = [one, other].map(|i| &self.answered[i].case);
            let case = self.stage.topic().beside(&mut self.rng, one, other);
            return self.put(case);
        }
        // Cases of the families and cases at random take turns.
        self.number += 1;
        let names = families(self.check);
        let family = adapt_case::family(names[self.number as usize / 2 % names.len()]);
        match family.filter(|_| self.number.is_multiple_of(2)) {
            Some(family) => {
                let seed = SEED + self.number / 1000;
                adapt_case::case(family, seed, self.number % 1000, &self.truth.declared)
            }
            None => {
                let case = self.stage.topic().any(&mut self.rng);
                self.put(case)
            }
        }
    }

    /// A number below this one, at random.
    fn any_below(&mut self, count: usize) -> usize {
        self.rng.int(0, count as i64 - 1) as usize
    }

    /// Where the program draws, in a window that is not large: each of its pixels is looked at.
    fn put(&self, mut case: Case) -> Case {
        // Every pixel of a case is looked at, so that a large window is made lower.
        let window = &mut case.window;
        window.y1 = window.y1.min((MOST_AREA / window.x1.max(1)).max(1));
        adapt_case::put(case, &self.truth.declared)
    }

    /// Asks some cases, and keeps those that are answered; nothing where the program stops answering.
    async fn ask(&mut self, cases: Vec<Case>) -> Option<()> {
        // What leads to several questions is left out: an answer would not be that of a case.
        let (mut single, mut questions) = (Vec::new(), Vec::new());
        for case in cases.into_iter().flat_map(|case| self.singles(case)) {
            let mut of_case = Vec::new();
            self.check.questions(&case, self.truth, &mut of_case);
            if let (Some(question), true) = (of_case.pop(), of_case.is_empty()) {
                single.push(case);
                questions.push(question);
            }
        }
        // Only as many as the program still may be asked.
        let count = questions.len().min(self.left);
        self.left -= count;
        let answers = self.asker.ask(&questions[..count]).await;
        if answers.len() < count {
            return None;
        }
        for ((case, question), answer) in single.into_iter().zip(questions).zip(answers) {
            if matches!(answer, Answer::Refused(_) | Answer::Died(_)) {
                continue;
            }
            let facts = of_case(self.stage, &case, &self.truth.declared, false).values;
            let number = self.answered.len();
            let asked = LearnedCase { number, case, question, answer, facts, is_refuting: false };
            let is_wrong = !are_all_right(&*self.parts(&asked));
            self.is_wrong.push(is_wrong);
            self.answered.push(asked);
        }
        Some(())
    }

    /// A case for each question that a case leads to.
    fn singles(&self, case: Case) -> Vec<Case> {
        match (&case.shape, self.check) {
            (_, Check::Depth) => vec![case],
            (Shape::Triangles { list, .. }, _) => {
                let mut singles = Vec::new();
                // All of a mesh are alike, so two of them will do.
                for &triangle in list.iter().take(2) {
                    let shape = Shape::Triangles { list: vec![triangle], disjoint: true };
                    singles.push(Case { window: case.window, shape });
                }
                singles
            }
            _ => Vec::new(),
        }
    }

    /// Asks cases in batches, as long as the program may be asked.
    async fn ask_in_batches(&mut self, mut cases: Vec<Case>) -> Option<()> {
        while !cases.is_empty() && self.left > 0 {
            let rest = cases.split_off(cases.len().min(AT_ONCE));
            self.ask(std::mem::replace(&mut cases, rest)).await?;
        }
        Some(())
    }

    /// Cases near both sides of each limit of a quantity of the question.
    fn at_limits(&mut self, chain: &Chain) -> Vec<Case> {
        let Some(first) = self.answered.first() else { return Vec::new() };
        // The quantities after those of the question are of parts, which no case can be made for.
        let of_question = first.facts.len();
        let mut cases = Vec::new();
        for condition in chain.iter().flat_map(|step| &step.when) {
            for (quantity, limit) in condition.limits() {
                if quantity < of_question {
                    cases.append(&mut self.near_limit(quantity, limit));
                }
            }
        }
        cases
    }

    /// Of many cases beside those that are nearest to a limit so far, the nearest ones.
    fn near_limit(&mut self, quantity: usize, limit: i64) -> Vec<Case> {
        let distance = |facts: &[i64]| facts[quantity].saturating_sub(limit).saturating_abs();
        // The cases that lie nearest to the limit so far, on either side.
        let mut nearest_so_far: Vec<usize> = (0..self.answered.len()).collect();
        nearest_so_far.sort_by_key(|&i| distance(&self.answered[i].facts));
        nearest_so_far.truncate(30);
        // Beside these, new cases are made, of which the nearest ones are worth a question.
        let make = || {
            let case = self.case(&nearest_so_far, true);
            let case = self.singles(case).into_iter().next()?;
            let facts = of_case(self.stage, &case, &self.truth.declared, false).values;
            Some((distance(&facts), case))
        };
        nearest(NEAR_TRIED, NEAR_ASKED, make).collect()
    }

    /// The smallest wrong case that is reached from the shortest one, and one beside it that differs in one number, or lacks one
    /// triangle, and comes out right.
    async fn nearest_right(&mut self) -> Option<String> {
        // The shortest request among the wrong ones is made smaller, as long as it stays wrong.
        let shortest =
            self.wrong().into_iter().min_by_key(|&i| self.answered[i].question.text(1).len())?;
        let case = self.answered[shortest].case.clone();
        let steps = ProgramSteps::new(self.check, &case, &|_| true);
        let mut search = SmallerSearch::new(case, &steps);
        let mut left = NEAREST_ASKED;
        while let Some(case) = search.next(&steps, 1).pop() {
            left = left.saturating_sub(1);
            let is_asked = left > NEAREST_ASKED / 3;
            search.answer(&steps, &[is_asked && self.is_wrong_now(&case).await == Some(true)]);
        }
        // Beside the smallest one, the first that comes out right shows what the difference is.
        let wrong = self.text(&search.smallest)?;
        for other in beside(&search.smallest).into_iter().take(left) {
            if self.is_wrong_now(&other).await == Some(false) {
                let right = self.text(&other)?;
                return Some(format!(
                    "'{wrong}' comes out wrong; beside it, '{right}' comes out right."
                ));
            }
        }
        None
    }

    /// The first request that a case leads to, as the protocol writes it.
    fn text(&self, case: &Case) -> Option<String> {
        let mut questions = Vec::new();
        self.check.questions(case, self.truth, &mut questions);
        Some(questions.first()?.text(1))
    }

    /// Asks a case, and says whether the answer is wrong; nothing where there is none.
    async fn is_wrong_now(&self, case: &Case) -> Option<bool> {
        if !adapt_case::holds(case, &self.truth.declared) {
            return None;
        }
        let mut questions = Vec::new();
        self.check.questions(case, self.truth, &mut questions);
        let answer = self.asker.ask(&questions).await.pop()?;
        let (number, case, question) = (0, case.clone(), questions.pop()?);
        let asked =
            LearnedCase { number, case, question, answer, facts: Vec::new(), is_refuting: false };
        let parts = self.parts(&asked);
        (parts.count() > 0).then(|| !are_all_right(&*parts))
    }

    /// What is said of what was learned: sentences where the chain explains most, and what is known where it is not certain.
    async fn learned(&mut self, trial: Trial, chain: &Chain) -> Learned {
        // Certain is only what predicted every part of enough new answers.
        let mut learned = Learned::default();
        learned.part = self.stage.part_name();
        learned.is_certain = trial.missed() == 0 && trial.is_enough();
        let nearest = if learned.is_certain { None } else { self.nearest_right().await };
        // The sentences need a search over all answers, also those that came last.
        let work = Work::default();
        let search = Search::of(self.stage, &self.answered, &self.truth.declared, &work);
        if trial.explains() {
            learned.does = search.sentences(chain);
        }
        (learned.wrong, learned.right) = (trial.wrong, trial.right);
        if !learned.is_certain {
            learned.known = search.known();
            learned.known.extend(nearest);
        }
        learned
    }
}

impl Learn for Learner<'_> {
    type Hypothesis = Chain;

    fn search(&mut self) -> Chain {
        self.work.begin(false);
        Search::of(self.stage, &self.answered, &self.truth.declared, &self.work).explain()
    }

    /// Asks new questions, questions beside wrong ones, and questions at the limits of a chain.
    async fn try_out(&mut self, chain: &Chain) -> Option<Trial> {
        let start = self.answered.len();
        let mut trial = Trial::default();
        // Independent questions, until enough of them are answered wrongly.
        for _ in 0..MOST_FRESH {
            let from = self.answered.len();
            let cases = (0..FRESH[0]).map(|_| self.case(&[], false)).collect();
            self.ask_in_batches(cases).await?;
            for is_wrong in &self.is_wrong[from..] {
                trial.independent += u64::from(*is_wrong);
            }
            if trial.independent >= ENOUGH_INDEPENDENT {
                break;
            }
        }
        // Then those at which a chain that is nearly right would fail: beside wrong ones, and at its limits.
        let wrong = self.wrong();
        let mut cases: Vec<Case> = (0..FRESH[1]).map(|_| self.case(&wrong, true)).collect();
        cases.extend(self.at_limits(chain));
        self.ask_in_batches(cases).await?;
        // A chain fits an answer where it predicts every part of it.
        for number in start..self.answered.len() {
            let asked = &self.answered[number];
            let parts = self.parts(asked);
            let fits = (0..parts.count()).all(|place| predicts(chain, asked, &*parts, place));
            drop(parts);
            self.answered[number].is_refuting = !fits;
            trial.add(self.is_wrong[number], fits);
        }
        Some(trial)
    }

    fn is_over(&self) -> bool {
        self.left == 0
    }
}

/// Whether all parts of an answer are right.
fn are_all_right(parts: &dyn AnyParts<'_>) -> bool {
    (0..parts.count()).all(|place| parts.is_right(place))
}

/// What is changed of a corner, so that a case differs from another in one number.
const CORNER_CHANGES: [fn(&mut ScreenVertex<DVec2>, i32); 6] = [
    |v, sign| v.position.x += sign * SUBPIXELS,
    |v, sign| v.position.y += sign * SUBPIXELS,
    |v, sign| v.depth += f64::from(sign) / 4.0,
    |v, sign| v.varying.x += f64::from(sign),
    |v, sign| v.varying.y += f64::from(sign),
    |v, sign| v.inv_w *= f64::from(2).powi(sign),
];

/// Cases that differ from one in one number, or lack one triangle.
fn beside(case: &Case) -> Vec<Case> {
    let list = case.triangles();
    // A triangle fewer, where there are several.
    let mut lists: Vec<Vec<Triangle>> = Vec::new();
    if list.len() > 1 {
        for i in 0..list.len() {
            lists.push([&list[..i], &list[i + 1..]].concat());
        }
    }
    // Then each number of each corner, a step up and a step down.
    for triangle in 0..list.len() {
        for corner in 0..3 {
            for sign in [-1, 1] {
                for change in CORNER_CHANGES {
                    let mut list = list.to_vec();
                    change(&mut list[triangle].vertices[corner], sign);
                    lists.push(list);
                }
            }
        }
    }
    let mut cases = Vec::new();
    for list in lists {
        let shape = Shape::Triangles { list, disjoint: false };
        cases.push(Case { window: case.window, shape });
    }
    cases
}
