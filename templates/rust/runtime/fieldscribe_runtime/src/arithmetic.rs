// SPDX-License-Identifier: 0BSD
//! Exact arithmetic: rounding to nearest with halves away from zero, checked steps, bits in words.

pub use crate::rule::Rule;
use crate::{Error, Point, Raw, Writable};

macro_rules! round {
    ($name:ident, $integer:ty, $limit:literal) => {
        /// The integer nearest to `number`, halves away from zero; none if the type cannot hold it.
        #[must_use]
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_precision_loss,
            clippy::cast_lossless,
            reason = "the bounds are checked first; a number beyond 53 bits is whole, and its cast is exact"
        )]
        #[inline]
        pub fn $name(number: f64) -> Option<$integer> {
            // Within the bounds the cast cuts off the fraction alone; NaN is within nothing.
            if !(-$limit..$limit).contains(&number) {
                return None;
            }
            let whole = number as $integer;
            let rest = number - whole as f64;
            if rest >= 0.5 {
                whole.checked_add(1)
            } else if rest <= -0.5 {
                whole.checked_sub(1)
            } else {
                Some(whole)
            }
        }
    };
}

round!(round_i32, i32, 2_147_483_648.5);
round!(round_i64, i64, 9_223_372_036_854_775_808.0);
round!(round_i128, i128, 36_893_488_147_419_103_232.0);

macro_rules! div_round {
    ($name:ident, $integer:ty, $magnitude:ty) => {
        /// `dividend / DIVISOR`, rounded to nearest, halves away from zero.
        #[must_use]
        #[inline]
        pub const fn $name<const DIVISOR: $magnitude>(dividend: $integer) -> $integer {
            // At most 2^(n-1) plus half of a divisor below 2^n: the sum has n bits, nothing wraps.
            let sum = dividend.unsigned_abs().wrapping_add(DIVISOR / 2);
            let Some(quotient) = sum.checked_div(DIVISOR) else {
                return 0;
            };
            if dividend < 0 {
                (0 as $integer).wrapping_sub_unsigned(quotient)
            } else {
                (0 as $integer).wrapping_add_unsigned(quotient)
            }
        }
    };
}

div_round!(div_round_i32, i32, u32);
div_round!(div_round_i64, i64, u64);
div_round!(div_round_i128, i128, u128);

/// The binary64 number nearest to an integer.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "nearest is what is asked for")]
#[inline]
pub const fn to_f64(integer: i64) -> f64 {
    integer as f64
}

/// The binary64 number nearest to a quotient, ties to even; 0 where nothing is divided or by nothing.
#[must_use]
#[expect(
    clippy::cast_precision_loss,
    reason = "nearest is what is asked for, and the lowest bit stands for all that is left over"
)]
#[inline]
pub fn quotient(dividend: i128, divisor: u64) -> f64 {
    let size = dividend.unsigned_abs();
    let up = size.leading_zeros();
    let (Some(size), divisor) = (size.checked_shl(up), u128::from(divisor)) else {
        return 0.0;
    };
    // The quotient has 64 bits at least: what is left over lies far below the half of a step.
    let (Some(whole), Some(rest)) = (size.checked_div(divisor), size.checked_rem(divisor)) else {
        return 0.0;
    };
    let nearest = (whole | u128::from(rest != 0)) as f64;
    let down = f64::from_bits(1023_u64.saturating_sub(u64::from(up)) << 52);
    let value = nearest * down;
    if dividend < 0 {
        -value
    } else {
        value
    }
}

/// A bit out of a count.
///
/// # Errors
/// [`Error::OutOfRange`] if it is neither 0 nor 1.
#[inline]
pub const fn bit(count: i32) -> Result<bool, Error> {
    match count {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(Error::OutOfRange),
    }
}

/// `number`, if it is in `low..=high`.
///
/// # Errors
/// [`Error::OutOfRange`] if it is not.
#[inline]
pub fn within<T: PartialOrd + Copy>(number: T, low: T, high: T) -> Result<T, Error> {
    if number >= low && number <= high {
        Ok(number)
    } else {
        Err(Error::OutOfRange)
    }
}

/// `number`, unless it is not a number.
///
/// # Errors
/// [`Error::NotANumber`].
#[inline]
pub fn number(number: f64) -> Result<f64, Error> {
    if number.is_nan() {
        Err(Error::NotANumber)
    } else {
        Ok(number)
    }
}

/// The last step of encoding: the nearest raw number, checked.
///
/// # Errors
/// What [`Writable::check_with`] says; [`Error::NotANumber`]; [`Error::OutOfRange`] if the type cannot hold the number.
#[inline]
pub fn nearest<P: Writable>(scaled: f64, with: P::With) -> Result<P::Raw, Error> {
    let raw = P::Raw::round(number(scaled)?).ok_or(Error::OutOfRange)?;
    checked::<P>(raw, with)
}

/// A number of the point's raw type.
///
/// # Errors
/// `otherwise`, if the type cannot hold the number.
#[inline]
pub fn held<P: Point>(number: impl TryInto<P::Raw>, otherwise: Error) -> Result<P::Raw, Error> {
    number.try_into().map_err(|_| otherwise)
}

/// A number of the point's raw type, as one that is allowed always is.
///
/// # Errors
/// [`Error::OutOfRange`] if the type cannot hold the number.
#[inline]
pub fn fitted<P: Point>(number: impl TryInto<P::Raw>) -> Result<P::Raw, Error> {
    held::<P>(number, Error::OutOfRange)
}

/// A count as an `i64`.
///
/// # Errors
/// [`Error::Overflow`] if it does not fit.
#[inline]
pub fn narrow(count: i128) -> Result<i64, Error> {
    i64::try_from(count).map_err(|_| Error::Overflow)
}

/// A raw number, if it may be written.
///
/// # Errors
/// What [`Writable::check_with`] says.
#[inline]
pub fn checked<P: Writable>(raw: P::Raw, with: P::With) -> Result<P::Raw, Error> {
    P::check_with(raw, with)?;
    Ok(raw)
}

/// The last step of the integer path: a raw number of the point's type, checked.
///
/// # Errors
/// What [`Writable::check_with`] says; [`Error::OutOfRange`] if the type cannot hold the number.
#[inline]
pub fn store<P: Writable>(raw: impl TryInto<P::Raw>, with: P::With) -> Result<P::Raw, Error> {
    checked::<P>(fitted::<P>(raw)?, with)
}

/// The bits of the binary32 number nearest to `value`, ties to even.
///
/// # Errors
/// [`Error::NotANumber`]; [`Error::OutOfRange`] for infinity and what becomes infinity.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to binary32 is what is asked for"
)]
#[inline]
pub fn f32_bits(value: f64) -> Result<u32, Error> {
    let single = number(value)? as f32;
    if single.is_finite() {
        Ok(single.to_bits())
    } else {
        Err(Error::OutOfRange)
    }
}

/// The bits of a binary64 number.
///
/// # Errors
/// [`Error::NotANumber`]; [`Error::OutOfRange`] for infinity.
#[inline]
pub fn f64_bits(value: f64) -> Result<u64, Error> {
    if number(value)?.is_finite() {
        Ok(value.to_bits())
    } else {
        Err(Error::OutOfRange)
    }
}

/// The number that a binary32 pattern is.
///
/// # Errors
/// [`Error::NotANumber`].
#[inline]
pub fn f32_number(bits: u32) -> Result<f64, Error> {
    number(f64::from(f32::from_bits(bits)))
}

/// The number that a binary64 pattern is.
///
/// # Errors
/// [`Error::NotANumber`].
#[inline]
pub fn f64_number(bits: u64) -> Result<f64, Error> {
    number(f64::from_bits(bits))
}

/// The bits of the group in `word`, right-aligned.
#[must_use]
#[inline]
pub const fn extract(word: u16, shift: u32, mask: u16) -> u16 {
    match (word & mask).checked_shr(shift) {
        Some(bits) => bits,
        None => 0,
    }
}

/// The bits of the group in `word` as a number in two's complement, right-aligned, the sign in all upper bits.
#[must_use]
#[inline]
pub const fn extract_signed(word: u16, shift: u32, mask: u16) -> u16 {
    let above = mask.leading_zeros();
    let Some(left) = (word & mask).checked_shl(above) else {
        return 0;
    };
    match i16::from_be_bytes(left.to_be_bytes()).checked_shr(above + shift) {
        Some(bits) => u16::from_be_bytes(bits.to_be_bytes()),
        None => 0,
    }
}

/// `word` with the group replaced by the low bits of `bits`.
#[must_use]
#[inline]
pub const fn insert(word: u16, shift: u32, mask: u16, bits: u16) -> u16 {
    match bits.checked_shl(shift) {
        Some(placed) => (word & !mask) | (placed & mask),
        None => word,
    }
}

/// An exponent, if it is in `low..=high`, where its point may be.
///
/// # Errors
/// [`Error::Overflow`] if it is not.
#[inline]
pub fn exponent(raw: i64, low: i64, high: i64) -> Result<i64, Error> {
    within(raw, low, high).map_err(|_| Error::Overflow)
}

/// `raw * slope + intercept`: what a factor takes from a point.
///
/// # Errors
/// [`Error::Overflow`].
#[inline]
pub fn line(raw: i64, slope: i64, intercept: i64) -> Result<i64, Error> {
    let product = raw.checked_mul(slope).ok_or(Error::Overflow)?;
    product.checked_add(intercept).ok_or(Error::Overflow)
}
