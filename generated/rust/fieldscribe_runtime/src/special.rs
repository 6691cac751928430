// SPDX-License-Identifier: 0BSD
//! Special codes: raw numbers that are no quantity, and what decoding gives for them.

use core::fmt;

use crate::{Error, Point};

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

    /// What a check of a raw number says that is this code.
    ///
    /// # Errors
    /// [`Error::Special`] if it may not be written.
    pub const fn checked(&self) -> Result<(), Error> {
        if self.writable {
            Ok(())
        } else {
            Err(Error::Special)
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
    let own = P::special(special.raw).ok_or(Error::UnknownValue)?;
    if own.name != special.name {
        return Err(Error::UnknownValue);
    }
    own.checked()?;
    Ok(special.raw)
}

/// What a look at a factor says: a special code is no number to compute with.
///
/// # Errors
/// [`Error::ZeroFactor`] if it does not hold.
pub const fn factor(holds: bool) -> Result<(), Error> {
    if holds {
        Ok(())
    } else {
        Err(Error::ZeroFactor)
    }
}

/// The raw number that a value became, which is never a special code.
///
/// # Errors
/// [`Error::Special`] if it is one.
pub fn quantity<P: Coded>(raw: P::Raw) -> Result<P::Raw, Error> {
    match P::special(raw) {
        Some(_) => Err(Error::Special),
        None => Ok(raw),
    }
}
