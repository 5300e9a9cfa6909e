//! The viewer of pixels alone in a browser: the sentences of crates/view/page/checks.js are true, and each part of it
//! that is taken away makes one of them false.

use std::fs;

use rasterproof_view::{script, style};
use serde_json::{Value, json};

use crate::browser::{Browser, Tab as _, folder};
use crate::pages::read;

/// The sentences that are not true of the viewer, which has been changed.
fn failing(browser: &mut Browser, change: impl Fn(String) -> String) -> Value {
    let (style, script) = (style(&[]), script(&[&read("crates/view/page/checks.js")]));
    let page = format!(
        "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>view</title><style>{style}</style>\
         <body data-ready><script>{}</script>",
        change(script)
    );
    let path = folder("view").join("index.html");
    fs::write(&path, page).unwrap();
    browser.open(&path, "");
    browser.eval("failing()")
}

#[test]
fn viewer_keeps_its_sentences() {
    let Some(mut browser) = Browser::start("view") else { return };
    for (width, scheme) in [(1280, "light"), (1280, "dark")] {
        browser.resize(width, 900);
        browser.prefer("prefers-color-scheme", scheme);
        let said = failing(&mut browser, |script| script);
        assert_eq!(said["wrong"], json!([]), "{scheme}");
        assert!(said["count"].as_u64() >= Some(15), "{said}");
    }
    // Each planted fault is found.
    for (part, fault) in [
        ("if (isOther || !this.seen)", "if (!this.seen)"),
        ("if (isOther || !this.seen)", "if (true)"),
        ("    event.stopPropagation();\n", ""),
        ("held.moved ||= Math", "held.moved = false && Math"),
        ("&& below > 1.3 * beside", "&& false"),
        ("if (byKeys) this.pan", "if (false) this.pan"),
        ("const isLost = unit < 2 &&", "const isLost = false &&"),
        ("this.classList.toggle('is-wide', this.isWide);", ""),
        ("this.at(panel, { clientX: (a.clientX + b.clientX) / 2,", "this.at(panel, { clientX: 0,"),
        ("if (!panel || !(event.ctrlKey", "if (!panel || !(true"),
        ("isFirst ? 0 : -1", "isFirst ? 0 : 0"),
        ("new ResizeObserver(() => this.resized()).observe(this.body);", ""),
    ] {
        let said = failing(&mut browser, |script| {
            assert_eq!(script.matches(part).count(), 1, "{part}");
            script.replacen(part, fault, 1)
        });
        assert_ne!(said["wrong"], json!([]), "{part} becomes {fault}");
    }
}
