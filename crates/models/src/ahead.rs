//! A file of records that is read piece by piece, each piece while another thread looks at the one before it.

use rasterproof_core::parallel;
use rasterproof_host::error::FileError;
use rasterproof_host::input::Pieces;

/// How many bytes are read at once: enough for several threads.
const PIECE: u64 = 1 << 22;

pub(crate) struct Ahead {
    file: Pieces,
    /// What was read and is not used up.
    pub bytes: Vec<u8>,
    /// The index of the byte that is looked at next.
    pub at: usize,
    /// How many bytes of the file were before these.
    before: usize,
    next: Vec<u8>,
    /// Whether nothing of the file is left to be read.
    ended: bool,
}

impl Ahead {
    /// A file whose first bytes were read already.
    pub(crate) fn new(bytes: Vec<u8>, file: Pieces) -> Self {
        Self { file, bytes, at: 0, before: 0, next: Vec::new(), ended: false }
    }

    /// The number of the next byte in the file, from 0.
    pub(crate) fn byte(&self) -> usize {
        self.before + self.at
    }

    pub(crate) fn left(&self) -> &[u8] {
        &self.bytes[self.at..]
    }

    /// The length that the file has now, without what is used up.
    pub(crate) fn left_bytes(&self) -> u64 {
        self.file.length_bytes().saturating_sub(self.byte() as u64)
    }

    /// Reads what is left of the file, for readers that cannot say how long an element is.
    pub(crate) fn read_all(&mut self) -> Result<(), FileError> {
        if self.ended {
            return Ok(());
        }
        let more = self.left_bytes().saturating_sub(self.left().len() as u64);
        self.bytes.reserve_exact(usize::try_from(more).unwrap_or(0));
        self.file.read_more(&mut self.bytes, u64::MAX)?;
        self.ended = true;
        Ok(())
    }

    /// Calls `read` with the next whole records, at most so many in all, piece after piece until the file ends or `read` returns
    /// that it took fewer than it was given. Returns how many it took.
    pub(crate) fn records(
        &mut self,
        size: usize,
        most: u64,
        mut read: impl FnMut(&[u8]) -> usize + Send,
    ) -> Result<u64, FileError> {
        let mut taken = 0;
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
            let (file, next) = (&mut self.file, &mut self.next);
            next.clear();
            next.reserve(rest.len() + PIECE as usize);
            next.extend_from_slice(rest);
            let records = &self.bytes[self.at..end];
            let (more, used) = parallel::join(|| file.read_more(next, PIECE), || read(records));
            let more = more?;
            self.ended = more == 0;
            taken += used as u64;
            if used < count {
                let added = self.next.len() - more;
                self.bytes.extend_from_slice(&self.next[added..]);
                self.at += used * size;
                return Ok(taken);
            }
            self.before += end;
            self.at = 0;
            std::mem::swap(&mut self.bytes, &mut self.next);
            if taken == most {
                return Ok(taken);
            }
        }
    }
}
