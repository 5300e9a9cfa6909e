//! The playground in a browser: the compiled engines draw what the program draws, and everything on
//! the page works with a mouse and with a keyboard alone.
//!
//! Needs the module that `playground/build` leaves, and Chromium. Without them these tests say so and
//! pass, unless `RASTERPROOF_NEEDS_PLAYGROUND` or `RASTERPROOF_NEEDS_CHROMIUM` is set, as `.ci/run` does.

use std::path::{Path, PathBuf};
use std::process::Command;

use rasterproof::answer::answer;
use rasterproof::contract::{Rasterize as _, RasterizeExact as _};
use rasterproof::frame::Coverage;
use rasterproof::grid::PixelRect;
use rasterproof::hazard::{Shape, offgrid, triangles};
use rasterproof::page;
use rasterproof::raster::edge_function::EdgeFunction;
use rasterproof::raster::edge_function::probe::edges_at;
use rasterproof::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof::raster::edge_function_exact::probe::edges_at as exact_edges_at;
use rasterproof::raster::scanline::Scanline;
use rasterproof::raster::scanline::steps::walked_rows;
use rasterproof::raster::scanline_exact::ScanlineExact;
use rasterproof::raster::scanline_exact::probe::crossings_at;
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

/// The same for corners that are not snapped, with the sides and crossings that are shown.
#[test]
fn exact_probes_decide_as_the_engines() {
    let mut unsure = 0;
    for family in offgrid::FAMILIES {
        for case in (0..20).map(|index| family.case(7, index)) {
            for corners in &case.triangles {
                let mut by_edges = Coverage::new(case.window, 0);
                EdgeFunctionExact.cover_exact(corners, case.window, &mut |s: Span| {
                    by_edges.hit(s.y_px, s.x0_px, s.x1_px);
                });
                let mut by_rows = Coverage::new(case.window, 0);
                ScanlineExact.cover_exact(corners, case.window, &mut |s: Span| {
                    by_rows.hit(s.y_px, s.x0_px, s.x1_px);
                });
                for (y_px, row) in by_edges.rows() {
                    let columns = crossings_at(corners, y_px).map(|c| c.map(|c| c.column));
                    for (x_px, hit) in (case.window.x0..).zip(row) {
                        let edges = exact_edges_at(corners, x_px, y_px);
                        let inside = edges.is_some_and(|edges| {
                            edges.iter().all(|e| e.side.is_gt() || e.side.is_eq() && e.is_top_left)
                        });
                        assert_eq!(inside, *hit == 1, "{corners:?} at {x_px}, {y_px}");
                        let between =
                            columns.is_some_and(|[a, b]| a.min(b) <= x_px && x_px < a.max(b));
                        let drawn = by_rows.row(y_px)[(x_px - case.window.x0) as usize];
                        assert_eq!(between, drawn == 1, "{corners:?} at {x_px}, {y_px}");
                        let all = edges.iter().flatten();
                        unsure += all.filter(|e| e.estimate.abs() <= e.bound).count();
                    }
                }
            }
        }
    }
    assert!(unsure > 100, "{unsure} sides that floats cannot tell");
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
    // The strict rule leaves holes along the diagonal, and the page says why; so with the other rules.
    browser.eval("(begin('triangle'), drawAll())");
    for (rule, says, why) in [
        ("strict", "22 missing", "hole"),
        ("inclusive", "16 too many, 9 hit twice", "hit twice"),
        ("tl", "as the oracle", "hit once"),
    ] {
        browser.eval(&format!("document.getElementById('rule-{rule}').click()"));
        settle(&mut browser);
        let verdict = browser.text("#panels figure:nth-child(2) output");
        assert!(verdict.contains(says), "{rule}: {verdict}");
        assert!(browser.text("#look .say").contains(why), "{rule}");
    }
    // Both are shown against each other too.
    browser.eval("(state.by[1] = 'exclusive-edges', document.querySelector('[data-state=difference]').click())");
    settle(&mut browser);
    assert_eq!(browser.text("#panels figure:nth-child(3) output"), "22 pixels differ");
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// Frames while a corner is dragged at 64 x 64 pixels with four panels: printed, not judged. The rate
/// is of this machine with all else that runs on it; the processor time of a frame is the page's own,
/// script, layout and painting: below 16.7 ms it keeps up with 60 frames a second.
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
    let [x, y] = handle(&mut browser, 1);
    mouse(&mut browser, "mousePressed", [x, y]);
    browser.call("Performance.enable", json!({ "timeDomain": "threadTicks" }));
    let processor_seconds = |browser: &mut Browser| {
        let metrics = browser.call("Performance.getMetrics", json!({}))["metrics"].clone();
        let tasks = metrics.as_array().unwrap().iter().find(|m| m["name"] == "TaskDuration");
        tasks.unwrap()["value"].as_f64().unwrap()
    };
    let before = processor_seconds(&mut browser);
    let seconds = browser.eval(&format!(
        "(async () => {{
            const next = () => new Promise(requestAnimationFrame);
            const [{{ canvas }}] = shown;
            frames.length = 0;
            const begun = await next();
            for (let i = 0; i < 120; i++) {{
                const [clientX, clientY] = [{x} - i / 2, {y} + i];
                canvas.dispatchEvent(new PointerEvent('pointermove',
                    {{ clientX, clientY, pointerId: 1, pointerType: 'mouse', bubbles: true }}));
                await next();
            }}
            return (await next() - begun) / 1000;
        }})()"
    ));
    let processor = processor_seconds(&mut browser) - before;
    let frames = browser.eval("frames.length").as_f64().unwrap();
    assert!(frames >= 110.0, "a frame for each move: {frames}");
    let moved = browser.eval("state.triangles[0][1].x < 55");
    assert_eq!(moved, true, "the corner followed");
    eprintln!(
        "playground: 64 x 64 pixels, four panels: {:.0} frames a second while dragging, \
         {:.1} ms of processor time a frame",
        121.0 / seconds.as_f64().unwrap(),
        1000.0 * processor / frames
    );
}

/// Two fingers zoom about the spot between them, and move no corner; one finger drags.
#[test]
fn playground_follows_fingers() {
    let Some((mut browser, page)) = opened("fingers") else { return };
    let touch = json!({ "enabled": true, "maxTouchPoints": 2 });
    browser.call("Emulation.setTouchEmulationEnabled", touch);
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let touch = |browser: &mut Browser, kind: &str, spots: &[[f64; 2]]| {
        let points: Vec<_> = spots
            .iter()
            .enumerate()
            .map(|(id, [x, y])| json!({ "x": x, "y": y, "id": id }))
            .collect();
        let event = json!({ "type": kind, "touchPoints": points });
        browser.call("Input.dispatchTouchEvent", event);
    };
    let [x, y] = handle(&mut browser, 2);
    let around = |by: f64| [[x - by, y - 30.0], [x + by, y - 30.0]];
    touch(&mut browser, "touchStart", &around(20.0));
    for step in 1..=6 {
        touch(&mut browser, "touchMove", &around(20.0 + 5.0 * f64::from(step)));
    }
    touch(&mut browser, "touchEnd", &[]);
    settle(&mut browser);
    let window: [i32; 4] = serde_json::from_value(browser.eval("state.window")).unwrap();
    assert!(window[2] - window[0] < 14 && window[2] > 10, "{window:?} still holds the corner");
    assert_eq!(browser.eval("state.triangles[0][2].x"), 10.5);
    let [x, y] = handle(&mut browser, 2);
    touch(&mut browser, "touchStart", &[[x, y]]);
    touch(&mut browser, "touchMove", &[[x - 20.0, y - 20.0]]);
    touch(&mut browser, "touchMove", &[[x - 40.0, y - 40.0]]);
    touch(&mut browser, "touchEnd", &[]);
    assert!(browser.eval("state.triangles[0][2].x").as_f64().unwrap() < 10.5);
    assert_eq!(browser.complaints, Vec::<String>::new());
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
    let unnamed = "Object.entries(names).flatMap(([list, all]) => list === 'recorded' ? [] : all)
        .map(entry => entry.name).filter(name => !ABOUT_ZH[name])";
    assert_eq!(browser.eval(unnamed), json!([]), "cases and families are told in Chinese too");
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
    // Whoever does not see it hears where the corner is, and what both panels made of it.
    settle(&mut browser);
    let heard = browser.text("#announce");
    assert!(heard.contains("A 3.5, 2.50390625") && heard.contains("as the oracle"), "{heard}");
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
    browser.wait_for("document.getElementById('hunt').textContent.includes('shrunk in') && !hunt");
    settle(&mut browser);
    let wrong = "last.answer.panels.some(p => p.name === 'games101-strict' && p.missing > 0)";
    assert_eq!(browser.eval(wrong), true, "what is left still fails");
    assert_eq!(browser.eval("state.triangles.length"), 1);
    // Off the lattice the same, and the pixel is explained there.
    browser.eval("(document.getElementById('family').value = 'f32-tie')");
    browser.eval("document.getElementById('search').click()");
    browser.wait_for("!hunt && !state.snap");
    settle(&mut browser);
    assert_eq!(browser.eval(wrong), true);
    assert!(browser.text("#look").contains("decided exactly"), "{}", browser.text("#look"));
    // The engines stop on nothing that the page can send: what it cannot draw is an error in words.
    let bad = browser.eval("ask({ ask: 'named', name: 'T99' }).error");
    assert!(bad.as_str().unwrap().contains("T99"));
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// A case of the report page leads to the same corners in the playground, by its name or its places.
#[test]
fn playground_opens_cases_of_the_report() {
    let Some((mut browser, page)) = opened("report") else { return };
    for (words, shown) in [
        (&["T2"][..], "state.named === 'T2' && state.triangles.length === 2"),
        (&["sliver#3", "--seed", "7"], "state.generated.index === 3 && state.generated.seed === 7"),
        (&["0.5,0.5", "5.5,0.5", "5.5,5.5"], "state.triangles[0][2].y === 5.5 && !state.named"),
        (&["--line", "0,0", "8,3"], "state.scene === 'line' && state.lines[0][1][0] === 8"),
    ] {
        let folder = folder("playground-report-inspect");
        let program = Command::new(env!("CARGO_BIN_EXE_rasterproof"))
            .args(["inspect", "--report"])
            .args(words)
            .current_dir(&folder)
            .output()
            .unwrap();
        assert!(program.status.success(), "{words:?}");
        browser.open(&folder.join("target/rasterproof/inspect.html"), "");
        let link =
            browser.eval("document.querySelector('#case-playground a').getAttribute('href')");
        let fragment = link.as_str().unwrap().strip_prefix("playground.html").unwrap().to_owned();
        browser.open(&page, &fragment);
        settle(&mut browser);
        assert_eq!(browser.eval(shown), true, "{words:?}: {fragment}");
        assert_eq!(browser.eval("document.getElementById('trouble').hidden"), true);
    }
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// Every chapter links into its scene, from both languages alike, and the address opens it.
#[test]
fn playground_is_where_chapters_lead() {
    let links = |folder: &str| -> Vec<(String, String)> {
        let mut pages: Vec<_> = (1..=11).map(|n| format!("ch{n:02}.md")).collect();
        pages.push("games101.md".to_owned());
        let link = |page: String| {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(&page);
            let text = std::fs::read_to_string(path).unwrap();
            let found: Vec<_> = text
                .split("target/rasterproof/playground.html")
                .skip(1)
                .map(|rest| (page.clone(), rest.split(')').next().unwrap().to_owned()))
                .collect();
            assert!(!found.is_empty(), "{folder}/{page} links nowhere into the playground");
            found
        };
        pages.into_iter().flat_map(link).collect()
    };
    assert_eq!(links("docs"), links("docs/zh"));
    let Some((mut browser, page)) = opened("chapters") else { return };
    for (chapter, address) in links("docs") {
        browser.open(&page, &address);
        settle(&mut browser);
        let scene = browser.eval("`#scene=${state.scene}`");
        assert!(address.starts_with(scene.as_str().unwrap()), "{chapter}: {address}");
        assert_eq!(browser.eval("document.getElementById('trouble').hidden"), true, "{chapter}");
    }
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
