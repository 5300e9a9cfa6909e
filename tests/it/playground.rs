//! The playground in a browser: the compiled engines draw what the program draws, and what the page shows
//! is what its addresses and commands say.
//!
//! Needs the module that `crates/playground/build` leaves, and Chromium. Without them these tests say so and
//! pass, unless `RASTERPROOF_NEEDS_PLAYGROUND` or `RASTERPROOF_NEEDS_CHROMIUM` is set, as `.ci/run` does.

use std::path::PathBuf;
use std::process::Command;

use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function::probe::edges_at;
use rasterproof_core::raster::edge_function_exact::probe::edges_at as exact_edges_at;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline::steps::walked_rows;
use rasterproof_core::raster::scanline_exact::probe::crossings_at;
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_playground as pages;
use rasterproof_registry::engines::ExactEngine;
use rasterproof_verify::cases::unsnapped;
use rasterproof_verify::cases::{Shape, triangles};
use rasterproof_verify::comparison::exact_coverage;
use rasterproof_wasm::question::answer;
use serde_json::{Value, json};

use crate::browser::{Browser, Tab as _, folder};
use crate::pages::root;
use crate::program::{Folder, PROGRAM, Run, shared};
use crate::recorded::hits;

pub const SCENES: [&str; 9] =
    ["triangle", "line", "weights", "perspective", "depth", "near", "samples", "culling", "figure"];

/// The compiled engines, or nothing where nobody has built them and nobody demands them.
pub fn module() -> Option<PathBuf> {
    let path = root().join("target/rasterproof/playground.wasm");
    if path.is_file() {
        return Some(path);
    }
    let demanded = std::env::var_os("RASTERPROOF_NEEDS_PLAYGROUND").is_some();
    assert!(!demanded, "no {}: run crates/playground/build", path.display());
    eprintln!("SKIPPED: no {}; run crates/playground/build", path.display());
    None
}

/// The page that a command writes, for a test of this name.
pub fn written(command: &str, name: &str) -> Option<PathBuf> {
    let module = module()?;
    let folder = folder(&format!("{command}-{name}"));
    let mut program = shared().command([command, "--module"]);
    let run = Run::of(program.arg(module).current_dir(&folder)).has(0);
    assert_eq!(run.out, format!("{command}: target/rasterproof/{command}.html\n"));
    let page = folder.join(format!("target/rasterproof/{command}.html"));
    assert!(std::fs::metadata(&page).unwrap().len() <= pages::MOST_BYTES as u64);
    Some(page)
}

/// The playground, and a browser to look at it.
pub fn opened(name: &str) -> Option<(Browser, PathBuf)> {
    let page = written("playground", name)?;
    Some((Browser::start(&format!("playground-{name}"))?, page))
}

/// What the page's engines answer, and what those of this program do, as the browser writes both down.
pub fn both(browser: &mut Browser, question: &Value) -> (Value, Value) {
    let theirs = browser.eval(&format!("ask({question})"));
    let ours = browser.eval(&format!("({})", answer(&question.to_string())));
    (theirs, ours)
}

/// Two frames later everything that was asked for is drawn, and soon after it is explained.
pub fn settle(browser: &mut Browser) {
    browser.eval(
        "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(
            () => setTimeout(done, 150))))",
    );
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
        for (y_px, row) in hits(&EdgeFunction, &[corners], window).rows() {
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
    for family in unsnapped::FAMILIES {
        for case in (0..20).map(|index| family.case(7, index)) {
            for corners in case.free_corners() {
                let alone = std::slice::from_ref(corners);
                let [by_edges, by_rows] = [ExactEngine::EdgeFunction, ExactEngine::Scanline]
                    .map(|engine| exact_coverage(&engine, alone, case.window).unwrap().0);
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
    assert_eq!(theirs, ours, "run crates/playground/build again after a change of the engines");
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
}

/// Every scene opens in both languages, light and dark, wide and narrow, by its address alone.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_shows_every_scene() {
    let Some((mut browser, page)) = opened("scenes") else { return };
    for (scene, lang, scheme) in
        SCENES.into_iter().flat_map(|scene| [(scene, "en", "light"), (scene, "zh", "dark")])
    {
        browser.prefer("prefers-color-scheme", scheme);
        browser.open(&page, &format!("#scene={scene}&lang={lang}"));
        settle(&mut browser);
        let shown =
            browser.eval("[state.scene, state.lang, view.shown.length > 0, last.answer.error]");
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
    let unnamed = "Object.entries(names).flatMap(([list, all]) => ['recorded', 'figures'].includes(list) ? [] : all)
        .map(entry => entry.name).filter(name => !ABOUT_ZH[name])";
    assert_eq!(browser.eval(unnamed), json!([]), "cases and families are told in Chinese too");
}

/// An address may hold anything: what cannot be drawn is said, the scene is shown as it begins, and nothing is thrown.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_survives_any_address() {
    let Some((mut browser, page)) = opened("addresses") else { return };
    let refused = [
        "#scene=triangle&window=0,0,300,300",
        "#scene=triangle&window=5,5,5,5",
        "#scene=line&window=0,0,-1e9,4",
        "#scene=triangle&t=0,0_1e9,0_0,1e300",
        "#scene=line&lines=0,0,1e300,5",
        "#case=no-such-case",
        "#case=sliver%23-1&seed=x",
        "#scene=culling&removes=everything",
        "#scene=weights&snap=0",
    ];
    let taken = [
        "#scene=near&points=null&near=[]",
        "#scene=near&points=[[1,2,3],[1,2,null],[1]]&near=\"x\"",
        "#scene=line&step={}",
        "#scene=constructor&lang=__proto__",
        "#scene=triangle&by=nobody&px=1e300,nan&snap=x&numbers=2",
        "#scene=triangle&t=;;_&window=a,b,c,d",
        "#%%%&&=&scene",
    ];
    let all = refused.into_iter().map(|a| (a, true)).chain(taken.into_iter().map(|a| (a, false)));
    for (address, is_refused) in all {
        browser.open(&page, &format!("{address}&lang=en"));
        settle(&mut browser);
        let shown = browser.eval("[view.shown.length > 0, last.answer?.error ?? null]");
        assert_eq!(shown, json!([true, null]), "{address}");
        let trouble = browser.text("#trouble");
        assert_eq!(trouble.contains("cannot be shown"), is_refused, "{address}: {trouble}");
    }
}

/// A specimen is hunted until it is caught, then shrunk; the command names what is shown.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_breaks_a_specimen() {
    let Some((mut browser, page)) = opened("break") else { return };
    browser.open(&page, "#case=T2&lang=en");
    settle(&mut browser);
    assert_eq!(browser.text("#command"), "rasterproof inspect T2 --plant exclusive-edges");
    browser.click("#search");
    browser.wait_for("document.getElementById('hunt').textContent.startsWith('caught by')");
    browser.wait_for("document.getElementById('hunt').textContent.includes('shrunk, ') && !hunt");
    settle(&mut browser);
    let wrong = "last.answer.panels.some(p => p.name === 'games101-strict' && p.missing > 0)";
    assert_eq!(browser.eval(wrong), true, "what is left still fails");
    assert_eq!(browser.eval("state.triangles.length"), 1);
    // Off the lattice the same, and the pixel is explained there.
    browser.eval("(document.getElementById('family').value = 'f32-tie')");
    browser.click("#search");
    browser.wait_for("!hunt && !state.snap");
    settle(&mut browser);
    assert_eq!(browser.eval(wrong), true);
    assert!(browser.text("#look").contains("decided exactly"), "{}", browser.text("#look"));
    // The engines stop on nothing that the page can send: what it cannot draw is an error in words.
    let bad = browser.eval("ask({ ask: 'named', name: 'T99' }).error");
    assert!(bad.as_str().unwrap().contains("T99"));
}

/// Pixels and their hits, as a report page packs them, as digits.
fn digits(runs: &Value) -> String {
    let runs: Vec<usize> = serde_json::from_value(runs.clone()).unwrap();
    runs.chunks(2).map(|run| run[1].min(9).to_string().repeat(run[0])).collect()
}

/// The command beside the panels shows the same to a shell: corners, window, and who hits which pixel.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_says_its_command() {
    let Some((mut browser, page)) = opened("command") else { return };
    let folder = folder("playground-command-inspect");
    let fan = "document.getElementById('shape-fan').click()";
    let drag = "grips()[1].place(3.5, 7.25)";
    let free =
        "#snap=0&t=0.1,0.2_5.3,0.7_2.123456789,6.1;1e-7,4_5.3,0.7_-1.5,9.75&by=oracle,scanline";
    // The bottom edge runs through samples that are its neighbour's.
    let tie = "#snap=0&t=0.5,5.5_5.5,5.5_2.1,1.3&by=edge-function,inclusive-edges";
    for (fragment, change, options) in [
        ("#scene=triangle", "", "--plant exclusive-edges"),
        ("#by=oracle,scanline", fan, "--window 0,0,14x14"),
        ("#by=oracle,edge-function", "(grips()[0].place(-3.5, 2), view.zoom(1))", "--window"),
        (free, "", "--exact"),
        (tie, "", "--plant exact-inclusive-ties"),
        ("#case=T2&by=oracle,sysu-inclusive", "", "inspect T2 --specimen sysu-inclusive"),
        ("#case=T2&by=oracle,scanline", "view.pan(2, -1)", "--window 2,-1,"),
        ("#case=T2&by=oracle,scanline&snap=0", "", "inspect T2 --exact"),
        ("#case=double_row&by=oracle,scanline", "", "--window"),
        ("#case=f32-tie%235&seed=3&by=oracle,scanline", "", "'f32-tie#5' --seed 3"),
        ("#case=fan%235&seed=3&by=oracle,scanline", drag, "--window"),
        ("#case=w-100%235&seed=3&by=oracle,scanline", drag, "--window"),
        ("#case=uniform%235&seed=3&by=oracle,scanline&snap=0", "", "--seed 3 --exact"),
        ("#scene=line&by=dda,book-dda", "", "--line"),
        ("#scene=line&case=L9", drag, "--line"),
        ("#scene=perspective", "", "--specimen book-affine"),
        ("#scene=depth", "", "--window"),
        ("#scene=samples", drag, "--window"),
        ("#scene=culling", "", "--window"),
    ] {
        browser.open(&page, &format!("{fragment}&lang=en"));
        settle(&mut browser);
        browser.eval(if change.is_empty() { "0" } else { change });
        settle(&mut browser);
        assert_eq!(browser.eval("document.getElementById('trouble').hidden"), true, "{fragment}");
        let said = browser.text("#command");
        let words = said.strip_prefix("rasterproof ").unwrap();
        assert!(said.contains(options), "{fragment}: {said}");
        // A corner without values has others to the command line than one with w = 1.
        let bare = |word: &&str| word.matches(',').count() == 1 && !word.contains('x');
        let with = |word: &&str| word.matches(',').count() > 1 && !word.contains('x');
        let [bare, with] =
            [words.split(' ').filter(bare).count(), words.split(' ').filter(with).count()];
        assert!(bare == 0 || with == 0, "{said}");
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("\"$0\" {words} --report"), PROGRAM]).current_dir(&folder);
        Run::of(&mut shell).has(u8::from(words.contains("--plant")));
        let report =
            std::fs::read_to_string(folder.join("target/rasterproof/inspect.html")).unwrap();
        let (_, json) = report.split_once("id=\"data\">").unwrap();
        let json: Value = serde_json::from_str(json.split_once("</script>").unwrap().0).unwrap();
        let case = &json["cases"][0];
        let sides = ["x0", "y0", "x1", "y1"].map(|side| case["window"][side].clone());
        assert_eq!(browser.eval("state.window"), json!(sides), "{said}");
        let places = browser.eval(
            "state.lines ?? state.triangles.map(t => t.map(c => state.snap ? [c.x * 256, c.y * 256] : [c.x, c.y]))",
        );
        let places = [&case["shape"]["points"], &places]
            .map(|places| serde_json::from_value::<Vec<Vec<[f64; 2]>>>(places.clone()).unwrap());
        assert_eq!(places[0], places[1], "{said}");
        // Who is on the panels hits the same pixels there; off the lattice the exact forms do.
        let panels = browser.eval(
            "(() => {
                const [x0, y0, x1, y1] = state.window, { truth, panels = [] } = last.answer;
                const digits = (pixels) => {
                    const hits = new Array((x1 - x0) * (y1 - y0)).fill(0);
                    for (const [x, y] of pixels.flat()) hits[(y - y0) * (x1 - x0) + x - x0] += 1;
                    return hits.join('');
                };
                const names = { oracle: 'oracle', 'inclusive-edges': 'exact-inclusive-ties' };
                const exact = (name) => names[name] ?? `${name}-exact`;
                return [['oracle', truth], ...panels.map(p => [p.name, p.hits ?? p.pixels])]
                    .map(([name, hits]) => [state.snap ? name : exact(name), state.lines ? digits(hits) : hits])
                    .filter(([, hits]) => typeof hits === 'string');
            })()",
        );
        let compared = panels.as_array().unwrap();
        for panel in compared {
            let named = |layer: &&Value| layer["names"].as_array().unwrap().contains(&panel[0]);
            let layer = case["layers"].as_array().unwrap().iter().find(named);
            let layer = layer.unwrap_or_else(|| panic!("{said}: nobody is called {}", panel[0]));
            assert_eq!(digits(&layer["runs"]), panel[1].as_str().unwrap(), "{said}: {}", panel[0]);
        }
        let shows_hits =
            !["perspective", "depth", "samples", "culling"].iter().any(|s| fragment.contains(s));
        assert_eq!(compared.len() >= 3, shows_hits, "{said}: {compared:?}");
    }
}

/// A case of the report page leads to the same corners in the playground, by its name or its places.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_opens_cases_of_the_report() {
    let Some((mut browser, page)) = opened("report") else { return };
    for (words, shown) in [
        ("T2", "state.named === 'T2' && state.triangles.length === 2"),
        ("sliver#3 --seed 7", "state.generated.index === 3 && state.generated.seed === 7"),
        ("0.5,0.5 5.5,0.5 5.5,5.5", "state.triangles[0][2].y === 5.5 && !state.named"),
        ("--line 0,0 8,3", "state.scene === 'line' && state.lines[0][1][0] === 8"),
        ("--line 0,0 8,3 8,3 2,9", "state.lines.length === 2"),
        ("0,0 4,0 0,4 4,0 4,4 0,4", "state.triangles.length === 2 && state.snap"),
        ("0.1,0.2 5.3,0.7 2,6.1 --exact", "state.triangles[0][0].x === 0.1 && !state.snap"),
        // A fault is shown beside what is right.
        (
            "T2 --plant inclusive-edges",
            "state.by[0] === 'inclusive-edges' && state.named === 'T2' && document.querySelector('#look .say')?.textContent.includes('hit twice')",
        ),
        // So large a window is cut to what the playground can show.
        ("T2 --window 0,0,300x20", "state.triangles.length === 2 && view.shown.length === 2"),
    ] {
        let folder = folder("playground-report-inspect");
        // A page leads to the playground only where that lies beside it.
        let pages = folder.join("target/rasterproof");
        std::fs::create_dir_all(&pages).unwrap();
        std::fs::write(pages.join("playground.html"), "").unwrap();
        let mut program = shared().command(format!("inspect --report {words}"));
        let status = u8::from(words.contains("--plant"));
        Run::of(program.current_dir(&folder)).has(status);
        browser.open(&folder.join("target/rasterproof/inspect.html"), "");
        assert_eq!(browser.eval("document.querySelector('#case-playground').hidden"), false);
        let link =
            browser.eval("document.querySelector('#case-playground a').getAttribute('href')");
        let fragment = link.as_str().unwrap().strip_prefix("playground.html").unwrap().to_owned();
        browser.open(&page, &fragment);
        settle(&mut browser);
        assert_eq!(browser.eval(shown), true, "{words}: {fragment}");
        assert_eq!(browser.eval("document.getElementById('trouble').hidden"), true);
    }
}

/// Every chapter names its scene, from both languages alike, and the address opens it.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_is_where_chapters_lead() {
    let links = |folder: &str| -> Vec<(String, String)> {
        let mut pages: Vec<_> = (1..=11).map(|n| format!("ch{n:02}")).collect();
        pages.push("games101".to_owned());
        let link = |page: String| {
            // A chapter links it itself, or the page with its evidence does.
            let evidence = format!("{folder}/{page}-evidence.md");
            let evidence = std::fs::read_to_string(root().join(evidence)).unwrap_or_default();
            let text = crate::pages::page(folder, &page) + &evidence;
            let found: Vec<_> = text
                .split("](playground.md#scene=")
                .skip(1)
                .map(|rest| (page.clone(), format!("#scene={}", rest.split(')').next().unwrap())))
                .collect();
            assert!(!found.is_empty(), "{folder}/{page} names no scene of the playground");
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
}

/// Without its module the command says how to get one; what is no module is refused, nothing written.
#[test]
fn playground_says_what_it_needs() {
    let folder = Folder::new("playground-none");
    folder.check("playground", 2).without_output().says("crates/playground/build");
    folder.put("x.wasm", "no module");
    let run = folder.check("playground --module x.wasm", 2);
    run.says("x.wasm is no WebAssembly module");
    assert!(!folder.join("target").exists());
}
