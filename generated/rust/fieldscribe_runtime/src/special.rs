// SPDX-License-Identifier: 0BSD
//! Special codes: raw numbers that are no quantity, and what decoding gives for them.

use core::fmt;

use crate::check::unknown;
use crate::{Error, Point, Raw};

/// What a point holds in the place of a quantity: a code by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Special<R> {
    name: &'static str,
    raw: R,
    no_value: bool,
    writable: bool,
}

impl<R: Copy> Special<R> {
    /// A code that is only read, and that does not say that there is no value.
    #[must_use]
    pub const fn new(name: &'static str, raw: R) -> Self {
        Self {
            name,
            raw,
            no_value: false,
            writable: false,
        }
    }

    /// A code that says that there is no value, and is only read.
    #[must_use]
    pub const fn no_value(name: &'static str, raw: R) -> Self {
        Self {
            no_value: true,
            ..Self::new(name, raw)
        }
    }

    /// A code that may be written.
    #[must_use]
    pub const fn writable(name: &'static str, raw: R) -> Self {
        Self {
            writable: true,
            ..Self::new(name, raw)
        }
    }

    /// A code that says that there is no value, and may be written.
    #[must_use]
    pub const fn writable_no_value(name: &'static str, raw: R) -> Self {
        Self {
            no_value: true,
            ..Self::writable(name, raw)
        }
    }

    /// The name in the description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The raw number.
    #[must_use]
    pub const fn raw(&self) -> R {
        self.raw
    }

    /// Whether it says that there is no value.
    #[must_use]
    pub const fn is_no_value(&self) -> bool {
        self.no_value
    }

    /// Whether it may be written.
    #[must_use]
    pub const fn is_writable(&self) -> bool {
        self.writable
    }

    /// What a check of a raw number of that point says that is this code.
    ///
    /// # Errors
    /// [`Error::Special`] if it may not be written.
    pub const fn checked<P: Point>(&self) -> Result<(), Error> {
        if self.writable {
            Ok(())
        } else {
            Err(self.no_quantity::<P>())
        }
    }

    /// What is said of a value of that point that became this code.
    const fn no_quantity<P: Point>(&self) -> Error {
        Error::Special {
            point: P::NAME,
            code: self.name,
            is_writable: self.writable,
        }
    }
}

impl<R> fmt::Display for Special<R> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)
    }
}

/// One of the codes of a point: a raw number, or all from a first to a last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code<R> {
    first: Special<R>,
    last: R,
}

impl<R: Copy + PartialOrd> Code<R> {
    /// The code that is just one raw number.
    #[must_use]
    pub const fn one(special: Special<R>) -> Self {
        Self {
            last: special.raw,
            first: special,
        }
    }

    /// The code that all raw numbers from its own to the last one are.
    #[must_use]
    pub const fn band(first: Special<R>, last: R) -> Self {
        Self { first, last }
    }

    /// The name in the description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.first.name
    }

    /// The first and the last raw number.
    #[must_use]
    pub const fn ends(&self) -> (R, R) {
        (self.first.raw, self.last)
    }

    /// The code with a raw number, if that is one of its own.
    #[must_use]
    pub fn at(&self, raw: R) -> Option<Special<R>> {
        let held = self.first.raw <= raw && raw <= self.last;
        held.then_some(Special { raw, ..self.first })
    }
}

/// What a point means that has special codes: a value, or one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading<V, R> {
    /// A value.
    Value(V),
    /// No quantity.
    Special(Special<R>),
}

impl<V, R> Reading<V, R> {
    /// The value, if it is one.
    pub fn value(self) -> Option<V> {
        match self {
            Self::Value(value) => Some(value),
            Self::Special(_) => None,
        }
    }

    /// The special code, if it is one.
    pub fn special(self) -> Option<Special<R>> {
        match self {
            Self::Value(_) => None,
            Self::Special(special) => Some(special),
        }
    }
}

/// Shows the value, or the name of the code.
impl<V: fmt::Display, R: fmt::Display> fmt::Display for Reading<V, R> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => value.fmt(formatter),
            Self::Special(special) => special.fmt(formatter),
        }
    }
}

impl<V, R> From<V> for Reading<V, R> {
    fn from(value: V) -> Self {
        Self::Value(value)
    }
}

/// A point that has special codes.
pub trait Coded: Point {
    /// The codes.
    const CODES: &'static [Code<Self::Raw>];

    /// The special code that a raw number is; none for a quantity.
    #[must_use]
    fn special(raw: Self::Raw) -> Option<Special<Self::Raw>> {
        Self::CODES.iter().find_map(|code| code.at(raw))
    }
}

/// The raw number of a special code of the point, if it may be written.
///
/// # Errors
/// [`Error::Special`] if it may not; [`Error::UnknownValue`] if it is a code of another point.
pub fn written<P: Coded>(special: Special<P::Raw>) -> Result<P::Raw, Error> {
    match P::special(special.raw) {
        Some(own) if own.name == special.name => own.checked::<P>().map(|()| special.raw),
        _ => Err(unknown::<P>(special.raw.to_i64())),
    }
}

/// What a raw number means: the special code that it is, else what `decode` makes of it.
#[inline]
pub fn reading<P: Coded, V>(raw: P::Raw, decode: impl FnOnce(P::Raw) -> V) -> Reading<V, P::Raw> {
    match P::special(raw) {
        Some(special) => Reading::Special(special),
        None => Reading::Value(decode(raw)),
    }
}

/// As [`reading`], where decoding can fail.
///
/// # Errors
/// What `decode` says.
#[inline]
pub fn try_reading<P: Coded, V>(
    raw: P::Raw,
    decode: impl FnOnce(P::Raw) -> Result<V, Error>,
) -> Result<Reading<V, P::Raw>, Error> {
    match P::special(raw) {
        Some(special) => Ok(Reading::Special(special)),
        None => decode(raw).map(Reading::Value),
    }
}

/// The raw number of a special code that may be written, else what `encode` makes of the value.
///
/// # Errors
/// What `encode` says; what [`written`] and [`quantity`] say.
#[inline]
pub fn encoded<P: Coded, V>(
    reading: Reading<V, P::Raw>,
    encode: impl FnOnce(V) -> Result<P::Raw, Error>,
) -> Result<P::Raw, Error> {
    match reading {
        Reading::Value(value) => quantity::<P>(encode(value)?),
        Reading::Special(special) => written::<P>(special),
    }
}

/// The raw number that a value became, which is never a special code.
///
/// # Errors
/// [`Error::Special`] if it is one.
pub fn quantity<P: Coded>(raw: P::Raw) -> Result<P::Raw, Error> {
    match P::special(raw) {
        Some(special) => Err(special.no_quantity::<P>()),
        None => Ok(raw),
    }
}
