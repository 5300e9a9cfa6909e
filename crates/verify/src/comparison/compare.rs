//! One case, several engines: who draws what the oracle draws?

use glam::DVec2;

use super::cause::Cause;
use super::finding::{Finding, Tally};
use super::pixels::{self, few};
use super::spans::{
    Covered, engine_coverage, exact_coverage, fragments_against, line_coverage, unsnapped_truth,
};
use super::tolerance::Tolerance;
use super::truth::{Bounds, Truth, compare_on_line};
use crate::cases::named::plain_line;
use crate::cases::{Case, Kind, Line, Shape, Triangle};
use crate::convention::{LineQuestion, TriangleQuestion};
use crate::judge::{EnginePanic, caught};
use crate::mistakes::{self, Mistakes};
use crate::oracle::Oracle;
use crate::oracle::coverage::samples_on_boundary;
use crate::promise::{Convention, Rule};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize, RasterizeExact};
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::{centre_of, edges, greatest_divisor, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{
    Corners, Fragment, PixelPoint, ScreenLine, ScreenTriangle, Span, Varying,
};

/// The name of the oracle in a pair.
pub const ORACLE: &str = "oracle";

/// The side of the window in which values are asked for.
const VALUES_SIDE_PX: u32 = 64;

/// What the oracle says of a case.
#[derive(Clone, Debug, Default)]
pub struct CaseFacts {
    pub shapes: u64,
    pub pixels: u64,
    pub ties: u64,
    pub sliver: bool,
    /// Pixels that the oracle itself hits more or less often than the shapes allow by construction.
    pub oracle_faults: u64,
}

/// Judges cases; a finding for each pair, in the order of [`CompareCases::pairs`].
pub trait CompareCases: Sync {
    /// The shapes of the cases that it judges.
    fn kind(&self) -> Kind;

    fn pairs(&self) -> Vec<[String; 2]>;

    /// Adds what is found about each pair to what is known about it.
    fn judge(&self, case: &Case, known: Vec<Finding>) -> (CaseFacts, Vec<Finding>);

    /// What an engine draws in a case; nothing where it panics.
    fn coverage(&self, engine: &str, case: &Case) -> Option<Coverage>;

    /// Why an engine is wrong, found by asking it more; nothing where there is no such engine.
    fn cause(&self, engine: &str) -> Option<Cause>;

    /// The findings of one case, where nothing is known before.
    fn findings(&self, case: &Case) -> Vec<Finding> {
        self.judge(case, vec![Finding::default(); self.pairs().len()]).1
    }
}

/// Each engine against the oracle.
fn pairs_with_oracle<'a>(names: impl Iterator<Item = &'a str>) -> Vec<[String; 2]> {
    let mut pairs = Vec::new();
    for name in names {
        pairs.push([name.to_owned(), ORACLE.to_owned()]);
    }
    pairs
}

/// Each engine against the oracle, then each against the next.
fn pairs_of<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<[String; 2]> {
    let mut pairs = pairs_with_oracle(names.clone());
    for (name, next) in names.clone().zip(names.skip(1)) {
        pairs.push([name.to_owned(), next.to_owned()]);
    }
    pairs
}

/// Engines against each other alone: what the oracle draws is not asked for.
pub struct EachOther<C>(pub C);

impl<C: CompareCases> CompareCases for EachOther<C> {
    fn kind(&self) -> Kind {
        self.0.kind()
    }

    fn pairs(&self) -> Vec<[String; 2]> {
        self.0.pairs().into_iter().filter(|pair| pair[1] != ORACLE).collect()
    }

    fn judge(&self, case: &Case, known: Vec<Finding>) -> (CaseFacts, Vec<Finding>) {
        let by_oracle = self.0.pairs().len() - known.len();
        let mut findings = vec![Finding::default(); by_oracle];
        findings.extend(known);
        let (facts, mut findings) = self.0.judge(case, findings);
        (facts, findings.split_off(by_oracle))
    }

    fn coverage(&self, engine: &str, case: &Case) -> Option<Coverage> {
        self.0.coverage(engine, case)
    }

    fn cause(&self, engine: &str) -> Option<Cause> {
        self.0.cause(engine)
    }
}

/// [`Rasterize::cover`] as a pointer.
pub type Cover<'a> = dyn Fn(Corners, PixelRect, &mut dyn FnMut(Span)) + Sync + 'a;

/// An engine that is judged by its coverage alone. It is a pointer, so that this code is compiled here and not for each
/// caller: tests without optimisation then still judge with the optimisation level of this crate.
pub struct CoverageOnly<'a>(pub &'a Cover<'a>);

impl Rasterize for CoverageOnly<'_> {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        (self.0)(corners, bounds, &mut emit);
    }
}

impl Interpolate for CoverageOnly<'_> {
    /// Never called: an engine without a tolerance is not asked for values.
    fn fragments<V: Varying>(
        &self,
        _: &ScreenTriangle<V>,
        _: PixelRect,
        _: impl FnMut(Fragment<V>),
    ) {
    }
}

/// What lights the pixels of a line, as a pointer.
pub type Light<'a> = dyn Fn([PixelPoint; 2], PixelRect, &mut dyn FnMut(i32, i32)) + Sync + 'a;

/// A line drawer that is judged by its pixels alone. A pointer, as [`CoverageOnly`].
pub struct PixelsOnly<'a>(pub &'a Light<'a>);

impl DrawLine for PixelsOnly<'_> {
    /// Its values are those of the first end, which nobody looks at.
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let first = &line.ends[0];
        let (depth, varying) = (first.depth, first.varying);
        (self.0)(line.ends.each_ref().map(|end| end.pixel), bounds, &mut |x_px, y_px| {
            emit(Fragment { x_px, y_px, depth, varying });
        });
    }
}

/// Two line drawers as one type, so that they can be compared.
pub enum OneOf<'a, A, B> {
    First(&'a A),
    Second(&'a B),
}

impl<A: DrawLine, B: DrawLine> DrawLine for OneOf<'_, A, B> {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        match self {
            Self::First(first) => first.draw(line, bounds, emit),
            Self::Second(second) => second.draw(line, bounds, emit),
        }
    }
}

/// Rasterizers, with the bounds of their values where they have any.
pub struct TriangleComparer<'a, R> {
    engines: &'a [(&'a str, R, Option<Tolerance>)],
    convention: Convention,
}

impl<'a, R: Interpolate + Sync> TriangleComparer<'a, R> {
    pub fn new(engines: &'a [(&'a str, R, Option<Tolerance>)], convention: Convention) -> Self {
        Self { engines, convention }
    }

    /// What is true for a rasterizer that has drawn `covered`: where its convention leaves a pixel open, what it drew.
    fn target(
        &self,
        list: &[Triangle],
        covered: &Result<Covered, EnginePanic>,
        truth: &Result<Covered, EnginePanic>,
    ) -> Result<Covered, EnginePanic> {
        let (Ok(covered), Ok(truth)) = (covered, truth) else { return truth.clone() };
        let window = covered.window();
        let may = |at: usize| {
            self.convention.expected(&list[at].corners(), window).may.unwrap_or_default()
        };
        Ok(truth.allowing(covered, may))
    }
}

impl<R: Interpolate + Sync> CompareCases for TriangleComparer<'_, R> {
    fn kind(&self) -> Kind {
        Kind::Triangles
    }

    fn pairs(&self) -> Vec<[String; 2]> {
        pairs_of(self.engines.iter().map(|(name, ..)| *name))
    }

    fn coverage(&self, engine: &str, case: &Case) -> Option<Coverage> {
        let (_, engine, _) = self.engines.iter().find(|(name, ..)| *name == engine)?;
        let Shape::Triangles { list, .. } = &case.shape else { return None };
        engine_coverage(engine, list, case.window).ok()
    }

    fn cause(&self, engine: &str) -> Option<Cause> {
        let (_, engine, tolerance) = self.engines.iter().find(|(name, ..)| *name == engine)?;
        let cause =
            Cause::of_triangles(&self.convention, |TriangleQuestion { corners, window }| {
                let hits = caught(|| {
                    let mut hits = Coverage::new(*window, 0);
                    engine.cover(*corners, *window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                    hits
                });
                hits.ok()
            });
        let values = tolerance.and_then(|tolerance| self.mistakes_in_values(engine, tolerance));
        Some(cause.with(values))
    }

    fn judge(&self, case: &Case, mut findings: Vec<Finding>) -> (CaseFacts, Vec<Finding>) {
        let Shape::Triangles { list, disjoint } = &case.shape else {
            return (CaseFacts::default(), findings);
        };
        // What is true. The oracle does not panic, and stays inside the window.
        let truth = Covered::by(&self.convention, list, case.window);
        let centred = |triangle: &Triangle| self.convention.centred(&triangle.corners());
        let facts = CaseFacts {
            shapes: list.len() as u64,
            pixels: truth.as_ref().map_or(0, Covered::pixels),
            ties: list.iter().map(|t| samples_on_boundary(&centred(t), case.window)).sum(),
            sliver: list.iter().any(|t| is_sliver(&t.corners())),
            oracle_faults: truth.as_ref().map_or(0, |t| if *disjoint { t.twice() } else { 0 }),
        };

        // Compare each engine with the truth, then with the next one.
        let mut covered = Vec::with_capacity(self.engines.len());
        for (_, engine, _) in self.engines {
            covered.push(Covered::by(engine, list, case.window));
        }
        let count = self.engines.len();
        let (alone, each_other) = findings.split_at_mut(count);
        for (finding, covered) in alone.iter_mut().zip(&covered) {
            let open = matches!(self.convention.rule, Rule::Inclusive | Rule::Unspecified);
            let target = open.then(|| self.target(list, covered, &truth));
            finding.cover(against(covered, target.as_ref().unwrap_or(&truth)));
        }
        for (finding, two) in each_other.iter_mut().zip(covered.windows(2)) {
            finding.cover(against(&two[0], &two[1]));
        }
        for (at, triangle) in list.iter().enumerate() {
            let spans: Vec<_> = covered.iter().map(|c| c.as_ref().ok().map(|c| c.of(at))).collect();
            self.judge_values(triangle, case.window, &spans, alone, each_other);
        }
        let hits =
            |covered: &Result<Covered, EnginePanic>| covered.as_ref().ok().map(Covered::hits);
        for (finding, covered) in alone.iter_mut().zip(&covered) {
            finding.keep(|| [hits(covered), None]);
        }
        for (finding, two) in each_other.iter_mut().zip(covered.windows(2)) {
            finding.keep(|| [hits(&two[0]), hits(&two[1])]);
        }
        (facts, findings)
    }
}

fn against(
    actual: &Result<Covered, EnginePanic>,
    target: &Result<Covered, EnginePanic>,
) -> Result<Tally, EnginePanic> {
    match (actual, target) {
        (Ok(actual), Ok(target)) => Ok(actual.against(target)),
        (Err(message), _) | (_, Err(message)) => Err(message.clone()),
    }
}

impl<R: Interpolate + Sync> TriangleComparer<'_, R> {
    fn mistakes_in_values(&self, engine: &R, tolerance: Tolerance) -> Option<Mistakes> {
        mistakes::values::of_engine(|triangle| {
            let window = PixelRect::window(VALUES_SIDE_PX, VALUES_SIDE_PX);
            let fragments = caught(|| {
                let mut fragments = Vec::new();
                engine.fragments(triangle, window, |f| fragments.push(f));
                fragments
            });
            let fragments = fragments.ok()?;
            let corners = triangle.corners();
            let inside = |f: &&Fragment<DVec2>| holds_centre(&corners, f);
            let fragments: Vec<_> = few(&fragments).filter(inside).copied().collect();
            let (mut truth, mut finding) = (Truth::new(triangle)?, Finding::default());
            let bounds = Bounds::new(tolerance, triangle);
            for fragment in &fragments {
                truth.compare(fragment, &bounds, &mut finding);
            }
            let is_wrong = finding.worst() > 1.0;
            let Bounds { attributes: [a, b], depth } = bounds;
            Some((fragments, [depth, a, b], is_wrong))
        })
    }

    /// Compares fragments: their pixels with the same engine's spans, their values at a few pixels
    /// with the exact ones and with those of the next engine.
    fn judge_values(
        &self,
        triangle: &Triangle,
        window: PixelRect,
        spans: &[Option<&[Span]>],
        alone: &mut [Finding],
        each_other: &mut [Finding],
    ) {
        if self.engines.iter().all(|(.., tolerance)| tolerance.is_none()) {
            return;
        }
        // Values are those at the sample, which the exact ones take for the centre.
        let moved = self.convention.centred(&triangle.corners());
        let mut centred = *triangle;
        for (vertex, position) in centred.vertices.iter_mut().zip(moved) {
            vertex.position = position;
        }
        let mut truth = Truth::new(&centred);
        let mut previous: Option<(Vec<Fragment<DVec2>>, Bounds)> = None;
        for (i, (_, engine, tolerance)) in self.engines.iter().enumerate() {
            // Nothing to compare the next engine with, unless this one has values.
            let before = previous.take();
            let Some(tolerance) = tolerance else { continue };
            let (None, Some(spans)) = (&alone[i].panic, spans[i]) else { continue };
            let fragments = match caught(|| collect_fragments(engine, triangle, spans, window)) {
                Ok(fragments) => fragments,
                Err(panic) => {
                    alone[i].panic = Some(panic.0);
                    continue;
                }
            };
            alone[i].fragments += fragments_against(&fragments, spans, window);
            let bounds = Bounds::new(*tolerance, triangle);
            if let Some(truth) = &mut truth {
                // Outside the triangle no value is right or wrong; the pixel is.
                for f in few(&fragments).filter(|f| holds_centre(&moved, f)) {
                    truth.compare(f, &bounds, &mut alone[i]);
                }
            }
            if let Some((other, other_bounds)) = &before {
                for (a, b) in pairs_at_same_pixel(other, &fragments) {
                    // Each engine may be off by its own bound, in opposite directions.
                    let depth = (a.depth - b.depth).abs() / (other_bounds.depth + bounds.depth);
                    let [first, second] = [0, 1].map_array(|k: usize| {
                        let may_be_off = other_bounds.attributes[k] + bounds.attributes[k];
                        (a.varying[k] - b.varying[k]).abs() / may_be_off
                    });
                    each_other[i - 1].compare(first.max(second), depth);
                }
            }
            previous = Some((fragments, bounds));
        }
    }
}

/// The fragments of a triangle that covers `spans`, which say how many there will be.
fn collect_fragments(
    engine: &impl Interpolate,
    triangle: &Triangle,
    spans: &[Span],
    window: PixelRect,
) -> Vec<Fragment<DVec2>> {
    let pixels = spans.iter().map(Span::pixels).sum();
    let mut fragments = Vec::with_capacity(pixels);
    engine.fragments(triangle, window, |fragment| fragments.push(fragment));
    fragments
}

/// Whether the centre of the pixel lies in the triangle or on its outline.
fn holds_centre(corners: &Corners, f: &Fragment<DVec2>) -> bool {
    let sample = centre_of(f.x_px, f.y_px);
    let (mut is_left, mut is_right) = (true, true);
    for [from, to] in edges(corners) {
        let side = twice_area(&[from, to, sample]);
        is_left &= side >= 0;
        is_right &= side <= 0;
    }
    is_left || is_right
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

/// Thinner than a pixel and at least eight times as long as thick, in exact integers: with twice
/// the area A and the longest side L, the thickness is A / L.
#[must_use]
pub fn is_sliver(corners: &Corners) -> bool {
    let mut longest = 0;
    for [from, to] in edges(corners) {
        let dx = i128::from(to.x) - i128::from(from.x);
        let dy = i128::from(to.y) - i128::from(from.y);
        longest = longest.max(dx * dx + dy * dy);
    }
    // Extents of at most 2^32 make the area at most 2^65 and its square too wide; slivers have
    // |A| < 2^8 L <= 2^41.
    let area = twice_area(corners).abs();
    let pixel = i128::from(SUBPIXELS);
    area > 0 && area < 1 << 42 && area * area < longest * pixel * pixel && 8 * area <= longest
}

/// Line drawers.
pub struct LineComparer<'a, D> {
    engines: &'a [(&'a str, D)],
    has_values: bool,
}

impl<'a, D: DrawLine + Sync> LineComparer<'a, D> {
    pub fn new(engines: &'a [(&'a str, D)]) -> Self {
        Self { engines, has_values: true }
    }

    /// Judges no values.
    pub fn of_pixels(engines: &'a [(&'a str, D)]) -> Self {
        Self { engines, has_values: false }
    }
}

impl<D: DrawLine + Sync> CompareCases for LineComparer<'_, D> {
    fn kind(&self) -> Kind {
        Kind::Lines
    }

    fn pairs(&self) -> Vec<[String; 2]> {
        pairs_of(self.engines.iter().map(|(name, _)| *name))
    }

    fn coverage(&self, engine: &str, case: &Case) -> Option<Coverage> {
        let (_, engine) = self.engines.iter().find(|(name, _)| *name == engine)?;
        let Shape::Lines(lines) = &case.shape else { return None };
        line_coverage(engine, lines, case.window).ok()
    }

    fn cause(&self, engine: &str) -> Option<Cause> {
        let (_, engine) = self.engines.iter().find(|(name, _)| *name == engine)?;
        Some(Cause::of_lines(|LineQuestion { ends, window }| {
            let [a, b] = ends.map_array(|[x, y]| PixelPoint::new(x, y));
            let drawn = caught(|| line_fragments(engine, &plain_line(a, b), *window)).ok()?;
            Some(drawn.iter().map(|f| [f.x_px, f.y_px]).collect())
        }))
    }

    fn judge(&self, case: &Case, mut findings: Vec<Finding>) -> (CaseFacts, Vec<Finding>) {
        let mut facts = CaseFacts::default();
        let Shape::Lines(lines) = &case.shape else {
            return (facts, findings);
        };
        // The pixels of all lines, by engine; nothing of one that has panicked.
        let mut all: Vec<Option<Vec<(i32, i32)>>> = vec![Some(Vec::new()); self.engines.len()];
        for line in lines {
            let mut truth = Vec::new();
            Oracle
                .steps(line, case.window, &mut |pixel, step| truth.push((pixel.x, pixel.y, step)));
            facts.shapes += 1;
            facts.pixels += truth.len() as u64;
            facts.ties += u64::from(line_has_tie(line));
            let mut drawn = Vec::new();
            for (_, engine) in self.engines {
                drawn.push(caught(|| line_fragments(engine, line, case.window)));
            }
            for (all, drawn) in all.iter_mut().zip(&drawn) {
                match (&mut *all, drawn) {
                    (Some(pixels), Ok(drawn)) => pixels.extend(places(drawn)),
                    _ => *all = None,
                }
            }
            let pixels: Vec<(i32, i32)> = truth.iter().map(|&(x, y, _)| (x, y)).collect();
            for (finding, drawn) in findings.iter_mut().zip(&drawn) {
                match drawn {
                    Ok(drawn) => {
                        sequence(finding, &places(drawn), &pixels, case.window);
                        if self.has_values {
                            line_values(line, drawn, &truth, finding);
                        }
                    }
                    Err(panic) => finding.panic = Some(panic.0.clone()),
                }
            }
            for (finding, two) in findings.iter_mut().skip(drawn.len()).zip(drawn.windows(2)) {
                match (&two[0], &two[1]) {
                    (Ok(a), Ok(b)) => {
                        sequence(finding, &places(a), &places(b), case.window);
                    }
                    (Err(panic), _) | (_, Err(panic)) => finding.panic = Some(panic.0.clone()),
                }
            }
        }
        // What the message shows of each engine.
        let hits = |pixels: &Option<Vec<(i32, i32)>>| {
            let runs = pixels::as_runs(pixels.as_ref()?);
            Some(pixels::hits(&runs, case.window).0)
        };
        let (alone, each_other) = findings.split_at_mut(all.len());
        for (finding, pixels) in alone.iter_mut().zip(&all) {
            finding.keep(|| [hits(pixels), None]);
        }
        for (finding, two) in each_other.iter_mut().zip(all.windows(2)) {
            finding.keep(|| [hits(&two[0]), hits(&two[1])]);
        }
        (facts, findings)
    }
}

/// What an engine draws of a line, in its order.
fn line_fragments(engine: &impl DrawLine, line: &Line, window: PixelRect) -> Vec<Fragment<DVec2>> {
    let mut fragments = Vec::new();
    engine.draw(line, window, |fragment| fragments.push(fragment));
    fragments
}

/// The pixels of fragments, in their order.
fn places(drawn: &[Fragment<DVec2>]) -> Vec<(i32, i32)> {
    drawn.iter().map(|f| (f.x_px, f.y_px)).collect()
}

/// Rasterizers of corners that are not snapped.
pub struct UnsnappedComparer<'a, E> {
    engines: &'a [(&'a str, E)],
}

impl<'a, E: RasterizeExact + Sync> UnsnappedComparer<'a, E> {
    pub fn new(engines: &'a [(&'a str, E)]) -> Self {
        Self { engines }
    }
}

impl<E: RasterizeExact + Sync> CompareCases for UnsnappedComparer<'_, E> {
    fn kind(&self) -> Kind {
        Kind::Unsnapped
    }

    fn pairs(&self) -> Vec<[String; 2]> {
        pairs_with_oracle(self.engines.iter().map(|(name, _)| *name))
    }

    fn coverage(&self, engine: &str, case: &Case) -> Option<Coverage> {
        let (_, engine) = self.engines.iter().find(|(name, _)| *name == engine)?;
        exact_coverage(engine, case.free_corners(), case.window).ok().map(|(hits, _)| hits)
    }

    fn cause(&self, engine: &str) -> Option<Cause> {
        let (_, engine) = self.engines.iter().find(|(name, _)| *name == engine)?;
        let cause =
            Cause::of_triangles(&Convention::default(), |TriangleQuestion { corners, window }| {
                exact_coverage(engine, &[(*corners).into()], *window).ok().map(|(hits, _)| hits)
            });
        // These are judged by one convention.
        Some(Cause { declare: None, ..cause })
    }

    fn judge(&self, case: &Case, mut findings: Vec<Finding>) -> (CaseFacts, Vec<Finding>) {
        let Shape::Unsnapped { list, is_tiling } = &case.shape else {
            return (CaseFacts::default(), findings);
        };
        let (target, ties) = unsnapped_truth(list, case.window);
        let mut facts = CaseFacts { shapes: list.len() as u64, ties, ..CaseFacts::default() };
        for (_, row) in target.rows() {
            for &hits in row {
                facts.pixels += u64::from(hits);
                // A tiling hits each pixel once.
                facts.oracle_faults += u64::from(*is_tiling && hits != 1);
            }
        }
        for (finding, (_, engine)) in findings.iter_mut().zip(self.engines) {
            match exact_coverage(engine, list, case.window) {
                Ok((hits, decisions)) => {
                    finding.tally += Tally::between(&hits, &target);
                    finding.decisions += decisions;
                    finding.keep(|| [Some(hits), None]);
                }
                Err(panic) => finding.panic = Some(panic.0),
            }
        }
        (facts, findings)
    }
}

/// A line passes halfway between two pixels somewhere iff its length over the common divisor of
/// length and rise is even.
#[must_use]
pub fn line_has_tie(line: &Line) -> bool {
    let [a, b] = line.ends.map_array(|end| end.pixel);
    let (dx, dy) = (a.x.abs_diff(b.x), a.y.abs_diff(b.y));
    let (long, short) = (dx.max(dy), dx.min(dy));
    let divisor = greatest_divisor(long.into(), short.into());
    short > 0 && (i64::from(long) / divisor) % 2 == 0
}

fn sequence(finding: &mut Finding, drawn: &[(i32, i32)], target: &[(i32, i32)], window: PixelRect) {
    pixels::sequence(&mut finding.tally, &mut 0, drawn, target, window, true);
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
    let mut picks = [0, truth.len() / 2, truth.len().saturating_sub(1)].to_vec();
    picks.dedup();
    for i in picks {
        let (Some(&(x, y, step)), Some(f)) = (truth.get(i), drawn.get(i)) else { continue };
        if (f.x_px, f.y_px) != (x, y) {
            continue;
        }
        compare_on_line(line, [step, length.into()], f, finding);
    }
}
