//! The report page: a [`Report`] becomes one HTML file that needs nothing else, opened from disk.
//!
//! A section that is empty is not shown, so a command fills in what it has.
//!
//! Pictures that were rendered go in as [`PictureView`], cases of the harness as [`CaseView`]; both
//! are shown in the same viewer. Every text is escaped, whatever it holds; the JSON for the script
//! too. Nothing is loaded from outside, which the page's own policy forbids. It refuses to grow
//! beyond [`limits::PAGE_BYTES`]: what does not fit is left out, and the page says what that is.

use std::fmt::Write as _;
use std::sync::LazyLock;
use std::time::Instant;

use base64::Engine as _;
use image::{Rgb, RgbImage};
use rasterproof_host::limits::{self, PAGE_BYTES};
use serde::Serialize;
use similar::{ChangeTag, TextDiff as Lines};

pub use super::chapter::Chapter;
use super::page_cases::CaseView;
use super::picture;
use super::table::{Mark, Table};
use super::words::{grouped, same, serialize_grouped, word};

/// Lines of a text that are shown around what differs.
const CONTEXT: usize = 3;
/// Names of what is left out that a page lists.
const MOST_LEFT_OUT_NAMES: usize = 20;
/// Of a table with more rows than these a page shows the wrong ones and six others, and all once the reader asks for them.
const MOST_ROWS: usize = 8;
/// Below a table with more notes than these, they are folded: a list of them is longer than the table.
const MOST_NOTES: usize = 4;
/// A table beyond this size ends with the number of rows that are left out.
const MOST_TABLE_BYTES: usize = 500_000;

/// The frame of all pages around that of reports.
static TEMPLATE: LazyLock<String> = LazyLock::new(|| {
    rasterproof_view::FRAME.replacen("{{body}}", include_str!("page/page.html"), 1)
});

/// The style of all pages, and that of reports.
static STYLE: LazyLock<String> =
    LazyLock::new(|| rasterproof_view::style(&[include_str!("page/page.css")]));

/// The viewer, and the modules of reports, each behind those that it uses.
static SCRIPT: LazyLock<String> = LazyLock::new(|| {
    rasterproof_view::script(&[
        rasterproof_view::PIXEL,
        include_str!("page/exact.js"),
        include_str!("page/items.js"),
        include_str!("page/explain.js"),
        include_str!("page/tables.js"),
        include_str!("page/report.js"),
    ])
});

/// What the page shows; sections that are empty are left out.
#[must_use]
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What stands at the top, and with the command in the head.
    pub title: String,
    /// The verdict, shown first.
    pub outcome: Option<Outcome>,
    /// What was judged, drawn or measured, and by which version and seed.
    pub about: String,
    /// What the reader wants to know, shown below the verdict.
    pub answers: Vec<Statement>,
    /// The first answer as a picture, at the top of the page; the tables and other plots are folded below it.
    pub pictured: Option<PicturedAnswer>,
    /// The tables of the text in a terminal that is not asked for all of them.
    pub first_screen: Vec<Table>,
    /// The command that was typed, with the options that make the page.
    pub command: String,
    /// The command that repeats it without pages, where that is another one.
    pub repeat: String,
    /// Sentences in the last section of the page.
    pub notes: Vec<String>,
    /// Counts and other tables, worst row first.
    pub tables: Vec<Table>,
    /// Cases to look into, worst first.
    pub cases: Vec<CaseView>,
    /// The cases that a terminal shows, above the tables.
    pub excerpts: Vec<Excerpt>,
    /// Rendered pictures, shown in the same viewer as cases.
    pub frames: Vec<PictureView>,
    pub figures: Vec<Figure>,
    /// The same for machines, where it is made of this value.
    pub data: serde_json::Value,
    pub diffs: Vec<TextDiff>,
    /// Where the page finds the folder `docs`: an address that ends in `/`, or nothing.
    pub docs: String,
    /// Whether the playground lies beside the page.
    pub has_playground: bool,
}

/// An answer in one sentence with the picture that shows it.
#[derive(Clone, Debug)]
pub struct PicturedAnswer {
    pub sentence: String,
    pub figure: Figure,
}

/// The answer to a question that a command is called for.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Statement {
    /// The question in a word or two.
    pub about: &'static str,
    pub sentence: String,
    /// The command that says more, or nothing.
    pub command: String,
}

/// A case in a terminal: what was asked, the pixels as characters, and where to go on.
#[derive(Clone, Debug, Default)]
pub struct Excerpt {
    pub title: String,
    /// What was asked and answered, each with what it is.
    pub exchanges: Vec<(&'static str, String)>,
    /// Pixels as characters; its lines are not broken.
    pub grid: String,
    /// What is said of it, a paragraph each.
    pub notes: Vec<String>,
    /// Commands and pages, each with what it is for.
    pub places: Vec<(&'static str, String)>,
}

#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Whether all is well; decides the colour.
    pub good: bool,
    /// The verdict in capitals, as `AGREES`.
    pub word: String,
    /// The verdict in a sentence, with the cause where one is known; nothing where `sentence` says it.
    pub answer: String,
    /// What was judged, in counts.
    pub sentence: String,
}

impl Outcome {
    pub fn new(good: bool, word: &str, sentence: impl Into<String>) -> Self {
        let (word, answer) = (word.to_owned(), String::new());
        Self { good, word, answer, sentence: sentence.into() }
    }

    /// The outcome of a comparison: `AGREES` or `DISAGREES`.
    pub fn of(agrees: bool, sentence: impl Into<String>) -> Self {
        Self::new(agrees, word(agrees), sentence)
    }

    /// Whether something was judged, and not only counted.
    pub(super) fn is_verdict(&self) -> bool {
        [word(self.good), same(self.good)].contains(&&*self.word)
    }

    /// The outcome where there was nothing to compare.
    pub fn not_compared(reason: &str) -> Self {
        Self::new(false, "NOT COMPARED", format!("{reason} Nothing was compared."))
    }

    /// The outcome of pictures that show their background alone.
    pub fn nothing_drawn() -> Self {
        Self::not_compared("No triangle covers a pixel of this view.")
    }

    /// What is said first: the answer, where there is one.
    fn first(&self) -> &str {
        if self.answer.is_empty() { &self.sentence } else { &self.answer }
    }
}

/// A plot with its caption, in one version or in several.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// What it shows; also its text for who does not see it.
    pub caption: String,
    /// An SVG document with a size, shown as an image: scripts in it do not run. Colours for a dark
    /// page go into its own `prefers-color-scheme` style.
    pub svg: String,
    /// The same for other pages, each with the condition of a style sheet that says which.
    pub others: Vec<(&'static str, String)>,
}

/// Two versions of a text, of which the page shows the lines that differ.
#[derive(Clone, Debug, Default)]
pub struct TextDiff {
    pub name: String,
    /// What is said of it below its name.
    pub about: String,
    /// A command that belongs to it, or nothing.
    pub command: String,
    /// Before; nothing where there was none.
    pub old: Option<String>,
    pub new: String,
}

/// Rendered pictures of one scene, any two of which can be compared.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PictureView {
    /// Its name; unique within the page.
    pub name: String,
    #[serde(serialize_with = "serialize_grouped")]
    pub about: String,
    /// The command that makes it, or nothing.
    pub command: String,
    /// The page of the docs about what it shows.
    pub chapter: Chapter,
    pub layers: Vec<PictureLayer>,
}

/// One of the pictures that can be compared.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PictureLayer {
    pub name: String,
    png: String,
    /// Whether it marks pixels of another layer, so that its colours are not compared with those of others.
    is_map: bool,
    /// What its colours mark, each with its name in HTML.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    legend: Vec<(String, &'static str)>,
}

impl PictureLayer {
    /// A picture; it is kept as PNG in a `data:` address. An empty one is shown as one pixel.
    pub fn new(name: &str, image: &RgbImage) -> Self {
        let one = RgbImage::new(1, 1);
        let is_empty = image.width() == 0 || image.height() == 0;
        Self::from_png(name, &picture::png(if is_empty { &one } else { image }))
    }

    /// A picture that is a file already.
    pub fn from_png(name: &str, bytes: &[u8]) -> Self {
        Self {
            name: name.to_owned(),
            png: data_address("image/png", bytes),
            is_map: false,
            legend: Vec::new(),
        }
    }

    /// A picture whose colours mark pixels of another layer, and what each of them marks.
    pub fn map(name: &str, image: &RgbImage, marks: &[(Rgb<u8>, &'static str)]) -> Self {
        let mut legend = Vec::new();
        for (Rgb([r, g, b]), what) in marks {
            legend.push((format!("#{r:02x}{g:02x}{b:02x}"), *what));
        }
        Self { is_map: true, legend, ..Self::new(name, image) }
    }
}

/// Bytes as an address that contains them.
fn data_address(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}

/// Text that is safe between tags and in quoted attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Characters that HTML and XML have no place for.
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() && c != '\n' && c != '\t' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// Text that people read, with thousands apart in its numbers.
fn prose(text: &str) -> String {
    escape(&grouped(text))
}

/// The whole page, below [`limits::PAGE_BYTES`]; the same for the same report.
pub fn page(report: &Report) -> String {
    let mut room =
        limits::PAGE_BYTES.saturating_sub(TEMPLATE.len() + STYLE.len() + SCRIPT.len() + 4096);
    let mut left_out = Vec::new();
    // The head and the tables are always there; what comes after them may take the bytes that are left.
    let head = head(report);
    // A page begins with one picture or one table; all other rows are folded.
    let is_folded = report.pictured.is_some();
    let (mut tables, mut has_rows) = (String::new(), false);
    for one in &report.tables {
        tables += &table(one, is_folded || has_rows && !one.rows.is_empty(), &report.docs);
        has_rows |= !one.rows.is_empty();
    }
    room = room.saturating_sub(head.len() + tables.len() + report.command.len());
    // Takes a part of the page if it fits, and otherwise keeps its name for a note.
    let mut kept = |name: &str, text: String| {
        if text.len() < room {
            room -= text.len() + 1;
            Some(text)
        } else {
            left_out.push(format!("{name} ({} bytes)", text.len()));
            None
        }
    };
    // Comparing texts may take long, so each of them and all together have a time limit.
    let last = Instant::now() + limits::ALL_DIFFS_TIME;
    let (mut diffs, mut figures) = (String::new(), String::new());
    for diff in &report.diffs {
        let text = text_diff(diff, last.min(Instant::now() + limits::DIFF_TIME));
        diffs.extend(kept(&diff.name, text));
    }
    for one in &report.figures {
        let figure = figure(one);
        let figure = if is_folded { folded(&one.caption, &figure) } else { figure };
        figures.extend(kept(&one.caption, figure));
    }
    let (mut cases, mut frames) = (Vec::new(), Vec::new());
    for case in &report.cases {
        cases.extend(kept(&case.name, json(case)));
    }
    for view in &report.frames {
        frames.extend(kept(&view.name, json(view)));
    }
    let (cases, frames) = (cases.join(","), frames.join(","));
    let docs = json(&report.docs);
    let playground = report.has_playground;
    // What the script reads: the viewer shows cases and pictures.
    let data = format!(
        "{{\"docs\":{docs},\"playground\":{playground},\"cases\":[{cases}],\"frames\":[{frames}]}}"
    );
    // How to repeat it stands last, with everything that did not fit.
    let run = command(&report.command) + &notes(&report.notes, &left_out);
    let sections = [("Plots", figures), ("Summary", tables), ("Texts", diffs), ("Run", run)];
    // Links at the top, to the sections that are not empty.
    let has_cases = !cases.is_empty() || !frames.is_empty();
    let cases_title = if cases.is_empty() { "Pictures" } else { "Cases" };
    let mut links = Vec::new();
    if has_cases {
        links.push(("cases".to_owned(), cases_title));
    }
    for (title, inside) in &sections {
        if !inside.is_empty() {
            links.push((title.to_ascii_lowercase(), *title));
        }
    }
    let jump = jump(&links);
    fill(|part| match part {
        "title" => escape(&title(report)),
        "style" => STYLE.clone(),
        "script" => SCRIPT.clone(),
        "head" => head.clone(),
        "about" => about(report),
        "jump" => jump.clone(),
        "cases-title" => cases_title.to_owned(),
        "sections" => sections.iter().map(|(title, inside)| section(title, inside)).collect(),
        "data" => data.clone(),
        _ => String::new(),
    })
}

/// The title of a page says which command wrote it, so that no two reports have one title.
fn title(report: &Report) -> String {
    let command = if report.repeat.is_empty() { &report.command } else { &report.repeat };
    if command.is_empty() { report.title.clone() } else { format!("{} ({command})", report.title) }
}

/// The template with each `{{name}}` replaced once: what is put in is not looked at again.
fn fill(part: impl Fn(&str) -> String) -> String {
    let (first, pieces) = TEMPLATE.split_once("{{").unwrap_or((&TEMPLATE, ""));
    let mut page = first.to_owned();
    for piece in pieces.split("{{") {
        let (name, rest) = piece.split_once("}}").unwrap_or(("", piece));
        page += &part(name);
        page += rest;
    }
    page
}

/// JSON that cannot end the script element it stands in.
fn json(value: &impl Serialize) -> String {
    // Numbers and strings only: this cannot fail.
    serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c")
}

/// Links to the sections, as address and title, where there is more than one.
fn jump(sections: &[(String, &str)]) -> String {
    if sections.len() < 2 {
        return String::new();
    }
    let mut links = Vec::new();
    for (id, title) in sections {
        links.push(format!("<a href=\"#{id}\">{title}</a>"));
    }
    let links = links.join(" ");
    format!("<nav class=\"jump\" aria-label=\"on this page\">{links}</nav>\n")
}

/// A section with its title; nothing where it is empty.
fn section(title: &str, inside: &str) -> String {
    if inside.is_empty() {
        return String::new();
    }
    let id = title.to_ascii_lowercase();
    format!(
        "<section id=\"{id}\" aria-labelledby=\"{id}-title\"><h2 id=\"{id}-title\">{title}</h2>\n{inside}</section>\n"
    )
}

/// What stands above the cases: the verdict, the answers, and what it is about.
fn head(report: &Report) -> String {
    // The verdict comes first, then its picture, then what was judged, then the answers.
    let mut out = format!("<h1>{}</h1>\n", escape(&report.title));
    if let Some(outcome) = &report.outcome {
        let class = if outcome.good { "good" } else { "bad" };
        let (word, first) = (escape(&outcome.word), prose(outcome.first()));
        let _ = writeln!(
            out,
            "<p id=\"verdict\" class=\"verdict {class}\"><strong>{word}</strong> <span>{first}</span></p>"
        );
        if outcome.first() != outcome.sentence {
            let _ = writeln!(out, "<p id=\"counts\">{}</p>", prose(&outcome.sentence));
        }
    }
    if let Some(PicturedAnswer { sentence, figure: shown }) = &report.pictured {
        let _ = writeln!(out, "<p class=\"pictured\">{}</p>", prose(sentence));
        out += &figure(shown);
    }
    for line in report.about.lines() {
        let _ = writeln!(out, "<p class=\"quiet\">{}</p>", escape(line));
    }
    // The answers in words, but for what stands there already.
    let said = report.pictured.as_ref().map_or("", |pictured| &pictured.sentence);
    for Statement { about, sentence, command: more } in &report.answers {
        // What stands above the picture is not said again.
        let sentence = sentence.strip_prefix(said).unwrap_or(sentence).trim_start();
        let (about, sentence) = (escape(about), prose(sentence));
        let _ = writeln!(out, "<p class=\"answer\"><strong>{about}:</strong> {sentence}</p>");
        out += &command(more);
    }
    out
}

/// What an index says of a page stands in its head.
const ABOUT: &str = "<meta name=\"rasterproof\" content=\"";

/// The line of the head by which an index describes the page.
fn about(report: &Report) -> String {
    let outcome = report.outcome.as_ref();
    let said = outcome.map(|o| format!("{}: {}", o.word, o.first()));
    let pictured = || report.pictured.as_ref().map(|pictured| pictured.sentence.clone());
    let said = said.or_else(pictured).unwrap_or_default();
    format!("{ABOUT}{}\">\n", escape(&said))
}

/// Whether a page is an index that [`index`] made.
pub fn is_index(page: &str) -> bool {
    page.contains("<title>Pages of rasterproof</title>")
}

/// The index of the pages in a folder, each given by its file name and its text; nothing is said of
/// what is no page of this program.
pub fn index(pages: &[(String, String)]) -> String {
    let mut rows = String::new();
    for (name, text) in pages {
        let said = between(text, ABOUT, "\">");
        let (Some(said), Some(title)) = (said, between(text, "<title>", "</title>")) else {
            continue;
        };
        let name = escape(name);
        let _ = writeln!(
            rows,
            "<li><a href=\"{name}\">{title}</a> <span class=\"quiet\">{name}</span><p>{said}</p></li>"
        );
    }
    // The index needs no script and loads nothing.
    let style = &*STYLE;
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; img-src data:\">\n<title>Pages of rasterproof</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{style}</style>\n</head>\n<body>\n<header>\
         <h1>Pages of rasterproof</h1></header>\n<main>\n<ul class=\"pages\">\n{rows}</ul>\n</main>\n\
         </body>\n</html>\n"
    )
}

/// What stands between two texts, unless it contains an element.
fn between<'a>(text: &'a str, from: &str, to: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(from)?;
    let (inside, _) = rest.split_once(to)?;
    (!inside.contains('<')).then_some(inside)
}

/// A command with a button that copies it; nothing where there is no command.
fn command(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"command\"><code>{}</code><button type=\"button\" class=\"copy\">copy</button></p>\n",
        escape(text)
    )
}

/// What is said below everything else, and what was left out.
fn notes(notes: &[String], left_out: &[String]) -> String {
    let mut out = String::new();
    for note in notes {
        let _ = writeln!(out, "<p>{}</p>", prose(note));
    }
    if !left_out.is_empty() {
        // The page says what it lacks, but no list of hundreds.
        let mut names = left_out.iter().take(MOST_LEFT_OUT_NAMES).cloned().collect::<Vec<_>>();
        if left_out.len() > names.len() {
            names.push(format!("and {} more", left_out.len() - names.len()));
        }
        let names = escape(&names.join(", "));
        let _ = writeln!(
            out,
            "<p id=\"left-out\">Left out, to keep this file below {PAGE_BYTES} bytes: {names}.</p>"
        );
    }
    out
}

/// What is seen once its title is clicked at.
fn folded(title: &str, inside: &str) -> String {
    format!("<details><summary>{}</summary>\n{inside}</details>\n", escape(title))
}

/// A text in which each page of the docs that it names is a link, where the page knows the way there.
fn with_links(html: &str, docs: &str) -> String {
    let mut parts = html.split("docs/");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let is_name = |name: &str| name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-');
        let _ = match part.split_once(".md").filter(|(name, _)| !docs.is_empty() && is_name(name)) {
            Some((name, rest)) => {
                write!(out, "<a href=\"{0}{name}.md\">docs/{name}.md</a>{rest}", escape(docs))
            }
            None => write!(out, "docs/{part}"),
        };
    }
    out
}

/// A table with its notes, folded or not.
fn table(table: &Table, is_folded: bool, docs: &str) -> String {
    let mut out = String::new();
    if !table.rows.is_empty() {
        out += &rows(table, is_folded);
    }
    let mut notes = String::new();
    for note in &table.notes {
        let _ = writeln!(notes, "<p class=\"quiet\">{}</p>", with_links(&prose(note), docs));
    }
    // Many notes are folded, since they would be longer than the table.
    let is_long = !is_folded && table.notes.len() > MOST_NOTES && !table.rows.is_empty();
    out += &if is_long { folded(&format!("{} notes", table.notes.len()), &notes) } else { notes };
    match is_folded {
        // Notes that stand for themselves.
        _ if table.caption.is_empty() => out,
        true => folded(&table.caption, &out),
        false => format!("<h3 class=\"caption\">{}</h3>{out}", escape(&table.caption)),
    }
}

/// The rows of a table; where there are many, some are hidden until the reader opens them.
fn rows(table: &Table, is_folded: bool) -> String {
    // A table without a caption belongs to the one above it, and has the name of its rows.
    let name = match (&*table.caption, table.columns.first()) {
        ("", Some(column)) => &column.label,
        (caption, _) => caption,
    };
    let mut out = format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" \
         aria-label=\"{0}\"><table class=\"counts\" aria-label=\"{0}\">\n<thead><tr>",
        escape(name)
    );
    for column in &table.columns {
        // A head says what it counts, in a few words more when it is pointed at.
        let class = if column.is_number { " class=\"number\"" } else { "" };
        let about = match column.about.as_str() {
            "" => String::new(),
            about => format!(" title=\"{}\"", escape(about)),
        };
        let _ = write!(out, "<th scope=\"col\"{class}{about}>{}</th>", escape(&column.label));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    // Sums first; where the table becomes too long, the last rows are left out.
    let mut left_out = table.rows.len();
    let most_wrong = table.rows.iter().map(|row| row.wrong).max().unwrap_or(0);
    // The sum of all rows stands above them, where it is seen first.
    let others = table.rows.iter().filter(|row| row.mark != Mark::Sum);
    for row in table.rows.iter().filter(|row| row.mark == Mark::Sum).chain(others) {
        if out.len() > MOST_TABLE_BYTES {
            break;
        }
        left_out -= 1;
        let class = match row.mark {
            Mark::Plain => "",
            Mark::Wrong => " class=\"wrong\"",
            Mark::Sum => " class=\"sum\"",
        };
        let _ = write!(out, "<tr{class}>");
        // A last cell without a column of its own takes the rest of the row.
        let rest = table.columns.len().saturating_sub(row.cells.len());
        for (i, (cell, column)) in row.cells.iter().zip(&table.columns).enumerate() {
            let text = if column.is_number { prose(cell) } else { escape(cell) };
            // A cell that takes the rest of the row is text, whatever its column is.
            let number = match column.is_number {
                _ if rest > 0 && i + 1 == row.cells.len() => format!(" colspan=\"{}\"", rest + 1),
                true => " class=\"number\"".to_owned(),
                false => String::new(),
            };
            // A bar beside the name of a family: its wrong pixels as a share of the most.
            let bar = match most_wrong {
                0 => String::new(),
                most => {
                    format!(" style=\"--share: {:.1}%\"", 100.0 * row.wrong as f64 / most as f64)
                }
            };
            let _ = match (i, &row.search) {
                (0, Some(search)) => write!(
                    out,
                    "<th scope=\"row\"{bar}><button type=\"button\" class=\"find\" data-search=\"{}\">{text}</button></th>",
                    escape(search)
                ),
                (0, None) if text.is_empty() => write!(out, "<td></td>"),
                (0, None) => write!(out, "<th scope=\"row\">{text}</th>"),
                _ => write!(out, "<td{number}>{}</td>", text.replace('\n', "<br>")),
            };
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
    if !is_folded && table.rows.len() > MOST_ROWS {
        let count = table.rows.len();
        let _ = writeln!(
            out,
            "<label class=\"unfold\"><input type=\"checkbox\"> show all {count} rows</label>"
        );
    }
    if left_out > 0 {
        let _ = writeln!(out, "<p>{left_out} more rows are left out.</p>");
    }
    out
}

/// A plot with its caption, in the version for the width of the page.
fn figure(figure: &Figure) -> String {
    let caption = escape(&figure.caption);
    let address = |svg: &str| data_address("image/svg+xml", svg.as_bytes());
    // The page chooses by its width.
    let others = figure
        .others
        .iter()
        .map(|(media, svg)| format!("<source media=\"{media}\" srcset=\"{}\">", address(svg)));
    let others: String = others.collect();
    format!(
        "<figure class=\"plot\"><button type=\"button\" class=\"enlarge\" title=\"as large as the window, and back\">\
         <picture>{others}<img src=\"{}\" alt=\"{caption}\"></picture></button>\
         <figcaption>{caption}</figcaption></figure>\n",
        address(&figure.svg)
    )
}

/// The lines that differ, or a sentence where they are not found before the deadline.
fn text_diff(diff: &TextDiff, deadline: Instant) -> String {
    let old = diff.old.as_deref().unwrap_or("");
    let mut out = format!(
        "<article class=\"diff\" id=\"text-{0}\"><h3>{0}</h3><p>{1}</p>\n{2}",
        escape(&diff.name),
        escape(&diff.about),
        command(&diff.command)
    );
    // The search for the fewest changes stops at the deadline.
    let lines = Lines::configure().deadline(deadline).diff_lines(old, &diff.new);
    if Instant::now() > deadline {
        // Without the changes, at least how long the texts are.
        let [before, after] = [old, &diff.new].map(|text| text.lines().count());
        let _ = writeln!(
            out,
            "<p>The two texts, of {before} and of {after} lines, are too different to show line by line. \
             Compare the two files with another program.</p></article>"
        );
        return out;
    }
    let _ = writeln!(
        out,
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"lines of {0}\"><table>\
         <thead><tr><th scope=\"col\">old</th><th scope=\"col\">new</th><th scope=\"col\">change</th>\
         <th scope=\"col\">line</th></tr></thead>",
        escape(&diff.name)
    );
    for group in lines.grouped_ops(CONTEXT) {
        out.push_str("<tbody>\n");
        for change in group.iter().flat_map(|op| lines.iter_changes(op)) {
            let (class, word, sign) = match change.tag() {
                ChangeTag::Delete => ("removed", "removed", '-'),
                ChangeTag::Insert => ("added", "added", '+'),
                ChangeTag::Equal => ("", "same", ' '),
            };
            let number =
                |index: Option<usize>| index.map_or(String::new(), |i| (i + 1).to_string());
            let _ = writeln!(
                out,
                "<tr class=\"{class}\"><td>{}</td><td>{}</td><td aria-label=\"{word}\">{sign}</td><td><pre>{}</pre></td></tr>",
                number(change.old_index()),
                number(change.new_index()),
                escape(change.value().trim_end_matches(['\n', '\r']))
            );
        }
        out.push_str("</tbody>\n");
    }
    out.push_str("</table></div></article>\n");
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Row;

    /// Found line by line, the differences of these take minutes.
    #[test]
    fn texts_too_different_are_not_compared_to_the_end() {
        let text = |a: u32| (0..50_000u32).map(|i| format!("{}\n", (i * a) % 9973)).collect();
        let diff = TextDiff { old: Some(text(7)), new: text(11), ..TextDiff::default() };
        let begin = Instant::now();
        let page = page(&Report { diffs: vec![diff; 20], ..Report::default() });
        assert!(page.contains("of 50000 and of 50000 lines, are too different to show"), "{page}");
        // Twenty texts share two seconds; to prepare each takes some more.
        assert!(begin.elapsed() < std::time::Duration::from_secs(30), "{:?}", begin.elapsed());
    }

    #[test]
    fn pictures_that_do_not_fit_are_left_out_and_named() {
        // Noise does not compress: 600 x 600 px are more than a megabyte.
        let mut state: u32 = 1;
        let noise = RgbImage::from_fn(600, 600, |_, _| {
            Rgb([0, 1, 2].map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8
            }))
        });
        let small = RgbImage::from_pixel(7, 5, Rgb([10, 20, 30]));
        let view = |name: &str, picture: &RgbImage| PictureView {
            name: name.to_owned(),
            layers: vec![PictureLayer::new("noise", picture)],
            ..PictureView::default()
        };
        let frames = vec![view("first", &noise), view("second", &noise), view("small", &small)];
        let text = page(&Report { frames, ..Report::default() });
        assert!(text.len() < PAGE_BYTES, "{} bytes", text.len());
        assert!(text.contains("bytes: second (") && !text.contains("\"name\":\"second\""));
        assert!(text.contains("\"name\":\"first\"") && text.contains("\"name\":\"small\""));
    }

    #[test]
    fn a_page_stays_small_whatever_it_lists() {
        let rows = (0..20_000).map(|i| Row::of(&[&i, &"x".repeat(200)]));
        let tables = vec![Table::new("many", "a | b", rows.collect())];
        let diff = |i: usize| {
            let (name, new) = (format!("text {i}"), "x\n".repeat(100));
            TextDiff { name, new, ..TextDiff::default() }
        };
        let diffs = (0..20_000).map(diff).collect();
        let page = page(&Report { tables, diffs, ..Report::default() });
        assert!(page.len() < limits::PAGE_BYTES, "{}", page.len());
        assert!(page.contains(" more rows are left out") && page.contains(" more.</p>"), "{page}");
    }
}
