//! The tangents of surfaces with a normal map: those of the file, or by MikkTSpace, as glTF says for files that have none.

use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use glam::{DVec3, DVec4};
use rasterproof_render::scene::{Attribute, Corner, Triangles};

/// Triangles with the tangents of their file, one for each position, or with computed ones where there are none, along the first or
/// the second texture coordinates.
pub(crate) fn with(
    triangles: Triangles,
    positions: &[DVec3],
    mut of_file: Vec<DVec4>,
    is_second: bool,
) -> Triangles {
    if of_file.is_empty() {
        let mut corners: Vec<[Corner; 3]> = triangles.iter().collect();
        if is_second {
            for (number, corners) in corners.iter_mut().enumerate() {
                for (corner, uv) in corners.iter_mut().zip(triangles.second_uvs(number)) {
                    corner.uv = uv;
                }
            }
        }
        let tangents = vec![[DVec4::ZERO; 3]; corners.len()];
        let mut surface = Surface { positions, corners, tangents };
        match generate_tangents(&mut surface) {
            Ok(()) => triangles.with_tangents(Attribute::OfCorners(surface.tangents)),
            Err(_) => triangles,
        }
    } else {
        for tangent in &mut of_file {
            *tangent = mirrored(*tangent);
        }
        triangles.with_tangents(Attribute::OfPositions(of_file))
    }
}

/// Scenes are left-handed, so z is negated, and with it the sign of a cross product.
fn mirrored(DVec4 { x, y, z, w }: DVec4) -> DVec4 {
    DVec4::new(x, y, -z, -w)
}

/// Triangles in the coordinates of glTF, but with v up, as y of its normal maps is.
struct Surface<'a> {
    positions: &'a [DVec3],
    corners: Vec<[Corner; 3]>,
    /// Filled in by the algorithm, corner by corner.
    tangents: Vec<[DVec4; 3]>,
}

/// Functions that give the same bits on every machine.
struct Libm;

impl Ops for Libm {
    fn sqrt(x: f32) -> f32 {
        libm::sqrtf(x)
    }

    fn acos(x: f32) -> f32 {
        libm::acos(x.into()) as f32
    }
}

/// What is beyond f32 has no direction.
fn single<const N: usize>(numbers: [f64; N]) -> [f32; N] {
    numbers.map(|number| Some(number as f32).filter(|number| number.is_finite()).unwrap_or(0.0))
}

impl Geometry<Libm> for Surface<'_> {
    fn num_faces(&self) -> usize {
        self.corners.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        let DVec3 { x, y, z } = self.positions[self.corners[face][corner].position as usize];
        single([x, y, -z])
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let DVec3 { x, y, z } = self.corners[face][corner].normal;
        single([x, y, -z])
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let uv = self.corners[face][corner].uv;
        single([uv.x, uv.y])
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let tangent = space.unwrap_or_default().tangent_encoded().map(f64::from);
        self.tangents[face][corner] = mirrored(DVec4::from_array(tangent));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use rasterproof_render::scene::Normals;

    /// A square that faces the viewer of a glTF, with u to the right or, mirrored, to the left.
    fn square(mirrored_u: bool) -> Triangles {
        let uv = |u: f64, v: f64| DVec2::new(if mirrored_u { 1.0 - u } else { u }, v);
        let uvs = vec![uv(0.0, 0.0), uv(1.0, 0.0), uv(1.0, 1.0), uv(0.0, 1.0)];
        let normals = Normals::Given(Attribute::Same(-DVec3::Z));
        let colours = Attribute::Same(DVec3::ONE);
        Triangles::new(vec![0, 1, 2, 0, 2, 3], colours, normals, Attribute::OfPositions(uvs))
    }

    #[test]
    fn tangents_lead_along_u_and_bitangents_up() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        for (mirrored_u, along) in [(false, 1.0), (true, -1.0)] {
            let made = with(square(mirrored_u), &positions, Vec::new(), false);
            // In the left-handed scene n is -z, so n x t w is up where w is -1 times the direction of u.
            let expected = Attribute::Same(DVec4::new(along, 0.0, 0.0, -along));
            assert_eq!(made, square(mirrored_u).with_tangents(expected.clone()));
            let second = [0, 1].map(|i| square(mirrored_u).at(i).map(|corner| corner.uv));
            let second = Attribute::OfCorners(second.to_vec());
            let other = square(!mirrored_u).with_second_uvs(second);
            let made = with(other.clone(), &positions, Vec::new(), true);
            assert_eq!(made, other.with_tangents(expected));
        }
        let given = with(square(false), &positions, vec![DVec4::new(0.0, 0.6, 0.8, 1.0); 4], false);
        let expected = Attribute::Same(DVec4::new(0.0, 0.6, -0.8, -1.0));
        assert_eq!(given, square(false).with_tangents(expected));
    }
}
