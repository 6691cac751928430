// SPDX-License-Identifier: 0BSD
//! Points that are a date, a time, or both, in parts.

use crate::date_time::{DateForm, DateTime};
use crate::form::checked;
use crate::{Error, Point, Writable};

/// A point with the parts of a date and time.
pub trait Dated: Point<Value: Dates<Self::Raw>> {
    /// The parts.
    const FORM: DateForm;
}

/// Converts words to a date and time, and back.
pub trait Dates<W>: Copy {
    /// The date and time in the words; none if they hold no valid one.
    fn decoded(words: W, form: &DateForm) -> Option<Self>;
    /// The words of the date and time; none if the parts have no room for it.
    fn encoded(self, form: &DateForm) -> Option<W>;
}

impl<const W: usize> Dates<[u16; W]> for DateTime {
    fn decoded(words: [u16; W], form: &DateForm) -> Option<Self> {
        form.decoded(&words)
    }

    fn encoded(self, form: &DateForm) -> Option<[u16; W]> {
        let mut words = [0; W];
        form.encoded(self, &mut words).map(|()| words)
    }
}

/// The date and time.
///
/// # Errors
/// [`Error::Malformed`].
#[inline]
pub fn decode<P: Dated, V: Dates<P::Raw>>(raw: P::Raw, (): ()) -> Result<V, Error> {
    V::decoded(raw, &P::FORM).ok_or(Error::Malformed(Some(P::NAME)))
}

/// The words of a date and time, checked.
///
/// # Errors
/// [`Error::BadDate`], and those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Dated + Writable, V: Dates<P::Raw>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let words = value.encoded(&P::FORM);
    checked::<P>(words.ok_or(Error::BadDate(Some(P::NAME)))?, with)
}

/// Whether the words are a date and time.
///
/// # Errors
/// [`Error::BadDate`].
pub fn check<P: Dated>(raw: P::Raw) -> Result<(), Error> {
    let value = <P as Point>::Value::decoded(raw, &P::FORM);
    value.map(drop).ok_or(Error::BadDate(Some(P::NAME)))
}
