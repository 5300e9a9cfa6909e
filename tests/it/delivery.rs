//! What becomes of a result that cannot be delivered: nobody reads it, the disk is full, two options
//! name one file. The exit status stays that of the verdict, and nothing that was computed is lost.
#![cfg(unix)]

use std::ffi::OsStr;
use std::fs::{self, File};
use std::os::unix::ffi::OsStrExt as _;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use rasterproof::cli::exit::{AGREES, DISAGREES, USAGE};

use crate::program::{Folder, PROGRAM, Run};

/// By links: a program that replaces what it writes to would replace the machine's device.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("delivery-{name}"));
    symlink("/dev/null", folder.join("null")).unwrap();
    symlink("/dev/full", folder.join("full")).unwrap();
    folder
}

/// A pipe that nobody reads.
fn unread() -> std::io::PipeWriter {
    std::io::pipe().unwrap().1
}

impl Folder {
    fn run_unread(&self, words: &str) -> Run {
        Run::of(self.command(words).stdout(unread()))
    }

    /// Runs a command whose standard output is a full disk.
    fn run_full(&self, words: &str) -> Run {
        let full = File::options().write(true).open("/dev/full").unwrap();
        Run::of(self.command(words).stdout(full))
    }

    /// Runs a command whose standard output is closed.
    fn run_closed(&self, words: &str) -> Run {
        let mut shell = Command::new("sh");
        Run::of(shell.args(["-c", &format!("exec {PROGRAM} {words} >&-")]))
    }
}

/// Commands with the status that each has when its output is read.
const VERDICTS: [(&str, u8); 12] = [
    ("--cases 20", AGREES),
    ("--cases 20 --plant inclusive-edges", DISAGREES),
    ("--cases 20 --plant inclusive-edges --json", DISAGREES),
    ("inspect T2", AGREES),
    ("inspect T2 --plant inclusive-edges", DISAGREES),
    ("verify --invariant vertex-order --cases 50", AGREES),
    ("exhaust lines --reach 2", AGREES),
    ("exhaust triangles --window 1 --subpixel-bits 1 --plant inclusive-edges", DISAGREES),
    ("render cube --size 32x32", AGREES),
    ("specimens --cases 2", AGREES),
    ("digest --cases 1 --engine dda", AGREES),
    ("--help", AGREES),
];

/// Nobody reads standard output, or standard error, which is where `exhaust` says its verdict.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn the_status_does_not_depend_on_a_reader() {
    let folder = folder("reader");
    for (words, status) in VERDICTS.into_iter().chain([("quiz 2", DISAGREES)]) {
        folder.run(words).has(status);
        folder.run_unread(words).has(status);
        Run::of(folder.command(words).stderr(unread())).has(status);
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn a_verdict_that_cannot_be_written_is_no_success() {
    let folder = folder("full");
    for (words, status) in VERDICTS {
        let expected = if status == AGREES { USAGE } else { status };
        folder.run_full(words).has(expected).says("standard output cannot be written: No space");
        folder
            .run_closed(words)
            .has(expected)
            .says("standard output cannot be written: it is closed");
    }
}

#[test]
fn a_checkpoint_is_kept_until_its_result_is_delivered() {
    let folder = folder("checkpoint");
    let exhaust = "exhaust lines --reach 3 --checkpoint c.json";
    let planted = "exhaust triangles --window 1 --subpixel-bits 1 --plant inclusive-edges \
                   --checkpoint c.json";
    for (words, status) in [(exhaust, AGREES), (planted, DISAGREES)] {
        folder.run_unread(words).has(status).says("the result is kept in c.json");
        assert!(folder.join("c.json").exists());
        // The kept state is complete: it is delivered now, and removed.
        folder.run(words).has(status).prints("\"claim\"");
        assert!(!folder.join("c.json").exists());
        let failing = if status == AGREES { USAGE } else { status };
        folder.run_full(words).has(failing).says("the result is kept in c.json");
        assert!(folder.join("c.json").exists());
        fs::remove_file(folder.join("c.json")).unwrap();
        // The verdict is said although the certificate cannot be written.
        let verdict = if status == AGREES { "AGREES: " } else { "DISAGREES: " };
        let run = folder.run(format!("{words} -o full"));
        run.has(failing).says(verdict).says("full: cannot be written");
        assert!(folder.join("c.json").exists());
        fs::remove_file(folder.join("c.json")).unwrap();
    }
}

/// The text comes first; a file that cannot be written costs no result and is named.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn results_are_printed_before_files_are_written() {
    let folder = folder("printed");
    fs::write(folder.join("file"), "no folder").unwrap();
    let run = folder.run("specimens --cases 2 -o file/x.png");
    run.has(USAGE).prints("book-ch2").says("file/x.png: cannot be written");
    let run = folder.run("inspect T2 -o file/x.png");
    run.has(USAGE).prints("window: columns").says("file/x.png: cannot be written");
    let run = folder.run("inspect T2 --plant inclusive-edges -o file/x.png");
    run.has(DISAGREES).says("file/x.png: cannot be written");
    for words in ["", " --map", " --spin 2", " --engine tiles"] {
        let ending = if words == " --spin 2" { "gif" } else { "png" };
        let words = format!("render cube --size 16x16{words} -o file/x.{ending}");
        let run = folder.run(&words).has(USAGE).says("cannot be written");
        assert!(!run.out.is_empty() && !run.out.contains("drawn in file"), "{words}: {}", run.out);
    }
    let judge =
        format!("judge --cases 5 --family fan --baseline file/b -- {PROGRAM} engine scanline");
    folder.run(judge.replace("file/b", "file/b --update-baseline")).has(USAGE);
    let judged = format!("--report --out file -- {PROGRAM} engine scanline");
    let run = folder.run(format!("judge --cases 5 --family fan {judged}"));
    run.has(USAGE).prints("AGREES").says("file/judge.html: cannot be written");
    let run = folder.run("--cases 10 --plant inclusive-edges --report --out file");
    run.has(DISAGREES).prints("DISAGREES").says("file/verify.html: cannot be written");
    let run = folder.run("cost coverage --quick --out file");
    run.has(USAGE).prints("repeat with").says("cannot be written");
    fs::create_dir(folder.join("snapshots")).unwrap();
    fs::write(folder.join("snapshots/a.snap.new"), "---\nsource: a.rs\n---\nnew\n").unwrap();
    let run = folder.run("review -o file/x.html");
    run.has(DISAGREES).prints("a.snap").says("file/x.html: cannot be written");
}

#[test]
fn two_options_do_not_name_one_file() {
    let folder = folder("distinct");
    fs::write(folder.join("old.json"), "mine").unwrap();
    fs::hard_link(folder.join("old.json"), folder.join("hard.json")).unwrap();
    symlink("old.json", folder.join("soft.json")).unwrap();
    symlink(".", folder.join("here")).unwrap();
    let exhaust = "exhaust lines --reach 2 --restart";
    for (output, checkpoint) in [
        ("c.json", "c.json"),
        ("c.json", "./c.json"),
        ("c.json", "no/../c.json"),
        ("here/c.json", "c.json"),
        ("old.json", "hard.json"),
        ("soft.json", "old.json"),
        ("c.json.lock", "c.json"),
    ] {
        let run = folder.run(format!("{exhaust} -o {output} --checkpoint {checkpoint}"));
        run.has(USAGE).says("name this file; give each a file of its own");
    }
    assert_eq!(fs::read(folder.join("old.json")).unwrap(), b"mine");
    let is_refused = |words: &str| {
        folder.run(words).has(USAGE).says("name this file; give each a file of its own");
    };
    folder.run("exhaust lines --reach 2 --shard 0/2 -o 0.json").has(AGREES);
    folder.run("exhaust lines --reach 2 --shard 1/2 -o 1.json").has(AGREES);
    is_refused("merge 0.json 1.json -o ./1.json");
    folder.run("merge 0.json 1.json -o whole.json").has(AGREES);
    folder.put("m.png", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    is_refused("render ./m.png -o m.png");
    folder.put("p.png", "{}");
    is_refused("render cube --plan p.png -o here/p.png");
    for words in ["render cube", "inspect T2", "specimens --cases 1"] {
        let page = format!("{}.html", words.split(' ').next().unwrap());
        folder.put(&page, "");
        symlink(page, folder.join("page.png")).unwrap();
        is_refused(&format!("{words} --report --out . -o page.png"));
        fs::remove_file(folder.join("page.png")).unwrap();
    }
    fs::write(folder.join("m.wasm"), "wasm").unwrap();
    is_refused("playground --module m.wasm -o ./m.wasm");
    fs::write(folder.join("cost-price.svg"), "{}").unwrap();
    is_refused("cost --from cost-price.svg --out .");
    is_refused("judge --baseline judge.html --report --out . -- true");
    fs::create_dir(folder.join("snapshots")).unwrap();
    fs::write(folder.join("snapshots/a.snap.new"), "---\nsource: a.rs\n---\nnew\n").unwrap();
    is_refused("review -o snapshots/a.snap.new");
    // Standard output is one more file that is written.
    let words = "exhaust lines --reach 2 --checkpoint out.json";
    let out = File::create(folder.join("out.json")).unwrap();
    let run = Run::of(folder.command(words).stdout(out));
    run.has(USAGE).says("standard output");
    // A device is no file that is lost.
    folder.run("exhaust lines --reach 2 -o null").has(AGREES);
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn names_need_not_be_utf8() {
    let folder = folder("names");
    let name = |bytes: &[u8]| folder.join(OsStr::from_bytes(bytes));
    let run = |words: &str, paths: &[&Path]| Run::of(folder.command(words).args(paths));
    let is_only = |path: &Path| {
        assert!(path.exists());
        let names = fs::read_dir(&*folder).unwrap();
        let names: Vec<_> = names.map(|entry| entry.unwrap().file_name()).collect();
        assert!(
            !names.iter().any(|name| name.to_string_lossy().ends_with('\u{fffd}')),
            "{names:?}"
        );
    };
    let (zero, one) = (name(b"\xff0.json"), name(b"\xff1.json"));
    run("exhaust lines --reach 2 --shard 0/2 -o", &[&zero]).has(AGREES);
    run("exhaust lines --reach 2 --shard 1/2 -o", &[&one]).has(AGREES);
    run("merge", &[&zero, &one]).has(AGREES).prints("\"claim\"");
    let checkpoint = name(b"\xffcheck");
    run("exhaust lines --reach 2 -o null --checkpoint", &[&checkpoint]).has(AGREES);
    let model = name(b"\xff.obj");
    fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let picture = name(b"\xff.png");
    run("render --size 16x16", &[&model, Path::new("-o"), &picture]).has(AGREES);
    is_only(&picture);
    run("inspect T2 -o", &[&picture]).has(AGREES);
    run("specimens --cases 1 -o", &[&picture]).has(AGREES);
    let answers = name(b"\xff.txt");
    fs::write(&answers, "\n\n").unwrap();
    run("quiz 2 --answers", &[&answers]).has(DISAGREES);
    let costs = name(b"\xff.cost");
    fs::write(&costs, folder.run("cost coverage --quick --json").has(AGREES).out).unwrap();
    run("cost --from", &[&costs]).has(AGREES);
    let baseline = name(b"\xff.known");
    let mut judge = folder.command("judge --cases 5 --family fan --update-baseline --baseline");
    Run::of(judge.arg(&baseline).args(["--", PROGRAM, "engine", "scanline"])).has(AGREES);
    is_only(&baseline);
    // A folder of pages, and the pages of course.
    let pages = name(b"\xffpages");
    run("--cases 10 --report --out", &[&pages]).has(AGREES);
    is_only(&pages.join("verify.html"));
    run("course start --language python", &[&name(b"\xffmine")]).has(AGREES);
    // Where text is expected, the word is named.
    run("--family", &[Path::new(OsStr::from_bytes(b"f\xffn"))]).has(USAGE).says("not UTF-8: f");
}

/// A process that is killed while it writes leaves what it has written so far, beside the old file; the next one that writes there
/// removes it.
#[test]
fn what_a_killed_process_left_is_removed() {
    let folder = folder("killed");
    folder.put("a.png", "old");
    // The system kills a process whose file grows beyond the limit, which is 512 bytes here.
    let words = format!("ulimit -f 1; exec '{PROGRAM}' inspect T2 -o a.png --out .");
    let mut shell = std::process::Command::new("sh");
    let killed = shell.args(["-c", &words]).current_dir(&*folder).output().unwrap();
    assert_eq!(killed.status.code(), None, "{killed:?}");
    assert_eq!(folder.text("a.png"), "old");
    let parts = || {
        let names = fs::read_dir(&*folder).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.ends_with(".part")).count()
    };
    assert_eq!(parts(), 1);
    folder.run("inspect T2 -o a.png --out .").has(AGREES);
    assert_eq!(parts(), 0);
    assert!(fs::metadata(folder.join("a.png")).unwrap().len() > 512);
}
