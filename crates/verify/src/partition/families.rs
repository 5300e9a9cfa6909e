//! Families of hard polygons.
//!
//! Polygons are made of whole numbers, sheared, mirrored, scaled by a power of two and moved, all of it without
//! rounding; only then are single coordinates moved by an ulp. Every one is checked to be valid, and drawn again
//! otherwise.

use super::region::region;
use super::{FillRule, Point, Polygon};
use crate::cases::unsnapped::{nudge_f32, nudge_f64};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::random::Rng;

/// Which numbers a tessellator takes as coordinates, so that it is judged by what it was given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Coordinates {
    /// Any `f64`.
    #[default]
    F64,
    /// Numbers that are exactly `f32`.
    F32,
    /// Whole numbers from -2^20 to 2^20.
    Integer,
}

/// The largest coordinate of [`Coordinates::Integer`].
const LARGEST: f64 = (1 << 20) as f64;

impl Coordinates {
    /// The nearest number of this kind.
    pub(super) fn round(self, value: f64) -> f64 {
        match self {
            Self::F64 => value,
            Self::F32 => f64::from(value as f32),
            Self::Integer => value.round_ties_even().clamp(-LARGEST, LARGEST),
        }
    }

    /// The next larger or smaller number of this kind.
    fn neighbour(self, value: f64, is_up: bool) -> f64 {
        let step = if is_up { 1 } else { -1 };
        match self {
            Self::F64 => nudge_f64(value, step),
            Self::F32 => nudge_f32(value, step),
            Self::Integer => value + step as f64,
        }
    }

    /// Bits of a number of this kind.
    fn bits(self) -> i64 {
        match self {
            Self::F64 => 53,
            Self::F32 => 24,
            Self::Integer => 20,
        }
    }
}

rasterproof_core::named! {
    /// A way to make polygons that share a danger. The first contour is the outer one, in three of four polygons
    /// counterclockwise where y points up, otherwise clockwise. Every other one is a hole in it, and runs the other way; only
    /// [`Family::Islands`] has polygons in holes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum Family {
        /// Many vertices on straight edges.
        Collinear = "Collinear",
        /// Vertices that are repeated.
        Duplicates = "Duplicates",
        /// Edges that go out and come back the same way.
        Spikes = "Spikes",
        /// Squares of a grid: holes and the outline touch at vertices.
        Touching = "Touching",
        /// Contours inside contours, up to six deep.
        Islands = "Islands",
        /// Vertices that are one ulp away from an edge, or touch it.
        NearlyTouching = "NearlyTouching",
        /// Long and short arms in turn.
        Star = "Star",
        /// Thin teeth on a bar.
        Comb = "Comb",
        /// An arm that winds around its start.
        Spiral = "Spiral",
        /// Circles and rings whose points are rounded, coarsely or to the last bit.
        SnappedCircle = "SnappedCircle",
        /// Polygons of the other families, every coordinate moved by an ulp at most.
        Neighbours = "Neighbours",
        /// Every two facts of a polygon together, as a covering design chooses them; at most 32 vertices.
        Design = "Design",
    }
}

impl Family {
    /// The families whose polygons are drawn, each without the others.
    pub(super) const DRAWN: [Self; Self::ALL.len() - 1] = {
        let mut drawn = [Self::Collinear; Self::ALL.len() - 1];
        let mut at = 0;
        while at < drawn.len() {
            drawn[at] = Self::ALL[at];
            at += 1;
        }
        drawn
    };

    /// The polygon number `index` under `seed` of a family whose polygons are drawn.
    pub(super) fn drawn(self, seed: u64, index: u64, coordinates: Coordinates) -> Polygon {
        let mut rng = Rng::new(self.name(), seed, index);
        for _ in 0..100 {
            let mut polygon = self.draw(&mut rng, coordinates);
            if is_as_generated(&polygon, self) {
                // Drawn last: the shape of a polygon does not depend on it.
                if rng.chance(4) {
                    polygon.contours.iter_mut().for_each(|contour| contour.reverse());
                }
                return polygon;
            }
        }
        // No family is known to come here; a triangle is a valid polygon of every kind.
        Polygon::new(vec![vec![[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]]])
    }

    /// A polygon that may not be valid; of the design one of no family.
    pub(super) fn draw(self, rng: &mut Rng, coordinates: Coordinates) -> Polygon {
        let contours = match self {
            Self::Collinear => collinear(rng),
            Self::Duplicates => duplicates(rng),
            Self::Spikes => spikes(rng),
            Self::Touching => cells(rng),
            Self::Islands => islands(rng),
            Self::NearlyTouching => return nearly_touching(rng, coordinates),
            Self::Star => vec![star(rng)],
            Self::Comb => vec![comb(rng)],
            Self::Spiral => vec![spiral(rng)],
            Self::SnappedCircle => circle(rng, coordinates),
            Self::Neighbours | Self::Design => base(rng),
        };
        let mut polygon = placed(contours, rng, coordinates);
        if self == Self::Neighbours {
            nudge(&mut polygon, rng, coordinates, 2);
        }
        polygon
    }
}

/// Whether contours are as [`Family`] states: outlines and holes by their directions, around some area.
pub(super) fn is_as_generated(polygon: &Polygon, family: Family) -> bool {
    let holes = polygon.contours.get(1..).unwrap_or(&[]);
    let turn = match region(polygon, FillRule::EvenOdd).map(|region| region.rounds) {
        Ok([0, 1]) => 1.0,
        Ok([-1, 0]) => -1.0,
        _ => return false,
    };
    family == Family::Islands || holes.iter().all(|hole| turn * area(hole) <= 0.0)
}

type Contour = Vec<Point>;

fn whole(rng: &mut Rng, low: i64, high: i64) -> f64 {
    rng.int(low, high) as f64
}

/// A polygon of one of the plain families.
fn base(rng: &mut Rng) -> Vec<Contour> {
    match rng.int(0, 3) {
        0 => vec![star(rng)],
        1 => vec![comb(rng)],
        2 => vec![spiral(rng)],
        _ => cells(rng),
    }
}

/// Moves one coordinate in so many to a neighbouring number.
fn nudge(polygon: &mut Polygon, rng: &mut Rng, coordinates: Coordinates, one_in: i64) {
    for value in polygon.contours.iter_mut().flatten().flatten() {
        if rng.chance(one_in) {
            *value = coordinates.neighbour(*value, rng.chance(2));
        }
    }
}

/// The contours sheared, mirrored, scaled and moved, each begun at another vertex.
fn placed(contours: Vec<Contour>, rng: &mut Rng, coordinates: Coordinates) -> Polygon {
    let shear = if rng.chance(3) { 0.0 } else { whole(rng, -3, 3) };
    let (is_mirrored, is_transposed) = (rng.chance(2), rng.chance(2));
    // Offsets count in units of the polygon, whose numbers are below 2^16; the largest leaves no bit unused.
    let most = 1_i64 << (coordinates.bits() - 2).min(50);
    let far = 1_i64 << 16.min(coordinates.bits() - 2);
    let reach = [0, far, most][rng.int(0, 2) as usize];
    let offset = [whole(rng, -reach, reach), whole(rng, -reach, reach)];
    let exponent = match coordinates {
        Coordinates::Integer => 0,
        Coordinates::F32 => rng.int(-12, 4),
        Coordinates::F64 if rng.chance(8) => rng.int(-200, 100),
        Coordinates::F64 => rng.int(-20, 4),
    };
    let unit = 2_f64.powi(exponent as i32);
    let contours = contours.into_iter().map(|mut contour| {
        let start = rng.int(0, contour.len() as i64 - 1) as usize;
        contour.rotate_left(start);
        if is_mirrored != is_transposed {
            contour.reverse();
        }
        let place = |[x, y]: Point| {
            let x = x + shear * y;
            let x = if is_mirrored { -x } else { x };
            let [x, y] = if is_transposed { [y, x] } else { [x, y] };
            [x + offset[0], y + offset[1]].map_array(|value| coordinates.round(value * unit))
        };
        contour.into_iter().map(place).collect()
    });
    Polygon { contours: contours.collect() }
}

/// Directions in counterclockwise order, at least one in each quadrant.
fn directions(rng: &mut Rng, most: i64) -> Vec<[i64; 2]> {
    let mut all: Vec<[i64; 2]> = Vec::new();
    for (count, [sx, sy]) in [[1, 1], [-1, 1], [-1, -1], [1, -1]].into_iter().enumerate() {
        for _ in 0..rng.int(1, most) {
            let (along, across) = (rng.int(1, 12), rng.int(0, 12));
            // Rotated by a quarter turn each time, so that a quadrant has its first axis and not its second.
            let [x, y] = if count % 2 == 0 { [along, across] } else { [across, along] };
            all.push([sx * x, sy * y]);
        }
    }
    let half = |[x, y]: [i64; 2]| y < 0 || (y == 0 && x < 0);
    all.sort_by(|&a, &b| half(a).cmp(&half(b)).then_with(|| 0.cmp(&(a[0] * b[1] - a[1] * b[0]))));
    all.dedup_by(|a, b| half(*a) == half(*b) && a[0] * b[1] == a[1] * b[0]);
    all
}

pub(super) fn star(rng: &mut Rng) -> Contour {
    let most = rng.int(1, 6);
    let arms = directions(rng, most).into_iter().enumerate();
    let contour = arms.map(|(i, [x, y])| {
        let length = if i % 2 == 0 { rng.int(1, 3) } else { rng.int(8, 60) };
        [(length * x) as f64, (length * y) as f64]
    });
    contour.collect()
}

fn comb(rng: &mut Rng) -> Contour {
    let mut x = 0;
    let mut teeth = Vec::new();
    for _ in 0..rng.int(2, 9) {
        let (left, width) = (x, rng.int(1, 3));
        let height = if rng.chance(3) { 40 } else { rng.int(1, 400) };
        x = left + width + rng.int(1, 2);
        let is_sharp = rng.chance(2);
        let top = if is_sharp { vec![left + rng.int(-2, 4)] } else { vec![left + width, left] };
        teeth.push([left + width].map(|x| [x, 0]).to_vec());
        teeth.push(top.into_iter().map(|x| [x, height]).collect());
        teeth.push(vec![[left, 0]]);
    }
    let mut contour = vec![[0, -rng.int(1, 30)], [x, -rng.int(1, 30)]];
    let tooth_from_the_right = teeth.chunks(3).rev().flatten().flatten();
    contour.extend(tooth_from_the_right);
    contour.into_iter().map(|[x, y]| [x as f64, y as f64]).collect()
}

/// An arm along the directions in turn, whose two sides both move outwards.
fn spiral(rng: &mut Rng) -> Contour {
    let directions = directions(rng, 2);
    let (count, grows) = (directions.len() as i64, rng.int(1, 8));
    let width = rng.int(1, (count * grows - 1).clamp(1, 40));
    let side = |step: i64, reach: i64| {
        let [x, y] = directions[(step % count) as usize];
        [(x * reach) as f64, (y * reach) as f64]
    };
    let steps = rng.int(2, 30);
    let radius = |step: i64| 45 + step * grows;
    let outer = (0..steps).map(|step| side(step, radius(step)));
    let inner = (0..steps).rev().map(|step| side(step, radius(step) - width));
    outer.chain(inner).collect()
}

/// The outline of connected squares of a grid, whose holes touch it and each other at corners.
fn cells(rng: &mut Rng) -> Vec<Contour> {
    let (width, height) = (rng.int(2, 7), rng.int(2, 7));
    let mut drawn: Vec<bool> = (0..width * height).map(|_| !rng.chance(3)).collect();
    drawn[0] = true;
    let at = |x: i64, y: i64| -> Option<usize> {
        let is_inside = (0..width).contains(&x) && (0..height).contains(&y);
        is_inside.then(|| (y * width + x) as usize)
    };
    // Those that are connected to the first one along their sides.
    let mut kept = vec![false; drawn.len()];
    let mut open = vec![[0, 0]];
    while let Some([x, y]) = open.pop() {
        if let Some(cell) = at(x, y).filter(|&cell| drawn[cell] && !kept[cell]) {
            kept[cell] = true;
            open.extend([[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]]);
        }
    }
    let is_kept = |x: i64, y: i64| at(x, y).is_some_and(|cell| kept[cell]);
    // Edges with their square on the left.
    let mut edges: Vec<[[i64; 2]; 2]> = Vec::new();
    for y in 0..height {
        for x in (0..width).filter(|&x| is_kept(x, y)) {
            let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
            let beyond = [[x, y - 1], [x + 1, y], [x, y + 1], [x - 1, y]];
            let free = (0..4).filter(|&side| !is_kept(beyond[side][0], beyond[side][1]));
            edges.extend(free.map(|side| [corners[side], corners[(side + 1) % 4]]));
        }
    }
    // Where four edges meet, either turn gives valid contours.
    let (turns_left, keeps_straight) = (rng.chance(2), rng.chance(2));
    let step = rng.int(1, 40);
    let mut contours = Vec::new();
    while let Some(start) = edges.pop() {
        let mut contour = vec![start];
        loop {
            let [from, at] = contour[contour.len() - 1];
            let turn = |to: [i64; 2]| {
                (at[0] - from[0]) * (to[1] - at[1]) - (at[1] - from[1]) * (to[0] - at[0])
            };
            let next = edges.iter().enumerate().filter(|(_, edge)| edge[0] == at);
            let best = next
                .max_by_key(|(_, edge)| if turns_left { turn(edge[1]) } else { -turn(edge[1]) });
            // The first edge is another choice where the contour comes back to its start.
            let closes = start[0] == at;
            let Some((number, edge)) = best.map(|(number, &edge)| (number, edge)) else { break };
            let is_better =
                |one: i64, other: i64| if turns_left { one > other } else { one < other };
            if closes && !is_better(turn(edge[1]), turn(start[1])) {
                break;
            }
            edges.swap_remove(number);
            contour.push(edge);
        }
        let count = contour.len();
        let is_corner = |i: usize| {
            let ([a, b], [_, c]) = (contour[(i + count - 1) % count], contour[i]);
            (b[0] - a[0]) * (c[1] - b[1]) != (b[1] - a[1]) * (c[0] - b[0])
        };
        let points = (0..count).filter(|&i| keeps_straight || is_corner(i)).map(|i| contour[i][0]);
        contours.push(points.map(|[x, y]| [(x * step) as f64, (y * step) as f64]).collect());
    }
    // The outline is the only one with a positive area.
    contours.sort_by(|a: &Contour, b| area(b).total_cmp(&area(a)));
    contours
}

/// Twice the area, exact for small whole numbers.
pub(super) fn area(contour: &[Point]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn islands(rng: &mut Rng) -> Vec<Contour> {
    let outline = if rng.chance(3) { circle_of(rng.int(1, 6), 300.0) } else { star(rng) };
    let depth = rng.int(2, 6);
    let ring = |inward: i64| {
        let scale = (depth - inward) as f64;
        let mut contour: Contour =
            outline.iter().map(|point| point.map_array(|v| v * scale)).collect();
        if inward % 2 == 1 {
            contour.reverse();
        }
        contour
    };
    (0..depth).map(ring).collect()
}

/// The points of the contours at twelfths of their edges, so that points on them are whole.
fn in_twelfths(contours: Vec<Contour>) -> Vec<Contour> {
    let scaled =
        |contour: Contour| contour.into_iter().map(|point| point.map_array(|v| v * 12.0)).collect();
    contours.into_iter().map(scaled).collect()
}

fn between(a: Point, b: Point, twelfths: i64) -> Point {
    let part = twelfths as f64;
    [0, 1].map_array(|axis| a[axis] + (b[axis] - a[axis]) / 12.0 * part)
}

fn collinear(rng: &mut Rng) -> Vec<Contour> {
    let mut contours = in_twelfths(base(rng));
    for contour in &mut contours {
        let next: Vec<Point> =
            contour.iter().copied().cycle().skip(1).take(contour.len()).collect();
        let mut cut = Vec::new();
        for (&a, b) in contour.iter().zip(next) {
            cut.push(a);
            let mut at: Vec<i64> = (0..rng.int(0, 3)).map(|_| rng.int(1, 11)).collect();
            at.sort_unstable();
            at.dedup();
            cut.extend(at.into_iter().map(|part| between(a, b, part)));
        }
        *contour = cut;
    }
    contours
}

fn duplicates(rng: &mut Rng) -> Vec<Contour> {
    let mut contours = base(rng);
    for contour in &mut contours {
        let repeated = contour.iter().flat_map(|&point| {
            let times = if rng.chance(3) { rng.int(2, 3) } else { 1 };
            std::iter::repeat_n(point, times as usize)
        });
        *contour = repeated.collect();
    }
    contours
}

fn spikes(rng: &mut Rng) -> Vec<Contour> {
    let mut contours = in_twelfths(base(rng));
    for _ in 0..rng.int(1, 3) {
        let number = rng.int(0, contours.len() as i64 - 1) as usize;
        let contour = &mut contours[number];
        let at = rng.int(0, contour.len() as i64 - 1) as usize;
        let (here, next) = (contour[at], contour[(at + 1) % contour.len()]);
        let other = contour[rng.int(0, contour.len() as i64 - 1) as usize];
        // Along the next edge, beyond its start, or somewhere else.
        let tip = match rng.int(0, 2) {
            0 => between(here, next, rng.int(1, 11)),
            1 => between(here, next, -rng.int(1, 6)),
            _ => between(here, other, rng.int(1, 6)).map_array(|v| v + whole(rng, -2, 2)),
        };
        contour.splice(at..=at, [here, tip, here]);
    }
    contours
}

/// A box with notches, and boxes in it as holes: sides that would touch are moved by an ulp, or not at all.
fn nearly_touching(rng: &mut Rng, coordinates: Coordinates) -> Polygon {
    let (width, height) = (12.0 * whole(rng, 2, 9), 12.0 * whole(rng, 2, 9));
    let mut outline = vec![[0.0, 0.0], [width, 0.0], [width, height]];
    let x = width / 12.0 * whole(rng, 4, 8);
    let has_notch = rng.chance(2);
    if has_notch {
        // Down to the lower side.
        outline.extend([
            [x + whole(rng, 1, 12), height],
            [x, 0.0],
            [x - whole(rng, 1, 12), height],
        ]);
    }
    outline.push([0.0, height]);
    let mut contours = vec![outline];
    let holes = if has_notch { 0 } else { rng.int(1, 3) };
    for number in 0..holes {
        // Side by side, from the one edge to the other.
        let [left, right] =
            [number, number + 1].map_array(|n| width / 12.0 * (n * 12 / holes) as f64);
        let (low, high) = (0.0, if rng.chance(2) { height } else { height / 2.0 });
        let middle = height / 12.0 * whole(rng, 1, 5);
        contours.push(if rng.chance(2) {
            vec![[left, low], [left, high], [right, high], [right, low]]
        } else {
            vec![[left, middle], [left + 1.0, middle + 1.0], [right, middle]]
        });
    }
    let mut polygon = placed(contours, rng, coordinates);
    let one_in = rng.int(2, 4);
    nudge(&mut polygon, rng, coordinates, one_in);
    polygon
}

/// A circle of four times so many points, by the rational parametrisation of a quarter.
fn circle_of(quarter: i64, radius: f64) -> Contour {
    let points = (0..4 * quarter).map(|i| {
        let t = (i % quarter) as f64 / quarter as f64;
        let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t) * radius, 2.0 * t / (1.0 + t * t) * radius);
        [[cos, sin], [-sin, cos], [-cos, -sin], [sin, -cos]][(i / quarter) as usize]
    });
    points.collect()
}

fn circle(rng: &mut Rng, coordinates: Coordinates) -> Vec<Contour> {
    // To the last bit, or to a grid on which points coincide and lie on lines.
    let radius = if coordinates == Coordinates::Integer { 3000.0 } else { 100.0 + rng.unit() };
    let grid = if rng.chance(2) { 0.0 } else { (radius / whole(rng, 2, 40)).floor() };
    let snap = |v: f64| if grid > 0.0 { (v / grid).round_ties_even() * grid } else { v };
    let ring = |quarter: i64, radius: f64| -> Contour {
        circle_of(quarter, radius).into_iter().map(|point| point.map_array(snap)).collect()
    };
    let mut contours = vec![ring(rng.int(1, 12), radius)];
    if rng.chance(2) {
        let mut inner = ring(rng.int(1, 12), radius * (0.3 + 0.6 * rng.unit()));
        inner.reverse();
        contours.push(inner);
    }
    contours
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// What each family is named for occurs in it, and hardly any polygon is replaced by a plain triangle.
    #[test]
    fn families_hold_their_danger() {
        for coordinates in [Coordinates::F64, Coordinates::F32, Coordinates::Integer] {
            for family in Family::ALL {
                let all: Vec<Polygon> =
                    (0..200).map(|index| family.polygon(1, index, coordinates)).collect();
                let values =
                    all.iter().flat_map(|polygon| polygon.contours.iter().flatten().flatten());
                assert!(values.clone().all(|&v| coordinates.round(v) == v), "{family:?}");
                let plain = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
                assert!(all.iter().all(|p| p.contours[0] != plain), "{family:?} {coordinates:?}");
                let different: BTreeSet<String> = all.iter().map(|p| format!("{p:?}")).collect();
                assert!(different.len() > 150, "{family:?} {coordinates:?}: {}", different.len());
            }
        }
    }

    #[test]
    fn outlines_come_first_and_holes_turn_the_other_way() {
        let mut clockwise = 0;
        for family in [Family::Touching, Family::Star, Family::Comb, Family::Spiral] {
            for index in 0..300 {
                let polygon = family.polygon(2, index, Coordinates::Integer);
                let mut areas = polygon.contours.iter().map(|contour| area(contour));
                let outline = areas.next().unwrap();
                assert!(outline != 0.0, "{family:?} {index}");
                assert!(areas.all(|area| area * outline < 0.0), "{family:?} {index}");
                clockwise += u32::from(outline < 0.0);
            }
        }
        assert!((240..360).contains(&clockwise), "{clockwise} of 1200");
    }
}
