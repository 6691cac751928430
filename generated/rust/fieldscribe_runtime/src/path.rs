// SPDX-License-Identifier: 0BSD
//! The integer path of a scale: how to divide by a constant, chosen and proven when the crate is compiled.

use crate::arithmetic::{div_round_i128, div_round_i64};
use crate::scale::Line;

/// How to compute a line; exact for every number between the least and the greatest that can occur.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// No division, all in 32 bits.
    Whole32,
    /// No division.
    Whole64,
    /// A division by a power of two, in 32 bits.
    Shifted,
    /// A product of 32 bits, shifted.
    Short(Magic),
    /// The same with a correction, as some quotients are one too small.
    Corrected(Magic),
    /// As `Short`, without the sign of what is divided.
    Signed(Magic),
    /// A product of 64 bits, shifted.
    Long(Magic),
    /// A division of 64 bits.
    Divided64,
    /// A division of 128 bits.
    Divided128,
}

/// `(number * factor + plus) >> shift` is a quotient.
#[derive(Clone, Copy, Debug)]
struct Magic {
    factor: u64,
    plus: u64,
    shift: u32,
}

/// One direction of the integer path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    way: Way,
    line: Line,
    /// The least number that can occur.
    low: i128,
    /// The quotient and the remainder of that number.
    base: i128,
    rest: i128,
}

impl Path {
    /// The path of a line for the numbers `low..=high`.
    #[inline]
    pub const fn new(line: Line, low: i128, high: i128) -> Self {
        let least = line.dividend(low) + line.divide / 2;
        Self {
            way: way(line, low, high),
            line,
            low,
            base: least.div_euclid(line.divide),
            rest: least.rem_euclid(line.divide),
        }
    }

    /// The result for a number, rounded to nearest, halves away from zero; its upper bits are cut off.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        clippy::inline_always,
        reason = "each way is taken where nothing is lost; the constants of a point leave one of them"
    )]
    #[inline(always)]
    pub const fn run(&self, number: i64) -> i64 {
        let Line {
            multiply,
            add,
            divide,
        } = self.line;
        let small = (number as i32)
            .wrapping_mul(multiply as i32)
            .wrapping_add(add as i32);
        let from_low = (number as u32).wrapping_sub(self.low as u32);
        match self.way {
            Way::Whole32 => small as i64,
            Way::Whole64 => number
                .wrapping_mul(multiply as i64)
                .wrapping_add(add as i64),
            Way::Shifted => {
                let raised = small.wrapping_add(divide as i32 / 2);
                let raised = raised.wrapping_sub((small < 0) as i32);
                (raised >> (divide.trailing_zeros() & 31)) as i64
            }
            Way::Short(magic) => {
                (self.base as i32).wrapping_add(magic.short(from_low) as i32) as i64
            }
            Way::Corrected(magic) => {
                let quotient = magic.short(from_low);
                let dividend = from_low
                    .wrapping_mul(multiply as u32)
                    .wrapping_add(self.rest as u32);
                let left = dividend.wrapping_sub(quotient.wrapping_mul(divide as u32));
                let quotient = quotient.wrapping_add((left >= divide as u32) as u32);
                (self.base as i32).wrapping_add(quotient as i32) as i64
            }
            Way::Signed(magic) => {
                let quotient = magic.short(small.unsigned_abs()) as i32;
                (if small < 0 {
                    quotient.wrapping_neg()
                } else {
                    quotient
                }) as i64
            }
            Way::Long(magic) => {
                let from_low = (number as u64).wrapping_sub(self.low as u64);
                let product = from_low.wrapping_mul(magic.factor);
                let quotient = product.wrapping_add(magic.plus) >> (magic.shift & 63);
                (self.base as i64).wrapping_add(quotient as i64)
            }
            Way::Divided64 => {
                let product = number.wrapping_mul(multiply as i64);
                div_round_i64(product.wrapping_add(add as i64), divide as u64)
            }
            Way::Divided128 => {
                let product = (number as i128).wrapping_mul(multiply);
                div_round_i128(product.wrapping_add(add), divide as u128) as i64
            }
        }
    }
}

impl Magic {
    #[allow(clippy::cast_possible_truncation, reason = "it is made for 32 bits")]
    #[inline]
    const fn short(self, number: u32) -> u32 {
        let product = number.wrapping_mul(self.factor as u32);
        product.wrapping_add(self.plus as u32) >> (self.shift & 31)
    }
}

/// The cheapest way that holds for `low..=high`.
#[inline]
const fn way(line: Line, low: i128, high: i128) -> Way {
    let (least, most) = (line.dividend(low), line.dividend(high));
    let size = if least.abs() > most.abs() {
        least.abs()
    } else {
        most.abs()
    };
    let (small, wide) = (line.fits(low, high, 31), line.fits(low, high, 63));
    if line.divide == 1 {
        return if small {
            Way::Whole32
        } else if wide {
            Way::Whole64
        } else {
            Way::Divided128
        };
    }
    if small && line.divide & (line.divide - 1) == 0 {
        return Way::Shifted;
    }
    if small && is_one_floor(line, least) {
        if let Some(magic) = exact(line, low, high, 32) {
            return Way::Short(magic);
        }
        if let Some(magic) = near(line, low, high) {
            return Way::Corrected(magic);
        }
    }
    if small {
        let sized = Line {
            multiply: 1,
            add: 0,
            ..line
        };
        if let Some(magic) = exact(sized, 0, size, 32) {
            return Way::Signed(magic);
        }
    }
    if wide && is_one_floor(line, least) {
        if let Some(magic) = exact(line, low, high, 64) {
            return Way::Long(magic);
        }
    }
    if wide {
        Way::Divided64
    } else {
        Way::Divided128
    }
}

/// True if rounding down after adding a half is right for all numbers: no negative number ends in a half.
#[inline]
const fn is_one_floor(line: Line, least: i128) -> bool {
    line.multiply > 0 && (least >= 0 || line.divide % 2 == 1)
}

/// The factor and summand with which every quotient of the numbers above `low` is exact, in a product of this many
/// bits.
///
/// With `factor` and `plus` rounded up by `e` and `f` parts of the divisor, the quotient grows by `(n * e + f) /
/// (divide << shift)`: no whole number is crossed while that is less than one part.
#[inline]
const fn exact(line: Line, low: i128, high: i128, bits: u32) -> Option<Magic> {
    let mut shift = 0;
    while shift < bits {
        let (factor, e) = parts(line.multiply, line.divide, shift, true);
        let (plus, f) = parts(rest(line, low), line.divide, shift, true);
        match (product(high - low, e, f), product(high - low, factor, plus)) {
            (Some(error), Some(most)) if error >> shift == 0 && most >> bits == 0 => {
                return Some(magic(factor, plus, shift));
            }
            _ => shift += 1,
        }
    }
    None
}

/// The factor and summand with which every quotient of the numbers above `low` is exact or one too small, in a product
/// of 32 bits.
///
/// With `factor` and `plus` rounded down, the quotient shrinks by the same: by one at most while that is one at most.
#[inline]
const fn near(line: Line, low: i128, high: i128) -> Option<Magic> {
    let mut shift = 0;
    while shift < 32 {
        let (factor, e) = parts(line.multiply, line.divide, shift, false);
        let (plus, f) = parts(rest(line, low), line.divide, shift, false);
        match (product(high - low, e, f), product(high - low, factor, plus)) {
            (Some(error), Some(most)) if error <= line.divide << shift && most >> 32 == 0 => {
                return Some(magic(factor, plus, shift));
            }
            _ => shift += 1,
        }
    }
    None
}

/// The remainder of the least number, with the half that rounds.
#[inline]
const fn rest(line: Line, low: i128) -> i128 {
    (line.dividend(low) + line.divide / 2).rem_euclid(line.divide)
}

/// `number << shift` in parts of the divisor, rounded up or down, and by how much of one that is off.
#[inline]
const fn parts(number: i128, divide: i128, shift: u32, up: bool) -> (i128, i128) {
    let shifted = number << shift;
    let (whole, left) = (shifted / divide, shifted % divide);
    if up && left != 0 {
        (whole + 1, divide - left)
    } else {
        (whole, left)
    }
}

/// `span * factor + plus`, if it is no more than can be told.
#[inline]
const fn product(span: i128, factor: i128, plus: i128) -> Option<i128> {
    match span.checked_mul(factor) {
        Some(product) => product.checked_add(plus),
        None => None,
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a product with them has 64 bits"
)]
#[inline]
const fn magic(factor: i128, plus: i128, shift: u32) -> Magic {
    Magic {
        factor: factor as u64,
        plus: plus as u64,
        shift,
    }
}

#[cfg(test)]
mod tests {
    use super::{Path, Way};
    use crate::scale::Scale;

    /// Steps through the numbers, and both ends, against the definition.
    fn hold(path: &Path, low: i64, high: i64) {
        let step = usize::try_from((high - low) / 500 + 1).unwrap();
        for number in (low..=high).step_by(step).chain([high]) {
            let dividend = path.line.dividend(i128::from(number));
            let size = (dividend.abs() + path.line.divide / 2) / path.line.divide;
            assert_eq!(
                i128::from(path.run(number)),
                dividend.signum() * size,
                "{path:?} {number}"
            );
        }
    }

    #[test]
    fn every_way_rounds_to_nearest() {
        let mut seen = [0; 9];
        for num in [
            1, -1, 2, 3, 5, 7, 10, 32, 50, 125, 256, 1000, 4095, 16_384, 100_003,
        ] {
            for den in [1, 2, 3, 5, 9, 10, 32, 60, 100, 125, 400, 2800, 65_535] {
                for (offset, over) in [(0, 1), (1, 2), (-40, 1), (7, 3), (-65_521, 97)] {
                    for (low, high) in [
                        (0, 65_535),
                        (-32_768, 32_767),
                        (30, 4000),
                        (0, 4_294_967_295),
                        (-7, 2_000_000),
                    ] {
                        let scale = Scale::new(num, den).plus(offset, over);
                        for line in [scale.decoding(100), scale.encoding(100), scale.encoding(1)] {
                            let path = Path::new(line, low.into(), high.into());
                            hold(&path, low, high);
                            seen[match path.way {
                                Way::Whole32 => 0,
                                Way::Whole64 => 1,
                                Way::Shifted => 2,
                                Way::Short(_) => 3,
                                Way::Corrected(_) => 4,
                                Way::Signed(_) => 5,
                                Way::Long(_) => 6,
                                Way::Divided64 => 7,
                                Way::Divided128 => 8,
                            }] += 1;
                        }
                    }
                }
            }
        }
        assert!(seen[..8].iter().all(|times| *times > 0), "{seen:?}");
    }
}
