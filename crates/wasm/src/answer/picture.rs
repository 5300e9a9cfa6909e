//! What is drawn, as the page sends and receives it: a window, and triangles or lines with real
//! positions.

use glam::DVec2;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::no_answer::NoAnswer;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{
    Corners, FreeCorners, MAX_W, MIN_W, PixelPoint, ScreenTriangle, ScreenVertex, check_value,
    refused_number,
};
use rasterproof_faults::published::{RealTriangle, RealVertex, from_screen};
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::cases::{Case, Line, Shape, Triangle};

/// The longest side of a window in pixels: more cannot be seen, and takes longer than a frame.
const MOST_SIDE_PX: i64 = 128;
/// The most triangles or lines of one picture, so that a question from an address does not take for ever.
const MOST_SHAPES: usize = 4096;

/// A corner: a position in pixels and what it carries.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Corner {
    x: f64,
    y: f64,
    #[serde(default = "one")]
    w: f64,
    #[serde(default)]
    depth: f64,
    #[serde(default)]
    u: f64,
    #[serde(default)]
    v: f64,
}

/// Without a w all corners are equally far away.
fn one() -> f64 {
    1.0
}

impl Corner {
    /// A vertex on the lattice; or the reason why it has no place there, with its position and the name of the number.
    fn on_lattice(&self) -> Result<ScreenVertex<DVec2>, NoAnswer> {
        let vertex = ScreenVertex::by_name([self.x, self.y], self.depth, self.w, self.varying());
        let (name, refusal) = match (vertex, check_value(self.u), check_value(self.v)) {
            (Ok(vertex), Ok(()), Ok(())) => return Ok(vertex),
            (Err(refused), _, _) => refused,
            (_, Err(refusal), _) => ("u", refusal),
            (_, _, Err(refusal)) => ("v", refusal),
        };
        let Self { x, y, .. } = self;
        Err(format!("corner {x}, {y}: {}", refused_number(name, refusal)).into())
    }

    /// A vertex as published code takes it, in which w is no check but a number.
    fn as_real(&self) -> RealVertex {
        RealVertex {
            position_px: DVec2::new(self.x, self.y),
            depth: self.depth,
            w: self.w.clamp(MIN_W, MAX_W),
            varying: self.varying(),
        }
    }

    /// What engines interpolate beside the depth.
    fn varying(&self) -> DVec2 {
        DVec2::new(self.u, self.v)
    }
}

/// What the page sends to be drawn, and gets back of a case.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Picture {
    /// First column and row, then one past the last ones.
    window: [i32; 4],
    /// Whether corners are snapped to the lattice; off it the exact forms draw.
    #[serde(default)]
    pub snap: bool,
    #[serde(default)]
    triangles: Vec<[Corner; 3]>,
    /// Whole pixels: both ends of each line.
    #[serde(default)]
    lines: Vec<[[i32; 2]; 2]>,
}

impl Picture {
    /// The window, if it can be shown.
    pub fn window(&self) -> Result<PixelRect, NoAnswer> {
        let [x0, y0, x1, y1] = self.window;
        // In 64 bits, since the page may send any numbers.
        let width = i64::from(x1) - i64::from(x0);
        let height = i64::from(y1) - i64::from(y0);
        let range = 1..=MOST_SIDE_PX;
        if !range.contains(&width) || !range.contains(&height) {
            return Err(format!(
                "a window of {width} x {height} pixels: 1 to {MOST_SIDE_PX} on each side can be shown"
            )
            .into());
        }
        if self.triangles.len().max(self.lines.len()) > MOST_SHAPES {
            return Err(format!("more than {MOST_SHAPES} triangles or lines").into());
        }
        Ok(PixelRect { x0, y0, x1, y1 })
    }

    /// The triangles with their corners snapped to the lattice.
    pub fn on_lattice(&self) -> Result<Vec<Triangle>, NoAnswer> {
        let mut all = Vec::new();
        for [a, b, c] in &self.triangles {
            let vertices = [a.on_lattice()?, b.on_lattice()?, c.on_lattice()?];
            all.push(ScreenTriangle { vertices });
        }
        Ok(all)
    }

    /// The corners on the lattice in pixels, for the outlines of what was drawn.
    pub fn outlines(&self) -> Result<Vec<[[f64; 2]; 3]>, NoAnswer> {
        Ok(self.on_lattice()?.iter().map(|triangle| in_px(triangle.corners())).collect())
    }

    /// The corners as they are given.
    pub fn as_given(&self) -> Result<Vec<FreeCorners>, NoAnswer> {
        let mut all = Vec::new();
        for triangle in &self.triangles {
            all.push(FreeCorners::new(triangle.map(|corner| [corner.x, corner.y]))?);
        }
        Ok(all)
    }

    /// The triangles as the specimens take them: real numbers, the lattice's where they snap.
    pub fn as_real(&self) -> Result<Vec<RealTriangle>, NoAnswer> {
        if self.snap {
            return Ok(self.on_lattice()?.iter().map(from_screen).collect());
        }
        // They refuse nothing, so that is done for them.
        self.as_given()?;
        Ok(self.triangles.iter().map(|corners| corners.map(|c| c.as_real())).collect())
    }

    /// The lines between the centres of their pixels; nothing is refused, since any pixel is an end.
    pub fn lines(&self) -> Vec<Line> {
        self.lines.iter().map(|&[from, to]| line_between(from, to)).collect()
    }

    /// The picture as a case of the test families.
    pub fn case(&self) -> Result<Case, NoAnswer> {
        let shape = match (self.lines.is_empty(), self.snap) {
            (false, _) => Shape::Lines(self.lines()),
            (true, true) => Shape::Triangles { list: self.on_lattice()?, disjoint: false },
            (true, false) => Shape::Unsnapped { list: self.as_given()?, is_tiling: false },
        };
        Ok(Case { window: self.window()?, shape })
    }
}

/// What travels to the page, where it is drawn, and back as a question; windows that are too large for it are cut.
impl From<&Case> for Picture {
    fn from(case: &Case) -> Self {
        let mut picture =
            Self { window: cut(case.window), snap: true, triangles: Vec::new(), lines: Vec::new() };
        match &case.shape {
            Shape::Triangles { list, .. } => {
                picture.triangles = list.iter().map(|t| t.vertices.map(corner)).collect();
            }
            Shape::Lines(lines) => {
                for line in lines {
                    picture.lines.push(line.ends.map(|end| [end.pixel.x, end.pixel.y]));
                }
            }
            Shape::Unsnapped { list, .. } => {
                picture.triangles = list.iter().map(|t| t.px().map(plain_corner)).collect();
                picture.snap = false;
            }
            Shape::Numbers { .. } => {}
        }
        picture
    }
}

/// A vertex of the lattice in pixels, as the page has it.
fn corner(vertex: ScreenVertex<DVec2>) -> Corner {
    let (x, y) = vertex.position.to_px();
    let DVec2 { x: u, y: v } = vertex.varying;
    Corner { x, y, w: 1.0 / vertex.inv_w, depth: vertex.depth, u, v }
}

/// A corner that carries nothing.
fn plain_corner([x, y]: [f64; 2]) -> Corner {
    Corner { x, y, w: 1.0, depth: 0.0, u: 0.0, v: 0.0 }
}

/// The part of a window that can be shown.
fn cut(window: PixelRect) -> [i32; 4] {
    let side = MOST_SIDE_PX as i32;
    let x1 = window.x1.min(window.x0.saturating_add(side));
    let y1 = window.y1.min(window.y0.saturating_add(side));
    [window.x0, window.y0, x1, y1]
}

/// A line between the centres of two pixels.
pub(crate) fn line_between([x0, y0]: [i32; 2], [x1, y1]: [i32; 2]) -> Line {
    plain_line(PixelPoint::new(x0, y0), PixelPoint::new(x1, y1))
}

/// Positions in pixels, for the outline of what was drawn.
pub(super) fn in_px(corners: Corners) -> [[f64; 2]; 3] {
    corners.map(|p| [p.x, p.y].map(|sub| f64::from(sub) / f64::from(SUBPIXELS)))
}

/// What somebody drew, or why nothing, with the name: an engine that refuses takes no place from the others.
pub(super) fn panel(name: &str, drawn: Result<Value, NoAnswer>) -> Value {
    let mut panel = drawn.unwrap_or_else(|refused| json!({ "refused": refused.to_string() }));
    panel["name"] = json!(name);
    panel
}

/// A panel for each of these names.
pub(super) fn panels(by: &[String], draw: impl Fn(&str) -> Result<Value, NoAnswer>) -> Vec<Value> {
    by.iter().map(|name| panel(name, draw(name))).collect()
}

/// The values of all pixels, row by row. A frame itself may hold more, between its rows.
pub(super) fn flat<T: Copy>(frame: &Frame<T>) -> Vec<T> {
    let mut all = Vec::new();
    for (_, row) in frame.rows() {
        all.extend_from_slice(row);
    }
    all
}
