//! What a board says: which choice is good enough and cheapest, which ones nobody needs, and what
//! exactness costs.

use serde::Serialize;

use super::{Board, Choice, Ratio, RatioKind, Run, Times};

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

/// The cheapest exact choice of a column, and those of which the same rounds do not show that they are slower.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cheapest {
    pub choice: usize,
    /// Those between which and it there is no difference.
    pub equal: Vec<usize>,
    /// Those that may be faster or slower than it, for all that was measured.
    pub undecided: Vec<usize>,
    pub rounds: usize,
}

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

    #[must_use]
    pub fn is_exact(&self, measure: usize) -> bool {
        self.board.meets(self.number, self.column, measure) == Some(true)
    }

    /// The times of all rounds; nothing where it was not timed.
    #[must_use]
    pub fn times(&self) -> Option<&'a Times> {
        self.run.time.as_ref()?.rounds.as_ref()
    }

    #[must_use]
    pub fn over(&self, other: &Self) -> Option<Ratio> {
        match (self.number == other.number, std::ptr::eq(self.board, other.board)) {
            (true, true) => Some(Ratio::ONE),
            _ => self.times()?.over(other.times()?),
        }
    }

    fn pixel_ns(&self) -> Option<f64> {
        Some(self.run.time.as_ref()?.pixel_ns.median)
    }
}

/// The choice with the least median time; nothing where none was timed.
#[must_use]
pub fn fastest<'a>(choices: impl Iterator<Item = JudgedChoice<'a>>) -> Option<JudgedChoice<'a>> {
    let timed = choices.filter_map(|choice| Some((choice.pixel_ns()?, choice)));
    timed.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, choice)| choice)
}

impl Board {
    pub fn ranking(&self) -> impl Iterator<Item = usize> {
        self.measures.iter().enumerate().filter(|(_, m)| m.goal.is_some()).map(|(i, _)| i)
    }

    /// Whether an error is as good as none; `None` where it was not measured.
    #[must_use]
    pub fn meets(&self, choice: usize, column: usize, measure: usize) -> Option<bool> {
        let error = self.error(choice, column, measure)?;
        Some(error <= self.measures[measure].goal? && self.columns[column].is_judged())
    }

    /// The choices that ran on a column.
    pub fn ran(&self, column: usize) -> impl Iterator<Item = JudgedChoice<'_>> {
        (0..self.choices.len()).filter_map(move |number| {
            Some(JudgedChoice { board: self, number, column, run: self.run(number, column)? })
        })
    }

    pub fn columns_run(&self) -> impl Iterator<Item = usize> {
        (0..self.columns.len()).filter(|&column| self.ran(column).next().is_some())
    }

    /// The fastest choice that a measure calls exact.
    #[must_use]
    pub fn cheapest_exact(&self, column: usize, measure: usize) -> Option<JudgedChoice<'_>> {
        fastest(self.ran(column).filter(|choice| choice.is_exact(measure)))
    }

    /// The cheapest choices of a column by a measure; `None` without times.
    pub fn best(&self, column: usize, measure: usize) -> Option<Best> {
        let promises = |choice: &JudgedChoice<'_>| choice.choice().promises.contains(&measure);
        let number = |choice: JudgedChoice<'_>| choice.number;
        Some(Best {
            fastest: fastest(self.ran(column))?.number,
            good: self.cheapest_exact(column, measure).map(number),
            certain: fastest(self.ran(column).filter(promises)).map(number),
        })
    }

    /// The cheapest exact choice with those that are as fast, as far as it can be told.
    #[must_use]
    pub fn compared(&self, column: usize, measure: usize) -> Option<Cheapest> {
        let best = self.cheapest_exact(column, measure)?;
        let (mut equal, mut undecided) = (Vec::new(), Vec::new());
        let others = self.ran(column).filter(|other| other.number != best.number);
        for other in others.filter(|other| other.is_exact(measure)) {
            let Some(ratio) = other.over(&best) else { continue };
            match ratio.said() {
                RatioKind::NoDifference => equal.push(other.number),
                RatioKind::CannotBeTold if ratio.low <= 1.0 => undecided.push(other.number),
                RatioKind::CannotBeTold | RatioKind::Holds => {}
            }
        }
        let rounds = best.times().map_or(0, Times::rounds);
        Some(Cheapest { choice: best.number, equal, undecided, rounds })
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
    let coverage: Vec<&Board> = boards.iter().filter(|board| board.ladder.is_coverage()).collect();
    let Some(first) = coverage.first() else { return Vec::new() };
    let price = |column: usize| {
        let cheapest = |filter: &dyn Fn(&[usize]) -> bool| {
            let all = coverage.iter().flat_map(|board| board.ran(column));
            let cheapest = fastest(all.filter(|choice| filter(&choice.choice().promises)))?;
            let name = format!("{} {}", cheapest.board.ladder.short(), cheapest.name());
            let time = cheapest.run.time.as_ref()?;
            Some(Priced { name, pixel_ns: time.pixel_ns.median, ratio: time.times })
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
