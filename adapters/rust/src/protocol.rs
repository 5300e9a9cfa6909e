//! The line protocol (docs/protocol.md) for Rust libraries: [`serve`] reads requests, calls the library, answers.

use std::fmt::Write as _;
use std::io::{BufRead, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

const MOST_BYTES: usize = 65536;
const MOST_SIDE: i32 = 1024;
const MOST_HITS: usize = 1 << 22;

/// Draws one pixel; outside the window it does nothing.
pub type SetPixel<'a> = &'a mut dyn FnMut(i32, i32);
/// Corners in pixels, y down; the window's width and height.
pub type Triangle = fn([(f64, f64); 3], i32, i32, SetPixel<'_>);
/// From one pixel to another, in drawing order; the window's width and height.
pub type Line = fn([(i32, i32); 2], i32, i32, SetPixel<'_>);

pub struct Library {
    pub name: &'static str,
    /// What it promises beside a window of 1024x1024, such as "mask line-set".
    pub declares: &'static str,
    /// 1 if it takes whole pixels only, else 256.
    pub grid: f64,
    /// Coordinates lie in [-range, range] px.
    pub range: f64,
    /// Corners and ends outside the window are refused: for a library that takes what is clipped already.
    pub inside: bool,
    pub triangle: Triangle,
    pub line: Option<Line>,
    /// Longer lines, in pixels, are refused: for a library that walks them outside the window, too.
    pub longest_line: i64,
}

/// Answers requests until the input ends.
pub fn serve(library: &Library) -> std::io::Result<()> {
    let (mut input, mut output) = (std::io::stdin().lock(), std::io::stdout().lock());
    let mut line = Vec::new();
    let mut read = |line: &mut Vec<u8>| {
        line.clear();
        input.by_ref().take(MOST_BYTES as u64 + 1).read_until(b'\n', line)
    };
    while read(&mut line)? > 0 {
        let too_long = line.len() > MOST_BYTES && !line.ends_with(b"\n");
        let text = String::from_utf8_lossy(&line).into_owned();
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        while line.len() > MOST_BYTES && !line.ends_with(b"\n") && read(&mut line)? > 0 {}
        let reply = match words[..] {
            _ if too_long => format!("E - a request has at most {MOST_BYTES} bytes"),
            [] => continue,
            _ => answer(library, &words),
        };
        output.write_all(format!("{reply}\n").as_bytes())?;
        output.flush()?;
    }
    Ok(())
}

fn answer(library: &Library, words: &[&str]) -> String {
    let known =
        format!("{} coverage{}", library.name, if library.line.is_some() { " line" } else { "" });
    let id = words.get(1).unwrap_or(&"-");
    match words {
        ["HELLO", "1"] => format!("HELLO 1 {known}"),
        ["HELLO", "2"] => {
            format!("HELLO 2 {known} window={MOST_SIDE}x{MOST_SIDE} {}", library.declares)
        }
        ["HELLO", ..] => "E - say HELLO 1 or HELLO 2".into(),
        ["L", ..] if library.line.is_none() => format!("E {id} unsupported"),
        ["T" | "L", ..] => draw(library, words).unwrap_or_else(|reason| format!("E {id} {reason}")),
        _ => format!("E {id} unsupported"),
    }
}

fn draw(library: &Library, words: &[&str]) -> Result<String, String> {
    let (verb, count) = (words[0], if words[0] == "T" { 6 } else { 4 });
    if words.len() != count + 4 {
        return Err(format!("{verb} takes id width height and {count} numbers"));
    }
    let side = |word: &str| word.parse().ok().filter(|side| (1..=MOST_SIDE).contains(side));
    let (Some(width), Some(height)) = (side(words[2]), side(words[3])) else {
        return Err(format!("the window must be from 1x1 to {MOST_SIDE}x{MOST_SIDE}"));
    };
    let v = words[4..].iter().map(|word| number(library, word)).collect::<Result<Vec<_>, _>>()?;
    let sides = [f64::from(width), f64::from(height)];
    let is_inside = |(i, v): (usize, &f64)| {
        // The centre of a pixel, where a line ends, lies half a pixel further.
        (0.0..=sides[i % 2] - if verb == "L" { 1.0 } else { 0.0 }).contains(v)
    };
    if library.inside && !v.iter().enumerate().all(is_inside) {
        return Err("unsupported: the library takes what lies in the window".into());
    }
    let pixel = |i: usize| (v[i].floor() as i32, v[i + 1].floor() as i32);
    let reach = |i: usize| (v[i].floor() - v[i + 2].floor()).abs() as i64;
    if verb == "L" && reach(0).max(reach(1)) > library.longest_line {
        return Err(format!(
            "unsupported: the library walks the whole line, here at most {} px of it",
            library.longest_line
        ));
    }
    // Row and column; one more than may be kept tells that there were too many.
    let mut hits: Vec<(i32, i32)> = Vec::new();
    let mut set_pixel = |x, y| {
        if (0..width).contains(&x) && (0..height).contains(&y) && hits.len() <= MOST_HITS {
            hits.push((y, x));
        }
    };
    catch_unwind(AssertUnwindSafe(|| match library.line {
        Some(line) if verb == "L" => {
            line([pixel(0), pixel(2)], width, height, &mut set_pixel);
        }
        _ => (library.triangle)(
            [(v[0], v[1]), (v[2], v[3]), (v[4], v[5])],
            width,
            height,
            &mut set_pixel,
        ),
    }))
    .map_err(|_| "raised a panic")?;
    if hits.len() > MOST_HITS {
        return Err(format!("more than {MOST_HITS} pixels set"));
    }
    let (letter, groups) = if verb == "T" { ("C", runs(hits)) } else { ("P", pixels(hits)) };
    let mut reply = format!("{letter} {} {}", words[1], groups.len());
    for n in groups.iter().flatten() {
        let _ = write!(reply, " {n}");
    }
    Ok(reply)
}

/// Row, first column, one past the last; a pixel hit twice is in two runs.
fn runs(mut hits: Vec<(i32, i32)>) -> Vec<Vec<i32>> {
    hits.sort();
    let mut found: Vec<Vec<i32>> = Vec::new();
    for (y, x) in hits {
        match found.last_mut() {
            Some(run) if run[0] == y && run[2] == x => run[2] += 1,
            _ => found.push(vec![y, x, x + 1]),
        }
    }
    found
}

fn pixels(hits: Vec<(i32, i32)>) -> Vec<Vec<i32>> {
    hits.into_iter().map(|(y, x)| vec![x, y]).collect()
}

/// A decimal number or a C99 hex float, on the grid and in the range.
fn number(library: &Library, word: &str) -> Result<f64, String> {
    let value = match hex_float(word) {
        Some(value) => value,
        None => word.parse().unwrap_or(f64::NAN),
    };
    if !(-2147483648.0..2147483648.0).contains(&value) {
        return Err("a coordinate is not a number within 2^31 px".into());
    }
    if value.abs() > library.range {
        return Err("unsupported: out of the declared range".into());
    }
    if (value * library.grid).fract() != 0.0 {
        return Err("unsupported: off the declared grid".into());
    }
    Ok(value)
}

fn hex_float(word: &str) -> Option<f64> {
    let lower = word.to_ascii_lowercase();
    let hex = lower.trim_start_matches(['+', '-']).strip_prefix("0x")?;
    let (mantissa, exponent) = hex.split_once('p').unwrap_or((hex, "0"));
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let bits = u64::from_str_radix(&format!("{whole}{part}"), 16).ok()? as f64;
    let power = exponent.parse::<i32>().ok()? - 4 * part.len() as i32;
    Some(if lower.starts_with('-') { -bits } else { bits } * 2f64.powi(power))
}
