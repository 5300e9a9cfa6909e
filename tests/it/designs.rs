//! Wrong rasterizers that the families of dangers hardly see, and the designs do: each is wrong under two facts together.

use rayon::prelude::*;

use crate::mistakes::{FILLS, Fill, STROKES, Stroke, right};
use crate::pages::{Renewal, read};
use crate::program::every;
use rasterproof::cases::triangles::FAMILIES;
use rasterproof::cases::{self, Case, Family, FamilyName, Limits, Shape};
use rasterproof::contract::{DrawLine as _, Rasterize};
use rasterproof::grid::PixelRect;
use rasterproof::oracle::Oracle;
use rasterproof::triangle::Span;
use rasterproof_core::frame::Coverage;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_report::designs::{self, Shares};
use rasterproof_report::words::thousands;
use rasterproof_verify::cases::facts;
use rasterproof_verify::comparison::{Convention, Watch, caught};

/// What is wrong of a span that is right: it is changed, or dropped.
type Fault = fn(&[[i64; 2]; 3], PixelRect, Span) -> Option<Span>;

fn least(points: &[[i64; 2]; 3], axis: usize) -> i64 {
    points.iter().map(|p| p[axis]).min().unwrap()
}

fn most(points: &[[i64; 2]; 3], axis: usize) -> i64 {
    points.iter().map(|p| p[axis]).max().unwrap()
}

/// A span without its last pixel.
fn shorter(span: Span) -> Option<Span> {
    (span.x1_px > span.x0_px + 1).then(|| Span { x1_px: span.x1_px - 1, ..span })
}

const FAULTS: [(&str, Fault); 10] = [
    ("the last row of windows of odd height that are wider than 32 px", |_, window, span| {
        let is_lost = window.height() % 2 == 1 && window.width() > 32 && span.y_px == window.y1 - 1;
        (!is_lost).then_some(span)
    }),
    ("windows of one column, clockwise", |points, window, span| {
        let [a, b, c] = points;
        let turns = (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]);
        (window.width() > 1 || !turns).then_some(span)
    }),
    ("far to the left and far below", |points, window, span| {
        let far = 32_768 * 256;
        let is_far = least(points, 0) < -far && most(points, 1) > far + i64::from(window.y1) * 256;
        if is_far { shorter(span) } else { Some(span) }
    }),
    ("columns from 256 on of triangles that are one row high", |points, _, span| {
        let is_low = most(points, 1) - least(points, 1) < 512;
        if is_low && span.x1_px > 256 { shorter(span) } else { Some(span) }
    }),
    ("row 40 of triangles with an upright edge", |points, _, span| {
        let is_upright = (0..3).any(|i| points[i][0] == points[(i + 1) % 3][0]);
        (!is_upright || span.y_px != 40).then_some(span)
    }),
    (
        "corners on whole pixels in windows whose width is a multiple of 16",
        |points, window, span| {
            let is_whole = points.iter().flatten().all(|v| v % 256 == 0);
            if is_whole && window.width() % 16 == 0 { shorter(span) } else { Some(span) }
        },
    ),
    ("slivers that begin in a column of 8", |points, _, span| {
        let height = most(points, 1) - least(points, 1);
        let is_thin = most(points, 0) - least(points, 0) > 64 * height;
        (!is_thin || span.x0_px % 8 != 0).then_some(span)
    }),
    ("more than 64 px wide in a window of two rows", |points, window, span| {
        let is_wide = most(points, 0) - least(points, 0) > 64 * 256;
        (!is_wide || window.height() != 2).then_some(span)
    }),
    ("a level lower edge outside the window on the right", |points, window, span| {
        let lowest = most(points, 1);
        let is_level = points.iter().filter(|p| p[1] == lowest).count() > 1;
        let is_out = least(points, 0) >= 0 && most(points, 0) > i64::from(window.x1) * 256;
        if is_level && is_out { shorter(span) } else { Some(span) }
    }),
    ("the first corner uppermost, above 2^20 px", |points, _, span| {
        let is_high = points[0][1] < -(1 << 28) && points[0][1] == least(points, 1);
        (!is_high).then_some(span)
    }),
];

/// In how many of the first 1,000 cases of a family each fault draws something wrong.
fn wrong_cases(family: &Family) -> [usize; FAULTS.len()] {
    let mut counts = [0; FAULTS.len()];
    for index in 0..1000 {
        let case = family.case(1, index);
        let mut is_wrong = [false; FAULTS.len()];
        for triangle in case.triangles() {
            let points = triangle.corners().map(|p| [i64::from(p.x), i64::from(p.y)]);
            Oracle.cover(triangle.corners(), case.window, |span| {
                for ((_, fault), is_wrong) in FAULTS.iter().zip(&mut is_wrong) {
                    *is_wrong |= fault(&points, case.window, span) != Some(span);
                }
            });
        }
        for (count, is_wrong) in counts.iter_mut().zip(is_wrong) {
            *count += usize::from(is_wrong);
        }
    }
    counts
}

/// In the default number of cases of a program the design finds every one of them.
#[test]
fn designs_find_what_needs_two_facts() {
    let is_design = |family: &&Family| family.name == FamilyName::Design.as_str();
    let (design, others): (Vec<_>, Vec<_>) = FAMILIES.iter().partition(is_design);
    let by_design = wrong_cases(design[0]);
    let by_others: Vec<_> = others.into_iter().map(wrong_cases).collect();
    let mut missed = Vec::new();
    for (at, (name, _)) in FAULTS.iter().enumerate() {
        let by_others: usize = by_others.iter().map(|counts| counts[at]).sum();
        println!(
            "{name}: {} cases of the design, {by_others} of the other families",
            by_design[at]
        );
        if by_design[at] == 0 {
            missed.push(name);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

/// The pages that say how much is asked, and how soon wrong programs are found.
const PAGES: [&str; 2] = ["docs/designs.md", "docs/zh/designs.md"];

/// Writes the rows of the table under the head that begins so, in a page.
fn with_rows(page: &str, head: &str, rows: &str) -> String {
    let start = page.find(&format!("| {head} |")).unwrap_or_else(|| panic!("no table {head}"));
    let after = |from: usize| from + page[from..].find('\n').expect("a next line") + 1;
    // Behind the head and the line under it.
    let first = after(after(start));
    // An empty table ends at once.
    let end = first + page[first - 1..].find("\n\n").expect("the end of the table");
    format!("{}{rows}{}", &page[..first], &page[end..])
}

/// A table of the pages: how its head begins and its rows, in both languages.
struct PageTable {
    heads: [&'static str; 2],
    rows: [String; 2],
}

/// Compares the rows of tables with those of the pages, or renews them.
fn check_tables(tables: &[PageTable], test: &str) {
    let mut renewal = Renewal::default();
    for at in 0..2 {
        let mut page = read(PAGES[at]);
        for PageTable { heads, rows } in tables {
            page = with_rows(&page, heads[at], &rows[at]);
        }
        renewal.is(PAGES[at], &page);
    }
    renewal.check(test);
}

/// The least share of triples that is asked by default, in percent.
const LEAST_TRIPLES: f64 = 95.0;

/// The first 1,000 cases have all pairs, the default numbers of cases nearly all triples, and no family has a pair that is called
/// impossible. At night the table of shares is checked, too, with 100,000 cases.
#[test]
#[ignore = "minutes; .ci/run runs it, and .ci/run --all in full"]
fn designs_ask_most_of_what_can_be_asked() {
    let is_whole = every(2) == 1;
    let mut all: Vec<Shares> =
        facts::TOPICS.par_iter().map(|topic| designs::of_topic(topic, is_whole)).collect();
    all.push(designs::of_polygons(is_whole));
    let rows: String = all.iter().map(Shares::row).collect();
    let impossible: Vec<&String> =
        all.iter().flat_map(|shares| &shares.by_families.impossible).collect();
    assert!(impossible.is_empty(), "{impossible:?}");
    for shares in &all {
        let [first, by_default @ .., _] = &shares.by_design;
        let first = first.as_ref().unwrap();
        assert_eq!(first.pairs, shares.whole.of_pairs, "{}", shares.whole.family);
        for asked in by_default.iter().flatten() {
            let [_, triples] = shares.percent(asked);
            assert!(triples >= LEAST_TRIPLES, "{}: {triples}", shares.whole.family);
        }
    }
    if is_whole {
        let table = PageTable { heads: ["design", "设计"], rows: [rows.clone(), rows] };
        check_tables(&[table], "designs_ask_most");
    }
}

/// How many cases it takes to find a wrong program, in turn over some families; nothing where none of so many is wrong.
fn cases_to_find(families: &[&Family], seed: u64, is_wrong: &dyn Fn(&Case) -> bool) -> Option<u64> {
    const MOST: u64 = 1000;
    // What takes 2^31 steps for a line or a triangle is not asked.
    let limits = Limits { line_range_px: Some(4096), ..Convention::default().limits(Some(4096)) };
    // What panics is wrong, and not worth a line for each case.
    let watch = Watch::begin();
    let mut asked = 0;
    for index in 0..MOST {
        for family in families {
            asked += 1;
            let case = family.case_within(seed, index, &limits);
            if watch.during(|| caught(|| is_wrong(&case))).unwrap_or(true) {
                return Some(asked);
            }
        }
    }
    None
}

/// The median over five seeds, by families alone, by designs alone, and by all of them.
fn medians(families: [&[&Family]; 3], is_wrong: &dyn Fn(&Case) -> bool) -> [Option<u64>; 3] {
    families.map(|families| {
        let mut found: Vec<u64> = (1..=5)
            .map(|seed| cases_to_find(families, seed, is_wrong).unwrap_or(u64::MAX))
            .collect();
        found.sort_unstable();
        Some(found[2]).filter(|median| *median < u64::MAX)
    })
}

/// A wrong program: its name, and whether it draws a case wrong.
type Program = (String, Box<dyn Fn(&Case) -> bool + Send + Sync>);

/// Planted faults, judged as `verify` does.
fn planted_faults(lines: bool) -> Vec<Program> {
    let judged = |name: &str, engines: EnginesToJudge| -> Program {
        let is_wrong =
            move |case: &Case| engines.judge_case(case).iter().any(|(_, found)| found.is_wrong());
        (name.to_owned(), Box::new(is_wrong))
    };
    if lines {
        let of = |fault: LineMutant| judged(fault.name(), LineEngine::Mutant(fault).into());
        LineMutant::ALL.into_iter().map(of).collect()
    } else {
        let of = |fault: TriangleMutant| judged(fault.name(), Engine::Mutant(fault).into());
        TriangleMutant::ALL.into_iter().map(of).collect()
    }
}

/// The programs with the mistakes of the tables.
fn mistakes_in(lines: bool) -> Vec<Program> {
    let mut programs: Vec<Program> = Vec::new();
    if lines {
        for (number, (name, stroke)) in STROKES.iter().enumerate() {
            let is_wrong = move |case: &Case| is_stroke_wrong(*stroke, case);
            programs.push((format!("{name} ({number})"), Box::new(is_wrong)));
        }
    } else {
        for (number, (name, fill)) in FILLS.iter().enumerate() {
            let is_wrong = move |case: &Case| is_fill_wrong(*fill, case);
            programs.push((format!("{name} ({number})"), Box::new(is_wrong)));
        }
    }
    programs
}

fn is_fill_wrong(fill: Fill, case: &Case) -> bool {
    case.triangles().iter().any(|triangle| {
        let [mut drawn, mut expected] = [(); 2].map(|()| Coverage::new(case.window, 0));
        fill(triangle.corners(), case.window, &mut drawn);
        right(triangle.corners(), case.window, &mut expected);
        drawn != expected
    })
}

fn is_stroke_wrong(stroke: Stroke, case: &Case) -> bool {
    let Shape::Lines(lines) = &case.shape else { return false };
    lines.iter().any(|line| {
        let window = case.window;
        let ends = line.ends.map(|end| [end.pixel.x, end.pixel.y]);
        let mut drawn = Vec::new();
        stroke(ends, [window.x1 - 1, window.y1 - 1], &mut |x, y| {
            if window.contains(x, y) {
                drawn.push([x, y]);
            }
        });
        let mut expected = Vec::new();
        Oracle.draw(line, window, |f| expected.push([f.x_px, f.y_px]));
        drawn.sort_unstable();
        drawn.dedup();
        expected.sort_unstable();
        drawn != expected
    })
}

/// A median and the largest of some counts; what was never found is larger than all.
fn summed(counts: &[Option<u64>]) -> String {
    let mut counts: Vec<u64> = counts.iter().map(|count| count.unwrap_or(u64::MAX)).collect();
    counts.sort_unstable();
    let shown = |count: u64| match count {
        u64::MAX => "-".to_owned(),
        count => thousands(count),
    };
    let missed = counts.iter().filter(|count| **count == u64::MAX).count();
    let found: Vec<u64> = counts.iter().copied().filter(|count| *count < u64::MAX).collect();
    let worst = found.last().copied().unwrap_or(u64::MAX);
    format!("{} | {} | {missed}", shown(counts[counts.len() / 2]), shown(worst))
}

/// How many cases it takes to find planted faults and the mistakes of the tables: by families alone, and by the design. By day
/// every sixth is looked for, and the tables of the pages are not checked.
#[test]
#[ignore = "minutes; .ci/run runs it, and .ci/run --all in full"]
fn designs_find_faults_early() {
    let step = every(6);
    let groups = [
        (["planted in triangles", "植入的三角形错误"], false, planted_faults(false)),
        (["mistakes in triangles", "三角形错误表"], false, mistakes_in(false)),
        (["planted in lines", "植入的直线错误"], true, planted_faults(true)),
        (["mistakes in lines", "直线错误表"], true, mistakes_in(true)),
    ];
    let (mut rows, mut later) = ([String::new(), String::new()], String::new());
    for (names, lines, programs) in groups {
        let families = if lines { cases::lines::FAMILIES } else { FAMILIES };
        // Windows that do not begin at the origin are for engines alone.
        let families = families.iter().filter(|family| family.name != "far");
        let (by_design, drawn): (Vec<&Family>, Vec<&Family>) =
            families.partition(|family| family.design().is_some());
        let all: Vec<&Family> = drawn.iter().chain(&by_design).copied().collect();
        let programs: Vec<Program> = programs.into_iter().step_by(step).collect();
        let found: Vec<[Option<u64>; 3]> = programs
            .par_iter()
            .map(|(_, is_wrong)| medians([&drawn, &by_design, &all], is_wrong))
            .collect();
        let ways = [0, 1, 2]
            .map(|way| summed(&found.iter().map(|each| each[way]).collect::<Vec<_>>()))
            .join(" | ");
        for at in 0..2 {
            rows[at] += &format!("| {} | {} | {ways} |\n", names[at], programs.len());
        }
        for ((name, _), [families, design, both]) in programs.iter().zip(&found) {
            if let Some(families) = families {
                let is_soon = both.is_some_and(|both| both <= 2 * families);
                assert!(is_soon, "{name}: {families} cases of families, and {both:?} of all");
            }
            let is_later = match (families, design) {
                (Some(families), Some(design)) => *design > (2 * families).max(10),
                (Some(_), None) => true,
                (None, _) => false,
            };
            if is_later {
                let shown = |count: &Option<u64>| count.map_or("-".to_owned(), thousands);
                later += &format!("| {name} | {} | {} |\n", shown(families), shown(design));
            }
        }
    }
    if step > 1 {
        return;
    }
    let tables = [
        PageTable { heads: ["programs", "程序"], rows },
        PageTable { heads: ["found later", "更晚找到"], rows: [later.clone(), later] },
    ];
    check_tables(&tables, "designs_find_faults");
}
