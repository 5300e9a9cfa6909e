//! `rasterproof plan`: what a scene calls for, why, and what leaving out the rest saves.

use super::page::{PageArguments, Shown, as_file, print, show};
use super::progress::Progress;
use super::typed::Typed;
use super::view::SceneArguments;
use super::{Status, Streams, exit, usage};
use rasterproof_host::output;
use rasterproof_host::text::printable_path;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::Canvas;
use rasterproof_render::effects::{Effect, Effects};
use rasterproof_render::scene::Scene;
use rasterproof_report::html::Report;
use rasterproof_report::{frame_comparison, picture};
use rasterproof_study::bounds::Purpose;
use rasterproof_study::report::plan::{Measurement, reasons, stages};
use rasterproof_study::savings;

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("plan"))]
pub struct PlanArguments {
    #[command(flatten)]
    what: SceneArguments,
    /// The rasterizer
    #[arg(long, default_value = "scanline", value_parser = super::one_of(Drawer::ALL.map(|drawer| (drawer.name(), drawer))))]
    engine: Drawer,
    /// Rounds of measuring, each with every mixture of effects [default: as many as intervals need in 10 s]
    #[arg(long, value_parser = super::whole::<u32>(1..=1000))]
    rounds: Option<u32>,
    /// Measure everything, usual and planned alone, and no single effect
    #[arg(long)]
    whole: bool,
    /// Draw the picture without this effect instead, and what differs, and count the pixels; nothing is measured
    #[arg(long, value_name = "EFFECT", value_parser = parse_effect, conflicts_with_all = ["report", "json", "whole"])]
    without: Option<Effect>,
    /// Print what becomes of each fragment, a list of stages for each piece; nothing is drawn or measured
    #[arg(long, value_name = "WHAT", value_parser = super::one_of([("stages", ())]), conflicts_with_all = ["report", "without", "whole"])]
    show: Option<()>,
    #[command(flatten)]
    page: PageArguments,
    /// For machines
    #[arg(long)]
    json: bool,
}

/// An effect by its name; the error lists the names.
fn parse_effect(name: &str) -> Result<Effect, String> {
    let effect = Effect::ALL.into_iter().find(|effect| effect.name() == name);
    effect.ok_or_else(|| format!("it is none of {}", Effect::ALL.map(Effect::name).join(", ")))
}

/// Measures what leaving out effects saves; or draws without one, or lists what becomes of each fragment.
pub fn run(arguments: &PlanArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    if arguments.without.is_none() {
        arguments.page.refuse_idle_folder(typed)?;
    }
    let page = arguments.page.page("plan.html");
    output::check_all(as_file(&page))?;
    let scene = arguments.what.maker(typed, Purpose::Planned, streams)?.scene;
    output::check_all(as_file(&page))?;
    if arguments.show.is_some() {
        return show_stages(arguments, &scene, streams);
    }
    if let Some(effect) = arguments.without {
        return draw_without(arguments, &scene, effect, streams);
    }
    let progress = Progress::new(streams.progress, "frames", None);
    let (mut target, drawn) = (arguments.what.view.target()?, || progress.done(1));
    let PlanArguments { engine, rounds, whole, .. } = *arguments;
    let (measured, frames) =
        savings::measure((&scene, engine), &mut target, rounds, whole, &drawn)?;
    drop(progress);
    // A plan is worth its survey only where that takes less time than it saves, so it is timed, too.
    let survey_us = savings::survey_us(&scene, &target)?;
    let frames = frames.each_ref();
    let kind = if arguments.what.source().is_ok() { "scene" } else { "model" };
    let savings = &measured;
    let measurement =
        Measurement { scene: &scene, kind, frames, savings, survey_us, is_whole: whole };
    let mut report = measurement.report(typed.line(), page.is_some());
    if arguments.json {
        report.data = measurement.data();
    }
    // A plan that changes a pixel is wrong, however much it saves.
    let same = measurement.is_same();
    show(report, Shown::All.or_json(arguments.json), page, exit::of(same), streams)
}

/// Prints the stages of each piece.
fn show_stages(arguments: &PlanArguments, scene: &Scene, streams: &mut Streams<'_>) -> Status {
    let canvas = Canvas::of(&arguments.what.view.target()?);
    let staged = arguments.engine.stages(scene, &Effects::PLANNED, &canvas);
    let staged = staged.map_err(|error| usage(error.to_string()))?;
    let shown = Shown::All.or_json(arguments.json);
    show(stages(scene, &staged), shown, None, exit::AGREES, streams)
}

/// Draws a scene without an effect, and the pixels that this changes.
fn draw_without(
    arguments: &PlanArguments,
    scene: &Scene,
    effect: Effect,
    streams: &mut Streams<'_>,
) -> Status {
    // Two targets of one size, so that depths of both can be compared.
    let mut targets = [arguments.what.view.target()?, arguments.what.view.target()?];
    let [with, without] = &mut targets;
    let planned = arguments.engine.render(scene, &Effects::PLANNED, with)?;
    let other = arguments.engine.render_without(scene, effect, without)?;
    let (first, second) = ((&planned.picture, &*with), (&other.picture, &*without));
    let difference = frame_comparison::compare(first, second, None).picture;
    let wrong = frame_comparison::differing(&planned.picture, &other.picture);
    let name = effect.name();
    let stem = format!("{}-without-{name}", arguments.what.name());
    let (bounds, scene) = (planned.picture.bounds(), &scene.name);
    let pixels = u64::from(bounds.width()) * u64::from(bounds.height());
    let share = 100.0 * wrong as f64 / pixels.max(1) as f64;
    let about =
        format!("{scene}: {wrong} of {pixels} pixels ({share:.1}%) are wrong without {name}");
    let mut notes = reasons(&planned.plan.decisions, effect);
    for (ending, picture) in [("png", &other.picture), ("difference.png", &difference)] {
        let output = arguments.page.place.output(format!("{stem}.{ending}"));
        if streams.save(&output, &picture::png(&picture::of_frame(picture))) {
            notes.push(format!("drawn in {}", printable_path(&output.path)));
        }
    }
    print(Report { about, notes, ..Report::default() }, exit::AGREES, streams)
}
