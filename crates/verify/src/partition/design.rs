//! Facts of a polygon, and polygons beside others: what a covering design chooses from.

use std::cmp::Ordering;
use std::ops::Range;

use super::exact::orientation;
use super::families::{Family, area, is_as_generated};
use super::{Coordinates, Point, Polygon, ends_of};
use crate::cases::facts::asked::DesignShare;
use crate::cases::facts::design::Blocks;
use crate::cases::facts::{Read, Test, Topic, Unit, exponent, fact, facts_of, numbers};
use rasterproof_core::random::Rng;

/// Polygons.
#[doc(hidden)]
pub const TOPIC: Topic<Polygon, Coordinates> = Topic {
    name: "Design",
    facts: &facts_of(&FACTS),
    measure: |polygon, _| Some(numbers(&FACTS, &PolygonFacts::of(polygon)?)),
    impossible: include_str!("../cases/facts/impossible/Design.txt"),
    draw,
    vary,
    put,
};

static POLYGONS: Blocks<Polygon, Coordinates> = Blocks::none();

/// A polygon of the design.
#[doc(hidden)]
#[must_use]
pub fn polygon(seed: u64, index: u64, coordinates: Coordinates) -> Polygon {
    POLYGONS.question(&TOPIC, seed, index, &coordinates)
}

impl Family {
    /// The polygon number `index` of this family under `seed`.
    #[must_use]
    pub fn polygon(self, seed: u64, index: u64, coordinates: Coordinates) -> Polygon {
        match self {
            Self::Design => polygon(seed, index, coordinates),
            drawn => drawn.drawn(seed, index, coordinates),
        }
    }
}

/// What so many polygons of the design ask.
#[doc(hidden)]
#[must_use]
pub fn asked(seed: u64, numbers: Range<u64>, coordinates: Coordinates) -> DesignShare {
    DesignShare::of(&TOPIC, numbers, &coordinates, &|index| polygon(seed, index, coordinates))
}

/// The most vertices: a small polygon reads easily, and is decided fast.
const MOST: usize = 32;
const COUNT: Test = Test::Steps(&[1, 2]);
const SIGNS: Test =
    Test::Choice(&["below 0 alone", "above 0 alone", "on both sides of 0", "0 and one side of it"]);
const AT_ONE: Test = Test::Steps(&[2, 3]);

/// The facts that the design covers.
const FACTS: [Read<PolygonFacts>; 19] = [
    fact("contours", Unit::Count, |m| m.contours, Test::Steps(&[2, 3])),
    fact("vertices", Unit::Count, |m| m.vertices, Test::Steps(&[4, 5, 9, 17])),
    fact("vertices of the smallest contour", Unit::Count, |m| m.least, Test::Steps(&[3, 4, 5])),
    fact("the direction of the outline", Unit::Count, |m| m.turn, TURN),
    fact("vertices on straight edges", Unit::Count, |m| m.straight, COUNT),
    fact("vertices where an edge comes back the same way", Unit::Count, |m| m.spikes, COUNT),
    fact("vertices that repeat the one before", Unit::Count, |m| m.repeated, COUNT),
    fact("vertices at the place of another, not next to it", Unit::Count, |m| m.met, COUNT),
    fact("vertices where a contour turns against itself", Unit::Count, |m| m.reflex, COUNT),
    fact("level edges", Unit::Count, |m| m.level, COUNT),
    fact("upright edges", Unit::Count, |m| m.upright, COUNT),
    fact("vertices at the least height", Unit::Count, |m| m.lowest, AT_ONE),
    fact("the most vertices at one height", Unit::Count, |m| m.at_one_height, AT_ONE),
    fact("the longer side of its box", Unit::Doublings, |m| m.size, Test::Steps(&[0, 8])),
    fact(
        "the width of its box, as a multiple of its height,",
        Unit::Doublings,
        |m| m.ratio,
        Test::Steps(&[-4, 4]),
    ),
    fact(
        "its distance from 0, as a multiple of the longer side,",
        Unit::Doublings,
        |m| m.away,
        Test::Steps(&[1, 8]),
    ),
    fact("bits of a coordinate", Unit::Count, |m| m.bits, Test::Steps(&[17, 25])),
    fact("its columns", Unit::Count, |m| m.signs[0], SIGNS),
    fact("its rows", Unit::Count, |m| m.signs[1], SIGNS),
];
const TURN: Test = Test::Choice(&["counterclockwise", "clockwise"]);

/// What was measured of a polygon.
struct PolygonFacts {
    contours: i64,
    vertices: i64,
    /// Vertices of the contour with the fewest.
    least: i64,
    /// 0 where the outline runs counterclockwise with y up, 1 the other way round.
    turn: i64,
    straight: i64,
    spikes: i64,
    repeated: i64,
    met: i64,
    reflex: i64,
    level: i64,
    upright: i64,
    lowest: i64,
    at_one_height: i64,
    /// The logarithm of the longer side of its box, and of width over height.
    size: i64,
    ratio: i64,
    /// The logarithm of the largest coordinate over the longer side.
    away: i64,
    /// The most bits from the first to the last that is set in a coordinate.
    bits: i64,
    signs: [i64; 2],
}

impl PolygonFacts {
    /// Of a polygon that is valid, with an outline and holes around some area.
    fn of(polygon: &Polygon) -> Option<Self> {
        let contours = &polygon.contours;
        let mut points: Vec<Point> = contours.iter().flatten().copied().collect();
        if points.len() > MOST || !is_as_generated(polygon, Family::Design) {
            return None;
        }
        points.sort_unstable_by(super::order);
        let outline = area(contours.first()?);
        let sides = [side(&points, 0), side(&points, 1)];
        let size = sides[0].max(sides[1]);
        // The largest coordinate, and the most bits of one.
        let (mut largest, mut most_bits) = (0.0_f64, 0);
        for v in points.iter().flatten() {
            (largest, most_bits) = (largest.max(v.abs()), most_bits.max(bits(*v)));
        }
        // Vertices are in order, so that those at one place come together.
        let mut met = 0;
        for pair in points.windows(2) {
            met += i64::from(pair[0] == pair[1]);
        }
        let heights = runs(points.iter().map(|p| p[1]).collect());
        let logarithm = |v: f64| i64::from(exponent(v));
        let mut measured = Self {
            contours: contours.len() as i64,
            vertices: points.len() as i64,
            least: contours.iter().map(Vec::len).min()? as i64,
            turn: i64::from(outline < 0.0),
            straight: 0,
            spikes: 0,
            repeated: 0,
            met,
            reflex: 0,
            level: 0,
            upright: 0,
            lowest: *heights.first()?,
            at_one_height: *heights.iter().max()?,
            size: logarithm(size),
            ratio: logarithm(sides[0] / sides[1]),
            away: logarithm(largest / size),
            bits: most_bits,
            signs: [signs(&points, 0), signs(&points, 1)],
        };
        for contour in contours {
            measured.walk(contour);
        }
        // What repeats the vertex before is at its place, too.
        measured.met -= measured.repeated;
        Some(measured)
    }

    /// Counts the vertices and the edges of a contour.
    fn walk(&mut self, contour: &[Point]) {
        let inside = if area(contour) > 0.0 { Ordering::Greater } else { Ordering::Less };
        for (at, &here) in contour.iter().enumerate() {
            let before = contour[(at + contour.len() - 1) % contour.len()];
            let next = contour[(at + 1) % contour.len()];
            if before == here {
                self.repeated += i64::from(contour.len() > 1);
                continue;
            }
            self.level += i64::from(before[1] == here[1]);
            self.upright += i64::from(before[0] == here[0]);
            if next == here {
                continue;
            }
            match orientation(before, here, next) {
                Ordering::Equal => {
                    // Along the axis in which the edge is longer.
                    let [dx, dy] = [here[0] - before[0], here[1] - before[1]];
                    let axis = usize::from(dx.abs() < dy.abs());
                    let comes_back = (next[axis] > here[axis]) != (here[axis] > before[axis]);
                    self.spikes += i64::from(comes_back);
                    self.straight += i64::from(!comes_back);
                }
                turn => self.reflex += i64::from(turn != inside),
            }
        }
    }
}

/// How often each number occurs, the least one first.
fn runs(mut values: Vec<f64>) -> Vec<i64> {
    values.sort_unstable_by(f64::total_cmp);
    let mut runs = Vec::new();
    for (i, value) in values.iter().enumerate() {
        match runs.last_mut() {
            Some(last) if values[i - 1] == *value => *last += 1,
            _ => runs.push(1),
        }
    }
    runs
}

/// The side of the box along an axis.
fn side(points: &[Point], axis: usize) -> f64 {
    let [least, most] = ends_of(points, axis);
    most - least
}

/// How many bits a number has between the first and the last that is set.
fn bits(v: f64) -> i64 {
    if v == 0.0 { 0 } else { 53 - i64::from((v.to_bits() | 1 << 52).trailing_zeros()) }
}

/// The number of a word of [`SIGNS`].
fn signs(points: &[Point], axis: usize) -> i64 {
    let [mut has_below, mut has_zero, mut has_above] = [false; 3];
    for p in points {
        has_below |= p[axis] < 0.0;
        has_zero |= p[axis] == 0.0;
        has_above |= p[axis] > 0.0;
    }
    match [has_below, has_above] {
        [true, true] => 2,
        _ if has_zero => 3,
        [true, false] => 0,
        _ => 1,
    }
}

/// The polygon with coordinates that a tessellator takes: large or broken ones are scaled first where they have to be whole.
fn put(coordinates: &Coordinates, mut polygon: Polygon) -> Polygon {
    let (mut largest, mut is_whole) = (0.0_f64, true);
    for v in polygon.contours.iter().flatten().flatten() {
        largest = largest.max(v.abs());
        is_whole &= v.fract() == 0.0 && coordinates.round(*v) == *v;
    }
    // Whole numbers stay as they are, if they are not too large; others get as many bits as there are.
    let scale = match coordinates {
        Coordinates::Integer if !is_whole => 2_f64.powi(19 - exponent(largest)),
        _ => 1.0,
    };
    for v in polygon.contours.iter_mut().flatten().flatten() {
        *v = coordinates.round(*v * scale);
    }
    polygon
}

/// A polygon of one of the families, with few vertices.
fn draw(rng: &mut Rng) -> Polygon {
    let family = Family::DRAWN[rng.int(0, Family::DRAWN.len() as i64 - 1) as usize];
    let coordinates = match rng.int(0, 5) {
        0 => Coordinates::F64,
        1 => Coordinates::F32,
        _ => Coordinates::Integer,
    };
    let mut polygon = family.draw(rng, coordinates);
    adjust(rng, &mut polygon);
    polygon
}

/// Gives some polygons what hardly any has by chance: a triangle, a place beside 0, one axis in line.
fn adjust(rng: &mut Rng, polygon: &mut Polygon) {
    let at = rng.int(0, polygon.contours.len() as i64 - 1) as usize;
    match rng.int(0, 7) {
        // The contour alone, with fewer vertices.
        0 | 1 => {
            let mut contour = polygon.contours.swap_remove(at);
            contour.truncate(rng.int(3, 9) as usize);
            polygon.contours = vec![contour];
        }
        // With its least coordinate at 0.
        2 => {
            for axis in 0..2 {
                let mut least = f64::MAX;
                for p in polygon.contours.iter().flatten() {
                    least = least.min(p[axis]);
                }
                move_points(polygon, &|p| p[axis] -= least);
            }
        }
        _ => {}
    }
}

fn vary(rng: &mut Rng, one: &Polygon, other: &Polygon) -> Polygon {
    let mut polygon = one.clone();
    for _ in 0..rng.int(1, 3) {
        let number = rng.int(0, polygon.contours.len() as i64 - 1) as usize;
        let axis = rng.int(0, 1) as usize;
        let contour = &mut polygon.contours[number];
        let at = rng.int(0, contour.len() as i64 - 1) as usize;
        let (here, next) = (contour[at], contour[(at + 1) % contour.len()]);
        match rng.int(0, 17) {
            0 => {
                for contour in &mut polygon.contours {
                    contour.reverse();
                }
            }
            1 => contour.rotate_left(at),
            2 => contour.insert(at, here),
            // A vertex in the middle of an edge, or beyond its end and back.
            3 => contour.insert(at + 1, along(here, next, 0.5)),
            4 => {
                contour.insert(at + 1, here);
                contour.insert(at + 1, along(here, next, 0.5));
            }
            // Beyond the next vertex, and back to it.
            16 => contour.insert(at + 1, along(here, next, 1.5)),
            5 if contour.len() > 1 => {
                contour.remove(at);
            }
            // At the place, in the column or the row of another vertex.
            6 => {
                let to = rng.int(0, contour.len() as i64 - 1) as usize;
                contour[at][axis] = contour[to][axis];
            }
            7 => {
                let by = rng.int(-4, 4) as f64;
                contour[at][axis] += by;
            }
            8 => {
                let by = (1 << rng.int(0, 30)) as f64;
                let by = if rng.chance(2) { by } else { -by };
                move_points(&mut polygon, &|p| p[axis] += by);
            }
            9 | 10 => {
                let by = 2_f64.powi(rng.coordinate(-6, 6));
                move_points(&mut polygon, &|p| p[axis] *= by);
            }
            11 => {
                let by = 2_f64.powi(rng.coordinate(-12, 12));
                move_points(&mut polygon, &|p| *p = [p[0] * by, p[1] * by]);
            }
            12 => move_points(&mut polygon, &|p| p.swap(0, 1)),
            13 => move_points(&mut polygon, &|p| p[axis] = -p[axis]),
            14 if polygon.contours.len() > 1 => {
                polygon.contours.remove(number);
            }
            // A contour without area: a point, or an edge and back.
            15 => polygon.contours.push(if rng.chance(2) { vec![here] } else { vec![here, next] }),
            _ => {
                if rng.chance(2) {
                    polygon.clone_from(other);
                }
                adjust(rng, &mut polygon);
            }
        }
    }
    polygon
}

/// The point at such a part of the way.
fn along(from: Point, to: Point, part: f64) -> Point {
    [from[0] * (1.0 - part) + to[0] * part, from[1] * (1.0 - part) + to[1] * part]
}

fn move_points(polygon: &mut Polygon, to: &dyn Fn(&mut Point)) {
    for point in polygon.contours.iter_mut().flatten() {
        to(point);
    }
}
