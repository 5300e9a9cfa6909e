//! `rasterproof study`: what a model costs, which hard cases it contains, and which effects it calls for; and the same
//! judgements alone, as `verify FILE` and `inspect FILE#FACE`.

use std::ffi::OsString;
use std::path::Path;

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::check_value;
use rasterproof_host::text::{printable, printable_path};
use rasterproof_models::Origin;
use rasterproof_registry::comparison::Judged;
use rasterproof_render::scene::{Hidden, Scene};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::json::value;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::{self, number, thousands};
use rasterproof_study::cost::{self, Effort, Group};
use rasterproof_study::effects;
use rasterproof_study::hard::{self, HardCases, Kind};
use rasterproof_study::report::around::Around;
use rasterproof_study::report::{self as report, Places, costs, hard_cases, json};
use rasterproof_study::view::{Piece, Sampled};
use rasterproof_study::{face_of, faces, triangle_of};
use rasterproof_verify::cases::{Case, Shape};

use super::files;
use super::inspect_case::{self, Found};
use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::view::{Maker, SceneArguments, VIEW_OPTIONS, ViewArguments};
use super::{InputError, Status, Streams, exit, usage};
use rasterproof_study::bounds::Purpose;

#[derive(clap::Args, Debug)]
pub struct StudyArguments {
    #[command(flatten)]
    what: SceneArguments,
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
    pub(super) fn effort(&self, quick: bool) -> Effort {
        match (self.once, quick) {
            (true, _) => Effort::Once,
            (false, true) => Effort::Quick,
            (false, false) => Effort::Usual,
        }
    }
}

/// A scene in a view, taken apart.
struct Studied<'a> {
    scene: Scene,
    origins: &'a [Origin],
    sampled: Sampled,
    hard: HardCases,
}

impl<'a> Studied<'a> {
    fn new(scene: Scene, origins: &'a [Origin], view: &ViewArguments) -> Result<Self, InputError> {
        if scene.hidden == Hidden::Painter {
            return Err(usage(
                "this scene is drawn from back to front, without a depth buffer: study another one",
            ));
        }
        let mut target = view.target()?;
        let sampled = Sampled::of(&scene, &target)?;
        let hard = hard::find(&scene, origins, &sampled, &mut target)?;
        Ok(Self { scene, origins, sampled, hard })
    }

    fn subject<'s>(&'s self, inspect: &'s dyn Fn(u32) -> String) -> Places<'s> {
        Places { scene: &self.scene, origins: self.origins, inspect }
    }
}

/// What a scene costs, with a bar while it is measured.
fn measure(
    studied: &Studied<'_>,
    view: &ViewArguments,
    effort: Effort,
    on_terminal: bool,
) -> Result<Vec<Group>, InputError> {
    let progress = Progress::new(on_terminal, "percent", Some(100));
    let told = |share: f64, what: &str| progress.at((share * 100.0) as u64, what);
    let mut target = view.target()?;
    let seen = (&studied.sampled, &studied.hard);
    cost::measure(&studied.scene, seen, &mut target, effort, &told).map_err(usage)
}

/// `cost FILE`: what each choice costs on the triangles of a model.
pub(super) fn cost(
    path: &Path,
    view: &ViewArguments,
    (effort, is_json): (Effort, bool),
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    let maker = view.maker(path, Purpose::Measured, streams)?;
    let studied = Studied::new(maker.scene.clone(), &maker.model.origins, view)?;
    let groups = measure(&studied, view, effort, streams.progress)?;
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let report = Report {
        about: head(&studied),
        tables: costs(&subject, &groups),
        data: json::costs(&subject, &groups),
        ..Report::default()
    };
    show(report, Shown::All.or_json(is_json), None, exit::AGREES, streams)
}

fn inspect_command(typed: &Typed, path: &Path, face: u32) -> String {
    let mut word = OsString::from(path);
    word.push(format!("#{face}"));
    typed.as_command("inspect", word, &VIEW_OPTIONS).line()
}

pub fn run(arguments: &StudyArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let what = &arguments.what;
    arguments.page.refuse_idle_folder(typed)?;
    let page = arguments.page.page("study.html");
    files::check(as_file(&page))?;
    let maker = what.maker(typed, Purpose::Measured, streams)?;
    files::check(as_file(&page))?;
    if let Some(views) = arguments.views {
        return all_around((arguments, views), &maker, streams);
    }
    let studied = Studied::new(maker.scene.clone(), &maker.model.origins, &what.view)?;
    let effort = arguments.once.effort(arguments.quick);
    let groups = measure(&studied, &what.view, effort, streams.progress)?;
    let mut target = what.view.target()?;
    let window = target.size();
    let pieces = studied.sampled.at_centres();
    let visible = (pieces, &cost::exactly_seen(pieces, window));
    let budget = effort.survey();
    let needs = effects::survey(&studied.scene, studied.origins, visible, &mut target, budget)?;
    let inspect = |face| match what.source() {
        Ok(name) => format!("(a scene of the book, {name}, is no file to inspect)"),
        Err(path) => inspect_command(typed, path, face),
    };
    let subject = studied.subject(&inspect);
    let commands = match what.source() {
        Ok(_) => Default::default(),
        Err(path) => ["cost", "verify", "plan"]
            .map(|name| typed.as_command(name, path, &VIEW_OPTIONS).line()),
    };
    let found = report::Found {
        hard: &studied.hard,
        needs: &needs,
        costs: &groups,
        not_drawn: &maker.model.not_drawn,
        pieces: pieces.len(),
        loading_s: maker.model.loading_s,
    };
    let mut report = report::report(&subject, &found, head(&studied), commands, typed.line());
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
        let turn = f64::from(number) / f64::from(views);
        let studied = Studied::new(maker.turned(turn), &maker.model.origins, view)?;
        let groups = measure(&studied, view, arguments.once.effort(arguments.quick), false)?;
        around.add(360.0 * turn, &studied.hard, &groups);
        progress.done(1);
    }
    drop(progress);
    let name = &maker.scene.name;
    show(around.report(name), Shown::All.or_json(arguments.json), None, exit::AGREES, streams)
}

fn head(studied: &Studied<'_>) -> String {
    let Studied { scene, sampled, .. } = studied;
    let counts = [scene.triangles(), sampled.at_centres().len()];
    let [triangles, pieces] = counts.map(|count| thousands(count as u64));
    let none = match sampled.all().any(|piece| has_pixel(piece, sampled.window)) {
        true => "",
        false => {
            "\nNOT COMPARED: none of them has a pixel, so nothing was compared in what follows"
        }
    };
    format!("{}: {triangles} triangles, {pieces} pieces in the window{none}", scene.name)
}

/// Refuses options of a view where no model is named.
pub(super) fn refuse_view(typed: &Typed) -> Result<(), InputError> {
    match typed.given(&VIEW_OPTIONS) {
        Some(option) => Err(usage(format!("--{option} is for models: name a file"))),
        None => Ok(()),
    }
}

/// Pieces that are judged at once: no pixel is hit more often than a count of hits holds.
const CHUNK: usize = 128;

/// `verify FILE`: the hard cases of a model, and every engine on its triangles against the oracle.
pub(super) fn verify(
    path: &Path,
    (view, judged, is_json): (&ViewArguments, &Judged, bool),
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    let maker = view.maker(path, Purpose::Judged, streams)?;
    let studied = Studied::new(maker.scene.clone(), &maker.model.origins, view)?;
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
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
    let status = match agrees {
        Some(true) => exit::AGREES,
        Some(false) => exit::DISAGREES,
        None => {
            faults.clear();
            exit::USAGE
        }
    };
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
    let is_left =
        (left > 0).then(|| format!("not judged: {} pieces, {why}", thousands(left as u64)));
    let columns = "~engine 1 | ~found 1 | first fault";
    let engines = Table::new("", columns, faults.iter().map(row).collect());
    let engines = engines.judged().noted(Vec::from_iter(is_left));
    let (pieces, shown) = (thousands(count as u64), printable_path(path));
    let report = Report {
        about: head(&studied),
        tables: vec![hard_cases(&subject, &studied.hard, &[]), engines],
        outcome: Some(match agrees {
            Some(agrees) => Outcome::of(agrees, format!("{pieces} pieces of {shown}")),
            None => Outcome::new(
                false,
                "NOT JUDGED",
                format!(
                    "the {pieces} pieces of {shown} in the window have no pixel, so nothing was compared; \
                     look at it from another side (--yaw, --pitch, --zoom)"
                ),
            ),
        }),
        data: value(&json::OnModel {
            scene: &studied.scene.name,
            hard_cases: json::hard_cases(&subject, &studied.hard),
            engines: faults.iter().map(engine).collect(),
            pieces: count,
            not_judged: left,
            agrees,
        }),
        ..Report::default()
    };
    show(report, Shown::All.or_json(is_json), None, status, streams)
}

/// Whether a piece covers the centre of a pixel.
fn has_pixel(piece: &Piece, window: PixelRect) -> bool {
    let mut has_one = false;
    Scanline.cover(piece.corners(), window, |_| has_one = true);
    has_one
}

/// What an engine gets wrong, and the first triangle for which it does so alone.
struct Fault {
    what: String,
    triangle: Option<u32>,
}

/// Judges an engine on all pieces, some of them together as a case.
fn judge(
    pieces: &[&Piece],
    engine: &Judged,
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

/// The face of a model that the words of `inspect` name: FILE#NUMBER. What is known of it, a line each, and its pieces as a
/// case; nothing where it is not in the window.
pub(super) fn face(
    (path, word): (&Path, &str),
    view: &ViewArguments,
    (typed, is_exact): (&Typed, bool),
    streams: &mut Streams<'_>,
) -> Result<(Vec<String>, Option<Found>), InputError> {
    let shown = printable_path(path);
    let maker = view.maker(path, Purpose::Judged, streams)?;
    let studied = Studied::new(maker.scene.clone(), &maker.model.origins, view)?;
    let (scene, origins) = (&studied.scene, studied.origins);
    let number = word.parse::<u32>().ok();
    let of_face = |(triangle, face)| (Some(face) == number).then_some(triangle);
    let triangles: Vec<u32> = (0..).zip(faces(scene, origins)).filter_map(of_face).collect();
    let Some(&first) = triangles.first() else {
        let last = faces(scene, origins).max().unwrap_or(0);
        let word = printable(word);
        return Err(usage(format!(
            "{shown}#{word}: no such face is drawn; those of this model have numbers from 1 to {last}"
        )));
    };
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let mut about = vec![format!("{shown}: {}", subject.place(first))];
    for (item, number) in triangles.iter().filter_map(|&one| triangle_of(scene, one)) {
        let mesh = &scene.items[item].mesh;
        let corners = mesh.triangles.positions()[number].map(|position| {
            // Scenes are left-handed, models are not.
            let [x, y, z] = mesh.positions[position as usize].to_array();
            format!("({x:?}, {y:?}, {:?})", -z)
        });
        about.push(format!("triangle, y up: {}", corners.join(" ")));
    }
    let has_part = |kind: &Kind| triangles.iter().any(|&one| studied.hard.is(one, *kind));
    let kinds: Vec<_> = Kind::ALL.into_iter().filter(has_part).map(Kind::name).collect();
    let kinds = if kinds.is_empty() { "none".to_owned() } else { kinds.join(", ") };
    about.push(format!("hard cases that it has a part in: {kinds}"));
    let of_face = |piece: &&Piece| triangles.binary_search(&piece.face).is_ok();
    let pieces: Vec<&Piece> = studied.sampled.at_centres().iter().filter(of_face).collect();
    if pieces.is_empty() {
        return Ok((about, None));
    }
    about.push(format!("in the window: {}", words::count(pieces.len() as u64, "piece", "pieces")));
    let mut corners = Vec::new();
    for piece in pieces {
        for ((vertex, [x, y]), w) in piece.triangle.vertices.iter().zip(piece.px).zip(piece.w) {
            corners.push(match is_exact {
                true => format!("{x:?},{y:?}"),
                false => format!("{x:?},{y:?},{w:?},{:?}", vertex.depth),
            });
        }
    }
    let title = format!("{shown}#{}", printable(word));
    let found = match inspect_case::triangles(&corners, is_exact, Some(studied.sampled.size))? {
        Found::Case { case, expected, typed, .. } => Found::Case { title, case, expected, typed },
        found => found,
    };
    Ok((about, Some(found)))
}
