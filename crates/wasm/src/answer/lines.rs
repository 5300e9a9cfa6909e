//! Lines: the pixels of each drawer in the order it sets them, beside the exact height of the line.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::{Picture, panels};
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::PublishedLine;
use rasterproof_registry::engines::{self, LineEngine, Specimen};
use rasterproof_verify::cases::Line;

/// Who draws lines on this page.
#[derive(Clone, Copy)]
pub(crate) enum Pen {
    Engine(LineEngine),
    Published(&'static dyn PublishedLine),
}

impl Pen {
    /// The one of this name, if it draws lines.
    pub fn find(name: &str) -> Result<Self, NoAnswer> {
        let entry = engines::find(name).ok_or_else(|| format!("nobody is called {name}"))?;
        match (entry.line_engine, entry.specimen) {
            (Some(engine), _) => Ok(Self::Engine(engine)),
            (_, Some(Specimen::Line(specimen))) => Ok(Self::Published(specimen)),
            _ => Err(format!("{name} draws no lines").into()),
        }
    }

    /// The pixels in the window, in order.
    pub fn pixels(self, line: &Line, window: PixelRect) -> Result<Vec<[i32; 2]>, NoAnswer> {
        let mut pixels = Vec::new();
        match self {
            Self::Engine(engine) => engine.draw(line, window, |f| pixels.push([f.x_px, f.y_px])),
            Self::Published(specimen) => {
                // The centre of a pixel is its position.
                let ends = line.ends.map(|e| [e.pixel.x, e.pixel.y].map(|v| f64::from(v) + 0.5));
                specimen.draw(ends, window, &mut |x, y| pixels.push([x, y]))?;
            }
        }
        Ok(pixels)
    }

    /// The pixels of each of several lines.
    pub fn each(self, lines: &[Line], window: PixelRect) -> Result<Vec<Vec<[i32; 2]>>, NoAnswer> {
        lines.iter().map(|line| self.pixels(line, window)).collect()
    }
}

/// How many of these pixels are none of the right ones.
pub(crate) fn strangers(pixels: &[[i32; 2]], right: &[[i32; 2]]) -> usize {
    pixels.iter().filter(|pixel| !right.contains(pixel)).count()
}

/// Asks for the lines of a picture by several drawers.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Lines {
    picture: Picture,
    by: Vec<String>,
}

impl Lines {
    /// Panels with the pixels of each line, and how many are `missing` and `extra`; the right ones are in `truth`, and what each line
    /// is in exact numbers in `lines`.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let window = self.picture.window()?;
        let lines = self.picture.lines();
        let truth = Pen::Engine(LineEngine::Oracle).each(&lines, window)?;
        let panels = panels(&self.by, |name| {
            let drawn = Pen::find(name)?.each(&lines, window)?;
            Ok(compared(&drawn, &truth))
        });
        let heights: Vec<_> = lines.iter().map(heights).collect();
        Ok(json!({ "panels": panels, "truth": truth, "lines": heights }))
    }
}

/// The pixels of each line beside the right ones.
fn compared(drawn: &[Vec<[i32; 2]>], truth: &[Vec<[i32; 2]>]) -> Value {
    let (mut missing, mut extra) = (0, 0);
    for (pixels, right) in drawn.iter().zip(truth) {
        missing += strangers(right, pixels);
        extra += strangers(pixels, right);
    }
    json!({ "missing": missing, "extra": extra, "pixels": drawn })
}

/// Which axis counts the steps, and what the line rises by in all of them: after k steps it is at
/// k rise / length, exactly.
fn heights(line: &Line) -> Value {
    let [a, b] = line.ends.map(|end| end.pixel);
    let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
    let x_is_major = dx.abs() >= dy.abs();
    let (length, rise) = if x_is_major { (dx.abs(), dy) } else { (dy.abs(), dx) };
    json!({ "major": if x_is_major { "x" } else { "y" }, "length": length, "rise": rise })
}
