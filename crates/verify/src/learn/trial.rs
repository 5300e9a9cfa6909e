//! What is enough to learn from, and to call something the cause: the same for pictures and for rows of numbers.

use std::cell::Cell;
use std::future::Future;

use crate::convention::Count;

/// Questions before the first search, at least.
pub const FIRST: usize = 400;
/// Wrong answers that are wanted before the first search.
pub const ENOUGH_WRONG: usize = 60;
/// Wrong answers below which nothing is learned.
pub const LEAST_WRONG: usize = 6;
/// Questions of one batch, so that a slow program can be left in time.
pub const AT_ONCE: usize = 100;
/// New answers below which nothing is called the cause.
const ENOUGH_NEW: u64 = 300;
/// Wrong ones among these.
const ENOUGH_NEW_WRONG: u64 = 50;
/// Wrong ones that are independent of each other among these.
pub const ENOUGH_INDEPENDENT: u64 = 12;

/// Answers after which a wrong one that is independent should have been met.
const ENOUGH_FOR_RARE: u64 = 2000;

/// How much the searches for an explanation may do. It is counted in steps and never in seconds, so that the same answers get
/// the same explanation on a slow machine and on a fast one.
#[derive(Debug)]
pub struct Work {
    /// Steps that are left in all, and those of them that are kept for later searches.
    left: Cell<usize>,
    kept: Cell<usize>,
}

/// Steps of all searches for one explanation. A step is some fifty instructions.
const MOST_WORK: usize = 500_000_000;
/// Steps of a search for what was nearly right.
const MOST_NEARLY: usize = 40_000_000;

impl Default for Work {
    fn default() -> Self {
        Self::part_of(1)
    }
}

impl Work {
    /// One of so many equal parts of it.
    #[must_use]
    pub fn part_of(parts: usize) -> Self {
        Self { left: Cell::new(MOST_WORK / parts.max(1)), kept: Cell::new(0) }
    }

    /// A search begins: it may use three fifths of what is left. What one search does not find is seldom found by the next, which
    /// is there for what was nearly right.
    ///
    /// What was nearly right is seldom made right by another long search: it gets less.
    pub fn begin(&self, is_nearly: bool) {
        let left = self.left.get();
        let most = if is_nearly { MOST_NEARLY } else { left };
        self.kept.set(left - (left * 3 / 5).min(most));
    }

    /// Whether no search may do anything any more.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0
    }

    /// Counts some steps.
    pub fn spend(&self, steps: usize) {
        self.left.set(self.left.get().saturating_sub(steps));
    }

    /// Whether the search is to end with what it has.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.left.get() <= self.kept.get()
    }
}

/// Searches at most, and rounds of new questions; more where hardly anything is missed, which is a limit that is not met exactly.
const MOST_ROUNDS: usize = 4;
const MOST_ROUNDS_NEARLY: usize = 8;
/// The part of the new answers that is hardly anything.
const HARDLY: u64 = 25;

/// Somebody who searches for an explanation, and tries out on new questions what was found.
pub trait Learn {
    /// An explanation.
    type Hypothesis: Clone;

    /// The best explanation of the answers so far.
    fn search(&mut self) -> Self::Hypothesis;

    /// How an explanation does on new questions, whose answers the next search learns from; nothing where these are not answered.
    fn try_out(&mut self, found: &Self::Hypothesis) -> impl Future<Output = Option<Trial>>;

    /// Whether nothing more may be asked.
    fn is_over(&self) -> bool;
}

/// The best explanation with what its trial showed. What refutes one is learned from by the next search; what is not
/// refuted is tried out until that was enough.
pub async fn explained<L: Learn>(learner: &mut L) -> Option<(Trial, L::Hypothesis)> {
    let mut best: Option<(Trial, L::Hypothesis)> = None;
    let (mut searches, mut is_refuted) = (0, true);
    for round in 0..MOST_ROUNDS_NEARLY {
        let is_nearly = best.as_ref().is_some_and(|(trial, _)| trial.is_nearly());
        if round >= MOST_ROUNDS && !is_nearly {
            break;
        }
        // What was not refuted before is asked for more.
        let again = best.take_if(|_| !is_refuted);
        let (before, found) = again.unwrap_or_else(|| {
            searches += 1;
            (Trial::default(), learner.search())
        });
        let mut trial = learner.try_out(&found).await?;
        is_refuted = trial.missed() > 0;
        trial.add_all(&before);
        if best.as_ref().is_none_or(|(most, _)| trial.missed() <= most.missed()) {
            best = Some((trial, found));
        }
        // Where most is not predicted, another look at more answers seldom helps.
        let is_hopeless = searches > 1 && best.as_ref().is_some_and(|(trial, _)| !trial.explains());
        let is_rare = is_refuted && trial.is_rare() && trial.is_nearly();
        if !is_refuted && trial.is_enough() || is_hopeless || is_rare || learner.is_over() {
            break;
        }
    }
    best
}

/// The nearest of so many things that are made one after another with their distances, so many of them.
pub fn nearest<T>(
    made: usize,
    kept: usize,
    mut make: impl FnMut() -> Option<(i64, T)>,
) -> impl Iterator<Item = T> {
    let mut all: Vec<(i64, T)> = (0..made).filter_map(|_| make()).collect();
    all.sort_by_key(|(distance, _)| *distance);
    all.into_iter().take(kept).map(|(_, one)| one)
}

/// How many of some new answers an explanation predicts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trial {
    /// Wrong answers to questions that are beside no other one.
    pub independent: u64,
    /// Wrong answers that are predicted and show something: where nothing is shown, much predicts the same.
    pub visible: u64,
    pub wrong: Count,
    pub right: Count,
}

impl Trial {
    /// How many it does not predict.
    #[must_use]
    pub fn missed(&self) -> u64 {
        self.wrong.of - self.wrong.drawn + self.right.of - self.right.drawn
    }

    /// Whether hardly any answer is not predicted.
    #[must_use]
    pub fn is_nearly(&self) -> bool {
        HARDLY * self.missed() <= self.wrong.of + self.right.of
    }

    /// Whether what is wrong is met beside failing cases alone: no other explanation will ever have enough answers, either.
    fn is_rare(&self) -> bool {
        self.independent == 0 && self.wrong.of + self.right.of >= ENOUGH_FOR_RARE
    }

    /// Whether there are enough answers to call something the cause.
    #[must_use]
    pub fn is_enough(&self) -> bool {
        self.wrong.of + self.right.of >= ENOUGH_NEW
            && self.wrong.of >= ENOUGH_NEW_WRONG
            && self.independent >= ENOUGH_INDEPENDENT
    }

    /// Whether at least half of the wrong answers are predicted, and nine tenths of the right ones.
    #[must_use]
    pub fn explains(&self) -> bool {
        let (wrong, right) = (self.wrong, self.right);
        wrong.drawn > 0 && 2 * wrong.drawn >= wrong.of && 10 * right.drawn >= 9 * right.of
    }

    /// Counts the answers of another trial, too.
    fn add_all(&mut self, other: &Self) {
        self.independent += other.independent;
        self.visible += other.visible;
        for (count, more) in [(&mut self.wrong, other.wrong), (&mut self.right, other.right)] {
            count.drawn += more.drawn;
            count.of += more.of;
        }
    }

    /// Counts an answer.
    pub fn add(&mut self, is_wrong: bool, is_predicted: bool) {
        if is_wrong { &mut self.wrong } else { &mut self.right }.add(is_predicted);
    }
}
