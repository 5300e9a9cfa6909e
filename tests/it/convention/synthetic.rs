//! Rasterizers made up for the tests, one for every hypothesis: written from the meaning of each
//! convention, in floats that are exact for such small numbers, and without the crate's own code.

use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_verify::convention::{
    LineTie, Mirror, Pattern, Rounding, Shape, TriangleQuestion, Windings,
};

/// What a made-up rasterizer does on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Owner {
    /// By the direction the edge faces, from north on, clockwise.
    Facing([bool; 8]),
    /// The edges from the first corner to the second, whatever their direction.
    FirstEdge,
}

#[derive(Clone, Copy, Debug)]
pub struct Synthetic {
    pub draws: Windings,
    pub step: i32,
    pub rounding: Rounding,
    pub shape: Shape,
    pub owner: Owner,
    /// Of 1,000 pixels within a pixel of the border, so many come out wrong.
    pub noise: u64,
}

type Point = [f64; 2];

/// Turns the whole picture over.
pub struct Mirrored(pub Synthetic, pub Mirror);

impl Mirrored {
    pub fn draw(&self, question: &TriangleQuestion) -> Coverage {
        let (drawn, window) = (self.0.draw(question), question.window);
        let (right, bottom) = (window.x1 - 1, window.y1 - 1);
        picture(window, |x, y| {
            let (x, y) = match self.1 {
                Mirror::None => (x, y),
                Mirror::UpsideDown => (x, bottom - y),
                Mirror::LeftToRight => (right - x, y),
                Mirror::HalfTurn => (right - x, bottom - y),
                Mirror::Exchanged => (y, x),
            };
            drawn.get(x, y).is_some_and(|hits| hits > 0)
        })
    }
}

/// The picture whose pixels are hit where a function says so.
pub fn picture(window: PixelRect, hits: impl Fn(i32, i32) -> bool) -> Coverage {
    let mut picture = Coverage::new(window, 0);
    for (y, x) in (window.y0..window.y1).flat_map(|y| (window.x0..window.x1).map(move |x| (y, x))) {
        if hits(x, y) {
            picture.hit(y, x, x + 1);
        }
    }
    picture
}

fn cross(o: Point, a: Point, b: Point) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

pub fn hash(mut v: u64) -> u64 {
    v = (v ^ (v >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    v = (v ^ (v >> 29)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    v ^ (v >> 32)
}

impl Synthetic {
    fn snap(&self, sub: i32) -> f64 {
        let step = f64::from(self.step);
        let v = f64::from(sub) / step;
        step * match self.rounding {
            Rounding::Near => (v + 0.5).floor(),
            Rounding::HalfEven => v.round_ties_even(),
            Rounding::HalfAway => v.round(),
            Rounding::Down => v.floor(),
            Rounding::TowardZero => v.trunc(),
        }
    }

    pub fn draw(&self, question: &TriangleQuestion) -> Coverage {
        let p = question.corners.map(|c| [self.snap(c.x), self.snap(c.y)]);
        let area = cross(p[0], p[1], p[2]);
        if area != 0.0 && !self.draws.draws(area > 0.0) {
            return Coverage::new(question.window, 0);
        }
        let key = p.iter().flatten().fold(17, |h, &v| hash(h ^ v as i64 as u64));
        let is_wrong = |x: i32, y: i32| {
            let roll = hash(key ^ (x as u64) << 32 ^ y as u64) % 1000;
            roll < self.noise && self.near_border(&p, x, y)
        };
        let is_shape = area != 0.0 || matches!(self.shape, Shape::Outline(_));
        picture(question.window, |x, y| {
            (is_shape && self.covers(&p, x, y)) != (self.noise > 0 && is_wrong(x, y))
        })
    }

    fn near_border(&self, p: &[Point; 3], x: i32, y: i32) -> bool {
        let at = [f64::from(x) * 256.0 + 128.0, f64::from(y) * 256.0 + 128.0];
        (0..3).any(|i| {
            let (a, b) = (p[i], p[(i + 1) % 3]);
            let (d, l2) =
                ([b[0] - a[0], b[1] - a[1]], (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2));
            let t = (((at[0] - a[0]) * d[0] + (at[1] - a[1]) * d[1]) / l2.max(1.0)).clamp(0.0, 1.0);
            (a[0] + t * d[0] - at[0]).hypot(a[1] + t * d[1] - at[1]) < 256.0
        })
    }

    fn covers(&self, p: &[Point; 3], x: i32, y: i32) -> bool {
        let at = |dx: i32, dy: i32| [f64::from(x * 256 + dx), f64::from(y * 256 + dy)];
        match self.shape {
            Shape::Point { x, y } => self.holds(p, at(x, y)),
            Shape::Rows { left, right, y } => self.row_holds(p, at(left, y), at(right, y)),
            Shape::Stepped { x, y } => stepped(p, at(x, y)),
            Shape::Scan(_) => unreachable!("these are recorded, and drawn by themselves"),
            Shape::Reach { x, y, reach, square } => {
                self.reaches(p, at(x, y), f64::from(reach), square)
            }
            Shape::Share { x, y, percent } => {
                let share = clipped_area(p, at(x - 128, y - 128)) / 65536.0 * 100.0;
                let level = matches!(self.owner, Owner::Facing([true, ..]));
                share > f64::from(percent) + 1e-9 || (level && share > f64::from(percent) - 1e-9)
            }
            Shape::Samples { x, y, pattern, least } => {
                // In sixteenths of a pixel from its upper left corner, if the middle is its centre.
                let places = match pattern {
                    Pattern::Square => [[4, 4], [12, 4], [4, 12], [12, 12]],
                    Pattern::Rotated => [[6, 2], [14, 6], [2, 10], [10, 14]],
                };
                let covered = places
                    .iter()
                    .filter(|[u, v]| self.holds(p, at(x + 16 * u - 128, y + 16 * v - 128)));
                covered.count() >= usize::from(least)
            }
            Shape::Outline(tie) => {
                let q = p.map(|c| [c[0] / 256.0, c[1] / 256.0]);
                let at = [f64::from(x), f64::from(y)];
                let signs = [0, 1, 2].map(|i| cross(q[i], q[(i + 1) % 3], at));
                let area = cross(q[0], q[1], q[2]);
                (area != 0.0 && signs.iter().all(|s| s * area >= 0.0))
                    || (0..3).any(|i| on_line(q[i], q[(i + 1) % 3], at, tie))
            }
        }
    }

    /// Whether edge `i` owns what lies on it: the direction away from the opposite corner.
    fn owns(&self, p: &[Point; 3], i: usize) -> bool {
        let (a, b, c) = (p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
        match self.owner {
            Owner::FirstEdge => i == 0,
            Owner::Facing(compass) => {
                let mut normal = [b[1] - a[1], a[0] - b[0]];
                if normal[0] * (c[0] - a[0]) + normal[1] * (c[1] - a[1]) > 0.0 {
                    normal = [-normal[0], -normal[1]];
                }
                compass[compass_point(normal)]
            }
        }
    }

    fn holds(&self, p: &[Point; 3], at: Point) -> bool {
        let area = cross(p[0], p[1], p[2]);
        (0..3).all(|i| {
            let side = cross(p[i], p[(i + 1) % 3], at) * area;
            side > 0.0 || (side == 0.0 && self.owns(p, i))
        })
    }

    /// The crossings of a row with the polygon, compared at their own positions.
    fn row_holds(&self, p: &[Point; 3], left: Point, right: Point) -> bool {
        let Owner::Facing(compass) = self.owner else { panic!("rows have a compass") };
        let y = left[1];
        let (top, bottom) = (
            p.map(|c| c[1]).into_iter().fold(f64::MAX, f64::min),
            p.map(|c| c[1]).into_iter().fold(f64::MIN, f64::max),
        );
        if y < top || y > bottom || (y == top && !compass[0]) || (y == bottom && !compass[4]) {
            return false;
        }
        let area = cross(p[0], p[1], p[2]);
        (0..3).all(|i| {
            let (a, b) = (p[i], p[(i + 1) % 3]);
            if a[1] == b[1] {
                return true;
            }
            // Inside lies right of an edge that goes up around a clockwise triangle.
            let is_left = (b[1] < a[1]) == (area > 0.0);
            let at = if is_left { left } else { right };
            let side = cross(a, b, at) * area;
            side > 0.0 || (side == 0.0 && self.owns(p, i))
        })
    }

    /// The sample's square or diamond meets the triangle: no side of either separates them.
    fn reaches(&self, p: &[Point; 3], at: Point, reach: f64, square: bool) -> bool {
        let Owner::Facing(compass) = self.owner else { panic!("a reach has a compass") };
        let area = cross(p[0], p[1], p[2]);
        let span = |axis: usize| {
            let v = p.map(|c| c[axis]);
            (v.into_iter().fold(f64::MAX, f64::min), v.into_iter().fold(f64::MIN, f64::max))
        };
        for (axis, facing) in [(0, [6, 2]), (1, [0, 4])] {
            let (low, high) = span(axis);
            for (gap, facing) in
                [(low - at[axis] - reach, facing[0]), (at[axis] - reach - high, facing[1])]
            {
                if gap > 0.0 || (gap == 0.0 && !compass[facing]) {
                    return false;
                }
            }
        }
        let tips: [Point; 4] = if square {
            [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]]
        } else {
            [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]]
        };
        (0..3).filter(|&i| p[i][0] != p[(i + 1) % 3][0] && p[i][1] != p[(i + 1) % 3][1]).all(|i| {
            let most = tips
                .iter()
                .map(|t| cross(p[i], p[(i + 1) % 3], [at[0] + t[0] * reach, at[1] + t[1] * reach]))
                .map(|side| side * area)
                .fold(f64::MIN, f64::max);
            most > 0.0 || (most == 0.0 && self.owns(p, i))
        })
    }
}

/// The eighth of the compass that a direction, y down, lies in: 0 is north.
fn compass_point([x, y]: Point) -> usize {
    let sign = |v: f64| if v == 0.0 { 0 } else { v.signum() as i32 };
    let points = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)];
    points.iter().position(|&point| point == (sign(x), sign(y))).unwrap()
}

/// Crossings in fixed point, as an edge list in 26.6 and 16.16 numbers steps them.
fn stepped(p: &[Point; 3], at: Point) -> bool {
    let mut crossings = Vec::new();
    for i in 0..3 {
        let (mut a, mut b) = (p[i], p[(i + 1) % 3]);
        if a[1] > b[1] {
            std::mem::swap(&mut a, &mut b);
        }
        if !(a[1] < at[1] && at[1] <= b[1]) {
            continue;
        }
        let slope = ((b[0] - a[0]) * 65536.0 / (b[1] - a[1])).trunc();
        // Rows from the first one below the upper end.
        let steps = ((at[1] - a[1]) / 256.0).ceil() - 1.0;
        let down_64 = (at[1] - a[1]) / 4.0 - steps * 64.0;
        let enter_64 = a[0] / 4.0 + (slope * down_64 / 65536.0).floor();
        crossings.push(enter_64 * 1024.0 + steps * slope);
    }
    let x = at[0] * 256.0;
    crossings.iter().any(|&c| c < x) && crossings.iter().any(|&c| x <= c)
}

/// The area of the triangle in the pixel's square: the polygon is cut at its four borders.
fn clipped_area(p: &[Point; 3], corner: Point) -> f64 {
    let mut polygon: Vec<Point> = p.iter().map(|c| [c[0] - corner[0], c[1] - corner[1]]).collect();
    for (axis, sign, limit) in [(0, 1.0, 0.0), (0, -1.0, 256.0), (1, 1.0, 0.0), (1, -1.0, 256.0)] {
        let inside = |c: &Point| sign * (c[axis] - limit);
        let mut cut = Vec::new();
        for (i, c) in polygon.iter().enumerate() {
            let next = polygon[(i + 1) % polygon.len()];
            let (s, t) = (inside(c), inside(&next));
            if s >= 0.0 {
                cut.push(*c);
            }
            if (s > 0.0) != (t > 0.0) && s != t {
                let k = s / (s - t);
                cut.push([c[0] + k * (next[0] - c[0]), c[1] + k * (next[1] - c[1])]);
            }
        }
        polygon = cut;
    }
    let n = polygon.len();
    let twice = (0..n).map(|i| {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        a[0] * b[1] - a[1] * b[0]
    });
    twice.sum::<f64>().abs() / 2.0
}

/// Whether pixel `at` is on the line from a to b: one pixel for each major step, the nearest.
pub fn on_line(a: Point, b: Point, at: Point, tie: LineTie) -> bool {
    let d = [b[0] - a[0], b[1] - a[1]];
    let (u, v) = if d[1].abs() > d[0].abs() { (1, 0) } else { (0, 1) };
    let along = at[u] - a[u];
    if along * d[u] < 0.0 || along.abs() > d[u].abs() {
        return false;
    }
    if d[u] == 0.0 {
        return at == a;
    }
    let ideal = a[v] + d[v] * along / d[u];
    let off = (at[v] - ideal).abs();
    if off != 0.5 {
        return off < 0.5;
    }
    // The other candidate lies across the line. Is this one farther along?
    let larger = at[v] > ideal;
    let farther_for = |forwards: bool| larger == ((d[v] > 0.0) == forwards);
    let from_left = if d[0] == 0.0 { d[1] > 0.0 } else { d[0] > 0.0 };
    match tie {
        LineTie::Up => larger,
        LineTie::Down => !larger,
        LineTie::Even => at[v] % 2.0 == 0.0,
        LineTie::UpperRight => larger == (u == 1),
        LineTie::LowerLeft => larger == (u == 0),
        LineTie::FirstGo => farther_for(true),
        LineTie::FirstStay => !farther_for(true),
        LineTie::LeftGo => farther_for(from_left),
        LineTie::LeftStay => !farther_for(from_left),
        LineTie::TopGo => farther_for(d[1] > 0.0),
        LineTie::TopStay => !farther_for(d[1] > 0.0),
        LineTie::SmallGo => farther_for(d[u] > 0.0),
        LineTie::SmallStay => !farther_for(d[u] > 0.0),
    }
}
