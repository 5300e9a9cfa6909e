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
    family("w-4", "w ratio up to 4", |rng| perspective(rng, |rng| spread(rng, 4.0))),
    family("w-100", "w ratio up to 100", |rng| perspective(rng, |rng| spread(rng, 100.0))),
    family("w-1e4", "w ratio up to 10,000", |rng| perspective(rng, |rng| spread(rng, 1e4))),
    family("w-1e6", "w ratio up to 1,000,000", |rng| perspective(rng, |rng| spread(rng, 1e6))),
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

/// A triangle with random depth and attributes and w between 1 and 4.
fn dressed(rng: &mut Rng, corners: Corners) -> Triangle {
    dressed_with(rng, corners, |rng| 1.0 + 3.0 * rng.unit())
}

fn dressed_with(rng: &mut Rng, corners: Corners, mut w: impl FnMut(&mut Rng) -> f64) -> Triangle {
    let vertices = corners.map_array(|position| ScreenVertex {
        position,
        depth: rng.unit(),
        inv_w: 1.0 / w(rng),
        varying: DVec2::new(rng.signed(), rng.signed() * 100.0),
    });
    ScreenTriangle { vertices }
}

fn single(rng: &mut Rng, window: PixelRect, corners: Corners) -> Case {
    mesh(rng, window, [corners], true)
}

fn mesh(
    rng: &mut Rng,
    window: PixelRect,
    corners: impl IntoIterator<Item = Corners>,
    disjoint: bool,
) -> Case {
    let list = corners.into_iter().map(|corners| dressed(rng, corners)).collect();
    Case { window, shape: Shape::Triangles { list, disjoint } }
}

fn point(rng: &mut Rng, low: i64, high: i64) -> SubpixelPoint {
    SubpixelPoint::new(rng.coordinate(low, high), rng.coordinate(low, high))
}

fn points(rng: &mut Rng, low: i64, high: i64) -> Corners {
    [(); 3].map_array(|()| point(rng, low, high))
}

/// A point on a pixel centre, pixels low..=high.
fn on_centre(rng: &mut Rng, low_px: i64, high_px: i64) -> SubpixelPoint {
    centre_of(rng.coordinate(low_px, high_px), rng.coordinate(low_px, high_px))
}

fn uniform(rng: &mut Rng) -> Case {
    let corners = points(rng, 0, SIDE);
    single(rng, window(), corners)
}

fn half_integer(rng: &mut Rng) -> Case {
    let corners = [(); 3].map_array(|()| on_centre(rng, 0, 15));
    single(rng, PixelRect::window(16, 16), corners)
}

fn rectangle(rng: &mut Rng) -> Case {
    let (a, b) = (on_centre(rng, 0, 15), on_centre(rng, 0, 15));
    let (c, d) = (SubpixelPoint::new(b.x, a.y), SubpixelPoint::new(a.x, b.y));
    let split = if rng.chance(2) { [[a, c, b], [a, b, d]] } else { [[c, b, d], [c, d, a]] };
    mesh(rng, PixelRect::window(16, 16), split, true)
}

/// Spokes go to points on a square ring, which needs no sines, pulled in by a random factor.
fn fan(rng: &mut Rng) -> Case {
    let centre =
        if rng.chance(4) { point(rng, 10 * 256, 22 * 256) } else { on_centre(rng, 10, 21) };
    let spokes = rng.int(5, 12);
    let reach = rng.int(256, 10 * 256);
    let perimeter = 8 * reach;
    let ring: Vec<_> = (0..spokes)
        .map(|spoke| {
            let along = (perimeter * spoke + rng.int(0, perimeter - 1)) / spokes;
            let (side, rest) = (along / (2 * reach), along % (2 * reach) - reach);
            let (x, y) = match side {
                0 => (rest, -reach),
                1 => (reach, rest),
                2 => (-rest, reach),
                _ => (-reach, -rest),
            };
            let pull = rng.int(128, 256);
            (x * pull / 256, y * pull / 256)
        })
        .collect();
    let next = |i: usize| ring[(i + 1) % ring.len()];
    // Rounding may have folded a thin slice over; then it is no fan.
    let disjoint = (0..ring.len()).all(|i| ring[i].0 * next(i).1 - ring[i].1 * next(i).0 > 0);
    let tip = |(x, y): (i64, i64)| sub(i64::from(centre.x) + x, i64::from(centre.y) + y);
    let corners: Vec<_> = (0..ring.len()).map(|i| [centre, tip(ring[i]), tip(next(i))]).collect();
    mesh(rng, PixelRect::window(32, 32), corners, disjoint)
}

fn strip(rng: &mut Rng) -> Case {
    let on_centres = rng.chance(2);
    let snap = |sub: i64| if on_centres { sub.div_euclid(256) * 256 + 128 } else { sub };
    let mut x = rng.int(0, 2 * 256);
    let vertices: Vec<_> = (0..rng.int(4, 9))
        .map(|i| {
            x += rng.int(256, 5 * 256);
            let y = if i % 2 == 0 { rng.int(0, 10 * 256) } else { rng.int(14 * 256, 31 * 256) };
            sub(snap(x), snap(y))
        })
        .collect();
    let corners: Vec<_> = vertices.windows(3).map(|v| [v[0], v[1], v[2]]).collect();
    mesh(rng, PixelRect::window(48, 32), corners, true)
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
    let corners = near_line(rng).map_array(|p| SubpixelPoint::new(p.y, p.x));
    single(rng, window(), corners)
}

/// Two points within three subpixels of a row of centres, the third one there as well or far away.
fn near_line(rng: &mut Rng) -> Corners {
    let row = rng.int(4, 40) * 256 + 128;
    let near = |rng: &mut Rng| sub(rng.int(0, SIDE), row + rng.int(-3, 3));
    let (a, b) = (near(rng), near(rng));
    let c = if rng.chance(2) { near(rng) } else { point(rng, 0, SIDE) };
    [a, b, c]
}

fn tiny(rng: &mut Rng) -> Case {
    let corner = point(rng, 0, 7 * 256);
    let corners = [(); 3].map_array(|()| {
        SubpixelPoint::new(corner.x + rng.coordinate(0, 255), corner.y + rng.coordinate(0, 255))
    });
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
        2 => points(rng, 0, SIDE).map_array(|p| SubpixelPoint::new(p.x - SIDE as i32, p.y)),
        _ => {
            let (x, y) = (rng.int(1, SIDE), rng.int(1, SIDE));
            // Above the line x + y = 0 there is nothing of the window.
            [sub(-x, 0), sub(0, -y), sub(-x - SIDE, -y - SIDE)]
        }
    };
    single(rng, window(), corners)
}

fn huge(rng: &mut Rng) -> Case {
    let far = |rng: &mut Rng| {
        let bits = rng.int(14, 31);
        let limit = 1i64 << bits;
        rng.int(-limit, limit - 1)
    };
    let mut corners = [(); 3].map_array(|()| sub(far(rng), far(rng)));
    if rng.chance(2) {
        // Make an edge run through the window: mirror one end at a point inside it.
        let (p, a) = (point(rng, 0, SIDE), corners[0]);
        let mirror = |p: i32, a: i32| {
            (2 * i64::from(p) - i64::from(a)).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        };
        corners[1] = SubpixelPoint::new(mirror(p.x, a.x), mirror(p.y, a.y));
    }
    single(rng, window(), corners)
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
    let corners = if rng.chance(2) {
        points(rng, 0, SIDE)
    } else {
        [(); 3].map_array(|()| on_centre(rng, 0, 47))
    };
    let offset = |rng: &mut Rng| {
        let px = 1i32 << [0, 11, 14, 22][rng.int(0, 3) as usize];
        if rng.chance(2) { px } else { -px }
    };
    let (dx, dy) = (offset(rng), offset(rng));
    let moved = corners.map_array(|p| SubpixelPoint::new(p.x + dx * 256, p.y + dy * 256));
    let w = window();
    single(rng, PixelRect { x0: w.x0 + dx, y0: w.y0 + dy, x1: w.x1 + dx, y1: w.y1 + dy }, moved)
}

fn w_equal(rng: &mut Rng) -> Case {
    let w = 0.1 + 10.0 * rng.unit();
    perspective(rng, |_| w)
}

fn w_extreme(rng: &mut Rng) -> Case {
    // 1 to 2 times a power of two: exact, and the same on every machine.
    perspective(rng, |rng| {
        let exponent = rng.int(-200, 199) + 1023;
        (1.0 + rng.unit()) * f64::from_bits((exponent as u64) << 52)
    })
}

/// A w in [1, ratio]: often one of the ends, since the whole ratio is the danger.
fn spread(rng: &mut Rng, ratio: f64) -> f64 {
    match rng.int(0, 2) {
        0 => 1.0,
        1 => ratio,
        _ => 1.0 + (ratio - 1.0) * rng.unit(),
    }
}

fn perspective(rng: &mut Rng, w: impl FnMut(&mut Rng) -> f64) -> Case {
    let corners = if rng.chance(3) {
        [(); 3].map_array(|()| on_centre(rng, 0, 47))
    } else {
        points(rng, 0, SIDE)
    };
    let list = vec![dressed_with(rng, corners, w)];
    Case { window: window(), shape: Shape::Triangles { list, disjoint: true } }
}
