//! Known failures: what already failed, by case and by what was wrong with it.
//!
//! A file of lines `property family#number fingerprint`, sorted, after a header; one to read and to
//! keep beside the program. A property whose failures are all known, each with its fingerprint, is an
//! expected failure. A failure that is not known, or is wrong in another way, is a new one; a known
//! one that was judged and holds is stale, an unexpected pass.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;
use std::path::Path;

use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::run::{Failing, RunFindings};
use super::verdict::{Outcome, Verdict};

/// The first line of a file. The seed is in it because another seed has other cases under the same names.
const HEADER: &str = "# rasterproof baseline 1, seed ";

/// Known failures: a fingerprint for each `property family#number`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Baseline {
    seed: u64,
    known: BTreeMap<String, u64>,
}

/// A known failure and its fingerprint, of a line `property family#number hex`.
fn entry(line: &str) -> Option<(String, u64)> {
    let (case, print) = line.rsplit_once(' ')?;
    let (_, number) = case.split_once(' ')?;
    let print = u64::from_str_radix(print, 16).ok()?;
    number.contains('#').then(|| (case.to_owned(), print))
}

impl Baseline {
    /// Reads a file; none at all is an empty baseline.
    ///
    /// # Errors
    /// It cannot be read, is none, or is of another seed: with its name, line and remedy.
    pub fn read(path: &Path, seed: u64) -> Result<Self, String> {
        let text = match input::read_text(path, limits::DOCUMENT_BYTES) {
            Err(error) if error.missing => return Ok(Self { seed, known: BTreeMap::new() }),
            read => read.map_err(|error| error.to_string())?,
        };
        Self::parse(&text, seed)
            .map_err(|what| format!("{}: {}", printable_path(path), printable(&what)))
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// The line that cannot be read, or another seed.
    pub fn parse(text: &str, seed: u64) -> Result<Self, String> {
        let mut lines = text.lines().zip(1..);
        // The header says of which seed the numbers of the cases are.
        let of = lines.next().and_then(|(line, _)| line.strip_prefix(HEADER)?.parse::<u64>().ok());
        match of {
            None => {
                return Err(format!(
                    "line 1: expected '{HEADER}N'; delete the file, and write it anew with --update-baseline"
                ));
            }
            Some(of) if of != seed => {
                return Err(format!("it was written for seed {of}: add --seed {of}, or delete it"));
            }
            Some(_) => {}
        }
        // Then a line for each known failure; empty lines are allowed, since people edit such files.
        let mut known = BTreeMap::new();
        for (line, number) in lines.filter(|(line, _)| !line.is_empty()) {
            let (case, print) = entry(line)
                .ok_or_else(|| format!("line {number}: expected 'property family#number hex'"))?;
            known.insert(case, print);
        }
        Ok(Self { seed, known })
    }

    /// The fingerprints of the known failures.
    #[must_use]
    pub fn known(&self) -> &BTreeMap<String, u64> {
        &self.known
    }

    /// Sorts the outcomes of a verdict into known and new.
    pub fn apply(&self, verdict: &mut Verdict) {
        let is_known = |f: &&Failing| self.known.get(&f.name()) == Some(&f.fingerprint);
        verdict.more.known = verdict.more.found.failing.iter().filter(is_known).count() as u64;
        let failing = failing(verdict);
        let judged = judged_cases(&verdict.more.found);
        // Each property is judged by its own cases: new failures, and known ones that do not fail any more.
        for property in &mut verdict.more.properties {
            let of_it = |case: &&String| case.split(' ').next() == Some(property.name);
            let all: Vec<&String> = failing.keys().filter(of_it).collect();
            let new = all.iter().filter(|c| self.known.get(**c) != failing.get(**c)).count();
            let stale = self.known.keys().filter(of_it);
            let stale = stale.filter(|c| judged.contains(*c) && !failing.contains_key(*c)).count();
            // A new failure decides before all, then a stale one.
            property.outcome = match (new, stale, property.outcome) {
                (1.., _, _) => Outcome::Fail,
                (0, 1.., _) => Outcome::UnexpectedPass,
                (0, 0, Outcome::Fail) if !all.is_empty() => Outcome::ExpectedFailure,
                (_, _, outcome) => outcome,
            };
            let known = all.len() - new;
            if known + new + stale > 0 {
                let counts = format!("; of the baseline: {known} known, {new} new, {stale} stale");
                property.detail += &counts;
            }
        }
    }

    /// The text of a new file: what fails now, and what was known of cases that were not judged.
    ///
    /// # Errors
    /// More fails than is worth remembering.
    pub fn updated(&self, verdict: &Verdict) -> Result<String, String> {
        if verdict.more.found.forgot {
            let most = super::run::MOST_REMEMBERED;
            return Err(format!("more than {most} cases fail: ask fewer with --cases"));
        }
        let judged = judged_cases(&verdict.more.found);
        // What was known of cases that were not judged now stays known.
        let mut all: BTreeMap<_, _> =
            self.known.iter().filter(|(case, _)| !judged.contains(*case)).collect();
        let failing = failing(verdict);
        all.extend(&failing);
        let mut out = format!("{HEADER}{}\n", self.seed);
        for (case, print) in all {
            // Writing to a string does not fail.
            let _ = writeln!(out, "{case} {print:016x}");
        }
        Ok(out)
    }
}

/// The cases that were judged, as in the file, where they were remembered.
pub(super) fn judged_cases(found: &RunFindings) -> HashSet<String> {
    found.judged.iter().map(|(p, f, i)| format!("{p} {f}#{i}")).collect()
}

/// The cases that fail, as in the file.
pub(super) fn failing_cases(found: &RunFindings) -> BTreeMap<String, u64> {
    found.failing.iter().map(|f| (f.name(), f.fingerprint)).collect()
}

/// What fails, as in the file. What the whole run shows has one case.
fn failing(verdict: &Verdict) -> BTreeMap<String, u64> {
    let mut all = failing_cases(&verdict.more.found);
    // That the program draws, in which winding, and by the protocol.
    let whole = verdict.more.properties.iter().filter(|p| p.outcome == Outcome::Fail);
    let rows: HashSet<&str> = verdict.families.iter().map(|row| row.name).collect();
    all.extend(whole.filter(|p| !rows.contains(p.name)).map(|p| (format!("{} run#0", p.name), 0)));
    all
}
