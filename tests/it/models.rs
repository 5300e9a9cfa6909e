//! Models and textures from files: what is well formed is drawn, what is broken is named with its
//! file, line and cause.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glam::DVec3;
use image::{Rgb, RgbImage};
use rasterproof_models::{BadFile, Model, Normals, Options, load_texture};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::scene::{Shading, shapes};

fn load(path: &Path, shading: Shading) -> Result<Model, BadFile> {
    rasterproof_models::load(path, Options { shading, ..Options::default() })
}

/// A folder of its own below `target/`.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("models-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn well_formed_models_are_read() {
    let folder = folder("good");
    let check = |name: &str, text: &str, triangles: usize| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
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
    let folder = folder("materials");
    let picture = RgbImage::from_pixel(2, 2, Rgb([255, 0, 0]));
    for name in ["a.png", "b.jpg", "c.bmp"] {
        picture.save(folder.join(name)).unwrap();
    }
    let mtl = "newmtl one\nKd 0.5 0.25 1\nnewmtl two\nmap_Kd a.png\nnewmtl three\nmap_Kd -s 1 1 1 b.jpg\nnewmtl four\nmap_Kd c.bmp\n";
    fs::write(folder.join("m.mtl"), mtl).unwrap();
    let mut text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n".to_owned();
    for name in ["one", "two", "three", "four"] {
        text += &format!("usemtl {name}\nf 1/1 2/2 3/3\n");
    }
    fs::write(folder.join("m.obj"), text).unwrap();
    let model = load(&folder.join("m.obj"), Shading::Unlit).unwrap();
    assert_eq!(model.warnings, Vec::<String>::new());
    assert_eq!(model.items.len(), 4);
    assert_eq!(model.items[0].material.colour.to_array(), [0.5, 0.25, 1.0]);
    for item in &model.items[1..] {
        let colour = item.material.texture.as_ref().unwrap().at(glam::DVec2::splat(0.5));
        assert!(colour.x > 0.9 && colour.y < 0.1, "{colour}");
    }
    fs::remove_file(folder.join("m.mtl")).unwrap();
    let model = load(&folder.join("m.obj"), Shading::Unlit).unwrap();
    assert!(model.warnings[0].contains("m.mtl"), "{:?}", model.warnings);
}

#[test]
fn broken_files_are_named_with_line_and_cause() {
    let folder = folder("broken");
    let check = |name: &str, text: &[u8], line: Option<usize>, cause: &str| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        let error = load(&path, Shading::Phong).err().unwrap_or_else(|| panic!("{name} is read"));
        assert_eq!(error.line, line, "{name}: {error}");
        assert!(error.cause.contains(cause), "{name}: {error}");
        assert!(error.to_string().contains(name), "{error}");
    };
    check("nan.obj", b"v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", Some(2), "not a finite number");
    check("huge.obj", b"v 0 0 0\nv 1 1e39 0\nv 0 1 0\nf 1 2 3\n", Some(2), "larger than 1e38");
    check("word.obj", b"v 0 0 zero\nf 1 1 1\n", Some(1), "not a number");
    check("short.obj", b"v 0 0 0\nv 1 0\nf 1 2 1\n", Some(2), "2 numbers where 3");
    check("range.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", Some(4), "position 4 is not there");
    check("uv.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/9 2/9 3/9\n", Some(4), "texture coordinate 9");
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
    let folder = folder("textures");
    let picture = folder.join("a.png");
    RgbImage::from_fn(64, 64, |x, y| Rgb([x as u8, y as u8, 7])).save(&picture).unwrap();
    let bytes = fs::read(&picture).unwrap();
    assert!(load_texture(&picture).is_ok());
    for length in [0, 1, 8, 20, bytes.len() / 2, bytes.len() - 20] {
        fs::write(&picture, &bytes[..length]).unwrap();
        let error = load_texture(&picture).expect_err("a truncated picture is read");
        assert!(error.to_string().contains("a.png"), "{error}");
    }
    let text = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(folder.join("m.obj"), text).unwrap();
    fs::write(folder.join("m.mtl"), "newmtl a\nmap_Kd a.png\n").unwrap();
    let model = load(&folder.join("m.obj"), Shading::Phong).unwrap();
    let [warning] = &model.warnings[..] else { panic!("{:?}", model.warnings) };
    assert!(warning.contains("a.png: is not a readable PNG"), "{warning}");
    assert!(model.items[0].material.texture.is_none());
}

fn program(arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_rasterproof")).args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned()
        + &String::from_utf8_lossy(&output.stderr);
    (output.status.code(), text)
}

#[test]
fn render_draws_models_by_both() {
    let folder = folder("render");
    let path = folder.join("ball.obj");
    let mut text = String::new();
    let mesh = shapes::sphere(glam::DVec3::ZERO, 1.0, 32, 16);
    for p in mesh.positions.iter() {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for t in mesh.triangles.positions() {
        let [a, b, c] = t.map(|position| position + 1);
        // The file is right-handed, so its faces run the other way.
        text += &format!("f {a} {c} {b}\n");
    }
    fs::write(&path, text).unwrap();
    let model = path.to_str().unwrap();
    let picture = folder.join("ball.png");
    let out = picture.to_str().unwrap();
    for options in [
        &["--aa", "none"][..],
        &["--aa", "msaa4", "--shading", "flat"],
        &["--aa", "ssaa2", "--cull", "cw", "--depth", "unorm24"],
        &["--wireframe", "--shading", "gouraud"],
        &["--zoom", "4", "--depth", "f32-reversed"],
        &["--effects", "all,-clip"],
    ] {
        let mut words = vec!["render", model, "--size", "96x72", "-o", out];
        words.extend(options);
        let (status, text) = program(&words);
        assert_eq!(status, Some(0), "{options:?}: {text}");
        assert!(text.contains("AGREES"), "{options:?}: {text}");
        assert!(text.contains("loaded in ") && text.contains("; drawn in "), "{text}");
        assert_eq!(image::open(&picture).unwrap().width(), 96);
    }
    let gif = folder.join("spin.gif");
    let words = ["render", "--scene", "spinning", "--size", "40x30", "--spin", "3", "-o"];
    let (status, text) = program(&[&words[..], &[gif.to_str().unwrap()]].concat());
    assert_eq!(status, Some(0), "{text}");
    assert!(fs::read(gif).unwrap().starts_with(b"GIF89a"));
}

#[test]
fn render_refuses_what_it_cannot_draw() {
    let folder = folder("refuses");
    let path = folder.join("t.obj");
    fs::write(&path, TETRAHEDRON).unwrap();
    let model = path.to_str().unwrap();
    let out = folder.join("t.png");
    let words = |options: &[&'static str]| {
        let mut words = vec!["render", model, "-o", out.to_str().unwrap()];
        words.extend(options);
        let (status, text) = program(&words);
        assert_eq!(status, Some(2), "{options:?}: {text}");
        assert!(!out.exists(), "{options:?}");
        text
    };
    assert!(words(&["--size", "100000x100000"]).contains("too large"));
    assert!(words(&["--size", "0x10"]).contains("no pixels"));
    assert!(words(&["--size", "10"]).contains("WIDTHxHEIGHT"));
    assert!(words(&["--size", "9000x9000", "--aa", "ssaa4"]).contains("too large"));
    assert!(words(&["--fov", "180"]).contains("180"));
    assert!(words(&["--zoom", "0"]).contains("--zoom"));
    assert!(words(&["--zoom", "nan"]).contains("--zoom"));
    assert!(words(&["--effects", "depht"]).contains("depth"));
    let (status, text) = program(&["render", "nowhere.obj"]);
    assert_eq!(status, Some(2));
    assert!(text.contains("nowhere.obj"), "{text}");
    let (status, text) = program(&["render", "cub"]);
    assert_eq!(status, Some(2));
    assert!(text.contains("cub is neither a file nor a scene") && text.contains("cube"), "{text}");
    let (status, text) = program(&["plan", "panels", "--size", "64x48", "--rounds", "1"]);
    assert_eq!(status, Some(0), "{text}");
    assert!(text.contains("no bounding box of another piece meets"), "{text}");
    let (status, text) = program(&["render", "--scene", "cub"]);
    assert_eq!(status, Some(2));
    assert!(text.contains("cube"), "{text}");
}

/// The page shows the frames and the plan; it is written below the folder the program runs in.
#[test]
fn render_and_plan_write_a_page() {
    let folder = folder("page");
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rasterproof"));
        let output = command.args(arguments).current_dir(&folder).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let page = format!("target/rasterproof/{}.html", arguments[0]);
        fs::read_to_string(folder.join(page)).unwrap()
    };
    let page = run(&["render", "--scene", "cube", "--size", "64x48", "--report"]);
    assert!(page.contains("AGREES") && page.contains("edge-function"));
    assert!(page.contains("rasterproof render --scene cube --size 64x48 --report"));
    let words = ["plan", "--scene", "panels", "--size", "64x48", "--rounds", "1", "--report"];
    let page = run(&words);
    assert!(page.contains("the material has no texture") && page.contains("second-buffer"));
}

/// A byte order mark is no part of a model, and a picture of nothing says so: of a triangle alone one
/// of the two windings is culled.
#[test]
fn a_picture_of_nothing_says_so() {
    let folder = folder("nothing");
    let path = folder.join("marked.obj");
    fs::write(&path, "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let out = folder.join("marked.png");
    let empty = |cull: &str| {
        let (path, out) = (path.to_str().unwrap(), out.to_str().unwrap());
        let words = ["render", path, "--size", "40x30", "--cull", cull, "-o", out];
        let (status, text) = program(&words);
        assert_eq!(status, Some(0), "{text}");
        text.contains("EMPTY: nothing of it is seen")
    };
    assert!(!empty("none"));
    assert_eq!([empty("cw"), empty("ccw")].iter().filter(|is_empty| **is_empty).count(), 1);
}

/// The picture that the program draws of a model, and what it says on standard error.
fn drawn(model: &Path, options: &[&str]) -> (RgbImage, String) {
    let out = model.with_extension("out.png");
    let mut words = vec!["render", "--size", "96x72", "--engine", "scanline", "-o"];
    words.extend([out.to_str().unwrap(), model.to_str().unwrap()]);
    words.extend(options);
    let output = Command::new(env!("CARGO_BIN_EXE_rasterproof")).args(&words).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{words:?}: {errors}");
    (image::open(out).unwrap().into_rgb8(), errors)
}

fn written(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

/// Coordinates are doubles from the file to the vertex stage: single precision would leave four steps across the
/// sphere in y.
#[test]
fn a_sphere_far_from_the_origin_is_drawn_as_at_the_origin() {
    let folder = folder("far");
    let mesh = shapes::sphere(glam::DVec3::ZERO, 1.0, 32, 16);
    // Multiples of 1/1024 are exact in both places, so that both files hold the same sphere.
    let rounded = |x: f64| (x * 1024.0).round() / 1024.0;
    let text = |centre: [f64; 3]| {
        let mut text = String::new();
        for p in mesh.positions.iter() {
            let [x, y, z] =
                [rounded(p.x) + centre[0], rounded(p.y) + centre[1], rounded(p.z) + centre[2]];
            text += &format!("v {x} {y} {z}\n");
        }
        for t in mesh.triangles.positions() {
            let [a, b, c] = t.map(|position| position + 1);
            text += &format!("f {a} {c} {b}\n");
        }
        text
    };
    let near = written(&folder, "near.obj", &text([0.0; 3]));
    let far = written(&folder, "far.obj", &text([431_234.123, 4_581_234.567, 120.0]));
    for options in [&[][..], &["--normals", "smooth", "--shading", "gouraud"]] {
        let [near, far] = [&near, &far].map(|path| drawn(path, options).0);
        let differ = near.pixels().zip(far.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(differ, 0, "{options:?}");
    }
}

/// The same shapes as polygons and as triangles by hand: one concave at its first corner, and a ring whose outline
/// runs along a bridge to its hole and back.
#[test]
fn concave_and_ring_shaped_polygons_are_drawn_right() {
    let folder = folder("concave");
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
        let polygon = written(&folder, "polygon.obj", &format!("{vectors}{polygon}"));
        let triangles = written(&folder, "triangles.obj", &format!("{vectors}{triangles}"));
        for pitch in ["0", "35"] {
            let options = ["--yaw", "0", "--pitch", pitch, "--aa", "ssaa2"];
            let ((polygon, errors), (triangles, _)) =
                (drawn(&polygon, &options), drawn(&triangles, &options));
            assert!(polygon == triangles, "{errors}");
            assert!(!errors.contains("warning"), "{errors}");
        }
    }
    let crossing = "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 3 0\nf 1 2 3 4\n";
    let model = load(&written(&folder, "crossing.obj", crossing), Shading::Flat).unwrap();
    let [warning] = &model.warnings[..] else { panic!("{:?}", model.warnings) };
    assert!(warning.contains("crossing.obj:5: the face crosses itself"), "{warning}");
}

/// Corners of different kinds, within a group and across groups, keep their own texture coordinates and normals.
#[test]
fn corners_of_mixed_kinds_keep_what_they_name() {
    let folder = folder("mixed");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\no one\nf 1//1 2//1 3//1\nvt .25 .5\nvn 1 0 0\no two\n\
        f 1/1/2 2/1/2 3/1/2\ng three\nf 1/1 2/1 3/1\nf -3 -2 -1\n";
    let model = load(&written(&folder, "m.obj", text), Shading::Phong).unwrap();
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
    let folder = folder("find");
    fs::create_dir(folder.join("Maps")).unwrap();
    let picture = RgbImage::from_fn(2, 1, |x, _| Rgb([255 - x as u8 * 255, 0, x as u8 * 255]));
    for name in ["Maps/Bare Name.tga", "b.TIFF", "c.webp", "it's \"d\".png"] {
        picture.save(folder.join(name)).unwrap();
    }
    fs::write(folder.join("broken.png"), b"no picture").unwrap();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .25 .5\nusemtl a\nf 1/1 2/1 3/1\n";
    let obj = written(&folder, "m.obj", &format!("mtllib m.mtl\n{triangle}"));
    let read = |line: &str| {
        fs::write(folder.join("m.mtl"), format!("newmtl a\nKd 0 1 0\n{line}\n")).unwrap();
        load(&obj, Shading::Unlit).unwrap()
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
        let [warning] = &model.warnings[..] else { panic!("{name}: {:?}", model.warnings) };
        assert!(
            warning.contains(".png: ") && warning.contains("material 'a' is drawn in its colour")
        );
        assert!(!warning.contains('\u{1b}'), "{warning:?}");
        let material = &model.items[0].material;
        assert_eq!(
            (material.texture.is_none(), material.colour.to_array()),
            (true, [0.0, 1.0, 0.0])
        );
    }
    // Options are applied, or named as not drawn.
    let moved = read("map_Kd -s 2 1 -o 0.25 0 -clamp on c.webp");
    let item = &moved.items[0];
    assert_eq!(item.mesh.triangles.at(0)[0].uv.to_array(), [0.75, 0.5]);
    let texture = item.material.texture.as_ref().unwrap();
    assert_eq!(texture.at(glam::DVec2::new(1.5, 0.5)).to_array(), [0.0, 0.0, 1.0]);
    let option = read("map_Kd -mm 0.5 2 -blendu off c.webp");
    assert_eq!(option.not_drawn, "option -blendu of 1 texture, option -mm of 1 texture");
}

#[test]
fn material_files_are_found_by_all_their_names() {
    let folder = folder("libraries");
    fs::write(folder.join("one.mtl"), "newmtl a\nKd 1 0 0\n").unwrap();
    fs::write(folder.join("two parts.mtl"), "newmtl\nKd 0 1 0\nnewmtl b c\nKd 0 0 1\n").unwrap();
    let faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b c\nf 1 \\\n2 3\nusemtl\nf 1 2 3\nusemtl d\nf 1 2 3\n";
    for line in [
        "mtllib one.mtl two parts.mtl",
        "mtllib two parts.mtl one.mtl",
        "mtllib ONE.MTL\nmtllib two parts.mtl",
        "mtllib .\\one.mtl\nmtllib \"two parts.mtl\"",
    ] {
        let model =
            load(&written(&folder, "m.obj", &format!("{line}\n{faces}")), Shading::Flat).unwrap();
        let colours: Vec<_> =
            model.items.iter().map(|item| item.material.colour.to_array()).collect();
        assert_eq!(
            colours,
            [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.8; 3]],
            "{line}"
        );
        let [warning] = &model.warnings[..] else { panic!("{line}: {:?}", model.warnings) };
        assert!(warning.contains("no material file describes 'd'"), "{warning}");
        let first = 7 + line.lines().count() as u32;
        assert_eq!(model.origins[1].lines, [first], "a face on two lines is at the first");
    }
    // The file beside the model has another name than the model says.
    fs::write(folder.join("n.mtl"), "newmtl a\nKd 1 0 0\n").unwrap();
    let text = "mtllib elsewhere.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let model = load(&written(&folder, "n.obj", text), Shading::Flat).unwrap();
    assert_eq!(model.items[0].material.colour.to_array(), [1.0, 0.0, 0.0]);
    assert!(model.warnings[0].contains("n.mtl is read in its place"), "{:?}", model.warnings);
}

/// Two squares at a right angle, with an edge between them: a corner of it has the mean of both normals where they
/// are smooth.
#[test]
fn missing_normals_are_flat_or_smooth_as_the_file_says() {
    let folder = folder("normals");
    let squares = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nS\nf 1 2 3 4\nusemtl x\nf 2 5 6 3\n";
    let first = |lines: &str, normals: Normals| {
        let path = written(&folder, "m.obj", &squares.replace("S\n", lines));
        let options = Options { shading: Shading::Phong, normals, up: None };
        let model = rasterproof_models::load(&path, options).unwrap();
        model.items[0].mesh.triangles.at(0)[1].normal
    };
    let (flat, half) = (glam::DVec3::NEG_Z, 0.5f64.sqrt());
    let smooth = glam::DVec3::new(half, 0.0, -half);
    for lines in ["", "s off\n", "s 0\n", "s\n"] {
        assert_eq!(first(lines, Normals::File), flat, "{lines:?}");
    }
    for lines in ["s 1\n", "s on\n", "s 7\n"] {
        assert!(first(lines, Normals::File).distance(smooth) < 1e-15, "{lines:?}");
    }
    assert!(first("", Normals::Smooth).distance(smooth) < 1e-15);
    assert_eq!(first("s 1\n", Normals::Flat), flat);
    // Another group begins between the squares.
    let path =
        written(&folder, "m.obj", &squares.replace("S\n", "s 1\n").replace("usemtl x", "s 2"));
    assert_eq!(load(&path, Shading::Phong).unwrap().items[0].mesh.triangles.at(0)[1].normal, flat);
    // A sheet that is listed from both sides: the normals cancel, and each side keeps its own.
    let sheet = written(&folder, "s.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\nf 3 2 1\n");
    let sheet = load(&sheet, Shading::Phong).unwrap();
    let normals: Vec<_> = sheet.items[0].mesh.triangles.iter().map(|t| t[0].normal.z).collect();
    assert_eq!(normals, [-1.0, 1.0]);
}

#[test]
fn colours_of_positions_are_drawn() {
    let folder = folder("colours");
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 1 0 0 1\nv 5 5 5\nf 1 2 3\n";
    let model = load(&written(&folder, "m.obj", text), Shading::Unlit).unwrap();
    let item = &model.items[0];
    assert!(item.material.vertex_colours && item.material.colour == glam::DVec3::ONE);
    let colours = item.mesh.triangles.at(0).map(|corner| corner.colour.to_array());
    assert_eq!(colours, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    // Bytes are recognised by the largest number of the file; a position without a colour is white.
    let bytes = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 255 51\nf 1 2 3\n";
    let model = load(&written(&folder, "bytes.obj", bytes), Shading::Unlit).unwrap();
    let colours = model.items[0].mesh.triangles.at(0).map(|corner| corner.colour.to_array());
    assert_eq!(colours, [[1.0 / 255.0, 0.0, 0.0], [1.0; 3], [0.0, 1.0, 0.2]]);
}

/// Holes come from the opacities of a texture, from a grey picture or another one's opacities, and `d 1` changes nothing;
/// below 1 a surface blends.
#[test]
fn surfaces_have_the_holes_of_their_files() {
    let folder = folder("holes");
    // One texel opaque, the other clear.
    let two = image::RgbaImage::from_raw(2, 1, vec![9, 9, 9, 255, 9, 9, 9, 0]).unwrap();
    two.save(folder.join("alpha.png")).unwrap();
    image::GrayImage::from_raw(2, 1, vec![127, 128])
        .unwrap()
        .save(folder.join("grey.png"))
        .unwrap();
    let mtl = "newmtl a\nmap_Kd alpha.png\nd 1\nnewmtl b\nmap_d grey.png\n\
        newmtl c\nmap_Kd grey.png\nmap_d -o 0.5 alpha.png\nnewmtl d\nmap_Kd grey.png\nTr 1\n\
        newmtl e\nd 0.2\nnewmtl f\nTr 0.2\nmap_d grey.png\n";
    fs::write(folder.join("m.mtl"), mtl).unwrap();
    let face = |name: &str| format!("usemtl {name}\nf 1/1 2/1 3/1\n");
    let faces: String = ["a", "b", "c", "d", "e", "f"].map(face).concat();
    let text = format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.5\n{faces}");
    let model = load(&written(&folder, "m.obj", &text), Shading::Phong).unwrap();
    let of = |item: usize, u: f64| {
        let opacity = model.items[item].material.opacity.as_ref();
        opacity.map(|opacity| opacity.of(glam::DVec2::new(u, 0.5)))
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
    let folder = folder("not-drawn");
    let mtl = "newmtl a\nKs 1 1 1\nNs 20\nd 0.5\nillum 3\nmap_Bump b.png\nnewmtl b\nKs .1 0 0\nKe 0 1 0\nmap_d c.png\n\
        newmtl unused\nKs 1 1 1\nnewmtl plain\nKd 1 0 0\nKs 0 0 0\nd 1\nTr 0\nillum 2\nKe 0 0 0\n";
    fs::write(folder.join("m.mtl"), mtl).unwrap();
    let triangle = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let loose = "v 100 100 100\nl 1 4\np 4\np 1\ncurv 0 1 1 2\n";
    let plain = written(&folder, "plain.obj", &format!("{triangle}usemtl plain\nf 1 2 3\n"));
    let with = written(&folder, "loose.obj", &format!("{triangle}{loose}usemtl plain\nf 1 2 3\n"));
    let ((plain, silent), (with, said)) = (drawn(&plain, &[]), drawn(&with, &[]));
    assert!(plain == with, "loose elements move the picture");
    assert!(!silent.contains("not drawn"), "{silent}");
    assert!(said.contains("not drawn: 1 curve, 1 line, 2 points\n"), "{said}");
    let text = format!("{triangle}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    let model = written(&folder, "m.obj", &text);
    let expected = "not drawn: 1 bump map, emission of 1 material, reflection (illum) of 1 material, \
        specular colour without shininess (Ns) of 1 material\n";
    let specular = |model: &Model| -> Vec<_> {
        model.items.iter().map(|item| item.material.specular).collect()
    };
    let shiny = Specular { colour: DVec3::ONE, shininess: 20.0 };
    let read = load(&model, Shading::Phong).unwrap();
    assert_eq!(specular(&read), [shiny, Specular::default()]);
    assert!(
        load(&model, Shading::Gouraud)
            .unwrap()
            .not_drawn
            .contains("specular colour, with Gouraud shading, of 1 material")
    );
    for command in ["render", "plan"] {
        let out = folder.join("o.png");
        let mut words = vec![command, model.to_str().unwrap(), "--size", "32x24"];
        words.extend(if command == "plan" {
            ["--rounds", "1"]
        } else {
            ["-o", out.to_str().unwrap()]
        });
        let (status, text) = program(&words);
        assert_eq!(status, Some(0), "{text}");
        assert!(text.contains(expected), "{command}: {text}");
    }
}

/// The file whose z points up looks as the one whose y does, and which axis was taken is printed.
#[test]
fn the_axis_that_points_up_is_chosen_and_said() {
    let folder = folder("up");
    let y = written(
        &folder,
        "y.obj",
        "v 0 0 0\nv 4 0 0\nv 4 0 -2\nv 1 7 -1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n",
    );
    let z = written(
        &folder,
        "z.obj",
        "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 1 1 7\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n",
    );
    let ((usual, said), (given, silent)) = (drawn(&y, &[]), drawn(&z, &["--up", "z"]));
    assert!(usual == given && usual != drawn(&z, &[]).0);
    assert!(said.contains("y points up, as is usual in OBJ; --up z for the other"), "{said}");
    assert!(!silent.contains("points up"), "{silent}");
    let (status, text) = program(&["render", "--scene", "cube", "--up", "z"]);
    assert!(status == Some(2) && text.contains("--up is for models"), "{text}");
}

/// Vectors and lines that no face depends on do not keep a model from being drawn.
#[test]
fn what_no_face_uses_is_a_warning() {
    let folder = folder("unused");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 x 2\nvt nan\nvn 1\nquad 1 2 3\nf 1 2 3\n";
    let model = load(&written(&folder, "m.obj", text), Shading::Flat).unwrap();
    for line in [4, 5, 6, 7] {
        let place = format!("m.obj:{line}: ");
        assert!(
            model.warnings.iter().any(|warning| warning.contains(&place)),
            "{:?}",
            model.warnings
        );
    }
    let many = format!("{}{text}", "v x y z\n".repeat(2_000));
    let error = load(&written(&folder, "many.obj", &many), Shading::Flat).unwrap_err();
    assert_eq!(error.line, Some(1_025), "{error}");
    let old = text.replace('\n', "\r");
    let model = load(&written(&folder, "old.obj", &old), Shading::Flat).unwrap();
    assert_eq!(model.origins[0].lines, [8], "lines that end with a carriage return alone");
    let wide: Vec<u8> =
        format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    let path = folder.join("wide.obj");
    fs::write(&path, wide).unwrap();
    let error = load(&path, Shading::Flat).unwrap_err();
    assert!(error.cause.contains("save it as UTF-8"), "{error}");
}

/// A second opinion: `tobj` reads the same triangles of a file of triangles, in doubles here and in single
/// precision there.
#[test]
fn another_reader_reads_the_same() {
    let folder = folder("second");
    let mesh = shapes::sphere(glam::DVec3::new(0.5, -2.0, 3.0), 1.5, 24, 12);
    let mut text = String::new();
    for p in mesh.positions.iter() {
        let n = *p - glam::DVec3::new(0.5, -2.0, 3.0);
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
    let model = load(&written(&folder, "m.obj", &text), Shading::Phong).unwrap();
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
                glam::DVec3::new(v[0].into(), v[1].into(), -f64::from(v[2]))
            };
            let position = item.mesh.positions[corner.position as usize];
            assert!(position.distance(three(&other.positions, other.indices[at])) < 1e-6);
            let normal = three(&other.normals, other.normal_indices[at]).normalize();
            assert!(corner.normal.distance(normal) < 1e-6);
            let uv = &other.texcoords[2 * other.texcoord_indices[at] as usize..][..2];
            assert!(corner.uv.distance(glam::DVec2::new(uv[0].into(), uv[1].into())) < 1e-6);
        }
    }
}
