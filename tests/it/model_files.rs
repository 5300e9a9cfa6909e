//! Files that are computed: mutated, cut off, or of many bytes. None ends the program with a panic or takes memory without limit, and
//! what is wrong is named with its file and line.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use image::GrayImage;
use rasterproof_core::random::Rng;
use rasterproof_models::{BadFile, LoadOptions, Model, Normals, Up, load_texture};
use rasterproof_render::scene::Shading;

use crate::model_cases::{BESIDE, FOLDER, models_in, places};
use crate::models::warning;
use crate::program::Folder;

/// The bytes of a file below `tests/data/models`.
fn bytes_of(name: &str) -> Vec<u8> {
    fs::read(Path::new(FOLDER).join(name)).unwrap()
}

/// The model of a file of these bytes.
fn load(folder: &Folder, name: &str, bytes: impl AsRef<[u8]>) -> Result<Model, BadFile> {
    let options = LoadOptions { up: Some(Up::Y), ..LoadOptions::default() };
    rasterproof_models::load(&folder.put(name, bytes), options)
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
    let folder = Folder::new("model-files-pieces");
    let (count, faces) = (300_000, 800_000);
    // With the first face as polygon much is read ahead when it is found.
    for polygon in [usize::MAX, 0, faces / 2, faces - 2] {
        let bytes = long_strip(count, faces as u32, polygon);
        let model = load(&folder, "strip.ply", &bytes).unwrap();
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
            let error =
                load(&folder, "cut.ply", &bytes[..bytes.len() - less]).unwrap_err().to_string();
            assert!(error.contains(": the file is cut off"), "{less}: {error}");
        }
        let more = load(&folder, "more.ply", [&bytes[..], b"12345"].concat()).unwrap();
        assert!(warning(&more).contains("5 bytes follow the last element"), "{:?}", more.warnings);
    }
}

/// An STL in records with any header: what follows its triangles is left out, and one that is cut off is refused.
#[test]
fn the_length_of_an_stl_is_that_of_its_triangles() {
    let folder = Folder::new("model-files-stl");
    for header in ["", "-solid", "-from-cad", "-solid-upper", "-colour-in-head"] {
        let binary = bytes_of(&format!("tetrahedron/stl-binary{header}.stl"));
        let expected = places(&load(&folder, "whole.stl", &binary).unwrap());
        for more in [1, 2, 49, 50, 5_000] {
            for (name, byte) in [("more.stl", b' '), ("more.bin", 0)] {
                let bytes = [&binary, &vec![byte; more][..]].concat();
                let model = load(&folder, name, bytes).unwrap();
                assert_eq!(places(&model), expected, "{name}");
                let said =
                    format!("{more} bytes follow the last of its 4 triangles; they are left out");
                assert!(warning(&model).contains(&said), "{:?}", model.warnings);
            }
        }
        for less in [1, 49, 51, 150, 200] {
            let bytes = &binary[..binary.len() - less];
            let error = load(&folder, "less.stl", bytes).unwrap_err().to_string();
            let there = (200 - less) / 50;
            let said =
                format!("is truncated: its header announces 4 triangles, and it has {there}:");
            assert!(error.contains(&said), "{less}: {error}");
        }
    }
    // Cut off anywhere in a facet.
    let text = String::from_utf8(bytes_of("tetrahedron/stl-text.obj")).unwrap();
    let facet = text.rfind("facet normal").unwrap();
    for end in facet + 12..text.find("endsolid").unwrap() - 1 {
        let error = load(&folder, "cut.stl", &text[..end]).unwrap_err().to_string();
        assert!(error.contains("it is truncated, with 3 whole triangles"), "{end}: {error}");
    }
}

/// A thousand lines that cannot be read are one too many; of numbers that are not finite there may be any number.
#[test]
fn many_bad_lines_end_the_file_or_a_face() {
    let folder = Folder::new("model-files-bad-lines");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let many = format!("{}{triangle}", "v x y z\n".repeat(2_000));
    let error = load(&folder, "many.obj", many).unwrap_err();
    assert_eq!(error.line, Some(1_025), "{error}");
    let many = format!("{triangle}{}f 1 2 -1\n", "v nan nan nan\n".repeat(5_000));
    let model = load(&folder, "nan.obj", many).unwrap();
    assert_eq!(
        (places(&model).len(), &*model.not_drawn),
        (3, "position that is not finite of 1 face")
    );
    let is_said = |said: &String| said.contains("nan.obj:5005: 1 of 2 faces is left out");
    assert!(model.warnings.iter().any(is_said), "{:?}", model.warnings);
}

/// Bytes of what meshoptimizer and Draco compressed, changed.
#[test]
fn compressed_triangles_that_are_broken_never_panic() {
    let folder = Folder::new("model-files-compressed");
    for (name, length, step) in [("torus-meshopt.glb", 1224, 7), ("gltf/draco.glb", 88, 1)] {
        let compressed = bytes_of(name);
        for at in (compressed.len() - length..compressed.len()).step_by(step) {
            for change in [0x55, 0x01, 0xff] {
                let mut broken = compressed.clone();
                broken[at] ^= change;
                let _ = load(&folder, "broken.glb", broken);
            }
        }
    }
}

/// The limit of a texture counts what it takes in memory, not the bytes of the file; a grey one takes a
/// byte a texel.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_texture_that_grows_when_decoded_is_refused() {
    let folder = Folder::new("model-files-texture");
    // The head of a BMP of three bytes a pixel; what it promises is refused before it is read.
    let words = |words: &[u32]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<_>>();
    let mut head = b"BM".to_vec();
    head.extend(words(&[54, 0, 54, 40, 16_384, 16_384, 24 << 16 | 1, 0, 0, 0, 0, 0, 0]));
    let path = folder.put("large.png", head);
    let error = load_texture(&path).unwrap_err();
    assert!(error.cause.contains("16384 x 16384 px"), "{error}");
    GrayImage::from_pixel(16_384, 16_384, image::Luma([51])).save(&path).unwrap();
    let colour = load_texture(&path).unwrap().at(glam::DVec2::splat(0.5));
    assert_eq!(colour.to_array(), [51.0 / 255.0; 3]);
}

/// What lines consist of, in one text.
const WORDS: &str = "v|vt|vn|f|l|p|o|g|s|usemtl|mtllib|newmtl|Kd|Ks|Ka|Ns|d|Tr|illum|map_Kd|map_Bump|\
    1/1|1//1|1/1/1|2/|3//|/|#|\\|\"|\n|\r|\t| |\u{0}|\u{1b}|\u{feff}|é|m.mtl|a|off|on|\\|curv|bump|-s|-o|-mm|\
    -clamp|f 1 2 3 4 5 6 7 8|f 8 6 4 2 1 3 5 7|m.mtl m.mtl|t.png|VEC4|MAT4|uint|double|char|BLEND|MASK|null|[]|{}";

/// Numbers that readers and engines stumble over.
const NUMBERS: &str = "0|-1|-3|1|2|3|5|255|9984|5123|5126|16777217|4294967295|1099511627776|9999999999|\
    99999999999999999999|nan|inf|1e39|-0|0.5|-0.0001|1e38|1e-300|1e300|-1e-320|5e-324|1e-40|1e20|-2.5|1e7";

pub fn below(rng: &mut Rng, limit: usize) -> usize {
    rng.int(0, limit as i64 - 1) as usize
}

pub fn pick<T: Copy>(rng: &mut Rng, all: &[T]) -> T {
    all[below(rng, all.len())]
}

/// The bytes around a place up to those that are ends.
fn around(bytes: &[u8], at: usize, is_end: fn(&u8) -> bool) -> Range<usize> {
    let start = bytes[..at].iter().rposition(is_end).map_or(0, |end| end + 1);
    let end = bytes[at..].iter().position(is_end).map_or(bytes.len(), |end| at + end);
    start..end
}

/// Changes a file in a few places: bytes, digits, words and lines of it.
pub fn mutate(bytes: &mut Vec<u8>, rng: &mut Rng) {
    let [words, numbers] = [WORDS, NUMBERS].map(|all| all.split('|').collect::<Vec<_>>());
    for _ in 0..=below(rng, 3) {
        if bytes.is_empty() {
            return;
        }
        let at = below(rng, bytes.len());
        match below(rng, 16) {
            0 => bytes[at] = below(rng, 256) as u8,
            1 => drop(bytes.remove(at)),
            2 => bytes.insert(at, pick(rng, b"0123456789e-./ \n,[]{}")),
            3 => bytes.truncate(at.max(bytes.len() / 2)),
            4 | 5 => {
                let digit = bytes[at..].iter().position(u8::is_ascii_digit).unwrap_or(0);
                bytes[at + digit] = pick(rng, b"0123456789");
            }
            // A word becomes another one, and a number mostly another number.
            6..=13 => {
                let word = around(bytes, at, |byte| b" \t\r\n,:[]{}\"/".contains(byte));
                let is_number = bytes[word.clone()].iter().all(|b| b"+-.0123456789eE".contains(b));
                let all = if is_number && !rng.chance(8) { &numbers } else { &words };
                bytes.splice(word, pick(rng, all).bytes());
            }
            // A line comes again, elsewhere or very often.
            _ => {
                let line = around(bytes, at, |byte| *byte == b'\n');
                let line = [&bytes[line], b"\n"].concat();
                let count = pick(rng, &[1, 1, 2, 30, 4000]).min(1 + 30_000 / line.len());
                let place = around(bytes, below(rng, bytes.len()), |byte| *byte == b'\n').start;
                bytes.splice(place..place, line.repeat(count));
            }
        }
    }
}

/// The most bytes of a changed file.
const MOST_BYTES: usize = 1 << 16;

/// A model with the materials, pictures and buffers of its folder.
pub fn with_beside(path: &Path) -> Vec<(String, Vec<u8>)> {
    let all = fs::read_dir(path.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
    let is_beside = |other: &PathBuf| {
        let ending = other.extension().unwrap_or_default();
        BESIDE.iter().any(|name| ending == *name) && ending != "snap"
    };
    let mut beside: Vec<_> = all.filter(is_beside).collect();
    beside.sort();
    let file = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, fs::read(path).unwrap())
    };
    [path.to_owned()].iter().chain(&beside).map(file).collect()
}

/// One of `tests/data/models`, changed, with the files beside it, which are changed sometimes.
pub fn changed_model(rng: &mut Rng) -> Vec<(String, Vec<u8>)> {
    static MODELS: LazyLock<Vec<PathBuf>> = LazyLock::new(|| models_in(Path::new(FOLDER)));
    let mut files = with_beside(&MODELS[below(rng, MODELS.len())]);
    for (place, (_, bytes)) in files.iter_mut().enumerate() {
        if place == 0 || rng.chance(4) {
            mutate(bytes, rng);
        }
        bytes.truncate(MOST_BYTES);
    }
    files
}

/// Whether a model is read; no corner of it is without a position.
pub fn is_read(model: &Result<Model, BadFile>) -> bool {
    for item in model.iter().flat_map(|model| &model.items) {
        let mut used = item.mesh.triangles.positions().as_flattened().iter();
        assert!(used.all(|&position| (position as usize) < item.mesh.positions.len()));
    }
    model.is_ok()
}

/// Reads changed models with the materials beside them, changed too; a panic fails the test, with the number of the case.
fn fuzz(cases: u64, name: &str) {
    let folder = Folder::new(&format!("model-files-{name}"));
    let (mut read, mut refused) = (0, 0);
    for case in 0..cases {
        let mut rng = Rng::new("model files", 1, case);
        let files = changed_model(&mut rng);
        for (name, bytes) in &files {
            folder.put(name, bytes);
        }
        let normals = pick(&mut rng, &[Normals::File, Normals::Flat, Normals::Smooth]);
        let up = pick(&mut rng, &[None, Some(Up::Z)]);
        let options =
            LoadOptions { shading: Shading::Phong, normals, up, ..LoadOptions::default() };
        let load = || rasterproof_models::load(&folder.join(&files[0].0), options);
        let is_read = std::panic::catch_unwind(|| is_read(&load()));
        let Ok(is_read) = is_read else {
            panic!("case {case} panics; its files are in {}", folder.display())
        };
        *if is_read { &mut read } else { &mut refused } += 1;
    }
    assert!(read > cases / 10 && refused > cases / 10, "{read} read, {refused} refused");
    println!("{cases} cases: {read} read, {refused} refused, no panic");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn mutated_models_never_panic() {
    fuzz(3_000, "fuzz");
}

#[test]
#[ignore = "takes minutes"]
fn half_a_million_mutated_models_never_panic() {
    fuzz(500_000, "fuzz-long");
}
