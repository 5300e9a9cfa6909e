//! The group of antialiasing: how far sampled shares are from exact areas, and what they take.
//!
//! The error is the root of the mean square over the pixels that some edge passes through; pixels
//! wholly inside or outside are right with any number of samples.

use std::ops::Range;

use super::entry::{Canvas, Entry, PreparedColumns, classes};
use super::scene::Scene;
use super::{Choice, CostOptions, Run};
use crate::ladder::antialiasing::{Antialias, ExactArea, FOUR, Multisample, ONE, Supersample};
use crate::ladder::{area, snap};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;

/// Triangles that choices are given.
pub struct Input {
    triangles: Vec<Corners>,
    truth: Truth,
    canvas: Canvas<f64>,
}

impl Input {
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let triangles: Vec<Corners> = scene.triangles.iter().filter_map(snap).collect();
        let truth = truth(&triangles, scene.bounds);
        Self { triangles, truth, canvas: Canvas::new(scene.bounds) }
    }
}

/// A choice with so many samples in a pixel.
fn entry<A: Antialias + 'static>(
    name: &'static str,
    about: &'static str,
    samples: usize,
    make: impl Fn() -> A + Copy + 'static,
) -> Entry<Input> {
    // Exact areas have none. A sample is a byte beside the share of each pixel.
    let promises: &[usize] = if samples == 0 { &[0] } else { &[] };
    Entry::new(
        Choice::new(name, about, promises).holding(size_of::<f64>() + samples, 0),
        move |Input { triangles, truth, .. }| {
            let mut target = Frame::new(truth.shares.bounds(), 0.0);
            make().draw(triangles, &mut target);
            Ok(Run::of(vec![Some(root_mean_square(&target, truth))]))
        },
        move |Input { triangles, canvas, .. }| {
            let mut choice = make();
            Ok(canvas.pass(move |target| choice.draw(std::hint::black_box(triangles), target)))
        },
    )
}

#[must_use]
pub fn choices() -> Vec<Entry<Input>> {
    let multiple = |side: i32| move || Supersample::new(Scanline, side);
    vec![
        entry("1x", "the centre", 1, || Multisample::new(Scanline, ONE)),
        entry("4x multisample", FOUR_SAMPLES, 4, || Multisample::new(Scanline, FOUR)),
        entry("2x2 supersample", "a window twice as large", 4, multiple(2)),
        entry("4x4 supersample", "a window four times as large", 16, multiple(4)),
        entry("8x8 supersample", "a window eight times as large", 64, multiple(8)),
        entry("exact area", "whole numbers, rounded once: the reference", 0, || ExactArea),
    ]
}

const FOUR_SAMPLES: &str = "the standard pattern of four";

/// The exact shares, and the pixels on an edge.
struct Truth {
    shares: Frame<f64>,
    on_edge: Frame<bool>,
    pixels: u64,
}

/// The shares of all triangles added up, as the choices do that draw them one after the other.
fn truth(triangles: &[Corners], bounds: PixelRect) -> Truth {
    let (mut shares, mut on_edge) = (Frame::new(bounds, 0.0), Frame::new(bounds, false));
    let mut sum = 0.0;
    for corners in triangles {
        area::shares(corners, bounds, |Range { start, end }, y_px, share| {
            shares.span_mut(y_px, start, end).iter_mut().for_each(|sum| *sum += share);
            on_edge.span_mut(y_px, start, end).iter_mut().for_each(|on| *on |= share < 1.0);
            sum += share * f64::from(end - start);
        });
    }
    Truth { shares, on_edge, pixels: sum as u64 }
}

/// How far shares are from the exact ones, over the pixels on an edge.
fn root_mean_square(actual: &Frame<f64>, truth: &Truth) -> f64 {
    let (mut sum, mut count) = (0.0, 0u64);
    for (y_px, row) in truth.on_edge.rows() {
        let pairs = actual.row(y_px).iter().zip(truth.shares.row(y_px));
        for ((actual, exact), _) in pairs.zip(row).filter(|(_, on_edge)| **on_edge) {
            sum += (actual - exact) * (actual - exact);
            count += 1;
        }
    }
    (sum / count.max(1) as f64).sqrt()
}

/// The classes of scenes, without those that differ in w alone.
pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    classes(options, (256, [8_000, 30_000]), |scene| {
        scene.is_of_coverage()?;
        let input = Input::new(scene);
        let counts = [input.triangles.len(), input.truth.pixels as usize];
        Ok((input, counts))
    })
}
