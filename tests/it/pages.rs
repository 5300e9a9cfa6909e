//! Figures of the pages and of their diagrams do not drift. Each lies between two comments, which a reader does not see:
//! `<!--n drifting-lines-->788<!--/n-->`. The name is one of `figures.rs`, or says which cell of a table it repeats:
//! `cost: Lines, ns, Bresenham, large`, or which number of a live figure, which then follows its grips: `weights.pa`. What the page prints must be the value, rounded to the digits that are printed.
//!
//! A comment in the words of a picture would be read out. There one comment behind the picture names the numbers of these
//! words in their order, and `-` those that are not computed: `![T6: 110 pixels](T6.png)<!--alt - t6-pixels-->`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use rasterproof_report::words::thousands;
use rasterproof_teaching::by_hand;

use crate::figures::{ALL, cost_cell};

/// The variable of the environment that lets tests write pages anew.
const RENEW: &str = "RASTERPROOF_RENEW";

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The files of a folder and of the folders in it whose names end so, in order.
pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.to_str().unwrap().ends_with(ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The files of the repository that are not what is computed for them, each of which is written anew where [`RENEW`] is set.
#[derive(Default)]
pub struct Renewal(Vec<String>);

impl Renewal {
    pub fn is(&mut self, path: impl AsRef<Path>, computed: &str) {
        let (shown, path) = (path.as_ref().display(), root().join(path.as_ref()));
        // A file that is not there is as stale as one that differs.
        if fs::read_to_string(&path).ok().as_deref() == Some(computed) {
            return;
        }
        if std::env::var_os(RENEW).is_some() {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, computed).unwrap();
        }
        self.0.push(shown.to_string());
    }

    /// Fails where something was stale, and names the test that writes it.
    pub fn check(self, test: &str) {
        let stale = self.0.join("\n");
        assert!(stale.is_empty(), "renew with `{RENEW}=1 cargo test --test it {test}`:\n{stale}");
    }
}

/// The block of text of a page in Markdown, between its fences.
pub fn text_block(page: &str) -> Range<usize> {
    let start = page.find("```text\n").expect("a block of text") + "```text\n".len();
    start..start + page[start..].find("```\n").expect("the end of a block")
}

pub fn page(folder: &str, name: &str) -> String {
    read(format!("{folder}/{name}.md"))
}

/// The names of the marked figures of a page and where they are, or what is wrong with a marker.
fn marked(text: &str) -> Result<Vec<(&str, Range<usize>)>, String> {
    const END: &str = "<!--/n-->";
    let mut found = Vec::new();
    for (at, _) in text.match_indices("<!--") {
        let comment = text[at + 4..].split("-->").next().unwrap_or("");
        let after = at + 4 + comment.len() + 3;
        if let Some(name) = comment.strip_prefix("n ") {
            let end = text[after..].find("<!--").map(|length| after + length);
            let end = end.filter(|&end| text[end..].starts_with(END));
            found.push((name, after..end.ok_or_else(|| format!("'{name}' is not closed"))?));
            let line = text[..at].rsplit('\n').next().unwrap_or("");
            if line.trim_matches([' ', '-', '*', '>']).is_empty() {
                return Err(format!("'{name}' begins a line, which is shown as it is then"));
            }
        } else if let Some(names) = comment.strip_prefix("alt ") {
            let from = text[..at].rfind("![").ok_or("no picture before 'alt'")?;
            let words = text[from..at].split("](").next().unwrap_or("");
            let names = names.split(' ').chain(std::iter::repeat("-"));
            let places = numbers(words).map(|place| from + place.start..from + place.end);
            found.extend(names.zip(places).filter(|(name, _)| *name != "-"));
        } else if !text[at..].starts_with(END)
            && !comment.starts_with(" code ")
            && comment != "/code"
        {
            return Err(format!("'<!--{comment}' is no marker"));
        }
    }
    let opened = found.iter().filter(|(_, place)| text[place.end..].starts_with(END)).count();
    if text.matches(END).count() != opened {
        return Err(format!("'{END}' closes nothing"));
    }
    Ok(found)
}

/// Where the unsigned numbers of a text are.
fn numbers(text: &str) -> impl Iterator<Item = Range<usize>> {
    let runs = text.split(|c: char| !(c.is_ascii_digit() || ".,".contains(c)));
    let runs = runs.map(|run| run.trim_matches(['.', ','])).filter(|run| !run.is_empty());
    runs.map(|run| {
        let start = run.as_ptr().addr() - text.as_ptr().addr();
        start..start + run.len()
    })
}

/// Digits after the point of a printed number, and its power of ten where it states one.
fn digits(printed: &str) -> (usize, Option<i32>) {
    let (digits, exponent) = printed.split_once('e').unwrap_or((printed, ""));
    let decimals = digits.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    (decimals, exponent.parse().ok())
}

/// Whether a printed number is `value` to the digits that are printed.
fn is_rounded(printed: &str, value: f64) -> bool {
    let Ok(number) = printed.replace(',', "").parse::<f64>() else { return false };
    let (decimals, exponent) = digits(printed);
    let unit = 10f64.powi(exponent.unwrap_or(0) - decimals as i32);
    // A value halfway may be rounded to either side; tables round once already.
    (number - value).abs() <= unit * 0.5 * (1.0 + 1e-9)
}

fn in_the_form_of(printed: &str, value: f64) -> String {
    let (decimals, exponent) = digits(printed);
    if exponent.is_some() {
        return format!("{value:.decimals$e}");
    }
    let plain = format!("{value:.decimals$}");
    if printed.starts_with('.') {
        return plain.trim_start_matches('0').to_owned();
    }
    let (sign, plain) = plain.strip_prefix('-').map_or(("", &*plain), |plain| ("-", plain));
    let whole = plain.find('.').unwrap_or(plain.len());
    let is_grouped = printed.contains(',') || whole > 4;
    let comma = |at: usize| is_grouped && at > 0 && at < whole && (whole - at).is_multiple_of(3);
    let digits = plain.char_indices();
    let digits = digits.flat_map(|(at, digit)| comma(at).then_some(',').into_iter().chain([digit]));
    sign.to_owned() + &digits.collect::<String>()
}

/// What a page must say where, and what it says instead; every name that it uses is added to `used`.
fn stale<'a>(
    text: &'a str,
    values: &BTreeMap<String, f64>,
    used: &mut BTreeSet<&'a str>,
) -> Result<Vec<(Range<usize>, String)>, String> {
    let mut wrong = Vec::new();
    for (name, place) in marked(text)? {
        let cell = || name.strip_prefix("cost: ").map(cost_cell);
        let value = values.get(name).copied().or_else(cell);
        let value = value.ok_or_else(|| format!("no figure is called '{name}'"))?;
        used.insert(name);
        if !is_rounded(&text[place.clone()], value) {
            let right = in_the_form_of(&text[place.clone()], value);
            wrong.push((place, right));
        }
    }
    Ok(wrong)
}

/// Figures are as they are computed, each is used, and both languages have the same. `RASTERPROOF_RENEW=1 cargo test
/// --test it pages_figures` writes them anew.
#[test]
fn pages_figures_are_computed() {
    let mut values = BTreeMap::new();
    for (name, compute) in ALL.iter().chain(by_hand::ALL) {
        match &compute()[..] {
            [value] => drop(values.insert((*name).to_owned(), *value)),
            all => values.extend((1..).zip(all).map(|(i, value)| (format!("{name}.{i}"), *value))),
        }
    }
    let (mut wrong, mut used) = (Vec::new(), BTreeSet::new());
    let own: Vec<_> = values.keys().cloned().collect();
    // The prose repeats some numbers of the live figures, where their grips begin.
    for figure in rasterproof_wasm::figures::ALL.iter() {
        let numbers = figure.numbers().unwrap().into_iter();
        values.extend(numbers.map(|(name, value)| (format!("{}.{name}", figure.name), value)));
    }
    let diagrams = files(&root().join("docs/figures"), ".svg");
    let diagrams = diagrams.into_iter().map(|path| (path.clone(), read(path)));
    let pages: BTreeMap<_, _> = crate::workspace::pages().into_iter().chain(diagrams).collect();
    for (path, text) in &pages {
        let shown = path.display();
        let mut right = text.clone();
        match stale(text, &values, &mut used) {
            Err(problem) => wrong.push(format!("{shown}: {problem}")),
            Ok(stale) => {
                for (place, value) in stale.into_iter().rev() {
                    wrong.push(format!("{shown}: '{}', computed {value}", &text[place.clone()]));
                    right.replace_range(place, &value);
                }
            }
        }
        if right != *text && std::env::var_os(RENEW).is_some() {
            fs::write(path, right).unwrap();
        }
        let chinese = path.with_file_name("zh").join(path.file_name().unwrap());
        if let Some(chinese) = pages.get(&chinese) {
            let names = |text| {
                let mut names: Vec<_> =
                    marked(text).ok()?.into_iter().map(|(name, _)| name).collect();
                names.sort_unstable();
                Some(names)
            };
            if names(text) != names(chinese) {
                wrong.push(format!("{shown} and its Chinese page mark different figures"));
            }
        }
    }
    let unused = own.iter().filter(|name| !used.contains(name.as_str()));
    wrong.extend(unused.map(|name| format!("no page has the figure '{name}'")));
    assert!(
        wrong.is_empty(),
        "renew with `{RENEW}=1 cargo test --test it pages_figures`:\n{}",
        wrong.join("\n")
    );
}

/// The rule can fail: a stale figure, an unknown name and a marker that is not whole are found, a rounded figure is not
/// stale.
#[test]
fn pages_stale_figures_are_found() {
    let values: BTreeMap<_, _> =
        [("a", 788.0), ("b", 0.1716), ("c", 1.14e-6), ("d", 11_863_282.0), ("e", -37_495.0)]
            .into_iter()
            .map(|(name, value)| (name.to_owned(), value))
            .collect();
    let check = |text: &str| {
        let stale = stale(text, &values, &mut BTreeSet::new())?;
        Ok::<_, String>(stale.into_iter().map(|(_, right)| right).collect::<Vec<_>>())
    };
    let page = "of <!--n a-->788<!--/n--> at <!--n b-->.17<!--/n-->, <!--n c-->1.1e-6<!--/n--> and <!--n a-->788<!--/n-->\n\
        ![T4: 4,225 of 11,863,282.](a.png)<!--alt - - d--> <!--n e-->-37495<!--/n-->";
    assert_eq!(check(page), Ok(vec![]));
    for (old, new, right) in [
        ("788", "789", "788"),
        ("788", "788.6", "788.0"),
        (".17", ".18", ".17"),
        (".17", "0.1758", "0.1716"),
        ("1.1e-6", "1.2e-6", "1.1e-6"),
        ("11,863,282", "1,863,282", "11,863,282"),
        ("-37495", "37495", "-37,495"),
        ("788<", "<", "788"),
    ] {
        assert_eq!(
            check(&page.replacen(old, new, 1)),
            Ok(vec![right.to_owned()]),
            "{old} as {new}"
        );
    }
    for (old, new, problem) in [
        ("n a", "n z", "no figure is called 'z'"),
        ("788<!--/n-->", "788", "'a' is not closed"),
        ("of <!--n a-->", "of ", "closes nothing"),
        ("of <", "<", "'a' begins a line"),
        ("<!--n b", "<!--m b", "is no marker"),
        ("![", "[", "no picture"),
    ] {
        let found = check(&page.replacen(old, new, 1)).unwrap_err();
        assert!(found.contains(problem), "{old} as {new}: {found}");
    }
}

/// The table of the specimens says what the survey says.
#[test]
fn pages_specimens_are_as_surveyed() {
    let survey = read("snapshots/specimens-text.snap");
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "specimens");
        let table: Vec<_> = text.lines().filter(|line| line.starts_with("| [")).collect();
        let mut checked = 0;
        for line in &table {
            let cells: Vec<_> = line.split('|').map(str::trim).collect();
            let name = cells[1].trim_start_matches('[').split(']').next().unwrap();
            let wanted = survey.lines().find(|l| l.split_whitespace().next() == Some(name));
            let wanted: Vec<_> =
                wanted.unwrap_or_else(|| panic!("no {name}")).split_whitespace().collect();
            assert_eq!(cells[5], wanted[1], "{folder}: {name}");
            let card = &survey[survey.find(&format!("\n  {name} ")).unwrap() + 1..];
            let shown = card.lines().find(|line| line.contains("shown by: ")).unwrap();
            let shown = shown.trim_end_matches(" pixels");
            let pixels = cells[4].trim_end_matches(" px").rsplit([' ', '：']).next().unwrap();
            assert!(shown.ends_with(&format!(" {pixels}")), "{folder}: {name}: {pixels}, {shown}");
            checked += 1;
        }
        assert_eq!(checked, rasterproof_faults::published::catalogue::CARDS.len());
    }
}

/// Tables add up, and a page that repeats another's table repeats it.
#[test]
fn pages_tables_add_up() {
    let table = read("docs/differential.txt");
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "differential");
        let (before, _) = table.split_once("\nWrong pixels").unwrap();
        assert_eq!(&text[text_block(&text)], before, "{folder}");
    }
    let (_, off_grid) = table.split_once("triangles off the grid").unwrap();
    let lines: Vec<Vec<&str>> = off_grid.lines().map(|l| l.split_whitespace().collect()).collect();
    let is_row = |line: &&Vec<&str>| {
        line.first().is_some_and(|n| n.starts_with("f32-") || n.starts_with("f64-"))
    };
    let rows: Vec<_> = lines.iter().filter(is_row).collect();
    assert_eq!(rows.len(), 14);
    let all = lines.iter().find(|line| line.first() == Some(&"all")).unwrap();
    for column in [1, 2, 3, 5, 6, 7, 8, 9, 10] {
        let number = |line: &Vec<&str>| line[column].parse::<u64>().unwrap();
        assert_eq!(
            rows.iter().map(|line| number(line)).sum::<u64>(),
            number(all),
            "column {column}"
        );
    }
    // The page off the grid states the sums.
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "offgrid");
        for column in [7, 8, 9, 10] {
            let sum = thousands(all[column].parse::<u64>().unwrap());
            assert!(text.contains(&sum), "{folder}: {sum}");
        }
    }
}

/// The table of certificates says what they say, and the README what there is of it.
#[test]
fn pages_certificates_are_as_written() {
    let certificate = |name: &str| -> serde_json::Value {
        serde_json::from_str(&read(format!("docs/certificates/{name}.json"))).unwrap()
    };
    let counts = ["cases", "comparisons", "oracle_checks", "mismatches"];
    let count = fs::read_dir(root().join("docs/certificates")).unwrap().count();
    for pages in ["docs", "docs/zh"] {
        let text = page(pages, "exhaustion");
        let is_row = |line: &&str| line.starts_with("| [") && line.contains("certificates/");
        let rows: Vec<_> = text.lines().filter(is_row).collect();
        assert_eq!(rows.len(), count, "{pages}");
        for line in rows {
            let cells: Vec<_> = line.split('|').map(str::trim).collect();
            let name = cells[1].trim_start_matches('[').split(']').next().unwrap();
            let done = &certificate(name)["done"];
            let said = [2, 3, 4, 5].map(|i| cells[i].replace(',', "").parse::<u64>().ok());
            assert_eq!(said, counts.map(|count| done[count].as_u64()), "{pages}: {line}");
        }
    }
}

/// What the errata say that needs no rasterizer.
#[test]
fn pages_errata_by_arithmetic() {
    // 2.2: the sum of the book, added in turn, is no smaller than its limit.
    let sum = 452.625 + 186.3749999999997 + 239.625 - 452.625 - 186.3749999999997 - 239.625;
    assert!(f64::abs(sum) > 1e-15 && is_rounded("2.84e-14", f64::abs(sum)), "{sum:e}");
    // 3.2.1: the values 1 and 10 with weights .3 and .7, and halfway.
    let mean = |t: f64| (1.0 - t) * 1.0 + t * 10.0;
    assert!((mean(0.7) - 7.3).abs() < 1e-12 && (mean(0.5) - 5.5).abs() < 1e-12);
    // 9.3: an area that the limit takes for none.
    let twice_area = 2e-8 * 2e-8;
    assert!(twice_area > 0.0 && twice_area < 1e-15);
    // GAMES101 and SYSU: casts cut towards zero.
    assert_eq!((-0.9f32 as i32, (-1.2f32 + 0.5) as i32), (0, 0));
    // SYSU, the report: with signs the line from (0, 0) to (-3, 1) rises at every step.
    let (dx, dy) = (-3, 1);
    let mut p = 2 * dy - dx;
    assert_eq!(p, 5);
    for _ in 0..3 {
        assert!(p > 0);
        p += 2 * dy - 2 * dx;
    }
    // The same: with y up (0, 1) lies left of the edge from (0, 0) to (1, 0), and its product is 1.
    let ([edge_x, edge_y], [x, y]) = ([1, 0], [0, 1]);
    assert_eq!(edge_x * y - edge_y * x, 1);
}
