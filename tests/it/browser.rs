//! One driver for all pages: Chromium with one tab, which is opened, asked and touched, and whose complaints are collected.
//!
//! It is driven through the DevTools protocol over two pipes, which needs nothing but JSON. Without Chromium these tests say so and pass,
//! unless `RASTERPROOF_NEEDS_CHROMIUM` is set, as `.ci/run` does. `firefox.rs` is the same for another browser.

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// Where a browser puts its own files, too. A socket is among them, whose path must be short.
pub const TEMPORARY: &str = env!("CARGO_TARGET_TMPDIR");

/// An answer that takes longer never comes.
pub const PATIENCE: Duration = Duration::from_secs(30);

/// A browser with one tab; ends with the value.
pub struct Browser {
    child: Child,
    requests: ChildStdin,
    answers: Receiver<Value>,
    session: Value,
    last: u64,
    pub complaints: Vec<String>,
    folder: PathBuf,
}

impl Browser {
    /// Starts Chromium, or nothing where there is none and none is demanded.
    pub fn start(name: &str) -> Option<Self> {
        Self::start_with(name, &["--disable-gpu"])
    }

    /// The same with options of the browser.
    pub fn start_with(name: &str, options: &[&str]) -> Option<Self> {
        let names = ["chromium", "chromium-browser", "google-chrome"];
        let is_there = |name: &&str| {
            let version = Command::new(name).arg("--version").stderr(Stdio::null()).output();
            version.is_ok_and(|output| output.status.success())
        };
        let Some(program) = names.into_iter().find(is_there) else {
            let demanded = std::env::var_os("RASTERPROOF_NEEDS_CHROMIUM").is_some();
            assert!(!demanded, "no Chromium: install Debian's package chromium");
            eprintln!("SKIPPED: no Chromium; install Debian's package chromium");
            return None;
        };
        let folder = folder(&format!("browser-{name}"));
        // The browser reads requests from file 3 and writes answers to file 4. As root it has no
        // sandbox, and what it opens here is our own page.
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$@\" 3<&0 4>&1 </dev/null >/dev/null", "sh", program])
            .args(["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run"])
            .arg("--remote-debugging-pipe")
            .args(options)
            .arg(format!("--user-data-dir={}", folder.display()))
            .arg("about:blank")
            .env("TMPDIR", TEMPORARY)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let requests = child.stdin.take().unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            for message in output.split(0).map_while(Result::ok) {
                if sender.send(serde_json::from_slice(&message).unwrap()).is_err() {
                    break;
                }
            }
        });
        let (session, complaints) = (Value::Null, Vec::new());
        let mut browser = Self { child, requests, answers, session, last: 0, complaints, folder };
        let tab = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": tab["targetId"], "flatten": true });
        browser.session = browser.call("Target.attachToTarget", attach)["sessionId"].clone();
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.resize(1280, 900);
        Some(browser)
    }

    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.try_call(method, parameters).unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    fn try_call(&mut self, method: &str, parameters: Value) -> Result<Value, Value> {
        self.last += 1;
        let mut request = json!({ "id": self.last, "method": method, "params": parameters });
        if !self.session.is_null() {
            request["sessionId"] = self.session.clone();
        }
        self.requests.write_all(format!("{request}\0").as_bytes()).unwrap();
        loop {
            let message = self.answers.recv_timeout(PATIENCE).expect("the browser answers");
            if message["id"] == self.last {
                let error = &message["error"];
                return if error.is_null() {
                    Ok(message["result"].clone())
                } else {
                    Err(error.clone())
                };
            }
            self.note(&message);
        }
    }

    fn note(&mut self, message: &Value) {
        let parameters = &message["params"];
        let is_bad = match message["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => {
                ["error", "warning", "assert"].iter().any(|kind| parameters["type"] == *kind)
            }
            Some("Log.entryAdded") => parameters["entry"]["level"] == "error",
            _ => false,
        };
        if is_bad {
            self.complaints.push(parameters.to_string());
        }
    }

    /// Opens a file, with a fragment such as `#case-T2`, and waits until its case is drawn.
    pub fn open(&mut self, page: &Path, fragment: &str) {
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        let url = format!("file://{}{fragment}", page.display());
        self.call("Page.navigate", json!({ "url": url }));
        self.wait_for(
            "document.readyState === 'complete' && (document.body.dataset.ready !== undefined \
             || document.querySelector('#cases')?.hidden === true)",
        );
    }

    /// Gives the window a size, and waits until the page has been told and drawn at it.
    pub fn resize(&mut self, width: u32, height: u32) {
        let screen =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", screen);
        self.wait_for(&format!("innerWidth === {width} && innerHeight === {height}"));
        self.draw();
    }

    /// Waits for two frames: what was asked before has been handled and laid out in the first.
    pub fn draw(&mut self) {
        self.eval("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))");
    }

    pub fn prefer(&mut self, feature: &str, value: &str) {
        let features = json!({ "features": [{ "name": feature, "value": value }] });
        self.call("Emulation.setEmulatedMedia", features);
    }

    pub fn press(&mut self, key: &str) {
        self.press_with(key, 0);
    }

    /// With Shift (8) or Alt (1) held. What a key does by default needs its code.
    pub fn press_with(&mut self, key: &str, modifiers: u32) {
        let (code, number, text) = match key {
            "Tab" => (key, 9, ""),
            "Enter" => (key, 13, "\r"),
            "Escape" => (key, 27, ""),
            " " => ("Space", 32, " "),
            "ArrowLeft" => (key, 37, ""),
            "ArrowUp" => (key, 38, ""),
            "ArrowRight" => (key, 39, ""),
            "ArrowDown" => (key, 40, ""),
            letter => ("", 0, letter),
        };
        for kind in ["keyDown", "keyUp"] {
            let event = json!({ "type": kind, "key": key, "code": code, "text": text,
                "windowsVirtualKeyCode": number, "modifiers": modifiers });
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    pub fn text(&mut self, selector: &str) -> String {
        self.value(&format!("document.querySelector({selector:?}).textContent"))
    }

    /// The mouse at a place of the tab, its button pressed, moved or released.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2]) {
        let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1,
            "clickCount": 1 });
        self.call("Input.dispatchMouseEvent", event);
    }

    /// Lets so many fingers touch the tab from now on.
    pub fn has_fingers(&mut self, count: u32) {
        let fingers = json!({ "enabled": true, "maxTouchPoints": count });
        self.call("Emulation.setTouchEmulationEnabled", fingers);
    }

    pub fn touch(&mut self, kind: &str, spots: &[[f64; 2]]) {
        let points: Vec<_> =
            (0..).zip(spots).map(|(id, [x, y])| json!({ "x": x, "y": y, "id": id })).collect();
        self.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }));
    }
}

/// What a test asks of an open page, in whatever browser.
pub trait Tab {
    /// `None` where the tab went to another page before it answered.
    fn try_eval(&mut self, expression: &str) -> Option<Value>;

    fn eval(&mut self, expression: &str) -> Value {
        self.try_eval(expression).expect("the tab stays on its page")
    }

    /// The value of an expression, as a number, a text or a list of this type.
    fn value<T: DeserializeOwned>(&mut self, expression: &str) -> T
    where
        Self: Sized,
    {
        serde_json::from_value(self.eval(expression)).unwrap()
    }

    /// Clicks on the first element that a selector of CSS finds.
    fn click(&mut self, selector: &str) {
        self.eval(&format!("document.querySelector({selector:?}).click()"));
    }

    fn wait_for(&mut self, expression: &str) {
        let start = Instant::now();
        while self.try_eval(expression) != Some(json!(true)) {
            assert!(start.elapsed() < PATIENCE, "never true: {expression}");
            std::thread::sleep(Duration::from_millis(30));
        }
    }
}

fn is_lost_to_navigation(error: &Value) -> bool {
    let message = error["message"].as_str().unwrap_or_default();
    ["navigated", "context"].iter().any(|word| message.contains(word))
}

impl Tab for Browser {
    /// A promise is waited for.
    fn try_eval(&mut self, expression: &str) -> Option<Value> {
        let parameters =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = match self.try_call("Runtime.evaluate", parameters) {
            Ok(answer) => answer,
            Err(error) if is_lost_to_navigation(&error) => return None,
            Err(error) => panic!("{expression}: {error}"),
        };
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        Some(answer["result"]["value"].clone())
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
        // No page of any test may complain.
        assert!(std::thread::panicking() || self.complaints.is_empty(), "{:?}", self.complaints);
    }
}

/// A folder below the build's temporary folder. What an earlier run left there is removed when the folder is first
/// named.
pub fn folder(name: &str) -> PathBuf {
    static NAMED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let folder = Path::new(TEMPORARY).join(format!("page-{name}"));
    if NAMED.lock().unwrap().insert(name.to_owned()) {
        let _ = std::fs::remove_dir_all(&folder);
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
