//! Failing cases made small while the program is asked, and what was said about them.

use std::time::{Duration, Instant};

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Question, Subject, show};
use super::check::{Check, Truth, expected_answer};
use super::declared::Declared;
use super::difference;
use super::judged::CaseJudgement;
use super::pictured::{Pictured, pictured};
use super::run::{Changing, Failing, Row, RunFindings};
use super::shrink::ProgramSteps;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::shrink::SmallerSearch;
use rasterproof_verify::cases::{Case, Shape, Triangle};
use rasterproof_verify::judge::ascii;

/// A failing case with the requests of the smallest one, and their answers.
pub type Failure = rasterproof_verify::judge::Failure<Case, Exchanged>;

/// What was asked and answered in a failing case.
#[derive(Clone, Debug)]
pub struct Exchanged {
    /// The property whose failing case it is.
    pub property: &'static str,
    /// The other properties whose smallest case shows the same.
    pub also: Vec<&'static str>,
    pub check: Check,
    /// How small the case could be made.
    pub shrunk: HowFar,
    /// The requests of the smallest case, in the order in which they were sent.
    pub exchanges: Vec<Exchange>,
    /// All its answers as one picture, and the one expected, where there are both.
    pub picture: Option<Pictured>,
    /// Whether the answers changed when it was asked a second time. These stand where those of a second program do.
    pub changes: bool,
}

rasterproof_core::named! {
    /// How far a failing case was made smaller.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum HowFar {
        Shrunk = "shrunk",
        UntilTheEnd = "shrunk until the time was up",
        NotAtAll = "not made smaller: the time was up",
        /// It is not asked again.
        TakesLong = "as it is, since it takes long",
        /// The answers to smaller ones would change too.
        Changes = "as it is",
    }
}

impl HowFar {
    /// Whether it might have become smaller with more time.
    #[must_use]
    pub fn is_cut(self) -> bool {
        matches!(self, Self::UntilTheEnd | Self::NotAtAll)
    }
}

/// A request, its answer, and the answer that was expected; as lines of the protocol.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Exchange {
    /// As it was sent, with the id 1.
    pub request: String,
    /// As it came, cut where it gets long.
    pub answer: String,
    /// What the other of two compared programs answered, or the same program the second time; or nothing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub other: String,
    /// What was expected instead, or nothing.
    pub expected: String,
    /// The request and the answer as values; a long answer is cut where it is a line.
    #[serde(skip)]
    pub question: Question,
    #[serde(skip)]
    pub heard: Answer,
}

impl Exchange {
    /// A question with its answer, and what was expected.
    fn new(check: Check, question: &Question, answer: &Answer, truth: &Truth) -> Self {
        Self {
            request: question.text(1),
            answer: show(answer, 1),
            other: String::new(),
            expected: expected(check, question, truth),
            question: question.clone(),
            heard: answer.clone(),
        }
    }
}

impl Exchanged {
    /// Whether it shows what is wrong with a property.
    #[must_use]
    pub fn shows(&self, property: &str) -> bool {
        self.property == property || self.also.contains(&property)
    }
}

/// Kinds of failing cases that are shown.
const MOST_SHOWN: usize = 6;

/// The first failing case of each property that is not known, shrunk, and each kind once. Where the pictures show what is wrong, it
/// comes first, and of these the smallest; of equal ones holes and doubles, then those of the most often wrong. For all of them the answers may take `patience`; how
/// long they took comes with them.
pub(super) fn failures(
    program: &mut dyn Subject,
    found: &RunFindings,
    options: &Options,
    truth: &Truth,
    patience: Duration,
) -> (Vec<Failure>, Duration) {
    // The properties that are wrong most come first, and of those that are not known the first failing case.
    let mut rows: Vec<&Row> = found.rows.iter().filter(|row| row.wrong_cases > 0).collect();
    rows.sort_by(|a, b| importance(b).total_cmp(&importance(a)));
    let mut firsts = Vec::new();
    for row in rows {
        let of_row =
            |failing: &&Failing| failing.property == row.name && !is_known(failing, options);
        firsts.extend(found.failing.iter().find(of_row));
    }
    let mut program = Spending { asked: program, spent: Duration::ZERO };
    let mut shown: Vec<Failure> = Vec::new();
    let mut kinds: Vec<Kind> = Vec::new();
    for (done, failing) in firsts.iter().enumerate() {
        // The time for all of them is shared among those that are still to be made smaller, so that none is left without any.
        let left = patience.saturating_sub(program.spent);
        // Beyond as many searches as cases are shown, others are for what is still to be seen.
        if shown.len() == MOST_SHOWN || done >= MOST_SHOWN && left.is_zero() {
            break;
        }
        let to_do = (firsts.len() - done).min(MOST_SHOWN - shown.len());
        let share = left / to_do as u32;
        let Some(failure) = failure(&mut program, found, failing, share, options, truth) else {
            continue;
        };
        // A case that shows what another one shows already is named beside it and not shown.
        let kind = Kind::of(&failure, truth.declared.convention.sample);
        match kinds.iter().position(|known| *known == kind) {
            Some(at) => shown[at].evidence.also.push(failing.property),
            None => {
                kinds.push(kind);
                shown.push(failure);
            }
        }
    }
    // The one that is read fastest comes first.
    shown.sort_by_key(to_read);
    (shown, program.spent)
}

/// How bad a property is: holes and doubles first, then by the share of wrong cases.
fn importance(row: &Row) -> f64 {
    match row.check {
        Some(Check::Watertight) => f64::INFINITY,
        _ => row.share(),
    }
}

/// Whether the baseline knows a failing case, wrong in the same way.
fn is_known(failing: &Failing, options: &Options) -> bool {
    let known = &options.terms.known;
    !known.is_empty() && known.get(&failing.name()) == Some(&failing.fingerprint)
}

/// How much there is to read until it is seen what is wrong: whether the pictures do not show it, and how many characters the requests
/// and the two pictures have.
fn to_read(failure: &Failure) -> (bool, u64) {
    let Exchanged { picture, exchanges, .. } = &failure.evidence;
    let is_same = picture.as_ref().is_none_or(|picture| picture.drawn == picture.expected);
    let window = failure.case.window;
    let mut characters = 2 * u64::from(window.width()) * u64::from(window.height());
    for exchange in exchanges {
        characters += exchange.request.len() as u64;
    }
    (is_same, characters)
}

/// Somebody who is asked, and how long the answers took in all. What the judge itself computes does not count, so that of a program
/// that answers at once nothing is left out on a busy machine.
struct Spending<'a> {
    asked: &'a mut dyn Subject,
    /// What the answers took so far.
    spent: Duration,
}

impl Subject for Spending<'_> {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let start = Instant::now();
        let answers = self.asked.ask(questions, most_deaths);
        self.spent += self.asked.took().unwrap_or_else(|| start.elapsed());
        answers
    }

    fn took(&self) -> Option<Duration> {
        self.asked.took()
    }
}

/// The first case of each property whose answers change, as it was asked: what was shrunk would answer otherwise again.
pub fn changing(found: &RunFindings, options: &Options, truth: &Truth) -> Vec<Failure> {
    let mut failures = Vec::new();
    for changing in &found.changing {
        if failures.len() == MOST_SHOWN {
            break;
        }
        failures.extend(failure_that_changes(changing, options, truth));
    }
    failures
}

/// A case whose answers change, with the answers of both times.
fn failure_that_changes(changing: &Changing, options: &Options, truth: &Truth) -> Option<Failure> {
    let Changing { failing, check, questions, answers } = changing;
    let check = *check;
    let family = adapt_case::family(failing.family)?;
    let case = adapt_case::case(family, options.seed, failing.index, &truth.declared);
    // Of two programs that are compared the one whose answers change is shown.
    let mut answers = answers.clone();
    let (mut truth, mut who) = (truth, String::new());
    if let Some(of_two) = &truth.of_two {
        // Each program answered twice; one of both did not repeat itself.
        let [first, again] = answers.each_ref().map(|answers| difference::sides(answers));
        let side = usize::from(are_same(&first[0], &again[0]));
        answers = [first[side].clone(), again[side].clone()];
        truth = &of_two[side];
        who = format!("{}: ", truth.declared.name);
    }
    // What is wrong each time, and both pictures.
    let [first, again] = &answers;
    let said =
        |answers: &[Answer]| judge(check, &case, answers, questions.len(), truth).describe(check);
    let what = format!("{who}first {}, then {}", said(first), said(again));
    let mut picture = pictured(check, &case, first, truth);
    if let Some(picture) = &mut picture {
        picture.other = pictured(check, &case, again, truth).map(|again| again.drawn);
    }
    let mut exchanges = Vec::new();
    for ((question, first), again) in questions.iter().zip(first).zip(again) {
        let mut exchange = Exchange::new(check, question, first, truth);
        // Both answers of a question stand side by side.
        exchange.other = show(again, 1);
        exchanges.push(exchange);
    }
    let evidence = Exchanged {
        property: failing.property,
        also: Vec::new(),
        check,
        shrunk: HowFar::Changes,
        exchanges,
        picture,
        changes: true,
    };
    Some(Failure::new(failing.family, failing.index, options.seed, what, case, evidence))
}

/// Whether the same questions got the same answers twice.
fn are_same(first: &[Answer], again: &[Answer]) -> bool {
    first.iter().zip(again).all(|(first, again)| first.is_same(again))
}

/// The answer that was expected, as a line of the protocol; nothing of checks that compare answers with each other.
fn expected(check: Check, question: &Question, truth: &Truth) -> String {
    let expected = expected_answer(question, truth).filter(|_| check.is_one_by_one());
    expected.map_or_else(String::new, |expected| show(&expected, 1))
}

/// A case that was asked, with what came of it.
pub struct AskedCase {
    pub questions: Vec<Question>,
    pub answers: Vec<Answer>,
    /// What was found in the answers.
    pub judged: CaseJudgement,
}

impl AskedCase {
    /// Asks the questions of a case, and judges the answers.
    fn of(program: &mut dyn Subject, check: Check, case: &Case, truth: &Truth) -> Self {
        let mut questions = Vec::new();
        check.questions(case, truth, &mut questions);
        // Of a case that the program dies of, one request is enough.
        let answers = program.ask(&questions, 1);
        let judged = judge(check, case, &answers, questions.len(), truth);
        Self { questions, answers, judged }
    }

    /// Whether answers are missing, and not because the program died: the time is up.
    fn is_late(&self) -> bool {
        self.answers.len() < self.questions.len() && self.judged.died.is_empty()
    }

    /// Whether it takes long to go wrong.
    fn is_slow(&self) -> bool {
        self.judged.died.iter().any(|(_, what)| what.is_slow())
    }
}

/// The smallest case of a failure. Its words are those of the first time where the time is up before it could be asked again.
fn failure(
    program: &mut Spending<'_>,
    found: &RunFindings,
    failing: &Failing,
    patience: Duration,
    options: &Options,
    truth: &Truth,
) -> Option<Failure> {
    let family = adapt_case::family(failing.family)?;
    let case = adapt_case::case(family, options.seed, failing.index, &truth.declared);
    let check = Check::of_truth(family.name, &case, failing.index, truth)
        .into_iter()
        .find(|check| check.name(family.name) == failing.property)?;
    // A case within the window stays within it: programs that do not clip would crash on a smaller one, which is another fault.
    let leaves = adapt_case::leaves_window(&case);
    let may_be = |smaller: &Case| leaves || !adapt_case::leaves_window(smaller);
    let first = AskedCase::of(program, check, &case, truth);
    let was_asked = !first.is_late();
    let search = Search { check, truth, seed: options.seed, patience, may_be: &may_be };
    let mut failure = search.smallest(program, failing, case, first);
    if !was_asked {
        let described = found.described.get(&failing.name());
        failure.what = described.map_or("wrong", String::as_str).to_owned();
        failure.evidence.picture = None;
    }
    Some(failure)
}

/// How a failing case is made smaller.
pub struct Search<'a> {
    pub check: Check,
    pub truth: &'a Truth,
    /// The seed by which the failing case was generated.
    pub seed: u64,
    /// How long the program may take to answer meanwhile.
    pub patience: Duration,
    /// Whether a smaller case is one to ask.
    pub may_be: &'a dyn Fn(&Case) -> bool,
}

impl Search<'_> {
    /// What takes long to go wrong is shown as it is, and not asked again.
    pub fn smallest(
        &self,
        program: &mut dyn Subject,
        failing: &Failing,
        original: Case,
        first: AskedCase,
    ) -> Failure {
        let &Self { check, truth, seed, patience, may_be } = self;
        let mut program = Spending { asked: program, spent: Duration::ZERO };
        let (was_wrong, was_late, is_slow) =
            (first.judged.is_wrong(), first.is_late(), first.is_slow());
        // The answers to the smallest case so far.
        let mut kept = first;
        // A smaller case is put where the program draws, as the original was.
        let put = |case: &Case| adapt_case::put(case.clone(), &truth.declared);
        let is_asked = |case: &Case| {
            adapt_case::holds(case, &truth.declared) && may_be(case) && check.fits(&put(case))
        };
        // The search goes on from each smaller case that is still wrong, until the time for it is over.
        let steps = ProgramSteps::new(check, &original, &is_asked);
        let mut search = SmallerSearch::new(original.clone(), &steps);
        while was_wrong && !is_slow && program.spent < patience {
            let Some(smaller) = search.next(&steps, 1).pop() else { break };
            let asked = AskedCase::of(&mut program, check, &put(&smaller), truth);
            let is_wrong = asked.judged.is_wrong();
            search.answer(&steps, &[is_wrong]);
            kept = if is_wrong { asked } else { kept };
        }
        let case = search.smallest;
        let was_cut = program.spent >= patience;
        // The smallest case is asked once more, for the answers that are shown.
        let mut again = None;
        if !was_late && !is_slow {
            let asked = AskedCase::of(&mut program, check, &case, truth);
            again = (!asked.is_late()).then_some(asked);
        }
        // What is said of how far it got.
        let shrunk = match (is_slow, was_cut || again.is_none()) {
            (true, _) => HowFar::TakesLong,
            (_, true) if case == original => HowFar::NotAtAll,
            (_, true) => HowFar::UntilTheEnd,
            (_, false) => HowFar::Shrunk,
        };
        let AskedCase { questions, answers, judged } = again.unwrap_or(kept);
        // Asked again, it was right: the program does not repeat itself.
        let what = match was_wrong && judged.is_wrong() {
            true => judged.describe(check),
            false => "wrong at first, right when asked again".to_owned(),
        };
        let mut exchanges = Vec::new();
        for (question, answer) in questions.iter().zip(&answers) {
            let mut exchange = Exchange::new(check, question, answer, truth);
            if let Answer::Two(both) = answer {
                exchange.other = show(&both[1], 1);
            }
            exchanges.push(exchange);
        }
        let evidence = Exchanged {
            property: failing.property,
            also: Vec::new(),
            check,
            shrunk,
            exchanges,
            picture: pictured(check, &case, &answers, truth),
            changes: false,
        };
        Failure::new(failing.family, failing.index, seed, what, case, evidence)
    }
}

/// What is found in the answers to a case; there are fewer where the program died or the time was up.
pub fn judge(
    check: Check,
    case: &Case,
    answers: &[Answer],
    of: usize,
    truth: &Truth,
) -> CaseJudgement {
    if answers.len() < of {
        Check::judge_deaths(answers)
    } else {
        check.judge(case, answers, truth)
    }
}

/// What a shrunk case shows, whatever its family, its corners and their order.
#[derive(PartialEq)]
struct Kind {
    check: Check,
    /// What is wrong, without the numbers.
    words: Vec<String>,
    /// The wrong pixels of the picture, in the order of rows.
    pixels: Vec<Pixel>,
    /// Whether the sample of the first of these lies exactly on an edge.
    on_edge: bool,
    /// What was asked, where the pictures do not show what is wrong.
    requests: Vec<String>,
}

/// A wrong pixel, counted from the upper left corner of the box around all of them.
#[derive(PartialEq)]
struct Pixel {
    x: usize,
    y: usize,
    /// The character that pictures in text show there.
    mark: char,
}

impl Kind {
    /// The kind of a failing case; `sample` is the place of a sample in its pixel.
    fn of(failure: &Failure, sample: [i32; 2]) -> Self {
        let evidence = &failure.evidence;
        let mut kind = Self {
            check: evidence.check,
            words: words(&failure.what),
            pixels: Vec::new(),
            on_edge: false,
            requests: Vec::new(),
        };
        // The wrong pixels, as they stand in the picture that is shown.
        if let Some(picture) = &evidence.picture {
            let target = picture.other.as_ref().unwrap_or(&picture.expected);
            for (y, (drawn, target)) in picture.drawn.rows().zip(target.rows()).enumerate() {
                for (x, (&drawn, &target)) in drawn.1.iter().zip(target.1).enumerate() {
                    if drawn != target {
                        kind.pixels.push(Pixel { x, y, mark: ascii::mark(drawn, target) });
                    }
                }
            }
        }
        let Some(first) = kind.pixels.first() else {
            kind.requests = evidence.exchanges.iter().map(|e| e.request.clone()).collect();
            return kind;
        };
        // A pixel whose sample lies exactly on an edge is wrong for another reason than one beside it.
        if let (Check::Coverage | Check::Values, Shape::Triangles { list, .. }) =
            (kind.check, &failure.case.shape)
        {
            let window = failure.case.window;
            let place = |pixel: i32, sample: i32| pixel * SUBPIXELS + sample;
            let [x, y] = [window.x0 + first.x as i32, window.y0 + first.y as i32];
            let at = [place(x, sample[0]), place(y, sample[1])];
            kind.on_edge =
                list.iter().map(Triangle::corners).any(|corners| is_on_edge(corners, at));
        }
        // The place in the window does not matter, so that pixels are counted from their own corner.
        let left = kind.pixels.iter().map(|pixel| pixel.x).min().unwrap_or(0);
        let top = kind.pixels.iter().map(|pixel| pixel.y).min().unwrap_or(0);
        for pixel in &mut kind.pixels {
            pixel.x -= left;
            pixel.y -= top;
        }
        kind
    }
}

/// The words of a sentence without its numbers, which differ between cases of the same kind.
fn words(what: &str) -> Vec<String> {
    let words = what.split(' ').filter(|word| !word.starts_with(|c: char| c.is_ascii_digit()));
    words.map(|word| word.trim_end_matches(',').to_owned()).collect()
}

/// Whether a point lies on one of the three edges.
fn is_on_edge([a, b, c]: Corners, at: [i32; 2]) -> bool {
    [[a, b], [b, c], [c, a]].iter().any(|&[from, to]| lies_between(from, to, at))
}

/// Whether a point lies on the way from one point to another.
pub(super) fn lies_between(from: SubpixelPoint, to: SubpixelPoint, [x, y]: [i32; 2]) -> bool {
    let mut at = from;
    (at.x, at.y) = (x, y);
    let is_between = (from.x.min(to.x)..=from.x.max(to.x)).contains(&x)
        && (from.y.min(to.y)..=from.y.max(to.y)).contains(&y);
    is_between && twice_area(&[from, to, at]) == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::against;
    use crate::in_process::Inside;
    use crate::recognise::{Scope, recognise};
    use crate::verdict::{Scores as _, Verdict};
    use rasterproof_core::triangle::Span;
    use rasterproof_registry::engines;

    /// An engine whose answers are altered before the judge reads them, by how many there were before.
    struct Altered {
        engine: Inside,
        answered: u64,
        alter: fn(&mut Answer, u64),
    }

    impl Subject for Altered {
        fn declared(&self) -> &Declared {
            self.engine.declared()
        }

        fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
            let mut answers = self.engine.ask(questions, most_deaths);
            for answer in &mut answers {
                (self.alter)(answer, self.answered);
                self.answered += 1;
            }
            answers
        }
    }

    fn altered(alter: fn(&mut Answer, u64)) -> Box<dyn Subject> {
        let engine = Inside::new(engines::find("scanline").unwrap());
        Box::new(Altered { engine, answered: 0, alter })
    }

    fn options() -> Options {
        Options::default().cases(40).family("half-integer".to_owned())
    }

    fn judged(alter: fn(&mut Answer, u64)) -> Verdict {
        crate::judge(&mut [altered(alter)], &options(), &|_| None, &|_| ())
    }

    /// It was called nonsense, that a number cannot be read.
    #[test]
    fn a_run_that_ends_before_it_begins_is_a_finding() {
        let verdict = judged(|answer, _| {
            if let Answer::Coverage(runs) = answer {
                for run in runs.iter_mut().filter(|run| run.y_px == 2) {
                    *run = Span { x0_px: run.x1_px, x1_px: run.x0_px, ..*run };
                }
            }
        });
        assert!(!verdict.agrees() && verdict.more.found.incidents.is_empty());
        let first = &verdict.failures[0];
        let said = "the run of row 2 begins at column ";
        assert!(first.what.contains(said), "{}", first.what);
        assert!(first.what.contains(" and ends before it, at column "), "{}", first.what);
        assert!(first.evidence.exchanges[0].request.starts_with("T 1 "));
    }

    /// Drops the first run of every fifth answer.
    fn forget(answer: &mut Answer, before: u64) {
        let Answer::Coverage(runs) = answer else { return };
        if before.is_multiple_of(5) && !runs.is_empty() {
            runs.remove(0);
        }
    }

    #[test]
    fn answers_that_change_are_shown_and_not_shrunk() {
        let verdict = judged(forget);
        assert!(verdict.cause.is_empty() && verdict.more.recognised.is_none());
        let first = &verdict.failures[0];
        assert!(first.what.starts_with("first "), "{}", first.what);
        assert!(first.what.contains(", then "), "{}", first.what);
        let evidence = &first.evidence;
        assert!(evidence.changes && evidence.shrunk == HowFar::Changes);
        assert!(evidence.exchanges.iter().any(|exchange| exchange.answer != exchange.other));
        assert!(verdict.failures.iter().all(|failure| failure.evidence.changes));
        // Who is wrong in the same way each time is made smaller.
        let same = judged(|answer, _| forget(answer, 0));
        assert!(same.failures.iter().all(|failure| !failure.evidence.changes));
        assert_eq!(same.failures[0].evidence.shrunk, HowFar::Shrunk);
    }

    #[test]
    fn the_smallest_case_stands_first() {
        let options = Options::default().cases(40);
        let wrong = altered(|answer, _| forget(answer, 0));
        let shown = crate::judge(&mut [wrong], &options, &|_| None, &|_| ()).failures;
        let sizes: Vec<_> = shown.iter().map(to_read).collect();
        assert!(sizes.len() > 2 && sizes.is_sorted(), "{sizes:?}");
        let window = shown[0].case.window;
        assert_eq!((window.width(), window.height()), (1, 1), "{sizes:?}");
    }

    fn slow() -> Box<dyn Subject> {
        altered(|answer, _| {
            std::thread::sleep(Duration::from_millis(20));
            forget(answer, 0);
        })
    }

    /// Of a program that is slow, all failing cases together are made smaller for a limited time, causes are looked for as long, and
    /// it is said.
    #[test]
    fn what_is_slow_is_not_made_smaller_for_long() {
        let mut options = options().cases(4);
        options.families.push("rectangle".to_owned());
        options.terms.patience = Duration::from_millis(400);
        let verdict = crate::judge(&mut [slow()], &options, &|_| None, &|_| ());
        let shrunk: Vec<_> = verdict.failures.iter().map(|f| f.evidence.shrunk).collect();
        assert!(shrunk.len() > 1, "{shrunk:?}");
        assert!(shrunk.iter().all(|how_far| how_far.is_cut()), "{shrunk:?}");
        // The first one has not the whole time, but enough to begin.
        assert_eq!(shrunk[0], HowFar::UntilTheEnd);
        assert!(verdict.cause.is_empty());
        let said = verdict.more.left_out.to_string();
        let parts = "making failing cases smaller, the cause. --seconds allows more.";
        assert!(said.ends_with(parts), "{said}");
        // A limited time is for the same, and for the cases.
        options.terms.time_limit_is = "seconds=";
        let options = options.cases(1000).time_limit(Duration::from_secs(1));
        let start = Instant::now();
        let verdict = crate::judge(&mut [slow()], &options, &|_| None, &|_| ());
        assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
        let said = verdict.more.left_out.to_string();
        assert!(said.starts_with("Left out, since the time limit of 1 s was up: "), "{said}");
        let parts = " cases, making failing cases smaller, the cause. seconds allows more.";
        assert!(said.ends_with(parts), "{said}");
    }

    /// Each of two programs that are compared had the whole time for each kind of check.
    #[test]
    fn two_that_are_slow_share_the_time() {
        let mut options = options().cases(4);
        options.terms.patience = Duration::from_millis(400);
        let right: fn(&mut Answer, u64) = |_, _| ();
        let verdict = against::compare(&mut [[altered(right), slow()]], &options, &|_| ());
        let left_out = verdict.more.left_out;
        assert!(left_out.shrinking && left_out.cause, "{left_out:?}");
        assert!(verdict.cause.is_empty());
    }

    /// Who follows another convention slowly is asked for it for a limited time.
    #[test]
    fn the_convention_of_what_is_slow_is_not_looked_for_for_long() {
        let scope = Scope {
            triangles: true,
            lines: false,
            always: true,
            patience: Some(Duration::from_millis(100)),
        };
        let options = options().cases(4);
        let recognised = |program: &mut dyn Subject| recognise(program, scope);
        let verdict = crate::judge(&mut [slow()], &options, &recognised, &|_| ());
        assert!(verdict.more.left_out.convention && verdict.by_convention().is_none());
        let said = verdict.more.left_out.to_string();
        assert!(said.contains(": its convention"), "{said}");
    }

    #[test]
    fn of_two_programs_the_one_that_changes_is_shown() {
        let right: fn(&mut Answer, u64) = |_, _| ();
        let mut pairs = [[altered(right), altered(forget)]];
        let verdict = against::compare(&mut pairs, &options(), &|_| ());
        let first = &verdict.failures[0];
        assert!(first.evidence.changes && verdict.cause.is_empty());
        assert!(first.what.starts_with("scanline: first "), "{}", first.what);
        assert!(first.evidence.exchanges.iter().any(|e| e.answer != e.other));
    }
}
