//! Asks every case, block by block, on as many copies of the program as there are.
//!
//! Families take turns, so that a limited time is shared. Cases that leave the window come last.
//! A family stops at the third time the program had to be started again.

use std::collections::BTreeMap;
use std::ops::AddAssign;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Misbehaviour, Question, Subject};
use super::check::{Check, Truth};
use super::declared::Declared;
use super::judged::CaseJudgement;
use super::timed::Timed;
use rasterproof_verify::cases::{Case, Family};
use rasterproof_verify::comparison::Tally;

/// A family stops when the program has had to be started again this often.
pub const MOST_DEATHS: u64 = 3;
/// The judge stops when the program has had to be started again this often altogether.
pub const MOST_DEATHS_IN_ALL: u64 = 30;
/// It stops at fewer hangs and late answers, since each of these is waited for.
pub const MOST_HANGS_IN_ALL: u64 = 10;
/// Failing cases that are remembered for a baseline.
pub const MOST_REMEMBERED: usize = 1 << 20;
/// Failing cases of a property that are remembered without one, by each copy.
const KEPT: usize = 4;
pub const MOST_INCIDENTS: usize = 24;
/// Failing cases of a property that are asked a second time, by each copy. A program whose answers change seldom has few failing
/// cases, and of one whose answers change often one of these will do.
const MOST_ASKED_AGAIN: u64 = 64;
/// Cases of each family among which one is looked up beside those that are judged.
const BEFORE: u64 = 256;

/// What came of a property: of a family, or of a check over all families.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Row {
    pub name: &'static str,
    /// The check that its cases were judged by; none of polygons, and of a family that was given up before the first case.
    #[serde(skip)]
    pub check: Option<Check>,
    pub cases: u64,
    pub shapes: u64,
    /// Pixels expected, of four samples the samples, of the near plane the corners.
    pub pixels: u64,
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
    pub refused: u64,
    pub values: u64,
    /// Those of them that are beyond the tolerance.
    pub wrong_values: u64,
    /// The largest error of a value as a fraction of the tolerance.
    pub worst: f64,
    /// Times the program had to be started again.
    pub deaths: u64,
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
    pub neither: u64,
    /// What may be drawn either way, or is declared differently.
    pub both: u64,
    /// The same answers, which are wrong.
    pub same_but_wrong: u64,
}

impl Sides {
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

    fn new(name: &'static str, check: Option<Check>) -> Self {
        Self { name, check, ..Self::default() }
    }

    fn count(&mut self, judged: &CaseJudgement) {
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
        self.add_sides(judged.right.map(|right| Sides::of(right, judged.is_wrong())));
    }

    fn add_sides(&mut self, sides: Option<Sides>) {
        if let Some(sides) = sides {
            *self.sides.get_or_insert_default() += sides;
        }
    }
}

impl AddAssign<&Row> for Row {
    fn add_assign(&mut self, other: &Row) {
        self.cases += other.cases;
        self.shapes += other.shapes;
        self.pixels += other.pixels;
        self.wrong_cases += other.wrong_cases;
        self.tally += other.tally;
        self.recognised += other.recognised;
        self.recognised_pixels += other.recognised_pixels;
        self.unscored += other.unscored;
        self.unscored_wrong += other.unscored_wrong;
        self.refused += other.refused;
        self.values += other.values;
        self.wrong_values += other.wrong_values;
        self.worst = self.worst.max(other.worst);
        self.deaths += other.deaths;
        self.stopped |= other.stopped;
        self.add_sides(other.sides);
    }
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Failing {
    pub property: &'static str,
    pub family: &'static str,
    pub index: u64,
    /// Changes when what is wrong changes.
    pub fingerprint: u64,
}

impl Failing {
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

#[derive(Clone, Debug, Default)]
pub struct RunFindings {
    pub rows: Vec<Row>,
    pub failing: Vec<Failing>,
    /// The first case of each property whose answers changed.
    pub changing: Vec<Changing>,
    /// What is wrong in words, by [`Failing::name`], of the first few of each property.
    pub described: BTreeMap<String, String>,
    /// Cases that were judged, by property and family, where they are remembered.
    pub judged: Vec<(&'static str, &'static str, u64)>,
    /// Whether more failed than are remembered.
    pub forgot: bool,
    pub incidents: Vec<Incident>,
    /// What went wrong without a single request at fault.
    pub strays: Vec<Misbehaviour>,
    pub answered: u64,
    /// Cases of which all was answered, and those that there are.
    pub cases: u64,
    pub of_cases: u64,
    /// Whether the time was up before all cases were judged.
    pub out_of_time: bool,
    pub gave_up: bool,
    pub seconds: f64,
}

impl RunFindings {
    fn row(&mut self, name: &'static str, check: Option<Check>) -> &mut Row {
        let at = self.rows.iter().position(|row| row.name == name).unwrap_or_else(|| {
            self.rows.push(Row::new(name, check));
            self.rows.len() - 1
        });
        &mut self.rows[at]
    }

    fn change(&mut self, changing: Changing) {
        if self.changing.iter().all(|first| first.failing.property != changing.failing.property) {
            self.changing.push(changing);
        }
    }

    /// What is wrong that no recognised convention explains, one check of each kind.
    #[must_use]
    pub fn unexplained(&self) -> Vec<Check> {
        let is_explained = |row: &Row| {
            row.recognised_pixels > 0 && row.recognised.total() == 0 && row.unscored == 0
        };
        let is_wrong = |row: &&Row| match row.check {
            Some(Check::Values) => row.worst > 1.0,
            _ => row.tally.total() > 0 && !is_explained(row),
        };
        checks_of(self.rows.iter().filter(is_wrong))
    }

    fn merge(&mut self, other: Self) {
        for row in &other.rows {
            *self.row(row.name, row.check) += row;
        }
        self.failing.extend(other.failing);
        other.changing.into_iter().for_each(|changing| self.change(changing));
        self.described.extend(other.described);
        self.out_of_time |= other.out_of_time;
        self.judged.extend(other.judged);
        self.forgot |= other.forgot;
        self.incidents.extend(other.incidents);
        self.strays.extend(other.strays);
        self.answered += other.answered;
        self.cases += other.cases;
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

/// Two passes: cases within their windows, then those that leave it.
const PASSES: [bool; 2] = [false, true];

struct Shared<'a> {
    families: Vec<&'static Family>,
    options: &'a Options,
    truth: &'a Truth,
    start: Instant,
    /// When the time of each pass is over; the first one leaves a quarter.
    ends: [Option<Instant>; 2],
    copies: u64,
    deaths: Vec<AtomicU64>,
    deaths_in_all: AtomicU64,
    /// Those among them that had to be waited for.
    hangs: AtomicU64,
    answered: AtomicU64,
}

impl Shared<'_> {
    fn gave_up(&self) -> bool {
        let deaths = self.deaths_in_all.load(Ordering::Relaxed);
        // One that has never answered is given up sooner.
        let most = match self.answered.load(Ordering::Relaxed) {
            0 => 2 * MOST_DEATHS,
            _ => MOST_DEATHS_IN_ALL,
        };
        deaths >= most || self.hangs.load(Ordering::Relaxed) >= MOST_HANGS_IN_ALL
    }

    /// Whether the time of a pass is over.
    fn expired(&self, pass: bool) -> bool {
        self.ends[usize::from(pass)].is_some_and(|end| Instant::now() >= end)
    }
}

/// How many cases put at least one question to a program that declares this.
#[must_use]
pub fn cases_of(options: &Options, declared: &Declared) -> u64 {
    // The questions of a case depend on its family and on its number modulo 8.
    const PERIOD: u64 = 8;
    let of_family = |family: &&Family| {
        let is_asked = |index: &u64| {
            let case = adapt_case::case(family, options.seed, *index, declared);
            !Check::of(family.name, &case, *index, declared).is_empty()
        };
        if let Some(index) = options.only {
            return u64::from(is_asked(&index));
        }
        let (whole, rest) = (options.cases / PERIOD, options.cases % PERIOD);
        let asked = |below: u64| (0..below).filter(is_asked).count() as u64;
        whole * asked(if whole > 0 { PERIOD } else { 0 }) + asked(rest)
    };
    let families = adapt_case::families(&options.families);
    families.iter().map(of_family).fold(0, u64::saturating_add)
}

pub fn run(
    askers: &mut [&mut dyn Subject],
    options: &Options,
    truth: &Truth,
    progress: &(dyn Fn(u64) + Sync),
) -> RunFindings {
    let families = adapt_case::families(&options.families);
    let start = Instant::now();
    let end = |share: f64| options.time_limit.map(|limit| start + limit.mul_f64(share));
    let shared = Shared {
        ends: [end(0.75), end(1.0)],
        deaths: families.iter().chain(&families).map(|_| AtomicU64::new(0)).collect(),
        families,
        options,
        truth,
        start,
        copies: askers.len() as u64,
        deaths_in_all: AtomicU64::new(0),
        hangs: AtomicU64::new(0),
        answered: AtomicU64::new(0),
    };
    let all = Mutex::new(Vec::new());
    let waiting = Mutex::new((0..).zip(askers.iter_mut()));
    let next = || waiting.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
    let work = || {
        while let Some((part, asker)) = next() {
            let found = copy(&mut **asker, part, &shared, progress);
            all.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((part, found));
        }
    };
    std::thread::scope(|scope| {
        // This thread is one of them; where the system refuses others, it works off all copies.
        for _ in 1..shared.copies {
            if std::thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let mut parts = all.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    parts.sort_by_key(|(part, _)| *part);
    let mut whole = RunFindings::default();
    parts.into_iter().for_each(|(_, found)| whole.merge(found));
    whole.failing.sort_by_key(|f| {
        let family = shared.families.iter().position(|family| family.name == f.family);
        (family, f.index, f.property)
    });
    whole.gave_up = shared.gave_up();
    whole.of_cases = cases_of(options, &truth.declared);
    whole.out_of_time &= whole.cases < whole.of_cases;
    whole.seconds = shared.start.elapsed().as_secs_f64();
    for (family, deaths) in shared.families.iter().cycle().zip(&shared.deaths) {
        if deaths.load(Ordering::Relaxed) >= MOST_DEATHS {
            whole.row(family.name, None).stopped = true;
        }
    }
    whole
}

/// Judges with one copy of the program: it takes the blocks whose number, modulo the copies, is `part`. `progress`
/// hears how many cases were judged.
fn copy(
    asker: &mut dyn Subject,
    part: u64,
    shared: &Shared<'_>,
    progress: &(dyn Fn(u64) + Sync),
) -> RunFindings {
    let mut found = RunFindings::default();
    let cases = shared.options.numbers();
    let mut asker = Timed::new(asker, None);
    for pass in PASSES {
        asker.end = shared.ends[usize::from(pass)];
        let mut first = cases.start;
        let mut number = 0;
        'rounds: while first < cases.end {
            // Where the time is limited, blocks begin small: of a slow program each family is asked.
            let most = match shared.options.time_limit {
                Some(_) => asker.cases_at_once().min(1 << number.min(32)),
                None => asker.cases_at_once(),
            };
            let end = cases.end.min(first.saturating_add(most));
            for (at, family) in shared.families.iter().enumerate() {
                if shared.expired(pass) {
                    found.out_of_time = true;
                    break 'rounds;
                }
                let deaths = &shared.deaths[at + usize::from(pass) * shared.families.len()];
                let stop = deaths.load(Ordering::Relaxed) >= MOST_DEATHS || shared.gave_up();
                // Families are dealt out like cards, so that one copy is not left with the slow ones.
                if (number + at as u64) % shared.copies == part && !stop {
                    let judged =
                        block(&mut asker, family, first..end, pass, shared, deaths, &mut found);
                    found.cases += judged;
                    progress(judged);
                }
            }
            number += 1;
            first = end;
        }
    }
    found.out_of_time |= asker.is_late;
    found.strays.extend(asker.strays());
    found
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
    // The windings are found with the first cases of a family that may not be among those that are judged.
    let indices = options
        .numbers()
        .map(|index| (index, &asked))
        .chain((0..BEFORE).map(|index| (index, &all)));
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

/// Asks the checks of some cases of a family, and judges the answers: of how many cases all of them.
fn block(
    asker: &mut dyn Subject,
    family: &'static Family,
    indices: std::ops::Range<u64>,
    pass: bool,
    shared: &Shared<'_>,
    deaths: &AtomicU64,
    found: &mut RunFindings,
) -> u64 {
    let truth = shared.truth;
    let mut jobs: Vec<(u64, usize, Check, usize)> = Vec::new();
    let mut cases: Vec<Case> = Vec::new();
    let mut questions: Vec<Question> = Vec::new();
    for index in indices {
        let case = adapt_case::case(family, shared.options.seed, index, &truth.declared);
        if adapt_case::leaves_window(&case) != pass {
            continue;
        }
        for check in Check::of_truth(family.name, &case, index, truth) {
            let start = questions.len();
            check.questions(&case, truth, &mut questions);
            jobs.push((index, start, check, cases.len()));
        }
        cases.push(case);
    }
    let left = MOST_DEATHS.saturating_sub(deaths.load(Ordering::Relaxed));
    let answers = asker.ask(&questions, left.max(1));
    let mut whole = 0;
    let mut wrong = Vec::new();
    for (at, (index, first, check, case)) in jobs.iter().enumerate() {
        let next = jobs.get(at + 1).map_or(questions.len(), |(_, next, ..)| *next);
        // Where the program was given up, the rest of the answers is not there.
        let here = &answers[*first.min(&answers.len())..next.min(answers.len())];
        let is_whole = here.len() == next - first;
        let judged = match (is_whole, here.iter().any(Answer::is_death)) {
            (false, false) => break,
            (true, _) => check.judge(&cases[*case], here, truth),
            (false, true) => Check::judge_deaths(here),
        };
        let died = judged.died.len() as u64;
        deaths.fetch_add(died, Ordering::Relaxed);
        shared.deaths_in_all.fetch_add(died, Ordering::Relaxed);
        let slow = judged.died.iter().filter(|(_, what)| what.is_slow()).count();
        shared.hangs.fetch_add(slow as u64, Ordering::Relaxed);
        shared.answered.fetch_add(judged.answered, Ordering::Relaxed);
        let asked = &questions[*first..next];
        note(found, family, *index, *check, &judged, (asked, shared.options.terms.remember));
        let property = check.name(family.name);
        if judged.is_wrong()
            && died == 0
            && found.row(property, Some(*check)).wrong_cases <= MOST_ASKED_AGAIN
        {
            wrong.push((Failing::new(family, *index, *check, &judged), *check, *first..next));
        }
        let is_last = jobs.get(at + 1).is_none_or(|(.., next)| next != case);
        whole += u64::from(is_last);
    }
    let mut asked_again = Vec::new();
    for (.., range) in &wrong {
        asked_again.extend_from_slice(&questions[range.clone()]);
    }
    if !asked_again.is_empty() {
        let again = asker.ask(&asked_again, left.max(1));
        shared.answered.fetch_add(again.len() as u64, Ordering::Relaxed);
        ask_again(&wrong, &questions, &answers, &again, found);
    }
    whole
}

/// Notes which of the failing cases are answered otherwise `again`. Where answers are missing, the time is up or the program was
/// given up.
fn ask_again(
    wrong: &[(Failing, Check, std::ops::Range<usize>)],
    questions: &[Question],
    answers: &[Answer],
    again: &[Answer],
    found: &mut RunFindings,
) {
    let mut rest = again;
    for (failing, check, range) in wrong {
        let Some((again, after)) = rest.split_at_checked(range.len()) else { return };
        rest = after;
        let first = &answers[range.clone()];
        if !first.iter().zip(again).all(|(first, again)| first.is_same(again)) {
            found.change(Changing {
                failing: failing.clone(),
                check: *check,
                questions: questions[range.clone()].to_vec(),
                answers: [first.to_vec(), again.to_vec()],
            });
        }
    }
}

fn note(
    found: &mut RunFindings,
    family: &'static Family,
    index: u64,
    check: Check,
    judged: &CaseJudgement,
    (asked, remember): (&[Question], bool),
) {
    let property = check.name(family.name);
    found.answered += judged.answered;
    found.row(property, Some(check)).count(judged);
    if remember {
        found.judged.push((property, family.name, index));
    }
    for (at, what) in &judged.died {
        if found.incidents.len() < MOST_INCIDENTS {
            let request = asked.get(*at).map_or_else(String::new, |q| q.text(1));
            found.incidents.push(Incident {
                family: family.name,
                index,
                what: what.clone(),
                request,
            });
        }
    }
    if judged.is_wrong() {
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
