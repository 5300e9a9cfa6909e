//! Pictures that come out turned over: a y axis that points up where rows are stored, x and y
//! exchanged. Found before anything else, and taken back before anything is compared.

use serde::Serialize;

use super::bench::Answer;
use super::mask::Mask;
use super::rule::Convention;
use crate::grid::PixelRect;

/// How the whole picture is turned over, about the middle of its window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Mirror {
    /// Not at all.
    None,
    /// Upside down: row y is row height - 1 - y.
    UpsideDown,
    /// Column x is column width - 1 - x.
    LeftToRight,
    /// Both: turned by half a turn.
    HalfTurn,
    /// x and y exchanged.
    Exchanged,
}

/// A picture may be that of a mirror if it has at most this share of its wrong pixels unmirrored.
const SHARE: u32 = 3;

impl Mirror {
    /// Every way.
    pub const ALL: [Self; 5] =
        [Self::None, Self::UpsideDown, Self::LeftToRight, Self::HalfTurn, Self::Exchanged];

    /// Where the pixel that belongs at (x, y) is drawn. Its own inverse.
    pub(super) fn at(self, x: i32, y: i32, window: PixelRect) -> [i32; 2] {
        let [across, down] = [window.x0 + window.x1 - 1 - x, window.y0 + window.y1 - 1 - y];
        match self {
            Self::None => [x, y],
            Self::UpsideDown => [x, down],
            Self::LeftToRight => [across, y],
            Self::HalfTurn => [across, down],
            Self::Exchanged => [y, x],
        }
    }

    /// The window in which belongs what is drawn in `window`.
    pub(super) fn window(self, window: PixelRect) -> PixelRect {
        match self {
            Self::Exchanged => {
                PixelRect { x0: window.y0, y0: window.x0, x1: window.y1, y1: window.x1 }
            }
            _ => window,
        }
    }

    /// The mirror that explains pictures of large triangles, by the samples at the centres: what a
    /// program does else is small beside a picture that is turned over.
    pub(super) fn of(answers: &[Answer], window: PixelRect) -> Self {
        let own = Convention::default();
        let wrong = |mirror: Self| -> u32 {
            let one = |answer: &Answer| {
                let drawn = answer.drawn.mirrored(mirror, window);
                let expected = own.mask(&answer.corners, window).unwrap_or_default();
                expected.beyond(&drawn) + drawn.beyond(&expected)
            };
            answers.iter().filter(|answer| !answer.drawn.is_empty()).map(one).sum()
        };
        let as_is = wrong(Self::None);
        let best = Self::ALL.into_iter().min_by_key(|mirror| wrong(*mirror));
        best.filter(|mirror| SHARE * wrong(*mirror) < as_is).unwrap_or(Self::None)
    }
}

impl Mask {
    /// The picture taken back from a mirror.
    pub(super) fn mirrored(&self, mirror: Mirror, window: PixelRect) -> Self {
        if mirror == Mirror::None {
            return *self;
        }
        let mut back = Self::default();
        for y in window.y0..window.y1 {
            for x in window.x0..window.x1 {
                let [from_x, from_y] = mirror.at(x, y, window);
                if window.contains(from_x, from_y) && self.has(from_x, from_y) {
                    back.set(x, y);
                }
            }
        }
        back
    }
}
