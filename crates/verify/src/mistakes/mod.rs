//! Names the mistake of a rasterizer or a line drawer that no convention explains.
//!
//! A mistake is a wrong way of drawing as a pure function, with a parameter such as the length of a word. The tables in
//! `triangles` and `lines` hold them, each with its sentence, its repair, the page that explains it and what would refute it.
//! The wrong program answers some hundred questions on which mistakes differ, and every mistake predicts the answers, for
//! each parameter and several conventions underneath. A mistake is named if it predicts at least 99 % of the wrong answers
//! and of the right ones, among answers that it was not chosen by. Otherwise the nearest one is a lead, and what all wrong
//! answers have in common is said.

mod cells;
mod common;
mod fills;
mod format;
mod formulas;
mod id;
mod lines;
mod questions;
mod scans;
mod thresholds;
mod triangles;
pub mod values;
mod weigh;

use std::borrow::Cow;
use std::cell::OnceCell;
use std::fmt;
use std::future::Future;

use crate::convention::{
    Confidence, Count, Declarations, Diagnosis, LineAsker, LineConvention, LineDiagnosis,
    LineQuestion, LineRounding, LineTie, Mask, Mirror, Quantum, RULES, Rounding, Shape, Ties,
    TriangleAsker, TriangleConvention, TriangleQuestion, Windings,
};
use crate::learn::{self, KnownWay, Learned};
pub use crate::learn::{LearnTriangles, of_triangles as learn_triangles};
use lines::{Ends, Stroke};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use triangles::{BY_WINDING, Fill, Reach};
use weigh::{LEAST_WRONG, fresh, weigh};

pub use format::Format;
#[doc(hidden)]
pub use id::MistakeId;
pub use thresholds::Threshold;
pub use weigh::{Hypothesis, chosen_by};

/// An entry of a table.
#[derive(Clone, Copy)]
/// A mistake as a pure function: `draws` says for each parameter what a program draws that makes it.
struct Mistake<D> {
    name: &'static str,
    /// What the program does, after 'it'; from the parameter.
    sentence: fn(i64) -> String,
    /// What has to be changed in the program.
    repair: &'static str,
    /// The page that explains it, without `.md`.
    page: &'static str,
    /// An observation that would refute it.
    refuted: &'static str,
    parameters: Parameters,
    /// [`Fill`] or [`Stroke`].
    draws: D,
}

/// With which parameters a mistake is tried.
#[derive(Clone, Copy)]
enum Parameters {
    /// These.
    Fixed(&'static [i64]),
    /// The same, each of which shows from so many pixels on.
    Words(&'static [i64], fn(i64) -> i64),
    /// All numbers below this one.
    Below(i64),
    /// Limits between what is drawn and what is not, read off the answers.
    Sizes,
    /// Ranges that coordinates are clamped to, as the answers have them.
    Clamps,
    /// Those ways of filling row by row that come near the answers, and of which it is true.
    Scans(fn(i64) -> bool),
    /// The directions of lines in which ties go on, as the answers have them.
    Octants,
}

/// The entry that lines and triangles share: a row or a column at the border of the window is never drawn.
const fn border<D: Copy>(draws: D) -> Mistake<D> {
    Mistake {
        name: "the border of the window",
        sentence: border_said,
        repair: "the window ends after its last pixel: compare with the width and the height, not with one less",
        page: "ch11",
        refuted: "a pixel of it that is drawn",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws,
    }
}

/// p is the side of the window.
fn border_said(p: i64) -> String {
    let which = ["first row", "last row", "first column", "last column"][p as usize];
    format!("never draws the {which} of the window")
}

/// A program whose answers are known, such as a published algorithm.
pub struct Program<'a, Q, Picture> {
    /// Its name.
    pub name: &'static str,
    /// What is wrong with it, after 'it'.
    pub about: String,
    /// What it draws; none where it has no answer.
    pub draw: Draw<'a, Q, Picture>,
}

/// What a program draws for a question.
pub type Draw<'a, Q, Picture> = Box<dyn Fn(&Q) -> Option<Picture> + 'a>;

/// A mistake that explains what is wrong, or the nearest one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Explanation {
    /// The name of the mistake, of a planted fault, or of a published algorithm.
    pub name: &'static str,
    /// What the program does, after 'it'.
    pub does: String,
    /// What repairs it; empty of programs.
    pub repair: Cow<'static, str>,
    /// The page of the book that explains it, such as `ch02-scanline`.
    pub page: &'static str,
    /// An observation that would refute it; empty of programs.
    pub refuted: &'static str,
    /// Wrong answers that it predicts, of those that it was not chosen by.
    pub wrong: Count,
    /// Right answers that it predicts, of those that it was not chosen by.
    pub right: Count,
}

impl Explanation {
    /// What is said before anything was counted.
    #[must_use]
    pub fn new(
        name: &'static str,
        does: String,
        repair: impl Into<Cow<'static, str>>,
        page: &'static str,
        refuted: &'static str,
    ) -> Self {
        let none = Count::default();
        let repair = repair.into();
        Self { name, does, repair, page, refuted, wrong: none, right: none }
    }

    /// Answers that it does not predict, wrong and right ones.
    fn missed(&self) -> usize {
        let missed = (self.wrong.of - self.wrong.drawn) + (self.right.of - self.right.drawn);
        missed as usize
    }

    /// Whether it misses one answer of a hundred at most.
    fn explains_nearly_all(&self) -> bool {
        100 * self.missed() as u64 <= self.wrong.of + self.right.of
    }

    /// A program that is known, with what is wrong with it.
    #[must_use]
    pub fn of_program(name: &'static str, about: String) -> Self {
        Self::new(name, about, "", "planted", "")
    }
}

/// What was found about a wrong program.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Mistakes {
    /// The mistakes that explain it: several where they explain the same.
    pub causes: Vec<Explanation>,
    /// The nearest one, where none explains every answer.
    pub lead: Option<Explanation>,
    /// What all wrong answers have in common, as sentences; where none explains it.
    pub common: Vec<String>,
    /// What was learned of it without the tables, where none of their mistakes explains it.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub learned: Option<Learned>,
    /// Questions whose answer was wrong, of all that were answered.
    pub wrong: Count,
    /// From which size, slope or position on it is wrong, where there is such a limit.
    pub limits: Vec<Threshold>,
}

impl Mistakes {
    /// Whether a mistake is named, or what it does was learned.
    #[must_use]
    pub fn is_known(&self) -> bool {
        !self.causes.is_empty() || self.is_learned()
    }

    fn is_learned(&self) -> bool {
        self.certain().is_some()
    }

    /// What was learned, where it is a certain cause.
    fn certain(&self) -> Option<&Learned> {
        self.learned.as_ref().filter(|learned| learned.is_certain)
    }

    /// How much of the answers a mistake explains, after 'this explains'.
    fn share(explained: &Explanation) -> String {
        let Explanation { wrong, right, .. } = explained;
        let contradicted = right.of - right.drawn;
        format!(
            "{} of {} wrong answers and contradicts {contradicted} of {} right ones",
            wrong.drawn, wrong.of, right.of
        )
    }

    /// What the program does, after 'it': the first mistake that explains it, or what was learned.
    #[must_use]
    pub fn does(&self) -> Option<String> {
        match self.causes.first() {
            Some(cause) => Some(cause.does.clone()),
            None => self.certain()?.in_short(),
        }
    }

    /// What was learned, after 'it', where it is no certain cause and still predicts most new answers, wrong and right ones.
    #[must_use]
    pub fn mostly_does(&self) -> Option<String> {
        let learned = self.learned.as_ref()?;
        if learned.is_certain || !learned.predicts_most() {
            return None;
        }
        learned.in_short()
    }

    /// With what is learned where no mistake of the tables explains every answer. What was learned and predicts every answer is the
    /// cause, and not a mistake that misses some.
    async fn or_learned(self, learn: impl Future<Output = Option<Learned>>) -> Self {
        if self.causes.iter().any(|cause| cause.missed() == 0) {
            return self;
        }
        let learned = learn.await;
        if self.causes.is_empty() {
            return self.with_learned(learned);
        }
        // What comes on top of another convention is no simpler than the mistake.
        match learned {
            Some(learned) if learned.is_certain && !learned.is_beyond => {
                // The repair of the mistake is what mends the program all the same.
                let lead = self.causes.first().cloned();
                Self { causes: Vec::new(), lead, learned: Some(learned), ..self }
            }
            _ => self,
        }
    }

    /// With what was learned.
    #[must_use]
    pub fn with_learned(self, learned: Option<Learned>) -> Self {
        Self { learned, ..self }
    }

    /// What is said of it: a sentence each. The first one says what the program does, or that this is not known.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        match self.is_known() {
            true => self.sentences_of_causes(),
            false => self.sentences_of_unknown(),
        }
    }

    /// What the causes do, how they are repaired, and what they explain.
    fn sentences_of_causes(&self) -> Vec<String> {
        let mut said = Vec::new();
        // The first causes of the tables, of which each explains the same.
        for (i, cause) in self.causes.iter().take(MOST_SAID).enumerate() {
            let it = if i == 0 { "It" } else { "Or it" };
            said.push(format!("{it} {}.", cause.does));
            if !cause.repair.is_empty() {
                said.push(format!("Repair: {}.", cause.repair));
            }
            said.push(format!("This explains {}.", Self::share(cause)));
        }
        // What was learned, beside the nearest mistake of the tables.
        if let Some(learned) = self.certain() {
            said.extend(learned.sentences());
            match &self.lead {
                Some(lead) if lead.explains_nearly_all() && !lead.repair.is_empty() => {
                    said.push(format!("The nearest known mistake is that it {}.", lead.does));
                    said.push(format!("Its repair: {}.", lead.repair));
                }
                _ => {}
            }
        }
        match self.causes.len().saturating_sub(MOST_SAID) {
            0 => {}
            1 => said.push("One other cause explains the same.".to_owned()),
            more => said.push(format!("{more} other causes explain the same.")),
        }
        self.add_limits(&mut said);
        said
    }

    /// What is known all the same: limits, what wrong answers have in common, and the nearest mistake.
    fn sentences_of_unknown(&self) -> Vec<String> {
        // How many are wrong comes first, as no cause can be said.
        let Count { drawn, of } = self.wrong;
        let mut said = vec![match drawn {
            0 => format!("None of {of} answers is wrong, but other ones are."),
            _ => {
                format!("{drawn} of {of} answers are wrong, and no known mistake explains them.")
            }
        }];
        self.add_limits(&mut said);
        said.extend_from_slice(&self.common);
        if let Some(learned) = &self.learned {
            said.extend(learned.sentences());
        }
        if let Some(lead) = &self.lead {
            let explained = Self::share(lead);
            said.push(format!("The nearest is that it {}: this explains {explained}.", lead.does));
        }
        said
    }

    /// A sentence for each limit.
    fn add_limits(&self, said: &mut Vec<String>) {
        for limit in &self.limits {
            said.push(limit.to_string());
        }
    }
}

/// Causes that are said, where several explain the same.
const MOST_SAID: usize = 2;

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentences().join(" "))
    }
}

/// Wrong answers that are enough, and how often a program is asked for more of them.
pub const ENOUGH_WRONG: usize = 24;
const MOST_ROUNDS: u64 = 6;
/// Lines that are asked at once, so that a slow program can be left in time.
const AT_ONCE: usize = 100;
/// The questions are the same in every run.
/// The first round; each further one has the next seed.
const SEED: u64 = 1;

/// A question with its answer.
struct AnsweredQuestion<Q> {
    /// What was asked.
    question: Q,
    drawn: Mask,
    /// Pixels that were hit more than once; none where that cannot be seen.
    twice: Mask,
    /// What should have been drawn.
    right: Mask,
}

impl<Q> AnsweredQuestion<Q> {
    /// Nothing is drawn: where all is blank, every mistake that draws nothing explains it.
    fn is_blank(&self) -> bool {
        self.drawn.is_empty()
    }

    /// Whether something else was drawn than what is right, or a pixel more than once.
    fn is_wrong(&self) -> bool {
        !self.is(self.right, Mask::default())
    }

    /// Whether these pixels were drawn, and these of them more than once.
    fn is(&self, drawn: Mask, twice: Mask) -> bool {
        self.drawn == drawn && self.twice == twice
    }

    /// Whether a convention draws it, which may say nothing.
    fn is_as(&self, convention: Option<Mask>) -> bool {
        convention.is_none_or(|mask| self.is(mask, Mask::default()))
    }
}

impl AnsweredQuestion<TriangleQuestion> {
    /// A pixel that is drawn wrongly and one that is missing within every box around the corners, and whether they are drawn: a
    /// mistake that predicts one of them otherwise does not predict the answer.
    fn telling(&self) -> [Option<([i32; 2], bool)>; 2] {
        let wrong = self.drawn.differs(&self.right);
        let extra = wrong.shared(&self.drawn);
        let mut missing = wrong.shared(&self.right);
        for bounds in fills::boxes(&self.question.corners) {
            missing.clip(bounds);
        }
        [(extra, true), (missing, false)].map_array(|(mask, is_in)| Some((mask.first()?, is_in)))
    }

    /// Whether a mistake predicts it: what is hit twice where only that is wrong, and otherwise hit twice or not. Many programs
    /// test the samples of a box around the corners, and no others.
    fn may_be(&self, drawn: Mask, twice: Mask, draws: Fill) -> bool {
        self.is(drawn, twice) || !matches!(draws, Fill::Twice(_)) && self.may_be_once(drawn)
    }

    /// The same of what hits no pixel twice.
    fn may_be_once(&self, drawn: Mask) -> bool {
        let once = Mask::default();
        if self.is(drawn, once) {
            return true;
        }
        // The boxes take pixels away, so that none may be missing before.
        if self.drawn.beyond(&drawn) > 0 {
            return false;
        }
        for bounds in fills::boxes(&self.question.corners) {
            let mut within = drawn;
            within.clip(bounds);
            if self.is(within, once) {
                return true;
            }
        }
        false
    }
}

/// Asks a rasterizer of triangles that is wrong, and looks for its mistake. `found` is what its convention seems to be:
/// where that is certain, answers are judged by it. Nothing where all answers are right. It asks for 1,200 triangles, and for
/// more where few of these are wrong. Who gives no more answers ends it. Where no known mistake explains it, `learn` may ask on:
/// [`learn_triangles`], or nothing.
pub async fn of_triangles(
    asker: &TriangleAsker,
    known: &Declarations,
    found: Option<&Diagnosis>,
    programs: &[Program<'_, TriangleQuestion, Coverage>],
    learn: Option<LearnTriangles>,
) -> Option<Mistakes> {
    // A convention that is certain is what the program means to do, and answers are judged by it.
    let is_certain = found.is_some_and(|f| f.confidence == Confidence::Certain);
    let found = found.map(|f| &f.convention).filter(|c| c.draws != Windings::Neither);
    let expected = found.filter(|_| is_certain).unwrap_or(&known.declared);
    let mut asked = AskedTriangles { asker, known, expected, answered: Vec::new(), given: 0 };
    // Where few answers are wrong, some more are needed.
    for seed in SEED..SEED + MOST_ROUNDS {
        asked.ask(&questions::triangles(known, sample_of(expected), seed)).await;
        let wrong = count_wrong(&asked.answered);
        if wrong == 0 || wrong >= ENOUGH_WRONG {
            break;
        }
    }
    if asked.answered.iter().all(AnsweredQuestion::is_blank) {
        return draws_nothing(&asked.answered, asked.given);
    }
    // Width, height and area are told apart near the limits between what is drawn and what is not.
    let sizes = limits(&asked.answered);
    asked.ask(&thresholds::near(&sizes, known, expected)).await;
    let mut answered = asked.answered;
    let found_bases = bases(&known.declared, found);
    // In a tiny window a convention may not have been found, and explain what is wrong.
    let is_one = |base: &&Base| base.convention != *expected && base.explains(&answered);
    if let Some(base) = found_bases.iter().find(is_one) {
        let words = base.said.as_ref().map_or_else(String::new, |said| said.concat());
        let said = format!("As far as these answers tell, it {words}: this is a convention.");
        let wrong = Count { drawn: count_wrong(&answered) as u64, of: answered.len() as u64 };
        return Some(Mistakes { wrong, common: vec![said], ..Mistakes::default() });
    }
    // Limits are asked for beside the mistakes, since they may be all that is wrong.
    let limits = thresholds::of_triangles(asker, known, expected).await;
    let draws_twice = answered.iter().any(|a| !a.twice.is_empty());
    let (mut why, nearest) = explain(&answered, &found_bases, programs);
    if draws_twice && why.as_ref().is_some_and(|why| !why.is_known()) {
        // Pixels may be drawn twice beside another mistake.
        for answer in &mut answered {
            answer.twice = Mask::default();
        }
        let once = explain(&answered, &found_bases, programs).0;
        if let Some(once) = once.filter(Mistakes::is_known) {
            let mut causes = once.causes;
            for cause in &mut causes {
                cause.does += " (that it draws pixels more than once is left aside)";
            }
            why = why.map(|why| Mistakes { causes, lead: None, common: Vec::new(), ..why });
        }
    }
    let why = with_limits(why, answered.len(), limits);
    // What no table has is learned, with the nearest mistakes as parts that may be known.
    let mut starts = learn::starts(&known.declared, expected, found);
    // A convention by which hardly any answer is right is seldom the one that the program is wrong beside.
    let missed = |start: &learn::Start<'_, TriangleConvention>| {
        let is_missed = |a: &&AnsweredQuestion<TriangleQuestion>| {
            let right = start.convention.mask(&a.question.corners, a.question.window);
            right.is_none_or(|right| right != a.drawn)
        };
        answered.iter().filter(is_missed).count()
    };
    if 100 * count_wrong(&answered) > MOST_MISSED_PERCENT * answered.len() {
        starts.sort_by_cached_key(missed);
    }
    let ways: Vec<_> = nearest.iter().map(|near| near.way(&found_bases, draws_twice)).collect();
    let learned = async { learn?(asker, known, &starts, &ways).await };
    or_learned(why, answered.len(), learned).await
}

/// A convention that misses more than so many percent of the answers is not the first that something is learned beside.
const MOST_MISSED_PERCENT: usize = 75;

/// What a rasterizer was asked, and what it drew.
struct AskedTriangles<'a> {
    asker: &'a TriangleAsker,
    known: &'a Declarations,
    /// What answers are judged by.
    expected: &'a TriangleConvention,
    answered: Vec<AnsweredQuestion<TriangleQuestion>>,
    /// Questions that had an answer.
    given: u64,
}

impl AskedTriangles<'_> {
    /// Asks more, but for what the convention says nothing of.
    async fn ask(&mut self, questions: &[TriangleQuestion]) {
        for (question, answer) in questions.iter().zip(self.asker.ask(questions).await) {
            let right = self.expected.mask(&question.corners, question.window);
            let Some(right) = right else { continue };
            // What is not answered is not drawn.
            let (mut drawn, mut twice) = (Mask::default(), Mask::default());
            if let Some(picture) = answer.filter(|picture| picture.bounds() == question.window) {
                self.given += 1;
                drawn = Mask::of(&picture, 1);
                if !self.known.mask {
                    twice = Mask::of(&picture, 2);
                }
            }
            self.answered.push(AnsweredQuestion { question: *question, drawn, twice, right });
        }
    }
}

/// How many answers are wrong.
fn count_wrong<Q>(answered: &[AnsweredQuestion<Q>]) -> usize {
    let mut wrong = 0;
    for answer in answered {
        wrong += usize::from(answer.is_wrong());
    }
    wrong
}

/// What was learned where no mistake explains it, also where none of so many answers is wrong: others are.
async fn or_learned(
    found: Option<Mistakes>,
    answers: usize,
    learn: impl Future<Output = Option<Learned>>,
) -> Option<Mistakes> {
    let is_found = found.is_some();
    let wrong = Count { drawn: 0, of: answers as u64 };
    let why = found.unwrap_or(Mistakes { wrong, ..Mistakes::default() }).or_learned(learn).await;
    (is_found || why.learned.is_some()).then_some(why)
}

/// A mistake of a table with its parameter, and the convention underneath.
#[derive(Clone, Copy)]
struct Variant<D: 'static, C> {
    /// The entry of the table.
    mistake: &'static Mistake<D>,
    p: i64,
    base: C,
}

impl Variant<Fill, usize> {
    /// As a way to draw that other mistakes may stand beside; of a program that never draws a pixel twice, without that.
    fn way(self, bases: &[Base], draws_twice: bool) -> KnownWay<'_, TriangleQuestion> {
        let Self { mistake, p, base } = self;
        let Explanation { mut does, repair, .. } = says(mistake, p);
        let base = &bases[base];
        does += &base.words(mistake.draws);
        let draw = move |q: &TriangleQuestion| {
            let whole = || base.convention.mask(&q.corners, q.window);
            let [drawn, twice] =
                fill(mistake.draws, p, &base.convention, &q.corners, q.window, &whole)?;
            // What hits pixels twice says nothing of a program in which none is hit twice.
            let is_seen = draws_twice || matches!(mistake.draws, Fill::Twice(_));
            Some([drawn, if is_seen { twice } else { Mask::default() }])
        };
        KnownWay { does, repair, draw: Box::new(draw) }
    }
}

impl Variant<Stroke, LineConvention> {
    fn mask(&self, ends: Ends, window: PixelRect) -> Option<Mask> {
        let Self { mistake, p, base } = self;
        Some(match mistake.draws {
            // All lines that are drawn in place of it, by the convention underneath.
            Stroke::Instead(others) => {
                let mut all = Mask::default();
                for other in others(ends, window, *p) {
                    all.add(&lines::of_convention(base, other, window)?);
                }
                all
            }
            Stroke::Own(pixels) => lines::mask(&pixels(ends, window, *p), window),
            Stroke::Changed(change) => {
                let mut mask = lines::of_convention(base, ends, window)?;
                change(&mut mask, ends, window, *p);
                mask
            }
        })
    }

    fn says(&self, expected: &LineConvention) -> Explanation {
        let mut says = says(self.mistake, self.p);
        if self.base != *expected {
            says.does += &format!(" (apart from that it {})", self.base.words());
        }
        says
    }

    /// As a way to draw that other mistakes may stand beside.
    fn way(self, expected: &LineConvention) -> KnownWay<'static, LineQuestion> {
        let Explanation { does, repair, .. } = self.says(expected);
        let draw = move |q: &LineQuestion| {
            let ends = wide(q.ends);
            let mask = lines::is_walked(ends).then(|| self.mask(ends, q.window))??;
            Some([mask, Mask::default()])
        };
        KnownWay { does, repair, draw: Box::new(draw) }
    }
}

/// The ends of a line in 64 bits, in which differences do not overflow.
fn wide(ends: [[i32; 2]; 2]) -> Ends {
    ends.map_array(|end| end.map_array(i64::from))
}

/// The mistake that explains answers about triangles; where there is none, those that come nearest.
fn explain(
    answered: &[AnsweredQuestion<TriangleQuestion>],
    bases: &[Base],
    programs: &[Program<'_, TriangleQuestion, Coverage>],
) -> (Option<Mistakes>, Vec<Variant<Fill, usize>>) {
    let is_wrong = are_wrong(answered);
    if !is_wrong.contains(&true) {
        return (None, Vec::new());
    }
    // Each mistake is tried with each parameter, on top of each base that it needs.
    let drawn = &DrawnByBases::new(answered, bases);
    let telling = &answered.iter().map(AnsweredQuestion::telling).collect::<Vec<_>>();
    let (mut hypotheses, mut variants) = (Vec::new(), Vec::new());
    let choice = Choice::new(answered, &is_wrong, &bases[0].convention);
    for mistake in triangles::TABLE {
        for p in choice.parameters(mistake.parameters) {
            let says = says(mistake, p);
            for (number, base) in bases.iter().enumerate() {
                if !base.is_tried_with(mistake) {
                    continue;
                }
                let predicts = move |i: usize| {
                    // A pixel that tells is computed before the whole picture, which most mistakes need not draw then.
                    for &(at, is_in) in telling[i].iter().flatten() {
                        let TriangleQuestion { corners, window } = &answered[i].question;
                        let alone = pixel(mistake.draws, p, &base.convention, corners, *window, at);
                        if alone == Some(!is_in) {
                            return false;
                        }
                    }
                    let TriangleQuestion { corners, window } = &answered[i].question;
                    let whole = || drawn.mask(number, i);
                    match fill(mistake.draws, p, &base.convention, corners, *window, &whole) {
                        Some([drawn, twice]) => answered[i].may_be(drawn, twice, mistake.draws),
                        None => true,
                    }
                };
                let mut says = says.clone();
                says.does += &base.words(mistake.draws);
                let predicts = weigh::remembered(predicts);
                hypotheses.push(Hypothesis { predicts, says });
                variants.push(Variant { mistake, p, base: number });
            }
        }
    }
    for program in programs {
        hypotheses.push(
            program.hypothesis(answered, |_, picture| [Mask::of(picture, 1), Mask::of(picture, 2)]),
        );
    }
    let seen = || answered.iter().map(common::AnswerTraits::triangle).collect();
    // Answers in which no coordinate is large: there no word overflows.
    let mut near = Vec::new();
    for (i, answer) in answered.iter().enumerate() {
        let farthest = fills::metric(&answer.question.corners, fills::FARTHEST);
        if farthest <= i64::from(NEAR_PX) * 256 {
            near.push(i);
        }
    }
    let alone = |among: &[usize]| drawn.least_missed(among);
    let why = conclude(&hypotheses, &is_wrong, &near, &alone, &seen);
    if why.as_ref().is_some_and(Mistakes::is_known) {
        return (why, Vec::new());
    }
    // A part of what a program does is looked for under its own convention alone.
    let may_be = |i: usize| match variants.get(i) {
        Some(variant) => bases[variant.base].said.is_none() || bases[variant.base].is_found(),
        None => false,
    };
    let shows = |i: usize| !answered[i].is_blank();
    let nearest = weigh::nearest(&hypotheses, &is_wrong, &shows, &may_be);
    (why, nearest.into_iter().map(|i| variants[i]).collect())
}

/// The pictures that bases draw, each of which is computed when it is needed first.
struct DrawnByBases<'a> {
    answered: &'a [AnsweredQuestion<TriangleQuestion>],
    bases: &'a [Base],
    /// Those of the first base, of the second and so on.
    masks: Vec<OnceCell<Option<Mask>>>,
}

impl<'a> DrawnByBases<'a> {
    fn new(answered: &'a [AnsweredQuestion<TriangleQuestion>], bases: &'a [Base]) -> Self {
        let masks = vec![OnceCell::new(); bases.len() * answered.len()];
        Self { answered, bases, masks }
    }

    fn mask(&self, base: usize, i: usize) -> Option<Mask> {
        let at = base * self.answered.len() + i;
        *self.masks[at].get_or_init(|| self.bases[base].mask(&self.answered[i]))
    }

    /// How many of some answers the best convention misses, without a mistake.
    fn least_missed(&self, among: &[usize]) -> usize {
        let mut least = usize::MAX;
        for (number, base) in self.bases.iter().enumerate() {
            if base.said.is_none() {
                continue;
            }
            let mut missed = 0;
            for &i in among {
                // What a mistake is forgiven is forgiven here, too: that only the samples of a box are tested.
                if self.mask(number, i).is_some_and(|mask| !self.answered[i].may_be_once(mask)) {
                    missed += 1;
                }
            }
            least = least.min(missed);
        }
        least
    }
}

/// The parameters with which mistakes are tried, as answers have them.
struct Choice<'a> {
    answered: &'a [AnsweredQuestion<TriangleQuestion>],
    is_wrong: &'a [bool],
    declared: &'a TriangleConvention,
    /// The farthest coordinate of all.
    farthest_px: i64,
    /// Ways of filling row by row, once a mistake needs them.
    scans: OnceCell<Vec<i64>>,
}

impl<'a> Choice<'a> {
    fn new(
        answered: &'a [AnsweredQuestion<TriangleQuestion>],
        is_wrong: &'a [bool],
        declared: &'a TriangleConvention,
    ) -> Self {
        let mut farthest = 0;
        for answer in answered {
            farthest = farthest.max(fills::metric(&answer.question.corners, fills::FARTHEST));
        }
        let farthest_px = farthest / 256 + 1;
        Self { answered, is_wrong, declared, farthest_px, scans: OnceCell::new() }
    }

    /// What is read off answers is read off those by which hypotheses are chosen.
    fn parameters(&self, of: Parameters) -> Vec<i64> {
        match of {
            Parameters::Sizes => limits(self.answered),
            Parameters::Clamps => triangles::clamps(&clamped(self.answered)),
            // What no answer can show is no cause.
            Parameters::Words(all, from_px) => {
                all.iter().copied().filter(|p| from_px(*p) <= self.farthest_px).collect()
            }
            Parameters::Scans(is_one) => {
                let all = self.scans.get_or_init(|| {
                    scans::fitting(&near(self.answered, self.is_wrong, self.declared))
                });
                all.iter().copied().filter(|p| is_one(*p)).collect()
            }
            others => numbers(others),
        }
    }
}

/// Of each answer whether it is wrong.
fn are_wrong<Q>(answered: &[AnsweredQuestion<Q>]) -> Vec<bool> {
    answered.iter().map(AnsweredQuestion::is_wrong).collect()
}

/// The name of the cause where no answer has a pixel.
pub const NOTHING: &str = "nothing";

/// What is said where no answer has a pixel: every mistake that draws nothing would explain it. Nothing where no answer was given.
fn draws_nothing<Q>(answered: &[AnsweredQuestion<Q>], given: u64) -> Option<Mistakes> {
    let wrong = count_wrong(answered) as u64;
    if given == 0 || wrong == 0 {
        return None;
    }
    let of = answered.len() as u64;
    // Right answers without a pixel are as the program draws them, too.
    let said = Explanation::new(
        NOTHING,
        "draws nothing".to_owned(),
        "set the pixels whose samples are inside",
        "judge",
        "an answer with a pixel",
    );
    let right = of - wrong;
    let cause = Explanation {
        wrong: Count { drawn: wrong, of: wrong },
        right: Count { drawn: right, of: right },
        ..said
    };
    Some(Mistakes { causes: vec![cause], wrong: Count { drawn: wrong, of }, ..Mistakes::default() })
}

/// The same for a line drawer: it asks for 700 lines of at most 40,000 steps.
pub async fn of_lines(
    asker: &LineAsker,
    known: &Declarations,
    found: Option<&LineDiagnosis>,
    programs: &[Program<'_, LineQuestion, Vec<[i32; 2]>>],
) -> Option<Mistakes> {
    let mut answered: Vec<AnsweredQuestion<LineQuestion>> = Vec::new();
    let default = LineConvention::default();
    let is_certain = found.is_some_and(|f| f.confidence == Confidence::Certain);
    let found = found.map(|f| &f.convention);
    let expected = found.filter(|_| is_certain).unwrap_or(&default);
    let mut given = 0;
    // Where few answers are wrong, some more are needed.
    'rounds: for seed in SEED..SEED + MOST_ROUNDS {
        for questions in questions::lines(known, seed).chunks(AT_ONCE) {
            let wrong = count_wrong(&answered);
            let is_settled = wrong == 0 || wrong >= ENOUGH_WRONG;
            if answered.len() >= questions::LINES && is_settled {
                break 'rounds;
            }
            let answers = asker.ask(questions).await;
            for (question, answer) in questions.iter().zip(answers) {
                let ends = wide(question.ends);
                let right = lines::of_convention(expected, ends, question.window);
                let Some(right) = right.filter(|_| lines::is_walked(ends)) else { continue };
                given += u64::from(answer.is_some());
                let [drawn, twice] = drawn_pixels(question, &answer.unwrap_or_default());
                answered.push(AnsweredQuestion { question: *question, drawn, twice, right });
            }
        }
    }
    if answered.iter().all(AnsweredQuestion::is_blank) {
        return draws_nothing(&answered, given);
    }
    let is_wrong = are_wrong(&answered);
    // Mistakes are tried on what is expected, on what was found, and on each rule for ties.
    let mut bases = vec![*expected];
    bases.extend(found.filter(|found| *found != expected));
    for tie in LineTie::ALL {
        let base = LineConvention { rounding: LineRounding::Nearest(tie), ..default };
        if !bases.contains(&base) {
            bases.push(base);
        }
    }
    let (mut hypotheses, mut variants) = (Vec::new(), Vec::new());
    for mistake in lines::TABLE {
        let parameters = match mistake.parameters {
            Parameters::Octants => vec![octants(&answered, &is_wrong)],
            others => numbers(others),
        };
        // What has its own pixels needs no convention underneath.
        let bases = if matches!(mistake.draws, Stroke::Own(_)) { &bases[..1] } else { &bases };
        for p in parameters {
            for &base in bases {
                let variant = Variant { mistake, p, base };
                let answered = &answered;
                let predicts = move |i: usize| {
                    let question = &answered[i].question;
                    let mask = variant.mask(wide(question.ends), question.window);
                    mask.is_none_or(|mask| mask == answered[i].drawn)
                };
                let says = variant.says(expected);
                let predicts = weigh::remembered(predicts);
                hypotheses.push(Hypothesis { predicts, says });
                variants.push(variant);
            }
        }
    }
    for program in programs {
        hypotheses.push(program.hypothesis(&answered, |q, pixels| drawn_pixels(q, pixels)));
    }
    let seen = || answered.iter().map(common::AnswerTraits::line).collect();
    let mut near = Vec::new();
    for (i, answer) in answered.iter().enumerate() {
        if answer.question.ends.as_flattened().iter().all(|v| v.abs() <= NEAR_PX) {
            near.push(i);
        }
    }
    let why = conclude(&hypotheses, &is_wrong, &near, &|_| usize::MAX, &seen);
    let mut nearest = Vec::new();
    if !why.as_ref().is_some_and(Mistakes::is_known) {
        // A part of what a program does is looked for under its own convention alone.
        let may_be = |i: usize| match variants.get(i) {
            Some(Variant { base, .. }) => base == expected || Some(base) == found,
            None => false,
        };
        let shows = |i: usize| !answered[i].is_blank();
        nearest = weigh::nearest(&hypotheses, &is_wrong, &shows, &may_be);
    }
    let limits = thresholds::of_lines(asker, known, expected).await;
    let why = with_limits(why, is_wrong.len(), limits);
    let starts = learn::starts(&default, expected, found);
    let ways: Vec<_> = nearest.into_iter().map(|i| variants[i].way(expected)).collect();
    or_learned(why, is_wrong.len(), learn::of_lines(asker, known, &starts, &ways)).await
}

/// What a line drawer drew; pixels that come twice are not told from others.
fn drawn_pixels(question: &LineQuestion, pixels: &[[i32; 2]]) -> [Mask; 2] {
    [lines::mask(&lines::widened(pixels), question.window), Mask::default()]
}

/// The octants in which ties go on, as the answers have it by which hypotheses are chosen.
fn octants(answered: &[AnsweredQuestion<LineQuestion>], is_wrong: &[bool]) -> i64 {
    let mut chosen = chosen_by(is_wrong).into_iter().map(|i| {
        let AnsweredQuestion { question, drawn, .. } = &answered[i];
        (wide(question.ends), question.window, drawn)
    });
    lines::octants(&mut chosen)
}

impl<Q, Picture> Program<'_, Q, Picture> {
    /// That the answers are those of this program. `masks` are the pixels of its picture, and those that it hits more than
    /// once.
    fn hypothesis<'a>(
        &'a self,
        answered: &'a [AnsweredQuestion<Q>],
        masks: impl Fn(&Q, &Picture) -> [Mask; 2] + 'a,
    ) -> Hypothesis<'a> {
        let predicts = move |i: usize| {
            // A program that gives no answer predicts none.
            let AnsweredQuestion { question, .. } = &answered[i];
            (self.draw)(question).is_some_and(|picture| {
                let [drawn, twice] = masks(question, &picture);
                answered[i].is(drawn, twice)
            })
        };
        let says = Explanation::of_program(self.name, self.about.clone());
        Hypothesis { predicts: weigh::remembered(predicts), says }
    }
}

/// The parameters that do not depend on answers.
fn numbers(parameters: Parameters) -> Vec<i64> {
    match parameters {
        Parameters::Fixed(parameters) | Parameters::Words(parameters, _) => parameters.to_vec(),
        Parameters::Below(end) => (0..end).collect(),
        Parameters::Sizes | Parameters::Clamps | Parameters::Scans(_) | Parameters::Octants => {
            Vec::new()
        }
    }
}

/// What a mistake says with a parameter, before anything was counted.
fn says<D>(mistake: &Mistake<D>, p: i64) -> Explanation {
    let Mistake { name, sentence, repair, page, refuted, .. } = *mistake;
    Explanation::new(name, sentence(p), repair, page, refuted)
}

/// Weighs hypotheses about answers of any kind. `is_wrong` says of each answer whether it is; nothing where none is.
#[must_use]
pub fn of_answers(hypotheses: Vec<Hypothesis<'_>>, is_wrong: &[bool]) -> Option<Mistakes> {
    conclude(&hypotheses, is_wrong, &[], &|_| usize::MAX, &Vec::new)
}

/// `near` are the answers of which it is known that numbers cannot have been too large; `alone` says how many of some answers
/// the best convention misses without a mistake.
fn conclude(
    hypotheses: &[Hypothesis<'_>],
    is_wrong: &[bool],
    near: &[usize],
    alone: &dyn Fn(&[usize]) -> usize,
    seen: &dyn Fn() -> Vec<common::AnswerTraits>,
) -> Option<Mistakes> {
    let wrong = is_wrong.iter().filter(|wrong| **wrong).count();
    if wrong == 0 {
        return None;
    }
    // Beside a convention that explains nearly as much, a mistake that seldom shows itself would be named.
    let needed = |among: &[usize]| {
        let (mut causes, lead) = weigh(hypotheses, is_wrong, among);
        if !causes.is_empty() {
            let alone = alone(&fresh(is_wrong, among));
            causes.retain(|cause| 2 * cause.missed() < alone);
        }
        (causes, lead)
    };
    let all: Vec<usize> = (0..is_wrong.len()).collect();
    let (mut causes, lead) = needed(&all);
    if causes.is_empty() {
        // A mistake may be there beside another one that large numbers show.
        causes = needed(near).0;
        for cause in &mut causes {
            cause.does += &format!(
                " (seen where all coordinates are below {NEAR_PX} px; beyond, more goes wrong)"
            );
        }
    }
    let common = if causes.is_empty() { common::sentences(&seen()) } else { Vec::new() };
    // A lead that explains little leads nowhere.
    // Half of the wrong answers, and nearly all right ones.
    let leads = |weight: &Explanation| {
        2 * weight.wrong.drawn >= weight.wrong.of && 10 * weight.right.drawn >= 9 * weight.right.of
    };
    let lead = lead.filter(|lead| causes.is_empty() && leads(lead) && wrong >= LEAST_WRONG);
    Some(Mistakes {
        causes,
        lead,
        common,
        learned: None,
        limits: Vec::new(),
        wrong: Count { drawn: wrong as u64, of: is_wrong.len() as u64 },
    })
}

/// Coordinates, in pixels, that words of 16 bits hold with 8 bits below the pixel.
const NEAR_PX: i32 = 127;

/// Limits may be found where all other answers are right.
fn with_limits(
    found: Option<Mistakes>,
    answers: usize,
    limits: Vec<Threshold>,
) -> Option<Mistakes> {
    if let Some(found) = found {
        return Some(Mistakes { limits, ..found });
    }
    if limits.is_empty() {
        return None;
    }
    let wrong = Count { drawn: 0, of: answers as u64 };
    // A limit of a place in the window is a cause by itself.
    let causes = limits.iter().filter_map(Threshold::as_cause).collect();
    Some(Mistakes { wrong, causes, limits, ..Mistakes::default() })
}

/// Where a sample lies in its pixel, in subpixels.
fn sample_of(convention: &TriangleConvention) -> [i32; 2] {
    match convention.shape {
        Shape::Point { x, y } => [x, y],
        _ => [128, 128],
    }
}

/// The picture of a mistake, and the pixels that it draws more than once; none where it says nothing.
fn fill(
    draws: Fill,
    p: i64,
    base: &TriangleConvention,
    corners: &Corners,
    window: PixelRect,
    whole: &dyn Fn() -> Option<Mask>,
) -> Option<[Mask; 2]> {
    let mut twice = Mask::default();
    let drawn = match draws {
        // Pixels that more than one of them has are drawn more than once.
        Fill::Instead(others) => {
            let mut all = Mask::default();
            for other in others(corners, window, p) {
                let part = base.mask(&other, window)?;
                twice.add(&all.shared(&part));
                all.add(&part);
            }
            all
        }
        Fill::Changed(change) => {
            let mut mask = whole()?;
            change(&mut mask, corners, window, p);
            mask
        }
        Fill::Twice(of) => {
            let mask = whole()?;
            twice = of(&mask, corners, window, p);
            mask
        }
        Fill::Ruled(_, draw) | Fill::Sampled(_, draw) => {
            // Corners reach their grid first.
            draw(&base.quantum.snap(corners), window, base, p)
        }
        Fill::Own(draw) if is_faced(base, corners) => draw(corners, window, p),
        Fill::Own(_) => Mask::default(),
    };
    Some([drawn, twice])
}

/// Whether a mistake draws a pixel, where that is known without the rest of the picture.
fn pixel(
    draws: Fill,
    p: i64,
    base: &TriangleConvention,
    corners: &Corners,
    window: PixelRect,
    [x, y]: [i32; 2],
) -> Option<bool> {
    // Only what depends on nothing but the pixel can be computed for it alone.
    // A mirror reflects the whole window.
    if base.mirror != Mirror::None {
        return None;
    }
    let alone = PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 };
    match draws {
        Fill::Instead(others) => {
            let mut is_drawn = false;
            for other in others(corners, window, p) {
                is_drawn |= base.mask(&other, alone)?.has(x, y);
            }
            Some(is_drawn)
        }
        Fill::Ruled(Reach::Pixel, _) | Fill::Sampled(Reach::Pixel, _) => {
            let [drawn, _] = fill(draws, p, base, corners, alone, &|| None)?;
            Some(drawn.has(x, y))
        }
        _ => None,
    }
}

/// Whether a convention draws triangles that turn like this one; those without area are drawn where both windings are.
fn is_faced(convention: &TriangleConvention, corners: &Corners) -> bool {
    match twice_area(corners) {
        0 => convention.draws == Windings::Both,
        area => convention.draws.draws(area > 0),
    }
}

/// Where samples may lie in a pixel, in subpixels, and how that is said.
const SAMPLES: [([i32; 2], &str); 4] = [
    ([128, 128], "samples at centres"),
    ([0, 0], "samples at upper left corners"),
    ([128, 0], "samples in the middle of upper sides"),
    ([0, 128], "samples in the middle of left sides"),
];

/// A convention that mistakes are combined with.
struct Base {
    convention: TriangleConvention,
    /// Where its samples lie, and its rule: what is said of it. Nothing of the declared one.
    said: Option<[String; 2]>,
    /// Whether it is the first with its place of the sample.
    is_first: bool,
}

impl Base {
    fn mask(&self, a: &AnsweredQuestion<TriangleQuestion>) -> Option<Mask> {
        self.convention.mask(&a.question.corners, a.question.window)
    }

    /// Whether it explains all answers, of which some are wrong.
    fn explains(&self, answered: &[AnsweredQuestion<TriangleQuestion>]) -> bool {
        answered.iter().any(AnsweredQuestion::is_wrong)
            && answered.iter().all(|a| a.is_as(self.mask(a)))
    }

    /// Whether a mistake needs it: one with a rule of its own needs each place once, another one may need none.
    fn serves(&self, draws: Fill) -> bool {
        match draws {
            Fill::Own(_) => self.said.is_none(),
            Fill::Sampled(..) => self.is_first,
            _ => true,
        }
    }

    /// Whether it was found, and is not one of those that are tried of every program.
    fn is_found(&self) -> bool {
        self.said.as_ref().is_some_and(|[_, rule]| rule.is_empty())
    }

    /// Whether the mistake is tried on top of it.
    fn is_tried_with(&self, mistake: &Mistake<Fill>) -> bool {
        // Of a program that draws one winding, a rule for each of both is a rule.
        let is_told = mistake.name != BY_WINDING || self.convention.draws == Windings::Both;
        // Clamps are many, so that fewer bases have to do.
        let is_many = matches!(mistake.parameters, Parameters::Clamps);
        is_told && self.serves(mistake.draws) && (!is_many || self.is_first || self.is_found())
    }

    fn words(&self, draws: Fill) -> String {
        match (&self.said, draws) {
            (Some([place, _]), Fill::Sampled(..)) => format!(" (apart from that it {place})"),
            (Some([place, rule]), _) => format!(" (apart from that it {place}{rule})"),
            (None, _) => String::new(),
        }
    }
}

/// What is declared, what was found, and the rules with a name for several places of the sample.
fn bases(declared: &TriangleConvention, found: Option<&TriangleConvention>) -> Vec<Base> {
    let mut bases = vec![Base { convention: *declared, said: None, is_first: true }];
    // Each convention once: a second one would explain the same.
    let mut add = |convention: TriangleConvention, said: [String; 2]| {
        if bases.iter().all(|base| base.convention != convention) {
            let is_first = bases.iter().all(|base| base.convention.shape != convention.shape);
            bases.push(Base { convention, said: Some(said), is_first });
        }
    };
    for ([x, y], place) in SAMPLES {
        for rule in RULES {
            let shape = Shape::Point { x, y };
            let Some(ties) = Ties::named(rule) else { continue };
            let said = [place.to_owned(), format!(" and follows the {rule} rule")];
            add(TriangleConvention { shape, ties, ..*declared }, said);
        }
    }
    if let Some(found) = found {
        add(*found, [found.words(), String::new()]);
        // The found one, and what it may be beside.
        let quantum = found.quantum;
        if quantum.step > 1 && quantum.rounding == Rounding::Near {
            // No question about conventions has a negative coordinate halfway between two points of a grid.
            let quantum = Quantum { rounding: Rounding::HalfAway, ..quantum };
            let away = TriangleConvention { quantum, ..*found };
            add(away, [away.words(), String::new()]);
        }
    }
    bases
}

/// Limits of size between what is drawn and what is not.
fn limits(answered: &[AnsweredQuestion<TriangleQuestion>]) -> Vec<i64> {
    let mut limits = Vec::new();
    for metric in 0..fills::METRICS.len() {
        // The sizes of triangles that are lost, from the least to the largest; of those that are drawn, and of those that are
        // although they should not be.
        // By one metric after the other; a program has one of them.
        let (mut lost, mut drawn, mut extra) = (Vec::new(), Vec::new(), Vec::new());
        for a in answered {
            let size = fills::metric(&a.question.corners, metric);
            match (a.right.is_empty(), a.drawn.is_empty()) {
                (false, true) => lost.push(size),
                (false, false) => drawn.push(size),
                (true, false) => extra.push(size),
                (true, true) => {}
            }
        }
        if let Some((&least, &most)) = lost.iter().min().zip(lost.iter().max()) {
            // Below: all that is lost is smaller than what is drawn. Above: the other way.
            if let Some(next) = drawn.iter().filter(|size| **size > most).min() {
                let limit = most + (next - most).max(1) / 2 + 1;
                limits.push(triangles::packed_size(metric, true, limit));
            }
            limits.push(triangles::packed_size(metric, false, least));
        }
        if let Some(most) = extra.iter().max() {
            limits.push(triangles::packed_size(metric, true, most + 1));
        }
    }
    limits
}

/// Answers that scans are fitted to.
const FITTED: usize = 240;

/// Some of the answers that hypotheses are chosen by: those of triangles that are small, so that slopes do not matter much.
fn near(
    answered: &[AnsweredQuestion<TriangleQuestion>],
    is_wrong: &[bool],
    declared: &TriangleConvention,
) -> Vec<scans::DrawnTriangle> {
    let mut all = Vec::new();
    for i in chosen_by(is_wrong) {
        let AnsweredQuestion { question: TriangleQuestion { corners, window }, drawn, .. } =
            &answered[i];
        // On a long edge a small error of the slope moves many pixels.
        let is_small = fills::metric(corners, fills::LONGER_SIDE) < 64 * 256;
        if is_small && is_faced(declared, corners) {
            all.push((cells::places(corners), *window, *drawn));
        }
        if all.len() == FITTED {
            break;
        }
    }
    all
}

/// Limits in pixels below which no answer is wrong, by the farthest coordinate of both axes or of one: some numbers before the
/// first wrong one.
fn clamped(answered: &[AnsweredQuestion<TriangleQuestion>]) -> Vec<i64> {
    let mut limits = Vec::new();
    for metric in fills::FARTHEST..fills::METRICS.len() {
        let mut least = i64::MAX;
        for a in answered.iter().filter(|a| a.is_wrong()) {
            least = least.min(fills::metric(&a.question.corners, metric) / 256);
        }
        if least == i64::MAX || least <= i64::from(questions::SIDE_PX) {
            continue;
        }
        // Each number just before it, and round ones farther away.
        let is_near = |limit: &i64| least - limit < 32 || limit % 100 == 0;
        limits.extend((least - least / 5..=least).rev().filter(is_near).take(64));
    }
    limits.sort_unstable();
    limits.dedup();
    limits
}

/// All mistakes, with an example of the parameter: triangles first.
#[must_use]
pub fn table() -> Vec<Explanation> {
    fn example<D>(mistake: &Mistake<D>) -> Explanation {
        let p = match mistake.parameters {
            Parameters::Fixed(parameters) | Parameters::Words(parameters, _) => parameters[0],
            Parameters::Below(_) => 1,
            Parameters::Sizes => triangles::packed_size(0, true, 131_072),
            Parameters::Clamps | Parameters::Scans(_) | Parameters::Octants => 1,
        };
        says(mistake, p)
    }
    triangles::TABLE.iter().map(example).chain(lines::TABLE.iter().map(example)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::Search;

    /// Two mistakes at once are told: one of the table, and one that no table has.
    #[test]
    fn known_ways_are_parts_of_an_explanation() {
        let mistake =
            triangles::TABLE.iter().find(|m| m.name == "corners made by clipping are rounded");
        let mistake = mistake.unwrap();
        let known = Declarations { window_px: (24, 24), ..Declarations::default() };
        let draw = |q: &TriangleQuestion| -> Option<Coverage> {
            let whole = || None;
            let [mask, _] = fill(mistake.draws, 1, &known.declared, &q.corners, q.window, &whole)?;
            let mut picture = Coverage::new(q.window, 0);
            // Row 0 is lost.
            for y in 1..q.window.y1 {
                for x in (0..q.window.x1).filter(|x| mask.has(*x, y)) {
                    picture.row_mut(y)[x as usize] = 1;
                }
            }
            Some(picture)
        };
        let answer = |questions: &[TriangleQuestion]| questions.iter().map(draw).collect();
        let starts = [learn::Start { convention: &known.declared, is_right: true }];
        let alone = Search::new(async |asker| learn_triangles(&asker, &known, &starts, &[]).await);
        let alone = alone.answered_by(answer).unwrap();
        assert!(!alone.is_certain, "{alone:?}");
        let why = Search::new(async |asker| {
            of_triangles(&asker, &known, None, &[], Some(learn_triangles)).await
        });
        let why = why.answered_by(answer).unwrap();
        let said = why.to_string();
        assert!(why.is_learned(), "{said}");
        assert!(said.contains("clips triangles at the window"), "{said}");
        assert!(said.contains("where its row is 0"), "{said}");
        assert!(said.contains("Repair: "), "{said}");
    }

    /// A mistake whose pixels do not depend on the window draws each of them alone as within the picture.
    #[test]
    fn pixels_alone_are_those_of_the_picture() {
        let known = Declarations::default();
        let questions = questions::triangles(&known, [128, 128], SEED);
        let bases = bases(&known.declared, None);
        let mut compared = 0;
        for (number, mistake) in triangles::TABLE.iter().enumerate() {
            let parameters = match mistake.parameters {
                Parameters::Sizes => vec![triangles::packed_size(0, true, 131_072)],
                Parameters::Clamps => triangles::clamps(&[100]),
                others => numbers(others),
            };
            let some: Vec<_> = parameters.iter().step_by(parameters.len() / 24 + 1).collect();
            for (k, &&p) in some.iter().enumerate() {
                let Base { convention, .. } = &bases[k % bases.len()];
                for question in questions.iter().skip(number + k).step_by(6 * some.len()) {
                    let TriangleQuestion { corners, window } = question;
                    let right = || convention.mask(corners, *window);
                    let whole = fill(mistake.draws, p, convention, corners, *window, &right);
                    let Some([drawn, _]) = whole else { continue };
                    let row = |y| (window.x0..window.x1).map(move |x| [x, y]);
                    for at in (window.y0..window.y1).flat_map(row) {
                        let alone = pixel(mistake.draws, p, convention, corners, *window, at);
                        let is_same = alone.is_none_or(|alone| alone == drawn.has(at[0], at[1]));
                        assert!(is_same, "{} {p}: {at:?} of {question:?}", mistake.name);
                        compared += u32::from(alone.is_some());
                    }
                }
            }
        }
        assert!(compared > 500_000, "{compared}");
    }
}
