//! The page that judges a browser's GPU, in headless Chromium, whose WebGL 2 and WebGPU are drawn by
//! SwiftShader: the verdict, every planted fault, a lost context, and a case repeated from its address.
//!
//! Needs the module that `crates/playground/build` leaves, and Chromium, as the playground does.

use serde_json::{Value, json};

use crate::page::Browser;
use crate::playground::written;

/// Without a card Chromium draws WebGL by SwiftShader, and WebGPU where it is told to.
const SWIFTSHADER: [&str; 4] = [
    "--disable-gpu-sandbox",
    "--enable-unsafe-swiftshader",
    "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader",
];

/// The faults with the check that finds them, its batch, and its word for WebGL 2 and for WebGPU: what the specification
/// leaves open is found, and called free.
const PLANTS: [(&str, &str, u64, [&str; 2]); 14] = [
    ("moved", "lattice", 0, ["free", "free"]),
    ("coarse", "lattice", 0, ["broken", "free"]),
    ("nudged", "coverage", 0, ["broken", "broken"]),
    ("dropped", "coverage", 3, ["broken", "broken"]),
    ("twice", "coverage", 0, ["broken", "broken"]),
    ("nudged", "reach", 0, ["broken", "broken"]),
    ("twice", "tiling", 0, ["broken", "broken"]),
    ("first-corner", "order", 0, ["broken", "broken"]),
    ("winding", "facing", 0, ["broken", "broken"]),
    ("lines-moved", "lines", 0, ["broken", "free"]),
    ("farther", "depth", 0, ["broken", "broken"]),
    ("w-ignored", "values", 0, ["broken", "broken"]),
    ("no-near-plane", "near-plane", 0, ["broken", "broken"]),
    ("samples-moved", "samples", 0, ["free", "broken"]),
];

/// Judges with a fault, or none; the rows of both interfaces as {check: [word, sentence]}.
fn rows(browser: &mut Browser, plant: Option<&str>, options: &Value) -> [Value; 2] {
    browser.eval(&format!("state.plant = {}; judgeAll({options}); null", json!(plant)));
    browser.wait_for("!state.running");
    let rows = browser.eval(
        "state.results.map(result => Object.fromEntries(Object.entries(result.rows).map(
            ([check, row]) => [check, [row.word, word('details')[check](row.tally, row.facts)]])))",
    );
    let notes = browser.eval("state.results.map(result => result.notes.map(said))");
    let [first, second] = serde_json::from_value(rows).unwrap();
    assert!(!notes.to_string().contains("The interface failed"), "{notes}");
    [first, second]
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn your_gpu_is_judged_by_both_interfaces() {
    let Some(page) = written("your-gpu", "page") else { return };
    let Some(mut browser) = Browser::start_with("your-gpu-browser", &SWIFTSHADER) else { return };
    browser.open(&page, "#lang=en");
    let checks =
        ["lattice", "reach", "tiling", "order", "facing", "lines", "depth", "values", "samples"];
    let mut only: Vec<_> = checks.iter().map(|check| json!([check, 0])).collect();
    only.extend((0..12).map(|family| json!(["coverage", family])));
    only.extend((0..4).map(|number| json!(["near-plane", number])));
    let clean = rows(&mut browser, None, &json!({ "only": only, "shrinks": false }));
    for (rows, api) in clean.iter().zip(["webgl2", "webgpu"]) {
        eprintln!("{api}: {rows:#}");
        let rows = rows.as_object().unwrap();
        assert_eq!(rows.len(), 12, "{api} answers every check");
        for (check, row) in rows {
            // A corner in the plane w = 0, which this renderer does not draw.
            let is_known = check == "near-plane"
                && browser.eval(&format!(
                    "state.results.find(r => r.name === {api:?}).rows['near-plane'].broken?.[0].some(v => v[3] === 0)"
                )) == json!(true);
            assert!(row[0] != "broken" || is_known, "{api}, {check}: {row}");
        }
        for check in
            ["coverage", "reach", "tiling", "order", "facing", "values", "samples", "twice"]
        {
            assert_eq!(rows[check][0], "promised", "{api}, {check}");
        }
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
    let options = json!({ "only": [["coverage", 0]], "bits": 4, "shrinks": false });
    let right = rows(&mut browser, None, &options);
    let noisy = rows(&mut browser, Some("noise"), &options);
    assert!(noisy[0]["twice"][0] == "broken" && noisy[1]["twice"][0] == "free", "{noisy:?}");
    // What is lost is opened anew, and nothing else changes.
    let lost = rows(&mut browser, Some("lost"), &options);
    assert_eq!(lost, right);
    let notes = browser.eval("state.results.map(r => r.notes.some(([key]) => key === 'lostOnce'))");
    assert_eq!(notes, json!([true, true]));
    a_finding_is_shown(&mut browser, &page);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// The smallest case, its text for a report, and the address that repeats it.
fn a_finding_is_shown(browser: &mut Browser, page: &std::path::Path) {
    let options = json!({ "names": ["webgpu", "webgl2"], "only": [["coverage", 0]], "bits": 4 });
    rows(browser, Some("nudged"), &options);
    browser
        .eval("document.querySelector('[data-api=webgl2] [data-check=coverage] button').click()");
    let corners = browser.eval("state.results[1].views.coverage.subject");
    assert_eq!(corners.as_array().unwrap().len(), 1, "one triangle is left: {corners}");
    let report = browser.text("#report");
    for part in
        ["Renderer: ANGLE", "exactly one of the polygons", "gl_VertexID", "Drawn", "planted"]
    {
        assert!(report.contains(part), "{part}: {report}");
    }
    let address = browser.eval("document.querySelector('#finding a').hash");
    browser.open(page, &format!("{}&lang=en", address.as_str().unwrap()));
    browser.wait_for("document.body.dataset.done !== undefined");
    assert_eq!(browser.text("#one .broken"), "This case breaks the promise here.");
    // Without the fault the same case is right, and an address that holds no case says so.
    let fixed = address.as_str().unwrap().replace("&plant=nudged", "");
    browser.open(page, &format!("{fixed}&lang=en"));
    browser.wait_for("document.body.dataset.done !== undefined");
    assert_eq!(browser.text("#one .promised"), "This case is as promised here.");
    for bad in
        ["%5B%5D", "nothing", "%5B%5B%5B1%5D%5D%5D", "%5B%5B%5B1e9%2C0%2C0%2C0%2C0%2C0%5D%5D%5D"]
    {
        browser.open(page, &format!("#interface=webgl2&check=coverage&case={bad}&lang=en"));
        browser.wait_for("document.querySelector('#one .broken') !== null");
        assert!(browser.text("#one").contains("no case that can be drawn"), "{bad}");
    }
    for width in [1280, 360] {
        browser.resize(width, 900);
        let wide = browser.eval("document.documentElement.scrollWidth").as_u64().unwrap();
        assert!(wide <= u64::from(width), "{wide} px wide in a window of {width}");
    }
    browser.open(page, "#lang=en");
    let keys = "['en', 'zh'].map(l => JSON.stringify([WORDS[l], WORDS[l].checks, WORDS[l].details].map(Object.keys)))
        .concat([RULES, RULES_ZH].map(r => JSON.stringify(Object.values(r).map(Object.keys))))
        .every((keys, i, all) => keys === all[i - i % 2])";
    assert_eq!(browser.eval(keys), true, "both languages have the same words");
}
