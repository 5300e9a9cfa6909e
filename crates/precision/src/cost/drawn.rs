//! Triangles of a scene with the pixels that they cover, and what computes a number at each of those.

use super::scene::Scene;
use crate::ladder::interpolation::Values;
use crate::ladder::snap;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Span};

/// A triangle and the rows it covers.
pub(super) struct CoveredTriangle<T> {
    /// Its place in the list of the scene's triangles.
    pub number: usize,
    pub triangle: T,
    pub spans: Vec<Span>,
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

/// What the measurements need of a choice, without its type.
pub(super) trait AnyValues<T> {
    fn each(&self, drawn: &CoveredTriangle<T>, emit: &mut dyn FnMut(i32, i32, f64));
    fn paint(&self, drawn: &[CoveredTriangle<T>], target: &mut Frame<f32>);
}

impl<T, R: Values<T>> AnyValues<T> for R {
    fn each(&self, drawn: &CoveredTriangle<T>, emit: &mut dyn FnMut(i32, i32, f64)) {
        self.values(&drawn.triangle, &drawn.spans, emit);
    }

    fn paint(&self, drawn: &[CoveredTriangle<T>], target: &mut Frame<f32>) {
        let x0 = target.bounds().x0;
        for CoveredTriangle { triangle, spans, .. } in drawn {
            self.values(triangle, spans, |x_px, y_px, value| {
                target.row_mut(y_px)[(x_px - x0) as usize] = value as f32;
            });
        }
    }
}
