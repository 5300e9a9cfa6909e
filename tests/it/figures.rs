//! The figures that the pages state, each with the words around it in both languages and what
//! computes it: by drawing, by counting, by a formula, or from a table of another page.

use glam::{DVec4, Vec4};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::WordWidth;
use rasterproof_faults::published::PublishedLine as _;
use rasterproof_faults::published::bare;
use rasterproof_faults::published::book_dda::BookDda;
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX};
use rasterproof_faults::published::sysu_strict_t::clip_strict;
use rasterproof_invariants::CATALOGUE;
use rasterproof_registry::engines::{Drawer, TriangleSpecimen};
use rasterproof_registry::published_check::{free_truth, specimen_coverage};
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::clip::MOST_VERTICES;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::chapters::scene;
use rasterproof_verify::cases::named::{Input, find};
use rasterproof_verify::cases::{Case, Shape, families};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::coverage::samples_on_boundary;
use serde_json::Value;

use crate::cost_tables::{COST, MESH, W1, cell, edges, interpolation, range, scanline};
use crate::illustrations::ball;
use crate::pages::page;

/// Figures of a page, by the words around them.
pub struct Figure {
    /// The page's name.
    pub page: &'static str,
    /// English words, `{}` for each figure.
    pub english: &'static str,
    /// The same in Chinese.
    pub chinese: &'static str,
    /// What the figures are.
    pub values: fn() -> Vec<f64>,
}

/// A figure.
pub const fn figure(
    page: &'static str,
    english: &'static str,
    chinese: &'static str,
    values: fn() -> Vec<f64>,
) -> Figure {
    Figure { page, english, chinese, values }
}

/// By chapter.
pub const ALL: &[&[Figure]] =
    &[PIXELS, LINES, TRIANGLES, VALUES, STEPS, CLIPPING, COST, PROOF, EFFECTS];

/// The side, in pixels, of the largest square whose edge functions get one of these words.
fn widest(words: &[WordWidth]) -> Vec<f64> {
    let is_enough = |side_px: &u32| words.contains(&WordWidth::of(side_px << 8, side_px << 8));
    let (mut enough, mut too_wide) = (1, 1 << 23 | 1 << 22);
    assert!(is_enough(&enough) && !is_enough(&too_wide));
    while too_wide - enough > 1 {
        let middle = (enough + too_wide) / 2;
        *(if is_enough(&middle) { &mut enough } else { &mut too_wide }) = middle;
    }
    vec![f64::from(enough)]
}

/// What a scene costs as the page on effects measures it.
fn counted(name: &str, antialias: Antialias, effects: Effects) -> Counters {
    let scene = scene(name, 4.0 / 3.0, 0.0).unwrap();
    let mut target = Target::new(640, 480, antialias, Default::default()).unwrap();
    Drawer::Scanline.render(&scene, &effects, &mut target).unwrap().counters
}

/// Pixels whose samples a plan tells apart.
fn apart(name: &str, antialias: Antialias) -> Vec<f64> {
    vec![counted(name, antialias, Effects::PLANNED).expanded as f64]
}

const EFFECTS: &[Figure] = &[
    figure(
        "effects",
        "{} of 307,200 pixels hold more than a colour",
        "307,200 个像素中只有 {} 个不止一种颜色",
        || apart("facets", Antialias::Supersample(4)),
    ),
    figure("effects", "| 16 (17) | {} of them", "| 16 (17) | 其中 {} 个", || {
        apart("panels", Antialias::Supersample(4))
    }),
    figure("effects", "| 2.9 (3.2) | {} of them", "| 2.9 (3.2) | 其中 {} 个", || {
        apart("panels", Antialias::Multisample4)
    }),
    figure("effects", "| 2.1 (2.2) | {} of them", "| 2.1 (2.2) | 其中 {} 个", || {
        apart("tilted", Antialias::Multisample4)
    }),
    figure(
        "effects",
        "fragments {} against {}, lights {} against {}, samples cleared {} against {}",
        "片元 {} 对 {}，光照 {} 对 {}，清除的采样点 {} 对 {}",
        || {
            let both = [Effects::ALWAYS, Effects::PLANNED];
            let [all, planned] =
                both.map(|effects| counted("facets", Antialias::Supersample(4), effects));
            [
                [all.fragments, planned.fragments],
                [all.lights, planned.lights],
                [all.cleared, planned.cleared],
            ]
            .as_flattened()
            .iter()
            .map(|&count| count as f64)
            .collect()
        },
    ),
];

const PIXELS: &[Figure] = &[
    figure(
        "ch01",
        "The lower triangle covers {} pixels, the upper one {}; row 30 has {} of them",
        "下面的三角形覆盖 {} 个像素，上面的 {} 个；第 30 行有 {} 个",
        || {
            let hits = named("T4");
            let row = |hits: &Coverage| hits.row(30).iter().filter(|&&n| n > 0).count() as f64;
            vec![hits[0].covered() as f64, hits[1].covered() as f64, row(&hits[0]) + row(&hits[1])]
        },
    ),
    figure(
        "ch01",
        "(1024 pixels of 4 bytes: {} apart)",
        "（1024 个 4 字节的像素：行距 {}）",
        || vec![Frame::new(PixelRect::window(1024, 4), 0u32).pitch() as f64],
    ),
    figure(
        "ch01",
        "{} calls of the pixel function outside the screen",
        "像素函数在屏幕外被调用 {} 次",
        || vec![bug("oob")["oob_calls"].as_f64().unwrap()],
    ),
];

const LINES: &[Figure] = &[
    figure(
        "ch02",
        "of the 4,225 lines from (0,0) to (x, y), 0 ≤ x, y ≤ 64, {} drift",
        "的 4,225 条直线里，有 {} 条连它想要的截断高度都偏离了",
        drifting_lines,
    ),
    figure(
        "ch02",
        "Bresenham takes {} ns a pixel and a sum of f64 slopes {}, which is wrong in {} pixels of a million; the exact fraction takes {}.",
        "Bresenham 每像素 {} ns；累加 f64 斜率 {}，每百万像素里错 {} 个；精确分数 {}。",
        || {
            let ns = |rung| cell("Lines", "ns", rung, 0);
            vec![
                ns("Bresenham"),
                ns("f64 DDA"),
                cell("Lines", "wrong", "f64 DDA", 0),
                ns("exact DDA"),
            ]
        },
    ),
];

const TRIANGLES: &[Figure] = &[
    figure(
        "ch02",
        "fan of twelve triangles round the point (8.5, 8.5); {} pixels, each hit once",
        "十二个三角形组成的扇形；{} 个像素，每个命中一次",
        || vec![named("T6").iter().map(Coverage::covered).sum::<u64>() as f64],
    ),
    figure(
        "ch02",
        "difference: {} pixels are missing along the upper edge, {} are too many at the right tip and {} below, and the row of the middle corner, {} pixels, is drawn twice",
        "差异：沿上边缺 {} 个像素，右端的尖角多 {} 个，下方多 {} 个，中间顶点所在的那一行有 {} 个像素画了两遍",
        double_row,
    ),
    figure("ch02", "a row runs from {} to {}", "一行会从 {} 画到 {}", || {
        let ends = &bug("ch3_unclamped")["bbox"];
        vec![ends[0].as_f64().unwrap(), ends[1].as_f64().unwrap()]
    }),
    figure("ch02", "< 2^{31}`$ | {} px square", "< 2^{31}`$ | {} 像素见方", || {
        let holds = |px: &u32| WordWidth::of(px * 256, px * 256) == WordWidth::I32;
        vec![f64::from((1..4000).take_while(holds).last().unwrap())]
    }),
    figure(
        "ch02",
        "scanline as in the book {}, f64 at each row anew {}, **integer DDA {}**, snapping included; edge functions in f32, stepped or direct, {} or {}, in f64 {} or {}, **i32 on E' {}**, i64 {}, i128 {}.",
        "扫描线，照书的写法 {}，每行重新用 f64 计算 {}，**整数 DDA {}**，吸附已算在内；边函数，f32 步进或直接计算 {} 或 {}，f64 是 {} 或 {}，**E' 上的 i32 {}**，i64 {}，i128 {}。",
        || {
            let rows = |rung| cell("Coverage by scanline", "ns", rung, 0);
            let edges = |rung| cell("Coverage by edge function", "ns", rung, 0);
            let mut values = ["book", "f64 direct", "24.8 DDA"].map(rows).to_vec();
            values.extend(
                ["f32 stepped", "f32 direct", "f64 stepped", "f64 direct", "i32", "i64", "i128"]
                    .map(edges),
            );
            values
        },
    ),
    figure(
        "ch02",
        "Random triangles hardly ever have a tie ({} of 100,000 of the family `uniform`)",
        "随机的三角形几乎从不出现平局（用例族 `uniform` 的 100,000 个里有 {} 个）",
        ties_of_random_triangles,
    ),
    figure(
        "ch02",
        "The book's scanline has {} wrong pixels in a million there",
        "书的扫描线在那里每百万像素错 {} 个",
        || vec![cell("Coverage by scanline", "wrong", "book", 0)],
    ),
    figure(
        "ch02",
        "stepped f64 edge functions leave {} holes and double hits in that mesh, and {} wrong pixels in a million",
        "f64 步进的边函数在那张网格里留下 {} 个空洞和重复命中，每百万像素错 {} 个",
        || {
            let cracks = |i| cell("Coverage by edge function", "holes", "f64 stepped", i);
            vec![
                cracks(0) + cracks(1),
                cell("Coverage by edge function", "wrong", "f64 stepped", MESH),
            ]
        },
    ),
];

const VALUES: &[Figure] = &[
    figure(
        "ch03",
        "the worst error of an attribute is {} of its bound and of a depth {}, both with the edge function",
        "属性最坏的误差是其界的 {}，深度是 {}，都出自边函数",
        || {
            let text = page("docs", "verdict");
            let all = text.lines().find(|line| line.starts_with("all  ")).unwrap();
            let cells: Vec<f64> =
                all.split_whitespace().skip(8).map(|c| c.parse().unwrap()).collect();
            assert!(cells[1] > cells[0] && cells[3] > cells[2], "B is the edge function");
            vec![cells[1], cells[3]]
        },
    ),
    figure(
        "ch03",
        "As planes in f32 it takes {} ns a pixel where adding up takes {}; in the offset form with its bound of u (13 D + M), {} in f32 and {} in f64.",
        "写成 f32 的平面，每像素 {} ns，累加则是 {}；用误差界为 u (13 D + M) 的偏移形式，f32 是 {}，f64 是 {}。",
        || {
            ["plane", "affine", "offset f32", "offset f64"]
                .map(|rung| interpolation(rung, W1))
                .to_vec()
        },
    ),
    figure(
        "ch05",
        "attained: {} of the spread at R = 2, 1/3 at R = 4, 1/2 at R = 9, {} at R = 100",
        "R = 2 时是跨度的 {}，R = 4 时 1/3，R = 9 时 1/2，R = 100 时 {}。",
        || [2.0, 100.0].map(affine_error).to_vec(),
    ),
    figure(
        "ch05",
        "| R = 2; R = 100 | error {}; {}, of a range of 2",
        "| R = 2；R = 100 | 误差 {}；{}，而范围只有 2",
        || [2.0, 100.0].map(|r| 2.0 * affine_error(r)).to_vec(),
    ),
    figure(
        "games101",
        "| R = 2; R = 100 | error {}; {}, of a range of 2",
        "| R = 2；R = 100 | 误差 {}；{}，而取值范围是 2",
        || [2.0, 100.0].map(|r| 2.0 * affine_error(r)).to_vec(),
    ),
    figure(
        "ch05",
        "Formula (8) takes {} ns a pixel, v/w over 1/w at each pixel {}, as planes {}, and values without w, added up, {}.",
        "公式 (8) 每像素 {} ns，逐像素算 v/w 除以 1/w 是 {}，写成平面是 {}，而不带 w、一路累加的值是 {}。",
        || {
            ["book (8)", "1/w direct", "plane", "affine"]
                .map(|rung| interpolation(rung, W1))
                .to_vec()
        },
    ),
    figure(
        "ch06",
        "({} ns with f64, {} with f32, {} with 24 bits)",
        "（每像素 f64 是 {} ns，f32 是 {}，24 位是 {}）",
        || ["f64", "f32", "24-bit"].map(|rung| cell("Depth", "ns", rung, 0)).to_vec(),
    ),
    figure(
        "ch11",
        "for a right angle {}, and without the division the light there is {}% too dark",
        "直角时是 {}，若不除以长度，那里的光照就暗了 {}%",
        || vec![0.5f64.sqrt(), 100.0 * (1.0 - 0.5f64.sqrt())],
    ),
    figure(
        "ch11",
        "Of {} such fragments the exercise leaves {}",
        "这样的片元原有 {} 个，做完练习还剩 {} 个",
        || [false, true].map(|exercise| f64::from(ball(exercise).1)).to_vec(),
    ),
];

/// What the book's steps in t give, by its formulas.
const STEPS: &[Figure] = &[
    figure(
        "ch05",
        "of a thousand w_a from 1 to 2 the worst is {} wrong at R = 1e7, {} at 1e6",
        "w_a 取 1 到 2 之间的一千个值，最坏的在 R = 1e7 时错 {}，1e6 时错 {}",
        || {
            // Formula (8) of the values 0 and 1, at t' = 1.
            let wrong = |w_a: f32, ratio: f32| {
                let w_b = w_a * ratio;
                f64::from(w_a / (w_b + (w_a - w_b)) - 1.0).abs()
            };
            let w = || (0..1000u16).map(|k| 1.0 + f32::from(k) / 1000.0);
            let worst = |ratio| w().map(|w_a| wrong(w_a, ratio)).fold(0.0, f64::max);
            vec![worst(1e7), worst(1e6)]
        },
    ),
    figure(
        "ch05",
        "| from 3.99 to 4, values 0 and 1 | t = {}, value {} |",
        "| 从 3.99 到 4，值 0 和 1 | t = {}，值为 {} |",
        || {
            let t = 1.0 / (4.0 - 3.99);
            vec![t, value(10.0, t)]
        },
    ),
    figure(
        "ch05",
        "| row 1 gets t' = {}; at its sample y = 1 it is {}, at a centre y = 1.5 it is {} |",
        "| 第 1 行得到 t' = {}；在它的采样点 y = 1 应是 {}，在像素中心 y = 1.5 应是 {} |",
        || vec![1.0 / 1.2, (1.0 - 0.9) / 1.2, (1.5 - 0.9) / 1.2],
    ),
    figure(
        "ch05",
        "| row 2 gets 1 instead of {} ({} is right)",
        "| 第 2 行得到 1 而不是 {}（正确的是 {}）",
        || vec![2.0 / 1.2, (2.0 - 0.9) / 1.2],
    ),
    figure("ch06", "at (10,1) the depth is {}:", "在 (10,1) 处深度是 {}：", || {
        vec![bug("depth_poison")["z_at_10_1"].as_f64().unwrap()]
    }),
    figure("ch02", "2^{31}`$ | {} px square |", "2^{31}`$ | {} 像素见方 |", || {
        widest(&[WordWidth::I32])
    }),
    figure("ch02", "2^{63}`$ | {} px square |", "2^{63}`$ | {} 像素见方 |", || {
        widest(&[WordWidth::I32, WordWidth::I64])
    }),
    figure(
        "sysu",
        "| products in 32 bits | {} x {} px",
        "| 用 32 位做乘积 | {} x {} px",
        || {
            let first = (1i32..).find(|n| n.checked_mul(*n).is_none()).unwrap();
            vec![f64::from(first); 2]
        },
    ),
];

const CLIPPING: &[Figure] = &[
    figure(
        "ch07",
        "Of 10,000 random edges across w + z = 0, computed from either end in f64, {} crossings differ in a bit.",
        "随机取 10,000 条跨过 w + z = 0 的边，用 f64 从两端各算一次，有 {} 个交点至少差一位。",
        crossings_that_differ,
    ),
    figure(
        "ch07",
        "of 10,000 random pairs with w in (0, 1000) and (-1000, 0), {} get w ≤ 0",
        "w 在 (0, 1000) 和 (-1000, 0) 里的 10,000 对随机的点，有 {} 对得到 w ≤ 0",
        cuts_behind_the_eye,
    ),
    figure(
        "ch07",
        "more each time, 3 + {} in the end",
        "每次多一个，最后是 3 + {}。",
        || vec![MOST_VERTICES as f64 - 3.0],
    ),
];

const PROOF: &[Figure] = &[
    figure(
        "gpus",
        "The edge function takes {} to {} times as long: it asks samples that are not covered",
        "边函数要用 {} 到 {} 倍的时间：它也问没有被覆盖的采样点",
        || range(8, |i| edges("engine", i) / scanline("24.8 DDA", i)),
    ),
    figure(
        "gpus",
        "| edge function | {} | {} | {} | {} | {} | {} | {} | {} |",
        "| 边函数 | {} | {} | {} | {} | {} | {} | {} | {} |",
        || (0..8).map(|i| edges("engine", i)).collect(),
    ),
    figure(
        "gpus",
        "| scanline | {} | {} | {} | {} | {} | {} | {} | {} |",
        "| 扫描线 | {} | {} | {} | {} | {} | {} | {} | {} |",
        || (0..8).map(|i| scanline("24.8 DDA", i)).collect(),
    ),
    figure(
        "gpus",
        "two engines are within a factor of {}.",
        "阶梯里的两个引擎相差不到 {} 倍。",
        || vec![edges("engine", 2) / scanline("24.8 DDA", 2)],
    ),
    figure(
        "stability",
        "px only {} of 100,000 random triangles have a sample exactly on an edge",
        "100,000 个随机三角形里，只有 {} 个有采样点恰好落在边上",
        ties_of_random_triangles,
    ),
    figure("stability", "| {} | `lists` |", "| {} | `lists` |", || vec![CATALOGUE.len() as f64]),
];

fn affine_error(ratio: f64) -> f64 {
    (ratio.sqrt() - 1.0) / (ratio.sqrt() + 1.0)
}

/// Formula (8) with the values 0 and 1 and w from 1 to `far`.
fn value(far: f64, t: f64) -> f64 {
    t / (far + (1.0 - far) * t)
}

fn bug(name: &str) -> Value {
    let text = include_str!("../data/book-bugs.json");
    serde_json::from_str::<Value>(text).unwrap()[name].clone()
}

/// The coverage of each triangle of a named case.
fn named(name: &str) -> Vec<Coverage> {
    let Input::Drawn { case, .. } = find(name).unwrap().input else { panic!("{name} is drawn") };
    let Shape::Triangles { list, .. } = &case.shape else { panic!("{name} has triangles") };
    let each = list.iter().map(|triangle| {
        let mut hits = Coverage::new(case.window, 0);
        Oracle.cover(triangle.corners(), case.window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
        hits
    });
    each.collect()
}

/// Random triangles with a sample on an edge, of 100,000.
fn ties_of_random_triangles() -> Vec<f64> {
    let uniform = families().find(|family| family.name == "uniform").unwrap();
    let has_tie = |case: &Case| {
        let Shape::Triangles { list, .. } = &case.shape else { return false };
        list.iter().any(|t| samples_on_boundary(&t.corners(), case.window) > 0)
    };
    vec![(0..100_000).map(|index| uniform.case(1, index)).filter(has_tie).count() as f64]
}

/// What is wrong with the recorded triangle of chapter 2: missing, extra within its rows, extra below
/// them, and hit twice.
fn double_row() -> Vec<f64> {
    let case = RECORDED.iter().find(|case| case.name == "double_row").unwrap();
    let triangles: Vec<_> = case.corners_px().into_iter().map(bare).collect();
    let window = PixelRect::window(RECORDED_SIDE_PX, RECORDED_SIDE_PX);
    let truth = free_truth(&triangles, window);
    let hits = specimen_coverage(TriangleSpecimen::BookChapter2, &triangles, window).unwrap();
    let last = truth.rows().filter(|(_, row)| row.iter().any(|&n| n > 0)).map(|(y, _)| y).max();
    let mut counts = [0.0; 4];
    for (y_px, row) in hits.rows() {
        for (&drawn, &wanted) in row.iter().zip(truth.row(y_px)) {
            let kind = match (wanted, drawn) {
                (1, 0) => 0,
                (0, 1..) if Some(y_px) <= last => 1,
                (0, 1..) => 2,
                (1, 2..) => 3,
                _ => continue,
            };
            counts[kind] += 1.0;
        }
    }
    counts.to_vec()
}

/// Lines of the book from (0, 0) that leave the height they mean, which is the exact one truncated.
fn drifting_lines() -> Vec<f64> {
    let window = PixelRect::window(65, 65);
    let drifts = |(x, y): (i32, i32)| {
        let (major, minor) = (x.max(y), x.min(y));
        let mut is_off = false;
        // The book's y points up: row 64 is its row 0.
        let ends = [[0.5, 64.5], [f64::from(x) + 0.5, 64.5 - f64::from(y)]];
        let mut visit = |px: i32, row: i32| {
            let (u, v) = if x > y { (px, 64 - row) } else { (64 - row, px) };
            is_off |= v != u * minor / major;
        };
        BookDda.draw(ends, window, &mut visit).unwrap();
        is_off
    };
    let all = (0..65).flat_map(|x| (0..65).map(move |y| (x, y)));
    vec![all.filter(|&end| drifts(end)).count() as f64]
}

/// Numbers in [0, 1), the same on every machine (SplitMix64).
fn random() -> impl FnMut() -> f64 {
    let mut state = 7u64;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn crossings_that_differ() -> Vec<f64> {
    let mut unit = random();
    let place = |p: DVec4| p.w + p.z;
    let mut corner = |low: f64, high: f64| {
        let w = 0.1 + 10.0 * unit();
        let (x, y) = (2.0 * unit() - 1.0, 2.0 * unit() - 1.0);
        DVec4::new(x, y, low + (high - low) * unit(), 1.0) * w
    };
    let differing = (0..10_000).filter(|_| {
        let (a, b) = (corner(-1.0, 1.0), corner(-3.0, -1.0));
        let cut = |a: DVec4, b: DVec4| a + (b - a) * (place(a) / (place(a) - place(b)));
        let (there, back) = (cut(a, b), cut(b, a));
        // z is assigned, so it does not count.
        (there.x, there.y, there.w) != (back.x, back.y, back.w)
    });
    vec![differing.count() as f64]
}

fn cuts_behind_the_eye() -> Vec<f64> {
    let mut unit = random();
    let behind = (0..10_000).filter(|_| {
        let ends = [1000.0, -1000.0].map(|w| Vec4::new(0.0, 0.0, 0.0, (w * unit()) as f32));
        clip_strict(&ends)[0].w <= 0.0
    });
    vec![behind.count() as f64]
}
