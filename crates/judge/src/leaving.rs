//! Shapes that leave the window, under a convention that explains those within: many programs cut
//! them at its sides first, on a grid of their own, and draw what is left as another shape.
//!
//! That is counted and said, and nothing is expected of such shapes: what is wrong with them as
//! declared stays in the first score.

use super::adapt_case;
use super::ask::{Answer, Asked, Question};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::expected::Expect;
use super::pixels::picture_of;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Corners, PixelPoint, Span};
use rasterproof_verify::comparison::pixels::hits;
use rasterproof_verify::convention::{Count, Quantum};

/// The families whose shapes leave the window: of triangles, and of lines.
const FAMILIES: [&str; 2] = ["partly-off", "line-clipped"];
/// Cases of a family that are looked at.
const CASES: u64 = 48;

/// Whether a corner lies outside the window, once it is on the grid that was found. One on the right or
/// the lower side does: an outline has a pixel there.
pub fn triangle_leaves(corners: &Corners, quantum: Quantum, window: PixelRect) -> bool {
    let is_in = |v: i32, side_px: i32| {
        let end = i64::from(side_px) * i64::from(SUBPIXELS);
        (0..end).contains(&quantum.apply(v))
    };
    !corners.iter().all(|corner| is_in(corner.x, window.x1) && is_in(corner.y, window.y1))
}

/// Whether an end of a line lies outside the window.
pub fn line_leaves(ends: &[PixelPoint; 2], window: PixelRect) -> bool {
    ends.iter().any(|end| !window.contains(end.x, end.y))
}

/// How shapes that leave the window come out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leaving {
    /// Those that come out otherwise than is expected.
    pub otherwise: Count,
    /// Of these, those with a pixel that lies further than its neighbours from what is expected.
    pub gross: u64,
}

impl Leaving {
    /// Whether it is a convention: at least a tenth comes out otherwise, and all of these by no more than a pixel, as
    /// where the shape is cut and its new corners are rounded.
    pub fn is_convention(&self) -> bool {
        self.is_usual() && self.gross == 0
    }

    /// Whether at least a tenth comes out otherwise: fewer may be ordinary mistakes.
    fn is_usual(&self) -> bool {
        10 * self.otherwise.drawn >= self.otherwise.of && self.otherwise.drawn > 0
    }

    /// Said of a convention that does not explain what leaves the window.
    pub fn sentence(&self, what: &str) -> Option<String> {
        // By how much they come out otherwise decides whether it is a convention.
        let Count { drawn, of } = self.otherwise;
        let outcome = match self.gross {
            0 => "by at most a pixel, as where they are cut first; they are left out".to_owned(),
            gross => format!("{gross} of these by more than a pixel; they count as wrong"),
        };
        let how = format!(
            " {what} that leave the window come out otherwise ({drawn} of {of}), {outcome}."
        );
        self.is_usual().then_some(how)
    }
}

/// The window of a question.
fn window(q: &Question) -> PixelRect {
    PixelRect::window(q.width, q.height)
}

/// Some shapes that leave the window.
pub fn questions(declared: &Declared, lines: bool, quantum: Quantum) -> Vec<Question> {
    let truth = Truth::of(declared);
    let family = adapt_case::families(&[FAMILIES[usize::from(lines)].to_owned()])[0];
    let check = if lines { Check::Line } else { Check::Coverage };
    let mut questions = Vec::new();
    for index in 0..CASES {
        check.questions(&adapt_case::case(family, 1, index, declared), &truth, &mut questions);
    }
    // A corner may come to lie within the window on the grid that was found.
    questions.retain(|q| match &q.of {
        Asked::Coverage(corners) => triangle_leaves(corners, quantum, window(q)),
        Asked::Line { ends, .. } => line_leaves(ends, window(q)),
        _ => false,
    });
    questions
}

/// Of shapes that leave the window, how many come out otherwise than `expect` says, which knows what leaves it.
pub fn otherwise(questions: &[Question], answers: &[Answer], expect: &dyn Expect) -> Leaving {
    let mut found = Leaving::default();
    for (question, answer) in questions.iter().zip(answers) {
        let window = window(question);
        let expected: Option<Vec<Span>> = match &question.of {
            Asked::Coverage(corners) => expect.picture(corners, window).map(|p| p.must),
            Asked::Line { ends, .. } => expect.line(ends, window).map(|pixels| runs_of(&pixels)),
            _ => None,
        };
        let (Some(expected), Some(drawn)) = (expected, picture_of(answer, window)) else {
            continue;
        };
        let expected = hits(&expected, window).0;
        // Otherwise is what differs in any pixel, and grossly so what lies farther than a pixel from all that is expected.
        found.otherwise.of += 1;
        found.otherwise.drawn += u64::from(!covers_same(&expected, &drawn));
        let is_near = is_beside(&expected, &drawn) && is_beside(&drawn, &expected);
        found.gross += u64::from(!is_near);
    }
    found
}

/// The pixels of a line as runs of one pixel each.
fn runs_of(pixels: &[(i32, i32)]) -> Vec<Span> {
    let mut runs = Vec::new();
    for &(x, y) in pixels {
        runs.push(Span { y_px: y, x0_px: x, x1_px: x + 1 });
    }
    runs
}

/// Whether the same pixels are covered, however often.
fn covers_same(first: &Coverage, second: &Coverage) -> bool {
    for ((_, first), (_, second)) in first.rows().zip(second.rows()) {
        for (first, second) in first.iter().zip(second) {
            if (*first > 0) != (*second > 0) {
                return false;
            }
        }
    }
    true
}

/// Whether every covered pixel of `a` has one of `b` beside it.
fn is_beside(a: &Coverage, b: &Coverage) -> bool {
    a.runs().all(|(y, x0, x1)| (x0..x1).all(|x| has_beside(b, x, y)))
}

/// Whether a pixel or one of its eight neighbours is covered.
fn has_beside(coverage: &Coverage, x: i32, y: i32) -> bool {
    for y in y - 1..=y + 1 {
        for x in x - 1..=x + 1 {
            if coverage.get(x, y).is_some_and(|hits| hits > 0) {
                return true;
            }
        }
    }
    false
}
