// SPDX-License-Identifier: 0BSD
//! Raw numbers of points that are known at run time only, from words and to words.

use super::{Form, PointFacts, Writing};
use crate::arithmetic::{extract, extract_signed, insert};
use crate::modbus::write_function;
use crate::point::{in_address_order, in_reading_order, low_word};
use crate::Error;

impl PointFacts {
    /// The raw number from the point's words, in the order of their addresses.
    ///
    /// # Errors
    /// [`Error::WrongLength`] unless there are exactly the point's words.
    pub fn raw_from_words(&self, received: impl IntoIterator<Item = u16>) -> Result<i128, Error> {
        let (mut words, mut count) = ([0; 4], 0_u16);
        for (place, word) in received.into_iter().enumerate() {
            count = count.saturating_add(1);
            if let Some(kept) = words.get_mut(place) {
                *kept = word;
            }
        }
        if count == self.words {
            Ok(self.raw_of(in_reading_order(words, self.addresses)))
        } else {
            Err(Error::WrongLength(Some(self.name)))
        }
    }

    /// The raw number from the point's words in reading order, followed by unused words.
    pub(crate) fn raw_of(&self, mut words: [u16; 4]) -> i128 {
        if let (Some(mask), [word, ..]) = (self.mask, &mut words) {
            let is_signed = self.raw.is_signed;
            let take = if is_signed { extract_signed } else { extract };
            *word = take(self.raw.ordered(*word), mask.trailing_zeros(), mask);
        }
        (self.raw.from_words)(words)
    }

    /// The point's words in the order of their addresses, and how many they are; of a group of bits, the word that is
    /// given with the group replaced.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the words do not hold the raw number.
    pub fn words_from_raw(&self, raw: i128, word: u16) -> Result<([u16; 4], usize), Error> {
        let words = in_address_order(self.words_of(raw, word)?, self.addresses);
        Ok((words, usize::from(self.words).min(words.len())))
    }

    /// The point's words in reading order, followed by unused words.
    pub(crate) fn words_of(&self, raw: i128, word: u16) -> Result<[u16; 4], Error> {
        let mut words = (self.raw.into_words)(raw).ok_or_else(|| self.refused(raw))?;
        if let (Some(mask), [first, ..]) = (self.mask, &mut words) {
            let (fixed_mask, fixed_bits) = (low_word(self.fixed.0), low_word(self.fixed.1));
            *first = insert(self.raw.ordered(word), mask.trailing_zeros(), mask, *first);
            *first = self.raw.ordered((*first & !fixed_mask) | fixed_bits);
        }
        Ok(words)
    }

    /// The function that writes the point over Modbus, and the (lowest) address.
    pub(crate) fn write_place(&self) -> (u8, u16) {
        let function = self.writing.and_then(|writing| writing.function);
        let usual = write_function(self.space, self.words);
        (function.unwrap_or(usual), self.write_address)
    }

    /// Whether the raw number is the pattern of a binary floating-point number.
    pub(crate) const fn is_floating(&self) -> bool {
        matches!(self.form, Form::Floating)
    }

    /// Succeeds if the point can be read.
    ///
    /// # Errors
    /// [`Error::Access`].
    pub(crate) const fn readable(&self) -> Result<(), Error> {
        if self.access.reads() {
            Ok(())
        } else {
            Err(Error::Access(self.name, self.access))
        }
    }

    /// Nothing, for a point that the device takes alone.
    ///
    /// # Errors
    /// [`Error::NotTogether`].
    pub(crate) fn written_alone(&self) -> Result<(), Error> {
        let (point, with) = (self.name, self.written_with());
        match with {
            [] => Ok(()),
            _ => Err(Error::NotTogether { point, with }),
        }
    }

    /// What may be written to a point that is written.
    ///
    /// # Errors
    /// [`Error::Access`].
    pub(super) fn writable(&self) -> Result<&Writing, Error> {
        let access = Error::Access(self.name, self.access);
        self.writing.as_ref().ok_or(access)
    }

    /// Succeeds if the address of the point is not a place in a telegram.
    ///
    /// # Errors
    /// [`Error::WrongSpace`].
    pub(crate) const fn outside_telegrams(&self) -> Result<(), Error> {
        match self.telegram {
            None => Ok(()),
            Some(_) => Err(Error::WrongSpace(Some(self.name))),
        }
    }
}
