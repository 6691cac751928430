// SPDX-License-Identifier: 0BSD
//! Scales that need no other point, and the lines that they are for counts.

use crate::FixedScale;

/// A scale that needs no other point: `raw = value * num / den + offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    num: i128,
    den: i128,
    offset_num: i128,
    offset_den: i128,
}

impl Scale {
    /// `raw = value * num / den`; the denominator is positive.
    #[must_use]
    #[inline]
    pub const fn new(num: i128, den: i128) -> Self {
        Self {
            num,
            den,
            offset_num: 0,
            offset_den: 1,
        }
    }

    /// The scale plus `num / den`; the denominator is positive.
    #[must_use]
    #[inline]
    pub const fn plus(self, num: i128, den: i128) -> Self {
        Self {
            offset_num: num,
            offset_den: den,
            ..self
        }
    }

    /// Numerator and denominator of the ratio.
    #[must_use]
    #[inline]
    pub const fn ratio(self) -> (i128, i128) {
        (self.num, self.den)
    }

    /// Numerator and denominator of the offset.
    #[must_use]
    #[inline]
    pub const fn offset(self) -> (i128, i128) {
        (self.offset_num, self.offset_den)
    }

    /// A raw number becomes the value in counts of `1 / per_unit`.
    #[inline]
    pub(crate) const fn decoding(self, per_unit: i128) -> Line {
        let sign = self.num.signum();
        Line::new(
            sign * self.den * self.offset_den * per_unit,
            -sign * self.offset_num * self.den * per_unit,
            sign * self.num * self.offset_den,
        )
    }

    /// A count of `1 / per_unit` becomes the raw number.
    #[inline]
    pub(crate) const fn encoding(self, per_unit: i128) -> Line {
        Line::new(
            self.num * self.offset_den,
            self.offset_num * self.den * per_unit,
            self.den * per_unit * self.offset_den,
        )
    }
}

/// `(number * multiply + add) / divide` in lowest terms; the divisor is positive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub multiply: i128,
    pub add: i128,
    pub divide: i128,
}

impl Line {
    #[inline]
    const fn new(multiply: i128, add: i128, divide: i128) -> Self {
        let common = common(common(multiply.abs(), add.abs()), divide);
        Self {
            multiply: multiply / common,
            add: add / common,
            divide: divide / common,
        }
    }

    /// What is divided.
    #[inline]
    pub const fn dividend(self, number: i128) -> i128 {
        number * self.multiply + self.add
    }

    /// Whether all that comes up for the numbers `low..=high` has an absolute value below two to the power of `bits`.
    #[inline]
    pub const fn fits(self, low: i128, high: i128, bits: u32) -> bool {
        let half = self.divide / 2 + 1;
        below(low, bits)
            && below(high, bits)
            && below(self.multiply, bits)
            && below(self.add, bits)
            && below(self.divide, bits)
            && below(low * self.multiply, bits)
            && below(high * self.multiply, bits)
            && below(self.dividend(low).abs() + half, bits)
            && below(self.dividend(high).abs() + half, bits)
    }

    /// The least and the greatest number whose result, rounded, lies within `low..=high`.
    #[inline]
    pub const fn reach(self, low: i128, high: i128) -> (i128, i128) {
        // A result r comes from (r - 1/2) to (r + 1/2); which of the two halves is its own, the trial tells.
        let mut under = (2 * low - 1) * self.divide - 2 * self.add;
        let mut over = (2 * high + 1) * self.divide - 2 * self.add;
        if self.multiply < 0 {
            (under, over) = (-over, -under);
        }
        let by = 2 * self.multiply.abs();
        let (first, last) = (-(-under).div_euclid(by), over.div_euclid(by));
        let (one, other) = (self.rounded(first), self.rounded(last));
        (
            first + (one < low || one > high) as i128,
            last - (other < low || other > high) as i128,
        )
    }

    /// The result, rounded to nearest, halves away from zero.
    #[inline]
    const fn rounded(self, number: i128) -> i128 {
        let dividend = self.dividend(number);
        dividend.signum() * ((dividend.abs() + self.divide / 2) / self.divide)
    }
}

/// A scale for points as data: what decoding needs of it is computed when the program is compiled.
#[derive(Clone, Copy, Debug)]
pub struct DataScale {
    pub(crate) scale: Scale,
    pub(crate) line: Line,
}

impl DataScale {
    /// The scale of that point.
    #[must_use]
    pub const fn of<P: FixedScale>() -> Self {
        let (scale, line) = (P::SCALE, P::SCALE.decoding(1));
        Self { scale, line }
    }
}

/// Whether the absolute value is below two to the power of `bits`.
#[inline]
pub(crate) const fn below(number: i128, bits: u32) -> bool {
    number.unsigned_abs() >> bits == 0
}

#[inline]
const fn common(mut one: i128, mut other: i128) -> i128 {
    while other != 0 {
        (one, other) = (other, one % other);
    }
    one
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn counts_within_reach_are_all_that_give_a_raw_number_within_its_ends() {
        for (num, den) in [(10, 1), (1, 2), (3, 7), (-7, 5), (256, 1)] {
            for (offset, over) in [(0, 1), (5, 2), (-4, 3)] {
                let line = Scale::new(num, den).plus(offset, over).encoding(10);
                for (low, high) in [(-9, 9), (0, 30), (3, 3), (-1, 0), (1, 2)] {
                    let (first, last) = line.reach(low, high);
                    for count in -1000..1000 {
                        let is_within = (low..=high).contains(&line.rounded(count));
                        assert_eq!(is_within, first <= count && count <= last);
                    }
                }
            }
        }
    }
}
