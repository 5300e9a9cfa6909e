//! What every judge has in common, whoever is judged: which cases, the loop over them, a failing case, and what came of all.
//!
//! A judge says what it takes and finds by the parameters of these types: [`comparison`](crate::comparison) of rasterizers and line
//! drawers, [`partition`](crate::partition) of tessellators, and the crate `judge` of programs.

#[doc(hidden)]
pub mod ascii;
#[doc(hidden)]
pub mod machine;
mod nothing;
mod panics;

use std::fmt;
use std::ops::Range;
use std::time::{Duration, Instant};

use machine::{Batch, Driver, Find, Judge, JudgeKind, Plan};
pub use nothing::{NoSuchShard, NothingJudged};
pub use panics::EnginePanic;
#[doc(hidden)]
pub use panics::{Watch, caught, is_judging};
use rasterproof_core::parallel;

/// A part of all cases: case i belongs to part i mod n of n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    part: u64,
    parts: u64,
}

impl Shard {
    /// All cases.
    pub const WHOLE: Self = Self { part: 0, parts: 1 };

    /// Part number `part`, from 0, of so many.
    ///
    /// # Errors
    /// There is no such part: `part` is not below `parts`.
    ///
    /// ```
    /// use rasterproof_verify::comparison::Shard;
    /// assert!(Shard::new(3, 4).is_ok());
    /// assert!(Shard::new(4, 4).is_err() && Shard::new(0, 0).is_err());
    /// ```
    pub fn new(part: u64, parts: u64) -> Result<Self, NoSuchShard> {
        if part < parts { Ok(Self { part, parts }) } else { Err(NoSuchShard { part, parts }) }
    }

    /// Which part it is, from 0.
    #[must_use]
    pub fn part(self) -> u64 {
        self.part
    }

    /// Of how many parts.
    #[must_use]
    pub fn parts(self) -> u64 {
        self.parts
    }
}

/// What one kind of judge takes beside the cases: the terms by which it judges.
pub trait Terms: Default {
    /// Cases of each family unless others are asked for.
    const CASES: u64;
}

/// What is judged: which cases, and by which terms.
///
/// ```
/// use std::time::Duration;
/// use rasterproof_verify::cases::FamilyName;
/// use rasterproof_verify::comparison::{NoSuchShard, Options, Shard};
/// let options = Options::default()
///     .cases(5_000)
///     .seed(7)
///     .family(FamilyName::Sliver)
///     .family(FamilyName::NearTie)
///     .time_limit(Duration::from_secs(10))
///     .shard(Shard::new(0, 4)?);
/// # Ok::<(), NoSuchShard>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options<F, T> {
    /// Decides every generated case.
    pub seed: u64,
    /// Cases of each family.
    pub cases: u64,
    /// How long all of it may take: the cases, making failing ones smaller, and looking for the cause. Where something is wrong,
    /// half of it is for the cases. The number of cases done is then what varies. Without a limit all cases are judged, and what
    /// comes after them may take [`AFTER_FAILURE`].
    pub time_limit: Option<Duration>,
    /// Families; empty means all.
    pub families: Vec<F>,
    /// The part of the cases.
    pub shard: Shard,
    /// Only the case of this number.
    pub only: Option<u64>,
    /// What is declared of who is judged, and what else this judge takes.
    pub terms: T,
}

impl<F, T: Terms> Default for Options<F, T> {
    fn default() -> Self {
        Self {
            seed: 1,
            cases: T::CASES,
            time_limit: None,
            families: Vec::new(),
            shard: Shard::WHOLE,
            only: None,
            terms: T::default(),
        }
    }
}

impl<F, T> Options<F, T> {
    /// The same with this many cases of each family.
    #[must_use]
    pub fn cases(self, cases: u64) -> Self {
        Self { cases, ..self }
    }

    /// The same with other generated cases.
    #[must_use]
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The same, but all of it, shrinking and looking for the cause too, ends after about this long.
    #[must_use]
    pub fn time_limit(self, limit: Duration) -> Self {
        Self { time_limit: Some(limit), ..self }
    }

    /// The same with one more family; without any, all are judged.
    #[must_use]
    pub fn family(mut self, family: F) -> Self {
        self.families.push(family);
        self
    }

    /// The same with a part of the cases.
    #[must_use]
    pub fn shard(self, shard: Shard) -> Self {
        Self { shard, ..self }
    }

    /// The same with the case of this number alone.
    #[must_use]
    pub fn only(self, number: u64) -> Self {
        Self { only: Some(number), ..self }
    }

    /// The same by other terms.
    #[doc(hidden)]
    #[must_use]
    pub fn terms(self, terms: T) -> Self {
        Self { terms, ..self }
    }

    /// The numbers of the cases of each family.
    #[doc(hidden)]
    #[must_use]
    pub fn numbers(&self) -> Range<u64> {
        self.only.map_or(0..self.cases, |index| index..index.saturating_add(1))
    }

    /// How many cases of each family there are in this part.
    pub(crate) fn count(&self) -> u64 {
        let Shard { part, parts } = self.shard;
        match self.only {
            Some(index) => u64::from(index % parts == part),
            None => self.cases.saturating_sub(part).div_ceil(parts),
        }
    }

    /// Whether there is a case to judge in any family.
    pub(crate) fn check(&self) -> Result<(), NothingJudged> {
        let Shard { part, parts } = self.shard;
        match self.only {
            Some(index) if index % parts != part => Err(NothingJudged::EmptyShard(self.shard)),
            Some(_) => Ok(()),
            None if self.cases == 0 => Err(NothingJudged::NoCases),
            None if part >= self.cases => Err(NothingJudged::EmptyShard(self.shard)),
            None => Ok(()),
        }
    }
}

/// How long the judged code itself may run after all cases, to make failing ones smaller and to find the cause, where no time limit
/// is given. Fast code needs far less.
pub const AFTER_FAILURE: Duration = Duration::from_secs(10);

/// What the time limit is called in Rust.
pub(crate) const TIME_LIMIT: &str = "Options::time_limit";

/// What was left out, because the time was up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOut {
    /// Whether the search for its convention did not end.
    pub convention: bool,
    /// Cases that were not judged.
    pub cases: u64,
    /// Whether failing cases might have become smaller.
    pub shrinking: bool,
    /// Whether the search for the cause did not end.
    pub cause: bool,
    /// The time limit, if there was one.
    pub limit: Option<Duration>,
    /// What the caller calls the time limit.
    pub option: &'static str,
}

impl fmt::Display for LeftOut {
    /// A sentence, or nothing where nothing was left out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        if self.convention {
            parts.push("its convention".to_owned());
        }
        if self.cases > 0 {
            parts.push(format!("{} cases", self.cases));
        }
        if self.shrinking {
            parts.push("making failing cases smaller".to_owned());
        }
        if self.cause {
            parts.push("the cause".to_owned());
        }
        if parts.is_empty() {
            return Ok(());
        }
        let why = match self.limit {
            Some(limit) => format!("the time limit of {} s was up", limit.as_secs_f64()),
            None => {
                let seconds = AFTER_FAILURE.as_secs();
                format!("the judged code has {seconds} s for what comes after a failure")
            }
        };
        write!(f, "Left out, since {why}: {}. {} allows more.", parts.join(", "), self.option)
    }
}

/// The time of a judgement, from its beginning.
pub(crate) struct Clock {
    start: Instant,
    limit: Option<Duration>,
}

impl Clock {
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Self { start: Instant::now(), limit }
    }

    /// When no more cases are begun: where something is wrong, half of a limited time is for what comes after them.
    pub(crate) fn end_of_cases(&self, has_failed: bool) -> Option<Duration> {
        self.limit.map(|limit| limit / if has_failed { 2 } else { 1 })
    }

    /// Limits what comes after the cases: shrinking to half of what is left, or to all of it what comes after that.
    pub(crate) fn limit(&self, watch: &Watch, is_shrinking: bool) {
        let now = Instant::now();
        let end = self.limit.map(|limit| self.start + limit);
        let share = if is_shrinking { 2 } else { 1 };
        let end = end.map(|end| now + end.saturating_duration_since(now) / share);
        watch.limit(end, AFTER_FAILURE / 2, !is_shrinking);
    }
}

/// A failing case, shrunk.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Failure<C, E> {
    /// The family of the case it was found in.
    pub family: &'static str,
    /// The number of that case.
    pub index: u64,
    /// The seed of the run.
    pub seed: u64,
    /// What is wrong with the smallest case.
    pub what: String,
    /// The smallest case found that still fails.
    pub case: C,
    /// What was drawn or answered in it, and what was expected.
    pub evidence: E,
}

impl<C, E> Failure<C, E> {
    /// The smallest case reached from case `index` of a family.
    #[doc(hidden)]
    pub fn new(
        family: &'static str,
        index: u64,
        seed: u64,
        what: String,
        case: C,
        evidence: E,
    ) -> Self {
        Self { family, index, seed, what, case, evidence }
    }
}

/// What came of all cases.
#[derive(Clone, Debug)]
#[must_use = "a verdict may be that something is wrong: call `check`"]
pub struct Verdict<O, R, F, W, M = ()> {
    /// The options it was run with.
    pub options: O,
    /// One for each family, in the order of the catalogue.
    pub families: Vec<R>,
    /// The smallest failing cases that were found, those to look at first in front.
    pub failures: Vec<F>,
    /// Why it is wrong, where it was looked for.
    pub cause: W,
    /// What one kind of judge alone says beside it.
    pub more: M,
}

/// Cases that a thread judges in one go.
const BLOCK: u64 = 64;
/// Cases of a family before the next family's turn. Of a limited time a few blocks.
const MOST_PER_ROUND: [u64; 2] = [1 << 20, BLOCK * 8];
/// More than most machines have threads.
const WORKERS: usize = 64;

/// Judges so many families, where who is asked is in this process, on all threads. `find` says what is found about some jobs of a family.
pub(crate) fn in_process<K: JudgeKind, F, T>(
    kind: &K,
    tally: K::Tally,
    families: usize,
    (options, clock): (&Options<F, T>, &Clock),
    progress: &(dyn Fn(u64) + Sync),
    find: &Find<'_, K>,
) -> K::Tally {
    let most = MOST_PER_ROUND[usize::from(options.time_limit.is_some())];
    let judge = Judge::new(Plan::new(options, [1, families], BLOCK, most), tally);
    let driver = Driver {
        now: &|| clock.start.elapsed(),
        workers: &|work| parallel::each(WORKERS, work),
        ask: &|_, batch: Batch<K>| {
            let place = batch.place;
            batch.ask(kind, |jobs| find(place, jobs))
        },
        progress,
    };
    driver.drive(kind, judge).tally
}
