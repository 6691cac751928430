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

/// Whether a complete reply belongs to the request and came unharmed.
fn belongs(frames: Frames, request: &[u8], reply: &[u8]) -> bool {
    match frames {
        Some(Framing::Tcp) => request.get(..4) == reply.get(..4),
        Some(Framing::Rtu) => request.first() == reply.first() && crc(reply) == 0,
        None => request.get(2) == reply.get(2) && check_byte(reply) == 0,
    }
}

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
}

impl<'a> Answer<'a> {
    /// The answer to a request, for which there is this space: none if the request goes to all units.
    pub fn new(protocol: Protocol, request: &'a [u8], reply: &'a mut [u8]) -> Self {
        Self {
            frames: (protocol == Protocol::Modbus).then(|| framing_of(request)),
            request,
            reply,
            length: 0,
        }
    }

    /// Where the bytes go that are still missing; none if the reply is complete, or if what came is no reply. The late
    /// reply to an earlier transaction is dropped.
    pub fn space(&mut self) -> Option<&mut [u8]> {
        let mut end = self.end();
        if self.length == end && self.is_late() {
            self.length = 0;
            end = self.end();
        }
        let end = end.min(self.reply.len());
        let space = self.reply.get_mut(self.length..end)?;
        (!space.is_empty()).then_some(space)
    }

    /// Takes so many bytes that came into the space.
    pub fn took(&mut self, count: usize) {
        self.length = self.length.saturating_add(count).min(self.reply.len());
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
        self.reply.is_empty()
            || (self.length == self.end() && belongs(self.frames, self.request, self.came()))
    }

    /// Where the reply ends, or where the bytes end that will tell; what is no reply ends where it is.
    fn end(&self) -> usize {
        let came = self.came();
        let (length, needed) = match self.frames {
            Some(framing) => {
                let needed = if framing == Framing::Rtu { 3 } else { 6 };
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
        self.frames == Some(Framing::Tcp)
            && self.length > 6
            && self.request.first_chunk::<2>() != self.came().first_chunk()
    }
}
