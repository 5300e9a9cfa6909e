//! Somebody from outside the house on a ladder of coverage, who draws lists: a graphics card.

use super::coverage::{Truth, score};
use super::scene::Scene;
use super::{Prepared, Rung};
use crate::grid::PixelRect;
use crate::triangle::{FreeCorners, Span};

/// Somebody who fills triangles, and is judged and timed as the rungs are.
pub trait Guest {
    /// What it is.
    fn rung(&self) -> Rung;

    /// The pixels of each triangle.
    ///
    /// # Errors
    /// The reason why it draws no such list.
    fn spans(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Vec<Vec<Span>>, String>;

    /// Gets ready to fill all of them; what is returned does so, and is timed.
    ///
    /// # Errors
    /// The reason why it draws no such list.
    fn pass(
        &mut self,
        triangles: &[FreeCorners],
        bounds: PixelRect,
    ) -> Result<Box<dyn FnMut()>, String>;
}

/// Its errors on a scene, and what is to be timed.
pub(super) fn prepare<'a>(guest: &mut dyn Guest, scene: &Scene, truth: &Truth) -> Prepared<'a> {
    let mut ready = || {
        let spans = guest.spans(&scene.triangles, scene.bounds)?;
        let pass = guest.pass(&scene.triangles, scene.bounds)?;
        Ok(Prepared::Ready { errors: score(&spans, scene, truth), work: None, pass })
    };
    ready().unwrap_or_else(Prepared::NotRun)
}
