//! Models that are small as files and large in memory or time: each is drawn or refused with a message, by every command
//! that takes a model, within 2 GiB and 20 seconds of processor time.
//!
//! `RASTERPROOF_FUZZ=FROM,TO cargo test --test it fuzz_of_models -- --ignored --nocapture` runs the models of these
//! numbers; a number gives the same model everywhere. Processes of this test run many models each. What ends one of them, or takes
//! too long in it, runs once more as a process of its own, and that decides.

use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::Range;
use std::path::Path;
use std::process::Command;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ColorType, DynamicImage, GrayImage, ImageFormat, Luma, Rgba, RgbaImage};
use serde_json::{Value, json};

use rasterproof::cli::{self, Delivery, Streams};
use rasterproof_core::angle::{cos, sin};
use rasterproof_core::random::Rng;

use crate::model_files::below;
use crate::program::{Folder, PROGRAM, Run, encoded};

/// Runs the program with at most so many MiB of memory and 20 seconds of processor time.
fn within(mib: u32, folder: &Path, words: &[&str]) -> Run {
    let mut command = Command::new("sh");
    let limits =
        format!("ulimit -v {} && ulimit -t 20 && ulimit -c 0 && exec \"$0\" \"$@\"", mib << 10);
    command.args(["-c", &limits, PROGRAM]).args(words).current_dir(folder);
    command.stdin(std::process::Stdio::null()).env_remove("COLUMNS");
    Run::of(&mut command)
}

fn bounded(folder: &Path, words: &[&str]) -> Run {
    within(2048, folder, words)
}

/// The commands that take a model, each with these options; `inspect` is given its first face.
fn commands<'a>(model: &'a str, face: &'a str, options: &'a str) -> [Vec<&'a str>; 6] {
    let options = ["--size", "24x18"].into_iter().chain(options.split_whitespace());
    [
        vec!["render", model, "-o", "drawn.png"],
        vec!["plan", model, "--rounds", "1", "--whole"],
        vec!["verify", model],
        vec!["inspect", face],
        vec!["study", model, "--once"],
        vec!["cost", model, "--once"],
    ]
    .map(|words| words.into_iter().chain(options.clone()).collect())
}

/// Options that all commands take.
const OPTIONS: [&str; 12] = [
    "",
    "",
    "",
    "",
    "--aa msaa4",
    "--aa ssaa2 --depth f32-reversed",
    "--mip-maps --anisotropy 8 --shading gouraud",
    "--shadows 64 --specular 0.5,20",
    "--opacity 0.5 --layers 3 --fog 0,1",
    "--alpha-threshold 0.3 --cull cw --shading flat",
    "--zoom 9 --fov 100 --up z --normals smooth",
    "--yaw 77 --pitch 0 --cull ccw --normals flat --shading unlit",
];

/// Whether a run ended in one of the ways in which commands end: a panic has another status, and a limit ends by a signal.
fn is_well(run: &Run) -> bool {
    matches!(run.status, Some(0..=2)) && !run.errors.contains("panicked")
}

fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
    encoded(picture, ImageFormat::Png).unwrap()
}

/// Pictures for materials: of all sizes, with opacities and without, and broken ones.
fn pictures() -> Vec<(&'static str, Vec<u8>)> {
    let speckled = |x: u32, y: u32| {
        let byte = (x.wrapping_mul(97) ^ y.wrapping_mul(57)) as u8;
        Rgba([byte, byte.rotate_left(3), 90, if byte > 99 { 255 } else { byte }])
    };
    let good = png(RgbaImage::from_fn(13, 7, speckled));
    let mut cut = good.clone();
    cut.truncate(good.len() / 2);
    vec![
        ("a.png", good),
        ("wide.png", png(GrayImage::from_pixel(4096, 1, Luma([77])))),
        ("large.png", png(GrayImage::from_pixel(2048, 1024, Luma([200])))),
        ("cut.png", cut),
        ("one.png", png(RgbaImage::from_pixel(1, 1, Rgba([255, 0, 0, 128])))),
        ("text.png", b"no picture".to_vec()),
    ]
}

/// A picture of any kind of pixels, mostly of odd sides.
fn picture(rng: &mut Rng) -> Vec<u8> {
    let sides = [0; 2].map(|_| {
        let most = pick(rng, &[1, 3, 9, 64]);
        1 + below(rng, most) as u32
    });
    let [width, height] = sides;
    let noise = RgbaImage::from_fn(width, height, |_, _| Rgba((rng.next() as u32).to_le_bytes()));
    let noise = DynamicImage::from(noise);
    use ColorType::{L8, L16, La8, La16, Rgb8, Rgb16, Rgba8, Rgba16};
    let picture = match pick(rng, &[L8, La8, Rgb8, Rgba8, L16, La16, Rgb16, Rgba16]) {
        L8 => noise.into_luma8().into(),
        La8 => noise.into_luma_alpha8().into(),
        Rgb8 => noise.into_rgb8().into(),
        L16 => noise.into_luma16().into(),
        La16 => noise.into_luma_alpha16().into(),
        Rgb16 => noise.into_rgb16().into(),
        Rgba16 => noise.into_rgba16().into(),
        _ => noise,
    };
    let format =
        pick(rng, &[ImageFormat::Png, ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tiff]);
    // Not every format has every kind of pixels.
    encoded(picture, format).unwrap_or_default()
}

/// The most bytes of a model.
const MOST_BYTES: usize = 1 << 16;

/// Positions and polygons, as all formats have them.
struct Shape {
    positions: Vec<[f64; 3]>,
    polygons: Vec<Vec<usize>>,
}

fn pick<T: Copy>(rng: &mut Rng, all: &[T]) -> T {
    all[below(rng, all.len())]
}

/// A number whose size is anything that a double can be, mostly a usual one.
fn size(rng: &mut Rng) -> f64 {
    match below(rng, 8) {
        0 => (1.0 + rng.unit()) * 10f64.powi(rng.int(-320, 300) as i32),
        1 => (1.0 + rng.unit()) * 10f64.powi(rng.int(-45, 39) as i32),
        2 => pick(rng, &[1e38, 1e-40, 1e-75, 5e-324, 1e19, 1e-20]),
        _ => (1.0 + rng.unit()) * 10f64.powi(rng.int(-3, 2) as i32),
    }
}

fn shape(rng: &mut Rng) -> Shape {
    // Few faces take as little time as many take much, and most mistakes need few.
    let most =
        pick(rng, &[4, 4, 4, 4, 4, 4, 12, 12, 12, 12, 12, 12, 12, 40, 40, 40, 40, 120, 120, 700]);
    let count = 1 + below(rng, most);
    let kind = below(rng, 8);
    let point = |rng: &mut Rng| [rng.signed(), rng.signed(), rng.signed()];
    let (mut positions, mut polygons) = (Vec::new(), Vec::new());
    match kind {
        // A soup of triangles.
        0 | 1 => {
            positions.extend((0..3 * count).map(|_| point(rng)));
            polygons.extend((0..count).map(|i| vec![3 * i, 3 * i + 1, 3 * i + 2]));
        }
        // Squares one behind the other, in one plane or nearly so.
        2 => {
            let step = pick(rng, &[0.0, 1e-12, 1e-3]);
            for i in 0..count {
                let z = step * i as f64;
                let square = [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
                positions.extend(square);
                polygons.push((4 * i..4 * i + 4).collect());
            }
        }
        // One polygon that crosses itself.
        3 => {
            let flat = rng.chance(2);
            let corners = 3 + 3 * count;
            positions.extend((0..corners).map(|_| {
                let [x, y, z] = point(rng);
                [x, y, if flat { 0.0 } else { z * 1e-3 }]
            }));
            polygons.push((0..corners).collect());
        }
        // A star or a circle, several times.
        4 => {
            let inner = pick(rng, &[1.0, 0.999, 0.3]);
            let corners = 3 + count;
            positions.extend((0..corners).map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / corners as f64;
                let radius = if i % 2 == 0 { 1.0 } else { inner };
                [radius * cos(angle), radius * sin(angle), 0.0]
            }));
            let copies = 1 + below(rng, 8);
            polygons.extend((0..copies).map(|_| (0..corners).collect()));
        }
        // Triangles between few positions: most of them are there twice, or have no area.
        5 => {
            let few = 1 + below(rng, 9);
            positions.extend((0..few).map(|_| point(rng)));
            let triangle = |rng: &mut Rng| (0..3).map(|_| below(rng, few)).collect();
            polygons.extend((0..3 * count).map(|_| triangle(rng)));
        }
        // Needles.
        6 => {
            for i in 0..count {
                let [a, b] = [point(rng), point(rng)];
                let beside = [b[0] + 1e-7, b[1], b[2] - 1e-7];
                positions.extend([a, b, beside]);
                polygons.push(vec![3 * i, 3 * i + 1, 3 * i + 2]);
            }
        }
        // A grid.
        _ => {
            let side = 2 + below(rng, 24);
            for i in 0..side * side {
                let (x, y) = ((i % side) as f64, (i / side) as f64);
                positions.push([x, y, sin(x * y * 0.1)]);
                if i % side > 0 && i >= side {
                    polygons.push(vec![i, i - 1, i - side - 1, i - side]);
                }
            }
        }
    }
    let scale = [size(rng); 3].map(|all| if below(rng, 9) == 0 { size(rng) } else { all });
    let offset = [0; 3].map(|_| if below(rng, 6) == 0 { size(rng) } else { 0.0 });
    for position in &mut positions {
        for axis in 0..3 {
            position[axis] = position[axis] * scale[axis] + offset[axis];
        }
    }
    if rng.chance(8) {
        for _ in 0..1 + below(rng, 3) {
            let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e39, -0.0, 1e-320];
            let (number, axis) = (below(rng, positions.len()), below(rng, 3));
            positions[number][axis] = pick(rng, &odd);
        }
    }
    Shape { positions, polygons }
}

/// What materials name: mostly the picture of the model.
const MAPS: [&str; 9] =
    ["t.png", "t.png", "t.png", "a.png", "wide.png", "large.png", "cut.png", "one.png", "text.png"];

/// Texture coordinates near and far.
fn uv(rng: &mut Rng, scale: f64) -> [f64; 2] {
    [rng.signed() * scale, rng.signed() * scale]
}

/// A text as other programs may write it: with other ends of lines, capitals, commas, marks. Most stay as they are.
fn spelled(text: String, rng: &mut Rng) -> Vec<u8> {
    let text = match below(rng, 24) {
        0 => text.replace('\n', "\r\n"),
        1 => text.replace('\n', "\r"),
        2 => {
            let mut mixed = String::new();
            for line in text.lines() {
                mixed += line;
                mixed += pick(rng, &["\n", "\r\n", "\r", "\n\n", " # end\n", "\t\n"]);
            }
            mixed
        }
        3 => text.to_uppercase(),
        4 => text.replace('.', ","),
        5 => text.replace(' ', "  \t"),
        6 => text.replacen(' ', " \\\n ", 3),
        7 => format!("\u{feff}{text}"),
        8 => text.replace('\n', " "),
        9 => text.replace("e-", "D-"),
        10 => text.trim_end().to_owned(),
        _ => text,
    };
    text.into_bytes()
}

fn obj(rng: &mut Rng) -> Vec<(&'static str, Vec<u8>)> {
    let Shape { positions, polygons } = shape(rng);
    let mut mtl = String::new();
    let names = ["red", "map", "glass", "cut"];
    for name in names {
        let _ = writeln!(mtl, "newmtl {name}\nKd {} 0.5 1", rng.unit());
        let map = pick(rng, &MAPS);
        let option = pick(rng, &["", "-clamp on ", "-s 3 9 ", "-o 0.1 1e9 ", "-mm 0 1 "]);
        if rng.chance(2) {
            let _ = writeln!(mtl, "map_Kd {option}{map}");
        }
        match below(rng, 6) {
            0 => mtl += &format!("d {}\n", rng.unit()),
            1 => mtl += &format!("map_d {map}\n"),
            2 => mtl += &format!("Ks 1 1 1\nNs {}\n", size(rng)),
            3 => mtl += "d 0\nillum 4\n",
            _ => {}
        }
    }
    let mut text = "mtllib m.mtl\n".to_owned();
    for [x, y, z] in &positions {
        let colour = if rng.chance(9) { " 1 0 .5" } else { "" };
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}{colour}");
    }
    let far = pick(rng, &[1.0, 4.0, 1e7, 1e30, 1e300]);
    for _ in 0..4 {
        let [u, v] = uv(rng, far);
        let _ = writeln!(text, "vt {u:?} {v:?}\nvn {} {} 1", rng.signed(), rng.signed());
    }
    let groups = rng.chance(3);
    for polygon in &polygons {
        if groups || rng.chance(30) {
            let name = pick(rng, &names);
            let _ = writeln!(text, "g {name}\nusemtl {name}\ns {}", below(rng, 3));
        }
        text.push('f');
        for corner in polygon {
            let _ = match below(rng, 12) {
                0 => write!(text, " {}//{}", corner + 1, 1 + below(rng, 4)),
                1 => write!(text, " {}/{}/{}", corner + 1, below(rng, 6), below(rng, 6)),
                2 if rng.chance(99) => write!(text, " {}/1/-1", below(rng, positions.len() + 3)),
                _ => write!(text, " {}/{}", corner + 1, 1 + below(rng, 4)),
            };
        }
        text.push('\n');
    }
    vec![("m.obj", spelled(text, rng)), ("m.mtl", spelled(mtl, rng)), ("t.png", picture(rng))]
}

fn ply(rng: &mut Rng) -> Vec<(&'static str, Vec<u8>)> {
    let Shape { positions, polygons } = shape(rng);
    let form = pick(rng, &["ascii", "ascii", "binary_little_endian", "binary_big_endian"]);
    let huge = pick(rng, &[4_294_967_295_u64, 1 << 40, u64::MAX, 1 << 31]);
    let count = |rng: &mut Rng, right: usize| if rng.chance(25) { huge } else { right as u64 };
    let [vertices, faces] = [positions.len(), polygons.len()].map(|all| count(rng, all));
    let odd = if rng.chance(25) { format!("element odd {huge}\n") } else { String::new() };
    // What a vertex has beside its position, as bytes or as numbers.
    let more =
        pick(rng, &["", "", "red green blue", "red green blue alpha", "nx ny nz", "s t", "odd"]);
    let of_more = pick(rng, &["uchar", "float", "double", "int64", "ushort"]);
    let of_corner = pick(rng, &["uint", "int", "uint64", "ushort", "float"]);
    let texture = if more == "s t" { "comment TextureFile t.png\n" } else { "" };
    let mut head = format!("ply\nformat {form} 1.0\n{texture}");
    let mut of_vertices = format!("element vertex {vertices}\n");
    for name in ["x", "y", "z"] {
        of_vertices += &format!("property double {name}\n");
    }
    more.split_whitespace().for_each(|name| of_vertices += &format!("property {of_more} {name}\n"));
    let of_faces = format!("element face {faces}\nproperty list uint {of_corner} vertex_indices\n");
    let is_first = rng.chance(6);
    let [first, second] =
        if is_first { [&of_faces, &of_vertices] } else { [&of_vertices, &of_faces] };
    head += &format!("{first}{odd}{second}end_header\n");
    let put = |bytes: &mut Vec<u8>, kind: &str, number: f64| {
        if form == "ascii" {
            return bytes.extend(format!("{number:?} ").replace(".0 ", " ").bytes());
        }
        let mut word = match kind {
            "uchar" => vec![number as u8],
            "ushort" => (number as u16).to_le_bytes().to_vec(),
            "uint" | "int" => (number as u32).to_le_bytes().to_vec(),
            "int64" | "uint64" => (number as i64).to_le_bytes().to_vec(),
            "float" => (number as f32).to_le_bytes().to_vec(),
            _ => number.to_le_bytes().to_vec(),
        };
        if form.contains("big") {
            word.reverse();
        }
        bytes.append(&mut word);
    };
    let end = if form == "ascii" { &b"\n"[..] } else { b"" };
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for position in &positions {
        position.iter().for_each(|&number| put(&mut vertices, "double", number));
        for _ in more.split_whitespace() {
            let value = if of_more == "float" { rng.signed() } else { below(rng, 300) as f64 };
            put(&mut vertices, of_more, value);
        }
        vertices.extend(end);
    }
    for polygon in &polygons {
        put(&mut faces, "uint", polygon.len() as f64);
        polygon.iter().for_each(|&corner| put(&mut faces, of_corner, corner as f64));
        faces.extend(end);
    }
    let all = if is_first { [faces, vertices] } else { [vertices, faces] }.concat();
    let bytes = match form {
        "ascii" => spelled(head + &String::from_utf8(all).unwrap_or_default(), rng),
        _ if rng.chance(8) => [head.replace('\n', "\r\n").into_bytes(), all].concat(),
        _ => [head.into_bytes(), all].concat(),
    };
    vec![("m.ply", bytes), ("t.png", picture(rng))]
}

fn triangles(shape: &Shape) -> Vec<[[f64; 3]; 3]> {
    let fan = |polygon: &Vec<usize>| {
        let at = |corner: usize| shape.positions[polygon[corner]];
        (1..polygon.len().saturating_sub(1)).map(|i| [at(0), at(i), at(i + 1)]).collect::<Vec<_>>()
    };
    shape.polygons.iter().flat_map(fan).collect()
}

fn stl(rng: &mut Rng) -> Vec<(&'static str, Vec<u8>)> {
    let triangles = triangles(&shape(rng));
    if rng.chance(2) {
        let mut text = String::new();
        for triangle in &triangles {
            if text.is_empty() || rng.chance(6) {
                text += "solid x\n";
            }
            text += "facet normal 0 0 1\nouter loop\n";
            for [x, y, z] in triangle {
                let _ = writeln!(text, "vertex {x:e} {y:e} {z:e}");
            }
            text += "endloop\nendfacet\n";
        }
        return vec![("m.stl", spelled(text + "endsolid x\n", rng))];
    }
    let mut bytes = vec![0; 80];
    let count = if rng.chance(12) { u32::MAX } else { triangles.len() as u32 };
    bytes.extend(count.to_le_bytes());
    for triangle in &triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    vec![("m.stl", bytes)]
}

fn gltf(rng: &mut Rng) -> Vec<(&'static str, Vec<u8>)> {
    let shape = shape(rng);
    let corners = triangles(&shape);
    let mut bin: Vec<u8> = Vec::new();
    for position in &shape.positions {
        bin.extend(position.iter().flat_map(|x| (*x as f32).to_le_bytes()));
    }
    let of_uvs = bin.len();
    let far = pick(rng, &[1.0, 1e9, 1e38]);
    for _ in &shape.positions {
        bin.extend(uv(rng, far).iter().flat_map(|x| (*x as f32).to_le_bytes()));
    }
    let of_indices = bin.len();
    let fans = shape.polygons.iter().flat_map(|polygon| {
        (1..polygon.len().saturating_sub(1)).flat_map(|i| [polygon[0], polygon[i], polygon[i + 1]])
    });
    bin.extend(fans.flat_map(|index| (index as u16).to_le_bytes()));
    let huge = pick(rng, &[1u64 << 24, (1 << 24) + 1, u64::MAX, 1 << 32]);
    let positions = json!({"bufferView": 0, "componentType": 5126, "count": shape.positions.len(), "type": "VEC3"});
    let positions = match rng.chance(20) {
        // Zeros without bytes.
        true => json!({"componentType": 5126, "count": huge, "type": "VEC3"}),
        false => positions,
    };
    let mut primitive = json!({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0});
    primitive["mode"] = pick(rng, &[4, 4, 4, 5, 6, 0]).into();
    if !rng.chance(5) {
        primitive["indices"] = 2.into();
    }
    let primitives = pick(rng, &[1, 1, 1, 1, 1, 3, 3, 60]);
    let meshes = json!([{"primitives": vec![primitive; primitives]}]);
    // Nodes that show the nodes before them, several times or in a long row.
    let mut nodes = vec![json!({"mesh": 0})];
    let is_deep = rng.chance(8);
    let most = if is_deep { pick(rng, &[100, 900]) } else { 5 };
    let levels = below(rng, most);
    let mut shown = primitives;
    for level in 0..levels {
        let copies = if is_deep { 1 } else { pick(rng, &[1, 1, 2, 3, 10, 100, 1000]) };
        // What is drawn thousands of times takes seconds for each frame, and what is not drawn no time.
        let copies = if (2_000..2_000_000).contains(&(shown * copies)) { 1 } else { copies };
        shown *= copies;
        let mut node = json!({"children": vec![level; copies]});
        match below(rng, if is_deep { 99 } else { 5 }) {
            0 => node["scale"] = json!([size(rng) as f32, 1.0, -1.0]),
            1 => node["translation"] = json!([size(rng) as f32, 0.0, 0.5]),
            2 => node["rotation"] = json!([rng.unit(), rng.unit(), 0.0, 0.1]),
            3 => node["matrix"] = json!([0; 16].map(|_| size(rng) as f32)),
            _ => {}
        }
        nodes.push(node);
    }
    let image = |rng: &mut Rng| match rng.chance(2) {
        true => {
            json!({"uri": pick(rng, &["t.png", " t.png", "T.PNG?v=1", "a.png", "large.png", "wide.png", "cut.png", "none.png"])})
        }
        false => json!({"bufferView": below(rng, 3), "mimeType": "image/png"}),
    };
    let images: Vec<Value> = (0..1 + below(rng, 6)).map(|_| image(rng)).collect();
    let sampler =
        json!({"minFilter": pick(rng, &[9728, 9984, 9987]), "wrapS": pick(rng, &[10497, 33071])});
    let mut root = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [nodes.len() - 1]}], "nodes": nodes, "meshes": meshes,
        "materials": [{"alphaMode": pick(rng, &["OPAQUE", "MASK", "BLEND"]), "pbrMetallicRoughness": {
            "baseColorTexture": {"index": 0}, "baseColorFactor": [1, rng.unit(), 1, rng.unit()]}}],
        "textures": [{"source": below(rng, images.len()), "sampler": 0}], "samplers": [sampler], "images": images,
        "accessors": [positions,
            {"bufferView": 1, "componentType": 5126, "count": shape.positions.len(), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 3 * corners.len(), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": of_uvs},
            {"buffer": 0, "byteOffset": of_uvs, "byteLength": of_indices - of_uvs},
            {"buffer": 0, "byteOffset": of_indices, "byteLength": bin.len() - of_indices}],
        "buffers": [{"byteLength": bin.len()}],
    });
    for _ in 0..pick(rng, &[0, 0, 1, 1, 2, 4]) {
        extend(&mut root, &mut bin, rng);
    }
    if rng.chance(2) {
        let data = STANDARD.encode(&bin);
        let head =
            pick(rng, &["application/octet-stream;base64", ";BASE64", "a/b;base64;charset=utf-8"]);
        root["buffers"][0]["uri"] = format!("data:{head},{data}").into();
        return vec![("m.gltf", root.to_string().into_bytes()), ("t.png", picture(rng))];
    }
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF".to_vec();
    let words =
        |words: &[usize]| words.iter().flat_map(|w| (*w as u32).to_le_bytes()).collect::<Vec<_>>();
    bytes.extend(words(&[2, 12 + 8 + json.len() + 8 + bin.len(), json.len()]));
    bytes.extend(b"JSON".iter().chain(&json));
    bytes.extend(words(&[bin.len()]));
    bytes.extend(b"BIN\0".iter().chain(&bin));
    vec![("m.glb", bytes), ("t.png", picture(rng))]
}

/// Adds to a document what only some documents have, right or wrong.
fn extend(root: &mut Value, bin: &mut Vec<u8>, rng: &mut Rng) {
    let any = |rng: &mut Rng| below(rng, 4);
    let count = pick(rng, &[0, 1, 3, 1000, 1 << 24, 1 << 40]);
    let primitive = &mut root["meshes"][0]["primitives"][0];
    match below(rng, 14) {
        0 => {
            let names = json!(["KHR_odd", "KHR_draco_mesh_compression", "EXT_meshopt_compression"]);
            root["extensionsRequired"] = json!([names[below(rng, 3)]]);
        }
        // Triangles that Draco compressed, mostly with some other bytes, and bytes that are none.
        1 | 2 => {
            let start = bin.len();
            match rng.chance(5) {
                true => bin.extend((0..below(rng, 400)).map(|_| rng.next() as u8)),
                false => bin.extend(STANDARD.decode(DRACO).unwrap()),
            }
            for _ in 0..below(rng, 4).min(bin.len() - start) {
                let at = start + below(rng, bin.len() - start);
                bin[at] = rng.next() as u8 & pick(rng, &[1, 15, 255]);
            }
            let view = json!({"buffer": 0, "byteOffset": start, "byteLength": bin.len() - start});
            let views = root["bufferViews"].as_array_mut().unwrap();
            views.push(view);
            let attributes = json!({"POSITION": 0, "TEXCOORD_0": 1});
            let draco = json!({"bufferView": views.len() - 1, "attributes": attributes});
            root["meshes"][0]["primitives"][0]["extensions"] =
                json!({"KHR_draco_mesh_compression": draco});
        }
        3 => {
            primitive["attributes"]["JOINTS_0"] = any(rng).into();
            primitive["attributes"]["WEIGHTS_0"] = any(rng).into();
            root["skins"] =
                json!([{"joints": vec![0; count.min(1000)], "inverseBindMatrices": any(rng)}]);
            root["nodes"][0]["skin"] = 0.into();
        }
        4 => {
            primitive["targets"] =
                json!(vec![json!({"POSITION": any(rng), "NORMAL": any(rng)}); count.min(99)]);
            root["meshes"][0]["weights"] = json!([rng.signed(), size(rng) as f32]);
        }
        5 => {
            let part = |rng: &mut Rng| json!({"bufferView": any(rng), "byteOffset": below(rng, 9), "componentType": 5121 + any(rng)});
            root["accessors"][below(rng, 3)]["sparse"] =
                json!({"count": count, "indices": part(rng), "values": part(rng)});
        }
        6 => root["accessors"][below(rng, 3)]["componentType"] = (5120 + below(rng, 7)).into(),
        7 => {
            root["accessors"][below(rng, 3)]["normalized"] = true.into();
            root["bufferViews"][below(rng, 3)]["byteStride"] =
                pick(rng, &[0, 1, 5, 12, 4096]).into();
        }
        8 => {
            let [u, v] = [size(rng) as f32, size(rng) as f32];
            let transform =
                json!({"scale": [u, 2.0], "offset": [0.5, v], "rotation": size(rng) as f32});
            root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
                json!({"KHR_texture_transform": transform});
        }
        9 => {
            let name = pick(rng, &["NORMAL", "COLOR_0", "TANGENT", "TEXCOORD_1", "_ODD"]);
            primitive["attributes"][name] = any(rng).into();
        }
        10 => {
            root["materials"][0]["extensions"] = json!({"KHR_materials_unlit": {},
            "KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": size(rng) as f32, "diffuseTexture": {"index": any(rng)}}})
        }
        11 => root["accessors"][below(rng, 3)]["count"] = count.into(),
        12 => root["accessors"][below(rng, 3)]["count"] = 3.0.into(),
        _ => {
            let node = below(rng, root["nodes"].as_array().map_or(1, Vec::len));
            root["nodes"][node]["children"] = json!([any(rng), node]);
        }
    }
}

/// A tetrahedron that Draco compressed, by its encoder.
const DRACO: &str = "RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/wAAAQAJAwAAAAAAAAAAAAAAAACAPwAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==";

/// Changes bytes of a file, or cuts it off; digits mostly become other digits, so that numbers change and not words.
fn mutate(bytes: &mut Vec<u8>, rng: &mut Rng) {
    for _ in 0..=below(rng, 6) {
        if bytes.is_empty() {
            return;
        }
        let at = below(rng, bytes.len());
        match below(rng, 6) {
            0 => bytes[at] = below(rng, 256) as u8,
            1 => drop(bytes.remove(at)),
            2 => bytes.insert(at, pick(rng, b"0123456789e-./ \n,[]")),
            3 => bytes.truncate(at.max(bytes.len() / 2)),
            _ => {
                let digits = bytes[at..].iter().position(u8::is_ascii_digit).map(|from| at + from);
                bytes[digits.unwrap_or(at)] = pick(rng, b"0123456789");
            }
        }
    }
}

/// The files of a model, which is the first, and the options of its commands.
fn model(number: u64) -> (Vec<(&'static str, Vec<u8>)>, &'static str) {
    let rng = &mut Rng::new("hostile models", 1, number);
    let mut files = match below(rng, 6) {
        0 | 1 => obj(rng),
        2 => ply(rng),
        3 => stl(rng),
        _ => gltf(rng),
    };
    for (_, bytes) in &mut files {
        bytes.truncate(MOST_BYTES);
        if rng.chance(3) {
            mutate(bytes, rng);
        }
    }
    (files, pick(rng, &OPTIONS))
}

/// Set in a process that runs the models of its numbers by itself: FROM,TO.
const WORKER: &str = "RASTERPROOF_FUZZ_WORKER";

/// Models that one process runs, and its seconds of processor time, far more than they take.
const BATCH: (u64, u32) = (200, 200);

/// Processor time of this process in seconds.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit_once(')').map_or("", |(_, after)| after);
    let ticks =
        after.split_whitespace().skip(11).take(2).filter_map(|word| word.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}

/// Runs all commands on the models, and prints before each of them its number and words, and afterwards its status and time.
fn work(numbers: Range<u64>) {
    for number in numbers {
        let (files, options) = model(number);
        for (name, bytes) in &files {
            std::fs::write(name, bytes).unwrap();
        }
        let (name, face) = (files[0].0, format!("{}#1", files[0].0));
        for (place, words) in commands(name, &face, options).into_iter().enumerate() {
            let mut out = std::io::stdout();
            writeln!(out, "\nbegins {number} {place}").unwrap();
            let before = processor_s();
            let (mut printed, mut errors) = (Vec::new(), Vec::new());
            let streams = &mut Streams {
                input: &mut std::io::empty(),
                output: &mut printed,
                errors: &mut errors,
                progress: false,
                colour: false,
                columns: 100,
                error_columns: usize::MAX,
                delivery: Delivery::default(),
            };
            let status = cli::run(["rasterproof"].into_iter().chain(words), streams);
            writeln!(out, "ended {number} {place} {status} {:.2}", processor_s() - before).unwrap();
        }
    }
}

/// What a process printed: the commands that ended well, how many models were read, and the last command that it began.
#[derive(Default)]
struct Worked {
    read: u64,
    odd: Vec<(u64, usize)>,
    last: Option<(u64, usize)>,
}

fn worked(printed: &str) -> Worked {
    let mut worked = Worked::default();
    let mut begun = None;
    for line in printed.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["begins", number, place] => {
                begun = number.parse().ok().zip(place.parse().ok());
                worked.last = begun;
            }
            ["ended", _, place, status, seconds] => {
                worked.read += u64::from(place == "0" && status == "0");
                let is_well = ["0", "1", "2"].contains(&status)
                    && seconds.parse().is_ok_and(|seconds: f64| seconds < 20.0);
                worked.odd.extend(begun.take().filter(|_| !is_well));
            }
            _ => {}
        }
    }
    worked.odd.extend(begun);
    worked
}

/// Runs all commands on each model; how many models were read.
fn fuzz(numbers: Range<u64>, name: &str) {
    let folder = Folder::new(name);
    for (name, bytes) in pictures() {
        folder.put(name, bytes);
    }
    let (mut read, mut from) = (0, numbers.start);
    let mut wrong = Vec::new();
    while from < numbers.end {
        let to = numbers.end.min(from + BATCH.0);
        let mut command = Command::new("sh");
        let limits = format!(
            "ulimit -v {} && ulimit -t {} && ulimit -c 0 && exec \"$0\" \"$@\"",
            2048 << 10,
            BATCH.1
        );
        command.args(["-c", &limits]).arg(std::env::current_exe().unwrap());
        command.args(["--exact", "hostile_models::fuzz_of_models", "--ignored", "--nocapture"]);
        // The stack of a process's first thread.
        command.env(WORKER, format!("{from},{to}")).env("RUST_MIN_STACK", (8 << 20).to_string());
        let run = Run::of(command.current_dir(&folder));
        let worked = worked(&run.out);
        read += worked.read;
        // A process that was ended did not begin all models; what is left of its last one is run below.
        let (last, place) = worked.last.unwrap_or_else(|| panic!("nothing was run: {run}"));
        let rest = if run.status == Some(0) { 6 } else { place + 1 };
        let odd = worked.odd.into_iter().chain((rest..6).map(|place| (last, place)));
        for (number, place) in odd {
            let (files, options) = model(number);
            for (name, bytes) in &files {
                folder.put(name, bytes);
            }
            let face = format!("{}#1", files[0].0);
            let words = commands(files[0].0, &face, options)[place].clone();
            let alone = bounded(&folder, &words);
            let says = alone.errors.lines().last().unwrap_or_default();
            let line = format!(
                "model {number}: {} ends with {:?}: {says:.200}",
                words.join(" "),
                alone.status
            );
            println!("{line}");
            if !is_well(&alone) {
                wrong.push(line);
            }
        }
        from = last + 1;
        println!("{} models: {read} read, {} wrong", from - numbers.start, wrong.len());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let count = numbers.end - numbers.start;
    assert!(read > count / 4, "{read} of {count}");
}

fn range(text: &str) -> Range<u64> {
    let ends = text.split_once(',').and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    ends.unwrap_or_else(|| panic!("expected FROM,TO: {text}"))
}

/// The share that the project's own check runs; `RASTERPROOF_FUZZ=FROM,TO` runs another one.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn fuzz_of_models() {
    if let Ok(numbers) = std::env::var(WORKER) {
        return work(range(&numbers));
    }
    let parts = match std::env::var("RASTERPROOF_FUZZ") {
        Ok(numbers) => vec![range(&numbers)],
        Err(_) => std::iter::once(0..120).chain(FOUND.map(|number| number..number + 1)).collect(),
    };
    for numbers in parts {
        let name = format!("hostile-models-{}", numbers.start);
        fuzz(numbers, &name);
    }
}

/// Models that went wrong once. Millions of triangles, a few of them clipped, took 2.3 GB.
const FOUND: [u64; 1] = [24_002];

/// A tetrahedron and a concave face, with the positions multiplied by a number.
fn sized(size: f64) -> String {
    let positions = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3], [1, 1, 0], [3, 3, 1]];
    let mut text = String::new();
    for position in positions {
        let [x, y, z] = position.map(|number| f64::from(number) * size);
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}");
    }
    text + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\ns 1\nf 1 2 6 3\nf 2 5 3 6\n"
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn models_of_all_sizes_go_through_all_commands() {
    let folder = Folder::new("hostile-models-sizes");
    for size in [1e-320, 1e-200, 1e-154, 1e-75, 1e-45, 1e-40, 1e-38, 1e-10, 1e10, 1e20, 1e30, 3e37]
    {
        folder.put("m.obj", sized(size));
        for words in commands("m.obj", "m.obj#1", "") {
            let run = bounded(&folder, &words);
            assert!(run.status == Some(0), "{size:e}: {run}");
        }
    }
}

/// Coordinates of a texture that single precision does not hold are counted, and nothing is said of them.
#[test]
fn values_that_no_choice_takes_are_counted() {
    let folder = Folder::new("hostile-models-values");
    let text = "vt 0 0\nvt 1e300 1\nvt 0 1\n";
    folder.put("m.obj", format!("{}{text}f 1/1 2/2 3/3\n", sized(1.0)));
    for command in ["study --all", "cost"] {
        let run = folder.check(format!("{command} m.obj --once --size 64x48"), 0);
        run.prints("not judged: 1 pieces, since single precision does not hold");
    }
}

/// A glTF with so many materials, each with an image and a triangle of its own; the images have these names in turn.
fn textured(count: usize, names: &[&str]) -> Vec<u8> {
    let numbers = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    let bin: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let all = |of: &dyn Fn(usize) -> Value| (0..count).map(of).collect::<Vec<_>>();
    let root = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": (0..count).collect::<Vec<_>>()}],
        "nodes": all(&|i| json!({"mesh": i, "translation": [i % 8, i / 8, 0]})),
        "meshes": all(&|i| json!({"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i}]})),
        "materials": all(&|i| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}})),
        "textures": all(&|i| json!({"source": i, "sampler": 0})), "samplers": [{"minFilter": 9987}],
        "images": all(&|i| json!({"uri": names[i % names.len()]})),
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "buffers": [{"byteLength": 60, "uri": format!("data:;base64,{}", STANDARD.encode(bin))}],
    });
    root.to_string().into_bytes()
}

/// 64 images of 2048 x 2048 px take 1 GiB, and with their mip maps more; one of them takes 22 MB.
#[test]
fn a_picture_is_decoded_once_however_often_it_is_named() {
    let folder = Folder::new("hostile-models-textures");
    let picture = png(image::RgbImage::from_pixel(2048, 2048, image::Rgb([209, 199, 200])));
    for name in ["a.png", "b.png"] {
        folder.put(name, &picture);
    }
    folder.put("m.gltf", textured(64, &["a.png", "b.png"]));
    let mut obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n".to_owned();
    let mut mtl = String::new();
    for number in 0..64 {
        let _ = writeln!(obj, "usemtl m{number}\nf 1/1 2/2 3/3");
        let options = if number % 2 == 0 { "-clamp on" } else { "-o 0.1 0" };
        let _ =
            writeln!(mtl, "newmtl m{number}\nmap_Kd {options} -s {number} 1 a.png\nmap_d b.png");
    }
    folder.put("m.obj", obj);
    folder.put("m.mtl", mtl);
    for model in ["m.gltf", "m.obj"] {
        let words = ["render", model, "--size", "64x48", "--mip-maps", "-o", "drawn.png"];
        let run = within(800, &folder, &words).has(0);
        assert!(!run.errors.contains("warning"), "{run}");
    }
}

/// Five pictures that promise 8192 x 8192 px: four of them fit into the limit.
#[test]
fn all_textures_of_a_model_have_a_limit_together() {
    let folder = Folder::new("hostile-models-all-textures");
    let names = ["0.bmp", "1.bmp", "2.bmp", "3.bmp", "4.bmp"];
    for (number, name) in names.into_iter().enumerate() {
        let words = [54, 0, 54, 40, 8192, 8192, 24 << 16 | 1, 0, 0, number as u32, 0, 0, 0];
        let words = words.iter().flat_map(|word: &u32| word.to_le_bytes());
        folder.put(name, b"BM".iter().copied().chain(words).collect::<Vec<_>>());
    }
    folder.put("m.gltf", textured(5, &names));
    let words = ["render", "m.gltf", "--size", "64x48", "-o", "drawn.png"];
    let run = bounded(&folder, &words).has(0).says("images[4] has 8192 x 8192 px");
    run.says("the 1024 MiB of all textures of a model: make the pictures smaller");
}

/// A glTF that shows one triangle so many times as the numbers multiplied.
fn instances(counts: &[usize]) -> Vec<u8> {
    let numbers = [-1.0f32, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0];
    let bin: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let mut nodes = vec![json!({"mesh": 0, "scale": [2, 1, -1]})];
    nodes.extend(counts.iter().enumerate().map(|(level, &n)| json!({"children": vec![level; n]})));
    let root = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [nodes.len() - 1]}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"doubleSided": true}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": format!("data:;base64,{}", STANDARD.encode(bin))}],
    });
    root.to_string().into_bytes()
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn instances_are_merged_or_refused_before_they_are_built() {
    let folder = Folder::new("hostile-models-instances");
    let draw = |counts: &[usize]| {
        folder.put("m.gltf", instances(counts));
        within(600, &folder, &["render", "m.gltf", "--size", "64x48", "-o", "drawn.png"])
    };
    let picture = || std::fs::read(folder.join("drawn.png")).unwrap();
    draw(&[]).has(0);
    let one = picture();
    draw(&[50, 100]).has(0);
    assert!(picture() == one, "5,000 copies of a triangle look otherwise than one");
    let run = within(2048, &folder, &["inspect", "m.gltf#5000", "--size", "64x48"]);
    run.has(0).prints("parts from number 4097 on");
    draw(&[1000, 1000]).has(2).says("shows 1000000 copies of its meshes");
    draw(&[10, 1000, 1000]).has(2).says("shows more than 1048576 nodes");
    // Few bytes again, and far too many samples.
    draw(&[1000, 400]).has(2).says("give a smaller --size, or a part of the model");
}

/// Parts in an OBJ, each of a face: an item of a scene for each of them would take gigabytes.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn many_parts_of_an_obj_are_merged() {
    let folder = Folder::new("hostile-models-parts");
    let parts = "g a\nf 1 2 3\n".repeat(400_000);
    folder.put("m.obj", format!("v 0 0 0\nv 1 0 0\nv 0 1e-3 0\n{parts}"));
    bounded(&folder, &["render", "m.obj", "--size", "64x48", "-o", "drawn.png"]).has(0);
}

/// A name that thousands of parts have: 400 KB in the file, and gigabytes if each part had all of it.
#[test]
fn long_names_are_cut() {
    let folder = Folder::new("hostile-models-names");
    let name = "n".repeat(400_000);
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let parts = "g\nf 1 2 3\n".repeat(5_000);
    folder.put("object.obj", format!("{triangle}o {name}\n{parts}"));
    folder.put("material.obj", format!("mtllib m.mtl\n{triangle}usemtl {name}\n{parts}"));
    folder.put("m.mtl", format!("newmtl {name}\nKd 1 0 0\n"));
    let gltf = |change: &dyn Fn(&mut Value)| {
        let mut root: Value = serde_json::from_slice(&instances(&[4_000])).unwrap();
        change(&mut root);
        root.to_string()
    };
    folder.put("node.gltf", gltf(&|root| root["nodes"][0]["name"] = json!(name)));
    let material = gltf(&|root| {
        root["materials"] = json!([{"name": name}]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
    });
    folder.put("material.gltf", material);
    for model in ["object.obj", "material.obj", "node.gltf", "material.gltf"] {
        let words = ["render", model, "--size", "64x48", "-o", "drawn.png"];
        let run = within(800, &folder, &words).has(0);
        assert!(!run.errors.contains("no material file describes"), "{run}");
    }
}

/// The positions of six million points, all the same, are 72 bytes when Draco has compressed them.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn what_draco_compressed_is_refused_before_it_is_decoded() {
    let folder = Folder::new("hostile-models-draco");
    let points = "RFJBQ08CAgEAAAABgJvuAgEAAAAAAAAAAAAAAAABAQAJAwAAAgABAQEBAQFAAQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAgD8I";
    let model = |data: &str, copies: usize| {
        let mut root: Value = serde_json::from_slice(&instances(&[copies])).unwrap();
        let bytes = STANDARD.decode(data).unwrap().len();
        let buffer = json!({"byteLength": bytes, "uri": format!("data:;base64,{data}")});
        root["buffers"].as_array_mut().unwrap().push(buffer);
        let view = json!({"buffer": 1, "byteLength": bytes});
        root["bufferViews"].as_array_mut().unwrap().push(view);
        let draco = json!({"bufferView": 1, "attributes": {"POSITION": 0}});
        let primitive = &mut root["meshes"][0]["primitives"][0];
        primitive["extensions"] = json!({"KHR_draco_mesh_compression": draco});
        folder.put("m.gltf", root.to_string());
        within(1024, &folder, &["render", "m.gltf", "--size", "64x48", "-o", "drawn.png"])
    };
    model(DRACO, 100).has(0).prints("triangles 400");
    model(points, 100).has(2).says("what Draco compressed takes more than the ");
}

/// Triangles that are shown thousands of times in few pixels, and in a million texels of a shadow map.
#[test]
fn shadow_maps_have_a_limit_of_time() {
    let folder = Folder::new("hostile-models-shadows");
    folder.put("m.gltf", instances(&[100, 200]));
    let draw = |shadows: &str| {
        let words =
            ["render", "m.gltf", "--size", "24x18", "-o", "drawn.png", "--shadows", shadows];
        bounded(&folder, &words)
    };
    draw("16").has(0);
    let run = draw("1024").has(2).says("texels in the shadow map");
    run.says("give smaller --shadows, or a part of the model");
}

/// Options that multiply: a message says so before anything is held.
#[test]
fn sizes_and_layers_have_a_limit_together() {
    let folder = Folder::new("hostile-models-options");
    folder.put("m.obj", sized(1.0));
    let run = |words: &str| {
        let words: Vec<_> = words.split_whitespace().collect();
        within(900, &folder, &words).has(2)
    };
    run("render m.obj --size 8192x8192").says("take about 2560 MiB here, and the most are 2048");
    let layers = "--opacity 0.5 --layers 4294967295";
    run(&format!("render m.obj --size 8192x8192 --engine scanline {layers}"))
        .says("give a smaller --size, or leave out --layers");
    run("verify m.obj --size 4096x4096 --aa ssaa2 --shadows 8192").says("give a smaller --size");
}

/// Faces of very many corners, convex, concave and crossing themselves, and one that is listed again and again.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn faces_of_many_corners_are_drawn_or_refused() {
    let folder = Folder::new("hostile-models-corners");
    let mut rng = Rng::new("corners", 0, 0);
    for (corners, copies, kind) in [
        (60_000, 1, 0),
        (60_000, 1, 1),
        (60_000, 1, 2),
        (1000, 2000, 1),
        (1000, 2000, 2),
        (4000, 8, 2),
    ] {
        let mut text = String::new();
        for i in 0..corners {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
            let radius = if kind == 1 && i % 2 == 0 { 0.8 } else { 1.0 };
            let [x, y] = match kind {
                2 => [rng.signed(), rng.signed()],
                _ => [radius * cos(angle), radius * sin(angle)],
            };
            let _ = writeln!(text, "v {x:.5} {y:.5} 0");
        }
        let face = (1..=corners).map(|corner| format!(" {corner}")).collect::<String>();
        text += &format!("f{face}\n").repeat(copies);
        folder.put("m.obj", text);
        for command in ["render", "verify", "plan --whole --rounds 1", "inspect"] {
            let model = if command == "inspect" { "m.obj#1" } else { "m.obj" };
            let words: Vec<_> = command.split(' ').chain([model]).collect();
            let run = bounded(&folder, &words);
            assert!(matches!(run.status, Some(0 | 2)), "{corners} x {copies}, {kind}: {run}");
        }
    }
}
