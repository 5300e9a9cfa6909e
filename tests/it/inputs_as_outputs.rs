//! Every command that writes, tried with each of its inputs as its output: typed, and by hard and symbolic links at the
//! names that the program chooses. No input may change; and what somebody else wrote is replaced only with `--force`.
#![cfg(unix)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::sync::LazyLock;

use rasterproof::cli::exit::{AGREES, DISAGREES, USAGE};
use rasterproof_core::parallel;

use crate::pages::root;
use crate::program::{Folder, PROGRAM, Run, table};

/// A command line. In its words `{o}` stands for a name that is typed for an output, and `PROGRAM` for the program.
struct Line {
    words: String,
    inputs: Vec<String>,
    /// What `{o}` stands for where it names a file of its own.
    typed: String,
    /// An input that the command writes anew.
    updated: String,
}

/// Every command that reads a file or writes one.
static LINES: LazyLock<Vec<Line>> = LazyLock::new(|| {
    let line = |[words, inputs, typed]: [String; 3]| {
        let updated = inputs.strip_suffix('*').unwrap_or_default().to_owned();
        let inputs = inputs.trim_end_matches('*').split_whitespace();
        Line { words, inputs: inputs.map(str::to_owned).collect(), typed, updated }
    };
    table("inputs-as-outputs").into_iter().map(line).collect()
});

/// Commands without a file that they read, or with none but the picture that `--plot` names.
const WITHOUT_FILES: [&str; 7] =
    ["engine", "mutants", "tolerances", "digest", "fixtures", "list", "help"];

/// The inputs of all lines, each with its content.
static INPUTS: LazyLock<BTreeMap<String, Vec<u8>>> = LazyLock::new(inputs);

/// Those of `tests/data/inputs-as-outputs`, and what the program writes itself.
fn inputs() -> BTreeMap<String, Vec<u8>> {
    let made = Folder::new("inputs-as-outputs-made");
    let printed = |words: &str| made.check(words, AGREES).out.into_bytes();
    let adapter = serde_json::json!([{
        "name": "own", "library": "own", "call": "own", "command": [PROGRAM, "engine", "scanline"]
    }]);
    let course = format!("run = [\"{PROGRAM}\", \"engine\", \"scanline\"]\nstep = \"pixel\"\n");
    let judge = "judge --cases 2 --family fan --update-baseline --baseline known.txt --";
    made.check(format!("{judge} {PROGRAM} engine scanline"), AGREES);
    let made = [
        ("known.txt", fs::read(made.join("known.txt")).unwrap()),
        ("adapters/league.json", adapter.to_string().into()),
        ("course.toml", course.into()),
        ("plan.json", printed("plan cube --size 32x24 --rounds 1 --whole --json")),
        ("0.json", printed("exhaust lines --reach 2 --shard 0/2")),
        ("1.json", printed("exhaust lines --reach 2 --shard 1/2")),
        ("snapshots/a.snap", b"---\nsource: a.rs\n---\nold\n".to_vec()),
        ("snapshots/a.snap.new", b"---\nsource: a.rs\n---\nnew\n".to_vec()),
        ("costs.json", printed("cost lines --quick --json")),
    ];
    let kept = root().join("tests/data/inputs-as-outputs");
    let read = |name: String| (name.clone(), fs::read(kept.join(name)).unwrap());
    let kept = files(&kept, "").into_iter().map(read);
    kept.chain(made.map(|(name, content)| (name.to_owned(), content))).collect()
}

/// A folder with the inputs of a line in it.
struct Place {
    folder: Folder,
    inputs: Vec<(&'static str, &'static [u8])>,
}

impl Place {
    fn new(number: usize, line: &Line) -> Self {
        let folder = Folder::new(&format!("inputs-as-outputs-{number}"));
        let all = INPUTS.iter().filter(|(name, _)| line.inputs.contains(name));
        let inputs: Vec<_> = all.map(|(name, content)| (&**name, &content[..])).collect();
        assert_eq!(inputs.len(), line.inputs.len(), "an input of {} is missing", line.words);
        for (name, content) in &inputs {
            fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
            folder.put(name, content);
        }
        Self { folder, inputs }
    }

    fn run(&self, line: &Line, typed: &str) -> Run {
        let words = line.words.replace("{o}", typed).replace("PROGRAM", PROGRAM);
        self.folder.run(words)
    }

    /// Fails where an input has another content now.
    #[track_caller]
    fn is_unchanged(&self, line: &Line, how: &str, run: &Run) {
        for (name, content) in self.inputs.iter().filter(|(name, _)| *name != line.updated) {
            let now = fs::read(self.folder.join(name)).unwrap_or_default();
            assert!(now == *content, "{name} has changed, {how}: {run}");
        }
    }
}

/// The files below a folder, by their paths from it.
fn files(folder: &Path, from: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder.join(from)).unwrap() {
        let entry = entry.unwrap();
        let name = Path::new(from).join(entry.file_name()).to_str().unwrap().to_owned();
        match entry.file_type().unwrap().is_dir() {
            true => found.append(&mut files(folder, &name)),
            false => drop(found.insert(name)),
        }
    }
    found
}

/// Runs a line as it is meant; the files that it writes, which are those that it makes and those that it writes anew.
fn outputs(number: usize, line: &Line) -> Vec<String> {
    let place = Place::new(number, line);
    let run = place.run(line, &line.typed);
    assert!(run.status != Some(USAGE.into()) || line.words.contains("grade"), "{run}");
    assert!(
        [Some(AGREES.into()), Some(DISAGREES.into()), Some(USAGE.into())].contains(&run.status)
    );
    place.is_unchanged(line, "as it is meant", &run);
    let mut written = files(&place.folder, "");
    written.retain(|name| !line.inputs.contains(name) || *name == line.updated);
    written.into_iter().collect()
}

#[derive(Clone, Copy, Debug)]
enum Link {
    Hard,
    Symbolic,
}

fn link(folder: &Folder, from: &str, to: &str, kind: Link) {
    let at = folder.join(to);
    fs::create_dir_all(at.parent().unwrap()).unwrap();
    let _ = fs::remove_file(&at);
    match kind {
        Link::Hard => fs::hard_link(folder.join(from), at).unwrap(),
        Link::Symbolic => symlink(folder.join(from), at).unwrap(),
    }
}

/// Tries a line with each of its inputs as each of its outputs.
fn try_all(number: usize, line: &Line) {
    let outputs = outputs(number, line);
    for input in &line.inputs {
        if line.words.contains("{o}") {
            // As it is typed, where the program takes its name for an output, and written otherwise.
            for typed in [input.clone(), format!("./no/../{input}")] {
                let place = Place::new(number, line);
                let run = place.run(line, &typed);
                place.is_unchanged(line, &format!("with {typed} as its output"), &run);
                assert!(run.status != Some(AGREES.into()), "{typed} is no output: {run}");
            }
        }
        for output in &outputs {
            for kind in [Link::Hard, Link::Symbolic] {
                if *output == line.updated {
                    continue;
                }
                let place = Place::new(number, line);
                link(&place.folder, input, output, kind);
                let run = place.run(line, &line.typed);
                let how = format!("with {output} as a {kind:?} link to {input}");
                place.is_unchanged(line, &how, &run);
            }
        }
        // Standard output is one more output.
        let place = Place::new(number, line);
        let out = File::options().append(true).open(place.folder.join(input)).unwrap();
        let words = line.words.replace("{o}", &line.typed).replace("PROGRAM", PROGRAM);
        let run = Run::of(place.folder.command(words).stdout(out));
        place.is_unchanged(line, &format!("with {input} as standard output"), &run);
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn no_command_writes_over_its_inputs() {
    parallel::map(LINES.len(), |number| try_all(number, &LINES[number]));
}

/// What a folder holds by a name that the program chooses stays as it is, unless `--force` is given or the program made it.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn names_that_the_program_chooses_replace_only_what_it_made() {
    let chosen = |line: &&Line| line.words.contains("--out out");
    for (number, line) in LINES.iter().enumerate().filter(|(_, line)| chosen(line)) {
        let number = LINES.len() + number;
        for output in outputs(number, line).iter().filter(|name| name.starts_with("out/")) {
            let place = Place::new(number, line);
            fs::create_dir(place.folder.join("out")).unwrap();
            for foreign in ["mine\n", "<!DOCTYPE html>\n<html></html>\n", "\u{89}PNG"] {
                place.folder.put(output, foreign);
                let run = place.run(line, &line.typed);
                assert_eq!(place.folder.text(output), foreign, "{output}: {run}");
                // An index of somebody else's pages is left alone without a word.
                let is_said = run.errors.contains("rasterproof did not make it");
                assert!(is_said || output.ends_with("index.html"), "{output}: {run}");
            }
            if output.ends_with("index.html") {
                continue;
            }
            // With --force it is replaced, and from then on without.
            for force in ["--force --out out", "--out out"] {
                let words = line.words.replace("--out out", force);
                let words = words.replace("{o}", &line.typed).replace("PROGRAM", PROGRAM);
                let run = place.folder.run(words);
                let is_said = run.errors.contains("rasterproof did not make it");
                assert!(!is_said && run.status != Some(USAGE.into()), "{output}: {run}");
                let now = fs::read(place.folder.join(output)).unwrap();
                assert!(now.len() > 9, "{output}: {run}");
            }
        }
    }
}

/// The names of the commands in a list of them.
fn commands(help: &str) -> Vec<String> {
    let after = help.split_once("Commands:\n").unwrap().1;
    let lines = after.lines().take_while(|line| line.starts_with("  "));
    let names = lines.filter(|line| !line.starts_with("   "));
    names.map(|line| line.split_whitespace().next().unwrap().trim_matches(',').to_owned()).collect()
}

/// A new command is tried here, or named among those without files.
#[test]
fn every_command_is_tried() {
    let folder = Folder::new("inputs-as-outputs-commands");
    let all = commands(&folder.check("--help", AGREES).out);
    assert!(all.len() > 20, "{all:?}");
    for name in all {
        let is_tried = LINES.iter().any(|line| line.words.split(' ').next() == Some(&name));
        assert!(is_tried || WITHOUT_FILES.contains(&name.as_str()), "{name}");
    }
    for name in commands(&folder.check("course --help", AGREES).out) {
        let begins = [format!("course {name}"), format!("course --{name}")];
        let is_tried =
            LINES.iter().any(|line| begins.iter().any(|begin| line.words.starts_with(begin)));
        assert!(is_tried || name == "help", "course {name}");
    }
}
