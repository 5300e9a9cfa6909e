//! What `study`, `verify FILE` and `inspect FILE#FACE` say of models: planted hard cases are found, with their face.

use serde_json::Value;

use crate::program::{Folder, PROGRAM};

/// A box, closed and wound alike, whose coordinates f32 holds.
const BOX: &str = "v -1.25 -0.75 -1\nv 1.25 -0.75 -1\nv 1.25 0.75 -1\nv -1.25 0.75 -1\n\
                   v -1.25 -0.75 1\nv 1.25 -0.75 1\nv 1.25 0.75 1\nv -1.25 0.75 1\n";
/// Its faces; the first one is the triangle 1 3 2 in the plane z = -1.
const FACES: &str = "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\n\
                     f 2 3 7\nf 2 7 6\nf 4 1 5\nf 4 5 8\n";

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

fn check(folder: &Folder, model: &str, expected: &[(&str, u64, u64)]) {
    let expected: Vec<_> =
        expected.iter().map(|&(kind, count, line)| (kind.to_owned(), count, line)).collect();
    assert_eq!(cases(folder, model), expected, "{model}");
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
        &[("open borders", 4, 11)],
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
    let found = cases(&folder, &model);
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
    let text = folder.check("study m.obj --yaw 10 --size 64x48 --quick", 0).out;
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

/// A face whose box is empty at its left upper corner: what is shown begins where it has pixels.
const CORNERLESS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
const FROM_THE_FRONT: &str = "--yaw 0 --pitch 0";

#[test]
fn a_face_is_shown_where_it_has_pixels() {
    let folder = Folder::new("study-window");
    folder.put("m.obj", CORNERLESS);
    for more in ["", " --exact", " --aa msaa4", " --size 2000x1500"] {
        let words = format!("inspect m.obj#1 {FROM_THE_FRONT}{more}");
        let run = folder.check(words, 0).prints("agrees").prints("cropped: the shape is");
        let grid = run.out.lines().filter(|line| line.contains("##")).count();
        assert!(grid > 20, "{run}");
    }
    // All of a small one, as before.
    let words = format!("inspect m.obj#1 {FROM_THE_FRONT} --size 60x45");
    folder.check(words, 0).prints("agrees").omits("cropped");
    // The same of corners that are typed, however far apart they are.
    for words in ["500,1 0,500 500,500", "8388000,-8388000 -8388000,8388000 8388000,8388000"] {
        let run = folder.check(format!("inspect {words}"), 0).prints("cropped: the shape is");
        assert!(run.out.lines().any(|line| line.contains('#')), "{run}");
    }
}

/// What compares nothing says so, and its status is not that of agreement.
#[test]
fn a_comparison_of_nothing_says_that_nothing_was_compared() {
    let folder = Folder::new("study-nothing");
    folder.put("m.obj", CORNERLESS);
    let front = format!("m.obj {FROM_THE_FRONT} --size 64x48");
    let face = front.replacen("m.obj", "m.obj#1", 1);
    let nothing = "nothing was compared";
    for words in [
        format!("inspect {face} --window 0,0,4x4"),
        format!("inspect {face} --cull cw"),
        format!("inspect {face} --cull ccw"),
        "inspect 0,0 300,0 0,300 --window 290,290,8x8".to_owned(),
        "inspect 0,0 300,0 0,300 --window 290,290,8x8 --exact".to_owned(),
        "inspect --line 0,0 300,300 --window 200,0,8x8".to_owned(),
    ] {
        let run = folder.run(&words);
        // Of the two windings one is culled.
        if words.contains("--cull") && run.status == Some(0) {
            continue;
        }
        run.has(2).prints("NOT COMPARED").prints(nothing).omits("oracle: agrees");
    }
    let culled = ["cw", "ccw"].map(|cull| format!("{front} --cull {cull}"));
    let culled = culled.into_iter().find(|words| {
        let run = folder.run(format!("verify {words}"));
        run.status == Some(2) && run.out.contains("NOT JUDGED") && !run.out.contains("AGREES")
    });
    let culled = culled.expect("one of the two is culled");
    let judged = folder.check(format!("verify {culled} --json"), 2).json();
    assert!(judged["agrees"].is_null() && judged["pieces"] == 0, "{judged}");
    assert!(judged["engines"].as_array().unwrap().is_empty(), "{judged}");
    let not_compared = |words: &str| {
        let run = folder.check(format!("{words} --out ."), 0);
        run.shows("NOT COMPARED").omits("AGREES");
    };
    not_compared(&format!("render {culled} --report"));
    assert!(folder.text("render.html").contains("NOT COMPARED"));
    folder.put("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    not_compared("render flat.obj --size 32x24 --spin 2 -o a.gif");
    let program = format!("-- {PROGRAM} engine scanline");
    let show = format!("course show --model flat.obj --size 32x24 --out . {program}");
    folder.check(show, 0).prints("NOT COMPARED");
    assert!(folder.text("course-model.html").contains("NOT COMPARED"));
    folder.check("study flat.obj --size 32x24 --quick", 0).prints("NOT COMPARED");
    not_compared(&format!("plan {culled} --rounds 1 --whole --report"));
    assert!(folder.text("plan.html").contains("NOT COMPARED"));
    let compared = folder.check(format!("render {culled} --json"), 0).json();
    assert!(compared["comparison"].is_null(), "{compared}");
    // A shape without area that is shown whole: that nobody draws a pixel is the answer.
    folder.check("inspect 0,0 4,4 8,8", 0).prints("agrees");
    // What is drawn where nothing should be is a difference.
    let planted = "inspect 0,0 300,0 0,300 --window 148,148,4x4 --plant inclusive-edges";
    folder.check(planted, 1);
}

/// A folder into which nothing would be written is refused, with the word that is missing.
#[test]
fn a_folder_without_a_page_is_refused() {
    let folder = Folder::new("study-idle-folder");
    folder.put("m.obj", format!("{BOX}{FACES}"));
    for words in ["study m.obj", "study m.obj --views 2", "plan m.obj"] {
        let run = folder.check(format!("{words} --out d"), 2);
        run.says("add --report, or leave --out away");
    }
    let run = folder.check("judge --cases 1 --out d -- true", 2);
    run.says("add --report, or leave --out away");
    for words in ["cost m.obj --out d", "verify m.obj --out d"] {
        folder.check(words, 2).says("--out");
    }
    assert!(!folder.join("d").exists());
    folder.check("plan m.obj --size 32x24 --without depth --out d", 0);
    assert!(folder.join("d").exists());
}

/// A floor and, a ten-millionth above it, another one: coarse depths show the wrong one, and values that ignore w are wrong.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn rungs_of_values_and_depth_that_are_wrong_on_hard_cases_are_named() {
    let folder = Folder::new("study-wrong-rungs");
    let floor = |y: &str| format!("v -10 {y} -10\nv 10 {y} -10\nv 10 {y} 10\nv -10 {y} 10\n");
    let uv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n";
    folder.put("m.obj", floor("0") + &floor("0.0000001") + uv + faces);
    for (words, unit) in [("", "px"), (" --aa ssaa2", "samples"), (" --aa msaa4", "samples")] {
        let text = folder.check(&*format!("study m.obj --size 64x48 --quick{words}"), 0).out;
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
        choice.as_object_mut().unwrap().remove("time_ns");
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
