//! The figures that the pages state, and what computes each: by drawing, by counting, by a formula, or from a table of
//! another page. [`crate::pages`] says how a page names them.

use std::collections::BTreeMap;

use glam::{DVec4, Vec4};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::raster::edge_function::WordWidth;
use rasterproof_faults::published::PublishedLine as _;
use rasterproof_faults::published::bare;
use rasterproof_faults::published::book_dda::BookDda;
use rasterproof_faults::published::book_triangle::BookChapter2;
use rasterproof_faults::published::catalogue::{RECORDED, RECORDED_SIDE_PX};
use rasterproof_faults::published::sysu_strict_t::clip_strict;
use rasterproof_invariants::CATALOGUE;
use rasterproof_judge::league::League;
use rasterproof_precision::cost::{Choice, Price, Priced, Recorded, prices};
use rasterproof_registry::engines::Drawer;
use rasterproof_registry::published_check::{free_truth, specimen_coverage};
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::clip::MOST_VERTICES;
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::scene::Scene;
use rasterproof_report::frame_comparison::differing;
use rasterproof_teaching::by_hand::Values;
use rasterproof_verify::cases::named::{Input, find};
use rasterproof_verify::cases::{Case, Shape, families};
use rasterproof_verify::comparison::oracle_coverage;
use rasterproof_verify::oracle::coverage::samples_on_boundary;
use serde_json::Value;

use crate::book::bugs;
use crate::diagrams;
use crate::illustrations::ball;
use crate::pages::{page, read};
use crate::scenes::{still, target_of};

/// Fragments of a scene, how many of them an effect is computed for with everything on and by the plan, and the pixels
/// that are wrong without it.
fn pays(name: &str, effect: Effect) -> Vec<f64> {
    let without = Effects::PLANNED.with(effect, Mode::Never);
    let [all, planned, without] = [Effects::ALWAYS, Effects::PLANNED, without]
        .map(|effects| drawn(&still(name), Antialias::None, effects));
    let wrong = differing(&planned.picture, &without.picture);
    let counts = [
        planned.counters.fragments,
        effect.calls(&all.counters),
        effect.calls(&planned.counters),
        wrong,
    ];
    counts.map(|count| count as f64).to_vec()
}

/// Of the league: the rows of triangles, those without a wrong pixel by their own convention, those that no convention
/// explains, and those whose meshes have no hole and no pixel that is drawn twice.
fn league_answer() -> Vec<f64> {
    let league: League = serde_json::from_str(&read("docs/league.json")).unwrap();
    let mut counts = [0; 5];
    for row in &league.rows {
        let Some(triangles) = &row.triangles else { continue };
        let [_, holes, doubles] = row.meshes;
        let found = triangles.by_convention.as_ref();
        let kinds = [
            true,
            found.is_some_and(|score| score.wrong == 0),
            found.is_none(),
            holes == 0,
            doubles == 0,
        ];
        counts.iter_mut().zip(kinds).for_each(|(count, holds)| *count += u32::from(holds));
    }
    counts.map(f64::from).to_vec()
}

/// Every figure by its name. Where there are several, the pages add `.1`, `.2` and so on to the name.
pub const ALL: &[(&str, Values)] = &[
    ("league-answer", league_answer),
    ("drawn-areas", diagrams::areas),
    ("drawn-signs", diagrams::signs),
    ("drawn-rows", diagrams::rows),
    ("drawn-lattices", diagrams::lattices),
    ("drawn-corner", diagrams::corner),
    ("drawn-cosines", diagrams::cosines),
    ("drawn-samples", diagrams::samples),
    ("drawn-share", diagrams::share),
    ("drawn-shares", diagrams::shares),
    ("drawn-depths", diagrams::depths),
    ("lessons", crate::terms::lessons),
    ("apart-facets", || apart("facets", Antialias::Supersample(4))),
    ("apart-panels-supersampled", || apart("panels", Antialias::Supersample(4))),
    ("apart-panels-multisampled", || apart("panels", Antialias::Multisample4)),
    ("apart-tilted-multisampled", || apart("tilted", Antialias::Multisample4)),
    ("pays-highlights", || pays("highlights", Effect::Specular)),
    ("pays-mip-maps", || pays("mip-maps", Effect::MipMaps)),
    ("pays-anisotropy", || pays("anisotropy", Effect::Anisotropy)),
    ("pays-shadows", || pays("shadows", Effect::Shadows)),
    ("pays-fog", || pays("fog", Effect::Fog)),
    ("pays-cut-outs", || pays("cut-outs", Effect::AlphaTest)),
    ("pays-panes", || pays("panes", Effect::Blending)),
    ("pays-layers", || pays("layers", Effect::Layers)),
    ("t4-pixels", || {
        let hits = named("T4");
        let row = |hits: &Coverage| hits.row(30).iter().filter(|&&n| n > 0).count() as f64;
        vec![hits[0].covered() as f64, hits[1].covered() as f64, row(&hits[0]) + row(&hits[1])]
    }),
    ("calls-outside", || vec![bug("oob")["oob_calls"].as_f64().unwrap()]),
    ("drifting-lines", drifting_lines),
    ("t6-pixels", || vec![named("T6").iter().map(Coverage::covered).sum::<u64>() as f64]),
    ("double-row", double_row),
    ("unclamped-row", || {
        let ends = &bug("ch3_unclamped")["bbox"];
        vec![ends[0].as_f64().unwrap(), ends[1].as_f64().unwrap()]
    }),
    ("random-ties", ties_of_random_triangles),
    ("f64-stepped-cracks", || {
        let hit = |times: &str| {
            let title = format!("pixels inside the mesh that {times}");
            cell("Coverage by edge function", &title, "f64 stepped", MESH)
        };
        vec![hit("no triangle") + hit("two triangles")]
    }),
    ("worst-errors", || {
        let text = read("docs/differential.txt");
        let all = text.lines().find(|line| line.trim_start().starts_with("all  ")).unwrap();
        let cells: Vec<f64> = all.split_whitespace().skip(8).map(|c| c.parse().unwrap()).collect();
        assert!(cells[1] > cells[0] && cells[3] > cells[2], "B is the edge function");
        vec![cells[1], cells[3]]
    }),
    ("affine-error", || [2.0, 100.0].map(affine_error).to_vec()),
    ("affine-error-of-2", || [2.0, 100.0].map(|r| 2.0 * affine_error(r)).to_vec()),
    ("right-angle", || vec![0.5f64.sqrt(), 100.0 * (1.0 - 0.5f64.sqrt())]),
    ("hairs", || [false, true].map(|exercise| f64::from(ball(exercise).1)).to_vec()),
    ("formula-8-worst", || {
        // Formula (8) of the values 0 and 1, at t' = 1.
        let wrong = |w_a: f32, ratio: f32| {
            let w_b = w_a * ratio;
            f64::from(w_a / (w_b + (w_a - w_b)) - 1.0).abs()
        };
        let w = || (0..1000u16).map(|k| 1.0 + f32::from(k) / 1000.0);
        let worst = |ratio| w().map(|w_a| wrong(w_a, ratio)).fold(0.0, f64::max);
        vec![worst(1e7), worst(1e6)]
    }),
    ("formula-8-two-ends", || {
        let t = 1.0 / (4.0 - 3.99);
        vec![t, value(10.0, t)]
    }),
    ("t-of-row-1", || vec![1.0 / 1.2, (1.0 - 0.9) / 1.2, (1.5 - 0.9) / 1.2]),
    ("t-of-row-2", || vec![2.0 / 1.2, (2.0 - 0.9) / 1.2]),
    ("depth-poison", || vec![bug("depth_poison")["z_at_10_1"].as_f64().unwrap()]),
    ("plain-i32", || {
        // The side of a square whose edge functions themselves fit 32 bits, without and with the step beyond it.
        let fits = |side_px: &i32| (side_px * SUBPIXELS).checked_mul(side_px * SUBPIXELS).is_some();
        let widest = (1..).take_while(fits).last().unwrap();
        vec![f64::from(widest), f64::from(widest - 1)]
    }),
    ("widest-i32", || widest(&[WordWidth::I32])),
    ("widest-i64", || widest(&[WordWidth::I32, WordWidth::I64])),
    ("square-overflow", || {
        let first = (1i32..).find(|n| n.checked_mul(*n).is_none()).unwrap();
        vec![f64::from(first)]
    }),
    ("crossings-that-differ", crossings_that_differ),
    ("cuts-behind-the-eye", cuts_behind_the_eye),
    ("corners-added", || vec![MOST_VERTICES as f64 - 3.0]),
    ("edges-over-scanline", || range(8, |i| edges("engine", i) / scanline("24.8 DDA", i))),
    ("edges-over-scanline-small", || vec![edges("engine", 2) / scanline("24.8 DDA", 2)]),
    ("edges-8-cases", || {
        let text = read("docs/certificates/edges-8.json");
        let certificate: Value = serde_json::from_str(&text).unwrap();
        vec![certificate["done"]["cases"].as_f64().unwrap()]
    }),
    ("planted-faults", planted_faults),
    ("invariants", || vec![CATALOGUE.len() as f64]),
    ("cheapest-float", || {
        let tiles_come_first = |i: &usize| edges(TILES, *i) < scanline("24.8 DDA", *i);
        let classes: Vec<_> = (0..8).filter(tiles_come_first).collect();
        assert_eq!(classes, [1, 7], "25 px and mesh");
        let prices = drawn_prices().map(|[float, _]| float);
        sorted_ends(prices.to_vec())
    }),
    ("exact-as-given", || {
        let prices = drawn_prices().map(|[_, given]| given);
        let others = (0..8).filter(|i| ![SLIVER, HALF].contains(i)).map(|i| prices[i]);
        [sorted_ends(others.collect()), vec![prices[SLIVER], prices[HALF]]].concat()
    }),
    ("scanline-lead", || {
        let mut values =
            range(8, |i| cheapest("Coverage by scanline", &FLOATS, i) / scanline("24.8 DDA", i));
        values.extend(range(8, |i| scanline("book", i) / scanline("24.8 DDA", i)));
        values
    }),
    ("cheapest-f32-edges", || {
        let f32s = ["f32 stepped", "f32 direct", "f32 ordered"];
        vec![cheapest("Coverage by edge function", &f32s, 0)]
    }),
    ("engine-over-tiles", || range(8, |i| edges("engine", i) / edges(TILES, i))),
    ("f64-over-reversed", || {
        let times = |i| cell("Depth", "ns", "f64", i) / cell("Depth", "ns", "f32 reversed", i);
        vec![(0..5).map(times).sum::<f64>() / 5.0]
    }),
    ("adaptive-over-dda", || vec![scanline("adaptive", HALF) / scanline("24.8 DDA", HALF)]),
    ("steps-at-990", || [24, 24, 43, 53].map(step_at_990).to_vec()),
    ("half-steps-at-990", || [25, 54].map(step_at_990).to_vec()),
    ("reversed-finer", || vec![step_at_990(24) / step_at_990(43)]),
    ("exact-area-over-64", || {
        range(8, |i| antialiasing("exact area", i) / antialiasing("8x8 supersample", i))
    }),
    ("four-over-one-sample", || {
        range(8, |i| antialiasing("2x2 supersample", i) / antialiasing("1x", i))
    }),
    ("exact-line-over-f64", || {
        let times = |i| cell("Lines", "ns", "exact DDA", i) / cell("Lines", "ns", "f64 DDA", i);
        vec![(0..6).map(times).sum::<f64>() / 6.0]
    }),
    ("off-grid-times", || {
        let times = |column: usize| off_grid(column).map(move |row| row[column + 1] / row[column]);
        let rows: Vec<f64> = times(0).collect();
        assert!(rows[..2].iter().all(|t| (3.5..4.6).contains(t)), "about four: {rows:?}");
        [sorted_ends(rows[2..].to_vec()), sorted_ends(times(2).collect())].concat()
    }),
];

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

/// A frame as the page on effects measures it.
fn drawn(scene: &Scene, antialias: Antialias, effects: Effects) -> Rendered {
    Drawer::Scanline.render(scene, &effects, &mut target_of(640, 480, antialias)).unwrap()
}

fn counted(name: &str, antialias: Antialias, effects: Effects) -> Counters {
    drawn(&still(name), antialias, effects).counters
}

/// Pixels whose samples a plan tells apart.
fn apart(name: &str, antialias: Antialias) -> Vec<f64> {
    vec![counted(name, antialias, Effects::PLANNED).expanded as f64]
}

/// Rows of the matrix of invariants and planted faults, which end in marks and a count; the last line sums them up.
fn planted_faults() -> Vec<f64> {
    let matrix = read("snapshots/mutants.snap");
    let is_mutant = |line: &&str| {
        let mut words = line.split_whitespace().rev();
        words.next().is_some_and(|n| n.parse::<u32>().is_ok())
            && words.next().is_some_and(|marks| marks.contains(['.', '#']))
    };
    vec![matrix.lines().filter(is_mutant).count() as f64]
}

fn affine_error(ratio: f64) -> f64 {
    (ratio.sqrt() - 1.0) / (ratio.sqrt() + 1.0)
}

/// Formula (8) with the values 0 and 1 and w from 1 to `far`.
fn value(far: f64, t: f64) -> f64 {
    t / (far + (1.0 - far) * t)
}

fn bug(name: &str) -> Value {
    bugs()[name].clone()
}

fn named(name: &str) -> Vec<Coverage> {
    let Input::Drawn { case, .. } = find(name).unwrap().input else { panic!("{name} is drawn") };
    let Shape::Triangles { list, .. } = &case.shape else { panic!("{name} has triangles") };
    let one = |triangle| oracle_coverage(std::slice::from_ref(triangle), case.window);
    list.iter().map(one).collect()
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
    let hits = specimen_coverage(&BookChapter2, &triangles, window).unwrap();
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

/// Columns of the tables of coverage.
const SLIVER: usize = 3;
const HALF: usize = 4;
const MESH: usize = 7;
const TILES: &str = "tiles i32 x 16";
const FLOATS: [&str; 4] = ["f32 accumulated", "f32 direct", "f64 accumulated", "f64 direct"];

/// A table of `docs/cost.md`, under a heading, whose title begins so: the names of its columns, and its rows by name.
fn board(heading: &str, title: &str) -> (Vec<String>, BTreeMap<String, Vec<f64>>) {
    let boards = Recorded::read(&read("docs/cost.json")).unwrap().boards;
    let board = boards.iter().find(|board| board.ladder.title() == heading).expect(heading);
    let measure = board.measures.iter().position(|measure| measure.title.starts_with(title));
    assert!(title == "ns" || measure.is_some(), "no table {title}");
    let value = |choice: usize, column: usize| match measure {
        Some(measure) => board.error(choice, column, measure),
        None => board.time(choice, column).map(|time| time.pixel_ns.median),
    };
    let columns: Vec<usize> = board.columns_run().collect();
    let row = |(number, choice): (usize, &Choice)| {
        let values = columns.iter().map(|&column| value(number, column).unwrap_or(f64::NAN));
        (choice.name.to_string(), values.collect())
    };
    let rows = board.choices.iter().enumerate().map(row).collect();
    (columns.iter().map(|&column| board.columns[column].name.to_string()).collect(), rows)
}

fn cell(heading: &str, title: &str, choice: &str, column: usize) -> f64 {
    let (_, rows) = board(heading, title);
    rows.get(choice).unwrap_or_else(|| panic!("{heading}, {title}: no row {choice}"))[column]
}

/// The cell that a page names, such as `Lines, ns, Bresenham, large`.
pub fn cost_cell(reference: &str) -> f64 {
    let parts: Vec<_> = reference.split(", ").collect();
    let [heading, title, choice, column] = parts[..] else { panic!("{reference}: not four parts") };
    let (names, _) = board(heading, title);
    let column = names.iter().position(|name| name == column);
    cell(heading, title, choice, column.unwrap_or_else(|| panic!("{reference}: one of {names:?}")))
}

/// The prices that the picture at the top states, by class: of the cheapest float, and of what is exact as given.
fn drawn_prices() -> [[f64; 2]; 8] {
    let recorded = Recorded::read(&read("docs/cost.json")).unwrap();
    let median = |priced: Option<Priced>| priced.expect("a price").ratio.median;
    let price = |price: Price| [median(price.unpromised), median(price.given)];
    let prices: Vec<_> = prices(&recorded.boards).into_iter().map(price).collect();
    prices.try_into().expect("eight classes")
}

fn edges(choice: &str, column: usize) -> f64 {
    cell("Coverage by edge function", "ns", choice, column)
}

fn scanline(choice: &str, column: usize) -> f64 {
    cell("Coverage by scanline", "ns", choice, column)
}

fn antialiasing(choice: &str, column: usize) -> f64 {
    cell("Antialiasing", "ns", choice, column)
}

fn cheapest(heading: &str, choices: &[&str], column: usize) -> f64 {
    choices.iter().map(|choice| cell(heading, "ns", choice, column)).fold(f64::INFINITY, f64::min)
}

fn sorted_ends(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    vec![values[0], values[values.len() - 1]]
}

fn range(columns: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
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
