// SPDX-License-Identifier: 0BSD
//! The facts of a point as data: where it is, and how its raw numbers become values.

use core::fmt;

use crate::point::{joined_in_order, span, split};
use crate::{Access, Code, Error, Point, Raw, Space};

use super::{DataScale, Needs};

/// The name of a point, its place, its access, and the meaning of its raw numbers.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct PointFacts {
    /// The name in the description.
    pub name: &'static str,
    /// The manual's own code.
    pub code: Option<&'static str>,
    /// Where the address counts.
    pub space: Space,
    /// The zero-based address on the wire, the lowest if the point has several words.
    pub address: u16,
    /// What the address counts from, by its name; empty for 0.
    pub base: &'static str,
    /// The addresses of all words in reading order: the high part or the first characters first.
    pub addresses: &'static [u16],
    /// The number of words, or of bits in a bit space, that the point takes.
    pub words: u16,
    /// The point's bits in a word which it shares with others.
    pub mask: Option<u16>,
    /// The index beside the address.
    pub index: Option<u8>,
    /// The telegram whose words the address counts.
    pub telegram: Option<&'static str>,
    /// The symbol of the value's unit; empty for a plain number.
    pub unit: &'static str,
    /// The number of decimals of counts.
    pub decimals: u32,
    /// The number of decimals that people see, if the description gives one.
    pub display_decimals: Option<u32>,
    /// Its access.
    pub access: Access,
    pub(crate) write_address: u16,
    pub(crate) others: fn() -> Others,
    pub(crate) writing: Option<Writing>,
    pub(super) form: Form,
    pub(super) raw: RawType,
    pub(super) ends: (i128, i128),
    pub(super) codes: &'static dyn Codes,
    pub(super) fixed: (u32, u32),
}

/// What a point must hold before an address means another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Selection {
    /// The point, such as a page or an index.
    pub point: &'static PointFacts,
    /// Its raw number.
    pub raw: i128,
}

impl Selection {
    /// Requires that the point holds this raw number.
    #[must_use]
    pub const fn of<P: Point>(raw: i128) -> Self {
        let point = P::FACTS;
        Self { point, raw }
    }
}

/// The other points that a point needs before it is read or written.
#[derive(Clone, Copy, Debug)]
pub struct Others {
    /// The points whose raw numbers decoding needs.
    pub needs: &'static [&'static PointFacts],
    /// What is written before the address means the point.
    pub selects: &'static [Selection],
    /// The names of the points that one request writes together with the point.
    pub written_with: &'static [&'static str],
}

/// Returns what a point needs of others; points without a selection that are written alone share a function.
#[must_use]
pub const fn others<N: Needs, P: Point>() -> fn() -> Others {
    if P::SELECTS.is_empty() && P::WRITTEN_WITH.is_empty() {
        || Others {
            needs: N::points(),
            selects: &[],
            written_with: &[],
        }
    } else {
        || Others {
            needs: N::points(),
            selects: P::SELECTS,
            written_with: P::WRITTEN_WITH,
        }
    }
}

/// How raw numbers become values.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// The value is the raw number.
    Plain,
    /// Numbers have names.
    Named(&'static [(i128, &'static str)]),
    /// A scale that needs no other point.
    Scaled(DataScale),
    /// The raw number is the pattern of a binary floating-point number.
    Floating,
    /// A scale that needs the raw numbers of other points.
    Ruled(ByOthers<i128, f64>),
    /// A text, which has no value here.
    Text,
}

/// A function of a number, and of the raw numbers of other points.
pub type ByOthers<N, R> = fn(N, &[i128]) -> Result<R, Error>;

/// What may be written to a point.
#[derive(Clone, Copy, Debug)]
pub struct Writing {
    /// The ranges, where there are several.
    pub ranges: &'static [(i128, i128)],
    /// True if only numbers with names may be written.
    pub is_closed: bool,
    /// The points whose raw numbers are needed.
    pub needs: fn() -> &'static [&'static PointFacts],
    /// Checks a raw number for writing, if tables cannot decide.
    pub check: Option<ByOthers<i128, ()>>,
    /// Converts a value to a raw number, if tables cannot.
    pub encode: Option<ByOthers<f64, i128>>,
    /// The function that writes, if it is not the usual one.
    pub function: Option<u8>,
}

impl PointFacts {
    /// The number of items in the request that reads the point: [`Point::SPAN`].
    #[must_use]
    pub const fn span(&self) -> u16 {
        span(self.addresses, self.words)
    }

    /// The facts that are constants of the point; [`point!`](crate::point) adds the others.
    #[must_use]
    pub const fn of<P: Point>() -> Self {
        Self {
            name: P::NAME,
            code: P::CODE,
            space: P::SPACE,
            address: P::ADDRESS,
            base: P::BASE,
            addresses: P::ADDRESSES,
            words: P::WORDS,
            mask: P::GROUP,
            index: P::INDEX,
            telegram: P::TELEGRAM,
            unit: P::UNIT,
            decimals: P::DECIMALS,
            display_decimals: P::DISPLAY_DECIMALS,
            access: P::ACCESS,
            write_address: P::WRITE_ADDRESS,
            others: others::<(), P>(),
            writing: None,
            form: Form::Plain,
            raw: RawType::of::<P>(),
            ends: <P::Raw as Raw>::ENDS,
            codes: &NO_CODES,
            fixed: (P::FIXED_MASK, P::FIXED_BITS),
        }
    }

    /// The same with a form.
    #[must_use]
    pub const fn formed(self, form: Form) -> Self {
        Self { form, ..self }
    }

    /// The same with the least and the greatest raw number.
    #[must_use]
    pub const fn within(self, low: i128, high: i128) -> Self {
        let ends = (low, high);
        Self { ends, ..self }
    }

    /// The same with special codes.
    #[must_use]
    pub const fn coded(self, codes: &'static dyn Codes) -> Self {
        Self { codes, ..self }
    }

    /// The same with what reading needs of other points.
    #[must_use]
    pub const fn reading(self, others: fn() -> Others) -> Self {
        Self { others, ..self }
    }

    /// What is written before the address means the point.
    pub(crate) fn selects(&self) -> &'static [Selection] {
        (self.others)().selects
    }

    /// The names of the points that the device takes together with this one, in one request; empty if it takes this
    /// one alone.
    #[must_use]
    pub fn written_with(&self) -> &'static [&'static str] {
        (self.others)().written_with
    }

    /// The same with what may be written.
    #[must_use]
    pub const fn writing(self, writing: Writing) -> Self {
        let writing = Some(writing);
        Self { writing, ..self }
    }

    /// The identity of the point within its device.
    const fn identity(&self) -> (&str, Option<&str>, Space, u16, Option<u8>) {
        let Self {
            name,
            telegram,
            space,
            address,
            index,
            ..
        } = self;
        (name, *telegram, *space, *address, *index)
    }
}

impl fmt::Debug for PointFacts {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, telegram, space, address, index) = self.identity();
        let mut shown = formatter.debug_struct("PointFacts");
        shown.field("name", &name).field("space", &space);
        shown.field("address", &address).field("index", &index);
        shown.field("telegram", &telegram).finish_non_exhaustive()
    }
}

impl PartialEq for PointFacts {
    fn eq(&self, other: &Self) -> bool {
        self.identity() == other.identity()
    }
}

impl Eq for PointFacts {}

impl core::hash::Hash for PointFacts {
    fn hash<H: core::hash::Hasher>(&self, state: &mut H) {
        self.identity().hash(state);
    }
}

type FromWords = fn([u16; 4]) -> i128;
type IntoWords = fn(i128) -> Option<[u16; 4]>;

/// The conversion of a type of raw numbers to words in reading order, and back.
#[derive(Clone, Copy)]
pub(super) struct RawType {
    pub(super) from_words: FromWords,
    pub(super) into_words: IntoWords,
    pub(super) is_signed: bool,
    pub(super) low_byte_first: bool,
}

impl RawType {
    const fn of<P: Point>() -> Self {
        // Points with the usual layout of words share functions, so that programs are smaller and compile faster.
        let is_usual = P::WIDTH == 0 && !P::CODED && !P::LOW_BYTE_FIRST;
        let (from_words, into_words): (FromWords, IntoWords) = if is_usual {
            (joined::<P::Raw>, parted::<P::Raw>)
        } else {
            (
                |words| joined_in_order::<P>(first::<P::Raw>(words)).to_i128(),
                |raw| Some(padded::<P::Raw>(split::<P>(P::Raw::from_i128(raw)?))),
            )
        };
        Self {
            from_words,
            into_words,
            is_signed: <P::Raw as Raw>::ENDS.0 < 0,
            low_byte_first: P::LOW_BYTE_FIRST,
        }
    }

    /// A word with its high byte first, or back.
    pub(super) const fn ordered(&self, word: u16) -> u16 {
        if self.low_byte_first {
            word.swap_bytes()
        } else {
            word
        }
    }
}

fn joined<R: Raw>(words: [u16; 4]) -> i128 {
    R::from_words(first::<R>(words)).to_i128()
}

fn parted<R: Raw>(raw: i128) -> Option<[u16; 4]> {
    Some(padded::<R>(R::from_i128(raw)?.into_words()))
}

/// As many words as the type has.
fn first<R: Raw>(given: [u16; 4]) -> R::Words {
    let mut words = R::MIN.into_words();
    for (word, given) in words.as_mut().iter_mut().zip(given) {
        *word = given;
    }
    words
}

/// The words of the type, and zeros.
fn padded<R: Raw>(given: R::Words) -> [u16; 4] {
    let mut words = [0; 4];
    for (word, given) in words.iter_mut().zip(given.as_ref()) {
        *word = *given;
    }
    words
}

/// The special codes of a point, whatever the type of its raw numbers.
pub trait Codes: Sync {
    /// The name of the code that a raw number is, and whether it may be written.
    fn at(&self, raw: i128) -> Option<(&'static str, bool)>;
    /// The first raw number of the code of that name.
    fn raw(&self, name: &str) -> Option<i128>;
}

const NO_CODES: &[Code<u16>] = &[];

impl<R: Raw + Sync> Codes for &'static [Code<R>] {
    fn at(&self, raw: i128) -> Option<(&'static str, bool)> {
        let raw = R::from_i128(raw)?;
        let special = self.iter().find_map(|code| code.at(raw))?;
        Some((special.name(), special.is_writable()))
    }

    fn raw(&self, name: &str) -> Option<i128> {
        let code = self.iter().find(|code| code.name() == name)?;
        Some(code.ends().0.to_i128())
    }
}
