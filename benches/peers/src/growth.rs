//! How time and memory of a frame grow: with triangles, pixels, surfaces behind each other, lights and texels,
//! by the scanline, and by the tiles on one core and on two.
//!
//! Each point alternates its engines. The memory of an engine is the peak of a process that draws one
//! frame, less what it had before: the picture, its target and all that it keeps, without the scene.

use std::f64::consts::TAU;
use std::fs;
use std::num::NonZeroU32;
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DMat4, DVec3};
use rasterproof_core::angle::sin_cos;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity};
use rasterproof_render::pipeline::physical::Physical;
use rasterproof_render::pipeline::punctual::{Kind, PunctualLight};
use rasterproof_render::pipeline::target::{Antialias, Colour};
use rasterproof_render::pipeline::transform::perspective;
use rasterproof_render::scene::{Item, Material, Scene, meshes, shapes, textures};
use rasterproof_tiles::frames::{Samples, not_drawn};
use serde::Serialize;

use crate::frames::{Draw, engine, tiles};
use crate::spread::Spread;

const SIDE_PX: u32 = 1024;
/// Frames of each engine at a point, unless they take longer than this together.
const ROUNDS: usize = 9;
const PATIENCE: Duration = Duration::from_secs(4);

#[derive(Serialize)]
pub struct Row {
    /// The name of what grows, the same for all points of a curve.
    pub what: &'static str,
    pub at: u64,
    pub engine: &'static str,
    pub cores: usize,
    pub samples: u32,
    pub ms: Spread,
    pub megabytes: f64,
}

struct Point {
    what: &'static str,
    at: u64,
    scene: Scene,
    side_px: u32,
}

/// All points, in order; a function each, since only one scene of ten million triangles fits at a time.
fn points(quick: bool) -> Vec<Box<dyn Fn() -> Option<Point>>> {
    let up_to = |all: &[u32]| all[..if quick { 2 } else { all.len() }].to_vec();
    let mut points: Vec<Box<dyn Fn() -> Option<Point>>> = Vec::new();
    let mut add = |what, at: u32, side_px, scene: fn(u32) -> Option<Scene>| {
        points.push(Box::new(move || {
            Some(Point { what, at: at.into(), scene: scene(at)?, side_px })
        }));
    };
    for triangles in
        up_to(&[1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000])
    {
        add("triangles", triangles, SIDE_PX, |at| meshes::sized("bumps", at));
    }
    for side_px in up_to(&[256, 512, 1024, 2048, 4096, 8192]) {
        add("side", side_px, side_px, |_| meshes::sized("bumps", 4000));
    }
    for count in up_to(&[1, 2, 4, 8, 16, 32, 64, 128]) {
        add("surfaces, farthest first", count, SIDE_PX, |at| surfaces(at, None));
        if count <= 32 {
            add("surfaces, mixed", count, SIDE_PX, |at| surfaces(at, Some(at)));
        }
    }
    for lights in up_to(&[1, 2, 4, 8, 16, 32, 64, 128]) {
        add("lights", lights, SIDE_PX, lit);
    }
    for side in up_to(&[8, 32, 128, 512, 2048, 8192]) {
        add("texels along a side", side, SIDE_PX, textured);
    }
    points
}

/// Squares behind each other that fill the picture, each drawn before what is in front of it.
fn surfaces(count: u32, layers: Option<u32>) -> Option<Scene> {
    let mut scene =
        Scene::new("surfaces", "squares behind each other", perspective(0.7, 1.0, 1.0, 10.0).ok()?);
    for i in (0..count).rev() {
        let z = 2.0 + 6.0 * f64::from(i) / f64::from(count);
        let corners = [(-z, -z), (-z, z), (z, z), (z, -z)].map(|(x, y)| DVec3::new(x, y, z));
        let opacity = layers.map(|_| Opacity { factor: 0.5, map: None, mode: AlphaMode::Blend });
        let colour = DVec3::new(0.9, 0.4 + 0.5 * f64::from(i) / f64::from(count), 0.3);
        let material = Material { colour, opacity, ..Material::default() };
        scene.items.push(Item::new(shapes::quad(corners), material));
    }
    scene.layers = layers.and_then(NonZeroU32::new);
    Some(scene)
}

/// Lights without a range on a ring around the eye, so that all of what is seen faces nearly all of them.
fn lit(lights: u32) -> Option<Scene> {
    let mut scene = meshes::sized("bumps", 4000)?;
    let physical = Physical { roughness: 0.5, ..Physical::default() };
    scene.items[0].material.physical = Some(Arc::new(physical));
    let light = PunctualLight::new(
        Kind::Point { range: f64::INFINITY },
        DVec3::ONE,
        60.0 / f64::from(lights),
    );
    scene.punctual = (0..lights)
        .map(|i| {
            let (sin, cos) = sin_cos(TAU * f64::from(i) / f64::from(lights));
            light.placed(DMat4::from_translation(DVec3::new(cos, sin, 0.0)))
        })
        .collect();
    Some(scene)
}

fn textured(side: u32) -> Option<Scene> {
    let mut scene = meshes::sized("bumps", 4000)?;
    let texture = textures::generate(side, |x, y| {
        // Neighbours differ, so that no two reads are alike.
        let mixed = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca6b)) >> 8;
        DVec3::new(f64::from(mixed & 255), f64::from(mixed >> 8 & 255), f64::from(mixed >> 16))
            / 255.0
    });
    scene.items[0].material.texture = Some(Arc::new(texture));
    Some(scene)
}

type Make<'a> = Box<dyn Fn() -> Draw<'a> + 'a>;

/// Measures every curve, or the first two points of each, and calls back after each point.
pub fn measure(quick: bool, pools: &[rayon::ThreadPool], mut done: impl FnMut(&[Row])) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, point) in points(quick).into_iter().enumerate() {
        let Some(point) = point() else { continue };
        let mut all = at(&point, if quick { 1 } else { ROUNDS }, pools);
        drop(point);
        for (engine, row) in all.iter_mut().enumerate() {
            row.megabytes = megabytes_apart(quick, i, engine)
                .expect("a process of its own draws the same point");
        }
        done(&all);
        rows.extend(all);
    }
    rows
}

type Makers<'a> = Vec<(&'static str, usize, u32, Make<'a>)>;

fn makers<'a>(point: &'a Point, pools: &'a [rayon::ThreadPool]) -> Makers<'a> {
    let Point { scene, side_px, .. } = point;
    let mut makers: Makers<'a> = vec![(
        "scanline",
        1,
        1,
        Box::new(move || Box::new(engine(Drawer::Scanline, scene, *side_px, Antialias::None))),
    )];
    if not_drawn(scene) == 0 {
        for (samples, planes) in [(1, Samples::One), (4, Samples::Four)] {
            for (pool, cores) in pools.iter().zip(1..) {
                let make: Make<'_> = Box::new(move || Box::new(tiles(scene, pool, planes)));
                makers.push(("tiles", cores, samples, make));
            }
        }
    }
    makers
}

fn at(point: &Point, rounds: usize, pools: &[rayon::ThreadPool]) -> Vec<Row> {
    let makers = makers(point, pools);
    let mut draws: Vec<Draw<'_>> = makers.iter().map(|(.., make)| make()).collect();
    let mut frame = picture(point);
    let mut times = vec![Vec::new(); draws.len()];
    let start = Instant::now();
    for _ in 0..rounds {
        for (draw, times) in draws.iter_mut().zip(&mut times) {
            // What the others left in the caches is not timed, unless that takes too long.
            if times.first().is_none_or(|ms| *ms < 100.0) {
                draw(&mut frame);
            }
            let start = Instant::now();
            draw(&mut frame);
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        if start.elapsed() > PATIENCE {
            break;
        }
    }
    let rows = makers.iter().zip(times);
    rows.map(|((engine, cores, samples, _), times)| Row {
        what: point.what,
        at: point.at,
        engine,
        cores: *cores,
        samples: *samples,
        ms: Spread::of(&times),
        megabytes: 0.0,
    })
    .collect()
}

fn picture(point: &Point) -> Frame<Colour> {
    Frame::new(PixelRect::window(point.side_px, point.side_px), [0; 4])
}

/// The memory of one engine at one point, by a process of its own, in which nothing was freed before.
fn megabytes_apart(quick: bool, point: usize, engine: usize) -> Option<f64> {
    let mut command = Command::new(std::env::current_exe().ok()?);
    command.args(["--memory", &point.to_string(), &engine.to_string()]);
    command.args(quick.then_some("--quick"));
    // Large blocks that are freed go back to the system.
    let done = command.env("MALLOC_MMAP_THRESHOLD_", "65536").output().ok()?;
    String::from_utf8_lossy(&done.stdout).trim().parse().ok()
}

/// What that process prints: the peak while it draws, less what it had when the scene was there.
pub fn megabytes(
    quick: bool,
    point: usize,
    engine: usize,
    pools: &[rayon::ThreadPool],
) -> Option<f64> {
    let point = points(quick).get(point)?()?;
    let before = memory("VmRSS:");
    // What the kernel calls 5 sets the peak to what there is now.
    let _ = fs::write("/proc/self/clear_refs", "5");
    makers(&point, pools).get(engine)?.3()(&mut picture(&point));
    Some((memory("VmHWM:") - before).max(0.0))
}

/// A number of the process's memory, in megabytes; 0 where the system does not say.
fn memory(name: &str) -> f64 {
    let text = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kilobytes =
        text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next());
    kilobytes.and_then(|number| number.parse::<f64>().ok()).unwrap_or(0.0) / 1000.0
}
