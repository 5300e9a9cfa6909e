//! The colours and depths of one tile of a frame.

use crate::grid::PixelRect;

/// Columns and rows of a tile of a frame.
pub const SIDE_PX: i32 = 64;
const SIDE: usize = SIDE_PX as usize;

/// Sixteen pixels, a line of the cache.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Run<T>(pub [T; 16]);

/// Colours and depths of one tile, owned by who draws it: nothing is shared, so nothing is locked.
pub(super) struct Buffer {
    /// Its pixels.
    pub rect: PixelRect,
    /// Row by row, four runs each.
    pub colours: Vec<Run<u32>>,
    /// Smaller is nearer; infinite where nothing has been drawn.
    pub depths: Vec<Run<f32>>,
}

impl Buffer {
    pub fn new(rect: PixelRect, background: u32) -> Self {
        let runs = SIDE * SIDE / 16;
        let colours = vec![Run([background; 16]); runs];
        Self { rect, colours, depths: vec![Run([f32::INFINITY; 16]); runs] }
    }

    /// Which run holds sixteen pixels from a column that is a multiple of 16.
    #[inline]
    pub fn at(&self, x_px: i32, y_px: i32) -> usize {
        let (x, y) = ((x_px - self.rect.x0) as usize, (y_px - self.rect.y0) as usize);
        y * (SIDE / 16) + x / 16
    }

    /// The colours of a row, from the left border of the tile on.
    pub fn row(&self, y_px: i32) -> impl Iterator<Item = u32> {
        let from = self.at(self.rect.x0, y_px);
        let runs = &self.colours[from..from + SIDE / 16];
        runs.iter().flat_map(|run| run.0).take(self.rect.width() as usize)
    }
}
