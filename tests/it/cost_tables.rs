//! The tables of `docs/cost.md` and `docs/offgrid.md`, read, and what prose says about them.

use crate::figures::{Figure, figure};
use crate::pages::page;

/// What `docs/cost.md` says about its own tables, and other pages about them.
pub const COST: &[Figure] = &[
    figure(
        "cost",
        "the cheapest float takes {} to {} times as long",
        "最便宜的浮点阶所用的时间是它的 {} 到 {} 倍",
        || range(8, |i| cheapest("Coverage by scanline", &FLOATS, i) / scanline("24.8 DDA", i)),
    ),
    figure(
        "cost",
        "**Exact for the vertices as given** costs {} to {} times the cheapest rung, and {} times where corners lie on samples",
        "**对原始顶点精确**的代价是最便宜那一阶的 {} 到 {} 倍；若顶点正好落在采样点上，过滤器常常拿不定主意，则要 {} 倍",
        || {
            let price = |i| {
                let edges = cell("Coverage by edge function", "ns", "adaptive", i);
                scanline("adaptive", i).min(edges) / scanline("24.8 DDA", i)
            };
            let mut prices: Vec<f64> = (0..8).filter(|&i| i != HALF).map(price).collect();
            prices.sort_by(f64::total_cmp);
            vec![prices[0], prices[6], price(HALF)]
        },
    ),
    figure(
        "cost",
        "beats every float rung of the scanline in every class, by {} to {} times; the book's own takes {} to nearly 4 times as long",
        "快 {} 到 {} 倍；书中自己的做法要用 {} 到将近 4 倍的时间",
        || {
            let mut values = range(8, |i| {
                cheapest("Coverage by scanline", &FLOATS, i) / scanline("24.8 DDA", i)
            });
            let book = range(8, |i| scanline("book", i) / scanline("24.8 DDA", i));
            assert!((3.5..4.0).contains(&book[1]), "nearly 4: {book:?}");
            values.push(book[0]);
            values
        },
    ),
    figure(
        "cost",
        "take {} ns a pixel on large triangles where f32 ones take {}:",
        "在大三角形上每个像素 {} ns，f32 的却要 {}：",
        || {
            ["i32", "f32 stepped"]
                .map(|rung| cell("Coverage by edge function", "ns", rung, 0))
                .to_vec()
        },
    ),
    figure(
        "cost",
        "and {} in a million where corners lie on samples",
        "在顶点落在采样点上的那一类里，每百万个中错 {} 个",
        || vec![cell("Coverage by scanline", "wrong", "f64 accumulated", HALF)],
    ),
    figure(
        "cost",
        "{} pixels in a million on large triangles, {} at 25 px, {} below 8 px, {} on slivers",
        "每百万个像素中，大三角形 {} 个，25 px 的 {} 个，8 px 以下的 {} 个，细长三角形 {} 个",
        || (0..4).map(|i| cell("Coverage by scanline", "wrong", "24.8 DDA", i)).collect(),
    ),
    figure(
        "cost",
        "a step of a 24-bit buffer at 990 is {}, of f32 {}, of reversed f32 {}, of f64 {}",
        "在 990 处，24 位缓冲的一级是 {}，f32 是 {}，反向 f32 是 {}，f64 是 {}",
        || [24, 24, 43, 53].map(step_at_990).to_vec(),
    ),
    figure(
        "cost",
        "so half those steps, {} and {}.",
        "所以一级只有一半，即 {} 和 {}。",
        || [25, 54].map(step_at_990).to_vec(),
    ),
    figure(
        "cost",
        "at 990 2^19 = {} times as fine",
        "990 处的一级细了 2^19 = {} 倍",
        || vec![step_at_990(24) / step_at_990(43)],
    ),
    figure(
        "cost",
        "The exact area takes {} to {} times the time of 64 samples",
        "精确面积所用的时间是 64 个采样点的 {} 到 {} 倍",
        || {
            let times = |i| antialiasing("exact area", i) / antialiasing("8x8 supersample", i);
            range(7, |i| times(if i < SLIVER { i } else { i + 1 }))
        },
    ),
    figure(
        "games101",
        "a colour for each sample, at 2 x 2, takes {} to {} times the time of one",
        "在 2 x 2 时所用时间是单个采样点的 {} 到 {} 倍",
        || range(8, |i| antialiasing("2x2 supersample", i) / antialiasing("1x", i)),
    ),
    figure(
        "specimens",
        "by Bresenham, and {} times as much by the exact DDA",
        "用精确的 DDA 则是 {} 倍",
        || {
            let times = |i| cell("Lines", "ns", "exact DDA", i) / cell("Lines", "ns", "f64 DDA", i);
            vec![(0..6).map(times).sum::<f64>() / 6.0]
        },
    ),
    figure(
        "offgrid",
        "a factor of about four, and where ties are many {} to {}; the edge function {} to {} either way",
        "平局多时则是 {} 到 {} 倍；边函数无论哪种情形都是 {} 到 {} 倍",
        || {
            let times =
                |column: usize| off_grid(column).map(move |row| row[column + 1] / row[column]);
            let rows: Vec<f64> = times(0).collect();
            assert!(rows[..2].iter().all(|t| (3.5..4.6).contains(t)), "about four: {rows:?}");
            [sorted_ends(rows[2..].to_vec()), sorted_ends(times(2).collect())].concat()
        },
    ),
];

/// Columns of the tables of coverage.
const SLIVER: usize = 3;
const HALF: usize = 4;
pub const MESH: usize = 7;
/// The first column of the tables of interpolation with a ratio of w: all equal.
pub const W1: usize = 8;
const FLOATS: [&str; 4] = ["f32 accumulated", "f32 direct", "f64 accumulated", "f64 direct"];

/// A cell of a table of `docs/cost.md`: under a heading, of the board whose title begins so.
pub fn cell(heading: &str, title: &str, rung: &str, column: usize) -> f64 {
    let text = page("docs", "cost");
    let (_, section) = text.split_once(&format!("\n## {heading}\n")).expect("a heading");
    let board = section.lines().skip_while(|line| !line.starts_with(title));
    let mut rows = board.take_while(|line| !line.is_empty() && !line.starts_with("```"));
    let row = rows.find_map(|line| line.strip_prefix(rung).filter(|rest| rest.starts_with("  ")));
    let row = row.unwrap_or_else(|| panic!("{heading}, {title}: no row {rung}"));
    let cells: Vec<_> = row.split_whitespace().collect();
    cells[column].trim_end_matches(['<', '*', '+']).parse().expect("a number")
}

pub fn edges(rung: &str, column: usize) -> f64 {
    cell("Coverage by edge function", "ns", rung, column)
}

pub fn scanline(rung: &str, column: usize) -> f64 {
    cell("Coverage by scanline", "ns", rung, column)
}

pub fn interpolation(rung: &str, column: usize) -> f64 {
    cell("Interpolation", "ns", rung, column)
}

fn antialiasing(rung: &str, column: usize) -> f64 {
    cell("Antialiasing", "ns", rung, column)
}

fn cheapest(heading: &str, rungs: &[&str], column: usize) -> f64 {
    rungs.iter().map(|rung| cell(heading, "ns", rung, column)).fold(f64::INFINITY, f64::min)
}

fn sorted_ends(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    vec![values[0], values[values.len() - 1]]
}

/// Smallest and largest value over columns.
pub fn range(columns: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
    sorted_ends((0..columns).map(value).collect())
}

/// Rows of the table of times of `docs/offgrid.md`, those that have a time in `column` and the next.
fn off_grid(column: usize) -> impl Iterator<Item = Vec<f64>> {
    let text = page("docs", "offgrid");
    let (_, section) = text.split_once("\n## Cost, measured\n").unwrap();
    let lines = section.lines().filter(|line| line.contains("ns/"));
    let number = |cell: &str| cell.trim().replace(',', "").parse::<f64>().ok();
    let rows = lines.map(|line| line.split('|').filter_map(number).collect::<Vec<_>>());
    rows.filter(|row| row.len() > column + 1).collect::<Vec<_>>().into_iter()
}

/// A step of 2^-bits of a depth in [0, 1], in units of space at z = 990, between planes at 0.1 and 1000.
fn step_at_990(bits: i32) -> f64 {
    let slope = 1000.0 * 0.1 / ((1000.0 - 0.1) * 990.0 * 990.0);
    0.5f64.powi(bits) / slope
}
