//! Meshes that are made, not read: quads, boxes, spheres. Closed ones run counter-clockwise as seen
//! from outside.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Attribute, Corner, Mesh};
use rasterproof_core::angle::sin_cos;

/// The same with tangents: those of each triangle by itself, by its positions and texture coordinates.
#[must_use]
pub fn with_tangents(mut mesh: Mesh) -> Mesh {
    let of = |corners: [Corner; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner.position as usize]);
        let [p, q] = [1, 2].map(|i: usize| corners[i].uv - corners[0].uv);
        let (to_b, to_c) = (b - a, c - a);
        let area = p.perp_dot(q);
        let along = ((to_b * q.y - to_c * p.y) * area).normalize_or_zero();
        let across = (to_c * p.x - to_b * q.x) * area;
        corners.map(|corner| {
            let sign = if corner.normal.cross(along).dot(across) < 0.0 { -1.0 } else { 1.0 };
            along.extend(sign)
        })
    };
    let tangents = mesh.triangles.iter().map(of).collect();
    mesh.triangles = mesh.triangles.with_tangents(Attribute::OfCorners(tangents));
    mesh
}

/// A triangle from its positions and corner colours.
#[must_use]
pub fn triangle(positions: [DVec3; 3], colours: [DVec3; 3]) -> Mesh {
    let uvs = [DVec2::ZERO, DVec2::X, DVec2::Y];
    let corner = |i: usize| Corner {
        position: i as u32,
        colour: colours[i],
        normal: DVec3::ZERO,
        uv: uvs[i],
    };
    with_face_normals(Mesh {
        positions: Arc::new(positions.to_vec()),
        triangles: [[corner(0), corner(1), corner(2)]].into_iter().collect(),
    })
}

/// Two triangles from four corners in turn; texture coordinates (0,0), (1,0), (1,1), (0,1).
#[must_use]
pub fn quad(positions: [DVec3; 4]) -> Mesh {
    let mut mesh = Mesh::default();
    push_quad(&mut mesh, positions, [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    with_face_normals(mesh)
}

/// A box between two corners; each face shows the whole texture.
#[must_use]
pub fn cuboid(min: DVec3, max: DVec3) -> Mesh {
    let at = |i: usize| {
        let pick = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
        DVec3::new(pick(1, min.x, max.x), pick(2, min.y, max.y), pick(4, min.z, max.z))
    };
    // Corners of each face, counter-clockwise from outside, the lower left one first.
    let faces =
        [[0, 1, 3, 2], [5, 4, 6, 7], [4, 0, 2, 6], [1, 5, 7, 3], [2, 3, 7, 6], [4, 5, 1, 0]];
    let uvs = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let mut mesh = Mesh { positions: Arc::new((0..8).map(at).collect()), ..Mesh::default() };
    for face in faces {
        push_faces(&mut mesh, face.map(|i| i as u32), uvs);
    }
    with_face_normals(mesh)
}

/// A sphere of `slices` around and `stacks` from pole to pole, with smooth normals. The positions
/// of seam and poles are shared, so it is closed.
#[must_use]
pub fn sphere(centre: DVec3, radius: f64, slices: u32, stacks: u32) -> Mesh {
    let (slices, stacks) = (slices.max(3), stacks.max(2));
    let mut positions = Vec::new();
    let rings = stacks - 1;
    positions.push(centre + DVec3::Y * radius);
    for ring in 1..=rings {
        let polar = PI * f64::from(ring) / f64::from(stacks);
        for slice in 0..slices {
            let around = TAU * f64::from(slice) / f64::from(slices);
            let ((sin, cos), (east, north)) = (sin_cos(polar), sin_cos(around));
            let unit = DVec3::new(north * sin, cos, east * sin);
            positions.push(centre + unit * radius);
        }
    }
    positions.push(centre - DVec3::Y * radius);
    let last = positions.len() as u32 - 1;
    let mut mesh = Mesh { positions: Arc::new(positions), ..Mesh::default() };
    let index = |ring: u32, slice: u32| match ring {
        0 => 0,
        ring if ring == stacks => last,
        ring => 1 + (ring - 1) * slices + slice % slices,
    };
    for ring in 0..stacks {
        for slice in 0..slices {
            let corner = |ring: u32, slice: u32| {
                let position = index(ring, slice);
                let uv = DVec2::new(
                    f64::from(slice) / f64::from(slices),
                    1.0 - f64::from(ring) / f64::from(stacks),
                );
                let normal = (mesh.positions[position as usize] - centre) / radius;
                Corner { position, colour: DVec3::ONE, normal, uv }
            };
            let [a, b] = [corner(ring, slice), corner(ring, slice + 1)];
            let [c, d] = [corner(ring + 1, slice + 1), corner(ring + 1, slice)];
            if ring > 0 {
                mesh.triangles.push([a, c, b]);
            }
            if ring + 1 < stacks {
                mesh.triangles.push([a, d, c]);
            }
        }
    }
    mesh
}

fn push_quad(mesh: &mut Mesh, positions: [DVec3; 4], uvs: [DVec2; 4]) {
    let first = mesh.positions.len() as u32;
    Arc::make_mut(&mut mesh.positions).extend(positions);
    push_faces(mesh, [first, first + 1, first + 2, first + 3], uvs);
}

fn push_faces(mesh: &mut Mesh, positions: [u32; 4], uvs: [DVec2; 4]) {
    let corner = |i: usize| Corner {
        position: positions[i],
        colour: DVec3::ONE,
        normal: DVec3::ZERO,
        uv: uvs[i],
    };
    mesh.triangles.push([corner(0), corner(1), corner(2)]);
    mesh.triangles.push([corner(0), corner(2), corner(3)]);
}

/// Every corner gets the normal of its face.
#[must_use]
pub fn with_face_normals(mut mesh: Mesh) -> Mesh {
    for i in 0..mesh.triangles.len() {
        let normal = mesh.face_normal(mesh.triangles.positions()[i]).normalize_or_zero();
        mesh.triangles.change(i, |corners| {
            corners.iter_mut().for_each(|corner| corner.normal = normal);
        });
    }
    mesh
}

/// Every corner without a normal gets the sum of the face normals, weighed by area, at its position.
#[must_use]
pub fn with_smooth_normals(mut mesh: Mesh) -> Mesh {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for &triangle in mesh.triangles.positions() {
        let normal = mesh.face_normal(triangle);
        for number in triangle {
            sums[number as usize] += normal;
        }
    }
    mesh.triangles.change_corners(|corner| {
        if corner.normal == DVec3::ZERO {
            corner.normal = sums[corner.position as usize].normalize_or_zero();
        }
    });
    mesh
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    /// Every edge is run once in each direction, so nothing is open and no face is turned.
    fn check_closed(mesh: &Mesh) {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for triangle in mesh.triangles.positions() {
            for i in 0..3 {
                let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
                *edges.entry((a, b)).or_default() += 1;
            }
        }
        assert!(edges.iter().all(|(&(a, b), &n)| n == 1 && edges.get(&(b, a)) == Some(&1)));
    }

    #[test]
    fn closed_shapes_are_closed_and_face_outwards() {
        let centre = DVec3::new(1.0, 2.0, 3.0);
        for mesh in [
            cuboid(centre - DVec3::ONE, centre + DVec3::ONE),
            sphere(centre, 1.5, 12, 7),
            sphere(centre, 1.5, 3, 2),
        ] {
            check_closed(&mesh);
            for triangle in mesh.triangles.iter() {
                let normal = mesh.face_normal(triangle.map(|corner| corner.position));
                let outwards = mesh.positions[triangle[0].position as usize] - centre;
                assert!(normal.dot(outwards) > 0.0);
                assert!(triangle.iter().all(|corner| corner.normal.dot(normal) > 0.0));
            }
        }
    }

    #[test]
    fn smooth_normals_of_a_cube_point_out_of_its_corners() {
        let mut cube = cuboid(-DVec3::ONE, DVec3::ONE);
        cube.triangles.change_corners(|corner| corner.normal = DVec3::ZERO);
        let cube = with_smooth_normals(cube);
        for corner in cube.triangles.corners() {
            assert!(corner.normal.dot(cube.positions[corner.position as usize]) > 1.6);
        }
    }
}
