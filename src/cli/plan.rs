//! `rasterproof plan`: what a scene calls for, why, and what leaving out the rest saves.

use super::files;
use super::page::{PageArguments, Shown, as_file, print, show};
use super::plan_table::{self, grouped};
use super::progress::Progress;
use super::typed::Typed;
use super::view::{Purpose, SceneArguments};
use super::{Status, Streams, exit};
use rasterproof_host::text::printable_path;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::{Plan, SceneDigest};
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::effects::{Effect, Effects};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::scene::Scene;
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report};
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::thousands;
use rasterproof_report::{frame_comparison, json, picture};
use rasterproof_study::savings::{self, Measured, Saving, Savings};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("plan"))]
pub struct PlanArguments {
    #[command(flatten)]
    what: SceneArguments,
    /// The rasterizer
    #[arg(long, default_value = "scanline", value_parser = super::one_of(Drawer::ALL.map(|drawer| (drawer.name(), drawer))))]
    engine: Drawer,
    /// Rounds of measuring, each with every mixture of effects in turn [default: 9, fewer for a large model]
    #[arg(long, value_parser = super::whole::<u32>(1..=1000))]
    rounds: Option<u32>,
    /// Measure everything, usual and planned alone, and no single effect
    #[arg(long)]
    whole: bool,
    /// Draw the picture without this effect instead, and what differs, and count the pixels; nothing is measured
    #[arg(long, value_name = "EFFECT", value_parser = parse_effect, conflicts_with_all = ["report", "json", "whole"])]
    without: Option<Effect>,
    #[command(flatten)]
    page: PageArguments,
    /// For machines
    #[arg(long)]
    json: bool,
}

fn parse_effect(name: &str) -> Result<Effect, String> {
    let effect = Effect::ALL.into_iter().find(|effect| effect.name() == name);
    effect.ok_or_else(|| format!("it is none of {}", Effect::ALL.map(Effect::name).join(", ")))
}

/// A saving in percent, unless it is within the noise.
fn percent(saving: f64, is_noise: bool) -> String {
    if is_noise { "noise".to_owned() } else { format!("{:.0}%", 100.0 * saving) }
}

#[derive(serde::Serialize)]
struct Data<'a> {
    scene: &'a str,
    plan: Plan,
    everything: &'a Counters,
    planned: &'a Counters,
    measured: &'a Savings,
    survey_us: Option<f64>,
    /// Nothing where nothing was drawn.
    same: Option<bool>,
}

/// A row for each effect: what planning it saves, alone and as the last one.
fn of_each(savings: &Savings) -> Table {
    let row = |s: &Saving| {
        let [alone, all_but] = [s.alone_us, s.all_but_us].map(|us| format!("{us:.0}"));
        let saves_alone = percent(s.saves_alone, s.noise_alone);
        let saves_last = percent(s.saves_last, s.noise_last);
        let wrong = &s.wrong_without;
        Row::of(&[&s.effect.name(), &alone, &saves_alone, &all_but, &saves_last, wrong])
    };
    let caption = "What planning one effect saves: alone, the rest always paid for; as the last, the rest planned";
    let columns = "planned 14 | >alone us 10 it is planned, the rest paid for | >saves 9 compared with paying for \
                       everything | >last us 10 it is paid for, the rest planned | >saves 9 when it is planned too | \
                       >wrong without 14 pixels that change when it is left out everywhere";
    let notes = [
        "noise: the middle halves of the rounds of both overlap, or there are fewer than four",
        "wrong without: pixels that change when it is left out everywhere; --without EFFECT draws them",
    ];
    let rows = savings.effects.iter().map(row).collect();
    Table::new(caption, columns, rows).noted(notes.map(str::to_owned).to_vec())
}

pub fn run(arguments: &PlanArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    if arguments.without.is_none() {
        arguments.page.refuse_idle_folder(typed)?;
    }
    let page = arguments.page.page("plan.html");
    files::check(as_file(&page))?;
    let scene = arguments.what.maker(typed, Purpose::Planned, streams)?.scene;
    files::check(as_file(&page))?;
    if let Some(effect) = arguments.without {
        return draw_without(arguments, &scene, effect, streams);
    }
    let progress = Progress::new(streams.progress, "frames", None);
    let (mut target, drawn) = (arguments.what.view.target()?, || progress.done(1));
    let PlanArguments { engine, rounds, whole, .. } = *arguments;
    let (measured, frames) =
        savings::measure((&scene, engine), &mut target, rounds, whole, &drawn)?;
    drop(progress);
    let survey_us = savings::survey_us(&scene, &target)?;
    let frames @ [everything, planned] = frames.each_ref();
    let same = measured.all().all(|mixture| mixture.same);
    let is_compared = everything.counters.fragments > 0 || !same;
    let mut report = report(arguments, typed, &scene, frames, (&measured, survey_us));
    if page.is_some() {
        report.frames = vec![view(typed, &scene, frames)];
    }
    if arguments.json {
        // With its scene it can be drawn by.
        let plan = Plan { scene: Some(SceneDigest::of(&scene)), ..planned.plan.clone() };
        report.data = json::value(&Data {
            scene: &scene.name,
            plan,
            everything: &everything.counters,
            planned: &planned.counters,
            measured: &measured,
            survey_us,
            same: is_compared.then_some(same),
        });
    }
    show(report, Shown::All.or_json(arguments.json), page, exit::of(same), streams)
}

/// Draws a scene without an effect, and the pixels that this changes.
fn draw_without(
    arguments: &PlanArguments,
    scene: &Scene,
    effect: Effect,
    streams: &mut Streams<'_>,
) -> Status {
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
    let lines = grouped(&planned.plan.decisions).into_iter().filter(|line| line.effect == effect);
    let reason = |line: plan_table::Line<'_>| match line.items().as_str() {
        "frame" => format!("of the frame: {}", line.reason),
        items => format!("of item {items}: {}", line.reason),
    };
    let mut notes: Vec<String> = lines.map(reason).collect();
    for (ending, picture) in [("png", &other.picture), ("difference.png", &difference)] {
        let output = arguments.page.place.output(format!("{stem}.{ending}"));
        if streams.save(&output, &picture::png(&picture::of_frame(picture))) {
            notes.push(format!("drawn in {}", printable_path(&output.path)));
        }
    }
    print(Report { about, notes, ..Report::default() }, exit::AGREES, streams)
}

/// The times of everything, usual and planned, and the mixtures that changed the picture.
fn whole(savings: &Savings, survey_us: Option<f64>, is_whole: bool) -> Table {
    let rows = [
        ("everything", &savings.everything),
        ("usual", &savings.usual),
        ("planned", &savings.planned),
    ];
    let row = |(name, m): (&str, &Measured)| {
        let [low, high] = m.range_us;
        Row::of(&[&name, &format!("{:.0}", m.time_us), &format!("{low:.0}-{high:.0}")])
    };
    let changed = savings.all().filter(|m| !m.same);
    let mut notes: Vec<_> =
        changed.map(|m| format!("DIFFERENT PICTURE with the effects {}", m.effects)).collect();
    let [all, usual] = savings.factors();
    notes.extend([
        format!("planned as a whole: {all:.2} times as fast as everything, {usual:.2} as usual"),
        "usual: what a renderer does without a planner (cuts what crosses, culls, one depth test)"
            .to_owned(),
    ]);
    if savings.effects.is_empty() && !is_whole {
        notes.push(
            "one effect at a time is not measured, since a round of all mixtures takes more than 5 s \
             here: --rounds 9 measures them"
                .to_owned(),
        );
    }
    notes.extend(survey_us.map(|us| {
        let share = 100.0 * us / savings.planned.time_us;
        format!("looking at triangles for the reason of depth: {us:.0} us, {share:.1}% of the planned frame")
    }));
    let columns =
        "paid for 14 | >us 10 median of the rounds | >from-to 14 the fastest round and the slowest";
    Table::new("The frame as a whole", columns, rows.map(row).to_vec()).noted(notes)
}

/// What was counted in both frames.
fn counts([everything, planned]: [&Rendered; 2]) -> Table {
    let both = everything.counters.shown().into_iter().zip(planned.counters.shown());
    let row = |((name, all), (_, planned)): ((&str, u64), (_, u64))| {
        Row::of(&[&name, &thousands(all), &thousands(planned)])
    };
    let columns = "~counts 20 | >everything 12 | >planned 12";
    Table::new("What was counted", columns, both.map(row).collect())
}

/// The frames side by side.
fn view(typed: &Typed, scene: &Scene, frames: [&Rendered; 2]) -> PictureView {
    let layer =
        |(name, frame): (_, &Rendered)| PictureLayer::new(name, &picture::of_frame(&frame.picture));
    PictureView {
        name: scene.name.clone(),
        about: scene.about.clone(),
        command: typed.line(),
        chapter: Chapter { title: "effects", path: "effects.md" },
        layers: ["everything", "planned"].into_iter().zip(frames).map(layer).collect(),
    }
}

fn report(
    arguments: &PlanArguments,
    typed: &Typed,
    scene: &Scene,
    frames: [&Rendered; 2],
    (savings, survey_us): (&Savings, Option<f64>),
) -> Report {
    let [all, usual] = savings.factors();
    let same = savings.all().all(|mixture| mixture.same);
    let sentence = match same {
        true => format!(
            "Planned, it was drawn {all:.1} times as fast as with everything on, and {usual:.1} \
             times as fast as usual, with the same bits."
        ),
        false => "A plan changed the picture.".to_owned(),
    };
    let mut tables = vec![plan_table::table(&frames[1].plan.decisions), counts(frames)];
    tables.extend((!savings.effects.is_empty()).then(|| of_each(savings)));
    tables.push(whole(savings, survey_us, arguments.whole));
    Report {
        title: format!("What the scene {} calls for", scene.name),
        about: format!("{}: {}", scene.name, scene.about),
        outcome: Some(match frames[0].counters.fragments {
            0 if same => Outcome::not_compared(Outcome::NOTHING_DRAWN),
            _ => Outcome::of(same, sentence),
        }),
        command: typed.line(),
        tables,
        ..Report::default()
    }
}
