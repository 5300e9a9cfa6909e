//! Chains of steps, which explain what a program does: a step is a change, and the conditions under which it is done.

use rasterproof_verify::learn::rows::{Condition, Quantities};

use super::learnable::{AnyChange, AnyParts, LearnedCase};

/// A change with the conditions under which a program does it: any of them, or always where there are none.
#[derive(Clone)]
pub(super) struct GuardedChange {
    pub(super) when: Vec<Condition>,
    pub(super) change: AnyChange,
}

/// The first change whose condition holds is done; what is right where none does.
pub(super) type Chain = Vec<GuardedChange>;

/// How much a chain says: its steps and their facts.
pub(super) fn cost(chain: &Chain) -> usize {
    // A step counts as one, and each fact of its conditions as another.
    let mut said = chain.len();
    for condition in chain.iter().flat_map(|step| &step.when) {
        said += condition.count();
    }
    said
}

/// The row of a part: the quantities of its question, and its own.
pub(super) fn row(
    asked: &LearnedCase,
    parts: &dyn AnyParts<'_>,
    place: usize,
    change: Option<&AnyChange>,
) -> Vec<i64> {
    let mut out = Quantities::after(asked.facts.clone());
    parts.of_part(place, change, &mut out);
    out.values
}

/// Whether a program that follows a chain gives the part of its answer that is meant.
pub(super) fn predicts(
    chain: &[GuardedChange],
    asked: &LearnedCase,
    parts: &dyn AnyParts<'_>,
    place: usize,
) -> bool {
    let Some((first, rest)) = chain.split_first() else { return parts.is_right(place) };
    let with = parts.explains(&first.change, place);
    let without = predicts(rest, asked, parts, place);
    // A row takes long to compute, so a condition is looked at only where it decides something.
    if with == without || first.when.is_empty() {
        return with;
    }
    let row = row(asked, parts, place, Some(&first.change));
    let is_done = first.when.iter().any(|condition| condition.holds(&row));
    if is_done { with } else { without }
}

/// All chains that say one thing less.
pub(super) fn shorter(chain: &Chain) -> Vec<Chain> {
    let mut all = Vec::new();
    for i in 0..chain.len() {
        // Without a step.
        let mut less = chain.clone();
        less.remove(i);
        all.push(less);
        for (j, condition) in chain[i].when.iter().enumerate() {
            // Without a condition of a step.
            let mut less = chain.clone();
            less[i].when.remove(j);
            all.push(less);
            if condition.count() == 1 {
                continue;
            }
            // Without a fact of a condition.
            for k in 0..condition.count() {
                let mut less = chain.clone();
                less[i].when[j] = condition.without(k);
                all.push(less);
            }
        }
    }
    all
}
