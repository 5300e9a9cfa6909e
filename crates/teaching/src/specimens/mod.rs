//! The survey of the published faults as a report: a summary of all, or all families of one.

pub mod sheet;

use rasterproof_registry::published_check::{Counts, SpecimenReport};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::table::{self, Column, Row, Table};
use rasterproof_report::{json, page_cases};
use rasterproof_verify::comparison::Tally;

/// What the columns of [`counted`] count, as a note below a table.
const UNITS: &str = "\
differ: percent of the triangles or lines with a wrong pixel or value; extra, missing, twice: wrong \
pixels per million covered, each triangle for itself; value, depth: worst error as a fraction of the \
corner values' spread; shared: as twice, but pixels that two triangles of a mesh draw";

/// The survey for machines; an infinite error is `null`.
#[derive(serde::Serialize)]
struct Survey<'a> {
    version: &'static str,
    seed: u64,
    cases: u64,
    specimens: &'a [SpecimenReport],
}

/// Each is wrong on the case that exposes it, and right on its harmless one.
pub fn are_caught(reports: &[SpecimenReport]) -> bool {
    reports.iter().all(|r| r.case_wrong > 0 && r.harmless_wrong == 0)
}

/// How often each is wrong; on a page also the exposing cases and the pictures.
pub fn report(seed: u64, cases: u64, reports: &[SpecimenReport], is_page: bool) -> Report {
    let good = are_caught(reports);
    let sentence = if good {
        format!("Each of {} published faults is exposed by its case.", reports.len())
    } else {
        "A published fault is not exposed by its case, or shows in its harmless one.".to_owned()
    };
    let word = if good { "CAUGHT" } else { "NOT CAUGHT" };
    // A page shows the cases and pictures of those that are asked for, among those of all.
    let (mut exhibits, mut frames) = (Vec::new(), Vec::new());
    if is_page {
        exhibits = page_cases::of_specimens();
        exhibits.retain(|case| is_among(reports, &case.name));
        let taken: Vec<_> = exhibits.iter().map(|case| case.name.clone()).collect();
        frames = sheet::views(&taken);
        frames.retain(|view| is_among(reports, &view.name));
    }
    Report {
        title: "Published algorithms and their faults".to_owned(),
        outcome: Some(Outcome::new(good, word, sentence)),
        tables: tables(reports),
        data: json::value(&Survey {
            version: env!("CARGO_PKG_VERSION"),
            seed,
            cases,
            specimens: reports,
        }),
        cases: exhibits,
        frames,
        ..Report::default()
    }
}

/// Whether one of the reports has the name of a case, or of a picture that is named apart from a case.
fn is_among(reports: &[SpecimenReport], name: &str) -> bool {
    reports.iter().any(|r| r.name == name.trim_end_matches(" picture"))
}

/// The survey, the most often wrong first, then coverage by family in percent; of a single one, every family and every
/// recorded input.
pub fn tables(reports: &[SpecimenReport]) -> Vec<Table> {
    if let [one] = reports {
        return detail(one);
    }
    // All of them, the most often wrong first.
    let mut sorted: Vec<_> = reports.iter().collect();
    sorted.sort_by(|a, b| b.all.percent().total_cmp(&a.all.percent()));
    // Triangles and lines have different families, so each have a table. Those without families draw neither.
    let (mut of_triangles, mut of_lines) = (Vec::new(), Vec::new());
    for report in reports {
        match report.families.first() {
            Some((family, _)) if family.starts_with("line") => of_lines.push(report),
            Some(_) => of_triangles.push(report),
            None => {}
        }
    }
    let mut tables = vec![of_specimens(&sorted)];
    tables.extend(by_family(&of_triangles, "triangles"));
    tables.extend(by_family(&of_lines, "lines"));
    tables
}

/// A row for each specimen, in this order.
fn of_specimens(reports: &[&SpecimenReport]) -> Table {
    let mut columns = counted("specimen 16");
    columns.extend(table::columns(":worst family | from, and its fault | :cure | :shown by"));
    let mut rows = Vec::new();
    for r in reports {
        let mut cells = cells(r.name, &r.all);
        cells.push(worst_family(r));
        cells.push(format!("{}: {}", r.source, r.fault));
        cells.push(r.cure.to_owned());
        cells.push(format!("{}: {} pixels", r.case, r.case_wrong));
        rows.push(Row { search: Some(r.name.to_owned()), ..cells.into() });
    }
    let caption = "Published algorithms and how often each is wrong, worst first";
    Table::of(caption, columns, rows).noted(vec![UNITS.to_owned()])
}

/// The family with the most wrong shapes, the last one of equal ones, and among these by wrong pixels; empty without families.
fn worst_family(report: &SpecimenReport) -> String {
    let rank = |c: &Counts| (c.percent(), c.per_million(c.tally.total()));
    let mut worst: Option<&(&str, Counts)> = None;
    for family in &report.families {
        if !worst.is_some_and(|worst| rank(&worst.1) > rank(&family.1)) {
            worst = Some(family);
        }
    }
    worst.map_or(String::new(), |(name, c)| format!("{name} {:.0}%", c.percent()))
}

/// One specimen: its card, every family, every recorded input.
fn detail(r: &SpecimenReport) -> Vec<Table> {
    let (case, wrong, harmless) = (&r.case, r.case_wrong, r.harmless_wrong);
    let notes = vec![
        format!("cure: {}", r.cure),
        format!("shown by: {case}: {wrong} pixels; harmless case: {harmless} pixels"),
        match r.families.is_empty() {
            true => {
                "no rasterizer and no line drawer: its fault shows in its case alone".to_owned()
            }
            false => {
                format!("{UNITS}; pixels, values: percent with a wrong pixel, with a wrong value")
            }
        },
    ];
    // A row for each family, and one for all of them.
    let mut columns = counted("family 21");
    columns.extend(table::columns(">pixels 6 | >values 6"));
    let mut rows = Vec::new();
    for (name, counts) in &r.families {
        rows.push(detailed(name, counts));
    }
    if !r.families.is_empty() {
        rows.push(detailed("all", &r.all));
    }
    let caption = format!("{}: {}: {}", r.name, r.source, r.fault);
    let card = Table::of(&caption, columns, rows).noted(notes);
    // A row for each input of which the book's own output is known.
    let mut rows = Vec::new();
    for (name, c) in &r.recorded {
        let Tally { extra, missing, twice, .. } = c.tally;
        let what = match c.refused {
            0 => format!("{} covered, {extra} extra, {missing} missing, {twice} twice", c.pixels),
            _ => "refused: undefined in the published code, or without end".to_owned(),
        };
        rows.push(Row::of(&[name, &what]));
    }
    let title = "Recorded inputs of the book's code";
    let mut tables = vec![card, Table::new(title, "input 22 | wrong pixels 12", rows)];
    tables.retain(|table| !table.rows.is_empty() || !table.notes.is_empty());
    tables
}

/// A row of [`cells`], then the shapes with a wrong pixel and those with a wrong value.
fn detailed(name: &str, counts: &Counts) -> Row {
    let mut cells = cells(name, counts);
    for wrong in [counts.wrong_pixels, counts.wrong_values] {
        cells.push(format!("{:.1}%", counts.percent_of(wrong)));
    }
    cells.into()
}

/// A column for what was counted of, as it is written, and those of the counts.
fn counted(of: &str) -> Vec<Column> {
    table::columns(&format!(
        "{of} | >differ 7 percent of the triangles or lines with a wrong pixel or value | >extra 7 pixels outside the \
         shape, per million covered | >missing 7 missing pixels, per million covered | >twice 7 hits beyond the first, \
         each triangle for itself, per million covered | >value 7 worst error of a value as a fraction of the corner \
         values' spread | >depth 7 worst error of a depth as a fraction of the corner values' spread | >shared 7 as \
         twice, but pixels that two triangles of a mesh draw"
    ))
}

/// A row of [`counted`], in which dashes stand where nothing was drawn.
fn cells(name: &str, counts: &Counts) -> Vec<String> {
    let tally = &counts.tally;
    let mut cells = vec![name.to_owned()];
    if counts.shapes == 0 {
        cells.resize(8, "-".to_owned());
        return cells;
    }
    cells.push(format!("{:.1}%", counts.percent()));
    for pixels in [tally.extra, tally.missing, tally.twice] {
        cells.push(rate(counts.per_million(pixels)));
    }
    for error in [counts.worst_attribute, counts.worst_depth] {
        cells.push(shown_error(error));
    }
    cells.push(rate(counts.per_million(counts.shared)));
    cells
}

/// Pixels per million covered; nothing where none is covered.
fn rate(per_million: Option<f64>) -> String {
    match per_million {
        None => "-".to_owned(),
        Some(rate) if rate < 1e7 => format!("{rate:.0}"),
        Some(rate) => format!("{rate:.0e}"),
    }
}

/// An error in few characters, whatever its size.
fn shown_error(error: f64) -> String {
    match error {
        0.0 => "0".to_owned(),
        e if e.is_infinite() => "inf".to_owned(),
        e if (0.01..100.0).contains(&e) => format!("{e:.2}"),
        e => format!("{e:.0e}"),
    }
}

/// Percent of shapes with a wrong pixel, a row for each family, a letter for each specimen.
fn by_family(reports: &[&SpecimenReport], shapes: &str) -> Option<Table> {
    let first = reports.first()?;
    let mut columns = vec![Column::words("family").least(16)];
    let mut legend = Vec::new();
    for (letter, report) in ('A'..).zip(reports) {
        columns.push(Column::numbers(&letter.to_string(), report.name).least(5));
        legend.push(format!("{letter} {}", report.name));
    }
    let mut rows: Vec<Row> = Vec::new();
    // All of them were asked the same families in the same order.
    for (row, (family, _)) in first.families.iter().enumerate() {
        let mut cells = vec![(*family).to_owned()];
        for report in reports {
            let counts = &report.families[row].1;
            cells.push(format!("{:.1}", counts.percent_of(counts.wrong_pixels)));
        }
        rows.push(cells.into());
    }
    let caption = format!("{shapes} with a wrong pixel in percent, by family");
    Some(Table::of(&caption, columns, rows).noted(vec![legend.join(", ")]))
}
