//! What accuracy costs: every choice of a group on every column of scenes, verified, then timed. A column is a class of made-up
//! scenes, or the model of a user.
//!
//! A [`Board`] is a value: errors are decided by the scenes alone, times are of this run. The result
//! of a choice is compared with the oracle before the choice is timed, so no time is ever shown without
//! its error. All choices of a column are timed in the same rounds ([`compare`]). It draws nothing and prints nothing.

pub mod antialiasing;
mod bounds;
mod clock;
pub mod coverage;
mod depth;
mod entry;
pub mod interpolation;
mod levels;
mod lines;
mod measured;
mod recorded;
mod sampled;
pub mod scene;
mod shadow;
mod tiles;
mod verdict;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::ladder::Work;
pub use bounds::Bound;
pub use clock::{CELLS, Clock, Pass, Ratio, RatioKind, Spread, Times, Timing, compare};
pub use coverage::ExternalChoice;
pub use entry::Entry;
pub use measured::{PreparedCell, add_column, measure, measure_with};
pub use recorded::Recorded;
pub use verdict::{Cheapest, JudgedChoice, Price, Priced, fastest, prices};

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
        /// Whole frames with all stages, on the board of a model; classes of scenes have none.
        Frames = "frames",
    }
}

impl Ladder {
    /// Those that are measured on classes of scenes.
    pub const OF_SCENES: &'static [Self] = Self::ALL.split_at(8).0;

    /// Both groups of coverage do the same job.
    #[must_use]
    pub fn is_coverage(self) -> bool {
        matches!(self, Self::Scanline | Self::EdgeFunction)
    }

    /// Beside the name of a choice of coverage.
    #[must_use]
    pub fn short(self) -> &'static str {
        if self == Self::EdgeFunction { "edge" } else { self.name() }
    }

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
            Self::Frames => "Whole frames",
        }
    }

    /// By what the choices of a group are judged; the first measure is the error of the plots.
    fn measures(self) -> Vec<Measure> {
        const EXACT: Option<f64> = Some(0.0);
        let listed = match self {
            Self::Scanline | Self::EdgeFunction => vec![
                ("wrong pixels per million, against the vertices as given", "wrong/M", EXACT),
                ("wrong pixels per million, against the snapped vertices", "snapped", EXACT),
                ("pixels inside the mesh that no triangle hits", "holes", None),
                ("pixels inside the mesh that two triangles hit", "twice", None),
            ],
            Self::Interpolation => {
                let goal = Some(interpolation::HALF_STEP);
                vec![
                    ("worst error over M, the largest value of a vertex", "error / M", goal),
                    ("worst error in units of u M, u of the float used", "u M", None),
                    ("worst error over its derived bound", "of bound", None),
                ]
            }
            Self::Depth => {
                let layers =
                    "pixels per million showing the wrong one of two layers z / 10,000 apart";
                let gap = "gap: the least distance behind z that is stored as another depth";
                let step = "step: the largest such gap over a thousand distances around z";
                vec![(layers, "wrong/M", EXACT), (gap, "gap", None), (step, "step", None)]
            }
            Self::Shadows => {
                let missed = "places per million in shadow that some light reaches";
                let acne = "places per million in the light that keep some of it from themselves";
                vec![(missed, "missed/M", EXACT), (acne, "acne/M", EXACT)]
            }
            Self::Levels => vec![
                ("largest distance from the exact level of detail", "levels", Some(levels::STEP)),
                ("mean distance from the exact level of detail", "mean", None),
            ],
            Self::Antialiasing => {
                let rms =
                    "root mean square distance from the exact share, over the pixels on an edge";
                vec![(rms, "rms", EXACT)]
            }
            Self::Lines => {
                vec![("wrong pixels per million, against the exact line", "wrong/M", EXACT)]
            }
            Self::Frames => Vec::new(),
        };
        listed.into_iter().map(|(title, short, goal)| Measure::new(title, short, goal)).collect()
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
    pub fn new(title: impl Into<Name>, short: impl Into<Name>, goal: Option<f64>) -> Self {
        Self { title: title.into(), short: short.into(), goal, unit: None }
    }

    #[must_use]
    pub fn counts(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), ..self }
    }
}

/// How much of something there is, and of how much it is a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Part {
    pub part: u64,
    pub of: u64,
}

impl Part {
    #[must_use]
    pub fn all(of: u64) -> Self {
        Self { part: of, of }
    }

    #[must_use]
    pub fn is_all(self) -> bool {
        self.part == self.of
    }
}

/// Of how much of a model a column is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// How many of its triangles are timed.
    pub items: Part,
    /// How many pixels these triangles cover, of those that all of them cover.
    pub pixels: Part,
    /// Pixels in which it was looked for errors.
    pub judged: Part,
    /// Pixels of hard cases in which it was looked for what is wrong, where that is another part.
    pub looked_at: Option<Part>,
    /// Pieces that were left out, since single precision does not hold a value or 1/w of a corner.
    pub not_judged: u64,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Column {
    pub name: Name,
    pub about: String,
    pub items: u64,
    /// Pixels that they cover, added up, by the oracle.
    pub pixels: u64,
    /// The ratio of two equal passes, where there were rounds enough.
    pub noise: Option<Ratio>,
    /// None of a class of scenes, all of which is judged and timed.
    #[serde(skip)]
    pub sampling: Option<Sampling>,
}

impl Column {
    fn new(name: &'static str, about: impl Into<String>, items: u64, pixels: u64) -> Self {
        Self { name: name.into(), about: about.into(), items, pixels, noise: None, sampling: None }
    }

    #[must_use]
    pub fn of_model(sampling: Sampling) -> Self {
        let [items, pixels] = [sampling.items.part, sampling.pixels.part];
        Self {
            sampling: Some(sampling),
            ..Self::new("model", "the triangles of the model", items, pixels)
        }
    }

    /// Whether any pixel was compared; where none was, nothing is exact.
    fn is_judged(&self) -> bool {
        self.sampling.is_none_or(|sampling| sampling.judged.part > 0)
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    pub name: Name,
    pub about: Name,
    /// Of which measures, by number, it promises to meet the goal, whatever the scene.
    pub promises: Vec<usize>,
    /// What its buffers hold for each pixel of a window and for each triangle, in bytes.
    #[serde(skip)]
    pub bytes: [u64; 2],
}

impl Choice {
    pub fn new(name: impl Into<Name>, about: impl Into<Name>, promises: &[usize]) -> Self {
        // Most choices write a number of 32 bits.
        let bytes = [size_of::<u32>() as u64, 0];
        Self { name: name.into(), about: about.into(), promises: promises.to_vec(), bytes }
    }

    #[must_use]
    pub fn holding(self, of_pixel: usize, of_triangle: usize) -> Self {
        Self { bytes: [of_pixel, of_triangle].map(|bytes| bytes as u64), ..self }
    }
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cell {
    /// It was not run, and why.
    NotRun(String),
    Run(Box<Run>),
}

impl Cell {
    pub fn run(&self) -> Option<&Run> {
        match self {
            Self::Run(run) => Some(run),
            Self::NotRun(_) => None,
        }
    }
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Run {
    /// For each measure of the board its error, where the measure applies.
    pub errors: Vec<Option<f64>>,
    /// Counted work, where the choice counts.
    pub work: Option<Work>,
    pub time: Option<Time>,
    #[serde(skip)]
    pub found: Details,
}

impl Run {
    fn of(errors: Vec<Option<f64>>) -> Self {
        Self { errors, ..Self::default() }
    }
}

/// What is kept of a choice on a model, beside its errors.
#[derive(Clone, Debug, Default)]
pub struct Details {
    /// Pixels that are wrong by the first two measures, where these count any.
    pub pixels: [u64; 2],
    /// Where it is wrong first: the triangle, where it is of one, and the pixel.
    pub first: Option<(Option<u32>, [i32; 2])>,
    /// Wrong samples by the triangles that they are of: the one that should be there, and the one that is.
    pub wrong: Vec<([u32; 2], u64)>,
    /// The smallest distance of a decision from 0, in error bounds; where such a bound is derived.
    pub margin: Option<f64>,
    /// The most memory that was in use at once; nothing where it was not measured.
    pub bytes: Option<u64>,
}

/// The time of a choice on a column.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Time {
    /// Nanoseconds for each covered pixel.
    pub pixel_ns: Spread,
    /// Over the cheapest choice of the column, in all groups that were measured together.
    pub times: Ratio,
    /// Round by round; none where it was read from a file.
    #[serde(skip)]
    pub rounds: Option<Times>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
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
        self.run(choice, column)?.errors.get(measure).copied().flatten()
    }

    pub fn time(&self, choice: usize, column: usize) -> Option<&Time> {
        self.run(choice, column)?.time.as_ref()
    }
}
