//! The report page in a browser: what it shows equals the JSON, and what it offers works.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use image::{Rgb, RgbImage};
use rasterproof_host::limits::PAGE_BYTES;
use rasterproof_report::html::{
    Figure, Outcome, PictureLayer, PictureView, Report, Statement, TextDiff, page,
};
use rasterproof_report::table::{Column, Row, Table};
use rasterproof_report::words::thousands;
use rasterproof_report::{canvas, picture};
use serde_json::{Value, json};

use crate::browser::{Browser, Tab as _, folder};
use crate::program::{Run, shared};
use crate::snapshots::ELSEWHERE;

impl Browser {
    fn names_listed(&mut self) -> Vec<String> {
        self.value("[...document.querySelectorAll('#list .name')].map(n => n.textContent)")
    }

    fn picture(&mut self) -> String {
        self.value("document.querySelector('rp-view .pixels').toDataURL()")
    }

    /// Moves the mouse over the middle of a pixel of the first panel, counted from the window's corner.
    fn hover(&mut self, x: u32, y: u32) {
        self.eval("document.querySelector('rp-view .pixels').scrollIntoView()");
        self.draw();
        let spot = self.value(&format!(
            "(() => {{ const v = document.querySelector('rp-view');
                const b = v.shown[0].canvas.getBoundingClientRect(), [x0, y0] = v.source.bounds;
                return [b.left + (x0 + {x} + 0.5 - v.seen[0]) * v.unit, b.top + (y0 + {y} + 0.5 - v.seen[1]) * v.unit]; }})()"
        ));
        self.mouse("mouseMoved", spot);
    }
}

/// Runs the program in a folder of its own; the status, what it printed, and the page.
fn run(name: &str, words: &str) -> (i32, String, PathBuf) {
    let folder = folder(name);
    let run = Run::of(shared().command(words).current_dir(&folder));
    let command = words.split(' ').next().unwrap();
    let page = folder.join(format!("target/rasterproof/{command}.html"));
    (run.status.unwrap(), run.out, page)
}

/// Rows of a table of the page: head of the row, head of the column, text.
fn cells(browser: &mut Browser) -> Vec<(String, String, String)> {
    let cells = browser.eval(
        "[...document.querySelectorAll('table.counts')].flatMap(table => {
            const heads = [...table.querySelectorAll('thead th')].map(h => h.textContent);
            return [...table.querySelectorAll('tbody tr')].flatMap(row => {
                const texts = [...row.children].map(c => c.textContent.replace(/(\\d),(?=\\d{3})/g, '$1'));
                return texts.slice(1).map((text, i) => [texts[0], heads[i + 1], text]);
            });
        })",
    );
    serde_json::from_value(cells).unwrap()
}

fn counts_equal_the_json(browser: &mut Browser, json: &Value) {
    let cells = cells(browser);
    let has = |row: &str, column: &str, text: &Value| {
        let text = text.to_string().replace('"', "");
        let found = cells
            .iter()
            .any(|(r, c, t)| r == row && c == column && t.split(',').next() == Some(text.as_str()));
        assert!(found, "{row}, {column}: {text} is not on the page");
    };
    let mut checked = 0;
    for family in json["families"].as_array().unwrap() {
        let name = family["family"].as_str().unwrap();
        let shapes = match family["kind"].as_str().unwrap() {
            "unsnapped" => "triangles off the grid",
            kind => kind,
        };
        has(name, "cases", &family["cases"]);
        has(name, shapes, &family["shapes"]);
        has(name, "pixels", &family["pixels"]);
        let [cases, ties] = ["cases", "tie_cases"].map(|key| family[key].as_u64().unwrap());
        has(name, "ties", &json!(format!("{}%", (100 * ties + cases / 2) / cases)));
        for pair in family["pairs"].as_array().unwrap() {
            let column = format!("{} : {}", pair["actual"], pair["target"]).replace('"', "");
            let kinds = ["missing", "extra", "twice", "order"];
            let total: u64 = kinds.iter().map(|k| pair["tally"][k].as_u64().unwrap()).sum();
            has(name, &column, &json!(total));
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked}");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_shows_a_verdict_and_its_cases() {
    let words = "verify --cases 60 --seed 3 --report --json";
    let (status, printed, page) = run("page", words);
    assert_eq!(status, 0);
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(text.len() < 2_000_000 && text.len() > 100_000, "{} bytes", text.len());
    let (_, _, again) = run("page-again", words);
    assert!(text == std::fs::read_to_string(again).unwrap(), "a seed makes one page");
    let Some(mut browser) = Browser::start("page") else { return };
    browser.open(&page, "");
    let json: Value = serde_json::from_str(&printed).unwrap();
    let verdict = ["#verdict", "#counts"].map(|id| browser.text(id)).join(" ");
    assert!(verdict.contains("AGREES") && verdict.contains(", 0 wrong pixels"), "{verdict}");
    assert!(
        verdict.contains(&format!(
            "{} triangles and ",
            thousands(json["triangles"].as_u64().unwrap())
        )),
        "{verdict}"
    );
    counts_equal_the_json(&mut browser, &json);
    // The page evaluates the rule by itself, in exact arithmetic, for every pixel of every case.
    assert_eq!(browser.eval("window.rasterproof.audit()"), json!([]));
    audit_sees_a_moved_corner(&mut browser, &text);
    blink_and_modes(&mut browser, &page);
    pixels_explain_themselves(&mut browser, &page);
    steps_and_lost_addresses(&mut browser, &page);
    browser.open(&page, "");
    search_and_filters(&mut browser);
    chapters_exist(&mut browser);
    narrow_and_still(&mut browser, &page);
}

/// A corner of T2 moved by a subpixel to the right: samples on its right edge are inside now.
fn audit_sees_a_moved_corner(browser: &mut Browser, page: &str) {
    let (corner, moved) = ("[1408,128],[1408,1408]]", "[1409,128],[1408,1408]]");
    assert_eq!(page.matches(corner).count(), 1);
    let path = folder("page-moved").join("index.html");
    std::fs::write(&path, page.replace(corner, moved)).unwrap();
    browser.open(&path, "#case-T2");
    assert_eq!(browser.eval("window.rasterproof.audit()"), json!(["T2"]));
    assert!(browser.text("#by-rule").contains("says something else than the oracle"));
}

fn blink_and_modes(browser: &mut Browser, page: &Path) {
    browser.open(page, "#case-T2&a=games101-strict&b=oracle&mode=blink");
    assert_eq!(browser.text("#case-title"), "T2");
    assert_eq!(browser.text("#case-command code"), "rasterproof inspect T2");
    // It blinks by itself, slower than three times a second.
    browser.wait_for("document.querySelector('rp-view').dataset.phase === 'A'");
    let a = browser.picture();
    browser.wait_for("document.querySelector('rp-view').dataset.phase === 'B'");
    let b = browser.picture();
    assert_ne!(a, b);
    browser.press("b");
    let phase = browser.eval("document.querySelector('rp-view').dataset.phase");
    std::thread::sleep(Duration::from_millis(900));
    assert_eq!(browser.eval("document.querySelector('rp-view').dataset.phase"), phase, "paused");
    browser.click("#other");
    assert_ne!(browser.eval("document.querySelector('rp-view').dataset.phase"), phase);
    for (key, mode, panels) in
        [("2", "slider", 1), ("3", "side", 3), ("4", "onion", 1), ("1", "blink", 1)]
    {
        browser.press(key);
        let is = browser.eval(
            "[document.querySelector('rp-view').dataset.mode, document.querySelectorAll('rp-view .pixels').length,
              document.querySelector('#modes :checked').value]",
        );
        assert_eq!(is, json!([mode, panels, mode]));
        browser.wait_for(&format!("location.hash.includes('mode={mode}')"));
        assert!(![a.as_str(), b.as_str()].contains(&browser.picture().as_str()) || panels == 1);
    }
    browser.press("2");
    // Without a playground beside the page no link leads there.
    let links =
        "['#case-playground', '#no-playground'].map(id => document.querySelector(id).hidden)";
    assert_eq!(browser.eval(links), json!([true, false]));
    let half = browser.picture();
    assert!(half != a && half != b, "a slider shows a part of both");
    browser.press("b");
    assert_eq!(browser.eval("document.querySelector('rp-view').dataset.mode"), json!("blink"));
    // What was zoomed to in one panel does not spread over four.
    browser.open(page, "#case-T2");
    for _ in 0..6 {
        browser.click("[data-tool=zoomIn]");
    }
    browser.press("3");
    let inside = "[...document.querySelectorAll('rp-view .frame')].every(p => p.getBoundingClientRect().right <= innerWidth)
        && document.querySelectorAll('rp-view .frame').length === 3";
    browser.wait_for(inside);
    // Side by side the oracle is beside two others, and never there twice.
    browser.open(page, "#case-T2&mode=side&a=games101-strict&b=sysu-inclusive");
    let heads =
        browser.eval("[...document.querySelectorAll('.panel figcaption')].map(c => c.textContent)");
    let oracles = |heads: &Value| {
        heads.as_array().unwrap().iter().filter(|h| h.as_str().unwrap().contains("oracle")).count()
    };
    assert_eq!((heads.as_array().unwrap().len(), oracles(&heads)), (4, 1), "{heads}");
}

/// The next and the previous case by key; an address that leads nowhere says so.
fn steps_and_lost_addresses(browser: &mut Browser, page: &Path) {
    browser.open(page, "");
    let names = browser.names_listed();
    assert_eq!(browser.text("#case-title"), names[0]);
    for (key, at) in [("n", 1), ("n", 2), ("p", 1), ("p", 0), ("p", names.len() - 1)] {
        browser.press(key);
        browser.wait_for(&format!("document.body.dataset.ready === {:?}", names[at]));
        assert_eq!(browser.text("#place"), format!("{} of {}", at + 1, names.len()));
    }
    for (fragment, lost, at) in [
        ("#no-such", "This page has no place called no-such", names[0].as_str()),
        ("#case-T2&a=nobody", "Nobody called nobody draws this case", "T2"),
        ("#case-T2&mode=fast", "There is no way to compare called fast", "T2"),
        ("#case-T2&px=99,0", "This case has no pixel 99,0", "T2"),
        ("#case-no%20such&mode=side", "This page has no case called no such", &names[0]),
    ] {
        browser.open(page, fragment);
        assert_eq!(browser.text("#lost"), format!("{lost}; this is {at}."));
        assert_eq!(browser.eval("document.querySelector('#lost').hidden"), json!(false));
    }
    browser.press("n");
    browser.wait_for("document.querySelector('#lost').hidden");
}

/// The first screen shows the picture of the case, cropped, with numbers and corners, at any width.
fn first_screen_is_the_picture(browser: &mut Browser, page: &Path) {
    for (width, height) in [(1280, 900), (400, 850)] {
        browser.resize(width, height);
        browser.open(page, "");
        fits_the_width(browser);
        let box_of = |selector: &str| {
            format!(
                "(() => {{ const b = document.querySelector({selector:?}).getBoundingClientRect();
                    return [b.top, b.bottom, b.width, innerHeight]; }})()"
            )
        };
        let numbers = |value: Value| -> Vec<f64> { serde_json::from_value(value).unwrap() };
        let port = numbers(browser.eval(&box_of("rp-view .frame")));
        assert!(port[0] > 0.0 && port[1] <= port[3] && port[2] >= 150.0, "{width}: {port:?}");
        let title = numbers(browser.eval(&box_of("#case-title")));
        assert!(title[1] <= port[0], "its name stands over it: {title:?} {port:?}");
        // Something is written on both axes.
        for axis in ["above", "beside"] {
            let ink = browser.eval(&format!(
                "(() => {{ const c = document.querySelector('.{axis}');
                    return c.getContext('2d').getImageData(0, 0, c.width, c.height).data
                        .filter((v, i) => i % 4 === 3 && v > 0).length; }})()"
            ));
            assert!(ink.as_u64() > Some(20), "{axis} at {width}: {ink}");
        }
        let cell = browser.eval("Number(document.querySelector('rp-view').dataset.cell)");
        assert!(cell.as_f64() >= Some(16.0), "{cell}");
    }
    browser.resize(1280, 900);
    let png = browser.eval("window.rasterproof.snapshot()");
    let png = png.as_str().unwrap();
    assert!(png.starts_with("data:image/png;base64,") && png.len() > 5000, "{}", png.len());
}

fn pixels_explain_themselves(browser: &mut Browser, page: &Path) {
    // The sample of (3, 3) lies on the diagonal that both triangles of T2 share.
    browser.open(page, "#case-T2&mode=slider&a=games101-strict&b=sysu-inclusive");
    browser.hover(3, 3);
    assert_eq!(browser.text("#about-pixel h4"), "Pixel 3, 3");
    let hits = browser.text("#pixel-hits");
    assert!(
        hits.starts_with("A games101-strict") && hits.contains(" 0 hits; B sysu-inclusive"),
        "{hits}"
    );
    assert!(hits.contains(" 2 hits; oracle 1 hit; a tie"), "{hits}");
    let span = browser.text("#pixel-span");
    assert!(span.contains("row 3") && span.contains("A none; B columns 0 to 5 (6 px)"), "{span}");
    // By hand: 256 subpixels a pixel, legs of five pixels, (3, 3) two pixels from the right leg
    // and three from the upper one.
    let edges = browser.text("#about-pixel .edges tbody");
    for value in [5 * 256 * 3 * 256, 5 * 256 * 2 * 256, 0] {
        assert!(edges.contains(&value.to_string()), "{value}: {edges}");
    }
    let rows = browser.eval(
        "[...document.querySelectorAll('#about-pixel .edges')].map(t => [...t.querySelectorAll('tbody tr')]
            .map(r => [r.children[2].textContent, r.children[3].textContent]))",
    );
    let upper = json!([
        ["inside", "top edge: keeps it"],
        ["inside", "right edge: leaves it"],
        ["exactly on this edge", "left edge: keeps it"]
    ]);
    assert_eq!(rows[0], upper);
    // The same sentences as in the playground: of both rules that are shown, and of the right one.
    let why =
        browser.eval("[...document.querySelectorAll('#about-pixel .say')].map(p => p.textContent)");
    let why: Vec<String> = serde_json::from_value(why).unwrap();
    let begin = [
        "The sample lies exactly on the edge that two triangles share: E = 0 for both. Strict",
        "The sample lies exactly on the edge that two triangles share: E = 0 for both. Inclusive",
        "The top-left rule: a sample on an edge",
    ];
    assert!(
        why.len() == 3 && why.iter().zip(begin).all(|(is, begin)| is.starts_with(begin)),
        "{why:?}"
    );
    // The keyboard moves on, and the live region follows.
    browser.eval("document.querySelector('rp-view .pixels').focus()");
    browser.press("ArrowRight");
    assert_eq!(browser.text("#about-pixel h4"), "Pixel 4, 3");
    browser.wait_for("document.querySelector('#announce').textContent.startsWith('pixel 4, 3: ')");
    browser.wait_for("location.hash.endsWith('px=4,3')");
    // A line: (5, 0) of L4 is halfway.
    browser.open(page, "#case-L4&px=5,0");
    let text = browser.text("#about-pixel");
    assert!(text.contains("1/2 px off the line in y, a tie"), "{text}");
    // Rows as a table, for who does not see the canvas.
    browser.eval("document.querySelector('#rows').open = true");
    browser.wait_for("document.querySelectorAll('#rows tbody tr').length === 3");
}

fn search_and_filters(browser: &mut Browser) {
    let all = browser.names_listed();
    assert!(all.iter().any(|n| n == "T2") && all.iter().any(|n| n.starts_with("sliver#")));
    let mut search = |text: &str| {
        browser.eval(&format!(
            "(() => {{ const s = document.querySelector('#search'); s.value = {text:?};
                s.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()"
        ));
        browser.names_listed()
    };
    assert_eq!(search("euc#17"), ["T5"]);
    assert!(search("bresenham octants").iter().all(|n| n.starts_with("line-octants#")));
    assert_eq!(search("nothing is called this"), Vec::<String>::new());
    assert_eq!(search(""), all);
    // Keys are letters while something is typed.
    browser.eval("document.querySelector('#search').focus()");
    browser.press("2");
    assert_ne!(browser.eval("document.querySelector('rp-view').dataset.mode"), json!("slider"));
    search_by_table(browser);
    browser.click("#filters [data-kind=named]");
    let named = browser.names_listed();
    assert!(named.len() > 30 && named.len() < all.len(), "{named:?}");
}

fn search_by_table(browser: &mut Browser) {
    browser.click(".find[data-search=sliver]");
    let found = browser.names_listed();
    assert!(found.iter().any(|name| name.starts_with("sliver#")), "{found:?}");
    browser.wait_for("document.querySelector('#case-title').textContent.includes('sliver#')");
    browser.eval(
        "(() => { const s = document.querySelector('#search'); s.value = '';
            s.dispatchEvent(new Event('input', { bubbles: true })); })()",
    );
}

/// No scrolling sideways of the page as a whole.
fn fits_the_width(browser: &mut Browser) {
    let root = "document.documentElement";
    // Plots are drawn anew for the width first.
    browser.wait_for(&format!("{root}.scrollWidth <= {root}.clientWidth"));
}

fn narrow_and_still(browser: &mut Browser, page: &Path) {
    for width in [1280, 400] {
        browser.resize(width, 800);
        for case in ["#case-O1&mode=side", "#case-S1", "#case-L7&mode=blink&px=5,5"] {
            browser.open(page, case);
            fits_the_width(browser);
        }
    }
    browser.resize(1280, 900);
    browser.prefer("prefers-reduced-motion", "reduce");
    browser.open(page, "#case-T2");
    assert_eq!(browser.eval("document.querySelector('rp-view').dataset.paused"), json!("true"));
    let light = browser.picture();
    browser.prefer("prefers-color-scheme", "dark");
    browser.open(page, "#case-T2&mode=blink");
    assert_ne!(browser.picture(), light, "a dark page has darker pixels");
}

#[test]
fn page_shows_a_planted_fault_first() {
    let words = "verify --cases 60 --plant inclusive-edges --report --json";
    let (status, printed, page) = run("page-planted", words);
    assert_eq!(status, 1);
    let Some(mut browser) = Browser::start("planted") else { return };
    browser.open(&page, "");
    let json: Value = serde_json::from_str(&printed).unwrap();
    let verdict = ["#verdict", "#counts"].map(|id| browser.text(id)).join(" ");
    // Thousands are apart, also in the tables.
    let wrong = format!("{} wrong pixels in ", thousands(json["mismatches"].as_u64().unwrap()));
    assert!(verdict.contains("DISAGREES") && verdict.contains(&wrong), "{verdict}");
    counts_equal_the_json(&mut browser, &json);
    // The worst row first after the sum, and the failing case is open.
    let marks = browser.eval(
        "[...document.querySelectorAll('table.counts tbody tr')].slice(0, 2).map(r => r.className)",
    );
    assert_eq!(marks, json!(["sum", "wrong"]));
    // Each family has a bar, the worst the longest, and all tables but the first are folded.
    let bars = browser.eval(
        "[...document.querySelectorAll('tr.wrong th')].map(head => parseFloat(getComputedStyle(head).getPropertyValue('--share')))",
    );
    let bars: Vec<f64> = serde_json::from_value(bars).unwrap();
    assert!(bars.len() > 5 && bars[0] == 100.0 && bars.is_sorted_by(|a, b| a >= b), "{bars:?}");
    let folded = browser.eval("[...document.querySelectorAll('table.counts')].map(table => table.closest('details')?.open ?? null)");
    let folded: Vec<Option<bool>> = serde_json::from_value(folded).unwrap();
    assert!(
        folded.len() > 1
            && folded[0].is_none()
            && folded[1..].iter().all(|open| *open == Some(false)),
        "{folded:?}"
    );
    let first = &json["failures"][0];
    let name = format!("{}#{}", first["family"].as_str().unwrap(), first["index"]);
    assert_eq!(browser.text("#case-title"), name);
    assert_eq!(browser.text("#case-command code"), first["repeat"].as_str().unwrap());
    let found = browser.text("#case-found");
    assert!(found.starts_with("inclusive-edges against oracle: "), "{found}");
    let pickers = browser.eval(
        "['a', 'b'].map(p => document.querySelector(`#pick-${p}`).selectedOptions[0].textContent)",
    );
    assert!(pickers[0].as_str().unwrap().starts_with("inclusive-edges ("), "{pickers}");
    assert_eq!(pickers[1], "oracle");
    assert!(!browser.text("#agreement").contains("agree in every pixel"));
    // What is drawn, what is expected and the difference stand side by side, each at the same scale.
    let panels = browser.eval(
        "document.querySelector('rp-view').shown.map(({ caption, canvas }) => [caption.textContent.trim(), canvas.clientWidth, canvas.clientHeight])",
    );
    let [drawn, expected, difference] = [0, 1, 2].map(|i| panels[i].clone());
    assert!(drawn[0].as_str().unwrap().contains("inclusive-edges"), "{panels}");
    assert!(expected[0].as_str().unwrap().contains("oracle"), "{panels}");
    assert_eq!(difference[0], "difference: A less B");
    assert!((1..=2).all(|side| drawn[side] == expected[side] && drawn[side] == difference[side]));
    first_screen_is_the_picture(&mut browser, &page);
    // Nobody calls a case with wrong pixels close to a bound.
    let wrong = browser.eval(
        "JSON.parse(document.querySelector('#data').textContent).cases
            .filter(c => c.kind === 'closest' && c.layers.some(l => l.role !== 'specimen'
                && l.tally.missing + l.tally.extra + l.tally.twice > 0)).map(c => c.name)",
    );
    assert_eq!(wrong, json!([]));
    // A wrong rasterizer does not fool the rule as the page computes it.
    assert_eq!(browser.eval("window.rasterproof.audit()"), json!([]));
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_of_the_specimens_shows_each_fault() {
    let (status, _, page) = run("page-specimens", "specimens --cases 5 --report");
    assert_eq!(status, 0);
    let Some(mut browser) = Browser::start("specimens") else { return };
    browser.open(&page, "");
    assert!(browser.text("#verdict").contains("CAUGHT"));
    let names = browser.names_listed();
    for name in &names {
        let fragment = format!("#case-{}", name.replace(' ', "%20"));
        browser.eval(&format!("location.hash = {fragment:?}"));
        browser.wait_for(&format!("document.body.dataset.ready === {name:?}"));
        let text = browser.text("#agreement");
        assert!(text.contains("differ in"), "{name}: {text}");
    }
    // A click on a specimen opens that one.
    for name in ["sysu-inclusive", "games101-strict", "book-painter"] {
        browser.click(&format!(".find[data-search={name}]"));
        browser
            .wait_for(&format!("document.querySelector('#case-title').textContent === {name:?}"));
    }
    chapters_exist(&mut browser);
    // Every card is there, as a case or as pictures.
    for card in rasterproof_faults::published::catalogue::CARDS {
        let is_shown = |name: &&String| name.split(' ').next() == Some(card.name);
        assert!(names.iter().any(|name| is_shown(&name)), "{} in {names:?}", card.name);
    }
}

/// Each place of the docs that a page leads to is there.
fn chapters_exist(browser: &mut Browser) {
    let paths = browser.eval(
        "(() => { const d = JSON.parse(document.querySelector('#data').textContent);
            return [...new Set([...d.cases, ...d.frames].map(c => c.chapter.path))]; })()",
    );
    let paths: Vec<String> = serde_json::from_value(paths).unwrap();
    assert!(paths.len() > 2, "{paths:?}");
    for path in &paths {
        let (file, anchor) = path.split_once('#').unwrap_or((path, ""));
        let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(file);
        let text = std::fs::read_to_string(&place).unwrap_or_else(|e| panic!("{path}: {e}"));
        let is_there = crate::workspace::anchors(&text).iter().any(|a| a == anchor);
        assert!(anchor.is_empty() || is_there, "{path}");
    }
}

/// Each command has a page of its own, and the index lists them; a folder that has another index
/// keeps it.
#[test]
fn page_of_each_command_is_in_the_index() {
    let (_, _, page) = run("page-index", "plan --scene panels --size 64x48 --rounds 1 --report");
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(text.contains("the material has no texture") && text.contains("second-buffer"));
    let target = page.parent().unwrap();
    let program = |words: &str| Run::of(shared().command(words).current_dir(target));
    program("render cube --size 64x48 --report --out .").says("report: ./render.html");
    let text = std::fs::read_to_string(target.join("render.html")).unwrap();
    assert!(text.contains("rasterproof render cube --size 64x48 --report --out ."));
    let index = std::fs::read_to_string(target.join("index.html")).unwrap();
    for part in ["href=\"plan.html\"", "href=\"render.html\"", "AGREES: scanline and edge-function"]
    {
        assert!(index.contains(part), "{part}: {index}");
    }
    let other = target.join("other");
    std::fs::create_dir_all(&other).unwrap();
    std::fs::write(other.join("index.html"), "mine").unwrap();
    program("render cube --size 64x48 --report --out other");
    assert_eq!(std::fs::read_to_string(other.join("index.html")).unwrap(), "mine");
    assert!(other.join("render.html").is_file() && other.join("cube.png").is_file());
    // Two reports of one kind have different titles.
    program("render cube --size 32x24 --report --out other");
    let title = |page: PathBuf| {
        let text = std::fs::read_to_string(page).unwrap();
        text.split_once("<title>").unwrap().1.split_once("</title>").unwrap().0.to_owned()
    };
    let titles = [target, &other].map(|folder| title(folder.join("render.html")));
    assert_ne!(titles[0], titles[1]);
}

/// A frame is shown as it is where it has room.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_shows_frames_as_they_are() {
    let (_, _, page) = run("page-frame", "render cube --report");
    let Some(mut browser) = Browser::start("frame") else { return };
    for (width, height) in [(1280, 720), (1280, 900)] {
        browser.resize(width, height);
        browser.open(&page, "");
        assert_eq!(browser.eval("document.querySelector('rp-view').dataset.cell"), json!("1"));
    }
}

/// What a name must not be able to do.
const HOSTILE: &str = "</script><img src=x onerror=\"document.title='broken into'\">&{{data}}'";

fn two_pictures() -> Vec<PictureLayer> {
    let old = RgbImage::from_pixel(7, 5, Rgb([10, 20, 30]));
    let mut new = old.clone();
    new.put_pixel(4, 2, Rgb([200, 20, 30]));
    vec![PictureLayer::new("scanline", &old), PictureLayer::new(HOSTILE, &new)]
}

pub fn every_section() -> Report {
    let hostile = || HOSTILE.to_owned();
    Report {
        title: hostile(),
        about: hostile(),
        outcome: Some(Outcome {
            good: true,
            word: hostile(),
            answer: hostile(),
            sentence: hostile(),
        }),
        answers: vec![Statement { about: HOSTILE, sentence: hostile(), command: hostile() }],
        command: hostile(),
        notes: vec![hostile()],
        tables: vec![Table {
            caption: hostile(),
            columns: vec![Column::words(HOSTILE), Column::numbers("n", HOSTILE)],
            rows: vec![Row {
                cells: vec![hostile(), hostile()],
                search: Some(hostile()),
                ..Row::default()
            }],
            notes: vec![hostile()],
            ..Table::default()
        }],
        frames: vec![PictureView {
            name: hostile(),
            about: hostile(),
            command: hostile(),
            layers: two_pictures(),
            ..PictureView::default()
        }],
        figures: vec![Figure {
            caption: hostile(),
            svg: "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='20'/>".to_owned(),
            others: vec![],
        }],
        diffs: vec![TextDiff {
            name: hostile(),
            about: hostile(),
            command: hostile(),
            old: Some("same\nold\n".to_owned()),
            new: format!("same\n{HOSTILE}\n"),
        }],
        ..Report::default()
    }
}

#[test]
fn page_has_thousands_apart_below_a_picture() {
    let about = "198 of 19200 pixels differ".to_owned();
    let frames = vec![PictureView { about, layers: two_pictures(), ..PictureView::default() }];
    let page = page(&Report { frames, ..Report::default() });
    assert!(page.contains("198 of 19,200 pixels differ"), "{page}");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_takes_every_section_and_any_text() {
    let path = folder("page-sections").join("index.html");
    std::fs::write(&path, page(&every_section())).unwrap();
    let Some(mut browser) = Browser::start("sections") else { return };
    browser.open(&path, "");
    for selector in [
        "h1",
        "#verdict strong",
        "#run .command code",
        ".counts tbody th",
        "#case-title",
        ".diff h3",
    ] {
        assert_eq!(browser.text(selector), HOSTILE, "{selector}");
    }
    let title = browser.eval("document.title");
    assert!(title.as_str().unwrap().starts_with(HOSTILE), "{title}");
    assert_eq!(browser.eval("document.querySelector('#plots img').naturalWidth"), json!(60));
    assert_eq!(browser.text(".diff .added pre"), HOSTILE);
    assert_eq!(browser.text(".diff .removed pre"), "old");
    browser.resize(400, 800);
    fits_the_width(&mut browser);
    browser.resize(1280, 900);
    // Pictures are in the same viewer, with a difference.
    assert_eq!(browser.text("#agreement"), "A and B differ in 1 pixel of 35.");
    browser.hover(4, 2);
    assert!(browser.text("#about-pixel").contains("A #0a141e, B #c8141e: different"));
    browser.press("3");
    assert_eq!(browser.eval("document.querySelectorAll('rp-view .pixels').length"), json!(3));
}

/// What marks pixels of another picture is not compared with it, and the page says what its colours mean. A plot fills the
/// window and leaves it again. On paper nothing blinks, and no tool is printed.
/// A plot is drawn for the width of its page: wide, usual, and for a phone.
#[test]
fn page_has_plots_of_its_width() {
    let drawn = [1200.0, 800.0, 400.0].map(|width| canvas::Drawing::new("a plot", [width, 90.0]));
    let report = Report { figures: vec![canvas::figure("a plot", drawn)], ..Report::default() };
    let path = folder("page-plots").join("index.html");
    std::fs::write(&path, page(&report)).unwrap();
    let Some(mut browser) = Browser::start("plots") else { return };
    browser.open(&path, "");
    for (width, drawn) in [(1280, 1200), (900, 800), (360, 400)] {
        browser.resize(width, 800);
        browser.wait_for(&format!("document.querySelector('.plot img').naturalWidth === {drawn}"));
        fits_the_width(&mut browser);
        let shown =
            browser.eval("document.querySelector('.plot img').clientWidth").as_f64().unwrap();
        assert!(shown > 0.8 * f64::from(width), "{shown} of {width} px");
    }
}

#[test]
fn page_tells_marks_from_pictures() {
    let [old, new] = [[10, 20, 30], [200, 20, 30]].map(|c| RgbImage::from_pixel(7, 5, Rgb(c)));
    let marks = [(Rgb([200, 20, 30]), "where it is wrong")];
    let layers = vec![PictureLayer::new("picture", &old), PictureLayer::map("marks", &new, &marks)];
    let frames = vec![PictureView { name: "one".to_owned(), layers, ..PictureView::default() }];
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='20'/>".to_owned();
    let figures = vec![Figure { caption: "a plot".to_owned(), svg, others: vec![] }];
    let path = folder("page-marks").join("index.html");
    std::fs::write(&path, page(&Report { frames, figures, ..Report::default() })).unwrap();
    let Some(mut browser) = Browser::start("marks") else { return };
    browser.open(&path, "#case-one&mode=side");
    let panels = "document.querySelector('rp-view').shown.length";
    assert_eq!(browser.eval(panels), json!(2), "no difference, which would be a red sheet");
    let legend = browser.eval(
        "[...document.querySelectorAll('.legend li')].map(li => [li.textContent, getComputedStyle(li.firstChild).backgroundColor])",
    );
    assert_eq!(legend, json!([["where it is wrong", "rgb(200, 20, 30)"]]));
    let wide =
        "document.querySelector('.plot img').getBoundingClientRect().width > 0.9 * innerWidth";
    assert_eq!(browser.eval(wide), json!(false));
    browser.click(".plot button");
    assert_eq!(browser.eval(wide), json!(true));
    browser.press("Escape");
    assert_eq!(browser.eval(wide), json!(false));
    browser.open(&path, "#case-one&mode=blink");
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    browser.eval("dispatchEvent(new Event('beforeprint'))");
    assert_eq!(browser.eval(panels), json!(2));
    let seen = "[...document.querySelectorAll('button, select')].filter(e => e.checkVisibility() && !e.querySelector('img')).length";
    assert_eq!(browser.eval(seen), json!(0));
}

#[test]
fn page_leaves_out_what_does_not_fit_and_says_so() {
    // Noise does not compress: 600 x 600 px are more than a megabyte.
    let mut state: u32 = 1;
    let noise = RgbImage::from_fn(600, 600, |_, _| {
        Rgb([0, 1, 2].map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        }))
    });
    let view = |name: &str| PictureView {
        name: name.to_owned(),
        layers: vec![PictureLayer::new("noise", &noise)],
        ..PictureView::default()
    };
    let frames = vec![
        view("first"),
        view("second"),
        PictureView { name: "small".to_owned(), layers: two_pictures(), ..PictureView::default() },
    ];
    let text = page(&Report { frames, ..Report::default() });
    assert!(text.len() < PAGE_BYTES, "{} bytes", text.len());
    assert!(text.contains("bytes: second (") && !text.contains("\"name\":\"second\""));
    assert!(text.contains("\"name\":\"first\"") && text.contains("\"name\":\"small\""));
}

/// A folder whose `snapshots` hold one picture of the project with one pixel changed.
fn spoilt_snapshots(name: &str) -> PathBuf {
    let folder = folder(name);
    let (from, to) =
        (Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots"), folder.join("snapshots"));
    std::fs::create_dir_all(&to).unwrap();
    std::fs::copy(from.join("verdict.snap"), to.join("verdict.snap")).unwrap();
    let mut image = image::open(from.join("verdict.snap.png")).unwrap().to_rgb8();
    image.put_pixel(20, 30, Rgb([214, 60, 60]));
    std::fs::write(to.join("verdict.snap.png"), picture::png(&image)).unwrap();
    folder
}

/// Runs the test of that picture on the spoilt snapshots; whether it passes, and what it says.
fn run_its_test(folder: &Path, update: &str) -> (bool, String) {
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "snapshots::picture_of_a_verdict"])
        .env(ELSEWHERE, folder.join("snapshots"))
        .env("INSTA_UPDATE", update)
        .env_remove("INSTA_FORCE_PASS")
        .env_remove("INSTA_PENDING_DIR")
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}

fn review(folder: &Path) -> (i32, String) {
    let run = Run::of(shared().command("review").current_dir(folder));
    (run.status.unwrap(), run.out + &run.errors)
}

/// From a changed picture to the page that shows it, and to its acceptance.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_reviews_a_changed_snapshot() {
    let folder = spoilt_snapshots("page-review");
    assert_eq!(review(&folder).0, 0);
    let (passes, said) = run_its_test(&folder, "new");
    assert!(!passes && said.contains("cargo run -- review"), "{said}");
    let (status, said) = review(&folder);
    assert_eq!(status, 1, "{said}");
    for line in [
        "snapshots/verdict.snap: 1 of 559989 pixels of the picture changed, from 20,30 to 20,30\n",
        "  accept: cargo insta accept --snapshot snapshots/verdict.snap",
        "INSTA_UPDATE=always cargo test --test it snapshots::",
        "1 changed snapshot waits for review in snapshots.",
    ] {
        assert!(said.contains(line), "{line}: {said}");
    }
    if let Some(mut browser) = Browser::start("review") {
        browser.open(&folder.join("target/rasterproof/review.html"), "");
        assert!(browser.text("#verdict").contains("PENDING"));
        assert_eq!(browser.text("#case-title"), "snapshots/verdict.snap");
        assert_eq!(
            browser.text("#case-about"),
            "1 of 559989 pixels of the picture changed, from 20,30 to 20,30"
        );
        browser.press("3");
        assert_eq!(browser.eval("document.querySelectorAll('rp-view .pixels').length"), json!(3));
    }
    // The test writes its picture as accepted, and nothing waits any more.
    let (passes, said) = run_its_test(&folder, "always");
    assert!(passes, "{said}");
    let (status, said) = review(&folder);
    assert_eq!(status, 0, "{said}");
}
