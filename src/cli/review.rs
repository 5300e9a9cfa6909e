//! `rasterproof review`: snapshots that changed, old beside new, and how to accept them.
//!
//! insta leaves a changed snapshot `X.snap` as `X.snap.new` beside it, and the bytes of a changed
//! picture as `X.snap.new.png`. With `INSTA_UPDATE=always` it updates `X.snap` and leaves an older
//! `X.snap.new` until the next run; such a left-over does not wait for anything. This only looks: accepting is insta's business. What is no text and
//! no PNG, or is broken or too large to show, is listed without being shown.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::{ImageFormat, ImageReader, RgbImage};
use rasterproof_host::text::printable_path;
use rasterproof_host::{input, limits};

use super::files::{Use, distinct};
use super::page::{Place, save_page};
use super::{Failure, Streams, exit, program, usage};
use crate::report::html::{
    Column, Outcome, PictureLayer, PictureView, Report, Row, Table, TextDiff,
};
use crate::report::panels::{self, Sheet};

/// Options of `review`.
#[derive(clap::Args, Debug)]
#[command(after_help = "Exit status: 0 nothing is pending, 1 something is, 2 usage or bad input.")]
pub struct ReviewArguments {
    /// Where to look [default: snapshots and tests, where they exist]
    #[arg(value_name = "FOLDER")]
    folders: Vec<PathBuf>,
    /// Where the page goes [default: review.html in the folder of --out]
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
    #[command(flatten)]
    place: Place,
}

/// Folders that are looked into where none is named.
const USUAL: [&str; 2] = ["snapshots", "tests"];
/// Largest side of a picture that is shown.
const MOST_SIDE_PX: u32 = 4096;
/// Longest text whose lines are compared.
const MOST_BYTES: usize = 1 << 18;
/// Deepest folder that is looked into.
const MOST_DEPTH: u32 = 32;

/// A snapshot that waits.
struct Pending {
    /// The snapshot's file, whether it exists or not.
    path: PathBuf,
    /// The test file that it comes from, or nothing.
    source: String,
    /// What changed, in a few words.
    what: String,
    shown: Shown,
}

/// What can be shown of it.
enum Shown {
    Picture(Vec<PictureLayer>),
    Text { old: Option<String>, new: String },
    Nothing,
}

pub fn run(arguments: &ReviewArguments, streams: &mut Streams<'_>) -> Result<u8, Failure> {
    let usual = || USUAL.map(PathBuf::from).into_iter().filter(|folder| folder.is_dir()).collect();
    let folders: Vec<PathBuf> =
        if arguments.folders.is_empty() { usual() } else { arguments.folders.clone() };
    if folders.is_empty() {
        return Err(usage(
            "there is no folder snapshots and no folder tests here: name the folder to look into",
        ));
    }
    let mut found = Vec::new();
    for folder in &folders {
        walk(folder, 0, &mut found)?;
    }
    found.sort();
    found.dedup();
    let looked = found.iter().map(|path| look(path)).collect::<Result<Vec<_>, _>>()?;
    let pending: Vec<_> = looked.into_iter().flatten().collect();
    let default = || arguments.place.out.join("review.html");
    let output = arguments.output.clone().unwrap_or_else(default);
    let read = found.iter().map(|path| ("a pending snapshot", path.as_path(), Use::Reads));
    let olds = pending.iter().map(|one| ("a snapshot", one.path.as_path(), Use::Reads));
    let page = ("the page", output.as_path(), Use::Writes);
    distinct(&read.chain(olds).chain([page]).collect::<Vec<_>>())?;
    let report = report(&pending, &folders);
    let sentence = report.outcome.clone().map(|outcome| outcome.sentence).unwrap_or_default();
    for one in &pending {
        writeln!(streams.output, "\n{}: {}", one.path.display(), one.what)?;
        writeln!(streams.output, "  accept: {}", accept(one))?;
        writeln!(streams.output, "  or, without cargo-insta: {}", update(one))?;
    }
    let left_over = found.len() - pending.len();
    if left_over > 0 {
        writeln!(
            streams.output,
            "{left_over} accepted already; the next cargo test removes what is left over"
        )?;
    }
    writeln!(streams.output, "{}{sentence}", if pending.is_empty() { "" } else { "\n" })?;
    if save_page(&output, report, streams) {
        writeln!(streams.output, "report: {}", printable_path(&output))?;
    }
    Ok(if pending.is_empty() { exit::AGREES } else { exit::DISAGREES })
}

/// Files that end in `.snap.new` below a folder; links are not followed.
fn walk(folder: &Path, depth: u32, found: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let failed = |error| usage(format!("cannot read {}: {error}", folder.display()));
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let (kind, path) = (entry.file_type().map_err(failed)?, entry.path());
        let name = entry.file_name();
        if kind.is_dir() && depth < MOST_DEPTH && name != "target" && name != ".git" {
            walk(&path, depth + 1, found)?;
        } else if kind.is_file() && name.to_string_lossy().ends_with(".snap.new") {
            found.push(path);
        }
    }
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    input::read(path, limits::DOCUMENT_BYTES).map_err(|error| usage(error.to_string()))
}

/// A file that may be missing.
fn read_if_there(path: &Path) -> Result<Option<Vec<u8>>, Failure> {
    if path.exists() { read(path).map(Some) } else { Ok(None) }
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Lines end in a line feed alone, as insta compares them.
fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).replace("\r\n", "\n")
}

/// Head and content of a snapshot file: between two lines of three dashes, and after them.
fn parse(text: &str) -> (&str, &str) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let body = text.strip_prefix("---\n").and_then(|rest| rest.split_once("\n---\n"));
    // A picture's file ends with its head.
    let head_only = || Some((text.strip_prefix("---\n")?.strip_suffix("\n---")?, ""));
    body.or_else(head_only).unwrap_or(("", text))
}

/// The value of a line `name: value` of a head.
fn field<'a>(head: &'a str, name: &str) -> Option<&'a str> {
    let value = head.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "))?;
    Some(value.trim().trim_matches('"'))
}

/// What waits, or nothing where it was accepted in the meantime.
fn look(new_path: &Path) -> Result<Option<Pending>, Failure> {
    let path = new_path.with_extension("");
    let text = text_of(&read(new_path)?);
    let (head, new) = parse(&text);
    let source = field(head, "source").unwrap_or("").to_owned();
    if field(head, "snapshot_kind") == Some("binary") {
        let ending = format!(".{}", field(head, "extension").unwrap_or("bin"));
        let bytes = read_if_there(&with_ending(new_path, &ending))?;
        let old = read_if_there(&with_ending(&path, &ending))?;
        let (what, shown) = match bytes {
            None if old.is_some() => return Ok(None),
            None => (format!("the new file X.snap.new{ending} is missing"), Shown::Nothing),
            Some(bytes) if ending == ".png" => pictures(old.as_deref(), &bytes),
            Some(bytes) => (format!("{} bytes that are no picture", bytes.len()), Shown::Nothing),
        };
        return Ok(Some(Pending { path, source, what, shown }));
    }
    let old = read_if_there(&path)?.map(|old| parse(&text_of(&old)).1.to_owned());
    if old.as_ref().is_some_and(|old| old.trim_end() == new.trim_end()) {
        return Ok(None);
    }
    let longest = old.as_ref().map_or(0, String::len).max(new.len());
    let (what, shown) = if longest > MOST_BYTES {
        (format!("a text of {longest} bytes, too long to show"), Shown::Nothing)
    } else {
        let what = if old.is_some() { "a changed text" } else { "a new text" };
        (what.to_owned(), Shown::Text { old, new: new.to_owned() })
    };
    Ok(Some(Pending { path, source, what, shown }))
}

/// A picture of at most [`MOST_SIDE_PX`] a side.
fn decode(bytes: &[u8]) -> Result<RgbImage, String> {
    let reader = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let (width, height) = reader().into_dimensions().map_err(|e| e.to_string())?;
    if width.max(height) > MOST_SIDE_PX {
        return Err(format!("{width} x {height} px is too large to show"));
    }
    Ok(reader().decode().map_err(|e| e.to_string())?.to_rgb8())
}

/// What changed: for the sheets of cases who draws how many pixels of the case otherwise.
fn pictures(old: Option<&[u8]>, new: &[u8]) -> (String, Shown) {
    let image = match decode(new) {
        Ok(image) => image,
        Err(reason) => return (format!("no readable PNG: {reason}"), Shown::Nothing),
    };
    let new_layer = PictureLayer::new("new", &image);
    match old.map(decode) {
        None => ("a new picture".to_owned(), Shown::Picture(vec![new_layer])),
        Some(Err(reason)) => (
            format!("a picture; the old one is not readable: {reason}"),
            Shown::Picture(vec![new_layer]),
        ),
        Some(Ok(before)) => {
            let sheets = old.and_then(Sheet::from_png).zip(Sheet::from_png(new));
            let what =
                sheets.map_or_else(|| difference(&before, &image), |(a, b)| who_changed(&a, &b));
            (what, Shown::Picture(vec![PictureLayer::new("old", &before), new_layer]))
        }
    }
}

/// Panels of old and new sheet, compared by the pixels of the case.
fn who_changed(old: &Sheet, new: &Sheet) -> String {
    let changes = panels::changes(old, new);
    let changed: Vec<_> = changes
        .iter()
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| match count {
            1 => format!("{name} changed in 1 pixel"),
            n => format!("{name} changed in {n} pixels"),
        })
        .collect();
    match changed.as_slice() {
        [] => "no pixel of the case changed: the sheet itself did".to_owned(),
        _ => changed.join(", "),
    }
}

fn difference(old: &RgbImage, new: &RgbImage) -> String {
    if old.dimensions() != new.dimensions() {
        let ((a, b), (c, d)) = (old.dimensions(), new.dimensions());
        return format!("a picture of {a} x {b} px became one of {c} x {d} px");
    }
    let count = old.pixels().zip(new.pixels()).filter(|(a, b)| a != b).count();
    format!(
        "{count} of {} pixels of the picture changed",
        u64::from(old.width()) * u64::from(old.height())
    )
}

fn accept(one: &Pending) -> String {
    format!("cargo insta accept --snapshot '{}'", one.path.display())
}

/// The command that accepts all that its test file says now: `tests/it/page.rs` is module `page` of
/// the test binary `it`.
fn update(one: &Pending) -> String {
    let parts: Vec<_> = one.source.trim_end_matches(".rs").split('/').collect();
    let which = match parts.as_slice() {
        ["tests", binary] => format!(" --test {binary}"),
        ["tests", binary, "main"] => format!(" --test {binary}"),
        ["tests", binary, module] => format!(" --test {binary} {module}::"),
        _ => String::new(),
    };
    format!("INSTA_UPDATE=always cargo test{which}")
}

fn report(pending: &[Pending], folders: &[PathBuf]) -> Report {
    let names: Vec<_> = folders.iter().map(|folder| folder.display().to_string()).collect();
    let places = names.join(", ");
    let sentence = match pending.len() {
        0 => format!("No snapshot waits for review in {places}."),
        1 => format!("1 changed snapshot waits for review in {places}."),
        n => format!("{n} changed snapshots wait for review in {places}."),
    };
    let word = if pending.is_empty() { "NOTHING PENDING" } else { "PENDING" };
    let mut report = Report {
        title: "Review of snapshots".to_owned(),
        outcome: Some(Outcome { good: pending.is_empty(), word: word.to_owned(), sentence }),
        command: format!("{} review {}", program(), names.join(" ")),
        ..Report::default()
    };
    let mut rows = Vec::new();
    for one in pending {
        let name = one.path.display().to_string();
        let cells = vec![name.clone(), one.what.clone(), accept(one), update(one)];
        let search = matches!(one.shown, Shown::Picture(_)).then(|| name.clone());
        rows.push(Row { cells, search, ..Row::default() });
        let (about, command) = (one.what.clone(), accept(one));
        match &one.shown {
            Shown::Picture(layers) => report.frames.push(PictureView {
                name,
                about,
                command,
                layers: layers.clone(),
                ..PictureView::default()
            }),
            Shown::Text { old, new } => report.diffs.push(TextDiff {
                name,
                about,
                command,
                old: old.clone(),
                new: new.clone(),
            }),
            Shown::Nothing => {}
        }
    }
    if !rows.is_empty() {
        let columns = ["snapshot", "what", "accept", "without cargo-insta"].map(Column::words);
        let caption = "Snapshots that wait".to_owned();
        report.tables.push(Table { caption, columns: columns.to_vec(), rows });
    }
    report
}
