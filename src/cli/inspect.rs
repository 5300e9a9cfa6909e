//! `rasterproof inspect`: one case, every engine, pixel by pixel.

use rasterproof_host::output::{self, Output};
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::inspect_case::{
    CaseArguments, InspectedCase, all_around, face_of_file, find, off_lattice, parse_pixel,
    recorded, words,
};
use super::page::{PageArguments, Shown, as_file, print, show};
use super::typed::Typed;
use super::view::{GRID_OPTIONS, GridArguments, ViewArguments};
use super::{InputError, Status, Streams, ends_in, exit, program, study, usage, write_picture};
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{FreeCorners, PixelPoint};
use rasterproof_faults::published::bare;
use rasterproof_faults::published::catalogue::RECORDED_SIDE_PX;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::{SPECIMENS, Specimen};
use rasterproof_registry::published_check::specimen_coverage;
use rasterproof_report::html::{Excerpt, Outcome, Report};
use rasterproof_report::table::{Mark, Row, Table};
use rasterproof_report::{page_cases, picture, words as in_words};
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_teaching::{case_view, explain};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{Finding, Tally, oracle_pixels_each};
use rasterproof_verify::judge::ascii;

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
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel, allow_hyphen_values = true)]
    pixel: Option<PixelPoint>,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    grid: GridArguments,
    #[command(flatten)]
    page: PageArguments,
    /// The picture [default: inspect.png in the folder of --out]
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
}

/// Largest side of a window to look at: every engine gets a panel of the picture.
const MOST_SIDE_PX: u32 = 2048;

fn parse_window(text: &str) -> Result<PixelRect, String> {
    let wrong = || {
        format!(
            "expected WIDTHxHEIGHT or X,Y,WIDTHxHEIGHT with sides from 1 to {MOST_SIDE_PX}, for example 64x48"
        )
    };
    let (origin, size) = text.trim().rsplit_once(',').map_or((None, text), |(o, s)| (Some(o), s));
    let (width, height) = size.split_once('x').ok_or_else(wrong)?;
    let (x0, y0) = origin.unwrap_or("0,0").split_once(',').ok_or_else(wrong)?;
    let range = |start: &str, side: &str| {
        let side = side.parse().ok().filter(|side| (1..=MOST_SIDE_PX as i32).contains(side))?;
        let start = start.parse::<i32>().ok()?;
        Some((start, start.checked_add(side)?))
    };
    let (x0, x1) = range(x0, width).ok_or_else(wrong)?;
    let (y0, y1) = range(y0, height).ok_or_else(wrong)?;
    Ok(PixelRect { x0, y0, x1, y1 })
}

/// Whether the case has other corners than those typed, by the grid.
fn is_snapped(case: &Case, typed: &[FreeCorners]) -> bool {
    let Shape::Triangles { list, .. } = &case.shape else { return false };
    list.iter().map(|triangle| FreeCorners::from(triangle.corners())).ne(typed.iter().copied())
}

pub fn run(arguments: &InspectArguments, command: &Typed, streams: &mut Streams<'_>) -> Status {
    if let Some(path) = &arguments.output {
        ends_in(path, "png", "the picture")?;
    }
    let asked = arguments.output.as_deref().map(Output::typed);
    let page = arguments.page.page("inspect.html");
    let output = asked.as_ref().map(|output| output.named("--output"));
    let named: Vec<_> = output.into_iter().chain(as_file(&page)).collect();
    output::check_all(named.iter().copied())?;
    let face = face_of_file(&arguments.case.what);
    let is_face = face.is_some();
    let mut about = Vec::new();
    let mut report = Report { command: command.line(), ..Report::default() };
    let found = match face {
        Some(face) => {
            // Those who do not snap draw corners that are put on another grid, or on none.
            let grid = arguments.grid.grid();
            let exact = arguments.case.exact || grid != CornerGrid::USUAL;
            let grid = if arguments.case.exact { CornerGrid::Unsnapped } else { grid };
            let (said, found) =
                study::face(face, (&arguments.view, grid), (command, exact), streams)?;
            output::check_all(named.iter().copied())?;
            about.extend(said);
            match found {
                Some(found) if exact => off_lattice(found)?,
                Some(found) => found,
                None => {
                    report.about = about.join("\n");
                    let why = "The face lies outside of the window, or is culled.";
                    report.outcome = Some(Outcome::not_compared(why));
                    return print(report, exit::USAGE, streams);
                }
            }
        }
        None => {
            study::refuse_view(command)?;
            if let Some(option) = command.given(&GRID_OPTIONS) {
                return Err(usage(format!(
                    "--{option} is for faces of models: name FILE#NUMBER; corners that are typed are not snapped with --exact"
                )));
            }
            find(&arguments.case)?
        }
    };
    let (title, mut case, expected, typed) = match found {
        InspectedCase::Case { title, case, expected, typed } => (title, case, expected, typed),
        InspectedCase::Refused { title, corners } => {
            let (is_right, report) = refused(title, &corners);
            return print(report, exit::of(is_right), streams);
        }
    };
    if let Some(window) = arguments.window {
        case.window = window;
    }
    let w = case.window;
    if let Some(PixelPoint { x, y }) = arguments.pixel.filter(|at| !w.contains(at.x, at.y)) {
        return Err(usage(format!(
            "pixel {x},{y} lies outside the window: add --window X,Y,WIDTHxHEIGHT"
        )));
    }
    about.push(title.clone());
    about.push(format!("window: columns {}..{}, rows {}..{}", w.x0, w.x1, w.y0, w.y1));
    about.extend(cropped(&case, arguments, is_face));
    about.extend(case_view::facts(&case));
    report.about = about.join("\n");
    let judged = case_view::judged(arguments.plant.as_deref());
    let mut shown = case_view::draw(&case, &judged);
    if shown.is_empty() {
        let (name, program) = (arguments.plant.as_deref().unwrap_or_default(), program());
        return Err(usage(format!(
            "{name} is in no engine that draws this case. See: {program} list"
        )));
    }
    let specimen = add_specimen(arguments, &case, &mut shown)?;
    #[cfg(feature = "vulkan")]
    let on_device = device(arguments, &case, &mut shown)?;
    // A shape that is shown whole and has no pixel is compared by that, and so is a case whose window is a part of it. Of a
    // part of a shape without pixels nobody knows, and who names a face of a model wants to see pixels of it.
    let has_own_window = arguments.window.is_none() && words(&arguments.case).len() == 1;
    let has_answer = !is_face && (has_own_window || is_whole(&case));
    let mut is_compared = has_answer || !shown.is_blank();
    report.excerpts.push(drawn("", specimen, &shown, streams.columns));
    report.excerpts.extend(explained(arguments, &case, Some(&shown)));
    let mut rows = if is_compared { findings(&case, &judged) } else { Vec::new() };
    #[cfg(feature = "vulkan")]
    rows.extend(on_device);
    if let Some(expected) = expected.filter(|_| arguments.window.is_none()) {
        let hits = oracle_pixels_each(&case);
        let as_expected = expected.is_empty() || hits == expected;
        if !expected.is_empty() {
            let what = format!("expected pixels {expected:?}, the oracle has {hits:?}");
            rows.push(finding(as_expected, what));
        }
    }
    // Corners that were typed in are shown as they were typed, too.
    if !typed.is_empty() && !judged.unsnapped.is_empty() {
        let is_snapped = is_snapped(&case, &typed);
        let typed = Case::unsnapped(case.window, typed);
        let mut shown = case_view::draw(&typed, &judged);
        let specimen = add_specimen(arguments, &typed, &mut shown)?;
        report.excerpts.push(drawn("not snapped:", specimen, &shown, streams.columns));
        if is_snapped {
            report.excerpts.extend(explained(arguments, &typed, None));
        }
        if has_answer || !shown.is_blank() {
            is_compared = true;
            rows.extend(findings(&typed, &judged));
        }
    }
    let agrees = rows.iter().all(|row| row.mark != Mark::Wrong);
    report.tables = vec![Table::new("", "~found 1", rows).judged()];
    let not = if agrees { "" } else { "not " };
    report.outcome = Some(match is_compared {
        true => Outcome::of(agrees, format!("{not}every engine draws what the oracle draws")),
        false => Outcome::not_compared("No pixel of this window is drawn; name another --window."),
    });
    let unasked = arguments.page.place.output("inspect.png");
    let picture = picture::png(&shown.picture(&title, &case));
    report.notes.extend(write_picture(asked.as_ref(), &unasked, &picture, streams)?);
    if page.is_some() {
        let kind = if agrees { page_cases::Kind::Named } else { page_cases::Kind::Failing };
        let mut view = page_cases::of_case(name(arguments), title, kind, &case, &judged);
        view.command = command.clone().without(&["report"]).line();
        report.title = format!("One case: {}", view.name);
        report.cases = vec![view];
    }
    let status = if is_compared || !agrees { exit::of(agrees) } else { exit::USAGE };
    show(report, Shown::All, page, status, streams)
}

/// What is said of the pixel that is asked for, with its hits.
fn explained(
    arguments: &InspectArguments,
    case: &Case,
    shown: Option<&case_view::CaseDrawing>,
) -> Option<Excerpt> {
    let at = arguments.pixel?;
    let hits = shown.map(|shown| format!("hits of ({}, {}): {}", at.x, at.y, shown.hits(at)));
    let (grid, notes) = (explain::pixel(case, at), Vec::from_iter(hits));
    Some(Excerpt { grid, notes, ..Excerpt::default() })
}

/// What everybody draws, as characters.
fn drawn(
    title: &str,
    notes: Option<String>,
    shown: &case_view::CaseDrawing,
    columns: usize,
) -> Excerpt {
    let grid = ascii::side_by_side(&shown.blocks(), columns);
    let (title, notes) = (title.to_owned(), Vec::from_iter(notes));
    Excerpt { title, grid, notes, ..Excerpt::default() }
}

fn finding(is_right: bool, what: String) -> Row {
    Row::of(&[&what]).marked(is_right)
}

/// Draws the case on the Vulkan device that is named: how it stands to the oracle.
#[cfg(feature = "vulkan")]
fn device(
    arguments: &InspectArguments,
    case: &Case,
    shown: &mut case_view::CaseDrawing,
) -> Result<Option<Row>, InputError> {
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
    Ok(Some(finding(tally.total() == 0, format!("{engine} against oracle: {said}"))))
}

fn findings(case: &Case, judged: &EnginesToJudge) -> Vec<Row> {
    let row = |([actual, target], of): ([String; 2], Finding)| {
        let values = match of.values {
            0 => String::new(),
            n => format!("; {n} values, {}", in_words::of_bound(of.attribute.max(of.depth))),
        };
        let Decisions { by_filter, by_fallback } = of.decisions;
        let decisions = match by_filter + by_fallback {
            0 => String::new(),
            all => format!("; {by_fallback} of {all} decisions took exact arithmetic"),
        };
        let what = format!("{actual} against {target}: {}{values}{decisions}", of.describe());
        finding(!of.is_wrong(), what)
    };
    judged.judge_case(case).into_iter().map(row).collect()
}

fn name(arguments: &InspectArguments) -> String {
    let what = words(&arguments.case);
    let shapes = if arguments.case.line { "lines" } else { "triangles" };
    match what.len() / if arguments.case.line { 2 } else { 3 } {
        0 | 1 => what.join(" "),
        count => format!("{count} {shapes}"),
    }
}

/// What is not shown, if anything, and how to see it.
fn cropped(case: &Case, arguments: &InspectArguments, is_face: bool) -> Vec<String> {
    let w = case.window;
    let mut out = Vec::new();
    let is_around = arguments.window.is_none() && (is_face || words(&arguments.case).len() > 1);
    let (columns, rows) = (w.width(), w.height());
    if is_around && !is_whole(case) {
        let all = box_of(case);
        let [width, height] =
            [(all.x0, all.x1), (all.y0, all.y1)].map(|(from, to)| to.saturating_sub(from) - 3);
        out.push(format!(
            "cropped: the shape is {width} x {height} px, the window {columns} x {rows}; see more with --window"
        ));
    }
    let (shown, high) = (columns.min(ascii::MOST_COLUMNS), rows.min(ascii::MOST_ROWS));
    if (shown, high) != (columns, rows) {
        out.push(format!(
            "cropped: the grids show {shown} x {high} pixels from the first that differs or is drawn"
        ));
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
        Shape::Numbers { .. } => case.window,
    }
}

/// Whether every pixel that a shape may draw is in its window.
fn is_whole(case: &Case) -> bool {
    let (all, w) = (box_of(case), case.window);
    // One pixel on each side is to spare.
    w.x0 <= all.x0 + 1 && w.y0 <= all.y0 + 1 && w.x1 >= all.x1 - 1 && w.y1 >= all.y1 - 1
}

/// Shows the specimen that was asked for, or that of a recorded input, beside the engines, and says how one of corners that are not
/// snapped differs, which draws on a screen of its own.
fn add_specimen(
    arguments: &InspectArguments,
    case: &Case,
    shown: &mut case_view::CaseDrawing,
) -> Result<Option<String>, InputError> {
    let recorded = recorded(&arguments.case.what);
    let wanted = arguments.specimen.as_deref().or(recorded.map(|case| case.specimen));
    let entry = SPECIMENS.iter().find(|entry| Some(entry.name) == wanted);
    let Some(entry) = entry else { return Ok(None) };
    let (Shape::Unsnapped { list, .. }, Some(Specimen::Triangle(specimen))) =
        (&case.shape, entry.specimen)
    else {
        shown.add(entry, case)?;
        return Ok(None);
    };
    let screen = recorded.map(|_| PixelRect::window(RECORDED_SIDE_PX, RECORDED_SIDE_PX));
    let triangles: Vec<_> = list.iter().map(|t| bare(t.px())).collect();
    let name = entry.name;
    let said = match specimen_coverage(specimen, &triangles, screen.unwrap_or(case.window)) {
        Ok(hits) => {
            let Tally { missing, extra, twice, .. } =
                shown.add_drawn(name, case_view::crop(&hits, case.window));
            format!("{missing} missing, {extra} extra, {twice} twice")
        }
        Err(reason) => reason,
    };
    Ok(Some(format!("{name}, published: {said}")))
}

/// Whether each triangle is refused, and why.
fn refused(title: String, corners: &[[[f64; 2]; 3]]) -> (bool, Report) {
    let row = |triangle: &[[f64; 2]; 3]| {
        let why = triangle.iter().filter_map(|&[x, y]| {
            Some(format!("({x:?}, {y:?}) {}", SubpixelPoint::from_px(x, y).err()?))
        });
        let why: Vec<_> = why.collect();
        let said = if why.is_empty() { "NO".to_owned() } else { why.join("; ") };
        finding(!why.is_empty(), format!("refused: {said}"))
    };
    let rows: Vec<Row> = corners.iter().map(row).collect();
    let is_right = rows.iter().all(|row| row.mark != Mark::Wrong);
    let sentence = if is_right { "each is refused" } else { "not each is refused" };
    let tables = vec![Table::new("", "~refused 1", rows).judged()];
    let outcome = Some(Outcome::of(is_right, sentence));
    (is_right, Report { about: title, tables, outcome, ..Report::default() })
}
