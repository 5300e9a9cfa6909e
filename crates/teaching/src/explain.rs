//! Why a pixel is covered or not, step by step: edge values, ties and whose they are, the span of the row, and who hits
//! it.

use std::cmp::Ordering;
use std::fmt::Write as _;

use rasterproof_core::contract::{Rasterize, RasterizeExact};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::edge_values;
use rasterproof_core::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::{Corners, FreeCorners, PixelPoint};
use rasterproof_verify::cases::{Case, Line, Shape, Triangle};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::rational::edge_value;

/// Triangles or lines that are explained; the rest are counted.
const MOST: usize = 8;

/// The explanation of a pixel of the case's window, in lines of at most 100 columns.
pub fn pixel(case: &Case, at: PixelPoint) -> String {
    let mut out = format!("pixel ({}, {})", at.x, at.y);
    let count = match &case.shape {
        Shape::Triangles { list, .. } => {
            let [x, y] = centre(at);
            let _ = writeln!(out, ": its sample is the centre, ({x}, {y})");
            list.iter().take(MOST).for_each(|t| triangle(&mut out, t, case.window, at));
            list.len()
        }
        Shape::Lines(list) => {
            out.push('\n');
            list.iter().take(MOST).for_each(|l| line(&mut out, l, case.window, at));
            list.len()
        }
        Shape::Unsnapped { list, .. } => {
            let _ = writeln!(out, ": its sample is the centre, {}", free_point(centre(at)));
            list.iter().take(MOST).for_each(|t| free_triangle(&mut out, t, case.window, at));
            list.len()
        }
        Shape::Numbers { .. } => 0,
    };
    if let Some(rest @ 1..) = count.checked_sub(MOST) {
        let _ = writeln!(out, "and {rest} more");
    }
    out
}

/// The point at which a pixel is sampled.
fn centre(at: PixelPoint) -> [f64; 2] {
    [at.x, at.y].map(|v| f64::from(v) + 0.5)
}

/// A point with all of its digits, since a last bit may decide.
fn free_point([x, y]: [f64; 2]) -> String {
    format!("({x:?}, {y:?})")
}

pub fn point(p: SubpixelPoint) -> String {
    let (x, y) = p.to_px();
    format!("({x}, {y})")
}

/// What an edge of a triangle is to the top-left rule: with the inside to its right, a left edge goes
/// up and a top edge goes right.
fn kind<T: PartialOrd>([x0, y0]: [T; 2], [x1, y1]: [T; 2]) -> (&'static str, bool) {
    match (x1 > x0, y1 < y0, y1 > y0) {
        (_, true, _) => ("a left edge", true),
        (_, _, true) => ("a right edge", false),
        (true, ..) => ("a top edge", true),
        _ => ("a bottom edge", false),
    }
}

/// On which side of an edge the sample lies, and whether that makes it the triangle's.
fn side(sign: Ordering, (name, owns): (&str, bool)) -> (String, bool) {
    match sign {
        Ordering::Greater => ("inside".to_owned(), true),
        Ordering::Less => ("outside".to_owned(), false),
        Ordering::Equal => {
            let what = if owns { "owns it: inside" } else { "does not own it: outside" };
            (format!("a tie: the sample lies on {name}, which {what}"), owns)
        }
    }
}

/// On which side of each edge the sample lies, and what the rule makes of that; false for a triangle that covers
/// nothing. `edge` returns the ends of an edge, its value in words, and the side.
fn sides<P: Copy>(
    out: &mut String,
    mut corners: [P; 3],
    area: Ordering,
    shown: impl Fn(P) -> String,
    edge: impl Fn([P; 3], usize) -> ([P; 2], String, (String, bool)),
) -> bool {
    let _ = writeln!(out, "triangle {}", corners.map(&shown).join(" "));
    if area == Ordering::Equal {
        let _ = writeln!(out, "  zero area: it covers nothing");
        return false;
    }
    // Then the inside lies to the right of every edge, for which the rule is stated.
    if area == Ordering::Less {
        corners.swap(1, 2);
        let _ = writeln!(out, "  counter-clockwise: taken the other way round");
    }
    let mut is_covered = true;
    for i in 0..3 {
        let ([from, to], value, (what, is_inside)) = edge(corners, i);
        is_covered &= is_inside;
        let _ = writeln!(out, "  {} to {}:{value}, {what}", shown(from), shown(to));
    }
    let verdict = if is_covered { "covered" } else { "not covered" };
    let _ = writeln!(out, "  by the top-left rule: {verdict}");
    true
}

/// The columns that an engine draws in the row of the pixel.
fn span_of_row(out: &mut String, who: &str, row: i32, span: Option<(i32, i32)>) {
    let _ = match span {
        None => writeln!(out, "  {who} has no span in row {row}"),
        Some((x0, x1)) => writeln!(out, "  {who}'s span of row {row} is columns {x0}..{x1}"),
    };
}

/// x and y, to be indexed by an axis.
fn coordinates(p: PixelPoint) -> [i64; 2] {
    [p.x.into(), p.y.into()]
}

/// The three edges by whole numbers, and the span that the scanline engine draws.
fn triangle(out: &mut String, triangle: &Triangle, window: PixelRect, at: PixelPoint) {
    let corners: Corners = triangle.corners();
    // The sum of the three is twice the area, wherever the pixel is.
    let area: i128 = edge_values(&corners, at.x, at.y).iter().sum();
    // Value i belongs to the edge opposite corner i; in units of 1/65536 square pixel.
    let edge = |corners: Corners, opposite: usize| {
        // Inside is where all three values are above 0, or 0 on an edge that the rule counts in.
        let value = edge_values(&corners, at.x, at.y)[opposite];
        let (from, to) = (corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]);
        let side = side(value.cmp(&0), kind([from.x, from.y], [to.x, to.y]));
        ([from, to], format!(" E = {value}"), side)
    };
    if !sides(out, corners, area.cmp(&0), point, edge) {
        return;
    }
    // The engine draws this row alone.
    let mut span = None;
    let row = PixelRect { y0: at.y, y1: at.y + 1, ..window };
    Scanline.cover(corners, row, |s| span = Some((s.x0_px, s.x1_px)));
    span_of_row(out, "the scanline", at.y, span);
}

/// As [`triangle`], in exact arithmetic of any length: edge values in square pixels.
fn free_triangle(out: &mut String, triangle: &FreeCorners, window: PixelRect, at: PixelPoint) {
    let corners = triangle.px();
    let area = edge_value(corners[0], corners[1], corners[2]).0;
    let edge = |corners: [[f64; 2]; 3], i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        // The sign is exact, and the value is cut to what a float holds.
        let (sign, value) = edge_value(from, to, centre(at));
        let value = match (sign, value == 0.0) {
            (Ordering::Greater, true) => "above 0 by less than any f64".to_owned(),
            (Ordering::Less, true) => "below 0 by less than any f64".to_owned(),
            _ => format!("{value:?} px^2"),
        };
        ([from, to], format!("\n    E = {value}"), side(sign, kind(from, to)))
    };
    if !sides(out, corners, area, free_point, edge) {
        return;
    }
    let mut span = None;
    let row = PixelRect { y0: at.y, y1: at.y + 1, ..window };
    ScanlineExact.cover_exact(triangle, row, |s| span = Some((s.x0_px, s.x1_px)));
    span_of_row(out, "scanline-exact", at.y, span);
    // The other engine decides this pixel alone, by floats where they are sure.
    let pixel = PixelRect { x0: at.x, x1: at.x + 1, ..row };
    let decisions = EdgeFunctionExact.cover_exact(triangle, pixel, |_| ());
    let _ = writeln!(
        out,
        "  edge-function-exact: {} signs by floats, {} too close to 0 for them",
        decisions.by_filter, decisions.by_fallback
    );
}

/// Where a line passes the column or row of the pixel, and which pixel is lit there.
fn line(out: &mut String, line: &Line, window: PixelRect, at: PixelPoint) {
    let [a, b] = line.ends.map(|end| coordinates(end.pixel));
    let major = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let minor = 1 - major;
    // u counts along the longer axis, in which a line has a pixel for each step; v counts across.
    let (u, v) = (coordinates(at)[major], coordinates(at)[minor]);
    let names = ["x", "y"];
    let (major_name, minor_name) = (names[major], names[minor]);
    let _ = writeln!(out, "line ({}, {}) to ({}, {})", a[0], a[1], b[0], b[1]);
    let (low, high) = (a[major].min(b[major]), a[major].max(b[major]));
    if u < low || u > high {
        let _ = writeln!(out, "  {major_name} = {u} lies outside {low}..={high}: not lit");
        return;
    }
    // The line at u is a[minor] + rise / du.
    let [along, across, done] =
        [b[major] - a[major], b[minor] - a[minor], u - a[major]].map(i128::from);
    let (du, rise) = (along.abs().max(1), across * done * along.signum());
    let exact = i128::from(a[minor]) * du + rise;
    let (whole, part) = (exact.div_euclid(du), exact.rem_euclid(du));
    // The height as a mixed number, of which only a half is a tie.
    let fraction = if part == 0 { String::new() } else { format!(" and {part}/{du}") };
    let is_tie = 2 * part == du;
    let tie = if is_tie { ", a tie: halfway between two pixels" } else { "" };
    let nearest = if is_tie { "of the two the one farther along" } else { "the nearest" };
    let _ = writeln!(
        out,
        "  at {major_name} = {u} the line passes {minor_name} = {whole}{fraction}{tie}"
    );
    // The oracle says which pixel is lit; the text above says why.
    let mut lit = None;
    Oracle.line_pixels(line, window, |p, _| {
        if coordinates(p)[major] == u {
            lit = Some(coordinates(p)[minor]);
        }
    });
    let _ = match lit {
        Some(lit) if lit == v => writeln!(out, "  {nearest} is lit: this one"),
        Some(lit) => writeln!(out, "  {nearest} is lit: {minor_name} = {lit}, not this one"),
        None => writeln!(out, "  the pixel that is lit there lies outside the window"),
    };
}
