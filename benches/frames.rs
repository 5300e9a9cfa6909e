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
//! `cargo bench --bench frames` measures the meshes of [`MESHES`]; `-- knot` those whose name contains
//! a word, `-- --quick` with fewer rounds.

use std::time::Instant;

use euc::Pipeline;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingDisabled, Triangles};
use glam::{DMat3, DVec2, Mat4, Vec3, Vec4};
use rasterproof::effects::Effects;
use rasterproof::frame::Frame;
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::target::{Antialias, Colour, Target};
use rasterproof::pipeline::texture::Texture;
use rasterproof::scene::{Scene, meshes};
use rasterproof::tiled::{self, Samples};

/// Side of the square picture.
const SIDE_PX: u32 = 1024;
/// Two of a displaced sphere and a torus with few triangles, two with many.
const MESHES: [&str; 4] = ["torus-2000", "bumps-4000", "knot-50000", "bumps-70000"];

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    if args.iter().any(|arg| arg == "--list") {
        return;
    }
    let rounds = if args.iter().any(|arg| arg == "--quick") { 3 } else { 15 };
    let word = args.iter().find(|arg| !arg.starts_with("--")).map_or("", String::as_str);
    println!("{SIDE_PX} x {SIDE_PX} px, textured and lit; medians of {rounds} interleaved rounds");
    println!(
        "{:<12} {:<16} {:>9} {:>8} {:>10} {:>8}",
        "mesh", "drawn by", "ms", "x euc", "uncovered", "other"
    );
    for name in MESHES.iter().filter(|name| name.contains(word)) {
        report(&meshes::scene(name).expect("a mesh of the catalogue"), rounds);
    }
}

type Draw<'a> = (&'static str, Box<dyn FnMut() -> Frame<Colour> + 'a>);

fn report(scene: &Scene, rounds: usize) {
    let pool = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads")
    };
    let (one, two) = (pool(1), pool(2));
    let tiles = |samples| tiled::render(scene, SIDE_PX, SIDE_PX, samples).expect("it draws");
    let euc = Euc::new(scene);
    let mut draws: [Draw<'_>; 7] = [
        ("euc", Box::new(|| euc.draw())),
        ("scanline", Box::new(engine(scene, Antialias::None))),
        ("tiles", Box::new(|| one.install(|| tiles(Samples::One)))),
        ("tiles, 2 threads", Box::new(|| two.install(|| tiles(Samples::One)))),
        ("scanline msaa4", Box::new(engine(scene, Antialias::Multisample4))),
        ("tiles msaa4", Box::new(|| one.install(|| tiles(Samples::Four)))),
        ("msaa4, 2 threads", Box::new(|| two.install(|| tiles(Samples::Four)))),
    ];
    let pictures: Vec<_> = draws.iter_mut().map(|(_, draw)| draw()).collect();
    let mut times = [const { Vec::new() }; 7];
    for _ in 0..rounds {
        for ((_, draw), times) in draws.iter_mut().zip(&mut times) {
            let start = Instant::now();
            std::hint::black_box(draw());
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    let ms = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    for (i, (name, _)) in draws.iter().enumerate() {
        let truth = &pictures[if i < 4 { 1 } else { 4 }];
        let [uncovered, other] = wrong(&pictures[i], truth, scene.background);
        let mesh = if i == 0 { scene.name.as_str() } else { "" };
        let factor = ms[0] / ms[i];
        println!("{mesh:<12} {name:<16} {:>9.2} {factor:>8.2} {uncovered:>10} {other:>8}", ms[i]);
    }
}

fn engine(scene: &Scene, antialias: Antialias) -> impl FnMut() -> Frame<Colour> {
    let mut target =
        Target::new(SIDE_PX, SIDE_PX, antialias, Default::default()).expect("a usual size");
    move || {
        let frame = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target);
        frame.expect("it draws").picture
    }
}

/// Pixels that are background in one picture alone, and others of another colour.
fn wrong(picture: &Frame<Colour>, truth: &Frame<Colour>, background: Colour) -> [u64; 2] {
    let (mut uncovered, mut other) = (0, 0);
    for ((_, row), (_, truth)) in picture.rows().zip(truth.rows()) {
        for (a, b) in row.iter().zip(truth) {
            let far = (0..3).any(|i| a[i].abs_diff(b[i]) > 2);
            if (*a == background) != (*b == background) {
                uncovered += 1;
            } else if far {
                other += 1;
            }
        }
    }
    [uncovered, other]
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
        let corners = item.mesh.triangles.iter().flatten();
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

    fn draw(&self) -> Frame<Colour> {
        let side = SIDE_PX as usize;
        let mut target = Buffer2d::new([side, side], self.background);
        let mut depth = Buffer2d::new([side, side], f32::INFINITY);
        Pipeline::draw::<Triangles<Buffer2d<f32>, BackfaceCullingDisabled>, _>(
            self,
            &self.vertices,
            &mut target,
            Some(&mut depth),
        );
        let mut picture =
            Frame::new(rasterproof::grid::PixelRect::window(SIDE_PX, SIDE_PX), [0; 4]);
        for (y, row) in target.as_ref().chunks(side).enumerate() {
            for (pixel, colour) in picture.row_mut(y as i32).iter_mut().zip(row) {
                *pixel = colour.to_le_bytes();
            }
        }
        picture
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
