//! What `cost --json` printed, read back: the same boards, or what is wrong and in which line.

use serde::{Deserialize, Deserializer, de};

use super::{Board, Cell, Column, Ratio, Spread};

/// A run of `cost`: what was measured, and the command that repeats it.
#[derive(Clone, Debug, Deserialize)]
pub struct Recorded {
    pub version: String,
    pub repeat: String,
    pub seed: u64,
    pub quick: bool,
    /// The boards, each group once.
    #[serde(deserialize_with = "checked")]
    pub boards: Vec<Board>,
}

impl Recorded {
    /// Reads what `cost --json` printed. What follows from the boards, as which choice is the
    /// cheapest, is not read but found again.
    ///
    /// # Errors
    /// A sentence that begins with the line at which the reader stopped: no JSON, a field that is
    /// missing or of another kind, or boards whose parts do not fit each other.
    // Inlined: compiled where it is called, which need not be for speed.
    #[inline]
    pub fn read(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| {
            let (line, told) = (error.line(), error.to_string());
            // The library ends its sentence with the place.
            let what = told.split(" at line ").next().unwrap_or("");
            format!("line {line}: {what}")
        })
    }
}

/// A board whose parts fit each other.
struct Fitting(Board);

impl<'de> Deserialize<'de> for Fitting {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let board = Board::deserialize(from)?;
        match misfit(&board) {
            None => Ok(Self(board)),
            Some(what) => Err(de::Error::custom(format!("board {}: {what}", board.ladder.name()))),
        }
    }
}

/// Boards that fit each other: each group once, and both groups of coverage on the same scenes.
fn checked<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Board>, D::Error> {
    let boards: Vec<Board> =
        Vec::<Fitting>::deserialize(from)?.into_iter().map(|fitting| fitting.0).collect();
    let mut seen = Vec::new();
    for board in &boards {
        if seen.contains(&board.ladder) {
            return Err(de::Error::custom(format!("two boards of {}", board.ladder.name())));
        }
        seen.push(board.ladder);
    }
    let mut coverage = boards.iter().filter(|board| board.ladder.is_coverage());
    if let (Some(a), Some(b)) = (coverage.next(), coverage.next())
        && a.columns.iter().map(named).ne(b.columns.iter().map(named))
    {
        return Err(de::Error::custom("scanline and edge-function are of different scenes"));
    }
    Ok(boards)
}

fn named(column: &Column) -> (&str, u64, u64) {
    (&column.name, column.items, column.pixels)
}

/// What does not fit in a board. Everything that shows boards relies on these.
fn misfit(board: &Board) -> Option<String> {
    let (choices, columns, measures) =
        (board.choices.len(), board.columns.len(), board.measures.len());
    // The first measure is the error of the plots; of coverage all four are asked for by number.
    let least = if board.ladder.is_coverage() { 4 } else { 1 };
    if measures < least {
        return Some(format!("{measures} measures, and at least {least} are needed"));
    }
    if board.cells.len() != choices {
        return Some(format!("{} rows of cells for {choices} choices", board.cells.len()));
    }
    let noises = board.columns.iter().filter_map(|column| column.noise);
    if let Some(noise) = noises.map(of_ratio).find(|noise| !are_sorted(noise)) {
        return Some(format!("{noise:?} are not the interval of a ratio"));
    }
    for (choice, row) in board.choices.iter().zip(&board.cells) {
        let name = &choice.name;
        if row.len() != columns {
            return Some(format!("{} cells of choice {name} for {columns} columns", row.len()));
        }
        if let Some(promise) = choice.promises.iter().find(|&&measure| measure >= measures) {
            return Some(format!("choice {name} promises measure {promise} of {measures}"));
        }
        for (column, run) in board.columns.iter().zip(row.iter().map(Cell::run)) {
            let Some(run) = run else { continue };
            let place = format!("{name} on {}", column.name);
            if run.errors.len() != measures {
                let errors = run.errors.len();
                return Some(format!("{place} has {errors} errors for {measures} measures"));
            }
            if let Some(error) = run.errors.iter().flatten().find(|error| **error < 0.0) {
                return Some(format!("{place} has an error of {error}"));
            }
            let Some(time) = &run.time else { continue };
            let Spread { low, median, high } = time.pixel_ns;
            let both = [
                ([low, median, high], "quartiles of times"),
                (of_ratio(time.times), "interval of a ratio"),
            ];
            if let Some((numbers, what)) = both.iter().find(|(numbers, _)| !are_sorted(numbers)) {
                return Some(format!("{place}: {numbers:?} are not the {what}"));
            }
        }
    }
    None
}

fn of_ratio(ratio: Ratio) -> [f64; 3] {
    [ratio.low, ratio.median, ratio.high]
}

/// Whether three numbers may be of times.
fn are_sorted(&[low, median, high]: &[f64; 3]) -> bool {
    0.0 <= low && low <= median && 0.0 < median && median <= high
}
