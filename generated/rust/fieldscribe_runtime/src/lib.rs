// SPDX-License-Identifier: 0BSD
//! The common part of the modules that fieldscribe generates: the traits of a point, exact arithmetic, and for each
//! family of buses a module with its frames and its clients: [`modbus`], [`can`], [`uss`].
//!
//! Nothing here allocates, does I/O, or panics. Transports that do I/O are features of [`transports`].

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

// x87 arithmetic rounds twice, and values would not be exact to the bit.
#[cfg(all(target_arch = "x86", not(target_feature = "sse2")))]
compile_error!("floating point needs SSE2 here: build for i686, or with -C target-feature=+sse2");

pub mod arithmetic;
pub mod can;
pub mod check;
pub mod client;
mod client_error;
pub mod coding;
pub mod data;
pub mod date_time;
mod device;
pub mod digits;
mod display;
mod error;
pub mod flags;
pub mod form;
mod frame_error;
mod given;
mod identification;
mod info;
mod macros;
pub mod modbus;
mod named;
mod path;
mod pattern;
mod point;
mod raw;
mod rule;
mod scale;
mod special;
pub mod text;
mod trace;
pub mod transports;
pub mod uss;

pub use client::{AsyncTransport, LocalTransport, Transport};
pub use client_error::{About, ClientError};
pub use data::{AnyValue, PointFacts, Selection};
pub use date_time::DateTime;
pub use device::{Accepts, AnyDevice, Device};
pub use display::{Displayed, Shown};
pub use error::{Error, Outside, Refused};
pub use flags::{Flag, Flags};
pub use form::Count;
pub use frame_error::{BuildError, ReplyError};
pub use given::Given;
pub use identification::{is_text, Held, HeldWords, Identification, OtherDevice, Variants};
pub use info::{Access, PointInfo, Points};
pub use point::{
    group, in_address_order, in_reading_order, signed_group, BitGroup, CountReadable,
    CountWritable, Decoded, Digits, Documented, Encodable, EncodableAlone, FixedScale, Named,
    NeedsNothing, Point, Readable, Scaled, Space, Whole, Writable, WrittenAlone,
};
pub use raw::Raw;
pub use rule::Rule;
pub use scale::Scale;
pub use special::{
    encoded, quantity, reading, try_reading, written, Code, Coded, Reading, Special,
};
pub use text::{Text, Utf8};
