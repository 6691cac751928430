// SPDX-License-Identifier: 0BSD
//! Requests and their telegrams.

use super::{check_byte, element, Link, Parameter, Profile, Reply, LAST_PARAMETER, START};
use crate::point::split;
use crate::{BitGroup, BuildError, Error, Point, Readable, ReplyError, Whole, Writable};

/// What a parameter part carries as a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Nothing.
    Nothing,
    /// One word.
    Word(u16),
    /// Two words.
    Double(u32),
}

impl Value {
    /// The number, if there is one.
    fn number(self) -> Option<u32> {
        match self {
            Self::Nothing => None,
            Self::Word(word) => Some(word.into()),
            Self::Double(value) => Some(value),
        }
    }

    /// Fills in a point's words, which are one or two.
    ///
    /// # Errors
    /// [`Error::WrongLength`] if the value has another number of words.
    pub(super) fn fill(self, words: &mut [u16]) -> Result<(), Error> {
        match (self, words) {
            (Self::Word(word), [only]) => *only = word,
            (Self::Double(value), [high, low]) => {
                let [a, b, c, d] = value.to_be_bytes();
                *high = u16::from_be_bytes([a, b]);
                *low = u16::from_be_bytes([c, d]);
            }
            _ => return Err(Error::WrongLength(None)),
        }
        Ok(())
    }

    /// The value of a point's words, which are one or two.
    fn of(words: &[u16]) -> Option<Self> {
        match *words {
            [word] => Some(Self::Word(word)),
            [high, low] => Some(Self::Double(u32::from(high) << 16 | u32::from(low))),
            _ => None,
        }
    }
}

/// A request to a unit: a task for an element of a parameter. It builds a telegram, and parses the answer to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    pub(super) unit: u8,
    pub(super) task: u8,
    pub(super) parameter: u16,
    pub(super) index: u16,
    value: Value,
}

impl Request {
    /// Returns a task without a value, such as reading.
    #[must_use]
    pub const fn new(unit: u8, task: u8, parameter: u16, index: u16) -> Self {
        Self {
            unit,
            task,
            parameter,
            index,
            value: Value::Nothing,
        }
    }

    /// No task: process data alone.
    #[must_use]
    pub const fn cyclic(unit: u8) -> Self {
        Self::new(unit, 0, 0, 0)
    }

    /// The same with a value.
    #[must_use]
    pub const fn with(self, value: Value) -> Self {
        Self { value, ..self }
    }

    /// A request that reads a parameter.
    #[must_use]
    pub fn read<P: Readable + Parameter>(unit: u8) -> Self {
        Self::new(unit, 1, P::ADDRESS, index::<P>())
    }

    /// A request that changes a parameter's raw number until the power is off.
    #[must_use]
    pub fn write<P: Writable + Whole + Parameter>(unit: u8, raw: P::Raw) -> Self {
        Self::change::<P>(unit, split::<P>(raw).as_ref(), false)
    }

    /// A request that changes a parameter's raw number in the EEPROM too, which survives a limited number of writes.
    #[must_use]
    pub fn store<P: Writable + Whole + Parameter>(unit: u8, raw: P::Raw) -> Self {
        Self::change::<P>(unit, split::<P>(raw).as_ref(), true)
    }

    /// A request that writes a word back with a group of its bits replaced, until the power is off.
    #[must_use]
    pub fn update<P: Writable + BitGroup + Parameter>(unit: u8, word: u16, raw: P::Raw) -> Self {
        Self::change::<P>(unit, &[P::insert(word, raw)], false)
    }

    /// As [`Request::update`], in the EEPROM too.
    #[must_use]
    pub fn store_update<P: Writable + BitGroup + Parameter>(
        unit: u8,
        word: u16,
        raw: P::Raw,
    ) -> Self {
        Self::change::<P>(unit, &[P::insert(word, raw)], true)
    }

    fn change<P: Point>(unit: u8, words: &[u16], keep: bool) -> Self {
        Self::write_words(unit, (P::ADDRESS, P::INDEX), words, keep)
    }

    /// A request that changes the words of an element of a parameter.
    pub(super) fn write_words(
        unit: u8,
        (parameter, index): (u16, Option<u8>),
        words: &[u16],
        keep: bool,
    ) -> Self {
        let value = Value::of(words);
        let task = match (value, index.is_some(), keep) {
            (Some(Value::Word(_)), false, false) => 2,
            (Some(Value::Word(_)), false, true) => 14,
            (Some(Value::Word(_)), true, false) => 7,
            (Some(Value::Word(_)), true, true) => 12,
            (Some(Value::Double(_)), false, false) => 3,
            (Some(Value::Double(_)), false, true) => 13,
            (Some(Value::Double(_)), true, false) => 8,
            (Some(Value::Double(_)), true, true) => 11,
            // No task carries this many words; this number is a task of no device.
            _ => u8::MAX,
        };
        let value = value.unwrap_or(Value::Nothing);
        Self::new(unit, task, parameter, index.map_or(0, u16::from)).with(value)
    }

    /// Returns true if an answer holds the value that the request writes to a parameter.
    ///
    /// A drive may round a binary32 number, which is compared to the nearest thousandth.
    #[must_use]
    pub fn is_confirmed<P: Parameter>(&self, reply: &Reply<'_>) -> bool {
        self.is_answered(reply.value(), P::FLOATING)
    }

    /// The same, by whether the parameter's raw number is the pattern of a floating-point number.
    pub(super) fn is_answered(&self, answer: Value, is_floating: bool) -> bool {
        match (self.value, answer) {
            (Value::Double(written), Value::Double(answered)) if is_floating => {
                is_near(f32::from_bits(written), f32::from_bits(answered))
            }
            (written, answered) => written == answered,
        }
    }

    /// The error that an answer with another value is, by whether the raw number is a floating-point pattern.
    pub(super) fn other_number(&self, answer: Value, is_floating: bool) -> ReplyError {
        let (written, answered) = (self.value.number().unwrap_or_default(), answer.number());
        match answered {
            Some(answered) if is_floating => ReplyError::OtherFloat { written, answered },
            _ => ReplyError::OtherNumber { written, answered },
        }
    }

    /// Writes the telegram with these words of process data into `buffer` and returns its length in bytes.
    ///
    /// # Errors
    /// Everything that the device would refuse, and a buffer that is too small.
    pub fn build(
        &self,
        profile: &Profile,
        link: Link,
        words: &[u16],
        buffer: &mut [u8],
    ) -> Result<usize, BuildError> {
        self.check(profile, link, words)?;
        let [number, index] = element(self.parameter, self.index);
        let [first, second] = match self.value {
            Value::Nothing => [0, 0],
            Value::Word(word) if link.single_last() => [0, word],
            Value::Word(word) => [word, 0],
            Value::Double(value) => {
                let [a, b, c, d] = value.to_be_bytes();
                [u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d])]
            }
        };
        let part = [u16::from(self.task) << 12 | number, index, first, second];
        let part = part.get(..link.sent()).unwrap_or(&part);
        telegram(self.unit, part, words, buffer)
    }

    fn check(&self, profile: &Profile, link: Link, words: &[u16]) -> Result<(), BuildError> {
        let (least, greatest) = profile.units;
        if !profile.takes_pkw(link) || !profile.takes_pzd(link, words) {
            Err(BuildError::BadLink)
        } else if !(least..=greatest).contains(&self.unit) {
            Err(BuildError::BadUnit)
        } else if !profile.knows(self.task) || (link.pkw == 0 && self.task != 0) {
            Err(BuildError::BadTask)
        } else if self.parameter > LAST_PARAMETER {
            Err(BuildError::BadParameter)
        } else if self.index > 255 {
            Err(BuildError::BadIndex)
        } else if matches!(self.value, Value::Double(_)) && link.sent() < 4 {
            Err(BuildError::NoRoom)
        } else {
            Ok(())
        }
    }
}

/// Writes a telegram to all units into `buffer`: which bits of which words are meant, and the words of process data.
///
/// No unit answers.
///
/// # Errors
/// [`BuildError::NoBroadcast`], [`BuildError::BadLink`], [`BuildError::BufferTooSmall`].
pub fn broadcast(
    profile: &Profile,
    link: Link,
    masks: [u16; 4],
    words: &[u16],
    buffer: &mut [u8],
) -> Result<usize, BuildError> {
    let address = profile.broadcast.ok_or(BuildError::NoBroadcast)?;
    if !profile.takes_pzd(link, words) {
        return Err(BuildError::BadLink);
    }
    telegram(address, &masks, words, buffer)
}

/// Returns true if two numbers are equal to the nearest thousandth; false if one of them is NaN.
fn is_near(number: f32, other: f32) -> bool {
    let (number, other) = (f64::from(number), f64::from(other));
    let size = if number < 0.0 { -number } else { number };
    (-size..=size).contains(&((number - other) * 1024.0))
}

fn index<P: Point>() -> u16 {
    P::INDEX.map_or(0, u16::from)
}

fn telegram(
    address: u8,
    part: &[u16],
    words: &[u16],
    buffer: &mut [u8],
) -> Result<usize, BuildError> {
    let count = part.len().saturating_add(words.len());
    let behind = count.saturating_mul(2).saturating_add(2);
    let length = behind.saturating_add(2);
    let behind = u8::try_from(behind).map_err(|_| BuildError::BadLink)?;
    let frame = buffer.get_mut(..length).ok_or(BuildError::BufferTooSmall)?;
    let data = part.iter().chain(words).flat_map(|word| word.to_be_bytes());
    let bytes = [START, behind, address].into_iter().chain(data);
    let mut check = 0;
    for (place, byte) in frame.iter_mut().zip(bytes) {
        *place = byte;
        check ^= byte;
    }
    if let Some(last) = frame.last_mut() {
        *last = check;
    }
    Ok(length)
}

/// Whether a whole telegram has the right check byte.
pub(super) fn is_sound(bytes: &[u8]) -> bool {
    check_byte(bytes) == 0
}
