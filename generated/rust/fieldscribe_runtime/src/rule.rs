// SPDX-License-Identifier: 0BSD
//! Scales whose factors are read at run time.

use crate::arithmetic::{div_round_i128, exponent, quotient, to_f64};
use crate::pattern::{Magnitude, Quotient};
use crate::{Error, Raw};

/// A scale with factors that are read at run time: `raw = value * num / den + offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    num: i64,
    den: i64,
    offset_num: i64,
    offset_den: i64,
    /// Whether all factors are integers.
    whole: bool,
    times: Magnitude,
    over: Magnitude,
}

impl Rule {
    /// `raw = value * num / den`; the denominator is positive.
    #[must_use]
    #[inline]
    pub const fn new(num: i64, den: i64) -> Self {
        Self {
            num,
            den,
            offset_num: 0,
            offset_den: 1,
            whole: true,
            times: Magnitude::ONE,
            over: Magnitude::ONE,
        }
    }

    /// The rule plus `num / den`; the denominator is positive.
    #[must_use]
    #[inline]
    pub const fn plus(self, num: i64, den: i64) -> Self {
        Self {
            offset_num: num,
            offset_den: den,
            ..self
        }
    }

    /// The rule, unless one of its factors is a special code, which is no number to compute with.
    ///
    /// # Errors
    /// [`Error::ZeroFactor`] if it is.
    #[inline]
    pub const fn unless(self, coded: bool) -> Result<Self, Error> {
        if coded {
            Err(Error::ZeroFactor(None))
        } else {
            Ok(self)
        }
    }

    /// The rule, if the raw number of the point of that name is in `low..=high`: only there is the rule exact.
    ///
    /// # Errors
    /// [`Error::BrokenFactor`] if it is not.
    #[inline]
    pub fn within(
        self,
        point: &'static str,
        raw: impl Raw,
        low: i64,
        high: i64,
    ) -> Result<Self, Error> {
        exponent(point, raw, low, high).map(|_| self)
    }

    /// The rule with one more factor.
    ///
    /// # Errors
    /// [`Error::ZeroFactor`] if it is zero; [`Error::Overflow`].
    #[inline]
    pub fn times(self, factor: impl Raw) -> Result<Self, Error> {
        let factor = factor.to_i64();
        if factor == 0 {
            return Err(Error::ZeroFactor(None));
        }
        self.limited_by(factor)
    }

    /// The rule of a limit with one more factor, which may be zero.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    #[inline]
    pub fn limited_by(self, factor: impl Raw) -> Result<Self, Error> {
        let num = self
            .num
            .checked_mul(factor.to_i64())
            .ok_or(Error::Overflow(None))?;
        Ok(Self { num, ..self })
    }

    /// The rule with one more divisor.
    ///
    /// # Errors
    /// [`Error::ZeroFactor`] if it is zero; [`Error::Overflow`].
    #[inline]
    pub fn over(self, divisor: impl Raw) -> Result<Self, Error> {
        let divisor = divisor.to_i64();
        if divisor == 0 {
            return Err(Error::ZeroFactor(None));
        }
        let den = self.den.checked_mul(divisor).ok_or(Error::Overflow(None))?;
        Ok(Self { den, ..self })
    }

    /// The rule with one more factor, the binary32 number of that pattern.
    ///
    /// # Errors
    /// [`Error::ZeroFactor`] if it is zero, infinite or not a number; [`Error::Overflow`].
    #[inline]
    pub fn times_f32(self, bits: u32) -> Result<Self, Error> {
        let (negative, magnitude) = Magnitude::of_f32(bits).ok_or(Error::ZeroFactor(None))?;
        let times = self.times.times(magnitude).ok_or(Error::Overflow(None))?;
        Ok(Self {
            num: signed(negative, self.num)?,
            whole: false,
            times,
            ..self
        })
    }

    /// The rule of a limit with one more factor, the binary32 number of that pattern; what is no number counts as zero.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    #[inline]
    pub fn limited_by_f32(self, bits: u32) -> Result<Self, Error> {
        match self.times_f32(bits) {
            Err(Error::ZeroFactor(None)) => Ok(Self { num: 0, ..self }),
            other => other,
        }
    }

    /// The rule with one more divisor, the binary32 number of that pattern.
    ///
    /// # Errors
    /// [`Error::ZeroFactor`] if it is zero, infinite or not a number; [`Error::Overflow`].
    #[inline]
    pub fn over_f32(self, bits: u32) -> Result<Self, Error> {
        let (negative, magnitude) = Magnitude::of_f32(bits).ok_or(Error::ZeroFactor(None))?;
        let over = self.over.times(magnitude).ok_or(Error::Overflow(None))?;
        Ok(Self {
            den: signed(negative, self.den)?,
            whole: false,
            over,
            ..self
        })
    }

    /// The rule times ten to the power of `exponent`.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    #[inline]
    pub fn times_ten_to(self, exponent: i64) -> Result<Self, Error> {
        let digits = u32::try_from(exponent.unsigned_abs()).map_err(|_| Error::Overflow(None))?;
        let power = 10_i64.checked_pow(digits).ok_or(Error::Overflow(None))?;
        if exponent < 0 {
            self.over(power)
        } else {
            self.times(power)
        }
    }

    /// The rule divided by ten to the power of `exponent`.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    #[inline]
    pub fn over_ten_to(self, exponent: i64) -> Result<Self, Error> {
        self.times_ten_to(exponent.checked_neg().ok_or(Error::Overflow(None))?)
    }

    /// The raw number before rounding; each step is rounded to binary64.
    #[must_use]
    #[inline]
    pub fn encode(self, value: f64) -> f64 {
        let product = value * (to_f64(self.num) * self.times.to_f64());
        let quotient = product / (to_f64(self.den) * self.over.to_f64());
        quotient + to_f64(self.offset_num) / to_f64(self.offset_den)
    }

    /// The value: the binary64 number nearest to the exact one.
    ///
    /// # Errors
    /// [`Error::Overflow`]; [`Error::ZeroFactor`].
    #[inline]
    pub fn decode(self, raw: i64) -> Result<f64, Error> {
        let (num, den) = self.turned(raw, 1)?;
        Ok(to_f64(num) * self.over.to_f64() / (to_f64(den) * self.times.to_f64()))
    }

    /// The same for numerators that no binary64 number holds, by one division of 128 bits.
    ///
    /// # Errors
    /// [`Error::Overflow`]; [`Error::ZeroFactor`].
    #[inline]
    pub fn decode_wide(self, raw: i128) -> Result<f64, Error> {
        let (value, exponent) = self.wide(raw).ok_or(Error::Overflow(None))?;
        let power = Magnitude {
            mantissa: 1,
            exponent,
        };
        Ok(value * power.to_f64())
    }

    /// `(raw - offset) * den * over / (num * times)`, all in integers, and the power of two that is left.
    fn wide(self, raw: i128) -> Option<(f64, i32)> {
        let divisor = narrow([self.num, self.offset_den, 1], self.times)?;
        let factor = narrow([self.den, self.offset_den, 1], self.over)?;
        let lift = narrow([self.offset_num, self.den, 1], self.over)?;
        let product = raw.checked_mul(i128::from(factor))?;
        let lift = i128::from(lift).checked_mul(if self.offset_num < 0 { -1 } else { 1 })?;
        let size = product.checked_sub(lift)?;
        let turned = (self.num < 0) != (self.den < 0);
        let dividend = if turned { size.checked_neg()? } else { size };
        let exponent = self.over.exponent.checked_sub(self.times.exponent)?;
        Some((quotient(dividend, divisor), exponent))
    }

    /// The raw number of a count of `1 / per_unit` units; none if it is beyond every type.
    #[must_use]
    #[inline]
    pub fn encode_count(self, count: i64, per_unit: i64) -> Option<i64> {
        if !self.whole {
            return self.raw_of(count, per_unit);
        }
        let den = product([self.den, per_unit, self.offset_den]);
        let scaled = product([count, self.num, self.offset_den]);
        let offset = product([self.offset_num, self.den, per_unit]);
        let sum = scaled
            .zip(offset)
            .and_then(|(scaled, offset)| scaled.checked_add(offset));
        sum.zip(den).and_then(|(sum, den)| divide(sum, den))
    }

    /// The value in counts of `1 / per_unit` units.
    ///
    /// # Errors
    /// [`Error::Overflow`]; [`Error::ZeroFactor`].
    #[inline]
    pub fn decode_count(self, raw: i64, per_unit: i64) -> Result<i64, Error> {
        if !self.whole {
            return self.count_of(raw, per_unit);
        }
        let (num, den) = self.turned(raw, per_unit)?;
        divide(num, den).ok_or(Error::Overflow(None))
    }

    /// The same for what is shown, which may have more decimals than counts: by one division of 128 bits.
    ///
    /// # Errors
    /// [`Error::Overflow`]; [`Error::ZeroFactor`].
    pub(crate) fn shown_count(self, raw: i64, per_unit: i64) -> Result<i64, Error> {
        if !self.whole {
            return self.count_of(raw, per_unit);
        }
        let (num, den) = self.turned(raw, 1)?;
        let dividend = i128::from(num).checked_mul(i128::from(per_unit));
        let dividend = dividend.ok_or(Error::Overflow(None))?;
        let count = div_round_i128(dividend, u128::from(den.unsigned_abs()));
        i64::try_from(count).map_err(|_| Error::Overflow(None))
    }

    /// The rule applied to 1, rounded: a limit.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    #[inline]
    pub fn limit(self) -> Result<i64, Error> {
        if !self.whole {
            return self.raw_of(1, 1).ok_or(Error::Overflow(None));
        }
        let den = product([self.den, self.offset_den, 1]);
        let scaled = product([self.num, self.offset_den, 1]);
        let offset = product([self.offset_num, self.den, 1]);
        let sum = scaled
            .zip(offset)
            .and_then(|(scaled, offset)| scaled.checked_add(offset));
        sum.zip(den)
            .and_then(|(sum, den)| divide(sum, den))
            .ok_or(Error::Overflow(None))
    }

    /// The raw number of a count, with factors of any size.
    fn raw_of(self, count: i64, per_unit: i64) -> Option<i64> {
        let dividend = [count, self.num, self.offset_den];
        let divisor = [self.den, per_unit, 1];
        let scaled = Quotient {
            negative: is_negative(dividend) != is_negative(divisor),
            dividend: magnitude(dividend, self.times)?,
            divisor: magnitude(divisor, self.over)?,
            exponent: self.times.exponent.checked_sub(self.over.exponent)?,
        };
        scaled.plus_over(self.offset_num, self.offset_den)
    }

    /// The count of a raw number, with factors of any size.
    fn count_of(self, raw: i64, per_unit: i64) -> Result<i64, Error> {
        if self.num == 0 {
            return Err(Error::ZeroFactor(None));
        }
        let shifted =
            product([raw, self.offset_den, 1]).and_then(|raw| raw.checked_sub(self.offset_num));
        let dividend = [shifted.ok_or(Error::Overflow(None))?, self.den, per_unit];
        let divisor = [self.num, self.offset_den, 1];
        let quotient = || {
            let value = Quotient {
                negative: is_negative(dividend) != is_negative(divisor),
                dividend: magnitude(dividend, self.over)?,
                divisor: magnitude(divisor, self.times)?,
                exponent: self.over.exponent.checked_sub(self.times.exponent)?,
            };
            value.plus_over(0, 1)
        };
        quotient().ok_or(Error::Overflow(None))
    }

    /// `(raw - offset) * den * times / num` as a fraction with a positive denominator.
    #[inline]
    fn turned(self, raw: i64, times: i64) -> Result<(i64, i64), Error> {
        if self.num == 0 {
            return Err(Error::ZeroFactor(None));
        }
        let shifted =
            product([raw, self.offset_den, 1]).and_then(|raw| raw.checked_sub(self.offset_num));
        let num = product([shifted.ok_or(Error::Overflow(None))?, self.den, times])
            .ok_or(Error::Overflow(None))?;
        let den = product([self.num, self.offset_den, 1]).ok_or(Error::Overflow(None))?;
        if den < 0 {
            let num = num.checked_neg().ok_or(Error::Overflow(None))?;
            Ok((num, den.checked_neg().ok_or(Error::Overflow(None))?))
        } else {
            Ok((num, den))
        }
    }
}

#[inline]
fn product([a, b, c]: [i64; 3]) -> Option<i64> {
    a.checked_mul(b)?.checked_mul(c)
}

/// The quotient, rounded to nearest, halves away from zero; none for a zero divisor or a result beyond the type.
#[inline]
fn divide(dividend: i64, divisor: i64) -> Option<i64> {
    let half = divisor.unsigned_abs() / 2;
    let sum = dividend.unsigned_abs().checked_add(half)?;
    let quotient = sum.checked_div(divisor.unsigned_abs())?;
    if (dividend < 0) == (divisor < 0) {
        i64::try_from(quotient).ok()
    } else {
        0_i64.checked_sub_unsigned(quotient)
    }
}

/// `number`, or its negative.
#[inline]
fn signed(negative: bool, number: i64) -> Result<i64, Error> {
    if negative {
        number.checked_neg().ok_or(Error::Overflow(None))
    } else {
        Ok(number)
    }
}

fn is_negative(factors: [i64; 3]) -> bool {
    factors
        .iter()
        .fold(false, |negative, factor| negative != (*factor < 0))
}

/// The magnitude of a product with a mantissa, if it is an `i64`.
fn narrow(factors: [i64; 3], more: Magnitude) -> Option<u64> {
    let size = i64::try_from(magnitude(factors, more)?).ok()?;
    Some(size.unsigned_abs())
}

/// The magnitude of a product with a mantissa.
fn magnitude(factors: [i64; 3], more: Magnitude) -> Option<u128> {
    let start = u128::from(more.mantissa);
    factors.iter().try_fold(start, |product, factor| {
        product.checked_mul(u128::from(factor.unsigned_abs()))
    })
}
