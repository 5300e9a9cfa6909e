// 1. Put your code into triangle() and line() below; set HAS_LINES to false if you draw no lines.
// 2. Say in DECLARES what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
// 3. Judge it: rustc -O --edition 2024 starter.rs && rasterproof judge -- ./starter
use std::fmt::Write as _;
use std::io::{BufRead, Read, Write};
use std::os::fd::AsFd;

const NAME: &str = "mine";
const DECLARES: &str = "batch=64";
const HAS_LINES: bool = true;

// ---- YOUR PLACE: replace the bodies of these two functions ----

/// Corners in pixels, y down; set_pixel(x, y) for every pixel drawn. As it stands it draws every sample on an
/// edge, so two neighbours both draw the edge they share.
fn triangle(
    corners: [(f64, f64); 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
    let side =
        |a: (f64, f64), b: (f64, f64), x, y| (b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0);
    let [a, b, c] = corners;
    let left = a.0.min(b.0).min(c.0).floor().max(0.0) as i32;
    let right = a.0.max(b.0).max(c.0).ceil().min(width.into()) as i32;
    let top = a.1.min(b.1).min(c.1).floor().max(0.0) as i32;
    let bottom = a.1.max(b.1).max(c.1).ceil().min(height.into()) as i32;
    for y in top..bottom {
        for x in left..right {
            let (cx, cy) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let e = [side(a, b, cx, cy), side(b, c, cx, cy), side(c, a, cx, cy)];
            if e.iter().all(|e| *e >= 0.0) || e.iter().all(|e| *e <= 0.0) {
                set_pixel(x, y);
            }
        }
    }
}

/// From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA.
fn line(
    from: (i32, i32),
    to: (i32, i32),
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32),
) {
    let (x0, y0) = (f64::from(from.0), f64::from(from.1));
    let (dx, dy) = (f64::from(to.0) - x0, f64::from(to.1) - y0);
    let steps = dx.abs().max(dy.abs());
    // Of the longer direction, only the steps inside the window.
    let (start, step, size) =
        if dx.abs() >= dy.abs() { (x0, dx, f64::from(width)) } else { (y0, dy, f64::from(height)) };
    let first = if step >= 0.0 { -start } else { start - size + 1.0 }.max(0.0) as i64;
    let last = if step >= 0.0 { size - 1.0 - start } else { start }.min(steps) as i64;
    for i in first..=last {
        let at =
            |start: f64, step: f64| (start + step * i as f64 / steps.max(1.0) + 0.5).floor() as i32;
        set_pixel(at(x0, dx), at(y0, dy));
    }
}

// What else there is (verbs I, S, D, N and A): write functions in their stead, as `rasterproof course start` has them.
// And verb W, a line with a width, and verb R, whose masks are levels: 255 is a pixel that is covered whole.
const VALUES: Option<Values> = None;
const SAMPLES: Option<Samples> = None;
const DEPTH: Option<Depth> = None;
const CLIP: Option<Clip<4>> = None;
const CLIP_ATTRIBUTES: Option<Clip<5>> = None;
const WIDE_LINE: Option<WideLine> = None;
const AREA: Option<Samples> = None;
/// And verb X, as I, with values for each covered sample: see SampleValues.
const SAMPLE_VALUES: Option<SampleValues> = None;
/// And verb Q: the formulas of the pipeline.
const FORMULA: Option<Formula> = None;

// ---- the line protocol: nothing to change from here on ----

/// Corners x, y, z, w, a, b; set_pixel(x, y, [z, a, b]) for every pixel drawn.
type Values = fn(
    corners: [[f64; 6]; 3],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, [f64; 3]),
);
/// The same; set_samples(x, y, mask, [z, a, b]) for covered samples of a pixel that have the same values.
type SampleValues = fn(
    corners: [[f64; 6]; 3],
    width: i32,
    height: i32,
    set_samples: &mut dyn FnMut(i32, i32, u8, [f64; 3]),
);
/// Corners in pixels; set_pixel(x, y, mask), bit s of the mask is sample s.
type Samples =
    fn(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: &mut dyn FnMut(i32, i32, u8));
/// Triangles of three corners x, y, z; set_pixel(x, y, t) once where triangle t is nearest.
type Depth = fn(
    triangles: &[[[f64; 3]; 3]],
    width: i32,
    height: i32,
    set_pixel: &mut dyn FnMut(i32, i32, usize),
);
/// Three corners x, y, z, w of clip space, and with `N` of 5 an attribute; the corners of what z >= -w leaves of them.
type Clip<const N: usize> = fn(corners: [[f64; N]; 3]) -> Vec<[f64; N]>;
/// What the formula of this name gives for these numbers.
type Formula = fn(name: &str, numbers: &[f64]) -> Vec<f64>;
/// Both ends and the width of a line in pixels; set_pixel(x, y) for every pixel drawn.
type WideLine =
    fn(ends: [(f64, f64); 2], line_width: f64, width: i32, height: i32, set_pixel: &mut dyn FnMut(i32, i32));

const MOST_BYTES: usize = 65536;
const MOST_SIDE: i32 = 1024;
const MOST_HITS: usize = 1 << 22;

/// The pixels (y, x) that `draw` sets, and what it sets them to.
fn drawn<T>(
    width: i32,
    height: i32,
    draw: impl FnOnce(&mut dyn FnMut(i32, i32, T)) + std::panic::UnwindSafe,
) -> Result<Vec<(i32, i32, T)>, String> {
    let hits = std::panic::catch_unwind(|| {
        let mut hits = Vec::new();
        draw(&mut |x, y, set| {
            if (0..width).contains(&x) && (0..height).contains(&y) && hits.len() <= MOST_HITS {
                hits.push((y, x, set));
            }
        });
        hits
    })
    .map_err(|_| "raised a panic")?;
    if hits.len() > MOST_HITS { Err(format!("more than {MOST_HITS} pixels set")) } else { Ok(hits) }
}

/// Row, first column, one past the last; a pixel hit twice is in two runs.
fn runs(mut hits: Vec<(i32, i32, ())>) -> Vec<[i32; 3]> {
    hits.sort();
    let mut found: Vec<[i32; 3]> = Vec::new();
    for (y, x, ()) in hits {
        match found.last_mut() {
            Some(run) if run[0] == y && run[2] == x => run[2] += 1,
            _ => found.push([y, x, x + 1]),
        }
    }
    found
}

/// A coordinate.
fn number(word: &str) -> Result<f64, String> {
    let is_near = |value: &f64| (-2147483648.0..2147483648.0).contains(value);
    value(word).ok().filter(is_near).ok_or("a coordinate is not a number within 2^31 px".into())
}

/// A decimal number or a C99 hex float.
fn value(word: &str) -> Result<f64, String> {
    let read = || {
        let lower = word.to_ascii_lowercase();
        let digits = lower.trim_start_matches(['+', '-']);
        let Some(hex) = digits.strip_prefix("0x") else { return word.parse().ok() };
        let (mantissa, exponent) = hex.split_once('p').unwrap_or((hex, "0"));
        let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let bits = u64::from_str_radix(&format!("{whole}{part}"), 16).ok()? as f64;
        let power = exponent.parse::<i32>().ok()? - 4 * part.len() as i32;
        Some(if lower.starts_with('-') { -bits } else { bits } * 2f64.powi(power))
    };
    read().filter(|value: &f64| value.is_finite()).ok_or("a value is not a number".into())
}

fn draw(words: &[&str]) -> Result<String, String> {
    let verb = words[0];
    if let ("N", Some(clip)) = (verb, CLIP) {
        return clipped(words, "G", clip);
    }
    if let ("A", Some(clip)) = (verb, CLIP_ATTRIBUTES) {
        return clipped(words, "B", clip);
    }
    if let ("Q", Some(formula)) = (verb, FORMULA) {
        let [_, id, name, numbers @ ..] = words else { return Err("Q takes id, a name and numbers".into()) };
        let v = numbers.iter().map(|word| value(word)).collect::<Result<Vec<_>, _>>()?;
        let given = std::panic::catch_unwind(|| formula(name, &v)).map_err(|_| "raised a panic")?;
        return Ok(reply("O", id, &given.iter().map(|n| vec![*n]).collect::<Vec<_>>()));
    }
    let count = match verb {
        "L" => 4,
        "W" => 5,
        "I" | "X" => 18,
        "D" => (words.len().saturating_sub(4) / 9).max(1) * 9,
        _ => 6,
    };
    if words.len() != count + 4 {
        return Err(format!("{verb} takes id width height and {count} numbers"));
    }
    let side = |word: &str| word.parse().ok().filter(|side| (1..=MOST_SIDE).contains(side));
    let (Some(width), Some(height)) = (side(words[2]), side(words[3])) else {
        return Err(format!("the window must be from 1x1 to {MOST_SIDE}x{MOST_SIDE}"));
    };
    let is_position = |i: usize| {
        i % match verb {
            "I" | "X" => 6,
            "D" => 3,
            _ => 2,
        } < 2
    };
    let read = |(i, word): (usize, &&str)| if is_position(i) { number(word) } else { value(word) };
    let v = words[4..].iter().enumerate().map(read).collect::<Result<Vec<_>, _>>()?;
    // Of a line there are two.
    let point = |i: usize| (v[2 * i % v.len()], v[(2 * i + 1) % v.len()]);
    let corners = [point(0), point(1), point(2)];
    let (letter, groups): (_, Vec<Vec<f64>>) = if verb == "T" {
        let hits = drawn(width, height, |set| {
            triangle(corners, width, height, &mut |x, y| set(x, y, ()));
        })?;
        ("C", runs(hits).into_iter().map(|run| run.map(f64::from).to_vec()).collect())
    } else if let ("W", Some(wide)) = (verb, WIDE_LINE) {
        let ends = [point(0), point(1)];
        let hits = drawn(width, height, |set| {
            wide(ends, v[4], width, height, &mut |x, y| set(x, y, ()));
        })?;
        ("C", runs(hits).into_iter().map(|run| run.map(f64::from).to_vec()).collect())
    } else if let ("I", Some(values)) = (verb, VALUES) {
        let corner = |i: usize| std::array::from_fn(|n| v[6 * i + n]);
        let corners = [corner(0), corner(1), corner(2)];
        let hits = drawn(width, height, |set| values(corners, width, height, set))?;
        let group = |(y, x, [z, a, b]): (i32, i32, [f64; 3])| vec![x.into(), y.into(), z, a, b];
        ("F", hits.into_iter().map(group).collect())
    } else if let ("X", Some(values)) = (verb, SAMPLE_VALUES) {
        let corner = |i: usize| std::array::from_fn(|n| v[6 * i + n]);
        let corners = [corner(0), corner(1), corner(2)];
        let hits = drawn(width, height, |set| {
            values(corners, width, height, &mut |x, y, mask, values| set(x, y, (mask, values)));
        })?;
        let group = |(y, x, (mask, [z, a, b])): (i32, i32, (u8, [f64; 3]))| {
            vec![x.into(), y.into(), mask.into(), z, a, b]
        };
        ("U", hits.into_iter().map(group).collect())
    } else if let ("D", Some(depth)) = (verb, DEPTH) {
        let corners: Vec<[f64; 3]> = v.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        let triangles: Vec<_> = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let hits = drawn(width, height, |set| depth(&triangles, width, height, set))?;
        let group =
            |(y, x, t): (i32, i32, usize)| vec![y.into(), x.into(), (x + 1).into(), t as f64];
        ("V", hits.into_iter().map(group).collect())
    } else if let ("S", Some(samples)) | ("R", Some(samples)) = (verb, if verb == "S" { SAMPLES } else { AREA }) {
        let hits = drawn(width, height, |set| samples(corners, width, height, set))?;
        let group =
            |(y, x, mask): (i32, i32, u8)| vec![y.into(), x.into(), (x + 1).into(), mask.into()];
        (if verb == "S" { "M" } else { "K" }, hits.into_iter().filter(|(_, _, mask)| *mask > 0).map(group).collect())
    } else {
        let pixel = |i: usize| (v[i].floor() as i32, v[i + 1].floor() as i32);
        let (from, to) = (pixel(0), pixel(2));
        let hits = drawn(width, height, |set| {
            line(from, to, width, height, &mut |x, y| set(x, y, ()));
        })?;
        ("P", hits.into_iter().map(|(y, x, ())| vec![x.into(), y.into()]).collect())
    };
    Ok(reply(letter, words[1], &groups))
}

/// What the near plane leaves: no window has a part in it.
fn clipped<const N: usize>(
    words: &[&str],
    letter: &str,
    clip: Clip<N>,
) -> Result<String, String> {
    if words.len() != 2 + 3 * N {
        return Err(format!("{} takes id and {} numbers", words[0], 3 * N));
    }
    let v = words[2..].iter().map(|word| value(word)).collect::<Result<Vec<_>, _>>()?;
    let corner = |i: usize| std::array::from_fn(|n| v[N * i + n]);
    let corners = [corner(0), corner(1), corner(2)];
    let polygon = std::panic::catch_unwind(|| clip(corners)).map_err(|_| "raised a panic")?;
    let groups: Vec<_> = polygon.into_iter().map(|corner| corner.to_vec()).collect();
    Ok(reply(letter, words[1], &groups))
}

fn reply(letter: &str, id: &str, groups: &[Vec<f64>]) -> String {
    let mut reply = format!("{letter} {id} {}", groups.len());
    for n in groups.iter().flatten() {
        let _ = write!(reply, " {n}");
    }
    reply
}

fn answer(words: &[&str]) -> String {
    let more = [VALUES.is_some(), SAMPLES.is_some(), DEPTH.is_some(), CLIP.is_some()];
    let [values, samples, depth, clip] = more;
    let (carries, wide, area) = (CLIP_ATTRIBUTES.is_some(), WIDE_LINE.is_some(), AREA.is_some());
    let sampled = SAMPLE_VALUES.is_some();
    let formulas = FORMULA.is_some();
    let has = [
        (HAS_LINES, " line"),
        (values, " attributes"),
        (samples, " samples4"),
        (depth, " depth"),
        (clip, " clip"),
        (carries, " clip-attributes"),
        (wide, " wide-line"),
        (area, " area"),
        (sampled, " sample-values"),
        (formulas, " formulas"),
    ];
    let more: String = has.iter().filter(|(has, _)| *has).map(|(_, word)| *word).collect();
    let known = format!("coverage{more}");
    let id = words.get(1).unwrap_or(&"-");
    match words {
        ["HELLO", "1"] => format!("HELLO 1 {NAME} {known}"),
        ["HELLO", "2"] => {
            format!("HELLO 2 {NAME} {known} window={MOST_SIDE}x{MOST_SIDE} {DECLARES}")
        }
        ["HELLO", ..] => "E - say HELLO 1 or HELLO 2".into(),
        ["T", ..] => draw(words).unwrap_or_else(|reason| format!("E {id} {reason}")),
        [verb, ..]
            if [("L", HAS_LINES), ("I", values), ("S", samples), ("D", depth), ("N", clip), ("A", carries), ("W", wide), ("R", area), ("X", sampled), ("Q", formulas)]
                .contains(&(*verb, true)) =>
        {
            draw(words).unwrap_or_else(|reason| format!("E {id} {reason}"))
        }
        _ => format!("E {id} unsupported"),
    }
}

unsafe extern "C" {
    safe fn dup2(from: i32, to: i32) -> i32;
}

fn main() -> std::io::Result<()> {
    let mut protocol = std::fs::File::from(std::io::stdout().as_fd().try_clone_to_owned()?);
    dup2(2, 1); // what your code prints goes to the error output
    let mut input = std::io::stdin().lock();
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
            _ => answer(&words),
        };
        protocol.write_all(format!("{reply}\n").as_bytes())?;
    }
    Ok(())
}
