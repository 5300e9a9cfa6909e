//! From choices and columns to boards: what each choice gets wrong of each column, then the times of all.

use std::cell::Cell as Counter;

use super::clock::over_fastest;
use super::entry::{Columns, Entry, PreparedCell};
use super::{
    Board, Cell, Choice, Column, CostOptions, ExternalChoice, Ladder, Measure, Pass, Time, Timing,
    antialiasing, compare, coverage, depth, interpolation, levels, lines, shadow,
};

/// A pass with the numbers of its choice and its column.
struct PlacedPass<'a> {
    choice: usize,
    column: usize,
    pass: Pass<'a>,
}

/// A board whose errors are known, with the passes that are still to be timed.
pub struct Draft<'a> {
    board: Board,
    passes: Vec<PlacedPass<'a>>,
}

impl<'a> Draft<'a> {
    #[must_use]
    pub fn new(ladder: Ladder, seed: u64, measures: Vec<Measure>, choices: Vec<Choice>) -> Self {
        let cells = choices.iter().map(|_| Vec::new()).collect();
        let board =
            Board { ladder, seed, rounds: 0, measures, columns: Vec::new(), choices, cells };
        Self { board, passes: Vec::new() }
    }

    /// Adds a column, with a cell for each choice.
    pub fn add(&mut self, column: Column, cells: impl IntoIterator<Item = PreparedCell<'a>>) {
        let number = self.board.columns.len();
        self.board.columns.push(column);
        for (choice, (row, cell)) in self.board.cells.iter_mut().zip(cells).enumerate() {
            row.push(match cell {
                Err(why) => Cell::NotRun(why),
                Ok((run, pass)) => {
                    let placed = |pass| PlacedPass { choice, column: number, pass };
                    self.passes.extend(pass.map(placed));
                    Cell::Run(Box::new(run))
                }
            });
        }
    }
}

/// Times what was prepared for boards with the same columns: all choices of a column in the same rounds, each against the fastest
/// of all, and the exact ones of each measure against each other.
pub fn timed(drafts: Vec<Draft<'_>>, timing: Option<Timing>, progress: &dyn Fn(f64)) -> Vec<Board> {
    let (mut boards, mut passes) = (Vec::new(), Vec::new());
    for (number, draft) in drafts.into_iter().enumerate() {
        boards.push(draft.board);
        passes.extend(draft.passes.into_iter().map(|placed| (number, placed)));
    }
    let Some(timing) = timing else { return boards };
    let mut columns: Vec<usize> = passes.iter().map(|(_, placed)| placed.column).collect();
    columns.sort_unstable();
    columns.dedup();
    for (done, &column) in columns.iter().enumerate() {
        let (of_column, others): (Vec<_>, Vec<_>) =
            passes.into_iter().partition(|(_, placed)| placed.column == column);
        passes = others;
        let (places, of_column): (Vec<[usize; 2]>, Vec<Pass<'_>>) = of_column
            .into_iter()
            .map(|(board, placed)| ([board, placed.choice], placed.pass))
            .unzip();
        let told = |share: f64| progress((done as f64 + share) / columns.len() as f64);
        time_column(&mut boards, column, (&places, of_column), timing, &told);
    }
    boards
}

fn time_column(
    boards: &mut [Board],
    column: usize,
    (places, mut passes): (&[[usize; 2]], Vec<Pass<'_>>),
    timing: Timing,
    progress: &dyn Fn(f64),
) {
    let mut sets = vec![(0..passes.len()).collect::<Vec<_>>()];
    for (number, board) in boards.iter().enumerate() {
        for measure in board.ranking() {
            let is_exact = |&pass: &usize| {
                let [of, choice] = places[pass];
                of == number && board.meets(choice, column, measure) == Some(true)
            };
            sets.push((0..places.len()).filter(is_exact).collect());
        }
    }
    let wanted = |medians: &[f64]| over_fastest(&sets, medians);
    let times = compare(&mut passes, timing, &wanted, progress);
    let Some(fastest) = times.iter().min_by(|a, b| a.median().total_cmp(&b.median())) else {
        return;
    };
    for (&[number, choice], of) in places.iter().zip(&times) {
        let board = &mut boards[number];
        board.rounds = match board.rounds {
            0 => of.rounds(),
            rounds => rounds.min(of.rounds()),
        };
        let info = &mut board.columns[column];
        info.noise = of.noise();
        let pixel_ns = of.spread().times(1.0 / info.pixels.max(1) as f64);
        if let (Cell::Run(run), Some(times)) = (&mut board.cells[choice][column], of.over(fastest))
        {
            run.time = Some(Time { pixel_ns, times, rounds: Some(of.clone()) });
        }
    }
}

/// Measures a group. `progress` gets the share done, from 0 to 1, and a word about it.
pub fn measure(ladder: Ladder, options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
    let mut boards = measure_with(&[ladder], options, Vec::new(), progress);
    boards.pop().expect("a board for each group")
}

/// Measures groups on classes of scenes, with external choices beside the edge functions. Both groups of coverage do the same job, so
/// they are timed in the same rounds.
pub fn measure_with(
    ladders: &[Ladder],
    options: &CostOptions,
    external: Vec<Box<dyn ExternalChoice>>,
    progress: &dyn Fn(f64, &str),
) -> Vec<Board> {
    let (coverage, others): (Vec<Ladder>, Vec<Ladder>) =
        ladders.iter().partition(|ladder| ladder.is_coverage());
    let parts = others.len() + usize::from(!coverage.is_empty());
    let done = Counter::new(0);
    let told = |share: f64, what: &str| progress((done.get() as f64 + share) / parts as f64, what);
    let mut boards = Vec::new();
    if !coverage.is_empty() {
        let mut groups: Vec<_> =
            coverage.into_iter().map(|ladder| (ladder, coverage::choices(ladder))).collect();
        if let Some((_, choices)) = groups.iter_mut().find(|group| group.0 == Ladder::EdgeFunction)
        {
            choices.extend(external.into_iter().map(coverage::external));
        }
        // A round of both groups takes longer than that of any other, as the slowest choice takes hundreds of times as long as the
        // fastest.
        let longer = if options.quick { 1.0 } else { 8.0 };
        let timing = options.timing.map(|timing| timing.within(longer));
        let options = &CostOptions { timing, ..*options };
        boards = boards_of(&groups, &coverage::columns(options), options, &told);
        done.set(1);
    }
    for ladder in others {
        let how = (ladder, options, &told as Progress<'_>);
        boards.extend(match ladder {
            Ladder::Interpolation => group(how, interpolation::choices(), interpolation::columns),
            Ladder::Depth => group(how, depth::choices(), depth::columns),
            Ladder::Shadows => group(how, shadow::choices(), shadow::columns),
            Ladder::Levels => group(how, levels::choices(), levels::columns),
            Ladder::Lines => group(how, lines::choices(), lines::columns),
            Ladder::Antialiasing => group(how, antialiasing::choices(), antialiasing::columns),
            Ladder::Scanline | Ladder::EdgeFunction | Ladder::Frames => Vec::new(),
        });
        done.set(done.get() + 1);
    }
    boards
}

type Progress<'a> = &'a dyn Fn(f64, &str);

fn group<I>(
    (ladder, options, progress): (Ladder, &CostOptions, Progress<'_>),
    choices: Vec<Entry<'_, I>>,
    columns: fn(&CostOptions) -> Columns<I>,
) -> Vec<Board> {
    boards_of(&[(ladder, choices)], &columns(options), options, progress)
}

/// The boards of groups that do the same job on the same columns.
fn boards_of<I>(
    groups: &[(Ladder, Vec<Entry<'_, I>>)],
    columns: &Columns<I>,
    options: &CostOptions,
    progress: &dyn Fn(f64, &str),
) -> Vec<Board> {
    let mut drafts = Vec::new();
    for (ladder, entries) in groups {
        let choices = entries.iter().map(|entry| entry.choice.clone()).collect();
        let mut draft = Draft::new(*ladder, options.seed, ladder.measures(), choices);
        for (number, (column, input)) in columns.iter().enumerate() {
            progress(0.3 * number as f64 / columns.len() as f64, ladder.title());
            let cell = |entry: &Entry<'_, I>| {
                let input = input.as_ref().map_err(Clone::clone)?;
                let run = entry.judge(input)?;
                let pass = options.timing.map(|_| entry.pass(input)).transpose()?;
                Ok((run, pass))
            };
            draft.add(column.clone(), entries.iter().map(cell));
        }
        drafts.push(draft);
    }
    timed(drafts, options.timing, &|share| progress(0.3 + 0.7 * share, groups[0].0.title()))
}
