//! Where the edges of a triangle cross a row of centres: a window on the arithmetic of
//! [`ScanlineExact`](super::ScanlineExact) for those who want to look.

use super::{Edge, first_centre, in_order};
use crate::contract::Decisions;
use crate::triangle::FreeCorners;

/// An edge at the height of a row's centres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Crossing {
    /// Where it crosses, in pixels, as floats compute it.
    pub x: f64,
    /// How far that may be off.
    pub error: f64,
    /// The first column whose centre is not left of the edge. Exact.
    pub column: i32,
    /// Whether floats and their bound were enough to tell.
    pub by_filter: bool,
}

/// The long edge and the short one in row `y_px`; nothing where the triangle has no such row.
#[must_use]
pub fn crossings_at(corners: &FreeCorners, y_px: i32) -> Option<[Crossing; 2]> {
    let [top, middle, bottom] = in_order(corners);
    if !(first_centre(top[1])..first_centre(bottom[1])).contains(&y_px) {
        return None;
    }
    let is_lower = y_px >= first_centre(middle[1]);
    let short = if is_lower { Edge { a: middle, b: bottom } } else { Edge { a: top, b: middle } };
    let crossing = |edge: &Edge| {
        let mut decisions = Decisions::default();
        let column = edge.column(y_px, &mut decisions);
        let (x, error) = edge.crossing(y_px);
        Crossing { x, error, column, by_filter: decisions.by_fallback == 0 }
    };
    Some([crossing(&Edge { a: top, b: bottom }), crossing(&short)])
}
