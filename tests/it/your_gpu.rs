//! The page that judges a browser's GPU, in headless Chromium, whose WebGL 2 and WebGPU are drawn by
//! SwiftShader: the verdict, every planted fault, a lost context, and a case repeated from its address.
//!
//! Needs the module that `crates/playground/build` leaves, and Chromium, as the playground does.

use serde_json::{Value, json};

use crate::browser::{Browser, Tab};
use crate::firefox::Firefox;
use crate::playground::written;

/// Without a card Chromium draws WebGL by SwiftShader, and WebGPU where it is told to.
pub const SWIFTSHADER: [&str; 4] = [
    "--disable-gpu-sandbox",
    "--enable-unsafe-swiftshader",
    "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader",
];

/// The faults with the check that finds them, its batch, and its word for WebGL 2 and for WebGPU: what the specification
/// leaves open is found, and called free.
const PLANTS: [(&str, &str, u64, [&str; 2]); 15] = [
    ("moved", "lattice", 0, ["allowed", "allowed"]),
    ("coarse", "lattice", 0, ["outside", "allowed"]),
    ("nudged", "coverage", 0, ["outside", "outside"]),
    ("dropped", "coverage", 3, ["outside", "outside"]),
    ("twice", "coverage", 0, ["outside", "outside"]),
    ("nudged", "reach", 0, ["outside", "outside"]),
    ("twice", "tiling", 0, ["outside", "outside"]),
    ("first-corner", "tiling", 0, ["outside", "allowed"]),
    ("first-corner", "order", 0, ["outside", "outside"]),
    ("winding", "facing", 0, ["outside", "outside"]),
    ("lines-moved", "lines", 0, ["outside", "allowed"]),
    ("farther", "depth", 0, ["outside", "outside"]),
    ("w-ignored", "values", 0, ["outside", "outside"]),
    ("no-near-plane", "near-plane", 0, ["outside", "outside"]),
    ("samples-moved", "samples", 0, ["allowed", "outside"]),
];

/// Draws what a bug report holds by nothing but its text, and compares with the pixels that it shows.
const DRAWS_ALONE: &str = include_str!("../data/pages/draws-alone.js");

/// Judges with a fault, or none; the rows of each interface as {check: [word, sentence]}.
fn rows(tab: &mut dyn Tab, plant: Option<&str>, options: &Value) -> Vec<Value> {
    tab.eval(&format!("(state.plant = {}, judgeAll({options}), null)", json!(plant)));
    tab.wait_for("!state.running");
    let rows = tab.eval(
        "state.results.map(result => Object.fromEntries(Object.entries(result.rows).map(
            ([check, row]) => [check, [row.word, word('details')[check](row.tally, row.facts)]])))",
    );
    let notes = tab.eval("state.results.map(result => result.notes.map(said))");
    assert!(!notes.to_string().contains("The interface failed"), "{notes}");
    serde_json::from_value(rows).unwrap()
}

/// One batch of each check, and each family of coverage.
fn parts() -> Value {
    let checks = [
        "lattice", "reach", "tiling", "order", "facing", "lines", "depth", "values", "samples",
        "twice",
    ];
    let mut parts: Vec<_> = checks.iter().map(|check| json!([check, 0])).collect();
    parts.extend((0..12).map(|family| json!(["coverage", family])));
    parts.extend((0..4).map(|number| json!(["near-plane", number])));
    json!(parts)
}

/// Checks that everything is as promised or free, but for a corner in the plane w = 0.
fn is_right(tab: &mut dyn Tab, rows: &Value, api: &str) {
    eprintln!("{api}: {rows:#}");
    let rows = rows.as_object().unwrap();
    assert_eq!(rows.len(), 12, "{api} answers every check");
    for (check, row) in rows {
        // One of the renderers does not draw it.
        let is_known = check == "near-plane"
            && tab.eval(&format!(
                "state.results.find(r => r.name === {api:?}).rows['near-plane'].broken?.[0].some(v => v[3] === 0)"
            )) == json!(true);
        assert!(row[0] != "outside" || is_known, "{api}, {check}: {row}");
    }
    for check in ["coverage", "reach", "tiling", "order", "facing", "values", "samples", "twice"] {
        assert_eq!(rows[check][0], "equal", "{api}, {check}");
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn your_gpu_is_judged_by_both_interfaces() {
    let Some(page) = written("your-gpu", "page") else { return };
    let Some(mut browser) = Browser::start_with("your-gpu-browser", &SWIFTSHADER) else { return };
    browser.open(&page, "#lang=en");
    let clean = rows(&mut browser, None, &json!({ "only": parts(), "shrinks": false }));
    for (rows, api) in clean.iter().zip(["webgl2", "webgpu"]) {
        is_right(&mut browser, rows, api);
    }
    assert!(clean.iter().all(|rows| rows["lattice"][1].as_str().unwrap().contains("1/16 px")));
    assert_eq!(browser.eval("state.results.every(result => result.isSoftware)"), true);
    for (plant, check, number, words) in PLANTS {
        let options = json!({ "only": [[check, number]], "bits": 4, "shrinks": false });
        let right = rows(&mut browser, None, &options);
        let planted = rows(&mut browser, Some(plant), &options);
        for ((rows, right), word) in planted.iter().zip(&right).zip(words) {
            assert_eq!(rows[check][0], word, "{plant}: {}", rows[check]);
            assert_ne!(rows[check][1], right[check][1], "{plant} is told from no fault");
        }
    }
    let options = json!({ "only": [["coverage", 0], ["twice", 0]], "bits": 4, "shrinks": false });
    let right = rows(&mut browser, None, &options);
    let noisy = rows(&mut browser, Some("noise"), &options);
    assert!(noisy[0]["twice"][0] == "outside" && noisy[1]["twice"][0] == "allowed", "{noisy:?}");
    // What changes from one time to the next is shown as it is, and no cause is looked for.
    let options_of = json!({ "only": [["coverage", 0], ["twice", 0]], "bits": 4 });
    rows(&mut browser, Some("noise"), &options_of);
    let shown = browser.eval("state.results.map(r => 'twice' in r.views && r.cause === undefined)");
    assert_eq!(shown, json!([true, true]));
    // What is lost is opened anew, and nothing else changes.
    let lost = rows(&mut browser, Some("lost"), &options);
    assert_eq!(lost, right);
    let notes = browser.eval("state.results.map(r => r.notes.some(([key]) => key === 'lostOnce'))");
    assert_eq!(notes, json!([true, true]));
    // Noise that is the same each time changes no verdict, and is said.
    let faint = rows(&mut browser, Some("faint-noise"), &options);
    assert_eq!(faint, right);
    let notes = browser.eval("state.results.map(r => r.notes.some(([key]) => key === 'uneven'))");
    assert_eq!(notes, json!([true, true]));
    // Each check is named before the run, and its address makes it alone.
    browser.open(&page, "#lang=en");
    let checks = "[...document.querySelectorAll('#checks a')].map(a => a.hash)";
    let checks: Vec<String> = browser.value(checks);
    assert_eq!(checks.len(), 12, "{checks:?}");
    assert!(checks.contains(&"#check=lines&lang=en".to_owned()));
    browser.open(&page, "#check=lines&lang=en");
    browser.wait_for("document.body.dataset.done !== undefined");
    let judged = browser.eval("state.results.map(result => Object.keys(result.rows))");
    assert_eq!(judged, json!([["lines"], ["lines"]]));
    a_finding_is_shown(&mut browser, &page);
    what_is_refused_is_said(&mut browser, &page);
}

/// A second browser, another renderer, and the same questions of WebGL 2. Firefox has no WebGPU here.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn firefox_is_judged() {
    let Some(page) = written("your-gpu", "firefox") else { return };
    let Some(mut firefox) = Firefox::start("your-gpu") else { return };
    firefox.open(&page, "#lang=en");
    let clean = rows(&mut firefox, None, &json!({ "only": parts(), "shrinks": false }));
    is_right(&mut firefox, &clean[0], "webgl2");
    assert_eq!(clean[1], json!({}), "no WebGPU");
    for (plant, check, number, [word, _]) in PLANTS {
        let options = json!({ "names": ["webgl2"], "only": [[check, number]], "shrinks": false });
        let planted = rows(&mut firefox, Some(plant), &options);
        // A step of 1/256 px moves no centre over an edge of these triangles, only off one.
        let is_tiny = (plant, check) == ("nudged", "coverage");
        let word = if is_tiny { "allowed" } else { word };
        assert_eq!(planted[0][check][0], word, "{plant}: {}", planted[0][check]);
    }
}

/// The smallest case, its text for a report, and the address that repeats it.
fn a_finding_is_shown(browser: &mut Browser, page: &std::path::Path) {
    let options = json!({ "names": ["webgpu", "webgl2"], "only": [["coverage", 0]], "bits": 4 });
    rows(browser, Some("nudged"), &options);
    let cause = browser.text("[data-api=webgl2] .cause");
    assert!(
        cause.contains("probable cause: It samples at (0.4375, 0.4375) of the pixel"),
        "{cause}"
    );
    // Below the headline of the first interface its finding stands, with pixels that can be seen and both pictures.
    let shown = browser.eval(
        "(() => { const { previousElementSibling: before, hidden } = document.getElementById('finding');
            return [hidden, before.className, before.parentElement.dataset.api, pixels.unit >= 24, pixels.shown.length]; })()",
    );
    assert_eq!(shown, json!([false, "cause", "webgpu", true, 2]));
    // The pixel is explained as on every page: a table of edges with the sides that decide.
    let why = browser.eval("[...document.querySelectorAll('#why .edges tbody tr')].map(row => [row.cells[1].textContent[0] === '-', row.cells[2].textContent])");
    let why: Vec<(bool, String)> = serde_json::from_value(why).unwrap();
    assert_eq!(why.len() % 3, 0, "{why:?}");
    assert!(
        !why.is_empty() && why.iter().all(|(below, side)| (side == "outside") == *below),
        "{why:?}"
    );
    browser.click("[data-api=webgl2] [data-check=coverage] button");
    // The headline names the check, and the keyboard is where the case is.
    assert_eq!(browser.text("[data-api=webgl2] .verdict"), "coverage: 1 check breaks a promise.");
    let focused = browser.eval("document.activeElement.textContent");
    assert_eq!(focused, "WebGL 2, coverage: The smallest case that was found");
    let report = browser.text("#report");
    for part in [
        "Renderer: ANGLE",
        "exactly one of the polygons",
        "It samples at",
        "gl_VertexID",
        "Expected:",
        "Drawn:",
        "Page: ",
        "planted",
    ] {
        assert!(report.contains(part), "{part}: {report}");
    }
    let address = browser.eval("document.querySelector('#finding a').hash");
    let address = address.as_str().unwrap();
    browser.open(page, &format!("{address}&lang=en"));
    browser.wait_for("document.body.dataset.done !== undefined");
    assert_eq!(browser.text("#one .outside"), "This case breaks the promise here.");
    // The shaders hold the case and not the fault, so what they draw is something else.
    assert_eq!(browser.eval(DRAWS_ALONE), json!(false));
    // Without the fault the same case is right, and its shaders draw what the page has drawn.
    let fixed = address.replace("&plant=nudged", "");
    for address in [fixed.replace("webgl2", "webgpu"), fixed] {
        browser.open(page, &format!("{address}&lang=en"));
        browser.wait_for("document.body.dataset.done !== undefined");
        assert_eq!(browser.text("#one .equal"), "This case is as promised here.");
        assert_eq!(browser.eval(DRAWS_ALONE), json!(true), "{address}");
    }
    // An address that holds no case says so.
    for bad in
        ["%5B%5D", "nothing", "%5B%5B%5B1%5D%5D%5D", "%5B%5B%5B1e9%2C0%2C0%2C0%2C0%2C0%5D%5D%5D"]
    {
        browser.open(page, &format!("#interface=webgl2&check=coverage&case={bad}&lang=en"));
        browser.wait_for("document.querySelector('#one .outside') !== null");
        assert!(browser.text("#one").contains("no case that can be drawn"), "{bad}");
    }
    for width in [1280, 360] {
        browser.resize(width, 900);
        let wide = browser.eval("document.documentElement.scrollWidth").as_u64().unwrap();
        assert!(wide <= u64::from(width), "{wide} px wide in a window of {width}");
    }
    browser.open(page, "#lang=en");
    assert_eq!(browser.text("#judge"), "Judge my GPU");
    let keys = "['en', 'zh'].map(l => JSON.stringify([WORDS[l], WORDS[l].checks, WORDS[l].details].map(Object.keys)))
        .every((keys, i, all) => keys === all[i - i % 2])";
    assert_eq!(browser.eval(keys), true, "both languages have the same words");
}

/// An interface that is missing, an adapter or a device that is refused; the other interface is judged.
fn what_is_refused_is_said(browser: &mut Browser, page: &std::path::Path) {
    let options = json!({ "only": [["coverage", 3]], "bits": 4, "shrinks": false });
    for (takes, name, says) in [
        (
            "Object.getPrototypeOf(navigator.gpu).requestAdapter = async () => null",
            "webgpu",
            "gave no adapter",
        ),
        (
            "GPUAdapter.prototype.requestDevice = async () => { throw new Error('limits') }",
            "webgpu",
            "refused to make a device (limits)",
        ),
        (
            "Object.defineProperty(Navigator.prototype, 'gpu', { value: undefined })",
            "webgpu",
            "has no WebGPU",
        ),
        ("HTMLCanvasElement.prototype.getContext = () => null", "webgl2", "gives no WebGL 2"),
    ] {
        browser.open(page, "#lang=en");
        browser.eval(&format!("({takes}, null)"));
        let rows = rows(browser, None, &options);
        let shown = browser.text(&format!("[data-api={name}]"));
        assert!(shown.contains(says), "{takes}: {shown}");
        let refused = usize::from(name == "webgpu");
        assert_eq!(rows[refused], json!({}), "{takes}");
        assert_eq!(rows[1 - refused]["coverage"][0], "equal", "{takes}");
        assert!(!browser.text("#results").contains("Nothing could be judged"), "{takes}");
    }
    // With neither interface the page says what to do.
    browser.open(page, "#lang=en");
    browser.eval(
        "(HTMLCanvasElement.prototype.getContext = () => null,
            Object.defineProperty(Navigator.prototype, 'gpu', { value: undefined }), null)",
    );
    rows(browser, None, &options);
    assert!(browser.text("#results").contains("Turn on hardware acceleration"));
}
