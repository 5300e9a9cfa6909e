//! `rasterproof study`: what a model costs, which hard cases it contains, and which effects it calls for; and the same
//! judgements alone, as `verify FILE` and `inspect FILE#FACE`.

use std::ffi::OsString;
use std::path::Path;

use rasterproof_host::output::{self, Output};
use rasterproof_host::text::{printable, printable_path};
use rasterproof_precision::cost::{Board, Timing};
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_render::scene::Scene;
use rasterproof_report::html::Report;
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_study::cost;
use rasterproof_study::effects;
use rasterproof_study::faces;
use rasterproof_study::grid;
use rasterproof_study::report::around::Around;
use rasterproof_study::report::studied::Studied;
use rasterproof_study::report::{self as report, costs, engines, json};

use super::inspect_case::{self, InspectedCase};
use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::view::{
    GridArguments, Maker, SceneArguments, VIEW_OPTIONS, ViewArguments, view_and_grid,
};
use super::{InputError, Status, Streams, exit, usage};
use rasterproof_study::bounds::Purpose;

#[derive(clap::Args, Debug)]
pub struct StudyArguments {
    #[command(flatten)]
    what: SceneArguments,
    #[command(flatten)]
    grid: GridArguments,
    #[command(flatten)]
    page: PageArguments,
    /// Fewer rounds and smaller samples for the times
    #[arg(long)]
    quick: bool,
    /// All that was found, not the first screen of it alone
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    once: OnceArgument,
    /// Look at the model from so many sides, a line for each
    #[arg(long, value_name = "N", conflicts_with = "report", value_parser = super::whole::<u32>(1..=360))]
    views: Option<u32>,
    /// For machines
    #[arg(long)]
    json: bool,
}

/// Shared with `cost`.
#[derive(clap::Args, Debug)]
pub(super) struct OnceArgument {
    /// Time everything a single time, for tests that look at all but times
    #[arg(long, hide = true)]
    once: bool,
}

impl OnceArgument {
    /// How a group is timed: usually in seconds, so that a difference of a few percent can be told.
    pub(super) fn timing(&self, quick: bool) -> Timing {
        match (self.once, quick) {
            (true, _) => Timing::ONCE,
            (false, true) => Timing::QUICK,
            (false, false) => Timing::USUAL,
        }
    }
}

/// Looks at a scene from one side: which of its pieces are in the window, and which of them are hard.
fn studied<'a>(
    maker: &'a Maker,
    scene: Scene,
    view: &ViewArguments,
    grid: CornerGrid,
) -> Result<Studied<'a>, InputError> {
    Studied::new(scene, &maker.model.origins, &mut view.target()?, grid)
}

/// What a scene costs, with a bar while it is measured.
fn measure(
    studied: &Studied<'_>,
    view: &ViewArguments,
    timing: Timing,
    on_terminal: bool,
) -> Result<Vec<Board>, InputError> {
    let progress = Progress::new(on_terminal, "percent", Some(100));
    let told = |share: f64, what: &str| progress.at((share * 100.0) as u64, what);
    let mut target = view.target()?;
    let seen = (&studied.sampled, &studied.hard);
    cost::measure(&studied.scene, seen, &mut target, timing, &told).map_err(usage)
}

/// `cost FILE`: what each choice costs on the triangles of a model.
pub(super) fn cost(
    (path, page): (&Path, Option<Output>),
    view: &ViewArguments,
    (timing, is_json): (Timing, bool),
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    output::check_all(as_file(&page))?;
    // The names of files are checked twice: before the model is read, which may take long, and after, since it names files, too.
    let maker = view.maker(path, Purpose::Measured, streams)?;
    output::check_all(as_file(&page))?;
    let studied = studied(&maker, maker.scene.clone(), view, CornerGrid::USUAL)?;
    let boards = measure(&studied, view, timing, streams.progress)?;
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let report = Report {
        title: format!("What accuracy costs for {}", studied.scene.name),
        about: studied.head(),
        pictured: report::pictured(&boards),
        command: page.as_ref().map_or_else(String::new, |_| typed.line()),
        tables: costs(&subject, &boards),
        data: json::costs(&subject, &boards),
        ..Report::default()
    };
    show(report, Shown::All.or_json(is_json), page, exit::AGREES, streams)
}

/// The command that shows one face of this model, in the same view.
fn inspect_command(typed: &Typed, path: &Path, face: u32) -> String {
    let mut word = OsString::from(path);
    word.push(format!("#{face}"));
    typed.as_command("inspect", word, &view_and_grid()).line()
}

/// Looks at a model from one side and says all that was found, or from many sides, a line for each.
pub fn run(arguments: &StudyArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let what = &arguments.what;
    arguments.page.refuse_idle_folder(typed)?;
    let page = arguments.page.page("study.html");
    output::check_all(as_file(&page))?;
    let maker = what.maker(typed, Purpose::Measured, streams)?;
    output::check_all(as_file(&page))?;
    if let Some(views) = arguments.views {
        return all_around((arguments, views), &maker, streams);
    }
    let studied = studied(&maker, maker.scene.clone(), &what.view, arguments.grid.grid())?;
    let timing = arguments.once.timing(arguments.quick);
    let boards = measure(&studied, &what.view, timing, streams.progress)?;
    let mut target = what.view.target()?;
    let window = target.size();
    let pieces = studied.sampled.at_centres();
    let visible = (pieces, &cost::exactly_seen(pieces, window));
    // The survey of effects has a little more time than a group of choices.
    let of_effects = timing.within(1.2);
    let needs = effects::survey(&studied.scene, studied.origins, visible, &mut target, of_effects)?;
    let inspect = |face| match what.source() {
        Ok(name) => format!("(a scene of the book, {name}, is no file to inspect)"),
        Err(path) => inspect_command(typed, path, face),
    };
    let subject = studied.subject(&inspect);
    // The further commands are about files.
    let commands = match what.source() {
        Ok(_) => Default::default(),
        Err(path) => ["cost", "verify", "plan"]
            .map(|name| typed.as_command(name, path, &VIEW_OPTIONS).line()),
    };
    let rounds = match timing {
        Timing::ONCE => 1,
        Timing::QUICK => 3,
        _ => 5,
    };
    // What takes time for a plot alone is left out where none is drawn.
    let grids = match page.is_some() || arguments.all {
        true => grid::prices(&studied.scene, target.bounds(), rounds)?,
        false => Vec::new(),
    };
    let found = report::StudyFindings {
        hard: &studied.hard,
        grids: &grids,
        needs: &needs,
        costs: &boards,
        not_drawn: &maker.model.not_drawn,
        pieces: pieces.len(),
        loading_s: maker.model.loading_s,
    };
    let mut report = report::report(&subject, &found, studied.head(), commands, typed.line());
    report.data = json::study(&subject, &found, &report.answers);
    let read = |s: f64| format!("read in {:.1} ms, which is no part of the times above", s * 1e3);
    report.notes.extend(maker.model.loading_s.map(read));
    let shown = if arguments.all { Shown::All } else { Shown::Screen };
    show(report, shown.or_json(arguments.json), page, exit::AGREES, streams)
}

/// A line for each of some views around the model.
fn all_around(
    (arguments, views): (&StudyArguments, u32),
    maker: &Maker,
    streams: &mut Streams<'_>,
) -> Status {
    let view = &arguments.what.view;
    let progress = Progress::new(streams.progress, "views", Some(views.into()));
    let mut around = Around::default();
    for number in 0..views {
        // Each view turns the model as it was framed once, so that all of them have the same distance.
        let turn = f64::from(number) / f64::from(views);
        let studied = studied(maker, maker.turned(turn), view, arguments.grid.grid())?;
        let boards = measure(&studied, view, arguments.once.timing(arguments.quick), false)?;
        around.add(360.0 * turn, &studied.hard, &boards);
        progress.done(1);
    }
    drop(progress);
    let name = &maker.scene.name;
    show(around.report(name), Shown::All.or_json(arguments.json), None, exit::AGREES, streams)
}

/// Refuses options of a view where no model is named.
pub(super) fn refuse_view(typed: &Typed) -> Result<(), InputError> {
    match typed.given(&VIEW_OPTIONS) {
        Some(option) => Err(usage(format!("--{option} is for models: name a file"))),
        None => Ok(()),
    }
}

/// `verify FILE`: the hard cases of a model, and every engine on its triangles against the oracle.
pub(super) fn verify(
    path: &Path,
    (view, judged, is_json): (&ViewArguments, &EnginesToJudge, bool),
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    let maker = view.maker(path, Purpose::Judged, streams)?;
    let studied = studied(&maker, maker.scene.clone(), view, CornerGrid::USUAL)?;
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let (report, agrees) = engines::report(&studied, &subject, judged, printable_path(path));
    let status = agrees.map_or(exit::USAGE, exit::of);
    show(report, Shown::All.or_json(is_json), None, status, streams)
}

/// A face of a model, which `inspect` shows as a case.
pub(super) struct FaceOfModel {
    /// What is known of it, a line each.
    pub about: Vec<String>,
    /// Its pieces; nothing where it is not in the window.
    pub case: Option<InspectedCase>,
}

/// The face of a model that the words of `inspect` name: FILE#NUMBER. Where its corners are put on another grid than the usual
/// one, its pieces are a case for those who do not snap.
pub(super) fn face(
    (path, word): (&Path, &str),
    view: &ViewArguments,
    grid: CornerGrid,
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Result<FaceOfModel, InputError> {
    let shown = printable_path(path);
    let maker = view.maker(path, Purpose::Judged, streams)?;
    let studied = studied(&maker, maker.scene.clone(), view, grid)?;
    let Some((first, known, pieces)) = word.parse().ok().and_then(|face| studied.face(face)) else {
        let last = faces(&studied.scene, studied.origins).max().unwrap_or(0);
        let word = printable(word);
        return Err(usage(format!(
            "{shown}#{word}: no such face is drawn; those of this model have numbers from 1 to {last}"
        )));
    };
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let mut about = vec![format!("{shown}: {}", subject.place(first))];
    about.extend(known);
    if pieces.is_empty() {
        return Ok(FaceOfModel { about, case: None });
    }
    // The corners as they would be typed, so that the case is made as from words: off the lattice there are no values.
    let is_exact = grid != CornerGrid::USUAL;
    let mut corners = Vec::new();
    // A face that the near plane cuts has several pieces, each of which is a triangle of the case.
    for piece in pieces {
        let px = if is_exact { grid.place(piece.px) } else { piece.px };
        for ((vertex, [x, y]), w) in piece.triangle.vertices.iter().zip(px).zip(piece.w) {
            corners.push(match is_exact {
                true => format!("{x:?},{y:?}"),
                false => format!("{x:?},{y:?},{w:?},{:?}", vertex.depth),
            });
        }
    }
    let mut case = inspect_case::triangles(&corners, is_exact, Some(studied.sampled.size))?;
    if let InspectedCase::Case(case) = &mut case {
        case.title = format!("{shown}#{}", printable(word));
    }
    if is_exact {
        case = inspect_case::off_lattice(case)?;
    }
    Ok(FaceOfModel { about, case: Some(case) })
}
