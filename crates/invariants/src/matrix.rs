//! Invariant 42: which invariant kills which mutant. A row without a mark is a fault that nobody
//! would notice; a column without one is a check that cannot fail.

use std::fmt::Write as _;

use super::implementations::{Implementations, component_of};
use super::{CATALOGUE, Invariant, Predicate};
use rasterproof_core::arrays::MapArray as _;
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
        let columns: Vec<&Invariant> = CATALOGUE.iter().collect();
        let mutants = Mutant::all();
        let rows = parallel::map(mutants.len(), |row| {
            let mutant = mutants[row];
            let marks = parallel::map(columns.len(), |column| {
                let invariant = columns[column];
                invariant.components.contains(&component_of(&mutant))
                    && !matches!(invariant.check, Predicate::Matrix)
                    && invariant.kills(&Implementations::with(mutant), seed, cases)
            });
            step();
            (mutant.name().to_owned(), marks)
        });
        let mut matrix = Self { columns: columns.iter().map(|i| i.number).collect(), rows };
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
        let number = self.columns.iter().max().copied().unwrap_or(0) + 1;
        blinded.columns.push(number);
        blinded.rows.iter_mut().for_each(|(_, marks)| marks.push(false));
        own[meta] = blinded.problems().contains(&unkilling(number));
        self.rows.push((BLIND.to_owned(), own));
    }

    pub fn problems(&self) -> Vec<String> {
        let survivors = self.rows.iter().filter(|(_, marks)| !marks.contains(&true));
        let survivors = survivors.map(|(name, _)| format!("no invariant kills the mutant {name}"));
        let idle =
            (0..self.columns.len()).filter(|&i| self.rows.iter().all(|(_, marks)| !marks[i]));
        survivors.chain(idle.map(|i| unkilling(self.columns[i]))).collect()
    }

    /// The matrix as text of less than 100 columns: numbers from the top down, `#` for killed, sums
    /// to the right and below.
    pub fn text(&self) -> String {
        let width = self.rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let mut out = String::new();
        // A gap where a group of ten begins, for the eye.
        let gap = |i: usize| i > 0 && self.columns[i] / 10 != self.columns[i - 1] / 10;
        let mut line = |name: &str, cell: &dyn Fn(usize) -> char, sum: &str| {
            let cells: String = (0..self.columns.len())
                .flat_map(|i| gap(i).then_some(' ').into_iter().chain([cell(i)]))
                .collect();
            let text = format!("{name:<width$}  {cells}  {sum}");
            let _ = writeln!(out, "{}", text.trim_end());
        };
        let digits = |values: &[usize]| {
            let values = values.to_vec();
            [10, 1].map_array(|unit| {
                let digits: Vec<char> = values
                    .iter()
                    .map(|&v| match v / unit {
                        0 if unit > 1 => ' ',
                        digit => char::from(b'0' + (digit % 10) as u8),
                    })
                    .collect();
                digits
            })
        };
        let numbers: Vec<usize> = self.columns.iter().map(|&n| n as usize).collect();
        let [tens, ones] = digits(&numbers);
        line("mutant \\ invariant", &|i| tens[i], "");
        line("", &|i| ones[i], "kills");
        for (name, marks) in &self.rows {
            let sum = marks.iter().filter(|&&mark| mark).count().to_string();
            line(name, &|i| if marks[i] { '#' } else { '.' }, &format!("{sum:>5}"));
        }
        let sums: Vec<usize> = (0..self.columns.len())
            .map(|i| self.rows.iter().filter(|(_, marks)| marks[i]).count())
            .collect();
        let [tens, ones] = digits(&sums);
        line("killed, from the top down", &|i| tens[i], "");
        line("", &|i| ones[i], &format!("{:>5}", sums.iter().sum::<usize>()));
        out
    }
}

fn unkilling(number: u32) -> String {
    format!("invariant {number} kills no mutant")
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
