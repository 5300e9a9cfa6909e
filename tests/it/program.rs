//! The program as a user runs it: in a folder of its own, with its exit status and all that it printed.

use std::ffi::OsStr;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use image::{DynamicImage, ImageFormat};
use serde_json::Value;

pub const PROGRAM: &str = env!("CARGO_BIN_EXE_rasterproof");

/// The words of a command: a text that is split at blanks, or a list of words that may hold blanks.
pub trait Words {
    fn add_to(&self, command: &mut Command);
}

impl Words for str {
    fn add_to(&self, command: &mut Command) {
        command.args(self.split_whitespace());
    }
}

impl Words for String {
    fn add_to(&self, command: &mut Command) {
        self.as_str().add_to(command);
    }
}

impl<T: AsRef<OsStr>, const N: usize> Words for [T; N] {
    fn add_to(&self, command: &mut Command) {
        command.args(self);
    }
}

impl<T: AsRef<OsStr>> Words for Vec<T> {
    fn add_to(&self, command: &mut Command) {
        command.args(self);
    }
}

impl<T: AsRef<OsStr>> Words for [T] {
    fn add_to(&self, command: &mut Command) {
        command.args(self);
    }
}

impl<W: Words + ?Sized> Words for &W {
    fn add_to(&self, command: &mut Command) {
        (**self).add_to(command);
    }
}

/// An empty folder below the build's temporary folder, removed with what is in it unless its test fails.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    /// Writes a file; its path.
    pub fn put(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    #[track_caller]
    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn command(&self, words: impl Words) -> Command {
        let mut command = Command::new(PROGRAM);
        words.add_to(&mut command);
        command.current_dir(&self.0).stdin(Stdio::null()).env_remove("COLUMNS");
        command
    }

    pub fn run(&self, words: impl Words) -> Run {
        Run::of(&mut self.command(words))
    }

    /// With a file of these bytes as standard input.
    pub fn run_on(&self, input: impl AsRef<[u8]>, words: impl Words) -> Run {
        // Tests of several threads share a folder.
        let file = self.put(&format!("input-{:?}", std::thread::current().id()), input);
        Run::of(self.command(words).stdin(std::fs::File::open(file).unwrap()))
    }

    #[track_caller]
    pub fn check(&self, words: impl Words, status: u8) -> Run {
        self.run(words).has(status)
    }
}

impl Deref for Folder {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }
}

/// Runs the program in a folder that several tests share, and asserts its status.
#[track_caller]
pub fn check(words: impl Words, status: u8) -> Run {
    shared().check(words, status)
}

/// A folder for tests that only write pictures and pages beside what they are about.
pub fn shared() -> &'static Folder {
    static SHARED: std::sync::LazyLock<Folder> = std::sync::LazyLock::new(|| Folder::new("shared"));
    &SHARED
}

/// The rows of a table in `tests/data/tables`, a line each with its cells between bars. `#` begins a remark.
pub fn table<const N: usize>(name: &str) -> Vec<[String; N]> {
    let path = format!("{}/tests/data/tables/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let row = |line: &str| -> [String; N] {
        let cells: Vec<String> = line.split('|').map(|cell| cell.trim().to_owned()).collect();
        cells.try_into().unwrap_or_else(|cells| panic!("{path}: not {N} cells: {cells:?}"))
    };
    text.lines().filter(|line| !line.starts_with('#')).map(row).collect()
}

/// Whether a compiler or an interpreter is installed.
pub fn has(tool: &str) -> bool {
    Command::new(tool).arg("--version").output().is_ok_and(|said| said.status.success())
}

/// The step through a long list: each of its items is tried where `.ci/run --all` asks for that, which it does every night,
/// and otherwise every `step`-th.
pub fn every(step: usize) -> usize {
    if std::env::var_os("RASTERPROOF_ALL").is_some() { 1 } else { step }
}

/// The bytes of a file with this picture; none where the format has no such pixels. It is written to a file, because
/// encoders for a writer in memory would be compiled with the tests: 100,000 lines of LLVM code.
pub fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Option<Vec<u8>> {
    let folder = Folder::new(&format!("picture-{:?}", std::thread::current().id()));
    let path = folder.join("picture");
    picture.into().save_with_format(&path, format).ok()?;
    Some(std::fs::read(path).unwrap())
}

#[derive(Debug)]
pub struct Run {
    command: String,
    pub status: Option<i32>,
    pub out: String,
    pub errors: String,
}

impl Run {
    pub fn of(command: &mut Command) -> Self {
        let Output { status, stdout, stderr } = command.output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        let (out, errors) = (text(stdout), text(stderr));
        Self { command: format!("{command:?}"), status: status.code(), out, errors }
    }

    #[track_caller]
    pub fn has(self, status: u8) -> Self {
        let is_right = self.status == Some(status.into()) && !self.errors.contains("panicked");
        assert!(is_right, "expected status {status}: {self}");
        self
    }

    #[track_caller]
    pub fn without_output(self) -> Self {
        assert!(self.out.is_empty(), "expected nothing on standard output: {self}");
        self
    }

    #[track_caller]
    pub fn without_errors(self) -> Self {
        assert!(self.errors.is_empty(), "expected nothing on standard error: {self}");
        self
    }

    #[track_caller]
    pub fn says(self, part: &str) -> Self {
        assert!(self.errors.contains(part), "expected the error '{part}': {self}");
        self
    }

    #[track_caller]
    pub fn prints(self, part: &str) -> Self {
        assert!(self.out.contains(part), "expected '{part}': {self}");
        self
    }

    /// On either stream.
    #[track_caller]
    pub fn shows(self, part: &str) -> Self {
        let is_shown = self.out.contains(part) || self.errors.contains(part);
        assert!(is_shown, "expected '{part}': {self}");
        self
    }

    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {self}"))
    }

    #[track_caller]
    pub fn omits(self, part: &str) -> Self {
        assert!(!self.out.contains(part), "expected no '{part}': {self}");
        self
    }
}

impl std::fmt::Display for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { command, status, out, errors } = self;
        write!(f, "{command}\n{status:?}\n{out}\n{errors}")
    }
}
