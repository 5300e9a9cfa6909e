//! A verdict for machines.

use serde::Serialize;
use serde_json::{Value, json};

use super::study::{Found, Places};
use rasterproof_judge::verdict::{Scores as _, Verdict as Judgement};
use rasterproof_precision::cost::{Recorded, prices};
use rasterproof_registry::digest::DigestRow;
use rasterproof_registry::published_check::SpecimenReport;
use rasterproof_study::cost::{Choice, Group};
use rasterproof_study::effects::{Need, Needs, State};
use rasterproof_study::hard::HardCases;
use rasterproof_study::{face_of, triangle_of};
use rasterproof_verify::cases::Kind;
use rasterproof_verify::comparison::{Verdict, shrink};

/// What `--json` prints: lines that can be read, or one line for what is as long as the plan of a large model.
pub fn text(data: &Value) -> String {
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

pub fn value(of: &impl Serialize) -> Value {
    // Numbers and strings only: this cannot fail.
    serde_json::to_value(of).unwrap_or_default()
}

/// The verdict as JSON; `repeat` gives the command that repeats a failing case.
pub fn verdict(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> Value {
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
        "off_grid_triangles": shapes[2], "families": verdict.families,
        "failures": failures.collect::<Vec<_>>(),
    })
}

/// Everything that was found of a program.
pub fn judgement(
    verdict: &Judgement,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Value {
    let d = &verdict.more.declared;
    let failures = verdict.failures.iter().map(|f| {
        json!({
            "property": f.evidence.property, "family": f.family, "index": f.index, "what": f.what,
            "shrunk": shrink::describe(&f.case), "how_far": f.evidence.shrunk, "window": f.case.window,
            "exchanges": f.evidence.exchanges, "repeat": repeat(f.family, f.index),
        })
    });
    let incidents = verdict.more.found.incidents.iter().map(|i| {
        let of_family = Some(i).filter(|i| !i.family.is_empty());
        json!({
            "family": i.family, "index": i.index, "word": i.what.breach.name(), "what": i.what.to_string(),
            "request": i.request, "repeat": of_family.map(|i| repeat(i.family, i.index)),
        })
    });
    let mut all = json!({
        "version": env!("CARGO_PKG_VERSION"), "program": d.name, "protocol": d.version,
        "declared": d.to_string(), "not_understood": d.unknown, "seed": verdict.options.seed,
        "cases": verdict.options.cases, "judged_cases": verdict.more.found.cases,
        "all_cases": verdict.more.found.of_cases, "out_of_time": verdict.more.found.out_of_time,
        "known_failures": verdict.more.known, "agrees": verdict.agrees(), "windings": verdict.more.windings,
        "recognised": verdict.more.recognised, "score_as_declared": verdict.as_declared(),
        "score_by_convention": verdict.by_convention(), "answers": verdict.more.found.answered,
        "properties": verdict.more.properties, "rows": verdict.families, "failures": failures.collect::<Vec<_>>(),
        "incidents": incidents.collect::<Vec<_>>(),
        "strays": verdict.more.found.strays.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "causes": verdict.cause, "line_reach": verdict.more.reach, "triangle_side": verdict.more.side, "stderr": verdict.more.complaints, "repeat": repeat_all,
    });
    if let Some(second) = &verdict.more.against {
        all["against"] = json!({
            "program": second.name, "declared": second.to_string(), "sides": verdict.sides(),
        });
    }
    all
}

/// The survey of the specimens as JSON; an infinite error is `null`.
pub fn specimens(seed: u64, cases: u64, reports: &[SpecimenReport]) -> Value {
    json!({ "version": env!("CARGO_PKG_VERSION"), "seed": seed, "cases": cases, "specimens": reports })
}

/// What every engine computes, hashed, and all of it together.
pub fn digest(seed: u64, cases: u64, parts: &[DigestRow], all: &str) -> Value {
    json!({ "seed": seed, "cases": cases, "parts": parts, "sha256": all })
}

/// The boards of `cost` as JSON, with what exact coverage costs and the choices that nobody needs.
/// [`Recorded::read`] takes it back.
pub fn cost(recorded: &Recorded) -> Value {
    let boards = &recorded.boards;
    let verdicts: Vec<_> = boards
        .iter()
        .flat_map(|board| board.ranking().map(move |measure| (board, measure)))
        .map(|(board, measure)| {
            let named = |choice: usize| &*board.choices[choice].name;
            let best = |column: usize| {
                let best = board.best(column, measure)?;
                let name = |choice: Option<usize>| choice.map(named);
                Some(json!({
                    "column": board.columns[column].name, "fastest": named(best.fastest),
                    "cheapest_good": name(best.good), "cheapest_certain": name(best.certain),
                }))
            };
            let dominated = board.dominated(measure).into_iter().map(|d| {
                let by: Vec<_> = d.by.into_iter().map(named).collect();
                json!({ "choice": named(d.choice), "by": by })
            });
            json!({
                "group": board.ladder, "measure": board.measures[measure].title,
                "best": board.columns_run().filter_map(best).collect::<Vec<_>>(),
                "dominated": dominated.collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "version": recorded.version, "repeat": recorded.repeat, "seed": recorded.seed,
        "quick": recorded.quick, "boards": boards,
        "verdicts": verdicts, "price_of_exact_coverage": prices(boards),
    })
}

/// The engines on the triangles of a model.
#[derive(Serialize)]
pub struct OnModel<'a> {
    pub scene: &'a str,
    pub hard_cases: Value,
    pub engines: Vec<Engine>,
    pub pieces: usize,
    pub not_judged: usize,
    /// Nothing where nothing was compared.
    pub agrees: Option<bool>,
}

#[derive(Serialize)]
pub struct Engine {
    pub engine: &'static str,
    pub fault: Option<String>,
    pub face: Option<u32>,
}

pub fn study(subject: &Places<'_>, found: &Found<'_>, answers: &impl Serialize) -> Value {
    let (scene, hard) = (subject.scene, found.hard);
    json!({
        "scene": scene.name, "triangles": scene.triangles(), "pieces": found.pieces,
        "loading_s": found.loading_s, "answers": answers,
        "hard_cases": hard_cases(subject, hard), "decided": hard.classes,
        "effects": needs(found.needs, found.not_drawn), "costs": costs(subject, found.costs),
    })
}

pub fn hard_cases(subject: &Places<'_>, found: &HardCases) -> Value {
    let face = |&triangle: &u32| {
        let origin = triangle_of(subject.scene, triangle)
            .and_then(|(item, number)| Some((subject.origins.get(item)?, number)));
        json!({
            "face": face_of(subject.scene, subject.origins, triangle),
            "line": origin.and_then(|(origin, number)| origin.lines.get(number)),
            "part": origin.map(|(origin, _)| &origin.part),
            "material": origin.map(|(origin, _)| &origin.material),
            "command": subject.command(triangle),
        })
    };
    let cases = found.cases.iter().map(|case| {
        json!({
            "kind": case.kind.name(), "count": case.count, "in_view": case.in_view,
            "pixels": case.pixels, "note": case.note,
            "faces": case.triangles.iter().map(face).collect::<Vec<_>>(),
        })
    });
    json!({
        "cases": cases.collect::<Vec<_>>(), "w": found.w, "f32_pixels": found.f32_pixels,
        "is_cut_short": found.is_cut_short,
    })
}

pub fn costs(subject: &Places<'_>, groups: &[Group]) -> Value {
    let group = |group: &Group| {
        let choice = |choice: &Choice| {
            let first = choice.first_wrong.map(|(of, [x, y])| {
                let face = of.map(|triangle| face_of(subject.scene, subject.origins, triangle));
                json!({ "pixel": [x, y], "face": face })
            });
            let time = choice.time.map(|time| [time.low, time.median, time.high]);
            let measures = 0..group.measures.len();
            let exact: Vec<_> = measures.filter(|one| group.is_exact(choice, *one)).collect();
            json!({
                "name": choice.name, "about": choice.about, "errors": choice.errors,
                "exact": exact, "first_wrong": first,
                "margin": choice.margin.filter(|margin| margin.is_finite()), "time_ns": time,
                "bytes": choice.bytes, "refused": choice.refused,
            })
        };
        let measures: Vec<_> = group.measures.iter().map(|measure| measure.title).collect();
        let name = |number: usize| &*group.choices[number].name;
        let best = (0..measures.len()).map(|number| group.cheapest_exact(number).map(name));
        let names = |all: &[usize]| all.iter().map(|&number| name(number)).collect::<Vec<_>>();
        let compared = group.best.iter().map(|best| {
            let best = best.as_ref()?;
            Some(json!({
                "choice": name(best.choice), "equally_fast": names(&best.equal),
                "undecided": names(&best.undecided), "rounds": best.rounds,
            }))
        });
        json!({
            "title": group.title, "measures": measures, "not_judged": group.not_judged,
            "timed": { "triangles": group.timed[0], "pixels": group.timed[1] },
            "choices": group.choices.iter().map(choice).collect::<Vec<_>>(),
            "cheapest_exact": best.collect::<Vec<_>>(),
            "compared": compared.collect::<Vec<_>>(),
        })
    };
    groups.iter().map(group).collect()
}

fn needs(needs: &Needs, not_drawn: &str) -> Value {
    let one = |need: &Need| {
        json!({
            "effect": need.effect.name(), "called_for": need.state() == State::CalledFor,
            "paid_for": need.is_paid_for, "materials": need.materials, "reasons": need.reasons,
            "pixels": need.pixels, "wrong_without": need.wrong,
            "otherwise_ns": [need.otherwise.low, need.otherwise.median, need.otherwise.high],
        })
    };
    json!({
        "effects": needs.needs.iter().map(one).collect::<Vec<_>>(),
        "planned_ns": [needs.planned.low, needs.planned.median, needs.planned.high],
        "textures": needs.textures, "not_supported": not_drawn,
    })
}
