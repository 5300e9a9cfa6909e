//! Families of generated lines, between whole pixels.

use glam::DVec2;

use super::facts;
use super::{Case, Family, Shape, designed, family, pixel};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};

/// Every family of lines.
pub const FAMILIES: &[Family] = &[
    family("line-octants", "all directions inside the window", octants),
    family("line-ties", "even lengths that pass halfway between pixels", ties),
    family("line-axis", "horizontal, vertical and diagonal", axis),
    family("line-points", "zero length, and one step", points),
    family("line-clipped", "across the borders of the window", clipped),
    family("line-far", "up to 2^31 pixels away, often through the window", far),
    designed(facts::lines::TOPIC, "every two facts of a line together"),
];

const SIDE_PX: u32 = 40;
const SIDE: i64 = SIDE_PX as i64;

fn line(rng: &mut Rng, a: PixelPoint, b: PixelPoint) -> Case {
    let mut end = |pixel| LineEnd {
        pixel,
        depth: rng.unit(),
        varying: DVec2::new(rng.signed(), rng.signed() * 100.0),
    };
    let ends = [end(a), end(b)];
    Case {
        window: PixelRect::window(SIDE_PX, SIDE_PX),
        shape: Shape::Lines(vec![ScreenLine { ends }]),
    }
}

fn inside(rng: &mut Rng) -> PixelPoint {
    PixelPoint::new(rng.coordinate(0, SIDE - 1), rng.coordinate(0, SIDE - 1))
}

fn octants(rng: &mut Rng) -> Case {
    let (a, b) = (inside(rng), inside(rng));
    line(rng, a, b)
}

fn ties(rng: &mut Rng) -> Case {
    // A height of du k / (2 du) with k odd is halfway: make dv/du = odd/even in lowest terms.
    let (half, odd) = (rng.int(1, 6), 2 * rng.int(0, 5) + 1);
    let (du, dv) = (2 * half, odd.min(2 * half - 1));
    let times = rng.int(1, 3);
    let (mut dx, mut dy) = (du * times, dv * times);
    if rng.chance(2) {
        (dx, dy) = (dy, dx);
    }
    let start = (rng.int(-4, SIDE), rng.int(-4, SIDE));
    let (sx, sy) = (if rng.chance(2) { 1 } else { -1 }, if rng.chance(2) { 1 } else { -1 });
    line(rng, pixel(start.0, start.1), pixel(start.0 + sx * dx, start.1 + sy * dy))
}

fn axis(rng: &mut Rng) -> Case {
    let a = inside(rng);
    let length = rng.coordinate(-SIDE, SIDE);
    let (dx, dy) = [(1, 0), (0, 1), (1, 1), (1, -1)][rng.int(0, 3) as usize];
    line(rng, a, PixelPoint::new(a.x + dx * length, a.y + dy * length))
}

fn points(rng: &mut Rng) -> Case {
    let a = PixelPoint::new(rng.coordinate(-2, SIDE + 1), rng.coordinate(-2, SIDE + 1));
    let b = PixelPoint::new(a.x + rng.coordinate(-1, 1), a.y + rng.coordinate(-1, 1));
    let b = if rng.chance(2) { a } else { b };
    line(rng, a, b)
}

fn clipped(rng: &mut Rng) -> Case {
    let mut end = || pixel(rng.int(-3 * SIDE, 4 * SIDE), rng.int(-3 * SIDE, 4 * SIDE));
    let (a, b) = (end(), end());
    line(rng, a, b)
}

fn far(rng: &mut Rng) -> Case {
    let mut away = || {
        let limit = 1i64 << rng.int(8, 31);
        rng.int(-limit, limit - 1)
    };
    let (ax, ay, bx, by) = (away(), away(), away(), away());
    if rng.chance(4) {
        return line(rng, pixel(ax, ay), pixel(bx, by));
    }
    // Mirror one end at a pixel inside, so that the line runs through the window.
    let p = inside(rng);
    let mirror =
        |p: i32, a: i64| (2 * i64::from(p) - a).clamp(i64::from(i32::MIN), i64::from(i32::MAX));
    let b = pixel(mirror(p.x, ax), mirror(p.y, ay));
    line(rng, pixel(ax, ay), b)
}
