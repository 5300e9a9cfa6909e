//! A study and the boards of `cost` for machines.

use rasterproof_precision::cost::{
    Board, Cell, Cheapest, JudgedChoice, Recorded, Run, Spread, Time, Times, fastest, prices,
};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Places, StudyFindings, names};
use crate::effects::{Adds, Need, Needs, State};
use crate::hard::HardCases;
use crate::shift::Shifted;
use crate::{face_of, triangle_of};

/// The boards of `cost` as JSON, with what exact coverage costs and the choices that others beat in error and time.
/// [`Recorded::read`] takes it back.
pub fn cost(recorded: &Recorded) -> Value {
    let boards = &recorded.boards;
    let verdicts: Vec<_> = boards
        .iter()
        .flat_map(|board| board.ranking().map(move |measure| (board, measure)))
        .map(|(board, measure)| {
            let best = |column: usize| {
                let promises = |choice: &JudgedChoice<'_>| choice.promises(measure);
                let good = board.cheapest_exact(column, measure);
                let certain = fastest(board.ran(column).filter(promises));
                Some(json!({
                    "column": board.columns[column].name,
                    "fastest": fastest(board.ran(column))?.name(),
                    "cheapest_good": good.as_ref().map(JudgedChoice::name),
                    "cheapest_certain": certain.as_ref().map(JudgedChoice::name),
                }))
            };
            let dominated = board.dominated(measure).into_iter().map(|(choice, by)| {
                let by: Vec<_> = by.into_iter().map(|other| &other.name).collect();
                json!({ "choice": choice.name, "by": by })
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

pub fn study(subject: &Places<'_>, found: &StudyFindings<'_>, answers: &impl Serialize) -> Value {
    let (scene, hard) = (subject.scene, found.hard);
    json!({
        "scene": scene.name, "triangles": scene.triangles(), "pieces": found.pieces,
        "loading_s": found.loading_s, "answers": answers,
        "hard_cases": hard_cases(subject, hard), "decided": hard.classes,
        "effects": needs(found.needs, found.not_drawn), "costs": costs(subject, found.costs),
        "grids": found.grids,
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
    let shifted = |shifted: &Shifted| {
        let Shifted { by, pixel, triangle } = shifted;
        json!({ "by": by, "pixel": pixel, "face": face_of(subject.scene, subject.origins, *triangle) })
    };
    json!({
        "cases": cases.collect::<Vec<_>>(), "w": found.w, "f32_pixels": found.f32_pixels,
        "is_cut_short": found.is_cut_short,
        "moved_depth": found.shift.depth.as_ref().map(shifted),
        "moved_texels": found.shift.texels.as_ref().map(shifted),
        "moved_colour": found.shift.colour.as_ref().map(shifted),
        "moved_normal": found.shift.normal.as_ref().map(shifted),
    })
}

pub fn costs(subject: &Places<'_>, boards: &[Board]) -> Value {
    let board = |board: &Board| {
        let choice = |(number, row): (usize, &Vec<Cell>)| {
            let (choice, not_run) = (&board.choices[number], Run::default());
            let (run, refused) = match &row[0] {
                Cell::Run(run) => (&**run, None),
                Cell::NotRun(why) => (&not_run, Some(why)),
            };
            let first = run.found.first.map(|(of, [x, y])| {
                let face = of.map(|triangle| face_of(subject.scene, subject.origins, triangle));
                json!({ "pixel": [x, y], "face": face })
            });
            let rounds = run.time.as_ref().and_then(|time: &Time| time.rounds.as_ref());
            let is_exact = |one: &usize| board.meets(number, 0, *one);
            json!({
                "name": choice.name, "about": choice.about, "errors": run.errors,
                "exact": board.ranking().filter(is_exact).collect::<Vec<_>>(), "first_wrong": first,
                "margin": run.found.margin.filter(|margin| margin.is_finite()),
                "time_ns": rounds.map(quartiles), "times": run.time.as_ref().map(|time| time.times),
                "wall_ns": rounds.and_then(|times| times.wall_ns),
                "bytes": run.found.bytes, "refused": refused,
            })
        };
        let measures: Vec<_> = board.measures.iter().map(|measure| &measure.title).collect();
        let of_measures = || (0..measures.len()).map(|measure| board.compared(0, measure));
        let best = of_measures().map(|best| Some(best?.choice.name()));
        let compared = of_measures().map(|best| {
            let Cheapest { choice, equal, undecided } = best?;
            Some(json!({
                "choice": choice.name(), "equally_fast": names(&equal), "undecided": names(&undecided),
                "rounds": choice.times().map_or(0, Times::rounds),
            }))
        });
        let column = &board.columns[0];
        let sampling = column.sampling.map(|of| {
            let timed = json!({
                "triangles": of.items.part, "of_triangles": of.items.of,
                "pixels": of.pixels.part, "of_pixels": of.pixels.of,
            });
            (timed, json!({ "part": of.judged.part, "of": of.judged.of }), of.not_judged)
        });
        let (timed, judged, not_judged) = sampling.unwrap_or_default();
        json!({
            "title": board.ladder.title(), "measures": measures, "not_judged": not_judged,
            "timed": timed, "compared_pixels": judged, "noise": column.noise,
            "choices": board.cells.iter().enumerate().map(choice).collect::<Vec<_>>(),
            "cheapest_exact": best.collect::<Vec<_>>(),
            "compared": compared.collect::<Vec<_>>(),
        })
    };
    boards.iter().map(board).collect()
}

/// Nanoseconds.
fn quartiles(time: &Times) -> [f64; 3] {
    let Spread { low, median, high } = time.spread();
    [low, median, high]
}

fn needs(needs: &Needs, not_drawn: &str) -> Value {
    let one = |need: &Need| {
        json!({
            "effect": need.effect.name(), "called_for": need.state() == State::CalledFor,
            "paid_for": need.is_paid_for, "materials": need.materials, "reasons": need.reasons,
            "pixels": need.pixels, "wrong_without": need.wrong,
            "work": need.work, "draws_less": need.draws_less,
            "otherwise_ns": need.otherwise.as_ref().map(quartiles),
            "times": match need.adds(&needs.planned) {
                Adds::Times(ratio) => Some(ratio),
                Adds::NoWork | Adds::DrawsLess => None,
            },
        })
    };
    json!({
        "effects": needs.needs.iter().map(one).collect::<Vec<_>>(),
        "planned_ns": quartiles(&needs.planned), "noise": needs.planned.noise(),
        "textures": needs.textures, "not_supported": not_drawn,
    })
}
