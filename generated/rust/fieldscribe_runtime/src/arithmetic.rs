// SPDX-License-Identifier: 0BSD
//! Exact arithmetic: rounding to nearest with halves away from zero, checked steps, bits in words.

use crate::{Error, Outside, Raw};

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
        /// `dividend / divisor`, rounded to nearest, halves away from zero; 0 where nothing is divided by.
        #[must_use]
        #[inline]
        pub const fn $name(dividend: $integer, divisor: $magnitude) -> $integer {
            // At most 2^(n-1) plus half of a divisor below 2^n: the sum has n bits, nothing wraps.
            let sum = dividend.unsigned_abs().wrapping_add(divisor / 2);
            let Some(quotient) = sum.checked_div(divisor) else {
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
    match i16::from_be_bytes(left.to_be_bytes()).checked_shr(above.saturating_add(shift)) {
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

/// The raw number of the point of that name, an exponent or a factor, if it is in `low..=high`.
///
/// # Errors
/// [`Error::BrokenFactor`] if it is not.
#[inline]
pub fn exponent(point: &'static str, raw: impl Raw, low: i64, high: i64) -> Result<i64, Error> {
    let given = raw.to_i64();
    if low <= given && given <= high {
        Ok(given)
    } else {
        Err(Error::BrokenFactor {
            factor: Outside {
                point,
                given,
                low,
                high,
            },
            point: None,
        })
    }
}

/// `raw * slope + intercept`: what a factor takes from a point.
///
/// # Errors
/// [`Error::Overflow`].
#[inline]
pub fn line(raw: impl Raw, slope: i64, intercept: i64) -> Result<i64, Error> {
    let product = raw
        .to_i64()
        .checked_mul(slope)
        .ok_or(Error::Overflow(None))?;
    product.checked_add(intercept).ok_or(Error::Overflow(None))
}
