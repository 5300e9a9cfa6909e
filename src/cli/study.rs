//! `rasterproof study`: what a model costs, which hard cases it contains, and which effects it calls for; and the same
//! judgements alone, as `verify FILE` and `inspect FILE#FACE`.

use std::ffi::OsString;
use std::path::Path;

use rasterproof_core::parallel;
use rasterproof_core::triangle::check_value;
use rasterproof_host::text::{printable, printable_path};
use rasterproof_registry::comparison::judge_case;
use rasterproof_registry::engines::{Engine, ExactEngine};
use rasterproof_render::scene::{Hidden, Scene};
use rasterproof_report::study::{Subject, hard_cases, hard_cases_json, thousands};
use rasterproof_study::hard::{self, HardCases, Kind};
use rasterproof_study::view::{Piece, pieces};
use rasterproof_study::{face_of, triangle_of};
use rasterproof_verify::cases::unsnapped::OffGridCase;
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::tolerance::Tolerance;
use rasterproof_verify::comparison::unsnapped::judge_exact_case;

use super::case_view::Contestants;
use super::inspect_case::{self, Found};
use super::page::PageArguments;
use super::render::{Maker, SceneArguments, VIEW_OPTIONS, ViewArguments};
use super::typed::Typed;
use super::{Failure, Status, Streams, exit, usage};

pub const HELP: &str = include_str!("help/study.txt").trim_ascii_end();

#[derive(clap::Args, Debug)]
pub struct StudyArguments {
    #[command(flatten)]
    what: SceneArguments,
    #[command(flatten)]
    page: PageArguments,
    /// For machines
    #[arg(long)]
    json: bool,
}

/// A scene in a view, taken apart.
struct Studied {
    scene: Scene,
    maker: Maker,
    pieces: Vec<Piece>,
    hard: HardCases,
}

impl Studied {
    fn new(maker: Maker, view: &ViewArguments) -> Result<Self, Failure> {
        let scene = maker.scene(0.0);
        if scene.hidden == Hidden::Painter {
            return Err(usage(
                "this scene is drawn from back to front, without a depth buffer: study another one",
            ));
        }
        let mut target = view.target()?;
        let pieces = pieces(&scene, target.size()).map_err(usage)?;
        let hard = hard::find(&scene, maker.origins(), &pieces, &mut target).map_err(usage)?;
        Ok(Self { scene, maker, pieces, hard })
    }

    fn subject<'a>(&'a self, inspect: &'a dyn Fn(u32) -> String) -> Subject<'a> {
        Subject { scene: &self.scene, origins: self.maker.origins(), inspect }
    }
}

/// The command that shows a face of a model.
fn inspect_command(typed: &Typed, path: &Path, face: u32) -> String {
    let mut word = OsString::from(path);
    word.push(format!("#{face}"));
    typed.as_command("inspect", word, &VIEW_OPTIONS).line()
}

pub fn run(arguments: &StudyArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let what = &arguments.what;
    let maker = what.maker(streams)?;
    let studied = Studied::new(maker, &what.view)?;
    let inspect = |face| match what.source() {
        Ok(name) => format!("a scene of the book, {name}, has no file to inspect"),
        Err(path) => inspect_command(typed, path, face),
    };
    let subject = studied.subject(&inspect);
    let out = &mut *streams.output;
    if arguments.json {
        let json = serde_json::json!({
            "scene": studied.scene.name,
            "triangles": studied.scene.triangles(),
            "pieces": studied.pieces.len(),
            "hard_cases": hard_cases_json(&subject, &studied.hard),
        });
        writeln!(out, "{json}")?;
        return Ok(exit::AGREES);
    }
    writeln!(out, "{}\n", head(&studied))?;
    out.write_all(hard_cases(&subject, &studied.hard).as_bytes())?;
    Ok(exit::AGREES)
}

fn head(studied: &Studied) -> String {
    let (triangles, pieces) = (studied.scene.triangles() as u64, studied.pieces.len() as u64);
    let (triangles, pieces) = (thousands(triangles), thousands(pieces));
    format!("{}: {triangles} triangles, {pieces} pieces in the window", studied.scene.name)
}

/// Refuses options of a view where no model is named.
pub(super) fn refuse_view(typed: &Typed) -> Result<(), Failure> {
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
    (view, judged): (&ViewArguments, &Contestants),
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    let maker = view.maker(path, streams)?;
    let window = view.target()?.bounds();
    let studied = Studied::new(maker, view)?;
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    writeln!(streams.output, "{}\n", head(&studied))?;
    streams.output.write_all(hard_cases(&subject, &studied.hard).as_bytes())?;
    writeln!(streams.output)?;
    // The engines see samples as the picture has them, and values up to their limit.
    let drawn = pieces(&studied.scene, window).map_err(usage)?;
    let has_values = |piece: &&Piece| {
        let uv = piece.triangle.vertices.iter().map(|vertex| vertex.varying);
        uv.flat_map(|uv| uv.to_array()).all(|value| check_value(value).is_ok())
    };
    let judgeable: Vec<&Piece> = drawn.iter().filter(has_values).collect();
    let mut agrees = true;
    for &(engine, tolerance) in &judged.engines {
        agrees &= say(streams, &subject, engine.name(), &judgeable, &|chunk| {
            on_grid((engine, tolerance), chunk, window)
        })?;
    }
    for engine in &judged.exact {
        agrees &= say(streams, &subject, engine.name(), &judgeable, &|chunk| {
            off_grid(*engine, chunk, window)
        })?;
    }
    let left = drawn.len() - judgeable.len();
    if left > 0 {
        let left = thousands(left as u64);
        writeln!(
            streams.output,
            "not judged: {left} pieces, whose texture coordinates are too large for the engines"
        )?;
    }
    let word = if agrees { "AGREES" } else { "DISAGREES" };
    let pieces = thousands(judgeable.len() as u64);
    writeln!(streams.output, "{word}: {pieces} pieces of {}", printable_path(path))?;
    Ok(if agrees { exit::AGREES } else { exit::DISAGREES })
}

/// What is wrong with pieces by an engine, in words; nothing where nothing is.
type Judge<'a> = &'a (dyn Fn(&[&Piece]) -> Option<String> + Sync);

/// Judges an engine on all pieces, and says what it came to, with the first face that it gets wrong.
fn say(
    streams: &mut Streams<'_>,
    subject: &Subject<'_>,
    name: &str,
    pieces: &[&Piece],
    judge: Judge<'_>,
) -> Result<bool, Failure> {
    let chunks: Vec<&[&Piece]> = pieces.chunks(CHUNK).collect();
    let wrong = parallel::map(chunks.len(), |number| judge(chunks[number]).is_some());
    let wrong: Vec<usize> = (0..chunks.len()).filter(|&number| wrong[number]).collect();
    let Some(&first) = wrong.first() else {
        writeln!(streams.output, "{name} against the oracle: agrees")?;
        return Ok(true);
    };
    let alone = chunks[first].iter().find_map(|piece| Some((piece.face, judge(&[*piece])?)));
    match alone {
        Some((face, what)) => {
            writeln!(streams.output, "{name} against the oracle: {what}")?;
            writeln!(streams.output, "    first at {}", subject.place(face))?;
            writeln!(streams.output, "    {}", subject.command(face))?;
        }
        None => {
            let what = judge(chunks[first]).unwrap_or_default();
            writeln!(streams.output, "{name} against the oracle, several pieces together: {what}")?;
        }
    }
    Ok(false)
}

fn on_grid(
    engine: (Engine, Tolerance),
    chunk: &[&Piece],
    window: rasterproof_core::grid::PixelRect,
) -> Option<String> {
    let list = chunk.iter().map(|piece| piece.triangle).collect();
    let case = Case { window, shape: Shape::Triangles { list, disjoint: false } };
    let findings = judge_case(&[engine], &[], &case);
    findings.iter().find(|(_, f)| f.is_wrong()).map(|(_, finding)| finding.describe())
}

fn off_grid(
    engine: ExactEngine,
    chunk: &[&Piece],
    window: rasterproof_core::grid::PixelRect,
) -> Option<String> {
    let corners = chunk.iter().filter_map(|piece| piece.free());
    let case = OffGridCase { window, triangles: corners.collect(), is_tiling: false };
    let finding = judge_exact_case(&engine, &case);
    finding.is_wrong().then(|| finding.describe())
}

/// The face of a model that the words of `inspect` name: FILE#NUMBER. Prints what is known of it, and returns its pieces
/// as a case; nothing where it is not in the window.
pub(super) fn face(
    (path, word): (&Path, &str),
    view: &ViewArguments,
    (typed, is_exact): (&Typed, bool),
    streams: &mut Streams<'_>,
) -> Result<Option<Found>, Failure> {
    let shown = printable_path(path);
    let maker = view.maker(path, streams)?;
    let studied = Studied::new(maker, view)?;
    let (scene, origins) = (&studied.scene, studied.maker.origins());
    let number = word.parse::<u32>().ok();
    let all = 0..scene.triangles() as u32;
    let triangles: Vec<u32> =
        all.clone().filter(|&one| Some(face_of(scene, origins, one)) == number).collect();
    let Some(&first) = triangles.first() else {
        let last = all.map(|one| face_of(scene, origins, one)).max().unwrap_or(0);
        let word = printable(word);
        return Err(usage(format!(
            "{shown}#{word}: no such face is drawn; those of this model have numbers from 1 to {last}"
        )));
    };
    let inspect = |face| inspect_command(typed, path, face);
    let subject = studied.subject(&inspect);
    let out = &mut *streams.output;
    writeln!(out, "{shown}: {}", subject.place(first))?;
    for (item, number) in triangles.iter().filter_map(|&one| triangle_of(scene, one)) {
        let mesh = &scene.items[item].mesh;
        let corners = mesh.triangles[number].map(|corner| {
            // Scenes are left-handed, models are not.
            let [x, y, z] = mesh.positions[corner.position as usize].to_array();
            format!("({x:?}, {y:?}, {:?})", -z)
        });
        writeln!(out, "  triangle, y up: {}", corners.join(" "))?;
    }
    let has_part = |kind: &Kind| triangles.iter().any(|&one| studied.hard.is(one, *kind));
    let kinds: Vec<_> = Kind::ALL.into_iter().filter(has_part).map(Kind::name).collect();
    let kinds = if kinds.is_empty() { "none".to_owned() } else { kinds.join(", ") };
    writeln!(out, "  hard cases that it has a part in: {kinds}")?;
    let of_face = |piece: &&Piece| triangles.binary_search(&piece.face).is_ok();
    let pieces: Vec<&Piece> = studied.pieces.iter().filter(of_face).collect();
    if pieces.is_empty() {
        writeln!(out, "  not in the window: outside of it, or seen from a side that is culled")?;
        return Ok(None);
    }
    writeln!(out, "  in the window: {} piece(s)\n", pieces.len())?;
    let mut words = Vec::new();
    for piece in pieces {
        for (i, [x, y]) in piece.px.into_iter().enumerate() {
            let (w, vertex) = (piece.w[i], &piece.triangle.vertices[i]);
            words.push(match is_exact {
                true => format!("{x:?},{y:?}"),
                false => format!("{x:?},{y:?},{w:?},{:?}", vertex.depth),
            });
        }
    }
    let title = format!("{shown}#{}", printable(word));
    Ok(Some(match inspect_case::triangles(&words, is_exact)? {
        Found::Case { case, expected, typed, .. } => Found::Case { title, case, expected, typed },
        found => found,
    }))
}
