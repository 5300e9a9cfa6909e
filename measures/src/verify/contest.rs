//! One case, several engines: who draws what the oracle draws?

use std::cell::Cell;
use std::ops::AddAssign;
use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::DVec2;
use serde::Serialize;

use super::tolerance::{self, Bound, Tolerance};
use crate::contract::{DrawLine, Interpolate, Rasterize};
use crate::frame::Coverage;
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use crate::hazard::{Case, Line, Shape, Triangle};
use crate::oracle::Oracle;
use crate::oracle::coverage::samples_on_boundary;
use crate::oracle::values::{ExactTriangle, along_line};
use crate::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};

/// Wrong pixels, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Hits that the target has and the actual one lacks.
    pub missing: u64,
    /// Pixels hit that the target does not hit.
    pub extra: u64,
    /// Hits beyond the target's on pixels that are hit before.
    pub twice: u64,
    /// Pixels of a line that come out in another order.
    pub order: u64,
}

impl Tally {
    /// All wrong pixels.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.missing + self.extra + self.twice + self.order
    }

    /// Compares hit counts pixel by pixel; both frames show the same window.
    #[must_use]
    pub fn between(actual: &Coverage, target: &Coverage) -> Self {
        let mut tally = Self::default();
        if actual == target {
            return tally;
        }
        for ((_, actual), (_, target)) in actual.rows().zip(target.rows()) {
            for (&actual, &target) in actual.iter().zip(target) {
                tally.missing += u64::from(target.saturating_sub(actual));
                let more = u64::from(actual.saturating_sub(target));
                if target == 0 {
                    tally.extra += more.min(1);
                    tally.twice += more.saturating_sub(1);
                } else {
                    tally.twice += more;
                }
            }
        }
        tally
    }
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.missing += other.missing;
        self.extra += other.extra;
        self.twice += other.twice;
        self.order += other.order;
    }
}

impl Tally {
    /// The kinds that occur, in words; empty where nothing is wrong.
    #[must_use]
    pub fn describe(&self) -> String {
        let Self { missing, extra, twice, order } = *self;
        let counts =
            [(missing, "missing"), (extra, "extra"), (twice, "twice"), (order, "out of order")];
        let parts = counts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}"));
        parts.collect::<Vec<_>>().join(", ")
    }
}

/// What was found about a pair of engines in one case.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    /// Wrong pixels: the coverage of the one against that of the other.
    pub tally: Tally,
    /// The pixels of the engine's fragments against its own coverage; nobody else has a part in it.
    pub fragments: Tally,
    /// Largest difference of an attribute over its bound.
    pub attribute: f64,
    /// Largest difference of a depth over its bound.
    pub depth: f64,
    /// Values compared.
    pub values: u64,
    /// What an engine said when it panicked.
    pub panic: Option<String>,
}

impl Finding {
    /// Whether the two do not agree.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        self.tally.total() + self.fragments.total() > 0
            || self.panic.is_some()
            || self.attribute > 1.0
            || self.depth > 1.0
    }

    /// The disagreement in words.
    #[must_use]
    pub fn describe(&self) -> String {
        if let Some(message) = &self.panic {
            return format!("panics ({message})");
        }
        let mut parts = Vec::new();
        if self.tally.total() > 0 {
            parts.push(self.tally.describe());
        }
        if self.fragments.total() > 0 {
            let what = self.fragments.describe();
            parts.push(format!("its fragments against its own coverage: {what}"));
        }
        if self.attribute > 1.0 {
            parts.push(format!("an attribute off by {:.3e} times its bound", self.attribute));
        }
        if self.depth > 1.0 {
            parts.push(format!("a depth off by {:.3e} times its bound", self.depth));
        }
        if parts.is_empty() { "agrees".to_owned() } else { parts.join("; ") }
    }

    fn panicked(message: String) -> Self {
        Self { panic: Some(message), ..Self::default() }
    }

    fn compare(&mut self, attribute: f64, depth: f64) {
        // A NaN ratio is a failure, and `f64::max` would drop it.
        let worse = |old: f64, new: f64| if new.is_nan() { f64::INFINITY } else { old.max(new) };
        self.attribute = worse(self.attribute, attribute);
        self.depth = worse(self.depth, depth);
        self.values += 1;
    }
}

/// What the oracle says of a case.
#[derive(Clone, Debug, Default)]
pub struct CaseFacts {
    pub shapes: u64,
    pub pixels: u64,
    pub ties: u64,
    pub sliver: bool,
    pub overlap: u64,
}

/// Judges cases; a finding for each pair, in the order of [`Contest::pairs`].
pub trait Contest: Sync {
    fn pairs(&self) -> Vec<[String; 2]>;
    fn judge(&self, case: &Case) -> (CaseFacts, Vec<Finding>);
}

/// Each engine against the oracle, then each against the next.
fn pairs_of<'a>(names: impl Iterator<Item = &'a str>) -> Vec<[String; 2]> {
    let names: Vec<String> = names.map(str::to_owned).collect();
    let oracle = names.iter().map(|name| [name.clone(), "oracle".to_owned()]);
    let each_other = names.windows(2).map(|two| [two[0].clone(), two[1].clone()]);
    oracle.chain(each_other).collect()
}

thread_local! {
    static JUDGING: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread is inside an engine whose panic will become a verdict. A panic hook that asks
/// can keep such a panic off the terminal.
#[must_use]
pub fn is_judging() -> bool {
    JUDGING.get()
}

/// Runs an engine; its panic becomes an error with the message.
///
/// # Errors
/// What the engine said when it panicked.
pub fn caught<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    let outer = JUDGING.replace(true);
    let result = catch_unwind(AssertUnwindSafe(run));
    JUDGING.set(outer);
    result.map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|s| (*s).to_owned());
        text.or_else(|| payload.downcast_ref::<String>().cloned())
            .unwrap_or_else(|| "panic".to_owned())
    })
}

/// Hits of an engine over all triangles of a case.
///
/// # Errors
/// The message of the engine's panic, a pixel outside the window among them.
pub fn engine_coverage(
    engine: &impl Rasterize,
    triangles: &[Triangle],
    window: PixelRect,
) -> Result<Coverage, String> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for triangle in triangles {
            engine.cover(triangle.corners(), window, |span| {
                hits.hit(span.y_px, span.x0_px, span.x1_px)
            });
        }
        hits
    })
}

/// Hits of the oracle over all triangles of a case.
#[must_use]
pub fn oracle_coverage(triangles: &[Triangle], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for triangle in triangles {
        Oracle
            .cover(triangle.corners(), window, |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    }
    hits
}

/// Pixels of each triangle or line of a case alone, by the oracle.
#[must_use]
pub fn oracle_pixels_each(case: &Case) -> Vec<u64> {
    match &case.shape {
        Shape::Triangles { list, .. } => {
            list.iter().map(|t| oracle_coverage(&[*t], case.window).covered()).collect()
        }
        Shape::Lines(lines) => {
            let count = |line| {
                let mut count = 0;
                Oracle.line_pixels(line, case.window, |_, _| count += 1);
                count
            };
            lines.iter().map(count).collect()
        }
    }
}

/// Hits of a line drawer over all lines of a case.
///
/// # Errors
/// As [`engine_coverage`].
pub fn line_coverage(
    engine: &impl DrawLine,
    lines: &[Line],
    window: PixelRect,
) -> Result<Coverage, String> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for line in lines {
            engine.draw(line, window, |f| hits.hit(f.y_px, f.x_px, f.x_px + 1));
        }
        hits
    })
}

/// An engine that is judged by its coverage alone.
pub struct CoverageOnly<'a, R>(pub &'a R);

impl<R: Rasterize> Rasterize for CoverageOnly<'_, R> {
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        self.0.cover(corners, bounds, emit);
    }
}

impl<R: Rasterize> Interpolate for CoverageOnly<'_, R> {
    /// Never called: an engine without a tolerance is not asked for values.
    fn fragments<V: Varying>(
        &self,
        _: &ScreenTriangle<V>,
        _: PixelRect,
        _: impl FnMut(Fragment<V>),
    ) {
    }
}

/// Rasterizers, with the bounds of their values where they have any.
pub struct TriangleContest<'a, R> {
    engines: &'a [(&'a str, R, Option<Tolerance>)],
}

impl<'a, R: Interpolate + Sync> TriangleContest<'a, R> {
    pub fn new(engines: &'a [(&'a str, R, Option<Tolerance>)]) -> Self {
        Self { engines }
    }
}

impl<R: Interpolate + Sync> Contest for TriangleContest<'_, R> {
    fn pairs(&self) -> Vec<[String; 2]> {
        pairs_of(self.engines.iter().map(|(name, ..)| *name))
    }

    fn judge(&self, case: &Case) -> (CaseFacts, Vec<Finding>) {
        let Shape::Triangles { list, disjoint } = &case.shape else {
            return (
                CaseFacts::default(),
                self.pairs().iter().map(|_| Finding::default()).collect(),
            );
        };
        // What is true.
        let truth = oracle_coverage(list, case.window);
        let facts = CaseFacts {
            shapes: list.len() as u64,
            pixels: truth.rows().flat_map(|(_, row)| row).map(|&hits| u64::from(hits)).sum(),
            ties: list.iter().map(|t| samples_on_boundary(&t.corners(), case.window)).sum(),
            sliver: list.iter().any(|t| is_sliver(&t.corners())),
            overlap: if *disjoint { twice_hit(&truth) } else { 0 },
        };

        // Compare each engine with the truth, then with the next one.
        let hits: Vec<_> = self
            .engines
            .iter()
            .map(|(_, engine, _)| engine_coverage(engine, list, case.window))
            .collect();
        let mut findings: Vec<Finding> =
            hits.iter().map(|hits| against(hits, &Ok(truth.clone()))).collect();
        findings.extend(hits.windows(2).map(|two| against(&two[0], &two[1])));
        let count = self.engines.len();
        for triangle in list {
            let (alone, each_other) = findings.split_at_mut(count);
            self.judge_values(triangle, case.window, alone, each_other);
        }
        (facts, findings)
    }
}

impl<R: Interpolate + Sync> TriangleContest<'_, R> {
    /// Compares fragments: their pixels with the same engine's coverage, their values at a few
    /// pixels with the exact ones and with those of the next engine.
    fn judge_values(
        &self,
        triangle: &Triangle,
        window: PixelRect,
        alone: &mut [Finding],
        each_other: &mut [Finding],
    ) {
        let v = &triangle.vertices;
        let depths = v.map(|v| v.depth);
        let attributes = v.map(|v| v.varying.to_array());
        let exact = ExactTriangle::new(&triangle.corners(), depths, v.map(|v| v.inv_w), attributes);
        let bound = |bound: Bound, k: usize| bound.at(attributes.map(|a| a[k]));
        let mut previous: Option<Vec<Fragment<DVec2>>> = None;
        for (i, (_, engine, tolerance)) in self.engines.iter().enumerate() {
            let Some(tolerance) = tolerance else { continue };
            if alone[i].panic.is_some() {
                previous = None;
                continue;
            }
            let fragments = match caught(|| collect_fragments(engine, triangle, window)) {
                Ok(fragments) => fragments,
                Err(message) => {
                    alone[i].panic = Some(message);
                    previous = None;
                    continue;
                }
            };
            alone[i].fragments += fragment_coverage(engine, triangle, window, &fragments);
            if let Some(exact) = &exact {
                // Outside the triangle no value is right or wrong; the pixel is.
                for f in few(&fragments).filter(|f| holds_centre(&triangle.corners(), f)) {
                    let (depth, values) = exact.at(f.x_px, f.y_px);
                    let ratio = |k: usize, value: f64| {
                        values[k].distance(value) / bound(tolerance.attribute, k)
                    };
                    alone[i].compare(
                        ratio(0, f.varying.x).max(ratio(1, f.varying.y)),
                        depth.distance(f.depth) / tolerance.depth.at(depths),
                    );
                }
            }
            if let (Some(previous), true) = (&previous, i > 0) {
                let Some(other) = &self.engines[i - 1].2 else { continue };
                for (a, b) in pairs_at_same_pixel(previous, &fragments) {
                    let sum = |k: usize| bound(other.attribute, k) + bound(tolerance.attribute, k);
                    let difference = (a.varying - b.varying).abs();
                    each_other[i - 1].compare(
                        (difference.x / sum(0)).max(difference.y / sum(1)),
                        (a.depth - b.depth).abs()
                            / (other.depth.at(depths) + tolerance.depth.at(depths)),
                    );
                }
            }
            previous = Some(fragments);
        }
    }
}

fn collect_fragments(
    engine: &impl Interpolate,
    triangle: &Triangle,
    window: PixelRect,
) -> Vec<Fragment<DVec2>> {
    let mut fragments = Vec::new();
    engine.fragments(triangle, window, |fragment| fragments.push(fragment));
    fragments
}

/// The pixels of the fragments against the engine's own coverage of the same triangle.
fn fragment_coverage(
    engine: &impl Interpolate,
    triangle: &Triangle,
    window: PixelRect,
    fragments: &[Fragment<DVec2>],
) -> Tally {
    let target = engine_coverage(engine, std::slice::from_ref(triangle), window);
    let actual = caught(|| {
        let mut hits = Coverage::new(window, 0);
        fragments.iter().for_each(|f| hits.hit(f.y_px, f.x_px, f.x_px + 1));
        hits
    });
    match (actual, target) {
        (Ok(actual), Ok(target)) => Tally::between(&actual, &target),
        // A fragment outside the window; the coverage's own panic is reported elsewhere.
        _ => Tally { extra: 1, ..Tally::default() },
    }
}

/// The first, the last and two fragments between: corners and middle of most triangles.
fn few(fragments: &[Fragment<DVec2>]) -> impl Iterator<Item = &Fragment<DVec2>> {
    let n = fragments.len();
    let mut picks = [0, n / 3, 2 * n / 3, n.saturating_sub(1)].to_vec();
    picks.dedup();
    picks.into_iter().filter_map(|i| fragments.get(i))
}

/// Whether the centre of the pixel lies in the triangle or on its outline.
fn holds_centre(corners: &Corners, f: &Fragment<DVec2>) -> bool {
    let centre = |px: i32| i128::from(px) * i128::from(SUBPIXELS) + i128::from(HALF_PIXEL);
    let (x, y) = (centre(f.x_px), centre(f.y_px));
    let side = |i: usize, j: usize| {
        let [ax, ay, bx, by] = [corners[i].x, corners[i].y, corners[j].x, corners[j].y];
        let [ax, ay, bx, by] = [ax, ay, bx, by].map(i128::from);
        ((bx - ax) * (y - ay) - (by - ay) * (x - ax)).signum()
    };
    let sides = [side(0, 1), side(1, 2), side(2, 0)];
    sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0)
}

/// Fragments of two engines at the same pixels, which they may emit in different orders.
fn pairs_at_same_pixel<'a>(
    a: &'a [Fragment<DVec2>],
    b: &'a [Fragment<DVec2>],
) -> impl Iterator<Item = (&'a Fragment<DVec2>, &'a Fragment<DVec2>)> {
    few(a).filter_map(|f| {
        let key = (f.y_px, f.x_px);
        // Both engines walk rows from the top and columns from the left; else look for it.
        let found = b.binary_search_by_key(&key, |g| (g.y_px, g.x_px)).ok();
        let found = found.or_else(|| b.iter().position(|g| (g.y_px, g.x_px) == key));
        found.map(|i| (f, &b[i]))
    })
}

fn against(actual: &Result<Coverage, String>, target: &Result<Coverage, String>) -> Finding {
    match (actual, target) {
        (Ok(actual), Ok(target)) => {
            Finding { tally: Tally::between(actual, target), ..Finding::default() }
        }
        (Err(message), _) | (_, Err(message)) => Finding::panicked(message.clone()),
    }
}

fn twice_hit(coverage: &Coverage) -> u64 {
    coverage.rows().flat_map(|(_, row)| row).filter(|&&hits| hits > 1).count() as u64
}

/// Thinner than a pixel and at least eight times as long as thick, in exact integers: with twice
/// the area A and the longest side L, the thickness is A / L.
#[must_use]
pub fn is_sliver(corners: &Corners) -> bool {
    let side = |i: usize, j: usize| {
        let d = |a: i32, b: i32| i128::from(a) - i128::from(b);
        (d(corners[i].x, corners[j].x), d(corners[i].y, corners[j].y))
    };
    let ((ax, ay), (bx, by), (cx, cy)) = (side(1, 0), side(2, 0), side(2, 1));
    // Extents of at most 2^32 make the area at most 2^65 and its square too wide; slivers have
    // |A| < 2^8 L <= 2^41.
    let area = (ax * by - ay * bx).abs();
    let longest = (ax * ax + ay * ay).max(bx * bx + by * by).max(cx * cx + cy * cy);
    let pixel = i128::from(SUBPIXELS);
    area > 0 && area < 1 << 42 && area * area < longest * pixel * pixel && 8 * area <= longest
}

/// Line drawers.
pub struct LineContest<'a, D> {
    engines: &'a [(&'a str, D)],
}

impl<'a, D: DrawLine + Sync> LineContest<'a, D> {
    pub fn new(engines: &'a [(&'a str, D)]) -> Self {
        Self { engines }
    }
}

impl<D: DrawLine + Sync> Contest for LineContest<'_, D> {
    fn pairs(&self) -> Vec<[String; 2]> {
        pairs_of(self.engines.iter().map(|(name, _)| *name))
    }

    fn judge(&self, case: &Case) -> (CaseFacts, Vec<Finding>) {
        let mut findings: Vec<Finding> = self.pairs().iter().map(|_| Finding::default()).collect();
        let mut facts = CaseFacts::default();
        let Shape::Lines(lines) = &case.shape else {
            return (facts, findings);
        };
        for line in lines {
            let mut truth = Vec::new();
            Oracle
                .line_pixels(line, case.window, |pixel, step| truth.push((pixel.x, pixel.y, step)));
            facts.shapes += 1;
            facts.pixels += truth.len() as u64;
            facts.ties += u64::from(line_has_tie(line));
            let drawn: Vec<_> = self
                .engines
                .iter()
                .map(|(_, engine)| {
                    caught(|| {
                        let mut pixels = Vec::new();
                        engine.draw(line, case.window, |fragment| pixels.push(fragment));
                        pixels
                    })
                })
                .collect();
            let pixels: Vec<(i32, i32)> = truth.iter().map(|&(x, y, _)| (x, y)).collect();
            for (finding, drawn) in findings.iter_mut().zip(&drawn) {
                match drawn {
                    Ok(drawn) => {
                        finding.tally += sequence(drawn, &pixels, case.window);
                        line_values(line, drawn, &truth, finding);
                    }
                    Err(message) => finding.panic = Some(message.clone()),
                }
            }
            for (finding, two) in findings.iter_mut().skip(drawn.len()).zip(drawn.windows(2)) {
                match (&two[0], &two[1]) {
                    (Ok(a), Ok(b)) => {
                        let target: Vec<_> = b.iter().map(|f| (f.x_px, f.y_px)).collect();
                        finding.tally += sequence(a, &target, case.window);
                    }
                    (Err(message), _) | (_, Err(message)) => finding.panic = Some(message.clone()),
                }
            }
        }
        (facts, findings)
    }
}

/// A line passes halfway between two pixels somewhere iff its length over the common divisor of
/// length and rise is even.
fn line_has_tie(line: &Line) -> bool {
    let [a, b] = line.ends.map(|end| end.pixel);
    let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
    let (long, short) = (dx.max(dy), dx.min(dy));
    let (mut a, mut b) = (long, short);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    short > 0 && (long / a).is_multiple_of(2)
}

/// Compares the pixels of a line, and where they are the same ones their order.
fn sequence(drawn: &[Fragment<DVec2>], target: &[(i32, i32)], window: PixelRect) -> Tally {
    let actual = drawn.iter().map(|f| (f.x_px, f.y_px));
    if actual.clone().eq(target.iter().copied()) {
        return Tally::default();
    }
    let hits = |pixels: &mut dyn Iterator<Item = (i32, i32)>| {
        let (mut hits, mut outside) = (Coverage::new(window, 0), 0);
        for (x_px, y_px) in pixels {
            if window.contains(x_px, y_px) {
                hits.hit(y_px, x_px, x_px + 1);
            } else {
                outside += 1;
            }
        }
        (hits, outside)
    };
    let (actual_hits, outside) = hits(&mut actual.clone());
    let (target_hits, _) = hits(&mut target.iter().copied());
    let mut tally = Tally::between(&actual_hits, &target_hits);
    tally.extra += outside;
    if tally.total() == 0 {
        tally.order = actual.zip(target.iter().copied()).filter(|(a, b)| a != b).count() as u64;
    }
    tally
}

/// Compares values with the exact ones at the first, the last and a middle pixel in common.
fn line_values(
    line: &Line,
    drawn: &[Fragment<DVec2>],
    truth: &[(i32, i32, u64)],
    finding: &mut Finding,
) {
    let [a, b] = &line.ends;
    let length = a.pixel.x.abs_diff(b.pixel.x).max(a.pixel.y.abs_diff(b.pixel.y));
    let bounds = tolerance::LINE;
    let mut picks = [0, truth.len() / 2, truth.len().saturating_sub(1)].to_vec();
    picks.dedup();
    for i in picks {
        let (Some(&(x, y, step)), Some(f)) = (truth.get(i), drawn.get(i)) else { continue };
        if (f.x_px, f.y_px) != (x, y) {
            continue;
        }
        let ratio = |ends: [f64; 2], value: f64, bound: Bound| {
            along_line(ends, step, u64::from(length)).distance(value) / bound.at(ends)
        };
        let [av, bv] = [a.varying, b.varying];
        finding.compare(
            ratio([av.x, bv.x], f.varying.x, bounds.attribute).max(ratio(
                [av.y, bv.y],
                f.varying.y,
                bounds.attribute,
            )),
            ratio([a.depth, b.depth], f.depth, bounds.depth),
        );
    }
}
