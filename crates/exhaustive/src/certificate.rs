//! What a run has shown, as a file: the claim, the counts, the code it is about, how to repeat it.
//!
//! Everything but `timing` depends on the plan and the code alone. The code is named by hashes of
//! the files the result depends on, so that a certificate can be checked without a repository. The
//! parts of a sharded run join into the certificate that a whole run would have issued.
//!
//! A file can be forged: nothing in it is signed. [`Certificate::check`] shows that it is consistent
//! with its plan and of this program, and [`judge_again`] repeats a part of the work.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::counts::Counts;
use super::identity::{Identity, Shard};
use super::run::{self, Progress, check_seconds};
use super::{Example, Plan, Source, Tally};

pub const FORMAT: &str = "rasterproof-certificate/1";

/// How many cases there are; none of it is counted by enumerating.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    pub cases: u64,
    /// Cases that the oracle's own code judges too.
    pub oracle_checks: u64,
}

/// How long it took: the one part that differs from run to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    pub seconds: f64,
    /// Threads of the run; of shards, the most that one had.
    pub threads: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    pub format: String,
    pub claim: String,
    /// Whether the claim holds: all cases done, none wrong. False for a shard of several.
    pub proved: bool,
    pub identity: Identity,
    /// Which part of it; part 0 of 1 is all of it.
    pub shard: Shard,
    pub expected: Expected,
    pub done: Tally,
    pub repeat: String,
    pub timing: Timing,
}

impl Certificate {
    /// The certificate of a run that has come to its end.
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

    #[must_use]
    pub fn agrees(&self) -> bool {
        self.done.mismatches == 0
    }

    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.done.cases == self.expected.cases
            && self.done.oracle_checks == self.expected.oracle_checks
    }

    /// The file. Inlined, as reading is: compiled where it is called, which need not be for speed.
    #[inline]
    pub fn to_json(&self) -> String {
        // Strings, numbers and maps with string keys: this cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Reads a file back. Whether this program could have issued it is for [`check`](Self::check).
    ///
    /// # Errors
    /// In words, if it is not a certificate, or one of a plan or a shard that cannot be.
    #[inline]
    pub fn from_json(text: &str) -> Result<Self, String> {
        let certificate: Self =
            serde_json::from_str(text).map_err(|error| format!("is not a certificate: {error}"))?;
        if certificate.format != FORMAT {
            return Err(format!("has format {:?}, expected {FORMAT:?}", certificate.format));
        }
        let plan = certificate.identity.plan.check();
        plan.map_err(|error| format!("is about what cannot be enumerated: {error}"))?;
        let Shard { part, parts } = certificate.shard;
        if part >= parts {
            return Err(format!("is of shard {part} of {parts}, which does not exist"));
        }
        Ok(certificate)
    }

    /// Checks that this program could have issued it: that all that follows from its plan and its shard
    /// is as this program has it, and that its counts are possible.
    ///
    /// # Errors
    /// In words, the field that differs with both values, and how to issue it anew.
    pub fn check(&self) -> Result<(), String> {
        let plan = &self.identity.plan;
        let progress = Progress { tally: self.done.clone(), ..Progress::new(plan, self.shard) };
        let own = Self::new(progress, self.timing.threads);
        let anew = format!("issue it anew: {} -o FILE", own.repeat);
        self.is_by(&own.identity).map_err(|error| {
            format!("was issued by another program: {error}; merge it with that program, or {anew}")
        })?;
        self.is_as(&own).map_err(|error| format!("is inconsistent: {error}; {anew}"))
    }

    fn is_by(&self, own: &Identity) -> Result<(), String> {
        let Identity { version, sources, .. } = &self.identity;
        same("the version of the program", version, &own.version)?;
        for name in own.sources.keys().chain(sources.keys()) {
            let hash = |of: &BTreeMap<String, String>| of.get(name).cloned().unwrap_or_default();
            // The path; the items that are listed after it would fill the message.
            let path: String =
                name.split(": ").take(1).flat_map(str::escape_debug).take(SHOWN).collect();
            let field = format!("the code that was run ({path})");
            same(&field, &hash(sources), &hash(&own.sources))?;
        }
        Ok(())
    }

    /// Checks that all that follows from the plan and the counts is as in `own`, and the counts.
    fn is_as(&self, own: &Self) -> Result<(), String> {
        let expected = |of: &Self| {
            let Expected { cases, oracle_checks } = of.expected;
            format!("{cases} cases and {oracle_checks} oracle_checks")
        };
        same("claim", &self.claim, &own.claim)?;
        same("repeat", &self.repeat, &own.repeat)?;
        same("expected", &expected(self), &expected(own))?;
        let plan = &self.identity.plan;
        self.done.check(plan, self.shard.chunks(plan))?;
        check_seconds(self.timing.seconds)?;
        same("proved", &self.proved.to_string(), &own.proved.to_string())
    }
}

/// Characters of a text of the file that a message shows.
const SHOWN: usize = 60;

/// Checks that a field of the file says what this program would say.
fn same(field: &str, stated: &str, expected: &str) -> Result<(), String> {
    if stated == expected {
        return Ok(());
    }
    // Of long texts the part where they begin to differ, with some of what is before it.
    let common = stated.chars().zip(expected.chars()).take_while(|(a, b)| a == b).count();
    let longest = stated.chars().count().max(expected.chars().count());
    let from = if longest > SHOWN { common.saturating_sub(SHOWN / 3) } else { 0 };
    let shown = |text: &str| {
        let part: String = text.chars().skip(from).take(SHOWN).collect();
        let [before, after] =
            [from > 0, text.chars().count() > from + SHOWN].map(|cut| if cut { "..." } else { "" });
        // Quoted with escapes: the text of a file does not end a line of the message.
        format!("{before}{part:?}{after}")
    };
    Err(format!("in {field} it says {}, this program {}", shown(stated), shown(expected)))
}

/// Joins the certificates of all shards of one run into that of the whole. A shard that holds no case
/// may be missing.
///
/// # Errors
/// In words, if one is [not of this program](Certificate::check), they do not belong together, or one
/// is missing or given twice.
pub fn merge(shards: &[(String, Certificate)]) -> Result<Certificate, String> {
    let Some((first_name, first)) = shards.first() else {
        return Err("no certificates to merge".to_owned());
    };
    let (plan, parts) = (&first.identity.plan, first.shard.parts);
    let mut owner: BTreeMap<u64, &str> = BTreeMap::new();
    let mut tally = Tally::default();
    let mut timing = Timing::default();
    for (name, certificate) in shards {
        if let Some(difference) = difference(first, certificate) {
            return Err(format!("{name} and {first_name} differ in {difference}"));
        }
        certificate.check().map_err(|error| format!("{name} {error}"))?;
        if let Some(other) = owner.insert(certificate.shard.part, name) {
            let part = certificate.shard.part;
            return Err(format!("{name} and {other} are both shard {part} of {parts}"));
        }
        let added = tally.add(certificate.done.clone());
        added.map_err(|error| format!("{name} does not fit the others: {error}"))?;
        timing.seconds += certificate.timing.seconds;
        timing.threads = timing.threads.max(certificate.timing.threads);
    }
    // A shard beyond the last chunk holds nothing, so `parts` may be any number.
    let shard = |part| Shard { part, parts };
    let missing: Vec<_> = (0..parts.min(plan.enumeration().chunks()))
        .filter(|part| !owner.contains_key(part))
        .filter(|&part| Counts::of(plan, shard(part).chunks(plan)).cases > 0)
        .collect();
    if let [part, ..] = missing[..] {
        let words = plan.enumeration().words();
        return Err(format!(
            "of {parts} shards these are missing: {}; name their files too, or make them, for example: \
             rasterproof exhaust {words} --shard {part}/{parts} -o FILE",
            ranges_of(&missing)
        ));
    }
    let (identity, seconds) = (first.identity.clone(), timing.seconds);
    let progress = Progress { identity, shard: Shard::WHOLE, done: Vec::new(), tally, seconds };
    Ok(Certificate::new(progress, timing.threads))
}

const LISTED_RANGES: usize = 4;

/// Ascending numbers in a few words, such as `1, 3 to 5 and 200 more`.
fn ranges_of(numbers: &[u64]) -> String {
    let ranges: Vec<_> = numbers.chunk_by(|a, b| a + 1 == *b).collect();
    let listed = &ranges[..ranges.len().min(LISTED_RANGES)];
    let in_words = |range: &&[u64]| match range {
        [only] => only.to_string(),
        [first, .., last] => format!("{first} to {last}"),
        [] => String::new(),
    };
    let mut text = listed.iter().map(in_words).collect::<Vec<_>>().join(", ");
    let rest = numbers.len() - listed.iter().map(|range| range.len()).sum::<usize>();
    if rest > 0 {
        text += &format!(" and {rest} more");
    }
    text
}

fn difference(a: &Certificate, b: &Certificate) -> Option<&'static str> {
    if a.identity.plan != b.identity.plan {
        return Some("what they enumerate");
    }
    (a.shard.parts != b.shard.parts).then_some("the number of shards")
}

/// Judges `count` chunks again, and compares what is found with what the certificate of a whole run
/// says: no more mismatches, and the listed examples of these chunks. The seed decides which of the
/// chunks that hold cases are judged. Returns how many chunks and cases that were. After each chunk
/// `step` gets the cases judged.
///
/// # Errors
/// In words, what the certificate says otherwise.
pub fn judge_again(
    certificate: &Certificate,
    count: u64,
    seed: u64,
    step: &(dyn Fn(u64) + Sync),
) -> Result<(usize, u64), String> {
    let plan = &certificate.identity.plan;
    let chosen = chosen(plan, count, seed);
    let found = run::judge_again(plan, &chosen, step);
    let stated = &certificate.done;
    let is_chosen = |chunk: u64| chosen.binary_search(&chunk).is_ok();
    let listed = stated.examples.iter().filter(|example| is_chosen(example.chunk));
    let are_all_listed = stated.examples.len() as u64 == stated.mismatches;
    // What the certificate does not list comes after all that it lists.
    let is_possible = |example: &&Example| {
        stated.examples.contains(example)
            || !are_all_listed && Some(*example) > stated.examples.last()
    };
    let fault = if let Some(example) = found.examples.iter().find(|example| !is_possible(example)) {
        let Example { chunk, what, .. } = example;
        Some(format!("chunk {chunk} holds a wrong case that the file does not list: {what}"))
    } else if let Some(example) = { listed }.find(|example| !found.examples.contains(example)) {
        let Example { chunk, what, .. } = example;
        Some(format!("chunk {chunk} does not hold this wrong case: {what:?}"))
    } else if found.mismatches > stated.mismatches {
        Some(format!("{} mismatches are found in these chunks alone", found.mismatches))
    } else {
        found.check(plan, chosen.iter().copied()).err()
    };
    fault.map_or(Ok((chosen.len(), found.cases)), |fault| {
        let stated = stated.mismatches;
        Err(format!("it says {stated} mismatches, but when its chunks are judged again, {fault}"))
    })
}

/// So many of the chunks that hold cases, in ascending order: those whose hashes with the seed are the
/// smallest.
fn chosen(plan: &Plan, count: u64, seed: u64) -> Vec<u64> {
    let chunks = 0..plan.enumeration().chunks();
    let mut chunks: Vec<u64> =
        chunks.filter(|&c| Counts::of(plan, [c].into_iter()).cases > 0).collect();
    chunks.sort_by_cached_key(|chunk| {
        Sha256::digest([seed.to_le_bytes(), chunk.to_le_bytes()].concat())
    });
    chunks.truncate(usize::try_from(count).unwrap_or(usize::MAX));
    chunks.sort_unstable();
    chunks
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
    fn ranges_in_words() {
        assert_eq!(ranges_of(&[3]), "3");
        assert_eq!(ranges_of(&[0, 1, 2, 5, 7, 8]), "0 to 2, 5, 7 to 8");
        let even: Vec<_> = (0..1000).map(|half| 2 * half).collect();
        assert_eq!(ranges_of(&even), "0, 2, 4, 6 and 996 more");
    }

    /// Each seed names its chunks, none of them empty.
    #[test]
    fn chunks_are_chosen_by_the_seed() {
        let lines = |reach| {
            let offset_px = [0, 0];
            Plan::Lines(crate::lines::Lines { reach, offset_px, first_octant: false, plant: None })
        };
        let seven = chosen(&lines(50), 7, 1);
        assert_eq!(seven, chosen(&lines(50), 7, 1));
        assert_ne!(seven, chosen(&lines(50), 7, 2));
        assert!(seven.len() == 7 && seven.is_sorted_by(|a, b| a < b) && seven[6] <= 100);
        assert_eq!(chosen(&lines(50), u64::MAX, 1), (0..=100).collect::<Vec<_>>());
        let offset_px = [0, 0];
        let (window_px, subpixel_bits, all_orders, plant) = (1, 0, false, None);
        let four =
            crate::triangles::Triangles { window_px, subpixel_bits, offset_px, all_orders, plant };
        // The last two points begin no triangle.
        assert_eq!(chosen(&Plan::Triangles(four), 99, 1), [0, 1]);
    }

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
