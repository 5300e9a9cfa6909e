//! Facts of a question about which of several triangles is seen.

use glam::DVec2;

use rasterproof_core::geometry::{centre, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

use super::{Read, Test, Topic, Unit, exponent, fact, facts_of, numbers, share};
use crate::cases::{Case, Limits, Shape, Triangle};

/// Triangles before and behind each other.
pub const TOPIC: Topic = Topic {
    name: "depth-design",
    facts: &facts_of(&FACTS),
    measure: |case, _| Some(numbers(&FACTS, &PileFacts::of_case(case)?)),
    impossible: include_str!("impossible/depth-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

/// The most triangles that the line protocol has in one question.
const MOST: i64 = 64;
const SIDES: Test = Test::Steps(&[2, 3, 9, 17]);
const PILED: Test = Test::Steps(&[2, 3, 5, 9, 17, 33]);
const PX: i64 = SUBPIXELS as i64;
const EXTENT: Test = Test::Steps(&[2 * PX, 8 * PX, 24 * PX]);
const SOME: Test = Test::Choice(&["none", "some", "all"]);

/// The facts that the design covers.
const FACTS: [Read<PileFacts>; 19] = [
    fact("triangles", Unit::Count, |m| m.count, Test::Steps(&[2, 3, 5, 9, 17, 33, 64])),
    fact("triangles that cover one of 16 pixels", Unit::Count, |m| m.piled, PILED),
    fact("triangles whose boxes meet one block of 8 x 8 px", Unit::Count, |m| m.in_block, PILED),
    fact("the width of the window", Unit::Pixels, |m| m.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.window[1], SIDES),
    fact("the width of the window in pixels", Unit::Count, |m| m.window[0], Test::Divisor),
    fact("the height of the window in pixels", Unit::Count, |m| m.window[1], Test::Divisor),
    fact(
        "the order of mean depths",
        Unit::Count,
        |m| m.order,
        Test::Choice(&["of one alone", "near to far", "far to near", "neither", "all the same"]),
    ),
    fact("triangles with the same depths as another", Unit::Count, |m| m.equal, SOME),
    fact("triangles whose depth is not the same everywhere", Unit::Count, |m| m.leaning, SOME),
    fact("clockwise triangles", Unit::Count, |m| m.clockwise, SOME),
    fact("the largest extent of a triangle", Unit::Subpixels, |m| m.largest, EXTENT),
    fact("the smallest extent of a triangle", Unit::Subpixels, |m| m.smallest, EXTENT),
    fact("triangles that the window cuts", Unit::Count, |m| m.cut, SOME),
    fact(
        "the smallest difference of mean depths",
        Unit::Doublings,
        |m| m.closest,
        Test::Steps(&[-20, -12, -6]),
    ),
    fact("depths 0 and 1", Unit::Count, |m| m.ends, Test::Choice(&["neither", "0", "1", "both"])),
    fact(
        "a triangle that covers all samples of the window but one row or column at its border",
        Unit::Count,
        |m| m.leaves_open,
        Test::Choice(&["none", "all but the first", "all but the last"]),
    ),
    fact(
        "a triangle behind one that leaves a row or column at the border open, and reaches into it",
        Unit::Count,
        |m| m.reaches_beyond,
        Test::Choice(&["none", "drawn before it", "drawn after it"]),
    ),
    fact(
        "a triangle that is drawn last and seen",
        Unit::Count,
        |m| m.last_is_nearest,
        Test::Choice(&["no", "the last is nearest"]),
    ),
];

/// What was measured of some triangles in their window.
pub struct PileFacts {
    /// How many there are.
    pub count: i64,
    /// The most that cover one of at most 4 x 4 samples, evenly spread.
    pub piled: i64,
    /// The most whose boxes meet the same block.
    pub in_block: i64,
    /// Sides of the window in pixels.
    pub window: [i64; 2],
    /// How the means of depths follow each other in the order of drawing.
    pub order: i64,
    /// How many have the depths of another, at all three corners: none, some, all. Likewise the next three.
    pub equal: i64,
    /// Those with different depths at their corners.
    pub leaning: i64,
    /// Those that run clockwise on the screen.
    pub clockwise: i64,
    /// Those with a corner outside the window.
    pub cut: i64,
    /// The longer side of the largest box, and of the smallest one, in steps of the lattice.
    pub largest: i64,
    /// See `largest`.
    pub smallest: i64,
    /// The logarithm of the smallest difference of means that is not 0; 0 where all are the same.
    pub closest: i64,
    /// Which ends of the range of depths occur.
    pub ends: i64,
    /// Whether no triangle has a smaller mean than the last one.
    pub last_is_nearest: i64,
    /// Whether a triangle covers all samples but those of the last row or column (2), or one all but those of the first (1).
    pub leaves_open: i64,
    /// Whether one that is farther than such a triangle reaches into what it leaves open, and is drawn after it (2) or before it (1).
    pub reaches_beyond: i64,
}

impl PileFacts {
    /// Of a case of triangles.
    #[must_use]
    pub fn of_case(case: &Case) -> Option<Self> {
        let list: Vec<Layer> = case.triangles().iter().map(Layer::of).collect();
        let last = list.last()?.mean;
        let window = [i64::from(case.window.width()), i64::from(case.window.height())];
        let mut measured = Self {
            count: list.len() as i64,
            piled: piled(&list, case.window),
            in_block: in_block(&list, window),
            window,
            order: order(&list),
            equal: share(equal(&list), list.len()),
            leaning: 0,
            clockwise: 0,
            cut: 0,
            largest: 0,
            smallest: i64::MAX,
            closest: closest(&list),
            ends: 0,
            last_is_nearest: i64::from(list.len() > 1),
            leaves_open: 0,
            reaches_beyond: 0,
        };
        let (mut leaning, mut clockwise, mut cut) = (0, 0, 0);
        for layer in &list {
            let [a, b, c] = layer.depths;
            leaning += usize::from(a != b || b != c);
            clockwise += usize::from(layer.is_clockwise);
            cut += usize::from(layer.is_cut(window));
            let extent = (layer.high[0] - layer.low[0]).max(layer.high[1] - layer.low[1]);
            measured.largest = measured.largest.max(extent);
            measured.smallest = measured.smallest.min(extent);
            // Bit 0 where depth 0 occurs, bit 1 for depth 1.
            measured.ends |= i64::from(layer.depths.contains(&0.0));
            measured.ends |= 2 * i64::from(layer.depths.contains(&1.0));
            measured.last_is_nearest &= i64::from(layer.mean >= last);
        }
        measured.leaning = share(leaning, list.len());
        measured.clockwise = share(clockwise, list.len());
        measured.cut = share(cut, list.len());
        measured.note_open_borders(&list, [case.window.x1, case.window.y1]);
        Some(measured)
    }

    /// Notes whether a triangle leaves a border of the window open, and whether another one, all of which is farther, reaches into
    /// that border.
    fn note_open_borders(&mut self, list: &[Layer], sides: [i32; 2]) {
        for (front, layer) in list.iter().enumerate() {
            let Some(Open { axis, is_last }) = layer.leaves_open(sides) else { continue };
            self.leaves_open = self.leaves_open.max(1 + i64::from(is_last));
            let farthest = layer.depths.into_iter().fold(0.0, f64::max);
            // The samples that are open, and their neighbours, which are covered.
            let last = sides[axis] - 1;
            let [from, to] = if is_last { [last - 1, last] } else { [0, 1] }.map(centre);
            for (i, other) in list.iter().enumerate() {
                let Layer { depths, low, high, .. } = other;
                let is_behind = depths.iter().all(|depth| *depth > farthest);
                let is_in = low[1 - axis] < i64::from(sides[1 - axis]) * PX && high[1 - axis] > 0;
                if is_behind && is_in && low[axis] <= from && high[axis] >= to {
                    self.reaches_beyond = self.reaches_beyond.max(if i > front { 2 } else { 1 });
                }
            }
        }
    }
}

/// A triangle of a pile, measured once.
struct Layer {
    corners: [[i64; 2]; 3],
    /// The least and the largest coordinates.
    low: [i64; 2],
    high: [i64; 2],
    depths: [f64; 3],
    mean: f64,
    is_clockwise: bool,
}

impl Layer {
    fn of(triangle: &Triangle) -> Self {
        let mut layer = Self {
            corners: [[0; 2]; 3],
            low: [i64::MAX; 2],
            high: [i64::MIN; 2],
            depths: [0.0; 3],
            mean: 0.0,
            is_clockwise: twice_area(&triangle.corners()) > 0,
        };
        for (at, vertex) in triangle.vertices.iter().enumerate() {
            let corner = [i64::from(vertex.position.x), i64::from(vertex.position.y)];
            for (axis, v) in corner.into_iter().enumerate() {
                layer.low[axis] = layer.low[axis].min(v);
                layer.high[axis] = layer.high[axis].max(v);
            }
            layer.corners[at] = corner;
            layer.depths[at] = vertex.depth;
            layer.mean += vertex.depth;
        }
        layer.mean /= 3.0;
        layer
    }

    fn is_cut(&self, window: [i64; 2]) -> bool {
        let [wide, high] = window;
        self.low[0] < 0 || self.low[1] < 0 || self.high[0] > wide * PX || self.high[1] > high * PX
    }

    /// Whether it covers a point, its boundary included.
    fn covers(&self, [x, y]: [i64; 2]) -> bool {
        if x < self.low[0] || x > self.high[0] || y < self.low[1] || y > self.high[1] {
            return false;
        }
        let (mut is_left, mut is_right) = (true, true);
        let mut a = self.corners[2];
        for b in self.corners {
            let side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            is_left &= side <= 0;
            is_right &= side >= 0;
            a = b;
        }
        // Both where it has no area.
        is_left != is_right
    }

    /// The row or column at the border of a window that it leaves open, where it covers all other samples.
    fn leaves_open(&self, sides: [i32; 2]) -> Option<Open> {
        for axis in 0..2 {
            let last = sides[axis] - 1;
            if last == 0 {
                continue;
            }
            // A triangle is convex: it covers all samples between two lines if it covers those at their ends.
            let covers_ends = |at: i32| {
                [0, sides[1 - axis] - 1].map(|across| match axis {
                    0 => self.covers([centre(at), centre(across)]),
                    _ => self.covers([centre(across), centre(at)]),
                })
            };
            for (is_last, open, near, far) in [(false, 0, 1, last), (true, last, last - 1, 0)] {
                let is_covered = covers_ends(near) == [true; 2] && covers_ends(far) == [true; 2];
                if is_covered && covers_ends(open) == [false; 2] {
                    return Some(Open { axis, is_last });
                }
            }
        }
        None
    }
}

/// The row or column at the border of the window that a triangle leaves open.
#[derive(Clone, Copy)]
struct Open {
    /// A column is open along x (0), a row along y (1).
    axis: usize,
    is_last: bool,
}

/// How the means of depths follow each other.
fn order(list: &[Layer]) -> i64 {
    let (mut rises, mut falls) = (true, true);
    for pair in list.windows(2) {
        rises &= pair[0].mean <= pair[1].mean;
        falls &= pair[0].mean >= pair[1].mean;
    }
    match (list.len(), rises, falls) {
        (1, ..) => 0,
        (_, true, true) => 4,
        (_, true, false) => 1,
        (_, false, true) => 2,
        (_, false, false) => 3,
    }
}

/// The logarithm of the smallest difference of means that is not 0.
fn closest(list: &[Layer]) -> i64 {
    let mut means: Vec<f64> = list.iter().map(|layer| layer.mean).collect();
    means.sort_unstable_by(f64::total_cmp);
    let mut closest = None;
    for pair in means.windows(2) {
        let gap = pair[1] - pair[0];
        if gap > 0.0 {
            let exponent = i64::from(exponent(gap));
            closest = Some(closest.map_or(exponent, |least: i64| least.min(exponent)));
        }
    }
    closest.unwrap_or(0)
}

/// How many have the depths of another.
fn equal(list: &[Layer]) -> usize {
    let mut depths: Vec<[u64; 3]> =
        list.iter().map(|layer| layer.depths.map(f64::to_bits)).collect();
    depths.sort_unstable();
    let mut count = 0;
    for alike in depths.chunk_by(|a, b| a == b) {
        count += if alike.len() > 1 { alike.len() } else { 0 };
    }
    count
}

/// The most triangles that cover one of a few samples.
fn piled(list: &[Layer], window: PixelRect) -> i64 {
    let mut most = 0;
    let [wide, high] = [window.x1.min(4), window.y1.min(4)];
    for row in 0..high {
        for column in 0..wide {
            let sample = [centre(column * window.x1 / wide), centre(row * window.y1 / high)];
            let mut covering = 0;
            for layer in list {
                covering += i64::from(layer.covers(sample));
            }
            most = most.max(covering);
        }
    }
    most
}

/// The most boxes that meet the same block of 8 x 8 px of the window.
fn in_block(list: &[Layer], window: [i64; 2]) -> i64 {
    let block = 8 * PX;
    let mut most = 0;
    for y in (0..window[1] * PX).step_by(8 * PX as usize) {
        for x in (0..window[0] * PX).step_by(8 * PX as usize) {
            let mut meeting = 0;
            for Layer { low, high, .. } in list {
                let meets_columns = low[0] < x + block && high[0] >= x;
                meeting += i64::from(meets_columns && low[1] < y + block && high[1] >= y);
            }
            most = most.max(meeting);
        }
    }
    most
}

/// A side of a window: exact depths are dear, so that it is small.
fn draw_side(rng: &mut Rng) -> i32 {
    match rng.int(0, 11) {
        0 => 1,
        1 => 2,
        2..=5 => rng.coordinate(3, 8),
        6 => 8,
        7 => 16,
        _ => rng.coordinate(9, 24),
    }
}

/// How the depths of a pile are drawn.
#[derive(Clone, Copy)]
struct Depths {
    leans: i64,
    step: f64,
    most: i64,
}

fn draw_depths(rng: &mut Rng) -> Depths {
    let bits = rng.int(1, 24);
    Depths {
        leans: rng.int(0, 2),
        step: 1.0 / f64::from(1 << bits),
        most: 1 << bits.min(rng.int(1, 24)),
    }
}

fn draw_triangle(rng: &mut Rng, window: PixelRect, depths: Depths) -> Triangle {
    let sides = [window.x1, window.y1].map(i64::from);
    let quarter = PX / 4;
    let reach = 1 << rng.int(1, 6);
    // Some lie at the border of the window, where a pixel has no neighbour.
    let middle = sides.map(|side| match rng.int(0, 3) {
        0 => [quarter, side * PX - quarter][rng.int(0, 1) as usize],
        _ => rng.int(0, 4 * side) * quarter,
    });
    let flat = rng.int(0, depths.most);
    let leans = depths.leans == 2 || (depths.leans == 1 && rng.chance(2));
    let vertices = [(); 3].map(|()| {
        let [x, y] = middle.map(|middle| middle + rng.int(-4 * reach, 4 * reach) * quarter);
        let steps = if leans { rng.int(0, depths.most) } else { flat };
        ScreenVertex {
            position: SubpixelPoint::new(x as i32, y as i32),
            depth: steps as f64 * depths.step,
            inv_w: 1.0,
            varying: DVec2::ZERO,
        }
    });
    ScreenTriangle { vertices }
}

fn draw(rng: &mut Rng) -> Case {
    let window = PixelRect::window(draw_side(rng) as u32, draw_side(rng) as u32);
    let depths = draw_depths(rng);
    let most = 1 << rng.int(0, 6);
    let list =
        (0..rng.int((most + 1) / 2, most)).map(|_| draw_triangle(rng, window, depths)).collect();
    let mut list: Vec<Triangle> = list;
    if rng.chance(2) {
        list[0] = background(rng, window);
        if rng.chance(2) {
            bring_to_front(&mut list, 0);
        }
    }
    arrange(rng, &mut list);
    Case { window, shape: Shape::Triangles { list, disjoint: false } }
}

/// A triangle of one depth that covers the window, or all of it but one row or column at its border.
fn background(rng: &mut Rng, window: PixelRect) -> Triangle {
    let far = 4 * window.x1.max(window.y1) * SUBPIXELS;
    let depth = rng.int(0, 16) as f64 / 16.0;
    // Its right angle lies at the upper left corner, and then both axes are mirrored.
    let open = rng.int(0, 4);
    let place = |axis: usize, v: i32| {
        let side = [window.x1, window.y1][axis] * SUBPIXELS;
        let start = if open == axis as i64 { SUBPIXELS } else { -SUBPIXELS };
        start + if v == 0 { 0 } else { far + side }
    };
    let corners = [[0, 0], [1, 0], [0, 1]].map(|[x, y]| [place(0, x), place(1, y)]);
    let mirror = rng.chance(2);
    let vertices = corners.map(|[x, y]| {
        let [x, y] = match mirror {
            true => [window.x1 * SUBPIXELS - x, window.y1 * SUBPIXELS - y],
            false => [x, y],
        };
        let position = SubpixelPoint::new(x, y);
        ScreenVertex { position, depth, inv_w: 1.0, varying: DVec2::ZERO }
    });
    ScreenTriangle { vertices }
}

/// Puts a triangle before all others, whose depths keep their order.
fn bring_to_front(list: &mut [Triangle], front: usize) {
    for (i, triangle) in list.iter_mut().enumerate() {
        for vertex in &mut triangle.vertices {
            vertex.depth = if i == front { vertex.depth / 4.0 } else { (1.0 + vertex.depth) / 2.0 };
        }
    }
}

fn mean(triangle: &Triangle) -> f64 {
    triangle.vertices.iter().map(|v| v.depth).sum()
}

/// Puts some piles in an order, gives them one winding, or the depths of each other.
fn arrange(rng: &mut Rng, list: &mut [Triangle]) {
    match rng.int(0, 8) {
        0 => list.sort_by(|a, b| mean(a).total_cmp(&mean(b))),
        1 => list.sort_by(|a, b| mean(b).total_cmp(&mean(a))),
        2 | 3 => {
            let sign = if rng.chance(2) { 1 } else { -1 };
            for triangle in list.iter_mut().filter(|t| twice_area(&t.corners()) * sign < 0) {
                triangle.vertices.swap(1, 2);
            }
        }
        // The depths of the first.
        4 => {
            let first = list[0].vertices;
            let every = rng.int(1, 2) as usize;
            for triangle in list.iter_mut().step_by(every) {
                triangle
                    .vertices
                    .iter_mut()
                    .zip(&first)
                    .for_each(|(v, first)| v.depth = first.depth);
            }
        }
        _ => {}
    }
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let mut window = one.window;
    let (mut list, others) = (one.triangles().to_vec(), other.triangles());
    for _ in 0..rng.int(1, 3) {
        let depths = draw_depths(rng);
        let at = rng.int(0, list.len() as i64 - 1) as usize;
        match rng.int(0, 16) {
            0 => window = PixelRect::window(draw_side(rng) as u32, window.height()),
            1 => window = PixelRect::window(window.width(), draw_side(rng) as u32),
            2 => window.x1 = other.window.x1,
            3 => window.y1 = other.window.y1,
            // As many as the other, of this one's kind.
            4 => {
                while list.len() < others.len() {
                    let copy = list[rng.int(0, list.len() as i64 - 1) as usize];
                    list.push(copy);
                }
                list.truncate(others.len());
            }
            5 => {
                let wanted = rng.int(1, MOST) as usize;
                while list.len() < wanted {
                    list.push(draw_triangle(rng, window, depths));
                }
            }
            6 => list.truncate(at + 1),
            7 => list[at] = draw_triangle(rng, window, depths),
            8 => list[at] = others[rng.int(0, others.len() as i64 - 1) as usize],
            // The depths of the other.
            9 => {
                for (triangle, other) in list.iter_mut().zip(others.iter().cycle()) {
                    triangle
                        .vertices
                        .iter_mut()
                        .zip(&other.vertices)
                        .for_each(|(v, other)| v.depth = other.depth);
                }
            }
            // Drawn smaller or larger about the middle of the window.
            10 => scale(&mut list, window, rng.int(-3, 1)),
            11 => {
                let last = list.len() - 1;
                list.swap(at, last);
            }
            12 => list[at] = background(rng, window),
            // One or all from border to border of a wide or a high window, and within it.
            13 => {
                window = if rng.chance(2) {
                    PixelRect::window(24, window.height())
                } else {
                    PixelRect::window(window.width(), 24)
                };
                let from = if rng.chance(2) { at } else { 0 };
                for triangle in &mut list[from..] {
                    span(rng, triangle, window);
                }
            }
            14 => {
                list[at] = background(rng, window);
                bring_to_front(&mut list, at);
            }
            15 => window = two_samples(rng, &mut list, at),
            _ => arrange(rng, &mut list),
        }
    }
    Case { window, shape: Shape::Triangles { list, disjoint: false } }
}

/// A window of two samples, the first or the last of which a small triangle covers, and a small one behind it reaches both.
fn two_samples(rng: &mut Rng, list: &mut [Triangle], front: usize) -> PixelRect {
    let axis = rng.int(0, 1) as usize;
    let window = if axis == 0 { PixelRect::window(2, 1) } else { PixelRect::window(1, 2) };
    scale(list, window, -3);
    let quarter = SUBPIXELS / 4;
    let behind = (front + 1) % list.len();
    let covered = 4 * rng.coordinate(0, 1);
    // Corners in quarters of a pixel from the first sample, along the two samples and across.
    let small = [[covered - 1, -1], [covered + 2, -1], [covered - 1, 2]];
    for (triangle, corners) in [(behind, [[-1, -1], [5, -1], [-1, 1]]), (front, small)] {
        for (vertex, [along, across]) in list[triangle].vertices.iter_mut().zip(corners) {
            let [x, y] = if axis == 0 { [along, across] } else { [across, along] };
            vertex.position = SubpixelPoint::new((x + 2) * quarter, (y + 2) * quarter);
        }
    }
    bring_to_front(list, front);
    window
}

/// Moves the corners of a triangle onto the border of a window, of which it may leave the first or the last row or column.
fn span(rng: &mut Rng, triangle: &mut Triangle, window: PixelRect) {
    let sides = [window.x1, window.y1];
    let open = rng.int(0, 7);
    let [mut low, mut high] = [[0; 2], sides.map(|side| side * SUBPIXELS)];
    for axis in (0..2).filter(|axis| sides[*axis] > 1) {
        low[axis] += SUBPIXELS * i32::from(open == axis as i64);
        high[axis] -= SUBPIXELS * i32::from(open == axis as i64 + 2);
    }
    let at = rng.coordinate(0, 4) * (SUBPIXELS / 4);
    let beside = [0, 1].map(|axis| (low[axis] + at).min(high[axis]));
    let corners = [[low[0], beside[1]], [high[0], low[1]], [beside[0], high[1]]];
    for (v, [x, y]) in triangle.vertices.iter_mut().zip(corners) {
        v.position = SubpixelPoint::new(x, y);
    }
}

/// Multiplies all distances from the middle of a window by a power of two, on quarters of pixels.
fn scale(list: &mut [Triangle], window: PixelRect, doublings: i64) {
    let quarter = SUBPIXELS / 4;
    let middle = [window.x1, window.y1].map(|side| side * SUBPIXELS / 2);
    for v in list.iter_mut().flat_map(|t| &mut t.vertices) {
        let scaled = |v: i32, middle: i32| {
            let by = v - middle;
            let by = if doublings < 0 {
                by >> -doublings
            } else {
                by.clamp(-(1 << 14), 1 << 14) << doublings
            };
            (middle + by).div_euclid(quarter) * quarter
        };
        v.position =
            SubpixelPoint::new(scaled(v.position.x, middle[0]), scaled(v.position.y, middle[1]));
    }
}
