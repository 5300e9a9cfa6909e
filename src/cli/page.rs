//! Where a command puts what it makes: a page of its own, pictures beside it, and an index of the
//! pages in that folder.

use std::path::{Component, Path, PathBuf};

use rasterproof_host::input;
use rasterproof_host::output::{Named, Output, Over};
use rasterproof_host::text::printable_path;

use super::typed::Typed;
use super::{InputError, Status, Streams, usage};
use rasterproof_report::html::{self, Report};
use rasterproof_report::{json, text};

/// Options of every command that writes pages or pictures.
#[derive(clap::Args, Debug)]
pub struct PageArguments {
    /// Write a page to look into, named after the command, and index.html, which lists the pages
    #[arg(long)]
    pub report: bool,
    #[command(flatten)]
    pub place: Place,
}

/// The folder of what a command makes.
#[derive(clap::Args, Debug)]
pub struct Place {
    /// Folder of pages and pictures
    #[arg(long, value_name = "DIR", default_value = "target/rasterproof")]
    pub out: PathBuf,
    /// Replace a file in that folder also where this program did not make it
    #[arg(long)]
    pub force: bool,
}

impl Place {
    /// A file in a folder whose name the program has chosen.
    pub(super) fn output_in(&self, folder: &Path, name: impl AsRef<Path>) -> Output {
        let over = if self.force { Over::Any } else { Over::Marked };
        Output { path: folder.join(name), over }
    }

    /// A file in this folder.
    pub(super) fn output(&self, name: impl AsRef<Path>) -> Output {
        self.output_in(&self.out, name)
    }
}

/// Bytes of a page that hold what an index says of it.
const HEAD_BYTES: u64 = 8192;

impl PageArguments {
    /// Refuses a folder into which nothing would be written.
    pub(super) fn refuse_idle_folder(&self, typed: &Typed) -> Result<(), InputError> {
        // Nothing is written where the page was asked for only by its folder.
        match typed.given(&["out", "force"]) {
            Some(option) if !self.report => Err(usage(format!(
                "--{option} is about the folder of a page, and none is written: add --report, or leave --{option} away",
            ))),
            _ => Ok(()),
        }
    }

    /// The page of a command, as a file that it writes; none where no page was asked for.
    pub(super) fn page(&self, name: &str) -> Option<Output> {
        self.report.then(|| self.place.output(name))
    }
}

/// A page as an entry of the files that a command line names.
pub(super) fn as_file(page: &Option<Output>) -> Option<Named<'_>> {
    page.as_ref().map(|page| page.named("the page of --report"))
}

/// What is printed of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// The first screen, where there is one.
    Screen,
    All,
    Json,
}

impl Shown {
    /// JSON where it was asked for; it has all that there is.
    pub(super) fn or_json(self, is_json: bool) -> Self {
        if is_json { Self::Json } else { self }
    }
}

/// Prints all of a report that has no page; the status is that of the command.
pub(super) fn print(report: Report, status: u8, streams: &mut Streams<'_>) -> Status {
    show(report, Shown::All, None, status, streams)
}

/// Prints a report, then writes its page where one was asked for.
pub(super) fn show(
    report: Report,
    shown: Shown,
    page: Option<Output>,
    status: u8,
    streams: &mut Streams<'_>,
) -> Status {
    let text = match shown {
        Shown::Json => json::text(&report.data),
        Shown::Screen | Shown::All => {
            text::text(&report, shown == Shown::All, streams.colour, streams.columns)
        }
    };
    streams.output.write_all(text.as_bytes())?;
    // What was asked for may fail, but not before the verdict is said.
    streams.output.flush()?;
    if let Some(page) = page {
        write_page(&page, report, streams);
    }
    Ok(status)
}

/// Writes the page of a command and the index of its folder, and says on standard error where it is.
pub(super) fn write_page(page: &Output, report: Report, streams: &mut Streams<'_>) {
    let folder = page.path.parent().unwrap_or(Path::new(""));
    let has_playground = folder.join("playground.html").is_file();
    let report = Report { docs: docs_from(folder), has_playground, ..report };
    if !streams.save(page, html::page(&report).as_bytes()) {
        return;
    }
    if let Err(error) = write_index(folder, streams) {
        let folder = printable_path(folder);
        streams.lose(&format!("{folder}: the pages cannot be listed in index.html: {error}"));
    }
    let _ = writeln!(streams.errors, "report: {}", printable_path(&page.path));
}

/// The index of a folder, unless another file of that name is there.
fn write_index(folder: &Path, streams: &mut Streams<'_>) -> std::io::Result<()> {
    let index = folder.join("index.html");
    if index.exists() && !html::is_index(&read_head(&index)) {
        return Ok(());
    }
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(here)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(".html") && name != "index.html" {
            pages.push((name, read_head(&path)));
        }
    }
    pages.sort();
    streams.save(&Output::typed(&index), html::index(&pages).as_bytes());
    Ok(())
}

/// The first bytes of a file as text.
fn read_head(path: &Path) -> String {
    String::from_utf8_lossy(&input::head(path, HEAD_BYTES)).into_owned()
}

/// The address of the docs from a page in a folder: where a checkout is at hand and the way is plain.
fn docs_from(folder: &Path) -> String {
    let is_plain = folder.components().all(|c| matches!(c, Component::Normal(_)));
    if !is_plain || !Path::new("docs/index.md").is_file() {
        return String::new();
    }
    "../".repeat(folder.components().count()) + "docs/"
}
