//! Triangles of a scene with the pixels that they cover, and what passes paint to.

use std::cell::OnceCell;

use super::Places;
use super::scene::Scene;
use crate::ladder::snap;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Span};

pub use crate::ladder::interpolation::CoveredTriangle;

/// Emits the values of a choice on a triangle.
pub(super) type Emit<'a, T> = &'a dyn Fn(&CoveredTriangle<T>, &mut dyn FnMut(i32, i32, f64));

/// Frames to which all passes of a column paint, made when the first pass is.
pub(super) struct Canvas<T> {
    pub bounds: PixelRect,
    frames: OnceCell<Places<Frame<T>>>,
}

impl<T: Copy + Default> Canvas<T> {
    pub fn new(bounds: PixelRect) -> Self {
        Self { bounds, frames: OnceCell::new() }
    }

    pub fn frames(&self) -> &Places<Frame<T>> {
        self.frames.get_or_init(|| Places::new(|| Frame::new(self.bounds, T::default())))
    }
}

/// The triangles of a scene on the lattice; `make` gets the place of each, its corners and 1/w of each corner.
pub(super) fn dress<T>(
    scene: &Scene,
    make: impl Fn(usize, Corners, [f64; 3]) -> T,
) -> Vec<CoveredTriangle<T>> {
    let triangles = scene.triangles.iter().zip(&scene.w).enumerate();
    let dressed = triangles.filter_map(|(number, (corners, w))| {
        let corners = snap(corners)?;
        let mut spans = Vec::new();
        Scanline.cover(corners, scene.bounds, |span| spans.push(span));
        let inv_w = w.map_array(|w| f64::from((1.0 / w) as f32));
        Some(CoveredTriangle { number, triangle: make(number, corners, inv_w), spans })
    });
    dressed.collect()
}

pub(super) fn pixels<T>(drawn: &[CoveredTriangle<T>]) -> usize {
    drawn.iter().flat_map(|of_this| &of_this.spans).map(Span::pixels).sum()
}
