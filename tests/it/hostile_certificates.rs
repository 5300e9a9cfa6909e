//! Certificates and checkpoints that somebody changed, and two processes on one checkpoint. Nothing
//! that is inconsistent is merged or resumed, and no message or use of memory grows with a number
//! that a file states.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use rasterproof::cli::exit::{AGREES, DISAGREES, USAGE};
use serde_json::{Value, json};

use crate::program::{Folder, PROGRAM, Run};

impl Folder {
    /// With the certificates `0.json`, `1.json` and `whole.json` of an enumeration.
    fn with_certificates(name: &str, words: &str, status: u8) -> Self {
        let folder = Self::new(&format!("certificates-{name}"));
        for part in ["--shard 0/2 -o 0.json", "--shard 1/2 -o 1.json", "-o whole.json"] {
            folder.check(format!("exhaust {words} {part}"), status);
        }
        folder
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.text(name)).unwrap()
    }

    fn write(&self, name: &str, content: &Value) {
        fs::write(self.join(name), content.to_string()).unwrap();
    }

    /// Writes `to`, which is `from` with another value at some places.
    fn change(&self, from: &str, to: &str, changes: &[(&str, Value)]) {
        let mut content = self.json(from);
        for (place, value) in changes {
            let field = content.pointer_mut(place);
            *field.unwrap_or_else(|| panic!("{from} has no {place}")) = value.clone();
        }
        self.write(to, &content);
    }
}

/// A process that does not outlive its test.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Run {
    /// Ends with a message of one short line, and hands over no certificate.
    #[track_caller]
    fn refused(self, part: &str) {
        let run = self.has(USAGE).says(part);
        assert!(run.out.is_empty() && !run.errors.contains("AGREES"), "{}", run.errors);
        let is_short = run.errors.trim_end().lines().count() == 1 && run.errors.len() < 800;
        assert!(is_short, "{} bytes: {:.2000}", run.errors.len(), run.errors);
    }
}

/// 49 lines: 28 in shard 0 of 2, which has four of the seven chunks, and 21 in shard 1.
const LINES: &str = "lines --reach 3";
const MERGE: &str = "merge 0.json 1.json";

#[test]
fn counts_that_do_not_follow_from_the_plan_are_refused() {
    let folder = Folder::with_certificates("counts", LINES, AGREES);
    for (place, value, why) in [
        ("/done/comparisons", json!(0), "it says 0 comparisons, where 637 belong"),
        ("/done/cases", json!(48), "it says 48 cases, where 49 belong"),
        ("/done/cases", json!(50), "it says 50 cases, where 49 belong"),
        ("/done/oracle_checks", json!(0), "it says 0 oracle_checks, where 49 belong"),
        ("/done/mismatches", json!(1), "it lists 0 examples, where 1 belong"),
        ("/expected/cases", json!(48), "in expected it says"),
        ("/expected/oracle_checks", json!(0), "in expected it says"),
        ("/proved", json!(false), "in proved it says"),
        ("/timing/seconds", json!(-1.0), "it says that it took -1.0 s"),
        ("/timing/seconds", json!(1e308), "it says that it took 1e308 s"),
    ] {
        folder.change("whole.json", "changed.json", &[(place, value)]);
        let run = folder.run("merge changed.json");
        run.says("changed.json is inconsistent: ").refused(why);
    }
    // What is moved from one shard to another leaves the sum as it was.
    folder.change("0.json", "0.json", &[("/done/cases", json!(21))]);
    folder.change("1.json", "1.json", &[("/done/cases", json!(28))]);
    folder.run(MERGE).refused("0.json is inconsistent: it says 21 cases, where 28 belong");
    // A certificate that disagrees may lack the cases of a chunk whose engine panicked, but not more.
    let example = |chunk: u64| json!([{"chunk": chunk, "number": 0, "what": "panic: x"}]);
    let lacks = |chunk, comparisons: u64| {
        [
            ("/done/cases", json!(42)),
            ("/done/oracle_checks", json!(42)),
            ("/done/comparisons", json!(comparisons)),
            ("/done/mismatches", json!(1)),
            ("/done/examples", example(chunk)),
            ("/proved", json!(false)),
        ]
    };
    folder.change("whole.json", "changed.json", &lacks(6, 546));
    folder.run("merge changed.json").has(DISAGREES).says("DISAGREES: 42 of 49 cases");
    folder.change("whole.json", "changed.json", &lacks(6, 545));
    folder.run("merge changed.json").refused("545 comparisons, where 546 belong to its 42 cases");
    folder.change("whole.json", "changed.json", &lacks(7, 546));
    folder.run("merge changed.json").refused("chunk 7, which is no part of it");
}

#[test]
fn certificates_of_another_program_are_refused() {
    let folder = Folder::with_certificates("program", LINES, AGREES);
    let (zero, one) = (folder.json("0.json"), folder.json("1.json"));
    let hash = zero.pointer("/identity/sources/src~1grid.rs").unwrap().as_str().unwrap();
    let claim = zero["claim"].as_str().unwrap();
    let mut more = zero["identity"]["sources"].clone();
    more["a\u{1b}[31m\nb"] = json!("00");
    for (place, value, why) in [
        ("/identity/version", json!("9.9.9"), "the version of the program it says \"9.9.9\", this"),
        ("/identity/sources", json!({}), "the code that was run (src/"),
        ("/identity/sources", more, r"the code that was run (a\u{1b}[31m\nb) it says "),
        ("/identity/sources/src~1grid.rs", json!("0"), "(src/grid.rs) it says \"0\", this program"),
        ("/identity/sources/src~1grid.rs", json!(format!("{hash}0")), "(src/grid.rs)"),
        ("/claim", json!(""), "in claim it says \"\", this program"),
        ("/claim", json!(claim.replace("ties included", "ties excluded")), "excluded"),
        ("/claim", json!("\u{1b}[2J\nAGR".repeat(1000)), r"in claim it says"),
        ("/repeat", json!("rm -r ."), "in repeat it says \"rm -r .\", this program"),
    ] {
        // Both, so that they do not differ from each other.
        for (name, file) in [("0.json", &zero), ("1.json", &one)] {
            folder.write(name, file);
            folder.change(name, name, &[(place, value.clone())]);
        }
        folder.run(MERGE).refused(why);
    }
}

/// No list of all parts is made, whatever number a file states.
#[cfg(unix)]
#[test]
fn a_great_number_of_parts_is_only_a_number() {
    let folder = Folder::new("certificates-parts");
    let whole = format!("exhaust {LINES} -o whole.json");
    folder.run(&whole).has(AGREES);
    for parts in [1_000_000u64, 1_000_000_000, u64::MAX] {
        folder.run(format!("exhaust {LINES} --shard 0/{parts} -o 0.json")).has(AGREES);
        // 2 GB of addresses are enough for the threads, and not for a list of 10^9 texts.
        let script = format!("ulimit -v 2000000; exec {PROGRAM} merge 0.json");
        let mut shell = Command::new("sh");
        shell.args(["-c", &script]).current_dir(&*folder).env("RAYON_NUM_THREADS", "1");
        let run = Run::of(&mut shell);
        run.refused(&format!("of {parts} shards these are missing: 1 to 6; "));
    }
    // The seven shards that hold a chunk are all that there is of a run in 10^9 parts.
    let parts: u64 = 1_000_000_000;
    for part in 0..7 {
        let words = format!("exhaust {LINES} --shard {part}/{parts} -o {part}.json");
        folder.run(&words).has(AGREES);
    }
    folder.run("merge 0.json 2.json 4.json 6.json").refused("these are missing: 1, 3, 5; ");
    folder.run("merge 0.json 1.json 2.json 3.json 4.json 5.json 6.json -o merged.json").has(AGREES);
    let [merged, whole] = ["merged.json", "whole.json"].map(|name| {
        let mut file = folder.json(name);
        file["timing"].take();
        file
    });
    assert_eq!(merged, whole);
}

/// A part without a case is no success, since nothing was judged.
#[test]
fn a_shard_without_cases_does_not_agree() {
    let folder = Folder::new("certificates-empty");
    for words in [
        "exhaust lines --reach 3 --shard 7/8",
        "exhaust triangles --window 1 --subpixel-bits 0 --shard 3/4",
        "exhaust edges --window 1 --subpixel-bits 0 --shard 3/16",
    ] {
        folder.run(words).refused("so nothing would be judged");
    }
}

#[test]
fn a_checkpoint_that_was_changed_is_refused() {
    let folder = Folder::new("certificates-checkpoint");
    fs::write(folder.join("file"), "no folder").unwrap();
    let words = format!("exhaust {LINES} --shard 0/2 --checkpoint c.json");
    // The certificate cannot be written, so the checkpoint is kept, with all chunks done.
    folder.run(format!("{words} -o file/x.json")).has(USAGE).says("AGREES: 28 of 49 cases");
    let kept = folder.json("c.json");
    folder.write("kept.json", &kept);
    for (place, value, why) in [
        ("/tally/cases", json!(36), "it says 36 cases, where 28 belong"),
        ("/tally/cases", json!(20), "it says 20 cases, where 28 belong"),
        ("/tally/comparisons", json!(0), "it says 0 comparisons, where 364 belong"),
        ("/tally/oracle_checks", json!(0), "it says 0 oracle_checks, where 28 belong"),
        ("/tally/mismatches", json!(u64::MAX), "mismatches, where at most"),
        ("/done", json!([]), "it says 28 cases, where 0 belong"),
        ("/done", json!([[0, 1], [2, 3]]), "it says 28 cases, where 14 belong"),
        ("/done", json!([[0, 7]]), "chunk 1 is done, which does not belong to shard 0 of 2"),
        ("/done", json!([[0, 1], [0, 1], [2, 3]]), "the chunks from 0 to before 1"),
        ("/done", json!([[2, 3], [0, 1]]), "the chunks from 0 to before 1"),
        ("/done", json!([[3, 2]]), "the chunks from 3 to before 2"),
        ("/done", json!([[8, 9]]), "the chunks from 8 to before 9"),
        ("/seconds", json!(-5.0), "it says that it took -5.0 s"),
    ] {
        folder.change("kept.json", "c.json", &[(place, value)]);
        let run = folder.run(&words).says("the checkpoint c.json was changed or is damaged: ");
        run.says("--restart ignores it").refused(why);
    }
    // A state of the middle, as it is saved under way, goes on.
    let middle = [
        ("/tally/cases", json!(14)),
        ("/tally/comparisons", json!(182)),
        ("/tally/oracle_checks", json!(14)),
        ("/done", json!([[0, 1], [4, 5]])),
    ];
    folder.change("kept.json", "c.json", &middle);
    folder.run(&words).has(AGREES).says("AGREES: 28 of 49 cases");
}

/// The second process does not touch the state of the first, and says who has it.
#[test]
fn two_processes_do_not_share_a_checkpoint() {
    let folder = Folder::new("certificates-lock");
    let long = "exhaust edges --subpixel-bits 8 --checkpoint c.json -o long.json";
    let first = folder.command(long).stderr(Stdio::null()).spawn().unwrap();
    let mut first = Killed(first);
    while !folder.join("c.json").exists() {
        assert!(first.0.try_wait().unwrap().is_none(), "the first process has ended");
        std::thread::sleep(Duration::from_millis(20));
    }
    let second = folder.run("exhaust lines --reach 3 --restart --checkpoint ./c.json");
    second.refused(&format!("c.json: is in use by another process {}; ", first.0.id()));
    assert!(folder.text("c.json").contains("\"edges\""));
    // What a killed process leaves is taken over.
    drop(first);
    folder.run("exhaust lines --reach 3 --restart --checkpoint c.json").has(AGREES);
    assert!(!folder.join("c.json").exists() && !folder.join("c.json.lock").exists());
}

/// A forged certificate can be consistent. That its chunks are judged again shows it.
#[test]
fn merge_judges_chunks_again() {
    let folder = Folder::with_certificates("check", LINES, AGREES);
    let checked = "judged again: 3 of 7 chunks, 21 cases (--seed 7): as the files say";
    folder.run("merge 0.json 1.json --check 3 --seed 7").has(AGREES).says(checked);
    folder.run("merge whole.json --check 99").has(AGREES).says("judged again: 7 of 7 chunks, 49 ");
    folder.run("merge whole.json --seed 7").has(USAGE).says("--check");
    folder.run("merge whole.json --check 0").has(USAGE);

    let planted = "triangles --window 2 --subpixel-bits 1 --plant inclusive-edges";
    let folder = Folder::with_certificates("check-planted", planted, DISAGREES);
    let right = folder.run("merge 0.json 1.json --check 30").has(DISAGREES);
    right.says("as the files say").says("DISAGREES: ");
    folder.run("merge 0.json 1.json --check 1").has(DISAGREES).says("as the files say");
    // Each chunk holds wrong cases, or none: whichever is judged, it is as the honest file says.
    for seed in 0..9 {
        folder.run(format!("merge whole.json --check 4 --seed {seed}")).has(DISAGREES);
    }
    let agreeing =
        [("/done/mismatches", json!(0)), ("/done/examples", json!([])), ("/proved", json!(true))];
    folder.change("whole.json", "forged.json", &agreeing);
    folder.run("merge forged.json").has(AGREES);
    for seed in 0..5 {
        let run = folder.run(format!("merge forged.json --check 12 --seed {seed}"));
        run.refused("when its chunks are judged again");
    }
    let hidden = "holds a wrong case that the file does not list";
    folder.run("merge forged.json --check 30").refused(hidden);
    let what = "/done/examples/0/what";
    folder.change("whole.json", "forged.json", &[(what, json!("x\u{1b}[2J"))]);
    folder.run("merge forged.json --check 30").has(USAGE).says("chunk 0 holds a wrong case");
    let mismatches = folder.json("whole.json")["done"]["mismatches"].as_u64().unwrap();
    folder.change("whole.json", "forged.json", &[("/done/mismatches", json!(mismatches - 1))]);
    let more = format!("it says {} mismatches, but", mismatches - 1);
    folder.run("merge forged.json --check 30").refused(&more);
}
