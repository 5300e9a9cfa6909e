//! The lines of a file that is read piece by piece, and the numbers in them.

use memchr::memchr;
use rasterproof_host::error::FileError;
use rasterproof_host::input::Pieces;

use crate::PIECE_BYTES;

/// What editors put before a text in UTF-8, and some programs before any text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// Bytes without the mark before them.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// A number. What C libraries write where there is none, as `-nan(ind)` or `1.#QNAN`, is one that is not finite.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| {
        let unsigned = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
        let is_nan = unsigned.get(..4).is_some_and(|begin| begin.eq_ignore_ascii_case(b"nan("));
        let hash = unsigned.starts_with(b"1.#").then_some(2);
        (is_nan || hash.is_some_and(|at| is_of_number(unsigned, at))).then_some(f64::NAN)
    })
}

/// Whether the sign `#` at this place is that of a number which is not finite, and begins no comment.
pub(crate) fn is_of_number(line: &[u8], at: usize) -> bool {
    let begins = |word: &&[u8]| {
        line[at + 1..].get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word))
    };
    line[..at].ends_with(b"1.") && [&b"IND"[..], b"INF", b"QNAN", b"SNAN"].iter().any(begins)
}

pub(crate) struct Text {
    file: Pieces,
    /// A piece of the file, and what was left of the one before it.
    buffer: Vec<u8>,
    /// Where the next line begins in it.
    at: usize,
    newline: u8,
    /// Whether the last line was returned.
    ended: bool,
    /// Whether it begins with a mark of UTF-16.
    pub is_wide: bool,
}

impl Text {
    /// The lines of a file whose first bytes were read already.
    pub(crate) fn new(begun: Vec<u8>, file: Pieces) -> Self {
        let at = begun.len() - without_mark(&begun).len();
        let is_wide = begun.starts_with(b"\xff\xfe") || begun.starts_with(b"\xfe\xff");
        // Files of old systems end their lines with a carriage return alone.
        let is_old = !begun.contains(&b'\n') && begun.contains(&b'\r');
        let newline = if is_old { b'\r' } else { b'\n' };
        Self { file, buffer: begun, at, newline, ended: false, is_wide }
    }

    /// The next line without its end; nothing after the last one.
    pub(crate) fn next_line(&mut self) -> Result<Option<&[u8]>, FileError> {
        let mut searched = self.at;
        loop {
            if let Some(length) = memchr(self.newline, &self.buffer[searched..]) {
                let start = std::mem::replace(&mut self.at, searched + length + 1);
                return Ok(Some(&self.buffer[start..searched + length]));
            }
            if self.ended {
                return Ok(None);
            }
            self.buffer.drain(..self.at);
            self.at = 0;
            searched = self.buffer.len();
            // As much again as is left of a line, so that a long one is not moved often.
            let more = PIECE_BYTES.max(self.buffer.len() as u64);
            if self.file.read_more(&mut self.buffer, more)? == 0 {
                self.ended = true;
                self.at = self.buffer.len();
                return Ok(Some(&self.buffer));
            }
        }
    }
}
