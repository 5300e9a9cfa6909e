//! Which classes occurred together: the pairs and the triples.

/// The pairs and the triples of classes that some questions had. Classes of all facts are numbered one after the other, and of a
/// question they are given in ascending order.
pub(super) struct Table {
    /// How many classes there are.
    all: usize,
    /// Rows of the larger number, columns of the smaller one.
    pairs: Vec<bool>,
    /// One bit for each triple, since there are millions.
    triples: Vec<u64>,
}

/// How many pairs and triples a question has that are missing; pairs count first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Gain {
    pairs: usize,
    triples: usize,
}

impl Table {
    pub(super) fn new(all: usize) -> Self {
        Self { all, pairs: vec![false; all * all], triples: vec![0; all * all * all / 64 + 1] }
    }

    /// Whether two classes occurred together, or three, in ascending order.
    pub(super) fn has(&self, classes: &[u16]) -> bool {
        match *classes {
            [first, second] => self.pairs[usize::from(second) * self.all + usize::from(first)],
            [first, second, third] => {
                let row = usize::from(third) * self.all + usize::from(second);
                let place = row * self.all + usize::from(first);
                self.triples[place / 64] >> (place % 64) & 1 == 1
            }
            _ => false,
        }
    }

    /// How many pairs a question has that are missing.
    pub(super) fn missing_pairs(&self, classes: &[u16]) -> usize {
        let mut missing = 0;
        for (at, &second) in classes.iter().enumerate() {
            let row = usize::from(second) * self.all;
            for &first in &classes[..at] {
                missing += usize::from(!self.pairs[row + usize::from(first)]);
            }
        }
        missing
    }

    /// How much a question has that is missing.
    pub(super) fn gain(&self, classes: &[u16]) -> Gain {
        let mut gain = Gain { pairs: 0, triples: 0 };
        for (at, &third) in classes.iter().enumerate() {
            for (before, &second) in classes[..at].iter().enumerate() {
                let row = usize::from(third) * self.all + usize::from(second);
                gain.pairs += usize::from(!self.pairs[row]);
                for &first in &classes[..before] {
                    let place = row * self.all + usize::from(first);
                    gain.triples += usize::from(self.triples[place / 64] >> (place % 64) & 1 == 0);
                }
            }
        }
        gain
    }

    /// Notes the pairs and the triples of a question.
    pub(super) fn note(&mut self, classes: &[u16]) {
        for (at, &third) in classes.iter().enumerate() {
            for (before, &second) in classes[..at].iter().enumerate() {
                let row = usize::from(third) * self.all + usize::from(second);
                self.pairs[row] = true;
                for &first in &classes[..before] {
                    let place = row * self.all + usize::from(first);
                    self.triples[place / 64] |= 1 << (place % 64);
                }
            }
        }
    }

    /// How many pairs occurred, and how many triples.
    pub(super) fn counts(&self) -> [usize; 2] {
        let pairs = self.pairs.iter().filter(|is_there| **is_there).count();
        [pairs, self.triples.iter().map(|bits| bits.count_ones() as usize).sum()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_and_triples_of_two_questions() {
        let mut table = Table::new(6);
        assert_eq!(table.gain(&[0, 2, 4]), Gain { pairs: 3, triples: 1 });
        table.note(&[0, 2, 4]);
        // One fact differs: two pairs are new, and the triple.
        assert_eq!(table.gain(&[0, 2, 5]), Gain { pairs: 2, triples: 1 });
        table.note(&[0, 2, 5]);
        assert_eq!(table.counts(), [5, 2]);
        assert!(
            table.has(&[0, 2])
                && table.has(&[0, 2, 5])
                && !table.has(&[0, 3])
                && !table.has(&[0, 3, 5])
        );
        assert!(table.gain(&[0, 3, 5]) > table.gain(&[0, 2, 4]));
    }
}
