//! Recognises the convention of a program under judgement: puts the questions of [`rasterproof_verify::convention`]
//! to it, and turns what was found into an expectation and into words.
//!
//! A program that draws as it declares is not questioned: a short look at families full of ties says
//! so, with a few hundred requests instead of a thousand.

use std::cell::RefCell;
use std::fmt::Write as _;
use std::time::Duration;

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Asked, Question, Subject};
use super::check::{Check, Truth};
use super::declared::{Declared, Shape};
use super::expected::{Expect, runs};
use super::in_process::Inside;
use super::leaving;
use super::pixels::picture_of;
use super::run::MOST_DEATHS;
use super::stages;
use super::text::px;
use super::timed::Timed;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect};
use rasterproof_core::triangle::{Corners, PixelPoint};
use rasterproof_faults::planted::{LineMutant, TileMutant, TriangleMutant};
use rasterproof_registry::engines::{self, Entry};
use rasterproof_verify::ask::{Search, Step};
use rasterproof_verify::comparison::{Convention, Expectation, Rule};
use rasterproof_verify::convention::{
    self, Confidence, Declarations, Diagnosis, FACINGS, LineDiagnosis, LineQuestion, Quantum,
    TriangleQuestion,
};
use rasterproof_verify::judge::AFTER_FAILURE;
use rasterproof_verify::mistakes::{self, Mistakes, Program};

/// What was found about the convention of a program.
pub struct Recognised {
    /// What is said of both.
    pub said: Said,
    pub triangles: Option<Diagnosis>,
    pub lines: Option<LineDiagnosis>,
    /// What it is expected to draw under this convention; nothing where no hypothesis explains it.
    pub expect: Option<Box<dyn Expect>>,
    /// How long its answers took after the first wrong one.
    pub spent: Duration,
    /// Whether the time was up before it was found.
    pub is_late: bool,
}

/// The same in words, for reports.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Said {
    /// What the program does, a sentence or two for triangles and for lines.
    pub sentences: Vec<String>,
    /// Which samples on edges are drawn, where no rule with a name says so.
    pub compass: Option<String>,
    /// The words that declare it, where the protocol has words for it that are not declared.
    pub declare: String,
    /// Whether there is something to score it by.
    pub is_explained: bool,
    /// Whether samples on edges are drawn in no fixed way, so that the convention explains whatever happens there.
    #[serde(skip)]
    pub is_open: bool,
}

/// What is looked for, and for how long.
#[derive(Clone, Copy, Debug)]
pub struct Scope {
    pub triangles: bool,
    pub lines: bool,
    /// Also where it draws as it declares.
    pub always: bool,
    /// How long its answers may take after the first wrong one.
    pub patience: Option<Duration>,
}

impl Scope {
    /// Of more than one case, what the families hold.
    #[must_use]
    pub fn of(options: &Options) -> Self {
        let families = adapt_case::families(&options.families);
        let any = |lines| {
            options.only.is_none() && families.iter().any(|f| adapt_case::is_lines(f) == lines)
        };
        // Without a time limit, half of what comes after the first wrong answer is for smaller cases and for causes.
        let patience = options.time_limit.is_none().then_some(AFTER_FAILURE / 2);
        Self { triangles: any(false), lines: any(true), always: false, patience }
    }
}

/// The questions are the same in every run.
const SEED: u64 = 1;
/// Families of the short look, and cases of each.
const LOOK: [&str; 4] = ["half-integer", "rectangle", "fan", "uniform"];
const LOOK_CASES: u64 = 16;

/// The convention of a program; nothing where it draws as it declares.
pub fn recognise(program: &mut dyn Subject, scope: Scope) -> Option<Recognised> {
    let declared = program.declared().clone();
    let mut bench = Bench::new(Timed::new(program, None));
    let open = declared.convention.rule == Rule::Unspecified;
    // A program that draws as it declares is not questioned, unless that is asked for or its rule leaves ties open.
    let mut triangles = None;
    if scope.triangles
        && declared.coverage
        && (scope.always || open || !bench.draws_as_declared(&declared, false))
        && !bench.program.is_late
    {
        bench.limit(scope.patience);
        let known = known(&declared);
        let search = async |asker| convention::diagnose(&asker, &known, SEED).await;
        triangles = Some(bench.search(Search::new(search), Bench::triangles));
    }
    let mut lines = None;
    if scope.lines
        && declared.line
        && (scope.always || !bench.draws_as_declared(&declared, true))
        && !bench.program.is_late
    {
        bench.limit(scope.patience);
        let side_px = known(&declared).side_px();
        let ordered = !declared.line_set;
        let search = async |asker| convention::diagnose_lines(&asker, side_px, ordered, SEED).await;
        lines = Some(bench.search(Search::new(search), Bench::lines));
    }
    if bench.program.is_late {
        let spent = bench.spent(scope.patience);
        return Some(Recognised { spent, ..Recognised::late() });
    }
    if triangles.is_none() && lines.is_none() {
        return None;
    }
    // Something is explained where a hypothesis was found for triangles or for lines.
    let is_explained = triangles.as_ref().is_some_and(|t| t.confidence != Confidence::Unexplained)
        || lines.as_ref().is_some_and(|l| l.confidence != Confidence::Unexplained);
    let mut sentences = Vec::new();
    sentences.extend(triangles.as_ref().map(|t| clause("Triangles", &t.sentence())));
    sentences.extend(lines.as_ref().map(|l| clause("Lines", &l.sentence())));
    // What is not a rule with a name is said sample by sample, and what can be declared is offered as words.
    let compass = triangles.as_ref().and_then(compass);
    let declare = triangles.as_ref().map(|t| words(&declared, t)).unwrap_or_default();
    let is_open = triangles.as_ref().is_some_and(|t| !t.compass.is_decided());
    let mut found =
        Recognition { declaration: declared.convention, triangles, lines, otherwise: [false; 2] };
    found.look_at_leaving(&mut bench, &declared, &mut sentences);
    let said = Said { sentences, compass, declare, is_explained, is_open };
    let (triangles, lines) = (found.triangles.clone(), found.lines.clone());
    let expect = is_explained.then(|| Box::new(found) as Box<dyn Expect>);
    let spent = bench.spent(scope.patience);
    Some(Recognised { said, triangles, lines, expect, spent, is_late: false })
}

impl Recognised {
    /// What is said where the time was up.
    pub(super) fn late() -> Self {
        let late = "The time was up before its convention was found.".to_owned();
        Self {
            said: Said { sentences: vec![late], ..Said::default() },
            triangles: None,
            lines: None,
            expect: None,
            spent: Duration::ZERO,
            is_late: true,
        }
    }
}

/// A sentence as a clause after what it is about: its first letter becomes small.
fn clause(about: &str, sentence: &str) -> String {
    let mut chars = sentence.chars();
    let first = chars.next().map(|c| c.to_ascii_lowercase());
    format!("{about}: {}{}", first.map(String::from).unwrap_or_default(), chars.as_str())
}

/// What is found, and what is declared where nothing was looked for.
struct Recognition {
    declaration: Convention,
    triangles: Option<Diagnosis>,
    lines: Option<LineDiagnosis>,
    /// Whether triangles, and lines, that leave the window come out otherwise.
    otherwise: [bool; 2],
}

impl Recognition {
    /// Where everything within the window is explained, looks at what leaves it.
    fn look_at_leaving(
        &mut self,
        bench: &mut Bench<'_>,
        declared: &Declared,
        sentences: &mut [String],
    ) {
        let certain = Some(Confidence::Certain);
        // What leaves the window says something only where all within it is explained.
        let is_certain = [
            self.triangles.as_ref().map(|t| t.confidence) == certain,
            self.lines.as_ref().map(|l| l.confidence) == certain,
        ];
        for (lines, what) in [(false, "Triangles"), (true, "Lines")] {
            if !is_certain[usize::from(lines)] {
                continue;
            }
            // Shapes that leave the window are asked, and compared with what the convention says of them.
            let questions = leaving::questions(declared, lines, self.quantum());
            let found = leaving::otherwise(&questions, &bench.answers(&questions), self);
            let Some(said) = found.sentence(what) else { continue };
            self.otherwise[usize::from(lines)] = found.is_convention();
            let about = |sentence: &&mut String| sentence.starts_with(what);
            sentences.iter_mut().filter(about).for_each(|sentence| *sentence += &said);
        }
    }

    /// The grid that corners were found to be on.
    fn quantum(&self) -> Quantum {
        self.triangles.as_ref().map_or(Quantum::NONE, |found| found.convention.quantum)
    }
}

impl Expect for Recognition {
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Expectation> {
        if self.otherwise[0] && leaving::triangle_leaves(corners, self.quantum(), window) {
            return None;
        }
        let Some(found) = &self.triangles else { return self.declaration.picture(corners, window) };
        let coverage = found.expected(&TriangleQuestion { corners: *corners, window })?;
        Some(Expectation { must: runs(&coverage), may: None })
    }

    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>> {
        if self.otherwise[1] && leaving::line_leaves(ends, window) {
            return None;
        }
        let Some(found) = &self.lines else { return self.declaration.line(ends, window) };
        let question = LineQuestion { ends: ends.map(|p| [p.x, p.y]), window };
        Some(found.expected(&question)?.into_iter().map(|[x, y]| (x, y)).collect())
    }

    fn keeps_order(&self) -> bool {
        self.lines.as_ref().is_none_or(|found| found.in_order.drawn == found.in_order.of)
    }
}

/// What the search for a convention may take for granted, since the program declares it or was seen to do it.
fn known(declared: &Declared) -> Declarations {
    let known = Declarations::from(&declared.convention);
    // The range is as short as the program was seen to need.
    let mut range_px = declared.range.unwrap_or(known.range_px);
    if let Some(reach) = declared.reach {
        range_px = range_px.min(reach);
    }
    if let Some(side) = declared.side {
        range_px = range_px.min(side / 2);
    }
    Declarations {
        range_px,
        window_px: declared.window.map_or(known.window_px, |[width, height]| (width, height)),
        mask: declared.mask,
        ..known
    }
}

/// Why a program is wrong in each kind of check, where no convention explains it; and whether the time was up before this was
/// known. The time that is left is shared among the checks, so that what is found of one depends less on the others. `failing` are
/// questions whose answers are wrong.
pub fn mistakes(
    program: &mut Timed<'_>,
    checks: &[Check],
    truth: &Truth,
    recognised: Option<&Recognised>,
    failing: &[Question],
) -> (Vec<Why>, bool) {
    let known = known(&truth.declared);
    let (mut all, mut was_cut) = (Vec::new(), false);
    for (&check, to_do) in checks.iter().zip((1..=checks.len() as u32).rev()) {
        // The time that is left is shared among the checks that are still to do.
        let share = program.rest().map(|rest| rest / to_do);
        // Each check gets its share of the answers, and none of another one.
        let end = program.end;
        let part = Timed::new(&mut *program, end).within(share);
        let mut bench = Bench::new(part);
        // Triangles and lines have searches of their own; every other check is a stage.
        let (of, why) = match check {
            Check::Coverage => {
                let found = recognised.and_then(|found| found.triangles.as_ref());
                let programs = programs(of_triangle);
                let learn: mistakes::LearnTriangles = mistakes::learn_triangles;
                let search = Search::new(async |asker| {
                    mistakes::of_triangles(&asker, &known, found, &programs, Some(learn)).await
                });
                let search = search.beside(failing.iter().filter_map(as_triangle).collect());
                ("triangles", bench.search(search, Bench::triangles))
            }
            Check::Line => {
                let found = recognised.and_then(|found| found.lines.as_ref());
                let programs = programs(of_line);
                let search = Search::new(async |asker| {
                    mistakes::of_lines(&asker, &known, found, &programs).await
                });
                let search = search.beside(failing.iter().filter_map(as_line).collect());
                ("lines", bench.search(search, Bench::lines))
            }
            check => {
                let of = match check {
                    Check::Values => "values",
                    Check::Samples => "samples",
                    Check::Depth => "depths",
                    Check::Wide => "lines with a width",
                    Check::Area => "shares of pixels",
                    Check::SampleValues => "values of samples",
                    Check::Formula => "formulas",
                    Check::Carried => "attributes of clipped corners",
                    _ => "near plane",
                };
                let mut programs = Vec::new();
                for (entry, about) in entries() {
                    programs.push((RefCell::new(Inside::new(&entry)), about));
                }
                let search = stages::mistakes(check, truth, &programs);
                (of, bench.search(search, |bench, asked| bench.program.ask(asked, MOST_DEATHS)))
            }
        };
        // What is concluded from few of the answers would be no conclusion.
        let is_enough = |why: &Mistakes| why.wrong.drawn >= mistakes::ENOUGH_WRONG as u64;
        let is_cut = bench.program.is_late && !why.as_ref().is_some_and(is_enough);
        was_cut |= is_cut;
        let why = why.filter(|_| !is_cut);
        all.extend(why.map(|why| Why { by: String::new(), check, of, why }));
    }
    (all, was_cut)
}

/// The mistakes of a program in one kind of check.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Why {
    /// Whose mistake it is, where two programs are compared.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub by: String,
    #[serde(skip)]
    pub check: Check,
    /// What is wrong: triangles, lines, values, samples, depths, or the near plane.
    pub of: &'static str,
    #[serde(flatten)]
    pub why: Mistakes,
}

impl Why {
    /// Of whose wrong pixels or values this is the cause.
    #[must_use]
    pub fn whose(&self) -> String {
        if self.by.is_empty() { self.of.to_owned() } else { format!("{} of {}", self.of, self.by) }
    }
}

/// The planted faults and the published algorithms, each with what is wrong with it.
fn entries() -> Vec<(Entry, String)> {
    // Its panic says what it is, and would be shown.
    let mut planted = Vec::new();
    for mutant in TriangleMutant::ALL {
        // Its panic says what it is, and would be shown.
        if mutant != TriangleMutant::PanicsOnFlatBottom {
            planted.push((mutant.name(), mutant.about()));
        }
    }
    planted.extend(LineMutant::ALL.map(|mutant| (mutant.name(), mutant.about())));
    planted.extend(TileMutant::ALL.map(|mutant| (mutant.name(), mutant.about())));
    let mut all = Vec::new();
    for (name, about) in planted {
        if let Some(entry) = engines::find_planted(name) {
            all.push((entry, format!("draws as the planted fault {name}: {about}")));
        }
    }
    for entry in engines::SPECIMENS {
        let about = entry.about.trim_start_matches("specimen: ");
        let does = format!("draws as the published algorithm {}: {about}", entry.name);
        all.push((entry, does));
    }
    all
}

/// The same as programs whose answers are known.
fn programs<'a, Q: 'a, A: 'a>(
    of: impl Fn(&Q, &mut Inside) -> Option<A> + Copy + 'a,
) -> Vec<Program<'a, Q, A>> {
    let mut all = Vec::new();
    for (entry, about) in entries() {
        let inside = RefCell::new(Inside::new(&entry));
        let draw = move |question: &Q| of(question, &mut inside.borrow_mut());
        all.push(Program { name: entry.name, about, draw: Box::new(draw) });
    }
    all
}

/// The picture that a program in memory draws.
fn of_triangle(question: &TriangleQuestion, program: &mut Inside) -> Option<Coverage> {
    let asked = triangle_question(question);
    program.ask(&[asked], 1).first().and_then(|answer| picture_of(answer, question.window))
}

/// The pixels of a line that a program in memory draws.
fn of_line(question: &LineQuestion, program: &mut Inside) -> Option<Vec<[i32; 2]>> {
    program.ask(&[line_question(question, false)], 1).pop().and_then(pixels_of)
}

/// A question of the search as the protocol asks it.
fn triangle_question(q: &TriangleQuestion) -> Question {
    let (width, height) = (q.window.width(), q.window.height());
    Question { width, height, of: Asked::Coverage(q.corners) }
}

/// The same of a line; `whole` is for programs that know whole pixels alone.
fn line_question(q: &LineQuestion, whole: bool) -> Question {
    let (width, height) = (q.window.width(), q.window.height());
    let ends = q.ends.map(|[x, y]| PixelPoint::new(x, y));
    Question { width, height, of: Asked::Line { ends, whole } }
}

/// The same the other way; nothing of other questions.
fn as_triangle(question: &Question) -> Option<TriangleQuestion> {
    let Asked::Coverage(corners) = question.of else { return None };
    Some(TriangleQuestion { corners, window: PixelRect::window(question.width, question.height) })
}

/// The same of lines.
fn as_line(question: &Question) -> Option<LineQuestion> {
    let Asked::Line { ends, .. } = question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    Some(LineQuestion { ends: ends.map(|end| [end.x, end.y]), window })
}

/// The pixels of an answer about a line; nothing of other answers, such as a refusal.
fn pixels_of(answer: Answer) -> Option<Vec<[i32; 2]>> {
    match answer {
        Answer::Line(pixels) => Some(pixels.into_iter().map(|(x, y)| [x, y]).collect()),
        _ => None,
    }
}

/// The program as the questions want it; asked no more once it has died too often.
struct Bench<'a> {
    program: Timed<'a>,
    /// How often it may still die before it is asked no more.
    deaths_left: u64,
}

impl<'a> Bench<'a> {
    fn new(program: Timed<'a>) -> Self {
        Self { program, deaths_left: MOST_DEATHS }
    }

    /// Limits its answers from the first wrong one on.
    fn limit(&mut self, patience: Option<Duration>) {
        self.program.left = self.program.left.or(patience);
    }

    /// How much of the limited time its answers took.
    fn spent(&self, patience: Option<Duration>) -> Duration {
        let left = patience.zip(self.program.left);
        left.map_or(Duration::ZERO, |(patience, left)| patience.saturating_sub(left))
    }

    /// The answers to some questions; nothing more once the program has died too often, or its time is up.
    fn answers(&mut self, questions: &[Question]) -> Vec<Answer> {
        if self.deaths_left == 0 || self.program.is_late {
            return Vec::new();
        }
        let answers = self.program.ask(questions, self.deaths_left);
        let deaths = answers.iter().filter(|answer| answer.is_death()).count() as u64;
        self.deaths_left = self.deaths_left.saturating_sub(deaths);
        self.program.is_late |= answers.len() < questions.len() && deaths == 0;
        answers
    }

    /// What a search comes to when the program answers.
    fn search<Q: Clone, A, T>(
        &mut self,
        mut search: Search<'_, Q, A, T>,
        answer: impl Fn(&mut Self, &[Q]) -> Vec<A>,
    ) -> T {
        loop {
            search.allow(self.program.questions_left());
            match search.step() {
                Step::Asks(questions) => search.answer(answer(self, &questions)),
                Step::Found(found) => return found,
            }
        }
    }

    /// The pictures of triangles, for [`Bench::search`].
    fn triangles(&mut self, questions: &[TriangleQuestion]) -> Vec<Option<Coverage>> {
        let asked: Vec<_> = questions.iter().map(triangle_question).collect();
        let answers = self.answers(&asked);
        answers.iter().zip(questions).map(|(answer, q)| picture_of(answer, q.window)).collect()
    }

    /// The pixels of lines, for [`Bench::search`].
    fn lines(&mut self, questions: &[LineQuestion]) -> Vec<Option<Vec<[i32; 2]>>> {
        let whole = self.program.declared().grid() == 1;
        let asked: Vec<_> = questions.iter().map(|q| line_question(q, whole)).collect();
        self.answers(&asked).into_iter().map(pixels_of).collect()
    }

    /// A short look: whether some cases full of ties, and some without, are as declared.
    fn draws_as_declared(&mut self, declared: &Declared, lines: bool) -> bool {
        let truth = Truth::of(declared);
        let check = if lines { Check::Line } else { Check::Coverage };
        for family in adapt_case::families(&[]) {
            let is_looked_at = lines || LOOK.contains(&family.name);
            if adapt_case::is_lines(family) != lines || !is_looked_at {
                continue;
            }
            // All cases of a family are asked at once; each has some of the questions.
            let mut cases = Vec::new();
            for index in 0..LOOK_CASES {
                let case = adapt_case::case(family, SEED, index, declared);
                if !adapt_case::leaves_window(&case) {
                    cases.push(case);
                }
            }
            let mut questions = Vec::new();
            let mut ends = Vec::new();
            for case in &cases {
                check.questions(case, &truth, &mut questions);
                ends.push(questions.len());
            }
            let answers = self.answers(&questions);
            if answers.len() != questions.len() {
                return false;
            }
            let mut start = 0;
            for (case, end) in cases.iter().zip(ends) {
                if check.judge(case, &answers[start..end], &truth).is_wrong() {
                    return false;
                }
                start = end;
            }
        }
        true
    }
}

/// The shape that is declared for what was found, where every pixel that a triangle touches is drawn.
fn touched(found: &Diagnosis) -> Option<Shape> {
    // A square of half a pixel around the sample: the pixel that a triangle touches.
    let by_touch =
        convention::Shape::Reach { x: HALF_PIXEL, y: HALF_PIXEL, reach: HALF_PIXEL, square: true };
    if found.convention.shape != by_touch || found.confidence == Confidence::Unexplained {
        return None;
    }
    Some(match found.convention.ties.name(found.compass.seen()) {
        Some("inclusive") => Shape::TouchedClosed,
        Some("strict") => Shape::TouchedOpen,
        _ => Shape::Touched,
    })
}

/// The words that declare what was found and is not declared; none where the protocol has none.
fn words(declared: &Declared, found: &Diagnosis) -> String {
    if let Some(shape) = touched(found).filter(|shape| *shape != declared.shape) {
        return format!("shape={}", shape.name());
    }
    let Some(found) = found.declaration(&declared.convention) else { return String::new() };
    let grid =
        [256, 64, 16].into_iter().find(|grid| *grid <= 1 << found.subpixel_bits).unwrap_or(1);
    // Only the words that differ from what is declared already.
    let (declared, [x, y]) = (&declared.convention, found.sample);
    let mut out = String::new();
    if grid < 1 << declared.subpixel_bits {
        let _ = write!(out, " grid={grid}");
    }
    if [x, y] != declared.sample {
        let _ = write!(out, " origin={},{}", px(x), px(y));
    }
    if found.rule != declared.rule {
        let _ = write!(out, " rule={}", found.rule.word());
    }
    if found.winding != declared.winding {
        let _ = write!(out, " winding={}", found.winding.word());
    }
    out.trim_start().to_owned()
}

/// Which samples on edges are drawn, where the sentence has no name for it and no percentages.
fn compass(found: &Diagnosis) -> Option<String> {
    let (compass, seen) = (&found.compass, found.compass.seen());
    let has_name = found.convention.ties.name(seen).is_some();
    let is_known = found.confidence != Confidence::Unexplained && compass.is_decided();
    if !seen.contains(&true) || has_name || !is_known {
        return None;
    }
    let directions = FACINGS.iter().zip(compass.edges);
    let list: Vec<_> = directions
        .filter_map(|(facing, count)| Some(format!("{facing} {:.0} %", count.percent()?)))
        .collect();
    Some(format!("samples on an edge, by the way it faces: {}", list.join(", ")))
}
