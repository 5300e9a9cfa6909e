//! Where a command puts what it makes: a page of its own, pictures beside it, and an index of the
//! pages in that folder.

use std::io::{Read as _, Write};
use std::path::{Component, Path, PathBuf};

use rasterproof_host::input;
use rasterproof_host::limits::SOURCE_BYTES;
use rasterproof_host::text::printable_path;

use super::{Failure, usage, write_file};
use crate::report::html::{self, Report};

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

/// Writes the page of a command and says where; commands that print a result say it on standard error.
pub fn write_page(path: &Path, report: Report, stream: &mut dyn Write) -> Result<(), Failure> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let report = Report { docs: docs_from(folder), ..report };
    write_file(path, html::page(&report).as_bytes())?;
    writeln!(stream, "report: {}", printable_path(path))?;
    write_index(folder)
}

/// The index of a folder, unless another file of that name is there.
fn write_index(folder: &Path) -> Result<(), Failure> {
    let index = folder.join("index.html");
    let is_ours = |text: String| text.contains("<title>Pages of rasterproof</title>");
    if index.exists() && !read_head(&index).is_some_and(is_ours) {
        return Ok(());
    }
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let failed = |error| usage(format!("cannot read {}: {error}", printable_path(here)));
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(here).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(".html") && name != "index.html" {
            pages.extend(read_head(&path).map(|text| (name, text)));
        }
    }
    pages.sort();
    write_file(&index, html::index(&pages).as_bytes())
}

/// The first bytes of a file as text, or nothing.
fn read_head(path: &Path) -> Option<String> {
    let mut bytes = Vec::new();
    input::open(path, SOURCE_BYTES).ok()?.take(HEAD_BYTES).read_to_end(&mut bytes).ok()?;
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
