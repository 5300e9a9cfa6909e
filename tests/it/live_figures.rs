//! The live figures of the pages: they stand there with their pictures and words, and what a browser shows for
//! any position of their grips is what the oracle draws here.
//!
//! In the browser the scanline engine and the DDA draw; here the oracle does, so that a fault of either side
//! shows. Needs what `playground.rs` needs.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use rasterproof_playground as pages;
use rasterproof_wasm::figures::{ALL, Figure, Grip, Language, find};
use rasterproof_wasm::question::answer;
use serde_json::{Value, json};

use crate::browser::{Browser, Tab as _, folder};
use crate::pages::{Renewal, read, root};
use crate::playground::module;

/// What a figure is for these positions of its grips, drawn by the oracle.
fn expected(figure: &Figure, language: &str, at: &Value, is_answered: bool) -> Value {
    let question = json!({ "ask": "figure", "name": figure.name, "language": language, "at": at,
        "is_answered": is_answered, "by": "oracle" });
    let answer: Value = serde_json::from_str(&answer(&question.to_string())).unwrap();
    assert!(answer["error"].is_null(), "{}: {}", figure.name, answer["error"]);
    answer
}

/// `RASTERPROOF_RENEW=1 cargo test --test it live_figures_stand` draws the still pictures and writes what stands
/// between `<rp-figure scene="...">` and `</rp-figure>` anew.
#[test]
fn live_figures_stand_on_their_pages() {
    let mut renewal = Renewal::default();
    for figure in ALL.iter() {
        let svg = figure.still().unwrap();
        assert!(svg.len() < 16_000, "{}: a picture of {} bytes", figure.name, svg.len());
        renewal.is(format!("docs/figures/live/{}.svg", figure.name), &svg);
        for (folder, language) in [("docs", Language::En), ("docs/zh", Language::Zh)] {
            let path = format!("{folder}/{}.md", figure.page);
            let page = read(&path);
            let begin = format!("<rp-figure scene=\"{}\">", figure.name);
            let parts: Vec<_> = page.split(&begin).collect();
            assert_eq!(parts.len(), 2, "{begin} belongs on {path} once");
            let (_, after) = parts[1].split_once("</rp-figure>").expect("a figure ends");
            let block = figure.block(language).unwrap();
            renewal.is(&path, &[parts[0], &block, after].concat());
        }
    }
    // The first page shows one of them again, with its answer.
    for (folder, language) in [("docs", Language::En), ("docs/zh", Language::Zh)] {
        let first = find("shared-edge").unwrap().block(language).unwrap();
        let open = first.replacen("\">", "\" open>", 1);
        assert!(
            read(format!("{folder}/index.md")).contains(&open),
            "{folder}/index.md has no {open}"
        );
    }
    // No picture is left over, and every chapter has two figures.
    let pictures = fs::read_dir(root().join("docs/figures/live")).unwrap().count();
    assert_eq!(pictures, ALL.len());
    renewal.check("live_figures_stand");
}

/// At every end of every grip: words with all numbers in them, a prediction that can be right, a picture.
#[test]
fn live_figures_are_whole() {
    for figure in ALL.iter() {
        let starts: Vec<_> = figure.grips().iter().map(|grip| grip.start).collect();
        let mut places = vec![starts.clone()];
        for (i, grip) in figure.grips().iter().enumerate() {
            for end in [grip.low, grip.high] {
                let mut at = starts.clone();
                at[i] = end;
                places.push(at);
            }
        }
        let mut predictions = BTreeSet::new();
        for (at, language) in places.iter().flat_map(|at| [(at, "en"), (at, "zh")]) {
            let drawn = expected(figure, language, &json!(at), true);
            let text = drawn.to_string();
            let told = |key: &str| drawn[key].as_str().unwrap().to_owned();
            for key in ["title", "question", "answer", "alt"] {
                let words = told(key);
                assert!(
                    !words.contains(['{', '}']) && !words.is_empty(),
                    "{}: {words}",
                    figure.name
                );
            }
            assert!(!text.contains("NaN") && !text.contains("inf\""), "{}: {text}", figure.name);
            assert_eq!(drawn["at"], json!(at), "{}", figure.name);
            assert_eq!(drawn["grips"].as_array().unwrap().len(), starts.len(), "{}", figure.name);
            assert!(told("link").starts_with("#scene="), "{}", figure.name);
            let predict = &drawn["predict"];
            match predict["kind"].as_str().unwrap() {
                "pixels" => {
                    let cells = predict["cells"].as_array().unwrap().len();
                    assert_eq!(cells, predict["right"].as_array().unwrap().len());
                    assert!((2..=64).contains(&cells), "{}: {cells} pixels", figure.name);
                }
                "choice" => {
                    let right = predict["right"].as_u64().unwrap() as usize;
                    assert!(
                        right < predict["options"].as_array().unwrap().len(),
                        "{}",
                        figure.name
                    );
                }
                _ => assert!(predict["right"].as_str().unwrap().parse::<f64>().is_ok()),
            }
            predictions.insert(predict["right"].to_string());
            // Before the answer nothing of it is drawn.
            let asked = expected(figure, language, &json!(at), false);
            assert!(!asked["svg"].as_str().unwrap().contains("class=\"px"), "{}", figure.name);
            assert_eq!(asked["predict"], *predict, "{}", figure.name);
        }
        // The corner that becomes red is the same one wherever the corners lie: that is the fault.
        let changes = predictions.len() > 1 || figure.name == "wrong-corner";
        assert!(changes, "{}: what is right never changes", figure.name);
    }
}

/// A page with all figures, beside the script and the engines; nothing where the engines are not compiled.
fn page_of_all(name: &str, language: &str) -> Option<PathBuf> {
    let module = module()?;
    let folder = folder(&format!("figures-{name}"));
    fs::write(folder.join("figure.js"), pages::figure_script()).unwrap();
    fs::copy(root().join("target/rasterproof/engines.js"), folder.join("engines.js")).unwrap();
    // Where the links of the figures lead.
    let playground = pages::page(&pages::PLAYGROUND, &fs::read(module).unwrap()).unwrap();
    fs::write(folder.join("playground.html"), playground).unwrap();
    let still = |figure: &Figure| {
        let block = figure.block(if language == "zh" { Language::Zh } else { Language::En });
        // As Markdown becomes HTML, but for the picture.
        let open = block.unwrap().replacen("\n\n**", "\n\n<p><strong>", 1);
        let figured = open.replacen("**", "</strong>", 1).replacen("\n\n</rp", "</p></rp", 1);
        let numbers = figure.numbers().unwrap().into_iter();
        let numbers = numbers.map(|(of, _)| format!("<!--n {}.{of}-->?<!--/n--> ", figure.name));
        format!("{figured}<p>In the prose: {}</p>", numbers.collect::<String>())
    };
    let figures: Vec<_> = ALL.iter().map(still).collect();
    let page = format!(
        "<!doctype html><html lang={language}><meta charset=utf-8><title>figures</title>\
         <meta name=viewport content='width=device-width'>\
         <style>body {{ background: #fff; color: #000; font: 16px/1.5 sans-serif; margin: 8px }}</style>\
         <body data-ready><p style='height: 3000px'>above</p>{}<script src=figure.js></script>\
         <script>const arrows = []; // those that reach the page, where a book turns its pages by them
         addEventListener('keydown', (event) => {{ if (event.key.startsWith('Arrow')) arrows.push(event.key); }});</script>",
        figures.join("\n")
    );
    let path = folder.join("index.html");
    fs::write(&path, page).unwrap();
    Some(path)
}

fn of(figure: &Figure) -> String {
    format!("document.querySelector('rp-figure[scene=\"{}\"]')", figure.name)
}

/// Scrolls to a figure and waits until it asks. Taking a picture of the page moves it, so it scrolls again.
fn visit(browser: &mut Browser, figure: &Figure) {
    let of = of(figure);
    browser.wait_for(&format!(
        "({of}.scrollIntoView({{ block: 'center', behavior: 'instant' }}),
            {of}.shadowRoot.querySelector('.controls').childElementCount > 0)"
    ));
}

/// Where an element of a figure lies in the tab, at its middle.
fn spot(browser: &mut Browser, figure: &Figure, selector: &str, i: usize) -> [f64; 2] {
    let spot = browser.eval(&format!(
        "(() => {{ const e = {}.shadowRoot.querySelectorAll('{selector}')[{i}];
            e.scrollIntoView({{ block: 'center', behavior: 'instant' }});
            const b = e.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; }})()",
        of(figure)
    ));
    serde_json::from_value(spot).unwrap()
}

/// The pixels of a picture with the colours that the browser gives them: the corner of each on the sheet, its side,
/// red, green, blue. A path holds runs of pixels.
const PIXELS: &str = include_str!("../data/pages/pixels.js");

/// What is wrong with a figure as it stands in the browser, beside the oracle for the state that it says.
fn wrong(browser: &mut Browser, figure: &Figure) -> Vec<String> {
    let of = of(figure);
    let shown = browser.eval(&format!("({{ at: JSON.parse({of}.dataset.at), svg: {of}.now.svg, answer: {of}.now.answer, link: {of}.link.href.split('/').pop(),
        numbers: Object.fromEntries({of}.numbers.map(({{ shown, value }}) => [value, shown.textContent])) }})"));
    let right = expected(figure, "en", &shown["at"], true);
    let mut wrong = Vec::new();
    let numbers: serde_json::Map<_, _> = figure
        .numbers()
        .unwrap()
        .into_iter()
        .map(|(name, _)| (name.clone(), right["values"][&name].clone()))
        .collect();
    for (what, is, should) in [
        ("the numbers in the prose", &shown["numbers"], &json!(numbers)),
        ("the picture", &shown["svg"], &right["svg"]),
        ("the words", &shown["answer"], &right["answer"]),
        (
            "the link",
            &shown["link"],
            &json!(format!("playground.html{}", right["link"].as_str().unwrap())),
        ),
    ] {
        if is != should {
            wrong.push(format!("{}: {what} at {}", figure.name, shown["at"]));
        }
    }
    // What is on the screen: each pixel has its colour somewhere in its corners, which lines and letters leave free.
    let pixels: Vec<[f64; 6]> = serde_json::from_value(browser.eval(&format!(
        "(() => {{ const host = document.body.appendChild(document.createElement('div'));
            const root = host.attachShadow({{ mode: 'open' }}); root.innerHTML = {};
            const pixels = {PIXELS}(root); host.remove(); return pixels; }})()",
        right["svg"]
    )))
    .unwrap();
    let stage = browser.eval(&format!(
        "(() => {{ const e = {of}.view.shown[0].frame.querySelector('svg'); e.scrollIntoView({{ block: 'center', behavior: 'instant' }});
            const b = e.getBoundingClientRect(); return [b.left + scrollX, b.top + scrollY, b.width, b.height]; }})()"
    ));
    let [x, y, width, height]: [f64; 4] = serde_json::from_value(stage).unwrap();
    let clip = json!({ "x": x, "y": y, "width": width, "height": height, "scale": 1 });
    let shot = browser.call("Page.captureScreenshot", json!({ "clip": clip }));
    let png = STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
    let image = image::load_from_memory(&png).unwrap().to_rgb8();
    let zoom = width / 360.0;
    // What is dragged lies on the picture, and may hide the pixel under it.
    let spots: Vec<[f64; 2]> = right["grips"]
        .as_array()
        .unwrap()
        .iter()
        .map(|grip| serde_json::from_value(grip["spot"].clone()).unwrap())
        .collect();
    let is_hidden = |[left, top, side, ..]: &[f64; 6]| {
        let middle = [left + side / 2.0, top + side / 2.0];
        spots.iter().any(|[x, y]| (x - middle[0]).hypot(y - middle[1]) < 12.0)
    };
    let is_there = |[left, top, side, r, g, b]: &[f64; 6]| {
        [[0.2, 0.2], [0.8, 0.2], [0.2, 0.8], [0.8, 0.8], [0.5, 0.2]].iter().any(|[right, down]| {
            let at = [(left + right * side) * zoom, (top + down * side) * zoom].map(|v| v as u32);
            image
                .get_pixel_checked(at[0], at[1])
                .is_some_and(|p| p.0.map(f64::from) == [*r, *g, *b])
        })
    };
    // Of what is drawn twice at one place, the last is seen.
    let last: BTreeMap<_, _> =
        pixels.iter().map(|pixel| ([pixel[0], pixel[1]].map(f64::to_bits), pixel)).collect();
    let lost = last.values().filter(|pixel| !is_there(pixel) && !is_hidden(pixel)).count();
    if lost > 0 {
        wrong.push(format!("{}: {lost} of {} pixels on the screen", figure.name, pixels.len()));
    }
    wrong
}

/// Goes where the address leads, as a click on the link does, and says what the panels show there.
const FOLLOW: &str = include_str!("../data/pages/follow.js");

/// The panels of the playground that show what a figure shows; none where it shows the figure itself.
fn panels_of(name: &str) -> &'static [usize] {
    match name {
        "one-sample" | "line-pixels" | "there-and-back" | "edge-owner" | "row-span" | "boards"
        | "z-fighting" | "near-corners" | "winding" | "order-matters" | "turn-about" => &[0],
        "shared-edge" | "middle-row" => &[1],
        "wrong-corner" | "affine-kink" | "nearer" => &[0, 1],
        _ => &[],
    }
}

/// Pixels with what they are painted, counted from the first column and row that have any.
type Painted = BTreeMap<[i64; 2], String>;

fn from_the_first(pixels: &[([f64; 2], String)], unit: f64) -> Painted {
    let least = |axis: usize| pixels.iter().map(|(at, _)| at[axis]).fold(f64::INFINITY, f64::min);
    let first = [least(0), least(1)];
    let place = |at: &[f64; 2]| [0, 1].map(|axis| ((at[axis] - first[axis]) / unit).round() as i64);
    pixels.iter().map(|(at, paint)| (place(at), paint.clone())).collect()
}

fn painted_by(figure: &str, svg: &str) -> Vec<Painted> {
    let (mut pixels, mut unit) = (Vec::new(), f64::INFINITY);
    for path in svg.split("<path class=\"px").skip(1) {
        let path = path.split("/>").next().unwrap();
        let (paint, runs) = path.split_once(" d=\"").unwrap();
        let paint = paint.trim_matches([' ', '"']).trim_start_matches("fill=\"");
        for run in runs.split('M').skip(1) {
            let numbers: Vec<f64> =
                run.split([' ', 'h', 'v', 'z']).filter_map(|n| n.parse().ok()).collect();
            let [x, y, width, side] = numbers[..4] else { unreachable!() };
            unit = side.min(unit);
            let count = (width / side).round() as usize;
            pixels.extend((0..count).map(|i| ([x + i as f64 * side, y], paint.to_owned())));
        }
    }
    let is_second = |[x, y]: [f64; 2]| match figure {
        "nearer" => y > 225.0,
        "wrong-corner" | "affine-kink" => x > 180.0,
        _ => false,
    };
    // Of two surfaces, the one that was drawn last; the painter, who is the second part, shows it alone.
    let last = pixels.iter().find(|(at, _)| is_second(*at)).map(|(_, paint)| paint.clone());
    let last = last.unwrap_or_else(|| "one".to_owned());
    for (_, paint) in &mut pixels {
        match figure {
            "there-and-back" | "edge-owner" | "boards" => "on".clone_into(paint),
            "nearer" | "z-fighting" => {
                *paint = if *paint == last { "last" } else { "first" }.into()
            }
            _ => {}
        }
    }
    [false, true][..panels_of(figure).len()]
        .iter()
        .map(|part| {
            let own = pixels.iter().filter(|(at, _)| is_second(*at) == *part).cloned();
            from_the_first(&own.collect::<Vec<_>>(), unit)
        })
        .collect()
}

/// What the playground paints a pixel with, in the words of the figure; nothing where the figure leaves it out.
fn as_in_the_figure(figure: &str, [_, y]: [f64; 2], paint: &str) -> Option<String> {
    Some(match (figure, paint) {
        ("row-span", _) if y != 2.0 => return None,
        ("there-and-back", "missing") => return None,
        ("there-and-back", _) => "on".into(),
        ("affine-kink", paint) => if paint == "agrees" { "dark" } else { "pale" }.into(),
        ("nearer" | "z-fighting", paint) => {
            if ["a", "b"].contains(&paint) { "first" } else { "last" }.into()
        }
        (_, "agrees") => "on".into(),
        (_, "missing") => "miss".into(),
        (_, paint) => match paint.strip_prefix("rgb(") {
            Some(rgb) => {
                let hex = |part: &str| format!("{:02x}", part.parse::<u8>().unwrap());
                format!("#{}", rgb.trim_end_matches(')').split(' ').map(hex).collect::<String>())
            }
            None => paint.into(),
        },
    })
}

/// Whether the playground shows what the figure shows.
fn is_same(figure: &str, right: &Value, seen: &Value) -> bool {
    if figure == "weights" {
        let words = right["answer"].as_str().unwrap();
        let weights: Vec<f64> = serde_json::from_value(seen["weights"].clone()).unwrap();
        let has = |weight: &f64| {
            let text = format!("{:.2}", weight * 100.0);
            let text = text.trim_end_matches('0').trim_end_matches('.');
            words.contains(&format!(" {text}%"))
        };
        return weights.len() == 3 && weights.iter().all(has);
    }
    let panels = panels_of(figure);
    if panels.is_empty() {
        let own = [&right["svg"]; 2];
        return seen["svg"].as_array().unwrap().iter().eq(own);
    }
    let painted = panels.iter().map(|&panel| {
        let pixels: Vec<(f64, f64, String)> =
            serde_json::from_value(seen["panels"][panel].clone()).unwrap();
        let pixels: Vec<_> = pixels
            .iter()
            .filter_map(|(x, y, paint)| {
                Some(([*x, *y], as_in_the_figure(figure, [*x, *y], paint)?))
            })
            .collect();
        from_the_first(&pixels, 1.0)
    });
    painted.eq(painted_by(figure, right["svg"].as_str().unwrap()))
}

/// The link of each figure in some states leads to the playground in the same state, and to no other.
fn links_lead_to_the_same(browser: &mut Browser, links: &[(&'static Figure, Value, String)]) {
    browser.call("Page.navigate", json!({ "url": links[0].2 }));
    browser.wait_for("document.body?.dataset.ready !== undefined");
    let mut told_apart = BTreeSet::new();
    for (figure, at, link) in links {
        let (page, state) = link.split_once('#').unwrap();
        assert_eq!(page, links[0].2.split('#').next().unwrap());
        let seen = browser.eval(&format!("(to => {FOLLOW})({:?})", format!("#{state}")));
        assert_eq!(seen["trouble"], "", "{link}");
        assert!(is_same(&figure.name, &expected(figure, "en", at, true), &seen), "{link}: {seen}");
        let others = links.iter().filter(|(other, ..)| other.name == figure.name);
        for (_, other, _) in others {
            if !is_same(&figure.name, &expected(figure, "en", other, true), &seen) {
                told_apart.insert(figure.name.clone());
            }
        }
        if panels_of(&figure.name).is_empty() && figure.name != "weights" {
            // The picture is on both panels, each as large as its place.
            let there = browser.eval(&format!(
                "(() => {{ drawFrame();
                    return view.shown.map(({{ frame }}, i) => {{
                        const host = document.body.appendChild(document.createElement('div'));
                        host.innerHTML = last.answer.panels[i].svg;
                        const [is, should] = [frame, host].map(e => JSON.stringify({PIXELS}(e)));
                        host.remove();
                        return is === should && frame.querySelector('svg').childElementCount > 1 && frame.querySelector('svg').clientWidth === frame.clientWidth;
                    }}); }})()"
            ));
            assert_eq!(there, json!([true, true]), "{link}");
        }
    }
    let all: BTreeSet<_> = ALL.iter().map(|figure| figure.name.clone()).collect();
    assert_eq!(told_apart, all, "the playground in another state");
    // There a figure has its grips, which keys move, and its second picture is drawn by whoever is chosen.
    let go = |browser: &mut Browser, address: &str| {
        browser.eval(&format!("(clearTimeout(keeping), location.hash = '{address}&lang=en', 0)"));
    };
    go(browser, "#scene=figure&figure=edge-sign");
    // The panels are drawn in the frame after the state is taken.
    browser.wait_for("state.at === '[[1.5,5.5],[7.5,1.5]]' && view.shown[0]?.grips.length === 2");
    browser.eval("view.shown[0].grips[1].focus()");
    browser.press("ArrowLeft");
    browser.wait_for("state.at === '[[1.5,5.5],[7,1.5]]'");
    let says = "document.querySelectorAll('figcaption output')[1]?.textContent";
    browser.wait_for(&format!("{says} === 'the same picture'"));
    go(browser, "#scene=figure&at=[[3.5,3.5]]&by=scanline,inclusive-edges");
    browser.wait_for(&format!("{says} === 'another picture'"));
}

/// Every figure waits for a prediction, and then shows what the oracle draws in three states: where it is dragged
/// by the mouse, and where keys move it. A planted engine and a state that is not the one it says are noticed.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn live_figures_show_what_the_oracle_draws() {
    let Some(page) = page_of_all("oracle", "en") else { return };
    let Some(mut browser) = Browser::start("figures") else { return };
    browser.prefer("prefers-color-scheme", "light");
    browser.open(&page, "");
    // The engines are loaded once, a screen before a figure comes into view.
    let loaded = "document.querySelectorAll('script[src$=\"engines.js\"]').length";
    assert_eq!(browser.eval(loaded), 0);
    // What the page sends to the engines can be changed on the way, to plant faults.
    browser.eval(
        "{ const encode = TextEncoder.prototype.encode;
            TextEncoder.prototype.encode = function (text) {
                const question = JSON.parse(text);
                window.plant?.(question);
                return encode.call(this, JSON.stringify(question));
            }; }",
    );
    let plants = [
        "q => { q.by = 'drops-first-row' }",
        "q => { q.by = 'line-directed-ties' }",
        // As far as the grip goes, one way and the other.
        "q => { q.at[0] = q.at[0].map(v => v + 9) }",
        "q => { q.at[0] = q.at[0].map(v => v - 9) }",
    ];
    let mut noticed = vec![BTreeSet::new(); plants.len()];
    let mut links = Vec::new();
    for figure in ALL.iter() {
        visit(&mut browser, figure);
        let of = of(figure);
        assert_eq!(
            browser.eval(&format!("{PIXELS}({of}.view.shown[0].frame)")),
            json!([]),
            "{}",
            figure.name
        );
        assert_eq!(
            browser.eval(&format!("{of}.shadowRoot.querySelectorAll('[role=slider]').length")),
            0
        );
        browser
            .eval(&format!("{of}.shadowRoot.querySelector('.controls button:last-child').click()"));
        assert_eq!(wrong(&mut browser, figure), [""; 0]);
        let stands = |browser: &mut Browser| browser.eval(&format!("JSON.parse({of}.dataset.at)"));
        let link = |browser: &mut Browser| {
            browser.eval(&format!("{of}.link.href")).as_str().unwrap().to_owned()
        };
        links.push((figure, stands(&mut browser), link(&mut browser)));
        let mut states = BTreeSet::from([browser.eval(&format!("{of}.dataset.at")).to_string()]);
        let last = figure.grips().len() - 1;
        for (i, by) in [(0, [37.0, 29.0]), (last, [-61.0, -45.0])] {
            let [x, y] = spot(&mut browser, figure, "[role=slider]", i);
            let to = [x + by[0], y + by[1]];
            for (kind, at) in [("mousePressed", [x, y]), ("mouseMoved", to), ("mouseReleased", to)]
            {
                browser.mouse(kind, at);
            }
            assert_eq!(wrong(&mut browser, figure), [""; 0]);
            states.insert(browser.eval(&format!("{of}.dataset.at")).to_string());
        }
        links.push((figure, stands(&mut browser), link(&mut browser)));
        browser.eval(&format!("{of}.shadowRoot.querySelector('[role=slider]').focus()"));
        for keys in [&["ArrowLeft"; 3][..], &["ArrowRight"]] {
            for key in keys {
                browser.press(key);
            }
            assert_eq!(wrong(&mut browser, figure), [""; 0]);
            states.insert(browser.eval(&format!("{of}.dataset.at")).to_string());
        }
        assert!(states.len() >= 3, "{}: {states:?}", figure.name);
        let now = stands(&mut browser);
        let ends = |end: fn(&Grip) -> [f64; 2]| figure.grips().iter().map(end).collect::<Vec<_>>();
        for at in [json!(ends(|grip| grip.low)), json!(ends(|grip| grip.high)), now] {
            browser.eval(&format!("({of}.at = {at}, {of}.draw())"));
            links.push((figure, stands(&mut browser), link(&mut browser)));
        }
        for (plant, noticed) in plants.iter().zip(&mut noticed) {
            let before = browser.eval(&format!("{of}.dataset.at"));
            browser.eval(&format!("(window.plant = {plant}, {of}.draw(), {of}.dataset.at = {before}, window.plant = null)"));
            if !wrong(&mut browser, figure).is_empty() {
                noticed.insert(figure.name.clone());
            }
            browser.eval(&format!("({of}.at = JSON.parse({before}), {of}.draw())"));
        }
    }
    assert_eq!(browser.eval(loaded), 1);
    let all: BTreeSet<_> = ALL.iter().map(|figure| figure.name.clone()).collect();
    eprintln!(
        "figures: {}; a planted triangle engine is noticed by {}, a planted line drawer by {}",
        all.len(),
        noticed[0].len(),
        noticed[1].len()
    );
    assert!(noticed[0].len() >= 10 && !noticed[1].is_empty(), "{noticed:?}");
    let elsewhere: BTreeSet<_> = noticed[2].union(&noticed[3]).cloned().collect();
    assert_eq!(elsewhere, all, "another state than it says");
    controls_are_named(&mut browser);
    keys_predict(&mut browser);
    assert_eq!(browser.eval("arrows"), json!([]), "arrow keys that a figure took");
    fingers_drag(&mut browser);
    links_lead_to_the_same(&mut browser, &links);
}

/// Whatever takes the focus has a role and a name, and a grip has a value.
fn controls_are_named(browser: &mut Browser) {
    let tree = browser.call("Accessibility.getFullAXTree", json!({}));
    let text = |node: &Value, key: &str| node[key]["value"].as_str().unwrap_or("").to_owned();
    let is_focusable = |node: &&Value| {
        let all = node["properties"].as_array();
        node["ignored"] == false
            && all.is_some_and(|all| {
                all.iter().any(|p| p["name"] == "focusable" && p["value"]["value"] == true)
            })
    };
    let mut roles = BTreeSet::new();
    for node in tree["nodes"].as_array().unwrap().iter().filter(is_focusable) {
        let (role, name) = (text(node, "role"), text(node, "name"));
        assert!(role == "RootWebArea" || !name.trim().is_empty(), "a nameless {role}: {node}");
        let value = &node["value"]["value"];
        assert!(role != "slider" || !value.is_null(), "{name} has no value: {node}");
        roles.insert(role);
    }
    for role in ["button", "slider", "link"] {
        assert!(roles.contains(role), "{role} in {roles:?}");
    }
}

/// A prediction by keys alone: pixels are marked by arrows and the space bar, and judged.
fn keys_predict(browser: &mut Browser) {
    let figure = find("one-sample").unwrap();
    let of = of(figure);
    browser.eval(&format!(
        "(() => {{ const fresh = document.createElement('rp-figure');
            fresh.setAttribute('scene', 'one-sample'); {of}.replaceWith(fresh); }})()"
    ));
    visit(browser, figure);
    browser.eval(&format!("{of}.stage.querySelector('.frame button').focus()"));
    // From (0, 0) to (1, 1) and around the square of four pixels.
    for arrow in [&["ArrowRight", "ArrowDown"][..], &["ArrowRight"], &["ArrowDown"], &["ArrowLeft"]]
    {
        arrow.iter().for_each(|key| browser.press(key));
        browser.press(" ");
    }
    let marked = format!("{of}.stage.querySelectorAll('.frame [aria-pressed=true]').length");
    assert_eq!(browser.eval(&marked), 4);
    browser.eval(&format!("{of}.controls.firstChild.click()"));
    assert_eq!(browser.eval(&format!("{of}.verdict.textContent")), "Right.");
}

/// A grip follows a finger.
fn fingers_drag(browser: &mut Browser) {
    browser.has_fingers(1);
    let figure = find("shared-edge").unwrap();
    let at = format!("{}.dataset.at", of(figure));
    let before = browser.eval(&at);
    let [x, y] = spot(browser, figure, "[role=slider]", 0);
    browser.touch("touchStart", &[[x, y]]);
    browser.touch("touchMove", &[[x - 20.0, y - 30.0]]);
    browser.touch("touchMove", &[[x - 40.0, y - 60.0]]);
    browser.touch("touchEnd", &[]);
    assert_ne!(browser.eval(&at), before);
    assert_eq!(wrong(browser, figure), [""; 0]);
}

/// In Chinese too, and dark: every figure asks in its language, and no wider than a telephone.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn live_figures_ask_in_chinese() {
    let Some(page) = page_of_all("chinese", "zh") else { return };
    let Some(mut browser) = Browser::start("figures-zh") else { return };
    browser.prefer("prefers-color-scheme", "dark");
    browser.open(&page, "");
    browser.resize(360, 740);
    for figure in ALL.iter() {
        visit(&mut browser, figure);
        let of = of(figure);
        let asks = expected(figure, "zh", &json!([]), false)["question"].clone();
        assert_eq!(browser.eval(&format!("{of}.question.textContent")), asks);
        browser.eval(&format!("{of}.controls.lastChild.click()"));
        let wide = browser.eval("document.documentElement.scrollWidth").as_u64().unwrap();
        assert!(wide <= 360, "{}: {wide} px wide", figure.name);
        // It fills the window, and what brings it back is there to be pressed.
        let tool = format!("{of}.shadowRoot.querySelector('[data-tool=enlarge]')");
        let shown = format!(
            "[{of}.view.clientHeight, (({{ top, bottom }}) => top >= 0 && bottom <= innerHeight)({tool}.getBoundingClientRect())]"
        );
        browser.eval(&format!("{tool}.click()"));
        assert_eq!(browser.eval(&shown), json!([740, true]), "{}", figure.name);
        browser.eval(&format!("{tool}.click()"));
    }
}
