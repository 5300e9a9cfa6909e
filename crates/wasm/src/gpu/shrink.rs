//! The search for the smallest subject that fails. Subjects that are a step smaller are drawn in one picture, and the search goes on from
//! the first of them that fails.
//!
//! A subject is smaller with fewer shapes, then with a smaller box, then with simpler numbers. Each step keeps it a subject that its check
//! could ask for, so that what is found can be drawn on the page and reported.

use std::cell::RefCell;
use std::iter::repeat;

use super::expected::is_tiling;
use super::judge::{Judge, failing};
use super::subjects::{area, drawn, from_whole, layout_for, triangle, whole};
use super::{Batch, Device, Drawing, Topic, Vertex};
use crate::no_answer::NoAnswer;
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
    pub fn smaller(&self) -> Result<Value, NoAnswer> {
        let Batch { check, device, ref only, .. } = self.batch;
        let steps = DrawingSteps { check, device };
        WAITING.with_borrow_mut(|waiting| {
            // A page that sends a subject begins anew; one that sends a picture alone goes on.
            if let Some(subject) = only {
                layout_for(check, subject)?;
                let search = SmallerSearch::new(subject.clone(), &steps);
                *waiting = Some(WaitingSearch { search, asked: Vec::new() });
            }
            let WaitingSearch { search, asked } =
                waiting.as_mut().ok_or("no search waits for a picture")?;
            // The pixels say which of the subjects that wait still fail.
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
        match layout_for(self.check, subject) {
            Ok(layout) => smaller(self.check, self.device, subject, layout.cell),
            Err(_) => Vec::new(),
        }
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
    // The steps are those by which cases are shrunk without a GPU.
    let list = subject.corners().into_iter().map(plain_triangle).collect();
    let window = PixelRect::window(cell as u32, cell as u32);
    let case = Case { window, shape: Shape::Triangles { list, disjoint: false } };
    // Corners that reach beyond their cell do so in this check alone.
    let (low, high) = if check == Topic::Reach { (-7 * cell, 8 * cell) } else { (0, cell) };
    let range = low * SUBPIXELS..=high * SUBPIXELS;
    let fits = |v: i32| v % step == 0 && range.contains(&v);
    let mut found = Vec::new();
    // The cell stays as large as it is, since the picture is divided into such cells.
    for case in smaller_cases(&case).into_iter().filter(|smaller| smaller.window == window) {
        let Shape::Triangles { list, .. } = case.shape else { continue };
        let all: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
        if all.iter().flatten().all(|p| fits(p.x) && fits(p.y)) {
            found.push(Drawing(all.into_iter().map(triangle).collect()));
        }
    }
    found
}

/// Of a triangle in clip space: a coordinate nearer to 0, of which few bits are kept. No corner comes to lie in
/// the near plane, or nearer than w = 1 before the eye: those are dangers of their own.
fn smaller_whole(subject: &Drawing) -> Vec<Drawing> {
    let Some(corners) = whole(subject) else { return Vec::new() };
    let mut found = Vec::new();
    for corner in 0..3 {
        for axis in 0..4 {
            // 0, the half, whole numbers of 64 and of 8, and one less.
            let v: i64 = corners[corner][axis];
            for simpler in [0, v / 2, v / 64 * 64, v / 8 * 8, v - v.signum()] {
                let mut smaller = corners;
                smaller[corner][axis] = simpler;
                let is_safe = smaller.iter().all(|[.., z, w]| *z != 0 && (*w <= 0 || *w >= 64));
                if simpler != v && is_safe {
                    found.push(Drawing(vec![smaller.map(from_whole).to_vec()]));
                }
            }
        }
    }
    found
}

/// The shapes of a subject with x, y and depth divided by w.
type Shapes = Vec<Vec<Vertex>>;

/// Divides x, y and depth by w: so places and depths are simple numbers, whatever w is.
fn divided(Drawing(shapes): &Drawing) -> Shapes {
    let mut all = shapes.clone();
    for vertex in all.iter_mut().flatten() {
        let by = 1.0 / vertex[3];
        for number in &mut vertex[..3] {
            *number *= by;
        }
    }
    all
}

/// Multiplies x, y and depth by w, as the interface takes them.
fn multiplied(mut shapes: Shapes) -> Drawing {
    for vertex in shapes.iter_mut().flatten() {
        let by = vertex[3];
        for number in &mut vertex[..3] {
            *number *= by;
        }
    }
    Drawing(shapes)
}

/// Of subjects with values: fewer shapes, nearer to each other and to the cell's corner, with simpler numbers.
fn smaller_numbers(check: Topic, device: Device, subject: &Drawing, cell: i32) -> Vec<Drawing> {
    let shapes = divided(subject);
    // Without some of the shapes, in a standard place, or with a change of all or of one vertex.
    let mut found = fewer(&shapes);
    if check == Topic::Depth {
        found.iter_mut().for_each(number_in_order);
    }
    for px in [1.0, 2.0, 4.0, 8.0] {
        found.push(canonical(check, &shapes, px));
    }
    add_changed_alike(&shapes, &mut found);
    // Of more shapes than a pixel needs some go first.
    if shapes.len() <= 4 {
        add_changed_singly(&shapes, &mut found);
    }
    // The smallest first, so that few steps lead far.
    found.sort_by(|a, b| size(a).partial_cmp(&size(b)).unwrap_or(std::cmp::Ordering::Equal));
    // Many of them are larger or are none that the check could ask for.
    let current = size(&shapes);
    let mut smaller = Vec::new();
    for all in found {
        if size(&all) < current && is_valid(check, device, &shapes, &all, cell) {
            let subject = multiplied(all);
            if check != Topic::Tiling || is_tiling(&subject, cell) {
                smaller.push(subject);
            }
        }
    }
    smaller
}

/// Adds shapes all of whose vertices are changed in one way.
fn add_changed_alike(shapes: &Shapes, found: &mut Vec<Shapes>) {
    // To the left or up by some pixels.
    for px in [16.0, 4.0, 1.0] {
        for axis in 0..2 {
            let mut all = shapes.clone();
            for vertex in all.iter_mut().flatten() {
                vertex[axis] -= px;
            }
            found.push(all);
        }
    }
    // To coarser positions, as large as they are or half as large.
    for per_px in [0.5, 1.0, 2.0, 4.0] {
        for scale in [1.0, 0.5] {
            let mut all = shapes.clone();
            for vertex in all.iter_mut().flatten() {
                for number in &mut vertex[..2] {
                    *number = (*number * scale * per_px).floor() / per_px;
                }
            }
            found.push(all);
        }
    }
    // A value alike at all vertices, or depths one before the other.
    for axis in 2..6 {
        for value in [0.0, 0.5, 1.0] {
            let mut all = shapes.clone();
            for vertex in all.iter_mut().flatten() {
                vertex[axis] = value;
            }
            found.push(all);
        }
    }
    for depths in [[0.25, 0.75], [0.75, 0.25]] {
        let mut all = shapes.clone();
        for (shape, depth) in all.iter_mut().zip(depths) {
            for vertex in shape {
                vertex[2] = depth;
            }
        }
        found.push(all);
    }
}

/// Adds shapes with a simpler place or a simpler value of one vertex.
fn add_changed_singly(shapes: &Shapes, found: &mut Vec<Shapes>) {
    // The other numbers of a vertex stay as they are: what is changed singly is seen singly.
    let vertices = shapes.concat();
    for v in &vertices {
        // Halfway to the other vertices, on quarters of a pixel.
        for other in &vertices {
            let middle = |axis: usize| ((v[axis] + other[axis]) * 2.0).floor() / 4.0;
            found.push(at_place(shapes, v, [middle(0), middle(1)]));
        }
        // Both coordinates in the same way, and each by itself.
        let (xs, ys) = (positions(v[0]), positions(v[1]));
        for (x, y) in xs.iter().zip(&ys) {
            found.push(at_place(shapes, v, [*x, *y]));
        }
        for x in xs {
            found.push(at_place(shapes, v, [x, v[1]]));
        }
        for y in ys {
            found.push(at_place(shapes, v, [v[0], y]));
        }
        // Depth, w and both attributes, at all vertices that are the same one.
        for axis in 2..6 {
            for value in simpler(v[axis]) {
                let mut all = shapes.clone();
                for vertex in all.iter_mut().flatten().filter(|vertex| *vertex == v) {
                    vertex[axis] = value;
                }
                found.push(all);
            }
        }
    }
}

/// The shapes with a vertex at another place. Vertices at one place move together.
fn at_place(shapes: &Shapes, v: &Vertex, place: [f64; 2]) -> Shapes {
    let mut all = shapes.clone();
    for vertex in all.iter_mut().flatten() {
        if vertex[..2] == v[..2] {
            vertex[..2].copy_from_slice(&place);
        }
    }
    all
}

/// The shapes with their values, as halves of a square at the origin: of a tiling one beside the other, else one
/// over the other.
fn canonical(check: Topic, shapes: &Shapes, px: f64) -> Shapes {
    let mut all = shapes.clone();
    for (index, shape) in all.iter_mut().enumerate() {
        let is_second = check == Topic::Tiling && index % 2 == 1;
        let corners = [[px, 0.0], if is_second { [px, px] } else { [0.0, 0.0] }, [0.0, px]];
        for (vertex, corner) in shape.iter_mut().zip(corners) {
            vertex[..2].copy_from_slice(&corner);
        }
    }
    all
}

/// Gives each triangle of the depth test its number, from 1 on, as its first attribute: what a pixel shows.
fn number_in_order(shapes: &mut Shapes) {
    for (index, shape) in shapes.iter_mut().enumerate() {
        for vertex in shape {
            vertex[4] = (index + 1) as f64;
        }
    }
}

/// Each shape alone, each two, either half, and all but one.
fn fewer(shapes: &Shapes) -> Vec<Shapes> {
    let mut found: Vec<Shapes> = shapes.iter().map(|shape| vec![shape.clone()]).collect();
    for (j, second) in shapes.iter().enumerate() {
        for first in &shapes[..j] {
            found.push(vec![first.clone(), second.clone()]);
        }
    }
    // Without the only shape nothing would be left.
    if shapes.len() > 1 {
        let (first, second) = shapes.split_at(shapes.len() / 2);
        found.extend([first.to_vec(), second.to_vec()]);
        for i in 0..shapes.len() {
            found.push([&shapes[..i], &shapes[i + 1..]].concat());
        }
    }
    found
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
    let (mut low, mut high) = ([f64::INFINITY; 2], [0.0_f64; 2]);
    let (mut bits, mut sum) = (0, 0.0);
    for vertex in shapes.iter().flatten() {
        for axis in 0..2 {
            low[axis] = low[axis].min(vertex[axis]);
            high[axis] = high[axis].max(vertex[axis]);
        }
        for number in vertex {
            bits += bits_behind_point(*number);
            sum += number.abs();
        }
    }
    // Columns and rows count alike.
    let reach = |axis: usize| (high[axis] - low[axis]).ceil() as u32;
    (shapes.len(), reach(0) + reach(1), bits, sum)
}

/// How many bits behind the point a number needs; 53 where none are enough.
fn bits_behind_point(v: f64) -> u32 {
    (0..=52).find(|bits| (v * (1u64 << bits) as f64).fract() == 0.0).unwrap_or(53)
}

/// Whether a check could ask for these shapes, which were made of others.
fn is_valid(check: Topic, device: Device, before: &Shapes, shapes: &Shapes, cell: i32) -> bool {
    // Corners of a tiling lie anywhere; new ones on the finest lattice.
    let is_tiling = check == Topic::Tiling;
    let step = if is_tiling { 1.0 } else { f64::from(device.step()) } / f64::from(SUBPIXELS);
    let is_old = |v: f64| is_tiling && before.iter().flatten().any(|old| old[..2].contains(&v));
    let numbered =
        shapes.iter().zip(1..).flat_map(|(shape, number)| shape.iter().zip(repeat(number)));
    for (vertex, number) in numbered {
        let [x, y, depth, w, a, _] = *vertex;
        for v in [x, y] {
            let is_in_cell = (0.0..=f64::from(cell)).contains(&v);
            if !is_in_cell || (v / step).fract() != 0.0 && !is_old(v) {
                return false;
            }
        }
        // Within the planes, even when rounded.
        let is_deep = (1.0 / 64.0..=63.0 / 64.0).contains(&depth);
        let has_values = match check {
            Topic::Values => w > 0.0,
            // Their first attributes say which triangles they are.
            Topic::Depth => w == 1.0 && a == f64::from(number),
            _ => depth == 0.5 && w == 1.0 && a == 1.0,
        };
        if !is_deep || !has_values {
            return false;
        }
    }
    for shape in shapes {
        // A line of one point and a triangle without an area have no pixels that a rule decides.
        let has_extent = match check {
            Topic::Lines => shape[0][..2] != shape[1][..2],
            // A pile may need a number of triangles, whatever they are.
            Topic::Depth => true,
            _ => area(shape) != 0.0,
        };
        if !has_extent {
            return false;
        }
    }
    true
}
