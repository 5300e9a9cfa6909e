//! The bench a program is questioned on: how questions are put, and what is kept of the answers.

use super::mask::{Mask, SIDE_PX};
use super::mirror::Mirror;
use super::rule::TriangleConvention;
use crate::ask::Asker;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Corners;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TriangleQuestion {
    /// Its corners in subpixels (1/256 px), on the grid that is declared.
    pub corners: Corners,
    /// The pixels that are looked at: a window at the origin, at most 32 x 32.
    pub window: PixelRect,
}

/// By which triangles are asked for. An answer has the hits of each pixel of its window; it is None where the program refused or
/// died.
pub type TriangleAsker = Asker<TriangleQuestion, Option<Coverage>>;

/// What is known of a program before it is asked: its declarations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Declarations {
    /// Coordinates are multiples of 1/grid px: 1, 16, 64 or 256.
    pub grid: i32,
    /// Coordinates lie in [-range, range] px.
    pub range_px: i32,
    /// The largest window, width and height.
    pub window_px: (u32, u32),
    /// Whether a pixel drawn twice cannot be seen.
    pub mask: bool,
    pub declared: TriangleConvention,
}

impl Default for Declarations {
    fn default() -> Self {
        Self {
            grid: 256,
            range_px: 1 << 22,
            window_px: (u32::MAX, u32::MAX),
            mask: false,
            declared: TriangleConvention::default(),
        }
    }
}

impl Declarations {
    /// The side of the windows of its questions in pixels: at most 32.
    pub fn side_px(&self) -> i32 {
        let (width, height) = self.window_px;
        let most = width.min(height).min(SIDE_PX as u32) as i32;
        most.min(self.range_px)
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleAnswer {
    pub(super) corners: Corners,
    pub(super) drawn: Mask,
    /// Pixels hit more than once.
    pub(super) twice: Mask,
}

pub(super) struct Bench<'a> {
    asker: &'a TriangleAsker,
    pub(super) known: &'a Declarations,
    pub(super) window: PixelRect,
    /// Subpixels between neighbouring coordinates that may be asked.
    pub(super) grain: i32,
    /// How pictures come out turned over; answers are taken back.
    pub(super) mirror: Mirror,
    pub(super) rng: Rng,
    pub(super) asked: u64,
    pub(super) refused: u64,
}

/// The smallest window, grid and range that can be asked in, in pixels.
pub(super) const LEAST_SIDE_PX: i32 = 16;

impl<'a> Bench<'a> {
    /// None where what is declared leaves no room for questions.
    pub(super) fn new(
        asker: &'a TriangleAsker,
        known: &'a Declarations,
        seed: u64,
    ) -> Option<Self> {
        let side = known.side_px();
        // A grid that does not divide 1/256 px is asked in whole pixels.
        let grid = known.grid.clamp(1, 256);
        let grain = if 256 % grid == 0 { 256 / grid } else { 256 };
        let window = PixelRect::window(side.max(0) as u32, side.max(0) as u32);
        (side >= LEAST_SIDE_PX).then(|| Self {
            asker,
            known,
            window,
            grain,
            mirror: Mirror::None,
            rng: Rng::new("convention", seed, 0),
            asked: 0,
            refused: 0,
        })
    }

    pub(super) fn side(&self) -> i32 {
        self.window.x1
    }

    /// The answers, without those that were refused.
    pub(super) async fn draw(&mut self, questions: &[Corners]) -> Vec<TriangleAnswer> {
        self.draw_all(questions).await.into_iter().flatten().collect()
    }

    pub(super) async fn draw_all(&mut self, questions: &[Corners]) -> Vec<Option<TriangleAnswer>> {
        let window = self.window;
        let list: Vec<_> =
            questions.iter().map(|&corners| TriangleQuestion { corners, window }).collect();
        let mut answers = self.asker.ask(&list).await;
        answers.resize_with(list.len(), || None);
        self.asked += list.len() as u64;
        let answers: Vec<_> = questions
            .iter()
            .zip(answers)
            .map(|(&corners, answer)| {
                answer.filter(|a| a.bounds() == window).map(|coverage| TriangleAnswer {
                    corners,
                    drawn: Mask::of(&coverage, 1).mirrored(self.mirror, window),
                    twice: Mask::of(&coverage, 2).mirrored(self.mirror, window),
                })
            })
            .collect();
        self.refused += answers.iter().filter(|answer| answer.is_none()).count() as u64;
        answers
    }

    /// Seen questions: a random coordinate in `low..=high` px, on the grid.
    pub(super) fn coordinate(&mut self, low_px: i32, high_px: i32) -> i32 {
        let per_px = i64::from(256 / self.grain);
        self.rng.int(i64::from(low_px) * per_px, i64::from(high_px) * per_px) as i32 * self.grain
    }
}
