//! Surfaces as glTF 2.0 describes them: metal and roughness, emission, occlusion and normal maps, in linear light.
//!
//! With n, l, v the directions of the normal, to the light and to the eye, h halfway between l and v, all of length 1, the base
//! colour b, metal m and a the square of the roughness, appendix B of the specification states
//!
//! - F = f0 + (f90 - f0) (1 - v.h)^5 with f0 = r (1 - m) + b m and f90 = s (1 - m) + m (Schlick), where r is 0.04 and s is 1 unless
//!   `KHR_materials_ior` and `KHR_materials_specular` say what is reflected of what is no metal,
//! - D = a^2 / (pi ((n.h)^2 (a^2 - 1) + 1)^2) (Trowbridge and Reitz, GGX),
//! - V = 1 / (2 (n.l sqrt((n.v)^2 (1 - a^2) + a^2) + n.v sqrt((n.l)^2 (1 - a^2) + a^2))) (Smith, height-correlated),
//! - what is reflected = ((1 - F) b (1 - m) / pi + F V D) n.l for each unit of light.
//!
//! The light of a scene is pi times its `diffuse`, so that a white matt surface that faces it has the colour that it has
//! without all this; in a scene with punctual lights ([`super::punctual`]) these light its surfaces instead. There is no environment, which the specification leaves to the viewer: ambient light comes from all sides alike
//! and is multiplied by b and by the occlusion. Emission is added, and the sum is encoded.
//!
//! The denominator of D loses digits where h is near n, so (n.h)^2 (a^2 - 1) + 1 is computed as |n x h|^2 + a^2 (n.h)^2. A roughness below
//! [`LEAST_ROUGHNESS`] counts as that: without any, a light that is a point is seen nowhere.
//!
//! A texel of a normal map that departs from (0, 0, 1) by no more than a step of 255 leaves the normal as it is: 8 bits hold no 0.

use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::linear;
use super::punctual::PunctualLight;
use super::shade::Light;
use super::target::Colour;
use super::texture::Texture;
use rasterproof_core::arrays::MapArray as _;

/// The maps of a surface beside its colour, as their numbers in [`Physical::maps`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// In linear light, multiplied by the emission.
    Emission,
    /// Green: roughness, blue: metal, each multiplied by its factor.
    Metal,
    /// Red: the part of the ambient light that arrives.
    Occlusion,
    /// From [0, 1] to [-1, 1]: a normal by tangent, bitangent and normal.
    Normal,
}

impl Map {
    pub const ALL: [Self; 4] = [Self::Emission, Self::Metal, Self::Occlusion, Self::Normal];

    /// What a surface without this map reads everywhere.
    #[must_use]
    pub fn missing(self) -> DVec3 {
        match self {
            Self::Emission | Self::Metal | Self::Occlusion => DVec3::ONE,
            Self::Normal => DVec3::new(0.5, 0.5, 1.0),
        }
    }
}

/// A texture, and whether it is read at the second texture coordinates.
pub type TextureRead<'a> = (&'a Texture, bool);

fn none_is(second: &[bool]) -> bool {
    !second.contains(&true)
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Physical {
    /// From 0, as plastic or wood, to 1, as metal.
    pub metal: f64,
    /// From 0, as a mirror, to 1; its square is the a of the formulas.
    pub roughness: f64,
    /// In linear light, from 0 on.
    pub emission: DVec3,
    /// From 0, no occlusion, to 1, as much as the map says.
    pub occlusion: f64,
    /// What x and y of a normal map are multiplied by.
    pub bumps: f64,
    /// The share of light from straight ahead that is reflected where there is no metal: r of the formulas.
    pub straight: DVec3,
    /// The same of light that grazes the surface: s of the formulas.
    pub grazing: f64,
    pub maps: [Option<Arc<Texture>>; Map::ALL.len()],
    /// Which of the maps are read at the second texture coordinates.
    #[serde(skip_serializing_if = "none_is")]
    pub second: [bool; Map::ALL.len()],
}

impl Default for Physical {
    /// A matt surface without metal, maps and emission.
    fn default() -> Self {
        let maps = [const { None }; Map::ALL.len()];
        Self {
            metal: 0.0,
            roughness: 1.0,
            emission: DVec3::ZERO,
            occlusion: 1.0,
            bumps: 1.0,
            straight: DVec3::splat(0.04),
            grazing: 1.0,
            maps,
            second: [false; Map::ALL.len()],
        }
    }
}

/// A smaller roughness counts as this one, so that the highlight of a light that is a point has a size.
pub const LEAST_ROUGHNESS: f64 = 1.0 / 32.0;

/// How far a normal map departs from (0, 0, 1) where it changes nothing: a step, and its rounding.
const FLAT: f64 = 1.0 / 255.0 + 1.0 / (1u64 << 40) as f64;

/// What is computed of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    pub emission: bool,
    pub reflection: bool,
    pub occlusion: bool,
    pub bumps: bool,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Base colour, colour of the corners and texel, multiplied.
    pub base: DVec3,
    /// Of any length.
    pub normal: DVec3,
    /// Along the texture's u, of any length; w is the sign of the bitangent n x t.
    pub tangent: DVec4,
    /// Of any length.
    pub to_eye: DVec3,
    /// What is read of each map.
    pub texels: [DVec3; Map::ALL.len()],
    /// Which part of the light arrives, from 0 to 1.
    pub lit: f64,
    /// Where it is in world space, which decides how much of a punctual light arrives.
    pub place: DVec3,
}

#[derive(Clone, Copy, Debug)]
pub struct Lights<'a> {
    pub main: &'a Light,
    pub punctual: &'a [PunctualLight],
}

impl Physical {
    #[must_use]
    pub fn map(&self, map: Map) -> Option<&Texture> {
        self.maps[map as usize].as_deref()
    }

    #[must_use]
    pub fn sampled(&self, map: Map) -> Option<TextureRead<'_>> {
        Some((self.map(map)?, self.second[map as usize]))
    }

    /// Whether this texel of the normal map leaves the normal as it is.
    #[must_use]
    pub fn is_flat(texel: DVec3) -> bool {
        let [x, y] = [2.0 * texel.x - 1.0, 2.0 * texel.y - 1.0];
        x.abs() <= FLAT && y.abs() <= FLAT
    }

    /// The colour of a point in a light.
    #[must_use]
    pub fn colour(&self, lights: Lights<'_>, point: &Point, parts: Parts) -> Colour {
        linear::encoded(self.light(lights, point, parts))
    }

    fn light(&self, lights: Lights<'_>, point: &Point, parts: Parts) -> DVec3 {
        let light = lights.main;
        let texel = |map: Map| point.texels[map as usize];
        // As in [`Light::intensity`], so that the cosine has the sign of the product.
        let length = point.normal.length();
        let mut normal = point.normal.normalize_or_zero();
        let mut cosine = if length > 0.0 { point.normal.dot(light.towards) / length } else { 0.0 };
        if parts.bumps && !Self::is_flat(texel(Map::Normal)) {
            normal = self.bumped(normal, point.tangent, texel(Map::Normal));
            cosine = normal.dot(light.towards);
        }
        let occlusion = if parts.occlusion {
            1.0 + self.occlusion * (texel(Map::Occlusion).x - 1.0)
        } else {
            1.0
        };
        let mut sum = point.base * (light.ambient * occlusion);
        let mut add = |towards: DVec3, cosine: f64, arriving: DVec3| {
            if cosine > 0.0 && arriving.max_element() > 0.0 {
                sum += arriving
                    * if parts.reflection {
                        let DVec3 { y: roughness, z: metal, .. } = texel(Map::Metal);
                        let of = [self.metal * metal, self.roughness * roughness];
                        let to_eye = point.to_eye.normalize_or_zero();
                        self.reflected(point.base, of, cosine, [normal, towards, to_eye])
                    } else {
                        point.base
                    };
            }
        };
        add(light.towards, cosine, DVec3::splat(light.diffuse * point.lit * cosine));
        for light in lights.punctual {
            let (towards, arriving) = light.arriving_at(point.place);
            let cosine = normal.dot(towards);
            add(towards, cosine, light.colour * (arriving * cosine));
        }
        if parts.emission {
            sum += self.emission * texel(Map::Emission);
        }
        sum
    }

    /// The normal of length 1 that a texel of the map makes of one of length 1.
    fn bumped(&self, normal: DVec3, tangent: DVec4, texel: DVec3) -> DVec3 {
        let along = tangent.truncate();
        let along = (along - normal * normal.dot(along)).normalize_or_zero();
        let across = normal.cross(along) * tangent.w;
        let DVec3 { x, y, z } = texel * 2.0 - 1.0;
        (along * (x * self.bumps) + across * (y * self.bumps) + normal * z).normalize_or(normal)
    }

    /// What is reflected to the eye of a light of pi with the cosine `nl`, by which the caller multiplies.
    fn reflected(
        &self,
        base: DVec3,
        [metal, roughness]: [f64; 2],
        nl: f64,
        [n, l, v]: [DVec3; 3],
    ) -> DVec3 {
        let a = roughness.max(LEAST_ROUGHNESS).powi(2);
        let h = (l + v).normalize_or_zero();
        let [nv, nh, vh] = [n.dot(v), n.dot(h), v.dot(h)].map_array(|cosine: f64| cosine.max(0.0));
        let f0 = self.straight * (1.0 - metal) + base * metal;
        // Without rounding where it is 1.
        let f90 = if self.grazing == 1.0 { 1.0 } else { self.grazing * (1.0 - metal) + metal };
        let fresnel = f0 + (f90 - f0) * (1.0 - vh).max(0.0).powi(5);
        let is_grey = self.straight == DVec3::splat(self.straight.x);
        // What a coloured surface reflects must not leave its complement in the matt part.
        let rest = if is_grey { 1.0 - fresnel } else { DVec3::splat(1.0 - fresnel.max_element()) };
        let matt = rest * base * (1.0 - metal);
        let (square, rest) = (a * a, 1.0 - a * a);
        let smith = nl * (nv * nv * rest + square).sqrt() + nv * (nl * nl * rest + square).sqrt();
        let spread = n.cross(h).length_squared() + square * nh * nh;
        // Both pi cancel.
        matt + fresnel * (square / (spread * spread) * (0.5 / smith))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Parts = Parts { emission: true, reflection: true, occlusion: true, bumps: true };
    const LIGHT: Light = Light { towards: DVec3::Z, ambient: 0.25, diffuse: 0.5 };

    fn point(base: f64) -> Point {
        Point {
            base: DVec3::splat(base),
            normal: DVec3::Z * 3.0,
            tangent: DVec4::new(2.0, 0.0, 0.0, 1.0),
            to_eye: DVec3::Z * 5.0,
            texels: Map::ALL.map(Map::missing),
            lit: 1.0,
            place: DVec3::ZERO,
        }
    }

    const LIGHTS: Lights<'_> = Lights { main: &LIGHT, punctual: &[] };

    fn light(surface: &Physical, point: &Point) -> f64 {
        surface.light(LIGHTS, point, ALL).x
    }

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    /// Computed by hand from the formulas of the specification.
    #[test]
    fn formulas_are_those_of_the_specification() {
        // All directions are the same: F = f0, D = 1 / (pi a^2), V = 1/4. With a = 1, pi F V D = f0 / 4.
        let matt = Physical::default();
        assert!(is_near(light(&matt, &point(0.5)), 0.5 * 0.25 + 0.5 * (0.96 * 0.5 + 0.04 / 4.0)));
        // Of what reflects nothing, the matt part is whole.
        let dull = Physical { straight: DVec3::ZERO, grazing: 0.0, ..Physical::default() };
        assert!(is_near(light(&dull, &point(0.5)), 0.5 * 0.25 + 0.5 * 0.5));
        let metal = Physical { metal: 1.0, roughness: 0.5, ..Physical::default() };
        // a = 1/4, so D is sixteen times as large.
        assert!(is_near(light(&metal, &point(0.5)), 0.5 * 0.25 + 0.5 * (0.5 * 16.0 / 4.0)));
        // l and v at 60 degrees from n on either side: n.h = 1, v.h = 1/2, (1 - v.h)^5 = 1/32.
        let side = |x: f64| DVec3::new(x * 0.75f64.sqrt(), 0.0, 0.5);
        let far = Physical::default().reflected(
            DVec3::splat(0.5),
            [0.0, 1.0],
            0.5,
            [DVec3::Z, side(1.0), side(-1.0)],
        );
        let fresnel = 0.04 + 0.96 / 32.0;
        assert!(is_near(far.x, (1.0 - fresnel) * 0.5 + fresnel * (0.5 / (0.5 + 0.5))), "{far}");
        // With a = 1/4: V = 1 / (2 (2 x 1/2 sqrt(1/4 (1 - 1/16) + 1/16))), D = 16 / pi.
        let far = Physical::default().reflected(
            DVec3::ONE,
            [1.0, 0.5],
            0.5,
            [DVec3::Z, side(1.0), side(-1.0)],
        );
        let smith = (0.25f64 * (1.0 - 1.0 / 16.0) + 1.0 / 16.0).sqrt();
        assert!(is_near(far.x, 16.0 * 0.5 / smith), "{far}");
        // h beside n: l in the direction of n, v at a right angle to it, so n.h = sqrt(1/2) and n.v = 0.
        let aside = Physical::default().reflected(
            DVec3::ONE,
            [1.0, 0.5],
            1.0,
            [DVec3::Z, DVec3::Z, DVec3::X],
        );
        let spread = 0.5f64 * (1.0 / 16.0 - 1.0) + 1.0;
        assert!(is_near(aside.x, 1.0 / 16.0 / (spread * spread) * (0.5 / 0.25)), "{aside}");
    }

    #[test]
    fn maps_and_emission_count() {
        let surface = Physical {
            metal: 1.0,
            roughness: 1.0,
            emission: DVec3::new(0.1, 2.0, 0.0),
            occlusion: 0.5,
            ..Physical::default()
        };
        let mut of = point(0.5);
        // No metal, and half of the roughness.
        of.texels[Map::Metal as usize] = DVec3::new(0.3, 0.5, 0.0);
        of.texels[Map::Emission as usize] = DVec3::splat(0.25);
        // Half of what is missing of the ambient light.
        of.texels[Map::Occlusion as usize] = DVec3::new(0.0, 1.0, 1.0);
        let direct = 0.5 * (0.96 * 0.5 + 0.04 * 16.0 / 4.0);
        assert!(is_near(light(&surface, &of), 0.5 * 0.25 * 0.5 + direct + 0.025));
        assert!(is_near(surface.light(LIGHTS, &of, ALL).y, 0.5 * 0.25 * 0.5 + direct + 0.5));
        // The light behind, or in shadow: ambient light and emission.
        let behind = Point { normal: -DVec3::Z, ..of };
        let dark = Point { lit: 0.0, ..of };
        for of in [behind, dark] {
            assert!(is_near(light(&surface, &of), 0.5 * 0.25 * 0.5 + 0.025));
        }
    }

    #[test]
    fn bumps_turn_the_normal() {
        let surface = Physical { bumps: 2.0, ..Physical::default() };
        let texel = |x: f64, y: f64, z: f64| (DVec3::new(x, y, z) + 1.0) / 2.0;
        let bumped = |w: f64, texel| surface.bumped(DVec3::Z, DVec4::new(3.0, 0.0, 1.0, w), texel);
        let towards = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
        assert!((bumped(1.0, texel(0.4, 0.0, 0.8)) - towards(1.0, 0.0, 1.0)).length() < 1e-12);
        // n x t = z x x = y.
        assert!((bumped(1.0, texel(0.0, 0.4, 0.8)) - towards(0.0, 1.0, 1.0)).length() < 1e-12);
        assert!((bumped(-1.0, texel(0.0, 0.4, 0.8)) - towards(0.0, -1.0, 1.0)).length() < 1e-12);
        // 127 and 128 are both nearest to 0.
        for [x, y] in [[127.0, 128.0], [128.0, 128.0]] {
            assert!(Physical::is_flat(DVec3::new(x / 255.0, y / 255.0, 1.0)));
        }
        assert!(!Physical::is_flat(DVec3::new(129.0 / 255.0, 0.5, 1.0)));
    }
}
