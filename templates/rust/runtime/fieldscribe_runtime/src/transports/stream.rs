// SPDX-License-Identifier: 0BSD
//! Any stream of bytes of the standard library, such as a serial port. Needs the feature `std`.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::time::{Duration, Instant};

use super::{Answer, Protocol, NOISE};
use crate::modbus::LONGEST;
use crate::Transport;

/// The longest time for the bytes of a frame: the longest frame takes 2.4 seconds at 1200 baud.
const LONGEST_TIME: Duration = Duration::from_secs(3);

/// A stream whose reads fail if nothing arrives in time, like a serial port with a timeout.
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
/// After a failure, it waits until the line is silent before the next request, so that no late answer is taken for
/// another; a unit that did not answer delays only itself. [`StreamLine::clearing`] discards unrequested bytes. If a
/// line is never silent, an exchange ends three seconds after its first byte.
#[derive(Debug)]
pub struct StreamLine<S> {
    stream: S,
    protocol: Protocol,
    late: Late,
    clear: fn(&mut S) -> Result<()>,
}

/// What may still arrive from an exchange.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Late {
    Nothing,
    /// The whole reply of this unit.
    Reply(u8),
    /// The rest of bytes that were no reply.
    Rest,
}

impl<S> StreamLine<S> {
    /// A line of Modbus.
    pub const fn new(stream: S) -> Self {
        Self::speaking(Protocol::Modbus, stream)
    }

    /// A line with this protocol.
    pub const fn speaking(protocol: Protocol, stream: S) -> Self {
        Self {
            stream,
            protocol,
            late: Late::Nothing,
            clear: |_| Ok(()),
        }
    }

    /// The same line, with `clear` to discard received bytes before each request:
    /// `|port| Ok(port.clear(ClearBuffer::Input)?)` for a serial port of the crate `serialport`.
    #[must_use]
    pub fn clearing(self, clear: fn(&mut S) -> Result<()>) -> Self {
        Self { clear, ..self }
    }

    /// The stream, for example to change its settings.
    pub fn stream(&mut self) -> &mut S {
        &mut self.stream
    }
}

impl<S: Read> StreamLine<S> {
    /// Reads until nothing more arrives.
    fn fall_silent(&mut self) -> Result<()> {
        let mut thrown_away = [0; 64];
        let started = Instant::now();
        for _ in 0..NOISE {
            if started.elapsed() > LONGEST_TIME {
                break;
            }
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
        let place = if self.protocol == Protocol::Uss { 2 } else { 0 };
        let asked = request.get(place).copied().unwrap_or_default();
        if self.late == Late::Rest || self.late == Late::Reply(asked) {
            self.fall_silent()?;
        }
        self.late = Late::Rest;
        (self.clear)(&mut self.stream)?;
        self.stream.write_all(request)?;
        self.stream.flush()?;
        let mut answer = Answer::new(self.protocol, request, reply);
        let mut first: Option<Instant> = None;
        let received = receive(&mut answer, |space| {
            if first.is_some_and(|first| first.elapsed() > LONGEST_TIME) {
                return Err(ErrorKind::TimedOut.into());
            }
            let count = self.stream.read(space)?;
            first.get_or_insert_with(Instant::now);
            if count == 0 {
                return Err(ErrorKind::TimedOut.into());
            }
            Ok(count)
        });
        match received {
            Ok(is_all) if is_all && answer.is_clean() => self.late = Late::Nothing,
            Err(ref error) if is_silence(error.kind()) => self.late = Late::Reply(asked),
            _ => {}
        }
        received.map(|_| answer.length())
    }
}

/// Receives an answer; returns whether nothing arrived after it. Foreign frames are dropped: one is the answer only if
/// nothing else arrived, as it shows who answered.
pub(super) fn receive(
    answer: &mut Answer<'_>,
    mut read: impl FnMut(&mut [u8]) -> Result<usize>,
) -> Result<bool> {
    let mut received = [0; LONGEST];
    while answer.space().is_some() {
        match read(&mut received) {
            Ok(count) => {
                if !answer.take(received.get(..count).unwrap_or_default()) {
                    return Ok(false);
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => {
                if answer.length == 0 {
                    answer.length = answer.foreign;
                }
                return if answer.length == 0 {
                    Err(error)
                } else {
                    Ok(false)
                };
            }
        }
    }
    Ok(true)
}

/// True if an error means that nothing arrived.
pub(super) fn is_silence(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::TimedOut | ErrorKind::WouldBlock)
}
