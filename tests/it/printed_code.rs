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
//! `impl EdgeWalk > fn step` for an item inside another one. Several items stand with commas between them. A path alone prints the whole file. `RASTERPROOF_RENEW=1 cargo test --test it
//! printed_code` writes the code into the pages.

use std::fs;

use crate::pages::{Renewal, files, read, root};

const BEGIN: &str = "<!-- code ";
const END: &str = "<!--/code-->";

/// The lines of an item, without the comments and attributes before it, moved to the left margin. It ends
/// with the first line that closes it at its own indentation; where nothing closes an item, as in Python, before the next line there.
fn item(source: &str, name: &str, is_closed: bool) -> Option<String> {
    let begins = |line: &str| {
        let line = line.trim_start();
        let line = ["pub(crate) ", "pub(super) ", "pub "]
            .iter()
            .fold(line, |line, word| line.strip_prefix(word).unwrap_or(line));
        line.strip_prefix(name.trim_start_matches("pub "))
            .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    let lines: Vec<_> = source.lines().collect();
    let first = lines.iter().position(|line| begins(line))?;
    let indent = lines[first].len() - lines[first].trim_start().len();
    let is_there =
        |line: &&str| !line.trim().is_empty() && line.len() - line.trim_start().len() == indent;
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
    let moved = lines[first..first + count].iter().map(|line| line.get(indent..).unwrap_or(""));
    Some(moved.collect::<Vec<_>>().join("\n"))
}

/// The code that a mark asks for: a path, and items of its file, with an empty line between them.
fn code(mark: &str) -> Result<String, String> {
    let (path, items) = mark.split_once(' ').map_or((mark, None), |(path, n)| (path, Some(n)));
    let source = fs::read_to_string(root().join(path)).map_err(|error| error.to_string())?;
    let whole = source.trim_end().to_owned();
    let Some(items) = items else { return Ok(whole) };
    let is_closed = !path.ends_with(".py");
    // The names of an item, each inside the one before.
    let found = items.split(", ").map(|names| {
        names.split(" > ").try_fold(whole.clone(), |source, name| {
            item(&source, name, is_closed).ok_or_else(|| format!("no line begins with '{name}'"))
        })
    });
    Ok(found.collect::<Result<Vec<_>, _>>()?.join("\n\n"))
}

fn renewed(page: &str) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (mark, after) = after.split_once(" -->").ok_or("a mark is not closed")?;
        let (printed, after) = after.split_once(END).ok_or(format!("{mark}: no end of code"))?;
        if printed.contains(BEGIN) {
            return Err(format!("{mark}: another code begins before its end"));
        }
        let code = code(mark).map_err(|cause| format!("{mark}: {cause}"))?;
        let path = mark.split(' ').next().unwrap_or("");
        let language = match path.rsplit('.').next() {
            Some("py") => "python",
            Some("cpp") => "cpp",
            _ => "rust,ignore",
        };
        out += &format!("{before}{BEGIN}{mark} -->\n\n```{language}\n{code}\n```\n\n{END}");
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
        renewal.is(&path, &renewed(&read(&path)).unwrap_or_else(cause));
    }
    renewal.check("printed_code");
}

#[test]
fn printed_code_that_is_stale_or_unknown_is_found() {
    let mark = "crates/core/src/raster/scanline.rs impl EdgeWalk > fn step";
    let page = renewed(&format!("a\n{BEGIN}{mark} -->\n{END}\nb")).unwrap();
    assert!(page.contains("```rust,ignore\nfn step(&mut self) {\n") && page.ends_with("\nb"));
    assert_eq!(renewed(&page).unwrap(), page);
    let both = renewed(&page.replace("fn step -->", "fn step, fn walk -->")).unwrap();
    assert!(both.contains("\n}\n\nfn walk"));
    let planted = page.replacen("self", "it", 1);
    assert_ne!(renewed(&planted).unwrap(), planted);
    for (wrong, cause) in [
        (page.replace("fn step -->", "fn stride -->"), "no line begins with 'fn stride'"),
        (page.replace("scanline.rs", "nowhere.rs"), "nowhere.rs"),
        (page.replace(END, ""), "no end of code"),
        (page.replace(BEGIN, "<!-- "), "no beginning"),
    ] {
        assert!(renewed(&wrong).unwrap_err().contains(cause), "{cause}");
    }
}
