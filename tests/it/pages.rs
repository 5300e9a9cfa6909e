//! Figures in prose do not drift: each is found on its page, in both languages, and computed anew.
//!
//! A figure is given by the words around it, with `{}` in its place; line breaks and blanks do not
//! count. What the page prints must be the computed value, rounded to the digits that are printed.
//! Figures of time are not computed, but those that one page takes from another's table, or that sum
//! a table up, must be what the table says.

use std::fs;
use std::path::PathBuf;

use crate::figures::{ALL, Figure};

fn read(path: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A page of one language.
pub fn page(folder: &str, name: &str) -> String {
    read(&format!("{folder}/{name}.md"))
}

fn dense(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

/// The text at the placeholders, for every place where the words stand.
fn places<'a>(text: &'a str, words: &str) -> Vec<Vec<&'a str>> {
    let words = dense(words);
    let parts: Vec<_> = words.split("{}").collect();
    // Words that begin with a figure would also be found at its tail.
    let is_tail =
        |at: usize| text[..at].ends_with(|c: char| c.is_ascii_digit() || ".,".contains(c));
    let starts = text.match_indices(parts[0]).map(|(at, part)| at + part.len());
    let starts = starts.filter(|&at| !(parts[0].is_empty() && is_tail(at))).map(|at| &text[at..]);
    let follow = |mut rest: &'a str| {
        let mut figures = Vec::new();
        for part in &parts[1..] {
            let is_figure = |c: char| c.is_ascii_digit() || ".,-+e".contains(c);
            let end = rest.find(|c| !is_figure(c)).unwrap_or(rest.len());
            // A figure may end in a comma or a stop that belongs to the words.
            let figure = rest[..end].trim_end_matches([',', '.', 'e', '-', '+']);
            figures.push(figure);
            rest = rest[figure.len()..].strip_prefix(part)?;
        }
        Some(figures)
    };
    starts.filter_map(follow).collect()
}

/// Whether a printed number is `value` to the digits that are printed.
fn is_rounded(printed: &str, value: f64) -> bool {
    let plain = printed.replace(',', "");
    let Ok(number) = plain.parse::<f64>() else { return false };
    let (digits, exponent) = plain.split_once('e').unwrap_or((&plain, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let unit = 10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32);
    // A value halfway may be rounded to either side; tables round once already.
    (number - value).abs() <= unit * 0.5 * (1.0 + 1e-9)
}

/// What is wrong with a figure on the page of one language.
fn stale(text: &str, words: &str, values: &[f64]) -> Option<String> {
    let text = dense(text);
    let found = places(&text, words);
    if found.is_empty() {
        return Some(format!("'{words}' is not on the page"));
    }
    let is_right = |figures: &Vec<&str>| {
        figures.len() == values.len()
            && figures.iter().zip(values).all(|(figure, &value)| is_rounded(figure, value))
    };
    let wrong = found.iter().find(|figures| !is_right(figures))?;
    Some(format!("'{words}' has {wrong:?}, computed {values:?}"))
}

#[test]
fn pages_figures_are_computed() {
    let mut wrong = Vec::new();
    for Figure { page: name, english, chinese, values } in ALL.iter().copied().flatten() {
        let values = values();
        for (folder, words) in [("docs", english), ("docs/zh", chinese)] {
            let problem = stale(&page(folder, name), words, &values);
            wrong.extend(problem.map(|problem| format!("{folder}/{name}.md: {problem}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The rule can fail: a stale figure and missing words are found, a rounded figure is not stale.
#[test]
fn pages_stale_figures_are_found() {
    let text = "Of the\n4,225 lines 788 drift, at .17 of a\nstep; 1.1e-6.";
    assert_eq!(stale(text, "4,225 lines {} drift", &[788.0]), None);
    assert_eq!(stale(text, "lines {} drift, at {} of", &[788.0, 0.1716]), None);
    assert_eq!(stale(text, "step; {}.", &[1.14e-6]), None);
    for (words, values) in [
        ("4,225 lines {} drift", vec![789.0]),
        ("4,225 lines {} drift", vec![]),
        ("drift, at {} of", vec![0.1758]),
        ("lines {} drift", vec![788.6]),
        ("step; {}.", vec![1.2e-6]),
        ("lines {} change", vec![788.0]),
    ] {
        assert!(stale(text, words, &values).is_some(), "{words} {values:?}");
    }
    let twice = "788 drift and 789 drift";
    assert!(stale(twice, "{} drift", &[788.0]).is_some(), "each place is asked");
}

/// Cells of a table's row, by the name in its first cell.
fn row(text: &str, name: &str) -> Vec<String> {
    let line = text.lines().find(|line| line.starts_with(&format!("| {name} |")));
    let line = line.unwrap_or_else(|| panic!("no row {name}"));
    line.split('|').map(|cell| cell.trim().to_owned()).collect()
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
            let rates = cells[7].replace(',', "");
            let figures: Vec<_> = [cells[6]]
                .into_iter()
                .chain(rates.split(" / "))
                .chain(cells[8].split(" / "))
                .collect();
            assert_eq!(figures, wanted[1..7], "{folder}: {name}");
            let card = &survey[survey.find(&format!("\n{name} ")).unwrap() + 1..];
            let shown = card.lines().nth(3).unwrap().trim_end_matches(" pixels");
            let pixels = cells[5].trim_end_matches(" px").rsplit([' ', '：']).next().unwrap();
            assert!(shown.ends_with(&format!(" {pixels}")), "{folder}: {name}: {pixels}, {shown}");
            checked += 1;
        }
        assert_eq!(checked, rasterproof_faults::published::catalogue::CARDS.len());
    }
}

/// Tables add up, and a page that repeats another's table repeats it.
#[test]
fn pages_tables_add_up() {
    let verdict = page("docs", "verdict");
    let (_, off_grid) = verdict.split_once("triangles off the grid").unwrap();
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
    for folder in ["docs", "docs/zh"] {
        let text = page(folder, "offgrid");
        for line in &rows {
            let cells = row(&text, line[0]);
            let figures = [3, 4, 5, 6].map(|i| cells[i].replace(',', ""));
            assert_eq!(figures, [6, 7, 9, 10].map(|i| line[i].to_owned()), "{folder}: {}", line[0]);
        }
    }
}

/// The table of certificates says what they say, and the README what there is of it.
#[test]
fn pages_certificates_are_as_written() {
    let certificate = |name: &str| -> serde_json::Value {
        serde_json::from_str(&read(&format!("docs/certificates/{name}.json"))).unwrap()
    };
    let counts = ["cases", "comparisons", "oracle_checks", "mismatches"];
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/certificates");
    for pages in ["docs", "docs/zh"] {
        let text = page(pages, "exhaustion");
        let is_row = |line: &&str| line.starts_with("| [") && line.contains("certificates/");
        let rows: Vec<_> = text.lines().filter(is_row).collect();
        assert_eq!(rows.len(), fs::read_dir(&folder).unwrap().count(), "{pages}");
        for line in rows {
            let cells: Vec<_> = line.split('|').map(str::trim).collect();
            let name = cells[1].trim_start_matches('[').split(']').next().unwrap();
            let done = &certificate(name)["done"];
            let said = [2, 3, 4, 5].map(|i| cells[i].replace(',', "").parse::<u64>().ok());
            assert_eq!(said, counts.map(|count| done[count].as_u64()), "{pages}: {line}");
        }
    }
    let readme = dense(&read("README.md"));
    let edges = certificate("edges-8")["done"]["cases"].as_f64().unwrap();
    let invariants = rasterproof_invariants::CATALOGUE.len() as f64;
    // Rows of the matrix end in a count; the last line sums them up.
    let matrix = read("snapshots/mutants.snap");
    let is_mutant = |line: &&str| {
        let mut words = line.split_whitespace().rev();
        words.next().is_some_and(|n| n.parse::<u32>().is_ok())
            && words.next().is_some_and(|marks| marks.contains(['.', '#']))
    };
    let mutants = matrix.lines().filter(is_mutant).count() as f64;
    for (words, value) in [
        ("0 wrong of {} |", edges),
        ("| {} [invariants](docs/stability.md)", invariants),
        ("each of {} faults dies", mutants),
    ] {
        assert_eq!(stale(&readme, words, &[value]), None);
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
