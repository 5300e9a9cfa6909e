//! The search for the smallest subject that fails. Subjects that are a step smaller are drawn in one picture, and the search goes on from
//! the first of them that fails.

use std::cell::RefCell;

use super::expected::is_tiling;
use super::judge::{Judge, failing};
use super::subjects::{area, drawn, from_whole, layout_for, triangle, whole};
use super::{Batch, Device, Drawing, Topic, Vertex};
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::named::plain_triangle;
use rasterproof_verify::cases::shrink::{SmallerSearch, Steps, smaller_cases};
use rasterproof_verify::cases::{Case, Shape};
use serde_json::{Value, json};

/// A search that waits for a picture, and the subjects in it.
struct WaitingSearch {
    search: SmallerSearch<Drawing>,
    asked: Vec<Drawing>,
}

thread_local! {
    static WAITING: RefCell<Option<WaitingSearch>> = const { RefCell::new(None) };
}

impl Judge {
    /// The next picture of a search, which begins with a subject that fails, and goes on with the pixels of the picture before. At its
    /// end there are no more subjects; `smallest` is what it has reached.
    pub fn smaller(&self) -> Result<Value, String> {
        let Batch { check, device, ref only, .. } = self.batch;
        let steps = DrawingSteps { check, device };
        WAITING.with_borrow_mut(|waiting| {
            if let Some(subject) = only {
                layout_for(check, subject)?;
                let search = SmallerSearch::new(subject.clone(), &steps);
                *waiting = Some(WaitingSearch { search, asked: Vec::new() });
            }
            let WaitingSearch { search, asked } =
                waiting.as_mut().ok_or("no search waits for a picture")?;
            if only.is_none() {
                let layout = layout_for(check, &search.smallest)?;
                let fails = failing(check, device, layout, &self.pixels, asked)?;
                search.answer(&steps, &fails);
            }
            let layout = layout_for(check, &search.smallest)?;
            *asked = search.next(&steps, layout.room());
            let vertices = asked.iter().map(|subject| drawn(check, subject));
            let mut picture = device.picture(check, layout, vertices);
            picture["smallest"] = json!(search.smallest);
            Ok(picture)
        })
    }
}

/// By which steps the subjects of a check get smaller.
struct DrawingSteps {
    check: Topic,
    device: Device,
}

impl Steps for DrawingSteps {
    type Case = Drawing;

    fn candidates(&self, _: usize, subject: &Drawing) -> Vec<Drawing> {
        let layout = layout_for(self.check, subject);
        layout.map_or_else(
            |_| Vec::new(),
            |layout| smaller(self.check, self.device, subject, layout.cell),
        )
    }

    /// Candidates are smaller as they are made.
    fn is_step(&self, _: usize, _: &Drawing, _: &Drawing) -> bool {
        true
    }
}

/// How the subjects lie in the picture that is waited for, and these.
#[cfg(test)]
pub(super) fn asked(check: Topic) -> (super::Layout, Vec<Drawing>) {
    WAITING.with_borrow(|waiting| {
        let WaitingSearch { search, asked } = waiting.as_ref().unwrap();
        (layout_for(check, &search.smallest).unwrap(), asked.clone())
    })
}

/// The smaller subjects of a check, those that are much smaller first.
fn smaller(check: Topic, device: Device, subject: &Drawing, cell: i32) -> Vec<Drawing> {
    match check {
        Topic::NearPlane => smaller_whole(subject),
        Topic::Tiling | Topic::Lines | Topic::Depth | Topic::Values => {
            smaller_numbers(check, device, subject, cell)
        }
        _ => smaller_corners(check, device, subject, cell),
    }
}

/// Of subjects that are no more than corners: those whose corners lie on the device's lattice and in the cell.
fn smaller_corners(check: Topic, device: Device, subject: &Drawing, cell: i32) -> Vec<Drawing> {
    let step = if check == Topic::Lattice { 1 } else { device.step() };
    let list = subject.corners().into_iter().map(plain_triangle).collect();
    let window = PixelRect::window(cell as u32, cell as u32);
    let case = Case { window, shape: Shape::Triangles { list, disjoint: false } };
    let corners = |case: Case| match case.shape {
        Shape::Triangles { list, .. } => list.iter().map(|t| t.corners()).collect::<Vec<_>>(),
        _ => Vec::new(),
    };
    let fits = |v: i32| {
        let range = if check == Topic::Reach { -7 * cell..=8 * cell } else { 0..=cell };
        v % step == 0 && (range.start() * SUBPIXELS..=range.end() * SUBPIXELS).contains(&v)
    };
    let fits = |all: &Vec<Corners>| all.iter().flatten().all(|p| fits(p.x) && fits(p.y));
    smaller_cases(&case)
        .into_iter()
        .filter(|smaller| smaller.window == window)
        .map(corners)
        .filter(fits)
        .map(|all| Drawing(all.into_iter().map(triangle).collect()))
        .collect()
}

/// Of a triangle in clip space: a coordinate nearer to 0, of which few bits are kept. No corner comes to lie in
/// the near plane, or nearer than w = 1 before the eye: those are dangers of their own.
fn smaller_whole(subject: &Drawing) -> Vec<Drawing> {
    let Some(corners) = whole(subject) else { return Vec::new() };
    let coordinates = (0..3).flat_map(|corner| (0..4).map(move |axis| (corner, axis)));
    coordinates
        .flat_map(|(corner, axis)| {
            let v: i64 = corners[corner][axis];
            let simpler = [0, v / 2, v / 64 * 64, v / 8 * 8, v - v.signum()];
            simpler.into_iter().filter(move |smaller| *smaller != v).map(move |smaller| {
                let mut corners = corners;
                corners[corner][axis] = smaller;
                corners
            })
        })
        .filter(|corners| corners.iter().all(|[.., z, w]| *z != 0 && (*w <= 0 || *w >= 64)))
        .map(|corners| Drawing(vec![corners.map(from_whole).to_vec()]))
        .collect()
}

/// The shapes of a subject with x, y and depth divided by w.
type Shapes = Vec<Vec<Vertex>>;

/// Divides x, y and depth by w, or multiplies them by it.
fn scaled([x, y, z, w, a, b]: Vertex, by: f64) -> Vertex {
    [x * by, y * by, z * by, w, a, b]
}

/// Of subjects with values: fewer shapes, nearer to each other and to the cell's corner, with simpler numbers.
fn smaller_numbers(check: Topic, device: Device, subject: &Drawing, cell: i32) -> Vec<Drawing> {
    let shapes: Shapes =
        subject.0.iter().map(|t| t.iter().map(|v| scaled(*v, 1.0 / v[3])).collect()).collect();
    let mut found = fewer(&shapes);
    found.extend([1.0, 2.0, 4.0, 8.0].map(|px| canonical(check, &shapes, px)));
    let mut moved = |by: &dyn Fn(f64, usize) -> f64| {
        let mut all = shapes.clone();
        for vertex in all.iter_mut().flatten() {
            [0, 1].into_iter().for_each(|axis| vertex[axis] = by(vertex[axis], axis));
        }
        found.push(all);
    };
    for px in [16.0, 4.0, 1.0] {
        moved(&|v, axis| if axis == 0 { v - px } else { v });
        moved(&|v, axis| if axis == 1 { v - px } else { v });
    }
    for per_px in [0.5, 1.0, 2.0, 4.0] {
        moved(&|v, _| (v * per_px).floor() / per_px);
        moved(&|v, _| (v / 2.0 * per_px).floor() / per_px);
    }
    // A value alike at all vertices, or depths one before the other.
    for (axis, value) in (2..6).flat_map(|axis| [0.0, 0.5, 1.0].map(|value| (axis, value))) {
        let mut all = shapes.clone();
        all.iter_mut().flatten().for_each(|v| v[axis] = value);
        found.push(all);
    }
    for depths in [[0.25, 0.75], [0.75, 0.25]] {
        let mut all = shapes.clone();
        for (shape, depth) in all.iter_mut().zip(depths) {
            shape.iter_mut().for_each(|v| v[2] = depth);
        }
        found.push(all);
    }
    // Of more shapes than a pixel needs some go first.
    let vertices: Vec<Vertex> = if shapes.len() <= 4 { shapes.concat() } else { Vec::new() };
    for v in &vertices {
        // Vertices at one place move together.
        let mut with = |axis: usize, value: [f64; 2]| {
            let mut all = shapes.clone();
            for vertex in all.iter_mut().flatten() {
                match axis {
                    0 if vertex[..2] == v[..2] => vertex[..2].copy_from_slice(&value),
                    2.. if vertex == v => vertex[axis] = value[0],
                    _ => {}
                }
            }
            found.push(all);
        };
        for other in &vertices {
            let middle = |axis: usize| ((v[axis] + other[axis]) * 2.0).floor() / 4.0;
            with(0, [middle(0), middle(1)]);
        }
        let [xs, ys] = [v[0], v[1]].map(positions);
        xs.iter().zip(&ys).for_each(|(x, y)| with(0, [*x, *y]));
        xs.iter().for_each(|x| with(0, [*x, v[1]]));
        ys.iter().for_each(|y| with(0, [v[0], *y]));
        for (axis, number) in v.iter().enumerate().skip(2) {
            simpler(*number).into_iter().for_each(|value| with(axis, [value, 0.0]));
        }
    }
    // The smallest first, so that few steps lead far.
    found.sort_by(|a, b| size(a).partial_cmp(&size(b)).unwrap_or(std::cmp::Ordering::Equal));
    let current = size(&shapes);
    let multiplied = |all: Shapes| {
        Drawing(all.iter().map(|t| t.iter().map(|v| scaled(*v, v[3])).collect()).collect())
    };
    found
        .into_iter()
        .filter(|all| size(all) < current && is_valid(check, device, &shapes, all, cell))
        .map(multiplied)
        .filter(|subject| check != Topic::Tiling || is_tiling(subject, cell))
        .collect()
}

/// The shapes with their values, as halves of a square at the origin: of a tiling one beside the other, else one
/// over the other.
fn canonical(check: Topic, shapes: &Shapes, px: f64) -> Shapes {
    let mut all = shapes.clone();
    for (index, shape) in all.iter_mut().enumerate() {
        let is_second = check == Topic::Tiling && index % 2 == 1;
        let corners = [[px, 0.0], if is_second { [px, px] } else { [0.0, 0.0] }, [0.0, px]];
        shape.iter_mut().zip(corners).for_each(|(v, corner)| v[..2].copy_from_slice(&corner));
    }
    all
}

/// Each shape alone, each two, and all but one.
fn fewer(shapes: &Shapes) -> Vec<Shapes> {
    let n = shapes.len();
    let alone = (0..n).map(|i| vec![shapes[i].clone()]);
    let pairs =
        (0..n).flat_map(|j| (0..j).map(move |i| vec![shapes[i].clone(), shapes[j].clone()]));
    let without = (0..n).map(|i| [&shapes[..i], &shapes[i + 1..]].concat());
    alone.chain(pairs).chain(without).filter(|all| !all.is_empty()).collect()
}

/// Simpler places of a coordinate in px.
fn positions(v: f64) -> Vec<f64> {
    let whole = v.floor();
    let rounded = [4.0, 16.0, 64.0].map(|per_px| (v * per_px).round() / per_px);
    [&[0.0, whole, whole + 0.5, whole + 1.0, v - 4.0, v - 1.0, (v + whole) / 2.0][..], &rounded]
        .concat()
}

/// Simpler values of a depth, of w, or of an attribute.
fn simpler(v: f64) -> Vec<f64> {
    let rounded = [1.0, 4.0, 16.0, 256.0].map(|steps| (v * steps).round() / steps);
    [&[0.0, 0.5, 0.25, 0.75, 1.0, 2.0, 4.0][..], &rounded].concat()
}

/// The number of shapes, then how far they reach in px, then how many bits behind the point their numbers need, then how large
/// they are.
pub(super) fn size(shapes: &Shapes) -> (usize, u32, u32, f64) {
    let numbers = || shapes.iter().flatten().flatten();
    let reach = |axis: usize| {
        let values = || shapes.iter().flatten().map(|v| v[axis]);
        (values().fold(0.0, f64::max) - values().fold(f64::INFINITY, f64::min)).ceil() as u32
    };
    // Behind the point.
    let bits =
        |v: &f64| (0..=52).find(|bits| (v * (1u64 << bits) as f64).fract() == 0.0).unwrap_or(53);
    (shapes.len(), reach(0) + reach(1), numbers().map(bits).sum(), numbers().map(|v| v.abs()).sum())
}

/// Whether a check could ask for these shapes, which were made of others.
fn is_valid(check: Topic, device: Device, before: &Shapes, shapes: &Shapes, cell: i32) -> bool {
    // Corners of a tiling lie anywhere; new ones on the finest lattice.
    let is_tiling = check == Topic::Tiling;
    let step = if is_tiling { 1.0 } else { f64::from(device.step()) } / f64::from(SUBPIXELS);
    let is_old = |v: f64| is_tiling && before.iter().flatten().any(|old| old[..2].contains(&v));
    let lies =
        |v: f64| (0.0..=f64::from(cell)).contains(&v) && ((v / step).fract() == 0.0 || is_old(v));
    let is_right = |v: &Vertex| {
        let [x, y, depth, w, a, _] = *v;
        // Within the planes, even when rounded.
        let is_deep = (1.0 / 64.0..=63.0 / 64.0).contains(&depth);
        let has_values = match check {
            Topic::Values => w > 0.0,
            // Their first attributes say which triangles they are.
            Topic::Depth => w == 1.0 && before.iter().any(|t| t[0][4] == a),
            _ => depth == 0.5 && w == 1.0 && a == 1.0,
        };
        lies(x) && lies(y) && is_deep && has_values
    };
    let has_extent = |shape: &Vec<Vertex>| {
        let at = |i: usize| [shape[i][0], shape[i][1]];
        if check == Topic::Lines { at(0) != at(1) } else { area(shape) != 0.0 }
    };
    let is_one = |t: &Vec<Vertex>| check != Topic::Depth || t.iter().all(|v| v[4] == t[0][4]);
    let all_differ =
        check != Topic::Depth || shapes.len() < 2 || shapes[0][0][4] != shapes[1][0][4];
    shapes.iter().flatten().all(is_right)
        && shapes.iter().all(has_extent)
        && shapes.iter().all(is_one)
        && all_differ
}
