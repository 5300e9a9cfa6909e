//! The learner: the shortest conjunction of facts that is true of most of some rows and of none of others.
//!
//! A fact is a quantity with a test. The facts of all rows are a matrix of bits, so that a conjunction is an AND and its
//! worth is a count of bits (as in CN2 and RIPPER, with a beam).

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::HashSet;

use super::quantity::{NONE, Name, RATIO};
use super::question::Unit;
use super::trial::Work;

/// A quantity, or one compared with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Of {
    One(usize),
    /// The first less the second.
    Difference(usize, usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Test {
    Is(i64),
    IsNot(i64),
    AtMost(i64),
    AtLeast(i64),
    /// The remainder of a division by the first number is the second.
    Remainder(i64, i64),
    /// It is no multiple.
    NoMultiple(i64),
    /// Whether it lies in the second half of a group of so many.
    InSecondHalf(i64, bool),
}

/// A fact: a quantity with a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Fact {
    pub(super) of: Of,
    pub(super) test: Test,
}

impl Fact {
    /// The quantity that has a limit, with it.
    pub(super) fn limit(&self) -> Option<(usize, i64)> {
        match (self.of, self.test) {
            (Of::One(i), Test::AtMost(limit) | Test::AtLeast(limit)) => Some((i, limit)),
            _ => None,
        }
    }
}

impl Of {
    pub(super) fn value(self, row: &[i64]) -> i64 {
        match self {
            Self::One(i) => row[i],
            Self::Difference(i, j) if row[i] == NONE || row[j] == NONE => NONE,
            Self::Difference(i, j) => row[i] - row[j],
        }
    }
}

impl Test {
    fn holds(self, value: i64) -> bool {
        value != NONE
            && match self {
                Self::Is(v) => value == v,
                Self::IsNot(v) => value != v,
                Self::AtMost(v) => value <= v,
                Self::AtLeast(v) => value >= v,
                Self::Remainder(by, rest) => value.rem_euclid(by) == rest,
                Self::NoMultiple(by) => value.rem_euclid(by) != 0,
                Self::InSecondHalf(by, is_second) => (value & (by / 2) != 0) == is_second,
            }
    }

    /// The values that it holds of, as bits. One loop for each test, which the compiler turns into vectors.
    fn bits(self, values: &[i64]) -> Vec<u64> {
        match self {
            Self::Is(v) => bits(values, |value| value == v),
            Self::IsNot(v) => bits(values, |value| value != v),
            Self::AtMost(v) => bits(values, |value| value <= v),
            Self::AtLeast(v) => bits(values, |value| value >= v),
            // Divisors are powers of two.
            Self::Remainder(by, rest) => bits(values, |value| value & (by - 1) == rest),
            Self::NoMultiple(by) => bits(values, |value| value & (by - 1) != 0),
            Self::InSecondHalf(by, is_second) => {
                bits(values, |value| (value & (by / 2) != 0) == is_second)
            }
        }
    }
}

fn bits(values: &[i64], holds: impl Fn(i64) -> bool) -> Vec<u64> {
    let word = |chunk: &[i64]| {
        let places = chunk.iter().zip(0..);
        places.fold(0, |word, (&v, at)| word | u64::from((v != NONE) & holds(v)) << at)
    };
    values.chunks(64).map(word).collect()
}

impl Fact {
    pub(super) fn holds(&self, row: &[i64]) -> bool {
        self.test.holds(self.of.value(row))
    }

    /// What it costs to say it: of two that explain as much, the simpler one is said.
    fn cost(&self, names: &[Name]) -> f64 {
        let of = match self.of {
            Of::One(i) => match names[i].unit {
                Unit::Flag => 1.0,
                Unit::Count | Unit::Paired | Unit::Pixels => 1.03,
                Unit::Subpixels | Unit::Length | Unit::Area | Unit::Ratio | Unit::Value => 1.06,
                Unit::Involved => 1.2,
            },
            Of::Difference(..) => 1.15,
        };
        let test = match self.test {
            Test::Is(_) => 1.0,
            Test::AtMost(_) | Test::AtLeast(_) | Test::Remainder(2, _) => 1.01,
            Test::Remainder(..) | Test::NoMultiple(_) | Test::InSecondHalf(..) => 1.03,
            Test::IsNot(_) => 1.05,
        };
        of * test
    }
}

/// Facts that all hold.
pub(super) type Conjunction = Vec<Fact>;

pub(super) fn all_hold(facts: &[Fact], row: &[i64]) -> bool {
    facts.iter().all(|fact| fact.holds(row))
}

/// Rows of values: those that a rule should hold of, and those that it must not hold of.
#[derive(Default)]
pub(super) struct Table {
    pub(super) yes: Vec<Vec<i64>>,
    pub(super) no: Vec<Vec<i64>>,
    /// The question that each of the first comes from.
    pub(super) groups: Vec<usize>,
}

/// What a rule must be.
#[derive(Clone, Copy)]
pub(super) struct Terms {
    /// The most facts.
    pub(super) most: usize,
    /// Questions that it must hold in.
    pub(super) need: usize,
    /// Rows of `no` that it may hold of, of a thousand of `yes`.
    pub(super) slack: usize,
    /// How many rules are wanted.
    pub(super) wanted: usize,
}

/// A rule that was found.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) facts: Conjunction,
    /// Rows of `yes` that it holds of.
    pub(super) rows: usize,
    value: f64,
}

/// Rows that are looked at: all are checked in the end.
const MOST_YES: usize = 960;
const MOST_NO: usize = 1440;
/// Rules that violate a row bring it into the rows that are looked at.
const ROUNDS: usize = 4;
const MOST_VIOLATIONS: usize = 400;
/// Conjunctions that are grown by another fact.
const BEAM: usize = 50;
/// What another fact costs.
const LONGER: f64 = 0.86;
/// Facts that are combined with each other.
const MOST_FACTS: usize = 900;

/// The values of some rows by quantity, so that a test of all rows is one loop. Rows are many, and only the quantities of the
/// rules that are found are looked at in all of them: these are collected once each.
struct Values<'a> {
    rows: &'a [Vec<i64>],
    collected: Vec<OnceCell<Vec<i64>>>,
}

impl<'a> Values<'a> {
    fn of(quantities: usize, rows: &'a [Vec<i64>]) -> Self {
        Self { rows, collected: vec![OnceCell::new(); quantities] }
    }

    fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Every quantity of some rows.
    fn some(&self, rows: &[usize]) -> Vec<Tested> {
        let mut all = vec![Vec::with_capacity(rows.len()); self.collected.len()];
        for &row in rows {
            for (values, value) in all.iter_mut().zip(&self.rows[row]) {
                values.push(*value);
            }
        }
        all.into_iter().map(Tested::new).collect()
    }

    /// A quantity of all rows.
    fn one(&self, i: usize) -> &[i64] {
        self.collected[i].get_or_init(|| self.rows.iter().map(|row| row[i]).collect())
    }

    /// The same, or how much it differs from another one.
    fn all(&self, of: Of) -> Cow<'_, [i64]> {
        match of {
            Of::One(i) => self.one(i).into(),
            Of::Difference(i, j) => {
                self.one(i).iter().zip(self.one(j)).map(|(a, b)| difference(*a, *b)).collect()
            }
        }
    }

    /// The rows that some facts hold of.
    fn held(&self, facts: &[Fact]) -> Vec<u64> {
        let mut held = ones(self.rows());
        for fact in facts {
            held = both(&held, &fact.test.bits(&self.all(fact.of)));
        }
        held
    }
}

fn difference(a: i64, b: i64) -> i64 {
    if a == NONE || b == NONE { NONE } else { a - b }
}

/// The places of the bits that are set.
fn places(bits: &[u64]) -> impl Iterator<Item = usize> {
    let is_set = |i: &usize| bits[i / 64] >> (i % 64) & 1 == 1;
    (0..64 * bits.len()).filter(is_set)
}

/// The best rules: each the best for the rows that those before do not hold of.
pub(super) fn best(names: &[Name], table: &Table, terms: Terms, work: &Work) -> Vec<Rule> {
    work.spend(names.len() * (table.yes.len() + table.no.len()) / VALUES_A_STEP);
    let [with, without] = [&table.yes, &table.no].map(|rows| Values::of(names.len(), rows));
    let mut all = Vec::new();
    let mut left: Vec<usize> = (0..table.yes.len()).collect();
    for _ in 0..terms.wanted {
        let rule = best_of(names, [&with, &without], &table.groups, (terms, work), &left);
        let Some(mut rule) = rule else { break };
        let held = with.held(&rule.facts);
        left.retain(|i| held[i / 64] >> (i % 64) & 1 == 0);
        rule.rows = count(&held);
        all.push(rule);
    }
    all
}

/// The best rule for some rows. It is searched for among a part of them; a rule that another row refutes brings this row in.
fn best_of(
    names: &[Name],
    [with, without]: [&Values<'_>; 2],
    groups: &[usize],
    (terms, work): (Terms, &Work),
    left: &[usize],
) -> Option<Rule> {
    let yes: Vec<usize> = spread(left.len(), MOST_YES).into_iter().map(|i| left[i]).collect();
    let mut no = spread(without.rows(), MOST_NO);
    let mut tested = with.some(&yes);
    let mut is_left = vec![0; left.len().max(with.rows()).div_ceil(64)];
    left.iter().for_each(|i| is_left[i / 64] |= 1 << (i % 64));
    for _ in 0..ROUNDS {
        let mut refuting = Vec::new();
        let matrix = Matrix::of(names, [&mut tested, &mut without.some(&no)], work);
        for mut rule in matrix.search(terms, work) {
            sharpen(&mut rule.facts, names, [with, without]);
            let held = both(&with.held(&rule.facts), &is_left);
            let bad = without.held(&rule.facts);
            rule.rows = count(&held);
            let is_refuted = count(&bad) * 1000 > terms.slack * rule.rows * 3 / 2;
            if !is_refuted && distinct(places(&held).map(|i| groups[i])) >= terms.need {
                return Some(rule);
            }
            if is_refuted {
                refuting.extend(places(&bad).take(MOST_VIOLATIONS));
            }
        }
        let before = no.len();
        no.extend(refuting);
        no.sort_unstable();
        no.dedup();
        if no.len() == before {
            break;
        }
    }
    None
}

/// Facts that hold of every row of `yes`, each of which leaves out as many rows of `no` as it can; and how many of these are
/// left.
pub(super) fn common(names: &[Name], table: &Table, most: usize) -> (Conjunction, usize) {
    let [with, without] = [&table.yes, &table.no].map(|rows| Values::of(names.len(), rows));
    let (yes, no) = (spread(with.rows(), MOST_YES), spread(without.rows(), MOST_NO));
    let mut facts = Conjunction::new();
    let mut left = without.rows();
    if yes.is_empty() || no.is_empty() {
        return (facts, left);
    }
    let mut some = [with.some(&yes), without.some(&no)];
    let matrix = Matrix::of(names, some.each_mut(), &Work::default());
    let mut candidates: Vec<&Column> =
        matrix.columns.iter().filter(|c| count(&c.yes) == yes.len()).collect();
    let mut bits = ones(no.len());
    while facts.len() < most && left > 0 {
        let worth = |c: &Column| (count_both(&bits, &c.no) as f64 + 1.0) * c.cost;
        candidates.sort_by(|a, b| worth(a).total_cmp(&worth(b)));
        // The first that holds of all rows, and not only of those that were looked at.
        let is_common = |c: &&&Column| count(&with.held(&[c.fact])) == with.rows();
        let Some(next) = candidates.iter().find(is_common) else { break };
        bits = both(&bits, &next.no);
        let mut more = facts.clone();
        more.push(next.fact);
        let held = count(&without.held(&more));
        if held * 4 > left * 3 {
            break;
        }
        (facts, left) = (more, held);
    }
    (facts, left)
}

/// So many numbers below `of`, evenly spread.
fn spread(of: usize, most: usize) -> Vec<usize> {
    if of <= most { (0..of).collect() } else { (0..most).map(|i| i * of / most).collect() }
}

fn distinct(groups: impl Iterator<Item = usize>) -> usize {
    let mut all: Vec<usize> = groups.collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}

/// A fact and the rows that it holds of, as bits, with how many of both these are.
struct Column {
    fact: Fact,
    cost: f64,
    /// How much larger the share of the first is than that of the others.
    tells: f64,
    yes: Vec<u64>,
    no: Vec<u64>,
    counts: [usize; 2],
}

struct Matrix {
    columns: Vec<Column>,
    rows: usize,
    others: usize,
}

/// A conjunction that may be grown.
struct Partial {
    facts: Vec<usize>,
    cost: f64,
    yes: Vec<u64>,
    no: Vec<u64>,
    counts: [usize; 2],
}

fn count(bits: &[u64]) -> usize {
    bits.iter().map(|word| word.count_ones() as usize).sum()
}

fn count_both(a: &[u64], b: &[u64]) -> usize {
    // Most of the time of a search is spent here: a plain loop is fast also where little is optimised.
    let b = &b[..a.len()];
    let mut count = 0;
    for i in 0..a.len() {
        count += (a[i] & b[i]).count_ones() as usize;
    }
    count
}

fn both(a: &[u64], b: &[u64]) -> Vec<u64> {
    a.iter().zip(b).map(|(a, b)| a & b).collect()
}

/// Adds the facts of a quantity, in the rows that a rule should hold of and in others.
fn add_columns(
    columns: &mut Vec<Column>,
    names: &[Name],
    of: Of,
    [with, without]: [&mut Tested; 2],
) {
    let share = |count: usize, rows: usize| count as f64 / rows.max(1) as f64;
    let [rows, others] = [with.rows(), without.rows()];
    let mut last = None;
    for test in tests(names, of, &with.in_order, &without.in_order) {
        // Limits between the same two values are the same fact.
        let limit = with.limit(test).zip(without.limit(test));
        if limit.is_some() && limit == last {
            continue;
        }
        last = limit;
        let yes = with.bits(test);
        let held = count(&yes);
        if held < 3.max(rows / 50) {
            continue;
        }
        let no = without.bits(test);
        let counts = [held, count(&no)];
        if counts != [rows, others] {
            let fact = Fact { of, test };
            let cost = fact.cost(names);
            let tells = share(counts[0], rows) - share(counts[1], others);
            columns.push(Column { fact, cost, tells, yes, no, counts });
        }
    }
}

impl Matrix {
    /// The facts that tell most, of every quantity of some rows and of others.
    fn of(names: &[Name], [with, without]: [&mut Vec<Tested>; 2], work: &Work) -> Self {
        let [rows, others] = [&*with, &*without].map(|all| all.first().map_or(0, Tested::rows));
        let sources = sources(names);
        work.spend(sources.len() * (rows + others) / ORDERED_A_STEP);
        let mut columns = Vec::new();
        for of in sources {
            let mut differences;
            let tested = match of {
                Of::One(i) => [&mut with[i], &mut without[i]],
                Of::Difference(i, j) => {
                    differences =
                        [&*with, &*without].map(|all| Tested::difference(&all[i], &all[j]));
                    differences.each_mut()
                }
            };
            add_columns(&mut columns, names, of, tested);
        }
        // A fact that tells a little is needed beside others. Of facts that hold of the same rows, which tell as much, the
        // cheapest is kept.
        columns.sort_by(|a, b| {
            let by_rows = || (&a.yes, &a.no).cmp(&(&b.yes, &b.no));
            b.tells.total_cmp(&a.tells).then_with(by_rows).then(a.cost.total_cmp(&b.cost))
        });
        columns.dedup_by(|a, b| a.yes == b.yes && a.no == b.no);
        columns.truncate(MOST_FACTS);
        Self { columns, rows, others }
    }

    /// The best conjunctions, one fact longer at each step.
    fn search(&self, terms: Terms, work: &Work) -> Vec<Rule> {
        let mut found = Vec::new();
        let (yes, no) = (ones(self.rows), ones(self.others));
        let counts = [self.rows, self.others];
        let mut beam = vec![Partial { facts: Vec::new(), cost: 1.0, yes, no, counts }];
        for length in 0..terms.most {
            // All single facts are combined with each other.
            let most_kept = if length == 0 { MOST_FACTS } else { BEAM };
            let mut grown = Vec::new();
            let mut least = f64::NEG_INFINITY;
            for (number, partial) in beam.iter().enumerate() {
                let counted = self.grow(partial, number, terms, least, &mut found, &mut grown);
                work.spend(counted * (partial.yes.len() + partial.no.len()) / WORDS_A_STEP);
                // The same facts come from each of them; what is far behind is forgotten.
                let wanted = most_kept * (length + 1);
                if grown.len() > 2 * wanted {
                    grown.select_nth_unstable_by(wanted, Grown::before);
                    least = grown[wanted].gain;
                    grown.truncate(wanted);
                }
            }
            // A longer rule cannot be worth more than all rows.
            let most = self.rows as f64 * LONGER.powi(length as i32 + 1);
            if found.first().is_some_and(|best: &Rule| best.value >= most) {
                break;
            }
            grown.sort_unstable_by(Grown::before);
            beam = self.kept(&beam, &grown, most_kept);
        }
        found.sort_by(|a: &Rule, b: &Rule| b.value.total_cmp(&a.value));
        found.truncate(MOST_FOUND);
        found
    }

    /// Adds every fact to a conjunction: what then holds of no other row is found, and what still does may be grown. How many
    /// had to be counted.
    fn grow(
        &self,
        partial: &Partial,
        parent: usize,
        terms: Terms,
        least: f64,
        found: &mut Vec<Rule>,
        grown: &mut Vec<Grown>,
    ) -> usize {
        let mut counted = 0;
        let length = partial.facts.len();
        // Pairs are tried once.
        let from = if length == 1 { partial.facts[0] + 1 } else { 0 };
        let longer = LONGER.powi(length as i32);
        for (fact, column) in self.columns.iter().enumerate().skip(from) {
            let worth = longer / (partial.cost * column.cost);
            let wanted = FAR_BEHIND * found.first().map_or(0.0, |best| best.value);
            // No more rows than each of both holds of, and no fewer others than must be common to both: what is neither found
            // nor grown with these is not counted.
            let most = partial.counts[0].min(column.counts[0]);
            let fewest = (partial.counts[1] + column.counts[1]).saturating_sub(self.others);
            let may_be_found = most as f64 * worth >= wanted && fewest * 1000 <= terms.slack * most;
            if !may_be_found && gain(most, fewest, self.rows, self.others) <= least {
                continue;
            }
            counted += 1;
            let yes = count_both(&partial.yes, &column.yes);
            if yes < LEAST_ROWS || partial.facts.contains(&fact) {
                continue;
            }
            let value = yes as f64 * worth;
            // Far behind the best one it is not wanted. Nor is it counted of how many others it holds where it is then
            // neither found nor grown with the fewest that these can be.
            let is_behind = value < wanted;
            let may_be_found = !is_behind && fewest * 1000 <= terms.slack * yes;
            if !may_be_found && gain(yes, fewest, self.rows, self.others) <= least {
                continue;
            }
            let no = count_both(&partial.no, &column.no);
            if no * 1000 > terms.slack * yes {
                let gain = gain(yes, no, self.rows, self.others);
                if gain > least {
                    grown.push(Grown { parent, fact, gain });
                }
                continue;
            }
            if is_behind {
                continue;
            }
            let facts =
                partial.facts.iter().chain([&fact]).map(|i| self.columns[*i].fact).collect();
            found.push(Rule { facts, rows: yes, value });
            let last = found.len() - 1;
            if value > found[0].value {
                found.swap(0, last);
            }
        }
        counted
    }

    /// The conjunctions with the largest gain.
    fn kept(&self, beam: &[Partial], grown: &[Grown], most: usize) -> Vec<Partial> {
        let mut seen: HashSet<Vec<usize>> = HashSet::new();
        let mut kept = Vec::new();
        for grown in grown {
            let (parent, column) = (&beam[grown.parent], &self.columns[grown.fact]);
            let mut facts = parent.facts.clone();
            facts.push(grown.fact);
            facts.sort_unstable();
            if seen.insert(facts.clone()) {
                let (yes, no) = (both(&parent.yes, &column.yes), both(&parent.no, &column.no));
                let counts = [count(&yes), count(&no)];
                kept.push(Partial { facts, cost: parent.cost * column.cost, yes, no, counts });
            }
            if kept.len() == most {
                break;
            }
        }
        kept
    }
}

/// A conjunction of the beam with another fact.
struct Grown {
    parent: usize,
    fact: usize,
    gain: f64,
}

impl Grown {
    /// The larger gain comes first; of the same, the one that was found first.
    fn before(&self, other: &Self) -> std::cmp::Ordering {
        let place = |grown: &Self| (grown.parent, grown.fact);
        other.gain.total_cmp(&self.gain).then(place(self).cmp(&place(other)))
    }
}

/// Values that are moved, values that are put in order, and words of 64 rows that are counted, in a step of [`Work`].
const VALUES_A_STEP: usize = 16;
const ORDERED_A_STEP: usize = 4;
const WORDS_A_STEP: usize = 8;

/// Rows below which a rule says nothing.
const LEAST_ROWS: usize = 3;
/// The share of the best rule's worth below which a rule is left aside.
const FAR_BEHIND: f64 = 0.4;
/// Rules that are looked at, the best first.
const MOST_FOUND: usize = 60;

/// How promising a conjunction is that still holds of other rows: much of the rows, and few of the others.
fn gain(yes: usize, no: usize, rows: usize, others: usize) -> f64 {
    let (rows, others) = (rows.max(1) as f64, others.max(1) as f64);
    yes as f64 / rows - no as f64 / others.sqrt() / 8.0 - no as f64 / others / 4.0
}

/// A value with the row that has it.
#[derive(Clone, Copy)]
struct RowValue {
    value: i64,
    row: usize,
}

/// The values of a quantity in some rows, so that the rows that a test holds of need no look at each row: a limit is a place in
/// their order, and the limits of one direction come one after another.
struct Tested {
    values: Vec<i64>,
    /// In the order of values, without rows that have none.
    in_order: Vec<RowValue>,
    known: Vec<u64>,
    /// The first so many of the order, as bits.
    first: (usize, Vec<u64>),
    /// The rows by the remainder of a division by [`DIVISOR`], once one is wanted.
    by_remainder: Vec<Vec<u64>>,
}

/// Remainders of smaller divisors are made of those of this one.
const DIVISOR: i64 = 16;

impl Tested {
    fn new(values: Vec<i64>) -> Self {
        let placed = values.iter().enumerate().map(|(row, &value)| RowValue { value, row });
        let mut in_order: Vec<RowValue> = placed.filter(|placed| placed.value != NONE).collect();
        in_order.sort_unstable_by_key(|placed| placed.value);
        let mut known = none(values.len());
        in_order.iter().for_each(|placed| set(&mut known, placed.row));
        let first = (0, none(values.len()));
        Self { values, in_order, known, first, by_remainder: Vec::new() }
    }

    /// Of how much one quantity differs from another, only the sign is looked at.
    fn difference(a: &Self, b: &Self) -> Self {
        let sign = |(a, b): (&i64, &i64)| match difference(*a, *b) {
            NONE => NONE,
            by => by.signum(),
        };
        Self::new(a.values.iter().zip(&b.values).map(sign).collect())
    }

    fn rows(&self) -> usize {
        self.values.len()
    }

    /// Of a limit, whether it is the largest value, and its place in the order.
    fn limit(&self, test: Test) -> Option<(bool, usize)> {
        match test {
            Test::AtMost(limit) => Some((true, self.up_to(limit))),
            Test::AtLeast(limit) => Some((false, self.below(limit))),
            _ => None,
        }
    }

    /// How many values are less than a number.
    fn below(&self, number: i64) -> usize {
        self.in_order.partition_point(|placed| placed.value < number)
    }

    /// How many values are no more than a number.
    fn up_to(&self, number: i64) -> usize {
        self.in_order.partition_point(|placed| placed.value <= number)
    }

    /// The rows of the first so many values.
    fn first(&mut self, end: usize) -> &[u64] {
        if end < self.first.0 {
            self.first = (0, none(self.values.len()));
        }
        let (start, bits) = &mut self.first;
        self.in_order[*start..end].iter().for_each(|placed| set(bits, placed.row));
        *start = end;
        bits
    }

    /// The rows of one value.
    fn equal(&self, value: i64) -> Vec<u64> {
        let mut bits = none(self.values.len());
        let range = self.below(value)..self.up_to(value);
        self.in_order[range].iter().for_each(|placed| set(&mut bits, placed.row));
        bits
    }

    /// The rows whose value has one of some remainders of [`DIVISOR`].
    fn remaining(&mut self, is_one: impl Fn(i64) -> bool) -> Vec<u64> {
        if self.by_remainder.is_empty() {
            self.by_remainder = (0..DIVISOR).map(|_| none(self.values.len())).collect();
            for placed in &self.in_order {
                set(&mut self.by_remainder[(placed.value & (DIVISOR - 1)) as usize], placed.row);
            }
        }
        let mut bits = none(self.values.len());
        for (rest, rows) in (0..).zip(&self.by_remainder) {
            if is_one(rest) {
                bits.iter_mut().zip(rows).for_each(|(all, more)| *all |= more);
            }
        }
        bits
    }

    /// The rows that a test holds of.
    fn bits(&mut self, test: Test) -> Vec<u64> {
        match test {
            Test::Is(value) => self.equal(value),
            Test::IsNot(value) => without(&self.known, &self.equal(value)),
            Test::AtMost(limit) => self.first(self.up_to(limit)).to_vec(),
            Test::AtLeast(limit) => {
                let below = self.first(self.below(limit)).to_vec();
                without(&self.known, &below)
            }
            Test::Remainder(by, rest) if by <= DIVISOR => self.remaining(|r| r & (by - 1) == rest),
            Test::NoMultiple(by) if by <= DIVISOR => self.remaining(|r| r & (by - 1) != 0),
            Test::InSecondHalf(by, is_second) if by <= DIVISOR => {
                self.remaining(|r| (r & (by / 2) != 0) == is_second)
            }
            Test::Remainder(..) | Test::NoMultiple(_) | Test::InSecondHalf(..) => {
                test.bits(&self.values)
            }
        }
    }
}

fn set(bits: &mut [u64], row: usize) {
    bits[row / 64] |= 1 << (row % 64);
}

/// No row of so many.
fn none(rows: usize) -> Vec<u64> {
    vec![0; rows.div_ceil(64)]
}

fn without(a: &[u64], b: &[u64]) -> Vec<u64> {
    a.iter().zip(b).map(|(a, b)| a & !b).collect()
}

/// As many bits as there are rows.
fn ones(rows: usize) -> Vec<u64> {
    let words = rows.div_ceil(64);
    let mut bits = vec![u64::MAX; words];
    if rows % 64 > 0 {
        bits[words - 1] = (1 << (rows % 64)) - 1;
    }
    bits
}

/// All quantities, and those that are compared with each other.
fn sources(names: &[Name]) -> Vec<Of> {
    let is_paired = |i: &usize| names[*i].unit == Unit::Paired;
    let paired: Vec<usize> = (0..names.len()).filter(is_paired).collect();
    let pairs = paired
        .iter()
        .enumerate()
        .flat_map(|(n, &i)| paired[n + 1..].iter().map(move |&j| Of::Difference(i, j)));
    (0..names.len()).map(Of::One).chain(pairs).collect()
}

/// The most values of a quantity that are tried one by one.
const MOST_VALUES: usize = 24;

/// The tests of a quantity, with numbers read off its values.
fn tests(names: &[Name], of: Of, with: &[RowValue], without: &[RowValue]) -> Vec<Test> {
    let unit = match of {
        Of::One(i) => names[i].unit,
        Of::Difference(..) => {
            let all = [
                Test::Is(0),
                Test::IsNot(0),
                Test::AtMost(0),
                Test::AtMost(-1),
                Test::AtLeast(0),
                Test::AtLeast(1),
            ];
            return all.into();
        }
    };
    if unit == Unit::Flag {
        return vec![Test::Is(1), Test::Is(0)];
    }
    let mut all =
        vec![Test::IsNot(0), Test::AtMost(-1), Test::AtMost(0), Test::AtLeast(0), Test::AtLeast(1)];
    let mut values: Vec<i64> = with.iter().map(|placed| placed.value).collect();
    values.dedup();
    if values.len() <= MOST_VALUES {
        all.extend(values.iter().map(|v| Test::Is(*v)));
    } else {
        all.push(Test::Is(0));
    }
    for limits in [with, without] {
        let places = [0, 10, 25, 50, 75, 90, 100].map(|p| limits.len().saturating_sub(1) * p / 100);
        for limit in places.iter().filter_map(|&place| Some(limits.get(place)?.value)) {
            all.extend([-1, 0].map(|by| Test::AtMost(limit.saturating_add(by))));
            all.extend([0, 1].map(|by| Test::AtLeast(limit.saturating_add(by))));
        }
    }
    let multiples: &[i64] = match unit {
        Unit::Count | Unit::Paired | Unit::Involved | Unit::Pixels => &[2, 4, 8, 16],
        Unit::Subpixels => &[16, 128, 256, 512],
        _ => &[],
    };
    for &by in multiples {
        let rests = if unit == Unit::Subpixels { 1 } else { by };
        all.extend((0..rests).map(|rest| Test::Remainder(by, rest)));
        all.push(Test::NoMultiple(by));
        if by > 2 && !matches!(unit, Unit::Subpixels | Unit::Pixels) {
            all.extend([false, true].map(|is_second| Test::InSecondHalf(by, is_second)));
        }
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// Moves each limit as far as no other row is let in: between the last row and the next other one, to a round number where
/// one lies there.
fn sharpen(facts: &mut [Fact], names: &[Name], [with, without]: [&Values<'_>; 2]) {
    for i in 0..facts.len() {
        let fact = facts[i];
        let sign = match fact.test {
            Test::AtMost(_) => 1,
            Test::AtLeast(_) => -1,
            _ => continue,
        };
        if matches!(fact.of, Of::Difference(..)) {
            continue;
        }
        let rest: Vec<Fact> = facts.iter().copied().filter(|f| *f != fact).collect();
        let signed = |values: &Values<'_>, held: Vec<u64>| -> Vec<i64> {
            let all = values.all(fact.of);
            places(&held).map(|row| all[row]).filter(|v| *v != NONE).map(|v| sign * v).collect()
        };
        let Some(last) = signed(with, with.held(facts)).into_iter().max() else { continue };
        let others = signed(without, without.held(&rest));
        let Some(next) = others.into_iter().filter(|v| *v > last).min() else { continue };
        let limit = sign * round(last, next - 1, sign, fact.of, names);
        facts[i].test = if sign == 1 { Test::AtMost(limit) } else { Test::AtLeast(limit) };
    }
}

/// The roundest number of a range: the one divisible by the largest power of two; of far numbers the first.
fn round(low: i64, high: i64, sign: i64, of: Of, names: &[Name]) -> i64 {
    let unit = match of {
        Of::One(i) => names[i].unit,
        Of::Difference(..) => Unit::Count,
    };
    // 'Below 8' and 'at least 8' are round where the limit is 7 and 8.
    let ahead = if sign == 1 { 1 } else { 0 };
    let step = match unit {
        Unit::Subpixels => 256,
        Unit::Ratio => RATIO,
        Unit::Area => 131_072,
        Unit::Value => return ahead_of_decimal(low + ahead, high + ahead) - ahead,
        _ => return low,
    };
    let mut best = low;
    let mut power = 1_i64 << 40;
    while power >= step / 256 {
        let multiple = (low + ahead).div_euclid(power) * power
            + if (low + ahead).rem_euclid(power) == 0 { 0 } else { power };
        if multiple - ahead <= high {
            best = multiple - ahead;
            break;
        }
        power /= 2;
    }
    // 'More than 4' is rounder than '4.03 or more'.
    let strict = high + 1 - ahead;
    if strict != 0 && strict.trailing_zeros() > (best + ahead).trailing_zeros() + 3 {
        best = high;
    }
    best.clamp(low, high)
}

/// Of values in 1/2^20, one in a range with few digits.
fn ahead_of_decimal(low: i64, high: i64) -> i64 {
    // From 10^12 down by tens, to the digits that a step has.
    for digits in -12..7 {
        let unit = f64::from(1 << 20) * f64::from(10).powi(-digits);
        let multiple = ((low as f64 / unit).ceil() * unit).ceil() as i64;
        if (low..=high).contains(&multiple) {
            return multiple;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    /// Quantities of each kind of tests, some of which some rows do not have.
    fn rows(rng: &mut Rng, units: &[Unit], count: usize) -> Vec<Vec<i64>> {
        let value = |rng: &mut Rng, unit: &Unit| match unit {
            Unit::Flag => rng.int(0, 1),
            _ if rng.chance(9) => NONE,
            Unit::Subpixels => rng.int(-900, 900),
            _ => rng.int(-3, 20),
        };
        (0..count).map(|_| units.iter().map(|unit| value(rng, unit)).collect()).collect()
    }

    /// A fact with the rows that it holds of.
    struct FactRows {
        fact: Fact,
        cost: f64,
        rows: [Vec<bool>; 2],
    }

    /// The facts by their definition: each test of each row, one after another.
    fn facts_by_rows(names: &[Name], yes: &[Vec<i64>], no: &[Vec<i64>]) -> Vec<Fact> {
        let mut all = Vec::new();
        for of in sources(names) {
            let [in_yes, in_no] = [yes, no]
                .map(|rows| Tested::new(rows.iter().map(|row| of.value(row)).collect()).in_order);
            for test in tests(names, of, &in_yes, &in_no) {
                let fact = Fact { of, test };
                let held_by = |rows: &[Vec<i64>]| rows.iter().map(|row| fact.holds(row)).collect();
                all.push(FactRows { fact, cost: fact.cost(names), rows: [yes, no].map(held_by) });
            }
        }
        let is_enough = |held: &FactRows| {
            let of_yes = held.rows[0].iter().filter(|holds| **holds).count();
            let is_all = held.rows.iter().flatten().all(|holds| *holds);
            of_yes >= 3.max(yes.len() / 50) && !is_all
        };
        all.retain(is_enough);
        // Of those that hold of the same rows, the first of the cheapest.
        let is_cheapest = |one: &FactRows| {
            let same = all.iter().filter(|other| other.rows == one.rows);
            let cheapest = same.reduce(|a, b| if b.cost < a.cost { b } else { a });
            cheapest.is_some_and(|cheapest| cheapest.fact == one.fact)
        };
        all.iter().filter(|one| is_cheapest(one)).map(|one| one.fact).collect()
    }

    /// What is left out early, or is made of the order of values, changes none of the facts that are combined.
    #[test]
    fn facts_are_those_of_all_tests() {
        let units = [Unit::Flag, Unit::Count, Unit::Paired, Unit::Subpixels, Unit::Paired];
        let name = |unit: &Unit| Name {
            unit: *unit,
            noun: String::new(),
            zero: [String::new(), String::new()],
        };
        let names: Vec<Name> = units.iter().map(name).collect();
        let mut rng = Rng::new("facts", 1, 0);
        for (yes, no) in [(12, 9), (30, 70), (250, 200)] {
            let [yes, no] = [yes, no].map(|count| rows(&mut rng, &units, count));
            let mut some = [&yes, &no].map(|rows| {
                let values = Values::of(names.len(), rows);
                values.some(&(0..rows.len()).collect::<Vec<_>>())
            });
            let matrix = Matrix::of(&names, some.each_mut(), &Work::default());
            let facts: Vec<Fact> = matrix.columns.iter().map(|column| column.fact).collect();
            let mut expected = facts_by_rows(&names, &yes, &no);
            assert!(expected.len() < MOST_FACTS && expected.len() > 20, "{}", expected.len());
            let place = |fact: &Fact| facts.iter().position(|other| other == fact);
            expected.sort_by_key(place);
            assert_eq!(facts, expected);
            let tells: Vec<f64> = matrix.columns.iter().map(|column| column.tells).collect();
            assert!(tells.is_sorted_by(|a, b| a >= b), "{tells:?}");
        }
    }
}
