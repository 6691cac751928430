// SPDX-License-Identifier: 0BSD
//! Why a message cannot be built, why a frame is no such message, and why a word of a telegram is not there.

use core::fmt;

use crate::error::lead;
use crate::{Error, Point};

/// Why a message cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BuildError {
    /// The unit is outside the device's range.
    BadUnit,
    /// The device has no message for this.
    NoMessage,
}

impl BuildError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BadUnit => "bad_unit",
            Self::NoMessage => "no_message",
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::BadUnit => "the device has no such unit number",
            Self::NoMessage => "the device has no message for this",
        })
    }
}

impl core::error::Error for BuildError {}

/// Why a frame is not the message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParseError {
    /// It has another identifier.
    WrongId,
    /// It has not eight bytes.
    WrongLength,
    /// A byte that is always the same is another.
    WrongConstant,
    /// It is of another unit.
    WrongUnit,
    /// The check byte is wrong.
    WrongCheck,
}

impl ParseError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WrongId => "wrong_id",
            Self::WrongLength => "wrong_length",
            Self::WrongConstant => "wrong_constant",
            Self::WrongUnit => "wrong_unit",
            Self::WrongCheck => "wrong_check",
        }
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::WrongId => "the frame has another identifier",
            Self::WrongLength => "the frame has not eight bytes",
            Self::WrongConstant => "a constant byte is another",
            Self::WrongUnit => "the frame is of another unit",
            Self::WrongCheck => "the check byte is wrong",
        })
    }
}

impl core::error::Error for ParseError {}

/// Why a telegram has no word, or no words that belong together. The text beside a variant is the point's name.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReceiveError {
    /// A frame with the word never came.
    Missing(Option<&'static str>),
    /// The words are of two frames, and the high one may have changed between them.
    Torn(Option<&'static str>),
    /// The words came and have no value.
    Point(Error),
}

impl ReceiveError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Missing(_) => "missing",
            Self::Torn(_) => "torn",
            Self::Point(error) => error.name(),
        }
    }

    /// The name of the point that it is about, if it is about one.
    #[must_use]
    pub const fn point(self) -> Option<&'static str> {
        match self {
            Self::Missing(point) | Self::Torn(point) => point,
            Self::Point(error) => error.point(),
        }
    }

    /// The same about this point, where it does not say yet which it is about.
    #[must_use]
    pub fn of<P: Point>(self) -> Self {
        self.named(P::NAME)
    }

    /// The same about the point of that name.
    pub(super) fn named(self, name: &'static str) -> Self {
        match self {
            Self::Missing(point) => Self::Missing(point.or(Some(name))),
            Self::Torn(point) => Self::Torn(point.or(Some(name))),
            Self::Point(error) => Self::Point(error.named(name)),
        }
    }
}

impl fmt::Display for ReceiveError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (point, text) = match self {
            Self::Missing(point) => (point, "the frame with the word never came"),
            Self::Torn(point) => (point, "the words may belong to different moments"),
            Self::Point(error) => return error.fmt(formatter),
        };
        lead(*point, formatter)?;
        formatter.write_str(text)
    }
}

impl core::error::Error for ReceiveError {}
