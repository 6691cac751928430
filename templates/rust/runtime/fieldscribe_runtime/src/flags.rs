// SPDX-License-Identifier: 0BSD
//! Words whose bits have names, and how they are formatted.

use core::fmt;

/// Numbers of several bits that have names.
pub type Names = &'static [(u64, &'static str)];

/// A bit of a word that has a name, or several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flag {
    name: &'static str,
    mask: u64,
    is_active_low: bool,
    names: Names,
}

impl Flag {
    /// A bit that is true while it is 1, or bits that are a number.
    #[must_use]
    pub const fn new(name: &'static str, mask: u64) -> Self {
        Self {
            name,
            mask,
            is_active_low: false,
            names: &[],
        }
    }

    /// A bit that is true while it is 0.
    #[must_use]
    pub const fn active_low(name: &'static str, mask: u64) -> Self {
        Self {
            name,
            mask,
            is_active_low: true,
            names: &[],
        }
    }

    /// Bits that are a number, and the numbers that have names.
    #[must_use]
    pub const fn named(name: &'static str, mask: u64, names: Names) -> Self {
        Self {
            name,
            mask,
            is_active_low: false,
            names,
        }
    }

    /// The name of a number of the flag, if it has one.
    #[must_use]
    pub fn name_of(&self, number: u64) -> Option<&'static str> {
        let found = self.names.iter().find(|one| one.0 == number);
        found.map(|one| one.1)
    }

    /// The name in the description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The bits of the word.
    #[must_use]
    pub const fn mask(&self) -> u64 {
        self.mask
    }

    /// True if the flag is true while its bit is 0.
    #[must_use]
    pub const fn is_active_low(&self) -> bool {
        self.is_active_low
    }

    /// The number of the flag in a word; for a single bit, 1 if the flag is true, even if its bit is 0.
    #[must_use]
    pub const fn number(&self, word: u64) -> u64 {
        if self.is_active_low {
            return (word & self.mask == 0) as u64;
        }
        let number = (word & self.mask).checked_shr(self.mask.trailing_zeros());
        match number {
            Some(number) => number,
            None => 0,
        }
    }
}

/// A word whose bits have names.
pub trait Flags: Copy {
    /// The name of the type.
    const NAME: &'static str;
    /// The flags, in the order of the description.
    const FLAGS: &'static [Flag];

    /// The word.
    fn bits(self) -> u64;
}

/// Writes a word as its number, then its true flags and the fields that are not 0:
/// `StatusWord(0x2031: ready, state=running, trips=2)`.
///
/// # Errors
/// The error of the formatter.
pub fn show<F: Flags>(word: F, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    let bits = word.bits();
    write!(formatter, "{}({bits:#06X}", F::NAME)?;
    let mut sign = ": ";
    for flag in F::FLAGS {
        let number = flag.number(bits);
        if number == 0 {
            continue;
        }
        write!(formatter, "{sign}{}", flag.name)?;
        match flag.name_of(number) {
            Some(name) => write!(formatter, "={name}")?,
            None if flag.mask.is_power_of_two() => {}
            None => write!(formatter, "={number}")?,
        }
        sign = ", ";
    }
    formatter.write_str(")")
}
