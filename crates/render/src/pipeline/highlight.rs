//! Specular light: the highlight of Blinn and Phong, as the format MTL has it (`illum 2`).
//!
//! highlight = Ks x diffuse light x max(0, n . h)^Ns, with n and h of length 1 and h halfway between the
//! directions to the light and to the eye. The eye is far away, as in OpenGL without a local viewer: the
//! direction to it is that of the viewing axis everywhere, so that a highlight depends on the normal alone.
//!
//! A highlight is a colour of its own, rounded to 8 bits and added to that of the surface, up to 255. So
//! where it rounds to 0 the surface keeps its bits.

use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;

use super::shade::Light;
use super::target::{Colour, to_colour};

#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Specular {
    /// Its specular colour, each channel in [0, 1]; 0 of a material without highlights.
    pub colour: DVec3,
    /// The exponent, above 0: the larger, the smaller the highlight.
    pub shininess: f64,
}

/// The largest exponent; larger ones count as it.
const MOST_SHININESS: f64 = (1 << 20) as f64;

/// What is left of a channel that rounds to 0: [`to_colour`] rounds down what is below 1/2, and this is
/// below it by more than all roundings of an exponentiation with [`MOST_SHININESS`].
const BELOW_HALF: f64 = 0.5 - 1.0 / 512.0;

#[derive(Clone, Copy, Debug)]
pub struct Highlight {
    strength: DVec3,
    shininess: f64,
    /// Between light and eye, of length 1, or 0 where they are opposite.
    halfway: DVec3,
    /// Up to this cosine of n and h every channel rounds to 0.
    least: f64,
}

impl Highlight {
    /// That of a material; `towards_eye` has length 1.
    #[must_use]
    pub fn new(specular: &Specular, light: &Light, towards_eye: DVec3) -> Self {
        let strength = specular.colour * light.diffuse;
        let halfway = (light.towards + towards_eye).normalize_or_zero();
        let shininess = specular.shininess.clamp(0.0, MOST_SHININESS);
        // NaN is no highlight either.
        let shows = strength.max_element() * 255.0 > BELOW_HALF
            && shininess > 0.0
            && halfway != DVec3::ZERO;
        let least = if shows {
            // x^n < c below the n-th root of c. Root and power are each off by less than n 2^-50.
            libm::pow(BELOW_HALF / (255.0 * strength.max_element()), 1.0 / shininess)
        } else {
            f64::INFINITY
        };
        Self { strength, shininess, halfway, least }
    }

    /// Whether it rounds to 0 in every channel, wherever a normal points.
    #[must_use]
    pub fn is_dark(&self) -> bool {
        self.least == f64::INFINITY
    }

    /// The direction between light and eye, and the cosine up to which there is nothing: for who computes many
    /// cosines at once.
    #[must_use]
    pub fn cone(&self) -> (DVec3, f64) {
        (self.halfway, self.least)
    }

    /// The highlight on a normal of any length; of length 0, none.
    #[must_use]
    #[inline]
    pub fn at(&self, normal: DVec3) -> [u8; 3] {
        let along = normal.dot(self.halfway);
        let length = normal.length();
        // Without a division, as most fragments have no highlight.
        if along <= self.least * length || length == 0.0 { [0; 3] } else { self.of(along / length) }
    }

    /// The highlight where normal and halfway direction have this cosine.
    #[must_use]
    pub fn of(&self, cosine: f64) -> [u8; 3] {
        let [r, g, b, _] = to_colour(self.strength * libm::pow(cosine.max(0.0), self.shininess));
        [r, g, b]
    }

    /// Whether no normal between three rounds to a highlight.
    ///
    /// Let n be a mean of the three normals. n . h is at most its maximum at the corners, H. With any u of
    /// length 1, |n| >= n . u, which is at least its minimum at the corners, L. So n . h <= H <= t L <= t |n|
    /// where H <= t L, for t >= 0; and [`Self::at`] is 0 there with t = `least`. Here u is the direction of
    /// the sum. An engine returns a mean with an error of at most 2^-53 (15 D + 2 M) in each component
    /// (`comparison::tolerance` of the crate `verify`), and three such errors, those of H, L and of `at`
    /// are all below 2^-48 times the largest component; the margin is 2^-40 times the sum of all.
    #[must_use]
    pub fn is_dark_between(&self, normals: [DVec3; 3]) -> bool {
        let [a, b, c] = normals;
        let scale = a.abs().element_sum() + b.abs().element_sum() + c.abs().element_sum();
        let margin = scale * 0.5f64.powi(40);
        let towards = (a + b + c).normalize_or_zero();
        let [x, y, z] = normals.map_array(|normal| normal.dot(self.halfway));
        let most = x.max(y).max(z);
        let [x, y, z] = normals.map_array(|normal| normal.dot(towards));
        let length = x.min(y).min(z).max(0.0);
        self.is_dark() || most + margin * 2.0 <= self.least * length
    }
}

/// The colour of a surface with its highlight added; a channel does not pass 255.
#[must_use]
#[inline]
pub fn brightened([r, g, b, a]: Colour, [x, y, z]: [u8; 3]) -> Colour {
    [r.saturating_add(x), g.saturating_add(y), b.saturating_add(z), a]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    type Condition = fn(&Highlight, [DVec3; 3]) -> bool;

    fn highlight(strength: f64, shininess: f64) -> Highlight {
        let light = Light { towards: DVec3::Z, ambient: 0.25, diffuse: 1.0 };
        Highlight::new(&Specular { colour: DVec3::splat(strength), shininess }, &light, DVec3::Z)
    }

    #[test]
    fn a_highlight_is_brightest_halfway() {
        let light = Light { towards: DVec3::X, ambient: 0.0, diffuse: 0.5 };
        let specular = Specular { colour: DVec3::new(1.0, 0.5, 0.0), shininess: 2.0 };
        let highlight = Highlight::new(&specular, &light, DVec3::Z);
        // Of any length, (1, 0, 1) is halfway; 60 degrees off the cosine is 1/2, and its square 1/4.
        assert_eq!(highlight.at(DVec3::new(3.0, 0.0, 3.0)), [128, 64, 0]);
        assert_eq!(highlight.of(0.5), [32, 16, 0]);
        assert_eq!(highlight.at(DVec3::new(-3.0, 0.0, -3.0)), [0; 3]);
        assert_eq!(highlight.at(DVec3::ZERO), [0; 3]);
        assert_eq!(
            brightened([200, 200, 200, 255], highlight.at(DVec3::ONE)),
            [255, 243, 200, 255]
        );
    }

    /// The shortcut is what the formula gives, on both sides of where it ends.
    #[test]
    fn what_is_left_out_rounds_to_0() {
        let (mut zeros, mut others) = (0, 0);
        for strength in [0.001, 0.003, 0.1, 0.5, 1.0] {
            for shininess in [0.1, 1.0, 10.0, 96.078_431, 1000.0, 1e6, 1e9] {
                let highlight = highlight(strength, shininess);
                for i in 0..4000 {
                    // Dense where the end lies: from 1 downwards by the exponent.
                    let below = f64::from(i) / 4000.0 * 8.0 / shininess.max(1.0);
                    let cosine = 1.0 - below.min(1.0);
                    let normal = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
                    let formula = strength * libm::pow(cosine, shininess.min(MOST_SHININESS));
                    let byte = (formula * 255.0 + 0.5) as u8;
                    let shown = highlight.at(normal);
                    assert!(
                        shown[0].abs_diff(byte) <= u8::from(byte > 0),
                        "{strength} {shininess}"
                    );
                    zeros += u32::from(byte == 0);
                    others += u32::from(byte > 0);
                }
            }
        }
        assert!(zeros > 1000 && others > 1000);
    }

    /// How many of random triangles a condition holds for, how many have no highlight at normals between the
    /// corners, in the middle and at the rim, and for how many the condition is wrong.
    fn tried(condition: Condition) -> [u32; 3] {
        let mut rng = Rng::new("highlight", 1, 0);
        let mut counts = [0; 3];
        for _ in 0..4000 {
            let highlight = highlight(rng.unit(), 1.0 + 60.0 * rng.unit());
            let (spread, length) = (rng.unit(), 10.0 * rng.unit());
            let mut point = || DVec3::new(rng.signed(), rng.signed(), rng.signed());
            let centre = point().normalize_or_zero();
            let normals = [0; 3].map_array(|_| (centre + point() * spread) * length);
            let mut shows = false;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let [a, b, c] = normals;
                    shows |= highlight.at(a + (b - a) * i + (c - a) * j) != [0; 3];
                }
            }
            let holds = condition(&highlight, normals);
            for (count, is) in counts.iter_mut().zip([holds, !shows, holds && shows]) {
                *count += u32::from(is);
            }
        }
        counts
    }

    #[test]
    fn a_triangle_that_is_dark_has_no_highlight() {
        let [known, dark, wrong] = tried(Highlight::is_dark_between);
        assert_eq!(wrong, 0);
        assert!(known * 10 > dark * 7 && dark < 3800, "{known} of {dark} are known");
        // Conditions that look right, and are not sufficient: dark at the corners; the same, and as far from the
        // highlight as the corners in the mean; without regard to normals that are shorter in between.
        fn corners(highlight: &Highlight, normals: [DVec3; 3]) -> bool {
            normals.iter().all(|normal| highlight.at(*normal) == [0; 3])
        }
        let mean: Condition = |highlight, normals| {
            corners(highlight, normals) && highlight.at(normals.iter().sum()) == [0; 3]
        };
        let shorter: Condition = |highlight, normals| {
            let along = |normal: &DVec3| normal.dot(highlight.halfway);
            let most = normals.iter().map(along).fold(f64::MIN, f64::max);
            let length = normals.iter().map(|normal| normal.length()).fold(f64::MAX, f64::min);
            most <= highlight.least * length
        };
        let wrong = [corners, mean, shorter];
        for (number, condition) in wrong.into_iter().enumerate() {
            assert!(tried(condition)[2] > 0, "wrong condition {number} survives");
        }
    }
}
