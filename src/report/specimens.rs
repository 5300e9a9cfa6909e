//! The survey of the specimens as text, and its contact sheet as pictures.

use std::fmt::Write as _;

use glam::DVec2;
use image::RgbImage;

use super::html::{PictureLayer, PictureView};
use super::picture;
use crate::contract::{DrawLine as _, Interpolate as _};
use crate::frame::{Coverage, Frame};
use crate::hazard::{Case, Shape, Triangle};
use crate::lineup::{self, Specimen, TriangleSpecimen};
use crate::oracle::Oracle;
use crate::raster::edge_function::EdgeFunction;
use crate::specimen::catalogue::{CARDS, Card, Exhibit, TriangleCase};
use crate::specimen::scene::{Colour, Image, Setting, Version};
use crate::specimen::{Published as _, from_screen};
use crate::triangle::Fragment;
use crate::verify::oracle_coverage;
use crate::verify::specimens::{
    SpecimenReport, line_case, specimen_coverage, specimen_line_coverage, triangle_case,
};

/// The survey: a line of numbers for each specimen, then the percentages by family; at most 100
/// columns.
#[must_use]
pub fn table(reports: &[SpecimenReport]) -> String {
    let mut out = String::from(
        "wrong: percent of the triangles or lines; extra, missing, twice: per million covered pixels;\n\
         value, depth: worst error as a fraction of the spread of the corner values\n",
    );
    let _ = writeln!(
        out,
        "{:<17}{:<15}{:>6} {:>7} {:>7} {:>7} {:>6} {:>6}  shown by: pixels",
        "specimen", "from", "wrong", "extra", "missing", "twice", "value", "depth"
    );
    for r in reports {
        let (all, drawn) = (&r.all, r.all.shapes > 0);
        let rate = |n: u64| match (drawn, 1e6 * n as f64 / all.pixels.max(1) as f64) {
            (false, _) => "-".to_owned(),
            (true, rate) if rate < 1e7 => format!("{rate:.0}"),
            (true, rate) => format!("{rate:.0e}"),
        };
        let error = |e: f64| match e {
            _ if !drawn => "-".to_owned(),
            0.0 => "0".to_owned(),
            e if e.is_infinite() => "inf".to_owned(),
            e if (0.01..100.0).contains(&e) => format!("{e:.2}"),
            e => format!("{e:.0e}"),
        };
        let percent = if drawn { format!("{:.1}%", all.percent()) } else { "-".to_owned() };
        let _ = writeln!(
            out,
            "{:<17}{:<15}{:>6} {:>7} {:>7} {:>7} {:>6} {:>6}  {}: {}",
            r.name,
            r.source,
            percent,
            rate(all.tally.extra),
            rate(all.tally.missing),
            rate(all.tally.twice),
            error(all.worst_attribute),
            error(all.worst_depth),
            r.case,
            r.case_wrong
        );
        let _ = writeln!(out, "  {} -> {}", r.fault, r.cure);
    }
    for lines in [false, true] {
        let columns: Vec<_> = reports
            .iter()
            .filter(|r| {
                r.families.first().is_some_and(|(name, _)| name.starts_with("line") == lines)
            })
            .collect();
        by_family(&mut out, &columns, if lines { "lines" } else { "triangles" });
    }
    out
}

/// Percent of wrong shapes, a row for each family, a letter for each specimen.
fn by_family(out: &mut String, columns: &[&SpecimenReport], shapes: &str) {
    let Some(first) = columns.first() else { return };
    let letter = |i: usize| char::from(b'A' + i as u8);
    let legend: Vec<_> =
        columns.iter().enumerate().map(|(i, r)| format!("{} {}", letter(i), r.name)).collect();
    let _ = writeln!(out, "\nwrong {shapes} in percent, by family:");
    for names in legend.chunks(5) {
        let _ = writeln!(out, "  {}", names.join(", "));
    }
    let _ = write!(out, "{:<16}", "family");
    (0..columns.len()).for_each(|i| {
        let _ = write!(out, " {:>5}", letter(i));
    });
    out.push('\n');
    for (row, (family, _)) in first.families.iter().enumerate() {
        let _ = write!(out, "{family:<16}");
        for report in columns {
            let counts = &report.families[row].1;
            let _ = write!(out, " {:>5.1}", counts.percent());
        }
        out.push('\n');
    }
}

/// The exposing case of a specimen: published, repaired, difference.
#[must_use]
pub fn sheet(card: &Card) -> RgbImage {
    let specimen = lineup::find(card.name).and_then(|entry| entry.specimen);
    match (&card.exhibit, specimen) {
        (Exhibit::Scene(_, draw), _) => picture::images(
            &draw(Version::Published, Setting::Exposing),
            &draw(Version::Repaired, Setting::Exposing),
        ),
        (Exhibit::Triangles([case, _]), Some(Specimen::Triangle(specimen))) => {
            let shows_values = shows_values(case, specimen);
            let case = triangle_case(case);
            if shows_values {
                let [published, repaired] = value_images(specimen, &case);
                picture::images(&published, &repaired)
            } else {
                hit_sheet(specimen, &case)
            }
        }
        (Exhibit::Lines([case, _]), Some(Specimen::Line(specimen))) => {
            let case = line_case(case);
            let Shape::Lines(lines) = &case.shape else { return RgbImage::new(1, 1) };
            let mut truth = Coverage::new(case.window, 0);
            Oracle.draw(&lines[0], case.window, |f| truth.hit(f.y_px, f.x_px, f.x_px + 1));
            let hits = specimen_line_coverage(specimen, &lines[0], case.window);
            picture::exhibit(&case, &hits.unwrap_or_else(|_| Coverage::new(case.window, 0)), &truth)
        }
        _ => RgbImage::new(1, 1),
    }
}

/// Whether a case's corner values differ and the specimen draws them.
fn shows_values(case: &TriangleCase, specimen: TriangleSpecimen) -> bool {
    (case.values[0] != case.values[1] || case.values[1] != case.values[2]) && specimen.has_values()
}

/// Published and repaired pictures of the specimens that hit counts alone do not show: scenes, and
/// values in colour.
#[must_use]
pub fn views() -> Vec<PictureView> {
    let pair = |card: &Card, what: &str, [published, repaired]: [Image; 2]| PictureView {
        name: format!("{} {what}", card.name),
        about: format!("{}: {}; cure: {}", card.source, card.fault, card.cure),
        command: "rasterproof specimens --report".to_owned(),
        layers: vec![
            PictureLayer::new("published", &picture::of_frame(&published)),
            PictureLayer::new("repaired", &picture::of_frame(&repaired)),
        ],
    };
    let views = CARDS.iter().filter_map(|card| {
        let specimen = lineup::find(card.name).and_then(|entry| entry.specimen);
        match (&card.exhibit, specimen) {
            (Exhibit::Scene(name, draw), _) => {
                let both = [Version::Published, Version::Repaired];
                Some(pair(card, name, both.map(|version| draw(version, Setting::Exposing))))
            }
            (Exhibit::Triangles([case, _]), Some(Specimen::Triangle(specimen)))
                if shows_values(case, specimen) =>
            {
                Some(pair(card, "values", value_images(specimen, &triangle_case(case))))
            }
            _ => None,
        }
    });
    views.collect()
}

fn triangles(case: &Case) -> &[Triangle] {
    match &case.shape {
        Shape::Triangles { list, .. } => list,
        Shape::Lines(_) => &[],
    }
}

fn hit_sheet(specimen: TriangleSpecimen, case: &Case) -> RgbImage {
    let list = triangles(case);
    let hits = specimen_coverage(specimen, list, case.window);
    let truth = oracle_coverage(list, case.window);
    picture::exhibit(case, &hits.unwrap_or_else(|_| Coverage::new(case.window, 0)), &truth)
}

/// Values in colour: blue at 0, through white, to red at 1; violet beyond either; black for what is
/// no number.
fn colour(value: f64) -> Colour {
    let part = |v: f64| (v * 255.0).round().clamp(0.0, 255.0) as u8;
    match value {
        v if !v.is_finite() => [0, 0, 0],
        v if !(-0.02..=1.02).contains(&v) => [130, 0, 150],
        v if v < 0.5 => [part(0.2 + 1.6 * v), part(0.2 + 1.6 * v), 255],
        v => [255, part(1.8 - 1.6 * v), part(1.8 - 1.6 * v)],
    }
}

/// The values of a case in colour, published and repaired.
fn value_images(specimen: TriangleSpecimen, case: &Case) -> [Image; 2] {
    let list = triangles(case);
    let by_depth = matches!(
        specimen,
        TriangleSpecimen::BookChapter6
            | TriangleSpecimen::BookChapter7
            | TriangleSpecimen::BookChapter11Fixed
    );
    // Depths are stretched so that the corners' range is 0 to 1.
    let depths: Vec<f64> = list
        .iter()
        .flat_map(|t| t.vertices.map(|v| specimen.depth_of(v.depth, 1.0 / v.inv_w)))
        .collect();
    let low = depths.iter().copied().fold(f64::INFINITY, f64::min);
    let high = depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let shown = |f: &Fragment<DVec2>| {
        colour(if by_depth { (f.depth - low) / (high - low) } else { f.varying.x })
    };
    let paper: Colour = [250, 250, 247];
    let [mut published, mut repaired] =
        [(); 2].map(|()| -> Image { Frame::new(case.window, paper) });
    let put = |image: &mut Image, f: &Fragment<DVec2>| {
        image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = shown(f);
    };
    for triangle in list {
        // What is refused stays paper.
        let _ =
            specimen.fragments(&from_screen(triangle), case.window, |f| put(&mut published, &f));
        let mut of_depth = *triangle;
        for v in &mut of_depth.vertices {
            let depth = specimen.depth_of(v.depth, 1.0 / v.inv_w);
            // Chapter 6 compares w, which is an attribute and not linear on the screen.
            if specimen == TriangleSpecimen::BookChapter6 {
                v.varying = DVec2::splat(depth);
            }
            v.depth = depth;
        }
        EdgeFunction.fragments(&of_depth, case.window, |mut f| {
            if specimen == TriangleSpecimen::BookChapter6 {
                f.depth = f.varying.x;
            }
            put(&mut repaired, &f);
        });
    }
    [published, repaired]
}
