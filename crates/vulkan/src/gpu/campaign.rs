//! A device judged: the families by the judge of programs, then the stages, each with its rule.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use super::engine::Gpu;
use super::known::{self, KnownFault};
use super::outcome::Requirement;
use super::requirements;
use super::specified::Specified;
use crate::device::find::About;
use rasterproof_judge::ask::{Answer, Complaints, Question, Subject};
use rasterproof_judge::check::{Check, Truth};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::run::{Failing, Row, RunFindings, run};
use rasterproof_judge::verdict::{Outcome, Particulars, Verdict, sentence, verdict};
use rasterproof_judge::windings as first_stages;
use rasterproof_judge::{Explained, Options, Patience, adapt_case, explain, for_families};
use rasterproof_verify::cases::{self, Case};
use rasterproof_verify::judge::AFTER_FAILURE;
use rasterproof_verify::specification::{Clause, Standing, VULKAN};

/// Cases of a stage for each case of a family.
const STAGE_SHARE: u64 = 2;
/// A device is asked this many cases of a stage at most.
const MOST_OF_A_STAGE: u64 = 2048;

/// What came of a device.
#[derive(Clone, Debug)]
pub struct DeviceReport {
    pub about: About,
    pub plant: Option<&'static str>,
    pub verdict: Verdict,
    pub findings: Vec<Requirement>,
    /// Known faults of this driver that were seen, or not any more.
    pub known: Vec<String>,
}

impl DeviceReport {
    /// Whether nothing was found that the specification forbids and nobody knew.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.findings.iter().all(|f| f.class.is_good())
    }
}

/// The device as somebody who is asked, while somebody else still holds it.
struct SharedDevice(Arc<Mutex<Gpu>>, Declared);

/// A device whose holder panicked is opened anew after its failure, so it can be asked on.
fn lock(gpu: &Mutex<Gpu>) -> MutexGuard<'_, Gpu> {
    gpu.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Subject for SharedDevice {
    fn declared(&self) -> &Declared {
        &self.1
    }

    fn cases_at_once(&self) -> u64 {
        lock(&self.0).cases_at_once()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        lock(&self.0).ask(questions, most_deaths)
    }

    fn complaints(&self) -> Complaints {
        lock(&self.0).complaints()
    }
}

/// The families that a device is asked: values of f32 end before w does, lines have a stage of their
/// own, and depth tests and the near plane are not asked.
pub fn families(wanted: &[String]) -> Vec<String> {
    let mut asked = Vec::new();
    for family in adapt_case::families(wanted) {
        let is_of_triangles = cases::triangles::FAMILIES.iter().any(|t| t.name == family.name);
        if is_of_triangles && family.name != "w-extreme" {
            asked.push(family.name.to_owned());
        }
    }
    asked
}

/// Judges a device with the known faults of its driver.
#[must_use]
pub fn judge(gpu: Gpu, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> DeviceReport {
    let known = known::of(&known::parse(known::TEXT).unwrap_or_default(), gpu.about());
    judge_with(gpu, options, &known, progress)
}

/// The same with other known faults, for tests.
#[must_use]
pub fn judge_with(
    gpu: Gpu,
    options: &Options,
    known: &[KnownFault],
    progress: &(dyn Fn(u64) + Sync),
) -> DeviceReport {
    let start = Instant::now();
    let end = options.time_limit.map(|limit| start + limit);
    let about = gpu.about().clone();
    let plant = gpu.plant_name();
    let declared = gpu.declared().clone();
    // The device answers the families as a program would, and is needed again for the stages after them.
    let gpu = Arc::new(Mutex::new(gpu));
    let mut shared = SharedDevice(Arc::clone(&gpu), declared.clone());
    let mut options = options.clone();
    options.families = families(&options.families);
    options.terms.remember = true;
    let mut truth = Truth::of(&declared);
    truth.expect = Box::new(Specified::new(&declared));
    // The specification asks for less than the oracle: either of two triangles has a shared sample.
    let open = declared.convention.rule(VULKAN.edges);
    truth.recognised = Some(Box::new(open));
    let windings = first_stages::windings(&mut shared, options.seed);
    let mut found = run(&mut [&mut shared], &for_families(&options, start), &truth, progress);
    let first = &mut shared;
    // From here on what is known of the driver counts no more; it is kept to see whether it still fails.
    let is_news = |f: &Failing| !is_known(known, f, &options, &declared);
    let (news, old): (Vec<_>, Vec<_>) = found.failing.drain(..).partition(is_news);
    found.failing = news;
    // Asked again, a triangle is drawn in another cell of the page, where its values may round otherwise.
    found.changing.retain(|changing| is_news(&changing.failing) && changing.check != Check::Values);
    // Answers that change have no cause that could be recognised.
    let is_explained = !found.failing.is_empty() && found.changing.is_empty();
    let patience = options.time_limit.is_none().then_some(AFTER_FAILURE / 2);
    let scope = Scope { triangles: true, lines: false, always: false, patience };
    let recognised = if is_explained { recognise(first, scope) } else { None };
    let patience = Patience::of(&options, end, recognised.as_ref());
    let Explained { failures, causes, left_out } =
        explain(first, &found, &options, &truth, recognised.as_ref(), patience, &|_| ());
    let stale = stale(known, &found, &old, &options, &declared);
    let complaints = first.complaints();
    let said = recognised.map(|r| r.said);
    let more = Particulars {
        declared,
        windings,
        recognised: said,
        found,
        complaints,
        left_out,
        ..Particulars::default()
    };
    let mut verdict = verdict(&options, more, failures, causes);
    let mut findings = of_rows(&mut verdict, &old, &stale);
    drop(shared);
    // A single case is repeated without the stages, which are no cases of a family.
    if options.only.is_none() {
        let cases = (options.cases * STAGE_SHARE).clamp(16, MOST_OF_A_STAGE);
        findings.extend(requirements::all(&mut lock(&gpu), options.seed, cases, known));
    }
    let known = known.iter().map(|k| k.about.clone()).collect();
    DeviceReport { about, plant, verdict, findings, known }
}

/// The case as this device was asked it.
fn case_of(family: &str, index: u64, options: &Options, declared: &Declared) -> Option<Case> {
    let family = cases::families().find(|f| f.name == family)?;
    Some(adapt_case::case(family, options.seed, index, declared))
}

/// Whether a known fault says that this case fails.
fn is_known(
    known: &[KnownFault],
    failing: &Failing,
    options: &Options,
    declared: &Declared,
) -> bool {
    match case_of(failing.family, failing.index, options, declared) {
        Some(case) => known.iter().any(|k| k.covers(failing.property, &case)),
        None => false,
    }
}

/// Properties of which a known fault says that cases fail, of which some were judged and none did.
fn stale(
    known: &[KnownFault],
    found: &RunFindings,
    old: &[Failing],
    options: &Options,
    declared: &Declared,
) -> Vec<String> {
    // Whether a case was judged that the fault says fails. Cases are made anew to see it, so this is asked last.
    let was_judged = |k: &KnownFault, property: &str| {
        for (name, family, index) in &found.judged {
            let case =
                if *name == property { case_of(family, *index, options, declared) } else { None };
            if case.is_some_and(|case| k.covers(property, &case)) {
                return true;
            }
        }
        false
    };
    let mut stale = Vec::new();
    for k in known {
        for property in k.certain() {
            let fails = old.iter().any(|failing| failing.property == property);
            if !fails && was_judged(k, property) {
                stale.push(property.to_owned());
            }
        }
    }
    stale
}

/// The rule by which a property is judged.
fn rule(property: &str) -> Clause {
    VULKAN.clause(match property {
        "values" => "perspective",
        "samples4" => "samples",
        _ => "polygons",
    })
}

/// Every row with its rule; the verdict's properties come out alike.
fn of_rows(verdict: &mut Verdict, old: &[Failing], stale: &[String]) -> Vec<Requirement> {
    let mut findings = Vec::new();
    for row in &verdict.families {
        // A row of a property, and what is known of it.
        let is_of = |f: &&Failing| f.property == row.name;
        let known = old.iter().filter(is_of).count();
        let news = verdict.more.found.failing.iter().filter(is_of).count();
        let class = class(row, known, news, stale);
        let mut detail = sentence(row);
        if known > 0 {
            detail += &format!("; {known} as the baseline says, {news} new");
        }
        findings.push(Requirement {
            name: row.name.to_owned(),
            rule: rule(row.name),
            class,
            detail,
        });
    }
    // What the judge of programs calls a failure may be allowed here, so its outcomes follow the findings.
    for property in &mut verdict.more.properties {
        if let Some(finding) = findings.iter().find(|f| f.name == property.name) {
            property.outcome = match finding.class {
                Standing::Known => Outcome::ExpectedFailure,
                Standing::Stale => Outcome::UnexpectedPass,
                class if class.is_good() => Outcome::Pass,
                _ => Outcome::Fail,
            };
        } else if !property.outcome.is_good() {
            // That it draws, in both windings, and answers.
            let (name, detail) = (property.name.to_owned(), property.detail.clone());
            let class = if name == "protocol" { Standing::NoAnswer } else { Standing::Outside };
            findings.push(Requirement { name, rule: VULKAN.clause("polygons"), class, detail });
        }
    }
    findings
}

/// How the device stands to the rule of a row, of whose failing cases so many are known and so many are new.
fn class(row: &Row, known: usize, news: usize, stale: &[String]) -> Standing {
    // Checks that compare answers have no second opinion: what they find is no matter of ties.
    let compares = ["watertight", "vertex-order", "samples4"].contains(&row.name);
    match (news, known) {
        (0, 0) if stale.iter().any(|name| name == row.name) => Standing::Stale,
        (0, 0) => Standing::Equal,
        (0, _) => Standing::Known,
        _ if row.deaths > 0 => Standing::NoAnswer,
        _ if row.recognised.total() == 0 && row.worst <= 1.0 && !compares => Standing::Allowed,
        _ => Standing::Outside,
    }
}
