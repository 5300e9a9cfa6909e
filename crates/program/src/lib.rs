//! A program that is asked through pipes: requests on its standard input, answers on its standard
//! output, its standard error kept apart.
//!
//! Three threads serve the pipes, so that nothing the program does can block the judge: one writes
//! requests, one reads answers into a queue of bounded size, one keeps what matters of what it says on
//! standard error. A program that breaks the protocol is ended with everything it started and
//! started again. What was in flight is then asked one by one, so that the request that did it is
//! known.

mod complaints;
pub mod group;
pub mod output;

use std::ffi::{OsStr, OsString};
use std::io::{Read, Write};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use complaints::StandardError;
use group::Group;
use rasterproof_host::limits;
use rasterproof_judge::ask::{
    ANSWER_LETTERS, Answer, Breach, Complaints, Misbehaviour, Question, Subject,
};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::text::{Words, printable};

/// How long a program is waited for.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For each answer.
    pub answer: Duration,
    /// From the start to the answer of HELLO.
    pub start: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self { answer: Duration::from_secs(5), start: Duration::from_secs(30) }
    }
}

/// Bytes read in one go, and how many such pieces wait to be looked at.
const PIECE_BYTES: usize = 1 << 16;
const MOST_PIECES: usize = 16;
/// How often a silent program is looked after.
const LOOK: Duration = Duration::from_millis(20);
/// What comes without such a pause is one flood.
const SILENCE: Duration = Duration::from_millis(100);

/// Once a program has been found to hang, an answer is awaited for this part of the limit, and for so many times as long as
/// the slowest answer took, whichever is longer: each further hang would cost the whole limit again.
const PATIENCE_AFTER_A_HANG: f64 = 1.0 / 20.0;
const TIMES_THE_SLOWEST: u32 = 20;

/// How long an answer is awaited after the time of the judge is over, if the limit of an answer is not shorter.
const GRACE: Duration = Duration::from_secs(1);

/// A program under judgement; it is running from the first question on.
pub struct Program {
    command: Vec<OsString>,
    limits: Limits,
    /// The time of the judge is over here: no question is sent later.
    end: Option<Instant>,
    declared: Declared,
    /// Words of `--declare`, which are heard after those of the program.
    extra: Vec<String>,
    live: Option<Live>,
    /// The first answer that did not come in time.
    slow: Option<Misbehaviour>,
    /// How long the slowest answer was awaited.
    slowest: Duration,
    next_id: u64,
    /// Bytes of the answers to what was asked last.
    kept: usize,
    complaints: Arc<Mutex<StandardError>>,
    strays: Vec<Misbehaviour>,
}

/// A program that is running: its processes, and the ends of its pipes that the threads hand to the judge.
struct Live {
    group: Group,
    /// Has an end when its standard error has one.
    complains: Receiver<()>,
    requests: Sender<Vec<u8>>,
    pieces: Receiver<Vec<u8>>,
    /// What has been read and not yet used, from `used` on.
    pending: Vec<u8>,
    used: usize,
    /// The last request that was answered, to name it when it is answered again.
    answered: Option<(u64, Question)>,
    /// Bytes of the last answer.
    heard: usize,
}

/// How long an answer is awaited.
#[derive(Clone, Copy)]
struct Waiting {
    answer: Duration,
    /// As much time again tells an answer that is late from none at all.
    is_doubled: bool,
    /// Nothing is waited for after this: where it ends the waiting, and not the limit of an answer, that is no fault.
    last: Option<Instant>,
}

/// Why some questions have no answer.
enum Broken {
    /// What it did, with so many requests in flight.
    Misbehaves(Misbehaviour, usize),
    /// The time of the judge ended before the program had answered.
    Over,
}

/// Why no line comes.
enum NoLine {
    /// The program has ended, or has closed its output.
    Ended,
    TimeOut,
    /// So many bytes came without an end of a line.
    TooLong(usize),
}

impl Program {
    /// Starts a program and asks what it is. `command` is its name and its arguments, `extra` what
    /// is declared for it.
    ///
    /// # Errors
    /// It cannot be started, or does not say HELLO.
    pub fn start(
        command: &[impl AsRef<OsStr>],
        extra: &[String],
        limits: Limits,
    ) -> Result<Self, Misbehaviour> {
        let mut program = Self {
            command: command.iter().map(|word| word.as_ref().to_owned()).collect(),
            limits,
            end: None,
            declared: Declared::default(),
            extra: extra.to_vec(),
            live: None,
            slow: None,
            slowest: Duration::ZERO,
            next_id: 1,
            kept: 0,
            complaints: Arc::default(),
            strays: Vec::new(),
        };
        program.declared = program.restart().map_err(|what| program.with_last_words(what))?;
        Ok(program)
    }

    /// What a program did instead of answering, with the end of what it wrote on standard error.
    fn with_last_words(&self, mut what: Misbehaviour) -> Misbehaviour {
        if let Some(last) = self.complaints().shown.pop() {
            what.how = format!("{}; the last line of its standard error: {last}", what.how);
        }
        what
    }

    /// Ends the program if it runs, starts it anew, and asks what it is.
    fn restart(&mut self) -> Result<Declared, Misbehaviour> {
        self.live = None;
        let mut live = Live::start(&self.command, &self.complaints)?;
        let mut declared = live.hello(self.limits_left())?;
        for word in &self.extra {
            declared.hear(word);
        }
        self.live = Some(live);
        Ok(declared)
    }

    /// The same for a program that does not run, so that questions can be sent.
    fn ready(&mut self) -> Result<(), Broken> {
        if self.is_over() {
            return Err(Broken::Over);
        }
        if self.live.is_none()
            && let Err(what) = self.restart()
        {
            // What is not ready when the time ends has done nothing wrong.
            return Err(if self.is_over() { Broken::Over } else { Broken::Misbehaves(what, 1) });
        }
        Ok(())
    }

    /// Whether the time of the judge is over.
    fn is_over(&self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }

    /// When waiting ends: [`Self::end`] and the short while after it.
    fn last(&self) -> Option<Instant> {
        self.end.map(|end| end + GRACE.min(self.limits.answer))
    }

    /// The limits of a wait that begins now: no wait goes beyond [`Self::last`].
    fn limits_left(&self) -> Limits {
        let Some(last) = self.last() else { return self.limits };
        let left = last.saturating_duration_since(Instant::now());
        Limits { answer: self.limits.answer.min(left), start: self.limits.start.min(left) }
    }

    /// How long an answer is awaited, with so many requests in flight.
    fn waiting(&self, in_flight: usize) -> Waiting {
        let most = self.limits.answer;
        let short = most.mul_f64(PATIENCE_AFTER_A_HANG).max(TIMES_THE_SLOWEST * self.slowest);
        Waiting {
            answer: if self.slow.is_some() { short.min(most) } else { most },
            // What is in flight with others is asked alone afterwards.
            is_doubled: self.slow.is_none() && in_flight == 1,
            last: self.last(),
        }
    }

    /// Says of a hang after the first one why no longer was waited, and remembers the first one.
    fn note_slow(&mut self, what: Misbehaviour) -> Misbehaviour {
        match (&self.slow, what.breach) {
            (Some(first), Breach::Hangs) => {
                first.breach.by(format!("{} (the first time: {})", what.how, first.how))
            }
            (None, Breach::Hangs | Breach::Late) => {
                self.slow = Some(what.clone());
                what
            }
            _ => what,
        }
    }

    /// Asks with at most `batch` requests in flight, until all are answered or something breaks.
    fn exchange(
        &mut self,
        questions: &[Question],
        batch: usize,
        answers: &mut Vec<Answer>,
    ) -> Result<(), Broken> {
        self.ready()?;
        let limits_left = self.limits_left();
        // Requests have numbers without gaps, and are answered in their order.
        let first_id = self.next_id;
        let (mut sent, mut answered) = (0, 0);
        while answered < questions.len() {
            // Filled up when half is answered, so that requests travel in blocks.
            if sent < questions.len() && sent - answered <= batch / 2 && !self.is_over() {
                let mut block = Vec::new();
                let end = questions.len().min(answered + batch);
                for (question, id) in questions[sent..end].iter().zip(self.next_id..) {
                    question.write(id, &mut block);
                }
                self.next_id += (end - sent) as u64;
                sent = end;
                // Where the pipe is closed, reading tells why.
                let _ = self.live.as_ref().map(|live| live.requests.send(block));
            }
            // Nothing is in flight, and nothing more is sent.
            let in_flight = sent - answered;
            if in_flight == 0 {
                return Err(Broken::Over);
            }
            let id = first_id + answered as u64;
            let (waiting, start) = (self.waiting(in_flight), Instant::now());
            let Some(live) = &mut self.live else { return Ok(()) };
            let ids = first_id..self.next_id;
            let answer = match live.answer(&questions[answered], id, ids, waiting) {
                Ok(answer) => answer,
                Err(None) => return Err(Broken::Over),
                Err(Some(what)) => {
                    return Err(Broken::Misbehaves(live.or_flood(what, limits_left), in_flight));
                }
            };
            self.slowest = self.slowest.max(start.elapsed());
            // Answers of a block are kept until all are there, so that their length has a bound, too.
            self.kept += live.heard;
            if self.kept > limits::PROGRAM_BLOCK_BYTES {
                let said = format!("{} bytes of answers to a block of requests", self.kept);
                return Err(Broken::Misbehaves(Breach::Floods.by(said), in_flight));
            }
            answers.push(answer);
            live.answered = Some((id, questions[answered].clone()));
            answered += 1;
        }
        Ok(())
    }
}

impl Subject for Program {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        self.kept = 0;
        while answers.len() < questions.len() && deaths < most_deaths {
            let rest = &questions[answers.len()..];
            let Err(broken) = self.exchange(rest, self.declared.batch, &mut answers) else { break };
            self.live = None;
            let Broken::Misbehaves(misbehaviour, in_flight) = broken else { break };
            deaths += 1;
            if in_flight == 1 {
                answers.push(Answer::Died(self.note_slow(misbehaviour)));
                continue;
            }
            // One of these did it: each alone, in a program that has just been started.
            let end = questions.len().min(answers.len() + in_flight);
            let mut found = false;
            while answers.len() < end && !found {
                let one = &questions[answers.len()..=answers.len()];
                let Err(broken) = self.exchange(one, 1, &mut answers) else { continue };
                self.live = None;
                let Broken::Misbehaves(misbehaviour, _) = broken else { break };
                answers.push(Answer::Died(self.note_slow(misbehaviour)));
                found = true;
            }
            if !found {
                self.strays.push(misbehaviour);
            }
        }
        answers
    }

    fn end_at(&mut self, end: Option<Instant>) {
        self.end = end;
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        std::mem::take(&mut self.strays)
    }

    fn finish(&mut self) -> Vec<Misbehaviour> {
        let Some(mut live) = self.live.take() else { return Vec::new() };
        // One that goes on after the end of its input is ended, and that is no fault of its answers.
        match live.end(self.limits.answer) {
            Some(status) if !status.success() => {
                vec![Breach::FailsAtEnd.by(ending(Some(status)).how)]
            }
            _ => Vec::new(),
        }
    }

    fn complaints(&self) -> Complaints {
        let said = self.complaints.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        said.complaints()
    }
}

impl Live {
    /// Starts the processes, and a thread for each pipe.
    fn start(
        command: &[OsString],
        complaints: &Arc<Mutex<StandardError>>,
    ) -> Result<Self, Misbehaviour> {
        let Some((name, arguments)) = command.split_first() else {
            return Err(Breach::CannotStart.by("no program is named"));
        };
        let mut command = Command::new(name);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let failed = |e: std::io::Error| {
            Breach::CannotStart.by(format!("{}: {e}", printable(name.as_encoded_bytes(), 80)))
        };
        let mut group = Group::start(&mut command).map_err(failed)?;
        let child = group.child();
        let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let (Some(mut stdin), Some(mut stdout), Some(stderr)) = pipes else {
            return Err(Breach::CannotStart.by("it has no pipes"));
        };
        // A program that does not read its requests blocks their thread alone.
        let (requests, blocks) = mpsc::channel::<Vec<u8>>();
        serve(move || {
            for block in blocks {
                if stdin.write_all(&block).and_then(|()| stdin.flush()).is_err() {
                    break;
                }
            }
        })?;
        // One that writes without an end waits where the queue is full, and takes no more memory.
        let (read, pieces) = mpsc::sync_channel(MOST_PIECES);
        serve(move || {
            let mut piece = vec![0; PIECE_BYTES];
            while let Ok(n @ 1..) = stdout.read(&mut piece) {
                if read.send(piece[..n].to_vec()).is_err() {
                    break;
                }
            }
        })?;
        let complains = keep_complaints(stderr, Arc::clone(complaints))?;
        let pending = Vec::new();
        Ok(Self { group, complains, requests, pieces, pending, used: 0, answered: None, heard: 0 })
    }

    /// Closes the program's input, which ends a well-behaved one, and ends what is left after `patience`. What it ended
    /// with, or nothing where it had to be ended. Then all that it said on standard error is heard.
    fn end(&mut self, patience: Duration) -> Option<ExitStatus> {
        self.requests = mpsc::channel().0;
        let status = self.group.end(patience);
        // A stray that it has started may hold it open.
        let _ = self.complains.recv_timeout(10 * LOOK);
        status
    }

    /// Says HELLO 2, and HELLO 1 to a program that refuses it; what comes before is skipped.
    fn hello(&mut self, limits: Limits) -> Result<Declared, Misbehaviour> {
        let end = Instant::now() + limits.start;
        let (mut heard, mut last, mut asked) = (0, Vec::new(), 2);
        let _ = self.requests.send(b"HELLO 2\n".to_vec());
        loop {
            let quote = |last: &[u8]| match last {
                [] => "it says nothing".to_owned(),
                last => format!("it says {}", printable(last.trim_ascii_end(), 60)),
            };
            match self.line(end) {
                Ok(line) => {
                    heard += line.len();
                    let text = String::from_utf8_lossy(&self.pending[line.clone()]).into_owned();
                    if let Some(declared) = Declared::parse(text.trim_end()) {
                        return Ok(declared);
                    }
                    let refuses = text.starts_with("E ");
                    last = self.pending[line].to_vec();
                    if refuses && asked == 2 {
                        asked = 1;
                        let _ = self.requests.send(b"HELLO 1\n".to_vec());
                    } else if refuses {
                        return Err(Breach::NoHello.by(quote(&last)));
                    } else if heard > limits::PROGRAM_CHATTER_BYTES {
                        let said = format!("{heard} bytes before HELLO, at last {}", quote(&last));
                        return Err(Breach::Floods.by(said));
                    }
                }
                Err(NoLine::Ended) => {
                    let how = match ending(self.group.end(LOOK * 50)) {
                        Misbehaviour { breach: Breach::Exits, how } => format!("it exits: {how}"),
                        other => other.to_string(),
                    };
                    return Err(Breach::NoHello.by(how));
                }
                Err(NoLine::TimeOut) => {
                    let limit = limits.start.as_secs_f64();
                    let said = quote(&last);
                    return Err(Breach::NoHello.by(format!("{said}, for {limit} s")));
                }
                Err(NoLine::TooLong(bytes)) => return Err(Breach::Floods.by(unended(bytes))),
            }
        }
    }

    /// The answer of one request; `asked` are the ids of this exchange. Where the end of all waiting is what ends it, the
    /// error is nothing.
    fn answer(
        &mut self,
        question: &Question,
        id: u64,
        asked: std::ops::Range<u64>,
        waiting: Waiting,
    ) -> Result<Answer, Option<Misbehaviour>> {
        let start = Instant::now();
        let limit = waiting.answer.as_secs_f64();
        let until = |time: Instant| waiting.last.map_or(time, |last| time.min(last));
        let line = match self.line(until(start + waiting.answer)) {
            Err(NoLine::TimeOut) if start.elapsed() < waiting.answer => return Err(None),
            Err(NoLine::TimeOut) if waiting.is_doubled => {
                match self.line(until(start + 2 * waiting.answer)) {
                    Ok(_) => {
                        let took = start.elapsed().as_secs_f64();
                        Err(Breach::Late.by(format!("after {took:.1} s, allowed are {limit} s")))
                    }
                    Err(why) => Err(self.why(why, limit)),
                }
            }
            other => other.map_err(|why| self.why(why, limit)),
        }?;
        self.heard = line.len();
        let line = self.pending[line].trim_ascii_end();
        let mut words = Words(line);
        let letter = match words.word() {
            Some([letter]) if ANSWER_LETTERS.contains(letter) => *letter,
            _ => return Err(Some(nonsense(line, "no answer begins like this"))),
        };
        // The number of the request that is answered, which must be the one that is waited for.
        let named = words.word().unwrap_or(b"");
        let named_id = std::str::from_utf8(named).ok().and_then(|word| word.parse::<u64>().ok());
        if named_id != Some(id) {
            return Err(Some(match (named_id, &self.answered) {
                (Some(n), Some((last, question))) if n == *last => {
                    Breach::Twice.by(printable(question.text(n).as_bytes(), 80))
                }
                (Some(n), _) if n < id && n > 0 => Breach::Twice.by(format!("request {n}")),
                (Some(n), _) if n > id && asked.contains(&n) => {
                    Breach::OutOfOrder.by(format!("{n} before {id}"))
                }
                _ => Breach::Unasked.by(format!("{} for {id}", printable(named, 20))),
            }));
        }
        question.read(letter, &mut words).map_err(|why| Some(nonsense(line, why)))
    }

    /// What it did, or that it floods its output: after a line that is no answer comes more without an end.
    fn or_flood(&mut self, what: Misbehaviour, limits: Limits) -> Misbehaviour {
        use Breach::{Nonsense, OutOfOrder, Twice, Unasked};
        if !matches!(what.breach, Nonsense | OutOfOrder | Twice | Unasked) {
            return what;
        }
        let start = Instant::now();
        let mut more = self.pending.len() - self.used;
        while more <= limits::PROGRAM_LINE_BYTES {
            match self.pieces.recv_timeout(SILENCE) {
                Ok(piece) if start.elapsed() < limits.answer => more += piece.len(),
                _ => return what,
            }
        }
        Breach::Floods.by(format!("{more} bytes and more after it {what}"))
    }

    /// What a program did that has sent no line. One that has ended is asked how.
    fn why(&mut self, no_line: NoLine, limit: f64) -> Misbehaviour {
        match no_line {
            NoLine::Ended => ending(self.group.end(LOOK * 50)),
            NoLine::TimeOut => Breach::Hangs.by(format!("no answer within {limit} s")),
            NoLine::TooLong(bytes) => Breach::Floods.by(unended(bytes)),
        }
    }

    /// The next line as a part of `pending`, with its end; not later than `end`.
    fn line(&mut self, end: Instant) -> Result<std::ops::Range<usize>, NoLine> {
        let mut searched = self.used;
        loop {
            if let Some(at) = self.pending[searched..].iter().position(|b| *b == b'\n') {
                let line = self.used..searched + at + 1;
                self.used = line.end;
                return Ok(line);
            }
            searched = self.pending.len();
            if searched - self.used > limits::PROGRAM_LINE_BYTES {
                return Err(NoLine::TooLong(searched - self.used));
            }
            let piece = self.piece(end)?;
            // Lines that were used make room for what comes.
            if self.used > 0 {
                self.pending.drain(..self.used);
                searched -= self.used;
                self.used = 0;
            }
            self.pending.extend_from_slice(&piece);
        }
    }

    /// The next piece of output. A program that has ended is noticed even where something it
    /// started keeps its output open.
    fn piece(&mut self, end: Instant) -> Result<Vec<u8>, NoLine> {
        let mut has_ended = false;
        loop {
            let left = end.saturating_duration_since(Instant::now());
            match self.pieces.recv_timeout(left.min(LOOK)) {
                Ok(piece) => return Ok(piece),
                Err(RecvTimeoutError::Disconnected) => return Err(NoLine::Ended),
                // It ended before the last look, and nothing has come since.
                Err(RecvTimeoutError::Timeout) if has_ended => return Err(NoLine::Ended),
                Err(RecvTimeoutError::Timeout) if left.is_zero() => return Err(NoLine::TimeOut),
                Err(RecvTimeoutError::Timeout) => has_ended = self.group.has_ended(),
            }
        }
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.end(LOOK);
    }
}

/// A line that is no answer, and why.
fn nonsense(line: &[u8], why: &str) -> Misbehaviour {
    match printable(line, 60) {
        said if said.is_empty() => Breach::Nonsense.by("an empty line"),
        said => Breach::Nonsense.by(format!("{said} ({why})")),
    }
}

fn unended(bytes: usize) -> String {
    format!("{bytes} bytes without the end of a line")
}

/// What an ending says; nothing is known of one that closed its output and had to be ended.
fn ending(status: Option<ExitStatus>) -> Misbehaviour {
    let Some(status) = status else {
        return Breach::Exits.by("it closed its output");
    };
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return Breach::Crashes.by(format!("signal {signal}{}", signal_name(signal)));
    }
    match status.code() {
        // What a Rust panic ends with.
        Some(101) => Breach::Crashes.by("status 101, a panic"),
        code => Breach::Exits.by(format!("with status {}", code.unwrap_or(-1))),
    }
}

#[cfg(unix)]
fn signal_name(signal: i32) -> &'static str {
    match signal {
        4 => " (illegal instruction)",
        6 => " (abort)",
        8 => " (division by zero)",
        9 => " (killed)",
        11 => " (segmentation fault)",
        _ => "",
    }
}

/// Does the work of a pipe on a thread of its own, which ends with the pipe.
fn serve(work: impl FnOnce() + Send + 'static) -> Result<(), Misbehaviour> {
    let refused = |error| {
        let why = "no thread can be started for its pipes; allow more processes (ulimit -u)";
        Breach::CannotStart.by(format!("{why}: {error}"))
    };
    std::thread::Builder::new().spawn(work).map(drop).map_err(refused)
}

/// Hears what comes on standard error; what is returned has an end when that has.
fn keep_complaints(
    mut stderr: impl Read + Send + 'static,
    kept: Arc<Mutex<StandardError>>,
) -> Result<Receiver<()>, Misbehaviour> {
    let (open, complains) = mpsc::channel();
    kept.lock().unwrap_or_else(std::sync::PoisonError::into_inner).begin();
    serve(move || {
        let mut piece = [0; 4096];
        while let Ok(n @ 1..) = stderr.read(&mut piece) {
            kept.lock().unwrap_or_else(std::sync::PoisonError::into_inner).hear(&piece[..n]);
        }
        drop(open);
    })?;
    Ok(complains)
}
