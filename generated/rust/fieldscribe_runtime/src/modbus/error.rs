// SPDX-License-Identifier: 0BSD
//! Why a request cannot be built, and why bytes are no reply.

use core::fmt;

/// What an error of a client is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum About {
    /// A point, by its name.
    Point(&'static str),
    /// A request that is none of a point, as that of a block or a command.
    Request {
        /// The unit that was asked.
        unit: u8,
        /// The function.
        function: u8,
        /// The first address.
        address: u16,
        /// How many items.
        count: u16,
    },
}

impl fmt::Display for About {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(name) => formatter.write_str(name),
            Self::Request {
                unit,
                function,
                address,
                count,
            } => {
                write!(
                    formatter,
                    "unit {unit}, function {function} at {address:04X}h"
                )?;
                match count {
                    0 | 1 => Ok(()),
                    _ => write!(formatter, ", {count} items"),
                }
            }
        }
    }
}

/// Why a request cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BuildError {
    /// The device speaks the other framing alone.
    BadFraming,
    /// The unit is outside the device's range.
    BadUnit,
    /// The unit is that of all units, and the function does not go to all: nobody could answer.
    NotForAll,
    /// The device does not know the function.
    BadFunction,
    /// There are no items, more than the device takes, or values are missing.
    BadCount,
    /// The items end beyond the last address.
    BadAddress,
    /// Nobody said where the base is that the address counts from.
    NoBase,
    /// A bit is neither 0 nor 1.
    BadValue,
    /// The caller's buffer is too small.
    BufferTooSmall,
}

impl BuildError {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BadFraming => "bad_framing",
            Self::BadUnit | Self::NotForAll => "bad_unit",
            Self::BadFunction => "bad_function",
            Self::BadCount => "bad_count",
            Self::BadAddress => "bad_address",
            Self::NoBase => "bad_base",
            Self::BadValue => "bad_value",
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
            Self::NotForAll => "this cannot be sent to all units",
            Self::BadFunction => "the device does not know the function",
            Self::BadCount => "the device does not take that many items",
            Self::BadAddress => "the items end beyond the last address",
            Self::NoBase => "nobody said where the base is that the address counts from: use `set_base` or `find`",
            Self::BadValue => "a bit is neither 0 nor 1",
            Self::BufferTooSmall => "the buffer is too small",
        })
    }
}

impl core::error::Error for BuildError {}

/// Why bytes are no reply to a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ReplyError {
    /// The request's own function is none of Modbus.
    BadFunction,
    /// Bytes are missing: of the frame, or of the shortest one where its length did not come.
    ShortFrame {
        /// How many bytes the frame has.
        expected: u16,
        /// How many came.
        received: u16,
    },
    /// There are more bytes than the frame has.
    LongFrame {
        /// How many bytes the frame has.
        expected: u16,
        /// How many came.
        received: u16,
    },
    /// The checksum is wrong.
    BadCrc,
    /// The protocol number of the TCP head is not 0.
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
        /// The code that says why.
        code: u8,
        /// Its name in the description, which the [`Profile`](super::Profile) knows. Where there is none, the error
        /// shows the name of the standard.
        name: Option<&'static str>,
    },
    /// The byte count is not what the request asked for.
    BadByteCount {
        /// How many bytes the request asked for.
        expected: u16,
        /// How many the reply counts, or brings.
        received: u16,
    },
    /// What was written is not what the reply repeats.
    EchoMismatch {
        /// The address of the request, and its value or its count of items.
        expected: (u16, u16),
        /// Those of the reply.
        received: (u16, u16),
    },
}

impl ReplyError {
    /// The error's name as the conformance vectors have it.
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
            Self::EchoMismatch { .. } => "echo_mismatch",
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
        }
    }
}

/// What Modbus calls an exception code.
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
