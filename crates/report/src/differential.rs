//! The verdict as tables: a line for each family, a column for each pair, of triangles, of lines, and of triangles
//! off the lattice.

use std::cmp::Ordering;
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
    let mut tables: Vec<Table> = Vec::new();
    for (kind, _) in Kind::ALL {
        let mut families: Vec<_> = verdict.families.iter().filter(|f| f.kind == kind).collect();
        families.sort_by(|a, b| Badness::of(b).compare(&Badness::of(a)));
        if !families.is_empty() {
            tables.push(table(&families));
        }
    }
    // What is said of all tables stands below the last one.
    if let Some(last) = tables.last_mut() {
        last.notes.extend(quotas(verdict));
        last.notes.extend(disagreements(verdict));
    }
    tables
}

/// How bad a family is: what is wrong, then how close values come to their bounds, then how often floats did not suffice.
#[derive(Default)]
struct Badness {
    /// Wrong pixels and fragments, and panics.
    pixels: u64,
    cases: u64,
    /// The largest part of a bound; above 1 the value is wrong.
    closest: f64,
    /// Decisions that took exact arithmetic.
    doubts: u64,
}

impl Badness {
    fn of(family: &FamilyReport) -> Self {
        let mut bad = Self::default();
        for pair in &family.pairs {
            bad.pixels += pair.tally.total() + pair.fragments.total() + pair.panics;
            bad.cases += pair.wrong_cases;
            bad.doubts += pair.decisions.by_fallback;
            // Engines against each other have no bounds of their own.
            if pair.is_by_oracle() {
                bad.closest = bad.closest.max(pair.worst());
            }
        }
        bad
    }

    /// The order of the rows: what is greater is worse, and stands above.
    fn compare(&self, other: &Self) -> Ordering {
        let wrong = (self.pixels, self.cases).cmp(&(other.pixels, other.cases));
        wrong.then(self.closest.total_cmp(&other.closest)).then(self.doubts.cmp(&other.doubts))
    }
}

/// What the families of a kind draw.
fn shapes(kind: Kind) -> &'static str {
    match kind {
        Kind::Triangles => "triangles",
        Kind::Lines => "lines",
        Kind::Unsnapped => "triangles off the grid",
    }
}

/// The pairs of an engine and the oracle.
fn judged(family: &FamilyReport) -> impl Iterator<Item = &PairReport> {
    family.pairs.iter().filter(|pair| pair.is_by_oracle())
}

/// Engines with the letters that stand for them.
fn legend<'a>(engines: impl Iterator<Item = &'a str>) -> String {
    let named = ('A'..).zip(engines).map(|(letter, engine)| format!("{letter} {engine}"));
    named.collect::<Vec<_>>().join(", ")
}

/// The families of one kind, in this order.
fn table(families: &[&FamilyReport]) -> Table {
    let first = families[0];
    let shapes = shapes(first.kind);
    // In a terminal the first word has to do.
    let short = shapes.split(' ').next().unwrap_or(shapes);
    let letter = |name: &str| {
        // Engines have letters in the order of their columns, and the oracle has O.
        let known = ('A'..).zip(judged(first)).find(|(_, pair)| pair.actual == name);
        known.map_or('O', |(letter, _)| letter)
    };
    // Columns of counts, then one for each pair that was compared.
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
    // All first ones, then all second ones, as the rows have them.
    for (what, short, about) in more {
        columns.extend(judged(first).map(|PairReport { actual, .. }| {
            let column = Column::numbers(&format!("{what} of {actual}"), about).least(6);
            column.short(format!("{short} {}", letter(actual)))
        }));
    }
    // The heads are short, so a legend says what they mean.
    let caption = format!("Wrong pixels: {shapes}, by family and pair, worst first");
    // The last two columns are of values, or of decisions where corners are not snapped.
    let what = match first.kind {
        Kind::Unsnapped => "decided: sides of edges; exact: those in exact arithmetic",
        _ => "val, dep: worst value and depth as a fraction of its bound",
    };
    // The letters of the engines, and what the colons mean.
    let engines = legend(judged(first).map(|pair| pair.actual.as_str()));
    let legend = format!("{engines}, O oracle; A:O wrong pixels of A against O; {what}");
    Table { caption, columns, rows: rows(families), legend, ..Table::default() }
}

/// A row with the counts of a family, a cell for each pair, and two more for each engine.
fn row(f: &FamilyReport) -> Row {
    let mut cells = vec![f.family.clone()];
    for count in [f.cases, f.shapes, f.pixels] {
        cells.push(count.to_string());
    }
    // Rounded to the nearest.
    let percent = (100 * f.tie_cases + f.cases / 2).checked_div(f.cases).unwrap_or(0);
    cells.push(format!("{percent}%"));
    let (mut firsts, mut seconds) = (Vec::new(), Vec::new());
    let (mut is_right, mut wrong_pixels) = (f.oracle_faults == 0, 0);
    for p in &f.pairs {
        cells.push(wrong(p.tally, p.panics));
        is_right &= p.wrong_cases == 0;
        wrong_pixels += p.tally.total();
        if p.is_by_oracle() {
            let [first, second] = two_more(f.kind, p);
            firsts.push(first);
            seconds.push(second);
        }
    }
    cells.extend(firsts);
    cells.extend(seconds);
    let search = Some(f.family.clone());
    Row { search, wrong: wrong_pixels, ..Row::from(cells).marked(is_right) }
}

/// The worst value and depth of an engine, or its decisions and those in doubt.
fn two_more(kind: Kind, pair: &PairReport) -> [String; 2] {
    let Decisions { by_filter, by_fallback } = pair.decisions;
    match kind {
        Kind::Unsnapped => [(by_filter + by_fallback).to_string(), by_fallback.to_string()],
        _ if pair.values == 0 => ["-".to_owned(), "-".to_owned()],
        _ => [pair.worst_attribute, pair.worst_depth].map(|worst| match worst {
            w if w < 100.0 => format!("{w:.2}"),
            w => format!("{w:.0e}"),
        }),
    }
}

/// Wrong pixels, and where an engine panicked how often it did.
fn wrong(tally: Tally, panics: u64) -> String {
    match panics {
        0 => tally.total().to_string(),
        n => format!("{}, {n} panics", tally.total()),
    }
}

/// A row for each family, and where there are several one for all of them together.
fn rows(families: &[&FamilyReport]) -> Vec<Row> {
    let mut rows: Vec<Row> = families.iter().map(|family| row(family)).collect();
    if let [first, others @ ..] = families
        && !others.is_empty()
    {
        // The sum is a row like the others, but for its name and its mark.
        let mut all = FamilyReport::clone(first);
        for family in others {
            all += FamilyReport::clone(family);
        }
        let Row { mut cells, .. } = row(&all);
        cells[0] = "all".to_owned();
        rows.push(Row { cells, mark: Mark::Sum, ..Row::default() });
    }
    rows
}

/// How many shapes were judged, in words.
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
    // Wrong pixels are named first; without any, what else is wrong.
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
    let mut rows = Vec::new();
    for named in named::named() {
        let Input::Refused(triangles) = named.input else { continue };
        // Each reason once, whichever corners it is of.
        let mut reasons = BTreeSet::new();
        for &[x, y] in triangles.iter().flatten() {
            reasons.extend(SubpixelPoint::from_px(x, y).err().map(|refusal| refusal.to_string()));
        }
        let reasons = reasons.into_iter().collect::<Vec<_>>().join("; ");
        rows.push(Row::of(&[&named.name, &named.about, &reasons]));
    }
    let columns = "case 6 | input | answer";
    Table::new("Inputs that are refused, with the reason given", columns, rows)
}

/// The quotas in a sentence; nothing where no triangles were judged.
fn quotas(verdict: &Verdict) -> Option<String> {
    let parts =
        verdict.quotas().map(|(what, is, wanted)| format!("{what} {is}% (quota {wanted}%)"));
    // Quotas are of triangles, and a run of lines alone has none.
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
            // Each pair of engines is wrong by itself, and says in how many cases.
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
    // An engine that draws a pixel should have a value there, and none elsewhere.
    if pair.fragments.total() > 0 {
        let what = pair.fragments.describe();
        let _ = write!(out, "; its fragments against its own coverage: {what}");
    }
    out
}
