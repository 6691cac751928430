// SPDX-License-Identifier: 0BSD
//! Points that are texts.

use crate::form::checked;
use crate::text::{is_ascii, is_latin_1};
use crate::{Error, Point, Raw, Text, Writable};

/// Converts words to a text, and back.
pub trait Words<W>: Copy {
    /// The text of the words.
    fn from_raw(words: W) -> Self;
    /// The words of the text.
    fn into_raw(self) -> W;
}

impl<const N: usize, const W: usize> Words<[u16; W]> for Text<N> {
    #[inline]
    fn from_raw(words: [u16; W]) -> Self {
        Self::from_words(&words)
    }

    #[inline]
    fn into_raw(self) -> [u16; W] {
        self.into_words()
    }
}

/// The text.
#[inline]
pub fn decode<P: Point, V: Words<P::Raw>>(raw: P::Raw, (): ()) -> V {
    V::from_raw(raw)
}

/// The words of a text, checked.
///
/// # Errors
/// Those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Writable, V: Words<P::Raw>>(value: V, with: P::With) -> Result<P::Raw, Error> {
    checked::<P>(value.into_raw(), with)
}

/// Whether every character is one of Latin-1.
///
/// # Errors
/// [`Error::BadText`].
pub fn check<P: Writable>(raw: P::Raw) -> Result<(), Error> {
    if is_latin_1(raw.into_words().as_ref()) {
        Ok(())
    } else {
        Err(Error::BadText(Some(P::NAME)))
    }
}

/// Whether every character is one of ASCII.
///
/// # Errors
/// [`Error::BadText`].
pub fn ascii<P: Writable>(raw: P::Raw) -> Result<(), Error> {
    if is_ascii(raw.into_words().as_ref()) {
        Ok(())
    } else {
        Err(Error::BadText(Some(P::NAME)))
    }
}
