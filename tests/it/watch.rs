//! `judge --watch` while files are written, touched and removed. What its screens say is in `tests/transcripts/slow/judge-watch.md`.
#![cfg(unix)]

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::program::{Folder, PROGRAM};

/// Answers every triangle with all pixels of the window, or with none.
const ALL_OR_NONE: &str = include_str!("../data/all-or-none.py");

/// Ends the command with its test.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        // Its programs end with it where it is asked to terminate.
        let _ = Command::new("kill").args(["-TERM", &self.0.id().to_string()]).status();
        let _ = self.0.wait();
    }
}

fn program(draws: bool, pause: f64) -> String {
    let draws = if draws { "True" } else { "False" };
    format!("import sys, time\nDRAWS, PAUSE = {draws}, {pause}\n{ALL_OR_NONE}")
}

/// What was printed, once all of it is there.
#[track_caller]
fn printed(folder: &Folder, is_whole: impl Fn(&str) -> bool) -> String {
    let end = Instant::now() + Duration::from_secs(120);
    loop {
        let text = folder.text("out");
        if is_whole(&text) {
            return text;
        }
        assert!(Instant::now() < end, "{text}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn verdicts(text: &str) -> usize {
    text.matches("Ctrl-C ends this").count()
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn what_changes_meanwhile_is_judged_anew() {
    let folder = Folder::new("watch");
    let mine = folder.put("mine.py", program(false, 0.0));
    let out = std::fs::File::create(folder.join("out")).unwrap();
    let judge = ["judge", "--watch", "--cases", "12", "--family", "half-integer"];
    let mut command = Command::new(PROGRAM);
    command.args(judge).args(["--", "python3", "-B", "mine.py"]).current_dir(&folder);
    command.stdin(Stdio::null()).stdout(out).stderr(Stdio::null());
    let mut watching = Watching(command.spawn().unwrap());
    let first = printed(&folder, |text| verdicts(text) == 1);
    assert!(first.contains("mine is not right: it draws nothing"), "{first}");

    // The same content, written again, is no change.
    folder.put("mine.py", program(false, 0.0));
    std::thread::sleep(Duration::from_secs(1));
    assert_eq!(folder.text("out"), first);

    // A file that is gone is waited for.
    std::fs::remove_file(&mine).unwrap();
    printed(&folder, |text| text.ends_with("mine.py is gone, and is waited for\n"));
    // It would take minutes, so the next change comes while it is judged: of this one there is no verdict.
    folder.put("mine.py", program(false, 0.25));
    printed(&folder, |text| text.contains("mine.py has changed"));
    while !folder.join("slow").exists() {
        std::thread::sleep(Duration::from_millis(50));
    }
    folder.put("mine.py", program(true, 0.0));
    let text = printed(&folder, |text| verdicts(text) == 2);
    let last = text.strip_prefix(&first).unwrap();
    assert_eq!(last.matches("mine.py has changed").count(), 2, "{last}");
    assert_eq!(last.matches("mine is not right").count(), 1, "{last}");
    // It draws too much now, where it drew nothing; no case is right that was not before.
    assert!(!last.contains("draws nothing") && last.contains("still:"), "{last}");
    // After the change it is asked no more than what was begun.
    let asked = folder.text("slow").len();
    assert!(asked <= 100, "{asked}");
    assert!(watching.0.try_wait().unwrap().is_none());
}
