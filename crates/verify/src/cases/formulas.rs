//! Families of numbers for the formulas of the pipeline. Numbers have few bits, so that a request reads easily.

use super::{Case, Family, Shape, family};
use crate::oracle::formula::Formula;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;

/// A family for each formula, in their order.
pub const FAMILIES: &[Family] = &[
    family("formula-project", "points before a film, near and far", |rng| {
        drawn(Formula::Project, rng, project)
    }),
    family("formula-window", "points in and around a view volume", |rng| {
        drawn(Formula::Window, rng, window)
    }),
    family(
        "formula-winding",
        "triangles of both windings, thin and small ones, and some without area",
        |rng| drawn(Formula::Winding, rng, winding),
    ),
    family("formula-turn", "turns about each axis, through any centre", |rng| {
        drawn(Formula::Turn, rng, turn)
    }),
    family("formula-normal", "normals under stretchings, shears and turns", |rng| {
        drawn(Formula::Normal, rng, normal)
    }),
    family("formula-light", "normals of any length, towards the light and away from it", |rng| {
        drawn(Formula::Light, rng, light)
    }),
    family("formula-texel", "places in a row of texels, between two, and beyond its ends", |rng| {
        drawn(Formula::Texel, rng, texel)
    }),
    family("formula-level", "textured triangles in perspective", |rng| {
        drawn(Formula::Level, rng, level)
    }),
];

/// A case of a formula; its window is the least that there is, and has no part in it.
#[must_use]
pub fn case(formula: Formula, numbers: Vec<f64>) -> Case {
    Case { window: PixelRect::window(1, 1), shape: Shape::Numbers { formula, numbers } }
}

/// The first numbers drawn that can be asked.
fn drawn(formula: Formula, rng: &mut Rng, draw: fn(&mut Rng) -> Vec<f64>) -> Case {
    loop {
        let numbers = draw(rng);
        if formula.of(&numbers).is_some() {
            return case(formula, numbers);
        }
    }
}

/// A multiple of 1/4 between two whole numbers.
fn quarters(rng: &mut Rng, low: i64, high: i64) -> f64 {
    rng.int(4 * low, 4 * high) as f64 / 4.0
}

fn project(rng: &mut Rng) -> Vec<f64> {
    let film = quarters(rng, 1, 4);
    vec![film, quarters(rng, -8, 8), quarters(rng, -8, 8), quarters(rng, 1, 20)]
}

fn window(rng: &mut Rng) -> Vec<f64> {
    let near = quarters(rng, 1, 3);
    let mut numbers = vec![rng.int(1, 40) as f64, rng.int(1, 40) as f64, near];
    numbers.extend([near + quarters(rng, 1, 20), quarters(rng, -8, 8), quarters(rng, -8, 8)]);
    // Some lie before the near plane or behind the far one: the formula goes on there.
    numbers.push(quarters(rng, 1, 16));
    numbers
}

fn winding(rng: &mut Rng) -> Vec<f64> {
    match rng.int(0, 3) {
        0 => (0..6).map(|_| quarters(rng, 0, 16)).collect(),
        // Small ones, of some subpixels: what has an area has a sign, however little it is.
        1 => {
            let middle = rng.int(0, 16) as f64;
            (0..6).map(|_| middle + rng.int(-100, 100) as f64 / 4096.0).collect()
        }
        // Thin triangles, in parts of a subpixel: snapping may turn them round.
        _ => {
            let [x, y] = [(); 2].map(|()| rng.int(0, 16) as f64);
            let mut corners = vec![x, y];
            let slope = rng.int(-16, 16);
            for along in [rng.int(1, 4), rng.int(5, 8)] {
                let fine = slope * along + rng.int(-12, 12);
                corners.extend([x + along as f64, y + fine as f64 / 4096.0]);
            }
            // Half of them the other way.
            if rng.chance(2) {
                corners.rotate_left(2);
                corners.swap(0, 2);
                corners.swap(1, 3);
            }
            corners
        }
    }
}

/// Cosines and sines that are simple.
const ANGLES: [[f64; 2]; 8] = [
    [0.6, 0.8],
    [0.8, 0.6],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [-0.6, 0.8],
    [0.28, -0.96],
    [1.0, 0.0],
];

fn turn(rng: &mut Rng) -> Vec<f64> {
    let axis = rng.int(0, 2) as f64;
    let [cos, sin] = ANGLES[rng.int(0, 7) as usize];
    let mut numbers = vec![axis, cos, sin];
    numbers.extend((0..6).map(|_| rng.int(-8, 8) as f64));
    numbers
}

fn normal(rng: &mut Rng) -> Vec<f64> {
    let mut numbers = vec![0.0; 9];
    // A stretching, often with a shear.
    for axis in 0..3 {
        numbers[4 * axis] = [0.25, 0.5, 1.0, 2.0, 4.0][rng.int(0, 4) as usize];
    }
    if rng.chance(2) {
        let place = [1, 2, 3, 5, 6, 7][rng.int(0, 5) as usize];
        numbers[place] = rng.int(-2, 2) as f64;
    }
    numbers.extend((0..3).map(|_| rng.int(-3, 3) as f64));
    numbers
}

/// Directions of length 1 in decimals.
const DIRECTIONS: [[f64; 3]; 4] =
    [[0.0, 0.0, 1.0], [0.6, 0.8, 0.0], [0.48, 0.6, 0.64], [0.36, 0.48, 0.8]];

fn light(rng: &mut Rng) -> Vec<f64> {
    let mut towards = DIRECTIONS[rng.int(0, 3) as usize];
    towards.rotate_left(rng.int(0, 2) as usize);
    let mut numbers: Vec<f64> = (0..3).map(|_| rng.int(-4, 4) as f64 / 2.0).collect();
    numbers.extend(towards.map(|part| if rng.chance(2) { -part } else { part }));
    let ambient = rng.int(0, 4);
    numbers.extend([ambient as f64 / 10.0, (10 - ambient) as f64 / 10.0]);
    numbers
}

fn texel(rng: &mut Rng) -> Vec<f64> {
    let count = 1 << rng.int(0, 3);
    let sub = rng.int(-256 * count, 512 * count);
    // On borders of texels and in their middles, too.
    let sub = if rng.chance(3) { sub / 128 * 128 } else { sub };
    let mut numbers = vec![sub as f64 / 256.0 / count as f64];
    numbers.extend((0..count).map(|_| 10.0 * rng.int(0, 25) as f64));
    numbers
}

fn level(rng: &mut Rng) -> Vec<f64> {
    let mut numbers = vec![(1 << rng.int(2, 9)) as f64, (1 << rng.int(2, 9)) as f64];
    let (mut x, mut y) = (0.0, 0.0);
    for _ in 0..3 {
        let place = [rng.int(0, 32) as f64, rng.int(0, 32) as f64];
        (x, y) = (x + place[0], y + place[1]);
        let uv = [rng.int(0, 8) as f64 / 8.0, rng.int(0, 8) as f64 / 8.0];
        numbers.extend([place[0], place[1], rng.int(1, 8) as f64, uv[0], uv[1]]);
    }
    // A centre of a pixel around the middle of the triangle.
    numbers.extend([(x / 3.0).floor() + 0.5, (y / 3.0).floor() + 0.5]);
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a winding all three, and often another one than without snapping; of light also what lies in the dark.
    #[test]
    fn formulas_are_met_in_every_way() {
        let all = |family: usize| {
            (0..400).filter_map(move |index| match FAMILIES[family].case(1, index).shape {
                Shape::Numbers { formula, numbers } => {
                    Some((formula.of(&numbers)?[0].exact.to_f64(), numbers))
                }
                _ => None,
            })
        };
        let mut windings = [0; 3];
        let mut turned = 0;
        for (is, numbers) in all(2) {
            windings[(is + 1.0) as usize] += 1;
            let [ax, ay, bx, by, cx, cy] = numbers[..] else { panic!("{numbers:?}") };
            let free = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
            turned += usize::from(free * is <= 0.0 && (free, is) != (0.0, 0.0));
        }
        assert!(windings.iter().all(|n| *n > 20) && turned > 20, "{windings:?} {turned}");
        let dark = all(5).filter(|(is, numbers)| *is == numbers[6]).count();
        assert!((100..300).contains(&dark), "{dark}");
        let levels: Vec<f64> = all(7).map(|(is, _)| is).collect();
        assert!(levels.iter().any(|level| *level < 0.0) && levels.iter().any(|level| *level > 4.0));
    }
}
