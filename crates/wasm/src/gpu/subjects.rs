//! The subjects of each check: the hard cases of the comparison on the device's lattice, and some of this page.
//!
//! Every subject follows from a seed and its number, so that a page can ask for one again. A batch is as many subjects as one picture
//! has cells; some that do not fit a cell are left out, and the next ones take their places.
//!
//! Covering designs choose triangles, lines, piles and values, too: a thousand of each, so that every two facts that can occur do so together. Their
//! windows are parts of a cell, all of whose pixels are judged.

use super::{Device, Drawing, Interface, Layout, Topic, Vertex};
use crate::no_answer::NoAnswer;
use rasterproof_core::geometry::{ORDERS, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};
use rasterproof_verify::cases::facts::{self, design};
use rasterproof_verify::cases::{Case, Family, Limits, Line, Shape, Triangle, triangles};
use rasterproof_verify::oracle::clipped;

/// The checks with the numbers of their batches.
pub(super) const PLAN: [(Topic, u64); 12] = [
    (Topic::Lattice, 1),
    (Topic::Coverage, FAMILIES.len() as u64 * PAGES),
    (Topic::Reach, REACHING + 21),
    (Topic::Tiling, 2),
    (Topic::Order, 1),
    (Topic::Facing, 1),
    (Topic::Lines, LINES + 1),
    (Topic::Depth, PAIRS + 1),
    (Topic::Values, VALUES + 10),
    (Topic::NearPlane, 4),
    (Topic::Samples, 2),
    (Topic::Twice, 1),
];

const PAGES: u64 = 3;
/// Batches that no design chooses, before those of a design.
const REACHING: u64 = 10;
const LINES: u64 = 2;
const PAIRS: u64 = 1;
const VALUES: u64 = 3;
/// Families of coverage whose corners lie in their window, with its side in px.
const FAMILIES: [(&str, i32); 13] = [
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
    ("design", 48),
];
/// Families in perspective, whose w an f32 can hold.
const IN_PERSPECTIVE: [&str; 3] = ["w-equal", "w-4", "w-100"];

/// The side of a picture. A power of two, so that positions are exact in f32 on their way.
const SIDE: i32 = 1024;
/// The side of a picture of values, which are sixteen bytes a pixel.
const VALUES_SIDE: i32 = 512;
/// Subjects of one picture at most.
const MOST: usize = 4096;

/// How cells of this size lie in the picture of a check.
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

/// The side of the cells of a batch: as large as its subjects need, so that many fit into a picture.
fn cell_of(check: Topic, number: u64) -> i32 {
    match check {
        Topic::Coverage | Topic::Twice => FAMILIES[(number % FAMILIES.len() as u64) as usize].1,
        Topic::Reach | Topic::Values => 48,
        Topic::Lines | Topic::Depth => 32,
        Topic::NearPlane => clipped::CELL_PX as i32,
        _ => 16,
    }
}

/// The layout for one subject, which comes from the page and may be anything.
pub(super) fn layout_for(check: Topic, Drawing(shapes): &Drawing) -> Result<Layout, NoAnswer> {
    let wanted = match check {
        Topic::Lines => 2,
        _ => 3,
    };
    let most = f64::from(SIDE);
    let mut is_right = (1..=64).contains(&shapes.len());
    for shape in shapes {
        is_right &= shape.len() == wanted;
        for [x, y, z, w, a, b] in shape {
            let numbers = [x, y, z, w, a, b];
            is_right &= numbers.iter().all(|v| v.is_finite() && v.abs() <= most * most);
            // The near plane is asked about corners behind the eye, too.
            let is_near = *w > 0.0 && (x / w).abs() <= most && (y / w).abs() <= most;
            is_right &= check == Topic::NearPlane || is_near;
        }
    }
    if !is_right {
        return Err(format!(
            "the case must hold 1 to 64 shapes of {wanted} vertices before the eye, within {SIDE} px"
        )
        .into());
    }
    // As large as the largest window of the check that has to be: corners decide.
    let mut reach = 0;
    for corner in shapes.iter().flatten().map(at) {
        reach = reach.max(corner.x).max(corner.y);
    }
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

/// A triangle of such vertices.
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
        let mut all = Vec::new();
        for shape in &self.0 {
            if let [a, b, c, ..] = &shape[..] {
                all.push([a, b, c].map(at));
            }
        }
        all
    }

    /// Its triangles with depths, w and attributes.
    pub(super) fn triangles(&self) -> Vec<Triangle> {
        let mut all = Vec::new();
        for shape in &self.0 {
            if let [a, b, c, ..] = &shape[..] {
                let vertices = [a, b, c].map(|v| ScreenVertex {
                    position: at(v),
                    depth: v[2] / v[3],
                    inv_w: 1.0 / v[3],
                    varying: glam::DVec2::new(v[4], v[5]),
                });
                all.push(ScreenTriangle { vertices });
            }
        }
        all
    }
}

/// The vertices that are drawn of a subject. To see whether the order of corners matters, all six are drawn.
pub(super) fn drawn(check: Topic, Drawing(shapes): &Drawing) -> Vec<Vertex> {
    if check != Topic::Order {
        return shapes.concat();
    }
    // One after the other into the same cell, so that each pixel is hit six times or by none.
    let mut vertices = Vec::new();
    for shape in shapes {
        vertices.extend(ORDERS.as_flattened().iter().map(|i| shape[*i]));
    }
    vertices
}

/// The family of triangles of this name.
fn family(name: &str) -> Option<&'static Family> {
    triangles::FAMILIES.iter().find(|family| family.name == name)
}

/// The triangles of a case on the device's lattice; none where a corner leaves the cell.
fn snapped(family: &Family, seed: u64, index: u64, step: i32, cell: i32) -> Option<Vec<Corners>> {
    // Other families than those of triangles are not asked for.
    let Shape::Triangles { list, .. } = family.case(seed, index).shape else { return None };
    let mut all: Vec<Corners> = Vec::new();
    let range = 0..=cell * SUBPIXELS;
    for triangle in list {
        // A step is a power of two, so the mask rounds down.
        let corners = triangle.corners().map(|p| SubpixelPoint::new(p.x & -step, p.y & -step));
        if !corners.iter().all(|p| range.contains(&p.x) && range.contains(&p.y)) {
            return None;
        }
        all.push(corners);
    }
    Some(all)
}

/// A batch whose subjects a design chooses.
struct Designed {
    topic: &'static facts::Topic,
    /// Counts the batches of this check that the design chooses, from 0 on.
    batch: u64,
}

/// The design that chooses the subjects of a batch, if one does.
fn designed(check: Topic, number: u64) -> Option<Designed> {
    let families = FAMILIES.len() as u64;
    let (topic, batch) = match check {
        // The last family is the design.
        Topic::Coverage if number % families == families - 1 => {
            (&facts::triangles::TOPIC, number / families)
        }
        Topic::Reach => (&facts::triangles::TOPIC, number.checked_sub(REACHING)?),
        Topic::Lines => (&facts::lines::TOPIC, number.checked_sub(LINES)?),
        Topic::Depth => (&facts::depth::TOPIC, number.checked_sub(PAIRS)?),
        Topic::Values => (&facts::values::TOPIC, number.checked_sub(VALUES)?),
        _ => return None,
    };
    Some(Designed { topic, batch })
}

/// What a design may ask of a check: corners on the device's lattice in the cell, or as far beyond it as the picture is empty.
pub(super) fn limits(check: Topic, step: i32, cell: i32) -> Limits {
    let beyond = if check == Topic::Reach { REACH } else { 0 };
    Limits {
        step: step.into(),
        least: (-beyond * cell * SUBPIXELS).into(),
        most: ((beyond + 1) * cell * SUBPIXELS).into(),
        // Lines lie around the middle of the cell, two pixels from its border at least.
        line_range_px: Some(cell / 2 - 2),
        window: Some([cell as u32; 2]),
        ..Limits::default()
    }
}

/// The case of a design as the check draws it; nothing where it has no pixels to judge.
fn of_design(check: Topic, case: Case, step: i32, cell: i32) -> Option<Drawing> {
    Some(Drawing(match (check, case.shape) {
        (_, Shape::Lines(list)) => vec![around_middle(list.first()?, cell)?],
        (Topic::Values, Shape::Triangles { list, .. }) => vec![valued(list.first()?, step)],
        (Topic::Depth, Shape::Triangles { list, .. }) => numbered(&list, step),
        (_, Shape::Triangles { list, .. }) => list.iter().map(|t| triangle(t.corners())).collect(),
        _ => return None,
    }))
}

/// The subjects of a batch, and how they lie.
pub(super) fn of(check: Topic, device: Device, seed: u64, number: u64) -> (Layout, Vec<Drawing>) {
    let cell = cell_of(check, number);
    let layout = layout(check, cell);
    let room = layout.room().min(MOST);
    let step = device.step();
    let name = format!("your-gpu-{check:?}");
    let (designed, limits) = (designed(check, number), limits(check, step, cell));
    let one = |index: usize| -> Option<Drawing> {
        if let Some(Designed { topic, batch }) = designed {
            // A design has its pairs in its first cases: batches of it go on where the one before ended.
            let index = batch * room as u64 + index as u64;
            return of_design(check, design::case(topic, seed, index, &limits), step, cell);
        }
        let index = number * MOST as u64 + index as u64;
        // One generator for each subject, so that leaving one out changes no other.
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
                // One corner in the cell, two of them up to seven cells away.
                let far = |p: &mut dyn FnMut(i32, i32) -> SubpixelPoint| p(-REACH * cell, 8 * cell);
                vec![triangle([on_lattice(0, cell), far(&mut on_lattice), far(&mut on_lattice)])]
            }
            Topic::Tiling => tiling(&mut rng, cell),
            Topic::Order | Topic::Samples => {
                // Every other one with corners on centres, where rules decide.
                let name = if check == Topic::Samples { "tiny" } else { "half-integer" };
                match index % 2 {
                    0 => vec![triangle([(); 3].map(|()| on_lattice(0, cell)))],
                    _ => {
                        let all = snapped(family(name)?, seed, index, step, cell)?;
                        all.into_iter().map(triangle).collect()
                    }
                }
            }
            Topic::Facing => vec![triangle([(); 3].map(|()| on_lattice(0, cell)))],
            Topic::Lines => vec![line(&mut rng, step, cell, index)?],
            Topic::Depth => crossing(&mut rng, step, cell),
            Topic::Values => {
                let case = family(IN_PERSPECTIVE[(index % 3) as usize])?.case(seed, index);
                let Shape::Triangles { list, .. } = case.shape else { return None };
                vec![valued(list.first()?, step)]
            }
            Topic::NearPlane => vec![clip_space(&mut rng, index)],
        }))
    };
    // Twice as many as there is room for are tried, since some leave their cell.
    let mut list: Vec<Drawing> = (0..2 * room).filter_map(one).take(room).collect();
    if check == Topic::Facing {
        turn_every_other(&mut list);
    }
    (layout, list)
}

/// Turns every other triangle round: what faces the other way is drawn too, and is culled.
fn turn_every_other(list: &mut [Drawing]) {
    for Drawing(shapes) in list.iter_mut().step_by(2) {
        shapes[0].swap(1, 2);
    }
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
    // Corners of the quadrilaterals; those on the border stay there.
    let mut points = [[[0.0; 2]; 4]; 4];
    for (j, row) in (0..).zip(&mut points) {
        for (i, point) in (0..).zip(row) {
            for (at, number) in point.iter_mut().zip([i, j]) {
                let inside = inner(number);
                *at = match number {
                    0 => 0.0,
                    3 => f64::from(cell),
                    _ => inside,
                };
            }
        }
    }
    let mut shapes = Vec::new();
    for j in 0..3 {
        for i in 0..3 {
            let [a, b] = [points[j][i], points[j][i + 1]];
            let [d, c] = [points[j + 1][i], points[j + 1][i + 1]];
            // Either diagonal, so that the edges of neighbours meet in every way.
            let split = if rng.chance(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            for triangle in split {
                shapes.push(triangle.map(|[x, y]| [x, y, 0.5, 1.0, 1.0, 0.0]).to_vec());
            }
        }
    }
    shapes
}

/// A line between positions of the lattice, pixel centres, or pixel corners, in turn.
fn line(rng: &mut Rng, step: i32, cell: i32, index: u64) -> Option<Vec<Vertex>> {
    let (low, high) = (2, cell - 2);
    // The first and the last whole number of units, and what they are counted in and from.
    let (first, last, unit, offset) = match index % 3 {
        0 => (low * SUBPIXELS / step, high * SUBPIXELS / step, step, 0),
        1 => (low, high - 1, SUBPIXELS, HALF_PIXEL),
        _ => (low, high, SUBPIXELS, 0),
    };
    let mut v = || rng.int(i64::from(first), i64::from(last)) as i32 * unit + offset;
    let ends = [(); 2].map(|()| SubpixelPoint::new(v(), v()));
    (ends[0] != ends[1]).then(|| ends.map(plain).to_vec())
}

/// A line between centres of pixels whose places are counted from the middle of a cell; none where it is a point.
fn around_middle(line: &Line, cell: i32) -> Option<Vec<Vertex>> {
    let place = |px: i32| (px + cell / 2) * SUBPIXELS + HALF_PIXEL;
    let ends = line.ends.map(|end| SubpixelPoint::new(place(end.pixel.x), place(end.pixel.y)));
    (ends[0] != ends[1]).then(|| ends.map(plain).to_vec())
}

/// Two triangles whose depths lean through each other; their first attributes tell them apart.
fn crossing(rng: &mut Rng, step: i32, cell: i32) -> Vec<Vec<Vertex>> {
    let steps = i64::from(cell) * i64::from(SUBPIXELS / step);
    // Corners anywhere in the cell, depths in whole 1024ths.
    let mut shapes = vec![Vec::new(); 2];
    for (shape, number) in shapes.iter_mut().zip([1.0, 2.0]) {
        for _ in 0..3 {
            let mut v = || rng.int(0, steps) as i32 * step;
            let [x, y, ..] = plain(SubpixelPoint::new(v(), v()));
            shape.push([x, y, rng.int(64, 960) as f64 / 1024.0, 1.0, number, 0.0]);
        }
    }
    shapes
}

/// Triangles before and behind each other, with their depths rounded to f32; the first attributes count them.
fn numbered(list: &[Triangle], step: i32) -> Vec<Vec<Vertex>> {
    let mut shapes = Vec::new();
    for (triangle, number) in list.iter().zip(1..) {
        let mut shape = valued(triangle, step);
        for vertex in &mut shape {
            vertex[4] = f64::from(number);
        }
        shapes.push(shape);
    }
    shapes
}

/// A triangle of the families with its values rounded to f32.
fn valued(triangle: &Triangle, step: i32) -> Vec<Vertex> {
    let f32 = |v: f64| f64::from(v as f32);
    let px = |v: i32| f64::from(v & -step) / f64::from(SUBPIXELS);
    let mut vertices = Vec::new();
    for v in &triangle.vertices {
        let w = f32(1.0 / v.inv_w);
        // Off both planes, so that nothing is clipped.
        let depth = f32(0.0625 + 0.875 * v.depth);
        // All three have a w of their own, by which x, y and depth are multiplied.
        let [x, y] = [px(v.position.x) * w, px(v.position.y) * w];
        vertices.push([x, y, depth * w, w, f32(v.varying.x), f32(v.varying.y)]);
    }
    vertices
}

/// A triangle that the near plane may cut.
fn clip_space(rng: &mut Rng, index: u64) -> Vec<Vertex> {
    (0..3).map(|_| from_whole(clipped::corner(rng, index.is_multiple_of(2)))).collect()
}

/// A corner in clip space as a vertex of a cell, in whose middle the view volume's axis lies.
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
