// SPDX-License-Identifier: 0BSD
//! Points that are bytes, or texts in other layouts than two characters a word, the first in the high byte.

use crate::form::checked;
use crate::text::Layout;
use crate::{Error, Point, Raw, Text, Writable};

/// A point whose characters stand in words in a layout of its own.
pub trait Packed: Point {
    /// The layout.
    const LAYOUT: Layout;
}

/// Converts words of a layout to a text, and back.
pub trait Packs<W>: Copy {
    /// The text of the words.
    fn unpacked(words: W, layout: Layout) -> Self;
    /// The words of the text; none if one of its characters would end it.
    fn packed(self, layout: Layout) -> Option<W>;
}

impl<const N: usize, const W: usize> Packs<[u16; W]> for Text<N> {
    fn unpacked(words: [u16; W], layout: Layout) -> Self {
        Self::collected(layout.codes(&words))
    }

    fn packed(self, layout: Layout) -> Option<[u16; W]> {
        let words = layout.words(self.as_bytes());
        (Self::unpacked(words, layout) == self).then_some(words)
    }
}

impl<const N: usize, const W: usize> Packs<[u16; W]> for [u8; N] {
    fn unpacked(words: [u16; W], layout: Layout) -> Self {
        let mut codes = layout.codes(&words);
        [0; N].map(|_: u8| codes.next().unwrap_or_default())
    }

    fn packed(self, layout: Layout) -> Option<[u16; W]> {
        Some(layout.words(&self))
    }
}

/// The text.
#[inline]
pub fn decode<P: Packed, V: Packs<P::Raw>>(raw: P::Raw, (): ()) -> V {
    V::unpacked(raw, P::LAYOUT)
}

/// The words of a text, checked.
///
/// # Errors
/// [`Error::BadText`], and those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Packed + Writable, V: Packs<P::Raw>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let words = value.packed(P::LAYOUT);
    checked::<P>(words.ok_or(Error::BadText(Some(P::NAME)))?, with)
}

/// Whether every character is one of Latin-1.
///
/// # Errors
/// [`Error::BadText`].
pub fn check<P: Packed>(raw: P::Raw) -> Result<(), Error> {
    printable::<P>(raw, |code| matches!(code, 0x20..=0x7E | 0xA0..))
}

/// Whether every character is one of ASCII.
///
/// # Errors
/// [`Error::BadText`].
pub fn ascii<P: Packed>(raw: P::Raw) -> Result<(), Error> {
    printable::<P>(raw, |code| matches!(code, 0x20..=0x7E))
}

/// All bytes may be written.
///
/// # Errors
/// None.
pub const fn any<P: Packed>(_: P::Raw) -> Result<(), Error> {
    Ok(())
}

fn printable<P: Packed>(raw: P::Raw, is_printable: fn(u8) -> bool) -> Result<(), Error> {
    let words = raw.into_words();
    if P::LAYOUT.codes(words.as_ref()).all(is_printable) {
        Ok(())
    } else {
        Err(Error::BadText(Some(P::NAME)))
    }
}
