//! `rasterproof inspect`: one case, every engine, pixel by pixel.
//!
//! Each engine that draws the case is shown as characters and on a picture, and compared with the oracle in pixels and in values. A
//! pixel can be explained: by the edge functions at its centre, the rule where one of them is 0, and the span of its row.

use rasterproof_host::output::{self, Output};
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::inspect_case::{
    CaseArguments, InspectedCase, box_of, face_of_file, find, parse_pixel, recorded, words,
};
use super::page::{PageArguments, Shown, as_file, print, show};
use super::study::FaceOfModel;
use super::typed::Typed;
use super::view::{GRID_OPTIONS, GridArguments, ViewArguments};
use super::{
    InputError, Status, Streams, ends_in, exit, pair, program, study, usage, write_picture,
};
use rasterproof_core::contract::Decisions;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
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
use rasterproof_verify::comparison::{Tally, oracle_pixels_each};
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

/// The parser of --window.
fn parse_window(text: &str) -> Result<PixelRect, String> {
    let sides = format!("sides from 1 to {MOST_SIDE_PX}, for example 64x48");
    window(text).ok_or(format!("expected WIDTHxHEIGHT or X,Y,WIDTHxHEIGHT with {sides}"))
}

/// The window of these words, which begins at the first pixel where they name a size alone.
fn window(text: &str) -> Option<PixelRect> {
    let (origin, size) = text.trim().rsplit_once(',').unwrap_or(("0,0", text));
    let (width, height) = pair(size, &['x'])?;
    let (x0, y0) = pair::<i32, i32>(origin, &[','])?;
    let sides = 1..=MOST_SIDE_PX as i32;
    if !sides.contains(&width) || !sides.contains(&height) {
        return None;
    }
    Some(PixelRect { x0, y0, x1: x0.checked_add(width)?, y1: y0.checked_add(height)? })
}

/// Whether the case has other corners than those typed, by the grid.
fn is_snapped(case: &Case, typed: &[FreeCorners]) -> bool {
    let Shape::Triangles { list, .. } = &case.shape else { return false };
    list.iter().map(|triangle| FreeCorners::from(triangle.corners())).ne(typed.iter().copied())
}

/// Draws and compares one case, in its window or another one.
pub fn run(arguments: &InspectArguments, command: &Typed, streams: &mut Streams<'_>) -> Status {
    if let Some(path) = &arguments.output {
        ends_in(path, "png", "the picture")?;
    }
    let asked = arguments.output.as_deref().map(Output::typed);
    let page = arguments.page.page("inspect.html");
    let output = asked.as_ref().map(|output| output.named("--output"));
    let named: Vec<_> = output.into_iter().chain(as_file(&page)).collect();
    output::check_all(named.iter().copied())?;
    let FaceOfModel { mut about, case } = look_up(arguments, command, streams)?;
    // A model names files of its own.
    output::check_all(named.iter().copied())?;
    let mut report = Report { command: command.line(), ..Report::default() };
    let found = match case {
        Some(InspectedCase::Case(found)) => found,
        Some(InspectedCase::Refused { title, corners }) => {
            return refused(title, &corners, streams);
        }
        None => {
            report.about = about.join("\n");
            let why = "The face lies outside of the window, or is culled.";
            report.outcome = Some(Outcome::not_compared(why));
            return print(report, exit::USAGE, streams);
        }
    };
    let (title, mut case) = (found.title, found.case);
    case.window = arguments.window.unwrap_or(case.window);
    let w = case.window;
    if let Some(PixelPoint { x, y }) = arguments.pixel.filter(|at| !w.contains(at.x, at.y)) {
        return Err(usage(format!(
            "pixel {x},{y} lies outside the window: add --window X,Y,WIDTHxHEIGHT"
        )));
    }
    about.push(title.clone());
    about.push(format!("window: columns {}..{}, rows {}..{}", w.x0, w.x1, w.y0, w.y1));
    about.extend(cropped(&case, arguments));
    about.extend(case_view::facts(&case));
    report.about = about.join("\n");
    // What everybody draws, with a published algorithm and a device beside them where these were named.
    let judged = case_view::judged(arguments.plant.as_deref());
    let mut shown = case_view::draw(&case, &judged);
    // A planted fault may be in nothing that draws such a case, and then nobody is left to be judged.
    if shown.is_empty() {
        let (name, program) = (arguments.plant.as_deref().unwrap_or_default(), program());
        return Err(usage(format!(
            "{name} is in no engine that draws this case. See: {program} list"
        )));
    }
    let specimen = add_specimen(arguments, &case, &mut shown)?;
    #[cfg(feature = "vulkan")]
    let on_device = device(arguments, &case, &mut shown)?;
    let mut compared = InspectionFindings::new(has_answer(&case, arguments), streams.columns);
    compared.add("", specimen, &shown, (&case, &judged));
    compared.excerpts.extend(explained(arguments, &case, Some(&shown)));
    #[cfg(feature = "vulkan")]
    compared.rows.extend(on_device);
    // Pixels are stated for the window of a named case alone.
    if arguments.window.is_none() {
        compared.rows.extend(against_stated(&case, &found.expected.unwrap_or_default()));
    }
    // Corners that were typed in are shown as they were typed, too.
    if !found.typed.is_empty() && !judged.unsnapped.is_empty() {
        let is_snapped = is_snapped(&case, &found.typed);
        let typed = Case::unsnapped(case.window, found.typed);
        let mut shown = case_view::draw(&typed, &judged);
        let specimen = add_specimen(arguments, &typed, &mut shown)?;
        compared.add("not snapped:", specimen, &shown, (&typed, &judged));
        if is_snapped {
            compared.excerpts.extend(explained(arguments, &typed, None));
        }
    }
    let InspectionFindings { excerpts, rows, is_compared, .. } = compared;
    let agrees = rows.iter().all(|row| row.mark != Mark::Wrong);
    report.excerpts = excerpts;
    report.tables = vec![Table::new("", "~found 1", rows).judged()];
    let not = if agrees { "" } else { "not " };
    report.outcome = Some(match is_compared {
        true => Outcome::of(agrees, format!("{not}every engine draws what the oracle draws")),
        false => Outcome::not_compared("No pixel of this window is drawn; name another --window."),
    });
    // The picture has the case on the lattice, which is what most engines draw.
    let unasked = arguments.page.place.output("inspect.png");
    let picture = picture::png(&shown.picture(&title, &case));
    report.notes.extend(write_picture(asked.as_ref(), &unasked, &picture, streams)?);
    // The pixels of a page are computed for it alone.
    if page.is_some() {
        let kind = if agrees { page_cases::Kind::Named } else { page_cases::Kind::Failing };
        let mut view = page_cases::of_case(name(arguments), title, kind, &case, &judged);
        view.command = command.clone().without(&["report"]).line();
        report.title = format!("One case: {}", view.name);
        report.cases = vec![view];
    }
    // Something that was found wrong stays wrong, also where no pixel is drawn.
    let status = if is_compared || !agrees { exit::of(agrees) } else { exit::USAGE };
    show(report, Shown::All, page, status, streams)
}

/// What the words of the command line name: a face of a model, or a case.
fn look_up(
    arguments: &InspectArguments,
    command: &Typed,
    streams: &mut Streams<'_>,
) -> Result<FaceOfModel, InputError> {
    if let Some(face) = face_of_file(&arguments.case.what) {
        let grid = arguments.grid.grid();
        let grid = if arguments.case.exact { CornerGrid::Unsnapped } else { grid };
        return study::face(face, &arguments.view, grid, command, streams);
    }
    // A case has neither an eye nor a grid of its own.
    study::refuse_view(command)?;
    if let Some(option) = command.given(&GRID_OPTIONS) {
        return Err(usage(format!(
            "--{option} is for faces of models: name FILE#NUMBER; corners that are typed are not snapped with --exact"
        )));
    }
    Ok(FaceOfModel { about: Vec::new(), case: Some(find(&arguments.case)?) })
}

/// Whether an empty window is an answer. A shape that is shown whole and has no pixel is compared by that, and so is a case
/// whose window is a part of it. Of a part of a shape without pixels nobody knows, and who names a face of a model wants to see
/// pixels of it.
fn has_answer(case: &Case, arguments: &InspectArguments) -> bool {
    let has_own_window = arguments.window.is_none() && words(&arguments.case).len() == 1;
    let is_face = face_of_file(&arguments.case.what).is_some();
    !is_face && (has_own_window || is_whole(case))
}

/// What was shown and found so far.
struct InspectionFindings {
    /// Whether a window without pixels is an answer, too.
    has_answer: bool,
    columns: usize,
    excerpts: Vec<Excerpt>,
    rows: Vec<Row>,
    /// Whether something was compared at all.
    is_compared: bool,
}

impl InspectionFindings {
    fn new(has_answer: bool, columns: usize) -> Self {
        let (excerpts, rows) = (Vec::new(), Vec::new());
        Self { has_answer, columns, excerpts, rows, is_compared: false }
    }

    /// Shows what everybody draws, as characters, and compares it with what the oracle draws.
    fn add(
        &mut self,
        title: &str,
        note: Option<String>,
        shown: &case_view::CaseDrawing,
        (case, judged): (&Case, &EnginesToJudge),
    ) {
        let grid = ascii::side_by_side(&shown.blocks(), self.columns);
        let (title, notes) = (title.to_owned(), Vec::from_iter(note));
        self.excerpts.push(Excerpt { title, grid, notes, ..Excerpt::default() });
        if self.has_answer || !shown.is_blank() {
            self.is_compared = true;
            self.rows.extend(findings(case, judged));
        }
    }
}

/// How the oracle stands to the pixels that a name states, if it states some.
fn against_stated(case: &Case, stated: &[u64]) -> Option<Row> {
    if stated.is_empty() {
        return None;
    }
    let hits = oracle_pixels_each(case);
    let what = format!("expected pixels {stated:?}, the oracle has {hits:?}");
    Some(finding(hits == stated, what))
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

/// A row of the table of what was found.
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
    // Its pixels are compared with the oracle's, as those of an engine are.
    let tally = shown.add_drawn(engine, hits);
    let said = match tally.total() {
        0 => "agrees".to_owned(),
        _ => format!("{} missing, {} extra, {} twice", tally.missing, tally.extra, tally.twice),
    };
    Ok(Some(finding(tally.total() == 0, format!("{engine} against oracle: {said}"))))
}

/// How each engine stands to the oracle: in pixels, in values, and by how many exact decisions.
fn findings(case: &Case, judged: &EnginesToJudge) -> Vec<Row> {
    let mut rows = Vec::new();
    for ([actual, target], of) in judged.judge_case(case) {
        let mut what = format!("{actual} against {target}: {}", of.describe());
        if of.values > 0 {
            let (n, values) = (of.values, in_words::noun(of.values, "value", "values"));
            let bound = in_words::of_bound(of.attribute.max(of.depth));
            what += &format!("; {n} {values}, {bound}");
        }
        let Decisions { by_filter, by_fallback } = of.decisions;
        let all = by_filter + by_fallback;
        if all > 0 {
            what += &format!("; {by_fallback} of {all} decisions took exact arithmetic");
        }
        rows.push(finding(!of.is_wrong(), what));
    }
    rows
}

/// What a page calls the case: the words that name it, or how many shapes were typed.
fn name(arguments: &InspectArguments) -> String {
    let what = words(&arguments.case);
    let shapes = if arguments.case.line { "lines" } else { "triangles" };
    match what.len() / if arguments.case.line { 2 } else { 3 } {
        0 | 1 => what.join(" "),
        count => format!("{count} {shapes}"),
    }
}

/// What is not shown, if anything, and how to see it.
fn cropped(case: &Case, arguments: &InspectArguments) -> Vec<String> {
    let w = case.window;
    let mut out = Vec::new();
    // A window that somebody chose, or that a named case has, is as large as it should be.
    let is_face = face_of_file(&arguments.case.what).is_some();
    let is_around = arguments.window.is_none() && (is_face || words(&arguments.case).len() > 1);
    let (columns, rows) = (w.width(), w.height());
    if is_around && !is_whole(case) {
        let all = box_of(case);
        // The box has a pixel to spare on each side and ends behind its last pixel.
        let (width, height) =
            (all.x1.saturating_sub(all.x0) - 3, all.y1.saturating_sub(all.y0) - 3);
        out.push(format!(
            "cropped: the shape is {width} x {height} px, the window {columns} x {rows}; see more with --window"
        ));
    }
    // A picture of characters has a largest size; a window beyond it is shown in part.
    let (shown, high) = (columns.min(ascii::MOST_COLUMNS), rows.min(ascii::MOST_ROWS));
    if (shown, high) != (columns, rows) {
        out.push(format!(
            "cropped: the grids show {shown} x {high} pixels from the first that differs or is drawn"
        ));
    }
    out
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
    // Only algorithms that fill triangles take corners off the lattice.
    let (Shape::Unsnapped { list, .. }, Some(Specimen::Triangle(specimen))) =
        (&case.shape, entry.specimen)
    else {
        shown.add(entry, case)?;
        return Ok(None);
    };
    // A recorded input was recorded on the screen of the book's code, which clips what it draws.
    let mut screen = case.window;
    if recorded.is_some() {
        screen = PixelRect::window(RECORDED_SIDE_PX, RECORDED_SIDE_PX);
    }
    let triangles: Vec<_> = list.iter().map(|t| bare(t.px())).collect();
    let name = entry.name;
    let said = match specimen_coverage(specimen, &triangles, screen) {
        Ok(hits) => {
            let Tally { missing, extra, twice, .. } =
                shown.add_drawn(name, case_view::crop(&hits, case.window));
            format!("{missing} missing, {extra} extra, {twice} twice")
        }
        Err(reason) => reason,
    };
    Ok(Some(format!("{name}, published: {said}")))
}

/// Prints whether each triangle is refused, and why.
fn refused(title: String, corners: &[[[f64; 2]; 3]], streams: &mut Streams<'_>) -> Status {
    let mut rows = Vec::new();
    let mut is_right = true;
    for triangle in corners {
        // One corner that is refused is enough; all of them are shown.
        let mut why = Vec::new();
        for &[x, y] in triangle {
            if let Err(refusal) = SubpixelPoint::from_px(x, y) {
                why.push(format!("({x:?}, {y:?}) {refusal}"));
            }
        }
        is_right &= !why.is_empty();
        let said = if why.is_empty() { "NO".to_owned() } else { why.join("; ") };
        rows.push(finding(!why.is_empty(), format!("refused: {said}")));
    }
    let sentence = if is_right { "each is refused" } else { "not each is refused" };
    let tables = vec![Table::new("", "~refused 1", rows).judged()];
    let outcome = Some(Outcome::of(is_right, sentence));
    let report = Report { about: title, tables, outcome, ..Report::default() };
    print(report, exit::of(is_right), streams)
}
