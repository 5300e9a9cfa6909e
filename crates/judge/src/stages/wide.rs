//! The pixels of a line with a width, drawn by somebody who may be mistaken.

use super::grids::{on_grid, unit};
use super::samples::{TIES, facing};
use super::search::{Field, Quantity, Spot, Stage, choices, composed};
use crate::ask::{Answer, Asked, Question};
use crate::declared::Declared;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{WideForm, WideLine};
use rasterproof_verify::comparison::Convention;
use rasterproof_verify::comparison::pixels::hits;
use rasterproof_verify::convention::{Quantum, RULES, Rounding, Ties};
use rasterproof_verify::oracle::wide;

composed! {
    /// How lines with a width are drawn.
    pub struct WideDrawn {
        gate: LineGate,
        ends: EndGrid,
        thickness: Thickness,
        caps: Caps,
        corners: CornerGrid,
        border: BorderRule,
    }
}

on_grid! {
    /// The grid that both ends are put on before anything is computed.
    pub struct EndGrid: "ends of wide lines", "draws {{}} from ends that are {}",
        "take the ends as they are asked", [Down, Near]
}

choices! {
    /// How wide a line is drawn.
    pub enum Thickness: "width of wide lines", "draw a line as wide as it is asked" {
        Right,
        Double = "draws {} twice as wide",
        Half = "draws {} half as wide",
        One = "draws {} 1 px wide",
        More = "draws {} 1 px wider",
        Less = "draws {} 1 px narrower",
        Down = "draws {} as wide as its width rounded down to whole pixels",
        Near = "draws {} as wide as its width rounded to whole pixels",
        Up = "draws {} as wide as its width rounded up to whole pixels",
        AtLeast = "draws {} at least 1 px wide",
        Odd = "draws {} as wide as the next odd number of pixels that is no smaller than its width rounded down",
    }
}

impl Thickness {
    /// The width that is drawn for one that is asked.
    fn of(self, width: i32) -> i32 {
        let px = SUBPIXELS;
        // A width below 0 is none.
        let drawn = match self {
            Self::Right => width,
            Self::Double => 2 * width,
            Self::Half => width / 2,
            Self::One => px,
            Self::More => width + px,
            Self::Less => width - px,
            Self::Down => width / px * px,
            Self::Near => (width + px / 2) / px * px,
            Self::Up => (width + px - 1) / px * px,
            Self::AtLeast => width.max(px),
            Self::Odd => width / (2 * px) * 2 * px + px,
        };
        drawn.max(0)
    }
}

choices! {
    /// The form of a line, where it is not the declared one.
    pub enum Caps: "form of wide lines",
        "draw a rectangle that is cut off at right angles at both ends, or what is declared" {
        Right,
        Rectangle = "draws {} as rectangles",
        Parallelogram = "draws {} as parallelograms, as wide along the shorter axis",
        Square = "draws {} longer at both ends by half their width",
        Round = "draws {} with half a disc at both ends",
        AlongX = "draws {} as wide along x, whatever their direction",
        AlongY = "draws {} as wide along y, whatever their direction",
    }
}

/// The grid of the four corners of the form, in subpixels; 0 where they are not rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CornerGrid(i32);

impl Field for CornerGrid {
    const NAME: &'static str = "corners of wide lines";

    fn options() -> Vec<Self> {
        (0..=8).map(|bits| Self(1 << bits)).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        Some((
            format!("draws {{}} with corners that are rounded to {}", unit(self.0)),
            "do not round the corners of the rectangle, which are irrational",
        ))
    }
}

/// The rule for samples on the border, by its number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BorderRule(Option<usize>);

impl Field for BorderRule {
    const NAME: &'static str = "border of wide lines";

    fn options() -> Vec<Self> {
        (0..TIES.len()).map(|rule| Self(Some(rule))).collect()
    }

    fn says(&self) -> Option<(String, &'static str)> {
        let rule = RULES[self.0?];
        Some((
            format!("draws {{}} by the rule '{rule}'"),
            "draw samples on the border by the declared rule",
        ))
    }
}

choices! {
    /// Pixels that are drawn without regard to the line.
    pub enum LineGate: "pixels of wide lines", "draw the pixels whose samples lie in the rectangle, once each" {
        None,
        Never = "does not draw {}",
        Always = "draws every pixel",
        Twice = "draws {} twice",
    }
}

/// A pixel beside a line.
pub struct WidePixel<'a> {
    pub(super) spot: Spot,
    pub(super) line: &'a WideLine,
    convention: Convention,
    form: WideForm,
    /// How often it is drawn.
    hits: u8,
    /// Whether it has to be drawn, and whether it may be.
    pub(super) right: [bool; 2],
}

/// A vector in subpixels.
type Vector = [f64; 2];

/// The vector from the first end of a line to the second, and to a sample.
fn vectors(line: &WideLine, sample: [i64; 2]) -> [Vector; 2] {
    let [a, b] = line.ends.map(|p| [f64::from(p.x), f64::from(p.y)]);
    [[b[0] - a[0], b[1] - a[1]], [sample[0] as f64 - a[0], sample[1] as f64 - a[1]]]
}

/// How far a sample lies beside the long sides of the rectangle, and beyond its ends, in subpixels: below 0 inside.
fn outside(line: &WideLine, sample: [i64; 2]) -> [f64; 2] {
    let [by, to] = vectors(line, sample);
    let length = (by[0] * by[0] + by[1] * by[1]).sqrt().max(1.0);
    let beside = (by[0] * to[1] - by[1] * to[0]).abs() / length - f64::from(line.width) / 2.0;
    let along = (by[0] * to[0] + by[1] * to[1]) / length;
    [beside, (-along).max(along - length)]
}

impl WidePixel<'_> {
    /// The sample, in subpixels.
    fn sample(&self) -> [i64; 2] {
        let of = |k: usize| i64::from(self.spot.at[k]) * i64::from(SUBPIXELS);
        [0, 1].map(|k| of(k) + i64::from(self.convention.sample[k]))
    }

    /// From the first end of its line to the second along an axis, in pixels.
    fn by_px(&self, axis: usize) -> f64 {
        vectors(self.line, [0; 2])[0][axis] / f64::from(SUBPIXELS)
    }

    /// See [`outside`].
    pub(super) fn outside(&self) -> [f64; 2] {
        outside(self.line, self.sample())
    }
}

impl WideDrawn {
    /// Whether the pixel is drawn, where each edge owns its samples as this says.
    fn covers(&self, pixel: &WidePixel<'_>, owns: &dyn Fn([i64; 2]) -> bool) -> bool {
        // The ends and the width as the program takes them.
        let [a, b] = pixel.line.ends;
        let [a, b, _] = self.ends.0.snap(&[a, b, b]);
        let width = self.thickness.of(pixel.line.width);
        let (line, sample) = (WideLine { ends: [a, b], width }, pixel.sample());
        if width == 0 {
            return false;
        }
        // Forms without rounded corners are decided exactly.
        let of = |form| wide::covers(&line, form, sample, owns);
        if self.corners != CornerGrid::default() || matches!(self.caps, Caps::AlongX | Caps::AlongY)
        {
            return self.by_corners(&line, pixel.form, sample, owns);
        }
        match self.caps {
            Caps::Right => of(pixel.form),
            Caps::Rectangle | Caps::AlongX | Caps::AlongY => of(WideForm::Rectangle),
            Caps::Parallelogram => of(WideForm::Parallelogram),
            Caps::Square => {
                let [beside, beyond] = outside(&line, sample);
                a != b && beside <= 0.0 && beyond <= f64::from(width) / 2.0
            }
            Caps::Round => {
                let is_near = |end: SubpixelPoint| {
                    let square = |v: i64, end: i32| (2 * i128::from(v - i64::from(end))).pow(2);
                    square(sample[0], end.x) + square(sample[1], end.y) <= i128::from(width).pow(2)
                };
                is_near(a) || is_near(b) || of(pixel.form)
            }
        }
    }

    /// From an end to the corner right of it, as seen from the first end towards the second with y down.
    fn across(&self, [dx, dy]: Vector, form: WideForm, width: f64) -> Vector {
        // Half the width at right angles to the line, or along the axis that the form is as wide along.
        let along_x = [-width / 2.0 * dy.signum(), 0.0];
        let along_y = [0.0, width / 2.0 * dx.signum()];
        let length = (dx * dx + dy * dy).sqrt();
        match (self.caps, form) {
            (Caps::AlongX, _) => along_x,
            (Caps::AlongY, _) => along_y,
            (Caps::Right, WideForm::Parallelogram) | (Caps::Parallelogram, _) => {
                if dx.abs() >= dy.abs() { along_y } else { along_x }
            }
            _ => [-dy / length * width / 2.0, dx / length * width / 2.0],
        }
    }

    /// The same of four corners, that are rounded or not. They are counted in halves of a subpixel.
    fn by_corners(
        &self,
        line: &WideLine,
        form: WideForm,
        sample: [i64; 2],
        owns: &dyn Fn([i64; 2]) -> bool,
    ) -> bool {
        let [by, to] = vectors(line, sample);
        if by == [0.0; 2] {
            return false;
        }
        // The four corners, each half the width from an end, on the lattice.
        let half = self.across(by, form, line.width.into());
        let step = f64::from((2 * self.corners.0).max(1));
        // From the first end; the lattice is that of the window.
        let corner = |end: Vector, sign: f64| {
            [0, 1].map(|k| {
                let start = sample[k] as f64 - to[k];
                (2.0 * (start + end[k] + sign * half[k]) / step).round() as i64 * step as i64
            })
        };
        let none = [0.0; 2];
        let corners = [corner(none, -1.0), corner(by, -1.0), corner(by, 1.0), corner(none, 1.0)];
        let product = |p: [i64; 2], q: [i64; 2]| {
            i128::from(p[0]) * i128::from(q[1]) - i128::from(p[1]) * i128::from(q[0])
        };
        let minus = |p: [i64; 2], q: [i64; 2]| [p[0] - q[0], p[1] - q[1]];
        // The sample lies inside where it is on the inner side of all four sides.
        let has_area = product(minus(corners[1], corners[0]), minus(corners[3], corners[0])) > 0;
        has_area
            && (0..4).all(|i| {
                let way = minus(corners[(i + 1) % 4], corners[i]);
                let side = product(way, minus(sample.map(|v| 2 * v), corners[i]));
                side > 0 || (side == 0 && owns([way[1], -way[0]]))
            })
    }

    /// Whether it has to be drawn, and whether it may be.
    pub(super) fn draws(&self, pixel: &WidePixel<'_>) -> [bool; 2] {
        // A gate decides before the border, and a border rule before what is declared.
        match (self.gate, self.border.0) {
            (LineGate::Never, _) => [false; 2],
            (LineGate::Always, _) => [true; 2],
            _ if Self { gate: LineGate::None, ..self.clone() } == Self::default() => pixel.right,
            (_, Some(rule)) => {
                let ties: &Ties = &TIES[rule];
                [self.covers(pixel, &|out| ties.edges[facing(out)]); 2]
            }
            _ => {
                let rules = pixel.convention.of_border();
                rules.map(|rule| self.covers(pixel, &|out| rule.owns(out)))
            }
        }
    }
}

/// Pixels around a line that are looked at.
const AROUND: f64 = 4.0 * SUBPIXELS as f64;

impl Stage for WideDrawn {
    type Part<'a> = WidePixel<'a>;
    const PAGE: &'static str = "judge";
    const REFUTED: &'static str = "a pixel that is drawn otherwise";
    const NOISE: &'static [f64] = &[0.0];
    const WHOM: &'static str = "pixels";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        _: f64,
    ) -> Vec<WidePixel<'a>> {
        let (Asked::Wide(line), Answer::Coverage(runs)) = (&question.of, answer) else {
            return Vec::new();
        };
        let window = PixelRect::window(question.width, question.height);
        // Every pixel of the window, as far as any mistake might draw it.
        let (convention, form) = (declared.convention, declared.wide);
        let mut parts = Vec::new();
        for (y, row) in hits(runs, window).0.rows() {
            for (x, &drawn) in (window.x0..).zip(row) {
                let right = convention.expected_of_wide(line, form, [x, y]);
                let spot = Spot { at: [x, y], is_clockwise: true, window };
                let pixel = WidePixel {
                    spot,
                    line,
                    convention,
                    form,
                    hits: if declared.mask { drawn.min(1) } else { drawn },
                    right,
                };
                let reach = f64::from(line.width) / 2.0 + AROUND;
                // Nothing is drawn there by most of the mistakes.
                if pixel.hits > 0 || right[1] || pixel.outside().iter().all(|v| *v < reach) {
                    parts.push(pixel);
                }
            }
        }
        parts
    }

    fn explains(&self, part: &WidePixel<'_>) -> bool {
        // On the border a pixel may be drawn or not, unless a rule says which.
        let [must, may] = self.draws(part);
        let times = if self.gate == LineGate::Twice { 2 } else { 1 };
        if part.hits > 0 { may && part.hits == times } else { !must }
    }

    fn quantities(pixel: &WidePixel<'_>) -> Vec<Quantity> {
        // A line has no winding.
        let mut all = pixel.spot.place();
        let width = f64::from(pixel.line.width) / f64::from(SUBPIXELS);
        all.push(Quantity::number("the width of the line in px", width));
        let [columns, rows] = [pixel.by_px(0), pixel.by_px(1)];
        all.push(Quantity::number("the columns from the first end to the second, in px", columns));
        all.push(Quantity::number("the rows from the first end to the second, in px", rows));
        all
    }

    fn filled(&self, does: &str) -> String {
        does.replace("{}", "lines with a width")
    }
}
