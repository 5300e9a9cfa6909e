//! A tessellator judged over the families, and what is said about it.

use std::error::Error;
use std::fmt;
use std::time::Duration;

use super::cause::{self, Made};
use super::shrink::PolygonSteps;
use super::{
    Family, Fault, FaultKind, Faults, Options, Polygon, Refused, Tessellate, Tessellation,
    Triangle, judge_partition,
};
use crate::cases::shrink::SmallerSearch;
use crate::judge::machine::{JudgeKind, Place};
use crate::judge::{self, Clock, LeftOut, NothingJudged, Watch, ascii, caught};
use crate::mistakes::Mistakes;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::parallel;

/// Triangles that a message lists.
const MOST_TRIANGLES: usize = 12;

/// How the polygons of a family went.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Polygons {
    /// The family.
    pub family: Family,
    /// Polygons judged.
    pub polygons: u64,
    /// Polygons that the tessellator does not [accept](Tessellate::accepts).
    pub left_out: u64,
    /// Triangles judged.
    pub triangles: u64,
    /// Polygons with a fault.
    pub wrong: u64,
    /// Polygons with a fault of each kind, in the order of [`FaultKind::ALL`].
    pub faults: [u64; FaultKind::ALL.len()],
    /// Polygons by the gravest of their faults, so that each is counted once.
    pub gravest: [u64; FaultKind::ALL.len()],
    /// The faults of what is allowed, as [`Polygons::faults`].
    pub allowed: [u64; FaultKind::ALL.len()],
    /// Corners of triangles that are no vertices.
    pub added_points: u64,
}

impl Polygons {
    fn new(family: Family) -> Self {
        let none = [0; FaultKind::ALL.len()];
        let (faults, gravest, allowed) = (none, none, none);
        Self {
            family,
            polygons: 0,
            left_out: 0,
            triangles: 0,
            wrong: 0,
            faults,
            gravest,
            allowed,
            added_points: 0,
        }
    }

    fn count(&mut self, finding: &Faults, triangles: usize) {
        self.polygons += 1;
        self.triangles += triangles as u64;
        self.wrong += u64::from(!finding.faults.is_empty());
        self.added_points += finding.added_points as u64;
        let gravest = finding.faults.iter().map(|fault| fault.kind).min();
        for (count, kind) in self.gravest.iter_mut().zip(FaultKind::ALL) {
            *count += u64::from(gravest == Some(kind));
        }
        // A kind counts once for each polygon, however often it occurs there.
        for (i, kind) in FaultKind::ALL.into_iter().enumerate() {
            self.faults[i] += u64::from(finding.faults.iter().any(|fault| fault.kind == kind));
            self.allowed[i] += u64::from(finding.allowed.iter().any(|fault| fault.kind == kind));
        }
    }

    fn add(&mut self, other: &Self) {
        self.polygons += other.polygons;
        self.left_out += other.left_out;
        self.triangles += other.triangles;
        self.wrong += other.wrong;
        self.added_points += other.added_points;
        for i in 0..FaultKind::ALL.len() {
            self.faults[i] += other.faults[i];
            self.gravest[i] += other.gravest[i];
            self.allowed[i] += other.allowed[i];
        }
    }

    /// What is wrong with how many polygons, each counted by its gravest fault; `of` follows the first number.
    #[doc(hidden)]
    #[must_use]
    pub fn describe(&self, of: &str) -> String {
        let mut said: Vec<(&str, u64)> = Vec::new();
        for (kind, &count) in FaultKind::ALL.into_iter().zip(&self.gravest) {
            let what = kind.says();
            match said.last_mut() {
                Some((last, sum)) if *last == what => *sum += count,
                _ => said.push((what, count)),
            }
        }
        said.retain(|(_, count)| *count > 0);
        let mut parts: Vec<String> = Vec::new();
        for (what, count) in &said {
            let of = if parts.is_empty() { of } else { " more" };
            parts.push(format!("{count}{of} {what}"));
        }
        // No triangles and wrong triangles come before what is wrong although each point is covered once.
        let covered = [FaultKind::Flipped, FaultKind::TJunction, FaultKind::Degenerate];
        if said.iter().all(|(what, _)| covered.iter().any(|kind| kind.says() == *what)) {
            parts.push("and all are covered exactly once".to_owned());
        }
        parts.join(", ")
    }
}

/// A failing polygon with the triangles of the smallest one.
pub type Failure = judge::Failure<Polygon, Triangulated>;

/// What a tessellator makes of a failing polygon.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Triangulated {
    /// The kind of fault that was kept while the polygon was made smaller.
    pub kind: FaultKind,
    /// Its triangles; none where the tessellator panics or refuses.
    pub triangles: Vec<Triangle>,
    /// What is wrong with them.
    pub faults: Faults,
    /// Other triangles that it made of the same polygon when it was asked again. Such a polygon is not made smaller.
    pub again: Option<(Vec<Triangle>, Faults)>,
}

/// The outcome of a run. Its failures are the smallest polygon of each kind of fault, grave ones first; its cause explains the wrong
/// polygons, or says what is known of them. Every failing polygon is asked a second time. Where the triangles are others then,
/// the failures are such polygons, and no cause is looked for.
pub type Verdict = judge::Verdict<Options, Polygons, Failure, Option<Mistakes>, LeftOut>;

impl Verdict {
    /// Nothing, or what a failing test has to print.
    ///
    /// # Errors
    /// [`Disagreement`] where anything was wrong.
    pub fn check(&self) -> Result<(), Box<Disagreement>> {
        if self.sum().wrong == 0 { Ok(()) } else { Err(Box::new(Disagreement(self.clone()))) }
    }

    /// All families as one, under the name of the first.
    #[must_use]
    pub fn sum(&self) -> Polygons {
        let first = self.families.first().map_or(Family::Collinear, |report| report.family);
        let mut sum = Polygons::new(first);
        for report in &self.families {
            sum.add(report);
        }
        sum
    }
}

/// What was wrong with a tessellator. Its text is the whole message: print it.
#[derive(Clone, Debug)]
pub struct Disagreement(Verdict);

impl Disagreement {
    /// The verdict that it is about.
    pub fn verdict(&self) -> &Verdict {
        &self.0
    }
}

impl Error for Disagreement {}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let options = &self.0.options;
        let repeat = |family: &str, index: u64| {
            let (seed, declared) = (options.seed, declared(options));
            format!(
                "Options::default().seed({seed}).family(Family::{family}).only({index}){declared}"
            )
        };
        self.0.write(f, &Polygon::to_string, &repeat)
    }
}

impl Verdict {
    /// Writes what is wrong, with polygons and what repeats one in the words of some language.
    #[doc(hidden)]
    pub fn write(
        &self,
        f: &mut dyn fmt::Write,
        show: &dyn Fn(&Polygon) -> String,
        repeat: &dyn Fn(&str, u64) -> String,
    ) -> fmt::Result {
        let Self { options, families, failures, cause, more } = self;
        // Answers that change come first: nothing else that is said would be reliable.
        let sum = self.sum();
        if failures.iter().any(|failure| failure.evidence.again.is_some()) {
            writeln!(
                f,
                "The answers change from one time to the next: asked again, a polygon that failed has"
            )?;
            writeln!(
                f,
                "other triangles. So nothing was made smaller, and no cause was looked for.\n"
            )?;
        }
        writeln!(f, "{}", sum.describe(&format!(" of {} polygons", sum.polygons)))?;
        writeln!(f, "  polygons by fault: {}", by_kind(&sum.faults))?;
        let left_out = more.to_string();
        if !left_out.is_empty() {
            writeln!(f, "  {}", ascii::broken(&left_out, 78, "  "))?;
        }
        if sum.left_out > 0 {
            writeln!(f, "  not judged, as the tessellator does not accept them: {}", sum.left_out)?;
        }
        if sum.allowed.iter().any(|&count| count > 0) {
            writeln!(f, "  allowed, and no faults: {}", by_kind(&sum.allowed))?;
        }
        if let Some(cause) = cause {
            let what = if cause.is_known() { "probable cause" } else { "no cause was recognised" };
            let said = format!("{what}: {}", cause.sentences().join("\n"));
            writeln!(f, "\n{}\n", ascii::broken(&said, 80, "  "))?;
        }
        let mut wrong = Vec::new();
        for Polygons { family, wrong: count, .. } in families {
            if *count > 0 {
                wrong.push(format!("{} {count}", family.name()));
            }
        }
        writeln!(f, "  polygons by family: {}", wrong.join(", "))?;
        for failure in failures {
            let Triangulated { kind, triangles, again, .. } = &failure.evidence;
            let which = if again.is_some() { "a polygon" } else { "the smallest polygon" };
            writeln!(f, "\n{}: {which} that was found\n  {}", kind.name(), show(&failure.case))?;
            write_triangles(f, triangles, &failure.what)?;
            if let Some((triangles, faults)) = again {
                writeln!(f, "  asked again:")?;
                write_triangles(f, triangles, &faults.to_string())?;
            }
            let rule = options.terms.fill_rule;
            if let Some(picture) = cause::picture(&failure.case, triangles, rule) {
                f.write_str(&picture)?;
            }
            writeln!(f, "  found in: {}", repeat(failure.family, failure.index))?;
        }
        Ok(())
    }
}

/// The triangles of a polygon, and what is wrong with them.
fn write_triangles(f: &mut dyn fmt::Write, triangles: &[Triangle], what: &str) -> fmt::Result {
    for (number, triangle) in triangles.iter().take(MOST_TRIANGLES).enumerate() {
        writeln!(f, "  triangle {number}: {triangle:?}")?;
    }
    if triangles.len() > MOST_TRIANGLES {
        writeln!(f, "  and {} more triangles", triangles.len() - MOST_TRIANGLES)?;
    }
    for line in what.lines() {
        writeln!(f, "  {line}")?;
    }
    Ok(())
}

/// What has to be declared to repeat a polygon.
fn declared(options: &Options) -> String {
    let mut text = String::new();
    let (terms, defaults) = (options.terms, Tessellation::default());
    if terms.coordinates != defaults.coordinates {
        text += &format!(".coordinates(Coordinates::{:?})", terms.coordinates);
    }
    if terms.fill_rule != defaults.fill_rule {
        text += &format!(".fill_rule(FillRule::{:?})", terms.fill_rule);
    }
    if terms.winding != defaults.winding {
        text += &format!(".winding(Winding::{:?})", terms.winding);
    }
    text
}

fn by_kind(counts: &[u64]) -> String {
    let mut words = Vec::new();
    for (kind, count) in FaultKind::ALL.iter().zip(counts) {
        if *count > 0 {
            words.push(format!("{} {count}", kind.name()));
        }
    }
    words.join(", ")
}

/// Judges a tessellator over the families of polygons.
///
/// # Errors
/// By these options no polygon was judged.
pub fn judge_partitions<T: Tessellate + Sync>(
    tessellator: &T,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    let watch = Watch::begin();
    judge(&|polygons| answers(tessellator, polygons, &watch), options, &watch)
}

/// What a tessellator makes of polygons, one after the other.
fn answers<T: Tessellate>(
    tessellator: &T,
    polygons: &[Polygon],
    watch: &Watch,
) -> Vec<Answer<Fault>> {
    let mut answers = Vec::with_capacity(polygons.len());
    for polygon in polygons {
        if !tessellator.accepts(polygon) {
            answers.push(None);
            continue;
        }
        answers.push(Some(match watch.during(|| caught(|| tessellator.triangles(polygon))) {
            Err(message) => Err(Fault::saying(FaultKind::Panicked, message.to_string())),
            Ok(Err(Refused(why))) => Err(Fault::saying(FaultKind::Refused, why)),
            Ok(Ok(triangles)) => Ok(triangles),
        }));
    }
    answers
}

/// The same of somebody who answers polygons, several at once: nothing is the answer to one that he does not take.
///
/// # Errors
/// By these options no polygon was judged.
#[doc(hidden)]
pub fn judge_partitions_of(
    answer: &AskTessellator<'_>,
    options: &Options,
) -> Result<Verdict, NothingJudged> {
    // An answer counts as time in the judged code.
    let watch = Watch::begin();
    let asked = |polygons: &[Polygon]| {
        let answers = watch.spend(|| answer(polygons));
        let answers = answers.unwrap_or_else(|| vec![None; polygons.len()]);
        answers.into_iter().map(with_fault).collect()
    };
    judge(&asked, options, &watch)
}

/// An answer whose refusal is a fault.
fn with_fault(answer: Answer<Refused>) -> Answer<Fault> {
    Some(match answer? {
        Ok(triangles) => Ok(triangles),
        Err(Refused(why)) => Err(Fault::saying(FaultKind::Refused, why)),
    })
}

/// What is made of a polygon, if it is taken. Fewer answers than polygons are those of whose time is up.
type Answer<E> = Option<Result<Vec<Triangle>, E>>;
type AskTessellator<'a> = dyn Fn(&[Polygon]) -> Vec<Answer<Refused>> + Sync + 'a;
type FindFaults<'a> = dyn Fn(&[Polygon]) -> Vec<Answer<Fault>> + Sync + 'a;

/// The triangles of polygons and what was found about them; nothing where a polygon is not valid or not accepted.
fn ask(
    tessellator: &FindFaults,
    polygons: &[Polygon],
    options: &Options,
) -> Vec<Option<(Vec<Triangle>, Faults)>> {
    let mut judged = Vec::with_capacity(polygons.len());
    for (polygon, made) in polygons.iter().zip(tessellator(polygons)) {
        judged.push(made.and_then(|made| found_in(polygon, made, options)));
    }
    judged
}

/// The triangles of a polygon and what is found about them; nothing of a polygon that is not valid, and need not be taken.
fn found_in(
    polygon: &Polygon,
    made: Result<Vec<Triangle>, Fault>,
    options: &Options,
) -> Option<(Vec<Triangle>, Faults)> {
    let faults = judge_partition(polygon, made.as_deref().unwrap_or(&[]), options).ok()?;
    Some(match made {
        Ok(triangles) => (triangles, faults),
        Err(fault) => (Vec::new(), Faults { faults: vec![fault], ..Faults::default() }),
    })
}

fn judge(
    tessellator: &FindFaults,
    options: &Options,
    watch: &Watch,
) -> Result<Verdict, NothingJudged> {
    options.check()?;
    let wanted = wanted(options);
    let clock = Clock::new(options.time_limit);
    let mut parts = Vec::new();
    for family in &wanted {
        let polygons = Polygons::new(*family);
        parts.push(Part { polygons, smallest: Default::default(), changing: None });
    }
    let find = |_: Place, jobs: &[&PolygonJob]| {
        let polygons: Vec<Polygon> = jobs.iter().map(|job| job.polygon.clone()).collect();
        ask(tessellator, &polygons, options)
    };
    let judged = JudgedTessellator { families: &wanted, options, clock: &clock };
    let of = (options, &clock);
    parts = judge::in_process(&judged, parts, wanted.len(), of, &|_| (), &find);
    // Of a limited time, the last families may not have been reached.
    parts.retain(|part| part.polygons.polygons + part.polygons.left_out > 0);
    // What failed, and what did not answer the same twice.
    let Failures { failing, mut changing } = failures_of(&mut parts);
    let families: Vec<Polygons> = parts.into_iter().map(|part| part.polygons).collect();
    let judged: u64 = families.iter().map(|family| family.polygons + family.left_out).sum();
    let cases = options.count().saturating_mul(wanted.len() as u64) - judged;
    let option = judge::TIME_LIMIT;
    let mut more = LeftOut { cases, limit: options.time_limit, option, ..LeftOut::default() };
    if !changing.is_empty() {
        changing.sort_by_key(|failure| failure.evidence.kind);
        changing.dedup_by_key(|failure| failure.evidence.kind);
        let options = options.clone();
        return Ok(Verdict { options, families, failures: changing, cause: None, more });
    }
    if families.iter().all(|family| family.polygons == 0) {
        return Err(NothingJudged::NoneAccepted);
    }
    clock.limit(watch, true);
    let failures = parallel::map(failing.len(), |number| {
        let OfKind { kind, family, found } = &failing[number];
        smallest(tessellator, options, *kind, *family, found, watch)
    });
    let mut cause = None;
    if !failures.is_empty() {
        more.shrinking = watch.is_over();
        clock.limit(watch, false);
        cause = cause::cause(&some(tessellator, options), options);
        // What was concluded from some of the answers would be no conclusion.
        more.cause = watch.is_over();
        cause = cause.filter(|_| !more.cause);
    }
    Ok(Verdict { options: options.clone(), families, failures, cause, more })
}

/// What is wrong over all families.
struct Failures {
    /// Of each kind of fault the smallest polygon, the gravest kind first.
    failing: Vec<OfKind>,
    /// Polygons whose triangles change from one time to the next.
    changing: Vec<Failure>,
}

/// A polygon that failed in such a way.
struct OfKind {
    kind: FaultKind,
    family: Family,
    found: Failing,
}

/// Takes the failures out of what the families came to.
fn failures_of(parts: &mut [Part]) -> Failures {
    let mut failures = Failures { failing: Vec::new(), changing: Vec::new() };
    // Kinds are in the order of their gravity.
    for (i, kind) in FaultKind::ALL.into_iter().enumerate() {
        let mut best: Option<OfKind> = None;
        for part in &mut *parts {
            let Some(found) = part.smallest[i].take() else { continue };
            // Of several as small, that of the first family.
            if best.as_ref().is_none_or(|best| found.vertices < best.found.vertices) {
                best = Some(OfKind { kind, family: part.polygons.family, found });
            }
        }
        failures.failing.extend(best);
    }
    for part in parts {
        failures.changing.extend(part.changing.take().map(|changing| changing.failure));
    }
    failures
}

fn wanted(options: &Options) -> Vec<Family> {
    let wanted = |family: &Family| options.families.is_empty() || options.families.contains(family);
    Family::ALL.into_iter().filter(wanted).collect()
}

/// What becomes of the first polygons of every family, the ones that a cause has to explain.
fn some(tessellator: &FindFaults, options: &Options) -> Vec<Made> {
    let mut made = Vec::new();
    for family in wanted(options) {
        let polygon = |index| polygon(family, index, options);
        let polygons: Vec<Polygon> = (0..OF_A_FAMILY).map(polygon).collect();
        let answers = ask(tessellator, &polygons, options);
        for (polygon, answer) in polygons.into_iter().zip(answers) {
            if let Some((triangles, finding)) = answer {
                made.push(Made { polygon, triangles, finding });
            }
        }
    }
    made
}

fn polygon(family: Family, index: u64, options: &Options) -> Polygon {
    family.polygon(options.seed, index, options.terms.coordinates)
}

/// Polygons of each family by which a cause is looked for.
const OF_A_FAMILY: u64 = 40;

/// What some polygons of a family came to.
struct Part {
    polygons: Polygons,
    /// Of each kind of fault the polygon with the fewest vertices.
    smallest: [Option<Failing>; FaultKind::ALL.len()],
    changing: Option<Changing>,
}

/// The polygon with the fewest vertices of which other triangles were made the second time.
struct Changing {
    vertices: usize,
    batch: u64,
    /// Both answers.
    failure: Failure,
}

/// A generated polygon.
struct PolygonJob {
    index: u64,
    polygon: Polygon,
}

impl PolygonJob {
    fn vertices(&self) -> usize {
        self.polygon.contours.iter().map(Vec::len).sum()
    }
}

/// A polygon with a fault, as it was generated, and what became of it.
struct Failing {
    vertices: usize,
    index: u64,
    triangles: Vec<Triangle>,
    faults: Faults,
}

/// A tessellator that is judged.
struct JudgedTessellator<'a> {
    families: &'a [Family],
    options: &'a Options,
    clock: &'a Clock,
}

impl JudgeKind for JudgedTessellator<'_> {
    type Job = PolygonJob;
    type Judgement = Option<(Vec<Triangle>, Faults)>;
    type Tally = Vec<Part>;

    fn jobs(&self, place: Place, index: u64, jobs: &mut Vec<PolygonJob>) {
        let polygon = polygon(self.families[place.family], index, self.options);
        jobs.push(PolygonJob { index, polygon });
    }

    fn count(
        &self,
        tally: &mut Vec<Part>,
        place: Place,
        (job, found): (PolygonJob, Self::Judgement),
    ) -> Option<(PolygonJob, Self::Judgement)> {
        let part = &mut tally[place.family];
        // Families draw until a polygon is valid.
        let Some((triangles, faults)) = &found else {
            part.polygons.left_out += 1;
            return None;
        };
        part.polygons.count(faults, triangles.len());
        let (vertices, index) = (job.vertices(), job.index);
        for (best, kind) in part.smallest.iter_mut().zip(FaultKind::ALL) {
            if faults.has(kind) && best.as_ref().is_none_or(|best| vertices < best.vertices) {
                let (triangles, faults) = (triangles.clone(), faults.clone());
                *best = Some(Failing { vertices, index, triangles, faults });
            }
        }
        // Who has no answer to a polygon is not asked for it again: that may take long.
        let is_asked_again = !faults.faults.is_empty() && faults.is_of_an_answer();
        is_asked_again.then_some((job, found))
    }

    fn compare(
        &self,
        tally: &mut Vec<Part>,
        (batch, place): (u64, Place),
        (job, first): &(PolygonJob, Self::Judgement),
        again: Self::Judgement,
    ) {
        let (Some((triangles, faults)), Some(again)) = (first.clone(), again) else { return };
        if !again.1.is_of_an_answer() || is_same(&again.0, &triangles) {
            return;
        }
        let Part { polygons, changing, .. } = &mut tally[place.family];
        let vertices = job.vertices();
        let is_smaller = |other: &Changing| (vertices, batch) < (other.vertices, other.batch);
        if changing.as_ref().is_none_or(is_smaller) {
            let (seed, what, kind) = (self.options.seed, faults.to_string(), faults.faults[0].kind);
            let evidence = Triangulated { kind, triangles, faults, again: Some(again) };
            let (family, case) = (polygons.family.name(), job.polygon.clone());
            let failure = Failure { family, index: job.index, seed, what, case, evidence };
            *changing = Some(Changing { vertices, batch, failure });
        }
    }

    fn cases(&self, tally: &Vec<Part>) -> u64 {
        tally.iter().map(|part| part.polygons.polygons + part.polygons.left_out).sum()
    }

    fn end(&self, tally: &Vec<Part>, _: usize) -> Option<Duration> {
        self.clock.end_of_cases(tally.iter().any(|part| part.polygons.wrong > 0))
    }
}

/// Whether the corners are the same, also where they are no numbers.
fn is_same(a: &[Triangle], b: &[Triangle]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let [a, b] = [a, b].map_array(|all| all.as_flattened().as_flattened());
    a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

fn smallest(
    tessellator: &FindFaults,
    options: &Options,
    kind: FaultKind,
    family: Family,
    found: &Failing,
    watch: &Watch,
) -> Failure {
    let (seed, coordinates) = (options.seed, options.terms.coordinates);
    let index = found.index;
    // What became of the smallest polygon so far: once the time is up, nobody answers.
    let (mut triangles, mut faults) = (found.triangles.clone(), found.faults.clone());
    let steps = PolygonSteps { coordinates, family };
    let mut search = SmallerSearch::new(polygon(family, index, options), &steps);
    while !watch.is_over() {
        let smaller = search.next(&steps, 1);
        if smaller.is_empty() {
            break;
        }
        let made = ask(tessellator, &smaller, options).pop().flatten();
        let made = made.filter(|(_, faults)| faults.has(kind));
        search.answer(&steps, &[made.is_some()]);
        (triangles, faults) = made.unwrap_or((triangles, faults));
    }
    let case = search.smallest;
    let (family, what) = (family.name(), faults.to_string());
    let evidence = Triangulated { kind, triangles, faults, again: None };
    Failure { family, index, seed, what, case, evidence }
}

/// Ends a test with the whole message unless every polygon was covered exactly once.
///
/// # Panics
/// Where anything was wrong, or nothing was judged.
#[doc(hidden)]
#[track_caller]
pub fn must_partition<T: Tessellate + Sync>(tessellator: &T, options: &Options) {
    match judge_partitions(tessellator, options).map(|report| report.check()) {
        Ok(Ok(())) => {}
        Ok(Err(disagreement)) => panic!("{disagreement}"),
        Err(nothing) => panic!("{nothing}"),
    }
}
