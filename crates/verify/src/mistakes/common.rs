//! What all wrong answers have in common, where no mistake explains them.

use super::AnsweredQuestion;
use super::fills;
use crate::convention::{LineQuestion, Mask, TriangleQuestion};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;

/// What can be said of a question and its answer.
pub(super) struct AnswerTraits {
    is_line: bool,
    missing: u32,
    extra: u32,
    twice: u32,
    /// Whether it is of each kind in [`TRIANGLE_KINDS`] or [`LINE_KINDS`].
    kinds: Vec<bool>,
    /// Width or height of the shape in subpixels, whichever is larger.
    extent: i64,
    /// Where wrong pixels lie: each of [`PLACES`], whether all do.
    places: [bool; 6],
}

const TRIANGLE_KINDS: [&str; 7] = [
    "are clockwise",
    "are counterclockwise",
    "have a corner outside the window",
    "lie within the window",
    "have a level or an upright edge",
    "have their middle corner on the right",
    "have their middle corner on the left",
];
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
const PLACES: [&str; 6] = [
    "in the first row of the shape",
    "in the last row of the shape",
    "in the first column of the shape",
    "in the last column of the shape",
    "in the last row or column of the window",
    "beside the edges (nothing further in or out is wrong)",
];

impl AnswerTraits {
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
        let mut places = [true; 6];
        let pixels = |mask: &Mask| -> Vec<(i32, i32)> {
            let all =
                (window.y0..window.y1).flat_map(|y| (window.x0..window.x1).map(move |x| (x, y)));
            all.filter(|&(x, y)| mask.has(x, y)).collect()
        };
        let of = pixels(&right);
        let ends = |v: &mut dyn Iterator<Item = i32>| {
            v.fold((i32::MAX, i32::MIN), |(a, b), v| (a.min(v), b.max(v)))
        };
        let ((x0, x1), (y0, y1)) =
            (ends(&mut of.iter().map(|p| p.0)), ends(&mut of.iter().map(|p| p.1)));
        for (x, y) in pixels(&wrong) {
            let inside = |x: i32, y: i32| window.contains(x, y) && right.has(x, y);
            let here = inside(x, y);
            let is_beside = [(1, 0), (-1, 0), (0, 1), (0, -1)]
                .iter()
                .any(|(dx, dy)| window.contains(x + dx, y + dy) && inside(x + dx, y + dy) != here);
            let holds = [
                y == y0,
                y == y1,
                x == x0,
                x == x1,
                x == window.x1 - 1 || y == window.y1 - 1,
                is_beside,
            ];
            places.iter_mut().zip(holds).for_each(|(place, holds)| *place &= holds);
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

    pub(super) fn line(answered: &AnsweredQuestion<LineQuestion>) -> Self {
        let LineQuestion { ends: [[x0, y0], [x1, y1]], window } = answered.question;
        let leaves = !window.contains(x0, y0) || !window.contains(x1, y1);
        let (dx, dy) = (i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0));
        let steep = dy.abs() > dx.abs();
        let kinds = vec![leaves, !leaves, steep, !steep, dx < 0, dx > 0, dy < 0, dy > 0];
        Self::new(true, window, answered, kinds, 256 * dx.abs().max(dy.abs()))
    }

    fn is_wrong(&self) -> bool {
        self.missing + self.extra + self.twice > 0
    }
}

/// What the wrong answers have in common and the right ones have not, as sentences.
pub(super) fn sentences(seen: &[AnswerTraits]) -> Vec<String> {
    let wrong: Vec<&AnswerTraits> = seen.iter().filter(|s| s.is_wrong()).collect();
    let right: Vec<&AnswerTraits> = seen.iter().filter(|s| !s.is_wrong()).collect();
    let Some(first) = wrong.first() else { return Vec::new() };
    let (shapes, names): (_, &[&str]) =
        if first.is_line { ("lines", &LINE_KINDS) } else { ("triangles", &TRIANGLE_KINDS) };
    let mut said = Vec::new();
    let (missing, extra) = wrong.iter().fold((0_u64, 0_u64), |(missing, extra), s| {
        (missing + u64::from(s.missing), extra + u64::from(s.extra))
    });
    let twice: u64 = wrong.iter().map(|s| u64::from(s.twice)).sum();
    said.extend((twice > 0).then(|| format!("Pixels that are drawn more than once: {twice}.")));
    said.push(match (missing, extra) {
        (0, 0) => "None is missing and none is extra.".to_owned(),
        (_, 0) => format!("All {missing} wrong pixels are missing, none is extra."),
        (0, _) => format!("All {extra} wrong pixels are extra, none is missing."),
        _ => format!("{missing} pixels are missing and {extra} are extra."),
    });
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
    let px = |extent: i64| fills::decimal(extent, 256);
    let ends = |of: &[&AnswerTraits]| {
        (of.iter().map(|s| s.extent).min(), of.iter().map(|s| s.extent).max())
    };
    let (least, most) = ends(&wrong);
    if let (Some(least), Some(most)) = (least, most) {
        let below = right.iter().filter(|s| s.extent < least).count();
        let above = right.iter().filter(|s| s.extent > most).count();
        if 4 * below >= right.len() && below > 20 {
            said.push(format!("None of {below} {shapes} of less than {} px is wrong.", px(least)));
        }
        if 4 * above >= right.len() && above > 20 {
            said.push(format!("None of {above} {shapes} of more than {} px is wrong.", px(most)));
        }
    }
    said
}
