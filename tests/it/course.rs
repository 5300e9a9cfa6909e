//! Starters, solutions and misconceptions of the course. Its steps and points are in `tests/transcripts/slow/course-steps.md` and
//! `course-grade.md` beside it.

use std::collections::BTreeMap;
use std::fs;

use rasterproof_judge::in_process::Inside;
use rasterproof_registry::engines::find_planted;
use rasterproof_render::scene::chapters::scene;
use rasterproof_teaching::course::STEPS;
use rasterproof_teaching::course::misconceptions;
use rasterproof_teaching::course::show;
use serde::Deserialize;

use crate::program::{Folder, PROGRAM, Run, Words, every, has};
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
    assert_eq!(out.lines().filter(|line| line.ends_with("  18")).count(), solved, "{out}");
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

/// A part of the solution in Python and what a wrong program has instead, with the step that fails. Either a misconception is named, or
/// something else is said.
#[derive(Deserialize)]
struct Misconceived {
    step: String,
    from: String,
    to: String,
    #[serde(default)]
    name: String,
    #[serde(default)]
    says: String,
}

/// Each misconception is named for a program that has it, before any hint, and with a question. The other programs
/// fail as well, and some of what they do is learned from their answers.
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
    let text = include_str!("../data/course/misconceived.toml");
    let table: BTreeMap<String, Vec<Misconceived>> = toml::from_str(text).unwrap();
    let programs = &table["wrong"];
    // By day every third, at night all of them.
    for Misconceived { step, from, to, name, says } in programs.iter().step_by(every(3)) {
        assert!(right.contains(from), "{step}: {from}");
        fs::write(&path, right.replace(from, to)).unwrap();
        let out = course(&folder, ["check", step, "--cases", "40"], 1).out;
        let out = out.replace("\n  ", " ");
        let is_named = |is: &misconceptions::Misconception| {
            let said = out.find(&format!("it looks as if {}", is.says));
            let asked = out.find(&format!("think about: {}", is.ask));
            said < asked && said.is_some() && asked < out.find("hint 1")
        };
        let is = misconceptions::all().find(|is| is.name == *name);
        let is_known = is.map_or(name.is_empty(), is_named);
        if !is_known || !out.contains(says) || name.is_empty() == says.is_empty() {
            wrong.push(format!("{name} at {step}, {to}:\n{out}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let all = misconceptions::all().map(|is| is.name);
    let unseen: Vec<_> =
        all.filter(|name| programs.iter().all(|program| program.name != *name)).collect();
    assert!(unseen.is_empty(), "{unseen:?}");
}
