//! What the exact edge functions say about one pixel: a window on the arithmetic of
//! [`EdgeFunctionExact`](super::EdgeFunctionExact) for those who want to look.

use std::cmp::Ordering;

use super::{Edge, centre, is_deep};
use crate::contract::Decisions;
use crate::triangle::FreeCorners;

/// One edge seen from the centre of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactEdgeAt {
    /// The corners that the edge runs between, as they were given.
    pub ends: [usize; 2],
    /// The edge function in pixels squared, as floats compute it; positive inside.
    pub estimate: f64,
    /// How far that may be off at this sample.
    pub bound: f64,
    /// Where the sample lies: `Greater` is inside, `Equal` on the edge. Exact.
    pub side: Ordering,
    /// Whether the edge is a top or left one, whose samples belong to the triangle.
    pub is_top_left: bool,
}

/// The three edges from the centre of a pixel, each opposite the corner of the same index, turned so
/// that the inside is positive whatever the winding. Nothing for a triangle without area.
#[must_use]
pub fn edges_at(corners: &FreeCorners, x_px: i32, y_px: i32) -> Option<[ExactEdgeAt; 3]> {
    let [a, b, c] = corners.px();
    let is_deep = is_deep(corners);
    let mut decisions = Decisions::default();
    let order = match Edge::new(a, b, [c, c], is_deep).side(c, &mut decisions) {
        Ordering::Greater => [0, 1, 2],
        Ordering::Less => [0, 2, 1],
        Ordering::Equal => return None,
    };
    let sample = centre(x_px, y_px);
    let mut at = |edge: usize| {
        let ends = [order[(edge + 1) % 3], order[(edge + 2) % 3]];
        let [from, to] = ends.map(|corner| corners.px()[corner]);
        let edge = Edge::new(from, to, [sample, sample], is_deep);
        let side = edge.side(sample, &mut decisions);
        let (estimate, bound) = (edge.estimate(sample), edge.bound);
        ExactEdgeAt { ends, estimate, bound, side, is_top_left: edge.is_top_left }
    };
    // By the corner opposite, in the order that was given; `order` is its own inverse.
    Some([at(order[0]), at(order[1]), at(order[2])])
}
