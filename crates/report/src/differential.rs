//! The verdict as tables: a line for each family, a column for each pair, of triangles, of lines, and of triangles
//! off the lattice.

use std::fmt::Write as _;

use super::html::Outcome;
use super::table::{Column, Mark, Row, Table};
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_render::scene::named;
use rasterproof_verify::cases::named::Input;
use rasterproof_verify::comparison::unsnapped::{ExactFamilyReport, ExactVerdict};
use rasterproof_verify::comparison::{FamilyReport, PairReport, Tally, Verdict};

/// The families on the lattice as text with their legends and sums; at most 100 columns wide for two engines.
pub fn text(verdict: &Verdict) -> String {
    let section = |families: Vec<&FamilyReport>| {
        let judged = judged(families[0]).map(|pair| pair.actual.as_str());
        format!(
            "{}: {}, O oracle\n(A:O wrong pixels of A against O; val, dep: worst value and depth as a fraction of its bound)\n{}\n",
            shapes(families[0]),
            legend(judged),
            on_grid(&families).text([0; 2])
        )
    };
    by_kind(verdict).map(section).collect()
}

/// The same of the engines off the lattice; empty where nothing was judged there.
pub fn text_off_grid(verdict: &ExactVerdict) -> String {
    let families: Vec<_> = verdict.families.iter().collect();
    let Some(first) = families.first() else { return String::new() };
    format!(
        "triangles off the grid: {}, O oracle-exact; wrong pixels;\ndecisions (scanline: edge and \
         row; edge function: edge and sample) and those in exact arithmetic\n{}\n",
        legend(first.engines.iter().map(|e| e.engine.as_str())),
        off_lattice(&families).text([0; 2])
    )
}

/// All families as tables of a page, worst first.
pub fn tables(verdict: &Verdict, off_grid: &ExactVerdict) -> Vec<Table> {
    let on_grid = by_kind(verdict).map(|mut families| {
        let wrong = |f: &FamilyReport| {
            let pixels = |p: &PairReport| p.tally.total() + p.fragments.total() + p.panics;
            f.pairs.iter().map(|p| [pixels(p), p.wrong_cases]).fold([0; 2], sum)
        };
        let closest = |f: &FamilyReport| judged(f).map(PairReport::worst).fold(0.0, f64::max);
        families.sort_by(|a, b| wrong(b).cmp(&wrong(a)).then(closest(b).total_cmp(&closest(a))));
        on_grid(&families)
    });
    let wrong = |f: &ExactFamilyReport| {
        let counts = f.engines.iter().map(|e| [e.tally.total() + e.panics, e.wrong_cases]);
        let doubts: u64 = f.engines.iter().map(|e| e.decisions.by_fallback).sum();
        std::cmp::Reverse((counts.fold([0; 2], sum), doubts))
    };
    let mut off_grid: Vec<_> = off_grid.families.iter().collect();
    off_grid.sort_by_key(|f| wrong(f));
    on_grid.chain((!off_grid.is_empty()).then(|| off_lattice(&off_grid))).collect()
}

fn sum(a: [u64; 2], b: [u64; 2]) -> [u64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// The families of triangles, and those of lines, where there are any.
fn by_kind(verdict: &Verdict) -> impl Iterator<Item = Vec<&FamilyReport>> {
    let of = |lines| verdict.families.iter().filter(|f| f.lines == lines).collect::<Vec<_>>();
    [false, true].map(of).into_iter().filter(|families| !families.is_empty())
}

fn shapes(family: &FamilyReport) -> &'static str {
    if family.lines { "lines" } else { "triangles" }
}

fn judged(family: &FamilyReport) -> impl Iterator<Item = &PairReport> {
    family.pairs.iter().filter(|pair| pair.target == "oracle")
}

/// Engines with the letters that stand for them.
fn legend<'a>(engines: impl Iterator<Item = &'a str>) -> String {
    let named = ('A'..).zip(engines).map(|(letter, engine)| format!("{letter} {engine}"));
    named.collect::<Vec<_>>().join(", ")
}

fn on_grid(families: &[&FamilyReport]) -> Table {
    let first = families[0];
    let shapes = shapes(first);
    let letter = |name: &str| {
        let known = ('A'..).zip(judged(first)).find(|(_, pair)| pair.actual == name);
        known.map_or('O', |(letter, _)| letter)
    };
    let mut columns = heads([15, 4], shapes);
    for PairReport { actual, target, .. } in &first.pairs {
        let about = "wrong pixels of the first, judged by the second";
        let column = Column::numbers(&format!("{actual} : {target}"), about).least(6);
        columns.push(column.short(format!("{}:{}", letter(actual), letter(target))));
    }
    for (what, short) in [("values", "val"), ("depths", "dep")] {
        let about = "the largest difference from the exact one, as a fraction of its bound";
        columns.extend(judged(first).map(|PairReport { actual, .. }| {
            let column = Column::numbers(&format!("{what} of {actual}"), about).least(6);
            column.short(format!("{short} {}", letter(actual)))
        }));
    }
    let row = |f: &FamilyReport| {
        let mut cells = counts(&f.family, [f.cases, f.shapes, f.pixels, f.tie_cases]);
        cells.extend(f.pairs.iter().map(|p| wrong(p.tally, p.panics)));
        let ratio = |values: u64, worst: f64| match (values, worst) {
            (0, _) => "-".to_owned(),
            (_, w) if w < 100.0 => format!("{w:.2}"),
            (_, w) => format!("{w:.0e}"),
        };
        cells.extend(judged(f).map(|p| ratio(p.values, p.worst_attribute)));
        cells.extend(judged(f).map(|p| ratio(p.values, p.worst_depth)));
        (cells, f.pairs.iter().any(|p| p.wrong_cases > 0) || f.oracle_overlap > 0)
    };
    let caption = format!("Wrong pixels: {shapes}, by family and pair, worst first");
    Table { caption, columns, rows: rows(families, row) }
}

fn off_lattice(families: &[&ExactFamilyReport]) -> Table {
    let mut columns = heads([12, 5], "triangles");
    for (letter, engine) in ('A'..).zip(&families[0].engines) {
        let name = &engine.engine;
        columns.extend([
            Column::numbers(&format!("{name} : oracle-exact"), "wrong pixels")
                .short(format!("{letter}:O"))
                .least(5),
            Column::numbers(&format!("{name} decisions"), "by floats, and in exact arithmetic")
                .short(format!("decided {letter}"))
                .least(10),
            Column::numbers(&format!("{name} in doubt"), "decisions that took exact arithmetic")
                .short(format!("exact {letter}"))
                .least(8),
        ]);
    }
    let row = |f: &ExactFamilyReport| {
        let mut cells = counts(&f.family, [f.cases, f.triangles, f.pixels, f.tie_cases]);
        for e in &f.engines {
            let Decisions { by_filter, by_fallback } = e.decisions;
            let decisions = [by_filter + by_fallback, by_fallback].map(|n| n.to_string());
            cells.push(wrong(e.tally, e.panics));
            cells.extend(decisions);
        }
        (cells, f.engines.iter().any(|e| e.wrong_cases > 0) || f.oracle_faults > 0)
    };
    let caption = "Wrong pixels: triangles off the grid, by family and engine, worst first";
    Table { caption: caption.to_owned(), columns, rows: rows(families, row) }
}

/// The columns that both tables begin with.
fn heads([family, ties]: [usize; 2], shapes: &str) -> Vec<Column> {
    vec![
        Column::words("family").least(family),
        Column::numbers("cases", "cases judged").least(6),
        Column::numbers(shapes, "shapes judged").least(9),
        Column::numbers("pixels", "covered pixels, by the oracle").least(9),
        Column::numbers("ties", "percent of the cases, in which a sample lies exactly on an edge")
            .least(ties),
    ]
}

fn counts(family: &str, [cases, shapes, pixels, ties]: [u64; 4]) -> Vec<String> {
    let percent = (100 * ties + cases / 2).checked_div(cases).unwrap_or(0);
    let counts = [cases, shapes, pixels].map(|n| n.to_string());
    [family.to_owned()].into_iter().chain(counts).chain([format!("{percent}%")]).collect()
}

fn wrong(tally: Tally, panics: u64) -> String {
    match panics {
        0 => tally.total().to_string(),
        n => format!("{}, {n} panics", tally.total()),
    }
}

/// A row for each family, and where there are several one for all of them together.
fn rows<F: Clone + std::ops::AddAssign>(
    families: &[&F],
    row: impl Fn(&F) -> (Vec<String>, bool),
) -> Vec<Row> {
    let one = |family: &&F| {
        let (cells, is_wrong) = row(family);
        let mark = if is_wrong { Mark::Wrong } else { Mark::Plain };
        Row { search: Some(cells[0].clone()), cells, mark }
    };
    let mut rows: Vec<Row> = families.iter().map(one).collect();
    if let [first, others @ ..] = families
        && !others.is_empty()
    {
        let mut all = F::clone(first);
        others.iter().for_each(|family| all += F::clone(family));
        let (mut cells, _) = row(&all);
        cells[0] = "all".to_owned();
        rows.push(Row { cells, mark: Mark::Sum, search: None });
    }
    rows
}

/// The verdict in a word and a sentence, with the counts that `verify` prints.
#[must_use]
pub fn outcome(verdict: &Verdict, off_grid: &ExactVerdict) -> Outcome {
    let good = verdict.agrees() && off_grid.agrees();
    let (triangles, lines) = (verdict.sum(false, |f| f.shapes), verdict.sum(true, |f| f.shapes));
    let mut judged = format!("{triangles} triangles and {lines} lines");
    if off_grid.triangles() > 0 {
        judged += &format!(", {} triangles off the grid", off_grid.triangles());
    }
    let wrong = verdict.mismatches() + off_grid.mismatches();
    let sentence = match (good, wrong) {
        (true, _) => format!("Every engine drew what the oracle drew: {judged}, 0 wrong pixels."),
        (false, 0) => {
            let pairs = verdict.families.iter().flat_map(|f| &f.pairs).map(|p| p.wrong_cases);
            let engines = off_grid.families.iter().flat_map(|f| &f.engines).map(|e| e.wrong_cases);
            let cases: u64 = pairs.chain(engines).sum();
            let what = match verdict.comparisons().fragments.total() {
                0 => "panic or leave a value's bound",
                _ => "panic, leave a value's bound or have fragments unlike their coverage",
            };
            format!("No wrong pixels, but {cases} cases {what}: {judged}.")
        }
        (false, _) => format!("{wrong} wrong pixels in {judged}."),
    };
    Outcome::of(good, sentence)
}

/// Named inputs that must be refused, with the reason they are.
pub fn refused() -> Table {
    let rows = named::named().into_iter().filter_map(|named| {
        let Input::Refused(triangles) = named.input else { return None };
        let mut reasons: Vec<String> = triangles
            .iter()
            .flatten()
            .filter_map(|&[x, y]| SubpixelPoint::from_px(x, y).err().map(|r| r.to_string()))
            .collect();
        reasons.sort();
        reasons.dedup();
        Some(vec![named.name.to_owned(), named.about.to_owned(), reasons.join("; ")].into())
    });
    Table {
        caption: "Inputs that are refused, with the reason given".to_owned(),
        columns: ["case", "input", "answer"].map(Column::words).to_vec(),
        rows: rows.collect(),
    }
}

/// The quotas in a sentence; empty where no triangles were judged.
pub fn quota_line(verdict: &Verdict) -> String {
    if verdict.sum(false, |f| f.cases) == 0 {
        return String::new();
    }
    let parts =
        verdict.quotas().map(|(what, is, wanted)| format!("{what} {is}% (quota {wanted}%)"));
    format!("of the triangle cases: {}\n", parts.join(", "))
}

/// A sentence for each pair that disagrees, and for oracles that overlap themselves.
pub fn disagreements(verdict: &Verdict) -> String {
    let mut out = String::new();
    for f in &verdict.families {
        for pair in f.pairs.iter().filter(|pair| !pair.agrees()) {
            let PairReport { actual, target, wrong_cases, .. } = pair;
            disagreement(
                &mut out,
                [&f.family, actual, target],
                [*wrong_cases, f.cases],
                &kinds(pair),
            );
        }
        if f.oracle_overlap > 0 {
            let (family, pixels) = (&f.family, f.oracle_overlap);
            let _ =
                writeln!(out, "{family}: the oracle hits {pixels} pixels of disjoint shapes twice");
        }
    }
    out
}

/// A sentence for each engine off the lattice that disagrees, and for an oracle that does not tile a window.
pub fn disagreements_off_grid(verdict: &ExactVerdict) -> String {
    let mut out = String::new();
    for f in &verdict.families {
        for e in f.engines.iter().filter(|e| e.wrong_cases > 0) {
            let names = [&f.family, &e.engine, "oracle-exact"];
            disagreement(
                &mut out,
                names,
                [e.wrong_cases, f.cases],
                &pixels_and_panics(e.tally, e.panics),
            );
        }
        if f.oracle_faults > 0 {
            let (family, pixels) = (&f.family, f.oracle_faults);
            let _ = writeln!(
                out,
                "{family}: the oracle does not hit {pixels} pixels of tiled windows exactly once"
            );
        }
    }
    out
}

fn disagreement(
    out: &mut String,
    [family, actual, target]: [&str; 3],
    [wrong, cases]: [u64; 2],
    kinds: &str,
) {
    let _ = writeln!(
        out,
        "{family}: {actual} against {target}: wrong in {wrong} of {cases} cases{kinds}"
    );
}

fn pixels_and_panics(tally: Tally, panics: u64) -> String {
    let pixels =
        Some(tally).filter(|tally| tally.total() > 0).map(|t| format!(": {}", t.describe()));
    let panics = Some(panics).filter(|panics| *panics > 0).map(|n| format!(": {n} panics"));
    pixels.into_iter().chain(panics).collect()
}

/// What is wrong with a pair, each comparison named, after a colon.
fn kinds(pair: &PairReport) -> String {
    let mut out = pixels_and_panics(pair.tally, pair.panics);
    for (what, worst) in [("attribute", pair.worst_attribute), ("depth", pair.worst_depth)] {
        if worst > 1.0 {
            let _ = write!(out, "\n    worst {what} {worst:.3e} times its bound");
        }
    }
    if pair.fragments.total() > 0 {
        let what = pair.fragments.describe();
        let _ = write!(out, "\n    its fragments against its own coverage: {what}");
    }
    out
}
