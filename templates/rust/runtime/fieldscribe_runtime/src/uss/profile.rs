// SPDX-License-Identifier: 0BSD
//! What telegrams need to know about a device, as constants of the generated code, and the settings of a link.

use super::{Sent, VARIABLE};
use crate::ReplyError;

/// The settings of a link: the number of words of the parameter part (0, 3, 4, or 127 for a variable length) and of
/// process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    pub(super) pkw: u8,
    pub(super) pzd: u8,
    single_first: bool,
}

impl Link {
    /// Returns a link with these numbers of words of the parameter part and of process data.
    #[must_use]
    pub const fn new(pkw: u8, pzd: u8) -> Self {
        Self {
            pkw,
            pzd,
            single_first: false,
        }
    }

    /// Returns the same link for firmware that puts a single word into the first value word of a parameter part of four
    /// words.
    #[must_use]
    pub const fn single_first(self) -> Self {
        Self {
            single_first: true,
            ..self
        }
    }

    /// Returns the number of words of the parameter part that a master sends.
    pub(super) const fn sent(self) -> usize {
        match self.pkw {
            0 => 0,
            3 => 3,
            _ => 4,
        }
    }

    /// Returns true if a single word stands in the second value word.
    pub(super) const fn single_last(self) -> bool {
        self.pkw == 4 && !self.single_first
    }

    /// Returns true if an answer may have a parameter part of this many words.
    pub(super) fn takes(self, words: usize) -> bool {
        if self.pkw == VARIABLE {
            words >= 3
        } else {
            words == usize::from(self.pkw)
        }
    }
}

/// A task that a device knows, with the responses that confirm it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task {
    number: u8,
    answers: &'static [u8],
}

impl Task {
    /// A task and the responses to it.
    #[must_use]
    pub const fn new(number: u8, answers: &'static [u8]) -> Self {
        Self { number, answers }
    }
}

/// The bits of a word of process data that are always sent as a constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedBits {
    position: u16,
    bits: u16,
}

impl FixedBits {
    /// Returns the constant bits of a point.
    #[must_use]
    pub const fn of<P: Sent>() -> Self {
        let [_, _, high, low] = P::FIXED_BITS.to_be_bytes();
        Self {
            position: P::ADDRESS,
            bits: u16::from_be_bytes([high, low]),
        }
    }
}

/// What telegrams need to know about a device.
#[derive(Clone, Copy, Debug)]
pub struct Profile {
    tasks: &'static [Task],
    pub(super) units: (u8, u8),
    pkw: &'static [u8],
    pzd: (u8, u8),
    pub(super) broadcast: Option<u8>,
    fixed: &'static [FixedBits],
    name: fn(u16) -> Option<&'static str>,
}

impl Profile {
    /// The tasks, the least and the greatest unit, the lengths of the parameter part, the least and the greatest number
    /// of words of process data, the address that means all units, and the fixed bits of the process data.
    #[must_use]
    pub const fn new(
        tasks: &'static [Task],
        units: (u8, u8),
        pkw: &'static [u8],
        pzd: (u8, u8),
        broadcast: Option<u8>,
        fixed: &'static [FixedBits],
    ) -> Self {
        Self {
            tasks,
            units,
            pkw,
            pzd,
            broadcast,
            fixed,
            name: |_| None,
        }
    }

    /// Returns the same profile with names for error values.
    #[must_use]
    pub const fn naming(self, name: fn(u16) -> Option<&'static str>) -> Self {
        Self { name, ..self }
    }

    /// Returns the refusal of an error value, with the drive's name for it.
    #[must_use]
    pub fn refusal(&self, error: u16) -> ReplyError {
        let name = (self.name)(error);
        ReplyError::Refused { error, name }
    }

    pub(super) fn knows(&self, task: u8) -> bool {
        self.tasks.iter().any(|one| one.number == task)
    }

    pub(super) fn answers(&self, task: u8, response: u8) -> bool {
        let fits = |one: &Task| one.number == task && one.answers.contains(&response);
        self.tasks.iter().any(fits)
    }

    /// The bits of the first word of process data that are always 1: without them, a drive ignores the word.
    pub(super) fn valid_bits(&self) -> u16 {
        let first = self.fixed.iter().filter(|one| one.position == 0);
        first.fold(0, |bits, one| bits | one.bits)
    }

    pub(super) fn takes_pkw(&self, link: Link) -> bool {
        self.pkw.contains(&link.pkw)
    }

    pub(super) fn takes_pzd(&self, link: Link, words: &[u16]) -> bool {
        let (least, greatest) = self.pzd;
        (least..=greatest).contains(&link.pzd) && words.len() == usize::from(link.pzd)
    }
}
