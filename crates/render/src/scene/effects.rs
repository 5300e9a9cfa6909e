//! Scenes that call for effects beyond the book: what real models ask for.

use std::f64::consts::TAU;
use std::num::NonZeroU32;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};

use super::entry::{AHEAD, Entry, daylight, entry, turned, with};
use super::{Item, Material, Mesh, Scene, Shading, Shadows, shapes, textures};
use crate::pipeline::assemble::Cull;
use crate::pipeline::fog::{Fog, Growth};
use crate::pipeline::highlight::Specular;
use crate::pipeline::opacity::{AlphaMode, Opacity, OpacityMap};
use crate::pipeline::physical::{Map, Physical};
use crate::pipeline::punctual::{Kind, PunctualLight};
use crate::pipeline::shade::Light;
use crate::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_core::angle::{turn_x, turn_y, turn_z};
use rasterproof_core::arrays::MapArray as _;

/// Every such scene. The digests of frames are of the book's scenes alone.
pub const SCENES: &[Entry] = &[
    entry(
        "highlights",
        "spheres with specular light of the exponents 5, 30 and 200 on a matt floor",
        highlights,
    ),
    entry(
        "shadows",
        "a floor in 512 triangles, on it pillars, spheres and a leaf that keep the light from it and from each other",
        shadows,
    ),
    entry(
        "mip-maps",
        "a floor of checks to the horizon and a board, each with a mip map; the board is magnified",
        mip_maps,
    ),
    entry(
        "anisotropy",
        "a floor and a side wall to the horizon read by up to 16 taps, and a wall that faces the eye, which needs one",
        anisotropy,
    ),
    entry("fog", "two rows of pillars into the distance, in fog from 4 to 12 from the eye", fog),
    entry(
        "cut-outs",
        "leaves before a wall, each a board of 72 triangles with a leaf cut out of it by its opacities",
        cut_outs,
    ),
    entry(
        "panes",
        "three panes of coloured glass in frames, each with a round hole, before and behind spheres",
        panes,
    ),
    entry(
        "layers",
        "panes that cross, balls of glass and a pane that stands alone, of which a pixel shows at most four layers",
        layers,
    ),
    entry(
        "metal",
        "spheres of plastic, copper and gold from smooth to rough before a board whose map has fields of metal, in linear light",
        metal,
    ),
    entry(
        "surfaces",
        "a wall with bumps in its middle, grooves that keep ambient light, lamps that emit and a turning box of the same",
        surfaces,
    ),
    entry(
        "lights",
        "spheres before a wall in a dark room: a cone from above, a red and a blue point that reach only what is near, and moonlight",
        lights,
    ),
];

fn shadows(scene: Scene, turn: f64) -> Scene {
    let floor = board(DVec3::new(0.0, -1.3, 6.0), 10.0, 16);
    let texture = Arc::new(textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat));
    let checks =
        Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    let floor = turned(Item::new(floor, checks), DVec3::new(0.0, -1.3, 6.0), turn_x(TAU / 4.0));
    let mut items = vec![floor];
    let texture = Arc::new(textures::boards().with(Filter::Bilinear, Wrap::Clamp));
    let boards =
        Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    for number in 0..3 {
        let centre = DVec3::new(1.3 * f64::from(number) - 2.2, -0.6, 4.3 + f64::from(number));
        let reach = DVec3::new(0.18, 0.7, 0.18);
        let pillar = Item::new(shapes::cuboid(centre - reach, centre + reach), boards.clone());
        let turned = turned(pillar, centre, turn_y(0.4 + turn * TAU));
        items.push(Item { cull: Cull::Clockwise, ..turned });
    }
    for (place, radius, shading) in [
        (DVec3::new(-0.2, -0.1, 3.8), 0.42, Shading::Phong),
        (DVec3::new(1.7, -0.75, 4.4), 0.55, Shading::Flat),
    ] {
        let specular = Specular { colour: DVec3::splat(0.6), shininess: 30.0 };
        let colour = DVec3::new(0.85, 0.45, 0.25);
        let material = Material { colour, specular, shading, ..Material::default() };
        let sphere = Item::new(shapes::sphere(place, radius, 28, 14), material);
        items.push(Item { cull: Cull::Clockwise, ..sphere });
    }
    let leaf = leaf();
    let place = DVec3::new(0.9, 0.35, 5.0);
    let leaf = Item::new(board(place, 1.4, 6), leaf);
    items.push(turned(leaf, place, turn_y(turn * TAU) * turn_x(0.9)));
    let shadows = Some(Shadows::default());
    Scene { light: daylight(), shadows, ..with(scene, items) }
}

fn highlights(scene: Scene, turn: f64) -> Scene {
    let mut floor = shapes::quad([
        DVec3::new(-9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 18.0),
        DVec3::new(-9.0, -1.3, 18.0),
    ]);
    floor.triangles.change_corners(|corner| corner.uv *= 4.0);
    let texture = Arc::new(textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat));
    let matt = Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    let mut items = vec![Item::new(floor, matt)];
    for (i, (colour, shininess)) in [
        (DVec3::new(0.75, 0.20, 0.16), 5.0),
        (DVec3::new(0.20, 0.50, 0.28), 30.0),
        (DVec3::new(0.22, 0.30, 0.62), 200.0),
    ]
    .into_iter()
    .enumerate()
    {
        let centre = AHEAD + DVec3::new(2.1 * (i as f64 - 1.0), -0.3, 0.8);
        let specular = Specular { colour: DVec3::splat(0.9), shininess };
        let material =
            Material { colour, specular, shading: Shading::Phong, ..Material::default() };
        let sphere = Item::new(shapes::sphere(centre, 1.0, 48, 24), material);
        items.push(Item { cull: Cull::Clockwise, ..turned(sphere, AHEAD, turn_y(turn * TAU)) });
    }
    Scene { light: daylight(), ..with(scene, items) }
}

fn fog(scene: Scene, turn: f64) -> Scene {
    let background = [196, 204, 214, u8::MAX];
    let [r, g, b, _] = background;
    let growth = Growth::Linear { start: 4.0, end: 12.0 };
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.0, 1.5),
        DVec3::new(9.0, -1.0, 1.5),
        DVec3::new(9.0, -1.0, 12.0),
        DVec3::new(-9.0, -1.0, 12.0),
    ]);
    let green = Material {
        colour: DVec3::new(0.42, 0.50, 0.34),
        shading: Shading::Phong,
        ..Material::default()
    };
    let mut items = vec![Item::new(floor, green)];
    let texture = Arc::new(textures::boards().with(Filter::Bilinear, Wrap::Clamp));
    let boards =
        Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    for row in 0..8 {
        for side in [-1.0, 1.0] {
            let centre = DVec3::new(1.3 * side, -0.1, 2.6 + 1.7 * f64::from(row));
            let reach = DVec3::new(0.35, 0.9, 0.35);
            let pillar = Item::new(shapes::cuboid(centre - reach, centre + reach), boards.clone());
            let turned = turned(pillar, centre, turn_y(0.3 * side + turn * TAU));
            items.push(Item { cull: Cull::Clockwise, ..turned });
        }
    }
    let fog = Some(Fog { colour: [r, g, b], growth });
    Scene { light: daylight(), fog, background, ..with(scene, items) }
}

/// A board of `parts` x `parts` squares about a centre, with a texture over all of it.
fn board(centre: DVec3, side: f64, parts: u32) -> Mesh {
    patches([parts; 2], |x, y| centre + DVec3::new(x - 0.5, y - 0.5, 0.0) * side)
}

/// A surface of so many columns and rows of patches, with a texture over all of it; from two shares to a position.
fn patches([columns, rows]: [u32; 2], position: impl Fn(f64, f64) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let at = |column: u32, row: u32| {
            position(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows))
        };
        let [left, right, below, above] = [column, column + 1, row, row + 1];
        let mut square =
            shapes::quad([at(left, below), at(right, below), at(right, above), at(left, above)]);
        let first = mesh.positions.len() as u32;
        square.triangles.change_corners(|corner| {
            corner.uv = (corner.uv + DVec2::new(column.into(), row.into()))
                / DVec2::new(columns.into(), rows.into());
            corner.position += first;
        });
        Arc::make_mut(&mut mesh.positions).extend_from_slice(&square.positions);
        mesh.triangles.extend(square.triangles.iter());
    }
    mesh
}

/// A pointed leaf that lies across a square of 128 texels, cut out by an alpha test.
fn leaf() -> Material {
    let place = |column: u32, row: u32| [column, row].map_array(|at| (f64::from(at) - 63.5) / 64.0);
    let reach =
        |x: f64| 0.72 * (1.0 - x * x) * (0.86 + 0.14 * f64::from(((x + 1.0) * 8.0) as u32 % 2));
    let colours = textures::generate(128, |column, row| {
        let [x, y] = place(column, row);
        let vein = y.abs() < 0.04 || ((x + y.abs()) * 7.0).rem_euclid(1.0) < 0.12;
        DVec3::new(0.30, 0.52, 0.20) * if vein { 1.45 } else { 1.0 - 0.25 * y.abs() }
    });
    let alpha = (0..128 * 128).map(|at| {
        let [x, y] = place(at % 128, at / 128);
        // From opaque to clear within a texel and a half.
        (((reach(x) - y.abs()) * 43.0 + 0.5).clamp(0.0, 1.0) * 255.0) as u8
    });
    let alpha = Texture::grey(128, 128, alpha.collect()).expect("128 x 128 texels");
    let [colours, alpha] = [colours, alpha].map_array(|t| t.with(Filter::Bilinear, Wrap::Clamp));
    let opacity = Opacity {
        factor: 1.0,
        map: Some(Arc::new(OpacityMap::new(alpha))),
        mode: AlphaMode::Test { threshold: 0.5 },
    };
    Material {
        texture: Some(Arc::new(colours)),
        opacity: Some(opacity),
        shading: Shading::Phong,
        ..Material::default()
    }
}

fn cut_outs(scene: Scene, turn: f64) -> Scene {
    let at = |x: f64, y: f64| DVec3::new(x, y, 9.0);
    let wall = shapes::quad([at(-6.0, -4.5), at(6.0, -4.5), at(6.0, 4.5), at(-6.0, 4.5)]);
    let boards = Arc::new(textures::boards().with(Filter::Bilinear, Wrap::Clamp));
    let boards = Material { texture: Some(boards), shading: Shading::Phong, ..Material::default() };
    let mut items = vec![Item::new(wall, boards)];
    let leaf = leaf();
    for number in 0..15 {
        let (column, row) = (f64::from(number % 5), f64::from(number / 5));
        let centre = DVec3::new(
            1.15 * (column - 2.0),
            1.1 * (row - 1.0),
            4.0 + 0.4 * ((column * 2.0 + row) % 5.0),
        );
        let item = Item::new(board(centre, 1.7, 6), leaf.clone());
        let tilt = turn_z(0.5 * (column - row)) * turn_y(0.35 * (row - column / 2.0) + turn * TAU);
        items.push(turned(item, centre, tilt));
    }
    Scene { light: daylight(), ..with(scene, items) }
}

fn panes(scene: Scene, turn: f64) -> Scene {
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.4, 1.0),
        DVec3::new(9.0, -1.4, 1.0),
        DVec3::new(9.0, -1.4, 18.0),
        DVec3::new(-9.0, -1.4, 18.0),
    ]);
    let checks = Arc::new(textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat));
    let checks = Material { texture: Some(checks), shading: Shading::Phong, ..Material::default() };
    let mut items = vec![Item::new(floor, checks)];
    // From the middle 0 to the border 1: a hole, glass, and a frame.
    let alpha = (0..256 * 256).map(|at| {
        let [x, y] = [at % 256, at / 256].map_array(|at| (f64::from(at) - 127.5) / 127.5);
        match (x * x + y * y, x.abs().max(y.abs())) {
            (square, _) if square < 0.36 * 0.36 => 0,
            (_, reach) if reach > 0.70 => u8::MAX,
            _ => 110,
        }
    });
    let alpha = Texture::grey(256, 256, alpha.collect()).expect("256 x 256 texels");
    let map = Arc::new(OpacityMap::new(alpha.with(Filter::Bilinear, Wrap::Clamp)));
    for (number, colour) in
        [DVec3::new(0.85, 0.25, 0.20), DVec3::new(0.95, 0.80, 0.25), DVec3::new(0.25, 0.45, 0.85)]
            .into_iter()
            .enumerate()
    {
        let step = number as f64;
        // The nearest first, so that the order of drawing is another one.
        let centre = DVec3::new(0.9 * (step - 1.0), 0.25 * (step - 1.0), 3.0 + 1.1 * step);
        let opacity = Some(Opacity { factor: 1.0, map: Some(map.clone()), mode: AlphaMode::Blend });
        let glass = Material { colour, opacity, shading: Shading::Phong, ..Material::default() };
        let pane = Item::new(board(centre, 2.0, 20), glass);
        items.push(turned(pane, centre, turn_y(0.3 * (step - 1.0) + turn * TAU)));
        let grey =
            Material { colour: DVec3::splat(0.7), shading: Shading::Phong, ..Material::default() };
        let ball = centre + DVec3::new(0.45, -0.3, 0.55);
        let ball = Item::new(shapes::sphere(ball, 0.4, 24, 12), grey);
        items.push(Item { cull: Cull::Clockwise, ..ball });
    }
    Scene { light: daylight(), ..with(scene, items) }
}

fn mip_maps(scene: Scene, turn: f64) -> Scene {
    let checks = textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat).with_mip_map();
    let boards = textures::boards().with(Filter::Bilinear, Wrap::Clamp).with_mip_map();
    let material = |texture| Material { texture: Some(Arc::new(texture)), ..Material::default() };
    let mut floor = shapes::quad([
        DVec3::new(-60.0, -1.0, 1.2),
        DVec3::new(60.0, -1.0, 1.2),
        DVec3::new(60.0, -1.0, 19.9),
        DVec3::new(-60.0, -1.0, 19.9),
    ]);
    floor.triangles.change_corners(|corner| corner.uv *= DVec2::new(48.0, 8.0));
    let at = |x: f64, y: f64| AHEAD + DVec3::new(x, y, -1.2);
    let board = shapes::quad([at(-0.7, -0.6), at(0.7, -0.6), at(0.7, 0.8), at(-0.7, 0.8)]);
    let board = turned(Item::new(board, material(boards)), AHEAD, turn_y(turn * TAU));
    with(scene, [Item::new(floor, material(checks)), board])
}

fn anisotropy(scene: Scene, turn: f64) -> Scene {
    let smooth = |texture: Texture| {
        let texture = texture.with(Filter::Bilinear, Wrap::Repeat).with_mip_map();
        let texture = Some(Arc::new(texture.with_anisotropy(16)));
        Material { texture, ..Material::default() }
    };
    let (light, dark) = (DVec3::new(0.92, 0.90, 0.84), DVec3::new(0.22, 0.35, 0.45));
    let fields =
        textures::generate(
            128,
            |column, row| {
                if (column / 16 + row / 16) % 2 == 0 { light } else { dark }
            },
        );
    let (checks, boards) = (smooth(fields), smooth(textures::boards()));
    let item = |mut mesh: Mesh, uv: DVec2, material: &Material| {
        mesh.triangles.change_corners(|corner| corner.uv *= uv);
        Item::new(mesh, material.clone())
    };
    // Rows that grow with the distance.
    let away = |share: f64| 1.2 * libm::pow(12.0, share);
    let floor = patches([8, 12], |x, z| DVec3::new(10.0 * x - 4.0, -1.0, away(z)));
    let side = patches([12, 6], |z, y| DVec3::new(-2.5, 3.0 * y - 1.0, away(z)));
    let back = patches([8, 6], |x, y| DVec3::new(8.5 * x - 2.5, 5.0 * y - 1.0, 11.0));
    let facing = patches([6, 6], |x, y| AHEAD + DVec3::new(1.4 * x - 0.4, 1.4 * y - 0.9, 0.5));
    let facing = item(facing, DVec2::splat(6.0), &boards);
    let turned = turned(facing, AHEAD, turn_y(turn * TAU));
    let items = [
        item(floor, DVec2::new(10.0, 8.0), &checks),
        item(side, DVec2::new(16.0, 4.0), &boards),
        item(back, DVec2::new(10.0, 6.0), &boards),
        turned,
    ];
    with(scene, items)
}

fn layers(scene: Scene, turn: f64) -> Scene {
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.4, 1.0),
        DVec3::new(9.0, -1.4, 1.0),
        DVec3::new(9.0, -1.4, 18.0),
        DVec3::new(-9.0, -1.4, 18.0),
    ]);
    let checks = Arc::new(textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat));
    let checks = Material { texture: Some(checks), shading: Shading::Phong, ..Material::default() };
    let glass = |colour: DVec3, factor: f64| {
        let opacity = Some(Opacity { factor, map: None, mode: AlphaMode::Blend });
        Material { colour, opacity, shading: Shading::Phong, ..Material::default() }
    };
    let [red, yellow, blue] =
        [DVec3::new(0.85, 0.25, 0.20), DVec3::new(0.95, 0.80, 0.25), DVec3::new(0.25, 0.45, 0.85)];
    let mut items = vec![Item::new(floor, checks)];
    // Five panes through one axis.
    let centre = DVec3::new(-1.1, -0.1, 4.6);
    for (number, colour) in [red, yellow, blue, yellow, red].into_iter().enumerate() {
        let pane = Item::new(board(centre, 2.4, 4), glass(colour, 0.45));
        items.push(turned(pane, centre, turn_y(TAU * (turn + 0.03 + 0.1 * number as f64))));
    }
    // Each ball has a far and a near side, and one is in the other.
    let centre = DVec3::new(1.1, -0.5, 4.4);
    for (radius, colour) in [(0.8, blue), (0.45, red)] {
        let ball = shapes::sphere(centre, radius, 24, 12);
        items.push(turned(Item::new(ball, glass(colour, 0.5)), centre, turn_y(turn * TAU)));
    }
    let alone = Item::new(board(DVec3::new(2.3, 1.5, 5.0), 1.6, 4), glass(yellow, 0.5));
    items.push(alone);
    Scene { light: daylight(), layers: NonZeroU32::new(4), ..with(scene, items) }
}

/// As [`daylight`] in linear light.
fn sunlight() -> Light {
    Light { ambient: 0.12, diffuse: 0.88, ..daylight() }
}

/// A surface in linear light, lit in each fragment.
fn physical(colour: DVec3, physical: Physical) -> Material {
    let physical = Some(Arc::new(physical));
    Material { colour, physical, shading: Shading::Phong, ..Material::default() }
}

fn metal(scene: Scene, turn: f64) -> Scene {
    let at = |x: f64, y: f64| DVec3::new(x, y, 6.0);
    let board = shapes::quad([at(-4.0, -3.0), at(4.0, -3.0), at(4.0, 3.0), at(-4.0, 3.0)]);
    // Fields of metal, three rough ones to a smooth one.
    let fields = textures::generate(64, |column, row| {
        let (column, row) = (column / 16, row / 16);
        let is_metal = (column + row) % 2 == 0;
        let roughness = if (column + 2 * row) % 4 == 0 { 0.35 } else { 0.8 };
        DVec3::new(0.0, roughness, if is_metal { 1.0 } else { 0.0 })
    });
    let mut surface = Physical { metal: 1.0, ..Physical::default() };
    let fields = fields.with(Filter::Nearest, Wrap::Repeat);
    surface.maps[Map::Metal as usize] = Some(Arc::new(fields));
    let mut items = vec![Item::new(board, physical(DVec3::new(0.55, 0.6, 0.7), surface))];
    for (row, (colour, metal)) in [
        (DVec3::new(0.6, 0.05, 0.04), 0.0),
        (DVec3::new(0.95, 0.64, 0.54), 1.0),
        (DVec3::new(1.0, 0.77, 0.34), 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        for (column, roughness) in [0.15, 0.4, 0.7, 1.0].into_iter().enumerate() {
            let place = DVec3::new(column as f64 - 1.5, 1.0 - row as f64, 0.0) * 0.95;
            let surface = Physical { metal, roughness, ..Physical::default() };
            let sphere = shapes::sphere(AHEAD + place, 0.42, 24, 12);
            let sphere = Item::new(sphere, physical(colour, surface));
            let turned = turned(sphere, AHEAD, turn_y(turn * TAU));
            items.push(Item { cull: Cull::Clockwise, ..turned });
        }
    }
    Scene { light: sunlight(), ..with(scene, items) }
}

fn lights(scene: Scene, turn: f64) -> Scene {
    let plaster = physical(DVec3::splat(0.6), Physical { roughness: 0.8, ..Physical::default() });
    let wall = Item::new(board(DVec3::new(0.0, 0.0, 7.0), 9.0, 16), plaster.clone());
    let place = DVec3::new(0.0, -1.3, 5.0);
    let floor = Item::new(board(place, 9.0, 16), plaster);
    let mut items = vec![wall, turned(floor, place, turn_x(TAU / 4.0))];
    for (x, roughness, metal) in [(-1.5, 0.5, 0.0), (0.0, 0.35, 1.0), (1.5, 0.25, 0.0)] {
        let surface = Physical { roughness, metal, ..Physical::default() };
        let sphere = shapes::sphere(DVec3::new(x, -0.7, 5.0), 0.6, 32, 16);
        let sphere = Item::new(sphere, physical(DVec3::new(0.8, 0.75, 0.7), surface));
        items.push(Item { cull: Cull::Clockwise, ..sphere });
    }
    let at = |x: f64, y: f64, z: f64| DMat4::from_translation(DVec3::new(x, y, z));
    let spot = Kind::Spot { range: f64::INFINITY, inner_rad: 0.2, outer_rad: 0.35 };
    let point = Kind::Point { range: 2.5 };
    let of = |kind, colour, intensity, place: DMat4| {
        PunctualLight::new(kind, DVec3::from_array(colour), intensity).placed(place)
    };
    // Lights shine along -z: the cone and the moon are turned downwards.
    let punctual = vec![
        of(spot, [1.0, 0.9, 0.7], 40.0, at(0.0, 2.6, 4.0) * turn_y(0.3 * turn) * turn_x(-1.9)),
        of(point, [1.0, 0.1, 0.05], 6.0, at(-2.2, 0.2, 4.2)),
        of(point, [0.1, 0.25, 1.0], 8.0, at(2.3, 0.3, 4.4)),
        of(Kind::Directional, [0.6, 0.7, 1.0], 0.15, turn_x(-0.9) * turn_y(0.6)),
    ];
    let light = Light { ambient: 0.02, diffuse: 0.0, ..daylight() };
    Scene { light, punctual, ..with(scene, items) }
}

fn surfaces(scene: Scene, turn: f64) -> Scene {
    let from_middle = |column: u32, row: u32| {
        [column, row].map_array(|at| (f64::from(at) - 63.5) / 64.0).map_array(|at| (at, at.abs()))
    };
    // Half spheres in the middle; what lies around is flat.
    let bumps = textures::generate(128, |column, row| {
        let [(_, x), (_, y)] = from_middle(column, row);
        let [u, v] = [column, row].map_array(|at| (f64::from(at % 16) - 7.5) / 8.0);
        let height = 1.0 - u * u - v * v;
        if x.max(y) < 0.5 && height > 0.0 {
            (DVec3::new(u, -v, height.sqrt()).normalize() + 1.0) / 2.0
        } else {
            Map::Normal.missing()
        }
    });
    let grooves = textures::generate(128, |column, row| {
        let [(_, x), (_, y)] = from_middle(column, row);
        let is_groove = (0.55..0.65).contains(&x.max(y));
        DVec3::splat(if is_groove { 0.15 } else { 1.0 })
    });
    let lamps = textures::generate(128, |column, row| {
        let [(_, x), (_, y)] = from_middle(column, row);
        let is_lamp = (x - 0.8).powi(2) + (y - 0.8).powi(2) < 0.12 * 0.12;
        if is_lamp { DVec3::new(1.0, 0.8, 0.3) } else { DVec3::ZERO }
    });
    let mut surface = Physical { emission: DVec3::ONE, roughness: 0.6, ..Physical::default() };
    let smooth = |texture: Texture| Some(Arc::new(texture.with(Filter::Bilinear, Wrap::Clamp)));
    surface.maps[Map::Normal as usize] = smooth(bumps);
    surface.maps[Map::Occlusion as usize] = smooth(grooves);
    surface.maps[Map::Emission as usize] = smooth(lamps.decoded());
    let material = physical(DVec3::new(0.5, 0.42, 0.36), surface);
    let place = DVec3::new(0.0, 0.0, 6.0);
    let wall = Item::new(shapes::with_tangents(board(place, 5.5, 16)), material.clone());
    let place = DVec3::new(-0.9, -0.4, 4.0);
    let reach = DVec3::splat(0.55);
    let cube = shapes::with_tangents(shapes::cuboid(place - reach, place + reach));
    let cube = turned(Item::new(cube, material), place, turn_y(0.6 + turn * TAU) * turn_x(0.4));
    let cube = Item { cull: Cull::Clockwise, ..cube };
    Scene { light: sunlight(), ..with(scene, [wall, cube]) }
}
