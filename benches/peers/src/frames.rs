//! Whole frames of the same meshes, textured, lit and depth-tested, with one sample a pixel and with
//! four.
//!
//! A frame is everything from the mesh to the picture: transform, assembly, rasterizing, depth test,
//! texture and light, over pictures and buffers that are kept. Frames of all alternate; everyone draws
//! some before the one that is timed. Peers get their vertices in the form they want before. On one
//! core, programs outside are bound to it, and llvmpipe starts no thread.
//!
//! `uncovered` counts pixels that are background in one picture and not in that of both exact engines,
//! and `other` those whose colour is off by more than two of 255 steps in a channel: another texel or
//! another surface.

use std::process::Command;
use std::time::Instant;

use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use euc::{Pipeline, Target as _};
use glam::{Vec3, Vec4};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::{Scene, meshes};
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::{self, Samples};
use serde::Serialize;

use crate::mesh::{Mesh, Vertex, unpack, wrong};
use crate::outside::{Missing, Process, folder};
use crate::retro::Retrofire;
use crate::spread::Spread;

/// Two of a displaced sphere and a torus with few triangles, two with many.
pub const MESHES: [&str; 4] = ["torus-2000", "bumps-4000", "knot-50000", "bumps-70000"];

/// Frames of a turn that are not timed: after them caches, threads and clocks are as they are in the
/// middle of an animation, for everyone alike.
const WARM: usize = 3;
/// Of whoever takes so long, one frame is enough.
const LONG_MS: f64 = 50.0;

#[derive(Serialize)]
pub struct Row {
    pub mesh: String,
    pub triangles: usize,
    pub side_px: u32,
    pub name: String,
    pub samples: u32,
    pub cores: usize,
    pub ms: Spread,
    pub uncovered: u64,
    pub other: u64,
}

/// Someone who draws frames of one scene.
struct Renderer<'a> {
    name: String,
    samples: u32,
    cores: usize,
    draws: Draws<'a>,
}

pub type Draw<'a> = Box<dyn FnMut(&mut Frame<Colour>) + 'a>;

enum Draws<'a> {
    Local(Draw<'a>, Frame<Colour>),
    Outside(Process, u32),
}

impl Draws<'_> {
    fn time_ms(&mut self, warm: usize) -> f64 {
        match self {
            Draws::Local(draw, picture) => {
                (0..warm).for_each(|_| draw(picture));
                let start = Instant::now();
                draw(std::hint::black_box(picture));
                start.elapsed().as_secs_f64() * 1e3
            }
            Draws::Outside(process, _) => process.frame_ms(warm + 1),
        }
    }

    fn picture(&mut self) -> Frame<Colour> {
        match self {
            Draws::Local(draw, picture) => {
                draw(picture);
                picture.clone()
            }
            Draws::Outside(process, side_px) => {
                process.frame_ms(1);
                let bytes = process.picture(*side_px);
                let mut picture = Frame::new(PixelRect::window(*side_px, *side_px), [0; 4]);
                for (y, row) in (0..).zip(bytes.chunks(4 * *side_px as usize)) {
                    let pixels = picture.row_mut(y).iter_mut().zip(row.chunks(4));
                    pixels.for_each(|(pixel, bytes)| pixel.copy_from_slice(bytes));
                }
                picture
            }
        }
    }
}

/// What draws by OpenGL ES: drivers of Mesa, and SwiftShader's Vulkan below ANGLE, as in Chromium.
const DRIVERS: [&str; 3] = ["llvmpipe", "softpipe", "SwiftShader"];

fn driver(name: &str, cores: usize, arguments: [&str; 3]) -> Command {
    let mut command = Command::new("taskset");
    command.arg("--cpu-list").arg(if cores == 1 { "0" } else { "0,1" }).arg(folder().join("gles"));
    if name == "SwiftShader" {
        let angle = folder().join("swiftshader");
        command.env("VK_ICD_FILENAMES", angle.join("vk_swiftshader_icd.json"));
        command.arg(angle.join("libEGL.so"));
    } else {
        command.env("LIBGL_ALWAYS_SOFTWARE", "1").env("GALLIUM_DRIVER", name).arg("mesa");
        // Without threads the thread that asks draws.
        command.env("LP_NUM_THREADS", if cores == 1 { "0" } else { "2" });
    }
    command.args(arguments);
    command
}

/// What was drawn, with everyone's versions and who is missing.
pub struct FrameResults {
    pub rows: Vec<Row>,
    pub versions: Vec<String>,
    pub missing: Vec<Missing>,
}

/// Measures one mesh. On a thread of the pool of two: a frame of three milliseconds that is handed to a
/// pool from outside is often drawn by one of its threads alone, since both wake up on one core.
pub fn measure(
    scene: &Scene,
    side_px: u32,
    rounds: usize,
    slow: bool,
    pools: &[rayon::ThreadPool],
) -> std::io::Result<FrameResults> {
    let mesh = Mesh::new(scene);
    let file = folder().join("mesh.bin");
    mesh.write(&file)?;
    let mut all = Vec::new();
    let (mut versions, mut missing) = (Vec::new(), Vec::new());
    for (samples, planes, antialias) in
        [(1, Samples::One, Antialias::None), (4, Samples::Four, Antialias::Multisample4)]
    {
        let local = |name: &str, cores, draw| {
            let draws = Draws::Local(draw, Frame::new(PixelRect::window(side_px, side_px), [0; 4]));
            Renderer { name: name.to_owned(), samples, cores, draws }
        };
        all.push(local(
            "scanline",
            1,
            Box::new(engine(Drawer::Scanline, scene, side_px, antialias)),
        ));
        for (pool, cores) in pools.iter().zip(1..) {
            all.push(local("tiles", cores, Box::new(tiles(scene, pool, planes))));
        }
        if samples == 1 {
            let sides = [side_px as usize; 2];
            let (mut colours, mut depths) = (Buffer2d::new(sides, 0), Buffer2d::new(sides, 0.0));
            let euc = Euc { vertices: mesh.corners(), mesh: &mesh };
            let draw = move |picture: &mut _| euc.draw(&mut colours, &mut depths, picture);
            all.push(local("euc", 1, Box::new(draw)));
            let mut retrofire = Retrofire::new(&mesh, side_px);
            all.push(local("retrofire", 1, Box::new(move |picture| retrofire.draw(picture))));
        }
        for name in DRIVERS {
            // It has no threads, and takes ten times as long as the others.
            let most = match name {
                "softpipe" if slow => 1,
                "softpipe" => 0,
                _ => pools.len(),
            };
            for cores in 1..=most {
                let numbers = [samples, side_px].map(|number| number.to_string());
                let arguments = [&file.to_string_lossy(), &*numbers[0], &numbers[1]];
                let mut command = driver(name, cores, arguments);
                let called =
                    if samples == 1 { name.to_owned() } else { format!("{name}, 4 samples") };
                match Process::start(&called, &mut command) {
                    Ok((process, version)) => {
                        versions.push(format!("{name}: {version}"));
                        let draws = Draws::Outside(process, side_px);
                        all.push(Renderer { name: name.to_owned(), samples, cores, draws });
                    }
                    Err(why) => missing.push(why),
                }
            }
        }
    }
    let pictures: Vec<_> = all.iter_mut().map(|renderer| renderer.draws.picture()).collect();
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..rounds {
        for (renderer, times) in all.iter_mut().zip(&mut times) {
            let warm = if times.last().is_some_and(|ms| *ms > LONG_MS) { 1 } else { WARM };
            times.push(renderer.draws.time_ms(warm));
        }
    }
    let mut rows = Vec::new();
    for (i, Renderer { name, samples, cores, .. }) in all.iter().enumerate() {
        let truth =
            all.iter().position(|other| other.name == "scanline" && other.samples == *samples);
        let truth = &pictures[truth.expect("it draws with one sample and with four")];
        let [uncovered, other] = wrong(&pictures[i], truth, scene.background);
        rows.push(Row {
            mesh: scene.name.clone(),
            triangles: scene.triangles(),
            side_px,
            name: name.clone(),
            samples: *samples,
            cores: *cores,
            ms: Spread::of(&times[i]),
            uncovered,
            other,
        });
    }
    Ok(FrameResults { rows, versions, missing })
}

/// Frames of an exact engine, in which effects without influence are left out.
pub fn engine(
    drawer: Drawer,
    scene: &Scene,
    side_px: u32,
    antialias: Antialias,
) -> impl FnMut(&mut Frame<Colour>) {
    let mut target =
        Target::new(side_px, side_px, antialias, Default::default()).expect("a usual size");
    move |picture| {
        let frame = drawer.render(scene, &Effects::PLANNED, &mut target);
        *picture = frame.expect("it draws").picture;
    }
}

pub fn tiles(
    scene: &Scene,
    pool: &rayon::ThreadPool,
    samples: Samples,
) -> impl FnMut(&mut Frame<Colour>) {
    tiles_in(Tiles::default(), scene, pool, samples)
}

fn tiles_in(
    engine: Tiles,
    scene: &Scene,
    pool: &rayon::ThreadPool,
    samples: Samples,
) -> impl FnMut(&mut Frame<Colour>) {
    move |picture| {
        let draw = || frames::render_into(engine, scene, picture, samples);
        pool.install(draw).expect("it draws");
    }
}

/// Draws frames in tiles on one thread, and prints the median of their milliseconds.
pub fn only(name: &str, samples: &str, side_px: u32, count: u32, set: &str) -> Result<(), String> {
    let scene = meshes::scene(name).ok_or_else(|| format!("{name} is no mesh"))?;
    let samples = match samples {
        "1" => Samples::One,
        "4" => Samples::Four,
        _ => return Err(format!("{samples} samples: there are 1 and 4")),
    };
    if !(1..=8192).contains(&side_px) || count == 0 {
        return Err(format!("{count} frames of {side_px} px: there are 1 to 8192 px"));
    }
    let engine = Tiles::levels().into_iter().find(|tiles| tiles.instructions() == set);
    let engine = engine.ok_or_else(|| format!("this machine has no {set}"))?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| error.to_string())?;
    let mut draw = tiles_in(engine, &scene, &pool, samples);
    let mut picture = Frame::new(PixelRect::window(side_px, side_px), [0; 4]);
    let times = (0..count).map(|_| {
        let start = Instant::now();
        draw(std::hint::black_box(&mut picture));
        start.elapsed().as_secs_f64() * 1e3
    });
    println!("{}", Spread::of(&times.collect::<Vec<_>>()).median);
    Ok(())
}

struct Euc<'a> {
    vertices: Vec<Vertex>,
    mesh: &'a Mesh,
}

impl Euc<'_> {
    /// Draws with buffers that are kept from frame to frame.
    fn draw(
        &self,
        colours: &mut Buffer2d<u32>,
        depths: &mut Buffer2d<f32>,
        picture: &mut Frame<Colour>,
    ) {
        colours.clear(u32::from_le_bytes(self.mesh.background));
        depths.clear(f32::INFINITY);
        Pipeline::draw::<Triangles<Buffer2d<f32>, BackfaceCullingDisabled>, _>(
            self,
            &self.vertices,
            colours,
            Some(depths),
        );
        unpack(colours.as_ref(), picture);
    }
}

impl Pipeline for Euc<'_> {
    type Vertex = Vertex;
    type VsOut = ((f32, f32, f32), (f32, f32));
    type Pixel = u32;

    #[inline(always)]
    fn vert(&self, Vertex { position, normal, uv: [u, v] }: &Vertex) -> ([f32; 4], Self::VsOut) {
        let clip: Vec4 = self.mesh.matrix * position.extend(1.0);
        (clip.to_array(), ((normal.x, normal.y, normal.z), (*u, *v)))
    }

    #[inline(always)]
    fn frag(&self, ((x, y, z), (u, v)): &Self::VsOut) -> u32 {
        u32::from_le_bytes(self.mesh.shade(Vec3::new(*x, *y, *z), [*u, *v]))
    }
}
