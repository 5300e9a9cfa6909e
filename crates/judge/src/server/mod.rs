//! The answering side of the line protocol, versions 1 and 2: an engine of the registry behind a reader
//! and a writer.
//!
//! A request is a line of words; an answer is a line, flushed before another request is waited for. A
//! request that cannot be read, or asks for what is outside the domain, is answered `E id reason`
//! and the engine goes on. Positions are window pixels, y down, snapped to 1/256 px half to even;
//! the engines whose names end in `-exact`, and the specimens, take them as they are.

pub(crate) mod pipeline;
mod published;
mod reply;

use std::io::{self, BufRead, BufReader, Read, Write};

use glam::DVec2;
use rasterproof_host::limits::{self, REQUEST_BYTES};

use crate::ask::runs_of;
use crate::declared::Declared;
use crate::server::reply::{Reply, named, write_run, write_words};
use crate::text::number;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize, RasterizeExact};
use rasterproof_core::grid::{MAX_SIDE_PX, PixelRect, Refusal, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{
    FreeCorners, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex, Span, WideLine,
    check_position, check_value,
};
use rasterproof_registry::engines::{Engine, Entry, ExactEngine, LineEngine, Variant};
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::oracle::formula::Formula;

/// Bytes that are read at once.
const READ_BYTES: usize = 1 << 16;
/// Triangles of a request for depth order.
const MOST_LAYERS: usize = 64;

/// Answers requests until the input ends.
pub fn serve(entry: &Entry, input: &mut dyn Read, output: &mut dyn Write) -> io::Result<()> {
    let mut input = BufReader::with_capacity(READ_BYTES, input);
    let mut line = Vec::new();
    loop {
        // While another request is there already, answers may wait for company.
        if !input.buffer().contains(&b'\n') {
            output.flush()?;
        }
        if !read_line(&mut input, &mut line)? {
            return Ok(());
        }
        // A request that cannot be read is answered, and the engine goes on.
        let request = match std::str::from_utf8(&line) {
            _ if line.len() as u64 > limits::REQUEST_BYTES => {
                Err(format!("- a request has at most {REQUEST_BYTES} bytes"))
            }
            Err(_) => Err("- the request is not UTF-8".to_owned()),
            Ok(text) => Ok(text),
        };
        match request {
            Ok(text) if text.trim().is_empty() => {}
            Ok(text) => respond(entry, text, output)?,
            Err(reason) => writeln!(output, "E {reason}")?,
        }
    }
}

/// Writes the answer of a request, or why there is none.
pub fn respond(entry: &Entry, text: &str, out: &mut dyn Write) -> io::Result<()> {
    match answer(entry, text, out) {
        Ok(()) => Ok(()),
        Err(Stop::Refused(reason)) => writeln!(out, "E {reason}"),
        Err(Stop::Io(error)) => Err(error),
    }
}

/// Reads a line without its end; of an overlong one the rest is thrown away. False at the end.
fn read_line(input: &mut dyn BufRead, line: &mut Vec<u8>) -> std::io::Result<bool> {
    // One byte more than a request may have is read, so that an overlong one is known.
    line.clear();
    if (&mut *input).take(limits::REQUEST_BYTES + 1).read_until(b'\n', line)? == 0 {
        return Ok(false);
    }
    // The rest of an overlong line belongs to no request.
    if line.last() == Some(&b'\n') {
        line.pop();
    } else if line.len() as u64 > limits::REQUEST_BYTES {
        loop {
            let buffer = input.fill_buf()?;
            let (used, ended) = match buffer.iter().position(|&byte| byte == b'\n') {
                Some(at) => (at + 1, true),
                None => (buffer.len(), buffer.is_empty()),
            };
            input.consume(used);
            if ended {
                break;
            }
        }
    }
    Ok(true)
}

/// Why a request has no answer, or an answer no end.
enum Stop {
    /// `id reason`.
    Refused(String),
    Io(std::io::Error),
}

impl From<std::io::Error> for Stop {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}

/// Writes the answer to a request. The verb decides how many numbers follow, and which part of the engine is asked.
fn answer(entry: &Entry, text: &str, out: &mut dyn Write) -> Result<(), Stop> {
    // The first word is the verb, the second the id, which every answer repeats.
    let words: Vec<&str> = text.split_whitespace().collect();
    let (verb, rest) = words.split_first().map_or(("", &[][..]), |(verb, rest)| (*verb, rest));
    if verb == "HELLO" {
        return hello(entry, rest, out);
    }
    let id = rest.first().copied().unwrap_or("-");
    let refused = |reason: String| Stop::Refused(format!("{id} {reason}"));
    let declared = Declared::from(entry);
    if verb == "Q" {
        let numbers = formula(&declared, rest).map_err(refused)?;
        write!(out, "O {id} {}", numbers.len())?;
        for number in numbers {
            write!(out, " {number}")?;
        }
        return Ok(writeln!(out)?);
    }
    // Whether the engine has such a request, and how many numbers it takes.
    let (speaks, count) = match verb {
        "T" => (declared.coverage, 6),
        "S" => (declared.samples4, 6),
        "L" => (declared.line, 4),
        "I" => (declared.attributes, 18),
        "N" => (declared.clip, 12),
        "A" => (declared.clip_attributes, 15),
        "W" => (declared.wide_line, 5),
        "R" => (declared.area, 6),
        "X" => (declared.sample_values, 18),
        // As many triangles as there are.
        "D" => (declared.depth, (rest.len().saturating_sub(3) / 9).clamp(1, MOST_LAYERS) * 9),
        _ => {
            return Err(refused(format!(
                "unknown request '{}'; expected HELLO, T, L, I, S, D, N, A, W, R, X, Q",
                printable(verb)
            )));
        }
    };
    if !speaks {
        return Err(refused("unsupported".to_owned()));
    }
    // What the near plane leaves has nothing to do with a window.
    let is_clipped = matches!(verb, "N" | "A");
    let first = if is_clipped { 1 } else { 3 };
    if rest.len() != count + first {
        let sides = if is_clipped { "" } else { ", width, height" };
        let numbers = if verb == "D" {
            format!("9 numbers for each of 1 to {MOST_LAYERS} triangles")
        } else {
            format!("{count} numbers")
        };
        let expected = format!("{verb} takes an id{sides} and {numbers}");
        return Err(refused(format!("{expected}; {} words follow", rest.len())));
    }
    let window = match first {
        1 => PixelRect::window(1, 1),
        _ => window(rest[1], rest[2]).map_err(refused)?,
    };
    let numbers = read_numbers(&rest[first..]).map_err(refused)?;
    // The part of the engine that answers the verb.
    let reply = match (verb, entry.engine, entry.line_engine, entry.exact_engine) {
        ("T", Some(engine), ..) => cover(engine, window, &numbers),
        ("T", ..) if entry.variant.is_some() => by_variant(entry, window, &numbers),
        ("T", _, _, Some(engine)) => cover_exact(engine, window, &numbers),
        ("W", ..) => wide(entry, window, &numbers),
        ("R", ..) => area(entry, window, &numbers),
        ("X", ..) => sample_values(entry, window, &numbers),
        ("S", Some(engine), ..) => samples(engine, window, &numbers),
        ("L", _, Some(engine), _) => line(engine, window, &numbers),
        ("D", Some(engine), ..) => depth(engine, window, &numbers),
        ("N" | "A", Some(_), ..) => near(&numbers, verb == "A"),
        ("I", Some(engine), ..) => {
            let (triangle, n) = values(engine, window, &numbers).map_err(refused)?;
            return write_fragments(engine, &triangle, window, id, n, out);
        }
        _ => published::answer(entry, verb, window, &numbers),
    };
    // An answer is written when all of it is there, since its count comes first.
    let (letter, n, runs) = reply.map_err(refused)?;
    write!(out, "{letter} {id} {n}")?;
    out.write_all(&runs)?;
    Ok(out.write_all(b"\n")?)
}

/// The numbers of a request; the first that cannot be read is named by its place.
fn read_numbers(words: &[&str]) -> Result<Vec<f64>, String> {
    let read = |(i, word): (usize, &&str)| {
        number(word).ok_or_else(|| format!("number {} '{}' cannot be read", i + 1, printable(word)))
    };
    words.iter().enumerate().map(read).collect()
}

/// What the engine says of itself, in the words of the version that is spoken.
fn hello(entry: &Entry, rest: &[&str], out: &mut dyn Write) -> Result<(), Stop> {
    let declared = Declared::from(entry);
    match rest {
        ["1"] => {
            // Version 1 knows no words for what came later.
            let old = Declared {
                depth: false,
                clip: false,
                clip_attributes: false,
                formulas: false,
                ..declared
            };
            writeln!(out, "HELLO 1 {} {}", entry.name, old.capabilities().join(" "))?;
        }
        ["2"] => writeln!(out, "HELLO 2 {} {declared}", entry.name)?,
        _ => {
            let reason = "- this engine speaks versions 1 and 2: say HELLO 1 or HELLO 2";
            return Err(Stop::Refused(reason.to_owned()));
        }
    }
    Ok(())
}

/// What a formula gives, rounded once.
fn formula(declared: &Declared, rest: &[&str]) -> Result<Vec<f64>, String> {
    if !declared.formulas {
        return Err("unsupported".to_owned());
    }
    // A formula is asked by its name, then come its numbers.
    let [_, name, words @ ..] = rest else {
        return Err("Q takes an id, a name and numbers".to_owned());
    };
    let Some(formula) = Formula::ALL.into_iter().find(|formula| formula.name() == *name) else {
        let known = Formula::ALL.map(Formula::name).join(", ");
        return Err(format!("no formula is called '{}'; expected one of {known}", printable(name)));
    };
    let numbers = read_numbers(words)?;
    let given = formula.of(&numbers).ok_or_else(|| format!("these are no numbers for {name}"))?;
    Ok(given.iter().map(|given| given.exact.to_f64()).collect())
}

/// A word of the request, short and without control characters, to quote in an answer.
fn printable(word: &str) -> String {
    word.chars().filter(|c| !c.is_control()).take(40).collect()
}

/// The window of a request, from the origin.
fn window(width: &str, height: &str) -> Result<PixelRect, String> {
    let side = |name: &str, word: &str| {
        word.parse::<u32>().ok().filter(|side| (1..=MAX_SIDE_PX).contains(side)).ok_or_else(|| {
            format!("{name} '{}' is not a whole number from 1 to {MAX_SIDE_PX}", printable(word))
        })
    };
    Ok(PixelRect::window(side("width", width)?, side("height", height)?))
}

/// Corner `i` of a request, snapped to the lattice.
fn point(numbers: &[f64], i: usize) -> Result<SubpixelPoint, String> {
    let snap = |value: f64, axis: &str| {
        rasterproof_core::grid::snap(value).map_err(named(&format!("{axis}{i}")))
    };
    Ok(SubpixelPoint::new(snap(numbers[0], "x")?, snap(numbers[1], "y")?))
}

/// Vertex `i` of a request, or the number of it that is refused.
fn vertex(
    px: [f64; 2],
    z: f64,
    w: f64,
    values: DVec2,
    i: usize,
) -> Result<ScreenVertex<DVec2>, String> {
    ScreenVertex::by_name(px, z, w, values)
        .map_err(|(name, refusal)| named(&format!("{name}{i}"))(refusal))
}

/// T: the runs of a triangle, as the engine makes them.
fn cover(engine: impl Rasterize, window: PixelRect, numbers: &[f64]) -> Reply {
    let corners = [point(&numbers[0..], 0)?, point(&numbers[2..], 1)?, point(&numbers[4..], 2)?];
    let (mut runs, mut n) = (Vec::new(), 0);
    engine.cover(corners, window, |span| {
        n += 1;
        write_run(&mut runs, span);
    });
    Ok(('C', n, runs))
}

/// The pixels of a triangle by another rule.
fn by_variant(entry: &Entry, window: PixelRect, numbers: &[f64]) -> Reply {
    match entry.variant {
        Some(Variant::Touched(engine)) => cover(engine, window, numbers),
        _ => Err("unsupported".to_owned()),
    }
}

/// The level of each pixel that a triangle covers in part or whole.
fn area(entry: &Entry, window: PixelRect, numbers: &[f64]) -> Reply {
    let Some(Variant::Area(engine)) = entry.variant else {
        return Err("unsupported".to_owned());
    };
    let corners = [point(&numbers[0..], 0)?, point(&numbers[2..], 1)?, point(&numbers[4..], 2)?];
    let (mut runs, mut n) = (Vec::new(), 0);
    engine.cover(&corners, window, &mut |span, level| {
        n += 1;
        write_run(&mut runs, span);
        write_words(&mut runs, [i32::from(level)]);
    });
    Ok(('K', n, runs))
}

/// The most that a line is wide, in pixels.
const WIDEST_PX: i32 = 1 << 12;

/// The pixels of a line with a width, which is rounded as positions are.
fn wide(entry: &Entry, window: PixelRect, numbers: &[f64]) -> Reply {
    let Some(Variant::WideLines(engine)) = entry.variant else {
        return Err("unsupported".to_owned());
    };
    let ends = [point(&numbers[0..], 0)?, point(&numbers[2..], 1)?];
    // The width is snapped as the ends are.
    let width = rasterproof_core::grid::snap(numbers[4]).map_err(named("the width"))?;
    if !(1..=WIDEST_PX * SUBPIXELS).contains(&width) {
        return Err(format!("the width {:e} is not from 1/256 to {WIDEST_PX} px", numbers[4]));
    }
    let (mut runs, mut n) = (Vec::new(), 0);
    engine.cover(&WideLine { ends, width }, window, &mut |span| {
        n += 1;
        write_run(&mut runs, span);
    });
    Ok(('C', n, runs))
}

/// Samples are tested in triangles that are moved by up to half a pixel, which has to stay in the domain.
const NO_PLACE: &str =
    "a corner lies within half a pixel of the domain's end, where samples have no place";

/// S: the runs of pixels with the same samples covered.
fn samples(engine: Engine, window: PixelRect, numbers: &[f64]) -> Reply {
    let corners = [point(&numbers[0..], 0)?, point(&numbers[2..], 1)?, point(&numbers[4..], 2)?];
    let masks = multisample::masks(&engine, corners, window).ok_or(NO_PLACE)?;
    let (mut runs, mut n) = (Vec::new(), 0);
    for (y_px, row) in masks.rows() {
        for (span, mask) in runs_of(y_px, row) {
            n += 1;
            write_run(&mut runs, span);
            write_words(&mut runs, [i32::from(mask)]);
        }
    }
    Ok(('M', n, runs))
}

/// D: the runs of pixels that show the same triangle.
fn depth(engine: Engine, window: PixelRect, numbers: &[f64]) -> Reply {
    let mut list = Vec::new();
    for (number, of_one) in numbers.chunks_exact(9).enumerate() {
        let vertex = |i: usize| -> Result<ScreenVertex<DVec2>, String> {
            let [x, y, z] = [0, 1, 2].map(|k| of_one[3 * i + k]);
            self::vertex([x, y], z, 1.0, DVec2::ZERO, i)
                .map_err(|reason| format!("of triangle {number}: {reason}"))
        };
        list.push(ScreenTriangle { vertices: [vertex(0)?, vertex(1)?, vertex(2)?] });
    }
    // The triangles go through the depth buffer of the pipeline.
    let seen = pipeline::seen(engine, &list, window)?;
    let mut runs = Vec::new();
    for (span, number) in &seen {
        write_run(&mut runs, *span);
        write_words(&mut runs, [i32::from(*number)]);
    }
    Ok(('V', seen.len(), runs))
}

/// N, of corners of four numbers, and A, of corners that carry an attribute.
fn near(numbers: &[f64], carries: bool) -> Reply {
    let size = if carries { 5 } else { 4 };
    for (i, &number) in numbers.iter().enumerate() {
        let axis = ["x", "y", "z", "w", "a"][i % size];
        check_value(number).map_err(named(&format!("{axis}{}", i / size)))?;
    }
    let corner =
        |i: usize| [0, 1, 2, 3, 4].map(|k| if k < size { numbers[size * i + k] } else { 0.0 });
    // The clipper of the pipeline, which is right for both verbs.
    let polygon = pipeline::clipped([corner(0), corner(1), corner(2)]);
    let mut corners = Vec::new();
    for number in polygon.iter().flat_map(|corner| &corner[..size]) {
        // Writing to a vector does not fail.
        let _ = write!(corners, " {number}");
    }
    Ok((if carries { 'B' } else { 'G' }, polygon.len(), corners))
}

/// T of engines that take positions as they are, not snapped.
fn cover_exact(engine: ExactEngine, window: PixelRect, numbers: &[f64]) -> Reply {
    for (i, &px) in numbers.iter().enumerate() {
        let axis = if i % 2 == 0 { 'x' } else { 'y' };
        check_position(px).map_err(named(&format!("{axis}{}", i / 2)))?;
    }
    let corner = |i: usize| [numbers[2 * i], numbers[2 * i + 1]];
    let corners = FreeCorners::new([corner(0), corner(1), corner(2)]).map_err(|r| r.to_string())?;
    let (mut runs, mut n) = (Vec::new(), 0);
    engine.cover_exact(&corners, window, |span| {
        n += 1;
        write_run(&mut runs, span);
    });
    Ok(('C', n, runs))
}

/// The pixel that holds a position, after snapping to the lattice: the floor.
fn pixel(value: f64, name: &str) -> Result<i32, String> {
    // A position is snapped first, as those of triangles are, so that both agree on the pixel.
    let scale = f64::from(SUBPIXELS);
    let floor = ((value * scale).round_ties_even() / scale).floor();
    if value.is_nan() {
        Err(named(name)(Refusal::NotANumber))
    } else if value.is_infinite() {
        Err(named(name)(Refusal::Infinite))
    } else if floor < f64::from(i32::MIN) || floor > f64::from(i32::MAX) {
        Err(format!("{name} {value:e} is outside the domain of lines, [-2^31, 2^31) px"))
    } else {
        // A whole number within i32.
        Ok(floor as i32)
    }
}

/// L: the pixels of a line in drawing order.
fn line(engine: LineEngine, window: PixelRect, numbers: &[f64]) -> Reply {
    let end = |i: usize| -> Result<_, String> {
        let x = pixel(numbers[2 * i], &format!("x{i}"))?;
        let y = pixel(numbers[2 * i + 1], &format!("y{i}"))?;
        Ok(LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: 0.0 })
    };
    let (mut pixels, mut n) = (Vec::new(), 0);
    engine.draw(&ScreenLine { ends: [end(0)?, end(1)?] }, window, |fragment| {
        n += 1;
        write_words(&mut pixels, [fragment.x_px, fragment.y_px]);
    });
    Ok(('P', n, pixels))
}

/// A triangle with values, and how many fragments it has.
type Values = (ScreenTriangle<DVec2>, u64);

/// The triangle of an `I` or `X` request.
fn with_values(numbers: &[f64]) -> Result<ScreenTriangle<DVec2>, String> {
    let vertex = |i: usize| -> Result<ScreenVertex<DVec2>, String> {
        let [x, y, z, w, a, b] = [0, 1, 2, 3, 4, 5].map(|k| numbers[6 * i + k]);
        for (name, value) in [("z", z), ("a", a), ("b", b)] {
            check_value(value).map_err(named(&format!("{name}{i}")))?;
        }
        self::vertex([x, y], z, w, DVec2::new(a, b), i)
    };
    Ok(ScreenTriangle { vertices: [vertex(0)?, vertex(1)?, vertex(2)?] })
}

/// The samples of a triangle with their values.
fn sample_values(entry: &Entry, window: PixelRect, numbers: &[f64]) -> Reply {
    let Some(Variant::SampleValues(engine)) = entry.variant else {
        return Err("unsupported".to_owned());
    };
    let triangle = with_values(numbers)?;
    if u64::from(window.width()) * u64::from(window.height()) > limits::REQUEST_FRAGMENTS {
        return Err(format!(
            "a window of more than {} pixels, which is the most of a request",
            limits::REQUEST_FRAGMENTS
        ));
    }
    let (mut samples, mut n) = (Vec::new(), 0);
    let drawn = engine.cover(&triangle, window, &mut |mask, f| {
        n += 1;
        write_words(&mut samples, [f.x_px, f.y_px, i32::from(mask)]);
        // Writing to a vector does not fail.
        let _ = write!(samples, " {} {} {}", f.depth, f.varying.x, f.varying.y);
    });
    drawn.ok_or(NO_PLACE)?;
    Ok(('U', n, samples))
}

/// The triangle of an `I` request and how many fragments it has.
fn values(engine: Engine, window: PixelRect, numbers: &[f64]) -> Result<Values, String> {
    let triangle = with_values(numbers)?;
    let mut n = 0;
    if matches!(engine, Engine::Oracle) {
        let most = limits::REQUEST_FRAGMENTS;
        n = pipeline::covered_at_most(engine, triangle.corners(), window, most).ok_or_else(|| {
            format!("more than {most} fragments, which is the most that the oracle computes for a request")
        })?;
    } else if matches!(engine, Engine::Mutant(_)) {
        // A fault of coverage may cover pixels that have no fragment.
        engine.fragments(&triangle, window, |_| n += 1);
    } else {
        let mut count = |span: Span| n += u64::from(span.x0_px.abs_diff(span.x1_px));
        engine.cover(triangle.corners(), window, &mut count);
    }
    Ok((triangle, n))
}

/// Streams the fragments, so that a large window takes no memory.
fn write_fragments(
    engine: Engine,
    triangle: &ScreenTriangle<DVec2>,
    window: PixelRect,
    id: &str,
    n: u64,
    out: &mut dyn Write,
) -> Result<(), Stop> {
    write!(out, "F {id} {n}")?;
    // The engine cannot be stopped, so that the first failure to write is kept and the rest is not written.
    let mut result = Ok(());
    engine.fragments(triangle, window, |f| {
        if result.is_ok() {
            let (a, b) = (f.varying.x, f.varying.y);
            result = write!(out, " {} {} {} {a} {b}", f.x_px, f.y_px, f.depth);
        }
    });
    result?;
    Ok(writeln!(out)?)
}
