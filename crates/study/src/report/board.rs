//! The board of a group as tables, at most 100 columns wide: errors, times and counted work, choice by class
//! of scenes.
//!
//! Marks say what colours repeat: `*` the cheapest choice whose error is as good as none, `+` another
//! such choice, `<` the fastest of all.

use super::{cost_plots, json};
use rasterproof_host::text::printable;
use rasterproof_precision::cost::{
    Board, CELLS, Cell, Column, Ladder, Measure, Priced, Ratio, RatioKind, Recorded, Run, Time,
    fastest, prices,
};
use rasterproof_precision::ladder::Work;
use rasterproof_report::canvas;
use rasterproof_report::html::{Figure, PicturedAnswer, Report};
use rasterproof_report::table::{self, Row, Table};
use rasterproof_report::words::number;

/// The width of a table in a terminal.
const WIDTH: usize = 100;
/// The width of the names of choices, which are indented.
const NAME: usize = 18;
const INDENT: usize = 2;

/// A table for each measure of the error, for each kind of time and for each count of work.
pub fn tables(board: &Board) -> Vec<Table> {
    // First how wrong each choice is, then what it takes, then why.
    let mut tables = errors(board);
    if board.rounds > 0 {
        tables.extend(times(board));
    }
    tables.extend(work(board));
    // A count of work that no choice of a group does has no table.
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

/// A table for each measure of the error.
fn errors(board: &Board) -> Vec<Table> {
    let mut tables = Vec::new();
    for (measure, Measure { title, goal, .. }) in board.measures.iter().enumerate() {
        let (title, exact) = match goal {
            // What is exact is known by its 0, so it has no mark unless it is the cheapest.
            Some(0.0) => (format!("{title} (0 is exact, * the cheapest such)"), ' '),
            Some(goal) => (format!("{title} (up to {goal:.4} is +, * the cheapest such)"), '+'),
            None => (title.to_string(), ' '),
        };
        tables.push(block(board, title, &|choice, column| {
            let error = board.error(choice, column, measure)?;
            if !board.meets(choice, column, measure) {
                return Some((error, Mark::Plain(' ')));
            }
            let best = board.cheapest_exact(column, measure);
            let is_best = best.is_some_and(|best| best.number == choice);
            Some((error, Mark::Good(if is_best { '*' } else { exact })))
        }));
    }
    tables
}

/// Times for each pixel and for each item, with how much they vary.
fn times(board: &Board) -> [Table; 2] {
    let rounds = board.rounds;
    let title =
        format!("ns for each covered pixel, median of {rounds} rounds or more (< the fastest)");
    let pixels = block(board, title, &|choice, column| pixel_ns(board, choice, column));
    let mut items = block(board, "ns for each triangle or line".to_owned(), &|choice, column| {
        let Column { items, pixels, .. } = board.columns[column];
        let (ns, mark) = pixel_ns(board, choice, column)?;
        Some((ns * pixels.max(1) as f64 / items.max(1) as f64, mark))
    });
    // How far the quartiles are apart, in percent of the median.
    let mut spreads = Vec::new();
    for cell in board.cells.iter().flatten() {
        if let Some(Run { time: Some(Time { pixel_ns: ns, .. }), .. }) = cell.run() {
            spreads.push((ns.high - ns.low) / ns.median * 100.0);
        }
    }
    spreads.sort_by(f64::total_cmp);
    if let (Some(middle), Some(worst)) = (spreads.get(spreads.len() / 2), spreads.last()) {
        items.notes.push(format!(
            "quartiles lie {middle:.0}% of the median apart in the middle cell, {worst:.0}% in the worst"
        ));
    }
    // How far apart two equal passes are at most, by the classes in which that was measured.
    let mut noises = Vec::new();
    for column in &board.columns {
        noises.extend(column.noise.map(Ratio::off_one));
    }
    if let Some(worst) = noises.into_iter().reduce(f64::max) {
        let worst = 100.0 * (worst - 1.0);
        items.notes.push(format!("two equal passes differ by at most {worst:.1}% in a class"));
    }
    [pixels, items]
}

/// The time of a choice, marked where it is the fastest of its column.
fn pixel_ns(board: &Board, choice: usize, column: usize) -> Option<(f64, Mark)> {
    let median = board.time(choice, column)?.pixel_ns.median;
    // Several may be the fastest, if they take equally long.
    let fastest = fastest(board.ran(column)).and_then(|one| one.run.time.as_ref());
    let is_fastest = fastest.is_some_and(|time| time.pixel_ns.median >= median);
    Some((median, Mark::Plain(if is_fastest { '<' } else { ' ' })))
}

/// A table for each count of work.
fn work(board: &Board) -> [Table; 3] {
    type Count = fn(&Work) -> u64;
    let counts: [(&str, Count); 3] = [
        // The edge function asks edges, the scanline computes crossings; no choice does both.
        ("edges asked, or crossings computed, for each covered pixel", |work| work.evaluations),
        ("divisions for each covered pixel", |work| work.divisions),
        ("exact decisions after a filter, for each covered pixel", |work| work.fallbacks),
    ];
    counts.map(|(title, count)| {
        let count = |cell: &Cell| cell.run()?.work.as_ref().map(count);
        block(board, title.to_owned(), &|choice, column| {
            let row = &board.cells[choice];
            // Choices that do none of it have no row.
            if !row.iter().filter_map(count).any(|number| number > 0) {
                return None;
            }
            let pixels = board.columns[column].pixels.max(1);
            Some((count(&row[column])? as f64 / pixels as f64, Mark::Plain(' ')))
        })
    })
}

/// A sign behind a number of a table, and whether the number is in the colour of what is exact.
enum Mark {
    Plain(char),
    Good(char),
}

/// How wide a number may be, so that all columns fit beside each other.
fn cell_width(board: &Board) -> usize {
    // A gap stands before each.
    ((WIDTH - NAME) / board.columns_run().count().max(1)).min(10) - 1
}

/// A row for each choice that has a number to show, and a column for each class of scenes in which one has. `cell` gets the numbers
/// of a choice and of a column.
fn block(
    board: &Board,
    caption: String,
    cell: &dyn Fn(usize, usize) -> Option<(f64, Mark)>,
) -> Table {
    // Only columns in which any choice has a number are shown, and only choices that have one in any of them.
    let choices = 0..board.choices.len();
    let width = cell_width(board);
    let applies = |&column: &usize| choices.clone().any(|choice| cell(choice, column).is_some());
    let columns: Vec<usize> = board.columns_run().filter(applies).collect();
    let mut rows = Vec::new();
    for choice in choices.clone() {
        let mut row = Row::from(vec![board.choices[choice].name.to_string()]);
        let mut is_shown = false;
        for &column in &columns {
            let Some((value, mark)) = cell(choice, column) else {
                let has_run = board.run(choice, column).is_some();
                row.cells.push(if has_run { "-" } else { "not run" }.to_owned());
                continue;
            };
            is_shown = true;
            let (Mark::Plain(sign) | Mark::Good(sign)) = mark;
            if matches!(mark, Mark::Good(_)) {
                row.good.push(row.cells.len());
            }
            row.cells.push(format!("{}{sign}", number(value, width)));
        }
        if is_shown {
            rows.push(row);
        }
    }
    let mut heads = vec![table::Column::words("choice").short("").least(NAME - INDENT)];
    for &column in &columns {
        let name = &board.columns[column].name;
        // A mark stands behind each number.
        let gap = if name.chars().count() < width.max(6) { " " } else { "" };
        let head = table::Column::numbers(name, "").short(format!("{name}{gap}"));
        heads.push(head.least(width));
    }
    Table::of(&caption, heads, rows)
}

/// Says which columns nobody ran and why, and why single cells were not run.
fn not_run(board: &Board) -> Vec<String> {
    // Each reason with what was not run for it, in the order in which they are met.
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for (column, info) in board.columns.iter().enumerate() {
        let ran = (0..board.choices.len()).any(|choice| board.run(choice, column).is_some());
        for (choice, row) in board.cells.iter().enumerate() {
            let Cell::NotRun(why) = &row[column] else { continue };
            let what = match (ran, choice) {
                (true, _) => format!("{} on {}", board.choices[choice].name, info.name),
                // A column that nobody ran is said once.
                (false, 0) => info.name.to_string(),
                (false, _) => continue,
            };
            match reasons.iter_mut().find(|(known, _)| known == why) {
                Some((_, list)) => list.push(what),
                None => reasons.push((why, vec![what])),
            }
        }
    }
    let mut lines = Vec::new();
    for (why, list) in reasons {
        lines.push(format!("not run: {}: {why}", list.join(", ")));
    }
    lines
}

/// By each measure the choices that others dominate in every class of scenes, with those others.
fn dominated(board: &Board) -> Vec<String> {
    // A choice that another one beats in error and time has no use in any class.
    let mut lines = Vec::new();
    for measure in board.ranking() {
        let mut all = Vec::new();
        for (choice, by) in board.dominated(measure) {
            let names: Vec<&str> = by.iter().map(|other| &*other.name).collect();
            all.push(format!("{} (by {})", choice.name, names.join(", ")));
        }
        let list = if all.is_empty() { "none".to_owned() } else { all.join("; ") };
        let title = &board.measures[measure].title;
        lines.push(format!("dominated in every class, by {title}: {list}"));
    }
    lines
}

/// What exact coverage costs over the cheapest choice, for each class; nothing where that was not measured.
pub fn price(boards: &[Board]) -> Option<Table> {
    // A kind of coverage that was not run in a class has a cell all the same.
    let mut rows = Vec::new();
    for price in prices(boards) {
        let [floats, snapped, given] =
            [&price.unpromised, &price.snapped, &price.given].map(name_and_ratio);
        rows.push(Row::of(&[&price.column, &floats, &snapped, &given]));
    }
    if rows.is_empty() {
        return None;
    }
    let caption = "Exact coverage over the cheapest choice, by ns for each covered pixel";
    let columns = "~class 6 | cheapest in floats 40 | exact on the lattice 40 | :exact as given";
    Some(Table::new(caption, columns, rows).noted(vec![CELLS.to_owned()]))
}

/// The cheapest choice of a kind, and how many times as long it takes as the cheapest of all.
fn name_and_ratio(priced: &Option<Priced>) -> String {
    match priced {
        Some(Priced { name, ratio, .. }) => format!("{name} {ratio}"),
        None => "not run".to_owned(),
    }
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
    // Without coverage nothing has a price, and the last group is told in its place.
    let prices = prices(boards);
    if prices.is_empty() {
        return sentence_of_cheapest(boards.last()?);
    }
    let (mut snapped, mut given) = (Vec::new(), Vec::new());
    for price in &prices {
        if let Some(priced) = &price.snapped {
            snapped.push(priced.ratio);
        }
        if let Some(priced) = &price.given {
            given.push(priced.ratio);
        }
    }
    Some(format!(
        "By class of scenes, coverage that is exact once corners are snapped {}; exact for the corners as given, it {}.",
        range_of_times(&snapped),
        range_of_times(&given),
    ))
}

/// In how many classes of scenes accuracy costs nothing; nothing where no choice was timed.
fn sentence_of_cheapest(board: &Board) -> Option<String> {
    // Of the classes in which anything was timed.
    let (mut exact, mut all) = (0, 0);
    for column in board.columns_run() {
        if let Some(best) = fastest(board.ran(column)) {
            all += 1;
            exact += usize::from(best.is_exact(0));
        }
    }
    let title = board.ladder.title();
    (all > 0).then(|| format!(
        "{title}: in {exact} of {all} classes of scenes the cheapest choice of all is exact or good enough."
    ))
}

/// What a kind of coverage takes, by its ratios to the cheapest choice in all classes of scenes.
fn range_of_times(ratios: &[Ratio]) -> String {
    if ratios.is_empty() {
        return "was not measured".to_owned();
    }
    // It is free where no class shows a difference; else the widest interval of all classes is told.
    let mut is_free = true;
    let (mut low, mut high) = (f64::INFINITY, 0.0f64);
    for ratio in ratios {
        is_free &= *ratio == Ratio::ONE || ratio.said() == RatioKind::NoDifference;
        low = low.min(ratio.low);
        high = high.max(ratio.high);
    }
    match is_free {
        true => "takes no longer than the cheapest choice of all".to_owned(),
        false => format!("takes {low:.1} to {high:.1} times as long as the cheapest choice of all"),
    }
}

/// The name of the plot of a group, as a file.
pub fn plot_name(ladder: Ladder) -> String {
    format!("cost-{}", ladder.name())
}

/// The plot that answers what exact coverage costs.
pub const PRICE: &str = "cost-price";

/// The plots with their names, what answers the question first.
pub fn plots(boards: &[Board]) -> Vec<(String, Figure)> {
    // The price stands first, and is left out where coverage was not measured.
    let mut plots = Vec::new();
    let prices = prices(boards);
    if !prices.is_empty() {
        let caption = "What exact coverage costs over the cheapest choice";
        let drawn = cost_plots::WIDTHS.map(|width| cost_plots::price(&prices, width));
        plots.push((PRICE.to_owned(), canvas::figure(caption, drawn)));
    }
    for board in boards.iter().rev() {
        let caption = format!("Time against error: {}", board.ladder.name());
        let drawn = [3, 2, 1].map(|in_row| cost_plots::pareto(std::slice::from_ref(board), in_row));
        plots.push((plot_name(board.ladder), canvas::figure(&caption, drawn)));
    }
    plots
}
