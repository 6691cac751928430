// SPDX-License-Identifier: 0BSD
//! Transports that people have, each behind a feature of its own; none is on unless asked for.
//!
//! | feature | module | over |
//! |---|---|---|
//! | `std` | `tcp`, `stream` | `std::net::TcpStream`, and whatever is `Read` and `Write`, as a serial port |
//! | `tokio-modbus` | `tokio_modbus` | a client of tokio-modbus, for an `AsyncClient` |
//! | `embedded-io` | `embedded_io` | a port that blocks and can tell whether bytes have come |
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

/// After so many reads a line that does not fall silent is taken as it is.
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

/// What is spoken on a line: it tells where a reply ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Protocol {
    /// Modbus of either framing; which one it is, the request shows.
    #[default]
    Modbus,
    /// USS.
    Uss,
}

/// How the frames of an exchange are told apart: the framing of Modbus; none for USS.
type Frames = Option<Framing>;

/// A reply as it comes: where its next bytes go, and when it is complete.
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
///         self.0.write_all(request)?; // after throwing away what came before
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
    /// How many bytes the frame of another has that was dropped last.
    #[cfg(feature = "std")]
    foreign: usize,
}

impl<'a> Answer<'a> {
    /// The answer to a request, for which there is this space: none if the request goes to all units.
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

    /// Where the bytes go that are still missing; none if the reply is complete, or if what came is no reply. The late
    /// reply to an earlier transaction is dropped.
    pub fn space(&mut self) -> Option<&mut [u8]> {
        let mut end = self.end();
        if self.length == end && self.is_late() {
            (self.length, end) = (0, SHORTEST_TCP);
        }
        let end = end.min(self.reply.len());
        let space = self.reply.get_mut(self.length..end)?;
        (!space.is_empty()).then_some(space)
    }

    /// Takes so many bytes that came into the space.
    pub fn took(&mut self, count: usize) {
        self.length = self.length.wrapping_add(count).min(self.reply.len());
    }

    /// How many bytes have come.
    #[must_use]
    pub const fn length(&self) -> usize {
        self.length
    }

    /// Whether a complete reply to this request came, or none is to come. Otherwise more of what came may be on the
    /// line.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.reply.is_empty() || (self.length == self.end() && self.is_ours() && self.is_sound())
    }

    /// Takes bytes that came, and drops whole frames of others among them; whether all bytes had room.
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

    /// Whether a complete frame has the unit of the request, or over TCP its transaction.
    fn is_ours(&self) -> bool {
        let [sent, came] = [self.request, self.came()];
        match self.frames {
            Some(Framing::Tcp) => sent.first_chunk::<2>() == came.first_chunk(),
            Some(Framing::Rtu) => sent.first() == came.first(),
            None => sent.get(2) == came.get(2),
        }
    }

    /// Whether a complete frame came unharmed, as far as it tells.
    fn is_sound(&self) -> bool {
        match self.frames {
            Some(Framing::Tcp) => matches!(self.came(), [_, _, 0, 0, ..]),
            Some(Framing::Rtu) => crc(self.came()) == 0,
            None => check_byte(self.came()) == 0,
        }
    }

    /// Where the reply ends, or where the bytes end that will tell; what is no reply ends where it is.
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

    /// Whether this is a reply over TCP to another transaction; what is no reply ends with its head.
    fn is_late(&self) -> bool {
        self.frames == Some(Framing::Tcp) && self.is_sound() && !self.is_ours()
    }
}
