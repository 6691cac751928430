// SPDX-License-Identifier: 0BSD
//! Telegrams that arrive in several frames.

use core::fmt;

use super::{Frame, Message, Profile, LENGTH};
use crate::client::MOST_NEEDS;
use crate::point::{counted_mut, joined};
use crate::{
    AnyValue, CountReadable, Decoded, Error, NeedsNothing, PointFacts, PointInfo, Raw, Readable,
};

/// A cyclic layout of words that the frames of a message carry.
pub trait Telegram {
    /// The device that has it; [`AnyDevice`](crate::AnyDevice) if it is not known which.
    type Device;
    /// The name in the description.
    const NAME: &'static str;
    /// The message whose frames carry them.
    const MESSAGE: &'static Message;
    /// The device that sends them.
    const PROFILE: &'static Profile;
    /// A slot for each frame that the words fill.
    type Slots: Copy + AsRef<[Slot]> + AsMut<[Slot]> + fmt::Debug;
    /// The empty slots.
    const EMPTY: Self::Slots;
}

/// A point whose words are in a telegram that the device sends.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not come in the frames of a telegram",
    label = "nothing to wait for",
    note = "a parameter is asked for: `client.read::<P>()`"
)]
pub trait Received: Readable {
    /// The telegram.
    type Telegram: Telegram;
}

/// The words of the last two frames with one multiplexer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    now: Part,
    before: Part,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Part {
    words: [u16; LENGTH / 2],
    /// The numbers of these frames; 0 means none.
    at: u64,
}

impl Slot {
    /// An empty slot.
    pub const EMPTY: Self = Self {
        now: Part::EMPTY,
        before: Part::EMPTY,
    };
}

impl Part {
    const EMPTY: Self = Self {
        words: [0; LENGTH / 2],
        at: 0,
    };

    fn word(&self, place: usize) -> u16 {
        self.words.get(place).copied().unwrap_or_default()
    }
}

/// Takes the frames of a telegram from one unit, and returns its words once they have arrived.
///
/// It is not `Copy`: a copy that takes frames would leave the original unchanged.
#[derive(Clone, Debug)]
pub struct Receiver<T: Telegram> {
    unit: u8,
    clock: u64,
    slots: T::Slots,
}

impl<T: Telegram> Receiver<T> {
    /// A receiver for the telegram of a unit.
    #[must_use]
    pub const fn new(unit: u8) -> Self {
        Self {
            unit,
            clock: 0,
            slots: T::EMPTY,
        }
    }

    /// Takes a frame if it belongs to the telegram, and returns whether it does. No frame belongs to a unit number that
    /// the device cannot have.
    pub fn take(&mut self, frame: &Frame) -> bool {
        if !T::PROFILE.has_unit(self.unit) {
            return false;
        }
        let Some((multiplexer, words)) = T::MESSAGE.part(self.unit, frame) else {
            return false;
        };
        let Some(slot) = self.slots.as_mut().get_mut(usize::from(multiplexer)) else {
            return false;
        };
        self.clock = self.clock.saturating_add(1);
        let at = self.clock;
        slot.before = slot.now;
        slot.now = Part { words, at };
        true
    }

    /// The number of frames taken.
    #[must_use]
    pub const fn taken(&self) -> u64 {
        self.clock
    }

    /// True if all words of a point arrived after this many frames were taken.
    #[must_use]
    pub fn came_since<P: Received<Telegram = T>>(&self, taken: u64) -> bool {
        let came =
            |position: &u16| matches!(self.place(*position), Ok((slot, _)) if slot.now.at > taken);
        P::ADDRESSES.iter().all(came)
    }

    /// The word at a position of the telegram, from 0.
    ///
    /// # Errors
    /// [`Error::NotReceived`].
    pub fn word(&self, position: u16) -> Result<u16, Error> {
        let (slot, place) = self.place(position)?;
        Ok(slot.now.word(place))
    }

    /// A point's raw number.
    ///
    /// # Errors
    /// [`Error::NotReceived`]; [`Error::Torn`] if the number is in two frames and its high word was not the same before
    /// and after the low one.
    pub fn raw<P: Received<Telegram = T>>(&self) -> Result<P::Raw, Error> {
        let mut words = P::Raw::MIN.into_words();
        let found = self.words(P::ADDRESSES, counted_mut::<P>(words.as_mut()));
        found.map_err(Error::of::<P>)?;
        Ok(joined::<P>(words))
    }

    /// A point's value.
    ///
    /// # Errors
    /// As for `raw`; the errors of decoding.
    pub fn value<P>(&self) -> Result<P::Value, Error>
    where
        P: Received<Telegram = T, Factors: NeedsNothing>,
    {
        self.value_with::<P>(NeedsNothing::nothing())
    }

    /// A point's value, by the raw numbers that its scale needs.
    ///
    /// # Errors
    /// The same.
    pub fn value_with<P: Received<Telegram = T>>(
        &self,
        with: P::Factors,
    ) -> Result<P::Value, Error> {
        P::decode_with(self.raw::<P>()?, with).into_result()
    }

    /// A point's count: its value in units of `10^-DECIMALS`, without floating point.
    ///
    /// # Errors
    /// As for `value`.
    pub fn count<P>(&self) -> Result<P::Count, Error>
    where
        P: Received<Telegram = T> + CountReadable<Factors: NeedsNothing>,
    {
        self.count_with::<P>(NeedsNothing::nothing())
    }

    /// A point's count, by the raw numbers that its scale needs.
    ///
    /// # Errors
    /// The same.
    pub fn count_with<P>(&self, with: P::Factors) -> Result<P::Count, Error>
    where
        P: Received<Telegram = T> + CountReadable,
    {
        P::decode_count_with(self.raw::<P>()?, with).into_result()
    }

    /// The value of a point as data; other points that its scale needs are in the same telegram.
    ///
    /// # Errors
    /// As for `value`; [`Error::NotReceived`] for a point of another telegram.
    pub fn value_of(&self, point: PointInfo<T::Device>) -> Result<AnyValue<'static>, Error> {
        let (needs, mut raws) = (point.needs(), [0; MOST_NEEDS]);
        for (place, other) in raws.iter_mut().zip(needs.iter()) {
            *place = self.raw_of(other.facts)?;
        }
        let raw = self.raw_of(point.facts)?;
        point.decode(raw, raws.get(..needs.len()).unwrap_or(&raws))
    }

    /// The raw number of a point as data.
    fn raw_of(&self, point: &PointFacts) -> Result<i128, Error> {
        if point.telegram != Some(T::NAME) {
            return Err(Error::NotReceived(Some(point.name)));
        }
        let mut words = [0; 4];
        let places = words.get_mut(..point.addresses.len()).unwrap_or_default();
        let found = self.words(point.addresses, places);
        found.map_err(|error| error.named(point.name))?;
        Ok(point.raw_of(words))
    }

    /// Stores the words at these positions; two of them are consistent.
    fn words(&self, positions: &[u16], places: &mut [u16]) -> Result<(), Error> {
        if let ([high, low], [first, second]) = (positions, &mut *places) {
            [*first, *second] = self.pair(*high, *low)?;
            return Ok(());
        }
        for (place, position) in places.iter_mut().zip(positions) {
            *place = self.word(*position)?;
        }
        Ok(())
    }

    /// Two consistent words.
    fn pair(&self, high: u16, low: u16) -> Result<[u16; 2], Error> {
        let (above, high) = self.place(high)?;
        let (below, low) = self.place(low)?;
        let word = above.now.word(high);
        if above.now.at == below.now.at {
            return Ok([word, below.now.word(low)]);
        }
        // The low word is accepted if it arrived between two frames with the same high word.
        let (from, to) = (above.before.at, above.now.at);
        let between = |part: &Part| from != 0 && from < part.at && part.at < to;
        if word != above.before.word(high) {
            Err(Error::Torn(None))
        } else if between(&below.now) {
            Ok([word, below.now.word(low)])
        } else if between(&below.before) {
            Ok([word, below.before.word(low)])
        } else {
            Err(Error::Torn(None))
        }
    }

    /// The slot of a position, unless it is empty, and the place of the word in it.
    fn place(&self, position: u16) -> Result<(&Slot, usize), Error> {
        let (position, words) = (usize::from(position), T::MESSAGE.words());
        let slot = position.checked_div(words);
        let place = position.checked_rem(words);
        let slot = slot.and_then(|slot| self.slots.as_ref().get(slot));
        match (slot, place) {
            (Some(slot), Some(place)) if slot.now.at != 0 => Ok((slot, place)),
            _ => Err(Error::NotReceived(None)),
        }
    }
}
