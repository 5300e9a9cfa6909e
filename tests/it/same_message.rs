//! One planted fault, a strict fill rule, judged from Rust, Python, JavaScript and C++: the same cases are wrong by the same
//! pixels, and the same words say so.

use std::collections::BTreeMap;
use std::process::Command;

use rasterproof_faults::planted::TriangleMutant;
use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::{Options, judge_coverage};

use crate::pages::root;
use crate::program::{Folder, PROGRAM, Run};

const PYTHON: &str = r#"
import numpy as np, rasterproof

def strict(corners, window):
    x, y = np.arange(window[0]) + 0.5, np.arange(window[1])[:, None] + 0.5
    a, b, c = corners.transpose(1, 2, 0)[..., None, None]
    edge = lambda p, q: (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
    e = np.stack([edge(a, b), edge(b, c), edge(c, a)])
    return ((e > 0).all(0) | (e < 0).all(0)).astype(int)

try:
    rasterproof.assert_rasterizer(strict, cases=20, declare="window=1024x1024 range=4096")
except AssertionError as error:
    print(error)
"#;

const JAVASCRIPT: &str = r"
const { assertRasterizer } = await import('./target/js/package/index.js');
function strict([a, b, c], [width, height]) {
  const edge = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  return Uint8Array.from({ length: width * height }, (_, i) => {
    const x = (i % width) + 0.5, y = Math.floor(i / width) + 0.5;
    const e = [edge(a, b, x, y), edge(b, c, x, y), edge(c, a, x, y)];
    return e.every((v) => v > 0) || e.every((v) => v < 0);
  });
}
try {
  assertRasterizer(strict, { cases: 20, declare: 'window=1024x1024 range=4096' });
} catch (error) {
  console.log(error.message);
}";

const CPP: &str = r#"
#include "rasterproof.h"
static void strict(double ax, double ay, double bx, double by, double cx, double cy, int width, int height, rasterproof_set_pixel set_pixel) {
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double u = (bx - ax) * (y + 0.5 - ay) - (by - ay) * (x + 0.5 - ax);
            double v = (cx - bx) * (y + 0.5 - by) - (cy - by) * (x + 0.5 - bx);
            double w = (ax - cx) * (y + 0.5 - cy) - (ay - cy) * (x + 0.5 - cx);
            if ((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)) set_pixel(x, y);
        }
}
int main() { return rasterproof_serve("strict", "batch=1024 range=4096", strict, nullptr); }
"#;

/// What is said in this language, or nothing where it is not installed.
fn said(language: &str) -> Option<String> {
    let folder = Folder::new(&format!("same-message-{language}"));
    let run = |command: &mut Command| Run::of(command.current_dir(root()));
    let has = |program: &str, words: &[&str]| {
        Command::new(program).args(words).output().is_ok_and(|done| done.status.success())
    };
    let is_there = match language {
        "Python" => has("python3", &["-c", "import numpy"]),
        "JavaScript" => {
            root().join("target/js/package/rasterproof.wasm").exists()
                && has("node", &["--version"])
        }
        _ => has("c++", &["--version"]),
    };
    if !is_there {
        eprintln!("skipped: {language}");
        return None;
    }
    let done = match language {
        "Python" => run(Command::new("python3")
            .args(["-B", "-c", PYTHON])
            .env("PYTHONPATH", "adapters/python")
            .env("RASTERPROOF", PROGRAM))
        .has(0),
        "JavaScript" => {
            run(Command::new("node").args(["--input-type=module", "-e", JAVASCRIPT])).has(0)
        }
        _ => {
            let (source, program) = (folder.put("strict.cpp", CPP), folder.join("strict"));
            let mut build = Command::new("c++");
            build.args(["-std=c++11", "-O1", "-I", "adapters"]).arg(source).arg("-o").arg(&program);
            run(&mut build).has(0);
            folder.check("judge --cases 20 -- ./strict", 1)
        }
    };
    Some(done.out)
}

/// The words, without the calls that repeat a case: each language has its own. The program breaks long lines.
fn words(said: &str) -> Vec<String> {
    let lines = said.lines().filter(|line| !line.trim().starts_with("repeat with: "));
    let declares = ["declare=", "declare: ", "--declare "];
    let same =
        |line: &str| declares.iter().fold(line.to_owned(), |line, d| line.replace(d, "declare "));
    lines
        .map(same)
        .flat_map(|line| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
        .collect()
}

/// Wrong pixels by family, as the table has them.
fn missing(said: &str) -> BTreeMap<&str, u64> {
    let rows = said.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    let rows = rows.filter(|row| row.len() == 10 && row[9].ends_with('%'));
    rows.filter_map(|row| Some((row[0], row[4].parse().ok()?))).collect()
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn the_same_fault_has_the_same_message_in_every_language() {
    let all: Vec<_> = ["C++", "Python", "JavaScript"].into_iter().filter_map(said).collect();
    for other in &all {
        assert_eq!(words(other), words(&all[0]));
    }
    // What the macros of Rust judge: families within the declared range have the same cases.
    let families =
        [FamilyName::HalfInteger, FamilyName::Rectangle, FamilyName::Fan, FamilyName::Flat];
    let options = families.into_iter().fold(Options::default().cases(20), Options::family);
    let verdict = judge_coverage(&TriangleMutant::ExclusiveEdges, &options).unwrap();
    let message = verdict.check().unwrap_err().to_string();
    let cause = "draws nothing on an edge: neighbours leave holes.";
    assert!(message.contains(cause), "{message}");
    for said in &all {
        let unbroken = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(unbroken.contains(cause), "{said}");
        let found = missing(said);
        for family in &verdict.families {
            let wrong = family.pairs[0].tally.missing;
            assert!(
                wrong > 0 && found[&*family.family] == wrong,
                "{}: {wrong}\n{said}",
                family.family
            );
        }
    }
}
