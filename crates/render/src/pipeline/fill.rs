//! From a triangle in the window to samples in the target: rasterize, depth-test, shade.

use super::Counters;
use super::depth::DepthFormat;
pub use super::fragments::{FragmentStage, Lanes, Over, Way, each};
pub(crate) use super::fragments::{all_of, shade};
use super::multisample::{SAMPLES, moved};
use super::see_through;
use super::target::{Antialias, Colour, SamplePlane, Shading, Target};
use rasterproof_core::contract::{Interpolate, RUN, Run};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{ScreenTriangle, Span, Varying};

/// Draws one triangle, as far as it lies in `bounds`. The fragment stage is asked for the colour of
/// what is visible; how many fragments are.
pub fn fill<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    stage: &mut dyn FragmentStage<V>,
    counters: &mut Counters,
) -> u64 {
    let [emitted, visible, shaded] = match (target.antialias(), way.over) {
        (Antialias::Multisample4, Over::Replace) => {
            fill_multisampled(engine, piece, target, bounds, way, stage)
        }
        (Antialias::Multisample4, _) => {
            see_through::fill_multisampled(engine, piece, target, bounds, way, stage)
        }
        (_, Over::Replace) => fill_single(engine, piece, target, bounds, way, stage),
        _ => see_through::fill_single(engine, piece, target, bounds, way, stage),
    };
    counters.fragments += emitted;
    counters.depth_tests += if way.depth_test { emitted } else { 0 };
    counters.depth_failed += emitted - visible;
    counters.shaded += shaded;
    visible
}

/// Runs of fewer pixels are mostly of small pieces.
const SHORT: usize = 4;

/// Tests the depths of a run and keeps the nearer ones; a bit for each that is.
#[inline]
fn test(format: DepthFormat, run: &Run<'_, impl Copy>, depth: &mut Frame<u64>) -> u32 {
    // What a test waits for is memory. So the next row, where the run after this mostly lies, is
    // asked for now; not of small pieces, whose neighbours have just been there.
    if run.depths.len() >= SHORT {
        std::hint::black_box(depth.get(run.x0_px, run.y_px + 1));
    }
    format.test_and_write(run.depths, depth.span_mut(run.y_px, run.x0_px, run.x1_px()))
}

/// One sample a pixel: the nearer fragment wins, or the later one. How many fragments there are, are visible, and are shaded.
fn fill_single<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    stage: &mut dyn FragmentStage<V>,
) -> [u64; 3] {
    let format = target.format;
    let SamplePlane { colour, depth } = &mut target.planes[0];
    let (mut emitted, mut shaded) = (0, 0);
    engine.runs(piece, bounds, way.affine, &mut |run| {
        let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
        let visible =
            if way.depth_test { test(format, &run, depth) } else { all_of(run.depths.len()) };
        emitted += run.depths.len() as u64;
        shaded += u64::from(visible.count_ones());
        if visible != 0 {
            shade((run.values, run.depths), visible, stage, colour.span_mut(y_px, x0_px, x1_px));
        }
    });
    [emitted, shaded, shaded]
}

/// One colour, the later triangle wins: coverage alone, a fill for each row.
pub fn fill_flat(
    engine: &impl Interpolate,
    corners: rasterproof_core::triangle::Corners,
    target: &mut Target,
    bounds: PixelRect,
    colour: Colour,
    counters: &mut Counters,
) {
    let mut emitted = 0;
    let plane = &mut target.planes[0];
    engine.cover(corners, bounds, |span| {
        emitted += u64::from(span.x0_px.abs_diff(span.x1_px));
        plane.colour.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour);
    });
    counters.fragments += emitted;
}

/// Four samples a pixel, shaded once where one of them is visible: at the centre where the triangle
/// covers it, else at the first visible sample, so that no value is extrapolated.
///
/// The samples are tested first. Those of pixels that are covered at the centre wait for its colour,
/// so that nothing hidden is shaded.
fn fill_multisampled<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    target: &mut Target,
    bounds: PixelRect,
    way: Way,
    stage: &mut dyn FragmentStage<V>,
) -> [u64; 3] {
    let format = target.format;
    let (planes, shading) = target.with_shading();
    engine.cover(piece.corners(), bounds, |Span { y_px, x0_px, x1_px }| {
        shading.centres.span_mut(y_px, x0_px, x1_px).fill(Shading::CENTRE);
    });
    let (mut emitted, mut visible, mut shaded) = (0, 0, 0);
    for (i, (plane, sample)) in planes.iter_mut().zip(SAMPLES).enumerate() {
        // Clipped pieces lie in the window, far from the domain's end.
        let Some(moved) = moved(piece, sample) else { continue };
        let SamplePlane { colour, depth } = plane;
        engine.runs(&moved, bounds, way.affine, &mut |run| {
            let (y_px, x0_px) = (run.y_px, run.x0_px);
            let nearer =
                if way.depth_test { test(format, &run, depth) } else { all_of(run.depths.len()) };
            emitted += run.depths.len() as u64;
            visible += u64::from(nearer.count_ones());
            let mut outside = shading.wait(y_px, x0_px, nearer, i);
            while outside != 0 {
                let at = outside.trailing_zeros();
                outside &= outside - 1;
                let x_px = x0_px + at as i32;
                let drawn = &mut colour.span_mut(y_px, x_px, x_px + 1);
                if let Some(colour) = shading.get(x_px, y_px) {
                    drawn[0] = colour;
                } else {
                    shaded += 1;
                    let at = at as usize;
                    let (values, depths) = (run.values.varyings(at, at + 1), &run.depths[at..=at]);
                    stage.colours(Lanes { values, depths, wanted: 1 }, drawn);
                    shading.put(x_px, y_px, drawn[0]);
                }
            }
        });
    }
    shaded +=
        fill_waiting(engine, piece, (planes, shading), bounds, way.affine, stage, visible > 0);
    [emitted, visible, shaded]
}

/// Gives the samples that wait for it the colour at the centre, and forgets which those were; how
/// many pixels were shaded.
fn fill_waiting<V: Varying>(
    engine: &impl Interpolate,
    piece: &ScreenTriangle<V>,
    (planes, shading): (&mut [SamplePlane], &mut Shading),
    bounds: PixelRect,
    affine: bool,
    stage: &mut dyn FragmentStage<V>,
    any: bool,
) -> u64 {
    if !any {
        engine.cover(piece.corners(), bounds, |Span { y_px, x0_px, x1_px }| {
            shading.centres.span_mut(y_px, x0_px, x1_px).fill(0);
        });
        return 0;
    }
    let mut shaded = 0;
    engine.runs(piece, bounds, affine, &mut |run| {
        let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
        let waiting = shading.centres.span_mut(y_px, x0_px, x1_px);
        let bits = waiting.iter().enumerate();
        let wanted =
            bits.fold(0, |bits, (i, centre)| bits | u32::from(centre & !Shading::CENTRE != 0) << i);
        if wanted != 0 {
            shaded += u64::from(wanted.count_ones());
            let mut colours = [[0; 4]; RUN];
            shade((run.values, run.depths), wanted, stage, &mut colours[..run.depths.len()]);
            for (sample, plane) in planes.iter_mut().enumerate() {
                let drawn = plane.colour.span_mut(y_px, x0_px, x1_px).iter_mut();
                for ((drawn, centre), colour) in drawn.zip(&*waiting).zip(colours) {
                    *drawn = if centre >> sample & 1 != 0 { colour } else { *drawn };
                }
            }
        }
        waiting.fill(0);
    });
    shaded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::depth::DepthFormat;
    use crate::pipeline::shade::Attributes;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::random::Rng;
    use rasterproof_core::raster::edge_function::EdgeFunction;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::{Fragment, ScreenVertex};

    const WIDTH_PX: u32 = 50;
    const HEIGHT_PX: u32 = 12;

    /// A triangle about the picture: some reach so far out that no number of theirs is exact in f64.
    fn piece(rng: &mut Rng, reach: i64) -> ScreenTriangle<Attributes<3>> {
        let is_flat = rng.chance(3);
        let mut vertex = || {
            let [x, y] = [WIDTH_PX, HEIGHT_PX].map(|side| {
                let side = i64::from(side) * 256;
                rng.int(-reach, side + reach) as i32
            });
            let varying = Attributes([rng.unit(), rng.unit(), rng.unit()]);
            let inv_w = if is_flat { 1.0 } else { 0.1 + rng.unit() };
            ScreenVertex { position: SubpixelPoint::new(x, y), depth: rng.unit(), inv_w, varying }
        };
        ScreenTriangle { vertices: [vertex(), vertex(), vertex()] }
    }

    fn colour_of(varying: &Attributes<3>) -> Colour {
        let [r, g, b] = varying.0.map(|v| (v * 255.0) as u8);
        [r, g, b, 255]
    }

    fn bits(fragment: &Fragment<Attributes<3>>) -> [u64; 4] {
        let [a, b, c] = fragment.varying.0.map(f64::to_bits);
        [fragment.depth.to_bits(), a, b, c]
    }

    /// Runs against pixels that are drawn one at a time, and whole runs against parts of them.
    fn compare_runs(engine: &impl Interpolate) -> (u64, usize) {
        let window = PixelRect::window(WIDTH_PX, HEIGHT_PX);
        let (mut count, mut longest) = (0, 0);
        for index in 0..240 {
            let reach = [300, 20_000, 1 << 26, 1 << 30][index as usize % 4];
            let piece = piece(&mut Rng::new("runs", 1, index), reach);
            for affine in [false, true] {
                engine.runs(&piece, window, affine, &mut |run| {
                    let length = run.depths.len();
                    longest = longest.max(length);
                    let parts: Vec<_> =
                        (0..length).rev().map(|i| run.values.varyings(i, i + 1)[0]).collect();
                    assert!(parts.iter().rev().eq(run.values.varyings(0, length)));
                    run.each(|whole| {
                        count += 1;
                        let (x0, y0) = (whole.x_px, whole.y_px);
                        let pixel = PixelRect { x0, y0, x1: x0 + 1, y1: y0 + 1 };
                        let mut alone = Vec::new();
                        if affine {
                            engine.affine_fragments(&piece, pixel, |f| alone.push(f));
                        } else {
                            engine.fragments(&piece, pixel, |f| alone.push(f));
                        }
                        assert_eq!(alone.len(), 1);
                        assert_eq!(bits(&alone[0]), bits(&whole), "{index} {affine} ({x0}, {y0})");
                    });
                });
            }
        }
        (count, longest)
    }

    #[test]
    fn runs_have_the_bits_of_single_pixels() {
        for (count, longest) in [compare_runs(&Scanline), compare_runs(&EdgeFunction)] {
            assert!(count > 10_000 && longest == RUN, "{count}, {longest}");
        }
    }

    /// [`fill`] as one would write it first: every fragment by itself, shaded whether it is seen or
    /// not. Returns how many pixels have a sample that is seen.
    fn fill_simply(
        engine: &impl Interpolate,
        piece: &ScreenTriangle<Attributes<3>>,
        target: &mut Target,
        way: Way,
    ) -> u64 {
        let (bounds, format) = (target.bounds(), target.format);
        let is_multisampled = target.antialias() == Antialias::Multisample4;
        let each = |piece: &ScreenTriangle<_>, emit: &mut dyn FnMut(Fragment<Attributes<3>>)| {
            if way.affine {
                engine.affine_fragments(piece, bounds, emit);
            } else {
                engine.fragments(piece, bounds, emit);
            }
        };
        let mut shaded = std::collections::BTreeMap::new();
        if is_multisampled {
            each(piece, &mut |f| {
                shaded.insert((f.x_px, f.y_px), colour_of(&f.varying));
            });
        }
        let mut seen = std::collections::BTreeSet::new();
        for (i, plane) in target.planes.iter_mut().enumerate() {
            let piece = if is_multisampled { moved(piece, SAMPLES[i]).unwrap() } else { *piece };
            each(&piece, &mut |f| {
                let key = if way.depth_test { format.key(f.depth) } else { 0 };
                let stored = plane.depth.get(f.x_px, f.y_px).unwrap();
                if !way.depth_test || key < stored {
                    let key = if way.depth_test { key } else { stored };
                    let at = (f.x_px, f.y_px);
                    let colour = *shaded.entry(at).or_insert_with(|| colour_of(&f.varying));
                    plane.put(f.x_px, f.y_px, key, colour);
                    seen.insert(at);
                }
            });
        }
        seen.len() as u64
    }

    fn compare_fills(engine: &impl Interpolate, antialias: Antialias, format: DepthFormat) -> u64 {
        let new = || Target::new(WIDTH_PX, HEIGHT_PX, antialias, format).unwrap();
        let (mut fast, mut simple, mut counters) = (new(), new(), Counters::default());
        let mut seen = 0;
        for index in 0..60 {
            let mut rng = Rng::new("fills", 1, index);
            let piece = piece(&mut rng, [300, 20_000][index as usize % 2]);
            let (affine, depth_test) = (rng.chance(2), !rng.chance(5));
            let way = Way { affine, depth_test, ..Way::default() };
            let bounds = fast.bounds();
            fill(
                engine,
                &piece,
                &mut fast,
                bounds,
                way,
                &mut each(|varying, _| colour_of(varying)),
                &mut counters,
            );
            seen += fill_simply(engine, &piece, &mut simple, way);
            assert!(fast.planes == simple.planes, "{antialias:?} {format:?}, piece {index}");
        }
        assert_eq!(counters.shaded, seen);
        counters.depth_failed
    }

    #[test]
    fn fills_have_the_bits_of_single_fragments() {
        for antialias in [Antialias::None, Antialias::Multisample4, Antialias::Supersample(2)] {
            for format in DepthFormat::ALL {
                assert!(compare_fills(&Scanline, antialias, format) > 1000);
                assert!(compare_fills(&EdgeFunction, antialias, format) > 1000);
            }
        }
    }
}
