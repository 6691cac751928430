// SPDX-License-Identifier: 0BSD
//! Points whose decimal digits each have a name.

use crate::check::unknown;
use crate::digits::{join, split};
use crate::form::checked;
use crate::{Digits, Error, Named, Raw, Writable};

/// The names of so many digits.
pub trait Names<C> {
    /// The names of the digits of a number.
    fn of(number: u16) -> Self;
    /// The number of digits with these names.
    ///
    /// # Errors
    /// [`Error::UnknownValue`].
    fn joined<P: Digits>(self) -> Result<u16, Error>;
}

impl<C: From<u16> + Into<i128>, V: From<C> + Into<C>, const N: usize> Names<C> for [V; N] {
    #[inline]
    fn of(number: u16) -> Self {
        split(number).map(|digit| V::from(C::from(digit)))
    }

    #[inline]
    fn joined<P: Digits>(self) -> Result<u16, Error> {
        join::<P>(&self.map(|digit| -> i128 { digit.into().into() }))
    }
}

/// The name of each digit.
#[inline]
pub fn decode<P: Named<Raw: Into<u16>>, V: Names<P::Carried>>(raw: P::Raw, (): ()) -> V {
    V::of(raw.into())
}

/// The raw number of digits, checked.
///
/// # Errors
/// [`Error::UnknownValue`].
#[inline]
pub fn encode<P: Digits + Named + Writable, V: Names<P::Carried>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let number = value.joined::<P>()?;
    let raw = P::Raw::from_i128(number.into());
    checked::<P>(raw.ok_or_else(|| unknown::<P>(number.into()))?, with)
}

/// Whether each of the `N` digits is one of the point's numbers.
///
/// # Errors
/// [`Error::UnknownValue`].
#[inline]
pub fn check<P: Digits<Raw: Into<u16>>, const N: usize>(raw: P::Raw) -> Result<(), Error> {
    crate::digits::check::<P, N>(raw.into())
}
