//! The questions that need no hypothesis: triangles in general position, edges that are moved until
//! a pixel flips, orders of the corners, triangles without area.

use super::Count;
use super::bench::{Bench, TriangleAnswer};
use super::rule::Windings;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{ORDERS, twice_area};
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;

/// The corners in an order that is drawn.
pub(super) fn drawable(mut corners: Corners, draws: Windings) -> Corners {
    if !draws.draws(twice_area(&corners) > 0) {
        corners.swap(1, 2);
    }
    corners
}

impl Bench<'_> {
    /// A triangle with an area, in the window: large, small or thin.
    pub(super) fn general(&mut self) -> Corners {
        let side = self.side();
        loop {
            let kind = self.rng.int(0, 5);
            // Half of them may be as large as the window.
            let size = if kind < 3 { side - 2 } else { 7 };
            let at = [self.coordinate(1, side - 1 - size), self.coordinate(1, side - 1 - size)];
            let mut corners = [SubpixelPoint::new(0, 0); 3];
            for corner in &mut corners {
                *corner = SubpixelPoint::new(
                    at[0] + self.coordinate(0, size),
                    at[1] + self.coordinate(0, size),
                );
            }
            if kind == 5 {
                // Thin: the third corner near the middle of the first two.
                let near = |a: i32, b: i32| (a / 2 + b / 2) / 256 * 256;
                let [a, b, _] = corners;
                let off = [self.coordinate(0, 1), self.coordinate(0, 1)];
                corners[2] = SubpixelPoint::new(near(a.x, b.x) + off[0], near(a.y, b.y) + off[1]);
            }
            if twice_area(&corners) != 0 {
                return corners;
            }
        }
    }

    /// As many answers to triangles in general position, of a winding that is drawn.
    pub(super) async fn generals(&mut self, count: usize, draws: Windings) -> Vec<TriangleAnswer> {
        let mut questions = Vec::with_capacity(count);
        for _ in 0..count {
            questions.push(drawable(self.general(), draws));
        }
        // Half of them are turned where both windings are drawn.
        for corners in &mut questions {
            if draws == Windings::Both && self.rng.chance(2) {
                *corners = turned(*corners);
            }
        }
        self.draw(&questions).await
    }

    /// Which windings leave pixels, and what they leave.
    pub(super) async fn windings(&mut self) -> (Windings, Vec<TriangleAnswer>) {
        let (mut drawn, mut all) = ([0, 0], Vec::new());
        // Clockwise ones that cover some samples, wherever these lie.
        let mut fat = Vec::new();
        while fat.len() < 10 {
            let corners = drawable(self.general(), Windings::Clockwise);
            if twice_area(&corners) > 20 * 65536 {
                fat.push(corners);
            }
        }
        for drawn in &mut drawn {
            let answers = self.draw(&fat).await;
            *drawn = count_drawn(&answers);
            all.extend(answers);
            for corners in &mut fat {
                *corners = turned(*corners);
            }
        }
        // A winding counts as drawn if more than a quarter of these triangles leave a pixel.
        let draws = match drawn.map_array(|count| count > fat.len() / 4) {
            [true, true] => Windings::Both,
            [true, false] => Windings::Clockwise,
            [false, true] => Windings::CounterClockwise,
            [false, false] => Windings::Neither,
        };
        (draws, all)
    }

    /// How often triangles without area leave pixels: points, segments, and corners on one line.
    pub(super) async fn flat(&mut self) -> Count {
        let mut questions = Vec::new();
        for i in 0..30 {
            let [x, y, dx, dy] = [(4, 10), (4, 10), (-2, 2), (-2, 2)]
                .map_array(|(low, high)| self.rng.int(low, high) as i32 * 256);
            // Where the grid allows, half of them run through centres.
            let half = if self.grain <= 128 && i % 2 == 0 { 128 } else { 0 };
            let at = |n: i32| SubpixelPoint::new(x + n * dx + half, y + n * dy + half);
            questions.push(match i % 3 {
                0 => [at(0); 3],
                1 => [at(0), at(2), at(0)],
                _ => [at(0), at(1), at(2)],
            });
        }
        let answers = self.draw(&questions).await;
        Count { drawn: count_drawn(&answers) as u64, of: answers.len() as u64 }
    }
}

/// How many answers have a pixel.
fn count_drawn(answers: &[TriangleAnswer]) -> usize {
    answers.iter().filter(|answer| !answer.drawn.is_empty()).count()
}

/// The same triangle of the other winding.
fn turned([a, b, c]: Corners) -> Corners {
    [a, c, b]
}

/// Between which positions of an upright or level edge a pixel flips, in subpixels from the pixel's
/// upper left corner. At `low` the pixel is still what it was at the start, at `high` no more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flip {
    pub(super) low: i32,
    pub(super) high: i32,
}

/// The four edges of a triangle that can be upright or level.
const EDGES: [(usize, bool); 4] = [(0, true), (0, false), (1, true), (1, false)];

/// The pixel that is watched, both column and row.
fn watched(side: i32) -> i32 {
    side / 2
}

/// A triangle whose edge at `at` (from the watched pixel) is upright (axis 0) or level (axis 1); the
/// rest of it lies on the far side if it is its left or upper edge (`first`), else on the near side.
fn with_edge(side: i32, (axis, first): (usize, bool), at: i32) -> Corners {
    let px = |v: i32| v * 256;
    let along = px(watched(side)) + at;
    let far = if first { px(side - 2) } else { px(2) };
    let corners = [[along, px(2)], [along, px(side - 2)], [far, px(side / 2)]];
    corners.map_array(
        |[u, v]| if axis == 0 { SubpixelPoint::new(u, v) } else { SubpixelPoint::new(v, u) },
    )
}

impl Bench<'_> {
    /// Whether the watched pixel is drawn where the four edges are at these positions; nothing where that is refused.
    async fn watch(&mut self, draws: Windings, at: [i32; 4]) -> [Option<bool>; 4] {
        let side = self.side();
        let list: Vec<_> =
            (0..4).map(|i| drawable(with_edge(side, EDGES[i], at[i]), draws)).collect();
        let answers = self.draw_all(&list).await;
        [0, 1, 2, 3]
            .map_array(|i| answers[i].map(|answer| answer.drawn.has(watched(side), watched(side))))
    }

    /// Where the watched pixel flips as its left, right, upper and lower edge is moved; None where
    /// it does not.
    pub(super) async fn flips(&mut self, draws: Windings) -> [Option<Flip>; 4] {
        let grain = self.grain;
        // From far before the pixel to far behind it; then the interval is halved.
        let mut flips = [Flip { low: -512, high: 768 }; 4];
        let start = self.watch(draws, flips.map_array(|f| f.low)).await;
        let end = self.watch(draws, flips.map_array(|f| f.high)).await;
        while flips.iter().any(|flip| flip.high - flip.low > grain) {
            let middle = flips.map_array(|f| (f.low + f.high).div_euclid(2 * grain) * grain);
            let seen = self.watch(draws, middle).await;
            for (i, flip) in flips.iter_mut().enumerate().filter(|(_, f)| f.high - f.low > grain) {
                // A refusal decides nothing in particular.
                if seen[i] == start[i] {
                    flip.low = middle[i];
                } else {
                    flip.high = middle[i];
                }
            }
        }
        [0, 1, 2, 3].map_array(|i| (start[i] != end[i] && end[i].is_some()).then_some(flips[i]))
    }

    /// Whether answers depend on the order of the corners: of `triangles` in all orders, those that
    /// change when the corners are rotated, and those that change when the winding is reversed.
    pub(super) async fn orders(&mut self, triangles: &[Corners], draws: Windings) -> [Count; 2] {
        let count = if draws == Windings::Both { 6 } else { 3 };
        let mut list = Vec::new();
        for t in triangles {
            for order in &ORDERS[..count] {
                list.push(order.map_array(|i| t[i]));
            }
        }
        let answers = self.draw_all(&list).await;
        let mut changed = [Count::default(); 2];
        for group in answers.chunks_exact(count) {
            let drawn: Vec<_> = group.iter().flatten().map(|answer| answer.drawn).collect();
            if drawn.len() < count {
                continue;
            }
            // The first three orders are rotations, and the others have the other winding.
            changed[0].add(drawn[..3].iter().any(|mask| *mask != drawn[0]));
            if count == 6 {
                let backwards = [(0, 3), (1, 4), (2, 5)];
                changed[1].add(backwards.iter().any(|&(a, b)| drawn[a] != drawn[b]));
            }
        }
        changed
    }
}
