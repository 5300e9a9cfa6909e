//! What is enough to learn from, and to call something the cause: the same for pictures and for rows of numbers.

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

/// How many of some new answers an explanation predicts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trial {
    /// Wrong answers to questions that are beside no other one.
    pub independent: u64,
    pub wrong: Count,
    pub right: Count,
}

impl Trial {
    /// How many it does not predict.
    #[must_use]
    pub fn missed(&self) -> u64 {
        self.wrong.of - self.wrong.drawn + self.right.of - self.right.drawn
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

    /// Counts an answer.
    pub fn add(&mut self, is_wrong: bool, is_predicted: bool) {
        if is_wrong { &mut self.wrong } else { &mut self.right }.add(is_predicted);
    }
}
