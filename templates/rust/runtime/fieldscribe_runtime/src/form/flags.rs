// SPDX-License-Identifier: 0BSD
//! Points that are words whose bits have names.

pub use crate::form::plain::{check, decode, decode_count, encode, encode_count};
