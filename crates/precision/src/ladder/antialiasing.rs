//! Choices of antialiasing: samples for each pixel, from one to the exact area.
//!
//! Multisampling rasterizes the triangle shifted by minus the offset of each sample; supersampling
//! rasterizes a larger window. Both are exact on the lattice, as whole numbers of 1/256 px are moved
//! or multiplied, and both resolve once, after all triangles. What differs is where samples lie and
//! how many there are. Nothing is shaded: multisampling would shade once for each pixel and
//! supersampling once for each sample.

use super::area;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

pub trait Antialias {
    /// Sets every pixel of `target` to the sum of the shares that the triangles cover of it.
    fn draw(&mut self, triangles: &[Corners], target: &mut Frame<f64>);
}

/// Offsets of the samples of four, in sixteenths of a pixel from its upper left corner: the pattern
/// that D3D and Vulkan call standard.
pub const FOUR: [[i32; 2]; 4] = [[6, 2], [14, 6], [2, 10], [10, 14]];
pub const ONE: [[i32; 2]; 1] = [[8, 8]];

/// Samples at the given offsets, in sixteenths of a pixel, by an exact rasterizer.
#[derive(Clone, Debug)]
pub struct Multisample<E, const N: usize> {
    engine: E,
    offsets: [[i32; 2]; N],
    samples: Vec<Coverage>,
}

impl<E, const N: usize> Multisample<E, N> {
    pub fn new(engine: E, offsets: [[i32; 2]; N]) -> Self {
        Self { engine, offsets, samples: Vec::new() }
    }
}

impl<E: Rasterize, const N: usize> Antialias for Multisample<E, N> {
    fn draw(&mut self, triangles: &[Corners], target: &mut Frame<f64>) {
        let bounds = target.bounds();
        if self.samples.first().is_none_or(|held| held.bounds() != bounds) {
            self.samples = vec![Coverage::new(bounds, 0); N];
        }
        for (offset, samples) in self.offsets.iter().zip(&mut self.samples) {
            samples.fill(0);
            // The sample comes to lie on the centre.
            let [dx, dy] = offset.map_array(|sixteenths| (8 - sixteenths) * SUBPIXELS / 16);
            for corners in triangles {
                let moved = corners.map_array(|p| SubpixelPoint::new(p.x + dx, p.y + dy));
                self.engine.cover(moved, bounds, |s| samples.hit(s.y_px, s.x0_px, s.x1_px));
            }
        }
        for y_px in bounds.y0..bounds.y1 {
            let row = target.row_mut(y_px);
            row.fill(0.0);
            for samples in &self.samples {
                for (share, &hits) in row.iter_mut().zip(samples.row(y_px)) {
                    *share += f64::from(hits);
                }
            }
            row.iter_mut().for_each(|share| *share /= N as f64);
        }
    }
}

/// A grid of `side` x `side` samples, as a window that many times as large.
#[derive(Clone, Debug)]
pub struct Supersample<E> {
    engine: E,
    side: i32,
    samples: Option<Coverage>,
}

impl<E> Supersample<E> {
    pub fn new(engine: E, side: i32) -> Self {
        Self { engine, side, samples: None }
    }
}

impl<E: Rasterize> Antialias for Supersample<E> {
    fn draw(&mut self, triangles: &[Corners], target: &mut Frame<f64>) {
        let (bounds, side) = (target.bounds(), self.side);
        let PixelRect { x0, y0, x1, y1 } = bounds;
        let large = PixelRect { x0: x0 * side, y0: y0 * side, x1: x1 * side, y1: y1 * side };
        let samples = self.samples.take().filter(|held| held.bounds() == large);
        let mut samples = samples.unwrap_or_else(|| Coverage::new(large, 0));
        samples.fill(0);
        for corners in triangles {
            let scaled = corners.map_array(|p| SubpixelPoint::new(p.x * side, p.y * side));
            self.engine.cover(scaled, large, |s| samples.hit(s.y_px, s.x0_px, s.x1_px));
        }
        for y_px in y0..y1 {
            let row = target.row_mut(y_px);
            row.fill(0.0);
            for sample_row in 0..side {
                let hits = samples.row(y_px * side + sample_row);
                for (share, hits) in row.iter_mut().zip(hits.chunks_exact(side as usize)) {
                    *share += f64::from(hits.iter().map(|&n| u32::from(n)).sum::<u32>());
                }
            }
            row.iter_mut().for_each(|share| *share /= f64::from(side * side));
        }
        self.samples = Some(samples);
    }
}

#[derive(Clone, Copy, Debug, Default)]
pub struct ExactArea;

impl Antialias for ExactArea {
    fn draw(&mut self, triangles: &[Corners], target: &mut Frame<f64>) {
        let bounds = target.bounds();
        target.fill(0.0);
        for corners in triangles {
            area::shares(corners, bounds, |columns, y_px, share| {
                let span = target.span_mut(y_px, columns.start, columns.end);
                span.iter_mut().for_each(|sum| *sum += share);
            });
        }
    }
}
