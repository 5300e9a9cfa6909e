//! The tests that `judge --write-test` writes run in four languages, fail with the program that was judged and pass with one that is
//! mended. A language whose tool is missing is skipped.

use std::process::Command;

use crate::program::{Folder, PROGRAM, Run, has};

/// How tests of a language are written and run.
struct Language {
    ending: &'static str,
    bodies: &'static str,
    /// Yes and no.
    words: [&'static str; 2],
    /// Builds a file into `tests`, where it is built.
    build: &'static [&'static str],
    /// Runs the file, or what was built of it.
    run: &'static [&'static str],
}

/// The test framework's stand-in for pytest.
const EACH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/written-test/each.py");

/// In each body of `tests/data/written-test`, `MENDED` is whether the starter's mistake is repaired: of triangles that every edge belongs to
/// them, of lines that a tie goes to the larger coordinate.
const LANGUAGES: [Language; 5] = [
    Language {
        ending: "py",
        bodies: include_str!("../data/written-test/bodies.py.txt"),
        words: ["True", "False"],
        build: &[],
        run: &["python3", "-B", EACH, "FILE"],
    },
    Language { ending: "js", ..JAVASCRIPT },
    JAVASCRIPT,
    Language {
        ending: "rs",
        bodies: include_str!("../data/written-test/bodies.rs.txt"),
        words: ["true", "false"],
        build: &["rustc", "--edition", "2021", "--test", "FILE", "-o", "tests"],
        run: &["./tests"],
    },
    Language {
        ending: "c",
        bodies: include_str!("../data/written-test/bodies.c.txt"),
        words: ["1", "0"],
        build: &["cc", "-std=c99", "-Wall", "-pedantic", "-Werror", "FILE", "-o", "tests"],
        run: &["./tests"],
    },
];

const JAVASCRIPT: Language = Language {
    ending: "mjs",
    bodies: include_str!("../data/written-test/bodies.js.txt"),
    words: ["true", "false"],
    build: &[],
    run: &["node", "--test", "FILE"],
};

/// A text whose functions are filled in: what stands there is above the line of a body, and what belongs there below it.
fn filled(text: &str, bodies: &str, word: &str) -> String {
    let fill = |text: String, body: &str| {
        let (stub, body) = body.split_once("\n-----\n").unwrap();
        assert!(text.contains(stub), "{stub}: {text}");
        text.replace(stub, body.trim_end())
    };
    bodies.replace("MENDED", word).split("=====\n").fold(text.to_owned(), fill)
}

fn run(folder: &Folder, words: &[&str], file: &str) -> Run {
    let words: Vec<&str> =
        words.iter().map(|word| word.replace("FILE", file).leak() as &str).collect();
    let (name, arguments) = words.split_first().unwrap();
    let mut command =
        if name.starts_with("./") { Command::new(folder.join(name)) } else { Command::new(name) };
    Run::of(command.args(arguments).current_dir(folder).env_remove("NODE_TEST_CONTEXT"))
}

/// Builds and runs a text; the tests' result.
fn result(folder: &Folder, language: &Language, text: &str) -> Run {
    let file = format!("filled.{}", language.ending);
    folder.put(&file, text);
    if !language.build.is_empty() {
        run(folder, language.build, &file).has(0);
    }
    run(folder, language.run, &file)
}

/// The starter draws ties wrong, of triangles and of lines.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn written_tests_fail_with_the_wrong_program_and_pass_with_the_mended_one() {
    if !has("python3") {
        eprintln!("skipped: no python3");
        return;
    }
    let folder = Folder::new("written-test");
    folder.put("mine.py", include_str!("../../adapters/starter.py"));
    for language in &LANGUAGES {
        let Language { ending, bodies, words, build, run } = language;
        let tool = build.first().unwrap_or(&run[0]);
        if !has(tool) {
            eprintln!("skipped: no {tool}");
            continue;
        }
        let name = format!("mine_test.{ending}");
        let judge = "judge --cases 40 --family half-integer --family line-ties";
        let command = format!("{judge} --write-test {name} -- python3 -B mine.py");
        folder.check(&command, 1).says(&format!("2 tests in {}", name_of(ending)));
        let text = folder.text(&name);
        // A picture in a comment, and nothing of this project but its name.
        assert!(text.contains("drawn") && text.contains("(# agrees, - missing, + extra"), "{text}");
        // As it was written, it fails, and says what to do.
        let unfilled = result(&folder, language, &text);
        assert!(unfilled.status != Some(0), "{unfilled}");
        unfilled.shows("fill in triangle()");
        for (mended, word) in [(true, words[0]), (false, words[1])] {
            let filled = filled(&text, bodies, word);
            let run = result(&folder, language, &filled);
            assert_eq!(run.status == Some(0), mended, "{ending}: {run}");
            // Wrong in both.
            for test in ["half_integer_", "line_ties_"] {
                assert!(mended || run.out.contains(test), "{ending}: {run}");
            }
        }
        // It is the user's from now on.
        let again = folder.check(&command, 2).without_output();
        again.says("exists, and may be edited by hand: give another name, or remove it");
        assert_eq!(folder.text(&name), text);
    }
}

fn name_of(ending: &str) -> &str {
    match ending {
        "py" => "Python (pytest)",
        "rs" => "Rust",
        "c" => "C99",
        _ => "JavaScript (node:test)",
    }
}

/// The same of values, samples and depths; the corners that clipping leaves are named as what is no test.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_kind_of_pixel_is_tested() {
    if !has("python3") {
        eprintln!("skipped: no python3");
        return;
    }
    let folder = Folder::new("written-test-kinds");
    let judge =
        "judge --cases 40 --family half-integer --family fan --family depth-order --family w-4";
    let command =
        |name: &str| format!("{judge} --write-test {name} -- {PROGRAM} engine exclusive-edges");
    folder.check(command("a_test.py"), 1);
    let text = folder.text("a_test.py");
    for (owns, passes) in [("True", true), ("False", false)] {
        // Values, samples and piles of triangles, exactly; an edge has the samples on it, or not.
        let weights = include_str!("../data/written-test/weights.py.txt").replace("OWNS", owns);
        let bodies = include_str!("../data/written-test/exact.py.txt");
        let filled = weights + &filled(&text, bodies, "");
        let run = result(&folder, &LANGUAGES[0], &filled);
        assert_eq!(run.status == Some(0), passes, "{run}");
        if !passes {
            let count = text.matches("def test_").count();
            assert_eq!(run.out.lines().count(), count, "each test fails: {run}");
        }
    }
    // In the other languages the same cases compile.
    for language in &LANGUAGES[2..] {
        let tool = language.build.first().unwrap_or(&language.run[0]);
        if !has(tool) {
            eprintln!("skipped: no {tool}");
            continue;
        }
        let name = format!("a_test.{}", language.ending);
        folder.check(command(&name), 1);
        let run = result(&folder, language, &folder.text(&name));
        assert!(run.status != Some(0), "{run}");
        run.shows("fill in ");
    }
}

/// An engine that draws otherwise than is declared, and a function that draws as it does or as it should.
struct WrongDeclaration {
    engine: &'static str,
    family: &'static str,
    declares: &'static str,
    bodies: &'static str,
}

/// The same of lines with a width and of shares of pixels.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn wide_lines_and_shares_are_tested() {
    if !has("python3") {
        eprintln!("skipped: no python3");
        return;
    }
    let all = [
        WrongDeclaration {
            engine: "wide-rectangles",
            family: "wide-line",
            declares: "wide=parallelogram rule=none",
            bodies: include_str!("../data/written-test/wide.py.txt"),
        },
        WrongDeclaration {
            engine: "area",
            family: "area",
            declares: "levels=100",
            bodies: include_str!("../data/written-test/area.py.txt"),
        },
    ];
    for WrongDeclaration { engine, family, declares, bodies } in all {
        let folder = Folder::new(&format!("written-test-{family}"));
        let command = |name: &str| {
            let judge = ["judge", "--cases", "40", "--family", family, "--declare", declares];
            let rest = ["--write-test", name, "--", PROGRAM, "engine", engine];
            judge.into_iter().chain(rest).map(str::to_owned).collect::<Vec<_>>()
        };
        folder.check(command("a_test.py"), 1);
        let text = folder.text("a_test.py");
        assert!(text.contains("def test_"), "{text}");
        for (word, passes) in [("True", true), ("False", false)] {
            let run = result(&folder, &LANGUAGES[0], &filled(&text, bodies, word));
            assert_eq!(run.status == Some(0), passes, "{engine}: {run}");
        }
        // In the other languages the same cases compile.
        for language in &LANGUAGES[2..] {
            let tool = language.build.first().unwrap_or(&language.run[0]);
            if !has(tool) {
                eprintln!("skipped: no {tool}");
                continue;
            }
            let name = format!("a_test.{}", language.ending);
            folder.check(command(&name), 1);
            let run = result(&folder, language, &folder.text(&name));
            assert!(run.status != Some(0), "{run}");
            run.shows("fill in ");
        }
    }
}
