//! Models and textures from files: what is well formed is drawn, what is broken is named with its
//! file, line and cause.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::{Rgb, RgbImage};
use rasterproof_models::{BadFile, Model, Options, load_texture};
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
        let corners = meshes.flat_map(|mesh| mesh.triangles.as_flattened());
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
    assert_eq!(model.items[0].mesh.triangles[0][1].uv.x, 1.0);
    assert_eq!(model.items[0].mesh.triangles[0][1].normal.z, -1.0, "z is turned");
    assert_eq!(model.items[0].mesh.triangles[1][1].uv.x, 0.0);
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
    check("two.obj", b"v 0 0 0\nv 1 0 0\nf 1 2\n", Some(3), "three corners");
    check("cut.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2/", Some(5), "three corners");
    check("faceless.obj", b"v 0 0 0\nv 1 0 0\n", None, "no faces");
    check("empty.obj", b"", None, "no faces");
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
    for p in &mesh.positions {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|corner| corner.position + 1);
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
