// SPDX-License-Identifier: 0BSD
//! Points whose scale needs no other point, and whose counts of some raw numbers are beyond every type.

use core::marker::PhantomData;

use crate::arithmetic::div_round_i128;
pub use crate::check::within as check;
pub use crate::form::scaled::{encode, encode_count, shown};
use crate::form::{per_unit, scaled};
use crate::scale::Line;
use crate::{Error, FixedScale, Raw};

/// The value: the binary64 number nearest to the exact one.
///
/// # Errors
/// None.
#[inline]
pub fn decode<P: FixedScale, V: From<f64>>(raw: P::Raw, (): ()) -> Result<V, Error> {
    Ok(scaled::value::<P>(raw.to_i128()).into())
}

/// The constants for the counts of a point, computed at compile time.
struct Settled<P>(PhantomData<P>);

impl<P: FixedScale> Settled<P> {
    const LINE: Line = P::SCALE.decoding(per_unit(P::DECIMALS) as i128);
}

/// The count nearest to the value, rounded half away from zero.
///
/// # Errors
/// [`Error::Overflow`].
#[inline]
pub fn decode_count<P: FixedScale, C: TryFrom<i128>>(raw: P::Raw, (): ()) -> Result<C, Error> {
    let line = Settled::<P>::LINE;
    let product = raw.to_i128().checked_mul(line.multiply);
    let sum = product.and_then(|product| product.checked_add(line.add));
    let count = sum.map(|sum| div_round_i128(sum, line.divide.unsigned_abs()));
    let count = count.and_then(|count| C::try_from(count).ok());
    count.ok_or(Error::Overflow(Some(P::NAME)))
}
