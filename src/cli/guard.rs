//! The last step before a terminal: characters that would change what it shows are written as escapes.
//!
//! Names and contents of files are made printable where they enter a message. This catches what was
//! forgotten there, in all output of all commands.

use std::io::{self, Write};

use rasterproof_host::text::{is_hidden, printable};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Escape {
    /// As `\u{1b}`, for people.
    Words,
    /// The same, but sequences that set a colour are kept, as this program writes them to a terminal.
    WordsAndColours,
    /// As `\u001b`, which JSON reads as the same character.
    Json,
}

/// Passes text on without hidden characters, but for ends of lines and tabs.
pub struct Guarded<'a> {
    inner: &'a mut dyn Write,
    escape: Escape,
    /// The first bytes of a character that has not ended.
    begun: Vec<u8>,
}

impl<'a> Guarded<'a> {
    pub fn new(inner: &'a mut dyn Write, escape: Escape) -> Self {
        Self { inner, escape, begun: Vec::new() }
    }

    fn pass(&mut self, text: &str) -> io::Result<()> {
        let is_wrong = |c: char| is_hidden(c) && !matches!(c, '\n' | '\t');
        let mut rest = text;
        while let Some(at) = rest.find(is_wrong) {
            self.inner.write_all(&rest.as_bytes()[..at])?;
            rest = &rest[at..];
            let kept = match self.escape {
                Escape::WordsAndColours => colour_length(rest),
                _ => 0,
            };
            let length =
                if kept > 0 { kept } else { rest.chars().next().map_or(1, char::len_utf8) };
            let (hidden, after) = rest.split_at(length);
            rest = after;
            match self.escape {
                _ if kept > 0 => self.inner.write_all(hidden.as_bytes())?,
                Escape::Json => {
                    for unit in hidden.encode_utf16() {
                        write!(self.inner, "\\u{unit:04x}")?;
                    }
                }
                _ => self.inner.write_all(printable(hidden).as_bytes())?,
            }
        }
        self.inner.write_all(rest.as_bytes())
    }
}

/// Bytes of the sequence that sets a colour at the beginning of a text, or none.
fn colour_length(text: &str) -> usize {
    let Some(inside) = text.strip_prefix("\u{1b}[") else { return 0 };
    let digits = inside.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';');
    if digits.starts_with('m') { text.len() - digits.len() + 1 } else { 0 }
}

impl Write for Guarded<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let is_plain = |byte: &u8| matches!(byte, b'\n' | b'\t' | b' '..=b'~');
        if self.begun.is_empty() && bytes.iter().all(is_plain) {
            self.inner.write_all(bytes)?;
            return Ok(bytes.len());
        }
        self.begun.extend_from_slice(bytes);
        let whole = match std::str::from_utf8(&self.begun) {
            Err(error) if error.error_len().is_none() => error.valid_up_to(),
            _ => self.begun.len(),
        };
        let rest = self.begun.split_off(whole);
        let text = std::mem::replace(&mut self.begun, rest);
        self.pass(&String::from_utf8_lossy(&text))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guarded(escape: Escape, text: &str) -> String {
        let mut out = Vec::new();
        let mut guard = Guarded::new(&mut out, escape);
        // In pieces that end within characters, which are put together again.
        for piece in text.as_bytes().chunks(if escape == Escape::WordsAndColours { 99 } else { 1 })
        {
            guard.write_all(piece).unwrap();
        }
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn hidden_characters_do_not_pass() {
        let text = "a\tb\u{4e2d}\n\u{1b}[31mred\u{1b}]0;t\u{7}\u{202e}x\u{9b}\u{e0001}";
        assert_eq!(
            guarded(Escape::Words, text),
            "a\tb\u{4e2d}\n\\u{1b}[31mred\\u{1b}]0;t\\u{7}\\u{202e}x\\u{9b}\\u{e0001}"
        );
        assert_eq!(
            guarded(Escape::WordsAndColours, text),
            "a\tb\u{4e2d}\n\u{1b}[31mred\\u{1b}]0;t\\u{7}\\u{202e}x\\u{9b}\\u{e0001}"
        );
        let json = guarded(Escape::Json, &format!("\"{}\"", text.replace(['\n', '\t'], "")));
        assert!(!json.chars().any(is_hidden), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text.replace(['\n', '\t'], ""));
    }
}
