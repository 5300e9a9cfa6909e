//! Meshes of many triangles, made rather than read, with normals and texture coordinates: what models
//! of files are like, for measuring.
//!
//! A displaced sphere, a knotted tube and a torus, each of about 2,000, 4,000, 50,000 and 70,000
//! triangles, textured and lit.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};

use super::{Corner, Item, Material, Mesh, Scene, Shading, shapes, textures};
use crate::pipeline::shade::Light;
use crate::pipeline::transform::perspective;
use rasterproof_core::angle::{cos, sin, sin_cos, turn_x};

/// The shapes and their sizes, `NAME-TRIANGLES`.
pub const NAMES: [&str; 12] = [
    "bumps-2000",
    "bumps-4000",
    "bumps-50000",
    "bumps-70000",
    "knot-2000",
    "knot-4000",
    "knot-50000",
    "knot-70000",
    "torus-2000",
    "torus-4000",
    "torus-50000",
    "torus-70000",
];

/// The scene of a name for a square picture, seen whole; nothing for another name.
#[must_use]
pub fn scene(name: &str) -> Option<Scene> {
    let name = NAMES.into_iter().find(|known| *known == name)?;
    let (shape, count) = name.split_once('-')?;
    sized(shape, count.parse().ok()?)
}

/// As [`scene`], with about so many triangles.
#[must_use]
pub fn sized(shape: &str, triangles: u32) -> Option<Scene> {
    let name = format!("{shape}-{triangles}");
    let triangles = f64::from(triangles);
    // Two triangles in each of twice as many columns as rows, four times as many along a knot.
    let along = match shape {
        "knot" => 8.0,
        _ => 2.0,
    };
    let rows = (triangles / (2.0 * along)).sqrt().round();
    // The rows at the poles of a sphere have half as many.
    let full = if shape == "bumps" { rows - 1.0 } else { rows };
    let (rows, columns) = (rows as u32, (triangles / (2.0 * full)).round() as u32);
    let mesh = match shape {
        "bumps" => bumps(columns, rows),
        "knot" => tube(columns, rows, 0.22, knot),
        "torus" => tube(columns, rows, 0.4, |t| DVec3::new(cos(t), 0.0, sin(t))),
        _ => return None,
    };
    let projection = perspective(0.7, 1.0, 1.0, 10.0).ok()?;
    let mut scene = Scene::new(&name, "a mesh of many triangles, textured and lit", projection);
    let texture = Arc::new(textures::checkerboard());
    let shading = Shading::Phong;
    let material = Material { texture: Some(texture), shading, ..Material::default() };
    let model = DMat4::from_translation(DVec3::Z * 4.5) * turn_x(-0.6);
    scene.items = vec![Item { model, ..Item::new(mesh, material) }];
    let towards = DVec3::new(-0.4, 0.7, -0.6).normalize();
    scene.light = Light { towards, ambient: 0.25, diffuse: 0.75 };
    Some(scene)
}

/// A sphere with waves on it.
fn bumps(slices: u32, stacks: u32) -> Mesh {
    let mut mesh = shapes::sphere(DVec3::ZERO, 1.0, slices, stacks);
    for p in Arc::make_mut(&mut mesh.positions) {
        let wave = sin(5.0 * p.x) * sin(4.0 * p.y + 1.0) * cos(6.0 * p.z);
        *p *= 1.2 + 0.2 * wave;
    }
    smooth(mesh)
}

/// The trefoil.
fn knot(t: f64) -> DVec3 {
    let ((north, east), (sin, cos)) = (sin_cos(2.0 * t), sin_cos(3.0 * t));
    let radius = 0.9 + 0.4 * cos;
    DVec3::new(radius * east, 0.4 * sin, radius * north)
}

/// A closed tube around a closed curve over [0, 2 pi].
fn tube(columns: u32, rows: u32, radius: f64, curve: fn(f64) -> DVec3) -> Mesh {
    let (columns, rows) = (columns.max(3), rows.max(3));
    let angle = |i: u32, count: u32| TAU * f64::from(i) / f64::from(count);
    let mut positions = Vec::new();
    for column in 0..columns {
        let t = angle(column, columns);
        let (centre, along) = (curve(t), (curve(t + 1e-4) - curve(t - 1e-4)).normalize());
        // No tangent of these curves points up.
        let right = along.cross(DVec3::Y).normalize();
        let up = right.cross(along);
        for row in 0..rows {
            let (sin, cos) = sin_cos(angle(row, rows));
            positions.push(centre + (right * cos + up * sin) * radius);
        }
    }
    let corner = |column: u32, row: u32| Corner {
        position: column % columns * rows + row % rows,
        colour: DVec3::ONE,
        normal: DVec3::ZERO,
        uv: DVec2::new(
            8.0 * f64::from(column) / f64::from(columns),
            2.0 * f64::from(row) / f64::from(rows),
        ),
    };
    let mut mesh = Mesh { positions: Arc::new(positions), ..Mesh::default() };
    for column in 0..columns {
        for row in 0..rows {
            let [a, b] = [corner(column, row), corner(column, row + 1)];
            let [c, d] = [corner(column + 1, row + 1), corner(column + 1, row)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    smooth(mesh)
}

fn smooth(mut mesh: Mesh) -> Mesh {
    mesh.triangles.change_corners(|corner| corner.normal = DVec3::ZERO);
    shapes::with_smooth_normals(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_have_about_as_many_triangles_as_their_names_say() {
        for name in NAMES {
            let scene = scene(name).unwrap();
            let wanted: f64 = name.split_once('-').unwrap().1.parse().unwrap();
            let share = scene.triangles() as f64 / wanted;
            assert!((share - 1.0).abs() < 0.05, "{name}: {}", scene.triangles());
            let mesh = &scene.items[0].mesh;
            let mut corners = mesh.triangles.corners();
            assert!(corners.all(|c| (c.normal.length() - 1.0).abs() < 1e-9), "{name}");
        }
        assert!(scene("torus-3").is_none());
    }

    /// Outwards as spheres and boxes are: their volume, by signed tetrahedra, has one sign.
    #[test]
    fn meshes_are_closed_and_run_counter_clockwise_from_outside() {
        let volume = |mesh: &Mesh| -> f64 {
            let at = |corner: Corner| mesh.positions[corner.position as usize];
            mesh.triangles.iter().map(|[a, b, c]| at(a).dot(at(c).cross(at(b)))).sum()
        };
        let expected = volume(&shapes::sphere(DVec3::ZERO, 1.0, 24, 12)).signum();
        for name in NAMES {
            let scene = scene(name).unwrap();
            assert_eq!(volume(&scene.items[0].mesh).signum(), expected, "{name}");
        }
    }
}
