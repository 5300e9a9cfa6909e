//! The survey of the published faults as a report: a summary of all, or all families of one.

pub mod sheet;

use rasterproof_registry::published_check::{Counts, SpecimenReport};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::table::{self, Column, Row, Table};
use rasterproof_report::{json, page_cases};
use rasterproof_verify::comparison::Tally;

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
    let is_asked = |name: &str| reports.iter().any(|r| r.name == name.trim_end_matches(" picture"));
    let mut exhibits = if is_page { page_cases::of_specimens() } else { Vec::new() };
    exhibits.retain(|case| is_asked(&case.name));
    let taken: Vec<_> = exhibits.iter().map(|case| case.name.clone()).collect();
    let mut frames = if is_page { sheet::views(&taken) } else { Vec::new() };
    frames.retain(|view| is_asked(&view.name));
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

/// The survey, the most often wrong first, then coverage by family in percent; of a single one, every family and every
/// recorded input.
pub fn tables(reports: &[SpecimenReport]) -> Vec<Table> {
    if let [one] = reports {
        return detail(one);
    }
    let mut sorted: Vec<_> = reports.iter().collect();
    sorted.sort_by(|a, b| b.all.percent().total_cmp(&a.all.percent()));
    let is_of_lines = |r: &&SpecimenReport| Some(r.families.first()?.0.starts_with("line"));
    let of = |lines| reports.iter().filter(move |r| is_of_lines(r) == Some(lines)).collect();
    let of_shapes = |(lines, shapes)| by_family(of(lines), shapes);
    let by_family = [(false, "triangles"), (true, "lines")].into_iter().filter_map(of_shapes);
    [of_specimens(&sorted)].into_iter().chain(by_family).collect()
}

fn of_specimens(reports: &[&SpecimenReport]) -> Table {
    let row = |r: &&SpecimenReport| {
        let worst = r.families.iter().max_by(|(_, a), (_, b)| {
            let rank = |c: &Counts| (c.percent(), c.per_million(c.tally.total()));
            rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal)
        });
        let worst = worst.map_or(String::new(), |(name, c)| format!("{name} {:.0}%", c.percent()));
        let from = format!("{}: {}", r.source, r.fault);
        let shown_by = format!("{}: {} pixels", r.case, r.case_wrong);
        let mut cells = cells(r.name, &r.all);
        cells.extend([worst, from, r.cure.to_owned(), shown_by]);
        Row { search: Some(r.name.to_owned()), ..cells.into() }
    };
    let mut columns = counted("specimen 16");
    columns.extend(table::columns(":worst family | from, and its fault | :cure | :shown by"));
    let caption = "Published algorithms and how often each is wrong, worst first";
    let table = Table::of(caption, columns, reports.iter().map(row).collect());
    table.noted(vec![UNITS.to_owned()])
}

/// One specimen: its card, every family, every recorded input.
fn detail(report: &SpecimenReport) -> Vec<Table> {
    let r = report;
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
    let mut columns = counted("family 21");
    columns.extend(table::columns(">pixels 6 | >values 6"));
    let row = |(name, c): (&str, &Counts)| {
        let percents = [c.wrong_pixels, c.wrong_values].map(|n| format!("{:.1}%", c.percent_of(n)));
        cells(name, c).into_iter().chain(percents).collect::<Vec<_>>().into()
    };
    let families = r.families.iter().map(|(name, counts)| (*name, counts));
    let all = [("all", &r.all)].into_iter().filter(|_| !r.families.is_empty());
    let rows = families.chain(all).map(row).collect();
    let caption = format!("{}: {}: {}", r.name, r.source, r.fault);
    let recorded = r.recorded.iter().map(|(name, c)| {
        let Tally { extra, missing, twice, .. } = c.tally;
        let what = match c.refused {
            0 => format!("{} covered, {extra} extra, {missing} missing, {twice} twice", c.pixels),
            _ => "refused: undefined in the published code, or without end".to_owned(),
        };
        Row::of(&[name, &what])
    });
    let title = "Recorded inputs of the book's code";
    let recorded = Table::new(title, "input 22 | wrong pixels 12", recorded.collect());
    let mut tables = vec![Table::of(&caption, columns, rows).noted(notes), recorded];
    tables.retain(|table| !table.rows.is_empty() || !table.notes.is_empty());
    tables
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
fn by_family(reports: Vec<&SpecimenReport>, shapes: &str) -> Option<Table> {
    let first = reports.first()?;
    let letters = || ('A'..).map(String::from);
    let legend: Vec<_> =
        letters().zip(&reports).map(|(letter, r)| format!("{letter} {}", r.name)).collect();
    let named = letters().zip(&reports);
    let columns = named.map(|(letter, r)| Column::numbers(&letter, r.name).least(5));
    let rows = first.families.iter().enumerate().map(|(row, (family, _))| {
        let counts = reports.iter().map(|report| &report.families[row].1);
        let cells = counts.map(|c| format!("{:.1}", c.percent_of(c.wrong_pixels)));
        [(*family).to_owned()].into_iter().chain(cells).collect::<Vec<_>>().into()
    });
    let caption = format!("{shapes} with a wrong pixel in percent, by family");
    let columns = [Column::words("family").least(16)].into_iter().chain(columns).collect();
    Some(Table::of(&caption, columns, rows.collect()).noted(vec![legend.join(", ")]))
}
