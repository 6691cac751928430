// SPDX-License-Identifier: 0BSD
//! What Modbus functions do.

use crate::Space;

/// The function that reads a space; 0, which no device knows, if none does.
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

/// The function that writes `count` items of a space; 0, which no device knows, if none does.
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

/// The largest count that a frame of the function can hold; none for a function that is not ours.
pub(super) const fn longest_count(function: u8) -> Option<u16> {
    match function {
        1 | 2 => Some(2000),
        3 | 4 => Some(125),
        5 | 6 | 8 => Some(1),
        15 => Some(1968),
        16 => Some(123),
        _ => None,
    }
}

pub(super) const fn is_read(function: u8) -> bool {
    matches!(function, 1..=4)
}

pub(super) const fn writes(function: u8) -> bool {
    matches!(function, 5 | 6 | 15 | 16)
}
