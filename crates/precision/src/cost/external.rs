//! An external rasterizer on a group of coverage that draws lists of triangles, such as a graphics card.

use super::Choice;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{FreeCorners, Span};

/// Somebody who fills triangles, and is judged and timed as the choices are.
pub trait ExternalVariant {
    fn choice(&self) -> Choice;

    fn spans(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Vec<Vec<Span>>, String>;

    /// Gets ready to fill all of them; what is returned does so, and is timed.
    fn pass(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Box<dyn FnMut()>, String>;
}
