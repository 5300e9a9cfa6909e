//! Each page of `tests/transcripts` is a transcript: commands in its blocks marked `console`, each with what it prints. All of a page's
//! commands run in one folder, and what they print has to be what the page says.
//!
//! - `$ ` begins a command for `sh`, in which `rasterproof` is the program; `> ` continues it.
//! - Its standard output follows; then the lines of its standard error, each behind `2> `; then `exit status N`, unless it is 0.
//! - A line `...` stands for any lines. `[TIME]` stands for a number of seconds or milliseconds, and `[FOLDER]` for the folder.
//!   How far a slow command is, `10 s: 3 of 8 cases`, is left out.
//! - `$DATA` is the folder `tests/data`.
//!
//! Files beside the commands lie in a folder with the page's name, and pages that take seconds in `slow`. `RASTERPROOF_RENEW=1 cargo test --test it transcripts` writes what is
//! printed now in the place of what differs, and `RASTERPROOF_TRANSCRIPT=NAME` runs one page alone.
#![cfg(unix)]

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use rasterproof_core::parallel;

use crate::pages::{Renewal, files, root};
use crate::program::{Folder, PROGRAM, Run};

const ANY_LINES: &str = "...";

/// The last line of what is wrong whatever a page says: text of other people reached a terminal as a command to it, or a panic.
const FORBIDDEN: &str = "(a panic, or characters that a terminal obeys)";

/// A command of a page, and the lines of the page that say what it prints.
struct Step {
    script: String,
    said: Range<usize>,
}

fn steps(lines: &[&str]) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut is_inside = false;
    let mut at = 0;
    while at < lines.len() {
        let line = lines[at];
        at += 1;
        if line.starts_with("```") {
            is_inside = line == "```console";
        }
        let Some(first) = line.strip_prefix("$ ").filter(|_| is_inside) else { continue };
        let mut script = first.to_owned();
        while let Some(more) = lines.get(at).and_then(|line| line.strip_prefix('>')) {
            script += "\n";
            script += more.strip_prefix(' ').unwrap_or(more);
            at += 1;
        }
        let is_last = |line: &&str| line.starts_with("$ ") || line.starts_with("```");
        let length = lines[at..].iter().position(is_last).expect("the end of a block");
        // Empty lines separate a command from the one before.
        let said = lines[at..at + length].iter().rposition(|line| !line.is_empty());
        steps.push(Step { script, said: at..at + said.map_or(0, |last| last + 1) });
        at += length;
    }
    steps
}

/// What a command prints, in the form in which a page says it.
fn printed(folder: &Folder, script: &str) -> Vec<String> {
    let programs = Path::new(PROGRAM).parent().unwrap().display();
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", script]).current_dir(folder).env("PATH", path).stdin(Stdio::null());
    // The number of threads is printed by some commands.
    shell.env_remove("COLUMNS").env_remove("CARGO").env("RAYON_NUM_THREADS", "2");
    let data = root().join("tests/data");
    shell.env("DATA", &data);
    let run = Run::of(&mut shell);
    let mut all: Vec<String> = run.out.trim_end().lines().map(str::to_owned).collect();
    let errors = run.errors.lines().filter(|line| !is_progress(line));
    all.extend(errors.map(|line| format!("2> {line}").trim_end().to_owned()));
    match run.status {
        Some(0) => {}
        Some(status) => all.push(format!("exit status {status}")),
        None => all.push("ended by a signal".to_owned()),
    }
    let is_hidden = |c: char| rasterproof_host::text::is_hidden(c) && !"\n\t".contains(c);
    if run.to_string().contains(is_hidden) || run.errors.contains("panicked") {
        all.push(FORBIDDEN.to_owned());
    }
    let here = folder.to_str().unwrap();
    let named =
        |line: &String| line.replace(here, "[FOLDER]").replace(data.to_str().unwrap(), "[DATA]");
    all.iter().map(|line| without_times(&named(line))).collect()
}

/// Whether a line says how far a command is after some seconds, which a slow machine alone prints.
fn is_progress(line: &str) -> bool {
    let (seconds, rest) = line.split_once(" s: ").unwrap_or_default();
    seconds.parse::<u32>().is_ok() && rest.contains(" of ")
}

/// The line with `[TIME]` for each number before `s` or `ms`.
fn without_times(line: &str) -> String {
    let words: Vec<&str> = line.split(' ').collect();
    let is_unit = |word: &&str| matches!(word.trim_end_matches([',', ';', '.', ')']), "s" | "ms");
    let shown = |(at, word): (usize, &&str)| {
        let number = word.trim_start_matches('(');
        let is_time = number.parse::<f64>().is_ok() && words.get(at + 1).is_some_and(is_unit);
        if is_time { word.replace(number, "[TIME]") } else { (*word).to_owned() }
    };
    words.iter().enumerate().map(shown).collect::<Vec<_>>().join(" ").trim_end().to_owned()
}

/// Whether the lines of a page are those that were printed.
fn says(page: &[&str], printed: &[String]) -> bool {
    match page.split_first() {
        None => printed.is_empty(),
        Some((&ANY_LINES, rest)) => (0..=printed.len()).any(|at| says(rest, &printed[at..])),
        Some((line, rest)) => {
            printed.first().is_some_and(|first| first == line) && says(rest, &printed[1..])
        }
    }
}

/// The page as it would be right, and what is wrong with it as it is.
fn checked(path: &Path, text: &str) -> (String, String) {
    let folder = Folder::new(&format!("transcript-{}", name(path)));
    for file in fs::read_dir(path.with_extension("")).into_iter().flatten().flatten() {
        fs::copy(file.path(), folder.join(file.file_name())).unwrap();
    }
    let lines: Vec<&str> = text.lines().collect();
    let (mut right, mut wrong, mut kept) = (String::new(), String::new(), 0);
    let steps = steps(&lines);
    assert!(!steps.is_empty(), "{}: no command", path.display());
    for Step { script, said } in steps {
        let printed = printed(&folder, &script);
        let is_allowed = printed.last().is_none_or(|line| line != FORBIDDEN);
        if is_allowed && says(&lines[said.clone()], &printed) {
            continue;
        }
        let (page, now) = (lines[said.clone()].join("\n"), printed.join("\n"));
        wrong += &format!("{}: $ {script}\n--- says\n{page}\n--- prints\n{now}\n", name(path));
        right += &in_lines(&lines[kept..said.start]);
        right += &in_lines(&printed);
        kept = said.end;
    }
    (right + &in_lines(&lines[kept..]), wrong)
}

fn in_lines(lines: &[impl AsRef<str>]) -> String {
    lines.iter().map(|line| format!("{}\n", line.as_ref())).collect()
}

fn name(path: &Path) -> &str {
    path.file_stem().unwrap().to_str().unwrap()
}

fn check(pages: &[PathBuf]) {
    let only = std::env::var("RASTERPROOF_TRANSCRIPT").ok();
    let is_meant = |path: &&PathBuf| only.as_ref().is_none_or(|only| name(path) == only);
    let pages: Vec<&PathBuf> = pages.iter().filter(is_meant).collect();
    let texts: Vec<String> = pages.iter().map(|path| fs::read_to_string(path).unwrap()).collect();
    let checked = parallel::map(pages.len(), |at| checked(pages[at], &texts[at]));
    let mut renewal = Renewal::default();
    for (path, (right, wrong)) in pages.iter().zip(&checked) {
        print!("{wrong}");
        renewal.is(path.strip_prefix(root()).unwrap(), right);
    }
    renewal.check("transcripts");
}

fn transcripts(folder: &str) -> Vec<PathBuf> {
    let in_it = |path: &PathBuf| path.parent().unwrap().ends_with(folder);
    files(&root().join("tests/transcripts"), ".md").into_iter().filter(in_it).collect()
}

#[test]
fn transcripts_are_what_the_program_prints() {
    let pages = transcripts("transcripts");
    check(&pages);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn slow_transcripts_are_what_the_program_prints() {
    check(&transcripts("slow"));
}

/// The rule can fail, and dots stand for lines alone.
#[test]
fn transcripts_that_differ_are_found() {
    let printed = ["one", "two", "three"].map(str::to_owned);
    for right in [&["one", "two", "three"][..], &["...", "three"], &["one", "...", "..."], &["..."]]
    {
        assert!(says(right, &printed), "{right:?}");
    }
    for wrong in [&["one", "two"][..], &["...", "two"], &["one", "...", "four"], &["one..."], &[]] {
        assert!(!says(wrong, &printed), "{wrong:?}");
    }
    assert_eq!(
        without_times("in 0.1 ms by x (3 s), 1.5 s."),
        "in [TIME] ms by x ([TIME] s), [TIME] s."
    );
    assert!(is_progress("10 s: 67 of 100 percent Lines") && !is_progress("error: 3 s: 1 of 2"));
    let page = "```sh\n$ no\n```\n\n```console\n$ cat <<E\n> a\n>\n> E\na\n\n$ false\nexit status 1\n```\n";
    let text: Vec<&str> = page.lines().collect();
    let steps: Vec<_> = steps(&text).into_iter().map(|step| (step.script, step.said)).collect();
    assert_eq!(steps, [("cat <<E\na\n\nE".to_owned(), 9..10), ("false".to_owned(), 12..13)]);
    let (right, wrong) = checked(Path::new("differs.md"), page);
    assert!(right == page && wrong.is_empty(), "{wrong}");
    let (right, wrong) = checked(Path::new("differs.md"), &page.replace("status 1", "status 2"));
    assert!(right == page && wrong.contains("--- prints\nexit status 1\n"), "{wrong}");
    let page = "```console\n$ printf 'a\\033'\n...\n```\n";
    let (right, _) = checked(Path::new("differs.md"), page);
    assert!(right.contains(FORBIDDEN), "{right}");
}
