//! Builds in a container, and rows of a class that are there as soon as they are judged. What else hostile submissions do is in
//! `tests/transcripts`: `submissions.md`, `what-submissions-start.md` and `slow/builds.md`.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::program::{Folder, PROGRAM, Run};

/// A progress file that builds by a line of `sh`, and then runs the scanline engine.
fn progress(build: &str) -> String {
    let build = match build {
        "" => String::new(),
        line => format!("\"sh\", \"-c\", {line:?}"),
    };
    format!("build = [{build}]\nrun = [{PROGRAM:?}, \"engine\", \"scanline\"]\nstep = \"pixel\"\n")
}

fn submit(class: &Path, name: &str, text: &str) {
    fs::create_dir(class.join(name)).unwrap();
    fs::write(class.join(name).join("course.toml"), text).unwrap();
}

/// The numbers of processes whose command line holds a word.
fn processes(word: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").into_iter().flatten().flatten() {
        let line = fs::read(entry.path().join("cmdline")).unwrap_or_default();
        if String::from_utf8_lossy(&line).contains(word) {
            found.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    found
}

/// In a container the session and the process group may be led from outside; their numbers are 0 inside.
#[cfg(target_os = "linux")]
#[test]
fn what_a_build_starts_is_ended_in_a_container() {
    let inside = ["--map-root-user", "--pid", "--fork", "--mount-proc"];
    let unshare = || {
        let mut command = Command::new("unshare");
        command.args(inside);
        command
    };
    if !unshare().arg("true").output().is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: this system allows no process namespaces");
        return;
    }
    let class = Folder::new("submissions-container");
    // The shell names itself as a process does that has ended, in bytes that are no text.
    let stray = "printf ')\\377 Z 0 0 0' >/proc/self/comm; sleep 4043.17; :";
    submit(&class, "a", &progress(&format!("setsid sh -c \"{stray}\" & sleep 0.2; exit 3")));
    let look = "grep -qa 4[0]43 /proc/[0-9]*/cmdline && echo it lives >&2; exit 4";
    submit(&class, "b", &progress(look));
    let mut command = unshare();
    command.args([PROGRAM, "course", "--grade", "--folder", "."]).current_dir(&class);
    let run = Run::of(&mut command).has(2).omits("| it lives");
    assert_eq!(run.out.matches("the build fails").count(), 2, "{run}");
}

/// A row is there as soon as it is judged, and Ctrl-C ends the judge of the next one with all it started.
#[cfg(target_os = "linux")]
#[test]
fn rows_are_written_as_they_are_judged() {
    use rustix::process::{Pid, Signal, kill_process};
    use std::io::{BufRead as _, BufReader};
    let class = Folder::new("submissions-rows");
    submit(&class, "a", &progress(""));
    submit(&class, "b", &progress("setsid sleep 4045.17 & sleep 4045.18"));
    let mut command = class.command("course --grade --folder . --cases 1");
    let mut child = command.stdout(std::process::Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.next().unwrap().unwrap().starts_with("submission"));
    assert!(lines.next().unwrap().unwrap().starts_with("a  "));
    let is_building = || {
        std::thread::sleep(Duration::from_millis(10));
        processes("4045.17").len() + processes("4045.18").len() >= 2
    };
    assert!((0..1000).any(|_| is_building()));
    kill_process(Pid::from_child(&child), Signal::INT).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!((0..300).any(|_| {
        std::thread::sleep(Duration::from_millis(10));
        processes("4045.").is_empty()
    }));
}
