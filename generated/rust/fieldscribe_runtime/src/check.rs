// SPDX-License-Identifier: 0BSD
//! What may be written, and what is said of a number that may not.

use crate::error::{Outside, Refused};
use crate::{Error, Point, Raw, Writable};

/// Whether a raw number is between the point's ends, and has the bits that are always the same.
///
/// # Errors
/// [`Error::OutOfRange`], or [`Error::UnknownValue`] if the point takes only numbers that have names.
#[inline]
pub fn within<P: Writable>(raw: P::Raw) -> Result<(), Error> {
    listed::<P>(raw, P::RAW_MIN <= raw && raw <= P::RAW_MAX)
}

/// The same for a point of several ranges, by whether the number is in one of them.
///
/// # Errors
/// As [`within`].
#[inline]
pub fn listed<P: Writable>(raw: P::Raw, is_listed: bool) -> Result<(), Error> {
    let kept = P::IS_GROUPED || P::FIXED_MASK == 0 || with_fixed_bits::<P>(raw) == raw;
    if is_listed && kept {
        Ok(())
    } else if !kept {
        Err(fixed_bits::<P>(raw.to_i64()))
    } else if P::IS_CLOSED {
        Err(unknown::<P>(raw.to_i64()))
    } else {
        Err(outside::<P>(raw, P::RAW_MIN.to_i64(), P::RAW_MAX.to_i64()))
    }
}

/// The same for a point whose ranges other points set, which are given.
///
/// # Errors
/// As [`within`].
#[inline]
pub fn limited<P: Writable>(raw: P::Raw, ranges: &[(i64, i64)]) -> Result<(), Error> {
    let number = raw.to_i64();
    if ranges
        .iter()
        .any(|(low, high)| *low <= number && number <= *high)
    {
        return listed::<P>(raw, true);
    }
    let low = ranges.iter().map(|range| range.0).min();
    let high = ranges.iter().map(|range| range.1).max();
    Err(outside::<P>(
        raw,
        low.unwrap_or(i64::MIN),
        high.unwrap_or(i64::MAX),
    ))
}

/// The raw number with the point's bits that are always the same.
#[must_use]
#[inline]
pub fn with_fixed_bits<P: Point>(raw: P::Raw) -> P::Raw {
    if P::IS_GROUPED || P::FIXED_MASK == 0 {
        return raw;
    }
    let mut words = raw.into_words();
    let halves = |bits: u32| {
        let [a, b, c, d] = bits.to_be_bytes();
        [u16::from_be_bytes([c, d]), u16::from_be_bytes([a, b])]
    };
    let fixed = halves(P::FIXED_MASK).into_iter().zip(halves(P::FIXED_BITS));
    for (word, (mask, bits)) in words.as_mut().iter_mut().rev().zip(fixed) {
        *word = (*word & !mask) | bits;
    }
    P::Raw::from_words(words)
}

/// The error for a raw number without its constant bits.
#[cold]
fn fixed_bits<P: Point>(given: i64) -> Error {
    let (point, mask, bits) = (P::NAME, P::FIXED_MASK, P::FIXED_BITS);
    Error::OutOfRange(Refused::FixedBits {
        point,
        given,
        mask,
        bits,
    })
}

/// The error for a raw number between others than these.
#[must_use]
pub(crate) fn outside<P: Point>(raw: P::Raw, low: i64, high: i64) -> Error {
    let point = P::NAME;
    let given = raw.to_i64();
    Error::OutOfRange(Refused::Raw(Outside {
        point,
        given,
        low,
        high,
    }))
}

/// The error for a number that has no name.
#[must_use]
pub(crate) fn unknown<P: Point>(given: i64) -> Error {
    let (point, low, high) = (P::NAME, P::RAW_MIN.to_i64(), P::RAW_MAX.to_i64());
    Error::UnknownValue(Outside {
        point,
        given,
        low,
        high,
    })
}

/// The error for a number that the raw type does not hold.
#[must_use]
pub(crate) fn beyond<P: Writable>(number: i128) -> Error {
    if P::IS_CLOSED {
        return unknown::<P>(saturated(number));
    }
    let (point, given) = (P::NAME, saturated(number));
    let (low, high) = (P::RAW_MIN.to_i64(), P::RAW_MAX.to_i64());
    Error::OutOfRange(Refused::Raw(Outside {
        point,
        given,
        low,
        high,
    }))
}

/// The number, or the end of the type that it is beyond.
#[must_use]
pub(crate) fn saturated(number: i128) -> i64 {
    let end = if number < 0 { i64::MIN } else { i64::MAX };
    i64::try_from(number).unwrap_or(end)
}
