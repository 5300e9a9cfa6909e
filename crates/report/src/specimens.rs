//! The survey of the specimens: a summary of all, as text and as a table of a page, or all families of one.

use std::fmt::Write as _;

use super::table::{Column, Row, Table};
use rasterproof_registry::published_check::{Counts, SpecimenReport};

const UNITS: &str = "\
differ: percent of the triangles or lines with a wrong pixel or value; extra, missing, twice: wrong
pixels per million covered, each triangle for itself; value, depth: worst error as a fraction of the
corner values' spread; shared: as twice, but pixels that two triangles of a mesh draw
";

/// The survey: a block for each specimen with its sums and its worst family, then coverage by family
/// in percent; at most 100 columns.
pub fn text(reports: &[SpecimenReport]) -> String {
    let all: Vec<_> = reports.iter().collect();
    let mut out = format!("{UNITS}{}", of_specimens(&all).text([0, 2]));
    for lines in [false, true] {
        let columns: Vec<_> = reports
            .iter()
            .filter(|r| {
                r.families.first().is_some_and(|(name, _)| name.starts_with("line") == lines)
            })
            .collect();
        by_family(&mut out, &columns, if lines { "lines" } else { "triangles" });
    }
    out
}

/// The survey as a table of a page, the most often wrong first.
pub fn table(reports: &[SpecimenReport]) -> Table {
    let mut sorted: Vec<_> = reports.iter().collect();
    sorted.sort_by(|a, b| b.all.percent().total_cmp(&a.all.percent()));
    of_specimens(&sorted)
}

fn of_specimens(reports: &[&SpecimenReport]) -> Table {
    let row = |r: &&SpecimenReport| {
        let worst = r.families.iter().max_by(|(_, a), (_, b)| {
            let rank = |c: &Counts| (c.percent(), c.per_million(c.tally.total()));
            rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal)
        });
        let worst = worst.map_or(String::new(), |(name, c)| format!("{name} {:.0}%", c.percent()));
        let mut cells = cells(r.name, &r.all);
        cells.extend([
            worst,
            format!("{}: {}", r.source, r.fault),
            format!("cure: {}", r.cure),
            format!("shown by: {}: {} pixels", r.case, r.case_wrong),
        ]);
        Row { search: Some(r.name.to_owned()), ..cells.into() }
    };
    let mut columns = columns("specimen", 16);
    columns.push(Column::words("worst family").least(12));
    columns.extend(["from, and its fault", "cure", "shown by"].map(Column::words));
    Table {
        caption: "Published algorithms and how often each is wrong, worst first".to_owned(),
        columns,
        rows: reports.iter().map(row).collect(),
        ..Table::default()
    }
}

/// One specimen: its card, every family, every recorded input.
pub fn detail(report: &SpecimenReport) -> String {
    let r = report;
    let mut out = format!("{}: {}\n{}\ncure: {}\n", r.name, r.source, r.fault, r.cure);
    let _ = writeln!(
        out,
        "shown by: {}: {} pixels; harmless case: {} pixels\n",
        r.case, r.case_wrong, r.harmless_wrong
    );
    out.push_str(UNITS);
    if r.families.is_empty() {
        out.push_str("no rasterizer and no line drawer: its fault shows in its case alone\n");
        return out;
    }
    let _ = writeln!(out, "pixels, values: percent with a wrong pixel, with a wrong value");
    let mut columns = columns("family", 23);
    columns.extend(["pixels", "values"].map(|what| Column::numbers(what, "").least(6)));
    let row = |(name, c): (&str, &Counts)| {
        let percents = [c.wrong_pixels, c.wrong_values].map(|n| format!("{:.1}%", c.percent_of(n)));
        cells(name, c).into_iter().chain(percents).collect::<Vec<_>>().into()
    };
    let families = r.families.iter().map(|(name, counts)| (*name, counts));
    let rows = families.chain([("all", &r.all)]).map(row).collect();
    out += &Table { columns, rows, ..Table::default() }.text([0; 2]);
    if !r.recorded.is_empty() {
        let _ = writeln!(out, "\nrecorded inputs of the book's code, wrong pixels:");
    }
    for (name, c) in &r.recorded {
        let tally = &c.tally;
        let what = match c.refused {
            0 => format!(
                "{} covered, {} extra, {} missing, {} twice",
                c.pixels, tally.extra, tally.missing, tally.twice
            ),
            _ => "refused: undefined in the published code, or without end".to_owned(),
        };
        let _ = writeln!(out, "{name:<24} {what}");
    }
    out
}

fn columns(of: &str, least: usize) -> Vec<Column> {
    let numbers = [
        ("differ", "percent of the triangles or lines with a wrong pixel or value"),
        ("extra", "pixels outside the shape, per million covered"),
        ("missing", "missing pixels, per million covered"),
        ("twice", "hits beyond the first, each triangle for itself, per million covered"),
        ("value", "worst error of a value as a fraction of the corner values' spread"),
        ("depth", "worst error of a depth as a fraction of the corner values' spread"),
        ("shared", "as twice, but pixels that two triangles of a mesh draw"),
    ];
    let numbers = numbers.map(|(label, about)| Column::numbers(label, about).least(7));
    [Column::words(of).least(least)].into_iter().chain(numbers).collect()
}

/// A row of [`columns`], in which dashes stand where nothing was drawn.
fn cells(name: &str, counts: &Counts) -> Vec<String> {
    let drawn = counts.shapes > 0;
    let rate = |n: u64| match (drawn, counts.per_million(n)) {
        (false, _) | (_, None) => "-".to_owned(),
        (true, Some(rate)) if rate < 1e7 => format!("{rate:.0}"),
        (true, Some(rate)) => format!("{rate:.0e}"),
    };
    let error = |e: f64| match e {
        _ if !drawn => "-".to_owned(),
        0.0 => "0".to_owned(),
        e if e.is_infinite() => "inf".to_owned(),
        e if (0.01..100.0).contains(&e) => format!("{e:.2}"),
        e => format!("{e:.0e}"),
    };
    let tally = &counts.tally;
    vec![
        name.to_owned(),
        if drawn { format!("{:.1}%", counts.percent()) } else { "-".to_owned() },
        rate(tally.extra),
        rate(tally.missing),
        rate(tally.twice),
        error(counts.worst_attribute),
        error(counts.worst_depth),
        rate(counts.shared),
    ]
}

/// Percent of shapes with a wrong pixel, a row for each family, a letter for each specimen.
fn by_family(out: &mut String, reports: &[&SpecimenReport], shapes: &str) {
    let Some(first) = reports.first() else { return };
    let letters = || ('A'..).map(String::from);
    let legend: Vec<_> =
        letters().zip(reports).map(|(letter, r)| format!("{letter} {}", r.name)).collect();
    let _ = writeln!(out, "\n{shapes} with a wrong pixel in percent, by family:");
    for names in legend.chunks(5) {
        let _ = writeln!(out, "  {}", names.join(", "));
    }
    let columns = letters().take(reports.len()).map(|of| Column::numbers(&of, "").least(5));
    let rows = first.families.iter().enumerate().map(|(row, (family, _))| {
        let counts = reports.iter().map(|report| &report.families[row].1);
        let cells = counts.map(|c| format!("{:.1}", c.percent_of(c.wrong_pixels)));
        [(*family).to_owned()].into_iter().chain(cells).collect::<Vec<_>>().into()
    });
    let columns = [Column::words("family").least(16)].into_iter().chain(columns).collect();
    *out += &Table { columns, rows: rows.collect(), ..Table::default() }.text([0; 2]);
}
