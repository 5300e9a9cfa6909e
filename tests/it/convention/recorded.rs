//! What libraries answered to the questions of a diagnosis (`tests/data/wild`), and the tool that
//! records it.

use std::collections::HashMap;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_verify::convention::{LineQuestion, TriangleQuestion};

/// A question in words, as recordings keep it: the side of the window, then the corners in 1/256 px.
fn key(question: &TriangleQuestion) -> String {
    let corners = question.corners.map(|c| format!(" {} {}", c.x, c.y));
    format!("T {}{}", question.window.x1, corners.concat())
}

/// The same of a line: the ends in pixels.
fn line_key(question: &LineQuestion) -> String {
    let [[x0, y0], [x1, y1]] = question.ends;
    format!("L {} {x0} {y0} {x1} {y1}", question.window.x1)
}

/// Pixels, or None for a refusal.
fn pixels(answer: &str) -> Option<Vec<[i32; 2]>> {
    let numbers: Option<Vec<i32>> = answer.split_whitespace().map(|w| w.parse().ok()).collect();
    Some(numbers?.chunks_exact(2).map(|p| [p[0], p[1]]).collect())
}

/// Runs of equal hits, or None for a refusal.
fn picture(window: PixelRect, answer: &str) -> Option<Coverage> {
    let mut coverage = Coverage::new(window, 0);
    if answer == "E" {
        return None;
    }
    let numbers: Vec<i32> = answer.split_whitespace().map(|w| w.parse().unwrap()).collect();
    for run in numbers.chunks_exact(3) {
        coverage.hit(run[0], run[1], run[2]);
    }
    Some(coverage)
}

pub struct Recording(HashMap<String, String>);

impl Recording {
    pub fn read(name: &str) -> Self {
        let path = format!("{}/tests/data/wild/{name}.txt.gz", env!("CARGO_MANIFEST_DIR"));
        let file = std::fs::File::open(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        let mut text = String::new();
        GzDecoder::new(file).read_to_string(&mut text).unwrap();
        let pairs = text.lines().filter(|line| !line.starts_with('#')).map(|line| {
            let (question, answer) = line.split_once(" | ").unwrap();
            (question.to_owned(), answer.to_owned())
        });
        Self(pairs.collect())
    }

    fn get(&self, key: &str) -> &str {
        self.0.get(key).unwrap_or_else(|| panic!("not recorded, so record again: {key}"))
    }

    pub fn triangle(&self, question: &TriangleQuestion) -> Option<Coverage> {
        picture(question.window, self.get(&key(question)))
    }

    pub fn line(&self, question: &LineQuestion) -> Option<Vec<[i32; 2]>> {
        pixels(self.get(&line_key(question)))
    }
}

/// A program behind a pipe, whose answers are kept.
pub struct Recorder {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    pub words: Vec<String>,
    kept: Vec<String>,
}

impl Recorder {
    pub fn start(command: &str) -> Self {
        let mut words = command.split_whitespace();
        let mut child = Command::new(words.next().unwrap())
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (mut requests, answers) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut answers = BufReader::new(answers);
        writeln!(requests, "HELLO 1").unwrap();
        let mut line = String::new();
        while !line.starts_with("HELLO") {
            line.clear();
            assert!(answers.read_line(&mut line).unwrap() > 0, "{command} ended");
        }
        let words = line.split_whitespace().skip(2).map(str::to_owned).collect();
        Self { child, requests, answers, words, kept: Vec::new() }
    }

    /// The answer to one request, without its verb, id and count; `E` for a refusal.
    fn answer(&mut self, request: &str) -> String {
        writeln!(self.requests, "{request}").unwrap();
        let mut line = String::new();
        assert!(self.answers.read_line(&mut line).unwrap() > 0, "ended on {request}");
        let words: Vec<_> = line.split_whitespace().collect();
        if words[0] == "E" { "E".to_owned() } else { words[3..].join(" ") }
    }

    pub fn triangle(&mut self, q: &TriangleQuestion) -> Option<Coverage> {
        let px = |v: i32| f64::from(v) / 256.0;
        let at = q.corners.map(|c| format!(" {} {}", px(c.x), px(c.y))).concat();
        let answer = self.answer(&format!("T 0 {0} {0}{at}", q.window.x1));
        self.kept.push(format!("{} | {answer}", key(q)));
        picture(q.window, &answer)
    }

    pub fn line(&mut self, q: &LineQuestion) -> Option<Vec<[i32; 2]>> {
        let [[x0, y0], [x1, y1]] = q.ends;
        let answer = self.answer(&format!("L 0 {0} {0} {x0} {y0} {x1} {y1}", q.window.x1));
        self.kept.push(format!("{} | {answer}", line_key(q)));
        pixels(&answer)
    }

    /// Writes what was asked and answered, ends the program.
    pub fn write(mut self, path: &Path) {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        let file = std::fs::File::create(path).unwrap();
        let mut out = BufWriter::new(GzEncoder::new(file, flate2::Compression::best()));
        writeln!(out, "# {}", self.words[0]).unwrap();
        self.kept.iter().for_each(|line| writeln!(out, "{line}").unwrap());
        out.into_inner().unwrap().finish().unwrap();
        drop(self.requests);
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}
