// SPDX-License-Identifier: 0BSD
//! What addresses count from: a number of the caller, or a block that is found in the device.

/// Where the addresses of some points start, and the last one that counts from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Base {
    /// The name that points and blocks call it by.
    pub name: &'static str,
    /// The address on the wire that others count from.
    pub start: u16,
    /// The last address that counts from it.
    pub last: u16,
}

impl Base {
    /// Addresses that count from 0.
    pub(super) const NONE: Self = Self::at("", 0);
    /// A base that nobody knows.
    const UNKNOWN: (u16, u16) = (u16::MAX, u16::MAX);

    /// Addresses that count from `start` up to `last`.
    #[must_use]
    pub const fn new(name: &'static str, start: u16, last: u16) -> Self {
        Self { name, start, last }
    }

    /// Addresses that count from `start` up to the last of the wire.
    #[must_use]
    pub const fn at(name: &'static str, start: u16) -> Self {
        Self::new(name, start, u16::MAX - start)
    }

    /// A base by its name, of which nobody knows where it is; that of 0 has no name.
    pub(super) const fn named(name: &'static str) -> Self {
        if name.is_empty() {
            return Self::NONE;
        }
        let (start, last) = Self::UNKNOWN;
        Self { name, start, last }
    }

    /// Whether it is known where this is.
    pub(super) fn is_known(&self) -> bool {
        self.start.checked_add(self.last).is_some()
    }
}

/// A number that a base follows from: the least and the greatest one, and by how much it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given {
    ends: (u16, u16),
    factor: i32,
}

impl Given {
    /// A number from `low` to `high` that counts `factor` times.
    #[must_use]
    pub const fn new(low: u16, high: u16, factor: i32) -> Self {
        let ends = (low, high);
        Self { ends, factor }
    }
}

/// A base that follows from given numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenBase {
    /// The name of the base.
    pub name: &'static str,
    offset: i32,
    given: &'static [Given],
}

impl GivenBase {
    /// `offset` and the multiples of given numbers.
    #[must_use]
    pub const fn new(name: &'static str, offset: i32, given: &'static [Given]) -> Self {
        Self {
            name,
            offset,
            given,
        }
    }

    /// The base for these numbers, in the order of the formula; none if they are others, or too few.
    #[must_use]
    pub fn at(&self, numbers: &[u16]) -> Option<Base> {
        let mut start = i64::from(self.offset);
        if numbers.len() != self.given.len() {
            return None;
        }
        for (number, given) in numbers.iter().zip(self.given) {
            let (low, high) = given.ends;
            if !(low..=high).contains(number) {
                return None;
            }
            start = start.checked_add(i64::from(*number).checked_mul(i64::from(given.factor))?)?;
        }
        Some(Base::at(self.name, u16::try_from(start).ok()?))
    }
}

/// Blocks behind a marker: each starts with its id and how many words follow these two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chain {
    /// The function that reads them.
    pub function: u8,
    /// The words before the first block.
    pub marker: &'static [u16],
    /// Where the marker may stand, in the order of the search.
    pub places: &'static [u16],
    /// What stands in place of an id behind the last block.
    pub end: u16,
}

impl Chain {
    /// Blocks behind a marker at one of these places.
    #[must_use]
    pub const fn new(
        function: u8,
        marker: &'static [u16],
        places: &'static [u16],
        end: u16,
    ) -> Self {
        Self {
            function,
            marker,
            places,
            end,
        }
    }
}

/// A base that is the start of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoundBlock {
    /// The name of the base.
    pub name: &'static str,
    /// The blocks of the device.
    pub chain: &'static Chain,
    /// The id of this one.
    pub id: u16,
}

impl FoundBlock {
    /// The block of that id.
    #[must_use]
    pub const fn new(name: &'static str, chain: &'static Chain, id: u16) -> Self {
        Self { name, chain, id }
    }
}

/// So many blocks are looked at: a broken device must not keep the line busy.
pub(super) const MOST_BLOCKS: usize = 256;
