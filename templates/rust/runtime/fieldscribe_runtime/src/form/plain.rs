// SPDX-License-Identifier: 0BSD
//! Points that are their raw numbers, or what is made of these alone.

pub use crate::check::within as check;
use crate::form::stored;
use crate::{Error, Point, Raw, Writable};

/// The raw number, or what is made of it.
#[inline]
pub fn decode<P: Point, V: From<P::Raw>>(raw: P::Raw, (): ()) -> V {
    raw.into()
}

/// The raw number as a count.
#[inline]
pub fn decode_count<P: Point<Raw: Into<C>>, C>(raw: P::Raw, (): ()) -> C {
    raw.into()
}

/// The raw number, checked.
///
/// # Errors
/// What [`Writable::check_with`] says.
#[inline]
pub fn encode<P: Writable, V: Into<P::Raw>>(value: V, with: P::With) -> Result<P::Raw, Error> {
    stored::<P>(value.into().to_i128(), with)
}

/// The raw number of a count, checked.
///
/// # Errors
/// What [`Writable::check_with`] says.
#[inline]
pub fn encode_count<P: Writable, C: Into<i128>>(count: C, with: P::With) -> Result<P::Raw, Error> {
    stored::<P>(count, with)
}
