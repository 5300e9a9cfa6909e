//! The group of antialiasing: how far sampled shares are from exact areas, and what they take.
//!
//! The error is the root of the mean square over the pixels that some edge passes through; pixels
//! wholly inside or outside are right with any number of samples.

use std::ops::Range;

use super::scene::{Scene, Size, W_PREFIX, scenes};
use super::{Board, Choice, Column, CostOptions, Draft, Ladder, Places, PreparedCell, Told};
use crate::ladder::antialiasing::{Antialias, ExactArea, FOUR, Multisample, ONE, Supersample};
use crate::ladder::{area, snap};
use rasterproof_core::frame::Frame;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;

struct Variant {
    choice: Choice,
    make: fn() -> Box<dyn Antialias>,
}

fn variants() -> Vec<Variant> {
    let new = |name, about, exact: bool, make| Variant {
        choice: Choice::new(name, about, if exact { &[0] } else { &[] }),
        make,
    };
    vec![
        new("1x", "the centre", false, || Box::new(Multisample::new(Scanline, ONE))),
        new("4x multisample", "the standard pattern of four", false, || {
            Box::new(Multisample::new(Scanline, FOUR))
        }),
        new("2x2 supersample", "a window twice as large", false, || {
            Box::new(Supersample::new(Scanline, 2))
        }),
        new("4x4 supersample", "a window four times as large", false, || {
            Box::new(Supersample::new(Scanline, 4))
        }),
        new("8x8 supersample", "a window eight times as large", false, || {
            Box::new(Supersample::new(Scanline, 8))
        }),
        new("exact area", "whole numbers, rounded once: the reference", true, || {
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

fn truth(triangles: &[Corners], scene: &Scene) -> Truth {
    let bounds = scene.bounds;
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

pub(super) fn measure(options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
    let pixels = if options.quick { 8_000 } else { 30_000 };
    let scenes = scenes(options.seed, Size { side_px: 256, pixels });
    measure_on(&scenes, options, (progress, &mut |_, _| ()))
}

pub(super) fn measure_on(
    scenes: &[Scene],
    options: &CostOptions,
    (progress, afterwards): Told<'_>,
) -> Board {
    let variants = variants();
    let triangles: Vec<Vec<Corners>> =
        scenes.iter().map(|scene| scene.triangles.iter().filter_map(snap).collect()).collect();
    let targets: Vec<_> =
        scenes.iter().map(|scene| Places::new(|| Frame::new(scene.bounds, 0.0))).collect();
    let choices = variants.iter().map(|variant| variant.choice.clone());
    let mut draft = Draft::new(Ladder::Antialiasing, choices, options);
    for ((scene, triangles), target) in scenes.iter().zip(&triangles).zip(&targets) {
        draft.tell(progress, scenes.len());
        let column = |pixels| Column::new(scene.name, scene.about, triangles.len() as u64, pixels);
        if scene.name.starts_with(W_PREFIX) {
            draft.leave_out(column(0), "coverage does not depend on w");
            continue;
        }
        let truth = truth(triangles, scene);
        let cells = variants.iter().map(|variant| {
            let mut choice = (variant.make)();
            choice.draw(triangles, &mut target.borrow_mut());
            let error = root_mean_square(&target.borrow(), &truth);
            PreparedCell::ready(vec![Some(error)], move || {
                choice.draw(std::hint::black_box(triangles), &mut target.borrow_mut());
            })
        });
        draft.add(column(truth.pixels), cells);
    }
    draft.finish_or_give(options, (progress, afterwards))
}
