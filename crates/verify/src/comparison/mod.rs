//! The comparison: families of cases, every engine against the oracle and against each other.
//!
//! Coverage is compared for every pixel of every case, by hit count, with tolerance zero. Values
//! are compared with exact rationals at a few pixels of every case, and the difference is reported
//! as a fraction of the bound derived in [`tolerance`]. A panic of an engine is a finding like any
//! other: the panic hook sees the first one of a run, and the verdict counts the cases. A result depends on the
//! options alone, not on the number of threads.
//!
//! The same functions judge an engine of yours: [`judge_coverage`], [`judge_values`],
//! [`judge_lines`], [`judge_line_values`]; corners that are not snapped, [`judge_exact`]. They return [`NothingJudged`] where the
//! options leave no case, since a verdict on nothing would agree.

mod cause;
mod changed;
mod compare;
mod disagreement;
mod finding;
mod nothing;
#[doc(hidden)]
pub mod pixels;
pub mod shrink;
#[doc(hidden)]
pub mod single_precision;
mod spans;
pub mod tolerance;
mod truth;

use std::cmp::Ordering;
use std::fmt;
use std::ops::AddAssign;
use std::time::Duration;

use crate::cases::{Case, Family, FamilyName, Kind, Shape};
use crate::judge::machine::{JudgeKind, Place, keep_first};
use crate::judge::{self, Clock};
use changed::Changing;
use compare::{
    CompareCases, Cover, CoverageOnly, EachOther, LineComparer, ORACLE, OneOf, PixelsOnly,
    TriangleComparer, UnsnappedComparer,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Decisions, DrawLine, Interpolate, Rasterize, RasterizeExact};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::triangle::PixelPoint;
use tolerance::Tolerance;

pub use crate::judge::{EnginePanic, LeftOut, NoSuchShard, NothingJudged, Shard};
#[doc(hidden)]
pub use crate::judge::{Watch, caught, is_judging};
#[doc(hidden)]
pub use crate::promise::Expectation;
pub use crate::promise::{Convention, Rule, Winding};
pub use cause::Cause;
#[doc(hidden)]
pub use cause::CauseSearch;
pub use changed::Changed;
pub use disagreement::Disagreement;
pub use finding::{Finding, Tally};
#[doc(hidden)]
pub use {
    compare::{is_sliver, line_has_tie},
    spans::{
        engine_coverage, exact_coverage, line_coverage, oracle_coverage, oracle_hits,
        oracle_pixels_each,
    },
};

/// What is judged: which cases, and by which convention.
pub type Options = judge::Options<FamilyName, Convention>;

impl judge::Terms for Convention {
    const CASES: u64 = 20_000;
}

impl Options {
    /// The same for a rasterizer that promises something else.
    #[must_use]
    pub fn convention(self, convention: Convention) -> Self {
        self.terms(convention)
    }

    fn wants(&self, family: &str) -> bool {
        self.families.is_empty() || self.families.iter().any(|name| name.as_str() == family)
    }
}

/// How two engines compare over a family.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PairReport {
    /// The one that is judged.
    pub actual: String,
    /// The one it is judged by.
    pub target: String,
    /// Wrong pixels: the coverage of the one against that of the other.
    pub tally: Tally,
    /// The pixels of the engine's fragments against its own coverage; counted where the target is
    /// the oracle, and no part of `tally`.
    pub fragments: Tally,
    /// Largest difference of an attribute, as a fraction of its bound.
    pub worst_attribute: f64,
    /// Largest difference of a depth, as a fraction of its bound.
    pub worst_depth: f64,
    /// Number of the first case with the larger of the two.
    pub worst_case: u64,
    /// Values compared.
    pub values: u64,
    /// How an engine for corners that are not snapped decided: a filter that lets nothing through, or a fallback that is
    /// never needed, shows here.
    pub decisions: Decisions,
    /// Cases in which an engine panicked.
    pub panics: u64,
    /// Cases in which anything was wrong.
    pub wrong_cases: u64,
}

impl PairReport {
    /// Whether nothing was wrong.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.wrong_cases == 0
    }

    /// Whether the engine was judged by the oracle, and not by another engine.
    #[must_use]
    pub fn is_by_oracle(&self) -> bool {
        self.target == ORACLE
    }
}

/// How a family went.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FamilyReport {
    /// Its name.
    pub family: String,
    /// Cases judged.
    pub cases: u64,
    /// Triangles or lines judged.
    pub shapes: u64,
    /// What the shapes are.
    pub kind: Kind,
    /// Covered pixels, by the oracle.
    pub pixels: u64,
    /// Cases in which a sample lies exactly on an edge, or a line passes halfway between pixels.
    pub tie_cases: u64,
    /// Cases with a triangle thinner than a pixel and eight times as long.
    pub sliver_cases: u64,
    /// Cases that light no pixel.
    pub empty_cases: u64,
    /// Pixels that the oracle itself hits twice where shapes are disjoint by construction, or not once where they tile
    /// the window.
    pub oracle_faults: u64,
    /// One for each pair of engines.
    pub pairs: Vec<PairReport>,
}

/// A failing case with what two engines draw in the smallest one.
pub type Failure = judge::Failure<Case, Compared>;

/// What two draw in a case in which they differ.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Compared {
    /// Engine and what it was judged by.
    pub pair: [String; 2],
    /// What the engine draws; nothing where it panics.
    pub drawn: Option<Coverage>,
    /// What the engine draws by which it was judged; nothing where that was the oracle, or it panics.
    pub other: Option<Coverage>,
    /// What the oracle draws.
    pub expected: Coverage,
    /// Two answers of an engine that does not draw the case the same each time. Such a case is not shrunk.
    pub changed: Option<Changed>,
}

impl Compared {
    /// Which of two compared engines draws other pixels than the oracle; the first one where both do.
    fn who_is_wrong(&self) -> &str {
        let is_first_right = self.drawn.as_ref() == Some(&self.expected);
        &self.pair[usize::from(is_first_right && self.pair[1] != ORACLE)]
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [actual, target] = &self.evidence.pair;
        write!(f, "{actual} against {target}: {} on {}", self.what, shrink::describe(&self.case))?;
        write!(f, " (from {} #{} of seed {})", self.family, self.index, self.seed)
    }
}

/// The outcome of a run. Its failures are the smallest of each family and pair, smallest first; its cause is looked for where one
/// engine alone is judged and is wrong. Every failing case is drawn a second time. Of an engine that draws it otherwise then the
/// failures are such cases, not shrunk, with both answers, and no cause is looked for.
pub type Verdict = judge::Verdict<Options, FamilyReport, Failure, Option<Cause>, LeftOut>;

impl Verdict {
    /// Nothing, or what a failing test has to print.
    ///
    /// # Errors
    /// [`Disagreement`] where anything was wrong.
    pub fn check(&self) -> Result<(), Box<Disagreement>> {
        if self.agrees() { Ok(()) } else { Err(Box::new(Disagreement::of(self))) }
    }

    /// Whether nothing was wrong anywhere.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.families.iter().all(|f| f.oracle_faults == 0 && f.pairs.iter().all(PairReport::agrees))
    }

    /// This verdict, unless it rests on no case.
    fn of_cases(self) -> Result<Self, NothingJudged> {
        let is_empty = self.families.iter().all(|family| family.cases == 0);
        if is_empty { Err(NothingJudged::NoneReached) } else { Ok(self) }
    }

    /// Wrong pixels of all engines against the oracle, over all families.
    #[must_use]
    pub fn mismatches(&self) -> u64 {
        self.comparisons().oracle.total()
    }

    /// Wrong pixels over all families, each comparison for itself.
    #[must_use]
    pub fn comparisons(&self) -> Comparisons {
        let mut sums = Comparisons::default();
        for pair in self.families.iter().flat_map(|f| &f.pairs) {
            let sum = if pair.is_by_oracle() { &mut sums.oracle } else { &mut sums.engines };
            *sum += pair.tally;
            sums.fragments += pair.fragments;
        }
        sums
    }

    /// Sum of a number over the families of a kind.
    #[must_use]
    pub fn sum(&self, kind: Kind, number: impl Fn(&FamilyReport) -> u64) -> u64 {
        self.families.iter().filter(|f| f.kind == kind).map(number).sum()
    }

    /// What the quotas are about, how much of it there was in percent, and how much is wanted.
    #[must_use]
    pub fn quotas(&self) -> [(&'static str, u64, u64); 3] {
        let cases = self.sum(Kind::Triangles, |f| f.cases);
        let counts = [
            self.sum(Kind::Triangles, |f| f.tie_cases),
            self.sum(Kind::Triangles, |f| f.sliver_cases),
            self.sum(Kind::Triangles, |f| f.empty_cases),
        ];
        let percent = |part: u64| (100 * part + cases / 2).checked_div(cases).unwrap_or(0);
        [0, 1, 2].map_array(|i| (QUOTAS[i].0, percent(counts[i]), QUOTAS[i].1))
    }
}

/// Wrong pixels by what was compared with what. The same pixel may be wrong in several ways, so the
/// three are never added up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Comparisons {
    /// The coverage of each engine against the oracle's.
    pub oracle: Tally,
    /// The coverage of each engine against that of the next.
    pub engines: Tally,
    /// The pixels of each engine's fragments against its own coverage.
    pub fragments: Tally,
}

/// Quotas for ties, slivers and empty cases, in percent of the cases of triangles: what the families
/// must offer for a verdict to mean something.
pub const QUOTAS: [(&str, u64); 3] = [("ties", 25), ("slivers", 10), ("empty", 5)];

/// Engines that are judged together, each under its name.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Engines<R, D, E> {
    /// Rasterizers, with the bounds of their values.
    pub triangles: Vec<(&'static str, R, Option<Tolerance>)>,
    /// Line drawers.
    pub lines: Vec<(&'static str, D)>,
    /// Rasterizers of corners that are not snapped.
    pub unsnapped: Vec<(&'static str, E)>,
}

impl<R: Interpolate + Sync, D: DrawLine + Sync, E: RasterizeExact + Sync> Engines<R, D, E> {
    /// Judges them against the oracle, and those on the lattice against each other. Where nothing is selected, the verdict
    /// has no families, and the caller has to notice.
    pub fn judge(&self, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> Verdict {
        let triangles = TriangleComparer::new(&self.triangles, options.terms);
        let (lines, unsnapped) =
            (LineComparer::new(&self.lines), UnsnappedComparer::new(&self.unsnapped));
        let clock = Clock::new(options.time_limit);
        drive(&[&triangles, &lines, &unsnapped], options, progress, &Watch::begin(), &clock)
    }

    /// Why an engine is wrong, found by asking it more; nothing where no engine has this name.
    #[must_use]
    pub fn cause(&self, engine: &str) -> Option<Cause> {
        Watch::begin().during(|| self.cause_of(engine))
    }

    fn cause_of(&self, engine: &str) -> Option<Cause> {
        let triangles = TriangleComparer::new(&self.triangles, Convention::default());
        let of_lines = || LineComparer::new(&self.lines).cause(engine);
        let of_unsnapped = || UnsnappedComparer::new(&self.unsnapped).cause(engine);
        triangles.cause(engine).or_else(of_lines).or_else(of_unsnapped)
    }

    /// Judges one case as [`Self::judge`] judges each generated case.
    #[must_use]
    pub fn judge_case(&self, case: &Case) -> Vec<([String; 2], Finding)> {
        let findings = |comparer: &dyn CompareCases| {
            let findings = Watch::begin().during(|| comparer.findings(case));
            comparer.pairs().into_iter().zip(findings).collect()
        };
        match case.shape {
            Shape::Triangles { .. } => {
                findings(&TriangleComparer::new(&self.triangles, Convention::default()))
            }
            Shape::Lines(_) => findings(&LineComparer::new(&self.lines)),
            Shape::Unsnapped { .. } => findings(&UnsnappedComparer::new(&self.unsnapped)),
            // Only programs answer these.
            Shape::Numbers { .. } => Vec::new(),
        }
    }
}

/// The name of an engine that is judged alone.
const CANDIDATE: &str = "candidate";

/// Judges the coverage of any rasterizer against the oracle.
///
/// # Errors
/// By these options no case was judged.
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_coverage<R: Rasterize + Sync>(
    engine: &R,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    judge_cover(&|corners, bounds, emit| engine.cover(corners, bounds, emit), options)
}

fn judge_cover(cover: &Cover<'_>, options: &Options) -> Result<Verdict, NothingJudged> {
    judge_triangles(CoverageOnly(cover), None, options)
}

/// Ends a test with the whole message unless a verdict agrees.
///
/// # Panics
/// Where anything was wrong, or nothing was judged.
#[doc(hidden)]
#[track_caller]
pub fn must_agree(verdict: Result<Verdict, NothingJudged>) {
    match verdict.map(|verdict| verdict.check()) {
        Ok(Ok(())) => {}
        Ok(Err(disagreement)) => panic!("{disagreement}"),
        Err(nothing) => panic!("{nothing}"),
    }
}

/// Judges the coverage of one case by any rasterizer against the oracle.
#[must_use]
pub fn judge_coverage_of<R: Rasterize + Sync>(engine: &R, case: &Case) -> Finding {
    let cover: &Cover<'_> = &|corners, bounds, emit| engine.cover(corners, bounds, emit);
    let engines = [(CANDIDATE, CoverageOnly(cover), None)];
    let comparer = TriangleComparer::new(&engines, Convention::default());
    Watch::begin().during(|| comparer.findings(case)).swap_remove(0)
}

/// Judges coverage and values of any rasterizer against the oracle, values within `tolerance`.
///
/// # Errors
/// By these options no case was judged.
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_values<R: Interpolate + Sync>(
    engine: &R,
    tolerance: Tolerance,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    judge_triangles(engine, Some(tolerance), options)
}

fn judge_triangles<R: Interpolate + Sync>(
    engine: R,
    tolerance: Option<Tolerance>,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    let engines = [(CANDIDATE, engine, tolerance)];
    judge_alone(&TriangleComparer::new(&engines, options.terms), options)
}

/// Judges the pixels of any line drawer against the oracle, in the order in which it lights them. It is given the ends, the window
/// and a function that lights column x of row y, and has no depths and no attributes.
///
/// # Errors
/// By these options no case was judged, or they declare a convention, which is one of triangles.
///
/// ```
/// use rasterproof_verify::comparison::{Options, judge_lines};
/// let first_end_alone = judge_lines(
///     &|[a, _], window, light| {
///         if window.contains(a.x, a.y) {
///             light(a.x, a.y);
///         }
///     },
///     &Options::default().cases(20),
/// )?;
/// println!("{}", first_end_alone.check().unwrap_err());
/// # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
/// ```
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_lines<F>(draw: &F, options: &Options) -> Result<Verdict, NothingJudged>
where
    F: Fn([PixelPoint; 2], PixelRect, &mut dyn FnMut(i32, i32)) + Sync,
{
    let engine = PixelsOnly(draw);
    judge_alone(&LineComparer::of_pixels(&[(CANDIDATE, engine)]), options)
}

/// Judges pixels and values of any line drawer against the oracle.
///
/// # Errors
/// By these options no case was judged, or they declare a convention, which is one of triangles.
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_line_values<D: DrawLine + Sync>(
    engine: &D,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    judge_alone(&LineComparer::new(&[(CANDIDATE, engine)]), options)
}

/// Judges any rasterizer of corners that are not snapped against the oracle.
///
/// # Errors
/// By these options no case was judged, or they declare a convention, which is one of corners on the lattice.
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_exact<E: RasterizeExact + Sync>(
    engine: &E,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    judge_alone(&UnsnappedComparer::new(&[(CANDIDATE, engine)]), options)
}

/// The names of two engines that are compared.
const BOTH: [&str; 2] = ["first", "second"];

/// Compares the coverage of any two rasterizers, such as a port and its original, without asking which of them is right. Where they
/// differ, the message shows both beside the oracle, and says with which of them it agrees.
///
/// # Errors
/// By these options no case was judged.
///
/// ```
/// use rasterproof_core::raster::{edge_function::EdgeFunction, scanline::Scanline};
/// use rasterproof_verify::comparison::{Options, compare_coverage};
/// let verdict = compare_coverage(&Scanline, &EdgeFunction, &Options::default().cases(20))?;
/// assert!(verdict.agrees());
/// # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
/// ```
#[must_use = "the verdict may be that something is wrong"]
pub fn compare_coverage<A: Rasterize + Sync, B: Rasterize + Sync>(
    first: &A,
    second: &B,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    let covers: [&Cover<'_>; 2] =
        [&|corners, bounds, emit| first.cover(corners, bounds, emit), &|corners, bounds, emit| {
            second.cover(corners, bounds, emit)
        }];
    let [first, second] = covers.map(CoverageOnly);
    let engines = [(BOTH[0], first, None), (BOTH[1], second, None)];
    judge_alone(&EachOther(TriangleComparer::new(&engines, options.terms)), options)
}

/// Compares the pixels of any two line drawers, in drawing order, as [`compare_coverage`] compares rasterizers.
///
/// # Errors
/// By these options no case was judged, or they declare a convention, which is one of triangles.
#[must_use = "the verdict may be that something is wrong"]
pub fn compare_lines<A: DrawLine + Sync, B: DrawLine + Sync>(
    first: &A,
    second: &B,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    let engines = [(BOTH[0], OneOf::First(first)), (BOTH[1], OneOf::Second(second))];
    judge_alone(&EachOther(LineComparer::new(&engines)), options)
}

fn judge_alone(comparer: &dyn CompareCases, options: &Options) -> Result<Verdict, NothingJudged> {
    nothing::check(options, comparer.kind())?;
    if comparer.kind() != Kind::Triangles && options.terms != Convention::default() {
        return Err(NothingJudged::NoConventions);
    }
    let (watch, clock) = (Watch::begin(), Clock::new(options.time_limit));
    let mut verdict = drive(&[comparer], options, &|_| (), &watch, &clock).of_cases()?;
    let changes = verdict.failures.iter().any(|failure| failure.evidence.changed.is_some());
    if !verdict.agrees() && !changes {
        let who =
            verdict.failures.first().map_or(CANDIDATE, |f| f.evidence.who_is_wrong()).to_owned();
        clock.limit(&watch, false);
        let cause = watch.during(|| comparer.cause(&who));
        // What was concluded from some of the answers would be no conclusion.
        verdict.more.cause = watch.is_over();
        verdict.cause = cause.filter(|_| !verdict.more.cause);
    }
    Ok(verdict)
}

/// Failing cases of each family and pair that are shrunk; the smaller result is kept.
const KEPT: usize = 2;

/// A family that is judged, by whom, and the pairs of a report.
struct Chosen<'a> {
    family: &'static Family,
    comparer: &'a dyn CompareCases,
    pairs: Vec<[String; 2]>,
}

/// A generated case, and what was known of each pair when it was judged the first time.
struct EngineJob {
    index: u64,
    case: Case,
    known: Option<Vec<Finding>>,
}

/// What was found about a case; `known` is what was known before of each pair, empty where nothing is wrong.
struct EngineFound {
    facts: compare::CaseFacts,
    findings: Vec<Finding>,
    known: Vec<Finding>,
}

/// What the cases of one family came to.
struct Partial {
    report: FamilyReport,
    /// Pair and number of the first failing cases.
    failing: Vec<(usize, u64)>,
    /// The first case of each pair that was not drawn the same twice, after the number of its batch.
    changing: Vec<(u64, Changing)>,
}

/// Engines that are judged.
struct JudgedEngines<'a> {
    chosen: Vec<Chosen<'a>>,
    options: &'a Options,
    clock: &'a Clock,
}

impl JudgedEngines<'_> {
    /// Judges some cases of a family. What an earlier one reached need not be looked into again.
    fn find(&self, jobs: &[&EngineJob], comparer: &dyn CompareCases) -> Vec<EngineFound> {
        let mut known = vec![Finding::default(); comparer.pairs().len()];
        let mut found = Vec::new();
        for job in jobs {
            let before = job.known.as_ref().unwrap_or(&known);
            let (facts, findings) = comparer.judge(&job.case, before.clone());
            let is_wrong = findings.iter().any(Finding::is_wrong);
            let before = if is_wrong { before.clone() } else { Vec::new() };
            for (known, finding) in known.iter_mut().zip(&findings) {
                *known = Finding::known(finding.attribute, finding.depth);
            }
            found.push(EngineFound { facts, findings, known: before });
        }
        found
    }
}

impl JudgeKind for JudgedEngines<'_> {
    type Job = EngineJob;
    type Judgement = EngineFound;
    type Tally = Vec<Partial>;

    fn jobs(&self, place: Place, index: u64, jobs: &mut Vec<EngineJob>) {
        let family = self.chosen[place.family].family;
        let case = self.options.terms.case(family, self.options.seed, index);
        jobs.push(EngineJob { index, case, known: None });
    }

    fn count(
        &self,
        tally: &mut Vec<Partial>,
        place: Place,
        (job, found): (EngineJob, EngineFound),
    ) -> Option<(EngineJob, EngineFound)> {
        let Partial { report, failing, .. } = &mut tally[place.family];
        report.count(&found.facts);
        for (pair, finding) in found.findings.iter().enumerate() {
            report.pairs[pair].count(job.index, finding);
            if finding.is_wrong() && failing.iter().filter(|(p, _)| *p == pair).count() < KEPT {
                failing.push((pair, job.index));
            }
        }
        if found.known.is_empty() {
            return None;
        }
        let keep = |known: &Finding| Finding { keeps_pixels: true, ..known.clone() };
        let known = Some(found.known.iter().map(keep).collect());
        Some((EngineJob { known, ..job }, found))
    }

    fn compare(
        &self,
        tally: &mut Vec<Partial>,
        (batch, place): (u64, Place),
        (job, found): &(EngineJob, EngineFound),
        again: EngineFound,
    ) {
        let kept = &mut tally[place.family].changing;
        for changing in Changing::between(job.index, &found.findings, again.findings) {
            keep_first(kept, batch, changing, |a, b| a.pair == b.pair);
        }
    }

    fn cases(&self, tally: &Vec<Partial>) -> u64 {
        tally.iter().map(|partial| partial.report.cases).sum()
    }

    fn end(&self, tally: &Vec<Partial>, _: usize) -> Option<Duration> {
        self.clock.end_of_cases(tally.iter().any(|partial| !partial.failing.is_empty()))
    }
}

/// The families that `options` ask for among those that `comparers` judge.
fn drive(
    comparers: &[&dyn CompareCases],
    options: &Options,
    progress: &(dyn Fn(u64) + Sync),
    watch: &Watch,
    clock: &Clock,
) -> Verdict {
    let mut chosen = Vec::new();
    for (kind, families) in Kind::ALL {
        let comparers = comparers.iter().filter(|comparer| comparer.kind() == kind);
        for comparer in comparers.filter(|comparer| !comparer.pairs().is_empty()) {
            for family in families {
                if options.wants(family.name) {
                    chosen.push(Chosen { family, comparer: *comparer, pairs: comparer.pairs() });
                }
            }
        }
    }
    let mut partials = Vec::new();
    for of in &chosen {
        let report = FamilyReport::new(of);
        partials.push(Partial { report, failing: Vec::new(), changing: Vec::new() });
    }
    let judged = JudgedEngines { chosen, options, clock };
    let find = |place: Place, jobs: &[&EngineJob]| {
        watch.during(|| judged.find(jobs, judged.chosen[place.family].comparer))
    };
    let families = judged.chosen.len();
    let mut partials =
        judge::in_process(&judged, partials, families, (options, clock), progress, &find);
    // Of a limited time, the last families may not have been reached.
    partials.retain(|partial| partial.report.cases > 0);
    let chosen = &judged.chosen;
    let of_cases = options.count().saturating_mul(chosen.len() as u64);
    clock.limit(watch, true);
    let failures = shrink_failures(&partials, chosen, options, watch);
    let more = LeftOut {
        cases: of_cases - partials.iter().map(|partial| partial.report.cases).sum::<u64>(),
        shrinking: !failures.is_empty() && watch.is_over(),
        cause: false,
        limit: options.time_limit,
        option: judge::TIME_LIMIT,
        ..LeftOut::default()
    };
    let families = partials.into_iter().map(|partial| partial.report).collect();
    Verdict { options: options.clone(), families, failures, cause: None, more }
}

impl AddAssign for FamilyReport {
    /// Sums and maxima over the same pairs on other cases.
    fn add_assign(&mut self, other: Self) {
        self.cases += other.cases;
        self.shapes += other.shapes;
        self.pixels += other.pixels;
        self.tie_cases += other.tie_cases;
        self.sliver_cases += other.sliver_cases;
        self.empty_cases += other.empty_cases;
        self.oracle_faults += other.oracle_faults;
        for (a, b) in self.pairs.iter_mut().zip(&other.pairs) {
            a.tally += b.tally;
            a.fragments += b.fragments;
            a.worst_case = match a.worst().total_cmp(&b.worst()) {
                Ordering::Less => b.worst_case,
                Ordering::Equal => a.worst_case.min(b.worst_case),
                Ordering::Greater => a.worst_case,
            };
            a.worst_attribute = a.worst_attribute.max(b.worst_attribute);
            a.worst_depth = a.worst_depth.max(b.worst_depth);
            a.values += b.values;
            a.decisions += b.decisions;
            a.panics += b.panics;
            a.wrong_cases += b.wrong_cases;
        }
    }
}

impl FamilyReport {
    fn new(chosen: &Chosen<'_>) -> Self {
        let mut pairs = Vec::new();
        for [actual, target] in &chosen.pairs {
            let (actual, target) = (actual.clone(), target.clone());
            // No case is the worst one yet.
            pairs.push(PairReport {
                actual,
                target,
                worst_case: u64::MAX,
                ..PairReport::default()
            });
        }
        let (family, kind) = (chosen.family.name.to_owned(), chosen.comparer.kind());
        Self { family, kind, pairs, ..Self::default() }
    }

    fn count(&mut self, facts: &compare::CaseFacts) {
        self.cases += 1;
        self.shapes += facts.shapes;
        self.pixels += facts.pixels;
        self.tie_cases += u64::from(facts.ties > 0);
        self.sliver_cases += u64::from(facts.sliver);
        self.empty_cases += u64::from(facts.pixels == 0);
        self.oracle_faults += facts.oracle_faults;
    }
}

impl PairReport {
    /// The larger of the two worst differences, each as a fraction of its bound.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.worst_attribute.max(self.worst_depth)
    }

    fn count(&mut self, index: u64, finding: &Finding) {
        self.tally += finding.tally;
        self.fragments += finding.fragments;
        if finding.worst() > self.worst() {
            self.worst_case = index;
        }
        self.worst_attribute = self.worst_attribute.max(finding.attribute);
        self.worst_depth = self.worst_depth.max(finding.depth);
        self.values += finding.values;
        self.decisions += finding.decisions;
        self.panics += u64::from(finding.panic.is_some());
        self.wrong_cases += u64::from(finding.is_wrong());
    }
}

/// What has to be drawn in a case.
fn expected(case: &Case, convention: Convention) -> Coverage {
    match &case.shape {
        Shape::Triangles { list, .. } => spans::hits_of_all(&convention, list, case.window),
        _ => oracle_hits(case),
    }
}

/// A failing case: which of the chosen families and of its pairs, and its number.
struct FailingCase {
    place: usize,
    pair: usize,
    index: u64,
}

/// Whether two engines are compared of which the oracle says that one is wrong.
fn is_known(partial: &Partial, pairs: &[[String; 2]], pair: usize) -> bool {
    let [first, second] = &pairs[pair];
    if second == ORACLE {
        return false;
    }
    for (other, _) in &partial.failing {
        let [wrong, target] = &pairs[*other];
        if target == ORACLE && (wrong == first || wrong == second) {
            return true;
        }
    }
    false
}

/// Whether both engines of a pair draw a case as they drew it before.
fn is_steady(changes: &[Failure], pair: &[String; 2]) -> bool {
    for failure in changes {
        let engine = failure.evidence.changed_engine();
        if engine == Some(&pair[0]) || engine == Some(&pair[1]) {
            return false;
        }
    }
    true
}

/// Makes a failing case smaller, while its pair goes on to be wrong.
fn shrink_case(
    of: &Chosen<'_>,
    &FailingCase { pair, index, .. }: &FailingCase,
    options: &Options,
    watch: &Watch,
) -> Failure {
    let Chosen { family, comparer, pairs } = of;
    let original = options.terms.case(family, options.seed, index);
    let fails = |case: &Case| {
        !watch.is_over() && options.terms.holds(case) && comparer.findings(case)[pair].is_wrong()
    };
    let case = shrink::shrink(original, fails);
    let evidence = Compared {
        pair: pairs[pair].clone(),
        drawn: comparer.coverage(&pairs[pair][0], &case),
        other: comparer.coverage(&pairs[pair][1], &case),
        expected: expected(&case, options.terms),
        changed: None,
    };
    let what = comparer.findings(&case)[pair].describe();
    Failure { family: family.name, index, seed: options.seed, what, case, evidence }
}

/// Shrinks the first failing cases of each family and pair, and keeps the smallest of each, smallest first, those on the
/// lattice before the others. Two engines against each other are left out where the oracle says which of them is wrong.
fn shrink_failures(
    partials: &[Partial],
    chosen: &[Chosen<'_>],
    options: &Options,
    watch: &Watch,
) -> Vec<Failure> {
    let changes = changed::failures(partials, chosen, options);
    let mut failing = Vec::new();
    for (place, partial) in partials.iter().enumerate() {
        for &(pair, index) in &partial.failing {
            let pairs = &chosen[place].pairs;
            if !is_known(partial, pairs, pair) && is_steady(&changes, &pairs[pair]) {
                failing.push(FailingCase { place, pair, index });
            }
        }
    }
    let shrunk = |number: usize| {
        shrink_case(&chosen[failing[number].place], &failing[number], options, watch)
    };
    // The first one is shown in any case.
    let shrunk = parallel::map(failing.len(), |number| {
        (number == 0 || !watch.is_over()).then(|| watch.during(|| shrunk(number)))
    });
    let size = |failure: &Failure| {
        (matches!(failure.case.shape, Shape::Unsnapped { .. }), shrink::size(&failure.case))
    };
    let mut shrunk: Vec<_> = failing
        .iter()
        .zip(shrunk)
        .filter_map(|(case, failure)| Some(((case.place, case.pair), failure?)))
        .collect();
    // The smallest of each family and pair is kept.
    shrunk.sort_by_cached_key(|(origin, failure)| (*origin, size(failure)));
    shrunk.dedup_by_key(|(origin, _)| *origin);
    let mut failures: Vec<_> = shrunk.into_iter().map(|(_, failure)| failure).collect();
    failures.sort_by_cached_key(size);
    changes.into_iter().chain(failures).collect()
}
