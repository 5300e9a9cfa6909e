//! Learns when a stage is wrong and what it does then, where no enumerated mistake predicts every answer.
//!
//! An explanation is a chain of up to three steps. A step is WHEN x WHAT: a *condition* over facts of the question and of a part
//! of its answer (a pixel, a sample, a value, a polygon), and a *change*: a wrong value of the stage, one field or two, or what is
//! read off the answers. What a step explains is subtracted, and the rest is explained again. A chain is believed only where it
//! predicts every part of enough new answers, among them answers beside wrong ones and at both sides of each limit.

mod depth;
mod near;
mod pixels;
#[cfg(test)]
mod programs;
mod samples;
mod values;

use std::cell::{OnceCell, RefCell};
use std::collections::HashSet;
use std::rc::Rc;

use glam::DVec2;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::ScreenVertex;
use rasterproof_verify::cases::facts::Topic;
use rasterproof_verify::cases::shrink::SmallerSearch;
use rasterproof_verify::cases::{Case, Shape, Triangle};
use rasterproof_verify::convention::Count;
use rasterproof_verify::learn::Learned;
use rasterproof_verify::learn::rows::{
    Condition, ConditionTerms, Examples, Quantities, Vocabulary,
};
use rasterproof_verify::learn::trial::{
    self, AT_ONCE, ENOUGH_INDEPENDENT, ENOUGH_WRONG, FIRST, LEAST_WRONG, Learn, Trial, Work,
    nearest,
};

use super::area::AreaDrawn;
use super::sample_values::SampleShading;
use super::wide::WideDrawn;
use super::{StageAsker, families};
use crate::adapt_case;
use crate::ask::{Answer, Question};
use crate::check::{Check, Truth};
use crate::declared::Declared;
use crate::shrink::ProgramSteps;

/// A question that the program was given, with its answer and what is computed of both.
pub struct LearnedCase {
    number: usize,
    case: Case,
    question: Question,
    answer: Answer,
    /// The numbers of the question that conditions are about.
    facts: Vec<i64>,
    /// Whether it refuted a chain: more of its parts are then looked at.
    is_refuting: bool,
}

/// A stage of the pipeline whose mistakes are learned: how an answer is taken apart, and what may be done wrongly.
pub trait Learnable {
    /// What is answered at once, with the answer.
    type Part<'a>;
    /// What a program may do in place of what is right.
    type Change: Clone + 'static;
    /// The kind of question, with its facts.
    const TOPIC: Topic;
    /// The word for a part, in the singular, as messages have it.
    const PART: &'static str;

    /// The quantities of a question beyond those of its kind.
    fn of_question(case: &Case, out: &mut Quantities);

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<Self::Part<'a>>;

    fn is_right(part: &Self::Part<'_>) -> bool;

    /// Whether the answer is the one that a program with this change gives.
    fn explains(change: &Self::Change, part: &Self::Part<'_>) -> bool;

    /// The quantities of a part, and of what a change makes of it.
    fn of_part(part: &Self::Part<'_>, change: Option<&Self::Change>, out: &mut Quantities);

    /// The changes that may explain wrong parts, the simplest first; what is read off is read off these, and off right ones.
    fn changes<'a>(
        wrong: &[&Self::Part<'a>],
        right: &[&Self::Part<'a>],
        work: &Work,
    ) -> Vec<Self::Change>;

    /// The program that makes two mistakes at once, if there is one.
    fn both(_: &Self::Change, _: &Self::Change) -> Option<Self::Change> {
        None
    }

    /// What is said of a change, after 'it'.
    fn says(change: &Self::Change) -> String;
}

/// Learns of a program that is wrong in a check.
pub async fn learn(asker: &StageAsker, check: Check, truth: &Truth) -> Option<Learned> {
    match check {
        Check::Values => Learner::<values::Values>::new(asker, check, truth).learn().await,
        Check::Samples => Learner::<samples::Samples>::new(asker, check, truth).learn().await,
        Check::Depth => Learner::<depth::Depths>::new(asker, check, truth).learn().await,
        Check::Near | Check::Carried => {
            Learner::<near::Polygons>::new(asker, check, truth).learn().await
        }
        Check::Wide => Learner::<pixels::Pixels<WideDrawn>>::new(asker, check, truth).learn().await,
        Check::SampleValues => {
            Learner::<pixels::Pixels<SampleShading>>::new(asker, check, truth).learn().await
        }
        Check::Area => Learner::<pixels::Pixels<AreaDrawn>>::new(asker, check, truth).learn().await,
        _ => None,
    }
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
const NEAR_ASKED: usize = 16;
/// Questions for the nearest right case: two thirds make the wrong one smaller.
const NEAREST_ASKED: usize = 180;
/// The largest window, in square pixels.
const MOST_AREA: i32 = 4096;
/// The questions are the same in every run.
const SEED: u64 = 11;

/// A change with the conditions under which a program does it: any of them, or always where there are none.
struct GuardedChange<L: Learnable> {
    when: Vec<Condition>,
    change: Rc<L::Change>,
}

impl<L: Learnable> Clone for GuardedChange<L> {
    fn clone(&self) -> Self {
        Self { when: self.when.clone(), change: Rc::clone(&self.change) }
    }
}

/// The first change whose condition holds is done; what is right where none does.
type Chain<L> = Vec<GuardedChange<L>>;

fn cost<L: Learnable>(chain: &Chain<L>) -> usize {
    chain.iter().map(|step| 1 + step.when.iter().map(Condition::count).sum::<usize>()).sum()
}

/// The row of a part: the quantities of its question, and its own.
fn row<L: Learnable>(
    asked: &LearnedCase,
    part: &L::Part<'_>,
    change: Option<&L::Change>,
) -> Vec<i64> {
    let mut out = Quantities::after(asked.facts.clone());
    L::of_part(part, change, &mut out);
    out.values
}

/// Whether a program that follows a chain gives this part of its answer.
fn predicts<L: Learnable>(
    chain: &[GuardedChange<L>],
    asked: &LearnedCase,
    part: &L::Part<'_>,
) -> bool {
    let Some((first, rest)) = chain.split_first() else { return L::is_right(part) };
    let (with, without) = (L::explains(&first.change, part), predicts(rest, asked, part));
    // A condition is looked at where it matters.
    if with == without || first.when.is_empty() {
        return with;
    }
    let row = row::<L>(asked, part, Some(&first.change));
    if first.when.iter().any(|condition| condition.holds(&row)) { with } else { without }
}

/// At most so many of some values, evenly spread over all of them.
fn spread<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    let count = all.len().min(most);
    (0..count).map(|i| all[i * all.len() / count]).collect()
}

struct Learner<'a, L: Learnable> {
    asker: &'a StageAsker,
    check: Check,
    truth: &'a Truth,
    /// Questions that may still be asked.
    left: usize,
    rng: Rng,
    /// How many cases of families were asked.
    number: u64,
    answered: Vec<LearnedCase>,
    is_wrong: Vec<bool>,
    work: Work,
    kind: std::marker::PhantomData<L>,
}

impl<'a, L: Learnable> Learner<'a, L> {
    fn new(asker: &'a StageAsker, check: Check, truth: &'a Truth) -> Self {
        Self {
            asker,
            check,
            truth,
            left: asker.at_most(MOST_TO_LEARN).saturating_sub(NEAREST_ASKED),
            rng: Rng::new(L::TOPIC.name, SEED, 0),
            number: 0,
            answered: Vec::new(),
            is_wrong: Vec::new(),
            work: Work::default(),
            kind: std::marker::PhantomData,
        }
    }

    async fn learn(mut self) -> Option<Learned> {
        self.ask_first().await?;
        if self.wrong().len() < LEAST_WRONG {
            return None;
        }
        let (trial, chain) = trial::explained(&mut self).await?;
        Some(self.learned(trial, &chain).await)
    }

    fn wrong(&self) -> Vec<usize> {
        (0..self.answered.len()).filter(|&i| self.is_wrong[i]).collect()
    }

    /// Asks for more until there are enough wrong answers; nothing where the program stops answering.
    async fn ask_first(&mut self) -> Option<()> {
        while self.answered.len() < MOST_FIRST && self.left > 0 {
            let wrong = self.wrong();
            if self.answered.len() >= FIRST && wrong.len() >= ENOUGH_WRONG {
                break;
            }
            let cases = (0..AT_ONCE).map(|i| self.case(&wrong, i % 3 == 2)).collect();
            self.ask(cases).await?;
        }
        Some(())
    }

    /// A case of a family or at random, or one beside one of some answered ones.
    fn case(&mut self, given: &[usize], is_beside: bool) -> Case {
        if is_beside && !given.is_empty() {
            let any = |rng: &mut Rng, count: usize| rng.int(0, count as i64 - 1) as usize;
            let one = given[any(&mut self.rng, given.len())];
            let other = any(&mut self.rng, self.answered.len());
            let [one, other] = [one, other].map(|i| &self.answered[i].case);
            let case = L::TOPIC.beside(&mut self.rng, one, other);
            return self.put(case);
        }
        self.number += 1;
        let names = families(self.check);
        let family = adapt_case::family(names[self.number as usize / 2 % names.len()]);
        match family.filter(|_| self.number.is_multiple_of(2)) {
            Some(family) => {
                let seed = SEED + self.number / 1000;
                adapt_case::case(family, seed, self.number % 1000, &self.truth.declared)
            }
            None => {
                let case = L::TOPIC.any(&mut self.rng);
                self.put(case)
            }
        }
    }

    /// Where the program draws, in a window that is not large: each of its pixels is looked at.
    fn put(&self, mut case: Case) -> Case {
        let window = &mut case.window;
        window.y1 = window.y1.min((MOST_AREA / window.x1.max(1)).max(1));
        adapt_case::put(case, &self.truth.declared)
    }

    async fn ask(&mut self, cases: Vec<Case>) -> Option<()> {
        let (mut single, mut questions) = (Vec::new(), Vec::new());
        for case in cases.into_iter().flat_map(|case| self.singles(case)) {
            let mut of_case = Vec::new();
            self.check.questions(&case, self.truth, &mut of_case);
            if let (Some(question), true) = (of_case.pop(), of_case.is_empty()) {
                single.push(case);
                questions.push(question);
            }
        }
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
            let facts = of_case::<L>(&case, &self.truth.declared, false).values;
            let number = self.answered.len();
            let asked = LearnedCase { number, case, question, answer, facts, is_refuting: false };
            let is_right = L::parts(&asked, &self.truth.declared).iter().all(L::is_right);
            self.is_wrong.push(!is_right);
            self.answered.push(asked);
        }
        Some(())
    }

    /// A case for each question that a case leads to.
    fn singles(&self, case: Case) -> Vec<Case> {
        match (&case.shape, self.check) {
            (_, Check::Depth) => vec![case],
            (Shape::Triangles { list, .. }, _) => {
                let single = |t| Shape::Triangles { list: vec![t], disjoint: true };
                // All of a mesh are alike.
                let some = list.iter().take(2);
                some.map(|t| Case { window: case.window, shape: single(*t) }).collect()
            }
            _ => Vec::new(),
        }
    }

    async fn ask_in_batches(&mut self, mut cases: Vec<Case>) -> Option<()> {
        while !cases.is_empty() && self.left > 0 {
            let rest = cases.split_off(cases.len().min(AT_ONCE));
            self.ask(std::mem::replace(&mut cases, rest)).await?;
        }
        Some(())
    }

    /// Cases near both sides of each limit of a quantity of the question.
    fn at_limits(&mut self, chain: &Chain<L>) -> Vec<Case> {
        let Some(first) = self.answered.first() else { return Vec::new() };
        let of_question = first.facts.len();
        let limits = chain.iter().flat_map(|step| &step.when).flat_map(Condition::limits);
        let limits: Vec<_> = limits.filter(|(i, _)| *i < of_question).collect();
        limits.into_iter().flat_map(|(i, limit)| self.near_limit(i, limit)).collect()
    }

    /// Of many cases beside those that are nearest to a limit so far, the nearest ones.
    fn near_limit(&mut self, quantity: usize, limit: i64) -> Vec<Case> {
        let distance = |facts: &[i64]| facts[quantity].saturating_sub(limit).saturating_abs();
        let mut nearest_so_far: Vec<usize> = (0..self.answered.len()).collect();
        nearest_so_far.sort_by_key(|&i| distance(&self.answered[i].facts));
        nearest_so_far.truncate(30);
        let make = || {
            let case = self.case(&nearest_so_far, true);
            let case = self.singles(case).into_iter().next()?;
            let facts = of_case::<L>(&case, &self.truth.declared, false).values;
            Some((distance(&facts), case))
        };
        nearest(NEAR_TRIED, NEAR_ASKED, make).collect()
    }

    /// The smallest wrong case that is reached from the shortest one, and one beside it that differs in one number, or lacks one
    /// triangle, and comes out right.
    async fn nearest_right(&mut self) -> Option<String> {
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
        let parts = L::parts(&asked, &self.truth.declared);
        (!parts.is_empty()).then(|| !parts.iter().all(L::is_right))
    }

    async fn learned(&mut self, trial: Trial, chain: &Chain<L>) -> Learned {
        let mut learned = Learned::default();
        learned.part = L::PART;
        learned.is_certain = trial.missed() == 0 && trial.is_enough();
        let nearest = if learned.is_certain { None } else { self.nearest_right().await };
        let work = Work::default();
        let search = Search::<L>::of(&self.answered, &self.truth.declared, &work);
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

impl<L: Learnable> Learn for Learner<'_, L> {
    type Hypothesis = Chain<L>;

    fn search(&mut self) -> Chain<L> {
        self.work.begin();
        Search::<L>::of(&self.answered, &self.truth.declared, &self.work).explain()
    }

    /// Asks new questions, questions beside wrong ones, and questions at the limits of a chain.
    async fn try_out(&mut self, chain: &Chain<L>) -> Option<Trial> {
        let start = self.answered.len();
        let mut trial = Trial::default();
        for _ in 0..MOST_FRESH {
            let from = self.answered.len();
            let cases = (0..FRESH[0]).map(|_| self.case(&[], false)).collect();
            self.ask_in_batches(cases).await?;
            trial.independent +=
                self.is_wrong[from..].iter().filter(|wrong| **wrong).count() as u64;
            if trial.independent >= ENOUGH_INDEPENDENT {
                break;
            }
        }
        let wrong = self.wrong();
        let mut cases: Vec<Case> = (0..FRESH[1]).map(|_| self.case(&wrong, true)).collect();
        cases.extend(self.at_limits(chain));
        self.ask_in_batches(cases).await?;
        for (asked, is_wrong) in self.answered.iter_mut().zip(&self.is_wrong).skip(start) {
            let parts = L::parts(asked, &self.truth.declared);
            let fits = parts.iter().all(|part| predicts(chain, asked, part));
            drop(parts);
            asked.is_refuting = !fits;
            trial.add(*is_wrong, fits);
        }
        Some(trial)
    }

    fn is_over(&self) -> bool {
        self.left == 0
    }
}

/// Cases that differ from one in one number, or lack one triangle.
fn beside(case: &Case) -> Vec<Case> {
    let list = case.triangles();
    let with = |list: Vec<Triangle>| Case {
        window: case.window,
        shape: Shape::Triangles { list, disjoint: false },
    };
    let mut all = Vec::new();
    if list.len() > 1 {
        all.extend((0..list.len()).map(|i| with([&list[..i], &list[i + 1..]].concat())));
    }
    for (i, corner) in (0..list.len()).flat_map(|i| [0, 1, 2].map(|corner| (i, corner))) {
        let mut change = |change: &dyn Fn(&mut ScreenVertex<DVec2>)| {
            let mut list = list.to_vec();
            change(&mut list[i].vertices[corner]);
            all.push(with(list));
        };
        for sign in [-1, 1] {
            change(&|v| v.position.x += sign * SUBPIXELS);
            change(&|v| v.position.y += sign * SUBPIXELS);
            change(&|v| v.depth += f64::from(sign) / 4.0);
            change(&|v| v.varying.x += f64::from(sign));
            change(&|v| v.varying.y += f64::from(sign));
            change(&|v| v.inv_w *= f64::from(2).powi(sign));
        }
    }
    all
}

/// The quantities of a case, with their names or without.
fn of_case<L: Learnable>(case: &Case, declared: &Declared, is_named: bool) -> Quantities {
    let mut out = if is_named { Quantities::with_names() } else { Quantities::default() };
    let limits = adapt_case::limits(declared);
    let numbers = L::TOPIC.numbers(case, &limits).unwrap_or_default();
    rasterproof_verify::learn::rows::of_topic(&L::TOPIC, &numbers, &mut out);
    L::of_question(case, &mut out);
    out
}

/// The most steps of a chain, the changes of which are tried for each, and those that are combined in pairs.
const MOST_STEPS: usize = 3;
const MOST_CHANGES: usize = 4;
const PAIRED: usize = 10;
/// Wrong parts by which changes are ranked; parts from which conditions are learned, wrong ones and right ones.
const RANKED_BY: usize = 160;
const LEARNED_FROM: [usize; 2] = [220, 440];
/// Right parts that are looked at for what a condition breaks.
const CHECKED: usize = 4000;
/// Conditions of a step at most.
const MOST_CONDITIONS: usize = 3;
const WHEN: ConditionTerms = ConditionTerms { facts: 3, questions: 3, slack: 0 };

/// Parts of one answer that are looked at, wrong ones and right ones; of one that refuted a chain so many times as many.
const PARTS_OF_ONE: [usize; 2] = [60, 30];
const OF_REFUTING: usize = 8;

/// Some parts of an answer, wrong ones and right ones evenly spread.
fn some_parts<'a, L: Learnable>(asked: &'a LearnedCase, declared: &Declared) -> Vec<L::Part<'a>> {
    let (right, wrong): (Vec<_>, Vec<_>) =
        L::parts(asked, declared).into_iter().partition(L::is_right);
    let times = if asked.is_refuting { OF_REFUTING } else { 1 };
    let mut some = Vec::new();
    for (parts, most) in [wrong, right].into_iter().zip(PARTS_OF_ONE) {
        let step = parts.len().div_ceil(times * most).max(1);
        some.extend(parts.into_iter().step_by(step));
    }
    some
}

/// A part with the number of its question.
struct PartOf<P> {
    question: usize,
    part: P,
}

/// What is computed once of a change: which parts it explains, and the quantities of those that are looked at.
struct Looked {
    explained: Vec<bool>,
    rows: Vec<OnceCell<Vec<i64>>>,
}

/// A change with what was computed of it.
type LookedChange<C> = (Rc<C>, Rc<Looked>);

/// The parts of all answers; a part is meant by its place.
struct Search<'a, L: Learnable> {
    answered: &'a [LearnedCase],
    parts: Vec<PartOf<L::Part<'a>>>,
    is_right: Vec<bool>,
    /// Whether an answer has right parts alone.
    is_whole_right: Vec<bool>,
    looked: RefCell<Vec<LookedChange<L::Change>>>,
    names: Vocabulary,
    of_question: usize,
    work: &'a Work,
}

impl<'a, L: Learnable> Search<'a, L> {
    fn of(answered: &'a [LearnedCase], declared: &Declared, work: &'a Work) -> Self {
        let mut parts = Vec::new();
        for (question, asked) in answered.iter().enumerate() {
            let of_one = some_parts::<L>(asked, declared).into_iter();
            parts.extend(of_one.map(|part| PartOf { question, part }));
        }
        let is_right: Vec<bool> = parts.iter().map(|of| L::is_right(&of.part)).collect();
        let mut is_whole_right = vec![true; answered.len()];
        for (of, is_right) in parts.iter().zip(&is_right) {
            is_whole_right[of.question] &= is_right;
        }
        let mut out = answered
            .first()
            .map_or_else(Quantities::default, |asked| of_case::<L>(&asked.case, declared, true));
        let of_question = out.values.len();
        if let Some(of) = parts.first() {
            L::of_part(&of.part, None, &mut out);
        }
        let (looked, names) = (RefCell::default(), Vocabulary::of(out));
        Self { answered, parts, is_right, is_whole_right, looked, names, of_question, work }
    }

    fn looked(&self, change: &Rc<L::Change>) -> Rc<Looked> {
        let is_one = |(other, _): &&LookedChange<L::Change>| Rc::ptr_eq(other, change);
        if let Some((_, looked)) = self.looked.borrow().iter().find(is_one) {
            return Rc::clone(looked);
        }
        self.work.spend(self.parts.len() * PART);
        let explained = self.parts.iter().map(|of| L::explains(change, &of.part)).collect();
        let rows = self.parts.iter().map(|_| OnceCell::new()).collect();
        let looked = Rc::new(Looked { explained, rows });
        self.looked.borrow_mut().push((Rc::clone(change), Rc::clone(&looked)));
        looked
    }

    /// The quantities of a part and of what a change makes of it.
    fn row<'l>(&self, change: &L::Change, looked: &'l Looked, place: usize) -> &'l [i64] {
        looked.rows[place].get_or_init(|| {
            self.work.spend(ALL_OF_A_PART);
            let PartOf { question, part } = &self.parts[place];
            row::<L>(&self.answered[*question], part, Some(change))
        })
    }

    /// Whether a chain predicts each part.
    fn predicted(&self, chain: &Chain<L>) -> Vec<bool> {
        let mut predicted = self.is_right.clone();
        for GuardedChange { when, change } in chain.iter().rev() {
            let looked = self.looked(change);
            for (place, is_predicted) in predicted.iter_mut().enumerate() {
                let with = looked.explained[place];
                // A condition is looked at where it matters.
                if with != *is_predicted {
                    let holds = |all: &Condition| all.holds(self.row(change, &looked, place));
                    *is_predicted ^= when.is_empty() || when.iter().any(holds);
                }
            }
        }
        predicted
    }

    /// The share of wrong and of right answers that a chain predicts, against what it says.
    fn score(&self, chain: &Chain<L>) -> f64 {
        let mut fits = vec![true; self.answered.len()];
        for (of, is_predicted) in self.parts.iter().zip(self.predicted(chain)) {
            fits[of.question] &= is_predicted;
        }
        let mut counts = [Count::default(); 2];
        for (&fits, &is_right) in fits.iter().zip(&self.is_whole_right) {
            counts[usize::from(is_right)].add(fits);
        }
        let [wrong, right] = counts.map(|c| c.drawn as f64 / c.of.max(1) as f64);
        0.75 * wrong + 0.25 * right - 0.004 * cost(chain) as f64
    }

    /// The chain that predicts most.
    fn explain(&self) -> Chain<L> {
        let mut chain: Chain<L> = Vec::new();
        let mut best = self.score(&chain);
        for _ in (0..MOST_STEPS).take_while(|_| !self.work.is_done()) {
            let Some((score, longer)) = self.with_step(&chain) else { break };
            if score <= best {
                break;
            }
            (best, chain) = (score, longer);
        }
        self.pruned(chain, best)
    }

    /// With the step before the others that explains most of what they do not.
    fn with_step(&self, chain: &Chain<L>) -> Option<(f64, Chain<L>)> {
        let predicted = self.predicted(chain);
        let (held, left): (Vec<_>, Vec<_>) =
            (0..self.parts.len()).partition(|place| predicted[*place]);
        if left.is_empty() {
            return None;
        }
        let mut best: Option<(f64, Chain<L>)> = None;
        for change in self.ranked(&spread(&left, RANKED_BY), &spread(&held, 4 * RANKED_BY)) {
            let Some(when) = self.when(&change, &left, &held) else { continue };
            let mut longer = chain.clone();
            longer.insert(0, GuardedChange { when, change });
            let score = self.score(&longer);
            if best.as_ref().is_none_or(|(most, _)| score > *most) {
                best = Some((score, longer));
            }
        }
        best
    }

    /// The changes that explain most of some wrong parts, each another set of them.
    fn ranked(&self, wrong: &[usize], right: &[usize]) -> Vec<Rc<L::Change>> {
        let wrong: Vec<_> = wrong.iter().map(|place| &self.parts[*place].part).collect();
        let right: Vec<_> = right.iter().map(|place| &self.parts[*place].part).collect();
        let mut ranked = rank::<L>(L::changes(&wrong, &right, self.work), &wrong, self.work);
        let most = ranked.first().map_or(0, |(count, ..)| *count);
        if most < wrong.len() {
            let firsts: Vec<_> = ranked.iter().take(PAIRED).map(|(.., change)| change).collect();
            let seconds = ranked.iter().map(|(.., change)| change);
            let pairs = seconds.flat_map(|b| firsts.iter().filter_map(move |a| L::both(a, b)));
            let pairs = rank::<L>(pairs.collect(), &wrong, self.work);
            ranked.extend(pairs.into_iter().filter(|(count, ..)| *count > most));
            ranked.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
        }
        let mut seen = HashSet::new();
        ranked.retain(|(_, explained, _)| seen.insert(explained.clone()));
        ranked.into_iter().take(MOST_CHANGES).map(|(.., change)| Rc::new(change)).collect()
    }

    /// The conditions under which a change explains what a chain does not, and breaks nothing; none where it never breaks
    /// anything.
    fn when(
        &self,
        change: &Rc<L::Change>,
        left: &[usize],
        held: &[usize],
    ) -> Option<Vec<Condition>> {
        let looked = self.looked(change);
        let row = |place: usize| self.row(change, &looked, place);
        let yes: Vec<_> = left.iter().copied().filter(|place| looked.explained[*place]).collect();
        let no: Vec<_> = held.iter().copied().filter(|place| !looked.explained[*place]).collect();
        if no.is_empty() {
            return (!yes.is_empty()).then(Vec::new);
        }
        if self.work.is_done() {
            return None;
        }
        let mut examples = Examples::default();
        for place in spread(&yes, LEARNED_FROM[0]) {
            examples.should(row(place).to_vec(), self.parts[place].question);
        }
        let mut some = spread(&no, LEARNED_FROM[1]);
        for round in 0..CORRECTIONS {
            some.iter().for_each(|place| examples.should_not(row(*place).to_vec()));
            let conditions = examples.any_of(&self.names, WHEN, MOST_CONDITIONS, self.work);
            if conditions.is_empty() {
                return None;
            }
            // What a condition holds of that it should not is learned from, too.
            let is_broken = |place: &usize| conditions.iter().any(|all| all.holds(row(*place)));
            let broken = spread(&no, CHECKED).into_iter().filter(is_broken);
            some = broken.take(LEARNED_FROM[0]).collect();
            if some.is_empty() || round + 1 == CORRECTIONS {
                return Some(conditions);
            }
        }
        None
    }

    /// Leaves out a step, a condition or a fact wherever the score does not become worse.
    fn pruned(&self, mut chain: Chain<L>, mut best: f64) -> Chain<L> {
        loop {
            let scored = shorter(&chain).into_iter().map(|less| (self.score(&less), less));
            match scored.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(score, _)| *score > best) {
                Some((score, less)) => (best, chain) = (score, less),
                None => return chain,
            }
        }
    }

    /// What a chain does, a sentence for each step.
    fn sentences(&self, chain: &Chain<L>) -> Vec<String> {
        let mut out: Vec<String> = Vec::new();
        for GuardedChange { when, change } in chain {
            let words: Vec<_> = when.iter().map(|all| all.words(&self.names)).collect();
            let place = match words[..] {
                [] => String::new(),
                _ => format!(" where {}", words.join("; or where ")),
            };
            let it = if out.is_empty() { "It" } else { "Elsewhere, it" };
            out.push(format!("{it} {}{place}.", L::says(change)));
        }
        out
    }

    /// What is known where no chain predicts every answer: when answers are wrong, where in them, and what is right beside one.
    fn known(&self) -> Vec<String> {
        let mut said = Vec::new();
        let (mut of_questions, mut of_parts) = (Examples::default(), Examples::default());
        for (i, asked) in self.answered.iter().enumerate() {
            match self.is_whole_right[i] {
                true => of_questions.should_not(asked.facts.clone()),
                false => of_questions.should(asked.facts.clone(), i),
            }
        }
        let names = self.names.first(self.of_question);
        let mostly = ConditionTerms { facts: 2, questions: 3, slack: 30 };
        if let Some(when) = of_questions.best(&names, mostly, self.work) {
            let ([wrong, right], [of_wrong, of_right]) =
                (of_questions.held(&when), of_questions.counts());
            // What holds of few says nothing.
            if 2 * wrong >= of_wrong {
                said.push(format!(
                    "Mostly wrong where {}: this holds for {wrong} of {of_wrong} wrong answers and {right} of {of_right} right ones.",
                    when.words(&names)
                ));
            }
        }
        let is_in_wrong = |place: &usize| !self.is_whole_right[self.parts[*place].question];
        let (right, wrong): (Vec<_>, Vec<_>) = (0..self.parts.len())
            .filter(is_in_wrong)
            .partition(|place: &usize| self.is_right[*place]);
        let row = |place: usize| {
            let PartOf { question, part } = &self.parts[place];
            row::<L>(&self.answered[*question], part, None)
        };
        for place in spread(&wrong, LEARNED_FROM[0]) {
            of_parts.should(row(place), self.parts[place].question);
        }
        for place in spread(&right, LEARNED_FROM[1]) {
            of_parts.should_not(row(place));
        }
        if let Some(place) = of_parts.best(&self.names, mostly, self.work) {
            let ([wrong, right], [of_wrong, of_right]) = (of_parts.held(&place), of_parts.counts());
            if 2 * wrong >= of_wrong && of_right > 0 {
                said.push(format!(
                    "In wrong answers, the wrong {}s are mostly those where {}: {wrong} of {of_wrong} wrong ones and {right} of {of_right} right ones.",
                    L::PART,
                    place.words(&self.names)
                ));
            }
        }
        said
    }
}

/// How often a condition is learned anew with what refuted it.
const CORRECTIONS: usize = 2;

/// Steps of [`Work`] for a look at whether a change explains a part, and for all quantities of one.
const PART: usize = 60;
const ALL_OF_A_PART: usize = 600;

/// Wrong parts of which a change explains one, or is left aside.
const FEW: usize = 16;

/// How many of some wrong parts a change explains, which ones, and the change.
type RankedChange<C> = (usize, Vec<bool>, C);

/// Changes by how many wrong parts they explain; those that explain hardly any are left out.
fn rank<L: Learnable>(
    changes: Vec<L::Change>,
    wrong: &[&L::Part<'_>],
    work: &Work,
) -> Vec<RankedChange<L::Change>> {
    let mut ranked = Vec::new();
    let few = spread(wrong, FEW);
    work.spend(changes.len() * few.len() * PART);
    for change in changes {
        if !few.iter().any(|part| L::explains(&change, part)) {
            continue;
        }
        work.spend(wrong.len() * PART);
        let explained: Vec<bool> = wrong.iter().map(|part| L::explains(&change, part)).collect();
        let count = explained.iter().filter(|is| **is).count();
        ranked.push((count, explained, change));
    }
    ranked.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    ranked
}

/// All chains that say one thing less.
fn shorter<L: Learnable>(chain: &Chain<L>) -> Vec<Chain<L>> {
    let mut all = Vec::new();
    for i in 0..chain.len() {
        let mut less = chain.clone();
        less.remove(i);
        all.push(less);
        for (j, condition) in chain[i].when.iter().enumerate() {
            let mut less = chain.clone();
            less[i].when.remove(j);
            all.push(less);
            for k in (0..condition.count()).filter(|_| condition.count() > 1) {
                let mut less = chain.clone();
                less[i].when[j] = condition.without(k);
                all.push(less);
            }
        }
    }
    all
}
