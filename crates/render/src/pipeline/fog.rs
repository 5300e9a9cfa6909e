//! Fog: what is far away takes the colour of the fog.
//!
//! colour = c + (g - c) f, channel by channel in whole steps of 255, with the fog's colour g and a share f that
//! grows with the distance z along the viewing axis: (z - start) / (end - start), not beyond 0 and 1, or
//! 1 - e^(-density z). So does OpenGL's fixed pipeline. z is computed from the depth in the window, which is
//! linear there, so that fog needs no attribute. Nothing is drawn where there is background, and it gets no fog.

use glam::{DMat4, DVec3};

use super::target::{Colour, to_colour};

/// The share of fog as a function of the distance from the eye.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub enum Growth {
    /// None up to a distance, nothing else from a larger one on.
    Linear { start: f64, end: f64 },
    /// By this share of what is still seen, for each unit of distance.
    Exponential { density: f64 },
}

/// The fog of a scene, in the world: distances are those of the scene.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Fog {
    pub colour: [u8; 3],
    pub growth: Growth,
}

/// How much fog the fragments of a piece have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Share {
    /// So little that no colour changes.
    #[default]
    None,
    /// Each fragment has a share of its own.
    Mixed,
    /// So much that nothing else is seen.
    Whole,
}

/// Fog as a function of the depth in the window, by a projection.
#[derive(Clone, Copy, Debug)]
pub struct Veil {
    colour: [u8; 3],
    growth: Growth,
    /// z and w of clip space: each a multiple of the distance, and a constant.
    z: [f64; 2],
    w: [f64; 2],
}

/// A share below this moves no channel to another step: 255/512 and the rounding of [`to_colour`] are less than
/// a step.
const LEAST: f64 = 1.0 / 512.0;

impl Veil {
    /// `projection` makes z and w from the distance alone, as all of [`super::transform`] do.
    #[must_use]
    pub fn new(fog: Option<&Fog>, projection: &DMat4) -> Self {
        let none = Fog { colour: [0; 3], growth: Growth::Exponential { density: 0.0 } };
        let Fog { colour, growth } = *fog.unwrap_or(&none);
        let [z, w] = [
            [projection.z_axis.z, projection.w_axis.z],
            [projection.z_axis.w, projection.w_axis.w],
        ];
        Self { colour, growth, z, w }
    }

    /// The colour where nothing else is seen.
    #[must_use]
    pub fn colour(&self) -> Colour {
        let [r, g, b] = self.colour;
        [r, g, b, u8::MAX]
    }

    /// The distance along the viewing axis of a depth in the window.
    #[must_use]
    pub fn distance(&self, depth: f64) -> f64 {
        let ndc = 2.0 * depth - 1.0;
        let distance = (self.z[1] - ndc * self.w[1]) / (ndc * self.w[0] - self.z[0]);
        // Beyond the horizon of a perspective.
        if self.w[0] != 0.0 && distance < 0.0 { f64::INFINITY } else { distance }
    }

    /// The w of clip space that a depth in the window stands for.
    #[must_use]
    pub fn w(&self, depth: f64) -> f64 {
        // Where w is constant no distance is needed, which may be beyond all numbers.
        if self.w[0] == 0.0 { self.w[1] } else { self.w[0] * self.distance(depth) + self.w[1] }
    }

    /// From 0, no fog, to 1, nothing else.
    #[expect(clippy::manual_clamp, reason = "the maximum turns NaN into 0, a clamp keeps it")]
    fn share(&self, distance: f64) -> f64 {
        let share = match self.growth {
            Growth::Linear { start, end } => (distance - start) / (end - start),
            Growth::Exponential { density } => 1.0 - libm::exp(-density * distance),
        };
        share.max(0.0).min(1.0)
    }

    /// A colour behind the fog up to a distance.
    #[must_use]
    pub fn before(&self, colour: Colour, distance: f64) -> Colour {
        let share = self.share(distance);
        let channel = |i: usize| {
            let (c, g) = (f64::from(colour[i]), f64::from(self.colour[i]));
            (c + (g - c) * share) / 255.0
        };
        to_colour(DVec3::new(channel(0), channel(1), channel(2)))
    }

    /// How much fog there is between the depths of three corners.
    ///
    /// A depth in the triangle lies between those of the corners, and an engine's is off by at most
    /// 2^-53 (12 D + 2 M) with D, M <= 1 (`comparison::tolerance` of the crate `verify`), far less than the
    /// margin of 2^-44. Distance and share grow with the depth, or fall with it, and the margin is also more
    /// than what rounding may change that by. So every share lies between those of the two ends. Below
    /// `LEAST` no channel moves; above 1 - LEAST each one becomes the fog's.
    #[must_use]
    pub fn between(&self, depths: [f64; 3]) -> Share {
        let [a, b, c] = depths;
        let margin = 0.5f64.powi(44);
        let ends = [a.min(b).min(c) - margin, a.max(b).max(c) + margin];
        let share = |depth: f64| self.share(self.distance(depth));
        let one = share(ends[0]);
        if LEAST < one && one < 1.0 - LEAST {
            return Share::Mixed;
        }
        let other = share(ends[1]);
        if one.max(other) <= LEAST {
            Share::None
        } else if one.min(other) >= 1.0 - LEAST {
            Share::Whole
        } else {
            Share::Mixed
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::transform::frustum;
    use rasterproof_core::arrays::MapArray as _;
    use rasterproof_core::random::Rng;

    fn veil(growth: Growth) -> Veil {
        let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 20.0).unwrap();
        Veil::new(Some(&Fog { colour: [250, 128, 0], growth }), &projection)
    }

    /// The depth of a distance, by the definition of a projection.
    fn depth(distance: f64) -> f64 {
        let clip = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 20.0).unwrap()
            * glam::DVec4::new(0.0, 0.0, distance, 1.0);
        (clip.z / clip.w + 1.0) / 2.0
    }

    #[test]
    fn fog_grows_with_distance() {
        let linear = veil(Growth::Linear { start: 2.0, end: 10.0 });
        for distance in [1.0, 1.5, 3.0, 9.0, 19.9] {
            assert!((linear.distance(depth(distance)) - distance).abs() < 1e-12 * distance.powi(2));
        }
        let black = [0, 0, 0, 255];
        for (distance, expected) in
            [(1.0, 0), (2.0, 0), (4.0, 63), (6.0, 125), (10.0, 250), (15.0, 250)]
        {
            let colour = linear.before(black, linear.distance(depth(distance)));
            assert_eq!([colour[0], colour[2]], [expected, 0], "at {distance}");
        }
        let exponential = veil(Growth::Exponential { density: 0.25 });
        // Half is left where e^(-z/4) = 1/2.
        assert_eq!(exponential.before(black, 4.0 * std::f64::consts::LN_2), [125, 64, 0, 255]);
        let none = Veil::new(None, &frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 20.0).unwrap());
        assert_eq!(none.before([1, 200, 255, 255], 1e9), [1, 200, 255, 255]);
        assert_eq!(none.between([0.0, 0.5, 1.0]), Share::None);
    }

    fn random_veil(rng: &mut Rng, index: u32) -> Veil {
        let start = 1.0 + 12.0 * rng.unit();
        veil(match index % 2 {
            0 => Growth::Linear { start, end: start + 6.0 * rng.unit() },
            _ => Growth::Exponential { density: rng.unit().powi(4) },
        })
    }

    type Condition = fn(&Veil, [f64; 3]) -> Share;

    /// How many of random triangles have no fog or nothing else by a condition, and for how many of these a
    /// colour says otherwise.
    fn tried(condition: Condition) -> [u32; 2] {
        let mut rng = Rng::new("fog", 1, 0);
        let mut counts = [0; 2];
        for index in 0..4000 {
            let veil = random_veil(&mut rng, index);
            let (from, spread) = (1.0 + 18.0 * rng.unit(), 1.0 + rng.unit());
            let depths =
                [0; 3].map_array(|_| depth((from * (1.0 + (spread - 1.0) * rng.unit())).min(20.0)));
            let share = condition(&veil, depths);
            let mut wrong = false;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let [a, b, c] = depths;
                    let before = [[0, 255, 77, 255], [255, 0, 255, 255]];
                    let distance = veil.distance(a + (b - a) * i + (c - a) * j);
                    let colours = before.map_array(|colour| veil.before(colour, distance));
                    wrong |= match share {
                        Share::None => colours != before,
                        Share::Mixed => false,
                        Share::Whole => colours != [veil.colour(); 2],
                    };
                }
            }
            counts[0] += u32::from(share != Share::Mixed);
            counts[1] += u32::from(wrong);
        }
        counts
    }

    #[test]
    fn a_triangle_without_fog_keeps_its_colours() {
        let [known, wrong] = tried(Veil::between);
        assert!(known > 1000 && wrong == 0, "{known}, {wrong}");
        // Wrong ones: by the mean of the corners, by the first one, and without the step of a channel.
        let mean: Condition = |veil, [a, b, c]| veil.between([(a + b + c) / 3.0; 3]);
        let first: Condition = |veil, [a, _, _]| veil.between([a; 3]);
        let coarse: Condition = |veil, depths| {
            let shares = depths.map_array(|depth| veil.share(veil.distance(depth)));
            let is_faint = shares.iter().all(|share| *share < 2.0 * LEAST);
            if is_faint { Share::None } else { veil.between(depths) }
        };
        for (number, condition) in [mean, first, coarse].into_iter().enumerate() {
            assert!(tried(condition)[1] > 0, "wrong condition {number} survives");
        }
    }
}
