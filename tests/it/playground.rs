//! The playground in a browser: the compiled engines draw what the program draws, and everything on
//! the page works with a mouse and with a keyboard alone.
//!
//! Needs the module that `playground/build` leaves, and Chromium. Without them these tests say so and
//! pass, unless `RASTERPROOF_NEEDS_PLAYGROUND` or `RASTERPROOF_NEEDS_CHROMIUM` is set, as `.ci/run` does.

use std::path::{Path, PathBuf};
use std::process::Command;

use rasterproof::answer::answer;
use rasterproof::contract::Rasterize as _;
use rasterproof::frame::Coverage;
use rasterproof::grid::PixelRect;
use rasterproof::hazard::{Shape, triangles};
use rasterproof::page;
use rasterproof::raster::edge_function::EdgeFunction;
use rasterproof::raster::edge_function::probe::edges_at;
use rasterproof::raster::scanline::Scanline;
use rasterproof::raster::scanline::steps::walked_rows;
use rasterproof::triangle::{Corners, Span};
use serde_json::{Value, json};

use crate::page::{Browser, folder};

const SCENES: [&str; 8] =
    ["triangle", "line", "weights", "perspective", "depth", "near", "samples", "culling"];

/// The compiled engines, or nothing where nobody has built them and nobody demands them.
fn module() -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target/rasterproof/playground.wasm");
    if path.is_file() {
        return Some(path);
    }
    let demanded = std::env::var_os("RASTERPROOF_NEEDS_PLAYGROUND").is_some();
    assert!(!demanded, "no {}: run playground/build", path.display());
    eprintln!("SKIPPED: no {}; run playground/build", path.display());
    None
}

/// Runs `rasterproof playground` in a folder; the status, and what it printed to both streams.
fn run(folder: &Path, words: &[&str]) -> (i32, String, String) {
    let program = Command::new(env!("CARGO_BIN_EXE_rasterproof"))
        .arg("playground")
        .args(words)
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (program.status.code().unwrap(), text(program.stdout), text(program.stderr))
}

/// The page as the command writes it, and a browser to look at it.
fn opened(name: &str) -> Option<(Browser, PathBuf)> {
    let module = module()?;
    let folder = folder(&format!("playground-{name}"));
    let (status, printed, complaint) = run(&folder, &["--module", module.to_str().unwrap()]);
    assert_eq!(status, 0, "{complaint}");
    assert_eq!(printed, "playground: target/rasterproof/playground.html\n");
    let page = folder.join("target/rasterproof/playground.html");
    assert!(std::fs::metadata(&page).unwrap().len() <= page::MOST_BYTES as u64);
    Some((Browser::start(&format!("playground-{name}"))?, page))
}

/// What the page's engines answer, and what those of this program do, as the browser writes both down.
fn both(browser: &mut Browser, question: &Value) -> (Value, Value) {
    let theirs = browser.eval(&format!("ask({question})"));
    let ours = browser.eval(&format!("({})", answer(&question.to_string())));
    (theirs, ours)
}

/// Two frames later everything that was asked for is drawn, and soon after it is explained.
fn settle(browser: &mut Browser) {
    browser.eval(
        "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(
            () => setTimeout(done, 150))))",
    );
}

/// Where corner `i` lies on the first panel, in pixels of the tab.
fn handle(browser: &mut Browser, i: usize) -> [f64; 2] {
    let spot = browser.eval(&format!(
        "(() => {{ const c = shown[0].canvas; c.scrollIntoView({{ block: 'center' }});
            const b = c.getBoundingClientRect(), v = shown[0].view, h = handles()[{i}];
            return [b.left + v.x(h.x) / v.ratio, b.top + v.y(h.y) / v.ratio]; }})()"
    ));
    serde_json::from_value(spot).unwrap()
}

fn mouse(browser: &mut Browser, kind: &str, [x, y]: [f64; 2]) {
    let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1,
        "clickCount": 1 });
    browser.call("Input.dispatchMouseEvent", event);
}

/// Presses a key that has no letter, with Shift (8), Alt (1) or neither held.
fn press(browser: &mut Browser, key: &str, code: u32, modifiers: u32) {
    for kind in ["rawKeyDown", "keyUp"] {
        let event = json!({ "type": kind, "key": key, "code": key,
            "windowsVirtualKeyCode": code, "modifiers": modifiers });
        browser.call("Input.dispatchKeyEvent", event);
    }
}

/// Triangles of every family, with their windows.
fn hazards(cases: u64) -> impl Iterator<Item = (Corners, PixelRect)> {
    triangles::FAMILIES.iter().flat_map(move |family| {
        (0..cases).flat_map(|index| {
            let case = family.case(7, index);
            let Shape::Triangles { list, .. } = case.shape else { return Vec::new() };
            list.iter().map(|triangle| (triangle.corners(), case.window)).collect()
        })
    })
}

/// What is shown is what draws: the columns of the two walks are the ends of the engine's spans.
#[test]
fn walked_rows_are_the_engines() {
    for (corners, window) in hazards(40) {
        let mut drawn = Vec::new();
        Scanline.cover(corners, window, |span| drawn.push(span));
        let spans = walked_rows(corners, window).into_iter().filter_map(|row| {
            let (a, b) = (row.long.column, row.short.column);
            let (x0, x1) = (a.min(b).max(window.x0.into()), a.max(b).min(window.x1.into()));
            let span = Span { y_px: row.y_px, x0_px: x0 as i32, x1_px: x1 as i32 };
            (x0 < x1).then_some(span)
        });
        assert_eq!(spans.collect::<Vec<_>>(), drawn, "{corners:?}");
    }
}

/// The rule read off the three values is the engine's decision, at every pixel.
#[test]
fn edges_at_a_pixel_decide_as_the_engine() {
    for (corners, window) in hazards(8) {
        let mut hits = Coverage::new(window, 0);
        EdgeFunction.cover(corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
        for (y_px, row) in hits.rows() {
            for (x_px, hit) in (window.x0..).zip(row) {
                let inside = edges_at(&corners, x_px, y_px).is_some_and(|edges| {
                    edges.iter().all(|e| e.value > 0 || e.value == 0 && e.is_top_left)
                });
                assert_eq!(inside, *hit == 1, "{corners:?} at {x_px}, {y_px}");
            }
        }
    }
}

/// The same digest of 1,000 hazards: spans of both engines and the oracle, values to the last bit, lines.
#[test]
fn playground_draws_what_the_program_draws() {
    let Some((mut browser, page)) = opened("digest") else { return };
    browser.open(&page, "");
    let (theirs, ours) = both(&mut browser, &json!({ "ask": "digest", "seed": 1, "cases": 1000 }));
    eprintln!("playground: {theirs}");
    assert_eq!(theirs, ours, "run playground/build again after a change of the engines");
    assert!(ours["fragments"].as_u64().unwrap() > 100_000, "{ours}");
    // The comparison can fail: other cases have another digest.
    let (other, _) = both(&mut browser, &json!({ "ask": "digest", "seed": 2, "cases": 1000 }));
    assert_ne!(other["digest"], ours["digest"]);
    // Every named case too, by everybody that the page offers, and every answer of every scene.
    let who = browser.eval("names.triangles.map(e => e.name)");
    for name in ["T1", "T2", "T6", "T8", "S11", "O3"] {
        let case: Value =
            serde_json::from_str(&answer(&json!({ "ask": "named", "name": name }).to_string()))
                .unwrap();
        let draw = json!({ "ask": "draw", "picture": case["picture"], "by": who });
        let (theirs, ours) = both(&mut browser, &draw);
        assert_eq!(theirs, ours, "{name}");
    }
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// A corner is dragged with the mouse: pixels change, and are those of the program.
#[test]
fn playground_follows_the_mouse() {
    let Some((mut browser, page)) = opened("mouse") else { return };
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let picture = "shown[0].canvas.toDataURL()";
    let before = browser.eval(picture);
    let [x, y] = handle(&mut browser, 1);
    mouse(&mut browser, "mousePressed", [x, y]);
    for step in 1..=10 {
        mouse(&mut browser, "mouseMoved", [x - 6.0 * f64::from(step), y + 4.0 * f64::from(step)]);
    }
    mouse(&mut browser, "mouseReleased", [x - 60.0, y + 40.0]);
    settle(&mut browser);
    assert_ne!(browser.eval(picture), before);
    // The corner was shared by one triangle only; on the lattice, and not where it was.
    let corner = browser.eval("[state.triangles[0][1].x * 256, state.triangles[0][1].y * 256]");
    let sub: Vec<f64> = serde_json::from_value(corner).unwrap();
    assert!(sub.iter().all(|v| v.fract() == 0.0) && sub[0] < 10.5 * 256.0, "{sub:?}");
    let question = browser.eval("({ ask: 'draw', picture: picture(), by: state.by })");
    let drawn = browser.eval("last.answer");
    assert_eq!(both(&mut browser, &question), (drawn.clone(), drawn));
    // The strict rule leaves holes along the diagonal, and the page says why.
    browser.eval("(begin('triangle'), drawAll())");
    settle(&mut browser);
    assert!(browser.text("#panels figure:nth-child(2) output").contains("22 missing"));
    assert!(browser.text("#look .say").contains("hole"));
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// Frames while a corner is dragged at 64 x 64 pixels with four panels: printed, not judged.
#[test]
fn playground_frames_are_timed() {
    let Some((mut browser, page)) = opened("frames") else { return };
    browser.open(
        &page,
        "#t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64\
         &by=scanline,exclusive-edges,oracle,games101-strict",
    );
    settle(&mut browser);
    assert_eq!(browser.eval("shown.length"), 4);
    browser.eval(
        "(async () => { const next = () => new Promise(requestAnimationFrame);
            frames.length = 0; const begun = await next();
            for (let i = 0; i < 120; i++) {
                const h = handles()[1]; place(h, 60.25 - i / 8, 10.5 + i / 5); await next();
            }
            window.took = (await next()) - begun; })()",
    );
    let [median, worst, rate] = [
        "[...frames].sort((a, b) => a - b)[Math.floor(frames.length / 2)]",
        "Math.max(...frames)",
        "121000 / took",
    ]
    .map(|what| browser.eval(what).as_f64().unwrap());
    assert!(browser.eval("frames.length").as_u64().unwrap() >= 110, "a frame for each move");
    eprintln!(
        "playground: 64 x 64 pixels, four panels: {median:.1} ms a frame in the middle, \
         {worst:.1} ms at most, {rate:.0} frames a second"
    );
}

/// Every scene opens in both languages, light and dark, wide and narrow, by its address alone.
#[test]
fn playground_shows_every_scene() {
    let Some((mut browser, page)) = opened("scenes") else { return };
    for (scene, lang, scheme) in
        SCENES.into_iter().flat_map(|scene| [(scene, "en", "light"), (scene, "zh", "dark")])
    {
        browser.prefer("prefers-color-scheme", scheme);
        browser.open(&page, &format!("#scene={scene}&lang={lang}"));
        settle(&mut browser);
        let shown = browser.eval("[state.scene, state.lang, shown.length > 0, last.answer.error]");
        assert_eq!(shown, json!([scene, lang, true, null]));
        assert_eq!(browser.eval("document.getElementById('trouble').hidden"), true);
        for width in [1280, 400] {
            browser.resize(width, 900);
            settle(&mut browser);
            let wide = browser.eval("document.documentElement.scrollWidth").as_u64().unwrap();
            assert!(wide <= u64::from(width), "{scene}: {wide} px wide in a window of {width}");
        }
        // The address leads back to what is shown.
        let same = "(() => { const now = JSON.stringify(scene().ask()); restore(address());
            return JSON.stringify(scene().ask()) === now; })()";
        assert_eq!(browser.eval(same), true, "{scene}");
    }
    let keys = "JSON.stringify(Object.keys(WORDS.en).concat(Object.keys(WORDS.en.about))) === \
        JSON.stringify(Object.keys(WORDS.zh).concat(Object.keys(WORDS.zh.about)))";
    assert_eq!(browser.eval(keys), true, "both languages have the same words");
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// The keyboard alone reaches every control, moves corners by pixels and subpixels, pans and zooms.
#[test]
fn playground_needs_no_mouse() {
    let Some((mut browser, page)) = opened("keys") else { return };
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let controls = browser.eval(
        "[...document.querySelectorAll('button, select, input, canvas, summary')]
            .filter(e => e.checkVisibility()).length",
    );
    let mut reached = std::collections::BTreeSet::new();
    browser.eval("window.seen = new Set()");
    for _ in 0..controls.as_u64().unwrap() + 4 {
        press(&mut browser, "Tab", 9, 0);
        browser.eval("seen.add(document.activeElement)");
        let tag = browser.eval("document.activeElement.tagName");
        reached.insert(tag.as_str().unwrap().to_owned());
    }
    let missed = browser.eval(
        "[...document.querySelectorAll('button, select, input, canvas, summary')]
            .filter(e => e.checkVisibility() && !seen.has(e)).map(e => e.outerHTML.slice(0, 90))",
    );
    assert_eq!(missed, json!([]), "not reached by Tab; reached {reached:?}");
    browser.eval("shown[0].canvas.focus()");
    let corner = "[handles()[state.chosen].x, handles()[state.chosen].y]";
    // Tab went through the numbers of the corners, and chose the last one.
    browser.press("]");
    assert_eq!(browser.eval(corner), json!([2.5, 2.5]));
    press(&mut browser, "ArrowRight", 39, 0);
    press(&mut browser, "ArrowDown", 40, 8);
    assert_eq!(browser.eval(corner), json!([3.5, 2.5 + 1.0 / 256.0]));
    browser.press("]");
    press(&mut browser, "ArrowLeft", 37, 0);
    assert_eq!(browser.eval(corner), json!([9.5, 2.5]));
    browser.press("p");
    press(&mut browser, "ArrowDown", 40, 0);
    assert_eq!(browser.eval("state.px"), json!([6, 7]));
    browser.press("+");
    assert_eq!(browser.eval("state.window"), json!([1, 1, 13, 13]));
    press(&mut browser, "ArrowRight", 39, 1);
    assert_eq!(browser.eval("state.window"), json!([2, 1, 14, 13]));
    settle(&mut browser);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// A specimen is hunted until it is caught, then shrunk; the command names what is shown.
#[test]
fn playground_breaks_a_specimen() {
    let Some((mut browser, page)) = opened("break") else { return };
    browser.open(&page, "#case=T2&lang=en");
    settle(&mut browser);
    assert_eq!(browser.text("#command"), "rasterproof inspect T2");
    browser.eval("document.getElementById('search').click()");
    browser.wait_for("document.getElementById('hunt').textContent.startsWith('caught by')");
    settle(&mut browser);
    let wrong = "last.answer.panels.some(p => p.name === 'games101-strict' && p.missing > 0)";
    assert_eq!(browser.eval(wrong), true);
    assert!(browser.text("#command").starts_with("rasterproof inspect 'half-integer#"));
    browser.eval("document.getElementById('shrink').click()");
    browser.wait_for("document.getElementById('hunt').textContent.startsWith('shrunk') && !hunt");
    settle(&mut browser);
    assert_eq!(browser.eval(wrong), true, "what is left still fails");
    assert_eq!(browser.eval("state.triangles.length"), 1);
    // The engines stop on nothing that the page can send: what it cannot draw is an error in words.
    let bad = browser.eval("ask({ ask: 'named', name: 'T99' }).error");
    assert!(bad.as_str().unwrap().contains("T99"));
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// Without its module the command says how to get one; what is no module is refused, nothing written.
#[test]
fn playground_says_what_it_needs() {
    let folder = folder("playground-none");
    let (status, printed, complaint) = run(&folder, &[]);
    assert_eq!((status, printed.as_str()), (2, ""));
    assert!(complaint.contains("playground/build"), "{complaint}");
    std::fs::write(folder.join("x.wasm"), "no module").unwrap();
    let (status, _, complaint) = run(&folder, &["--module", "x.wasm"]);
    assert_eq!(status, 2);
    assert!(complaint.contains("x.wasm is no WebAssembly module"), "{complaint}");
    assert!(!folder.join("target").exists());
}
