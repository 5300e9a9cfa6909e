//! What is asked about a case and what is found in the answers, one kind of question at a time.
//!
//! Some checks compare with the picture that is expected, others compare answers with each other
//! and need no convention. A check alone knows its questions, so that the same code judges a
//! generated case, shrinks it and repeats it.

use glam::DVec2;

use super::ask::{Answer, Asked, Question};
use super::declared::{self, Declared};
use super::depth::Pile;
use super::expected::{Expect, exact_values, value_bounds};
use super::judged::{CaseJudgement, push};
use super::pixels::{length, mesh_of, painted, picture_of, pixel_of};
use super::{adapt_case, difference, mesh, near_plane, numbers, outline, sample_values};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect};
use rasterproof_core::triangle::{Corners, Fragment, Span};
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::cases::facts;
use rasterproof_verify::cases::wide::{has_width, wide_line};
use rasterproof_verify::cases::{Case, Family, Line, Shape, Triangle};
use rasterproof_verify::comparison::pixels::{compare, few, hits, mix, sequence};
use rasterproof_verify::comparison::{Expectation, Tally, Winding};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::Exact;

/// What is judged in the answers to a case. A case may have several checks, and each asks its own questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Check {
    /// Each triangle alone against the expected picture.
    Coverage,
    /// Each line alone against the expected pixels.
    Line,
    /// Fragments against the expected picture, and some of their values against exact ones.
    Values,
    /// Four samples a pixel against the oracle's.
    Samples,
    /// The same with values: of some samples against exact ones.
    SampleValues,
    /// Which of several triangles is seen, against exact depths.
    Depth,
    /// What the near plane leaves of a triangle, against exact corners.
    Near,
    /// The attributes of these corners, too.
    Carried,
    /// Each line with a width against the expected picture.
    Wide,
    /// The share of each pixel that a triangle covers, against the exact one.
    Area,
    /// What a formula gives, against exact numbers.
    Formula,
    /// A triangle with its vertices in another order against itself.
    Order,
    /// A mesh has no holes and no doubles.
    Watertight,
    /// A line drawn backwards against itself.
    Direction,
    /// The fill of a triangle against its outline.
    Outline,
}

/// By what a program is judged: what it declares, and what it was seen to do.
pub struct Truth {
    pub declared: Declared,
    /// What it is expected to draw, as declared.
    pub expect: Box<dyn Expect>,
    /// What it was recognised to draw, if that is something else.
    pub recognised: Option<Box<dyn Expect>>,
    /// The windings that it was seen to draw, or declares.
    pub drawn: Winding,
    /// By what each of two programs is judged, where two are compared.
    pub of_two: Option<Box<[Self; 2]>>,
}

impl Truth {
    /// Judged as declared, nothing recognised.
    #[must_use]
    pub fn of(declared: &Declared) -> Self {
        Self {
            expect: Box::new(declared.clone()),
            recognised: None,
            drawn: declared.convention.seen_winding(),
            declared: declared.clone(),
            of_two: None,
        }
    }
}

rasterproof_core::named! {
    /// What is counted where answers are wrong. A score is of one of these.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Counted {
        Pixels = "wrong pixels",
        Values = "values beyond the tolerance",
        Samples = "wrong samples",
        /// Of several triangles.
        Seen = "pixels that show the wrong triangle",
        Corners = "wrong corners",
        Numbers = "wrong numbers",
        /// Between answers of the same program, as the rest.
        Changes = "pixels that differ",
        Meshes = "holes and doubles of meshes",
        Outlines = "pixels that contradict the outline",
        Levels = "pixels of a wrong level",
    }
}

impl Counted {
    /// The words behind a number: the singular behind 1.
    #[must_use]
    pub fn words(self, number: u64) -> &'static str {
        if number != 1 {
            return self.name();
        }
        match self {
            Self::Pixels => "wrong pixel",
            Self::Values => "value beyond the tolerance",
            Self::Samples => "wrong sample",
            Self::Seen => "pixel that shows the wrong triangle",
            Self::Corners => "wrong corner",
            Self::Numbers => "wrong number",
            Self::Changes => "pixel that differs",
            Self::Meshes => "hole or double of meshes",
            Self::Outlines => "pixel that contradicts the outline",
            Self::Levels => "pixel of a wrong level",
        }
    }
}

impl CaseJudgement {
    /// What is wrong with the answers to a case in words, parts of a sentence that are joined by commas.
    pub fn describe(&self, check: Check) -> String {
        // First what is counted, then what is off, refused or out of order in a run, then deaths.
        let mut parts = check.describe(&self.finding.tally, self.right.is_some());
        if self.finding.worst() > 1.0 {
            parts.push(format!("a value off by {:.3e} times the tolerance", self.finding.worst()));
        }
        if self.steps_off > 0.0 {
            parts.push(format!("the largest difference is {:.2} steps", self.steps_off));
        }
        if self.refused > 0 {
            parts.push(format!("{} refused ({})", self.refused, self.reason));
        }
        if let Some(Span { y_px, x0_px, x1_px }) = self.backward {
            parts.push(format!(
                "the run of row {y_px} begins at column {x0_px} and ends before it, at column {x1_px}"
            ));
        }
        parts.extend(self.died.iter().map(|(_, m)| m.to_string()));
        if parts.is_empty() { "agrees".to_owned() } else { parts.join(", ") }
    }
}

impl Check {
    /// What is counted where its pixels, samples or corners are wrong.
    #[must_use]
    pub fn counted(self) -> Counted {
        match self {
            Self::Coverage | Self::Line | Self::Values | Self::Wide => Counted::Pixels,
            Self::Samples | Self::SampleValues => Counted::Samples,
            Self::Depth => Counted::Seen,
            Self::Near | Self::Carried => Counted::Corners,
            Self::Formula => Counted::Numbers,
            Self::Order | Self::Direction => Counted::Changes,
            Self::Watertight => Counted::Meshes,
            Self::Outline => Counted::Outlines,
            Self::Area => Counted::Levels,
        }
    }

    /// The counts of a tally in the words of the check, those of two compared programs in words of their own.
    #[must_use]
    pub fn describe(self, tally: &Tally, of_two: bool) -> Vec<String> {
        let Tally { missing, extra, twice, order } = *tally;
        // Each check has its own words for what is missing, too many, twice or out of order.
        let counts = match self {
            _ if of_two => vec![
                (missing, "only in the second answer"),
                (extra, "only in the first"),
                (twice, "drawn another number of times"),
                (order, "that differ"),
            ],
            Self::Outline => {
                vec![(missing, "not filled within the outline"), (extra, "filled outside of it")]
            }
            Self::Watertight => {
                vec![(missing, one(missing, "hole", "holes")), (twice, "drawn by two triangles")]
            }
            Self::Order | Self::Direction => {
                let differ = missing + extra + twice;
                vec![(differ, one(differ, "pixel differs", "pixels differ"))]
            }
            Self::Samples | Self::SampleValues => {
                vec![
                    (missing, one(missing, "sample missing", "samples missing")),
                    (extra, "extra"),
                    (twice, "twice"),
                ]
            }
            Self::Area => vec![
                (missing, "of a level that is too small"),
                (extra, "of a level that is too large"),
                (twice, "twice"),
            ],
            Self::Formula => vec![(missing, "missing"), (extra, "too many"), (order, "wrong")],
            Self::Near => vec![
                (missing, one(missing, "corner missing", "corners missing")),
                (extra, one(extra, "corner that is not there", "corners that are not there")),
                (order, "running the other way round"),
            ],
            Self::Carried => vec![
                (
                    missing,
                    one(
                        missing,
                        "corner missing, or with another attribute",
                        "corners missing, or with another attribute",
                    ),
                ),
                (
                    extra,
                    one(
                        extra,
                        "corner with an attribute that no such corner has, or that is not there",
                        "corners with an attribute that no such corner has, or that are not there",
                    ),
                ),
                (order, "running the other way round"),
            ],
            Self::Depth => vec![
                (missing, "missing"),
                (extra, "extra"),
                (twice, "twice"),
                (order, one(order, "shows what lies behind", "show what lies behind")),
            ],
            Self::Coverage | Self::Line | Self::Values | Self::Wide => vec![
                (missing, "missing"),
                (extra, "extra"),
                (twice, "twice"),
                (order, "out of order"),
            ],
        };
        let mut said = Vec::new();
        for (n, what) in counts {
            if n > 0 {
                said.push(format!("{n} {what}"));
            }
        }
        said
    }

    /// Whether answers of the same program are compared with each other, and with nothing that is expected.
    #[must_use]
    pub fn compares_answers(self) -> bool {
        matches!(self, Self::Order | Self::Watertight | Self::Direction | Self::Outline)
    }

    /// The check whose cause is that of this one, too: what differs between answers comes of the same mistakes as wrong answers.
    #[must_use]
    pub fn of_its_cause(self) -> Self {
        match self {
            Self::Order | Self::Watertight | Self::Outline => Self::Coverage,
            Self::Direction => Self::Line,
            other => other,
        }
    }

    /// Whether a case can be asked: a mesh that falls apart has no holes.
    #[must_use]
    pub fn fits(self, case: &Case) -> bool {
        match &case.shape {
            Shape::Triangles { disjoint, list } => match self {
                Self::Watertight => *disjoint,
                Self::Wide => list.iter().all(has_width),
                _ => true,
            },
            _ => self != Self::Watertight,
        }
    }

    /// Whether each answer is compared with an expected one, not with others.
    pub(super) fn is_one_by_one(self) -> bool {
        use Check::{Area, Carried, Coverage, Depth, Formula, Line, Near, Values, Wide};
        matches!(self, Coverage | Line | Values | Depth | Near | Carried | Wide | Area | Formula)
    }

    /// Its name as a property: of checks that a family is made for, the name of that family.
    pub fn name(self, family: &'static str) -> &'static str {
        match self {
            Self::Coverage | Self::Line | Self::Depth | Self::Near => family,
            Self::Wide | Self::Area | Self::Formula => family,
            Self::Values => "values",
            Self::Carried => "clip-attributes",
            Self::Samples => "samples4",
            Self::SampleValues => "sample-values",
            Self::Order => "vertex-order",
            Self::Watertight => "watertight",
            Self::Direction => "line-direction",
            Self::Outline => "fill-and-outline",
        }
    }

    /// The checks of a case; of two programs those that compare answers of the same program with each other are left out.
    #[must_use]
    pub fn of_truth(family: &str, case: &Case, index: u64, truth: &Truth) -> Vec<Self> {
        let mut checks = Self::of(family, case, index, &truth.declared);
        checks.retain(|check| truth.of_two.is_none() || !check.compares_answers());
        checks
    }

    /// The declared ones of the checks that a family is made for; nothing of the families of triangles and lines, where each case
    /// is there for several checks.
    fn made_for(family: &str, declared: &Declared) -> Option<Vec<Self>> {
        // Shares and lines with a width are judged by samples, so that other shapes leave them out.
        let is_sampled = declared.shape == declared::Shape::Sample;
        let all = match family {
            _ if family.starts_with("depth-") => vec![(Self::Depth, declared.depth)],
            _ if ["near-plane", facts::near::TOPIC.name].contains(&family) => {
                vec![(Self::Near, declared.clip), (Self::Carried, declared.clip_attributes)]
            }
            _ if family.starts_with("formula-") => vec![(Self::Formula, declared.formulas)],
            _ if family.starts_with("area") => vec![(Self::Area, declared.area && is_sampled)],
            _ if family.starts_with("wide-line") => {
                vec![(Self::Wide, declared.wide_line && is_sampled)]
            }
            _ if family == facts::values::TOPIC.name => vec![(Self::Values, declared.attributes)],
            _ if family == facts::samples::TOPIC.name => {
                vec![(Self::Samples, declared.answers_samples())]
            }
            _ if family == facts::sample_values::TOPIC.name => {
                vec![(Self::SampleValues, declared.answers_sample_values())]
            }
            _ => return None,
        };
        let mut checks = Vec::new();
        for (check, is_declared) in all {
            if is_declared {
                checks.push(check);
            }
        }
        Some(checks)
    }

    /// Whether a family has a request for a program that declares this: cases of a design take time to choose.
    #[must_use]
    pub fn asks(family: &Family, declared: &Declared) -> bool {
        match Self::made_for(family.name, declared) {
            Some(checks) => !checks.is_empty(),
            None if adapt_case::is_lines(family) => declared.line,
            None => {
                declared.coverage
                    || declared.attributes
                    || declared.answers_samples()
                    || declared.answers_sample_values()
            }
        }
    }

    /// The checks of a case of one program: one that every case has, and others that some have.
    #[must_use]
    pub fn of(family: &str, case: &Case, index: u64, declared: &Declared) -> Vec<Self> {
        if let Some(mut checks) = Self::made_for(family, declared) {
            let has_places = case.triangles().iter().all(has_places);
            let is_of_samples = |check: &Self| [Self::Samples, Self::SampleValues].contains(check);
            checks.retain(|check| !is_of_samples(check) || has_places);
            // Exact depths of overlapping triangles are dear, and a design leaves no case out.
            let every = match family {
                "depth-order" => 4,
                "depth-near-tie" => 2,
                _ => 1,
            };
            return if index.is_multiple_of(every) { checks } else { Vec::new() };
        }
        let mut checks = Vec::new();
        match &case.shape {
            Shape::Lines(_) if declared.line => checks.extend([Self::Line, Self::Direction]),
            Shape::Lines(_) | Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
            Shape::Triangles { list, disjoint } => {
                // Which checks a case gets depends on its number: of most of them a share of all cases is enough.
                let is_perspective = family.starts_with("w-");
                if declared.attributes && (is_perspective || index % 8 == 3) {
                    checks.push(Self::Values);
                }
                let has_places = list.iter().all(has_places);
                let has_turn = is_perspective || index % 8 == 5;
                if declared.answers_sample_values() && has_turn && has_places {
                    checks.push(Self::SampleValues);
                }
                if declared.coverage && !is_perspective {
                    checks.push(Self::Coverage);
                    if index.is_multiple_of(4) && list.len() == 1 {
                        checks.push(Self::Order);
                    }
                    let is_centred =
                        declared.convention.sample == [HALF_PIXEL; 2] && declared.grid() > 1;
                    if family == "half-integer"
                        && declared.line
                        && is_centred
                        && declared.shape == declared::Shape::Sample
                        && index % 4 == 2
                    {
                        checks.push(Self::Outline);
                    }
                    // Neighbours share the pixels that an edge touches.
                    if *disjoint && declared.shape == declared::Shape::Sample {
                        checks.push(Self::Watertight);
                    }
                }
                let has_turn = index % 8 == 1 && !is_perspective;
                if declared.answers_samples() && has_turn && has_places {
                    checks.push(Self::Samples);
                }
            }
        }
        checks
    }

    /// What is asked about one triangle on its own.
    fn question_of(self, triangle: &Triangle, truth: &Truth) -> Asked {
        match self {
            Self::Values => Asked::Values(*triangle),
            Self::SampleValues => Asked::SampleValues(*triangle),
            Self::Samples => Asked::Samples(triangle.corners()),
            Self::Near => Asked::Near(*triangle),
            Self::Carried => Asked::Carried(*triangle),
            Self::Wide => Asked::Wide(wide_line(triangle)),
            Self::Area => Asked::Area(triangle.corners()),
            // A mesh is wound as the program draws.
            Self::Watertight => Asked::Coverage(wound(triangle.corners(), truth.drawn)),
            _ => Asked::Coverage(triangle.corners()),
        }
    }

    /// Appends the requests of a case.
    pub fn questions(self, case: &Case, truth: &Truth, out: &mut Vec<Question>) {
        let (width, height) = (case.window.width(), case.window.height());
        let ask = |of| Question { width, height, of };
        match (&case.shape, self) {
            (Shape::Triangles { list, .. }, Self::Depth) => {
                out.push(ask(Asked::Depth(list.clone())))
            }
            (Shape::Triangles { list, .. }, Self::Order) => {
                // With one winding drawn, only turning leaves the picture as it is.
                let orders: [[usize; 3]; 3] = match truth.drawn {
                    Winding::Both => [[0, 1, 2], [1, 2, 0], [0, 2, 1]],
                    _ => [[0, 1, 2], [1, 2, 0], [2, 0, 1]],
                };
                for corners in list.iter().map(Triangle::corners) {
                    for order in orders {
                        out.push(ask(Asked::Coverage(order.map(|i| corners[i]))));
                    }
                }
            }
            (Shape::Triangles { list, .. }, Self::Outline) => {
                for corners in list.iter().map(Triangle::corners) {
                    let Some([a, b, c]) = outline::ends(&corners, case.window) else { continue };
                    out.push(ask(Asked::Coverage(wound(corners, truth.drawn))));
                    for ends in [[a, b], [b, c], [c, a]] {
                        out.push(ask(Asked::Line { ends, whole: false }));
                    }
                }
            }
            (Shape::Triangles { list, .. }, check) => {
                for triangle in list {
                    out.push(ask(check.question_of(triangle, truth)));
                }
            }
            (Shape::Lines(lines), check) => {
                // A program that knows whole pixels alone gets these, and not their centres.
                let whole = truth.declared.grid() == 1;
                for [a, b] in lines.iter().map(|l| l.ends.map(|end| end.pixel)) {
                    out.push(ask(Asked::Line { ends: [a, b], whole }));
                    if check == Self::Direction {
                        out.push(ask(Asked::Line { ends: [b, a], whole }));
                    }
                }
            }
            (Shape::Numbers { formula, numbers }, _) => {
                out.push(ask(Asked::Formula(*formula, numbers.clone())));
            }
            (Shape::Unsnapped { .. }, _) => {}
        }
    }

    /// What happened instead of answers, where some of them are missing.
    #[must_use]
    pub fn judge_deaths(answers: &[Answer]) -> CaseJudgement {
        // A run that ends before it begins is a finding even where the rest of the case is not judged.
        let backward = answers.iter().find_map(Answer::backward_run);
        let mut judged =
            CaseJudgement { mark: 0xcbf2_9ce4_8422_2325, backward, ..CaseJudgement::default() };
        for (i, answer) in answers.iter().enumerate() {
            match answer {
                Answer::Died(misbehaviour) => judged.died.push((i, misbehaviour.clone())),
                Answer::Refused(reason) => {
                    judged.answered += 1;
                    judged.refuse(reason);
                }
                _ => judged.answered += 1,
            }
        }
        judged
    }

    /// Judges the answers to the questions of [`Check::questions`].
    #[must_use]
    pub fn judge(self, case: &Case, answers: &[Answer], truth: &Truth) -> CaseJudgement {
        if let Some(of_two) = &truth.of_two {
            return self::of_two(self, case, answers, of_two);
        }
        let mut judged = Self::judge_deaths(answers);
        match (&case.shape, self) {
            (Shape::Triangles { list, .. }, Self::Order) => {
                judged.shapes = list.len() as u64;
                // Three requests for each triangle, with its vertices in another order each time.
                for same in answers.chunks(3) {
                    alike(&mut judged, same, case.window);
                }
            }
            (Shape::Triangles { .. }, Self::Outline) => {
                // Four requests for each triangle: its fill, then its three sides.
                answers.chunks(4).for_each(|of| outline::compare(&mut judged, of, case.window));
            }
            (Shape::Triangles { list, .. }, Self::Watertight) => {
                watertight(&mut judged, list, answers, case.window);
            }
            (Shape::Triangles { list, .. }, Self::Depth) => {
                // The whole case is one request, and has one picture.
                let pile = Pile::new(list, case.window, &*truth.expect, &truth.declared);
                if let (Some(pile), Some(Answer::Seen(runs))) = (pile, answers.first()) {
                    pile.compare(&mut judged, runs);
                }
                judged.unscored += u64::from(truth.recognised.is_some());
            }
            (Shape::Triangles { .. }, Self::Near | Self::Carried) => {
                let mut questions = Vec::new();
                self.questions(case, truth, &mut questions);
                for (question, answer) in questions.iter().zip(answers) {
                    // The triangle is the one that was asked, with or without its attribute.
                    let asked = near_plane::asked(&question.of);
                    if let (Some(triangle), Some(corners)) = (asked, answer.polygon()) {
                        near_plane::compare(&mut judged, &triangle, corners, &truth.declared);
                    }
                }
            }
            (Shape::Triangles { list, .. }, Self::Wide) => {
                for (triangle, answer) in list.iter().zip(answers) {
                    // Each line on its own, as triangles are.
                    let picture = truth.expect.wide(&wide_line(triangle), case.window);
                    let (Some(picture), Answer::Coverage(runs)) = (picture, answer) else {
                        continue;
                    };
                    judged.shapes += 1;
                    judged.pixels += length(&picture.must);
                    let tally = &mut judged.finding.tally;
                    compare(tally, &mut judged.mark, runs, &picture, case.window);
                }
                judged.unscored += u64::from(truth.recognised.is_some());
            }
            (Shape::Triangles { list, .. }, _) => {
                for (triangle, answer) in list.iter().zip(answers) {
                    one_triangle(&mut judged, triangle, answer, case.window, truth);
                }
            }
            (Shape::Lines(lines), Self::Direction) => {
                judged.shapes = lines.len() as u64;
                // Two requests for each line, from one end and from the other.
                for both in answers.chunks(2) {
                    alike(&mut judged, both, case.window);
                }
            }
            (Shape::Lines(lines), _) => {
                for (line, answer) in lines.iter().zip(answers) {
                    one_line(&mut judged, line, answer, case.window, truth);
                }
            }
            (Shape::Numbers { formula, numbers }, _) => {
                let exact = formula.of(numbers);
                // A formula has one request, with all its numbers.
                if let (Some(exact), Some(Answer::Numbers(given))) = (exact, answers.first()) {
                    numbers::compare(&mut judged, given, &exact, truth.declared.tolerance);
                }
            }
            (Shape::Unsnapped { .. }, _) => {}
        }
        judged
    }
}

/// How the answers of two programs differ, and whether each is right.
fn of_two(check: Check, case: &Case, answers: &[Answer], of_two: &[Truth; 2]) -> CaseJudgement {
    // Each program is judged by its own declaration first.
    let sides = difference::sides(answers);
    let [first, second] = [0, 1].map(|at| check.judge(case, &sides[at], &of_two[at]));
    // What died is the same on both sides.
    let died = first.died.clone();
    let mut judged = CaseJudgement {
        shapes: first.shapes,
        pixels: first.pixels,
        answered: first.answered,
        right: died.is_empty().then(|| [!first.is_wrong(), !second.is_wrong()]),
        died,
        mark: first.mark ^ second.mark.rotate_left(1),
        ..CaseJudgement::default()
    };
    // Then both are compared, answer by answer.
    let declared = &of_two[0].declared;
    for (at, (first, second)) in sides[0].iter().zip(&sides[1]).enumerate() {
        if first.is_same(second) {
            continue;
        }
        // Bounds of values depend on the triangle that was asked.
        let triangle = match &case.shape {
            Shape::Triangles { list, .. } => list.get(at),
            _ => None,
        };
        if let (
            Shape::Numbers { formula, numbers },
            [Answer::Numbers(first), Answer::Numbers(second)],
        ) = (&case.shape, [first, second])
        {
            let exact = formula.of(numbers).unwrap_or_default();
            numbers::difference(&mut judged, [first, second], &exact, declared.tolerance);
            continue;
        }
        difference::difference(&mut judged, [first, second], triangle, case.window, declared);
    }
    judged
}

/// Whether all samples have places: not where a corner lies at the very end of the domain.
fn has_places(triangle: &Triangle) -> bool {
    multisample::SAMPLES.iter().all(|sample| multisample::moved(triangle, *sample).is_some())
}

/// The triangle turned over where this winding alone is drawn and it has the other.
fn wound([a, b, c]: Corners, drawn: Winding) -> Corners {
    let is_other = match drawn {
        Winding::Clockwise => twice_area(&[a, b, c]) < 0,
        Winding::CounterClockwise => twice_area(&[a, b, c]) > 0,
        Winding::Both => false,
    };
    if is_other { [a, c, b] } else { [a, b, c] }
}

/// Judges the answer to a question about one triangle, whatever kind of answer it is: the pixels first, then what is in them.
fn one_triangle(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    answer: &Answer,
    window: PixelRect,
    truth: &Truth,
) {
    let corners = triangle.corners();
    // Where nothing is promised, nothing is judged.
    let Some(picture) = truth.expect.picture(&corners, window) else { return };
    judged.shapes += 1;
    if !matches!(answer, Answer::Samples(_) | Answer::SampleValues(_) | Answer::Area(_)) {
        judged.pixels += length(&picture.must);
    }
    match answer {
        Answer::Coverage(runs) => coverage(judged, &corners, runs, &picture, window, truth),
        Answer::Values(fragments) => {
            // Fragments are pixels first, and their values count where a pixel is expected.
            let runs: Vec<_> = fragments.iter().map(pixel_of).collect();
            coverage(judged, &corners, &runs, &picture, window, truth);
            let expected = hits(&picture.must, window).0;
            values(judged, triangle, fragments, &expected, truth);
        }
        Answer::Samples(runs) => {
            samples(judged, &corners, runs, window, truth);
        }
        Answer::SampleValues(list) => {
            // Masks first, then the values of the samples that are covered.
            let runs: Vec<_> = list.iter().map(|s| (pixel_of(&s.values), s.mask)).collect();
            let Some(covered) = samples(judged, &corners, &runs, window, truth) else { return };
            sample_values::compare(judged, triangle, list, &covered, &truth.declared);
        }
        Answer::Area(runs) => levels(judged, &corners, runs, window, truth),
        _ => {}
    }
}

/// Compares the pixels of a triangle with those that are expected as declared, and with those by the convention that was
/// recognised, where there is one.
fn coverage(
    judged: &mut CaseJudgement,
    corners: &Corners,
    runs: &[Span],
    declared: &Expectation,
    window: PixelRect,
    truth: &Truth,
) {
    let before = judged.finding.tally.total();
    // The first score is as declared, whatever else was recognised.
    compare(&mut judged.finding.tally, &mut judged.mark, runs, declared, window);
    let wrong = judged.finding.tally.total() - before;
    let Some(recognised) = &truth.recognised else { return };
    match recognised.picture(corners, window) {
        Some(picture) => {
            judged.other_pixels += length(&picture.must);
            compare(&mut judged.other, &mut 0, runs, &picture, window);
        }
        None => leave_out(judged, wrong),
    }
}

/// Counts the pixels in which answers differ from the first one.
fn alike(judged: &mut CaseJudgement, answers: &[Answer], window: PixelRect) {
    let drawn: Vec<Coverage> = answers.iter().filter_map(|a| picture_of(a, window)).collect();
    let Some((first, others)) = drawn.split_first() else { return };
    judged.pixels += first.covered();
    for other in others {
        judged.finding.tally += Tally::between(other, first);
        if other == first {
            continue;
        }
        // The mark tells one difference from another.
        for ((_, row), (_, other)) in first.rows().zip(other.rows()) {
            for (a, b) in row.iter().zip(other) {
                mix(&mut judged.mark, u64::from(*a ^ *b));
            }
        }
    }
}

/// Counts the holes and the doubles of a mesh, under any convention.
fn watertight(
    judged: &mut CaseJudgement,
    list: &[Triangle],
    answers: &[Answer],
    window: PixelRect,
) {
    judged.shapes = list.len() as u64;
    let Some(sum) = mesh_of(answers, window) else { return };
    judged.pixels += sum.covered();
    let corners: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
    let (holes, doubles) = mesh::holes_and_doubles(&corners, &sum);
    judged.finding.tally += Tally { missing: holes, twice: doubles, ..Tally::default() };
}

/// Compares the values of some fragments, where these belong.
fn values(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    fragments: &[Fragment<DVec2>],
    expected: &Coverage,
    truth: &Truth,
) {
    let Some(exact) = exact_values(triangle, &truth.declared) else { return };
    // Values are compared in some pixels only, since exact ones take long.
    let bounds = value_bounds(triangle, truth.declared.tolerance);
    for f in few(fragments) {
        if expected.get(f.x_px, f.y_px).is_none_or(|hits| hits == 0) {
            continue;
        }
        let (depth, [a, b]) = exact.at(f.x_px, f.y_px);
        let bounds = truth.expect.bounds(triangle, (f.x_px, f.y_px)).unwrap_or(bounds);
        let errors = [depth.distance(f.depth), a.distance(f.varying.x), b.distance(f.varying.y)];
        // Where nothing may be off, the smallest number keeps a quotient of 0 and 0 defined.
        judged.off(f, [0, 1, 2].map(|i| errors[i] / bounds[i].max(f64::MIN_POSITIVE)));
    }
}

/// Compares masks bit by bit, and returns the right ones; the samples have fixed places, so the declared one does not matter.
fn samples(
    judged: &mut CaseJudgement,
    corners: &Corners,
    runs: &[(Span, u8)],
    window: PixelRect,
    truth: &Truth,
) -> Option<Frame<u8>> {
    let drawn = truth.declared.convention.draws(twice_area(corners));
    let expected = multisample::masks(&Oracle, *corners, window).filter(|_| drawn)?;
    let all: Vec<Span> = runs.iter().map(|(run, _)| *run).collect();
    judged.finding.tally.extra += hits(&all, window).1;
    // Of each pixel its samples, and how many were drawn when they had been drawn already.
    let drawn = painted(runs, window, [0_u8; 2], |[mask, twice], more| {
        *twice = twice.saturating_add((*mask & more).count_ones() as u8);
        *mask |= more;
    });
    for (y, row) in drawn.rows() {
        for (&[a, twice], &e) in row.iter().zip(expected.row(y)) {
            judged.pixels += u64::from(e.count_ones());
            judged.finding.tally.missing += u64::from((e & !a).count_ones());
            judged.finding.tally.extra += u64::from((a & !e).count_ones());
            judged.finding.tally.twice += u64::from(twice);
            mix(&mut judged.mark, u64::from(a ^ e));
        }
    }
    Some(expected)
}

/// Compares the levels of pixels with their exact shares. How far the worst is off is counted in tolerances.
fn levels(
    judged: &mut CaseJudgement,
    corners: &Corners,
    runs: &[(Span, u8)],
    window: PixelRect,
    truth: &Truth,
) {
    let declared = &truth.declared;
    let all: Vec<Span> = runs.iter().map(|(run, _)| *run).collect();
    // Hits are counted apart from levels: a pixel that is drawn twice is wrong whatever its level.
    let (hit, outside) = hits(&all, window);
    judged.finding.tally.extra += outside;
    // Of each pixel the last level that was drawn.
    let actual = painted(runs, window, 0, |here, level| *here = level);
    for (y, row) in actual.rows() {
        for ((x, &level), &hits) in (window.x0..).zip(row).zip(hit.row(y)) {
            let share = declared.share(corners, [x, y]);
            let off = f64::from(level) - share * f64::from(declared.levels);
            let is_wrong = off.abs() > declared.steps_off();
            judged.pixels += u64::from(share > 0.0);
            judged.finding.tally.missing += u64::from(is_wrong && off < 0.0);
            judged.finding.tally.extra += u64::from(is_wrong && off > 0.0);
            judged.finding.tally.twice += u64::from(hits.saturating_sub(1));
            if is_wrong && off.abs() > judged.steps_off {
                judged.steps_off = off.abs();
                judged.worst_at = Some((x, y));
            }
            mix(&mut judged.mark, u64::from(is_wrong));
        }
    }
}

/// Judges the pixels of a line as declared and, where another convention was recognised, by that one too.
fn one_line(
    judged: &mut CaseJudgement,
    line: &Line,
    answer: &Answer,
    window: PixelRect,
    truth: &Truth,
) {
    let Answer::Line(pixels) = answer else { return };
    // Only the pixels of the ends are asked; depth and values of lines are not judged.
    let ends = line.ends.map(|end| end.pixel);
    let Some(expected) = truth.expect.line(&ends, window) else { return };
    judged.shapes += 1;
    judged.pixels += expected.len() as u64;
    // A program may declare that it gives the pixels of a line in no order.
    let in_order = !truth.declared.line_set;
    let before = judged.finding.tally.total();
    sequence(&mut judged.finding.tally, &mut judged.mark, pixels, &expected, window, in_order);
    let wrong = judged.finding.tally.total() - before;
    let Some(recognised) = &truth.recognised else { return };
    match recognised.line(&ends, window) {
        Some(expected) => {
            judged.other_pixels += expected.len() as u64;
            let in_order = in_order && recognised.keeps_order();
            sequence(&mut judged.other, &mut 0, pixels, &expected, window, in_order);
        }
        None => leave_out(judged, wrong),
    }
}

/// Counts a shape of which the recognised convention says nothing, and its pixels that are wrong as declared.
fn leave_out(judged: &mut CaseJudgement, wrong: u64) {
    judged.unscored += 1;
    judged.unscored_wrong += wrong;
}

/// The answer that was expected to each question of a check, where there is one.
#[must_use]
pub fn expected_answer(question: &Question, truth: &Truth) -> Option<Answer> {
    let window = PixelRect::window(question.width, question.height);
    match &question.of {
        Asked::Coverage(corners) => {
            truth.expect.picture(corners, window).map(|picture| Answer::Coverage(picture.must))
        }
        Asked::Line { ends, .. } => truth.expect.line(ends, window).map(Answer::Line),
        Asked::Wide(line) => {
            truth.expect.wide(line, window).map(|picture| Answer::Coverage(picture.must))
        }
        Asked::Values(triangle) => {
            let picture = truth.expect.picture(&triangle.corners(), window)?;
            let exact = exact_values(triangle, &truth.declared);
            let mut fragments = Vec::new();
            for run in &picture.must {
                for x_px in run.x0_px..run.x1_px {
                    // A triangle without area has no values.
                    let Some(exact) = &exact else { continue };
                    let (depth, [a, b]) = exact.at(x_px, run.y_px);
                    let varying = DVec2::new(a.to_f64(), b.to_f64());
                    let depth = depth.to_f64();
                    fragments.push(Fragment { x_px, y_px: run.y_px, depth, varying });
                }
            }
            Some(Answer::Values(fragments))
        }
        Asked::Depth(list) => {
            let pile = Pile::new(list, window, &*truth.expect, &truth.declared)?;
            Some(Answer::Seen(pile.runs()))
        }
        Asked::Near(triangle) | Asked::Carried(triangle) => {
            let corners = near_plane::polygon(triangle, truth.declared.near_is_zero);
            let floats =
                corners.iter().map(|corner| corner.each_ref().map(Exact::to_f64)).collect();
            // The exact polygon, with or without its attributes.
            let carries = matches!(question.of, Asked::Carried(_));
            Some(if carries { Answer::Carried(floats) } else { Answer::Polygon(floats) })
        }
        Asked::Area(corners) => {
            let mut runs = Vec::new();
            for y in window.y0..window.y1 {
                for x in window.x0..window.x1 {
                    let share = truth.declared.share(corners, [x, y]);
                    let level = share * f64::from(truth.declared.levels);
                    // A level of 0 is not drawn.
                    if level.round() > 0.0 {
                        push(&mut runs, x, y, level.round() as u8);
                    }
                }
            }
            Some(Answer::Area(runs))
        }
        Asked::Formula(formula, numbers) => {
            let given = formula.of(numbers)?;
            Some(Answer::Numbers(given.iter().map(|given| given.exact.to_f64()).collect()))
        }
        Asked::Samples(_) | Asked::SampleValues(_) | Asked::Polygon(_) => None,
    }
}

/// What stands after 1, or after any other number.
fn one(number: u64, one: &'static str, several: &'static str) -> &'static str {
    if number == 1 { one } else { several }
}
