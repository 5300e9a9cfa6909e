//! What a program is asked when it is wrong: triangles and lines of every kind in which mistakes differ.

use crate::convention::{Declarations, LineQuestion, TriangleQuestion};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Corners;

/// The largest side of a window that is asked for, in pixels.
pub(super) const SIDE_PX: i32 = 32;
/// How many triangles are asked for at once.
const TRIANGLES: usize = 1200;
pub(super) const LINES: usize = 700;
/// The longest line: some programs walk each pixel of it.
pub(super) const LONGEST_PX: i64 = 40_000;

/// Where coordinates may lie.
pub(super) struct Room {
    /// The same numbers for the same seed.
    pub(super) rng: Rng,
    /// The sides of the largest window, in pixels.
    pub(super) side: [u32; 2],
    /// Subpixels between neighbouring coordinates.
    pub(super) grain: i64,
    /// The farthest coordinate, in pixels.
    pub(super) range_px: i64,
}

impl Room {
    /// What a program can be asked, by what is declared of it.
    pub(super) fn new(known: &Declarations, seed: u64) -> Self {
        let grid = known.grid.clamp(1, SUBPIXELS);
        let grain = if SUBPIXELS % grid == 0 { SUBPIXELS / grid } else { SUBPIXELS };
        let (width, height) = known.window_px;
        let side = [width, height].map_array(|side| side.clamp(1, SIDE_PX as u32));
        let range_px = i64::from(known.range_px.max(1));
        Self { rng: Rng::new("mistakes", seed, 0), side, grain: grain.into(), range_px }
    }

    /// Every third window is smaller than the largest, so that a border lies elsewhere.
    fn window(&mut self, number: usize) -> PixelRect {
        let [width, height] = self.side;
        if number % 3 == 0 {
            let [w, h] = [width, height].map_array(|side| {
                let least = i64::from(side / 2).max(1);
                self.rng.int(least, side.into()) as u32
            });
            return PixelRect::window(w, h);
        }
        PixelRect::window(width, height)
    }

    /// The nearest coordinate that may be asked.
    fn place(&self, sub: i64) -> i32 {
        let most = self.range_px.min(1 << 22) * i64::from(SUBPIXELS);
        let on_grid = (sub + self.grain / 2).div_euclid(self.grain) * self.grain;
        // Within 2^30 by `most`.
        on_grid.clamp(-most, most) as i32
    }

    /// The nearest point that may be asked.
    pub(super) fn point(&self, [x, y]: [i64; 2]) -> SubpixelPoint {
        SubpixelPoint::new(self.place(x), self.place(y))
    }

    /// Anywhere between two positions in pixels.
    fn within(&mut self, low_px: i64, high_px: i64) -> i64 {
        self.rng.int(low_px * 256, high_px * 256)
    }

    /// A point of a window, in subpixels.
    pub(super) fn inside(&mut self, window: PixelRect) -> [i64; 2] {
        [self.within(0, window.x1.into()), self.within(0, window.y1.into())]
    }

    /// A point within so many pixels of another one along each axis.
    fn near(&mut self, [x, y]: [i64; 2], reach_px: i64) -> [i64; 2] {
        [x + self.within(-reach_px, reach_px), y + self.within(-reach_px, reach_px)]
    }

    /// A length of 2^6 px to the end of the range, each power of two as often as another.
    fn far(&mut self) -> i64 {
        let most = (self.range_px / 2).clamp(64, 1 << 20).ilog2();
        let power = self.rng.int(6, i64::from(most));
        self.within(1 << (power - 1), 1 << power)
    }

    /// A vector of length 1.
    fn direction(&mut self) -> [f64; 2] {
        let [x, y] = [0, 0].map_array(|_| self.rng.int(-1000, 1000) as f64);
        let length = (x * x + y * y).sqrt();
        if length == 0.0 { [1.0, 0.0] } else { [x / length, y / length] }
    }

    /// The ends of an edge that passes a sample of the window so closely that the edge function there is a small number. The
    /// sides of its box are given in steps of the grid, and which part of it lies before the sample.
    pub(super) fn beside(
        &mut self,
        window: PixelRect,
        sample: [i32; 2],
        edge: [i64; 2],
        part: f64,
    ) -> [[i64; 2]; 2] {
        let edge = if edge == [0, 0] { [1, 0] } else { edge };
        let pixel = [window.x1, window.y1].map_array(|side| self.rng.int(0, i64::from(side) - 1));
        let at = [0, 1].map_array(|i| pixel[i] * i64::from(SUBPIXELS) + i64::from(sample[i]));
        // An offset from the sample to the edge, so that the edge function is `wanted` steps of the grid: u x + v y = g.
        let Bezout { g, u, v } = bezout(edge[0], edge[1]);
        let wanted = self.rng.int(-4, 4) * self.rng.int(1, 64);
        let times = wanted.div_euclid(g).clamp(-4000, 4000);
        // Moved along the edge until the sample lies where it is wanted.
        let off = [-v * times, u * times];
        let [dx, dy] = [edge[0] as f64, edge[1] as f64];
        let ahead = (dx * off[0] as f64 + dy * off[1] as f64) / (dx * dx + dy * dy);
        let steps = ((part - ahead) * g as f64).round() as i64;
        let from = [0, 1].map_array(|i| at[i] - (off[i] + steps * (edge[i] / g)) * self.grain);
        [from, [0, 1].map_array(|i| from[i] + edge[i] * self.grain)]
    }

    /// A point in a direction from another one.
    fn away(&mut self, [x, y]: [i64; 2], [dx, dy]: [f64; 2], length: i64) -> [i64; 2] {
        [x + (dx * length as f64) as i64, y + (dy * length as f64) as i64]
    }
}

/// The same questions for the same seed and declaration. The kinds take turns, so that a part of them has all.
pub(super) fn triangles(
    known: &Declarations,
    sample: [i32; 2],
    seed: u64,
) -> Vec<TriangleQuestion> {
    let mut room = Room::new(known, seed);
    let mut questions = Vec::with_capacity(TRIANGLES);
    for number in 0..TRIANGLES {
        let window = room.window(number);
        let mut corners = triangle(&mut room, window, sample, number % 10);
        // Half of them turn the other way.
        if room.rng.chance(2) {
            corners.swap(1, 2);
        }
        questions.push(TriangleQuestion { corners, window });
    }
    questions
}

/// A triangle of one of the ten kinds.
fn triangle(room: &mut Room, window: PixelRect, sample: [i32; 2], kind: usize) -> Corners {
    let points: [[i64; 2]; 3] = match kind {
        // Samples very near an edge.
        0 => near_tie(room, window, sample),
        // Ties: corners on halves of pixels, with samples on edges.
        1 | 2 => {
            let at = room.inside(window);
            let to = if kind == 1 { 128 } else { 256 };
            [0; 3].map_array(|_| aligned(room.near(at, 8), to))
        }
        // A level or an upright edge.
        3 => {
            let [a, [x, y], c] = [0; 3].map_array(|_| room.inside(window));
            if room.rng.chance(2) { [a, [x, a[1]], c] } else { [a, [a[0], y], c] }
        }
        // Small ones.
        4 => {
            let at = room.inside(window);
            let reach = room.rng.int(1, 4);
            [0; 3].map_array(|_| room.near(at, reach))
        }
        // Thin ones.
        5 if room.rng.chance(2) => {
            let [a, b] = [0; 2].map_array(|_| room.inside(window));
            let middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
            [a, b, room.near(middle, 1)]
        }
        // Such as leave the window.
        6 => [0; 3].map_array(|_| {
            let (wide, high) = (i64::from(window.x1), i64::from(window.y1));
            [room.within(-wide, 2 * wide), room.within(-high, 2 * high)]
        }),
        // Large ones with a sample very near an edge.
        8 => {
            let edge = [0; 2].map_array(|_| room.far() / room.grain);
            let edge = edge.map_array(|side| if room.rng.chance(2) { side } else { -side });
            let part = [0.0, 1.0, room.rng.unit()][room.rng.int(0, 2) as usize];
            let [a, b] = room.beside(window, sample, edge, part);
            let side = room.direction();
            let off = room.far();
            [a, b, room.away(a, side, off)]
        }
        // Large ones with an edge through the window.
        7 => {
            let at = room.inside(window);
            let along = room.direction();
            let [ahead, back, off] = [0; 3].map_array(|_| room.far());
            let side = room.direction();
            let a = room.away(at, along, ahead);
            let b = room.away(at, along, -back);
            [a, b, room.away(at, side, off)]
        }
        // Halves of rectangles, on whole pixels or not.
        9 => {
            let to = if room.rng.chance(2) { 256 } else { 1 };
            let [[x0, y0], [x1, y1]] = [0; 2].map_array(|_| aligned(room.inside(window), to));
            let all = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
            let left_out = room.rng.int(0, 3) as usize;
            [1, 2, 3].map_array(|i| all[(left_out + i) % 4])
        }
        _ => [0; 3].map_array(|_| room.inside(window)),
    };
    points.map_array(|point| room.point(point))
}

/// A point on multiples of a step.
fn aligned([x, y]: [i64; 2], to: i64) -> [i64; 2] {
    [x.div_euclid(to) * to, y.div_euclid(to) * to]
}

/// A triangle with an edge that passes a sample so closely that the edge function there is a small number.
fn near_tie(room: &mut Room, window: PixelRect, sample: [i32; 2]) -> [[i64; 2]; 3] {
    let grain = room.grain;
    let edge = [0; 2].map_array(|_| room.rng.int(-2000 / grain, 2000 / grain));
    let [from, to] = room.beside(window, sample, edge, 0.5);
    let third = room.near([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], 12);
    [from, to, third]
}

/// Numbers with u a + v b = g, the greatest common divisor of a and b, not negative.
struct Bezout {
    g: i64,
    u: i64,
    v: i64,
}

/// By Euclid's algorithm, backwards from the last remainder.
fn bezout(a: i64, b: i64) -> Bezout {
    if b == 0 {
        return Bezout { g: a.abs(), u: a.signum(), v: 0 };
    }
    let Bezout { g, u, v } = bezout(b, a % b);
    Bezout { g, u: v, v: u - a / b * v }
}

/// The same for lines; ends are pixels.
pub(super) fn lines(known: &Declarations, seed: u64) -> Vec<LineQuestion> {
    let mut room = Room::new(known, seed ^ 1);
    let mut questions = Vec::with_capacity(LINES);
    for number in 0..LINES {
        let window = room.window(number);
        questions.push(LineQuestion { ends: line(&mut room, window, number), window });
    }
    questions
}

/// A line of one of the eight kinds.
fn line(room: &mut Room, window: PixelRect, number: usize) -> [[i32; 2]; 2] {
    let (wide, high) = (i64::from(window.x1), i64::from(window.y1));
    let inside = |room: &mut Room| [room.rng.int(0, wide - 1), room.rng.int(0, high - 1)];
    let from = inside(room);
    let ends: [[i64; 2]; 2] = match number % 8 {
        // Level, upright, or a whole diagonal.
        0 => {
            let to = inside(room);
            let by = room.rng.int(-wide.min(high) / 2, wide.min(high) / 2);
            [
                from,
                [[to[0], from[1]], [from[0], to[1]], [from[0] + by, from[1] + by]][number / 8 % 3],
            ]
        }
        // Such as leave the window at one end, or at both.
        1 | 2 => [from, [room.rng.int(-wide, 2 * wide), room.rng.int(-high, 2 * high)]],
        3 => [0; 2].map_array(|_| [room.rng.int(-wide, 2 * wide), room.rng.int(-high, 2 * high)]),
        // Long ones; few, as some programs walk along each pixel.
        4 => {
            let most = if number % 16 == 4 { LONGEST_PX } else { 2000 };
            let along = room.direction();
            let longest = most.min(room.range_px / 2);
            let [ahead, back] = [0; 2].map_array(|_| room.far().div_euclid(256).min(longest));
            // Half of them begin inside.
            let back = if room.rng.chance(2) { 0 } else { back };
            [-back, ahead].map_array(|length| {
                [0, 1].map_array(|i| from[i] + (along[i] * length as f64).round() as i64)
            })
        }
        _ => [from, inside(room)],
    };
    // Ends that may be asked.
    let most = room.range_px.min(1 << 22);
    // Within 2^22.
    ends.map_array(|end| end.map_array(|v| v.clamp(-most, most - 1) as i32))
}
