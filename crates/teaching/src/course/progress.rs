//! The progress file: one, beside the student's code, to be read and edited by people.

use std::path::{Path, PathBuf};

use rasterproof_host::text::{printable_path, printable_short};
use rasterproof_host::{input, limits};

use super::{STEPS, Step};

pub const FILE: &str = "course.toml";

/// The comment at the top of the file, for people who edit it.
const HEADER: &str = "\
# Progress of `rasterproof course`. Yours to edit; `course check` writes it anew, without your comments.
# build (may be empty) and run: commands as lists of words, run in this folder.
# step: the current one. failures: how often it has failed; each shows one hint more.
";

/// How far a student has come, and how the program is built and run.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    /// What makes the program from its source; may be empty.
    #[serde(default)]
    pub build: Vec<String>,
    /// The words of the command that runs the program.
    pub run: Vec<String>,
    /// The name of the step that `course check` judges next.
    pub step: String,
    /// The names of the steps that were passed, in the order in which they were.
    #[serde(default)]
    pub passed: Vec<String>,
    /// How often the current step failed.
    #[serde(default)]
    pub failures: usize,
}

pub fn path(folder: &Path) -> PathBuf {
    folder.join(FILE)
}

impl Progress {
    /// The progress of somebody who begins.
    #[must_use]
    pub fn new(build: Vec<String>, run: Vec<String>) -> Self {
        let step = STEPS[0].name.clone();
        Self { build, run, step, passed: Vec::new(), failures: 0 }
    }

    /// Reads the progress of a folder; nothing where there is no file.
    ///
    /// # Errors
    /// What is wrong with the file, where, and what to do about it.
    pub fn read(folder: &Path) -> Result<Option<Self>, String> {
        let path = path(folder);
        const REMEDY: &str = "mend it, or delete it and say: rasterproof course start";
        let text = match input::read_text(&path, limits::NOTE_BYTES) {
            Ok(text) => text,
            Err(error) if error.missing => return Ok(None),
            Err(error) => return Err(format!("{error}\n  {REMEDY}")),
        };
        Self::parse(&text).map(Some).map_err(|what| {
            // The error quotes a line of the file, which can be long.
            let lines = what.lines().take(8).map(|line| printable_short(line, 200));
            let what = lines.collect::<Vec<_>>().join("\n");
            format!("{}: {what}\n  {REMEDY}", printable_path(&path))
        })
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// What is wrong with it, with its line.
    pub fn parse(text: &str) -> Result<Self, String> {
        // TOML's errors name the line, so they are passed on as they are.
        let progress: Self = toml::from_str(text).map_err(|e| e.to_string().trim().to_owned())?;
        // A step that was renamed or misspelt is an error, and not a step that was not passed.
        let unknown = |name: &&String| super::find(name).is_none();
        let mut named = std::iter::once(&progress.step).chain(&progress.passed);
        if let Some(name) = named.find(unknown) {
            return Err(format!("no step is called {name:?}; there are {}", super::known()));
        }
        Ok(progress)
    }

    pub fn text(&self) -> String {
        // Strings, lists of them and a number: this cannot fail.
        format!("{HEADER}{}", toml::to_string(self).unwrap_or_default())
    }

    /// The current step; the first one where the name is that of none.
    pub fn current(&self) -> &'static Step {
        super::find(&self.step).unwrap_or(&STEPS[0])
    }

    /// Notes how a step came out. A step that passes makes the next one current that did not.
    pub fn note(&mut self, step: &Step, passes: bool) {
        // Failures are those of one step; to work on another one begins with none.
        if self.step != step.name {
            self.step.clone_from(&step.name);
            self.failures = 0;
        }
        // A step that was passed before is not, once it fails.
        if !passes {
            self.failures += 1;
            self.passed.retain(|name| *name != step.name);
            return;
        }
        if !self.has_passed(step) {
            self.passed.push(step.name.clone());
        }
        self.failures = 0;
        if let Some(next) = STEPS.iter().find(|step| !self.has_passed(step)) {
            next.name.clone_into(&mut self.step);
        }
    }

    #[must_use]
    pub fn has_passed(&self, step: &Step) -> bool {
        self.passed.contains(&step.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_is_written_and_read() {
        let words = |list: &[&str]| list.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>();
        let mut progress = Progress::new(words(&["cc", "a \"b\".c"]), words(&["./it's", "-x"]));
        progress.note(&STEPS[0], true);
        progress.note(&STEPS[1], false);
        progress.note(&STEPS[1], false);
        assert_eq!((progress.step.as_str(), progress.failures), ("dda", 2));
        assert_eq!(Progress::parse(&progress.text()), Ok(progress.clone()));
        progress.note(&STEPS[4], true);
        assert_eq!(progress.passed, ["pixel", "top-left"]);
        assert_eq!((progress.step.as_str(), progress.failures), ("dda", 0));
    }

    #[test]
    fn broken_progress_is_named() {
        for (text, part) in [
            ("run = [\"x\"]\nstep = \"dda", "line 2"),
            ("step = \"dda\"", "run"),
            ("run = []\nstep = \"nowhere\"", "no step is called \"nowhere\""),
            ("run = []\nstep = \"dda\"\npased = []", "pased"),
            ("run = \"./x\"\nstep = \"dda\"", "line 1"),
        ] {
            let error = Progress::parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
