//! The group of interpolation: how far values are from the exact ones, and what they take.
//!
//! Errors are taken against quotients of big integers; each choice with a derived bound is also held to that.

use super::bounds::{Bound, Place, largest};
use super::entry::{Entry, PreparedColumns, classes};
use super::sampled::{self, CoveredTriangle, Emit, dress};
use super::scene::Scene;
use super::tiles::Planes;
use super::{Choice, CostOptions, Details, Name, Run};
use crate::ladder::Real;
use crate::ladder::interpolation::{
    Accumulated, Affine, BookFormula, Direct, EverySixteen, Offset, Plane, Valued, Values,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::triangle::Span;
use rasterproof_verify::oracle::values::{Exact, ExactTriangle};

/// Half a step of 8 bits over [0, M]: nobody sees less.
pub const HALF_STEP: f64 = 1.0 / 512.0;

impl Values for Planes {
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        self.runs(triangle, spans, &mut |x_px, y_px, values| {
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

/// Triangles with the exact values at a sample of their pixels.
pub type Input = sampled::Input<Valued, Exact>;

/// In about how many pixels values are judged.
pub const SAMPLES: usize = 4000;

/// The triangles of a scene on the lattice, with w and a value at each corner, and about so many samples.
#[must_use]
pub fn input(scene: &Scene, samples: usize) -> Input {
    let drawn = dress(scene, |number, corners, inv_w| {
        let w = scene.w[number];
        // From the positions, so that the values need no generator: within [-1, 1], exactly f32.
        let made = |i: usize| f64::from(corners[i].x % 509 - 254 + (w[i] as i32) % 2) / 256.0;
        let given = scene.values.get(number).copied();
        let value = given.unwrap_or_else(|| [0, 1, 2].map_array(made));
        Valued { corners, inv_w, value }
    });
    Input::new(drawn, scene.bounds, samples, |triangle| {
        let exact = exact(triangle)?;
        Some(move |x_px, y_px| {
            let (_, [value]) = exact.at(x_px, y_px);
            Some(value)
        })
    })
}

fn entry<T: Real>(
    name: impl Into<Name>,
    about: impl Into<Name>,
    bound: Bound,
    body: impl Values + Copy + 'static,
) -> Entry<Input> {
    // 13 D + M is at most 27 M, far below the goal with either float.
    let is_certain = matches!(bound, Bound::Offset | Bound::Rounded);
    let promises: &[usize] = if is_certain { &[0] } else { &[] };
    sampled::entry(Choice::new(name, about, promises), body, move |input, choice| {
        judge(input, (bound, T::UNIT), choice)
    })
}

/// The ways that compute in one float, with the bound of each.
fn ways<T: Real>() -> Vec<Entry<Input>> {
    let float = T::NAME;
    let sixteen = format!("{float}, one division for 16 pixels, as Quake did");
    let book = format!("{float}, the book's formula with t accumulated");
    let added_up = format!("{float}, 1/w and v/w accumulated along the row");
    let direct = format!("{float}, 1/w and v/w at each pixel");
    let plane = format!("{float}, 1/w and v/w as planes");
    let offset = (format!("offset {float}"), "exact edge functions as weights");
    vec![
        entry::<T>("affine", format!("{float}, w ignored"), Bound::Affine, Affine::<T>::default()),
        entry::<T>("every 16 px", sixteen, Bound::EverySixteen, EverySixteen::<T>::default()),
        entry::<T>("book (8)", book, Bound::BookFormula, BookFormula::<T>::default()),
        entry::<T>("1/w added up", added_up, Bound::Accumulated, Accumulated::<T>::default()),
        entry::<T>("1/w direct", direct, Bound::Direct, Direct::<T>::default()),
        entry::<T>("plane", plane, Bound::Plane, Plane::<T>::default()),
        entry::<T>(offset.0, offset.1, Bound::Offset, Offset::<T>::default()),
    ]
}

/// The choices of the group.
#[must_use]
pub fn choices() -> Vec<Entry<Input>> {
    let planes = Planes::default();
    let mut choices = ways::<f32>();
    choices.insert(6, entry::<f32>("planes f32 x 16", planes.about(), Bound::Tile, planes));
    choices.extend(ways::<f64>().pop());
    choices.push(entry::<f64>("rational", "the oracle, rounded once", Bound::Rounded, Rational));
    choices
}

/// The span of a row; rows before it may be missing.
fn row_of(spans: &[Span], y_px: i32) -> Span {
    let guess = (y_px - spans[0].y_px).clamp(0, spans.len() as i32 - 1) as usize;
    let mut near = spans[..=guess].iter().rev();
    *near.find(|span| span.y_px == y_px).expect("values come from the rows given")
}

/// Errors of a choice at the samples, over M, in u M and over the bound; and the triangles in which it is visibly wrong.
fn judge(input: &Input, (bound, unit): (Bound, f64), choice: Emit<'_, Valued>) -> Run {
    let (mut worst, mut worst_bound) = (0f64, None::<f64>);
    let mut wrong: Vec<([u32; 2], u64)> = Vec::new();
    input.at_samples(choice, &mut |of_this, exact, [x_px, y_px], value| {
        let CoveredTriangle { triangle, spans, number } = of_this;
        let (error, most) = (exact.distance(value), largest(triangle.value));
        worst = worst.max(if most > 0.0 { error / most } else { error });
        let place = Place { triangle, spans, span: row_of(spans, y_px), x_px };
        if let Some(bound) = bound.at(&place, unit) {
            let share = if error == 0.0 { 0.0 } else { error / bound };
            worst_bound = Some(worst_bound.unwrap_or(0.0).max(share));
        }
        if error > HALF_STEP * most {
            let triangle = [*number as u32; 2];
            match wrong.last_mut() {
                Some((last, count)) if *last == triangle => *count += 1,
                _ => wrong.push((triangle, 1)),
            }
        }
    });
    let found = Details { wrong, ..Details::default() };
    Run { found, ..Run::of(vec![Some(worst), Some(worst / unit), worst_bound]) }
}

pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    let count = if options.quick { 500 } else { SAMPLES };
    classes(options, (512, [8_000, 60_000]), move |scene| Ok(input(scene, count).counted()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::scene::{Size, scenes};

    /// The worst share of its bound that a choice reaches on every class of scenes, all pixels asked.
    fn worst(choice: &Entry<Input>, seed: u64) -> f64 {
        scenes(seed, Size { side_px: 64, pixels: 1500 })
            .iter()
            .map(|scene| {
                let input = input(scene, usize::MAX);
                assert!(input.judged().part > 100, "{}", scene.name);
                choice.judge(&input).unwrap().errors[2].unwrap_or(0.0)
            })
            .fold(0.0, f64::max)
    }

    /// Every choice keeps its derived bound, in either float; and none of the bounds is idle.
    #[test]
    fn bounds_are_kept() {
        for (number, choice) in
            ways::<f32>().into_iter().chain(ways::<f64>()).chain(choices()).enumerate()
        {
            let shares: Vec<f64> = (1..=3).map(|seed| worst(&choice, seed)).collect();
            let name = (number, choice.choice.name);
            assert!(shares.iter().all(|&share| share <= 1.0), "{name:?} {shares:?}");
            assert!(shares.iter().any(|&share| share > 0.05), "{name:?} {shares:?}");
        }
    }

    /// Each bound is exceeded by the choice with a fault planted: values of the next pixel, off by less
    /// than anybody sees in most scenes.
    #[derive(Clone, Copy)]
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

    fn late(bound: Bound, choice: impl Values + Copy + 'static) -> Entry<Input> {
        entry::<f32>("late", "", bound, Late(choice))
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
            entry::<f64>("offset", "", Bound::Offset, Offset::<f32>::default()),
            entry::<f32>("direct", "", Bound::Direct, EverySixteen::<f32>::default()),
            entry::<f32>("sixteen", "", Bound::EverySixteen, Affine::<f32>::default()),
        ];
        for (number, choice) in late.iter().enumerate() {
            let share = worst(choice, 1);
            assert!(share > 1.0, "{number}, {}: {share}", choice.choice.name);
        }
    }
}
