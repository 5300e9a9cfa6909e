//! The level of a pixel by the share of it that a triangle covers, computed by somebody who may be mistaken.

use super::grids::on_grid;
use super::search::{Field, Quantity, Spot, Stage, choices, composed};
use crate::ask::{Answer, Asked, Question};
use crate::declared::Declared;
use crate::pixels::painted;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_verify::convention::{Quantum, Rounding};
use rasterproof_verify::oracle::area::share;

composed! {
    /// How the level of a pixel is computed.
    pub struct AreaDrawn {
        gate: AreaGate,
        corners: CornerGrid,
        sampling: Sampling,
        tone: Tone,
        rounding: LevelRounding,
        steps: Steps,
    }
}

on_grid! {
    /// The grid that corners are put on before anything is computed.
    pub struct CornerGrid: "corners of shares", "computes {{}} of corners that are {}",
        "take the corners as they are asked", [Down, Near, HalfEven]
}

/// By which part of a pixel its share is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Sampling {
    #[default]
    Exact,
    /// So many samples in so many rows, at the middles of equal cells.
    Samples(i32, i32),
    /// So many rows, each with the exact length that is covered.
    Rows(i32),
}

/// How many samples along both sides of a pixel, and how many rows, are tried.
const SAMPLES: [i32; 7] = [1, 2, 3, 4, 5, 8, 16];

impl Sampling {
    /// The share of a pixel, as far as these samples or rows show it.
    fn share(self, corners: &Corners, [x_px, y_px]: [i32; 2]) -> f64 {
        match self {
            Self::Exact => share(corners, x_px, y_px),
            Self::Samples(columns, rows) => {
                // Each row of samples begins and ends where its middle crosses the edges.
                let mut covered = 0;
                for row in 0..rows {
                    let Some([left, right]) = across(corners, y_px, row, rows) else { continue };
                    for column in 0..columns {
                        let x = f64::from(x_px) + (f64::from(column) + 0.5) / f64::from(columns);
                        covered += i32::from(left <= x && x < right);
                    }
                }
                f64::from(covered) / f64::from(columns * rows)
            }
            Self::Rows(rows) => {
                let x = f64::from(x_px);
                let of = |row| {
                    across(corners, y_px, row, rows)
                        .map_or(0.0, |[left, right]| (right.min(x + 1.0) - left.max(x)).max(0.0))
                };
                (0..rows).map(of).sum::<f64>() / f64::from(rows)
            }
        }
    }
}

/// Where the middle of one of the rows of a pixel enters a triangle and leaves it, in pixels.
fn across(corners: &Corners, y_px: i32, row: i32, rows: i32) -> Option<[f64; 2]> {
    // The middle of the row.
    let y = f64::from(y_px) + (f64::from(row) + 0.5) / f64::from(rows);
    let mut found: Option<[f64; 2]> = None;
    for i in 0..3 {
        let (ax, ay) = corners[i].to_px();
        let (bx, by) = corners[(i + 1) % 3].to_px();
        // An edge that the row does not cross.
        if (ay <= y) == (by <= y) {
            continue;
        }
        // Where it crosses, in doubles: programs that sample do no better.
        let x = ax + (y - ay) * (bx - ax) / (by - ay);
        let [left, right] = found.unwrap_or([x, x]);
        found = Some([left.min(x), right.max(x)]);
    }
    found
}

impl Field for Sampling {
    const NAME: &'static str = "samples of shares";

    fn options() -> Vec<Self> {
        let squares = SAMPLES.map(|n| Self::Samples(n, n));
        let rows = SAMPLES.into_iter().chain([15, 17, 64]).map(Self::Rows);
        squares.into_iter().chain(rows).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let does = match self {
            Self::Exact => return None,
            Self::Samples(1, 1) => "computes {} by the sample at the centre alone".to_owned(),
            Self::Samples(n, m) => format!("computes {{}} by {n} x {m} samples"),
            Self::Rows(1) => {
                "computes {} by the length that is covered in the middle row of a pixel".to_owned()
            }
            Self::Rows(n) => {
                format!("computes {{}} by the lengths that are covered in {n} rows of a pixel")
            }
        };
        Some((does, "compute the area that is covered"))
    }
}

choices! {
    /// What becomes of a share before it is a level.
    pub enum Tone: "tone of shares", "answer with the share itself; what a screen needs comes later" {
        Linear,
        Encoded = "encodes {} as sRGB",
        Root = "takes the square root of {}",
        Square = "squares {}",
        Rest = "draws the share that is not covered, in place of {}",
        Half = "draws half of {}",
        Double = "draws twice {}, at most all",
    }
}

impl Tone {
    /// What becomes of a share between 0 and 1.
    fn of(self, share: f64) -> f64 {
        match self {
            Self::Linear => share,
            Self::Encoded if share <= 0.003_130_8 => 12.92 * share,
            Self::Encoded => 1.055 * libm::pow(share, 1.0 / 2.4) - 0.055,
            Self::Root => share.sqrt(),
            Self::Square => share * share,
            Self::Rest if share == 0.0 => 0.0,
            Self::Rest => 1.0 - share,
            Self::Half => share / 2.0,
            Self::Double => (2.0 * share).min(1.0),
        }
    }
}

choices! {
    /// How a share becomes a whole number of steps: to any number within the tolerance, where nothing else is said.
    pub enum LevelRounding: "rounding of shares", "round the share to the nearest step" {
        Near,
        Down = "rounds {} down",
        Up = "rounds {} up",
        Any = "rounds {} to all steps where more than half a pixel is covered, and to none elsewhere",
    }
}

/// How many steps a whole pixel has, where that is another number than declared: the levels are cut to the declared ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steps(Option<i32>);

impl Field for Steps {
    const NAME: &'static str = "steps of shares";

    fn options() -> Vec<Self> {
        [256, 254, 128, 127, 100, 64, 63, 16, 15].map(|steps| Self(Some(steps))).to_vec()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        Some((format!("counts {{}} in steps of 1/{}", self.0?), "count the declared steps"))
    }
}

choices! {
    /// Pixels that are drawn without regard to their share.
    pub enum AreaGate: "pixels of shares", "draw each pixel by the share that is covered" {
        None,
        Never = "does not draw {}",
        Whole = "draws touched pixels whole, and not {}",
    }
}

/// A pixel of the window with the level that was answered for it, 0 where there was none.
pub struct AreaPixel<'a> {
    pub(super) spot: Spot,
    corners: &'a Corners,
    /// The level that was answered, 0 where there was none.
    pub(super) drawn: u8,
    /// How much of it the triangle covers, exactly: 0 where the winding is not drawn.
    pub(super) share: f64,
    /// The level of a pixel that is covered whole.
    levels: f64,
    /// How many steps the level may be off.
    tolerance: f64,
}

impl AreaDrawn {
    /// The level that is drawn, not rounded, and how far it may be off.
    fn level(&self, pixel: &AreaPixel<'_>) -> [f64; 2] {
        // The share as it is sampled, then as it is changed, in steps of a level.
        let share = match (self.corners == CornerGrid::default(), self.sampling) {
            (true, Sampling::Exact) => pixel.share,
            _ => self.sampling.share(&self.corners.0.snap(pixel.corners), pixel.spot.at),
        };
        let share = match self.gate {
            AreaGate::None => self.tone.of(share),
            AreaGate::Never => 0.0,
            AreaGate::Whole => f64::from(u8::from(share > 0.0)),
        };
        // A whole pixel has the declared number of steps, or another one.
        let steps = self.steps.0.map_or(pixel.levels, f64::from) * share;
        // A hair on either side, for roundings of floats.
        let level = match self.rounding {
            LevelRounding::Near => return [steps.min(pixel.levels), pixel.tolerance],
            LevelRounding::Down => (steps + 1e-7).floor(),
            LevelRounding::Up => (steps - 1e-7).ceil(),
            LevelRounding::Any => f64::from(u8::from(share >= 0.5)) * pixel.levels,
        };
        [level.min(pixel.levels), 1e-6]
    }
}

impl Stage for AreaDrawn {
    type Part<'a> = AreaPixel<'a>;
    const PAGE: &'static str = "judge";
    const REFUTED: &'static str = "a pixel of another level";
    const NOISE: &'static [f64] = &[0.0];
    const WHOM: &'static str = "pixels";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        _: f64,
    ) -> Vec<AreaPixel<'a>> {
        let (Asked::Area(corners), Answer::Area(runs)) = (&question.of, answer) else {
            return Vec::new();
        };
        let window = PixelRect::window(question.width, question.height);
        let is_clockwise = twice_area(corners) > 0;
        // Every pixel of the window has a level, 0 where nothing was drawn.
        let (levels, tolerance) = (declared.levels.into(), declared.steps_off());
        let mut parts = Vec::new();
        for (y, row) in painted(runs, window, 0, |here, level| *here = level).rows() {
            for (x, &drawn) in (window.x0..).zip(row) {
                let share = declared.share(corners, [x, y]);
                let spot = Spot { at: [x, y], is_clockwise, window };
                parts.push(AreaPixel { spot, corners, drawn, share, levels, tolerance });
            }
        }
        parts
    }

    fn explains(&self, part: &AreaPixel<'_>) -> bool {
        let [level, tolerance] = self.level(part);
        (f64::from(part.drawn) - level).abs() <= tolerance
    }

    fn quantities(pixel: &AreaPixel<'_>) -> Vec<Quantity> {
        let mut all = pixel.spot.quantities();
        all.push(Quantity::number("the share of the pixel that is covered", pixel.share));
        all
    }

    fn filled(&self, does: &str) -> String {
        does.replace("{}", "the share of a pixel")
    }
}
