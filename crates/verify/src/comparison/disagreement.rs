//! What a test prints when it fails: the smallest case, what was drawn and expected, and what rule would explain it.

use std::error::Error;
use std::fmt::{self, Write as _};

use super::{Convention, Failure, Picture, Rule, Verdict, Winding, shrink};
use crate::cases::named::plain_triangle;
use crate::cases::{self, Case, FamilyName, Shape};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

use super::spans::engine_coverage;

/// Lines of the list of families are no longer.
const MOST_COLUMNS: usize = 80;
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
    /// The convention by which all that was tried can be explained, in words and as an expression.
    pub convention: Option<[String; 2]>,
    /// The convention that was declared.
    pub declared: Convention,
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
            declared: verdict.options.convention,
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
        if let Some([words, expression]) = &self.convention {
            writeln!(f, "\nprobable cause: {words}")?;
            writeln!(
                f,
                "if that is meant, declare it: Options::default().convention({expression})"
            )?;
        }
        if !self.families.is_empty() {
            f.write_str("\nwrong cases by family:")?;
            let mut column = MOST_COLUMNS;
            for (name, wrong) in &self.families {
                let word = format!(" {name} ({wrong})");
                if column + word.len() > MOST_COLUMNS {
                    f.write_str("\n ")?;
                    column = 1;
                }
                f.write_str(&word)?;
                column += word.len();
            }
            writeln!(f)?;
        }
        if let Some(Failure { family, index, seed, .. }) = &self.smallest {
            write!(f, "repeat the case with: Options::default().seed({seed})")?;
            if let Ok(family) = family.parse::<FamilyName>() {
                write!(f, ".family(FamilyName::{family:?})")?;
            }
            if self.declared != Convention::default() {
                write!(f, ".convention({})", self.declared)?;
            }
            writeln!(f, ".only({index})")?;
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

/// A way to rasterize: a convention, and how corners reach a coarser grid where they do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Candidate {
    convention: Convention,
    /// Corners are cut down to the grid, not moved to the nearest point of it.
    down: bool,
}

impl Candidate {
    fn picture(self, corners: &Corners, window: PixelRect) -> Picture {
        let step = SUBPIXELS >> self.convention.subpixel_bits;
        let ahead = if self.down { 0 } else { step / 2 };
        let snap = |v: i32| v.saturating_add(ahead).div_euclid(step) * step;
        let corners = corners.map(|p| SubpixelPoint::new(snap(p.x), snap(p.y)));
        self.convention.expected(&corners, window)
    }

    /// In what it differs from what is declared, in words.
    fn words(self, declared: &Convention) -> Option<String> {
        let place = |sample: [i32; 2]| {
            let [x, y] = sample.map(|v| f64::from(v) / f64::from(SUBPIXELS));
            match sample {
                [HALF_PIXEL, HALF_PIXEL] => "the centres".to_owned(),
                [0 | SUBPIXELS, 0 | SUBPIXELS] => format!(
                    "the {} {} corners",
                    if y == 0.0 { "upper" } else { "lower" },
                    if x == 0.0 { "left" } else { "right" },
                ),
                _ => format!("the points ({x}, {y})"),
            }
        };
        let own = self.convention;
        let sample = (own.sample != declared.sample).then(|| {
            let [own, declared] = [own.sample, declared.sample].map(place);
            format!("its samples are at {own} of the pixels, and not at {declared}")
        });
        let rule = (own.rule != declared.seen_rule()).then(|| match own.rule {
            Rule::Strict => "it draws no sample that lies exactly on an edge, so shared edges have holes".to_owned(),
            Rule::Inclusive => {
                "it draws every sample that lies exactly on an edge, so shared edges are drawn twice".to_owned()
            }
            rule => format!(
                "it follows the {} rule for samples on edges, and not the {} rule",
                rule.word(),
                declared.seen_rule().word()
            ),
        });
        let winding = (own.winding != declared.seen_winding()).then(|| match own.winding {
            Winding::Both => "it draws triangles of either winding".to_owned(),
            Winding::Clockwise => {
                "it draws only triangles whose corners run clockwise on the screen (y down)"
                    .to_owned()
            }
            Winding::CounterClockwise => {
                "it draws only triangles whose corners run counter-clockwise on the screen (y down)"
                    .to_owned()
            }
        });
        let grid = (own.subpixel_bits != declared.subpixel_bits).then(|| {
            let how = if self.down { "down to" } else { "to the nearest" };
            format!("it moves corners {how} multiples of 1/{} px", 1 << own.subpixel_bits)
        });
        let words: Vec<_> = [sample, rule, winding, grid].into_iter().flatten().collect();
        (!words.is_empty()).then(|| words.join("; "))
    }
}

/// Every combination, simple ones first; of grids those that are coarser than what is declared.
fn candidates(declared: &Convention) -> Vec<Candidate> {
    let bits = declared.subpixel_bits;
    let coarser = (4..bits).rev().flat_map(|bits| [(bits, false), (bits, true)]);
    let mut found = Vec::new();
    for (bits, down) in [(bits, false)].into_iter().chain(coarser) {
        for (_, rule) in Rule::ALL.into_iter().filter(|(_, rule)| *rule != Rule::Unspecified) {
            for [x, y] in SAMPLES {
                for winding in [Winding::Both, Winding::Clockwise, Winding::CounterClockwise] {
                    let convention = Convention::default().rule(rule).winding(winding);
                    let sample = [x, y].map(|halves| HALF_PIXEL + halves * HALF_PIXEL);
                    let convention = convention.sample(sample[0], sample[1]).subpixel_bits(bits);
                    found.push(Candidate { convention, down });
                }
            }
        }
    }
    found
}

/// The places of a sample that a rule may have, from the centre in half pixels.
const SAMPLES: [[i32; 2]; 5] = [[0, 0], [-1, -1], [-1, 1], [1, -1], [1, 1]];

/// Triangles that tell the rules apart: those of a few families, moved so that edges pass through samples at each of
/// [`SAMPLES`].
fn questions() -> Vec<(Corners, PixelRect)> {
    let wanted = ["half-integer", "rectangle", "uniform", "near-tie"];
    let families = cases::triangles::FAMILIES.iter().filter(|family| wanted.contains(&family.name));
    let cases = families.flat_map(|family| (0..24).map(|index| family.case(1, index)));
    let triangles = |case: Case| match case.shape {
        Shape::Triangles { list, .. } => {
            list.into_iter().map(|t| (t.corners(), case.window)).collect::<Vec<_>>()
        }
        _ => Vec::new(),
    };
    let small = |(_, window): &(Corners, PixelRect)| window.width().max(window.height()) <= 64;
    let moved = |(corners, window): (Corners, PixelRect)| {
        SAMPLES.map(|[x, y]| {
            let by = |sub: i32, halves: i32| sub.saturating_add(halves * HALF_PIXEL);
            (corners.map(|p| SubpixelPoint::new(by(p.x, x), by(p.y, y))), window)
        })
    };
    cases.flat_map(triangles).filter(small).flat_map(moved).collect()
}

/// The only convention that explains what an engine draws in some hundred triangles, as an expression and in words, if
/// it is not the declared one. Nothing where none does, or where two do.
pub(super) fn recognised(engine: &impl Rasterize, declared: &Convention) -> Option<[String; 2]> {
    let mut left = candidates(declared);
    let on_the_grid = Convention::default().subpixel_bits(declared.subpixel_bits);
    for (corners, window) in questions() {
        let shape = Shape::Triangles { list: vec![plain_triangle(corners)], disjoint: false };
        let case = on_the_grid.place(Case { window, shape });
        let Shape::Triangles { list, .. } = &case.shape else { return None };
        let corners = list[0].corners();
        let drawn = engine_coverage(engine, list, window).ok()?;
        left.retain(|candidate| {
            // A triangle that has lost its area on the way to a coarser grid says nothing about the rule.
            let Picture { must, may } = candidate.picture(&corners, window);
            let mut hits = Coverage::new(window, 0);
            must.iter().for_each(|span| hits.hit(span.y_px, span.x0_px, span.x1_px));
            may.is_some() || hits == drawn
        });
        if left.is_empty() {
            return None;
        }
    }
    match left.as_slice() {
        [one] => Some([one.words(declared)?, one.convention.to_string()]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::FamilyName;
    use crate::comparison::{Options, judge_coverage};
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::Span;

    /// Draws what has to be drawn by a candidate.
    struct By(Candidate);
    impl Rasterize for By {
        fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
            self.0.picture(&corners, bounds).must.into_iter().for_each(emit);
        }
    }

    /// Every convention is told from every other one, and the declared one has nothing to say.
    #[test]
    fn conventions_are_recognised() {
        let standard = Convention::default();
        // Every seventh, which has every rule, place and winding on one grid or another.
        for candidate in candidates(&standard).into_iter().step_by(7) {
            let Some([words, expression]) = recognised(&By(candidate), &standard) else {
                assert_eq!(candidate.words(&standard), None, "{candidate:?}");
                continue;
            };
            assert_eq!(Some(words), candidate.words(&standard));
            assert_eq!(expression, candidate.convention.to_string());
            assert_eq!(recognised(&By(candidate), &candidate.convention), None, "{candidate:?}");
        }
        assert_eq!(recognised(&Scanline, &standard), None);
    }

    /// Who draws as declared agrees, and nobody else; a failure names what was recognised.
    #[test]
    fn conventions_are_judged() {
        let families = |options: Options| {
            let names = [
                FamilyName::HalfInteger,
                FamilyName::Rectangle,
                FamilyName::PartlyOff,
                FamilyName::Far,
            ];
            names.into_iter().fold(options.cases(10), Options::family)
        };
        for candidate in candidates(&Convention::default()).into_iter().step_by(7) {
            let Candidate { convention, .. } = candidate;
            let options = families(Options::default().convention(convention));
            let verdict = judge_coverage(&By(candidate), &options).unwrap();
            assert!(verdict.agrees(), "{convention}: {}", verdict.check().unwrap_err());
            let other =
                if convention.rule == Rule::TopRight { Rule::BottomLeft } else { Rule::TopRight };
            let options = families(Options::default().convention(convention.rule(other)));
            let verdict = judge_coverage(&By(candidate), &options).unwrap();
            assert!(!verdict.agrees(), "{convention} is not told from {other:?}");
        }
        // The same engine, for one whose y axis points up.
        let below =
            Candidate { convention: Convention::default().rule(Rule::BottomLeft), down: false };
        let options = families(Options::default().convention(Convention::default().y_up()));
        assert!(judge_coverage(&By(below), &options).unwrap().agrees());
        // Nothing is promised of samples on edges: every rule will do, and a wrong sample place will not.
        let open =
            families(Options::default().convention(Convention::default().rule(Rule::Unspecified)));
        for candidate in candidates(&Convention::default()).into_iter().take(90).step_by(7) {
            let Convention { sample, winding, .. } = candidate.convention;
            let is_right = sample == [HALF_PIXEL; 2] && winding == Winding::Both;
            let verdict = judge_coverage(&By(candidate), &open).unwrap();
            assert_eq!(verdict.agrees(), is_right, "{}", candidate.convention);
        }
    }

    #[test]
    fn a_message_says_all() {
        let strict =
            By(Candidate { convention: Convention::default().rule(Rule::Strict), down: false });
        let options = Options::default()
            .cases(40)
            .family(FamilyName::HalfInteger)
            .family(FamilyName::Rectangle);
        let message = judge_coverage(&strict, &options).unwrap().check().unwrap_err().to_string();
        for part in [
            "wrong pixels, in ",
            "the smallest case",
            "drawn",
            "expected",
            "-",
            "probable cause: it draws no sample that lies exactly on an edge",
            "if that is meant, declare it: Options::default().convention(Convention::default().rule(Rule::Strict))",
            "repeat the case with: Options::default().seed(1).family(FamilyName::",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
        assert!(message.lines().all(|line| line.chars().count() <= 120), "{message}");
        let declared = options.clone().convention(Convention::default().rule(Rule::TopRight));
        let message = judge_coverage(&strict, &declared).unwrap().check().unwrap_err().to_string();
        let repeat = ".convention(Convention::default().rule(Rule::TopRight)).only(";
        assert!(message.contains(repeat), "{message}");
        judge_coverage(&Scanline, &options).unwrap().check().unwrap();
    }
}
