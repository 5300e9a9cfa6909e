//! Firefox with one tab, driven through its Marionette protocol: JSON with its length before it, over a socket.
//!
//! Firefox draws WebGL only where it has a display, so it gets one by Xvfb. Where either is missing a test says
//! so and passes: nothing else needs them.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::browser::{PATIENCE, TEMPORARY, Tab, folder};

pub struct Firefox {
    display: Child,
    child: Child,
    connection: BufReader<TcpStream>,
    folder: PathBuf,
    last: u64,
}

impl Firefox {
    /// Starts Firefox, or nothing where it or Xvfb is missing.
    pub fn start(name: &str) -> Option<Self> {
        let is_there = |name: &&str| {
            Command::new("which").arg(name).output().is_ok_and(|found| found.status.success())
        };
        let program = ["firefox-esr", "firefox"].into_iter().find(is_there);
        let (Some(program), true) = (program, is_there(&"Xvfb")) else {
            eprintln!("SKIPPED: no Firefox or no Xvfb; install Debian's firefox-esr and xvfb");
            return None;
        };
        let folder = folder(&format!("firefox-{name}"));
        // A port that is free now.
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let settings = format!(
            "user_pref(\"marionette.port\", {port});\nuser_pref(\"webgl.force-enabled\", true);\n"
        );
        std::fs::write(folder.join("user.js"), settings).unwrap();
        let mut display = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", "1280x1024x24"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(display.stdout.as_mut().unwrap()).read_line(&mut number).unwrap();
        let child = Command::new(program)
            .args(["--marionette", "--no-remote", "--profile"])
            .arg(&folder)
            .env("DISPLAY", format!(":{}", number.trim()))
            .env("HOME", &folder)
            .env("TMPDIR", TEMPORARY)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let start = Instant::now();
        let connection = loop {
            match TcpStream::connect(("127.0.0.1", port)) {
                Ok(connection) => break connection,
                Err(error) => assert!(start.elapsed() < PATIENCE, "Firefox: {error}"),
            }
            std::thread::sleep(Duration::from_millis(100));
        };
        connection.set_read_timeout(Some(PATIENCE)).unwrap();
        let connection = BufReader::new(connection);
        let mut firefox = Self { display, child, connection, folder, last: 0 };
        // It greets first.
        firefox.read();
        firefox.call("WebDriver:NewSession", json!({}));
        Some(firefox)
    }

    fn read(&mut self) -> Value {
        let mut length = Vec::new();
        self.connection.read_until(b':', &mut length).unwrap();
        let length = String::from_utf8(length).unwrap().trim_end_matches(':').parse().unwrap();
        let mut message = vec![0; length];
        self.connection.read_exact(&mut message).unwrap();
        serde_json::from_slice(&message).unwrap()
    }

    fn call(&mut self, command: &str, parameters: Value) -> Value {
        self.last += 1;
        let request = json!([0, self.last, command, parameters]).to_string();
        let message = format!("{}:{request}", request.len());
        self.connection.get_mut().write_all(message.as_bytes()).unwrap();
        let answer = self.read();
        assert!(answer[1] == self.last && answer[2].is_null(), "{command}: {answer}");
        answer[3]["value"].clone()
    }

    pub fn open(&mut self, page: &Path, fragment: &str) {
        let url = format!("file://{}{fragment}", page.display());
        self.call("WebDriver:Navigate", json!({ "url": url }));
        self.wait_for("document.body.dataset.ready !== undefined");
    }
}

impl Tab for Firefox {
    /// The page's own scripts see its constants; those of Marionette do not, and leave one behind to answer.
    fn try_eval(&mut self, expression: &str) -> Option<Value> {
        let text = format!("document.body.dataset.answer = JSON.stringify({expression}) ?? 'null'");
        let script = "const script = document.createElement('script');
            script.textContent = arguments[0];
            document.head.append(script);
            script.remove();
            const { answer } = document.body.dataset;
            delete document.body.dataset.answer;
            return answer;";
        let answer =
            self.call("WebDriver:ExecuteScript", json!({ "script": script, "args": [text] }));
        let answer = answer.as_str().unwrap_or_else(|| panic!("no answer: {expression}"));
        Some(serde_json::from_str(answer).unwrap())
    }
}

impl Drop for Firefox {
    fn drop(&mut self) {
        for child in [&mut self.child, &mut self.display] {
            let _ = child.kill();
            let _ = child.wait();
        }
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}
