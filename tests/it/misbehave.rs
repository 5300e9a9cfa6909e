//! Programs that break the protocol, to see the judge notice.
//!
//! A fault of answers shows in windows of 16 columns only, so that two families of cases meet it and the others do not.
//! Such a program is this test binary itself, in which [`misbehaves`] is the only test that runs.

use std::fs::File;
use std::io::{BufRead as _, BufReader, BufWriter, Write};
use std::process::{Command, Stdio, abort, exit};
use std::time::Duration;

use rasterproof_judge::server;
use rasterproof_registry::engines;

/// The engine that answers, and its fault: the two words of the variable.
const VARIABLE: &str = "RASTERPROOF_MISBEHAVES";

/// The command that answers as an engine does, but for a fault.
pub fn command(engine: &str, fault: &str) -> Vec<String> {
    // What the test harness prints on standard output is thrown away. Answers go to what was standard output before.
    let line = format!(
        "{VARIABLE}=\"$1 $2\" exec \"$0\" --exact misbehave::misbehaves --ignored --nocapture \
         3>&1 >/dev/null"
    );
    let binary = std::env::current_exe().unwrap();
    ["sh", "-c", &line, binary.to_str().unwrap(), engine, fault].map(str::to_owned).into()
}

#[test]
#[ignore = "is a program that other tests start; without its variable it does nothing"]
fn misbehaves() {
    let Ok(words) = std::env::var(VARIABLE) else { return };
    let (engine, fault) = words.split_once(' ').unwrap();
    // Where the judge closes the pipe, nothing is left to answer.
    let out = File::options().write(true).open("/dev/fd/3").unwrap();
    let _ = answer(engine, fault, &mut BufWriter::new(out));
}

fn answer(engine: &str, fault: &str, out: &mut dyn Write) -> std::io::Result<()> {
    let entry = engines::find(engine).unwrap();
    match fault {
        // No fault, as `old`, `noisy`, `slow` and `counts` are none.
        "chatty" => writeln!(out, "INFO: a banner\n> HELLO? 2 lines\n")?,
        // With control characters.
        "noisy" => {
            (0..20_000).for_each(|i| eprintln!("warning {i} \u{1b}[31mred\u{1b}]0;title\u{7}"))
        }
        "silent" => sleep_for_ever(),
        "dead" => exit(7),
        "babbles" => loop {
            writeln!(out, "still loading")?;
        },
        _ => {}
    }
    let mut input = BufReader::new(std::io::stdin());
    let (mut line, mut held) = (String::new(), Vec::new());
    loop {
        out.flush()?;
        line.clear();
        if input.read_line(&mut line)? == 0 {
            if fault == "leaks" {
                // As LeakSanitizer says it.
                eprintln!("==7==ERROR: LeakSanitizer: detected memory leaks");
                exit(1);
            }
            return Ok(());
        }
        let mut answer = Vec::new();
        server::respond(entry, line.trim_end(), &mut answer)?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_alone = input.buffer().is_empty();
        match (fault, &words[..]) {
            ("rude", ["HELLO", ..]) | ("old", ["HELLO", "2", ..]) => {
                writeln!(out, "E - say something else")?;
            }
            ("dances", ["HELLO", ..]) => {
                writeln!(out, "{} rule=topleft", answer.trim_ascii_end().escape_ascii())?;
            }
            (_, ["HELLO", ..]) => out.write_all(&answer)?,
            // The hits of each run are counted.
            ("counts", ["T", ..]) => {
                let answer = String::from_utf8_lossy(&answer).replacen('C', "H", 1);
                let words: Vec<&str> = answer.split_whitespace().collect();
                let (head, runs) = words.split_at(3);
                write!(out, "{}", head.join(" "))?;
                for run in runs.chunks(3) {
                    write!(out, " {} 1", run.join(" "))?;
                }
                writeln!(out)?;
            }
            // As many runs as fit on a line.
            ("bloats", [_, id, ..]) => {
                let runs = 170_000;
                writeln!(out, "C {id} {runs}{}", " 0 0 1".repeat(runs))?;
            }
            ("slow", [_, _, ..]) => {
                std::thread::sleep(Duration::from_millis(900));
                out.write_all(&answer)?;
            }
            ("out-of-order", [_, _, "16", ..]) if !is_alone => held = std::mem::take(&mut answer),
            ("moody", [_, _, "16", ..]) if !is_alone => abort(),
            (_, [_, id, "16", ..]) => misbehave(fault, id, &answer, out)?,
            _ => out.write_all(&answer)?,
        }
        // An answer that was held back follows the next one.
        if !answer.is_empty() {
            out.write_all(&std::mem::take(&mut held))?;
        }
    }
}

fn misbehave(fault: &str, id: &str, answer: &[u8], out: &mut dyn Write) -> std::io::Result<()> {
    match fault {
        "stalls" => sleep_for_ever(),
        "late" => {
            std::thread::sleep(Duration::from_millis(600));
            out.write_all(answer)
        }
        "crashes" => abort(),
        "exits" => exit(3),
        "nonsense" => out.write_all(b"debug: \x1b[31mx = 3\x07\n"),
        // Says more runs than follow.
        "lies" => writeln!(out, "C {id} 2000000000 0 0 1"),
        "twice" => out.write_all(&[answer, answer].concat()),
        "other-id" => writeln!(out, "C 999999999 0"),
        // No line ends.
        "floods" => loop {
            out.write_all(&[b'7'; 4096])?;
        },
        "floods-lines" => loop {
            writeln!(out, "C {id} 0")?;
        },
        "forks" => {
            // It holds the output that it was born with.
            let child = Command::new("sleep").arg("3600").stdin(Stdio::null()).spawn()?;
            eprintln!("child {}", child.id());
            exit(0);
        }
        _ => out.write_all(answer),
    }
}

fn sleep_for_ever() -> ! {
    loop {
        std::thread::sleep(Duration::from_secs(3600));
    }
}
