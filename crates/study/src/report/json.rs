//! A study and the boards of `cost` for machines.

use rasterproof_precision::cost::{
    Board, Cell, Cheapest, JudgedChoice, Recorded, Run, Sampling, Spread, Time, Times, fastest,
    prices,
};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Places, StudyFindings, names};
use crate::effects::{Adds, Needs, State};
use crate::hard::HardCases;
use crate::shift::Shifted;
use crate::{face_of, triangle_of};

/// The boards of `cost` as JSON, with what exact coverage costs and the choices that others beat in error and time.
/// [`Recorded::read`] takes it back.
pub fn cost(recorded: &Recorded) -> Value {
    let boards = &recorded.boards;
    let mut verdicts = Vec::new();
    for board in boards {
        verdicts.extend(board.ranking().map(|measure| verdict(board, measure)));
    }
    json!({
        "version": recorded.version, "repeat": recorded.repeat, "seed": recorded.seed,
        "quick": recorded.quick, "boards": boards,
        "verdicts": verdicts, "price_of_exact_coverage": prices(boards),
    })
}

/// Which choices are the best by a measure, for each class of scenes, and which are beaten everywhere.
fn verdict(board: &Board, measure: usize) -> Value {
    // For each class the fastest of all, the fastest that is right, and the fastest that promises to be.
    let mut best = Vec::new();
    for column in board.columns_run() {
        // Without times there is no fastest choice, and nothing is said of the column.
        let Some(fastest_of_all) = fastest(board.ran(column)) else { continue };
        let good = board.cheapest_exact(column, measure);
        let certain = fastest(board.ran(column).filter(|choice| choice.promises(measure)));
        best.push(json!({
            "column": board.columns[column].name,
            "fastest": fastest_of_all.name(),
            "cheapest_good": good.as_ref().map(JudgedChoice::name),
            "cheapest_certain": certain.as_ref().map(JudgedChoice::name),
        }));
    }
    // A choice is beaten where another one is better by the measure and as fast, in every class.
    let mut dominated = Vec::new();
    for (choice, by) in board.dominated(measure) {
        let by: Vec<_> = by.into_iter().map(|other| &other.name).collect();
        dominated.push(json!({ "choice": choice.name, "by": by }));
    }
    json!({
        "group": board.ladder, "measure": board.measures[measure].title,
        "best": best, "dominated": dominated,
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

/// What one engine gets wrong first; nothing where it agrees.
#[derive(Serialize)]
pub struct Engine {
    pub engine: &'static str,
    pub fault: Option<String>,
    pub face: Option<u32>,
}

/// Everything that was found, with the answers as sentences.
pub fn study(subject: &Places<'_>, found: &StudyFindings<'_>, answers: &impl Serialize) -> Value {
    // The same numbers as in the tables, unrounded.
    let (scene, hard) = (subject.scene, found.hard);
    json!({
        "scene": scene.name, "triangles": scene.triangles(), "pieces": found.pieces,
        "loading_s": found.loading_s, "answers": answers,
        "hard_cases": hard_cases(subject, hard), "decided": hard.classes,
        "effects": needs(found.needs, found.not_drawn), "costs": costs(subject, found.costs),
        "grids": found.grids,
    })
}

/// The hard cases of a scene, and what else was found on the way.
pub fn hard_cases(subject: &Places<'_>, found: &HardCases) -> Value {
    let mut cases = Vec::new();
    for case in &found.cases {
        let faces: Vec<_> = case.triangles.iter().map(|one| face(subject, *one)).collect();
        cases.push(json!({
            "kind": case.kind.name(), "count": case.count, "in_view": case.in_view,
            "pixels": case.pixels, "note": case.note, "faces": faces,
        }));
    }
    let shift = &found.shift;
    // Each is null where nothing moves.
    let [depth, texels, colour, normal] = [shift.depth, shift.texels, shift.colour, shift.normal]
        .map(|largest| Some(shifted(subject, largest?)));
    json!({
        "cases": cases, "w": found.w, "f32_pixels": found.f32_pixels,
        "is_cut_short": found.is_cut_short,
        "moved_depth": depth, "moved_texels": texels, "moved_colour": colour, "moved_normal": normal,
    })
}

/// By how much snapping moves a value at most, and where.
fn shifted(subject: &Places<'_>, Shifted { by, pixel, triangle }: Shifted) -> Value {
    let face = face_of(subject.scene, subject.origins, triangle);
    json!({ "by": by, "pixel": pixel, "face": face })
}

/// A face, with what the file says of it where the scene is of one.
fn face(subject: &Places<'_>, triangle: u32) -> Value {
    let (mut line, mut part, mut material) = (None, None, None);
    if let Some((item, number)) = triangle_of(subject.scene, triangle)
        && let Some(origin) = subject.origins.get(item)
    {
        line = origin.lines.get(number);
        (part, material) = (Some(&origin.part), Some(&origin.material));
    }
    json!({
        "face": face_of(subject.scene, subject.origins, triangle),
        "line": line, "part": part, "material": material,
        "command": subject.command(triangle),
    })
}

/// The boards of a model, each of which has one column.
pub fn costs(subject: &Places<'_>, boards: &[Board]) -> Value {
    boards.iter().map(|board| of_model(subject, board)).collect()
}

/// A board of a model.
fn of_model(subject: &Places<'_>, board: &Board) -> Value {
    let (mut measures, mut best, mut compared) = (Vec::new(), Vec::new(), Vec::new());
    for (number, measure) in board.measures.iter().enumerate() {
        measures.push(&measure.title);
        // Both are null where no choice is exact.
        let cheapest = board.compared(0, number);
        best.push(cheapest.as_ref().map(|cheapest| cheapest.choice.name()));
        compared.push(cheapest.map(|Cheapest { choice, equal, undecided }| {
            json!({
                "choice": choice.name(), "equally_fast": names(&equal), "undecided": names(&undecided),
                "rounds": choice.times().map_or(0, Times::rounds),
            })
        }));
    }
    // Where the board was not measured on a sample, nothing is said of one.
    let column = &board.columns[0];
    let (mut timed, mut judged, mut not_judged) = Default::default();
    if let Some(Sampling { items, pixels, judged: of_pixels, not_judged: pieces, .. }) =
        column.sampling
    {
        timed = json!({
            "triangles": items.part, "of_triangles": items.of,
            "pixels": pixels.part, "of_pixels": pixels.of,
        });
        judged = json!({ "part": of_pixels.part, "of": of_pixels.of });
        not_judged = pieces;
    }
    let choices: Vec<_> = (0..board.choices.len()).map(|one| choice(subject, board, one)).collect();
    json!({
        "title": board.ladder.title(), "measures": measures, "not_judged": not_judged,
        "timed": timed, "compared_pixels": judged, "noise": column.noise,
        "choices": choices, "cheapest_exact": best, "compared": compared,
    })
}

/// A choice of a board of a model; what was not run has no numbers, and why.
fn choice(subject: &Places<'_>, board: &Board, number: usize) -> Value {
    // What was not run is an empty run, so that all choices have the same fields.
    let (choice, not_run) = (&board.choices[number], Run::default());
    let (run, refused) = match &board.cells[number][0] {
        Cell::Run(run) => (&**run, None),
        Cell::NotRun(why) => (&not_run, Some(why)),
    };
    let first = run.found.first.map(|(of, [x, y])| {
        let face = of.map(|triangle| face_of(subject.scene, subject.origins, triangle));
        json!({ "pixel": [x, y], "face": face })
    });
    // A file of recorded boards holds no rounds.
    let rounds = run.time.as_ref().and_then(|time: &Time| time.rounds.as_ref());
    let exact: Vec<_> =
        board.ranking().filter(|measure| board.meets(number, 0, *measure)).collect();
    json!({
        "name": choice.name, "about": choice.about, "errors": run.errors,
        "exact": exact, "first_wrong": first,
        "margin": run.found.margin.filter(|margin| margin.is_finite()),
        "time_ns": rounds.map(quartiles), "times": run.time.as_ref().map(|time| time.times),
        "wall_ns": rounds.and_then(|times| times.wall_ns),
        "bytes": run.found.bytes, "refused": refused,
    })
}

/// Nanoseconds: a quarter of the rounds took less than the first, half less than the second, a quarter more than the last.
fn quartiles(time: &Times) -> [f64; 3] {
    let Spread { low, median, high } = time.spread();
    [low, median, high]
}

/// The effects of a scene, with what each takes or would take.
fn needs(needs: &Needs, not_drawn: &str) -> Value {
    // An effect that does no work has no ratio.
    let mut effects = Vec::new();
    for need in &needs.needs {
        let times = match need.adds(&needs.planned) {
            Adds::Times(ratio) => Some(ratio),
            Adds::NoWork | Adds::DrawsLess => None,
        };
        effects.push(json!({
            "effect": need.effect.name(), "called_for": need.state() == State::CalledFor,
            "paid_for": need.is_paid_for, "materials": need.materials, "reasons": need.reasons,
            "pixels": need.pixels, "wrong_without": need.wrong,
            "work": need.work, "draws_less": need.draws_less,
            "otherwise_ns": need.otherwise.as_ref().map(quartiles), "times": times,
        }));
    }
    json!({
        "effects": effects,
        "planned_ns": quartiles(&needs.planned), "noise": needs.planned.noise(),
        "textures": needs.textures, "not_supported": not_drawn,
    })
}
