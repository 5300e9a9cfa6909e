//! What each check expects in a cell, and how a pixel that differs stands to the specification.
//!
//! Where a rule decides, the pixels of the top-left rule are expected, and a pixel that differs is looked at more closely: whether any
//! rule, any rounding of positions, or a bound of depths allows it. So a device is not called wrong for a choice that is its own.

use super::place::{Place, RULES, cover, on_shared_edge, place};
use super::subjects::{area, is_front, whole};
use super::{Device, Drawing, Interface, Topic, Vertex};
use rasterproof_core::geometry::{centre_of, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::single_precision::depth_bounds;
use rasterproof_verify::oracle::clipped::{self, borders};
use rasterproof_verify::oracle::segments::{self, Ends, Fit, Pixels};
use rasterproof_verify::specification::Standing;

/// The standard places of four samples in subpixels.
pub(super) const SAMPLES: [[i32; 2]; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];

/// Pixels whose centres, or samples, are judged: hits in planes of a cell, one for each sample that is read.
pub(super) type Planes = Vec<Vec<u8>>;

/// How many planes a check reads.
pub(super) fn planes(check: Topic, device: Device) -> usize {
    match check {
        Topic::Samples if device.samples_apart => 4,
        // The first drawing and the second.
        Topic::Twice => 2,
        _ => 1,
    }
}

/// What is expected of a subject, by the top-left rule where a rule decides.
pub(super) fn expected(check: Topic, device: Device, subject: &Drawing, cell: i32) -> Planes {
    // Values are compared elsewhere; of all other checks this is the number of hits in each pixel.
    let mut hits = vec![vec![0; (cell * cell) as usize]; planes(check, device)];
    match check {
        Topic::Lines => {
            for ends in subject.ends() {
                for (x, y) in segments::diamonds(&ends, cell) {
                    hits[0][(y * cell + x) as usize] = 1;
                }
            }
        }
        Topic::NearPlane => {
            if let Some(borders) = whole(subject).and_then(|corners| borders(&corners)) {
                for (pixel, hits) in pixels(cell).zip(&mut hits[0]) {
                    let (x, y) = (pixel.0 as u32, pixel.1 as u32);
                    *hits = u8::from(borders.iter().all(|border| border.at((x, y)) >= 0));
                }
            }
        }
        Topic::Depth => hits[0] = nearest(&subject.triangles(), cell),
        Topic::Samples => {
            for (sample, [x, y]) in SAMPLES.into_iter().enumerate() {
                // The oracle samples at centres, so the triangle is moved until the sample lies there.
                let moved = [HALF_PIXEL - x, HALF_PIXEL - y];
                let plane = sample % hits.len();
                for corners in subject.corners() {
                    cover(&corners, RULES[0], moved, cell, &mut hits[plane]);
                }
            }
        }
        Topic::Facing => {
            // What faces the other way is culled.
            for corners in subject.corners() {
                if is_front(device, &corners) {
                    cover(&corners, RULES[0], [0, 0], cell, &mut hits[0]);
                }
            }
        }
        Topic::Tiling if fills(subject, cell) => hits[0].fill(1),
        _ => {
            hits[0] = covered(subject, cell);
            if check == Topic::Twice {
                hits[1] = hits[0].clone();
            }
            // All six orders of the corners are drawn.
            if check == Topic::Order {
                for hits in &mut hits[0] {
                    *hits *= 6;
                }
            }
        }
    }
    hits
}

/// In each pixel the number of the nearest triangle there, of two at one depth that of the first; 0 where there is none.
fn nearest(triangles: &[Triangle], cell: i32) -> Vec<u8> {
    let mut numbers = vec![0; (cell * cell) as usize];
    let mut depths = vec![f64::INFINITY; numbers.len()];
    for triangle in triangles {
        let mut hits = vec![0; numbers.len()];
        cover(&triangle.corners(), RULES[0], [0, 0], cell, &mut hits);
        for (at, (x, y)) in pixels(cell).enumerate().filter(|(at, _)| hits[*at] > 0) {
            let depth = depth(triangle, x, y);
            if depth < depths[at] {
                (numbers[at], depths[at]) = (number(triangle), depth);
            }
        }
    }
    numbers
}

/// How often the triangles of a subject hit each pixel, by the top-left rule.
pub(super) fn covered(subject: &Drawing, cell: i32) -> Vec<u8> {
    let mut hits = vec![0; (cell * cell) as usize];
    for corners in subject.corners() {
        cover(&corners, RULES[0], [0, 0], cell, &mut hits);
    }
    hits
}

/// Whether triangles that do not overlap fill a cell: their area says so, up to its rounding.
fn fills(Drawing(shapes): &Drawing, cell: i32) -> bool {
    let mut twice = 0.0;
    for triangle in shapes {
        twice += area(triangle).abs();
    }
    (twice - f64::from(2 * cell * cell)).abs() < 1e-6
}

/// The pixels of a cell, row by row.
pub(super) fn pixels(cell: i32) -> impl Iterator<Item = (i32, i32)> {
    (0..cell * cell).map(move |at| (at % cell, at / cell))
}

/// The depth of a triangle's plane at a pixel's centre, in f64, whose error is far below any bound here.
fn depth(triangle: &Triangle, x: i32, y: i32) -> f64 {
    let [a, b, c] = triangle.corners();
    let s = centre_of(x, y);
    let [za, zb, zc] = triangle.vertices.map(|v| v.depth);
    let weight = |p, q| twice_area(&[p, q, s]) as f64;
    (weight(b, c) * za + weight(c, a) * zb + weight(a, b) * zc) / twice_area(&[a, b, c]) as f64
}

/// What a triangle of the depth test leaves where it is kept: its first attribute.
fn number(triangle: &Triangle) -> u8 {
    triangle.vertices[0].varying.x as u8
}

impl Drawing {
    /// The ends of its lines.
    pub(super) fn ends(&self) -> Vec<Ends> {
        let mut ends = Vec::new();
        for shape in &self.0 {
            if let [a, b, ..] = &shape[..] {
                ends.push([a, b].map(super::subjects::at));
            }
        }
        ends
    }
}

/// The edges of a triangle whose w are 1.
pub(super) fn edges(t: &[Vertex]) -> [[[f64; 2]; 2]; 3] {
    [(0, 1), (1, 2), (2, 0)].map(|(i, j)| [i, j].map(|i| [t[i][0], t[i][1]]))
}

/// How a pixel that was not hit as expected stands to the specification.
pub(super) struct Forgiving<'a> {
    pub check: Topic,
    pub device: Device,
    pub subject: &'a Drawing,
    corners: Vec<Corners>,
    borders: Option<[clipped::Linear; 5]>,
}

impl<'a> Forgiving<'a> {
    /// What is derived of a subject is derived once for all of its pixels.
    pub fn new(check: Topic, device: Device, subject: &'a Drawing) -> Self {
        let borders = whole(subject).and_then(|corners| borders(&corners));
        Self { check, device, subject, corners: subject.corners(), borders }
    }

    /// A pixel of a plane with so many hits, that are not the expected ones.
    pub fn word(&self, plane: usize, x: i32, y: i32, hits: u8) -> Standing {
        // Which of the reasons applies depends on what the check leaves open.
        let free = match self.check {
            Topic::Lattice => hits <= 1 && self.is_near_edge(x, y),
            Topic::Tiling => self.tiling_is_open(x, y, hits),
            Topic::NearPlane => hits <= 1 && self.is_near_border((x as u32, y as u32)),
            Topic::Depth => self.depth_is_open(x, y, hits),
            Topic::Twice => self.device.interface == Interface::Webgpu,
            // Where samples lie is open in WebGL and said in WebGPU.
            Topic::Samples if self.device.interface == Interface::Webgl2 => {
                self.sample_is_open(x, y, hits, if self.device.samples_apart { 1 } else { 4 })
            }
            Topic::Samples => {
                let [dx, dy] = SAMPLES[plane];
                self.is_between(SubpixelPoint::new(x * SUBPIXELS + dx, y * SUBPIXELS + dy), hits)
            }
            _ => self.is_between(centre_of(x, y), hits),
        };
        if free { Standing::Allowed } else { Standing::Outside }
    }

    /// Whether clipping may have moved a border over a pixel. A subject without borders has no pixels to be sure of.
    fn is_near_border(&self, pixel: (u32, u32)) -> bool {
        let Some(borders) = self.borders else { return true };
        borders.into_iter().any(|border| border.distance_px(pixel) <= self.bound_px())
    }

    /// Whether so many hits are possible by some rule for samples on edges.
    fn is_between(&self, sample: SubpixelPoint, hits: u8) -> bool {
        let times = if self.check == Topic::Order { 6 } else { 1 };
        let (mut inside, mut edges) = (0, 0);
        for corners in &self.corners {
            if self.check == Topic::Facing && !is_front(self.device, corners) {
                continue;
            }
            match place(corners, sample) {
                Place::Inside => inside += 1,
                Place::Edge => edges += 1,
                Place::Outside => {}
            }
        }
        // Inside of a shared edge one of two triangles has the sample, where the interface promises that.
        let (least, most) = (times * inside, times * (inside + edges));
        let is_shared = self.device.interface.source().shares
            && inside == 0
            && on_shared_edge(&self.corners, sample);
        (least..=most).contains(&usize::from(hits)) && (!is_shared || hits == 1)
    }

    /// Of samples whose places are open: all of them where the whole pixel is inside, none where all of it is
    /// outside.
    fn sample_is_open(&self, x: i32, y: i32, hits: u8, all: u8) -> bool {
        let square = [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[i, j]| SubpixelPoint::new((x + i) * SUBPIXELS, (y + j) * SUBPIXELS));
        for corners in &self.corners {
            let is_inside = square.iter().all(|p| place(corners, *p) != Place::Outside);
            // A pixel that lies beyond one edge as a whole is outside.
            let turn = twice_area(corners).signum();
            let mut is_outside = false;
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let sides = square.map(|p| twice_area(&[corners[a], corners[b], p]) * turn);
                is_outside |= sides.iter().all(|side| *side < 0);
            }
            let is_possible = match (is_inside, is_outside) {
                (true, _) => hits == all,
                (_, true) => hits == 0,
                _ => hits <= all,
            };
            if !is_possible {
                return false;
            }
        }
        true
    }

    /// The edges of a triangle on which a pixel's centre may lie once corners are moved to the device's lattice:
    /// each point of an edge moves by a step in x and y at most.
    fn near_edges(&self, t: &[Vertex], x: i32, y: i32) -> Vec<[[f64; 2]; 2]> {
        let s = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let step = f64::from(self.device.step()) / f64::from(SUBPIXELS);
        let mut near = Vec::new();
        for [a, b] in edges(t) {
            // The point of the edge that is nearest to the centre, as a share of the way from a to b.
            let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
            let along = (dx * (s[0] - a[0]) + dy * (s[1] - a[1]))
                / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
            let t = along.clamp(0.0, 1.0);
            let [ex, ey] = [a[0] + t * dx - s[0], a[1] + t * dy - s[1]];
            if ex * ex + ey * ey <= 2.0 * step * step {
                near.push([a, b]);
            }
        }
        near
    }

    /// Whether a centre may lie on an edge of any triangle once corners are moved.
    fn is_near_edge(&self, x: i32, y: i32) -> bool {
        self.subject.0.iter().any(|t| !self.near_edges(t, x, y).is_empty())
    }

    /// Near the border of a tiling a rule decides. Inside of it exactly one hit is promised by OpenGL, while WebGPU
    /// leaves open whether a sample on an edge is covered, so holes along edges too.
    fn tiling_is_open(&self, x: i32, y: i32, hits: u8) -> bool {
        let all = &self.subject.0;
        // Each triangle with an edge here may have the pixel.
        let (mut most, mut is_open) = (0, !self.device.interface.source().shares);
        for triangle in all {
            let near = self.near_edges(triangle, x, y);
            most += u8::from(!near.is_empty());
            for [a, b] in near {
                // An edge is shared where exactly one triangle has it the other way round.
                let others = all.iter().flat_map(|t| edges(t)).filter(|edge| *edge == [b, a]);
                is_open |= others.count() != 1;
            }
        }
        most > 0 && hits <= most && is_open
    }

    /// A new corner is f32 of what is clipped: x, y and w reach 12, divided by a w of at least 1. Six roundings
    /// of at most 12 + 12 x 12 by half the picture, then snapped by half a step in x and y.
    fn bound_px(&self) -> f64 {
        let u = f64::from(f32::EPSILON) / 2.0;
        let half_picture_px = 512.0;
        f64::from(self.device.step()) / f64::from(SUBPIXELS) + 6.0 * u * 156.0 * half_picture_px
    }

    /// Where depths are nearer than they are exact, or a rule decides about an edge, either may be kept: what is shown covers the pixel,
    /// and nothing that surely covers it is surely nearer.
    fn depth_is_open(&self, x: i32, y: i32, hits: u8) -> bool {
        let (mut nearest, mut shown): (Option<AtDepth>, Option<AtDepth>) = (None, None);
        for triangle in self.subject.triangles() {
            let place = place(&triangle.corners(), centre_of(x, y));
            if place == Place::Outside {
                continue;
            }
            let here = AtDepth { depth: depth(&triangle, x, y), triangle };
            if number(&triangle) == hits {
                shown = Some(here);
            }
            if place == Place::Inside && nearest.is_none_or(|other| here.depth < other.depth) {
                nearest = Some(here);
            }
        }
        match (nearest, shown) {
            // No triangle surely covers it.
            (None, shown) => hits == 0 || shown.is_some(),
            (Some(nearest), Some(shown)) => {
                // A buffer of 24 bits keeps steps of 2^-24.
                let bounds = [nearest, shown].map(|t| depth_bounds(&t.triangle, 1024.0)[1]);
                shown.depth - nearest.depth <= bounds[0] + bounds[1] + 2f64.powi(-24)
            }
            (Some(_), None) => false,
        }
    }
}

/// A triangle with its depth at a pixel.
#[derive(Clone, Copy)]
struct AtDepth {
    depth: f64,
    triangle: Triangle,
}

/// How the pixels of a line stand to the diamond-exit rule, to a rectangle and to a parallelogram.
pub(super) fn line_fits(device: Device, ends: &Ends, lit: &Pixels, cell: i32) -> [Fit; 3] {
    // A rectangle, a parallelogram and a diamond are three permitted shapes of a line; the page shows which one was drawn.
    let step = device.step();
    [
        segments::diamond_exit(ends, lit, cell),
        segments::rectangle(ends, lit, cell, step),
        segments::parallelogram(ends, lit, cell, step),
    ]
}

/// Whether triangles turn the same way, are at least half a pixel thick, so that none turns over on the
/// device's lattice, and do not overlap; two share an edge.
pub(super) fn is_tiling(subject: &Drawing, cell: i32) -> bool {
    let [first, rest @ ..] = &subject.0[..] else { return false };
    for triangle in &subject.0 {
        let mut longest: f64 = 0.0;
        for [a, b] in edges(triangle) {
            longest = longest.max((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
        }
        // Twice the area is the longest edge by the height on it.
        let area_px2 = area(triangle);
        if area_px2.powi(2) < longest / 4.0 || area_px2.signum() != area(first).signum() {
            return false;
        }
    }
    match rest {
        [] => true,
        [second] => edges(first).iter().any(|[a, b]| edges(second).contains(&[*b, *a])),
        _ => covered(subject, cell).iter().all(|hits| *hits <= 1),
    }
}
