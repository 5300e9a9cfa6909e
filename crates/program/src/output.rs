//! What a judge writes that [`Group::start_judge`] has started.

use std::io::{self, Read as _};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use crate::group::Group;

/// What a judge writes to standard output until it ends by itself, with one of these exit codes.
///
/// # Errors
/// What the system says; [`io::ErrorKind::TimedOut`] if it is at work at `end`, which is only seen on Unix, and
/// [`io::ErrorKind::Other`] if it was ended.
#[cfg(unix)]
pub fn of_judge(mut command: Command, end: Instant, codes: &[u8]) -> io::Result<Vec<u8>> {
    use std::io::ErrorKind;
    use std::os::fd::OwnedFd;
    use std::os::unix::net::UnixStream;
    // A socket and not a pipe, because reading from it can have a limit without a thread.
    let (mut ours, theirs) = UnixStream::pair()?;
    ours.set_read_timeout(Some(Duration::from_millis(50)))?;
    command.stdin(Stdio::null()).stdout(OwnedFd::from(theirs));
    let mut judge = Group::start_judge(&mut command)?;
    // It holds their end of the socket too.
    drop(command);
    let (mut text, mut piece) = (Vec::new(), [0; 1 << 14]);
    loop {
        match ours.read(&mut piece) {
            Ok(0) => break,
            Ok(n) => text.extend_from_slice(&piece[..n]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) if !matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                return Err(error);
            }
            Err(_) if judge.has_ended() => break,
            Err(_) if Instant::now() >= end => return Err(ErrorKind::TimedOut.into()),
            Err(_) => {}
        }
    }
    ended(judge.end(Duration::from_secs(2)), text, codes)
}

/// Elsewhere it is waited for, however long that takes.
///
/// # Errors
/// What the system says, and [`io::ErrorKind::Other`] if it was ended.
#[cfg(not(unix))]
pub fn of_judge(mut command: Command, _: Instant, codes: &[u8]) -> io::Result<Vec<u8>> {
    command.stdin(Stdio::null()).stdout(Stdio::piped());
    let mut judge = Group::start_judge(&mut command)?;
    let mut text = Vec::new();
    if let Some(stdout) = judge.child().stdout.as_mut() {
        stdout.read_to_end(&mut text)?;
    }
    ended(judge.end(Duration::from_secs(2)), text, codes)
}

/// What a judge wrote, if it came to its end.
fn ended(status: Option<ExitStatus>, text: Vec<u8>, codes: &[u8]) -> io::Result<Vec<u8>> {
    let code = status.and_then(|status| status.code());
    if code.is_some_and(|code| codes.iter().any(|one| i32::from(*one) == code)) {
        return Ok(text);
    }
    let how = status.map_or_else(String::new, |status| format!(" ({status})"));
    let why = format!("its judge was ended{how}: does it send signals to its parent?");
    Err(io::Error::other(why))
}
