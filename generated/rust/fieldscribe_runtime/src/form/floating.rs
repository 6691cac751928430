// SPDX-License-Identifier: 0BSD
//! Points whose raw numbers are patterns of binary floating-point numbers.

use crate::error::{Outside, Refused};
use crate::form::checked;
use crate::{Error, Point, Shown, Writable};

/// A pattern of a binary floating-point number.
pub trait Pattern: Copy {
    /// The greatest finite number.
    const GREATEST: f64;
    /// The number.
    fn number(self) -> f64;
    /// The pattern of the number nearest to a value, ties to even; it may be infinite.
    fn nearest(value: f64) -> Self;
}

impl Pattern for u32 {
    const GREATEST: f64 = f32::MAX as f64;

    #[inline]
    fn number(self) -> f64 {
        f64::from(f32::from_bits(self))
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "rounding to binary32 is what is asked for"
    )]
    #[inline]
    fn nearest(value: f64) -> Self {
        (value as f32).to_bits()
    }
}

impl Pattern for u64 {
    const GREATEST: f64 = f64::MAX;

    #[inline]
    fn number(self) -> f64 {
        f64::from_bits(self)
    }

    #[inline]
    fn nearest(value: f64) -> Self {
        value.to_bits()
    }
}

/// The number.
#[inline]
pub fn decode<P: Point<Raw: Pattern>, V: From<f64>>(raw: P::Raw, (): ()) -> V {
    raw.number().into()
}

/// The number as people see it.
///
/// # Errors
/// None.
pub fn shown<P: Point<Raw: Pattern>>(raw: P::Raw, (): ()) -> Result<Shown, Error> {
    Ok(Shown::float::<P>(raw.number()))
}

/// The pattern nearest to a value, checked.
///
/// # Errors
/// Those of [`Writable::check_with`]; [`Error::NotANumber`].
#[inline]
pub fn encode<P: Writable<Raw: Pattern>, V: Into<f64>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let value = value.into();
    if value.is_nan() {
        return Err(Error::NotANumber(P::NAME));
    }
    let raw = P::Raw::nearest(value);
    if !raw.number().is_finite() {
        let greatest = P::Raw::GREATEST;
        return Err(outside::<P>(value, -greatest, greatest));
    }
    match checked::<P>(raw, with) {
        Err(Error::OutOfRange(Refused::Value { outside, .. })) => {
            Err(self::outside::<P>(value, outside.low, outside.high))
        }
        other => other,
    }
}

/// Whether a pattern is a finite number.
///
/// # Errors
/// [`Error::OutOfRange`]; [`Error::NotANumber`].
#[inline]
pub fn check<P: Writable<Raw: Pattern>>(raw: P::Raw) -> Result<(), Error> {
    let greatest = P::Raw::GREATEST;
    ranged::<P>(raw, &[(-greatest, greatest)])
}

/// Whether a pattern is a number in one of the ranges.
///
/// # Errors
/// [`Error::OutOfRange`]; [`Error::NotANumber`].
#[inline]
pub fn ranged<P: Writable<Raw: Pattern>>(raw: P::Raw, ranges: &[(f64, f64)]) -> Result<(), Error> {
    let given = raw.number();
    if given.is_nan() {
        return Err(Error::NotANumber(P::NAME));
    }
    if ranges
        .iter()
        .any(|(low, high)| *low <= given && given <= *high)
    {
        return Ok(());
    }
    let low = ranges
        .iter()
        .fold(f64::INFINITY, |low, range| low.min(range.0));
    let high = ranges
        .iter()
        .fold(f64::NEG_INFINITY, |high, range| high.max(range.1));
    Err(outside::<P>(given, low, high))
}

fn outside<P: Point>(given: f64, low: f64, high: f64) -> Error {
    Error::OutOfRange(Refused::Value {
        outside: Outside {
            point: P::NAME,
            given,
            low,
            high,
        },
        unit: P::UNIT,
        raw: None,
    })
}
