//! `review` of folders that hold anything: bounded work, commands that are safe to copy, and results
//! that are printed whether the page can be written or not.

use std::path::Path;

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
