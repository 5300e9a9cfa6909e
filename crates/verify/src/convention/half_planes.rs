//! Triangles as half-planes, moved: what most shapes are. A sample point moves the pixel, samples that
//! differ for left and right edges are crossings rounded row by row, a reach moves the edges outward.

use super::place::{Emit, Place, Points, around, edges, turn};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

/// a x + b y + c > 0 inside.
#[derive(Clone, Copy)]
struct Side<T> {
    a: T,
    b: T,
    c: T,
    facing: usize,
}

/// The facing of the outward normal (-a, -b).
pub(crate) fn facing(a: i64, b: i64) -> usize {
    match (a.signum(), b.signum()) {
        (0, 1) => 0,
        (-1, 1) => 1,
        (-1, 0) => 2,
        (-1, -1) => 3,
        (0, -1) => 4,
        (1, -1) => 5,
        (1, 0) => 6,
        (1, 1) => 7,
        _ => unreachable!("an edge has a length"),
    }
}

/// Half-planes and how they are moved, in subpixels.
#[derive(Clone, Copy)]
pub(super) struct HalfPlanes {
    pub left: i32,
    pub right: i32,
    /// The height at which a pixel is asked.
    pub y: i32,
    /// How far outside still belongs.
    pub reach: i32,
    pub square: bool,
    /// Whether rows have ends, so that level edges are borders of the box.
    pub rows: bool,
    /// Whether the box of the corners is a border too.
    pub boxed: bool,
}

/// Half-planes for a sample at such a place of a pixel, and nothing else.
pub(super) fn at(x: i32, y: i32) -> HalfPlanes {
    HalfPlanes { left: x, right: x, y, reach: 0, square: false, rows: false, boxed: false }
}

impl HalfPlanes {
    /// Calls `emit` with every pixel of `window` that is not outside; true.
    pub(super) fn trace(self, points: &Points, window: PixelRect, emit: Emit<'_>) -> bool {
        let sign = turn(points).signum() as i64;
        if sign == 0 {
            return true;
        }
        // Numbers of 64 bits are enough near the origin, and faster.
        let sides = self.sides(points, sign);
        let near = points.as_flattened().iter().all(|v| v.abs() < 1 << 28);
        let rect = around(points, 2).intersect(&window);
        if near {
            let mut narrow = Vec::with_capacity(sides.len());
            for Side { a, b, c, facing } in sides {
                narrow.push(Side { a: a as i64, b: b as i64, c: c as i64, facing });
            }
            walk(&narrow, rect, emit);
        } else {
            walk(&sides, rect, emit);
        }
        true
    }

    /// The sides, moved so that a pixel is asked at its upper left corner.
    fn sides(self, points: &Points, sign: i64) -> Vec<Side<i128>> {
        let Self { left, right, y, reach, square, rows, boxed } = self;
        let side = |a: i64, b: i64, [px, py]: [i64; 2], reach: i64| {
            // A left edge and a right one may be asked at different places of the pixel.
            let x = if a > 0 { left } else { right };
            let [wa, wb] = [a, b].map_array(i128::from);
            let c = wa * (i128::from(x) - i128::from(px)) + wb * (i128::from(y) - i128::from(py));
            Side { a: wa, b: wb, c: c + i128::from(reach), facing: facing(a, b) }
        };
        let mut sides = Vec::with_capacity(7);
        for [p, q] in edges(points) {
            let (a, b) = (sign * (p[1] - q[1]), sign * (q[0] - p[0]));
            // What is level or upright is among the borders of the box.
            if (rows && a == 0) || (boxed && (a == 0 || b == 0)) {
                continue;
            }
            let width = if square { a.abs() + b.abs() } else { a.abs().max(b.abs()) };
            sides.push(side(a, b, p, width * i64::from(reach)));
        }
        // The box of the corners.
        let [a, b, c] = points;
        let (x0, x1) = (a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
        let (y0, y1) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
        // Rows begin and end with the corners.
        if rows || boxed {
            sides.push(side(0, 1, [x0, y0], reach.into()));
            sides.push(side(0, -1, [x0, y1], reach.into()));
        }
        if boxed {
            sides.push(side(1, 0, [x0, y0], reach.into()));
            sides.push(side(-1, 0, [x1, y0], reach.into()));
        }
        sides
    }
}

/// The same loop in words that cannot overflow: i64 for corners within 2^28, else i128.
fn walk<T>(sides: &[Side<T>], rect: PixelRect, emit: Emit<'_>)
where
    T: Copy + Ord + From<i64> + std::ops::Add<Output = T> + std::ops::Mul<Output = T>,
{
    let (zero, pixel) = (T::from(0), T::from(256));
    for y_px in rect.y0..rect.y1 {
        // The values at the first pixel of the row; each step along it adds the same.
        let corner = [rect.x0, y_px].map_array(|px| T::from(i64::from(px)) * pixel);
        let mut values = [zero; 7];
        for (value, side) in values.iter_mut().zip(sides) {
            *value = side.a * corner[0] + side.b * corner[1] + side.c;
        }
        let values = &mut values[..sides.len()];
        for x_px in rect.x0..rect.x1 {
            if values.iter().all(|&v| v >= zero) {
                emit(x_px, y_px, place(values.iter().map(|&v| v == zero), sides));
            }
            for (value, side) in values.iter_mut().zip(sides) {
                *value = *value + side.a * pixel;
            }
        }
    }
}

/// On what a sample lies: no edge, one edge, or several.
fn place<T>(zeros: impl Iterator<Item = bool>, sides: &[Side<T>]) -> Place {
    let (mut bits, mut count, mut last) = (0, 0, 0);
    for (_, side) in zeros.zip(sides).filter(|(zero, _)| *zero) {
        bits |= 1 << side.facing;
        count += 1;
        last = side.facing;
    }
    match count {
        0 => Place::In,
        1 => Place::Edge(last),
        _ => Place::Corner(bits),
    }
}
