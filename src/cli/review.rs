//! `rasterproof review`: snapshots that changed, old beside new, and how to accept them.
//!
//! insta leaves a changed snapshot `X.snap` as `X.snap.new` beside it, and the bytes of a changed
//! picture as `X.snap.new.png`. With `INSTA_UPDATE=always` it updates `X.snap` and leaves an older
//! `X.snap.new` until the next run; such a left-over does not wait for anything. This only looks:
//! accepting is insta's business. What is no text and no PNG, or is broken or too large to show, is
//! listed without being shown. The work is bounded: a review of many snapshots shows the first ones
//! and counts the others.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};

use image::{ImageFormat, ImageReader, RgbImage};
use rasterproof_host::error::FileError;
use rasterproof_host::input;
use rasterproof_host::limits::{self, DOCUMENT_BYTES};
use rasterproof_host::output::{self, Output, Use};
use rasterproof_host::shell;
use rasterproof_host::text::{printable, printable_path, printable_short};

use super::page::{self, Place};
use super::{Status, Streams, exit, program, usage};
use rasterproof_report::html::{Chapter, Outcome, PictureLayer, PictureView, Report, TextDiff};
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::noun;

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
/// Snapshots that are listed, and shown where there is room on the page.
const MOST_LISTED: usize = 500;
/// Folders that are named where they cannot be read.
const MOST_UNREAD: usize = 10;

struct Pending {
    /// The snapshot's file, whether it exists or not.
    path: PathBuf,
    /// The test file that it comes from, or nothing.
    source: String,
    what: String,
    shown: FileContent,
}

#[derive(Clone)]
enum FileContent {
    Picture(Vec<PictureLayer>),
    Text { old: Option<String>, new: String },
    Nothing,
}

/// Looks for pending snapshots, lists them, and writes the page that shows them.
pub fn run(arguments: &ReviewArguments, streams: &mut Streams<'_>) -> Status {
    let usual = || USUAL.map(PathBuf::from).into_iter().filter(|folder| folder.is_dir()).collect();
    let folders: Vec<PathBuf> =
        if arguments.folders.is_empty() { usual() } else { arguments.folders.clone() };
    if folders.is_empty() {
        return Err(usage(
            "there is no folder snapshots and no folder tests here: name the folder to look into",
        ));
    }
    let (mut found, mut unread) = (Vec::new(), Vec::new());
    for folder in &folders {
        // A folder that was named must be there; one inside it costs a warning.
        fs::read_dir(folder).map_err(|error| usage(cannot_read(folder, &error)))?;
        walk(folder, &mut found, &mut unread);
    }
    // Pending snapshots are looked at in the order of their names, so that two reviews of the same files are the same page.
    found.sort();
    found.dedup();
    // Each picture that is shown takes of this budget, so that a folder of large pictures ends.
    let mut left_px = limits::REVIEWED_PX;
    let (mut pending, mut accepted, mut left_out) = (Vec::new(), 0, 0);
    for path in &found {
        if pending.len() == MOST_LISTED {
            left_out += 1;
        } else if let Some(one) = look(path, &mut left_px) {
            pending.push(one);
        } else {
            accepted += 1;
        }
    }
    // The page must not replace what it is about.
    let default = || arguments.place.output("review.html");
    let output = arguments.output.as_deref().map_or_else(default, Output::typed);
    let read = found.iter().map(|path| ("a pending snapshot", path.as_path(), Use::Reads));
    let olds = pending.iter().map(|one| ("a snapshot", one.path.as_path(), Use::Reads));
    let page = output.named("the page");
    output::check_all(read.chain(olds).chain([page]))?;
    for warning in unread.iter().take(MOST_UNREAD) {
        writeln!(streams.errors, "warning: not looked into: {warning}")?;
    }
    if let Some(more @ 1..) = unread.len().checked_sub(MOST_UNREAD) {
        let folders = noun(more as u64, "folder", "folders");
        writeln!(streams.errors, "warning: {more} more {folders} could not be looked into")?;
    }
    let mut notes = Vec::new();
    if left_out > 0 {
        let are = noun(left_out as u64, "is", "are");
        notes.push(format!(
            "{left_out} more {are} not looked into: accept or reject the {MOST_LISTED} listed ones first, \
             or name a folder with fewer"
        ));
    }
    if accepted > 0 {
        let left_over = "the next cargo test removes what is left over";
        notes.push(format!("{accepted} accepted already; {left_over}"));
    }
    let report = Report { notes, ..report(&pending, left_out, &folders) };
    // Nothing pending is an answer only where everything was looked at.
    let status = match (pending.is_empty(), unread.is_empty()) {
        (false, _) => exit::DISAGREES,
        (true, true) => exit::AGREES,
        // Something may wait where nobody could look.
        (true, false) => exit::USAGE,
    };
    page::show(report, page::Shown::All, Some(output), status, streams)
}

fn cannot_read(folder: &Path, error: &io::Error) -> String {
    format!("cannot read {}: {error}", printable_path(folder))
}

/// What ends in `.snap.new` below a folder, and the folders that could not be read. Links to folders
/// are not followed, so that this ends.
fn walk(top: &Path, found: &mut Vec<PathBuf>, unread: &mut Vec<String>) {
    let mut folders = vec![top.to_owned()];
    while let Some(folder) = folders.pop() {
        let mut look_at = |entry: io::Result<fs::DirEntry>| {
            let entry = entry?;
            let (is_dir, name) = (entry.file_type()?.is_dir(), entry.file_name());
            // `target` holds copies, and `.git` no snapshot that a test reads.
            if is_dir && name != "target" && name != ".git" {
                folders.push(entry.path());
            } else if !is_dir && name.to_string_lossy().ends_with(".snap.new") {
                found.push(entry.path());
            }
            Ok(())
        };
        let failed = match fs::read_dir(&folder) {
            Ok(entries) => entries.filter_map(|entry| look_at(entry).err()).collect(),
            Err(error) => vec![error],
        };
        unread.extend(failed.iter().map(|error| cannot_read(&folder, error)));
    }
}

/// The bytes of the file whose name is a path with an ending behind it, where there is one.
fn read_if_there(path: &Path, ending: &str) -> Result<Option<Vec<u8>>, FileError> {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    match input::read(Path::new(&name), DOCUMENT_BYTES) {
        Err(error) if error.missing => Ok(None),
        other => other.map(Some),
    }
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

/// What waits, or nothing where it was accepted in the meantime. A file that cannot be read is
/// listed with the reason, since it may hide a change.
fn look(new_path: &Path, left_px: &mut u64) -> Option<Pending> {
    let path = new_path.with_extension("");
    let mut source = String::new();
    let found = match look_into(new_path, &path, &mut source, left_px) {
        Err(error) => Some((format!("cannot be shown: {error}"), FileContent::Nothing)),
        Ok(found) => found,
    };
    found.map(|(what, shown)| Pending { path, source, what, shown })
}

/// What changed, and how it is shown; the test file goes into `source`.
fn look_into(
    new_path: &Path,
    path: &Path,
    source: &mut String,
    left_px: &mut u64,
) -> Result<Option<(String, FileContent)>, FileError> {
    let text = text_of(&input::read(new_path, DOCUMENT_BYTES)?);
    let (head, new) = parse(&text);
    source.push_str(field(head, "source").unwrap_or(""));
    // A picture's bytes are in a file of their own beside the head.
    if field(head, "snapshot_kind") == Some("binary") {
        let ending = field(head, "extension").unwrap_or("bin");
        let shown_ending = printable_short(ending, 20);
        // It names a file beside this one, and no other.
        if ending.contains(['/', '\\']) {
            let what = format!("the ending {shown_ending} of its file is no ending");
            return Ok(Some((what, FileContent::Nothing)));
        }
        let ending = format!(".{ending}");
        let old = read_if_there(path, &ending)?;
        return Ok(Some(match read_if_there(new_path, &ending)? {
            // Without its new bytes but with old ones, the picture was accepted and its head left over.
            None if old.is_some() => return Ok(None),
            None => {
                (format!("the new file X.snap.new.{shown_ending} is missing"), FileContent::Nothing)
            }
            Some(bytes) if ending == ".png" => pictures(old.as_deref(), &bytes, left_px),
            Some(bytes) => {
                (format!("{} bytes that are no picture", bytes.len()), FileContent::Nothing)
            }
        }));
    }
    let old = read_if_there(path, "")?.map(|old| parse(&text_of(&old)).1.to_owned());
    // insta does not tell texts apart by what follows their last line.
    if old.as_ref().is_some_and(|old| old.trim_end() == new.trim_end()) {
        return Ok(None);
    }
    let longest = old.as_ref().map_or(0, String::len).max(new.len());
    if longest > limits::COMPARED_TEXT_BYTES {
        return Ok(Some((
            format!("a text of {longest} bytes, too long to show"),
            FileContent::Nothing,
        )));
    }
    let what = if old.is_some() { "a changed text" } else { "a new text" };
    Ok(Some((what.to_owned(), FileContent::Text { old, new: new.to_owned() })))
}

/// A picture of at most [`limits::SHOWN_SIDE_PX`] a side.
fn decode(bytes: &[u8], left_px: &mut u64) -> Result<RgbImage, String> {
    let reader = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    // The size is read before the pixels, which a small file may claim to have billions of.
    let (width, height) = reader().into_dimensions().map_err(|e| e.to_string())?;
    if width.max(height) > limits::SHOWN_SIDE_PX {
        return Err(format!("{width} x {height} px is too large to show"));
    }
    *left_px = left_px.checked_sub(u64::from(width) * u64::from(height)).ok_or_else(|| {
        let millions = limits::REVIEWED_PX >> 20;
        format!("not looked into: the pictures before it have {millions} million pixels")
    })?;
    Ok(reader().decode().map_err(|e| e.to_string())?.to_rgb8())
}

/// What changed, and where.
fn pictures(old: Option<&[u8]>, new: &[u8], left_px: &mut u64) -> (String, FileContent) {
    let image = match decode(new, left_px) {
        Ok(image) => image,
        Err(reason) => return (format!("no readable PNG: {reason}"), FileContent::Nothing),
    };
    let mut layers = vec![PictureLayer::new("new", &image)];
    let what = match old.map(|old| decode(old, left_px)) {
        None => "a new picture".to_owned(),
        Some(Err(reason)) => format!("a picture; the old one is not readable: {reason}"),
        Some(Ok(before)) => {
            // The old picture comes first, as the viewer shows its layers from left to right.
            layers.insert(0, PictureLayer::new("old", &before));
            difference(&before, &image)
        }
    };
    (what, FileContent::Picture(layers))
}

/// Where two pictures differ: how many pixels, and the box around them.
fn difference(old: &RgbImage, new: &RgbImage) -> String {
    if old.dimensions() != new.dimensions() {
        let ((a, b), (c, d)) = (old.dimensions(), new.dimensions());
        return format!("a picture of {a} x {b} px became one of {c} x {d} px");
    }
    let (mut count, mut first, mut last) = (0u64, [u32::MAX; 2], [0; 2]);
    for ((x, y, _), _) in old.enumerate_pixels().zip(new.pixels()).filter(|((.., a), b)| a != b) {
        count += 1;
        first = [first[0].min(x), first[1].min(y)];
        last = [last[0].max(x), last[1].max(y)];
    }
    if count == 0 {
        return "no pixel of the picture changed".to_owned();
    }
    let all = u64::from(old.width()) * u64::from(old.height());
    let ([x0, y0], [x1, y1]) = (first, last);
    format!("{count} of {all} pixels of the picture changed, from {x0},{y0} to {x1},{y1}")
}

/// The command that accepts one snapshot.
fn accept(one: &Pending) -> String {
    let words = ["cargo", "insta", "accept", "--snapshot"].map(OsStr::new);
    shell::line(words.into_iter().chain([one.path.as_os_str()]))
}

/// The command that accepts all that its test file says now: `tests/it/snapshots.rs` is module `snapshots` of
/// the test binary `it`.
fn update(one: &Pending) -> String {
    let parts: Vec<_> = one.source.trim_end_matches(".rs").split('/').collect();
    let module;
    let which: &[&str] = match parts.as_slice() {
        ["tests", binary] | ["tests", binary, "main"] => &["--test", binary],
        ["tests", binary, name] => {
            module = format!("{name}::");
            &["--test", binary, &module]
        }
        _ => &[],
    };
    format!("INSTA_UPDATE=always {}", shell::line(["cargo", "test"].iter().chain(which).copied()))
}

/// The page: a table of what waits, and each picture and text old beside new.
fn report(pending: &[Pending], left_out: usize, folders: &[PathBuf]) -> Report {
    let names: Vec<_> = folders.iter().map(|folder| folder.to_string_lossy()).collect();
    let places = printable(&names.join(", ")).into_owned();
    let sentence = match pending.len() + left_out {
        0 => format!("No snapshot waits for review in {places}."),
        1 => format!("1 changed snapshot waits for review in {places}."),
        n => format!("{n} changed snapshots wait for review in {places}."),
    };
    let word = if pending.is_empty() { "NOTHING PENDING" } else { "PENDING" };
    let mut report = Report {
        title: "Review of snapshots".to_owned(),
        outcome: Some(Outcome::new(pending.is_empty(), word, sentence)),
        command: format!("{} review {}", program(), shell::line(folders)),
        ..Report::default()
    };
    let mut rows = Vec::new();
    for one in pending {
        let (name, about, command) = (printable_path(&one.path), one.what.clone(), accept(one));
        let row = Row::of(&[&format!("{name}: {about}"), &command, &update(one)]);
        // A row of the table leads to the picture of that name on the page.
        let search = matches!(one.shown, FileContent::Picture(_)).then(|| name.clone());
        rows.push(Row { search, ..row });
        match one.shown.clone() {
            FileContent::Picture(layers) => {
                let chapter = Chapter::default();
                report.frames.push(PictureView { name, about, command, chapter, layers });
            }
            FileContent::Text { old, new } => {
                report.diffs.push(TextDiff { name, about, command, old, new });
            }
            FileContent::Nothing => {}
        }
    }
    if !rows.is_empty() {
        let columns = "~snapshot 1 | :accept | :without cargo-insta";
        report.tables.push(Table::new("Snapshots that wait", columns, rows));
    }
    report
}
