// SPDX-License-Identifier: 0BSD
//! Why a number could not be encoded, decoded or checked, and which number of which point that was.

use core::fmt;

/// Why a number could not be encoded, decoded or checked.
///
/// ```
/// use fieldscribe_runtime::{Error, Outside, Refused};
///
/// let given = Outside { point: "base_frequency", given: 500.0, low: 30.0, high: 400.0 };
/// let error = Error::OutOfRange(Refused::Value(given));
/// assert_eq!(error.to_string(), "base_frequency: 500 is outside 30 to 400");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The number is outside what the manual allows, which is said with it.
    OutOfRange(Refused),
    /// The value is not a number.
    NotANumber,
    /// The closed enum has no such number, or the point no such code.
    UnknownValue(Refused),
    /// The text is too long, or has a character that is none of its encoding.
    BadText,
    /// A factor that is read at run time is zero, or no quantity.
    ZeroFactor,
    /// No case of the scale holds.
    NoCase,
    /// The result does not fit its type.
    Overflow,
    /// The raw number is a special code and no quantity.
    Special,
    /// There are more or fewer words than the point has.
    WrongLength,
    /// The reply is of another space than the point's.
    WrongSpace,
    /// The last telegram was not answered, so nothing was heard of the point.
    NotHeard,
}

/// A number that a point does not take, in the terms in which it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refused {
    /// A raw number; one beyond an `i64` is shown as the end of that.
    Raw(Outside<i64>),
    /// A count.
    Count(Outside<i64>),
    /// A value in the point's unit.
    Value(Outside<f64>),
}

/// What was given to a point, and the least and the greatest number that it takes now.
///
/// Between them may be numbers that it does not take either, where the manual has several ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside<T> {
    /// The point's name.
    pub point: &'static str,
    /// What was given.
    pub given: T,
    /// The least that the point takes.
    pub low: T,
    /// The greatest that the point takes.
    pub high: T,
}

impl Error {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfRange(_) | Self::BadText => "out_of_range",
            Self::NotANumber => "not_a_number",
            Self::UnknownValue(_) => "unknown_value",
            Self::ZeroFactor => "zero_factor",
            Self::NoCase => "no_case",
            Self::Overflow => "overflow",
            Self::Special => "special",
            Self::WrongLength => "wrong_length",
            Self::WrongSpace => "wrong_space",
            Self::NotHeard => "not_heard",
        }
    }

    /// What was refused, if that is why.
    #[must_use]
    pub const fn refused(self) -> Option<Refused> {
        match self {
            Self::OutOfRange(refused) | Self::UnknownValue(refused) => Some(refused),
            _ => None,
        }
    }
}

impl Refused {
    /// The name of the point that refused.
    #[must_use]
    pub const fn point(self) -> &'static str {
        match self {
            Self::Raw(outside) | Self::Count(outside) => outside.point,
            Self::Value(outside) => outside.point,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::OutOfRange(refused) => return refused.fmt(formatter),
            Self::UnknownValue(Refused::Raw(outside)) => {
                return write!(
                    formatter,
                    "{}: nothing has the number {}",
                    outside.point, outside.given
                );
            }
            Self::NotANumber => "the value is not a number",
            Self::UnknownValue(_) => "the enum has no such number",
            Self::BadText => {
                "the text is too long, or has a character that is none of its encoding"
            }
            Self::ZeroFactor => "a factor is zero",
            Self::NoCase => "no case of the scale holds",
            Self::Overflow => "the result does not fit its type",
            Self::Special => "the raw number is a special code and no quantity",
            Self::WrongLength => "the point has another number of words",
            Self::WrongSpace => "the reply is of another space than the point's",
            Self::NotHeard => "the last telegram was not answered",
        })
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Raw(outside) => outside.show("raw ", formatter),
            Self::Count(outside) => outside.show("count ", formatter),
            Self::Value(outside) => outside.show("", formatter),
        }
    }
}

impl<T: fmt::Display> Outside<T> {
    fn show(&self, what: &str, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            point,
            given,
            low,
            high,
        } = self;
        write!(
            formatter,
            "{point}: {what}{given} is outside {low} to {high}"
        )
    }
}

impl core::error::Error for Error {}
