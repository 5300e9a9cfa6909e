//! Breaks long lines of what people read, at spaces, to the width of the terminal.

use std::io::{self, Write};

use textwrap::core::display_width;
use textwrap::{Options, WordSplitter, fill};

/// Where there is no terminal.
pub const USUAL: usize = 100;
/// On narrower terminals most words would stand alone.
const LEAST: usize = 20;

/// For text whose commands may be broken, too: no line contains this.
pub const NO_COMMAND: &str = "\0";

/// Passes lines on, those that are too long in pieces. A command stays whole, to be copied, and so does
/// a row of a table that does not end in words.
pub struct Folded<'a> {
    inner: &'a mut dyn Write,
    columns: usize,
    /// What is not to be broken.
    command: String,
    /// A line that has not ended.
    begun: Vec<u8>,
}

impl<'a> Folded<'a> {
    /// Lines of at most so many columns, but for those that hold `command` or a command of cargo.
    pub fn new(inner: &'a mut dyn Write, columns: usize, command: String) -> Self {
        Self { inner, columns: columns.max(LEAST), command, begun: Vec::new() }
    }

    fn end_line(&mut self) -> io::Result<()> {
        let line = std::mem::take(&mut self.begun);
        match std::str::from_utf8(&line) {
            Ok(text) if !text.contains(&self.command) && !text.contains(" cargo ") => {
                self.inner.write_all(fold(text, self.columns).as_bytes())
            }
            _ => self.inner.write_all(&line),
        }
    }
}

impl Write for Folded<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for piece in bytes.split_inclusive(|&byte| byte == b'\n') {
            self.begun.extend_from_slice(piece);
            if piece.ends_with(b"\n") {
                self.end_line()?;
            }
        }
        Ok(bytes.len())
    }

    /// What has not ended is passed on as it is: a question waits there.
    fn flush(&mut self) -> io::Result<()> {
        self.end_line()?;
        self.inner.flush()
    }
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
/// in than the line.
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

#[cfg(test)]
mod tests {
    use super::*;

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
        let mut folded = Folded::new(&mut out, 0, "cargo run".to_owned());
        write!(folded, "repeat with: cargo run --release -- verify --seed 1").unwrap();
        writeln!(folded, " --cases 2000").unwrap();
        write!(folded, "? ").unwrap();
        folded.flush().unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text.lines().count(), 2, "{text}");
        assert_eq!(text.lines().last(), Some("? "));
    }
}
