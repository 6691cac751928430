// SPDX-License-Identifier: 0BSD
//! Codings of raw numbers that are neither plain nor in two's complement: unsigned numbers have decimal digits of four
//! bits each, signed ones a sign, the highest bit, and their magnitude.

use crate::{Point, Raw};

/// The raw number in bits, which were read as they lie.
///
/// Bits that are no decimal number are a number with too many digits: the bits themselves, or the least such number if
/// that is greater. Minus zero is 0.
#[must_use]
#[inline]
pub fn decoded<P: Point>(bits: P::Raw) -> P::Raw {
    if !P::CODED {
        return bits;
    }
    let (pattern, most) = (pattern_of::<P>(bits), most::<P>());
    let number = if is_signed::<P>() {
        let magnitude = pattern & (most >> 1);
        if pattern > most >> 1 {
            magnitude.wrapping_neg()
        } else {
            magnitude
        }
    } else {
        of_digits(pattern, most)
    };
    P::Raw::from_i128(number).unwrap_or(bits)
}

/// The bits of a raw number, as a number that has them.
#[must_use]
#[inline]
pub fn encoded<P: Point>(raw: P::Raw) -> P::Raw {
    if !P::CODED {
        return raw;
    }
    let (number, most) = (raw.to_i128(), most::<P>());
    let bits = if is_signed::<P>() {
        let sign = if number < 0 { most & !(most >> 1) } else { 0 };
        (number.wrapping_abs() & (most >> 1)) | sign
    } else {
        digits_of(number, most)
    };
    P::Raw::from_i128(bits).unwrap_or_else(|| P::Raw::truncated(low_bits(bits)))
}

const fn is_signed<P: Point>() -> bool {
    <P::Raw as Raw>::ENDS.0 < 0
}

/// The greatest pattern of the point.
fn most<P: Point>() -> i128 {
    let bits = match P::GROUP {
        Some(mask) => mask.count_ones(),
        None if P::WIDTH == 0 => u32::from(P::WORDS).saturating_mul(16),
        None => P::WIDTH,
    };
    1_i128.wrapping_shl(bits).wrapping_sub(1)
}

fn pattern_of<P: Point>(bits: P::Raw) -> i128 {
    bits.to_i128() & most::<P>()
}

fn of_digits(pattern: i128, most: i128) -> i128 {
    let (mut number, mut above, mut is_decimal) = (0_i128, 1_i128, true);
    let (mut left, mut room) = (pattern, most);
    while room > 0 {
        let digit = left & 0xF;
        is_decimal &= digit < 10;
        number = number.wrapping_add(digit.wrapping_mul(above));
        above = above.wrapping_mul(10);
        left >>= 4;
        room >>= 4;
    }
    if is_decimal {
        number
    } else {
        pattern.max(above)
    }
}

fn digits_of(number: i128, most: i128) -> i128 {
    let (mut bits, mut left, mut room, mut shift) = (0_i128, number, most, 0_u32);
    while room > 0 {
        bits |= (left % 10).wrapping_shl(shift);
        left /= 10;
        room >>= 4;
        shift = shift.wrapping_add(4);
    }
    if left == 0 {
        bits
    } else {
        number
    }
}

#[allow(clippy::cast_possible_truncation, reason = "the type has no more")]
const fn low_bits(bits: i128) -> i64 {
    bits as i64
}
