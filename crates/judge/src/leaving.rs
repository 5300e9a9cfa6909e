//! Shapes that leave the window, under a convention that explains those within: many programs cut
//! them at its sides first, on a grid of their own, and draw what is left as another shape.
//!
//! That is counted and said, and nothing is expected of such shapes: what is wrong with them as
//! declared stays in the first score.

use super::adapt_case;
use super::ask::{Answer, Asked, Question};
use super::check::{Check, Truth, picture_of};
use super::declared::Declared;
use super::expected::Expect;
use super::finding::hits;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Corners, PixelPoint, Span};
use rasterproof_verify::convention::{Count, Quantum};

const FAMILIES: [&str; 2] = ["partly-off", "line-clipped"];
const CASES: u64 = 48;

/// Whether a corner lies outside the window, once it is on the grid that was found. One on the right or
/// the lower side does: an outline has a pixel there.
pub fn triangle_leaves(corners: &Corners, quantum: Quantum, window: PixelRect) -> bool {
    let is_in = |v: i64, side_px: i32| (0..i64::from(side_px) * i64::from(SUBPIXELS)).contains(&v);
    let is_out =
        |x: i32, y: i32| !is_in(quantum.apply(x), window.x1) || !is_in(quantum.apply(y), window.y1);
    corners.iter().any(|p| is_out(p.x, p.y))
}

pub fn line_leaves(ends: &[PixelPoint; 2], window: PixelRect) -> bool {
    ends.iter().any(|end| !window.contains(end.x, end.y))
}

/// Of some shapes that leave the window, how many come out otherwise than `expect` says, which knows
/// what leaves it.
pub fn otherwise(
    program: &mut dyn FnMut(&[Question]) -> Vec<Answer>,
    declared: &Declared,
    expect: &dyn Expect,
    lines: bool,
    quantum: Quantum,
) -> Count {
    let truth = Truth::of(declared);
    let family = adapt_case::families(&[FAMILIES[usize::from(lines)].to_owned()])[0];
    let check = if lines { Check::Line } else { Check::Coverage };
    let mut questions = Vec::new();
    for index in 0..CASES {
        check.questions(&adapt_case::put(family.case(1, index), declared), &truth, &mut questions);
    }
    let window = |q: &Question| PixelRect::window(q.width, q.height);
    questions.retain(|q| match &q.of {
        Asked::Coverage(corners) => triangle_leaves(corners, quantum, window(q)),
        Asked::Line { ends, .. } => line_leaves(ends, window(q)),
        _ => false,
    });
    let mut count = Count::default();
    let answers = program(&questions);
    for (question, answer) in questions.iter().zip(&answers) {
        let window = window(question);
        let expected: Option<Vec<Span>> = match &question.of {
            Asked::Coverage(corners) => expect.picture(corners, window).map(|p| p.must),
            Asked::Line { ends, .. } => expect.line(ends, window).map(|pixels| {
                pixels.iter().map(|&(x, y)| Span { y_px: y, x0_px: x, x1_px: x + 1 }).collect()
            }),
            _ => None,
        };
        let (Some(expected), Some(drawn)) = (expected, picture_of(answer, window)) else {
            continue;
        };
        let expected = hits(&expected, window).0;
        let same = expected
            .rows()
            .zip(drawn.rows())
            .all(|((_, a), (_, b))| a.iter().zip(b).all(|(a, b)| (*a > 0) == (*b > 0)));
        count.of += 1;
        count.drawn += u64::from(!same);
    }
    count
}

/// Said of a convention where at least a tenth of what leaves the window comes out otherwise.
pub fn sentence(what: &str, count: Count) -> Option<String> {
    (10 * count.drawn >= count.of && count.drawn > 0).then(|| {
        let Count { drawn, of } = count;
        format!(
            " {what} that leave the window come out otherwise ({drawn} of {of}), as where they are \
             cut first; they are left out."
        )
    })
}
