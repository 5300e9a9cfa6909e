//! What a board says: which choice is good enough and cheapest, which ones nobody needs, and what
//! exactness costs.

use serde::Serialize;

use super::{Board, Ladder, Ratio, Time};

/// The cheapest choices of one class of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    /// The cheapest choice of all, by number.
    pub fastest: usize,
    /// The cheapest choice whose error meets the goal of the measure.
    pub good: Option<usize>,
    /// The cheapest choice that promises no error, whatever the scene.
    pub certain: Option<usize>,
}

/// A choice that another one beats in every class of scenes in which it ran.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dominated {
    pub choice: usize,
    /// Choices that beat it, by number: at most as wrong and clearly faster.
    pub by: Vec<usize>,
}

/// What no error costs over the cheapest choice of both groups, for one class of scenes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Price {
    pub column: String,
    pub cheapest: Priced,
    /// The cheapest that promises nothing, so computes in floats.
    pub unpromised: Option<Priced>,
    /// The cheapest that is exact on the lattice, whatever the scene.
    pub snapped: Option<Priced>,
    /// The cheapest that is exact for the vertices as given, whatever the scene.
    pub given: Option<Priced>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Priced {
    pub name: String,
    pub pixel_ns: f64,
    pub ratio: Ratio,
}

impl Board {
    pub fn ranking(&self) -> impl Iterator<Item = usize> {
        self.measures.iter().enumerate().filter(|(_, m)| m.goal.is_some()).map(|(i, _)| i)
    }

    /// Whether an error is as good as none; `None` where it was not measured.
    #[must_use]
    pub fn meets(&self, choice: usize, column: usize, measure: usize) -> Option<bool> {
        Some(self.error(choice, column, measure)? <= self.measures[measure].goal?)
    }

    pub fn columns_run(&self) -> impl Iterator<Item = usize> {
        (0..self.columns.len())
            .filter(|&column| (0..self.choices.len()).any(|r| self.run(r, column).is_some()))
    }

    /// The cheapest choices of a column by a measure; `None` without times.
    pub fn best(&self, column: usize, measure: usize) -> Option<Best> {
        let cheapest = |filter: &dyn Fn(usize) -> bool| {
            (0..self.choices.len())
                .filter(|&choice| filter(choice))
                .filter_map(|choice| Some((choice, self.time(choice, column)?.pixel_ns.median)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(choice, _)| choice)
        };
        Some(Best {
            fastest: cheapest(&|_| true)?,
            good: cheapest(&|choice| self.meets(choice, column, measure) == Some(true)),
            certain: cheapest(&|choice| self.choices[choice].promises.contains(&measure)),
        })
    }

    /// Whether `other` beats `choice` in a column: by this measure and those that rank nothing it is
    /// at most as wrong, and its ratio to the cheapest choice is below that of the choice, intervals and all.
    fn beats(&self, other: usize, choice: usize, column: usize, measure: usize) -> Option<bool> {
        let (a, b) = (self.time(other, column)?, self.time(choice, column)?);
        let at_most = |m: usize| match (self.error(other, column, m), self.error(choice, column, m))
        {
            (Some(a), Some(b)) => a <= b,
            _ => true,
        };
        // Luck on one seed does not beat a promise.
        let promises = |choice: usize| self.choices[choice].promises.contains(&measure);
        if promises(choice) && !promises(other) {
            return Some(false);
        }
        let counts = |m: &usize| *m == measure || self.measures[*m].goal.is_none();
        let no_worse = (0..self.measures.len()).filter(counts).all(at_most);
        Some(no_worse && a.times.high < b.times.low)
    }

    /// Choices that are beaten in every column in which they ran.
    pub fn dominated(&self, measure: usize) -> Vec<Dominated> {
        let beaten = |choice: usize| {
            let mut by = Vec::new();
            for column in self.columns_run().filter(|&c| self.time(choice, c).is_some()) {
                let others = (0..self.choices.len()).filter(|&other| other != choice);
                let mut better: Vec<_> = others
                    .filter(|&other| self.beats(other, choice, column, measure) == Some(true))
                    .collect();
                better.sort_by(|&a, &b| {
                    let ns = |r| self.time(r, column).map_or(f64::INFINITY, |t| t.pixel_ns.median);
                    ns(a).total_cmp(&ns(b))
                });
                // One that is known already, or else the fastest.
                let known = better.iter().any(|other| by.contains(other));
                match better.first() {
                    None => return None,
                    Some(&first) if !known => by.push(first),
                    Some(_) => {}
                }
            }
            by.sort_unstable();
            (!by.is_empty()).then_some(Dominated { choice, by })
        };
        (0..self.choices.len()).filter_map(beaten).collect()
    }
}

/// What exact coverage costs over the cheapest choice of both groups, for each class of scenes.
pub fn prices(boards: &[Board]) -> Vec<Price> {
    let coverage: Vec<&Board> = boards
        .iter()
        .filter(|board| matches!(board.ladder, Ladder::Scanline | Ladder::EdgeFunction))
        .collect();
    let Some(first) = coverage.first() else { return Vec::new() };
    let price = |column: usize| {
        let cheapest = |filter: &dyn Fn(&[usize]) -> bool| {
            let timed = coverage.iter().flat_map(|board| {
                let choices = board.choices.iter().enumerate();
                let choices = choices.filter(|(_, choice)| filter(&choice.promises));
                choices.filter_map(|(number, choice)| {
                    let Time { pixel_ns, times } = board.time(number, column)?;
                    let kind = if board.ladder == Ladder::Scanline { "scanline" } else { "edge" };
                    let name = format!("{kind} {}", choice.name);
                    Some(Priced { name, pixel_ns: pixel_ns.median, ratio: *times })
                })
            });
            timed.min_by(|a, b| a.pixel_ns.total_cmp(&b.pixel_ns))
        };
        Some(Price {
            column: first.columns[column].name.to_string(),
            cheapest: cheapest(&|_| true)?,
            unpromised: cheapest(&<[usize]>::is_empty),
            snapped: cheapest(&|promises| promises.contains(&super::coverage::SNAPPED)),
            given: cheapest(&|promises| promises.contains(&super::coverage::GIVEN)),
        })
    };
    first.columns_run().filter_map(price).collect()
}
