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

impl<'a, D> Reply<'a, D> {
    /// The same reply, which another device gave.
    pub(super) fn of_device<E>(self) -> Reply<'a, E> {
        Reply {
            function: self.function,
            address: self.address,
            count: self.count,
            items: self.items,
            device: PhantomData,
        }
    }

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
        if longest_count(self.function).is_none() {
            return Err(ReplyError::BadFunction);
        }
        let pdu = match self.framing {
            Framing::Rtu => self.unwrap_rtu(bytes)?,
            Framing::Tcp => self.unwrap_tcp(bytes)?,
        };
        let (&function, data) = pdu.split_first().ok_or(ReplyError::ShortFrame)?;
        if function & 0x7F != self.function {
            let (expected, received) = (self.function, function & 0x7F);
            return Err(ReplyError::WrongFunction { expected, received });
        }
        if function != self.function {
            return Err(match data {
                [] => ReplyError::ShortFrame,
                &[code] => ReplyError::Exception { code, name: None },
                _ => ReplyError::LongFrame,
            });
        }
        if is_read(function) {
            self.parse_read(data)
        } else {
            self.parse_echo(data)
        }
    }

    fn unwrap_rtu<'b>(&self, bytes: &'b [u8]) -> Result<&'b [u8], ReplyError> {
        let &[unit, function, count, _, _, ..] = bytes else {
            return Err(ReplyError::ShortFrame);
        };
        if function & 0x7F == self.function {
            check_length(bytes.len(), rtu_length(function, count))?;
        }
        if crc(bytes) != 0 {
            return Err(ReplyError::BadCrc);
        }
        self.check_unit(unit)?;
        Ok(bytes.get(1..bytes.len() - 2).unwrap_or_default())
    }

    fn unwrap_tcp<'b>(&self, bytes: &'b [u8]) -> Result<&'b [u8], ReplyError> {
        let &[t1, t0, p1, p0, l1, l0, unit, _, _, ..] = bytes else {
            return Err(ReplyError::ShortFrame);
        };
        if [p1, p0] != [0, 0] {
            return Err(ReplyError::BadProtocol);
        }
        check_length(bytes.len(), usize::from(u16::from_be_bytes([l1, l0])) + 6)?;
        if u16::from_be_bytes([t1, t0]) != self.transaction {
            return Err(ReplyError::WrongTransaction);
        }
        self.check_unit(unit)?;
        Ok(bytes.get(7..).unwrap_or_default())
    }

    const fn check_unit(&self, received: u8) -> Result<(), ReplyError> {
        if received == self.unit {
            return Ok(());
        }
        let expected = self.unit;
        Err(ReplyError::WrongUnit { expected, received })
    }

    fn parse_read<'b>(&self, data: &'b [u8]) -> Result<Reply<'b>, ReplyError> {
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

    fn parse_echo(&self, data: &[u8]) -> Result<Reply<'static>, ReplyError> {
        check_length(data.len(), 4)?;
        let &[a1, a0, v1, v0] = data else {
            return Err(ReplyError::ShortFrame);
        };
        let several = matches!(self.function, 15 | 16);
        let sent = if several {
            self.count
        } else {
            self.echo_value()
        };
        let received = (u16::from_be_bytes([a1, a0]), u16::from_be_bytes([v1, v0]));
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

    const fn reply<'b>(&self, items: Items<'b>, count: u16) -> Reply<'b> {
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

const fn check_length(length: usize, expected: usize) -> Result<(), ReplyError> {
    if length < expected {
        Err(ReplyError::ShortFrame)
    } else if length > expected {
        Err(ReplyError::LongFrame)
    } else {
        Ok(())
    }
}
