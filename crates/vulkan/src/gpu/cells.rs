//! What is drawn in a cell, and what is read from it.

use crate::device::draw::{Draw, Pictures, Vertex};
use crate::device::kind::CELL_PX;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_judge::adapt_case;
use rasterproof_judge::ask::runs_of;
use rasterproof_judge::declared::Declared;
use rasterproof_verify::cases::{Shape, Triangle};

pub const WINDOW: PixelRect = PixelRect::window(CELL_PX, CELL_PX);

/// Corners with w = 1, halfway into the view volume.
pub fn plain(corners: &Corners, half_px: f32) -> [Vertex; 3] {
    corners.map(|p| Vertex::flat([p.x, p.y].map(|sub| sub as f32 / SUBPIXELS as f32 / half_px)))
}

/// Corners with depth, w and attributes, rounded to f32.
pub fn valued(triangle: &Triangle, half_px: f32) -> [Vertex; 3] {
    triangle.vertices.map(|v| {
        let half = f64::from(half_px);
        let w = (1.0 / v.inv_w) as f32;
        let [x, y] = [v.position.x, v.position.y].map(|sub| {
            let ndc = f64::from(sub) / f64::from(SUBPIXELS) / half;
            (ndc * f64::from(w)) as f32
        });
        let z = (v.depth * f64::from(w)) as f32;
        Vertex { clip: [x, y, z, w], attributes: [v.varying.x as f32, v.varying.y as f32] }
    })
}

/// The four floats of a pixel with values; the last is 0 where nothing was drawn.
pub fn floats(pixel: &[u8]) -> [f64; 4] {
    let mut floats = [0.0; 4];
    for (float, bytes) in floats.iter_mut().zip(pixel.as_chunks().0) {
        *float = f64::from(f32::from_ne_bytes(*bytes));
    }
    floats
}

/// A draw whose window's corner is the middle of its viewport.
pub fn draw_of(cell: usize, vertices: [Vertex; 3], side_px: f32) -> Draw {
    let half = side_px / 2.0;
    Draw { cell, vertices, viewport: [-half, -half, side_px, side_px], window: [CELL_PX; 2] }
}

/// The pixels of a cell, row by row.
pub(super) fn pixels() -> impl Iterator<Item = (i32, i32)> {
    let side = CELL_PX as i32;
    (0..side).flat_map(move |y| (0..side).map(move |x| (x, y)))
}

/// How often each pixel of a cell was drawn.
pub fn hits_of(pictures: &Pictures, cell: usize) -> Coverage {
    let mut hits = Coverage::new(WINDOW, 0);
    for y in 0..CELL_PX {
        for (run, times) in runs_of(y as i32, pictures.row(cell, y, CELL_PX)) {
            for _ in 0..times {
                hits.hit(run.y_px, run.x0_px, run.x1_px);
            }
        }
    }
    hits
}

/// Twice the area, which is a whole number of square subpixels.
pub fn twice_area_px2(corners: &Corners) -> f64 {
    let square = f64::from(SUBPIXELS) * f64::from(SUBPIXELS);
    rasterproof_core::geometry::twice_area(corners).unsigned_abs() as f64 / square
}

/// Triangles with equal, moderately and very different w, as many of each.
pub fn in_perspective(declared: &Declared, seed: u64, cases: u64) -> Vec<Triangle> {
    let names = ["w-equal", "w-4", "w-100"].map(str::to_owned);
    let mut triangles = Vec::new();
    for family in adapt_case::families(&names) {
        for index in 0..cases / 3 {
            let case = adapt_case::case(family, seed, index, declared);
            let Shape::Triangles { list, .. } = case.shape else { continue };
            triangles.extend(list.iter().take(1));
        }
    }
    triangles
}
