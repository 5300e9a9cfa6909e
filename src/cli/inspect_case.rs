//! The words of `inspect` as a case: its name, its number in a family, or its corners.

use std::path::Path;

use glam::DVec2;

use super::{InputError, did_you_mean, program, usage};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{
    FreeCorners, PixelPoint, ScreenTriangle, ScreenVertex, Span, check_value, refused_number,
};
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX, RecordedCase};
use rasterproof_registry::named;
use rasterproof_verify::cases::named::{Input, plain_line, plain_triangle};
use rasterproof_verify::cases::{self, Case, Line, Shape, Triangle};

/// Largest side of the window around corners that were typed, or of a face of a model.
const MOST_AROUND_PX: i32 = 64;

#[derive(clap::Args, Debug)]
pub(super) struct CaseArguments {
    /// A named case, FAMILY#NUMBER, MODEL#FACE, or three corners of each triangle: x,y in pixels, or
    /// x,y,w,depth,u,v
    #[arg(value_name = "CASE or X,Y", required = true, num_args = 1..)]
    pub what: Vec<String>,
    /// The points are pixels, the two ends of each line
    #[arg(long)]
    pub line: bool,
    /// The corners as they are, not snapped to 1/256 px
    #[arg(long)]
    pub exact: bool,
    /// Seed of FAMILY#NUMBER
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    pub seed: u64,
}

pub(super) enum InspectedCase {
    /// `typed` are the corners of a case on the lattice as they were typed, if they were.
    Case {
        title: String,
        case: Case,
        expected: Option<Vec<u64>>,
        typed: Vec<FreeCorners>,
    },
    Refused {
        title: String,
        corners: Vec<[[f64; 2]; 3]>,
    },
}

fn plain(title: String, case: Case) -> InspectedCase {
    InspectedCase::Case { title, case, expected: None, typed: Vec::new() }
}

pub(super) fn find(arguments: &CaseArguments) -> Result<InspectedCase, InputError> {
    let words = words(arguments);
    let found = match words.as_slice() {
        _ if arguments.line => lines(&words)?,
        [word] if parse_corner(word).is_ok() => {
            return Err(usage(
                "a point alone is no case: three corners x,y, or --line and two points; see inspect --help",
            ));
        }
        [word] => called(word, arguments)?,
        _ => triangles(&words, arguments.exact, None)?,
    };
    if arguments.exact { off_lattice(found) } else { Ok(found) }
}

/// The same corners, for those who do not snap.
pub(super) fn off_lattice(found: InspectedCase) -> Result<InspectedCase, InputError> {
    match found {
        InspectedCase::Case { title, case, expected, typed } => match case.shape {
            Shape::Triangles { list, .. } => {
                let snapped = || list.iter().map(|t| FreeCorners::from(t.corners())).collect();
                let triangles = if typed.is_empty() { snapped() } else { typed };
                Ok(plain(title, Case::unsnapped(case.window, triangles)))
            }
            Shape::Lines(_) => Err(usage("lines join whole pixels: leave out --exact")),
            Shape::Unsnapped { .. } | Shape::Numbers { .. } => {
                Ok(InspectedCase::Case { title, case, expected, typed })
            }
        },
        found @ InspectedCase::Refused { .. } => Ok(found),
    }
}

/// The recorded input that the words name.
pub(super) fn recorded(words: &[String]) -> Option<&'static RecordedCase> {
    RECORDED.iter().find(|case| [case.name] == *words)
}

/// The words of the case; points that are typed as they are printed, (1, 2) (3, 4), come apart.
pub(super) fn words(arguments: &CaseArguments) -> Vec<String> {
    let whole = arguments.what.join(" ");
    if !whole.contains('(') {
        return arguments.what.clone();
    }
    let points = whole.split_inclusive(')').map(str::trim).filter(|word| !word.is_empty());
    points.map(str::to_owned).collect()
}

fn lines(words: &[String]) -> Result<InspectedCase, InputError> {
    let (pairs, rest) = words.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(usage(
            "--line takes two points for each line, for example: inspect --line 0,0 8,3",
        ));
    }
    let mut list = Vec::new();
    for [a, b] in pairs {
        list.push(plain_line(parse_pixel(a)?, parse_pixel(b)?));
    }
    let title = match list.as_slice() {
        [Line { ends: [a, b] }] => {
            format!("line {},{} to {},{}", a.pixel.x, a.pixel.y, b.pixel.x, b.pixel.y)
        }
        _ => format!("{} lines", list.len()),
    };
    let ends = list.iter().flat_map(|line| line.ends.map(|end| [end.pixel.x, end.pixel.y]));
    let all = all_around(ends);
    let window = PixelRect { x1: cut(all.x0, all.x1), y1: cut(all.y0, all.y1), ..all };
    Ok(plain(title, Case { window, shape: Shape::Lines(list) }))
}

/// Triangles by their corners. `screen` is where they can be seen, where they are not seen everywhere.
pub(super) fn triangles(
    words: &[String],
    exact: bool,
    screen: Option<PixelRect>,
) -> Result<InspectedCase, InputError> {
    let (triples, rest) = words.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(usage(
            "expected a named case, FAMILY#NUMBER, or three corners x,y of each triangle; see inspect --help",
        ));
    }
    let (mut list, mut typed) = (Vec::new(), Vec::new());
    for triple in triples {
        let [a, b, c] = triple;
        let corners = [parse_corner(a)?, parse_corner(b)?, parse_corner(c)?];
        if exact && corners.iter().any(|corner| corner.values.is_some()) {
            return Err(usage(
                "with --exact a corner is X,Y alone: without the lattice there are pixels, but no values",
            ));
        }
        list.push(triangle(triple, &corners)?);
        let px = corners.map(|corner| corner.px);
        typed.push(FreeCorners::new(px).map_err(|refusal| usage(format!("'{a}': {refusal}")))?);
    }
    let title = match triples {
        [[a, b, c]] => format!("triangle {a} {b} {c}"),
        _ => format!("{} triangles", list.len()),
    };
    let window = window_of(&list, screen);
    let disjoint = list.len() == 1;
    let case = Case { window, shape: Shape::Triangles { list, disjoint } };
    Ok(InspectedCase::Case { title, case, expected: None, typed })
}

/// The corners on the lattice, with the values that were typed with them, or simple ones.
fn triangle(words: &[String; 3], corners: &[Corner; 3]) -> Result<Triangle, InputError> {
    let at = |i: usize| {
        let [x, y] = corners[i].px;
        let on_grid = |name, px| {
            snap(px).map_err(|refusal| {
                usage(format!("'{}': {}", words[i], refused_number(name, refusal)))
            })
        };
        Ok::<_, InputError>(SubpixelPoint::new(on_grid("x", x)?, on_grid("y", y)?))
    };
    let mut triangle = plain_triangle([at(0)?, at(1)?, at(2)?]);
    for (i, Corner { px: [x, y], values }) in corners.iter().enumerate() {
        let Some([w, depth, u, v]) = *values else { continue };
        let checked = |name, value| check_value(value).map_err(|refusal| (name, refusal));
        let vertex = checked("u", u)
            .and(checked("v", v))
            .and_then(|()| ScreenVertex::by_name([*x, *y], depth, w, DVec2::new(u, v)));
        triangle.vertices[i] = vertex.map_err(|(name, refusal)| {
            // The options call it by its whole name.
            let name = if name == "z" { "depth" } else { name };
            usage(format!("'{}': {}", words[i], refused_number(name, refusal)))
        })?;
    }
    Ok(triangle)
}

/// A case of this name, a recorded input, or a case of a family by its number.
fn called(word: &str, arguments: &CaseArguments) -> Result<InspectedCase, InputError> {
    if let Some((family, number)) = word.split_once('#') {
        let index = number.parse::<u64>().map_err(|_| {
            usage(format!(
                "{word}: expected the number of a case after '#', for example {family}#123"
            ))
        });
        let title = |about: &str| format!("{word} of seed {}: {about}", arguments.seed);
        let found = cases::all_families().find(|f| f.name == family);
        let names = cases::all_families().map(|f| f.name);
        let family = found.ok_or_else(|| unknown("family", family, names))?;
        return Ok(plain(title(family.about), family.case(arguments.seed, index?)));
    }
    if let Some(case) = recorded(&arguments.what) {
        return Ok(recorded_case(case));
    }
    if cases::all_families().any(|f| f.name == word) {
        return Err(usage(format!("{word} is a family: add the number of a case, {word}#0")));
    }
    if Path::new(word).is_file() {
        return Err(usage(format!("{word} is a file: add the number of a face, {word}#1")));
    }
    let names = named::named().into_iter().map(|case| case.name);
    let names: Vec<_> = names.chain(RECORDED.iter().map(|case| case.name)).collect();
    let named = named::find(word).ok_or_else(|| unknown("case", word, names.into_iter()))?;
    let title = format!("{}: {}", named.name, named.about);
    Ok(match named.input {
        Input::Drawn { case, pixels } => {
            InspectedCase::Case { title, case, expected: Some(pixels), typed: Vec::new() }
        }
        Input::Refused(corners) => InspectedCase::Refused { title, corners },
    })
}

/// A recorded input off the lattice, in the part of its screen that it or its specimen touches.
fn recorded_case(case: &RecordedCase) -> InspectedCase {
    let title =
        format!("{}: recorded of the book's own code, shown by {}", case.name, case.specimen);
    let corners = case.corners_px();
    let all = corners.iter().flatten();
    let side = f64::from(RECORDED_SIDE_PX);
    let range = |axis: usize| {
        let (low, high) = all
            .clone()
            .fold((side, 0.0), |(low, high): (f64, f64), p| (low.min(p[axis]), high.max(p[axis])));
        // Two pixels to spare, within the screen.
        let within = |px: f64| px.clamp(0.0, side) as i32;
        (within(low.floor() - 2.0), within(high.ceil() + 2.0))
    };
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    let triangles: Result<_, _> = corners.iter().map(|&t| FreeCorners::new(t)).collect();
    let window = PixelRect { x0, y0, x1, y1 };
    match triangles {
        Ok(triangles) => plain(title, Case::unsnapped(window, triangles)),
        Err(_) => InspectedCase::Refused { title, corners },
    }
}

/// An error for a name that is not there, with the nearest one that is.
fn unknown(kind: &str, word: &str, names: impl Iterator<Item = &'static str>) -> InputError {
    let hint = did_you_mean(word, names);
    usage(format!("no {kind} is called '{word}'{hint} See: {} list", program()))
}

/// A point without the parentheses that it may be printed with.
fn bare(text: &str) -> &str {
    let text = text.trim();
    text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(text)
}

/// A corner as it is typed: a position, and w, depth, u and v where they are given.
struct Corner {
    px: [f64; 2],
    values: Option<[f64; 4]>,
}

fn parse_corner(text: &str) -> Result<Corner, InputError> {
    let numbers: Option<Vec<f64>> =
        bare(text).split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([x, y]) => Ok(Corner { px: [*x, *y], values: None }),
        Some([x, y, more @ ..]) if (1..=4).contains(&more.len()) => {
            let mut values = [1.0, 0.0, 0.0, 0.0];
            values[..more.len()].copy_from_slice(more);
            Ok(Corner { px: [*x, *y], values: Some(values) })
        }
        _ => Err(usage(format!(
            "'{text}' is not a point: expected X,Y in pixels, for example 0.5,3 (or a named case)"
        ))),
    }
}

pub(super) fn parse_pixel(text: &str) -> Result<PixelPoint, InputError> {
    let numbers = bare(text).split_once(',');
    let numbers = numbers.and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    let (x, y) = numbers.ok_or_else(|| {
        usage(format!("'{text}' is not a pixel: expected two whole numbers X,Y within 32 bits, for example 8,3"))
    })?;
    Ok(PixelPoint::new(x, y))
}

/// The file and the number of `FILE#NUMBER`, where there is such a file and no family of that name.
pub(super) fn face_of_file(words: &[String]) -> Option<(&Path, &str)> {
    let [word] = words else { return None };
    let (file, number) = word.rsplit_once('#')?;
    let is_family = cases::all_families().any(|f| f.name == file);
    let path = Path::new(file);
    let looks_like_file = path.extension().is_some() || path.is_file();
    (!is_family && looks_like_file).then_some((path, number))
}

/// The pixels around triangles where they are few, else some of them from the first that is drawn.
///
/// That pixel is looked for by an engine, since the oracle would test each of the pixels around.
fn window_of(list: &[Triangle], screen: Option<PixelRect>) -> PixelRect {
    let corners = list.iter().flat_map(ScreenTriangle::corners);
    let all = all_around(corners.map(|p| [p.x, p.y].map(|sub| sub.div_euclid(SUBPIXELS))));
    let all = screen.map_or(all, |screen| all.intersect(&screen));
    let is_small = [all.width(), all.height()].iter().all(|side| *side <= MOST_AROUND_PX as u32);
    let corner = PixelRect { x1: cut(all.x0, all.x1), y1: cut(all.y0, all.y1), ..all };
    if is_small {
        return corner;
    }
    let drawn = |rows: PixelRect, of_span: &mut dyn FnMut(Span)| {
        list.iter().for_each(|triangle| Scanline.cover(triangle.corners(), rows, &mut *of_span));
    };
    // Twice as many rows each time, so that few are looked at behind the first that is drawn.
    let (mut start, mut count) = (all.y0, MOST_AROUND_PX);
    let mut first: Option<(i32, i32)> = None;
    while first.is_none() && start < all.y1 {
        let end = all.y1.min(start.saturating_add(count));
        drawn(PixelRect { y0: start, y1: end, ..all }, &mut |span| {
            let pixel = (span.y_px, span.x0_px);
            first = Some(first.map_or(pixel, |first| first.min(pixel)));
        });
        (start, count) = (end, count.saturating_mul(2));
    }
    let Some((y, x)) = first else { return corner };
    // One pixel to spare, as around a small triangle.
    let y0 = y.saturating_sub(1).min(all.y1.saturating_sub(MOST_AROUND_PX)).max(all.y0);
    let rows = PixelRect { y0, y1: cut(y0, all.y1), ..all };
    let (mut least, mut most) = (x, x);
    drawn(rows, &mut |span| {
        least = least.min(span.x0_px);
        most = most.max(span.x1_px);
    });
    let all_fits = most.saturating_sub(least) < MOST_AROUND_PX;
    let x0 = if all_fits { least } else { x }.saturating_sub(1);
    // Not so far to the right that the window gets narrow.
    let x0 = x0.min(all.x1.saturating_sub(MOST_AROUND_PX)).max(all.x0);
    PixelRect { x0, x1: cut(x0, all.x1), ..rows }
}

/// The end of a window that begins here.
fn cut(start: i32, end: i32) -> i32 {
    end.min(start.saturating_add(MOST_AROUND_PX))
}

/// The pixels around these, with one to spare.
pub(super) fn all_around(pixels: impl Iterator<Item = [i32; 2]> + Clone) -> PixelRect {
    let range = |axis: usize| {
        let along = pixels.clone().map(|pixel| pixel[axis]);
        let low = along.clone().min().unwrap_or(0).saturating_sub(1);
        (low, along.max().unwrap_or(0).saturating_add(2))
    };
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    PixelRect { x0, y0, x1, y1 }
}
