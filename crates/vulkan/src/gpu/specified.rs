//! What is expected of a device: the oracle's picture, and [how far a value may be
//! off](rasterproof_verify::comparison::single_precision).

use crate::device::kind::PAGE_PX;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, PixelPoint};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::expected::Expect;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::single_precision::perspective_bounds;
use rasterproof_verify::comparison::{Convention, Expectation};

/// The oracle's picture, and derived bounds of values.
pub struct Specified {
    declaration: Convention,
}

impl Specified {
    /// Pixels are expected by the convention that the device declares.
    pub fn new(declared: &Declared) -> Self {
        Self { declaration: declared.convention }
    }
}

impl Expect for Specified {
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Expectation> {
        self.declaration.picture(corners, window)
    }

    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>> {
        self.declaration.line(ends, window)
    }

    fn bounds(&self, triangle: &Triangle, pixel: (i32, i32)) -> Option<[f64; 3]> {
        Some(perspective_bounds(triangle, pixel, f64::from(PAGE_PX)))
    }
}
