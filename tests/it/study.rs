//! Pages and pictures of studies of models. What is said of hard cases is in `tests/transcripts/hard-cases.md`, and of whole studies in
//! `slow/study.md` beside it.

use base64::Engine as _;

use crate::pages::read;
use crate::program::Folder;

/// What `verify` says of a kind of hard case: how many there are, how many of them are seen, and in how many pixels.
fn numbers(folder: &Folder, words: &str, kind: &str) -> Option<[u64; 3]> {
    let json = folder.check(&*format!("verify {words} --json"), 0).json();
    let cases = json["hard_cases"]["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["kind"] == kind)?;
    Some(["count", "in_view", "pixels"].map(|field| case[field].as_u64().unwrap()))
}

/// The pages of `cost` and `study` begin with a sentence and the picture of it, and every table is folded below.
#[test]
fn pages_begin_with_the_answer_as_a_picture() {
    let folder = Folder::new("study-pictured");
    folder.put("m.obj", read("tests/transcripts/hard-cases/box.obj"));
    for command in ["cost", "study"] {
        folder.check(&*format!("{command} m.obj --size 64x48 --once --report --out ."), 0);
        let page = folder.text(&format!("{command}.html"));
        let place = |what: &str| page.find(what).unwrap_or_else(|| panic!("{command}: {what}"));
        let places = [
            "<h1>",
            "<p class=\"pictured\">",
            "<figure class=\"plot\">",
            "<p class=\"quiet\">",
            "<details>",
        ];
        assert!(places.map(place).is_sorted(), "{command}: {:?}", places.map(place));
        let picture = &page[place("<img src=\"data:image/svg+xml;base64,")..];
        let svg = picture.split_once("base64,").unwrap().1.split_once('"').unwrap().0;
        let svg = base64::engine::general_purpose::STANDARD.decode(svg).unwrap();
        let svg = String::from_utf8(svg).unwrap();
        for choice in ["scanline book", "scanline 24.8 DDA", "edge robust"] {
            assert!(svg.contains(&format!(">{choice}</text>")), "{command}: {choice}");
        }
        let outside: Vec<&str> =
            page.split("<details>").map(|part| part.rsplit("</details>").next().unwrap()).collect();
        assert!(outside.iter().all(|part| !part.contains("<table class=\"counts\"")), "{command}");
        assert!(page.matches("<table class=\"counts\"").count() >= 6, "{command}");
        // Hard cases are no faults of a model: nothing is called bad.
        assert!(!page.contains("class=\"verdict"), "{command}");
    }
}

/// The seam of two levels of detail is no rim: it is counted apart, and its pixels are those that faces in the gaps would
/// cover, as two pictures show.
#[test]
fn gaps_between_levels_of_detail_are_found_with_their_pixels() {
    let folder = Folder::new("study-gaps");
    let model = read("tests/data/models/lod-border.obj");
    folder.put("m.mtl", "newmtl ground\nKd 0 0.6 0\nnewmtl gap\nKd 1 0 0\nKa 1 0 0\n");
    let model = format!("mtllib m.mtl\nusemtl ground\n{model}");
    folder.put("m.obj", &model);
    // Corners 21 to 25 of the coarse level, and between them every other one of 26 to 34 of the fine one.
    let closing: String =
        (0..4).map(|i| format!("f {} {} {}\n", 21 + i, 27 + 2 * i, 22 + i)).collect();
    folder.put("closed.obj", format!("{model}usemtl gap\n{closing}"));
    let mut all = 0;
    for (size, view) in [
        ("640x480", ""),
        ("320x240", " --pitch 60"),
        ("320x240", " --yaw 200 --pitch 20"),
        ("480x360", " --aa ssaa2"),
    ] {
        let view = format!(" --size {size}{view}");
        let [count, in_view, pixels] =
            numbers(&folder, &format!("m.obj{view}"), "gaps between borders").unwrap();
        let picture = |name: &str| {
            folder.check(
                &*format!("render {name}.obj{view} -o {name}.png --engine scanline --force"),
                0,
            );
            image::open(folder.join(format!("{name}.png"))).unwrap().to_rgb8()
        };
        let (open, closed) = (picture("m"), picture("closed"));
        let differ = open.pixels().zip(closed.pixels()).filter(|(a, b)| a != b).count() as u64;
        assert_eq!((count, pixels), (4, differ), "{view}");
        assert!((in_view > 0) == (pixels > 0), "{view}");
        all += pixels;
    }
    assert!(all > 50, "{all}");
    // The rim alone: 4 edges of the coarse level on three sides, and 8 of the fine one.
    let [rim, ..] = numbers(&folder, "m.obj", "open borders").unwrap();
    assert_eq!(rim, 3 * 4 + 3 * 8);
    assert_eq!(numbers(&folder, "closed.obj", "gaps between borders"), None);
}
