//! One case as a device draws it, in a window of any size.

use super::engine::{Gpu, plain, runs};
use crate::device::Error;
use crate::device::draw::Draw;
use crate::device::stage::{CELL_PX, Kind};
use crate::frame::Coverage;
use crate::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use crate::triangle::Corners;

/// The hits of triangles in a window.
///
/// # Errors
/// What the device says, or a corner lies too far from the window.
pub fn coverage(gpu: &mut Gpu, list: &[Corners], window: PixelRect) -> Result<Coverage, Error> {
    Ok(coverages(gpu, &[(list, window)])?.remove(0))
}

/// The same of many lists, each in a window of its own: one list of draws.
///
/// # Errors
/// As [`coverage`].
pub fn coverages(gpu: &mut Gpu, jobs: &[(&[Corners], PixelRect)]) -> Result<Vec<Coverage>, Error> {
    let half = gpu.viewport_px() / 2.0;
    let (mut draws, mut tiles) = (Vec::new(), Vec::new());
    for (list, window) in jobs {
        for tile in cut(*window) {
            for corners in *list {
                draws.push(Draw {
                    cell: tiles.len(),
                    vertices: plain(&moved(corners, &tile, half as i32)?, half),
                    viewport: [-half, -half, 2.0 * half, 2.0 * half],
                    window: [tile.width(), tile.height()],
                });
            }
            tiles.push(tile);
        }
    }
    let pictures = gpu.draw(Kind::Hits, tiles.len(), draws)?;
    let mut cells = tiles.iter().enumerate();
    let mut whole = |window: PixelRect| {
        let mut hits = Coverage::new(window, 0);
        for (cell, tile) in cells.by_ref().take(cut(window).count()) {
            for y in 0..tile.height() {
                for (run, times) in runs(tile.y0 + y as i32, pictures.row(cell, y, tile.width())) {
                    let (x0, x1) = (tile.x0 + run.x0_px, tile.x0 + run.x1_px);
                    (0..times).for_each(|_| hits.hit(run.y_px, x0, x1));
                }
            }
        }
        hits
    };
    Ok(jobs.iter().map(|(_, window)| whole(*window)).collect())
}

/// A window in pieces that fit a cell.
fn cut(window: PixelRect) -> impl Iterator<Item = PixelRect> {
    let side = CELL_PX as i32;
    (window.y0..window.y1).step_by(CELL_PX as usize).flat_map(move |y0| {
        (window.x0..window.x1).step_by(CELL_PX as usize).map(move |x0| {
            PixelRect { x0, y0, x1: x0.saturating_add(side), y1: y0.saturating_add(side) }
                .intersect(&window)
        })
    })
}

/// The corners as seen from a tile, where no corner leaves the viewport.
fn moved(corners: &Corners, tile: &PixelRect, most_px: i32) -> Result<Corners, Error> {
    let along = |sub: i32, origin_px: i32| {
        let moved = i64::from(sub) - i64::from(origin_px) * i64::from(SUBPIXELS);
        let fits = moved.abs() <= i64::from(most_px) * i64::from(SUBPIXELS);
        fits.then_some(moved as i32).ok_or_else(|| {
            Error::Unsupported(format!("a corner lies further than {most_px} px from the window"))
        })
    };
    let [a, b, c] = corners.map(|p| Ok((along(p.x, tile.x0)?, along(p.y, tile.y0)?)));
    Ok([a?, b?, c?].map(|(x, y)| SubpixelPoint::new(x, y)))
}
