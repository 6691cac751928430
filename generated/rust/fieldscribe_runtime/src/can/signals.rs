// SPDX-License-Identifier: 0BSD
//! Messages of signals: numbers in some bits of a frame, which may be one of CAN FD.

use super::{ParseError, Profile};
use crate::point::{counted, counted_mut, joined, split};
use crate::{Decoded, EncodableAlone, Error, NeedsNothing, Point, Raw, Readable};

/// Where a signal lies in its message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal {
    /// The first of its bits as CAN databases count: bit 7 of byte 1 is 15. It is the bit of the lowest value if the
    /// low byte comes first, else that of the highest one.
    pub start: u16,
    /// How many bits it has.
    pub width: u8,
    /// Whether the low byte comes first.
    pub low_first: bool,
    /// Words of other signals with the raw numbers that select this one: all must fit.
    pub when: &'static [(u16, &'static [u16])],
}

/// A message of signals.
pub trait Signals {
    /// The device that has it.
    type Device;
    /// The name in the description.
    const NAME: &'static str;
    /// The identifier, without a unit.
    const ID: u32;
    /// Whether the unit number is added to the identifier.
    const ADDS_UNIT: bool;
    /// How many bytes a frame has.
    const LENGTH: usize;
    /// How often it is sent, in milliseconds.
    const EVERY: Option<u32>;
    /// The signals; each takes a word for 16 bits, the high one first, in their order.
    const SIGNALS: &'static [Signal];
    /// The device that knows it.
    const PROFILE: &'static Profile;
    /// The words of all signals.
    type Words: Copy + AsRef<[u16]> + AsMut<[u16]> + core::fmt::Debug;
    /// These words before anything is put into them.
    const ZERO: Self::Words;
}

/// A point that is a signal of a message.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no signal of a message",
    label = "not in the bits of a frame"
)]
pub trait Carried: Point {
    /// The message.
    type Message: Signals;
}

/// The numbers of all signals of one message.
#[derive(Clone, Debug)]
pub struct Numbers<M: Signals> {
    words: M::Words,
}

impl<M: Signals> Default for Numbers<M> {
    fn default() -> Self {
        Self { words: M::ZERO }
    }
}

impl<M: Signals> Numbers<M> {
    /// The identifier that carries the message to or from a unit.
    #[must_use]
    pub fn id(unit: u8) -> u32 {
        let unit = if M::ADDS_UNIT { u32::from(unit) } else { 0 };
        M::ID.saturating_add(unit)
    }

    /// The numbers in a frame of that unit.
    ///
    /// # Errors
    /// [`ParseError::WrongUnit`] for a unit that the device cannot have, [`ParseError::WrongId`],
    /// [`ParseError::WrongLength`].
    pub fn take(unit: u8, id: u32, data: &[u8]) -> Result<Self, ParseError> {
        if !M::PROFILE.has_unit(unit) {
            return Err(ParseError::WrongUnit);
        }
        if id != Self::id(unit) {
            return Err(ParseError::WrongId);
        }
        if data.len() != M::LENGTH {
            return Err(ParseError::WrongLength);
        }
        let mut numbers = Self::default();
        let mut places = numbers.words.as_mut().iter_mut();
        for signal in M::SIGNALS {
            let raw = signal.get(data);
            for word in signal.words().rev() {
                if let Some(place) = places.next() {
                    *place = low_word(raw.wrapping_shr(16_u32.saturating_mul(word)));
                }
            }
        }
        Ok(numbers)
    }

    /// The frame's data, in as many bytes of `room` as the message has; none if it has fewer. Bits of no signal are 0,
    /// and those of signals that do not come.
    pub fn data<'a>(&self, room: &'a mut [u8]) -> Option<&'a [u8]> {
        let data = room.get_mut(..M::LENGTH)?;
        data.fill(0);
        let words = self.words.as_ref();
        let mut places = words.iter();
        for signal in M::SIGNALS {
            let own = signal.words().filter_map(|_| places.next());
            let raw = own.fold(0, |raw, word| raw << 16 | u64::from(*word));
            if signal.comes(words) {
                signal.set(raw, data);
            }
        }
        Some(data)
    }

    /// A signal's raw number.
    ///
    /// # Errors
    /// [`Error::NotReceived`] if other signals select another one.
    pub fn raw<P: Carried<Message = M>>(&self) -> Result<P::Raw, Error> {
        let mut words = P::Raw::MIN.into_words();
        let held = self.words.as_ref();
        if !comes::<M>(P::ADDRESSES, held) {
            return Err(Error::NotReceived(Some(P::NAME)));
        }
        for (place, address) in counted_mut::<P>(words.as_mut())
            .iter_mut()
            .zip(P::ADDRESSES)
        {
            *place = held.get(usize::from(*address)).copied().unwrap_or_default();
        }
        Ok(joined::<P>(words))
    }

    /// A signal's value.
    ///
    /// # Errors
    /// As for `raw`; what decoding says.
    pub fn value<P>(&self) -> Result<P::Value, Error>
    where
        P: Carried<Message = M> + Readable<Factors: NeedsNothing>,
    {
        P::decode_with(self.raw::<P>()?, NeedsNothing::nothing()).into_result()
    }

    /// Puts a raw number, of which nothing is checked, into the message.
    pub fn put_raw<P: Carried<Message = M>>(&mut self, raw: P::Raw) {
        let words = split::<P>(raw);
        for (word, address) in counted::<P>(words.as_ref()).iter().zip(P::ADDRESSES) {
            if let Some(place) = self.words.as_mut().get_mut(usize::from(*address)) {
                *place = *word;
            }
        }
    }

    /// Puts a value into the message.
    ///
    /// # Errors
    /// Why the value cannot be written.
    pub fn put<P>(&mut self, value: P::Value) -> Result<(), Error>
    where
        P: Carried<Message = M> + EncodableAlone,
    {
        self.put_raw::<P>(P::encode(value)?);
        Ok(())
    }

    /// Puts the numbers that select a signal into the message.
    pub fn select<P: Carried<Message = M>>(&mut self) {
        let Some(signal) = signal_at::<M>(P::ADDRESSES) else {
            return;
        };
        for (word, raws) in signal.when {
            if let (Some(place), Some(raw)) =
                (self.words.as_mut().get_mut(usize::from(*word)), raws.last())
            {
                *place = *raw;
            }
        }
    }
}

/// The signal whose first word stands at the first of these positions.
fn signal_at<M: Signals>(positions: &[u16]) -> Option<&'static Signal> {
    let mut first = 0;
    for signal in M::SIGNALS {
        if positions.first() == Some(&first) {
            return Some(signal);
        }
        first = first.saturating_add(u16::from(signal.width.div_ceil(16)));
    }
    None
}

/// Whether the signal at these positions comes with these words.
fn comes<M: Signals>(positions: &[u16], words: &[u16]) -> bool {
    signal_at::<M>(positions).is_some_and(|signal| signal.comes(words))
}

/// The next bits of a signal: the byte, the lowest of its bits, how many they are, how far they lie above bit 0.
struct Piece {
    byte: usize,
    low: u32,
    bits: u32,
    above: u32,
}

impl Signal {
    /// Its words by number, the low one is 0.
    fn words(&self) -> core::ops::Range<u32> {
        0..u32::from(self.width.div_ceil(16).min(4))
    }

    /// Whether the signal comes with these words.
    fn comes(&self, words: &[u16]) -> bool {
        self.when.iter().all(|(word, raws)| {
            let held = words.get(usize::from(*word));
            held.is_some_and(|held| raws.contains(held))
        })
    }

    /// The bits behind the first `done`, in the order in which bytes travel; none when there are no more.
    fn piece(&self, done: u32) -> Option<Piece> {
        let in_byte = u32::from(self.start % 8);
        let first = if self.low_first {
            in_byte
        } else {
            7_u32.saturating_sub(in_byte)
        };
        let left = u32::from(self.width.min(64))
            .checked_sub(done)
            .filter(|left| *left > 0)?;
        let travelled = first.saturating_add(done);
        let skipped = travelled % 8;
        let bits = 8_u32.saturating_sub(skipped).min(left);
        let byte = usize::from(self.start / 8).saturating_add(usize::try_from(travelled / 8).ok()?);
        let (low, above) = if self.low_first {
            (skipped, done)
        } else {
            (
                8_u32.saturating_sub(skipped).saturating_sub(bits),
                left.saturating_sub(bits),
            )
        };
        Some(Piece {
            byte,
            low,
            bits,
            above,
        })
    }

    /// The raw number in these bytes, without its sign.
    fn get(&self, data: &[u8]) -> u64 {
        let (mut raw, mut done) = (0, 0);
        while let Some(piece) = self.piece(done) {
            let byte = data.get(piece.byte).copied().unwrap_or_default();
            let bits = u64::from(byte).wrapping_shr(piece.low) & ones(piece.bits);
            raw |= bits.wrapping_shl(piece.above);
            done = done.saturating_add(piece.bits);
        }
        raw
    }

    /// Sets bits of the raw number in bytes that are 0 there.
    fn set(&self, raw: u64, data: &mut [u8]) {
        let mut done = 0;
        while let Some(piece) = self.piece(done) {
            let bits = raw.wrapping_shr(piece.above) & ones(piece.bits);
            if let Some(byte) = data.get_mut(piece.byte) {
                let [.., low] = bits.wrapping_shl(piece.low).to_be_bytes();
                *byte |= low;
            }
            done = done.saturating_add(piece.bits);
        }
    }
}

/// So many bits that are 1.
fn ones(bits: u32) -> u64 {
    1_u64.wrapping_shl(bits).wrapping_sub(1)
}

/// The low word of a number.
fn low_word(number: u64) -> u16 {
    let [.., high, low] = number.to_be_bytes();
    u16::from_be_bytes([high, low])
}
