//! Engines on the triangles of a model, against the oracle.

use std::fmt::Display;

use rasterproof_core::grid::PixelRect;
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
    let judgeable: Vec<&Piece> = drawn.iter().copied().filter(|piece| has_values(piece)).collect();
    let mut findings = Vec::new();
    for &engine in &judged.triangles {
        let snapped = |chunk: &[&Piece]| snapped_case(chunk, window);
        findings.push(JudgedEngine::new(engine.name(), &judgeable, &engine.into(), &snapped));
    }
    for &engine in &judged.unsnapped {
        let unsnapped = |chunk: &[&Piece]| unsnapped_case(chunk, window);
        findings.push(JudgedEngine::new(engine.name(), &judgeable, &engine.into(), &unsnapped));
    }
    // To draw nothing where nothing is expected shows nothing of an engine.
    let expects = judgeable.iter().any(|piece| has_pixel(piece, window));
    let is_wrong = findings.iter().any(|finding| finding.fault.is_some());
    let agrees = (expects || is_wrong).then_some(!is_wrong);
    if agrees.is_none() {
        findings.clear();
    }
    // The same findings twice: as rows of a table, and as data.
    let (mut rows, mut engines) = (Vec::new(), Vec::new());
    for finding in &findings {
        rows.push(finding.row(subject));
        engines.push(finding.data(subject));
    }
    let (left, count) = (drawn.len() - judgeable.len(), judgeable.len());
    // What the engines refuse is counted, so that nobody takes it for judged.
    let mut table = Table::new("", "~engine 1 | ~found 1 | first fault", rows).judged();
    if left > 0 {
        let why = "whose texture coordinates are too large for the engines";
        let left = words::count(left as u64, "piece", "pieces");
        table.notes.push(format!("not judged: {left}, {why}"));
    }
    let pieces = words::count(count as u64, "piece", "pieces");
    let have = words::noun(count as u64, "has", "have");
    let outcome = match agrees {
        Some(agrees) => Outcome::of(agrees, format!("{pieces} of {shown}")),
        None => Outcome::new(
            false,
            "NOT JUDGED",
            format!(
                "the {pieces} of {shown} in the window {have} no pixel, so nothing was compared; \
                 look at it from another side (--yaw, --pitch, --zoom)"
            ),
        ),
    };
    let report = Report {
        about: studied.head(),
        tables: vec![hard_cases(subject, &studied.hard, &[]), table],
        outcome: Some(outcome),
        data: value(&json::OnModel {
            scene: &studied.scene.name,
            hard_cases: json::hard_cases(subject, &studied.hard),
            engines,
            pieces: count,
            not_judged: left,
            agrees,
        }),
        ..Report::default()
    };
    (report, agrees)
}

/// Whether the engines take all texture coordinates of a piece.
fn has_values(piece: &Piece) -> bool {
    let vertices = piece.triangle.vertices.iter();
    vertices.flat_map(|vertex| vertex.varying.to_array()).all(|value| check_value(value).is_ok())
}

/// Pieces as engines see them that take corners on the grid.
fn snapped_case(pieces: &[&Piece], window: PixelRect) -> Case {
    let list = pieces.iter().map(|piece| piece.triangle).collect();
    Case { window, shape: Shape::Triangles { list, disjoint: false } }
}

/// The same for engines that take corners as they are given.
fn unsnapped_case(pieces: &[&Piece], window: PixelRect) -> Case {
    Case::unsnapped(window, pieces.iter().filter_map(|piece| piece.free()).collect())
}

/// What was found of an engine.
struct JudgedEngine {
    engine: &'static str,
    fault: Option<Fault>,
}

impl JudgedEngine {
    /// Judges one engine; `case` makes of pieces what it takes.
    fn new(
        engine: &'static str,
        pieces: &[&Piece],
        judged: &EnginesToJudge,
        case: &(dyn Fn(&[&Piece]) -> Case + Sync),
    ) -> Self {
        Self { engine, fault: judge(pieces, judged, case) }
    }

    /// Its row of the table, with the command that shows the first fault.
    fn row(&self, subject: &Places<'_>) -> Row {
        let name = format!("{} against the oracle:", self.engine);
        let Some(Fault { what, triangle }) = &self.fault else {
            return Row::of(&[&name, &"agrees", &""]).marked(true);
        };
        let first = match *triangle {
            Some(one) => format!("first at {}\n{}", subject.place(one), subject.command(one)),
            None => String::new(),
        };
        Row::of(&[&name, what, &first]).marked(false)
    }

    /// The same for machines.
    fn data(&self, subject: &Places<'_>) -> json::Engine {
        let (mut fault, mut face) = (None, None);
        if let Some(Fault { what, triangle }) = &self.fault {
            fault = Some(what.clone());
            face = triangle.map(|one| face_of(subject.scene, subject.origins, one));
        }
        json::Engine { engine: self.engine, fault, face }
    }
}

/// What an engine gets wrong, and the first triangle for which it does so alone.
struct Fault {
    what: String,
    triangle: Option<u32>,
}

/// What an engine gets wrong of a case first, in words.
fn first_fault(engine: &EnginesToJudge, case: &Case) -> Option<String> {
    let findings = engine.judge_case(case);
    findings.iter().find(|(_, f)| f.is_wrong()).map(|(_, finding)| finding.describe())
}

/// Judges an engine on all pieces, some of them together as a case.
fn judge(
    pieces: &[&Piece],
    engine: &EnginesToJudge,
    case: &(dyn Fn(&[&Piece]) -> Case + Sync),
) -> Option<Fault> {
    let chunks: Vec<&[&Piece]> = pieces.chunks(CHUNK).collect();
    let faults = parallel::map(chunks.len(), |number| first_fault(engine, &case(chunks[number])));
    let (chunk, together) = chunks.iter().zip(faults).find_map(|(c, f)| Some((c, f?)))?;
    // Of the first chunk that is wrong, the first piece that is wrong alone.
    for piece in *chunk {
        if let Some(what) = first_fault(engine, &case(&[*piece])) {
            return Some(Fault { what, triangle: Some(piece.face) });
        }
    }
    Some(Fault { what: format!("several pieces together: {together}"), triangle: None })
}
