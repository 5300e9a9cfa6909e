//! What is drawn, as the page sends and receives it: a window, and triangles or lines with real
//! positions.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{
    Corners, FreeCorners, MAX_W, MIN_W, PixelPoint, ScreenTriangle, ScreenVertex, check_value,
    refused_number,
};
use rasterproof_faults::published::{RealTriangle, RealVertex};
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::cases::{Case, Line, Shape, Triangle};

/// The longest side of a window in pixels: more cannot be seen, and takes longer than a frame.
const MOST_SIDE_PX: i64 = 128;
/// The most triangles or lines of one picture.
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

fn one() -> f64 {
    1.0
}

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
    pub fn window(&self) -> Result<PixelRect, String> {
        let [x0, y0, x1, y1] = self.window;
        let side = |low: i32, high: i32| i64::from(high) - i64::from(low);
        let sides = [side(x0, x1), side(y0, y1)];
        if sides.iter().any(|side| !(1..=MOST_SIDE_PX).contains(side)) {
            return Err(format!(
                "a window of {} x {} pixels: 1 to {MOST_SIDE_PX} on each side can be shown",
                sides[0], sides[1]
            ));
        }
        if self.triangles.len().max(self.lines.len()) > MOST_SHAPES {
            return Err(format!("more than {MOST_SHAPES} triangles or lines"));
        }
        Ok(PixelRect { x0, y0, x1, y1 })
    }

    pub fn on_lattice(&self) -> Result<Vec<Triangle>, String> {
        let vertex = |c: &Corner| {
            let vertex = ScreenVertex::by_name([c.x, c.y], c.depth, c.w, DVec2::new(c.u, c.v));
            let checked = |name, value| check_value(value).map_err(|refusal| (name, refusal));
            let values = checked("u", c.u).and(checked("v", c.v));
            vertex.and_then(|vertex| values.map(|()| vertex)).map_err(|(name, refusal)| {
                format!("corner {}, {}: {}", c.x, c.y, refused_number(name, refusal))
            })
        };
        let triangle = |[a, b, c]: &[Corner; 3]| {
            Ok(ScreenTriangle { vertices: [vertex(a)?, vertex(b)?, vertex(c)?] })
        };
        self.triangles.iter().map(triangle).collect()
    }

    /// The corners on the lattice in pixels, for the outlines of what was drawn.
    pub fn outlines(&self) -> Result<Vec<[[f64; 2]; 3]>, String> {
        Ok(self.on_lattice()?.iter().map(|triangle| in_px(triangle.corners())).collect())
    }

    /// The corners as they are given.
    pub fn as_given(&self) -> Result<Vec<FreeCorners>, String> {
        let corners = |t: &[Corner; 3]| FreeCorners::new(t.map(|c| [c.x, c.y]));
        self.triangles.iter().map(|t| corners(t).map_err(|refusal| refusal.to_string())).collect()
    }

    /// The triangles as the specimens take them: real numbers, the lattice's where they snap.
    pub fn as_real(&self) -> Result<Vec<RealTriangle>, String> {
        if self.snap {
            return Ok(self
                .on_lattice()?
                .iter()
                .map(rasterproof_faults::published::from_screen)
                .collect());
        }
        self.as_given()?;
        let vertex = |c: &Corner| RealVertex {
            position_px: DVec2::new(c.x, c.y),
            depth: c.depth,
            w: c.w.clamp(MIN_W, MAX_W),
            varying: DVec2::new(c.u, c.v),
        };
        Ok(self.triangles.iter().map(|t| [vertex(&t[0]), vertex(&t[1]), vertex(&t[2])]).collect())
    }

    pub fn lines(&self) -> Vec<Line> {
        let pixel = |[x, y]: [i32; 2]| PixelPoint::new(x, y);
        self.lines.iter().map(|[a, b]| plain_line(pixel(*a), pixel(*b))).collect()
    }

    pub fn case(&self) -> Result<Case, String> {
        let shape = match (self.lines.is_empty(), self.snap) {
            (false, _) => Shape::Lines(self.lines()),
            (true, true) => Shape::Triangles { list: self.on_lattice()?, disjoint: false },
            (true, false) => Shape::Unsnapped { list: self.as_given()?, is_tiling: false },
        };
        Ok(Case { window: self.window()?, shape })
    }
}

/// What travels to the page; windows that are too large for it are cut.
impl From<&Case> for Picture {
    fn from(case: &Case) -> Self {
        let mut picture =
            Self { window: cut(case.window), snap: true, triangles: Vec::new(), lines: Vec::new() };
        match &case.shape {
            Shape::Triangles { list, .. } => {
                picture.triangles = list.iter().map(|t| t.vertices.map(corner)).collect();
            }
            Shape::Lines(lines) => {
                let end = |p: PixelPoint| [p.x, p.y];
                let ends = lines.iter().map(|l| [end(l.ends[0].pixel), end(l.ends[1].pixel)]);
                picture.lines = ends.collect();
            }
            Shape::Unsnapped { list, .. } => {
                let corner = |[x, y]: [f64; 2]| Corner { x, y, w: 1.0, depth: 0.0, u: 0.0, v: 0.0 };
                picture.triangles = list.iter().map(|t| t.px().map(corner)).collect();
                picture.snap = false;
            }
            Shape::Numbers { .. } => {}
        }
        picture
    }
}

fn corner(vertex: ScreenVertex<DVec2>) -> Corner {
    let (x, y) = vertex.position.to_px();
    let DVec2 { x: u, y: v } = vertex.varying;
    Corner { x, y, w: 1.0 / vertex.inv_w, depth: vertex.depth, u, v }
}

fn cut(window: PixelRect) -> [i32; 4] {
    let end = |low: i32, high: i32| high.min(low.saturating_add(MOST_SIDE_PX as i32));
    [window.x0, window.y0, end(window.x0, window.x1), end(window.y0, window.y1)]
}

/// Positions in pixels, for the outline of what was drawn.
pub(super) fn in_px(corners: Corners) -> [[f64; 2]; 3] {
    corners.map(|p| [p.x, p.y].map(|sub| f64::from(sub) / f64::from(SUBPIXELS)))
}
