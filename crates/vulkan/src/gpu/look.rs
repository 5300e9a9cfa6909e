//! One case as a device draws it, in a window of any size.

use super::cells::draw_of;
use super::engine::{Gpu, hits_kind};
use crate::device::Error;
use crate::device::draw::{Draw, Vertex};
use crate::device::kind::{CELL_PX, Kind};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_judge::ask::runs_of;

/// The hits of triangles in a window.
///
/// # Errors
/// What the device says, or a corner lies too far from the window.
pub fn coverage(gpu: &mut Gpu, list: &[Corners], window: PixelRect) -> Result<Coverage, Error> {
    Ok(coverages(gpu, &[(list, window)])?.remove(0))
}

/// The same of many lists, each in a window of its own: one list of draws.
pub fn coverages(gpu: &mut Gpu, jobs: &[(&[Corners], PixelRect)]) -> Result<Vec<Coverage>, Error> {
    let mut jobs_px = Vec::new();
    for (list, window) in jobs {
        let corners = list.iter().map(|corners| corners.map(|p| p.to_px().into())).collect();
        jobs_px.push((corners, *window));
    }
    coverages_px(gpu, &jobs_px)
}

/// The same of corners in pixels, wherever they lie.
pub fn coverages_px(
    gpu: &mut Gpu,
    jobs: &[(Vec<[[f64; 2]; 3]>, PixelRect)],
) -> Result<Vec<Coverage>, Error> {
    let half = gpu.viewport_px() / 2.0;
    // A window larger than a cell is drawn in parts, each of which sees all triangles.
    let (mut draws, mut tiles) = (Vec::new(), Vec::new());
    for (list, window) in jobs {
        for tile in cut(*window) {
            for corners in list {
                let vertices = seen_from(corners, (tile.x0, tile.y0), half)?;
                let window = [tile.width(), tile.height()];
                draws.push(Draw { window, ..draw_of(tiles.len(), vertices, 2.0 * half) });
            }
            tiles.push(tile);
        }
    }
    // As the judge draws them.
    let is_large = |corners: &[[f64; 2]; 3]| hits_kind(twice_area_px2(corners)) == Kind::Alone;
    let kind = match jobs.iter().any(|(list, _)| list.iter().any(is_large)) {
        true => Kind::Alone,
        false => Kind::Hits,
    };
    let pictures = gpu.draw(kind, tiles.len(), draws)?;
    // The parts follow each other in the order of the windows.
    let mut all = Vec::new();
    let mut cell = 0;
    for (_, window) in jobs {
        let mut hits = Coverage::new(*window, 0);
        for tile in cut(*window) {
            for y in 0..tile.height() {
                let row = pictures.row(cell, y, tile.width());
                for (run, times) in runs_of(tile.y0 + y as i32, row) {
                    for _ in 0..times {
                        hits.hit(run.y_px, tile.x0 + run.x0_px, tile.x0 + run.x1_px);
                    }
                }
            }
            cell += 1;
        }
        all.push(hits);
    }
    Ok(all)
}

/// A window in parts of the size of a cell, row by row; those at its right and lower side are smaller.
fn cut(window: PixelRect) -> Vec<PixelRect> {
    let side = CELL_PX as i32;
    let mut parts = Vec::new();
    for y0 in (window.y0..window.y1).step_by(CELL_PX as usize) {
        for x0 in (window.x0..window.x1).step_by(CELL_PX as usize) {
            let (x1, y1) = (x0.saturating_add(side), y0.saturating_add(side));
            parts.push(PixelRect { x0, y0, x1, y1 }.intersect(&window));
        }
    }
    parts
}

/// The corners as seen from a place, where no corner leaves the viewport; exact on the lattice.
///
/// # Errors
/// One does.
pub(super) fn seen_from(
    corners: &[[f64; 2]; 3],
    (x_px, y_px): (i32, i32),
    half_px: f32,
) -> Result<[Vertex; 3], Error> {
    let mut vertices = [Vertex::default(); 3];
    let half = f64::from(half_px);
    for (vertex, [x, y]) in vertices.iter_mut().zip(corners) {
        let (x, y) = (x - f64::from(x_px), y - f64::from(y_px));
        if x.abs().max(y.abs()) > half {
            let why = format!("a corner lies further than {half_px} px from the window");
            return Err(Error::Unsupported(why));
        }
        *vertex = Vertex::flat([(x / half) as f32, (y / half) as f32]);
    }
    Ok(vertices)
}

/// The same as [`super::cells::twice_area_px2`], of corners that need not lie on the lattice.
fn twice_area_px2([a, b, c]: &[[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}
