// SPDX-License-Identifier: 0BSD
//! Why a frame is no such message.

use core::fmt;

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
