//! Asks every case, on as many copies of the program as there are: what [`machine`](rasterproof_verify::judge::machine) is to know of
//! programs.
//!
//! Cases that leave the window come last. A family stops at the third time the program had to be started again.

use std::collections::BTreeMap;
use std::ops::AddAssign;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Misbehaviour, Question, Subject};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::judged::CaseJudgement;
use super::timed::Timed;
use rasterproof_verify::cases::{Case, Family};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::judge::machine::{
    AnsweredBatch, Batch, Driver, Judge, JudgeKind, Place, Plan, Work, keep_first,
};

/// A family stops when the program has had to be started again this often.
pub const MOST_DEATHS: u64 = 3;
/// The judge stops when the program has had to be started again this often altogether.
pub const MOST_DEATHS_IN_ALL: u64 = 30;
/// It stops at fewer hangs and late answers, since each of these is waited for.
pub const MOST_HANGS_IN_ALL: u64 = 10;
/// Failing cases that are remembered for a baseline.
pub const MOST_REMEMBERED: usize = 1 << 20;
/// Failing cases of a property that are remembered without one.
const KEPT: usize = 4;
pub const MOST_INCIDENTS: usize = 24;
/// Failing cases of a property that are asked a second time. A program whose answers change seldom has few failing
/// cases, and of one whose answers change often one of these will do.
const MOST_ASKED_AGAIN: u64 = 64;
/// Cases of each family among which one is looked up beside those that are judged.
const BEFORE: u64 = 256;

/// What came of a property: of a family, or of a check over all families.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Row {
    /// The name of the family, or of the check where it is over all families.
    pub name: &'static str,
    /// The check that its cases were judged by; none of polygons, and of a family that was given up before the first case.
    #[serde(skip)]
    pub check: Option<Check>,
    pub cases: u64,
    /// Triangles, lines or corners that were compared.
    pub shapes: u64,
    /// Pixels expected, of four samples the samples, of the near plane the corners.
    pub pixels: u64,
    /// Cases in which anything is wrong.
    pub wrong_cases: u64,
    /// Wrong pixels as declared.
    pub tally: Tally,
    /// Wrong pixels by the convention that was recognised.
    pub recognised: Tally,
    /// Pixels expected by it.
    pub recognised_pixels: u64,
    /// Triangles or lines of which it says nothing.
    pub unscored: u64,
    /// Their pixels that are wrong as declared.
    pub unscored_wrong: u64,
    /// Requests that the program refused.
    pub refused: u64,
    /// Values that were compared.
    pub values: u64,
    /// Those of them that are beyond the tolerance.
    pub wrong_values: u64,
    /// The largest error of a value as a fraction of the tolerance.
    pub worst: f64,
    /// Times the program had to be started again.
    pub deaths: u64,
    /// Whether the family was given up before its last case.
    pub stopped: bool,
    /// Who is right, where two programs are compared and the wrong cases are those that differ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sides: Option<Sides>,
}

/// Of two programs, how often each is right as it declares: the first four are the cases that differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Sides {
    pub first: u64,
    pub second: u64,
    /// Both are wrong, each in its own way.
    pub neither: u64,
    /// What may be drawn either way, or is declared differently.
    pub both: u64,
    /// The same answers, which are wrong.
    pub same_but_wrong: u64,
}

impl Sides {
    /// A case, by which of both programs is right and by whether their answers differ.
    pub(super) fn of(right: [bool; 2], differ: bool) -> Self {
        let one = |is_it: bool| u64::from(is_it);
        Self {
            first: one(differ && right == [true, false]),
            second: one(differ && right == [false, true]),
            neither: one(differ && right == [false, false]),
            both: one(differ && right == [true, true]),
            same_but_wrong: one(!differ && right != [true, true]),
        }
    }
}

impl AddAssign for Sides {
    fn add_assign(&mut self, other: Self) {
        self.first += other.first;
        self.second += other.second;
        self.neither += other.neither;
        self.both += other.both;
        self.same_but_wrong += other.same_but_wrong;
    }
}

impl Row {
    /// How bad it is: the share of its cases that are wrong.
    pub fn share(&self) -> f64 {
        self.wrong_cases as f64 / self.cases.max(1) as f64
    }

    /// A property without a case yet.
    fn new(name: &'static str, check: Option<Check>) -> Self {
        Self { name, check, ..Self::default() }
    }

    /// Adds a judged case.
    fn count(&mut self, judged: &CaseJudgement) {
        // What is counted of every case, right or wrong.
        self.cases += 1;
        self.shapes += judged.shapes;
        self.pixels += judged.pixels;
        self.wrong_cases += u64::from(judged.is_wrong());
        self.tally += judged.finding.tally;
        self.recognised += judged.other;
        self.recognised_pixels += judged.other_pixels;
        self.unscored += judged.unscored;
        self.unscored_wrong += judged.unscored_wrong;
        self.refused += judged.refused;
        self.values += judged.finding.values;
        self.wrong_values += judged.wrong_values;
        self.worst = self.worst.max(judged.finding.worst());
        self.deaths += judged.died.len() as u64;
        // Who of two programs is right is known where they were compared.
        self.add_sides(judged.right.map(|right| Sides::of(right, judged.is_wrong())));
    }

    fn add_sides(&mut self, sides: Option<Sides>) {
        if let Some(sides) = sides {
            *self.sides.get_or_insert_default() += sides;
        }
    }
}

/// A failing case: where it is found again, and a fingerprint of what is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Failing {
    /// The name of its row.
    pub property: &'static str,
    pub family: &'static str,
    /// Its number in the family, from which the seed makes it again.
    pub index: u64,
    /// Changes when what is wrong changes.
    pub fingerprint: u64,
}

impl Failing {
    /// The failing case of a judgement.
    #[must_use]
    pub fn new(family: &Family, index: u64, check: Check, judged: &CaseJudgement) -> Self {
        let (property, fingerprint) = (check.name(family.name), judged.fingerprint());
        Self { property, family: family.name, index, fingerprint }
    }

    /// The name of the case in a baseline.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{} {}#{}", self.property, self.family, self.index)
    }
}

/// Something other than an answer, and the request that it came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Incident {
    /// Name of the family; empty of what was asked before the families.
    pub family: &'static str,
    pub index: u64,
    pub what: Misbehaviour,
    /// The line that was sent.
    pub request: String,
}

/// A failing case whose answers are others when it is asked a second time.
#[derive(Clone, Debug)]
pub struct Changing {
    pub failing: Failing,
    pub check: Check,
    pub questions: Vec<Question>,
    /// The answers of each time.
    pub answers: [Vec<Answer>; 2],
}

/// Everything that was found while all cases were asked.
#[derive(Clone, Debug, Default)]
pub struct RunFindings {
    /// A row for each property.
    pub rows: Vec<Row>,
    /// The failing cases that are remembered, in the order of the families.
    pub failing: Vec<Failing>,
    /// The first case of each property whose answers changed.
    pub changing: Vec<Changing>,
    /// What is wrong in words, by [`Failing::name`], of the first few of each property.
    pub described: BTreeMap<String, String>,
    /// Cases that were judged, by property and family, where they are remembered.
    pub judged: Vec<(&'static str, &'static str, u64)>,
    /// Whether more failed than are remembered.
    pub forgot: bool,
    /// What came instead of answers, the first of it.
    pub incidents: Vec<Incident>,
    /// What went wrong without a single request at fault.
    pub strays: Vec<Misbehaviour>,
    /// Requests that were answered.
    pub answered: u64,
    /// Cases of which all was answered, and those that there are.
    pub cases: u64,
    /// All cases that there are.
    pub of_cases: u64,
    /// Whether the time was up before all cases were judged.
    pub out_of_time: bool,
    /// Whether the program had to be started again too often.
    pub gave_up: bool,
    pub seconds: f64,
}

impl RunFindings {
    /// The row of a property, which is made where there is none yet.
    fn row(&mut self, name: &'static str, check: Option<Check>) -> &mut Row {
        let at = self.rows.iter().position(|row| row.name == name).unwrap_or(self.rows.len());
        if at == self.rows.len() {
            self.rows.push(Row::new(name, check));
        }
        &mut self.rows[at]
    }

    /// What is wrong that no recognised convention explains, one check of each kind.
    #[must_use]
    pub fn unexplained(&self) -> Vec<Check> {
        let mut unexplained = Vec::new();
        for row in &self.rows {
            let is_explained =
                row.recognised_pixels > 0 && row.recognised.total() == 0 && row.unscored == 0;
            let is_wrong = match row.check {
                Some(Check::Values) => row.worst > 1.0,
                Some(Check::SampleValues) => row.wrong_cases > 0,
                _ => row.tally.total() > 0 && !is_explained,
            };
            if is_wrong {
                unexplained.push(row);
            }
        }
        checks_of(unexplained.into_iter())
    }
}

/// The checks that these rows count and of which a cause can be found, each once.
pub(super) fn checks_of<'a>(rows: impl Iterator<Item = &'a Row>) -> Vec<Check> {
    let mut checks = Vec::new();
    for check in rows.filter_map(|row| row.check).filter(|check| !check.compares_answers()) {
        if !checks.contains(&check) {
            checks.push(check);
        }
    }
    checks
}

/// Passes: cases within their windows, then those that leave it.
const PASSES: usize = 2;

/// A program that is judged, and by what.
struct JudgedProgram<'a> {
    /// The families that have a request for it.
    families: Vec<&'static Family>,
    options: &'a Options,
    truth: &'a Truth,
    /// When the time of each pass is over; the first one leaves a quarter.
    ends: [Option<Duration>; PASSES],
}

/// A case and one of its checks.
struct Job {
    /// The number of the case in its family.
    index: u64,
    check: Check,
    case: Arc<Case>,
    /// Whether no other check of the case comes after it.
    is_last: bool,
}

impl Job {
    /// The requests of the job alone.
    fn questions(&self, truth: &Truth) -> Vec<Question> {
        let mut questions = Vec::new();
        self.check.questions(&self.case, truth, &mut questions);
        questions
    }
}

/// What was found about a job, and the answers where anything is wrong.
struct JobFound {
    judged: CaseJudgement,
    answers: Vec<Answer>,
}

/// What came of the jobs so far.
struct Counts {
    found: RunFindings,
    /// The first case of each property whose answers changed, after the number of its batch.
    changing: Vec<(u64, Changing)>,
    /// How often the program had to be started again, in each family of each pass.
    deaths: Vec<[u64; PASSES]>,
    /// Those among them that had to be waited for.
    hangs: u64,
}

impl Counts {
    /// Whether the program had to be started again so often that nothing more is asked. Hangs count for more, since each is waited
    /// for.
    fn gave_up(&self) -> bool {
        // One that has never answered is given up sooner.
        let most = match self.found.answered {
            0 => 2 * MOST_DEATHS,
            _ => MOST_DEATHS_IN_ALL,
        };
        self.deaths.as_flattened().iter().sum::<u64>() >= most || self.hangs >= MOST_HANGS_IN_ALL
    }
}

impl JudgeKind for JudgedProgram<'_> {
    type Job = Job;
    type Judgement = JobFound;
    type Tally = Counts;

    fn jobs(&self, place: Place, index: u64, jobs: &mut Vec<Job>) {
        let (family, truth) = (self.families[place.family], self.truth);
        let case = adapt_case::case(family, self.options.seed, index, &truth.declared);
        // Each pass has its own cases.
        if adapt_case::leaves_window(&case) != (place.pass > 0) {
            return;
        }
        let case = Arc::new(case);
        let mut checks = Check::of_truth(family.name, &case, index, truth).into_iter().peekable();
        while let Some(check) = checks.next() {
            let is_last = checks.peek().is_none();
            jobs.push(Job { index, check, case: Arc::clone(&case), is_last });
        }
    }

    fn count(
        &self,
        Counts { found, deaths, hangs, .. }: &mut Counts,
        place: Place,
        (job, of): (Job, JobFound),
    ) -> Option<(Job, JobFound)> {
        let (family, judged) = (self.families[place.family], &of.judged);
        found.cases += u64::from(job.is_last);
        deaths[place.family][place.pass] += judged.died.len() as u64;
        *hangs += judged.died.iter().filter(|(_, what)| what.is_slow()).count() as u64;
        self.note(found, family, &job, judged);
        // A program that does not repeat itself is found by asking wrong cases again, some of each property.
        let wrong = found.row(job.check.name(family.name), Some(job.check)).wrong_cases;
        let is_asked_again =
            judged.is_wrong() && judged.died.is_empty() && wrong <= MOST_ASKED_AGAIN;
        is_asked_again.then_some((job, of))
    }

    fn compare(
        &self,
        tally: &mut Counts,
        (batch, place): (u64, Place),
        (job, first): &(Job, JobFound),
        again: JobFound,
    ) {
        // The same answers twice are what is expected.
        if first.answers.iter().zip(&again.answers).all(|(first, again)| first.is_same(again)) {
            return;
        }
        let family = self.families[place.family];
        let changing = Changing {
            failing: Failing::new(family, job.index, job.check, &first.judged),
            check: job.check,
            questions: job.questions(self.truth),
            answers: [first.answers.clone(), again.answers],
        };
        // Of each property the first case is kept, by the order of batches and not by who was faster.
        keep_first(&mut tally.changing, batch, changing, |a, b| {
            a.failing.property == b.failing.property
        });
    }

    fn cases(&self, tally: &Counts) -> u64 {
        tally.found.cases
    }

    fn end(&self, _: &Counts, pass: usize) -> Option<Duration> {
        self.ends[pass]
    }

    fn most_deaths(&self, tally: &Counts, place: Place) -> u64 {
        let deaths = tally.deaths[place.family][place.pass];
        if tally.gave_up() { 0 } else { MOST_DEATHS.saturating_sub(deaths) }
    }
}

impl JudgedProgram<'_> {
    /// Asks the jobs of a batch, and judges the answers.
    fn ask(&self, asker: &mut dyn Subject, batch: Batch<Self>) -> AnsweredBatch<Self> {
        let (most_deaths, is_again) = (batch.most_deaths, batch.is_again());
        batch.ask(self, |jobs| {
            let mut questions = Vec::new();
            // The questions of all jobs are sent at once; where those of each end is remembered.
            let mut ends = Vec::new();
            for job in jobs {
                job.check.questions(&job.case, self.truth, &mut questions);
                ends.push(questions.len());
            }
            let answers = asker.ask(&questions, most_deaths);
            let (mut found, mut first) = (Vec::new(), 0);
            for (job, end) in jobs.iter().zip(ends) {
                // Where the program was given up, the rest of the answers is not there.
                let here = &answers[first.min(answers.len())..end.min(answers.len())];
                let is_whole = here.len() == end - first;
                first = end;
                let judged = match (is_whole, here.iter().any(Answer::is_death)) {
                    (true, _) if is_again => CaseJudgement::default(),
                    (true, _) => job.check.judge(&job.case, here, self.truth),
                    (false, true) if !is_again => Check::judge_deaths(here),
                    (false, _) => break,
                };
                let is_kept = is_again || judged.is_wrong();
                let answers = if is_kept { here.to_vec() } else { Vec::new() };
                found.push(JobFound { judged, answers });
            }
            found
        })
    }

    /// Adds what was found about a job to its row, to the incidents and to the failing cases that are remembered.
    fn note(&self, found: &mut RunFindings, family: &Family, job: &Job, judged: &CaseJudgement) {
        let &Job { index, check, .. } = job;
        // A row counts every case, whatever is remembered of it.
        let (property, remember) = (check.name(family.name), self.options.terms.remember);
        found.answered += judged.answered;
        found.row(property, Some(check)).count(judged);
        if remember {
            found.judged.push((property, family.name, index));
        }
        // What came instead of answers, with the request that it came to.
        for (at, what) in &judged.died {
            if found.incidents.len() < MOST_INCIDENTS {
                let asked = job.questions(self.truth);
                let request = asked.get(*at).map_or_else(String::new, |q| q.text(1));
                let what = what.clone();
                found.incidents.push(Incident { family: family.name, index, what, request });
            }
        }
        if judged.is_wrong() {
            // The first failing cases of a property are remembered, and all of them for a baseline.
            let of_it = found.failing.iter().filter(|f| f.property == property).take(KEPT).count();
            if !remember && of_it >= KEPT {
                return;
            }
            if found.failing.len() < MOST_REMEMBERED {
                let failing = Failing::new(family, index, check, judged);
                if of_it < KEPT {
                    found.described.insert(failing.name(), judged.describe(check));
                }
                found.failing.push(failing);
            } else {
                found.forgot = true;
            }
        }
    }
}

/// How many cases put at least one question to a program that declares this.
#[must_use]
pub fn cases_of(options: &Options, declared: &Declared) -> u64 {
    // The questions of a case depend on its family and on its number modulo 8.
    const PERIOD: u64 = 8;
    let mut count = 0_u64;
    for family in asked_families(options, declared) {
        let is_asked = |index: &u64| {
            let case = adapt_case::case(family, options.seed, *index, declared);
            !Check::of(family.name, &case, *index, declared).is_empty()
        };
        let of_family = match options.only {
            Some(index) => u64::from(is_asked(&index)),
            None => {
                // What is asked of one period is asked of each; the last one may be cut.
                let cases = adapt_case::numbers(options, family.design()).end;
                let (whole, rest) = (cases / PERIOD, cases % PERIOD);
                let asked = |below: u64| (0..below).filter(is_asked).count() as u64;
                whole * asked(if whole > 0 { PERIOD } else { 0 }) + asked(rest)
            }
        };
        count = count.saturating_add(of_family);
    }
    count
}

/// The families that have a request for a program that declares this.
fn asked_families(options: &Options, declared: &Declared) -> Vec<&'static Family> {
    let mut families = adapt_case::families(&options.families);
    families.retain(|family| Check::asks(family, declared));
    families
}

/// Judges a program with all of its copies; each asks whatever is next.
pub fn run<'a>(
    askers: &mut [&mut dyn Subject],
    options: &'a Options,
    truth: &'a Truth,
    progress: &(dyn Fn(u64) + Sync),
) -> RunFindings {
    let start = Instant::now();
    let families = asked_families(options, &truth.declared);
    // Each pass has its own end: what leaves the window has the last quarter of the time.
    let end = |share: f64| options.time_limit.map(|limit| limit.mul_f64(share));
    let judged = JudgedProgram { families, options, truth, ends: [end(0.75), end(1.0)] };
    let families = judged.families.len();
    // All copies get batches of the same size, so that what is found does not depend on which one answers.
    let at_once = askers.iter().map(|asker| asker.cases_at_once()).min().unwrap_or(1);
    let numbers =
        judged.families.iter().map(|of| adapt_case::numbers(options, of.design())).collect();
    let plan = Plan::of(options, PASSES, numbers, [at_once, at_once]);
    // Nothing was found yet.
    let counts = Counts {
        found: RunFindings::default(),
        changing: Vec::new(),
        deaths: vec![[0; PASSES]; families],
        hangs: 0,
    };
    let copies: Vec<Mutex<Timed<'_>>> =
        askers.iter_mut().map(|asker| Mutex::new(Timed::new(&mut **asker, None))).collect();
    let workers = |work: &Work<'_>| {
        std::thread::scope(|scope| {
            // This thread is one of them; where the system refuses others, it works alone.
            for copy in 1..copies.len() {
                let work = move || work(copy);
                if std::thread::Builder::new().spawn_scoped(scope, work).is_err() {
                    break;
                }
            }
            work(0);
        });
    };
    let ask = |copy: usize, batch: Batch<JudgedProgram<'a>>| {
        let mut asker = copies[copy].lock().unwrap_or_else(PoisonError::into_inner);
        asker.end = judged.ends[batch.place.pass].map(|end| start + end);
        judged.ask(&mut *asker, batch)
    };
    // The driver gives batches to copies and counts what comes back in their order.
    let driver = Driver { now: &|| start.elapsed(), workers: &workers, ask: &ask, progress };
    let done = driver.drive(&judged, Judge::new(plan, counts));
    // What is left is to gather what the copies found, and to say what was not done.
    let (is_late, gave_up) = (done.is_late, done.tally.gave_up());
    let Counts { found: mut whole, changing, deaths, .. } = done.tally;
    whole.out_of_time = is_late;
    for copy in copies {
        let mut asker = copy.into_inner().unwrap_or_else(PoisonError::into_inner);
        whole.out_of_time |= asker.is_late;
        whole.strays.extend(asker.strays());
    }
    // Copies found them in any order; as they are asked, they are the same for any number of copies.
    whole.failing.sort_by_key(|f| {
        let family = judged.families.iter().position(|family| family.name == f.family);
        (family, f.index, f.property)
    });
    whole.changing = changing.into_iter().map(|(_, changing)| changing).collect();
    whole.gave_up = gave_up;
    whole.of_cases = cases_of(options, &truth.declared);
    whole.out_of_time &= whole.cases < whole.of_cases;
    whole.seconds = start.elapsed().as_secs_f64();
    for (family, deaths) in judged.families.iter().zip(deaths) {
        if deaths.iter().any(|deaths| *deaths >= MOST_DEATHS) {
            whole.row(family.name, None).stopped = true;
        }
    }
    whole
}

/// The family and the number of the first generated case that asks this, written with the id 1; nothing for a case that was
/// made smaller, or for what is asked before the families.
#[must_use]
pub fn case_that_asks(
    request: &str,
    options: &Options,
    declared: &Declared,
) -> Option<(&'static str, u64)> {
    let truth = Truth::of(declared);
    let (asked, all) = (adapt_case::families(&options.families), adapt_case::families(&[]));
    let of_designs = asked.iter().map(|family| adapt_case::numbers(options, family.design()).end);
    let numbers = options.numbers().start..of_designs.max().unwrap_or(0);
    // The windings are found with the first cases of a family that may not be among those that are judged.
    let indices =
        numbers.map(|index| (index, &asked)).chain((0..BEFORE).map(|index| (index, &all)));
    let mut questions = Vec::new();
    // Families take turns, as they do where they are judged, so that an early case is found early.
    for (index, families) in indices {
        for family in families {
            let case = adapt_case::case(family, options.seed, index, declared);
            questions.clear();
            for check in Check::of_truth(family.name, &case, index, &truth) {
                check.questions(&case, &truth, &mut questions);
            }
            if questions.iter().any(|question| question.text(1) == request) {
                return Some((family.name, index));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::Breach;
    use crate::in_process::Inside;
    use rasterproof_registry::engines;

    /// A strict fill that dies of some requests, and takes its time for others.
    struct Uneven(Inside);

    impl Subject for Uneven {
        fn declared(&self) -> &Declared {
            self.0.declared()
        }

        fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
            let mut answers = self.0.ask(questions, most_deaths);
            let mut deaths = 0;
            for (at, answer) in answers.iter_mut().enumerate() {
                match answer {
                    Answer::Coverage(runs) if runs.len() == 7 => {
                        *answer = Answer::Died(Breach::Exits.by("seven rows"));
                        deaths += 1;
                    }
                    Answer::Coverage(runs) if runs.len() % 5 == 1 => std::thread::yield_now(),
                    _ => {}
                }
                if deaths == most_deaths {
                    answers.truncate(at + 1);
                    break;
                }
            }
            answers
        }
    }

    /// What is found does not depend on how many copies there are, nor on which of them answers first.
    #[test]
    fn copies_find_what_one_finds() {
        let mut options = Options::default().cases(150);
        options.families = ["half-integer", "fan", "tiny", "uniform"].map(str::to_owned).into();
        let found = |copies: usize| {
            let engine = engines::find("games101-strict").unwrap();
            let mut all: Vec<Uneven> = (0..copies).map(|_| Uneven(Inside::new(engine))).collect();
            let truth = Truth::of(&Declared { name: String::new(), ..engine.into() });
            let mut askers: Vec<&mut dyn Subject> =
                all.iter_mut().map(|one| one as &mut dyn Subject).collect();
            let found = run(&mut askers, &options, &truth, &|_| ());
            format!("{:?} {:?} {:?}", found.rows, found.failing, found.incidents)
        };
        let one = found(1);
        assert!(one.contains("stopped: true") && one.contains("stopped: false"), "{one}");
        for copies in [2, 5, 8, 8, 8] {
            assert_eq!(found(copies), one, "{copies}");
        }
    }
}
