//! From a triangle in the window to samples in the target: rasterize, depth-test, shade.

use super::Counters;
use super::multisample::{SAMPLES, moved};
use super::target::{Antialias, Colour, Target};
use crate::contract::Interpolate;
use crate::grid::PixelRect;
use crate::triangle::{Fragment, ScreenTriangle, Varying};

/// How the fragments of a triangle are made and kept: what the fragment stage does not see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// Interpolate linearly in the window: right where the three w are equal.
    pub affine: bool,
    /// Compare with the depth buffer and write to it; else every fragment is drawn.
    pub depth_test: bool,
}

/// Draws one triangle, as far as it lies in `bounds`. The fragment stage is asked for the colour of
/// what is visible.
pub fn fill<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    fragment_stage: impl Fn(&V) -> Colour,
    counters: &mut Counters,
) {
    if target.antialias() == Antialias::Multisample4 {
        fill_multisampled(engine, piece, target, bounds, way, fragment_stage, counters);
    } else if way.depth_test {
        fill_nearest(engine, piece, target, bounds, way.affine, fragment_stage, counters);
    } else {
        fill_over(engine, piece, target, bounds, way.affine, fragment_stage, counters);
    }
}

/// The fragments of a triangle for passes of which there are many: one copy of the rasterizer's code
/// for all of them.
pub(crate) fn fragments_of_pass<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    bounds: PixelRect,
    affine: bool,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    fragments(engine, piece, bounds, affine, emit);
}

/// The fragments of a triangle, with the division by 1/w or without.
#[inline]
fn fragments<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    bounds: PixelRect,
    affine: bool,
    emit: impl FnMut(Fragment<V>),
) {
    if affine {
        engine.affine_fragments(piece, bounds, emit);
    } else {
        engine.fragments(piece, bounds, emit);
    }
}

/// One sample a pixel, the nearer fragment wins.
fn fill_nearest<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    affine: bool,
    fragment_stage: impl Fn(&V) -> Colour,
    counters: &mut Counters,
) {
    let format = target.format;
    let plane = &mut target.planes[0];
    let (mut emitted, mut shaded) = (0, 0);
    fragments(engine, piece, bounds, affine, |f| {
        emitted += 1;
        let stage = || fragment_stage(&f.varying);
        shaded += u64::from(plane.test_and_write(f.x_px, f.y_px, format.key(f.depth), stage));
    });
    counters.fragments += emitted;
    counters.depth_tests += emitted;
    counters.depth_failed += emitted - shaded;
    counters.shaded += shaded;
}

/// One sample a pixel, the later fragment wins.
fn fill_over<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    affine: bool,
    fragment_stage: impl Fn(&V) -> Colour,
    counters: &mut Counters,
) {
    let plane = &mut target.planes[0];
    let mut emitted = 0;
    fragments(engine, piece, bounds, affine, |f| {
        emitted += 1;
        plane.write(f.x_px, f.y_px, fragment_stage(&f.varying));
    });
    counters.fragments += emitted;
    counters.shaded += emitted;
}

/// One colour, the later triangle wins: coverage alone, a fill for each row.
pub fn fill_flat(
    engine: &impl Interpolate,
    corners: crate::triangle::Corners,
    target: &mut Target,
    colour: Colour,
    counters: &mut Counters,
) {
    let bounds = target.bounds();
    let mut emitted = 0;
    let plane = &mut target.planes[0];
    engine.cover(corners, bounds, |span| {
        emitted += u64::from(span.x0_px.abs_diff(span.x1_px));
        plane.colour.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour);
    });
    counters.fragments += emitted;
}

/// Four samples a pixel, shaded once: at the centre where the triangle covers it, else at the first
/// visible sample, so that no value is extrapolated.
fn fill_multisampled<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    fragment_stage: impl Fn(&V) -> Colour,
    counters: &mut Counters,
) {
    let format = target.format;
    let (planes, shading) = target.with_shading();
    let mut shaded = 0;
    fragments_of_pass(engine, piece, bounds, way.affine, &mut |f| {
        shaded += 1;
        shading.put(f.x_px, f.y_px, fragment_stage(&f.varying));
    });
    let mut emitted = 0;
    let mut failed = 0;
    for (plane, sample) in planes.iter_mut().zip(SAMPLES) {
        // Clipped pieces lie in the window, far from the domain's end.
        let Some(moved) = moved(piece, sample) else { continue };
        fragments_of_pass(engine, &moved, bounds, way.affine, &mut |f| {
            emitted += 1;
            let mut colour = || {
                shading.get(f.x_px, f.y_px).unwrap_or_else(|| {
                    shaded += 1;
                    let colour = fragment_stage(&f.varying);
                    shading.put(f.x_px, f.y_px, colour);
                    colour
                })
            };
            if way.depth_test {
                let key = format.key(f.depth);
                failed += u64::from(!plane.test_and_write(f.x_px, f.y_px, key, colour));
            } else {
                plane.write(f.x_px, f.y_px, colour());
            }
        });
    }
    counters.fragments += emitted;
    counters.depth_tests += if way.depth_test { emitted } else { 0 };
    counters.depth_failed += failed;
    counters.shaded += shaded;
}
