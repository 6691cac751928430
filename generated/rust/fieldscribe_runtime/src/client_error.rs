// SPDX-License-Identifier: 0BSD
//! The error of every client: why a point could not be read or written, and which.

use core::fmt;

use crate::{BuildError, Error, Point, ReplyError};

/// The subject of a client's error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum About {
    /// A point, by its name.
    Point(&'static str),
    /// A request that is not for one point, such as that of a block or a command.
    Request {
        /// The unit that was asked.
        unit: u8,
        /// The function.
        function: u8,
        /// The first address.
        address: u16,
        /// The number of items.
        count: u16,
    },
}

impl fmt::Display for About {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(name) => formatter.write_str(name),
            Self::Request {
                unit,
                function,
                address,
                count,
            } => {
                write!(
                    formatter,
                    "unit {unit}, function {function} at {address:04X}h"
                )?;
                match count {
                    0 | 1 => Ok(()),
                    _ => write!(formatter, ", {count} items"),
                }
            }
        }
    }
}

/// Why a point could not be read or written.
///
/// Its text has the point's name or the request, and the text of the error in it. Its source is the cause of that
/// error, so a chain of sources repeats nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ClientError<E> {
    /// The number could not be encoded or decoded.
    Point(Error),
    /// The request could not be built.
    Build(BuildError, Option<About>),
    /// The reply is invalid, or the device refused.
    Reply(ReplyError, Option<About>),
    /// The transport failed.
    Transport(E, Option<About>),
}

impl<E> ClientError<E> {
    /// The error's name, as in the conformance vectors; `line` if the transport failed.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Point(error) => error.name(),
            Self::Build(error, _) => error.name(),
            Self::Reply(error, _) => error.name(),
            Self::Transport(..) => "line",
        }
    }

    /// True if a frame was lost or damaged on the line, so that trying again may help.
    #[must_use]
    pub const fn is_lost(&self) -> bool {
        match self {
            Self::Point(_) | Self::Build(..) => false,
            Self::Reply(error, _) => error.is_lost(),
            Self::Transport(..) => true,
        }
    }

    /// The name of the point, if it is about one.
    #[must_use]
    pub const fn point(&self) -> Option<&'static str> {
        match self {
            Self::Point(error) => error.point(),
            Self::Build(_, about) | Self::Reply(_, about) | Self::Transport(_, about) => {
                match about {
                    Some(About::Point(name)) => Some(*name),
                    _ => None,
                }
            }
        }
    }

    /// The same error with this point, unless it names one already.
    #[must_use]
    pub fn of<P: Point>(self) -> Self {
        self.named(P::NAME)
    }

    /// The same error with the point of this name.
    pub(crate) fn named(mut self, name: &'static str) -> Self {
        match &mut self {
            Self::Point(error) => *error = error.named(name),
            Self::Build(_, about) | Self::Reply(_, about) | Self::Transport(_, about) => {
                if !matches!(about, Some(About::Point(_))) {
                    *about = Some(About::Point(name));
                }
            }
        }
        self
    }
}

impl<E> From<Error> for ClientError<E> {
    fn from(error: Error) -> Self {
        Self::Point(error)
    }
}

impl<E> From<BuildError> for ClientError<E> {
    fn from(error: BuildError) -> Self {
        Self::Build(error, None)
    }
}

impl<E> From<ReplyError> for ClientError<E> {
    fn from(error: ReplyError) -> Self {
        Self::Reply(error, None)
    }
}

impl<E: fmt::Display> fmt::Display for ClientError<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(error) => error.fmt(formatter),
            Self::Build(error, about) => told(*about, error, formatter),
            Self::Reply(error, about) => told(*about, error, formatter),
            Self::Transport(error, about) => told(*about, error, formatter),
        }
    }
}

/// Writes the subject and the error.
fn told(
    about: Option<About>,
    error: &impl fmt::Display,
    formatter: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    if let Some(about) = about {
        write!(formatter, "{about}: ")?;
    }
    error.fmt(formatter)
}

impl<E: core::error::Error + 'static> core::error::Error for ClientError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Transport(error, _) => error.source(),
            _ => None,
        }
    }
}
