//! Every option that reads a file, with files that are none: each ends at once, with a message that
//! names the file, and nothing in a file reaches the terminal as a command to it.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use rasterproof::cli::exit::USAGE;

use crate::pages::{files, read, root};
use crate::program::{Folder, PROGRAM, Run, table};

/// All that is read here is refused in milliseconds; what waits would wait for ever, and is ended after so many seconds
/// with a status of its own.
const PATIENCE_S: u64 = 120;
/// Kibibytes of addresses: what reads a device to its end is stopped by this.
const MEMORY_KIB: u64 = 8 << 20;

/// What is put in the place of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hostile {
    Pipe,
    Device,
    Directory,
    FiveGigabytes,
    ControlCharacters,
    Truncated,
    Missing,
}

const ALL: [Hostile; 7] = {
    use Hostile::{ControlCharacters, Device, Directory, FiveGigabytes, Missing, Pipe, Truncated};
    [Pipe, Device, Directory, FiveGigabytes, ControlCharacters, Truncated, Missing]
};

/// A row of the table of options that read a file.
struct Reader {
    name: String,
    /// The command; `{}` is the file.
    words: String,
    file: String,
    /// Other files that the command needs, `NAME=TEXT`.
    beside: String,
    /// Statuses other than [`USAGE`] that are right, and for which files: `0 all; 1 Missing`.
    others: String,
}

impl Reader {
    /// Whether the command may end so with such a file.
    fn may_end(&self, status: Option<i32>, hostile: Hostile) -> bool {
        let is_one = |other: &str| {
            let (code, files) = other.split_once(' ').unwrap();
            status == code.parse().ok() && (files == "all" || files == format!("{hostile:?}"))
        };
        status == Some(USAGE.into())
            || self.others.split("; ").any(|other| !other.is_empty() && is_one(other))
    }
}

fn put(hostile: Hostile, path: &Path, truncated: &[u8]) {
    match hostile {
        Hostile::Pipe => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
        Hostile::Device => symlink("/dev/zero", path).unwrap(),
        Hostile::Directory => fs::create_dir(path).unwrap(),
        // Sparse: it takes no space on the disk.
        Hostile::FiveGigabytes => File::create(path).unwrap().set_len(5_000_000_000).unwrap(),
        Hostile::ControlCharacters => {
            let text = "\x1b[31m{\"a\x1b[32m\": \x1b[31m\nusemtl \x1b[31m\nf \x1b[31m 2 3\n";
            fs::write(path, text).unwrap();
        }
        Hostile::Truncated => fs::write(path, truncated).unwrap(),
        Hostile::Missing => {}
    }
}

/// Runs a command with a hostile file; says what is wrong with how it ended.
fn check(reader: &Reader, hostile: Hostile) -> Result<(), String> {
    let name = format!("hostile-{}-{hostile:?}", reader.name);
    let folder = Folder::new(&name.replace([' ', ','], "_"));
    // A name with control characters, where the name is free.
    let is_free = reader.words.contains("{}") && hostile == Hostile::ControlCharacters;
    let file = if is_free { format!("\x1b[31m{}", reader.file) } else { reader.file.clone() };
    let path = folder.join(&file);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    for (name, text) in reader.beside.split("; ").filter_map(|file| file.split_once('=')) {
        fs::write(folder.join(name), text.replace("\\n", "\n")).unwrap();
    }
    let beginning = reader.name.replace(' ', "-").replace(',', "");
    let beginning = fs::read(root().join("tests/data/hostile-files").join(beginning)).unwrap();
    put(hostile, &path, &beginning);
    let words = reader.words.split(' ').map(|word| match word {
        "{}" => &file,
        "PROGRAM" => PROGRAM,
        word => word,
    });
    let start = Instant::now();
    let limits = format!("ulimit -v {MEMORY_KIB}; exec timeout {PATIENCE_S} \"$0\" \"$@\"");
    let mut shell = Command::new("sh");
    shell.args(["-c", &limits, PROGRAM]).args(words).current_dir(&folder).stdin(Stdio::null());
    let Run { status, out, errors, .. } = Run::of(&mut shell);
    // With `--nocapture` the test prints a table of all files.
    let message = errors.lines().next().unwrap_or_default();
    println!("{} | {hostile:?} | {} ms | {message}", reader.name, start.elapsed().as_millis());
    let wrong = |what: &str| Err(format!("{what}: status {status:?}\n{out}\n{errors}"));
    if !reader.may_end(status, hostile) {
        return wrong("another status");
    }
    if errors.contains("panicked") || errors.contains("allocation") {
        return wrong("a panic");
    }
    if errors.contains('\x1b') || out.contains('\x1b') {
        return wrong("a control character");
    }
    let lines = errors.lines().count();
    let shown = reader.file.rsplit('/').next().unwrap_or_default();
    if status == Some(USAGE.into()) && !(errors.contains(shown) && (1..=2).contains(&lines)) {
        return wrong("a message that does not name the file in two lines");
    }
    Ok(())
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn every_option_that_reads_a_file_refuses_what_is_none() {
    let mut wrong = Vec::new();
    for [name, words, file, beside, others] in table("hostile-files") {
        let reader = Reader { name, words, file, beside, others };
        for hostile in ALL {
            let result = check(&reader, hostile);
            wrong.extend(result.err().map(|what| format!("{}, {hostile:?}: {what}", reader.name)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// `clippy.toml` refuses the standard library's functions for files. The lint may be switched off in
/// the one crate that calls them, and in tests.
#[test]
fn only_one_crate_opens_and_writes_files() {
    let crates = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let folders = crates.filter(|folder| !folder.ends_with("host")).chain([root().to_owned()]);
    let files: Vec<_> = folders.flat_map(|folder| files(&folder.join("src"), ".rs")).collect();
    for path in &files {
        // The tests of a file are its last part.
        let text = read(path);
        let code = text.split("\n#[cfg(test)]\n").next().unwrap_or_default();
        assert!(!code.contains("disallowed_methods"), "{}", path.display());
    }
    assert!(files.len() > 100, "{}", files.len());
    let lint = read("clippy.toml");
    for function in ["read", "read_to_string", "write", "rename", "File::open", "File::create"] {
        assert!(lint.contains(&format!("\"std::fs::{function}\"")), "{function}");
    }
}
