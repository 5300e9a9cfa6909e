//! Both engines beside two published software rasterizers, in one run, with each one's errors.
//!
//! A time means little without what it buys, so wrong pixels (missing and extra, against the
//! oracle, triangle by triangle) stand beside it. What is timed: filling every triangle of a class,
//! one by one, with one opaque colour. What is prepared before: each one's natural input.
//! - rasterproof: the corners on the lattice; the rows are written by `common::fill_run`.
//! - tiny-skia: a `Path` for each triangle and one `Paint`, without antialiasing; `fill_path` is
//!   timed. An opaque solid colour takes its fastest road, a plain fill of each row. Its lattice is
//!   1/64 px, so some of its wrong pixels are a choice and not a mistake.
//! - euc: one list of vertices in clip coordinates; one `draw` of all of them is timed, with
//!   culling, depth and varyings off. Edges are inclusive on both sides.
//!
//! All get the same numbers: positions are multiples of 1/256 px, and so exact as `f32`. Everyone
//! fills the same few triangles in turn, then the next few, so that a machine that changes its
//! clock or is shared treats all alike. A turn fills its triangles twice and times the second time,
//! with warm caches; of each turn the median over all rounds counts. Cold, the writes to memory
//! cost everyone alike and the ratios are smaller.
//!
//! Then whole frames of a mesh of 70,000 triangles, textured, lit and depth-tested, with one sample a
//! pixel and with four: see `common/mesh.rs`.
//!
//! `cargo bench -p benches --bench peers` prints the tables; `-- --quick` takes one short round, and
//! `-- tiny small mesh` only what is named.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

mod common;
#[path = "common/mesh.rs"]
mod mesh;

use std::ops::Range;
use std::time::Instant;

use common::{COLOUR, SIDE_PX, Scene};
use euc::Pipeline;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use mesh::Draws;
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::scene::meshes;
use rasterproof_tiles::frames::Samples;
use rasterproof_verify::oracle::Oracle;
use tiny_skia::{FillRule, Paint, Path, PathBuilder, Pixmap, Transform};

/// Odd, so that the median is a round that happened.
const ROUNDS: usize = 31;
const MESH: &str = "bumps-70000";
/// Its rounds, for frames take long.
const MESH_ROUNDS: usize = 15;
/// Turns of everyone in a round, each with a part of the triangles. Turns of about a millisecond
/// and less mostly run undisturbed on a busy machine, whoever's they are.
const TURNS: usize = 8;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let has = |flag: &str| args.iter().any(|arg| arg == flag);
    if has("--list") {
        // A test runner asks for the names of tests: there are none.
        return;
    }
    // `cargo bench` passes --bench; `cargo test` on benches does not, and wants to be done soon.
    let quick = has("--quick") || has("--test") || !has("--bench");
    let rounds = if quick { 1 } else { ROUNDS };
    println!(
        "{SIDE_PX} x {SIDE_PX} px, RGBA8, coverage only; medians of {rounds} interleaved rounds"
    );
    println!();
    println!(
        "{:<8}{:>11}  {:<14}{:>12}{:>9}{:>13}{:>9}{:>8}",
        "class",
        "px/triangle",
        "filled by",
        "ns/triangle",
        "ns/px",
        "x tiny-skia",
        "missing",
        "extra"
    );
    let named: Vec<&String> = args.iter().filter(|arg| !arg.starts_with('-')).collect();
    for scene in common::scenes() {
        if !named.is_empty() && !named.iter().any(|name| scene.name.contains(name.as_str())) {
            continue;
        }
        report(&scene, rounds);
    }
    println!();
    println!("x tiny-skia: how many times as fast as tiny-skia. Pixels: against the exact oracle.");
    if named.is_empty() || named.iter().any(|name| "mesh".contains(name.as_str())) {
        report_mesh(if quick { 3 } else { MESH_ROUNDS });
    }
}

/// Measures frames of a mesh and prints their rows.
fn report_mesh(rounds: usize) {
    let scene = meshes::scene(MESH).expect("a mesh of the catalogue");
    println!();
    println!(
        "{MESH}, {} triangles, textured, lit and depth-tested; medians of {rounds} interleaved rounds",
        scene.triangles()
    );
    println!(
        "{:<9}{:<14}{:>9}{:>13}{:>11}{:>8}",
        "samples", "drawn by", "ms", "x scanline", "uncovered", "other"
    );
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    for (number, samples, antialias) in
        [("1", Samples::One, Antialias::None), ("4", Samples::Four, Antialias::Multisample4)]
    {
        let mut all = [
            Draws::new("scanline", SIDE_PX, mesh::engine(&scene, SIDE_PX, antialias)),
            Draws::new("tiles", SIDE_PX, mesh::tiles(&scene, &one, samples)),
        ];
        let pictures: Vec<_> = all.iter_mut().map(Draws::picture).collect();
        let ms = mesh::times(&mut all, rounds);
        for (i, Draws { name, .. }) in all.iter().enumerate() {
            let number = if i == 0 { number } else { "" };
            let [uncovered, other] = mesh::wrong(&pictures[i], &pictures[0], scene.background);
            let (ms, factor) = (ms[i], ms[0] / ms[i]);
            println!("{number:<9}{name:<14}{ms:>9.2}{factor:>13.2}{uncovered:>11}{other:>8}");
        }
    }
    println!();
    println!(
        "uncovered: background in one picture and not in the scanline's; other: off by more than two"
    );
    println!("of 255 steps in a channel, another texel or another surface");
}

/// Measures one class and prints its rows.
fn report(scene: &Scene, rounds: usize) {
    let mut fillers: Vec<(String, Box<dyn Filler>)> = vec![
        ("scanline".to_owned(), Box::new(Engine::new(Scanline, scene))),
        ("edge-function".to_owned(), Box::new(Engine::new(EdgeFunction, scene))),
        ("tiny-skia".to_owned(), Box::new(TinySkia::new(scene))),
        ("euc".to_owned(), Box::new(Euc::new(scene))),
    ];
    let wrong: Vec<_> = fillers.iter_mut().map(|(_, filler)| filler.wrong(scene)).collect();
    for ((name, _), wrong) in fillers.iter().zip(&wrong).take(2) {
        assert_eq!(*wrong, Wrong::default(), "{name} on {}", scene.name);
    }

    let medians_ns = times_ns(&mut fillers, scene.triangles.len(), rounds);
    let triangles = scene.triangles.len() as f64;
    for (i, (name, _)) in fillers.iter().enumerate() {
        let class = if i == 0 { scene.name } else { "" };
        let size =
            if i == 0 { format!("{:.1}", scene.pixels as f64 / triangles) } else { String::new() };
        println!(
            "{class:<8}{size:>11}  {name:<14}{:>12.1}{:>9.3}{:>13.2}{:>9}{:>8}",
            medians_ns[i] / triangles,
            medians_ns[i] / scene.pixels as f64,
            medians_ns[2] / medians_ns[i],
            wrong[i].missing,
            wrong[i].extra,
        );
    }
}

/// Everyone's time for all triangles: the sum of the medians of their turns.
fn times_ns(
    fillers: &mut [(String, Box<dyn Filler>)],
    triangles: usize,
    rounds: usize,
) -> Vec<f64> {
    let mut turns_ns = vec![vec![Vec::new(); fillers.len()]; TURNS];
    for _ in 0..rounds {
        for (turn, turn_ns) in turns_ns.iter_mut().enumerate() {
            let part = triangles * turn / TURNS..triangles * (turn + 1) / TURNS;
            for ((_, filler), times) in fillers.iter_mut().zip(turn_ns) {
                // What the others left in the caches is not timed.
                filler.fill(part.clone());
                let start = Instant::now();
                filler.fill(part.clone());
                times.push(start.elapsed().as_nanos() as f64);
            }
        }
    }
    let mut sums_ns = vec![0.0; fillers.len()];
    for turn_ns in turns_ns {
        for (sum, mut times) in sums_ns.iter_mut().zip(turn_ns) {
            times.sort_by(f64::total_cmp);
            *sum += times[times.len() / 2];
        }
    }
    sums_ns
}

/// Someone who can fill the triangles of a scene on a target of their own.
trait Filler {
    /// Fills a part of the triangles: this is timed.
    fn fill(&mut self, part: Range<usize>);
    /// Pixels that are wrong, triangle by triangle.
    fn wrong(&mut self, scene: &Scene) -> Wrong;
}

/// A target that can be looked at.
trait Canvas {
    /// Whether pixel (x, y) is drawn.
    fn is_drawn(&self, x: usize, y: usize) -> bool;
    fn erase(&mut self, x: usize, y: usize);
}

#[derive(Debug, Default, PartialEq, Eq)]
struct Wrong {
    missing: u64,
    extra: u64,
}

/// Compares each triangle by itself with the oracle, so that no error hides below another triangle.
fn wrong_pixels(filler: &mut (impl Filler + Canvas), scene: &Scene) -> Wrong {
    let side = SIDE_PX as usize;
    let mut wrong = Wrong::default();
    for (index, corners) in scene.triangles.iter().enumerate() {
        let near = neighbourhood(corners);
        let mut truth = Frame::new(near, false);
        Oracle.cover(*corners, near, |span| {
            truth.span_mut(span.y_px, span.x0_px, span.x1_px).fill(true)
        });
        filler.fill(index..index + 1);
        for (y_px, row) in truth.rows() {
            for (x_px, &covered) in (near.x0..near.x1).zip(row) {
                let (x, y) = (x_px as usize, y_px as usize);
                let drawn = filler.is_drawn(x, y);
                wrong.missing += u64::from(covered && !drawn);
                wrong.extra += u64::from(drawn && !covered);
                if drawn {
                    filler.erase(x, y);
                }
            }
        }
    }
    // What was drawn beyond the neighbourhoods is still there.
    wrong.extra += (0..side * side).filter(|i| filler.is_drawn(i % side, i / side)).count() as u64;
    wrong
}

/// The pixels around a triangle where errors are expected, two pixels beyond its bounding box.
fn neighbourhood(corners: &Corners) -> PixelRect {
    let range = |subs: [i32; 3]| {
        let [low, high] =
            [subs.iter().min(), subs.iter().max()].map(|sub| sub.map_or(0, |sub| sub >> 8));
        (low - 2, high + 3)
    };
    let (x0, x1) = range(corners.map(|corner| corner.x));
    let (y0, y1) = range(corners.map(|corner| corner.y));
    PixelRect { x0, y0, x1, y1 }.intersect(&common::window())
}

struct Engine<E> {
    engine: E,
    triangles: Vec<Corners>,
    target: Frame<u32>,
}

impl<E: Rasterize> Engine<E> {
    fn new(engine: E, scene: &Scene) -> Self {
        Self { engine, triangles: scene.triangles.clone(), target: Frame::new(common::window(), 0) }
    }
}

impl<E: Rasterize> Filler for Engine<E> {
    fn fill(&mut self, part: Range<usize>) {
        for corners in &self.triangles[part] {
            common::fill(&self.engine, *corners, &mut self.target);
        }
    }
    fn wrong(&mut self, scene: &Scene) -> Wrong {
        wrong_pixels(self, scene)
    }
}

impl<E: Rasterize> Canvas for Engine<E> {
    fn is_drawn(&self, x: usize, y: usize) -> bool {
        self.target.row(y as i32)[x] != 0
    }
    fn erase(&mut self, x: usize, y: usize) {
        self.target.row_mut(y as i32)[x] = 0;
    }
}

struct TinySkia {
    paths: Vec<Path>,
    paint: Paint<'static>,
    target: Pixmap,
}

impl TinySkia {
    fn new(scene: &Scene) -> Self {
        let path = |corners: &Corners| {
            let [a, b, c] = corners.map(exact_f32);
            let mut builder = PathBuilder::new();
            builder.move_to(a[0], a[1]);
            builder.line_to(b[0], b[1]);
            builder.line_to(c[0], c[1]);
            builder.close();
            builder.finish().expect("three finite corners make a path")
        };
        let mut paint = Paint { anti_alias: false, ..Paint::default() };
        let [r, g, b, a] = COLOUR.to_le_bytes();
        paint.set_color_rgba8(r, g, b, a);
        let target = Pixmap::new(SIDE_PX, SIDE_PX).expect("a side within tiny-skia's range");
        Self { paths: scene.triangles.iter().map(path).collect(), paint, target }
    }
}

impl Filler for TinySkia {
    fn fill(&mut self, part: Range<usize>) {
        // The view of the target is made once, as a user would who draws many shapes.
        let mut target = self.target.as_mut();
        for path in &self.paths[part] {
            target.fill_path(path, &self.paint, FillRule::Winding, Transform::identity(), None);
        }
    }
    fn wrong(&mut self, scene: &Scene) -> Wrong {
        wrong_pixels(self, scene)
    }
}

impl Canvas for TinySkia {
    fn is_drawn(&self, x: usize, y: usize) -> bool {
        self.target.data()[4 * (y * SIDE_PX as usize + x) + 3] != 0
    }
    fn erase(&mut self, x: usize, y: usize) {
        self.target.data_mut()[4 * (y * SIDE_PX as usize + x)..][..4].fill(0);
    }
}

struct Euc {
    vertices: Vec<[f32; 2]>,
    target: Buffer2d<u32>,
}

/// euc's stages: positions are in clip coordinates already, and every fragment has one colour.
struct Flat;

impl Pipeline for Flat {
    type Vertex = [f32; 2];
    type VsOut = ();
    type Pixel = u32;

    #[inline(always)]
    fn vert(&self, [x, y]: &[f32; 2]) -> ([f32; 4], ()) {
        ([*x, *y, 0.0, 1.0], ())
    }
    #[inline(always)]
    fn frag(&self, (): &()) -> u32 {
        COLOUR
    }
    #[inline(always)]
    fn get_depth_strategy(&self) -> euc::DepthStrategy {
        euc::DepthStrategy::None
    }
}

impl Euc {
    fn new(scene: &Scene) -> Self {
        // The side is a power of two, so this is exact too: euc's errors are its own.
        let half = SIDE_PX as f32 / 2.0;
        let vertex = |corner| {
            let [x, y] = exact_f32(corner);
            [x / half - 1.0, 1.0 - y / half]
        };
        let vertices = scene.triangles.iter().flatten().map(|corner| vertex(*corner)).collect();
        let side = SIDE_PX as usize;
        Self { vertices, target: Buffer2d::new([side, side], 0) }
    }
}

impl Filler for Euc {
    fn fill(&mut self, part: Range<usize>) {
        let vertices = &self.vertices[3 * part.start..3 * part.end];
        Flat.draw::<Triangles<Buffer2d<f32>, BackfaceCullingDisabled>, _>(
            vertices,
            &mut self.target,
            None,
        );
    }
    fn wrong(&mut self, scene: &Scene) -> Wrong {
        wrong_pixels(self, scene)
    }
}

impl Canvas for Euc {
    fn is_drawn(&self, x: usize, y: usize) -> bool {
        self.target.as_ref()[y * SIDE_PX as usize + x] != 0
    }
    fn erase(&mut self, x: usize, y: usize) {
        self.target.as_mut()[y * SIDE_PX as usize + x] = 0;
    }
}

/// A corner in pixels: at most 10 bits before the point and 8 behind it, exact in 24.
fn exact_f32(corner: rasterproof_core::grid::SubpixelPoint) -> [f32; 2] {
    let (x, y) = corner.to_px();
    [x as f32, y as f32]
}
