//! From choices and columns to boards: what each choice gets wrong of a column, then the times of all in the same rounds.

use super::entry::{Entry, PreparedColumns};
use super::{
    Board, Cell, Choice, Column, CostOptions, ExternalChoice, Ladder, Measure, Pass, Run, Time,
    Timing, antialiasing, compare, coverage, depth, interpolation, levels, lines, shadow,
};

/// What happens to a choice on a column: what it gets wrong, and what is timed; or why it is not run.
pub type PreparedCell<'a> = Result<(Run, Option<Pass<'a>>), String>;

impl Board {
    /// A board to which [`add_column`] adds its columns.
    #[must_use]
    pub fn new(ladder: Ladder, seed: u64, measures: Vec<Measure>, choices: Vec<Choice>) -> Self {
        let cells = choices.iter().map(|_| Vec::new()).collect();
        Self { ladder, seed, rounds: 0, measures, columns: Vec::new(), choices, cells }
    }
}

/// Adds a column to boards of groups that do the same job, with a cell for each choice of each board. All choices are timed in the
/// same rounds, each against the fastest of all, and the exact ones of each measure against each other.
pub fn add_column(
    boards: &mut [Board],
    column: &Column,
    cells: Vec<Vec<PreparedCell<'_>>>,
    timing: Option<Timing>,
    progress: &dyn Fn(f64),
) {
    let (mut places, mut passes) = (Vec::new(), Vec::new());
    for (number, (board, cells)) in boards.iter_mut().zip(cells).enumerate() {
        board.columns.push(column.clone());
        for (choice, cell) in cells.into_iter().enumerate() {
            board.cells[choice].push(match cell {
                Err(why) => Cell::NotRun(why),
                Ok((run, pass)) => {
                    places.extend(pass.is_some().then_some([number, choice]));
                    passes.extend(pass);
                    Cell::Run(Box::new(run))
                }
            });
        }
    }
    if let Some(timing) = timing {
        time_column(boards, (&places, passes), timing, progress);
    }
}

/// Times the passes of the last column, each of which has its place: the numbers of its board and of its choice.
fn time_column(
    boards: &mut [Board],
    (places, mut passes): (&[[usize; 2]], Vec<Pass<'_>>),
    timing: Timing,
    progress: &dyn Fn(f64),
) {
    // Which passes are compared with each other: all, and the exact ones of each board by each measure.
    let mut sets = vec![(0..passes.len()).collect::<Vec<_>>()];
    for (number, board) in boards.iter().enumerate() {
        let column = board.columns.len() - 1;
        for measure in board.ranking() {
            let mut exact = Vec::new();
            for (pass, [of, choice]) in places.iter().enumerate() {
                if *of == number && board.meets(*choice, column, measure) {
                    exact.push(pass);
                }
            }
            sets.push(exact);
        }
    }
    // All passes of the column ran in the same rounds, so that each may be told as a ratio to the fastest one.
    let times = compare(&mut passes, timing, &sets, progress);
    let Some(fastest) = times.iter().min_by(|a, b| a.median().total_cmp(&b.median())) else {
        return;
    };
    for (&[number, choice], of) in places.iter().zip(&times) {
        let board = &mut boards[number];
        // The fewest rounds of all columns.
        let before = if board.rounds == 0 { usize::MAX } else { board.rounds };
        board.rounds = before.min(of.rounds());
        let Some(column) = board.columns.last_mut() else { continue };
        column.noise = of.noise();
        let pixel_ns = of.spread().times(1.0 / column.pixels.max(1) as f64);
        if let (Some(Cell::Run(run)), Some(times)) =
            (board.cells[choice].last_mut(), of.over(fastest))
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
    // Neighbours of the list that do the same job are measured together.
    let mut external = external.into_iter().map(coverage::external);
    let jobs = || ladders.chunk_by(|a, b| a.is_coverage() && b.is_coverage());
    let mut boards = Vec::new();
    for (number, of) in jobs().enumerate() {
        let told = |share: f64| {
            progress((number as f64 + share) / jobs().count() as f64, of[0].title());
        };
        let job = Job { ladders: of, options, progress: &told };
        boards.extend(match of[0] {
            Ladder::Scanline | Ladder::EdgeFunction => {
                let mut choices: Vec<_> = of.iter().map(|one| coverage::choices(*one)).collect();
                // External choices are edge functions, too, and are measured once.
                if let (Some(last), [.., Ladder::EdgeFunction]) = (choices.last_mut(), of) {
                    last.extend(external.by_ref());
                }
                // A round of both groups takes longer than that of any other, as the slowest choice takes hundreds of times as
                // long as the fastest.
                let longer = if options.quick { 1.0 } else { 8.0 };
                let timing = options.timing.map(|timing| timing.within(longer));
                let options = &CostOptions { timing, ..*options };
                Job { options, ..job }.boards(choices, coverage::columns(options))
            }
            Ladder::Interpolation => {
                job.boards(vec![interpolation::choices()], interpolation::columns(options))
            }
            Ladder::Depth => job.boards(vec![depth::choices()], depth::columns(options)),
            Ladder::Shadows => job.boards(vec![shadow::choices()], shadow::columns(options)),
            Ladder::Levels => job.boards(vec![levels::choices()], levels::columns(options)),
            Ladder::Antialiasing => {
                job.boards(vec![antialiasing::choices()], antialiasing::columns(options))
            }
            Ladder::Lines => job.boards(vec![lines::choices()], lines::columns(options)),
            Ladder::Frames => Vec::new(),
        });
    }
    boards
}

/// Groups that do the same job, to be measured on the same columns.
#[derive(Clone, Copy)]
struct Job<'a> {
    ladders: &'a [Ladder],
    options: &'a CostOptions,
    progress: &'a dyn Fn(f64),
}

impl Job<'_> {
    fn boards<I>(
        self,
        choices: Vec<Vec<Entry<I>>>,
        columns: impl PreparedColumns<I>,
    ) -> Vec<Board> {
        let CostOptions { seed, timing, .. } = *self.options;
        let mut boards = Vec::with_capacity(choices.len());
        for (ladder, entries) in self.ladders.iter().zip(&choices) {
            let choices = entries.iter().map(|entry| entry.choice.clone()).collect();
            boards.push(Board::new(*ladder, seed, ladder.measures(), choices));
        }
        // Column by column, so that the input of one is freed before the next one is made.
        let count = columns.len() as f64;
        for (number, (column, input)) in columns.enumerate() {
            let told = |share: f64| (self.progress)((number as f64 + share) / count);
            told(0.0);
            let cell = |entry: &Entry<I>| {
                let input = input.as_ref().map_err(Clone::clone)?;
                let run = entry.judge(input)?;
                let pass = timing.map(|_| entry.pass(input)).transpose()?;
                Ok((run, pass))
            };
            let cells = choices.iter().map(|entries| entries.iter().map(cell).collect()).collect();
            add_column(&mut boards, &column, cells, timing, &told);
        }
        boards
    }
}
