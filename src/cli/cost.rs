//! `rasterproof cost`: what each step of accuracy costs, as boards, plots and JSON.
//!
//! The price of accuracy is measured in turns, choice after choice, so that a slow moment of the machine slows all of them alike.
//! What was measured once can be shown and drawn again from its JSON.

use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser};
use rasterproof_host::output::{self, Use};
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::view::ViewArguments;
use super::{InputError, Status, Streams, exit, study, usage};
use rasterproof_precision::cost::{
    Board, CostOptions, ExternalChoice, Ladder, Recorded, Timing, measure_with,
};
use rasterproof_study::report::board;

/// What is measured together under one word.
const LADDERS: [(&str, &[Ladder]); 7] = [
    ("coverage", &[Ladder::Scanline, Ladder::EdgeFunction]),
    ("interpolation", &[Ladder::Interpolation]),
    ("depth", &[Ladder::Depth]),
    ("shadows", &[Ladder::Shadows]),
    ("levels", &[Ladder::Levels]),
    ("antialiasing", &[Ladder::Antialiasing]),
    ("lines", &[Ladder::Lines]),
];

/// What is measured on: scenes that isolate one cost each, or a model.
#[derive(Clone, Debug)]
enum Scenes {
    Ladders(&'static [Ladder]),
    Model(PathBuf),
}

/// The parser of what is measured. A word with an ending is meant as a file, also where that does not exist.
fn parse_subject() -> impl TypedValueParser<Value = Scenes> {
    OsStringValueParser::new().try_map(|word| {
        let known = LADDERS.iter().find(|(name, _)| *name == word);
        let path = PathBuf::from(word);
        match known {
            Some((_, ladders)) => Ok(Scenes::Ladders(ladders)),
            None if path.extension().is_some() || path.is_file() => Ok(Scenes::Model(path)),
            None => {
                let names = LADDERS.map(|(name, _)| name).join(", ");
                Err(format!("neither a file nor one of the groups {names}"))
            }
        }
    })
}

#[derive(clap::Args, Debug)]
pub struct CostArguments {
    /// The group of choices, all of them without a word; or the file of a model, to measure on its triangles
    #[arg(value_name = "GROUP|MODEL", value_parser = parse_subject())]
    what: Option<Scenes>,
    /// Smaller scenes and fewer rounds: under ten seconds for all groups
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    once: study::OnceArgument,
    /// Decides every scene
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Put this Vulkan device beside the edge functions; may be repeated: vulkan:0
    #[cfg(feature = "vulkan")]
    #[arg(long, value_name = "NAME", conflicts_with = "from")]
    engine: Vec<String>,
    /// Measure nothing: show and draw again what --json printed into FILE
    #[arg(long, value_name = "FILE", conflicts_with_all = ["quick", "seed"])]
    from: Option<PathBuf>,
    /// Print JSON instead of boards
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    page: PageArguments,
}

impl CostArguments {
    /// Refuses names of plots and pages that are the file of --from or each other's.
    fn check_files(&self, ladders: &[Ladder]) -> Result<(), InputError> {
        let page = self.page.page("cost.html");
        let names =
            ladders.iter().map(|&ladder| board::plot_name(ladder)).chain([board::PRICE.to_owned()]);
        let plots = names.map(|name| self.page.place.output(format!("{name}.svg")));
        let plots: Vec<_> = plots.collect();
        let from = self.from.as_deref().map(|path| ("--from", path, Use::Reads));
        let plots = plots.iter().map(|output| output.named("a plot in --out"));
        Ok(output::check_all(from.into_iter().chain(plots).chain(as_file(&page)))?)
    }

    /// The devices that are measured beside the choices.
    #[cfg(feature = "vulkan")]
    fn external(&self) -> Result<Vec<Box<dyn ExternalChoice>>, InputError> {
        self.engine.iter().map(|name| super::vulkan::external_choice(name)).collect()
    }

    /// There are none.
    #[cfg(not(feature = "vulkan"))]
    #[allow(clippy::unnecessary_wraps, clippy::unused_self, reason = "with devices there are both")]
    fn external(&self) -> Result<Vec<Box<dyn ExternalChoice>>, InputError> {
        Ok(Vec::new())
    }
}

/// Measures or reads, prints and draws. Nothing here disagrees with anything: errors are the result.
pub fn run(arguments: &CostArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let ladders = match &arguments.what {
        Some(Scenes::Model(path)) => {
            // A model is measured on its own triangles, of which no seed decides anything.
            let of_groups = ["from", "seed", "engine"];
            if let Some(option) = typed.given(&of_groups) {
                return Err(usage(format!("--{option} is not for models: leave it out")));
            }
            let how = (arguments.once.timing(arguments.quick), arguments.json);
            arguments.page.refuse_idle_folder(typed)?;
            let file = (&**path, arguments.page.page("cost.html"));
            return study::cost(file, &arguments.view, how, typed, streams);
        }
        Some(Scenes::Ladders(ladders)) => ladders,
        None => Ladder::OF_SCENES,
    };
    study::refuse_view(typed)?;
    // Names of plots are known before minutes are spent on what they show.
    arguments.check_files(ladders)?;
    let recorded = match &arguments.from {
        Some(path) => read(path, ladders)?,
        None => Recorded {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            repeat: typed.clone().without_output().set("seed", arguments.seed).line(),
            seed: arguments.seed,
            quick: arguments.quick,
            boards: measure_all(ladders, arguments, streams.progress)?,
        },
    };
    let place = &arguments.page.place;
    let (mut written, mut figures) = (Vec::new(), Vec::new());
    for (name, figure) in board::plots(&recorded.boards) {
        if streams.save(&place.output(format!("{name}.svg")), figure.svg.as_bytes()) {
            written.push(name);
        }
        // A plot that could not be written is still shown on the page.
        figures.push(figure);
    }
    let mut report = board::report(&recorded, figures);
    report.command = typed.line();
    if !written.is_empty() {
        let (folder, written) = (printable_path(&place.out), written.join(", "));
        report.notes.push(format!("drawn in {folder}, as SVG: {written}"));
    }
    let page = arguments.page.page("cost.html");
    show(report, Shown::All.or_json(arguments.json), page, exit::AGREES, streams)
}

/// What an earlier run printed, as far as it is asked for.
fn read(path: &Path, ladders: &[Ladder]) -> Result<Recorded, InputError> {
    let named = |what: String| usage(format!("{}: {}", printable_path(path), printable(&what)));
    let text = input::read_text(path, limits::DOCUMENT_BYTES)?;
    let mut recorded = Recorded::read(&text).map_err(|why| {
        named(format!("{why}; write such a file with `rasterproof cost --json > FILE`"))
    })?;
    // A file of all groups may be asked about one of them.
    recorded.boards.retain(|board| ladders.contains(&board.ladder));
    if recorded.boards.is_empty() {
        let names: Vec<_> = ladders.iter().map(|ladder| ladder.name()).collect();
        return Err(named(format!("it holds no board of {}", names.join(" or "))));
    }
    Ok(recorded)
}

/// Measures all groups, each scene in rounds of all choices.
fn measure_all(
    ladders: &[Ladder],
    arguments: &CostArguments,
    on_terminal: bool,
) -> Result<Vec<Board>, InputError> {
    let external = arguments.external()?;
    let progress = Progress::new(on_terminal, "percent", Some(100));
    let CostArguments { seed, quick, .. } = *arguments;
    // Of each class of scenes, of which a group has nine.
    let timing = if quick { Timing::QUICK.within(0.3) } else { Timing::USUAL.within(0.5) };
    let options = CostOptions { seed, quick, timing: Some(timing) };
    Ok(measure_with(ladders, &options, external, &|share, what| {
        progress.at((share * 100.0) as u64, what);
    }))
}
