//! What all wrong answers have in common, where no mistake explains them.
//!
//! A sentence says what is true of all wrong answers and not of most right ones: that is where a programmer would look first.

use super::AnsweredQuestion;
use super::fills;
use crate::convention::{LineQuestion, Mask, TriangleQuestion};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;

/// What can be said of a question and its answer.
pub(super) struct AnswerTraits {
    /// Whether it is about a line, and not about a triangle.
    is_line: bool,
    /// Pixels that should be drawn and are not.
    missing: u32,
    /// Pixels that are drawn and should not be.
    extra: u32,
    /// Pixels that are drawn more than once.
    twice: u32,
    /// Whether it is of each kind in [`TRIANGLE_KINDS`] or [`LINE_KINDS`].
    kinds: Vec<bool>,
    /// Width or height of the shape in subpixels, whichever is larger.
    extent: i64,
    /// Where wrong pixels lie: each of [`PLACES`], whether all do.
    places: [bool; 6],
}

/// What may be said of triangles, after 'all wrong triangles'.
const TRIANGLE_KINDS: [&str; 7] = [
    "are clockwise",
    "are counterclockwise",
    "have a corner outside the window",
    "lie within the window",
    "have a level or an upright edge",
    "have their middle corner on the right",
    "have their middle corner on the left",
];
/// The same of lines.
const LINE_KINDS: [&str; 8] = [
    "have an end outside the window",
    "lie within the window",
    "are steep",
    "are flat",
    "run to the left",
    "run to the right",
    "run up",
    "run down",
];
/// Where all wrong pixels may lie.
const PLACES: [&str; 6] = [
    "in the first row of the shape",
    "in the last row of the shape",
    "in the first column of the shape",
    "in the last column of the shape",
    "in the last row or column of the window",
    "beside the edges (nothing further in or out is wrong)",
];

impl AnswerTraits {
    /// Looks at the pixels; what kind of question it is, is known.
    fn new<Q>(
        is_line: bool,
        window: PixelRect,
        answered: &AnsweredQuestion<Q>,
        kinds: Vec<bool>,
        extent: i64,
    ) -> Self {
        let AnsweredQuestion { drawn, twice, right, .. } = *answered;
        let mut wrong = drawn.differs(&right);
        wrong.add(&twice);
        // A place stays if every wrong pixel lies there.
        let mut places = [true; 6];
        let shape = fills::drawn_box(&right, window);
        for y in window.y0..window.y1 {
            for x in window.x0..window.x1 {
                if !wrong.has(x, y) {
                    continue;
                }
                let holds = [
                    shape.is_some_and(|shape| y == shape.y0),
                    shape.is_some_and(|shape| y == shape.y1 - 1),
                    shape.is_some_and(|shape| x == shape.x0),
                    shape.is_some_and(|shape| x == shape.x1 - 1),
                    x == window.x1 - 1 || y == window.y1 - 1,
                    is_beside_edge(&right, window, [x, y]),
                ];
                for (place, holds) in places.iter_mut().zip(holds) {
                    *place &= holds;
                }
            }
        }
        Self {
            is_line,
            missing: right.beyond(&drawn),
            extra: drawn.beyond(&right),
            twice: twice.count(),
            kinds,
            extent,
            places,
        }
    }

    /// Of a triangle, by [`TRIANGLE_KINDS`].
    pub(super) fn triangle(answered: &AnsweredQuestion<TriangleQuestion>) -> Self {
        let TriangleQuestion { corners, window } = answered.question;
        let corners = &corners;
        let clockwise = twice_area(corners) > 0;
        let leaves = corners.iter().any(|c| !fills::holds(window, *c));
        let [a, b, c] = corners;
        let straight = fills::flat(corners).is_some() || a.x == b.x || b.x == c.x || c.x == a.x;
        let side = fills::middle_side(corners);
        let kinds = vec![clockwise, !clockwise, leaves, !leaves, straight, side > 0, side < 0];
        let extent = fills::metric(corners, 1).max(fills::metric(corners, 2));
        Self::new(false, window, answered, kinds, extent)
    }

    /// Of a line, by [`LINE_KINDS`].
    pub(super) fn line(answered: &AnsweredQuestion<LineQuestion>) -> Self {
        let LineQuestion { ends: [[x0, y0], [x1, y1]], window } = answered.question;
        let leaves = !window.contains(x0, y0) || !window.contains(x1, y1);
        let (dx, dy) = (i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0));
        let steep = dy.abs() > dx.abs();
        let kinds = vec![leaves, !leaves, steep, !steep, dx < 0, dx > 0, dy < 0, dy > 0];
        Self::new(true, window, answered, kinds, 256 * dx.abs().max(dy.abs()))
    }

    /// Whether any pixel is wrong.
    fn is_wrong(&self) -> bool {
        self.missing + self.extra + self.twice > 0
    }
}

/// Whether a pixel inside has a neighbour outside, or the other way.
fn is_beside_edge(right: &Mask, window: PixelRect, [x, y]: [i32; 2]) -> bool {
    for [dx, dy] in fills::BESIDE {
        let [x1, y1] = [x + dx, y + dy];
        if window.contains(x1, y1) && right.has(x1, y1) != right.has(x, y) {
            return true;
        }
    }
    false
}

/// What the wrong answers have in common and the right ones have not, as sentences.
pub(super) fn sentences(seen: &[AnswerTraits]) -> Vec<String> {
    let (wrong, right): (Vec<_>, Vec<_>) = seen.iter().partition(|s| s.is_wrong());
    let Some(first) = wrong.first() else { return Vec::new() };
    let (shapes, names): (_, &[&str]) =
        if first.is_line { ("lines", &LINE_KINDS) } else { ("triangles", &TRIANGLE_KINDS) };
    let mut said = Vec::new();
    // All wrong pixels, and the sizes of the wrong shapes.
    let (mut missing, mut extra, mut twice) = (0_u64, 0_u64, 0_u64);
    let (mut least, mut most) = (first.extent, first.extent);
    for s in &wrong {
        missing += u64::from(s.missing);
        extra += u64::from(s.extra);
        twice += u64::from(s.twice);
        (least, most) = (least.min(s.extent), most.max(s.extent));
    }
    if twice > 0 {
        said.push(format!("Pixels that are drawn more than once: {twice}."));
    }
    said.push(match (missing, extra) {
        (0, 0) => "None is missing and none is extra.".to_owned(),
        (_, 0) => format!("All {missing} wrong pixels are missing, none is extra."),
        (0, _) => format!("All {extra} wrong pixels are extra, none is missing."),
        _ => format!("{missing} pixels are missing and {extra} are extra."),
    });
    // What all wrong shapes are, and not most of the right ones.
    for (i, name) in names.iter().enumerate() {
        let of_right = right.iter().filter(|s| s.kinds[i]).count();
        // What nearly all have says nothing.
        if wrong.iter().all(|s| s.kinds[i]) && 10 * of_right < 8 * right.len() {
            said.push(format!(
                "All wrong {shapes} {name}; this holds for {of_right} of {} right ones, too.",
                right.len()
            ));
        }
    }
    for (i, place) in PLACES.iter().enumerate() {
        if wrong.iter().all(|s| s.places[i]) {
            said.push(format!("All wrong pixels lie {place}."));
        }
    }
    // A limit is said where a good part of the right shapes lies beyond it.
    let below = right.iter().filter(|s| s.extent < least).count();
    let above = right.iter().filter(|s| s.extent > most).count();
    if 4 * below >= right.len() && below > 20 {
        let px = fills::decimal(least, 256);
        said.push(format!("None of {below} {shapes} of less than {px} px is wrong."));
    }
    if 4 * above >= right.len() && above > 20 {
        let px = fills::decimal(most, 256);
        said.push(format!("None of {above} {shapes} of more than {px} px is wrong."));
    }
    said
}
