// SPDX-License-Identifier: 0BSD
//! Special codes: raw numbers that are no quantity, and their decoded form.

use core::fmt;

use crate::check::unknown;
use crate::{Error, Point, Raw};

/// What a point holds instead of a quantity: a code with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Special<R> {
    name: &'static str,
    raw: R,
    no_value: bool,
    writable: bool,
}

impl<R: Copy> Special<R> {
    /// A read-only code that does not mean that there is no value.
    #[must_use]
    pub const fn new(name: &'static str, raw: R) -> Self {
        Self {
            name,
            raw,
            no_value: false,
            writable: false,
        }
    }

    /// A read-only code that means that there is no value.
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

    /// A code that means that there is no value, and that may be written.
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

    /// True if it means that there is no value.
    #[must_use]
    pub const fn is_no_value(&self) -> bool {
        self.no_value
    }

    /// True if it may be written.
    #[must_use]
    pub const fn is_writable(&self) -> bool {
        self.writable
    }

    /// The result of checking this code as a raw number of a point.
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

    /// The error for a value of a point that became this code.
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

    /// The code of all raw numbers from its own to the last one.
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

    /// The code with a raw number, if the number belongs to it.
    #[must_use]
    pub fn at(&self, raw: R) -> Option<Special<R>> {
        let held = self.first.raw <= raw && raw <= self.last;
        held.then_some(Special { raw, ..self.first })
    }
}

/// The decoded number of a point with special codes: a value, or one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading<V, R> {
    /// A value.
    Value(V),
    /// A special code.
    Special(Special<R>),
}

impl<V, R> Reading<V, R> {
    /// The value, unless it is a special code.
    pub fn value(self) -> Option<V> {
        match self {
            Self::Value(value) => Some(value),
            Self::Special(_) => None,
        }
    }

    /// The special code, unless it is a value.
    pub fn special(self) -> Option<Special<R>> {
        match self {
            Self::Value(_) => None,
            Self::Special(special) => Some(special),
        }
    }
}

/// Writes the value, or the name of the code.
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

    /// The special code of a raw number; [`None`] for a quantity.
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

/// The special code of a raw number, else its value by `decode`.
#[inline]
pub fn reading<P: Coded, V>(raw: P::Raw, decode: impl FnOnce(P::Raw) -> V) -> Reading<V, P::Raw> {
    match P::special(raw) {
        Some(special) => Reading::Special(special),
        None => Reading::Value(decode(raw)),
    }
}

/// As [`reading`], if decoding can fail.
///
/// # Errors
/// The errors of `decode`.
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

/// The raw number of a writable special code, else of the value by `encode`.
///
/// # Errors
/// The errors of `encode`, [`written`] and [`quantity`].
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

/// Checks that the raw number of a value is no special code.
///
/// # Errors
/// [`Error::Special`] if it is one.
pub fn quantity<P: Coded>(raw: P::Raw) -> Result<P::Raw, Error> {
    match P::special(raw) {
        Some(special) => Err(special.no_quantity::<P>()),
        None => Ok(raw),
    }
}
