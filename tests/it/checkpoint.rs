//! `judge --checkpoint`: a judgement that was broken off goes on, and comes to the same verdict.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::program::{Folder, PROGRAM};

/// Answers as an engine, each time after a pause, and counts what it is asked.
const SLOW: &str = include_str!("../data/slow-engine.py");

/// The family has no case that this engine gets wrong, so that no time is spent on causes.
fn judge(folder: &Folder, options: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(["judge", "--family", "off-screen", "--cases", "450"]).args(options);
    command.args(["--", "python3", "-B", "slow.py", PROGRAM]).current_dir(folder);
    command.stdin(Stdio::null());
    command
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_broken_judgement_goes_on() {
    let folder = Folder::new("checkpoint");
    folder.put("slow.py", SLOW);
    let kept = folder.join("kept");
    let asked = || std::fs::metadata(folder.join("asked")).map_or(0, |file| file.len());
    let mut broken = judge(&folder, &["--checkpoint", "kept"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // The first file has no answers; the next one is written some seconds later.
    let end = Instant::now() + Duration::from_secs(60);
    while std::fs::metadata(&kept).map_or(0, |file| file.len()) < 2_000 {
        assert!(broken.try_wait().unwrap().is_none(), "it ended before its answers were kept");
        assert!(Instant::now() < end, "its answers are not kept");
        std::thread::sleep(Duration::from_millis(20));
    }
    broken.kill().unwrap();
    broken.wait().unwrap();

    // Answers to other questions are of no use.
    let refused = judge(&folder, &["--checkpoint", "kept", "--seed", "2"]).output().unwrap();
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("the checkpoint kept"), "{said}");

    let before = asked();
    let resumed = judge(&folder, &["--checkpoint", "kept"]).output().unwrap();
    let rest = asked() - before;
    assert!(!kept.exists(), "what was judged to its end is kept");
    let whole = judge(&folder, &[]).output().unwrap();
    let all = asked() - before - rest;
    assert!(rest > 0 && rest + 100 < all, "{rest} of {all} were asked after the break");
    let text = |output: &std::process::Output| {
        String::from_utf8_lossy(&output.stdout).replace(" --checkpoint kept", "")
    };
    assert_eq!(text(&resumed), text(&whole));
    assert_eq!(resumed.status.code(), whole.status.code());
}
