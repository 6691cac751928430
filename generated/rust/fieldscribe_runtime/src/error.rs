// SPDX-License-Identifier: 0BSD
//! Why a number could not be encoded, decoded or checked, with the number and the point.

use core::fmt;

use crate::{Access, Given, Point, PointFacts};

/// Why a number could not be encoded, decoded or checked.
///
/// ```
/// use fieldscribe_runtime::{Error, Outside, Refused};
///
/// let outside = Outside { point: "base_frequency", given: 500.0, low: 30.0, high: 400.0 };
/// let refused = Refused::Value { outside, unit: "Hz", raw: Some((300, 4000)) };
/// let error = Error::OutOfRange(refused);
/// let shown = "base_frequency: 500 Hz is outside 30 to 400 Hz (raw 300 to 4000)";
/// assert_eq!(error.to_string(), shown);
/// assert_eq!(error.point(), Some("base_frequency"));
/// ```
///
/// The text in a variant is the point's name, if there is a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The number is outside the limits, which are included.
    OutOfRange(Refused),
    /// The value is not a number.
    NotANumber(&'static str),
    /// The text is neither a number nor a name of the point.
    UnknownName {
        /// The name of the point.
        point: &'static str,
        /// The text.
        given: Given,
        /// The names that the point knows.
        names: &'static [(i128, &'static str)],
    },
    /// Raw numbers of other points are missing, or one does not fit its type.
    Missing {
        /// The name of the point.
        point: &'static str,
        /// The points whose raw numbers it needs; empty if they depend on the variant of the device.
        needs: &'static [&'static PointFacts],
    },
    /// The device takes the point only together with others, in one request.
    NotTogether {
        /// The name of the point.
        point: &'static str,
        /// The names of the others.
        with: &'static [&'static str],
    },
    /// The closed enum does not have this number, or the point this code.
    UnknownValue(Outside<i64>),
    /// The text is too long, or has a character outside its encoding.
    BadText(Option<&'static str>),
    /// There is no such date or time, or the point has no room for it.
    BadDate(Option<&'static str>),
    /// A factor that is read at run time is zero, or not a quantity.
    ZeroFactor(Option<&'static str>),
    /// No case of the scale applies.
    NoCase(Option<&'static str>),
    /// The result does not fit its type.
    Overflow(Option<&'static str>),
    /// The raw number is a special code: it may not be written, or not as a value.
    Special {
        /// The name of the point.
        point: &'static str,
        /// The name of the code.
        code: &'static str,
        /// Whether the code may be written: by [`Reading::Special`](crate::Reading::Special).
        is_writable: bool,
    },
    /// A point that a scale or limit needs is out of its range.
    BrokenFactor {
        /// The name of the factor's point, its number, and its range.
        factor: Outside<i64>,
        /// The name of the point that needs it.
        point: Option<&'static str>,
    },
    /// The words are no valid text (UTF-8 or UTF-16), or no date, such as the 31st of February.
    Malformed(Option<&'static str>),
    /// There are more or fewer words than the point has.
    WrongLength(Option<&'static str>),
    /// The reply does not contain the point, or not all of it.
    NotBrought(Option<&'static str>),
    /// The link has fewer words of process data.
    BeyondLink(Option<&'static str>),
    /// The reply is of another space than the point's.
    WrongSpace(Option<&'static str>),
    /// The last telegram was not answered, so the point was not received.
    NotHeard(Option<&'static str>),
    /// A frame with a word of the point has not arrived.
    NotReceived(Option<&'static str>),
    /// The words are of two frames, and the high word may have changed between them.
    Torn(Option<&'static str>),
    /// The point cannot be read, or not written; the access that it has.
    Access(&'static str, Access),
}

/// A number that a point does not take, as it was given: raw number, count or value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refused {
    /// A raw number; one beyond `i64` is limited to its ends.
    Raw(Outside<i64>),
    /// A count.
    Count(Outside<i64>),
    /// A value in the point's unit.
    Value {
        /// What was given, and the limits.
        outside: Outside<f64>,
        /// The unit of all three; empty for a plain number.
        unit: &'static str,
        /// The limits as raw numbers, if they differ.
        raw: Option<(i64, i64)>,
    },
    /// A raw number without the constant bits.
    FixedBits {
        /// The point's name.
        point: &'static str,
        /// What was given.
        given: i64,
        /// The mask of the constant bits.
        mask: u32,
        /// Their values, within the mask.
        bits: u32,
    },
    /// A value that is not whole, for a point without a scale.
    Fraction {
        /// The point's name.
        point: &'static str,
        /// What was given.
        given: f64,
    },
}

/// The number given to a point, and the least and the greatest number that it takes now.
///
/// If the manual has several ranges, some numbers between them are not taken either. If limits of other points
/// contradict each other, the least is above the greatest, and no number is taken.
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
    /// The error's name as in the conformance vectors.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfRange(_) | Self::BadText(_) | Self::BadDate(_) => "out_of_range",
            Self::NotANumber(_) | Self::UnknownName { .. } => "not_a_number",
            Self::UnknownValue(_) => "unknown_value",
            Self::NotTogether { .. } => "not_together",
            Self::ZeroFactor(_) => "zero_factor",
            Self::NoCase(_) => "no_case",
            Self::Overflow(_) | Self::BrokenFactor { .. } => "overflow",
            Self::Special { .. } => "special",
            Self::Malformed(_) => "malformed",
            Self::WrongLength(_)
            | Self::NotBrought(_)
            | Self::BeyondLink(_)
            | Self::Missing { .. } => "wrong_length",
            Self::WrongSpace(_) => "wrong_space",
            Self::NotHeard(_) => "not_heard",
            Self::NotReceived(_) => "missing",
            Self::Torn(_) => "torn",
            Self::Access(..) => "access",
        }
    }

    /// The refused number, if this is the reason.
    #[must_use]
    pub const fn refused(self) -> Option<Refused> {
        match self {
            Self::OutOfRange(refused) => Some(refused),
            Self::UnknownValue(outside) => Some(Refused::Raw(outside)),
            _ => None,
        }
    }

    /// The name of the point, if it is about one.
    #[must_use]
    pub const fn point(self) -> Option<&'static str> {
        match self {
            Self::OutOfRange(refused) => Some(refused.point()),
            Self::UnknownValue(outside) => Some(outside.point),
            Self::NotANumber(point)
            | Self::UnknownName { point, .. }
            | Self::Missing { point, .. }
            | Self::NotTogether { point, .. }
            | Self::Special { point, .. }
            | Self::Access(point, _) => Some(point),
            Self::BadText(point)
            | Self::BadDate(point)
            | Self::ZeroFactor(point)
            | Self::NoCase(point)
            | Self::Overflow(point)
            | Self::BrokenFactor { point, .. }
            | Self::Malformed(point)
            | Self::WrongLength(point)
            | Self::NotBrought(point)
            | Self::BeyondLink(point)
            | Self::WrongSpace(point)
            | Self::NotHeard(point)
            | Self::NotReceived(point)
            | Self::Torn(point) => point,
        }
    }

    /// The same error with this point, unless it names one already.
    #[must_use]
    pub fn of<P: Point>(self) -> Self {
        self.named(P::NAME)
    }

    /// The same error with the point of this name.
    pub(crate) fn named(mut self, name: &'static str) -> Self {
        match &mut self {
            Self::BadText(point)
            | Self::BadDate(point)
            | Self::ZeroFactor(point)
            | Self::NoCase(point)
            | Self::Overflow(point)
            | Self::BrokenFactor { point, .. }
            | Self::Malformed(point)
            | Self::WrongLength(point)
            | Self::NotBrought(point)
            | Self::BeyondLink(point)
            | Self::WrongSpace(point)
            | Self::NotHeard(point)
            | Self::NotReceived(point)
            | Self::Torn(point) => *point = point.or(Some(name)),
            _ => {}
        }
        self
    }

    /// The same error with the number that was given, from which the refused raw number was made.
    pub(crate) fn about(mut self, number: i64) -> Self {
        if let Self::OutOfRange(Refused::Raw(outside)) | Self::UnknownValue(outside) = &mut self {
            outside.given = number;
        }
        self
    }
}

impl Refused {
    /// The name of the point that refused.
    #[must_use]
    pub const fn point(self) -> &'static str {
        match self {
            Self::Raw(outside) | Self::Count(outside) => outside.point,
            Self::Value { outside, .. } => outside.point,
            Self::FixedBits { point, .. } | Self::Fraction { point, .. } => point,
        }
    }
}

/// Writes the name of the point first.
pub(crate) fn lead(point: Option<&str>, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    point.map_or(Ok(()), |point| write!(formatter, "{point}: "))
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        lead(self.point(), formatter)?;
        formatter.write_str(match self {
            Self::OutOfRange(refused) => return refused.show(formatter),
            Self::UnknownValue(outside) => {
                return write!(formatter, "nothing has the number {}", outside.given);
            }
            Self::BrokenFactor { factor, .. } => {
                let Outside {
                    point,
                    given,
                    low,
                    high,
                } = factor;
                return write!(
                    formatter,
                    "the factor {point} is {given}, outside {low} to {high}"
                );
            }
            Self::Special {
                code, is_writable, ..
            } => {
                let hint = if *is_writable {
                    ": write it as Reading::Special(...)"
                } else {
                    ", which is only read"
                };
                return write!(
                    formatter,
                    "the number is the special code {code} and no quantity{hint}"
                );
            }
            Self::UnknownName { given, names, .. } => return unknown(*given, names, formatter),
            Self::Missing { needs, .. } => return missing(needs, formatter),
            Self::NotTogether { with, .. } => {
                let before = "`Request::write_values` writes it in one request with ";
                return listed(before, with.iter().copied(), formatter);
            }
            Self::NotANumber(_) => "the value is not a number",
            Self::BadText(_) => {
                "the text is too long, or has a character that is none of its encoding"
            }
            Self::BadDate(_) => "there is no such date or time, or the point has no room for it",
            Self::ZeroFactor(_) => "a factor is zero or no quantity",
            Self::NoCase(_) => "no case of the scale holds",
            Self::Overflow(_) => "the result does not fit its type",
            Self::Malformed(_) => "the words do not hold what they should",
            Self::WrongLength(_) => "the point has another number of words",
            Self::NotBrought(_) => "the reply does not bring the point",
            Self::BeyondLink(_) => "the link has not so many words of process data",
            Self::WrongSpace(_) => "the reply is of another space than the point's",
            Self::NotHeard(_) => "the last telegram was not answered",
            Self::NotReceived(_) => "the frame with the word never came",
            Self::Torn(_) => "the words may belong to different moments",
            Self::Access(_, Access::Read) => "the point is only read",
            Self::Access(_, Access::Write) => "the point is only written",
            Self::Access(..) => "the point is neither read nor written by itself",
        })
    }
}

/// Writes the text, and the first names that it could be.
fn unknown(
    given: Given,
    names: &[(i128, &str)],
    formatter: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    write!(formatter, "{given:?} is not a number")?;
    let mut before = ", nor one of the names ";
    for (_, name) in names.iter().take(MOST_NAMES) {
        write!(formatter, "{before}{name}")?;
        before = ", ";
    }
    formatter.write_str(if names.len() > MOST_NAMES {
        ", ... (`names()` has all)"
    } else {
        ""
    })
}

/// The most names that an error lists.
const MOST_NAMES: usize = 6;

/// Writes the points whose raw numbers are missing.
fn missing(needs: &[&PointFacts], formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    formatter.write_str("the raw numbers of other points are missing")?;
    listed(": ", needs.iter().map(|point| point.name), formatter)
}

/// Writes names, with commas between them.
fn listed(
    mut before: &str,
    names: impl Iterator<Item = &'static str>,
    formatter: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    for name in names {
        write!(formatter, "{before}{name}")?;
        before = ", ";
    }
    Ok(())
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: ", self.point())?;
        self.show(formatter)
    }
}

impl Refused {
    /// Writes what is refused, without the point's name.
    fn show(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Raw(outside) => outside.show("raw ", "", formatter),
            Self::Count(outside) => outside.show("count ", "", formatter),
            Self::Value { outside, unit, raw } => {
                outside.show("", unit, formatter)?;
                match raw {
                    Some((low, high)) => write!(formatter, " (raw {low} to {high})"),
                    None => Ok(()),
                }
            }
            Self::FixedBits {
                given, mask, bits, ..
            } => write!(
                formatter,
                "raw {given} lacks constant bits: those of mask {mask:04X}h are always written as {bits:04X}h"
            ),
            Self::Fraction { given, .. } => write!(formatter, "{given} is not a whole number"),
        }
    }
}

impl<T: fmt::Display + PartialOrd> Outside<T> {
    fn show(&self, what: &str, unit: &str, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            given, low, high, ..
        } = self;
        let gap = if unit.is_empty() { "" } else { " " };
        if low > high {
            return write!(
                formatter,
                "{what}{given}{gap}{unit} is refused, as nothing is allowed now: \
                 the least is {low}{gap}{unit}, the greatest {high}{gap}{unit}"
            );
        }
        write!(
            formatter,
            "{what}{given}{gap}{unit} is outside {low} to {high}{gap}{unit}"
        )
    }
}

impl core::error::Error for Error {}
