//! The survey of the specimens: how often each published fault shows, by family, and whether the
//! exposing case shows it while the harmless one does not.
//!
//! Truth is the oracle at the same positions; specimens that sample at whole numbers receive the
//! triangle moved by half a pixel, so a count here is a fault and no convention. Triangles are judged
//! one by one.

use glam::DVec2;
use rayon::prelude::*;
use serde::Serialize;

use super::Tally;
use super::contest::caught;
use crate::contract::{DrawLine as _, Rasterize as _};
use crate::frame::Coverage;
use crate::grid::{PixelRect, SubpixelPoint};
use crate::hazard::named::plain_line;
use crate::hazard::{self, Case, Family, Line, Shape, Triangle};
use crate::lineup::{self, LineSpecimen, Specimen, TriangleSpecimen};
use crate::oracle::Oracle;
use crate::oracle::values::ExactTriangle;
use crate::specimen::catalogue::{CARDS, Card, Exhibit, LineCase, TriangleCase};
use crate::specimen::scene::{Image, Setting, Version};
use crate::specimen::{Published as _, PublishedLine as _, from_screen};
use crate::triangle::{Fragment, PixelPoint, ScreenTriangle, ScreenVertex};

/// What came of some triangles or lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Triangles or lines drawn.
    pub shapes: u64,
    /// Those with a wrong pixel or a wrong value.
    pub wrong: u64,
    /// Those that the specimen refuses, since the published code is undefined there.
    pub refused: u64,
    /// Covered pixels by the oracle.
    pub pixels: u64,
    /// Wrong pixels.
    pub tally: Tally,
    /// Largest error of an attribute, as a fraction of the spread of its corner values; infinite
    /// where a value is not a number.
    pub worst_attribute: f64,
    /// Largest error of the depth, likewise.
    pub worst_depth: f64,
}

impl Counts {
    fn merge(mut self, other: Self) -> Self {
        self.shapes += other.shapes;
        self.wrong += other.wrong;
        self.refused += other.refused;
        self.pixels += other.pixels;
        self.tally += other.tally;
        self.worst_attribute = self.worst_attribute.max(other.worst_attribute);
        self.worst_depth = self.worst_depth.max(other.worst_depth);
        self
    }

    /// Wrong triangles in percent.
    #[must_use]
    pub fn percent(&self) -> f64 {
        100.0 * self.wrong as f64 / self.shapes.max(1) as f64
    }
}

/// A specimen over the families.
#[derive(Clone, Debug, Serialize)]
pub struct SpecimenReport {
    /// Its name.
    pub name: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What is wrong.
    pub fault: &'static str,
    /// The repair.
    pub cure: &'static str,
    /// The case that exposes it, and what it shows there.
    pub case: &'static str,
    /// Pixels that are wrong in that case.
    pub case_wrong: u64,
    /// Pixels that are wrong in the harmless case.
    pub harmless_wrong: u64,
    /// Family and counts; empty for scenes.
    pub families: Vec<(&'static str, Counts)>,
    /// All of them.
    pub all: Counts,
}

/// Values differ where they are off by more than this fraction of their spread: f32 weights, which
/// two of the specimens use, reach 1e-6 of it.
const VALUE_DIFFERS: f64 = 1e-4;
/// Fragments of a triangle that are compared with exact values.
const COMPARED: usize = 16;

/// Surveys every specimen: `cases` cases of each family.
#[must_use]
pub fn survey(seed: u64, cases: u64) -> Vec<SpecimenReport> {
    CARDS.iter().map(|card| report(card, seed, cases)).collect()
}

fn report(card: &Card, seed: u64, cases: u64) -> SpecimenReport {
    let specimen = lineup::find(card.name).and_then(|entry| entry.specimen);
    let families: Vec<_> = match specimen {
        Some(Specimen::Triangle(specimen)) => {
            over(hazard::triangles::FAMILIES, seed, cases, |case| triangles(specimen, case))
        }
        Some(Specimen::Line(specimen)) => {
            over(hazard::lines::FAMILIES, seed, cases, |case| lines(specimen, case))
        }
        None => Vec::new(),
    };
    let all = families.iter().fold(Counts::default(), |sum, (_, counts)| sum.merge(*counts));
    let [case_wrong, harmless_wrong] =
        [Setting::Exposing, Setting::Harmless].map(|s| wrong(card, s));
    SpecimenReport {
        name: card.name,
        source: card.source,
        fault: card.fault,
        cure: card.cure,
        case: exposing_name(card),
        case_wrong,
        harmless_wrong,
        families,
        all,
    }
}

fn over(
    families: &'static [Family],
    seed: u64,
    cases: u64,
    judge: impl Fn(&Case) -> Counts + Sync,
) -> Vec<(&'static str, Counts)> {
    let counts = |family: &Family| {
        let all = (0..cases).into_par_iter().map(|index| judge(&family.case(seed, index)));
        all.reduce(Counts::default, Counts::merge)
    };
    families.iter().map(|family| (family.name, counts(family))).collect()
}

/// The exposing case's name.
#[must_use]
pub fn exposing_name(card: &Card) -> &'static str {
    match &card.exhibit {
        Exhibit::Triangles([case, _]) => case.name,
        Exhibit::Lines([case, _]) => case.name,
        Exhibit::Scene(name, _) => name,
    }
}

/// Pixels with a wrong hit count, a wrong value or a wrong colour in one of a card's cases; a
/// refusal counts as one.
#[must_use]
pub fn wrong(card: &Card, setting: Setting) -> u64 {
    let which = usize::from(setting == Setting::Harmless);
    let specimen = lineup::find(card.name).and_then(|entry| entry.specimen);
    match (&card.exhibit, specimen) {
        (Exhibit::Triangles(cases), Some(Specimen::Triangle(specimen))) => {
            let counts = triangles(specimen, &triangle_case(&cases[which]));
            counts.tally.total() + counts.wrong + counts.refused
        }
        (Exhibit::Lines(cases), Some(Specimen::Line(specimen))) => {
            lines(specimen, &line_case(&cases[which])).tally.total()
        }
        (Exhibit::Scene(_, draw), _) => {
            let (a, b) = (draw(Version::Published, setting), draw(Version::Repaired, setting));
            different(&a, &b)
        }
        _ => 0,
    }
}

fn different(a: &Image, b: &Image) -> u64 {
    let pixels = a.rows().zip(b.rows()).flat_map(|((_, a), (_, b))| a.iter().zip(b));
    pixels.filter(|(a, b)| a != b).count() as u64
}

/// A card's triangles as a case of the harness.
#[must_use]
pub fn triangle_case(case: &TriangleCase) -> Case {
    let vertex = |corners: &[(f64, f64); 3], i: usize| ScreenVertex {
        position: SubpixelPoint::from_px(corners[i].0, corners[i].1)
            .expect("a catalogued position lies in the domain"),
        depth: case.values[i],
        inv_w: 1.0 / case.w[i],
        varying: DVec2::splat(case.values[i]),
    };
    let triangle = |corners| ScreenTriangle { vertices: [0, 1, 2].map(|i| vertex(corners, i)) };
    let list = case.corners_px.iter().map(triangle).collect();
    let window = PixelRect::window(case.side_px, case.side_px);
    Case { window, shape: Shape::Triangles { list, disjoint: true } }
}

/// A card's line as a case of the harness.
#[must_use]
pub fn line_case(case: &LineCase) -> Case {
    let [a, b] = case.pixels.map(|(x, y)| PixelPoint::new(x, y));
    let side = |a: i32, b: i32, most: u32| (a.max(b) as u32 + 3).min(most);
    let window = PixelRect::window(side(a.x, b.x, 24), side(a.y, b.y, 12));
    Case { window, shape: Shape::Lines(vec![plain_line(a, b)]) }
}

/// Hits of a specimen over triangles; a pixel that it puts outside the window is a panic.
///
/// # Errors
/// What it refuses, or the message of its panic.
pub fn specimen_coverage(
    specimen: TriangleSpecimen,
    list: &[Triangle],
    window: PixelRect,
) -> Result<Coverage, String> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for triangle in list {
            specimen
                .cover(&from_screen(triangle), window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px))
                .map_err(|refused| refused.to_string())?;
        }
        Ok(hits)
    })?
}

/// Hits of a line specimen.
///
/// # Errors
/// What it refuses, or the message of its panic.
pub fn specimen_line_coverage(
    specimen: LineSpecimen,
    line: &Line,
    window: PixelRect,
) -> Result<Coverage, String> {
    // The centre of a pixel is its position.
    let ends = line.ends.map(|e| [f64::from(e.pixel.x) + 0.5, f64::from(e.pixel.y) + 0.5]);
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        specimen
            .draw(ends, window, |x, y| hits.hit(y, x, x + 1))
            .map_err(|refused| refused.to_string())?;
        Ok(hits)
    })?
}

fn triangles(specimen: TriangleSpecimen, case: &Case) -> Counts {
    let Shape::Triangles { list, .. } = &case.shape else { return Counts::default() };
    let one = |triangle: &Triangle| {
        let mut truth = Coverage::new(case.window, 0);
        Oracle.cover(triangle.corners(), case.window, |s| truth.hit(s.y_px, s.x0_px, s.x1_px));
        let mut counts = Counts { shapes: 1, pixels: truth.covered(), ..Counts::default() };
        let Ok(hits) = specimen_coverage(specimen, &[*triangle], case.window) else {
            counts.refused = 1;
            return counts;
        };
        counts.tally = Tally::between(&hits, &truth);
        if specimen.has_values() {
            (counts.worst_attribute, counts.worst_depth) =
                values(specimen, triangle, case.window, &truth);
        }
        let off = counts.worst_attribute.max(counts.worst_depth) > VALUE_DIFFERS;
        counts.wrong = u64::from(counts.tally.total() > 0 || off);
        counts
    };
    list.iter().map(one).fold(Counts::default(), Counts::merge)
}

/// Worst errors of attribute and depth at pixels that the triangle really covers, as fractions of
/// the spread of the corner values.
fn values(
    specimen: TriangleSpecimen,
    triangle: &Triangle,
    window: PixelRect,
    truth: &Coverage,
) -> (f64, f64) {
    let v = &triangle.vertices;
    let depths = v.map(|v| specimen.depth_of(v.depth, 1.0 / v.inv_w));
    let attributes = v.map(|v| v.varying.to_array());
    let inv_w = v.map(|v| v.inv_w);
    let depth_attributes = depths.map(|depth| [depth]);
    let exact = ExactTriangle::new(&triangle.corners(), depths, inv_w, attributes);
    let exact_w = ExactTriangle::new(&triangle.corners(), depths, inv_w, depth_attributes);
    let (Some(exact), Some(exact_w)) = (exact, exact_w) else { return (0.0, 0.0) };
    let mut drawn: Vec<Fragment<DVec2>> = Vec::new();
    let _ = specimen.fragments(&from_screen(triangle), window, |f| {
        if truth.get(f.x_px, f.y_px).is_some_and(|hits| hits > 0) {
            drawn.push(f);
        }
    });
    let worse = |old: f64, new: f64| if new.is_nan() { f64::INFINITY } else { old.max(new) };
    let (mut attribute, mut depth) = (0.0, 0.0);
    for f in drawn.iter().step_by(drawn.len().div_ceil(COMPARED).max(1)) {
        let (exact_depth, [a, b]) = exact.at(f.x_px, f.y_px);
        // Chapter 6 compares w, which is linear in space and not on the screen.
        let is_w = specimen == TriangleSpecimen::BookChapter6;
        let exact_depth = if is_w { exact_w.at(f.x_px, f.y_px).1[0].clone() } else { exact_depth };
        if specimen != TriangleSpecimen::BookChapter6 {
            attribute =
                worse(attribute, a.distance(f.varying.x) / spread(attributes.map(|a| a[0])));
            attribute =
                worse(attribute, b.distance(f.varying.y) / spread(attributes.map(|a| a[1])));
        }
        depth = worse(depth, exact_depth.distance(f.depth) / spread(depths));
    }
    (attribute, depth)
}

/// Largest minus smallest, or the magnitude where they are equal.
fn spread(values: [f64; 3]) -> f64 {
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    if high > low { high - low } else { high.abs().max(f64::MIN_POSITIVE) }
}

fn lines(specimen: LineSpecimen, case: &Case) -> Counts {
    let Shape::Lines(list) = &case.shape else { return Counts::default() };
    let one = |line: &Line| {
        let mut truth = Coverage::new(case.window, 0);
        Oracle.draw(line, case.window, |f| truth.hit(f.y_px, f.x_px, f.x_px + 1));
        let mut counts = Counts { shapes: 1, pixels: truth.covered(), ..Counts::default() };
        match specimen_line_coverage(specimen, line, case.window) {
            Ok(hits) => counts.tally = Tally::between(&hits, &truth),
            Err(_) => counts.refused = 1,
        }
        counts.wrong = u64::from(counts.tally.total() > 0);
        counts
    };
    list.iter().map(one).fold(Counts::default(), Counts::merge)
}
