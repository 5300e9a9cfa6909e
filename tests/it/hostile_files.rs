//! Every option that reads a file, with files that are none: each ends at once, with a message that
//! names the file, and nothing in a file reaches the terminal as a command to it.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use rasterproof::cli::exit::{AGREES, DISAGREES, USAGE};

use crate::pages::{files, read, root};
use crate::program::{Folder, PROGRAM, Run};

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

struct Reader {
    name: &'static str,
    /// The command; `{}` is the file.
    words: &'static str,
    file: &'static str,
    /// The beginning of a right file.
    truncated: &'static [u8],
    /// Other files that the command needs.
    beside: &'static [(&'static str, &'static str)],
    /// Statuses other than [`USAGE`] that are right, and for which files.
    or: &'static [(u8, &'static [Hostile])],
}

const MODEL: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0";

const READER: Reader =
    Reader { name: "", words: "", file: "", truncated: b"", beside: &[], or: &[] };

/// Readers from a table: the option, the command, the file, its beginning, and what is special about it.
macro_rules! readers {
    ($($name:literal, $words:literal, $file:literal, $truncated:expr $(, $more:ident: $value:expr)*;)*) => {
        [$(Reader {
            name: $name, words: $words, file: $file, truncated: $truncated, $($more: $value,)* ..READER
        }),*]
    };
}

#[allow(clippy::needless_update, reason = "some of them state every field")]
const READERS: [Reader; 18] = readers![
    "render MODEL", "render --size 16x16 {}", "x.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2";
    "plan MODEL", "plan --size 16x16 --rounds 1 {}", "x.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2";
    // A model without its materials is drawn grey, and one without a texture in its colour, with a warning.
    "materials of a model", "render --size 16x16 model.obj", "m.mtl", b"newmtl a\nKd 1 0",
        beside: &[("model.obj", MODEL)], or: &[(AGREES, &ALL)];
    "texture of a model", "render --size 16x16 model.obj", "t.png", PNG,
        beside: &[("model.obj", MODEL), ("m.mtl", "newmtl a\nKd 1 0 0\nmap_Kd t.png\n")], or: &[(AGREES, &ALL)];
    "render --plan", "render cube --size 16x16 --plan {}", "p.json", b"{\"plan\": {";
    "merge", "merge {}", "c.json", b"{\"rasterproof\": \"0";
    "cost --from", "cost --from {}", "c.json", b"{\"version\": \"";
    // A checkpoint that is not there is a run that begins.
    "exhaust --checkpoint", "exhaust lines --reach 2 --checkpoint {}", "c.json", b"{\"identity\": {",
        or: &[(AGREES, &[Hostile::Missing])];
    "quiz --answers", "quiz 2 --answers {}", "a.txt", b"1\n\xe4\xb8";
    "playground --module", "playground --module {}", "m.wasm", b"\0asm\x01\0\0\0\x01\x07";
    "your-gpu --module", "your-gpu --module {}", "m.wasm", b"\0asm\x01\0\0\0\x01\x07";
    // A baseline that is not there knows no failure.
    "judge --baseline", "judge --cases 2 --family fan --baseline {} -- PROGRAM engine scanline", "b.txt", b"# rasterproof baseline 1, se",
        or: &[(AGREES, &[Hostile::Missing])];
    "judge --league", "judge --league", "adapters/league.json", b"[{\"name\":";
    // What cannot be shown waits for review all the same.
    "review, new text", "review", "snapshots/x.snap.new", b"---\nsource: a",
        or: &[(DISAGREES, &ALL), (AGREES, &ALL)];
    "review, old text", "review", "snapshots/x.snap", b"---\nsource: a",
        beside: &[("snapshots/x.snap.new", "---\nsource: a.rs\n---\nnew\n")], or: &[(DISAGREES, &ALL)];
    "review, new picture", "review", "snapshots/x.snap.new.png", PNG,
        beside: &[("snapshots/x.snap.new", "---\nsource: a.rs\nextension: png\nsnapshot_kind: binary\n---\n")], or: &[(DISAGREES, &ALL)];
    // What is not a page is not listed.
    "pages beside --report", "--cases 2 --report --out out", "out/x.html", b"<html><ti",
        or: &[(AGREES, &ALL)];
    "index of --report", "--cases 2 --report --out out", "out/index.html", b"<html><ti",
        or: &[(AGREES, &ALL)];
];

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
    let file = if is_free { format!("\x1b[31m{}", reader.file) } else { reader.file.to_owned() };
    let path = folder.join(&file);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    for (name, text) in reader.beside {
        fs::write(folder.join(name), text).unwrap();
    }
    put(hostile, &path, reader.truncated);
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
    let is_known =
        |&(code, files): &(u8, &[Hostile])| status == Some(code.into()) && files.contains(&hostile);
    if status != Some(USAGE.into()) && !reader.or.iter().any(is_known) {
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
    for reader in &READERS {
        for hostile in ALL {
            let result = check(reader, hostile);
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
