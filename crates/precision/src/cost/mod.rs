//! What accuracy costs: every choice of a group on every class of scenes, verified, then timed.
//!
//! A [`Board`] is a value: errors are decided by the seed alone, times are of this run. The result
//! of a choice is compared with the oracle before the choice is timed, so no time is ever shown without
//! its error. All choices of a class of scenes are timed in the same rounds ([`compare`]). It draws nothing and prints nothing.

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
mod recorded;
pub mod scene;
mod shadow;
mod tiles;
mod verdict;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ladder::Work;
pub use bounds::Bound;
pub use clock::{
    CELLS, Clock, Pair, Pass, Places, Ratio, RatioKind, Spread, Times, Timing, compare,
    over_fastest,
};
pub use coverage::{Variant, variants, wrong_pixels};
pub use external::ExternalVariant;
pub use interpolation::{WrongValues, compared_values, wrong_values};
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

    /// By what the choices of a group are judged; the first measure is the error of the plots.
    fn measures(self) -> Vec<Measure> {
        match self {
            Self::Scanline | Self::EdgeFunction => vec![
                Measure::new(
                    "wrong pixels per million, against the vertices as given",
                    "wrong/M",
                    Some(0.0),
                ),
                Measure::new(
                    "wrong pixels per million, against the snapped vertices",
                    "snapped",
                    Some(0.0),
                ),
                Measure::new("pixels inside the mesh that no triangle hits", "holes", None),
                Measure::new("pixels inside the mesh that two triangles hit", "twice", None),
            ],
            Self::Interpolation => vec![
                Measure::new(
                    "worst error over M, the largest value of a vertex",
                    "error / M",
                    Some(interpolation::HALF_STEP),
                ),
                Measure::new("worst error in units of u M, u of the float used", "u M", None),
                Measure::new("worst error over its derived bound", "of bound", None),
            ],
            Self::Depth => vec![
                Measure::new(
                    "pixels per million showing the wrong one of two layers z / 10,000 apart",
                    "wrong/M",
                    Some(0.0),
                ),
                Measure::new(
                    "gap: the least distance behind z that is stored as another depth",
                    "gap",
                    None,
                ),
                Measure::new(
                    "step: the largest such gap over a thousand distances around z",
                    "step",
                    None,
                ),
            ],
            Self::Shadows => vec![
                Measure::new(
                    "places per million in shadow that some light reaches",
                    "missed/M",
                    Some(0.0),
                ),
                Measure::new(
                    "places per million in the light that keep some of it from themselves",
                    "acne/M",
                    Some(0.0),
                ),
            ],
            Self::Levels => vec![
                Measure::new(
                    "largest distance from the exact level of detail",
                    "levels",
                    Some(levels::STEP),
                ),
                Measure::new("mean distance from the exact level of detail", "mean", None),
            ],
            Self::Antialiasing => {
                let title =
                    "root mean square distance from the exact share, over the pixels on an edge";
                vec![Measure::new(title, "rms", Some(0.0))]
            }
            Self::Lines => {
                let title = "wrong pixels per million, against the exact line";
                vec![Measure::new(title, "wrong/M", Some(0.0))]
            }
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
    /// What stands beside a count in a sentence; `None` for a measure that counts nothing, and where it was read from a file.
    #[serde(skip)]
    pub unit: Option<&'static str>,
}

impl Measure {
    pub fn new(title: &'static str, short: &'static str, goal: Option<f64>) -> Self {
        Self { title: title.into(), short: short.into(), goal, unit: None }
    }

    #[must_use]
    pub fn counts(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), ..self }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    pub name: Name,
    pub about: String,
    pub items: u64,
    /// Pixels that they cover, added up, by the oracle.
    pub pixels: u64,
    /// The ratio of two equal passes, where there were rounds enough.
    pub noise: Option<Ratio>,
}

impl Column {
    fn new(name: &'static str, about: impl Into<String>, items: u64, pixels: u64) -> Self {
        Self { name: name.into(), about: about.into(), items, pixels, noise: None }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    pub name: Name,
    pub about: Name,
    /// Of which measures, by number, it promises to meet the goal, whatever the scene.
    pub promises: Vec<usize>,
}

impl Choice {
    pub fn new(name: impl Into<Name>, about: impl Into<Name>, promises: &[usize]) -> Self {
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

/// The time of a choice on a class of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// Nanoseconds for each covered pixel.
    pub pixel_ns: Spread,
    /// Over the cheapest choice of the class, in all groups that were measured together.
    pub times: Ratio,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Board {
    #[serde(rename = "group")]
    pub ladder: Ladder,
    pub seed: u64,
    /// The fewest rounds that a median is over, 0 without times.
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
    let mut boards = measure_with(&[ladder], options, &mut [], progress);
    boards.pop().expect("a board for each ladder")
}

/// Measures some ladders, with external variants on the group of edge functions. Both groups of coverage do the same job, so
/// they are timed in the same rounds.
pub fn measure_with(
    ladders: &[Ladder],
    options: &CostOptions,
    external: &mut [Box<dyn ExternalVariant>],
    progress: &dyn Fn(f64, &str),
) -> Vec<Board> {
    let is_coverage = |ladder: &&Ladder| matches!(ladder, Ladder::Scanline | Ladder::EdgeFunction);
    let coverage: Vec<Ladder> = ladders.iter().filter(is_coverage).copied().collect();
    let others: Vec<Ladder> = ladders.iter().filter(|one| !is_coverage(one)).copied().collect();
    let parts = others.len() + usize::from(!coverage.is_empty());
    let done = std::cell::Cell::new(0);
    let told = |share: f64, what: &str| progress((done.get() as f64 + share) / parts as f64, what);
    let mut boards = Vec::new();
    if !coverage.is_empty() {
        boards = coverage::measure(&coverage, options, external, &told);
        done.set(1);
    }
    for ladder in others {
        boards.push(match ladder {
            Ladder::Interpolation => interpolation::measure(options, &told),
            Ladder::Depth => depth::measure(options, &told),
            Ladder::Shadows => shadow::measure(options, &told),
            Ladder::Levels => levels::measure(options, &told),
            Ladder::Lines => lines::measure(options, &told),
            Ladder::Scanline | Ladder::EdgeFunction | Ladder::Antialiasing => {
                antialiasing::measure(options, &told)
            }
        });
        done.set(done.get() + 1);
    }
    boards
}

/// A pass with the numbers of its choice and its column.
pub struct PlacedPass<'a> {
    pub choice: usize,
    pub column: usize,
    pub pass: Pass<'a>,
}

/// What happens to a board and the passes of its cells.
pub type Afterwards<'a> = &'a mut dyn FnMut(&Board, Vec<PlacedPass<'_>>);

/// The errors of a group on scenes of the caller, who may time its passes; nothing for a group that draws scenes of its own. Errors
/// are taken at as many pixels whether the measurement is quick or not.
pub fn measure_on(ladder: Ladder, scenes: &[scene::Scene], afterwards: Afterwards<'_>) {
    let options = CostOptions { seed: 0, quick: false, timing: None };
    let told: Told<'_> = (&|_, _| (), afterwards);
    match ladder {
        Ladder::Interpolation => {
            interpolation::measure_on(scenes, &options, interpolation::SAMPLES, told);
        }
        Ladder::Antialiasing => drop(antialiasing::measure_on(scenes, &options, told)),
        _ => {}
    }
}

/// The function that shows progress, and what happens to the passes that are not timed.
type Told<'a> = (&'a dyn Fn(f64, &str), Afterwards<'a>);

/// A cell before it is timed.
enum PreparedCell<'a> {
    NotRun(String),
    Ready { errors: Vec<Option<f64>>, work: Option<Work>, pass: Pass<'a> },
}

impl<'a> PreparedCell<'a> {
    fn ready(errors: Vec<Option<f64>>, pass: impl FnMut() + 'a) -> Self {
        Self::Ready { errors, work: None, pass: Pass::new(pass) }
    }
}

/// A board before it is timed.
struct Draft<'a> {
    board: Board,
    passes: Vec<PlacedPass<'a>>,
}

impl<'a> Draft<'a> {
    fn new(ladder: Ladder, choices: impl Iterator<Item = Choice>, options: &CostOptions) -> Self {
        let choices: Vec<Choice> = choices.collect();
        let cells = choices.iter().map(|_| Vec::new()).collect();
        let (seed, columns, measures) = (options.seed, Vec::new(), ladder.measures());
        let board = Board { ladder, seed, rounds: 0, measures, columns, choices, cells };
        Self { board, passes: Vec::new() }
    }

    /// Tells `progress` how many of the classes of scenes are prepared.
    fn tell(&self, progress: &dyn Fn(f64, &str), classes: usize) {
        let Board { columns, ladder, .. } = &self.board;
        progress(0.3 * columns.len() as f64 / classes as f64, ladder.title());
    }

    fn add(&mut self, class: Column, cells: impl Iterator<Item = PreparedCell<'a>>) {
        let column = self.board.columns.len();
        self.board.columns.push(class);
        for (choice, (row, cell)) in self.board.cells.iter_mut().zip(cells).enumerate() {
            row.push(match cell {
                PreparedCell::NotRun(why) => Cell::NotRun(why),
                PreparedCell::Ready { errors, work, pass } => {
                    self.passes.push(PlacedPass { choice, column, pass });
                    Cell::Run(Run { errors, work, time: None })
                }
            });
        }
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

    /// Times what was prepared.
    fn finish(self, options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
        finish(vec![self], options, progress).pop().expect("a board of a draft")
    }
}

impl Draft<'_> {
    /// Times what was prepared, or gives it away where nothing says how to time it.
    fn finish_or_give(self, options: &CostOptions, (progress, afterwards): Told<'_>) -> Board {
        match options.timing {
            Some(_) => self.finish(options, progress),
            None => {
                afterwards(&self.board, self.passes);
                self.board
            }
        }
    }
}

/// Times what was prepared for boards with the same columns: all choices of a column in the same rounds.
fn finish(
    drafts: Vec<Draft<'_>>,
    options: &CostOptions,
    progress: &dyn Fn(f64, &str),
) -> Vec<Board> {
    let mut boards = Vec::new();
    let mut by_column: std::collections::BTreeMap<usize, Vec<(usize, PlacedPass<'_>)>> =
        Default::default();
    for (number, Draft { board, passes }) in drafts.into_iter().enumerate() {
        boards.push(board);
        for placed in passes {
            by_column.entry(placed.column).or_default().push((number, placed));
        }
    }
    let Some(timing) = options.timing else { return boards };
    let columns = by_column.len();
    for (done, (column, placed)) in by_column.into_iter().enumerate() {
        let title = boards[0].ladder.title();
        let (places, mut passes): (Vec<_>, Vec<_>) =
            placed.into_iter().map(|(board, one)| ((board, one.choice), one.pass)).unzip();
        let all = [(0..passes.len()).collect::<Vec<_>>()];
        let wanted = |medians: &[f64]| over_fastest(&all, medians);
        let told = |share: f64| progress(0.3 + 0.7 * (done as f64 + share) / columns as f64, title);
        let times = compare(&mut passes, timing, &wanted, &told);
        let Some(fastest) = times.iter().min_by(|a, b| a.median().total_cmp(&b.median())) else {
            continue;
        };
        for ((number, choice), of) in places.into_iter().zip(&times) {
            let board = &mut boards[number];
            let class = &mut board.columns[column];
            class.noise = of.noise();
            let pixel_ns = of.spread().times(1.0 / class.pixels.max(1) as f64);
            board.rounds = match board.rounds {
                0 => of.rounds(),
                rounds => rounds.min(of.rounds()),
            };
            if let (Cell::Run(run), Some(times)) =
                (&mut board.cells[choice][column], of.over(fastest))
            {
                run.time = Some(Time { pixel_ns, times });
            }
        }
    }
    boards
}
