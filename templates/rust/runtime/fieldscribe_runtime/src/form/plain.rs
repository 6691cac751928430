// SPDX-License-Identifier: 0BSD
//! Points whose values are their raw numbers, or follow from these alone.

pub use crate::check::within as check;
use crate::display::per_unit;
use crate::error::{Outside, Refused};
use crate::form::stored;
use crate::{Error, Point, Raw, Shown, Writable};

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

/// The raw number as people see it.
///
/// # Errors
/// [`Error::Overflow`], which never occurs.
pub fn shown<P: Point>(raw: P::Raw, (): ()) -> Result<Shown, Error> {
    let count = raw.to_i128().checked_mul(per_unit::<P>().into());
    count
        .map(Shown::count::<P>)
        .ok_or(Error::Overflow(Some(P::NAME)))
}

/// The raw number, checked.
///
/// # Errors
/// Those of [`Writable::check_with`].
#[inline]
pub fn encode<P: Writable, V: Into<P::Raw>>(value: V, with: P::With) -> Result<P::Raw, Error> {
    let given = value.into().to_i128();
    stored::<P>(given, with).map_err(|error| in_units::<P>(error, given))
}

/// The error for a value that is its raw number, told in the point's unit if it has one.
#[expect(
    clippy::cast_precision_loss,
    reason = "it is for people: of more than 53 bits the last ones are rounded"
)]
#[cold]
fn in_units<P: Point>(error: Error, given: i128) -> Error {
    match error {
        Error::OutOfRange(Refused::Raw(raw)) if !P::UNIT.is_empty() => {
            let outside = Outside {
                point: raw.point,
                given: given as f64,
                low: raw.low as f64,
                high: raw.high as f64,
            };
            let (unit, raw) = (P::UNIT, None);
            Error::OutOfRange(Refused::Value { outside, unit, raw })
        }
        other => other,
    }
}

/// The raw number of a count, checked.
///
/// # Errors
/// Those of [`Writable::check_with`].
#[inline]
pub fn encode_count<P: Writable, C: Into<i128>>(count: C, with: P::With) -> Result<P::Raw, Error> {
    stored::<P>(count, with)
}
