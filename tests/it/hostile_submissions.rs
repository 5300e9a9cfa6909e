//! Grading of submissions that are hostile: each that cannot be used has no points and a reason, the rest is
//! graded, and nothing that a submission started lives on.

#![cfg(unix)]

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt as _;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

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

/// Points and the reason of each submission of a class.
fn graded(class: &Folder, words: &[&str]) -> impl Fn(&str) -> (i64, String) {
    let head = ["course", "--grade", "--folder", ".", "--cases", "1", "--format", "json"];
    let out = class.check([&head[..], words].concat(), 1).without_errors().out;
    assert!(!out.contains('\u{1b}'), "{out}");
    let all: Value = serde_json::from_str(&out).unwrap();
    move |name| {
        let found = all["submissions"].as_array().unwrap().iter().find(|s| s["name"] == name);
        let found = found.unwrap_or_else(|| panic!("no {name} in {all:#}"));
        (found["points"].as_i64().unwrap(), found["error"].as_str().unwrap_or("").to_owned())
    }
}

#[test]
fn one_hostile_file_does_not_stop_the_class() {
    let class = Folder::new("submissions-files");
    submit(&class, "right", &progress(""));
    submit(&class, "truncated", "build = []\nrun = [\"x\nstep");
    submit(&class, "escapes", "run = []\nstep = \"\\u001b[31mred\"\n");
    submit(&class, "long", &format!("run = [{}", "[".repeat(900_000)));
    let other = |name: &str| {
        fs::create_dir(class.join(name)).unwrap();
        class.join(name).join("course.toml")
    };
    let made = Command::new("mkfifo").arg(other("pipe")).status().unwrap();
    assert!(made.success());
    symlink("/dev/zero", other("zero")).unwrap();
    fs::create_dir(other("directory")).unwrap();
    fs::File::create(other("sparse")).unwrap().set_len(5_000_000_000).unwrap();
    fs::write(other("bytes"), b"run = []\nstep = \"\xff\"\n").unwrap();
    symlink("course.toml", other("circle")).unwrap();
    other("empty");
    assert!(Command::new("mkfifo").arg(class.join("itself")).status().unwrap().success());
    symlink("nowhere", class.join("broken")).unwrap();
    fs::write(class.join("names.csv"), "a list of the teacher").unwrap();
    let name = OsStr::from_bytes(b"not-\xff-utf-8");
    fs::create_dir(class.join(name)).unwrap();
    fs::write(class.join(name).join("course.toml"), progress("")).unwrap();

    let start = Instant::now();
    let graded = graded(&class, &[]);
    // It waited for ever, or until memory was gone.
    assert!(start.elapsed() < Duration::from_secs(120));
    let (points, error) = graded("right");
    assert!(points > 0 && error.is_empty(), "{error}");
    assert_eq!(graded("not-\u{fffd}-utf-8"), (points, error));
    for (name, reason) in [
        ("truncated", "line 3"),
        ("escapes", "no step is called \"\\u{1b}[31mred\""),
        ("long", "line 1"),
        ("pipe", "is a pipe, not a file"),
        ("zero", "is a device, not a file"),
        ("directory", "is a directory, not a file"),
        ("sparse", "is too large: at most 1 MiB are read"),
        ("bytes", "is not UTF-8 text (line 2)"),
        ("circle", "cannot be read"),
        ("empty", "it has no course.toml"),
        ("itself", "it is no folder"),
        ("broken", "it is no folder"),
    ] {
        let (points, error) = graded(name);
        assert_eq!(points, 0, "{name}");
        assert!(error.contains(reason) && error.len() < 3_000, "{name}: {error}");
    }
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

/// A build that floods, that waits, and that leaves a process in a session of its own.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn builds_are_bounded_and_what_they_started_is_ended() {
    let class = Folder::new("submissions-builds");
    // Numbers of seconds that no other process sleeps.
    submit(&class, "leaves", &progress("setsid sleep 4040.17 & exit 0"));
    submit(&class, "leaves-and-fails", &progress("echo no >&2; setsid sleep 4040.18 & exit 3"));
    submit(&class, "floods", &progress("(while :; do echo much; done) >&2"));
    submit(
        &class,
        "waits",
        &progress("setsid sh -c 'sleep 4040.19; sleep 4040.20' & sleep 4040.21"),
    );
    submit(&class, "right", &progress("echo a warning >&2"));
    let start = Instant::now();
    let graded = graded(&class, &["--build-seconds", "3", "--build-output", "1"]);
    // The children sleep for more than an hour.
    assert!(start.elapsed() < Duration::from_secs(120));
    assert_eq!(processes("4040."), Vec::<String>::new());
    let (points, _) = graded("right");
    assert!(points > 0);
    assert_eq!(graded("leaves"), (points, String::new()));
    for (name, reasons) in [
        ("leaves-and-fails", &["the build fails: sh -c", "| no"][..]),
        ("floods", &["the build writes more than 1 MiB to standard error", "| much"]),
        ("waits", &["the build takes more than 3 s"]),
    ] {
        let (points, error) = graded(name);
        assert_eq!(points, 0, "{name}");
        assert!(reasons.iter().all(|reason| error.contains(reason)), "{name}: {error}");
    }
    // A student's own check has the same limits.
    let run = class.check("course check --dir floods --build-output 1", 2).without_output();
    run.says("writes more than 1 MiB");
}

/// What a submission starts ends with it, before the next one is graded.
#[cfg(target_os = "linux")]
#[test]
fn a_submission_leaves_nothing_behind() {
    let class = Folder::new("submissions-leaves");
    let line = format!("setsid sleep 4041.17 & exec {PROGRAM} engine scanline");
    let text = format!("run = [\"sh\", \"-c\", {line:?}]\nstep = \"pixel\"\n");
    submit(&class, "a", &text);
    // It sees whether the other one's process is gone, and fails its build where it is not.
    let look = "for f in /proc/[0-9]*/cmdline; do tr '\\0' ' ' <$f | grep -q '^sleep 4041.17' && exit 1; done; exit 0";
    submit(&class, "b", &progress(look));
    let graded = graded(&class, &[]);
    let (points, error) = graded("a");
    assert!(points > 0, "{error}");
    assert_eq!(graded("b"), (points, error));
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

/// A stack larger than the address space refuses every thread, as a limit of processes does.
#[cfg(target_os = "linux")]
#[test]
fn without_threads_every_submission_has_its_reason() {
    let class = Folder::new("submissions-threads");
    submit(&class, "built", &progress("setsid sleep 4042.17 & sleep 4042.18"));
    submit(&class, "run", &progress(""));
    let mut command = class.command("course --grade --folder .");
    let out = Run::of(command.env("RUST_MIN_STACK", "70368744177664")).has(2).out;
    for name in ["built", "run"] {
        let head = format!("{name}: cannot be judged: ");
        let line = out.lines().find(|line| line.starts_with(&head)).unwrap_or_default();
        assert!(line.contains("allow more processes (ulimit -u)"), "{out}");
    }
    assert_eq!(processes("4042."), Vec::<String>::new());
}

/// A progress file that is a link stays one, names need not be text, and commands can be copied.
#[test]
fn progress_is_written_where_it_is() {
    let home = Folder::new("submissions-progress");
    let name = OsStr::from_bytes(b"a 'b' \xff");
    let own = home.join(name);
    fs::create_dir(&own).unwrap();
    home.put("kept.toml", progress(""));
    symlink("../kept.toml", own.join("course.toml")).unwrap();
    let mut check = home.command("course check scanline --cases 1");
    Run::of(check.current_dir(&own)).has(0).without_errors();
    assert!(own.join("course.toml").symlink_metadata().unwrap().is_symlink());
    assert!(home.text("kept.toml").contains("\"scanline\""));
    let mut check = home.command("course check scanline --cases 1 --dir");
    Run::of(check.arg(&own)).has(0);
    let mut start = home.command("course start");
    let run = Run::of(start.arg(OsStr::from_bytes(b"\xfe's")));
    run.prints(r"course check --dir $'\376\'s'");
    home.run(["course", "start", "--language", "python", "it's mine"])
        .has(0)
        .prints(r"course check --dir 'it'\''s mine'");
}

/// A program that ends its parents, its group or both loses its own row, and what it started ends.
#[cfg(target_os = "linux")]
#[test]
fn a_submission_cannot_end_the_grading() {
    let class = Folder::new("submissions-signals");
    // It goes on to its next parent, as long as that is this program.
    let parents = format!(
        "for i in $(seq 300); do p=$(cut -d' ' -f4 /proc/$$/stat); \
         [ \"$(readlink /proc/$p/exe)\" = {PROGRAM} ] && kill -KILL $p; done"
    );
    let lines = [
        ("a-int", "kill -INT $PPID"),
        ("b-term", "kill -TERM $PPID"),
        ("c-kill", "setsid sleep 4044.17 & sleep 4044.18 & kill -KILL $PPID"),
        ("d-hup", "kill -HUP $PPID"),
        ("e-group", "kill -INT 0"),
        ("f-group", "kill -KILL -$$"),
        ("g-parents", parents.as_str()),
    ];
    for (name, line) in lines {
        let line = format!("{line}; sleep 0.3; exec {PROGRAM} engine scanline");
        let text = format!("run = [\"sh\", \"-c\", {line:?}]\nstep = \"pixel\"\n");
        submit(&class, name, &text);
    }
    submit(&class, "z-right", &progress(""));
    let out = class.check("course --grade --folder . --cases 1", 1).out;
    let rows: Vec<&str> = out.lines().skip(1).take(lines.len() + 1).collect();
    let names = lines.iter().map(|(name, _)| *name).chain(["z-right"]);
    for (row, name) in rows.iter().zip(names) {
        assert!(row.starts_with(name), "{out}");
        assert_eq!(row.contains('+'), name == "z-right", "{out}");
    }
    for (name, _) in lines {
        assert!(out.contains(&format!("{name}: cannot be judged: ")), "{name}: {out}");
    }
    assert_eq!(processes("4044."), Vec::<String>::new());
    // A program that is graded alone has a result for its teacher, too.
    let words = ["course", "--grade", "--format", "gradescope", "--", "sh", "-c"];
    let run = class.check([&words[..], &["kill -INT $PPID; sleep 0.3"]].concat(), 2);
    assert_eq!(run.json()["score"], 0);
    assert!(run.json()["tests"][0]["output"].as_str().unwrap().contains("was ended"), "{run}");
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
