//! Proof by exhaustion: every triangle of a small window, every line of a small reach, every edge
//! of the window at full precision; and the certificate of such a run.
//!
//! An [`Enumeration`] is a finite set of cases in numbered chunks. What a chunk finds depends on
//! its number alone, so neither threads nor interruptions nor shards can change the result:
//! [`run`] works off chunks and can resume, [`certificate`] says what was done and joins shards.
//!
//! It samples nothing and shrinks nothing: that is `verify`. Nothing is left out because it is
//! expected to behave like something else, except where an enumeration says so and why.

pub mod certificate;
pub mod counts;
pub mod edges;
pub mod identity;
pub mod lines;
pub mod run;
pub mod triangles;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use rasterproof_core::grid::{DOMAIN_PX, SUBPIXEL_BITS};
use rasterproof_faults::planted::{LineMutant, TriangleMutant};

/// The widest window whose samples fit a 16-bit mask, in pixels.
pub const MAX_WINDOW_PX: u32 = 4;
/// Wrong cases that are described; all are counted.
pub const EXAMPLES: usize = 5;

/// A finite set of cases, in chunks that do not depend on each other.
pub trait Enumeration: Sync {
    /// One sentence: what agrees with what, for which cases.
    fn claim(&self) -> String;
    fn chunks(&self) -> u64;
    /// How many cases all chunks hold together, in closed form and not by enumerating.
    fn expected_cases(&self) -> u64;
    /// How many cases are judged by the oracle's own code too.
    fn expected_oracle_checks(&self) -> u64;
    /// Prepares what all chunks need, and returns what judges every case of a chunk.
    fn judge(&self) -> Box<dyn Fn(u64) -> Tally + Sync + Send + '_>;
    /// The words after `rasterproof exhaust` that ask for this enumeration.
    fn words(&self) -> String;
    /// The code that the result depends on. Not what only declares types (`triangle`, `contract`),
    /// nor what counts chunks: the counts of cases check that.
    fn sources(&self) -> Vec<Source>;
}

#[derive(Clone, Copy, Debug)]
pub struct Source {
    pub path: &'static str,
    pub text: &'static str,
    /// What the lines begin with that begin the items, without visibility; none means the file.
    pub items: &'static [&'static str],
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tally {
    pub cases: u64,
    /// Comparisons made: what is compared is said by the claim.
    pub comparisons: u64,
    /// Cases in which the fast form of the oracle was compared with the oracle's own code.
    pub oracle_checks: u64,
    pub mismatches: u64,
    /// The first wrong cases, in the order of the enumeration.
    pub examples: Vec<Example>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Example {
    pub chunk: u64,
    /// What was wrong about it, counted within the chunk.
    pub number: u64,
    pub what: String,
}

impl Tally {
    /// Adds what another chunk or shard found; in any order the sum is the same.
    ///
    /// # Errors
    /// The count that does not fit its 64 bits, which only a file can hold that was changed.
    pub fn add(&mut self, other: Self) -> Result<(), String> {
        for (field, sum, more) in [
            ("cases", &mut self.cases, other.cases),
            ("comparisons", &mut self.comparisons, other.comparisons),
            ("oracle_checks", &mut self.oracle_checks, other.oracle_checks),
            ("mismatches", &mut self.mismatches, other.mismatches),
        ] {
            let added = sum.checked_add(more);
            *sum =
                added.ok_or_else(|| format!("{field}: {sum} and {more} are more than 2^64 - 1"))?;
        }
        self.examples.extend(other.examples);
        // Each summand holds its first ones, so the first of the sum are among them.
        self.examples.sort();
        self.examples.truncate(EXAMPLES);
        Ok(())
    }

    /// Counts a failed comparison, and describes it if it is one of the first.
    #[cold]
    pub fn wrong(&mut self, chunk: u64, what: impl FnOnce() -> String) {
        if self.examples.len() < EXAMPLES {
            self.examples.push(Example { chunk, number: self.mismatches, what: what() });
        }
        self.mismatches += 1;
    }
}

/// Which enumeration, with all that decides its result. Two runs belong together iff their plans,
/// versions and sources are equal.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Plan {
    Triangles(triangles::Triangles),
    Lines(lines::Lines),
    Edges(edges::Edges),
}

impl Plan {
    pub fn enumeration(&self) -> &dyn Enumeration {
        match self {
            Self::Triangles(triangles) => triangles,
            Self::Lines(lines) => lines,
            Self::Edges(edges) => edges,
        }
    }

    /// Checks every parameter; enumerations rely on it.
    pub fn check(&self) -> Result<(), String> {
        match self {
            Self::Triangles(t) => {
                check_window(t.window_px, t.subpixel_bits, 4, t.offset_px)?;
                check_plant(t.plant.as_deref(), &names(&TriangleMutant::ALL, |m| m.name()))
            }
            Self::Edges(e) => {
                check_window(e.window_px, e.subpixel_bits, SUBPIXEL_BITS, e.offset_px)?;
                check_plant(e.plant.as_deref(), &[edges::PLANT])
            }
            Self::Lines(l) => {
                if !(1..=lines::MAX_REACH).contains(&l.reach) {
                    return Err(format!("the reach is 1 to {}", lines::MAX_REACH));
                }
                check_offset(l.offset_px)?;
                check_plant(l.plant.as_deref(), &names(&LineMutant::ALL, |m| m.name()))
            }
        }
    }

    /// Hashes of the code that the result depends on; see [`certificate::code_of`].
    pub fn source_hashes(&self) -> BTreeMap<String, String> {
        let entry = |source: Source| match certificate::code_of(&source) {
            Ok(code) => (source.name(), format!("{:x}", Sha256::digest(code))),
            Err(item) => (source.name(), format!("has no {item}")),
        };
        self.enumeration().sources().into_iter().map(entry).collect()
    }
}

impl Source {
    const fn file(path: &'static str, text: &'static str) -> Self {
        Self { path, text, items: &[] }
    }

    fn name(&self) -> String {
        if self.items.is_empty() {
            self.path.to_owned()
        } else {
            format!("{}: {}", self.path, self.items.join(", "))
        }
    }
}

fn names<M: Copy>(all: &[M], name: impl Fn(M) -> &'static str) -> Vec<&'static str> {
    all.iter().map(|&mutant| name(mutant)).collect()
}

fn check_window(window_px: u32, bits: u32, max_bits: u32, offset: [i32; 2]) -> Result<(), String> {
    if !(1..=MAX_WINDOW_PX).contains(&window_px) {
        return Err(format!("the window is 1 to {MAX_WINDOW_PX} px wide"));
    }
    if bits > max_bits {
        return Err(format!("at most {max_bits} subpixel bits can be exhausted here"));
    }
    check_offset(offset)
}

fn check_offset(offset: [i32; 2]) -> Result<(), String> {
    // Room for the window, or for the longest line, on the near side of the domain's border.
    let limit = DOMAIN_PX / 2;
    if offset.iter().any(|px| px.unsigned_abs() > limit.unsigned_abs()) {
        return Err(format!("the offset is within -{limit} to {limit} px"));
    }
    Ok(())
}

fn check_plant(plant: Option<&str>, known: &[&str]) -> Result<(), String> {
    match plant {
        Some(name) if !known.contains(&name) => {
            Err(format!("no fault {name} can be planted here; known: {}", known.join(", ")))
        }
        _ => Ok(()),
    }
}

/// The options that end the words of a plan, as far as they are not the default.
fn common_words(offset: [i32; 2], plant: Option<&str>) -> String {
    let mut words = String::new();
    if offset != [0, 0] {
        words += &format!(" --offset-px={},{}", offset[0], offset[1]);
    }
    if let Some(name) = plant {
        words += &format!(" --plant {name}");
    }
    words
}
