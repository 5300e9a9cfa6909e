//! The playground under the hands: mouse, fingers and keys do everything, and every control says what
//! it is.
//!
//! Needs what `playground.rs` needs.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::browser::{Browser, Tab as _};
use crate::playground::{SCENES, both, opened, settle};

/// Where what is called `name` lies on panel `i`, in pixels of the tab.
fn grip(browser: &mut Browser, i: usize, name: &str) -> [f64; 2] {
    let spot = browser.eval(&format!(
        "(() => {{ const {{ canvas }} = view.shown[{i}]; canvas.scrollIntoView({{ block: 'center' }});
            const b = canvas.getBoundingClientRect(), g = grips().find(g => g.name === '{name}');
            return [b.left + (g.x - view.seen[0]) * view.unit, b.top + (g.y - view.seen[1]) * view.unit]; }})()"
    ));
    serde_json::from_value(spot).unwrap()
}

/// Gives the keyboard what is called so on the first panel that shows it.
fn hold(browser: &mut Browser, name: &str) {
    browser.eval(&format!(
        "view.querySelector('.knob[data-name=\"{name}\"][tabindex=\"0\"]').focus()"
    ));
}

/// Drags from one place to another with the mouse.
fn drag(browser: &mut Browser, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    browser.mouse("mousePressed", [x, y]);
    for step in 1..=10 {
        let part = f64::from(step) / 10.0;
        browser.mouse("mouseMoved", [x + part * dx, y + part * dy]);
    }
    browser.mouse("mouseReleased", [x + dx, y + dy]);
    settle(browser);
}

/// A corner is dragged with the mouse: pixels change, and are those of the program.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_follows_the_mouse() {
    let Some((mut browser, page)) = opened("mouse") else { return };
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let picture = "view.shown[0].canvas.toDataURL()";
    let before = browser.eval(picture);
    let spot = grip(&mut browser, 0, "B");
    drag(&mut browser, spot, [-60.0, 40.0]);
    assert_ne!(browser.eval(picture), before);
    // The corner was shared by one triangle only; on the lattice, and not where it was.
    let sub: Vec<f64> =
        browser.value("[state.triangles[0][1].x * 256, state.triangles[0][1].y * 256]");
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
        let verdict = browser.text("rp-view figure:nth-child(2) output");
        assert!(verdict.contains(says), "{rule}: {verdict}");
        assert!(browser.text("#look .say").contains(why), "{rule}");
    }
    // Both are shown against each other too.
    browser.eval("(state.by[1] = 'exclusive-edges', document.querySelector('[data-state=difference]').click())");
    settle(&mut browser);
    assert_eq!(browser.text("rp-view figure:nth-child(3) output"), "22 pixels differ");
}

/// w of a corner and the near plane are dragged on the picture, by mouse, finger and keys; sliders follow.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_drags_values() {
    let Some((mut browser, page)) = opened("values") else { return };
    browser.open(&page, "#scene=perspective&lang=en");
    settle(&mut browser);
    let picture = "view.shown[0].canvas.toDataURL()";
    let before = browser.eval(picture);
    let spot = grip(&mut browser, 0, "w A");
    // Toward the middle of the picture, which is farther from the eye.
    drag(&mut browser, spot, [40.0, -40.0]);
    assert_ne!(browser.eval(picture), before);
    // Both triangles have the corner, and nothing else moved.
    let ws: Vec<f64> = browser.value("state.triangles.map(t => t[0].w)");
    assert!(ws[0] > 2.0 && ws[0] < 8.0 && ws[0] == ws[1], "{ws:?}");
    let corners = browser.eval("handles().map(h => [h.x, h.y, h.members[0].w])");
    assert_eq!(corners[0], json!([2, 29, ws[0]]));
    assert_eq!(corners[1], json!([12, 4, 4]));
    // It stays under the pointer, to the nearest step.
    let [x, y] = grip(&mut browser, 0, "w A");
    assert!((x - spot[0] - 40.0).hypot(y - spot[1] + 40.0) < 8.0, "{spot:?} to {x}, {y}");
    let slider = "Number(document.querySelector('#tools input[type=range]').value)";
    assert_eq!(browser.eval(slider), ws[0]);
    // By keys.
    hold(&mut browser, "w B");
    let chosen = "grips()[state.chosen].says";
    assert_eq!(browser.eval(chosen), "w B = 4");
    browser.press("ArrowUp");
    browser.press_with("ArrowLeft", 8);
    assert_eq!(browser.eval(chosen), "w B = 4.2");
    settle(&mut browser);
    assert!(browser.text("#announce").starts_with("w B = 4.2"), "{}", browser.text("#announce"));

    browser.open(&page, "#scene=near&lang=en");
    settle(&mut browser);
    let covered = "last.answer.panels.map(p => p.covered ?? null)";
    let before = browser.eval(covered);
    let spot = grip(&mut browser, 0, "near plane");
    drag(&mut browser, spot, [30.0, 0.0]);
    let near = browser.eval("state.near").as_f64().unwrap();
    assert!(near > 1.1 && near < 2.0, "{near}");
    let after = browser.eval(covered);
    assert!(after[0].as_u64() < before[0].as_u64(), "{before} {after}: less is left");
    assert_eq!(after[2], before[2], "nothing changes where nothing is clipped");
    let on_screen = "JSON.stringify(state.points.map(p => p.slice(0, 2)))";
    let places = browser.eval(on_screen);
    browser.has_fingers(2);
    let [x, y] = grip(&mut browser, 0, "w C");
    browser.touch("touchStart", &[[x, y]]);
    for step in 1..=4 {
        browser.touch("touchMove", &[[x - 20.0 * f64::from(step), y]]);
    }
    browser.touch("touchEnd", &[]);
    settle(&mut browser);
    assert!(browser.eval("state.points[2][2]").as_f64().unwrap() < 0.0, "behind the eye");
    assert_eq!(browser.eval(on_screen), places, "along its ray");
    browser.eval("(state.near = 1, redraw())");
    settle(&mut browser);
    hold(&mut browser, "near plane");
    assert_eq!(browser.eval(chosen), "near plane = 1");
    browser.press_with("ArrowRight", 8);
    assert_eq!(browser.eval("state.near"), 1.1);
    // Each panel has the grips that lie there.
    let grips = browser.eval("view.shown.map(p => p.grips.map(g => g.dataset.name).join())");
    assert_eq!(grips, json!(["w A,w B,w C,near plane", "A,B,C", "A,B,C", "A,B,C"]));
}

/// Whatever takes the focus has a role, a name and, where it has one, a value, as a screen reader is told.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_names_every_control() {
    let Some((mut browser, page)) = opened("names") else { return };
    browser.call("Accessibility.enable", json!({}));
    let mut heard = BTreeSet::new();
    for (scene, lang) in SCENES.into_iter().flat_map(|scene| [(scene, "en"), (scene, "zh")]) {
        browser.open(&page, &format!("#scene={scene}&lang={lang}"));
        settle(&mut browser);
        let tree = browser.call("Accessibility.getFullAXTree", json!({}));
        let text = |node: &Value, key: &str| match &node[key]["value"] {
            Value::String(text) => text.clone(),
            Value::Null => String::new(),
            other => other.to_string(),
        };
        let property = |node: &Value, name: &str| {
            let all = node["properties"].as_array().cloned().unwrap_or_default();
            all.into_iter().find(|p| p["name"] == name).map(|p| p["value"]["value"].clone())
        };
        let nodes = tree["nodes"].as_array().unwrap().iter().filter(|n| n["ignored"] == false);
        let focusable = nodes.filter(|n| property(n, "focusable") == Some(json!(true)));
        for node in focusable.filter(|n| text(n, "role") != "RootWebArea") {
            let (role, name) = (text(node, "role"), text(node, "name"));
            assert!(!name.trim().is_empty(), "{scene}, {lang}: a nameless {role}: {node}");
            assert!(
                !["", "generic", "none"].contains(&role.as_str()),
                "{scene}: {name} is nothing"
            );
            let has_value = match role.as_str() {
                "slider" | "spinbutton" | "combobox" => !text(node, "value").is_empty(),
                "checkbox" => property(node, "checked").is_some(),
                _ => true,
            };
            assert!(has_value, "{scene}, {lang}: {role} {name} without a value");
            heard.insert(role);
        }
        // What changes is said: what is dragged, what each panel makes of it, why.
        let said = browser.text("#announce");
        let panels = browser.eval("view.shown.map(p => p.canvas.getAttribute('aria-label'))");
        for panel in panels.as_array().unwrap() {
            assert!(said.contains(panel.as_str().unwrap()), "{scene}: {panel} in {said}");
        }
        let number = match scene {
            "line" => "10, 6",
            "weights" => "A 2850816 0.3625",
            "depth" => "2 0.4875",
            "culling" => "2 -4718592",
            _ => "",
        };
        assert!(said.contains(number), "{scene}: {number} in {said}");
    }
    for role in ["application", "button", "checkbox", "combobox", "link", "slider", "spinbutton"] {
        assert!(heard.contains(role), "{role} in {heard:?}");
    }
}

/// A corner is dragged at 64 x 64 pixels with four panels, on a processor that is made four times as slow. The page draws once
/// for each frame, and explains ten times a second by a table that stays the same element. The times are printed and not
/// judged, since they depend on all else that runs on this machine.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn playground_frames_are_timed() {
    let Some((mut browser, page)) = opened("frames") else { return };
    browser.open(
        &page,
        "#t=3.5,2.5_60.25,10.5_20.5,60.5&window=0,0,64,64\
         &by=scanline,exclusive-edges,oracle,games101-strict",
    );
    settle(&mut browser);
    assert_eq!(browser.eval("view.shown.length"), 4);
    let [x, y] = grip(&mut browser, 0, "B");
    browser.mouse("mousePressed", [x, y]);
    browser.call("Emulation.setCPUThrottlingRate", json!({ "rate": 4 }));
    browser.call("Performance.enable", json!({ "timeDomain": "threadTicks" }));
    let metric = |browser: &mut Browser, name: &str| {
        let metrics = browser.call("Performance.getMetrics", json!({}))["metrics"].clone();
        let found = metrics.as_array().unwrap().iter().find(|metric| metric["name"] == name);
        found.unwrap()["value"].as_f64().unwrap()
    };
    let before = ["TaskDuration", "LayoutCount"].map(|name| metric(&mut browser, name));
    let drag = format!(
        "(async () => {{
            const next = () => new Promise(requestAnimationFrame);
            const {{ frame }} = view.shown[0];
            const [table, once, asked, gaps] = [$('look').querySelector('table'), ask, [], []];
            ask = (question) => {{ asked.push(question.ask); return once(question); }};
            frames.length = 0;
            for (let i = 0, last = await next(); i < 120; i++) {{
                const [clientX, clientY] = [{x} - i / 2, {y} + i];
                const move = {{ clientX, clientY, pointerId: 1, pointerType: 'mouse', bubbles: true }};
                // Two moves of one frame.
                frame.dispatchEvent(new PointerEvent('pointermove', {{ ...move, clientX: clientX + 1 }}));
                frame.dispatchEvent(new PointerEvent('pointermove', move));
                const now = await next();
                gaps.push(now - last);
                last = now;
            }}
            ask = once;
            gaps.sort((a, b) => a - b);
            const count = (kind) => asked.filter((one) => one === kind).length;
            return [frames.length, count('draw'), count('look'), table.isConnected, gaps[113]];
        }})()"
    );
    let told = browser.eval(&drag);
    let (frames, draws, looks, is_kept, p95): (f64, f64, f64, bool, f64) =
        serde_json::from_value(told).unwrap();
    let [processor, layouts] =
        ["TaskDuration", "LayoutCount"].map(|name| metric(&mut browser, name));
    assert!(frames >= 110.0 && draws == frames, "{frames} frames, {draws} pictures");
    assert!(looks > 0.0 && looks < frames / 2.0, "{looks} explanations in {frames} frames");
    assert!(is_kept, "the table beside is another one");
    // Nothing reads the layout after it has changed something.
    assert!(layouts - before[1] < 1.5 * frames, "laid out {} times", layouts - before[1]);
    assert_eq!(browser.eval("state.triangles[0][1].x < 55"), true, "the corner followed");
    eprintln!(
        "playground at a fourth of the speed: 64 x 64 pixels, four panels: p95 of a frame {p95:.1} ms, {:.1} ms of it on the \
         processor in the mean, {looks} explanations",
        1000.0 * (processor - before[0]) / frames
    );
}

/// Two fingers zoom about the spot between them, and move no corner; one finger drags.
#[test]
fn playground_follows_fingers() {
    let Some((mut browser, page)) = opened("fingers") else { return };
    browser.has_fingers(2);
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let [x, y] = grip(&mut browser, 0, "C");
    let around = |by: f64| [[x - by, y - 30.0], [x + by, y - 30.0]];
    browser.touch("touchStart", &around(20.0));
    for step in 1..=6 {
        browser.touch("touchMove", &around(20.0 + 5.0 * f64::from(step)));
    }
    browser.touch("touchEnd", &[]);
    settle(&mut browser);
    let window: [i32; 4] = browser.value("state.window");
    assert!(window[2] - window[0] < 14 && window[2] > 10, "{window:?} still holds the corner");
    assert_eq!(browser.eval("state.triangles[0][2].x"), 10.5);
    let [x, y] = grip(&mut browser, 0, "C");
    browser.touch("touchStart", &[[x, y]]);
    browser.touch("touchMove", &[[x - 20.0, y - 20.0]]);
    browser.touch("touchMove", &[[x - 40.0, y - 40.0]]);
    browser.touch("touchEnd", &[]);
    assert!(browser.eval("state.triangles[0][2].x").as_f64().unwrap() < 10.5);
}

/// The keyboard alone reaches every control, moves corners by pixels and subpixels, pans and zooms.
#[test]
fn playground_needs_no_mouse() {
    let Some((mut browser, page)) = opened("keys") else { return };
    browser.open(&page, "#lang=en");
    settle(&mut browser);
    let controls = browser.eval(
        "[...document.querySelectorAll('button, select, input, .pixels, .knob[tabindex=\"0\"], summary')]
            .filter(e => e.checkVisibility()).length",
    );
    let mut reached = BTreeSet::new();
    browser.eval("window.seen = new Set()");
    for _ in 0..controls.as_u64().unwrap() + 4 {
        browser.press("Tab");
        browser.eval("seen.add(document.activeElement)");
        let tag = browser.eval("document.activeElement.tagName");
        reached.insert(tag.as_str().unwrap().to_owned());
    }
    let missed = browser.eval(
        "[...document.querySelectorAll('button, select, input, .pixels, .knob[tabindex=\"0\"], summary')]
            .filter(e => e.checkVisibility() && !seen.has(e)).map(e => e.outerHTML.slice(0, 90))",
    );
    assert_eq!(missed, json!([]), "not reached by Tab; reached {reached:?}");
    let corner = "[handles()[state.chosen].x, handles()[state.chosen].y]";
    hold(&mut browser, "A");
    assert_eq!(browser.eval(corner), json!([2.5, 2.5]));
    browser.press("ArrowRight");
    browser.press_with("ArrowDown", 8);
    assert_eq!(browser.eval(corner), json!([3.5, 2.5 + 1.0 / 256.0]));
    // Whoever does not see it hears where the corner is, and what both panels made of it.
    settle(&mut browser);
    let heard = browser.text("#announce");
    assert!(heard.contains("A 3.5, 2.50390625") && heard.contains("as the oracle"), "{heard}");
    hold(&mut browser, "B");
    browser.press("ArrowLeft");
    assert_eq!(browser.eval(corner), json!([9.5, 2.5]));
    browser.eval("view.shown[0].canvas.focus()");
    browser.press("ArrowDown");
    assert_eq!(browser.eval("state.px"), json!([6, 7]));
    browser.press("+");
    assert_eq!(browser.eval("state.window"), json!([1, 1, 13, 13]));
    browser.press_with("ArrowRight", 1);
    assert_eq!(browser.eval("state.window"), json!([2, 1, 14, 13]));
    settle(&mut browser);
}
