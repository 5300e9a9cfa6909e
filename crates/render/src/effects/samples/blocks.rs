//! Blocks: runs of pixels that are close together, drawn in one go.
//!
//! To draw a piece in a block of pixels costs something before the first sample, about as much as the
//! samples of some pixels. So neighbours are joined, and what lies between them is drawn as well. That
//! changes nothing: samples of a pixel that is not apart are not looked at, and are written before
//! it is told apart; those of one that is, and that the piece does not change, stay as they are.

use super::Run;
use super::pattern::Pattern;
use rasterproof_core::grid::PixelRect;

/// So many samples are drawn in vain rather than a block begun.
const WASTE: i32 = 96;

/// Blocks that a run may still join: the two ends of a row, and what lies between.
const OPEN: usize = 3;

/// Runs of pixels, joined.
pub struct Blocks {
    /// With the number of the piece that their pixels are of.
    list: Vec<(PixelRect, u32)>,
    waste_px: i32,
}

impl Blocks {
    pub fn new(pattern: Pattern) -> Self {
        let samples = pattern.scale * pattern.scale * pattern.planes as i32;
        Self { list: Vec::new(), waste_px: WASTE / samples }
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Adds a run of pixels; later ones lie below or to the right.
    pub fn add(&mut self, run: Run, piece: u32) {
        let rect = run.rect();
        for (block, of) in self.list.iter_mut().rev().take(OPEN) {
            let joined = PixelRect {
                x0: block.x0.min(rect.x0),
                y0: block.y0,
                x1: block.x1.max(rect.x1),
                y1: rect.y1,
            };
            let area = |rect: &PixelRect| (rect.x1 - rect.x0) * (rect.y1 - rect.y0);
            if *of == piece && area(&joined) - area(block) - area(&rect) <= self.waste_px {
                *block = joined;
                return;
            }
        }
        self.list.push((rect, piece));
    }

    pub fn iter(&self) -> impl Iterator<Item = (PixelRect, u32)> {
        self.list.iter().copied()
    }

    pub fn rects(&self) -> impl Iterator<Item = PixelRect> {
        self.list.iter().map(|(rect, _)| *rect)
    }
}
