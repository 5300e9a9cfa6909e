//! Which classes occurred together: the pairs and the triples.

/// Words of 64 bits for the classes of a topic: at most 192.
const WORDS: usize = 3;
/// Some classes, one bit each.
type Bits = [u64; WORDS];

/// The pairs and the triples of classes that some questions had. Classes of all facts are numbered one after the other, and of a
/// question they are given in ascending order.
pub(super) struct Table {
    /// How many classes there are.
    all: usize,
    /// Of each class the smaller ones that it occurred with.
    pairs: Vec<Bits>,
    /// Likewise of each pair of classes; see [`Self::pair`].
    triples: Vec<Bits>,
}

/// The bit of a class.
fn bit(class: u16) -> (usize, u64) {
    (usize::from(class / 64), 1 << (class % 64))
}

/// How many of some bits are not among others.
fn missing(wanted: &Bits, known: &Bits) -> usize {
    let rest: Bits = std::array::from_fn(|word| wanted[word] & !known[word]);
    // Mostly none is missing, and counting takes longer.
    if rest == [0; WORDS] { 0 } else { rest.iter().map(|word| word.count_ones() as usize).sum() }
}

fn insert(new: &Bits, known: &mut Bits) {
    for (new, known) in new.iter().zip(known) {
        *known |= new;
    }
}

impl Table {
    pub(super) fn new(all: usize) -> Self {
        assert!(all <= 64 * WORDS, "{all} classes are more than the words hold");
        let none = [0; WORDS];
        Self { all, pairs: vec![none; all], triples: vec![none; all * all] }
    }

    /// The number of a pair of classes.
    fn pair(&self, first: u16, second: u16) -> usize {
        usize::from(second) * self.all + usize::from(first)
    }

    /// Whether two classes occurred together, or three, in ascending order.
    pub(super) fn has(&self, classes: &[u16]) -> bool {
        let (row, first) = match *classes {
            [first, second] => (&self.pairs[usize::from(second)], first),
            [first, second, third] => (&self.triples[self.pair(second, third)], first),
            _ => return false,
        };
        let (word, bit) = bit(first);
        row[word] & bit != 0
    }

    /// How many pairs a question has that are missing.
    pub(super) fn missing_pairs(&self, classes: &[u16]) -> usize {
        let mut count = 0;
        let mut smaller = [0; WORDS];
        for &class in classes {
            count += missing(&smaller, &self.pairs[usize::from(class)]);
            let (word, bit) = bit(class);
            smaller[word] |= bit;
        }
        count
    }

    /// How many triples a question has that are missing.
    pub(super) fn missing_triples(&self, classes: &[u16]) -> usize {
        let mut count = 0;
        for (at, &third) in classes.iter().enumerate() {
            let mut smaller = [0; WORDS];
            for &second in &classes[..at] {
                count += missing(&smaller, &self.triples[self.pair(second, third)]);
                let (word, bit) = bit(second);
                smaller[word] |= bit;
            }
        }
        count
    }

    /// Notes the pairs and the triples of a question.
    pub(super) fn note(&mut self, classes: &[u16]) {
        for (at, &third) in classes.iter().enumerate() {
            let mut smaller = [0; WORDS];
            for &second in &classes[..at] {
                let pair = self.pair(second, third);
                insert(&smaller, &mut self.triples[pair]);
                let (word, bit) = bit(second);
                smaller[word] |= bit;
            }
            insert(&smaller, &mut self.pairs[usize::from(third)]);
        }
    }

    /// How many pairs occurred, and how many triples.
    pub(super) fn counts(&self) -> [usize; 2] {
        [&self.pairs, &self.triples]
            .map(|rows| rows.iter().flatten().map(|bits| bits.count_ones() as usize).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_and_triples_of_two_questions() {
        let mut table = Table::new(6);
        let missing =
            |table: &Table, of: &[u16]| [table.missing_pairs(of), table.missing_triples(of)];
        assert_eq!(missing(&table, &[0, 2, 4]), [3, 1]);
        table.note(&[0, 2, 4]);
        // One fact differs: two pairs are new, and the triple.
        assert_eq!(missing(&table, &[0, 2, 5]), [2, 1]);
        table.note(&[0, 2, 5]);
        assert_eq!(table.counts(), [5, 2]);
        assert!(
            table.has(&[0, 2])
                && table.has(&[0, 2, 5])
                && !table.has(&[0, 3])
                && !table.has(&[0, 3, 5])
        );
        assert_eq!(missing(&table, &[0, 2, 4]), [0, 0]);
    }
}
