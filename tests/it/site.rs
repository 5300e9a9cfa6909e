//! The site that `docs/build` leaves in `target/site`: every link and anchor leads somewhere, nothing comes from elsewhere,
//! and Chromium opens every page at 360 and 1280 pixels without a complaint.
//!
//! Plain `cargo test` leaves these tests out, since the folder may be older than the pages. `.ci/run` builds it before.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::browser::{Browser, Tab as _, folder};
use crate::pages::{Renewal, files, read, root, text_block};
use crate::program::shared;

/// What a reader loads before the first view is complete, pictures and scripts included, the compiled engines not.
const FIRST_VIEW_BYTES: u64 = 300_000;
/// The compiled engines, before a server compresses them.
const MODULE_BYTES: usize = 1_450_000;

pub fn site() -> PathBuf {
    let site = root().join("target/site");
    assert!(site.join("index.html").is_file(), "no {}: run docs/build", site.display());
    site
}

/// Every file of a folder, as a path from there with `/`.
pub fn names(root: &Path) -> BTreeSet<String> {
    let name = |path: PathBuf| path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
    files(root, "").into_iter().map(name).collect()
}

/// The tags of a page, without what a script holds.
fn tags(page: &str) -> Vec<&str> {
    let (mut tags, mut rest) = (Vec::new(), page);
    while let Some((tag, after)) = rest.split_once('<').and_then(|(_, tag)| tag.split_once('>')) {
        tags.push(tag);
        let end = if tag.starts_with("script") { after.find("</script>").unwrap_or(0) } else { 0 };
        rest = &after[end..];
    }
    tags
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let (_, value) = tag.split_once(&format!(" {name}=\""))?;
    value.split('"').next()
}

/// Links of a site that lead nowhere, and whatever a page would load from elsewhere.
fn broken_links(root: &Path) -> (usize, Vec<String>) {
    let all = names(root);
    let pages: BTreeMap<_, _> = all
        .iter()
        .filter(|file| file.ends_with(".html"))
        .map(|file| (file.as_str(), fs::read_to_string(root.join(file)).unwrap()))
        .collect();
    let anchors: BTreeSet<_> = pages
        .iter()
        .flat_map(|(page, text)| tags(text).into_iter().map(move |tag| (*page, tag)))
        .filter_map(|(page, tag)| Some((page, attribute(tag, "id")?)))
        .collect();
    let mut links = Vec::new();
    for (page, text) in &pages {
        for tag in tags(text) {
            let values = ["href", "src"].map(|name| attribute(tag, name));
            links.extend(values.into_iter().flatten().map(|link| (*page, tag, link)));
        }
    }
    // The table of contents is written by a script, beside the pages.
    let tables: Vec<_> = all
        .iter()
        .filter(|file| file.contains("/toc-") && file.ends_with(".js"))
        .map(|file| (file, fs::read_to_string(root.join(file)).unwrap()))
        .collect();
    for (file, text) in &tables {
        let table = tags(text).into_iter().filter(|tag| tag.starts_with("a "));
        links.extend(table.filter_map(|tag| Some((file.as_str(), tag, attribute(tag, "href")?))));
    }
    let mut broken = Vec::new();
    for (page, tag, link) in &links {
        if link.starts_with("data:") {
            continue;
        }
        if link.contains(':') || link.starts_with("//") {
            if !tag.starts_with("a ") {
                broken.push(format!("{page} loads {link}"));
            }
            continue;
        }
        let (name, anchor) = link.split_once('#').unwrap_or((link, ""));
        let mut parts: Vec<_> = page.split('/').collect();
        if !name.is_empty() {
            parts.pop();
        }
        for part in name.split('/').filter(|part| !part.is_empty()) {
            match part {
                ".." if parts.pop().is_none() => parts.push("outside"),
                ".." => {}
                part => parts.push(part),
            }
        }
        let target = parts.join("/");
        // What follows # in the address of a page that the program wrote is a state.
        let is_anchor = !anchor.is_empty() && !target.starts_with("try/");
        if !all.contains(&target) || is_anchor && !anchors.contains(&(target.as_str(), anchor)) {
            broken.push(format!("{page}: {link}"));
        }
    }
    (links.len(), broken)
}

#[test]
#[ignore = "needs docs/build"]
fn site_links_lead_somewhere() {
    let (links, broken) = broken_links(&site());
    println!("{links} links, {} broken", broken.len());
    assert!(links > 5_000 && broken.is_empty(), "{links} links:\n{}", broken.join("\n"));
}

/// The rule can fail: a missing page, a missing anchor, a path out of the site, and what is loaded from elsewhere.
#[test]
fn site_broken_links_are_found() {
    let root = folder("site-broken");
    fs::create_dir_all(root.join("en")).unwrap();
    let page = "<h1 id=\"a\"></h1><a href=\"b.html#a\"></a><a href=\"#a\"></a><a class=x\nhref=\"no.html\"></a>\
        <script src=\"../c.js\">'<a href=\"no.html\">'</script><a href=\"https://example.org/\"></a>";
    fs::write(root.join("en/b.html"), page).unwrap();
    fs::write(root.join("c.js"), "").unwrap();
    assert_eq!(broken_links(&root), (4, vec![]));
    for (link, found) in [
        ("<a href=\"b.html#b\">", "en/b.html: b.html#b"),
        ("<a href=\"c.html\">", "en/b.html: c.html"),
        ("<a href=\"../../c.js\">", "en/b.html: ../../c.js"),
        ("<img src=\"x.png\">", "en/b.html: x.png"),
        ("<img src=\"https://example.org/x.png\">", "en/b.html loads https://example.org/x.png"),
    ] {
        fs::write(root.join("en/b.html"), format!("{page}{link}")).unwrap();
        assert_eq!(broken_links(&root), (5, vec![found.to_owned()]));
    }
}

/// The engines are in the site once, for live figures and for the pages that ask them, and small enough.
#[test]
#[ignore = "needs docs/build"]
fn site_has_one_module() {
    let site = site();
    let all = names(&site);
    // As bytes, and in base64.
    let marks = [&b"\0asm\x01\0\0\0"[..], b"AGFzbQEAAAA"];
    let holds = |file: &&String| {
        let bytes = fs::read(site.join(file)).unwrap();
        // A copy of the module is larger than most files.
        bytes.len() > 300_000
            && marks.iter().any(|mark| bytes.windows(mark.len()).any(|window| window == *mark))
    };
    let modules: Vec<_> = all.iter().filter(holds).collect();
    assert_eq!(modules, ["try/engines.js"]);
    let text = fs::read_to_string(site.join("try/engines.js")).unwrap();
    let bytes = text.split('"').nth(1).unwrap().len() / 4 * 3;
    println!("the module: {bytes} bytes");
    assert!(bytes <= MODULE_BYTES, "the module has {bytes} bytes");
    for page in ["playground", "your-gpu"] {
        let text = fs::read_to_string(site.join(format!("try/{page}.html"))).unwrap();
        let loads: Vec<_> =
            tags(&text).into_iter().filter_map(|tag| attribute(tag, "src")).collect();
        assert_eq!(loads, ["engines.js"], "{page}");
    }
}

/// What two pages show is what the program printed when the site was built, and the repository has it so too, the tables in a file
/// beside the pages.
/// `RASTERPROOF_RENEW=1 cargo test --test it site_tables -- --ignored` writes them there.
#[test]
#[ignore = "needs docs/build"]
fn site_tables_are_printed() {
    let mut renewal = Renewal::default();
    for name in ["differential", "planted"] {
        let mut shown = Vec::new();
        for book in ["en", "zh"] {
            let page = fs::read_to_string(site().join(format!("{book}/{name}.html"))).unwrap();
            let (_, block) = page.split_once("<code class=\"language-text").unwrap();
            let block = block.split_once('>').unwrap().1.split_once("</code>").unwrap().0;
            let block = block
                .replace("&gt;", ">")
                .replace("&lt;", "<")
                .replace("&quot;", "\"")
                .replace("&#x27;", "'");
            let path = if book == "en" { "docs" } else { "docs/zh" };
            let path = format!("{path}/{name}.md");
            let block = block.replace("&amp;", "&");
            let (before, tables) = block.split_once("\nWrong pixels").unwrap_or((&block, ""));
            let mut own = read(&path);
            own.replace_range(text_block(&own), before);
            renewal.is(&path, &own);
            if !tables.is_empty() {
                renewal.is(format!("docs/{name}.txt"), &block);
            }
            shown.push(block);
        }
        assert_eq!(shown[0], shown[1], "{name}");
        assert_eq!(shown[0].contains("\nWrong pixels"), name == "differential");
        if name == "planted" {
            continue; // It has no rows.
        }
        // A family that is run again has the row of the page; with another seed it has not.
        let cells = |row: &str| row.split_whitespace().collect::<Vec<_>>().join(" ");
        let row = |seed: &str| {
            let words = format!("verify --table --family half-integer --cases 20000 --seed {seed}");
            let printed = shared().run(words).out;
            cells(
                printed
                    .lines()
                    .find(|line| line.trim_start().starts_with("half-integer "))
                    .unwrap(),
            )
        };
        let rows: Vec<_> = shown[0].lines().map(cells).collect();
        assert!(rows.contains(&row("1")) && !rows.contains(&row("2")), "{name}: {}", row("1"));
    }
    renewal.check("site_tables -- --ignored");
}

/// One browser opens all pages, each at the width of a phone and at that of a desktop.
#[test]
#[ignore = "takes more than six seconds; needs docs/build"]
fn site_opens_in_a_browser() {
    let site = site();
    let all = names(&site);
    let Some(mut browser) = Browser::start("site") else { return };
    let (mut wrong, mut heaviest, mut opened) = (Vec::new(), (0, String::new()), 0);
    for page in all.iter().filter(|file| file.ends_with(".html")) {
        browser.resize(360, 740);
        go(&mut browser, &site, page);
        opened += 1;
        // mdBook's text scrolls inside its own element, so the document alone would never be too wide.
        let excess = browser.eval(
            "Math.max(...[document.documentElement, document.getElementById('mdbook-content')]
                .map(e => e ? e.scrollWidth - e.clientWidth : 0))",
        );
        if excess.as_i64() != Some(0) {
            wrong.push(format!("{page} is {excess} pixels too wide for a screen of 360"));
        }
        let loaded: BTreeSet<String> = browser.value(
            "[location, ...performance.getEntriesByType('resource').map(r => new URL(r.name))].map(u => u.protocol === 'file:' ? decodeURI(u.pathname) : u.href)",
        );
        let foreign = loaded
            .iter()
            .filter(|file| !Path::new(file).starts_with(&site) && !file.starts_with("data:"));
        wrong.extend(foreign.map(|file| format!("{page} loads {file}")));
        let weights = loaded.iter().filter(|file| !file.ends_with("/engines.js"));
        let weight =
            weights.filter_map(|file| fs::metadata(file).ok()).map(|file| file.len()).sum();
        if page.starts_with("en/") || page.starts_with("zh/") {
            heaviest = heaviest.max((weight, page.clone()));
        }
        browser.resize(1280, 900);
        let complaints = std::mem::take(&mut browser.complaints);
        wrong.extend(complaints.into_iter().map(|complaint| format!("{page}: {complaint}")));
        let others: Vec<String> = browser.value(
            "[...document.querySelectorAll('.site-links a')].filter(a => a.offsetWidth).map(a => a.href.replace(/^file:..|#.*/g, ''))",
        );
        let is_chapter = page.starts_with("en/") || page.starts_with("zh/");
        let other = if page.starts_with("en/") {
            page.replacen("en/", "zh/", 1)
        } else {
            page.replacen("zh/", "en/", 1)
        };
        let wanted = ["try/playground.html", "try/your-gpu.html", &other]
            .map(|file| site.join(file).to_str().unwrap().to_owned());
        if is_chapter && !page.ends_with("/toc.html") && others != wanted {
            wrong.push(format!("{page} leads to {others:?}"));
        }
    }
    println!("{opened} pages; the heaviest first view: {} bytes, {}", heaviest.0, heaviest.1);
    if heaviest.0 > FIRST_VIEW_BYTES {
        wrong.push(format!("the first view of {} is {} bytes", heaviest.1, heaviest.0));
    }
    wrong.append(&mut browser.complaints);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What readers look for, and the page that is among the first three that are found: a book, words and a page in each line.
const SEARCHES: &str = include_str!("../data/pages/searches.txt");

#[test]
#[ignore = "needs docs/build"]
fn site_search_finds_lessons_first() {
    let Some(mut browser) = Browser::start("site-search") else { return };
    let mut wrong = Vec::new();
    for line in SEARCHES.lines() {
        let [book, words, found] = line.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        go(&mut browser, &site(), &format!("{book}/index.html"));
        browser.eval(&format!(
            "document.getElementById('mdbook-search-toggle').click();
             document.getElementById('mdbook-searchbar').value = {words:?};"
        ));
        browser.wait_for(
            "!document.getElementById('mdbook-searchresults-outer').classList.contains('hidden')",
        );
        // Several places of one page count as one.
        let pages: Vec<String> = browser.value(
            "[...new Map([...document.querySelectorAll('#mdbook-searchresults li > a')].map(a =>
                [a.pathname.split('/').pop(), a.pathname.split('/').pop() + decodeURI(a.hash)])).values()]",
        );
        if !pages.iter().take(3).any(|page| page.starts_with(found)) {
            wrong.push(format!(
                "{book}, '{words}': {found} is not among the first three of {pages:?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The keyboard is at the text after two keys, and the other language is read on at the same heading.
#[test]
#[ignore = "needs docs/build"]
fn site_text_is_near() {
    let Some(mut browser) = Browser::start("site-near") else { return };
    for (book, says) in [("en", "Skip to the text"), ("zh", "跳到正文")] {
        go(&mut browser, &site(), &format!("{book}/ch03.html"));
        browser.press("Tab");
        assert_eq!(browser.eval("document.activeElement.textContent"), says);
        browser.press("Enter");
        browser.wait_for("document.activeElement.id === 'text'");
    }
    // Escape closes the contents.
    browser.eval("document.querySelector('#mdbook-sidebar a').focus()");
    assert_eq!(browser.eval("document.activeElement.closest('nav').id"), "mdbook-sidebar");
    browser.press("Escape");
    browser.wait_for("document.activeElement.id === 'mdbook-sidebar-toggle'");

    go(&mut browser, &site(), "en/ch03.html");
    let heading = "document.querySelectorAll('main h2')[3]";
    browser.eval(&format!("{heading}.scrollIntoView({{ behavior: 'instant' }})"));
    browser.draw();
    let other = browser.eval(&format!("{heading}.dataset.other"));
    browser.click(".site-links [rel=alternate]:not([hidden]).in-en");
    browser.wait_for(
        "location.pathname.endsWith('/zh/ch03.html') && document.readyState === 'complete'",
    );
    assert_eq!(browser.eval("decodeURI(location.hash)"), format!("#{}", other.as_str().unwrap()));
}

/// The code of each stage in Python and C++, which the page in the repository has as links, stands in tabs beside that in Rust.
#[test]
#[ignore = "needs docs/build"]
fn site_shows_code_in_tabs() {
    let Some(mut browser) = Browser::start("site-tabs") else { return };
    let stages = read("docs/own.md").matches("\nPython: [").count();
    // The tab of Rust is open first.
    let tabs =
        [(1, "Python", "def stage1("), (2, "C++", "void stage1("), (0, "Rust", "fn stage1(")];
    for (book, width) in [("en", 360), ("zh", 1280)] {
        browser.resize(width, 800);
        go(&mut browser, &site(), &format!("{book}/own.html"));
        assert_eq!(browser.eval("document.querySelectorAll('main .tabs').length"), stages);
        for (at, language, code) in tabs {
            let tab = format!("document.querySelector('main .tabs').children[{at}]");
            browser.eval(&format!("{tab}.firstElementChild.click()"));
            browser.wait_for(&format!("document.querySelector('main .tabs > [open]') === {tab}"));
            let text = browser.eval(&format!("{tab}.innerText"));
            let text = text.as_str().unwrap();
            assert!(text.starts_with(language) && text.contains(code), "{book}: {text}");
        }
    }
}

/// Figures stand there before the engines are loaded, and nothing moves when these have come.
#[test]
#[ignore = "needs docs/build"]
fn site_figures_do_not_wait_for_engines() {
    let Some(mut browser) = Browser::start("site-figures") else { return };
    for (width, page) in [360, 1280].into_iter().flat_map(|width| {
        ["en/index.html", "en/ch02.html", "zh/ch06.html"].map(|page| (width, page))
    }) {
        browser.resize(width, 740);
        // The first answer of the engines is withheld, as on a slow line.
        let held = json!({ "source": "Object.defineProperty(globalThis, 'rasterproofEngines', {
            set(take) { window.release = (text) => take(text); window.held ??= []; },
            get() { return (text) => window.held.push(text); }, configurable: true });
            window.moved = [];
            const place = ({ node, previousRect: from, currentRect: to }) =>
                `${node?.nodeName} ${node?.className ?? node?.textContent}: ${[from.x, from.y, from.width, from.height]} to ${[to.x, to.y, to.width, to.height]}`;
            new PerformanceObserver((list) => window.moved.push(...list.getEntries().map((entry) => [entry.value, ...entry.sources.map(place)])))
                .observe({ type: 'layout-shift', buffered: true });" });
        let script = browser.call("Page.addScriptToEvaluateOnNewDocument", held);
        go(&mut browser, &site(), page);
        browser.eval("document.querySelector('rp-figure').scrollIntoView({ block: 'center', behavior: 'instant' })");
        browser.wait_for("window.held?.length === 1");
        let first = "(({ shadowRoot: root }) => [root.querySelector('.stage svg') !== null,
            root.querySelector('.controls').childElementCount > 0, root.querySelector('.waits') === null])
            (document.querySelector('rp-figure'))";
        assert_eq!(browser.eval(first), json!([true, true, true]), "{page}");
        browser.eval("release(held[0])");
        browser.wait_for("document.querySelector('rp-figure').exports !== undefined");
        browser.draw();
        let moved = browser.eval("window.moved");
        let sum: f64 = moved.as_array().unwrap().iter().filter_map(|entry| entry[0].as_f64()).sum();
        assert!(sum < 0.02, "{page} at {width} px moves by {sum}: {moved}");
        browser.call("Page.removeScriptToEvaluateOnNewDocument", script);
    }
}

/// On a phone a table keeps the name of a row in sight, and at least half of the width for its numbers. The league shows
/// scores alone, and all of its columns on a desktop.
#[test]
#[ignore = "needs docs/build"]
fn site_tables_can_be_read() {
    let Some(mut browser) = Browser::start("site-tables") else { return };
    let root = site();
    browser.resize(360, 740);
    for page in ["en/league.html", "zh/league.html", "en/effects.html"] {
        go(&mut browser, &root, page);
        let seen = browser.eval(
            "(() => {
                const wide = [...document.querySelectorAll('.table-wrapper')].filter(t => t.scrollWidth > t.clientWidth);
                return wide.map(table => {
                    table.scrollLeft = 1e6;
                    const box = table.getBoundingClientRect(), name = table.querySelector('tbody :is(td, th)').getBoundingClientRect();
                    return Math.abs(name.left - box.left) < 2 && name.width < 0.5 * box.width;
                });
            })()",
        );
        let seen: Vec<bool> = serde_json::from_value(seen).unwrap();
        assert!(!seen.is_empty() && seen.iter().all(|seen| *seen), "{page}: {seen:?}");
    }
    browser.resize(1280, 900);
    go(&mut browser, &root, "en/league.html");
    let heads = browser.eval(
        "[...document.querySelectorAll('table')[0].querySelectorAll('th')].map(h => h.textContent)",
    );
    assert_eq!(
        [&heads[0], &heads[1], &heads[9]],
        [&json!("library"), &json!("as is"), &json!(null)],
        "{heads}"
    );
    let cut =
        "[...document.querySelectorAll('.table-wrapper')].map(t => t.scrollWidth - t.clientWidth)";
    assert_eq!(browser.eval(cut)[0], json!(0), "nothing of the league is cut");
    assert_eq!(browser.eval("document.documentElement.scrollWidth <= innerWidth"), true);
}

/// A server's page for an address that leads nowhere offers the page that was probably meant.
#[test]
#[ignore = "needs docs/build"]
fn site_has_a_page_for_lost_readers() {
    let root = folder("site-lost");
    fs::create_dir_all(root.join("zh")).unwrap();
    for asked in ["zh/edge-functions.html", "tessellator.html", "zh/qqq.html"] {
        fs::copy(site().join("404.html"), root.join(asked)).unwrap();
    }
    let Some(mut browser) = Browser::start("site-lost") else { return };
    for (asked, offered) in [
        ("zh/edge-functions.html", Some("zh/ch02-edge-functions.html")),
        ("tessellator.html", Some("en/tessellators.html")),
        ("zh/qqq.html", None),
    ] {
        go(&mut browser, &root, asked);
        let near = browser.eval("document.getElementById('near').hidden ? null : document.querySelector('#near a').href");
        let wanted = offered.map(|page| format!("file://{}", root.join(page).display()));
        assert_eq!(near, json!(wanted), "{asked}");
        let book = browser.eval("document.querySelector('.to-book').href");
        assert_eq!(book, format!("file://{}", root.join("en/index.html").display()));
    }
}

pub fn go(browser: &mut Browser, site: &Path, page: &str) {
    let url = format!("file://{}", site.join(page).display());
    browser.call("Page.navigate", json!({ "url": url }));
    // The first page of the site leads on by a script, after which nothing may be asked of it.
    let leads_on = page == "index.html";
    browser.wait_for(&format!(
        "document.readyState === 'complete' && !({leads_on} && location.href === {url:?})"
    ));
}
