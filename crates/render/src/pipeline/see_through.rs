//! Triangles that are not opaque everywhere: what becomes of a fragment is known when its opacity is, so its depth
//! is compared before and written afterwards.

use super::depth::DepthFormat;
use super::fragments::{FragmentStage, Lanes, Over, Way, shade};
use super::layers::{Layer, Layers};
use super::multisample::{SAMPLES, moved};
use super::opacity::{OPAQUE, over};
use super::target::{Colour, SamplePlane, Target};
use rasterproof_core::contract::{Interpolate, RUN, Run};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{ScreenTriangle, Varying};

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

/// What gives colours to fragments of a run, of which the first lies in a column.
type Shade<'a, V> = dyn FnMut(&mut dyn FragmentStage<V>, Lanes<'_, V>, i32, &mut [Colour]) + 'a;

/// One plane of samples, which has a number, with where layers wait.
struct Plane<'a> {
    number: u8,
    plane: &'a mut SamplePlane,
    layers: &'a mut Layers,
    format: DepthFormat,
    way: Way,
}

impl Plane<'_> {
    /// Draws the fragments of a run in the colours that `shade` gives to those that are not left out. Returns how many of them were
    /// nearer than what was there.
    fn draw<V: Varying>(
        &mut self,
        run: Run<'_, V>,
        stage: &mut dyn FragmentStage<V>,
        shade: &mut Shade<'_, V>,
    ) -> u64 {
        let Self { number, plane, layers, format, way } = self;
        let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
        let stored = plane.depth.span_mut(y_px, x0_px, x1_px);
        let wanted = nearer(*format, *way, run.depths, stored);
        if wanted == 0 {
            return 0;
        }
        let from = wanted.trailing_zeros() as usize;
        let to = (u32::BITS - wanted.leading_zeros()) as usize;
        let (values, depths) = (run.values.varyings(from, to), &run.depths[from..to]);
        let (mut opacities, mut colours) = ([0; RUN], [[0; 4]; RUN]);
        let bits = wanted >> from;
        let nearer = Lanes { values, depths, wanted: bits };
        stage.opacities(nearer, &mut opacities[..to - from]);
        let mut drawn = 0;
        for (i, opacity) in opacities[..to - from].iter().enumerate() {
            drawn |= u32::from(*opacity != 0) << i & bits;
        }
        if drawn != 0 {
            let lanes = Lanes { values, depths, wanted: drawn };
            shade(stage, lanes, x0_px + from as i32, &mut colours[..to - from]);
        }
        let before = plane.colour.span_mut(y_px, x0_px, x1_px);
        for i in 0..to - from {
            if drawn >> i & 1 == 0 {
                continue;
            }
            let (opacity, colour, key) = (opacities[i], colours[i], format.key(depths[i]));
            if way.over == Over::Keep && opacity != OPAQUE {
                let (plane, x_px) = (*number, x0_px + (from + i) as i32);
                layers.all.push(Layer { plane, y_px, x_px, key, opacity, colour });
                continue;
            }
            put(colour, opacity, &mut before[from + i]);
            if way.depth_test && opacity == OPAQUE {
                stored[from + i] = key;
            }
        }
        u64::from(wanted.count_ones())
    }
}

/// Draws one triangle, as far as it lies in `bounds`: how many fragments there are, have their opacity computed, and are shaded.
pub(super) fn fill_single<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    stage: &mut dyn FragmentStage<V>,
) -> [u64; 3] {
    let format = target.format;
    let (planes, _, layers) = target.with_layers();
    let mut plane = Plane { number: 0, plane: &mut planes[0], layers, format, way };
    let (mut emitted, mut visible, mut shaded) = (0, 0, 0);
    engine.runs(piece, bounds, way.affine, &mut |run| {
        emitted += run.depths.len() as u64;
        visible += plane.draw(run, stage, &mut |stage, lanes, _, colours| {
            shaded += u64::from(lanes.wanted.count_ones());
            stage.colours(lanes, colours);
        });
    });
    [emitted, visible, shaded]
}

/// The same of four samples a pixel. Each has an opacity of its own, and those that are drawn have one colour: that at the centre
/// where the triangle covers it, else that at the first of them, as of an opaque triangle.
pub(super) fn fill_multisampled<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    stage: &mut dyn FragmentStage<V>,
) -> [u64; 3] {
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
        let (y_px, x0_px) = (run.y_px, run.x0_px);
        let marks = shading.centres.span_mut(y_px, x0_px, run.x1_px()).iter().enumerate();
        let wanted = marks.fold(0, |bits, (i, mark)| bits | u32::from(*mark) << i);
        if wanted == 0 {
            return;
        }
        let mut colours = [[0; 4]; RUN];
        shade((run.values, run.depths), wanted, stage, &mut colours[..run.depths.len()]);
        for (i, colour) in colours.into_iter().enumerate().filter(|(i, _)| wanted >> i & 1 != 0) {
            shaded += 1;
            shading.put(x0_px + i as i32, y_px, colour);
        }
    });
    for (i, moved) in samples() {
        let mut plane =
            Plane { number: i as u8, plane: &mut planes[i], layers: &mut *layers, format, way };
        engine.runs(moved, bounds, way.affine, &mut |run| {
            let y_px = run.y_px;
            shading.centres.span_mut(y_px, run.x0_px, run.x1_px()).fill(0);
            emitted += run.depths.len() as u64;
            visible += plane.draw(run, stage, &mut |stage, lanes, x0_px, colours| {
                for (i, colour) in colours.iter_mut().enumerate() {
                    let (x_px, at) = (x0_px + i as i32, i..=i);
                    if lanes.wanted >> i & 1 == 0 {
                        continue;
                    }
                    *colour = shading.get(x_px, y_px).unwrap_or_else(|| {
                        shaded += 1;
                        let mut own = [[0; 4]];
                        let (values, depths) = (&lanes.values[at.clone()], &lanes.depths[at]);
                        stage.colours(Lanes { values, depths, wanted: 1 }, &mut own);
                        shading.put(x_px, y_px, own[0]);
                        own[0]
                    });
                }
            });
        });
    }
    [emitted, visible, shaded]
}
