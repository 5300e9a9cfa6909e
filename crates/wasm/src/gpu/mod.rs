//! The page "Your GPU": cases for a browser's graphics interface to draw, and how its pixels stand to
//! what the interface promises.
//!
//! The page asks for a batch of subjects, draws each in a cell of one picture, reads the picture back and
//! sends it here to be judged: see `docs/your-gpu.md`. [`subjects`] makes the subjects of each check,
//! [`place`] says where a sample lies with respect to a triangle, [`expected`] what each check expects, and
//! [`judge`] compares. [`shrink`] makes a case that fails smaller, and [`cause`] asks more of a device that covers other pixels than it may:
//! both are searches that lie here between two pictures.

mod cause;
mod expected;
mod judge;
mod place;
mod shrink;
mod subjects;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::no_answer::NoAnswer;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
pub(crate) use judge::Judge;
use rasterproof_core::grid::{SUBPIXEL_BITS, SUBPIXELS};
use rasterproof_verify::specification::{OPENGL_ES, Source, WEBGPU};

/// What is checked, in the order of the page. Positions come first, because all others are placed on the
/// lattice that is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Topic {
    Lattice,
    /// Which pixels triangles and meshes cover.
    Coverage,
    /// The same of triangles that reach far beyond their cell.
    Reach,
    /// Whether every pixel of a cell that is tiled by triangles is hit once, wherever their corners lie.
    Tiling,
    /// Whether the order of the corners matters.
    Order,
    /// Which windings are culled.
    Facing,
    Lines,
    /// Whether the nearer of two triangles is kept.
    Depth,
    /// Depth, and two attributes in perspective.
    Values,
    NearPlane,
    Samples,
    /// Whether the same commands make the same picture: the second drawing is judged by the first.
    Twice,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Interface {
    Webgl2,
    Webgpu,
}

impl Interface {
    /// What it is judged by.
    fn source(self) -> Source {
        match self {
            Self::Webgl2 => OPENGL_ES,
            Self::Webgpu => WEBGPU,
        }
    }
}

/// What the page knows of the device when it sends a question.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Device {
    pub interface: Interface,
    /// Bits below the pixel, as the interface says or as they were inferred.
    pub bits: u32,
    /// Whether the four samples of a pixel can be read one by one.
    pub samples_apart: bool,
}

impl Device {
    /// A step of the device's lattice in subpixels.
    fn step(self) -> i32 {
        SUBPIXELS >> self.bits.clamp(1, SUBPIXEL_BITS)
    }
}

/// A vertex in its cell: x w, y w, depth w and w, with x and y in px from the cell's corner and depths from
/// 0 to 1, and two attributes.
type Vertex = [f64; 6];

/// What is drawn in one cell: triangles, or lines of two vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Drawing(pub Vec<Vec<Vertex>>);

/// Subjects of a check that are drawn into one picture.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Batch {
    check: Topic,
    device: Device,
    seed: u64,
    /// Which batch of the check.
    #[serde(default)]
    number: u64,
    /// This subject alone, in place of those of a number.
    only: Option<Drawing>,
}

/// How cells lie in a picture.
#[derive(Clone, Copy, Debug)]
struct Layout {
    side: i32,
    cell: i32,
    /// Empty cells around, for what reaches beyond its cell.
    margin: i32,
    /// Whether each subject is drawn by itself, cut to its cell.
    scissor: bool,
}

impl Layout {
    /// Cells in a row of the picture.
    fn columns(self) -> i32 {
        self.side / self.cell - 2 * self.margin
    }

    /// Cells that are used; more would make a batch take long.
    fn room(self) -> usize {
        (self.columns() * self.columns()) as usize
    }

    /// The first column and row of a cell.
    fn origin(self, index: usize) -> [i32; 2] {
        let (index, columns) = (index as i32, self.columns());
        [index % columns, index / columns].map(|at| (at + self.margin) * self.cell)
    }
}

impl Topic {
    /// What a picture holds, as the page's drawing code is told.
    fn kind(self) -> &'static str {
        match self {
            Self::Values => "values",
            Self::Depth => "depth",
            Self::Samples => "samples",
            Self::Lines => "lines",
            Self::Facing => "facing",
            _ => "hits",
        }
    }

    /// What the first attribute is multiplied by. A hit is 16 steps of a byte, so that several of them add up; the number of one of 64
    /// triangles is so many times 3, and nothing adds up.
    fn scale(self) -> f64 {
        if self == Self::Depth { 3.0 / 16.0 } else { 1.0 }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Plan {}

impl Plan {
    /// The batches of all checks, in the order in which the page asks for them.
    pub fn answer(&self) -> Value {
        let mut all = Vec::new();
        for (check, batches) in &subjects::PLAN {
            for number in 0..*batches {
                all.push(json!({ "check": check, "number": number }));
            }
        }
        json!({ "batches": all })
    }
}

impl Batch {
    /// Draws a subject of its own in place of those of a number.
    fn subjects(&self) -> Result<(Layout, Vec<Drawing>), NoAnswer> {
        let (mut layout, mut list) = subjects::of(self.check, self.device, self.seed, self.number);
        if let Some(subject) = &self.only {
            layout = subjects::layout_for(self.check, subject)?;
            list = vec![subject.clone()];
        }
        list.truncate(layout.room());
        Ok((layout, list))
    }

    /// The picture to draw, as numbers for the interface.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let (layout, list) = self.subjects()?;
        let drawn = list.iter().map(|subject| subjects::drawn(self.check, subject));
        Ok(self.device.picture(self.check, layout, drawn))
    }
}

impl Device {
    /// Clip coordinates of a vertex whose cell begins at a pixel, as the interface takes them.
    fn clip(self, [x, y, z, w, a, b]: Vertex, side: i32, origin: [i32; 2]) -> [f32; 6] {
        let ndc = |v: f64, origin: i32| 2.0 * (v + f64::from(origin) * w) / f64::from(side) - w;
        let (x, y) = (ndc(x, origin[0]), ndc(y, origin[1]));
        // Row 0 of what is read back is the lowest of WebGL and the uppermost of WebGPU.
        let (y, z) = match self.interface {
            Interface::Webgl2 => (y, 2.0 * z - w),
            Interface::Webgpu => (-y, z),
        };
        [x, y, z, w, a, b].map(|v| v as f32)
    }

    /// What the page draws: the vertices of each subject in its cell.
    fn picture(
        self,
        check: Topic,
        layout: Layout,
        subjects: impl Iterator<Item = Vec<Vertex>>,
    ) -> Value {
        let (mut bytes, mut draws) = (Vec::new(), Vec::new());
        for (index, vertices) in subjects.enumerate() {
            // Each subject is moved to its own cell.
            let origin = layout.origin(index);
            draws.push([vertices.len() as i32, origin[0], origin[1]]);
            for mut vertex in vertices {
                vertex[4] *= check.scale();
                for number in self.clip(vertex, layout.side, origin) {
                    bytes.extend(number.to_le_bytes());
                }
            }
        }
        json!({
            "kind": check.kind(), "side": layout.side, "cell": layout.cell, "subjects": draws.len(),
            "draws": if layout.scissor { draws } else { Vec::new() },
            "vertices": STANDARD.encode(bytes),
        })
    }
}
