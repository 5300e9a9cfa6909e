//! What `study`, `verify FILE` and `inspect FILE#FACE` say of models: planted hard cases are found, with their face.

use base64::Engine as _;
use serde_json::{Value, json};

use crate::pages::root;
use crate::program::Folder;

/// A box, closed and wound alike, whose coordinates f32 holds.
const BOX: &str = "v -1.25 -0.75 -1\nv 1.25 -0.75 -1\nv 1.25 0.75 -1\nv -1.25 0.75 -1\n\
                   v -1.25 -0.75 1\nv 1.25 -0.75 1\nv 1.25 0.75 1\nv -1.25 0.75 1\n";
/// Its faces; the first one is the triangle 1 3 2 in the plane z = -1.
const FACES: &str = "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\n\
                     f 2 3 7\nf 2 7 6\nf 4 1 5\nf 4 5 8\n";

const ROUNDING: &str = "pixels decided by rounding";

/// The hard cases of a model, by kind: the count, and the line of the first face.
fn cases(folder: &Folder, model: &str) -> Vec<(String, u64, u64)> {
    folder.put("m.obj", model);
    let json = folder.check("verify m.obj --json", 0).json();
    let case = |case: &Value| {
        let kind = case["kind"].as_str().unwrap().to_owned();
        (kind, case["count"].as_u64().unwrap(), case["faces"][0]["line"].as_u64().unwrap())
    };
    json["hard_cases"]["cases"].as_array().unwrap().iter().map(case).collect()
}

/// All kinds but the pixels that rounding decides: any closed mesh may have a few where its front meets its back.
fn check(folder: &Folder, model: &str, expected: &[(&str, u64, u64)]) {
    let expected: Vec<_> =
        expected.iter().map(|&(kind, count, line)| (kind.to_owned(), count, line)).collect();
    let mut found = cases(folder, model);
    found.retain(|(kind, ..)| kind != ROUNDING);
    assert_eq!(found, expected, "{model}");
}

#[test]
fn planted_hard_cases_are_found_and_a_clean_mesh_has_none() {
    let folder = Folder::new("study-planted");
    let clean = format!("{BOX}{FACES}");
    check(&folder, &clean, &[]);
    // A vertex on the edge from 1 to 2, within the face alone.
    let split = |vertex: &str, faces: &str| {
        format!("{BOX}v {vertex}\n{}", FACES.replacen("f 1 3 2\n", faces, 1))
    };
    check(
        &folder,
        &split("0 -0.75 -1", "f 1 3 9\nf 9 3 2\n"),
        &[("T-junctions", 1, 15), ("open borders", 3, 10)],
    );
    check(&folder, &split("0 -0.74 -1", "f 1 3 9\nf 9 3 2\nf 1 9 2\n"), &[("slivers", 1, 12)]);
    check(
        &folder,
        &split("0 -0.75 -1", "f 1 3 9\nf 9 3 2\nf 1 9 2\n"),
        &[("triangles without area", 1, 12), ("T-junctions", 1, 16), ("open borders", 3, 10)],
    );
    check(&folder, &format!("{clean}f 3 2 1\n"), &[("duplicate faces", 1, 21)]);
    check(
        &folder,
        &format!("{clean}v 0.5 -0.5 -1\nv 1 0.25 -1\nv 1 -0.5 -1\nf 9 10 11\n"),
        &[("coplanar overlaps", 1, 24), ("open borders", 3, 24)],
    );
    check(
        &folder,
        &format!("{clean}v 0 3 0\nf 1 2 9\n"),
        &[("open borders", 2, 22), ("edges of more than two faces", 1, 9)],
    );
    check(
        &folder,
        &format!("{BOX}{}", FACES.replacen("f 1 3 2\nf 1 4 3\n", "", 1)),
        // The first of them that is seen.
        &[("open borders", 4, 13)],
    );
    let concave = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n";
    check(&folder, concave, &[("concave faces", 1, 6), ("open borders", 5, 6)]);
}

/// Far from the origin f32 has halves in y: one position off them is found, with the faces that have it as a corner; and so are all,
/// where none lies on them.
#[test]
fn positions_that_f32_loses_are_found() {
    let folder = Folder::new("study-far");
    let far = |first: &str, by: [f64; 3]| {
        let corner = |corner: &str| {
            let numbers = corner.split(' ').zip(by).map(|(n, by)| n.parse::<f64>().unwrap() + by);
            let numbers: Vec<_> = numbers.map(|n| format!("{n:?}")).collect();
            format!("v {}\n", numbers.join(" "))
        };
        let rest =
            ["2 -1 -1.5", "2 1 -1.5", "-2 1 -1.5", "-2 -1 1.5", "2 -1 1.5", "2 1 1.5", "-2 1 1.5"];
        let corners = std::iter::once(first).chain(rest).map(corner);
        format!("{}{FACES}", corners.collect::<String>())
    };
    let up = [0.0, 4_581_234.0, 0.0];
    check(&folder, &far("-2 -1 -1.5", up), &[]);
    let everywhere = far("-2 -1 -1.5", [431_234.123, 4_581_234.567, 120.0]);
    check(&folder, &everywhere, &[("positions lost by f32", 12, 11)]);
    // The corner of five faces, of which the first one is on line 9.
    let model = far("-2 -0.875 -1.5", up);
    let mut found = cases(&folder, &model);
    found.retain(|(kind, ..)| kind != ROUNDING);
    let faces = FACES.lines().filter(|face| face.split(' ').skip(1).any(|n| n == "1")).count();
    let [(kind, count, line)] = &found[..] else { panic!("{found:?}") };
    assert_eq!((kind.as_str(), *count), ("positions lost by f32", faces as u64));
    let named = model.lines().nth(*line as usize - 1);
    assert!(named.is_some_and(|face| face.split(' ').any(|n| n == "1")), "{found:?}");
}

/// The same square drawn twice, in two colours: which one is seen depends on the order.
#[test]
fn pixels_that_depend_on_the_order_are_found() {
    let folder = Folder::new("study-order");
    folder.put("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let model = format!(
        "mtllib m.mtl\n{square}usemtl red\nf 1 2 3\nf 1 3 4\nusemtl blue\nf 1 2 3\nf 1 3 4\n"
    );
    let found = cases(&folder, &model);
    let kinds: Vec<_> = found.iter().map(|(kind, ..)| kind.as_str()).collect();
    assert_eq!(kinds, ["duplicate faces", "open borders", "pixels by drawing order"]);
}

/// Each command that `study` prints shows the face, and each of the engines agrees about it.
#[test]
fn the_commands_of_a_study_work() {
    let folder = Folder::new("study-commands");
    folder.put("m.obj", format!("{BOX}{FACES}f 3 2 1\n"));
    let text = folder.check("study m.obj --yaw 10 --size 64x48 --once --all", 0).out;
    let command = text.lines().find_map(|line| line.trim().split_once(" inspect ")).unwrap().1;
    assert_eq!(command, "'m.obj#13' --size 64x48 --yaw 10");
    folder.check("inspect m.obj#13 --size 64x48 --yaw 10", 0).prints_all([
        "face 13 (line 21)",
        "(1.25, 0.75, -1.0)",
        "duplicate faces",
        "against oracle",
    ]);
    folder.check("inspect m.obj#13 --exact", 0);
    folder.check("inspect m.obj#14", 2).says("1 to 13");
    folder.check("verify m.obj", 0).prints("duplicate faces").prints("AGREES");
    let planted = folder.check("verify m.obj --plant drops-first-row", 1);
    planted.prints("DISAGREES").prints("inspect 'm.obj#");
    folder.check("verify --yaw 3", 2).says("--yaw is for models");
}

/// A face whose box is empty at its left upper corner.
const CORNERLESS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";

/// A floor and, a ten-millionth above it, another one: coarse depths show the wrong one, and values that ignore w are wrong.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn choices_of_values_and_depth_that_are_wrong_on_hard_cases_are_named() {
    let folder = Folder::new("study-wrong-choices");
    let floor = |y: &str| format!("v -10 {y} -10\nv 10 {y} -10\nv 10 {y} 10\nv -10 {y} 10\n");
    let uv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n";
    folder.put("m.obj", floor("0") + &floor("0.0000001") + uv + faces);
    for (words, unit) in [("", "px"), (" --aa ssaa2", "samples"), (" --aa msaa4", "samples")] {
        let text = folder.check(&*format!("study m.obj --size 64x48 --once --all{words}"), 0).out;
        let list = text.split("open borders").nth(1).unwrap();
        let list = list.split("none:").next().unwrap();
        let depth = list.lines().find(|line| line.contains(&format!("Depth ({unit}):")));
        assert!(depth.is_some_and(|line| line.contains("unorm24 ")), "{words}: {list}");
        let values = list.lines().find(|line| line.contains("Interpolation (px): affine "));
        assert!(values.is_some_and(|line| !line.contains("offset")), "{words}: {list}");
        assert!(list.contains(&format!("Coverage by scanline ({unit}): book ")), "{list}");
    }
}

/// The parts of the answers about costs that are not times, nor depend on them.
fn counted(groups: &Value) -> Vec<Value> {
    let groups = groups.as_array().unwrap().iter();
    let choices = groups.flat_map(|group| group["choices"].as_array().unwrap());
    let kept = |choice: &Value| {
        let mut choice = choice.clone();
        for of_time in ["time_ns", "times", "wall_ns"] {
            choice.as_object_mut().unwrap().remove(of_time);
        }
        choice
    };
    choices.map(kept).collect()
}

/// Each number of a study that is not a time is also what another command says, which answers one of its questions alone.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn other_commands_find_the_numbers_of_a_study() {
    let folder = Folder::new("study-again");
    // A shiny box, half of a glass pane before it, a coplanar overlap and a square that is listed twice.
    let materials = "newmtl shiny\nKd 1 0.5 0\nKs 1 1 1\nNs 20\nnewmtl glass\nKd 0 0 1\nd 0.5\n";
    folder.put("m.mtl", materials);
    let more = "v -2 -1 2\nv 1 -1 2\nv 1 1 2\nv -2 1 2\nv 0.5 -0.5 -1\nv 1 0.25 -1\nv 1 -0.5 -1\n";
    let faces = "f 13 14 15\nf 13 15 14\nusemtl glass\nf 9 10 11\nf 9 11 12\n";
    let model = format!("mtllib m.mtl\n{BOX}{more}usemtl shiny\n{FACES}{faces}");
    folder.put("m.obj", model);
    for view in ["--size 96x72 --yaw 190", "--size 64x48 --yaw 25 --pitch -20 --aa msaa4"] {
        let json = |command: &str| folder.check(format!("{command} m.obj {view} --json"), 0).json();
        let (study, verify, cost) = (json("study --quick"), json("verify"), json("cost --quick"));
        assert_eq!(study["hard_cases"], verify["hard_cases"]);
        if !view.contains("--aa") {
            // Engines are judged at each sample of a pixel.
            assert_eq!(study["pieces"], verify["pieces"]);
        }
        assert_eq!(counted(&study["costs"]), counted(&cost));
        let plan = json("plan --rounds 1");
        let savings = plan["measured"]["effects"].as_array().unwrap();
        let effects = study["effects"]["effects"].as_array().unwrap();
        assert!(effects.iter().any(|effect| effect["wrong_without"] != 0), "{effects:?}");
        for effect in effects {
            let same = savings.iter().find(|saving| saving["effect"] == effect["effect"]).unwrap();
            assert_eq!(effect["wrong_without"], same["wrong_without"], "{view}: {effect}");
        }
        // Each place where there is a hard case is shown by its command as one.
        for case in study["hard_cases"]["cases"].as_array().unwrap() {
            let Some(face) = case["faces"].get(0) else { continue };
            let words = face["command"].as_str().unwrap().split_once("rasterproof ").unwrap().1;
            let words: Vec<_> = words.split(' ').map(|word| word.trim_matches('\'')).collect();
            let shown = folder.check(&words[..], 0).out;
            assert!(shown.contains(case["kind"].as_str().unwrap()), "{words:?}: {shown}");
        }
    }
}

/// What `verify` says of a kind of hard case: how many there are, how many of them are seen, and in how many pixels.
fn numbers(folder: &Folder, words: &str, kind: &str) -> Option<[u64; 3]> {
    let json = folder.check(&*format!("verify {words} --json"), 0).json();
    let cases = json["hard_cases"]["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["kind"] == kind)?;
    Some(["count", "in_view", "pixels"].map(|field| case[field].as_u64().unwrap()))
}

/// Two panes back to back, each seen from one side alone or from both.
fn panes(is_double_sided: bool) -> String {
    let corners = [[-1.0f32, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let mut bytes: Vec<u8> = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let faces: [u16; 12] = [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2];
    bytes.extend(faces.iter().flat_map(|x| x.to_le_bytes()));
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let material = |name: &str, colour: [u8; 4]| {
        let colour = json!({ "baseColorFactor": colour });
        json!({ "name": name, "doubleSided": is_double_sided, "pbrMetallicRoughness": colour })
    };
    let part =
        |of: u8| json!({ "attributes": { "POSITION": 0 }, "indices": of, "material": of - 1 });
    let list =
        |of: u8| json!({ "bufferView": of, "componentType": 5123, "count": 6, "type": "SCALAR" });
    let view =
        |offset: u8, length: u8| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length });
    let positions = json!({ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
        "min": [-1, -1, 0], "max": [1, 1, 0] });
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [part(1), part(2)] }],
        "materials": [material("front", [1, 0, 0, 1]), material("back", [0, 0, 1, 1])],
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{data}") }],
        "bufferViews": [view(0, 48), view(48, 12), view(60, 12)],
        "accessors": [positions, list(1), list(2)],
    })
    .to_string()
}

/// Of two panes back to back one is always culled: they overlap in the mesh, and nothing of it is seen.
#[test]
fn what_is_culled_or_hidden_is_only_in_the_mesh() {
    let folder = Folder::new("study-in-view");
    for (is_double_sided, expected) in [(false, 0), (true, 4)] {
        folder.put("m.gltf", panes(is_double_sided));
        let found = numbers(&folder, "m.gltf --size 160x120", "coplanar overlaps").unwrap();
        assert_eq!(found[..2], [4, expected]);
        assert_eq!(found[2] > 1000, is_double_sided, "{found:?}");
        let rounding = numbers(&folder, "m.gltf --size 160x120", ROUNDING);
        assert_eq!(rounding.map_or(0, |[_, _, pixels]| pixels), found[2]);
        let page = "study m.gltf --size 160x120 --once --report --out . --force";
        folder.check(page, 0).prints(if is_double_sided {
            "coplanar overlaps"
        } else {
            "only in the mesh"
        });
        assert!(folder.text("study.html").contains("<p class=\"pictured\">"));
    }
    // A sliver in the front of a box, looked at from either side.
    folder.put(
        "m.obj",
        format!(
            "{BOX}v 0 -0.74 -1\n{}f 1 3 9\nf 9 3 2\nf 1 9 2\n",
            FACES.replacen("f 1 3 2\n", "", 1)
        ),
    );
    let seen =
        ["0", "180"].map(|yaw| numbers(&folder, &format!("m.obj --yaw {yaw}"), "slivers").unwrap());
    let mut in_view = seen.map(|[count, in_view, pixels]| {
        assert!(count == 1 && (in_view > 0) == (pixels > 0), "{seen:?}");
        in_view
    });
    in_view.sort_unstable();
    assert_eq!(in_view, [0, 1]);
}

/// Two panes of glass that cross, and a square that is drawn twice: each has a cause of its own.
#[test]
fn the_cause_of_what_the_order_decides_is_named() {
    let folder = Folder::new("study-causes");
    folder.put("m.mtl", "newmtl red\nKd 1 0 0\nd 0.5\nnewmtl blue\nKd 0 0 1\nd 0.5\nnewmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
    let glass = "v -1 -1 -0.2\nv 1 -1 0.2\nv 1 1 0.2\nv -1 1 -0.2\nv -1 -1 0.2\nv 1 -1 -0.2\nv 1 1 -0.2\nv -1 1 0.2\n";
    folder.put(
        "glass.obj",
        format!("mtllib m.mtl\n{glass}usemtl red\nf 1 2 3 4\nusemtl blue\nf 5 6 7 8\n"),
    );
    folder.put(
        "twice.obj",
        format!("mtllib m.mtl\n{glass}usemtl a\nf 1 2 3 4\nusemtl b\nf 1 2 3 4\n"),
    );
    // Apart by less than a step of 24 bits, and by more than doubles are off.
    let near = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 1e-8\nv 1 -1 1e-8\nv 1 1 1e-8\nv -1 1 1e-8\n";
    folder
        .put("near.obj", format!("mtllib m.mtl\n{near}usemtl a\nf 1 2 3 4\nusemtl b\nf 5 6 7 8\n"));
    // Sixty decals in one place, with more samples that blend than layers are kept for.
    let decals = "usemtl red\nf 1 2 3 4\nusemtl blue\nf 1 2 3 4\n".repeat(30);
    folder.put("decals.obj", format!("mtllib m.mtl\n{glass}{decals}"));
    for (model, cause, cure) in [
        ("glass.obj", "by blending", "--layers"),
        ("decals.obj --size 720x480", "by blending", "--layers"),
        ("twice.obj", "by equal depths", "in the model"),
        ("near.obj --depth unorm24", "equal in unorm24", "--depth f64"),
    ] {
        let size = if model.contains("--size") { "" } else { "--size 160x120" };
        let words = format!("verify {model} {size} --yaw 0 --pitch 0 --json");
        let json = folder.check(&*words, 0).json();
        let cases = json["hard_cases"]["cases"].as_array().unwrap();
        let order = cases.iter().find(|case| case["kind"] == "pixels by drawing order").unwrap();
        let note = order["note"].as_str().unwrap();
        assert!(
            note.contains(cause) && note.contains(cure) && !note.contains(';'),
            "{model}: {note}"
        );
    }
    // The cures are cures.
    for words in ["glass.obj --layers 4", "near.obj --depth f64"] {
        let words = format!("{words} --size 160x120 --yaw 0 --pitch 0");
        assert_eq!(numbers(&folder, &words, "pixels by drawing order"), None, "{words}");
    }
}

/// Two quads that share three corners are no duplicates, and the edge within them is none of theirs.
#[test]
fn faces_are_those_of_the_file() {
    let folder = Folder::new("study-faces");
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\n";
    let kinds = |faces: &str| {
        let found = cases(&folder, &format!("{square}{faces}"));
        let kinds = [
            "duplicate faces",
            "coplanar overlaps",
            "open borders",
            "edges of more than two faces",
        ];
        kinds.map(|kind| found.iter().find(|case| case.0 == kind).map_or(0, |case| case.1))
    };
    assert_eq!(kinds("f 1 2 3 4\nf 1 2 3 5\n"), [0, 1, 4, 0]);
    assert_eq!(kinds("f 1 2 3 4\nf 3 4 1 2\n"), [1, 0, 4, 0]);
    // Cut along the other diagonal it is the same face.
    assert_eq!(kinds("f 1 2 3 4\nf 2 3 4 1\n"), [1, 0, 4, 0]);
    assert_eq!(kinds("f 1 2 3 4\nf 1 2 5\nf 1 2 3\n")[3], 1);
}

/// `render` and `study` count the pixels that rounding decides by one definition.
#[test]
fn render_and_study_count_the_same_pixels() {
    let folder = Folder::new("study-rounding");
    let ties = root().join("tests/data/ties.obj");
    let lod = root().join("tests/data/models/lod-border.obj");
    for (model, view) in [
        (&ties, "--size 160x120 --yaw 0 --pitch 45"),
        (&ties, "--size 64x48 --aa msaa4"),
        (&lod, "--size 320x240 --pitch 5"),
        (&lod, "--size 160x120 --pitch 5 --aa ssaa2"),
    ] {
        let model = model.to_str().unwrap();
        let run = |command: &str| {
            let words = command.split(' ').chain([model]).chain(view.split(' '));
            folder.check(words.collect::<Vec<_>>(), 0).json()
        };
        let drawn = run("render --json")["by_rounding"].clone();
        let study = run("study --once --json");
        assert_eq!(drawn["pixels"], study["decided"]["by_rounding"], "{view}");
        assert!(drawn["pixels"].as_u64() > Some(0), "{view}");
        let cases = study["hard_cases"]["cases"].as_array().unwrap();
        let rounding = cases.iter().find(|case| case["kind"] == ROUNDING).unwrap();
        let first = &drawn["first"];
        assert_eq!(rounding["note"], format!("the first at {},{}", first[0], first[1]));
        assert_eq!(rounding["pixels"], drawn["pixels"]);
    }
}

/// The pages of `cost` and `study` begin with a sentence and the picture of it, and every table is folded below.
#[test]
fn pages_begin_with_the_answer_as_a_picture() {
    let folder = Folder::new("study-pictured");
    folder.put("m.obj", format!("{BOX}{FACES}"));
    for command in ["cost", "study"] {
        folder.check(&*format!("{command} m.obj --size 64x48 --once --report --out ."), 0);
        let page = folder.text(&format!("{command}.html"));
        let place = |what: &str| page.find(what).unwrap_or_else(|| panic!("{command}: {what}"));
        let places = [
            "<h1>",
            "<p class=\"pictured\">",
            "<figure class=\"plot\">",
            "<p class=\"quiet\">",
            "<details>",
        ];
        assert!(places.map(place).is_sorted(), "{command}: {:?}", places.map(place));
        let picture = &page[place("<img src=\"data:image/svg+xml;base64,")..];
        let svg = picture.split_once("base64,").unwrap().1.split_once('"').unwrap().0;
        let svg = base64::engine::general_purpose::STANDARD.decode(svg).unwrap();
        let svg = String::from_utf8(svg).unwrap();
        for choice in ["scanline book", "scanline 24.8 DDA", "edge robust"] {
            assert!(svg.contains(&format!(">{choice}</text>")), "{command}: {choice}");
        }
        let outside: Vec<&str> =
            page.split("<details>").map(|part| part.rsplit("</details>").next().unwrap()).collect();
        assert!(outside.iter().all(|part| !part.contains("<table class=\"counts\"")), "{command}");
        assert!(page.matches("<table class=\"counts\"").count() >= 6, "{command}");
    }
}

/// Two boxes that run into each other have no other hard case than the pixels beside the lines in which they do, and those
/// are one.
#[test]
fn pixels_that_rounding_decides_are_a_hard_case() {
    let folder = Folder::new("study-crossing");
    let moved = |corner: &str| {
        let numbers: Vec<f64> = corner.split(' ').skip(1).map(|n| n.parse().unwrap()).collect();
        format!("v {} {} {}\n", numbers[0] + 0.4, numbers[1] * 0.5, numbers[2] * 0.7 + 0.8)
    };
    let other: String = BOX.lines().map(moved).collect();
    let second = |face: &str| {
        let numbers = face.split(' ').skip(1).map(|n| (n.parse::<u32>().unwrap() + 8).to_string());
        format!("f {}\n", numbers.collect::<Vec<_>>().join(" "))
    };
    let faces: String = FACES.lines().map(second).collect();
    folder.put("m.obj", format!("{BOX}{other}{FACES}{faces}"));
    let kinds: Vec<_> =
        cases(&folder, &folder.text("m.obj")).into_iter().map(|(kind, ..)| kind).collect();
    assert_eq!(kinds, [ROUNDING]);
    folder
        .check("study m.obj --size 320x240 --once --report --out .", 0)
        .prints("decided by rounding alone, the first at");
    let page = folder.text("study.html");
    // Hard cases are no faults of a model: nothing is called bad.
    assert!(page.contains("decided by rounding alone") && !page.contains("class=\"verdict"));
}

/// The seam of two levels of detail is no rim: it is counted apart, and its pixels are those that faces in the gaps would
/// cover, as two pictures show.
#[test]
fn gaps_between_levels_of_detail_are_found_with_their_pixels() {
    let folder = Folder::new("study-gaps");
    let model = std::fs::read_to_string(root().join("tests/data/models/lod-border.obj")).unwrap();
    folder.put("m.mtl", "newmtl ground\nKd 0 0.6 0\nnewmtl gap\nKd 1 0 0\nKa 1 0 0\n");
    let model = format!("mtllib m.mtl\nusemtl ground\n{model}");
    folder.put("m.obj", &model);
    // Corners 21 to 25 of the coarse level, and between them every other one of 26 to 34 of the fine one.
    let closing: String =
        (0..4).map(|i| format!("f {} {} {}\n", 21 + i, 27 + 2 * i, 22 + i)).collect();
    folder.put("closed.obj", format!("{model}usemtl gap\n{closing}"));
    let mut all = 0;
    for (size, view) in [
        ("640x480", ""),
        ("320x240", " --pitch 60"),
        ("320x240", " --yaw 200 --pitch 20"),
        ("480x360", " --aa ssaa2"),
    ] {
        let view = format!(" --size {size}{view}");
        let [count, in_view, pixels] =
            numbers(&folder, &format!("m.obj{view}"), "gaps between borders").unwrap();
        let picture = |name: &str| {
            folder.check(
                &*format!("render {name}.obj{view} -o {name}.png --engine scanline --force"),
                0,
            );
            image::open(folder.join(format!("{name}.png"))).unwrap().to_rgb8()
        };
        let (open, closed) = (picture("m"), picture("closed"));
        let differ = open.pixels().zip(closed.pixels()).filter(|(a, b)| a != b).count() as u64;
        assert_eq!((count, pixels), (4, differ), "{view}");
        assert!((in_view > 0) == (pixels > 0), "{view}");
        all += pixels;
    }
    assert!(all > 50, "{all}");
    // The rim alone: 4 edges of the coarse level on three sides, and 8 of the fine one.
    let [rim, ..] = numbers(&folder, "m.obj", "open borders").unwrap();
    assert_eq!(rim, 3 * 4 + 3 * 8);
    assert_eq!(numbers(&folder, "closed.obj", "gaps between borders"), None);
}

/// Effects that change no pixel are paid for to be safe, and no effect is in two of the three lists.
#[test]
fn effects_are_called_for_where_they_change_a_pixel() {
    let folder = Folder::new("study-states");
    folder.put(
        "m.obj",
        std::fs::read_to_string(root().join("tests/data/models/lod-border.obj")).unwrap(),
    );
    let json = folder.check("study m.obj --size 320x240 --once --json", 0).json();
    let effects = json["effects"]["effects"].as_array().unwrap();
    for effect in effects {
        let changes = effect["wrong_without"].as_u64() > Some(0);
        assert_eq!(effect["called_for"].as_bool(), Some(changes), "{effect}");
    }
    let is_safe = |effect: &&Value| effect["paid_for"] == true && effect["called_for"] == false;
    let safe: Vec<_> =
        effects.iter().filter(is_safe).map(|e| e["effect"].as_str().unwrap()).collect();
    assert!(safe.contains(&"depth"), "{safe:?}");
    let text = folder.check("study m.obj --size 320x240 --once --all", 0).out;
    let (_, lists) = text.split_once("Effects called for").unwrap();
    let (called, rest) = lists.split_once("Effects paid for to be safe").unwrap();
    for name in safe {
        let is_line = |line: &str| line.trim().starts_with(&format!("{name} "));
        assert!(!called.lines().any(is_line) && rest.lines().any(is_line), "{name}: {text}");
    }
}

/// What is printed explains itself: units, what each choice does, and where there is no difference.
#[test]
fn the_words_of_a_study_are_explained() {
    let folder = Folder::new("study-words");
    folder.put("m.obj", CORNERLESS);
    for (aa, unit) in [("", "px"), (" --aa ssaa2", "samples")] {
        let text = folder.check(&*format!("study m.obj --once --all{aa} --size 64x48"), 0).out;
        for words in [
            &*format!("{unit} as given: wrong"),
            &*format!("{unit} snapped: wrong"),
            "as published, section 2.2",
            "by faces without a material",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(!text.contains("lucky") && !text.contains("no material"), "{text}");
        let json = folder.check(&*format!("study m.obj --once --json{aa} --size 64x48"), 0).json();
        let groups = json["costs"].as_array().unwrap().iter();
        let choices = groups.flat_map(|group| group["choices"].as_array().unwrap());
        for choice in choices.filter(|choice| choice["refused"].is_null()) {
            let about = choice["about"].as_str().unwrap();
            assert!(!about.is_empty() && text.contains(about), "{choice}");
        }
    }
}

/// Numbers of a text, without the commas between groups of digits.
fn numbers_in(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == ',' || c == '.'));
    words.filter_map(|word| word.trim_matches([',', '.']).replace(',', "").parse().ok()).collect()
}

/// A study begins with three sentences, fills at most one screen, and each number of the sentences is what the command below
/// it says. Ratios of times are those of the same run.
#[test]
fn a_study_answers_in_three_sentences_that_other_commands_confirm() {
    let folder = Folder::new("study-answers");
    let lod = std::fs::read_to_string(root().join("tests/data/models/lod-border.obj")).unwrap();
    folder.put("m.obj", lod);
    folder.put("m.gltf", panes(true));
    let small = ["m.obj --size 240x180", "m.obj --pitch 5 --size 240x180", "m.gltf --size 160x120"];
    for words in small {
        let json = |command: &str| folder.check(&*format!("{command} {words} --json"), 0).json();
        let (study, verify, cost) = (json("study --once"), json("verify"), json("cost --once"));
        let plan = json("plan --rounds 1");
        let answers = study["answers"].as_array().unwrap();
        let sentence = |i: usize| answers[i]["sentence"].as_str().unwrap();
        // What accuracy costs.
        let groups = cost.as_array().unwrap().iter();
        let coverage = groups.filter(|g| g["title"].as_str().unwrap().starts_with("Coverage by"));
        let choices: Vec<_> = coverage.flat_map(|g| g["choices"].as_array().unwrap()).collect();
        let least = |choice: &&Value| {
            let errors = choice["errors"].as_array().unwrap().iter();
            errors.map(|error| error.as_f64().unwrap()).fold(f64::MAX, f64::min)
        };
        let wrong: Vec<f64> = choices.iter().map(least).filter(|wrong| *wrong > 0.0).collect();
        let worst = wrong.iter().copied().fold(0.0, f64::max);
        let (before, _) = sentence(0).split_once(" choices ").unwrap();
        let last = sentence(0).rsplit(". ").next().unwrap();
        assert!(
            last.starts_with(before.rsplit(". ").next().unwrap()),
            "the last one counts: {last}"
        );
        let found = numbers_in(last);
        assert_eq!(found[..2], [wrong.len() as f64, choices.len() as f64], "{last}");
        assert_eq!(found.last(), Some(&worst), "{last}");
        // What is unstable.
        let cases = verify["hard_cases"]["cases"].as_array().unwrap();
        let is_seen = |case: &&Value| case["in_view"].as_u64() > Some(0);
        let is_rounding = |case: &&Value| case["kind"] == ROUNDING;
        let mut expected = Vec::new();
        if let Some(rounding) = cases.iter().find(is_rounding) {
            expected.push(rounding["count"].as_f64().unwrap());
            expected.extend(numbers_in(&rounding["note"].as_str().unwrap().replace(',', " ")));
            let faces = rounding["faces"].as_array().unwrap().iter();
            expected.extend(faces.map(|face| face["face"].as_f64().unwrap()));
        }
        let others = cases.iter().filter(is_seen).filter(|case| !is_rounding(case));
        let most = others.clone().filter_map(|case| case["pixels"].as_f64()).fold(0.0, f64::max);
        match others.count() {
            0 => {}
            1 => expected.push(most),
            kinds => expected.extend([kinds as f64, most]),
        }
        let hidden = cases.iter().filter(|case| case["in_view"] == 0).count();
        expected.extend((hidden > 0).then_some(hidden as f64));
        let stable = sentence(1).split(" Depth buffers that").next().unwrap();
        let groups = cost.as_array().unwrap().iter();
        let depths = groups.clone().find(|group| group["title"] == "Depth").unwrap();
        for choice in depths["choices"].as_array().unwrap() {
            let (name, wrong) = (choice["name"].as_str().unwrap(), choice["errors"][0].as_f64());
            let said = format!("{name} in {}", thousands(wrong.unwrap()));
            assert_eq!(sentence(1).contains(&said), wrong > Some(0.0), "{said}: {}", sentence(1));
        }
        assert_eq!(
            numbers_in(&stable.replace(',', " ").replace("t-", "")),
            {
                let text: Vec<_> = expected.iter().map(|n| thousands(*n)).collect();
                numbers_in(&text.join(" ").replace(',', " "))
            },
            "{}",
            sentence(1)
        );
        // What it calls for.
        let effects = plan["measured"]["effects"].as_array().unwrap();
        let wrong = |effect: &Value| effect["wrong_without"].as_f64().unwrap();
        let called = effects.iter().filter(|effect| wrong(effect) > 0.0).count();
        let found = numbers_in(sentence(2));
        assert_eq!(found[..2], [called as f64, effects.len() as f64], "{}", sentence(2));
        let named = effects.iter().find(|effect| {
            sentence(2).contains(&format!("Without {},", effect["effect"].as_str().unwrap()))
        });
        assert_eq!(found[2], wrong(named.unwrap()), "{}", sentence(2));
        let frames =
            study["costs"].as_array().unwrap().last().unwrap()["choices"].as_array().unwrap();
        let time = |name: &str| {
            frames.iter().find(|choice| choice["name"] == name).unwrap()["time_ns"][1]
                .as_f64()
                .unwrap()
        };
        let times = time("scanline all") / time("scanline planned");
        // Of one round no more is said than that the ratio is near this one.
        let is_near = |said: f64, expected: f64| {
            (said / expected - 1.0).abs() < 0.006 || (said - expected).abs() < 0.006
        };
        let said = sentence(2);
        assert!(is_near((found[4] * found[5]).sqrt(), times) && found[4] < found[5], "{said}");
        assert!(said.contains("cannot be told here"), "{said}");
        // One screen, and the commands work.
        let text = folder.check(&*format!("study --once {words}"), 0).out;
        let lines: Vec<_> = text.lines().collect();
        assert!((15..=40).contains(&lines.len()), "{text}");
        let is_too_long = |line: &&&str| line.chars().count() > 80 && !line.contains("$ ");
        assert_eq!(lines.iter().find(is_too_long), None);
        for (line, about) in lines[2..].iter().filter(|l| !l.starts_with(' ')).zip([
            "accuracy ",
            "hard cases ",
            "effects ",
        ]) {
            assert!(line.starts_with(about), "{text}");
        }
        for (answer, name) in answers.iter().zip(["cost", "verify", "plan"]) {
            let command = answer["command"].as_str().unwrap();
            assert!(command.starts_with(&format!("rasterproof {name} ")), "{command}");
            assert!(text.contains(&format!("$ {command}\n")), "{text}");
        }
    }
}

fn thousands(number: f64) -> String {
    rasterproof_report::words::thousands(number as u64)
}

/// A file of triangles in the plane z = 0, whose y points down in the window, and a camera with a pixel for each unit of a window of 9 x 5 px.
fn plane(triangles: &[[[f32; 2]; 3]], is_double_sided: bool) -> String {
    let corners: Vec<[f32; 3]> = triangles.iter().flatten().map(|[x, y]| [*x, -y, 0.0]).collect();
    let bytes: Vec<u8> = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let camera = json!({ "xmag": 4.5, "ymag": 2.5, "znear": 1, "zfar": 20 });
    let document = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [4.5, -2.5, 10] }],
        "cameras": [{ "type": "orthographic", "orthographic": camera }],
        "materials": [{ "doubleSided": is_double_sided }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": corners.len(), "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{data}") }],
    });
    document.to_string()
}

/// How many triangles hit each pixel of the window once their corners are snapped to 1/256 px, by edge functions in whole numbers
/// and the rule that left and top edges belong to a triangle.
fn hits(triangles: &[[[f32; 2]; 3]]) -> Vec<([i64; 2], u32)> {
    let all = (0..5).flat_map(|y| (0..9).map(move |x| [x, y]));
    let hit = |[x, y]: [i64; 2], triangle: &[[f32; 2]; 3]| {
        let mut corners =
            triangle.map(|of| of.map(|at| (f64::from(at) * 256.0).round_ties_even() as i64));
        let edge = |a: [i64; 2], b: [i64; 2], [x, y]: [i64; 2]| {
            (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
        };
        let area = edge(corners[0], corners[1], corners[2]);
        if area < 0 {
            corners.swap(1, 2);
        }
        area != 0
            && [(0, 1), (1, 2), (2, 0)].into_iter().all(|(a, b)| {
                let (a, b) = (corners[a], corners[b]);
                let is_top_left = b[1] < a[1] || b[1] == a[1] && b[0] > a[0];
                let side = edge(a, b, [256 * x + 128, 256 * y + 128]);
                side > 0 || side == 0 && is_top_left
            })
    };
    all.map(|px| (px, triangles.iter().filter(|of| hit(px, of)).count() as u32)).collect()
}

/// A point of a long edge as the corner of two other faces, and a narrow part of a plane, each computed apart in whole numbers: the pixel
/// that is lost or hit three times is named with what mends it. The same meshes without a corner on an edge, or without the narrow
/// part, have no such case.
#[test]
fn cracks_and_folds_by_snapping_are_found() {
    let folder = Folder::new("study-snapping");
    let [o, e, r, s] = [[0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [0.0, 5.0]];
    let q = [4.065_213, 2.258_452];
    let crack = [[o, r, s], [o, e, q], [e, r, q]];
    let whole = [[o, q, s], [q, r, s], [o, e, q], [e, r, q]];
    let [m, n] = [[2.664_98, 1.479_642_4], [2.608_712_2, 1.449_805_7]];
    let fold = [[o, e, m], [e, r, m], [o, m, n], [m, r, n], [o, n, s], [n, r, s]];
    let merged = [[o, e, m], [e, r, m], [o, m, s], [m, r, s]];
    // A wall in front of a plane, seen from its edge, that snapping moves onto a pixel centre: an outline, and no fold.
    let [u, v, w, x] = [[4.5019, 2.25], [4.502, 2.25], [4.502, 2.75], [4.5019, 2.75]];
    let wall = [[o, r, s], [o, e, r], [u, v, w], [u, w, x]];
    let on_wall = hits(&wall).into_iter().find(|(pixel, _)| *pixel == [4, 2]);
    assert_eq!(on_wall, Some(([4, 2], 2)));
    folder.put("m.gltf", plane(&wall, true));
    let view = "--camera 1 --size 9x5";
    for kind in ["cracks by snapping", "folds by snapping"] {
        assert_eq!(numbers(&folder, &format!("m.gltf {view}"), kind), None);
    }
    // Of the fold two triangles are turned over. Where backs are culled, none of them is drawn, and the others overlap still.
    let turned = "triangles turned by snapping";
    let backwards = fold.map(|[a, b, c]| [a, c, b]);
    for (triangles, is_double_sided, expected) in
        [(&fold, true, [2, 1, 0]), (&backwards, false, [2, 0, 0])]
    {
        folder.put("m.gltf", plane(triangles, is_double_sided));
        let [count, in_view, _] = numbers(&folder, &format!("m.gltf {view}"), turned).unwrap();
        assert_eq!([count, in_view, 0], expected);
        let found = numbers(&folder, &format!("m.gltf {view}"), "folds by snapping");
        assert_eq!(found, Some([1, 1, 1]));
    }
    for (name, triangles, kind, count) in [
        ("crack", &crack[..], "cracks by snapping", 0),
        ("whole", &whole[..], "", 1),
        ("fold", &fold[..], "folds by snapping", 3),
        ("merged", &merged[..], "", 1),
    ] {
        let wrong: Vec<_> = hits(triangles).into_iter().filter(|(_, hits)| *hits != 1).collect();
        let expected: &[([i64; 2], u32)] = if kind.is_empty() { &[] } else { &[([4, 2], count)] };
        assert_eq!(wrong, expected, "{name}");
        folder.put("m.gltf", plane(triangles, true));
        let json = folder.check(&*format!("verify m.gltf {view} --json"), 0).json();
        let cases = json["hard_cases"]["cases"].as_array().unwrap();
        let found: Vec<_> = cases
            .iter()
            .filter(|case| case["kind"].as_str().unwrap().ends_with("s by snapping"))
            .map(|case| (case["kind"].as_str().unwrap(), case["in_view"].as_u64().unwrap()))
            .collect();
        let expected: &[(&str, u64)] = if kind.is_empty() { &[] } else { &[(kind, 1)] };
        assert_eq!(found, expected, "{name}");
        if kind.is_empty() {
            continue;
        }
        let text = folder.check(&*format!("study m.gltf {view} --once"), 0).out;
        let line = format!("{kind}: the first at 4,2, of faces ");
        assert!(text.contains(&line), "{name}: {text}");
        let (_, after) = text.split_once(&line).unwrap();
        let command = after.lines().find_map(|line| line.trim().strip_prefix("rasterproof "));
        folder.check(command.unwrap().replace('\'', ""), 0).prints(kind);
    }
}
