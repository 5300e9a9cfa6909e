//! What `cost --json` printed, read back: the same boards, or what is wrong and in which line.

use serde::{Deserialize, Deserializer, de};

use super::{Board, Cell, Choice, Ratio, Run, Spread};

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

/// Boards whose parts fit each other.
fn checked<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Board>, D::Error> {
    let boards: Vec<Board> = Vec::deserialize(from)?;
    let fit = boards.iter().try_for_each(|board| {
        check(board).map_err(|what| format!("board {}: {what}", board.ladder.name()))
    });
    fit.and_then(|()| check_all(&boards)).map_err(de::Error::custom)?;
    Ok(boards)
}

/// Checks that there is each group once, and that both groups of coverage are of the same scenes.
fn check_all(boards: &[Board]) -> Result<(), String> {
    for (number, board) in boards.iter().enumerate() {
        let is_again = boards[..number].iter().any(|other| other.ladder == board.ladder);
        fits(!is_again, || format!("two boards of {}", board.ladder.name()))?;
    }
    let scenes = |board: &Board| {
        let columns = board.columns.iter();
        columns.map(|one| (one.name.clone(), one.items, one.pixels)).collect::<Vec<_>>()
    };
    let coverage = boards.iter().filter(|board| board.ladder.is_coverage()).map(scenes);
    let coverage: Vec<_> = coverage.collect();
    let is_same = coverage.windows(2).all(|both| both[0] == both[1]);
    fits(is_same, || "scanline and edge-function are of different scenes".to_owned())
}

fn fits(is_so: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if is_so { Ok(()) } else { Err(otherwise()) }
}

/// Checks that the parts of a board fit. Everything that shows boards relies on this.
fn check(board: &Board) -> Result<(), String> {
    let (choices, columns) = (board.choices.len(), board.columns.len());
    let measures = board.measures.len();
    // The first measure is the error of the plots; of coverage all four are asked for by number.
    let least = if board.ladder.is_coverage() { 4 } else { 1 };
    fits(measures >= least, || format!("{measures} measures, and at least {least} are needed"))?;
    let rows = board.cells.len();
    fits(rows == choices, || format!("{rows} rows of cells for {choices} choices"))?;
    for noise in board.columns.iter().filter_map(|column| column.noise) {
        check_ratio(noise)?;
    }
    for (Choice { name, promises, .. }, row) in board.choices.iter().zip(&board.cells) {
        let cells = row.len();
        fits(cells == columns, || format!("{cells} cells of choice {name} for {columns} columns"))?;
        for promise in promises {
            let is_one = *promise < measures;
            fits(is_one, || format!("choice {name} promises measure {promise} of {measures}"))?;
        }
        for (column, run) in board.columns.iter().zip(row.iter().map(Cell::run)) {
            let Some(Run { errors, time, .. }) = run else { continue };
            let place = format!("{name} on {}", column.name);
            let count = errors.len();
            fits(count == measures, || {
                format!("{place} has {count} errors for {measures} measures")
            })?;
            for error in errors.iter().flatten() {
                fits(*error >= 0.0, || format!("{place} has an error of {error}"))?;
            }
            let Some(time) = time else { continue };
            let Spread { low, median, high } = time.pixel_ns;
            check_three([low, median, high], "quartiles of times")?;
            check_ratio(time.times)?;
        }
    }
    Ok(())
}

fn check_ratio(Ratio { low, median, high, .. }: Ratio) -> Result<(), String> {
    check_three([low, median, high], "interval of a ratio")
}

fn check_three([low, median, high]: [f64; 3], what: &str) -> Result<(), String> {
    let is_sorted = 0.0 <= low && low <= median && 0.0 < median && median <= high;
    fits(is_sorted, || format!("{low}, {median}, {high} are not the {what}"))
}
