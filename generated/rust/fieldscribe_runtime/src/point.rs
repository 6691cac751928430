// SPDX-License-Identifier: 0BSD
//! The traits of points. Each point of a device is a type that implements [`Point`] and the traits of its access.

use crate::arithmetic::{extract, extract_signed, insert};
use crate::coding::{decoded, encoded};
use crate::data::{PointFacts, Selection};
use crate::info::{Access, PointInfo};
use crate::scale::Scale;
use crate::{Error, Raw, Rule};

/// The place of the words of a point that is only documented: their meaning is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Documented {
    /// The space of the address.
    pub space: Space,
    /// The lowest address.
    pub address: u16,
    /// The number of its words.
    pub words: u16,
    /// Its index in an array.
    pub index: Option<u16>,
}

impl Documented {
    /// The words at an address, with an index.
    #[must_use]
    pub const fn new(space: Space, address: u16, words: u16, index: Option<u16>) -> Self {
        Self {
            space,
            address,
            words,
            index,
        }
    }
}

/// A space of addresses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Space {
    /// Coils: bits that are read and written.
    Coil,
    /// Discrete inputs: bits that are read.
    Discrete,
    /// Input registers: words that are read.
    Input,
    /// Holding registers: words that are read and written.
    Holding,
    /// Parameters: values that a message addresses by number.
    Parameter,
    /// Telegrams: words at positions of a cyclic layout.
    Telegram,
    /// A space of another family.
    Other(&'static str),
}

impl Space {
    /// The space's name in the description.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coil => "coil",
            Self::Discrete => "discrete",
            Self::Input => "input",
            Self::Holding => "holding",
            Self::Parameter => "parameter",
            Self::Telegram => "telegram",
            Self::Other(name) => name,
        }
    }
}

/// One data point of a device.
pub trait Point: Sized {
    /// The device that has the point; [`AnyDevice`](crate::AnyDevice) if it is not known which.
    type Device;
    /// The number on the wire.
    type Raw: Raw;
    /// The type of the value; a [`Reading`](crate::Reading) if the point has special codes.
    type Value: Send;
    /// The point's name in the description.
    const NAME: &'static str;
    /// The manual's own code for the point.
    const CODE: Option<&'static str> = None;
    /// The space of the address.
    const SPACE: Space;
    /// The zero-based address on the wire, the lowest if the point has several words.
    const ADDRESS: u16;
    /// The name of the base that the addresses count from; empty for 0.
    const BASE: &'static str = "";
    /// What other points must hold before the address means this one: clients write it.
    const SELECTS: &'static [Selection] = &[];
    /// The points that the device takes together with this one, in one request; empty if it takes this one alone.
    const WRITTEN_WITH: &'static [&'static str] = &[];
    /// The addresses of all words in reading order: the high part or the first characters first.
    const ADDRESSES: &'static [u16] = &[Self::ADDRESS];
    /// The number of items of the request that reads the point; too many for any request if its words are not adjacent.
    const SPAN: u16 = span(Self::ADDRESSES, Self::WORDS);
    /// The (lowest) address to write the point, usually the address to read it.
    const WRITE_ADDRESS: u16 = Self::ADDRESS;
    /// The index sent with the address, if the point is an element of an array.
    const INDEX: Option<u8> = None;
    /// The telegram whose words the addresses count, if the point is in one.
    const TELEGRAM: Option<&'static str> = None;
    /// The constant bits of the word (of the raw number, if it has several words): they are written as in
    /// [`Point::FIXED_BITS`].
    const FIXED_MASK: u32 = 0;
    /// The values of the bits in [`Point::FIXED_MASK`].
    const FIXED_BITS: u32 = 0;
    /// True if the raw number is the pattern of a binary floating-point number.
    const FLOATING: bool = false;
    /// The number of words, or bits of a bit space, of the point.
    const WORDS: u16 = 1;
    /// The bits of the raw number if its words have fewer bits than its type; else 0. Its words then come first in
    /// [`Raw::Words`], and the words after them are ignored.
    const WIDTH: u32 = 0;
    /// True if the low byte of each word comes first.
    const LOW_BYTE_FIRST: bool = false;
    /// True if the bits have a [coding](crate::coding) of their own.
    const CODED: bool = false;
    /// The decimals of counts, which are in units of `10^-DECIMALS`.
    const DECIMALS: u32 = 0;
    /// The number of decimals to show, if the description has it.
    const DISPLAY_DECIMALS: Option<u32> = None;
    /// For a value that counts seconds from a date: the seconds from 1970-01-01 to that date; else [`None`].
    const EPOCH: Option<i64> = None;
    /// The symbol of the value's unit; empty for a plain number.
    const UNIT: &'static str = "";
    /// The least raw number that the manual allows.
    const RAW_MIN: Self::Raw = <Self::Raw as Raw>::MIN;
    /// The greatest raw number that the manual allows.
    const RAW_MAX: Self::Raw = <Self::Raw as Raw>::MAX;

    /// The mask of the point in a word that it shares with others; [`None`] if it does not share.
    const GROUP: Option<u16> = None;
    /// True if the point is a group of bits in a word that it shares with others.
    const IS_GROUPED: bool = Self::GROUP.is_some();
    /// Whether the point can be read and written.
    const ACCESS: Access = Access::None;
    /// The point as data.
    const INFO: PointInfo<Self::Device> = PointInfo::new(Self::FACTS);
    /// The facts of the point in tables.
    const FACTS: &'static PointFacts = &PointFacts::of::<Self>();

    /// The raw number from the point's words, in the order of their addresses.
    #[inline]
    fn from_words(words: <Self::Raw as Raw>::Words) -> Self::Raw {
        joined_in_order::<Self>(in_reading_order(words, Self::ADDRESSES))
    }

    /// The raw number from received words, in the order of their addresses.
    ///
    /// # Errors
    /// [`Error::WrongLength`] unless there are exactly the point's words.
    fn from_received(mut received: impl Iterator<Item = u16>) -> Result<Self::Raw, Error> {
        let mut words = Self::Raw::MIN.into_words();
        for word in counted_mut::<Self>(words.as_mut()) {
            *word = received
                .next()
                .ok_or(Error::WrongLength(Some(Self::NAME)))?;
        }
        match received.next() {
            Some(_) => Err(Error::WrongLength(Some(Self::NAME))),
            None => Ok(Self::from_words(words)),
        }
    }
}

/// A point that shares no word, so that writing it changes nothing else.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` shares its word with others, which writing it would change",
    label = "a group of bits is not written by itself",
    note = "`client.update::<P>(value)` reads the word, replaces the bits and writes it back",
    note = "in the process data of a drive, `set_bits` and `send_bits` replace them"
)]
pub trait Whole: Point {
    /// The point's words in the order of their addresses.
    #[inline]
    fn to_words(raw: Self::Raw) -> <Self::Raw as Raw>::Words {
        in_address_order(split::<Self>(raw), Self::ADDRESSES)
    }
}

/// A point that is a group of bits in a word that it shares with others.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` is no group of bits: it has its words for itself",
    label = "there is no word around it to read first",
    note = "write it: `client.write::<P>(value)`; in the process data of a drive, `set` or `send` it"
)]
pub trait BitGroup: Point<Raw: Raw<Words = [u16; 1]>> {
    /// The position of the group's lowest bit.
    const SHIFT: u32;
    /// The group's bits in the word.
    const MASK: u16;

    /// The group's number in `word`.
    #[must_use]
    fn extract(word: u16) -> Self::Raw {
        Self::from_words([word])
    }

    /// `word` with the group's number replaced; excess bits are cut off.
    ///
    /// The word's fixed bits are put in too.
    fn insert(word: u16, raw: Self::Raw) -> u16 {
        let [bits] = encoded::<Self>(raw).into_words();
        let word = insert(ordered::<Self>(word), Self::SHIFT, Self::MASK, bits);
        ordered::<Self>((word & !low_word(Self::FIXED_MASK)) | low_word(Self::FIXED_BITS))
    }
}

/// A point that the device takes alone: nothing in [`Point::WRITTEN_WITH`].
#[diagnostic::on_unimplemented(
    message = "the device takes the point `{Self}` only together with others, in one request",
    label = "`{Self}` is not written alone: `{Self}::WRITTEN_WITH` names the others",
    note = "`Request::write_values` takes the words of all"
)]
pub trait WrittenAlone: Point {}

/// The bits of the group in `word`, right-aligned.
#[must_use]
#[inline]
pub fn group<P: BitGroup>(word: u16) -> u16 {
    extract(ordered::<P>(word), P::SHIFT, P::MASK)
}

/// The bits of the group in `word` as a number in two's complement, right-aligned, the sign in all upper bits.
#[must_use]
#[inline]
pub fn signed_group<P: BitGroup>(word: u16) -> u16 {
    extract_signed(ordered::<P>(word), P::SHIFT, P::MASK)
}

/// A word whose decimal digits have a meaning each.
pub trait Digits: Point {
    /// The numbers that each digit may be.
    const NUMBERS: &'static [u16];
}

/// A point whose scale needs no other point.
pub trait FixedScale: Point {
    /// The scale.
    const SCALE: Scale;
    /// The least and the greatest raw number that a value may become, special codes and all.
    const RAW_REACH: (i128, i128) = <Self::Raw as Raw>::ENDS;
}

/// A point whose numbers, or whose digits, have names.
pub trait Named: Point {
    /// The number in the enum: the raw number, or a wider type if points of several types share the enum.
    type Carried: From<Self::Raw> + Into<i128>;
}

/// A point whose scale needs the raw numbers of other points.
pub trait Scaled: Point {
    /// The raw numbers that the scale needs.
    type Factors: Copy + Send;

    /// True if decoding needs divisions of 128 bits.
    const IS_WIDE: bool = false;

    /// True if the raw number is too large for the scale.
    #[must_use]
    fn is_beyond(_: Self::Raw) -> bool {
        false
    }

    /// The scale that applies now.
    ///
    /// # Errors
    /// [`Error::NoCase`], [`Error::ZeroFactor`], [`Error::Overflow`].
    fn rule(with: Self::Factors) -> Result<Rule, Error>;
}

/// The result of decoding: the value if it cannot fail, else a [`Result`].
pub trait Decoded<V> {
    /// The value as a result.
    ///
    /// # Errors
    /// Why the raw number has no value.
    fn into_result(self) -> Result<V, Error>;
}

impl<V> Decoded<V> for V {
    fn into_result(self) -> Result<V, Error> {
        Ok(self)
    }
}

impl<V> Decoded<V> for Result<V, Error> {
    fn into_result(self) -> Result<V, Error> {
        self
    }
}

/// What a point needs of other points; `()` means nothing.
///
/// Functions with and without `_with` at their end do the same; those without take points that need no others.
#[diagnostic::on_unimplemented(
    message = "the point needs the raw numbers of other points, as `{Self}`",
    label = "this function takes points that need no other",
    note = "the function whose name ends in `_with` takes them: `read_with`, `write_with`, `decode_with`, `encode_with`"
)]
pub trait NeedsNothing: Copy + Send {
    /// Nothing.
    #[must_use]
    fn nothing() -> Self;
}

impl NeedsNothing for () {
    #[inline]
    fn nothing() -> Self {}
}

/// A point that can be read.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` is not read: the device only takes it",
    label = "`{Self}` is only written"
)]
pub trait Readable: Point {
    /// The raw numbers of other points that the scale needs; `()` if it needs none.
    type Factors: Copy + Send;
    /// `V` if decoding cannot fail, else `Result<V, Error>`.
    type Output<V>: Decoded<V>;

    /// The value of any raw number that the device may send.
    fn decode_with(raw: Self::Raw, with: Self::Factors) -> Self::Output<Self::Value>;

    /// The value of a raw number, for a point whose scale needs no other.
    fn decode(raw: Self::Raw) -> Self::Output<Self::Value>
    where
        Self::Factors: NeedsNothing,
    {
        Self::decode_with(raw, NeedsNothing::nothing())
    }
}

/// A point that can be written.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` is not written: the device does not take it",
    label = "`{Self}` is only read"
)]
pub trait Writable: Point {
    /// The raw numbers of other points that the scale or the limits need; `()` if they need none.
    type With: Copy + Send;
    /// The function that writes the point, if it is not the usual one of its space.
    const WRITE_FUNCTION: Option<u8> = None;
    /// True if only numbers with names, or only the digits that a word may have, are taken.
    const IS_CLOSED: bool = false;
    /// True if every number from [`Point::RAW_MIN`] to [`Point::RAW_MAX`] may be written.
    const IS_CONTIGUOUS: bool = Self::IS_GROUPED || Self::FIXED_MASK == 0;

    /// Checks that the raw number may be written.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], [`Error::UnknownValue`], [`Error::Special`] for a special code that is only read, and
    /// [`Error::ZeroFactor`] for a limit that divides by zero.
    fn check_with(raw: Self::Raw, with: Self::With) -> Result<(), Error>;

    /// As [`Writable::check_with`], for a point that needs no other.
    ///
    /// # Errors
    /// The same.
    fn check(raw: Self::Raw) -> Result<(), Error>
    where
        Self::With: NeedsNothing,
    {
        Self::check_with(raw, NeedsNothing::nothing())
    }
}

/// A point whose values can be encoded: every writable one, except scales with numbers of more than 53 bits.
#[diagnostic::on_unimplemented(
    message = "values of the point `{Self}` are not written",
    label = "`{Self}` is only read, or no `f64` holds its values",
    note = "where the point is written all the same, `write_count` and `write_raw` take integers"
)]
pub trait Encodable: Writable {
    /// The raw number of a value: nearest, halves away from zero, then checked.
    ///
    /// # Errors
    /// Those of [`Writable::check_with`]; [`Error::NotANumber`], [`Error::NoCase`], [`Error::ZeroFactor`];
    /// [`Error::Special`] for a value that would be a special code.
    fn encode_with(value: Self::Value, with: Self::With) -> Result<Self::Raw, Error>;

    /// As [`Encodable::encode_with`], for a point that needs no other.
    ///
    /// # Errors
    /// The same.
    fn encode(value: Self::Value) -> Result<Self::Raw, Error>
    where
        Self::With: NeedsNothing,
    {
        Self::encode_with(value, NeedsNothing::nothing())
    }
}

/// A point whose values can be encoded and that needs no other.
///
/// A bound of its own, so that the compiler reports one error.
#[diagnostic::on_unimplemented(
    message = "values of the point `{Self}` are not written",
    label = "`{Self}` is only read, or no `f64` holds its values",
    note = "where the point is written all the same, `write_count` and `write_raw` take integers"
)]
pub trait EncodableAlone: Encodable<With: NeedsNothing> {}

impl<P: Encodable<With: NeedsNothing>> EncodableAlone for P {}

/// Decoding in integers: the value as a count of the point's smallest decimal step, or the plain raw number.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` has no counts that are read",
    label = "`{Self}` is not read, or its values are no integers of a smallest step",
    note = "`read` gives its value, `read_raw` its raw number"
)]
pub trait CountReadable: Readable {
    /// The integer that holds a count.
    type Count: Send;

    /// The count nearest to the value, rounded half away from zero.
    fn decode_count_with(raw: Self::Raw, with: Self::Factors) -> Self::Output<Self::Count>;

    /// As [`CountReadable::decode_count_with`], for a point whose scale needs no other.
    fn decode_count(raw: Self::Raw) -> Self::Output<Self::Count>
    where
        Self::Factors: NeedsNothing,
    {
        Self::decode_count_with(raw, NeedsNothing::nothing())
    }
}

/// Encoding in integers: from a count of the point's smallest decimal step, or from the plain raw number.
#[diagnostic::on_unimplemented(
    message = "the point `{Self}` has no counts that are written",
    label = "`{Self}` is only read, or its values are no integers of a smallest step",
    note = "where the point is written all the same, `write` takes its value, `write_raw` its raw number"
)]
pub trait CountWritable: Writable {
    /// The integer that holds a count; wider than what is allowed.
    type Count: Send;

    /// The raw number of a count: nearest, halves away from zero, then checked.
    ///
    /// # Errors
    /// As [`Encodable::encode_with`].
    fn encode_count_with(count: Self::Count, with: Self::With) -> Result<Self::Raw, Error>;

    /// As [`CountWritable::encode_count_with`], for a point that needs no other.
    ///
    /// # Errors
    /// The same.
    fn encode_count(count: Self::Count) -> Result<Self::Raw, Error>
    where
        Self::With: NeedsNothing,
    {
        Self::encode_count_with(count, NeedsNothing::nothing())
    }
}

/// The number of items of a request for these addresses: the words, or too many if they are not adjacent.
pub(crate) const fn span(mut addresses: &[u16], words: u16) -> u16 {
    let (mut low, mut high, scattered) = (u16::MAX, 0, u16::MAX);
    let is_single = addresses.len() == 1;
    while let [address, rest @ ..] = addresses {
        low = if *address < low { *address } else { low };
        high = if *address > high { *address } else { high };
        addresses = rest;
    }
    if is_single || high.saturating_sub(low) < words {
        words
    } else {
        scattered
    }
}

pub(crate) const fn low_word(bits: u32) -> u16 {
    let [_, _, high, low] = bits.to_be_bytes();
    u16::from_be_bytes([high, low])
}

/// The raw number from words in the order of [`Point::ADDRESSES`].
pub(crate) fn joined<P: Point>(words: <P::Raw as Raw>::Words) -> P::Raw {
    if P::WORDS == 1 {
        P::from_words(words)
    } else {
        joined_in_order::<P>(words)
    }
}

/// The raw number from words in reading order; of a number narrower than its type, the bits that it has.
#[inline]
pub(crate) fn joined_in_order<P: Point>(mut words: <P::Raw as Raw>::Words) -> P::Raw {
    order_bytes::<P>(words.as_mut());
    decoded::<P>(bits_in_order::<P>(words))
}

/// The bits of words as they are.
#[inline]
fn bits_in_order<P: Point>(words: <P::Raw as Raw>::Words) -> P::Raw {
    if P::WIDTH == 0 {
        return P::Raw::from_words(words);
    }
    let counted = words.as_ref().iter().take(usize::from(P::WORDS));
    let pattern = counted.fold(0, |pattern: i64, word| (pattern << 16) | i64::from(*word));
    let above = i64::BITS.saturating_sub(P::WIDTH);
    let at_the_top = pattern.wrapping_shl(above);
    P::Raw::truncated(if P::Raw::ENDS.0 < 0 {
        at_the_top.wrapping_shr(above)
    } else {
        i64::from_be_bytes(
            (u64::from_be_bytes(at_the_top.to_be_bytes()).wrapping_shr(above)).to_be_bytes(),
        )
    })
}

/// The words of a raw number in reading order; of a number narrower than its type, those that it has come first.
#[inline]
pub(crate) fn split<P: Point>(raw: P::Raw) -> <P::Raw as Raw>::Words {
    let mut words = encoded::<P>(raw).into_words();
    if P::WIDTH != 0 {
        let above = words.as_ref().len().saturating_sub(usize::from(P::WORDS));
        words.as_mut().rotate_left(above);
    }
    order_bytes::<P>(words.as_mut());
    words
}

/// A word with its bytes in the order of the point.
#[inline]
const fn ordered<P: Point>(word: u16) -> u16 {
    if P::LOW_BYTE_FIRST {
        word.swap_bytes()
    } else {
        word
    }
}

/// The same for each word, except for a group of bits, which was taken out of its word.
#[inline]
fn order_bytes<P: Point>(words: &mut [u16]) {
    if P::LOW_BYTE_FIRST && !P::IS_GROUPED {
        for word in words {
            *word = ordered::<P>(*word);
        }
    }
}

/// The words that the point has.
#[inline]
pub(crate) fn counted<P: Point>(words: &[u16]) -> &[u16] {
    let count = if P::WIDTH == 0 {
        words.len()
    } else {
        usize::from(P::WORDS)
    };
    words.get(..count).unwrap_or(words)
}

/// The same, mutable.
#[inline]
pub(crate) fn counted_mut<P: Point>(words: &mut [u16]) -> &mut [u16] {
    let count = if P::WIDTH == 0 {
        words.len()
    } else {
        usize::from(P::WORDS)
    };
    words.get_mut(..count).unwrap_or_default()
}

/// Words in the order of their addresses as words in reading order, which `addresses` has.
#[must_use]
#[inline]
pub fn in_reading_order<W: Copy + AsRef<[u16]> + AsMut<[u16]>>(words: W, addresses: &[u16]) -> W {
    let mut found = words;
    if addresses.windows(2).any(|pair| pair.first() > pair.last()) {
        for (place, address) in found.as_mut().iter_mut().zip(addresses) {
            let rank = rank(addresses, *address);
            *place = words.as_ref().get(rank).copied().unwrap_or(*place);
        }
    }
    found
}

/// Words in reading order, which `addresses` has, as words in the order of their addresses.
#[must_use]
#[inline]
pub fn in_address_order<W: Copy + AsRef<[u16]> + AsMut<[u16]>>(words: W, addresses: &[u16]) -> W {
    let mut found = words;
    if addresses.windows(2).any(|pair| pair.first() > pair.last()) {
        for (word, address) in words.as_ref().iter().zip(addresses) {
            let rank = rank(addresses, *address);
            if let Some(place) = found.as_mut().get_mut(rank) {
                *place = *word;
            }
        }
    }
    found
}

/// Addresses in ascending order, in which words that need a request each are read and written.
pub(crate) fn ascending(addresses: &'static [u16]) -> impl Iterator<Item = u16> {
    let above = move |last: i32| {
        let others = addresses.iter().copied();
        others.filter(|address| i32::from(*address) > last).min()
    };
    core::iter::successors(above(-1), move |last| above((*last).into()))
}

/// The number of addresses below one.
#[inline]
fn rank(addresses: &[u16], address: u16) -> usize {
    let below = addresses.iter().map(|other| usize::from(*other < address));
    below.fold(0, usize::wrapping_add)
}
