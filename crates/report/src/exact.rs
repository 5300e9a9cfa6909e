//! The table of the engines off the lattice: wrong pixels and fallbacks for each family.

use std::fmt::Write as _;

use rasterproof_core::contract::Decisions;
use rasterproof_verify::comparison::unsnapped::{ExactFamilyReport, ExactVerdict};

/// The whole table with its legend and its sums; empty where nothing was judged off the lattice.
pub fn table(verdict: &ExactVerdict) -> String {
    let mut out = String::new();
    let Some(first) = verdict.families.first() else { return out };
    let letters = (b'A'..).map(char::from);
    let legend: Vec<_> = first
        .engines
        .iter()
        .zip(letters.clone())
        .map(|(e, l)| format!("{l} {}", e.engine))
        .collect();
    let _ = writeln!(
        out,
        "triangles off the grid: {}, O oracle-exact; wrong pixels;\ndecisions (scanline: edge and \
         row; edge function: edge and sample) and those in exact arithmetic",
        legend.join(", ")
    );
    let _ = write!(
        out,
        "{:<12} {:>6} {:>9} {:>9} {:>5}",
        "family", "cases", "triangles", "pixels", "ties"
    );
    for (_, letter) in first.engines.iter().zip(letters) {
        let [wrong, decided, exact] =
            [format!("{letter}:O"), format!("decided {letter}"), format!("exact {letter}")];
        let _ = write!(out, " {wrong:>5} {decided:>10} {exact:>8}");
    }
    out.push('\n');
    verdict.families.iter().for_each(|family| row(&mut out, family));
    if verdict.families.len() > 1 {
        let mut all = first.clone();
        all.family = "all".to_owned();
        verdict.families[1..].iter().for_each(|family| all += family.clone());
        row(&mut out, &all);
    }
    out.push('\n');
    out
}

fn row(out: &mut String, f: &ExactFamilyReport) {
    let ties = (100 * f.tie_cases + f.cases / 2).checked_div(f.cases).unwrap_or(0);
    let _ = write!(
        out,
        "{:<12} {:>6} {:>9} {:>9} {ties:>4}%",
        f.family, f.cases, f.triangles, f.pixels
    );
    for engine in &f.engines {
        let wrong =
            if engine.panics > 0 { "panic".to_owned() } else { engine.tally.total().to_string() };
        let Decisions { by_filter, by_fallback } = engine.decisions;
        let _ = write!(out, " {wrong:>5} {:>10} {by_fallback:>8}", by_filter + by_fallback);
    }
    out.push('\n');
}

/// A sentence for each engine that disagrees, and for an oracle that does not tile a window.
pub fn disagreements(verdict: &ExactVerdict) -> String {
    let mut out = String::new();
    for f in &verdict.families {
        for e in f.engines.iter().filter(|e| e.wrong_cases > 0) {
            let _ = writeln!(
                out,
                "{}: {} against oracle-exact: wrong in {} of {} cases: {} missing, {} extra, {} \
                 twice, {} panics",
                f.family,
                e.engine,
                e.wrong_cases,
                f.cases,
                e.tally.missing,
                e.tally.extra,
                e.tally.twice,
                e.panics
            );
        }
        if f.oracle_faults > 0 {
            let _ = writeln!(
                out,
                "{}: the oracle does not hit {} pixels of tiled windows exactly once",
                f.family, f.oracle_faults
            );
        }
    }
    out
}
