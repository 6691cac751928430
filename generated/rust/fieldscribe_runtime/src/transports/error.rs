// SPDX-License-Identifier: 0BSD
//! Why a port failed.

use core::fmt;

/// Why no reply came over a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LineError<E> {
    /// The port failed.
    Port(E),
    /// Nothing arrived in time.
    TimedOut,
    /// The other end is closed.
    Closed,
}

impl<E> From<E> for LineError<E> {
    fn from(error: E) -> Self {
        Self::Port(error)
    }
}

impl<E: fmt::Display> fmt::Display for LineError<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Port(error) => error.fmt(formatter),
            Self::TimedOut => formatter.write_str("nothing came in time"),
            Self::Closed => formatter.write_str("the other end is closed"),
        }
    }
}

impl<E: core::error::Error + 'static> core::error::Error for LineError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Port(error) => error.source(),
            _ => None,
        }
    }
}
