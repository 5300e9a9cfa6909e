//! The group of antialiasing: how far sampled shares are from exact areas, and what they take.
//!
//! The error is the root of the mean square over the pixels that some edge passes through; pixels
//! wholly inside or outside are right with any number of samples.

use std::ops::Range;

use super::drawn::Canvas;
use super::entry::{Columns, Entry};
use super::scene::{Scene, Size, W_PREFIX, scenes};
use super::{Choice, Column, CostOptions, Pass, Run};
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

fn entry(
    name: &'static str,
    about: &'static str,
    promises: &[usize],
    make: fn() -> Box<dyn Antialias>,
) -> Entry<'static, Input> {
    Entry::new(
        Choice::new(name, about, promises),
        move |Input { triangles, truth, canvas }: &Input| {
            let mut target = Frame::new(canvas.bounds, 0.0);
            make().draw(triangles, &mut target);
            Ok(Run::of(vec![Some(root_mean_square(&target, truth))]))
        },
        move |Input { triangles, canvas, .. }: &Input| {
            let (mut choice, frames) = (make(), canvas.frames());
            Ok(Pass::new(move || {
                choice.draw(std::hint::black_box(triangles), &mut frames.borrow_mut());
            }))
        },
    )
}

#[must_use]
pub fn choices() -> Vec<Entry<'static, Input>> {
    vec![
        entry("1x", "the centre", &[], || Box::new(Multisample::new(Scanline, ONE))),
        entry("4x multisample", "the standard pattern of four", &[], || {
            Box::new(Multisample::new(Scanline, FOUR))
        }),
        entry("2x2 supersample", "a window twice as large", &[], || {
            Box::new(Supersample::new(Scanline, 2))
        }),
        entry("4x4 supersample", "a window four times as large", &[], || {
            Box::new(Supersample::new(Scanline, 4))
        }),
        entry("8x8 supersample", "a window eight times as large", &[], || {
            Box::new(Supersample::new(Scanline, 8))
        }),
        entry("exact area", "whole numbers, rounded once: the reference", &[0], || {
            Box::new(ExactArea)
        }),
    ]
}

/// The exact shares, and the pixels on an edge.
struct Truth {
    shares: Frame<f64>,
    on_edge: Frame<bool>,
    pixels: u64,
}

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

pub(super) fn columns(options: &CostOptions) -> Columns<Input> {
    let pixels = if options.quick { 8_000 } else { 30_000 };
    let column = |scene: Scene| {
        let input = Input::new(&scene);
        let column =
            |pixels| Column::new(scene.name, scene.about, input.triangles.len() as u64, pixels);
        match scene.name.starts_with(W_PREFIX) {
            true => (column(0), Err("coverage does not depend on w".to_owned())),
            false => (column(input.truth.pixels), Ok(input)),
        }
    };
    scenes(options.seed, Size { side_px: 256, pixels }).into_iter().map(column).collect()
}
