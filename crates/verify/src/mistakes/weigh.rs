//! Weighs hypotheses by the answers: those that explain what is wrong without predicting faults that are not there.

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
        let enough = |count: &Count| 100 * count.drawn >= 99 * count.of;
        self.wrong.of > 0 && enough(&self.wrong) && enough(&self.right)
    }
}

/// Looks at all hypotheses and at those that are left of them: how many wrong answers and as many right ones are tried, how
/// many hypotheses are kept, and how many of one name at most.
const LOOKS: [(usize, usize, usize); 2] = [(16, 160, 80), (40, 60, 30)];
/// Of these, those that are tried on answers that they were not chosen by.
const TRIED: usize = 24;
/// Wrong answers that may be missed at a look, although they are most.
const LEAST_MISSED: usize = 2;
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
    let mut left: Vec<_> = hypotheses.iter().collect();
    for (answers, kept, of_one_name) in LOOKS {
        let some = |wrong: bool| fitted.iter().copied().filter(move |&i| is_wrong[i] == wrong);
        let few: Vec<usize> = some(true).take(answers).chain(some(false).take(answers)).collect();
        left.sort_by_cached_key(|hypothesis| look(hypothesis, &few, is_wrong));
        let mut of_names: BTreeMap<&str, usize> = BTreeMap::new();
        left.retain(|hypothesis| {
            let of_name = of_names.entry(hypothesis.says.name).or_default();
            *of_name += 1;
            *of_name <= of_one_name
        });
        left.truncate(kept);
    }
    let left = left.into_iter().map(|hypothesis| (0, hypothesis)).collect();
    let scored = weighed(left, &fitted, is_wrong);
    let scored = scored.into_iter().map(|(missed, _, hypothesis)| (missed, hypothesis));
    let tried = weighed(scored.take(TRIED).collect(), &fresh, is_wrong);
    let Some(&(least, ..)) = tried.first() else { return (Vec::new(), None) };
    let mut named: Vec<Explanation> = Vec::new();
    for (missed, weight, hypothesis) in &tried {
        let is_new = named.iter().all(|said| said.name != hypothesis.says.name);
        if *missed == least && weight.is_convincing() && is_new {
            named.push(weight.of_one(hypothesis));
        }
    }
    let nearest = tried.first().map(|(_, weight, hypothesis)| weight.of_one(hypothesis));
    let nearest = nearest.filter(|_| named.is_empty());
    (named, nearest)
}

/// Wrong answers by which the nearest hypotheses are found, and those of them that are looked at first.
const NEAREST_BY: usize = 60;
const NEAREST_FIRST: usize = 10;
/// Wrong answers that such a hypothesis predicts at least, and the part of them.
const LEAST_NEAR: u32 = 4;
const LEAST_PART: u32 = 12;
/// How many of these there are, and of one name.
const MOST_NEAR: usize = 24;
const NEAR_OF_ONE_NAME: usize = 3;

/// The hypotheses, of those that may be one, that predict most wrong answers, each others than those before it: parts of what a
/// program does, perhaps.
pub(super) fn nearest(
    hypotheses: &[Hypothesis<'_>],
    is_wrong: &[bool],
    may_be: &dyn Fn(usize) -> bool,
) -> Vec<usize> {
    let wrong = chosen_by(is_wrong).into_iter().filter(|&i| is_wrong[i]);
    let wrong: Vec<usize> = wrong.take(NEAREST_BY).collect();
    let least = LEAST_NEAR.max(wrong.len() as u32 / LEAST_PART);
    // Which wrong answers each predicts, as bits.
    let mut near: Vec<(u64, usize)> = Vec::new();
    for (number, hypothesis) in hypotheses.iter().enumerate().filter(|(i, _)| may_be(*i)) {
        let mut predicted = 0;
        for (at, &i) in wrong.iter().enumerate() {
            if at == NEAREST_FIRST && predicted == 0 {
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
    let mut of_names: BTreeMap<&str, usize> = BTreeMap::new();
    near.retain(|(_, number)| {
        let of_name = of_names.entry(hypotheses[*number].says.name).or_default();
        *of_name += 1;
        *of_name <= NEAR_OF_ONE_NAME
    });
    near.truncate(MOST_NEAR);
    near.into_iter().map(|(_, number)| number).collect()
}

/// The weights of hypotheses on some answers, the best first: with how many they missed, there and before. What is much worse
/// than the best one so far is left out.
fn weighed<'h, 'a>(
    hypotheses: Vec<(u64, &'h Hypothesis<'a>)>,
    answers: &[usize],
    is_wrong: &[bool],
) -> Vec<(u64, Weight, &'h Hypothesis<'a>)> {
    let mut best = answers.len() as u64;
    let mut all = Vec::new();
    for (missed, hypothesis) in hypotheses {
        let most = 2 * best + LEAST_WRONG as u64;
        let Some(weight) = Weight::of(hypothesis, answers, is_wrong, most) else { continue };
        best = best.min(weight.missed());
        all.push((missed + weight.missed(), weight, hypothesis));
    }
    all.sort_by_key(|(missed, ..)| *missed);
    all
}

/// Every second of the wrong answers and of the right ones, so that both halves have both.
fn half(is_wrong: &[bool], among: &[usize], which: usize) -> Vec<usize> {
    let of =
        |wrong| among.iter().copied().filter(move |&i| is_wrong[i] == wrong).skip(which).step_by(2);
    of(true).chain(of(false)).collect()
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
fn look(hypothesis: &Hypothesis<'_>, few: &[usize], is_wrong: &[bool]) -> usize {
    let mut missed = [0, 0];
    for (seen, &i) in few.iter().enumerate() {
        missed[usize::from(is_wrong[i])] += usize::from(!(hypothesis.predicts)(i));
        if missed[1] > LEAST_MISSED && 2 * missed[1] > seen {
            return few.len() - seen + missed[0] + missed[1];
        }
    }
    missed[0] + missed[1]
}
