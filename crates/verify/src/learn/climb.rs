//! The climb to a formula: from one formula to those that differ from it in one field, as long as they explain more.

/// Formulas that are changed in another field, round by round, and those whose guard is learned.
const FORMULAS: [usize; 6] = [12, 6, 4, 4, 4, 4];
pub(super) const GUARDED_FORMULAS: usize = 2;

/// The formulas of the largest worth so far, so many, the best first.
struct Best<F> {
    all: Vec<(f64, F)>,
    most: usize,
}

/// Formulas of the same worth that are kept: most of them are the same in other words.
const OF_A_WORTH: usize = 2;

impl<F: PartialEq> Best<F> {
    /// The worth below which a formula is not kept.
    fn least(&self) -> f64 {
        if self.all.len() < self.most { f64::MIN } else { self.all[self.most - 1].0 }
    }

    fn add(&mut self, worth: f64, formula: F) {
        let place = self.all.partition_point(|(other, _)| *other >= worth);
        let same = self.all[..place].iter().rev().take_while(|(other, _)| *other == worth);
        if place == self.most || same.clone().count() == OF_A_WORTH {
            return;
        }
        if same.clone().all(|(_, other)| *other != formula) {
            self.all.insert(place, (worth, formula));
            self.all.truncate(self.most);
        }
    }
}

/// Formulas of the largest worth: the best of one change, those of the best with another one, and so on while they get better.
/// `worth` need not be exact where it is below the number it is given.
pub(super) fn climbed<F: Copy + PartialEq>(
    start: F,
    neighbours: &dyn Fn(&F) -> Vec<F>,
    worth: &dyn Fn(&F, f64) -> f64,
) -> Vec<(f64, F)> {
    let mut best = Best { all: vec![(worth(&start, f64::MIN), start)], most: 1 };
    // Of these the neighbours were looked at.
    let mut done: Vec<F> = Vec::new();
    for wanted in FORMULAS {
        let mut more = Vec::new();
        for (_, formula) in &best.all {
            if !done.contains(formula) {
                more.extend(neighbours(formula));
                done.push(*formula);
            }
        }
        let before = best.all[0].0;
        best.all.truncate(wanted);
        best.most = wanted;
        for formula in more {
            let worth = worth(&formula, best.least());
            best.add(worth, formula);
        }
        if best.all[0].0 <= before {
            break;
        }
    }
    best.all.retain(|(_, formula)| *formula != start);
    best.all.truncate(GUARDED_FORMULAS);
    best.all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left before its worth is known changes nothing of what is found.
    #[test]
    fn formulas_below_the_least_are_left() {
        let neighbours = |v: &u64| (1..40).map(|by| v * 31 % 1009 + by * by).collect::<Vec<_>>();
        // Many have the same worth.
        let exact = |v: &u64| (v.wrapping_mul(0x9e37_79b9) >> 7 & 63) as f64 + (v / 500) as f64;
        let left = std::cell::Cell::new(0);
        for start in 0..50 {
            let all = climbed(start, &neighbours, &|v, _| exact(v));
            let some = climbed(start, &neighbours, &|v, least| match exact(v) < least {
                true => {
                    left.set(left.get() + 1);
                    least - 1.0
                }
                false => exact(v),
            });
            assert_eq!(all, some, "{start}");
            assert_eq!(all.len(), GUARDED_FORMULAS, "{start}");
        }
        assert!(left.get() > 1000, "{}", left.get());
    }
}
