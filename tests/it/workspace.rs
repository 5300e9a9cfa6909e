//! The rules of the workspace: which crate may depend on which, what is independent of what, and that the pages name
//! what exists.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use rasterproof_faults::published::catalogue::CARDS;
use rasterproof_invariants::CATALOGUE;
use rasterproof_render::scene::chapters::SCENES;
use rasterproof_verify::{cases, partition};

use crate::pages::{files, read, root};
use crate::program::{Run, check, table};
use crate::protocol::ask;

pub(crate) fn source_folders() -> Vec<String> {
    let crates = fs::read_dir(root().join("crates")).unwrap();
    let mut folders: Vec<_> = crates
        .map(|entry| format!("crates/{}/src", entry.unwrap().file_name().to_str().unwrap()))
        .collect();
    folders.push("src".to_owned());
    folders.sort();
    folders
}

fn cargo(arguments: &[&str]) -> Run {
    Run::of(Command::new(env!("CARGO")).args(arguments).current_dir(root())).has(0)
}

/// The packages of the workspace as cargo describes them.
fn packages() -> Vec<serde_json::Value> {
    let mut data = cargo(&["metadata", "--locked", "--no-deps", "--format-version", "1"]).json();
    serde_json::from_value(data["packages"].take()).unwrap()
}

/// The names of what a package is built with, tests left out.
fn normal_dependencies(package: &serde_json::Value) -> impl Iterator<Item = &str> {
    let all = package["dependencies"].as_array().unwrap().iter();
    let normal = all.filter(|dependency| dependency["kind"].is_null());
    normal.map(|dependency| dependency["name"].as_str().unwrap())
}

/// Each crate with the crates of the workspace that its manifest names as dependencies.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let short = |name: &str| name.strip_prefix("rasterproof-").map(str::to_owned);
    let of_package = |package: &serde_json::Value| {
        let name = short(package["name"].as_str().unwrap())?;
        Some((name, normal_dependencies(package).filter_map(short).collect()))
    };
    packages().iter().filter_map(of_package).collect()
}

/// A registry shows these of a package, and its licence has to be within it.
#[test]
fn what_is_published_carries_its_description_and_licence() {
    for package in packages() {
        let name = package["name"].as_str().unwrap();
        if !["rasterproof-core", "rasterproof-oracle", "rasterproof-verify"].contains(&name) {
            continue;
        }
        for what in ["keywords", "categories"] {
            let count = package[what].as_array().unwrap().len();
            assert!((1..=5).contains(&count), "{name} has {count} {what}");
        }
        let folder = Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap();
        let readme = fs::read_to_string(folder.join(package["readme"].as_str().unwrap())).unwrap();
        assert!(readme.starts_with(&format!("# {name}\n")), "{readme}");
        has_licences(folder);
        // With it, glam brings a crate more than `judge.md` counts: it is asked for where values are written.
        let glam = package["dependencies"].as_array().unwrap().iter();
        let glam = glam.filter(|dependency| dependency["name"] == "glam");
        assert!(glam.flat_map(|d| d["features"].as_array()).flatten().all(|f| f != "serde"));
    }
    let python = read("adapters/python/pyproject.toml");
    for word in ["description", "readme", "license", "license-files", "keywords", "classifiers"] {
        assert!(python.contains(&format!("\n{word} = ")), "the wheel has no {word}");
    }
    has_licences(&root().join("adapters/python"));
}

fn has_licences(folder: &Path) {
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        // A link, which packing follows, or the same text.
        assert_eq!(fs::read_to_string(folder.join(name)).ok(), Some(read(name)), "{folder:?}");
    }
}

#[test]
fn the_table_of_crates_is_cargos() {
    let dependencies = dependencies();
    assert!(dependencies.len() > 10, "{dependencies:?}");
    for page in ["docs/ARCHITECTURE.md", "docs/zh/ARCHITECTURE.md"] {
        let text = read(page);
        let stated: BTreeMap<String, BTreeSet<String>> = rows(&text)
            .filter(|row| row.len() == 3 && row[0].starts_with("[`crates/"))
            .map(|row| {
                let name = row[0].split(['/', '`']).nth(2).unwrap().to_owned();
                (name, quoted(row[2]).map(str::to_owned).collect())
            })
            .collect();
        assert_eq!(stated, dependencies, "{page}");
    }
}

/// A dependency that nobody calls is compiled all the same, and makes crates wait for each other.
#[test]
fn what_a_crate_depends_on_is_called() {
    let mut looked_at = 0;
    for package in packages() {
        let manifest = Path::new(package["manifest_path"].as_str().unwrap());
        let source = manifest.with_file_name("src");
        let folder = if source.is_dir() { &source } else { manifest.parent().unwrap() };
        let sources = files(folder, ".rs");
        let code: String = sources.iter().map(read).collect();
        for dependency in normal_dependencies(&package) {
            let module = match dependency {
                // It bounds the version that the decoder of TIFF takes.
                "half" => continue,
                "meshopt-pure" => "meshoptimizer".to_owned(),
                name => name.replace('-', "_"),
            };
            looked_at += 1;
            assert!(names_module(&code, &module), "{}: {module}", manifest.display());
        }
    }
    assert!(looked_at > 100, "{looked_at}");
}

#[test]
fn what_is_compared_is_independent() {
    let rules = table::<2>("independent");
    let mut looked_at = 0;
    for path in source_folders().iter().flat_map(|folder| files(&root().join(folder), ".rs")) {
        let name = path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/");
        let text = read(&path);
        for [_, others] in rules.iter().filter(|[beginning, _]| name.starts_with(beginning)) {
            looked_at += 1;
            let named = others.split(' ').find(|other| names_module(without_tests(&text), other));
            assert_eq!(named, None, "{name}");
        }
    }
    assert!(looked_at > 15, "{looked_at} files");
    let exact = root().join("crates/core/src/raster/edge_function_exact.rs");
    assert!(names_module(&read(exact), "orient2d"));
    assert!(names_module("use super::dda::Dda;", "dda"));
    assert!(names_module("use crate::line::{bresenham, dda};", "dda"));
    assert!(!names_module("// like dda::Dda\nlet dda_like = 1;", "dda"));
}

/// A file without its unit tests, which may compare with what the file itself must not use.
pub(crate) fn without_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests").next().unwrap_or("")
}

/// Whether code, comments left out, has the name of a module as a word of its own.
fn names_module(text: &str, module: &str) -> bool {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let mut words = code.flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '_')));
    words.any(|word| word == module)
}

/// Crates with their features, as the program (`no-dev`) or the tests (`all`) ask for them.
fn features(edges: &str) -> BTreeSet<String> {
    let text =
        cargo(&["tree", "--locked", "--prefix", "none", "--format", "{p}|{f}", "--edges", edges])
            .out;
    text.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect()
}

/// Where the tests ask more of a crate than the program does, all that depends on it is compiled twice.
/// Below `effects`, an effect of single fragments is named by its row in the table, its condition and the kernel, and at most by two
/// files more.
#[test]
fn an_effect_is_named_in_few_files() {
    let folder = root().join("crates/render/src/effects");
    let texts: Vec<_> = files(&folder, ".rs").iter().map(read).collect();
    assert!(texts.len() > 30, "{} files", texts.len());
    for effect in ["emission", "occlusion", "reflection", "punctual"] {
        let code = |text: &&String| {
            let mut lines =
                without_tests(text).lines().filter(|line| !line.trim_start().starts_with("//"));
            lines.any(|line| line.to_lowercase().contains(effect))
        };
        let naming = texts.iter().filter(code).count();
        assert!((3..=5).contains(&naming), "{naming} files name {effect}");
    }
}

/// What every judge has, by its name.
const OF_EVERY_JUDGE: [&str; 12] = [
    "Failure",
    "Finding",
    "Report",
    "FamilyReport",
    "Verdict",
    "Options",
    "Check",
    "Answer",
    "Subject",
    "Question",
    "Expectation",
    "Standing",
];

/// The definitions of a type in a text, a second one under a longer name among them.
fn definitions(text: &str, name: &str) -> usize {
    let is_one = |line: &str| {
        let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        let defined = words.windows(2).find(|two| ["struct", "enum", "trait"].contains(&two[0]));
        defined.is_some_and(|two| two[1] == name || two[1] == format!("Exact{name}"))
    };
    let named = text.lines().filter(|line| line.contains(name));
    named.filter(|line| !line.trim_start().starts_with("//")).filter(|line| is_one(line)).count()
}

#[test]
fn what_every_judge_has_is_defined_once() {
    assert_eq!(
        definitions("pub struct Failure<C> {\n// struct Failure\nstruct Failures;", "Failure"),
        1
    );
    assert_eq!(definitions("enum ExactFinding {}\n    pub(super) trait Finding {", "Finding"), 2);
    let folders = source_folders();
    let texts = folders.iter().flat_map(|f| files(&root().join(f), "rs"));
    let texts: Vec<_> = texts.map(|file| (fs::read_to_string(&file).unwrap(), file)).collect();
    for name in OF_EVERY_JUDGE {
        let found = texts.iter().filter_map(|(text, file)| {
            let count = definitions(text, name);
            (count > 0).then(|| format!("{} ({count})", file.display()))
        });
        let found: Vec<_> = found.collect();
        assert!(found.len() == 1 && found[0].ends_with("(1)"), "{name}: {found:#?}");
    }
}

/// Participles that do not end in -ed. What is a noun or a direction as well (Bound, Cut, Left, Read, Round, Set) may name a
/// thing, and is left out.
const IRREGULAR: &str = "Begun Bent Broken Built Caught Chosen Done Drawn Driven Fallen Felt Forgotten Found Given \
    Gone Grown Heard Held Hidden Kept Known Laid Lent Lit Lost Made Meant Met Paid Proven Said \
    Seen Sent Shown Spent Spoken Stuck Taken Thrown Told Torn Woken Worn Written";

/// Whether a name is a participle and nothing else. Names of several words are not; nor are Need and Seed.
fn is_participle(name: &str) -> bool {
    let is_single = name.starts_with(char::is_uppercase)
        && name.chars().skip(1).all(|c| c.is_ascii_lowercase());
    let is_regular = name.ends_with("ed") && !name.ends_with("eed");
    is_single && (is_regular || IRREGULAR.split(' ').any(|word| word == name))
}

/// The names that a line of code defines as types and traits, or imports them by.
fn named_types(line: &str) -> Vec<&str> {
    if line.trim_start().starts_with("//") {
        return Vec::new();
    }
    let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let is_one =
        |two: &&[&str]| ["struct", "enum", "union", "trait", "type", "as"].contains(&two[0]);
    words.windows(2).filter(is_one).map(|two| two[1]).collect()
}

/// A participle says what happened to a thing and not what it is; of two with the same name, nobody knows which is meant.
#[test]
fn names_of_types_are_clear() {
    assert!(["Drawn", "Judged", "Kept"].iter().all(|name| is_participle(name)));
    assert!(!["DrawnTriangle", "Need", "Bound", "red"].iter().any(|name| is_participle(name)));
    assert_eq!(named_types("    pub(super) struct Cell<'a> {"), ["Cell"]);
    assert_eq!(named_types("use crate::{Shape as Cell, Size as Area};"), ["Cell", "Area"]);
    assert!(named_types("/// A struct Cell").is_empty());

    let folders = source_folders();
    let folders = folders.iter().map(String::as_str).chain(["tests", "benches"]);
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in folders.flat_map(|folder| files(&root().join(folder), ".rs")) {
        let text = fs::read_to_string(&file).unwrap();
        for (number, line) in (1..).zip(text.lines()) {
            for name in named_types(line) {
                let place = format!("{}:{number}", file.display());
                places.entry(name.to_owned()).or_default().push(place);
            }
        }
    }
    assert!(places.len() > 1000, "{} names", places.len());
    let is_unclear = |name: &str| is_participle(name) || name == "Convention";
    places.retain(|name, places| is_unclear(name) && places.len() > 1);
    assert!(places.is_empty(), "say what each of these is, by a noun: {places:#?}");
}

#[test]
fn everything_is_compiled_once() {
    let (program, tests) = (features("no-dev"), features("all"));
    assert!(program.len() > 50 && tests.len() > program.len());
    let twice: Vec<_> = program.difference(&tests).collect();
    assert!(twice.is_empty(), "{twice:?}: state the features in Cargo.toml, as for clap");
}

/// Plain `cargo test` compiles neither the samples nor the unit tests of crates whose manifest says so: the samples because there
/// are none, the unit tests because `cargo test --lib` runs them.
#[test]
fn samples_of_every_crate_are_run() {
    let mut without = 0;
    for folder in fs::read_dir(root().join("crates")).unwrap() {
        let folder = folder.unwrap().path();
        let manifest = read(folder.join("Cargo.toml"));
        if !manifest.contains("\ndoctest = false\n") {
            continue;
        }
        without += 1;
        for path in files(&folder.join("src"), ".rs") {
            let text = read(&path);
            assert!(!has_sample(&text), "{}: delete `doctest = false`", path.display());
        }
    }
    assert!(without > 10, "{without} crates");
    assert!(has_sample("    /// ```\n") && has_sample("//! ```should_panic\n"));
    assert!(!has_sample("/// `a`\n") && !has_sample("let a = \"```\";\n"));
}

/// Whether a comment that becomes documentation has a block of code.
fn has_sample(text: &str) -> bool {
    let comments = text.lines().filter_map(|line| line.trim_start().strip_prefix("//"));
    let mut documentation = comments.filter_map(|line| line.strip_prefix(['/', '!']));
    documentation.any(|line| line.trim_start().starts_with("```"))
}

/// The pages under `docs/` and those beside the README, with their text.
pub fn pages() -> Vec<(PathBuf, String)> {
    let mut pages = files(&root().join("docs"), ".md");
    pages.extend(["README.md", "CHANGELOG.md", "CONTRIBUTING.md"].map(|name| root().join(name)));
    pages.into_iter().map(|page| (page.clone(), read(page))).collect()
}

/// The anchor that GitHub gives a heading: small letters, hyphens for spaces, no punctuation.
pub fn anchor(heading: &str) -> String {
    let small = heading.to_lowercase();
    let kept = small.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The anchors that GitHub gives the headings of a page.
pub fn anchors(text: &str) -> Vec<String> {
    let mut anchors: Vec<String> = Vec::new();
    for heading in text.lines().filter_map(|line| line.strip_prefix('#')) {
        let anchor = anchor(heading.trim_start_matches('#').trim());
        // A heading that stands twice is told apart by a number.
        let before = anchors.iter().filter(|a| **a == anchor).count();
        let numbered = (1..).map(|n| format!("{anchor}-{n}")).find(|a| !anchors.contains(a));
        anchors.push(if before == 0 { anchor } else { numbered.unwrap_or_default() });
    }
    anchors
}

/// Whether a reader of a fresh checkout has this file. One that is only made by a command, or was
/// never added to the repository, may be here and nowhere else.
fn is_kept(target: &Path) -> bool {
    static FILES: std::sync::LazyLock<Option<BTreeSet<PathBuf>>> = std::sync::LazyLock::new(|| {
        let listed = ["ls-files", "-z", "--cached"];
        let output = std::process::Command::new("git").args(listed).current_dir(root()).output();
        let output = output.ok().filter(|output| output.status.success())?;
        let text = String::from_utf8(output.stdout).ok()?;
        let files = text.split_terminator('\0').map(|file| root().join(file).canonicalize());
        Some(files.filter_map(Result::ok).collect())
    });
    let Ok(target) = target.canonicalize() else { return false };
    // Outside a checkout, such as in a package, the folder of what is made is all that is known.
    FILES.as_ref().map_or(!target.starts_with(root().join("target")), |files| {
        files.contains(&target) || target.is_dir() && files.iter().any(|f| f.starts_with(&target))
    })
}

/// Whether an anchor is no heading but a state of what the page is about: `playground.md#scene=line` opens a scene in the site,
/// and on a forge the page that says how to open it.
fn is_state(file: &str, anchor: &str) -> bool {
    ["playground.md", "report.md"].iter().any(|name| file.ends_with(name)) && anchor.contains('=')
}

/// Whether an anchor names lines that a file of code has, as a forge shows them: `L3-L9`.
fn are_lines(file: &Path, anchor: &str) -> bool {
    let number = |text: &str| text.strip_prefix('L')?.parse::<usize>().ok();
    let lines = anchor.split_once('-').and_then(|(a, b)| Some(number(a)?..=number(b)?));
    lines.is_some_and(|lines| {
        !lines.is_empty() && *lines.start() > 0 && *lines.end() <= read(file).lines().count()
    })
}

/// Links that lead nowhere: to a missing file, one that is not kept, a missing heading of a page, or missing lines of code.
fn broken_links(page: &Path, text: &str) -> Vec<String> {
    let mut broken = Vec::new();
    // What stands between fences is code.
    let text: String = text.split("```").step_by(2).collect();
    for (at, _) in text.match_indices("](") {
        let link = text[at + 2..].split([')', ' ']).next().unwrap_or("");
        if link.contains("://") {
            continue;
        }
        let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
        let target =
            if file.is_empty() { page.to_owned() } else { page.parent().unwrap().join(file) };
        let exists = target.exists() && is_kept(&target);
        let is_page = target.extension().is_some_and(|ending| ending == "md");
        let found = || match is_page {
            true => anchors(&read(&target)).iter().any(|a| a == anchor),
            false => are_lines(&target, anchor),
        };
        if !exists || !anchor.is_empty() && !is_state(file, anchor) && !found() {
            broken.push(format!("{}: {link}", page.display()));
        }
    }
    broken
}

#[test]
fn links_lead_somewhere() {
    let broken: Vec<_> = pages().iter().flat_map(|(page, text)| broken_links(page, text)).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    let page = root().join("docs/index.md");
    let text =
        "[a](ch01.md#the-formula) [b](ch99.md) [c](ch01.md#no=where) [d](playground.md#scene=line)";
    assert_eq!(broken_links(&page, text).len(), 2);
    let lines = "[a](../src/lib.rs#L1-L2) [b](../src/lib.rs#L2-L1) [c](../src/lib.rs#L1-L99999)";
    assert_eq!(broken_links(&page, lines).len(), 2);
    // It is there, as this test runs from it, but a fresh checkout does not have it.
    let made = "[a](../target) [b](../src/lib.rs) [c](../src)";
    assert_eq!(broken_links(&page, made).len(), 1);
}

fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.lines().flat_map(|line| line.split('`').skip(1).step_by(2))
}

fn section<'a>(text: &'a str, heading: &str) -> &'a str {
    let Some(at) = text.find(&format!("## {heading}\n")) else { return "" };
    let rest = &text[at + 3..];
    &rest[..rest.find("\n## ").unwrap_or(rest.len())]
}

/// Cells of the rows of the tables of a text.
fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let rows = text.lines().filter(|line| line.starts_with("| "));
    rows.map(|line| line.split(" | ").map(|cell| cell.trim_matches(['|', ' '])).collect())
}

fn is_snake(word: &str) -> bool {
    word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        && word.starts_with(|c: char| c.is_ascii_lowercase())
}

/// Words that a page's commands give after an option.
fn options<'a>(text: &'a str, option: &'a str) -> impl Iterator<Item = &'a str> {
    let ends = [' ', '`', '\n', ')', '|'];
    text.match_indices(option)
        .map(move |(at, _)| text[at + option.len()..].split(ends).next().unwrap_or(""))
}

struct NamesInPages {
    /// The functions of the crates, of `tests/` and of `benches/`.
    functions: BTreeSet<String>,
    invariants: Vec<&'static str>,
    /// Options of commands, with the names they take.
    options: [(&'static str, Vec<&'static str>); 4],
}

fn functions(path: &Path) -> Vec<String> {
    let text = read(path);
    let names = text.split("fn ").skip(1).filter_map(|rest| rest.split('(').next());
    names.map(str::to_owned).collect()
}

impl NamesInPages {
    fn new() -> Self {
        let beside = ["tests", "benches", "crates/vulkan/tests"].map(str::to_owned);
        let folders = source_folders().into_iter().chain(beside);
        let sources = folders.flat_map(|folder| files(&root().join(folder), ".rs"));
        let invariants: Vec<_> = CATALOGUE.iter().map(|invariant| invariant.name).collect();
        let polygons = partition::Family::ALL.into_iter().map(partition::Family::name);
        Self {
            functions: sources.flat_map(|path| functions(&path)).collect(),
            options: [
                (
                    "--family ",
                    cases::families().map(|family| family.name).chain(polygons).collect(),
                ),
                ("--scene ", SCENES.iter().map(|scene| scene.name).collect()),
                ("--specimen ", CARDS.iter().map(|card| card.name).collect()),
                ("--invariant ", [invariants.clone(), vec!["all"]].concat()),
            ],
            invariants,
        }
    }

    /// Tests are functions, or invariants with underscores.
    fn is_test(&self, word: &str) -> bool {
        self.functions.contains(word) || self.invariants.contains(&word.replace('_', "-").as_str())
    }

    fn missing(&self, name: &str, text: &str) -> Vec<String> {
        let mut missing = Vec::new();
        for (option, names) in &self.options {
            let words = options(text, option).filter(|w| *w != "NAME" && !names.contains(w));
            missing.extend(words.map(|word| format!("{name}: {option}{word}")));
        }
        let folders = ["crates/", "src/", "tests/", "docs/", "snapshots/", "benches/", "adapters/"];
        let is_path =
            |w: &&str| folders.iter().any(|f| w.starts_with(f)) && !w.contains([' ', '*']);
        let paths = quoted(text).filter(is_path).filter(|word| !root().join(word).exists());
        missing.extend(paths.map(|word| format!("{name}: {word}")));
        let table: Vec<_> = match name {
            "docs/sections.md" => rows(text).filter(|row| row.len() == 4).collect(),
            _ => Vec::new(),
        };
        let tests: String = table.iter().map(|row| row[3]).collect();
        for part in [section(text, "The test that proves it"), &tests] {
            let words = quoted(part).filter(|word| is_snake(word) && !self.is_test(word));
            missing.extend(words.map(|word| format!("{name}: test {word}")));
        }
        let beside = rows(text).filter(|row| row.len() == 2).map(|row| (row[0], row[1]));
        let within = table.iter().map(|row| (row[2], row[2]));
        for (names, links) in beside.chain(within) {
            missing.extend(unknown_names(names, links).map(|word| format!("{name}: code {word}")));
        }
        missing
    }
}

/// Names of code in a cell that the files do not hold to which the cell beside it links.
fn unknown_names<'a>(names: &'a str, links: &str) -> impl Iterator<Item = &'a str> {
    let links = links.split("](").skip(1).filter_map(|part| part.split(')').next());
    let paths = links.filter(|link| link.ends_with(".rs"));
    let path = |link: &str| root().join(link.trim_start_matches("../"));
    let code: String = paths.filter_map(|link| fs::read_to_string(path(link)).ok()).collect();
    let is_name = |word: &&str| {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == ':';
        word.len() > 2 && word.chars().all(is_part) && !word.ends_with(':')
    };
    let is_there = {
        let words: BTreeSet<String> =
            code.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned).collect();
        move |name: &str| name.split("::").all(|part| words.contains(part))
    };
    quoted(names).filter(is_name).filter(move |name| !code.is_empty() && !is_there(name))
}

#[test]
fn docs_name_what_exists() {
    let known = NamesInPages::new();
    let name = |page: &Path| page.strip_prefix(root()).unwrap().display().to_string();
    let pages = pages();
    let missing = pages.iter().flat_map(|(page, text)| known.missing(&name(page), text));
    let missing: Vec<_> = missing.collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// Every file of tests says first what it is for, which the architecture page leaves to it.
#[test]
fn every_file_of_tests_says_what_it_tests() {
    for path in files(&root().join("tests/it"), ".rs") {
        let text = read(&path);
        assert!(
            text.starts_with("//! ") && text.lines().next().unwrap().len() > 40,
            "{}",
            path.display()
        );
    }
}

#[test]
fn missing_names_are_found() {
    let known = NamesInPages::new();
    let page = "`src/nowhere.rs` `crates/core/src/grid.rs` --scene moon --scene cube\n\
        ## The test that proves it\n- `proves_nothing`, `crop`, `snap_by_hand`\n";
    let missing = known.missing("docs/a.md", page);
    let names = ["--scene moon", "src/nowhere.rs", "test proves_nothing"];
    assert_eq!(missing, names.map(|name| format!("docs/a.md: {name}")));
    let table = "| what | where |\n|---|---|\n\
        | ties: `snap`, `snap_down`, `PixelRect::window` | [grid](../crates/core/src/grid.rs) |\n";
    assert_eq!(known.missing("docs/a.md", table), ["docs/a.md: code snap_down"]);
    let table = "| [1.1](ch01.md) | pixel | [grid](../crates/core/src/grid.rs): `snap_up` | `proves_nothing` |\n";
    let names = ["test proves_nothing", "code snap_up"];
    let missing = names.map(|name| format!("docs/sections.md: {name}"));
    assert_eq!(known.missing("docs/sections.md", table), missing);
}

#[test]
fn specimens_credit_their_source() {
    let of_all = ["mod.rs", "catalogue.rs", "scene.rs"];
    for path in files(&root().join("crates/faults/src/published"), ".rs") {
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = read(&path);
        assert!(of_all.contains(&name) || text.contains("\n//! Source: "), "{name}");
    }
}

/// Lines of a page's code that call the program by its bare name, which only an installed one has.
fn bare_commands(text: &str) -> usize {
    let calls = |line: &&str| line.trim_start().starts_with("rasterproof ");
    text.split("```")
        .skip(1)
        .step_by(2)
        .filter(|code| code.starts_with("sh\n"))
        .flat_map(str::lines)
        .filter(calls)
        .count()
}

/// Commands are written in one way: through cargo, or installed where the page says how.
#[test]
fn commands_are_written_in_one_way() {
    for (page, text) in pages() {
        let is_said = text.contains("cargo install --path .");
        assert!(is_said || bare_commands(&text) == 0, "{}", page.display());
    }
    assert_eq!(bare_commands("```sh\nrasterproof cost\ncargo run\n```\nrasterproof x\n"), 1);
}

/// Every section of the book has a row in the table, which leads to the page of its chapter; that
/// page names the section.
#[test]
fn table_has_every_section() {
    let page = read("docs/sections.md");
    let mut listed = Vec::new();
    for row in rows(&page).filter(|row| row[0] != "section") {
        assert_eq!(row.len(), 4, "{row:?}");
        let numbers = row[0].split(", ").filter_map(|cell| cell.strip_prefix('['));
        listed.extend(numbers.filter_map(|cell| cell.split_once("](")));
    }
    let chapters = table::<1>("sections").concat();
    let sections: Vec<&str> = chapters.iter().flat_map(|row| row.split(' ')).collect();
    for &section in &sections {
        let chapter = section.split('.').next().unwrap().parse::<u32>().unwrap();
        let link = listed.iter().find(|(listed, _)| *listed == section);
        let page = link.map(|(_, link)| link.trim_end_matches(')'));
        let page = page.unwrap_or_else(|| panic!("{section} is not in the table"));
        // A chapter may have several pages: ch02.md, ch02-scanline.md.
        assert!(page.starts_with(&format!("ch{chapter:02}")), "{section} leads to {page}");
        let text = read(format!("docs/{page}"));
        let mut words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        assert!(words.any(|word| word.trim_matches('.') == section), "{page} lacks {section}");
    }
    for (section, _) in &listed {
        assert!(sections.contains(section), "{section} is not in the book");
    }
}

/// The page names each invariant with its number, and `list` prints what it says and its tolerance.
#[test]
fn stability_lists_the_invariants() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let printed = words(&check("list", 0).out);
    let pages = ["docs/stability.md", "docs/zh/stability.md"].map(|path| words(&read(path)));
    for invariant in CATALOGUE {
        let [number, name, statement, tolerance] = [
            &invariant.number.to_string(),
            invariant.name,
            invariant.statement,
            invariant.tolerance,
        ];
        for page in &pages {
            assert!(page.contains(&format!("{number} `{name}`")), "{number} {name}");
        }
        let end = match tolerance {
            "0" => String::new(),
            _ => format!(" Tolerance: {tolerance}."),
        };
        let wanted = format!("{number} {name} {statement}{end} ");
        assert!(printed.contains(&wanted), "`list` lacks {wanted}");
    }
}

/// The conversation on the page of the protocol is what an engine says.
#[test]
fn protocol_is_spoken() {
    let text = read("docs/protocol.md");
    let lines = |sign: &str| -> Vec<String> {
        let spoken = section(&text, "A conversation").lines();
        spoken.filter_map(|line| line.strip_prefix(sign).map(str::to_owned)).collect()
    };
    let (requests, answers) = (lines("> "), lines("< "));
    assert!(requests.len() >= 5);
    assert_eq!(ask("scanline", (requests.join("\n") + "\n").as_bytes()), answers);
}
