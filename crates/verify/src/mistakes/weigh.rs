//! Weighs hypotheses by the answers: those that explain what is wrong without predicting faults that are not there.

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
    fn of(hypothesis: &Hypothesis<'_>, questions: &[usize], is_wrong: &[bool]) -> Self {
        let mut weight = Self::default();
        for &i in questions {
            let count = if is_wrong[i] { &mut weight.wrong } else { &mut weight.right };
            count.add((hypothesis.predicts)(i));
        }
        weight
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

/// Answers that a hypothesis is first tried on, of the wrong and of the right ones.
const FEW: usize = 16;
/// Hypotheses that are tried on all answers.
const KEPT: usize = 60;
/// Of these, those that are tried on answers that they were not chosen by.
const TRIED: usize = 24;
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
    let all = |wrong: bool| among.iter().copied().filter(move |&i| is_wrong[i] == wrong);
    if all(true).count() < LEAST_WRONG {
        return (Vec::new(), None);
    }
    // Every second of the wrong ones and of the right ones, so that both halves have both.
    let half = |which: usize| -> Vec<usize> {
        let of = |wrong| all(wrong).skip(which).step_by(2);
        of(true).chain(of(false)).collect()
    };
    let (fitted, fresh) = (half(0), half(1));
    let some =
        |wrong: bool| fitted.iter().copied().filter(move |&i| is_wrong[i] == wrong).take(FEW);
    let few: Vec<usize> = some(true).chain(some(false)).collect();
    let mut scored: Vec<_> = hypotheses
        .iter()
        .map(|hypothesis| (first_look(hypothesis, &few, is_wrong), hypothesis))
        .collect();
    scored.sort_by_key(|(missed, _)| *missed);
    scored.truncate(KEPT);
    let mut scored: Vec<_> = scored
        .into_iter()
        .map(|(_, hypothesis)| (Weight::of(hypothesis, &fitted, is_wrong).missed(), hypothesis))
        .collect();
    scored.sort_by_key(|(missed, _)| *missed);
    scored.truncate(TRIED);
    let mut tried: Vec<_> = scored
        .into_iter()
        .map(|(missed, hypothesis)| {
            let weight = Weight::of(hypothesis, &fresh, is_wrong);
            (missed + weight.missed(), weight, hypothesis)
        })
        .collect();
    tried.sort_by_key(|(missed, ..)| *missed);
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

/// How many of a few answers are not predicted; it stops where most are not.
fn first_look(hypothesis: &Hypothesis<'_>, few: &[usize], is_wrong: &[bool]) -> usize {
    let mut missed = [0, 0];
    for (seen, &i) in few.iter().enumerate() {
        missed[usize::from(is_wrong[i])] += usize::from(!(hypothesis.predicts)(i));
        if missed[1] > FEW / 4 && 2 * missed[1] > seen {
            return few.len() - seen + missed[0] + missed[1];
        }
    }
    missed[0] + missed[1]
}
