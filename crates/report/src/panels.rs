//! The sheet of a case: a panel for each engine with its name and its counts, rows and columns
//! numbered, cropped to what matters, and a legend of what occurs.
//!
//! The PNG of a sheet remembers where its panels are, so that two sheets can be compared pixel for
//! pixel of the cases instead of picture pixel for picture pixel.

use std::collections::{BTreeSet, HashMap};

use image::{Rgb, RgbImage, imageops};

use super::lettering::{self, Size, write};
use super::picture::{
    AGREES, BACKGROUND, BORDER, EDGE, EXTRA, GRID, MISSING, OVERLAP, OWNERS, SAMPLE, TWICE,
    encoded, line, segments,
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
pub(super) const INK: Rgb<u8> = Rgb([30, 30, 30]);
pub(super) const FAINT: Rgb<u8> = Rgb([95, 95, 95]);
const WHITE: Rgb<u8> = Rgb([255, 255, 255]);
const KEY: &str = "rasterproof-panels";

pub type Drawn = (String, Coverage);

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Panel {
    pub name: String,
    /// Left and top in picture pixels.
    pub at: [u32; 2],
    /// Picture pixels of a pixel's side.
    pub zoom: u32,
    pub shown: PixelRect,
}

#[derive(Clone, Debug)]
pub struct Sheet {
    pub image: RgbImage,
    pub panels: Vec<Panel>,
}

/// What each engine draws, judged by `target`; then the target, as `oracle`.
///
/// All coverages show the case's window.
pub fn of_case(title: &str, case: &Case, actual: &[Drawn], target: &Coverage) -> Sheet {
    let outline = match &case.shape {
        Shape::Lines(_) => "the line itself",
        _ => "edges",
    };
    let (window, owners) = (case.window, owners(case, target));
    let oracle = [("oracle".to_owned(), target.clone())];
    let all: Vec<&Drawn> = actual.iter().chain(&oracle).collect();
    let shown = crop(window, &all, target, &segments(case, window, 1));
    let (zoom, columns) = layout(shown, all.len() as u32);
    let outlines = segments(case, shown, zoom);
    let mut occurring = BTreeSet::new();
    let panels = all.iter().map(|(name, hits)| {
        let colour = |x_px, y_px| {
            let of = |hits: &Coverage| hits.get(x_px, y_px).unwrap_or(0);
            colour(of(hits), of(target), owners.as_ref().map_or(0, of))
        };
        occurring.extend(pixels(shown).map(|(x, y)| colour(x, y).0));
        let counts = (counts(hits, target), Size::Small, FAINT);
        let words = [(name.clone(), Size::Heading, INK), counts];
        panel(name.clone(), &words, (shown, zoom, true), &outlines, &colour)
    });
    let panels = panels.collect();
    let owned =
        (1..).zip(OWNERS).map(|(number, colour)| (colour, format!("right: triangle {number}")));
    let words = [
        (AGREES, "as the oracle"),
        (MISSING, "missing"),
        (EXTRA, "extra"),
        (TWICE, "hit too often"),
        (OVERLAP, "rightly more than once"),
    ];
    let words = words.map(|(colour, text)| (colour, text.to_owned()));
    let samples = (zoom >= SAMPLED).then_some((SAMPLE, "samples"));
    let others = [(EDGE, outline)].into_iter().chain(samples);
    let others = others.map(|(colour, text)| (colour, text.to_owned()));
    let entries = owned.chain(words).filter(|(c, _)| occurring.contains(&c.0)).chain(others);
    let entries: Vec<Entry> = entries.map(|(colour, text)| (vec![colour], text)).collect();
    let note = if shown == window {
        String::new()
    } else {
        format!(
            "columns {} to {}, rows {} to {} of {} x {} px",
            shown.x0,
            shown.x1 - 1,
            shown.y0,
            shown.y1 - 1,
            window.width(),
            window.height()
        )
    };
    arranged(&[(title.to_owned(), Size::Heading, INK)], panels, columns, &entries, &note)
}

/// Words of one size and colour.
pub(super) type Words = (String, Size, Rgb<u8>);

/// Words, below them pictures in so many columns, below these what the colours mean, and a note.
pub(super) fn arranged(
    words: &[Words],
    cells: Vec<Sheet>,
    columns: u32,
    entries: &[Entry],
    note: &str,
) -> Sheet {
    let wide = cells.iter().map(|cell| cell.image.width()).max().unwrap_or(1);
    let high = cells.iter().map(|cell| cell.image.height()).max().unwrap_or(1);
    let rows = (cells.len() as u32).div_ceil(columns);
    let width = (GAP + columns * (wide + GAP)).max(420);
    let mut heading = Vec::new();
    let mut top = GAP;
    for (text, size, ink) in words {
        for line in lettering::wrapped(text, *size, width - 2 * GAP) {
            heading.push((line, top, *size, *ink));
            top += size.cell()[1];
        }
    }
    top += GAP / 2;
    let foot = foot(width, entries, note);
    let height = top + rows * (high + GAP) + foot.height();
    let mut image = RgbImage::from_pixel(width, height, WHITE);
    for (text, y, size, ink) in heading {
        write(&mut image, (GAP.into(), y.into()), &text, size, ink);
    }
    let mut panels = Vec::new();
    for (i, cell) in (0u32..).zip(cells) {
        let (left, top) = (GAP + i % columns * (wide + GAP), top + i / columns * (high + GAP));
        imageops::replace(&mut image, &cell.image, left.into(), top.into());
        let moved = |panel: Panel| Panel { at: [panel.at[0] + left, panel.at[1] + top], ..panel };
        panels.extend(cell.panels.into_iter().map(moved));
    }
    imageops::replace(&mut image, &foot, 0, i64::from(height - foot.height()));
    Sheet { image, panels }
}

/// The number of the triangle that the oracle gives each pixel to, from 1, where a few triangles lie side by side and no
/// pixel is hit twice: then the picture shows who gets the pixels of an edge.
fn owners(case: &Case, target: &Coverage) -> Option<Coverage> {
    let Shape::Triangles { list, .. } = &case.shape else { return None };
    let once = target.rows().all(|(_, row)| row.iter().all(|&hits| hits <= 1));
    if !once || !(2..=OWNERS.len()).contains(&list.len()) {
        return None;
    }
    let mut owners = Coverage::new(case.window, 0);
    for (number, triangle) in (1..).zip(list) {
        for (y, row) in oracle_coverage(std::slice::from_ref(triangle), case.window).rows() {
            for (owner, _) in owners.row_mut(y).iter_mut().zip(row).filter(|(_, hits)| **hits > 0) {
                *owner = number;
            }
        }
    }
    Some(owners)
}

/// The part of the window that is worth seeing: the shape and what is hit, a pixel to spare. Of a
/// large one, the pixels that differ, or those that are hit.
fn crop(
    window: PixelRect,
    all: &[&Drawn],
    target: &Coverage,
    outline: &[[PixelPoint; 2]],
) -> PixelRect {
    let hits = |c: &Coverage, x: i32, y: i32| c.get(x, y).unwrap_or(0);
    let hit = around(window, |x, y| all.iter().any(|(_, c)| hits(c, x, y) > 0), 1);
    let wrong =
        around(window, |x, y| all.iter().any(|(_, c)| hits(c, x, y) != hits(target, x, y)), 4);
    let mut shape = hit.unwrap_or(PixelRect { x1: window.x0, y1: window.y0, ..window });
    let is_hit = hit.is_some();
    for (i, p) in outline.iter().flatten().enumerate() {
        let at = |v: i32, origin: i32, end: i32| v.saturating_add(origin).clamp(origin, end - 1);
        let (x, y) = (at(p.x, window.x0, window.x1), at(p.y, window.y0, window.y1));
        let spare = wider(PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 }, 1, window);
        shape = if i == 0 && !is_hit { spare } else { union(shape, spare) };
    }
    let is_small = |r: &PixelRect| r.width().max(r.height()) <= MOST_CROPPED_PX;
    let shape = Some(shape).filter(|r| r.width() > 0 && r.height() > 0);
    shape.filter(is_small).or(wrong).or(hit).or(shape).unwrap_or(window)
}

fn union(a: PixelRect, b: PixelRect) -> PixelRect {
    PixelRect { x0: a.x0.min(b.x0), y0: a.y0.min(b.y0), x1: a.x1.max(b.x1), y1: a.y1.max(b.y1) }
}

/// The box around the pixels of a kind, some to spare, within the window.
fn around(window: PixelRect, is_in: impl Fn(i32, i32) -> bool, spare: i32) -> Option<PixelRect> {
    let boxes = pixels(window).filter(|&(x, y)| is_in(x, y)).map(|(x, y)| PixelRect {
        x0: x,
        y0: y,
        x1: x + 1,
        y1: y + 1,
    });
    Some(wider(boxes.reduce(union)?, spare, window))
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
    let zoom = |columns: u32| {
        let fits = |room: u32, panels: u32, side: u32| room / panels.saturating_mul(side).max(1);
        let across = fits(MOST_PX[0], columns, shown.width());
        across.min(fits(MOST_PX[1], count.div_ceil(columns), shown.height())).clamp(1, largest)
    };
    // The most panels in a row of those that are equally large.
    let best = (1..=count).max_by_key(|&columns| (zoom(columns), columns)).unwrap_or(1);
    (zoom(best), best)
}

fn beside(shown: PixelRect) -> u32 {
    let wide = |n: i32| lettering::width(&n.to_string(), Size::Small) + 6;
    wide(shown.y0).max(wide(shown.y1 - 1)).max(BESIDE)
}

/// A picture below some words, with room left of it and above.
pub(super) fn titled(words: &[Words], picture: &RgbImage, [left, above]: [u32; 2]) -> RgbImage {
    let text = words.iter().map(|(text, size, _)| lettering::width(text, *size)).max();
    let wide = left + picture.width().max(text.unwrap_or(0));
    let top = head(words) + above;
    let mut image = RgbImage::from_pixel(wide, top + picture.height(), WHITE);
    let mut y = 0;
    for (text, size, ink) in words {
        write(&mut image, (left.into(), y.into()), text, *size, *ink);
        y += size.cell()[1];
    }
    imageops::replace(&mut image, picture, left.into(), top.into());
    image
}

fn head(words: &[Words]) -> u32 {
    words.iter().map(|(_, size, _)| size.cell()[1]).sum::<u32>() + 2
}

/// Each pixel as a square of its colour, with an outline over them, numbered rows and columns, and a dot for each sample where
/// these are shown.
pub(super) fn panel(
    name: String,
    words: &[Words],
    (shown, zoom, has_samples): (PixelRect, u32, bool),
    outline: &[[PixelPoint; 2]],
    colour: &dyn Fn(i32, i32) -> Rgb<u8>,
) -> Sheet {
    let mut picture = squares(shown, zoom, has_samples, colour);
    let bounds = PixelRect::window(picture.width(), picture.height());
    for segment in outline {
        line(*segment, bounds, |x, y| picture.put_pixel(x, y, EDGE));
    }
    let left = beside(shown);
    let mut image = titled(words, &picture, [left, ABOVE]);
    let at = [left, head(words) + ABOVE];
    numbers(&mut image, at, shown, zoom);
    Sheet { image, panels: vec![Panel { name, at, zoom, shown }] }
}

/// What is wrong in words, or how many pixels are right.
fn counts(hits: &Coverage, target: &Coverage) -> String {
    let Tally { missing, extra, twice, .. } = Tally::between(hits, target);
    let parts = [(missing, "missing"), (extra, "extra"), (twice, "twice")];
    let wrong: Vec<_> =
        parts.iter().filter(|(n, _)| *n > 0).map(|(n, word)| format!("{n} {word}")).collect();
    let covered = format!("{} px", hits.covered());
    if wrong.is_empty() { covered } else { format!("{covered}: {}", wrong.join(", ")) }
}

/// Numbers of columns over the squares, of rows left of them, as many as fit. The squares begin at `left` and `top`.
fn numbers(image: &mut RgbImage, [left, top]: [u32; 2], shown: PixelRect, zoom: u32) {
    let widest = [shown.x0, shown.x1 - 1].map_array(|n| n.to_string().len() as u32);
    let [cell_width, cell_height] = Size::Small.cell();
    let rooms = [widest[0].max(widest[1]) * cell_width + 5, 13];
    let step = |room: u32| {
        let mut steps = (0..6).flat_map(|e| [1, 2, 5].map_array(|m| m * 10i32.pow(e)));
        steps.find(|s| *s as u32 * zoom >= room).unwrap_or(1_000_000)
    };
    for x in (shown.x0..shown.x1).filter(|x| x.rem_euclid(step(rooms[0])) == 0) {
        let text = x.to_string();
        let middle = left + (x - shown.x0) as u32 * zoom + zoom / 2;
        let half = lettering::width(&text, Size::Small) / 2;
        if middle + half > image.width() {
            continue;
        }
        let place = (i64::from(middle) - i64::from(half), i64::from(top) - i64::from(ABOVE));
        write(image, place, &text, Size::Small, FAINT);
    }
    for y in (shown.y0..shown.y1).filter(|y| y.rem_euclid(step(rooms[1])) == 0) {
        let text = y.to_string();
        let middle = top + (y - shown.y0) as u32 * zoom + zoom / 2;
        let from = i64::from(left) - 4 - i64::from(lettering::width(&text, Size::Small));
        let place = (from, i64::from(middle) - i64::from(cell_height / 2));
        write(image, place, &text, Size::Small, FAINT);
    }
}

/// With a border, and where there is room a grid between them.
fn squares(
    shown: PixelRect,
    zoom: u32,
    has_samples: bool,
    colour: &dyn Fn(i32, i32) -> Rgb<u8>,
) -> RgbImage {
    let (width, height) = (shown.width() * zoom + 1, shown.height() * zoom + 1);
    let has_grid = zoom >= if has_samples { 4 } else { 6 };
    let has_samples = has_samples && zoom >= SAMPLED;
    let is_dot = |offset: u32| has_samples && offset.abs_diff(zoom / 2) <= zoom / 32;
    RgbImage::from_fn(width, height, |x, y| {
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
pub(super) type Entry = (Vec<Rgb<u8>>, String);

/// What the colours mean, in rows that fit a width, and a note below them.
fn foot(width: u32, entries: &[Entry], note: &str) -> RgbImage {
    const ROW: u32 = 18;
    let (mut left, mut top) = (GAP, 0);
    let mut places = Vec::new();
    for (colours, text) in entries {
        let wide = 6 + 12 * colours.len() as u32 + lettering::width(text, Size::Small);
        if left + wide > width - GAP && left > GAP {
            (left, top) = (GAP, top + ROW);
        }
        places.push([left, top]);
        left += wide + 16;
    }
    let rows = if entries.is_empty() { 0 } else { top + ROW };
    let note_rows = if note.is_empty() { 0 } else { ROW };
    let end = if rows + note_rows > 0 { GAP / 2 } else { 0 };
    let mut image = RgbImage::from_pixel(width, rows + note_rows + end, WHITE);
    for ([mut left, top], (colours, text)) in places.into_iter().zip(entries) {
        for &colour in colours {
            let (wide, high) = match colour {
                EDGE => (0..12, 6..8),
                SAMPLE => (4..7, 5..8),
                _ => (0..12, 1..13),
            };
            for (x, y) in wide.flat_map(|x| high.clone().map(move |y| (x, y))) {
                image.put_pixel(left + x, top + y, colour);
            }
            left += 12;
        }
        write(&mut image, (i64::from(left) + 6, i64::from(top) - 1), text, Size::Small, INK);
    }
    write(&mut image, (GAP.into(), i64::from(rows) - 1), note, Size::Small, FAINT);
    image
}

impl Sheet {
    /// The sheet as a PNG that remembers its panels.
    pub fn png(&self) -> Vec<u8> {
        let row = |p: &Panel| {
            let ([left, top], PixelRect { x0, y0, x1, y1 }) = (p.at, p.shown);
            format!("{left} {top} {} {x0} {y0} {x1} {y1} {}", p.zoom, p.name)
        };
        let rows: Vec<_> = self.panels.iter().map(row).collect();
        encoded(&self.image, Some((KEY, &rows.join("\n"))))
    }

    /// The sheet that a PNG remembers; nothing where it is no such PNG, or where its panels claim more
    /// pixels than the picture has, so that to compare them takes no longer than to read the picture.
    #[must_use]
    pub fn from_png(bytes: &[u8]) -> Option<Self> {
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().ok()?;
        let texts = &reader.info().uncompressed_latin1_text;
        let text = &texts.iter().find(|chunk| chunk.keyword == KEY)?.text;
        let size = [reader.info().width, reader.info().height].map_array(u64::from);
        let (mut panels, mut claimed) = (Vec::new(), 0);
        for row in text.lines() {
            let panel = parsed(row)?;
            let sides = [panel.shown.width(), panel.shown.height()]
                .map_array(|side| u64::from(side) * u64::from(panel.zoom));
            let fits = |i: usize| u64::from(panel.at[i]) + sides[i] <= size[i];
            claimed += sides[0] * sides[1];
            if !fits(0) || !fits(1) || claimed > size[0] * size[1] {
                return None;
            }
            panels.push(panel);
        }
        Some(Self { image: image::load_from_memory(bytes).ok()?.to_rgb8(), panels })
    }

    /// The colour of a pixel of the case in a panel: the most frequent in its square.
    fn colour(&self, panel: &Panel, x_px: i32, y_px: i32, square: &mut Vec<[u8; 3]>) -> [u8; 3] {
        let PixelRect { x0, y0, x1, y1 } = panel.shown;
        if !(x0..x1).contains(&x_px) || !(y0..y1).contains(&y_px) {
            return BACKGROUND.0;
        }
        let offset = |v: i32, from: i32| v.abs_diff(from) * panel.zoom;
        let (left, top) = (panel.at[0] + offset(x_px, x0), panel.at[1] + offset(y_px, y0));
        square.clear();
        for (x, y) in (0..panel.zoom).flat_map(|y| (0..panel.zoom).map(move |x| (x, y))) {
            square.extend(self.image.get_pixel_checked(left + x, top + y).map(|pixel| pixel.0));
        }
        // Sorted, since a square may have as many colours as it has picture pixels.
        square.sort_unstable();
        let runs = square.chunk_by(|a, b| a == b);
        runs.max_by_key(|run| run.len()).map_or(BACKGROUND.0, |run| run[0])
    }
}

fn parsed(row: &str) -> Option<Panel> {
    let mut words = row.splitn(8, ' ');
    let mut number = || words.next()?.parse::<i32>().ok();
    let [left, top, zoom] = [number()?, number()?, number()?].map_array(u32::try_from);
    let [x0, y0, x1, y1] = [number()?, number()?, number()?, number()?];
    let sides = [x1.checked_sub(x0)?, y1.checked_sub(y0)?];
    if !sides.iter().all(|side| (1..=4096).contains(side)) || !(1..=64).contains(&zoom.ok()?) {
        return None;
    }
    Some(Panel {
        name: words.next()?.to_owned(),
        at: [left.ok()?, top.ok()?],
        zoom: zoom.ok()?,
        shown: PixelRect { x0, y0, x1, y1 },
    })
}

/// For each panel of both sheets its name, and in how many pixels of the case they differ.
///
/// Only the pixels that a panel shows are compared. The two windows may lie far apart, so that the
/// rectangle around both can be many times larger than the pictures.
pub fn changes(old: &Sheet, new: &Sheet) -> Vec<(String, u64)> {
    let mut by_name = HashMap::new();
    for panel in &old.panels {
        by_name.entry(panel.name.as_str()).or_insert(panel);
    }
    let squares = &mut [Vec::new(), Vec::new()];
    let mut changed = |before: &Panel, after: &Panel| {
        let is_new = |&(x, y): &(i32, i32)| {
            let PixelRect { x0, y0, x1, y1 } = before.shown;
            !(x0..x1).contains(&x) || !(y0..y1).contains(&y)
        };
        let pixels = pixels(before.shown).chain(pixels(after.shown).filter(is_new));
        let [a, b] = &mut *squares;
        let differ = pixels
            .filter(|&(x, y)| old.colour(before, x, y, a) != new.colour(after, x, y, b))
            .count();
        (after.name.clone(), differ as u64)
    };
    let pairs = new.panels.iter().filter_map(|after| Some((*by_name.get(&*after.name)?, after)));
    pairs.map(|(before, after)| changed(before, after)).collect()
}

fn pixels(PixelRect { x0, y0, x1, y1 }: PixelRect) -> impl Iterator<Item = (i32, i32)> {
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| (x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_render::scene::named::find;
    use rasterproof_verify::cases::named::Input;

    /// A named case, two engines of which the second lacks a pixel.
    fn drawn(name: &str) -> (Case, Vec<Drawn>, Coverage) {
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
    fn a_png_remembers_its_panels_and_tells_who_changed() {
        let (case, engines, target) = drawn("T2");
        let old =
            of_case("T2", &case, &[engines[0].clone(), ("x".to_owned(), target.clone())], &target);
        let new = of_case(
            "T2",
            &case,
            &[engines[0].clone(), ("x".to_owned(), engines[1].1.clone())],
            &target,
        );
        let again = Sheet::from_png(&new.png()).unwrap();
        assert_eq!((&again.panels, again.image), (&new.panels, new.image.clone()));
        let counts = |name: &str, n| (name.to_owned(), n);
        let expected = [counts("right", 0), counts("x", 1), counts("oracle", 0)];
        assert_eq!(changes(&old, &new), expected);
        assert!(Sheet::from_png(&super::super::picture::png(&new.image)).is_none());
    }

    #[test]
    fn a_large_window_is_cropped_to_what_differs() {
        let (case, engines, target) = drawn("T4");
        assert!(case.window.width() > MOST_CROPPED_PX, "{:?}", case.window);
        let shown = of_case("T4", &case, &engines, &target).panels[0].shown;
        assert!(shown.width() <= 9 && shown.height() <= 9, "{shown:?}");
        let whole = of_case("T4", &case, &engines[..1], &target).panels[0].shown;
        assert!(whole.width() > 9 && whole.width() <= case.window.width(), "{whole:?}");
    }

    /// A sheet whose panels are as given, as a PNG that says so.
    fn claiming(side: u32, panels: Vec<Panel>) -> Sheet {
        Sheet { image: RgbImage::from_pixel(side, side, WHITE), panels }
    }

    fn far_panel(name: &str, x0: i32, side: i32, zoom: u32) -> Panel {
        let shown = PixelRect { x0, y0: -x0, x1: x0 + side, y1: side - x0 };
        Panel { name: name.to_owned(), at: [0, 0], zoom, shown }
    }

    /// The rectangle around both windows has 16,000,000 x 16,000,000 pixels.
    #[test]
    fn windows_far_apart_are_compared_alone() {
        let old = claiming(64, vec![far_panel("x", -8_000_000, 8, 8)]);
        let mut new = claiming(64, vec![far_panel("x", 8_000_000, 8, 8)]);
        assert_eq!(changes(&old, &new), [("x".to_owned(), 128)]);
        new.panels[0].shown = old.panels[0].shown;
        assert_eq!(changes(&old, &new), [("x".to_owned(), 0)]);
        // A window that grew: old pixels are compared with old ones, new ones with the background.
        new = claiming(96, vec![far_panel("x", -8_000_000, 12, 8)]);
        assert_eq!(changes(&old, &new), [("x".to_owned(), 144 - 64)]);
    }

    #[test]
    fn panels_claim_no_more_than_the_picture_has() {
        let huge = claiming(64, vec![far_panel("x", 0, 4096, 64)]);
        assert!(Sheet::from_png(&huge.png()).is_none());
        let whole = far_panel("x", 0, 8, 8);
        assert!(Sheet::from_png(&claiming(64, vec![whole.clone()]).png()).is_some());
        assert!(Sheet::from_png(&claiming(64, vec![whole; 1000]).png()).is_none());
        let apart = |i: u32| Panel { at: [i % 64, i / 64], ..far_panel(&format!("{i}"), 0, 1, 1) };
        let many = claiming(64, (0..1000).map(apart).collect());
        let again = Sheet::from_png(&many.png()).unwrap();
        assert_eq!(changes(&many, &again).len(), 1000);
    }

    #[test]
    fn broken_memories_are_none() {
        for row in
            ["", "1 2 3", "1 2 99999 0 0 4 4 x", "1 2 8 0 0 -4 4 x", "1 2 8 0 0 2147483647 4 x"]
        {
            assert_eq!(parsed(row), None, "{row}");
        }
        assert_eq!(parsed("1 2 8 -1 0 4 4 a b").unwrap().name, "a b");
    }
}
