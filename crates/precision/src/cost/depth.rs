//! The group of depth: how far apart two surfaces must be to be told apart, and how many pixels show
//! the wrong one of two nearly coplanar layers.
//!
//! The columns are distances from the eye. The layers lie a ten-thousandth of the distance apart.

use super::entry::{Entry, PreparedColumns, and_no_class, tiled};
use super::{Choice, Column, CostOptions};
use crate::ladder::Real;
use crate::ladder::depth::{FAR, Fixed24, Format, Forward, NEAR, Reversed, stored};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::random::Rng;

/// Distances from the eye; the last is that of the classic table.
const DISTANCES: [(&str, f64); 5] =
    [("z 1", 1.0), ("z 10", 10.0), ("z 100", 100.0), ("z 500", 500.0), ("z 990", 990.0)];
/// How far apart the layers are, over the distance.
const APART: f64 = 1e-4;
const SIDE_PX: usize = 64;
const TILE: usize = SIDE_PX * SIDE_PX;

/// Two layers over a tile of pixels: the distances from the eye at the corners (0, 0), (SIDE, 0), (0, SIDE) of the front one.
type Layers = [f64; 3];

/// So many pairs of layers about a distance from the eye.
fn layers(seed: u64, name: &str, z: f64, count: usize) -> Vec<Layers> {
    let mut rng = Rng::new(name, seed, 2);
    // Slanted by up to a percent of the distance, within the planes.
    let near = |rng: &mut Rng| (z * (1.0 + 0.01 * rng.signed())).clamp(NEAR, FAR / (1.0 + APART));
    (0..count).map(|_| [(); 3].map_array(|()| near(&mut rng))).collect()
}

/// Depth over a tile as a plane, at pixel centres, in the float of the format.
struct DepthPlane<T> {
    start: T,
    per_x: T,
    per_y: T,
}

impl<T: Real> DepthPlane<T> {
    #[inline]
    fn new<F: Format<Float = T>>(z: [f64; 3]) -> Self {
        let [a, b, c] = z.map_array(|z| T::of(F::depth(z)));
        let side = T::of(1.0 / SIDE_PX as f64);
        let (per_x, per_y) = ((b - a) * side, (c - a) * side);
        Self { start: a + per_x * T::HALF + per_y * T::HALF, per_x, per_y }
    }

    #[inline]
    fn at(&self, x: usize, y: usize) -> T {
        self.start + self.per_x * T::of(x as f64) + self.per_y * T::of(y as f64)
    }
}

/// Draws all back layers, then all front ones, a tile beside the other; 2 marks the pixels that a
/// front one got.
#[inline]
fn draw<F: Format>(layers: &[Layers], buffer: &mut [F::Entry], colours: &mut [u8]) {
    for (front, (held, colours)) in
        layers.iter().zip(buffer.chunks_exact_mut(TILE).zip(colours.chunks_exact_mut(TILE)))
    {
        let back = DepthPlane::<F::Float>::new::<F>(front.map_array(|z| z * (1.0 + APART)));
        for (i, (held, colour)) in held.iter_mut().zip(colours).enumerate() {
            *held = F::store(back.at(i % SIDE_PX, i / SIDE_PX));
            *colour = 1;
        }
    }
    for (front, (held, colours)) in
        layers.iter().zip(buffer.chunks_exact_mut(TILE).zip(colours.chunks_exact_mut(TILE)))
    {
        let front = DepthPlane::<F::Float>::new::<F>(*front);
        for (i, (held, colour)) in held.iter_mut().zip(colours).enumerate() {
            let depth = F::store(front.at(i % SIDE_PX, i / SIDE_PX));
            if F::hides(depth, *held) {
                (*held, *colour) = (depth, 2);
            }
        }
    }
}

/// The least distance behind `z` that is stored as another depth, by bisection; at most FAR - z.
fn gap<F: Format>(z: f64) -> f64 {
    let at_z = stored::<F>(z);
    let differs = |d: f64| stored::<F>(z + d) != at_z;
    let (mut low, mut high) = (0.0, FAR - z);
    while low < high {
        let middle = low + (high - low) / 2.0;
        // The two are neighbours.
        if middle <= low || middle >= high {
            break;
        }
        if differs(middle) { high = middle } else { low = middle }
    }
    high
}

/// The largest gap near a distance: a gap depends on where in a step of the format it begins.
fn step<F: Format>(z: f64) -> f64 {
    // Whole numbers over a number that no power of two divides hit all phases of a step.
    (0..1000).map(|i| gap::<F>(z * (1.0 - 0.003 * f64::from(i) / 1013.0))).fold(0.0, f64::max)
}

/// Layers at a distance from the eye.
pub(super) struct Input {
    z: f64,
    layers: Vec<Layers>,
}

/// A format of depths, with what it gets wrong: pixels in a million, the gap here, and the largest one near here.
fn entry<F: Format + 'static>(name: &'static str, about: &'static str) -> Entry<Input> {
    tiled(
        Choice::new(name, about, &[]),
        |input: &Input| vec![stored::<F>(FAR); input.layers.len() * TILE],
        |input, buffer, colours| draw::<F>(&input.layers, buffer, colours),
        |input, colours| {
            let wrong = colours.iter().filter(|&&colour| colour != 2).count();
            let per_million = wrong as f64 * 1e6 / colours.len() as f64;
            vec![Some(per_million), Some(gap::<F>(input.z)), Some(step::<F>(input.z))]
        },
    )
}

pub(super) fn choices() -> Vec<Entry<Input>> {
    vec![
        entry::<Fixed24>("24-bit", "whole numbers, 0 at the near plane"),
        entry::<Forward<f32>>("f32", "-1 at the near plane"),
        entry::<Reversed<f32>>("f32 reversed", "1 at the near plane"),
        entry::<Forward<f64>>("f64", "-1 at the near plane"),
    ]
}

pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    // A million pixels, so that the size of a depth counts as well.
    let tiles = if options.quick { 16 } else { 256 };
    let column = move |(name, z): (&'static str, f64)| {
        let about = format!("{z} from the eye, planes at {NEAR} and {FAR}");
        let layers = layers(options.seed, name, z, tiles);
        (Column::new(name, about, 2 * tiles as u64, 2 * (tiles * TILE) as u64), Input { z, layers })
    };
    let why = "depth depends on the distance from the eye, not on the shape";
    and_no_class(options, DISTANCES.into_iter().map(column), why)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of the design, measured: n = 0.1, f = 1000, z = 990.
    #[test]
    fn gaps_as_in_the_table() {
        let near = |measured: f64, known: f64| {
            assert!((measured / known - 1.0).abs() < 0.05, "{measured} {known}");
        };
        near(gap::<Fixed24>(990.0), 0.26);
        near(gap::<Forward<f32>>(990.0), 0.116);
        near(gap::<Reversed<f32>>(990.0), 5.9e-7);
        near(gap::<Forward<f64>>(990.0), 5.3e-10);
    }

    /// A step of depth d is d z^2 (f - n) / (f n) of distance: what theory says of each format. Floats
    /// in [-1, 1] have the steps of 2^-24 near 1 and twice the slope.
    #[test]
    fn steps_as_theory_says() {
        let at = |ulp: f64, z: f64| ulp * z * z * (FAR - NEAR) / (FAR * NEAR);
        for (measured, theory) in [
            (step::<Fixed24>(500.0), at(1.0 / f64::from((1 << 24) - 1), 500.0)),
            (step::<Forward<f32>>(500.0), at(f64::from(f32::EPSILON) / 4.0, 500.0)),
        ] {
            assert!((0.97..1.01).contains(&(measured / theory)), "{measured} {theory}");
        }
    }
}
