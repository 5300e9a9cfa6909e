//! `rasterproof inspect`: one case, every engine, pixel by pixel.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use rasterproof_host::text::printable_path;

use super::case_view;
use super::files::{self, Output, written};
use super::inspect_case::{
    CaseArguments, Found, all_around, face_of_file, find, off_lattice, parse_pixel, recorded, words,
};
use super::page::{PageArguments, as_file, save_page};
use super::typed::Typed;
use super::view::ViewArguments;
use super::{
    Failure, Status, Streams, exit, explain, png_name, program, study, usage, write_picture,
};
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{FreeCorners, PixelPoint};
use rasterproof_faults::published::bare;
use rasterproof_faults::published::catalogue::{RECORDED_SIDE_PX, RecordedCase};
use rasterproof_registry::comparison::Judged;
use rasterproof_registry::engines::{Entry, SPECIMENS, Specimen};
use rasterproof_registry::published_check::specimen_coverage;
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::{ascii, page_cases, picture, words};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{Tally, oracle_pixels_each};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("inspect"))]
pub struct InspectArguments {
    #[command(flatten)]
    case: CaseArguments,
    /// The pixels to show, as WIDTHxHEIGHT or X,Y,WIDTHxHEIGHT [default: around the shape]
    #[arg(long, value_name = "WxH", value_parser = parse_window)]
    window: Option<PixelRect>,
    /// Show what this published algorithm draws as well; it is not judged
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(SPECIMENS.iter().map(|e| e.name)))]
    specimen: Option<String>,
    /// Show what this Vulkan device draws as well, and judge it: vulkan:0
    #[cfg(feature = "vulkan")]
    #[arg(long, value_name = "NAME")]
    engine: Option<String>,
    /// Judge this planted fault instead of the engines; `list` names them
    #[arg(long, value_name = "FAULT", value_parser = rasterproof_faults::planted::names(), hide_possible_values = true)]
    plant: Option<String>,
    /// Explain this pixel: edge values, ties, the rule, the span
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel_option, allow_hyphen_values = true)]
    pixel: Option<PixelPoint>,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    page: PageArguments,
    /// The picture [default: inspect.png in the folder of --out]
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
}

/// Largest side of a window to look at: every engine gets a panel of the picture.
const MOST_SIDE_PX: u32 = 2048;

fn parse_pixel_option(text: &str) -> Result<PixelPoint, String> {
    parse_pixel(text).map_err(|failure| failure.to_string())
}

fn parse_window(text: &str) -> Result<PixelRect, String> {
    let wrong = || {
        format!(
            "expected WIDTHxHEIGHT or X,Y,WIDTHxHEIGHT with sides from 1 to {MOST_SIDE_PX}, for example 64x48"
        )
    };
    let (origin, size) = text.trim().rsplit_once(',').map_or((None, text), |(o, s)| (Some(o), s));
    let (width, height) = size.split_once('x').ok_or_else(wrong)?;
    let side = |text: &str| text.parse::<u32>().ok().filter(|s| (1..=MOST_SIDE_PX).contains(s));
    let (width, height) = (side(width).ok_or_else(wrong)?, side(height).ok_or_else(wrong)?);
    let (x0, y0) = match origin {
        None => (0, 0),
        Some(origin) => {
            let (x, y) = origin.split_once(',').ok_or_else(wrong)?;
            (x.parse::<i32>().map_err(|_| wrong())?, y.parse::<i32>().map_err(|_| wrong())?)
        }
    };
    let end = |start: i32, side: u32| start.checked_add(side as i32).ok_or_else(wrong);
    Ok(PixelRect { x0, y0, x1: end(x0, width)?, y1: end(y0, height)? })
}

/// Whether the case has other corners than those typed, by the grid.
fn is_snapped(case: &Case, typed: &[FreeCorners]) -> bool {
    let Shape::Triangles { list, .. } = &case.shape else { return false };
    list.iter().map(|triangle| FreeCorners::from(triangle.corners())).ne(typed.iter().copied())
}

/// A pixel that is to be explained lies in what is drawn.
fn in_window(window: PixelRect, at: PixelPoint) -> Result<(), Failure> {
    if window.contains(at.x, at.y) {
        return Ok(());
    }
    Err(usage(format!(
        "pixel {},{} lies outside the window: add --window X,Y,WIDTHxHEIGHT",
        at.x, at.y
    )))
}

/// A planted fault that has no part in a case cannot be shown by it.
fn no_part(plant: Option<&String>) -> Failure {
    let name = plant.map_or("", String::as_str);
    usage(format!("{name} is in no engine that draws this case. See: {} list", program()))
}

pub fn run(arguments: &InspectArguments, command: &Typed, streams: &mut Streams<'_>) -> Status {
    if let Some(path) = &arguments.output {
        png_name(path)?;
    }
    let asked = arguments.output.as_deref().map(Output::typed);
    let page = arguments.page.page("inspect.html");
    let output = asked.as_ref().map(|output| written("--output", output));
    let named: Vec<_> = output.into_iter().chain(as_file(&page)).collect();
    files::check(&named)?;
    let face = face_of_file(&arguments.case.what);
    let is_face = face.is_some();
    let found = match face {
        Some(face) => {
            let exact = arguments.case.exact;
            let found = study::face(face, &arguments.view, (command, exact), streams)?;
            files::check(&named)?;
            match found {
                Some(found) if exact => off_lattice(found)?,
                Some(found) => found,
                None => return Ok(exit::USAGE),
            }
        }
        None => {
            study::refuse_view(command)?;
            find(&arguments.case)?
        }
    };
    let (title, mut case, expected, typed) = match found {
        Found::Case { title, case, expected, typed } => (title, case, expected, typed),
        Found::Refused { title, corners } => return refused(&title, &corners, streams.output),
    };
    let out = &mut *streams.output;
    if let Some(window) = arguments.window {
        case.window = window;
    }
    let w = case.window;
    if let Some(at) = arguments.pixel {
        in_window(w, at)?;
    }
    writeln!(out, "{title}")?;
    writeln!(out, "window: columns {}..{}, rows {}..{}", w.x0, w.x1, w.y0, w.y1)?;
    write!(out, "{}", cropped(&case, arguments, is_face))?;
    case_view::facts(&case, out)?;
    if let Some(at) = arguments.pixel {
        write!(out, "\n{}", explain::pixel(&case, at))?;
    }

    // Judge and show.
    let judged = case_view::judged(arguments.plant.as_deref());
    let mut shown = case_view::draw(&case, &judged);
    if shown.is_empty() {
        return Err(no_part(arguments.plant.as_ref()));
    }
    writeln!(out)?;
    add_specimen(arguments, &case, &mut shown, out)?;
    #[cfg(feature = "vulkan")]
    let on_device = device(arguments, &case, &mut shown)?;
    if let Some(at) = arguments.pixel {
        writeln!(out, "hits of ({}, {}): {}\n", at.x, at.y, shown.hits(at))?;
    }
    // A shape that is shown whole and has no pixel is compared by that, and so is a case whose window is a part of it. Of a
    // part of a shape without pixels nobody knows, and who names a face of a model wants to see pixels of it.
    let has_own_window = arguments.window.is_none() && words(&arguments.case).len() == 1;
    let has_answer = !is_face && (has_own_window || is_whole(&case));
    let mut is_compared = has_answer || !shown.is_blank();
    let mut agrees = say(&case, &judged, &shown, is_compared, (out, streams.columns))?;
    #[cfg(feature = "vulkan")]
    if let Some((said, is_right)) = on_device {
        writeln!(out, "{said}")?;
        agrees &= is_right;
    }
    if let Some(expected) = expected.filter(|_| arguments.window.is_none()) {
        let hits = oracle_pixels_each(&case);
        let as_expected = expected.is_empty() || hits == expected;
        agrees &= as_expected;
        if !expected.is_empty() {
            writeln!(
                out,
                "expected pixels {expected:?}, the oracle has {hits:?}{}",
                if as_expected { "" } else { ": DIFFERS" }
            )?;
        }
    }
    // Corners that were typed in are shown as they were typed, too.
    if !typed.is_empty() && !judged.unsnapped.is_empty() {
        writeln!(out, "\nnot snapped:")?;
        let is_snapped = is_snapped(&case, &typed);
        let typed = Case::unsnapped(case.window, typed);
        if let Some(at) = arguments.pixel.filter(|_| is_snapped) {
            writeln!(out, "{}", explain::pixel(&typed, at))?;
        }
        let mut shown = case_view::draw(&typed, &judged);
        add_specimen(arguments, &typed, &mut shown, out)?;
        let is_seen = has_answer || !shown.is_blank();
        is_compared |= is_seen;
        agrees &= say(&typed, &judged, &shown, is_seen, (out, streams.columns))?;
    }
    if !is_compared {
        writeln!(out, "{NOT_COMPARED}; choose other pixels with --window")?;
    }
    let unasked = arguments.page.place.output("inspect.png");
    let drawn = picture::png(&shown.picture(&title, &case));
    if let Some(place) = write_picture(asked.as_ref(), &unasked, &drawn, streams)? {
        writeln!(streams.output, "{place}")?;
    }
    if let Some(page) = &page {
        let view = page_cases::of_case(name(arguments), title, kind(agrees), &case, &judged);
        write_report((command, page), view, is_compared.then_some(agrees), streams)?;
    }
    Ok(match (is_compared, agrees) {
        (false, true) => exit::USAGE,
        (_, true) => exit::AGREES,
        (_, false) => exit::DISAGREES,
    })
}

/// Draws the case on the Vulkan device that is named: how it stands to the oracle.
#[cfg(feature = "vulkan")]
fn device(
    arguments: &InspectArguments,
    case: &Case,
    shown: &mut case_view::Shown,
) -> Result<Option<(String, bool)>, Failure> {
    let Some(engine) = &arguments.engine else { return Ok(None) };
    let Shape::Triangles { list, .. } = &case.shape else {
        return Err(usage("a Vulkan device is shown on triangles: leave out --engine"));
    };
    let corners: Vec<_> = list.iter().map(|t| t.corners()).collect();
    let hits = super::vulkan::coverage(engine, &corners, case.window)?;
    let tally = shown.add_drawn(engine, hits);
    let said = match tally.total() {
        0 => "agrees".to_owned(),
        _ => format!("{} missing, {} extra, {} twice", tally.missing, tally.extra, tally.twice),
    };
    Ok(Some((format!("{engine} against oracle: {said}"), tally.total() == 0)))
}

/// What is said of a window in which nothing is drawn.
const NOT_COMPARED: &str =
    "NOT COMPARED: no pixel of this window is drawn, so nothing was compared";

/// The pixels of each engine, then a line for each pair that is compared; says whether all agree.
fn say(
    case: &Case,
    judged: &Judged,
    shown: &case_view::Shown,
    is_compared: bool,
    (out, columns): (&mut dyn std::io::Write, usize),
) -> Result<bool, Failure> {
    writeln!(out, "{}", ascii::side_by_side(&shown.blocks(), columns))?;
    let mut agrees = true;
    let findings = if is_compared { judged.judge_case(case) } else { Vec::new() };
    for ([actual, target], finding) in findings {
        agrees &= !finding.is_wrong();
        let values = match finding.values {
            0 => String::new(),
            n => {
                let worst = finding.attribute.max(finding.depth);
                format!("; {n} values, {}", words::of_bound(worst))
            }
        };
        let Decisions { by_filter, by_fallback } = finding.decisions;
        let decisions = match by_filter + by_fallback {
            0 => String::new(),
            all => format!("; {by_fallback} of {all} decisions took exact arithmetic"),
        };
        writeln!(out, "{actual} against {target}: {}{values}{decisions}", finding.describe())?;
    }
    Ok(agrees)
}

fn name(arguments: &InspectArguments) -> String {
    let what = words(&arguments.case);
    let shapes = if arguments.case.line { "lines" } else { "triangles" };
    match what.len() / if arguments.case.line { 2 } else { 3 } {
        0 | 1 => what.join(" "),
        count => format!("{count} {shapes}"),
    }
}

fn kind(agrees: bool) -> page_cases::Kind {
    if agrees { page_cases::Kind::Named } else { page_cases::Kind::Failing }
}

fn write_report(
    (command, page): (&Typed, &Output),
    mut view: page_cases::CaseView,
    agrees: Option<bool>,
    streams: &mut Streams<'_>,
) -> Result<(), Failure> {
    view.command = command.clone().without(&["report"]).line();
    let outcome = match agrees {
        Some(true) => Outcome::of(true, "Every engine draws what the oracle draws."),
        Some(false) => Outcome::of(false, "Not every engine draws what the oracle draws."),
        None => Outcome::not_compared("No pixel of this window is drawn."),
    };
    let report = Report {
        title: format!("One case: {}", view.name),
        outcome: Some(outcome),
        command: command.line(),
        cases: vec![view],
        ..Report::default()
    };
    if save_page(page, report, streams) {
        writeln!(streams.output, "report: {}", printable_path(&page.path))?;
    }
    Ok(())
}

/// What is not shown, if anything, and how to see it.
fn cropped(case: &Case, arguments: &InspectArguments, is_face: bool) -> String {
    let w = case.window;
    let mut out = String::new();
    if arguments.window.is_none() && (is_face || words(&arguments.case).len() > 1) {
        let all = box_of(case);
        let (width, height) =
            (all.x1.saturating_sub(all.x0) - 3, all.y1.saturating_sub(all.y0) - 3);
        if !is_whole(case) {
            out += &format!(
                "cropped: the shape is {width} x {height} px, the window {} x {}; see more with --window\n",
                w.width(),
                w.height()
            );
        }
    }
    if w.width() > ascii::MOST_COLUMNS || w.height() > ascii::MOST_ROWS {
        out += &format!(
            "cropped: the grids show {} x {} pixels from the first that differs or is drawn\n",
            w.width().min(ascii::MOST_COLUMNS),
            w.height().min(ascii::MOST_ROWS)
        );
    }
    out
}

/// The pixels around a shape, with one to spare.
fn box_of(case: &Case) -> PixelRect {
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let corners = list.iter().flat_map(|t| t.corners());
            all_around(corners.map(|p| [p.x, p.y].map(|sub| sub.div_euclid(SUBPIXELS))))
        }
        Shape::Lines(list) => {
            let ends = list.iter().flat_map(|l| l.ends.map(|end| end.pixel));
            all_around(ends.map(|p| [p.x, p.y]))
        }
        Shape::Unsnapped { list, .. } => {
            let corners = list.iter().flat_map(|t| t.px());
            all_around(corners.map(|p| p.map(|px| px.floor() as i32)))
        }
    }
}

/// Whether every pixel that a shape may draw is in its window.
fn is_whole(case: &Case) -> bool {
    let (all, w) = (box_of(case), case.window);
    // One pixel on each side is to spare.
    w.x0 <= all.x0 + 1 && w.y0 <= all.y0 + 1 && w.x1 >= all.x1 - 1 && w.y1 >= all.y1 - 1
}

/// The specimen to show: the one asked for, or the one of a recorded input.
fn specimen(
    arguments: &InspectArguments,
    recorded: Option<&RecordedCase>,
) -> Option<&'static Entry> {
    let name = arguments.specimen.as_deref().or(recorded.map(|case| case.specimen))?;
    SPECIMENS.iter().find(|entry| entry.name == name)
}

/// Shows the specimen that was asked for beside the engines. One of corners that are not snapped draws on a screen of its own.
fn add_specimen(
    arguments: &InspectArguments,
    case: &Case,
    shown: &mut case_view::Shown,
    out: &mut dyn std::io::Write,
) -> Result<(), Failure> {
    let recorded = recorded(&arguments.case.what);
    let Some(entry) = specimen(arguments, recorded) else { return Ok(()) };
    let (Shape::Unsnapped { list, .. }, Some(Specimen::Triangle(specimen))) =
        (&case.shape, entry.specimen)
    else {
        return shown.add(entry, case);
    };
    let screen = recorded.map(|_| PixelRect::window(RECORDED_SIDE_PX, RECORDED_SIDE_PX));
    let triangles: Vec<_> = list.iter().map(|t| bare(t.px())).collect();
    let name = entry.name;
    match specimen_coverage(specimen, &triangles, screen.unwrap_or(case.window)) {
        Ok(hits) => {
            let Tally { missing, extra, twice, .. } =
                shown.add_drawn(name, case_view::crop(&hits, case.window));
            writeln!(out, "{name}, published: {missing} missing, {extra} extra, {twice} twice\n")?;
        }
        Err(reason) => writeln!(out, "{name}, published: {reason}\n")?,
    }
    Ok(())
}

fn refused(title: &str, corners: &[[[f64; 2]; 3]], out: &mut dyn std::io::Write) -> Status {
    writeln!(out, "{title}")?;
    let mut all = true;
    for triangle in corners {
        let refusals: Vec<String> = triangle
            .iter()
            .filter_map(|&[x, y]| {
                Some(format!("({x:?}, {y:?}) {}", SubpixelPoint::from_px(x, y).err()?))
            })
            .collect();
        all &= !refusals.is_empty();
        writeln!(
            out,
            "refused: {}",
            if refusals.is_empty() { "NO".to_owned() } else { refusals.join("; ") }
        )?;
    }
    Ok(if all { exit::AGREES } else { exit::DISAGREES })
}
