//! Frames of a textured mesh on every Vulkan device, held to pictures by hand and to the engines.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

use std::sync::Arc;

use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::scene::meshes;
use rasterproof_tiles::frames::{self, Samples};
use rasterproof_vulkan::device::draw::Painter;
use rasterproof_vulkan::device::find::{self, Listed};
use rasterproof_vulkan::device::mesh::{Corner, Surface};
use rasterproof_vulkan::device::open::Opened;
use rasterproof_vulkan::gpu::mesh::Filmed;

fn devices() -> Vec<Listed> {
    find::list().unwrap_or_else(|error| {
        assert!(std::env::var_os("RASTERPROOF_NEEDS_VULKAN").is_none(), "needed: {error}");
        eprintln!("skipped: no Vulkan device: {error}");
        Vec::new()
    })
}

const SIDE_PX: u32 = 64;
const BACKGROUND: [u8; 4] = [10, 20, 30, 255];
const TEXELS: [[u8; 4]; 4] =
    [[200, 0, 0, 255], [0, 200, 0, 255], [0, 0, 200, 255], [120, 120, 120, 255]];

/// A square between columns and rows from `low` to `high` px, at a depth, with 2 x 2 texels, lit by
/// `ambient` and half of what looks at the light.
fn square(surface: &mut Surface, low: f32, high: f32, depth: f32) {
    let first = surface.corners.len() as u32;
    let ndc = |px: f32| px / (SIDE_PX as f32 / 2.0) - 1.0;
    for (x, y, u, v) in
        [(low, low, 0.0, 1.0), (high, low, 1.0, 1.0), (high, high, 1.0, 0.0), (low, high, 0.0, 0.0)]
    {
        let position = [ndc(x), ndc(y), depth];
        surface.corners.push(Corner { position, normal: [0.0, 0.0, -3.0], uv: [u, v] });
    }
    surface.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
}

fn blank() -> Surface {
    let mut matrix = [0.0; 16];
    (0..4).for_each(|i| matrix[5 * i] = 1.0);
    Surface {
        corners: Vec::new(),
        indices: Vec::new(),
        texture_px: [2, 2],
        texels: TEXELS.to_vec(),
        matrix,
        light: [0.0, 0.0, -0.5, 0.25],
        background: BACKGROUND,
    }
}

/// What a square of this depth shows in a pixel: a texel, times 0.75 of light.
fn texel(x: u32, y: u32, low: u32, high: u32) -> [u8; 4] {
    let half = |px: u32| usize::from(2 * px >= low + high);
    let [r, g, b, a] = TEXELS[2 * half(y) + half(x)];
    [r / 4 * 3, g / 4 * 3, b / 4 * 3, a]
}

fn drawn(listed: &Listed, surface: &Surface, four: bool) -> Vec<[u8; 4]> {
    let mut painter = Painter::new(&Opened::new(listed).unwrap(), None).unwrap();
    let mut mesh = painter.prepare_mesh(surface, SIDE_PX, four).unwrap();
    // The second frame does not see the first.
    painter.draw_mesh(&mesh).unwrap();
    painter.draw_mesh(&mesh).unwrap();
    painter.read_mesh(&mut mesh).unwrap().as_chunks::<4>().0.to_vec()
}

/// Texels right way up, light, background, and the nearer of two whatever the order.
#[test]
fn squares_by_hand() {
    for listed in devices() {
        for depths in [[0.25, 0.5], [0.5, 0.25]] {
            let mut surface = blank();
            square(&mut surface, 8.0, 40.0, depths[0]);
            square(&mut surface, 24.0, 56.0, depths[1]);
            let picture = drawn(&listed, &surface, false);
            let within =
                |x: u32, y: u32, low, high| (low..high).contains(&x) && (low..high).contains(&y);
            for (x, y) in (0..SIDE_PX).flat_map(|y| (0..SIDE_PX).map(move |x| (x, y))) {
                let (first, second) = (within(x, y, 8, 40), within(x, y, 24, 56));
                let expected = match (first, second) {
                    (true, false) => texel(x, y, 8, 40),
                    (false, true) => texel(x, y, 24, 56),
                    (true, true) if depths[0] < depths[1] => texel(x, y, 8, 40),
                    (true, true) => texel(x, y, 24, 56),
                    (false, false) => BACKGROUND,
                };
                let got = picture[(y * SIDE_PX + x) as usize];
                // A product of the light is rounded before it becomes a byte.
                let near = (0..4).all(|i| got[i].abs_diff(expected[i]) <= 1);
                assert!(near, "{depths:?} ({x}, {y}): {got:?}, not {expected:?}");
            }
        }
    }
}

/// A border through the middle of pixels covers two of four samples, and the mean is half of each.
#[test]
fn four_samples_by_hand() {
    for listed in devices().into_iter().filter(|d| d.about.four_samples && d.about.standard_samples)
    {
        let mut surface = blank();
        surface.texels = vec![[200; 4]; 4];
        square(&mut surface, 8.5, 40.5, 0.5);
        let picture = drawn(&listed, &surface, true);
        for (px, share) in [(7, 0.0), (8, 0.5), (9, 1.0), (39, 1.0), (40, 0.5), (41, 0.0)] {
            for at in [20 * SIDE_PX + px, px * SIDE_PX + 20] {
                for (got, background) in picture[at as usize].into_iter().zip(BACKGROUND).take(3) {
                    let exact = share * 150.0 + (1.0 - share) * f64::from(background);
                    // Two roundings to bytes, of the colour and of the mean, by one at most each.
                    assert!((f64::from(got) - exact).abs() <= 2.0, "{px}: {got}, not {exact}");
                }
            }
        }
    }
}

/// A scene comes out as by the tiles. A device transforms in f32 and has a lattice of its own, so what a
/// pixel shows lies less than half a pixel away: its colour is between those that the tiles draw
/// there, four times as large. In the light, whose angle to a surface that is seen from the side changes
/// within a pixel, only where those hardly differ.
#[test]
fn a_scene_is_what_the_tiles_draw() {
    const LARGER: i32 = 4;
    let mut lit = meshes::scene("knot-2000").unwrap();
    lit.items[0].material.texture = Some(Arc::new(Texture::white()));
    let mut plain = lit.clone();
    plain.light = Light::NONE;
    let side = 256;
    for (listed, (scene, samples)) in devices().iter().flat_map(|listed| {
        [(&lit, Samples::One), (&plain, Samples::One), (&plain, Samples::Four)]
            .map(|case| (listed, case))
    }) {
        if samples == Samples::Four && !listed.about.four_samples {
            continue;
        }
        let is_lit = scene.light != Light::NONE;
        let large = side * LARGER as u32;
        let large = frames::render(scene, large, large, Samples::One).unwrap();
        let picture = Filmed::new(listed, scene, side, samples).unwrap().picture().unwrap();
        let (mut strays, mut judged) = (Vec::new(), 0);
        for (x, y) in (0..side as i32).flat_map(|y| (0..side as i32).map(move |x| (x, y))) {
            let got = picture.get(x, y).unwrap();
            let near = |px: i32| LARGER * px - LARGER / 2..LARGER * (px + 1) + LARGER / 2;
            let around = near(y).flat_map(|y| near(x).map(move |x| (x, y)));
            let around: Vec<_> = around.filter_map(|(x, y)| large.get(x, y)).collect();
            let range = |i: usize| {
                let low = around.iter().map(|c| c[i]).min().unwrap();
                (low, around.iter().map(|c| c[i]).max().unwrap())
            };
            if is_lit && (0..3).any(|i| range(i).1 - range(i).0 > 16) {
                continue;
            }
            judged += u32::from(got != scene.background);
            let is_between = |i: usize| {
                // A step for each of both roundings to a byte.
                range(i).0.saturating_sub(2) <= got[i] && got[i] <= range(i).1.saturating_add(2)
            };
            if !(0..3).all(is_between) {
                strays.push((x, y, got));
            }
        }
        assert!(strays.is_empty(), "{}, {samples:?}, {is_lit}: {strays:?}", listed.about.device);
        assert!(judged > side * side / 10, "{samples:?}, {is_lit}: {judged}");
    }
}

/// What cannot be drawn is refused, and what another painter prepared is not run.
#[test]
fn what_cannot_be_drawn_is_said() {
    for listed in devices() {
        let mut painter = Painter::new(&Opened::new(&listed).unwrap(), None).unwrap();
        let mut surface = blank();
        square(&mut surface, 8.0, 40.0, 0.5);
        let huge = painter.prepare_mesh(&surface, u32::MAX, false).err().unwrap().to_string();
        assert!(huge.contains("4294967295 px"), "{huge}");
        let mesh = painter.prepare_mesh(&surface, SIDE_PX, false).unwrap();
        let mut other = Painter::new(&Opened::new(&listed).unwrap(), None).unwrap();
        let run = std::panic::AssertUnwindSafe(|| other.draw_mesh(&mesh));
        assert!(std::panic::catch_unwind(run).is_err());
        painter.draw_mesh(&mesh).unwrap();
        let flat = meshes::scene("torus-2000").map(|mut scene| {
            scene.items.clear();
            scene
        });
        let error = Filmed::new(&listed, &flat.unwrap(), 64, Samples::One).err().unwrap();
        assert!(error.to_string().contains("torus-2000"), "{error}");
    }
}
