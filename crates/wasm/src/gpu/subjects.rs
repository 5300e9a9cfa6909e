//! The subjects of each check: the hard cases of the comparison on the device's lattice, and some of this page.

use super::{Device, Drawing, Interface, Layout, Topic, Vertex};
use rasterproof_core::geometry::{ORDERS, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};
use rasterproof_verify::cases::{Family, Shape, Triangle, triangles};
use rasterproof_verify::oracle::clipped;

/// The checks with the numbers of their batches.
pub(super) const PLAN: [(Topic, u64); 12] = [
    (Topic::Lattice, 1),
    (Topic::Coverage, FAMILIES.len() as u64 * PAGES),
    (Topic::Reach, 10),
    (Topic::Tiling, 2),
    (Topic::Order, 1),
    (Topic::Facing, 1),
    (Topic::Lines, 2),
    (Topic::Depth, 1),
    (Topic::Values, 3),
    (Topic::NearPlane, 4),
    (Topic::Samples, 2),
    (Topic::Twice, 1),
];

const PAGES: u64 = 3;
/// Families of coverage whose corners lie in their window, with its side in px.
const FAMILIES: [(&str, i32); 12] = [
    ("half-integer", 16),
    ("rectangle", 16),
    ("fan", 32),
    ("tiny", 8),
    ("uniform", 48),
    ("strip", 48),
    ("sliver", 48),
    ("near-horizontal", 48),
    ("near-vertical", 48),
    ("flat", 48),
    ("near-tie", 48),
    ("degenerate", 48),
];
/// Families in perspective, whose w an f32 can hold.
const IN_PERSPECTIVE: [&str; 3] = ["w-equal", "w-4", "w-100"];

/// The side of a picture. A power of two, so that positions are exact in f32 on their way.
const SIDE: i32 = 1024;
/// The side of a picture of values, which are sixteen bytes a pixel.
const VALUES_SIDE: i32 = 512;
/// Subjects of one picture at most.
const MOST: usize = 4096;

fn layout(check: Topic, cell: i32) -> Layout {
    let plain = Layout { side: SIDE, cell, margin: 0, scissor: false };
    match check {
        // Corners reach 7 cells beyond their own.
        Topic::Reach => Layout { margin: REACH, scissor: true, ..plain },
        Topic::NearPlane => Layout { scissor: true, ..plain },
        Topic::Values => Layout { side: VALUES_SIDE, ..plain },
        _ => plain,
    }
}

/// Cells that corners of [`Topic::Reach`] may be away.
const REACH: i32 = 7;

fn cell_of(check: Topic, number: u64) -> i32 {
    match check {
        Topic::Coverage | Topic::Twice => FAMILIES[(number % FAMILIES.len() as u64) as usize].1,
        Topic::Reach | Topic::Values => 48,
        Topic::Lines | Topic::Depth => 32,
        Topic::NearPlane => clipped::CELL_PX as i32,
        _ => 16,
    }
}

pub(super) fn layout_for(check: Topic, Drawing(shapes): &Drawing) -> Result<Layout, String> {
    let wanted = match check {
        Topic::Lines => 2,
        _ => 3,
    };
    let most = f64::from(SIDE);
    let is_near = |[x, y, .., w, _, _]: &Vertex| {
        check == Topic::NearPlane || (*w > 0.0 && (x / w).abs() <= most && (y / w).abs() <= most)
    };
    let vertices = || shapes.iter().flatten();
    if shapes.is_empty()
        || shapes.len() > 64
        || shapes.iter().any(|shape| shape.len() != wanted)
        || !vertices().flatten().all(|v| v.is_finite() && v.abs() <= most * most)
        || !vertices().all(is_near)
    {
        return Err(format!(
            "the case must hold 1 to 64 shapes of {wanted} vertices before the eye, within {SIDE} px"
        ));
    }
    // As large as the largest window of the check that has to be: corners decide.
    let reach = vertices().fold(0, |most: i32, v| most.max(at(v).x).max(at(v).y));
    let least = match check {
        Topic::Coverage | Topic::Twice | Topic::Values => {
            *[8, 16, 32, 48].iter().find(|c| reach <= **c * SUBPIXELS).unwrap_or(&48)
        }
        _ => cell_of(check, 0),
    };
    Ok(layout(check, least))
}

/// A vertex at a place in subpixels, w = 1, whose first attribute says how often a pixel is hit.
fn plain(p: SubpixelPoint) -> Vertex {
    let px = |v: i32| f64::from(v) / f64::from(SUBPIXELS);
    [px(p.x), px(p.y), 0.5, 1.0, 1.0, 0.0]
}

pub(super) fn triangle(corners: Corners) -> Vec<Vertex> {
    corners.map(plain).to_vec()
}

/// The place of a vertex in subpixels, which it lies on.
pub(super) fn at([x, y, _, w, ..]: &Vertex) -> SubpixelPoint {
    let sub = |v: f64| (v / w * f64::from(SUBPIXELS)).round() as i32;
    SubpixelPoint::new(sub(*x), sub(*y))
}

impl Drawing {
    /// The corners of its triangles on the finest lattice.
    pub(super) fn corners(&self) -> Vec<Corners> {
        self.0.iter().filter_map(|t| Some([at(t.first()?), at(t.get(1)?), at(t.get(2)?)])).collect()
    }

    pub(super) fn triangles(&self) -> Vec<Triangle> {
        let vertex = |v: &Vertex| ScreenVertex {
            position: at(v),
            depth: v[2] / v[3],
            inv_w: 1.0 / v[3],
            varying: glam::DVec2::new(v[4], v[5]),
        };
        let of = |t: &Vec<Vertex>| {
            Some(ScreenTriangle {
                vertices: [vertex(t.first()?), vertex(t.get(1)?), vertex(t.get(2)?)],
            })
        };
        self.0.iter().filter_map(of).collect()
    }
}

/// The vertices that are drawn of a subject. To see whether the order of corners matters, all six are drawn.
pub(super) fn drawn(check: Topic, Drawing(shapes): &Drawing) -> Vec<Vertex> {
    let orders: &[[usize; 3]] = match check {
        Topic::Order => &ORDERS,
        _ => return shapes.concat(),
    };
    let in_order =
        |t: &Vec<Vertex>| orders.iter().flat_map(|o| o.map(|i| t[i])).collect::<Vec<_>>();
    shapes.iter().flat_map(in_order).collect()
}

fn family(name: &str) -> Option<&'static Family> {
    triangles::FAMILIES.iter().find(|family| family.name == name)
}

/// The triangles of a case on the device's lattice; none where a corner leaves the cell.
fn snapped(family: &Family, seed: u64, index: u64, step: i32, cell: i32) -> Option<Vec<Corners>> {
    let Shape::Triangles { list, .. } = family.case(seed, index).shape else { return None };
    let all: Vec<Corners> = list
        .iter()
        .map(|t| t.corners().map(|p| SubpixelPoint::new(p.x & -step, p.y & -step)))
        .collect();
    let inside = |v: i32| (0..=cell * SUBPIXELS).contains(&v);
    all.iter().flatten().all(|p| inside(p.x) && inside(p.y)).then_some(all)
}

/// The subjects of a batch, and how they lie.
pub(super) fn of(check: Topic, device: Device, seed: u64, number: u64) -> (Layout, Vec<Drawing>) {
    let cell = cell_of(check, number);
    let layout = layout(check, cell);
    let room = layout.room().min(MOST);
    let step = device.step();
    let name = format!("your-gpu-{check:?}");
    let one = |index: usize| -> Option<Drawing> {
        let index = number * MOST as u64 + index as u64;
        let mut rng = Rng::new(&name, seed, index);
        let mut on_lattice = |low_px: i32, high_px: i32| {
            let per_px = i64::from(SUBPIXELS / step);
            let mut v = || rng.int(i64::from(low_px) * per_px, i64::from(high_px) * per_px) as i32;
            SubpixelPoint::new(v() * step, v() * step)
        };
        Some(Drawing(match check {
            Topic::Lattice => vec![triangle(near_centres(&mut rng))],
            Topic::Coverage | Topic::Twice => {
                let (name, _) = FAMILIES[(number % FAMILIES.len() as u64) as usize];
                let all = snapped(family(name)?, seed, index, step, cell)?;
                all.into_iter().map(triangle).collect()
            }
            Topic::Reach => {
                let far = |p: &mut dyn FnMut(i32, i32) -> SubpixelPoint| p(-REACH * cell, 8 * cell);
                vec![triangle([on_lattice(0, cell), far(&mut on_lattice), far(&mut on_lattice)])]
            }
            Topic::Tiling => tiling(&mut rng, cell),
            Topic::Order | Topic::Samples => {
                // Every other one with corners on centres, where rules decide.
                let family =
                    family(["half-integer", "tiny"][usize::from(check == Topic::Samples)])?;
                match index % 2 {
                    0 => vec![triangle([(); 3].map(|()| on_lattice(0, cell)))],
                    _ => snapped(family, seed, index, step, cell)?
                        .into_iter()
                        .map(triangle)
                        .collect(),
                }
            }
            Topic::Facing => vec![triangle([(); 3].map(|()| on_lattice(0, cell)))],
            Topic::Lines => vec![line(&mut rng, step, cell, index)?],
            Topic::Depth => crossing(&mut rng, step, cell),
            Topic::Values => {
                let family = family(IN_PERSPECTIVE[(index % 3) as usize])?;
                let Shape::Triangles { list, .. } = family.case(seed, index).shape else {
                    return None;
                };
                vec![valued(list.first()?, step)]
            }
            Topic::NearPlane => vec![clip_space(&mut rng, index)],
        }))
    };
    let mut list: Vec<Drawing> = (0..2 * room).filter_map(one).take(room).collect();
    // What faces the other way is drawn too, and is culled.
    if check == Topic::Facing {
        list.iter_mut().step_by(2).for_each(|Drawing(shapes)| shapes[0].swap(1, 2));
    }
    (layout, list)
}

/// A small triangle with corners within a sixth of a pixel of pixel centres, on the finest lattice: its
/// pixels show where its corners are moved to.
fn near_centres(rng: &mut Rng) -> Corners {
    [(); 3].map(|()| {
        let mut v = || {
            let centre = rng.int(2, 13) as i32 * SUBPIXELS + HALF_PIXEL;
            centre + rng.int(-40, 40) as i32
        };
        SubpixelPoint::new(v(), v())
    })
}

/// Three by three quadrilaterals that fill a cell, each in two triangles. Inner corners lie anywhere, but not
/// within an eighth of a pixel of a row or column of centres: a sample on a corner belongs to no pair of
/// triangles, so nothing is promised of it.
fn tiling(rng: &mut Rng, cell: i32) -> Vec<Vec<Vertex>> {
    let mut inner = |i: i32| {
        let whole = i * cell / 3 + rng.int(-1, 1) as i32;
        f64::from(whole) + (rng.signed() * 0.375) as f32 as f64
    };
    let along = |i: i32, at: f64| match i {
        0 => 0.0,
        3 => f64::from(cell),
        _ => at,
    };
    let mut points = [[[0.0; 2]; 4]; 4];
    for (j, row) in (0..).zip(&mut points) {
        for (i, point) in (0..).zip(row) {
            *point = [along(i, inner(i)), along(j, inner(j))];
        }
    }
    let vertex = |[x, y]: [f64; 2]| [x, y, 0.5, 1.0, 1.0, 0.0];
    let mut shapes = Vec::new();
    for (j, i) in (0..3).flat_map(|j| (0..3).map(move |i| (j, i))) {
        let [a, b] = [points[j][i], points[j][i + 1]];
        let [d, c] = [points[j + 1][i], points[j + 1][i + 1]];
        let split = if rng.chance(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        shapes.extend(split.map(|t| t.map(vertex).to_vec()));
    }
    shapes
}

/// A line between positions of the lattice, pixel centres, or pixel corners, in turn.
fn line(rng: &mut Rng, step: i32, cell: i32, index: u64) -> Option<Vec<Vertex>> {
    let (low, high) = (2, cell - 2);
    let mut v = || {
        let mut int = |low: i32, high: i32| rng.int(i64::from(low), i64::from(high)) as i32;
        match index % 3 {
            0 => int(low * SUBPIXELS / step, high * SUBPIXELS / step) * step,
            1 => int(low, high - 1) * SUBPIXELS + HALF_PIXEL,
            _ => int(low, high) * SUBPIXELS,
        }
    };
    let ends = [(); 2].map(|()| SubpixelPoint::new(v(), v()));
    (ends[0] != ends[1]).then(|| ends.map(plain).to_vec())
}

/// Two triangles whose depths lean through each other; their first attributes tell them apart.
fn crossing(rng: &mut Rng, step: i32, cell: i32) -> Vec<Vec<Vertex>> {
    [1.0, 2.0]
        .map(|number| {
            [(); 3].map(|()| {
                let per_px = i64::from(SUBPIXELS / step);
                let mut v = || rng.int(0, i64::from(cell) * per_px) as i32 * step;
                let p = SubpixelPoint::new(v(), v());
                let [x, y, ..] = plain(p);
                [x, y, rng.int(64, 960) as f64 / 1024.0, 1.0, number, 0.0]
            })
        })
        .map(|t| t.to_vec())
        .to_vec()
}

/// A triangle of the families with its values rounded to f32.
fn valued(triangle: &Triangle, step: i32) -> Vec<Vertex> {
    let f32 = |v: f64| f64::from(v as f32);
    let vertex = |v: &ScreenVertex<glam::DVec2>| {
        let w = f32(1.0 / v.inv_w);
        let px = |v: i32| f64::from(v & -step) / f64::from(SUBPIXELS);
        let depth = f32(0.0625 + 0.875 * v.depth);
        let [x, y] = [px(v.position.x) * w, px(v.position.y) * w];
        [x, y, depth * w, w, f32(v.varying.x), f32(v.varying.y)]
    };
    triangle.vertices.iter().map(vertex).collect()
}

/// A triangle that the near plane may cut.
fn clip_space(rng: &mut Rng, index: u64) -> Vec<Vertex> {
    (0..3).map(|_| from_whole(clipped::corner(rng, index.is_multiple_of(2)))).collect()
}

pub(super) fn from_whole(corner: clipped::Whole) -> Vertex {
    let half = f64::from(clipped::CELL_PX) / 2.0;
    let [x, y, z, w] = corner.map(|v| v as f64 / f64::from(clipped::UNIT));
    [(x + w) * half, (y + w) * half, z / 8.0, w, 1.0, 0.0]
}

/// The whole numbers in clip space of such a triangle.
pub(super) fn whole(Drawing(shapes): &Drawing) -> Option<[clipped::Whole; 3]> {
    let half = f64::from(clipped::CELL_PX) / 2.0;
    let unit = f64::from(clipped::UNIT);
    let corner = |v: &Vertex| {
        let [x, y, z, w, ..] = *v;
        [x / half - w, y / half - w, 8.0 * z, w].map(|v| (v * unit).round() as i64)
    };
    let t = shapes.first()?;
    Some([corner(t.first()?), corner(t.get(1)?), corner(t.get(2)?)])
}

/// Whether a triangle is a front face: WebGL counts rows from below, and counter-clockwise is the front of both.
pub(super) fn is_front(device: Device, corners: &Corners) -> bool {
    let area = twice_area(corners);
    match device.interface {
        Interface::Webgl2 => area > 0,
        Interface::Webgpu => area < 0,
    }
}

/// Twice the area in square px; negative where the corners run the other way round.
pub(super) fn area(t: &[Vertex]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| [t[i][0], t[i][1]]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
