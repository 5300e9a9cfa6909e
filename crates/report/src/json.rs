//! A verdict for machines.

use serde::Serialize;
use serde_json::{Value, json};

use rasterproof_judge::verdict::{Score, Scores as _, Verdict as Judgement};
use rasterproof_registry::digest::DigestRow;
use rasterproof_verify::cases::Kind;
use rasterproof_verify::cases::facts::asked::DesignShare;
use rasterproof_verify::comparison::{Verdict, shrink};

/// What `--json` prints: lines that can be read, or one line for what is as long as the plan of a large model.
pub fn text(data: &Value) -> String {
    /// The longest file that is read back.
    const MOST_READ_BYTES: usize = 1 << 16;
    let line = data.to_string();
    if line.len() > MOST_READ_BYTES { line + "\n" } else { pretty(data) }
}

/// A line of JSON, for files that no person reads.
pub fn line(of: &impl Serialize) -> String {
    // Numbers and strings only: this cannot fail.
    serde_json::to_string(of).unwrap_or_default()
}

pub fn pretty(value: &impl Serialize) -> String {
    // Numbers and strings only: this cannot fail.
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

/// A value as JSON; nothing that is written here can fail.
pub fn value(of: &impl Serialize) -> Value {
    // Numbers and strings only: this cannot fail.
    serde_json::to_value(of).unwrap_or_default()
}

/// The verdict as JSON, with what the designs asked; `repeat` gives the command that repeats a failing case.
pub fn verdict(
    verdict: &Verdict,
    asked: &[DesignShare],
    repeat: &dyn Fn(&str, u64) -> String,
) -> Value {
    let failures = verdict.failures.iter().map(|f| {
        json!({
            "family": f.family, "index": f.index, "pair": f.evidence.pair, "what": f.what,
            "shrunk": shrink::describe(&f.case), "window": f.case.window,
            "repeat": repeat(f.family, f.index),
        })
    });
    let shapes = Kind::ALL.map(|(kind, _)| verdict.sum(kind, |family| family.shapes));
    let (part, parts) = (verdict.options.shard.part(), verdict.options.shard.parts());
    json!({
        "version": env!("CARGO_PKG_VERSION"), "seed": verdict.options.seed,
        "cases": verdict.options.cases, "shard": format!("{part}/{parts}"),
        "agrees": verdict.agrees(), "mismatches": verdict.mismatches(),
        "comparisons": verdict.comparisons(), "triangles": shapes[0], "lines": shapes[1],
        "off_grid_triangles": shapes[2], "families": verdict.families, "asked": asked,
        "failures": failures.collect::<Vec<_>>(),
    })
}

/// Everything that was found of a program.
pub fn judgement(
    verdict: &Judgement,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Value {
    // Lists are made first, since the macro takes values.
    let d = &verdict.more.declared;
    let failures = verdict.failures.iter().map(|f| {
        json!({
            "property": f.evidence.property, "also": f.evidence.also, "family": f.family, "index": f.index, "what": f.what,
            "shrunk": shrink::describe(&f.case), "how_far": f.evidence.shrunk.name(), "window": f.case.window,
            "exchanges": f.evidence.exchanges, "repeat": repeat(f.family, f.index),
        })
    });
    let incidents = verdict.more.found.incidents.iter().map(|i| {
        // What happened before the families cannot be repeated by one of them.
        let of_family = Some(i).filter(|i| !i.family.is_empty());
        json!({
            "family": i.family, "index": i.index, "word": i.what.breach.name(), "what": i.what.to_string(),
            "request": i.request, "repeat": of_family.map(|i| repeat(i.family, i.index)),
        })
    });
    let left_out = verdict.more.left_out;
    // What else was counted than pixels.
    let counts = verdict.counts().into_iter().map(|count| {
        let Score { wrong, pixels, .. } = count.score;
        json!({ "what": count.what.name(), "wrong": wrong, "of": pixels })
    });
    // Names of members are part of the format, and stay.
    let mut all = json!({
        "version": env!("CARGO_PKG_VERSION"), "program": d.name, "protocol": d.version,
        "declared": d.to_string(), "not_understood": d.unknown, "seed": verdict.options.seed,
        "cases": verdict.options.cases, "judged_cases": verdict.more.found.cases,
        "all_cases": verdict.more.found.of_cases, "out_of_time": verdict.more.found.out_of_time,
        "left_out": {
            "convention": left_out.convention, "cases": left_out.cases, "shrinking": left_out.shrinking, "cause": left_out.cause,
        },
        "known_failures": verdict.more.known, "agrees": verdict.agrees(), "windings": verdict.more.windings,
        "recognised": verdict.more.recognised, "score_as_declared": verdict.as_declared(),
        "score_by_convention": verdict.by_convention(), "counts": counts.collect::<Vec<_>>(), "asked": verdict.more.asked, "answers": verdict.more.found.answered,
        "properties": verdict.more.properties, "rows": verdict.families, "failures": failures.collect::<Vec<_>>(),
        "incidents": incidents.collect::<Vec<_>>(),
        "strays": verdict.more.found.strays.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "causes": verdict.cause, "line_reach": verdict.more.reach, "triangle_side": verdict.more.side, "stderr": verdict.more.complaints.shown, "stderr_lines": verdict.more.complaints.lines, "repeat": repeat_all,
    });
    if let Some(second) = &verdict.more.against {
        all["against"] = json!({
            "program": second.name, "declared": second.to_string(), "sides": verdict.sides(),
        });
    }
    all
}

/// What every engine computes, hashed, and all of it together.
pub fn digest(seed: u64, cases: u64, parts: &[DigestRow], all: &str) -> Value {
    json!({ "seed": seed, "cases": cases, "parts": parts, "sha256": all })
}
