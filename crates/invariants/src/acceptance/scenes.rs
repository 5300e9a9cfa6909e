//! Scenes: some such as test suites draw, and the hard cases of this project.

use glam::{DVec2, DVec3};

use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};
use rasterproof_render::scene::shapes;
use rasterproof_verify::cases::triangles::FAMILIES;
use rasterproof_verify::cases::{Shape, Triangle};

/// What the fragments of a scene leave in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    White,
    /// 127 is added to each channel of a pixel that is hit.
    Add,
    /// Red and green are the two attributes, from 0 to 1; blue is what they leave of 1.
    Values,
    /// An 8 by 8 board of the two attributes.
    Checker,
}

/// Triangles in a window, and how they become a picture.
#[derive(Clone, Debug)]
pub struct Scene {
    pub name: String,
    /// Whether test suites draw the like, instead of this project alone.
    pub of_suites: bool,
    pub paint: Paint,
    pub window: PixelRect,
    pub triangles: Vec<Triangle>,
    /// Whether the triangles cover the window without a gap.
    pub fills_window: bool,
    /// Whether the nearest fragment of a pixel stays, and not the last.
    pub depth_test: bool,
}

impl Scene {
    /// A hard case of this project, which leaves pixels free and shows the last fragment of the others.
    pub fn new(name: String, paint: Paint, window: PixelRect, triangles: Vec<Triangle>) -> Self {
        let (of_suites, fills_window, depth_test) = (false, false, false);
        Self { name, of_suites, paint, window, triangles, fills_window, depth_test }
    }

    /// Whether its colours depend on interpolated values.
    #[must_use]
    pub fn shows_values(&self) -> bool {
        matches!(self.paint, Paint::Values | Paint::Checker)
    }
}

/// Side of the pictures of the suites, in pixels. A half of dEQP's 256, so that a run takes seconds.
const SIDE: f64 = 128.0;
/// How many random scenes each family of triangles gives.
const CASES: u64 = 2;

/// The scenes of both sets; the random ones depend on the seed.
pub fn scenes(seed: u64) -> Vec<Scene> {
    let mut scenes = of_suites(seed);
    for family in FAMILIES {
        for number in 0..CASES {
            let case = family.case(seed, number);
            let Shape::Triangles { list, disjoint } = case.shape else { continue };
            for paint in [Paint::White, Paint::Add, Paint::Values] {
                // What overlaps by construction has no fill rule to check.
                if paint == Paint::Add && !disjoint {
                    continue;
                }
                let triangles = list.iter().map(|triangle| scaled(triangle, paint)).collect();
                let name = format!("{}#{number}, {}", family.name, word(paint));
                scenes.push(Scene::new(name, paint, case.window, triangles));
            }
        }
    }
    scenes
}

/// The paint in the name of a scene.
fn word(paint: Paint) -> &'static str {
    match paint {
        Paint::White => "white",
        Paint::Add => "added",
        Paint::Values => "values",
        Paint::Checker => "board",
    }
}

/// Hard cases have attributes in [-1, 1] and [-100, 100]; as colours they lie in [0, 1].
fn scaled(triangle: &Triangle, paint: Paint) -> Triangle {
    let mut scaled = *triangle;
    if paint == Paint::Values {
        for vertex in &mut scaled.vertices {
            let DVec2 { x, y } = vertex.varying;
            vertex.varying = DVec2::new((x + 1.0) / 4.0, (y / 100.0 + 1.0) / 4.0);
        }
    }
    scaled
}

/// A corner at a place in pixels, rounded to the grid.
fn corner(px: [f64; 2], depth: f64, w: f64, varying: [f64; 2]) -> ScreenVertex<DVec2> {
    let position = SubpixelPoint::from_px(px[0], px[1]).unwrap_or(SubpixelPoint::new(0, 0));
    ScreenVertex { position, depth, inv_w: 1.0 / w, varying: DVec2::from_array(varying) }
}

/// Both triangles of a quadrilateral, which share a diagonal.
fn quad(corners: [ScreenVertex<DVec2>; 4]) -> [Triangle; 2] {
    let [a, b, c, d] = corners;
    [ScreenTriangle { vertices: [a, b, c] }, ScreenTriangle { vertices: [c, a, d] }]
}

/// A square about a centre, turned by the angle whose half has the tangent `t`.
fn turned(centre: [f64; 2], half: f64, t: f64) -> [Triangle; 2] {
    let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    // The corners go from -1 to 1 in both directions of the square.
    let at = |u: f64, v: f64| {
        let [x, y] =
            [centre[0] + half * (u * cos - v * sin), centre[1] + half * (u * sin + v * cos)];
        corner([x, y], 0.5, 1.0, [(u + 1.0) / 2.0, (v + 1.0) / 4.0])
    };
    quad([at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)])
}

/// Scenes such as test suites draw: few large triangles, meshes, and values over a window.
fn of_suites(seed: u64) -> Vec<Scene> {
    let window = PixelRect::window(SIDE as u32, SIDE as u32);
    let scene = |name: &str, paint: Paint, triangles: Vec<Triangle>| Scene {
        of_suites: true,
        ..Scene::new(name.to_owned(), paint, window, triangles)
    };
    let mut rng = Rng::new("tolerances", seed, 0);
    let mut list = Vec::new();
    // Sixteen squares, each turned a little more, as in dEQP's cases of fill rules.
    let cell = SIDE / 4.0;
    let squares = (0..16).flat_map(|i| {
        let centre = [(f64::from(i % 4) + 0.5) * cell, (f64::from(i / 4) + 0.5) * cell];
        turned(centre, 0.3 * cell, f64::from(i) / 16.0)
    });
    list.push(scene("sixteen squares", Paint::Add, squares.collect()));
    // A square twice as large as the window fills it, however it is turned.
    for (i, t) in [0.0, rng.unit()].into_iter().enumerate() {
        let whole = turned([SIDE / 2.0; 2], SIDE, t).to_vec();
        let name = ["window-filling square", "window-filling square, turned"][i];
        list.push(Scene { fills_window: true, ..scene(name, Paint::Add, whole) });
    }
    // Corners at any place but the border, in perspective, each with a colour of its own.
    let mut anywhere = || {
        let place =
            |rng: &mut Rng| [0.05 + 0.9 * rng.unit(), 0.05 + 0.9 * rng.unit()].map(|v| v * SIDE);
        let mut vertex = |varying| {
            let w = 1.0 + 3.0 * rng.unit();
            corner(place(&mut rng), rng.unit(), w, varying)
        };
        ScreenTriangle { vertices: [vertex([1.0, 0.0]), vertex([0.0, 1.0]), vertex([0.0, 0.0])] }
    };
    let six: Vec<Triangle> = (0..6).map(|_| anywhere()).collect();
    for (i, pair) in six.chunks(2).enumerate() {
        list.push(scene(&format!("two triangles, {}", i + 1), Paint::White, pair.to_vec()));
        list.push(scene(&format!("three colours, {}", i + 1), Paint::Values, pair.to_vec()));
    }
    // The window of 4 by 4 pixels of the WebGPU suite's culling test, with a triangle of either winding in two corners.
    let flat = |px: [f64; 2]| corner(px, 0.5, 1.0, [0.5, 0.25]);
    let corners = [
        [flat([0.0, 0.0]), flat([0.0, 2.0]), flat([2.0, 0.0])],
        [flat([2.0, 4.0]), flat([4.0, 2.0]), flat([4.0, 4.0])],
    ];
    let corners = corners.map(|vertices| ScreenTriangle { vertices }).to_vec();
    let small = PixelRect::window(4, 4);
    list.push(Scene { window: small, ..scene("two corners", Paint::White, corners) });
    // A level quadrilateral in perspective, wider than the window at its near end.
    let floor = quad([
        corner([20.0, 40.0], 0.9, 8.0, [0.0, 0.0]),
        corner([108.0, 40.0], 0.9, 8.0, [1.0, 0.0]),
        corner([220.0, 128.0], 0.1, 1.0, [1.0, 1.0]),
        corner([-92.0, 128.0], 0.1, 1.0, [0.0, 1.0]),
    ]);
    list.push(scene("checkered floor", Paint::Checker, floor.to_vec()));
    list.push(Scene { depth_test: true, ..scene("sphere", Paint::Values, sphere()) });
    list
}

/// A sphere in perspective, all of whose faces are drawn.
fn sphere() -> Vec<Triangle> {
    let mesh = shapes::sphere(DVec3::ZERO, 1.0, 20, 12);
    let vertex = |corner: rasterproof_render::scene::Corner| {
        let p = mesh.positions[corner.position as usize];
        // The eye is 2.5 in front of the centre.
        let w = p.z + 2.5;
        let px = [SIDE / 2.0 + 120.0 * p.x / w, SIDE / 2.0 - 120.0 * p.y / w];
        let shade = [(p.x + 1.0) / 4.0, (p.y + 1.0) / 4.0];
        self::corner(px, (w - 1.5) / (w * 0.6), w, shade)
    };
    mesh.triangles.iter().map(|t| ScreenTriangle { vertices: t.map(vertex) }).collect()
}
