//! What a board says: which rung is good enough and cheapest, which ones nobody needs, and what
//! exactness costs.

use serde::Serialize;

use super::{Board, Ladder};

/// The cheapest rungs of one class of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    /// The cheapest rung of all, by number.
    pub fastest: usize,
    /// The cheapest rung whose error meets the goal of the measure.
    pub good: Option<usize>,
    /// The cheapest rung that promises no error, whatever the scene.
    pub certain: Option<usize>,
}

/// A rung that another one beats in every class of scenes in which it ran.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dominated {
    pub rung: usize,
    /// Rungs that beat it, by number: at most as wrong and clearly faster.
    pub by: Vec<usize>,
}

/// What no error costs over the cheapest rung, for one class of scenes.
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
    pub ratio: f64,
}

impl Board {
    pub fn ranking(&self) -> impl Iterator<Item = usize> {
        self.measures.iter().enumerate().filter(|(_, m)| m.goal.is_some()).map(|(i, _)| i)
    }

    /// Whether an error is as good as none; `None` where it was not measured.
    #[must_use]
    pub fn meets(&self, rung: usize, column: usize, measure: usize) -> Option<bool> {
        Some(self.error(rung, column, measure)? <= self.measures[measure].goal?)
    }

    pub fn columns_run(&self) -> impl Iterator<Item = usize> {
        (0..self.columns.len())
            .filter(|&column| (0..self.rungs.len()).any(|r| self.run(r, column).is_some()))
    }

    /// The cheapest rungs of a column by a measure; `None` without times.
    pub fn best(&self, column: usize, measure: usize) -> Option<Best> {
        let cheapest = |filter: &dyn Fn(usize) -> bool| {
            (0..self.rungs.len())
                .filter(|&rung| filter(rung))
                .filter_map(|rung| Some((rung, self.time(rung, column)?.pixel_ns.median)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(rung, _)| rung)
        };
        Some(Best {
            fastest: cheapest(&|_| true)?,
            good: cheapest(&|rung| self.meets(rung, column, measure) == Some(true)),
            certain: cheapest(&|rung| self.rungs[rung].promises.contains(&measure)),
        })
    }

    /// Whether `other` beats `rung` in a column: by this measure and those that rank nothing it is
    /// at most as wrong, and three quarters of its rounds were faster than three quarters of the
    /// rung's.
    fn beats(&self, other: usize, rung: usize, column: usize, measure: usize) -> Option<bool> {
        let (a, b) = (self.time(other, column)?, self.time(rung, column)?);
        let at_most = |m: usize| match (self.error(other, column, m), self.error(rung, column, m)) {
            (Some(a), Some(b)) => a <= b,
            _ => true,
        };
        // Luck on one seed does not beat a promise.
        let promises = |rung: usize| self.rungs[rung].promises.contains(&measure);
        if promises(rung) && !promises(other) {
            return Some(false);
        }
        let counts = |m: &usize| *m == measure || self.measures[*m].goal.is_none();
        let no_worse = (0..self.measures.len()).filter(counts).all(at_most);
        Some(no_worse && a.pixel_ns.high < b.pixel_ns.low)
    }

    /// Rungs that are beaten in every column in which they ran.
    pub fn dominated(&self, measure: usize) -> Vec<Dominated> {
        let beaten = |rung: usize| {
            let mut by = Vec::new();
            for column in self.columns_run().filter(|&c| self.time(rung, c).is_some()) {
                let others = (0..self.rungs.len()).filter(|&other| other != rung);
                let mut better: Vec<_> = others
                    .filter(|&other| self.beats(other, rung, column, measure) == Some(true))
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
            (!by.is_empty()).then_some(Dominated { rung, by })
        };
        (0..self.rungs.len()).filter_map(beaten).collect()
    }
}

/// What exact coverage costs over the cheapest rung of both ladders, for each class of scenes.
pub fn prices(boards: &[Board]) -> Vec<Price> {
    let coverage: Vec<&Board> = boards
        .iter()
        .filter(|board| matches!(board.ladder, Ladder::Scanline | Ladder::EdgeFunction))
        .collect();
    let Some(first) = coverage.first() else { return Vec::new() };
    let price = |column: usize| {
        let cheapest = |filter: &dyn Fn(&Board, usize) -> bool| {
            let rungs = coverage.iter().flat_map(|board| {
                (0..board.rungs.len()).filter(|&rung| filter(board, rung)).filter_map(|rung| {
                    let time = board.time(rung, column)?.pixel_ns.median;
                    let kind = if board.ladder == Ladder::Scanline { "scanline" } else { "edge" };
                    Some((format!("{kind} {}", board.rungs[rung].name), time))
                })
            });
            rungs.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let (name, least) = cheapest(&|_, _| true)?;
        let priced =
            |(name, pixel_ns): (String, f64)| Priced { name, pixel_ns, ratio: pixel_ns / least };
        let certain = |measure: usize| {
            cheapest(&|board, rung| board.rungs[rung].promises.contains(&measure)).map(priced)
        };
        Some(Price {
            column: first.columns[column].name.to_string(),
            cheapest: priced((name, least)),
            unpromised: cheapest(&|board, rung| board.rungs[rung].promises.is_empty()).map(priced),
            snapped: certain(super::coverage::SNAPPED),
            given: certain(super::coverage::GIVEN),
        })
    };
    first.columns_run().filter_map(price).collect()
}
