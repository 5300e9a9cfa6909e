//! A command line that was parsed, turned back into a command that can be copied.
//!
//! It is made from what the parser matched, option by option, and not from the fields of a command's
//! arguments. So an option that is added later is part of it without another line of code.

use std::ffi::{OsStr, OsString};

use clap::ArgMatches;
use clap::parser::ValueSource;
use rasterproof_host::shell;

use super::program;

/// A subcommand with the options that were given for it; options with default values are left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typed {
    name: String,
    positional: Vec<OsString>,
    /// Each by its long name without `--`, with the values of each time that it was given.
    options: Vec<(String, Vec<OsString>)>,
    /// Words after `--`, where the command takes some.
    after: Vec<OsString>,
}

impl Typed {
    /// What was matched; `verify` where no subcommand was named.
    pub fn of(command: &clap::Command, matches: &ArgMatches) -> Self {
        let (mut name, mut command, mut matches) = ("verify", command, matches);
        if let Some((word, inner)) = matches.subcommand() {
            name = word;
            if let Some(found) = command.find_subcommand(word) {
                (command, matches) = (found, inner);
            }
        }
        let mut typed = Self { name: name.to_owned(), ..Self::default() };
        for arg in command.get_arguments() {
            let id = arg.get_id().as_str();
            // The parser knows a source of some ids alone, and panics about others.
            let is_known = matches.ids().any(|known| known == id);
            if !is_known || matches.value_source(id) != Some(ValueSource::CommandLine) {
                continue;
            }
            for values in matches.get_raw_occurrences(id).into_iter().flatten() {
                typed.add(arg, values.map(OsStr::to_owned).collect());
            }
        }
        typed
    }

    /// Notes that an argument was given once more, with these values.
    fn add(&mut self, arg: &clap::Arg, values: Vec<OsString>) {
        match arg.get_long() {
            Some(long) if arg.get_action().takes_values() => {
                self.options.push((long.to_owned(), values));
            }
            // A switch, whose value is the parser's.
            Some(long) => self.options.push((long.to_owned(), Vec::new())),
            None if arg.is_last_set() => self.after.extend(values),
            None => {
                for word in values {
                    // A space was put before a coordinate such as -1,2 for the parser.
                    let own = word.to_str().map(|text| OsString::from(text.trim_start()));
                    self.positional.push(own.unwrap_or(word));
                }
            }
        }
    }

    /// The same with this value of an option, at the place where the option was given, or at the end.
    pub fn set(self, option: &str, value: impl ToString) -> Self {
        let at = self.options.iter().position(|(name, _)| name == option);
        self.insert(at.unwrap_or(usize::MAX), option, value)
    }

    /// The same with this value of an option, before all others, so that it is seen.
    pub fn first(self, option: &str, value: impl ToString) -> Self {
        self.insert(0, option, value)
    }

    /// The same with one value of an option, wherever else the option was.
    fn insert(self, at: usize, option: &str, value: impl ToString) -> Self {
        let mut typed = self.without(&[option]);
        let at = at.min(typed.options.len());
        typed.options.insert(at, (option.to_owned(), vec![value.to_string().into()]));
        typed
    }

    /// The same without some options, whatever their values.
    pub fn without(mut self, options: &[&str]) -> Self {
        self.options.retain(|(name, _)| !options.contains(&name.as_str()));
        self
    }

    /// The same without what only decides where results go and how they are shown.
    pub fn without_output(self) -> Self {
        self.without(&[
            "report",
            "out",
            "force",
            "output",
            "json",
            "table",
            "format",
            "junit",
            "write-test",
        ])
    }

    /// Another command about `word`, with the options that it has in common with this one.
    pub fn as_command(&self, name: &str, word: impl Into<OsString>, options: &[String]) -> Self {
        let mut other = self.clone();
        other.name = name.to_owned();
        other.positional = vec![word.into()];
        other.options.retain(|(name, _)| options.contains(name));
        other
    }

    /// The first of some options that was given.
    pub fn given<'a, S: AsRef<str>>(&self, options: &'a [S]) -> Option<&'a str> {
        let is_given = |option: &&str| self.options.iter().any(|(name, _)| name == option);
        options.iter().map(AsRef::as_ref).find(is_given)
    }

    /// The words of the command, from which the parser makes the same arguments again.
    pub fn words(&self) -> Vec<OsString> {
        let mut words = vec![OsString::from(&self.name)];
        // From the first that would be taken for an option, they come last, in their order.
        let first = self.positional.iter().position(|word| is_like_option(word));
        let (plain, rest) = self.positional.split_at(first.unwrap_or(self.positional.len()));
        words.extend_from_slice(plain);
        for (name, values) in &self.options {
            match values.as_slice() {
                // Taken for an option otherwise.
                [value] if value.as_encoded_bytes().starts_with(b"-") => {
                    let mut word = OsString::from(format!("--{name}="));
                    word.push(value);
                    words.push(word);
                }
                values => {
                    words.push(format!("--{name}").into());
                    words.extend(values.iter().cloned());
                }
            }
        }
        if !rest.is_empty() || !self.after.is_empty() {
            words.push("--".into());
        }
        words.extend(rest.iter().chain(&self.after).cloned());
        words
    }

    /// The command, quoted for a shell.
    pub fn line(&self) -> String {
        format!("{} {}", program(), shell::line(self.words()))
    }
}

/// Whether the parser takes a word for an option: a coordinate such as -1,2 gets a space before it, and is none.
fn is_like_option(word: &OsStr) -> bool {
    word.as_encoded_bytes().starts_with(b"-") && !word.to_str().is_some_and(super::is_coordinate)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use std::ffi::OsString;

    use super::super::{Arguments, parse};

    /// What the parser makes of words, as text, and the words that it is turned back into.
    fn parsed(words: &[String]) -> Option<(String, Vec<String>)> {
        let all = std::iter::once("rasterproof".to_owned()).chain(words.iter().cloned());
        let (arguments, typed) = parse(all.map(Into::into).collect()).ok()?;
        let text = |word: OsString| word.into_string().unwrap();
        Some((format!("{arguments:?}"), typed.words().into_iter().map(text).collect()))
    }

    /// Parsing a command that was made from options gives the same options.
    fn check(words: &[String]) {
        let (arguments, again) = parsed(words).unwrap_or_else(|| panic!("{words:?}"));
        // `verify` may be left out, and then the same options are at another place.
        let (parsed_again, same) = parsed(&again).unwrap_or_else(|| panic!("{words:?}: {again:?}"));
        assert_eq!(arguments, parsed_again, "{words:?}: {again:?}");
        assert_eq!(again, same);
    }

    /// Words that some option takes; each option is given the first that its parser accepts.
    const VALUES: &str =
        "a_b'$(x)\u{1b}.png -7.5 7 3 1/4 64x48 -3,3 vulkan:0 +clip x T2 512 0.5,32 0.5 2,9 depth";

    /// The words that give an option, in all forms that its parser accepts.
    fn forms(arg: &clap::Arg) -> Vec<Vec<String>> {
        let Some(long) = arg.get_long() else { return Vec::new() };
        if !arg.get_action().takes_values() {
            return vec![vec![format!("--{long}")]];
        }
        let possible = arg.get_possible_values();
        let names = possible.iter().map(|value| value.get_name().to_owned());
        let values = names.chain(VALUES.split(' ').map(|value| value.replace('_', " ")));
        let mut forms: Vec<_> = values.map(|value| vec![format!("--{long}={value}")]).collect();
        if matches!(arg.get_action(), clap::ArgAction::Append) {
            forms.extend(forms.clone().into_iter().map(|form| [form.clone(), form].concat()));
        }
        forms
    }

    /// Every option of every command that writes a page, alone and together with all that it agrees
    /// with. The options are enumerated by the parser, so that none can be forgotten.
    #[test]
    #[ignore = "takes seconds; .ci/run runs it"]
    fn options_survive_the_way_to_a_command_and_back() {
        let mut command = Arguments::command();
        command.build();
        let has_page = |c: &&clap::Command| c.get_arguments().any(|a| a.get_long() == Some("out"));
        let pages: Vec<_> = command.get_subcommands().filter(has_page).collect();
        assert!(pages.len() >= 8, "{}", pages.len());
        for subcommand in pages {
            let name = subcommand.get_name().to_owned();
            // Words without which nothing is parsed.
            let required: [&[&str]; 5] =
                [&[], &["T2"], &["cube"], &["--", "./a b", "-x", "it's"], &["-1,2", "-x.obj"]];
            let words = required.map(|more| std::iter::once(&*name).chain(more.iter().copied()));
            let words = words.map(|words| words.map(str::to_owned).collect());
            let mut bases: Vec<Vec<String>> = words.into();
            bases.retain(|words| parsed(words).is_some());
            let with = |words: &[String], form: &[String]| {
                let at = words.iter().position(|word| word == "--").unwrap_or(words.len());
                [&words[..at], form, &words[at..]].concat()
            };
            bases.iter().for_each(|base| check(base));
            let mut together: Vec<Vec<String>> = bases.clone();
            for arg in subcommand.get_arguments() {
                let mut accepted = matches!(arg.get_long(), None | Some("help" | "version"));
                for form in forms(arg) {
                    // Some options take the place of the words that are required otherwise.
                    let alone = vec![name.clone()];
                    for base in bases.iter().chain([&alone]) {
                        let words = with(base, &form);
                        if parsed(&words).is_some() {
                            check(&words);
                            accepted = true;
                        }
                    }
                    for all in &mut together {
                        let more = with(all, &form);
                        if parsed(&more).is_some() {
                            // Some options require another one.
                            accepted = true;
                            *all = more;
                        }
                    }
                }
                assert!(accepted, "{name}: no value in this test is accepted by {arg:?}");
            }
            for all in &together {
                assert!(all.len() > 2, "{all:?}");
                check(all);
            }
        }
    }
}
