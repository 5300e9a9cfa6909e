//! Engines on the triangles of a model, against the oracle.

use std::fmt::Display;

use rasterproof_core::parallel;
use rasterproof_core::triangle::check_value;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::json::value;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words;
use rasterproof_verify::cases::{Case, Shape};

use super::studied::{Studied, has_pixel};
use super::{Places, hard_cases, json};
use crate::face_of;
use crate::view::Piece;

/// Pieces that are judged at once: no pixel is hit more often than a count of hits holds.
const CHUNK: usize = 128;

/// The hard cases of a model and what the engines get wrong on it, and whether they agree; nothing where nothing was
/// compared. `shown` names the file.
pub fn report(
    studied: &Studied<'_>,
    subject: &Places<'_>,
    judged: &EnginesToJudge,
    shown: impl Display,
) -> (Report, Option<bool>) {
    // The engines see samples as the picture has them, and values up to their limit.
    let window = studied.sampled.window;
    let drawn: Vec<&Piece> = studied.sampled.all().collect();
    let has_values = |piece: &&&Piece| {
        let uv = piece.triangle.vertices.iter().map(|vertex| vertex.varying);
        uv.flat_map(|uv| uv.to_array()).all(|value| check_value(value).is_ok())
    };
    let judgeable: Vec<&Piece> = drawn.iter().filter(has_values).copied().collect();
    let mut faults = Vec::new();
    let snapped = |chunk: &[&Piece]| {
        let list = chunk.iter().map(|piece| piece.triangle).collect();
        Case { window, shape: Shape::Triangles { list, disjoint: false } }
    };
    let unsnapped = |chunk: &[&Piece]| {
        Case::unsnapped(window, chunk.iter().filter_map(|piece| piece.free()).collect())
    };
    for &engine in &judged.triangles {
        faults.push((engine.name(), judge(&judgeable, &engine.into(), &snapped)));
    }
    for &engine in &judged.unsnapped {
        faults.push((engine.name(), judge(&judgeable, &engine.into(), &unsnapped)));
    }
    // To draw nothing where nothing is expected shows nothing of an engine.
    let expects = judgeable.iter().any(|piece| has_pixel(piece, window));
    let is_wrong = faults.iter().any(|(_, fault)| fault.is_some());
    let agrees = (expects || is_wrong).then_some(!is_wrong);
    if agrees.is_none() {
        faults.clear();
    }
    let (left, count) = (drawn.len() - judgeable.len(), judgeable.len());
    let engine = |(name, fault): &(&'static str, Option<Fault>)| {
        let face = fault.as_ref().and_then(|fault| fault.triangle);
        let face = face.map(|one| face_of(&studied.scene, studied.origins, one));
        json::Engine { engine: name, fault: fault.as_ref().map(|fault| fault.what.clone()), face }
    };
    let row = |(name, fault): &(&str, Option<Fault>)| {
        let what = fault.as_ref().map_or("agrees", |fault| &fault.what);
        let first = fault.as_ref().and_then(|fault| fault.triangle);
        let first =
            first.map(|one| format!("first at {}\n{}", subject.place(one), subject.command(one)));
        let name = format!("{name} against the oracle:");
        Row::of(&[&name, &what, &first.unwrap_or_default()]).marked(fault.is_none())
    };
    let why = "whose texture coordinates are too large for the engines";
    let is_left = (left > 0)
        .then(|| format!("not judged: {}, {why}", words::count(left as u64, "piece", "pieces")));
    let columns = "~engine 1 | ~found 1 | first fault";
    let engines = Table::new("", columns, faults.iter().map(row).collect());
    let engines = engines.judged().noted(Vec::from_iter(is_left));
    let pieces = words::count(count as u64, "piece", "pieces");
    let have = words::noun(count as u64, "has", "have");
    let report = Report {
        about: studied.head(),
        tables: vec![hard_cases(subject, &studied.hard, &[]), engines],
        outcome: Some(match agrees {
            Some(agrees) => Outcome::of(agrees, format!("{pieces} of {shown}")),
            None => Outcome::new(
                false,
                "NOT JUDGED",
                format!(
                    "the {pieces} of {shown} in the window {have} no pixel, so nothing was compared; \
                     look at it from another side (--yaw, --pitch, --zoom)"
                ),
            ),
        }),
        data: value(&json::OnModel {
            scene: &studied.scene.name,
            hard_cases: json::hard_cases(subject, &studied.hard),
            engines: faults.iter().map(engine).collect(),
            pieces: count,
            not_judged: left,
            agrees,
        }),
        ..Report::default()
    };
    (report, agrees)
}

/// What an engine gets wrong, and the first triangle for which it does so alone.
struct Fault {
    what: String,
    triangle: Option<u32>,
}

/// Judges an engine on all pieces, some of them together as a case.
fn judge(
    pieces: &[&Piece],
    engine: &EnginesToJudge,
    case: &(dyn Fn(&[&Piece]) -> Case + Sync),
) -> Option<Fault> {
    let wrong = |chunk: &[&Piece]| {
        let findings = engine.judge_case(&case(chunk));
        findings.iter().find(|(_, f)| f.is_wrong()).map(|(_, finding)| finding.describe())
    };
    let chunks: Vec<&[&Piece]> = pieces.chunks(CHUNK).collect();
    let faults = parallel::map(chunks.len(), |number| wrong(chunks[number]));
    let (first, together) = chunks.iter().zip(faults).find_map(|(c, f)| Some((c, f?)))?;
    let alone = first.iter().find_map(|piece| Some((piece.face, wrong(&[*piece])?)));
    Some(match alone {
        Some((triangle, what)) => Fault { what, triangle: Some(triangle) },
        None => Fault { what: format!("several pieces together: {together}"), triangle: None },
    })
}
