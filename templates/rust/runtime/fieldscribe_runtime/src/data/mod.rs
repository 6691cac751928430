// SPDX-License-Identifier: 0BSD
//! Points as data, for programs that learn the names of points at run time, such as a gateway.
//!
//! The facts are tables; only scales and limits that need other points are code.

mod codec;
mod facts;
mod words;

use core::fmt;

pub use facts::{others, ByOthers, Codes, Form, Others, PointFacts, Selection, Writing};

pub use crate::scale::DataScale;

use crate::check::beyond;
use crate::form::ruled;
use crate::{Encodable, Error, Point, Raw, Scaled, Writable};

/// The value of a point that is known at run time only.
///
/// A name is that of a number or of a special code; for writing it may be a number as text, too.
///
/// ```
/// use fieldscribe_runtime::AnyValue;
///
/// let values: [AnyValue; 3] = [50.0.into(), 3.into(), "modbus".into()];
/// assert_eq!(values.map(|value| value.to_string()), ["50", "3", "modbus"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyValue<'a> {
    /// A number without a scale.
    Integer(i128),
    /// A quantity in the point's unit.
    Number(f64),
    /// A named number, or a special code.
    Name(&'a str),
}

impl fmt::Display for AnyValue<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(number) => number.fmt(formatter),
            Self::Number(number) => number.fmt(formatter),
            Self::Name(name) => formatter.pad(name),
        }
    }
}

/// Integers of each type.
macro_rules! integers {
    ($($type:ty)*) => {
        $(impl From<$type> for AnyValue<'_> {
            fn from(number: $type) -> Self {
                Self::Integer(number.into())
            }
        })*
    };
}

integers!(bool u8 u16 i32 u32 i64 i128);

impl From<f64> for AnyValue<'_> {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl<'a> From<&'a str> for AnyValue<'a> {
    fn from(name: &'a str) -> Self {
        Self::Name(name)
    }
}

/// The raw numbers of other points that a scale or a limit needs.
pub trait Needs: Copy {
    /// The facts of those points; none if they depend on the variant of the device.
    #[must_use]
    fn points() -> &'static [&'static PointFacts] {
        &[]
    }

    /// The raw numbers, in the order of the points; none if there are fewer, or one does not fit its type.
    #[must_use]
    fn from_raws(_: &[i128]) -> Option<Self> {
        None
    }
}

impl Needs for () {
    fn from_raws(_: &[i128]) -> Option<Self> {
        Some(())
    }
}

/// The value of a point whose scale needs others, for [`Form::Ruled`].
///
/// # Errors
/// Those of its rule; [`Error::Missing`] if numbers of other points are missing.
pub fn ruled<P: Scaled<Factors: Needs>>(raw: i128, with: &[i128]) -> Result<f64, Error> {
    let factors = P::Factors::from_raws(with).ok_or_else(missing::<P, P::Factors>)?;
    let beyond = Error::Overflow(Some(P::NAME));
    ruled::decode::<P, f64>(P::Raw::from_i128(raw).ok_or(beyond)?, factors)
}

/// Whether a raw number may be written, for [`Writing::check`].
///
/// # Errors
/// As [`Writable::check_with`]; [`Error::Missing`] if numbers of other points are missing.
pub fn checked<P: Writable<With: Needs>>(raw: i128, with: &[i128]) -> Result<(), Error> {
    let needs = P::With::from_raws(with).ok_or_else(missing::<P, P::With>)?;
    let number = P::Raw::from_i128(raw);
    P::check_with(number.ok_or_else(|| beyond::<P>(raw))?, needs)
}

/// The raw number of a value, for [`Writing::encode`].
///
/// # Errors
/// As [`Encodable::encode_with`]; [`Error::Missing`] if numbers of other points are missing.
pub fn encoded<P>(value: f64, with: &[i128]) -> Result<i128, Error>
where
    P: Encodable<With: Needs, Value: From<f64>>,
{
    let needs = P::With::from_raws(with).ok_or_else(missing::<P, P::With>)?;
    P::encode_with(value.into(), needs).map(Raw::to_i128)
}

/// The error if raw numbers of other points are missing.
fn missing<P: Point, N: Needs>() -> Error {
    let (point, needs) = (P::NAME, N::points());
    Error::Missing { point, needs }
}
