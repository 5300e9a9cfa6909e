//! Invariants: what must hold of every implementation, each under a number and a name.
//!
//! A check is a function of a [`Implementations`] (the implementations under test) and an [`Input`]. Inputs
//! come from (seed, number) here and from a property test's small numbers in `tests/it`; mutants
//! are put in the place of the real thing to show that each check can fail ([`matrix`]).
//!
//! - Coverage is 1 to 20, values 21 to 31, clipping 32 to 35, lines 36 to 41, the harness itself 42
//!   to 45, effects 46, lists of triangles 47, formulas of effects 48 to 51.

pub mod acceptance;
mod clip;
mod coverage;
mod effects;
mod exact;
mod formulas;
pub mod implementations;
mod lines;
mod lists;
pub mod matrix;
mod meta;
pub mod source;
mod values;

use implementations::{Component, Implementations, hits};
use rasterproof_core::frame::Coverage;
use rasterproof_core::parallel;
use rasterproof_verify::judge::{self, ascii, caught};
use rasterproof_verify::oracle::Oracle;
use source::{ClipInput, Fan, Input, LineInput, Position, Quad, TriangleInput};

/// What a check compared (0 where the input does not fit it), or the first thing that is wrong.
pub type Outcome = Result<u64, String>;

/// How an invariant is checked, by what its check gets.
#[derive(Clone, Copy)]
pub enum Predicate {
    Triangle(fn(&Implementations, &TriangleInput) -> Outcome),
    Quad(fn(&Implementations, &Quad) -> Outcome),
    Fan(fn(&Implementations, &Fan) -> Outcome),
    Line(fn(&Implementations, &LineInput) -> Outcome),
    Position(fn(&Implementations, &Position) -> Outcome),
    Clip(fn(&Implementations, &ClipInput) -> Outcome),
    /// Of a whole run: its seed, its cases of each family, at most the number given.
    Run(fn(&Implementations, u64, u64) -> Outcome, u64),
    Matrix,
}

/// Something that must hold of every implementation, and how that is checked.
#[derive(Clone, Copy)]
pub struct Invariant {
    /// Its number, which never changes.
    pub number: u32,
    /// The name in tables and messages; a caller gives it to check this one alone.
    pub name: &'static str,
    /// What holds for every input, as a sentence for the reader of a table.
    pub statement: &'static str,
    /// How much may be missing; derived where the check stands.
    pub tolerance: &'static str,
    /// What it looks at; a mutant in one of these places is one that it may kill.
    pub components: &'static [Component],
    pub check: Predicate,
}

/// What came of an invariant on the inputs of a seed.
#[derive(Clone, Debug)]
pub struct Trial {
    /// How many inputs were checked, those that were left out not among them.
    pub cases: u64,
    /// Inputs that do not fit the property and were left out.
    pub skipped: u64,
    /// Pixels, values or steps compared.
    pub compared: u64,
    /// The first failure by number, if any.
    pub failure: Option<Failure>,
}

/// The family is the name of the invariant.
pub type Failure = judge::Failure<Input, ()>;

/// What is said of an invariant after all of its cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ruling {
    /// Something was compared, and nothing is wrong.
    Holds,
    Fails,
    /// No input fits the property, so nothing was compared: neither right nor wrong.
    NotJudged,
}

impl Trial {
    /// Whether it holds, fails, or was never checked.
    #[must_use]
    pub fn ruling(&self) -> Ruling {
        match self.failure {
            Some(_) => Ruling::Fails,
            None if self.compared == 0 => Ruling::NotJudged,
            None => Ruling::Holds,
        }
    }
}

/// Inputs among which one that fits a check is looked for.
pub const MOST_LOOKED_THROUGH: u64 = 10_000;

impl Invariant {
    /// The input of a number: a pure function of the three, as far as the subject's source is.
    pub fn input(&self, subject: &Implementations, seed: u64, index: u64) -> Input {
        match self.check {
            Predicate::Triangle(_) => source::triangle(subject.make_case, seed, index),
            Predicate::Quad(_) => source::quad(seed, index),
            Predicate::Fan(_) => source::fan(seed, index),
            Predicate::Line(_) => source::line(subject.make_case, seed, index),
            Predicate::Position(_) => source::position(seed, index),
            Predicate::Clip(_) => source::clip(seed, index),
            Predicate::Run(_, cases) => Input::Run { seed, cases },
            Predicate::Matrix => Input::Run { seed, cases: matrix::CASES },
        }
    }

    /// Checks one input; an input of another kind is nothing to compare.
    pub fn judge(&self, subject: &Implementations, input: &Input) -> Outcome {
        // A panic of an implementation is something that is wrong, like any other.
        let outcome = caught(|| match (self.check, input) {
            (Predicate::Triangle(check), Input::Triangle(input)) => check(subject, input),
            (Predicate::Quad(check), Input::Quad(input)) => check(subject, input),
            (Predicate::Fan(check), Input::Fan(input)) => check(subject, input),
            (Predicate::Line(check), Input::Line(input)) => check(subject, input),
            (Predicate::Position(check), Input::Position(input)) => check(subject, input),
            (Predicate::Clip(check), Input::Clip(input)) => check(subject, input),
            (Predicate::Run(check, _), &Input::Run { seed, cases }) => check(subject, seed, cases),
            (Predicate::Matrix, &Input::Run { seed, cases }) => {
                let matrix = matrix::Matrix::compute(seed, cases, &|| ());
                let problems = matrix.problems();
                let cells = matrix.rows.len() * matrix.columns.len();
                if problems.is_empty() { Ok(cells as u64) } else { Err(problems.join("; ")) }
            }
            _ => Ok(0),
        });
        outcome.unwrap_or_else(|panic| Err(format!("panics ({panic})")))
    }

    /// Whether any of the first inputs fails.
    #[must_use]
    pub fn kills(&self, subject: &Implementations, seed: u64, cases: u64) -> bool {
        (0..self.count(cases))
            .any(|index| self.judge(subject, &self.input(subject, seed, index)).is_err())
    }

    /// Runs of the whole harness take one input, whatever the number asked for.
    fn count(&self, cases: u64) -> u64 {
        match self.check {
            Predicate::Run(..) | Predicate::Matrix => 1,
            _ => cases,
        }
    }

    /// The number of cases with which something is compared: one more than the number of the first
    /// input that fits. Nothing where none of the first [`MOST_LOOKED_THROUGH`] fits, and for a run of
    /// the whole harness, where the number changes nothing.
    pub fn cases_needed(&self, subject: &Implementations, seed: u64) -> Option<u64> {
        if matches!(self.check, Predicate::Run(..) | Predicate::Matrix) {
            return None;
        }
        // The first input to which the check applies; a failure is one, too.
        for index in 0..MOST_LOOKED_THROUGH {
            if self.judge(subject, &self.input(subject, seed, index)) != Ok(0) {
                return Some(index + 1);
            }
        }
        None
    }

    /// Checks the inputs of a seed on all cores and makes the first failing one small.
    #[must_use]
    pub fn run(&self, subject: &Implementations, seed: u64, cases: u64) -> Trial {
        // A failure ends the run after the inputs that are judged at the same time.
        const BLOCK: u64 = 64;
        let mut report = Trial { cases: 0, skipped: 0, compared: 0, failure: None };
        let count = self.count(cases);
        let mut start = 0;
        while start < count && report.failure.is_none() {
            let end = count.min(start + 16 * BLOCK);
            // Blocks are judged on all cores; of several failures the one with the smallest number is kept.
            let outcomes = parallel::map((end - start) as usize, |number| {
                self.judge(subject, &self.input(subject, seed, start + number as u64))
            });
            for (index, outcome) in (start..end).zip(outcomes) {
                match outcome {
                    Ok(0) => report.skipped += 1,
                    Ok(compared) => {
                        report.cases += 1;
                        report.compared += compared;
                    }
                    Err(message) => {
                        report.cases += 1;
                        report.failure = Some(self.shrunk(subject, seed, index, message));
                        break;
                    }
                }
            }
            start = end;
        }
        report
    }

    /// A failure with the smallest input that was found for which the check still fails.
    fn shrunk(&self, subject: &Implementations, seed: u64, index: u64, message: String) -> Failure {
        let input = self.input(subject, seed, index);
        let input = source::smallest(input, |input| self.judge(subject, input).is_err());
        let message = self.judge(subject, &input).err().unwrap_or(message);
        Failure::new(self.name, index, seed, message, input, ())
    }
}

/// What each of them draws of a triangle or a line, beside what the oracle expects; there is no picture of other inputs.
pub fn drawn(subject: &Implementations, input: &Input) -> Option<String> {
    let (mut names, mut drawn) = (Vec::new(), Vec::new());
    let expected = match input {
        Input::Triangle(TriangleInput { triangle, window, .. }) => {
            let corners = triangle.corners();
            for engine in &subject.engines {
                names.push(engine.name);
                drawn.push(engine.hits(corners, *window));
            }
            hits(&*subject.oracle, [corners], *window)
        }
        Input::Line(LineInput { line, window }) => {
            for drawer in &subject.drawers {
                let mut hits = Coverage::new(*window, 0);
                for f in drawer.fragments(line, *window) {
                    hits.hit(f.y_px, f.x_px, f.x_px + 1);
                }
                names.push(drawer.name);
                drawn.push(hits);
            }
            let mut right = Coverage::new(*window, 0);
            Oracle.steps(line, *window, &mut |pixel, _| right.hit(pixel.y, pixel.x, pixel.x + 1));
            right
        }
        _ => return None,
    };
    let drawn: Vec<&Coverage> = drawn.iter().collect();
    Some(ascii::beside(&names, &drawn, &expected, 78))
}

pub fn find(name: &str) -> Option<&'static Invariant> {
    CATALOGUE.iter().find(|i| i.name == name)
}

/// The components that the invariants of a group look at: a mutant of another one leaves them as they are.
const ENGINE: &[Component] = &[Component::Engine];
const JUDGED: &[Component] = &[Component::Engine, Component::Oracle];
const DRAWER: &[Component] = &[Component::Drawer];
const CLIP: &[Component] = &[Component::Clip];
const FORMULAS: &[Component] = &[Component::Formulas];

const fn invariant(
    number: u32,
    name: &'static str,
    statement: &'static str,
    tolerance: &'static str,
    components: &'static [Component],
    check: Predicate,
) -> Invariant {
    Invariant { number, name, statement, tolerance, components, check }
}

/// All invariants, in the order of their numbers.
#[rustfmt::skip]
pub const CATALOGUE: &[Invariant] = &[
    invariant(1, "engines-agree",
        "Scanline, edge functions, tiles and oracle hit every pixel the same number of times.",
        "0", JUDGED, Predicate::Triangle(coverage::engines_agree)),
    invariant(2, "oracle-sign",
        "The oracle covers a sample iff the three signs of robust::orient2d say so.",
        "0", &[Component::Oracle], Predicate::Triangle(coverage::oracle_sign)),
    invariant(3, "vertex-order",
        "All six orders of the vertices cover the same pixels.",
        "0", ENGINE, Predicate::Triangle(coverage::vertex_order)),
    invariant(4, "translation",
        "Moving a triangle by whole pixels, across zero or far away, moves its pixels along.",
        "0", ENGINE, Predicate::Triangle(coverage::translation)),
    invariant(5, "conjugate-rules",
        "A mirrored or turned triangle covers the image of what the conjugate tie rule covers.",
        "0", ENGINE, Predicate::Triangle(coverage::conjugate_rules)),
    invariant(6, "quad-split",
        "A convex quadrilateral split on either diagonal covers the same pixels, each once.",
        "0", ENGINE, Predicate::Quad(coverage::quad_split)),
    invariant(7, "closed-fan",
        "A closed fan hits each pixel its outline winds round exactly once, and no other.",
        "0", ENGINE, Predicate::Fan(coverage::closed_fan)),
    invariant(8, "signed-hit-count",
        "Signed hits are 0 everywhere on a closed mesh, and on a disk what its outline winds.",
        "0", ENGINE, Predicate::Fan(coverage::signed_hit_count)),
    invariant(9, "contiguous-rows",
        "What a triangle covers of a row is one run of pixels.",
        "0", ENGINE, Predicate::Triangle(coverage::contiguous_rows)),
    invariant(10, "inside-the-box",
        "No covered sample lies outside the snapped bounding box, every sample strictly inside is covered.",
        "0", ENGINE, Predicate::Triangle(coverage::inside_the_box)),
    invariant(11, "nesting",
        "A triangle inside another covers a part of its pixels.",
        "0", ENGINE, Predicate::Triangle(coverage::nesting)),
    invariant(12, "zero-area",
        "A triangle of zero snapped area covers nothing and emits no fragment.",
        "0", ENGINE, Predicate::Triangle(coverage::zero_area)),
    invariant(13, "windings",
        "Both windings cover the same pixels, and culling tells them apart by the snapped area's sign.",
        "0", &[Component::Engine, Component::Cull], Predicate::Triangle(coverage::windings)),
    invariant(14, "crop",
        "Bounds, tiles and threads only crop: pixels and values of a tile are those of the window.",
        "0, bit for bit", ENGINE, Predicate::Triangle(coverage::crop)),
    invariant(15, "identifies-the-rule",
        "Eight triangles and eight edges around a centre have the fingerprint of top-left alone.",
        "0", ENGINE, Predicate::Triangle(coverage::identifies_the_rule)),
    invariant(16, "edge-lemma",
        "In every row {x : E >= 0} is {x >= ceil(crossing)}, and a triangle is what lies between.",
        "0", ENGINE, Predicate::Triangle(coverage::edge_lemma)),
    invariant(17, "edge-bound",
        "|E| <= Wx Wy in the box, the chosen word holds it, and nothing overflows in the domain.",
        "0", &[Component::Engine, Component::EdgeValues, Component::WordWidth], Predicate::Triangle(coverage::edge_bound)),
    invariant(18, "snapping",
        "Snapping moves by half a subpixel at most, ties to even, alike everywhere; or refuses.",
        "1/2 subpixel, the definition", &[Component::Snap], Predicate::Position(coverage::snapping)),
    invariant(19, "area",
        "The number of covered pixels differs from the area by half the perimeter + 1 at most.",
        "perimeter / 2 + 1 (Nosarzewska)", ENGINE, Predicate::Triangle(coverage::area)),
    invariant(20, "supersampling",
        "N x N samples a pixel are the pixels of the triangle N times as large.",
        "0", ENGINE, Predicate::Triangle(coverage::supersampling)),
    invariant(21, "edges-sum",
        "The three edge functions add up to twice the area at every centre.",
        "0", &[Component::EdgeValues], Predicate::Triangle(values::edges_sum)),
    invariant(22, "weights-sum",
        "The weights of the vertices lie in [0, 1] and add up to 1.",
        "6 u (3 ulp) in the sum, 4 u at the ends", ENGINE, Predicate::Triangle(values::weights_sum)),
    invariant(23, "perspective-values",
        "Depth and values are the exact rationals within the bounds derived for each engine.",
        "u (d D + m M), verify::tolerance", JUDGED, Predicate::Triangle(values::perspective)),
    invariant(24, "hull",
        "No depth or value leaves the range of the vertices by more than the bound of rounding.",
        "u (d D + m M)", ENGINE, Predicate::Triangle(values::hull)),
    invariant(25, "constant-attribute",
        "A constant attribute comes out bit for bit.",
        "0, bit for bit", ENGINE, Predicate::Triangle(values::constant)),
    invariant(26, "equal-w",
        "Three equal w give what affine interpolation gives, bit for bit.",
        "0, bit for bit", ENGINE, Predicate::Triangle(values::equal_w)),
    invariant(27, "scaled-w",
        "Scaling every w by a power of two changes no bit.",
        "0, bit for bit", ENGINE, Predicate::Triangle(values::scaled_w)),
    invariant(28, "rotated-vertices",
        "Rotating or reversing the vertices changes no bit of any value.",
        "0, bit for bit", ENGINE, Predicate::Triangle(values::rotated_vertices)),
    invariant(29, "shared-edge",
        "Both sides of a shared edge give the same values at a sample on it.",
        "the bounds of both triangles", ENGINE, Predicate::Triangle(values::shared_edge)),
    invariant(30, "flat-depth",
        "A flat depth comes out bit for bit, so a depth test does not depend on the order.",
        "0, bit for bit", ENGINE, Predicate::Triangle(values::flat_depth)),
    invariant(31, "finite",
        "No NaN and no infinity for any w, depth and value of the accepted domain.",
        "0", ENGINE, Predicate::Triangle(values::finite)),
    invariant(32, "clip-inside", "What is entirely inside is the same with and without clipping.",
        "0, bit for bit", CLIP, Predicate::Clip(clip::inside)),
    invariant(33, "clip-reversed", "Clipping A to B and B to A gives the same vertices, so neighbours across an edge meet.",
        "0, bit for bit", CLIP, Predicate::Clip(clip::reversed)),
    invariant(34, "clip-coverage", "The clipped fan covers what lies in the triangle and in front of the eye, exactly.",
        "0 beyond 1/256 px of the border, where snapping decides", CLIP, Predicate::Clip(clip::coverage)),
    invariant(35, "clip-plane", "Every clipped vertex satisfies its plane exactly, and no vertex lies outside any.",
        "0", CLIP, Predicate::Clip(clip::planes)),
    invariant(36, "nearest-pixel",
        "Every pixel of a line is the nearest one, |2 (dx y - x dy)| <= dx, ties as the contract says.",
        "0", DRAWER, Predicate::Line(lines::nearest_pixel)),
    invariant(37, "one-per-step",
        "A line has max(|dx|, |dy|) + 1 pixels, one a step, touching, from its first to its last end.",
        "0", DRAWER, Predicate::Line(lines::one_per_step)),
    invariant(38, "reversal",
        "A line drawn backwards lights the same pixels.",
        "0", DRAWER, Predicate::Line(lines::reversal)),
    invariant(39, "octants",
        "The eight octants are images of each other, ties conjugate.",
        "0", DRAWER, Predicate::Line(lines::octants)),
    invariant(40, "clipped-line",
        "A line in a window is the window of the line, in work bounded by the window.",
        "0, bit for bit", DRAWER, Predicate::Line(lines::clipped_line)),
    invariant(41, "listed-differences",
        "The list of a line's pixels that differ from exact rounding is empty, not 'within 1 px'.",
        "0", DRAWER, Predicate::Line(lines::listed_differences)),
    invariant(42, "every-mutant-dies",
        "Every invariant kills a mutant, and every mutant dies.",
        "0", &[Component::Matrix], Predicate::Matrix),
    invariant(43, "quotas",
        "Of the generated triangles a quarter has ties, a tenth are slivers, a twentieth is empty.",
        "0", &[Component::Source], Predicate::Run(meta::quotas, 200)),
    invariant(44, "replay",
        "A seed gives the same cases and the same verdict, in debug and release, on any thread.",
        "0, bit for bit", &[Component::Source], Predicate::Run(meta::replay, 40)),
    invariant(45, "metrics-report-only",
        "One wrong pixel of a large frame is a disagreement, whatever an image metric makes of it.",
        "0", &[Component::Judge], Predicate::Run(meta::metrics_report_only, 12)),
    invariant(46, "disabled-effect", "A disabled effect makes no call at all.",
        "0", &[Component::Render], Predicate::Run(effects::disabled, 24)),
    invariant(47, "lists",
        "A list covers what each of its triangles covers, in their order, in every instruction set.",
        "0", &[Component::Lists], Predicate::Triangle(lists::one_by_one)),
    invariant(48, "over",
        "Mixing two colours gives the nearest step, and is associative where an opacity is 0 or 1.",
        "half a step, the definition", FORMULAS, Predicate::Run(formulas::over, 40)),
    invariant(49, "layers",
        "The order in which layers are drawn changes nothing, and neither do layers behind what is opaque.",
        "0", FORMULAS, Predicate::Run(formulas::layers, 400)),
    invariant(50, "footprint",
        "A footprint N times as long as wide is read N times, and half as large one level higher.",
        "2^-45 in the level, four roundings", FORMULAS, Predicate::Run(formulas::footprints, 400)),
    invariant(51, "plane-in-light",
        "A plane does not keep the light from itself, in any light and any format of the map.",
        "0", FORMULAS, Predicate::Run(formulas::planes_in_light, 200)),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn catalogue_is_numbered_and_named() {
        let numbers: Vec<u32> = CATALOGUE.iter().map(|i| i.number).collect();
        assert_eq!(numbers, (1..=51).collect::<Vec<_>>());
        let kebab = |name: &str| name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-');
        assert!(CATALOGUE.iter().all(|i| kebab(i.name) && i.statement.ends_with('.')));
        for invariant in CATALOGUE {
            assert_eq!(find(invariant.name).map(|i| i.number), Some(invariant.number));
        }
    }
}
