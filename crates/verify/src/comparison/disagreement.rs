//! What a test prints when it fails: the smallest case, what was drawn and expected, and what rule would explain it.

use std::error::Error;
use std::fmt::{self, Write as _};

use super::{Failure, Verdict, shrink};
use crate::cases::{self, Case, Shape};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

use super::spans::engine_coverage;

/// Larger grids are left out of the message.
const MOST_SIDE_PX: u32 = 40;

/// What was wrong in a verdict. Its text is the whole message: print it.
#[derive(Clone, Debug)]
pub struct Disagreement {
    /// Wrong pixels over all cases.
    pub wrong_pixels: u64,
    /// Cases in which anything was wrong, and all cases.
    pub wrong_cases: [u64; 2],
    /// Families with wrong cases, and how many.
    pub families: Vec<(String, u64)>,
    /// The smallest failing case that was found. There is none where the oracle itself failed a check.
    pub smallest: Option<Failure>,
    /// The rule by which all that was tried can be explained, in words.
    pub convention: Option<String>,
}

impl Error for Disagreement {}

impl Disagreement {
    pub(super) fn of(verdict: &Verdict) -> Self {
        let wrong = |family: &super::FamilyReport| -> u64 {
            family.pairs.iter().map(|pair| pair.wrong_cases).max().unwrap_or(0)
        };
        let families: Vec<_> = verdict
            .families
            .iter()
            .map(|f| (f.family.clone(), wrong(f)))
            .filter(|f| f.1 > 0)
            .collect();
        Self {
            wrong_pixels: verdict.mismatches(),
            wrong_cases: [
                families.iter().map(|(_, wrong)| wrong).sum(),
                verdict.families.iter().map(|family| family.cases).sum(),
            ],
            families,
            smallest: verdict.failures.first().cloned(),
            convention: verdict.convention.clone(),
        }
    }
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [wrong, all] = self.wrong_cases;
        writeln!(f, "{} wrong pixels, in {wrong} of {all} cases", self.wrong_pixels)?;
        if let Some(failure) = &self.smallest {
            let Case { window, .. } = failure.case;
            let described = shrink::describe(&failure.case);
            let kind =
                if matches!(failure.case.shape, Shape::Lines(_)) { "line" } else { "triangle" };
            writeln!(
                f,
                "\nthe smallest case, in pixels: {kind} {described}\n  {} in a window of {} x {} px",
                failure.what,
                window.width(),
                window.height()
            )?;
            let fits = window.width().max(window.height()) <= MOST_SIDE_PX;
            match &failure.drawn {
                Some(drawn) if fits => f.write_str(&grids(drawn, &failure.expected))?,
                Some(_) => {}
                None => writeln!(f, "  the engine panics on it")?,
            }
        }
        if let Some(convention) = &self.convention {
            writeln!(f, "\nprobable cause: {convention}")?;
        }
        let names: Vec<_> =
            self.families.iter().map(|(name, wrong)| format!("{name} ({wrong})")).collect();
        if !names.is_empty() {
            writeln!(f, "\nwrong cases by family: {}", names.join(", "))?;
        }
        if let Some(Failure { family, index, seed, .. }) = &self.smallest {
            writeln!(
                f,
                "repeat the case with: Options::default().seed({seed}).family(\"{family}\").only({index})"
            )?;
        }
        Ok(())
    }
}

/// What was drawn and what is expected beside each other; pixels that differ are marked.
fn grids(drawn: &Coverage, expected: &Coverage) -> String {
    let width = drawn.bounds().width() as usize;
    let mut text = format!("\n  {:<1$}   expected\n", "drawn", width.max(5));
    let digit = |hits: u8| match hits {
        0 => '.',
        1 => '#',
        hits => char::from_digit(u32::from(hits.min(9)), 10).unwrap_or('9'),
    };
    for ((_, drawn), (_, expected)) in drawn.rows().zip(expected.rows()) {
        let mark = |(&d, &e): (&u8, &u8)| match (d, e) {
            (d, e) if d == e => digit(d),
            (0, _) => '-',
            (1, 0) => '+',
            (d, _) => digit(d),
        };
        let left: String = drawn.iter().zip(expected).map(mark).collect();
        let right: String = expected.iter().map(|&hits| digit(hits)).collect();
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {left:<0$}   {right}", width.max(5));
    }
    text + "  # drawn once, - missing, + extra, 2 drawn twice\n"
}

/// Which samples on an edge a rasterizer draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ties {
    /// Those of edges at the top or bottom (y) and left or right (x): the directions of the nudge.
    Nudged {
        right: bool,
        down: bool,
    },
    None,
    All,
}

/// A way to rasterize that differs from the rule of this crate.
#[derive(Clone, Copy, Debug)]
struct Rule {
    ties: Ties,
    /// From the centre of the pixel, in half pixels.
    sample: [i64; 2],
    /// The sign of the area, with y down, of the triangles that are drawn; 0 for both.
    winding: i128,
}

impl Rule {
    fn covers(self, corners: &Corners, x_px: i32, y_px: i32) -> bool {
        let half = i64::from(HALF_PIXEL);
        let at = |px: i32, offset: i64| i64::from(px) * i64::from(SUBPIXELS) + half + offset * half;
        let (x, y) = (at(x_px, self.sample[0]), at(y_px, self.sample[1]));
        let [a, b, c] = corners.map(|p| [i64::from(p.x), i64::from(p.y)]);
        let edge = |from: [i64; 2], to: [i64; 2], p: [i64; 2]| {
            i128::from(to[0] - from[0]) * i128::from(p[1] - from[1])
                - i128::from(to[1] - from[1]) * i128::from(p[0] - from[0])
        };
        let area = edge(a, b, c);
        if area == 0 || self.winding * area < 0 {
            return false;
        }
        let (b, c) = if area > 0 { (b, c) } else { (c, b) };
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| match edge(from, to, [x, y]) {
            0 => match self.ties {
                Ties::None => false,
                Ties::All => true,
                // The inside is right of an edge that goes up, and below one that goes right.
                Ties::Nudged { right, down } if from[1] == to[1] => {
                    (to[0] > from[0]) == down || (to[0] == from[0] && right)
                }
                Ties::Nudged { right, .. } => (to[1] < from[1]) == right,
            },
            e => e > 0,
        })
    }

    fn words(self) -> Option<String> {
        let sample = match self.sample {
            [0, 0] => None,
            [x, y] => Some(format!(
                "its samples are at the {} {} corners of the pixels, and not at the centres",
                if y < 0 { "upper" } else { "lower" },
                if x < 0 { "left" } else { "right" },
            )),
        };
        let ties = match self.ties {
            Ties::None => Some("it draws no sample that lies exactly on an edge, so shared edges have holes".to_owned()),
            Ties::All => Some("it draws every sample that lies exactly on an edge, so shared edges are drawn twice".to_owned()),
            Ties::Nudged { right: true, down: true } => None,
            Ties::Nudged { right, down } => Some(format!(
                "it keeps samples on {} and {} edges, where the top-left rule keeps those on top and left ones",
                if down { "top" } else { "bottom" },
                if right { "left" } else { "right" },
            )),
        };
        let winding = match self.winding {
            0 => None,
            sign => Some(format!(
                "it draws only triangles whose corners run {} on the screen (y down)",
                if sign > 0 { "clockwise" } else { "counter-clockwise" },
            )),
        };
        let words: Vec<_> = [sample, ties, winding].into_iter().flatten().collect();
        (!words.is_empty()).then(|| words.join("; "))
    }
}

/// Every combination, simple ones first.
fn rules() -> impl Iterator<Item = Rule> {
    let nudges = [(true, true), (true, false), (false, true), (false, false)];
    let nudges = nudges.map(|(right, down)| Ties::Nudged { right, down });
    let ties = nudges.into_iter().chain([Ties::None, Ties::All]);
    let all = ties.flat_map(|ties| SAMPLES.map(|sample| (ties, sample)));
    all.flat_map(|(ties, sample)| [0, 1, -1].map(|winding| Rule { ties, sample, winding }))
}

/// The places of a sample that a rule may have, from the centre in half pixels.
const SAMPLES: [[i64; 2]; 5] = [[0, 0], [-1, -1], [-1, 1], [1, -1], [1, 1]];

/// Triangles that tell the rules apart: those of a few families, moved so that edges pass through samples at each of
/// [`SAMPLES`].
fn questions() -> Vec<(Corners, PixelRect)> {
    let wanted = ["half-integer", "rectangle", "uniform"];
    let families = cases::triangles::FAMILIES.iter().filter(|family| wanted.contains(&family.name));
    let cases = families.flat_map(|family| (0..24).map(|index| family.case(1, index)));
    let triangles = |case: Case| match case.shape {
        Shape::Triangles { list, .. } => {
            list.into_iter().map(|t| (t.corners(), case.window)).collect::<Vec<_>>()
        }
        Shape::Lines(_) => Vec::new(),
    };
    let small = |(_, window): &(Corners, PixelRect)| window.width().max(window.height()) <= 64;
    let moved = |(corners, window): (Corners, PixelRect)| {
        SAMPLES.map(|[x, y]| {
            let by = |sub: i32, halves: i64| sub.saturating_add(halves as i32 * HALF_PIXEL);
            (corners.map(|p| SubpixelPoint::new(by(p.x, x), by(p.y, y))), window)
        })
    };
    cases.flat_map(triangles).filter(small).flat_map(moved).collect()
}

/// The only rule that explains what an engine draws in some hundred triangles, in words. Nothing where none does, or
/// where two do.
pub(super) fn recognised(engine: &impl Rasterize) -> Option<String> {
    let mut left: Vec<Rule> = rules().collect();
    for (corners, window) in questions() {
        let triangle = cases::Triangle {
            vertices: corners.map(|position| rasterproof_core::triangle::ScreenVertex {
                position,
                depth: 0.0,
                inv_w: 1.0,
                varying: glam::DVec2::ZERO,
            }),
        };
        let drawn = engine_coverage(engine, &[triangle], window).ok()?;
        left.retain(|rule| {
            drawn.rows().all(|(y, row)| {
                (window.x0..)
                    .zip(row)
                    .all(|(x, &hits)| hits == u8::from(rule.covers(&corners, x, y)))
            })
        });
        if left.is_empty() {
            return None;
        }
    }
    match left.as_slice() {
        [rule] => rule.words(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comparison::{Options, judge_coverage};
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::Span;

    struct By(Rule);
    impl Rasterize for By {
        fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
            for y_px in bounds.y0..bounds.y1 {
                for x_px in bounds.x0..bounds.x1 {
                    if self.0.covers(&corners, x_px, y_px) {
                        emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
                    }
                }
            }
        }
    }

    /// Every rule is told from every other one, and the right one has nothing to say.
    #[test]
    fn rules_are_recognised() {
        for rule in rules() {
            assert_eq!(recognised(&By(rule)), rule.words(), "{rule:?}");
        }
        assert_eq!(recognised(&Scanline), None);
    }

    #[test]
    fn a_message_says_all() {
        let strict = By(Rule { ties: Ties::None, sample: [0, 0], winding: 0 });
        let options = Options::default().cases(40).family("half-integer").family("rectangle");
        let message = judge_coverage(&strict, &options).unwrap().check().unwrap_err().to_string();
        for part in [
            "wrong pixels, in ",
            "the smallest case",
            "drawn",
            "expected",
            "-",
            "probable cause: it draws no sample that lies exactly on an edge",
            "repeat the case with: Options::default().seed(1).family(\"",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
        assert!(message.lines().all(|line| line.chars().count() <= 120), "{message}");
        judge_coverage(&Scanline, &options).unwrap().check().unwrap();
    }
}
