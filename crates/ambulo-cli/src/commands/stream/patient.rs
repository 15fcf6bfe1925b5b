//! Reads from a connection that may be silent or slow.

use std::cell::Cell;
use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Reads for at most a time from `begun` on, however the bytes come.
pub(super) struct Patient<'a> {
    connection: &'a TcpStream,
    /// `None` waits without end.
    longest: Option<Duration>,
    begun: &'a Cell<Instant>,
}

impl<'a> Patient<'a> {
    /// A reader of a connection; `begun` is set to the present when a message may take its time again.
    pub(super) fn new(connection: &'a TcpStream, longest: Option<Duration>, begun: &'a Cell<Instant>) -> Patient<'a> {
        Patient { connection, longest, begun }
    }
}

impl Read for Patient<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> std::io::Result<usize> {
        let left = self.longest.map(|longest| longest.saturating_sub(self.begun.get().elapsed()));
        if left.is_some_and(|left| left.is_zero()) {
            return Err(ErrorKind::TimedOut.into());
        }
        self.connection.set_read_timeout(left)?;
        self.connection.read(bytes)
    }
}

/// Whether an error is a timeout.
pub(super) fn is_over(kind: ErrorKind) -> bool {
    // Systems name it differently.
    matches!(kind, ErrorKind::WouldBlock | ErrorKind::TimedOut)
}
