// SPDX-License-Identifier: 0BSD
//! Factors that are binary32 numbers: taken apart into integers, and exact quotients of such.

use core::cmp::Ordering;

use crate::arithmetic::to_f64;

/// The magnitude of a finite number that is not zero: an odd `mantissa` times two to the power of `exponent`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Magnitude {
    pub mantissa: u64,
    pub exponent: i32,
}

impl Magnitude {
    /// Nothing multiplied yet.
    pub const ONE: Self = Self {
        mantissa: 1,
        exponent: 0,
    };

    /// Whether the binary32 number of that pattern is negative, and its magnitude; none for zero, infinity and NaN.
    #[inline]
    pub fn of_f32(bits: u32) -> Option<(bool, Self)> {
        let fraction = bits & 0x007F_FFFF;
        let [high, low, ..] = bits.to_be_bytes();
        let (mantissa, power) = match high << 1 | low >> 7 {
            0 if fraction == 0 => return None,
            255 => return None,
            0 => (fraction, 1),
            power => (fraction | 0x0080_0000, power),
        };
        let zeros = mantissa.trailing_zeros();
        let magnitude = Self {
            mantissa: u64::from(mantissa.checked_shr(zeros)?),
            exponent: i32::from(power) - 150 + i32::try_from(zeros).ok()?,
        };
        Some((bits >> 31 == 1, magnitude))
    }

    /// The product; none if its mantissa has more than 64 bits.
    #[inline]
    pub fn times(self, other: Self) -> Option<Self> {
        Some(Self {
            mantissa: self.mantissa.checked_mul(other.mantissa)?,
            exponent: self.exponent.checked_add(other.exponent)?,
        })
    }

    /// The number in binary64, exact for one factor or two.
    #[inline]
    pub fn to_f64(self) -> f64 {
        let power = self.exponent.saturating_add(1023).clamp(0, 2046);
        let two_to = f64::from_bits(u64::from(power.unsigned_abs()) << 52);
        to_f64(i64::try_from(self.mantissa).unwrap_or(i64::MAX)) * two_to
    }
}

/// What is left behind the integer part of a number, as far as rounding needs it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Rest {
    Nothing,
    BelowHalf,
    Half,
    AboveHalf,
}

impl Rest {
    /// The rest of the negative number, which counts from the next lower integer.
    const fn turned(self) -> Self {
        match self {
            Self::BelowHalf => Self::AboveHalf,
            Self::AboveHalf => Self::BelowHalf,
            same => same,
        }
    }

    /// The rest after a division by two of a number whose integer part was odd or even.
    const fn halved(self, odd: bool) -> Self {
        match (odd, self) {
            (false, Self::Nothing) => Self::Nothing,
            (false, _) => Self::BelowHalf,
            (true, Self::Nothing) => Self::Half,
            (true, _) => Self::AboveHalf,
        }
    }
}

/// An exact quotient of magnitudes: `dividend / divisor * 2^exponent`, with its sign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quotient {
    pub negative: bool,
    pub dividend: u128,
    pub divisor: u128,
    pub exponent: i32,
}

impl Quotient {
    /// `(self + num) / den`, rounded to nearest, halves away from zero; none if it is beyond every type.
    ///
    /// `den` is positive.
    pub fn plus_over(self, num: i64, den: i64) -> Option<i64> {
        let (whole, rest) = self.divide()?;
        let whole = i128::try_from(whole).ok()?;
        let (floor, rest) = if self.negative {
            let step = i128::from(rest != Rest::Nothing);
            (whole.checked_neg()?.checked_sub(step)?, rest.turned())
        } else {
            (whole, rest)
        };
        let (sum, den) = (floor.checked_add(i128::from(num))?, i128::from(den));
        let below = sum.checked_div_euclid(den)?;
        let over = sum.checked_rem_euclid(den)?;
        // Behind `below` is (over + rest) / den; it is compared with a half.
        let against_half = match den.checked_sub(over.checked_mul(2)?)? {
            ..0 => Ordering::Greater,
            0 => rest.cmp(&Rest::Nothing),
            1 => rest.cmp(&Rest::Half),
            _ => Ordering::Less,
        };
        let up = match against_half {
            Ordering::Less => false,
            Ordering::Equal => below >= 0,
            Ordering::Greater => true,
        };
        i64::try_from(below.checked_add(i128::from(up))?).ok()
    }

    /// The integer part and the rest: long division bit by bit, given up as soon as the quotient is too long.
    fn divide(self) -> Option<(u128, Rest)> {
        let mut whole = self.dividend.checked_div(self.divisor)?;
        let mut left = self.dividend.checked_rem(self.divisor)?;
        for _ in 0..self.exponent {
            let twice = left.checked_mul(2)?;
            let bit = twice >= self.divisor;
            left = if bit {
                twice.wrapping_sub(self.divisor)
            } else {
                twice
            };
            whole = whole.checked_mul(2)? | u128::from(bit);
            if whole == 0 && left == 0 {
                break;
            }
        }
        let mut rest = match left.checked_mul(2)?.cmp(&self.divisor) {
            _ if left == 0 => Rest::Nothing,
            Ordering::Less => Rest::BelowHalf,
            Ordering::Equal => Rest::Half,
            Ordering::Greater => Rest::AboveHalf,
        };
        for _ in self.exponent..0 {
            rest = rest.halved(whole & 1 == 1);
            whole >>= 1;
            if whole == 0 && rest <= Rest::BelowHalf {
                break;
            }
        }
        Some((whole, rest))
    }
}

#[cfg(test)]
mod tests {
    use super::{Magnitude, Quotient};

    #[test]
    fn takes_patterns_apart() {
        for bits in [
            1,
            0x0080_0000,
            0x3DCC_CCCD,
            0x4248_0000,
            0xC2C8_0000,
            0x7F7F_FFFF,
        ] {
            let (negative, magnitude) = Magnitude::of_f32(bits).unwrap();
            let value = f64::from(f32::from_bits(bits));
            assert_eq!(magnitude.to_f64().to_bits(), value.abs().to_bits());
            assert_eq!(negative, value < 0.0);
        }
        for bits in [0, 0x8000_0000, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0000] {
            assert_eq!(Magnitude::of_f32(bits), None);
        }
    }

    #[test]
    fn rounds_halves_away_from_zero() {
        let quotient = |numerator: i32, divisor, exponent| Quotient {
            negative: numerator < 0,
            dividend: u128::from(numerator.unsigned_abs()),
            divisor,
            exponent,
        };
        for (numerator, divisor, exponent, num, den, expected) in [
            (1, 2, 0, 0, 1, Some(1)),
            (-1, 2, 0, 0, 1, Some(-1)),
            (1, 1, -1, 0, 1, Some(1)),
            (1, 1, -1, -1, 1, Some(-1)),
            (-3, 1, -1, 1, 1, Some(-1)),
            (5, 3, 2, 0, 1, Some(7)),
            (5, 3, 2, 1, 2, Some(4)),
            (-5, 3, 2, 1, 2, Some(-3)),
            (5, 1, 0, 0, 2, Some(3)),
            (-5, 1, 0, 0, 2, Some(-3)),
            (1, 1, -300, 0, 1, Some(0)),
            (1, 1, -300, 1, 2, Some(1)),
            (-1, 1, -300, 1, 2, Some(0)),
            (-1, 1, -300, -1, 2, Some(-1)),
            (1, 3, 62, 0, 1, Some(1_537_228_672_809_129_301)),
            (1, 1, 63, 0, 1, None),
            (-1, 1, 63, 0, 1, Some(i64::MIN)),
            (1, 1, 300, 0, 1, None),
            (0, 1, 300, 7, 2, Some(4)),
        ] {
            assert_eq!(
                quotient(numerator, divisor, exponent).plus_over(num, den),
                expected
            );
        }
    }
}
