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
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::FreeCorners;

/// Every family of triangles off the lattice.
pub const FAMILIES: &[Family] = &[
    family("f32-random", "anywhere in the window", random),
    family("f32-sliver", "collinear but for a few ulps", sliver),
    family("f32-near-tie", "an edge through a sample, an end moved by 1 ulp", |rng| {
        near_tie(rng, f32_of, nudge_f32, 12)
    }),
    family("f32-tie", "dyadic fractions, edges exactly through samples", tie),
    family("f32-fan", "closed fans around the whole window", fan),
    family("f32-cut", "the window cut in two along an edge through a sample", cut),
    family("f32-tiny", "a few ulps around a sample", tiny),
    family("f32-mixed", "exponents from 2^-149 to 2^22 in one triangle", mixed),
    family("f32-denormal", "a tie missed by a subnormal offset", denormal_f32),
    family("f32-far", "offsets of 2^11, 2^14 and 2^22 px from the origin", far),
    family("f32-huge", "ends far off, an edge past a sample", |rng| huge(rng, f32_of, nudge_f32)),
    family("f64-near-tie", "as f32-near-tie, by an ulp of f64", |rng| {
        near_tie(rng, |v| v, nudge_f64, 40)
    }),
    family("f64-huge", "as f32-huge, by an ulp of f64", |rng| huge(rng, |v| v, nudge_f64)),
    family("f64-denormal", "a tie missed by 2^-300 down to 2^-1074", denormal_f64),
];

/// Side of the usual window.
const SIDE_PX: i64 = 16;

type Point = [f64; 2];

fn case(triangles: &[[Point; 3]], window: PixelRect, is_tiling: bool) -> Case {
    let domain = -8_388_608.0..8_388_608.0;
    debug_assert!(triangles.as_flattened().as_flattened().iter().all(|px| domain.contains(px)));
    // What cannot be is skipped; the families below never leave the domain.
    let triangles = triangles.iter().filter_map(|&corners| FreeCorners::new(corners).ok());
    Case { window, shape: Shape::Unsnapped { list: triangles.collect(), is_tiling } }
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

fn anywhere(rng: &mut Rng) -> Point {
    [(); 2].map_array(|()| coordinate(rng, -2.0, SIDE_PX as f64 + 2.0))
}

/// The centre of a pixel of the window.
fn sample(rng: &mut Rng) -> Point {
    [(); 2].map_array(|()| rng.int(0, SIDE_PX - 1) as f64 + 0.5)
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
    let corners = [(); 3].map_array(|()| anywhere(rng));
    single(corners, rng)
}

/// The line through two corners goes past a sample, and so does the third corner's side.
fn sliver(rng: &mut Rng) -> Case {
    let (a, s) = (anywhere(rng), sample(rng));
    let b = [0, 1].map_array(|i| f32_of(2.0 * s[i] - a[i]));
    let t = rng.unit() * 1.5 - 0.25;
    // Rounding alone moves it off the line; sometimes more than that.
    let reach = 1 << rng.int(0, 16);
    let c = [0, 1].map_array(|i| {
        let on_line = a[i] + (b[i] - a[i]) * t;
        f32_of(on_line + rng.int(-reach, reach) as f64 / (1 << 22) as f64)
    });
    single([a, b, c], rng)
}

/// An edge through a sample, whose one end is then rounded or moved by an ulp. Half of the edges
/// start on fractions of `bits` bits, where the tie before is exact and only the ulp decides.
fn near_tie(rng: &mut Rng, round: fn(f64) -> f64, nudge: fn(f64, i64) -> f64, bits: u32) -> Case {
    let s = sample(rng);
    let one = (1i64 << bits) as f64;
    let fraction = |rng: &mut Rng| rng.int(-(4 << bits), 4 << bits) as f64 / one;
    let (a, mut b) = if rng.chance(2) {
        let d = [fraction(rng), fraction(rng)];
        let (back, on) = (rng.int(1, 2) as f64, rng.int(1, 2) as f64);
        ([0, 1].map_array(|i| s[i] - back * d[i]), [0, 1].map_array(|i| s[i] + on * d[i]))
    } else {
        let a = [(); 2].map_array(|()| round(rng.unit() * 16.0));
        (a, [0, 1].map_array(|i| round(2.0 * s[i] - a[i])))
    };
    let axis = rng.int(0, 1) as usize;
    b[axis] = nudge(b[axis], rng.int(-1, 1));
    let c = [(); 2].map_array(|()| round(rng.unit() * 20.0 - 2.0));
    single([a, b, c], rng)
}

fn tie(rng: &mut Rng) -> Case {
    if rng.chance(3) {
        let corners = [(); 3].map_array(|()| sample(rng));
        return single(corners, rng);
    }
    // Both edges at c, or only one of them, go through samples.
    let scale = (1i64 << rng.int(1, 10)) as f64;
    let step = |rng: &mut Rng| {
        [(); 2].map_array(|()| rng.int(-3 * scale as i64, 3 * scale as i64) as f64 / scale)
    };
    let (s, d) = (sample(rng), step(rng));
    let beside = |k: f64| [0, 1].map_array(|i| s[i] + k * d[i]);
    let (a, c) = (beside(-(rng.int(1, 3) as f64)), beside(rng.int(1, 3) as f64));
    let b = if rng.chance(2) {
        let other = sample(rng);
        [0, 1].map_array(|i| 2.0 * other[i] - c[i])
    } else {
        anywhere(rng)
    };
    single([a, b, c], rng)
}

/// Spokes from a centre to points on a rectangle around the window, in order: every pixel of the
/// window belongs to exactly one of the triangles.
fn fan(rng: &mut Rng) -> Case {
    let centre = if rng.chance(2) {
        sample(rng)
    } else {
        [(); 2].map_array(|()| coordinate(rng, 1.0, 15.0))
    };
    let border = Border::around_window(rng);
    let mut ring = Vec::new();
    for side in 0..4 {
        let mut along: Vec<f64> = (0..rng.int(0, 3)).map(|_| rng.unit()).collect();
        along.sort_by(f64::total_cmp);
        ring.push(border.corner(side));
        ring.extend(along.into_iter().map(|t| border.point(side, t)));
        if rng.chance(2) {
            // A spoke as nearly as can be through a sample; in its place only where that is last.
            let through = border.opposite(side, centre, sample(rng));
            let last = ring[ring.len() - 1];
            ring.extend(through.filter(|p| border.is_between(side, last, *p)));
        }
    }
    let next = |i: usize| ring[(i + 1) % ring.len()];
    let triangles: Vec<_> = (0..ring.len()).map(|i| [centre, ring[i], next(i)]).collect();
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
        let at = |y: f64| [s[0] + (y - s[1]) * slope, y];
        let (above, below) = (at(border.top), at(border.bottom));
        (border, above, below)
    } else {
        let border = Border::around_window(rng);
        let above = [f32_of(s[0] + coordinate(rng, -1.0, 1.0)), border.top];
        let below = border.opposite(2, above, s).unwrap_or([s[0], border.bottom]);
        (border, above, below)
    };
    let below = [nudge_f32(below[0], rng.int(-1, 1)), below[1]];
    let [top_left, top_right, bottom_right, bottom_left] = [0, 1, 2, 3].map(|i| border.corner(i));
    let split = |rng: &mut Rng, [a, b, c, d]: [Point; 4]| {
        if rng.chance(2) { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
    };
    let left = split(rng, [top_left, above, below, bottom_left]);
    let right = split(rng, [above, top_right, bottom_right, below]);
    let triangles = [left[0], left[1], right[0], right[1]];
    // Outside of the rectangle the parts would overlap.
    let is_tiling = [above[0], below[0]].iter().all(|x| *x > border.left && *x < border.right);
    case(&triangles, PixelRect::window(SIDE_PX as u32, SIDE_PX as u32), is_tiling)
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
        [0, 1].map_array(|i| f32_of(a[i] + (b[i] - a[i]) * t))
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
    let corners = [(); 3].map_array(|()| s.map_array(|v| nudge_f32_far(v, rng.int(-reach, reach))));
    single(corners, rng)
}

/// As [`nudge_f32`], by any number of ulps of a positive number that stays positive.
fn nudge_f32_far(v: f64, ulps: i64) -> f64 {
    f64::from(f32::from_bits((i64::from((v as f32).to_bits()) + ulps) as u32))
}

fn mixed(rng: &mut Rng) -> Case {
    let mut wild = || {
        // Subnormal where the field is 0, below 2^23 up to the field 149.
        let field = if rng.chance(2) { rng.int(118, 149) } else { rng.int(0, 149) } as u32;
        let fraction = rng.int(0, (1 << 23) - 1) as u32;
        let magnitude = f64::from(f32::from_bits(field << 23 | fraction));
        if rng.chance(2) { -magnitude } else { magnitude }
    };
    let mut corners = [(); 3].map_array(|()| [wild(), wild()]);
    if rng.chance(2) {
        corners[0] = anywhere(rng);
    }
    single(corners, rng)
}

fn denormal_f32(rng: &mut Rng) -> Case {
    denormal(rng, |rng| {
        let bits = rng.int(1, 25);
        f64::from(f32::from_bits(rng.int(1, 1 << bits) as u32))
    })
}

fn denormal_f64(rng: &mut Rng) -> Case {
    denormal(rng, |rng| {
        let field = rng.int(0, 1023 - 300) as u64;
        let bits = rng.int(1, 52);
        f64::from_bits(field << 52 | rng.int(1, (1 << bits) - 1) as u64)
    })
}

/// An edge from the origin through samples exactly, then one or more zeros replaced by something
/// tiny of either sign.
fn denormal(rng: &mut Rng, tiny: impl Fn(&mut Rng) -> f64) -> Case {
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
    let corners = if rng.chance(2) { near_tie(rng, f32_of, nudge_f32, 12) } else { random(rng) };
    let mut offset = || {
        let px = (1i64 << [0, 11, 14, 22][rng.int(0, 3) as usize]) as f64;
        if rng.chance(2) { px } else { -px }
    };
    let (dx, dy) = (offset(), offset());
    let moved = |corners: [Point; 3]| corners.map_array(|[x, y]| [f32_of(x + dx), f32_of(y + dy)]);
    let triangles: Vec<_> = corners.free_corners().iter().map(|t| moved(t.px())).collect();
    let w = corners.window;
    let (x, y) = (dx as i32, dy as i32);
    let window = PixelRect { x0: w.x0 + x, y0: w.y0 + y, x1: w.x1 + x, y1: w.y1 + y };
    case(&triangles, window, false)
}

fn huge(rng: &mut Rng, round: fn(f64) -> f64, nudge: fn(f64, i64) -> f64) -> Case {
    let s = sample(rng);
    let mut away = || round(rng.signed() * (1i64 << rng.int(5, 22)) as f64);
    let (a, c) = ([away(), away()], [away(), away()]);
    // The mirror image at a sample, but for an ulp.
    let b = [0, 1].map_array(|i| nudge(round(2.0 * s[i] - a[i]), rng.int(-1, 1)));
    single([a, b, c], rng)
}
