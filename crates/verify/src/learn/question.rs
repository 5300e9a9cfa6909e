//! Questions of either verb: what is asked first, beside another question, and at the border of a threshold.

use crate::convention::{LineQuestion, TriangleQuestion};
use rasterproof_core::geometry::greatest_divisor;
use rasterproof_core::random::Rng;

/// A triangle, with corners in subpixels, or a line, with ends in pixels; and the window it is drawn in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AnyQuestion {
    pub(super) points: Vec<[i64; 2]>,
    /// Width and height of the window.
    pub(super) side: [i32; 2],
}

impl AnyQuestion {
    pub(super) fn is_line(&self) -> bool {
        self.points.len() == 2
    }

    /// How many pixels its window has.
    pub(super) fn pixels(&self) -> usize {
        self.side.iter().map(|side| *side as usize).product()
    }

    /// Steps of a coordinate in a pixel.
    pub(super) fn one(&self) -> i64 {
        if self.is_line() { 1 } else { 256 }
    }

    pub(super) fn unit(&self) -> Unit {
        if self.is_line() { Unit::Pixels } else { Unit::Subpixels }
    }

    /// The smallest and the largest coordinate.
    pub(super) fn range(&self, axis: usize) -> [i64; 2] {
        let all = || self.points.iter().map(|point| point[axis]);
        [all().min().unwrap_or(0), all().max().unwrap_or(0)]
    }

    /// Width and height.
    pub(super) fn extent(&self) -> [i64; 2] {
        [0, 1].map(|axis| {
            let [least, most] = self.range(axis);
            most - least
        })
    }

    /// From one point to another.
    pub(super) fn side_of(&self, from: usize, to: usize) -> [i64; 2] {
        [0, 1].map(|axis| self.points[to][axis] - self.points[from][axis])
    }

    /// Positive where the corners of a triangle run clockwise with y down.
    pub(super) fn twice_area(&self) -> i64 {
        self.twice_area_in_order([0, 1, 2])
    }

    /// The same of the corners in another order.
    fn twice_area_in_order(&self, [a, b, c]: [usize; 3]) -> i64 {
        let ([to_b, down_b], [to_c, down_c]) = (self.side_of(a, b), self.side_of(a, c));
        to_b * down_c - down_b * to_c
    }

    /// Whether the middle corner lies left of the long edge, of corners from the top down.
    pub(super) fn middle_is_left(&self, [top, middle, bottom]: [usize; 3]) -> bool {
        self.twice_area_in_order([top, bottom, middle]) > 0
    }

    /// The numbers of the corners from the top down, of one height in the order given, as most programs sort them.
    pub(super) fn by_height(&self) -> [usize; 3] {
        let mut order = [0, 1, 2];
        order.sort_by_key(|i| self.points[*i][1]);
        order
    }

    /// The smallest n such that all coordinates of an axis are multiples of 1/n px.
    pub(super) fn fineness(&self, axis: usize) -> i64 {
        self.one()
            / self.points.iter().fold(self.one(), |g, point| greatest_divisor(g, point[axis]))
    }

    /// How it is asked for, such as 'T 1 8 8 0 0 4.5 0 0 3'.
    pub(super) fn request(&self) -> String {
        let verb = if self.is_line() { "L" } else { "T" };
        let mut text = format!("{verb} 1 {} {}", self.side[0], self.side[1]);
        for v in self.points.iter().flatten() {
            text += &format!(" {}", *v as f64 / self.one() as f64);
        }
        text
    }

    /// How large it is to read.
    pub(super) fn bulk(&self) -> i64 {
        let far = self.points.iter().flatten().map(|v| v.abs() / self.one()).sum::<i64>();
        far + i64::from(self.side[0]) + i64::from(self.side[1])
    }
}

impl From<&TriangleQuestion> for AnyQuestion {
    fn from(asked: &TriangleQuestion) -> Self {
        let points = asked.corners.map(|c| [c.x.into(), c.y.into()]).into();
        Self { points, side: [asked.window.x1, asked.window.y1] }
    }
}

impl From<&LineQuestion> for AnyQuestion {
    fn from(asked: &LineQuestion) -> Self {
        let points = asked.ends.map(|end| end.map(i64::from)).into();
        Self { points, side: [asked.window.x1, asked.window.y1] }
    }
}

/// What may be asked.
pub(super) struct Room {
    pub(super) rng: Rng,
    pub(super) is_line: bool,
    /// The largest window.
    pub(super) side: [i64; 2],
    /// Steps between neighbouring coordinates that may be asked.
    pub(super) grain: i64,
    /// The largest coordinate.
    pub(super) most: i64,
    /// The longest line that is asked, and whether most long lines are: where such lines are known to be wrong.
    pub(super) longest: i64,
    pub(super) is_far: bool,
}

/// Most long lines reach less than this power of two.
const MOST_LINES_REACH: u32 = 10;
/// The longest line that is asked where no longer one is known to be wrong, so that products of its sides need more than 32 bits: some programs walk each of its pixels.
pub(super) const LONGEST_LINE_PX: i64 = 1 << 17;

impl Room {
    /// Reaches as far as some questions that are known to be wrong.
    pub(super) fn reach(&mut self, failing: &[AnyQuestion]) {
        let all = failing.iter().flat_map(|question| question.points.as_flattened());
        let farthest = all.map(|v| v.abs()).max().unwrap_or(0);
        self.most = self.most.max(farthest);
        self.longest = self.longest.max(4 * farthest);
        self.is_far = self.is_line && farthest >> MOST_LINES_REACH > 0;
    }

    fn one(&self) -> i64 {
        if self.is_line { 1 } else { 256 }
    }

    /// A window, most of them small.
    fn window(&mut self) -> [i32; 2] {
        let rng = &mut self.rng;
        let some = |rng: &mut Rng| [rng.int(1, 26), rng.int(1, 26)];
        let side = match rng.int(0, 19) {
            0 => [rng.int(30, 128), rng.int(1, 8)],
            1 => [rng.int(1, 8), rng.int(30, 128)],
            2 => [rng.int(24, 48), rng.int(24, 48)],
            3 => [4 * rng.int(1, 8), 4 * rng.int(1, 8)],
            _ => some(rng),
        };
        [0, 1].map(|axis| side[axis].clamp(1, self.side[axis]) as i32)
    }

    /// A question of a mixture: small and large windows, tiny, thin and level shapes, ties, and shapes that reach far.
    pub(super) fn question(&mut self) -> AnyQuestion {
        let side = self.window();
        let near = [0, 0, 0, 2, 6, 30][self.rng.int(0, 5) as usize];
        let points = match (self.rng.chance(4), self.is_line) {
            (true, _) => self.far(side),
            (_, true) => self.line(side, near),
            (_, false) => self.triangle(side, near),
        };
        let mut question = AnyQuestion { points, side };
        if self.is_line {
            let longest = self.longest;
            let near = |v: i64| v.clamp(-longest / 2, longest / 2);
            question.points.iter_mut().for_each(|point| *point = point.map(near));
        }
        self.fitted(question)
    }

    /// A point up to so many pixels beyond the window, on a grid of so many steps to a pixel.
    fn point(&mut self, side: [i32; 2], reach: i64, steps: i64) -> [i64; 2] {
        [0, 1].map(|axis| {
            let high = i64::from(side[axis]) - i64::from(self.is_line) + reach;
            self.rng.int(-reach * steps, high * steps) * self.one() / steps
        })
    }

    /// A shape with an edge through the window that reaches far beyond it, each power of two as often as another.
    fn far(&mut self, side: [i32; 2]) -> Vec<[i64; 2]> {
        let one = self.one();
        let mut most = (self.most / one / 2).max(32).ilog2();
        if self.is_line && !self.is_far && !self.rng.chance(8) {
            most = most.min(MOST_LINES_REACH);
        }
        let reach = one << self.rng.int(5, most.into());
        let steps = if self.rng.chance(2) { one } else { 1 };
        let off =
            |room: &mut Self| [0; 2].map(|_| room.rng.int(-reach / steps, reach / steps) * steps);
        let at = self.point(side, 0, 1);
        let (ahead, aside) = (off(self), off(self));
        // Often the edge ends in the window.
        let back = if self.rng.chance(3) { 0 } else { self.rng.int(0, 256) };
        let mut points = vec![
            [0, 1].map(|axis| at[axis] + ahead[axis]),
            [0, 1].map(|axis| at[axis] - ahead[axis] * back / 256 / steps * steps),
        ];
        if !self.is_line {
            let third = [0, 1].map(|axis| at[axis] + aside[axis]);
            points.push(if self.rng.chance(3) { self.point(side, 4, 1) } else { third });
        }
        let turn = self.rng.int(0, points.len() as i64 - 1) as usize;
        points.rotate_left(turn);
        points
    }

    fn line(&mut self, side: [i32; 2], reach: i64) -> Vec<[i64; 2]> {
        let [from, mut to] = [0; 2].map(|_| self.point(side, reach, 1));
        match self.rng.int(0, 12) {
            0 | 1 => to[1] = from[1],
            2 | 3 => to[0] = from[0],
            4 | 5 => {
                let by = self.rng.int(-9, 9);
                to = [from[0] + by, from[1] + if self.rng.chance(2) { by } else { -by }];
            }
            _ => {}
        }
        vec![from, to]
    }

    fn triangle(&mut self, side: [i32; 2], reach: i64) -> Vec<[i64; 2]> {
        let most = 256 / self.grain.min(256);
        let steps = [1, 1, 2, 2, 4, 16, 256, 256][self.rng.int(0, 7) as usize].min(most);
        let mut p = [0; 3].map(|_| self.point(side, reach, steps));
        match self.rng.int(0, 19) {
            // Tiny.
            0..=2 => {
                for i in [1, 2] {
                    p[i] = p[0].map(|v| v + self.rng.int(-2 * steps, 2 * steps) * 256 / steps);
                }
            }
            // Level or upright edges.
            3 | 4 => p[1][1] = p[0][1],
            5 | 6 => p[1][0] = p[0][0],
            // Thin.
            7 | 8 => {
                p[2] = [0, 1].map(|i| (p[0][i] + p[1][i]) / 2 + self.rng.int(-1, 1) * 256 / steps)
            }
            // Samples on edges.
            9 | 10 if steps > 1 => p = p.map(|point| point.map(|v| v.div_euclid(256) * 256 + 128)),
            _ => {}
        }
        let turn = self.rng.int(0, 2) as usize;
        p.rotate_left(turn);
        p.into()
    }

    /// The same on the grid and in the range that may be asked.
    fn fitted(&self, mut q: AnyQuestion) -> AnyQuestion {
        let fit = |v: i64| (v.div_euclid(self.grain) * self.grain).clamp(-self.most, self.most);
        q.points.iter_mut().for_each(|point| *point = point.map(fit));
        q
    }

    /// Whether a question keeps to the grid, the range and the largest window.
    pub(super) fn may_ask(&self, q: &AnyQuestion) -> bool {
        let is_small = (0..2).all(|axis| i64::from(q.side[axis]) <= self.side[axis]);
        is_small && self.fitted(q.clone()) == *q
    }

    /// A question that differs from another one in little.
    pub(super) fn beside(&mut self, q: &AnyQuestion) -> AnyQuestion {
        let mut q = q.clone();
        for _ in 0..self.rng.int(1, 2) {
            self.change(&mut q);
        }
        self.fitted(q)
    }

    fn change(&mut self, q: &mut AnyQuestion) {
        match self.rng.int(0, 19) {
            kind @ 0..=5 => {
                let axis = (kind % 2) as usize;
                let by = [-1, 1, 2, 4][self.rng.int(0, 3) as usize];
                let most = self.side[axis];
                q.side[axis] = (i64::from(q.side[axis]) + by).clamp(1, most) as i32;
            }
            6 | 7 => {
                let by = if self.rng.chance(2) { self.one() } else { -self.one() };
                q.points.iter_mut().for_each(|point| *point = point.map(|v| v + by));
            }
            8 | 9 => q.points.swap(0, 1),
            _ => {
                let corner = self.rng.int(0, q.points.len() as i64 - 1) as usize;
                let axis = self.rng.int(0, 1) as usize;
                let by = match self.is_line {
                    true => [1, 1, 2, 5][self.rng.int(0, 3) as usize],
                    false => 1 << self.rng.int(0, 10),
                };
                let by = by.max(self.grain);
                q.points[corner][axis] += if self.rng.chance(2) { by } else { -by };
            }
        }
    }
}

/// The first pixel whose sample does not lie before a place, both in subpixels.
pub(super) fn first_sample(place: i64, sample: i64) -> i64 {
    -(sample - place).div_euclid(256)
}

/// How a quantity is tested and printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// 1 or 0.
    Flag,
    /// Pixels, rows or other things that are counted.
    Count,
    /// A count that is compared with the others of its kind.
    Paired,
    /// A count that takes many words.
    Involved,
    /// Whole pixels.
    Pixels,
    /// 1/256 px.
    Subpixels,
    /// The same of what lies on no grid.
    Length,
    /// 1/65,536 of a square pixel.
    Area,
    /// 1/256.
    Ratio,
    /// 1/2^20 of a value.
    Value,
}
