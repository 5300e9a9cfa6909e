//! `rasterproof inspect CASE --pixel X,Y`: why a pixel is covered or not, step by step: edge values,
//! ties and whose they are, the span of the row, and who hits it.

use std::fmt::Write as _;

use crate::contract::Rasterize;
use crate::grid::{PixelRect, SubpixelPoint};
use crate::hazard::{Case, Line, Shape, Triangle};
use crate::oracle::Oracle;
use crate::raster::edge_function::edge_values;
use crate::raster::scanline::Scanline;
use crate::triangle::{Corners, PixelPoint};

/// Triangles or lines that are explained; the rest are counted.
const MOST: usize = 8;

/// The explanation of a pixel of the case's window, in lines of at most 100 columns.
pub fn pixel(case: &Case, at: PixelPoint) -> String {
    let mut out = format!("pixel ({}, {})", at.x, at.y);
    let rest = match &case.shape {
        Shape::Triangles { list, .. } => {
            let centre = [at.x, at.y].map(|v| f64::from(v) + 0.5);
            let _ = writeln!(out, ": its sample is the centre, ({}, {})", centre[0], centre[1]);
            list.iter().take(MOST).for_each(|t| triangle(&mut out, t, case.window, at));
            list.len().saturating_sub(MOST)
        }
        Shape::Lines(list) => {
            out.push('\n');
            list.iter().take(MOST).for_each(|l| line(&mut out, l, case.window, at));
            list.len().saturating_sub(MOST)
        }
    };
    if rest > 0 {
        let _ = writeln!(out, "and {rest} more");
    }
    out
}

fn point(p: SubpixelPoint) -> String {
    let (x, y) = p.to_px();
    format!("({x}, {y})")
}

/// What an edge of a triangle is to the top-left rule: with the inside to its right, a left edge goes
/// up and a top edge goes right.
fn kind(from: SubpixelPoint, to: SubpixelPoint) -> (&'static str, bool) {
    let (dx, dy) = (i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y));
    match (dx.signum(), dy.signum()) {
        (_, -1) => ("a left edge", true),
        (1, 0) => ("a top edge", true),
        (_, 0) => ("a bottom edge", false),
        _ => ("a right edge", false),
    }
}

fn triangle(out: &mut String, triangle: &Triangle, window: PixelRect, at: PixelPoint) {
    let mut corners: Corners = triangle.corners();
    let _ = writeln!(out, "triangle {}", corners.map(point).join(" "));
    let area: i128 = edge_values(&corners, at.x, at.y).iter().sum();
    match area.signum() {
        0 => {
            let _ = writeln!(out, "  zero area: it covers nothing");
            return;
        }
        -1 => {
            corners.swap(1, 2);
            let _ = writeln!(out, "  counter-clockwise: taken the other way round");
        }
        _ => {}
    }
    // Value i belongs to the edge opposite corner i; in units of 1/65536 square pixel.
    let values = edge_values(&corners, at.x, at.y);
    let mut is_covered = true;
    for (opposite, value) in values.into_iter().enumerate() {
        let (from, to) = (corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]);
        let (name, owns) = kind(from, to);
        let what = match value.signum() {
            1 => "inside".to_owned(),
            -1 => "outside".to_owned(),
            _ if owns => format!("a tie: the sample lies on {name}, which owns it: inside"),
            _ => format!("a tie: the sample lies on {name}, which does not own it: outside"),
        };
        is_covered &= value > 0 || (value == 0 && owns);
        let _ = writeln!(out, "  {} to {}: E = {value}, {what}", point(from), point(to));
    }
    let verdict = if is_covered { "covered" } else { "not covered" };
    let _ = writeln!(out, "  by the top-left rule: {verdict}");
    let mut span = None;
    let row = PixelRect { y0: at.y, y1: at.y + 1, ..window };
    Scanline.cover(corners, row, |s| span = Some((s.x0_px, s.x1_px)));
    let _ = match span {
        None => writeln!(out, "  the scanline has no span in row {}", at.y),
        Some((x0, x1)) => {
            writeln!(out, "  the scanline's span of row {} is columns {x0}..{x1}", at.y)
        }
    };
}

fn line(out: &mut String, line: &Line, window: PixelRect, at: PixelPoint) {
    let [a, b] = line.ends.map(|end| [i64::from(end.pixel.x), i64::from(end.pixel.y)]);
    let major = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let minor = 1 - major;
    let [u, v] = [major, minor].map(|axis| [i64::from(at.x), i64::from(at.y)][axis]);
    let names = ["x", "y"];
    let (major_name, minor_name) = (names[major], names[minor]);
    let _ = writeln!(out, "line ({}, {}) to ({}, {})", a[0], a[1], b[0], b[1]);
    let (low, high) = (a[major].min(b[major]), a[major].max(b[major]));
    if u < low || u > high {
        let _ = writeln!(out, "  {major_name} = {u} lies outside {low}..={high}: not lit");
        return;
    }
    // The line at u is a[minor] + rise / du.
    let (du, rise) = (
        i128::from(b[major] - a[major]).abs().max(1),
        i128::from(b[minor] - a[minor])
            * i128::from(u - a[major])
            * i128::from((b[major] - a[major]).signum()),
    );
    let exact = i128::from(a[minor]) * du + rise;
    let (whole, part) = (exact.div_euclid(du), exact.rem_euclid(du));
    let fraction = if part == 0 { String::new() } else { format!(" and {part}/{du}") };
    let is_tie = 2 * part == du;
    let tie = if is_tie { ", a tie: halfway between two pixels" } else { "" };
    let nearest = if is_tie { "of the two the one farther along" } else { "the nearest" };
    let _ = writeln!(
        out,
        "  at {major_name} = {u} the line passes {minor_name} = {whole}{fraction}{tie}"
    );
    let mut lit = None;
    Oracle.line_pixels(line, window, |p, _| {
        let [pu, pv] = [major, minor].map(|axis| [i64::from(p.x), i64::from(p.y)][axis]);
        if pu == u {
            lit = Some(pv);
        }
    });
    let _ = match lit {
        Some(lit) if lit == v => writeln!(out, "  {nearest} is lit: this one"),
        Some(lit) => writeln!(out, "  {nearest} is lit: {minor_name} = {lit}, not this one"),
        None => writeln!(out, "  the pixel that is lit there lies outside the window"),
    };
}
