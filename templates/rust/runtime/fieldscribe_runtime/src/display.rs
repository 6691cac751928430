// SPDX-License-Identifier: 0BSD
//! Values as text: with the decimals of the description, rounded from the exact value, without floats.

use core::fmt::{self, Write};

use crate::{Error, Point};

/// A point whose description gives the number of decimals to show: [`Point::DISPLAY_DECIMALS`].
///
/// ```
/// use fieldscribe_runtime::{point, Displayed, Encodable};
///
/// point! {
///     /// Base frequency.
///     BaseFrequency: u16 = "base_frequency";
///     at Holding 0x1019;
///     unit "Hz";
///     decimals 1;
///     display 2;
///     => value f64 as scaled(10, 1);
///     read { count i32; }
///     write { count i32; }
/// }
///
/// let raw = BaseFrequency::encode(50.0).unwrap();
/// assert_eq!(BaseFrequency::told(raw).unwrap().to_string(), "50.00 Hz");
/// ```
pub trait Displayed: Point {
    /// The raw numbers of other points that the scale needs; `()` if it needs none.
    type Needs: Copy;

    /// The text of a raw number: its value with the unit, or the name of a special code.
    ///
    /// # Errors
    /// The errors of a scale that needs other points; [`Error::Overflow`].
    fn told_with(raw: Self::Raw, with: Self::Needs) -> Result<Shown, Error>;

    /// As [`Displayed::told_with`], for a point whose scale needs no other.
    ///
    /// # Errors
    /// The same.
    fn told(raw: Self::Raw) -> Result<Shown, Error>
    where
        Self: Displayed<Needs = ()>,
    {
        Self::told_with(raw, ())
    }
}

/// The text of a value: `50.00 Hz`; formatting it allocates nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    what: What,
    unit: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum What {
    Code(&'static str),
    Count { count: i128, decimals: u32 },
    Float { number: f64, decimals: u32 },
}

impl Shown {
    /// A special code.
    #[must_use]
    pub const fn code(name: &'static str) -> Self {
        Self {
            what: What::Code(name),
            unit: "",
        }
    }

    /// A number of the smallest steps that are shown of a point.
    #[must_use]
    pub const fn count<P: Point>(count: i128) -> Self {
        Self {
            what: What::Count {
                count,
                decimals: decimals::<P>(),
            },
            unit: P::UNIT,
        }
    }

    /// A binary floating-point number, rounded when it is formatted.
    #[must_use]
    pub const fn float<P: Point>(number: f64) -> Self {
        Self {
            what: What::Float {
                number,
                decimals: decimals::<P>(),
            },
            unit: P::UNIT,
        }
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.what {
            What::Code(name) => formatter.write_str(name)?,
            What::Count { count, decimals } => {
                decimal(formatter, count < 0, count.unsigned_abs(), decimals)?;
            }
            What::Float { number, decimals } => float(formatter, number, decimals)?,
        }
        if self.unit.is_empty() {
            return Ok(());
        }
        write!(formatter, " {}", self.unit)
    }
}

/// The number of decimals to show of a point.
const fn decimals<P: Point>() -> u32 {
    match P::DISPLAY_DECIMALS {
        Some(decimals) => decimals,
        None => 0,
    }
}

/// The number of the smallest steps in one unit.
pub(crate) const fn per_unit<P: Point>() -> i64 {
    match 10_i64.checked_pow(decimals::<P>()) {
        Some(power) => power,
        None => 0,
    }
}

/// Writes a number of `10^-decimals`; zero has no sign.
fn decimal(out: &mut fmt::Formatter<'_>, negative: bool, size: u128, decimals: u32) -> fmt::Result {
    if negative && size != 0 {
        out.write_str("-")?;
    }
    let power = 10_u128.checked_pow(decimals).unwrap_or(1);
    let whole = size.checked_div(power).unwrap_or(size);
    if decimals == 0 {
        return write!(out, "{whole}");
    }
    write!(out, "{whole}.")?;
    let mut place = power;
    for _ in 0..decimals {
        place = place.checked_div(10).unwrap_or(1);
        let digit = size
            .checked_div(place)
            .and_then(|digits| digits.checked_rem(10));
        let digit = digit.and_then(|digit| char::from_digit(u32::try_from(digit).ok()?, 10));
        out.write_char(digit.unwrap_or('0'))?;
    }
    Ok(())
}

/// The decimals of a whole number. A width at run time could panic.
fn zeros(out: &mut fmt::Formatter<'_>, decimals: u32) -> fmt::Result {
    if decimals > 0 {
        out.write_str(".")?;
    }
    for _ in 0..decimals {
        out.write_char('0')?;
    }
    Ok(())
}

const MANTISSA: u32 = 52;
const EXPONENT: u64 = 0x7FF;
/// The stored exponent of a whole mantissa.
const WHOLE: u64 = 1075;

/// Writes a floating-point number, rounded from all its bits to nearest, halves away from zero.
fn float(out: &mut fmt::Formatter<'_>, number: f64, decimals: u32) -> fmt::Result {
    let negative = number.is_sign_negative();
    if !number.is_finite() {
        return out.write_str(match (number.is_nan(), negative) {
            (true, _) => "nan",
            (_, true) => "-inf",
            _ => "inf",
        });
    }
    let bits = number.to_bits();
    let stored = (bits >> MANTISSA) & EXPONENT;
    if stored >= WHOLE {
        write!(out, "{number:.0}")?; // a whole number: nothing is rounded
        return zeros(out, decimals);
    }
    let fraction = bits & ((1 << MANTISSA) - 1);
    let mantissa = if stored == 0 {
        fraction
    } else {
        fraction | (1 << MANTISSA)
    };
    // At most 53 bits of the mantissa and 40 of twelve decimals.
    let power = 10_u128.checked_pow(decimals).unwrap_or(0);
    let scaled = u128::from(mantissa).saturating_mul(power);
    let down = u32::try_from(WHOLE.saturating_sub(stored.max(1))).unwrap_or(u32::MAX);
    let half = 1_u128
        .checked_shl(down.saturating_sub(1))
        .unwrap_or(u128::MAX);
    let size = scaled.saturating_add(half).checked_shr(down).unwrap_or(0);
    decimal(out, negative, size, decimals)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::{String, ToString};

    use super::{Shown, What};

    fn shown(number: f64, decimals: u32) -> String {
        let what = What::Float { number, decimals };
        Shown { what, unit: "" }.to_string()
    }

    #[test]
    fn floats_are_rounded_from_all_their_bits() {
        for (number, decimals, text) in [
            (0.125, 2, "0.13"),
            (-0.125, 2, "-0.13"),
            (2.5, 0, "3"),
            (0.1 + 0.2, 1, "0.3"),
            (0.15, 1, "0.1"),
            (-0.004, 2, "0.00"),
            (-0.0, 1, "0.0"),
            (5e-324, 12, "0.000000000000"),
            (9_007_199_254_740_993.0, 1, "9007199254740992.0"),
            (4_503_599_627_370_495.5, 0, "4503599627370496"),
            (1e22, 3, "10000000000000000000000.000"),
            (f64::NAN, 1, "nan"),
            (f64::NEG_INFINITY, 1, "-inf"),
        ] {
            assert_eq!(shown(number, decimals), text);
        }
    }
}
