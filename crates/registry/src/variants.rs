//! Engines of other rules than those of the book, for what the line protocol asks of programs that declare them.

use rasterproof_core::contract::Rasterize;
use rasterproof_core::geometry::{edges, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Span};

/// Draws every pixel that a triangle touches.
#[derive(Clone, Copy, Debug)]
pub struct TouchedPixels {
    /// Whether a pixel that meets the border of the triangle and nothing else is drawn.
    pub is_closed: bool,
}

impl TouchedPixels {
    /// Whether some line separates a pixel from a triangle. Of two convex shapes it runs along a side of one of them.
    fn is_apart(self, corners: &Corners, [x_px, y_px]: [i32; 2]) -> bool {
        let square = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, down]| {
            let [x, y] = [x_px + right, y_px + down].map(|px| i64::from(px) * i64::from(SUBPIXELS));
            [x, y]
        });
        // How far a shape lies beyond a line may be 0 where they touch.
        let least = i128::from(self.is_closed);
        let inside = twice_area(corners).signum();
        let by_edge = edges(corners)
            .iter()
            .any(|&[a, b]| square.iter().all(|p| side([a, b], *p) * inside <= -least));
        // Along the sides of the pixel.
        let by_side = [0, 1].iter().any(|&axis| {
            let of = corners.map(|p| i128::from([p.x, p.y][axis]));
            let [low, high] = [of[0].min(of[1]).min(of[2]), of[0].max(of[1]).max(of[2])];
            i128::from(square[2][axis]) - low <= -least
                || high - i128::from(square[0][axis]) <= -least
        });
        by_edge || by_side
    }
}

/// On which side of an edge a point lies, that may be no point of the lattice.
fn side([a, b]: [SubpixelPoint; 2], [x, y]: [i64; 2]) -> i128 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i128::from);
    (bx - ax) * (i128::from(y) - ay) - (by - ay) * (i128::from(x) - ax)
}

impl Rasterize for TouchedPixels {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        if twice_area(&corners) == 0 {
            return;
        }
        for y_px in bounds.y0..bounds.y1 {
            let is_drawn = |x_px: &i32| !self.is_apart(&corners, [*x_px, y_px]);
            // The pixels of a row that meet a convex shape are one run.
            let Some(x0_px) = (bounds.x0..bounds.x1).find(is_drawn) else { continue };
            let after = (x0_px + 1..bounds.x1).find(|x_px| !is_drawn(x_px));
            emit(Span { y_px, x0_px, x1_px: after.unwrap_or(bounds.x1) });
        }
    }
}
