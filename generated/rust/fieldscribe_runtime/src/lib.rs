// SPDX-License-Identifier: 0BSD
//! What the modules that fieldscribe generates have in common: the traits of a point, exact arithmetic, and for each
//! family of buses a module with its frames and its clients: [`modbus`], [`can`], [`uss`].
//!
//! Nothing here allocates, does input or output, or panics.

#![no_std]
#![forbid(unsafe_code)]

// x87 arithmetic rounds twice, and values would not be exact to the bit.
#[cfg(all(target_arch = "x86", not(target_feature = "sse2")))]
compile_error!("floating point needs SSE2 here: build for i686, or with -C target-feature=+sse2");

pub mod arithmetic;
pub mod can;
pub mod client;
pub mod digits;
pub mod flags;
pub mod modbus;
mod pattern;
mod point;
mod raw;
mod rule;
mod special;
pub mod text;
pub mod uss;

pub use flags::{Flag, Flags};
pub use point::{
    allowed, group, in_address_order, in_reading_order, listed, signed_group, BitGroup,
    CountReadable, CountWritable, Decoded, Digits, Documented, Encodable, Point, Readable, Scaled,
    Space, Whole, Writable,
};
pub use raw::Raw;
pub use rule::Rule;
pub use special::{factor, quantity, written, Code, Coded, Reading, Special};
pub use text::Text;

use core::fmt;

/// Why a number could not be encoded, decoded or checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error {
    /// The raw number is outside what the manual allows.
    OutOfRange,
    /// The value is not a number.
    NotANumber,
    /// The closed enum has no such number.
    UnknownValue,
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

impl Error {
    /// The error's name as the conformance vectors have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfRange => "out_of_range",
            Self::NotANumber => "not_a_number",
            Self::UnknownValue => "unknown_value",
            Self::ZeroFactor => "zero_factor",
            Self::NoCase => "no_case",
            Self::Overflow => "overflow",
            Self::Special => "special",
            Self::WrongLength => "wrong_length",
            Self::WrongSpace => "wrong_space",
            Self::NotHeard => "not_heard",
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::OutOfRange => "the raw number is outside what is allowed",
            Self::NotANumber => "the value is not a number",
            Self::UnknownValue => "the enum has no such number",
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

impl core::error::Error for Error {}
