//! The judge of a function in the program that started this one: what `rasterproof judge` does, with the package of another
//! language in the place of a process. `adapters/python` starts the program for it, `adapters/js` a WebAssembly module.
//!
//! The standard input begins with options, a line each, and ends them with the line HELLO of the line protocol. Requests go to
//! the standard output, an empty line ends those that are sent at once, and their answers are read. The verdict goes to the
//! standard error, and the exit status is that of `judge`. A module's host is called for every read, so it needs no `unsafe`.

use std::io::{self, BufRead as _, Write as _};
use std::process::ExitCode;
use std::time::Duration;

use super::html::Report;
use super::{judge_text, text};
use rasterproof_judge::ask::{Answer, Breach, Question, Subject};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::run::case_that_asks;
use rasterproof_judge::text::Words;
use rasterproof_judge::verdict::Scores as _;
use rasterproof_judge::{Options, family_names, judge, polygons};
use rasterproof_verify::judge::ascii;

/// The program that started this one. Several share its streams: while one waits for answers, another judges those that it has.
struct Host(Declared);

impl Subject for Host {
    fn declared(&self) -> &Declared {
        &self.0
    }

    fn ask(&mut self, questions: &[Question], _: u64) -> Vec<Answer> {
        let mut requests = Vec::new();
        for (id, question) in (1..).zip(questions) {
            question.write(id, &mut requests);
        }
        // Who reads all of it before it answers never waits for a pipe that is full.
        requests.push(b'\n');
        // Locked before anything is sent, so that the answers are read by whoever asked.
        let heard = io::stdin().lock();
        let sent = io::stdout().write_all(&requests).and_then(|()| io::stdout().flush());
        let mut lines = heard.lines().map_while(Result::ok).fuse();
        let mut answers = Vec::with_capacity(questions.len());
        for question in questions {
            // A line that is not there is an answer that cannot be read.
            answers.push(answer(question, lines.next().unwrap_or_default().as_bytes()));
        }
        match sent {
            Ok(()) => answers,
            Err(error) => vec![Answer::Died(Breach::Exits.by(error.to_string()))],
        }
    }
}

/// The answer in a line: a letter and a number, which the judge does not need, then what was drawn.
fn answer(question: &Question, line: &[u8]) -> Answer {
    let mut words = Words(line);
    let letter = words.word().and_then(<[u8]>::first).copied().unwrap_or_default();
    words.word();
    let read = question.read(letter, &mut words);
    read.unwrap_or_else(|why| Answer::Died(Breach::Nonsense.by(why)))
}

/// What is to be judged, as the options say it.
#[derive(Default)]
struct Job {
    options: Options,
    /// The function of the package and the name of what is judged, as in `assertRasterizer(draw`.
    call: String,
    /// Whether arguments are written as Python writes them.
    is_python: bool,
    /// Words of a convention, as `HELLO` has them.
    declare: String,
    /// The caller says that numbers of masks are hits.
    hits: bool,
    /// A request for which the function threw: nothing is judged, and its case is looked up.
    locate: String,
}

impl Job {
    /// Reads options up to the line HELLO.
    fn read() -> Result<(Self, Declared), String> {
        // Options come in any order, and the line HELLO ends them.
        let mut job = Self::default();
        for line in io::stdin().lines().map_while(Result::ok) {
            // The line HELLO ends the options.
            let line = line.trim_end();
            if let Some(mut declared) = Declared::parse(line) {
                declared.declare(&job.declare).map_err(|why| format!("declare: {why}"))?;
                return Ok((job, declared));
            }
            // An option is a word, and all that follows a space is its value.
            let (option, value) = line.split_once(' ').unwrap_or((line, ""));
            job.hear(option, value)?;
        }
        Err("no line with HELLO was read".to_owned())
    }

    /// Takes an option of the host; an error says what would have been one.
    fn hear(&mut self, option: &str, value: &str) -> Result<(), String> {
        let is_not = |expected: &str| format!("{option} is {value}; expected {expected}");
        // Whole numbers, from the least that makes sense.
        let number = |least: u64| {
            let number = value.parse().ok().filter(|number| *number >= least);
            number.ok_or_else(|| is_not(&format!("a whole number from {least} to {}", u64::MAX)))
        };
        match option {
            "cases" => self.options.cases = number(1)?,
            "seed" => self.options.seed = number(0)?,
            "case" => self.options.only = Some(number(0)?),
            "seconds" => {
                let seconds = value.parse().ok().map(Duration::try_from_secs_f64);
                let seconds = seconds.and_then(Result::ok).filter(|seconds| !seconds.is_zero());
                self.options.time_limit = Some(seconds.ok_or_else(|| is_not("a number above 0"))?);
            }
            "family" if family_names().contains(&value) => {
                self.options.families.push(value.to_owned());
            }
            "family" => {
                let names = family_names().join(", ");
                return Err(format!("no family is {value}; expected {names}"));
            }
            "language" => {
                self.is_python = value == "python";
                self.options.terms.time_limit_is =
                    ["seconds: ", "seconds="][usize::from(self.is_python)];
            }
            "call" => self.call = value.to_owned(),
            "declare" => self.declare = value.to_owned(),
            "hits" => self.hits = true,
            "locate" => self.locate = value.to_owned(),
            _ => {
                let known = "cases, seed, case, seconds, family, declare or hits";
                return Err(format!("no option is {option}; expected {known}"));
            }
        }
        Ok(())
    }

    /// What stands between the name of an argument and its value.
    fn is(&self) -> &'static str {
        if self.is_python { "=" } else { ": " }
    }

    /// The call that judges these cases.
    fn line(&self, cases: &[(&str, String)]) -> String {
        let mut all = cases.to_vec();
        all.push(("seed", self.options.seed.to_string()));
        if !self.declare.is_empty() {
            all.push(("declare", format!("'{}'", self.declare)));
        }
        if self.hits {
            all.push(("hits", if self.is_python { "True" } else { "true" }.to_owned()));
        }
        let mut arguments = Vec::new();
        for (name, value) in all {
            arguments.push(format!("{name}{}{value}", self.is()));
        }
        // JavaScript has the options in an object, and Python has them by name.
        let [open, close] = if self.is_python { ["", ""] } else { ["{ ", " }"] };
        format!("{}, {open}{}{close})", self.call, arguments.join(", "))
    }

    /// Whether all is right, and the report; an error where nothing could be judged.
    fn judge(self, declared: Declared) -> Result<(bool, String), String> {
        let one = |family: &str, index: u64| {
            self.line(&[("family", format!("'{family}'")), ("case", index.to_string())])
        };
        // The call that judges everything again, and the one for a single case.
        let mut all = vec![("cases", self.options.cases.to_string())];
        if !self.options.families.is_empty() {
            let names = self.options.families.join("', '");
            all.insert(0, ("family", format!("['{names}']")));
        }
        let all = self.line(&all);
        if !self.locate.is_empty() {
            let find =
                if declared.partition { polygons::polygon_that_asks } else { case_that_asks };
            let found = find(&self.locate, &self.options, &declared);
            let seed = self.options.seed;
            let said = match found {
                Some((family, index)) => format!(
                    "family {family}, case {index}, seed {seed}\nrepeat with: {}",
                    one(family, index)
                ),
                None => format!(
                    "a request of the judge that is no generated case; seed {seed}\nrepeat with: {all}"
                ),
            };
            return Ok((true, said));
        }
        if declared.partition {
            // A tessellator is judged by areas, and its verdict is written in another way.
            let report = polygons::judge(&mut Host(declared.clone()), &self.options)?;
            let said = judge_text::of_polygons(&declared, &report, &all, &one);
            return Ok((report.sum().wrong == 0, cause_first(&said)));
        }
        // Pictures of triangles and lines are judged as programs are.
        let scope = Scope::of(&self.options);
        // A module has one thread.
        let hosts = if cfg!(target_family = "wasm") { 1 } else { 2 };
        let mut askers: Vec<Box<dyn Subject>> = Vec::new();
        for _ in 0..hosts {
            askers.push(Box::new(Host(declared.clone())));
        }
        let verdict = judge(&mut askers, &self.options, &|asked| recognise(asked, scope), &|_| ());
        if let Some(why) = verdict.judged_nothing() {
            return Err(why);
        }
        let report = judge_text::report(&verdict, &all, &one, false);
        let text = cause_first(&report);
        Ok((verdict.agrees(), text.replace("--declare '", &format!("declare{}'", self.is()))))
    }
}

/// The report below a line that says what is wrong: test runners show the first line of a message, and often its start alone.
fn cause_first(report: &Report) -> String {
    let whole = text::text(report, false, false, text::WIDTH);
    match &report.outcome {
        Some(outcome) if !outcome.good => {
            // The cause, or what was counted where none is known.
            let why = outcome.answer.split_once(" is not right").map_or("", |(_, why)| why);
            let why = why.trim_start_matches([':', '.', ' ']);
            let first = if why.is_empty() { &outcome.sentence } else { why };
            format!("{}\n{whole}", ascii::lines(first, text::SCREEN, ascii::columns).join("\n"))
        }
        _ => whole,
    }
}

/// Judges once, and ends with the status of `judge`.
pub fn main() -> ExitCode {
    let judged = Job::read().and_then(|(job, declared)| job.judge(declared));
    let (status, said) = match judged {
        Ok((agrees, text)) => (u8::from(!agrees), text),
        Err(why) => (2, why),
    };
    // Without a place to say it, there is still the status.
    let _ = io::stderr().write_all(said.as_bytes());
    ExitCode::from(status)
}
