// SPDX-License-Identifier: 0BSD
//! TCP by the standard library. Needs the feature `std`.

use std::format;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

use super::stream::{is_silence, receive};
use super::{Answer, Protocol, NOISE};
use crate::Transport;

/// A connection over TCP: Modbus TCP, or the frames of a serial line over a serial server.
///
/// It connects on first use, and again after a failure: just repeat the request.
///
/// ```no_run
/// use std::time::Duration;
///
/// use fieldscribe_runtime::transports::tcp::TcpLine;
///
/// let line = TcpLine::new("192.168.0.20:502").timeout(Duration::from_millis(300));
/// ```
#[derive(Debug)]
pub struct TcpLine<A> {
    address: A,
    timeout: Duration,
    protocol: Protocol,
    stream: Option<TcpStream>,
}

impl<A: ToSocketAddrs> TcpLine<A> {
    /// A connection to this address, for Modbus, with a second for each answer.
    pub const fn new(address: A) -> Self {
        Self::speaking(Protocol::Modbus, address)
    }

    /// A connection with this protocol.
    pub const fn speaking(protocol: Protocol, address: A) -> Self {
        Self {
            address,
            timeout: Duration::from_secs(1),
            protocol,
            stream: None,
        }
    }

    /// The same with another time to connect, and for each whole answer; at least a millisecond.
    #[must_use]
    pub fn timeout(self, timeout: Duration) -> Self {
        Self {
            timeout: timeout.max(Duration::from_millis(1)),
            ..self
        }
    }

    /// The present connection, unless it has ended; else a new one.
    fn connection(&mut self) -> Result<TcpStream> {
        let old = self.stream.take();
        match old.filter(|stream| drained(stream).unwrap_or(false)) {
            Some(stream) => Ok(stream),
            None => self.connected(),
        }
    }

    fn connected(&self) -> Result<TcpStream> {
        let mut failure = Error::from(ErrorKind::AddrNotAvailable);
        for address in self.address.to_socket_addrs().map_err(with_form)? {
            match TcpStream::connect_timeout(&address, self.timeout) {
                Ok(stream) => {
                    stream.set_nodelay(true)?;
                    stream.set_write_timeout(Some(self.timeout))?;
                    return Ok(stream);
                }
                Err(error) => failure = Error::new(error.kind(), format!("{address}: {error}")),
            }
        }
        Err(failure)
    }
}

impl<A: ToSocketAddrs> Transport for TcpLine<A> {
    type Error = Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize> {
        let mut stream = self.connection()?;
        let started = Instant::now();
        stream.write_all(request)?;
        let mut answer = Answer::new(self.protocol, request, reply);
        receive(&mut answer, |space| {
            let left = self.timeout.saturating_sub(started.elapsed());
            read_within(&mut stream, left, space)
        })?;
        if answer.is_clean() {
            self.stream = Some(stream);
        }
        Ok(answer.length())
    }
}

/// The same error; for a missing address, with the form of an address.
fn with_form(error: Error) -> Error {
    match error.kind() {
        ErrorKind::InvalidInput => Error::new(
            error.kind(),
            format!("{error}: it is a name or a number with a port, as 192.168.0.20:502"),
        ),
        _ => error,
    }
}

fn nothing_came() -> Error {
    Error::new(ErrorKind::TimedOut, "no byte came")
}

/// Reads at least one byte.
fn read_within(stream: &mut TcpStream, left: Duration, space: &mut [u8]) -> Result<usize> {
    if left.is_zero() {
        return Err(nothing_came());
    }
    stream.set_read_timeout(Some(left))?;
    match stream.read(space) {
        Ok(0) => Err(Error::new(
            ErrorKind::UnexpectedEof,
            "the other side closed the connection",
        )),
        Err(error) if is_silence(error.kind()) => Err(nothing_came()),
        other => other,
    }
}

/// Discards received bytes; returns whether the other end is still connected, and silent.
///
/// Gives up on one that sends without end.
fn drained(mut stream: &TcpStream) -> Result<bool> {
    stream.set_nonblocking(true)?;
    let mut thrown_away = [0; 256];
    let mut is_silent = false;
    for _ in 0..NOISE {
        match stream.read(&mut thrown_away) {
            Ok(1..) => {}
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            ended => {
                is_silent = ended.is_err_and(|error| error.kind() == ErrorKind::WouldBlock);
                break;
            }
        }
    }
    stream.set_nonblocking(false)?;
    Ok(is_silent)
}
