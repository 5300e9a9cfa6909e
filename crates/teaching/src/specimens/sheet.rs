//! The contact sheet of the specimens: for each a strip of three panels, published, repaired,
//! difference, with its name, its fault and its cure.
//!
//! Panels show the exposing case alone, each pixel a square. A strip refuses nothing: what the
//! published code leaves undefined stays empty.

use glam::DVec2;
use std::collections::BTreeSet;

use image::{Rgb, RgbImage};

use rasterproof_core::contract::{DrawLine as _, Interpolate as _};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::triangle::Fragment;
use rasterproof_faults::published::catalogue::{CARDS, Card, Exhibit, TriangleCase};
use rasterproof_faults::published::scene::{BLACK, Colour, Image, Setting, Version};
use rasterproof_faults::published::{Published, PublishedLine, RealTriangle};
use rasterproof_registry::engines::{self, Specimen};
use rasterproof_registry::published_check::{
    free_truth, line_case, on_lattice, real_triangles, specimen_coverage, specimen_line_coverage,
};
use rasterproof_report::chapter::chapter_of_source;
use rasterproof_report::html::{PictureLayer, PictureView};
use rasterproof_report::lettering::Size;
use rasterproof_report::panels::{self, Entry, FAINT, INK};
use rasterproof_report::picture::{
    self, AGREES, BACKGROUND, EDGE, EXTRA, MISSING, SAMPLE, Segment, TWICE, edges, outline, scaled,
};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::oracle::Oracle;

/// Drawn by both, but not alike.
const WRONG: Rgb<u8> = Rgb([60, 120, 220]);
/// A value beyond the range of its corners.
const BEYOND: Colour = [40, 170, 60];

/// Largest side of a panel, in pixels of the sheet, with its border.
const PANEL: u32 = 161;

/// What a card shows: both versions of a picture, and how they are shown.
struct Panels {
    published: Image,
    repaired: Image,
    /// The colour of pixels that neither version draws.
    background: Colour,
    outline: Vec<Segment>,
    has_samples: bool,
    /// Whether the colours are those of [`shade`].
    has_values: bool,
}

/// All cards, two strips to a row, over what their colours mean.
pub fn contact_sheet() -> RgbImage {
    let shown: Vec<_> = CARDS.iter().filter_map(versions).collect();
    let strips = CARDS.iter().map(|card| strip(card, &[])).collect();
    let title = ("Published algorithms and their faults".to_owned(), Size::Heading, INK);
    panels::arranged(&[title], strips, 2, &legend(&shown), "")
}

/// The strip of a card, with what its colours mean.
pub fn alone(card: &Card) -> RgbImage {
    let shown: Vec<_> = versions(card).into_iter().collect();
    strip(card, &legend(&shown))
}

/// The exposing pictures of every card, for the page, named apart from the cases that are `taken`.
pub fn views(taken: &[String]) -> Vec<PictureView> {
    let mut views = Vec::new();
    for card in CARDS {
        let Some(Panels { published, repaired, .. }) = versions(card) else { continue };
        let is_taken = taken.iter().any(|name| name == card.name);
        views.push(PictureView {
            name: format!("{}{}", card.name, if is_taken { " picture" } else { "" }),
            chapter: chapter_of_source(card.source),
            about: format!("{}: {}; cure: {}", card.source, card.fault, card.cure),
            command: format!("rasterproof specimens --specimen {}", card.name),
            layers: vec![
                PictureLayer::new("published", &picture::of_frame(&published)),
                PictureLayer::new("repaired", &picture::of_frame(&repaired)),
            ],
        });
    }
    views
}

/// What the colours mean that occur.
fn legend(shown: &[Panels]) -> Vec<Entry> {
    // The colours of the differences, and those of values, whose panels use other colours for other things.
    let (mut differences, mut values) = (BTreeSet::new(), BTreeSet::new());
    for panels in shown {
        collect_colours(&difference(panels), &mut differences);
        if panels.has_values {
            collect_colours(&panels.published, &mut values);
            collect_colours(&panels.repaired, &mut values);
        }
    }
    let mut entries = Vec::new();
    for (colour, text) in [
        (AGREES, "right"),
        (MISSING, "missing"),
        (EXTRA, "extra"),
        (TWICE, "drawn twice"),
        (WRONG, "drawn, but not alike"),
    ] {
        if differences.contains(&colour.0) {
            entries.push((vec![colour], text.to_owned()));
        }
    }
    if shown.iter().any(|panels| !panels.outline.is_empty()) {
        entries.push((vec![EDGE], "outline".to_owned()));
    }
    if shown.iter().any(|panels| panels.has_samples) {
        entries.push((vec![SAMPLE], "sample".to_owned()));
    }
    if !values.is_empty() {
        let shades = [0.0, 0.25, 0.5, 0.75, 1.0].map(|v| Rgb(shade(v)));
        entries.push((shades.to_vec(), "values from 0 to 1".to_owned()));
    }
    for (colour, text) in [(BEYOND, "beyond the corners' values"), (BLACK, "not a number")] {
        if values.contains(&colour) {
            entries.push((vec![Rgb(colour)], text.to_owned()));
        }
    }
    entries
}

/// Adds the colours that occur in a picture.
fn collect_colours(image: &Image, colours: &mut BTreeSet<Colour>) {
    for (_, row) in image.rows() {
        colours.extend(row);
    }
}

/// Published, repaired and their difference, below the name, the fault and its cure.
fn strip(card: &Card, legend: &[Entry]) -> RgbImage {
    // Both versions in windows of the same size, and where they differ.
    let Some(panels) = versions(card) else { return RgbImage::new(1, 1) };
    let bounds = panels.published.bounds();
    // A pixel is a square of whole pixels of the sheet, and the largest panel fits.
    let zoom = ((PANEL - 1) / bounds.width().max(bounds.height())).max(1);
    let outline = scaled(&panels.outline, bounds, zoom);
    let difference = difference(&panels);
    let Panels { published, repaired, .. } = &panels;
    let all = [("published", published), ("repaired", repaired), ("difference", &difference)];
    let cells = all.map(|(title, picture)| {
        let colour = |x_px, y_px| Rgb(picture.get(x_px, y_px).unwrap_or_default());
        let shown = (bounds, zoom, panels.has_samples);
        let words = [(title.to_owned(), Size::Small, FAINT)];
        panels::panel(&words, shown, &outline, &colour)
    });
    let words = [
        (format!("{} ({})", card.name, card.source), Size::Heading, INK),
        (card.fault.to_owned(), Size::Small, INK),
        (format!("cure: {}", card.cure), Size::Small, FAINT),
    ];
    panels::arranged(&words, cells.into(), 3, legend, "")
}

/// Red missing, orange extra, violet twice, blue drawn by both but not alike, grey the same.
fn difference(panels: &Panels) -> Image {
    image_of(panels.published.bounds(), |x, y| {
        let published = panels.published.get(x, y).unwrap_or_default();
        let repaired = panels.repaired.get(x, y).unwrap_or_default();
        if published == repaired {
            if repaired == panels.background { BACKGROUND } else { AGREES }
        } else if published == panels.background {
            MISSING
        } else if published == TWICE.0 {
            TWICE
        } else if repaired == panels.background {
            EXTRA
        } else {
            WRONG
        }
    })
}

/// A picture of this colour at each pixel.
fn image_of(bounds: PixelRect, colour: impl Fn(i32, i32) -> Rgb<u8>) -> Image {
    let mut image = Frame::new(bounds, BACKGROUND.0);
    for y in bounds.y0..bounds.y1 {
        for (x, pixel) in (bounds.x0..).zip(image.row_mut(y)) {
            *pixel = colour(x, y).0;
        }
    }
    image
}

/// What a card shows; nothing where its published code draws nothing at all.
fn versions(card: &Card) -> Option<Panels> {
    let specimen = engines::find(card.name).and_then(|entry| entry.specimen);
    match (&card.exhibit, specimen) {
        // A scene has no triangles of its own in the window, so there is nothing to outline.
        (Exhibit::Scene(_, draw), _) => Some(Panels {
            published: draw(Version::Published, Setting::Exposing),
            repaired: draw(Version::Repaired, Setting::Exposing),
            background: BLACK,
            outline: Vec::new(),
            has_samples: false,
            has_values: false,
        }),
        (Exhibit::Triangles([case, _]), Some(Specimen::Triangle(specimen))) => {
            Some(triangle_panels(card.name, specimen, case))
        }
        (Exhibit::Lines([case, _]), Some(Specimen::Line(specimen))) => {
            line_panels(specimen, &line_case(case))
        }
        _ => None,
    }
}

/// A picture of hits: none, one, or more than one.
fn hits_image(hits: &Coverage) -> Image {
    image_of(hits.bounds(), |x, y| match hits.get(x, y) {
        None | Some(0) => BACKGROUND,
        Some(1) => AGREES,
        Some(_) => TWICE,
    })
}

/// A line as published, and as the oracle draws it.
fn line_panels(specimen: &dyn PublishedLine, case: &Case) -> Option<Panels> {
    let Shape::Lines(lines) = &case.shape else { return None };
    let mut truth = Coverage::new(case.window, 0);
    Oracle.draw(&lines[0], case.window, |f| truth.hit(f.y_px, f.x_px, f.x_px + 1));
    // What the published code refuses to draw is shown as an empty panel.
    let hits = specimen_line_coverage(specimen, lines, case.window);
    Some(Panels {
        published: hits_image(&hits.unwrap_or_else(|_| Coverage::new(case.window, 0))),
        repaired: hits_image(&truth),
        background: BACKGROUND.0,
        outline: outline(case),
        has_samples: false,
        has_values: false,
    })
}

/// Triangles as published and repaired: their pixels, or their values where the case is one of values.
fn triangle_panels(name: &str, specimen: &dyn Published, case: &TriangleCase) -> Panels {
    let window = PixelRect::window(case.side_px, case.side_px);
    let triangles = real_triangles(case);
    // Corners of equal values say nothing about interpolation: their case is one of coverage.
    let shows_values = case.values[0] != case.values[1] || case.values[1] != case.values[2];
    let has_values = shows_values && specimen.has_values();
    let (published, repaired) = if has_values {
        // The faults of these show in their depths.
        let by_depth = matches!(name, "book-ch6" | "book-ch7" | "book-ch11-fixed");
        value_images(specimen, by_depth, &triangles, window)
    } else {
        let hits = specimen_coverage(specimen, &triangles, window);
        let hits = hits.unwrap_or_else(|_| Coverage::new(window, 0));
        (hits_image(&hits), hits_image(&free_truth(&triangles, window)))
    };
    // The edges lie where the corners were given, not where they were snapped.
    let mut outline = Vec::new();
    for triangle in &triangles {
        outline.extend(edges(triangle.each_ref().map(|v| v.position_px.to_array())));
    }
    Panels { published, repaired, background: BACKGROUND.0, outline, has_samples: true, has_values }
}

/// Values as colours: blue at 0, through white, to red at 1; green beyond either; black for what is
/// no number.
fn shade(value: f64) -> Colour {
    if !value.is_finite() {
        return BLACK;
    }
    // Rounding may leave the range by a little.
    if !(-0.02..=1.02).contains(&value) {
        return BEYOND;
    }
    let is_low = value < 0.5;
    let part = if is_low { 0.2 + 1.6 * value } else { 1.8 - 1.6 * value };
    let part = (part * 255.0).round().clamp(0.0, 255.0) as u8;
    if is_low { [part, part, 255] } else { [255, part, part] }
}

/// The attribute, or the depth stretched so that the corners' range is 0 to 1, in colours.
fn value_images(
    specimen: &dyn Published,
    by_depth: bool,
    triangles: &[RealTriangle],
    window: PixelRect,
) -> (Image, Image) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for v in triangles.iter().flatten() {
        let depth = specimen.depth_of(v.depth, v.w);
        (low, high) = (low.min(depth), high.max(depth));
    }
    let put = |image: &mut Image, f: &Fragment<DVec2>| {
        let value = if by_depth { (f.depth - low) / (high - low) } else { f.varying.x };
        image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = shade(value);
    };
    let mut published: Image = Frame::new(window, BACKGROUND.0);
    let mut repaired = published.clone();
    for triangle in triangles {
        // What is refused stays empty.
        let _ = specimen.fragments(triangle, window, &mut |f| put(&mut published, &f));
        let Some(mut of_depth) = on_lattice(triangle) else { continue };
        for v in &mut of_depth.vertices {
            let depth = specimen.depth_of(v.depth, 1.0 / v.inv_w);
            // Chapter 6 compares w, which is an attribute and not linear on the screen.
            if specimen.compares_w() {
                v.varying = DVec2::splat(depth);
            }
            v.depth = depth;
        }
        EdgeFunction.fragments(&of_depth, window, |mut f| {
            if specimen.compares_w() {
                f.depth = f.varying.x;
            }
            put(&mut repaired, &f);
        });
    }
    (published, repaired)
}
