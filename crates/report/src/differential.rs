//! The verdict as tables: a line for each family, a column for each pair, of triangles, of lines, and of triangles
//! off the lattice.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::html::Outcome;
use super::table::{self, Column, Mark, Row, Table};
use super::words::noun;
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_registry::named;
use rasterproof_verify::cases::Kind;
use rasterproof_verify::cases::named::Input;
use rasterproof_verify::comparison::{FamilyReport, PairReport, Tally, Verdict};

/// All families as tables, worst first; at most 100 columns wide for two engines.
pub fn tables(verdict: &Verdict) -> Vec<Table> {
    let wrong = |f: &FamilyReport| {
        let pixels = |p: &PairReport| p.tally.total() + p.fragments.total() + p.panics;
        f.pairs.iter().map(|p| [pixels(p), p.wrong_cases]).fold([0; 2], sum)
    };
    let doubts = |f: &FamilyReport| f.pairs.iter().map(|p| p.decisions.by_fallback).sum::<u64>();
    let closest = |f: &FamilyReport| judged(f).map(PairReport::worst).fold(0.0, f64::max);
    let sorted = |mut families: Vec<&FamilyReport>| {
        families.sort_by(|a, b| {
            let by_wrong = wrong(b).cmp(&wrong(a));
            by_wrong.then(closest(b).total_cmp(&closest(a))).then(doubts(b).cmp(&doubts(a)))
        });
        table(&families)
    };
    let mut tables: Vec<Table> = by_kind(verdict).map(sorted).collect();
    if let Some(last) = tables.last_mut() {
        last.notes.extend(quotas(verdict));
        last.notes.extend(disagreements(verdict));
    }
    tables
}

fn sum(a: [u64; 2], b: [u64; 2]) -> [u64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// The families of each kind, where there are any.
fn by_kind(verdict: &Verdict) -> impl Iterator<Item = Vec<&FamilyReport>> {
    let of = |(kind, _)| verdict.families.iter().filter(|f| f.kind == kind).collect::<Vec<_>>();
    Kind::ALL.map(of).into_iter().filter(|families| !families.is_empty())
}

fn shapes(kind: Kind) -> &'static str {
    match kind {
        Kind::Triangles => "triangles",
        Kind::Lines => "lines",
        Kind::Unsnapped => "triangles off the grid",
    }
}

fn judged(family: &FamilyReport) -> impl Iterator<Item = &PairReport> {
    family.pairs.iter().filter(|pair| pair.is_by_oracle())
}

/// Engines with the letters that stand for them.
fn legend<'a>(engines: impl Iterator<Item = &'a str>) -> String {
    let named = ('A'..).zip(engines).map(|(letter, engine)| format!("{letter} {engine}"));
    named.collect::<Vec<_>>().join(", ")
}

fn table(families: &[&FamilyReport]) -> Table {
    let first = families[0];
    let shapes = shapes(first.kind);
    let short = shapes.split(' ').next().unwrap_or(shapes);
    let letter = |name: &str| {
        let known = ('A'..).zip(judged(first)).find(|(_, pair)| pair.actual == name);
        known.map_or('O', |(letter, _)| letter)
    };
    let mut columns = table::columns(&format!(
        "family 15 | >cases 6 cases judged | >{shapes} 9 shapes judged | >pixels 9 covered pixels, by the oracle | >ties 4 \
         percent of the cases, in which a sample lies exactly on an edge"
    ));
    columns[2] = columns[2].clone().short(short);
    for PairReport { actual, target, .. } in &first.pairs {
        let about = "wrong pixels of the first, judged by the second";
        let column = Column::numbers(&format!("{actual} : {target}"), about).least(6);
        columns.push(column.short(format!("{}:{}", letter(actual), letter(target))));
    }
    // Two more of each engine: its worst value and depth, or its decisions and those in doubt.
    let worst = "the largest difference from the exact one, as a fraction of its bound";
    let more = match first.kind {
        Kind::Unsnapped => [
            ("decisions", "decided", "by floats, and in exact arithmetic"),
            ("doubts", "exact", "decisions that took exact arithmetic"),
        ],
        _ => [("values", "val", worst), ("depths", "dep", worst)],
    };
    for (what, short, about) in more {
        columns.extend(judged(first).map(|PairReport { actual, .. }| {
            let column = Column::numbers(&format!("{what} of {actual}"), about).least(6);
            column.short(format!("{short} {}", letter(actual)))
        }));
    }
    let row = |f: &FamilyReport| {
        let percent = (100 * f.tie_cases + f.cases / 2).checked_div(f.cases).unwrap_or(0);
        let counts = [f.cases, f.shapes, f.pixels].map(|n| n.to_string());
        let mut cells = vec![f.family.clone()];
        cells.extend(counts.into_iter().chain([format!("{percent}%")]));
        cells.extend(f.pairs.iter().map(|p| wrong(p.tally, p.panics)));
        let ratio = |values: u64, worst: f64| match (values, worst) {
            (0, _) => "-".to_owned(),
            (_, w) if w < 100.0 => format!("{w:.2}"),
            (_, w) => format!("{w:.0e}"),
        };
        let cell = |p: &PairReport, second: bool| {
            let Decisions { by_filter, by_fallback } = p.decisions;
            match (f.kind, second) {
                (Kind::Unsnapped, false) => (by_filter + by_fallback).to_string(),
                (Kind::Unsnapped, true) => by_fallback.to_string(),
                (_, false) => ratio(p.values, p.worst_attribute),
                (_, true) => ratio(p.values, p.worst_depth),
            }
        };
        for second in [false, true] {
            cells.extend(judged(f).map(|p| cell(p, second)));
        }
        let is_right = f.pairs.iter().all(|p| p.wrong_cases == 0) && f.oracle_faults == 0;
        let wrong = f.pairs.iter().map(|p| p.tally.total()).sum();
        Row { search: Some(f.family.clone()), wrong, ..Row::from(cells).marked(is_right) }
    };
    let caption = format!("Wrong pixels: {shapes}, by family and pair, worst first");
    let what = match first.kind {
        Kind::Unsnapped => "decided: sides of edges; exact: those in exact arithmetic",
        _ => "val, dep: worst value and depth as a fraction of its bound",
    };
    let engines = legend(judged(first).map(|pair| pair.actual.as_str()));
    let legend = format!("{engines}, O oracle; A:O wrong pixels of A against O; {what}");
    Table { caption, columns, rows: rows(families, row), legend, ..Table::default() }
}

fn wrong(tally: Tally, panics: u64) -> String {
    match panics {
        0 => tally.total().to_string(),
        n => format!("{}, {n} panics", tally.total()),
    }
}

/// A row for each family, and where there are several one for all of them together.
fn rows(families: &[&FamilyReport], row: impl Fn(&FamilyReport) -> Row) -> Vec<Row> {
    let mut rows: Vec<Row> = families.iter().map(|family| row(family)).collect();
    if let [first, others @ ..] = families
        && !others.is_empty()
    {
        let mut all = FamilyReport::clone(first);
        others.iter().for_each(|family| all += FamilyReport::clone(family));
        let Row { mut cells, .. } = row(&all);
        cells[0] = "all".to_owned();
        rows.push(Row { cells, mark: Mark::Sum, ..Row::default() });
    }
    rows
}

pub fn judged_shapes(verdict: &Verdict) -> String {
    let [triangles, lines, free] = Kind::ALL.map(|(kind, _)| verdict.sum(kind, |f| f.shapes));
    let beside = match free {
        0 => String::new(),
        n => format!(", {n} {} off the grid", noun(n, "triangle", "triangles")),
    };
    let of_triangles = noun(triangles, "triangle", "triangles");
    format!("{triangles} {of_triangles} and {lines} {}{beside}", noun(lines, "line", "lines"))
}

/// The verdict in a word and a sentence, with the counts that `verify` prints.
pub fn outcome(verdict: &Verdict) -> Outcome {
    let (good, judged) = (verdict.agrees(), judged_shapes(verdict));
    let wrong = verdict.mismatches();
    let sentence = match (good, wrong) {
        (true, _) => format!("{judged}, 0 wrong pixels"),
        (false, 0) => {
            let pairs = verdict.families.iter().flat_map(|f| &f.pairs);
            let cases: u64 = pairs.map(|p| p.wrong_cases).sum();
            let what = match verdict.comparisons().fragments.total() {
                0 => "panic or leave a value's bound",
                _ => "panic, leave a value's bound or have fragments unlike their coverage",
            };
            format!(
                "No wrong pixels, but {cases} {} {what}: {judged}.",
                noun(cases, "case", "cases")
            )
        }
        (false, _) => format!("{wrong} wrong {} in {judged}.", noun(wrong, "pixel", "pixels")),
    };
    let answer = if good { "every engine is right" } else { "not every engine is right" };
    Outcome { answer: answer.to_owned(), ..Outcome::of(good, sentence) }
}

/// Named inputs that must be refused, with the reason they are.
pub fn refused() -> Table {
    let rows = named::named().into_iter().filter_map(|named| {
        let Input::Refused(triangles) = named.input else { return None };
        let reason = |&[x, y]: &[f64; 2]| Some(SubpixelPoint::from_px(x, y).err()?.to_string());
        let reasons: BTreeSet<String> = triangles.iter().flatten().filter_map(reason).collect();
        let reasons = reasons.into_iter().collect::<Vec<_>>().join("; ");
        Some(Row::of(&[&named.name, &named.about, &reasons]))
    });
    let columns = "case 6 | input | answer";
    Table::new("Inputs that are refused, with the reason given", columns, rows.collect())
}

/// The quotas in a sentence; nothing where no triangles were judged.
fn quotas(verdict: &Verdict) -> Option<String> {
    let parts =
        verdict.quotas().map(|(what, is, wanted)| format!("{what} {is}% (quota {wanted}%)"));
    let has_triangles = verdict.sum(Kind::Triangles, |f| f.cases) > 0;
    has_triangles.then(|| format!("of the triangle cases: {}", parts.join(", ")))
}

/// A sentence for each pair that disagrees, and for oracles that are wrong by themselves.
pub fn disagreements(verdict: &Verdict) -> Vec<String> {
    let mut out = Vec::new();
    for f in &verdict.families {
        let (family, cases) = (&f.family, f.cases);
        for pair in f.pairs.iter().filter(|pair| !pair.agrees()) {
            let PairReport { actual, target, wrong_cases, .. } = pair;
            let kinds = kinds(pair);
            out.push(format!(
                "{family}: {actual} against {target}: wrong in {wrong_cases} of {cases} {}{kinds}",
                noun(cases, "case", "cases")
            ));
        }
        if let pixels @ 1.. = f.oracle_faults {
            let fault = match f.kind {
                Kind::Unsnapped => {
                    let of = noun(pixels, "pixel", "pixels");
                    format!("does not hit {pixels} {of} of tiled windows exactly once")
                }
                _ => {
                    let of = noun(pixels, "pixel", "pixels");
                    format!("hits {pixels} {of} of disjoint shapes twice")
                }
            };
            out.push(format!("{family}: the oracle {fault}"));
        }
    }
    out
}

/// What is wrong with a pair, each comparison named, after a colon.
fn kinds(pair: &PairReport) -> String {
    let mut out = match pair.tally.total() {
        0 => String::new(),
        _ => format!(": {}", pair.tally.describe()),
    };
    if pair.panics > 0 {
        let _ = write!(out, ": {} panics", pair.panics);
    }
    for (what, worst) in [("attribute", pair.worst_attribute), ("depth", pair.worst_depth)] {
        if worst > 1.0 {
            let _ = write!(out, "; worst {what} {worst:.3e} times its bound");
        }
    }
    if pair.fragments.total() > 0 {
        let what = pair.fragments.describe();
        let _ = write!(out, "; its fragments against its own coverage: {what}");
    }
    out
}
