// SPDX-License-Identifier: 0BSD
//! Parsed replies.

use core::marker::PhantomData;

use super::function::{is_of_bits, is_ours, is_read, read_function, write_function};
use super::{crc, Framing, Request};
use crate::{Accepts, AnyDevice, Decoded, Error, NeedsNothing, PointInfo, Readable, ReplyError};

/// The answer of a device: words, or bits as 0 and 1, from the requested address on.
#[derive(Clone, Copy, Debug)]
pub struct Reply<'a, D = AnyDevice> {
    function: u8,
    address: u16,
    base: &'static str,
    count: u16,
    /// Words with the high byte first, or bits with the first one lowest, then the rest of the frame.
    data: &'a [u8],
    device: PhantomData<D>,
}

impl<D> Reply<'_, D> {
    /// The number of items in the reply; 0 for a write of several items.
    #[must_use]
    pub const fn count(&self) -> u16 {
        self.count
    }

    /// The word, or the bit, at this place in the reply.
    #[must_use]
    pub fn item(&self, place: u16) -> Option<u16> {
        self.item_of(is_of_bits(self.function), place)
    }

    fn item_of(&self, is_bit: bool, place: u16) -> Option<u16> {
        if place >= self.count {
            return None;
        }
        let place = usize::from(place);
        if is_bit {
            return Some(u16::from(self.data.get(place / 8)? >> (place % 8) & 1));
        }
        let word = self.data.get(place.checked_mul(2)?..)?.first_chunk()?;
        Some(u16::from_be_bytes(*word))
    }

    /// All items in their order.
    pub fn items(&self) -> impl Iterator<Item = u16> + '_ {
        (0..self.count).map_while(|place| self.item(place))
    }

    /// The raw number of a point in the reply.
    ///
    /// # Errors
    /// [`Error::WrongSpace`] if the function is neither the one that reads the point nor the one that writes a single
    /// item of its space, [`Error::NotBrought`] if the reply does not have all of the point.
    pub fn raw<P: Readable>(&self) -> Result<P::Raw, Error>
    where
        D: Accepts<P::Device>,
    {
        let address = if self.function == read_function(P::SPACE) {
            P::ADDRESS
        } else if self.function == write_function(P::SPACE, 1) {
            P::WRITE_ADDRESS
        } else {
            return Err(Error::WrongSpace(Some(P::NAME)));
        };
        let is_bit = is_of_bits(read_function(P::SPACE));
        let offset = self.offset(P::BASE, address);
        let places = offset.and_then(|offset| Some(offset..offset.checked_add(P::SPAN)?));
        let items = places.map(|places| places.map_while(|place| self.item_of(is_bit, place)));
        let raw = items.and_then(|items| P::from_received(items).ok());
        raw.ok_or(Error::NotBrought(Some(P::NAME)))
    }

    /// The raw number of a point as data in the reply to a read, for `decode`.
    ///
    /// # Errors
    /// As for `raw`.
    pub fn raw_of<P>(&self, point: PointInfo<P>) -> Result<i128, Error>
    where
        D: Accepts<P>,
    {
        let facts = point.facts;
        if self.function != read_function(facts.space) {
            return Err(Error::WrongSpace(Some(facts.name)));
        }
        let offset = self.offset(facts.base, facts.address);
        let places = offset.and_then(|offset| Some(offset..offset.checked_add(facts.span())?));
        let items = places.map(|places| places.map_while(|place| self.item(place)));
        let raw = items.and_then(|items| facts.raw_from_words(items).ok());
        raw.ok_or(Error::NotBrought(Some(facts.name)))
    }

    /// The offset of an address, which counts from the base of this name, from the first one.
    fn offset(&self, base: &str, address: u16) -> Option<u16> {
        if base == self.base {
            address.checked_sub(self.address)
        } else {
            None
        }
    }

    /// The value of a point in the reply.
    ///
    /// # Errors
    /// As for `raw`; what decoding says.
    pub fn value<P: Readable<Factors: NeedsNothing>>(&self) -> Result<P::Value, Error>
    where
        D: Accepts<P::Device>,
    {
        self.value_with::<P>(NeedsNothing::nothing())
    }

    /// The value of a point that the reply brings, by the raw numbers that its scale needs.
    ///
    /// # Errors
    /// The same.
    pub fn value_with<P: Readable>(&self, with: P::Factors) -> Result<P::Value, Error>
    where
        D: Accepts<P::Device>,
    {
        P::decode_with(self.raw::<P>()?, with).into_result()
    }
}

impl Request<'_> {
    /// What a reply to this request says. Any bytes at any length are safe.
    ///
    /// # Errors
    /// Why the bytes are no such reply, or the exception that the device answers with.
    pub fn parse<'b>(&self, bytes: &'b [u8]) -> Result<Reply<'b>, ReplyError> {
        self.prove(bytes)?;
        Ok(self.reply(bytes))
    }

    /// Whether the bytes are a reply to this request.
    pub(super) fn prove(&self, bytes: &[u8]) -> Result<(), ReplyError> {
        if !is_ours(self.function) {
            return Err(ReplyError::BadFunction);
        }
        let is_tcp = self.framing == Framing::Tcp;
        // How many bytes are before the unit, and behind the data.
        let (start, after) = if is_tcp { (6, 0) } else { (0, 2) };
        let around = start + 2 + after;
        let Some(&[unit, function, first, ..]) = bytes.get(start..) else {
            return Err(wrong_length(bytes.len(), around + 1));
        };
        let length = match *bytes {
            [_, _, p1, p0, l1, l0, ..] if is_tcp => {
                if [p1, p0] != [0, 0] {
                    return Err(ReplyError::BadProtocol);
                }
                usize::from(u16::from_be_bytes([l1, l0])) + 6
            }
            _ if function & 0x7F == self.function => rtu_length(function, first),
            _ => bytes.len().max(5), // the shortest frame: an exception
        };
        if bytes.len() != length {
            return Err(wrong_length(bytes.len(), length));
        }
        match *bytes {
            [high, low, ..] if is_tcp => {
                let (expected, received) = (self.transaction, u16::from_be_bytes([high, low]));
                if expected != received {
                    return Err(ReplyError::WrongTransaction { expected, received });
                }
            }
            _ if crc(bytes) != 0 => return Err(ReplyError::BadCrc),
            _ => {}
        }
        if unit != self.unit {
            let (expected, received) = (self.unit, unit);
            return Err(ReplyError::WrongUnit { expected, received });
        }
        if function & 0x7F != self.function {
            let (expected, received) = (self.function, function & 0x7F);
            return Err(ReplyError::WrongFunction { expected, received });
        }
        // What is behind the function, without the checksum.
        let end = bytes.len().saturating_sub(after);
        let data = bytes.get(start + 2..end).unwrap_or_default();
        if function != self.function {
            return Err(match data.len() {
                1 => ReplyError::Exception {
                    code: first,
                    name: None,
                },
                _ => wrong_length(bytes.len(), around + 1),
            });
        }
        if is_read(function) {
            let expected = if is_of_bits(function) {
                self.count.div_ceil(8)
            } else {
                self.count.saturating_mul(2)
            };
            let came = u16::try_from(data.len().saturating_sub(1)).unwrap_or(u16::MAX);
            let counted = u16::from(first);
            let received = if counted == expected { came } else { counted };
            return if received == expected {
                Ok(())
            } else {
                Err(ReplyError::BadByteCount { expected, received })
            };
        }
        let &[a1, a0, v1, v0] = data else {
            return Err(wrong_length(bytes.len(), around + 4));
        };
        let received = (u16::from_be_bytes([a1, a0]), u16::from_be_bytes([v1, v0]));
        let expected = (self.wire_address(), self.echo_value());
        if received == expected {
            Ok(())
        } else {
            Err(ReplyError::EchoMismatch { expected, received })
        }
    }

    /// The reply in bytes that were proven to be one.
    pub(super) fn reply<'b, D>(&self, bytes: &'b [u8]) -> Reply<'b, D> {
        let (count, before) = match self.function {
            1..=4 => (self.count, 3),
            15.. => (0, 4),
            _ => (1, 4),
        };
        let head = if self.framing == Framing::Tcp { 6 } else { 0 };
        Reply {
            function: self.function,
            address: self.address,
            base: self.base.name,
            count,
            data: bytes.get(head + before..).unwrap_or_default(),
            device: PhantomData,
        }
    }
}

/// The length of a reply as far as its first bytes tell: three of RTU, six of TCP. None if there are too few, if the
/// function is unknown, or if the bytes are no head.
///
/// With it a transport knows when a reply is complete without waiting for silence on the line:
///
/// ```
/// use fieldscribe_runtime::modbus::{reply_length, Framing};
///
/// assert_eq!(reply_length(Framing::Rtu, &[1, 3, 2]), Some(7));
/// assert_eq!(reply_length(Framing::Tcp, &[0, 1, 0, 0, 0, 5]), Some(11));
/// ```
#[must_use]
pub fn reply_length(framing: Framing, head: &[u8]) -> Option<usize> {
    match framing {
        Framing::Rtu => match *head {
            [_, function, third, ..] if is_ours(function & 0x7F) => {
                Some(rtu_length(function, third))
            }
            _ => None,
        },
        Framing::Tcp => match *head {
            [_, _, 0, 0, high, low, ..] => Some(usize::from(u16::from_be_bytes([high, low])) + 6),
            _ => None,
        },
    }
}

fn rtu_length(function: u8, count: u8) -> usize {
    match function {
        1..=4 => usize::from(count) + 5,
        0x80.. => 5,
        _ => 8,
    }
}

/// The error for a frame of that length.
#[cold]
pub(super) fn wrong_length(length: usize, expected: usize) -> ReplyError {
    let received = u16::try_from(length).unwrap_or(u16::MAX);
    let expected = u16::try_from(expected).unwrap_or(u16::MAX);
    if received < expected {
        ReplyError::ShortFrame { expected, received }
    } else {
        ReplyError::LongFrame { expected, received }
    }
}
