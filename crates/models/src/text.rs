//! The lines of a file that is read piece by piece.

use memchr::memchr;
use rasterproof_host::error::FileError;
use rasterproof_host::input::Pieces;

use crate::PIECE_BYTES;

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
        // A mark that some editors put before a text.
        let at = if begun.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
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
