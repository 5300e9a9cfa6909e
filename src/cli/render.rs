//! `rasterproof render`: a scene or a model to a picture, by either rasterizer or by both.
//!
//! By both it is drawn twice, and the pictures and all depths are compared; only then there is a verdict. Effects that a scene does
//! not call for are left out, and a second frame with all of them shows that this changes nothing.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use image::codecs::gif::{GifEncoder, Repeat};
use rasterproof_host::output::{self, Named, Output, Over, Use};
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::page::{PageArguments, Shown, as_file, print, show, write_page};
use super::progress::Progress;
use super::typed::Typed;
use super::view::{GridArguments, Maker, SceneArguments, view_and_grid};
use super::{InputError, Status, Streams, ends_in, exit, usage};
use rasterproof_core::frame::Frame;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::depth_ties::{ByRounding, TiedPieces};
use rasterproof_render::effects::plan::{Plan, SceneDigest, VERSION};
use rasterproof_render::effects::render::{PlanError, Rendered};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_report::frame_comparison::{self, Comparison, Times};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::words::noun;
use rasterproof_report::{json, picture};
use rasterproof_study::bounds::Purpose;
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_study::grid::{self, Cells};
use rasterproof_study::report::drawing::{
    self, ByGrid, Data, Drawing, ROUNDING, ROUNDING_IN_TILES, add_to_page, compare, grid_notes,
    is_plan_alone, leaves_open, names, notes, outcome, rounding, snapped, times_text,
    undecided_and_broken,
};
use rasterproof_study::snapping::BySnapping;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::{self, Division};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("render"))]
pub struct RenderArguments {
    #[command(flatten)]
    what: SceneArguments,
    #[command(flatten)]
    grid: GridArguments,
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

/// The pictures that may be drawn.
struct Pictures {
    /// The first frame, or the full turn.
    drawn: Output,
    /// Where two rasterizers differ.
    difference: Output,
    /// What a grid other than the usual one changes.
    by_grid: Output,
}

impl Pictures {
    /// Their names; all begin as that of the first one. Two of them are not always drawn, so whether they replace something is seen
    /// when they are.
    fn named_by(arguments: &RenderArguments) -> Result<Self, InputError> {
        let (extension, what) = match arguments.spin {
            Some(_) => ("gif", "a full turn"),
            None => ("png", "the picture"),
        };
        let place = &arguments.page.place;
        let drawn = match &arguments.output {
            Some(path) => {
                ends_in(path, extension, what)?;
                Output::typed(path)
            }
            None => place.output(format!("{}.{extension}", arguments.what.name())),
        };
        let beside = |ending| place.output_in(Path::new(""), drawn.path.with_extension(ending));
        Ok(Self { difference: beside("difference.png"), by_grid: beside("grid.png"), drawn })
    }

    /// All files of the command.
    fn files<'a>(
        &'a self,
        arguments: &'a RenderArguments,
        page: &'a Option<Output>,
    ) -> Vec<Named<'a>> {
        let mut files = Vec::new();
        files.extend(arguments.what.source().err().map(|path| ("the model", path, Use::Reads)));
        files.extend(arguments.plan.as_deref().map(|path| ("--plan", path, Use::Reads)));
        files.push(self.drawn.named("--output"));
        let updated = Use::Writes(Over::Updated);
        files.push(("the picture of differences", &self.difference.path, updated));
        if arguments.grid.grid() != CornerGrid::USUAL {
            files.push(("the picture of what the grid changes", &self.by_grid.path, updated));
        }
        files.extend(as_file(page));
        files
    }
}

/// Draws a scene or a model in the way that the options ask for.
pub fn run(arguments: &RenderArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let pictures = Pictures::named_by(arguments)?;
    let page = arguments.page.page("render.html");
    output::check_all(pictures.files(arguments, &page))?;
    let purpose = match arguments.engine {
        DrawnBy::Both => Purpose::Compared,
        DrawnBy::Scanline | DrawnBy::EdgeFunction | DrawnBy::Tiles => Purpose::Drawn,
    };
    let mut maker = arguments.what.maker(typed, purpose, streams)?;
    // A model names files of its own.
    output::check_all(pictures.files(arguments, &page))?;
    let usual = on_grid((arguments, typed), &mut maker)?;
    let drawers = if arguments.engine == DrawnBy::Both { 2 } else { 1 };
    let count = u64::from(arguments.spin.unwrap_or(1)) * drawers;
    let progress = Progress::new(streams.progress, "pictures", Some(count));
    if arguments.engine == DrawnBy::Tiles {
        return draw_in_tiles((arguments, typed), &maker, &pictures.drawn, streams);
    }
    if let Some(frames) = arguments.spin {
        return spin(arguments, &maker, frames, &pictures.drawn, &progress, streams);
    }
    if arguments.map {
        return map(arguments, &maker.scene, &pictures.drawn, streams);
    }
    let found = RenderFindings::of(arguments, &maker, usual.as_ref(), &progress)?;
    drop(progress);
    found.show((arguments, typed), &maker, &pictures, page, streams)
}

/// The frame by each rasterizer, and what was found when they were looked at.
struct RenderFindings {
    drawings: Vec<Drawing>,
    comparison: Option<Comparison>,
    /// What rounding and snapping decide, of surfaces; lines have neither.
    looked: Option<(ByRounding, BySnapping)>,
    /// What a grid other than the usual one changes.
    changed: Option<ByGrid>,
}

impl RenderFindings {
    /// Draws and compares, with a bar while it lasts.
    fn of(
        arguments: &RenderArguments,
        maker: &Maker,
        usual: Option<&UsualGrid>,
        progress: &Progress,
    ) -> Result<Self, InputError> {
        let scene = &maker.scene;
        let drawings = draw(arguments, scene, progress)?;
        let mut comparison = compare(scene, &drawings, arguments.plan.is_some())?;
        // Corners are looked at as the file has them, before a grid has moved them.
        let mut looked = None;
        if !arguments.wireframe {
            let as_given = usual.map_or(scene, |usual| &usual.scene);
            let (origins, grid) = (&maker.model.origins, arguments.grid.grid());
            looked = Some(undecided_and_broken(as_given, origins, &drawings[0].target, grid)?);
        }
        let mut changed = None;
        if let Some(usual) = usual {
            changed = Some(usual.changed(&drawings[0])?);
            if let Some(comparison) = &mut comparison {
                // What one exact engine covers on this grid and the other does not is wrong by one of them.
                comparison.wrong_pixels += usual.disagreeing;
            }
        }
        Ok(Self { drawings, comparison, looked, changed })
    }

    /// Saves the pictures, prints what was found, and writes the page.
    fn show(
        mut self,
        (arguments, typed): (&RenderArguments, &Typed),
        maker: &Maker,
        pictures: &Pictures,
        page: Option<Output>,
        streams: &mut Streams<'_>,
    ) -> Status {
        let scene = &maker.scene;
        let png = |picture: &Frame<Colour>| picture::png(&picture::of_frame(picture));
        let first = png(&self.drawings[0].rendered.picture);
        let drawn_in = streams.save(&pictures.drawn, &first).then_some(&*pictures.drawn.path);
        let mut difference_in = None;
        if let Some(comparison) = self.comparison.as_ref().filter(|c| self.is_difference(c)) {
            let is_saved = streams.save(&pictures.difference, &png(&comparison.picture));
            difference_in = is_saved.then_some(&*pictures.difference.path);
        }
        let times = Times {
            loading_s: maker.model.loading_s,
            drawing_s: self.drawings.iter().map(|drawing| drawing.time.as_secs_f64()).collect(),
        };
        let mut data = serde_json::Value::Null;
        if arguments.json {
            // With its scene the plan can be drawn by.
            self.drawings[0].rendered.plan.scene = Some(SceneDigest::of(scene));
            data = self.data(scene, &times);
        }
        let Self { drawings, comparison, looked, changed } = self;
        let comparison = comparison.as_ref();
        let mut notes = notes(scene, &drawings, &times, comparison, [drawn_in, difference_in]);
        notes.extend(why_empty(&drawings[0].rendered.picture, maker));
        let grid = arguments.grid.grid();
        if let Some((by_rounding, by_snapping)) = looked {
            notes.extend(rounding(by_rounding, ROUNDING));
            let word = arguments.what.source().map_or_else(OsString::from, OsString::from);
            let study = typed.as_command("study", word, &view_and_grid()).line();
            notes.extend(snapped(by_snapping, grid, &study));
        }
        if let Some(changed) = &changed {
            let by_grid = &pictures.by_grid;
            let is_drawn = changed.pixels > 0 && streams.save(by_grid, &png(&changed.picture));
            let place = is_drawn.then(|| printable_path(&by_grid.path));
            notes.extend(grid_notes(changed, grid, place));
        }
        let outcome = outcome(&drawings, comparison, difference_in.map(printable_path));
        let about = format!("{}: {}", scene.name, scene.about);
        let mut report = Report { about, data, notes, outcome, ..Report::default() };
        let status = exit::of(comparison.is_none_or(Comparison::agrees));
        // Pictures of a page are made once the verdict is said.
        show(report.clone(), Shown::Screen.or_json(arguments.json), None, status, streams)?;
        if let Some(page) = page {
            add_to_page(&mut report, typed.line(), scene, &drawings, comparison);
            write_page(&page, report, streams);
        }
        Ok(status)
    }

    /// Whether a picture shows where the frames differ. What a plan changes in both frames alike is no difference between them.
    fn is_difference(&self, comparison: &Comparison) -> bool {
        let is_alike = comparison.agrees() || is_plan_alone(comparison, &self.drawings);
        !is_alike || leaves_open(comparison)
    }

    /// What machines read.
    fn data(&self, scene: &Scene, times: &Times) -> serde_json::Value {
        let Rendered { counters, plan, .. } = &self.drawings[0].rendered;
        let (mut by_rounding, mut by_snapping) = (None, None);
        if let Some((rounding, snapping)) = &self.looked {
            (by_rounding, by_snapping) = (Some(rounding), Some(snapping));
        }
        json::value(&Data {
            scene: &scene.name,
            engines: names(&self.drawings),
            times,
            counters,
            plan,
            comparison: &self.comparison,
            by_rounding,
            by_snapping,
            grid: self.changed.as_ref(),
        })
    }
}

/// That a picture is background alone, and the cause, where it is known.
fn why_empty(picture: &Frame<Colour>, maker: &Maker) -> Vec<String> {
    let background = maker.scene.background;
    if picture.rows().any(|(_, row)| row.iter().any(|colour| *colour != background)) {
        return Vec::new();
    }
    let mut notes =
        vec!["EMPTY: nothing of it is seen; the picture is background alone".to_owned()];
    let why = &maker.model.why_empty;
    if !why.is_empty() {
        notes.push(format!("the cause is that {why}"));
    }
    notes
}

/// Puts the corners of what is drawn on the grid that was asked for; what was to be drawn before, where that is not the usual one.
fn on_grid(
    (arguments, typed): (&RenderArguments, &Typed),
    maker: &mut Maker,
) -> Result<Option<UsualGrid>, InputError> {
    let grid = arguments.grid.grid();
    if grid == CornerGrid::USUAL {
        return Ok(None);
    }
    // Lines join whole pixels, a plan is made for the triangles of a scene, and a full turn is many scenes.
    if let Some(option) = typed.given(&["wireframe", "plan", "spin", "map"]) {
        return Err(usage(format!("--{option} is not for corners {grid}: leave one of them out")));
    }
    if arguments.what.view.aa == Antialias::Multisample4 {
        return Err(usage(format!(
            "--aa msaa4 has no samples for corners {grid}: choose ssaa2, or leave it out"
        )));
    }
    let target = arguments.what.view.target()?;
    let Cells { scene, disagreeing } =
        grid::cells(&maker.scene, target.bounds(), grid).map_err(usage)?;
    // The usual scene stays as it is, to see what the other grid changes in it.
    let scene = std::mem::replace(&mut maker.scene, scene);
    Ok(Some(UsualGrid { scene, disagreeing, target }))
}

/// A scene as it is drawn on the usual grid.
struct UsualGrid {
    scene: Scene,
    /// Pixels that the exact engines do not agree about on the other grid.
    disagreeing: u64,
    target: Target,
}

impl UsualGrid {
    /// What the other grid changes in the first drawing.
    fn changed(&self, drawing: &Drawing) -> Result<ByGrid, InputError> {
        let mut target = self.target.clone();
        let effects = Effects::PLANNED;
        let usual = Drawer::Scanline.render(&self.scene, &effects, &mut target).map_err(usage)?;
        Ok(ByGrid::between((&usual.picture, &target), drawing))
    }
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
        return Err(refused(&PlanError::of_version(version)));
    }
    serde_path_to_error::deserialize(plan).map_err(|error| refused(&error))
}

/// Draws one frame by each rasterizer asked for.
fn draw(
    arguments: &RenderArguments,
    scene: &Scene,
    progress: &Progress,
) -> Result<Vec<Drawing>, InputError> {
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
    let mut drawings = Vec::new();
    for drawer in engines {
        let mut target = arguments.what.view.target()?;
        let start = Instant::now();
        let rendered = draw_as_asked(arguments, plan.as_ref(), *drawer, scene, &mut target)?;
        let time = start.elapsed();
        // Alone, or with what was asked for, a frame is what it is.
        let name = if arguments.wireframe { drawer.line_name() } else { drawer.name() };
        let (unplanned, changed, is_complete) = (0, 0, false);
        let mut drawing = Drawing { name, rendered, time, target, unplanned, changed, is_complete };
        if engines.len() > 1 && !arguments.wireframe {
            // The same frame with every depth, which then are in its target.
            let target = &mut drawing.target;
            let whole = drawer.render(scene, &complete, target)?;
            let differing = frame_comparison::differing(&drawing.rendered.picture, &whole.picture);
            if is_free || differing == 0 {
                (drawing.unplanned, drawing.is_complete) = (differing, true);
            } else {
                // What was asked for changes the picture: the frame is compared as it is, without ties.
                drawing.rendered = draw_as_asked(arguments, plan.as_ref(), *drawer, scene, target)?;
                drawing.changed = differing;
            }
        }
        drawings.push(drawing);
        progress.done(1);
    }
    Ok(drawings)
}

/// Draws a frame by a plan, by the effects that were asked for, or as edges.
fn draw_as_asked(
    arguments: &RenderArguments,
    plan: Option<&Plan>,
    drawer: Drawer,
    scene: &Scene,
    target: &mut Target,
) -> Result<Rendered, InputError> {
    if arguments.wireframe {
        return Ok(drawer.render_wireframe(scene, target)?);
    }
    if let (Some(plan), Some(path)) = (plan, &arguments.plan) {
        let rendered = drawer.execute(plan, scene, target);
        return rendered.map_err(|error| usage(format!("{}: {error}", printable_path(path))));
    }
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    drawer.render(scene, &effects, target).map_err(usage)
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
    // Items that tiles cannot draw are drawn by the scanline engine.
    let name = match handed_over.triangles() {
        0 => "tiles",
        handed_over if handed_over == all => "scanline",
        _ => "tiles and scanline",
    };
    let mut notes = vec![times_text(&times, &[name])];
    notes.extend(drawing::handed_over(&handed_over, all));
    let is_handed_over = handed_over.triangles() == all;
    if streams.save(output, &picture::png(&picture::of_frame(&picture))) {
        let (side, path) = (frames::SIDE_PX, printable_path(&output.path));
        let tiles = format!("in tiles of {side} x {side} px ");
        notes.push(format!("drawn {}in {path}", if is_handed_over { "" } else { &tiles }));
    }
    // Tiles are exact in coverage alone: colours may be rounded otherwise, and depths that are close may change places.
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

/// A small picture for each effect, of the pixels that paid for it.
fn map(
    arguments: &RenderArguments,
    scene: &Scene,
    output: &Output,
    streams: &mut Streams<'_>,
) -> Status {
    let mut target = arguments.what.view.target()?;
    // Both rasterizers pay for the same effects, so one of them is enough.
    let drawer = match arguments.engine {
        DrawnBy::EdgeFunction => Drawer::EdgeFunction,
        _ => Drawer::Scanline,
    };
    let effects = arguments.effects.unwrap_or(Effects::PLANNED);
    let (rendered, map) = drawer.render_mapped(scene, &effects, &mut target)?;
    let title = format!("{}: what each pixel pays for", scene.name);
    let picture = picture::png(&frame_comparison::map_picture(&title, &rendered.picture, &map));
    let drawn_in = saved(output, &picture, streams);
    let table = drawing::paid(&map);
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
    // Of all frames together.
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
            // Numbers of all frames add up: one of them that differs is enough.
            if let Some(c) = compare(&scene, &drawings, false)? {
                is_compared = true;
                wrong += c.wrong_pixels + c.wrong_depths;
                undecided += c.undecided;
                far += c.far_texture;
            }
            // The screen keeps what was finished last, so that no frame is seen half drawn.
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
    let mut notes = Vec::new();
    for (pixels, what) in [(undecided, "where surfaces tie"), (far, "by large texture coordinates")]
    {
        if pixels > 0 {
            let of = noun(pixels, "pixel", "pixels");
            notes.push(format!("UNDECIDED: {pixels} {of}, {what}"));
        }
    }
    let agrees = arguments.engine != DrawnBy::Both || wrong == 0;
    let outcome = (arguments.engine == DrawnBy::Both).then(|| match is_compared {
        false => Outcome::nothing_drawn(),
        true => Outcome::of(agrees, format!("{wrong} pixels and depths differ")),
    });
    let about = format!("{frames} frames{drawn_in}");
    print(Report { about, notes, outcome, ..Report::default() }, exit::of(agrees), streams)
}

/// A picture as the encoder of GIF takes it.
fn rgba(picture: &Frame<Colour>) -> image::RgbaImage {
    let bounds = picture.bounds();
    image::RgbaImage::from_fn(bounds.width(), bounds.height(), |x, y| {
        image::Rgba(picture.row(y as i32)[x as usize])
    })
}
