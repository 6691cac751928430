// SPDX-License-Identifier: 0BSD
//! Facts of the Modbus functions.

use crate::Space;

/// The function that reads a space; 0, which no device supports, if there is none.
#[must_use]
pub const fn read_function(space: Space) -> u8 {
    match space {
        Space::Coil => 1,
        Space::Discrete => 2,
        Space::Holding => 3,
        Space::Input => 4,
        _ => 0,
    }
}

/// The function that writes `count` items of a space; 0, which no device supports, if there is none.
#[must_use]
pub const fn write_function(space: Space, count: u16) -> u8 {
    match (space, count) {
        (Space::Coil, 1) => 5,
        (Space::Coil, _) => 15,
        (Space::Holding, 1) => 6,
        (Space::Holding, _) => 16,
        _ => 0,
    }
}

/// The largest count that a frame of the function can hold; 0 for an unsupported function.
pub(super) const fn longest_count(function: u8) -> u16 {
    match function {
        1 | 2 => 2000,
        3 | 4 => 125,
        5 | 6 | 8 => 1,
        15 => 1968,
        16 => 123,
        _ => 0,
    }
}

/// True if the function is supported here.
pub(super) const fn is_ours(function: u8) -> bool {
    matches!(function, 1..=6 | 8 | 15 | 16)
}

/// True if the items of the function are bits.
pub(super) const fn is_of_bits(function: u8) -> bool {
    matches!(function, 1 | 2 | 5 | 15)
}

pub(super) const fn is_read(function: u8) -> bool {
    matches!(function, 1..=4)
}

pub(super) const fn writes(function: u8) -> bool {
    matches!(function, 5 | 6 | 15 | 16)
}
