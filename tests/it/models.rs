//! Models and textures from files: what is well formed is drawn, what is broken is named with its
//! file, line and cause.

use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};
use rasterproof_core::random::Rng;
use rasterproof_models::{BadFile, LoadOptions, Model, Normals, load_texture};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::scene::{Shading, shapes};
use serde_json::json;

use crate::program::Folder;

pub fn load(path: &Path, shading: Shading) -> Result<Model, BadFile> {
    rasterproof_models::load(path, LoadOptions { shading, ..LoadOptions::default() })
}

/// The model of this text.
fn read(folder: &Folder, text: &str, shading: Shading) -> Model {
    load(&folder.put("m.obj", text), shading).unwrap()
}

/// The one warning of a model.
#[track_caller]
pub fn warning(model: &Model) -> &str {
    let [warning] = &model.warnings[..] else { panic!("{:?}", model.warnings) };
    warning
}

/// A sphere whose vertices are moved. The file is right-handed, so its faces run the other way.
fn sphere(moved: impl Fn(DVec3) -> DVec3) -> String {
    let mesh = shapes::sphere(DVec3::ZERO, 1.0, 32, 16);
    let mut text = String::new();
    for p in mesh.positions.iter().map(|p| moved(*p)) {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for t in mesh.triangles.positions() {
        let [a, b, c] = t.map(|position| position + 1);
        text += &format!("f {a} {c} {b}\n");
    }
    text
}

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn well_formed_models_are_read() {
    let folder = Folder::new("models-good");
    let check = |name: &str, text: &str, triangles: usize| {
        let path = folder.put(name, text);
        let model = load(&path, Shading::Phong).unwrap_or_else(|error| panic!("{name}: {error}"));
        let meshes = model.items.iter().map(|item| &item.mesh);
        assert_eq!(meshes.clone().map(|m| m.triangles.len()).sum::<usize>(), triangles, "{name}");
        let corners = meshes.flat_map(|mesh| mesh.triangles.corners());
        for corner in corners {
            assert!((corner.normal.length() - 1.0).abs() < 1e-12, "{name}: {corner:?}");
        }
        model
    };
    check("plain.obj", TETRAHEDRON, 4);
    check("comments.obj", &format!("# a comment\n\ng part\ns off\n{TETRAHEDRON}# the end"), 4);
    check("windows.obj", &TETRAHEDRON.replace('\n', "\r\n"), 4);
    check("negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\n", 1);
    check("polygon.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n", 3);
    let mixed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1\nf 2 4 3\nf 2//1 4//1 3//1\n";
    let model = check("mixed.obj", mixed, 3);
    assert_eq!(model.items[0].mesh.triangles.at(0)[1].uv.x, 1.0);
    assert_eq!(model.items[0].mesh.triangles.at(0)[1].normal.z, -1.0, "z is turned");
    assert_eq!(model.items[0].mesh.triangles.at(1)[1].uv.x, 0.0);
}

#[test]
fn materials_and_textures_are_read() {
    let folder = Folder::new("models-materials");
    let picture = RgbImage::from_pixel(2, 2, Rgb([255, 0, 0]));
    for name in ["a.png", "b.jpg", "c.bmp"] {
        picture.save(folder.join(name)).unwrap();
    }
    let mtl = "newmtl one\nKd 0.5 0.25 1\nnewmtl two\nmap_Kd a.png\nnewmtl three\nmap_Kd -s 1 1 1 b.jpg\nnewmtl four\nmap_Kd c.bmp\n";
    folder.put("m.mtl", mtl);
    let mut text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n".to_owned();
    for name in ["one", "two", "three", "four"] {
        text += &format!("usemtl {name}\nf 1/1 2/2 3/3\n");
    }
    let obj = folder.put("m.obj", text);
    let model = load(&obj, Shading::Unlit).unwrap();
    assert_eq!(model.warnings, Vec::<String>::new());
    assert_eq!(model.items.len(), 4);
    assert_eq!(model.items[0].material.colour.to_array(), [0.5, 0.25, 1.0]);
    for item in &model.items[1..] {
        let colour = item.material.texture.as_ref().unwrap().at(DVec2::splat(0.5));
        assert!(colour.x > 0.9 && colour.y < 0.1, "{colour}");
    }
    fs::remove_file(folder.join("m.mtl")).unwrap();
    let model = load(&obj, Shading::Unlit).unwrap();
    assert!(model.warnings[0].contains("m.mtl"), "{:?}", model.warnings);
}

#[test]
fn broken_files_are_named_with_line_and_cause() {
    let folder = Folder::new("models-broken");
    let check = |name: &str, text: &[u8], line: Option<usize>, cause: &str| {
        let read = load(&folder.put(name, text), Shading::Phong);
        let error = read.err().unwrap_or_else(|| panic!("{name} is read"));
        assert_eq!(error.line, line, "{name}: {error}");
        assert!(error.cause.contains(cause), "{name}: {error}");
        assert!(error.to_string().contains(name), "{error}");
    };
    check("huge.obj", b"v 0 0 0\nv 1 1e39 0\nv 0 1 0\nf 1 2 3\n", Some(2), "larger than 1e38");
    check("word.obj", b"v 0 0 zero\nf 1 1 1\n", Some(1), "not a number");
    check("short.obj", b"v 0 0 0\nv 1 0\nf 1 2 1\n", Some(2), "2 numbers where 3");
    check("range.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", Some(4), "position 4 is not there");
    check("zero.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", Some(4), "not there");
    check("before.obj", b"v 0 0 0\nf -1 -2 -3\n", Some(2), "not there");
    check("faceless.obj", b"v 0 0 0\nv 1 0 0\n", None, "no faces");
    check("empty.obj", b"", None, "is empty");
    check("bytes.obj", &[0xff, 0xfe, 0, 1, 2, 200, 10, 13], None, "no faces");
    let directory = load(&folder, Shading::Phong).err().unwrap();
    assert!(directory.cause.contains("directory"), "{directory}");
    let missing = load(&folder.join("none.obj"), Shading::Phong).err().unwrap();
    assert!(missing.cause.contains("cannot be read"), "{missing}");
}

#[test]
fn broken_textures_are_named() {
    let folder = Folder::new("models-textures");
    let picture = folder.join("a.png");
    RgbImage::from_fn(64, 64, |x, y| Rgb([x as u8, y as u8, 7])).save(&picture).unwrap();
    let bytes = fs::read(&picture).unwrap();
    assert!(load_texture(&picture).is_ok());
    for length in [0, 1, 8, 20, bytes.len() / 2, bytes.len() - 20] {
        fs::write(&picture, &bytes[..length]).unwrap();
        let error = load_texture(&picture).expect_err("a truncated picture is read");
        assert!(error.to_string().contains("a.png"), "{error}");
    }
    folder.put("m.mtl", "newmtl a\nmap_Kd a.png\n");
    let text = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let model = read(&folder, text, Shading::Phong);
    assert!(warning(&model).contains("a.png: is not a readable PNG"), "{:?}", model.warnings);
    assert!(model.items[0].material.texture.is_none());
}

#[test]
fn render_draws_models_by_both() {
    let folder = Folder::new("models-render");
    folder.put("ball.obj", sphere(|p| p));
    for options in [
        "--aa none",
        "--aa msaa4 --shading flat",
        "--aa ssaa2 --cull cw --depth unorm24",
        "--wireframe --shading gouraud",
        "--zoom 4 --depth f32-reversed",
        "--effects all,-clip",
    ] {
        let words = format!("render ball.obj --size 96x72 -o ball.png {options}");
        folder.check(words, 0).shows("AGREES").shows("loaded in ").shows("; drawn in ");
        assert_eq!(image::open(folder.join("ball.png")).unwrap().width(), 96);
    }
    folder.check("render --scene spinning --size 40x30 --spin 3 -o spin.gif", 0);
    assert!(fs::read(folder.join("spin.gif")).unwrap().starts_with(b"GIF89a"));
}

#[test]
fn render_refuses_what_it_cannot_draw() {
    let folder = Folder::new("models-refuses");
    folder.put("t.obj", TETRAHEDRON);
    for (words, part) in [
        ("t.obj -o t.png --size 100000x100000", "too large"),
        ("t.obj -o t.png --size 0x10", "no pixels"),
        ("t.obj -o t.png --size 10", "WIDTHxHEIGHT"),
        ("t.obj -o t.png --size 9000x9000 --aa ssaa4", "too large"),
        ("t.obj -o t.png --fov 180", "180"),
        ("t.obj -o t.png --zoom 0", "--zoom"),
        ("t.obj -o t.png --zoom nan", "--zoom"),
        ("t.obj -o t.png --effects depht", "depth"),
        ("nowhere.obj", "nowhere.obj"),
        ("cub", "cub is neither a file nor a scene"),
        ("cub", "cube"),
        ("--scene cub", "cube"),
    ] {
        folder.check(format!("render {words}"), 2).shows(part);
        assert!(!folder.join("t.png").exists(), "{words}");
    }
    folder
        .check("plan panels --size 64x48 --rounds 1", 0)
        .shows("no bounding box of another piece meets");
}

/// A byte order mark is no part of a model, and a picture of nothing says so: of a triangle alone one
/// of the two windings is culled.
#[test]
fn a_picture_of_nothing_says_so() {
    let folder = Folder::new("models-nothing");
    folder.put("marked.obj", "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let is_empty = ["none", "cw", "ccw"].map(|cull| {
        let run = folder.check(format!("render marked.obj --size 40x30 --cull {cull}"), 0);
        (run.out + &run.errors).contains("EMPTY: nothing of it is seen")
    });
    assert!(!is_empty[0] && is_empty[1] != is_empty[2], "{is_empty:?}");
}

/// The picture that the program draws of a model, and what it says on standard error.
fn drawn(folder: &Folder, words: &str) -> (RgbImage, String) {
    let words = format!("render --size 96x72 --engine scanline -o out.png {words}");
    let errors = folder.check(words, 0).errors;
    (image::open(folder.join("out.png")).unwrap().into_rgb8(), errors)
}

/// Coordinates are doubles from the file to the vertex stage: single precision would leave four steps across the
/// sphere in y.
#[test]
fn a_sphere_far_from_the_origin_is_drawn_as_at_the_origin() {
    let folder = Folder::new("models-far");
    // Multiples of 1/1024 are exact in both places, so that both files hold the same sphere.
    let at = |centre: DVec3| sphere(|p| (p * 1024.0).round() / 1024.0 + centre);
    folder.put("near.obj", at(DVec3::ZERO));
    folder.put("far.obj", at(DVec3::new(431_234.123, 4_581_234.567, 120.0)));
    for options in ["", "--normals smooth --shading gouraud"] {
        let [near, far] =
            ["near", "far"].map(|name| drawn(&folder, &format!("{name}.obj {options}")).0);
        let differ = near.pixels().zip(far.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(differ, 0, "{options:?}");
    }
}

/// The same shapes as polygons and as triangles by hand: one concave at its first corner, and a ring whose outline
/// runs along a bridge to its hole and back.
#[test]
fn concave_and_ring_shaped_polygons_are_drawn_right() {
    let folder = Folder::new("models-concave");
    let concave = "v 2 1 0\nv 0 4 0\nv 0 0 0\nv 4 0 0\nv 4 4 0\n";
    let ring = "v 0 0 0\nv 6 0 0\nv 6 6 0\nv 0 6 0\nv 2 2 0\nv 2 4 0\nv 4 4 0\nv 4 2 0\n";
    let around = "f 1 2 8\nf 1 8 5\nf 2 3 7\nf 2 7 8\nf 3 4 6\nf 3 6 7\nf 4 1 5\nf 4 5 6\n";
    let cases = [
        (concave, "f 1 2 3 4 5\n", "f 1 2 3\nf 1 3 4\nf 1 4 5\n"),
        (concave, "f 2 3 4 5 1\n", "f 1 2 3\nf 1 3 4\nf 1 4 5\n"),
        (concave, "f 5 4 3 2 1\n", "f 3 2 1\nf 4 3 1\nf 5 4 1\n"),
        (ring, "f 1 2 3 4 1 5 6 7 8 5\n", around),
    ];
    for (vectors, polygon, triangles) in cases {
        folder.put("polygon.obj", format!("{vectors}{polygon}"));
        folder.put("triangles.obj", format!("{vectors}{triangles}"));
        for pitch in [0, 35] {
            let [(polygon, errors), (triangles, _)] = ["polygon", "triangles"].map(|name| {
                drawn(&folder, &format!("{name}.obj --yaw 0 --pitch {pitch} --aa ssaa2"))
            });
            assert!(polygon == triangles, "{errors}");
            assert!(!errors.contains("warning"), "{errors}");
        }
    }
    let model = read(&folder, "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 3 0\nf 1 2 3 4\n", Shading::Flat);
    assert!(warning(&model).contains("m.obj:5: the face crosses itself"), "{:?}", model.warnings);
}

/// Corners of different kinds, within a group and across groups, keep their own texture coordinates and normals.
#[test]
fn corners_of_mixed_kinds_keep_what_they_name() {
    let folder = Folder::new("models-mixed");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\no one\nf 1//1 2//1 3//1\nvt .25 .5\nvn 1 0 0\no two\n\
        f 1/1/2 2/1/2 3/1/2\ng three\nf 1/1 2/1 3/1\nf -3 -2 -1\n";
    let model = read(&folder, text, Shading::Phong);
    let corners: Vec<_> = model
        .items
        .iter()
        .flat_map(|item| item.mesh.triangles.iter())
        .map(|[corner, ..]| (corner.normal.to_array(), corner.uv.to_array()))
        .collect();
    // Those without a normal have that of the face, which is seen from the front; z is turned.
    let expected = [
        ([0.0, 1.0, 0.0], [0.0, 0.0]),
        ([1.0, 0.0, 0.0], [0.25, 0.5]),
        ([0.0, 0.0, -1.0], [0.25, 0.5]),
        ([0.0, 0.0, -1.0], [0.0, 0.0]),
    ];
    assert_eq!(corners, expected);
    let origins: Vec<_> =
        model.origins.iter().map(|origin| (origin.part.as_str(), &origin.lines[..])).collect();
    assert_eq!(origins, [("one", &[6][..]), ("two", &[10]), ("two", &[12, 13])]);
}

#[test]
fn textures_are_found_and_decoded_or_a_warning() {
    let folder = Folder::new("models-find");
    fs::create_dir(folder.join("Maps")).unwrap();
    let picture = RgbImage::from_fn(2, 1, |x, _| Rgb([255 - x as u8 * 255, 0, x as u8 * 255]));
    for name in ["Maps/Bare Name.tga", "b.TIFF", "c.webp", "it's \"d\".png"] {
        picture.save(folder.join(name)).unwrap();
    }
    folder.put("broken.png", b"no picture");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .5\nusemtl a\nf 1/1 2/1 3/1\n";
    let read = |line: &str| {
        folder.put("m.mtl", format!("newmtl a\nKd 0 1 0\n{line}\n"));
        read(&folder, &format!("mtllib m.mtl\n{triangle}"), Shading::Unlit)
    };
    for name in [
        "Maps/Bare Name.tga",
        "maps\\bare name.TGA",
        "\"Maps/Bare Name.tga\"",
        "-s 1 1 1 -mm 0 1 Maps/Bare Name.tga",
        "b.tiff",
        "C:\\Users\\someone\\B.tiff",
        "/nowhere/on/this/machine/c.webp",
        "it's \"d\".png",
    ] {
        let model = read(&format!("map_Kd {name}"));
        assert_eq!((&model.warnings[..], model.not_drawn.as_str()), (&[][..], ""), "{name}");
        let item = &model.items[0];
        let texture = item.material.texture.as_ref().unwrap_or_else(|| panic!("{name}"));
        let colour = texture.at(item.mesh.triangles.at(0)[0].uv);
        assert_eq!(colour.to_array(), [1.0, 0.0, 0.0], "{name}");
    }
    for name in ["nowhere.png", "broken.png", "d\u{1b}[31m.png"] {
        let model = read(&format!("map_Kd {name}"));
        let warning = warning(&model);
        for part in [".png: ", "material 'a' is drawn in its colour"] {
            assert!(warning.contains(part), "{warning:?}");
        }
        assert!(!warning.contains('\u{1b}'), "{warning:?}");
        let material = &model.items[0].material;
        assert!(material.texture.is_none() && material.colour == DVec3::Y, "{name}");
    }
    // Options are applied, or named as not drawn.
    let moved = read("map_Kd -s 2 1 -o 0.25 0 -clamp on c.webp");
    let item = &moved.items[0];
    assert_eq!(item.mesh.triangles.at(0)[0].uv.to_array(), [0.75, 0.5]);
    let texture = item.material.texture.as_ref().unwrap();
    assert_eq!(texture.at(DVec2::new(1.5, 0.5)).to_array(), [0.0, 0.0, 1.0]);
    let option = read("map_Kd -mm 0.5 2 -blendu off c.webp");
    assert_eq!(option.not_drawn, "option -blendu of 1 texture, option -mm of 1 texture");
}

#[test]
fn material_files_are_found_by_all_their_names() {
    let folder = Folder::new("models-libraries");
    folder.put("one.mtl", "newmtl a\nKd 1 0 0\n");
    folder.put("two parts.mtl", "newmtl\nKd 0 1 0\nnewmtl b c\nKd 0 0 1\n");
    let faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b c\nf 1 \\\n2 3\nusemtl\nf 1 2 3\nusemtl d\nf 1 2 3\n";
    for line in [
        "mtllib one.mtl two parts.mtl",
        "mtllib two parts.mtl one.mtl",
        "mtllib ONE.MTL\nmtllib two parts.mtl",
        "mtllib .\\one.mtl\nmtllib \"two parts.mtl\"",
    ] {
        let model = read(&folder, &format!("{line}\n{faces}"), Shading::Flat);
        let colours: Vec<_> = model.items.iter().map(|item| item.material.colour).collect();
        assert_eq!(colours, [DVec3::X, DVec3::Z, DVec3::Y, DVec3::splat(0.8)], "{line}");
        assert!(warning(&model).contains("no material file describes 'd'"), "{line}");
        let first = 7 + line.lines().count() as u32;
        assert_eq!(model.origins[1].lines, [first], "a face on two lines is at the first");
    }
    // The file beside the model has another name than the model says.
    folder.put("n.mtl", "newmtl a\nKd 1 0 0\n");
    let text = "mtllib elsewhere.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let model = load(&folder.put("n.obj", text), Shading::Flat).unwrap();
    assert_eq!(model.items[0].material.colour.to_array(), [1.0, 0.0, 0.0]);
    assert!(model.warnings[0].contains("n.mtl is read in its place"), "{:?}", model.warnings);
}

/// Two squares at a right angle, with an edge between them: a corner of it has the mean of both normals where they
/// are smooth.
#[test]
fn missing_normals_are_flat_or_smooth_as_the_file_says() {
    let folder = Folder::new("models-normals");
    let squares = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nS\nf 1 2 3 4\nusemtl x\nf 2 5 6 3\n";
    let first = |lines: &str, normals: Normals| {
        let path = folder.put("m.obj", squares.replace("S\n", lines));
        let options = LoadOptions { shading: Shading::Phong, normals, ..LoadOptions::default() };
        let model = rasterproof_models::load(&path, options).unwrap();
        model.items[0].mesh.triangles.at(0)[1].normal
    };
    let (flat, half) = (DVec3::NEG_Z, 0.5f64.sqrt());
    let smooth = DVec3::new(half, 0.0, -half);
    for lines in ["", "s off\n", "s 0\n", "s\n"] {
        assert_eq!(first(lines, Normals::File), flat, "{lines:?}");
    }
    for lines in ["s 1\n", "s on\n", "s 7\n"] {
        assert!(first(lines, Normals::File).distance(smooth) < 1e-15, "{lines:?}");
    }
    assert!(first("", Normals::Smooth).distance(smooth) < 1e-15);
    assert_eq!(first("s 1\n", Normals::Flat), flat);
    // Another group begins between the squares.
    let text = squares.replace("S\n", "s 1\n").replace("usemtl x", "s 2");
    let groups = read(&folder, &text, Shading::Phong);
    assert_eq!(groups.items[0].mesh.triangles.at(0)[1].normal, flat);
    // A sheet that is listed from both sides: the normals cancel, and each side keeps its own.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\nf 3 2 1\n";
    let sheet = read(&folder, text, Shading::Phong);
    let normals: Vec<_> = sheet.items[0].mesh.triangles.iter().map(|t| t[0].normal.z).collect();
    assert_eq!(normals, [-1.0, 1.0]);
}

#[test]
fn colours_of_positions_are_drawn() {
    let folder = Folder::new("models-colours");
    let red = DVec3::X / 255.0;
    for (text, colours) in [
        (
            "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 1 0 0 1\nv 5 5 5\nf 1 2 3\n",
            [DVec3::X, DVec3::Y, DVec3::Z],
        ),
        // Bytes are recognised by the largest number of the file; a position without a colour is white.
        (
            "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 255 51\nf 1 2 3\n",
            [red, DVec3::ONE, DVec3::new(0.0, 1.0, 0.2)],
        ),
    ] {
        let item = &read(&folder, text, Shading::Unlit).items[0];
        assert!(item.material.vertex_colours && item.material.colour == DVec3::ONE, "{text}");
        assert_eq!(item.mesh.triangles.at(0).map(|corner| corner.colour), colours, "{text}");
    }
}

/// Holes come from the opacities of a texture, from a grey picture or another one's opacities, and `d 1` changes nothing;
/// below 1 a surface blends.
#[test]
fn surfaces_have_the_holes_of_their_files() {
    let folder = Folder::new("models-holes");
    // One texel opaque, the other clear.
    let two = image::RgbaImage::from_raw(2, 1, vec![9, 9, 9, 255, 9, 9, 9, 0]).unwrap();
    two.save(folder.join("alpha.png")).unwrap();
    let grey = image::GrayImage::from_raw(2, 1, vec![127, 128]).unwrap();
    grey.save(folder.join("grey.png")).unwrap();
    let mtl = "newmtl a\nmap_Kd alpha.png\nd 1\nnewmtl b\nmap_d grey.png\n\
        newmtl c\nmap_Kd grey.png\nmap_d -o 0.5 alpha.png\nnewmtl d\nmap_Kd grey.png\nTr 1\n\
        newmtl e\nd 0.2\nnewmtl f\nTr 0.2\nmap_d grey.png\n";
    folder.put("m.mtl", mtl);
    let face = |name: &str| format!("usemtl {name}\nf 1/1 2/1 3/1\n");
    let faces: String = ["a", "b", "c", "d", "e", "f"].map(face).concat();
    let text = format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.5\n{faces}");
    let model = read(&folder, &text, Shading::Phong);
    let of = |item: usize, u: f64| {
        let opacity = model.items[item].material.opacity.as_ref();
        opacity.map(|opacity| opacity.of(DVec2::new(u, 0.5)))
    };
    assert_eq!([of(0, 0.2), of(0, 0.8)], [Some(255), Some(0)]);
    assert_eq!([of(1, 0.2), of(1, 0.8)], [Some(0), Some(255)]);
    assert_eq!([of(2, 0.2), of(2, 0.8), of(3, 0.2)], [Some(255), Some(0), None]);
    assert_eq!([of(4, 0.2), of(5, 0.2)], [Some(51), Some(102)], "0.8 of 127 is 101.6");
    assert_eq!(model.not_drawn, "place of its own of 1 opacity map");
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

/// Loose lines and points are no part of the picture, so they do not make the model small in it.
#[test]
fn what_is_not_drawn_is_said_by_every_command_that_draws() {
    let folder = Folder::new("models-not-drawn");
    let mtl = "newmtl a\nKs 1 1 1\nNs 20\nd 0.5\nillum 3\nmap_Bump b.png\nnewmtl b\nKs .1 0 0\nKe 0 1 0\nmap_d c.png\n\
        newmtl unused\nKs 1 1 1\nnewmtl plain\nKd 1 0 0\nKs 0 0 0\nd 1\nTr 0\nillum 2\nKe 0 0 0\n";
    folder.put("m.mtl", mtl);
    let triangle = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let loose = "v 100 100 100\nl 1 4\np 4\np 1\ncurv 0 1 1 2\n";
    folder.put("plain.obj", format!("{triangle}usemtl plain\nf 1 2 3\n"));
    folder.put("loose.obj", format!("{triangle}{loose}usemtl plain\nf 1 2 3\n"));
    let [(plain, silent), (with, said)] =
        ["plain.obj", "loose.obj"].map(|name| drawn(&folder, name));
    assert!(plain == with, "loose elements move the picture");
    assert!(!silent.contains("not drawn"), "{silent}");
    assert!(said.contains("not drawn: 1 curve, 1 line, 2 points\n"), "{said}");
    let text = format!("{triangle}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    let shiny = Specular { colour: DVec3::ONE, shininess: 20.0 };
    let model = read(&folder, &text, Shading::Phong);
    let specular: Vec<_> = model.items.iter().map(|item| item.material.specular).collect();
    assert_eq!(specular, [shiny, Specular::default()]);
    let flatter = read(&folder, &text, Shading::Gouraud).not_drawn;
    assert!(flatter.contains("specular colour, with Gouraud shading, of 1 material"), "{flatter}");
    for command in ["render m.obj -o o.png", "plan m.obj --rounds 1"] {
        folder.check(format!("{command} --size 32x24"), 0).shows(
            "not drawn: 1 bump map, emission of 1 material, reflection (illum) of 1 material, \
             specular colour without shininess (Ns) of 1 material\n",
        );
    }
}

/// The file whose z points up looks as the one whose y does, and which axis was taken is printed.
#[test]
fn the_axis_that_points_up_is_chosen_and_said() {
    let folder = Folder::new("models-up");
    let faces = "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
    folder.put("y.obj", format!("v 0 0 0\nv 4 0 0\nv 4 0 -2\nv 1 7 -1\n{faces}"));
    folder.put("z.obj", format!("v 0 0 0\nv 4 0 0\nv 4 2 0\nv 1 1 7\n{faces}"));
    let [(usual, said), (given, silent), (lying, _)] =
        ["y.obj", "z.obj --up z", "z.obj"].map(|words| drawn(&folder, words));
    assert!(usual == given && usual != lying);
    assert!(said.contains("y points up, as is usual in OBJ; --up z for the other"), "{said}");
    assert!(!silent.contains("points up"), "{silent}");
    folder.check("render --scene cube --up z", 2).shows("--up is for models");
}

/// A sphere that is turned inside out is nearly all ambient light, and says so. Lit from both sides, it is the sphere.
#[test]
fn faces_that_run_inwards_are_noticed_and_lit_from_both_sides() {
    let folder = Folder::new("models-inwards");
    let outwards = sphere(|position| position);
    let reversed = |line: &str| {
        let corners: Vec<_> = line.split_whitespace().skip(1).collect();
        format!("f {} {} {}", corners[2], corners[1], corners[0])
    };
    let line = |line: &str| if line.starts_with("f ") { reversed(line) } else { line.to_owned() };
    let inwards = outwards.lines().map(line).collect::<Vec<_>>().join("\n");
    folder.put("out.obj", outwards);
    folder.put("in.obj", inwards);
    let note = "100% of what is seen are backs of faces, lit by the normals of their fronts; --two-sided reverses these";
    for shading in ["flat", "gouraud", "phong"] {
        let [(out, silent), (dark, said), (lit, also_silent)] =
            ["out.obj", "in.obj", "in.obj --two-sided"]
                .map(|words| drawn(&folder, &format!("{words} --shading {shading}")));
        assert!(said.contains(note), "{said}");
        assert!(
            !silent.contains("backs") && !also_silent.contains("backs"),
            "{silent}{also_silent}"
        );
        assert!(out == lit && out != dark, "{shading}");
    }
    let (_, unlit) = drawn(&folder, "in.obj --shading unlit");
    assert!(!unlit.contains("backs"), "{unlit}");
    for command in ["plan in.obj --rounds 1", "study in.obj --quick"] {
        let run = folder.check(format!("{command} --size 32x24"), 0);
        assert!(run.errors.contains("--two-sided"), "{command}: {}", run.errors);
    }
    folder.check("render --scene cube --two-sided", 2).shows("--two-sided is for models");
}

/// The same quad with its front and with its back to the eye.
#[test]
fn a_double_sided_material_is_lit_on_either_side() {
    let folder = Folder::new("models-double-sided");
    let files = [
        ("front.gltf", include_str!("../data/models/double-sided-front.gltf")),
        ("back.gltf", include_str!("../data/models/double-sided-back.gltf")),
    ];
    let [front, back] = files.map(|(name, text)| {
        folder.put(name, text);
        let (picture, said) = drawn(&folder, name);
        assert!(!said.contains("backs") && !said.contains("not drawn"), "{said}");
        picture
    });
    assert!(front == back);
    let lit = front.pixels().filter(|pixel| pixel.0[0] > 100).count();
    assert!(lit > 500, "{lit} pixels are bright");
}

/// A square with a picture of a clear and an opaque column many times beside each other: its opacity is read at the level of its
/// colour, where it is a half everywhere; without a mip map each pixel is either.
#[test]
fn holes_have_the_level_of_their_colours() {
    let folder = Folder::new("models-holes");
    let text = include_str!("../data/models/double-sided-front.gltf");
    let columns =
        image::RgbaImage::from_fn(2, 2, |x, _| image::Rgba([255, 255, 255, 255 * x as u8]));
    columns.save(folder.join("columns.png")).unwrap();
    let share = |sampler: u32, cutoff: f64, words: &str| {
        let mut document: serde_json::Value = serde_json::from_str(text).unwrap();
        let views = document["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteLength": 48, "byteStride": 12 }));
        let accessors = document["accessors"].as_array_mut().unwrap();
        accessors
            .push(json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC2" }));
        document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(3);
        document["materials"] = json!([{
            "alphaMode": "MASK", "alphaCutoff": cutoff,
            "extensions": { "KHR_materials_unlit": {} },
            "pbrMetallicRoughness": { "baseColorTexture": {
                "index": 0, "extensions": { "KHR_texture_transform": { "scale": [100, 100] } },
            } },
        }]);
        document["textures"] = json!([{ "source": 0, "sampler": 0 }]);
        document["samplers"] = json!([{ "minFilter": sampler }]);
        document["images"] = json!([{ "uri": "columns.png" }]);
        folder.put("holes.gltf", document.to_string());
        let (picture, _) = drawn(&folder, &format!("holes.gltf {words}"));
        let seen = picture.pixels().filter(|pixel| pixel.0[0] > 100).count();
        folder.check("render holes.gltf --size 96x72 -o out.png", 0).prints("AGREES");
        seen
    };
    let all = share(9987, 0.0, "");
    assert!(all > 500, "{all}");
    for words in ["", "--effects all", "--effects usual"] {
        assert_eq!([0.4, 0.6].map(|cutoff| share(9987, cutoff, words)), [all, 0], "{words}");
        let some = share(9729, 0.6, words);
        assert!(some > all / 4 && some < 3 * all / 4, "{some} of {all}");
    }
}

/// A square of one unit in the light of its file, computed by hand in its middle; others of its lights reach it nowhere.
#[test]
fn lights_of_a_file_are_those_of_the_picture() {
    let folder = Folder::new("models-lights");
    let text = include_str!("../data/models/double-sided-front.gltf");
    let pi = std::f64::consts::PI;
    let made = |light: serde_json::Value, z: f64, turn: [f64; 4]| {
        let mut document: serde_json::Value = serde_json::from_str(text).unwrap();
        document["cameras"] = json!([
            { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "znear": 0.5, "zfar": 3 } },
        ]);
        let place = [0.5, 0.5, z];
        let nodes = document["nodes"].as_array_mut().unwrap();
        nodes.push(json!({ "camera": 0, "translation": [0.5, 0.5, 2] }));
        nodes.push(json!({
            "translation": place, "rotation": turn, "extensions": { "KHR_lights_punctual": { "light": 0 } },
        }));
        document["scenes"][0]["nodes"] = json!([0, 1, 2]);
        // Nothing is reflected but what a matt surface reflects.
        document["materials"][0]["extensions"] =
            json!({ "KHR_materials_specular": { "specularFactor": 0 } });
        document["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_specular"]);
        document["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
        folder.put("m.gltf", document.to_string());
        drawn(&folder, "m.gltf --camera 1")
    };
    let ahead = [0.0, 0.0, 0.0, 1.0];
    // Half of a right angle, and a sixth of it, about y.
    let turned = |degrees: f64| {
        let half = degrees.to_radians() / 2.0;
        [0.0, half.sin(), 0.0, half.cos()]
    };
    let ambient = 0.25;
    let cases = [
        (json!({ "type": "directional", "intensity": pi / 2.0 }), 1.0, turned(60.0), 0.25),
        (json!({ "type": "directional", "intensity": 100 }), 1.0, turned(180.0), 0.0),
        (json!({ "type": "point", "intensity": 2.0 * pi }), 2.0, ahead, 0.5),
        (json!({ "type": "point", "intensity": 2.0 * pi }), -2.0, ahead, 0.0),
        // (2 / 4)^4 is a sixteenth.
        (
            json!({ "type": "point", "intensity": 2.0 * pi, "range": 4 }),
            2.0,
            ahead,
            0.5 * 15.0 / 16.0,
        ),
        (json!({ "type": "point", "intensity": 2.0 * pi, "range": 1.5 }), 2.0, ahead, 0.0),
        (json!({ "type": "spot", "intensity": 2.0 * pi }), 2.0, ahead, 0.5),
        (json!({ "type": "spot", "intensity": 2.0 * pi }), 2.0, turned(60.0), 0.0),
    ];
    for (light, z, turn, arriving) in cases {
        let (picture, said) = made(light.clone(), z, turn);
        assert!(said.contains("the light is that of 1 light of the file; ambient"), "{said}");
        assert!(!said.contains("not drawn"), "{said}");
        let linear: f64 = ambient + arriving;
        let expected = 255.0 * (1.055 * linear.powf(1.0 / 2.4) - 0.055);
        let [r, g, b] = picture.get_pixel(48, 36).0;
        // A pixel lies beside the middle.
        assert!(
            (f64::from(r) - expected).abs() < 1.0 && r == g && g == b,
            "{light}: {r}, {expected}"
        );
    }
    // Colours have red first, and other surfaces are lit by the view.
    let red = json!({ "type": "point", "intensity": 3, "color": [1, 0, 0] });
    let (picture, _) = made(red.clone(), 2.0, ahead);
    let [r, g, b] = picture.get_pixel(48, 36).0;
    assert!(r > g && g == b, "{r} {g} {b}");
    let run = folder.check("render m.gltf --size 32x24 --shadows 64 -o o.png", 0);
    run.prints("AGREES").shows("1 light of the file, and nothing keeps it from anything;");
    let run = folder.check("render m.gltf --size 32x24 --shading gouraud -o o.png", 0);
    run.shows("light of the file, without metal and roughness, of 1 primitive");
    for unknown in [json!({ "type": "area" }), json!({ "type": "point", "color": "red" }), json!(7)]
    {
        made(unknown, 2.0, ahead);
        folder.check("render m.gltf --size 32x24 -o o.png", 0).shows("not drawn: 1 light");
    }
}

/// A square of one unit, seen by cameras that stand two units before it and behind it.
#[test]
fn cameras_of_a_file_are_listed_and_looked_through() {
    let folder = Folder::new("models-cameras");
    let text = include_str!("../data/models/double-sided-front.gltf");
    let mut document: serde_json::Value = serde_json::from_str(text).unwrap();
    document["cameras"] = json!([
        { "type": "orthographic", "orthographic": { "xmag": 9, "ymag": 1, "znear": 0, "zfar": 3 } },
        { "type": "perspective", "perspective": { "yfov": std::f64::consts::FRAC_PI_2, "znear": 1 } },
        { "type": "perspective", "perspective": { "yfov": 1, "znear": 1, "zfar": 0.5 } },
    ]);
    let nodes = document["nodes"].as_array_mut().unwrap();
    nodes.push(json!({ "camera": 0, "translation": [0.5, 0.5, 2], "name": "wide" }));
    nodes.push(json!({ "camera": 1, "translation": [0.5, 0.5, 2] }));
    nodes.push(json!({ "camera": 1, "translation": [1, 0.5, -2], "rotation": [0, 1, 0, 0], "name": "behind" }));
    nodes.push(json!({ "camera": 2 }));
    document["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    folder.put("m.gltf", document.to_string());
    let (_, said) = drawn(&folder, "m.gltf");
    let list = "1 'wide', 2, 3 'behind', 4";
    assert!(
        said.contains(&format!("4 cameras: {list}; --camera 1 looks through the first")),
        "{said}"
    );
    assert!(!said.contains("not drawn"), "{said}");
    // From 72 pixels for 2 and for 4 units.
    for (words, [x0, x1], [y0, y1]) in [
        ("--camera wide", [30, 66], [18, 54]),
        ("--camera 2", [39, 57], [27, 45]),
        // Its right is the left of the others.
        ("--camera behind", [48, 66], [27, 45]),
    ] {
        let (picture, said) = drawn(&folder, &format!("m.gltf {words}"));
        assert!(!said.contains("cameras"), "{said}");
        for (x, y, pixel) in picture.enumerate_pixels() {
            let is_inside = (x0..x1).contains(&x) && (y0..y1).contains(&y);
            assert_eq!(pixel.0 != [18, 18, 24], is_inside, "{words}: {x}, {y}");
        }
    }
    for (words, said) in [
        ("--camera 5", format!("--camera 5: the model has the cameras {list}")),
        ("--camera 4", "--camera 4: the frustum needs 0 < near < far".to_owned()),
        ("--camera 1 --yaw 3", "'--yaw <DEGREES>'".to_owned()),
    ] {
        folder.check(format!("render m.gltf {words}"), 2).shows(&said);
    }
    folder.put("none.obj", TETRAHEDRON);
    folder.check("render none.obj --camera x", 2).shows("--camera x: the model has no cameras");
    folder.check("render --scene cube --camera 1", 2).shows("--camera is for models");
    // The fog begins and ends where it does without a camera, and both rasterizers agree.
    for camera in ["wide", "2"] {
        let words =
            format!("render m.gltf --size 96x72 --camera {camera} --fog 0,1 --shadows 64 -o o.png");
        folder.check(words, 0).prints("AGREES");
    }
}

/// Two repeats of a texture that is mirrored: symmetric about the middle.
#[test]
fn a_mirrored_texture_is_drawn_mirrored() {
    let folder = Folder::new("models-mirrored");
    folder.put("m.gltf", include_str!("../data/models/mirrored-repeat.gltf"));
    let (picture, said) = drawn(&folder, "m.gltf --yaw 0 --pitch 0 --shading unlit");
    assert!(!said.contains("not drawn"), "{said}");
    let (width, height) = picture.dimensions();
    let mirrored = |x: u32, y: u32| {
        picture.get_pixel(x, y) == picture.get_pixel(width - 1 - x, y)
            && picture.get_pixel(x, y) == picture.get_pixel(x, height - 1 - y)
    };
    let differ = (0..width).flat_map(|x| (0..height).map(move |y| (x, y)));
    assert_eq!(differ.filter(|&(x, y)| !mirrored(x, y)).count(), 0);
    let colours: std::collections::HashSet<_> = picture.pixels().collect();
    assert!(colours.len() > 2, "{colours:?}");
}

/// Vectors and lines that no face depends on do not keep a model from being drawn.
#[test]
fn what_no_face_uses_is_a_warning() {
    let folder = Folder::new("models-unused");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 x 2\nvt nan\nvn 1\nquad 1 2 3\nf 1 2 3\n";
    let warnings = read(&folder, text, Shading::Flat).warnings;
    for line in [4, 5, 6, 7] {
        let place = format!("m.obj:{line}: ");
        assert!(warnings.iter().any(|warning| warning.contains(&place)), "{warnings:?}");
    }
    let many = format!("{}{text}", "v x y z\n".repeat(2_000));
    let error = load(&folder.put("many.obj", many), Shading::Flat).unwrap_err();
    assert_eq!(error.line, Some(1_025), "{error}");
    let model = read(&folder, &text.replace('\n', "\r"), Shading::Flat);
    assert_eq!(model.origins[0].lines, [8], "lines that end with a carriage return alone");
    let wide = format!("\u{feff}{text}");
    let wide: Vec<u8> = wide.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let wide = folder.put("wide.obj", wide);
    let error = load(&wide, Shading::Flat).unwrap_err();
    assert!(error.cause.contains("save it as UTF-8"), "{error}");
}

/// A second opinion: `tobj` reads the same triangles of a file of triangles, in doubles here and in single
/// precision there.
#[test]
fn another_reader_reads_the_same() {
    let folder = Folder::new("models-second");
    let centre = DVec3::new(0.5, -2.0, 3.0);
    let mesh = shapes::sphere(centre, 1.5, 24, 12);
    let mut text = String::new();
    for p in mesh.positions.iter() {
        let n = *p - centre;
        text +=
            &format!("v {} {} {}\nvn {} {} {}\nvt {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z, p.x, p.y);
    }
    for (number, t) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = t.map(|corner| corner.position + 1);
        if number % 50 == 0 {
            text += &format!("g part{number}\n");
        }
        text += &format!("f {a}/{b}/{c} {c}/{a}/{b} {b}/{c}/{a}\n");
    }
    let model = read(&folder, &text, Shading::Phong);
    let options = tobj::LoadOptions::default();
    let materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (others, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, materials).unwrap();
    assert_eq!(model.items.len(), others.len());
    for (item, other) in model.items.iter().zip(&others) {
        let corners: Vec<_> = item.mesh.triangles.corners().collect();
        let other = &other.mesh;
        assert_eq!(corners.len(), other.indices.len());
        for (at, corner) in corners.iter().enumerate() {
            let three = |list: &[f32], index: u32| {
                let v = &list[3 * index as usize..][..3];
                DVec3::new(v[0].into(), v[1].into(), -f64::from(v[2]))
            };
            let position = item.mesh.positions[corner.position as usize];
            assert!(position.distance(three(&other.positions, other.indices[at])) < 1e-6);
            let normal = three(&other.normals, other.normal_indices[at]).normalize();
            assert!(corner.normal.distance(normal) < 1e-6);
            let uv = &other.texcoords[2 * other.texcoord_indices[at] as usize..][..2];
            assert!(corner.uv.distance(DVec2::new(uv[0].into(), uv[1].into())) < 1e-6);
        }
    }
}

/// A folder with models in `in`, and beside that folder a file whose text is `SECRET` in several places.
fn with_secret(name: &str) -> Folder {
    let folder = Folder::new(name);
    fs::create_dir(folder.join("in")).unwrap();
    let secret = "SECRET:x:0\nKd SECRET 1 1\nnewmtl a\nKd 1 SECRET\nSECRET\nmap_Kd SECRET.png\nmap_d SECRET.png\n";
    folder.put("secret", secret);
    // A picture up to its first chunk, whose name a decoder may show.
    let picture = [&b"\x89PNG\r\n\x1a\n\0\0\0\x04SECR"[..], secret.as_bytes()].concat();
    folder.put("secret.png", picture);
    folder
}

#[test]
fn text_outside_the_folder_is_not_quoted() {
    let folder = with_secret("models-outside");
    let faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";
    let check = |name: &str, text: &[u8], expected: &str| {
        let read = load(&folder.put(name, text), Shading::Phong);
        let said = match &read {
            Ok(model) => model.warnings.join("\n") + &model.not_drawn,
            Err(error) => error.to_string(),
        };
        assert!(!said.contains("SECR"), "{name}: {said}");
        assert!(said.contains(expected), "{name}: {said}");
        let run = folder.run(["verify", name, "--size", "16x16"]);
        assert!(!(run.out.clone() + &run.errors).contains("SECR"), "{run}");
    };
    let line = "secret:1: the line cannot be read and is left out; it is not quoted, since the file lies outside";
    let absolute = folder.join("secret").display().to_string();
    for (number, name) in ["../secret", "..\\secret", &absolute].into_iter().enumerate() {
        let text = format!("mtllib {name}\n{faces}");
        check(&format!("in/{number}.obj"), text.as_bytes(), line);
    }
    let unreadable = "is not a readable PNG, JPEG, BMP, TGA, TIFF or WebP (why is not quoted";
    folder.put("in/picture.mtl", "newmtl a\nmap_Kd ../secret.png\n");
    check("in/picture.obj", format!("mtllib picture.mtl\n{faces}").as_bytes(), unreadable);
    let ply = "ply\nformat ascii 1.0\ncomment TextureFile ../secret.png\nelement vertex 3\nproperty float x\n\
               property float y\nproperty float z\nproperty float u\nproperty float v\nelement face 1\n\
               property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n";
    check("in/picture.ply", ply.as_bytes(), unreadable);
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"%2e%2e/secret","byteLength":60}],
        "bufferViews":[{"buffer":0,"byteLength":60}],"images":[IMAGE],"textures":[{"source":0}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
            {"bufferView":0,"componentType":5125,"count":12,"type":"SCALAR"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
        "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]},{"nodes":[]}]}"#;
    for image in [r#"{"uri":"../secret.png"}"#, r#"{"bufferView":0}"#] {
        check("in/picture.gltf", gltf.replace("IMAGE", image).as_bytes(), unreadable);
    }
    // 'SECR' as a number.
    let model = load(&folder.join("in/picture.gltf"), Shading::Phong).unwrap();
    let said = model.warnings.join("\n");
    assert!(said.contains("name a vertex that is not there; they are left out"), "{said}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../secret", folder.join("in/link.mtl")).unwrap();
        check("in/link.obj", format!("mtllib link.mtl\n{faces}").as_bytes(), "not quoted");
    }
    // What lies in the folder or below it is quoted.
    fs::create_dir(folder.join("in/below")).unwrap();
    folder.put("in/below/m.mtl", "newmtl a\nPUBLIC\n");
    let path = folder.put("in/below.obj", format!("mtllib below/m.mtl\n{faces}"));
    let model = load(&path, Shading::Phong).unwrap();
    assert!(warning(&model).contains("'PUBLIC' is not a line"), "{:?}", model.warnings);
    // A name of a file is quoted where it stands in the folder alone.
    folder.put("in/below/m.mtl", "newmtl a\nmap_Kd nowhere.png\n");
    let model = load(&path, Shading::Phong).unwrap();
    assert!(warning(&model).contains("nowhere.png: cannot be read"), "{:?}", model.warnings);
}

/// Each face with something that is not there, or no number, beside a face that is whole.
#[test]
fn what_a_face_cannot_use_does_not_end_the_file() {
    let folder = Folder::new("models-cannot-use");
    let whole = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .5 .5\nvn 0 0 1\nf 1 2 3\n";
    let check = |lines: &str, triangles: usize, line: usize, cause: &str, not_drawn: &str| {
        let model = read(&folder, &format!("{whole}{lines}"), Shading::Phong);
        let drawn = model.items.iter().flat_map(|item| item.mesh.triangles.iter());
        let corners: Vec<_> = drawn.flatten().collect();
        assert_eq!((corners.len(), &*model.not_drawn), (3 * triangles, not_drawn), "{lines}");
        let place = format!("m.obj:{line}: ");
        let is_said = |said: &String| said.contains(&place) && said.contains(cause);
        assert!(model.warnings.iter().any(is_said), "{lines}: {:?}", model.warnings);
        for corner in corners {
            assert!(corner.normal.is_finite() && corner.uv.is_finite(), "{lines}: {corner:?}");
            assert!(corner.colour.is_finite(), "{lines}: {corner:?}");
        }
        model
    };
    let without = "the face is drawn without normals of the file";
    for corners in ["1//2 2//1 3//1", "1//0 2//0 3//0", "1//-2 2//-1 3//-1", "1//99999999999 2 3"] {
        let model = check(&format!("f {corners}\n"), 2, 7, without, "");
        assert_eq!(model.items[0].mesh.triangles.at(1)[0].normal, DVec3::NEG_Z, "{corners}");
    }
    check("f 1//2 2//1 3//1\n", 2, 7, "normal 2 is not there; the file has 1", "");
    check("f 1/7 2/1 3/1\n", 2, 7, "texture coordinate 7 is not there; the file has 1", "");
    check("f 1/0/0 2/0/0 3/0/0\n", 2, 7, "a texture coordinate that the face names is not", "");
    check("vn x 0 0\nf 1//2 2//2 3//2\n", 2, 7, "'x' is not a number; the faces that use it", "");
    check("vn nan 0 0\nf 1//2 2//2 3//2\n", 2, 7, "'nan' is not a finite number", "");
    check("vt inf 0\nf 1/2 2/2 3/2\n", 2, 7, "'inf' is not a finite number; it is taken as 0", "");
    let position = "position that is not finite of 1 face";
    let use_it = "is not a finite number; the faces that use it are left out";
    for word in ["nan", "-NaN", "inf", "-Infinity", "-nan(ind)", "1.#QNAN", "-1.#IND00", "1.#inf"] {
        let lines = format!("v 0 {word} 0 # comment\nf 1 2 4\nf 3 2 1\n");
        check(&lines, 2, 7, &format!("'{word}' {use_it}"), position);
        check(&lines, 2, 8, "1 of 3 faces are left out, since a position", position);
        check(&format!("v 0 {word} 0\n"), 1, 7, use_it, "");
        let colour = format!("v 0 0 1 1 {word} 0\nf 1 2 4\nf 3 2 1\n");
        check(&colour, 2, 7, use_it, "colour that is not finite of 1 face");
    }
    // As many as there may be.
    let many = format!("{}f 1 2 -1\n", "v nan nan nan\n".repeat(5_000));
    check(&many, 1, 5_007, "1 of 2 faces are left out", position);
    // Polygons, groups and colours after a face that is left out are those of the file.
    let mixed = "v nan 0 0\nv 1 1 0 1 0 0\ns 1\nf 1 2 4\nf 1 2 5 3\nf 2//1 5//1 3//1\n";
    let model = check(mixed, 4, 10, "1 of 4 faces are left out", position);
    assert_eq!(model.origins[0].lines, [6, 11, 11, 12]);
    assert_eq!(model.items[0].mesh.triangles.at(3)[1].colour, DVec3::X);
    // Without a position a face is left out.
    let missing = "position that is missing of 1 face";
    check("f 1 2 9\n", 1, 7, "position 9 is not there; the file has 3; the face is left", missing);
    check("f 1 2 0\n", 1, 7, "a position that the face names is not there; the face is", missing);
    check("f -4 2 3\n", 1, 7, "a position that the face names is not there; the face is", missing);
    check(
        "v 1 x 0\nf 1 2 4\n",
        1,
        7,
        "'x' is not a number; the faces that use it are left",
        missing,
    );
    check("v 1 x 0\nf 1 2 4\n", 1, 8, "the position of the face cannot be read; the face", missing);
    check("v 1e39 0 0\nf 1 2 4\n", 1, 7, "the coordinate 1e39 is larger than 1e38", missing);
    let mixed = "v 1 1 0\ns 1\nf 1/9 2 9\nf 1 2 4 3\nf 9//1 1//1 2//1\nf 2//1 4//1 3//1\n";
    let model = check(mixed, 4, 9, "position 9", "position that is missing of 2 faces");
    assert_eq!(model.origins[0].lines, [6, 10, 10, 12]);
    let more = "faces without their positions: 92 more of this kind";
    let model =
        check(&"f 1 2 9\n".repeat(100), 1, 14, "9 is", "position that is missing of 100 faces");
    assert!(model.warnings.iter().any(|said| said.contains(more)), "{:?}", model.warnings);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_file_of_which_no_face_can_be_drawn_is_an_empty_picture() {
    let folder = Folder::new("models-no-face");
    folder.put("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    folder
        .put("clear.mtl", "newmtl glass\nd 0\nnewmtl other\nTr 1\nnewmtl half\nmap_Kd clear.png\n");
    image::RgbaImage::new(2, 2).save(folder.join("clear.png")).unwrap();
    let model = "mtllib clear.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl NAME\nf 1 2 3\n";
    for name in ["glass", "other", "half"] {
        folder.put(&format!("{name}.obj"), model.replace("NAME", name));
    }
    let glass = "the material 'glass' is fully transparent";
    let half = "the material 'half' is fully transparent";
    for (name, cause) in [("nan", "all its faces are left out"), ("glass", glass), ("half", half)] {
        let empty = "EMPTY: nothing of it is seen; the picture is background alone\n";
        folder
            .check(format!("render {name}.obj -o o.png --size 32x24"), 0)
            .prints(&format!("{empty}the cause is that {cause}\n"))
            .says(cause);
        // Without a piece there is nothing to verify.
        let status = if name == "nan" { 2 } else { 0 };
        folder.check(format!("verify {name}.obj --size 32x24"), status).says(cause);
        for command in ["plan --rounds 1", "study --quick", "cost --quick"] {
            folder.check(format!("{command} {name}.obj --size 32x24"), 0).says(cause);
        }
    }
    folder.check("inspect glass.obj#1", 0);
    for words in ["glass.obj --opacity 1", "other.obj"] {
        folder.check(format!("render {words} -o o.png --size 32x24"), 0).omits("EMPTY");
    }
}

/// Polygons in space that do not lie in a plane: all of their outline is the outline of their triangles.
#[test]
fn folded_polygons_keep_their_triangles() {
    let folder = Folder::new("models-folded");
    let square = "v -5 0 5\nv 5 0 5\nv 5 0 -5\nv -5 0 -5\n";
    // The area of what a polygon with these further corners becomes.
    let check = |more: &str| {
        let count = 4 + more.lines().count() as u32;
        let corners: String = (1..=count).map(|corner| format!(" {corner}")).collect();
        let model = read(&folder, &format!("{square}{more}f{corners}\n"), Shading::Flat);
        let mesh = &model.items[0].mesh;
        let triangles = mesh.triangles.positions();
        assert_eq!(triangles.len() as u32, count - 2, "{more}");
        for corner in 0..count {
            let edge = (corner, (corner + 1) % count);
            let has = |[a, b, c]: &&[u32; 3]| [(*a, *b), (*b, *c), (*c, *a)].contains(&edge);
            assert_eq!(triangles.iter().filter(has).count(), 1, "{more}: {edge:?} {triangles:?}");
        }
        let area = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        (triangles.iter().map(area).sum::<f64>(), model.warnings.join("\n"))
    };
    // Above or below the edge before it: seen along the normal it lies on that edge.
    let fan =
        "m.obj:6: the face is not planar, so it is drawn as triangles around its first corner";
    for more in ["v 0 5 -5\n", "v 0 -5 -5\n"] {
        let (area, said) = check(more);
        assert!((area - 100.0 - 25.0 * 2f64.sqrt()).abs() < 1e-9, "{more}: {area}");
        assert!(said.contains(fan), "{more}: {said}");
    }
    // Each corner at another place outside the plane of the square.
    let mut rng = Rng::new("folded polygons", 0, 0);
    for case in 0..2_000 {
        let mut more = String::new();
        for corner in 1..2 + case % 4 {
            let [x, z, sign] = [rng.int(-2, 2), rng.int(-2, 2), rng.int(0, 1)];
            more += &format!("v {} {} {}\n", 5 * x, (1 - 2 * sign) * corner, 5 * z);
        }
        check(&more);
    }
    // Seen along its normal nothing lies over anything else.
    let (area, said) = check("v -7 3 0\n");
    assert!(area > 100.0 && said.is_empty(), "{area}: {said}");
    // A corner on an edge in the plane loses nothing, whatever rounding did to the plane.
    let text = "v 0 0 0\nv 4 0 1.333333\nv 4 4 0\nv 2 0 .666667\nv 0 4 -1.333333\nf 1 2 3 4 5\n";
    let model = read(&folder, text, Shading::Flat);
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

/// The linear light of a channel in [0, 1] that is encoded as sRGB, and the reverse.
fn decoded(channel: f64) -> f64 {
    if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
}

fn encoded(light: f64) -> f64 {
    if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

/// Whether a byte is what a light comes to that may be this much off.
fn is_byte_of(byte: u8, light: f64, off: f64) -> bool {
    let [least, most] =
        [light - off, light + off].map(|light| encoded(light.clamp(0.0, 1.0)) * 255.0);
    (least - 0.501..=most + 0.501).contains(&f64::from(byte))
}

/// A picture of 5 x 3 texels on 56 x 42 pixels, and colours of corners in its place: each pixel has the mean of amounts of
/// light, whatever the shading is. The coordinates of a texel are rounded to 1/256, so each mean may be off by half of that.
#[test]
fn what_is_unlit_is_filtered_and_interpolated_in_linear_light() {
    let folder = Folder::new("models-unlit");
    let text = include_str!("../data/models/unlit.gltf");
    let document: serde_json::Value = serde_json::from_str(text).unwrap();
    let uri = document["images"][0]["uri"].as_str().unwrap();
    let png = STANDARD.decode(uri.rsplit(',').next().unwrap()).unwrap();
    let texels = image::load_from_memory(&png).unwrap().into_rgb8();
    let factor = [0.5, 0.3, 0.9];
    let picture = |words: &str| {
        folder.check(format!("render m.gltf --camera 1 --size 64x48 -o out.png {words}"), 0);
        image::open(folder.join("out.png")).unwrap().into_rgb8()
    };
    folder.put("m.gltf", text);
    for words in ["", "--shading flat", "--shading gouraud", "--effects all"] {
        let drawn = picture(words);
        for (x, y) in (3..45).flat_map(|y| (4..60).map(move |x| (x, y))) {
            // From the centre of the first texel; what lies beyond is on the other side of the picture.
            let u = (f64::from(x) + 0.5 - 4.0) / 56.0 * 5.0 - 0.5;
            let v = (f64::from(y) + 0.5 - 3.0) / 42.0 * 3.0 - 0.5;
            for channel in 0..3 {
                let texel = |du: i32, dv: i32| {
                    let x = (u.floor() as i32 + du).rem_euclid(5) as u32;
                    let y = (v.floor() as i32 + dv).rem_euclid(3) as u32;
                    decoded(f64::from(texels[(x, y)][channel]) / 255.0) * factor[channel]
                };
                let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
                let (right, down) = (u - u.floor(), v - v.floor());
                let mean = (a * (1.0 - right) + b * right) * (1.0 - down)
                    + (c * (1.0 - right) + d * right) * down;
                let steep = (b - a).abs().max((d - c).abs()) + (c - a).abs().max((d - b).abs());
                let byte = drawn[(x, y)][channel];
                assert!(is_byte_of(byte, mean, steep / 512.0), "{words} {x},{y}: {byte}, {mean}");
            }
        }
    }
    // White and black corners: between them, the light of a pixel grows by a 56th of all from column to column.
    let mut coloured = document.clone();
    let colours: Vec<u8> =
        [0.0f32, 1.0, 1.0, 0.0].iter().flat_map(|c| [*c; 3]).flat_map(f32::to_le_bytes).collect();
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&colours));
    let add = |list: &mut serde_json::Value, one| list.as_array_mut().unwrap().push(one);
    add(&mut coloured["buffers"], json!({ "byteLength": colours.len(), "uri": uri }));
    add(&mut coloured["bufferViews"], json!({ "buffer": 1, "byteLength": colours.len() }));
    let accessor = json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3" });
    add(&mut coloured["accessors"], accessor);
    coloured["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(3);
    let pbr = &mut coloured["materials"][0]["pbrMetallicRoughness"];
    pbr.as_object_mut().unwrap().remove("baseColorTexture");
    folder.put("m.gltf", coloured.to_string());
    for words in ["", "--shading gouraud"] {
        let drawn = picture(words);
        for (x, y) in (3..45).flat_map(|y| (4..60).map(move |x| (x, y))) {
            let light = (f64::from(x) + 0.5 - 4.0) / 56.0;
            for channel in 0..3 {
                let byte = drawn[(x, y)][channel];
                assert!(is_byte_of(byte, light * factor[channel], 0.0), "{words} {x},{y}: {byte}");
            }
        }
    }
}
