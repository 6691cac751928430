// SPDX-License-Identifier: 0BSD
//! Points whose numbers have names.

pub use crate::check::within as check;
pub use crate::form::plain::{decode_count, encode_count};
use crate::form::stored;
use crate::{Error, Named, Writable};

/// The name of the raw number.
#[inline]
pub fn decode<P: Named, V: From<P::Carried>>(raw: P::Raw, (): ()) -> V {
    V::from(P::Carried::from(raw))
}

/// The raw number of a name, checked.
///
/// # Errors
/// Those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Named + Writable, V: Into<P::Carried>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    stored::<P>(value.into(), with)
}
