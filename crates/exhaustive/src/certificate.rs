//! What a run has shown, as a file: the claim, the counts, the code it is about, how to repeat it.
//!
//! Everything but `timing` depends on the plan and the code alone. The code is named by hashes of
//! the files the result depends on, so that a certificate can be checked without a repository. The
//! parts of a sharded run join into the certificate that a whole run would have issued.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::identity::{Identity, Shard};
use super::run::Progress;
use super::{Source, Tally};

/// The layout of the file.
pub const FORMAT: &str = "rasterproof-certificate/1";

/// How many cases there are; none of it is counted by enumerating.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// Cases of the whole enumeration.
    pub cases: u64,
    /// Cases that the oracle's own code judges too.
    pub oracle_checks: u64,
}

/// How long it took: the one part that differs from run to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// Time of all sittings and all shards together.
    pub seconds: f64,
    /// Threads of the run; of shards, the most that one had.
    pub threads: usize,
}

/// The certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`FORMAT`].
    pub format: String,
    /// What agrees with what, for which cases.
    pub claim: String,
    /// Whether the claim holds: all cases done, none wrong. False for a shard of several.
    pub proved: bool,
    /// What was run, by which code.
    pub identity: Identity,
    /// Which part of it; part 0 of 1 is all of it.
    pub shard: Shard,
    /// Counts of the whole enumeration.
    pub expected: Expected,
    /// Counts of this part, and what was wrong.
    pub done: Tally,
    /// The command that repeats it.
    pub repeat: String,
    /// How long it took.
    pub timing: Timing,
}

impl Certificate {
    /// The certificate of a run that has come to its end.
    #[must_use]
    pub fn new(progress: Progress, threads: usize) -> Self {
        let Progress { identity, shard, tally, seconds, .. } = progress;
        let enumeration = identity.plan.enumeration();
        let expected = Expected {
            cases: enumeration.expected_cases(),
            oracle_checks: enumeration.expected_oracle_checks(),
        };
        let part = match shard {
            Shard::WHOLE => String::new(),
            Shard { part, parts } => format!(" --shard {part}/{parts}"),
        };
        let mut certificate = Self {
            format: FORMAT.to_owned(),
            claim: enumeration.claim(),
            proved: false,
            repeat: format!("rasterproof exhaust {}{part}", enumeration.words()),
            identity,
            shard,
            expected,
            done: tally,
            timing: Timing { seconds: (seconds * 1000.0).round() / 1000.0, threads },
        };
        certificate.proved = shard == Shard::WHOLE && certificate.is_complete();
        certificate.proved &= certificate.agrees();
        certificate
    }

    /// Whether nothing is wrong with what was done.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.done.mismatches == 0
    }

    /// Whether every case of the whole was judged.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.done.cases == self.expected.cases
            && self.done.oracle_checks == self.expected.oracle_checks
    }

    /// The file. Inlined, as reading is: compiled where it is called, which need not be for speed.
    #[must_use]
    #[inline]
    pub fn to_json(&self) -> String {
        // Strings, numbers and maps with string keys: this cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Reads a file back.
    ///
    /// # Errors
    /// In words, if it is not a certificate, or not one that its own plan could have issued.
    #[inline]
    pub fn from_json(text: &str) -> Result<Self, String> {
        let certificate: Self =
            serde_json::from_str(text).map_err(|error| format!("is not a certificate: {error}"))?;
        if certificate.format != FORMAT {
            return Err(format!("has format {:?}, expected {FORMAT:?}", certificate.format));
        }
        certificate.identity.plan.check()?;
        let enumeration = certificate.identity.plan.enumeration();
        let Shard { part, parts } = certificate.shard;
        let cases = enumeration.expected_cases();
        if part >= parts || certificate.expected.cases != cases {
            return Err("contradicts itself: its counts do not belong to its plan".to_owned());
        }
        Ok(certificate)
    }
}

/// Joins the certificates of all shards of one run into that of the whole.
///
/// # Errors
/// In words, if they do not belong together, one is missing or given twice, or cases are missing
/// from the sum.
pub fn merge(shards: &[(String, Certificate)]) -> Result<Certificate, String> {
    let Some((first_name, first)) = shards.first() else {
        return Err("no certificates to merge".to_owned());
    };
    let parts = first.shard.parts;
    let mut owner: BTreeMap<u64, &str> = BTreeMap::new();
    let mut tally = Tally::default();
    let mut timing = Timing::default();
    for (name, certificate) in shards {
        if let Some(difference) = difference(first, certificate) {
            return Err(format!("{name} and {first_name} differ in {difference}"));
        }
        if let Some(other) = owner.insert(certificate.shard.part, name) {
            let part = certificate.shard.part;
            return Err(format!("{name} and {other} are both shard {part} of {parts}"));
        }
        tally.add(certificate.done.clone());
        timing.seconds += certificate.timing.seconds;
        timing.threads = timing.threads.max(certificate.timing.threads);
    }
    let missing: Vec<_> =
        (0..parts).filter(|part| !owner.contains_key(part)).map(|part| part.to_string()).collect();
    if !missing.is_empty() {
        return Err(format!("of {parts} shards these are missing: {}", missing.join(", ")));
    }
    let identity = first.identity.clone();
    let progress = Progress {
        identity,
        shard: Shard::WHOLE,
        done: Vec::new(),
        tally,
        seconds: timing.seconds,
    };
    let merged = Certificate::new(progress, timing.threads);
    // Wrong shards may lack the cases of a chunk that panicked; right ones may not lack any.
    if merged.agrees() && !merged.is_complete() {
        let (done, expected) = (merged.done.cases, merged.expected.cases);
        return Err(format!("the shards hold {done} cases together, expected {expected}"));
    }
    Ok(merged)
}

/// In what two shards differ that belong to different runs.
fn difference(a: &Certificate, b: &Certificate) -> Option<&'static str> {
    let (x, y) = (&a.identity, &b.identity);
    [
        (x.plan != y.plan, "what they enumerate"),
        (x.version != y.version, "the version of the program"),
        (x.sources != y.sources, "the code that was run"),
        (a.shard.parts != b.shard.parts, "the number of shards"),
    ]
    .into_iter()
    .find_map(|(differs, what)| differs.then_some(what))
}

/// A source file without lines that are only comment and without its tests, which cannot change a
/// result: `sed '/^#\[cfg(test)\]/,$d; /^ *\/\//d' FILE | sha256sum` gives the same hash.
fn code_only(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .take_while(|line| !line.starts_with("#[cfg(test)]"))
        .filter(|line| !line.trim_start_matches(' ').starts_with("//"))
}

/// The code of a source: of the whole file, or of its items in the order of their list, each from
/// the line that begins with it, without attributes, to the brace or semicolon that ends it.
///
/// # Errors
/// The name of an item that the file does not have.
pub fn code_of(source: &Source) -> Result<String, &'static str> {
    let lines: Vec<_> = code_only(source.text).collect();
    if source.items.is_empty() {
        return Ok(lines.iter().flat_map(|line| [line, "\n"]).collect());
    }
    let mut code = String::new();
    for item in source.items {
        let start = lines.iter().position(|line| begins(line, item)).ok_or(*item)?;
        // Not indented: nothing inside an item ends here.
        let is_last = |line: &&str| !line.starts_with(' ') && line.ends_with(['}', ';']);
        let length = lines[start..].iter().position(is_last).ok_or(*item)? + 1;
        for line in &lines[start..start + length] {
            code.push_str(line);
            code.push('\n');
        }
    }
    Ok(code)
}

/// Whether a line begins an item: its name is not the beginning of a longer one.
fn begins(line: &str, item: &str) -> bool {
    let line = line.strip_prefix("pub(crate) ").unwrap_or(line);
    let Some(rest) = line.strip_prefix("pub ").unwrap_or(line).strip_prefix(item) else {
        return false;
    };
    let in_word = |c: char| c.is_alphanumeric() || c == '_';
    !(item.ends_with(in_word) && rest.starts_with(in_word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_by_hand() {
        let text = "//! File.\nuse x;\nconst AB: u8 = 2;\nconst A: u8 = 1;\n/// Doc.\n#[inline]\npub(crate) fn f(\n    a: u8,\n) -> u8 {\n    // Why.\n    a;\n    a\n}\n\npub fn g() {}\n\n#[cfg(test)]\nmod tests {\n}\n";
        let code = |items| code_of(&Source { path: "x.rs", text, items });
        let f = "pub(crate) fn f(\n    a: u8,\n) -> u8 {\n    a;\n    a\n}\n";
        assert_eq!(code(&["const A"]).unwrap(), "const A: u8 = 1;\n");
        assert_eq!(code(&["fn f", "const AB"]).unwrap(), format!("{f}const AB: u8 = 2;\n"));
        assert_eq!(code(&["fn g"]).unwrap(), "pub fn g() {}\n");
        assert_eq!(code(&["fn f", "fn fg"]), Err("fn fg"));
        assert_eq!(code(&["mod tests"]), Err("mod tests"));
        let whole = code(&[]).unwrap();
        assert!(whole.starts_with("use x;\n") && whole.ends_with("fn g() {}\n\n"), "{whole}");
    }
}
