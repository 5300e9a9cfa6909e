//! Families of generated triangles.
//!
//! Coordinates are drawn in subpixels (256 to the pixel; a centre is at 128 + 256 k).

use glam::DVec2;

use super::facts;
use super::{Case, Family, Shape, Triangle, designed, family, sub};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::centre_of;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};

/// Every family of triangles.
pub const FAMILIES: &[Family] = &[
    family("uniform", "anywhere in the window", uniform),
    family("half-integer", "corners on pixel centres: ties everywhere", half_integer),
    family("rectangle", "corners on centres, split on either diagonal", rectangle),
    family("fan", "closed fans around a centre", fan),
    family("strip", "zigzag strips that share every inner edge", strip),
    family("sliver", "long and thinner than a pixel", sliver),
    family("near-horizontal", "edges a few subpixels off a row of centres", near_horizontal),
    family("near-vertical", "edges a few subpixels off a column of centres", near_vertical),
    family("tiny", "smaller than a pixel", tiny),
    family("flat", "flat tops and bottoms, often on a row of centres", flat),
    family("degenerate", "zero area exactly, through samples", degenerate),
    family("partly-off", "across the borders of the window", partly_off),
    family("off-screen", "wholly outside, the bounding box often not", off_screen),
    family("huge", "corners up to the edge of the domain", huge),
    family("near-tie", "an edge through a sample, one end moved by a subpixel", near_tie),
    family("far", "offsets of 2^11, 2^14 and 2^22 px from the origin", far),
    family("w-equal", "perspective with equal w", w_equal),
    family("w-4", "w ratio up to 4", |rng| w_up_to(rng, 4.0)),
    family("w-100", "w ratio up to 100", |rng| w_up_to(rng, 100.0)),
    family("w-1e4", "w ratio up to 10,000", |rng| w_up_to(rng, 1e4)),
    family("w-1e6", "w ratio up to 1,000,000", |rng| w_up_to(rng, 1e6)),
    family("w-extreme", "w anywhere in its domain, ratio up to 2^400", w_extreme),
    designed(facts::triangles::TOPIC, "every two facts of a triangle together"),
    designed(facts::values::TOPIC, "every two facts of its values together"),
];

/// Side of the usual window, in pixels and in subpixels.
const SIDE_PX: u32 = 48;
const SIDE: i64 = SIDE_PX as i64 * 256;

fn window() -> PixelRect {
    PixelRect::window(SIDE_PX, SIDE_PX)
}

/// The ways in which w of a corner is drawn.
#[derive(Clone, Copy)]
enum W {
    OneToFour,
    Equal(f64),
    /// In [1, ratio]: often one of the ends, since the whole ratio is the danger.
    UpTo(f64),
    /// 1 to 2 times a power of two from 2^-200 to 2^199: exact, and the same on every machine.
    Extreme,
}

impl W {
    fn of(self, rng: &mut Rng) -> f64 {
        match self {
            Self::OneToFour => 1.0 + 3.0 * rng.unit(),
            Self::Equal(w) => w,
            Self::UpTo(ratio) => match rng.int(0, 2) {
                0 => 1.0,
                1 => ratio,
                _ => 1.0 + (ratio - 1.0) * rng.unit(),
            },
            Self::Extreme => {
                let exponent = rng.int(-200, 199) + 1023;
                (1.0 + rng.unit()) * f64::from_bits((exponent as u64) << 52)
            }
        }
    }
}

/// A triangle with random depth and attributes.
fn dressed(rng: &mut Rng, corners: Corners, w: W) -> Triangle {
    let vertices = corners.map_array(|position| ScreenVertex {
        position,
        depth: rng.unit(),
        inv_w: 1.0 / w.of(rng),
        varying: DVec2::new(rng.signed(), rng.signed() * 100.0),
    });
    ScreenTriangle { vertices }
}

fn moved(point: SubpixelPoint, dx: i32, dy: i32) -> SubpixelPoint {
    SubpixelPoint::new(point.x + dx, point.y + dy)
}

fn single(rng: &mut Rng, window: PixelRect, corners: Corners) -> Case {
    mesh(rng, window, &[corners], true)
}

fn mesh(rng: &mut Rng, window: PixelRect, triangles: &[Corners], disjoint: bool) -> Case {
    let mut list = Vec::with_capacity(triangles.len());
    for &corners in triangles {
        list.push(dressed(rng, corners, W::OneToFour));
    }
    Case { window, shape: Shape::Triangles { list, disjoint } }
}

fn point(rng: &mut Rng, low: i64, high: i64) -> SubpixelPoint {
    SubpixelPoint::new(rng.coordinate(low, high), rng.coordinate(low, high))
}

fn points(rng: &mut Rng, low: i64, high: i64) -> Corners {
    [point(rng, low, high), point(rng, low, high), point(rng, low, high)]
}

/// A point on a pixel centre, pixels low..=high.
fn on_centre(rng: &mut Rng, low_px: i64, high_px: i64) -> SubpixelPoint {
    centre_of(rng.coordinate(low_px, high_px), rng.coordinate(low_px, high_px))
}

/// Three points on pixel centres, of pixels 0 to this one.
fn on_centres(rng: &mut Rng, high_px: i64) -> Corners {
    [on_centre(rng, 0, high_px), on_centre(rng, 0, high_px), on_centre(rng, 0, high_px)]
}

fn uniform(rng: &mut Rng) -> Case {
    let corners = points(rng, 0, SIDE);
    single(rng, window(), corners)
}

fn half_integer(rng: &mut Rng) -> Case {
    let corners = on_centres(rng, 15);
    single(rng, PixelRect::window(16, 16), corners)
}

fn rectangle(rng: &mut Rng) -> Case {
    let (a, b) = (on_centre(rng, 0, 15), on_centre(rng, 0, 15));
    let (c, d) = (SubpixelPoint::new(b.x, a.y), SubpixelPoint::new(a.x, b.y));
    let split = if rng.chance(2) { [[a, c, b], [a, b, d]] } else { [[c, b, d], [c, d, a]] };
    mesh(rng, PixelRect::window(16, 16), &split, true)
}

/// Spokes go to points on a square ring, which needs no sines, pulled in by a random factor.
fn fan(rng: &mut Rng) -> Case {
    let centre =
        if rng.chance(4) { point(rng, 10 * 256, 22 * 256) } else { on_centre(rng, 10, 21) };
    let spokes = rng.int(5, 12);
    let reach = rng.int(256, 10 * 256);
    let perimeter = 8 * reach;
    // Where each spoke ends, as seen from the centre.
    let mut ring = Vec::new();
    for spoke in 0..spokes {
        let along = (perimeter * spoke + rng.int(0, perimeter - 1)) / spokes;
        let (side, rest) = (along / (2 * reach), along % (2 * reach) - reach);
        let (x, y) = match side {
            0 => (rest, -reach),
            1 => (reach, rest),
            2 => (-rest, reach),
            _ => (-reach, -rest),
        };
        let pull = rng.int(128, 256);
        ring.push([x * pull / 256, y * pull / 256]);
    }
    // A slice between each two spokes. Rounding may have folded a thin one over; then it is no fan.
    let tip = |[x, y]: [i64; 2]| sub(i64::from(centre.x) + x, i64::from(centre.y) + y);
    let mut slices = Vec::with_capacity(ring.len());
    let mut disjoint = true;
    for (i, &this) in ring.iter().enumerate() {
        let next = ring[(i + 1) % ring.len()];
        disjoint &= this[0] * next[1] - this[1] * next[0] > 0;
        slices.push([centre, tip(this), tip(next)]);
    }
    mesh(rng, PixelRect::window(32, 32), &slices, disjoint)
}

fn strip(rng: &mut Rng) -> Case {
    let on_centres = rng.chance(2);
    let snap = |sub: i64| if on_centres { sub.div_euclid(256) * 256 + 128 } else { sub };
    let mut x = rng.int(0, 2 * 256);
    let mut vertices = Vec::new();
    for i in 0..rng.int(4, 9) {
        x += rng.int(256, 5 * 256);
        let y = if i % 2 == 0 { rng.int(0, 10 * 256) } else { rng.int(14 * 256, 31 * 256) };
        vertices.push(sub(snap(x), snap(y)));
    }
    let triangles: Vec<_> = vertices.windows(3).map(|v| [v[0], v[1], v[2]]).collect();
    mesh(rng, PixelRect::window(48, 32), &triangles, true)
}

fn sliver(rng: &mut Rng) -> Case {
    let (a, b) = (point(rng, 0, SIDE), point(rng, 0, SIDE));
    // A third point within a pixel of the line a b.
    let t = rng.int(0, 256);
    let between = |a: i32, b: i32| i64::from(a) + (i64::from(b) - i64::from(a)) * t / 256;
    let reach = 1 << rng.int(0, 8);
    let c =
        sub(between(a.x, b.x) + rng.int(-reach, reach), between(a.y, b.y) + rng.int(-reach, reach));
    single(rng, window(), [a, b, c])
}

fn near_horizontal(rng: &mut Rng) -> Case {
    let corners = near_line(rng);
    single(rng, window(), corners)
}

fn near_vertical(rng: &mut Rng) -> Case {
    let corners = near_line(rng);
    single(rng, window(), corners.map_array(|p| SubpixelPoint::new(p.y, p.x)))
}

/// Two points within three subpixels of a row of centres, the third one there as well or far away.
fn near_line(rng: &mut Rng) -> Corners {
    let row = rng.int(4, 40) * 256 + 128;
    let (a, b) = (near_row(rng, row), near_row(rng, row));
    let c = if rng.chance(2) { near_row(rng, row) } else { point(rng, 0, SIDE) };
    [a, b, c]
}

fn near_row(rng: &mut Rng, row: i64) -> SubpixelPoint {
    sub(rng.int(0, SIDE), row + rng.int(-3, 3))
}

fn tiny(rng: &mut Rng) -> Case {
    let corner = point(rng, 0, 7 * 256);
    let corners = points(rng, 0, 255).map_array(|p| moved(p, corner.x, corner.y));
    single(rng, PixelRect::window(8, 8), corners)
}

fn flat(rng: &mut Rng) -> Case {
    let row = if rng.chance(3) { rng.int(0, SIDE) } else { rng.int(2, 45) * 256 + 128 };
    let (a, b) = (sub(rng.int(0, SIDE), row), sub(rng.int(0, SIDE), row));
    let c = if rng.chance(3) { on_centre(rng, 0, 47) } else { point(rng, 0, SIDE) };
    single(rng, window(), [a, b, c])
}

fn degenerate(rng: &mut Rng) -> Case {
    let a = on_centre(rng, 0, 47);
    let (dx, dy) = (rng.int(-128, 128), rng.int(-128, 128));
    let along = |k: i64| sub(i64::from(a.x) + k * dx, i64::from(a.y) + k * dy);
    let corners = match rng.int(0, 3) {
        0 => [a, a, on_centre(rng, 0, 47)],
        1 => [a, a, a],
        _ => [a, along(rng.int(-64, 64)), along(rng.int(-64, 64))],
    };
    single(rng, window(), corners)
}

fn partly_off(rng: &mut Rng) -> Case {
    let corners = points(rng, -SIDE, 2 * SIDE);
    single(rng, window(), corners)
}

fn off_screen(rng: &mut Rng) -> Case {
    // Beyond one border, or around the corner so that only the bounding box is inside.
    let corners = match rng.int(0, 3) {
        0 => points(rng, -3 * SIDE, -1),
        1 => points(rng, SIDE + 1, 4 * SIDE),
        2 => points(rng, 0, SIDE).map_array(|p| moved(p, -(SIDE as i32), 0)),
        _ => {
            let (x, y) = (rng.int(1, SIDE), rng.int(1, SIDE));
            // Above the line x + y = 0 there is nothing of the window.
            [sub(-x, 0), sub(0, -y), sub(-x - SIDE, -y - SIDE)]
        }
    };
    single(rng, window(), corners)
}

fn huge(rng: &mut Rng) -> Case {
    let mut corners = [far_point(rng), far_point(rng), far_point(rng)];
    if rng.chance(2) {
        // Make an edge run through the window: mirror one end at a point inside it.
        let (p, a) = (point(rng, 0, SIDE), corners[0]);
        corners[1] = SubpixelPoint::new(mirrored(a.x, p.x), mirrored(a.y, p.y));
    }
    single(rng, window(), corners)
}

/// Each coordinate anywhere within 2^14 to 2^31 subpixels.
fn far_point(rng: &mut Rng) -> SubpixelPoint {
    let mut coordinates = [0; 2];
    for v in &mut coordinates {
        let limit = 1i64 << rng.int(14, 31);
        *v = rng.int(-limit, limit - 1);
    }
    sub(coordinates[0], coordinates[1])
}

/// A coordinate mirrored at another one, or the last one that there is on that side.
fn mirrored(v: i32, at: i32) -> i32 {
    let mirrored = 2 * i64::from(at) - i64::from(v);
    mirrored.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

fn near_tie(rng: &mut Rng) -> Case {
    let sample = on_centre(rng, 12, 36);
    let (dx, dy) = (rng.int(-3000, 3000), rng.int(-3000, 3000));
    let step = |k: i64| sub(i64::from(sample.x) + k * dx, i64::from(sample.y) + k * dy);
    let mut b = step(rng.int(1, 3));
    // Off by one subpixel, or not at all.
    b.x += rng.coordinate(-1, 1);
    b.y += rng.coordinate(-1, 1);
    let corners = [step(-rng.int(1, 3)), b, point(rng, 0, SIDE)];
    single(rng, window(), corners)
}

fn far(rng: &mut Rng) -> Case {
    let corners = if rng.chance(2) { points(rng, 0, SIDE) } else { on_centres(rng, 47) };
    let mut offset = [0; 2];
    for v in &mut offset {
        let px = 1i32 << [0, 11, 14, 22][rng.int(0, 3) as usize];
        *v = if rng.chance(2) { px } else { -px };
    }
    let [dx, dy] = offset;
    let corners = corners.map_array(|p| moved(p, dx * 256, dy * 256));
    let w = window();
    single(rng, PixelRect { x0: w.x0 + dx, y0: w.y0 + dy, x1: w.x1 + dx, y1: w.y1 + dy }, corners)
}

fn w_equal(rng: &mut Rng) -> Case {
    let w = 0.1 + 10.0 * rng.unit();
    perspective(rng, W::Equal(w))
}

fn w_up_to(rng: &mut Rng, ratio: f64) -> Case {
    perspective(rng, W::UpTo(ratio))
}

fn w_extreme(rng: &mut Rng) -> Case {
    perspective(rng, W::Extreme)
}

fn perspective(rng: &mut Rng, w: W) -> Case {
    let corners = if rng.chance(3) { on_centres(rng, 47) } else { points(rng, 0, SIDE) };
    let list = vec![dressed(rng, corners, w)];
    Case { window: window(), shape: Shape::Triangles { list, disjoint: true } }
}
