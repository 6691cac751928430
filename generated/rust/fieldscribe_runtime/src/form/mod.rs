// SPDX-License-Identifier: 0BSD
//! What points of one form have in common: a module for each, with the functions that [`point!`](crate::point) calls.

pub mod dated;
pub mod digits;
pub mod flags;
pub mod floating;
pub mod named;
pub mod packed;
pub mod plain;
pub mod ruled;
pub mod scaled;
pub mod text;
pub mod unicode;
pub mod wide;

use crate::check::{beyond, with_fixed_bits};
use crate::error::{Outside, Refused};
use crate::{Error, Raw, Writable};

/// An integer that holds counts.
pub trait Count: Copy + Into<i128> {
    /// The least and the greatest number of the type.
    const ENDS: (i128, i128);
    /// The number of an `i64` without the upper bits that the type does not have.
    fn truncated(number: i64) -> Self;
    /// The number as an `i64`, without the upper bits that this does not have.
    fn to_i64(self) -> i64;
}

macro_rules! count {
    ($($type:ty)+) => {
        $(impl Count for $type {
            const ENDS: (i128, i128) = (<$type>::MIN as i128, <$type>::MAX as i128);

            #[inline]
            fn truncated(number: i64) -> Self {
                number as Self
            }

            #[inline]
            fn to_i64(self) -> i64 {
                self as i64
            }
        })+
    };
}

#[allow(
    clippy::cast_lossless,
    clippy::cast_possible_truncation,
    reason = "it says what is lost"
)]
mod counts {
    use super::Count;

    count!(i32 i64 i128);
}

/// How many counts are one unit.
#[inline]
const fn per_unit(decimals: u32) -> i64 {
    match 10_i64.checked_pow(decimals) {
        Some(power) => power,
        None => 0,
    }
}

/// The raw number that a point without a scale holds, checked.
#[inline]
fn stored<P: Writable>(number: impl Into<i128>, with: P::With) -> Result<P::Raw, Error> {
    let number = number.into();
    let raw = P::Raw::from_i128(number).ok_or_else(|| beyond::<P>(number))?;
    let stored = checked::<P>(with_fixed_bits::<P>(raw), with);
    stored.map_err(|error| error.about(raw.to_i64()))
}

/// The raw number, if it may be written.
#[inline]
fn checked<P: Writable>(raw: P::Raw, with: P::With) -> Result<P::Raw, Error> {
    P::check_with(raw, with)?;
    Ok(raw)
}

/// The nearest raw number, checked; an error gives limits as values, from `decode`.
#[inline]
fn nearest<P: Writable>(
    value: f64,
    scaled: f64,
    with: P::With,
    decode: impl Fn(i128) -> f64,
) -> Result<P::Raw, Error> {
    if scaled.is_nan() {
        return Err(Error::NotANumber(P::NAME));
    }
    let Some(raw) = P::Raw::round(scaled) else {
        let (low, high) = (P::RAW_MIN.to_i64(), P::RAW_MAX.to_i64());
        return Err(refused_value::<P>(value, (low, high), decode));
    };
    match P::check_with(raw, with) {
        Ok(()) => Ok(raw),
        Err(Error::OutOfRange(Refused::Raw(Outside { low, high, .. }))) => {
            Err(refused_value::<P>(value, (low, high), decode))
        }
        Err(error) => Err(error),
    }
}

/// The error for a value between these limits of raw numbers.
fn refused_value<P: Writable>(given: f64, raw: (i64, i64), decode: impl Fn(i128) -> f64) -> Error {
    let (one, other) = (decode(raw.0.into()), decode(raw.1.into()));
    let (low, high) = in_order(one, other, raw.0 <= raw.1);
    Error::OutOfRange(Refused::Value {
        outside: Outside {
            point: P::NAME,
            given,
            low,
            high,
        },
        unit: P::UNIT,
        raw: Some(raw),
    })
}

/// The error for a raw number that a count became, told in counts, which `decode` makes of raw numbers.
fn in_counts(error: Error, given: i64, decode: impl Fn(i64) -> Option<i64>) -> Error {
    let Error::OutOfRange(Refused::Raw(raw)) = error else {
        return error;
    };
    match (decode(raw.low), decode(raw.high)) {
        (Some(one), Some(other)) => {
            let (low, high) = in_order(one, other, raw.low <= raw.high);
            Error::OutOfRange(Refused::Count(Outside {
                point: raw.point,
                given,
                low,
                high,
            }))
        }
        _ => error,
    }
}

/// Two limits, the lower one first; the other way round where the limits leave nothing between them.
pub(crate) fn in_order<T: PartialOrd>(one: T, other: T, is_some_allowed: bool) -> (T, T) {
    if (one <= other) == is_some_allowed {
        (one, other)
    } else {
        (other, one)
    }
}
