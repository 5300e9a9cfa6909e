//! The file of fixtures: small hard cases with their pixels, for the test suites of other projects.
//!
//! Each case is shrunk while every planted fault that draws it wrong goes on doing so, and while its vertices stay on
//! the same fine or coarse grid. What is expected says for each number of bits below the pixel which pixels are hit,
//! which may be either, since corners off that grid may be moved to it up or down, and which lie on the outline, where
//! the top-left rule decides and other specifications decide otherwise or not at all.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::engines::{Engine, LineEngine};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::{centre_of, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::parallel;
use rasterproof_core::triangle::{Corners, PixelPoint};
use rasterproof_faults::planted::{LineMutant, TileMutant, TriangleMutant};
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_tiles::coverage::CoverList as _;
use rasterproof_verify::cases::named::{plain_line, plain_triangle};
use rasterproof_verify::cases::shrink::{greedy, shrink};
use rasterproof_verify::cases::{self, Case, Shape};
use rasterproof_verify::comparison::{caught, line_coverage};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::partition::{Coordinates, Family};

/// The name and the version of the format.
pub const FORMAT: &str = "rasterproof-fixtures/2";
/// How many cases there are of each kind.
pub const QUOTAS: [(Kind, usize); 5] = [
    (Kind::Triangle, 400),
    (Kind::Fan, 150),
    (Kind::Strip, 150),
    (Kind::Line, 150),
    (Kind::Samples4, 150),
];
/// The numbers of bits below the pixel.
const BITS: std::ops::RangeInclusive<u32> = 4..=SUBPIXEL_BITS;

/// How the points of a case are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Three corners, at the centre of each pixel.
    Triangle,
    /// The first point with each pair of the following ones.
    Fan,
    /// Each three points in a row.
    Strip,
    /// From one pixel to another, both named by column and row.
    Line,
    /// Three corners, at four samples of each pixel.
    Samples4,
}

/// Row, first column, one past the last.
pub type Run = [i32; 3];

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixtures {
    /// [`FORMAT`].
    pub format: String,
    /// The version of this project that made the file.
    pub rasterproof: String,
    pub seed: u64,
    /// Where the samples of a kind lie in a pixel, in px from its upper left corner.
    pub samples: BTreeMap<String, Vec<[f64; 2]>>,
    pub cases: Vec<Fixture>,
    pub polygons: Vec<PolygonFixture>,
}

/// A polygon for tessellators. The triangles that make it up have its area.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PolygonFixture {
    pub family: String,
    /// Inside is where they run around a point an odd number of times.
    pub contours: Vec<Vec<[i32; 2]>>,
    /// In square units of the coordinates.
    pub twice_area: i64,
}

pub const POLYGONS: usize = 200;
/// Of each family, the smallest of so many are taken.
const POLYGONS_LOOKED_AT: u64 = 200;

impl PolygonFixture {
    /// The polygon of a family, in whole numbers.
    fn new(family: Family, seed: u64, index: u64) -> Self {
        let polygon = family.polygon(seed, index, Coordinates::Integer);
        let (mut contours, mut twice_area) = (Vec::new(), 0);
        for contour in &polygon.contours {
            let whole: Vec<_> = contour.iter().map(|point| point.map(|v| v as i32)).collect();
            // Contours turn one way around what is inside and the other way around holes, so their areas add up.
            twice_area += shoelace(&whole);
            contours.push(whole);
        }
        Self { family: family.name().to_owned(), contours, twice_area: twice_area.abs() }
    }

    /// Fewer vertices come first, then fewer digits.
    fn size(&self) -> (usize, usize) {
        let vertices = self.contours.iter().map(Vec::len).sum();
        (vertices, format!("{:?}", self.contours).len())
    }
}

/// Twice the area of a polygon, with the sign of the way in which it turns.
fn shoelace(contour: &[[i32; 2]]) -> i64 {
    let mut sum = 0;
    for (i, &[ax, ay]) in contour.iter().enumerate() {
        let [bx, by] = contour[(i + 1) % contour.len()];
        sum += i64::from(ax) * i64::from(by) - i64::from(bx) * i64::from(ay);
    }
    sum
}

/// The smallest polygons of each family: the same number of each, but for one.
fn polygons(seed: u64) -> Vec<PolygonFixture> {
    let mut all = Vec::new();
    // What is left is shared evenly among the families that follow.
    let mut families = Family::ALL.len();
    for family in Family::ALL {
        let mut found: Vec<_> =
            (0..POLYGONS_LOOKED_AT).map(|i| PolygonFixture::new(family, seed, i)).collect();
        found.sort_by_key(|polygon| (polygon.size(), polygon.clone()));
        found.dedup();
        found.truncate((POLYGONS - all.len()).div_ceil(families));
        families -= 1;
        all.extend(found);
    }
    all
}

/// A case, and what is expected of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixture {
    pub kind: Kind,
    /// Columns and rows of the picture, which begins at (0, 0).
    pub window: [u32; 2],
    /// In px, y down; of a line whole columns and rows.
    pub points: Vec<[f64; 2]>,
    /// The planted fault for which it was found.
    pub found_by: String,
    /// Its pixels, for every number of bits below the pixel.
    pub expected: Vec<ExpectedPictures>,
}

/// What is expected of rasterizers with some numbers of bits below the pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedPictures {
    /// From the first to the last number of bits, both included.
    pub bits: [u32; 2],
    /// The pictures of the samples of a pixel, in the order of [`Fixtures::samples`].
    pub samples: Vec<Pixels>,
}

/// Pixels of one sample place. What is in none of the lists must not be hit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pixels {
    /// Hit exactly once, however corners are moved to the grid.
    pub hit: Vec<Run>,
    /// Hit once or not, since a corner off the grid may be moved to it up or down.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub either: Vec<Run>,
    /// Samples exactly on the outline: by the top-left rule hit if they are in `hit`, else not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<Run>,
}

/// A planted fault that draws what the fixtures hold.
#[derive(Clone, Copy, Debug)]
pub enum Fault {
    Triangle(TriangleMutant),
    Tile(TileMutant),
    Line(LineMutant),
}

impl Fault {
    /// Every fault that can be seen in pixels, engines first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        all.extend(TriangleMutant::ALL.map(Self::Triangle));
        all.extend(TileMutant::ALL.map(Self::Tile));
        all.extend(LineMutant::ALL.map(Self::Line));
        all
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Triangle(mutant) => mutant.name(),
            Self::Tile(mutant) => mutant.name(),
            Self::Line(mutant) => mutant.name(),
        }
    }
}

/// Whoever draws a case: engines of both kinds, or a planted fault.
#[derive(Clone, Copy, Debug)]
pub enum Drawer {
    /// A rasterizer for triangles, a line drawer for lines.
    Engines(Engine, LineEngine),
    Fault(Fault),
}

/// A case in subpixels or, of a line, whole pixels.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Drawing {
    kind: Kind,
    window: [u32; 2],
    /// In subpixels; of a line whole pixels.
    points: Vec<SubpixelPoint>,
}

impl Drawing {
    /// The drawing that a fixture holds.
    fn of(fixture: &Fixture) -> Self {
        let unit = if fixture.kind == Kind::Line { 1.0 } else { f64::from(SUBPIXELS) };
        let mut points = Vec::with_capacity(fixture.points.len());
        for [x, y] in &fixture.points {
            points.push(SubpixelPoint::new((x * unit) as i32, (y * unit) as i32));
        }
        Self { kind: fixture.kind, window: fixture.window, points }
    }

    /// The drawing as a fixture, with what is expected of it.
    fn fixture(&self, found_by: &str) -> Fixture {
        let unit = if self.kind == Kind::Line { 1.0 } else { f64::from(SUBPIXELS) };
        let mut points = Vec::with_capacity(self.points.len());
        for p in &self.points {
            points.push([f64::from(p.x) / unit, f64::from(p.y) / unit]);
        }
        Fixture {
            kind: self.kind,
            window: self.window,
            points,
            found_by: found_by.to_owned(),
            expected: self.expected(),
        }
    }

    fn rect(&self) -> PixelRect {
        PixelRect::window(self.window[0], self.window[1])
    }

    /// What is added to corners so that each sample of a pixel lies at its centre.
    fn offsets(&self) -> Vec<[i32; 2]> {
        match self.kind {
            Kind::Samples4 => {
                SAMPLES.iter().map(|&(x, y)| [x, y].map_array(|v| HALF_PIXEL - 16 * v)).collect()
            }
            _ => vec![[0, 0]],
        }
    }

    /// The triangles of these points; a line has none.
    fn triangles(&self, points: &[SubpixelPoint]) -> Vec<Corners> {
        let mut triangles = Vec::new();
        for i in 2..points.len() {
            match self.kind {
                Kind::Line => {}
                Kind::Fan => triangles.push([points[0], points[i - 1], points[i]]),
                _ => triangles.push([points[i - 2], points[i - 1], points[i]]),
            }
        }
        triangles
    }

    /// The line between the first two points, which are pixels.
    fn line(&self) -> cases::Line {
        let [a, b] = [0, 1].map_array(|i| PixelPoint::new(self.points[i].x, self.points[i].y));
        plain_line(a, b)
    }

    /// What is expected for every number of bits, neighbouring numbers with the same pictures together.
    fn expected(&self) -> Vec<ExpectedPictures> {
        if self.kind == Kind::Line {
            let (mut hit, outline) = (Coverage::new(self.rect(), 0), self.halfway());
            Oracle.steps(&self.line(), self.rect(), &mut |at, _| hit.hit(at.y, at.x, at.x + 1));
            let pixels = Pixels { hit: runs(&hit), either: Vec::new(), outline: runs(&outline) };
            return vec![ExpectedPictures {
                bits: [*BITS.start(), *BITS.end()],
                samples: vec![pixels],
            }];
        }
        // Neighbouring numbers of bits often have the same pictures, and are one entry then.
        let mut found: Vec<ExpectedPictures> = Vec::new();
        for bits in BITS {
            let samples: Vec<_> =
                self.offsets().into_iter().map(|offset| self.pixels(bits, offset)).collect();
            match found.last_mut().filter(|last| last.samples == samples) {
                Some(last) => last.bits[1] = bits,
                None => found.push(ExpectedPictures { bits: [bits, bits], samples }),
            }
        }
        found
    }

    /// The pixels for so many bits, by every way to move corners to that grid.
    fn pixels(&self, bits: u32, offset: [i32; 2]) -> Pixels {
        let window = self.rect();
        let [mut always, mut ever, mut outline] = [(); 3].map_array(|()| Coverage::new(window, 0));
        for (number, points) in self.on_grid(bits).into_iter().enumerate() {
            let triangles = self.triangles(&moved(&points, offset));
            let mut hits = Coverage::new(window, 0);
            for corners in &triangles {
                Oracle.spans(*corners, window, &mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
            }
            for (y, row) in hits.rows() {
                for (x, &hits) in row.iter().enumerate() {
                    let is_hit = u8::from(hits > 0);
                    let always = &mut always.row_mut(y)[x];
                    *always = if number == 0 { is_hit } else { *always & is_hit };
                    ever.row_mut(y)[x] |= is_hit;
                }
            }
            mark_outline(&triangles, &mut outline);
        }
        // What is hit by some ways and not by all of them may be either.
        let mut either = ever;
        for (y, row) in always.rows() {
            for (x, &always) in row.iter().enumerate() {
                either.row_mut(y)[x] &= 1 - always;
            }
        }
        Pixels { hit: runs(&always), either: runs(&either), outline: runs(&outline) }
    }

    /// The points on the grid of so many bits, in each way that moves every coordinate by less than a step.
    fn on_grid(&self, bits: u32) -> Vec<Vec<SubpixelPoint>> {
        let step = SUBPIXELS >> bits;
        let mut ways: Vec<Vec<SubpixelPoint>> = vec![Vec::new()];
        for p in &self.points {
            let [xs, ys] = [p.x, p.y].map_array(|v| {
                let down = v.div_euclid(step) * step;
                if down == v { vec![v] } else { vec![down, down + step] }
            });
            // Each way so far, with each place of this point.
            let mut longer = Vec::new();
            for way in &ways {
                for &x in &xs {
                    for &y in &ys {
                        longer.push([&way[..], &[SubpixelPoint::new(x, y)]].concat());
                    }
                }
            }
            ways = longer;
        }
        ways
    }

    /// Coordinates that are no multiple of 1/16 px.
    fn fine_coordinates(&self) -> usize {
        let mut count = 0;
        for p in &self.points {
            count += usize::from(p.x.rem_euclid(16) != 0) + usize::from(p.y.rem_euclid(16) != 0);
        }
        count
    }

    /// The two pixels of each step in which a line passes halfway between them.
    fn halfway(&self) -> Coverage {
        let mut found = Coverage::new(self.rect(), 0);
        let [a, b] =
            [self.points[0], self.points[1]].map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let steps = dx.abs().max(dy.abs());
        // A step along the longer axis moves by minor / steps across it.
        let is_flat = dx.abs() >= dy.abs();
        let (minor, sign) = if is_flat { (dy, dx.signum()) } else { (dx, dy.signum()) };
        for y in 0..i64::from(self.window[1]) {
            for x in 0..i64::from(self.window[0]) {
                let [along, beside] =
                    if is_flat { [x - a[0], y - a[1]] } else { [y - a[1], x - a[0]] };
                let step = along * sign;
                let off = 2 * (beside * steps - minor * step).abs();
                if (0..=steps).contains(&step) && steps > 0 && off == steps {
                    found.hit(y as i32, x as i32, x as i32 + 1);
                }
            }
        }
        found
    }

    /// What is drawn, for each sample; nothing where the drawer panics.
    fn drawn(&self, drawer: Drawer) -> Option<Vec<Coverage>> {
        let window = self.rect();
        match drawer {
            Drawer::Engines(_, line) if self.kind == Kind::Line => {
                line_coverage(&line, &[self.line()], window).ok().map(|hits| vec![hits])
            }
            Drawer::Fault(Fault::Line(mutant)) if self.kind == Kind::Line => {
                line_coverage(&mutant, &[self.line()], window).ok().map(|hits| vec![hits])
            }
            _ if self.kind == Kind::Line => None,
            _ => {
                // With several samples the case is drawn once for each of them.
                let offsets = self.offsets().into_iter();
                offsets.map(|offset| self.drawn_moved(drawer, offset)).collect()
            }
        }
    }

    /// What is drawn at one place of samples.
    fn drawn_moved(&self, drawer: Drawer, offset: [i32; 2]) -> Option<Coverage> {
        let window = self.rect();
        let triangles = self.triangles(&moved(&self.points, offset));
        // A fault may panic, as real code does; then it has drawn nothing.
        let drawn = caught(|| {
            let mut hits = Coverage::new(window, 0);
            match drawer {
                Drawer::Fault(Fault::Tile(mutant)) => {
                    mutant.cover_list(&triangles, window, &mut |pieces| {
                        for piece in pieces {
                            piece.spans(&mut |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                        }
                    });
                }
                Drawer::Fault(Fault::Triangle(mutant)) => {
                    for &corners in &triangles {
                        mutant.spans(corners, window, &mut |s| {
                            hits.hit(s.y_px, s.x0_px, s.x1_px);
                        });
                    }
                }
                Drawer::Engines(engine, _) => {
                    for &corners in &triangles {
                        engine.cover(corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                    }
                }
                Drawer::Fault(Fault::Line(_)) => {}
            }
            hits
        });
        drawn.ok()
    }

    /// Whether a fault is of what is drawn here.
    fn applies(&self, fault: Fault) -> bool {
        matches!(fault, Fault::Line(_)) == (self.kind == Kind::Line)
    }

    /// The truth for 8 bits, as hits.
    fn truth(&self) -> Vec<Coverage> {
        let oracle = Drawer::Engines(Engine::Oracle, LineEngine::Oracle);
        self.drawn(oracle).unwrap_or_default()
    }

    /// Which of the faults draw it wrong.
    fn killed(&self, faults: &[Fault]) -> Vec<bool> {
        let truth = self.truth();
        let mut killed = Vec::with_capacity(faults.len());
        for &fault in faults {
            let is_right = || self.drawn(Drawer::Fault(fault)).as_ref() == Some(&truth);
            killed.push(self.applies(fault) && !is_right());
        }
        killed
    }

    /// Whether every pixel is hit at most once, as in meshes that do not fold over.
    fn is_single(&self) -> bool {
        let once = |hits: &Coverage| hits.rows().all(|(_, row)| row.iter().all(|&hits| hits < 2));
        self.truth().iter().all(once)
    }
}

/// Points moved by an offset, as far as there are coordinates.
fn moved(points: &[SubpixelPoint], [dx, dy]: [i32; 2]) -> Vec<SubpixelPoint> {
    let mut moved = Vec::with_capacity(points.len());
    for p in points {
        moved.push(SubpixelPoint::new(p.x.saturating_add(dx), p.y.saturating_add(dy)));
    }
    moved
}

/// Marks samples on edges that belong to one triangle alone; a triangle without area has none.
fn mark_outline(triangles: &[Corners], outline: &mut Coverage) {
    // How many triangles each edge belongs to, whichever way they run along it.
    let mut edges: BTreeMap<[SubpixelPoint; 2], u32> = BTreeMap::new();
    for [a, b, c] in triangles.iter().filter(|corners| twice_area(corners) != 0) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *edges.entry([*from.min(to), *from.max(to)]).or_default() += 1;
        }
    }
    let window = outline.bounds();
    for ([a, b], count) in edges {
        // An edge of two triangles lies inside of both together.
        if count % 2 == 0 {
            continue;
        }
        let (xs, ys) = (a.x.min(b.x)..=a.x.max(b.x), a.y.min(b.y)..=a.y.max(b.y));
        for y_px in window.y0..window.y1 {
            for x_px in window.x0..window.x1 {
                let sample = centre_of(x_px, y_px);
                let is_near = xs.contains(&sample.x) && ys.contains(&sample.y);
                if is_near && twice_area(&[a, b, sample]) == 0 {
                    outline.row_mut(y_px)[(x_px - window.x0) as usize] = 1;
                }
            }
        }
    }
}

/// The pixels that are hit, as runs of the rows.
fn runs(pixels: &Coverage) -> Vec<Run> {
    let mut found: Vec<Run> = Vec::new();
    for (y, row) in pixels.rows() {
        for (x, hits) in (pixels.bounds().x0..).zip(row) {
            match found.last_mut() {
                _ if *hits == 0 => {}
                Some(run) if run[0] == y && run[2] == x => run[2] += 1,
                _ => found.push([y, x, x + 1]),
            }
        }
    }
    found
}

impl Pixels {
    /// Whether these are hit once: all that must be, and of the others only those that may be.
    fn accept(&self, drawn: &Coverage) -> bool {
        for (y, row) in drawn.rows() {
            for (x, &hits) in (0..).zip(row) {
                let is_right = match hits {
                    0 => !holds(&self.hit, x, y),
                    1 => holds(&self.hit, x, y) || holds(&self.either, x, y),
                    _ => false,
                };
                if !is_right {
                    return false;
                }
            }
        }
        true
    }
}

/// Whether a pixel lies in one of these runs.
fn holds(runs: &[Run], x: i32, y: i32) -> bool {
    runs.iter().any(|&[row, x0, x1]| row == y && (x0..x1).contains(&x))
}

impl Fixture {
    /// Whether a picture is the expected one of rasterizers with 8 bits and the top-left rule.
    #[must_use]
    pub fn accepts(&self, drawer: Drawer) -> bool {
        let Some(drawn) = Drawing::of(self).drawn(drawer) else { return false };
        // The pictures for 8 bits below the pixel, which all engines here have.
        let Some(expected) = self.expected.iter().find(|e| e.bits[1] == SUBPIXEL_BITS) else {
            return false;
        };
        drawn.len() == expected.samples.len()
            && drawn.iter().zip(&expected.samples).all(|(drawn, pixels)| pixels.accept(drawn))
    }

    /// Whether a fault is of what is drawn here.
    #[must_use]
    pub fn applies(&self, fault: Fault) -> bool {
        Drawing::of(self).applies(fault)
    }

    /// The same with what is expected computed anew.
    #[must_use]
    pub fn anew(&self) -> Self {
        Drawing::of(self).fixture(&self.found_by)
    }
}

/// The families that cases of a kind come from, by name; windows of `far` do not begin at the origin.
fn families(kind: Kind) -> Vec<&'static cases::Family> {
    cases::families().filter(|family| has_cases_of(family.name, kind)).collect()
}

/// Whether cases of a family are drawings of this kind that begin at the origin.
fn has_cases_of(family: &str, kind: Kind) -> bool {
    match kind {
        Kind::Fan => family == "fan",
        Kind::Strip => family == "strip",
        Kind::Line => family.starts_with("line-"),
        Kind::Triangle | Kind::Samples4 => {
            !family.starts_with("line-")
                && !family.starts_with("w-")
                && !["fan", "strip", "rectangle", "far", "off-screen"].contains(&family)
        }
    }
}

/// A generated case as a drawing; nothing for one that is no drawing of this kind.
fn drawing(kind: Kind, case: &Case) -> Option<Drawing> {
    let window = case.window;
    if (window.x0, window.y0) != (0, 0) {
        return None;
    }
    let points = match &case.shape {
        Shape::Lines(lines) => {
            let ends = lines.first()?.ends;
            ends.iter().map(|end| SubpixelPoint::new(end.pixel.x, end.pixel.y)).collect()
        }
        Shape::Triangles { list, .. } => {
            // A mesh becomes the list of points that makes it up.
            let corners: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
            let first = corners.first()?;
            match kind {
                // Each further triangle adds one point.
                Kind::Fan | Kind::Strip => {
                    let mut points = first.to_vec();
                    points.extend(corners[1..].iter().map(|corners| corners[2]));
                    points
                }
                _ => first.to_vec(),
            }
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => return None,
    };
    Some(Drawing { kind, window: [window.width(), window.height()], points })
}

/// The smallest drawing reached from one for which `fails` holds, and goes on holding.
fn smallest(start: Drawing, fails: &dyn Fn(&Drawing) -> bool) -> Drawing {
    let kind = start.kind;
    if matches!(kind, Kind::Fan | Kind::Strip) {
        return greedy(start, mesh_size, mesh_candidates, fails);
    }
    let window = start.rect();
    // A single shape is shrunk as every other case is.
    let shape = match kind {
        Kind::Line => Shape::Lines(vec![start.line()]),
        _ => {
            let corners = [start.points[0], start.points[1], start.points[2]];
            Shape::Triangles { list: vec![plain_triangle(corners)], disjoint: false }
        }
    };
    // Shrinking may leave the kind, as where two ends fall on one pixel.
    let case =
        shrink(Case { window, shape }, |case| drawing(kind, case).is_some_and(|d| fails(&d)));
    drawing(kind, &case).unwrap_or(start)
}

/// Points, then coordinates that are no multiple of half a pixel, then how far the points lie, then the window.
fn mesh_size(drawing: &Drawing) -> (usize, usize, i64, u32) {
    let (mut odd, mut far) = (0, 0);
    for v in drawing.points.iter().flat_map(|p| [p.x, p.y]) {
        odd += usize::from(v.rem_euclid(HALF_PIXEL) != 0);
        far += i64::from(v).abs();
    }
    (drawing.points.len(), odd, far, drawing.window[0] + drawing.window[1])
}

/// Drawings that may be smaller than a mesh, the greatest steps first.
fn mesh_candidates(drawing: &Drawing) -> Vec<Drawing> {
    let mut found = Vec::new();
    let mut add = |points: Vec<SubpixelPoint>| found.push(Drawing { points, ..drawing.clone() });
    // Without one of its points.
    if drawing.points.len() > 4 {
        for i in 0..drawing.points.len() {
            let mut fewer = drawing.points.clone();
            fewer.remove(i);
            add(fewer);
        }
    }
    // Nearer to the origin as a whole, by whole pixels.
    for (dx, dy) in [(4, 0), (0, 4), (1, 0), (0, 1)] {
        let mut nearer = drawing.points.clone();
        for p in &mut nearer {
            *p = SubpixelPoint::new(p.x - dx * SUBPIXELS, p.y - dy * SUBPIXELS);
        }
        add(nearer);
    }
    // One coordinate simpler: on the border or in the middle of its pixel, or nearer to 0.
    for i in 0..drawing.points.len() {
        for axis in 0..2 {
            let SubpixelPoint { x, y } = drawing.points[i];
            let v = if axis == 0 { x } else { y };
            // The left or upper border of the pixel in which it lies.
            let border = v.div_euclid(SUBPIXELS) * SUBPIXELS;
            // Half of it on a grid of sixteenths, and a pixel or half of one nearer to 0.
            let nearer = [
                v / 2 / 16 * 16,
                v - v.signum() * SUBPIXELS.min(v.abs()),
                v - v.signum() * HALF_PIXEL.min(v.abs()),
            ];
            for simpler in [border, border + HALF_PIXEL].into_iter().chain(nearer) {
                let mut points = drawing.points.clone();
                points[i] = if axis == 0 {
                    SubpixelPoint::new(simpler, y)
                } else {
                    SubpixelPoint::new(x, simpler)
                };
                add(points);
            }
        }
    }
    // A smaller window, as long as it has a pixel.
    let [width, height] = drawing.window;
    for window in
        [[width / 2, height], [width, height / 2], [width - 1, height], [width, height - 1]]
    {
        if window[0] > 0 && window[1] > 0 {
            found.push(Drawing { window, ..drawing.clone() });
        }
    }
    found
}

/// Cases that one round looks at for each fault.
const TRIES: u64 = 60;

/// A small drawing that this fault, and every fault that its origin kills, draws wrong.
fn find(kind: Kind, faults: &[Fault], number: usize, seed: u64, round: u64) -> Option<Drawing> {
    // Families in turn, and in each one cases that no other fault has looked at.
    let families = families(kind);
    // Every other round keeps corners that lie on no coarse grid; meshes lie on one, since each of their coordinates
    // doubles the ways to move it.
    let is_fine = round % 2 == 1 && matches!(kind, Kind::Triangle | Kind::Samples4);
    for attempt in round * TRIES..(round + 1) * TRIES {
        let family = families[(attempt % families.len() as u64) as usize];
        // A case of the family that this round comes to.
        let mut start = drawing(kind, &family.case(seed, attempt + 1_000_003 * number as u64))?;
        if matches!(kind, Kind::Fan | Kind::Strip) {
            for p in &mut start.points {
                *p = SubpixelPoint::new((p.x + 8) & !15, (p.y + 8) & !15);
            }
        }
        if !start.is_single() || is_fine && start.fine_coordinates() == 0 {
            continue;
        }
        // It stays small only while it shows everything that it shows now.
        let killed = start.killed(faults);
        if !killed[number] {
            continue;
        }
        let fails = |d: &Drawing| {
            d.is_single()
                && (!is_fine || d.fine_coordinates() > 0)
                && d.killed(faults).iter().zip(&killed).all(|(now, before)| *now || !before)
        };
        return Some(smallest(start, &fails));
    }
    None
}

/// A low triangle whose width in subpixels overflows `i32`. Random corners that far apart are as far apart in y.
fn wider_than_i32() -> Drawing {
    let points = [(-4_300_000, -1), (4_300_000, -1), (0, 2)];
    let points = points.map(|(x, y)| SubpixelPoint::new(x * SUBPIXELS, y * SUBPIXELS));
    Drawing { kind: Kind::Triangle, window: [1, 1], points: points.to_vec() }
}

/// Makes the fixtures. `progress` hears of each that was found.
pub fn generate(seed: u64, progress: &(dyn Fn(u64) + Sync)) -> Fixtures {
    let mut cases = Vec::new();
    for (kind, quota) in QUOTAS {
        let is_line = kind == Kind::Line;
        // Faults of lines are not seen in triangles, and the other way round.
        let faults: Vec<_> =
            Fault::all().into_iter().filter(|f| matches!(f, Fault::Line(_)) == is_line).collect();
        let mut alive: Vec<usize> = (0..faults.len()).collect();
        // Sorted and without repetitions, since several faults may lead to one drawing.
        let mut found: BTreeMap<Drawing, &str> = BTreeMap::new();
        if kind == Kind::Triangle {
            found.insert(wider_than_i32(), TileMutant::WrappedWidth.name());
        }
        for round in 0.. {
            // Each fault that is still looked for gets a drawing a round.
            let drawings = parallel::map(alive.len(), |i| {
                (alive[i], find(kind, &faults, alive[i], seed, round))
            });
            // A fault that nothing showed in the first rounds is none of these pictures.
            if round == 4 {
                let named: Vec<_> = found.values().copied().collect();
                alive.retain(|&number| named.contains(&faults[number].name()));
            }
            if round > 400 || alive.is_empty() {
                break;
            }
            // The same drawing may be found for several faults; it keeps the name of the first.
            let before = found.len();
            for (number, drawing) in drawings {
                if let Some(drawing) = drawing.filter(|_| found.len() < quota) {
                    found.entry(drawing).or_insert(faults[number].name());
                }
            }
            progress((found.len() - before) as u64);
            if found.len() == quota {
                break;
            }
        }
        cases.extend(found.iter().map(|(drawing, found_by)| drawing.fixture(found_by)));
    }
    let four = SAMPLES.map(|(x, y)| [f64::from(x) / 16.0, f64::from(y) / 16.0]).to_vec();
    Fixtures {
        format: FORMAT.to_owned(),
        rasterproof: env!("CARGO_PKG_VERSION").to_owned(),
        seed,
        samples: [("samples4".to_owned(), four), ("others".to_owned(), vec![[0.5, 0.5]])].into(),
        cases,
        polygons: polygons(seed),
    }
}

impl Fixtures {
    /// As text, a case or a polygon a line.
    pub fn to_json(&self) -> String {
        // The head is one line, then a line for each case, which version control compares well.
        let head = serde_json::json!({
            "format": self.format, "rasterproof": self.rasterproof, "seed": self.seed, "samples": self.samples,
        });
        let cases = lines(&self.cases);
        let polygons = lines(&self.polygons);
        let head = head.to_string();
        let open = head.strip_suffix('}').unwrap_or(&head);
        format!("{open},\"cases\":[\n{cases}\n],\"polygons\":[\n{polygons}\n]}}\n")
    }
}

fn lines<T: Serialize>(all: &[T]) -> String {
    let json = |one: &T| serde_json::to_string(one).unwrap_or_default();
    all.iter().map(json).collect::<Vec<_>>().join(",\n")
}
