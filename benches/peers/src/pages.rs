//! The page on speed: its tables and plots, from the recorded runs. `tests/it/speed.rs` compares them with the page.

use std::fmt::Write as _;

use rasterproof_report::canvas::{self, Drawing, GRID, INK, Ink, SOFT};
use serde_json::Value;

/// What stands around the numbers, in English and in Chinese.
struct Words {
    made: &'static str,
    missing: &'static str,
    /// What is timed, and what is wrong in all columns together.
    centres: [&'static str; 2],
    areas: [&'static str; 2],
    frames: [&'static str; 2],
    wrong: &'static str,
    by: &'static str,
    /// What bounds a frame; what fills take.
    limits: [&'static str; 2],
    ends: [&'static str; 2],
}

const ENGLISH: Words = Words {
    made: "Made by",
    missing: "Missing there",
    centres: [
        "One sample a pixel, ns for each triangle; in brackets how many times as long as `list`",
        "missing + extra",
    ],
    areas: [
        "Antialiased, ns for each triangle; in brackets how many times as long as the fastest of ours whose errors are no larger",
        "error, largest",
    ],
    frames: [
        "Frames with one sample a pixel, ms; in brackets how many times as long as the tiles on as many cores",
        "The same with four samples a pixel",
    ],
    wrong: "uncovered, other",
    by: "by",
    limits: [
        "| mesh | samples | ms | instructions, millions | of the time | picture and mesh, MB | of the time |",
        "Instructions of antialiased fills, for each triangle",
    ],
    ends: [": ", "."],
};

const CHINESE: Words = Words {
    made: "测得这些的命令",
    missing: "那里没有",
    centres: ["每像素一个采样点，每个三角形的纳秒数；括号里是 `list` 的多少倍", "少画 + 多画"],
    areas: ["抗锯齿，每个三角形的纳秒数；括号里是我们之中误差不更大的最快者的多少倍", "误差，最大"],
    frames: [
        "每像素一个采样点的帧，毫秒；括号里是同样核数的图块的多少倍",
        "每像素四个采样点的帧，毫秒",
    ],
    wrong: "覆盖不同，颜色不同",
    by: "由谁",
    limits: [
        "| 网格 | 采样点 | 毫秒 | 指令，百万 | 占时间 | 画面和网格，MB | 占时间 |",
        "抗锯齿填充的指令数，每个三角形",
    ],
    ends: ["：", "。"],
};

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("{key} in {value}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number, not {value}"))
}

/// The distinct values of a key, in their order.
fn distinct<'a>(rows: &[&'a Value], key: &str) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    for row in rows {
        let value = text(row, key);
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}

/// A last column: its head, and what it says of the row of a name.
type LastColumn<'a> = (&'a str, &'a dyn Fn(&[&Value]) -> String);

/// A row for each name and number of cores, a column for each value of `key`.
fn table(
    rows: &[&Value],
    key: &str,
    head: &str,
    words: &Words,
    cell: &dyn Fn(&Value) -> String,
    last: Option<LastColumn>,
) -> String {
    let columns = distinct(rows, key);
    let mut table = format!("{head}{}\n\n| {} |", words.ends[0].trim_end(), words.by);
    columns.iter().for_each(|column| write!(table, " `{column}` |").unwrap());
    last.iter().for_each(|(head, _)| write!(table, " {head} |").unwrap());
    let count = columns.len() + usize::from(last.is_some());
    write!(table, "\n|---|{}", "---|".repeat(count)).unwrap();
    for cores in [None, Some(1), Some(2)] {
        let rows: Vec<_> =
            rows.iter().copied().filter(|row| row["cores"].as_u64() == cores).collect();
        for name in distinct(&rows, "name") {
            let suffix = if cores == Some(2) { " x 2" } else { "" };
            write!(table, "\n| {name}{suffix} |").unwrap();
            for column in &columns {
                let found =
                    rows.iter().find(|row| text(row, key) == *column && text(row, "name") == name);
                write!(table, " {} |", found.map_or("-".to_owned(), |row| cell(row))).unwrap();
            }
            if let Some((_, says)) = last {
                let own: Vec<_> =
                    rows.iter().copied().filter(|row| text(row, "name") == name).collect();
                write!(table, " {} |", says(&own)).unwrap();
            }
        }
    }
    table + "\n\n"
}

/// Half the distance of the quartiles, in percent of the median: the largest of these rows.
fn noise(rows: &[&Value], key: &str) -> String {
    let percent = rows.iter().map(|row| {
        let [low, high] = [0, 1].map(|i| number(&row[key]["quartiles"][i]));
        (high - low) / 2.0 / number(&row[key]["median"]) * 100.0
    });
    format!(" (±{:.0}%)", percent.fold(0.0, f64::max))
}

/// A median, and how many times as long as ours it is.
fn time(spread: &Value, unit: f64, ours: &Value) -> String {
    let median = number(&spread["median"]);
    let shown = median / unit;
    let digits = if shown >= 1000.0 {
        0
    } else if shown >= 100.0 {
        1
    } else {
        2
    };
    let factor = median / number(&ours["median"]);
    format!("{shown:.digits$} ({factor:.2})")
}

fn machine(run: &Value, words: &Words) -> String {
    let [colon, end] = words.ends;
    let [processor, system, instructions] =
        ["processor", "system", "instructions"].map(|key| text(run, key));
    let mut all =
        vec![format!("{processor} ({}, {instructions})", run["cores"]), system.to_owned()];
    // Runs before the end of November 2026 do not say when they were.
    all.extend(["day", "commit"].iter().filter_map(|key| Some(run[key].as_str()?.to_owned())));
    let versions = run["versions"].as_array().into_iter().flatten();
    all.extend(versions.map(|version| version.as_str().unwrap().to_owned()));
    let mut said =
        format!("{}{colon}`{}`; {}{end}", words.made, text(run, "command"), all.join("; "));
    for missing in run["missing"].as_array().into_iter().flatten() {
        write!(
            said,
            " {}{colon}{} ({}){end}",
            words.missing,
            text(missing, "name"),
            text(missing, "why")
        )
        .unwrap();
    }
    said + "\n\n"
}

/// Ours that a fill is compared with, as the command chooses it.
fn ours<'a>(rows: &[&'a Value], row: &Value) -> &'a Value {
    let like = rows.iter().copied().filter(|other| other["class"] == row["class"]);
    let rms = |row: &Value| row["errors"]["areas"]["rms"].as_f64();
    let equal = like.filter(|other| match (text(other, "name"), rms(other), rms(row)) {
        ("list", None, None) | ("exact area", Some(_), Some(_)) => true,
        ("4 x 4 samples", Some(ours), Some(theirs)) => ours <= theirs,
        _ => false,
    });
    let ns = |row: &&Value| number(&row["ns"]["median"]);
    equal.min_by(|a, b| ns(a).total_cmp(&ns(b))).expect("ours fills every class")
}

/// The tiles' frame of the same mesh, with as many samples and cores.
fn tiles<'a>(frames: &[&'a Value], row: &Value) -> &'a Value {
    let like = |other: &&&Value| {
        text(other, "name") == "tiles"
            && ["mesh", "samples", "cores"].iter().all(|key| other[key] == row[key])
    };
    frames.iter().find(like).expect("tiles draw everything")
}

/// What bounds frames, and what they and fills spend their instructions on.
fn limits(run: &Value, peers: &Value, words: &Words) -> String {
    let mut page = machine(run, words) + words.limits[0] + "\n" + &"|---".repeat(7) + "|\n";
    let frames = run["frames"].as_array().unwrap();
    let named = |row: &Value| format!("| `{}` | {} |", text(row, "mesh"), row["samples"]);
    for row in frames {
        let [ms, instructions, moved] =
            ["ms", "instructions", "moved"].map(|key| number(&row[key]));
        let [computed, copied] =
            [(instructions, "rate"), (moved, "copy")].map(|(n, key)| n / number(&run[key]) * 1e3);
        let [of_computed, of_copied] = [computed, copied].map(|bound| bound / ms * 100.0);
        let (millions, moved) = (instructions / 1e6, moved / 1e6);
        writeln!(
            page,
            "{} {ms:.2} | {millions:.0} | {of_computed:.0}% | {moved:.1} | {of_copied:.0}% |",
            named(row)
        )
        .unwrap();
    }
    let fills: Vec<_> = run["fills"].as_array().unwrap().iter().collect();
    let triangles = |row: &Value| {
        let mut like = peers["fills"].as_array().unwrap().iter();
        number(&like.find(|other| other["class"] == row["class"]).unwrap()["triangles"])
    };
    page.push('\n');
    let cell = |row: &Value| format!("{:.0}", number(&row["instructions"]) / triangles(row));
    page + &table(&fills, "class", words.limits[1], words, &cell, None)
}

/// The sum of a whole number over rows.
fn sum(rows: &[&Value], number: impl Fn(&Value) -> &Value) -> u64 {
    rows.iter().map(|row| number(row).as_u64().expect("a count")).sum()
}

fn peers(run: &Value, words: &Words) -> String {
    let mut page = machine(run, words);
    let all = |key: &str| run[key].as_array().unwrap().iter().collect::<Vec<_>>();
    let fills = all("fills");
    for (kind, heads) in [("pixels", words.centres), ("areas", words.areas)] {
        let rows: Vec<_> =
            fills.iter().copied().filter(|row| !row["errors"][kind].is_null()).collect();
        let head = heads[0].to_owned() + &noise(&rows, "ns");
        let cell =
            |row: &Value| time(&row["ns"], number(&row["triangles"]), &ours(&fills, row)["ns"]);
        let largest = |rows: &[&Value], of: &str| {
            rows.iter().map(|row| number(&row["errors"]["areas"][of])).fold(0.0, f64::max)
        };
        let wrong = |rows: &[&Value]| match kind {
            "pixels" => {
                let [missing, extra] =
                    ["missing", "extra"].map(|of| sum(rows, |row| &row["errors"]["pixels"][of]));
                format!("{missing}+{extra}")
            }
            _ => format!("{:.1}, {:.0}", largest(rows, "rms"), largest(rows, "worst")),
        };
        page += &table(&rows, "class", &head, words, &cell, Some((heads[1], &wrong)));
    }
    let frames = all("frames");
    for (samples, head) in [1, 4].into_iter().zip(words.frames) {
        let rows: Vec<_> = frames.iter().copied().filter(|row| row["samples"] == samples).collect();
        let head = head.to_owned() + &noise(&rows, "ms");
        let cell = |row: &Value| time(&row["ms"], 1.0, &tiles(&rows, row)["ms"]);
        let wrong = |rows: &[&Value]| {
            let [uncovered, other] = ["uncovered", "other"].map(|of| sum(rows, |row| &row[of]));
            format!("{uncovered}, {other}")
        };
        page += &table(&rows, "mesh", &head, words, &cell, Some((words.wrong, &wrong)));
    }
    page
}

/// One engine's points of one curve.
struct Curve<'a> {
    what: &'a str,
    engine: String,
    /// What grows, milliseconds, megabytes.
    points: Vec<[f64; 3]>,
}

fn curves(run: &Value) -> Vec<Curve<'_>> {
    let mut curves: Vec<Curve<'_>> = Vec::new();
    for row in run["rows"].as_array().unwrap() {
        let what = text(row, "what");
        let engine = match (text(row, "engine"), &row["samples"], &row["cores"]) {
            ("scanline", ..) => "scanline".to_owned(),
            (engine, samples, cores) => {
                let plural = |count: &Value| if count == 1 { "" } else { "s" };
                let (more, many) = (plural(samples), plural(cores));
                format!("{engine}, {samples} sample{more}, {cores} core{many}")
            }
        };
        let point = [&row["at"], &row["ms"]["median"], &row["megabytes"]].map(number);
        match curves.iter_mut().find(|curve| curve.what == what && curve.engine == engine) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { what, engine, points: vec![point] }),
        }
    }
    curves
}

const PANEL: [f64; 2] = [400.0, 230.0];
const INKS: [Ink; 5] =
    [[205, 30, 30], [31, 84, 170], [120, 165, 225], [20, 110, 50], [140, 190, 120]];

/// A panel for each thing that grows, both axes logarithmic.
fn plot(run: &Value, of: usize, title: &str) -> Drawing {
    let curves = curves(run);
    let mut whats: Vec<&str> = curves.iter().map(|curve| curve.what).collect();
    whats.dedup();
    let mut names: Vec<&str> = curves.iter().map(|curve| curve.engine.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let head = 20.0 * (names.len() as f64 + 1.0) + 10.0;
    let rows = whats.len().div_ceil(2) as f64;
    let mut drawing = Drawing::new(title, [2.0 * PANEL[0], head + rows * PANEL[1]]);
    drawing.text([8.0, 12.0], title, INK);
    for ((i, name), ink) in names.iter().enumerate().zip(INKS) {
        let y = 32.0 + 20.0 * i as f64;
        drawing.wide_line([10.0, y], [34.0, y], ink);
        drawing.text([42.0, y], name, INK);
    }
    for (panel, what) in whats.iter().enumerate() {
        let corner =
            [(panel % 2) as f64 * PANEL[0] + 60.0, head + (panel / 2) as f64 * PANEL[1] + 30.0];
        let size = [PANEL[0] - 80.0, PANEL[1] - 70.0];
        let here: Vec<_> = curves.iter().filter(|curve| curve.what == *what).collect();
        let range = |of: usize| {
            let all =
                here.iter().flat_map(|curve| &curve.points).map(|p| p[of]).filter(|v| *v > 0.0);
            let (low, high) =
                all.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
            [low.log10().floor(), high.log10().ceil().max(low.log10().floor() + 1.0)]
        };
        let [across, up] = [range(0), range(of)];
        let at = |p: [f64; 2]| {
            let part = |v: f64, [low, high]: [f64; 2]| (v.log10() - low) / (high - low);
            [corner[0] + part(p[0], across) * size[0], corner[1] + (1.0 - part(p[1], up)) * size[1]]
        };
        drawing.text([corner[0], corner[1] - 14.0], what, INK);
        for (range, is_across) in [(across, true), (up, false)] {
            for decade in range[0] as i32..=range[1] as i32 {
                let value = 10.0_f64.powi(decade);
                let label = if (-2..6).contains(&decade) {
                    value.to_string()
                } else {
                    format!("1e{decade}")
                };
                if is_across {
                    let [x, _] = at([value, 10.0_f64.powf(up[0])]);
                    drawing.line([x, corner[1]], [x, corner[1] + size[1]], GRID);
                    drawing.text_about([x, corner[1] + size[1] + 12.0], &label, SOFT);
                } else {
                    let [_, y] = at([10.0_f64.powf(across[0]), value]);
                    drawing.line([corner[0], y], [corner[0] + size[0], y], GRID);
                    drawing.text_before([corner[0] - 6.0, y], &label, SOFT);
                }
            }
        }
        for curve in here {
            let ink = INKS[names.iter().position(|name| *name == curve.engine).unwrap()];
            let points: Vec<_> =
                curve.points.iter().filter(|p| p[of] > 0.0).map(|p| at([p[0], p[of]])).collect();
            points.windows(2).for_each(|pair| drawing.wide_line(pair[0], pair[1], ink));
            points.iter().for_each(|point| drawing.disc(*point, 2.5, ink));
        }
    }
    drawing
}

/// A page with this text in the place of what stands from the line that names the command to the next heading.
fn with_tables(page: &str, words: &Words, command: &str, tables: &str) -> String {
    let [colon, _] = words.ends;
    let first = format!("\n{}{colon}`{command}", words.made);
    let start = page.find(&first).expect("a line that names the command") + 1;
    let end = start + page[start..].find("\n## ").expect("a heading");
    [&page[..start], tables, &page[end + 1..]].concat()
}

/// The pages and the plots of the recorded runs by their paths in the repository, each with its text. The runs come first: `--json`, `--growth`
/// and `--limits`; then what reads a page as it is now.
pub fn renewed(
    [run, grown, bounds]: [&Value; 3],
    read: impl Fn(&str) -> String,
) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for (page, words) in [("docs/speed.md", &ENGLISH), ("docs/zh/speed.md", &CHINESE)] {
        let told = with_tables(&read(page), words, "benches/peers/run --json", &peers(run, words));
        let limits = limits(bounds, run, words);
        let told = with_tables(&told, words, "benches/peers/run --limits", &limits);
        let told = with_tables(&told, words, "benches/peers/run --growth", &machine(grown, words));
        files.push((page.to_owned(), told));
    }
    for (of, name, title) in [
        (1, "growth-time", "Milliseconds of a frame"),
        (2, "growth-memory", "Megabytes of a frame"),
    ] {
        files.push((format!("docs/{name}.svg"), canvas::svg(&plot(grown, of, title))));
    }
    files
}

/// The recorded runs, in the order in which [`renewed`] takes them.
pub const RUNS: [&str; 3] = ["docs/peers.json", "docs/growth.json", "docs/limits.json"];
