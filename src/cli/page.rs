//! Where a command puts what it makes: a page of its own, pictures beside it, and an index of the
//! pages in that folder.

use std::io::Read as _;
use std::path::{Component, Path, PathBuf};

use rasterproof_host::input;
use rasterproof_host::text::printable_path;

use super::files::Use;
use super::typed::Typed;
use super::{Failure, Streams, usage};
use rasterproof_report::html::{self, Report};

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
}

/// Bytes of a page that hold what an index says of it.
const HEAD_BYTES: u64 = 8192;

impl PageArguments {
    /// Refuses a folder into which nothing would be written.
    pub(super) fn refuse_idle_folder(&self, typed: &Typed) -> Result<(), Failure> {
        match typed.given(&["out"]) {
            Some(_) if !self.report => Err(usage(
                "--out is the folder of a page, and none is written: add --report, or leave --out away",
            )),
            _ => Ok(()),
        }
    }

    /// The page of a command, as a file that it writes; none where no page was asked for.
    pub(super) fn page(&self, name: &str) -> Option<PathBuf> {
        self.report.then(|| self.place.out.join(name))
    }
}

/// A page as an entry of the files that a command line names.
pub(super) fn as_file(page: &Option<PathBuf>) -> Option<(&'static str, &Path, Use)> {
    page.as_deref().map(|path| ("the page of --report", path, Use::Writes))
}

/// Writes the page of a command and says on standard error where it is.
pub(super) fn write_page(path: &Path, report: Report, streams: &mut Streams<'_>) {
    if save_page(path, report, streams) {
        let _ = writeln!(streams.errors, "report: {}", printable_path(path));
    }
}

/// Writes a page and the index of its folder; returns whether the page was written.
pub(super) fn save_page(path: &Path, report: Report, streams: &mut Streams<'_>) -> bool {
    let folder = path.parent().unwrap_or(Path::new(""));
    let report = Report { docs: docs_from(folder), ..report };
    let is_written = streams.save(path, html::page(&report).as_bytes());
    if is_written && let Err(error) = write_index(folder, streams) {
        let folder = printable_path(folder);
        streams.lose(&format!("{folder}: the pages cannot be listed in index.html: {error}"));
    }
    is_written
}

/// The index of a folder, unless another file of that name is there.
fn write_index(folder: &Path, streams: &mut Streams<'_>) -> std::io::Result<()> {
    let index = folder.join("index.html");
    let is_ours = |text: String| text.contains("<title>Pages of rasterproof</title>");
    if index.exists() && !read_head(&index).is_some_and(is_ours) {
        return Ok(());
    }
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(here)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(".html") && name != "index.html" {
            pages.extend(read_head(&path).map(|text| (name, text)));
        }
    }
    pages.sort();
    streams.save(&index, html::index(&pages).as_bytes());
    Ok(())
}

/// The first bytes of a file as text, or nothing.
fn read_head(path: &Path) -> Option<String> {
    let mut bytes = Vec::new();
    input::open(path, u64::MAX).ok()?.take(HEAD_BYTES).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// The address of the docs from a page in a folder: where a checkout is at hand and the way is plain.
fn docs_from(folder: &Path) -> String {
    let is_plain = folder.components().all(|c| matches!(c, Component::Normal(_)));
    if !is_plain || !Path::new("docs/index.md").is_file() {
        return String::new();
    }
    "../".repeat(folder.components().count()) + "docs/"
}
