//! Where pixels lie with respect to a triangle, and the corners it is asked about.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

/// The direction an edge faces: that of its outward normal. On the screen, y down: N is up.
pub const FACINGS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/// Where a pixel lies that is not outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    In,
    /// Exactly on the edge that faces that way: an index into [`FACINGS`].
    Edge(usize),
    /// On several edges: a corner. One bit for each facing.
    Corner(u8),
    /// Exactly as much as is asked for.
    Level,
    /// Several samples of the pixel on different edges: so many of them are needed; of each, one bit
    /// for each facing of its edges, and 0 where there is no further one.
    Several {
        /// 1 to 4.
        needed: u8,
        /// Facings as bits.
        ties: [u8; 4],
    },
}

/// What is called with every pixel that is not outside.
pub(super) type Emit<'a> = &'a mut dyn FnMut(i32, i32, Place);

/// Corners on the grid, in subpixels.
pub(super) type Points = [[i64; 2]; 3];

/// The edges, each from a corner to the next.
pub(super) fn edges(&[a, b, c]: &Points) -> [[[i64; 2]; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Twice the area; positive where the corners turn clockwise on the screen.
pub(super) fn turn([a, b, c]: &Points) -> i128 {
    let wide = i128::from;
    wide(b[0] - a[0]) * wide(c[1] - a[1]) - wide(b[1] - a[1]) * wide(c[0] - a[0])
}

/// Pixels within `margin_px` of the corners, which must leave room for every sample position.
pub(super) fn around(points: &Points, margin_px: i64) -> PixelRect {
    let ends = |axis: usize| {
        let v = points.map_array(|p| p[axis].div_euclid(256));
        let low = v.into_iter().min().unwrap_or(0) - margin_px;
        let high = v.into_iter().max().unwrap_or(0) + margin_px + 1;
        // Corners are i32 subpixels, so pixels fit with room to spare.
        (low as i32, high as i32)
    };
    let ((x0, x1), (y0, y1)) = (ends(0), ends(1));
    PixelRect { x0, y0, x1, y1 }
}
