//! Lines: the pixels of each drawer in the order it sets them, beside the exact height of the line.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use rasterproof_core::contract::DrawLine as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_faults::published::PublishedLine;
use rasterproof_registry::engines::{self, LineEngine, Specimen};
use rasterproof_verify::cases::Line;

#[derive(Clone, Copy)]
pub(super) enum Pen {
    Engine(LineEngine),
    Published(&'static dyn PublishedLine),
}

impl Pen {
    pub fn find(name: &str) -> Result<Self, String> {
        let entry = engines::find(name).ok_or_else(|| format!("nobody is called {name}"))?;
        match (entry.line_engine, entry.specimen) {
            (Some(engine), _) => Ok(Self::Engine(engine)),
            (_, Some(Specimen::Line(specimen))) => Ok(Self::Published(specimen)),
            _ => Err(format!("{name} draws no lines")),
        }
    }

    /// The pixels in the window, in order.
    pub fn pixels(self, line: &Line, window: PixelRect) -> Result<Vec<[i32; 2]>, String> {
        let mut pixels = Vec::new();
        match self {
            Self::Engine(engine) => engine.draw(line, window, |f| pixels.push([f.x_px, f.y_px])),
            Self::Published(specimen) => {
                // The centre of a pixel is its position.
                let ends = line.ends.map(|e| [e.pixel.x, e.pixel.y].map(|v| f64::from(v) + 0.5));
                specimen
                    .draw(ends, window, &mut |x, y| pixels.push([x, y]))
                    .map_err(|refused| refused.to_string())?;
            }
        }
        Ok(pixels)
    }
}

/// Asks for the lines of a picture by several drawers.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Lines {
    picture: Picture,
    by: Vec<String>,
}

impl Lines {
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let lines = self.picture.lines();
        let draw = |pen: Pen| -> Result<Vec<_>, String> {
            lines.iter().map(|line| pen.pixels(line, window)).collect()
        };
        let truth = draw(Pen::Engine(LineEngine::Oracle))?;
        let panel = |name: &String| match Pen::find(name).and_then(draw) {
            Ok(drawn) => {
                let strangers = |drawn: &[Vec<[i32; 2]>], right: &[Vec<[i32; 2]>]| -> usize {
                    let of = |(a, b): (&Vec<[i32; 2]>, &Vec<[i32; 2]>)| {
                        a.iter().filter(|pixel| !b.contains(pixel)).count()
                    };
                    drawn.iter().zip(right).map(of).sum()
                };
                json!({
                    "name": name, "missing": strangers(&truth, &drawn),
                    "extra": strangers(&drawn, &truth), "pixels": drawn,
                })
            }
            Err(refused) => json!({ "name": name, "refused": refused }),
        };
        let panels: Vec<_> = self.by.iter().map(panel).collect();
        let heights: Vec<_> = lines.iter().map(heights).collect();
        Ok(json!({ "panels": panels, "truth": truth, "lines": heights }))
    }
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
