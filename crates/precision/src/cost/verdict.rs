//! What a board says: which choice is good enough and cheapest, which ones nobody needs, and what
//! exactness costs.

use serde::Serialize;

use super::coverage::{GIVEN, SNAPPED};
use super::{Board, Choice, Ratio, RatioKind, Run, Times};

/// A choice with its board and a column on which it was run.
#[derive(Clone, Copy)]
pub struct JudgedChoice<'a> {
    pub board: &'a Board,
    pub number: usize,
    pub column: usize,
    pub run: &'a Run,
}

impl<'a> JudgedChoice<'a> {
    #[must_use]
    pub fn choice(&self) -> &'a Choice {
        &self.board.choices[self.number]
    }

    #[must_use]
    pub fn name(&self) -> &'a str {
        &self.choice().name
    }

    #[must_use]
    pub fn error(&self, measure: usize) -> Option<f64> {
        self.run.errors.get(measure).copied().flatten()
    }

    /// Whether its error is as good as none.
    #[must_use]
    pub fn is_exact(&self, measure: usize) -> bool {
        self.board.meets(self.number, self.column, measure)
    }

    /// Whether it promises that, whatever the scene.
    #[must_use]
    pub fn promises(&self, measure: usize) -> bool {
        self.choice().promises.contains(&measure)
    }

    /// The times of all rounds; nothing where it was not timed.
    #[must_use]
    pub fn times(&self) -> Option<&'a Times> {
        self.run.time.as_ref()?.rounds.as_ref()
    }

    /// How many times as long it takes as another choice; nothing where either was not timed.
    #[must_use]
    pub fn over(&self, other: &Self) -> Option<Ratio> {
        if self.is(other) { Some(Ratio::ONE) } else { self.times()?.over(other.times()?) }
    }

    /// Whether both are one choice of one board, on any column.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        self.number == other.number && std::ptr::eq(self.board, other.board)
    }

    fn pixel_ns(&self) -> Option<f64> {
        Some(self.run.time.as_ref()?.pixel_ns.median)
    }

    /// Whether another choice of its column is faster, intervals and all, and at most as wrong by a measure and by those that rank
    /// nothing.
    fn is_beaten(&self, other: &Self, measure: usize) -> bool {
        // Luck on one seed does not beat a promise.
        if self.promises(measure) && !other.promises(measure) {
            return false;
        }
        for (number, one) in self.board.measures.iter().enumerate() {
            // Of the measures that rank, only the one that is asked about counts.
            if number != measure && one.goal.is_some() {
                continue;
            }
            if let (Some(other), Some(own)) = (other.error(number), self.error(number)) {
                let is_no_worse = other <= own;
                if !is_no_worse {
                    return false;
                }
            }
        }
        let (Some(own), Some(other)) = (&self.run.time, &other.run.time) else { return false };
        other.times.high < own.times.low
    }
}

/// The choice with the least median time; nothing where none was timed.
#[must_use]
pub fn fastest<'a>(choices: impl Iterator<Item = JudgedChoice<'a>>) -> Option<JudgedChoice<'a>> {
    let timed = choices.filter_map(|choice| Some((choice.pixel_ns()?, choice)));
    timed.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, choice)| choice)
}

/// The cheapest of some exact choices, and those of which the same rounds do not show that they are slower.
pub struct Cheapest<'a> {
    pub choice: JudgedChoice<'a>,
    /// Those between which and it there is no difference.
    pub equal: Vec<JudgedChoice<'a>>,
    /// Those that may be faster or slower than it, for all that was measured.
    pub undecided: Vec<JudgedChoice<'a>>,
}

impl<'a> Cheapest<'a> {
    /// Sorts all others by what their times over that of the fastest one say; nothing where none was timed.
    #[must_use]
    pub fn of(exact: &[JudgedChoice<'a>]) -> Option<Self> {
        let choice = fastest(exact.iter().copied())?;
        let (mut equal, mut undecided) = (Vec::new(), Vec::new());
        for other in exact {
            let Some(ratio) = other.over(&choice).filter(|ratio| *ratio != Ratio::ONE) else {
                continue;
            };
            match ratio.said() {
                RatioKind::NoDifference => equal.push(*other),
                RatioKind::CannotBeTold if ratio.low <= 1.0 => undecided.push(*other),
                _ => {}
            }
        }
        Some(Self { choice, equal, undecided })
    }
}

impl Board {
    /// The measures that say which choices are exact, by their numbers.
    pub fn ranking(&self) -> impl Iterator<Item = usize> {
        self.measures.iter().enumerate().filter(|(_, m)| m.goal.is_some()).map(|(i, _)| i)
    }

    /// Whether an error was measured and is as good as none.
    #[must_use]
    pub fn meets(&self, choice: usize, column: usize, measure: usize) -> bool {
        let Some(goal) = self.measures.get(measure).and_then(|measure| measure.goal) else {
            return false;
        };
        let error = self.error(choice, column, measure);
        error.is_some_and(|error| error <= goal) && self.columns[column].is_judged()
    }

    /// The choices that ran on a column.
    pub fn ran(&self, column: usize) -> impl Iterator<Item = JudgedChoice<'_>> {
        (0..self.choices.len()).filter_map(move |number| {
            Some(JudgedChoice { board: self, number, column, run: self.run(number, column)? })
        })
    }

    /// The columns on which any choice ran.
    pub fn columns_run(&self) -> impl Iterator<Item = usize> {
        (0..self.columns.len()).filter(|&column| self.ran(column).next().is_some())
    }

    /// The choices that a measure calls exact on a column.
    pub fn exact(&self, column: usize, measure: usize) -> impl Iterator<Item = JudgedChoice<'_>> {
        self.ran(column).filter(move |choice| choice.is_exact(measure))
    }

    /// The fastest choice that a measure calls exact.
    #[must_use]
    pub fn cheapest_exact(&self, column: usize, measure: usize) -> Option<JudgedChoice<'_>> {
        fastest(self.exact(column, measure))
    }

    /// The cheapest exact choice with those that are as fast, as far as it can be told.
    #[must_use]
    pub fn compared(&self, column: usize, measure: usize) -> Option<Cheapest<'_>> {
        Cheapest::of(&self.exact(column, measure).collect::<Vec<_>>())
    }

    /// The choices that others beat in every column in which they ran, each with those others.
    #[must_use]
    pub fn dominated(&self, measure: usize) -> Vec<(&Choice, Vec<&Choice>)> {
        let mut dominated = Vec::new();
        for (number, choice) in self.choices.iter().enumerate() {
            let by = self.beaten_by(number, measure).unwrap_or_default();
            if !by.is_empty() {
                dominated.push((choice, by));
            }
        }
        dominated
    }

    /// For each column in which a choice was timed one that beats it; nothing where in one of them none does.
    fn beaten_by(&self, choice: usize, measure: usize) -> Option<Vec<&Choice>> {
        let mut by: Vec<usize> = Vec::new();
        for column in self.columns_run().filter(|&column| self.time(choice, column).is_some()) {
            let this = self.ran(column).find(|one| one.number == choice)?;
            let better = || self.ran(column).filter(|other| this.is_beaten(other, measure));
            // One that is known already, or else the fastest.
            if !better().any(|other| by.contains(&other.number)) {
                by.push(fastest(better())?.number);
            }
        }
        by.sort_unstable();
        Some(by.into_iter().map(|other| &self.choices[other]).collect())
    }
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

/// A choice and what it takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Priced {
    pub name: String,
    pub pixel_ns: f64,
    pub ratio: Ratio,
}

/// What exact coverage costs over the cheapest choice of both groups, for each class of scenes.
pub fn prices(boards: &[Board]) -> Vec<Price> {
    let coverage: Vec<&Board> = boards.iter().filter(|board| board.ladder.is_coverage()).collect();
    let Some(first) = coverage.first() else { return Vec::new() };
    let mut prices = Vec::new();
    for column in first.columns_run() {
        // The choices of both groups compete, by what they promise.
        let all: Vec<JudgedChoice<'_>> =
            coverage.iter().flat_map(|board| board.ran(column)).collect();
        let Some(cheapest) = priced(&all, |_| true) else { continue };
        prices.push(Price {
            column: first.columns[column].name.to_string(),
            cheapest,
            unpromised: priced(&all, |one| one.choice().promises.is_empty()),
            snapped: priced(&all, |one| one.promises(SNAPPED)),
            given: priced(&all, |one| one.promises(GIVEN)),
        });
    }
    prices
}

/// The cheapest of the choices that are meant.
fn priced(all: &[JudgedChoice<'_>], is_meant: fn(&JudgedChoice<'_>) -> bool) -> Option<Priced> {
    let cheapest = fastest(all.iter().copied().filter(is_meant))?;
    let name = format!("{} {}", cheapest.board.ladder.short(), cheapest.name());
    let time = cheapest.run.time.as_ref()?;
    Some(Priced { name, pixel_ns: time.pixel_ns.median, ratio: time.times })
}
