//! Planted faults of conversation: engines that break the protocol, to see the judge notice.
//!
//! Hidden behind `engine NAME --plant FAULT`. A fault of answers shows in windows of 16 columns only,
//! so that two families of cases meet it and the others do not.

use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::time::Duration;

use super::{Failure, Status, Streams, engine, exit};
use rasterproof_judge::server;

/// A way to break the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Fault {
    /// Speaks version 1 only; no fault.
    Old,
    /// Says something before HELLO; no fault.
    Chatty,
    /// Writes much on standard error, with control characters; no fault of its answers.
    Noisy,
    /// Never answers, not even HELLO.
    Silent,
    /// Refuses HELLO in both versions.
    Rude,
    /// Exits before HELLO.
    Dead,
    /// Chats without end instead of HELLO.
    Babbles,
    /// Stops answering.
    Stalls,
    /// Answers after more than half a second.
    Late,
    /// Aborts.
    Crashes,
    /// Exits with status 3.
    Exits,
    /// Prints a line that is no answer, with control characters.
    Nonsense,
    /// Says more runs than follow.
    Lies,
    /// Answers twice.
    Twice,
    /// Answers the next request first.
    OutOfOrder,
    /// Answers for an id that nobody asked about.
    OtherId,
    /// Writes without end, and no line end.
    Floods,
    /// Writes lines without end.
    FloodsLines,
    /// Answers every request with as many runs as fit on a line.
    Bloats,
    /// Starts another process that keeps its output open, and exits.
    Forks,
    /// Dies, but not when the request comes alone.
    Moody,
}

/// Answers as the engine does, but for its fault.
pub fn run(name: &str, fault: Fault, streams: &mut Streams<'_>) -> Status {
    let entry = &engine::find(name)?;
    match fault {
        Fault::Chatty => writeln!(streams.output, "INFO: a banner\n> HELLO? 2 lines\n")?,
        Fault::Silent => sleep_for_ever(),
        Fault::Dead => return Ok(7),
        Fault::Noisy => (0..20_000).try_for_each(|i| {
            writeln!(streams.errors, "warning {i} \u{1b}[31mred\u{1b}]0;title\u{7}")
        })?,
        Fault::Babbles => loop {
            writeln!(streams.output, "still loading")?;
        },
        _ => {}
    }
    let mut input = BufReader::new(&mut *streams.input);
    let (mut line, mut held) = (String::new(), Vec::new());
    loop {
        streams.output.flush()?;
        line.clear();
        if input.read_line(&mut line)? == 0 {
            return Ok(exit::AGREES);
        }
        let mut answer = Vec::new();
        server::respond(entry, line.trim_end(), &mut answer)?;
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.first() == Some(&"HELLO") {
            let refused = fault == Fault::Rude || (fault == Fault::Old && words[1] == "2");
            let text: &[u8] = if refused { b"E - say something else\n" } else { &answer };
            streams.output.write_all(text)?;
            continue;
        }
        let is_alone = input.buffer().is_empty();
        match (words.get(2) == Some(&"16"), fault) {
            (true, Fault::OutOfOrder) if !is_alone => {
                held = answer;
                continue;
            }
            (_, Fault::Bloats) => {
                let runs = 170_000;
                writeln!(streams.output, "C {} {runs}{}", words[1], " 0 0 1".repeat(runs))?;
            }
            (true, Fault::Moody) if !is_alone => std::process::abort(),
            (true, _) => {
                if let Some(status) = misbehave(fault, words[1], &answer, streams.output)? {
                    return Ok(status);
                }
            }
            (false, _) => streams.output.write_all(&answer)?,
        }
        streams.output.write_all(&std::mem::take(&mut held))?;
    }
}

/// Answers with a fault; a status where the program is to end.
fn misbehave(
    fault: Fault,
    id: &str,
    answer: &[u8],
    out: &mut dyn Write,
) -> Result<Option<u8>, Failure> {
    match fault {
        Fault::Stalls => sleep_for_ever(),
        Fault::Late => {
            std::thread::sleep(Duration::from_millis(600));
            out.write_all(answer)?;
        }
        Fault::Crashes => std::process::abort(),
        Fault::Exits => return Ok(Some(3)),
        Fault::Nonsense => out.write_all(b"debug: \x1b[31mx = 3\x07\n")?,
        Fault::Lies => writeln!(out, "C {id} 2000000000 0 0 1")?,
        Fault::Twice => out.write_all(&[answer, answer].concat())?,
        Fault::OtherId => writeln!(out, "C 999999999 0")?,
        Fault::Floods => loop {
            out.write_all(&[b'7'; 4096])?;
        },
        Fault::FloodsLines => loop {
            writeln!(out, "C {id} 0")?;
        },
        Fault::Forks => {
            // It waits for input that never ends, and holds the output that it was born with.
            let program = std::env::current_exe()?;
            let mut command = Command::new(program);
            command.args(["engine", "scanline", "--plant", "silent"]).stdin(Stdio::null());
            let child = command.spawn()?;
            std::io::stderr().write_all(format!("child {}\n", child.id()).as_bytes())?;
            return Ok(Some(0));
        }
        _ => out.write_all(answer)?,
    }
    Ok(None)
}

fn sleep_for_ever() -> ! {
    loop {
        std::thread::sleep(Duration::from_secs(3600));
    }
}
