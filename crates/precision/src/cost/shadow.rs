//! The group of shadows: how near to a surface another one may lie and still keep the light from it, and how often a surface
//! keeps it from itself.
//!
//! The columns are distances of two parallel surfaces, in parts of the depth that the map spans. In most of them they face the
//! light. In the others they slope, and there the bias is larger than a step of any format.

use super::entry::{Entry, PreparedColumns, and_no_class, tiled};
use super::{Choice, Column, CostOptions};
use crate::ladder::shadow::{DepthPlane, Fixed16, Fixed24, Fixed32, Floats, Format, Unbiased};
use rasterproof_core::random::Rng;

/// A name, how far apart the surfaces are, as the exponent of 1/2, and the largest slope for a texel of a thousand.
type Class = (&'static str, i32, f64);

/// The tangent of an angle of 10 degrees.
const SLOPE: f64 = 0.176;

const CLASSES: [Class; 8] = [
    ("2^-12", 12, 0.0),
    ("2^-17", 17, 0.0),
    ("2^-20", 20, 0.0),
    ("2^-25", 25, 0.0),
    ("2^-28", 28, 0.0),
    ("2^-33", 33, 0.0),
    ("10d 2^-8", 8, SLOPE),
    ("10d 2^-12", 12, SLOPE),
];

/// Texels along a side of a tile. The left half of a tile has a second surface before it.
const SIDE: usize = 64;
const TILE: usize = SIDE * SIDE;
const MAP: f64 = 1024.0;
/// The 3 x 3 texels around its place that a fragment reads.
const TAPS: u8 = 9;

pub(super) struct Tile {
    receiver: DepthPlane,
    /// How much nearer to the light the other surface is.
    apart: f64,
    /// Where in each texel its fragment lies.
    place: [f64; 2],
}

/// So many tiles of a class, each with a depth, a slope and a place of its own.
fn tiles(seed: u64, &(name, apart, slope): &Class, count: usize) -> Vec<Tile> {
    let mut rng = Rng::new(name, seed, 4);
    let mut tile = || {
        let slope = [(); 2].map(|()| rng.signed() * slope / MAP);
        let start = 0.25 + 0.5 * rng.unit();
        let place = [(); 2].map(|()| rng.unit());
        Tile { receiver: DepthPlane { start, slope }, apart: 0.5f64.powi(apart), place }
    };
    (0..count).map(|_| tile()).collect()
}

/// Draws the map and reads it: of each place that lies two texels or more from the border of a half, how many of [`TAPS`]
/// texels let the light pass.
#[inline]
fn draw<F: Format>(tiles: &[Tile], map: &mut [F::Texel], lit: &mut [u8]) {
    for (tile, map) in tiles.iter().zip(map.chunks_exact_mut(TILE)) {
        for (y, row) in map.chunks_exact_mut(SIDE).enumerate() {
            for (x, held) in row.iter_mut().enumerate() {
                let depth = tile.receiver.at(x as f64 + 0.5, y as f64 + 0.5);
                let before = if x < SIDE / 2 { tile.apart } else { 0.0 };
                *held = F::store(depth - before);
            }
        }
    }
    let chunks = map.chunks_exact(TILE).zip(lit.chunks_exact_mut(TILE));
    for (tile, (map, lit)) in tiles.iter().zip(chunks) {
        let bias = if F::BIASED { tile.receiver.bias() } else { 0.0 };
        let [right, down] = tile.place;
        for y in 1..SIDE - 1 {
            for x in 1..SIDE - 1 {
                let depth = tile.receiver.at(x as f64 + right, y as f64 + down);
                let key = F::store(depth - bias);
                let row = |y: usize| {
                    let texels = map[y * SIDE + x - 1..].iter().take(3);
                    texels.map(|held| u8::from(key <= *held)).sum::<u8>()
                };
                lit[y * SIDE + x] = row(y - 1) + row(y) + row(y + 1);
            }
        }
    }
}

/// Of places that are in the shadow and in the light as a whole, how many are wrong in a million.
fn errors(lit: &[u8]) -> Vec<Option<f64>> {
    let (mut counts, mut wrong) = ([0u64; 2], [0u64; 2]);
    for tile in lit.chunks_exact(TILE) {
        for (y, row) in tile.chunks_exact(SIDE).enumerate() {
            for (x, lit) in row.iter().enumerate() {
                let is_inside = |at: usize, end: usize| (1..end - 1).contains(&at);
                let half = usize::from(x >= SIDE / 2);
                if is_inside(y, SIDE) && is_inside(x % (SIDE / 2), SIDE / 2) {
                    counts[half] += 1;
                    wrong[half] += u64::from(*lit != [0, TAPS][half]);
                }
            }
        }
    }
    let share = |half: usize| Some(wrong[half] as f64 * 1e6 / counts[half] as f64);
    vec![share(0), share(1)]
}

/// A format of the depths in a map.
fn entry<F: Format + 'static>(name: &'static str, about: &'static str) -> Entry<Vec<Tile>> {
    tiled(
        Choice::new(name, about, &[]),
        |tiles: &Vec<Tile>| vec![F::store(1.0); tiles.len() * TILE],
        |tiles, map, lit| draw::<F>(tiles, map, lit),
        |_, lit| errors(lit),
    )
}

pub(super) fn choices() -> Vec<Entry<Vec<Tile>>> {
    vec![
        entry::<Unbiased>("24-bit, no bias", "depths are compared as they are"),
        entry::<Fixed16>("16-bit", "whole numbers"),
        entry::<Fixed24>("24-bit", "whole numbers"),
        entry::<Fixed32>("32-bit", "whole numbers, as the renderer here"),
        entry::<Floats<f32>>("f32", "a float"),
        entry::<Floats<f64>>("f64", "a double"),
    ]
}

pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Vec<Tile>> {
    // A map of 1024 x 1024 texels, so that the size of a depth counts as well.
    let count = if options.quick { 16 } else { 256 };
    let column = move |class: &Class| {
        let (name, apart, slope) = class;
        let slope = if *slope == 0.0 { "facing the light" } else { "sloping by up to 10 degrees" };
        let about = format!("surfaces {slope}, 2^-{apart} of the map's depth apart");
        let column = Column::new(name, about, count as u64, (count * TILE) as u64);
        (column, tiles(options.seed, class, count))
    };
    let why = "shadows depend on the depths of surfaces, not on their shapes";
    and_no_class(options, CLASSES.iter().map(column), why)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors_of<F: Format + Default + 'static>(name: &str) -> [f64; 2] {
        let class = CLASSES.iter().find(|class| class.0 == name).unwrap();
        let tiles = tiles(3, class, 64);
        let errors = entry::<F>("", "").judge(&tiles).unwrap().errors;
        [errors[0].unwrap(), errors[1].unwrap()]
    }

    /// Two depths that are half a step apart are stored as one in half of all places in the range.
    #[test]
    fn half_a_step_is_missed_half_of_the_time() {
        for missed in [
            errors_of::<Fixed16>("2^-17")[0],
            errors_of::<Fixed24>("2^-25")[0],
            errors_of::<Fixed32>("2^-33")[0],
        ] {
            // 64 tiles: five standard deviations of a coin that is thrown 64 times.
            assert!((missed - 5e5).abs() < 5.0 * 1e6 / 16.0, "{missed}");
            assert!(missed > 0.0 && missed < 1e6);
        }
    }

    /// A surface keeps no light from itself by the bias, in any format; without it a sloping one does.
    #[test]
    fn the_bias_is_enough_and_needed() {
        for name in ["2^-12", "10d 2^-8"] {
            assert_eq!(errors_of::<Fixed16>(name)[1], 0.0);
            assert_eq!(errors_of::<Fixed24>(name)[1], 0.0);
            assert_eq!(errors_of::<Fixed32>(name)[1], 0.0);
            assert_eq!(errors_of::<Floats<f32>>(name)[1], 0.0);
            assert_eq!(errors_of::<Floats<f64>>(name)[1], 0.0);
        }
        assert!(errors_of::<Unbiased>("10d 2^-8")[1] > 9e5);
    }
}
