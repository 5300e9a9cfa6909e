//! Facts of a question about a mesh: triangles that share edges.

use glam::DVec2;

use rasterproof_core::geometry::{is_disjoint, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};

use super::triangles::{Point, columns_at};
use super::{
    Read, Test, Topic, Unit, WINDOW_WAYS, fact, facts_of, numbers, saturated, share, vary_window,
};
use crate::cases::{Case, Limits, Shape};

/// Meshes.
pub const TOPIC: Topic = Topic {
    name: "mesh-design",
    facts: &facts_of(&FACTS),
    measure: |case, _| Some(numbers(&FACTS, &MeshFacts::of_case(case)?)),
    impossible: include_str!("impossible/mesh-design.txt"),
    draw,
    vary,
    put,
};

const PX: i64 = SUBPIXELS as i64;
/// One square pixel, in half square steps.
const SQUARE_PX: i64 = 2 * PX * PX;
const MOST: usize = 16;
const SIDES: Test = Test::Steps(&[2, 3, 9, 17]);
const EXTENT: Test = Test::Steps(&[PX, 8 * PX, 64 * PX, 4096 * PX]);
const BEYOND: Test = Test::Steps(&[1, PX << 8]);
const SOME: Test = Test::Choice(&["none", "some", "all"]);
const COUNT: Test = Test::Steps(&[1, 2, 4]);
const BITS: Test = Test::Steps(&[1, 2, 5]);

/// The facts that the design covers.
const FACTS: [Read<MeshFacts>; 23] = [
    fact("triangles", Unit::Count, |m| m.count, Test::Steps(&[2, 3, 5, 9])),
    fact("its triangles", Unit::Count, |m| m.overlaps, Test::Choice(&["apart", "over each other"])),
    fact("triangles around one corner", Unit::Count, |m| m.around, Test::Steps(&[2, 3, 4, 5])),
    fact("edges that two triangles share", Unit::Count, |m| m.shared, COUNT),
    fact("shared edges that are level", Unit::Count, |m| m.level, Test::Steps(&[1, 2])),
    fact("shared edges that are upright", Unit::Count, |m| m.upright, Test::Steps(&[1, 2])),
    fact("samples on shared edges", Unit::Count, |m| m.ties, Test::Steps(&[1, 2, 9])),
    fact("samples at corners of several triangles", Unit::Count, |m| m.met, Test::Steps(&[1, 2])),
    fact("clockwise triangles", Unit::Count, |m| m.clockwise, SOME),
    fact("triangles that the window cuts", Unit::Count, |m| m.cut, SOME),
    fact("the width of the mesh", Unit::Subpixels, |m| m.size[0], EXTENT),
    fact("the height of the mesh", Unit::Subpixels, |m| m.size[1], EXTENT),
    fact(
        "the area of its smallest triangle",
        Unit::HalfSquareSubpixels,
        |m| m.least_area,
        Test::Steps(&[1, SQUARE_PX, SQUARE_PX << 6]),
    ),
    fact("what lies to the left of the window", Unit::Subpixels, |m| m.beyond[0], BEYOND),
    fact("what lies above the window", Unit::Subpixels, |m| m.beyond[1], BEYOND),
    fact("what lies to the right of the window", Unit::Subpixels, |m| m.beyond[2], BEYOND),
    fact("what lies below the window", Unit::Subpixels, |m| m.beyond[3], BEYOND),
    fact("the width of the window", Unit::Pixels, |m| m.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.window[1], SIDES),
    fact("the width of the window in pixels", Unit::Count, |m| m.window[0], Test::Divisor),
    fact("the height of the window in pixels", Unit::Count, |m| m.window[1], Test::Divisor),
    fact("the bits of its columns below the pixel", Unit::Count, |m| m.bits[0], BITS),
    fact("the bits of its rows below the pixel", Unit::Count, |m| m.bits[1], BITS),
];

/// What was measured of some triangles that may share edges.
struct MeshFacts {
    count: i64,
    /// Whether two of them share more than edges, or one has no area.
    overlaps: i64,
    /// The most that have a corner at the same place.
    around: i64,
    /// Edges of exactly two of them, and those of these along a row or along a column.
    shared: i64,
    level: i64,
    upright: i64,
    /// Samples of the window on shared edges, and at corners of several triangles.
    ties: i64,
    met: i64,
    /// How many run clockwise, and how many have a corner outside the window: none, some, all.
    clockwise: i64,
    cut: i64,
    size: [i64; 2],
    /// Twice the area of the smallest one, at most `i64::MAX`.
    least_area: i64,
    /// How far it reaches beyond the left, upper, right and lower side of the window.
    beyond: [i64; 4],
    window: [i64; 2],
    /// Bits below the pixel that columns and rows use.
    bits: [i64; 2],
}

impl MeshFacts {
    fn of_case(case: &Case) -> Option<Self> {
        let list: Vec<Corners> = case.triangles().iter().map(ScreenTriangle::corners).collect();
        let first = point(list.first()?.first()?);
        let window = [i64::from(case.window.width()), i64::from(case.window.height())];
        let mut measured = Self {
            count: list.len() as i64,
            overlaps: i64::from(!is_disjoint(&list)),
            around: 0,
            shared: 0,
            level: 0,
            upright: 0,
            ties: 0,
            met: 0,
            clockwise: 0,
            cut: 0,
            size: [0; 2],
            least_area: i64::MAX,
            beyond: [0; 4],
            window,
            bits: [0; 2],
        };
        let (mut low, mut high) = (first, first);
        let (mut clockwise, mut cut) = (0, 0);
        for corners in &list {
            let mut is_cut = false;
            for corner in corners {
                let p = point(corner);
                for axis in 0..2 {
                    low[axis] = low[axis].min(p[axis]);
                    high[axis] = high[axis].max(p[axis]);
                    let bits = 8 - i64::from((p[axis] as u64 | 256).trailing_zeros());
                    measured.bits[axis] = measured.bits[axis].max(bits);
                    is_cut |= p[axis] < 0 || p[axis] > window[axis] * PX;
                }
            }
            cut += usize::from(is_cut);
            let area = twice_area(corners);
            clockwise += usize::from(area > 0);
            let area = area.unsigned_abs().min(i64::MAX as u128) as i64;
            measured.least_area = measured.least_area.min(area);
        }
        measured.clockwise = share(clockwise, list.len());
        measured.cut = share(cut, list.len());
        measured.size = [high[0] - low[0], high[1] - low[1]];
        measured.beyond = [-low[0], -low[1], high[0] - window[0] * PX, high[1] - window[1] * PX];
        measured.count_corners(&list);
        measured.count_edges(&list);
        Some(measured)
    }

    /// Counts the triangles at one place, and the samples at which several meet.
    fn count_corners(&mut self, list: &[Corners]) {
        let mut places: Vec<u64> = list.iter().flatten().map(as_number).collect();
        places.sort_unstable();
        for same in places.chunk_by(|a, b| a == b) {
            self.around = self.around.max(same.len() as i64);
            let is_met = same.len() > 1 && is_sample(point(&as_point(same[0])), self.window);
            self.met += i64::from(is_met);
        }
    }

    /// Counts the shared edges, and the samples on them.
    fn count_edges(&mut self, list: &[Corners]) {
        let mut edges: Vec<u128> = Vec::with_capacity(3 * list.len());
        for corners in list {
            if twice_area(corners) == 0 {
                continue;
            }
            let [a, b, c] = corners.each_ref().map(as_number);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                edges.push(u128::from(p.min(q)) << 64 | u128::from(p.max(q)));
            }
        }
        edges.sort_unstable();
        for same in edges.chunk_by(|a, b| a == b) {
            if same.len() != 2 {
                continue;
            }
            let [p, q] =
                [point(&as_point((same[0] >> 64) as u64)), point(&as_point(same[0] as u64))];
            self.shared += 1;
            self.level += i64::from(p[1] == q[1]);
            self.upright += i64::from(p[0] == q[0]);
            for row in 0..self.window[1] {
                let y = row * PX + i64::from(HALF_PIXEL);
                let Some((first, last, true)) = columns_at(p, q, y) else { continue };
                self.ties += (last.min(self.window[0] - 1) - first.max(0) + 1).max(0);
            }
        }
    }
}

/// A corner as one number, of which many are sorted faster.
fn as_number(corner: &SubpixelPoint) -> u64 {
    u64::from(corner.x as u32) << 32 | u64::from(corner.y as u32)
}

fn as_point(number: u64) -> SubpixelPoint {
    SubpixelPoint::new((number >> 32) as i32, number as i32)
}

fn point(p: &SubpixelPoint) -> Point {
    [p.x.into(), p.y.into()]
}

/// Whether a point is the centre of a pixel of the window.
fn is_sample(p: Point, window: [i64; 2]) -> bool {
    let mut is_sample = true;
    for axis in 0..2 {
        is_sample &= p[axis].rem_euclid(PX) == i64::from(HALF_PIXEL);
        is_sample &= 0 <= p[axis] && p[axis] < window[axis] * PX;
    }
    is_sample
}

/// A side of a window: every pixel within a mesh is looked at.
fn draw_side(rng: &mut Rng) -> i64 {
    match rng.int(0, 7) {
        0 => 1,
        1 => 2,
        2 | 3 => rng.int(3, 8),
        4 => 16 * rng.int(1, 2),
        _ => rng.int(9, 24),
    }
}

/// How the corners of a mesh are placed: on multiples of a step, or a little beside them.
#[derive(Clone, Copy)]
struct Lattice {
    step: i64,
    from: i64,
    off: i64,
}

fn draw_lattice(rng: &mut Rng) -> Lattice {
    let half = i64::from(HALF_PIXEL);
    let (step, from) =
        [(PX, half), (PX, 0), (PX / 2, 0), (PX / 4, 0), (1, 0)][rng.int(0, 4) as usize];
    Lattice { step, from, off: if rng.chance(4) { 2 } else { 0 } }
}

fn on_lattice(rng: &mut Rng, lattice: Lattice, v: i64) -> i64 {
    v.div_euclid(lattice.step) * lattice.step + lattice.from + rng.int(-lattice.off, lattice.off)
}

/// A grid of some columns and rows of corners, its cells split along either diagonal, or a fan around a corner.
fn draw(rng: &mut Rng) -> Case {
    let window = [draw_side(rng), draw_side(rng)];
    let lattice = draw_lattice(rng);
    let far = if rng.chance(4) { 1 << rng.int(8, 20) } else { 4 };
    // Where it begins and how large it is, from smaller than a pixel to far larger than the window.
    let mut begin = [0; 2];
    let mut size = [0; 2];
    for axis in 0..2 {
        size[axis] = match rng.int(0, 3) {
            0 => rng.int(PX / 2, 4 * PX),
            1 => window[axis] * PX * rng.int(1, 8) / 4,
            _ => window[axis] * PX * rng.int(1, far) / 2,
        };
        begin[axis] = rng.int(-size[axis] / 2, window[axis] * PX - size[axis] / 2);
    }
    // As large as the window allows, or nearly.
    if rng.chance(4) {
        size = window.map(|side| side * PX - rng.int(0, PX));
        begin = [rng.int(0, PX / 2), rng.int(0, PX / 2)];
    }
    let list = if rng.chance(2) {
        fan(rng, lattice, begin, size)
    } else {
        grid(rng, lattice, begin, size)
    };
    case_of(PixelRect::window(window[0] as u32, window[1] as u32), list)
}

type Mesh = Vec<[Point; 3]>;

fn grid(rng: &mut Rng, lattice: Lattice, begin: Point, size: Point) -> Mesh {
    let [columns, rows] =
        if rng.chance(3) { [rng.int(4, 6), 1] } else { [rng.int(1, 3), rng.int(1, 2)] };
    let is_split_alike = rng.chance(2);
    let is_bent = rng.chance(2);
    let mut corners = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let at = [column * size[0] / columns, row * size[1] / rows];
            let mut corner = [0; 2];
            for axis in 0..2 {
                // A quarter of a cell at most, so that no cell turns over.
                let cell = [size[0] / columns, size[1] / rows][axis];
                let by = if is_bent { rng.int(-cell / 4, cell / 4) } else { 0 };
                corner[axis] = on_lattice(rng, lattice, begin[axis] + at[axis] + by);
            }
            corners.push(corner);
        }
    }
    let mut mesh = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let at = |x: i64, y: i64| corners[((row + y) * (columns + 1) + column + x) as usize];
            let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            mesh.extend(if is_split_alike || rng.chance(2) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
    }
    mesh
}

/// Around the middle of a box, through points of its sides.
fn fan(rng: &mut Rng, lattice: Lattice, begin: Point, size: Point) -> Mesh {
    let place = |rng: &mut Rng, quarters: Point| {
        [0, 1].map(|axis: usize| {
            on_lattice(rng, lattice, begin[axis] + size[axis] * quarters[axis] / 4)
        })
    };
    let middle = place(rng, [2, 2]);
    let mut ring = Vec::new();
    for quarters in [[0, 0], [2, 0], [4, 0], [4, 2], [4, 4], [2, 4], [0, 4], [0, 2]] {
        // Without some of the middles of sides.
        if quarters.contains(&2) && rng.chance(2) {
            continue;
        }
        ring.push(place(rng, quarters));
    }
    (0..ring.len()).map(|i| [middle, ring[i], ring[(i + 1) % ring.len()]]).collect()
}

/// A case of some triangles; whether they are apart is seen when they are put where somebody draws.
fn case_of(window: PixelRect, mesh: Mesh) -> Case {
    let vertex = |[x, y]: Point| ScreenVertex {
        position: SubpixelPoint::new(saturated(x), saturated(y)),
        depth: 0.0,
        inv_w: 1.0,
        varying: DVec2::ZERO,
    };
    let list: Vec<_> =
        mesh.iter().map(|points| ScreenTriangle { vertices: points.map(vertex) }).collect();
    Case { window, shape: Shape::Triangles { list, disjoint: false } }
}

/// The case within limits, with a note whether its triangles are apart.
fn put(limits: &Limits, case: Case) -> Case {
    let mut case = limits.put(case);
    if let Shape::Triangles { list, disjoint } = &mut case.shape {
        let corners: Vec<Corners> = list.iter().map(ScreenTriangle::corners).collect();
        *disjoint = is_disjoint(&corners);
    }
    case
}

fn mesh_of(case: &Case) -> Mesh {
    case.triangles().iter().map(|triangle| triangle.corners().each_ref().map(point)).collect()
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let mut window = one.window;
    let (mut mesh, others) = (mesh_of(one), mesh_of(other));
    for _ in 0..rng.int(1, 3) {
        let at = rng.int(0, mesh.len() as i64 - 1) as usize;
        let axis = rng.int(0, 1) as usize;
        match rng.int(0, 16) {
            0 => window = PixelRect::window(draw_side(rng) as u32, draw_side(rng) as u32),
            way @ 1..WINDOW_WAYS => vary_window(rng, &mut window, other.window, way, axis),
            4 => mesh.clone_from(&others),
            5 => mesh.truncate(at + 1),
            6 => {
                mesh.swap_remove(at);
            }
            // The triangle beyond an edge, which is then shared.
            7 | 8 if mesh.len() < MOST => {
                let [a, b, c] = mesh[at];
                let is_thin = rng.chance(3);
                let mut beyond = [0; 2];
                for axis in 0..2 {
                    let away = a[axis] + b[axis] - 2 * c[axis];
                    // Mirrored, or a step or two outside of the middle of the edge.
                    beyond[axis] = match is_thin {
                        true => (a[axis] + b[axis]) / 2 + away.signum() * rng.int(0, 2),
                        false => c[axis] + away,
                    };
                }
                mesh.push([b, a, beyond]);
            }
            // A corner with all that is there.
            9 => {
                let (old, mut new) = (mesh[at][0], mesh[at][0]);
                new[axis] += rng.int(-3, 3) << (8 * rng.int(0, 1));
                move_corners(&mut mesh, |p| if p == old { new } else { p });
            }
            // All corners on a lattice.
            10 => {
                let lattice = Lattice { off: 0, ..draw_lattice(rng) };
                move_corners(&mut mesh, |p| {
                    p.map(|v| v.div_euclid(lattice.step) * lattice.step + lattice.from)
                });
            }
            // Moved, or made larger or smaller, along an axis.
            11 => {
                let by = rng.int(-20, 20) << rng.int(6, 18);
                move_corners(&mut mesh, |mut p| {
                    p[axis] += by;
                    p
                });
            }
            12 => {
                let doublings = rng.int(-3, 5);
                move_corners(&mut mesh, |mut p| {
                    p[axis] =
                        if doublings < 0 { p[axis] >> -doublings } else { p[axis] << doublings };
                    p
                });
            }
            // One side of it inside the window, or not far beyond it.
            14 => {
                let side = i64::from([window.x1, window.y1][axis]) * PX;
                let ends = mesh.iter().flatten().map(|p| p[axis]);
                let near = rng.int(-255 * PX, side / 2) >> (8 * rng.int(0, 1));
                let by = match rng.chance(2) {
                    true => near - ends.min().unwrap_or(0),
                    false => side - near - ends.max().unwrap_or(0),
                };
                move_corners(&mut mesh, |mut p| {
                    p[axis] += by;
                    p
                });
            }
            // Another mesh, or the same again, beside it; perhaps several times.
            15 => {
                for _ in 0..rng.int(1, 3) {
                    let beside = if rng.chance(2) { mesh.clone() } else { others.clone() };
                    let end = mesh.iter().flatten().map(|p| p[axis]).max().unwrap_or(0);
                    let start = beside.iter().flatten().map(|p| p[axis]).min().unwrap_or(0);
                    let by = end - start + rng.int(1, PX);
                    for mut triangle in beside.into_iter().take(MOST.saturating_sub(mesh.len())) {
                        triangle.iter_mut().for_each(|p| p[axis] += by);
                        mesh.push(triangle);
                    }
                }
            }
            // One or all turned over.
            13 => mesh[at].swap(1, 2),
            _ => {
                let turn = |[a, b, c]: &[Point; 3]| {
                    (b[0] - a[0]) as i128 * (c[1] - a[1]) as i128
                        - (b[1] - a[1]) as i128 * (c[0] - a[0]) as i128
                };
                let sign = if rng.chance(2) { 1 } else { -1 };
                for triangle in mesh.iter_mut().filter(|triangle| turn(triangle) * sign < 0) {
                    triangle.swap(1, 2);
                }
            }
        }
        if mesh.is_empty() {
            mesh.clone_from(&others);
        }
    }
    let within = |v: i64| v.clamp(-(1 << 31), (1 << 31) - 1);
    move_corners(&mut mesh, |p| p.map(within));
    case_of(window, mesh)
}

fn move_corners(mesh: &mut Mesh, to: impl Fn(Point) -> Point) {
    for corner in mesh.iter_mut().flatten() {
        *corner = to(*corner);
    }
}
