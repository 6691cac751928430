// SPDX-License-Identifier: 0BSD
//! Requests and their frames.

use super::function::{is_read, read_function, write_function};
use super::{crc, Base, Block, Command, Framing, Profile};
use crate::point::counted;
use crate::{About, BitGroup, BuildError, Point, Readable, Whole, Writable, WrittenAlone};

/// The shortest request over TCP: a head of six bytes, the unit, and a PDU of five.
///
/// Of RTU only writes of several items are as long. From address 0 their count of `n` items stands where a length
/// would, for frames of `9 + 2 n` bytes (words) or `9 + (n + 7) / 8` (bits, perhaps one more). That is `6 + n` for
/// four or five bits alone, whose frames are shorter.
const SHORTEST_TCP: usize = 12;

/// What a request writes.
#[derive(Clone, Copy, Debug)]
enum Values<'a> {
    Own([u16; 4], usize),
    Lent(&'a [u16]),
}

impl Values<'_> {
    fn as_slice(&self) -> &[u16] {
        match self {
            Self::Own(words, count) => words.get(..*count).unwrap_or(words),
            Self::Lent(words) => words,
        }
    }
}

/// A request: what is asked of which unit. It is built into a frame, and it parses the reply to that frame.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    pub(super) framing: Framing,
    pub(super) transaction: u16,
    pub(super) unit: u8,
    pub(super) function: u8,
    pub(super) address: u16,
    pub(super) count: u16,
    values: Values<'a>,
    /// The name of the point that it reads or writes.
    point: Option<&'static str>,
    /// What the address counts from.
    pub(super) base: Base,
}

impl Request<'static> {
    /// A request that reads `count` items.
    #[must_use]
    pub const fn new(unit: u8, function: u8, address: u16, count: u16) -> Self {
        Self {
            framing: Framing::Rtu,
            transaction: 0,
            unit,
            function,
            address,
            count,
            values: Values::Own([0; 4], 0),
            point: None,
            base: Base::NONE,
        }
    }

    /// A request that reads a point.
    ///
    /// No request reads a text that is longer than the profile allows, or words that are not neighbours: read them by
    /// several [`Block`]s; [`Point::from_received`] takes the items of all their replies.
    #[must_use]
    pub fn read<P: Readable>(unit: u8) -> Self {
        let request = Self::new(unit, read_function(P::SPACE), P::ADDRESS, P::SPAN);
        request.of::<P>()
    }

    /// A request that writes a point's raw number; [`Request::write_words`] writes texts of more than four words.
    #[must_use]
    pub fn write<P: Writable + Whole + WrittenAlone>(unit: u8, raw: P::Raw) -> Self {
        let function = writing_function::<P>();
        Self::own(
            unit,
            function,
            P::WRITE_ADDRESS,
            counted::<P>(P::to_words(raw).as_ref()),
        )
        .of::<P>()
    }

    /// A request that writes a word back with a group of its bits replaced.
    #[must_use]
    pub fn update<P: Writable + BitGroup + WrittenAlone>(unit: u8, word: u16, raw: P::Raw) -> Self {
        let function = writing_function::<P>();
        Self::own(unit, function, P::WRITE_ADDRESS, &[P::insert(word, raw)]).of::<P>()
    }

    /// A request that reads a block.
    #[must_use]
    pub const fn block<D>(unit: u8, block: &Block<D>) -> Self {
        Self::new(unit, block.function, block.address, block.count).counted_from(block.base)
    }

    /// A request that gives a command.
    #[must_use]
    pub fn command<D>(unit: u8, command: &Command<D>) -> Self {
        let value = command.value.unwrap_or(1);
        Self::own(unit, command.function, command.address, &[value])
    }

    fn own(unit: u8, function: u8, address: u16, values: &[u16]) -> Self {
        let mut words = [0; 4];
        for (place, value) in words.iter_mut().zip(values) {
            *place = *value;
        }
        // More values than there is room for make a count that does not fit them, which no frame is built of.
        let count = u16::try_from(values.len()).unwrap_or(u16::MAX);
        Self {
            values: Values::Own(words, values.len().min(words.len())),
            ..Self::new(unit, function, address, count)
        }
    }
}

impl<'a> Request<'a> {
    /// A request that writes a point's words, as [`Whole::to_words`] gives them.
    #[must_use]
    pub fn write_words<P: Writable + Whole + WrittenAlone>(unit: u8, words: &'a [u16]) -> Self {
        Self::write_values(unit, writing_function::<P>(), P::WRITE_ADDRESS, words).of::<P>()
    }

    /// A request that writes words, or bits as 0 and 1.
    #[must_use]
    pub fn write_values(unit: u8, function: u8, address: u16, values: &'a [u16]) -> Self {
        Self {
            framing: Framing::Rtu,
            transaction: 0,
            unit,
            function,
            address,
            count: u16::try_from(values.len()).unwrap_or(u16::MAX),
            values: Values::Lent(values),
            point: None,
            base: Base::NONE,
        }
    }

    /// The same request, whose errors name the point.
    const fn of<P: Point>(self) -> Self {
        Self {
            point: Some(P::NAME),
            base: Base::named(P::BASE),
            ..self
        }
    }

    /// The same request, whose address counts from the base of that name; an empty one is 0.
    #[must_use]
    pub const fn counted_from(self, base: &'static str) -> Self {
        Self {
            base: Base::named(base),
            ..self
        }
    }

    /// The same request, where its base is known; another base than that of its point or block changes nothing.
    #[must_use]
    pub fn at(mut self, base: &Base) -> Self {
        self.place(base);
        self
    }

    /// Says where the base is, if it is this one.
    pub(super) fn place(&mut self, base: &Base) {
        if self.base.name == base.name {
            self.base = *base;
        }
    }

    /// The address on the wire.
    pub(super) const fn wire_address(&self) -> u16 {
        self.address.wrapping_add(self.base.start)
    }

    /// The same request over TCP, as this transaction.
    #[must_use]
    pub const fn tcp(self, transaction: u16) -> Self {
        Self {
            framing: Framing::Tcp,
            transaction,
            ..self
        }
    }

    /// What an error says that it is about.
    pub(super) const fn about(&self) -> About {
        match self.point {
            Some(name) => About::Point(name),
            None => About::Request {
                unit: self.unit,
                function: self.function,
                address: self.address,
                count: self.count,
            },
        }
    }

    /// The unit that is asked.
    #[must_use]
    pub const fn unit(&self) -> u8 {
        self.unit
    }

    /// Writes the frame into `buffer` and returns its length in bytes.
    ///
    /// # Errors
    /// Everything that the device would refuse, and a buffer that is too small.
    pub fn build(&self, profile: &Profile, buffer: &mut [u8]) -> Result<usize, BuildError> {
        self.build_in(profile, buffer).map(<[u8]>::len)
    }

    /// As `build`, and gives the frame.
    pub(super) fn build_in<'b>(
        &self,
        profile: &Profile,
        buffer: &'b mut [u8],
    ) -> Result<&'b [u8], BuildError> {
        self.check(profile)?;
        let mut frame = Writer { buffer, length: 0 };
        if self.framing == Framing::Tcp {
            frame.word(self.transaction);
            frame.word(0);
            frame.word(0); // the length, which stands below
        }
        frame.byte(self.unit);
        frame.byte(self.function);
        frame.word(self.wire_address());
        self.build_data(profile, &mut frame);
        if self.framing == Framing::Rtu {
            let crc = crc(frame.written()?);
            frame.word(crc.swap_bytes());
        }
        let length = frame.length;
        if self.framing == Framing::Tcp {
            frame.length = 4;
            frame.word(length.wrapping_sub(6));
        }
        let frame: &[u8] = frame.buffer;
        frame
            .get(..usize::from(length))
            .ok_or(BuildError::BufferTooSmall)
    }

    fn check(&self, profile: &Profile) -> Result<(), BuildError> {
        if !profile.speaks(self.framing) {
            return Err(BuildError::BadFraming);
        }
        let known = profile.find(self.function);
        let known = known.ok_or(BuildError::BadFunction)?;
        let (least, greatest) = profile.units;
        if profile.is_broadcast(self.unit) {
            if !known.broadcast || is_read(self.function) {
                return Err(BuildError::NotForAll);
            }
        } else if !(least..=greatest).contains(&self.unit) {
            return Err(BuildError::BadUnit);
        }
        let values = self.values.as_slice();
        let missing = !is_read(self.function) && values.len() != usize::from(self.count);
        if self.count == 0 || self.count > known.most || missing {
            return Err(BuildError::BadCount);
        }
        if !self.base.is_known() {
            return Err(BuildError::NoBase);
        }
        let strange = self.function == 8 && self.address != 0;
        let end = self.address.checked_add(self.count - 1);
        let within = end.is_some_and(|end| end <= self.base.last);
        if strange || !within {
            return Err(BuildError::BadAddress);
        }
        let bits = matches!(self.function, 5 | 15);
        if bits && values.iter().any(|value| *value > 1) {
            return Err(BuildError::BadBit);
        }
        Ok(())
    }

    fn build_data(&self, profile: &Profile, frame: &mut Writer<'_>) {
        frame.word(self.echo_value());
        let values = self.values.as_slice();
        match self.function {
            15 => {
                let bytes = coil_bytes(self.count, profile.pad_coil_bytes_even);
                frame.byte(bytes);
                let mut byte = 0;
                for place in 0..usize::from(bytes) * 8 {
                    let is_set = values.get(place).is_some_and(|bit| *bit != 0);
                    byte = byte >> 1 | u8::from(is_set) << 7;
                    if place % 8 == 7 {
                        frame.byte(byte);
                    }
                }
            }
            16 => {
                frame.byte(low_byte(self.count.saturating_mul(2)));
                for value in values {
                    frame.word(*value);
                }
            }
            _ => {}
        }
    }

    /// What is behind the address, which a device repeats that is written to: the value of a single item, else the
    /// count.
    pub(super) fn echo_value(&self) -> u16 {
        let first = self.values.as_slice().first().copied();
        match (self.function, first.unwrap_or_default()) {
            (5, 1..) => 0xFF00,
            (5 | 6 | 8, value) => value,
            _ => self.count,
        }
    }
}

/// The framing of a request that was built: over TCP it says its own length, and no request of RTU looks as if it did.
///
/// ```
/// use fieldscribe_runtime::modbus::{framing_of, Framing};
///
/// assert_eq!(framing_of(b"\x01\x03\x10\x28\x00\x01\x00\xC2"), Framing::Rtu);
/// assert_eq!(framing_of(b"\x00\x07\x00\x00\x00\x06\x01\x03\x10\x28\x00\x01"), Framing::Tcp);
/// ```
#[must_use]
pub fn framing_of(request: &[u8]) -> Framing {
    match *request {
        [_, _, 0, 0, high, low, ..]
            if request.len() >= SHORTEST_TCP
                && usize::from(u16::from_be_bytes([high, low])) + 6 == request.len() =>
        {
            Framing::Tcp
        }
        _ => Framing::Rtu,
    }
}

/// The function that writes a point.
fn writing_function<P: Writable>() -> u8 {
    P::WRITE_FUNCTION.unwrap_or(write_function(P::SPACE, P::WORDS))
}

fn coil_bytes(count: u16, pad_even: bool) -> u8 {
    let bytes = count.div_ceil(8);
    low_byte(if pad_even {
        bytes.saturating_add(bytes % 2)
    } else {
        bytes
    })
}

const fn low_byte(word: u16) -> u8 {
    let [_, low] = word.to_be_bytes();
    low
}

/// Fills a buffer from its start, and counts what it does not hold.
struct Writer<'a> {
    buffer: &'a mut [u8],
    length: u16,
}

impl Writer<'_> {
    #[inline(never)]
    fn byte(&mut self, byte: u8) {
        if let Some(place) = self.buffer.get_mut(usize::from(self.length)) {
            *place = byte;
        }
        self.length = self.length.wrapping_add(1);
    }

    #[inline(never)]
    fn word(&mut self, word: u16) {
        let [high, low] = word.to_be_bytes();
        self.byte(high);
        self.byte(low);
    }

    fn written(&self) -> Result<&[u8], BuildError> {
        let written = self.buffer.get(..usize::from(self.length));
        written.ok_or(BuildError::BufferTooSmall)
    }
}
