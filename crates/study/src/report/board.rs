//! The board of a group as tables, at most 100 columns wide: errors, times and counted work, choice by class
//! of scenes.
//!
//! Marks say what colours repeat: `*` the cheapest choice whose error is as good as none, `+` another
//! such choice, `<` the fastest of all.

use super::{cost_plots, json};
use rasterproof_host::text::printable;
use rasterproof_precision::cost::{
    Board, CELLS, Cell, Choice, Column, Ladder, Measure, Price, Priced, Ratio, RatioKind, Recorded,
    Time, fastest, prices,
};
use rasterproof_precision::ladder::Work;
use rasterproof_report::canvas;
use rasterproof_report::html::{Figure, PicturedAnswer, Report};
use rasterproof_report::table::{self, Row, Table};
use rasterproof_report::words::number;

const WIDTH: usize = 100;
/// The width of the names of choices, which are indented.
const NAME: usize = 18;
const INDENT: usize = 2;

/// A table for each measure of the error, for each kind of time and for each count of work.
pub fn tables(board: &Board) -> Vec<Table> {
    let mut tables = errors(board);
    if board.rounds > 0 {
        tables.extend(times(board));
    }
    tables.extend(work(board));
    tables.retain(|table| !table.rows.is_empty());
    if let (Some(first), title) = (tables.first_mut(), board.ladder.title()) {
        first.caption = format!("{title}: {}", first.caption);
    }
    if let Some(last) = tables.last_mut() {
        last.notes.extend(not_run(board));
        if board.rounds > 0 {
            last.notes.extend(dominated(board));
        }
    }
    tables
}

fn errors(board: &Board) -> Vec<Table> {
    let of_measure = |(measure, Measure { title, goal, .. }): (usize, &Measure)| {
        let (title, exact) = match goal {
            Some(0.0) => (format!("{title} (0 is exact, * the cheapest such)"), ' '),
            Some(goal) => (format!("{title} (up to {goal:.4} is +, * the cheapest such)"), '+'),
            None => (title.to_string(), ' '),
        };
        block(board, title, &|choice, column| {
            let is_best =
                || board.cheapest_exact(column, measure).is_some_and(|best| best.number == choice);
            let mark = match board.meets(choice, column, measure) {
                true => Mark::Good(if is_best() { '*' } else { exact }),
                false => Mark::Plain(' '),
            };
            Some((board.error(choice, column, measure)?, mark))
        })
    };
    board.measures.iter().enumerate().map(of_measure).collect()
}

fn times(board: &Board) -> [Table; 2] {
    let cell = |choice: usize, column: usize| {
        let median = board.time(choice, column)?.pixel_ns.median;
        let fastest = fastest(board.ran(column)).and_then(|one| one.run.time.as_ref());
        let is_fastest = fastest.is_some_and(|time| time.pixel_ns.median >= median);
        Some((median, Mark::Plain(if is_fastest { '<' } else { ' ' })))
    };
    let rounds = board.rounds;
    let title =
        format!("ns for each covered pixel, median of {rounds} rounds or more (< the fastest)");
    let pixels = block(board, title, &cell);
    let mut items = block(board, "ns for each triangle or line".to_owned(), &|choice, column| {
        let Column { items, pixels, .. } = board.columns[column];
        let (ns, mark) = cell(choice, column)?;
        Some((ns * pixels.max(1) as f64 / items.max(1) as f64, mark))
    });
    let timed = board.cells.iter().flatten().filter_map(|cell| cell.run()?.time.as_ref());
    let spread = |t: &Time| (t.pixel_ns.high - t.pixel_ns.low) / t.pixel_ns.median;
    let mut spreads: Vec<f64> = timed.map(|time| spread(time) * 100.0).collect();
    spreads.sort_by(f64::total_cmp);
    if let (Some(middle), Some(worst)) = (spreads.get(spreads.len() / 2), spreads.last()) {
        items.notes.push(format!(
            "quartiles lie {middle:.0}% of the median apart in the middle cell, {worst:.0}% in the worst"
        ));
    }
    let noise = board.columns.iter().filter_map(|column| column.noise.map(Ratio::off_one));
    if let Some(worst) = noise.reduce(f64::max) {
        let worst = 100.0 * (worst - 1.0);
        items.notes.push(format!("two equal passes differ by at most {worst:.1}% in a class"));
    }
    [pixels, items]
}

fn work(board: &Board) -> [Table; 3] {
    type Count = fn(&Work) -> u64;
    let counts: [(&str, Count); 3] = [
        ("edges asked, or crossings computed, for each covered pixel", |work| work.evaluations),
        ("divisions for each covered pixel", |work| work.divisions),
        ("exact decisions after a filter, for each covered pixel", |work| work.fallbacks),
    ];
    counts.map(|(title, count)| {
        let count = |cell: &Cell| cell.run()?.work.as_ref().map(count);
        block(board, title.to_owned(), &|choice, column| {
            // Choices that do none of it have no row.
            let row = &board.cells[choice];
            let does_any = row.iter().filter_map(count).any(|number| number > 0);
            let number = does_any.then(|| count(&row[column]))??;
            let pixels = board.columns[column].pixels.max(1);
            Some((number as f64 / pixels as f64, Mark::Plain(' ')))
        })
    })
}

/// A sign behind a number of a table, and whether the number is in the colour of what is exact.
enum Mark {
    Plain(char),
    Good(char),
}

fn cell_width(board: &Board) -> usize {
    // A gap stands before each.
    ((WIDTH - NAME) / board.columns_run().count().max(1)).min(10) - 1
}

/// A row for each choice that has a number to show, and a column for each class of scenes in which one has.
fn block(
    board: &Board,
    caption: String,
    cell: &dyn Fn(usize, usize) -> Option<(f64, Mark)>,
) -> Table {
    let choices = 0..board.choices.len();
    let width = cell_width(board);
    let applies = |&column: &usize| choices.clone().any(|choice| cell(choice, column).is_some());
    let columns: Vec<usize> = board.columns_run().filter(applies).collect();
    let row = |choice: usize| {
        let mut row = Row::from(vec![board.choices[choice].name.to_string()]);
        for (place, &column) in (1..).zip(&columns) {
            row.cells.push(match cell(choice, column) {
                Some((value, Mark::Plain(mark))) => format!("{}{mark}", number(value, width)),
                Some((value, Mark::Good(mark))) => {
                    row.good.push(place);
                    format!("{}{mark}", number(value, width))
                }
                None if board.run(choice, column).is_some() => "-".to_owned(),
                None => "not run".to_owned(),
            });
        }
        row
    };
    let has_cell = |&choice: &usize| columns.iter().any(|&column| cell(choice, column).is_some());
    // A mark stands behind each number.
    let head = |&column: &usize| {
        let name = &board.columns[column].name;
        let gap = if name.chars().count() < width.max(6) { " " } else { "" };
        table::Column::numbers(name, "").short(format!("{name}{gap}")).least(width)
    };
    let first = table::Column::words("choice").short("").least(NAME - INDENT);
    let columns = [first].into_iter().chain(columns.iter().map(head)).collect();
    Table::of(&caption, columns, choices.clone().filter(has_cell).map(row).collect())
}

/// Says which columns nobody ran and why, and why single cells were not run.
fn not_run(board: &Board) -> Vec<String> {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    let mut add = |why, what: String| match reasons.iter_mut().find(|(known, _)| *known == why) {
        Some((_, list)) => list.push(what),
        None => reasons.push((why, vec![what])),
    };
    for (column, info) in board.columns.iter().enumerate() {
        let ran = (0..board.choices.len()).any(|choice| board.run(choice, column).is_some());
        for (choice, row) in board.cells.iter().enumerate() {
            if let Cell::NotRun(why) = &row[column] {
                if ran {
                    add(why, format!("{} on {}", board.choices[choice].name, info.name));
                } else if choice == 0 {
                    add(why, info.name.to_string());
                }
            }
        }
    }
    let line = |(why, list): (&str, Vec<String>)| format!("not run: {}: {why}", list.join(", "));
    reasons.into_iter().map(line).collect()
}

/// By each measure the choices that others dominate in every class of scenes, with those others.
fn dominated(board: &Board) -> Vec<String> {
    let line = |measure: usize| {
        let names = |all: Vec<&Choice>| {
            all.iter().map(|choice| &*choice.name).collect::<Vec<_>>().join(", ")
        };
        let all = board.dominated(measure).into_iter();
        let all = all.map(|(choice, by)| format!("{} (by {})", choice.name, names(by)));
        let list = Some(all.collect::<Vec<_>>().join("; ")).filter(|list| !list.is_empty());
        let list = list.unwrap_or("none".to_owned());
        format!("dominated in every class, by {}: {list}", board.measures[measure].title)
    };
    board.ranking().map(line).collect()
}

/// What exact coverage costs over the cheapest choice, for each class; nothing where that was not measured.
pub fn price(boards: &[Board]) -> Option<Table> {
    let prices = prices(boards);
    let columns = "~class 6 | cheapest in floats 40 | exact on the lattice 40 | :exact as given";
    let cell = |p: &Option<Priced>| {
        p.as_ref().map_or("not run".to_owned(), |p| format!("{} {}", p.name, p.ratio))
    };
    let row = |price: &Price| {
        let [floats, snapped, given] = [&price.unpromised, &price.snapped, &price.given].map(cell);
        Row::of(&[&price.column, &floats, &snapped, &given])
    };
    let caption = "Exact coverage over the cheapest choice, by ns for each covered pixel";
    let table = || Table::new(caption, columns, prices.iter().map(row).collect());
    (!prices.is_empty()).then(|| table().noted(vec![CELLS.to_owned()]))
}

/// What was measured, with plots that are given, the one that answers first.
pub fn report(recorded: &Recorded, mut figures: Vec<Figure>) -> Report {
    let Recorded { version, repeat, seed, quick, boards } = recorded;
    let quick = if *quick { ", quick" } else { "" };
    let sentence = sentence(boards);
    let pictured = sentence.map(|sentence| PicturedAnswer { sentence, figure: figures.remove(0) });
    Report {
        title: "What accuracy costs in time".to_owned(),
        about: format!("rasterproof {version} cost, seed {seed}{quick}"),
        repeat: printable(repeat).into_owned(),
        tables: boards.iter().flat_map(tables).chain(price(boards)).collect(),
        figures,
        pictured,
        data: json::cost(recorded),
        ..Report::default()
    }
}

/// What the first plot shows; nothing without times.
fn sentence(boards: &[Board]) -> Option<String> {
    let prices = prices(boards);
    if prices.is_empty() {
        let board = boards.last()?;
        let best = board.columns_run().filter_map(|column| fastest(board.ran(column)));
        let best: Vec<_> = best.collect();
        let exact = best.iter().filter(|choice| choice.is_exact(0)).count();
        let (title, all) = (board.ladder.title(), best.len());
        return (all > 0).then(|| format!(
            "{title}: in {exact} of {all} classes of scenes the cheapest choice of all is exact or good enough."
        ));
    }
    let takes = |of: &dyn Fn(&Price) -> Option<&Priced>| {
        let ratios: Vec<Ratio> = prices.iter().filter_map(of).map(|priced| priced.ratio).collect();
        let is_free =
            |ratio: &Ratio| *ratio == Ratio::ONE || ratio.said() == RatioKind::NoDifference;
        let low = ratios.iter().map(|ratio| ratio.low).fold(f64::INFINITY, f64::min);
        let high = ratios.iter().map(|ratio| ratio.high).fold(0.0, f64::max);
        match &ratios[..] {
            [] => "was not measured".to_owned(),
            all if all.iter().all(is_free) => {
                "takes no longer than the cheapest choice of all".to_owned()
            }
            _ => format!("takes {low:.1} to {high:.1} times as long as the cheapest choice of all"),
        }
    };
    Some(format!(
        "By class of scenes, coverage that is exact once corners are snapped {}; exact for the corners as given, it {}.",
        takes(&|price| price.snapped.as_ref()),
        takes(&|price| price.given.as_ref()),
    ))
}

/// The name of the plot of a group, as a file.
pub fn plot_name(ladder: Ladder) -> String {
    format!("cost-{}", ladder.name())
}

/// The plot that answers what exact coverage costs.
pub const PRICE: &str = "cost-price";

/// The plots with their names, what answers the question first.
pub fn plots(boards: &[Board]) -> Vec<(String, Figure)> {
    let of_board = |board: &Board| {
        let caption = format!("Time against error: {}", board.ladder.name());
        let drawn = [3, 2, 1].map(|in_row| cost_plots::pareto(std::slice::from_ref(board), in_row));
        (plot_name(board.ladder), canvas::figure(&caption, drawn))
    };
    let prices = prices(boards);
    let price = (!prices.is_empty()).then(|| {
        let caption = "What exact coverage costs over the cheapest choice";
        let drawn = cost_plots::WIDTHS.map(|width| cost_plots::price(&prices, width));
        (PRICE.to_owned(), canvas::figure(caption, drawn))
    });
    price.into_iter().chain(boards.iter().rev().map(of_board)).collect()
}
