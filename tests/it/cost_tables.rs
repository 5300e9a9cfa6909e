//! The tables of `docs/cost.md` and `docs/offgrid.md`, read, and what prose says about them.

use crate::figures::{Figure, figure};
use crate::pages::page;

/// What `docs/cost.md` says about its own tables, and other pages about them.
pub const COST: &[Figure] = &[
    figure(
        "cost",
        "The cheapest float takes {} to {} times as long",
        "最便宜的浮点阶所用的时间是它的 {} 到 {} 倍",
        || {
            let tiles_come_first = |i: &usize| edges(TILES, *i) < scanline("24.8 DDA", *i);
            assert_eq!((0..8).filter(tiles_come_first).collect::<Vec<_>>(), [1, 2], "25 px, <8 px");
            let prices = drawn_prices().map(|[float, _]| float);
            sorted_ends(prices.to_vec())
        },
    ),
    figure(
        "cost",
        "**Exact for the vertices as given** costs {} to {} times the cheapest rung, {} times on slivers and {} times where corners lie on samples",
        "**对原始顶点精确**的代价是最便宜那一阶的 {} 到 {} 倍，细长三角形上 {} 倍；若顶点正好落在采样点上，过滤器常常拿不定主意，则要 {} 倍",
        || {
            let prices = drawn_prices().map(|[_, given]| given);
            let others = (0..8).filter(|i| ![SLIVER, HALF].contains(i)).map(|i| prices[i]);
            [sorted_ends(others.collect()), vec![prices[SLIVER], prices[HALF]]].concat()
        },
    ),
    figure(
        "cost",
        "beats every float rung of the scanline in every class, by {} to {} times; the book's own takes {} to {} times as long",
        "快 {} 到 {} 倍；书中自己的做法要用 {} 到 {} 倍的时间",
        || {
            let mut values = range(8, |i| {
                cheapest("Coverage by scanline", &FLOATS, i) / scanline("24.8 DDA", i)
            });
            values.extend(range(8, |i| scanline("book", i) / scanline("24.8 DDA", i)));
            values
        },
    ),
    figure(
        "cost",
        "take {} ns a pixel on large triangles where f32 ones take {} or more:",
        "在大三角形上每个像素 {} ns，f32 的却至少要 {}：",
        || {
            let f32s = ["f32 stepped", "f32 direct", "f32 ordered"];
            vec![edges("i32", 0), cheapest("Coverage by edge function", &f32s, 0)]
        },
    ),
    figure(
        "cost",
        "the perspective-correct `plane` in f32 is faster than `affine` on triangles of 1000 px with equal w ({} against {} ns)",
        "在 1000 px、w 相等的三角形上，透视校正的 f32 `plane` 比 `affine` 还快（{} 对 {} ns）",
        || ["plane", "affine"].map(|rung| interpolation(rung, W1)).to_vec(),
    ),
    figure(
        "cost",
        "before the DDA on small triangles: {} against {} at 25 px, {} against {} below 8 px.",
        "在小三角形上胜过 DDA：25 px 时 {} 对 {}，8 px 以下 {} 对 {}。",
        || [1, 2].map(|i| [edges(TILES, i), scanline("24.8 DDA", i)]).concat(),
    ),
    figure(
        "cost",
        "The DDA comes first elsewhere: {} against {} on large triangles, {} against {} on slivers, {} against {} in `half`, {} against {} in `tie`, {} against {} in `far`, {} against {} in `mesh`.",
        "其余各类是 DDA 领先：大三角形 {} 对 {}，细长三角形 {} 对 {}，`half` {} 对 {}，`tie` {} 对 {}，`far` {} 对 {}，`mesh` {} 对 {}。",
        || {
            [0, SLIVER, HALF, TIE, FAR, MESH]
                .map(|i| [scanline("24.8 DDA", i), edges(TILES, i)])
                .concat()
        },
    ),
    figure(
        "cost",
        "one sample at a time, take {} to {} times as long as the tiles",
        "一次问一个采样点，所用的时间是分块的 {} 到 {} 倍",
        || range(8, |i| edges("engine", i) / edges(TILES, i)),
    ),
    figure(
        "cost",
        "16 samples at once: {} ns a pixel on slivers, `engine` {}.",
        "一次问 16 个采样点：细长三角形上每个像素 {} ns，`engine` 则要 {}。",
        || [TILES, "engine"].map(|rung| edges(rung, SLIVER)).to_vec(),
    ),
    figure(
        "cost",
        "with equal w `planes f32 x 16` takes {} ns a pixel and `plane` in f32 scalars {}. Where",
        "w 相等的三角形上，`planes f32 x 16` 每个像素 {} ns，标量 f32 的 `plane` {}。",
        || [PLANES, "plane"].map(|rung| interpolation(rung, W1)).to_vec(),
    ),
    figure(
        "cost",
        "most of the sixteen are thrown away: {} against {} below 8 px, {} against {} on slivers.",
        "十六个里大半是白算的：8 px 以下 {} 对 {}，细长三角形 {} 对 {}。",
        || {
            let both = |i| [PLANES, "plane"].map(|rung| interpolation(rung, i));
            [2, SLIVER].map(both).concat()
        },
    ),
    figure(
        "cost",
        "the worst is {} M against {} M, both at w 1e4, and the planes' is larger only in `far`, {} M against {} M.",
        "最坏是 {} M 对 {} M，都在 w 1e4；`planes` 的误差只在 `far` 里更大，{} M 对 {} M。",
        || {
            let errors = |i| [PLANES, "plane"].map(|rung| cell("Interpolation", "worst", rung, i));
            let larger = |i: &usize| errors(*i)[0] > errors(*i)[1];
            assert_eq!((0..12).filter(larger).collect::<Vec<_>>(), [FAR]);
            let worst = [0, 1].map(|which| range(12, |i| errors(i)[which])[1]);
            assert_eq!(worst, errors(11), "at w 1e4");
            [worst, errors(FAR)].concat()
        },
    ),
    figure(
        "cost",
        "The f64 rung takes {} to {} times the time of reversed f32",
        "f64 这一阶所用的时间是反向 f32 的 {} 到 {} 倍",
        || range(5, |i| cell("Depth", "ns", "f64", i) / cell("Depth", "ns", "f32 reversed", i)),
    ),
    figure(
        "cost",
        "in `half`, where it takes {} times as long as the DDA",
        "它在那里所用的时间是 DDA 的 {} 倍",
        || vec![scanline("adaptive", HALF) / scanline("24.8 DDA", HALF)],
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
        || range(8, |i| antialiasing("exact area", i) / antialiasing("8x8 supersample", i)),
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
const TIE: usize = 5;
const FAR: usize = 6;
pub const MESH: usize = 7;
/// The first column of the tables of interpolation with a ratio of w: all equal.
pub const W1: usize = 8;
/// The rungs in vectors.
const TILES: &str = "tiles i32 x 16";
const PLANES: &str = "planes f32 x 16";
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

/// The prices that the picture at the top states, by class: of the cheapest float, and of what is exact as given.
fn drawn_prices() -> [[f64; 2]; 8] {
    let plot = include_str!("../../docs/cost-price.svg");
    let labels = plot.split("</text>").filter_map(|text| text.rsplit_once('>'));
    let prices = labels.filter_map(|(_, label)| label.rsplit_once(' ')?.1.strip_suffix('x'));
    let prices: Vec<f64> = prices.filter_map(|price| price.parse().ok()).collect();
    let (pairs, rest) = prices.as_chunks();
    assert!(rest.is_empty(), "two for each class: {prices:?}");
    pairs.try_into().expect("eight classes")
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
