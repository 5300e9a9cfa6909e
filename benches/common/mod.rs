//! The scenes both benches draw: five classes of triangles, the same on every machine.
//!
//! Each class isolates one cost. Large triangles are bound by memory; medium ones by the rows;
//! small and tiny ones by the setup; slivers by what an engine does about pixels it does not cover.
//! Shapes are made without trigonometry (square roots are exact in IEEE 754, sines are not), so
//! that every machine times the same triangles.

use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Corners;
use rasterproof_tiles::paint::fill_run;
use rasterproof_verify::oracle::Oracle;

/// Side of the square target in pixels.
pub const SIDE_PX: u32 = 1024;
/// The colour that is filled in: opaque, and no two bytes alike.
pub const COLOUR: u32 = 0xff_30_60_90;

/// The triangles of one class.
pub struct Scene {
    pub name: &'static str,
    /// Corners within the target, of either winding, at random phases within the pixel.
    pub triangles: Vec<Corners>,
}

/// All classes, from large to sliver.
pub fn scenes() -> Vec<Scene> {
    let mut random = Rng::of_seed(0x7261_7374_6572);
    let mut compact = |name, count, area_px: f64| {
        let triangles = (0..count).map(|_| place(compact_shape(&mut random, area_px), &mut random));
        Scene { name, triangles: triangles.collect() }
    };
    let mut scenes = vec![
        compact("large", 16, 100_000.0),
        compact("medium", 1_000, 1_000.0),
        compact("small", 8_000, 25.0),
        compact("tiny", 16_000, 3.0),
    ];
    let slivers = (0..200).map(|_| place(sliver_shape(&mut random, 600.0), &mut random));
    scenes.push(Scene { name: "sliver", triangles: slivers.collect() });
    scenes
}

impl Scene {
    /// Pixels they cover, added up triangle by triangle, by the oracle.
    pub fn pixels(&self) -> u64 {
        covered(&Oracle, &self.triangles)
    }
}

pub fn window() -> PixelRect {
    PixelRect::window(SIDE_PX, SIDE_PX)
}

/// Pixels of the target that the triangles cover, added up triangle by triangle.
pub fn covered(engine: &impl Rasterize, triangles: &[Corners]) -> u64 {
    let mut pixels = 0;
    for corners in triangles {
        engine.cover(*corners, window(), |span| pixels += span.x0_px.abs_diff(span.x1_px) as u64);
    }
    pixels
}

/// Fills one triangle: what is timed as coverage only.
#[inline]
pub fn fill(engine: &impl Rasterize, corners: Corners, target: &mut Frame<u32>) {
    engine.cover(corners, target.bounds(), |span| {
        fill_run(target.span_mut(span.y_px, span.x0_px, span.x1_px), COLOUR);
    });
}

type Shape = [(f64, f64); 3];

/// A triangle of the given area that is not thin: three points of a square, scaled.
fn compact_shape(random: &mut Rng, area_px: f64) -> Shape {
    loop {
        let [a, b, c] = [0; 3].map(|_| (random.unit(), random.unit()));
        let area = ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).abs() / 2.0;
        // The largest triangle in the unit square has area 1/2.
        if area > 0.25 {
            let scale = (area_px / area).sqrt();
            return [a, b, c].map(|(x, y)| (x * scale, y * scale));
        }
    }
}

/// A triangle of the given length in a random direction whose short side is 1 to 2 px.
fn sliver_shape(random: &mut Rng, length_px: f64) -> Shape {
    let (x, y, norm) = loop {
        let (x, y) = (2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0);
        let norm = (x * x + y * y).sqrt();
        // Within the unit circle, so that no direction is preferred.
        if norm > 0.1 && norm < 1.0 {
            break (x / norm, y / norm, 1.0 + random.unit());
        }
    };
    let half = norm / 2.0;
    [(x * length_px, y * length_px), (-y * half, x * half), (y * half, -x * half)]
}

/// Puts a shape somewhere in the target, a pixel away from its border at least, and snaps it.
fn place(shape: Shape, random: &mut Rng) -> Corners {
    let mut offset = |coordinates: [f64; 3]| {
        let (min, max) = coordinates
            .iter()
            .fold((f64::MAX, f64::MIN), |(min, max), &c| (c.min(min), c.max(max)));
        let room = f64::from(SIDE_PX) - 2.0 - (max - min);
        assert!(room > 0.0, "a triangle of {} px has no room in the target", max - min);
        1.0 - min + random.unit() * room
    };
    let (dx, dy) = (offset(shape.map(|(x, _)| x)), offset(shape.map(|(_, y)| y)));
    shape.map(|(x, y)| SubpixelPoint::from_px(x + dx, y + dy).expect("within the target"))
}
