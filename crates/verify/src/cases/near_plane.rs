//! Families for programs alone, and for no engine here: which of several triangles is seen, what the near plane leaves of one,
//! meshes across the border of the window, where programs clip, and windows of hundreds of pixels.
//!
//! Numbers are few bits long, so that a request reads easily and f32 holds it exactly.

use glam::DVec2;

pub use super::clip::{ClipCorner, clip_corners};
use super::facts;
use super::{Case, Family, Shape, Triangle, designed, family, sub, wide};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

/// Every family of stages.
pub const FAMILIES: &[Family] = &[
    family("depth-order", "triangles before and through each other", piles),
    family("near-plane", "corners before, behind and in the near plane", near),
    family("depth-near-tie", "triangles that lie almost in one plane", near_ties),
    family("mesh-border", "meshes across the border of the window", across),
    family("wide-window", "triangles far to the right or far below in their window", far_inside),
    designed(facts::samples::TOPIC, "every two facts of the samples of a triangle together"),
    designed(facts::sample_values::TOPIC, "every two facts of the values of samples together"),
    designed(facts::meshes::TOPIC, "every two facts of a mesh together"),
    designed(facts::depth::TOPIC, "every two facts of some triangles together"),
    designed(facts::near::TOPIC, "every two facts of a triangle of clip space together"),
    family(
        "wide-line",
        "lines with a width, with samples on their border, thin ones, and long ones",
        wide::drawn,
    ),
    designed(facts::wide::TOPIC, "every two facts of a line with a width together"),
    family("area", "triangles of which pixels have small, large and equal shares", shares),
    designed(facts::area::TOPIC, "every two facts of the shares of pixels together"),
];

/// Side of the window of a pile, in pixels.
const SIDE_PX: u32 = 24;
/// Subpixels of a quarter of a pixel, which corners are multiples of.
const QUARTER: i64 = 64;

/// Two to five triangles, each with a depth of its own or leaning through the others; some of them
/// wholly behind, some drawn last and nearest.
fn piles(rng: &mut Rng) -> Case {
    let count = rng.int(2, 5);
    let leans = rng.chance(2);
    let side = i64::from(SIDE_PX) * 4;
    let list = (0..count).map(|_| {
        let plain = rng.int(0, 16);
        let vertices = [(); 3].map(|()| ScreenVertex {
            position: sub(rng.int(0, side) * QUARTER, rng.int(0, side) * QUARTER),
            depth: if leans { rng.int(0, 16) } else { plain } as f64 / 16.0,
            inv_w: 1.0,
            varying: DVec2::ZERO,
        });
        ScreenTriangle { vertices }
    });
    let list = list.collect();
    Case {
        window: PixelRect::window(SIDE_PX, SIDE_PX),
        shape: Shape::Triangles { list, disjoint: false },
    }
}

/// Two or three triangles in planes that are the same but for a step of 2^-6 to 2^-24 between their depths, along which
/// some of them also lean. Depths of fewer bits are equal there.
fn near_ties(rng: &mut Rng) -> Case {
    let step = f64::from(2).powi(-(rng.int(6, 24) as i32));
    let count = rng.int(2, 3);
    let (base, leans) = (rng.int(0, 1 << 6) as f64 / 128.0, rng.chance(2));
    let slope = [(); 3].map(|()| if leans { rng.int(0, 1 << 5) as f64 / 128.0 } else { 0.0 });
    let side = i64::from(SIDE_PX) * 4;
    let corners = [(); 3].map(|()| sub(rng.int(0, side) * QUARTER, rng.int(0, side) * QUARTER));
    let list = (0..count).map(|_| {
        let steps = rng.int(0, 8) as f64;
        let mut corner = 0;
        // The same corners, so that the planes are parallel.
        let vertices = corners.map(|position| {
            corner += 1;
            let depth = base + slope[corner - 1] + steps * step;
            ScreenVertex { position, depth, inv_w: 1.0, varying: DVec2::ZERO }
        });
        ScreenTriangle { vertices }
    });
    let list = list.collect();
    Case {
        window: PixelRect::window(SIDE_PX, SIDE_PX),
        shape: Shape::Triangles { list, disjoint: false },
    }
}

/// A triangle of clip space, as [`clip_corners`] reads it: z + w is what the near plane asks.
fn near(rng: &mut Rng) -> Case {
    // Corners in the plane are what formulas with a division forget.
    let in_plane = rng.chance(3).then(|| rng.int(0, 2));
    // Some lie wholly behind it.
    let [w_most, z_most] = if rng.chance(5) { [4, 0] } else { [12, 12] };
    let mut number = 0;
    let mut vertices = [(); 3].map(|()| {
        let quarters = |rng: &mut Rng, low: i64, high: i64| rng.int(4 * low, 4 * high) as f64 / 4.0;
        let position = sub(rng.int(-64, 64) * QUARTER, rng.int(-64, 64) * QUARTER);
        let w = quarters(rng, -4, w_most);
        let depth = if in_plane == Some(number) { -w } else { quarters(rng, -12, z_most) };
        number += 1;
        ScreenVertex { position, depth, inv_w: 1.0, varying: DVec2::new(w, 0.0) }
    });
    // The attributes of two corners are never the same.
    for (v, of_corner) in vertices.iter_mut().zip([-20, 0, 20]) {
        v.varying.y = (of_corner + rng.int(-8, 8)) as f64 / 4.0;
    }
    let list = vec![ScreenTriangle { vertices }];
    Case {
        window: PixelRect::window(SIDE_PX, SIDE_PX),
        shape: Shape::Triangles { list, disjoint: true },
    }
}

/// Triangles of some pixels: those with corners on a coarse grid have shares that are simple fractions, others hardly touch a pixel.
fn shares(rng: &mut Rng) -> Case {
    let step = 1 << rng.int(0, 8);
    let most = [2 << 8, 8 << 8, 12 << 8][rng.int(0, 2) as usize];
    let vertices = [(); 3].map(|()| {
        let [x, y] = [(); 2].map(|()| rng.int(-256, most) / step * step);
        ScreenVertex { position: sub(x, y), depth: 0.0, inv_w: 1.0, varying: DVec2::ZERO }
    });
    let list = vec![ScreenTriangle { vertices }];
    let [width, height] = [(); 2].map(|()| rng.int(6, 12) as u32);
    Case {
        window: PixelRect::window(width, height),
        shape: Shape::Triangles { list, disjoint: true },
    }
}

/// A fan around a point near the border; some of them reach far beyond a guard band.
fn across(rng: &mut Rng) -> Case {
    let side = i64::from(SIDE_PX) * 256;
    let reach = if rng.chance(4) { 1 << rng.int(12, 20) } else { side };
    let border = |rng: &mut Rng| if rng.chance(2) { 0 } else { side } + rng.int(-512, 512);
    let along = rng.int(0, side);
    let middle = if rng.chance(2) { [border(rng), along] } else { [along, border(rng)] };
    let count = rng.int(3, 6);
    // Rays through points of a square that stands on a corner, each less than half a turn from the next.
    let start = rng.int(0, 4095);
    let ring: Vec<[i64; 2]> = (0..count)
        .map(|i| {
            let at = (start + i * 4096 / count) % 4096;
            let (quarter, along) = (at / 1024, at % 1024);
            let [x, y] = [1024 - along, along];
            let ray = [[x, y], [-y, x], [-x, -y], [y, -x]][quarter as usize];
            let length = rng.int(reach / 8, reach);
            [0, 1].map(|k| middle[k] + ray[k] * length / 1024)
        })
        .collect();
    let vertex = |[x, y]: [i64; 2]| ScreenVertex {
        position: sub(x, y),
        depth: 0.0,
        inv_w: 1.0,
        varying: DVec2::ZERO,
    };
    let list: Vec<Triangle> = (0..ring.len())
        .map(|i| [middle, ring[i], ring[(i + 1) % ring.len()]].map(vertex))
        .map(|vertices| ScreenTriangle { vertices })
        .collect();
    let turns = |t: &Triangle| {
        let [a, b, c] = t.corners().map(|p| [i64::from(p.x), i64::from(p.y)]);
        (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
    };
    let disjoint = list.iter().all(turns);
    Case { window: PixelRect::window(SIDE_PX, SIDE_PX), shape: Shape::Triangles { list, disjoint } }
}

/// The largest side of a window, in pixels: programs that declare none draw windows of 1024.
const WIDEST_PX: i64 = 1024;

/// Some triangle whose columns, or rows, pass what short words hold.
fn far_inside(rng: &mut Rng) -> Case {
    let (side, far) = (i64::from(SIDE_PX), 1 << rng.int(6, 10));
    let at = rng.int(far / 2, far).min(WIDEST_PX - side);
    let is_wide = rng.chance(2);
    let vertices = [(); 3].map(|()| {
        let [along, across] = [at, 0].map(|px| (px * 4 + rng.int(0, side * 4)) * QUARTER);
        let position = if is_wide { sub(along, across) } else { sub(across, along) };
        ScreenVertex { position, depth: 0.0, inv_w: 1.0, varying: DVec2::ZERO }
    });
    let long = (at + side) as u32;
    let [width, height] = if is_wide { [long, SIDE_PX] } else { [SIDE_PX, long] };
    Case {
        window: PixelRect::window(width, height),
        shape: Shape::Triangles { list: vec![ScreenTriangle { vertices }], disjoint: true },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the near plane: all, nothing, three and four corners left, and corners in the plane.
    #[test]
    fn the_near_plane_is_met_in_every_way() {
        let mut behind = [0; 4];
        let mut in_plane = 0;
        for index in 0..400 {
            let Shape::Triangles { list, .. } = FAMILIES[1].case(1, index).shape else { continue };
            let sides = clip_corners(&list[0]).map(|[_, _, z, w, _]| z + w);
            behind[sides.iter().filter(|s| **s < 0.0).count()] += 1;
            in_plane += sides.iter().filter(|s| **s == 0.0).count();
        }
        assert!(behind.iter().all(|n| *n > 20) && in_plane > 100, "{behind:?} {in_plane}");
    }
}
