//! The first stages: does it draw at all, and which windings.

use super::adapt_case;
use super::ask::{Answer, Asked, Question, Subject};
use super::declared::Declared;
use super::expected::Expect as _;
use super::pixels::picture_of;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::Shape;
use rasterproof_verify::comparison::Winding;

/// How many plain triangles of each winding were drawn; seen on a screen with y down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Windings {
    /// Clockwise triangles with any pixel, and those that were answered.
    pub clockwise: [u64; 2],
    /// Counter-clockwise triangles with any pixel, and those that were answered.
    pub counter_clockwise: [u64; 2],
}

/// Plain triangles that are asked in both windings.
const PROBES: u64 = 32;
/// A triangle with fewer pixels says nothing about its winding.
const FEW_PIXELS: u64 = 12;

impl Windings {
    fn drawn([drawn, answered]: [u64; 2]) -> bool {
        2 * drawn > answered
    }

    /// Whether most of either are drawn.
    #[must_use]
    pub fn any(&self) -> bool {
        Self::drawn(self.clockwise) || Self::drawn(self.counter_clockwise)
    }

    /// Whether plain triangles of both windings were answered.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.clockwise[1] > 0 && self.counter_clockwise[1] > 0
    }

    /// What is drawn as the protocol's word, as seen; nothing where none is.
    pub fn seen(&self) -> Option<Winding> {
        match (Self::drawn(self.clockwise), Self::drawn(self.counter_clockwise)) {
            (true, true) => Some(Winding::Both),
            (true, false) => Some(Winding::Clockwise),
            (false, true) => Some(Winding::CounterClockwise),
            (false, false) => None,
        }
    }
}

/// Asks for plain triangles of both windings, and counts which of them are drawn.
pub fn windings(program: &mut dyn Subject, seed: u64) -> Windings {
    let declared = program.declared().clone();
    let mut windings = Windings::default();
    if !declared.coverage {
        return windings;
    }
    let family = adapt_case::families(&["uniform".to_owned()])[0];
    let plain = (0..8 * PROBES).filter_map(|index| {
        let case = adapt_case::case(family, seed, index, &declared);
        let Shape::Triangles { list, .. } = &case.shape else { return None };
        let corners = list[0].corners();
        let is_plain =
            !adapt_case::leaves_window(&case) && is_fat(&corners, case.window, &declared);
        is_plain.then_some((case.window, corners))
    });
    let plain: Vec<_> = plain.take(PROBES as usize).collect();
    let mut questions = Vec::with_capacity(2 * plain.len());
    for (window, [a, b, c]) in &plain {
        for corners in [[*a, *b, *c], [*a, *c, *b]] {
            let (width, height) = (window.width(), window.height());
            questions.push(Question { width, height, of: Asked::Coverage(corners) });
        }
    }
    // Each answer counts for the winding of its triangle.
    for (question, answer) in questions.iter().zip(program.ask(&questions, super::run::MOST_DEATHS))
    {
        let Asked::Coverage(corners) = &question.of else { continue };
        let window = PixelRect::window(question.width, question.height);
        count(&mut windings, corners, window, &answer);
    }
    windings
}

/// Whether a triangle has so many pixels, of whichever winding it is, that its winding can be told from them.
fn is_fat(corners: &Corners, window: PixelRect, declared: &Declared) -> bool {
    let any = declared.convention.winding(Winding::Both);
    any.picture(corners, window).is_some_and(|picture| {
        let pixels = picture.must.iter().map(|r| u64::from(r.x0_px.abs_diff(r.x1_px)));
        pixels.sum::<u64>() >= FEW_PIXELS
    })
}

/// Counts an answer for the winding of its triangle.
fn count(windings: &mut Windings, corners: &Corners, window: PixelRect, answer: &Answer) {
    let Some(drawn) = picture_of(answer, window) else { return };
    let of = if twice_area(corners) > 0 {
        &mut windings.clockwise
    } else {
        &mut windings.counter_clockwise
    };
    of[0] += u64::from(drawn.covered() > 0);
    of[1] += 1;
}
