// SPDX-License-Identifier: 0BSD
//! Why a telegram cannot be built, and why bytes are no answer.

use core::fmt;

/// Why a telegram cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BuildError {
    /// The device does not know the length of the parameter part, or there are other words of process data.
    BadLink,
    /// The unit is outside the device's range.
    BadUnit,
    /// The request is to another unit than the client's, whose process data are not for it.
    OtherUnit,
    /// The device takes nothing that is sent to all units.
    NoBroadcast,
    /// The device does not know the task, or the link has no parameter part.
    BadTask,
    /// There is no parameter of this number.
    BadParameter,
    /// The index is above 255.
    BadIndex,
    /// The parameter part has no room for a double word.
    BadValue,
    /// All units are sent the first word without the bits that make it valid.
    BadMask,
    /// The caller's buffer is too small.
    BufferTooSmall,
}

impl BuildError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BadLink | Self::NoBroadcast => "bad_link",
            Self::BadUnit | Self::OtherUnit => "bad_unit",
            Self::BadTask => "bad_task",
            Self::BadParameter => "bad_parameter",
            Self::BadIndex => "bad_index",
            Self::BadValue => "bad_value",
            Self::BadMask => "bad_mask",
            Self::BufferTooSmall => "buffer_too_small",
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::BadLink => "the telegram does not fit the link",
            Self::BadUnit => "the device has no such unit number",
            Self::OtherUnit => "the request is to another unit than the client's",
            Self::NoBroadcast => "the device takes nothing that is sent to all units",
            Self::BadTask => "the device does not know the task, or the link carries none",
            Self::BadParameter => "the parameter number is above 31999",
            Self::BadIndex => "the index is above 255",
            Self::BadValue => "the parameter part has no room for a double word",
            Self::BadMask => "the first word is meant without the bits that make it valid",
            Self::BufferTooSmall => "the buffer is too small",
        })
    }
}

impl core::error::Error for BuildError {}

/// Why bytes are no answer to a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ParseError {
    /// There are no bytes, or the first is not the start of a telegram.
    WrongStart,
    /// The length is not the one that the telegram says or that the link has.
    WrongLength,
    /// The check byte is wrong.
    WrongCheck,
    /// Another unit answered.
    WrongUnit,
    /// The answer is about another parameter or index.
    WrongParameter,
    /// The drive did not answer the task, or not yet: the same request may be sent again.
    NoAnswer,
    /// The drive refused.
    Refused {
        /// The error value that says why.
        error: u16,
        /// Its name in the description.
        name: Option<&'static str>,
    },
    /// The drive does not let this master change parameters.
    NoRights,
    /// The response does not belong to the task.
    WrongResponse,
}

impl ParseError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WrongStart => "wrong_start",
            Self::WrongLength => "wrong_length",
            Self::WrongCheck => "wrong_check",
            Self::WrongUnit => "wrong_unit",
            Self::WrongParameter => "wrong_parameter",
            Self::NoAnswer => "no_answer",
            Self::Refused { .. } => "refused",
            Self::NoRights => "no_rights",
            Self::WrongResponse => "wrong_response",
        }
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongStart => formatter.write_str("the telegram does not start as one"),
            Self::WrongLength => formatter.write_str("the telegram has another length"),
            Self::WrongCheck => formatter.write_str("the check byte is wrong"),
            Self::WrongUnit => formatter.write_str("another unit answered"),
            Self::WrongParameter => formatter.write_str("the answer is about another parameter"),
            Self::NoAnswer => formatter.write_str("the drive did not answer the task"),
            Self::Refused { error, name } => {
                write!(formatter, "the drive refused with error {error}")?;
                name.map_or(Ok(()), |name| write!(formatter, " ({name})"))
            }
            Self::NoRights => formatter.write_str("the drive gives no right to change parameters"),
            Self::WrongResponse => formatter.write_str("the response is not to the task"),
        }
    }
}

impl core::error::Error for ParseError {}
