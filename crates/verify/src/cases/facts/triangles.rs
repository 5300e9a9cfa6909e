//! Facts of a question about one triangle: its place, its form, its edges and its window.

use rasterproof_core::geometry::{sorted, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};

use glam::DVec2;

use super::{
    Read, Test, Topic, Unit, WINDOW_WAYS, draw_window, fact, facts_of, numbers, saturated,
    vary_window,
};
use crate::cases::{Case, Limits, Shape};

/// One pixel, in steps of the lattice.
pub(super) const PX: i64 = SUBPIXELS as i64;
/// One square pixel, in half square steps.
const SQUARE_PX: i64 = 2 * PX * PX;

/// Triangles that are filled.
pub const TOPIC: Topic = Topic {
    name: "design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &TriangleFacts::of_case(case, limits)?)),
    impossible: include_str!("impossible/design.txt"),
    draw,
    vary,
    put: Limits::put,
};

/// Where a corner lies: distances to the sides of the window.
const BEYOND: Test = Test::Steps(&[1, PX << 8, PX << 12, PX << 15, PX << 20]);
pub(super) const WINDING: Test =
    Test::Choice(&["anticlockwise", "none, without area", "clockwise"]);
const SIDES: Test = Test::Steps(&[2, 3, 9, 33, 257]);
const EXTENT: Test = Test::Steps(&[1, PX, 8 * PX, 64 * PX, 4096 * PX, PX << 17]);
const SLOPE: Test = Test::Steps(&[0, 4, 8, 12, 15]);
pub(super) const BITS: Test = Test::Steps(&[1, 2, 5]);

/// The first facts of a question about a triangle in a small window, of what has a `form`: width and height are tested by `$extent`.
macro_rules! form_facts {
    ($measured:ty, $extent:expr) => {{
        use $crate::cases::facts::{Test, Unit, fact, triangles};
        const BITS: Test = Test::Steps(&[1, 2, 5]);
        const SIDES: Test = Test::Steps(&[2, 3, 9]);
        const PLACE: Test = Test::Choice(&["inside", "outside"]);
        [
            fact("its winding", Unit::Count, |m: &$measured| m.form.turn + 1, triangles::WINDING),
            fact("its width", Unit::Subpixels, |m: &$measured| m.form.size[0], $extent),
            fact("its height", Unit::Subpixels, |m: &$measured| m.form.size[1], $extent),
            fact(
                "the bits of its columns below the pixel",
                Unit::Count,
                |m: &$measured| m.form.bits[0],
                BITS,
            ),
            fact(
                "the bits of its rows below the pixel",
                Unit::Count,
                |m: &$measured| m.form.bits[1],
                BITS,
            ),
            fact(
                "its left side",
                Unit::Count,
                |m: &$measured| (m.form.beyond[0] > 0) as i64,
                PLACE,
            ),
            fact(
                "its upper side",
                Unit::Count,
                |m: &$measured| (m.form.beyond[1] > 0) as i64,
                PLACE,
            ),
            fact(
                "its right side",
                Unit::Count,
                |m: &$measured| (m.form.beyond[2] > 0) as i64,
                PLACE,
            ),
            fact(
                "its lower side",
                Unit::Count,
                |m: &$measured| (m.form.beyond[3] > 0) as i64,
                PLACE,
            ),
            fact(
                "corners inside the window",
                Unit::Count,
                |m: &$measured| m.form.inside,
                Test::Steps(&[1, 2, 3]),
            ),
            fact("the width of the window", Unit::Pixels, |m: &$measured| m.form.window[0], SIDES),
            fact("the height of the window", Unit::Pixels, |m: &$measured| m.form.window[1], SIDES),
            fact(
                "the width of the window in pixels",
                Unit::Count,
                |m: &$measured| m.form.window[0],
                Test::Divisor,
            ),
        ]
    }};
}
pub(super) use form_facts;

/// The facts that the design covers.
const FACTS: [Read<TriangleFacts>; 27] = [
    fact("its winding", Unit::Count, |m| m.turn + 1, WINDING),
    fact(
        "its uppermost corner",
        Unit::Count,
        |m| m.top,
        Test::Choice(&["the first", "the second", "the third", "two of them"]),
    ),
    fact(
        "its middle corner",
        Unit::Count,
        |m| m.middle,
        Test::Choice(&[
            "on the long edge",
            "left of the long edge",
            "right of it",
            "at the height of another",
        ]),
    ),
    fact(
        "its level edge",
        Unit::Count,
        |m| m.level,
        Test::Choice(&["none", "the upper one", "the lower one", "all"]),
    ),
    fact(
        "its upright edge",
        Unit::Count,
        |m| m.upright,
        Test::Choice(&["none", "the left one", "the right one", "all"]),
    ),
    fact("its width", Unit::Subpixels, |m| m.size[0], EXTENT),
    fact("its height", Unit::Subpixels, |m| m.size[1], EXTENT),
    fact(
        "its area",
        Unit::HalfSquareSubpixels,
        |m| m.twice_area,
        Test::Steps(&[
            1,
            SQUARE_PX,
            SQUARE_PX << 4,
            SQUARE_PX << 8,
            SQUARE_PX << 14,
            SQUARE_PX << 26,
        ]),
    ),
    fact("the bits of its columns below the pixel", Unit::Count, |m| m.bits[0], BITS),
    fact("the bits of its rows below the pixel", Unit::Count, |m| m.bits[1], BITS),
    fact("what lies to the left of the window", Unit::Subpixels, |m| m.beyond[0], BEYOND),
    fact("what lies above the window", Unit::Subpixels, |m| m.beyond[1], BEYOND),
    fact("what lies to the right of the window", Unit::Subpixels, |m| m.beyond[2], BEYOND),
    fact("what lies below the window", Unit::Subpixels, |m| m.beyond[3], BEYOND),
    fact("corners inside the window", Unit::Count, |m| m.inside, Test::Steps(&[1, 2, 3])),
    fact("the width of the window", Unit::Pixels, |m| m.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.window[1], SIDES),
    fact("the width of the window in pixels", Unit::Count, |m| m.window[0], Test::Divisor),
    fact("the height of the window in pixels", Unit::Count, |m| m.window[1], Test::Divisor),
    fact(
        "samples on its boundary",
        Unit::Count,
        |m| m.ties,
        Test::Choice(&["none", "on an edge", "on a corner"]),
    ),
    fact("rows of samples that it meets", Unit::Count, |m| m.rows, Test::Steps(&[1, 2, 9, 33])),
    fact("samples in it", Unit::Count, |m| m.samples, Test::Steps(&[1, 2, 17, 257])),
    fact(
        "columns to a row of the most level edge that meets a row",
        Unit::Doublings,
        |m| m.levelest,
        SLOPE,
    ),
    fact(
        "rows to a column of the steepest edge that meets a row",
        Unit::Doublings,
        |m| m.steepest,
        SLOPE,
    ),
    fact("borders of columns of 8 px in it", Unit::Count, |m| m.tiles[0], Test::Steps(&[1, 2])),
    fact("borders of rows of 8 px in it", Unit::Count, |m| m.tiles[1], Test::Steps(&[1, 2])),
    fact("the first column with a sample", Unit::Count, |m| m.first_column, Test::Divisor),
];

/// What was measured of a triangle in its window. Lengths are in steps of the lattice.
pub struct TriangleFacts {
    /// 1 where the corners run clockwise on the screen, -1 the other way round, 0 without area.
    pub turn: i64,
    /// The number of the uppermost corner, or 3.
    pub top: i64,
    /// On which side of the long edge the middle corner lies.
    pub middle: i64,
    /// Which edge is level, and which is upright.
    pub level: i64,
    /// As `level`, of columns.
    pub upright: i64,
    /// Width and height of its box.
    pub size: [i64; 2],
    /// At most `i64::MAX`.
    pub twice_area: i64,
    /// Bits below the pixel that columns and rows use.
    pub bits: [i64; 2],
    /// How far it reaches beyond the left, upper, right and lower side of the window.
    pub beyond: [i64; 4],
    /// Corners inside the window.
    pub inside: i64,
    /// Sides of the window in pixels.
    pub window: [i64; 2],
    /// Whether a sample lies on an edge (1) or on a corner (2).
    pub ties: i64,
    /// Rows of samples of the window that it meets, and samples in it or on its boundary.
    pub rows: i64,
    /// See `rows`.
    pub samples: i64,
    /// The logarithm of the largest |dx / dy|, and of the largest |dy / dx|, of edges that meet a row of samples of the window.
    pub levelest: i64,
    /// See `levelest`.
    pub steepest: i64,
    /// Multiples of 8 px between its first and its last column in the window, and row.
    pub tiles: [i64; 2],
    /// The first column in which it has a sample.
    pub first_column: i64,
}

/// A point, in 64 bits, where pixels are sampled at their centres.
pub(super) type Point = [i64; 2];

impl TriangleFacts {
    /// Of a case with one triangle or of the first one of several.
    #[must_use]
    pub fn of_case(case: &Case, limits: &Limits) -> Option<Self> {
        Some(Self::of(&case.triangles().first()?.corners(), case.window, limits.sample))
    }

    /// Of a triangle whose pixels are sampled there.
    #[must_use]
    pub fn of(corners: &Corners, window: PixelRect, sample: [i32; 2]) -> Self {
        // Moved so that pixels are sampled at their centres.
        let by = [i64::from(HALF_PIXEL - sample[0]), i64::from(HALF_PIXEL - sample[1])];
        let mut points = [[0; 2]; 3];
        for (point, p) in points.iter_mut().zip(corners) {
            *point = [i64::from(p.x) + by[0], i64::from(p.y) + by[1]];
        }
        let area = twice_area(corners);
        let near = [i64::from(window.x0) * PX, i64::from(window.y0) * PX];
        let far = [i64::from(window.x1) * PX, i64::from(window.y1) * PX];
        let (mut low, mut high, mut bits) = (points[0], points[0], [0; 2]);
        let mut inside = 0;
        for p in points {
            let mut is_in = true;
            for axis in 0..2 {
                let v = p[axis];
                low[axis] = low[axis].min(v);
                high[axis] = high[axis].max(v);
                bits[axis] = bits[axis].max(8 - i64::from((v as u64 | 256).trailing_zeros()));
                is_in &= near[axis] <= v && v < far[axis];
            }
            inside += i64::from(is_in);
        }
        let mut tiles = [0; 2];
        for axis in 0..2 {
            let first = low[axis].max(near[axis]).div_euclid(8 * PX);
            let last = high[axis].min(far[axis] - 1).div_euclid(8 * PX);
            tiles[axis] = (last - first).max(0);
        }
        let mut measured = Self {
            turn: area.signum() as i64,
            top: uppermost(&points),
            middle: 0,
            level: 0,
            upright: 0,
            size: [high[0] - low[0], high[1] - low[1]],
            twice_area: area.unsigned_abs().min(i64::MAX as u128) as i64,
            bits,
            beyond: [near[0] - low[0], near[1] - low[1], high[0] - far[0], high[1] - far[1]],
            inside,
            window: [i64::from(window.width()), i64::from(window.height())],
            ties: 0,
            rows: 0,
            samples: 0,
            levelest: -1,
            steepest: -1,
            tiles,
            first_column: 0,
        };
        measured.level = aligned_edge(&points, 1, low[1], high[1]);
        measured.upright = aligned_edge(&points, 0, low[0], high[0]);
        measured.middle = middle_side(corners);
        measured.count_samples(&points, window, (low, high));
        measured
    }

    /// Walks the rows of samples that the triangle meets.
    fn count_samples(
        &mut self,
        points: &[Point; 3],
        window: PixelRect,
        (low, high): (Point, Point),
    ) {
        let half = i64::from(HALF_PIXEL);
        // The first and the last row whose samples lie between the uppermost and the lowest corner.
        let first_row = i64::from(window.y0).max((low[1] - half + PX - 1).div_euclid(PX));
        let last_row = i64::from(window.y1 - 1).min((high[1] - half).div_euclid(PX));
        let (start, end) = (i64::from(window.x0), i64::from(window.x1));
        let mut first_column = i64::MAX;
        for row in first_row..=last_row {
            let y = row * PX + half;
            // Where the row enters and leaves the triangle, rounded to the first and the last column inside.
            let (mut first, mut last) = (i64::MAX, i64::MIN);
            let mut p = points[2];
            for &q in points {
                if let Some((enters, leaves, is_exact)) = columns_at(p, q, y) {
                    (first, last) = (first.min(enters), last.max(leaves));
                    if is_exact && start <= enters && enters < end {
                        self.ties = 1;
                    }
                }
                p = q;
            }
            // A row of samples meets two edges or none.
            self.rows += i64::from(last != i64::MIN);
            (first, last) = (first.max(start), last.min(end - 1));
            if first <= last {
                self.samples += last - first + 1;
                first_column = first_column.min(first);
            }
        }
        if first_column != i64::MAX {
            self.first_column = first_column;
        }
        for p in points {
            let is_sample = p[0].rem_euclid(PX) == half && p[1].rem_euclid(PX) == half;
            if is_sample && window.contains((p[0] >> 8) as i32, (p[1] >> 8) as i32) {
                self.ties = 2;
            }
        }
        for edge in 0..3 {
            let [p, q] = [points[edge], points[(edge + 1) % 3]];
            self.note_slope(p, q, [first_row, last_row]);
        }
    }

    /// Notes the slope of an edge that meets a row of samples in the window.
    fn note_slope(&mut self, p: Point, q: Point, rows: [i64; 2]) {
        let half = i64::from(HALF_PIXEL);
        let [upper, lower] = [p[1].min(q[1]), p[1].max(q[1])];
        let first = rows[0].max((upper - half + PX - 1).div_euclid(PX));
        if first > rows[1].min((lower - half).div_euclid(PX)) {
            return;
        }
        let (dx, dy) = ((p[0] - q[0]).abs(), (p[1] - q[1]).abs());
        self.levelest = self.levelest.max(doublings(dx, dy));
        self.steepest = self.steepest.max(doublings(dy, dx));
    }
}

/// The power of two of a quotient of at least 1; -1 of others.
fn doublings(over: i64, under: i64) -> i64 {
    if under == 0 || over < under { -1 } else { i64::from((over / under).ilog2()) }
}

/// The corner above all others; 3 where two are equally high.
fn uppermost(points: &[Point; 3]) -> i64 {
    let [a, b, c] = [points[0][1], points[1][1], points[2][1]];
    if a < b && a < c {
        0
    } else if b < a && b < c {
        1
    } else if c < a && c < b {
        2
    } else {
        3
    }
}

/// Which edge is level (`axis` 1) or upright (`axis` 0): none, that at the least coordinate, that at the largest, or all.
fn aligned_edge(points: &[Point; 3], axis: usize, low: i64, high: i64) -> i64 {
    if low == high {
        return 3;
    }
    let (mut at_low, mut at_high) = (0, 0);
    for p in points {
        at_low += i64::from(p[axis] == low);
        at_high += i64::from(p[axis] == high);
    }
    match (at_low, at_high) {
        (2, _) => 1,
        (_, 2) => 2,
        _ => 0,
    }
}

/// On which side of the long edge the middle corner lies, by height: 0 on it, 1 left, 2 right, 3 at the height of another.
fn middle_side(corners: &Corners) -> i64 {
    let [a, b, c] = sorted(*corners, |p, q| p.y > q.y);
    if a.y == b.y || b.y == c.y {
        return 3;
    }
    match twice_area(&[a, c, b]).signum() {
        0 => 0,
        1 => 1,
        _ => 2,
    }
}

/// The first column whose sample is not left of an edge in a row of samples, the last that is not right of it, and whether a
/// sample lies on it. Of a level edge on the row the whole edge.
pub(super) fn columns_at(p: Point, q: Point, y: i64) -> Option<(i64, i64, bool)> {
    let half = i64::from(HALF_PIXEL);
    if y < p[1].min(q[1]) || y > p[1].max(q[1]) {
        return None;
    }
    if p[1] == q[1] {
        let first = (p[0].min(q[0]) - half + PX - 1).div_euclid(PX);
        let last = (p[0].max(q[0]) - half).div_euclid(PX);
        return Some((first, last, first <= last));
    }
    // Downwards, so that the divisor is above 0.
    let [p, q] = if p[1] < q[1] { [p, q] } else { [q, p] };
    // The column is (x - 1/2 px) / px with x = p + (y - p) dx / dy.
    let (dx, dy, from) = (q[0] - p[0], q[1] - p[1], p[0] - half);
    let (floor, is_exact) = if from.abs().max(dx.abs()).max(dy) < 1 << 31 {
        // Products of 31 bits, of which a sum has 63: a division is much faster there.
        let (over, under) = (from * dy + (y - p[1]) * dx, dy * PX);
        let floor = over.div_euclid(under);
        (floor, floor * under == over)
    } else {
        let over = i128::from(from) * i128::from(dy) + i128::from(y - p[1]) * i128::from(dx);
        let under = i128::from(dy) * i128::from(PX);
        let floor = over.div_euclid(under);
        (floor as i64, floor * under == over)
    };
    Some((floor + i64::from(!is_exact), floor, is_exact))
}

/// A triangle with plain values.
fn plain(corners: Corners) -> ScreenTriangle<DVec2> {
    let vertex = |position| ScreenVertex { position, depth: 0.0, inv_w: 1.0, varying: DVec2::ZERO };
    ScreenTriangle { vertices: corners.map(vertex) }
}

/// A coordinate along a side of so many pixels, in one of the ways in which cases are hard.
fn draw_coordinate(rng: &mut Rng, side_px: i64, reach: i64) -> i64 {
    let half = i64::from(HALF_PIXEL);
    match rng.int(0, 8) {
        // On a column of samples or beside one.
        0 | 1 => rng.int(0, side_px - 1) * PX + half,
        2 => rng.int(0, side_px - 1) * PX + half + rng.int(-2, 2),
        // On whole pixels, and on quarters.
        3 => [rng.int(0, side_px), 0, side_px - 1, side_px][rng.int(0, 3) as usize] * PX,
        4 => rng.int(0, 4 * side_px) * (PX / 4),
        // Anywhere, also a little outside.
        5 => rng.int(0, side_px * PX),
        6 => rng.int(-2 * side_px * PX, 3 * side_px * PX),
        // Beside the border of a tile, nearer than any sample.
        7 => rng.int(0, side_px / 8) * 8 * PX + rng.int(-100, 100),
        // As far as this case reaches.
        _ => {
            let far = rng.int(reach / 2, reach);
            (if rng.chance(2) { -far } else { side_px * PX + far }) / PX * PX + rng.int(0, 1) * half
        }
    }
}

/// How far a case reaches beyond its window.
fn draw_reach(rng: &mut Rng) -> i64 {
    PX << rng.int(1, 22)
}

pub(super) fn draw(rng: &mut Rng) -> Case {
    let window = draw_window(rng);
    let (sides, reach) = ([window.width(), window.height()].map(i64::from), draw_reach(rng));
    let mut points =
        [(); 3].map(|()| [0, 1].map(|axis: usize| draw_coordinate(rng, sides[axis], reach)));
    // Some corners share a column, a row or a place.
    if rng.chance(3) {
        let (from, to, axis) =
            (rng.int(0, 2) as usize, rng.int(0, 2) as usize, rng.int(0, 1) as usize);
        points[to][axis] = points[from][axis] + if rng.chance(3) { rng.int(-2, 2) } else { 0 };
    }
    adjust(rng, &mut points, sides);
    case_of(window, points)
}

/// A case of one triangle.
fn case_of(window: PixelRect, points: [Point; 3]) -> Case {
    let corners = points.map(|[x, y]| SubpixelPoint::new(saturated(x), saturated(y)));
    Case { window, shape: Shape::Triangles { list: vec![plain(corners)], disjoint: true } }
}

/// Gives some triangles what hardly any has by chance: an edge through a sample, a corner on an edge.
fn adjust(rng: &mut Rng, points: &mut [Point; 3], sides: [i64; 2]) {
    let (one, other) = [(0, 1), (1, 2), (2, 0)][rng.int(0, 2) as usize];
    match rng.int(0, 9) {
        // The edge from `one` goes through a sample, and as far beyond it.
        0 | 1 => {
            let sample = sides.map(|side| rng.int(0, side - 1) * PX + i64::from(HALF_PIXEL));
            let times = rng.int(1, 3);
            points[other] =
                [0, 1].map(|axis: usize| sample[axis] + times * (sample[axis] - points[one][axis]));
        }
        // A long edge that is level or upright but for a few steps, across a row or a column of samples.
        2 => {
            let axis = rng.int(0, 1) as usize;
            let line = rng.int(0, sides[axis] - 1) * PX + i64::from(HALF_PIXEL);
            let off = rng.int(0, 24);
            (points[one][axis], points[other][axis]) =
                (line - rng.int(0, off), line + rng.int(0, off));
            let long = PX << rng.int(4, 20);
            points[other][1 - axis] =
                points[one][1 - axis] + if rng.chance(2) { long } else { -long };
            // A sliver along it.
            if rng.chance(3) {
                points[3 - one - other] = points[one];
                points[3 - one - other][axis] = line + rng.int(-off, off);
            }
        }
        // From just before a tile of 8 x 8 px to just behind it.
        4 => {
            let axis = rng.int(0, 1) as usize;
            let start = rng.int(0, sides[axis] / 8) * 8 * PX;
            points[one][axis] = start - rng.int(1, 100);
            points[other][axis] = start + 8 * PX + rng.int(0, 100);
            points[3 - one - other][axis] = start + rng.int(0, 8 * PX);
        }
        // Half of the window, up to its border or to the last samples.
        5 => {
            let inset = [0, 1, i64::from(HALF_PIXEL), PX][rng.int(0, 3) as usize];
            let [right, lower] = sides.map(|side| side * PX - inset);
            points[one] = [right, inset];
            points[other] = [inset, lower];
            points[3 - one - other] = if rng.chance(2) { [inset, inset] } else { [right, lower] };
        }
        // No area, or hardly any.
        3 => {
            let third = 3 - one - other;
            let off = if rng.chance(2) { 0 } else { rng.int(-1, 1) };
            points[third] =
                [0, 1].map(|axis: usize| 2 * points[one][axis] - points[other][axis] + off);
        }
        _ => {}
    }
}

/// Changes a few things of a triangle: a coordinate, a corner, the window, the place or the size of it all.
pub(super) fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let of = |case: &Case| case.triangles()[0].corners().map(|p| [i64::from(p.x), i64::from(p.y)]);
    let mut window = one.window;
    let (mut points, others) = (of(one), of(other));
    for _ in 0..rng.int(1, 3) {
        let (at, axis) = (rng.int(0, 2) as usize, rng.int(0, 1) as usize);
        let sides = [window.width(), window.height()].map(i64::from);
        match rng.int(0, 14) {
            way @ 0..WINDOW_WAYS => vary_window(rng, &mut window, other.window, way, axis),
            4 => points[at] = others[at],
            5 => points[at][axis] = others[at][axis],
            6 => points.iter_mut().zip(&others).for_each(|(p, other)| p[axis] = other[axis]),
            7 => points.swap(at, rng.int(0, 2) as usize),
            8 => {
                let reach = draw_reach(rng);
                points[at][axis] = draw_coordinate(rng, sides[axis], reach);
            }
            9 => points[at][axis] = points[(at + 1) % 3][axis] + rng.int(-1, 1),
            10 => points[at][axis] += rng.int(-3, 3) << (8 * rng.int(0, 1)),
            // All columns or rows on centres, on whole pixels or on fractions of one.
            11 => {
                let (step, to) = [(PX, HALF_PIXEL.into()), (PX, 0), (PX / 4, 0), (PX / 16, 0)]
                    [rng.int(0, 3) as usize];
                points.iter_mut().for_each(|p| p[axis] = p[axis].div_euclid(step) * step + to);
            }
            // Each beside the border of a tile.
            12 => {
                for p in points.iter_mut() {
                    p[axis] = (p[axis] + 4 * PX).div_euclid(8 * PX) * 8 * PX + rng.int(-100, 100);
                }
            }
            // Moved as a whole.
            13 => {
                let by = rng.int(-20, 20) << rng.int(8, 26);
                points.iter_mut().for_each(|p| p[axis] += by);
            }
            _ => adjust(rng, &mut points, sides),
        }
    }
    case_of(window, points)
}
