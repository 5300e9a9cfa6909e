//! Where the samples of a pixel lie, and which of them a triangle covers.

use crate::pipeline::multisample::{SAMPLES, moved};
use crate::pipeline::target::Antialias;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{ScreenTriangle, Varying};

/// Where the samples of a pixel lie: on a grid in one larger window, or in planes of one each, for
/// which the piece is moved.
#[derive(Clone, Copy)]
pub struct Pattern {
    /// Samples along a side of the grid.
    pub scale: i32,
    pub planes: usize,
}

impl Pattern {
    pub fn of(antialias: Antialias) -> Self {
        Self { scale: antialias.scale() as i32, planes: antialias.planes() }
    }

    /// The piece as one of the planes sees it.
    #[inline]
    pub fn moved<V: Varying>(
        self,
        piece: &ScreenTriangle<V>,
        plane: usize,
    ) -> Option<ScreenTriangle<V>> {
        if self.planes == 1 { Some(*piece) } else { moved(piece, SAMPLES[plane]) }
    }

    /// Whether a bit for each sample fits a mask.
    pub fn has_masks(self) -> bool {
        self.scale * self.scale * self.planes as i32 <= u64::BITS as i32
    }

    /// The bit of a sample, `x` columns and `y` rows into the pixel, in a plane.
    #[inline]
    pub fn bit(self, x: i32, y: i32, plane: usize) -> u64 {
        1 << ((y * self.planes as i32 + plane as i32) * self.scale + x)
    }

    /// All bits.
    pub fn all(self) -> u64 {
        u64::MAX >> (u64::BITS as i32 - self.scale * self.scale * self.planes as i32)
    }

    /// The bits of the samples of a pixel that are covered; `samples` are those of its row.
    #[inline]
    pub fn mask(self, samples: &[(i32, i32)], x_px: i32) -> u64 {
        let left = x_px * self.scale;
        let mut mask = 0;
        for (j, &(x0, x1)) in samples.iter().enumerate() {
            let (x0, x1) = ((x0 - left).max(0), (x1 - left).min(self.scale));
            if x0 < x1 {
                let bits = (u64::MAX >> (u64::BITS as i32 - (x1 - x0))) << x0;
                mask |= bits << (j as i32 * self.scale);
            }
        }
        mask
    }

    /// The columns that are covered in a row of pixels, for each row of samples in each plane.
    pub fn rows_of(self, rows: &[(i32, i32)], y_px: i32) -> &[(i32, i32)] {
        let per_row = self.scale as usize * self.planes;
        &rows[y_px as usize * per_row..][..per_row]
    }

    /// The columns of one row of pixels. A row of samples is one run, since triangles are convex.
    pub fn pixel_row(self, samples: &[(i32, i32)]) -> Option<PixelRow> {
        let scale = self.scale;
        let mut touched = (i32::MAX, i32::MIN);
        let mut inner = (i32::MIN, i32::MAX);
        for &(x0, x1) in samples {
            if x0 < x1 {
                touched = (touched.0.min(x0), touched.1.max(x1));
            }
            inner = (inner.0.max(x0), inner.1.min(x1));
        }
        if touched.0 >= touched.1 {
            return None;
        }
        let up = |x: i32| (x + scale - 1).div_euclid(scale);
        let touched = (touched.0.div_euclid(scale), up(touched.1));
        let inner = (up(inner.0), inner.1.div_euclid(scale));
        Some(PixelRow { touched, inner })
    }

    /// How far a sample lies from the middle of its pixel along either axis, in pixels.
    pub fn reach_px(self) -> f64 {
        if self.planes == 1 {
            f64::from(self.scale - 1) / f64::from(2 * self.scale)
        } else {
            // 2/16 and 14/16 are the outermost of SAMPLES.
            6.0 / 16.0
        }
    }
}

/// Columns of pixels: some samples covered, and all samples covered.
#[derive(Clone, Copy)]
pub struct PixelRow {
    pub touched: (i32, i32),
    pub inner: (i32, i32),
}

/// The samples of a rectangle of pixels, `scale` along a side of each.
pub fn scaled(rect: PixelRect, scale: i32) -> PixelRect {
    let PixelRect { x0, y0, x1, y1 } = rect;
    PixelRect { x0: x0 * scale, y0: y0 * scale, x1: x1 * scale, y1: y1 * scale }
}
