//! What a command hands over, and what becomes of its exit status where that fails.
//!
//! The exit status is the verdict of the command. It does not depend on whether somebody read the
//! output: where standard output fails, the command goes on without it. A verdict that agrees becomes
//! an error where something was lost that the user should have (a full disk, a file that cannot be
//! written), since a script would believe otherwise that it is there. A failing verdict stays one.

use std::cell::Cell;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::rc::Rc;

use rasterproof_host::output::{self, Output, Over, STANDARD_OUTPUT};
use rasterproof_host::text::printable_lines;

use super::{Streams, exit};

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
    fn note(&self, loss: Loss) {
        self.0.set(self.0.get().max(loss));
    }

    /// Whether everything was delivered so far; what is still buffered is not known.
    pub(super) fn is_whole(&self) -> bool {
        self.0.get() == Loss::Nothing
    }

    pub(super) fn status(&self, verdict: u8) -> u8 {
        let is_lost = self.0.get() == Loss::Failed;
        if is_lost && verdict == exit::AGREES { exit::USAGE } else { verdict }
    }
}

/// Passes on what is written until that fails for the first time, and accepts the rest.
pub(super) struct Delivered<'a> {
    inner: &'a mut dyn Write,
    delivery: Delivery,
    /// Why nothing is passed on any more.
    failure: Option<io::Error>,
    /// Whether something was passed on, or is this standard error.
    is_begun: bool,
}

impl<'a> Delivered<'a> {
    pub(super) fn new(inner: &'a mut dyn Write, delivery: &Delivery) -> Self {
        Self { inner, delivery: delivery.clone(), failure: None, is_begun: true }
    }

    /// Standard output, which must not go to a file that the command reads, as in `verify m.obj >> m.obj`.
    pub(super) fn of_output(inner: &'a mut dyn Write, delivery: &Delivery) -> Self {
        Self { is_begun: false, ..Self::new(inner, delivery) }
    }

    fn pass(&mut self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) {
        if self.failure.is_some() {
            return;
        }
        let check = || output::check(Path::new(STANDARD_OUTPUT), Over::Any);
        let may_begin = if self.is_begun { Ok(()) } else { check().map_err(io::Error::other) };
        self.is_begun = true;
        if let Err(error) = may_begin.and_then(|()| write(self.inner)) {
            let is_closed = error.kind() == ErrorKind::BrokenPipe;
            self.delivery.note(if is_closed { Loss::Unread } else { Loss::Failed });
            self.failure = Some(error);
        }
    }

    /// Why something was lost, unless the reader had enough.
    pub(super) fn lost(&self) -> Option<&io::Error> {
        self.failure.as_ref().filter(|error| error.kind() != ErrorKind::BrokenPipe)
    }
}

impl Write for Delivered<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.pass(|inner| inner.write_all(bytes));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.pass(|inner| inner.flush());
        Ok(())
    }
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
            let mut output = Delivered::new(&mut inner, &delivery);
            assert!(delivery.is_whole());
            output.write_all(b"AGREES").unwrap();
            assert!(!delivery.is_whole());
            assert_eq!(output.lost().is_some(), agrees == exit::USAGE);
            assert_eq!(delivery.status(exit::AGREES), agrees);
            assert_eq!(delivery.status(exit::DISAGREES), exit::DISAGREES);
        }
    }
}
