//! Hostile model files: none ends the program with a panic or takes memory without limit, and what is
//! wrong is named with its file and line.

use image::GrayImage;
use rasterproof_core::random::Rng;
use rasterproof_models::{BadFile, LoadOptions, Model, Normals, Up, load_texture};
use rasterproof_render::scene::Shading;

use crate::models::{load, warning};
use crate::program::Folder;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn a_bad_line_of_a_material_file_is_a_warning_with_its_line() {
    let folder = Folder::new("model-files-lines");
    let text = format!("mtllib m.mtl\n{TRIANGLE}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    let obj = folder.put("m.obj", text);
    for bad in ["Kd 1 0", "Kd x 1 1", "Kd", "Kd nan 0 0", "Kd 1e99 0 0", "Kq 1 1 1", "{}"] {
        let text = format!("newmtl a\n{bad}\nNs x\nd\nillum -1\nnewmtl b\nKd 0 0.5 1\n");
        folder.put("m.mtl", text);
        let model = load(&obj, Shading::Phong).unwrap();
        assert!(warning(&model).contains("m.mtl:2: "), "{bad}: {:?}", model.warnings);
        let colours: Vec<_> =
            model.items.iter().map(|item| item.material.colour.to_array()).collect();
        assert_eq!(colours, [[0.8; 3], [0.0, 0.5, 1.0]], "{bad}");
    }
    folder.put("m.mtl", "Kd 1 1 1\nnewmtl \u{1b}[31m\nKd \u{1b}[31m 1 1\n");
    let warnings = load(&obj, Shading::Phong).unwrap().warnings.join("\n");
    assert!(warnings.contains("m.mtl:3") && !warnings.contains('\u{1b}'), "{warnings:?}");
}

#[test]
fn lines_are_read_as_the_format_says() {
    let folder = Folder::new("model-files-format");
    let read = |text: &str| load(&folder.put("m.obj", text), Shading::Phong);
    let error = read("v 0 0 zero\nf 1 1 1\n").err().unwrap();
    assert_eq!((error.line, &error.path), (Some(1), &folder.join("m.obj")), "{error}");
    let triangles = |text: &str| {
        let model = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        let count: usize = model.items.iter().map(|item| item.mesh.triangles.len()).sum();
        (count, model.not_drawn)
    };
    assert_eq!(triangles(&format!("{TRIANGLE}f 1 2 3 # c\n")).0, 1);
    // The weight of a position is that of curves.
    assert_eq!(triangles(&format!("{TRIANGLE}v 1 1 0 nan\nf 1 2 4\n")), (1, String::new()));
    let text = "f 1 2 3\nl 1 2 3\nl 1 2\np 1\nf 1 2\nf 1 2/";
    let (count, not_drawn) = triangles(&format!("{TRIANGLE}{text}"));
    assert_eq!((count, not_drawn.as_str()), (1, "2 incomplete faces, 2 lines, 1 point"));
    // Corners of one kind in one object, of another in the next.
    let mixed =
        format!("{TRIANGLE}vt 0 0\nvt 1\nvn 0 0 1\no a\nf 1//1 2//1 3//1\no b\nf 1/1 2/2 3/2\n");
    assert_eq!(triangles(&mixed).0, 2);
    assert_eq!(triangles(&format!("{TRIANGLE}o\ng\nusemtl\nusemtl\tx\nf 1 2 3\n")).0, 1);
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

/// Five hundred lines that name one file: its one warning comes once.
#[test]
fn a_material_file_is_read_once() {
    let folder = Folder::new("model-files-once");
    folder.put("m.mtl", "newmtl a\nKd 1 0\n");
    let text = format!("{}{TRIANGLE}f 1 2 3\n", "mtllib m.mtl\n".repeat(500));
    let obj = folder.put("m.obj", text);
    assert_eq!(load(&obj, Shading::Phong).unwrap().warnings.len(), 1);
}

/// What lines consist of, in one text.
const WORDS: &str = "v|vt|vn|f|l|p|o|g|s|usemtl|mtllib|newmtl|Kd|Ks|Ka|Ns|d|Tr|illum|map_Kd|map_Bump|1|0|-1|\
    -3|1/1|1//1|1/1/1|2/|3//|/|nan|inf|1e39|-0|0.5|9999999999|99999999999999999999|#|\\|\"|\
    \n|\r|\t| |\u{0}|\u{1b}|\u{feff}|é|m.mtl|a|off|on|\\|curv|bump|-s|-o|-mm|-clamp|-0.0001|\
    3|1e38|1e-300|f 1 2 3 4 5 6 7 8|f 8 6 4 2 1 3 5 7|m.mtl m.mtl|t.png";

pub fn below(rng: &mut Rng, limit: usize) -> usize {
    rng.int(0, limit as i64 - 1) as usize
}

fn mutated(text: &str, rng: &mut Rng) -> Vec<u8> {
    let known: Vec<&str> = WORDS.split('|').collect();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=below(rng, 4) {
        let at = below(rng, lines.len());
        let mut words: Vec<&str> = lines[at].split(' ').collect();
        let word = known[below(rng, known.len())];
        let place = below(rng, words.len());
        match below(rng, 5) {
            0 => words[place] = word,
            1 => words.insert(place, word),
            2 => drop(words.remove(place)),
            3 => words.push(word),
            _ => words.truncate(place),
        }
        let line = words.join(" ");
        lines[at] = line;
        if below(rng, 6) == 0 {
            let other = below(rng, lines.len());
            lines.swap(at, other);
        }
    }
    let mut bytes = lines.join("\n").into_bytes();
    if !bytes.is_empty() && below(rng, 4) == 0 {
        let at = below(rng, bytes.len());
        bytes[at] = below(rng, 256) as u8;
    }
    bytes
}

/// Whether a model is read; no corner of it is without a position.
pub fn is_read(model: &Result<Model, BadFile>) -> bool {
    for item in model.iter().flat_map(|model| &model.items) {
        let mut used = item.mesh.triangles.positions().as_flattened().iter();
        assert!(used.all(|&position| (position as usize) < item.mesh.positions.len()));
    }
    model.is_ok()
}

/// Reads mutated models with mutated materials; a panic fails the test, with the number of the case.
fn fuzz(cases: u64, name: &str) {
    let folder = Folder::new(&format!("model-files-{name}"));
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 0 0 1 .5 .5 .5\nvt 0 0\nvt 1 0\nvn 0 0 1\n\
        v 2 2 0\nv 2 -1 .5 1 0 0\nv -1 3 1 0.1 0 1 0\nv .3 .3 .3\ns 1\nf 1 5 2 8 7 6\n\
        o one\nusemtl a\nf 1/1/1 2/2/1 3/1/1\ng two\nusemtl b\nf 1//1 2//1 3//1 4//1\nf -1 -2 -3\ns off\nl 1 2\n";
    let mtl = "# materials\nnewmtl a\nKa 0 0 0\nKd 1 0.5 0\nKs 0 0 0\nNs 10\nd 1\nillum 2\n\
        newmtl b\nKd 0.5\nTr 0\nNi 1\nmap_Bump -bm 1 b.png\nmap_Kd -s 2 1 1 -clamp on t.png\n";
    GrayImage::from_pixel(2, 2, image::Luma([51])).save(folder.join("t.png")).unwrap();
    let (mut read, mut refused) = (0, 0);
    for case in 0..cases {
        let mut rng = Rng::new("model files", 0, case);
        folder.put("m.obj", mutated(obj, &mut rng));
        folder.put("m.mtl", mutated(mtl, &mut rng));
        let normals = [Normals::File, Normals::Flat, Normals::Smooth][below(&mut rng, 3)];
        let up = [None, Some(Up::Z)][below(&mut rng, 2)];
        let options =
            LoadOptions { shading: Shading::Phong, normals, up, ..LoadOptions::default() };
        let load = || rasterproof_models::load(&folder.join("m.obj"), options);
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
