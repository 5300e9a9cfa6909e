//! Models in formats other than OBJ.

use std::fs;
use std::path::Path;

use rasterproof_models::{BadFile, Format, Model, Options, Up};

const POSITIONS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn load(name: &str, bytes: &[u8]) -> Result<Model, BadFile> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("model_formats");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    rasterproof_models::load(&path, Options { up: Some(Up::Y), ..Options::default() })
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

/// The positions of all corners, in order.
fn corners(model: &Model) -> Vec<[f64; 3]> {
    let of = |item: &rasterproof_render::scene::Item| {
        let positions = item.mesh.positions.clone();
        let corners = item.mesh.triangles.clone().into_iter().flatten();
        corners
            .map(move |corner| positions[corner.position as usize].to_array())
            .collect::<Vec<_>>()
    };
    model.items.iter().flat_map(of).collect()
}

#[test]
fn an_stl_of_either_kind_is_the_same_as_an_obj() {
    let mut obj = String::new();
    for [x, y, z] in POSITIONS {
        obj += &format!("v {x} {y} {z}\n");
    }
    for face in FACES {
        let [a, b, c] = face.map(|at| at + 1);
        obj += &format!("f {a} {b} {c}\n");
    }
    let obj = corners(&load("a.obj", obj.as_bytes()).unwrap());
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

#[test]
fn files_that_are_broken_or_of_other_formats_are_named() {
    let cut = text().replace("endloop\nendfacet\nendsolid a b\n", "");
    for (name, bytes, cause) in [
        ("cut.stl", cut.as_bytes(), ":23: the file ends inside this facet"),
        ("word.stl", b"solid\nfacet\nvertex 1 2 x\n", ":3: 'vertex 1 2 x' is not"),
        (
            "short.stl",
            b"solid\nfacet\nvertex 1 2 3\nendfacet\n",
            ":4: a facet ends with 1 vertices",
        ),
        ("a.fbx", b"Kaydara FBX Binary  \0", "this is a file of the format FBX"),
        ("a.stl", b"solid\nendsolid\n", "has no faces"),
    ] {
        let error = load(name, bytes).unwrap_err().to_string();
        assert!(error.contains(cause), "{name}: {error}");
    }
}
