//! The survey of the specimens: how often each published fault shows, by family, and whether the
//! exposing case shows it while the harmless one does not.
//!
//! Truth is the oracle at the same positions: of generated triangles the one on the lattice, of
//! catalogued ones, which need not lie there, the one for free corners. Specimens that sample at
//! whole numbers receive the triangle moved by half a pixel, so a count here is a fault and no
//! convention. Triangles are judged one by one; of meshes
//! it is counted besides what several of their triangles draw.

use glam::DVec2;
use serde::Serialize;

use crate::engines::{self, Specimen};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine as _, RasterizeExact as _};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::parallel;
use rasterproof_core::triangle::{Fragment, FreeCorners, PixelPoint, ScreenTriangle, ScreenVertex};
use rasterproof_faults::published::catalogue::{
    Card, Exhibit, LineCase, RECORDED, RECORDED_SIDE_PX, RecordedCase, TriangleCase,
};
use rasterproof_faults::published::scene::{Image, Setting, Version};
use rasterproof_faults::published::{
    Published, PublishedLine, RealTriangle, RealVertex, bare, from_screen,
};
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::cases::{self, Case, Family, Line, Shape, Triangle};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::comparison::caught;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;

/// What is counted of triangles or lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Triangles or lines drawn.
    pub shapes: u64,
    /// Those with a wrong pixel or a wrong value.
    pub wrong: u64,
    pub wrong_pixels: u64,
    /// Those with a wrong value at a pixel that they cover.
    pub wrong_values: u64,
    /// Those that the specimen refuses, since the published code is undefined there.
    pub refused: u64,
    /// Pixels that the oracle covers, by which rates are divided.
    pub pixels: u64,
    /// Wrong pixels, each triangle for itself.
    pub tally: Tally,
    /// Hits of pixels that another triangle of the same mesh has too, where their interiors are
    /// disjoint: what a wrong rule for shared edges draws twice.
    pub shared: u64,
    /// Largest error of an attribute, as a fraction of the spread of its corner values; infinite
    /// where a value is not a number.
    pub worst_attribute: f64,
    /// Largest error of the depth, likewise.
    pub worst_depth: f64,
}

impl Counts {
    /// Adds what was counted elsewhere; of errors the larger one stays.
    fn merge(mut self, other: Self) -> Self {
        self.shapes += other.shapes;
        self.wrong += other.wrong;
        self.wrong_pixels += other.wrong_pixels;
        self.wrong_values += other.wrong_values;
        self.refused += other.refused;
        self.pixels += other.pixels;
        self.tally += other.tally;
        self.shared += other.shared;
        self.worst_attribute = self.worst_attribute.max(other.worst_attribute);
        self.worst_depth = self.worst_depth.max(other.worst_depth);
        self
    }

    /// The wrong ones in percent of all.
    pub fn percent(&self) -> f64 {
        self.percent_of(self.wrong)
    }

    /// A number of triangles in percent of all.
    pub fn percent_of(&self, triangles: u64) -> f64 {
        100.0 * triangles as f64 / self.shapes.max(1) as f64
    }

    /// A number of pixels per million that the oracle covers; nothing where it covers none.
    pub fn per_million(&self, pixels: u64) -> Option<f64> {
        (self.pixels > 0).then(|| 1e6 * pixels as f64 / self.pixels as f64)
    }
}

#[derive(Clone, Debug, Serialize)]
pub struct SpecimenReport {
    pub name: &'static str,
    /// The book or the course that it is from.
    pub source: &'static str,
    pub fault: &'static str,
    /// What to write instead, in a sentence.
    pub cure: &'static str,
    /// The name of the case that shows the fault.
    pub case: &'static str,
    /// Pixels, values and refusals that are wrong in it.
    pub case_wrong: u64,
    /// Pixels that are wrong in the harmless case.
    pub harmless_wrong: u64,
    /// Recorded inputs by name, and what is wrong with each.
    pub recorded: Vec<(&'static str, Counts)>,
    /// Family and counts; empty for scenes.
    pub families: Vec<(&'static str, Counts)>,
    /// All families together, as they are ranked by.
    pub all: Counts,
}

/// Values differ where they are off by more than this fraction of their spread: f32 weights, which
/// two of the specimens use, reach 1e-6 of it.
const VALUE_DIFFERS: f64 = 1e-4;
/// Fragments of a triangle that are compared with exact values.
const COMPARED: usize = 16;

/// Surveys a specimen: its cases, its recorded inputs, and `cases` cases of each family.
#[must_use]
pub fn survey(card: &Card, seed: u64, cases: u64) -> SpecimenReport {
    let specimen = engines::find(card.name).and_then(|entry| entry.specimen);
    let families: Vec<_> = match specimen {
        Some(Specimen::Triangle(specimen)) => {
            over(cases::triangles::FAMILIES, seed, cases, |case| triangles(specimen, case))
        }
        Some(Specimen::Line(specimen)) => {
            over(cases::lines::FAMILIES, seed, cases, |case| lines(specimen, case))
        }
        None => Vec::new(),
    };
    // The sum decides the order of the survey.
    let all = families.iter().fold(Counts::default(), |sum, (_, counts)| sum.merge(*counts));
    // Its own two cases, the inputs that the book shows, and cases of every family.
    let [case_wrong, harmless_wrong] =
        [Setting::Exposing, Setting::Harmless].map_array(|s| wrong(card, s));
    SpecimenReport {
        name: card.name,
        source: card.source,
        fault: card.fault,
        cure: card.cure,
        case: exposing_name(card),
        case_wrong,
        harmless_wrong,
        recorded: RECORDED
            .iter()
            .filter(|case| case.specimen == card.name)
            .map(|case| (case.name, judge_recorded(case)))
            .collect(),
        families,
        all,
    }
}

/// Cases that one core judges at a time.
const BLOCK: u64 = 16;
/// Cases whose counts are kept until they are summed, so that any number of cases takes no more memory.
const MOST_PER_ROUND: u64 = 1 << 16;

/// What is counted in so many cases of each family.
fn over(
    families: &'static [Family],
    seed: u64,
    cases: u64,
    judge: impl Fn(&Case) -> Counts + Sync,
) -> Vec<(&'static str, Counts)> {
    let mut all = Vec::new();
    for family in families {
        let (mut sum, mut done) = (Counts::default(), 0);
        while done < cases {
            let end = cases.min(done.saturating_add(MOST_PER_ROUND));
            let blocks = parallel::map((end - done).div_ceil(BLOCK) as usize, |number| {
                let first = done + number as u64 * BLOCK;
                let mut sum = Counts::default();
                for index in first..end.min(first.saturating_add(BLOCK)) {
                    sum = sum.merge(judge(&family.case(seed, index)));
                }
                sum
            });
            // In the order of the blocks, whichever was done first.
            for block in blocks {
                sum = sum.merge(block);
            }
            done = end;
        }
        all.push((family.name, sum));
    }
    all
}

/// The name of the case that shows its fault.
pub fn exposing_name(card: &Card) -> &'static str {
    match &card.exhibit {
        Exhibit::Triangles([case, _]) => case.name,
        Exhibit::Lines([case, _]) => case.name,
        Exhibit::Scene(name, _) => name,
    }
}

/// Pixels with a wrong hit count, a wrong value or a wrong colour in one of a card's cases; a
/// refusal counts as one.
pub fn wrong(card: &Card, setting: Setting) -> u64 {
    // The exposing case is the first of the two.
    let which = usize::from(setting == Setting::Harmless);
    let specimen = engines::find(card.name).and_then(|entry| entry.specimen);
    match (&card.exhibit, specimen) {
        (Exhibit::Triangles(cases), Some(Specimen::Triangle(specimen))) => {
            let counts = judge_case(specimen, &cases[which]);
            counts.tally.total() + counts.wrong_values + counts.refused
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

/// How many pixels of two pictures differ.
fn different(a: &Image, b: &Image) -> u64 {
    let mut count = 0;
    for ((_, a), (_, b)) in a.rows().zip(b.rows()) {
        for (a, b) in a.iter().zip(b) {
            count += u64::from(a != b);
        }
    }
    count
}

/// A card's triangles with their values.
pub fn real_triangles(case: &TriangleCase) -> Vec<RealTriangle> {
    let mut triangles = Vec::new();
    for corners in case.corners_px {
        triangles.push([0, 1, 2].map_array(|i| RealVertex {
            position_px: corners[i].into(),
            depth: case.values[i],
            w: case.w[i],
            varying: DVec2::splat(case.values[i]),
        }));
    }
    triangles
}

/// The same triangle on the lattice; none where a corner does not lie there.
pub fn on_lattice(triangle: &RealTriangle) -> Option<Triangle> {
    let [a, b, c] = triangle;
    Some(ScreenTriangle {
        vertices: [vertex_on_lattice(a)?, vertex_on_lattice(b)?, vertex_on_lattice(c)?],
    })
}

/// A vertex, where its position lies on the lattice.
fn vertex_on_lattice(v: &RealVertex) -> Option<ScreenVertex<DVec2>> {
    // Snapped, it must be the same position again.
    let position = SubpixelPoint::from_px(v.position_px.x, v.position_px.y).ok()?;
    let is_exact = DVec2::from(position.to_px()) == v.position_px;
    let vertex = ScreenVertex { position, depth: v.depth, inv_w: 1.0 / v.w, varying: v.varying };
    is_exact.then_some(vertex)
}

/// Hits of the oracle for free corners; none for a triangle outside the domain.
pub fn free_truth(triangles: &[RealTriangle], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for triangle in triangles {
        if let Ok(corners) = FreeCorners::new(triangle.map_array(|v| v.position_px.to_array())) {
            Oracle.cover_exact(&corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
        }
    }
    hits
}

fn judge_case(specimen: &dyn Published, case: &TriangleCase) -> Counts {
    let window = PixelRect::window(case.side_px, case.side_px);
    judge_free(specimen, &real_triangles(case), window)
}

/// Judges a recorded input; nothing where its specimen is no rasterizer.
#[must_use]
pub fn judge_recorded(case: &RecordedCase) -> Counts {
    match engines::find(case.specimen).and_then(|entry| entry.specimen) {
        Some(Specimen::Triangle(specimen)) => {
            let triangles: Vec<_> = case.corners_px().into_iter().map(bare).collect();
            let window = PixelRect::window(RECORDED_SIDE_PX, RECORDED_SIDE_PX);
            judge_free(specimen, &triangles, window)
        }
        _ => Counts::default(),
    }
}

/// Judges triangles that need not lie on the lattice.
fn judge_free(specimen: &dyn Published, triangles: &[RealTriangle], window: PixelRect) -> Counts {
    let mut counts = Counts::default();
    for triangle in triangles {
        let truth = free_truth(std::slice::from_ref(triangle), window);
        let on_lattice = on_lattice(triangle);
        counts = counts.merge(judge(specimen, triangle, on_lattice.as_ref(), window, &truth));
    }
    counts
}

/// A card's line in a window that ends some pixels beyond it, so that a pixel beside it shows.
pub fn line_case(case: &LineCase) -> Case {
    let [a, b] = case.pixels.map_array(|(x, y)| PixelPoint::new(x, y));
    let side = |a: i32, b: i32, most: u32| (a.max(b) as u32 + 3).min(most);
    let window = PixelRect::window(side(a.x, b.x, 24), side(a.y, b.y, 12));
    Case { window, shape: Shape::Lines(vec![plain_line(a, b)]) }
}

/// Hits of a specimen over triangles; a pixel that it puts outside the window is a panic.
///
/// # Errors
/// What it refuses, or the message of its panic.
pub fn specimen_coverage(
    specimen: &dyn Published,
    list: &[RealTriangle],
    window: PixelRect,
) -> Result<Coverage, String> {
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for triangle in list {
            specimen
                .cover(triangle, window, &mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px))
                .map_err(|refused| refused.to_string())?;
        }
        Ok(hits)
    })?
}

/// Hits of a line specimen.
pub fn specimen_line_coverage(
    specimen: &dyn PublishedLine,
    lines: &[Line],
    window: PixelRect,
) -> Result<Coverage, String> {
    // The centre of a pixel is its position.
    let centre = |end: PixelPoint| [f64::from(end.x) + 0.5, f64::from(end.y) + 0.5];
    caught(|| {
        let mut hits = Coverage::new(window, 0);
        for line in lines {
            // Published drawers take positions in pixels.
            let ends = line.ends.map_array(|end| centre(end.pixel));
            specimen
                .draw(ends, window, &mut |x, y| hits.hit(y, x, x + 1))
                .map_err(|refused| refused.to_string())?;
        }
        Ok(hits)
    })?
}

/// Judges a generated case of triangles.
fn triangles(specimen: &dyn Published, case: &Case) -> Counts {
    let Shape::Triangles { list, disjoint } = &case.shape else { return Counts::default() };
    let (window, mut counts) = (case.window, Counts::default());
    for triangle in list {
        let mut truth = Coverage::new(window, 0);
        Oracle.spans(triangle.corners(), window, &mut |s| truth.hit(s.y_px, s.x0_px, s.x1_px));
        let real = from_screen(triangle);
        counts = counts.merge(judge(specimen, &real, Some(triangle), window, &truth));
    }
    if *disjoint && list.len() > 1 {
        // Disjoint triangles have no pixel together, so whatever they share is drawn twice.
        counts.shared = shared(specimen, list, case.window);
    }
    counts
}

/// Pixels of each triangle alone, less those of all together; none where one is refused.
fn shared(specimen: &dyn Published, list: &[Triangle], window: PixelRect) -> u64 {
    let mesh: Vec<RealTriangle> = list.iter().map(from_screen).collect();
    let Ok(together) = specimen_coverage(specimen, &mesh, window) else { return 0 };
    let mut each = 0u64;
    for triangle in &mesh {
        if let Ok(alone) = specimen_coverage(specimen, &[*triangle], window) {
            each += alone.covered();
        }
    }
    each.saturating_sub(together.covered())
}

/// Compares hits with the truth, and values where the triangle lies on the lattice.
fn judge(
    specimen: &dyn Published,
    triangle: &RealTriangle,
    on_lattice: Option<&Triangle>,
    window: PixelRect,
    truth: &Coverage,
) -> Counts {
    let mut counts = Counts { shapes: 1, pixels: truth.covered(), ..Counts::default() };
    // A refusal is counted, and is neither right nor wrong.
    let Ok(hits) = specimen_coverage(specimen, &[*triangle], window) else {
        counts.refused = 1;
        return counts;
    };
    counts.tally = Tally::between(&hits, truth);
    if let Some(triangle) = on_lattice.filter(|_| specimen.has_values()) {
        (counts.worst_attribute, counts.worst_depth) = values(specimen, triangle, window, truth);
    }
    // A triangle may be wrong in its pixels, in its values, or in both.
    let off = counts.worst_attribute.max(counts.worst_depth) > VALUE_DIFFERS;
    counts.wrong_pixels = u64::from(counts.tally.total() > 0);
    counts.wrong_values = u64::from(off);
    counts.wrong = counts.wrong_pixels | counts.wrong_values;
    counts
}

/// Worst errors of attribute and depth at pixels that the triangle really covers, as fractions of
/// the spread of the corner values.
fn values(
    specimen: &dyn Published,
    triangle: &Triangle,
    window: PixelRect,
    truth: &Coverage,
) -> (f64, f64) {
    let v = &triangle.vertices;
    // The exact values of what the specimen interpolates: its own kind of depth, and the attributes.
    let depths = v.map_array(|v| specimen.depth_of(v.depth, 1.0 / v.inv_w));
    let attributes = v.map_array(|v| v.varying.to_array());
    let inv_w = v.map_array(|v| v.inv_w);
    let depth_attributes = depths.map_array(|depth| [depth]);
    let exact = ExactTriangle::new(&triangle.corners(), depths, inv_w, attributes);
    let exact_w = ExactTriangle::new(&triangle.corners(), depths, inv_w, depth_attributes);
    let (Some(exact), Some(exact_w)) = (exact, exact_w) else { return (0.0, 0.0) };
    // Only at pixels that the triangle covers has it a value that could be wrong.
    let mut drawn: Vec<Fragment<DVec2>> = Vec::new();
    let _ = specimen.fragments(&from_screen(triangle), window, &mut |f| {
        if truth.get(f.x_px, f.y_px).is_some_and(|hits| hits > 0) {
            drawn.push(f);
        }
    });
    let (mut attribute, mut depth) = (0.0, 0.0);
    let spreads = [0, 1].map_array(|i| spread(attributes.map_array(|a| a[i])));
    // Some of them, evenly, for exact values take long.
    for f in drawn.iter().step_by(drawn.len().div_ceil(COMPARED).max(1)) {
        let (exact_depth, [a, b]) = exact.at(f.x_px, f.y_px);
        // Chapter 6 compares w, which is linear in space and not on the screen.
        let is_w = specimen.compares_w();
        let exact_depth = if is_w { exact_w.at(f.x_px, f.y_px).1[0].clone() } else { exact_depth };
        if !is_w {
            attribute = worse(attribute, a.distance(f.varying.x) / spreads[0]);
            attribute = worse(attribute, b.distance(f.varying.y) / spreads[1]);
        }
        depth = worse(depth, exact_depth.distance(f.depth) / spread(depths));
    }
    (attribute, depth)
}

/// The larger of two errors; what is no number is an infinite one.
fn worse(old: f64, new: f64) -> f64 {
    if new.is_nan() { f64::INFINITY } else { old.max(new) }
}

/// Largest minus smallest, or the magnitude where they are equal.
fn spread(values: [f64; 3]) -> f64 {
    let [a, b, c] = values;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    if high > low { high - low } else { high.abs().max(f64::MIN_POSITIVE) }
}

/// Compares each line of a case with the oracle's pixels.
fn lines(specimen: &dyn PublishedLine, case: &Case) -> Counts {
    let Shape::Lines(list) = &case.shape else { return Counts::default() };
    let mut sum = Counts::default();
    for line in list {
        let mut truth = Coverage::new(case.window, 0);
        Oracle.draw(line, case.window, |f| truth.hit(f.y_px, f.x_px, f.x_px + 1));
        let mut counts = Counts { shapes: 1, pixels: truth.covered(), ..Counts::default() };
        match specimen_line_coverage(specimen, std::slice::from_ref(line), case.window) {
            Ok(hits) => counts.tally = Tally::between(&hits, &truth),
            Err(_) => counts.refused = 1,
        }
        counts.wrong = u64::from(counts.tally.total() > 0);
        counts.wrong_pixels = counts.wrong;
        sum = sum.merge(counts);
    }
    sum
}
