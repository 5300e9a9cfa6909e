//! What the book's own code drew (`tests/data/book-*`), against its specimens: hit counts must be
//! equal, double hits included, and each recorded fault must show.

use std::collections::HashMap;

use glam::{DVec2, DVec4};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;
use rasterproof_faults::published::book_dda::BookDda;
use rasterproof_faults::published::book_final::{BookFinal, clip};
use rasterproof_faults::published::book_near_clip::clip_near;
use rasterproof_faults::published::book_triangle::{BookChapter2, cover_book};
use rasterproof_faults::published::{
    ClipVertex, NoResult, Published, PublishedLine, RealTriangle, bare,
};
use rasterproof_judge::text;
use rasterproof_registry::engines::{Specimen, find};
use serde_json::Value;

use crate::protocol::ask;
use crate::recorded::items;

/// The book's screen has 64 rows and columns.
const SIDE: u32 = 64;

/// The first record tells how the others were made.
fn records(name: &str) -> Vec<Value> {
    crate::recorded::records(name).split_off(1)
}

/// The deliberate faults and the numbers that were recorded of each.
pub fn bugs() -> Value {
    serde_json::from_str(include_str!("../data/book-bugs.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// A point of two numbers, or the first two of more.
fn point(value: &Value) -> DVec2 {
    DVec2::new(number(&value[0]), number(&value[1]))
}

/// A position of the book, where y points up and samples are at whole numbers, as a window pixel.
fn in_window(p: DVec2, side: u32) -> [f64; 2] {
    [p.x + 0.5, f64::from(side) - p.y - 0.5]
}

fn positions(points: &Value, side: u32) -> Vec<[f64; 2]> {
    items(points).iter().map(|p| in_window(point(p), side)).collect()
}

fn triangle(points: &[[f64; 2]]) -> RealTriangle {
    bare([points[0], points[1], points[2]])
}

type Hits = HashMap<(i64, i64), u64>;

/// Recorded rows `[y, x0, count, ...]`, those within the window.
fn recorded(rows: &Value, side: u32) -> Hits {
    let mut hits = Hits::new();
    for row in items(rows) {
        let numbers: Vec<i64> = items(row).iter().map(|n| n.as_i64().unwrap()).collect();
        for (i, &count) in numbers[2..].iter().enumerate() {
            let (y, x) = (numbers[0], numbers[1] + i as i64);
            if y < i64::from(side) && x < i64::from(side) {
                assert!(hits.insert((y, x), count as u64).is_none(), "one count for each pixel");
            }
        }
    }
    hits
}

/// The hits of what a function draws on a screen of so many rows and columns.
fn drawn(side: u32, draw: impl FnOnce(PixelRect, &mut dyn FnMut(i32, i32))) -> Hits {
    let mut hits = Hits::new();
    draw(PixelRect::window(side, side), &mut |x, y| {
        *hits.entry((i64::from(side) - 1 - i64::from(y), x.into())).or_default() += 1;
    });
    hits
}

fn hits_of(specimen: &dyn Published, triangle: &RealTriangle, side: u32) -> Hits {
    drawn(side, |window, hit| {
        let mut emit = |span: Span| (span.x0_px..span.x1_px).for_each(|x| hit(x, span.y_px));
        specimen.cover(triangle, window, &mut emit).unwrap();
    })
}

fn line(points: &Value) -> Hits {
    let ends = positions(points, SIDE);
    drawn(SIDE, |window, hit| BookDda.draw([ends[0], ends[1]], window, hit).unwrap())
}

/// By the engines that speak the protocol. The recorder ran chapter 11 on 65 x 65 pixels; a window of 64 is a part of that.
#[test]
fn book_triangles_as_recorded() {
    let (mut twice, mut differ) = (0, 0);
    for record in records("book-triangles") {
        let id = &record["id"];
        let chapter_2_rows = recorded(&record["ch2"], SIDE);
        assert_eq!(chapter_2(&record["v"]), chapter_2_rows, "{id}: chapter 2");
        twice += chapter_2_rows.values().filter(|&&n| n > 1).count();
        for side in [SIDE, SIDE + 1] {
            let triangle = triangle(&positions(&record["v"], side));
            let mut expected = chapter_2_rows.clone();
            for (name, engine) in
                [("ch2", "book-ch2"), ("ch11", "book-ch11"), ("ch11_fixed", "book-ch11-fixed")]
            {
                // A text says that a version draws what the one before it draws.
                if record[name].is_array() {
                    expected = recorded(&record[name], side);
                }
                differ += usize::from(name == "ch11" && expected != chapter_2_rows);
                let Some(Specimen::Triangle(specimen)) = find(engine).unwrap().specimen else {
                    panic!("{engine} draws triangles")
                };
                if name != "ch2" || side == SIDE {
                    let actual = hits_of(specimen, &triangle, side);
                    assert_eq!(actual, expected, "{id}: {engine}, {side}");
                }
            }
        }
    }
    assert!(twice > 5000 && differ > 60, "{twice} pixels drawn twice, {differ} clipped or empty");
}

/// Worst and mean distance of the varying from the pixel, pixels whose varying leaves the range of
/// the corners, and by how much at worst, where the screen position itself is the varying.
fn attribute_errors(points: &Value, exercise: bool) -> [f64; 4] {
    let side = SIDE + 1;
    let mut corners = triangle(&positions(points, side));
    for (corner, v) in corners.iter_mut().zip(items(points)) {
        corner.varying = point(v);
    }
    let low = corners.map(|c| c.varying).into_iter().reduce(DVec2::min).unwrap();
    let high = corners.map(|c| c.varying).into_iter().reduce(DVec2::max).unwrap();
    let (mut worst, mut sum, mut pixels, mut outside, mut overshoot) = (0f64, 0.0, 0.0, 0.0, 0f64);
    BookFinal { exercise }
        .fragments(&corners, PixelRect::window(side, side), &mut |f| {
            let at = DVec2::new(f.x_px.into(), f64::from(side) - 1.0 - f64::from(f.y_px));
            let error = (f.varying - at).abs().max_element();
            let beyond = (low - f.varying).max(f.varying - high).max_element();
            worst = worst.max(error);
            sum += error;
            pixels += 1.0;
            outside += if beyond > 1e-9 { 1.0 } else { 0.0 };
            overshoot = overshoot.max(beyond);
        })
        .unwrap();
    [worst, sum / f64::max(pixels, 1.0), outside, overshoot]
}

#[test]
fn book_attributes_as_recorded() {
    let mut fixed = 0;
    for record in records("book-triangles") {
        for (exercise, name) in [(false, "attr"), (true, "attr_fixed")] {
            let actual = attribute_errors(&record["v"], exercise);
            for (i, (actual, target)) in actual.iter().zip(items(&record[name])).enumerate() {
                // Recorded with six digits.
                let target = number(target);
                assert!(
                    (actual - target).abs() <= 1e-5 * target.abs().max(1e-3),
                    "{} {name}[{i}]: {actual}, recorded {target}",
                    record["id"]
                );
            }
        }
        fixed += usize::from(record["attr"] != record["attr_fixed"]);
    }
    assert!(fixed > 100, "the exercise changes values of {fixed} triangles");
}

/// Fragments of the final triangle for corners `[x, y, z, w]`, by the book's row and column.
fn final_values(corners: &Value, exercise: bool) -> HashMap<(i64, i64), (f64, DVec2)> {
    let side = SIDE + 1;
    let list = items(corners);
    let mut triangle = triangle(&positions(corners, side));
    for (i, corner) in triangle.iter_mut().enumerate() {
        (corner.depth, corner.w) = (number(&list[i][2]), number(&list[i][3]));
        corner.varying = DVec2::new(i as f64, number(&list[i][1]));
    }
    let mut values = HashMap::new();
    BookFinal { exercise }
        .fragments(&triangle, PixelRect::window(side, side), &mut |f| {
            let row = i64::from(side) - 1 - i64::from(f.y_px);
            values.entry((row, f.x_px.into())).or_insert((f.depth, f.varying));
        })
        .unwrap();
    values
}

/// Chapter 2 at exactly the recorded numbers: there and back again may round.
fn chapter_2(points: &Value) -> Hits {
    drawn(SIDE, |window, hit| {
        let emit = |span: Span| (span.x0_px..span.x1_px).for_each(|x| hit(x, span.y_px));
        cover_book([0, 1, 2].map(|i| point(&points[i])), window, true, emit).unwrap();
    })
}

/// A quad's hits, split (0, 1, 2) and (0, 2, 3).
fn quad(points: &Value) -> Hits {
    let p = positions(points, SIDE);
    let mut hits = hits_of(&BookChapter2, &bare([p[0], p[1], p[2]]), SIDE);
    for (pixel, n) in hits_of(&BookChapter2, &bare([p[0], p[2], p[3]]), SIDE) {
        *hits.entry(pixel).or_default() += n;
    }
    hits
}

fn at(pixel: &Value) -> (i64, i64) {
    (pixel[1].as_i64().unwrap(), pixel[0].as_i64().unwrap())
}

fn count(hits: &Hits, pixel: &Value) -> u64 {
    hits.get(&at(pixel)).copied().unwrap_or(0)
}

/// Pixels deep inside a convex quad, their four neighbours inside as well, that are never drawn.
fn cracks(corners: &Value, hits: &Hits) -> usize {
    let corners = [0, 1, 2, 3].map(|i| point(&corners[i]));
    let inside = |p: DVec2| {
        (0..4).all(|i| (corners[(i + 1) % 4] - corners[i]).perp_dot(p - corners[i]) > 0.0)
    };
    let deep = |y: i64, x: i64| {
        let p = DVec2::new(x as f64, y as f64);
        [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].into_iter().all(|step| inside(p + step))
    };
    let side = i64::from(SIDE);
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (y, x)));
    pixels.filter(|&(y, x)| deep(y, x) && !hits.contains_key(&(y, x))).count()
}

/// Every entry of `book-bugs.json` shows; `name` is its key.
fn shows(name: &str, bug: &Value) {
    match name {
        "note" => {}
        "double_row" => {
            let hits = chapter_2(&bug["v"]);
            assert!((2..=8).all(|x| hits[&(5, x)] == 2), "{hits:?}");
        }
        "no_sample" => {
            assert_eq!(count(&chapter_2(&bug["v"]), &bug["px"][0]), bug["times"].as_u64().unwrap());
        }
        "floor_left" => {
            let hits = chapter_2(&bug["v"]);
            assert!(items(&bug["extra"]).iter().all(|pixel| count(&hits, pixel) == 1));
        }
        "y_phase" => {
            let row = bug["extra_row"].as_i64().unwrap();
            assert!(chapter_2(&bug["v"]).keys().any(|pixel| pixel.0 == row));
        }
        "fp_drift" => {
            assert_eq!(count(&chapter_2(&bug["v"]), &bug["wrong"]), 1);
            let other = chapter_2(&bug["other"]);
            assert!(count(&other, &bug["other_extra"]) > 0);
            assert_eq!(count(&other, &bug["other_missing"]), 0);
        }
        "shared_edge_double" => {
            let twice = quad(&bug["quad"]).values().filter(|&&n| n > 1).count();
            assert_eq!(twice, 10, "the diagonal");
        }
        "shared_edge_crack" => {
            assert_eq!(count(&quad(&bug["quad"]), &bug["never_drawn"]), 0);
            assert_eq!(
                cracks(&bug["big"], &quad(&bug["big"])) as u64,
                bug["big_cracks"].as_u64().unwrap()
            );
        }
        "degenerate_drawn" => {
            let hits = chapter_2(&bug["v"]);
            assert_eq!(hits.values().sum::<u64>(), bug["px"].as_u64().unwrap());
        }
        "tiny_dropped" => assert_eq!(chapter_2(&bug["v"]), Hits::new()),
        // Truncation towards zero leaves row 0 with the edge of height -0.75, one pixel too wide.
        "negative_trunc" => assert!(chapter_2(&bug["v"]).contains_key(&(0, 3))),
        // Their calls outside the screen are counted next to the loops, in `book_triangle`.
        "oob" | "ch3_unclamped" => {}
        "int_overflow_runaway" => {
            let triangle = triangle(&positions(&bug["v"], SIDE));
            let window = PixelRect::window(SIDE, SIDE);
            let refused = BookChapter2.cover(&triangle, window, &mut |_| ()).unwrap_err();
            assert!(matches!(refused, NoResult::IntOverflow(x) if x >= 3e9 - 1.0), "{refused}");
        }
        "depth_poison" => {
            let z = final_values(&bug["xyzw"], false)[&(1, 10)].0;
            assert!((z - number(&bug["z_at_10_1"])).abs() < 1e-6, "{z}");
        }
        "z_not_clamped_after_fix" => {
            let z = final_values(&bug["xyzw"], true)[&(4, 9)].0;
            assert!((z - number(&bug["z_at_9_4"])).abs() < 1e-6, "{z}");
        }
        "t_divzero" => {
            let (_, varying) = final_values(&bug["xyzw"], false)[&at(&bug["px"])];
            assert_eq!(varying.x.to_string(), bug["varying"].as_str().unwrap());
        }
        "clip7_on_plane" => near_clip_loses(bug),
        "clip_stack_overflow" => assert_eq!(clip_overflows(bug), 6),
        "line_drift" => {
            let pixels = line(&bug["v"]);
            let is_drawn = |row: &Value| pixels.contains_key(&(row.as_i64().unwrap(), 10));
            assert!(is_drawn(&bug["at_x10"]) && !is_drawn(&bug["exact"]), "{pixels:?}");
        }
        "line_no_end" => {
            let pixels = line(&bug["v"]);
            assert_eq!(pixels.values().sum::<u64>(), 3);
            assert_eq!(count(&pixels, &bug["missing"]), 0);
        }
        _ => panic!("book-bugs.json has an entry '{name}' that no test shows"),
    }
}

/// A triangle with an edge in the near plane is wholly inside, and nothing of it is drawn.
fn near_clip_loses(bug: &Value) {
    let corners = [0, 1, 2].map(|i| {
        let w = number(&bug["w"][i]);
        let position = (point(&bug["xy"][i]) * w).extend(0.0).extend(w);
        ClipVertex { position, varying: DVec2::ZERO }
    });
    let polygon = clip_near(corners, number(&bug["boundary"]));
    assert_eq!(polygon.len(), 4);
    assert!(polygon[2].position.is_nan(), "{polygon:?}");
    let on_screen =
        |v: &ClipVertex| in_window(v.position.truncate().truncate() / v.position.w, SIDE);
    let mut drawn = 0;
    for i in [1, 2] {
        let triangle = bare([&polygon[0], &polygon[i], &polygon[i + 1]].map(on_screen));
        // A row that is not a number is refused here, and lights nothing there.
        let _ = BookChapter2.cover(&triangle, PixelRect::window(SIDE, SIDE), &mut |_| drawn += 1);
    }
    assert_eq!(drawn, 0);
}

/// Size of the array that the recorded clip overflows.
fn clip_overflows(bug: &Value) -> usize {
    let text = bug["clip_xyzw_hex"].as_str().unwrap();
    let n: Vec<f64> = text.split(' ').map(|word| text::number(word).unwrap()).collect();
    let vertex = |i: usize| {
        let position = DVec4::from_slice(&n[4 * i..]);
        ClipVertex { position, varying: DVec2::ZERO }
    };
    match clip([0, 1, 2].map(vertex)) {
        Err(NoResult::ArrayOverflow(size)) => size,
        other => panic!("{other:?}"),
    }
}

#[test]
fn book_bugs_show() {
    let bugs = bugs();
    let bugs = bugs.as_object().unwrap();
    assert_eq!(bugs.len(), 21);
    for (name, bug) in bugs {
        println!("{name}: {bug}");
        shows(name, bug);
    }
}

/// A request for each of these positions, window pixels on the screen.
fn requests(verb: &str, side: u32, all: &[Vec<[f64; 2]>]) -> Vec<u8> {
    let mut text = String::from("HELLO 1\n");
    for (id, points) in all.iter().enumerate() {
        let numbers: Vec<_> = points.iter().flatten().map(|v| format!("{v:?}")).collect();
        text += &format!("{verb} {id} {side} {side} {}\n", numbers.join(" "));
    }
    text.into_bytes()
}

/// The hits of each answer, by the book's row and column; none where it is an error.
fn answers(engine: &str, side: u32, requests: &[u8]) -> Vec<Option<Hits>> {
    let lines = ask(engine, requests);
    assert!(lines[0].starts_with(&format!("HELLO 1 {engine} ")), "{}", lines[0]);
    let hits = |(id, line): (usize, &String)| {
        let words: Vec<&str> = line.split(' ').collect();
        assert_eq!(words[1], id.to_string(), "{engine}: {line}");
        if words[0] == "E" {
            return None;
        }
        let numbers: Vec<i32> = words[3..].iter().map(|n| n.parse().unwrap()).collect();
        Some(drawn(side, |_, hit| match words[0] {
            "C" => numbers.chunks(3).for_each(|r| (r[1]..r[2]).for_each(|x| hit(x, r[0]))),
            "P" => numbers.chunks(2).for_each(|p| hit(p[0], p[1])),
            other => panic!("{other}: {line}"),
        }))
    };
    lines[1..].iter().enumerate().map(hits).collect()
}

/// Through the protocol: one batch for each engine gives every recorded hit count, double hits among them.
#[test]
fn book_quads_as_recorded() {
    let all = records("book-quads");
    for (half, split) in [("A", [0, 1, 2]), ("B", [0, 2, 3])] {
        let corner = |record: &Value| {
            let p = positions(&record["v"], SIDE);
            split.map(|i| p[i]).to_vec()
        };
        let corners: Vec<_> = all.iter().map(corner).collect();
        for engine in ["book-ch2", "book-ch11"] {
            let answers = answers(engine, SIDE, &requests("T", SIDE, &corners));
            for (record, actual) in all.iter().zip(answers) {
                if engine == "book-ch2" || record["ch11_same"] == true {
                    let expected = recorded(&record[half], SIDE);
                    assert_eq!(actual.unwrap(), expected, "{engine} {}", record["id"]);
                }
            }
        }
    }
}

/// The same for lines.
#[test]
fn book_lines_as_recorded() {
    let all = records("book-lines");
    let ends: Vec<_> = all.iter().map(|record| positions(&record["v"], SIDE)).collect();
    let answers = answers("book-dda", SIDE, &requests("L", SIDE, &ends));
    for (record, actual) in all.iter().zip(answers) {
        assert_eq!(actual.unwrap(), recorded(&record["rows"], SIDE), "{}", record["id"]);
    }
}

/// Beyond the screen nothing is answered, whatever the published code writes there; what it leaves
/// undefined is an error, and the next request is answered.
#[test]
fn book_beyond_the_screen_through_the_protocol() {
    let bugs = bugs();
    let names = ["oob", "ch3_unclamped", "int_overflow_runaway", "negative_trunc"];
    let corners: Vec<_> = names.map(|name| positions(&bugs[name]["v"], SIDE)).to_vec();
    let requests = requests("T", SIDE, &corners);
    let on_screen = |hits: &Hits| {
        let side = 0..i64::from(SIDE);
        hits.keys().all(|(y, x)| side.contains(y) && side.contains(x))
    };
    for engine in ["book-ch2", "book-ch3"] {
        let answers = answers(engine, SIDE, &requests);
        for (name, hits) in names.iter().zip(&answers) {
            assert_eq!(hits.is_none(), *name == "int_overflow_runaway", "{engine} {name}");
            assert!(hits.as_ref().is_none_or(on_screen), "{engine} {name}");
        }
        // Without the clamp the flat edge fills whole rows; with it, it does not.
        let drawn = answers[1].as_ref().unwrap().len();
        assert_eq!(drawn > 60, engine == "book-ch3", "{engine}: {drawn}");
        assert!(answers[3].as_ref().unwrap().contains_key(&(0, 3)), "{engine}");
    }
}
