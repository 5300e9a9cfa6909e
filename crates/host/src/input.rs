//! Opening files: regular files only, at most a stated size, and never with waiting.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::error::{FileError, refused};
use crate::identity;

fn failed(path: &Path, error: &io::Error) -> FileError {
    let missing = error.kind() == io::ErrorKind::NotFound;
    FileError { missing, ..refused(path, format!("cannot be read: {error}")) }
}

/// Why something that is not a regular file is refused, or nothing for a regular one.
fn wrong_kind(kind: std::fs::FileType) -> Option<&'static str> {
    if kind.is_file() {
        return None;
    }
    if kind.is_dir() {
        return Some("is a directory, not a file");
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        if kind.is_fifo() {
            return Some("is a pipe, not a file: save what comes through it, and name that file");
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Some("is a device, not a file");
        }
        if kind.is_socket() {
            return Some("is a socket, not a file");
        }
    }
    Some("is not a regular file")
}

/// Opens a regular file of at most `limit_bytes` for reading. Links are followed. From now on no output of the command
/// replaces the file: see [`crate::output::Over`].
///
/// # Errors
/// [`FileError`] where the file is missing, is not a regular file, is too large, or may not be read.
pub fn open(path: &Path, limit_bytes: u64) -> Result<File, FileError> {
    let file = regular(path, limit_bytes)?;
    identity::note(path);
    Ok(file)
}

/// The first bytes of a regular file, which tell what it is; it may still be replaced. None of one that cannot be read.
#[must_use]
pub fn head(path: &Path, most_bytes: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    match regular(path, u64::MAX).map(|file| file.take(most_bytes).read_to_end(&mut bytes)) {
        Ok(Ok(_)) => bytes,
        _ => Vec::new(),
    }
}

/// The kind is looked at before the file is opened, since to open a device can have an effect, and
/// again afterwards, since the name may mean another file by then.
#[allow(clippy::disallowed_methods, reason = "this is the one function that opens an input file")]
fn regular(path: &Path, limit_bytes: u64) -> Result<File, FileError> {
    let before = std::fs::metadata(path).map_err(|error| failed(path, &error))?;
    if let Some(cause) = wrong_kind(before.file_type()) {
        return Err(refused(path, cause));
    }
    let mut options = OpenOptions::new();
    // A pipe that has taken the file's place since would be waited for.
    without_waiting(options.read(true));
    let file = options.open(path).map_err(|error| failed(path, &error))?;
    let data = file.metadata().map_err(|error| failed(path, &error))?;
    if let Some(cause) = wrong_kind(data.file_type()) {
        return Err(refused(path, cause));
    }
    if data.len() > limit_bytes {
        return Err(too_large(path, limit_bytes));
    }
    Ok(file)
}

/// Lets a pipe or a device be opened, read and written without waiting for who has its other end.
pub(crate) fn without_waiting(options: &mut OpenOptions) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.custom_flags(rustix::fs::OFlags::NONBLOCK.bits() as i32);
    }
    #[cfg(not(unix))]
    let _ = options;
}

fn too_large(path: &Path, limit_bytes: u64) -> FileError {
    let size = match limit_bytes {
        bytes if bytes >= 1 << 30 => format!("{} GiB", bytes >> 30),
        bytes if bytes >= 1 << 20 => format!("{} MiB", bytes >> 20),
        bytes => format!("{bytes} bytes"),
    };
    refused(path, format!("is too large: at most {size} are read"))
}

/// The bytes of a regular file of at most `limit_bytes`.
///
/// # Errors
/// As [`open`]; also where a file grows beyond the limit while it is read, as those below `/proc` may.
pub fn read(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, FileError> {
    let mut file = Pieces::open(path, limit_bytes)?;
    let mut bytes = Vec::with_capacity(usize::try_from(file.length_bytes()).unwrap_or(0));
    file.read_more(&mut bytes, limit_bytes.saturating_add(1))?;
    Ok(bytes)
}

/// A regular file that is read piece by piece, where all of it would take more memory than what is kept of it.
pub struct Pieces {
    path: PathBuf,
    file: File,
    limit_bytes: u64,
    read_bytes: u64,
}

impl Pieces {
    /// # Errors
    /// Those of [`open`], such as for a file that is larger than the limit.
    pub fn open(path: &Path, limit_bytes: u64) -> Result<Self, FileError> {
        let file = open(path, limit_bytes)?;
        Ok(Self { path: path.to_owned(), file, limit_bytes, read_bytes: 0 })
    }

    /// The length that the file has now; it may still grow.
    #[must_use]
    pub fn length_bytes(&self) -> u64 {
        self.file.metadata().map_or(0, |data| data.len())
    }

    /// Appends at most so many bytes, and returns how many: 0 at the end of the file.
    ///
    /// # Errors
    /// Those of [`read`], such as for a file that has grown beyond the limit since it was opened.
    pub fn read_more(&mut self, into: &mut Vec<u8>, most_bytes: u64) -> Result<usize, FileError> {
        let more = (&mut self.file).take(most_bytes).read_to_end(into);
        let more = more.map_err(|error| failed(&self.path, &error))?;
        self.read_bytes += more as u64;
        if self.read_bytes > self.limit_bytes {
            return Err(too_large(&self.path, self.limit_bytes));
        }
        Ok(more)
    }
}

/// The text of a regular file of at most `limit_bytes`, without the byte order mark that some
/// editors write.
///
/// # Errors
/// As [`read`]; also where the bytes are not UTF-8.
pub fn read_text(path: &Path, limit_bytes: u64) -> Result<String, FileError> {
    let bytes = read(path, limit_bytes)?;
    let mut text = String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..good].iter().filter(|&&byte| byte == b'\n').count();
        refused(path, format!("is not UTF-8 text (line {line})"))
    })?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the tests make the files that are read")]
mod tests {
    use std::fs;

    use super::*;
    use crate::testing::Folder;

    #[test]
    fn a_file_is_read_in_pieces_up_to_its_limit() {
        let folder = Folder::new("pieces");
        let file = folder.path("a.txt");
        fs::write(&file, "1234567").unwrap();
        let mut bytes = b"0".to_vec();
        let mut pieces = Pieces::open(&file, 7).unwrap();
        assert_eq!(pieces.length_bytes(), 7);
        let counts = [3, 3, 3, 3].map(|most| pieces.read_more(&mut bytes, most).unwrap());
        assert_eq!((counts, &bytes[..]), ([3, 3, 1, 0], &b"01234567"[..]));
        assert!(Pieces::open(&file, 6).is_err());
        // The file has grown since it was opened.
        let mut pieces = Pieces::open(&file, 8).unwrap();
        fs::write(&file, "123456789").unwrap();
        assert_eq!(pieces.read_more(&mut bytes, 5).unwrap(), 5);
        let error = pieces.read_more(&mut bytes, 5).unwrap_err();
        assert_eq!(error.cause, "is too large: at most 8 bytes are read");
    }

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = Folder::new("read");
        let file = folder.path("a.txt");
        fs::write(&file, "\u{feff}1234").unwrap();
        assert_eq!(read_text(&file, 7).unwrap(), "1234");
        assert_eq!(read(&file, 7).unwrap().len(), 7);
        let error = read(&file, 6).unwrap_err();
        assert_eq!(error.cause, "is too large: at most 6 bytes are read");
        assert!(read(&folder.path("b.txt"), 7).unwrap_err().missing);
        fs::write(&file, b"one\ntwo \xff").unwrap();
        assert_eq!(read_text(&file, 99).unwrap_err().cause, "is not UTF-8 text (line 2)");
    }

    #[test]
    fn only_regular_files_are_read() {
        let folder = Folder::new("kinds");
        assert_eq!(read(&folder.0, 9).unwrap_err().cause, "is a directory, not a file");
        #[cfg(unix)]
        {
            assert_eq!(
                read(Path::new("/dev/zero"), 9).unwrap_err().cause,
                "is a device, not a file"
            );
            let pipe = folder.path("pipe");
            crate::testing::make_pipe(&pipe);
            assert!(read(&pipe, 9).unwrap_err().cause.starts_with("is a pipe"));
            let link = folder.path("link");
            std::os::unix::fs::symlink("/dev/zero", &link).unwrap();
            assert_eq!(read(&link, 9).unwrap_err().cause, "is a device, not a file");
        }
    }

    /// Sparse, so that the test takes no space on the disk.
    #[test]
    fn a_file_of_five_gigabytes_is_refused_at_once() {
        let folder = Folder::new("sparse");
        let file = folder.path("big");
        File::create(&file).unwrap().set_len(5_000_000_000).unwrap();
        assert_eq!(read(&file, 1 << 30).unwrap_err().cause, "is too large: at most 1 GiB are read");
    }
}
