//! The lines of a file that is read piece by piece, and the numbers in them.

use memchr::memchr2;
use rasterproof_host::error::FileError;
use rasterproof_host::input::Pieces;
use rasterproof_host::limits;
use rasterproof_host::text::printable_short;

use crate::PIECE_BYTES;

/// What editors put before a text in UTF-8, and some programs before any text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// Bytes without the mark before them.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// The beginning of a name, which all of its uses share where it is too long.
pub(crate) fn name(name: &str) -> &str {
    &name[..name.floor_char_boundary(limits::NAME_BYTES)]
}

/// What is said of a number with a comma, which [`number`] reads.
pub(crate) fn comma(word: &[u8]) -> String {
    let word = printable_short(&String::from_utf8_lossy(word), 40);
    format!("the comma of '{word}' is taken as a decimal point")
}

/// A number. What C libraries write where there is none, as `-nan(ind)` or `1.#QNAN`, is one that is not finite. Fortran writes
/// exponents as in `1.5D+00`, and some programs a decimal comma where the language of the system has one.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| {
        let unsigned = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
        let is_nan = unsigned.get(..4).is_some_and(|begin| begin.eq_ignore_ascii_case(b"nan("));
        let hash = unsigned.starts_with(b"1.#").then_some(2);
        let is_nan = is_nan || hash.is_some_and(|at| is_of_number(unsigned, at));
        let has_point = text.contains('.') || text.matches(',').count() > 1;
        let usual =
            || text.replace(['d', 'D'], "e").replace(',', if has_point { "," } else { "." });
        is_nan.then_some(f64::NAN).or_else(|| usual().parse().ok())
    })
}

/// Whether the sign `#` at this place is that of a number which is not finite, and begins no comment.
pub(crate) fn is_of_number(line: &[u8], at: usize) -> bool {
    let begins = |word: &&[u8]| {
        line[at + 1..].get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word))
    };
    line[..at].ends_with(b"1.") && [&b"IND"[..], b"INF", b"QNAN", b"SNAN"].iter().any(begins)
}

/// Lines end with a line feed, a carriage return or both; some files have all of them.
pub(crate) struct Text {
    file: Pieces,
    /// A piece of the file, and what was left of the one before it.
    buffer: Vec<u8>,
    /// Where the next line begins in it; behind its end after the last line.
    at: usize,
    /// Whether nothing of the file is left to be read.
    ended: bool,
    /// Whether it begins with a mark of UTF-16.
    pub is_wide: bool,
}

impl Text {
    /// The lines of a file whose first bytes were read already.
    pub(crate) fn new(begun: Vec<u8>, file: Pieces) -> Self {
        let at = begun.len() - without_mark(&begun).len();
        let is_wide = begun.starts_with(b"\xff\xfe") || begun.starts_with(b"\xfe\xff");
        Self { file, buffer: begun, at, ended: false, is_wide }
    }

    /// The next line without its end; nothing after the last one.
    pub(crate) fn next_line(&mut self) -> Result<Option<&[u8]>, FileError> {
        let mut searched = self.at;
        loop {
            let rest = self.buffer.get(searched..).unwrap_or_default();
            let end = memchr2(b'\n', b'\r', rest).map_or(self.buffer.len(), |at| searched + at);
            let break_bytes = if self.buffer[end..].starts_with(b"\r\n") { 2 } else { 1 };
            // What follows a carriage return decides whether it is one of two bytes.
            if end + 1 < self.buffer.len() || self.buffer[end..] == *b"\n" || self.ended {
                if self.at > self.buffer.len() {
                    return Ok(None);
                }
                let start = std::mem::replace(&mut self.at, end + break_bytes);
                return Ok(Some(&self.buffer[start..end]));
            }
            self.buffer.drain(..self.at);
            self.at = 0;
            searched = self.buffer.len().saturating_sub(1);
            // As much again as is left of a line, so that a long one is not moved often.
            let more = PIECE_BYTES.max(self.buffer.len() as u64);
            self.ended = self.file.read_more(&mut self.buffer, more)? == 0;
        }
    }
}
