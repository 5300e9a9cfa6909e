//! Scenes at random, a pure function of seed and number: every mixture of shapes, materials, places
//! and windings, with the cases that a plan of effects lives on, equal w, constant attributes,
//! disjoint boxes, and those that almost are.

use std::num::NonZeroU32;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};

use super::Shadows;
use super::{Attribute, Corner, Hidden, Item, Material, Mesh, Scene, Shading, shapes, textures};
use crate::pipeline::assemble::Cull;
use crate::pipeline::fog::{Fog, Growth};
use crate::pipeline::highlight::Specular;
use crate::pipeline::opacity::{AlphaMode, Opacity, OpacityMap};
use crate::pipeline::physical::{Map, Physical};
use crate::pipeline::punctual::{Kind, PunctualLight};
use crate::pipeline::shade::Light;
use crate::pipeline::texture::{Filter, Texture, Wrap};
use crate::pipeline::transform::{about, frustum};
use rasterproof_core::angle::{turn_x, turn_y};
use rasterproof_core::random::Rng;

/// The scene of a seed and a number.
///
/// # Panics
/// Never: its frustum is a constant.
#[must_use]
pub fn scene(seed: u64, index: u64) -> Scene {
    let mut rng = Rng::new("scene", seed, index);
    let projection = frustum(-0.8, 0.8, -0.6, 0.6, 1.0, 20.0).expect("a constant");
    let mut scene = Scene::new(&format!("random-{index}"), "a random scene", projection);
    if rng.chance(2) {
        let towards = DVec3::new(rng.signed(), rng.signed(), -1.0).normalize();
        scene.light = Light { towards, ambient: 0.25, diffuse: 0.75 };
    }
    scene.hidden = if rng.chance(8) { Hidden::Painter } else { Hidden::DepthBuffer };
    for _ in 0..rng.int(1, 5) {
        let item = item(&mut rng);
        scene.items.push(item);
    }
    scene
}

/// The same scene with effects beyond the book's: some of its materials have
/// highlights or holes or blend, some of its textures mip maps or anisotropy, and some scenes fog
/// or layers or a shadow map, and some items are physical, some of them in punctual lights.
///
/// # Panics
/// As [`scene`].
#[must_use]
pub fn with_effects(seed: u64, index: u64) -> Scene {
    let mut scene = scene(seed, index);
    let mut rng = Rng::new("effects", seed, index);
    for item in &mut scene.items {
        if rng.chance(2) {
            // From most of a surface to less than a pixel, and some too faint to be seen.
            let shininess = [1.0, 4.0, 30.0, 500.0][rng.int(0, 3) as usize] * (0.5 + rng.unit());
            let strength = if rng.chance(8) { 0.002 } else { 1.0 };
            let colour = DVec3::new(rng.unit(), rng.unit(), rng.unit()) * strength;
            item.material.specular = Specular { colour, shininess };
        }
    }
    for item in &mut scene.items {
        let has_mip_map = rng.chance(2);
        if let Some(texture) = item.material.texture.take() {
            let texture = Arc::unwrap_or_clone(texture);
            let texture = if has_mip_map { texture.with_mip_map() } else { texture };
            item.material.texture = Some(Arc::new(texture));
        }
    }
    if rng.chance(3) {
        let start = [0.0, 1.5, 2.0, 4.0][rng.int(0, 3) as usize] * (1.0 + 0.2 * rng.signed());
        let growth = match rng.int(0, 2) {
            0 => Growth::Exponential { density: rng.unit() },
            _ => Growth::Linear { start, end: start + 6.0 * rng.unit() },
        };
        let [r, g, b, _] = scene.background;
        let colour = if rng.chance(2) { [r, g, b] } else { [220, 225, 235] };
        scene.fog = Some(Fog { colour, growth });
    }
    for item in &mut scene.items {
        if rng.chance(3) {
            item.material.opacity = Some(opacity(&mut rng));
        }
    }
    for item in &mut scene.items {
        if rng.chance(2)
            && let Some(texture) = &mut item.material.texture
        {
            Arc::make_mut(texture).anisotropy = [2, 3, 4, 16][rng.int(0, 3) as usize];
        }
    }
    if rng.chance(2) {
        let size = [16, 40, 128][rng.int(0, 2) as usize];
        let bits = [16, 24, 32][rng.int(0, 2) as usize];
        scene.shadows = Some(Shadows { size, bits });
    }
    if rng.chance(2) {
        scene.layers = NonZeroU32::new(rng.int(1, 4) as u32);
    }
    for item in &mut scene.items {
        item.two_sided = rng.chance(2);
        if let Some(texture) = item.material.texture.take() {
            let texture = Arc::unwrap_or_clone(texture);
            let wrap = [0; 2].map(|_| wrap(&mut rng));
            let texture = texture.with(filter(&mut rng), wrap).with_minified(filter(&mut rng));
            let texture = if rng.chance(2) { texture.with_single_levels() } else { texture };
            item.material.texture = Some(Arc::new(texture));
        }
        if rng.chance(3) {
            make_physical(item, &mut rng);
        }
    }
    if rng.chance(2) {
        for _ in 0..rng.int(1, 3) {
            let light = punctual(&mut rng);
            scene.punctual.push(light);
        }
    }
    for item in &mut scene.items {
        if rng.chance(2) {
            read_elsewhere(item, &mut rng);
        }
    }
    scene
}

/// Gives an item second texture coordinates, at which some of its maps are read.
fn read_elsewhere(item: &mut Item, rng: &mut Rng) {
    let Some(surface) = &mut item.material.physical else { return };
    Arc::make_mut(surface).second = Map::ALL.map(|_| rng.chance(2));
    let size = if rng.chance(3) { 0.0 } else { 2.0 * rng.unit() };
    let from = DVec2::new(rng.signed(), rng.signed());
    let mesh = Arc::make_mut(&mut item.mesh);
    let triangles = std::mem::take(&mut mesh.triangles);
    let of = |corners: [Corner; 3]| corners.map(|corner| from + corner.uv.perp() * size);
    let uvs = triangles.iter().map(of).collect();
    mesh.triangles = triangles.with_second_uvs(Attribute::OfCorners(uvs));
}

/// Among the surfaces, with a range that reaches none, some or all of them.
fn punctual(rng: &mut Rng) -> PunctualLight {
    let range = [f64::INFINITY, 0.5, 2.0, 8.0][rng.int(0, 3) as usize] * (0.5 + rng.unit());
    let outer_rad = 1.6 * rng.unit();
    let inner_rad = outer_rad * rng.unit();
    let kind =
        [Kind::Directional, Kind::Point { range }, Kind::Spot { range, inner_rad, outer_rad }]
            [rng.int(0, 2) as usize];
    let colour = DVec3::new(rng.unit(), rng.unit(), rng.unit());
    let place = DVec3::new(2.0 * rng.signed(), 2.0 * rng.signed(), 1.0 + 4.0 * rng.unit());
    let turn = turn_y(3.0 * rng.signed()) * turn_x(rng.signed());
    PunctualLight::new(kind, colour, 30.0 * rng.unit())
        .placed(DMat4::from_translation(place) * turn)
}

/// Gives an item a surface in linear light, with maps that are mostly plain.
fn make_physical(item: &mut Item, rng: &mut Rng) {
    let map = |plain: DVec3, rng: &mut Rng| {
        let (width, height) = (rng.int(1, 40) as u32, rng.int(1, 40) as u32);
        let (patch, one_in) = (rng.int(1, 30) as u32, rng.int(1, 4) as u32);
        let other = DVec3::new(rng.unit(), rng.unit(), rng.unit());
        let texel = |at: u32| {
            let (x, y) = (at % width / patch, at / width / patch);
            let colour = if (x + 2 * y) % one_in == 0 { plain } else { other };
            colour.to_array().map(|channel| (channel * 255.0 + 0.5) as u8)
        };
        let texels: Vec<_> = (0..width * height).map(texel).collect();
        let texture = Texture::new(width, height, &texels).expect("as many texels as it has");
        let filter = [Filter::Nearest, Filter::Bilinear][rng.int(0, 1) as usize];
        let texture = texture.with(filter, [Wrap::Repeat, Wrap::Clamp][rng.int(0, 1) as usize]);
        let texture = if rng.chance(2) { texture.decoded() } else { texture };
        let texture = if rng.chance(2) { texture.with_mip_map() } else { texture };
        Some(Arc::new(texture.with_anisotropy(if rng.chance(4) { 4 } else { 1 })))
    };
    let mut surface = Physical {
        metal: [0.0, 1.0, rng.unit()][rng.int(0, 2) as usize],
        roughness: rng.unit(),
        emission: DVec3::new(rng.unit(), rng.unit(), 0.0) * if rng.chance(2) { 0.5 } else { 0.0 },
        occlusion: rng.unit(),
        bumps: 1.5 * rng.unit(),
        ..Physical::default()
    };
    if rng.chance(3) {
        surface.straight = DVec3::new(rng.unit(), rng.unit(), 0.04) * rng.unit();
        surface.grazing = rng.unit();
    }
    for kind in Map::ALL {
        if rng.chance(2) {
            let plain = if kind == Map::Emission { DVec3::ZERO } else { kind.missing() };
            surface.maps[kind as usize] = map(plain, rng);
        }
    }
    item.material.physical = Some(Arc::new(surface));
    if rng.chance(2)
        && let Some(texture) = item.material.texture.take()
    {
        item.material.texture = Some(Arc::new(Arc::unwrap_or_clone(texture).decoded()));
    }
    let mesh = Arc::unwrap_or_clone(std::mem::take(&mut item.mesh));
    item.mesh = Arc::new(shapes::with_tangents(mesh));
}

fn filter(rng: &mut Rng) -> Filter {
    [Filter::Nearest, Filter::Bilinear][rng.int(0, 1) as usize]
}

fn wrap(rng: &mut Rng) -> Wrap {
    [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][rng.int(0, 2) as usize]
}

/// Opacities in patches: none, all, and anything.
fn opacity(rng: &mut Rng) -> Opacity {
    let (width, height) = (rng.int(1, 50) as u32, rng.int(1, 50) as u32);
    let (patch, first) = (rng.int(1, 30) as u32, rng.int(0, 2) as u32);
    let mut texels = Vec::new();
    for at in 0..width * height {
        let (x, y) = (at % width / patch, at / width / patch);
        texels.push(match (x + 2 * y + first) % 3 {
            0 => 0,
            1 => u8::MAX,
            _ => rng.int(0, 255) as u8,
        });
    }
    let filter = [Filter::Nearest, Filter::Bilinear][rng.int(0, 1) as usize];
    let wrap = [Wrap::Repeat, Wrap::Clamp][rng.int(0, 1) as usize];
    let texture = Texture::grey(width, height, texels).expect("as many texels as it has");
    let map = OpacityMap::new(texture.with(filter, wrap));
    let threshold = [0.0, 0.1, 0.5, 1.0][rng.int(0, 3) as usize];
    Opacity {
        factor: if rng.chance(3) { rng.unit() } else { 1.0 },
        map: (!rng.chance(6)).then(|| Arc::new(map)),
        mode: if rng.chance(2) { AlphaMode::Blend } else { AlphaMode::Test { threshold } },
    }
}

fn item(rng: &mut Rng) -> Item {
    // Few distances, so that surfaces meet.
    let z = [1.5, 2.0, 3.0, 4.0, 8.0, 0.5][rng.int(0, 5) as usize];
    let centre = DVec3::new(rng.signed() * z, rng.signed() * z * 0.7, z);
    let size = z * (0.1 + 0.7 * rng.unit());
    let mut mesh = match rng.int(0, 4) {
        0 => {
            let mut point = || centre + DVec3::new(rng.signed(), rng.signed(), rng.signed()) * size;
            shapes::triangle([point(), point(), point()], [DVec3::X, DVec3::Y, DVec3::Z])
        }
        1 | 2 => {
            let at = |x: f64, y: f64| centre + DVec3::new(x, y * 0.6, 0.0) * size;
            shapes::quad([at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)])
        }
        3 => shapes::cuboid(centre - DVec3::splat(size / 2.0), centre + DVec3::splat(size / 2.0)),
        _ => shapes::sphere(centre, size / 2.0, 5, 4),
    };
    if rng.chance(2) {
        tint(&mut mesh, rng);
    }
    let material = material(rng);
    let mut item = Item::new(mesh, material);
    if rng.chance(2) {
        let turn = turn_y(rng.signed() * 3.0) * turn_x(rng.signed());
        item.model = about(centre, turn);
    }
    item.cull =
        [Cull::None, Cull::None, Cull::Clockwise, Cull::CounterClockwise][rng.int(0, 3) as usize];
    item
}

/// One colour for all, or one for each corner.
fn tint(mesh: &mut Mesh, rng: &mut Rng) {
    let mut colour = || DVec3::new(rng.unit(), rng.unit(), rng.unit());
    let one = colour();
    let many = colour().x < 0.5;
    mesh.triangles.change_corners(|corner| corner.colour = if many { colour() } else { one });
}

fn material(rng: &mut Rng) -> Material {
    let texture = match rng.int(0, 4) {
        0 => Some(textures::four()),
        1 => Some(textures::checkerboard().with(Filter::Bilinear, Wrap::Clamp)),
        _ => None,
    };
    Material {
        colour: DVec3::new(0.5 + rng.unit() / 2.0, 1.0, 0.25 + rng.unit() / 2.0),
        vertex_colours: rng.chance(3),
        texture: texture.map(Arc::new),
        shading: Shading::ALL[rng.int(0, 3) as usize],
        ..Material::default()
    }
}
