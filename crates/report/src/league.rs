//! The league as tables of a page, in English and in Chinese.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::phrases;
use rasterproof_judge::league::{Kind, League, Ranked};
use rasterproof_judge::verdict::{Score, per_million};

/// What stands around the numbers.
struct Words {
    header: &'static str,
    /// What stands for the score of a convention that is the declared one.
    as_declared: &'static str,
    unexplained: &'static str,
    /// No convention explains it, and a mistake does.
    by_mistake: &'static str,
    mistake: &'static str,
    /// Before the name of an earlier library that does the same.
    as_first: &'static str,
    kinds: [&'static str; 2],
    /// What stands after what a line is about, and at its end.
    marks: [&'static str; 2],
    /// A sentence, or how a call is made, which are English in the data.
    say: fn(&str) -> String,
    /// The line above the table: by which version, with how many cases, and when.
    made: fn(&League) -> String,
}

/// The words of both languages, in the same order.
const ENGLISH: Words = Words {
    header: "| library | as is | by its convention | holes | doubles | order | lines as is | lines by theirs | from either \
             end |",
    as_declared: "the same",
    unexplained: "unexplained",
    by_mistake: "a mistake",
    mistake: "By mistake it ",
    as_first: "as",
    kinds: ["Triangles", "Lines"],
    marks: [": ", "."],
    say: str::to_owned,
    made: |l| {
        format!(
            "Made by rasterproof {}, {} cases of each family, seed {}, from {} to {}.",
            l.rasterproof,
            l.cases,
            l.seed,
            l.days()[0],
            l.days()[1]
        )
    },
};

const CHINESE: Words = Words {
    header: "| 库 | 原样 | 按其约定 | 空洞 | 重复 | 顶点顺序 | 直线原样 | 直线按其约定 | 两端互换 |",
    as_declared: "相同",
    unexplained: "未能解释",
    by_mistake: "已知的错误",
    mistake: "它错在：",
    as_first: "同",
    kinds: ["三角形", "直线"],
    marks: ["：", "。"],
    say: phrases::chinese,
    made: |l| {
        format!(
            "由 rasterproof {} 生成，每族 {} 个案例，种子 {}，{} 至 {}。",
            l.rasterproof,
            l.cases,
            l.seed,
            l.days()[0],
            l.days()[1]
        )
    },
};

/// The league: a table of numbers, then what each library does.
pub fn tables(league: &League, chinese: bool) -> String {
    let words = if chinese { &CHINESE } else { &ENGLISH };
    let mut out = format!("{}\n\n{}\n|---|", (words.made)(league), words.header);
    out += &"---:|".repeat(8);
    out.push('\n');
    for row in &league.rows {
        // Triangles, then lines: as declared, and by the convention that explains them.
        let [as_is, found] = scores(row.triangles.as_ref(), words);
        let [lines, lines_found] = scores(row.lines.as_ref(), words);
        let [meshes, holes, doubles] = row.meshes;
        // Without meshes there is nothing that could have a hole.
        let [holes, doubles] = [holes, doubles].map(|pixels| match meshes {
            0 => "-".to_owned(),
            _ => pixels.to_string(),
        });
        let _ = writeln!(
            out,
            "| {} | {as_is} | {found} | {holes} | {doubles} | {} | {lines} | {lines_found} | {} |",
            row.name,
            percent(row.orders),
            percent(row.directions)
        );
    }
    out.push('\n');
    // What each library does, below the table; the same sentence is said once.
    let mut said = BTreeMap::new();
    for row in &league.rows {
        one(&mut out, row, words, &mut said);
    }
    out
}

/// The version of a library, how it was called, and what it does: where an earlier one of `said` does the same, its name.
fn one<'a>(out: &mut String, row: &'a Ranked, words: &Words, said: &mut BTreeMap<String, &'a str>) {
    let [colon, stop] = words.marks;
    let call = (words.say)(&row.call);
    // The name is said before it.
    let version = row.version.strip_prefix(&format!("{}-", row.name)).unwrap_or(&row.version);
    let _ = writeln!(out, "- **{}**, {version}{colon}{call}{stop}", row.name);
    for (about, kind) in words.kinds.iter().zip([&row.triangles, &row.lines]) {
        let Some(kind) = kind else { continue };
        // What is left of the convention once the table has said its part.
        let does = match &kind.mistake {
            // A mistake that is known explains more than a convention beside it.
            Some(mistake) => format!("{}{}{stop}", words.mistake, (words.say)(mistake)),
            None => without_shares(&(words.say)(&beyond_the_table(&kind.sentence))),
        };
        if does.is_empty() {
            continue;
        }
        // Libraries often do the same, and then the name of the first one is shorter.
        let line = format!("{about}{colon}{does}");
        let _ = match said.get(&line) {
            Some(first) => writeln!(out, "  - {about}{colon}{} {first}{stop}", words.as_first),
            None => writeln!(out, "  - {line}"),
        };
        said.entry(line).or_insert(&row.name);
    }
}

/// How sentences begin that the table makes needless, or that are of single shapes and stand in the data alone.
const IN_THE_DATA: [&str; 8] = [
    "unexplained.",
    "The nearest hypothesis",
    "Triangles without area",
    "Triangles that leave the window",
    "Lines that leave the window",
    "It may as well be",
    "The order of the corners",
    "Its pixels do not come in order",
];

/// A convention without what the table or the data says better.
fn beyond_the_table(sentence: &str) -> String {
    let mut kept = String::new();
    for one in sentence.split_inclusive(". ") {
        if !one.contains("of its lines are the same from either end.")
            && !IN_THE_DATA.iter().any(|begin| one.starts_with(begin))
        {
            kept += one;
        }
    }
    kept.trim_end().to_owned()
}

/// A sentence without the shares of each direction of an edge, from north on, which the data has.
fn without_shares(sentence: &str) -> String {
    if let Some((before, rest)) = sentence.split_once(" (N ")
        && let Some((_, after)) = rest.split_once(')')
    {
        return format!("{before}{after}");
    }
    sentence.to_owned()
}

/// Wrong pixels in a million, as declared and by the convention.
fn scores(kind: Option<&Kind>, words: &Words) -> [String; 2] {
    let Some(kind) = kind else { return ["-".to_owned(), "-".to_owned()] };
    let share = |s: Score| format!("{:.0}", per_million(s.wrong, s.pixels));
    // A score needs a convention that explains what was drawn.
    let found = match kind.by_convention {
        Some(score) => share(score),
        None if kind.sentence.is_empty() => words.as_declared.to_owned(),
        None if kind.mistake.is_some() => words.by_mistake.to_owned(),
        None => words.unexplained.to_owned(),
    };
    [share(kind.as_declared), found]
}

fn percent([all, changed]: [u64; 2]) -> String {
    if all == 0 { "-".to_owned() } else { format!("{:.0}%", 100.0 * changed as f64 / all as f64) }
}
