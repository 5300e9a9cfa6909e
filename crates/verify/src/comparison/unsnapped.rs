//! The comparison off the lattice: engines for corners that are not snapped, against the oracle.
//!
//! As on the lattice, every pixel of every case is compared by hit count with tolerance zero, and a
//! panic is a finding. Besides, each engine's decisions are counted, so that a filter that never
//! lets anything through, or a fallback that is never needed, shows in the table.

use std::fmt;
use std::ops::AddAssign;

use super::finding::{EnginePanic, caught};
use super::{Convention, KEPT, NothingJudged, Options, Partial, Tally, in_blocks, smallest_first};
use crate::cases::unsnapped::shrink::{shrink, size};
use crate::cases::unsnapped::{FAMILIES, OffGridCase, OffGridFamily};
use crate::oracle::rational::cover_and_count_ties;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Decisions, RasterizeExact};
use rasterproof_core::frame::Coverage;
use rasterproof_core::triangle::{FreeCorners, Span};

/// How an engine did on a family.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ExactEngineReport {
    /// Its name.
    pub engine: String,
    /// Wrong pixels, judged by the oracle.
    pub tally: Tally,
    /// How it decided.
    pub decisions: Decisions,
    /// Cases in which it panicked.
    pub panics: u64,
    /// Cases in which anything was wrong.
    pub wrong_cases: u64,
}

/// How a family went.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ExactFamilyReport {
    /// Its name.
    pub family: String,
    /// Cases judged.
    pub cases: u64,
    /// Triangles judged.
    pub triangles: u64,
    /// Covered pixels, by the oracle.
    pub pixels: u64,
    /// Cases in which a sample lies exactly on an edge.
    pub tie_cases: u64,
    /// Cases that cover no pixel.
    pub empty_cases: u64,
    /// Pixels that the oracle itself does not hit exactly once where triangles tile the window.
    pub oracle_faults: u64,
    /// One for each engine.
    pub engines: Vec<ExactEngineReport>,
}

/// A failing case, shrunk.
#[derive(Clone, Debug)]
pub struct ExactFailure {
    /// Family of the case it was found in.
    pub family: String,
    /// Number of the case.
    pub index: u64,
    /// Seed of the run.
    pub seed: u64,
    /// The engine that is wrong.
    pub engine: String,
    /// What is wrong with the shrunk case.
    pub what: String,
    /// The smallest case found that still fails.
    pub case: OffGridCase,
}

impl fmt::Display for ExactFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let triangles = describe(&self.case.triangles);
        write!(f, "{} against oracle-exact: {} on {triangles}", self.engine, self.what)?;
        write!(f, " (from {} #{} of seed {})", self.family, self.index, self.seed)
    }
}

/// The positions of triangles in pixels, as the command line takes them, with all digits.
#[must_use]
pub fn describe(triangles: &[FreeCorners]) -> String {
    let one = |t: &FreeCorners| t.px().map_array(|[x, y]| format!("{x:?},{y:?}")).join(" ");
    triangles.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// The outcome of a run off the lattice.
#[derive(Clone, Debug, Default)]
#[must_use = "a verdict may be that something is wrong"]
pub struct ExactVerdict {
    /// One for each family, in the order of the catalogue; none where no engine was judged.
    pub families: Vec<ExactFamilyReport>,
    /// The smallest failing case found of each family and engine, shrunk, smallest first.
    pub failures: Vec<ExactFailure>,
}

impl ExactVerdict {
    /// Whether nothing was wrong anywhere.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.families
            .iter()
            .all(|f| f.oracle_faults == 0 && f.engines.iter().all(|e| e.wrong_cases == 0))
    }

    /// Wrong pixels over all families and engines.
    #[must_use]
    pub fn mismatches(&self) -> u64 {
        self.families.iter().flat_map(|f| &f.engines).map(|e| e.tally.total()).sum()
    }

    /// Triangles judged.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        self.families.iter().map(|f| f.triangles).sum()
    }
}

/// What an engine made of a case.
#[derive(Clone, Debug, Default)]
pub struct ExactFinding {
    /// Wrong pixels.
    pub tally: Tally,
    /// How it decided.
    pub decisions: Decisions,
    /// What it said when it panicked.
    pub panic: Option<String>,
}

impl ExactFinding {
    /// Whether it does not agree with the oracle.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        self.panic.is_some() || self.tally.total() > 0
    }

    /// The disagreement in words.
    #[must_use]
    pub fn describe(&self) -> String {
        match &self.panic {
            Some(message) => format!("panics ({message})"),
            None if !self.is_wrong() => "agrees".to_owned(),
            None => self.tally.describe(),
        }
    }
}

/// Hits of an engine over all triangles of a case, and how it decided.
///
/// # Errors
/// The message of the engine's panic, a pixel outside the window among them.
pub fn exact_coverage(
    engine: &impl RasterizeExact,
    case: &OffGridCase,
) -> Result<(Coverage, Decisions), EnginePanic> {
    caught(|| {
        let mut hits = Coverage::new(case.window, 0);
        let mut decisions = Decisions::default();
        for corners in &case.triangles {
            let hit = |span: Span| hits.hit(span.y_px, span.x0_px, span.x1_px);
            decisions += engine.cover_exact(corners, case.window, hit);
        }
        (hits, decisions)
    })
}

/// Hits of the oracle over all triangles of a case, and its samples on edges.
fn truth(case: &OffGridCase) -> (Coverage, u64) {
    let mut hits = Coverage::new(case.window, 0);
    let mut ties = 0;
    for corners in &case.triangles {
        let hit = |span: Span| hits.hit(span.y_px, span.x0_px, span.x1_px);
        ties += cover_and_count_ties(corners, case.window, hit);
    }
    (hits, ties)
}

/// Judges one case by one engine; what [`judge_exact`] does for each generated case.
#[must_use]
pub fn judge_exact_case(engine: &impl RasterizeExact, case: &OffGridCase) -> ExactFinding {
    against(engine, case, &truth(case).0)
}

fn against(engine: &impl RasterizeExact, case: &OffGridCase, target: &Coverage) -> ExactFinding {
    match exact_coverage(engine, case) {
        Ok((hits, decisions)) => {
            ExactFinding { tally: Tally::between(&hits, target), decisions, panic: None }
        }
        Err(panic) => ExactFinding { panic: Some(panic.0), ..ExactFinding::default() },
    }
}

/// Judges engines for corners off the lattice, each with its name, against the oracle.
///
/// Families, seed, shard and limits are those of `options`; names of families on the lattice are
/// passed over.
///
/// # Errors
/// By these options, or without engines, no case was judged; or the options declare a convention, which is one of
/// corners on the lattice.
#[must_use = "the verdict may be that something is wrong"]
pub fn judge_exact<R: RasterizeExact + Sync>(
    engines: &[(&str, R)],
    options: &Options,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<ExactVerdict, NothingJudged> {
    if engines.is_empty() {
        return Err(NothingJudged::NoEngine);
    }
    let fitting: Vec<_> = FAMILIES.iter().map(|family| family.name).collect();
    NothingJudged::by(options, &fitting)?;
    if options.convention != Convention::default() {
        return Err(NothingJudged::NoConventions);
    }
    let verdict = judge_exact_engines(engines, options, progress);
    let is_empty = verdict.families.iter().all(|family| family.cases == 0);
    if is_empty { Err(NothingJudged::NoneReached) } else { Ok(verdict) }
}

/// What [`judge_exact`] does, for a caller that judges other engines too and notices where nothing was
/// judged at all.
#[doc(hidden)]
pub fn judge_exact_engines<R: RasterizeExact + Sync>(
    engines: &[(&str, R)],
    options: &Options,
    progress: &(dyn Fn(u64) + Sync),
) -> ExactVerdict {
    if engines.is_empty() {
        return ExactVerdict::default();
    }
    let chosen: Vec<_> = exact_families(options).collect();
    let partials = in_blocks(&chosen, options, progress, |family, indices| {
        judge_block(family, engines, indices, options)
    });
    let failures = shrink_failures(&partials, &chosen, engines, options);
    ExactVerdict { families: partials.into_iter().map(|p| p.report).collect(), failures }
}

/// The families off the lattice that `options` ask for.
pub fn exact_families(options: &Options) -> impl Iterator<Item = &'static OffGridFamily> {
    FAMILIES.iter().filter(|f| options.wants(f.name))
}

impl ExactFamilyReport {
    fn new<R>(family: &OffGridFamily, engines: &[(&str, R)]) -> Self {
        let engines = engines.iter().map(|(name, _)| ExactEngineReport {
            engine: (*name).to_owned(),
            ..ExactEngineReport::default()
        });
        Self { family: family.name.to_owned(), engines: engines.collect(), ..Self::default() }
    }
}

impl AddAssign for ExactFamilyReport {
    /// Sums over the same engines on other cases.
    fn add_assign(&mut self, other: Self) {
        self.cases += other.cases;
        self.triangles += other.triangles;
        self.pixels += other.pixels;
        self.tie_cases += other.tie_cases;
        self.empty_cases += other.empty_cases;
        self.oracle_faults += other.oracle_faults;
        for (a, b) in self.engines.iter_mut().zip(&other.engines) {
            a.tally += b.tally;
            a.decisions += b.decisions;
            a.panics += b.panics;
            a.wrong_cases += b.wrong_cases;
        }
    }
}

fn judge_block<R: RasterizeExact>(
    family: &OffGridFamily,
    engines: &[(&str, R)],
    indices: &[u64],
    options: &Options,
) -> Partial<ExactFamilyReport> {
    let mut report = ExactFamilyReport::new(family, engines);
    let mut failing = Vec::new();
    for &index in indices {
        let case = family.case(options.seed, index);
        let (target, ties) = truth(&case);
        let hits = || target.rows().flat_map(|(_, row)| row);
        let pixels: u64 = hits().map(|&hits| u64::from(hits)).sum();
        report.cases += 1;
        report.triangles += case.triangles.len() as u64;
        report.pixels += pixels;
        report.tie_cases += u64::from(ties > 0);
        report.empty_cases += u64::from(pixels == 0);
        if case.is_tiling {
            report.oracle_faults += hits().filter(|&&hits| hits != 1).count() as u64;
        }
        for (at, (_, engine)) in engines.iter().enumerate() {
            let finding = against(engine, &case, &target);
            let counts = &mut report.engines[at];
            counts.tally += finding.tally;
            counts.decisions += finding.decisions;
            counts.panics += u64::from(finding.panic.is_some());
            counts.wrong_cases += u64::from(finding.is_wrong());
            if finding.is_wrong() && counts.wrong_cases <= KEPT as u64 {
                failing.push((at, index));
            }
        }
    }
    Partial { report, failing }
}

/// Shrinks the first failing cases of each family and engine, and keeps the smallest of each.
fn shrink_failures<R: RasterizeExact + Sync>(
    partials: &[Partial<ExactFamilyReport>],
    chosen: &[&OffGridFamily],
    engines: &[(&str, R)],
    options: &Options,
) -> Vec<ExactFailure> {
    let failing = partials.iter().enumerate();
    let failing: Vec<_> = failing
        .flat_map(|(place, partial)| partial.failing.iter().map(move |&(at, i)| (place, at, i)))
        .collect();
    let shrunk = |(place, at, index): (usize, usize, u64)| {
        let (name, engine) = &engines[at];
        let fails = |case: &OffGridCase| judge_exact_case(engine, case).is_wrong();
        let case = shrink(chosen[place].case(options.seed, index), fails);
        ExactFailure {
            family: chosen[place].name.to_owned(),
            index,
            seed: options.seed,
            engine: (*name).to_owned(),
            what: judge_exact_case(engine, &case).describe(),
            case,
        }
    };
    smallest_first(&failing, shrunk, |failure| size(&failure.case))
}
