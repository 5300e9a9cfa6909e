//! The fragment stage of the scenes: vertex colours, texture, diffuse and ambient light (the book's
//! sections 3.3 and 11.1).
//!
//! colour = base x vertex colour x texel x (ambient + diffuse max(0, n . l)), in this order, with
//! the interpolated normal brought back to length 1: between two normals at a right angle it has
//! shrunk to 0.707, and the light would be 29% too dark.

use std::ops::{Add, Mul, Sub};

use glam::{DVec2, DVec3, DVec4};
use rasterproof_core::triangle::Varying;

/// `N` numbers that are interpolated together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attributes<const N: usize>(pub [f64; N]);

impl<const N: usize> Add for Attributes<N> {
    type Output = Self;
    #[inline]
    // By index here: adapters cost a build their copies.
    fn add(mut self, other: Self) -> Self {
        for i in 0..N {
            self.0[i] += other.0[i];
        }
        self
    }
}

impl<const N: usize> Sub for Attributes<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        for i in 0..N {
            self.0[i] -= other.0[i];
        }
        self
    }
}

impl<const N: usize> Mul<f64> for Attributes<N> {
    type Output = Self;
    #[inline]
    fn mul(mut self, factor: f64) -> Self {
        for value in &mut self.0 {
            *value *= factor;
        }
        self
    }
}

impl<const N: usize> Varying for Attributes<N> {
    fn by_number(values: [Self; 3], mut number: impl FnMut([f64; 3]) -> f64) -> Self {
        let [Self(a), Self(b), Self(c)] = values;
        Self(std::array::from_fn(|i| number([a[i], b[i], c[i]])))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Colour, or light already multiplied in (Gouraud); 1 where neither is used.
    pub colour: DVec3,
    /// Normal in world space, of any length; 0 where there is no light.
    pub normal: DVec3,
    pub uv: DVec2,
    /// Where the light sees it, as in [`super::shadow::LightView`]; 0 where it has no shadows.
    pub place: DVec3,
    /// Where it is in world space; 0 where it does not matter from where it is seen.
    pub world: DVec3,
    /// The direction of u in world space, of any length, and the sign of the bitangent; 0 without a normal map.
    pub tangent: DVec4,
    /// Those of maps that are read elsewhere than the colour; 0 where there are none.
    pub second_uv: DVec2,
}

impl Surface {
    /// A surface of which nothing is known yet: all numbers are 0.
    pub const NONE: Self = Self {
        colour: DVec3::ZERO,
        normal: DVec3::ZERO,
        uv: DVec2::ZERO,
        place: DVec3::ZERO,
        world: DVec3::ZERO,
        tangent: DVec4::ZERO,
        second_uv: DVec2::ZERO,
    };

    /// The first or the second texture coordinates.
    #[must_use]
    #[inline]
    pub fn uv_of(&self, is_second: bool) -> DVec2 {
        if is_second { self.second_uv } else { self.uv }
    }
}

/// All attributes of a [`Surface`] without shadows.
pub const ALL: usize = 8;

/// The same, and after them the places, the tangent and the second texture coordinates.
pub const PLACED: usize = 20;

impl From<Surface> for Attributes<PLACED> {
    fn from(Surface { colour, normal, uv, place, world, tangent, second_uv }: Surface) -> Self {
        let ([r, g, b], [x, y, z]) = (colour.to_array(), normal.to_array());
        let ([p, q, d], [e, f, h]) = (place.to_array(), world.to_array());
        let [t, k, l, w] = tangent.to_array();
        let DVec2 { x: u, y: v } = second_uv;
        Self([r, g, b, x, y, z, uv.x, uv.y, p, q, d, e, f, h, t, k, l, w, u, v])
    }
}

impl From<&Attributes<PLACED>> for Surface {
    #[inline]
    fn from(Attributes(all): &Attributes<PLACED>) -> Self {
        let three = |at: usize| DVec3::new(all[at], all[at + 1], all[at + 2]);
        Self {
            colour: three(0),
            normal: three(3),
            uv: DVec2::new(all[6], all[7]),
            place: three(8),
            world: three(11),
            tangent: three(14).extend(all[17]),
            second_uv: DVec2::new(all[18], all[19]),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Light {
    /// Towards the light, length 1.
    pub towards: DVec3,
    pub ambient: f64,
    /// What a surface that faces the light gets on top.
    pub diffuse: f64,
}

impl Light {
    /// Leaves every colour as it is.
    pub const NONE: Self = Self { towards: DVec3::Z, ambient: 1.0, diffuse: 0.0 };

    /// ambient + diffuse max(0, n . l) for a normal of any length; of length 0, ambient alone.
    #[must_use]
    #[inline]
    pub fn intensity(&self, normal: DVec3) -> f64 {
        let length = normal.length();
        let cosine = if length > 0.0 { normal.dot(self.towards) / length } else { 0.0 };
        self.ambient + self.diffuse * cosine.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_brought_back_to_length_1() {
        let light = Light { towards: DVec3::Z, ambient: 0.25, diffuse: 0.75 };
        let between = (DVec3::new(1.0, 0.0, 1.0) + DVec3::new(-1.0, 0.0, 1.0)) * 0.5;
        assert_eq!(light.intensity(between * 0.5), 1.0);
        assert_eq!(light.intensity(-between), 0.25);
        assert_eq!(light.intensity(DVec3::ZERO), 0.25);
        assert_eq!(Light::NONE.intensity(DVec3::new(3.0, -2.0, 1.0)), 1.0);
        assert_eq!(Light::NONE.intensity(DVec3::ZERO), 1.0);
    }

    #[test]
    fn a_surface_survives_packing() {
        let (colour, normal, uv) = (DVec3::X, DVec3::new(1.0, 2.0, 3.0), DVec2::new(4.0, 5.0));
        let place = DVec3::new(6.0, 7.0, 8.0);
        let (world, tangent) = (place + 3.0, DVec4::new(12.0, 13.0, 14.0, -1.0));
        let second_uv = DVec2::new(15.0, 16.0);
        let surface = Surface { colour, normal, uv, place, world, tangent, second_uv };
        assert_eq!(Surface::from(&Attributes::from(surface)), surface);
    }
}
