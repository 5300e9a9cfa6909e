//! Questions and answers as values, and who answers them: anybody behind [`Subject`].
//!
//! A child process and an engine of the registry are asked alike, so that one judge serves both and
//! the tests can compare them.

use std::fmt;
use std::io::Write as _;
use std::iter;
use std::time::{Duration, Instant};

use glam::DVec2;

use super::declared::Declared;
use super::text::{Words, printable, px};
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::{Corners, Fragment, PixelPoint, Span, WideLine};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::oracle::formula::Formula;
use rasterproof_verify::partition::{self, Polygon};

/// A request: what is asked, and the window whose pixels the answer may have. Windows of the protocol begin at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    pub width: u32,
    pub height: u32,
    pub of: Asked,
}

/// What a request asks, one variant for each verb of the protocol.
#[derive(Clone, Debug, PartialEq)]
pub enum Asked {
    /// T: the pixels of a triangle.
    Coverage(Corners),
    /// I: the values of a triangle.
    Values(Triangle),
    /// S: the samples of a triangle, of four.
    Samples(Corners),
    /// L: the pixels of a line, from the first to the second; `whole` leaves out the half pixel.
    Line {
        ends: [PixelPoint; 2],
        /// Positions are whole numbers: the pixel's corner names the pixel as its centre does.
        whole: bool,
    },
    /// D: which of these triangles is seen, of each pixel.
    Depth(Vec<Triangle>),
    /// N: what the near plane leaves of a triangle of clip space, as
    /// [`rasterproof_verify::cases::near_plane::clip_corners`] reads it; the window has no part in it.
    Near(Triangle),
    /// A: the same, with an attribute that new corners get as well.
    Carried(Triangle),
    /// R: the shares of pixels that a triangle covers.
    Area(Corners),
    /// W: the pixels of a line with a width.
    Wide(WideLine),
    /// X: the samples of a triangle, with values.
    SampleValues(Triangle),
    /// Y: the triangles of a polygon; the window has no part in it.
    Polygon(Polygon),
    /// Q: what a formula gives for these numbers; the window has no part in it.
    Formula(Formula, Vec<f64>),
}

impl Asked {
    /// The letters of the request and of its answer.
    fn letters(&self) -> [u8; 2] {
        // The request first, then its answer.
        *match self {
            Self::Coverage(_) => b"TC",
            Self::Values(_) => b"IF",
            Self::Samples(_) => b"SM",
            Self::Line { .. } => b"LP",
            Self::Depth(_) => b"DV",
            Self::Near(_) => b"NG",
            Self::Carried(_) => b"AB",
            Self::Wide(_) => b"WC",
            Self::Area(_) => b"RK",
            Self::SampleValues(_) => b"XU",
            Self::Polygon(_) => b"YZ",
            Self::Formula(..) => b"QO",
        }
    }
}

/// The letters that answers begin with, of every verb.
pub const ANSWER_LETTERS: &[u8] = b"CHFMPVKUGBZOE";

/// What came back for a question, one variant for each letter that answers begin with, and two for what is no answer of one
/// program.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// C: runs of covered pixels as they came.
    Coverage(Vec<Span>),
    /// F: fragments as they came.
    Values(Vec<Fragment<DVec2>>),
    /// M: runs of pixels, with the samples of each.
    Samples(Vec<(Span, u8)>),
    /// P: pixels in drawing order.
    Line(Vec<(i32, i32)>),
    /// V: runs of pixels, with the number of the triangle that is seen there.
    Seen(Vec<(Span, u8)>),
    /// K: runs of pixels, with the level of each.
    Area(Vec<(Span, u8)>),
    /// U: samples of pixels with their values.
    SampleValues(Vec<SampledValues>),
    /// G: corners of a polygon, their attributes 0.
    Polygon(Vec<ClipCorner>),
    /// B: corners of a polygon with attributes.
    Carried(Vec<ClipCorner>),
    /// Z: triangles that make up a polygon.
    Triangles(Vec<partition::Triangle>),
    /// O: what a formula gives.
    Numbers(Vec<f64>),
    /// E: the reason, printable.
    Refused(String),
    /// What each of two programs answers that are compared.
    Two(Box<[Self; 2]>),
    /// No answer: the program had to be started again.
    Died(Misbehaviour),
}

/// Some samples of a pixel, as a mask, and the values that all of them have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledValues {
    pub mask: u8,
    pub values: Fragment<DVec2>,
}

impl Answer {
    /// The corners of a polygon, with attributes or without.
    #[must_use]
    pub fn polygon(&self) -> Option<&[ClipCorner]> {
        match self {
            Self::Polygon(corners) | Self::Carried(corners) => Some(corners),
            _ => None,
        }
    }

    /// The first run that ends before it begins.
    pub(super) fn backward_run(&self) -> Option<Span> {
        let is_backward = |run: &Span| run.x1_px < run.x0_px;
        match self {
            Self::Coverage(runs) => runs.iter().copied().find(is_backward),
            Self::Samples(runs) | Self::Seen(runs) | Self::Area(runs) => {
                runs.iter().map(|(run, _)| *run).find(is_backward)
            }
            Self::Two(both) => both.iter().find_map(Self::backward_run),
            _ => None,
        }
    }

    /// Whether nothing is in it: no pixel, no corner.
    pub(super) fn is_blank(&self) -> bool {
        match self {
            Self::Coverage(runs) => runs.is_empty(),
            Self::Values(fragments) => fragments.is_empty(),
            Self::Samples(runs) | Self::Seen(runs) | Self::Area(runs) => runs.is_empty(),
            Self::SampleValues(samples) => samples.is_empty(),
            Self::Line(pixels) => pixels.is_empty(),
            Self::Polygon(corners) | Self::Carried(corners) => corners.is_empty(),
            Self::Triangles(triangles) => triangles.is_empty(),
            Self::Numbers(numbers) => numbers.is_empty(),
            Self::Two(both) => both.iter().all(Self::is_blank),
            Self::Refused(_) | Self::Died(_) => true,
        }
    }

    /// Whether another answer to the same question says the same, also where it holds what is not a number.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self == other || format!("{self:?}") == format!("{other:?}")
    }

    /// Whether the program had to be started again.
    #[must_use]
    pub fn is_death(&self) -> bool {
        matches!(self, Self::Died(_))
    }
}

rasterproof_core::named! {
    /// In which way a program did not answer.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Breach {
        CannotStart = "cannot be started",
        NoHello = "never says HELLO",
        /// No answer within the limit, and none within as much again.
        Hangs = "hangs",
        Late = "answers late",
        /// It ended, or closed its output, before it had answered.
        Exits = "exits early",
        /// It was ended by a signal, or panicked.
        Crashes = "crashes",
        Nonsense = "prints nonsense",
        Twice = "answers twice",
        OutOfOrder = "answers out of order",
        Unasked = "answers for another id",
        /// More output than any answers have.
        Floods = "floods its output",
        /// It answered everything, and then it ended with another status than 0, or by a signal.
        FailsAtEnd = "fails after the end of its input",
    }
}

/// What a program did instead of answering.
#[derive(Clone, Debug, PartialEq)]
pub struct Misbehaviour {
    pub breach: Breach,
    /// How it did it, or what it said, printable.
    pub how: String,
}

impl Breach {
    /// The misbehaviour of this kind, with how it was seen.
    pub fn by(self, how: impl Into<String>) -> Misbehaviour {
        Misbehaviour { breach: self, how: how.into() }
    }
}

impl Misbehaviour {
    /// Whether it takes long to go wrong.
    pub fn is_slow(&self) -> bool {
        matches!(self.breach, Breach::Hangs | Breach::Late)
    }

    /// What to do about a program that cannot be judged at all.
    pub fn remedy(&self) -> &'static str {
        match self.breach {
            Breach::CannotStart => {
                "name a program and its arguments after --; at a limit of processes, allow more (ulimit -u)"
            }
            _ => {
                "a program answers 'HELLO 2' with 'HELLO 2 name coverage' and flushes it; \
                 see docs/protocol.md"
            }
        }
    }
}

impl fmt::Display for Misbehaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.breach.name(), self.how)
    }
}

/// Somebody who answers questions: a program behind pipes, an engine in memory, or a record of earlier answers. The judge asks all
/// of
/// them through this trait and cannot tell them apart.
pub trait Subject: Send {
    /// What it says of itself, which decides what it is asked and by which rules it is judged.
    fn declared(&self) -> &Declared;

    /// An answer for each question, in order; fewer where that many of them are deaths, or where its time
    /// is over. Never fails: what goes wrong is an answer too.
    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer>;

    /// How long the last answers took, where they were recorded before.
    fn took(&self) -> Option<Duration> {
        None
    }

    /// No question is sent after `end`, and answers are awaited only a short while longer; `None` is no end. An
    /// entry that answers at once can ignore it.
    fn end_at(&mut self, _end: Option<Instant>) {}

    /// How many cases of a family it is asked at once; the same for every copy.
    fn cases_at_once(&self) -> u64 {
        64
    }

    /// What went wrong without a single question at fault, since it was last asked for.
    fn strays(&mut self) -> Vec<Misbehaviour> {
        Vec::new()
    }

    /// Ends its input, when everything was asked, and waits until it has ended: what it did wrong there. Leaks are found
    /// at the end of a program.
    fn finish(&mut self) -> Vec<Misbehaviour> {
        Vec::new()
    }

    /// What it wrote on standard error.
    fn complaints(&self) -> Complaints {
        Complaints::default()
    }
}

/// What a program wrote on standard error.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Complaints {
    /// All its lines, those that are not shown among them.
    pub lines: u64,
    /// What sanitizers found, then the last lines; printable.
    pub shown: Vec<String>,
}

/// Runs of pixels of a row with the same samples covered.
pub fn runs_of(y_px: i32, row: &[u8]) -> Vec<(Span, u8)> {
    let mut x_px = 0;
    let mut runs = Vec::new();
    for run in row.chunk_by(|a, b| a == b) {
        let x1_px = x_px + run.len() as i32;
        if run[0] != 0 {
            runs.push((Span { y_px, x0_px: x_px, x1_px }, run[0]));
        }
        x_px = x1_px;
    }
    runs
}

impl Question {
    /// Appends the request, with its line end.
    pub fn write(&self, id: u64, out: &mut Vec<u8>) {
        // Writing to a vector does not fail.
        let _ = write!(out, "{} {id}", char::from(self.of.letters()[0]));
        let _ = match &self.of {
            Asked::Near(_) | Asked::Carried(_) | Asked::Polygon(_) => Ok(()),
            Asked::Formula(formula, _) => write!(out, " {}", formula.name()),
            _ => write!(out, " {} {}", self.width, self.height),
        };
        // Rust prints the shortest decimal that reads back as the same number.
        let mut add = |numbers: &[f64]| {
            for number in numbers {
                let _ = write!(out, " {number}");
            }
        };
        let at = |p: SubpixelPoint| [px(p.x), px(p.y)];
        match &self.of {
            Asked::Coverage(corners) | Asked::Samples(corners) | Asked::Area(corners) => {
                for corner in corners {
                    add(&at(*corner));
                }
            }
            Asked::Values(triangle) | Asked::SampleValues(triangle) => {
                for v in &triangle.vertices {
                    add(&at(v.position));
                    add(&[v.depth, 1.0 / v.inv_w, v.varying.x, v.varying.y]);
                }
            }
            Asked::Line { ends, whole } => {
                let centre = if *whole { 0.0 } else { 0.5 };
                for end in ends {
                    add(&[f64::from(end.x) + centre, f64::from(end.y) + centre]);
                }
            }
            Asked::Wide(line) => {
                for end in &line.ends {
                    add(&at(*end));
                }
                add(&[px(line.width)]);
            }
            Asked::Depth(list) => {
                for v in list.iter().flat_map(|triangle| &triangle.vertices) {
                    add(&at(v.position));
                    add(&[v.depth]);
                }
            }
            Asked::Near(triangle) => {
                for corner in clip_corners(triangle) {
                    add(&corner[..4]);
                }
            }
            Asked::Carried(triangle) => {
                for corner in clip_corners(triangle) {
                    add(&corner);
                }
            }
            Asked::Polygon(polygon) => {
                add(&[polygon.contours.len() as f64]);
                for contour in &polygon.contours {
                    add(&[contour.len() as f64]);
                    add(contour.as_flattened());
                }
            }
            Asked::Formula(_, numbers) => add(numbers),
        }
        out.push(b'\n');
    }

    /// The request as text, without its line end.
    pub fn text(&self, id: u64) -> String {
        let mut out = Vec::new();
        self.write(id, &mut out);
        String::from_utf8_lossy(&out).trim_end().to_owned()
    }

    /// Reads the words after the id of an answer to this question, whose letter this is. The error
    /// says what is wrong with them.
    ///
    /// # Errors
    /// A letter that does not belong to the question, a number that cannot be read, a count that is
    /// not that of what follows. A run that ends before it begins is read, and judged like a pixel outside the window.
    pub fn read(&self, letter: u8, words: &mut Words<'_>) -> Result<Answer, &'static str> {
        if letter == b'E' {
            return Ok(Answer::Refused(printable(words.0.trim_ascii(), 80)));
        }
        // Runs that are drawn often have a letter of their own.
        let has_hits = letter == b'H' && matches!(self.of, Asked::Coverage(_) | Asked::Wide(_));
        if letter != self.of.letters()[1] && !has_hits {
            return Err("its letter does not belong to the request");
        }
        // The count comes first, and what follows has to be as much.
        let n = words.int().and_then(|n| usize::try_from(n).ok()).ok_or("it has no count")?;
        // Each kind of question has its own kind of item.
        let answer = match self.of {
            Asked::Coverage(_) | Asked::Wide(_) if has_hits => {
                let mut runs = Vec::new();
                for (run, hits) in each(n, words, marked)? {
                    runs.extend(iter::repeat_n(run, usize::from(hits)));
                }
                Answer::Coverage(runs)
            }
            Asked::Coverage(_) | Asked::Wide(_) => Answer::Coverage(each(n, words, span)?),
            Asked::Values(_) => Answer::Values(each(n, words, fragment)?),
            Asked::Line { .. } => Answer::Line(each(n, words, pixel)?),
            Asked::Samples(_) => Answer::Samples(each(n, words, marked)?),
            Asked::Area(_) => Answer::Area(each(n, words, marked)?),
            Asked::SampleValues(_) => Answer::SampleValues(each(n, words, sampled)?),
            Asked::Depth(_) => Answer::Seen(each(n, words, marked)?),
            Asked::Near(_) => Answer::Polygon(each(n, words, clip_corner)?),
            Asked::Carried(_) => Answer::Carried(each(n, words, carried_corner)?),
            Asked::Formula(..) => Answer::Numbers(each(n, words, float)?),
            Asked::Polygon(_) => Answer::Triangles(each(n, words, triangle)?),
        };
        if words.is_empty() { Ok(answer) } else { Err("more follows than it counts") }
    }
}

/// Reads `n` items; a count that is a lie costs no more than what is really there.
fn each<T>(
    n: usize,
    words: &mut Words<'_>,
    item: fn(&mut Words<'_>) -> Option<T>,
) -> Result<Vec<T>, &'static str> {
    // A count says how much room is made, but no more than the words that are there could fill.
    let mut items = Vec::with_capacity(n.min(words.0.len() / 4 + 1));
    for _ in 0..n {
        if words.is_empty() {
            return Err("less follows than it counts");
        }
        items.push(item(words).ok_or("a number cannot be read")?);
    }
    Ok(items)
}

/// A pixel of a thin line: its column and its row.
fn pixel(words: &mut Words<'_>) -> Option<(i32, i32)> {
    Some((words.int()?, words.int()?))
}

/// A corner of clip space without an attribute.
fn clip_corner(words: &mut Words<'_>) -> Option<ClipCorner> {
    Some([words.float()?, words.float()?, words.float()?, words.float()?, 0.0])
}

/// The same with the attribute that A asks for.
fn carried_corner(words: &mut Words<'_>) -> Option<ClipCorner> {
    Some([words.float()?, words.float()?, words.float()?, words.float()?, words.float()?])
}

/// A triangle of a polygon, by its three points.
fn triangle(words: &mut Words<'_>) -> Option<partition::Triangle> {
    Some([point(words)?, point(words)?, point(words)?])
}

/// A number alone, as formulas give them.
fn float(words: &mut Words<'_>) -> Option<f64> {
    words.float()
}

fn point(words: &mut Words<'_>) -> Option<[f64; 2]> {
    Some([words.float()?, words.float()?])
}

/// A run: its row, its first column, and the column after its last one.
fn span(words: &mut Words<'_>) -> Option<Span> {
    Some(Span { y_px: words.int()?, x0_px: words.int()?, x1_px: words.int()? })
}

/// A run, and the mask or the triangle of its pixels.
fn marked(words: &mut Words<'_>) -> Option<(Span, u8)> {
    Some((span(words)?, words.int().and_then(|mark| u8::try_from(mark).ok())?))
}

/// A pixel with depth and both attributes.
fn fragment(words: &mut Words<'_>) -> Option<Fragment<DVec2>> {
    let (x_px, y_px) = (words.int()?, words.int()?);
    let (depth, a, b) = (words.float()?, words.float()?, words.float()?);
    Some(Fragment { x_px, y_px, depth, varying: DVec2::new(a, b) })
}

/// A pixel with a mask of samples, and the values that all of these have.
fn sampled(words: &mut Words<'_>) -> Option<SampledValues> {
    let (x_px, y_px) = (words.int()?, words.int()?);
    let mask = words.int().and_then(|mask| u8::try_from(mask).ok())?;
    let (depth, a, b) = (words.float()?, words.float()?, words.float()?);
    Some(SampledValues { mask, values: Fragment { x_px, y_px, depth, varying: DVec2::new(a, b) } })
}

/// The answer as a line of the protocol, cut where it gets long.
pub fn show(answer: &Answer, id: u64) -> String {
    printable(line(answer, id).as_bytes(), 400)
}

/// The answer as a line of the protocol, without its end: its letter, the id, the number of items, and the items.
pub fn line(answer: &Answer, id: u64) -> String {
    let mut items = Vec::new();
    let letter = match answer {
        Answer::Refused(reason) => return format!("E {id} {reason}"),
        Answer::Two(both) => return line(&both[0], id),
        Answer::Died(misbehaviour) => return format!("({misbehaviour})"),
        Answer::Coverage(runs) => write_runs(runs, &mut items),
        Answer::Samples(runs) => write_marked('M', runs, &mut items),
        Answer::Seen(runs) => write_marked('V', runs, &mut items),
        Answer::Area(runs) => write_marked('K', runs, &mut items),
        Answer::Polygon(corners) => {
            for [x, y, z, w, _] in corners {
                items.push(format!("{x} {y} {z} {w}"));
            }
            'G'
        }
        Answer::Carried(corners) => {
            for [x, y, z, w, a] in corners {
                items.push(format!("{x} {y} {z} {w} {a}"));
            }
            'B'
        }
        Answer::Triangles(triangles) => {
            for [a, b, c] in triangles {
                items.push(format!("{a:?} {b:?} {c:?}"));
            }
            'Z'
        }
        Answer::Numbers(numbers) => {
            for number in numbers {
                items.push(number.to_string());
            }
            'O'
        }
        Answer::Line(pixels) => {
            for (x, y) in pixels {
                items.push(format!("{x} {y}"));
            }
            'P'
        }
        Answer::Values(fragments) => {
            for f in fragments {
                items.push(format!("{} {} {}", f.x_px, f.y_px, values_of(f)));
            }
            'F'
        }
        Answer::SampleValues(samples) => {
            for SampledValues { mask, values: f } in samples {
                items.push(format!("{} {} {mask} {}", f.x_px, f.y_px, values_of(f)));
            }
            'U'
        }
    };
    // Two spaces before each item keep long answers readable; who reads them skips white space.
    let text = format!("{letter} {id} {}  {}", items.len(), items.join("  "));
    text.trim_end().to_owned()
}

/// The runs of an answer, and its letter. Runs that are drawn often are written once each, with their hits.
fn write_runs(runs: &[Span], items: &mut Vec<String>) -> char {
    let is_counted = runs.chunk_by(|a, b| a == b).any(|same| same.len() > 2);
    if !is_counted {
        for run in runs {
            items.push(run_of(run));
        }
        return 'C';
    }
    for same in runs.chunk_by(|a, b| a == b) {
        items.push(format!("{} {}", run_of(&same[0]), same.len()));
    }
    'H'
}

/// Runs with a mask, a level or the number of a triangle each.
fn write_marked(letter: char, runs: &[(Span, u8)], items: &mut Vec<String>) -> char {
    for (run, mark) in runs {
        items.push(format!("{} {mark}", run_of(run)));
    }
    letter
}

/// A run in the order of the protocol: the row comes first.
fn run_of(run: &Span) -> String {
    format!("{} {} {}", run.y_px, run.x0_px, run.x1_px)
}

/// Depth and both attributes, each as the shortest decimal that reads back as the same number.
fn values_of(f: &Fragment<DVec2>) -> String {
    format!("{} {} {}", f.depth, f.varying.x, f.varying.y)
}
