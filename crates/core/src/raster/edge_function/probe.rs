//! What the edge functions say about one pixel: a window on the arithmetic of
//! [`EdgeFunction`](super::EdgeFunction) for those who want to look.

use super::{centre, edges, twice_area};
use crate::grid::SubpixelPoint;
use crate::triangle::Corners;

/// E' of the edge from `from` to `to` at a pixel, and its steps to the right and down, as the engine has them for
/// triangles of [`WordWidth::I32`](super::WordWidth::I32).
#[inline]
#[must_use]
pub fn edge_steps(from: SubpixelPoint, to: SubpixelPoint, x_px: i32, y_px: i32) -> [i32; 3] {
    super::edge_steps(from, to, x_px, y_px)
}

/// One edge seen from the centre of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeAt {
    /// The corners that the edge runs between, as they were given.
    pub ends: [usize; 2],
    /// The edge function in subpixels squared; positive inside, 0 on the edge.
    pub value: i128,
    /// Whether the edge is a top or left one, whose samples belong to the triangle.
    pub is_top_left: bool,
}

/// The three edges from the centre of a pixel, each opposite the corner of the same index, turned so
/// that the inside is positive whatever the winding. Nothing for a triangle without area.
#[must_use]
pub fn edges_at(corners: &Corners, x_px: i32, y_px: i32) -> Option<[EdgeAt; 3]> {
    let area = twice_area::<i128>(corners);
    let order = match area.signum() {
        1 => [0, 1, 2],
        -1 => [0, 2, 1],
        _ => return None,
    };
    let turned = order.map(|corner| corners[corner]);
    let edges = edges(&turned);
    let at = |edge: usize| EdgeAt {
        ends: [order[(edge + 1) % 3], order[(edge + 2) % 3]],
        value: edges[edge].at(centre(x_px), centre(y_px)),
        is_top_left: edges[edge].bias() == 0,
    };
    // By the corner opposite, in the order that was given; `order` is its own inverse.
    Some(order.map(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SubpixelPoint;

    /// The edge opposite a corner runs between the two others, in either winding.
    #[test]
    fn edges_lie_opposite_their_corners() {
        let p = |x, y| SubpixelPoint::new(x * 256, y * 256);
        for corners in [[p(0, 0), p(4, 0), p(0, 4)], [p(0, 0), p(0, 4), p(4, 0)]] {
            let edges = edges_at(&corners, 0, 0).unwrap();
            for (corner, edge) in edges.iter().enumerate() {
                assert!(!edge.ends.contains(&corner), "{edges:?}");
            }
            // The sample (1/2, 1/2): half a pixel from two edges of 4, and the rest from the third.
            let values = edges.map(|edge| edge.value);
            let near = 128 * 4 * 256;
            assert_eq!(values, [16 * 65536 - 2 * near, near, near]);
        }
    }
}
