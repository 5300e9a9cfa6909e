//! The book's scenes, rebuilt with shapes and textures of our own, and a few that show what a plan
//! of effects saves.
//!
//! Camera and world space are one, as in the book: the eye is at the origin and looks along +z.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DMat4, DVec3};

pub use super::entry::Entry;
use super::entry::{AHEAD, daylight, entry, turned, with};
use super::{Hidden, Item, Material, Mesh, Scene, Shading, shapes, textures};
use crate::pipeline::assemble::Cull;
use crate::pipeline::shade::Light;
use crate::pipeline::texture::{Filter, Texture, Wrap};
use crate::pipeline::transform::frustum;
use rasterproof_core::angle::{sin, tan, turn_x, turn_y, turn_z};

pub const SCENES: &[Entry] = &[
    entry("square", "5.2: a square of two triangles with four texels, facing the eye", square),
    entry(
        "tilted-affine",
        "5.3: the square tilted, texture interpolated linearly in the window: wrong",
        tilted_affine,
    ),
    entry("tilted", "5.4: the square tilted, interpolated in perspective", tilted),
    entry(
        "cycle-painter",
        "6.1: three triangles, each in front of the next, by the painter's algorithm: wrong",
        cycle_painter,
    ),
    entry("cycle", "6.2: the same by the depth buffer", cycle),
    entry(
        "clipped",
        "7.4: a triangle with a corner behind the eye, cut by the near plane",
        clipped,
    ),
    entry("frustum", "8.3: a triangle that all six planes cut", frustum_scene),
    entry("culled", "9.3: a closed box, of which the wrong half is culled", culled),
    entry("spinning", "10.6: a triangle that turns about a point in front of the eye", spinning),
    entry("cube", "11: a textured cube in diffuse light", cube),
    entry("sphere", "11: a sphere with interpolated normals, texture and light", sphere),
    entry("facets", "a sphere of flat triangles, lit once each", facets),
    entry("inside", "the inside of a closed sphere: not a pixel of background", inside),
    entry("homework", "GAMES101 homework 2: its two triangles, one before the other", homework),
    entry(
        "panels",
        "a user interface: flat panels that do not overlap, parallel to the screen",
        panels,
    ),
    entry(
        "everything",
        "clipped, lit, textured, coloured and overlapping in perspective: all effects",
        everything,
    ),
];

/// All scenes that have a name: these, and those of effects beyond the book.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    SCENES.iter().chain(super::effects::SCENES)
}

/// The scene of a name for a picture of `aspect` = width / height, turned by `turn` of a full turn.
#[must_use]
pub fn scene(name: &str, aspect: f64, turn: f64) -> Option<Scene> {
    let entry = entries().find(|entry| entry.name == name)?;
    // The near side of the book's chapter 10 is 6.4 x 4.8 at distance 1; 1.6 x 1.2 bends less.
    let (top, near, far) = (0.6, 1.0, 20.0);
    let projection = frustum(-top * aspect, top * aspect, -top, top, near, far).ok()?;
    Some((entry.build)(Scene::new(entry.name, entry.about, projection), turn))
}

fn textured(texture: Texture, shading: Shading) -> Material {
    Material { texture: Some(Arc::new(texture)), shading, ..Material::default() }
}

/// A square of side 3 ahead, its texture as large.
fn ahead(texture: Texture) -> Item {
    let at = |x: f64, y: f64| AHEAD + DVec3::new(x, y, 0.0);
    let positions = [at(-1.5, -1.5), at(1.5, -1.5), at(1.5, 1.5), at(-1.5, 1.5)];
    Item::new(shapes::quad(positions), textured(texture, Shading::Unlit))
}

fn square(scene: Scene, turn: f64) -> Scene {
    let item = turned(ahead(textures::four()), AHEAD, turn_z(turn * TAU));
    with(scene, [item])
}

fn tilted(scene: Scene, turn: f64) -> Scene {
    // The book tilts by 30 degrees; 60 make the bend of the affine version plain.
    let tilt = turn_x(60f64.to_radians()) * turn_z(turn * TAU);
    with(scene, [turned(ahead(textures::checkerboard()), AHEAD, tilt)])
}

fn tilted_affine(scene: Scene, turn: f64) -> Scene {
    Scene { affine: true, ..tilted(scene, turn) }
}

/// Three long triangles around a point; each passes behind the foot of the next, and its tip shows again beyond.
fn cycle(scene: Scene, turn: f64) -> Scene {
    let colours =
        [DVec3::new(0.90, 0.35, 0.30), DVec3::new(0.35, 0.75, 0.40), DVec3::new(0.35, 0.55, 0.95)];
    let items = colours.into_iter().enumerate().map(|(i, colour)| {
        let blade = [
            DVec3::new(-1.5, -0.95, 3.4),
            DVec3::new(-1.1, -0.25, 3.4),
            DVec3::new(3.0, -0.55, 4.9),
        ];
        let mesh = shapes::triangle(blade, [colour; 3]);
        let material = Material { vertex_colours: true, ..Material::default() };
        let angle = (i as f64 / 3.0 + turn) * TAU;
        turned(Item::new(mesh, material), AHEAD, turn_z(angle))
    });
    with(scene, items)
}

fn cycle_painter(scene: Scene, turn: f64) -> Scene {
    Scene { hidden: Hidden::Painter, ..cycle(scene, turn) }
}

const CORNERS: [DVec3; 3] =
    [DVec3::new(0.95, 0.35, 0.25), DVec3::new(0.30, 0.85, 0.35), DVec3::new(0.30, 0.45, 0.95)];

fn coloured(positions: [DVec3; 3]) -> Item {
    let material = Material { vertex_colours: true, ..Material::default() };
    Item::new(shapes::triangle(positions, CORNERS), material)
}

fn clipped(scene: Scene, turn: f64) -> Scene {
    let positions =
        [DVec3::new(-1.4, 1.2, 4.0), DVec3::new(1.6, 1.0, 4.0), DVec3::new(0.4, -0.9, -1.0)];
    with(scene, [turned(coloured(positions), AHEAD, turn_z(turn * TAU))])
}

fn frustum_scene(scene: Scene, turn: f64) -> Scene {
    // Each plane leaves a side, and so do the three edges: a nonagon.
    let positions =
        [DVec3::new(7.4, 12.0, 24.5), DVec3::new(10.3, -11.3, 4.2), DVec3::new(-2.9, 2.1, 0.3)];
    with(scene, [turned(coloured(positions), AHEAD, turn_z(turn * TAU))])
}

fn culled(scene: Scene, turn: f64) -> Scene {
    let mesh = shapes::cuboid(AHEAD - DVec3::ONE, AHEAD + DVec3::ONE);
    let material = textured(textures::checkerboard(), Shading::Flat);
    let turn = turn_x(-0.5) * turn_y(0.6 + turn * TAU);
    let item = turned(Item::new(mesh, material), AHEAD, turn);
    // From beyond: what is seen of the walls turns its normals away from the eye.
    let light = Light { towards: DVec3::new(0.4, -0.5, 0.8).normalize(), ..daylight() };
    Scene { light, ..with(scene, [Item { cull: Cull::CounterClockwise, ..item }]) }
}

fn spinning(scene: Scene, turn: f64) -> Scene {
    let positions = [
        AHEAD + DVec3::new(-1.4, -1.0, 0.0),
        AHEAD + DVec3::new(1.4, -1.0, 0.0),
        AHEAD + DVec3::new(0.0, 1.3, 0.0),
    ];
    with(scene, [turned(coloured(positions), AHEAD, turn_y(0.6 + turn * TAU))])
}

fn cube(scene: Scene, turn: f64) -> Scene {
    let mesh = shapes::cuboid(AHEAD - DVec3::ONE, AHEAD + DVec3::ONE);
    let texture = textures::boards().with(Filter::Bilinear, Wrap::Clamp);
    let turn = turn_x(-0.5) * turn_y(0.6 + turn * TAU);
    let item = turned(Item::new(mesh, textured(texture, Shading::Phong)), AHEAD, turn);
    Scene { light: daylight(), ..with(scene, [Item { cull: Cull::Clockwise, ..item }]) }
}

fn sphere(scene: Scene, turn: f64) -> Scene {
    let mesh = shapes::sphere(AHEAD, 1.5, 48, 24);
    let material = textured(textures::checkerboard(), Shading::Phong);
    let item = turned(Item::new(mesh, material), AHEAD, turn_y(turn * TAU));
    Scene { light: daylight(), ..with(scene, [Item { cull: Cull::Clockwise, ..item }]) }
}

fn facets(scene: Scene, turn: f64) -> Scene {
    let mesh = shapes::sphere(AHEAD, 1.5, 24, 12);
    let material = Material {
        colour: DVec3::new(0.93, 0.70, 0.28),
        shading: Shading::Flat,
        ..Material::default()
    };
    let item = turned(Item::new(mesh, material), AHEAD, turn_y(turn * TAU));
    Scene { light: daylight(), ..with(scene, [Item { cull: Cull::Clockwise, ..item }]) }
}

fn inside(scene: Scene, turn: f64) -> Scene {
    // The eye is in the middle, and the near plane, at distance 1, within the sphere too.
    let mesh = shapes::sphere(DVec3::ZERO, 6.0, 32, 16);
    let material = textured(textures::checkerboard(), Shading::Unlit);
    let item = turned(Item::new(mesh, material), DVec3::ZERO, turn_y(turn * TAU));
    with(scene, [item])
}

/// The triangles, colours and camera of the homework: its eye stands 5 before the origin, and an
/// angle of 45 degrees is narrower than that of the other scenes.
fn homework(scene: Scene, turn: f64) -> Scene {
    let flat = |positions: [[f64; 2]; 3], distance: f64, colour: [u8; 3]| {
        let mesh =
            shapes::triangle(positions.map(|[x, y]| DVec3::new(x, y, distance)), [DVec3::ONE; 3]);
        let colour = DVec3::from(colour.map(f64::from)) / 255.0;
        let item = Item::new(mesh, Material { colour, ..Material::default() });
        turned(item, DVec3::new(0.0, 0.0, 8.5), turn_z(turn * TAU))
    };
    let items = [
        flat([[2.0, 0.0], [0.0, 2.0], [-2.0, 0.0]], 7.0, [217, 238, 185]),
        flat([[3.5, -1.0], [2.5, 1.5], [-1.0, 0.5]], 10.0, [185, 217, 238]),
    ];
    let narrower = 0.6 / tan(TAU / 16.0);
    let zoom = DMat4::from_scale(DVec3::new(narrower, narrower, 1.0));
    let projection = zoom * scene.projection;
    Scene { projection, background: [0, 0, 0, 255], ..with(scene, items) }
}

/// Corners of a rectangle in the window's own units, -1 to 1, at one distance.
fn panel([x0, y0, x1, y1]: [f64; 4], colour: DVec3) -> Item {
    let z = 2.0;
    // The window is 1.2 high at distance 1, so 2.4 here, and 3.2 wide at 4 : 3.
    let at = |x: f64, y: f64| DVec3::new(x * 1.6, y * 1.2, z);
    let positions = [at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)];
    Item::new(shapes::quad(positions), Material { colour, ..Material::default() })
}

fn panels(scene: Scene, _turn: f64) -> Scene {
    let grey = |v: f64| DVec3::new(v, v, v * 1.08);
    let mut items = vec![
        panel([-1.0, 0.88, 1.0, 1.0], DVec3::new(0.20, 0.32, 0.48)),
        panel([-1.0, -1.0, -0.62, 0.87], grey(0.82)),
        panel([-0.61, -1.0, 1.0, -0.84], grey(0.70)),
    ];
    for row in 0..4 {
        for column in 0..5 {
            let (x, y) = (-0.58 + f64::from(column) * 0.315, 0.50 - f64::from(row) * 0.42);
            let colour = CORNERS[(row + column) as usize % 3] * 0.85;
            items.push(panel([x, y, x + 0.29, y + 0.34], colour));
        }
    }
    let mut icon = panel([-0.58, -0.82, -0.40, -0.79], DVec3::ONE);
    icon.material.texture = Some(Arc::new(textures::checkerboard()));
    items.push(icon);
    with(scene, items)
}

/// A floor into the distance and two spheres that meet, all with colours, texture and light.
fn everything(scene: Scene, turn: f64) -> Scene {
    let texture = Arc::new(textures::boards().with(Filter::Bilinear, Wrap::Repeat));
    let material = Material {
        colour: DVec3::new(1.0, 0.98, 0.95),
        vertex_colours: true,
        texture: Some(texture),
        shading: Shading::Phong,
        ..Material::default()
    };
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.2, -2.0),
        DVec3::new(9.0, -1.2, -2.0),
        DVec3::new(9.0, -1.2, 25.0),
        DVec3::new(-9.0, -1.2, 25.0),
    ]);
    let meshes = [
        floor,
        shapes::sphere(AHEAD + DVec3::new(-0.5, -0.1, 0.0), 1.1, 64, 32),
        shapes::sphere(AHEAD + DVec3::new(0.9, 0.0, 0.6), 0.9, 64, 32),
    ];
    let tint = |mut mesh: Mesh| {
        let positions = &mesh.positions;
        mesh.triangles.change_corners(|corner| {
            let p = positions[corner.position as usize];
            let wave = |v: f64| 0.8 + 0.2 * sin(v * 1.7);
            corner.colour = DVec3::new(wave(p.x), wave(p.y + 1.0), wave(p.z + 2.0));
            corner.uv *= 3.0;
            // The floor's light changes along it too.
            corner.normal += DVec3::new(0.02 * p.x, 0.0, 0.005 * p.z);
        });
        mesh
    };
    let items = meshes.into_iter().map(|mesh| {
        let item = Item::new(tint(mesh), material.clone());
        turned(item, AHEAD, turn_y(turn * TAU))
    });
    Scene { light: daylight(), ..with(scene, items) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_triangles_and_a_name_of_its_own() {
        let entries: Vec<_> = entries().collect();
        for (i, entry) in entries.iter().enumerate() {
            let scene = scene(entry.name, 4.0 / 3.0, 0.0).unwrap();
            assert!(scene.triangles() > 0, "{}", entry.name);
            assert!(entries[..i].iter().all(|other| other.name != entry.name));
        }
        assert!(scene("no such scene", 1.0, 0.0).is_none());
    }
}
