//! Every page of the site, and every other page that the program writes, follows the rules of axe-core: what the keyboard
//! reaches, what a screen reader is given, and how far colours differ from what is behind them. A program cannot judge
//! more of accessibility than that.
//!
//! axe-core is one of the packages of the site, so these tests need `docs/build`, as those of `site.rs` do.

use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use rasterproof_report::html;
use serde_json::json;

use crate::browser::{Browser, Tab as _, folder};
use crate::page::every_section;
use crate::pages::{read, root};
use crate::playground::{SCENES, settle};
use crate::program::{Folder, PROGRAM};
use crate::site::{go, names, site};
use crate::your_gpu::SWIFTSHADER;

/// Applies every rule that axe-core applies by default, and returns a line for each element that breaks one.
///
/// Judging the contrast of a text takes long, and a page may show thousands of coloured words of code. Words of the same class
/// look the same, so one of each class in a code block is judged, and the others lose their colour.
const VIOLATIONS: &str = include_str!("../data/pages/violations.js");

/// A browser that has axe-core on every page, or nothing where there is no browser.
fn browser(name: &str, options: &[&str]) -> Option<Browser> {
    let path = root().join("target/site-tools/node_modules/axe-core/axe.min.js");
    let axe = fs::read_to_string(&path)
        .unwrap_or_else(|e| panic!("{}: {e}: run docs/build", path.display()));
    let mut browser = Browser::start_with(name, options)?;
    let source = json!({ "source": format!("{axe}\n{VIOLATIONS}") });
    browser.call("Page.addScriptToEvaluateOnNewDocument", source);
    Some(browser)
}

/// What is wrong on the page that is open, each line with the name of this view.
fn violations(browser: &mut Browser, view: &str) -> Vec<String> {
    browser.draw();
    let found: Vec<String> = browser.value("axe.violations()");
    found.into_iter().map(|violation| format!("{view}: {violation}")).collect()
}

/// The width of a window, and the colours that its reader prefers.
type View = (u32, &'static str);

/// Opens pages of the site with one browser, as long as there are pages that no other browser has taken.
fn read_pages(name: &str, pages: &[(View, &String)], taken: &AtomicUsize) -> Vec<String> {
    let site = site();
    let Some(mut browser) = browser(name, &["--disable-gpu"]) else { return Vec::new() };
    let (mut wrong, mut last) = (Vec::new(), None);
    while let Some(&(view, page)) = pages.get(taken.fetch_add(1, Ordering::Relaxed)) {
        let (width, scheme) = view;
        if last.replace(view) != Some(view) {
            browser.resize(width, 900);
            browser.prefer("prefers-color-scheme", scheme);
        }
        go(&mut browser, &site, page);
        wrong.extend(violations(&mut browser, &format!("{page}, {width} px, {scheme}")));
    }
    wrong
}

/// Each page is opened at the width of a phone in light colours, and each form of a page also at that of a desktop in dark ones:
/// the Chinese book has the elements of the English one, and the pages that show files of the repository do not depend
/// on the width, so that every second of them is opened in dark colours alone.
#[test]
#[ignore = "takes a minute; needs docs/build"]
fn site_pages_are_accessible() {
    let all = names(&site());
    let (mut light, mut dark, mut desktop) = (Vec::new(), Vec::new(), Vec::new());
    for (i, page) in all.iter().filter(|file| file.ends_with(".html")).enumerate() {
        let is_file = page.starts_with("files/");
        if is_file && i % 2 == 0 {
            dark.push(((360, "dark"), page));
        } else {
            light.push(((360, "light"), page));
        }
        if !is_file && !page.starts_with("zh/") {
            desktop.push(((1280, "dark"), page));
        }
    }
    let (views, taken) = ([light, dark, desktop].concat(), AtomicUsize::new(0));
    let wrong = thread::scope(|scope| {
        let other = scope.spawn(|| read_pages("axe-other", &views, &taken));
        [read_pages("axe", &views, &taken), other.join().unwrap()].concat()
    });
    println!("{} views of pages", views.len());
    assert!(
        views.len() > 400 && wrong.is_empty(),
        "{} violations:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// What a reader may do on a page of a book, and how the page shows that it was done.
const ACTIONS: [(&str, &str); 6] = [
    (
        "document.getElementById('mdbook-sidebar-toggle').click()",
        "document.getElementById('mdbook-sidebar').getBoundingClientRect().left === 0",
    ),
    (
        "document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '?', bubbles: true }))",
        "document.getElementById('mdbook-help-container').style.display === 'flex'",
    ),
    (
        "document.querySelector('.clip-button').focus()",
        "getComputedStyle(document.querySelector('.buttons:focus-within')).opacity === '1'",
    ),
    ("document.querySelector('.checkbox-img').click()", "true"),
    (
        "null",
        "(document.querySelector('rp-figure').scrollIntoView({ block: 'center', behavior: 'instant' }),
            document.querySelector('rp-figure').shadowRoot.querySelector('.controls').childElementCount > 0)",
    ),
    // With the engines: it is answered, and can be dragged.
    (
        "(async () => {
            const figure = document.querySelector('rp-figure');
            figure.scrollIntoView({ block: 'center', behavior: 'instant' });
            await figure.reveal('');
        })()",
        "document.querySelector('rp-figure').shadowRoot.querySelector('[role=slider]') !== null",
    ),
];

/// The contents, the help, the button that copies, an enlarged picture and a live figure; and in each of the five themes the list of
/// themes, results of a search and marks of what was searched for.
#[test]
#[ignore = "takes seconds; needs docs/build"]
fn site_is_accessible_in_use() {
    let site = site();
    let Some(mut browser) = browser("axe-in-use", &["--disable-gpu"]) else { return };
    let mut wrong = Vec::new();
    browser.resize(360, 740);
    for ((action, done), book) in ACTIONS.iter().zip(["en", "zh"].into_iter().cycle()) {
        go(&mut browser, &site, &format!("{book}/ch01.html"));
        browser.eval(action);
        browser.wait_for(done);
        wrong.extend(violations(&mut browser, action));
    }
    browser.resize(1280, 900);
    for theme in ["light", "rust", "coal", "navy", "ayu"] {
        browser.eval(&format!("localStorage.setItem('mdbook-theme', '{theme}')"));
        go(&mut browser, &site, "en/ch01.html?highlight=sample");
        browser.eval(
            "document.getElementById('mdbook-search-toggle').click();
             document.getElementById('mdbook-searchbar').value = 'sample';",
        );
        browser.wait_for("document.querySelector('#mdbook-searchresults a') !== null");
        browser.click("#mdbook-theme-toggle");
        let shown = browser.eval(
            "[document.documentElement.classList.contains(localStorage.getItem('mdbook-theme')),
              document.querySelectorAll('main mark').length > 0]",
        );
        assert_eq!(shown, json!([true, true]), "{theme}");
        wrong.extend(violations(&mut browser, theme));
    }
    assert!(wrong.is_empty(), "{} violations:\n{}", wrong.len(), wrong.join("\n"));
}

/// The reports, the playground and the page for GPUs, with everything on them that opens.
#[test]
#[ignore = "takes seconds; needs docs/build"]
fn site_has_accessible_tools() {
    let tools = site().join("try");
    let Some(mut browser) = browser("axe-tools", &SWIFTSHADER) else { return };
    let mut wrong = Vec::new();
    let mut views = vec![(360, "light"), (1280, "dark")].into_iter().cycle();
    let mut next = |browser: &mut Browser| {
        let (width, scheme) = views.next().unwrap();
        browser.resize(width, 740);
        browser.prefer("prefers-color-scheme", scheme);
        format!("{width} px, {scheme}")
    };
    let unfold = "document.querySelectorAll('details').forEach(part => { part.open = true; })";

    let every = folder("axe-report").join("index.html");
    fs::write(&every, html::page(&every_section())).unwrap();
    // Of the pages that the program writes, one of each command.
    let local = Folder::new("axe-local");
    local.put("m.obj", read("tests/data/ties.obj"));
    let mut pages = vec![
        (tools.join("inclusive-edges.html"), "#case-T2&px=2,5"),
        (tools.join("verify.html"), "#case-T2&mode=side&a=games101-strict&b=sysu-inclusive&px=2,5"),
        (every, ""),
    ];
    for (name, words) in [
        ("judge", "judge --cases 20 --report --out . -- PROGRAM engine games101-strict"),
        ("study", "study m.obj --once --size 64x48 --report --out ."),
        ("cost", "cost m.obj --once --size 64x48 --report --out ."),
        ("specimens", "specimens --cases 1 --report --out ."),
        ("course-fans", "course show fans --out . -- PROGRAM engine exclusive-edges"),
    ] {
        local.run(words.replace("PROGRAM", PROGRAM));
        pages.push((local.join(format!("{name}.html")), ""));
    }
    for (page, fragment) in pages {
        for _ in 0..2 {
            let view = next(&mut browser);
            browser.open(&page, fragment);
            browser.eval(unfold);
            browser.eval(
                "for (let i = 0; i < 9; i++) document.querySelector('#cases:not([hidden]) [data-tool=zoomIn]')?.click()",
            );
            wrong.extend(violations(&mut browser, &format!("{}, {view}", page.display())));
        }
    }
    let playground = tools.join("playground.html");
    for (scene, snap) in SCENES.iter().flat_map(|scene| [(scene, true), (scene, false)]) {
        let language = if snap { "zh" } else { "en" };
        let view = next(&mut browser);
        browser.open(&playground, &format!("#scene={scene}&lang={language}"));
        // Corners that are not snapped are those of one scene.
        browser.eval(&format!("state.snap &&= {snap} || state.scene !== 'triangle'; redraw()"));
        settle(&mut browser);
        browser.eval("lookAt(6, 6)");
        settle(&mut browser);
        browser.eval(unfold);
        wrong.extend(violations(&mut browser, &format!("playground, {scene}, {view}")));
    }
    for language in ["en", "zh"] {
        browser.open(&tools.join("your-gpu.html"), &format!("#lang={language}"));
        let only = json!({ "only": [["coverage", 0], ["twice", 0]], "bits": 4 });
        browser.eval(&format!("(state.plant = 'nudged', judgeAll({only}), null)"));
        browser.wait_for("!state.running");
        browser.click("[data-check=coverage] button");
        browser.eval(unfold);
        for _ in 0..2 {
            let view = next(&mut browser);
            wrong.extend(violations(&mut browser, &format!("your-gpu, {language}, {view}")));
        }
    }
    assert!(wrong.is_empty(), "{} violations:\n{}", wrong.len(), wrong.join("\n"));
}

/// The rules can fail: a page of the site with one fault after the other.
#[test]
#[ignore = "needs docs/build"]
fn site_accessibility_faults_are_found() {
    let site = site();
    let Some(mut browser) = browser("axe-faults", &["--disable-gpu"]) else { return };
    browser.resize(360, 740);
    let page = "en/games101.html";
    let mut found = |fault: &str| -> Vec<String> {
        go(&mut browser, &site, page);
        browser.eval(fault);
        let lines = violations(&mut browser, "").into_iter();
        lines.map(|line| line.split(": ").nth(1).unwrap().to_owned()).collect()
    };
    assert_eq!(found("null"), Vec::<String>::new());
    for (rule, fault) in [
        (
            "scrollable-region-focusable",
            "watcher.disconnect(); document.querySelector('pre > [tabindex]').removeAttribute('tabindex')",
        ),
        ("empty-table-header", "document.querySelector('main th').textContent = ''"),
        ("color-contrast", "document.querySelector('main p').style.color = '#888'"),
        ("color-contrast", "document.querySelector('pre .hljs-keyword').style.color = '#888'"),
        (
            "aria-prohibited-attr",
            "document.querySelector('main p').append(document.createElement('i')); document.querySelector('main p i').ariaLabel = 'text'",
        ),
        ("aria-allowed-attr", "document.querySelector('.checkbox-label').ariaExpanded = 'false'"),
        (
            "label-content-name-mismatch",
            "document.querySelector('.site-links a').ariaLabel = 'elsewhere'",
        ),
        ("image-alt", "document.querySelector('main').append(new Image(9, 9))"),
        ("region", "document.body.insertAdjacentHTML('beforeend', '<p>outside</p>')"),
    ] {
        let rules = found(fault);
        assert!(!rules.is_empty() && rules.iter().all(|found| found == rule), "{fault}: {rules:?}");
    }
}
