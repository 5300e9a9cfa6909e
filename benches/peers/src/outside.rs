//! Renderers that are not Rust: programs that draw and time themselves, asked line by line.
//!
//! `fills.py` fills triangles by Skia and Blend2D, `gles.c` draws frames by whatever implements
//! OpenGL ES. What cannot be started is named with the reason.

use std::fmt::Write as _;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write as _};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use rasterproof_core::grid::PixelRect;
use serde::Serialize;

use crate::common::Scene;
use crate::filler::Filler;

/// Where `run` puts what it installs and builds.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/peers")
}

/// A renderer that does not run on this machine.
#[derive(Serialize)]
pub struct Missing {
    pub name: String,
    pub why: String,
}

/// A program that answers each line, ended with the value.
pub struct Process {
    name: String,
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Process {
    /// Starts a program, whose first line is `ready` and its version, or the reason why it is not.
    pub fn start(name: &str, command: &mut Command) -> Result<(Self, String), Missing> {
        let missing = |why: String| Missing { name: name.to_owned(), why };
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| {
                missing(format!("{}: {error}", command.get_program().to_string_lossy()))
            })?;
        let input = child.stdin.take().expect("it is piped");
        let output = BufReader::new(child.stdout.take().expect("it is piped"));
        let mut process = Self { name: name.to_owned(), child, input, output };
        let mut line = String::new();
        // A program that ends says nothing.
        process.output.read_line(&mut line).map_err(|error| missing(error.to_string()))?;
        match line.trim().strip_prefix("ready ") {
            Some(version) => Ok((process, version.to_owned())),
            None if line.is_empty() => Err(missing(
                "its program is not there or fails; benches/peers/run says more".to_owned(),
            )),
            None => Err(missing(line.trim().to_owned())),
        }
    }

    fn bytes(&mut self, question: &str, bytes: usize) -> Vec<u8> {
        let mut answer = vec![0; bytes];
        let asked = writeln!(self.input, "{question}").and_then(|()| self.input.flush());
        asked
            .and_then(|()| self.output.read_exact(&mut answer))
            .unwrap_or_else(|error| panic!("{}: {question}: {error}", self.name));
        answer
    }

    fn number(&mut self, question: &str) -> f64 {
        let mut line = String::new();
        let asked = writeln!(self.input, "{question}").and_then(|()| self.input.flush());
        asked
            .and_then(|()| self.output.read_line(&mut line))
            .unwrap_or_else(|error| panic!("{}: {question}: {error}", self.name));
        line.trim()
            .parse()
            .unwrap_or_else(|_| panic!("{}: {question}: answered {line:?}", self.name))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It has ended already where this fails.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The programs that fill triangles, each with its name and whether it antialiases.
pub struct Children {
    processes: Vec<(String, bool, Process)>,
}

impl Children {
    /// Starts those that are there; the others are named.
    pub fn start(
        scenes: &[Scene],
        versions: &mut Vec<String>,
        missing: &mut Vec<Missing>,
    ) -> std::io::Result<Self> {
        let file = folder().join("classes.json");
        fs::create_dir_all(folder())?;
        fs::write(&file, classes(scenes))?;
        let python = folder().join("venv/bin/python3");
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("fills.py");
        let mut processes = Vec::new();
        for (name, smooth) in [("Skia", false), ("Skia", true), ("Blend2D", true)] {
            let quality = if smooth { "smooth" } else { "centres" };
            let mut command = Command::new(&python);
            command.arg(&script).arg(name).arg(quality).arg(&file);
            match Process::start(name, &mut command) {
                Ok((process, version)) => {
                    versions.push(version);
                    processes.push((name.to_owned(), smooth, process));
                }
                Err(why) => missing.push(why),
            }
        }
        versions.dedup();
        Ok(Self { processes })
    }

    pub fn fillers<'a>(&'a mut self, scene: &'a Scene) -> Vec<(String, bool, Fills<'a>)> {
        let all = self.processes.iter_mut();
        all.map(|(name, smooth, process)| {
            let mut fills = Fills { process, class: scene.name };
            // The triangles of the class before.
            fills.left();
            (name.clone(), *smooth, fills)
        })
        .collect()
    }
}

/// Corners in pixels by the names of classes, as JSON: multiples of 1/256 have few digits.
fn classes(scenes: &[Scene]) -> String {
    let mut text = String::from("{");
    for (i, scene) in scenes.iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        let triangles: Vec<Vec<_>> = scene
            .triangles
            .iter()
            .map(|corners| {
                corners.iter().flat_map(|corner| <[f64; 2]>::from(corner.to_px())).collect()
            })
            .collect();
        write!(text, "{comma}{:?}:{triangles:?}", scene.name).expect("text has room");
    }
    text + "}"
}

pub struct Fills<'a> {
    process: &'a mut Process,
    class: &'static str,
}

impl Filler for Fills<'_> {
    fn time_ns(&mut self, part: Range<usize>) -> f64 {
        self.process.number(&format!("fill {} {} {}", self.class, part.start, part.end))
    }

    fn take(&mut self, triangle: usize, rect: PixelRect) -> Vec<u8> {
        let PixelRect { x0, y0, x1, y1 } = rect;
        let question = format!("take {} {triangle} {x0} {y0} {x1} {y1}", self.class);
        self.process.bytes(&question, ((x1 - x0) * (y1 - y0)) as usize)
    }

    fn left(&mut self) -> u64 {
        self.process.number("left") as u64
    }
}

impl Process {
    /// Draws frames, of which the last is timed.
    pub fn frame_ms(&mut self, frames: usize) -> f64 {
        self.number(&format!("frame {frames}")) / 1e6
    }

    /// The last frame, row by row from the top.
    pub fn picture(&mut self, side_px: u32) -> Vec<u8> {
        self.bytes("look", 4 * (side_px * side_px) as usize)
    }
}
