//! The course through the command line: every step passes for what is right and fails for a planted
//! fault, progress is kept, starters start, points are given.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use rasterproof_judge::in_process::Inside;
use rasterproof_registry::engines::find_planted;
use rasterproof_render::scene::chapters::scene;
use rasterproof_teaching::course::STEPS;
use rasterproof_teaching::course::misconceptions;
use rasterproof_teaching::course::progress::Progress;
use rasterproof_teaching::course::show;
use serde::Deserialize;
use serde_json::Value;

use crate::program::{Folder, PROGRAM, Run, Words};
use crate::snapshots::check_picture;

/// Runs a command of the course; its lines fit a terminal.
fn course(folder: &Folder, words: impl Words, status: u8) -> Run {
    let mut command = folder.command("course");
    words.add_to(&mut command);
    let run = Run::of(&mut command).has(status);
    // Results for machines have long lines, and the program's own path is as long as it is.
    let shown = if run.out.starts_with('{') { "" } else { &run.out };
    let shown = shown.replace(PROGRAM, "rasterproof");
    // A command is one line, so that it can be pasted.
    let is_text =
        |line: &&str| !line.contains("cannot be judged") && !line.contains("repeat with: ");
    let mut lines = shown.lines().filter(is_text);
    assert!(lines.all(|line| line.chars().count() <= 100), "{run}");
    run
}

/// Each step, what is right and what has a planted fault.
const JUDGED: [(&str, &str, &str); 12] = [
    ("pixel", "dda", "line-misses-end"),
    ("dda", "dda", "line-four-connected"),
    ("bresenham", "bresenham", "line-directed-ties"),
    ("edge-function", "edge-function", "rejects-thin"),
    ("top-left", "edge-function", "bottom-right-rule"),
    ("fans", "scanline", "exclusive-edges"),
    ("scanline", "scanline", "drops-first-row"),
    ("values", "scanline", "swapped-weights"),
    ("perspective", "edge-function", "affine-attributes"),
    ("depth", "scanline", "perspective-depth"),
    ("clipping", "edge-function", "wraps-in-i32"),
    ("samples", "scanline", "bottom-right-rule"),
];

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_judges_every_step() {
    let folder = Folder::new("course-steps");
    let mut progress = None;
    for ((name, right, planted), step) in JUDGED.iter().zip(STEPS.iter()) {
        assert_eq!(*name, step.name);
        let words = ["check", name, "--cases", "64", "--", PROGRAM, "engine"];
        let wrong = course(&folder, [&words[..], &[planted]].concat(), 1)
            .prints("NOT YET, wrong in ")
            .prints("smallest found: ")
            .prints("hint 1: ")
            .omits("hint 2: ")
            .prints("request: ")
            .prints(&step.page)
            .prints("yours")
            .prints("expected");
        let known = ["it looks as if ", "no known mistake explains its answers\n"];
        assert_eq!(known.iter().filter(|said| wrong.out.contains(**said)).count(), 1);
        let line = |begin: &str| wrong.out.lines().find_map(|line| line.trim().strip_prefix(begin));
        if let Some(again) = line("repeat with: ") {
            let again = Run::of(Command::new("sh").args(["-c", again])).has(0);
            let answer = line("answer:   ").unwrap();
            assert!(
                again.out.split_whitespace().eq(answer.split_whitespace()),
                "{}{answer}",
                again.out
            );
        }
        let Run { out, errors, .. } = course(&folder, [&words[..], &[right]].concat(), 0);
        assert!(out.contains(": PASSED, ") && errors.is_empty(), "{out}{errors}");
        progress = Progress::read(&folder).unwrap();
    }
    let progress = progress.unwrap();
    assert_eq!(progress.passed.len(), STEPS.len());
    assert_eq!(progress.run, [PROGRAM, "engine", "scanline"]);
    // What was passed is passed no longer when it fails.
    let words = ["check", "1", "--", PROGRAM, "engine", "line-misses-end"];
    course(&folder, words, 1);
    assert_eq!(Progress::read(&folder).unwrap().unwrap().passed.len(), STEPS.len() - 1);
}

/// Earlier steps forgive what later ones are about, and nothing else.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_steps_forgive_what_comes_later() {
    let folder = Folder::new("course-forgives");
    for (step, engine, status) in [
        ("dda", "line-directed-ties", 0),
        ("bresenham", "line-directed-ties", 1),
        ("scanline", "inclusive-edges", 0),
        ("scanline", "exclusive-edges", 0),
        ("edge-function", "inclusive-edges", 0),
        ("edge-function", "culls-one-winding", 1),
        ("top-left", "inclusive-edges", 1),
        ("fans", "bottom-right-rule", 0),
        ("values", "affine-attributes", 0),
        ("perspective", "perspective-depth", 0),
        ("depth", "affine-attributes", 0),
        // What a step is about that a program has not got is no pass.
        ("pixel", "scanline", 1),
        ("samples", "dda", 1),
    ] {
        course(&folder, ["check", step, "--", PROGRAM, "engine", engine], status);
    }
}

fn has(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// What a student is given says HELLO, draws nothing, and is not written over.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_starters_start() {
    for (language, tool, source) in [
        ("python", "python3", "starter.py"),
        ("rust", "rustc", "starter.rs"),
        ("cpp", "c++", "starter.cpp"),
    ] {
        if !has(tool) {
            continue;
        }
        let folder = Folder::new(&format!("course-{language}"));
        course(&folder, ["start", "--language", language, "mine"], 0);
        course(&folder, "check --dir mine", 1).prints("1 missing");
        // What was built for the first step is what all of them ask.
        let text = folder.text("mine/course.toml");
        let is_build = |line: &&str| line.starts_with("build = ");
        let build = text.lines().find(is_build).unwrap();
        folder.put("mine/course.toml", text.replace(build, "build = []"));
        for step in STEPS.iter() {
            // Nothing is refused: every verb is there, and empty.
            let words = format!("check {} --dir mine --cases 20", step.name);
            let out = course(&folder, words, 1).omits("refused").out;
            assert!(out.contains("missing") || out.contains("holes"), "{language}: {out}");
        }
        fs::write(folder.join("mine").join(source), "my work").unwrap();
        course(&folder, ["start", "--language", language, "mine"], 0)
            .prints("kept: mine/course.toml");
        assert_eq!(fs::read_to_string(folder.join("mine").join(source)).unwrap(), "my work");
    }
}

/// A program without the test of the window, and one that draws a pixel twice, fail step 1, and each is told why. The request names whole
/// pixels, as the page of the step does.
#[test]
fn course_sees_the_window_in_step_1() {
    if !has("python3") {
        return;
    }
    let folder = Folder::new("course-window");
    course(&folder, "start --language python", 0);
    let path = folder.join("starter.py");
    let empty = fs::read_to_string(&path).unwrap();
    let written = |body: &str| {
        let place = "nothing outside the window (steps 1 and 2a).\"\"\"\n";
        assert!(empty.contains(place));
        fs::write(&path, empty.replace(place, &format!("{place}    {body}\n"))).unwrap();
    };
    let test = "if 0 <= x0 < width and 0 <= y0 < height:";
    for (body, said) in [
        ("set_pixel(x0, y0)".to_owned(), "you draw pixels outside the window"),
        (format!("{test} set_pixel(x0, y0); set_pixel(x1, y1)"), "you draw a pixel twice"),
    ] {
        written(&body);
        let out = course(&folder, "check pixel --cases 50", 1).prints(said).out;
        let request = out.lines().find(|line| line.contains("request:")).unwrap();
        assert!(!request.contains('.'), "{request}");
    }
    written(&format!("{test} set_pixel(x0, y0)"));
    course(&folder, "check pixel --cases 50", 0);
}

/// The solution in Python passes every step, as `course_solutions_pass` shows, and parts of it that are changed do not.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_passes_a_students_code() {
    if !has("python3") {
        return;
    }
    let folder = Folder::new("course-student");
    course(&folder, "start --language python --solution", 0);
    let path = folder.join("starter.py");
    // What is drawn last, what is farthest, the middle instead of the pixel; another plane, a corner
    // lost, w forgotten.
    let right = fs::read_to_string(&path).unwrap();
    for (step, from, to, said) in [
        ("depth", "if z < nearest", "if True or z < nearest", "show what lies behind"),
        (
            "depth",
            "if z < nearest.get((x, y), (math.inf",
            "if z > nearest.get((x, y), (-1",
            "show what",
        ),
        ("depth", "l[i] * corners[i][2] for", "corners[i][2] for", "show what lies behind"),
        ("clipping", "a[2] + a[3], b[2] + b[3]", "a[2], b[2]", "corners missing"),
        ("clipping", "    return polygon", "    return polygon[:3]", "corners missing"),
        (
            "clipping",
            "    return polygon",
            "    return polygon[::-1]",
            "running the other way round",
        ),
        ("clipping", "zip(a, b)]", "zip(a[:3], b[:3])]", "x, y, z, w"),
    ] {
        assert!(right.contains(from), "{from}");
        fs::write(&path, right.replace(from, to)).unwrap();
        course(&folder, ["check", step, "--cases", "40"], 1).prints(said);
    }
}

/// A solution is the starter with its place filled. So starters of all languages hand over piles and corners, and write what comes back.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_solutions_pass() {
    let folder = Folder::new("course-solutions");
    let mut solved = 0;
    for (language, tool) in [("python", "python3"), ("rust", "rustc"), ("cpp", "c++")] {
        if has(tool) {
            let name = format!("all/{language}");
            course(&folder, ["start", "--solution", "--language", language, &name], 0);
            solved += 1;
        }
    }
    let out = course(&folder, "grade --folder all --cases 16", 0).out;
    assert_eq!(out.lines().filter(|line| line.ends_with("  12")).count(), solved, "{out}");
}

/// The rows of stage 2c in Python and C++ take the place of the signs of a solution, and pass its steps about triangles.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_rows_of_the_page_pass() {
    for (language, tool, ending, first, next) in [
        ("python", "python3", "py", "def triangle(", "def values("),
        ("cpp", "c++", "cpp", "static void triangle(", "static void values("),
    ] {
        if !has(tool) {
            continue;
        }
        let folder = Folder::new(&format!("course-rows-{language}"));
        course(&folder, ["start", "--solution", "--language", language], 0);
        let path = folder.join(format!("starter.{ending}"));
        let solved = fs::read_to_string(&path).unwrap();
        let rows = crate::pages::read(format!("docs/own/02c-scanline.{ending}"));
        let (from, to) = (solved.find(first).unwrap(), solved.find(next).unwrap());
        fs::write(&path, format!("{}{rows}\n\n{}", &solved[..from], &solved[to..])).unwrap();
        for step in ["edge-function", "top-left", "fans", "scanline", "clipping"] {
            course(&folder, ["check", step, "--cases", "16"], 0);
        }
        // One column further, and it fails.
        let wrong = rows.replace("128 *", "127 *");
        assert_ne!(wrong, rows);
        fs::write(&path, format!("{}{wrong}\n\n{}", &solved[..from], &solved[to..])).unwrap();
        course(&folder, ["check", "top-left", "--cases", "16"], 1);
    }
}

/// What the solution in Rust takes from the companion program is there, word for word.
#[test]
fn course_solution_is_the_companions() {
    let own = ["02b-triangles", "03-values", "05-perspective"]
        .map(|name| crate::pages::read(format!("docs/own/{name}.rs")).replace("pub fn", "fn"));
    let own = own.concat();
    let solution = include_str!("../../adapters/course/solution.rs");
    let taken = solution.split("// ----").nth(1).unwrap();
    let taken = taken.trim_start_matches(|c| c != '\n').trim();
    let items: Vec<_> = taken.split("\n\n").collect();
    assert_eq!(items.len(), 8, "{items:?}");
    for item in items {
        assert!(own.contains(item), "docs/own lacks\n{item}");
    }
}

/// What is drawn, by the program and by this project: alike where the program is right.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_shows_what_is_drawn() {
    let folder = Folder::new("course-shows");
    let show = |step: &str, engine: &str, status| {
        let words =
            ["show", step, "--out", "shown", "--size", "96x72", "--", PROGRAM, "engine", engine];
        course(&folder, words, status)
    };
    for step in ["fans", "perspective", "depth", "clipping", "samples", "cube"] {
        show(step, "scanline", 0).prints(": 0 of ").prints(&format!("course-{step}.png"));
        assert!(folder.join(format!("shown/course-{step}.html")).exists());
    }
    show("bresenham", "dda", 0).prints(": 0 of ");
    for (step, planted) in [
        ("pixel", "line-misses-end"),
        ("bresenham", "line-directed-ties"),
        ("top-left", "inclusive-edges"),
        ("fans", "exclusive-edges"),
        ("cube", "affine-attributes"),
        ("depth", "perspective-depth"),
    ] {
        show(step, planted, 1);
    }
    show("values", "dda", 1).prints("1 requests refused");
    show("thirteen", "scanline", 2).says("cube and all");
    let model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(folder.join("model.obj"), model).unwrap();
    let words =
        ["show", "--model", "model.obj", "--out", "shown", "--", PROGRAM, "engine", "scanline"];
    course(&folder, words, 0).prints("the model: ");
}

/// The picture of the page: the cube of a program that does not divide by w.
#[test]
fn course_cube_of_the_page() {
    let mut program = Inside::new(&find_planted("affine-attributes").unwrap());
    let scene = scene("cube", 4.0 / 3.0, 0.1).unwrap();
    let shown =
        show::scene(&mut program, "the cube, by the values of a program", &scene, (240, 180));
    let shown = shown.unwrap();
    assert!(shown.differing > 1000 && shown.unanswered == 0, "{}", shown.differing);
    check_picture("course-cube", &shown.sheet());
}

/// A part of the solution in Python and what a wrong program has instead, with the step that fails and what is named.
#[derive(Deserialize)]
struct Misconceived {
    step: String,
    from: String,
    to: String,
    name: String,
}

fn misconceived() -> Vec<Misconceived> {
    let text = include_str!("../data/course/misconceived.toml");
    let mut table: BTreeMap<String, Vec<Misconceived>> = toml::from_str(text).unwrap();
    table.remove("wrong").unwrap()
}

/// Each misconception is named for a program that has it, before any hint, and with a question.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_names_misconceptions() {
    if !has("python3") {
        return;
    }
    let folder = Folder::new("course-misconceptions");
    course(&folder, "start --language python --solution", 0);
    let path = folder.join("starter.py");
    let right = fs::read_to_string(&path).unwrap();
    let mut wrong = Vec::new();
    let programs = misconceived();
    for Misconceived { step, from, to, name } in &programs {
        assert!(right.contains(from), "{name}: {from}");
        fs::write(&path, right.replace(from, to)).unwrap();
        let out = course(&folder, ["check", step, "--cases", "24"], 1).out;
        let out = out.replace("\n  ", " ");
        let is = misconceptions::all().find(|is| is.name == *name).unwrap();
        let said = out.find(&format!("it looks as if {}", is.says));
        let asked = out.find(&format!("think about: {}", is.ask));
        if !(said < asked && said.is_some() && asked < out.find("hint 1")) {
            wrong.push(format!("{name} at {step}:\n{out}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let all = misconceptions::all().map(|is| is.name);
    let unseen: Vec<_> =
        all.filter(|name| programs.iter().all(|program| program.name != *name)).collect();
    assert!(unseen.is_empty(), "{unseen:?}");
}

/// What no list of mistakes has is learned from the answers, and said.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_says_what_was_learned() {
    if !has("python3") {
        return;
    }
    let folder = Folder::new("course-learned");
    course(&folder, "start --language python --solution", 0);
    let path = folder.join("starter.py");
    let right = fs::read_to_string(&path).unwrap();
    let fill = "        set_pixel(x, y)\n";
    assert_eq!(right.matches(fill).count(), 1);
    fs::write(&path, right.replace(fill, &format!("        (y % 2 and x0 > x1) or{}", &fill[7..])))
        .unwrap();
    let out = course(&folder, ["check", "top-left"], 1).out.replace("\n  ", " ");
    assert!(
        out.contains("it leaves out each pixel where its row is odd, only where dx of the first edge is negative"),
        "{out}"
    );
}

#[test]
fn course_page_lists_misconceptions() {
    let page = crate::pages::page("docs", "course");
    for is in misconceptions::all() {
        let row = format!("| `{}` | {} |", is.name, is.says);
        assert!(page.contains(&row), "docs/course.md lacks\n{row}");
    }
}
/// Points as Gradescope reads them, and a table of a folder; a submission that is broken, hangs or is
/// hungry gets no point and stops nobody.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_grades() {
    let folder = Folder::new("course-grades");
    let words =
        ["--grade", "--format", "gradescope", "--cases", "32", PROGRAM, "engine", "scanline"];
    let results: Value = serde_json::from_str(&course(&folder, words, 1).out).unwrap();
    let tests = results["tests"].as_array().unwrap();
    assert_eq!((tests.len(), &results["score"]), (12, &Value::from(9)));
    let scores: i64 = tests.iter().map(|test| test["score"].as_i64().unwrap()).sum();
    assert_eq!(scores, 9, "all but the three steps of lines");
    assert!(tests.iter().all(|test| (test["status"] == "passed") == (test["score"] == 1)));
    assert!(tests[0]["output"].as_str().unwrap().contains("refused (unsupported)"));

    let submit = |name: &str, run: &[&str]| {
        fs::create_dir_all(folder.join("all").join(name)).unwrap();
        let run = run.iter().map(|word| (*word).to_owned()).collect();
        let path = folder.join("all").join(name).join("course.toml");
        fs::write(path, Progress::new(Vec::new(), run).text()).unwrap();
    };
    submit("ada", &[PROGRAM, "engine", "bresenham"]);
    submit("bob", &[PROGRAM, "engine", "inclusive-edges"]);
    submit("eve", &["sh", "-c", "sleep 600"]);
    submit("gus", &["no-such-interpreter"]);
    fs::create_dir_all(folder.join("all/zoe")).unwrap();
    let words = ["grade", "--folder", "all", "--cases", "32", "--seconds", "30"];
    let grade = |more: &[&str]| course(&folder, [&words[..], more].concat(), 1).out;
    let json: Value = serde_json::from_str(&grade(&["--format", "json"])).unwrap();
    let of = |name: &str| {
        let all = json["submissions"].as_array().unwrap();
        all.iter().find(|s| s["name"] == name).unwrap().clone()
    };
    assert_eq!(of("ada")["points"], 3);
    // Two steps leave samples on an edge free.
    let bob = of("bob")["points"].as_i64().unwrap();
    assert!((2..9).contains(&bob), "{bob}");
    for (name, why) in
        [("eve", "never says HELLO"), ("gus", "not installed"), ("zoe", "it has no course.toml")]
    {
        assert_eq!(of(name)["points"], 0);
        assert!(of(name)["error"].as_str().unwrap().contains(why), "{:?}", of(name));
    }
    let template = format!("{PROGRAM} engine dda");
    let out = course(&folder, ["grade", "--folder", "all", "--run", &template], 1).out;
    assert_eq!(out.lines().filter(|line| line.ends_with("  3")).count(), 5, "{out}");
    assert!(out.contains("passed by "), "{out}");
}

/// Bounds of memory and time are real: without them these programs answer, with them they do not.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn course_bounds_what_it_grades() {
    let folder = Folder::new("course-bounds");
    if !has("python3") {
        return;
    }
    let hungry =
        "hold = bytearray(512 << 20)\nimport os, sys\nos.execvp(sys.argv[1], sys.argv[1:])\n";
    fs::write(folder.join("hungry.py"), hungry).unwrap();
    let command = ["--", "python3", "hungry.py", PROGRAM, "engine", "dda"];
    let words = ["grade", "--cases", "8", "--memory"];
    let out = course(&folder, [&words[..], &["0"], &command].concat(), 1).out;
    assert!(out.ends_with("3 of 12 points\n"), "{out}");
    course(&folder, [&words[..], &["256"], &command].concat(), 2).prints("cannot be judged: ");
    // One that never ends is ended with its time.
    let busy = ["grade", "--seconds", "1", "--", "python3", "-c", "while True: pass"];
    course(&folder, busy, 2);
}
