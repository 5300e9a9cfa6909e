//! What accuracy costs: every rung of a ladder on every class of scenes, verified, then timed.
//!
//! A [`Board`] is a value: errors are decided by the seed alone, times are of this run. The result
//! of a rung is compared with the oracle before the rung is timed, so no time is ever shown without
//! its error. Times are medians over interleaved rounds in one process, so that what disturbs the
//! machine disturbs all rungs alike. It draws nothing and prints nothing.

mod antialiasing;
mod bounds;
mod clock;
mod coverage;
mod depth;
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
pub use clock::{Pass, Spread, Time, time};
pub use coverage::{Variant, variants, wrong_pixels};
pub use external::ExternalVariant;
pub use interpolation::{WrongValues, wrong_values};
pub use race::{EQUAL, Finish, Race, race};
pub use recorded::Recorded;
pub use verdict::{Best, Dominated, Price, Priced, prices};

rasterproof_core::named! {
    /// A ladder of rungs that do the same job. In the order of the boards; its name is also a name of files.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Ladder {
        /// Coverage by walking down the edges.
        Scanline = "scanline",
        /// Coverage by testing samples against edges.
        EdgeFunction = "edge-function",
        /// Attributes at covered pixels.
        Interpolation = "interpolation",
        /// Formats of the depth buffer.
        Depth = "depth",
        /// Formats of a shadow map, and the bias with which depths are compared.
        Shadows = "shadows",
        /// Levels of detail of a texture, by differences and by derivatives.
        Levels = "levels",
        /// Samples for each pixel.
        Antialiasing = "antialiasing",
        /// Line drawers.
        Lines = "lines",
    }
}

impl Ladder {
    /// What it is a ladder of.
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
pub struct Options {
    /// Decides every scene, and with them every error.
    pub seed: u64,
    /// Smaller scenes and fewer rounds.
    pub quick: bool,
    /// Whether to time at all; errors do not need it.
    pub timed: bool,
}

/// A kind of error.
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

/// A class of scenes, the columns of a board.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    pub name: Name,
    pub about: String,
    /// Triangles or lines.
    pub items: u64,
    /// Pixels that they cover, added up, by the oracle.
    pub pixels: u64,
}

impl Column {
    fn new(name: &'static str, about: String, items: u64, pixels: u64) -> Self {
        Self { name: name.into(), about, items, pixels }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    pub name: Name,
    /// How it works, in a few words.
    pub about: Name,
    /// Of which measures, by number, it promises to meet the goal, whatever the scene.
    pub promises: Vec<usize>,
}

impl Rung {
    fn new(name: &'static str, about: &'static str, promises: &[usize]) -> Self {
        Self { name: name.into(), about: about.into(), promises: promises.to_vec() }
    }
}

/// What became of a rung on a class of scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cell {
    /// It was not run, and why.
    NotRun(String),
    /// It was.
    Run(Run),
}

impl Cell {
    /// What was measured, if anything.
    pub fn run(&self) -> Option<&Run> {
        match self {
            Self::Run(run) => Some(run),
            Self::NotRun(_) => None,
        }
    }
}

/// What was measured of a rung on a class of scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// For each measure of the board its error, where the measure applies.
    pub errors: Vec<Option<f64>>,
    /// Counted work, where the rung counts.
    pub work: Option<Work>,
    /// Time, where it was taken.
    pub time: Option<Time>,
}

/// The measurements of one ladder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Board {
    pub ladder: Ladder,
    pub seed: u64,
    /// Rounds that the medians are over, 0 without times.
    pub rounds: usize,
    /// The kinds of error.
    pub measures: Vec<Measure>,
    /// Classes of scenes.
    pub columns: Vec<Column>,
    pub rungs: Vec<Rung>,
    /// A row for each rung, in it a cell for each column.
    pub cells: Vec<Vec<Cell>>,
}

impl Board {
    /// The measurement of a rung on a class of scenes.
    pub fn run(&self, rung: usize, column: usize) -> Option<&Run> {
        self.cells[rung][column].run()
    }

    /// An error, where it was measured.
    pub fn error(&self, rung: usize, column: usize, measure: usize) -> Option<f64> {
        self.run(rung, column)?.errors[measure]
    }

    /// Nanoseconds for each covered pixel.
    #[must_use]
    pub fn time(&self, rung: usize, column: usize) -> Option<&Time> {
        self.run(rung, column)?.time.as_ref()
    }
}

/// Measures a ladder. `progress` gets the share done, from 0 to 1, and a word about it.
pub fn measure(ladder: Ladder, options: &Options, progress: &dyn Fn(f64, &str)) -> Board {
    measure_with(ladder, options, &mut [], progress)
}

/// The same with external variants on the ladder of edge functions.
pub fn measure_with(
    ladder: Ladder,
    options: &Options,
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

/// Measures a ladder on scenes of the caller; nothing for a ladder that draws scenes of its own. Errors are taken at as
/// many pixels whether the measurement is quick or not.
pub fn measure_on(
    ladder: Ladder,
    scenes: &[scene::Scene],
    options: &Options,
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
enum Prepared<'a> {
    NotRun(String),
    Ready { errors: Vec<Option<f64>>, work: Option<Work>, pass: Box<dyn FnMut() + 'a> },
}

/// The classes of scenes on which a ladder is not measured that has columns of its own, with the reason.
fn no_classes(
    options: &Options,
    why: &str,
    columns: &mut Vec<Column>,
    prepared: &mut [Vec<Prepared<'_>>],
) {
    for class in scene::scenes(options.seed, scene::Size { side_px: 64, pixels: 0 }) {
        prepared.iter_mut().for_each(|row| row.push(Prepared::NotRun(why.to_owned())));
        columns.push(Column::new(class.name, class.about.to_owned(), 0, 0));
    }
}

/// Times what was prepared (cells by rung, then by column) and puts the board together.
fn finish(
    (ladder, measures): (Ladder, Vec<Measure>),
    (rungs, columns): (Vec<Rung>, Vec<Column>),
    prepared: Vec<Vec<Prepared<'_>>>,
    options: &Options,
    (progress, afterwards): Told<'_>,
) -> Board {
    let mut passes: Vec<clock::Pass<'_>> = Vec::new();
    let mut cells: Vec<Vec<Cell>> = Vec::new();
    let mut places = Vec::new();
    for (rung, row) in prepared.into_iter().enumerate() {
        let mut out = Vec::new();
        for (column, cell) in row.into_iter().enumerate() {
            out.push(match cell {
                Prepared::NotRun(why) => Cell::NotRun(why),
                Prepared::Ready { errors, work, pass } => {
                    passes.push(clock::Pass { column, run: pass });
                    places.push((rung, column));
                    Cell::Run(Run { errors, work, time: None })
                }
            });
        }
        cells.push(out);
    }
    let rounds = if options.timed { clock::rounds(options.quick) } else { 0 };
    if options.timed {
        let spreads = clock::time(&mut passes, rounds, options.quick, &|share| {
            progress(0.3 + 0.7 * share, ladder.title());
        });
        for ((rung, column), spread) in places.into_iter().zip(spreads) {
            if let Cell::Run(run) = &mut cells[rung][column] {
                let Column { items, pixels, .. } = columns[column];
                run.time = Some(Time::new(spread, pixels, items));
            }
        }
    }
    let board = Board { ladder, seed: options.seed, rounds, measures, columns, rungs, cells };
    afterwards(&board, &mut passes);
    board
}
