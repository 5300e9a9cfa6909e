//! The sheet of a case: a panel for each engine with its name and its counts, rows and columns
//! numbered, cropped to what matters, and a legend of what occurs.

use std::collections::BTreeSet;

use image::{Rgb, RgbImage};

use super::lettering::{self, Size, write};
use super::picture::{
    AGREES, BACKGROUND, BORDER, EDGE, EXTRA, GRID, MISSING, OVERLAP, OWNERS, SAMPLE, TWICE, line,
    outline, painted, place, plain, scaled,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::PixelPoint;
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{Tally, oracle_coverage};

/// Sides of a sheet's panels together stay below this.
const MOST_PX: [u32; 2] = [1400, 1000];
/// Larger cases are cropped to the pixels that differ.
const MOST_CROPPED_PX: u32 = 48;
/// Picture pixels of a pixel's side from which the dot of its sample is shown.
const SAMPLED: u32 = 8;
/// Room around everything and between panels.
const GAP: u32 = 12;
/// Room for the numbers of the columns, and the least for those of the rows.
const ABOVE: u32 = 16;
const BESIDE: u32 = 34;
/// The colours of words: headings, and what stands below them.
pub const INK: Rgb<u8> = Rgb([30, 30, 30]);
pub const FAINT: Rgb<u8> = Rgb([95, 95, 95]);
const WHITE: Rgb<u8> = Rgb([255, 255, 255]);

/// The name of an engine, and what it draws.
pub type EnginePicture = (String, Coverage);

/// What each engine draws, judged by `target`; then the target, as `oracle`.
///
/// All coverages show the case's window.
pub fn of_case(title: &str, case: &Case, actual: &[EnginePicture], target: &Coverage) -> RgbImage {
    // Of a few triangles side by side, the right pixels have the colour of their triangle.
    let (window, owners, segments) = (case.window, owners(case, target), outline(case));
    let oracle = [("oracle".to_owned(), target.clone())];
    let all: Vec<&EnginePicture> = actual.iter().chain(&oracle).collect();
    // The panels show the same part of the window, as large as all of them fit.
    let shown = crop(window, &all, target, &scaled(&segments, window, 1));
    let (zoom, columns) = layout(shown, all.len() as u32);
    let outlines = scaled(&segments, shown, zoom);
    // Each engine with its counts below its name, and the oracle last.
    let is_line = matches!(case.shape, Shape::Lines(_));
    let mut occurring = BTreeSet::new();
    let mut panels = Vec::new();
    for (name, hits) in &all {
        let colour = |x_px, y_px| {
            let of = |hits: &Coverage| hits.get(x_px, y_px).unwrap_or(0);
            colour(of(hits), of(target), owners.as_ref().map_or(0, of))
        };
        for (x, y) in pixels(shown) {
            occurring.insert(colour(x, y).0);
        }
        let counts = (counts(hits, target), Size::Small, FAINT);
        let words = [(name.clone(), Size::Heading, INK), counts];
        panels.push(panel(&words, (shown, zoom, true), &outlines, &colour));
    }
    // The legend of what occurs: triangles that have a colour of their own, then the others.
    let mut entries: Vec<Entry> = Vec::new();
    for (number, colour) in (1..).zip(OWNERS) {
        if occurring.contains(&colour.0) {
            entries.push((vec![colour], format!("right: triangle {number}")));
        }
    }
    let edges = if is_line { "the line itself" } else { "edges" };
    for (occurs, colour, text) in [
        (occurring.contains(&AGREES.0), AGREES, "as the oracle"),
        (occurring.contains(&MISSING.0), MISSING, "missing"),
        (occurring.contains(&EXTRA.0), EXTRA, "extra"),
        (occurring.contains(&TWICE.0), TWICE, "hit too often"),
        (occurring.contains(&OVERLAP.0), OVERLAP, "rightly more than once"),
        (true, EDGE, edges),
        (zoom >= SAMPLED, SAMPLE, "samples"),
    ] {
        if occurs {
            entries.push((vec![colour], text.to_owned()));
        }
    }
    let mut note = String::new();
    if shown != window {
        let (x, y) = (shown.x1 - 1, shown.y1 - 1);
        let PixelRect { x0, y0, .. } = shown;
        let (width, height) = (window.width(), window.height());
        note = format!("columns {x0} to {x}, rows {y0} to {y} of {width} x {height} px");
    }
    arranged(&[(title.to_owned(), Size::Heading, INK)], panels, columns, &entries, &note)
}

/// A line of words, in a size and a colour.
pub(super) type Words = (String, Size, Rgb<u8>);

/// Words, below them pictures in so many columns, below these what the colours mean, and a note.
pub fn arranged(
    words: &[Words],
    cells: Vec<RgbImage>,
    columns: u32,
    entries: &[Entry],
    note: &str,
) -> RgbImage {
    let wide = cells.iter().map(|cell| cell.width()).max().unwrap_or(1);
    let high = cells.iter().map(|cell| cell.height()).max().unwrap_or(1);
    // All cells are as large as the largest one, so that columns line up.
    let rows = (cells.len() as u32).div_ceil(columns);
    let width = (GAP + columns * (wide + GAP)).max(420);
    // The words are broken into lines first, for their number decides where the cells begin.
    let mut heading = Vec::new();
    let mut top = GAP;
    for (text, size, ink) in words {
        for line in lettering::wrapped(text, *size, width - 2 * GAP) {
            heading.push((line, top, *size, *ink));
            top += size.cell()[1];
        }
    }
    top += GAP / 2;
    // The legend is as high as it needs to be at this width.
    let foot = foot(width, entries, note);
    let height = top + rows * (high + GAP) + foot.height();
    let mut image = plain(width, height, WHITE);
    for (text, y, size, ink) in heading {
        write(&mut image, (GAP.into(), y.into()), &text, size, ink);
    }
    for (i, cell) in (0u32..).zip(cells) {
        let (left, top) = (GAP + i % columns * (wide + GAP), top + i / columns * (high + GAP));
        place(&mut image, &cell, left, top);
    }
    place(&mut image, &foot, 0, height - foot.height());
    image
}

/// The number of the triangle that the oracle gives each pixel to, from 1, where a few triangles lie side by side and no
/// pixel is hit twice: then the picture shows who gets the pixels of an edge.
fn owners(case: &Case, target: &Coverage) -> Option<Coverage> {
    let Shape::Triangles { list, .. } = &case.shape else { return None };
    // Where a pixel belongs to two triangles, no colour can say which.
    let once = target.rows().all(|(_, row)| row.iter().all(|&hits| hits <= 1));
    if !once || !(2..=OWNERS.len()).contains(&list.len()) {
        return None;
    }
    let mut owners = Coverage::new(case.window, 0);
    for (number, triangle) in (1..).zip(list) {
        for (y, row) in oracle_coverage(std::slice::from_ref(triangle), case.window).rows() {
            for (owner, hits) in owners.row_mut(y).iter_mut().zip(row) {
                if *hits > 0 {
                    *owner = number;
                }
            }
        }
    }
    Some(owners)
}

/// The part of the window that is worth seeing: the shape and what is hit, a pixel to spare. Of a
/// large one, the pixels that differ, or those that are hit.
fn crop(
    window: PixelRect,
    all: &[&EnginePicture],
    target: &Coverage,
    outline: &[[PixelPoint; 2]],
) -> PixelRect {
    let hits = |c: &Coverage, x: i32, y: i32| c.get(x, y).unwrap_or(0);
    // What is hit, what differs, and where the shape is, each with some pixels around it.
    let hit = around(window, |x, y| all.iter().any(|(_, c)| hits(c, x, y) > 0), 1);
    let wrong =
        around(window, |x, y| all.iter().any(|(_, c)| hits(c, x, y) != hits(target, x, y)), 4);
    // The outline belongs to what is worth seeing, as far as it lies in the window.
    let mut shape = hit.unwrap_or(PixelRect { x1: window.x0, y1: window.y0, ..window });
    let is_hit = hit.is_some();
    for (i, p) in outline.iter().flatten().enumerate() {
        let at = |v: i32, origin: i32, end: i32| v.saturating_add(origin).clamp(origin, end - 1);
        let place = (at(p.x, window.x0, window.x1), at(p.y, window.y0, window.y1));
        let spare = wider(pixel(place), 1, window);
        shape = if i == 0 && !is_hit { spare } else { union(shape, spare) };
    }
    let is_small = |r: &PixelRect| r.width().max(r.height()) <= MOST_CROPPED_PX;
    // A small case is shown as a whole, of a large one what differs.
    let shape = Some(shape).filter(|r| r.width() > 0 && r.height() > 0);
    shape.filter(is_small).or(wrong).or(hit).or(shape).unwrap_or(window)
}

fn union(a: PixelRect, b: PixelRect) -> PixelRect {
    PixelRect { x0: a.x0.min(b.x0), y0: a.y0.min(b.y0), x1: a.x1.max(b.x1), y1: a.y1.max(b.y1) }
}

/// The box around the pixels of a kind, some to spare, within the window.
fn around(window: PixelRect, is_in: impl Fn(i32, i32) -> bool, spare: i32) -> Option<PixelRect> {
    let boxes = pixels(window).filter(|&(x, y)| is_in(x, y)).map(pixel);
    Some(wider(boxes.reduce(union)?, spare, window))
}

fn pixel((x0, y0): (i32, i32)) -> PixelRect {
    PixelRect { x0, y0, x1: x0 + 1, y1: y0 + 1 }
}

/// A box with some to spare, within the window.
fn wider(PixelRect { x0, y0, x1, y1 }: PixelRect, spare: i32, window: PixelRect) -> PixelRect {
    let wide = PixelRect {
        x0: x0.saturating_sub(spare),
        y0: y0.saturating_sub(spare),
        x1: x1.saturating_add(spare),
        y1: y1.saturating_add(spare),
    };
    wide.intersect(&window)
}

/// The zoom, and how many panels stand in a row: as large as they get.
fn layout(shown: PixelRect, count: u32) -> (u32, u32) {
    // A case of a few pixels is shown larger.
    let largest = if shown.width().max(shown.height()) <= 8 { 40 } else { 16 };
    let mut best = (0, 1);
    for columns in 1..=count.max(1) {
        let rows = count.div_ceil(columns);
        let across = MOST_PX[0] / columns.saturating_mul(shown.width()).max(1);
        let down = MOST_PX[1] / rows.saturating_mul(shown.height()).max(1);
        // The most panels in a row of those that are equally large.
        best = best.max((across.min(down).clamp(1, largest), columns));
    }
    best
}

/// The width of the longest number of a row, at least so much that panels line up.
fn left_of(shown: PixelRect) -> u32 {
    let wide = |n: i32| lettering::width(&n.to_string(), Size::Small) + 6;
    wide(shown.y0).max(wide(shown.y1 - 1)).max(BESIDE)
}

/// Pictures side by side, each below its name.
pub fn beside(title: &str, pictures: &[(&str, RgbImage)]) -> RgbImage {
    let mut cells = Vec::new();
    for (name, picture) in pictures {
        cells.push(titled(&[((*name).to_owned(), Size::Small, INK)], picture, [0, 0]));
    }
    let columns = cells.len() as u32;
    arranged(&[(title.to_owned(), Size::Heading, INK)], cells, columns, &[], "")
}

/// A picture below some words, with room left of it and above.
pub(super) fn titled(words: &[Words], picture: &RgbImage, [left, above]: [u32; 2]) -> RgbImage {
    // As wide as the picture or the longest line, whichever is wider.
    let text = words.iter().map(|(text, size, _)| lettering::width(text, *size)).max();
    let wide = left + picture.width().max(text.unwrap_or(0));
    let top = head(words) + above;
    let mut image = plain(wide, top + picture.height(), WHITE);
    let mut y = 0;
    for (text, size, ink) in words {
        write(&mut image, (left.into(), y.into()), text, *size, *ink);
        y += size.cell()[1];
    }
    place(&mut image, picture, left, top);
    image
}

/// The height of words above a picture.
fn head(words: &[Words]) -> u32 {
    words.iter().map(|(_, size, _)| size.cell()[1]).sum::<u32>() + 2
}

/// Each pixel as a square of its colour, with an outline over them, numbered rows and columns, and a dot for each sample where
/// these are shown.
pub fn panel(
    words: &[Words],
    (shown, zoom, has_samples): (PixelRect, u32, bool),
    outline: &[[PixelPoint; 2]],
    colour: &dyn Fn(i32, i32) -> Rgb<u8>,
) -> RgbImage {
    let mut picture = squares(shown, zoom, has_samples, colour);
    // The outline lies over the squares, cut off at their border.
    let bounds = PixelRect::window(picture.width(), picture.height());
    for segment in outline {
        line(*segment, bounds, |x, y| picture.put_pixel(x, y, EDGE));
    }
    // Numbers stand outside of the squares.
    let left = left_of(shown);
    let mut image = titled(words, &picture, [left, ABOVE]);
    numbers(&mut image, [left, head(words) + ABOVE], shown, zoom);
    image
}

/// What is wrong in words, or how many pixels are right.
fn counts(hits: &Coverage, target: &Coverage) -> String {
    let Tally { missing, extra, twice, .. } = Tally::between(hits, target);
    let mut wrong = Vec::new();
    for (pixels, word) in [(missing, "missing"), (extra, "extra"), (twice, "twice")] {
        if pixels > 0 {
            wrong.push(format!("{pixels} {word}"));
        }
    }
    // Without a difference the count of pixels is all there is to say.
    let covered = format!("{} px", hits.covered());
    if wrong.is_empty() { covered } else { format!("{covered}: {}", wrong.join(", ")) }
}

/// Numbers of columns over the squares, of rows left of them, as many as fit. The squares begin at `left` and `top`.
fn numbers(image: &mut RgbImage, [left, top]: [u32; 2], shown: PixelRect, zoom: u32) {
    let widest = [shown.x0, shown.x1 - 1].map_array(|n| n.to_string().len() as u32);
    // A number takes as many letters as the longest one in its direction.
    let [cell_width, cell_height] = Size::Small.cell();
    // In picture pixels: a number and a gap beside it, or the height of a line.
    let rooms = [widest[0].max(widest[1]) * cell_width + 5, 13];
    let steps = rooms.map_array(|room| step_of_numbers(room, zoom));
    for x in (shown.x0..shown.x1).filter(|x| x.rem_euclid(steps[0]) == 0) {
        let text = x.to_string();
        // A number stands over the middle of its column, unless it would be cut off.
        let middle = left + (x - shown.x0) as u32 * zoom + zoom / 2;
        let half = lettering::width(&text, Size::Small) / 2;
        if middle + half > image.width() {
            continue;
        }
        let place = (i64::from(middle) - i64::from(half), i64::from(top) - i64::from(ABOVE));
        write(image, place, &text, Size::Small, FAINT);
    }
    for y in (shown.y0..shown.y1).filter(|y| y.rem_euclid(steps[1]) == 0) {
        let text = y.to_string();
        // And beside the middle of its row.
        let middle = top + (y - shown.y0) as u32 * zoom + zoom / 2;
        let from = i64::from(left) - 4 - i64::from(lettering::width(&text, Size::Small));
        let place = (from, i64::from(middle) - i64::from(cell_height / 2));
        write(image, place, &text, Size::Small, FAINT);
    }
}

/// The least step of 1, 2, 5, 10, 20 and so on at which a number is not wider than the pixels up to the next one.
fn step_of_numbers(room: u32, zoom: u32) -> i32 {
    for power in [1, 10, 100, 1000, 10_000, 100_000] {
        for step in [power, 2 * power, 5 * power] {
            if step as u32 * zoom >= room {
                return step;
            }
        }
    }
    1_000_000
}

/// Pixels as squares with a border around all of them, and with a grid where squares are large enough.
fn squares(
    shown: PixelRect,
    zoom: u32,
    has_samples: bool,
    colour: &dyn Fn(i32, i32) -> Rgb<u8>,
) -> RgbImage {
    let (width, height) = (shown.width() * zoom + 1, shown.height() * zoom + 1);
    // Lines between pixels and dots for samples are drawn where squares are large enough.
    let has_grid = zoom >= if has_samples { 4 } else { 6 };
    let has_samples = has_samples && zoom >= SAMPLED;
    let is_dot = |offset: u32| has_samples && offset.abs_diff(zoom / 2) <= zoom / 32;
    painted(width, height, |x, y| {
        if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
            BORDER
        } else if has_grid && (x % zoom == 0 || y % zoom == 0) {
            GRID
        } else if is_dot(x % zoom) && is_dot(y % zoom) {
            SAMPLE
        } else {
            colour(shown.x0 + (x / zoom) as i32, shown.y0 + (y / zoom) as i32)
        }
    })
}

/// The colour of a pixel that is hit so often, and should be hit so often, by the number of the triangle that it belongs to.
fn colour(actual: u8, target: u8, owner: u8) -> Rgb<u8> {
    match (actual, target) {
        (0, 0) => BACKGROUND,
        (a, t) if a > t && a > 1 => TWICE,
        (a, t) if a > t => EXTRA,
        (a, t) if a < t => MISSING,
        (1, _) if owner > 0 => OWNERS[usize::from(owner - 1) % OWNERS.len()],
        (1, _) => AGREES,
        _ => OVERLAP,
    }
}

/// Colours with what they mean.
pub type Entry = (Vec<Rgb<u8>>, String);

/// What the colours mean, in rows that fit a width, and a note below them.
fn foot(width: u32, entries: &[Entry], note: &str) -> RgbImage {
    const ROW: u32 = 18;
    let (mut left, mut top) = (GAP, 0);
    // Where each entry begins: in this row if it fits, else in the next one.
    let mut places = Vec::new();
    for (colours, text) in entries {
        let wide = 6 + 12 * colours.len() as u32 + lettering::width(text, Size::Small);
        if left + wide > width - GAP && left > GAP {
            (left, top) = (GAP, top + ROW);
        }
        places.push([left, top]);
        left += wide + 16;
    }
    // The places of all entries are known, and so is the height.
    let rows = if entries.is_empty() { 0 } else { top + ROW };
    let note_rows = if note.is_empty() { 0 } else { ROW };
    let end = if rows + note_rows > 0 { GAP / 2 } else { 0 };
    let mut image = plain(width, rows + note_rows + end, WHITE);
    for ([mut left, top], (colours, text)) in places.into_iter().zip(entries) {
        for &colour in colours {
            // A sign of the shape that it has in the picture: a line, a dot, or a square.
            let (wide, high) = match colour {
                EDGE => (0..12, 6..8),
                SAMPLE => (4..7, 5..8),
                _ => (0..12, 1..13),
            };
            for x in wide {
                for y in high.clone() {
                    image.put_pixel(left + x, top + y, colour);
                }
            }
            left += 12;
        }
        write(&mut image, (i64::from(left) + 6, i64::from(top) - 1), text, Size::Small, INK);
    }
    write(&mut image, (GAP.into(), i64::from(rows) - 1), note, Size::Small, FAINT);
    image
}

/// The pixels of a rectangle, row by row.
fn pixels(PixelRect { x0, y0, x1, y1 }: PixelRect) -> impl Iterator<Item = (i32, i32)> {
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| (x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_registry::named::find;
    use rasterproof_verify::cases::named::Input;

    /// A named case, two engines of which the second lacks a pixel.
    fn drawn(name: &str) -> (Case, Vec<EnginePicture>, Coverage) {
        let Input::Drawn { case, .. } = find(name).unwrap().input else {
            panic!("{name} is drawn")
        };
        let Shape::Triangles { list, .. } = &case.shape else { panic!("{name}") };
        let target = rasterproof_verify::comparison::oracle_coverage(list, case.window);
        let mut holed = target.clone();
        let (y, row) = target.rows().find(|(_, row)| row.contains(&1)).unwrap();
        let x = row.iter().position(|h| *h == 1).unwrap();
        holed.row_mut(y)[x] = 0;
        let engines = vec![("right".to_owned(), target.clone()), ("holed".to_owned(), holed)];
        (case, engines, target)
    }

    #[test]
    fn a_large_window_is_cropped_to_what_differs() {
        let (case, engines, target) = drawn("T4");
        assert!(case.window.width() > MOST_CROPPED_PX, "{:?}", case.window);
        let shown = |engines: &[EnginePicture]| {
            let all: Vec<_> = engines.iter().collect();
            crop(case.window, &all, &target, &scaled(&outline(&case), case.window, 1))
        };
        let (shown, whole) = (shown(&engines), shown(&engines[..1]));
        assert!(shown.width() <= 9 && shown.height() <= 9, "{shown:?}");
        assert!(whole.width() > 9 && whole.width() <= case.window.width(), "{whole:?}");
    }
}
