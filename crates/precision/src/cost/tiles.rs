//! The tile engine and the planes of frames in tiles, for choices in the best vectors of this machine.

use crate::ladder::interpolation::Valued;
use crate::ladder::{Cover, Snapped, Work, snap};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, FreeCorners, ScreenVertex, Span};
use rasterproof_tiles::coverage::{CoverList, Tiles};
use rasterproof_tiles::frames::planes::{self, ATTRIBUTES};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lists(Tiles);

impl Lists {
    /// What the choice is in a few words.
    pub fn about(self) -> String {
        format!("snaps; the engine tiles, a list at a time, {}", self.0.instructions())
    }
}

impl Cover for Lists {
    fn accepts(&self, free: &FreeCorners, bounds: PixelRect) -> Result<(), String> {
        Snapped(self.0).accepts(free, bounds)
    }

    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        Snapped(self.0).cover(free, bounds, emit)
    }

    /// All at once; what cannot be snapped is not there.
    fn paint(&self, triangles: &[FreeCorners], bounds: PixelRect, target: &mut Frame<u32>) {
        let list: Vec<Corners> = triangles.iter().filter_map(snap).collect();
        self.0.cover_list(&list, bounds, &mut |run| {
            for pieces in run.chunk_by(|a, b| a.triangle() == b.triangle()) {
                self.0.fill(pieces, pieces[0].triangle() + 1, target);
            }
        });
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Planes(Tiles);

impl Planes {
    /// What the choice is in a few words.
    pub fn about(self) -> String {
        format!("set up in f64, as frames in tiles, {}", self.0.instructions())
    }

    /// Values of up to sixteen adjacent pixels with the first one's column, and their row.
    pub fn runs(self, triangle: &Valued, spans: &[Span], take: &mut dyn FnMut(i32, i32, &[f32])) {
        let Some(box_px) = box_of(spans) else { return };
        let (corners, values) = packed(triangle);
        planes::along_spans(self.0, &corners, &values, (box_px, 0), spans, take);
    }
}

/// A triangle as planes want it: its value is the first attribute.
pub(super) fn packed(triangle: &Valued) -> (planes::Corners, [[f64; ATTRIBUTES]; 3]) {
    let vertex = |i: usize| {
        let (position, inv_w) = (triangle.corners[i], triangle.inv_w[i]);
        ScreenVertex { position, depth: 0.0, inv_w, varying: () }
    };
    let values = |i: usize| [triangle.value[i], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    ([0, 1, 2].map_array(vertex), [0, 1, 2].map_array(values))
}

/// The pixels that hold all spans, which come from the top down; nothing where there are none.
pub(super) fn box_of(spans: &[Span]) -> Option<PixelRect> {
    let (first, last) = (spans.first()?, spans.last()?);
    let x0 = spans.iter().map(|span| span.x0_px).min()?;
    let x1 = spans.iter().map(|span| span.x1_px).max()?;
    Some(PixelRect { x0, y0: first.y_px, x1, y1: last.y_px + 1 })
}
