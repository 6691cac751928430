// SPDX-License-Identifier: 0BSD
//! The types that raw numbers have.

use crate::arithmetic::{round_i128, round_i32, round_i64};

mod sealed {
    pub trait Sealed {}
}

/// A raw number: an integer, a bit, the bit pattern of a floating-point number; or the words of a text.
pub trait Raw: Copy + PartialOrd + Send + sealed::Sealed + 'static {
    /// The 16-bit words that hold the number.
    type Words: Copy + Send + AsRef<[u16]> + AsMut<[u16]>;
    /// The smallest number of the type.
    const MIN: Self;
    /// The largest number of the type.
    const MAX: Self;
    /// The number in words, the high part first.
    fn into_words(self) -> Self::Words;
    /// The number from words, the high part first.
    fn from_words(words: Self::Words) -> Self;
    /// The integer nearest to `number`, halves away from zero; none if the type cannot hold it.
    fn round(number: f64) -> Option<Self>;
    /// The smallest and the largest number of the type.
    const ENDS: (i128, i128);
    /// The number as an `i64`; a `u64` beyond it becomes `i64::MAX`.
    fn to_i64(self) -> i64;
    /// The number as an `i128`.
    fn to_i128(self) -> i128;
    /// The number, if the type holds it.
    fn from_i128(number: i128) -> Option<Self>;
    /// The number without the upper bits that the type does not have.
    fn truncated(number: i64) -> Self;
}

/// What every integer type has.
macro_rules! integer {
    ($type:ty) => {
        const MIN: Self = <$type>::MIN;
        const MAX: Self = <$type>::MAX;
        #[allow(clippy::cast_lossless, reason = "there is no other way in a constant")]
        const ENDS: (i128, i128) = (<$type>::MIN as i128, <$type>::MAX as i128);

        #[inline]
        fn to_i128(self) -> i128 {
            i128::from(self)
        }

        #[inline]
        fn from_i128(number: i128) -> Option<Self> {
            Self::try_from(number).ok()
        }

        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "what is lost is what it says"
        )]
        #[inline]
        fn truncated(number: i64) -> Self {
            number as Self
        }
    };
}

/// One byte lies in the low half of its word; a negative one fills the high half with its sign.
macro_rules! byte {
    ($type:ty) => {
        impl sealed::Sealed for $type {}

        impl Raw for $type {
            type Words = [u16; 1];
            integer!($type);

            fn into_words(self) -> [u16; 1] {
                [u16::from_be_bytes(i16::from(self).to_be_bytes())]
            }

            #[inline]
            fn from_words([word]: [u16; 1]) -> Self {
                let [_, low] = word.to_be_bytes();
                Self::from_be_bytes([low])
            }

            #[inline]
            fn round(number: f64) -> Option<Self> {
                Self::try_from(round_i32(number)?).ok()
            }

            #[inline]
            fn to_i64(self) -> i64 {
                i64::from(self)
            }
        }
    };
}

macro_rules! words {
    ($type:ty, $count:literal, [$($word:ident $high:ident $low:ident),+], $round:ident, $wide:expr) => {
        impl sealed::Sealed for $type {}

        impl Raw for $type {
            type Words = [u16; $count];
            integer!($type);

            fn into_words(self) -> [u16; $count] {
                let [$($high, $low),+] = self.to_be_bytes();
                [$(u16::from_be_bytes([$high, $low])),+]
            }

            fn from_words([$($word),+]: [u16; $count]) -> Self {
                $(let [$high, $low] = $word.to_be_bytes();)+
                Self::from_be_bytes([$($high, $low),+])
            }

            #[inline]
            fn round(number: f64) -> Option<Self> {
                Self::try_from($round(number)?).ok()
            }

            #[inline]
            fn to_i64(self) -> i64 {
                $wide(self)
            }
        }
    };
}

byte!(u8);
byte!(i8);
words!(u16, 1, [a a1 a0], round_i32, i64::from);
words!(i16, 1, [a a1 a0], round_i32, i64::from);
words!(u32, 2, [a a1 a0, b b1 b0], round_i64, i64::from);
words!(i32, 2, [a a1 a0, b b1 b0], round_i32, i64::from);
words!(i64, 4, [a a1 a0, b b1 b0, c c1 c0, d d1 d0], round_i64, i64::from);
words!(u64, 4, [a a1 a0, b b1 b0, c c1 c0, d d1 d0], round_i128, |raw| {
    i64::try_from(raw).unwrap_or(i64::MAX)
});

impl sealed::Sealed for bool {}

impl Raw for bool {
    type Words = [u16; 1];
    const MIN: Self = false;
    const MAX: Self = true;
    const ENDS: (i128, i128) = (0, 1);

    fn into_words(self) -> [u16; 1] {
        [u16::from(self)]
    }

    #[inline]
    fn from_words([word]: [u16; 1]) -> Self {
        word != 0
    }

    #[inline]
    fn round(number: f64) -> Option<Self> {
        match round_i32(number) {
            Some(0) => Some(false),
            Some(1) => Some(true),
            _ => None,
        }
    }

    #[inline]
    fn to_i64(self) -> i64 {
        i64::from(self)
    }

    #[inline]
    fn to_i128(self) -> i128 {
        i128::from(self)
    }

    #[inline]
    fn from_i128(number: i128) -> Option<Self> {
        match number {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    #[inline]
    fn truncated(number: i64) -> Self {
        number & 1 == 1
    }
}

impl<const W: usize> sealed::Sealed for [u16; W] {}

/// The words of a text in reading order; they are no number, and nothing is rounded to them.
impl<const W: usize> Raw for [u16; W] {
    type Words = Self;
    const MIN: Self = [0; W];
    const MAX: Self = [u16::MAX; W];
    const ENDS: (i128, i128) = (0, 0);

    #[inline]
    fn into_words(self) -> Self {
        self
    }

    #[inline]
    fn from_words(words: Self) -> Self {
        words
    }

    #[inline]
    fn round(_: f64) -> Option<Self> {
        None
    }

    #[inline]
    fn to_i64(self) -> i64 {
        0
    }

    #[inline]
    fn to_i128(self) -> i128 {
        0
    }

    #[inline]
    fn from_i128(_: i128) -> Option<Self> {
        None
    }

    #[inline]
    fn truncated(_: i64) -> Self {
        Self::MIN
    }
}
