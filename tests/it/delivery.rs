//! What becomes of a result that nobody reads, and of a process that is killed. The exit status stays that of the verdict, and nothing
//! that was computed is lost. Disks that are full are in `tests/transcripts/full-disk.md`.
#![cfg(unix)]

use std::fs;

use rasterproof::cli::exit::{AGREES, DISAGREES};

use crate::program::{Folder, PROGRAM, Run, table};

/// A pipe that nobody reads.
fn unread() -> std::io::PipeWriter {
    std::io::pipe().unwrap().1
}

impl Folder {
    fn run_unread(&self, words: &str) -> Run {
        Run::of(self.command(words).stdout(unread()))
    }
}

/// Nobody reads standard output, or standard error, which is where `exhaust` says its verdict.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn the_status_does_not_depend_on_a_reader() {
    let folder = Folder::new("delivery-reader");
    for [words, status] in table("verdicts") {
        let status = status.parse().unwrap();
        folder.run(&words).has(status);
        folder.run_unread(&words).has(status);
        Run::of(folder.command(words).stderr(unread())).has(status);
    }
}

#[test]
fn a_checkpoint_is_kept_until_its_result_is_delivered() {
    let folder = Folder::new("delivery-checkpoint");
    let exhaust = "exhaust lines --reach 3 --checkpoint c.json";
    let planted = "exhaust triangles --window 1 --subpixel-bits 1 --plant inclusive-edges \
                   --checkpoint c.json";
    for (words, status) in [(exhaust, AGREES), (planted, DISAGREES)] {
        folder.run_unread(words).has(status).says("the result is kept in c.json");
        assert!(folder.join("c.json").exists());
        // The kept state is complete: it is delivered now, and removed.
        folder.run(words).has(status).prints("\"claim\"");
        assert!(!folder.join("c.json").exists());
    }
}

/// A process that is killed while it writes leaves what it has written so far, beside the old file; the next one that writes there
/// removes it.
#[test]
fn what_a_killed_process_left_is_removed() {
    let folder = Folder::new("delivery-killed");
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
