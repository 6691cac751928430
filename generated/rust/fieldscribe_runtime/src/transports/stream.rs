// SPDX-License-Identifier: 0BSD
//! Any stream of bytes of the standard library, as a serial port. Needs the feature `std`.

use std::io::{Error, ErrorKind, Read, Result, Write};

use super::{Answer, Protocol, NOISE};
use crate::Transport;

/// A stream whose reads end with an error when nothing comes in time, as those of a serial port with a timeout.
///
/// ```no_run
/// # fn open() -> std::io::Result<std::fs::File> { std::fs::File::open("/dev/ttyUSB0") }
/// use fieldscribe_runtime::transports::stream::StreamLine;
///
/// let port = open()?; // as `serialport::new("/dev/ttyUSB0", 9600).timeout(...).open()?`
/// let line = StreamLine::new(port);
/// # std::io::Result::Ok(())
/// ```
///
/// After a failure it waits until the line is silent before it asks again, so that no late answer is taken for another.
#[derive(Debug)]
pub struct StreamLine<S> {
    stream: S,
    protocol: Protocol,
    is_stale: bool,
}

impl<S> StreamLine<S> {
    /// A line of Modbus.
    pub const fn new(stream: S) -> Self {
        Self::speaking(Protocol::Modbus, stream)
    }

    /// A line of that protocol.
    pub const fn speaking(protocol: Protocol, stream: S) -> Self {
        Self {
            stream,
            protocol,
            is_stale: false,
        }
    }

    /// The stream, as for its settings.
    pub fn stream(&mut self) -> &mut S {
        &mut self.stream
    }
}

impl<S: Read> StreamLine<S> {
    /// Reads until nothing comes any more.
    fn fall_silent(&mut self) -> Result<()> {
        let mut thrown_away = [0; 64];
        for _ in 0..NOISE {
            match self.stream.read(&mut thrown_away) {
                Ok(0) => break,
                Err(error) if is_silence(error.kind()) => break,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                came => drop(came?),
            }
        }
        Ok(())
    }
}

impl<S: Read + Write> Transport for StreamLine<S> {
    type Error = Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize> {
        if core::mem::replace(&mut self.is_stale, true) {
            self.fall_silent()?;
        }
        self.stream.write_all(request)?;
        self.stream.flush()?;
        let mut answer = Answer::new(self.protocol, request, reply);
        while let Some(space) = answer.space() {
            let read = match self.stream.read(space) {
                Ok(0) => Err(ErrorKind::TimedOut.into()),
                other => other,
            };
            match read {
                Ok(count) => answer.took(count),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) if !is_silence(error.kind()) || answer.length() == 0 => {
                    return Err(error)
                }
                Err(_) => break, // the reply is cut
            }
        }
        self.is_stale = !answer.is_clean();
        Ok(answer.length())
    }
}

/// Whether an error says that nothing came.
pub(super) fn is_silence(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::TimedOut | ErrorKind::WouldBlock)
}
