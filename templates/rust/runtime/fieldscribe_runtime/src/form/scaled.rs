// SPDX-License-Identifier: 0BSD
//! Points whose scale needs no other point.

use core::marker::PhantomData;

use crate::arithmetic::{div_round_i128, quotient, to_f64};
pub use crate::check::within as check;
use crate::display;
use crate::error::{Outside, Refused};
use crate::form::{in_counts, nearest, per_unit, Count};
use crate::path::Path;
use crate::scale::{below, Line};
use crate::{Error, FixedScale, Raw, Scale, Shown, Writable};

const EXACT: u32 = 53;

/// The constants for a point and a type of its counts, computed at compile time.
struct Settled<P, C>(PhantomData<(P, C)>);

impl<P: FixedScale, C: Count> Settled<P, C> {
    const PER_UNIT: i128 = per_unit(P::DECIMALS) as i128;
    const DECODE: Path = {
        let (low, high) = <P::Raw as Raw>::ENDS;
        Path::new(P::SCALE.decoding(Self::PER_UNIT), low, high)
    };
    const LINE: Line = P::SCALE.encoding(Self::PER_UNIT);
    /// The counts that the type holds and that become raw numbers within reach.
    const COUNTS: (i128, i128) = {
        let (low, high) = Self::LINE.reach(P::RAW_REACH.0, P::RAW_REACH.1);
        let (least, most) = C::ENDS;
        (
            if low < least { least } else { low },
            if high > most { most } else { high },
        )
    };
    const ENCODE: Path = Path::new(Self::LINE, Self::COUNTS.0, Self::COUNTS.1);
}

/// The value: the binary64 number nearest to the exact one.
#[inline]
pub fn decode<P: FixedScale, V: From<f64>>(raw: P::Raw, (): ()) -> V {
    value::<P>(raw.to_i128()).into()
}

/// The count nearest to the value, rounded half away from zero.
#[inline]
pub fn decode_count<P: FixedScale, C: Count>(raw: P::Raw, (): ()) -> C {
    C::truncated(Settled::<P, C>::DECODE.run(raw.to_i64()))
}

/// The constants for the decimals that people see, computed at compile time.
struct Told<P>(PhantomData<P>);

impl<P: FixedScale> Told<P> {
    const LINE: Line = P::SCALE.decoding(display::per_unit::<P>() as i128);
}

/// The value as people see it, rounded from the exact one.
///
/// # Errors
/// [`Error::Overflow`], which never occurs for a point whose decimals were checked.
pub fn shown<P: FixedScale>(raw: P::Raw, (): ()) -> Result<Shown, Error> {
    let line = Told::<P>::LINE;
    let product = raw.to_i128().checked_mul(line.multiply);
    let sum = product.and_then(|product| product.checked_add(line.add));
    let sum = sum.ok_or(Error::Overflow(Some(P::NAME)))?;
    let count = div_round_i128(sum, line.divide.unsigned_abs());
    Ok(Shown::count::<P>(count))
}

/// The raw number nearest to a value, checked; each step is rounded to binary64.
///
/// # Errors
/// Those of [`Writable::check_with`]; [`Error::NotANumber`].
#[inline]
pub fn encode<P: FixedScale + Writable, V: Into<f64>>(
    value: V,
    with: P::With,
) -> Result<P::Raw, Error> {
    let value = value.into();
    nearest::<P>(value, unrounded(P::SCALE, value), with, self::value::<P>)
}

/// The raw number of a value before it is rounded; each step is rounded to binary64.
#[inline]
pub(crate) fn unrounded(scale: Scale, value: f64) -> f64 {
    let ((num, den), (offset, over)) = (scale.ratio(), scale.offset());
    let mut scaled = value;
    if num != 1 {
        scaled *= float(num);
    }
    if den != 1 {
        scaled /= float(den);
    }
    if offset != 0 {
        scaled += fraction(offset, over);
    }
    scaled
}

/// The binary64 number nearest to the value of a raw number, by a line that is known at run time only.
pub(crate) fn exact(line: Line, raw: i128) -> f64 {
    let dividend = raw.wrapping_mul(line.multiply).wrapping_add(line.add);
    quotient(dividend, u64::try_from(line.divide).unwrap_or(0))
}

/// The raw number nearest to a count, halves away from zero, checked.
///
/// # Errors
/// Those of [`Writable::check_with`].
#[inline]
pub fn encode_count<P: FixedScale + Writable, C: Count>(
    count: C,
    with: P::With,
) -> Result<P::Raw, Error> {
    let number = count.to_i64();
    let (low, high) = Settled::<P, C>::COUNTS;
    if !is_within::<C>(number, low, high) {
        return Err(outside::<P, C>(number));
    }
    let raw = P::Raw::truncated(Settled::<P, C>::ENCODE.run(number));
    let all = (P::RAW_MIN.to_i128(), P::RAW_MAX.to_i128());
    if P::IS_CONTIGUOUS && P::RAW_REACH == all {
        return Ok(raw);
    }
    match P::check_with(raw, with) {
        Ok(()) => Ok(raw),
        Err(error) => Err(in_counts(error, number, |raw| {
            Some(Settled::<P, C>::DECODE.run(raw))
        })),
    }
}

/// Whether a count lies between two that its type holds, in one comparison where that has 32 bits.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the width is looked at first"
)]
#[inline]
const fn is_within<C: Count>(number: i64, low: i128, high: i128) -> bool {
    if below(C::ENDS.1, 31) {
        (number as u32).wrapping_sub(low as u32) <= (high as u32).wrapping_sub(low as u32)
    } else {
        low as i64 <= number && number <= high as i64
    }
}

/// The error for a count that becomes no raw number within reach.
#[allow(
    clippy::cast_possible_truncation,
    reason = "counts have 64 bits at most"
)]
#[cold]
fn outside<P: FixedScale, C: Count>(given: i64) -> Error {
    let decode = |raw: P::Raw| Settled::<P, C>::DECODE.run(raw.to_i64());
    let (one, other) = if P::RAW_REACH == (P::RAW_MIN.to_i128(), P::RAW_MAX.to_i128()) {
        let (low, high) = Settled::<P, C>::COUNTS;
        (low as i64, high as i64)
    } else {
        (decode(P::RAW_MIN), decode(P::RAW_MAX))
    };
    Error::OutOfRange(Refused::Count(Outside {
        point: P::NAME,
        given,
        low: one.min(other),
        high: one.max(other),
    }))
}

/// The constants for the values of a point, computed at compile time.
struct Valued<P>(PhantomData<P>);

impl<P: FixedScale> Valued<P> {
    const LINE: Line = P::SCALE.decoding(1);
    const IS_EXACT: bool = Self::fits(EXACT);
    const IS_SMALL: bool = Self::fits(31);

    const fn fits(bits: u32) -> bool {
        let (least, most) = <P::Raw as Raw>::ENDS;
        Self::LINE.fits(least, most, bits)
    }
}

/// The binary64 number nearest to the value of a raw number: one division of integers that are exact, or of 128 bits.
#[allow(
    clippy::cast_possible_truncation,
    reason = "the width is looked at first"
)]
#[inline]
pub(crate) fn value<P: FixedScale>(raw: i128) -> f64 {
    let Line {
        multiply,
        add,
        divide,
    } = Valued::<P>::LINE;
    if !Valued::<P>::IS_EXACT {
        let dividend = raw.wrapping_mul(multiply).wrapping_add(add);
        return quotient(dividend, u64::try_from(divide).unwrap_or(0));
    }
    let dividend = (raw as i64)
        .wrapping_mul(multiply as i64)
        .wrapping_add(add as i64);
    let dividend = if Valued::<P>::IS_SMALL {
        f64::from(dividend as i32)
    } else {
        to_f64(dividend)
    };
    if divide == 1 {
        dividend
    } else {
        dividend / float(divide)
    }
}

/// The binary64 number nearest to an integer.
#[expect(clippy::cast_precision_loss, reason = "nearest is what is asked for")]
#[inline]
const fn float(integer: i128) -> f64 {
    integer as f64
}

/// The binary64 number nearest to a fraction, whose divisor is positive.
#[inline]
fn fraction(num: i128, den: i128) -> f64 {
    if below(num, EXACT) && below(den, EXACT) {
        float(num) / float(den)
    } else {
        quotient(num, u64::try_from(den).unwrap_or(0))
    }
}
