// SPDX-License-Identifier: 0BSD
//! Ready transports, each with a feature of its own; none is on by default.
//!
//! | feature | module | over |
//! |---|---|---|
//! | `std` | `tcp`, `stream` | `std::net::TcpStream`, and anything that is `Read` and `Write`, such as a serial port |
//! | `tokio-modbus` | `tokio_modbus` | a client of tokio-modbus, for an `AsyncClient` |
//! | `embedded-io` | `embedded_io` | a blocking port that can tell whether bytes have arrived |
//! | `embedded-io-async` | `embedded_io_async` | a port for a `LocalClient` |
//! | `embedded-can` | `embedded_can` | a controller, blocking or with `nb` |
//!
//! A transport of your own takes an [`Answer`], which knows where a reply ends.

#[cfg(feature = "embedded-can")]
pub mod embedded_can;
#[cfg(feature = "embedded-io")]
pub mod embedded_io;
#[cfg(feature = "embedded-io-async")]
pub mod embedded_io_async;
#[cfg(any(feature = "embedded-io", feature = "embedded-io-async"))]
mod error;
#[cfg(feature = "std")]
pub mod stream;
#[cfg(feature = "std")]
pub mod tcp;
#[cfg(feature = "tokio-modbus")]
pub mod tokio_modbus;

#[cfg(any(feature = "embedded-io", feature = "embedded-io-async"))]
pub use error::LineError;

use crate::modbus::{crc, framing_of, reply_length, Framing};
use crate::uss::check_byte;

/// After this many reads, a line that does not become silent is used anyway.
#[cfg(any(
    feature = "std",
    feature = "embedded-io",
    feature = "embedded-io-async"
))]
const NOISE: u32 = 64;

/// The shortest reply of RTU, an exception, in bytes.
const SHORTEST_RTU: usize = 5;

/// The shortest reply over TCP, an exception, in bytes.
const SHORTEST_TCP: usize = 9;

/// The protocol of a line: it defines where a reply ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Protocol {
    /// Modbus in the framing of the request.
    #[default]
    Modbus,
    /// USS.
    Uss,
}

/// The framing of an exchange: that of Modbus; [`None`] for USS.
type Frames = Option<Framing>;

/// A reply while it arrives: the place for its next bytes, and whether it is complete.
///
/// ```
/// use std::io::{Read, Write};
///
/// use fieldscribe_runtime::transports::{Answer, Protocol};
/// use fieldscribe_runtime::Transport;
///
/// struct Line<S>(S);
///
/// impl<S: Read + Write> Transport for Line<S> {
///     type Error = std::io::Error;
///
///     fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
///         self.0.write_all(request)?; // after discarding what arrived before
///         let mut answer = Answer::new(Protocol::Modbus, request, reply);
///         while let Some(space) = answer.space() {
///             let count = self.0.read(space)?;
///             answer.took(count);
///         }
///         Ok(answer.length())
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Answer<'a> {
    frames: Frames,
    request: &'a [u8],
    reply: &'a mut [u8],
    length: usize,
    /// The length of the foreign frame that was dropped last.
    #[cfg(feature = "std")]
    foreign: usize,
}

impl<'a> Answer<'a> {
    /// The answer to a request, with the buffer for it: empty for a broadcast.
    pub fn new(protocol: Protocol, request: &'a [u8], reply: &'a mut [u8]) -> Self {
        Self {
            frames: (protocol == Protocol::Modbus).then(|| framing_of(request)),
            request,
            reply,
            length: 0,
            #[cfg(feature = "std")]
            foreign: 0,
        }
    }

    /// The place for the missing bytes; [`None`] if the reply is complete, or if the bytes are no reply. Drops a late
    /// reply to an earlier transaction.
    pub fn space(&mut self) -> Option<&mut [u8]> {
        let mut end = self.end();
        if self.length == end && self.is_late() {
            (self.length, end) = (0, SHORTEST_TCP);
        }
        let end = end.min(self.reply.len());
        let space = self.reply.get_mut(self.length..end)?;
        (!space.is_empty()).then_some(space)
    }

    /// Adds this many bytes, which are in the space.
    pub fn took(&mut self, count: usize) {
        self.length = self.length.wrapping_add(count).min(self.reply.len());
    }

    /// The number of bytes received.
    #[must_use]
    pub const fn length(&self) -> usize {
        self.length
    }

    /// Whether a complete reply to this request arrived, or none is expected. Otherwise there may be more bytes on the
    /// line.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.reply.is_empty() || (self.length == self.end() && self.is_ours() && self.is_sound())
    }

    /// Adds received bytes, and drops complete foreign frames; returns whether all bytes had room.
    #[cfg(feature = "std")]
    fn take(&mut self, mut bytes: &[u8]) -> bool {
        while !bytes.is_empty() {
            let Some(space) = self.space() else {
                return false;
            };
            let count = space.len().min(bytes.len());
            for (place, byte) in space.iter_mut().zip(bytes) {
                *place = *byte;
            }
            self.took(count);
            bytes = bytes.get(count..).unwrap_or_default();
            if self.length == self.end() && !self.is_ours() && self.is_sound() {
                (self.foreign, self.length) = (self.length, 0);
            }
        }
        true
    }

    /// True if a complete frame has the unit of the request, or over TCP its transaction.
    fn is_ours(&self) -> bool {
        let [sent, came] = [self.request, self.came()];
        match self.frames {
            Some(Framing::Tcp) => sent.first_chunk::<2>() == came.first_chunk(),
            Some(Framing::Rtu) => sent.first() == came.first(),
            None => sent.get(2) == came.get(2),
        }
    }

    /// True if a complete frame is valid, as far as it shows.
    fn is_sound(&self) -> bool {
        match self.frames {
            Some(Framing::Tcp) => matches!(self.came(), [_, _, 0, 0, ..]),
            Some(Framing::Rtu) => crc(self.came()) == 0,
            None => check_byte(self.came()) == 0,
        }
    }

    /// The end of the reply, or of the bytes that show it; bytes that are no reply end where they are.
    fn end(&self) -> usize {
        let came = self.came();
        let (length, needed) = match self.frames {
            Some(framing) => {
                let needed = match framing {
                    Framing::Rtu if self.length < 3 => 3,
                    Framing::Rtu => SHORTEST_RTU,
                    Framing::Tcp => SHORTEST_TCP,
                };
                (reply_length(framing, came), needed)
            }
            None => (came.get(1).map(|length| usize::from(*length) + 2), 2),
        };
        length.unwrap_or(self.length.max(needed))
    }

    fn came(&self) -> &[u8] {
        self.reply.get(..self.length).unwrap_or_default()
    }

    /// True if this is a reply over TCP to another transaction; bytes that are no reply end with their header.
    fn is_late(&self) -> bool {
        self.frames == Some(Framing::Tcp) && self.is_sound() && !self.is_ours()
    }
}
