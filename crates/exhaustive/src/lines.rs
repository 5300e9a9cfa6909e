//! Every line up to a reach: both line drawers against the rule of [`DrawLine`], both directions,
//! in full and in two windows.
//!
//! The rule is a statement about each pixel, so it is asked of each pixel that comes out: one pixel
//! for each step along the major axis, and beside it -du < 2 (du v - dv u) sign(dv) <= du, where
//! u and v are measured from the end with the smaller major coordinate. The half-open interval of
//! length 2 du holds exactly one v for each u, so the rule determines the whole line. On all lines
//! up to a reach of 64 the oracle's own code, which asks every pixel of the window, is compared
//! too. No symmetry is used unless only the first octant is asked for, which the claim then says.
//!
//! Depths and varyings are not looked at.

use std::ops::{Add, Mul, Sub};

use serde::{Deserialize, Serialize};

use super::{Enumeration, Source, Tally, common_words};
use rasterproof_core::contract::DrawLine;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::source_text;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine, Varying};
use rasterproof_faults::planted::LineMutant;
use rasterproof_verify::oracle::Oracle;

/// The longest reach that is accepted, in pixels.
pub const MAX_REACH: u32 = 1 << 13;
/// Reach up to which the oracle's own code judges too.
const ORACLE_REACH: u32 = 64;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lines {
    /// Largest |dx| and |dy| in pixels.
    pub reach: u32,
    pub offset_px: [i32; 2],
    /// Only 0 <= dy <= dx.
    pub first_octant: bool,
    /// A mutant in the place of Bresenham's drawer.
    pub plant: Option<String>,
}

impl Enumeration for Lines {
    fn claim(&self) -> String {
        let range = if self.first_octant { "0 <= dy <= dx" } else { "|dx|, |dy|" };
        let [x, y] = self.offset_px;
        format!(
            "For every line from pixel ({x}, {y}) to the pixel (dx, dy) from it with {range} <= {reach}, drawn in both \
             directions: Bresenham's drawer and the DDA emit exactly the pixels of the rule of contract::DrawLine, \
             ties included, in order and once each, and in each of two windows that cut the lines exactly those \
             inside. On all lines of a reach up to {checked} the rule is compared in this run with the oracle's own \
             code (oracle_checks). Each comparison is one drawing by one drawer.",
            reach = self.reach,
            checked = self.reach.min(ORACLE_REACH),
        )
    }

    fn chunks(&self) -> u64 {
        let reach = u64::from(self.reach);
        if self.first_octant { reach + 1 } else { 2 * reach + 1 }
    }

    fn expected_cases(&self) -> u64 {
        let reach = u64::from(self.reach);
        if self.first_octant {
            (reach + 1) * (reach + 2) / 2
        } else {
            (2 * reach + 1) * (2 * reach + 1)
        }
    }

    fn expected_oracle_checks(&self) -> u64 {
        Self { reach: self.reach.min(ORACLE_REACH), ..self.clone() }.expected_cases()
    }

    fn judge(&self) -> Box<dyn Fn(u64) -> Tally + Sync + Send + '_> {
        let mutant = LineMutant::ALL.into_iter().find(|m| Some(m.name()) == self.plant.as_deref());
        match mutant {
            None => Box::new(move |chunk| self.chunk(chunk, &Bresenham)),
            Some(mutant) => Box::new(move |chunk| self.chunk(chunk, &mutant)),
        }
    }

    fn words(&self) -> String {
        let octant = if self.first_octant { " --first-octant" } else { "" };
        let common = common_words(self.offset_px, self.plant.as_deref());
        format!("lines --reach {}{octant}{common}", self.reach)
    }

    fn sources(&self) -> Vec<Source> {
        vec![
            Source::file("src/grid.rs", source_text::GRID),
            Source::file("src/line/dda.rs", source_text::DDA),
            Source::file("src/line/bresenham.rs", source_text::BRESENHAM),
            Source::file("src/oracle/pixels.rs", rasterproof_verify::source_text::ORACLE_PIXELS),
            Source::file("src/exhaust/lines.rs", include_str!("lines.rs")),
        ]
    }
}

struct Judged<'a> {
    line: ScreenLine<Nothing>,
    windows: [PixelRect; 3],
    /// Pixels in the order of drawing; kept from line to line to save allocations.
    pixels: &'a mut Vec<PixelPoint>,
    inside: &'a mut Vec<PixelPoint>,
}

impl Lines {
    fn chunk<A: DrawLine>(&self, chunk: u64, first: &A) -> Tally {
        let reach = self.reach as i32;
        let (dx, rows) = if self.first_octant {
            (chunk as i32, 0..=chunk as i32)
        } else {
            (chunk as i32 - reach, -reach..=reach)
        };
        let mut tally = Tally::default();
        let (mut pixels, mut inside) = (Vec::new(), Vec::new());
        for dy in rows {
            let [x, y] = self.offset_px;
            let ends = [PixelPoint::new(x, y), PixelPoint::new(x + dx, y + dy)];
            let mut judged = Judged {
                line: line_between(ends),
                windows: self.windows(dx, dy),
                pixels: &mut pixels,
                inside: &mut inside,
            };
            judged.judge(first, chunk, &mut tally);
            if dx.abs().max(dy.abs()) <= ORACLE_REACH as i32 {
                tally.oracle_checks += 1;
                if !judged.is_the_oracles() {
                    tally.wrong(chunk, || format!("{ends:?}: the oracle differs from the rule"));
                }
            }
            tally.cases += 1;
        }
        tally
    }

    /// Everything, a window around the start, and one that long lines of the octant pass through.
    fn windows(&self, dx: i32, dy: i32) -> [PixelRect; 3] {
        let n = self.reach as i32;
        let along = [n / 5, n / 2 + 1];
        let beside = [n / 8, n / 3 + 1];
        let (xs, ys) = if dy.abs() > dx.abs() { (beside, along) } else { (along, beside) };
        let mirrored = |[low, high]: [i32; 2], sign: i32| {
            if sign < 0 { [1 - high, 1 - low] } else { [low, high] }
        };
        let rect = |[x0, x1]: [i32; 2], [y0, y1]: [i32; 2]| {
            let [x, y] = self.offset_px;
            PixelRect { x0: x0 + x, y0: y0 + y, x1: x1 + x, y1: y1 + y }
        };
        [
            rect([-n, n + 1], [-n, n + 1]),
            rect([-n / 3, n / 2 + 1], [-n / 4, n / 3 + 1]),
            rect(mirrored(xs, dx), mirrored(ys, dy)),
        ]
    }
}

fn line_between(ends: [PixelPoint; 2]) -> ScreenLine<Nothing> {
    ScreenLine { ends: ends.map(|pixel| LineEnd { pixel, depth: 0.0, varying: Nothing }) }
}

impl Judged<'_> {
    /// Compares the first drawer with the rule, then every drawing by either drawer with that.
    fn judge<A: DrawLine>(&mut self, first: &A, chunk: u64, tally: &mut Tally) {
        let line = self.line;
        let [from, to] = line.ends.map(|end| end.pixel);
        let back = line_between([to, from]);
        let [everything, near, far] = self.windows;
        self.pixels.clear();
        first.draw(&line, everything, |f| self.pixels.push(PixelPoint::new(f.x_px, f.y_px)));
        tally.comparisons += 1;
        if !follows_the_rule(from, to, self.pixels) {
            tally.wrong(chunk, || {
                format!("{from:?} {to:?}: {} pixels do not follow the rule", self.pixels.len())
            });
        }
        for window in [everything, near, far] {
            self.inside.clear();
            self.inside.extend(self.pixels.iter().filter(|p| window.contains(p.x, p.y)));
            let there = || self.inside.iter();
            let here = || self.inside.iter().rev();
            let agrees = [
                draws(first, &line, window, there()),
                draws(first, &back, window, here()),
                draws(&Dda, &line, window, there()),
                draws(&Dda, &back, window, here()),
            ];
            tally.comparisons += agrees.len() as u64;
            if agrees != [true; 4] {
                tally.wrong(chunk, || {
                    format!("{from:?} {to:?} in {window:?}: Bresenham there and back, DDA there and back agree: {agrees:?}")
                });
            }
        }
    }

    /// Whether the oracle's code emits the same pixels, in every window.
    fn is_the_oracles(&self) -> bool {
        self.windows.iter().all(|window| {
            let mut expected = self.pixels.iter().filter(|p| window.contains(p.x, p.y));
            let mut same = true;
            Oracle.line_pixels(&self.line, *window, |pixel, _| {
                same &= expected.next() == Some(&pixel);
            });
            same && expected.next().is_none()
        })
    }
}

/// Whether a drawer emits exactly these pixels in this order.
#[inline]
fn draws<'a, D: DrawLine>(
    drawer: &D,
    line: &ScreenLine<Nothing>,
    window: PixelRect,
    mut expected: impl Iterator<Item = &'a PixelPoint>,
) -> bool {
    let mut same = true;
    drawer.draw(line, window, |f| {
        same &= expected.next() == Some(&PixelPoint::new(f.x_px, f.y_px));
    });
    same && expected.next().is_none()
}

/// Whether these are the pixels of the line by the rule of [`DrawLine`], in order.
fn follows_the_rule(from: PixelPoint, to: PixelPoint, pixels: &[PixelPoint]) -> bool {
    let steep = from.y.abs_diff(to.y) > from.x.abs_diff(to.x);
    // (along, beside) in a word that holds products of two lengths.
    let axes = |p: PixelPoint| {
        let (along, beside) = if steep { (p.y, p.x) } else { (p.x, p.y) };
        [i64::from(along), i64::from(beside)]
    };
    let (first, last) = (axes(from), axes(to));
    let backwards = last[0] < first[0];
    let (low, high) = if backwards { (last, first) } else { (first, last) };
    let (du, dv) = (high[0] - low[0], high[1] - low[1]);
    if pixels.len() as i64 != du + 1 {
        return false;
    }
    let mut good = true;
    for (step, pixel) in pixels.iter().enumerate() {
        let [along, beside] = axes(*pixel);
        let (u, v) = (along - low[0], beside - low[1]);
        let expected_u = if backwards { du - step as i64 } else { step as i64 };
        let twice = 2 * (du * v - dv * u) * dv.signum();
        // A level line has no halfway, and a point no direction.
        let nearest = if dv == 0 { v == 0 } else { -du < twice && twice <= du };
        good &= u == expected_u && nearest;
    }
    good
}

/// Carried along lines whose values nobody looks at.
#[derive(Clone, Copy)]
struct Nothing;

impl Add for Nothing {
    type Output = Self;
    fn add(self, _: Self) -> Self {
        Self
    }
}

impl Sub for Nothing {
    type Output = Self;
    fn sub(self, _: Self) -> Self {
        Self
    }
}

impl Mul<f64> for Nothing {
    type Output = Self;
    fn mul(self, _: f64) -> Self {
        Self
    }
}

impl Varying for Nothing {
    fn by_number(_: [Self; 3], _: impl FnMut([f64; 3]) -> f64) -> Self {
        Self
    }
}
