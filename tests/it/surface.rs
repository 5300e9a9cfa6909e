//! What a user of the crate may rely on: the modules and macros that the API documentation shows are those that
//! are stated, in `src/lib.rs` and in the table of `docs/ARCHITECTURE.md`, in both languages.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::pages::{files, read, root};

/// The modules that a file declares for everyone, those left out that documentation does not show.
fn shown(text: &str) -> Vec<String> {
    let mut hidden = false;
    let mut found = Vec::new();
    for line in on_one_line(text).lines() {
        let modules = line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';'));
        let names = modules.or_else(|| reexported(line)).unwrap_or("");
        if !hidden {
            let shown_as = |name: &str| name.rsplit(" as ").next().unwrap_or("").trim().to_owned();
            found.extend(names.split(',').map(shown_as));
            // A type of another crate, `random::Rng`, is part of the module that shows it.
            let is_type = |name: &str| {
                name.rsplit("::").next().is_some_and(|last| last.starts_with(char::is_uppercase))
            };
            found.retain(|name| !name.is_empty() && !is_type(name));
        }
        // An attribute speaks of what follows the attributes and comments below it.
        let goes_on = line.starts_with("#[") || line.starts_with("//");
        hidden = line.starts_with("#[doc(hidden)]") || hidden && goes_on;
    }
    found
}

fn on_one_line(text: &str) -> String {
    let mut is_open = false;
    let close = |c: char| {
        is_open = c == '{' || is_open && c != '}';
        if is_open && c == '\n' { ' ' } else { c }
    };
    text.chars().map(close).collect()
}

/// The modules of another crate that a line shows: `pub use rasterproof_core::{a, b};`.
fn reexported(line: &str) -> Option<&str> {
    let (_, names) = line.strip_prefix("pub use rasterproof_")?.split_once("::")?;
    Some(names.trim_end_matches(';').trim_start_matches('{').trim_end_matches('}').trim())
}

/// The file of a module, `a/mod.rs` or `a.rs`, in the crate that has it; none for a macro.
fn file(module: &str) -> Option<PathBuf> {
    if read("crates/verify/src/lib.rs").contains(&format!("macro_rules! {module} {{")) {
        return None;
    }
    // The root crate shows the comparison under the name that says what it is for.
    let module = match module.strip_prefix("verify") {
        Some(rest) => format!("comparison{rest}"),
        None => module.to_owned(),
    };
    // `oracle` is a whole crate, `oracle::values` a module of it.
    let path = module.replace("::", "/");
    let of_oracle = path.replacen("oracle", "crates/oracle/src", 1);
    let paths = [format!("crates/core/src/{path}"), format!("crates/verify/src/{path}"), of_oracle];
    let files =
        paths.iter().flat_map(|path| [".rs", "/mod.rs", "/lib.rs"].map(|end| path.clone() + end));
    let found = files.map(PathBuf::from).find(|file| root().join(file).exists());
    Some(found.unwrap_or_else(|| panic!("no module {module}")))
}

/// Every module that documentation shows, parts of hidden ones left out, as paths from the crate.
fn documented() -> BTreeSet<String> {
    let mut open = shown(&read("src/lib.rs"));
    let mut found = BTreeSet::new();
    while let Some(module) = open.pop() {
        let parts = file(&module).map_or(Vec::new(), |file| shown(&read(file)));
        open.extend(parts.into_iter().map(|part| format!("{module}::{part}")));
        found.insert(module);
    }
    found
}

/// The modules in the first cells of the table below a heading.
fn stated(page: &str, heading: &str) -> BTreeSet<String> {
    let at = page.find(heading).unwrap_or_else(|| panic!("no heading {heading}"));
    let section = page[at..].split("\n## ").next().unwrap_or("");
    let cells = section.lines().filter_map(|line| line.strip_prefix("| `")?.split(" | ").next());
    let modules = cells.flat_map(|cell| cell.split(", "));
    modules.map(|module| module.trim_matches('`').to_owned()).collect()
}

#[test]
fn surface_is_what_is_stated() {
    let documented = documented();
    let page = stated(&read("docs/ARCHITECTURE.md"), "## What a user may rely on\n");
    assert_eq!(documented, page, "docs/ARCHITECTURE.md");
    let zh = stated(&read("docs/zh/ARCHITECTURE.md"), "## 使用者可以依靠什么\n");
    assert_eq!(documented, zh, "docs/zh/ARCHITECTURE.md");
    // The front page lists the modules, not their parts.
    let front = read("src/lib.rs");
    let listed: BTreeSet<_> = front
        .lines()
        .filter_map(|line| line.strip_prefix("//! - [`")?.split("`]").next())
        .map(str::to_owned)
        .collect();
    let modules = documented.into_iter().filter(|module| !module.contains("::")).collect();
    assert_eq!(listed, modules, "src/lib.rs");
}

/// A module is hidden by its attribute alone, wherever that stands among others.
#[test]
fn surface_reads_attributes() {
    let text = "pub mod a;\n#[doc(hidden)]\npub mod b;\npub mod c;\nmod d;\n#[doc(hidden)]\n\
        #[cfg(test)]\n// why\npub mod e;\npub(crate) mod f;\n#[cfg(test)]\npub mod g;\n\
        pub use rasterproof_x::{\n    h, i,\n};\n#[doc(hidden)]\npub use rasterproof_x::j;\n\
        pub use rasterproof_x::{k as l};\npub use rasterproof_x::m::Type;\n";
    assert_eq!(shown(text), ["a", "c", "g", "h", "i", "l"]);
    let page =
        "## Rely\n\n| module | x |\n|---|---|\n| `a`, `a::b` | y |\n\n## Next\n| `c` | z |\n";
    assert_eq!(stated(page, "## Rely\n"), ["a", "a::b"].map(str::to_owned).into());
}

/// Whoever calls a library wants to match an error, so it is a type of its own and not a text.
#[test]
fn surface_has_no_text_for_an_error() {
    for path in ["core", "oracle", "verify"]
        .map(|name| files(&root().join("crates").join(name).join("src"), ".rs"))
        .concat()
    {
        assert!(!has_text_for_an_error(&read(&path)), "{}", path.display());
    }
    assert!(has_text_for_an_error("pub fn f(\n    x: u8,\n) -> Result<u8, String> {\n"));
    assert!(!has_text_for_an_error("fn f() -> Result<u8, String> {}\npub fn g() -> String {\n"));
}

/// Whether a public function of a file returns `Result<_, String>`.
fn has_text_for_an_error(text: &str) -> bool {
    let public = text.split("pub fn ").skip(1);
    public
        .filter_map(|function| function.split(['{', ';']).next())
        .any(|head| head.rsplit("->").next().is_some_and(|returned| returned.contains(", String>")))
}
