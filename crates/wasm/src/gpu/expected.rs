//! What each check expects in a cell, and how a pixel that differs stands to the specification.

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
    let mut hits = vec![vec![0; (cell * cell) as usize]; planes(check, device)];
    match check {
        Topic::Lines => {
            for (x, y) in subject.ends().iter().flat_map(|ends| segments::diamonds(ends, cell)) {
                hits[0][(y * cell + x) as usize] = 1;
            }
        }
        Topic::NearPlane => {
            let borders = whole(subject).and_then(|corners| borders(&corners));
            each(cell, |x, y, at| {
                let inside = |b: &clipped::Linear| b.at((x as u32, y as u32)) >= 0;
                hits[0][at] = u8::from(borders.is_some_and(|b| b.iter().all(inside)));
            });
        }
        Topic::Depth => {
            let covered = subject.triangles().into_iter().map(|t| {
                let mut hits = vec![0; (cell * cell) as usize];
                cover(&t.corners(), RULES[0], [0, 0], cell, &mut hits);
                (t, hits)
            });
            let covered: Vec<_> = covered.collect();
            each(cell, |x, y, at| {
                let drawn = covered.iter().filter(|(_, hits)| hits[at] > 0).map(|(t, _)| t);
                let nearest =
                    drawn.reduce(|a, b| if depth(b, x, y) < depth(a, x, y) { b } else { a });
                hits[0][at] = nearest.map_or(0, number);
            });
        }
        Topic::Samples => {
            for (sample, [x, y]) in SAMPLES.into_iter().enumerate() {
                let moved = [HALF_PIXEL - x, HALF_PIXEL - y];
                let plane = sample % hits.len();
                for corners in subject.corners() {
                    cover(&corners, RULES[0], moved, cell, &mut hits[plane]);
                }
            }
        }
        Topic::Facing => {
            for corners in subject.corners().iter().filter(|c| is_front(device, c)) {
                cover(corners, RULES[0], [0, 0], cell, &mut hits[0]);
            }
        }
        Topic::Tiling if fills(subject, cell) => hits[0].fill(1),
        _ => {
            hits[0] = covered(subject, cell);
            if check == Topic::Twice {
                hits[1] = hits[0].clone();
            }
            if check == Topic::Order {
                hits[0].iter_mut().for_each(|hits| *hits *= 6);
            }
        }
    }
    hits
}

pub(super) fn covered(subject: &Drawing, cell: i32) -> Vec<u8> {
    let mut hits = vec![0; (cell * cell) as usize];
    for corners in subject.corners() {
        cover(&corners, RULES[0], [0, 0], cell, &mut hits);
    }
    hits
}

/// Whether triangles that do not overlap fill a cell: their area says so, up to its rounding.
fn fills(Drawing(shapes): &Drawing, cell: i32) -> bool {
    let twice: f64 = shapes.iter().map(|t| area(t).abs()).sum();
    (twice - f64::from(2 * cell * cell)).abs() < 1e-6
}

fn each(cell: i32, mut see: impl FnMut(i32, i32, usize)) {
    for (y, x) in (0..cell).flat_map(|y| (0..cell).map(move |x| (y, x))) {
        see(x, y, (y * cell + x) as usize);
    }
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
    pub(super) fn ends(&self) -> Vec<Ends> {
        let ends = |shape: &Vec<Vertex>| {
            Some([super::subjects::at(shape.first()?), super::subjects::at(shape.get(1)?)])
        };
        self.0.iter().filter_map(ends).collect()
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
    pub fn new(check: Topic, device: Device, subject: &'a Drawing) -> Self {
        let borders = whole(subject).and_then(|corners| borders(&corners));
        Self { check, device, subject, corners: subject.corners(), borders }
    }

    /// A pixel of a plane with so many hits, that are not the expected ones.
    pub fn word(&self, plane: usize, x: i32, y: i32, hits: u8) -> Standing {
        let free = match self.check {
            Topic::Lattice => hits <= 1 && self.is_near_edge(x, y),
            Topic::Tiling => self.tiling_is_open(x, y, hits),
            Topic::NearPlane => {
                let near = |b: clipped::Linear| b.distance_px((x as u32, y as u32));
                hits <= 1
                    && self
                        .borders
                        .is_none_or(|b| b.into_iter().any(|b| near(b) <= self.bound_px()))
            }
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

    /// Whether so many hits are possible by some rule for samples on edges.
    fn is_between(&self, sample: SubpixelPoint, hits: u8) -> bool {
        let times = if self.check == Topic::Order { 6 } else { 1 };
        let is_drawn = |c: &&Corners| self.check != Topic::Facing || is_front(self.device, c);
        let places: Vec<_> =
            self.corners.iter().filter(is_drawn).map(|c| place(c, sample)).collect();
        let inside = places.iter().filter(|p| **p == Place::Inside).count();
        let edges = places.iter().filter(|p| **p == Place::Edge).count();
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
        self.corners.iter().all(|c| {
            let inside = square.iter().all(|p| place(c, *p) != Place::Outside);
            let beyond = |i: usize| {
                let (a, b) = (c[i], c[(i + 1) % 3]);
                let turn = twice_area(c).signum();
                square.iter().all(|p| twice_area(&[a, b, *p]) * turn < 0)
            };
            match (inside, (0..3).any(beyond)) {
                (true, _) => hits == all,
                (_, true) => hits == 0,
                _ => hits <= all,
            }
        })
    }

    /// The edges of a triangle on which a pixel's centre may lie once corners are moved to the device's lattice:
    /// each point of an edge moves by a step in x and y at most.
    fn near_edges(&self, t: &[Vertex], x: i32, y: i32) -> Vec<[[f64; 2]; 2]> {
        let s = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let step = f64::from(self.device.step()) / f64::from(SUBPIXELS);
        let is_near = |[a, b]: &[[f64; 2]; 2]| {
            let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
            let along = (dx * (s[0] - a[0]) + dy * (s[1] - a[1]))
                / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
            let t = along.clamp(0.0, 1.0);
            let [ex, ey] = [a[0] + t * dx - s[0], a[1] + t * dy - s[1]];
            ex * ex + ey * ey <= 2.0 * step * step
        };
        edges(t).into_iter().filter(is_near).collect()
    }

    fn is_near_edge(&self, x: i32, y: i32) -> bool {
        self.subject.0.iter().any(|t| !self.near_edges(t, x, y).is_empty())
    }

    /// Near the border of a tiling a rule decides. Inside of it exactly one hit is promised by OpenGL, while WebGPU
    /// leaves open whether a sample on an edge is covered, so holes along edges too.
    fn tiling_is_open(&self, x: i32, y: i32, hits: u8) -> bool {
        let all = &self.subject.0;
        let near: Vec<_> = all.iter().map(|t| self.near_edges(t, x, y)).collect();
        let is_shared = |[a, b]: &[[f64; 2]; 2]| {
            all.iter().flat_map(|t| edges(t)).filter(|edge| *edge == [*b, *a]).count() == 1
        };
        let most = near.iter().filter(|edges| !edges.is_empty()).count();
        let is_open = !self.device.interface.source().shares
            || near.iter().flatten().any(|edge| !is_shared(edge));
        most > 0 && usize::from(hits) <= most && is_open
    }

    /// A new corner is f32 of what is clipped: x, y and w reach 12, divided by a w of at least 1. Six roundings
    /// of at most 12 + 12 x 12 by half the picture, then snapped by half a step in x and y.
    fn bound_px(&self) -> f64 {
        let u = f64::from(f32::EPSILON) / 2.0;
        let half_picture_px = 512.0;
        f64::from(self.device.step()) / f64::from(SUBPIXELS) + 6.0 * u * 156.0 * half_picture_px
    }

    /// Where depths are nearer than they are exact, or a rule decides about an edge, either may be kept.
    fn depth_is_open(&self, x: i32, y: i32, hits: u8) -> bool {
        let triangles = self.subject.triangles();
        let places = triangles.iter().map(|t| place(&t.corners(), centre_of(x, y)));
        let places: Vec<_> = places.collect();
        let mut covering = triangles.iter().zip(&places).filter(|(_, p)| **p != Place::Outside);
        if places.contains(&Place::Edge) {
            return hits == 0 || covering.any(|(t, _)| number(t) == hits);
        }
        let [first, second] = &triangles[..] else { return false };
        let bounds = [first, second].map(|t| depth_bounds(t, 1024.0)[1]);
        // A buffer of 24 bits keeps steps of 2^-24.
        let bound = bounds[0] + bounds[1] + 2f64.powi(-24);
        let both = places.iter().all(|p| *p == Place::Inside);
        both && covering.any(|(t, _)| number(t) == hits)
            && (depth(first, x, y) - depth(second, x, y)).abs() <= bound
    }
}

/// How the pixels of a line stand to the diamond-exit rule, to a rectangle and to a parallelogram.
pub(super) fn line_fits(device: Device, ends: &Ends, lit: &Pixels, cell: i32) -> [Fit; 3] {
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
    let turns = |t: &Vec<Vertex>| area(t).signum() == area(&subject.0[0]).signum();
    let is_thick = |t: &Vec<Vertex>| {
        let longest = [(0, 1), (1, 2), (2, 0)]
            .map(|(i, j)| (t[i][0] - t[j][0]).powi(2) + (t[i][1] - t[j][1]).powi(2))
            .into_iter()
            .fold(0.0, f64::max);
        area(t).powi(2) >= longest / 4.0
    };
    let [first, rest @ ..] = &subject.0[..] else { return false };
    let shares = |t: &Vec<Vertex>| edges(first).iter().any(|[a, b]| edges(t).contains(&[*b, *a]));
    let is_apart = match rest {
        [] => true,
        [second] => shares(second),
        _ => covered(subject, cell).iter().all(|hits| *hits <= 1),
    };
    is_apart && subject.0.iter().all(|t| turns(t) && is_thick(t))
}
