// SPDX-License-Identifier: 0BSD
//! Why a request cannot be built, and why bytes are no valid reply, for all families.

use core::fmt;

/// Why a request cannot be built: a mistake of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BuildError {
    /// The device supports only the other framing.
    BadFraming,
    /// The unit is outside the device's range.
    BadUnit,
    /// The request is for another unit than the client's, so the client's process data are not for it.
    OtherUnit,
    /// The unit is the broadcast unit, but the function cannot be broadcast.
    NotForAll,
    /// The device takes no broadcasts.
    NoBroadcast,
    /// The device does not support the function.
    BadFunction,
    /// There are no items, more than the device takes, or values are missing.
    BadCount,
    /// The items end after the last address.
    BadAddress,
    /// The base that the address counts from is not known.
    NoBase,
    /// A bit is neither 0 nor 1.
    BadBit,
    /// The device does not support this length of the parameter part, or the number of process data words differs.
    BadLink,
    /// The device does not support the task, or the link has no parameter part.
    BadTask,
    /// There is no parameter with this number.
    BadParameter,
    /// The index is above 255.
    BadIndex,
    /// The parameter part has no room for a double word.
    NoRoom,
    /// A broadcast lacks the bits that make its first word valid.
    BadMask,
    /// The device has no message for this.
    NoMessage,
    /// The caller's buffer is too small.
    BufferTooSmall,
}

impl BuildError {
    /// The error's name as in the conformance vectors.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BadFraming => "bad_framing",
            Self::BadUnit | Self::OtherUnit | Self::NotForAll => "bad_unit",
            Self::BadFunction => "bad_function",
            Self::BadCount => "bad_count",
            Self::BadAddress => "bad_address",
            Self::NoBase => "bad_base",
            Self::BadBit | Self::NoRoom => "bad_value",
            Self::BadLink | Self::NoBroadcast => "bad_link",
            Self::BadTask => "bad_task",
            Self::BadParameter => "bad_parameter",
            Self::BadIndex => "bad_index",
            Self::BadMask => "bad_mask",
            Self::NoMessage => "no_message",
            Self::BufferTooSmall => "buffer_too_small",
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::BadFraming => {
                "the device does not speak this framing; behind a gateway that does, use `with_framings`"
            }
            Self::BadUnit => "the device has no such unit number",
            Self::OtherUnit => "the request is to another unit than the client's",
            Self::NotForAll => "this cannot be sent to all units",
            Self::NoBroadcast => "the device takes nothing that is sent to all units",
            Self::BadFunction => "the device does not know the function",
            Self::BadCount => "the device does not take that many items",
            Self::BadAddress => "the items end beyond the last address",
            Self::NoBase => "nobody said where the base is that the address counts from: use `set_base` or `find`",
            Self::BadBit => "a bit is neither 0 nor 1",
            Self::BadLink => "the telegram does not fit the link",
            Self::BadTask => "the device does not know the task, or the link carries none",
            Self::BadParameter => "the parameter number is above 31999",
            Self::BadIndex => "the index is above 255",
            Self::NoRoom => "the parameter part has no room for a double word",
            Self::BadMask => "the first word is meant without the bits that make it valid",
            Self::NoMessage => "the device has no message for this",
            Self::BufferTooSmall => "the buffer is too small",
        })
    }
}

impl core::error::Error for BuildError {}

/// Why bytes are no valid reply to a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ReplyError {
    /// The function of the request is not supported here.
    BadFunction,
    /// Bytes are missing: of the frame, or of the shortest frame if its length did not arrive.
    ShortFrame {
        /// The number of bytes of the frame.
        expected: u16,
        /// The number of bytes received.
        received: u16,
    },
    /// There are more bytes than the frame has.
    LongFrame {
        /// The number of bytes of the frame.
        expected: u16,
        /// The number of bytes received.
        received: u16,
    },
    /// The checksum is wrong.
    BadCrc,
    /// The protocol number of the TCP header is not 0.
    BadProtocol,
    /// The reply belongs to another transaction.
    WrongTransaction {
        /// The transaction of the request.
        expected: u16,
        /// The transaction of the reply.
        received: u16,
    },
    /// Another unit replied.
    WrongUnit {
        /// The unit of the request.
        expected: u8,
        /// The unit of the reply.
        received: u8,
    },
    /// The reply is to another function.
    WrongFunction {
        /// The function of the request.
        expected: u8,
        /// The function of the reply.
        received: u8,
    },
    /// The device refused.
    Exception {
        /// The exception code.
        code: u8,
        /// Its name in the description, from the [`Profile`](crate::modbus::Profile). Without one, the error shows the
        /// standard's name.
        name: Option<&'static str>,
    },
    /// The byte count is not what the request asked for.
    BadByteCount {
        /// The number of bytes that the request needs.
        expected: u16,
        /// The number that the reply states, or has.
        received: u16,
    },
    /// The reply does not repeat what was written.
    EchoMismatch {
        /// The address of the request, and its value or number of items.
        expected: (u16, u16),
        /// Those of the reply.
        received: (u16, u16),
    },
    /// The device answered a write with another number, or with none.
    OtherNumber {
        /// What was written.
        written: u32,
        /// What the device answered.
        answered: Option<u32>,
    },
    /// The same for patterns of binary32 numbers.
    OtherFloat {
        /// What was written.
        written: u32,
        /// What the device answered.
        answered: u32,
    },
    /// The device has not answered the request yet: send the same request again.
    NoAnswer,
    /// There are no bytes, or the first is not the start of a telegram.
    WrongStart,
    /// The length differs from that in the telegram, or that of the link.
    WrongLength,
    /// The check byte is wrong.
    WrongCheck,
    /// The answer is for another parameter or index.
    WrongParameter,
    /// The drive refused.
    Refused {
        /// The error number.
        error: u16,
        /// Its name in the description.
        name: Option<&'static str>,
    },
    /// The drive does not allow this master to change parameters.
    NoRights,
    /// The response does not belong to the task.
    WrongResponse {
        /// The task of the request.
        task: u8,
        /// The response of the reply.
        response: u8,
    },
}

impl ReplyError {
    /// The error's name as in the conformance vectors.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BadFunction => "bad_function",
            Self::ShortFrame { .. } => "short_frame",
            Self::LongFrame { .. } => "long_frame",
            Self::BadCrc => "bad_crc",
            Self::BadProtocol => "bad_protocol",
            Self::WrongTransaction { .. } => "wrong_transaction",
            Self::WrongUnit { .. } => "wrong_unit",
            Self::WrongFunction { .. } => "wrong_function",
            Self::Exception { .. } => "exception",
            Self::BadByteCount { .. } => "bad_byte_count",
            Self::EchoMismatch { .. } | Self::OtherNumber { .. } | Self::OtherFloat { .. } => {
                "echo_mismatch"
            }
            Self::NoAnswer => "no_answer",
            Self::WrongStart => "wrong_start",
            Self::WrongLength => "wrong_length",
            Self::WrongCheck => "wrong_check",
            Self::WrongParameter => "wrong_parameter",
            Self::Refused { .. } => "refused",
            Self::NoRights => "no_rights",
            Self::WrongResponse { .. } => "wrong_response",
        }
    }

    /// True if a frame was lost or damaged on the line, so that trying again may help, and not if the device refused or
    /// took another number. A gateway's exception 0Ah or 0Bh counts too, unless the device has a name for it.
    #[must_use]
    pub const fn is_lost(self) -> bool {
        match self {
            Self::Exception { code, name } => matches!((code, name), (0x0A | 0x0B, None)),
            Self::BadFunction
            | Self::EchoMismatch { .. }
            | Self::OtherNumber { .. }
            | Self::OtherFloat { .. }
            | Self::Refused { .. }
            | Self::NoRights => false,
            _ => true,
        }
    }
}

impl fmt::Display for ReplyError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadFunction => formatter.write_str("the function is none of Modbus"),
            Self::ShortFrame { expected, received } | Self::LongFrame { expected, received } => {
                write!(formatter, "{received} bytes came instead of {expected}")
            }
            Self::BadCrc => formatter.write_str("the checksum is wrong"),
            Self::BadProtocol => formatter.write_str("the protocol number is not 0"),
            Self::WrongTransaction { expected, received } => {
                write!(
                    formatter,
                    "the reply is to transaction {received} instead of {expected}"
                )
            }
            Self::WrongUnit { expected, received } => {
                write!(formatter, "unit {received} replied instead of {expected}")
            }
            Self::WrongFunction { expected, received } => {
                write!(
                    formatter,
                    "the reply is to function {received:02X}h instead of {expected:02X}h"
                )
            }
            Self::Exception { code, name } => {
                write!(formatter, "the device refused with exception {code:02X}h")?;
                name.or_else(|| standard_name(*code))
                    .map_or(Ok(()), |name| write!(formatter, " ({name})"))
            }
            Self::BadByteCount { expected, received } => {
                write!(
                    formatter,
                    "the reply has {received} data bytes instead of {expected}"
                )
            }
            Self::EchoMismatch { expected, received } => {
                let ((to, written), (at, repeated)) = (expected, received);
                write!(
                    formatter,
                    "{written:04X}h was written to {to:04X}h, the reply repeats {repeated:04X}h at {at:04X}h"
                )
            }
            Self::OtherNumber { written, answered } => {
                write!(formatter, "{written} was written, the device answered ")?;
                match answered {
                    Some(number) => number.fmt(formatter),
                    None => formatter.write_str("nothing"),
                }
            }
            Self::OtherFloat { written, answered } => {
                let [written, answered] = [*written, *answered].map(f32::from_bits);
                write!(
                    formatter,
                    "{written} was written, the device answered {answered}"
                )
            }
            Self::NoAnswer => formatter.write_str("the device did not answer what was asked"),
            Self::WrongStart => formatter.write_str("the reply does not begin with 02h"),
            Self::WrongLength => {
                formatter.write_str("the reply does not fit the link: is that of the drive set so?")
            }
            Self::WrongCheck => formatter.write_str("the check byte is wrong"),
            Self::WrongParameter => formatter.write_str("the answer is about another parameter"),
            Self::Refused { error, name } => {
                write!(formatter, "the drive refused with error {error}")?;
                name.map_or(Ok(()), |name| write!(formatter, " ({name})"))
            }
            Self::NoRights => formatter.write_str("the drive gives no right to change parameters"),
            Self::WrongResponse { task, response } => {
                write!(
                    formatter,
                    "response {response} does not belong to task {task}"
                )
            }
        }
    }
}

/// The standard's name of an exception code.
const fn standard_name(code: u8) -> Option<&'static str> {
    Some(match code {
        0x01 => "illegal_function",
        0x02 => "illegal_data_address",
        0x03 => "illegal_data_value",
        0x04 => "server_device_failure",
        0x05 => "acknowledge",
        0x06 => "server_device_busy",
        0x08 => "memory_parity_error",
        0x0A => "gateway_path_unavailable",
        0x0B => "gateway_target_device_failed_to_respond",
        _ => return None,
    })
}

impl core::error::Error for ReplyError {}
