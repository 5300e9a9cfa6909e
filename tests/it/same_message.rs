//! Planted faults, judged from Rust, Python, JavaScript and C++: the same cases are wrong by the same pixels, and the same
//! words say so. The functions of Python and JavaScript are those of their own tests.

use std::process::Command;

use rasterproof_faults::planted::TriangleMutant;
use rasterproof_judge::ask::{Answer, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::in_process::Inside;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_registry::engines::find_planted;
use rasterproof_report::{judge_text, text};
use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::{Options, judge_coverage};
use rasterproof_verify::partition::{self, Polygon, judge_partitions_of};

use crate::pages::root;
use crate::program::{Folder, PROGRAM, Run};

/// A capability, the planted engine, the name of the call, and the function in Python and in JavaScript.
#[rustfmt::skip]
const FAULTS: [[&str; 5]; 4] = [
    ["coverage", "exclusive-edges", "Rasterizer", "lambda *r: strict(*r).astype(int)", "strict"],
    ["line", "line-misses-end", "Lines", "dda(1)", "line(1)"],
    ["attributes", "affine-attributes", "Values", "lambda *r: [part + 0 for part in values(*r, True)]", "values(true)"],
    ["partition", "", "Partition", "lambda contours: fan(contours)", "(contours) => fan(contours)"],
];
const DECLARED: &str = "window=1024x1024 range=4096";

const CPP: &str = include_str!("../data/same-message.cpp");

/// A planted engine that says of itself what the functions of the other languages do.
struct PlantedEngine(Inside, Declared);

impl Subject for PlantedEngine {
    fn declared(&self) -> &Declared {
        &self.1
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let mut answers = self.0.ask(questions, most_deaths);
        // As the others write them, in runs that are as long as they can be.
        for answer in &mut answers {
            if let Answer::Coverage(spans) = answer {
                spans.dedup_by(|next, span| {
                    let goes_on = next.y_px == span.y_px && next.x0_px == span.x1_px;
                    span.x1_px = if goes_on { next.x1_px } else { span.x1_px };
                    goes_on
                });
            }
        }
        answers
    }
}

fn in_rust(capability: &str, engine: &str) -> String {
    let hello = format!("HELLO 2 mine {capability} batch=1024 {DECLARED}");
    let planted = Inside::new(&find_planted(engine).unwrap());
    let mut askers: Vec<Box<dyn Subject>> =
        vec![Box::new(PlantedEngine(planted, Declared::parse(&hello).unwrap()))];
    let options = rasterproof_judge::Options::default().cases(20);
    let scope = Scope::of(&options);
    let verdict =
        rasterproof_judge::judge(&mut askers, &options, &|asked| recognise(asked, scope), &|_| ());
    text::text(
        &judge_text::report(&verdict, "-", &|_, _| "-".to_owned(), false),
        false,
        false,
        text::WIDTH,
    )
}

/// What is said of a fault in this language, or nothing where it is not installed.
fn said(language: &str, fault: [&str; 5], folder: &Folder) -> Option<String> {
    let run = |command: &mut Command| Run::of(command.current_dir(root())).has(0).out;
    let has = |program: &str, words: &[&str]| {
        Command::new(program).args(words).output().is_ok_and(|done| done.status.success())
    };
    let [capability, engine, call, python, javascript] = fault;
    let has_pixels = capability != "partition";
    let declare = if has_pixels { DECLARED } else { "" };
    match language {
        "Rust" if has_pixels => Some(in_rust(capability, engine)),
        "C++" if has_pixels && has("c++", &["--version"]) => {
            let program = folder.join("mine");
            if !program.exists() {
                let mut build = Command::new("c++");
                build
                    .args(["-std=c++11", "-O1", "-Iadapters", "-Iadapters/test/cmake", "-o"])
                    .arg(&program);
                run(build.arg(folder.put("mine.cpp", CPP)));
            }
            Some(
                folder
                    .check(format!("judge --cases 20 --timeout 60 -- ./mine {capability}"), 1)
                    .out,
            )
        }
        "Python" if has("python3", &["-c", "import numpy"]) => {
            let text = format!(
                "import rasterproof\nfrom test_rasterproof import *\nmine = {python}\nmine.__name__ = 'mine'\ntry:\n    \
                 rasterproof.assert_{}(mine, cases=20, declare='{declare}')\nexcept AssertionError as error:\n    print(error)",
                call.to_lowercase()
            );
            let mut python = Command::new("python3");
            python
                .args(["-B", "-c", &text])
                .env("PYTHONPATH", "adapters/python:adapters/python/tests");
            Some(run(python.env("RASTERPROOF", PROGRAM)))
        }
        "JavaScript"
            if root().join("target/js/package/rasterproof.wasm").exists()
                && has("node", &["--version"]) =>
        {
            let text = format!(
                "const {{ assert{call} }} = await import('./target/js/package/index.js');\n\
                 const {{ fan, line, strict, values }} = await import('./adapters/js/tests/functions.js');\n\
                 const mine = Object.defineProperty({javascript}, 'name', {{ value: 'mine' }});\n\
                 try {{ assert{call}(mine, {{ cases: 20, declare: '{declare}' }}); }} catch (error) {{ console.log(error.message); }}"
            );
            Some(run(Command::new("node").args(["--input-type=module", "-e", &text])))
        }
        _ => {
            eprintln!("skipped: {capability} in {language}");
            None
        }
    }
}

/// The words, without the calls that repeat a case: each language has its own. The program breaks long lines, and the packages
/// put the cause above the report, for the line that a test runner shows.
fn words(said: &str) -> Vec<String> {
    let report = said.find("✗ rasterproof ").map_or(said, |at| &said[at..]);
    let is_call = |line: &&str| {
        !["repeat with: ", "found in: "].iter().any(|call| line.trim().starts_with(call))
    };
    let declares = ["declare=", "declare: ", "--declare "];
    let same =
        |line: &str| declares.iter().fold(line.to_owned(), |line, d| line.replace(d, "declare "));
    let lines: Vec<_> = report.lines().filter(is_call).map(same).collect();
    lines.join(" ").split_whitespace().map(str::to_owned).collect()
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn the_same_fault_has_the_same_message_in_every_language() {
    let folder = Folder::new("same-message");
    for fault in FAULTS {
        let all: Vec<_> = ["Rust", "C++", "Python", "JavaScript"]
            .into_iter()
            .filter_map(|language| said(language, fault, &folder))
            .collect();
        for other in &all {
            assert!(other.contains("mine is not right"), "{other}");
            assert_eq!(words(other), words(&all[0]), "{}", fault[0]);
        }
        match fault[0] {
            "coverage" => all.iter().for_each(|said| has_the_counts_of_the_macro(said)),
            "partition" => all.iter().for_each(|said| has_the_words_of_the_macro(said)),
            _ => {}
        }
    }
}

/// What `assert_rasterizer!` judges: families within the declared range have the same cases, and it names the same cause.
fn has_the_counts_of_the_macro(said: &str) {
    let families =
        [FamilyName::HalfInteger, FamilyName::Rectangle, FamilyName::Fan, FamilyName::Flat];
    let options = families.into_iter().fold(Options::default().cases(20), Options::family);
    let verdict = judge_coverage(&TriangleMutant::ExclusiveEdges, &options).unwrap();
    let message = verdict.check().unwrap_err().to_string();
    let cause = "draws nothing on an edge: neighbours leave holes.";
    assert!(words(&message).join(" ").contains(cause), "{message}");
    assert!(words(said).join(" ").contains(cause), "{said}");
    let row = |name: &str| {
        let rows = said.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        rows.into_iter().find(|row| row.len() == 10 && row[0] == name).unwrap()[4].to_owned()
    };
    for family in &verdict.families {
        let wrong = family.pairs[0].tally.missing;
        assert!(wrong > 0 && row(&family.family) == wrong.to_string(), "{wrong}\n{said}");
    }
}

/// What `assert_partition!` says, with polygons as Rust writes them.
fn has_the_words_of_the_macro(said: &str) {
    let fan = |polygon: &Polygon| match &polygon.contours[..] {
        [c] => Some(Ok((2..c.len()).map(|i| [c[0], c[i - 1], c[i]]).collect())),
        _ => None,
    };
    let fans = |all: &[Polygon]| all.iter().map(fan).collect();
    let report = judge_partitions_of(&fans, &partition::Options::default().cases(20)).unwrap();
    let message = report.check().unwrap_err().to_string();
    let message = message.replace("Polygon::new(", "").replace("vec!", "").replace("])", "]");
    let (said, message) = (words(said).join(" "), words(&message).join(" "));
    assert!(said.contains(&message), "{message}\n\n{said}");
}
