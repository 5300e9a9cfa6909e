//! Families of hard polygons.
//!
//! Polygons are made of whole numbers, sheared, mirrored, scaled by a power of two and moved, all of it without
//! rounding; only then are single coordinates moved by an ulp. Every one is checked to be valid, and drawn again
//! otherwise.

use std::cmp::Ordering;

use super::region::region;
use super::{FillRule, Point, Polygon, edges_of};
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
                    for contour in &mut polygon.contours {
                        contour.reverse();
                    }
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
    let mut placed = contours;
    for contour in &mut placed {
        let start = rng.int(0, contour.len() as i64 - 1) as usize;
        contour.rotate_left(start);
        if is_mirrored != is_transposed {
            contour.reverse();
        }
        for point in contour {
            let [x, y] = *point;
            let x = x + shear * y;
            let x = if is_mirrored { -x } else { x };
            let [x, y] = if is_transposed { [y, x] } else { [x, y] };
            *point =
                [x + offset[0], y + offset[1]].map_array(|value| coordinates.round(value * unit));
        }
    }
    Polygon { contours: placed }
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
    // Few come out of order, so that each is moved down to its place.
    for i in 1..all.len() {
        let mut at = i;
        while at > 0 && by_angle(all[at], all[at - 1]).is_lt() {
            all.swap(at - 1, at);
            at -= 1;
        }
    }
    all.dedup_by(|a, b| by_angle(*a, *b).is_eq());
    all
}

/// Compares directions counterclockwise, from that of x on.
fn by_angle(a: [i64; 2], b: [i64; 2]) -> Ordering {
    let is_second_half = |[x, y]: [i64; 2]| y < 0 || (y == 0 && x < 0);
    let halves = is_second_half(a).cmp(&is_second_half(b));
    halves.then(0.cmp(&(a[0] * b[1] - a[1] * b[0])))
}

pub(super) fn star(rng: &mut Rng) -> Contour {
    let most = rng.int(1, 6);
    let mut contour = Vec::new();
    for (i, direction) in directions(rng, most).into_iter().enumerate() {
        let length = if i % 2 == 0 { rng.int(1, 3) } else { rng.int(8, 60) };
        contour.push(scaled(direction, length));
    }
    contour
}

/// A whole vector that is so many times as long.
fn scaled([x, y]: [i64; 2], by: i64) -> Point {
    [(x * by) as f64, (y * by) as f64]
}

fn comb(rng: &mut Rng) -> Contour {
    let mut x = 0;
    // From the left; a contour has its upper side from the right.
    let mut teeth = Vec::new();
    for _ in 0..rng.int(2, 9) {
        let (left, width) = (x, rng.int(1, 3));
        let height = if rng.chance(3) { 40 } else { rng.int(1, 400) };
        x = left + width + rng.int(1, 2);
        let right = left + width;
        let mut tooth = vec![[right, 0]];
        match rng.chance(2) {
            true => tooth.push([left + rng.int(-2, 4), height]),
            false => tooth.extend([[right, height], [left, height]]),
        }
        tooth.push([left, 0]);
        teeth.push(tooth);
    }
    let mut contour = vec![[0, -rng.int(1, 30)], [x, -rng.int(1, 30)]];
    for tooth in teeth.into_iter().rev() {
        contour.extend(tooth);
    }
    contour.into_iter().map(|point| scaled(point, 1)).collect()
}

/// An arm along the directions in turn, whose two sides both move outwards.
fn spiral(rng: &mut Rng) -> Contour {
    let directions = directions(rng, 2);
    let (count, grows) = (directions.len() as i64, rng.int(1, 8));
    let width = rng.int(1, (count * grows - 1).clamp(1, 40));
    let steps = rng.int(2, 30);
    // Out along the one side, and back along the other.
    let (mut contour, mut back) = (Vec::new(), Vec::new());
    for step in 0..steps {
        let direction = directions[(step % count) as usize];
        let radius = 45 + step * grows;
        contour.push(scaled(direction, radius));
        back.push(scaled(direction, radius - width));
    }
    contour.extend(back.into_iter().rev());
    contour
}

/// The outline of connected squares of a grid, whose holes touch it and each other at corners.
fn cells(rng: &mut Rng) -> Vec<Contour> {
    let squares = Squares::connected(rng);
    // Where four edges meet, either turn gives valid contours.
    let (turns_left, keeps_straight) = (rng.chance(2), rng.chance(2));
    let step = rng.int(1, 40);
    let mut edges = squares.free_edges();
    let mut contours: Vec<Contour> = Vec::new();
    while let Some(start) = edges.pop() {
        let ring = contour_from(start, &mut edges, turns_left);
        let count = ring.len();
        let mut contour = Vec::new();
        for (i, here) in ring.iter().enumerate() {
            let before = ring[(i + count - 1) % count];
            if keeps_straight || turn(before, *here) != 0 {
                contour.push(scaled(here[0], step));
            }
        }
        contours.push(contour);
    }
    // The outline is the only one with a positive area.
    contours.sort_by(|a, b| area(b).total_cmp(&area(a)));
    contours
}

/// A directed edge between points of a grid.
type GridEdge = [[i64; 2]; 2];

/// Positive where the second edge, which begins where the first one ends, turns left.
fn turn([from, at]: GridEdge, [_, to]: GridEdge) -> i64 {
    (at[0] - from[0]) * (to[1] - at[1]) - (at[1] - from[1]) * (to[0] - at[0])
}

/// The edges from one on until it is reached again. They are taken out of the list, and where several go on, the one that turns most to
/// one side is taken.
fn contour_from(start: GridEdge, edges: &mut Vec<GridEdge>, turns_left: bool) -> Vec<GridEdge> {
    let sign = if turns_left { 1 } else { -1 };
    let mut contour = vec![start];
    loop {
        let last = contour[contour.len() - 1];
        let mut best = None;
        for (number, edge) in edges.iter().enumerate() {
            if edge[0] == last[1] {
                let side = sign * turn(last, *edge);
                // Of equal ones, the last.
                if best.is_none_or(|(most, _)| side >= most) {
                    best = Some((side, number));
                }
            }
        }
        let Some((side, number)) = best else { return contour };
        // The first edge is another choice where the contour comes back to its start.
        if start[0] == last[1] && side <= sign * turn(last, start) {
            return contour;
        }
        contour.push(edges.swap_remove(number));
    }
}

/// Squares of a grid, of which some are kept.
struct Squares {
    width: i64,
    height: i64,
    kept: Vec<bool>,
}

impl Squares {
    /// Some squares, of which those are kept that are connected to the first one along their sides.
    fn connected(rng: &mut Rng) -> Self {
        let (width, height) = (rng.int(2, 7), rng.int(2, 7));
        let mut drawn = Vec::new();
        for _ in 0..width * height {
            drawn.push(!rng.chance(3));
        }
        drawn[0] = true;
        // From the first square on, over all that share a side.
        let mut squares = Self { width, height, kept: vec![false; drawn.len()] };
        let mut open = vec![[0, 0]];
        while let Some([x, y]) = open.pop() {
            match squares.number(x, y) {
                Some(cell) if drawn[cell] && !squares.kept[cell] => {
                    squares.kept[cell] = true;
                    open.extend([[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]]);
                }
                _ => {}
            }
        }
        squares
    }

    fn number(&self, x: i64, y: i64) -> Option<usize> {
        let is_inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        is_inside.then(|| (y * self.width + x) as usize)
    }

    fn is_kept(&self, [x, y]: [i64; 2]) -> bool {
        self.number(x, y).is_some_and(|cell| self.kept[cell])
    }

    /// Edges beyond which no square is kept, with their square on the left.
    fn free_edges(&self) -> Vec<GridEdge> {
        let mut edges = Vec::new();
        for y in 0..self.height {
            for x in 0..self.width {
                // The corners of the square counterclockwise, and the square beyond each side.
                let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
                let beyond = [[x, y - 1], [x + 1, y], [x, y + 1], [x - 1, y]];
                for side in 0..4 {
                    if self.is_kept([x, y]) && !self.is_kept(beyond[side]) {
                        edges.push([corners[side], corners[(side + 1) % 4]]);
                    }
                }
            }
        }
        edges
    }
}

/// Twice the area, exact for small whole numbers.
pub(super) fn area(contour: &[Point]) -> f64 {
    let mut area = 0.0;
    for [a, b] in edges_of(contour) {
        area += a[0] * b[1] - a[1] * b[0];
    }
    area
}

fn islands(rng: &mut Rng) -> Vec<Contour> {
    let outline = if rng.chance(3) { circle_of(rng.int(1, 6), 300.0) } else { star(rng) };
    let depth = rng.int(2, 6);
    let mut contours = Vec::new();
    for inward in 0..depth {
        let scale = (depth - inward) as f64;
        let mut contour: Contour =
            outline.iter().map(|point| point.map_array(|v| v * scale)).collect();
        // Every second one is a hole.
        if inward % 2 == 1 {
            contour.reverse();
        }
        contours.push(contour);
    }
    contours
}

/// The points of the contours at twelfths of their edges, so that points on them are whole.
fn in_twelfths(mut contours: Vec<Contour>) -> Vec<Contour> {
    for v in contours.iter_mut().flatten().flatten() {
        *v *= 12.0;
    }
    contours
}

fn between(a: Point, b: Point, twelfths: i64) -> Point {
    let part = twelfths as f64;
    [0, 1].map_array(|axis| a[axis] + (b[axis] - a[axis]) / 12.0 * part)
}

fn collinear(rng: &mut Rng) -> Vec<Contour> {
    let mut contours = in_twelfths(base(rng));
    for contour in &mut contours {
        let mut cut = Vec::new();
        for [a, b] in edges_of(contour) {
            cut.push(a);
            let mut at = Vec::new();
            for _ in 0..rng.int(0, 3) {
                at.push(rng.int(1, 11));
            }
            // Places along the edge, in order, each once.
            at.sort_unstable();
            at.dedup();
            for part in at {
                cut.push(between(a, b, part));
            }
        }
        *contour = cut;
    }
    contours
}

fn duplicates(rng: &mut Rng) -> Vec<Contour> {
    let mut contours = base(rng);
    for contour in &mut contours {
        let mut repeated = Vec::new();
        for point in contour.iter() {
            let times = if rng.chance(3) { rng.int(2, 3) } else { 1 };
            for _ in 0..times {
                repeated.push(*point);
            }
        }
        *contour = repeated;
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
    let mut points = Vec::new();
    for i in 0..4 * quarter {
        let t = (i % quarter) as f64 / quarter as f64;
        let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t) * radius, 2.0 * t / (1.0 + t * t) * radius);
        // The other quarters are this one, turned.
        points.push([[cos, sin], [-sin, cos], [-cos, -sin], [sin, -cos]][(i / quarter) as usize]);
    }
    points
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
