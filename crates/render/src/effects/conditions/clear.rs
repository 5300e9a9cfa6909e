//! Clear: forgetting last frame's colours.
//!
//! Left out for tiles that the first piece covers, or the second if it shares an edge with it: what
//! a triangle covers is convex, so it covers a tile if it covers the four corner pixels. Here the
//! centres must lie strictly inside, which is what every rasterizer covers. Only opaque pieces count.

use super::account::of_frame;
use super::depth::share_an_edge;
use crate::effects::plan::{Canvas, Clear, Decision, FramePlan, PiecePlan, Samples};
use crate::effects::primitive::{Piece, pixel_box};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::target::Antialias;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{centre_of, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;

/// Side of the tiles whose clearing is decided together.
const TILE_PX: i32 = 32;

/// Pieces with the items they are of, and their plans.
type PlannedPieces<'a> = (&'a [(usize, Piece)], &'a [PiecePlan]);

/// What is cleared; `pieces` are all with their plans, in the order of drawing, where that is known.
pub fn decide(
    effects: &Effects,
    canvas: &Canvas,
    samples: Samples,
    pieces: Option<PlannedPieces<'_>>,
) -> Clear {
    match effects.mode(Effect::Clear) {
        Mode::Always => Clear::Everything,
        Mode::Never => Clear::Nothing,
        _ if matches!(samples, Samples::OnDemand { .. }) => Clear::Nothing,
        _ => {
            pieces.and_then(|pieces| tiles(canvas, pieces)).map_or(Clear::Everything, Clear::Tiles)
        }
    }
}

/// The tiles that the first piece does not cover; nothing where that is not known.
fn tiles(canvas: &Canvas, (pieces, plans): PlannedPieces<'_>) -> Option<Vec<PixelRect>> {
    // Something is seen through what is not opaque.
    let corners = |at: usize| {
        let (_, piece) = pieces.get(at).filter(|_| plans[at].replaces_all())?;
        Some(piece.corners())
    };
    let first = corners(0)?;
    // A small first piece covers no tile; samples off the centre are not asked for.
    let touched = pixel_box(&first, 0);
    let tile_area = i128::from(TILE_PX * SUBPIXELS).pow(2);
    let large = touched.width() as i32 >= TILE_PX
        && touched.height() as i32 >= TILE_PX
        && twice_area(&first).abs() >= 2 * tile_area;
    if !large || canvas.antialias == Antialias::Multisample4 {
        return None;
    }
    // The second piece is drawn over what the first leaves only if it shares an edge with it.
    let second = corners(1).filter(|second| share_an_edge(&first, second));
    let is_covered = |tile: PixelRect| {
        let ends = [(tile.x0, tile.y0), (tile.x1 - 1, tile.y1 - 1)];
        [Some(first), second].into_iter().flatten().any(|corners| holds(corners, ends))
    };
    let bounds = canvas.window();
    let mut tiles: Vec<PixelRect> = Vec::new();
    for y0 in (bounds.y0..bounds.y1).step_by(TILE_PX as usize) {
        for x0 in (bounds.x0..bounds.x1).step_by(TILE_PX as usize) {
            let (x1, y1) = ((x0 + TILE_PX).min(bounds.x1), (y0 + TILE_PX).min(bounds.y1));
            let tile = PixelRect { x0, y0, x1, y1 };
            match tiles.last_mut() {
                _ if is_covered(tile) => {}
                // Neighbours in a row become one.
                Some(last) if (last.y0, last.x1) == (y0, x0) => last.x1 = x1,
                _ => tiles.push(tile),
            }
        }
    }
    Some(tiles)
}

/// Whether the centres of the four corner pixels, between two opposite ones, lie strictly inside.
fn holds(corners: Corners, [(x0, y0), (x1, y1)]: [(i32, i32); 2]) -> bool {
    let [a, b, c] = corners;
    [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].iter().all(|&(x, y)| {
        let p = centre_of(x, y);
        let sides = [[a, b, p], [b, c, p], [c, a, p]].map_array(|side| twice_area(&side).signum());
        sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]
    })
}

pub fn explain(effects: &Effects, canvas: &Canvas, frame: &FramePlan) -> Decision {
    let area = |tile: &PixelRect| u64::from(tile.width()) * u64::from(tile.height());
    let on_demand = matches!(frame.samples, Samples::OnDemand { .. });
    let cleared = match &frame.clear {
        Clear::Nothing => 0,
        Clear::Everything => canvas.samples(),
        Clear::Tiles(tiles) => tiles.iter().map(area).sum(),
    } + if on_demand { canvas.pixels() } else { 0 };
    let reason = match cleared {
        0 => "every tile is covered by what is drawn first",
        _ if on_demand => "pixels are; the samples of one as they are told apart",
        _ if cleared < canvas.samples() => "the rest is covered by what is drawn first",
        _ => "nothing that is drawn first covers a tile",
    };
    let off = canvas.samples().saturating_sub(cleared);
    of_frame(effects, Effect::Clear, [cleared, off, 0], reason.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    /// On a border some rasterizer may not cover the pixel.
    #[test]
    fn centres_on_a_border_are_not_inside() {
        let p = |x_px: i32, y_px: i32| SubpixelPoint::new(x_px * SUBPIXELS, y_px * SUBPIXELS);
        let corners = [p(0, 0), p(64, 0), p(0, 64)];
        assert!(holds(corners, [(0, 0), (31, 31)]), "63 of 64");
        assert!(!holds(corners, [(0, 0), (31, 32)]), "on the hypotenuse");
        assert!(!holds(corners, [(0, 0), (32, 32)]));
        assert!(holds([corners[0], corners[2], corners[1]], [(0, 0), (31, 31)]), "either winding");
    }
}
