//! The verdict for people: a line for each danger, with what came of it and where to read on; at most
//! 60 columns.

use super::table::{Row, Table};
use super::words::{count, noun, of_bound, thousands};
use rasterproof_verify::cases::facts::asked::DesignShare;
use rasterproof_verify::comparison::{Failure, Tally, Verdict};

/// What may go wrong in a rasterizer, with the families of cases that show it.
pub struct Danger {
    /// What is threatened, in a few words.
    pub name: &'static str,
    /// The page of the docs that explains it.
    pub chapter: &'static str,
    /// The families of cases in which it is met.
    pub(super) families: &'static [&'static str],
}

macro_rules! dangers {
    ($($name:literal, $chapter:literal: $($family:literal),+;)+) => {
        &[$(Danger { name: $name, chapter: $chapter, families: &[$($family),+] }),+]
    };
}

/// All of them, in the order of the first screen.
pub const DANGERS: &[Danger] = dangers![
    "corners anywhere", "docs/ch02-edge-functions.md":
        "uniform";
    "ties on edges", "docs/ch02-edge-functions.md":
        "half-integer", "flat", "near-tie";
    "shared edges", "docs/ch02-edge-functions.md":
        "rectangle", "fan", "strip";
    "thin, tiny and flat ones", "docs/ch02-edge-functions.md":
        "sliver", "near-horizontal", "near-vertical", "tiny", "degenerate";
    "window and domain", "docs/ch01.md":
        "partly-off", "off-screen", "huge", "far";
    "perspective", "docs/ch05.md":
        "w-equal", "w-4", "w-100", "w-1e4", "w-1e6", "w-extreme";
    "lines", "docs/ch02.md":
        "line-octants", "line-ties", "line-axis", "line-points", "line-clipped", "line-far";
    "every two facts together", "docs/stability.md":
        "design", "w-design", "line-design";
    "corners not snapped", "docs/offgrid.md":
        "f32-random", "f32-sliver", "f32-near-tie", "f32-tie", "f32-fan", "f32-cut", "f32-tiny",
        "f32-mixed", "f32-denormal", "f32-far", "f32-huge", "f64-near-tie", "f64-huge",
        "f64-denormal";
];

/// How much of all that could be asked was asked by the designs, and what was not; nothing where no design was.
pub fn asked(shares: &[DesignShare]) -> Option<Table> {
    let mut notes = Vec::new();
    for share in shares {
        // How many pairs of facts occurred together in some case, of all that can.
        let [pairs, of_pairs] = [share.pairs, share.of_pairs].map(|n| thousands(n as u64));
        // Some pairs cannot occur, by what a family declares.
        let pairs = match share.pairs == share.of_pairs {
            true => format!("all {pairs}"),
            false => format!("{pairs} of {of_pairs}"),
        };
        // Rounded down, so that 100% means all.
        let percent = 100 * share.triples / share.of_triples.max(1);
        let triples = thousands(share.of_triples as u64);
        notes.push(format!(
            "asked of the family {}: {pairs} pairs and {percent}% of {triples} triples of facts",
            share.family
        ));
        if let Some(first) = share.never.first() {
            let count = share.never.len();
            notes.push(format!(
                "  never, by what it declares: {count} classes of facts, as '{first}'"
            ));
        }
    }
    (!notes.is_empty()).then(|| Table::of_notes("", notes))
}

/// The danger that a family belongs to.
///
/// # Panics
/// For a name that is no family's.
pub fn danger(family: &str) -> &'static Danger {
    DANGERS.iter().find(|d| d.families.contains(&family)).expect("every family is listed")
}

/// The page that explains what failed: a wrong value alone is about values.
pub fn chapter(failure: &Failure) -> &'static str {
    let is_pixel = ["missing", "extra", "twice", "order", "panics"];
    if is_pixel.iter().any(|word| failure.what.contains(word)) {
        danger(failure.family).chapter
    } else if failure.family.starts_with("w-") {
        "docs/ch05.md"
    } else {
        "docs/ch03.md"
    }
}

/// What came of the families of a danger.
#[derive(Default)]
pub(super) struct Sum {
    pub cases: u64,
    /// Of each family, those of the engine that is wrong most often.
    pub wrong_cases: u64,
    pub tally: Tally,
    /// Fragments against the engine's own coverage.
    fragments: Tally,
    /// Cases at which an engine panicked.
    panics: u64,
    /// Pixels at which the oracle contradicts itself.
    oracle: u64,
}

/// The families of a danger together.
fn sum(danger: &Danger, verdict: &Verdict) -> Sum {
    let mut sum = Sum::default();
    for f in verdict.families.iter().filter(|f| danger.families.contains(&f.family.as_str())) {
        sum.cases += f.cases;
        sum.oracle += f.oracle_faults;
        // Engines against each other add nothing that the oracle does not tell.
        for pair in f.pairs.iter().filter(|pair| pair.is_by_oracle()) {
            sum.tally += pair.tally;
            sum.fragments += pair.fragments;
            sum.panics += pair.panics;
        }
        sum.wrong_cases += f.pairs.iter().map(|pair| pair.wrong_cases).max().unwrap_or(0);
    }
    sum
}

impl Sum {
    /// In words: a line, and what there is to say beyond it.
    pub fn describe(&self) -> String {
        let cases = count(self.cases, "case", "cases");
        if self.wrong_cases == 0 && self.oracle == 0 {
            return format!("{cases}, all right");
        }
        let mut parts = vec![format!("wrong in {} of {cases}", thousands(self.wrong_cases))];
        if self.tally.total() > 0 {
            parts.push(format!("pixels: {}", self.tally.describe()));
        }
        if self.fragments.total() > 0 {
            parts.push(format!("fragments: {}", self.fragments.describe()));
        }
        if self.panics > 0 {
            parts.push(format!("{} {}", self.panics, noun(self.panics, "panic", "panics")));
        }
        if self.oracle > 0 {
            let pixels = noun(self.oracle, "pixel", "pixels");
            parts.push(format!("the oracle errs at {} {pixels}", self.oracle));
        }
        parts.join("\n")
    }
}

/// A row for something that was judged; what there is to say beyond a line stands below it.
pub(super) fn row(is_right: bool, name: &str, what: &str) -> Row {
    // The first line stands in the row, the others below it.
    let (first, more) = what.split_once('\n').unwrap_or((what, ""));
    Row::of(&[&name, &first, &more]).marked(is_right)
}

/// Rows that [`row`] made, as a table of the first screen.
pub(super) fn judged(caption: &str, rows: Vec<Row>) -> Table {
    Table::new(caption, "~what 29 | ~found 1 | more", rows).judged()
}

/// A row for each danger that was judged, then one for the values.
pub fn table(verdict: &Verdict) -> Table {
    let mut rows = Vec::new();
    for danger in DANGERS {
        let sum = sum(danger, verdict);
        if sum.cases > 0 {
            let is_right = sum.wrong_cases == 0 && sum.oracle == 0;
            rows.push(row(is_right, danger.name, &sum.describe()));
        }
    }
    // Values are not of one danger: how close the worst of all came to its bound.
    let (mut values, mut worst) = (0, 0.0);
    for pair in verdict.families.iter().flat_map(|f| &f.pairs) {
        values += pair.values;
        worst = pair.worst().max(worst);
    }
    if values > 0 {
        rows.push(row(worst <= 1.0, "values and depths", &of_bound(worst)));
    }
    judged("", rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_verify::cases;

    #[test]
    fn every_family_is_one_danger() {
        let names: Vec<_> = cases::all_families().map(|f| f.name).collect();
        for name in &names {
            let times = DANGERS.iter().filter(|d| d.families.contains(name)).count();
            assert_eq!(times, 1, "{name}");
        }
        let listed = DANGERS.iter().flat_map(|d| d.families).count();
        assert_eq!(listed, names.len());
    }
}
