//! Whole frames: the tiles, both engines and euc, of the same meshes, textured, lit and depth-tested,
//! in one run.
//!
//! A frame is everything from the mesh to the picture: transform, assembly, rasterizing, depth test,
//! texture and light, at 1024 x 1024 px. Frames of all alternate, and medians count. euc gets its
//! vertices in the form it wants before, and its picture without samples.
//!
//! Wrong pixels stand beside times: `uncovered`, pixels that are background in one picture and not in
//! the exact engines', and `other`, those whose colour is off by more than two of 255 steps in a
//! channel: another texel or another surface. Then threads: the tiles with one and with two.
//!
//! `cargo bench -p benches --bench frames` measures the meshes of [`MESHES`]; `-- knot` those whose name contains
//! a word, `-- --quick` with fewer rounds. `-- --curves` measures one shape in all its sizes instead,
//! and one mesh in pictures of several sides.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

#[path = "common/mesh.rs"]
mod mesh;

use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use euc::{Pipeline, Target as _};
use glam::{DMat3, DVec2, Mat4, Vec3, Vec4};
use mesh::{Draws, engine, tiles, times, wrong};
use rasterproof_core::frame::Frame;
use rasterproof_render::pipeline::target::{Antialias, Colour};
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::scene::{Scene, meshes};
use rasterproof_tiles::frames::Samples;

const SIDE_PX: u32 = 1024;
/// Two of a displaced sphere and a torus with few triangles, two with many.
const MESHES: [&str; 4] = ["torus-2000", "bumps-4000", "knot-50000", "bumps-70000"];
/// A shape in all its sizes, and the sides of pictures of the first of them.
const CURVE: [&str; 4] = ["torus-2000", "torus-4000", "torus-50000", "torus-70000"];
const SIDES_PX: [u32; 4] = [256, 512, 1024, 2048];

/// On a thread of the pool of two: a frame of three milliseconds that is handed to a pool from outside is
/// often drawn by one of its threads alone, since both wake up on one core.
fn main() {
    let pools = pools();
    pools[1].install(|| measure(&pools));
}

fn measure(pools: &[rayon::ThreadPool; 2]) {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    let has = |word: &str| args.iter().any(|arg| arg == word);
    if has("--list") {
        return;
    }
    let rounds = if has("--quick") { 3 } else { 15 };
    let scene = |name: &str| meshes::scene(name).expect("a mesh of the catalogue");
    if has("--curves") {
        println!("textured and lit; ms, medians of {rounds} interleaved rounds");
        for name in CURVE {
            curve(&scene(name), SIDE_PX, rounds, pools);
        }
        for side_px in SIDES_PX {
            curve(&scene(CURVE[0]), side_px, rounds, pools);
        }
        return;
    }
    let word = args.iter().find(|arg| !arg.starts_with("--")).map_or("", String::as_str);
    println!("{SIDE_PX} x {SIDE_PX} px, textured and lit; medians of {rounds} interleaved rounds");
    println!(
        "{:<12} {:<16} {:>9} {:>8} {:>10} {:>8}",
        "mesh", "drawn by", "ms", "x euc", "uncovered", "other"
    );
    for name in MESHES.iter().filter(|name| name.contains(word)) {
        report(&scene(name), rounds, pools);
    }
}

fn everybody<'a>(
    scene: &'a Scene,
    side_px: u32,
    pools: &'a [rayon::ThreadPool; 2],
) -> Vec<Draws<'a>> {
    let tiles = move |threads: usize, samples| tiles(scene, &pools[threads - 1], samples);
    let (single, four) = (Samples::One, Samples::Four);
    let euc = Euc::new(scene);
    let sides = [side_px as usize; 2];
    let (mut colours, mut depths) = (Buffer2d::new(sides, 0), Buffer2d::new(sides, 0.0));
    vec![
        Draws::new("euc", side_px, move |picture| euc.draw(&mut colours, &mut depths, picture)),
        Draws::new("scanline", side_px, engine(scene, side_px, Antialias::None)),
        Draws::new("tiles", side_px, tiles(1, single)),
        Draws::new("tiles, 2 threads", side_px, tiles(2, single)),
        Draws::new("scanline msaa4", side_px, engine(scene, side_px, Antialias::Multisample4)),
        Draws::new("tiles msaa4", side_px, tiles(1, four)),
        Draws::new("msaa4, 2 threads", side_px, tiles(2, four)),
    ]
}

fn pools() -> [rayon::ThreadPool; 2] {
    [1, 2].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads")
    })
}

fn report(scene: &Scene, rounds: usize, pools: &[rayon::ThreadPool; 2]) {
    let mut all = everybody(scene, SIDE_PX, pools);
    let pictures: Vec<_> = all.iter_mut().map(Draws::picture).collect();
    let ms = times(&mut all, rounds);
    for (i, draws) in all.iter().enumerate() {
        let exact = if draws.name.contains("msaa4") { "scanline msaa4" } else { "scanline" };
        let truth = all.iter().position(|draws| draws.name == exact).expect("it is there");
        let [uncovered, other] = wrong(&pictures[i], &pictures[truth], scene.background);
        let mesh = if i == 0 { scene.name.as_str() } else { "" };
        let (name, factor) = (&draws.name, ms[0] / ms[i]);
        println!("{mesh:<12} {name:<16} {:>9.2} {factor:>8.2} {uncovered:>10} {other:>8}", ms[i]);
    }
}

fn curve(scene: &Scene, side_px: u32, rounds: usize, pools: &[rayon::ThreadPool; 2]) {
    let mut all = everybody(scene, side_px, pools);
    all.iter_mut().for_each(|draws| drop(draws.picture()));
    let row: Vec<String> = all.iter().map(|draws| draws.name.clone()).collect();
    let ms = times(&mut all, rounds);
    let cells = row.iter().zip(ms).map(|(name, ms)| format!("{name} {ms:.2}"));
    println!("{} {side_px} px: {}", scene.name, cells.collect::<Vec<_>>().join(" | "));
}

/// euc's stages for a scene of one mesh, textured and lit.
struct Euc {
    /// Position, normal in the world and texture coordinates of each corner.
    vertices: Vec<(Vec3, Vec3, [f32; 2])>,
    matrix: Mat4,
    towards: Vec3,
    ambient: f32,
    diffuse: f32,
    /// Texels, row by row from the top, as many rows as columns.
    texels: Vec<Vec3>,
    background: u32,
}

impl Euc {
    fn new(scene: &Scene) -> Self {
        let item = &scene.items[0];
        let normals = DMat3::from_mat4(item.model).inverse().transpose();
        let corners = item.mesh.triangles.corners();
        let vertices = corners.map(|corner| {
            let position = item.mesh.positions[corner.position as usize].as_vec3();
            (position, (normals * corner.normal).as_vec3(), corner.uv.as_vec2().to_array())
        });
        Self {
            vertices: vertices.collect(),
            matrix: (scene.projection * scene.view * item.model).as_mat4(),
            towards: scene.light.towards.as_vec3(),
            ambient: scene.light.ambient as f32,
            diffuse: scene.light.diffuse as f32,
            texels: texels(item.material.texture.as_deref().expect("meshes are textured")),
            background: u32::from_le_bytes(scene.background),
        }
    }

    /// Draws with buffers that are kept from frame to frame.
    fn draw(
        &self,
        colours: &mut Buffer2d<u32>,
        depths: &mut Buffer2d<f32>,
        picture: &mut Frame<Colour>,
    ) {
        colours.clear(self.background);
        depths.clear(f32::INFINITY);
        Pipeline::draw::<Triangles<Buffer2d<f32>, BackfaceCullingDisabled>, _>(
            self,
            &self.vertices,
            colours,
            Some(depths),
        );
        let side = picture.bounds().width() as usize;
        for (y, row) in colours.as_ref().chunks(side).enumerate() {
            for (pixel, colour) in picture.row_mut(y as i32).iter_mut().zip(row) {
                *pixel = colour.to_le_bytes();
            }
        }
    }
}

/// Columns and rows of the meshes' texture: a power of two.
const SIDE_TEXELS: i32 = 8;

/// The texels, as f32.
fn texels(texture: &Texture) -> Vec<Vec3> {
    let centre = |texel: i32| f64::from(2 * texel + 1) / f64::from(2 * SIDE_TEXELS);
    let all = (0..SIDE_TEXELS).flat_map(|row| (0..SIDE_TEXELS).map(move |column| (column, row)));
    all.map(|(column, row)| texture.at(DVec2::new(centre(column), 1.0 - centre(row))).as_vec3())
        .collect()
}

impl Pipeline for Euc {
    type Vertex = (Vec3, Vec3, [f32; 2]);
    type VsOut = ((f32, f32, f32), (f32, f32));
    type Pixel = u32;

    #[inline(always)]
    fn vert(&self, (position, normal, [u, v]): &Self::Vertex) -> ([f32; 4], Self::VsOut) {
        let clip: Vec4 = self.matrix * position.extend(1.0);
        (clip.to_array(), ((normal.x, normal.y, normal.z), (*u, *v)))
    }

    #[inline(always)]
    fn frag(&self, ((x, y, z), (u, v)): &Self::VsOut) -> u32 {
        let at =
            |coordinate: f32| (coordinate * SIDE_TEXELS as f32).floor() as i32 & (SIDE_TEXELS - 1);
        let texel = self.texels[(at(1.0 - v) * SIDE_TEXELS + at(*u)) as usize];
        let light = Vec3::new(*x, *y, *z).normalize_or_zero().dot(self.towards).max(0.0);
        let colour = texel * (self.ambient + self.diffuse * light) * 255.0 + 0.5;
        u32::from_le_bytes([colour.x as u8, colour.y as u8, colour.z as u8, 255])
    }
}
