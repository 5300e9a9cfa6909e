//! The group of interpolation: how far values are from the exact ones, and what they take.
//!
//! Spans come from the exact scanline and are not timed. Errors are taken at a sample of the pixels,
//! against quotients of big integers; each choice with a derived bound is also held to that.

use super::bounds::{Bound, Place, largest};
use super::drawn::{AnyValues, CoveredTriangle, dress, pixels};
use super::scene::{Scene, Size, scenes};
use super::tiles::Planes;
use super::{Board, Choice, Column, CostOptions, Draft, Ladder, Name, Places, PreparedCell, Told};
use crate::ladder::Real;
use crate::ladder::interpolation::{
    Accumulated, Affine, BookFormula, Direct, EverySixteen, Offset, Plane, Valued, Values,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::triangle::Span;
use rasterproof_verify::oracle::values::{Exact, ExactTriangle};

/// Half a step of 8 bits over [0, M]: nobody sees less.
pub(super) const HALF_STEP: f64 = 1.0 / 512.0;

impl AnyValues<Valued> for Planes {
    fn each(&self, drawn: &CoveredTriangle<Valued>, emit: &mut dyn FnMut(i32, i32, f64)) {
        self.runs(&drawn.triangle, &drawn.spans, &mut |x_px, y_px, values| {
            for (x_px, &value) in (x_px..).zip(values) {
                emit(x_px, y_px, value.into());
            }
        });
    }

    fn paint(&self, drawn: &[CoveredTriangle<Valued>], target: &mut Frame<f32>) {
        for CoveredTriangle { triangle, spans, .. } in drawn {
            self.runs(triangle, spans, &mut |x_px, y_px, values| {
                let run = target.span_mut(y_px, x_px, x_px + values.len() as i32);
                run.copy_from_slice(values);
            });
        }
    }
}

/// The oracle as a choice: the exact quotient at every pixel, rounded once.
#[derive(Clone, Copy, Debug)]
struct Rational;

impl Values for Rational {
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let Some(exact) = exact(triangle) else { return };
        for span in spans {
            for x_px in span.x0_px..span.x1_px {
                let (_, [value]) = exact.at(x_px, span.y_px);
                emit(x_px, span.y_px, value.to_f64());
            }
        }
    }
}

fn exact(triangle: &Valued) -> Option<ExactTriangle<1>> {
    let Valued { corners, inv_w, value } = triangle;
    ExactTriangle::new(corners, [0.0; 3], *inv_w, value.map_array(|v| [v]))
}

struct Variant {
    choice: Choice,
    bound: Bound,
    unit: f64,
    body: Box<dyn AnyValues<Valued>>,
}

fn variant<T: Real>(
    name: &'static str,
    about: impl Into<Name>,
    bound: Bound,
    body: impl AnyValues<Valued> + 'static,
) -> Variant {
    // 13 D + M is at most 27 M, far below the goal with either float.
    let promises =
        if matches!(bound, Bound::Offset | Bound::Rounded) { vec![0] } else { Vec::new() };
    Variant {
        choice: Choice::new(name, about, &promises),
        bound,
        unit: T::UNIT,
        body: Box::new(body),
    }
}

fn variants() -> Vec<Variant> {
    vec![
        variant::<f32>("affine", "f32, w ignored", Bound::Affine, Affine::<f32>::default()),
        variant::<f32>(
            "every 16 px",
            "f32, one division for 16 pixels, as Quake did",
            Bound::EverySixteen,
            EverySixteen::<f32>::default(),
        ),
        variant::<f32>(
            "book (8)",
            "f32, the book's formula with t accumulated",
            Bound::BookFormula,
            BookFormula::<f32>::default(),
        ),
        variant::<f32>(
            "1/w added up",
            "f32, 1/w and v/w accumulated along the row",
            Bound::Accumulated,
            Accumulated::<f32>::default(),
        ),
        variant::<f32>(
            "1/w direct",
            "f32, 1/w and v/w at each pixel",
            Bound::Direct,
            Direct::<f32>::default(),
        ),
        variant::<f32>(
            "plane",
            "f32, 1/w and v/w as planes",
            Bound::Plane,
            Plane::<f32>::default(),
        ),
        variant::<f32>(
            "planes f32 x 16",
            Planes::default().about(),
            Bound::Tile,
            Planes::default(),
        ),
        variant::<f32>(
            "offset f32",
            "exact edge functions as weights",
            Bound::Offset,
            Offset::<f32>::default(),
        ),
        variant::<f64>(
            "offset f64",
            "exact edge functions as weights",
            Bound::Offset,
            Offset::<f64>::default(),
        ),
        variant::<f64>("rational", "the oracle, rounded once", Bound::Rounded, Rational),
    ]
}

/// The triangles of a scene on the lattice, with w and a value at each corner.
fn valued(scene: &Scene) -> Vec<CoveredTriangle<Valued>> {
    dress(scene, |number, corners, inv_w| {
        let w = scene.w[number];
        // From the positions, so that the values need no generator: within [-1, 1], exactly f32.
        let made = |i: usize| f64::from(corners[i].x % 509 - 254 + (w[i] as i32) % 2) / 256.0;
        let given = scene.values.get(number).copied();
        let value = given.unwrap_or_else(|| [0, 1, 2].map_array(made));
        Valued { corners, inv_w, value }
    })
}

struct Sample {
    triangle: usize,
    number: usize,
    exact: Exact,
}

/// Every so many-th pixel is a sample, so that there are about `count`.
fn stride(pixels: usize, count: usize) -> usize {
    // Odd, so that a stride does not keep step with rows of even length.
    (pixels / count).max(1) | 1
}

/// In how many of so many pixels values are compared.
pub fn compared_values(pixels: u64) -> u64 {
    pixels.div_ceil(stride(pixels as usize, SAMPLES) as u64)
}

/// About `count` samples of all pixels, evenly spread in drawing order.
fn samples(drawn: &[CoveredTriangle<Valued>], count: usize) -> Vec<Sample> {
    let stride = stride(pixels(drawn), count);
    let mut samples = Vec::new();
    let mut before = 0;
    for (triangle, CoveredTriangle { triangle: valued, spans, .. }) in drawn.iter().enumerate() {
        let columns = spans.iter().flat_map(|s| (s.x0_px..s.x1_px).map(|x_px| (x_px, s.y_px)));
        let Some(plane) = exact(valued) else { continue };
        let mut number = 0;
        for (x_px, y_px) in columns {
            if (before + number) % stride == 0 {
                let (_, [exact]) = plane.at(x_px, y_px);
                samples.push(Sample { triangle, number, exact });
            }
            number += 1;
        }
        before += number;
    }
    samples
}

/// Takes a triangle, a sample of it, the pixel and the value that a choice has there.
type See<'a, 'b> = dyn FnMut(&'a CoveredTriangle<Valued>, &Sample, [i32; 2], f64) + 'b;

/// Calls `see` for each sample.
fn at_samples<'a>(
    choice: &dyn AnyValues<Valued>,
    drawn: &'a [CoveredTriangle<Valued>],
    samples: &[Sample],
    see: &mut See<'a, '_>,
) {
    let mut samples = samples.iter().peekable();
    for (i, of_this) in drawn.iter().enumerate() {
        if samples.peek().is_none_or(|sample| sample.triangle != i) {
            continue;
        }
        let mut number = 0;
        choice.each(of_this, &mut |x_px, y_px, value| {
            if let Some(sample) = samples.next_if(|s| s.triangle == i && s.number == number) {
                see(of_this, sample, [x_px, y_px], value);
            }
            number += 1;
        });
    }
}

/// Errors of a choice at the samples: over M, in u M, over the bound.
fn errors(
    variant: &Variant,
    drawn: &[CoveredTriangle<Valued>],
    samples: &[Sample],
) -> Vec<Option<f64>> {
    let (mut worst, mut worst_bound) = (0f64, None::<f64>);
    at_samples(&*variant.body, drawn, samples, &mut |of_this, sample, [x_px, y_px], value| {
        let CoveredTriangle { triangle, spans, .. } = of_this;
        let error = sample.exact.distance(value);
        worst = worst.max(relative(of_this, sample, value));
        let place = Place { triangle, spans, span: row_of(spans, y_px), x_px };
        if let Some(bound) = variant.bound.at(&place, variant.unit) {
            let share = if error == 0.0 { 0.0 } else { error / bound };
            worst_bound = Some(worst_bound.unwrap_or(0.0).max(share));
        }
    });
    vec![Some(worst), Some(worst / variant.unit), worst_bound]
}

/// The span of a row; rows before it may be missing.
fn row_of(spans: &[Span], y_px: i32) -> Span {
    let guess = (y_px - spans[0].y_px).clamp(0, spans.len() as i32 - 1) as usize;
    let mut near = spans[..=guess].iter().rev();
    *near.find(|span| span.y_px == y_px).expect("values come from the rows given")
}

/// What the choices get wrong of some triangles.
#[derive(Clone, Debug)]
pub struct WrongValues {
    pub choices: Vec<WrongOfChoice>,
    /// Pixels that were looked at, evenly spread, and all.
    pub pixels: u64,
    pub of: u64,
}

#[derive(Clone, Debug)]
pub struct WrongOfChoice {
    /// By triangle the pixels whose value is off by more than half a step of 8 bits of the largest.
    pub wrong: Vec<u64>,
    /// The worst error over the largest value.
    pub worst: f64,
}

/// The pixels of each triangle in which each choice is visibly wrong.
pub fn wrong_values(scene: &Scene) -> WrongValues {
    let drawn = valued(scene);
    let samples = samples(&drawn, 4 * SAMPLES);
    let of_choice = |variant: Variant| {
        let mut found = WrongOfChoice { wrong: vec![0; scene.triangles.len()], worst: 0.0 };
        at_samples(&*variant.body, &drawn, &samples, &mut |of_this, sample, _, value| {
            let limit = HALF_STEP * largest(of_this.triangle.value);
            found.wrong[of_this.number] += u64::from(sample.exact.distance(value) > limit);
            found.worst = found.worst.max(relative(of_this, sample, value));
        });
        found
    };
    let choices = variants().into_iter().map(of_choice).collect();
    WrongValues { choices, pixels: samples.len() as u64, of: pixels(&drawn) as u64 }
}

/// The error of a value over the largest of its triangle, where that is not 0.
fn relative(of_this: &CoveredTriangle<Valued>, sample: &Sample, value: f64) -> f64 {
    let (m, error) = (largest(of_this.triangle.value), sample.exact.distance(value));
    if m > 0.0 { error / m } else { error }
}

pub(super) fn measure(options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
    let pixels = if options.quick { 8_000 } else { 60_000 };
    let scenes = scenes(options.seed, Size { side_px: 512, pixels });
    let count = if options.quick { 500 } else { SAMPLES };
    measure_on(&scenes, options, count, (progress, &mut |_, _| ()))
}

pub(super) const SAMPLES: usize = 4000;

pub(super) fn measure_on(
    scenes: &[Scene],
    options: &CostOptions,
    count: usize,
    (progress, afterwards): Told<'_>,
) -> Board {
    let variants = variants();
    let drawn: Vec<_> = scenes.iter().map(valued).collect();
    let targets: Vec<_> =
        scenes.iter().map(|scene| Places::new(|| Frame::new(scene.bounds, 0f32))).collect();
    let choices = variants.iter().map(|variant| variant.choice.clone());
    let mut draft = Draft::new(Ladder::Interpolation, choices, options);
    for ((scene, drawn), target) in scenes.iter().zip(&drawn).zip(&targets) {
        draft.tell(progress, scenes.len());
        let samples = samples(drawn, count);
        let cells = variants.iter().map(|variant| {
            PreparedCell::ready(errors(variant, drawn, &samples), || {
                variant.body.paint(std::hint::black_box(drawn), &mut target.borrow_mut());
            })
        });
        let (items, pixels) = (drawn.len() as u64, pixels(drawn) as u64);
        draft.add(Column::new(scene.name, scene.about, items, pixels), cells);
    }
    draft.finish_or_give(options, (progress, afterwards))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The worst share of its bound that a choice reaches on every class of scenes, all pixels asked.
    fn worst(variant: &Variant, seed: u64) -> f64 {
        scenes(seed, Size { side_px: 64, pixels: 1500 })
            .iter()
            .map(|scene| {
                let drawn = valued(scene);
                let samples = samples(&drawn, usize::MAX);
                assert!(samples.len() > 100, "{}", scene.name);
                errors(variant, &drawn, &samples)[2].unwrap_or(0.0)
            })
            .fold(0.0, f64::max)
    }

    fn in_both<T: Real>() -> Vec<Variant> {
        vec![
            variant::<T>("affine", "", Bound::Affine, Affine::<T>::default()),
            variant::<T>("sixteen", "", Bound::EverySixteen, EverySixteen::<T>::default()),
            variant::<T>("book", "", Bound::BookFormula, BookFormula::<T>::default()),
            variant::<T>("accumulated", "", Bound::Accumulated, Accumulated::<T>::default()),
            variant::<T>("direct", "", Bound::Direct, Direct::<T>::default()),
            variant::<T>("plane", "", Bound::Plane, Plane::<T>::default()),
            variant::<T>("offset", "", Bound::Offset, Offset::<T>::default()),
        ]
    }

    /// Every choice keeps its derived bound, in either float; and none of the bounds is idle.
    #[test]
    fn bounds_are_kept() {
        let choices = in_both::<f32>().into_iter().chain(in_both::<f64>());
        for variant in choices.chain(variants()) {
            let shares: Vec<f64> = (1..=3).map(|seed| worst(&variant, seed)).collect();
            let name = (variant.choice.name, variant.unit);
            assert!(shares.iter().all(|&share| share <= 1.0), "{name:?} {shares:?}");
            assert!(shares.iter().any(|&share| share > 0.05), "{name:?} {shares:?}");
        }
    }

    /// Each bound is exceeded by the choice with a fault planted: values of the next pixel, off by less
    /// than anybody sees in most scenes.
    struct Late<R>(R);

    impl<R: Values> Values for Late<R> {
        fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
            let mut held = 0.0;
            self.0.values(triangle, spans, |x_px, y_px, value| {
                // The first pixel of a row is right.
                let is_first = spans.iter().any(|s| s.y_px == y_px && s.x0_px == x_px);
                emit(x_px, y_px, if is_first { value } else { held });
                held = value;
            });
        }
    }

    fn late(bound: Bound, choice: impl Values + Sync + 'static) -> Variant {
        variant::<f32>("late", "", bound, Late(choice))
    }

    #[test]
    fn bounds_find_planted_faults() {
        let late = [
            late(Bound::Affine, Affine::<f32>::default()),
            late(Bound::EverySixteen, EverySixteen::<f32>::default()),
            late(Bound::BookFormula, BookFormula::<f32>::default()),
            late(Bound::Accumulated, Accumulated::<f32>::default()),
            late(Bound::Direct, Direct::<f32>::default()),
            late(Bound::Plane, Plane::<f32>::default()),
            late(Bound::Tile, Plane::<f32>::default()),
            late(Bound::Offset, Offset::<f32>::default()),
            late(Bound::Rounded, Rational),
            // The float that the bound is not for, and the model that it is not for.
            variant::<f64>("offset", "", Bound::Offset, Offset::<f32>::default()),
            variant::<f32>("direct", "", Bound::Direct, EverySixteen::<f32>::default()),
            variant::<f32>("sixteen", "", Bound::EverySixteen, Affine::<f32>::default()),
        ];
        for variant in late {
            let share = worst(&variant, 1);
            assert!(share > 1.0, "{} {:?} {share}", variant.choice.name, variant.bound);
        }
    }
}
