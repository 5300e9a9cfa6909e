//! Explains a wrong rasterizer or line drawer without a table: it learns when the program is wrong, and how its answer
//! follows from the right one.
//!
//! An explanation is a sum of up to three steps. A step is a *changed question* ('it draws as if x were rounded down to
//! 1/16 px, where the triangle is clockwise') or a *pixel rule* ('it leaves out the last pixel of each row'). Both are made
//! of facts, and a fact is a quantity with a test: every quantity of `quantity` gets every test of `rule`. What a step
//! explains is subtracted: the facts of the next one are facts of what is then predicted.
//!
//! An explanation is believed only where it predicts every pixel of new questions, among them questions at both sides of
//! each of its limits. Otherwise what is known is said: what separates wrong answers from right ones, where the wrong pixels
//! lie, and a right question beside a wrong one.

mod border;
mod change;
mod climb;
mod drawer;
mod edges;
mod fill;
mod known;
mod memory;
mod mend;
mod model;
mod picture;
#[cfg(test)]
mod programs;
mod quantity;
mod question;
#[cfg(test)]
mod recipes;
pub mod rows;
mod rule;
mod say;
mod search;
mod seen;
mod shorter;
pub mod trial;
mod visit;
mod walk;

use std::cell::{OnceCell, RefCell};
use std::future::Future;
use std::pin::Pin;

use crate::convention::{
    Count, Declarations, LineAsker, LineConvention, LineQuestion, TriangleAsker,
    TriangleConvention, TriangleQuestion,
};
use change::{Base, Rule};
pub use drawer::KnownWay;
use drawer::LearnedAnswer;
use drawer::{Drawer, Lines, Triangles};
use model::{Model, Vocabulary};
use quantity::facts_of;
use question::AnyQuestion;
use search::Search;
use trial::{
    AT_ONCE, ENOUGH_INDEPENDENT, ENOUGH_WRONG, FIRST, LEAST_WRONG, Learn, Trial, Work, nearest,
};

/// What was learned of a wrong program.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Learned {
    /// Whether every one of enough new answers was predicted to the pixel.
    pub is_certain: bool,
    /// What the program does and when, a sentence for each step; empty where nothing was found.
    pub does: Vec<String>,
    /// New answers that are wrong, and those of them that were predicted.
    pub wrong: Count,
    /// New answers that are right, and those of them that were predicted.
    pub right: Count,
    /// What is predicted of an answer, in the singular; a pixel where it is empty.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub part: &'static str,
    /// Whether it is counted against another convention what is wrong and right: the first sentence says which.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub is_beyond: bool,
    /// Whether it is an explanation by the other convention after all.
    #[cfg_attr(feature = "serde", serde(skip))]
    is_by_other: bool,
    /// What is known where not every answer was predicted: when it is wrong, where, and what comes out right beside it.
    pub known: Vec<String>,
    /// What mends it, where a step is a known mistake.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub repairs: Vec<String>,
}

impl Learned {
    /// All steps in one sentence, after 'it'; nothing where no step was found.
    pub(crate) fn in_short(&self) -> Option<String> {
        let mut steps = self.does.iter().map(|step| step.trim_end_matches('.'));
        let in_words = |step: &str| format!("{}{}", step[..1].to_ascii_lowercase(), &step[1..]);
        let first = steps.next()?;
        let mut said = match first.strip_prefix("It ") {
            Some(does) => does.to_owned(),
            None => format!("draws so: {}", in_words(first)),
        };
        for step in steps {
            said += &format!("; {}", in_words(step));
        }
        Some(said)
    }

    /// Says that all this comes on top of a convention.
    fn beyond(&mut self, convention: &str) {
        if self.does.is_empty() {
            return;
        }
        self.is_beyond = true;
        for said in &mut self.does {
            *said = said.replacen("It ", "Beyond that, it ", 1);
        }
        self.does.insert(0, format!("It draws by another convention (it {convention})."));
    }

    /// What makes one explanation better than another: that it is certain, that it says something, and how much it predicts.
    fn value(&self) -> (bool, bool, u64) {
        let predicted = 1000 * self.wrong.drawn / self.wrong.of.max(1);
        (self.is_certain, !self.does.is_empty(), predicted)
    }

    /// Whether nine tenths of the new answers were predicted, of wrong and of right ones.
    pub(crate) fn predicts_most(&self) -> bool {
        let is_most = |count: Count| count.of > 0 && 10 * count.drawn >= 9 * count.of;
        is_most(self.wrong) && (self.right.of == 0 || is_most(self.right))
    }

    /// What is said of it: first what the program does and when.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let mut said = self.does.clone();
        let [wrong, right] = match self.is_beyond {
            true => ["that are not as this convention says", "that are"],
            false => ["wrong ones", "right ones"],
        };
        let counts = format!(
            "{} of {} {wrong} and {} of {} {right}",
            self.wrong.drawn, self.wrong.of, self.right.drawn, self.right.of
        );
        if self.is_certain {
            let part = if self.part.is_empty() { "pixel" } else { self.part };
            said.push(format!("Of new answers, this predicts every {part} of {counts}."));
            said.extend(self.repairs.iter().map(|repair| format!("Repair: {repair}.")));
            return said;
        }
        if let Some(first) = said.first_mut() {
            *first = format!("So far: {}{}", first[..1].to_ascii_lowercase(), &first[1..]);
            said.push(format!(
                "Of new answers, this predicts {counts}: too few to call it the cause."
            ));
        }
        said.extend(self.known.iter().cloned());
        said
    }
}

/// Questions before the first search, at most.
const MOST_FIRST: usize = 1200;
/// New questions of each round, and those beside wrong ones.
const FRESH: [usize; 2] = [200, 150];
/// How often the first are asked, as long as too few of them are wrong.
const MOST_FRESH: usize = 4;

/// A convention that a program is compared with.
#[derive(Debug)]
pub struct Start<'a, C> {
    pub convention: &'a C,
    /// Whether it is what is right, and not what comes nearest to the program.
    pub is_right: bool,
}

/// What a program is compared with, and then what comes nearest to it, if that is known and another one.
pub(crate) fn starts<'a, C: PartialEq>(
    declared: &C,
    expected: &'a C,
    nearest: Option<&'a C>,
) -> Vec<Start<'a, C>> {
    let start = |convention| Start { convention, is_right: convention == declared };
    let other = nearest.filter(|nearest| *nearest != expected);
    std::iter::once(expected).chain(other).map(start).collect()
}

/// The first certain explanation of a program compared with one convention after another, or the one that predicts most.
async fn learned_from<C>(
    starts: &[Start<'_, C>],
    learn: impl AsyncFn([&C; 2], &Work) -> Option<Learned>,
    words: impl Fn(&C) -> String,
) -> Option<Learned> {
    let mut best: Option<Learned> = None;
    for (number, start) in starts.iter().enumerate() {
        let other = &starts[starts.len() - 1 - number];
        let work = Work::part_of(starts.len());
        let both = [start.convention, other.convention];
        let Some(mut learned) = learn(both, &work).await else { continue };
        // From what comes nearest back to what is right is no way to say anything.
        if !start.is_right && learned.is_by_other {
            continue;
        }
        if !start.is_right {
            learned.beyond(&words(start.convention));
        }
        if best.as_ref().is_none_or(|best| learned.value() > best.value()) {
            best = Some(learned);
        }
        if best.as_ref().is_some_and(|best| best.is_certain) {
            break;
        }
    }
    best
}

/// Learns from a rasterizer of triangles, as [`of_triangles`] does.
pub type LearnTriangles = for<'a> fn(
    &'a TriangleAsker,
    &'a Declarations,
    &'a [Start<'a, TriangleConvention>],
    &'a [KnownWay<'a, TriangleQuestion>],
) -> Learning<'a>;

/// What is still to be learned.
pub type Learning<'a> = Pin<Box<dyn Future<Output = Option<Learned>> + 'a>>;

/// Questions that a program is asked at most to learn what it does.
const MOST_TO_LEARN: usize = 6000;

/// Learns from a rasterizer of triangles, compared with one convention after another. Known wrong ways to draw may be a part of
/// what it does.
pub fn of_triangles<'a>(
    asker: &'a TriangleAsker,
    known: &'a Declarations,
    starts: &'a [Start<'a, TriangleConvention>],
    ways: &'a [KnownWay<'a, TriangleQuestion>],
) -> Learning<'a> {
    let learn = async move |both: [&TriangleConvention; 2], work: &Work| {
        let mut triangles = Triangles::new(asker, known, both, ways, SEED, work)?;
        Learner::new(&mut triangles).learn().await
    };
    Box::pin(learned_from(starts, learn, TriangleConvention::words))
}

/// Learns from a line drawer, likewise.
pub(crate) async fn of_lines(
    asker: &LineAsker,
    known: &Declarations,
    starts: &[Start<'_, LineConvention>],
    ways: &[KnownWay<'_, LineQuestion>],
) -> Option<Learned> {
    let learn = async |both: [&LineConvention; 2], work: &Work| {
        Learner::new(&mut Lines::new(asker, known, both, ways, SEED, work)).learn().await
    };
    learned_from(starts, learn, LineConvention::words).await
}

/// The questions are the same in every run.
const SEED: u64 = 1;

struct Learner<'a> {
    drawer: &'a mut dyn Drawer,
    /// Questions that may still be asked.
    left: usize,
    vocabulary: Vocabulary,
    answered: Vec<LearnedAnswer>,
    /// The model of the last search, which the next one tries to mend first.
    last: Option<Model>,
    /// Whether it predicted nearly all new answers.
    is_nearly: bool,
    /// The changed questions that came nearest in the first search.
    nearest: OnceCell<Vec<Base>>,
}

impl<'a> Learner<'a> {
    fn new(drawer: &'a mut dyn Drawer) -> Self {
        let sample = drawer.room().question();
        let left = drawer.at_most(MOST_TO_LEARN);
        let vocabulary = Vocabulary::of(&sample);
        Self {
            drawer,
            left,
            vocabulary,
            answered: Vec::new(),
            last: None,
            is_nearly: false,
            nearest: OnceCell::new(),
        }
    }

    async fn learn(mut self) -> Option<Learned> {
        self.ask_first().await;
        if self.wrong().count() < LEAST_WRONG {
            return None;
        }
        let (trial, model) = trial::explained(&mut self).await?;
        let mut learned = self.learned(&trial, &model);
        if !learned.is_certain {
            learned.known.extend(self.nearest_right().await);
        }
        Some(learned)
    }

    /// The smallest wrong question, and a right one that differs from it in one number.
    async fn nearest_right(&mut self) -> Option<String> {
        let wrong = self.answered.iter().enumerate().filter(|(_, a)| a.is_wrong());
        let (smallest, a) = wrong.min_by_key(|(_, a)| a.question.bulk())?;
        let room = self.drawer.room();
        let mut changes = known::one_changes(&a.question, room.grain);
        changes.retain(|change| room.may_ask(&change.question));
        let before = self.answered.len();
        self.left = self.left.max(changes.len());
        self.ask(changes.iter().map(|change| change.question.clone()).collect()).await;
        let (old, new) = self.answered.split_at(before);
        known::beside(&old[smallest], &changes, new)
    }

    fn wrong(&self) -> impl Iterator<Item = &LearnedAnswer> {
        self.answered.iter().filter(|a| a.is_wrong())
    }

    fn search(&self) -> Search<'_> {
        Search {
            drawer: &*self.drawer,
            vocabulary: &self.vocabulary,
            answered: &self.answered,
            first: OnceCell::new(),
            nearest: &self.nearest,
            followed: RefCell::default(),
        }
    }

    /// Asks for more until there are enough wrong answers.
    async fn ask_first(&mut self) {
        let mut failing = self.drawer.failing();
        let room = self.drawer.room();
        room.reach(&failing);
        failing.retain(|question| room.may_ask(question));
        self.ask(failing).await;
        while self.answered.len() < MOST_FIRST && self.left > 0 {
            let wrong: Vec<AnyQuestion> = self.wrong().map(|a| a.question.clone()).collect();
            if self.answered.len() >= FIRST && wrong.len() >= ENOUGH_WRONG {
                break;
            }
            let questions = (0..AT_ONCE).map(|i| self.question(&wrong, i % 2 == 1)).collect();
            self.ask(questions).await;
        }
    }

    /// A new question, or one beside a given one.
    fn question(&mut self, given: &[AnyQuestion], is_beside: bool) -> AnyQuestion {
        let room = self.drawer.room();
        if !is_beside || given.is_empty() {
            return room.question();
        }
        let i = room.rng.int(0, given.len() as i64 - 1) as usize;
        room.beside(&given[i])
    }

    async fn ask(&mut self, questions: Vec<AnyQuestion>) {
        for questions in questions.chunks(AT_ONCE) {
            let questions = &questions[..questions.len().min(self.left)];
            self.left -= questions.len();
            let answers = self.drawer.ask(questions).await;
            for (question, drawn) in questions.iter().zip(answers) {
                let Some(right) = self.drawer.right(question, 0) else { continue };
                self.answered.push(LearnedAnswer::new(question.clone(), drawn, right));
            }
        }
    }

    /// Questions near both sides of each limit of a fact of the question.
    fn at_limits(&mut self, model: &Model) -> Vec<AnyQuestion> {
        let mut questions = Vec::new();
        for (quantity, limit) in model.conjunctions().flatten().filter_map(|fact| fact.limit()) {
            if quantity < self.vocabulary.of_question {
                questions.extend(self.near_limit(quantity, limit));
            }
        }
        questions
    }

    /// The questions nearest to a limit, of many beside those that are nearest so far.
    fn near_limit(&mut self, quantity: usize, limit: i64) -> Vec<AnyQuestion> {
        let distance = |facts: &[i64]| facts[quantity].saturating_sub(limit).saturating_abs();
        let mut order: Vec<usize> = (0..self.answered.len()).collect();
        order.sort_by_key(|&i| distance(&self.answered[i].facts));
        let start: Vec<AnyQuestion> =
            order.iter().take(30).map(|&i| self.answered[i].question.clone()).collect();
        let make = || {
            let question = self.question(&start, true);
            Some((distance(&facts_of(&question)), question))
        };
        nearest(NEAR_TRIED, NEAR_ASKED, make).collect()
    }

    /// What refutes a model is looked at first by the next search; of new answers as many as of old ones.
    fn put_first(&mut self, missed: &[usize]) {
        let mut is_missed = vec![false; self.answered.len()];
        missed.iter().take(120).for_each(|&i| is_missed[i] = true);
        let mut marks = is_missed.into_iter();
        let all = std::mem::take(&mut self.answered);
        let (mut first, rest): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|_| marks.next() == Some(true));
        first.extend(rest);
        self.answered = first;
    }

    fn learned(&self, trial: &Trial, model: &Model) -> Learned {
        let Trial { wrong, right, .. } = *trial;
        let is_certain = trial.missed() == 0
            && trial.is_enough()
            && (model.chain.iter().all(|step| step.base.is_nothing())
                || trial.visible >= ENOUGH_INDEPENDENT);
        let does = match trial.explains() {
            true => say::sentences(model, &*self.drawer, &self.vocabulary),
            false => Vec::new(),
        };
        let known = if is_certain { Vec::new() } else { known::sentences(&self.search()) };
        let other = Base { changes: Vec::new(), rule: Rule::Convention(self.drawer.other()) };
        let is_by_other = model.chain.iter().any(|step| step.when.is_none() && step.base == other);
        let repairs = say::repairs(model, &*self.drawer);
        Learned {
            is_certain,
            does,
            wrong,
            right,
            part: "",
            is_beyond: false,
            is_by_other,
            known,
            repairs,
        }
    }
}

impl Learn for Learner<'_> {
    type Hypothesis = Model;

    fn search(&mut self) -> Model {
        self.drawer.work().begin(self.is_nearly);
        let search = Self::search(self);
        // What was nearly right is mended first.
        let mended = self.last.as_ref().and_then(|last| search.mended(last));
        let found = mended.unwrap_or_else(|| search.explain());
        self.last = Some(found.clone());
        found
    }

    /// Asks new questions, questions beside wrong ones, and questions at the limits of a model.
    async fn try_out(&mut self, model: &Model) -> Option<Trial> {
        let before = self.answered.len();
        let wrong: Vec<AnyQuestion> = self.wrong().map(|a| a.question.clone()).collect();
        // Questions beside others are alike: a limit that only these share is none. So the independent ones are counted apart.
        let mut trial = Trial::default();
        for _ in 0..MOST_FRESH {
            let from = self.answered.len();
            let questions = (0..FRESH[0]).map(|_| self.question(&[], false)).collect();
            self.ask(questions).await;
            trial.independent +=
                self.answered[from..].iter().filter(|a| a.is_wrong()).count() as u64;
            if trial.independent >= ENOUGH_INDEPENDENT {
                break;
            }
        }
        let mut questions: Vec<AnyQuestion> = Vec::new();
        questions.extend((0..FRESH[1]).map(|_| self.question(&wrong, true)));
        questions.extend(self.at_limits(model));
        self.ask(questions).await;
        let search = Self::search(self);
        let mut missed = Vec::new();
        for (i, a) in self.answered.iter().enumerate().skip(before) {
            let fits = search.fits(model, a);
            trial.add(a.is_wrong(), fits);
            trial.visible += u64::from(fits && a.is_wrong() && !a.drawn.is_empty());
            missed.extend((!fits).then_some(i));
        }
        self.put_first(&missed);
        self.is_nearly = trial.is_nearly();
        Some(trial)
    }

    fn is_over(&self) -> bool {
        self.left == 0 || self.drawer.work().is_spent()
    }
}

/// Questions beside others that are looked at for each limit, and those of them that are asked.
const NEAR_TRIED: usize = 600;
const NEAR_ASKED: usize = 24;
