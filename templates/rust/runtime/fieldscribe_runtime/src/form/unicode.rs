// SPDX-License-Identifier: 0BSD
//! Points that are texts of UTF-8 or UTF-16.

use crate::form::checked;
use crate::form::packed::Packed;
use crate::text::Layout;
use crate::{Error, Point, Utf8, Writable};

/// A text in UTF-8, with its bytes packed like characters, or in UTF-16, with one unit of 16 bits in each word.
pub trait Unicode: Packed<Value: Units<Self::Raw>> {
    /// How many bits a unit has: 8 or 16.
    const BITS: u32;
}

/// Converts units in words to a text, and back.
pub trait Units<W>: Copy {
    /// The text of the words; none if they are not valid Unicode.
    fn decoded(words: W, layout: Layout, bits: u32) -> Option<Self>;
    /// The words of the text; none if it does not fit or has a control character.
    fn encoded(self, layout: Layout, bits: u32) -> Option<W>;
}

impl<const N: usize, const W: usize> Units<[u16; W]> for Utf8<N> {
    fn decoded(words: [u16; W], layout: Layout, bits: u32) -> Option<Self> {
        if bits == 8 {
            return Self::collected(layout.codes(&words));
        }
        let mut is_whole = true;
        let characters = char::decode_utf16(layout.units(&words)).map_while(|character| {
            is_whole &= character.is_ok();
            character.ok()
        });
        let codes = characters.flat_map(|character| {
            let mut buffer = [0; 4];
            let length = character.encode_utf8(&mut buffer).len();
            buffer.into_iter().take(length)
        });
        Self::collected(codes).filter(|_| is_whole)
    }

    fn encoded(self, layout: Layout, bits: u32) -> Option<[u16; W]> {
        let text = self.as_str();
        let is_long = if bits == 8 {
            text.len() > layout.characters()
        } else {
            text.encode_utf16().nth(layout.characters()).is_some()
        };
        if is_long || text.chars().any(char::is_control) {
            return None;
        }
        Some(if bits == 8 {
            layout.words(text.as_bytes())
        } else {
            layout.words_of_units(text.encode_utf16())
        })
    }
}

/// The text.
///
/// # Errors
/// [`Error::Malformed`].
#[inline]
pub fn decode<P: Unicode, V: Units<P::Raw>>(raw: P::Raw, (): ()) -> Result<V, Error> {
    V::decoded(raw, P::LAYOUT, P::BITS).ok_or(Error::Malformed(Some(P::NAME)))
}

/// The words of a text, checked.
///
/// # Errors
/// [`Error::BadText`], and those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Unicode + Writable, V: Units<P::Raw>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let words = value.encoded(P::LAYOUT, P::BITS);
    checked::<P>(words.ok_or(Error::BadText(Some(P::NAME)))?, with)
}

/// Whether the words are a text without control characters.
///
/// # Errors
/// [`Error::BadText`].
pub fn check<P: Unicode>(raw: P::Raw) -> Result<(), Error> {
    let text = <P as Point>::Value::decoded(raw, P::LAYOUT, P::BITS);
    let words = text.and_then(|text| text.encoded(P::LAYOUT, P::BITS));
    words.map(drop).ok_or(Error::BadText(Some(P::NAME)))
}
