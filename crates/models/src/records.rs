//! The records of a file: lines of text, or bytes of one length. One reader serves all formats. It knows where it is, reads piece
//! by piece, and its errors name the file with the line or the byte.

use std::ops::Range;
use std::path::Path;

use memchr::memchr2;
use rasterproof_core::parallel;
use rasterproof_host::input::Pieces;
use rasterproof_host::limits;
use rasterproof_host::text::printable_short;

use crate::Wrong;

/// How many bytes of lines are read at once.
const PIECE_BYTES: u64 = 1 << 20;

/// How many bytes of records are read at once: enough for several threads.
const RECORD_PIECE_BYTES: u64 = 1 << 22;

/// What editors put before a text in UTF-8, and some programs before any text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// Bytes without the mark before them.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// Whether a text begins with the mark of UTF-16, in either byte order.
pub(crate) fn is_wide(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// The beginning of a name, which all of its uses share where it is too long.
pub(crate) fn name(name: &str) -> &str {
    &name[..name.floor_char_boundary(limits::NAME_BYTES)]
}

/// A word of a file as a message quotes it.
pub(crate) fn short(word: &[u8]) -> String {
    printable_short(&String::from_utf8_lossy(word), 40)
}

/// What is said of a number with a comma, which [`number`] reads.
pub(crate) fn comma(word: &[u8]) -> String {
    format!("the comma of '{}' is taken as a decimal point", short(word))
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

/// The same where a number is expected.
pub(crate) fn expected_number(word: &[u8]) -> Result<f64, String> {
    number(word).ok_or_else(|| format!("'{}' is not a number", short(word)))
}

/// Whether the sign `#` at this place is that of a number which is not finite, and begins no comment.
pub(crate) fn is_of_number(line: &[u8], at: usize) -> bool {
    let begins = |word: &&[u8]| {
        line[at + 1..].get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word))
    };
    line[..at].ends_with(b"1.") && [&b"IND"[..], b"INF", b"QNAN", b"SNAN"].iter().any(begins)
}

/// The type of a number in records of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Kind {
    /// How many bytes a number of this type has.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number at the beginning of these bytes, of which there are [`Self::size`] or more.
    #[inline]
    pub(crate) fn number(self, bytes: &[u8], is_big: bool) -> f64 {
        fn word<const N: usize>(bytes: &[u8], is_big: bool) -> [u8; N] {
            let mut word = *bytes.first_chunk().unwrap_or(&[0; N]);
            if is_big {
                word.reverse();
            }
            word
        }
        match self {
            Self::I8 => f64::from(i8::from_le_bytes(word(bytes, is_big))),
            Self::U8 => f64::from(u8::from_le_bytes(word(bytes, is_big))),
            Self::I16 => f64::from(i16::from_le_bytes(word(bytes, is_big))),
            Self::U16 => f64::from(u16::from_le_bytes(word(bytes, is_big))),
            Self::I32 => f64::from(i32::from_le_bytes(word(bytes, is_big))),
            Self::U32 => f64::from(u32::from_le_bytes(word(bytes, is_big))),
            Self::I64 => i64::from_le_bytes(word(bytes, is_big)) as f64,
            Self::U64 => u64::from_le_bytes(word(bytes, is_big)) as f64,
            Self::F32 => f64::from(f32::from_le_bytes(word(bytes, is_big))),
            Self::F64 => f64::from_le_bytes(word(bytes, is_big)),
        }
    }
}

/// A file whose records are read one after the other.
pub(crate) struct Records {
    /// What is left of the file, which is read in pieces.
    file: Pieces,
    /// What was read and is not used up.
    pub bytes: Vec<u8>,
    /// The index of the byte that is looked at next; behind the end of all bytes after the last line.
    pub at: usize,
    /// How many bytes of the file were before these.
    before: usize,
    /// Whether nothing of the file is left to be read.
    ended: bool,
    /// The number of the last line, from 1; 0 where no line was read, as in a binary file.
    pub line: usize,
    /// Whether a line feed after a carriage return belongs to what follows.
    pub is_old: bool,
}

impl Records {
    /// A file with its first bytes. A mark before a text is no part of it.
    pub(crate) fn open(path: &Path) -> Result<Self, Wrong> {
        let mut file = Pieces::open(path, limits::MODEL_BYTES)?;
        let mut bytes = Vec::new();
        file.read_more(&mut bytes, PIECE_BYTES)?;
        let at = bytes.len() - without_mark(&bytes).len();
        Ok(Self { file, bytes, at, before: 0, ended: false, line: 0, is_old: false })
    }

    /// An error at the line that was read last, or at the next byte where there are no lines.
    pub(crate) fn wrong(&self, cause: String) -> Wrong {
        match self.line {
            0 => format!("byte {}: {cause}", self.before + self.at).into(),
            line => Wrong { line, cause },
        }
    }

    /// The length that the file has now.
    pub(crate) fn length_bytes(&self) -> u64 {
        self.file.length_bytes()
    }

    /// The bytes that were read from the file and not yet used.
    pub(crate) fn left(&self) -> &[u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// The length that the file has now, without what is used up.
    pub(crate) fn left_bytes(&self) -> u64 {
        self.length_bytes().saturating_sub((self.before + self.at) as u64)
    }

    /// Reads what is left of the file, for readers that cannot say how long an element is.
    pub(crate) fn read_all(&mut self) -> Result<(), Wrong> {
        if self.ended {
            return Ok(());
        }
        let more = self.left_bytes().saturating_sub(self.left().len() as u64);
        self.bytes.reserve_exact(usize::try_from(more).unwrap_or(0));
        self.file.read_more(&mut self.bytes, u64::MAX)?;
        self.ended = true;
        Ok(())
    }

    /// The next line without its end; nothing after the last one. Lines end with a line feed, a carriage return or both; some
    /// files have all of them.
    pub(crate) fn next_line(&mut self) -> Result<Option<&[u8]>, Wrong> {
        let line = self.find_line()?;
        Ok(line.map(|line| &self.bytes[line]))
    }

    /// Where the next line is among the bytes, until the one after it is read.
    pub(crate) fn find_line(&mut self) -> Result<Option<Range<usize>>, Wrong> {
        let mut searched = self.at;
        loop {
            let rest = self.bytes.get(searched..).unwrap_or_default();
            let end = memchr2(b'\n', b'\r', rest).map_or(self.bytes.len(), |at| searched + at);
            let is_two = !self.is_old && self.bytes[end..].starts_with(b"\r\n");
            // What follows a carriage return decides whether it is one of two bytes.
            if end + 1 < self.bytes.len() || self.bytes[end..] == *b"\n" || self.ended {
                if self.at > self.bytes.len() {
                    return Ok(None);
                }
                self.line += 1;
                let start = std::mem::replace(&mut self.at, end + if is_two { 2 } else { 1 });
                return Ok(Some(start..end));
            }
            self.bytes.drain(..self.at);
            self.before += std::mem::take(&mut self.at);
            searched = self.bytes.len().saturating_sub(1);
            // As much again as is left of a line, so that a long one is not moved often.
            let more = PIECE_BYTES.max(self.bytes.len() as u64);
            self.ended = self.file.read_more(&mut self.bytes, more)? == 0;
        }
    }

    /// Calls `read` with the next whole records, at most so many in all, piece after piece until the file ends or `read` returns
    /// that it took fewer than it was given. Each piece is read while another thread looks at the one before it. Returns how
    /// many records were taken.
    pub(crate) fn records(
        &mut self,
        size: usize,
        most: u64,
        mut read: impl FnMut(&[u8]) -> usize + Send,
    ) -> Result<u64, Wrong> {
        let (mut taken, mut next) = (0, Vec::new());
        loop {
            let whole = (self.left().len() / size) as u64;
            let count = whole.min(most - taken) as usize;
            let end = self.at + count * size;
            if self.ended {
                let used = read(&self.bytes[self.at..end]);
                self.at += used * size;
                return Ok(taken + used as u64);
            }
            let rest = &self.bytes[end..];
            let (file, records) = (&mut self.file, &self.bytes[self.at..end]);
            next.clear();
            next.reserve(rest.len() + RECORD_PIECE_BYTES as usize);
            next.extend_from_slice(rest);
            let (more, used) =
                parallel::join(|| file.read_more(&mut next, RECORD_PIECE_BYTES), || read(records));
            let more = more?;
            self.ended = more == 0;
            taken += used as u64;
            if used < count {
                self.bytes.extend_from_slice(&next[next.len() - more..]);
                self.at += used * size;
                return Ok(taken);
            }
            self.before += end;
            self.at = 0;
            std::mem::swap(&mut self.bytes, &mut next);
            if taken == most {
                return Ok(taken);
            }
        }
    }
}
