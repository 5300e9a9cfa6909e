//! Weighs hypotheses by the answers: those that explain what is wrong without predicting faults that are not there.
//!
//! # Steps
//!
//! Every mistake with every parameter on every base is a hypothesis, and a prediction costs a picture. So they are tried on few
//! answers first:
//!
//! 1. all hypotheses are looked at on 16 wrong answers and 16 right ones, and the best 160 are kept, of each name 80 at most,
//! 2. these are looked at on 40 of each, and 60 are kept,
//! 3. these are weighed on every second answer, and the best 24
//! 4. on the other answers, which had no part in the choice: only these count.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::Explanation;
use crate::convention::Count;

/// A hypothesis about every question.
pub struct Hypothesis<'a> {
    /// Whether the answer to the question of this number is what the hypothesis predicts.
    pub predicts: Box<dyn Fn(usize) -> bool + 'a>,
    /// What it says, with counts of nothing yet.
    pub says: Explanation,
}

/// What a hypothesis says of each answer, computed once: it is weighed by all of them, then by those without large
/// coordinates, and looked at again where the nearest ones are searched for.
pub(super) fn remembered<'a>(
    predicts: impl Fn(usize) -> bool + 'a,
) -> Box<dyn Fn(usize) -> bool + 'a> {
    // Two bits for each answer: whether it was predicted already, and whether that was right. Most hypotheses are left after a
    // few answers, and of these nothing is kept beyond them.
    let seen = RefCell::new(Vec::new());
    Box::new(move |i| {
        let (word, bit) = (i / 32, i % 32 * 2);
        let known = seen.borrow().get(word).copied().unwrap_or(0_u64) >> bit & 3;
        if known != 0 {
            return known == 3;
        }
        let is_right = predicts(i);
        let mut seen = seen.borrow_mut();
        if seen.len() <= word {
            seen.resize(word + 1, 0);
        }
        seen[word] |= (1 | u64::from(is_right) << 1) << bit;
        is_right
    })
}

/// How far a hypothesis explains answers that it was not chosen by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Weight {
    /// Wrong answers that it predicts.
    pub(super) wrong: Count,
    /// Right answers that it predicts.
    pub(super) right: Count,
}

impl Weight {
    /// Nothing where it misses more than `most` answers.
    fn of(
        hypothesis: &Hypothesis<'_>,
        questions: &[usize],
        is_wrong: &[bool],
        most: u64,
    ) -> Option<Self> {
        let mut weight = Self::default();
        for &i in questions {
            let count = if is_wrong[i] { &mut weight.wrong } else { &mut weight.right };
            // Prediction is slow, and most hypotheses are hopeless after a few answers.
            count.add((hypothesis.predicts)(i));
            if weight.missed() > most {
                return None;
            }
        }
        Some(weight)
    }

    fn of_one(&self, hypothesis: &Hypothesis<'_>) -> Explanation {
        Explanation { wrong: self.wrong, right: self.right, ..hypothesis.says.clone() }
    }

    fn missed(&self) -> u64 {
        (self.wrong.of - self.wrong.drawn) + (self.right.of - self.right.drawn)
    }

    /// At least 99 % of both.
    fn is_convincing(&self) -> bool {
        let Self { wrong, right } = self;
        wrong.of > 0 && 100 * wrong.drawn >= 99 * wrong.of && 100 * right.drawn >= 99 * right.of
    }
}

/// A look at the hypotheses that are left.
struct Look {
    /// How many wrong answers, and as many right ones, they are tried on.
    answers: usize,
    /// How many hypotheses are kept, and of one name.
    kept: usize,
    of_one_name: usize,
}

const LOOKS: [Look; 2] = [
    Look { answers: 16, kept: 160, of_one_name: 80 },
    Look { answers: 40, kept: 60, of_one_name: 30 },
];
/// Of these, those that are tried on answers that they were not chosen by.
const TRIED: usize = 24;
/// Wrong answers that may be missed at a look, although they are most.
const LEAST_MISSED: u64 = 2;
/// Wrong answers below which nothing is concluded.
pub(super) const LEAST_WRONG: usize = 6;

/// The hypotheses that explain at least 99 % of the wrong answers and of the right ones, the best ones and of these the
/// first of each name; or the nearest one. Both with their weight on every second answer, where they were chosen by the others;
/// of the answers with the numbers in `among`.
pub(super) fn weigh(
    hypotheses: &[Hypothesis<'_>],
    is_wrong: &[bool],
    among: &[usize],
) -> (Vec<Explanation>, Option<Explanation>) {
    if among.iter().filter(|&&i| is_wrong[i]).count() < LEAST_WRONG {
        return (Vec::new(), None);
    }
    let (fitted, fresh) = (half(is_wrong, among, 0), fresh(is_wrong, among));
    let mut left: Vec<Weighed<'_, '_>> = Vec::new();
    for hypothesis in hypotheses {
        left.push(Weighed { missed: 0, weight: Weight::default(), hypothesis });
    }
    // All on a few answers first, and what is left on more.
    for Look { answers, kept, of_one_name } in LOOKS {
        let few = some_of_both(&fitted, is_wrong, answers);
        for one in &mut left {
            one.missed = look(one.hypothesis, &few, is_wrong);
        }
        sort_by_missed(&mut left);
        keep_of_names(&mut left, of_one_name, |one| one.hypothesis.says.name);
        left.truncate(kept);
    }
    // The looks chose them, and count no further.
    for one in &mut left {
        one.missed = 0;
    }
    let mut scored = weighed(left, &fitted, is_wrong);
    scored.truncate(TRIED);
    // The best of them on answers that they were not chosen by.
    let tried = weighed(scored, &fresh, is_wrong);
    let Some(best) = tried.first() else { return (Vec::new(), None) };
    let mut named: Vec<Explanation> = Vec::new();
    for one in &tried {
        // Of one mistake with several parameters, the first is named.
        let is_new = named.iter().all(|said| said.name != one.hypothesis.says.name);
        if one.missed == best.missed && one.weight.is_convincing() && is_new {
            named.push(one.weight.of_one(one.hypothesis));
        }
    }
    let nearest = named.is_empty().then(|| best.weight.of_one(best.hypothesis));
    (named, nearest)
}

/// A hypothesis with its weight on some answers, and how many it missed there and before.
struct Weighed<'h, 'a> {
    /// Answers that it does not predict, of those that count for its place.
    missed: u64,
    weight: Weight,
    hypothesis: &'h Hypothesis<'a>,
}

/// The best ones first; of equal ones, the one that was first stays so.
fn sort_by_missed(all: &mut [Weighed<'_, '_>]) {
    all.sort_by_key(|one| one.missed);
}

/// The first wrong ones and the first right ones of some answers, so many of each.
fn some_of_both(answers: &[usize], is_wrong: &[bool], count: usize) -> Vec<usize> {
    let mut some = Vec::new();
    for wrong in [true, false] {
        some.extend(answers.iter().filter(|i| is_wrong[**i] == wrong).take(count));
    }
    some
}

/// Keeps the first ones of each name, so many of them.
fn keep_of_names<T>(all: &mut Vec<T>, count: usize, name: impl Fn(&T) -> &'static str) {
    let mut of_names: BTreeMap<&str, usize> = BTreeMap::new();
    all.retain(|one| {
        let of_name = of_names.entry(name(one)).or_default();
        *of_name += 1;
        *of_name <= count
    });
}

/// Wrong answers by which the nearest hypotheses are found, and those of each of which one must be predicted.
const NEAREST_BY: usize = 60;
const NEAREST_OF_ONE: usize = 10;
/// Wrong answers that such a hypothesis predicts at least, and the part of them.
const LEAST_NEAR: u32 = 4;
const LEAST_PART: u32 = 12;
/// How many of these there are, and of one name.
const MOST_NEAR: usize = 24;
const NEAR_OF_ONE_NAME: usize = 3;

/// The hypotheses, of those that may be one, that predict most wrong answers, each others than those before it: parts of what a
/// program does, perhaps. Of an answer that shows nothing, whatever draws nothing is a part, so that these do not count.
pub(super) fn nearest(
    hypotheses: &[Hypothesis<'_>],
    is_wrong: &[bool],
    shows: &dyn Fn(usize) -> bool,
    may_be: &dyn Fn(usize) -> bool,
) -> Vec<usize> {
    // These are the first that all hypotheses were looked at by.
    let wrong = chosen_by(is_wrong).into_iter().filter(|&i| is_wrong[i] && shows(i));
    let wrong: Vec<usize> = wrong.take(NEAREST_BY).collect();
    // A part of what a program does need not explain most of it.
    let least = LEAST_NEAR.max(wrong.len() as u32 / LEAST_PART);
    // Which wrong answers each predicts, as bits.
    let mut near: Vec<(u64, usize)> = Vec::new();
    for (number, hypothesis) in hypotheses.iter().enumerate().filter(|(i, _)| may_be(*i)) {
        let mut predicted: u64 = 0;
        for (at, &i) in wrong.iter().enumerate() {
            // What predicts a twelfth of all predicts nearly as much of those so far.
            if at % NEAREST_OF_ONE == 0 && (predicted.count_ones() as usize) < at / NEAREST_OF_ONE {
                break;
            }
            predicted |= u64::from((hypothesis.predicts)(i)) << at;
        }
        let is_new = || near.iter().all(|(other, _)| *other != predicted);
        if predicted.count_ones() >= least && is_new() {
            near.push((predicted, number));
        }
    }
    near.sort_by_key(|(predicted, _)| std::cmp::Reverse(predicted.count_ones()));
    keep_of_names(&mut near, NEAR_OF_ONE_NAME, |(_, number)| hypotheses[*number].says.name);
    near.truncate(MOST_NEAR);
    near.into_iter().map(|(_, number)| number).collect()
}

/// The weights of hypotheses on some answers, the best first: with how many they missed, there and before. What is much worse
/// than the best one so far is left out.
fn weighed<'h, 'a>(
    hypotheses: Vec<Weighed<'h, 'a>>,
    answers: &[usize],
    is_wrong: &[bool],
) -> Vec<Weighed<'h, 'a>> {
    let mut best = answers.len() as u64;
    let mut all = Vec::new();
    for Weighed { missed, hypothesis, .. } in hypotheses {
        // What misses more than twice as many as the best one is not needed.
        let most = 2 * best + LEAST_WRONG as u64;
        let Some(weight) = Weight::of(hypothesis, answers, is_wrong, most) else { continue };
        best = best.min(weight.missed());
        all.push(Weighed { missed: missed + weight.missed(), weight, hypothesis });
    }
    sort_by_missed(&mut all);
    all
}

/// Every second of the wrong answers and of the right ones, so that both halves have both.
fn half(is_wrong: &[bool], among: &[usize], which: usize) -> Vec<usize> {
    let mut half = Vec::new();
    for wrong in [true, false] {
        half.extend(among.iter().filter(|i| is_wrong[**i] == wrong).skip(which).step_by(2));
    }
    half
}

/// The numbers of the answers that hypotheses are weighed by.
pub(super) fn fresh(is_wrong: &[bool], among: &[usize]) -> Vec<usize> {
    half(is_wrong, among, 1)
}

/// The numbers of the answers by which hypotheses are chosen, the wrong ones first: what is read off answers is read off these.
#[must_use]
pub fn chosen_by(is_wrong: &[bool]) -> Vec<usize> {
    half(is_wrong, &(0..is_wrong.len()).collect::<Vec<_>>(), 0)
}

/// How many of a few answers are not predicted; it stops where most are not.
fn look(hypothesis: &Hypothesis<'_>, few: &[usize], is_wrong: &[bool]) -> u64 {
    let mut missed = [0, 0];
    for (seen, &i) in few.iter().enumerate() {
        missed[usize::from(is_wrong[i])] += u64::from(!(hypothesis.predicts)(i));
        if missed[1] > LEAST_MISSED && 2 * missed[1] > seen as u64 {
            return (few.len() - seen) as u64 + missed[0] + missed[1];
        }
    }
    missed[0] + missed[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_hypothesis_says_of_an_answer_is_computed_once() {
        let calls = RefCell::new(BTreeMap::new());
        let says = |i: usize| i % 3 == 0 || i == 64;
        let predicts = remembered(|i| {
            *calls.borrow_mut().entry(i).or_insert(0) += 1;
            says(i)
        });
        // From the last word to the first and again, so that words are added and kept.
        for i in [200, 64, 31, 32, 33, 0, 1, 2, 63].into_iter().cycle().take(27) {
            assert_eq!(predicts(i), says(i), "{i}");
        }
        assert!(calls.borrow().len() == 9 && calls.borrow().values().all(|calls| *calls == 1));
    }
}
