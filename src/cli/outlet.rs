//! The way of text from a command to standard output or standard error: long lines are broken at spaces, what would change
//! a terminal is written as escapes, and it is noted whether all of it arrived.
//!
//! The exit status is the verdict of the command. It does not depend on whether somebody read the
//! output: where standard output fails, the command goes on without it. A verdict that agrees becomes
//! an error where something was lost that the user should have (a full disk, a file that cannot be
//! written), since a script would believe otherwise that it is there. A failing verdict stays one.
//!
//! Names and contents of files are made printable where they enter a message. The escapes catch what was
//! forgotten there, in all output of all commands.

use std::cell::Cell;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::rc::Rc;

use rasterproof_host::output::{self, Output, Over, STANDARD_OUTPUT};
use rasterproof_host::text::{escaped, printable_lines};
use textwrap::core::display_width;
use textwrap::{Options, WordSplitter, fill};

use super::{Streams, exit};

/// Columns where there is no terminal.
pub const USUAL: usize = 100;
/// On narrower terminals most words would stand alone.
const LEAST: usize = 20;

/// Whether all that a command wrote was delivered.
#[derive(Clone, Debug, Default)]
pub struct Delivery(Rc<Cell<Loss>>);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
enum Loss {
    #[default]
    Nothing,
    /// The reader has seen enough, as in `rasterproof list | head`.
    Unread,
    Failed,
}

impl Delivery {
    /// The worst that happened stays.
    fn note(&self, loss: Loss) {
        self.0.set(self.0.get().max(loss));
    }

    /// Whether everything was delivered so far; what is still buffered is not known.
    pub(super) fn is_whole(&self) -> bool {
        self.0.get() == Loss::Nothing
    }

    /// The exit status of a verdict: one that agrees does not count where something of it was lost.
    pub(super) fn status(&self, verdict: u8) -> u8 {
        let is_lost = self.0.get() == Loss::Failed;
        if is_lost && verdict == exit::AGREES { exit::USAGE } else { verdict }
    }
}

/// How characters are written that would change what a terminal shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Escape {
    /// As `\u{1b}`, for people.
    Words,
    /// The same, but sequences that set a colour are kept, as this program writes them to a terminal.
    WordsAndColours,
    /// As `\u001b`, which JSON reads as the same character.
    Json,
}

/// Passes lines on.
pub(super) struct Outlet<'a> {
    inner: &'a mut dyn Write,
    escape: Escape,
    /// Lines of more columns are broken, but for those with `command` or a command of cargo: they stay whole, to be copied.
    columns: usize,
    command: Option<String>,
    /// A line that has not ended.
    begun: Vec<u8>,
    /// What is noted where that fails; in a conversation nothing, since it ends then.
    delivery: Option<Delivery>,
    /// Why nothing is passed on any more.
    failure: Option<io::Error>,
    /// Whether something was passed on, or it does not matter to which file.
    is_begun: bool,
}

impl<'a> Outlet<'a> {
    /// One that neither breaks lines nor notes what is lost.
    pub(super) fn new(inner: &'a mut dyn Write, escape: Escape) -> Self {
        Self {
            inner,
            escape,
            columns: usize::MAX,
            command: None,
            begun: Vec::new(),
            delivery: None,
            failure: None,
            is_begun: true,
        }
    }

    /// It with lines of at most so many columns, but for those that hold this command.
    pub(super) fn folded(self, columns: usize, command: Option<String>) -> Self {
        Self { columns: columns.max(LEAST), command, ..self }
    }

    /// It with what becomes of text that is not delivered: the rest is accepted and lost.
    pub(super) fn noted(self, delivery: &Delivery) -> Self {
        Self { delivery: Some(delivery.clone()), ..self }
    }

    /// It as standard output, which must not go to a file that the command reads, as in `verify m.obj >> m.obj`.
    pub(super) fn checked(self) -> Self {
        Self { is_begun: false, ..self }
    }

    /// Why something was lost, unless the reader had enough.
    pub(super) fn lost(&self) -> Option<&io::Error> {
        self.failure.as_ref().filter(|error| error.kind() != ErrorKind::BrokenPipe)
    }

    /// Passes bytes on, after a look at where the first of them go.
    fn pass(&mut self, bytes: &[u8]) -> io::Result<()> {
        if !self.is_begun {
            output::check(Path::new(STANDARD_OUTPUT), Over::Any).map_err(io::Error::other)?;
            self.is_begun = true;
        }
        self.inner.write_all(bytes)
    }

    /// Passes on what was begun, but for the first bytes of a character that has not ended.
    fn end_line(&mut self) -> io::Result<()> {
        let whole = match std::str::from_utf8(&self.begun) {
            Err(error) if error.error_len().is_none() => error.valid_up_to(),
            _ => self.begun.len(),
        };
        let rest = self.begun.split_off(whole);
        let line = std::mem::replace(&mut self.begun, rest);
        let text = String::from_utf8_lossy(&line);
        let has_command = self.command.as_ref().is_some_and(|command| text.contains(command));
        match has_command || text.contains(" cargo ") {
            true => self.escaped(&text),
            false => self.escaped(&fold(&text, self.columns)),
        }
    }

    /// Passes text on without hidden characters, but for ends of lines and tabs.
    fn escaped(&mut self, text: &str) -> io::Result<()> {
        match self.escape {
            Escape::Words => self.pass(printable_lines(text).as_bytes()),
            Escape::Json => self.pass(escaped(text, "\n\t", in_json).as_bytes()),
            Escape::WordsAndColours => {
                let mut parts = text.split('\u{1b}');
                self.pass(printable_lines(parts.next().unwrap_or_default()).as_bytes())?;
                for part in parts {
                    let (colour, rest) = part.split_at(colour_length(part));
                    let sign = if colour.is_empty() { "\\u{1b}" } else { "\u{1b}" };
                    for text in [sign, colour, &printable_lines(rest)] {
                        self.pass(text.as_bytes())?;
                    }
                }
                Ok(())
            }
        }
    }

    /// Writes until that fails for the first time, and accepts the rest where it is noted.
    fn until_failure(&mut self, write: impl FnOnce(&mut Self) -> io::Result<()>) -> io::Result<()> {
        if self.failure.is_some() {
            self.begun.clear();
            return Ok(());
        }
        let Err(error) = write(self) else { return Ok(()) };
        let Some(delivery) = &self.delivery else { return Err(error) };
        let is_closed = error.kind() == ErrorKind::BrokenPipe;
        delivery.note(if is_closed { Loss::Unread } else { Loss::Failed });
        self.failure = Some(error);
        Ok(())
    }
}

impl Write for Outlet<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for piece in bytes.split_inclusive(|&byte| byte == b'\n') {
            self.begun.extend_from_slice(piece);
            if piece.ends_with(b"\n") {
                self.until_failure(Self::end_line)?;
            }
        }
        Ok(bytes.len())
    }

    /// What has not ended is passed on as it is: a question waits there.
    fn flush(&mut self) -> io::Result<()> {
        self.until_failure(|outlet| {
            if !outlet.begun.is_empty() {
                outlet.end_line()?;
            }
            outlet.inner.flush()
        })
    }
}

/// Bytes of the sequence that sets a colour at the beginning of what follows its first sign, or none.
fn colour_length(text: &str) -> usize {
    let Some(inside) = text.strip_prefix('[') else { return 0 };
    let digits = inside.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';');
    if digits.starts_with('m') { text.len() - digits.len() + 1 } else { 0 }
}

/// A character as JSON escapes it: four digits for each of its one or two units of UTF-16.
fn in_json(character: char) -> String {
    character.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect()
}

/// Where the cell begins that may be broken: behind the first gap of two blanks, or in a row of a table
/// behind the last; nothing where that row does not end in words.
fn last_cell(text: &str) -> Option<usize> {
    let after = |gap: usize| gap + text[gap..].len() - text[gap..].trim_start().len();
    let Some(first) = text.find("  ").map(after) else { return Some(0) };
    if !text[first..].contains("   ") {
        return Some(first);
    }
    text.rfind("  ").map(after).filter(|&last| text[last..].contains(' '))
}

/// A line, broken where it is too long; what follows begins below its last cell, or two columns further
/// in than the line. A row of a table that does not end in words stays whole.
fn fold(line: &str, columns: usize) -> String {
    let text = line.trim_end();
    if display_width(text) <= columns {
        return line.to_owned();
    }
    let indent = text.len() - text.trim_start().len();
    let Some(cell) = last_cell(&text[indent..]) else { return line.to_owned() };
    let (head, words) = text.split_at(indent + cell);
    let below = display_width(head);
    let hang = " ".repeat(if cell > 0 && below <= columns * 2 / 3 { below } else { indent + 2 });
    // A cell of several words may begin in the next line.
    let first = words.split_once(' ').filter(|_| cell > 0);
    let is_moved = first.is_some_and(|(first, _)| below + display_width(first) > columns);
    let (out, begin) =
        if is_moved { (format!("{}\n", head.trim_end()), &*hang) } else { (String::new(), head) };
    let options = Options::new(columns)
        .initial_indent(begin)
        .subsequent_indent(&hang)
        .break_words(false)
        .word_splitter(WordSplitter::NoHyphenation);
    let end = if line.ends_with('\n') { "\n" } else { "" };
    out + &fill(words, options) + end
}

impl Streams<'_> {
    /// Writes a file. Where that fails, the reason is printed, the command can go on, and its exit
    /// status says at the end that something is missing. Returns whether the file was written.
    pub(super) fn save(&mut self, output: &Output, bytes: &[u8]) -> bool {
        match output::write(&output.path, bytes, output.over) {
            Ok(()) => true,
            Err(error) => {
                self.lose(&error);
                false
            }
        }
    }

    /// Says that something was lost which the user should have.
    pub(super) fn lose(&mut self, what: &dyn Display) {
        // Both may go to one terminal: what was computed comes first.
        let _ = self.output.flush();
        let _ = writeln!(self.errors, "error: {}", printable_lines(&what.to_string()));
        self.delivery.note(Loss::Failed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_host::text::is_hidden;

    struct Failing(ErrorKind);

    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_verdict_does_not_depend_on_its_reader() {
        for (kind, agrees) in
            [(ErrorKind::BrokenPipe, exit::AGREES), (ErrorKind::StorageFull, exit::USAGE)]
        {
            let (mut inner, delivery) = (Failing(kind), Delivery::default());
            let mut output = Outlet::new(&mut inner, Escape::Words).noted(&delivery);
            assert!(delivery.is_whole());
            output.write_all(b"AGREES\n").unwrap();
            assert!(!delivery.is_whole());
            output.write_all(b"more\n").unwrap();
            assert_eq!(output.lost().is_some(), agrees == exit::USAGE);
            assert_eq!(delivery.status(exit::AGREES), agrees);
            assert_eq!(delivery.status(exit::DISAGREES), exit::DISAGREES);
            // A conversation ends.
            let error = Outlet::new(&mut Failing(kind), Escape::Words).write_all(b"OK\n");
            assert_eq!(error.unwrap_err().kind(), kind);
        }
    }

    #[test]
    fn hidden_characters_do_not_pass() {
        let escaped = |escape: Escape, text: &str| {
            let mut out = Vec::new();
            let mut outlet = Outlet::new(&mut out, escape);
            // In pieces that end within characters, which are put together again.
            for piece in
                text.as_bytes().chunks(if escape == Escape::WordsAndColours { 99 } else { 1 })
            {
                outlet.write_all(piece).unwrap();
            }
            outlet.flush().unwrap();
            String::from_utf8(out).unwrap()
        };
        let text = "a\tb\u{4e2d}\n\u{1b}[31mred\u{1b}]0;t\u{7}\u{202e}x\u{9b}\u{e0001}";
        assert_eq!(
            escaped(Escape::Words, text),
            "a\tb\u{4e2d}\n\\u{1b}[31mred\\u{1b}]0;t\\u{7}\\u{202e}x\\u{9b}\\u{e0001}"
        );
        assert_eq!(
            escaped(Escape::WordsAndColours, text),
            "a\tb\u{4e2d}\n\u{1b}[31mred\\u{1b}]0;t\\u{7}\\u{202e}x\\u{9b}\\u{e0001}"
        );
        let json = escaped(Escape::Json, &format!("\"{}\"", text.replace(['\n', '\t'], "")));
        assert!(!json.chars().any(is_hidden), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text.replace(['\n', '\t'], ""));
    }

    #[test]
    fn long_lines_are_broken() {
        let line = "AGREES: one two three four five six seven eight\n";
        assert_eq!(fold(line, 40), "AGREES: one two three four five six\n  seven eight\n");
        assert_eq!(fold("  name   what it is about and more of that\n", 24), {
            "  name   what it is\n         about and more\n         of that\n"
        });
        assert_eq!(fold("C 1 2  3 4 5  6 7 8", 12), "C 1 2  3 4 5\n       6 7 8");
        assert_eq!(fold("      --cases <N>      Cases of each family\n", 20), {
            "      --cases <N>\n        Cases of\n        each family\n"
        });
        assert_eq!(fold("error: cube.txt is no model; name one\n", 20), {
            "error: cube.txt is\n  no model; name one\n"
        });
        assert_eq!(fold("a   0   1   one two three four", 24), {
            "a   0   1   one two\n            three four"
        });
        let coloured = "\x1b[32mone\x1b[0m two\n";
        for whole in ["a b c\n", "one   20   30   400\n", "##...   ##...\n", coloured] {
            assert_eq!(fold(whole, 12), whole);
        }
    }

    #[test]
    fn commands_and_beginnings_stay_whole() {
        let mut out = Vec::new();
        let outlet = Outlet::new(&mut out, Escape::Words);
        let mut folded = outlet.folded(0, Some("cargo run".to_owned()));
        write!(folded, "repeat with: cargo run --release -- verify --seed 1").unwrap();
        writeln!(folded, " --cases 2000").unwrap();
        write!(folded, "? ").unwrap();
        folded.flush().unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text.lines().count(), 2, "{text}");
        assert_eq!(text.lines().last(), Some("? "));
    }
}
