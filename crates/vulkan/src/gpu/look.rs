//! One case as a device draws it, in a window of any size.

use super::cells::draw_of;
use super::engine::{Gpu, hits_kind};
use crate::device::Error;
use crate::device::draw::{Draw, Vertex};
use crate::device::kind::{CELL_PX, Kind};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
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
    let px = |p: SubpixelPoint| <[f64; 2]>::from(p.to_px());
    let jobs: Vec<_> = jobs
        .iter()
        .map(|(list, window)| (list.iter().map(|c| c.map(px)).collect(), *window))
        .collect();
    coverages_px(gpu, &jobs)
}

/// The same of corners in pixels, wherever they lie.
pub fn coverages_px(
    gpu: &mut Gpu,
    jobs: &[(Vec<[[f64; 2]; 3]>, PixelRect)],
) -> Result<Vec<Coverage>, Error> {
    let half = gpu.viewport_px() / 2.0;
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
    let mut cells = tiles.iter().enumerate();
    let mut whole = |window: PixelRect| {
        let mut hits = Coverage::new(window, 0);
        for (cell, tile) in cells.by_ref().take(cut(window).count()) {
            for y in 0..tile.height() {
                for (run, times) in runs_of(tile.y0 + y as i32, pictures.row(cell, y, tile.width()))
                {
                    let (x0, x1) = (tile.x0 + run.x0_px, tile.x0 + run.x1_px);
                    (0..times).for_each(|_| hits.hit(run.y_px, x0, x1));
                }
            }
        }
        hits
    };
    Ok(jobs.iter().map(|(_, window)| whole(*window)).collect())
}

fn cut(window: PixelRect) -> impl Iterator<Item = PixelRect> {
    let side = CELL_PX as i32;
    (window.y0..window.y1).step_by(CELL_PX as usize).flat_map(move |y0| {
        (window.x0..window.x1).step_by(CELL_PX as usize).map(move |x0| {
            PixelRect { x0, y0, x1: x0.saturating_add(side), y1: y0.saturating_add(side) }
                .intersect(&window)
        })
    })
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
    let [a, b, c] = corners.map(|[x, y]| {
        let [x, y] = [x - f64::from(x_px), y - f64::from(y_px)];
        if x.abs().max(y.abs()) > f64::from(half_px) {
            return Err(Error::Unsupported(format!(
                "a corner lies further than {half_px} px from the window"
            )));
        }
        Ok(Vertex::flat([x, y].map(|v| (v / f64::from(half_px)) as f32)))
    });
    Ok([a?, b?, c?])
}

fn twice_area_px2([a, b, c]: &[[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}
