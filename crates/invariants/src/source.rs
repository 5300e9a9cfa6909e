//! Inputs of the checks: made from (invariant, seed, number) here, or from small whole numbers by a
//! property test. Every constructor is total, so that whatever a shrinker tries is an input.

use std::fmt;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_verify::cases::shrink;
use rasterproof_verify::cases::{self, Case, Family, Line, Shape, Triangle, named};

use super::implementations::MakeCase;

/// The side of the windows of inputs that are made here, in pixels and in subpixels.
const SIDE_PX: u32 = 24;
const SIDE: i64 = SIDE_PX as i64 * SUBPIXELS as i64;

/// A triangle, the window it is drawn in, and a number for what else a check has to choose.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleInput {
    pub triangle: Triangle,
    pub window: PixelRect,
    /// Decides tiles, shifts and the like.
    pub salt: u32,
}

/// A convex quadrilateral, corners clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Quad {
    pub corners: [SubpixelPoint; 4],
    pub window: PixelRect,
}

impl Quad {
    /// The quadrilateral with one corner on each side of a box: convex whatever the numbers are.
    /// `along` says where on the top, right, bottom and left side, in 256ths of the side.
    pub fn inscribed([left, top, width, height]: [u16; 4], along: [u8; 4]) -> Self {
        let [left, top, width, height] = [left, top, width, height].map_array(i32::from);
        // How far along its side each corner lies, from the left or from the top.
        let mut part = [width, height, width, height];
        for (part, along) in part.iter_mut().zip(along) {
            *part = (i64::from(*part) * i64::from(along) / 255) as i32;
        }
        let corners = [[part[0], 0], [width, part[1]], [part[2], height], [0, part[3]]]
            .map_array(|[x, y]| SubpixelPoint::new(left + x, top + y));
        Self { corners, window: PixelRect::window(SIDE_PX, SIDE_PX) }
    }
}

/// A star-shaped polygon around a centre, spokes clockwise, and one more point anywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Fan {
    pub centre: SubpixelPoint,
    pub ring: Vec<SubpixelPoint>,
    pub apex: SubpixelPoint,
    pub window: PixelRect,
}

/// The sixteen directions of a fan, clockwise on the screen. Whole numbers, so that a spoke passes
/// through centres often; any eight or more neighbours of these are less than half a turn apart.
const DIRECTIONS: [[i32; 2]; 16] = [
    [2, 0],
    [2, 1],
    [2, 2],
    [1, 2],
    [0, 2],
    [-1, 2],
    [-2, 2],
    [-2, 1],
    [-2, 0],
    [-2, -1],
    [-2, -2],
    [-1, -2],
    [0, -2],
    [1, -2],
    [2, -2],
    [2, -1],
];

impl Fan {
    /// The fan with these reaches in half subpixels; `every` 1 takes all directions, 2 every other
    /// one.
    pub fn new(centre: SubpixelPoint, reach: [u16; 16], every: usize, apex: SubpixelPoint) -> Self {
        let mut ring = Vec::with_capacity(16);
        for ([dx, dy], reach) in DIRECTIONS.iter().zip(reach).step_by(every.clamp(1, 2)) {
            // At least one subpixel, or the polygon would not go round its centre.
            let reach = i32::from(reach).max(1);
            ring.push(SubpixelPoint::new(centre.x + dx * reach, centre.y + dy * reach));
        }
        Self { centre, ring, apex, window: PixelRect::window(SIDE_PX, SIDE_PX) }
    }
}

/// A line, its window, and a number for what else a check has to choose.
#[derive(Clone, Debug, PartialEq)]
pub struct LineInput {
    pub line: Line,
    pub window: PixelRect,
}

/// A coordinate to be snapped, and moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    pub px: f64,
    /// A whole number of pixels to move it by.
    pub shift_px: i32,
}

impl Position {
    /// `sub` subpixels and `part` 2^-12ths of one: ties at 2048, a short mantissa so that a shift
    /// is exact.
    pub fn new(sub: i32, part: u16, shift_px: i32) -> Self {
        let part = f64::from(part % (1 << 12)) / f64::from(1 << 12);
        Self { px: (f64::from(sub) + part) / f64::from(SUBPIXELS), shift_px }
    }
}

/// A triangle in clip space, in small whole numbers so that the truth about it can be computed
/// exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipInput {
    /// x, y, z, w of each vertex; the varying is their number.
    pub vertices: [[i32; 4]; 3],
}

/// The input of one check: each kind of invariant takes one of these.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    Triangle(TriangleInput),
    Quad(Quad),
    Fan(Fan),
    Line(LineInput),
    Position(Position),
    Clip(ClipInput),
    /// A run of the harness: its seed and the cases of each family.
    Run {
        seed: u64,
        cases: u64,
    },
}

/// A case of the families in turn, and the number of the shape in it that is meant.
fn pick(families: &[Family], make_case: MakeCase, seed: u64, index: u64) -> (Case, usize) {
    let count = families.len() as u64;
    let (family, number) = (&families[(index % count) as usize], index / count);
    (make_case(family, seed, number), number as usize)
}

/// A triangle of the families in turn.
pub(super) fn triangle(make_case: MakeCase, seed: u64, index: u64) -> Input {
    let (case, number) = pick(cases::triangles::FAMILIES, make_case, seed, index);
    let Case { window, shape: Shape::Triangles { list, .. } } = case else {
        unreachable!("a family of triangles makes triangles");
    };
    // Meshes have a triangle or more; each is a case of its own here.
    let triangle = list[number % list.len()];
    let salt = Rng::new("salt", seed, index).next() as u32;
    Input::Triangle(TriangleInput { triangle, window, salt })
}

/// Quadrilaterals, half of them with corners on centres.
pub(super) fn quad(seed: u64, index: u64) -> Input {
    let mut rng = Rng::new("quad", seed, index);
    // Corners on centres make ties at every edge that runs along an axis.
    let on_centres = rng.chance(2);
    let align = |v: i64| if on_centres { v / 256 * 256 + 128 } else { v };
    let (left, top) = (align(rng.int(0, SIDE / 2)), align(rng.int(0, SIDE / 2)));
    let (mut width, mut height) = (rng.int(1, SIDE / 2), rng.int(1, SIDE / 2));
    // A multiple of a pixel keeps the far sides on centres as well.
    if on_centres {
        width = (width / 256 * 256).max(256);
        height = (height / 256 * 256).max(256);
    }
    // The corners of the box give rectangles and triangles with a point on a side.
    let mut part = || [0, 255, 128, rng.int(0, 255)][rng.int(0, 3) as usize] as u8;
    let along = [part(), part(), part(), part()];
    Input::Quad(Quad::inscribed([left, top, width, height].map_array(|v| v as u16), along))
}

/// Fans, three in four with their centre on a sample.
pub(super) fn fan(seed: u64, index: u64) -> Input {
    let mut rng = Rng::new("fan", seed, index);
    let (mut x, mut y) = (rng.int(0, SIDE) as i32, rng.int(0, SIDE) as i32);
    if !rng.chance(4) {
        x = x & !(SUBPIXELS - 1) | HALF_PIXEL;
        y = y & !(SUBPIXELS - 1) | HALF_PIXEL;
    }
    let centre = SubpixelPoint::new(x, y);
    // Spokes of whole half pixels often end on centres, where the centre of the fan is one.
    let whole = rng.chance(2);
    // Fans of all sizes, the spokes of each of them up to its own.
    let most = 1 << rng.int(2, 11);
    let reach = [(); 16].map(|()| {
        let reach = rng.int(1, most) as u16;
        if whole { reach & !127 } else { reach }
    });
    let every = if rng.chance(2) { 1 } else { 2 };
    // Anywhere in nine windows around.
    let (x, y) = (rng.int(-SIDE, 2 * SIDE) as i32, rng.int(-SIDE, 2 * SIDE) as i32);
    let apex = SubpixelPoint::new(x, y);
    Input::Fan(Fan::new(centre, reach, every, apex))
}

/// A line, of another family each time the index grows by one.
pub(super) fn line(make_case: MakeCase, seed: u64, index: u64) -> Input {
    let (case, number) = pick(cases::lines::FAMILIES, make_case, seed, index);
    let Case { window, shape: Shape::Lines(lines) } = case else {
        unreachable!("a family of lines makes lines");
    };
    Input::Line(LineInput { line: lines[number % lines.len()], window })
}

/// Coordinates, a third of them ties, with shifts that often cross zero.
pub(super) fn position(seed: u64, index: u64) -> Input {
    let mut rng = Rng::new("position", seed, index);
    // Small and large coordinates equally often.
    let bits = rng.int(4, 30);
    let sub = rng.int(-(1 << bits), 1 << bits) as i32;
    let part = [0, 1 << 11, rng.int(0, (1 << 12) - 1)][rng.int(0, 2) as usize] as u16;
    // To the other side of zero, where a rounding towards zero would show.
    let across = -2 * (sub / SUBPIXELS);
    let shift_px = if rng.chance(2) { across } else { rng.int(-1 << 14, 1 << 14) as i32 };
    Input::Position(Position::new(sub, part, shift_px))
}

/// Triangles in clip space: many with vertices on planes, behind the eye, or all inside.
pub(super) fn clip(seed: u64, index: u64) -> Input {
    let mut rng = Rng::new("clip", seed, index);
    // A vertex inside has |x|, |y|, |z| up to w; one behind the eye has a negative w.
    let inside = rng.chance(4);
    let behind = rng.chance(2);
    let vertices = [(); 3].map_array(|()| {
        let w = rng.int(if behind && !inside { -12 } else { 1 }, 24);
        let reach = if inside { w } else { 30 };
        // A third of the coordinates lie on a plane.
        let mut coordinate = || match rng.int(0, 5) {
            0 => w,
            1 => -w,
            _ => rng.int(-reach, reach),
        };
        [coordinate(), coordinate(), coordinate(), w].map_array(|v| v as i32)
    });
    Input::Clip(ClipInput { vertices })
}

/// The smallest input reached from a failing one for which `fails` still holds.
pub(super) fn smallest(input: Input, fails: impl Fn(&Input) -> bool) -> Input {
    match input {
        Input::Triangle(input) => smallest_triangle(input, fails),
        Input::Line(LineInput { line, window }) => {
            let case = Case { window, shape: Shape::Lines(vec![line]) };
            let found = shrink::shrink(case, |case| line_of(case).as_ref().is_some_and(&fails));
            line_of(&found).unwrap_or(Input::Line(LineInput { line, window }))
        }
        // A run has no neighbours.
        other => shrink::greedy(other, size, neighbours, &fails),
    }
}

/// The first line of a case as an input.
fn line_of(case: &Case) -> Option<Input> {
    let Shape::Lines(lines) = &case.shape else { return None };
    Some(Input::Line(LineInput { line: *lines.first()?, window: case.window }))
}

/// The first triangle of a case as an input.
fn triangle_of(case: &Case, salt: u32) -> Option<Input> {
    let Shape::Triangles { list, .. } = &case.shape else { return None };
    let (triangle, window) = (*list.first()?, case.window);
    Some(Input::Triangle(TriangleInput { triangle, window, salt }))
}

/// The same for a triangle: first without what else there is to choose, then smaller.
fn smallest_triangle(mut input: TriangleInput, fails: impl Fn(&Input) -> bool) -> Input {
    // Simple values and choices first, if they fail too.
    let plain = named::plain_triangle(input.triangle.corners());
    let simpler = [
        TriangleInput { triangle: plain, salt: 0, ..input.clone() },
        TriangleInput { triangle: plain, ..input.clone() },
        TriangleInput { salt: 0, ..input.clone() },
    ];
    if let Some(found) = simpler.into_iter().find(|s| fails(&Input::Triangle(s.clone()))) {
        input = found;
    }
    let salt = input.salt;
    let shape = Shape::Triangles { list: vec![input.triangle], disjoint: false };
    let case = Case { window: input.window, shape };
    let found = shrink::shrink(case, |case| triangle_of(case, salt).as_ref().is_some_and(&fails));
    triangle_of(&found, salt).unwrap_or(Input::Triangle(input))
}

/// How many points an input has, then how far they lie from where [`neighbours`] moves them.
fn size(input: &Input) -> (usize, f64) {
    match input {
        Input::Quad(quad) => (4, distances(&quad.corners, SubpixelPoint::new(0, 0))),
        Input::Fan(fan) => (fan.ring.len(), distances(&fan.ring, fan.centre)),
        Input::Position(p) => (1, p.px.abs() + f64::from(p.shift_px.unsigned_abs())),
        Input::Clip(clip) => {
            let numbers = clip.vertices.as_flattened();
            (3, numbers.iter().map(|v| f64::from(v.unsigned_abs())).sum())
        }
        _ => (0, 0.0),
    }
}

/// The sum of the distances of points from another one, in x and in y.
fn distances(points: &[SubpixelPoint], from: SubpixelPoint) -> f64 {
    let mut sum = 0.0;
    for p in points {
        sum += f64::from(p.x.abs_diff(from.x)) + f64::from(p.y.abs_diff(from.y));
    }
    sum
}

/// Inputs that are one step smaller.
fn neighbours(input: &Input) -> Vec<Input> {
    match input {
        Input::Quad(quad) => smaller_quads(quad),
        Input::Fan(fan) => smaller_fans(fan),
        Input::Position(p) => {
            let whole = p.px.trunc();
            vec![
                Input::Position(Position { shift_px: p.shift_px / 2, ..*p }),
                Input::Position(Position { px: p.px - whole, ..*p }),
                Input::Position(Position { px: p.px - (whole / 2.0).trunc(), ..*p }),
            ]
        }
        Input::Clip(clip) => {
            let mut found = Vec::new();
            for i in 0..12 {
                let number = clip.vertices[i / 4][i % 4];
                for smaller in [0, number / 2, number - number.signum()] {
                    let mut vertices = clip.vertices;
                    vertices[i / 4][i % 4] = smaller;
                    found.push(Input::Clip(ClipInput { vertices }));
                }
            }
            found
        }
        _ => Vec::new(),
    }
}

/// The same quadrilateral nearer to the origin by whole pixels, in the window still.
fn smaller_quads(quad: &Quad) -> Vec<Input> {
    let mut found = Vec::new();
    for (dx, dy) in [(8, 0), (0, 8), (1, 0), (0, 1)] {
        let corners =
            quad.corners.map(|p| SubpixelPoint::new(p.x - dx * SUBPIXELS, p.y - dy * SUBPIXELS));
        if corners.iter().all(|p| p.x >= 0 && p.y >= 0) {
            found.push(Input::Quad(Quad { corners, ..quad.clone() }));
        }
    }
    found
}

/// Fans with one spoke fewer, while eight are left, and the one with spokes half as long.
fn smaller_fans(fan: &Fan) -> Vec<Input> {
    let mut found = Vec::new();
    if fan.ring.len() > 8 {
        for i in 0..fan.ring.len() {
            let mut ring = fan.ring.clone();
            ring.remove(i);
            found.push(Input::Fan(Fan { ring, ..fan.clone() }));
        }
    }
    let mut halved = fan.clone();
    let mut shortest = i32::MAX;
    for p in &mut halved.ring {
        let (dx, dy) = ((p.x - fan.centre.x) / 2, (p.y - fan.centre.y) / 2);
        *p = SubpixelPoint::new(fan.centre.x + dx, fan.centre.y + dy);
        shortest = shortest.min(dx.abs().max(dy.abs()));
    }
    // Halved spokes must still be spokes.
    if shortest >= SUBPIXELS / 8 {
        found.push(Input::Fan(halved));
    }
    found
}

fn px(p: &SubpixelPoint) -> String {
    let (x, y) = p.to_px();
    format!("{x},{y}")
}

/// Points in pixels, one after the other.
fn list(points: &[SubpixelPoint]) -> String {
    points.iter().map(px).collect::<Vec<_>>().join(" ")
}

fn rect(w: &PixelRect) -> String {
    format!("columns {}..{}, rows {}..{}", w.x0, w.x1, w.y0, w.y1)
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Triangle(TriangleInput { triangle, window, salt }) => {
                write!(f, "triangle {} px in {}", list(&triangle.corners()), rect(window))?;
                for v in &triangle.vertices {
                    let [a, b] = v.varying.to_array();
                    write!(f, "; 1/w {:?} depth {:?} values {a:?} {b:?}", v.inv_w, v.depth)?;
                }
                write!(f, "; choice {salt}")
            }
            Self::Quad(quad) => {
                write!(f, "quad {} px in {}", list(&quad.corners), rect(&quad.window))
            }
            Self::Fan(fan) => write!(
                f,
                "fan around {} px through {}, apex {}, in {}",
                px(&fan.centre),
                list(&fan.ring),
                px(&fan.apex),
                rect(&fan.window)
            ),
            Self::Line(LineInput { line, window }) => {
                let [a, b] = line.ends.map_array(|end| end.pixel);
                write!(f, "line {},{} to {},{} in {}", a.x, a.y, b.x, b.y, rect(window))
            }
            Self::Position(p) => write!(f, "coordinate {:?} px, moved by {} px", p.px, p.shift_px),
            Self::Clip(ClipInput { vertices }) => {
                write!(f, "clip coordinates (x, y, z, w) {vertices:?}")
            }
            Self::Run { seed, cases } => {
                write!(f, "a run of seed {seed}, {cases} cases of each family")
            }
        }
    }
}
