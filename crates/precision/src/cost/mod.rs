//! What accuracy costs: every choice of a group on every class of scenes, verified, then timed.
//!
//! A [`Board`] is a value: errors are decided by the seed alone, times are of this run. The result
//! of a choice is compared with the oracle before the choice is timed, so no time is ever shown without
//! its error. Times are medians over interleaved rounds in one process, so that what disturbs the
//! machine disturbs all choices alike. It draws nothing and prints nothing.

mod antialiasing;
mod bounds;
mod clock;
mod coverage;
mod depth;
mod drawn;
mod external;
mod interpolation;
mod levels;
mod lines;
mod race;
mod recorded;
pub mod scene;
mod shadow;
mod tiles;
mod verdict;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ladder::Work;
pub use bounds::Bound;
pub use clock::{Pass, Spread, Time, Timing, time};
pub use coverage::{Variant, variants, wrong_pixels};
pub use external::ExternalVariant;
pub use interpolation::{WrongValues, wrong_values};
pub use race::{EQUAL, Finish, Race, race};
pub use recorded::Recorded;
pub use verdict::{Best, Dominated, Price, Priced, prices};

rasterproof_core::named! {
    /// A group of choices that do the same job. In the order of the boards; its name is also a name of files.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Ladder {
        Scanline = "scanline",
        EdgeFunction = "edge-function",
        Interpolation = "interpolation",
        Depth = "depth",
        /// Formats of a shadow map, and the bias with which depths are compared.
        Shadows = "shadows",
        /// Levels of detail of a texture, by differences and by derivatives.
        Levels = "levels",
        Antialiasing = "antialiasing",
        Lines = "lines",
    }
}

impl Ladder {
    pub fn title(self) -> &'static str {
        match self {
            Self::Scanline => "Coverage by scanline",
            Self::EdgeFunction => "Coverage by edge function",
            Self::Interpolation => "Interpolation",
            Self::Depth => "Depth",
            Self::Shadows => "Shadows",
            Self::Levels => "Levels of detail",
            Self::Antialiasing => "Antialiasing",
            Self::Lines => "Lines",
        }
    }
}

/// Words of a board: of the program where it was measured, of the file where it was read.
pub type Name = Cow<'static, str>;

#[derive(Clone, Copy, Debug)]
pub struct CostOptions {
    /// Decides every scene, and with them every error.
    pub seed: u64,
    /// Smaller scenes.
    pub quick: bool,
    /// How to time; errors do not need it.
    pub timing: Option<Timing>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// What is measured, with its unit.
    pub title: Name,
    /// Short name for a column or an axis.
    pub short: Name,
    /// Errors up to this one are as good as none; `None` for a measure that ranks nothing.
    pub goal: Option<f64>,
}

impl Measure {
    fn new(title: &'static str, short: &'static str, goal: Option<f64>) -> Self {
        Self { title: title.into(), short: short.into(), goal }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    pub name: Name,
    pub about: String,
    pub items: u64,
    /// Pixels that they cover, added up, by the oracle.
    pub pixels: u64,
}

impl Column {
    fn new(name: &'static str, about: impl Into<String>, items: u64, pixels: u64) -> Self {
        Self { name: name.into(), about: about.into(), items, pixels }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    pub name: Name,
    pub about: Name,
    /// Of which measures, by number, it promises to meet the goal, whatever the scene.
    pub promises: Vec<usize>,
}

impl Choice {
    fn new(name: &'static str, about: impl Into<Name>, promises: &[usize]) -> Self {
        Self { name: name.into(), about: about.into(), promises: promises.to_vec() }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cell {
    /// It was not run, and why.
    NotRun(String),
    Run(Run),
}

impl Cell {
    pub fn run(&self) -> Option<&Run> {
        match self {
            Self::Run(run) => Some(run),
            Self::NotRun(_) => None,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// For each measure of the board its error, where the measure applies.
    pub errors: Vec<Option<f64>>,
    /// Counted work, where the choice counts.
    pub work: Option<Work>,
    pub time: Option<Time>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Board {
    #[serde(rename = "group")]
    pub ladder: Ladder,
    pub seed: u64,
    /// Rounds that the medians are over, 0 without times.
    pub rounds: usize,
    pub measures: Vec<Measure>,
    pub columns: Vec<Column>,
    pub choices: Vec<Choice>,
    /// A row for each choice, in it a cell for each column.
    pub cells: Vec<Vec<Cell>>,
}

impl Board {
    pub fn run(&self, choice: usize, column: usize) -> Option<&Run> {
        self.cells[choice][column].run()
    }

    pub fn error(&self, choice: usize, column: usize, measure: usize) -> Option<f64> {
        self.run(choice, column)?.errors[measure]
    }

    pub fn time(&self, choice: usize, column: usize) -> Option<&Time> {
        self.run(choice, column)?.time.as_ref()
    }
}

/// Measures a ladder. `progress` gets the share done, from 0 to 1, and a word about it.
pub fn measure(ladder: Ladder, options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
    measure_with(ladder, options, &mut [], progress)
}

/// The same with external variants on the group of edge functions.
pub fn measure_with(
    ladder: Ladder,
    options: &CostOptions,
    external: &mut [Box<dyn ExternalVariant>],
    progress: &dyn Fn(f64, &str),
) -> Board {
    match ladder {
        Ladder::Scanline => coverage::measure(ladder, options, &mut [], progress),
        Ladder::EdgeFunction => coverage::measure(ladder, options, external, progress),
        Ladder::Interpolation => interpolation::measure(options, progress),
        Ladder::Depth => depth::measure(options, progress),
        Ladder::Shadows => shadow::measure(options, progress),
        Ladder::Levels => levels::measure(options, progress),
        Ladder::Lines => lines::measure(options, progress),
        Ladder::Antialiasing => antialiasing::measure(options, progress),
    }
}

/// What happens to a board and the passes that were timed for it, in the order of its cells.
pub type Afterwards<'a> = &'a mut dyn FnMut(&Board, &mut [Pass<'_>]);

/// Measures a group on scenes of the caller; nothing for a group that draws scenes of its own. Errors are taken at as
/// many pixels whether the measurement is quick or not.
pub fn measure_on(
    ladder: Ladder,
    scenes: &[scene::Scene],
    options: &CostOptions,
    afterwards: Afterwards<'_>,
) -> Option<Board> {
    let told: Told<'_> = (&|_, _| (), afterwards);
    match ladder {
        Ladder::Interpolation => {
            Some(interpolation::measure_on(scenes, options, interpolation::SAMPLES, told))
        }
        Ladder::Antialiasing => Some(antialiasing::measure_on(scenes, options, told)),
        _ => None,
    }
}

/// The function that shows progress, and what happens to the passes.
type Told<'a> = (&'a dyn Fn(f64, &str), Afterwards<'a>);

/// A cell before it is timed: a closure that does all of the work once.
enum PreparedCell<'a> {
    NotRun(String),
    Ready { errors: Vec<Option<f64>>, work: Option<Work>, pass: Box<dyn FnMut() + 'a> },
}

impl<'a> PreparedCell<'a> {
    fn ready(errors: Vec<Option<f64>>, pass: impl FnMut() + 'a) -> Self {
        Self::Ready { errors, work: None, pass: Box::new(pass) }
    }
}

struct Draft<'a> {
    ladder: Ladder,
    choices: Vec<Choice>,
    columns: Vec<Column>,
    /// By choice, then by column.
    cells: Vec<Vec<PreparedCell<'a>>>,
}

impl<'a> Draft<'a> {
    fn new(ladder: Ladder, choices: impl Iterator<Item = Choice>) -> Self {
        let choices: Vec<Choice> = choices.collect();
        let cells = choices.iter().map(|_| Vec::new()).collect();
        Self { ladder, choices, columns: Vec::new(), cells }
    }

    /// Tells `progress` how many of the classes of scenes are prepared.
    fn tell(&self, progress: &dyn Fn(f64, &str), classes: usize) {
        progress(0.3 * self.columns.len() as f64 / classes as f64, self.ladder.title());
    }

    fn add(&mut self, column: Column, cells: impl Iterator<Item = PreparedCell<'a>>) {
        self.columns.push(column);
        self.cells.iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
    }

    /// Adds a class of scenes on which no choice is measured, with the reason.
    fn leave_out(&mut self, column: Column, why: &str) {
        self.add(column, std::iter::repeat_with(|| PreparedCell::NotRun(why.to_owned())));
    }

    /// Adds the usual classes of scenes, on which a group is not measured that has columns of its own.
    fn leave_out_classes(&mut self, options: &CostOptions, why: &str) {
        for class in scene::scenes(options.seed, scene::Size { side_px: 64, pixels: 0 }) {
            self.leave_out(Column::new(class.name, class.about, 0, 0), why);
        }
    }

    /// Times what was prepared and puts the board together.
    fn finish(
        self,
        measures: Vec<Measure>,
        options: &CostOptions,
        (progress, afterwards): Told<'_>,
    ) -> Board {
        let Self { ladder, choices, columns, cells: prepared } = self;
        let mut passes: Vec<clock::Pass<'_>> = Vec::new();
        let mut cells: Vec<Vec<Cell>> = Vec::new();
        let mut places = Vec::new();
        for (choice, row) in prepared.into_iter().enumerate() {
            let mut out = Vec::new();
            for (column, cell) in row.into_iter().enumerate() {
                out.push(match cell {
                    PreparedCell::NotRun(why) => Cell::NotRun(why),
                    PreparedCell::Ready { errors, work, pass } => {
                        passes.push(clock::Pass { column, run: pass });
                        places.push((choice, column));
                        Cell::Run(Run { errors, work, time: None })
                    }
                });
            }
            cells.push(out);
        }
        let rounds = options.timing.map_or(0, |timing| timing.rounds);
        if let Some(timing) = options.timing {
            let spreads = clock::time(&mut passes, timing, &|share| {
                progress(0.3 + 0.7 * share, ladder.title());
            });
            for ((choice, column), spread) in places.into_iter().zip(spreads) {
                if let Cell::Run(run) = &mut cells[choice][column] {
                    let Column { items, pixels, .. } = columns[column];
                    run.time = Some(Time::new(spread, pixels, items));
                }
            }
        }
        let board = Board { ladder, seed: options.seed, rounds, measures, columns, choices, cells };
        afterwards(&board, &mut passes);
        board
    }
}
