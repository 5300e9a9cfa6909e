//! `rasterproof judge --watch`: a program is judged again whenever its file changes, first by the cases that failed.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use rasterproof_host::text::printable_path;
use rasterproof_host::{input, limits};
use rasterproof_judge::ask::{Answer, Complaints, Misbehaviour, Question, Subject};
use rasterproof_judge::changes::JudgementRecord;
use rasterproof_judge::declared::Declared;

use super::{InputError, Status, Streams, exit, usage};

/// How often the files are looked at.
const LOOK: Duration = Duration::from_millis(100);
/// Questions between two looks at the files while a program answers.
const AT_ONCE: usize = 64;

/// When a file was written and how long it is; nothing where there is none.
type State = Option<(SystemTime, u64)>;

/// The files of a command, as they were when they were looked at.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Files {
    paths: Vec<PathBuf>,
    states: Vec<State>,
}

impl Files {
    /// The program, where it is named by a path, and every argument: those that name no file now may name one later.
    fn of(command: &[String]) -> Self {
        let is_path =
            |(at, word): &(usize, &String)| *at > 0 || Path::new(word).components().count() > 1;
        let paths =
            command.iter().enumerate().filter(is_path).map(|(_, word)| word.into()).collect();
        Self { paths, states: Vec::new() }.looked_at()
    }

    /// The same files as they are now.
    fn looked_at(&self) -> Self {
        let state = |path: &PathBuf| {
            let data = path.metadata().ok().filter(|data| data.is_file())?;
            Some((data.modified().ok()?, data.len()))
        };
        Self { paths: self.paths.clone(), states: self.paths.iter().map(state).collect() }
    }

    /// Whether one of them was written, made or removed since.
    pub fn have_changed(&self) -> bool {
        *self != self.looked_at()
    }

    /// What is in the files, as a number.
    fn content(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        for (path, state) in self.paths.iter().zip(&self.states) {
            // What cannot be read is known by its time and length.
            match state.map(|_| input::read(path, limits::DOCUMENT_BYTES)) {
                Some(Ok(bytes)) => bytes.hash(&mut hasher),
                _ => state.hash(&mut hasher),
            }
        }
        hasher.finish()
    }

    /// Waits until the content of a file has changed and nothing is written any more; the names of those that were written. A file
    /// that is gone is waited for: whoever builds a program removes it first.
    fn wait(&mut self, content: &mut u64, streams: &mut Streams<'_>) -> Result<String, InputError> {
        let mut is_said = false;
        loop {
            std::thread::sleep(LOOK);
            // A program may be written in several steps; a change is one when nothing has changed for a while.
            let now = self.looked_at();
            if now == *self {
                continue;
            }
            let gone = self.names(&now, |before, now| before.is_some() && now.is_none());
            if !gone.is_empty() {
                if !is_said {
                    writeln!(streams.output, "\n{gone} is gone, and is waited for")?;
                    streams.output.flush()?;
                    is_said = true;
                }
                continue;
            }
            std::thread::sleep(LOOK);
            if now.have_changed() {
                continue;
            }
            let changed = self.names(&now, |before, now| before != now);
            *self = now;
            let is = self.content();
            if is != *content {
                *content = is;
                return Ok(changed);
            }
        }
    }

    /// The files of which something is true before and now.
    fn names(&self, now: &Self, holds: fn(State, State) -> bool) -> String {
        let states = self.states.iter().zip(&now.states);
        let all = self.paths.iter().zip(states).filter(|(_, (before, now))| holds(**before, **now));
        let names: Vec<String> = all.map(|(path, _)| printable_path(path).to_string()).collect();
        names.join(", ")
    }

    /// The names of all files that are there.
    fn names_of_all(&self) -> String {
        self.names(self, |state, _| state.is_some())
    }
}

/// A program that is not asked any more once a file has changed.
struct UntilChanged {
    asked: Box<dyn Subject>,
    files: Arc<Files>,
}

/// The same program, which is not asked any more once a file has changed.
pub(super) fn until_changed(asked: Box<dyn Subject>, files: &Arc<Files>) -> Box<dyn Subject> {
    Box::new(UntilChanged { asked, files: Arc::clone(files) })
}

impl Subject for UntilChanged {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        // A block of questions is answered within milliseconds, so a change is noticed soon enough.
        for some in questions.chunks(AT_ONCE) {
            if deaths >= most_deaths || self.files.have_changed() {
                break;
            }
            let answered = self.asked.ask(some, most_deaths - deaths);
            deaths += answered.iter().filter(|answer| answer.is_death()).count() as u64;
            let is_whole = answered.len() == some.len();
            answers.extend(answered);
            if !is_whole {
                break;
            }
        }
        answers
    }

    fn end_at(&mut self, end: Option<Instant>) {
        self.asked.end_at(end);
    }

    fn cases_at_once(&self) -> u64 {
        self.asked.cases_at_once()
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        self.asked.strays()
    }

    fn finish(&mut self) -> Vec<Misbehaviour> {
        self.asked.finish()
    }

    fn complaints(&self) -> Complaints {
        self.asked.complaints()
    }
}

/// Judges a program as it is now, after a judgement before; nothing comes of it where a file changes meanwhile.
pub(super) type Round<'a> = dyn FnMut(
        Option<&JudgementRecord>,
        &Arc<Files>,
        &mut Streams<'_>,
    ) -> Result<Option<JudgementRecord>, InputError>
    + 'a;

/// Judges a command now, and again whenever one of its files has changed.
pub(super) fn run(command: &[String], round: &mut Round<'_>, streams: &mut Streams<'_>) -> Status {
    let mut files = Files::of(command);
    if files.names_of_all().is_empty() {
        return Err(usage(
            "--watch: no word of the command names a file that could change; name the program by its path, as ./mine",
        ));
    }
    // A file that is written again with the same content has not changed.
    let mut content = files.content();
    let mut before = None;
    // Ctrl-C ends it, and so does a reader that has seen enough.
    while streams.delivery.is_whole() {
        match round(before.as_ref(), &Arc::new(files.clone()), streams) {
            Ok(Some(record)) => before = Some(record),
            Ok(None) => {}
            // It is mended by and by.
            Err(why) => writeln!(streams.output, "It cannot be judged: {why}")?,
        }
        if !files.have_changed() {
            writeln!(streams.output, "\nwatching {}; Ctrl-C ends this", files.names_of_all())?;
        }
        streams.output.flush()?;
        let changed = files.wait(&mut content, streams)?;
        writeln!(streams.output, "\n{changed} has changed")?;
        streams.output.flush()?;
    }
    Ok(exit::AGREES)
}
