//! Models that are small as files and large in memory or time: each is drawn or refused with a message, by every command
//! that takes a model, within 2 GiB and 20 seconds of processor time.
//!
//! `RASTERPROOF_FUZZ=FROM,TO cargo test --test it fuzz_of_models -- --ignored --nocapture` runs the models of these
//! numbers, which are files of `tests/data/models` that are changed; a number gives the same model everywhere. Processes of this test run many
//! models each. What ends one of them, or takes too long in it, runs once more as a process of its own, and that decides.

use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::Range;
use std::path::Path;
use std::process::Command;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{DynamicImage, ImageFormat};
use serde_json::{Value, json};

use rasterproof::cli::{self, Delivery, Streams};
use rasterproof_core::angle::{cos, sin};
use rasterproof_core::random::Rng;

use crate::model_cases::models_in;
use crate::model_files::{changed_model, pick, with_beside};
use crate::pages::root;
use crate::program::{Folder, PROGRAM, Run, encoded, every};

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

/// A tetrahedron that Draco compressed, by its encoder.
const DRACO: &str = "RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/wAAAQAJAwAAAAAAAAAAAAAAAACAPwAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==";

/// The files of a model, which is the first, and the options of its commands.
fn model(number: u64) -> (Vec<(String, Vec<u8>)>, &'static str) {
    let rng = &mut Rng::new("hostile models", 2, number);
    (changed_model(rng), pick(rng, &OPTIONS))
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
        let (name, face) = (&files[0].0, format!("{}#1", files[0].0));
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
            let words = commands(&files[0].0, &face, options)[place].clone();
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
    let numbers = match std::env::var("RASTERPROOF_FUZZ") {
        Ok(numbers) => range(&numbers),
        Err(_) => 0..120,
    };
    fuzz(numbers, "hostile-models");
}

/// Models that went wrong once are in `tests/data/hostile`. Millions of triangles, a few of them clipped, took 2.3 GB.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn models_that_went_wrong_once_are_well() {
    let folder = Folder::new("hostile-models-found");
    for path in models_in(&root().join("tests/data/hostile")) {
        for (name, bytes) in with_beside(&path) {
            folder.put(&name, bytes);
        }
        let name = path.file_name().unwrap().to_str().unwrap();
        for words in commands(name, &format!("{name}#1"), "--mip-maps --anisotropy 8") {
            let run = bounded(&folder, &words);
            assert!(is_well(&run), "{run}");
        }
    }
}

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
    let mut number = 0;
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
            // Every fifth, from the first one on, meets each command and each kind of face.
            number += 1;
            if (number - 1) % every(5) != 0 {
                continue;
            }
            let run = bounded(&folder, &words);
            assert!(matches!(run.status, Some(0 | 2)), "{corners} x {copies}, {kind}: {run}");
        }
    }
}
