// SPDX-License-Identifier: 0BSD
//! Bases of addresses: from a number of the caller, or a block that is found in the device.

/// The address where a base starts, and the last address relative to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Base {
    /// Its name in points and blocks.
    pub name: &'static str,
    /// Its address on the wire.
    pub start: u16,
    /// The last address, relative to the base.
    pub last: u16,
}

impl Base {
    /// Addresses that count from 0.
    pub(super) const NONE: Self = Self::at("", 0);
    /// A base that is not known.
    const UNKNOWN: (u16, u16) = (u16::MAX, u16::MAX);

    /// Addresses that count from `start` up to `last`.
    #[must_use]
    pub const fn new(name: &'static str, start: u16, last: u16) -> Self {
        Self { name, start, last }
    }

    /// Addresses that count from `start` up to the last one on the wire.
    #[must_use]
    pub const fn at(name: &'static str, start: u16) -> Self {
        Self::new(name, start, u16::MAX - start)
    }

    /// A base that is known only by name; the base 0 has no name.
    pub(super) const fn named(name: &'static str) -> Self {
        if name.is_empty() {
            return Self::NONE;
        }
        let (start, last) = Self::UNKNOWN;
        Self { name, start, last }
    }

    /// True if the address of the base is known.
    pub(super) fn is_known(&self) -> bool {
        self.start.checked_add(self.last).is_some()
    }
}

/// A number from which a base is computed: its range, and its factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given {
    ends: (u16, u16),
    factor: i32,
}

impl Given {
    /// A number from `low` to `high`, multiplied by `factor`.
    #[must_use]
    pub const fn new(low: u16, high: u16, factor: i32) -> Self {
        let ends = (low, high);
        Self { ends, factor }
    }
}

/// A base that is computed from given numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenBase {
    /// The name of the base.
    pub name: &'static str,
    offset: i32,
    given: &'static [Given],
}

impl GivenBase {
    /// `offset` plus multiples of given numbers.
    #[must_use]
    pub const fn new(name: &'static str, offset: i32, given: &'static [Given]) -> Self {
        Self {
            name,
            offset,
            given,
        }
    }

    /// The base for these numbers, in the order of the formula; [`None`] if one is out of range or missing.
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

/// Blocks after a marker: each starts with its id and the number of words that follow these two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chain {
    /// The function that reads them.
    pub function: u8,
    /// The words before the first block.
    pub marker: &'static [u16],
    /// The addresses where the marker may be, in the order of the search.
    pub places: &'static [u16],
    /// The id that ends the chain.
    pub end: u16,
}

impl Chain {
    /// Blocks after a marker at one of these addresses.
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
    /// The block with this id.
    #[must_use]
    pub const fn new(name: &'static str, chain: &'static Chain, id: u16) -> Self {
        Self { name, chain, id }
    }
}

/// The most blocks that a search reads, so that a broken device cannot keep the line busy.
pub(super) const MOST_BLOCKS: usize = 256;
