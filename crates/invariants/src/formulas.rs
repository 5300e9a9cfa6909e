//! Invariants 48 to 51: the formulas of effects. How colours are mixed, in which order, how often and at which level a
//! texture is read, and that a plane keeps no light from itself.

use glam::{DMat4, DVec2, DVec3};

use super::Outcome;
use super::implementations::Implementations;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::random::Rng;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_render::pipeline::footprint::Footprint;
use rasterproof_render::pipeline::layers::Layer;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::shadow::{LightView, TAPS};
use rasterproof_render::pipeline::target::Colour;
use rasterproof_render::scene::Shadows;
use rasterproof_render::scene::{Item, Material, Scene, shapes};

/// Any colour that hides all that is behind it.
fn colour(rng: &mut Rng) -> Colour {
    let mut channel = || rng.int(0, 255) as u8;
    [channel(), channel(), channel(), u8::MAX]
}

/// 48: every opacity with random colours.
pub(super) fn over(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    // The exact mixture is a number over 255, and the byte next to it is at most half a step away.
    let over = subject.formulas.over;
    let mut rng = Rng::new("over", seed, 0);
    let mut checked = 0;
    for _ in 0..cases {
        // Every opacity there is, with three colours.
        let [a, b, c] = [0; 3].map_array(|_| colour(&mut rng));
        for opacity in 0..=u8::MAX {
            let mixed = over(a, b, opacity);
            for (i, mixed) in mixed[..3].iter().enumerate() {
                let (alpha, rest) = (i32::from(opacity), 255 - i32::from(opacity));
                let exact = alpha * i32::from(a[i]) + rest * i32::from(b[i]);
                if 2 * (255 * i32::from(*mixed) - exact).abs() > 255 {
                    return Err(format!(
                        "{} over {} at an opacity of {opacity}/255 is {mixed}",
                        a[i], b[i]
                    ));
                }
            }
            // Each of the two that are mixed is all or nothing.
            for outer in [0, u8::MAX] {
                let right = over(a, over(b, c, opacity), outer);
                let left = if outer == 0 { over(b, c, opacity) } else { a };
                if left != right {
                    return Err(format!("an opacity of {outer} mixes {a:?} with {b:?} over {c:?}"));
                }
            }
            checked += 1;
        }
    }
    Ok(checked)
}

/// 49: lists of layers, many of which have the same depth, in random orders.
pub(super) fn layers(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let mut rng = Rng::new("layers", seed, 0);
    for case in 0..cases {
        // So few depths that layers often share one.
        let count = rng.int(1, 7) as usize;
        let mut layer = || Layer {
            plane: 0,
            y_px: 0,
            x_px: 0,
            key: rng.int(0, 4) as u64,
            opacity: rng.int(1, 254) as u8,
            colour: colour(&mut rng),
        };
        let drawn: Vec<Layer> = (0..count).map(|_| layer()).collect();
        // How many layers are kept, the depth of what is opaque, and its colour.
        let (most, stored) = (rng.int(1, 8) as u32, rng.int(0, 5) as u64);
        let below = colour(&mut rng);
        let mix = |layers: &[Layer]| (subject.formulas.mix)(layers, most, stored, below);
        // Whoever sorts by depth alone mixes layers of one depth in the order in which they came.
        let first = mix(&drawn);
        let mut order = drawn.clone();
        for _ in 0..6 {
            // A shuffle in which every order is equally likely (Fisher and Yates).
            for i in (1..order.len()).rev() {
                order.swap(i, rng.int(0, i as i64) as usize);
            }
            let other = mix(&order);
            if other != first {
                return Err(format!(
                    "case {case}: {count} layers come to {first:?} and, in another order, {other:?}"
                ));
            }
        }
        // What lies behind the stored depth is hidden by what is opaque there.
        let seen: Vec<Layer> = drawn.iter().copied().filter(|layer| layer.key < stored).collect();
        if mix(&seen) != first {
            return Err(format!("case {case}: a layer behind what is opaque changes the colour"));
        }
    }
    Ok(cases)
}

/// 50: a footprint `ratio` times as long as wide, turned, and the same half and a quarter as large in the window.
///
/// Levels are logarithms below 64, and powers of two change no other bit: each is off by two roundings at most, of 2^-47.
pub(super) fn footprints(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    const MARGIN: f64 = 4.0 / (1u64 << 47) as f64;
    const SIDE: u32 = 64;
    const MOST: u8 = 16;
    let mut rng = Rng::new("footprints", seed, 0);
    let mut checked = 0;
    for case in 0..cases {
        let ratio = rng.int(1, MOST.into()) as u8;
        let angle = DVec2::new(rng.signed(), rng.signed()).normalize_or(DVec2::X);
        // Texels a pixel along the shorter axis, more than one.
        let texels = 1.0 + 3.0 * rng.unit();
        let side = 1 << 14;
        let mut before: Option<f64> = None;
        for halvings in 0..3 {
            let side = side >> halvings;
            let corners =
                [[0, 0], [side, 0], [0, side]].map_array(|[x, y]| SubpixelPoint::new(x, y));
            let pixels = DVec2::splat(64.0);
            // From places of the triangle to texture coordinates: turned, then longer along one axis.
            let to_uv = |at: DVec2| {
                let turned = angle.rotate(at * pixels);
                turned * DVec2::new(texels, texels * f64::from(ratio)) / f64::from(SIDE)
            };
            let uv = [DVec2::ZERO, DVec2::X, DVec2::Y].map_array(to_uv);
            let footprint = Footprint::new(corners, [1.0; 3], uv, (SIDE, SIDE));
            let found = (subject.formulas.taps)(&footprint, uv[0], 1.0, MOST);
            // As often as it is longer than wide, at most so often; a ratio near a half may be rounded either way.
            let [x, y] = footprint.lengths(uv[0], 1.0);
            let longer = x.max(y);
            let expected = (longer / x.min(y)).round() as u8;
            let is_near_half = ((longer / x.min(y)).fract() - 0.5).abs() < 0.5f64.powi(10);
            if !is_near_half && found.count != expected.clamp(1, MOST) {
                return Err(format!(
                    "case {case}: a footprint {:.3} times as long as wide is read {} times",
                    longer / x.min(y),
                    found.count
                ));
            }
            // The level at which one reading is a texel long.
            let level = libm::log2(longer / f64::from(found.count));
            if (found.level - level).abs() > MARGIN {
                return Err(format!("case {case}: the level is {}, and not {level}", found.level));
            }
            // Half the size in the window is twice as many texels a pixel, so one level more.
            if let Some(before) = before
                && (found.level - before - 1.0).abs() > MARGIN
            {
                return Err(format!(
                    "case {case}: half as large, the level is {} after {before}",
                    found.level
                ));
            }
            before = Some(found.level);
            checked += 1;
        }
    }
    Ok(checked)
}

/// 51: random planes in random light, with something beside them that gives the map a depth.
pub(super) fn planes_in_light(subject: &Implementations, seed: u64, cases: u64) -> Outcome {
    let mut rng = Rng::new("planes in light", seed, 0);
    let mut checked = 0;
    for case in 0..cases {
        let mut direction =
            || DVec3::new(rng.signed(), rng.signed(), rng.signed()).normalize_or(DVec3::Z);
        // The side of the plane that is lit.
        let (normal, towards) = (direction(), direction());
        let towards = if towards.dot(normal) < 0.0 { -towards } else { towards };
        // A triangle in the plane through the origin, and a small one behind it, so that the map has a range of depths.
        let (u, v) = normal.any_orthonormal_pair();
        let mut corner = || u * rng.signed() + v * rng.signed();
        let corners = [corner(), corner(), corner()];
        let plane = shapes::triangle(corners, [DVec3::ONE; 3]);
        let away = -normal * 3.0;
        let beside = shapes::triangle([away, away + u * 0.1, away + v * 0.1], [DVec3::ONE; 3]);
        let mut scene = Scene::new("plane", "", DMat4::IDENTITY);
        scene.items = [plane, beside].map(|mesh| Item::new(mesh, Material::default())).to_vec();
        // Coarse maps and fine ones, in each of three formats.
        let [size, bits] =
            [[16, 100, 512], [16, 24, 32]].map_array(|of| of[rng.int(0, 2) as usize]);
        scene.shadows = Some(Shadows { size, bits });
        scene.light = Light { towards, ambient: 0.25, diffuse: 0.75 };
        let Some(view) = LightView::new(&scene) else { continue };
        let map = view.map(&scene, &Scanline);
        let places = [0, 1, 2].map_array(|i: u32| view.place(0, i));
        for _ in 0..16 {
            // A place in the triangle: one in the other half of its parallelogram is turned into it.
            let (mut s, mut t) = (rng.unit(), rng.unit());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let place = places[0] + (places[1] - places[0]) * s + (places[2] - places[0]) * t;
            let lit = (subject.formulas.lit)(&view, map, places, place);
            if lit != TAPS {
                return Err(format!("case {case}: {lit} of {TAPS} parts of the light arrive"));
            }
            checked += 1;
        }
    }
    Ok(checked)
}
