//! The board of a ladder as text, at most 100 columns: errors, times and counted work, rung by class
//! of scenes.
//!
//! Marks say what colours repeat: `*` the cheapest rung whose error is as good as none, `+` another
//! such rung, `<` the fastest of all. Colours only where the caller says that they can be seen.

use std::fmt::Write as _;

use super::judge_text::hanging;
use super::table::{Column, Table};
use rasterproof_precision::cost::{Board, Cell, Measure, Price, Priced, Run, Time, prices};

const WIDTH: usize = 100;
const NAME: usize = 16;

/// A cell of a block: the number, its mark, and whether it is good.
struct Mark {
    text: String,
    mark: char,
    good: bool,
}

pub fn text(board: &Board, colour: bool) -> String {
    let mut out = format!("{}\n", board.ladder.title());
    let columns: Vec<usize> = board.columns_run().collect();
    for (number, measure) in board.measures.iter().enumerate() {
        let applies =
            |&c: &usize| (0..board.rungs.len()).any(|r| board.error(r, c, number).is_some());
        let shown: Vec<usize> = columns.iter().copied().filter(applies).collect();
        let title = title(measure);
        block(&mut out, board, &shown, &title, colour, |rung, column| {
            error_cell(board, rung, column, number)
        });
    }
    if board.rounds > 0 {
        times(&mut out, board, &columns, colour);
    }
    work(&mut out, board, &columns, colour);
    not_run(&mut out, board);
    if board.rounds > 0 {
        verdicts(&mut out, board);
    }
    out
}

fn title(measure: &Measure) -> String {
    match measure.goal {
        Some(0.0) => format!("{} (0 is exact, * the cheapest such)", measure.title),
        Some(goal) => {
            format!("{} (up to {goal:.4} is +, * the cheapest such)", measure.title)
        }
        None => measure.title.to_string(),
    }
}

fn error_cell(board: &Board, rung: usize, column: usize, measure: usize) -> Option<Mark> {
    let error = board.error(rung, column, measure)?;
    let good = board.meets(rung, column, measure) == Some(true);
    let best = board.best(column, measure).and_then(|best| best.good) == Some(rung);
    let is_zero_goal = board.measures[measure].goal == Some(0.0);
    let mark = match (best, good) {
        (true, _) => '*',
        (false, true) if !is_zero_goal => '+',
        _ => ' ',
    };
    Some(Mark { text: number(error, cell_width(board)), mark, good })
}

fn times(out: &mut String, board: &Board, columns: &[usize], colour: bool) {
    let cell = |rung: usize, column: usize, value: fn(&Time) -> f64| {
        let time = board.time(rung, column)?;
        let fastest = (0..board.rungs.len())
            .filter_map(|r| board.time(r, column))
            .all(|other| other.pixel_ns.median >= time.pixel_ns.median);
        let mark = if fastest { '<' } else { ' ' };
        Some(Mark { text: number(value(time), cell_width(board)), mark, good: false })
    };
    let title =
        format!("ns for each covered pixel, median of {} rounds  (< the fastest)", board.rounds);
    block(out, board, columns, &title, colour, |r, c| cell(r, c, |t| t.pixel_ns.median));
    let title = "ns for each triangle or line";
    block(out, board, columns, title, colour, |r, c| cell(r, c, |t| t.item_ns.median));
    let mut spreads: Vec<f64> = board
        .cells
        .iter()
        .flatten()
        .filter_map(|cell| cell.run()?.time)
        .map(|t| (t.pixel_ns.high - t.pixel_ns.low) / t.pixel_ns.median)
        .collect();
    spreads.sort_by(f64::total_cmp);
    if let (Some(middle), Some(worst)) = (spreads.get(spreads.len() / 2), spreads.last()) {
        let _ = writeln!(
            out,
            "\n  quartiles lie {:.0}% of the median apart in the middle cell, {:.0}% in the worst",
            middle * 100.0,
            worst * 100.0
        );
    }
}

fn work(out: &mut String, board: &Board, columns: &[usize], colour: bool) {
    type Count = fn(&Run) -> Option<u64>;
    let counts: [(&str, Count); 3] = [
        ("edges asked, or crossings computed, for each covered pixel", |r| {
            Some(r.work?.evaluations)
        }),
        ("divisions for each covered pixel", |r| Some(r.work?.divisions)),
        ("exact decisions after a filter, for each covered pixel", |r| Some(r.work?.fallbacks)),
    ];
    for (title, count) in counts {
        let any =
            board.cells.iter().flatten().any(|c| c.run().and_then(count).is_some_and(|n| n > 0));
        if any {
            block(out, board, columns, title, colour, |rung, column| {
                let pixels = board.columns[column].pixels.max(1) as f64;
                // Rungs that do none of it have no row.
                let any =
                    board.cells[rung].iter().any(|c| c.run().and_then(count).unwrap_or(0) > 0);
                let each = any.then_some(count(board.run(rung, column)?)? as f64 / pixels)?;
                Some(Mark { text: number(each, cell_width(board)), mark: ' ', good: false })
            });
        }
    }
}

fn cell_width(board: &Board) -> usize {
    ((WIDTH - NAME) / board.columns_run().count().max(1)).min(10)
}

/// A heading, and a row for each rung that has a cell to show.
fn block(
    out: &mut String,
    board: &Board,
    columns: &[usize],
    title: &str,
    colour: bool,
    cell: impl Fn(usize, usize) -> Option<Mark>,
) {
    let width = cell_width(board);
    let _ = write!(out, "\n{}\n{:NAME$}", wrap(title), "");
    for &column in columns {
        let _ = write!(out, "{:>1$} ", board.columns[column].name, width - 1);
    }
    out.truncate(out.trim_end().len());
    out.push('\n');
    for (rung, info) in board.rungs.iter().enumerate() {
        if columns.iter().all(|&column| cell(rung, column).is_none()) {
            continue;
        }
        let _ = write!(out, "{:NAME$}", info.name);
        for &column in columns {
            let Some(Mark { text, mark, good }) = cell(rung, column) else {
                let nothing = if board.run(rung, column).is_some() { "-" } else { "not run" };
                let _ = write!(out, "{nothing:>width$}");
                continue;
            };
            let (plain, room) = (format!("{text}{mark}"), width);
            let plain = format!("{plain:>room$}");
            match (colour && good, mark) {
                (false, _) => out.push_str(&plain),
                (true, '*') => {
                    let _ = write!(out, "\x1b[1;32m{plain}\x1b[0m");
                }
                (true, _) => {
                    let _ = write!(out, "\x1b[32m{plain}\x1b[0m");
                }
            }
        }
        out.truncate(out.trim_end().len());
        out.push('\n');
    }
}

/// Says which columns nobody ran and why, and why single cells were not run.
fn not_run(out: &mut String, board: &Board) {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    let mut add = |why, what: String| match reasons.iter_mut().find(|(known, _)| *known == why) {
        Some((_, list)) => list.push(what),
        None => reasons.push((why, vec![what])),
    };
    for (column, info) in board.columns.iter().enumerate() {
        let ran = (0..board.rungs.len()).any(|rung| board.run(rung, column).is_some());
        for (rung, row) in board.cells.iter().enumerate() {
            if let Cell::NotRun(why) = &row[column] {
                if ran {
                    add(why, format!("{} on {}", board.rungs[rung].name, info.name));
                } else if rung == 0 {
                    add(why, info.name.to_string());
                }
            }
        }
    }
    for (why, list) in reasons {
        let _ = writeln!(out, "\n{}", wrap(&format!("not run: {}: {why}", list.join(", "))));
    }
}

fn verdicts(out: &mut String, board: &Board) {
    for measure in board.ranking() {
        let list: Vec<_> = board
            .dominated(measure)
            .into_iter()
            .map(|d| {
                let by: Vec<_> = d.by.iter().map(|&r| &*board.rungs[r].name).collect();
                format!("{} (by {})", board.rungs[d.rung].name, by.join(", "))
            })
            .collect();
        let list = if list.is_empty() { "none".to_owned() } else { list.join("; ") };
        let line =
            format!("dominated in every class, by {}: {list}", board.measures[measure].title);
        let _ = writeln!(out, "\n{}", wrap(&line));
    }
}

/// What exact coverage costs over the cheapest rung, for each class.
pub fn price_text(boards: &[Board]) -> String {
    let prices = prices(boards);
    let mut out = String::new();
    if prices.is_empty() {
        return out;
    }
    out += "Exact coverage over the cheapest rung, by ns for each covered pixel\n\n";
    let columns =
        [("cheapest in floats", 30), ("exact on the lattice", 28), ("exact as given", 31)];
    let columns = columns.map(|(label, least)| Column::numbers(label, "").least(least));
    let cell = |p: &Option<Priced>| {
        p.as_ref().map_or("not run".to_owned(), |p| format!("{} {:.2}x", p.name, p.ratio))
    };
    let row = |price: &Price| {
        let costs = [&price.unpromised, &price.snapped, &price.given].map(cell);
        [price.column.to_string()].into_iter().chain(costs).collect::<Vec<_>>().into()
    };
    let columns = [Column::words("").least(8)].into_iter().chain(columns).collect();
    let rows = prices.iter().map(row).collect();
    out + &Table { columns, rows, ..Table::default() }.text([0; 2])
}

/// Breaks a line at spaces so that it fits, with an indent of two.
fn wrap(line: &str) -> String {
    hanging(line, "  ", "    ")
}

/// A number in less than `width` characters: three digits where there is room.
pub fn number(value: f64, width: usize) -> String {
    let digits = if width < 8 { 0 } else { 1 };
    match value.abs() {
        0.0 => "0".to_owned(),
        v if !v.is_finite() => "inf".to_owned(),
        v if v < 99_999.5 && v.fract() == 0.0 => format!("{value:.0}"),
        v if v >= 99_999.5 => format!("{value:.*e}", digits),
        v if v >= 99.95 => format!("{value:.0}"),
        v if v >= 9.995 => format!("{value:.1}"),
        v if v >= 0.0995 => format!("{value:.2}"),
        v if v >= 0.000_995 && width >= 8 => format!("{value:.4}"),
        _ => format!("{value:.*e}", digits),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (0.1234, "0.12"),
            (12.34, "12.3"),
            (1234.4, "1234"),
            (0.0012, "0.0012"),
            (1.28e7, "1.3e7"),
            (3.2e-8, "3.2e-8"),
            (0.5, "0.50"),
            (99.97, "100"),
        ] {
            assert_eq!(number(value, 10), text);
        }
        assert_eq!(number(1.28e7, 7), "1e7");
        for exponent in -300..300 {
            assert!(number(9.996 * 10f64.powi(exponent), 7).len() <= 6);
        }
    }

    #[test]
    fn long_lines_break() {
        let line = "word ".repeat(60);
        assert!(wrap(line.trim()).lines().all(|line| line.len() <= WIDTH));
    }
}
