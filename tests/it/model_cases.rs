//! Each model below `tests/data/models` is a case, and what the reader makes of it is the snapshot beside it: its items with their
//! first triangles and materials, cameras and lights, what is not drawn, warnings, or the error.
//!
//! To add a case, put a file there and run `INSTA_UPDATE=always cargo test --test it model_cases`; then look at the new snapshot.

use std::fs;
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3, DVec4};
use rasterproof_models::{BadFile, LoadOptions, Model, Normals, Origin, Pose, Up};
use rasterproof_render::scene::{Item, Material, Shading};
use serde_json::{Value, to_value};

use crate::snapshots::{each, settings};

pub const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/models");

/// The endings of files that are no models: snapshots, and what models name.
pub const BESIDE: &[&str] =
    &["bin", "bmp", "jpg", "md", "mtl", "new", "png", "snap", "tga", "tiff", "webp"];

/// Triangles of an item that a snapshot shows.
const MOST_SHOWN: usize = 8;

/// The models in this folder and in those below it, by name.
pub fn models_in(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let ending = path.extension().unwrap_or_default().to_str().unwrap();
        if path.is_dir() {
            found.extend(models_in(&path));
        } else if !BESIDE.contains(&ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The options that a file asks for somewhere, as in `# options: gouraud normals-smooth`.
fn options(bytes: &[u8]) -> LoadOptions {
    let mut options =
        LoadOptions { shading: Shading::Phong, up: Some(Up::Y), ..LoadOptions::default() };
    let text = String::from_utf8_lossy(bytes);
    let Some((_, rest)) = text.split_once("options: ") else { return options };
    for word in rest.split(['\n', '"']).next().unwrap().split_whitespace() {
        match word {
            "gouraud" => options.shading = Shading::Gouraud,
            "flat" => options.shading = Shading::Flat,
            "normals-flat" => options.normals = Normals::Flat,
            "normals-smooth" => options.normals = Normals::Smooth,
            _ => panic!("there is no option '{word}'"),
        }
    }
    options
}

pub fn load(path: &Path) -> Result<Model, BadFile> {
    rasterproof_models::load(path, options(&fs::read(path).unwrap()))
}

/// The model of this file below `tests/data/models`.
pub fn case(name: &str) -> Model {
    load(&Path::new(FOLDER).join(name)).unwrap()
}

/// To twelve decimals, since libraries of other machines may round the last bit of a double in another way.
fn number(number: f64) -> String {
    let rounded = if number.abs() < 1e3 { (number * 1e12).round() / 1e12 } else { number };
    let text = format!("{:?}", if rounded == 0.0 { 0.0 } else { rounded });
    text.trim_end_matches(".0").to_owned()
}

fn numbers(all: &[f64]) -> String {
    all.iter().map(|&one| number(one)).collect::<Vec<_>>().join(" ")
}

/// A value in one line. Of a mip map the number of its levels is enough.
fn in_words(value: &Value) -> String {
    match value {
        Value::Number(of) => number(of.as_f64().unwrap()),
        Value::Array(all) => {
            format!("[{}]", all.iter().map(in_words).collect::<Vec<_>>().join(" "))
        }
        Value::Object(fields) => {
            let field = |(name, value): (&String, &Value)| match (name.as_str(), value) {
                ("subtexels" | "anisotropy", _) | (_, Value::Null | Value::Bool(false)) => None,
                ("levels", Value::Array(levels)) => Some(format!("levels {}", levels.len())),
                _ => Some(format!("{name} {}", in_words(value))),
            };
            format!("{{{}}}", fields.iter().filter_map(field).collect::<Vec<_>>().join(", "))
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// What of a material is not as it is by default, with the colours of its textures on the left and on the right.
fn material(of: &Material) -> String {
    let [usual, fields] = [&Material::default(), of].map(|of| to_value(of).unwrap());
    let mut out = String::new();
    for (name, value) in fields.as_object().unwrap() {
        if usual[name] != *value {
            out += &format!("  {name}: {}\n", in_words(value));
        }
    }
    for texture in of.textures() {
        let [left, right] = [0.25, 0.75].map(|u| texture.at(DVec2::new(u, 0.5)).to_array());
        out += &format!("  picture: {} | {}\n", numbers(&left), numbers(&right));
    }
    if let Some(opacity) = of.opacity.as_ref().filter(|opacity| opacity.map.is_some()) {
        let [left, right] = [0.25, 0.75].map(|u| opacity.read(DVec2::new(u, 0.5)));
        out += &format!("  opacities: {left} | {right}\n");
    }
    out
}

/// A property of three corners: once where all have the same, and not at all where it is the usual one.
fn corners<const N: usize>(name: &str, all: [[f64; N]; 3], usual: [f64; N]) -> String {
    if all == [usual; 3] {
        return String::new();
    }
    let words = all.map(|one| numbers(&one));
    let shown = if all == [all[0]; 3] { words[0].clone() } else { words.join(" | ") };
    format!("    {name}: {shown}\n")
}

/// The item with its material, and its first triangles.
fn item(of: &Item, origin: &Origin) -> String {
    let Item { mesh, cull, two_sided, .. } = of;
    let (low, high) = mesh.bounds().unwrap_or_default();
    let mut out = format!(
        "item: {}: {} positions, {} triangles, {} to {}\n  cull {cull:?}, two-sided {two_sided}\n{}",
        origin.place(0),
        mesh.positions.len(),
        mesh.triangles.len(),
        numbers(&low.to_array()),
        numbers(&high.to_array()),
        material(&of.material),
    );
    for (number, triangle) in mesh.triangles.iter().enumerate().take(MOST_SHOWN) {
        let place = |at: u32| numbers(&mesh.positions[at as usize].to_array());
        let words = triangle.map(|corner| place(corner.position)).join(" | ");
        let face = origin.face(number).unwrap();
        let line = origin.lines.get(number).map_or(String::new(), |line| format!(", line {line}"));
        out += &format!("  face {face}{line}: {words}\n");
        out += &corners("normal", triangle.map(|of| of.normal.to_array()), [0.0; 3]);
        out += &corners("uv", triangle.map(|of| of.uv.to_array()), [0.0; 2]);
        if of.material.vertex_colours {
            out += &corners("colour", triangle.map(|of| of.colour.to_array()), [1.0; 3]);
        }
        let (tangents, second) =
            (mesh.triangles.tangents(number), mesh.triangles.second_uvs(number));
        // They are computed in single precision.
        let tangents = tangents.map(|of: DVec4| (of * 1e6).round() / 1e6);
        out += &corners("tangent", tangents.map(|of| of.to_array()), [0.0; 4]);
        out += &corners("second uv", second.map(|of| of.to_array()), [0.0; 2]);
        if let Some(opacity) = of.material.opacity.as_ref() {
            out += &corners("opacity", triangle.map(|of| [opacity.read(of.uv).into()]), [255.0]);
        }
    }
    let more = mesh.triangles.len().saturating_sub(MOST_SHOWN);
    out + &(if more > 0 { format!("  {more} more triangles\n") } else { String::new() })
}

fn describe(model: &Model) -> String {
    let mut out = format!("{:?}, {} items\n", model.format, model.items.len());
    for (of, origin) in model.items.iter().zip(&model.origins) {
        out += &item(of, origin);
    }
    for camera in &model.cameras {
        out += &format!("{camera:?}\n");
    }
    for light in &model.lights {
        out += &format!("{light:?}\n");
    }
    for name in &model.animations {
        out += &format!("animation {name:?}\n");
    }
    for (name, text) in [("not drawn", &model.not_drawn), ("empty, since", &model.why_empty)] {
        if !text.is_empty() {
            out += &format!("{name}: {text}\n");
        }
    }
    for said in &model.warnings {
        out += &format!("warning: {said}\n");
    }
    out
}

/// Every corner names a position, and all of its numbers are finite.
fn is_whole(model: &Model) -> bool {
    let is_whole = |item: &Item| {
        let is_there =
            |at: u32| item.mesh.positions.get(at as usize).is_some_and(|p| p.is_finite());
        item.mesh.triangles.corners().all(|of| {
            let is_finite = of.normal.is_finite() && of.uv.is_finite() && of.colour.is_finite();
            is_there(of.position) && is_finite
        })
    };
    model.items.iter().all(is_whole)
}

#[test]
fn models_are_read_as_their_snapshots_say() {
    let models = models_in(Path::new(FOLDER));
    assert!(models.len() > 240, "{} models", models.len());
    let alone = models.into_iter().filter(|path| !path.starts_with(tetrahedra()));
    each(alone, |path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = match load(&path) {
            Ok(model) => {
                assert!(is_whole(&model), "{name} has corners without positions or numbers");
                describe(&model)
            }
            Err(error) => format!("error: {error}\n"),
        };
        check(path.parent().unwrap(), name, &text);
    });
}

/// A snapshot beside its model, whose messages name files of its folder alone.
fn check(folder: &Path, name: &str, text: &str) {
    let text = text.replace(&format!("{}/", folder.display()), "");
    let mut settings = settings();
    settings.set_snapshot_path(folder);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// Each file of this folder holds the same tetrahedron, in a format or a way of writing of its own.
fn tetrahedra() -> PathBuf {
    Path::new(FOLDER).join("tetrahedron")
}

/// The corners of all triangles in their order.
pub fn places(model: &Model) -> Vec<DVec3> {
    let of = |item: &Item| {
        let corners = item.mesh.triangles.corners();
        corners.map(|of| item.mesh.positions[of.position as usize]).collect::<Vec<_>>()
    };
    model.items.iter().flat_map(of).collect()
}

#[test]
fn each_tetrahedron_is_the_same() {
    let expected = places(&case("tetrahedron/plain.obj"));
    assert_eq!(expected.len(), 12);
    let models = models_in(&tetrahedra());
    for path in &models {
        let model = load(path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(places(&model), expected, "{}", path.display());
    }
    let lines: String = models.iter().map(|path| in_a_line(path)).collect();
    each([lines], |lines| check(Path::new(FOLDER), "tetrahedron", &lines));
}

/// What of a file of that folder may differ from the others.
fn in_a_line(path: &Path) -> String {
    let name = path.file_name().unwrap().to_str().unwrap();
    let model = load(path).unwrap_or_else(|error| panic!("{error}"));
    let parts: Vec<_> =
        model.origins.iter().map(|of| format!("{:?} {:?}", of.part, of.lines)).collect();
    let mut out = format!("{name}: {:?}, {}\n", model.format, parts.join(", "));
    if !model.not_drawn.is_empty() {
        out += &format!("    not drawn: {}\n", model.not_drawn);
    }
    for said in &model.warnings {
        out += &format!("    warning: {said}\n");
    }
    out
}

/// A torus that gltfpack wrote as it is, compressed, and with positions that another filter rounds.
#[test]
fn triangles_that_meshoptimizer_compressed_are_decoded() {
    let corners = |name: &str| {
        let model = case(name);
        let item = &model.items[0];
        let place = |at: u32| item.mesh.positions[at as usize];
        let corners = item.mesh.triangles.corners();
        corners.map(|corner| (place(corner.position), corner.normal, corner.uv)).collect::<Vec<_>>()
    };
    let expected = corners("torus.glb");
    assert_eq!(expected.len(), 3 * 192);
    // Two steps of the 14 bits of a position, of a torus 6 units wide.
    for (name, most) in
        [("torus-meshopt.glb", 0.0), ("torus-meshopt-float.glb", 12.0 / f64::from(1 << 14))]
    {
        let decoded = corners(name);
        assert_eq!(decoded.len(), expected.len());
        // The order of the triangles may differ, and normals have 8 bits.
        for (p, n, uv) in decoded {
            let is_near = |(q, m, vw): &(DVec3, DVec3, DVec2)| {
                p.distance(*q) <= most && n.dot(*m) > 0.99 && uv == *vw
            };
            assert!(expected.iter().any(is_near), "{p} {n} {uv}");
        }
    }
}

/// A node at moments of its animation, by each way of interpolating, computed by hand.
#[test]
fn an_animation_brings_nodes_to_where_they_are() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let path = Path::new(FOLDER).join("gltf/animations.gltf");
    let at = |animation: usize, time_s: f64| {
        let pose = Some(Pose { animation, time_s });
        rasterproof_models::load(&path, LoadOptions { pose, ..LoadOptions::default() })
    };
    // The origin, and one unit along x.
    for (animation, time, origin, x) in [
        (0, 0.0, [0.0, 0.0], [1.0, 0.0]),
        (0, 1.5, [1.0, 0.0], [2.0, 0.0]),
        (0, 2.0, [2.0, 0.0], [3.0, 0.0]),
        (0, 3.5, [2.0, 3.0], [3.0, 3.0]),
        (0, 9.0, [2.0, 4.0], [3.0, 4.0]),
        (1, 1.9, [0.0, 0.0], [1.0, 0.0]),
        (1, 2.0, [2.0, 0.0], [3.0, 0.0]),
        (2, 1.5, [0.0, 0.0], [half.into(), half.into()]),
        (2, 3.0, [0.0, 0.0], [0.0, 1.0]),
        // Halfway: 1/2 + 2/8 + 3/2.
        (3, 1.5, [0.0, 0.0], [2.25, 0.0]),
    ] {
        let model = at(animation, time).unwrap();
        let found = [0, 1].map(|i| model.items[0].mesh.positions[i]);
        for (found, [x, y]) in found.into_iter().zip([origin, x]) {
            assert!(found.distance(DVec3::new(x, y, 0.0)) < 1e-6, "{animation} {time}: {found}");
        }
        assert_eq!(model.not_drawn, "");
        assert_eq!((model.animations.len(), &*model.animations[1]), (7, "translation STEP"));
    }
    let still = rasterproof_models::load(&path, LoadOptions::default()).unwrap();
    assert_eq!(still.items[0].mesh.positions[0].to_array(), [7.0, 7.0, -7.0]);
    for (animation, cause) in [
        (4, "animations[4]: accessors[6] has 1 numbers where 3 are needed"),
        (5, "animations[5]: missing field `channels`"),
        (6, "animations[6]: accessors[7] has a time that is no finite number"),
        (7, "has the animations 1 to 7, and not 8"),
    ] {
        let error = at(animation, 1.0).unwrap_err().to_string();
        assert!(error.contains(cause), "{error}");
    }
}
