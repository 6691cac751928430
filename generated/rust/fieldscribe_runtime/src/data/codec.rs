// SPDX-License-Identifier: 0BSD
//! Values of points that are known at run time only, from raw numbers and to raw numbers.

use super::facts::Form;
use super::{AnyValue, PointFacts};
use crate::arithmetic::round_i128;
use crate::check::saturated;
use crate::error::{Outside, Refused};
use crate::form::{floating::Pattern, in_order, scaled};
use crate::{Error, Given, Raw};

impl PointFacts {
    /// The numbers that have names.
    #[must_use]
    pub fn names(&self) -> &'static [(i128, &'static str)] {
        match self.form {
            Form::Named(names) => names,
            _ => &[],
        }
    }

    /// The least and the greatest value that may be written, in the point's unit; none if other points set them, or
    /// nothing is written.
    #[must_use]
    pub fn limits(&self) -> Option<(f64, f64)> {
        let writing = self.writing.as_ref()?;
        let (low, high) = self.raw_limits();
        match self.form {
            _ if writing.check.is_some() => None,
            Form::Plain | Form::Named(_) | Form::Scaled(_) => {
                let (one, other) = (self.quantity(low), self.quantity(high));
                Some((one.min(other), one.max(other)))
            }
            _ => None,
        }
    }

    /// Decodes a raw number, with the raw numbers of [`needs`](crate::PointInfo::needs).
    ///
    /// # Errors
    /// Those of a scale that needs other points; [`Error::NotANumber`] for a text.
    pub fn decode(&self, raw: i128, with: &[i128]) -> Result<AnyValue<'static>, Error> {
        if let Some((code, _)) = self.codes.at(raw) {
            return Ok(AnyValue::Name(code));
        }
        Ok(match self.form {
            Form::Plain => AnyValue::Integer(raw),
            Form::Named(names) => names
                .iter()
                .find(|(number, _)| *number == raw)
                .map_or(AnyValue::Integer(raw), |(_, name)| AnyValue::Name(name)),
            Form::Scaled(_) | Form::Floating => AnyValue::Number(self.quantity(raw)),
            Form::Ruled(decode) => AnyValue::Number(decode(raw, with)?),
            Form::Text => return Err(Error::NotANumber(self.name)),
        })
    }

    /// Encodes and checks a value, with the raw numbers of [`write_needs`](crate::PointInfo::write_needs).
    ///
    /// # Errors
    /// As [`Encodable::encode_with`](crate::Encodable::encode_with); [`Error::UnknownName`] for a name that the point
    /// does not know; [`Error::Missing`] if `with` lacks numbers; [`Error::Access`] if the point is not written.
    pub fn encode<'v>(&self, value: impl Into<AnyValue<'v>>, with: &[i128]) -> Result<i128, Error> {
        self.writable()?;
        let raw = match value.into() {
            AnyValue::Name(name) => return self.encode_name(name, with),
            AnyValue::Integer(number) if !self.has_scale() => return self.stored(number, with),
            AnyValue::Integer(number) => self.quantity_raw(to_f64(number), with)?,
            AnyValue::Number(number) => self.quantity_raw(number, with)?,
        };
        self.check(raw, with)?;
        Ok(raw)
    }

    /// Checks that a raw number may be written, with the raw numbers of [`write_needs`](crate::PointInfo::write_needs).
    ///
    /// # Errors
    /// As [`Writable::check_with`](crate::Writable::check_with); [`Error::Access`] if the point is not written.
    pub fn check(&self, raw: i128, with: &[i128]) -> Result<(), Error> {
        let writing = self.writable()?;
        if let Some(check) = writing.check {
            return check(raw, with);
        }
        if let Some((code, is_writable)) = self.codes.at(raw) {
            return if is_writable {
                Ok(())
            } else {
                Err(self.no_quantity(code, false))
            };
        }
        let within = |(low, high): &(i128, i128)| *low <= raw && raw <= *high;
        if self.with_fixed_bits(raw) != raw {
            Err(self.lacks_fixed_bits(raw))
        } else if self.ranges().iter().any(within) {
            Ok(())
        } else {
            Err(self.refused(raw))
        }
    }

    /// The raw number of an integer that needs no scale, with its constant bits.
    fn stored(&self, number: i128, with: &[i128]) -> Result<i128, Error> {
        let raw = self.with_fixed_bits(number);
        let checked = self.check(raw, with);
        checked.map_err(|error| error.about(saturated(number)))?;
        Ok(raw)
    }

    /// The raw number of a name, or of a number as text.
    fn encode_name(&self, name: &str, with: &[i128]) -> Result<i128, Error> {
        if let Some(raw) = self.number_of(name) {
            return self.check(raw, with).map(|()| raw);
        }
        let value = name.parse().map(AnyValue::Integer);
        let value = value.or_else(|_| name.parse().map(AnyValue::Number));
        let value: AnyValue<'_> = value.map_err(|_| Error::UnknownName {
            point: self.name,
            given: Given::new(name),
            names: self.names(),
        })?;
        self.encode(value, with)
    }

    /// The number that has a name, also that of a special code.
    fn number_of(&self, name: &str) -> Option<i128> {
        let named = self.names().iter().find(|(_, one)| *one == name);
        named
            .map(|(number, _)| *number)
            .or_else(|| self.codes.raw(name))
    }

    /// Whether values are quantities, not raw numbers.
    const fn has_scale(&self) -> bool {
        !matches!(self.form, Form::Plain | Form::Named(_))
    }

    /// The raw number nearest to a value, which is no special code.
    fn quantity_raw(&self, value: f64, with: &[i128]) -> Result<i128, Error> {
        if value.is_nan() {
            return Err(Error::NotANumber(self.name));
        }
        if let Some(encode) = self.writing.and_then(|writing| writing.encode) {
            return encode(value, with);
        }
        let raw = match self.form {
            Form::Scaled(scale) => round_i128(scaled::unrounded(scale.scale, value)),
            Form::Plain | Form::Named(_) => return self.whole_raw(value, with),
            _ => return Err(Error::NotANumber(self.name)),
        };
        let raw = raw.ok_or_else(|| self.refused_value(value, self.raw_limits()))?;
        match (self.check(raw, with), self.codes.at(raw)) {
            (Ok(()), None) => Ok(raw),
            (Ok(()), Some((code, is_writable))) => Err(self.no_quantity(code, is_writable)),
            (Err(Error::OutOfRange(Refused::Raw(raw))), _) => {
                Err(self.refused_value(value, (raw.low.into(), raw.high.into())))
            }
            (Err(error), _) => Err(error),
        }
    }

    /// The raw number of a value that needs no scale.
    fn whole_raw(&self, value: f64, with: &[i128]) -> Result<i128, Error> {
        match round_i128(value) {
            None => Err(self.refused_value(value, self.raw_limits())),
            Some(number) if to_f64(number) - value == 0.0 => self.stored(number, with),
            Some(_) => Err(Error::OutOfRange(Refused::Fraction {
                point: self.name,
                given: value,
            })),
        }
    }

    /// The quantity of a raw number by a scale that needs no other point.
    fn quantity(&self, raw: i128) -> f64 {
        match self.form {
            Form::Scaled(scale) => scaled::exact(scale.line, raw),
            Form::Floating if self.words == 2 => {
                u32::from_i128(raw).map_or(f64::NAN, Pattern::number)
            }
            Form::Floating => u64::from_i128(raw).map_or(f64::NAN, Pattern::number),
            _ => to_f64(raw),
        }
    }

    /// The ranges of raw numbers.
    fn ranges(&self) -> &[(i128, i128)] {
        match &self.writing {
            Some(writing) if !writing.ranges.is_empty() => writing.ranges,
            _ => core::slice::from_ref(&self.ends),
        }
    }

    /// The least and the greatest raw number.
    fn raw_limits(&self) -> (i128, i128) {
        let ranges = self.ranges();
        let low = ranges.iter().map(|range| range.0).min();
        let high = ranges.iter().map(|range| range.1).max();
        (low.unwrap_or_default(), high.unwrap_or_default())
    }

    /// The error for a number that is a special code.
    const fn no_quantity(&self, code: &'static str, is_writable: bool) -> Error {
        let point = self.name;
        Error::Special {
            point,
            code,
            is_writable,
        }
    }

    /// The error for a raw number that may not be written.
    pub(super) fn refused(&self, raw: i128) -> Error {
        let (low, high) = self.raw_limits();
        let [given, low, high] = [raw, low, high].map(saturated);
        let outside = Outside {
            point: self.name,
            given,
            low,
            high,
        };
        if self.writing.is_some_and(|writing| writing.is_closed) {
            Error::UnknownValue(outside)
        } else {
            Error::OutOfRange(Refused::Raw(outside))
        }
    }

    /// The error for a raw number without its constant bits.
    fn lacks_fixed_bits(&self, raw: i128) -> Error {
        let (mask, bits) = self.fixed;
        Error::OutOfRange(Refused::FixedBits {
            point: self.name,
            given: saturated(raw),
            mask,
            bits,
        })
    }

    /// The error for a value that may not be written, from the raw numbers that may.
    fn refused_value(&self, given: f64, raw: (i128, i128)) -> Error {
        let (one, other) = (self.quantity(raw.0), self.quantity(raw.1));
        let (low, high) = in_order(one, other, raw.0 <= raw.1);
        Error::OutOfRange(Refused::Value {
            outside: Outside {
                point: self.name,
                given,
                low,
                high,
            },
            unit: self.unit,
            raw: self
                .has_scale()
                .then_some((saturated(raw.0), saturated(raw.1))),
        })
    }

    /// The raw number with its constant bits, unless the point shares its word.
    fn with_fixed_bits(&self, raw: i128) -> i128 {
        let (mask, bits) = self.fixed;
        if self.mask.is_some() {
            return raw;
        }
        (raw & !i128::from(mask)) | i128::from(bits)
    }
}

#[expect(clippy::cast_precision_loss, reason = "nearest is what is asked for")]
const fn to_f64(number: i128) -> f64 {
    number as f64
}
