//! `review` of folders that hold anything: bounded work, commands that are safe to copy, and results
//! that are printed whether the page can be written or not.

use std::path::Path;
use std::process::Command;

use crate::page_commands::words_of;
use crate::program::{Folder, Run};

/// An empty folder with a folder `snapshots`.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("review-{name}"));
    std::fs::create_dir(folder.join("snapshots")).unwrap();
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join("snapshots").join(name), text).unwrap();
}

#[test]
fn names_are_quoted_in_commands_and_made_printable() {
    let folder = folder("quoted");
    let name = "a'; touch PWNED; '\u{1b}[31m\u{202e}\nb.snap";
    let source = "tests/it; touch PWNED/x$(touch PWNED).rs";
    write(&folder, &format!("{name}.new"), &format!("---\nsource: \"{source}\"\n---\nnew\n"));
    let Run { out, errors, .. } = folder.run("review").has(1);
    assert!(!out.contains(['\u{1b}', '\u{202e}']) && !errors.contains(['\u{1b}', '\u{202e}']));
    assert!(out.contains(r"snapshots/a'; touch PWNED; '\u{1b}[31m\u{202e}\nb.snap: a new text"));
    let after = |label: &str| out.lines().find_map(|line| line.split_once(label)).unwrap().1;
    let accept = words_of(after("accept: "));
    assert_eq!(accept[..4], ["cargo", "insta", "accept", "--snapshot"]);
    assert_eq!(accept[4], format!("snapshots/{name}"));
    let update = words_of(after("without cargo-insta: "));
    let expected = ["INSTA_UPDATE=always", "cargo", "test", "--test", "it; touch PWNED"];
    assert_eq!(
        (&update[..5], &*update[5]),
        (&expected.map(str::to_owned)[..], "x$(touch PWNED)::")
    );
    assert!(!folder.join("PWNED").exists() && !Path::new("PWNED").exists());
    let page = std::fs::read_to_string(folder.join("target/rasterproof/review.html")).unwrap();
    assert!(!page.contains(['\u{1b}', '\u{202e}']));
}

/// Whatever lies in the folder, a review says what it is.
#[test]
fn one_file_that_cannot_be_read_does_not_stop_the_review() {
    let folder = folder("kinds");
    let (text, deep, long) = ("---\n---\nnew\n", "d/".repeat(60), "x\n".repeat(200_000));
    let binary = "---\nsource: tests/a.rs\nextension: png\nsnapshot_kind: binary\n---\n";
    for path in ["folder.snap", &deep] {
        std::fs::create_dir_all(folder.join("snapshots").join(path)).unwrap();
    }
    for (name, text) in [
        ("folder", text),
        ("good", text),
        (&format!("{deep}deep"), text),
        ("climbs", "---\nextension: /../../x\nsnapshot_kind: binary\n---\n"),
        ("gone", binary),
        ("broken", binary),
        ("<b>", "---\r\nsource: tests/a/b.rs\r\n---\r\nis\r\n"),
        ("bare", "no head at all"),
        ("empty", ""),
        ("long", &long),
    ] {
        write(&folder, &format!("{name}.snap.new"), text);
    }
    folder.put("snapshots/broken.snap.new.png", b"\x89PNG\r\n\x1a\nnothing");
    folder.put("snapshots/<b>.snap", b"---\nsource: tests/a/b.rs\n---\nwas\n\xff\n");
    let mut expected = vec![
        "folder.snap: cannot be shown: snapshots/folder.snap: is a directory, not a file",
        "good.snap: a new text",
        "d/deep.snap: a new text",
        "climbs.snap: the ending /../../x of its file is no ending",
        "gone.snap: the new file X.snap.new.png is missing",
        "broken.snap: no readable PNG: ",
        "<b>.snap: a changed text",
        "bare.snap: a new text",
        "empty.snap: a new text",
        "long.snap: a text of 400000 bytes, too long to show",
        "cargo test --test a b::",
        "changed snapshots wait for review",
    ];
    #[cfg(unix)]
    {
        let pipe = folder.join("snapshots/pipe.snap.new");
        assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
        std::os::unix::fs::symlink("/dev/zero", folder.join("snapshots/zero.snap.new")).unwrap();
        let large = std::fs::File::create(folder.join("snapshots/large.snap.new")).unwrap();
        large.set_len(5_000_000_000).unwrap();
        expected.extend(["pipe.snap.new: is a pipe", "zero.snap.new: is a device"]);
        expected.extend(["large.snap.new: is too large: at most 64 MiB are read", "13 changed"]);
    }
    let out = folder.check("review", 1).out;
    // Long lines are broken.
    let flat = out.split_whitespace().collect::<Vec<_>>().join(" ");
    for line in expected {
        assert!(flat.contains(line), "{line}: {out}");
    }
    let page = folder.text("target/rasterproof/review.html");
    assert!(page.contains("<pre>was</pre>") && page.contains("<pre>is</pre>"));
    assert!(page.contains("&lt;b&gt;.snap") && !page.contains("<b>.snap"));
    folder.check("review nowhere", 2).says("cannot read nowhere");
    Run::of(folder.command("review").current_dir(folder.join("target")))
        .has(2)
        .says("name the folder");
}

#[test]
fn many_snapshots_are_counted_and_the_first_are_shown() {
    let folder = folder("many");
    for i in 0..2000 {
        write(&folder, &format!("{i:04}-{}.snap.new", "x".repeat(150)), "---\n---\nnew\n");
    }
    folder
        .run("review")
        .has(1)
        .prints("2000 changed snapshots wait for review in snapshots.")
        .prints("1500 more are not looked into: accept or reject the 500 listed");
    let page = std::fs::read_to_string(folder.join("target/rasterproof/review.html")).unwrap();
    assert!(page.len() < 2_000_000 && page.contains("1,500 more are not looked into"));
}
