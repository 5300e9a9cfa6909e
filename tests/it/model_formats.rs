//! Models in formats other than OBJ.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DVec2, DVec3};
use rasterproof_core::random::Rng;
use rasterproof_models::{BadFile, Camera, Format, Lens, LoadOptions, Model, Pose, Up};
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::opacity::AlphaMode;
use rasterproof_render::pipeline::physical::Map;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::scene::{Item, Material, Shading};
use serde_json::{Value, json};

use crate::model_files::{below, is_read};
use crate::models::warning;
use crate::program::{Folder, encoded};

const POSITIONS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// A folder for each test, whose thread has its name: two of them may write files of one name at the same time.
fn folder() -> Folder {
    let test = std::thread::current().name().unwrap_or("main").replace("::", "-");
    Folder::new(&test)
}

fn load(name: &str, bytes: &[u8]) -> Result<Model, BadFile> {
    load_in(&folder(), name, bytes)
}

fn load_in(folder: &Folder, name: &str, bytes: &[u8]) -> Result<Model, BadFile> {
    let options = LoadOptions { up: Some(Up::Y), ..LoadOptions::default() };
    rasterproof_models::load(&folder.put(name, bytes), options)
}

/// A model that is read, and has so many items.
fn items<const N: usize>(name: &str, bytes: &[u8]) -> (Model, [Item; N]) {
    let model = load(name, bytes).unwrap();
    let items = model.items.clone().try_into().unwrap_or_else(|_| panic!("{name}: {model:?}"));
    (model, items)
}

fn binary(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(4u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        bytes.extend(face.iter().flat_map(|&at| POSITIONS[at]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn text() -> String {
    let mut text = "solid a b\n".to_owned();
    for face in FACES {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in face.map(|at| POSITIONS[at]) {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid a b\n"
}

fn corners(model: &Model) -> Vec<[f64; 3]> {
    let of = |item: &Item| {
        let corner = |at: u32| item.mesh.positions[at as usize].to_array();
        let corners = item.mesh.triangles.positions().as_flattened().iter();
        corners.map(|&at| corner(at)).collect::<Vec<_>>()
    };
    model.items.iter().flat_map(of).collect()
}

fn obj() -> String {
    let mut obj = String::new();
    for [x, y, z] in POSITIONS {
        obj += &format!("v {x} {y} {z}\n");
    }
    for face in FACES {
        let [a, b, c] = face.map(|at| at + 1);
        obj += &format!("f {a} {b} {c}\n");
    }
    obj
}

#[test]
fn an_stl_of_either_kind_is_the_same_as_an_obj() {
    let obj = corners(&load("a.obj", obj().as_bytes()).unwrap());
    assert_eq!(obj.len(), 12);
    // The ending does not decide, and a binary file may begin with `solid`.
    for (name, bytes) in [
        ("text.obj", text().into_bytes()),
        ("binary.stl", binary(b"")),
        ("solid.stl", binary(b"solid a\n")),
    ] {
        let model = load(name, &bytes).unwrap();
        assert_eq!((model.format, corners(&model)), (Format::Stl, obj.clone()), "{name}");
    }
}

/// The same tetrahedron as a PLY, with its normals, texture coordinates and colours.
fn ply(form: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {form} 1.0\ncomment by hand\nelement vertex 4\nproperty double x\nproperty float y\n\
         property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         property short quality\nelement face 4\nproperty list uchar uint vertex_indices\n\
         element edge 1\nproperty int a\nend_header\n"
    )
    .into_bytes();
    let is_big = form == "binary_big_endian";
    let mut put = |number: f64, mut word: Vec<u8>| {
        if form == "ascii" {
            bytes.extend(format!("{number} ").bytes());
        } else {
            if is_big {
                word.reverse();
            }
            bytes.extend(word);
        }
    };
    for (at, [x, y, z]) in POSITIONS.into_iter().enumerate() {
        put(x.into(), f64::from(x).to_le_bytes().to_vec());
        put(y.into(), y.to_le_bytes().to_vec());
        put(z.into(), z.to_le_bytes().to_vec());
        [255, 51 * at as u8, 0].into_iter().for_each(|byte| put(byte.into(), vec![byte]));
        put(-2.0, (-2i16).to_le_bytes().to_vec());
        if form == "ascii" {
            put(f64::NAN, Vec::new());
        }
    }
    for face in FACES {
        put(3.0, vec![3]);
        face.into_iter().for_each(|at| put(at as f64, (at as u32).to_le_bytes().to_vec()));
        if form == "ascii" {
            put(f64::NAN, Vec::new());
        }
    }
    put(7.0, 7i32.to_le_bytes().to_vec());
    match form {
        // A line for each element.
        "ascii" => String::from_utf8(bytes).unwrap().replace("NaN ", "\n").into_bytes(),
        _ => bytes,
    }
}

#[test]
fn a_ply_of_any_kind_is_the_same_as_an_obj() {
    let obj = corners(&load("b.obj", obj().as_bytes()).unwrap());
    for form in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let model = load("a.txt", &ply(form)).unwrap();
        assert_eq!((model.format, corners(&model)), (Format::Ply, obj.clone()), "{form}");
        assert_eq!(model.warnings, Vec::<String>::new());
        assert_eq!(model.not_drawn, "1 edge, value 'quality' of 4 positions");
        let corner = model.items[0].mesh.triangles.at(0)[2];
        assert_eq!((corner.position, corner.colour.to_array()), (1, [1.0, 0.2, 0.0]), "{form}");
        assert_eq!(model.origins[0].lines.is_empty(), form != "ascii");
    }
    let text = String::from_utf8(ply("ascii")).unwrap();
    let model = load("old.ply", text.replace('\n', "\r\n").as_bytes()).unwrap();
    assert_eq!(corners(&model), obj, "lines that end with two bytes");
    assert_eq!(model.origins[0].lines, [21, 22, 23, 24]);
}

/// A strip of so many positions as a PLY, which its faces follow again and again: triangles but for one polygon of four corners.
fn long_strip(positions: u32, faces: u32, polygon: usize) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {positions}\nproperty float x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for number in 0..positions {
        let position = [number as f32, (number % 2) as f32, (number / 7) as f32];
        bytes.extend(position.map(f32::to_le_bytes).as_flattened());
    }
    for face in 0..faces {
        let at = face % (positions - 3);
        let corners = match face as usize == polygon {
            true => vec![at, at + 2, at + 3, at + 1],
            false => vec![at, at + 1, at + 2],
        };
        bytes.push(corners.len() as u8);
        bytes.extend(corners.into_iter().flat_map(u32::to_le_bytes));
    }
    bytes
}

/// Files of more bytes than are read at once.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_binary_file_is_read_in_pieces() {
    let (count, faces) = (300_000, 800_000);
    // With the first face as polygon much is read ahead when it is found.
    for polygon in [usize::MAX, 0, faces / 2, faces - 2] {
        let bytes = long_strip(count, faces as u32, polygon);
        let model = load("strip.ply", &bytes).unwrap();
        let mesh = &model.items[0].mesh;
        assert_eq!(mesh.positions.len(), count as usize);
        let wrong = (0..count).zip(mesh.positions.iter()).find(|(number, position)| {
            let z = -f64::from(number / 7);
            position.to_array() != [f64::from(*number), f64::from(number % 2), z]
        });
        assert_eq!(wrong, None);
        let triangles = mesh.triangles.positions();
        assert_eq!(triangles.len(), faces + usize::from(polygon < faces));
        for (number, triangle) in triangles.iter().enumerate() {
            let face = model.origins[0].face(number).unwrap() - 1;
            assert_eq!(face as usize, number - usize::from(number > polygon), "{number}");
            if face as usize != polygon {
                let first = face % (count - 3);
                assert_eq!(*triangle, [first, first + 1, first + 2]);
            }
        }
        // Cut off at the border of a record, inside one, and inside the positions.
        for less in [13, 1, 5_000_000, bytes.len() - 3_000_005] {
            let error = load("cut.ply", &bytes[..bytes.len() - less]).unwrap_err().to_string();
            assert!(error.contains(": the file is cut off"), "{less}: {error}");
        }
        let more = load("more.ply", &[&bytes[..], b"12345"].concat()).unwrap();
        assert!(warning(&more).contains("5 bytes follow the last element"), "{:?}", more.warnings);
    }
}

/// Each face has its colour, in a polygon that is cut too. The colours of vertices are finer.
#[test]
fn colours_of_the_faces_of_a_ply_are_drawn() {
    let colours = |model: &Model| {
        let corners = model.items[0].mesh.triangles.corners();
        corners.map(|corner| (corner.colour * 255.0).round().to_array()).collect::<Vec<_>>()
    };
    let (red, blue) = ([255.0, 0.0, 0.0], [0.0, 0.0, 255.0]);
    let text = include_str!("../data/models/face-colours.ply");
    let model = load("faces.ply", text.as_bytes()).unwrap();
    let Material { colour, vertex_colours, .. } = &model.items[0].material;
    assert_eq!((model.not_drawn.as_str(), *colour, *vertex_colours), ("", DVec3::ONE, true));
    assert_eq!(colours(&model), [red, red, red, blue, blue, blue]);
    // Two corners, four, and a strip without a colour before them.
    let strip = "element tristrips 1\nproperty list int int vertex_indices\nelement face 2";
    let other = text
        .replace("element face 2", &strip.replace("face 2", "face 3"))
        .replace("\n3 0 1 2 255 0 0", "\n3 0 1 3\n2 0 1 9 9 9\n4 0 1 2 3 255 0 0");
    let (white, other) = ([255.0; 3], load("other.ply", other.as_bytes()).unwrap());
    let expected = [[white; 3], [red; 3], [red; 3], [blue; 3]].concat();
    assert_eq!((colours(&other), other.not_drawn.as_str()), (expected, "1 incomplete face"));
    let not_finite = text.replace("uchar red", "float red").replace("2 255 0 0", "2 nan 0 0");
    let broken = load("broken.ply", not_finite.as_bytes()).unwrap();
    assert_eq!(broken.not_drawn, "colour that is not finite of 1 face");
    assert_eq!(colours(&broken), [blue; 3]);
    let alpha =
        text.replace("property uchar blue\n", "property uchar blue\nproperty uchar alpha\n");
    let alpha = alpha.replace("255 0 0\n", "255 0 0 9\n").replace("0 0 255", "0 0 255 255");
    let model = load("alpha.ply", alpha.as_bytes()).unwrap();
    assert_eq!(model.not_drawn, "value 'alpha' of 2 faces");
    let coloured = "property float z\nproperty uchar r\nproperty uchar g\nproperty uchar b\n";
    let finer = text.replace("property float z\n", coloured);
    let finer = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"].into_iter().fold(finer, |text, position| {
        text.replacen(&format!("\n{position}\n"), &format!("\n{position} 0 255 0\n"), 1)
    });
    let model = load("finer.ply", finer.as_bytes()).unwrap();
    assert!(model.not_drawn.starts_with("value 'blue' of 2 faces"), "{}", model.not_drawn);
    assert_eq!(colours(&model), [[0.0, 255.0, 0.0]; 6]);
}

#[test]
fn a_ply_has_polygons_strips_and_texture_coordinates() {
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                property float z\n";
    let square = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    let polygon = "element face 2\nproperty list uchar int vertex_index\n\
                   property list uchar float texcoord\nend_header\n";
    let faces = "4 0 1 3 2 8 0 0 1 0 1 1 0 .25\n2 0 1 0\n";
    let polygon = format!("{head}{polygon}{square}{faces}");
    let (model, [item]) = items("polygon.ply", polygon.as_bytes());
    assert_eq!(item.mesh.triangles.len(), 2);
    assert_eq!(item.mesh.triangles.at(1)[2].uv.to_array(), [0.0, 0.25]);
    assert_eq!(model.not_drawn, "1 incomplete face");
    // Two strips in one list: three triangles, all of the same winding.
    let strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    let list = "8 0 1 2 3 -1 3 2 0\n";
    let strips = format!("{head}{strips}{square}{list}");
    let (_, [item]) = items("strips.ply", strips.as_bytes());
    assert_eq!(*item.mesh.triangles.positions(), [[0, 1, 2], [2, 1, 3], [3, 2, 0]]);
}

/// A document of the tetrahedron, changed by a function, with its bytes: positions, then indices.
fn document(change: impl FnOnce(&mut Value)) -> (String, Vec<u8>) {
    let (mut document, bytes) = tetrahedron();
    change(&mut document);
    (document.to_string(), bytes)
}

fn tetrahedron() -> (Value, Vec<u8>) {
    let mut bytes: Vec<u8> = POSITIONS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(FACES.iter().flatten().flat_map(|&at| (at as u16).to_le_bytes()));
    let document = json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": bytes.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 24 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" },
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "metallicFactor": 0 } }],
        "nodes": [{ "mesh": 0, "name": "body" }],
        "scenes": [{ "nodes": [0] }],
    });
    (document, bytes)
}

fn glb((json, bytes): (String, Vec<u8>)) -> Vec<u8> {
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk =
        |kind: &[u8], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes(), kind, bytes].concat();
    let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &bytes)].concat();
    let length = 12 + chunks.len() as u32;
    [b"glTF", &2u32.to_le_bytes(), &length.to_le_bytes(), &chunks[..]].concat()
}

/// The tetrahedron as a binary glTF, changed by a function.
fn changed(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    glb(document(change))
}

#[test]
fn a_gltf_of_any_kind_is_the_same_as_an_obj() {
    let obj = corners(&load("c.obj", obj().as_bytes()).unwrap());
    let model = load("a.bin", &changed(|_| ())).unwrap();
    assert_eq!((model.format, corners(&model)), (Format::Glb, obj.clone()));
    assert_eq!(model.origins[0].part, "nodes[0] body meshes[0].primitives[0]");
    let (text, bytes) = document(|d| d["buffers"][0]["uri"] = json!("the%20buffer%20(1).bin"));
    let folder = folder();
    folder.put("the buffer (1).bin", bytes);
    let model = load_in(&folder, "beside.gltf", text.as_bytes()).unwrap();
    assert_eq!((model.format, corners(&model)), (Format::Gltf, obj.clone()));
    // Without indices, which lists the positions three by three.
    let whole: Vec<u8> =
        FACES.iter().flatten().flat_map(|&at| POSITIONS[at]).flat_map(f32::to_le_bytes).collect();
    let (json, _) = document(|d| {
        d["bufferViews"][0]["byteLength"] = json!(whole.len());
        d["buffers"][0]["byteLength"] = json!(whole.len());
        d["accessors"][0]["count"] = json!(12);
        d["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
    });
    assert_eq!(corners(&load("c.glb", &glb((json, whole))).unwrap()), obj);
    // The first version, which names things.
    let (_, bytes) = document(|_| ());
    let uri = format!("data:;base64,{}", STANDARD.encode(&bytes));
    let first = json!({
        "asset": { "version": "1.0" },
        "buffers": { "b": { "uri": uri, "byteLength": 72 } },
        "bufferViews": { "v": { "buffer": "b", "byteLength": 48 }, "i": { "buffer": "b", "byteOffset": 48, "byteLength": 24 } },
        "accessors": {
            "p": { "bufferView": "v", "byteStride": 12, "componentType": 5126, "count": 4, "type": "VEC3" },
            "n": { "bufferView": "i", "byteStride": 0, "componentType": 5123, "count": 12, "type": "SCALAR" },
        },
        "materials": { "m": { "name": "red", "values": { "diffuse": [1, 0, 0, 1], "specular": [1, 1, 1, 1] } } },
        "meshes": { "t": { "primitives": [{ "attributes": { "POSITION": "p" }, "indices": "n", "material": "m" }] } },
        "nodes": { "a": { "meshes": ["t", "t"] } },
        "scenes": { "s": { "nodes": ["a"] } },
        "scene": "s",
    });
    let model = load("first.gltf", first.to_string().as_bytes()).unwrap();
    assert_eq!(corners(&model), [&obj[..], &obj].concat(), "a node with two meshes");
    assert_eq!(model.not_drawn, "specular colour of 1 material");
    assert_eq!(model.items[0].material.colour.to_array(), [1.0, 0.0, 0.0]);
    // With an exponent it is drawn.
    let shiny = first.to_string().replace("[1,1,1,1]", "[1,1,1,1],\"shininess\":20");
    let model = load("shiny.gltf", shiny.as_bytes()).unwrap();
    let Material { colour, specular, .. } = &model.items[0].material;
    assert_eq!((model.not_drawn.as_str(), colour.to_array()), ("", [1.0, 0.0, 0.0]));
    assert_eq!(specular.colour.to_array(), [1.0; 3]);
    assert!((specular.shininess - 20.0).abs() < 1e-4, "{specular:?}");
}

/// A node brings its mesh to where it is; a mirror turns no face inside out.
#[test]
fn nodes_of_a_gltf_place_its_meshes() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let file = changed(|d| {
        d["nodes"] = json!([
            { "children": [1, 2, 3], "translation": [10, 0, 0] },
            { "mesh": 0, "rotation": [0, 0, half, half], "scale": [2, 2, 2] },
            { "mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1] },
            { "camera": 0, "translation": [0, 0, 7] },
        ]);
        d["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } }]);
        d["scenes"] = json!([{ "nodes": [] }, { "nodes": [0] }, { "nodes": [1] }]);
        d["scene"] = json!(1);
    });
    let (model, [turned, mirrored]) = items("nodes.glb", &file);
    assert_eq!(model.not_drawn, "2 other scenes");
    let [camera] = &model.cameras[..] else { panic!("{:?}", model.cameras) };
    let Camera { eye, ahead, up, lens, near, far, .. } = camera;
    assert_eq!([*eye, *ahead, *up], [DVec3::new(10.0, 0.0, -7.0), DVec3::Z, DVec3::Y]);
    assert_eq!((*lens, *near, *far), (Lens::Perspective { angle_rad: 1.0 }, 1.0, None));
    let close = |item: &Item, at: usize, expected: [f64; 3]| {
        let found = item.mesh.positions[at];
        assert!(found.distance(DVec3::from_array(expected)) < 1e-6, "{found} for {expected:?}");
    };
    // x becomes y, twice as far, and z is turned.
    close(&turned, 1, [10.0, 2.0, 0.0]);
    close(&turned, 3, [10.0, 0.0, -2.0]);
    close(&mirrored, 1, [9.0, 5.0, 0.0]);
    for item in [turned, mirrored] {
        let mesh = &item.mesh;
        let centre = mesh.positions.iter().sum::<DVec3>() / 4.0;
        for &triangle in mesh.triangles.positions() {
            let corner = mesh.positions[triangle[0] as usize];
            assert!(mesh.face_normal(triangle).dot(corner - centre) > 0.0, "{triangle:?}");
        }
    }
}

#[test]
fn strips_and_fans_of_a_gltf_are_triangles_of_one_winding() {
    let list = [0u16, 2, 1, 3, 3];
    for (mode, expected) in [
        // Two corners are left.
        (4, vec![[0, 2, 1]]),
        // The last index is that before it, so it makes no triangle.
        (5, vec![[0, 2, 1], [2, 3, 1]]),
        (6, vec![[2, 1, 0], [1, 3, 0], [3, 3, 0]]),
    ] {
        let (json, mut bytes) = document(|d| {
            d["accessors"][1]["count"] = json!(list.len());
            d["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        });
        bytes.splice(48..58, list.iter().flat_map(|at| at.to_le_bytes()));
        let (model, [item]) = items("modes.glb", &glb((json, bytes)));
        assert_eq!(item.mesh.triangles.positions().to_vec(), expected, "mode {mode}");
        assert_eq!(model.warnings.len(), usize::from(mode == 4), "{:?}", model.warnings);
    }
    let lines = changed(|d| d["meshes"][0]["primitives"][0]["mode"] = json!(1));
    let (model, []) = items("lines.glb", &lines);
    assert_eq!(model.not_drawn, "6 lines");
}

/// A texture of two texels, red on the left and green on the right, as a PNG.
fn picture() -> Vec<u8> {
    picture_of([[255, 0, 0, 255], [0, 255, 0, 128]])
}

fn picture_of(texels: [[u8; 4]; 2]) -> Vec<u8> {
    let picture = image::RgbaImage::from_fn(2, 1, |x, _| image::Rgba(texels[x as usize]));
    encoded(picture, image::ImageFormat::Png).unwrap()
}

#[test]
fn materials_of_a_gltf_are_drawn_or_counted() {
    let uvs: Vec<u8> =
        [0.25f32, 0.0, 0.75, 0.0, 0.25, 1.0, 0.75, 1.0].map(f32::to_le_bytes).concat();
    let picture = picture();
    let (json, mut bytes) = document(|d| {
        let views = d["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": 72, "byteLength": 32 }));
        views.push(json!({ "buffer": 0, "byteOffset": 104, "byteLength": picture.len() }));
        let uvs = json!({ "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" });
        // Bytes of the positions as colours, which are read as shares of 255.
        let colours = json!({ "bufferView": 0, "byteOffset": 0, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3" });
        d["accessors"].as_array_mut().unwrap().extend([uvs, colours]);
        let body = json!({ "attributes": { "POSITION": 0, "TEXCOORD_1": 2 }, "indices": 1, "material": 0 });
        let mut other = body.clone();
        other["material"] = json!(1);
        other["attributes"]["COLOR_0"] = json!(3);
        d["meshes"][0]["primitives"] = json!([body, other]);
        d["images"] = json!([{ "bufferView": 3, "mimeType": "image/png" }]);
        d["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33071, "wrapT": 33071 }]);
        d["textures"] = json!([{ "source": 0, "sampler": 0 }, { "source": 7 }]);
        let moved = json!({ "index": 0, "texCoord": 0, "extensions": { "KHR_texture_transform": { "offset": [0.5, 0], "texCoord": 1 } } });
        d["materials"] = json!([
            {
                "name": "paint",
                "pbrMetallicRoughness": { "baseColorTexture": moved, "baseColorFactor": [0.5, 0, 1, 0.5], "metallicFactor": 0 },
                "normalTexture": { "index": 0 },
                "emissiveFactor": [0, 0, 1],
                "alphaMode": "BLEND",
                "extensions": { "KHR_materials_unlit": {}, "KHR_materials_sheen": {} },
            },
            {
                "doubleSided": true,
                "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 }, "baseColorFactor": [1, 1, 1, 0.25] },
                "alphaMode": "MASK",
                "alphaCutoff": 0.25,
            },
        ]);
        d["extensionsUsed"] = json!(["KHR_materials_unlit", "KHR_materials_sheen"]);
    });
    bytes.extend(uvs);
    bytes.extend(picture);
    let (model, [paint, other]) = items("materials.glb", &glb((json, bytes)));
    // In linear light, as what is lit.
    assert_eq!(paint.material.colour.to_array(), [0.5, 0.0, 1.0]);
    assert!(paint.material.physical.is_some());
    assert_eq!((paint.material.shading, paint.cull), (Shading::Unlit, Cull::Clockwise));
    assert_eq!((other.cull, other.two_sided, paint.two_sided), (Cull::None, true, false));
    let texture = paint.material.texture.as_ref().unwrap();
    let corner = paint.mesh.triangles.at(0)[0];
    assert_eq!(corner.uv.to_array(), [0.75, 1.0], "moved by a half, v up");
    assert_eq!(texture.at(corner.uv).to_array(), [0.0, 1.0, 0.0]);
    assert_eq!(model.origins[0].material, "paint");
    assert_eq!(
        model.origins[1].place(3),
        "face 8 (number 4 of its part) of 'nodes[0] body meshes[0].primitives[1]', material 'materials[1]'"
    );
    assert!(other.material.texture.is_none() && other.material.vertex_colours);
    let glass = paint.material.opacity.as_ref().unwrap();
    assert_eq!((glass.mode, glass.factor, glass.map.is_some()), (AlphaMode::Blend, 0.5, true));
    let opacity = other.material.opacity.as_ref().unwrap();
    assert_eq!((opacity.mode, opacity.factor), (AlphaMode::Test { threshold: 0.25 }, 0.25));
    assert_eq!(opacity.of(DVec2::ZERO), 255, "as opaque as the threshold");
    let missing = "textures[1] has no picture that is read; the material 'materials[1]'";
    assert!(warning(&model).contains(missing), "{:?}", model.warnings);
    assert_eq!(model.not_drawn, "1 extension KHR_materials_sheen");
}

/// Factors, maps and tangents of a surface in linear light; what is read at other coordinates is counted.
#[test]
fn surfaces_of_a_gltf_are_in_linear_light() {
    let bytes = |numbers: &[f32]| numbers.iter().copied().flat_map(f32::to_le_bytes).collect();
    let uvs: Vec<u8> = bytes(&[0.25, 0.0, 0.75, 0.0, 0.25, 1.0, 0.75, 1.0]);
    let normals: Vec<u8> = bytes(&[0.0, 0.0, 1.0].repeat(4));
    let tangents: Vec<u8> = bytes(&[0.0, 0.6, 0.8, 1.0].repeat(4));
    let picture = picture_of([[200, 100, 50, 255], [10, 20, 30, 255]]);
    let made = |change: &dyn Fn(&mut Value)| {
        let (json, mut whole) = document(|d| {
            let mut start = 72;
            for bytes in [&uvs, &normals, &tangents, &picture] {
                let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
                d["bufferViews"].as_array_mut().unwrap().push(view);
                start += bytes.len();
            }
            let of = |view: u32, form: &str| json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": form });
            let colours = json!({ "bufferView": 0, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" });
            let all = [of(2, "VEC2"), of(3, "VEC3"), of(4, "VEC4"), colours];
            d["accessors"].as_array_mut().unwrap().extend(all);
            d["meshes"][0]["primitives"] = json!([{
                "attributes": { "POSITION": 0, "TEXCOORD_0": 2, "NORMAL": 3, "TANGENT": 4, "COLOR_0": 5 },
                "indices": 1, "material": 0,
            }]);
            d["images"] = json!([{ "bufferView": 5, "mimeType": "image/png" }]);
            d["textures"] = json!([{ "source": 0 }]);
            d["materials"] = json!([{
                "pbrMetallicRoughness": {
                    "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 0, 1, 1],
                    "metallicFactor": 0.25, "roughnessFactor": 0.75, "metallicRoughnessTexture": { "index": 0 },
                },
                "normalTexture": { "index": 0, "scale": 0.5 },
                "occlusionTexture": { "index": 0, "strength": 0.125 },
                "emissiveTexture": { "index": 0 }, "emissiveFactor": [0, 0.5, 1],
                "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8 } },
            }]);
            d["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
            change(d);
        });
        for bytes in [&uvs, &normals, &tangents, &picture] {
            whole.extend(bytes);
        }
        glb((json, whole))
    };
    let folder = folder();
    let read = |name: &str, shading: Shading, change: &dyn Fn(&mut Value)| {
        let options = LoadOptions { shading, ..LoadOptions::default() };
        let path = folder.put(name, made(change));
        let model = rasterproof_models::load(&path, options).unwrap();
        let [item] = model.items.clone().try_into().unwrap();
        (model, item)
    };
    let (model, item) = read("surface.glb", Shading::Phong, &|_| ());
    assert_eq!(model.not_drawn, "");
    let material = &item.material;
    assert_eq!(material.colour.to_array(), [0.5, 0.0, 1.0]);
    let surface = material.physical.as_ref().unwrap();
    let numbers = [surface.metal, surface.roughness, surface.bumps, surface.occlusion];
    assert_eq!(numbers, [0.25, 0.75, 0.5, 0.125]);
    assert_eq!(surface.emission.to_array(), [0.0, 4.0, 8.0]);
    // Colours are decoded, and no other numbers.
    let uv = DVec2::new(0.25, 0.75);
    let stored = Texture::clone(material.texture.as_ref().unwrap()).as_stored();
    let decoded = stored.clone().decoded();
    assert_ne!(stored.at(uv), decoded.at(uv));
    assert_eq!(material.texture.as_ref().unwrap().at(uv), decoded.at(uv));
    for (map, is_decoded) in
        [(Map::Emission, true), (Map::Metal, false), (Map::Occlusion, false), (Map::Normal, false)]
    {
        let expected = if is_decoded { &decoded } else { &stored };
        assert_eq!(surface.map(map).unwrap().at(uv), expected.at(uv), "{map:?}");
    }
    // A scene is left-handed, and colours are amounts of light in the file.
    assert_eq!(
        item.mesh.triangles.tangents(0)[1].to_array(),
        [0.0, 0.6f32.into(), (-0.8f32).into(), -1.0]
    );
    assert_eq!(item.mesh.triangles.at(3)[2].colour.to_array(), [0.0, 0.0, 128.0 / 255.0]);
    // Without tangents they are made, and are at a right angle to the normal.
    let (_, computed) = read("computed.glb", Shading::Phong, &|d| {
        d["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TANGENT");
    });
    let tangent = computed.mesh.triangles.tangents(0)[1];
    assert!(tangent.z == 0.0 && (tangent.truncate().length() - 1.0).abs() < 1e-6, "{tangent}");
    // Coordinates of other maps, those of a third kind, and a picture that is not there.
    let (model, item) = read("other.glb", Shading::Phong, &|d| {
        d["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(2);
        let transform = json!({ "KHR_texture_transform": { "offset": [0.5, 0.25] } });
        let material = &mut d["materials"][0];
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["texCoord"] = json!(1);
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["extensions"] = transform;
        material["normalTexture"]["texCoord"] = json!(1);
        material["emissiveTexture"]["index"] = json!(7);
    });
    assert_eq!(model.not_drawn, "map with a third kind of texture coordinates of 1 material");
    assert_eq!(item.material.physical.as_ref().unwrap().second, [false, true, false, false]);
    for (corner, second) in item.mesh.triangles.at(1).iter().zip(item.mesh.triangles.second_uvs(1))
    {
        assert_eq!(second, corner.uv + DVec2::new(0.5, -0.25));
    }
    let missing =
        "textures[7] is not there; the material 'materials[0]' is drawn without its emission";
    assert!(warning(&model).contains(missing), "{:?}", model.warnings);
    let surface = item.material.physical.as_ref().unwrap();
    assert!(surface.map(Map::Normal).is_none() && surface.emission == DVec3::ZERO);
    // What is reflected without metal, by two extensions; a map of it is not read.
    let reflected = |ior: Value, specular: Value| {
        let (model, item) = read("reflected.glb", Shading::Phong, &|d| {
            d["materials"][0]["extensions"]["KHR_materials_ior"] = ior.clone();
            d["materials"][0]["extensions"]["KHR_materials_specular"] = specular.clone();
            d["extensionsUsed"] = json!(["KHR_materials_ior", "KHR_materials_specular"]);
        });
        let surface = item.material.physical.as_ref().unwrap();
        (surface.straight.to_array(), surface.grazing, model.not_drawn)
    };
    assert_eq!(reflected(json!({}), json!({})), ([0.04; 3], 1.0, String::new()));
    assert_eq!(reflected(json!({ "ior": 3 }), json!({})), ([0.25; 3], 1.0, String::new()));
    let coloured = json!({
        "specularFactor": 0.5, "specularColorFactor": [2, 1, 8], "specularTexture": { "index": 0 },
    });
    let (straight, grazing, not_drawn) = reflected(json!({ "ior": 3 }), coloured);
    assert_eq!((straight, grazing), ([0.25, 0.125, 0.5], 0.5));
    assert_eq!(not_drawn, "map of what is reflected of 1 material");
    // With light of the corners, the colours are those of a picture.
    let (model, item) = read("surface.glb", Shading::Gouraud, &|_| ());
    assert_eq!(model.not_drawn, "metal and roughness, with Gouraud shading, of 1 material");
    let material = &item.material;
    assert!(material.physical.is_none() && (material.colour.x * 255.0 - 187.516).abs() < 0.01);
    assert_eq!(material.texture.as_ref().unwrap().at(uv), stored.at(uv));
    assert!((item.mesh.triangles.at(3)[2].colour.z * 255.0 - 187.845).abs() < 0.01);
}

/// A primitive that names no material is white, and seen from the front alone.
#[test]
fn a_missing_material_of_a_gltf_is_white() {
    let file =
        |material: Value| changed(|d| d["meshes"][0]["primitives"][0]["material"] = material);
    let (model, [white]) = items("none.glb", &file(Value::Null));
    assert_eq!((model.not_drawn.as_str(), model.warnings.len()), ("", 0));
    let Material { colour, texture, opacity, .. } = &white.material;
    assert!(texture.is_none() && opacity.is_none());
    assert_eq!((*colour, white.cull, white.two_sided), (DVec3::ONE, Cull::Clockwise, false));
    let (model, [grey]) = items("wrong.glb", &file(json!(3)));
    assert!(warning(&model).contains("materials[3] is not there; it is drawn grey"));
    assert_eq!((grey.material.colour, model.not_drawn.as_str()), (DVec3::splat(0.8), ""));
}

/// What vertices and nodes have beside what is drawn, and the two last bytes of each triangle of an STL.
#[test]
fn the_numbers_of_samplers_are_those_of_opengl() {
    let uri = format!("data:image/png;base64,{}", STANDARD.encode(picture()));
    let (smooth, nearest) = (Filter::Bilinear, Filter::Nearest);
    let (repeat, clamp, mirror) = (Wrap::Repeat, Wrap::Clamp, Wrap::Mirror);
    let picture = Texture::new(2, 1, &[[255, 0, 0], [0, 255, 0]]).unwrap();
    let usual = picture.clone().with(smooth, repeat);
    let mip_map = || usual.clone().with_mip_map();
    for (sampler, expected) in [
        (json!({}), usual.clone()),
        (json!({ "magFilter": 9728 }), picture.clone().with(nearest, repeat)),
        (json!({ "magFilter": 9729, "minFilter": 9729 }), usual.clone()),
        (json!({ "minFilter": 9728 }), usual.clone().with_minified(nearest)),
        (json!({ "minFilter": 9984 }), mip_map().with_minified(nearest).with_single_levels()),
        (json!({ "minFilter": 9985 }), mip_map().with_single_levels()),
        (json!({ "minFilter": 9986 }), mip_map().with_minified(nearest)),
        (json!({ "minFilter": 9987 }), mip_map()),
        (json!({ "wrapS": 33648 }), usual.clone().with(smooth, [mirror, repeat])),
        (json!({ "wrapS": 33071 }), usual.clone().with(smooth, [clamp, repeat])),
        (json!({ "wrapT": 33071 }), usual.clone().with(smooth, [repeat, clamp])),
        (json!({ "wrapS": 33071, "wrapT": 33071 }), usual.clone().with(smooth, clamp)),
    ] {
        let document = document(|d| {
            d["images"] = json!([{ "uri": uri }]);
            d["samplers"] = json!([sampler]);
            d["textures"] = json!([{ "source": 0, "sampler": 0 }]);
            let colour = json!({ "baseColorTexture": { "index": 0 }, "metallicFactor": 0 });
            d["materials"] = json!([{ "pbrMetallicRoughness": colour }]);
            d["meshes"][0]["primitives"][0]["material"] = json!(0);
        });
        let (model, [item]) = items("samplers.glb", &glb(document));
        let texture = item.material.texture.as_ref().unwrap();
        assert_eq!((&**texture, &*model.not_drawn), (&expected, ""), "{sampler}");
        assert_eq!(item.material.colour, DVec3::ONE, "no factor changes the texture");
    }
}

#[test]
fn what_is_not_drawn_of_vertices_and_nodes_is_counted() {
    let file = |mode: &str| {
        let (json, mut bytes) = document(|d| {
            let bytes = json!({ "buffer": 0, "byteOffset": 72, "byteLength": 16 });
            d["bufferViews"].as_array_mut().unwrap().push(bytes);
            let colours = json!({ "bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" });
            d["accessors"].as_array_mut().unwrap().push(colours);
            d["materials"] =
                json!([{ "alphaMode": mode, "pbrMetallicRoughness": { "metallicFactor": 0 } }]);
            d["meshes"][0]["primitives"][0]["material"] = json!(0);
            d["meshes"][0]["primitives"][0]["attributes"] = json!({
                "POSITION": 0, "COLOR_0": 2, "COLOR_1": 2, "TEXCOORD_0": 0, "TEXCOORD_1": 0, "JOINTS_1": 2,
                "_HEAT": 0, "HEAT": 0,
            });
            d["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
            d["extensionsUsed"] = json!(["KHR_lights_punctual"]);
            d["animations"] = json!([{ "channels": [], "samplers": [] }]);
        });
        bytes.extend([255, 0, 0, 255, 255, 0, 0, 254, 255, 0, 0, 0, 255, 0, 0, 255]);
        glb((json, bytes))
    };
    let always = "joints beyond the first four of 1 primitive, 1 light, \
                  other colours of 1 primitive";
    for mode in ["OPAQUE", "BLEND", "MASK"] {
        let (model, [item]) = items("counted.glb", &file(mode));
        let undefined = "values that glTF does not define of 1 primitive";
        assert_eq!(model.not_drawn, format!("{always}, {undefined}"));
        // The opacities of vertices, and halfway between the first two corners.
        let triangle = item.mesh.triangles.at(0);
        let read = |uv: DVec2| item.material.opacity.as_ref().map_or(255, |all| all.read(uv));
        assert_eq!(triangle.map(|corner| corner.position), [0, 2, 1]);
        let found = triangle.map(|corner| read(corner.uv));
        assert_eq!(found, if mode == "OPAQUE" { [255; 3] } else { [255, 0, 254] }, "{mode}");
        let middle = read((triangle[0].uv + triangle[1].uv) / 2.0);
        assert!(mode == "OPAQUE" || [127, 128].contains(&middle), "{middle}");
    }
    let mut stl = binary(b"");
    assert_eq!(load("plain.stl", &stl).unwrap().not_drawn, "");
    stl[84 + 50 + 49] = 0x80;
    assert_eq!(load("colour.stl", &stl).unwrap().not_drawn, "attribute of 1 triangle");
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
               property list uchar int lods\nelement face 1\nproperty list uchar int vertex_indices\n\
               property int part\nend_header\n0 0 0 1 1 1 255 0\n1 0 0 1 1 1 254 1 7\n0 1 0 1 1 1 0 0\n3 0 1 2 8\n";
    assert_eq!(
        load("alpha.ply", ply.as_bytes()).unwrap().not_drawn,
        "2 transparent positions, value 'lods' of 3 positions, value 'part' of 1 face"
    );
}

/// A mesh that an extension shows many times: moved, turned and scaled, below the node that has it.
#[test]
fn instances_of_a_mesh_are_drawn() {
    let file = include_bytes!("../data/models/gpu-instancing.gltf");
    let model = load("instances.gltf", file).unwrap();
    assert_eq!(model.not_drawn, "");
    let left = |item: &Item| item.mesh.bounds().unwrap().0.x;
    assert_eq!(model.items.iter().map(left).collect::<Vec<_>>(), [0.0, 2.0, 4.0]);
    let copies = |count: u64, skin: bool| {
        let (json, mut bytes) = document(|d| {
            let views = d["bufferViews"].as_array_mut().unwrap();
            views.push(json!({ "buffer": 0, "byteOffset": 72, "byteLength": 100 }));
            let accessors = d["accessors"].as_array_mut().unwrap();
            accessors.push(
                json!({ "bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3" }),
            );
            accessors.push(json!({ "bufferView": 2, "byteOffset": 24, "componentType": 5120, "normalized": true, "count": 2, "type": "VEC4" }));
            accessors.push(json!({ "componentType": 5126, "count": count, "type": "VEC3" }));
            let attributes = json!({ "SCALE": 2, "ROTATION": 3, "_ID": 9 });
            let moved = json!({ "TRANSLATION": 4 });
            let attributes = if count > 2 { moved } else { attributes };
            d["nodes"][0]["extensions"] =
                json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
            d["nodes"][0]["translation"] = json!([10, 0, 0]);
            if skin {
                d["nodes"][0]["skin"] = json!(0);
                d["skins"] = json!([{ "joints": [0] }]);
            }
            d["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
        });
        bytes.extend([1.0f32, 1.0, 1.0, 2.0, 2.0, 2.0].map(f32::to_le_bytes).concat());
        // As it is, and half a turn about y.
        bytes.extend([0, 0, 0, 127, 0, 127, 0, 0]);
        bytes.resize(172, 0);
        load("copies.glb", &glb((json, bytes)))
    };
    let model = copies(2, false).unwrap();
    assert_eq!(model.not_drawn, "");
    let bounds: Vec<_> = model.items.iter().map(|item| item.mesh.bounds().unwrap()).collect();
    // The file's z points the other way.
    assert_eq!(bounds[0], (DVec3::new(10.0, 0.0, -1.0), DVec3::new(11.0, 1.0, 0.0)));
    assert_eq!(bounds[1], (DVec3::new(8.0, 0.0, 0.0), DVec3::new(10.0, 2.0, 2.0)));
    let error = copies(16_000_000, false).unwrap_err().to_string();
    assert!(error.contains("shows 16000000 copies of its meshes"), "{error}");
    assert_eq!(copies(2, true).unwrap().items.len(), 1, "a skin decides alone");
}

/// A torus that gltfpack wrote as it is, compressed, and with positions that another filter rounds.
#[test]
fn triangles_that_meshoptimizer_compressed_are_decoded() {
    let (plain, [torus]) = items("torus.glb", include_bytes!("../data/models/torus.glb"));
    assert_eq!((plain.not_drawn.as_str(), torus.mesh.triangles.len()), ("", 192));
    let corners = |item: &Item| {
        let place = |at: u32| item.mesh.positions[at as usize];
        let corners = item.mesh.triangles.corners();
        corners.map(|corner| (place(corner.position), corner.normal, corner.uv)).collect::<Vec<_>>()
    };
    let compressed = include_bytes!("../data/models/torus-meshopt.glb");
    let float = include_bytes!("../data/models/torus-meshopt-float.glb");
    // Two steps of the 14 bits of a position, of a torus 6 units wide.
    for (bytes, most) in [(&compressed[..], 0.0), (&float[..], 12.0 / f64::from(1 << 14))] {
        let (model, [item]) = items("compressed.glb", bytes);
        assert_eq!((model.not_drawn.as_str(), model.warnings.len()), ("", 0));
        let (decoded, expected) = (corners(&item), corners(&torus));
        assert_eq!(decoded.len(), expected.len());
        // The order of the triangles may differ, and normals have 8 bits.
        for (p, n, uv) in decoded {
            let is_near = |(q, m, vw): &(DVec3, DVec3, DVec2)| {
                p.distance(*q) <= most && n.dot(*m) > 0.99 && uv == *vw
            };
            assert!(expected.iter().any(is_near), "{p} {n} {uv}");
        }
    }
    // Bytes of the compressed views, changed.
    for at in (compressed.len() - 1224..compressed.len()).step_by(7) {
        let mut broken = compressed.to_vec();
        broken[at] ^= 0x55;
        let _ = load("broken.glb", &broken);
    }
    let length = b"\"byteLength\":664";
    let place = compressed.windows(length.len()).position(|bytes| bytes == length).unwrap();
    let mut cut = compressed.to_vec();
    cut[place..place + length.len()].copy_from_slice(b"\"byteLength\": 64");
    let error = load("cut.glb", &cut).unwrap_err().to_string();
    assert!(error.contains("bufferViews[0]: EXT_meshopt_compression"), "{error}");
}

/// Joints move what is bound to them, shapes are mixed in, and single elements are replaced.
#[test]
fn a_gltf_is_drawn_in_its_rest_pose() {
    let (json, mut bytes) = document(|d| {
        let views = d["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": 72, "byteLength": 100 }));
        let accessors = d["accessors"].as_array_mut().unwrap();
        accessors
            .push(json!({ "bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4" }));
        accessors.push(json!({ "bufferView": 2, "byteOffset": 16, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" }));
        // Position 2 of four zeros is (0, 8, 0).
        accessors.push(json!({ "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
            "count": 1,
            "indices": { "bufferView": 2, "byteOffset": 32, "componentType": 5121 },
            "values": { "bufferView": 2, "byteOffset": 36 },
        } }));
        accessors.push(json!({ "bufferView": 2, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3" }));
        d["meshes"][0]["primitives"][0] = json!({
            "attributes": { "POSITION": 0, "NORMAL": 5, "JOINTS_0": 2, "WEIGHTS_0": 3 },
            "indices": 1,
            "material": 0,
            "targets": [{ "POSITION": 4 }, { "POSITION": 4 }],
        });
        d["meshes"][0]["weights"] = json!([0.5, 0]);
        d["skins"] = json!([{ "joints": [1, 2] }]);
        d["nodes"] = json!([
            { "mesh": 0, "skin": 0, "translation": [100, 0, 0] },
            { "translation": [1, 0, 0], "children": [2] },
            { "translation": [0, 0, 4], "scale": [1, 2, 1] },
        ]);
        d["scenes"] = json!([{ "nodes": [0, 1] }]);
    });
    // Vertex 0 to joint 0, the others to joint 1; vertex 3 to both.
    bytes.extend([0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    bytes.extend([255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 128, 128, 0, 0]);
    bytes.extend([2, 0, 0, 0]);
    bytes.extend([0.0f32, 8.0, 0.0].map(f32::to_le_bytes).concat());
    bytes.extend([1.0f32, 1.0, 0.0].map(f32::to_le_bytes).concat().repeat(4));
    bytes.resize(172, 0);
    let (model, [item]) = items("pose.glb", &glb((json, bytes)));
    assert_eq!((model.warnings.len(), model.not_drawn.as_str()), (0, ""));
    let found: Vec<_> = item.mesh.positions.iter().map(|position| position.to_array()).collect();
    assert_eq!(found, [[1.0, 0.0, 0.0], [2.0, 0.0, -4.0], [1.0, 10.0, -4.0], [1.0, 0.0, -3.0]]);
    // What is stretched along y leans away from it: not at all, twice, and by the mean.
    for corner in item.mesh.triangles.iter().flatten() {
        let expected = [1.0, 0.5, 0.5, 1.0 / 1.5][corner.position as usize];
        assert!((corner.normal.y / corner.normal.x - expected).abs() < 0.01, "{}", corner.normal);
    }
}

/// A node at moments of its animation, by each way of interpolating, computed by hand.
#[test]
fn an_animation_brings_nodes_to_where_they_are() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let lists: [&[f32]; 6] = [
        &[1.0, 2.0, 4.0],
        &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 4.0, 0.0],
        // A quarter about z.
        &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, half, half],
        // Leaves with the slope 2, arrives with 0; of three numbers the middle one is the value.
        &[0.0, 1.0, 2.0, 0.0, 3.0, 0.0, 0.0, 3.0, 0.0].map(|number| [number; 3]).concat(),
        &[1.0],
        &[f32::NAN, 2.0, 4.0],
    ];
    let whole = lists.concat().into_iter().flat_map(f32::to_le_bytes);
    let (json, mut bytes) = document(|d| {
        let mut start = 72;
        let forms =
            [(1, "SCALAR"), (3, "VEC3"), (4, "VEC4"), (3, "VEC3"), (1, "SCALAR"), (1, "SCALAR")];
        for (list, (width, form)) in lists.iter().zip(forms) {
            let length = 4 * list.len();
            let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": length });
            d["bufferViews"].as_array_mut().unwrap().push(view);
            start += length;
            let view = d["bufferViews"].as_array().unwrap().len() - 1;
            let accessor = json!({ "bufferView": view, "componentType": 5126, "count": list.len() / width, "type": form });
            d["accessors"].as_array_mut().unwrap().push(accessor);
        }
        let of = |path: &str, output: u32, way: &str| {
            json!({ "name": format!("{path} {way}"),
                "channels": [{ "sampler": 0, "target": { "node": 0, "path": path } }],
                "samplers": [{ "input": 2, "output": output, "interpolation": way }] })
        };
        d["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 7, 7, 1]);
        d["animations"] = json!([
            of("translation", 3, "LINEAR"), of("translation", 3, "STEP"), of("rotation", 4, "LINEAR"),
            of("scale", 5, "CUBICSPLINE"), of("translation", 6, "LINEAR"), { "name": "empty" },
            of("translation", 3, "LINEAR"),
        ]);
        d["animations"][6]["samplers"][0]["input"] = json!(7);
    });
    bytes.extend(whole);
    let folder = folder();
    let path = folder.put("moved.glb", glb((json, bytes)));
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

#[test]
fn what_a_gltf_names_and_is_not_there_is_said() {
    type Change = fn(&mut Value);
    let rows: [(Change, &str); 9] = [
        (
            |d| d["accessors"][1]["count"] = json!(13),
            "meshes[0].primitives[0]: accessors[1]: 13 elements of 2 bytes do not fit into the 24 bytes",
        ),
        (
            |d| d["bufferViews"][1]["byteLength"] = json!(25),
            "bufferViews[1] has 25 bytes from byte 48 on, and buffers[0] has 72",
        ),
        (|d| d["accessors"][0]["count"] = json!(u64::MAX), "do not fit"),
        (|d| d["nodes"][0]["children"] = json!([0]), "nodes[0] contains itself"),
        (|d| d["nodes"][0]["children"] = json!([9]), "nodes[9] is not there"),
        (|d| d["buffers"][0]["uri"] = json!("none.bin"), "buffers[0]: there is no file 'none.bin'"),
        (
            |d| d["extensionsRequired"] = json!(["KHR_meshopt_compression"]),
            "compressed by KHR_meshopt_compression",
        ),
        (
            |d| d["accessors"][0]["type"] = json!("VEC2"),
            "accessors[0] has 2 numbers where 3 are needed",
        ),
        (|d| d["nodes"][0]["mesh"] = json!("x"), "is no glTF that can be read"),
    ];
    for (change, part) in rows {
        let error = load("a.glb", &changed(change)).unwrap_err().to_string();
        assert!(error.contains(part), "{part}: {error}");
    }
    let mut file = document(|_| ());
    file.1[48 + 2] = 9;
    let (model, [item]) = items("j.glb", &glb(file));
    assert_eq!(item.mesh.triangles.len(), 3);
    assert!(warning(&model).contains("1 triangles name a vertex that is not there, as 9 of 4"));
    let text = document(|_| ()).0.replace("\"scenes\":[", "\"scenes\":[0,");
    let error = load("k.gltf", text.as_bytes()).unwrap_err();
    assert_eq!(error.line, Some(1), "{error}");
}

/// Every beginning of a file, and files with other bytes somewhere: read or refused, without a panic.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn mutated_files_of_all_formats_never_panic() {
    let files = [
        ("a.stl", text().into_bytes()),
        ("b.stl", binary(b"")),
        ("a.ply", ply("ascii")),
        ("b.ply", ply("binary_big_endian")),
        ("a.glb", changed(|d| d["nodes"][0]["scale"] = json!([1, 2, 3]))),
    ];
    let (mut read, mut refused) = (0, 0);
    let mut look = |name: &str, bytes: &[u8]| {
        *if is_read(&load(name, bytes)) { &mut read } else { &mut refused } += 1;
    };
    let mut rng = Rng::new("model formats", 0, 0);
    let mut below = |limit: usize| below(&mut rng, limit);
    for (name, bytes) in &files {
        for length in (0..bytes.len()).step_by(3) {
            look(name, &bytes[..length]);
        }
        for _ in 0..400 {
            let mut changed = bytes.clone();
            for _ in 0..=below(3) {
                let at = below(changed.len());
                changed[at] = match below(3) {
                    0 => below(256) as u8,
                    1 => b"0123456789-{}[],:\" \n"[below(20)],
                    _ => changed[below(bytes.len())],
                };
            }
            look(name, &changed);
        }
    }
    assert!(read > 300 && refused > 300, "{read} read, {refused} refused");
}

#[test]
fn files_that_are_broken_or_of_other_formats_are_named() {
    let cut = text().replace("endloop\nendfacet\nendsolid a b\n", "");
    for (name, bytes, cause) in [
        ("cut.stl", cut.as_bytes(), ":23: the file ends inside this facet"),
        ("word.stl", b"solid\nfacet\nvertex 1 2 x\n", ":3: 'vertex 1 2 x' is not"),
        ("two-bytes.stl", b"solid\r\nfacet\r\nvertex 1 2 x\r\n", ":3: 'vertex 1 2 x' is not"),
        (
            "short.stl",
            b"solid\nfacet\nvertex 1 2 3\nendfacet\n",
            ":4: a facet ends with 1 vertices",
        ),
        ("a.fbx", b"Kaydara FBX Binary  \0", "this is a file of the format FBX"),
        ("a.dae", b"\xef\xbb\xbf<?xml version=\"1.0\"?>\n<COLLADA>", "of the format COLLADA"),
        ("a.3ds", b"MM\x08\0\0\0\x01\x02", "of the format 3DS"),
        ("a.ase", b"\xff\xfe*\x003\0D\0S\0M\0A\0X\0_\0A\0S\0C\0I\0I\0E\0X\0P\0O\0R\0T\0", "of the format ASE"),
        ("a.off", b"OFF\n3 1 0\n", "of the format OFF"),
        ("a.pz3", b"{\n\nversion\n", "of the format Poser"),
        ("a.xyz", b"1 2 3\n", "and its name ends in .xyz; is it an OBJ?"),
        ("broken-a.ply", b"ply\nformat ascii 1.0\nelement vertex x\n", ":3: 'element vertex x' is no line of a header"),
        ("broken-b.ply", b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n1 2\n", ":9: vertex 2 of 2: the line has fewer numbers"),
        ("broken-c.ply", b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list int int vertex_index\nend_header\n1 2 3\n3 0 0 1\n", ":11: face 1 names vertex 1, and the file has 1"),
        ("empty.stl", b"solid\nendsolid\n", "has no faces"),
    ] {
        let error = load(name, bytes).unwrap_err().to_string();
        assert!(error.contains(cause), "{name}: {error}");
    }
}

/// The head of a GLB says how long it is.
#[test]
fn what_follows_the_length_of_a_glb_is_left_out() {
    let plain = changed(|_| ());
    let obj = corners(&load("plain.glb", &plain).unwrap());
    let bin = [&8u32.to_le_bytes()[..], b"BIN\0", &[0; 8]].concat();
    for (more, count) in [(&[0; 4][..], 4), (&[7; 3], 3), (&bin, 16), (&[1; 1000], 1000)] {
        let model = load("more.glb", &[&plain, more].concat()).unwrap();
        assert_eq!(corners(&model), obj, "{count}");
        let said = format!("more.glb: {count} bytes follow the last chunk; they are left out");
        assert!(warning(&model).contains(&said), "{:?}", model.warnings);
    }
    // Bytes within the length that are no chunk, and lengths that programs write before they know them.
    let length = plain.len() as u32;
    for (said, more, part) in [
        (length + 2, 2, "2 bytes follow the last chunk"),
        (0, 0, "its head says that it has 0 bytes, and its chunks have"),
        (length - 4, 0, "bytes, and its chunks have"),
        (u32::MAX, 0, "its head says that it has 4294967295 bytes, and it has"),
    ] {
        let mut file = plain.clone();
        file[8..12].copy_from_slice(&said.to_le_bytes());
        file.resize(plain.len() + more, 9);
        let model = load("length.glb", &file).unwrap();
        assert_eq!(corners(&model), obj, "{said}");
        assert!(warning(&model).contains(part), "{said}: {:?}", model.warnings);
    }
    let error = load("cut.glb", &plain[..plain.len() - 1]).unwrap_err().to_string();
    assert!(error.contains("is cut off: the chunk at byte"), "{error}");
}

/// Numbers that are not finite, in formats other than OBJ.
#[test]
fn faces_without_finite_numbers_are_left_out_of_every_format() {
    let position = "position that is not finite of 3 faces";
    let check = |name: &str, bytes: &[u8], left: usize, line: &str, not_drawn: &str| {
        let model = load(name, bytes).unwrap();
        let triangles: usize = model.items.iter().map(|item| item.mesh.triangles.len()).sum();
        assert_eq!((triangles, &*model.not_drawn), (left, not_drawn), "{name}");
        let said = format!("{name}{line}: {} of 4 faces are left out", 4 - left);
        assert!(warning(&model).contains(&said), "{name}: {:?}", model.warnings);
        let positions = model.items.iter().flat_map(|item| item.mesh.positions.iter());
        assert!(positions.into_iter().all(|position| position.is_finite()), "{name}");
    };
    let mut stl = binary(b"");
    stl[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    check("b.stl", &stl, 3, "", "position that is not finite of 1 face");
    let stl = text().replacen("vertex 0 0 0", "vertex -nan(ind) 0 0", 1);
    check("t.stl", stl.as_bytes(), 3, ":2", "position that is not finite of 1 face");
    // Vertex 1, which three faces use.
    for word in ["nan", "-inf", "1.#QNAN"] {
        let ply = String::from_utf8(ply("ascii")).unwrap().replacen(
            "1 0 0 255",
            &format!("{word} 0 0 255"),
            1,
        );
        check(
            "t.ply",
            ply.as_bytes(),
            1,
            ":21",
            &format!("1 edge, {position}, value 'quality' of 4 positions"),
        );
    }
    for form in ["binary_little_endian", "binary_big_endian"] {
        let mut ply = ply(form);
        let one = if form.contains("big") { 1f64.to_be_bytes() } else { 1f64.to_le_bytes() };
        let at = ply.windows(8).position(|bytes| bytes == one).unwrap();
        ply[at..at + 8].fill(0xff);
        check("b.ply", &ply, 1, "", &format!("1 edge, {position}, value 'quality' of 4 positions"));
    }
    let mut file = document(|_| ());
    file.1[12..16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    check("a.glb", &glb(file), 1, "", position);
    // A vertex that no face uses, which may be anywhere.
    for far in [f32::NAN, f32::MAX] {
        let mut file = document(|d| d["accessors"][1]["count"] = json!(3));
        file.1[36..40].copy_from_slice(&far.to_le_bytes());
        let model = load("unused.glb", &glb(file)).unwrap();
        assert_eq!((model.warnings.len(), model.not_drawn.as_str()), (0, ""), "{far}");
    }
    let mut file = document(|_| ());
    file.1[36..40].copy_from_slice(&f32::MAX.to_le_bytes());
    let error = load("far.glb", &glb(file)).unwrap_err().to_string();
    assert!(
        error.contains(
            "position 4 of part 'nodes[0] body meshes[0].primitives[0]' is larger than 1e38"
        ),
        "{error}"
    );
    let uv = document(|d| {
        d["accessors"]
            .as_array_mut()
            .unwrap()
            .push(json!({ "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }));
        d["images"] =
            json!([{ "uri": format!("data:image/png;base64,{}", STANDARD.encode(picture())) }]);
        d["textures"] = json!([{ "source": 0 }]);
        d["materials"] =
            json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        let body = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 2 }, "material": 0 });
        d["meshes"][0]["primitives"][0] = body;
        d["accessors"][0]["count"] = json!(3);
    });
    let mut uv = uv;
    uv.1[48..56].fill(0xff);
    let model = load("uv.glb", &glb(uv)).unwrap();
    assert!(
        warning(&model).contains("1 texture coordinates are not finite"),
        "{:?}",
        model.warnings
    );
}

/// The faces of an OBJ with this after each number.
fn with_slashes(obj: &str, after: &str) -> String {
    let line = |line: &str| match line.strip_prefix("f ") {
        Some(face) => format!("f {}{after}\n", face.replace(' ', &format!("{after} "))),
        None => format!("{line}\n"),
    };
    obj.lines().map(line).collect()
}

/// The tetrahedron as a PLY whose faces come first and have numbers of eight bytes.
fn wide_ply(form: &str, kind: &str) -> Vec<u8> {
    let head = format!(
        "ply\nformat {form} 1.0\nelement face 4\nproperty list uint8 {kind} vertex_index\nelement vertex 4\n\
         property float32 x\nproperty float32 y\nproperty float32 z\nend_header\n"
    );
    let mut bytes = head.into_bytes();
    if form == "ascii" {
        let face = |face: [usize; 3]| format!("3 {} {} {}\n", face[0], face[1], face[2]);
        let vertex = |[x, y, z]: [f32; 3]| format!("{x} {y} {z}\n");
        bytes.extend(FACES.map(face).concat().bytes());
        bytes.extend(POSITIONS.map(vertex).concat().bytes());
        return bytes;
    }
    let is_big = form.contains("big");
    for face in FACES {
        bytes.push(3);
        let word =
            |at: usize| if is_big { (at as u64).to_be_bytes() } else { (at as u64).to_le_bytes() };
        bytes.extend(face.map(word).concat());
    }
    let word = |x: f32| if is_big { x.to_be_bytes() } else { x.to_le_bytes() };
    bytes.extend(POSITIONS.into_iter().flatten().flat_map(word));
    bytes
}

/// Variants of files that many programs write, each with the warnings that it has.
#[test]
fn files_that_other_programs_read_are_read() {
    let expected = corners(&load("plain.obj", obj().as_bytes()).unwrap());
    let check = |name: &str, bytes: &[u8], warnings: &[&str]| {
        let model = load(name, bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(corners(&model), expected, "{name}");
        assert_eq!(model.warnings.len(), warnings.len(), "{name}: {:?}", model.warnings);
        for (said, part) in model.warnings.iter().zip(warnings) {
            assert!(said.contains(part), "{name}: {said}");
        }
        model.format
    };
    let stl = text();
    let title = |text: &str| {
        let word = |word: &str| word[..1].to_uppercase() + &word[1..];
        let line = |line: &str| line.split(' ').map(word).collect::<Vec<_>>().join(" ");
        text.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
    };
    let marked = format!("\u{feff}{stl}");
    // Each end of a line that there is.
    let mixed = |text: &str| {
        let ends = ["\n", "\r\n", "\r", "\n\r\n"].into_iter().cycle();
        text.lines().zip(ends).map(|(line, end)| [line, end].concat()).collect::<String>()
    };
    for (name, text) in [
        ("upper.stl", stl.to_uppercase()),
        ("title.stl", title(&stl)),
        ("mark.stl", marked),
        ("end-solid.stl", stl.replace("endsolid", "end solid")),
        ("end-all.stl", stl.replace("end", "END ")),
        ("spaces.stl", format!("\n  \t{}", stl.replace('\n', " \r\n\t"))),
        ("old.stl", stl.replace('\n', "\r")),
        ("one-line.stl", stl.replace('\n', " ")),
        ("one-line-upper.stl", stl.to_uppercase().replace('\n', "  ")),
        ("one-line-two-words.stl", stl.replace('\n', " ").replace("end", "end ")),
        ("line-for-each-facet.stl", stl.replace('\n', " ").replace("facet n", "\nfacet n")),
        ("named.stl", stl.replace("solid a b", "solid solid facet of a solid")),
        ("fortran.stl", stl.replace("vertex 1", "vertex 1.0D+00")),
        ("mixed.stl", mixed(&stl)),
        ("no-name.stl", stl.replace(" a b", "")),
        ("no-solid.stl", stl.replacen("solid a b\n", "", 1)),
        (
            "no-endfacet.stl",
            stl.replace("endfacet\n", "").replace("endsolid", "endfacet\nendsolid"),
        ),
    ] {
        assert_eq!(check(name, text.as_bytes(), &[]), Format::Stl, "{name}");
    }
    check(
        "colour.stl",
        stl.replacen("facet", "color 1 0 0\nfacet", 1).as_bytes(),
        &[":2: 'color 1 0 0' is no line of an STL; the line is left out"],
    );
    // One solid after the other in one line, of which one is empty.
    let two = format!("{stl}solid empty\nendsolid\n{stl}").replace('\n', " ");
    let two = load("two.stl", two.as_bytes()).unwrap();
    let names: Vec<&str> = two.origins.iter().map(|origin| &*origin.part).collect();
    assert_eq!((corners(&two).len(), &names[..]), (24, &["a b", "a b"][..]));
    let cut = stl.replace('\n', " ");
    let error = load("cut-line.stl", &cut.as_bytes()[..cut.len() - 40]).unwrap_err().to_string();
    assert!(error.contains("it is truncated, with 3 whole triangles"), "{error}");
    let comma = "vertex 1,0 0,000 0";
    check(
        "comma.stl",
        stl.replacen("vertex 1 0 0", comma, 1).as_bytes(),
        &[":6: the comma of '1,0' is taken as a decimal point"],
    );
    let zeros = [stl.as_bytes(), &[0; 3]].concat();
    check(
        "zeros.stl",
        &zeros,
        &["'\\u{0}\\u{0}\\u{0}' is no line of an STL; the line is left out"],
    );
    let no_end = stl.replace("endsolid a b\n", "");
    check(
        "no-end.stl",
        no_end.as_bytes(),
        &["ends without 'endsolid' after 4 triangles: it may be truncated"],
    );
    for header in [&b""[..], b"solid from CAD", b"SOLID", b"COLOR=\xff\0\0\xff"] {
        let binary = binary(header);
        check("whole.stl", &binary, &[]);
        for more in [1, 2, 49, 50, 5_000] {
            let said =
                format!("{more} bytes follow the last of its 4 triangles; they are left out");
            check("more.stl", &[&binary, &vec![b' '; more][..]].concat(), &[&said]);
            check("more.bin", &[&binary, &vec![0; more][..]].concat(), &[&said]);
        }
        for less in [1, 49, 51, 150, 200] {
            let error = load("less.stl", &binary[..binary.len() - less]).unwrap_err().to_string();
            let there = (200 - less) / 50;
            let said =
                format!("is truncated: its header announces 4 triangles, and it has {there}:");
            assert!(error.contains(&said), "{less}: {error}");
        }
        let error = load("head.stl", &binary[..83]).unwrap_err().to_string();
        assert!(
            error.contains("is truncated: an STL without text begins with 84 bytes"),
            "{error}"
        );
        for announced in [0u32, u32::MAX] {
            let mut unknown = binary.clone();
            unknown[80..84].copy_from_slice(&announced.to_le_bytes());
            let said =
                format!("its header announces {announced} triangles, and it has 4, which are read");
            check("unknown.stl", &unknown, &[&said]);
        }
    }
    // Cut off anywhere in a facet.
    let facet = stl.rfind("facet normal").unwrap();
    for end in facet + 12..stl.find("endsolid").unwrap() - 1 {
        let error = load("cut.stl", &stl.as_bytes()[..end]).unwrap_err().to_string();
        assert!(error.contains("it is truncated, with 3 whole triangles"), "{end}: {error}");
    }
    // Ways of writing an OBJ.
    let obj = obj();
    for (name, text) in [
        ("mixed.obj", mixed(&obj)),
        ("return.obj", obj.replace('\n', "\r")),
        ("no-end.obj", obj.trim_end().to_owned()),
        ("upper.obj", obj.to_uppercase()),
        ("tabs.obj", format!("\t{}", obj.replace(' ', "\t").replace('\n', " \n  \t"))),
        ("comments.obj", format!("# folder C:\\models\\\n{}", obj.replace('\n', " # end \\#\n"))),
        ("continued.obj", obj.replace("f ", "f \\\n")),
        ("slashes.obj", with_slashes(&obj, "//")),
        ("slash.obj", with_slashes(&obj, "/")),
        ("fractions.obj", with_slashes(&obj, ".000000")),
        ("weights.obj", obj.replacen("v 1 0 0", "v 1.0d0 0e0 +0 1", 1)),
        ("rest.obj", format!("o a b c\nvt 0.5\nvt .5 .5 .5\n{obj}s off\ng\nusemtl\n")),
    ] {
        check(name, text.as_bytes(), &[]);
    }
    let points = format!("{obj}l 1 2 3\np 1 2\n");
    assert_eq!(load("points.obj", points.as_bytes()).unwrap().not_drawn, "1 line, 1 point");
    let comma = obj.replacen("v 1 0 0", "v 1,0 0,0 0", 1);
    check("comma.obj", comma.as_bytes(), &[":2: the comma of '1,0' is taken as a decimal point"]);
    // Ways of writing a PLY.
    let head_of = |bytes: &[u8], change: &dyn Fn(&str) -> String| {
        let end = bytes.windows(11).position(|bytes| bytes == b"end_header\n").unwrap() + 11;
        [change(std::str::from_utf8(&bytes[..end]).unwrap()).as_bytes(), &bytes[end..]].concat()
    };
    for form in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let ply = ply(form);
        let upper = head_of(&ply, &str::to_uppercase);
        let quality = "value 'QUALITY' of 4 positions";
        let model = load("upper.ply", &upper).unwrap();
        assert_eq!(
            (corners(&model), &*model.not_drawn),
            (expected.clone(), &*format!("1 edge, {quality}"))
        );
        let comments = |head: &str| head.replace("\nelement", "\ncomment a\nobj_info b\n\nelement");
        check("comments.ply", &head_of(&ply, &comments), &[]);
        for end in ["\r\n", "\r", " \r\n", "\t\n"] {
            check("ends.ply", &head_of(&ply, &|head| head.replace('\n', end)), &[]);
        }
    }
    let text = String::from_utf8(ply("ascii")).unwrap();
    check("mixed.ply", mixed(&text).as_bytes(), &[]);
    check("no-end.ply", text.trim_end().as_bytes(), &[]);
    let comma = text.replacen("1 0 0 255", "1,0 0 0 255", 1);
    check("comma.ply", comma.as_bytes(), &[":18: from this line on, a comma in a number is"]);
    // Indices of 64 bits, and faces before what they name.
    for form in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for kind in ["int64", "uint64", "long", "ulong"] {
            check("wide.ply", &wide_ply(form, kind), &[]);
        }
    }
    // A byte order mark before everything, and chunks that are filled with zeros.
    let mark = |bytes: &[u8]| [b"\xef\xbb\xbf", bytes].concat();
    check("mark.obj", &mark(obj.as_bytes()), &[]);
    for form in ["ascii", "binary_little_endian", "binary_big_endian"] {
        check("mark.ply", &mark(&ply(form)), &[]);
    }
    let (json, bytes) = document(|_| ());
    let data = STANDARD.encode(&bytes);
    let uri = format!("data:;base64,{data}");
    let (json_alone, _) = document(|d| d["buffers"][0]["uri"] = json!(uri));
    let escaped = data.replace('+', "%2B").replace('/', "%2f").replace('=', "%3D");
    for uri in [
        format!("data:application/octet-stream;charset=utf-8;base64,{data}"),
        format!("data:APPLICATION/GLTF-BUFFER;BASE64;charset=utf-8,{data}"),
        format!("data:;base64,{escaped}"),
        format!("data:;base64,{}", data.replace('+', "-").replace('/', "_")),
    ] {
        let (json, _) = document(|d| d["buffers"][0]["uri"] = json!(uri));
        check("uri.gltf", json.as_bytes(), &[]);
    }
    // Whole numbers with a fraction, and a version that is a number.
    let (json_fractions, _) = document(|d| {
        d["buffers"][0]["uri"] = json!(uri);
        d["asset"]["version"] = json!(2.0);
        d["accessors"][0]["count"] = json!(4.0);
        d["bufferViews"][1]["byteOffset"] = json!(48.0);
        d["meshes"][0]["primitives"][0]["indices"] = json!(1.0);
    });
    check("fractions.gltf", json_fractions.as_bytes(), &[]);
    check("mark.gltf", &mark(json_alone.as_bytes()), &[]);
    check("mark.glb", &glb((format!("\u{feff}{json}"), bytes.clone())), &[]);
    check("zeros.glb", &glb((json + "\0\0\0\0\0", bytes)), &[]);
    let folder = folder();
    folder.put("m.mtl", mark(b"newmtl a\nKd 1 0 0\n"));
    folder.put("old.mtl", b"newmtl a\rKd 1 0 0\r");
    for name in ["m", "old"] {
        let text = format!("mtllib {name}.mtl\nusemtl a\n{obj}");
        let model = load_in(&folder, "m.obj", text.as_bytes()).unwrap();
        assert_eq!(model.items[0].material.colour, DVec3::X, "{name}");
    }
    // Colours of ZBrush in comments, of two positions a line at most here.
    let text = format!("{obj}#MRGB ffff0000ff00ff00\n#MRGB ff0000ff\n# a comment\n");
    assert_eq!(
        load("z.obj", text.as_bytes()).unwrap().not_drawn,
        "ZBrush colour (#MRGB) of 3 positions"
    );
}

/// A name with a space before or after it is the name of a file with one or without, and what is required is named.
#[test]
fn names_of_a_gltf_are_found_and_said() {
    let folder = folder();
    for name in [" before.png", "after.png ", "plain.png"] {
        folder.put(name, picture());
    }
    let model = |uri: &str| {
        let file = changed(|d| {
            d["images"] = json!([{ "uri": uri }]);
            d["textures"] = json!([{ "source": 0 }]);
            d["materials"] =
                json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
            d["meshes"][0]["primitives"][0]["material"] = json!(0);
        });
        load_in(&folder, "m.glb", &file).unwrap()
    };
    for uri in [
        "plain.png?v=3",
        "Plain.PNG#a",
        "./plain%2Epng",
        " before.png",
        "%20before.png",
        "after.png ",
        "after.png%20",
        " plain.png ",
        "plain.png",
    ] {
        let model = model(uri);
        assert!(model.items[0].material.texture.is_some(), "{uri:?}: {:?}", model.warnings);
    }
    let uri = format!(" data:image/png;base64,{} ", STANDARD.encode(picture()));
    assert!(model(&uri).items[0].material.texture.is_some());
    let required = changed(|d| {
        d["extensionsUsed"] = json!(["FOO_used", "FOO_both", "FOO_both", "KHR_materials_unlit"]);
        d["extensionsRequired"] = json!(["FOO_bar", "FOO_both", "KHR_materials_unlit"]);
    });
    let model = load_in(&folder, "required.glb", &required).unwrap();
    let names = "1 extension FOO_bar, 1 extension FOO_both, 1 extension FOO_used";
    assert_eq!(model.not_drawn, names);
    for (said, name) in model.warnings.iter().zip(["FOO_bar", "FOO_both"]) {
        assert!(
            said.contains(&format!("requires the extension {name}, which is not read")),
            "{said}"
        );
    }
    assert_eq!(model.warnings.len(), 2, "{:?}", model.warnings);
    for (mode, why) in [("BLEND", "the material 'air' is fully transparent"), ("OPAQUE", "")] {
        let file = changed(|d| {
            let colour = json!({ "baseColorFactor": [1, 1, 1, 0], "metallicFactor": 0 });
            d["materials"] =
                json!([{ "name": "air", "alphaMode": mode, "pbrMetallicRoughness": colour }]);
            d["meshes"][0]["primitives"][0]["material"] = json!(0);
        });
        assert_eq!(load_in(&folder, "clear.glb", &file).unwrap().why_empty, why, "{mode}");
    }
    // What programs write where they have nothing, and addresses and textures as they write them.
    let bytes = STANDARD.encode(document(|_| ()).1);
    let lines =
        format!("DATA:application/octet-stream;BASE64,{}\r\n{}\r\n", &bytes[..40], &bytes[40..]);
    let (json, _) = document(|d| {
        d["buffers"][0]["uri"] = json!(lines);
        for key in ["skins", "samplers", "animations", "extensionsRequired"] {
            d[key] = Value::Null;
        }
        d["images"] = json!([{ "uri": "file:///nowhere/plain.png" }]);
        d["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
        d["materials"] = json!([{
            "doubleSided": null, "emissiveFactor": null, "alphaMode": null, "extensions": null,
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
        }]);
        d["meshes"][0]["primitives"][0]["material"] = json!(0);
        d["extensionsUsed"] = json!(["EXT_texture_webp"]);
    });
    let model = load_in(&folder, "nulls.gltf", json.as_bytes()).unwrap();
    assert!(model.items[0].material.texture.is_some(), "{:?}", model.warnings);
    assert_eq!(model.not_drawn, "");
}
