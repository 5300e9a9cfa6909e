//! The learner: the shortest conjunction of facts that is true of most of some rows and of none of others.
//!
//! A fact is a quantity with a test. The facts of all rows are a matrix of bits, so that a conjunction is an AND and its
//! worth is a count of bits (as in CN2 and RIPPER, with a beam).

use std::collections::{HashMap, HashSet};

use super::quantity::{NONE, Name};
use super::question::Unit;

/// A quantity, or one compared with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Of {
    One(usize),
    /// The first less the second.
    Difference(usize, usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Test {
    Is(i64),
    IsNot(i64),
    AtMost(i64),
    AtLeast(i64),
    /// The remainder of a division by the first number is the second.
    Remainder(i64, i64),
    /// It is no multiple.
    NoMultiple(i64),
}

/// A fact: a quantity with a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Fact {
    pub(super) of: Of,
    pub(super) test: Test,
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
            }
    }
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
                Unit::Subpixels | Unit::Area | Unit::Ratio | Unit::Value => 1.06,
                Unit::Involved => 1.2,
            },
            Of::Difference(..) => 1.15,
        };
        let test = match self.test {
            Test::Is(_) => 1.0,
            Test::AtMost(_) | Test::AtLeast(_) | Test::Remainder(2, _) => 1.01,
            Test::Remainder(..) | Test::NoMultiple(_) => 1.03,
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
pub(super) struct Found {
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

/// The best rules: each the best for the rows that those before do not hold of.
pub(super) fn best(names: &[Name], table: &Table, terms: Terms) -> Vec<Found> {
    let mut all = Vec::new();
    let mut left: Vec<usize> = (0..table.yes.len()).collect();
    for _ in 0..terms.wanted {
        let Some(mut rule) = best_of(names, table, terms, &left) else { break };
        left.retain(|&i| !all_hold(&rule.facts, &table.yes[i]));
        rule.rows = table.yes.iter().filter(|row| all_hold(&rule.facts, row)).count();
        all.push(rule);
    }
    all
}

/// The best rule for some rows. It is searched for among a part of them; a rule that another row refutes brings this row in.
fn best_of(names: &[Name], table: &Table, terms: Terms, left: &[usize]) -> Option<Found> {
    let yes: Vec<usize> = spread(left.len(), MOST_YES).into_iter().map(|i| left[i]).collect();
    let mut no = spread(table.no.len(), MOST_NO);
    for _ in 0..ROUNDS {
        let mut refuting = Vec::new();
        for mut rule in Matrix::of(names, table, &yes, &no).search(terms) {
            sharpen(&mut rule.facts, names, table);
            let holds = |row: &Vec<i64>| all_hold(&rule.facts, row);
            let held: Vec<usize> = left.iter().copied().filter(|&i| holds(&table.yes[i])).collect();
            let bad: Vec<usize> = (0..table.no.len()).filter(|&i| holds(&table.no[i])).collect();
            rule.rows = held.len();
            let is_refuted = bad.len() * 1000 > terms.slack * rule.rows * 3 / 2;
            if !is_refuted && distinct(held.iter().map(|&i| table.groups[i])) >= terms.need {
                return Some(rule);
            }
            if is_refuted {
                refuting.extend(bad.into_iter().take(MOST_VIOLATIONS));
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

/// A fact and the rows that it holds of, as bits.
struct Column {
    fact: Fact,
    cost: f64,
    yes: Vec<u64>,
    no: Vec<u64>,
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
}

fn count(bits: &[u64]) -> usize {
    bits.iter().map(|word| word.count_ones() as usize).sum()
}

fn count_both(a: &[u64], b: &[u64]) -> usize {
    a.iter().zip(b).map(|(a, b)| (a & b).count_ones() as usize).sum()
}

fn both(a: &[u64], b: &[u64]) -> Vec<u64> {
    a.iter().zip(b).map(|(a, b)| a & b).collect()
}

impl Matrix {
    fn of(names: &[Name], table: &Table, yes: &[usize], no: &[usize]) -> Self {
        let rows = |all: &[Vec<i64>], some: &[usize], of: Of| -> Vec<i64> {
            some.iter().map(|&i| of.value(&all[i])).collect()
        };
        // Of facts that hold of the same rows, the cheapest is kept.
        let mut columns: Vec<Column> = Vec::new();
        let mut known: HashMap<(Vec<u64>, Vec<u64>), usize> = HashMap::new();
        for of in sources(names) {
            let (with, without) = (rows(&table.yes, yes, of), rows(&table.no, no, of));
            for test in tests(names, of, &with, &without) {
                let bits = |values: &[i64]| -> Vec<u64> {
                    let word = |chunk: &[i64]| {
                        chunk.iter().rev().fold(0, |word, v| word << 1 | u64::from(test.holds(*v)))
                    };
                    values.chunks(64).map(word).collect()
                };
                let held = bits(&with);
                let is_rare = count(&held) < 3.max(yes.len() / 50);
                if is_rare {
                    continue;
                }
                let fact = Fact { of, test };
                let column = Column { fact, cost: fact.cost(names), yes: held, no: bits(&without) };
                match known.get(&(column.yes.clone(), column.no.clone())) {
                    Some(&i) if columns[i].cost <= column.cost => {}
                    Some(&i) => columns[i] = column,
                    None => {
                        known.insert((column.yes.clone(), column.no.clone()), columns.len());
                        columns.push(column);
                    }
                }
            }
        }
        let mut matrix = Self { columns, rows: yes.len(), others: no.len() };
        // A fact that tells a little is needed beside others.
        let share = |bits: &[u64], rows: usize| count(bits) as f64 / rows.max(1) as f64;
        let tells = |c: &Column| share(&c.yes, yes.len()) - share(&c.no, no.len());
        matrix.columns.sort_by(|a, b| tells(b).total_cmp(&tells(a)));
        matrix.columns.truncate(MOST_FACTS);
        matrix
    }

    /// The best conjunctions, one fact longer at each step.
    fn search(&self, terms: Terms) -> Vec<Found> {
        let mut found = Vec::new();
        let (yes, no) = (ones(self.rows), ones(self.others));
        let mut beam = vec![Partial { facts: Vec::new(), cost: 1.0, yes, no }];
        for length in 0..terms.most {
            let mut grown = Vec::new();
            for (number, partial) in beam.iter().enumerate() {
                self.grow(partial, number, terms, &mut found, &mut grown);
            }
            // A longer rule cannot be worth more than all rows.
            let most = self.rows as f64 * LONGER.powi(length as i32 + 1);
            if found.first().is_some_and(|best: &Found| best.value >= most) {
                break;
            }
            grown.sort_by(|a, b| b.gain.total_cmp(&a.gain));
            // All single facts are combined with each other.
            beam = self.kept(&beam, &grown, if length == 0 { MOST_FACTS } else { BEAM });
        }
        found.sort_by(|a: &Found, b: &Found| b.value.total_cmp(&a.value));
        found.truncate(MOST_FOUND);
        found
    }

    /// Adds every fact to a conjunction: what then holds of no other row is found, and what still does may be grown.
    fn grow(
        &self,
        partial: &Partial,
        parent: usize,
        terms: Terms,
        found: &mut Vec<Found>,
        grown: &mut Vec<Grown>,
    ) {
        let length = partial.facts.len();
        // Pairs are tried once.
        let from = if length == 1 { partial.facts[0] + 1 } else { 0 };
        for (fact, column) in self.columns.iter().enumerate().skip(from) {
            let yes = count_both(&partial.yes, &column.yes);
            if yes < LEAST_ROWS || partial.facts.contains(&fact) {
                continue;
            }
            let no = count_both(&partial.no, &column.no);
            if no * 1000 > terms.slack * yes {
                let gain = gain(yes, no, self.rows, self.others);
                grown.push(Grown { parent, fact, gain });
                continue;
            }
            let value = yes as f64 * LONGER.powi(length as i32) / (partial.cost * column.cost);
            // Far behind the best one it is not wanted.
            if value < FAR_BEHIND * found.first().map_or(0.0, |best| best.value) {
                continue;
            }
            let facts =
                partial.facts.iter().chain([&fact]).map(|i| self.columns[*i].fact).collect();
            found.push(Found { facts, rows: yes, value });
            let last = found.len() - 1;
            if value > found[0].value {
                found.swap(0, last);
            }
        }
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
                kept.push(Partial { facts, cost: parent.cost * column.cost, yes, no });
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

/// Rows below which a rule says nothing.
const LEAST_ROWS: usize = 3;
/// The share of the best rule's worth below which a rule is left aside.
const FAR_BEHIND: f64 = 0.4;
/// Rules that are looked at, the best first.
const MOST_FOUND: usize = 300;

/// How promising a conjunction is that still holds of other rows: much of the rows, and few of the others.
fn gain(yes: usize, no: usize, rows: usize, others: usize) -> f64 {
    let (rows, others) = (rows.max(1) as f64, others.max(1) as f64);
    yes as f64 / rows - no as f64 / others.sqrt() / 8.0 - no as f64 / others / 4.0
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
fn tests(names: &[Name], of: Of, with: &[i64], without: &[i64]) -> Vec<Test> {
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
    let (with, without) = (ordered(with), ordered(without));
    let mut values = with.clone();
    values.dedup();
    if values.len() <= MOST_VALUES {
        all.extend(values.iter().map(|v| Test::Is(*v)));
    } else {
        all.push(Test::Is(0));
    }
    for limits in [&with, &without] {
        let places = [0, 10, 25, 50, 75, 90, 100].map(|p| limits.len().saturating_sub(1) * p / 100);
        for &limit in places.iter().filter_map(|&place| limits.get(place)) {
            all.extend([-1, 0, 1].map(|by| Test::AtMost(limit.saturating_add(by))));
            all.extend([-1, 0, 1].map(|by| Test::AtLeast(limit.saturating_add(by))));
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
    }
    all.sort_by_key(|test| format!("{test:?}"));
    all.dedup();
    all
}

fn ordered(values: &[i64]) -> Vec<i64> {
    let mut values: Vec<i64> = values.iter().copied().filter(|v| *v != NONE).collect();
    values.sort_unstable();
    values
}

/// Moves each limit as far as no other row is let in: between the last row and the next other one, to a round number where
/// one lies there.
fn sharpen(facts: &mut [Fact], names: &[Name], table: &Table) {
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
        let values = |rows: &[Vec<i64>], with: &[Fact]| -> Vec<i64> {
            let held = rows.iter().filter(|row| all_hold(with, row) && all_hold(&rest, row));
            held.map(|row| fact.of.value(row)).filter(|v| *v != NONE).map(|v| sign * v).collect()
        };
        let Some(last) = values(&table.yes, &[fact]).into_iter().max() else { continue };
        let next = values(&table.no, &[]).into_iter().filter(|v| *v > last).min();
        let Some(next) = next else { continue };
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
        Unit::Subpixels | Unit::Ratio => 256,
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
