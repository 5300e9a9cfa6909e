//! Invariant 42: which invariant kills which mutant. A row without a mark is a fault that nobody
//! would notice; a column without one is a check that cannot fail.

use std::fmt::Write as _;

use super::implementations::{Implementations, component_of};
use super::{CATALOGUE, Invariant, Predicate};

use rasterproof_core::parallel;
use rasterproof_faults::planted::Mutant;

/// Cases of each cell, enough for six of each family of triangles.
pub const CASES: u64 = 126;
/// The seed of the matrix that is printed and kept as a snapshot.
pub const SEED: u64 = 1;
/// The row that stands for a check that always passes.
const BLIND: &str = "blind-invariant";
/// The number of the invariant that this file is.
const META: u32 = 42;

/// Marks of every mutant (rows) under every invariant that applies (columns).
#[derive(Clone, Debug)]
pub struct Matrix {
    pub columns: Vec<u32>,
    pub rows: Vec<(String, Vec<bool>)>,
}

impl Matrix {
    /// Computes every cell; a pure function of the two numbers. `step` is told of every row.
    pub fn compute(seed: u64, cases: u64, step: &(dyn Fn() + Sync)) -> Self {
        let mutants = Mutant::all();
        let rows = parallel::map(mutants.len(), |row| {
            let mutant = mutants[row];
            let marks = parallel::map(CATALOGUE.len(), |column| {
                is_killed(mutant, &CATALOGUE[column], seed, cases)
            });
            step();
            (mutant.name().to_owned(), marks)
        });
        let columns = CATALOGUE.iter().map(|invariant| invariant.number).collect();
        let mut matrix = Self { columns, rows };
        matrix.add_blind_row();
        matrix
    }

    /// The mutant of this file's own invariant: a check that always passes. It is killed if the
    /// matrix with its empty column would be refused.
    fn add_blind_row(&mut self) {
        let Some(meta) = self.columns.iter().position(|&number| number == META) else { return };
        let mut blinded = self.clone();
        let mut own = vec![false; self.columns.len()];
        // While the question is open, let this row pass, and so the column of 42.
        own[meta] = true;
        blinded.rows.push((BLIND.to_owned(), own.clone()));
        // A check that always passes is a column without a mark, under a number that no invariant has.
        let number = self.columns.iter().max().copied().unwrap_or(0) + 1;
        blinded.columns.push(number);
        for (_, marks) in &mut blinded.rows {
            marks.push(false);
        }
        own[meta] = blinded.problems().contains(&unkilling(number));
        self.rows.push((BLIND.to_owned(), own));
    }

    /// Mutants that no invariant kills, and invariants that kill no mutant.
    pub fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for (name, marks) in &self.rows {
            if !marks.contains(&true) {
                problems.push(format!("no invariant kills the mutant {name}"));
            }
        }
        for (column, number) in self.columns.iter().enumerate() {
            if self.kills(column) == 0 {
                problems.push(unkilling(*number));
            }
        }
        problems
    }

    /// How many mutants the invariant of a column kills.
    fn kills(&self, column: usize) -> usize {
        self.rows.iter().filter(|(_, marks)| marks[column]).count()
    }

    /// The matrix as text of less than 100 columns: numbers from the top down, `#` for killed, sums
    /// to the right and below.
    pub fn text(&self) -> String {
        let width = self.rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let mut out = String::new();
        let mut line = |name: &str, cells: &[char], sum: &str| {
            let mut spaced = String::new();
            for (i, cell) in cells.iter().enumerate() {
                // A gap where a group of ten begins, for the eye.
                if i > 0 && self.columns[i] / 10 != self.columns[i - 1] / 10 {
                    spaced.push(' ');
                }
                spaced.push(*cell);
            }
            let text = format!("{name:<width$}  {spaced}  {sum}");
            let _ = writeln!(out, "{}", text.trim_end());
        };
        // The head: the numbers of the invariants.
        let numbers: Vec<usize> = self.columns.iter().map(|&number| number as usize).collect();
        let [tens, ones] = digits(&numbers);
        line("mutant \\ invariant", &tens, "");
        line("", &ones, "kills");
        // A row for each mutant.
        for (name, marks) in &self.rows {
            let cells: Vec<char> = marks.iter().map(|&mark| if mark { '#' } else { '.' }).collect();
            let sum = cells.iter().filter(|cell| **cell == '#').count();
            line(name, &cells, &format!("{sum:>5}"));
        }
        // The foot: how many mutants each invariant kills.
        let sums: Vec<usize> = (0..self.columns.len()).map(|column| self.kills(column)).collect();
        let [tens, ones] = digits(&sums);
        line("killed, from the top down", &tens, "");
        line("", &ones, &format!("{:>5}", sums.iter().sum::<usize>()));
        out
    }
}

/// What is said of a column without a mark.
fn unkilling(number: u32) -> String {
    format!("invariant {number} kills no mutant")
}

/// Whether an invariant applies to the component that a mutant has in place of the right one, and fails with it.
fn is_killed(mutant: Mutant, invariant: &Invariant, seed: u64, cases: u64) -> bool {
    invariant.components.contains(&component_of(&mutant))
        && !matches!(invariant.check, Predicate::Matrix)
        && invariant.kills(&Implementations::with(mutant), seed, cases)
}

/// The tens and the ones of numbers below 100; no ten where there is none.
fn digits(values: &[usize]) -> [Vec<char>; 2] {
    let mut digits = [Vec::new(), Vec::new()];
    for value in values {
        let ten = value / 10 % 10;
        digits[0].push(if *value < 10 { ' ' } else { char::from(b'0' + ten as u8) });
        digits[1].push(char::from(b'0' + (value % 10) as u8));
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_by_hand() {
        let row = |name: &str, marks: [bool; 2]| (name.to_owned(), marks.to_vec());
        let matrix = |rows| Matrix { columns: vec![1, 42], rows };
        let good = matrix(vec![row("a", [true, false]), row("b", [true, true])]);
        assert_eq!(good.problems(), Vec::<String>::new());
        let bad = matrix(vec![row("a", [true, false]), row("b", [false, false])]);
        assert_eq!(
            bad.problems(),
            ["no invariant kills the mutant b", "invariant 42 kills no mutant"]
        );
    }
}
