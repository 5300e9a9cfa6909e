//! Lights that are a direction, a point or a cone, as `KHR_lights_punctual` of glTF states them.
//!
//! Of a light with colour c and intensity i, at the distance d and seen from it at the angle a to the direction in which it shines,
//! the surface gets c i n.l times
//!
//! - max(min(1 - (d / range)^4, 1), 0) / d^2 of a point and of a cone, the first factor 1 without a range, and
//! - clamp((cos a - cos outer) / max(0.001, cos inner - cos outer), 0, 1)^2 of a cone.
//!
//! Intensities are lux of directions and candela of the others. A picture has no exposure here: a radiance of 1 is the brightest
//! colour, as in the sample viewer of glTF, so a white matt surface that faces a light of pi lux has the brightest colour.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4};

use glam::{DMat4, DVec3, DVec4};

/// No more than so much arrives, so that products with colours are numbers.
const MOST: f64 = 1e12;

/// A light of a scene in the form in which fragments use it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct PunctualLight {
    /// In linear light, divided by pi: what a white matt surface that faces it shows at the distance 1.
    pub colour: DVec3,
    /// Where it is, with w 1, or the direction towards it, of length 1 and with w 0.
    pub at: DVec4,
    /// From this distance on nothing arrives; infinite without one.
    pub range: f64,
    pub cone: Option<Cone>,
}

/// Where a light shines that does not shine everywhere.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Cone {
    /// The direction in which it shines, of length 1.
    pub ahead: DVec3,
    /// The cosines of the angles where its light begins to fade and where nothing is left of it.
    pub inner: f64,
    pub outer: f64,
}

/// The three types of lights of the extension, with what only they have.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Directional,
    Point { range: f64 },
    Spot { range: f64, inner_rad: f64, outer_rad: f64 },
}

impl Kind {
    /// The angles of a spot that states none.
    pub const ANGLES_RAD: [f64; 2] = [0.0, FRAC_PI_4];
}

impl PunctualLight {
    /// A light at the origin that shines along -z.
    #[must_use]
    pub fn new(kind: Kind, colour: DVec3, intensity: f64) -> Self {
        let colour = colour * (intensity * FRAC_1_PI);
        let light = Self { colour, at: DVec4::W, range: f64::INFINITY, cone: None };
        match kind {
            Kind::Directional => Self { at: DVec4::Z, ..light },
            Kind::Point { range } => Self { range, ..light },
            Kind::Spot { range, inner_rad, outer_rad } => {
                let [inner, outer] =
                    [inner_rad, outer_rad].map(|angle| libm::cos(angle.clamp(0.0, FRAC_PI_2)));
                let ahead = DVec3::NEG_Z;
                Self { range, cone: Some(Cone { ahead, inner, outer }), ..light }
            }
        }
    }

    /// The same moved and turned by a matrix; its scale changes neither intensity nor range, as the extension says.
    #[must_use]
    pub fn placed(self, matrix: DMat4) -> Self {
        let turned = |direction| matrix.transform_vector3(direction).normalize_or(direction);
        let at = match self.at.w {
            0.0 => turned(self.at.truncate()).extend(0.0),
            _ => matrix.transform_point3(self.at.truncate()).extend(1.0),
        };
        let cone = self.cone.map(|cone| Cone { ahead: turned(cone.ahead), ..cone });
        Self { at, cone, ..self }
    }

    /// The same in a scene in which all lengths are multiplied by a factor: every surface gets as much light as before.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        if self.at.w == 0.0 {
            return self;
        }
        let at = (self.at.truncate() * factor).extend(1.0);
        Self { at, range: self.range * factor, colour: self.colour * (factor * factor), ..self }
    }

    /// The direction towards it from a place, of length 1, and what arrives there of its colour, from 0 on.
    #[must_use]
    pub fn arriving_at(&self, place: DVec3) -> (DVec3, f64) {
        let at = self.at.truncate();
        if self.at.w == 0.0 {
            return (at, 1.0);
        }
        let away = at - place;
        let square = away.length_squared();
        let towards = away / square.sqrt();
        let share = square / (self.range * self.range);
        let mut arriving = (1.0 - share * share).clamp(0.0, 1.0) / square;
        if let Some(Cone { ahead, inner, outer }) = self.cone {
            let along = (-ahead.dot(towards) - outer) / (inner - outer).max(0.001);
            arriving *= along.clamp(0.0, 1.0).powi(2);
        }
        // At the place of the light itself there is no direction, and beside it no colour is brighter.
        if square > 0.0 { (towards, arriving.min(MOST)) } else { (DVec3::ZERO, 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::angle::turn_y;
    use std::f64::consts::PI;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    /// Computed by hand from the formulas of the extension.
    #[test]
    fn light_arrives_as_the_extension_states() {
        let place = DVec3::new(0.0, 0.0, -2.0);
        let sun = PunctualLight::new(Kind::Directional, DVec3::new(1.0, 0.5, 0.0), PI);
        assert_eq!(sun.arriving_at(place), (DVec3::Z, 1.0));
        assert!((sun.colour - DVec3::new(1.0, 0.5, 0.0)).length() < 1e-15);
        let point = |range| PunctualLight::new(Kind::Point { range }, DVec3::ONE, 4.0 * PI);
        assert_eq!(point(f64::INFINITY).arriving_at(place), (DVec3::Z, 0.25));
        // (2 / 4)^4 = 1/16.
        assert_eq!(point(4.0).arriving_at(place).1, 0.25 * 15.0 / 16.0);
        assert_eq!(point(2.0).arriving_at(place).1, 0.0);
        assert_eq!(point(1.0).arriving_at(place).1, 0.0);
        assert_eq!(point(4.0).arriving_at(DVec3::ZERO), (DVec3::ZERO, 0.0));
        let spot = |inner_rad, outer_rad| {
            let kind = Kind::Spot { range: f64::INFINITY, inner_rad, outer_rad };
            PunctualLight::new(kind, DVec3::ONE, 1.0)
        };
        // At 45 degrees, halfway between the cosines of 0 and 90 less 0.2071.
        let aside = DVec3::new(1.0, 0.0, -1.0);
        assert!(near(spot(0.0, PI / 2.0).arriving_at(aside).1, 0.5 * 0.5));
        assert!(near(
            spot(0.0, PI / 3.0).arriving_at(aside).1,
            0.5 * (2.0f64.sqrt() - 1.0).powi(2)
        ));
        assert_eq!(spot(0.0, 0.7).arriving_at(aside).1, 0.0);
        assert!(near(spot(0.8, 0.9).arriving_at(aside).1, 0.5));
        assert_eq!(spot(0.1, 0.2).arriving_at(-place).1, 0.0);
    }

    #[test]
    fn a_light_moves_with_its_node() {
        let matrix = DMat4::from_translation(DVec3::X * 3.0)
            * turn_y(PI / 2.0)
            * DMat4::from_scale(DVec3::splat(5.0));
        let kind = Kind::Spot { range: 7.0, inner_rad: 0.1, outer_rad: 0.2 };
        let spot = PunctualLight::new(kind, DVec3::ONE, 1.0).placed(matrix);
        assert!((spot.at - DVec4::new(3.0, 0.0, 0.0, 1.0)).length() < 1e-15);
        assert!((spot.cone.unwrap().ahead - DVec3::NEG_X).length() < 1e-15);
        assert_eq!(spot.range, 7.0);
        let sun = PunctualLight::new(Kind::Directional, DVec3::ONE, 1.0).placed(matrix);
        assert!((sun.at - DVec4::X).length() < 1e-15);
        // What is twice as large and twice as far away looks the same.
        let place = DVec3::new(2.5, 0.5, 0.1);
        for light in [spot, sun] {
            let (towards, arriving) = light.arriving_at(place);
            let twice = light.scaled(2.0);
            let (same, less) = twice.arriving_at(place * 2.0);
            assert!((towards - same).length() < 1e-15);
            assert!((twice.colour * less - light.colour * arriving).length() < 1e-15);
        }
    }
}
