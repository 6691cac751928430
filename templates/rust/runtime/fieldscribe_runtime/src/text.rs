// SPDX-License-Identifier: 0BSD
//! Texts in words: two characters a word, the first in the high byte, filled up with blanks.

use core::fmt;

use crate::Error;

/// A text of at most `N` characters of one byte each, without the blanks at its end.
///
/// ```
/// use fieldscribe_runtime::{Error, Text};
///
/// let text: Text<16> = "Generator 1".try_into()?;
/// assert_eq!(text.as_str(), Some("Generator 1"));
/// assert_eq!(Text::<4>::new("too long"), Err(Error::BadText(None)));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Text<const N: usize> {
    bytes: [u8; N],
    length: usize,
}

impl<const N: usize> Text<N> {
    /// No character.
    pub const EMPTY: Self = Self {
        bytes: [BLANK; N],
        length: 0,
    };

    /// Returns the text of a string; characters up to `U+00FF` become bytes of Latin-1.
    ///
    /// # Errors
    /// [`Error::BadText`] if it is longer than `N` characters or has a character beyond `U+00FF`.
    pub fn new(text: &str) -> Result<Self, Error> {
        let mut found = Self::EMPTY;
        let mut places = found.bytes.iter_mut();
        for character in text.chars() {
            let place = places.next().ok_or(Error::BadText(None))?;
            *place = u8::try_from(character).map_err(|_| Error::BadText(None))?;
        }
        Ok(found.measured())
    }

    /// Returns the text of these bytes; every byte is a character.
    ///
    /// # Errors
    /// [`Error::BadText`] if there are more than `N`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut found = Self::EMPTY;
        let places = found.bytes.get_mut(..bytes.len());
        places.ok_or(Error::BadText(None))?.copy_from_slice(bytes);
        Ok(found.measured())
    }

    /// Returns the text in words; characters beyond `N` are ignored.
    #[must_use]
    pub fn from_words(words: &[u16]) -> Self {
        Self::collected(words.iter().flat_map(|word| word.to_be_bytes()))
    }

    /// The words of the text, filled up with blanks.
    #[must_use]
    pub fn into_words<const W: usize>(self) -> [u16; W] {
        let mut words = [u16::from_be_bytes([BLANK, BLANK]); W];
        for (word, pair) in words.iter_mut().zip(self.bytes.chunks(2)) {
            *word = match *pair {
                [high, low] => u16::from_be_bytes([high, low]),
                [high] => u16::from_be_bytes([high, BLANK]),
                _ => *word,
            };
        }
        words
    }

    /// The characters as bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..self.length).unwrap_or(&self.bytes)
    }

    /// The text as a string, if it is all ASCII; [`fmt::Display`] shows the others as Latin-1 has them.
    #[must_use]
    pub fn as_str(&self) -> Option<&str> {
        let bytes = self.as_bytes();
        if bytes.is_ascii() {
            core::str::from_utf8(bytes).ok()
        } else {
            None
        }
    }

    /// The characters, those above `7Fh` as Latin-1 has them.
    pub fn chars(&self) -> impl Iterator<Item = char> + '_ {
        self.as_bytes().iter().copied().map(char::from)
    }

    pub(crate) fn collected(codes: impl Iterator<Item = u8>) -> Self {
        let mut found = Self::EMPTY;
        for (place, code) in found.bytes.iter_mut().zip(codes) {
            *place = code;
        }
        found.measured()
    }

    fn measured(self) -> Self {
        let last = self.bytes.iter().rposition(|byte| *byte != BLANK);
        Self {
            length: last.map_or(0, |place| place.saturating_add(1)),
            ..self
        }
    }
}

const BLANK: u8 = b' ';

impl<const N: usize> Default for Text<N> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<const N: usize> TryFrom<&str> for Text<N> {
    type Error = Error;

    fn try_from(text: &str) -> Result<Self, Error> {
        Self::new(text)
    }
}

impl<const N: usize> TryFrom<&[u8]> for Text<N> {
    type Error = Error;

    fn try_from(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(bytes)
    }
}

impl<const N: usize> AsRef<[u8]> for Text<N> {
    fn as_ref(&self) -> &[u8] {
        self.as_bytes()
    }
}

impl<const N: usize> fmt::Display for Text<N> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chars()
            .try_for_each(|character| fmt::Write::write_char(formatter, character))
    }
}

impl<const N: usize> fmt::Debug for Text<N> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "\"")?;
        for character in self.chars() {
            write!(formatter, "{}", character.escape_debug())?;
        }
        write!(formatter, "\"")
    }
}

/// A text of at most `N` bytes of UTF-8, without the blanks at its end.
///
/// ```
/// use fieldscribe_runtime::{Error, Utf8};
///
/// let text: Utf8<16> = "Kühlung 1".try_into()?;
/// assert_eq!(text.as_str(), "Kühlung 1");
/// assert_eq!(Utf8::<4>::new("Maße"), Err(Error::BadText(None)));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Utf8<const N: usize>(Text<N>);

impl<const N: usize> Utf8<N> {
    /// No character.
    pub const EMPTY: Self = Self(Text::EMPTY);

    /// The text of that string.
    ///
    /// # Errors
    /// [`Error::BadText`] if it has more than `N` bytes.
    pub fn new(text: &str) -> Result<Self, Error> {
        Text::from_bytes(text.as_bytes()).map(Self)
    }

    /// The text of that UTF-8, which is cut to `N` bytes; none if it is not valid UTF-8.
    pub(crate) fn collected(codes: impl Iterator<Item = u8>) -> Option<Self> {
        let text = Text::collected(codes);
        core::str::from_utf8(text.as_bytes())
            .is_ok()
            .then_some(Self(text))
    }

    /// The text as a string.
    #[must_use]
    pub fn as_str(&self) -> &str {
        core::str::from_utf8(self.0.as_bytes()).unwrap_or_default()
    }
}

impl<const N: usize> Default for Utf8<N> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<const N: usize> TryFrom<&str> for Utf8<N> {
    type Error = Error;

    fn try_from(text: &str) -> Result<Self, Error> {
        Self::new(text)
    }
}

impl<const N: usize> AsRef<str> for Utf8<N> {
    fn as_ref(&self) -> &str {
        self.as_str()
    }
}

impl<const N: usize> fmt::Display for Utf8<N> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl<const N: usize> fmt::Debug for Utf8<N> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), formatter)
    }
}

/// The layout of characters in words, if it is not two a word with the first in the high byte.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    characters: usize,
    is_single: bool,
    padding: u8,
    is_low_first: bool,
}

impl Layout {
    /// Returns the layout of this many characters: one or two a word, padded with blanks, or with zeros, which end the
    /// text.
    #[must_use]
    pub const fn new(characters: usize, per_word: usize, padding: u8, is_low_first: bool) -> Self {
        Self {
            characters,
            is_single: per_word == 1,
            padding,
            is_low_first,
        }
    }

    /// The characters in words.
    pub(crate) fn codes(self, words: &[u16]) -> impl Iterator<Item = u8> + '_ {
        let codes = words.iter().flat_map(move |word| {
            let bytes = if self.is_low_first {
                word.to_le_bytes()
            } else {
                word.to_be_bytes()
            };
            bytes.into_iter().skip(usize::from(self.is_single))
        });
        codes
            .take(self.characters)
            .take_while(move |code| self.padding != 0 || *code != 0)
    }

    /// The 16-bit units in words.
    pub(crate) fn units(self, words: &[u16]) -> impl Iterator<Item = u16> + '_ {
        let units = words.iter().take(self.characters);
        units
            .map(move |word| self.in_order(*word))
            .take_while(move |unit| self.padding != 0 || *unit != 0)
    }

    /// The words of 16-bit units, filled up.
    pub(crate) fn words_of_units<const W: usize>(
        self,
        mut units: impl Iterator<Item = u16>,
    ) -> [u16; W] {
        [0; W].map(|_: u16| self.in_order(units.next().unwrap_or(self.padding.into())))
    }

    const fn in_order(self, word: u16) -> u16 {
        if self.is_low_first {
            word.swap_bytes()
        } else {
            word
        }
    }

    /// How many characters there are.
    pub(crate) const fn characters(self) -> usize {
        self.characters
    }

    /// The words of characters, filled up.
    pub(crate) fn words<const W: usize>(self, codes: &[u8]) -> [u16; W] {
        let mut codes = codes.iter().copied();
        let mut next = move || codes.next().unwrap_or(self.padding);
        [0; W].map(|_: u16| {
            let first = if self.is_single { 0 } else { next() };
            let bytes = [first, next()];
            if self.is_low_first {
                u16::from_le_bytes(bytes)
            } else {
                u16::from_be_bytes(bytes)
            }
        })
    }
}

/// Whether all bytes of the words are printable ASCII.
#[must_use]
pub fn is_ascii(words: &[u16]) -> bool {
    all_bytes(words, |byte| matches!(byte, 0x20..=0x7E))
}

/// Whether all bytes of the words are printable characters of Latin-1.
#[must_use]
pub fn is_latin_1(words: &[u16]) -> bool {
    all_bytes(words, |byte| matches!(byte, 0x20..=0x7E | 0xA0..))
}

fn all_bytes(words: &[u16], holds: impl Fn(u8) -> bool) -> bool {
    words.iter().flat_map(|word| word.to_be_bytes()).all(holds)
}
