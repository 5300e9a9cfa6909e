//! Which classes occurred together: pairs, triples and larger combinations.

/// Words of 64 bits for the classes of a topic: at most 192.
const WORDS: usize = 3;
/// Some classes, one bit each.
type Bits = [u64; WORDS];
/// The classes of the largest combinations.
const LARGEST: usize = 4;

/// The combinations of classes that some questions had, of two classes and of more. Classes of all facts are numbered one after the
/// other, and of a question they are given in ascending order.
pub(super) struct Table {
    /// For each class c the number of ways to choose 1, 2 and 3 of the classes below c, by which rows are numbered.
    ways: Vec<[usize; LARGEST]>,
    /// The combinations of two classes, of three, and so on. A row belongs to all classes of a combination but the smallest one, and
    /// has the smallest ones that these occurred with.
    rows: Vec<Vec<Bits>>,
}

/// The bit of a class.
fn bit(class: u16) -> (usize, u64) {
    (usize::from(class / 64), 1 << (class % 64))
}

/// For each class of a question the classes before it.
fn smaller(classes: &[u16]) -> Vec<Bits> {
    let mut before = [0; WORDS];
    let mut all = Vec::with_capacity(classes.len());
    for &class in classes {
        all.push(before);
        let (word, bit) = bit(class);
        before[word] |= bit;
    }
    all
}

impl Table {
    /// A table of combinations of up to so many classes, of a topic that has `all`.
    pub(super) fn new(all: usize, largest: usize) -> Self {
        assert!(all <= 64 * WORDS, "{all} classes are more than the words hold");
        let mut ways = vec![[1, 0, 0, 0]];
        for class in 0..all {
            // Pascal's triangle: the new class is chosen, or it is not.
            let below = ways[class];
            let mut next = below;
            for chosen in 1..LARGEST {
                next[chosen] += below[chosen - 1];
            }
            ways.push(next);
        }
        let rows = (1..largest).map(|chosen| vec![[0; WORDS]; ways[all][chosen]]).collect();
        Self { ways, rows }
    }

    /// How many of a question's combinations are not among the rows of those of `left` classes and the smallest one. The rows
    /// begin at that of the larger classes that were chosen.
    fn missing_in(&self, rows: &[Bits], classes: &[u16], smaller: &[Bits], left: usize) -> usize {
        let mut count = 0;
        if left > 1 {
            // The largest class first; the others are below it, and so is the smallest of the combination.
            for at in left..classes.len() {
                let rows = &rows[self.ways[usize::from(classes[at])][left]..];
                count += self.missing_in(rows, &classes[..at], smaller, left - 1);
            }
            return count;
        }
        // One class more: its number is that of its row.
        for (&class, wanted) in classes.iter().zip(smaller).skip(1) {
            let known = &rows[usize::from(class)];
            let ([a, b, c], [x, y, z]) = (wanted, known);
            let rest = [a & !x, b & !y, c & !z];
            // Mostly none is missing, and counting takes longer.
            if rest != [0; WORDS] {
                for word in rest {
                    count += word.count_ones() as usize;
                }
            }
        }
        count
    }

    /// Inserts a question's combinations into the same rows.
    fn note_in(&self, rows: &mut [Bits], classes: &[u16], smaller: &[Bits], left: usize) {
        if left > 1 {
            for at in left..classes.len() {
                let rows = &mut rows[self.ways[usize::from(classes[at])][left]..];
                self.note_in(rows, &classes[..at], smaller, left - 1);
            }
            return;
        }
        for (&class, new) in classes.iter().zip(smaller).skip(1) {
            let known = &mut rows[usize::from(class)];
            for word in 0..WORDS {
                known[word] |= new[word];
            }
        }
    }

    /// Whether some classes occurred together, in ascending order.
    pub(super) fn has(&self, classes: &[u16]) -> bool {
        let Some((&smallest, others)) = classes.split_first() else { return false };
        let Some(chosen) = others.len().checked_sub(1) else { return false };
        let of_class = |(at, class): (usize, &u16)| self.ways[usize::from(*class)][at + 1];
        let row: usize = others.iter().enumerate().map(of_class).sum();
        let (word, bit) = bit(smallest);
        self.rows[chosen][row][word] & bit != 0
    }

    /// How many combinations of so many classes a question has that are missing.
    pub(super) fn missing(&self, together: usize, classes: &[u16]) -> usize {
        self.missing_in(&self.rows[together - 2], classes, &smaller(classes), together - 1)
    }

    /// Notes the combinations of a question.
    pub(super) fn note(&mut self, classes: &[u16]) {
        let smaller = smaller(classes);
        let mut all = std::mem::take(&mut self.rows);
        for (at, rows) in all.iter_mut().enumerate() {
            self.note_in(rows, classes, &smaller, at + 1);
        }
        self.rows = all;
    }

    /// How many combinations of so many classes occurred.
    pub(super) fn count(&self, together: usize) -> usize {
        self.rows[together - 2].iter().flatten().map(|bits| bits.count_ones() as usize).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_of_two_questions() {
        let mut table = Table::new(8, 4);
        let missing = |table: &Table, of: &[u16]| [2, 3, 4].map(|n| table.missing(n, of));
        assert_eq!(missing(&table, &[0, 2, 4, 6]), [6, 4, 1]);
        table.note(&[0, 2, 4, 6]);
        // One fact differs: three pairs are new, three triples, and the quadruple.
        assert_eq!(missing(&table, &[0, 2, 5, 6]), [3, 3, 1]);
        table.note(&[0, 2, 5, 6]);
        assert_eq!([2, 3, 4].map(|n| table.count(n)), [9, 7, 2]);
        for known in [&[0, 2][..], &[0, 2, 5], &[2, 5, 6], &[0, 2, 4, 6], &[0, 2, 5, 6]] {
            assert!(table.has(known), "{known:?}");
        }
        for unknown in [&[0, 3][..], &[0, 3, 5], &[0, 4, 5], &[0, 2, 4, 5], &[0, 2, 4, 7]] {
            assert!(!table.has(unknown), "{unknown:?}");
        }
        assert_eq!(missing(&table, &[0, 2, 4, 6]), [0, 0, 0]);
    }

    /// A row for each choice of classes, and no two choices in one.
    #[test]
    fn every_combination_has_its_own_place() {
        let classes: Vec<u16> = (0..10).collect();
        let mut table = Table::new(10, 4);
        for a in 0..7 {
            table.note(&[a, a + 1, a + 2, a + 3]);
        }
        let known = |of: &[u16]| of[of.len() - 1] - of[0] <= 3;
        for d in 0..classes.len() {
            for c in 0..d {
                for b in 0..c {
                    for a in 0..b {
                        let all = [classes[a], classes[b], classes[c], classes[d]];
                        for of in [&all[..2], &all[..3], &all[..]] {
                            assert_eq!(table.has(of), known(of), "{of:?}");
                        }
                    }
                }
            }
        }
    }
}
