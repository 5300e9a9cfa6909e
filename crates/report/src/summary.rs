//! The verdict for people: a line for each danger, with what came of it and where to read on; at most
//! 60 columns.

use std::fmt::Write as _;

use rasterproof_verify::comparison::{Failure, Tally, Verdict};

pub struct Danger {
    /// What is threatened, in a few words.
    pub name: &'static str,
    pub chapter: &'static str,
    pub(super) families: &'static [&'static str],
}

macro_rules! dangers {
    ($($name:literal, $chapter:literal: $($family:literal),+;)+) => {
        &[$(Danger { name: $name, chapter: $chapter, families: &[$($family),+] }),+]
    };
}

pub const DANGERS: &[Danger] = dangers![
    "corners anywhere", "docs/ch02.md":
        "uniform";
    "ties on edges", "docs/ch02.md":
        "half-integer", "flat", "near-tie";
    "shared edges", "docs/ch02.md":
        "rectangle", "fan", "strip";
    "thin, tiny and flat ones", "docs/ch02.md":
        "sliver", "near-horizontal", "near-vertical", "tiny", "degenerate";
    "window and domain", "docs/ch01.md":
        "partly-off", "off-screen", "huge", "far";
    "perspective", "docs/ch05.md":
        "w-equal", "w-4", "w-100", "w-1e4", "w-1e6", "w-extreme";
    "lines", "docs/ch02.md":
        "line-octants", "line-ties", "line-axis", "line-points", "line-clipped", "line-far";
    "corners not snapped", "docs/offgrid.md":
        "f32-random", "f32-sliver", "f32-near-tie", "f32-tie", "f32-fan", "f32-cut", "f32-tiny",
        "f32-mixed", "f32-denormal", "f32-far", "f32-huge", "f64-near-tie", "f64-huge",
        "f64-denormal";
];

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
        danger(&failure.family).chapter
    } else if failure.family.starts_with("w-") {
        "docs/ch05.md"
    } else {
        "docs/ch03.md"
    }
}

#[derive(Default)]
pub(super) struct Sum {
    pub cases: u64,
    pub wrong_cases: u64,
    pub tally: Tally,
    fragments: Tally,
    panics: u64,
    oracle: u64,
}

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
    pub fn describe(&self) -> String {
        let cases = thousands(self.cases);
        if self.wrong_cases == 0 && self.oracle == 0 {
            return format!("{cases} cases, all right");
        }
        let mut parts = vec![format!("wrong in {} of {cases} cases", thousands(self.wrong_cases))];
        if self.tally.total() > 0 {
            parts.push(format!("pixels: {}", self.tally.describe()));
        }
        if self.fragments.total() > 0 {
            parts.push(format!("fragments: {}", self.fragments.describe()));
        }
        if self.panics > 0 {
            parts.push(format!("{} panics", self.panics));
        }
        if self.oracle > 0 {
            parts.push(format!("the oracle errs at {} pixels", self.oracle));
        }
        parts.join("\n")
    }
}

/// With commas between groups of three digits.
pub fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join(",")
}

/// A number with what is counted: `1 kind`, `2 kinds`.
pub fn count(number: u64, one: &str, several: &str) -> String {
    format!("{} {}", thousands(number), if number == 1 { one } else { several })
}

pub fn word(agrees: bool) -> &'static str {
    if agrees { "AGREES" } else { "DISAGREES" }
}

/// A tick or a cross, coloured where that can be seen.
pub fn mark(is_right: bool, colour: bool) -> &'static str {
    match (is_right, colour) {
        (true, false) => "✓",
        (true, true) => "\x1b[32m✓\x1b[0m",
        (false, false) => "✗",
        (false, true) => "\x1b[1;31m✗\x1b[0m",
    }
}

/// A line for something that was judged; more lines below it where there is more to say.
pub fn entry(mark: &str, name: &str, what: &str) -> String {
    let mut rows = what.lines();
    let mut out = format!("  {mark} {name:<25} {}\n", rows.next().unwrap_or(""));
    rows.for_each(|row| {
        let _ = writeln!(out, "      {row}");
    });
    out
}

/// A line for each danger that was judged, then one for the values.
pub fn lines(verdict: &Verdict, colour: bool) -> String {
    let mut out = String::new();
    let mut entry = |is_right, name, what: &str| out += &entry(mark(is_right, colour), name, what);
    for danger in DANGERS {
        let sum = sum(danger, verdict);
        if sum.cases > 0 {
            entry(sum.wrong_cases == 0 && sum.oracle == 0, danger.name, &sum.describe());
        }
    }
    let pairs = verdict.families.iter().flat_map(|f| &f.pairs);
    let (values, worst) =
        pairs.fold((0, 0.0), |(n, worst), pair| (n + pair.values, pair.worst().max(worst)));
    if values > 0 {
        entry(worst <= 1.0, "values and depths", &of_bound(worst));
    }
    out
}

/// How near a difference of values came to the bound that is derived for it.
pub fn of_bound(worst: f64) -> String {
    match worst {
        w if w <= 1.0 => format!("at most {:.0}% of the bound", (100.0 * w).ceil()),
        w if w < 1e4 => format!("up to {w:.1} times the bound"),
        w => format!("up to {w:.0e} times the bound"),
    }
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

    #[test]
    fn digits_in_groups() {
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn bounds_in_words() {
        assert_eq!(of_bound(0.034), "at most 4% of the bound");
        assert_eq!(of_bound(1.0), "at most 100% of the bound");
        assert_eq!(of_bound(2.5), "up to 2.5 times the bound");
        assert_eq!(of_bound(f64::INFINITY), "up to inf times the bound");
    }
}
