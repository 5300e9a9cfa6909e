//! Every number on a command line has a bound, or costs no memory until it is used: each option of each command with
//! numbers at the ends of the usual words.
#![cfg(unix)]

use std::os::unix::process::ExitStatusExt as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rasterproof_core::parallel;

use crate::program::{Folder, PROGRAM, every, table};

/// 2^32, 2^63 and 2^64 - 1, and a large number for what is no count.
const NUMBERS: [&str; 4] = ["4294967296", "9223372036854775808", "18446744073709551615", "1e308"];

/// Addresses that a process may map, in KiB; so much is taken by none of these commands as it is usually run.
const MOST_KIB: u32 = 6_000_000;
/// What still runs then is taken to be at work, and ended.
const PATIENCE: Duration = Duration::from_secs(1);

/// The options of a command that take a value, with what stands for the value in its help.
fn options(help: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for line in help.lines() {
        let Some((_, option)) = line.split_once("--").filter(|(before, _)| before.len() < 12)
        else {
            continue;
        };
        let end = option.find([' ', '[', '=']).unwrap_or(option.len());
        let (name, rest) = option.split_at(end);
        let value = rest.trim_start_matches([' ', '[', '=']).strip_prefix('<');
        if let Some((value, _)) = value.and_then(|value| value.split_once('>')) {
            found.push((format!("--{name}"), value.to_owned()));
        }
    }
    found
}

/// A number in the form that an option takes.
fn form(value: &str, number: &str) -> String {
    match value {
        "WxH" => format!("{number}x{number}"),
        "I/N" => format!("0/{number}"),
        "X,Y" | "STRENGTH,EXPONENT" => format!("{number},{number}"),
        _ => number.to_owned(),
    }
}

/// Runs a command within bounds; what is wrong with its end, if anything.
fn fault(folder: &Folder, words: &str) -> Option<String> {
    let script = format!("ulimit -v {MOST_KIB}; ulimit -c 0; exec '{PROGRAM}' {words}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script]).current_dir(&**folder);
    shell.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = shell.spawn().unwrap();
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if start.elapsed() > PATIENCE {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let is_fine = matches!(status.code(), Some(0..=2));
    (!is_fine).then(|| format!("{words}: {status}, signal {:?}", status.signal()))
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn numbers_have_bounds_or_cost_nothing() {
    let folder = Folder::new("numbers");
    folder.put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.put("0.json", folder.run("exhaust lines --reach 2 --shard 0/1").out);
    let mut lines = Vec::new();
    for [command, rest] in table("numbers") {
        let help = folder.check(format!("{command} --help"), 0).out;
        let all = options(&help);
        assert!(!all.is_empty(), "{command}");
        for (option, value) in all {
            for number in NUMBERS {
                let word = form(&value, number);
                let rest = rest.replace("PROGRAM", PROGRAM);
                lines.push(format!("{command} {option}={word} {rest}"));
            }
        }
    }
    assert!(lines.len() > 400, "{}", lines.len());
    // Each option has four, of which at least one is tried.
    let tried: Vec<_> = lines.iter().step_by(every(3)).collect();
    let faults = parallel::map(tried.len(), |number| fault(&folder, tried[number]));
    let faults: Vec<_> = faults.into_iter().flatten().collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
