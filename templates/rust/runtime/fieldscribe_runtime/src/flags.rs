// SPDX-License-Identifier: 0BSD
//! Words whose bits have names.

/// One bit, or several, inside a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flag {
    /// The lowest bit; bit 0 is the lowest of all.
    pub low: u32,
    /// How many bits.
    pub width: u32,
    /// The value of a single bit that means the name is true: `false` for an inverted bit.
    pub active: bool,
}

impl Flag {
    /// `width` bits from bit `low` up.
    #[must_use]
    pub const fn new(low: u32, width: u32, active: bool) -> Self {
        Self { low, width, active }
    }

    /// The flag's bits inside a word.
    #[must_use]
    pub const fn mask(self) -> u64 {
        let ones = match u64::MAX.checked_shr(64_u32.saturating_sub(self.width)) {
            Some(ones) => ones,
            None => 0,
        };
        match ones.checked_shl(self.low) {
            Some(mask) => mask,
            None => 0,
        }
    }
}

/// A word whose bits have names.
pub trait Flags: Copy {
    /// The word's raw number, widened.
    fn bits(self) -> u64;
    /// The word of that raw number; what does not fit is cut off.
    #[must_use]
    fn from_bits(bits: u64) -> Self;

    /// The flag's number as it is in the word: an inverted bit is not turned.
    fn number(self, flag: Flag) -> u64 {
        (self.bits() & flag.mask())
            .checked_shr(flag.low)
            .unwrap_or(0)
    }

    /// The word with another number in the flag's place; what does not fit is cut off.
    #[must_use]
    fn with_number(self, flag: Flag, number: u64) -> Self {
        let placed = number.checked_shl(flag.low).unwrap_or(0) & flag.mask();
        Self::from_bits((self.bits() & !flag.mask()) | placed)
    }

    /// Whether the flag's name is true.
    fn is(self, flag: Flag) -> bool {
        (self.number(flag) != 0) == flag.active
    }

    /// The word in which the flag's name is true or not.
    #[must_use]
    fn with(self, flag: Flag, state: bool) -> Self {
        self.with_number(flag, u64::from(state == flag.active))
    }
}
