//! The judge as a WebAssembly module: what `rasterproof judge` does, without processes.
//!
//! Its standard input begins with options, a line each, and ends them with the line HELLO of the line protocol. Then it holds
//! the answers to the requests on the standard output. The verdict goes to the standard error, and the exit status is the
//! program's. The host is called for every read, so an ordinary Rust program can put its questions to it, without `unsafe`.

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::time::Duration;

use rasterproof_judge::ask::{Answer, Ask, Breach, Question};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::text::Words;
use rasterproof_judge::{Options, family_names, judge, polygons};
use rasterproof_report::{judge_text, text};

/// The program that instantiated the module: it answers requests when the standard input is read.
struct Host {
    declared: Declared,
}

impl Ask for Host {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], _: u64) -> Vec<Answer> {
        let mut requests = Vec::new();
        for (id, question) in (1..).zip(questions) {
            question.write(id, &mut requests);
        }
        let sent = io::stdout().write_all(&requests).and_then(|()| io::stdout().flush());
        let answer = |question: &Question| {
            let line = line().unwrap_or_default();
            let mut words = Words(line.as_bytes());
            let letter = words.word().and_then(<[u8]>::first).copied().unwrap_or_default();
            words.word();
            let read = question.read(letter, &mut words);
            read.unwrap_or_else(|why| Answer::Died(Breach::Nonsense.by(why)))
        };
        match sent {
            Ok(()) => questions.iter().map(answer).collect(),
            Err(error) => vec![Answer::Died(Breach::Exits.by(error.to_string()))],
        }
    }
}

/// The next line of the standard input; nothing at its end.
fn line() -> Option<String> {
    let mut line = String::new();
    io::stdin().read_line(&mut line).ok().filter(|bytes| *bytes > 0)?;
    Some(line.trim_end().to_owned())
}

#[derive(Default)]
struct Job {
    options: Options,
    /// The function of the package and the name of what is judged, as in `assertRasterizer(draw`.
    call: String,
    declare: String,
}

impl Job {
    fn read() -> Result<(Self, Declared), String> {
        let mut job = Self::default();
        while let Some(line) = line() {
            if let Some(mut declared) = Declared::parse(&line) {
                job.declare.split_whitespace().for_each(|word| declared.hear(word));
                return Ok((job, declared));
            }
            let (option, value) = line.split_once(' ').unwrap_or((&line, ""));
            job.hear(option, value).ok_or_else(|| format!("{option} cannot be {value}"))?;
        }
        Err("no line with HELLO was read".to_owned())
    }

    fn hear(&mut self, option: &str, value: &str) -> Option<()> {
        match option {
            "cases" => self.options.cases = value.parse().ok()?,
            "seed" => self.options.seed = value.parse().ok()?,
            "case" => self.options.only = Some(value.parse().ok()?),
            "seconds" => {
                let seconds = Duration::try_from_secs_f64(value.parse().ok()?).ok()?;
                self.options.time_limit = Some(seconds);
            }
            "family" => {
                family_names().into_iter().find(|name| *name == value)?;
                self.options.families.push(value.to_owned());
            }
            "call" => self.call = value.to_owned(),
            "declare" => self.declare = value.to_owned(),
            _ => return None,
        }
        Some(())
    }

    /// The call that judges these cases.
    fn line(&self, cases: &str) -> String {
        let declare = match self.declare.as_str() {
            "" => String::new(),
            words => format!(", declare: '{words}'"),
        };
        format!("{}, {{ {cases}, seed: {}{declare} }})", self.call, self.options.seed)
    }

    fn judge(self, declared: Declared) -> Result<(bool, String), String> {
        let one = |family: &str, index| self.line(&format!("family: '{family}', case: {index}"));
        let families = match self.options.families.as_slice() {
            [] => String::new(),
            names => format!("family: ['{}'], ", names.join("', '")),
        };
        let all = self.line(&format!("{families}cases: {}", self.options.cases));
        let mut host = Host { declared };
        if host.declared.partition {
            let report = polygons::judge(&mut host, &self.options)?;
            let said = judge_text::of_polygons(&host.declared, &report, &all, &one);
            let text = text::text(&said, false, false);
            return Ok((report.sum().wrong == 0, text));
        }
        let scope = Scope::of(&self.options);
        let mut askers: Vec<Box<dyn Ask>> = vec![Box::new(host)];
        let verdict = judge(&mut askers, &self.options, &|asked| recognise(asked, scope), &|_| ());
        if let Some(why) = verdict.judged_nothing(&self.options) {
            return Err(why);
        }
        let text = text::text(&judge_text::report(&verdict, &all, &one, false), false, false);
        Ok((verdict.agrees(), text.replace("--declare '", "declare: '")))
    }
}

fn main() -> ExitCode {
    let judged = Job::read().and_then(|(job, declared)| job.judge(declared));
    let (status, said) = match judged {
        Ok((agrees, text)) => (u8::from(!agrees), text),
        Err(why) => (2, why),
    };
    // Without a place to say it, there is still the status.
    let _ = io::stderr().write_all(said.as_bytes());
    ExitCode::from(status)
}
