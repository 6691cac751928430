// SPDX-License-Identifier: 0BSD
//! Replies out of frames.

use core::marker::PhantomData;

use super::function::{is_read, longest_count, read_function, write_function};
use super::{crc, Framing, ReplyError, Request};
use crate::{Accepts, AnyDevice, Decoded, Error, NeedsNothing, Readable};

#[derive(Clone, Copy, Debug)]
enum Items<'a> {
    Words(&'a [u8]),
    Bits(&'a [u8]),
    Echo(u16),
}

/// What a device answered: words, or bits as 0 and 1, from the address that was asked for.
#[derive(Clone, Copy, Debug)]
pub struct Reply<'a, D = AnyDevice> {
    function: u8,
    address: u16,
    count: u16,
    items: Items<'a>,
    device: PhantomData<D>,
}

impl<D> Reply<'_, D> {
    /// How many items the reply brings; none for a write of several items.
    #[must_use]
    pub const fn count(&self) -> u16 {
        self.count
    }

    /// The word, or the bit, of that place in the reply.
    #[must_use]
    pub fn item(&self, place: u16) -> Option<u16> {
        if place >= self.count {
            return None;
        }
        let place = usize::from(place);
        match self.items {
            Items::Words(bytes) => {
                let start = place.checked_mul(2)?;
                let word = bytes.get(start..)?.first_chunk::<2>()?;
                Some(u16::from_be_bytes(*word))
            }
            Items::Bits(bytes) => Some(u16::from(bytes.get(place / 8)? >> (place % 8) & 1)),
            Items::Echo(value) => Some(value),
        }
    }

    /// All items in their order.
    pub fn items(&self) -> impl Iterator<Item = u16> + '_ {
        (0..self.count).map_while(|place| self.item(place))
    }

    /// The raw number of a point that the reply brings.
    ///
    /// # Errors
    /// [`Error::WrongSpace`] if the function is neither the one that reads the point nor the one that writes a single
    /// item of its space, [`Error::NotBrought`] if the reply does not bring all of the point.
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
        let offset = address.checked_sub(self.address);
        let places = offset.and_then(|offset| Some(offset..offset.checked_add(P::WORDS)?));
        let items = places.map(|places| places.map_while(|place| self.item(place)));
        let raw = items.and_then(|items| P::from_received(items).ok());
        raw.ok_or(Error::NotBrought(Some(P::NAME)))
    }

    /// The value of a point that the reply brings.
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
        self.parse_of(bytes)
    }

    /// As `parse`, of a device.
    #[inline(never)]
    pub(super) fn parse_of<'b, D>(&self, bytes: &'b [u8]) -> Result<Reply<'b, D>, ReplyError> {
        if longest_count(self.function).is_none() {
            return Err(ReplyError::BadFunction);
        }
        // How many bytes are around the data.
        let (before, after) = match self.framing {
            Framing::Rtu => (2, 2),
            Framing::Tcp => (8, 0),
        };
        let around = before + after;
        let head = bytes.get(before - 2..).unwrap_or_default();
        let &[unit, function, first, ..] = head else {
            return Err(wrong_length(bytes.len(), around + 1));
        };
        self.check_frame(bytes, function, first)?;
        if unit != self.unit {
            let (expected, received) = (self.unit, unit);
            return Err(ReplyError::WrongUnit { expected, received });
        }
        if function & 0x7F != self.function {
            let (expected, received) = (self.function, function & 0x7F);
            return Err(ReplyError::WrongFunction { expected, received });
        }
        let data = bytes
            .get(before..bytes.len().saturating_sub(after))
            .unwrap_or_default();
        if function != self.function {
            return Err(match *data {
                [code] => ReplyError::Exception { code, name: None },
                _ => wrong_length(bytes.len(), around + 1),
            });
        }
        if is_read(function) {
            return self.parse_read(data);
        }
        let &[a1, a0, v1, v0] = data else {
            return Err(wrong_length(bytes.len(), around + 4));
        };
        let (address, value) = (u16::from_be_bytes([a1, a0]), u16::from_be_bytes([v1, v0]));
        self.parse_echo((address, value))
    }

    /// Whether the bytes are a frame that came unharmed.
    fn check_frame(&self, bytes: &[u8], function: u8, first: u8) -> Result<(), ReplyError> {
        let length = match (self.framing, bytes) {
            (Framing::Tcp, &[_, _, p1, p0, l1, l0, ..]) => {
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
        match (self.framing, bytes) {
            (Framing::Rtu, _) if crc(bytes) != 0 => Err(ReplyError::BadCrc),
            (Framing::Tcp, &[high, low, ..]) => {
                let (expected, received) = (self.transaction, u16::from_be_bytes([high, low]));
                if expected == received {
                    Ok(())
                } else {
                    Err(ReplyError::WrongTransaction { expected, received })
                }
            }
            _ => Ok(()),
        }
    }

    fn parse_read<'b, D>(&self, data: &'b [u8]) -> Result<Reply<'b, D>, ReplyError> {
        let wide = self.function > 2;
        let asked = if wide {
            self.count.saturating_mul(2)
        } else {
            self.count.div_ceil(8)
        };
        let (count, data) = data
            .split_first()
            .map_or((0, data), |(count, data)| (u16::from(*count), data));
        let came = u16::try_from(data.len()).unwrap_or(u16::MAX);
        if let Some(received) = [count, came].into_iter().find(|one| *one != asked) {
            let expected = asked;
            return Err(ReplyError::BadByteCount { expected, received });
        }
        let items = if wide {
            Items::Words(data)
        } else {
            Items::Bits(data)
        };
        Ok(self.reply(items, self.count))
    }

    fn parse_echo<D>(&self, received: (u16, u16)) -> Result<Reply<'static, D>, ReplyError> {
        let several = matches!(self.function, 15 | 16);
        let sent = if several {
            self.count
        } else {
            self.echo_value()
        };
        let expected = (self.address, sent);
        if received != expected {
            return Err(ReplyError::EchoMismatch { expected, received });
        }
        let value = if self.function == 5 {
            u16::from(sent != 0)
        } else {
            sent
        };
        Ok(self.reply(Items::Echo(value), u16::from(!several)))
    }

    const fn reply<'b, D>(&self, items: Items<'b>, count: u16) -> Reply<'b, D> {
        Reply {
            function: self.function,
            address: self.address,
            count,
            items,
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
        Framing::Rtu => rtu_reply_length(head),
        Framing::Tcp => match *head {
            [_, _, 0, 0, high, low, ..] => Some(usize::from(u16::from_be_bytes([high, low])) + 6),
            _ => None,
        },
    }
}

fn rtu_reply_length(head: &[u8]) -> Option<usize> {
    match head {
        [_, function, ..] if longest_count(function & 0x7F).is_none() => None,
        [_, function @ (1..=4), count, ..] => Some(rtu_length(*function, *count)),
        [_, 1..=4] => None,
        [_, function, ..] => Some(rtu_length(*function, 0)),
        _ => None,
    }
}

fn rtu_length(function: u8, count: u8) -> usize {
    match function {
        1..=4 => usize::from(count) + 5,
        0x80.. => 5,
        _ => 8,
    }
}

/// What is said of a frame of that length.
#[cold]
pub(super) fn wrong_length(length: usize, expected: usize) -> ReplyError {
    let [received, expected] = [length, expected].map(|one| u16::try_from(one).unwrap_or(u16::MAX));
    if received < expected {
        ReplyError::ShortFrame { expected, received }
    } else {
        ReplyError::LongFrame { expected, received }
    }
}
