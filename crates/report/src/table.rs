//! The differential table: a line for each family, a column for each pair.

use std::fmt::Write as _;

use rasterproof_verify::comparison::{FamilyReport, PairReport, Verdict};

/// The whole table with its legend and its sums; at most 100 columns wide for two engines.
pub fn table(verdict: &Verdict) -> String {
    let mut out = String::new();
    for lines in [false, true] {
        let families: Vec<_> = verdict.families.iter().filter(|f| f.lines == lines).collect();
        if let Some(first) = families.first() {
            section(&mut out, &families, first, lines);
        }
    }
    out
}

fn section(out: &mut String, families: &[&FamilyReport], first: &FamilyReport, lines: bool) {
    let shapes = if lines { "lines" } else { "triangles" };
    let judged: Vec<_> = first.pairs.iter().filter(|p| p.target == "oracle").collect();
    let letter = |name: &str| {
        let at = judged.iter().position(|p| p.actual == name);
        at.map_or('O', |i| char::from(b'A' + i as u8))
    };
    let legend: Vec<_> =
        judged.iter().map(|p| format!("{} {}", letter(&p.actual), p.actual)).collect();
    let _ = writeln!(
        out,
        "{shapes}: {}, O oracle\n(A:O wrong pixels of A against O; val, dep: worst value and depth as a fraction of its bound)",
        legend.join(", ")
    );
    let _ =
        write!(out, "{:<15} {:>6} {:>9} {:>9} {:>4}", "family", "cases", shapes, "pixels", "ties");
    for pair in &first.pairs {
        let _ = write!(out, " {:>6}", format!("{}:{}", letter(&pair.actual), letter(&pair.target)));
    }
    for what in ["val", "dep"] {
        for pair in &judged {
            let _ = write!(out, " {:>6}", format!("{what} {}", letter(&pair.actual)));
        }
    }
    out.push('\n');
    for family in families {
        row(out, family);
    }
    if families.len() > 1 {
        row(out, &sum(families));
    }
    out.push('\n');
}

fn row(out: &mut String, f: &FamilyReport) {
    let _ = write!(
        out,
        "{:<15} {:>6} {:>9} {:>9} {:>3}%",
        f.family,
        f.cases,
        f.shapes,
        f.pixels,
        percent(f.tie_cases, f.cases)
    );
    for pair in &f.pairs {
        let cell =
            if pair.panics > 0 { "panic".to_owned() } else { pair.tally.total().to_string() };
        let _ = write!(out, " {cell:>6}");
    }
    let judged = || f.pairs.iter().filter(|p| p.target == "oracle");
    let ratio = |out: &mut String, values: u64, worst: f64| {
        let cell = match (values, worst) {
            (0, _) => "-".to_owned(),
            (_, w) if w < 100.0 => format!("{w:.2}"),
            (_, w) => format!("{w:.0e}"),
        };
        let _ = write!(out, " {cell:>6}");
    };
    judged().for_each(|p| ratio(out, p.values, p.worst_attribute));
    judged().for_each(|p| ratio(out, p.values, p.worst_depth));
    out.push('\n');
}

/// The numbers of all families together, called "all".
pub(super) fn sum(families: &[&FamilyReport]) -> FamilyReport {
    let mut total = families[0].clone();
    total.family = "all".to_owned();
    for f in &families[1..] {
        total.cases += f.cases;
        total.shapes += f.shapes;
        total.pixels += f.pixels;
        total.tie_cases += f.tie_cases;
        for (a, b) in total.pairs.iter_mut().zip(&f.pairs) {
            a.tally += b.tally;
            a.worst_attribute = a.worst_attribute.max(b.worst_attribute);
            a.worst_depth = a.worst_depth.max(b.worst_depth);
            a.values += b.values;
            a.panics += b.panics;
        }
    }
    total
}

fn percent(part: u64, whole: u64) -> u64 {
    (100 * part + whole / 2).checked_div(whole).unwrap_or(0)
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
            let _ = writeln!(
                out,
                "{}: {} against {}: wrong in {} of {} cases{}",
                f.family,
                pair.actual,
                pair.target,
                pair.wrong_cases,
                f.cases,
                kinds(pair)
            );
        }
        if f.oracle_overlap > 0 {
            let _ = writeln!(
                out,
                "{}: the oracle hits {} pixels of disjoint shapes twice",
                f.family, f.oracle_overlap
            );
        }
    }
    out
}

/// What is wrong with a pair, each comparison named, after a colon.
fn kinds(pair: &PairReport) -> String {
    let mut parts = Vec::new();
    if pair.tally.total() > 0 {
        parts.push(format!(": {}", pair.tally.describe()));
    }
    if pair.panics > 0 {
        parts.push(format!(": {} panics", pair.panics));
    }
    for (what, worst) in [("attribute", pair.worst_attribute), ("depth", pair.worst_depth)] {
        if worst > 1.0 {
            parts.push(format!("\n    worst {what} {worst:.3e} times its bound"));
        }
    }
    if pair.fragments.total() > 0 {
        let what = pair.fragments.describe();
        parts.push(format!("\n    its fragments against its own coverage: {what}"));
    }
    parts.concat()
}
