//! `rasterproof render`: a scene or a model to a picture, by either rasterizer or by both.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use image::codecs::gif::{GifEncoder, Repeat};
use rasterproof_host::output::Over;
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::files::{self, Output, Use, written};
use super::page::{PageArguments, Shown, as_file, print, show, write_page};
use super::plan_table;
use super::progress::Progress;
use super::typed::Typed;
use super::view::{Maker, Purpose, SceneArguments};
use super::{InputError, Status, Streams, ends_in, exit, usage};
use rasterproof_core::frame::Frame;
use rasterproof_registry::engines::{Drawer, Engine};
use rasterproof_registry::undecided::{self, Drawn};
use rasterproof_render::effects::depth_ties::{ByRounding, TiedPieces};
use rasterproof_render::effects::plan::{Plan, SceneDigest, VERSION};
use rasterproof_render::effects::render::{PlanError, Rendered};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::{Hidden, Scene};
use rasterproof_report::frame_comparison::{self, Amount, Comparison, Times};
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report};
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::thousands;
use rasterproof_report::{json, picture};
use rasterproof_study::ties::classify;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::{self, Division};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("render"))]
pub struct RenderArguments {
    #[command(flatten)]
    what: SceneArguments,
    /// The rasterizer, or both to compare them; tiles are fast, exact in coverage alone
    #[arg(long, value_enum, default_value_t = DrawnBy::Both)]
    engine: DrawnBy,
    /// Draw edges only, by DDA and by Bresenham, whichever goes with the rasterizer
    #[arg(long)]
    wireframe: bool,
    /// What is paid for: planned, usual, all, or +EFFECT and -EFFECT, separated by commas
    #[arg(long, value_name = "EFFECTS", allow_hyphen_values = true, conflicts_with = "wireframe")]
    effects: Option<Effects>,
    /// Draw by the plan in this file, from plan --json, edited or not
    #[arg(long, value_name = "FILE", conflicts_with_all = ["effects", "wireframe", "map", "spin"])]
    plan: Option<PathBuf>,
    /// Draw a small picture for each effect instead: which pixels paid for it
    #[arg(long, conflicts_with_all = ["wireframe", "spin", "report"])]
    map: bool,
    /// A full turn in this many frames, as an animated GIF
    #[arg(long, value_name = "FRAMES", conflicts_with = "report", value_parser = super::whole::<u32>(2..=1000))]
    spin: Option<u32>,
    /// The picture [default: NAME.png or .gif in the folder of --out]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    page: PageArguments,
    /// Counters as JSON on standard output
    #[arg(long, conflicts_with_all = ["map", "spin"])]
    json: bool,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum DrawnBy {
    Scanline,
    EdgeFunction,
    Tiles,
    Both,
}

struct Drawing {
    name: &'static str,
    rendered: Rendered,
    time: Duration,
    /// Holds every depth, where two rasterizers are compared.
    target: Target,
    /// Pixels that are others where every depth and sample is there, which is a fault.
    unplanned: u64,
    /// Pixels that the plan of a file, or effects that were switched off, change.
    changed: u64,
    is_complete: bool,
}

#[derive(serde::Serialize)]
struct Data<'a> {
    scene: &'a str,
    engines: Vec<&'static str>,
    times: &'a Times,
    counters: &'a Counters,
    plan: &'a Plan,
    comparison: &'a Option<Comparison>,
    by_rounding: &'a Option<ByRounding>,
}

pub fn run(arguments: &RenderArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let what = &arguments.what;
    let extension = if arguments.spin.is_some() { "gif" } else { "png" };
    let default = || arguments.page.place.output(format!("{}.{extension}", what.name()));
    let output = arguments.output.as_deref().map_or_else(default, Output::typed);
    if let Some(path) = &arguments.output {
        let what = if extension == "gif" { "a full turn" } else { "the picture" };
        ends_in(path, extension, what)?;
    }
    // Whose name is chosen even where that of the picture is typed. It is not always drawn, so whether it
    // replaces something is seen when it is.
    let difference =
        arguments.page.place.output_in(Path::new(""), output.path.with_extension("difference.png"));
    let page = arguments.page.page("render.html");
    let files = [
        what.source().err().map(|path| ("the model", path, Use::Reads)),
        arguments.plan.as_deref().map(|path| ("--plan", path, Use::Reads)),
        Some(written("--output", &output)),
        Some(("the picture of differences", &difference.path, Use::Writes(Over::Updated))),
        as_file(&page),
    ];
    let files: Vec<_> = files.into_iter().flatten().collect();
    files::check(files.iter().copied())?;
    let purpose = match arguments.engine {
        DrawnBy::Both => Purpose::Compared,
        DrawnBy::Scanline | DrawnBy::EdgeFunction | DrawnBy::Tiles => Purpose::Drawn,
    };
    let maker = what.maker(typed, purpose, streams)?;
    // A model names files of its own.
    files::check(files.iter().copied())?;
    let drawers = if arguments.engine == DrawnBy::Both { 2 } else { 1 };
    let pictures = u64::from(arguments.spin.unwrap_or(1)) * drawers;
    let progress = Progress::new(streams.progress, "pictures", Some(pictures));
    if arguments.engine == DrawnBy::Tiles {
        return draw_in_tiles((arguments, typed), &maker, &output, streams);
    }
    if let Some(frames) = arguments.spin {
        return spin(arguments, &maker, frames, &output, &progress, streams);
    }
    let scene = &maker.scene;
    if arguments.map {
        return map(arguments, scene, &output, streams);
    }
    let mut drawings = draw(arguments, scene, &progress)?;
    let picture = picture::png(&picture::of_frame(&drawings[0].rendered.picture));
    let comparison = compare(scene, &drawings, arguments.plan.is_some())?;
    let by_rounding =
        (!arguments.wireframe).then(|| by_rounding(scene, &drawings[0].target)).transpose()?;
    drop(progress);
    let drawn_in = streams.save(&output, &picture).then_some(output.path.as_path());
    // What a plan changes in both frames alike is no difference between them.
    let is_drawn = |c: &&Comparison| !(c.agrees() || is_plan_alone(c, &drawings)) || leaves_open(c);
    let mut difference_in = None;
    if let Some(comparison) = comparison.as_ref().filter(is_drawn) {
        let picture = picture::png(&picture::of_frame(&comparison.picture));
        difference_in = streams.save(&difference, &picture).then_some(difference.path.as_path());
    }
    let times = Times {
        loading_s: maker.model.loading_s,
        drawing_s: drawings.iter().map(|drawing| drawing.time.as_secs_f64()).collect(),
    };
    let mut data = serde_json::Value::Null;
    if arguments.json {
        // With its scene the plan can be drawn by.
        drawings[0].rendered.plan.scene = Some(SceneDigest::of(scene));
        let Rendered { counters, plan, .. } = &drawings[0].rendered;
        let (scene, engines, times) = (&scene.name, names(&drawings), &times);
        let (comparison, by_rounding) = (&comparison, &by_rounding);
        data =
            json::value(&Data { scene, engines, times, counters, plan, comparison, by_rounding });
    }
    let mut notes = notes(scene, &drawings, &times, comparison.as_ref(), [drawn_in, difference_in]);
    if picture::is_plain(drawings[0].rendered.picture.rows().flat_map(|(_, row)| row)) {
        notes.push("EMPTY: nothing of it is seen; the picture is background alone".to_owned());
        let why = Some(&maker.model.why_empty).filter(|why| !why.is_empty());
        notes.extend(why.map(|why| format!("the cause is that {why}")));
    }
    notes.extend(by_rounding.and_then(|found| rounding(found, ROUNDING)));
    let difference_in = difference_in.map(printable_path);
    let outcome = outcome(&drawings, comparison.as_ref(), difference_in);
    let about = format!("{}: {}", scene.name, scene.about);
    let mut report = Report { about, data, notes, outcome, ..Report::default() };
    let status = exit::of(comparison.as_ref().is_none_or(Comparison::agrees));
    show(report.clone(), Shown::Screen.or_json(arguments.json), None, status, streams)?;
    if let Some(page) = page {
        add_to_page(&mut report, typed, scene, &drawings, comparison.as_ref());
        write_page(&page, report, streams);
    }
    Ok(status)
}

fn names(drawings: &[Drawing]) -> Vec<&'static str> {
    drawings.iter().map(|drawing| drawing.name).collect()
}

/// Whether two rasterizers have drawn no pixel at all, so that two backgrounds would be compared.
fn is_nothing_drawn(drawings: &[Drawing]) -> bool {
    drawings.len() > 1 && drawings.iter().all(|drawing| drawing.rendered.counters.fragments == 0)
}

/// Pixels that the plan of a file, or effects that were switched off, change.
fn changed(drawings: &[Drawing]) -> u64 {
    drawings.iter().map(|drawing| drawing.changed).max().unwrap_or(0)
}

/// Whether two frames are alike, and nothing but their plan is wrong.
fn is_plan_alone(c: &Comparison, drawings: &[Drawing]) -> bool {
    c.wrong_depths == 0 && c.wrong_pixels > 0 && c.wrong_pixels == changed(drawings)
}

/// Compares two drawings, where there is something to compare; ties are looked for where there are depths to look at.
fn compare(
    scene: &Scene,
    drawings: &[Drawing],
    follows_plan: bool,
) -> Result<Option<Comparison>, InputError> {
    let [a, b] = drawings else { return Ok(None) };
    if is_nothing_drawn(drawings) {
        return Ok(None);
    }
    let drawn = [(Engine::Scanline, a), (Engine::EdgeFunction, b)];
    let drawn = drawn.map(|(engine, drawing)| Drawn { engine, target: &drawing.target });
    let is_complete = a.is_complete && b.is_complete;
    let ties = is_complete.then(|| undecided::find(scene, drawn)).transpose()?;
    let (first, second) = ((&a.rendered.picture, &a.target), (&b.rendered.picture, &b.target));
    let mut comparison = frame_comparison::compare(first, second, ties.as_ref());
    comparison.wrong_pixels += a.unplanned + b.unplanned;
    if follows_plan {
        // Two rasterizers that follow one wrong plan agree with each other, not with the scene.
        comparison.wrong_pixels += changed(drawings);
    }
    Ok(Some(comparison))
}

/// Pixels in which rounding alone decides which surface is seen, as `study` counts them.
fn by_rounding(scene: &Scene, target: &Target) -> Result<ByRounding, InputError> {
    if scene.hidden == Hidden::Painter {
        return Ok(ByRounding::default());
    }
    let classes = classify(scene, target)?;
    let first = classes.first.map(|pair| pair.pixel.into());
    Ok(ByRounding { pixels: classes.by_rounding, first })
}

/// What decides which surface is seen, and how far it reaches, in words: for every rasterizer, and for tiles.
const ROUNDING: [&str; 2] = ["rounding alone", "snapped corners move a depth"];
const ROUNDING_IN_TILES: [&str; 2] =
    ["rounding to f32 or snapping", "snapping and f32 move a depth"];

/// The same in words; nothing where nothing is.
fn rounding(found: ByRounding, [what, reach]: [&str; 2]) -> Option<String> {
    let (x, y) = found.first?;
    let pixels = match found.pixels {
        1 => "1 pixel has",
        count => &format!("{count} pixels have"),
    };
    Some(format!(
        "ROUNDING: {pixels} two surfaces nearer to each other than {reach}; {what} decides which one is \
         seen; the first is at {x}, {y} (see docs/ties.md)"
    ))
}

/// What two drawings come to, or that nothing was drawn.
fn outcome(
    drawings: &[Drawing],
    comparison: Option<&Comparison>,
    difference: Option<String>,
) -> Option<Outcome> {
    let Some(c) = comparison else {
        return is_nothing_drawn(drawings).then(|| Outcome::not_compared(Outcome::NOTHING_DRAWN));
    };
    let names = names(drawings).join(" and ");
    let Comparison { wrong_pixels: wrong, pixels, wrong_depths, depths, .. } = c;
    let sentence = if c.agrees() {
        format!("{names}, {pixels} pixels and {depths} depths, 0 differ")
    } else if is_plan_alone(c, drawings) {
        format!("{names} draw alike, and by this plan {wrong} of {pixels} pixels wrong; plan again")
    } else {
        let place = difference.map(|path| format!(", drawn in {path}")).unwrap_or_default();
        let depths = format!("{wrong_depths} of {depths} depths differ{place}");
        format!("{names}: {wrong} of {pixels} pixels and {depths}")
    };
    Some(Outcome::of(c.agrees(), sentence))
}

/// What a page has besides: the frames side by side, and the plan that was followed.
fn add_to_page(
    report: &mut Report,
    typed: &Typed,
    scene: &Scene,
    drawings: &[Drawing],
    comparison: Option<&Comparison>,
) {
    let layer = |d: &Drawing| PictureLayer::new(d.name, &picture::of_frame(&d.rendered.picture));
    let marked = comparison.filter(|c| !c.agrees() || leaves_open(c));
    let marked = marked.map(|c| PictureLayer::map("what differs", &picture::of_frame(&c.picture)));
    report.title = format!("The scene {}", scene.name);
    report.command = typed.line();
    let plan = drawings.first().map(|d| plan_table::table(&d.rendered.plan.decisions));
    report.tables.splice(0..0, plan);
    report.frames = vec![PictureView {
        name: scene.name.clone(),
        about: scene.about.clone(),
        command: typed.line(),
        chapter: Chapter { title: "chapter 9, the pipeline", path: "ch09.md" },
        layers: drawings.iter().map(layer).chain(marked).collect(),
    }];
}

/// A plan from a file: the plan alone, or all that `plan --json` writes.
fn read_plan(path: &Path) -> Result<Plan, InputError> {
    let refused = |error: &dyn std::fmt::Display| {
        usage(format!("{}: {}", printable_path(path), printable(&error.to_string())))
    };
    let text = input::read_text(path, limits::DOCUMENT_BYTES)?;
    let whole = serde_json::from_str::<serde_json::Value>(&text).map_err(|e| refused(&e))?;
    let plan = whole.get("plan").unwrap_or(&whole);
    // Before anything else: the words of another version are not misspelt.
    let version = plan.get("version").and_then(serde_json::Value::as_u64);
    if version != Some(VERSION.into()) {
        return Err(refused(&PlanError::Version(version)));
    }
    serde_path_to_error::deserialize(plan).map_err(|error| refused(&error))
}

/// Draws one frame by each rasterizer asked for.
fn draw(
    arguments: &RenderArguments,
    scene: &Scene,
    progress: &Progress,
) -> Result<Vec<Drawing>, InputError> {
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    let plan = arguments.plan.as_deref().map(read_plan).transpose()?;
    let is_free = arguments.effects.is_none() && plan.is_none();
    // To compare every depth, every depth must be there, of every sample.
    let complete =
        Effects::PLANNED.with(Effect::Depth, Mode::Always).with(Effect::Samples, Mode::Always);
    let engines: &[Drawer] = match arguments.engine {
        DrawnBy::Scanline => &[Drawer::Scanline],
        DrawnBy::EdgeFunction => &[Drawer::EdgeFunction],
        DrawnBy::Both => &Drawer::ALL,
        // Drawn before this.
        DrawnBy::Tiles => &[],
    };
    let drawing = |drawer: &Drawer| {
        let mut target = arguments.what.view.target()?;
        let start = Instant::now();
        // Alone, or with what was asked for, a frame is what it is.
        let alone = |name, rendered, time, target| {
            let (unplanned, changed, is_complete) = (0, 0, false);
            Drawing { name, rendered, time, target, unplanned, changed, is_complete }
        };
        if arguments.wireframe {
            let rendered = drawer.render_wireframe(scene, &mut target)?;
            return Ok(alone(drawer.line_name(), rendered, start.elapsed(), target));
        }
        let asked = |target: &mut Target| match (&plan, &arguments.plan) {
            (Some(plan), Some(path)) => drawer
                .execute(plan, scene, target)
                .map_err(|error| usage(format!("{}: {error}", printable_path(path)))),
            _ => drawer.render(scene, &effects, target).map_err(usage),
        };
        let rendered = asked(&mut target)?;
        let time = start.elapsed();
        if engines.len() < 2 {
            return Ok(alone(drawer.name(), rendered, time, target));
        }
        let whole = drawer.render(scene, &complete, &mut target)?;
        let differing = frame_comparison::differing(&rendered.picture, &whole.picture);
        if is_free || differing == 0 {
            let drawn = alone(drawer.name(), rendered, time, target);
            return Ok(Drawing { unplanned: differing, is_complete: true, ..drawn });
        }
        // What was asked for changes the picture: the frame is compared as it is, without ties.
        let rendered = asked(&mut target)?;
        Ok(Drawing { changed: differing, ..alone(drawer.name(), rendered, time, target) })
    };
    engines.iter().map(drawing).inspect(|_| progress.done(1)).collect()
}

/// Whether some pixels are right in either of two colours.
fn leaves_open(c: &Comparison) -> bool {
    c.undecided > 0 || c.far_texture > 0
}

/// What was drawn, how long that took, and what is right in either of two colours.
fn notes(
    scene: &Scene,
    drawings: &[Drawing],
    times: &Times,
    comparison: Option<&Comparison>,
    [output, difference]: [Option<&Path>; 2],
) -> Vec<String> {
    let c = &drawings[0].rendered.counters;
    let mut notes = vec![
        format!(
            "vertices {}, triangles {} (rejected {}, clipped {}), in the window {}, culled {}",
            c.vertices, c.triangles, c.rejected, c.clipped, c.pieces, c.culled
        ),
        format!(
            "fragments {}, depth tests {} (failed {}), shaded {}",
            c.fragments, c.depth_tests, c.depth_failed, c.shaded
        ),
    ];
    if let (Some(most), true) = (scene.layers, c.layers > 0) {
        notes.push(format!(
            "layers {}, of which {} lie behind the {most} nearest of their sample and are left out",
            c.layers, c.layers_left_out
        ));
    }
    notes.push(times_text(times, &names(drawings)));
    notes.extend(output.map(|output| format!("drawn in {}", printable_path(output))));
    let changed = changed(drawings);
    if changed > 0 {
        notes.push(format!("what is switched off is called for: it changes {changed} pixels"));
    }
    let Some(c) = comparison else { return notes };
    let Comparison { undecided, undecided_differ, far_texture, .. } = c;
    if *undecided > 0 {
        let place = difference.map(|path| format!(", drawn in {}", printable_path(path)));
        let place = place.unwrap_or_default();
        notes.push(format!(
            "UNDECIDED: {undecided} pixels are undecided by either, {undecided_differ} of them differ: \
             surfaces that tie{place} (see docs/ties.md)"
        ));
    }
    if *far_texture > 0 {
        notes.push(format!(
            "UNDECIDED: {far_texture} pixels differ by large texture coordinates, whose bound holds \
             several texels (see docs/ties.md)"
        ));
    }
    notes
}

/// `loaded in 12 ms; drawn in 3.1 ms by scanline, 4.0 ms by edge-function`.
fn times_text(times: &Times, names: &[&str]) -> String {
    let shown = |seconds: f64| match seconds * 1e3 {
        ms if ms < 10.0 => format!("{ms:.1} ms"),
        ms if ms < 1e3 => format!("{ms:.0} ms"),
        _ => format!("{seconds:.2} s"),
    };
    let loaded = times.loading_s.map(|time| format!("loaded in {}; ", shown(time)));
    let by = times.drawing_s.iter().zip(names);
    let drawn: Vec<_> = by.map(|(&time, name)| format!("{} by {name}", shown(time))).collect();
    format!("{}drawn in {}", loaded.unwrap_or_default(), drawn.join(", "))
}

/// One frame in tiles: a picture and nothing else.
fn draw_in_tiles(
    (arguments, typed): (&RenderArguments, &Typed),
    maker: &Maker,
    output: &Output,
    streams: &mut Streams<'_>,
) -> Status {
    let others = ["depth", "effects", "json", "map", "plan", "report", "spin", "wireframe"];
    let is_aa = !matches!(arguments.what.view.aa, Antialias::None | Antialias::Multisample4);
    let refused = is_aa.then_some("aa other than none and msaa4").or(typed.given(&others));
    if let Some(option) = refused {
        return Err(usage(format!("--{option} is not for --engine tiles; name another engine")));
    }
    let mut target = arguments.what.view.target()?;
    let size = target.size();
    let scene = &maker.scene;
    let division = Division::new(scene, size.width(), size.height())?;
    let handed_over = division.handed_over;
    let start = Instant::now();
    let picture = division.render(Tiles::default(), &mut target, &mut |scene, effects, target| {
        Drawer::Scanline.render(scene, effects, target)
    });
    let picture = picture?;
    let times =
        Times { loading_s: maker.model.loading_s, drawing_s: vec![start.elapsed().as_secs_f64()] };
    let all = scene.triangles();
    let name = match handed_over.triangles() {
        0 => "tiles",
        handed_over if handed_over == all => "scanline",
        _ => "tiles and scanline",
    };
    let mut notes = vec![times_text(&times, &[name])];
    let beyond_f32 = "are of an item with values beyond 2^62, which may overflow in f32";
    let reasons = [
        (handed_over.in_shadows, "are in a scene with shadows"),
        (handed_over.not_opaque, "are of a material that is not opaque"),
        (handed_over.physical, "are of a physical material"),
        (handed_over.beyond_f32, beyond_f32),
    ];
    for (count, reason) in reasons.into_iter().filter(|(count, _)| *count > 0) {
        notes.push(format!("{count} of {all} triangles {reason}: handed to scanline"));
    }
    let is_handed_over = handed_over.triangles() == all;
    if streams.save(output, &picture::png(&picture::of_frame(&picture))) {
        let (side, path) = (frames::SIDE_PX, printable_path(&output.path));
        let tiles = format!("in tiles of {side} x {side} px ");
        notes.push(format!("drawn {}in {path}", if is_handed_over { "" } else { &tiles }));
    }
    if !is_handed_over {
        let mut other = arguments.what.view.target()?;
        let exact = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut other)?;
        let differing = frame_comparison::differing(&picture, &exact.picture);
        if differing > 0 {
            let pixels = u64::from(size.width()) * u64::from(size.height());
            notes.push(format!("{differing} of {pixels} pixels differ from those of scanline"));
        }
        let found = TiedPieces::new(scene, &target)?.by_planes_in_f32();
        notes.extend(rounding(found, ROUNDING_IN_TILES));
    }
    let about = format!("{}: {}", scene.name, scene.about);
    print(Report { about, notes, ..Report::default() }, exit::AGREES, streams)
}

/// Saves a picture, and says where.
fn saved(output: &Output, picture: &[u8], streams: &mut Streams<'_>) -> String {
    match streams.save(output, picture) {
        true => format!(", drawn in {}", printable_path(&output.path)),
        false => String::new(),
    }
}

fn map(
    arguments: &RenderArguments,
    scene: &Scene,
    output: &Output,
    streams: &mut Streams<'_>,
) -> Status {
    let mut target = arguments.what.view.target()?;
    let drawer = match arguments.engine {
        DrawnBy::EdgeFunction => Drawer::EdgeFunction,
        _ => Drawer::Scanline,
    };
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    let (rendered, map) = drawer.render_mapped(scene, &effects, &mut target)?;
    let title = format!("{}: what each pixel pays for", scene.name);
    let picture = picture::png(&frame_comparison::map_picture(&title, &rendered.picture, &map));
    let drawn_in = saved(output, &picture, streams);
    let row = |effect: Effect| {
        let paid = frame_comparison::paid(&map.effects, effect);
        Row::of(&[&effect.name(), &thousands(paid)])
    };
    let amounts = [("fragments", &map.fragments), ("effects of fragments", &map.payments)];
    let notes = amounts.map(|(what, counts)| {
        let Amount { mean, most, at: [x, y], pixels } = Amount::of(counts);
        format!(
            "{what}: {mean:.2} a pixel on average, at most {most} (in {pixels} px, first {x},{y})"
        )
    });
    let rows = frame_comparison::mapped().map(row).collect();
    let table = Table::new("", "effect 15 | >px 9", rows).noted(notes.to_vec());
    let about = format!("{}: effects paid for{drawn_in}", scene.name);
    print(Report { about, tables: vec![table], ..Report::default() }, exit::AGREES, streams)
}

/// Frames of a full turn, into one GIF, which sees the front buffer alone: finished frames.
fn spin(
    arguments: &RenderArguments,
    maker: &Maker,
    frames: u32,
    output: &Output,
    progress: &Progress,
    streams: &mut Streams<'_>,
) -> Status {
    let mut bytes = Vec::new();
    let (mut wrong, mut undecided, mut far) = (0, 0, 0);
    let mut is_compared = false;
    let mut screen = DoubleBuffer::new(arguments.what.view.target()?);
    let mut counters = Counters::default();
    {
        let mut encoder = GifEncoder::new_with_speed(&mut bytes, 10);
        let failed = |error: image::ImageError| usage(format!("the GIF: {error}"));
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        for frame in 0..frames {
            let scene = maker.turned(f64::from(frame) / f64::from(frames));
            let drawings = draw(arguments, &scene, progress)?;
            if let Some(c) = compare(&scene, &drawings, false)? {
                is_compared = true;
                wrong += c.wrong_pixels + c.wrong_depths;
                undecided += c.undecided;
                far += c.far_texture;
            }
            if let Some(first) = drawings.into_iter().next() {
                screen.back = first.target;
                screen.present(first.rendered.picture, &mut counters);
            }
            let picture = rgba(screen.front());
            let delay = image::Delay::from_saturating_duration(Duration::from_millis(40));
            let frame = image::Frame::from_parts(picture, 0, 0, delay);
            encoder.encode_frame(frame).map_err(failed)?;
        }
    }
    let drawn_in = saved(output, &bytes, streams);
    let open = [(undecided, "where surfaces tie"), (far, "by large texture coordinates")];
    let open = open.into_iter().filter(|(pixels, _)| *pixels > 0);
    let notes = open.map(|(pixels, what)| format!("UNDECIDED: {pixels} pixels, {what}")).collect();
    let agrees = arguments.engine != DrawnBy::Both || wrong == 0;
    let outcome = (arguments.engine == DrawnBy::Both).then(|| match is_compared {
        false => Outcome::not_compared(Outcome::NOTHING_DRAWN),
        true => Outcome::of(agrees, format!("{wrong} pixels and depths differ")),
    });
    let about = format!("{frames} frames{drawn_in}");
    print(Report { about, notes, outcome, ..Report::default() }, exit::of(agrees), streams)
}

fn rgba(picture: &Frame<Colour>) -> image::RgbaImage {
    let bounds = picture.bounds();
    image::RgbaImage::from_fn(bounds.width(), bounds.height(), |x, y| {
        image::Rgba(picture.row(y as i32)[x as usize])
    })
}
