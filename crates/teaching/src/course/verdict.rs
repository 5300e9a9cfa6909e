//! How a step came out, for people.

use super::examine::Outcome;
use super::progress::Progress;
use super::{STEPS, Step, number};
use rasterproof_judge::failures::{Exchange, Exchanged, Failure};
use rasterproof_report::html::{Excerpt, Report};
use rasterproof_report::judge_text;
use rasterproof_report::words::noun;
use rasterproof_verify::mistakes::Mistakes;

/// How a step came out, with its smallest failing case and how to ask for it again.
pub fn report(step: &Step, outcome: &Outcome, command: &str) -> Report {
    let Outcome { cases, wrong, .. } = outcome;
    // Why the rest was not asked, if it was not.
    let late = match outcome {
        Outcome { out_of_time: true, .. } => ", and the time was up",
        Outcome { given_up: true, .. } => ", and it ended too often before it had answered",
        _ => "",
    };
    let came_out = match outcome.passes() {
        true => format!("PASSED, {cases} {}", noun(*cases, "case", "cases")),
        false => {
            let of = noun(*cases, "case", "cases");
            format!("NOT YET, wrong in {wrong} of {cases} {of}{late}")
        }
    };
    let about = format!("step {}, {}: {came_out}", number(step), step.title);
    let Some(failure) = &outcome.failure else { return Report { about, ..Report::default() } };
    let Failure { what, family, index, evidence, .. } = failure;
    let Exchanged { shrunk, exchanges, .. } = evidence;
    // A case of one request can be asked again by hand; where several were needed, no single line shows it.
    let again = match &exchanges[..] {
        [Exchange { request, .. }] => format!("echo '{request}' | {command}"),
        _ => String::new(),
    };
    // The case with its pixels, as the judge of programs shows it.
    let excerpt = judge_text::excerpt(failure, &["yours"], again);
    let title = format!("smallest found: {what} (from {family} #{index}, {})", shrunk.name());
    let mut notes = Vec::new();
    // What was recognised of its answers, the most particular first.
    if let Some(misconception) = outcome.misconception {
        notes.push(format!("it looks as if {}", misconception.says));
        notes.push(format!("think about: {}", misconception.ask));
    }
    // What it does, and not what repairs it: that is the exercise.
    let cause = outcome.cause.as_ref();
    if let Some(does) = cause.and_then(Mistakes::does) {
        notes.push(format!("it looks as if it {does}"));
    } else if let Some(mostly) = cause.and_then(Mistakes::mostly_does) {
        notes.push(format!("mostly, it looks as if it {mostly}"));
    } else if outcome.misconception.is_none() {
        notes.push("no known mistake explains its answers".to_owned());
        notes.extend(cause.iter().flat_map(|cause| cause.common.iter().cloned()));
    }
    // The page of the first cause, which is the most likely one.
    if let Some(known) = cause.and_then(|cause| cause.causes.first()) {
        notes.push(format!("read: docs/{}.md", known.page));
    }
    Report { about, excerpts: vec![Excerpt { title, ..excerpt }], notes, ..Report::default() }
}

/// The step that follows one that was passed.
pub fn next(progress: &Progress) -> String {
    if STEPS.iter().all(|step| progress.has_passed(step)) {
        return "all eighteen steps are passed; next: rasterproof judge -- CMD".to_owned();
    }
    let next = progress.current();
    format!("next: step {}, {} ({}): {}", number(next), next.title, next.page, next.judged)
}

/// The first hints of a step, and the page that explains it.
pub fn hints(step: &Step, count: usize) -> Vec<String> {
    let hints = step.hints.iter().take(count).zip(1..);
    let page = format!("page: steps.md, step {} ({})", number(step), step.page);
    hints.map(|(hint, number)| format!("hint {number}: {hint}")).chain([page]).collect()
}
