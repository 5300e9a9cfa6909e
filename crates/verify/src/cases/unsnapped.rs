//! Families of triangles whose corners are not on the lattice: any float is a position.
//!
//! The danger here is rounding. A sample decides wrongly where the error of a computed side or
//! crossing exceeds its distance to the edge, so the families put edges through samples, exactly or
//! but for the last bit, or make the terms of the computation differ wildly in size. Families `f32-`
//! have corners that are exactly f32, as a vertex buffer would hold them; families `f64-` use all 53
//! bits and exponents that f32 does not have.
//!
//! Only additions, multiplications and conversions are used, which round alike on every machine.

use super::{Case, Family, Shape, family};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::FreeCorners;

/// Every family of triangles off the lattice.
pub const FAMILIES: &[Family] = &[
    family("f32-random", "anywhere in the window", random),
    family("f32-sliver", "collinear but for a few ulps", sliver),
    family("f32-near-tie", "an edge through a sample, an end moved by 1 ulp", near_tie_f32),
    family("f32-tie", "dyadic fractions, edges exactly through samples", tie),
    family("f32-fan", "closed fans around the whole window", fan),
    family("f32-cut", "the window cut in two along an edge through a sample", cut),
    family("f32-tiny", "a few ulps around a sample", tiny),
    family("f32-mixed", "exponents from 2^-149 to 2^22 in one triangle", mixed),
    family("f32-denormal", "a tie missed by a subnormal offset", denormal_f32),
    family("f32-far", "offsets of 2^11, 2^14 and 2^22 px from the origin", far),
    family("f32-huge", "ends far off, an edge past a sample", huge_f32),
    family("f64-near-tie", "as f32-near-tie, by an ulp of f64", near_tie_f64),
    family("f64-huge", "as f32-huge, by an ulp of f64", huge_f64),
    family("f64-denormal", "a tie missed by 2^-300 down to 2^-1074", denormal_f64),
];

/// Side of the usual window.
const SIDE_PX: i64 = 16;

type Point = [f64; 2];

/// The numbers of one size that a family draws: how a value becomes one, and how one is moved by ulps.
#[derive(Clone, Copy)]
struct Floats {
    round: fn(f64) -> f64,
    nudge: fn(f64, i64) -> f64,
    /// Bits behind the point of a step, so few that a point some steps away is exact, too.
    fraction_bits: u32,
}

const F32: Floats = Floats { round: f32_of, nudge: nudge_f32, fraction_bits: 12 };
const F64: Floats = Floats { round: core::convert::identity, nudge: nudge_f64, fraction_bits: 40 };

fn case(triangles: &[[Point; 3]], window: PixelRect, is_tiling: bool) -> Case {
    let domain = -8_388_608.0..8_388_608.0;
    let mut list = Vec::with_capacity(triangles.len());
    for &corners in triangles {
        debug_assert!(corners.as_flattened().iter().all(|px| domain.contains(px)));
        // What cannot be is skipped; the families below never leave the domain.
        list.extend(FreeCorners::new(corners).ok());
    }
    Case { window, shape: Shape::Unsnapped { list, is_tiling } }
}

fn single(mut corners: [Point; 3], rng: &mut Rng) -> Case {
    // Any corner first, either winding.
    corners.rotate_left(rng.int(0, 2) as usize);
    if rng.chance(2) {
        corners.swap(0, 1);
    }
    case(&[corners], PixelRect::window(SIDE_PX as u32, SIDE_PX as u32), false)
}

/// Rounds to f32.
fn f32_of(v: f64) -> f64 {
    f64::from(v as f32)
}

fn coordinate(rng: &mut Rng, low: f64, high: f64) -> f64 {
    f32_of(low + rng.unit() * (high - low))
}

/// A point with both coordinates between `low` and `high`, rounded to f32.
fn between(rng: &mut Rng, low: f64, high: f64) -> Point {
    [coordinate(rng, low, high), coordinate(rng, low, high)]
}

fn anywhere(rng: &mut Rng) -> Point {
    between(rng, -2.0, SIDE_PX as f64 + 2.0)
}

/// The centre of a pixel of the window.
fn sample(rng: &mut Rng) -> Point {
    [rng.int(0, SIDE_PX - 1) as f64 + 0.5, rng.int(0, SIDE_PX - 1) as f64 + 0.5]
}

/// The point `k` steps from another.
fn stepped(from: Point, step: Point, k: f64) -> Point {
    [from[0] + k * step[0], from[1] + k * step[1]]
}

/// The mirror image of a point at another one, not rounded.
fn mirrored(point: Point, at: Point) -> Point {
    [2.0 * at[0] - point[0], 2.0 * at[1] - point[1]]
}

fn rounded(point: Point, floats: Floats) -> Point {
    [(floats.round)(point[0]), (floats.round)(point[1])]
}

/// `v` moved by `ulps` f32 numbers.
pub(crate) fn nudge_f32(v: f64, ulps: i64) -> f64 {
    let v = v as f32;
    let (bits, is_negative) = nudged(v.abs().to_bits().into(), v.is_sign_negative(), ulps);
    let moved = f64::from(f32::from_bits(bits as u32));
    if is_negative { -moved } else { moved }
}

/// `v` moved by `ulps` f64 numbers.
pub(crate) fn nudge_f64(v: f64, ulps: i64) -> f64 {
    let (bits, is_negative) = nudged(v.abs().to_bits(), v.is_sign_negative(), ulps);
    let moved = f64::from_bits(bits);
    if is_negative { -moved } else { moved }
}

/// The bits of a magnitude, and whether it is negative, so many numbers on: what `next_up` and `next_down` do, which the
/// oldest compiler of this crate does not have. The two zeros are one number.
fn nudged(bits: u64, is_negative: bool, ulps: i64) -> (u64, bool) {
    let at = if is_negative { -(bits as i64) } else { bits as i64 } + ulps;
    (at.unsigned_abs(), at < 0 || at == 0 && is_negative)
}

fn random(rng: &mut Rng) -> Case {
    let corners = [anywhere(rng), anywhere(rng), anywhere(rng)];
    single(corners, rng)
}

/// The line through two corners goes past a sample, and so does the third corner's side.
fn sliver(rng: &mut Rng) -> Case {
    let (a, s) = (anywhere(rng), sample(rng));
    let b = rounded(mirrored(a, s), F32);
    let t = rng.unit() * 1.5 - 0.25;
    let mut c = stepped(a, [b[0] - a[0], b[1] - a[1]], t);
    // Rounding alone moves it off the line; sometimes more than that.
    let reach = 1 << rng.int(0, 16);
    for v in &mut c {
        *v = f32_of(*v + rng.int(-reach, reach) as f64 / (1 << 22) as f64);
    }
    single([a, b, c], rng)
}

fn near_tie_f32(rng: &mut Rng) -> Case {
    near_tie(rng, F32)
}

fn near_tie_f64(rng: &mut Rng) -> Case {
    near_tie(rng, F64)
}

/// A step of up to `most` px along each axis, in parts of a pixel.
fn fraction(rng: &mut Rng, most: i64, parts: i64) -> Point {
    let mut step = [0.0; 2];
    for v in &mut step {
        *v = rng.int(-most * parts, most * parts) as f64 / parts as f64;
    }
    step
}

/// An edge through a sample, whose one end is then rounded or moved by an ulp. Half of the edges
/// start on fractions of a few bits, where the tie before is exact and only the ulp decides.
fn near_tie(rng: &mut Rng, floats: Floats) -> Case {
    let s = sample(rng);
    let (a, mut b) = if rng.chance(2) {
        let d = fraction(rng, 4, 1 << floats.fraction_bits);
        let (back, on) = (rng.int(1, 2) as f64, rng.int(1, 2) as f64);
        (stepped(s, d, -back), stepped(s, d, on))
    } else {
        let a = rounded([rng.unit() * 16.0, rng.unit() * 16.0], floats);
        (a, rounded(mirrored(a, s), floats))
    };
    let axis = rng.int(0, 1) as usize;
    b[axis] = (floats.nudge)(b[axis], rng.int(-1, 1));
    let c = rounded([rng.unit() * 20.0 - 2.0, rng.unit() * 20.0 - 2.0], floats);
    single([a, b, c], rng)
}

fn tie(rng: &mut Rng) -> Case {
    if rng.chance(3) {
        let corners = [sample(rng), sample(rng), sample(rng)];
        return single(corners, rng);
    }
    // Both edges at c, or only one of them, go through samples.
    let parts = 1 << rng.int(1, 10);
    let (s, d) = (sample(rng), fraction(rng, 3, parts));
    let a = stepped(s, d, -(rng.int(1, 3) as f64));
    let c = stepped(s, d, rng.int(1, 3) as f64);
    let b = if rng.chance(2) { mirrored(c, sample(rng)) } else { anywhere(rng) };
    single([a, b, c], rng)
}

/// Spokes from a centre to points on a rectangle around the window, in order: every pixel of the
/// window belongs to exactly one of the triangles.
fn fan(rng: &mut Rng) -> Case {
    let centre = if rng.chance(2) { sample(rng) } else { between(rng, 1.0, 15.0) };
    let border = Border::around_window(rng);
    let mut ring = Vec::new();
    for side in 0..4 {
        let mut along: Vec<f64> = (0..rng.int(0, 3)).map(|_| rng.unit()).collect();
        along.sort_by(f64::total_cmp);
        ring.push(border.corner(side));
        for t in along {
            ring.push(border.point(side, t));
        }
        if rng.chance(2) {
            // A spoke as nearly as can be through a sample; in its place only where that is last.
            let through = border.opposite(side, centre, sample(rng));
            let last = ring[ring.len() - 1];
            ring.extend(through.filter(|p| border.is_between(side, last, *p)));
        }
    }
    let mut triangles = Vec::with_capacity(ring.len());
    for (i, &point) in ring.iter().enumerate() {
        triangles.push([centre, point, ring[(i + 1) % ring.len()]]);
    }
    case(&triangles, PixelRect::window(SIDE_PX as u32, SIDE_PX as u32), true)
}

/// A rectangle around the window, cut from its top to its bottom by an edge past a sample; both
/// parts are split on a diagonal. Every pixel of the window belongs to exactly one of the four.
fn cut(rng: &mut Rng) -> Case {
    let s = sample(rng);
    let (border, above, below) = if rng.chance(2) {
        // On whole pixels with a slope of n/64, the edge goes through the sample exactly.
        let border = Border { left: -20.0, top: -1.0, right: 40.0, bottom: 18.0 };
        let slope = rng.int(-64, 64) as f64 / 64.0;
        let above = [s[0] + (border.top - s[1]) * slope, border.top];
        let below = [s[0] + (border.bottom - s[1]) * slope, border.bottom];
        (border, above, below)
    } else {
        let border = Border::around_window(rng);
        let above = [f32_of(s[0] + coordinate(rng, -1.0, 1.0)), border.top];
        let below = border.opposite(2, above, s).unwrap_or([s[0], border.bottom]);
        (border, above, below)
    };
    let below = [nudge_f32(below[0], rng.int(-1, 1)), below[1]];
    let left = split(rng, [border.corner(0), above, below, border.corner(3)]);
    let right = split(rng, [above, border.corner(1), border.corner(2), below]);
    let triangles = [left[0], left[1], right[0], right[1]];
    // Outside of the rectangle the parts would overlap.
    let is_tiling = above[0].min(below[0]) > border.left && above[0].max(below[0]) < border.right;
    case(&triangles, PixelRect::window(SIDE_PX as u32, SIDE_PX as u32), is_tiling)
}

/// Four corners in order, as two triangles on either diagonal.
fn split(rng: &mut Rng, [a, b, c, d]: [Point; 4]) -> [[Point; 3]; 2] {
    if rng.chance(2) { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
}

/// A rectangle of f32 coordinates that holds all centres of the window inside.
struct Border {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Border {
    fn around_window(rng: &mut Rng) -> Self {
        let side = SIDE_PX as f64;
        Self {
            left: -coordinate(rng, 0.0, 3.0),
            top: -coordinate(rng, 0.0, 3.0),
            right: coordinate(rng, side, side + 3.0),
            bottom: coordinate(rng, side, side + 3.0),
        }
    }

    /// Where side 0 (top), 1 (right), 2 (bottom) or 3 (left) starts, clockwise.
    fn corner(&self, side: usize) -> Point {
        match side {
            0 => [self.left, self.top],
            1 => [self.right, self.top],
            2 => [self.right, self.bottom],
            _ => [self.left, self.bottom],
        }
    }

    /// The point a fraction `t` along a side.
    fn point(&self, side: usize, t: f64) -> Point {
        let (a, b) = (self.corner(side), self.corner((side + 1) % 4));
        rounded(stepped(a, [b[0] - a[0], b[1] - a[1]], t), F32)
    }

    /// The f32 point nearest to where the ray from `from` through `s` meets the line of a side, if
    /// it goes that way.
    fn opposite(&self, side: usize, from: Point, s: Point) -> Option<Point> {
        let along = side % 2;
        let across = 1 - along;
        let level = self.corner(side)[across];
        let t = (level - from[across]) / (s[across] - from[across]);
        let at = f32_of(from[along] + (s[along] - from[along]) * t);
        let mut point = [level; 2];
        point[along] = at;
        (t > 0.0 && at.abs() < 1000.0).then_some(point)
    }

    /// Whether `p` on a side comes after `last` and before the side's end.
    fn is_between(&self, side: usize, last: Point, p: Point) -> bool {
        let along = side % 2;
        let (last, p, end) = (last[along], p[along], self.corner((side + 1) % 4)[along]);
        (last < p && p < end) || (last > p && p > end)
    }
}

fn tiny(rng: &mut Rng) -> Case {
    let s = sample(rng);
    let reach = 1 << rng.int(0, 12);
    let mut corners = [s; 3];
    for v in corners.as_flattened_mut() {
        *v = nudge_f32_far(*v, rng.int(-reach, reach));
    }
    single(corners, rng)
}

/// As [`nudge_f32`], by any number of ulps of a positive number that stays positive.
fn nudge_f32_far(v: f64, ulps: i64) -> f64 {
    f64::from(f32::from_bits((i64::from((v as f32).to_bits()) + ulps) as u32))
}

fn mixed(rng: &mut Rng) -> Case {
    let mut corners = [[0.0; 2]; 3];
    for v in corners.as_flattened_mut() {
        // Subnormal where the field is 0, below 2^23 up to the field 149.
        let field = if rng.chance(2) { rng.int(118, 149) } else { rng.int(0, 149) } as u32;
        let fraction = rng.int(0, (1 << 23) - 1) as u32;
        let magnitude = f64::from(f32::from_bits(field << 23 | fraction));
        *v = if rng.chance(2) { -magnitude } else { magnitude };
    }
    if rng.chance(2) {
        corners[0] = anywhere(rng);
    }
    single(corners, rng)
}

fn denormal_f32(rng: &mut Rng) -> Case {
    denormal(rng, tiny_f32)
}

fn denormal_f64(rng: &mut Rng) -> Case {
    denormal(rng, tiny_f64)
}

/// The smallest numbers of f32, of a random number of bits.
fn tiny_f32(rng: &mut Rng) -> f64 {
    let bits = rng.int(1, 25);
    f64::from(f32::from_bits(rng.int(1, 1 << bits) as u32))
}

/// Below 2^-300, of a random number of bits.
fn tiny_f64(rng: &mut Rng) -> f64 {
    let field = rng.int(0, 1023 - 300) as u64;
    let bits = rng.int(1, 52);
    f64::from_bits(field << 52 | rng.int(1, (1 << bits) - 1) as u64)
}

/// An edge from the origin through samples exactly, then one or more zeros replaced by something
/// tiny of either sign.
fn denormal(rng: &mut Rng, tiny: fn(&mut Rng) -> f64) -> Case {
    let offset = |rng: &mut Rng| match rng.int(0, 3) {
        0 => 0.0,
        1 => -tiny(rng),
        _ => tiny(rng),
    };
    let origin = [offset(rng), offset(rng)];
    // From the origin through (i + 1/2, j + 1/2) to a multiple of that.
    let (i, j, k) = (rng.int(0, 4), rng.int(0, 4), rng.int(1, 4) as f64);
    let through = [(i as f64 + 0.5) * k, (j as f64 + 0.5) * k];
    let third = match rng.int(0, 3) {
        0 => [offset(rng), coordinate(rng, -2.0, 10.0)],
        1 => [coordinate(rng, -2.0, 10.0), offset(rng)],
        2 => [offset(rng), offset(rng)],
        _ => [coordinate(rng, -2.0, 10.0), coordinate(rng, -2.0, 10.0)],
    };
    let mut case = single([origin, through, third], rng);
    case.window = PixelRect { x0: -1, y0: -1, x1: 7, y1: 7 };
    case
}

fn far(rng: &mut Rng) -> Case {
    let near = if rng.chance(2) { near_tie(rng, F32) } else { random(rng) };
    let mut offset = [0.0; 2];
    for v in &mut offset {
        let px = (1i64 << [0, 11, 14, 22][rng.int(0, 3) as usize]) as f64;
        *v = if rng.chance(2) { px } else { -px };
    }
    let mut triangles = Vec::new();
    for triangle in near.free_corners() {
        let mut corners = triangle.px();
        for corner in &mut corners {
            *corner = rounded(stepped(*corner, offset, 1.0), F32);
        }
        triangles.push(corners);
    }
    let w = near.window;
    let [x, y] = [offset[0] as i32, offset[1] as i32];
    let window = PixelRect { x0: w.x0 + x, y0: w.y0 + y, x1: w.x1 + x, y1: w.y1 + y };
    case(&triangles, window, false)
}

fn huge_f32(rng: &mut Rng) -> Case {
    huge(rng, F32)
}

fn huge_f64(rng: &mut Rng) -> Case {
    huge(rng, F64)
}

/// Ends up to 2^22 px away, one of them the mirror image of another one at a sample, but for an ulp.
fn huge(rng: &mut Rng, floats: Floats) -> Case {
    let s = sample(rng);
    let mut ends = [[0.0; 2]; 2];
    for v in ends.as_flattened_mut() {
        *v = (floats.round)(rng.signed() * (1i64 << rng.int(5, 22)) as f64);
    }
    let [a, c] = ends;
    let mut b = rounded(mirrored(a, s), floats);
    for v in &mut b {
        *v = (floats.nudge)(*v, rng.int(-1, 1));
    }
    single([a, b, c], rng)
}
