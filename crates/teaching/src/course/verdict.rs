//! How a step came out, for people.

use super::examine::Outcome;
use super::{Step, number};
use rasterproof_judge::failures::{Exchange, Exchanged, Failure};
use rasterproof_report::judge_text;
use rasterproof_report::text::hanging;

/// How a step came out, with its smallest failing case and how to ask for it again.
pub fn text(step: &Step, outcome: &Outcome, command: &str) -> String {
    let (number, title) = (number(step), &step.title);
    let Outcome { cases, wrong, .. } = outcome;
    if outcome.passes() {
        return format!("step {number}, {title}: PASSED, {cases} cases\n");
    }
    let late = match outcome {
        Outcome { out_of_time: true, .. } => ", and the time was up",
        Outcome { given_up: true, .. } => ", and it ended too often before it had answered",
        _ => "",
    };
    let mut out =
        format!("step {number}, {title}: NOT YET, wrong in {wrong} of {cases} cases{late}\n");
    let Some(failure) = &outcome.failure else { return out };
    let Failure { what, family, index, evidence, .. } = failure;
    let Exchanged { shrunk, exchanges, picture, .. } = evidence;
    out += &indented(&format!("smallest found: {what} (from {family} #{index}, {shrunk})"), 2);
    for Exchange { request, answer, expected, .. } in exchanges.iter().take(2) {
        for (what, line) in [("request:", request), ("answer:", answer), ("expected:", expected)] {
            if !line.is_empty() {
                out += &indented(&format!("{what:<9} {line}"), 2);
            }
        }
    }
    if let Some(picture) = picture {
        out += &judge_text::grid(&["yours"], picture);
        if !picture.of.is_empty() {
            out += &(hanging(&format!("({})", picture.of), "  ", "   ") + "\n");
        }
    }
    if let [Exchange { request, .. }] = &exchanges[..] {
        out += &indented(&format!("again:    echo '{request}' | {command}"), 2);
    }
    if let Some(misconception) = outcome.misconception {
        out += &(hanging(misconception.says, "it looks as if ", "  ") + "\n");
        out += &(hanging(misconception.ask, "think about: ", "  ") + "\n");
    }
    // What it does, and not what repairs it: that is the exercise.
    let known = outcome.cause.as_ref().and_then(|cause| cause.causes.first());
    if let Some(cause) = known {
        out += &(hanging(&cause.does, "it looks as if it ", "  ") + "\n");
        out += &format!("read: docs/{}.md\n", cause.page);
    } else if outcome.misconception.is_none() {
        out += "no known mistake explains its answers\n";
    }
    out
}

pub fn indented(text: &str, indent: usize) -> String {
    format!("{:indent$}{}\n", "", text.trim_end())
}
