//! The words of `inspect` as a case: its name, its number in a family, or its corners.
//!
//! Words that name something are looked up; all others are points. What cannot be a case is refused with an example of what
//! can. A case that is typed as points has no window of its own, so one is chosen around its shape.

use std::path::Path;

use glam::DVec2;

use super::{InputError, did_you_mean, pair, program, usage};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{PixelRect, Refusal, SUBPIXELS, SubpixelPoint, snap};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{
    FreeCorners, PixelPoint, ScreenTriangle, ScreenVertex, Span, check_value, refused_number,
};
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX, RecordedCase};
use rasterproof_registry::named;
use rasterproof_verify::cases::named::{Input, plain_line, plain_triangle};
use rasterproof_verify::cases::{self, Case, Family, Line, Shape, Triangle};

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

/// What `inspect` shows.
pub(super) enum InspectedCase {
    Case(TitledCase),
    /// Corners that no triangle may have, of which the reasons are shown.
    Refused {
        title: String,
        corners: Vec<[[f64; 2]; 3]>,
    },
}

/// A case that is drawn, and what is known of it besides.
pub(super) struct TitledCase {
    pub title: String,
    pub case: Case,
    /// The pixels of a case whose name states them.
    pub expected: Option<Vec<u64>>,
    /// The corners of a case on the lattice as they were typed, if they were.
    pub typed: Vec<FreeCorners>,
}

/// A case of which nothing but its shape is known.
fn plain(title: String, case: Case) -> InspectedCase {
    InspectedCase::Case(TitledCase { title, case, expected: None, typed: Vec::new() })
}

/// The case that the words of the command line name or list.
pub(super) fn find(arguments: &CaseArguments) -> Result<InspectedCase, InputError> {
    let words = words(arguments);
    let found = match words.as_slice() {
        // With --line every word is a pixel, also where a case has such a name.
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

/// The same corners, for those who do not snap: as they were typed, where they were, else as they lie on the lattice.
pub(super) fn off_lattice(found: InspectedCase) -> Result<InspectedCase, InputError> {
    let InspectedCase::Case(mut found) = found else { return Ok(found) };
    match found.case.shape {
        Shape::Triangles { list, .. } => {
            let mut triangles = found.typed;
            if triangles.is_empty() {
                triangles.extend(list.iter().map(|t| FreeCorners::from(t.corners())));
            }
            Ok(plain(found.title, Case::unsnapped(found.case.window, triangles)))
        }
        Shape::Lines(_) => Err(usage("lines join whole pixels: leave out --exact")),
        // They are off the lattice already, or are no corners.
        shape @ (Shape::Unsnapped { .. } | Shape::Numbers { .. }) => {
            found.case.shape = shape;
            Ok(InspectedCase::Case(found))
        }
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

/// Lines by their ends, in the window around them.
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
    let window = upper_left_of(box_of_lines(&list));
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
    // Each triangle is kept twice: on the lattice, and with the corners that were typed.
    let (mut list, mut typed) = (Vec::new(), Vec::new());
    for triple in triples {
        let [a, b, c] = triple;
        let corners = [parse_corner(a)?, parse_corner(b)?, parse_corner(c)?];
        // Values are interpolated by integers, which corners off the lattice do not have.
        if exact && corners.iter().any(|corner| corner.values.is_some()) {
            return Err(usage(
                "with --exact a corner is X,Y alone: without the lattice there are pixels, but no values",
            ));
        }
        list.push(triangle(triple, &corners)?);
        let px = corners.map(|corner| corner.px);
        typed.push(FreeCorners::new(px).map_err(|refusal| usage(format!("'{a}': {refusal}")))?);
    }
    // Typed points are one case, which has one window; its title lists the points where they are few.
    let title = match triples {
        [[a, b, c]] => format!("triangle {a} {b} {c}"),
        _ => format!("{} triangles", list.len()),
    };
    let window = window_of(&list, screen);
    // Several that are typed may overlap.
    let disjoint = list.len() == 1;
    let case = Case { window, shape: Shape::Triangles { list, disjoint } };
    Ok(InspectedCase::Case(TitledCase { title, case, expected: None, typed }))
}

/// The corners on the lattice, with the values that were typed with them, or simple ones.
fn triangle(words: &[String; 3], corners: &[Corner; 3]) -> Result<Triangle, InputError> {
    let mut positions = [SubpixelPoint::new(0, 0); 3];
    for (i, corner) in corners.iter().enumerate() {
        positions[i] = on_lattice(&words[i], corner.px)?;
    }
    // Corners without values keep those of the plain triangle.
    let mut triangle = plain_triangle(positions);
    for (i, corner) in corners.iter().enumerate() {
        let Some([w, depth, u, v]) = corner.values else { continue };
        for (name, value) in [("u", u), ("v", v)] {
            check_value(value).map_err(|refusal| refused_word(&words[i], name, refusal))?;
        }
        let vertex = ScreenVertex::by_name(corner.px, depth, w, DVec2::new(u, v));
        triangle.vertices[i] =
            vertex.map_err(|(name, refusal)| refused_word(&words[i], name, refusal))?;
    }
    Ok(triangle)
}

/// A position on the lattice.
fn on_lattice(word: &str, [x, y]: [f64; 2]) -> Result<SubpixelPoint, InputError> {
    let x = snap(x).map_err(|refusal| refused_word(word, "x", refusal))?;
    let y = snap(y).map_err(|refusal| refused_word(word, "y", refusal))?;
    Ok(SubpixelPoint::new(x, y))
}

/// Which number of a word is refused, and why.
fn refused_word(word: &str, name: &str, refusal: Refusal) -> InputError {
    // The help calls it by its whole name.
    let name = if name == "z" { "depth" } else { name };
    usage(format!("'{word}': {}", refused_number(name, refusal)))
}

/// A case of this name, a recorded input, or a case of a family by its number.
fn called(word: &str, arguments: &CaseArguments) -> Result<InspectedCase, InputError> {
    if let Some((family, number)) = word.split_once('#') {
        return numbered(word, family, number, arguments.seed);
    }
    if let Some(case) = recorded(&arguments.what) {
        return Ok(recorded_case(case));
    }
    // Two words that lack a number only, and would be unknown cases otherwise.
    if family(word).is_some() {
        return Err(usage(format!("{word} is a family: add the number of a case, {word}#0")));
    }
    if Path::new(word).is_file() {
        return Err(usage(format!("{word} is a file: add the number of a face, {word}#1")));
    }
    let Some(named) = named::find(word) else {
        let mut names: Vec<_> = named::named().into_iter().map(|case| case.name).collect();
        names.extend(RECORDED.iter().map(|case| case.name));
        return Err(unknown("case", word, &names));
    };
    let title = format!("{}: {}", named.name, named.about);
    Ok(match named.input {
        Input::Drawn { case, pixels } => {
            let (expected, typed) = (Some(pixels), Vec::new());
            InspectedCase::Case(TitledCase { title, case, expected, typed })
        }
        Input::Refused(corners) => InspectedCase::Refused { title, corners },
    })
}

/// The family of this name, on the lattice or off it.
fn family(name: &str) -> Option<&'static Family> {
    cases::all_families().find(|family| family.name == name)
}

/// A case of a family by its number, as `word` names it: FAMILY#NUMBER.
fn numbered(word: &str, name: &str, number: &str, seed: u64) -> Result<InspectedCase, InputError> {
    let Some(family) = family(name) else {
        let names: Vec<_> = cases::all_families().map(|family| family.name).collect();
        return Err(unknown("family", name, &names));
    };
    let Ok(index) = number.parse() else {
        let example = format!("for example {name}#123");
        return Err(usage(format!("{word}: expected the number of a case after '#', {example}")));
    };
    let title = format!("{word} of seed {seed}: {}", family.about);
    Ok(plain(title, family.case(seed, index)))
}

/// A recorded input off the lattice, in the part of its screen that it or its specimen touches.
fn recorded_case(case: &RecordedCase) -> InspectedCase {
    let title =
        format!("{}: recorded of the book's own code, shown by {}", case.name, case.specimen);
    let corners = case.corners_px();
    // The box of all corners on the screen.
    let side = f64::from(RECORDED_SIDE_PX);
    let (mut low, mut high) = ([side; 2], [0.0_f64; 2]);
    for corner in corners.iter().flatten() {
        for axis in 0..2 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    // Two pixels to spare, within the screen.
    let [x0, y0] = low.map(|px| (px.floor() - 2.0).clamp(0.0, side) as i32);
    let [x1, y1] = high.map(|px| (px.ceil() + 2.0).clamp(0.0, side) as i32);
    let window = PixelRect { x0, y0, x1, y1 };
    let triangles: Result<_, _> = corners.iter().copied().map(FreeCorners::new).collect();
    match triangles {
        Ok(triangles) => plain(title, Case::unsnapped(window, triangles)),
        Err(_) => InspectedCase::Refused { title, corners },
    }
}

/// An error for a name that is not there, with the nearest one that is.
fn unknown(kind: &str, word: &str, names: &[&'static str]) -> InputError {
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

/// A corner of two to six numbers; those of its values that are left out are 1 for w, and else 0.
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

/// A pixel by its column and its row.
pub(super) fn parse_pixel(text: &str) -> Result<PixelPoint, InputError> {
    let Some((x, y)) = pair(bare(text), &[',']) else {
        let expected = "two whole numbers X,Y within 32 bits, for example 8,3";
        return Err(usage(format!("'{text}' is not a pixel: expected {expected}")));
    };
    Ok(PixelPoint::new(x, y))
}

/// The file and the number of `FILE#NUMBER`, where there is such a file and no family of that name.
pub(super) fn face_of_file(words: &[String]) -> Option<(&Path, &str)> {
    let [word] = words else { return None };
    let (file, number) = word.rsplit_once('#')?;
    let path = Path::new(file);
    // A name with an ending is meant as a file, and the error says so where there is none.
    let looks_like_file = path.extension().is_some() || path.is_file();
    (family(file).is_none() && looks_like_file).then_some((path, number))
}

/// The pixels around triangles where they are few, else some of them from the first that is drawn.
///
/// That pixel is looked for by an engine, since the oracle would test each of the pixels around.
fn window_of(list: &[Triangle], screen: Option<PixelRect>) -> PixelRect {
    let mut all = box_of_triangles(list);
    if let Some(screen) = screen {
        all = all.intersect(&screen);
    }
    let corner = upper_left_of(all);
    if corner == all {
        return corner;
    }
    let Some((y, x)) = first_drawn(list, all) else { return corner };
    // One pixel to spare, as around a small triangle.
    let y0 = y.saturating_sub(1).min(all.y1.saturating_sub(MOST_AROUND_PX)).max(all.y0);
    let rows = PixelRect { y0, y1: cut(y0, all.y1), ..all };
    // In these rows all that is drawn is shown where it fits, else it is shown from the first pixel on.
    let (mut least, mut most) = (x, x);
    each_span(list, rows, &mut |span| {
        least = least.min(span.x0_px);
        most = most.max(span.x1_px);
    });
    let all_fits = most.saturating_sub(least) < MOST_AROUND_PX;
    let x0 = if all_fits { least } else { x }.saturating_sub(1);
    // Not so far to the right that the window gets narrow.
    let x0 = x0.min(all.x1.saturating_sub(MOST_AROUND_PX)).max(all.x0);
    PixelRect { x0, x1: cut(x0, all.x1), ..rows }
}

/// Hands on each span that triangles have in a window.
fn each_span(list: &[Triangle], window: PixelRect, of_span: &mut dyn FnMut(Span)) {
    for triangle in list {
        Scanline.cover(triangle.corners(), window, &mut *of_span);
    }
}

/// The row and the column of the first pixel that is drawn in a window.
fn first_drawn(list: &[Triangle], all: PixelRect) -> Option<(i32, i32)> {
    // Twice as many rows each time, so that few are looked at behind the first that is drawn.
    let (mut start, mut count) = (all.y0, MOST_AROUND_PX);
    let mut first: Option<(i32, i32)> = None;
    while first.is_none() && start < all.y1 {
        let end = all.y1.min(start.saturating_add(count));
        each_span(list, PixelRect { y0: start, y1: end, ..all }, &mut |span| {
            let pixel = (span.y_px, span.x0_px);
            first = Some(first.unwrap_or(pixel).min(pixel));
        });
        (start, count) = (end, count.saturating_mul(2));
    }
    first
}

/// The end of a window that begins here.
fn cut(start: i32, end: i32) -> i32 {
    end.min(start.saturating_add(MOST_AROUND_PX))
}

/// The upper left part of some pixels, where they are more than a window shows.
fn upper_left_of(all: PixelRect) -> PixelRect {
    PixelRect { x1: cut(all.x0, all.x1), y1: cut(all.y0, all.y1), ..all }
}

/// The pixels around a shape, with one to spare; of a shape without corners those of its window.
pub(super) fn box_of(case: &Case) -> PixelRect {
    match &case.shape {
        Shape::Triangles { list, .. } => box_of_triangles(list),
        Shape::Lines(list) => box_of_lines(list),
        Shape::Unsnapped { list, .. } => {
            let mut pixels = Vec::new();
            for triangle in list {
                pixels.extend(triangle.px().map(|corner| corner.map(|px| px.floor() as i32)));
            }
            box_around(&pixels)
        }
        Shape::Numbers { .. } => case.window,
    }
}

fn box_of_triangles(list: &[Triangle]) -> PixelRect {
    let mut pixels = Vec::new();
    for corner in list.iter().flat_map(ScreenTriangle::corners) {
        pixels.push([corner.x, corner.y].map(|sub| sub.div_euclid(SUBPIXELS)));
    }
    box_around(&pixels)
}

fn box_of_lines(list: &[Line]) -> PixelRect {
    let mut pixels = Vec::new();
    for line in list {
        pixels.extend(line.ends.map(|end| [end.pixel.x, end.pixel.y]));
    }
    box_around(&pixels)
}

/// The smallest box that holds some pixels and one more on each side.
fn box_around(pixels: &[[i32; 2]]) -> PixelRect {
    let mut low = pixels.first().copied().unwrap_or_default();
    let mut high = low;
    for pixel in pixels {
        for axis in 0..2 {
            low[axis] = low[axis].min(pixel[axis]);
            high[axis] = high[axis].max(pixel[axis]);
        }
    }
    // The ends of a window are behind its last pixels.
    let ([x0, y0], [x1, y1]) =
        (low.map(|px| px.saturating_sub(1)), high.map(|px| px.saturating_add(2)));
    PixelRect { x0, y0, x1, y1 }
}
