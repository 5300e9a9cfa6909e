//! Triangles that are not opaque everywhere: what becomes of a fragment is known when its opacity is, so its depth
//! is compared before and written afterwards.

use super::Counters;
use super::depth::DepthFormat;
use super::fill::Way;
use super::layers::{Layer, Layers};
use super::multisample::{SAMPLES, moved};
use super::opacity::{OPAQUE, over};
use super::shade::Attributes;
use super::target::{Antialias, Colour, SamplePlane, Target};
use rasterproof_core::contract::{Interpolate, Run, Varyings};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::ScreenTriangle;

pub struct Look<'a, const N: usize> {
    /// What all fragments have, where nothing is interpolated.
    pub constant: Option<Attributes<N>>,
    /// Whether what is mixed waits, to be mixed in the order of depths.
    pub is_kept: bool,
    /// The opacity of a fragment with these attributes at this depth, where 255 is opaque.
    pub opacity: &'a dyn Fn(&Attributes<N>, f64) -> u8,
    /// The colour of a fragment with these attributes at this depth.
    pub colour: &'a dyn Fn(&Attributes<N>, f64) -> Colour,
}

impl<const N: usize> Look<'_, N> {
    /// Shows each fragment of a run whose bit is set.
    fn each(
        &self,
        values: &mut dyn Varyings<Attributes<N>>,
        wanted: u32,
        see: &mut dyn FnMut(usize, &Attributes<N>),
    ) {
        if wanted == 0 {
            return;
        }
        let from = wanted.trailing_zeros() as usize;
        let to = (u32::BITS - wanted.leading_zeros()) as usize;
        let varyings = if self.constant.is_some() { &[][..] } else { values.varyings(from, to) };
        for i in (from..to).filter(|i| wanted >> i & 1 != 0) {
            see(i, self.constant.as_ref().unwrap_or_else(|| &varyings[i - from]));
        }
    }
}

fn put(colour: Colour, opacity: u8, drawn: &mut Colour) {
    *drawn = if opacity == OPAQUE { colour } else { over(colour, *drawn, opacity) };
}

/// The fragments of a run that are nearer than what is there; all where depths are not compared.
fn nearer(format: DepthFormat, way: Way, depths: &[f64], stored: &[u64]) -> u32 {
    let mut bits = 0;
    for (i, (depth, stored)) in depths.iter().zip(stored).enumerate() {
        bits |= u32::from(!way.depth_test || format.key(*depth) < *stored) << i;
    }
    bits
}

/// Draws the fragments of a run over one plane, which has a number, with the colour that `shade` gives for a column; how
/// many of them were nearer than what was there.
fn draw_run<const N: usize>(
    run: Run<'_, Attributes<N>>,
    (number, plane, layers): (usize, &mut SamplePlane, &mut Layers),
    format: DepthFormat,
    way: Way,
    look: &Look<'_, N>,
    shade: &mut dyn FnMut(i32, &Attributes<N>, f64) -> Colour,
) -> u64 {
    let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
    let stored = plane.depth.span_mut(y_px, x0_px, x1_px);
    let colours = plane.colour.span_mut(y_px, x0_px, x1_px);
    let wanted = nearer(format, way, run.depths, stored);
    look.each(run.values, wanted, &mut |i, varying| {
        let (x_px, depth) = (x0_px + i as i32, run.depths[i]);
        let opacity = (look.opacity)(varying, depth);
        if opacity == 0 {
            return;
        }
        let colour = shade(x_px, varying, depth);
        if look.is_kept && opacity != OPAQUE {
            let (plane, key) = (number as u8, format.key(depth));
            layers.all.push(Layer { plane, y_px, x_px, key, opacity, colour });
            return;
        }
        put(colour, opacity, &mut colours[i]);
        if way.depth_test && opacity == OPAQUE {
            stored[i] = format.key(depth);
        }
    });
    u64::from(wanted.count_ones())
}

/// Adds what was drawn of a triangle: its fragments, those that were nearer, and the colours that were computed.
fn count([emitted, visible, shaded]: [u64; 3], way: Way, counters: &mut Counters) {
    counters.fragments += emitted;
    counters.depth_tests += if way.depth_test { emitted } else { 0 };
    counters.depth_failed += emitted - visible;
    counters.shaded += shaded;
}

/// Draws one triangle, as far as it lies in `bounds`; how many fragments had their opacity computed.
///
/// Of four samples a pixel each has an opacity of its own, and those that are drawn have one colour: that at the centre
/// where the triangle covers it, else that at the first of them, as of an opaque triangle.
pub fn fill<const N: usize>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<Attributes<N>>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    look: &Look<'_, N>,
    counters: &mut Counters,
) -> u64 {
    if target.antialias() == Antialias::Multisample4 {
        return fill_multisampled(engine, piece, target, bounds, way, look, counters);
    }
    let format = target.format;
    let (planes, _, layers) = target.with_layers();
    let plane = &mut planes[0];
    let (mut emitted, mut visible, mut shaded) = (0, 0, 0);
    engine.runs(piece, bounds, way.affine, &mut |run| {
        emitted += run.depths.len() as u64;
        let to = (0, &mut *plane, &mut *layers);
        visible += draw_run(run, to, format, way, look, &mut |_, varying, depth| {
            shaded += 1;
            (look.colour)(varying, depth)
        });
    });
    count([emitted, visible, shaded], way, counters);
    visible
}

fn fill_multisampled<const N: usize>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<Attributes<N>>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    look: &Look<'_, N>,
    counters: &mut Counters,
) -> u64 {
    let format = target.format;
    let (planes, shading, layers) = target.with_layers();
    // Clipped pieces lie in the window, far from the domain's end.
    let moved: Vec<_> = SAMPLES.iter().map(|sample| moved(piece, *sample)).collect();
    let samples = || moved.iter().enumerate().filter_map(|(i, moved)| Some((i, moved.as_ref()?)));
    // A mark for each pixel in which a sample is nearer.
    for (i, moved) in samples() {
        engine.runs(moved, bounds, way.affine, &mut |run| {
            let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
            let stored = planes[i].depth.span_mut(y_px, x0_px, x1_px);
            let wanted = nearer(format, way, run.depths, stored);
            for (i, mark) in shading.centres.span_mut(y_px, x0_px, x1_px).iter_mut().enumerate() {
                *mark |= (wanted >> i & 1) as u8;
            }
        });
    }
    let (mut emitted, mut visible, mut shaded) = (0, 0, 0);
    engine.runs(piece, bounds, way.affine, &mut |run| {
        let (y_px, x0_px, depths) = (run.y_px, run.x0_px, run.depths);
        let marks = shading.centres.span_mut(y_px, x0_px, run.x1_px()).iter().enumerate();
        let wanted = marks.fold(0, |bits, (i, mark)| bits | u32::from(*mark) << i);
        look.each(run.values, wanted, &mut |i, varying| {
            shaded += 1;
            shading.put(x0_px + i as i32, y_px, (look.colour)(varying, depths[i]));
        });
    });
    for (i, moved) in samples() {
        let plane = &mut planes[i];
        engine.runs(moved, bounds, way.affine, &mut |run| {
            let y_px = run.y_px;
            shading.centres.span_mut(y_px, run.x0_px, run.x1_px()).fill(0);
            emitted += run.depths.len() as u64;
            let to = (i, &mut *plane, &mut *layers);
            visible += draw_run(run, to, format, way, look, &mut |x_px, varying, depth| {
                shading.get(x_px, y_px).unwrap_or_else(|| {
                    shaded += 1;
                    let colour = (look.colour)(varying, depth);
                    shading.put(x_px, y_px, colour);
                    colour
                })
            });
        });
    }
    count([emitted, visible, shaded], way, counters);
    visible
}
