//! Code that pages print is the code of the source file that they name.
//!
//! A page prints a function between two lines that no reader sees:
//!
//! ```text
//! <!-- code crates/core/src/raster/scanline.rs fn walk -->
//! <!--/code-->
//! ```
//!
//! What follows the path is the beginning of the item's line in the file: `fn walk`, `pub enum Effect`, or
//! `impl EdgeWalk > fn step` for an item inside another one. Several items stand with commas between them. A path alone prints
//! the whole file. Of code in Python and C++ a page has only links to the lines; the site shows these lines in tabs beside the
//! Rust code. `RASTERPROOF_RENEW=1 cargo test --test it printed_code` writes the code and the links into the pages.

use std::fs;
use std::ops::Range;

use crate::pages::{Renewal, files, read, root};

const BEGIN: &str = "<!-- code ";
const END: &str = "<!--/code-->";

/// The lines of an item, without the comments and attributes before it. It ends with the first line that closes it at its own
/// indentation; where nothing closes an item, as in Python, before the next line there.
fn item(lines: &[&str], name: &str, is_closed: bool) -> Option<Range<usize>> {
    let begins = |line: &&str| {
        let line = line.trim_start();
        let line = ["pub(crate) ", "pub(super) ", "pub "]
            .iter()
            .fold(line, |line, word| line.strip_prefix(word).unwrap_or(line));
        line.strip_prefix(name.trim_start_matches("pub "))
            .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    let first = lines.iter().position(begins)?;
    let indent = indentation(lines[first]);
    let is_there = |line: &&str| !line.trim().is_empty() && indentation(line) == indent;
    let is_last = |line: &&str| {
        let end = line.get(indent..).unwrap_or("");
        is_there(line)
            && (end.starts_with('}')
                || end.ends_with('}')
                || end.starts_with(']')
                || end.ends_with(';'))
    };
    let count = if is_closed {
        lines[first..].iter().position(is_last)? + 1
    } else {
        let after = lines[first + 1..].iter().position(is_there);
        let end = after.map_or(lines.len(), |at| first + 1 + at);
        lines[first..end].iter().rposition(|line| !line.trim().is_empty())? + 1
    };
    Some(first..first + count)
}

fn indentation(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The items that a mark names, each by the last word of its name and by its lines.
fn items<'a>(
    names: &'a str,
    lines: &[&str],
    is_closed: bool,
) -> Result<Vec<(&'a str, Range<usize>)>, String> {
    let find = |names: &'a str| {
        let mut found = 0..lines.len();
        // The names of an item, each inside the one before.
        for name in names.split(" > ") {
            let inside = item(&lines[found.clone()], name, is_closed)
                .ok_or_else(|| format!("no line begins with '{name}'"))?;
            found = found.start + inside.start..found.start + inside.end;
        }
        Ok((names.rsplit(' ').next().unwrap_or(names), found))
    };
    names.split(", ").map(find).collect()
}

/// The path of a file as a page in a folder names it.
fn relative(folder: &str, file: &str) -> String {
    let (from, to): (Vec<_>, Vec<_>) = (folder.split('/').collect(), file.split('/').collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    "../".repeat(from.len() - shared) + &to[shared..].join("/")
}

/// What a mark asks for in a page of a folder: the code, with an empty line between items, or the links to their lines.
fn printed(mark: &str, folder: &str) -> Result<String, String> {
    let (path, names) = mark.split_once(' ').map_or((mark, None), |(path, n)| (path, Some(n)));
    let source = fs::read_to_string(root().join(path)).map_err(|error| error.to_string())?;
    let lines: Vec<_> = source.trim_end().lines().collect();
    let language = match path.rsplit('.').next() {
        Some("py") => Some("Python"),
        Some("cpp") => Some("C++"),
        _ => None,
    };
    let items = match names {
        Some(names) => items(names, &lines, language != Some("Python"))?,
        None => vec![(path, 0..lines.len())],
    };
    let Some(language) = language else {
        let code = items.into_iter().map(|(_, range)| {
            let indent = indentation(lines[range.start]);
            let moved = lines[range].iter().map(|line| line.get(indent..).unwrap_or(""));
            moved.collect::<Vec<_>>().join("\n")
        });
        return Ok(format!("```rust,ignore\n{}\n```", code.collect::<Vec<_>>().join("\n\n")));
    };
    let file = relative(folder, path);
    let link = |(name, lines): (&str, Range<usize>)| {
        format!("[{name}]({file}#L{}-L{})", lines.start + 1, lines.end)
    };
    Ok(format!("{language}: {}", items.into_iter().map(link).collect::<Vec<_>>().join(", ")))
}

/// A page with what its marks ask for.
fn renewed(page: &str, folder: &str) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (mark, after) = after.split_once(" -->").ok_or("a mark is not closed")?;
        let (old, after) = after.split_once(END).ok_or(format!("{mark}: no end of code"))?;
        if old.contains(BEGIN) {
            return Err(format!("{mark}: another code begins before its end"));
        }
        let printed = printed(mark, folder).map_err(|cause| format!("{mark}: {cause}"))?;
        out += &format!("{before}{BEGIN}{mark} -->\n\n{printed}\n\n{END}");
        rest = after;
    }
    if rest.contains(END) {
        return Err("an end of code has no beginning".to_owned());
    }
    Ok(out + rest)
}

#[test]
fn printed_code_is_that_of_the_source() {
    let mut renewal = Renewal::default();
    for path in files(&root().join("docs"), ".md") {
        let cause = |cause| panic!("{}: {cause}", path.display());
        let folder = path.parent().unwrap().strip_prefix(root()).unwrap().to_str().unwrap();
        renewal.is(&path, &renewed(&read(&path), folder).unwrap_or_else(cause));
    }
    renewal.check("printed_code");
}

#[test]
fn printed_code_that_is_stale_or_unknown_is_found() {
    let mark = "crates/core/src/raster/scanline.rs impl EdgeWalk > fn step";
    let page = renewed(&format!("a\n{BEGIN}{mark} -->\n{END}\nb"), "docs").unwrap();
    assert!(page.contains("```rust,ignore\nfn step(&mut self) {\n") && page.ends_with("\nb"));
    assert_eq!(renewed(&page, "docs").unwrap(), page);
    let both = renewed(&page.replace("fn step -->", "fn step, fn walk -->"), "docs").unwrap();
    assert!(both.contains("\n}\n\nfn walk"));
    let planted = page.replacen("self", "it", 1);
    assert_ne!(renewed(&planted, "docs").unwrap(), planted);
    for (wrong, cause) in [
        (page.replace("fn step -->", "fn stride -->"), "no line begins with 'fn stride'"),
        (page.replace("scanline.rs", "nowhere.rs"), "nowhere.rs"),
        (page.replace(END, ""), "no end of code"),
        (page.replace(BEGIN, "<!-- "), "no beginning"),
    ] {
        assert!(renewed(&wrong, "docs").unwrap_err().contains(cause), "{cause}");
    }
    // In other languages a page has links to the lines.
    let mark = "adapters/course/solution.py def edge, def owns";
    let page = renewed(&format!("{BEGIN}{mark} -->\n{END}"), "docs/zh").unwrap();
    let source = read("adapters/course/solution.py");
    let edge = source.lines().position(|line| line.starts_with("def edge(")).unwrap() + 1;
    let link =
        format!("Python: [edge](../../adapters/course/solution.py#L{edge}-L{}), [owns](", edge + 1);
    assert!(page.contains(&link), "{page}");
    let planted = page.replacen(&format!("#L{edge}-"), "#L1-", 1);
    assert_ne!(renewed(&planted, "docs/zh").unwrap(), planted);
}
