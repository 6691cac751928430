// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a Modbus device over a transport that the caller brings.

use core::fmt;
use core::marker::PhantomData;

use super::reply::wrong_length;
use super::{
    About, Block, BuildError, Command, Framing, Profile, Reply, ReplyError, Request, LONGEST,
};
use crate::client::{read_methods, write_methods, AsyncTransport, LocalTransport, Transport};
use crate::{
    Accepts, AnyDevice, BitGroup, CountReadable, CountWritable, Decoded, Device, Encodable,
};
use crate::{Error, NeedsNothing, Point, Readable, Whole, Writable};

/// Why a point could not be read or written.
///
/// Its text is the point's name, or which request that was, and all that the error in it says; its source is what
/// caused that one, so a chain says nothing twice.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ClientError<E> {
    /// The number could not be encoded or decoded.
    Point(Error),
    /// The request could not be built.
    Build(BuildError, Option<About>),
    /// The reply was none, or the device refused.
    Reply(ReplyError, Option<About>),
    /// The transport failed.
    Transport(E, Option<About>),
}

impl<E> ClientError<E> {
    /// The name of the point that it is about, if it is about one.
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

    /// The same about this point, where it does not say yet which it is about.
    #[must_use]
    pub fn of<P: Point>(mut self) -> Self {
        match &mut self {
            Self::Point(error) => *error = error.of::<P>(),
            Self::Build(_, about) | Self::Reply(_, about) | Self::Transport(_, about) => {
                if !matches!(about, Some(About::Point(_))) {
                    *about = Some(About::Point(P::NAME));
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

/// An error after what it is about.
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

/// One unit of a bus: numbers the requests and keeps the frames.
#[derive(Debug)]
struct Unit {
    profile: &'static Profile,
    framing: Framing,
    number: u8,
    transaction: u16,
    sent: [u8; LONGEST],
    received: [u8; LONGEST],
    /// How many bytes the last reply had.
    length: usize,
}

impl Unit {
    const fn new(profile: &'static Profile, framing: Framing, number: u8) -> Self {
        Self {
            profile,
            framing,
            number,
            transaction: 0,
            sent: [0; LONGEST],
            received: [0; LONGEST],
            length: 0,
        }
    }

    /// Makes the request one of this unit's framing, as its next transaction.
    fn number(&mut self, request: &mut Request<'_>) {
        request.framing = self.framing;
        if self.framing == Framing::Tcp {
            self.transaction = self.transaction.wrapping_add(1);
            request.transaction = self.transaction;
        }
    }

    /// The frame to send and the space for its reply: none if the request goes to all units.
    fn frames(&mut self, request: &Request<'_>) -> Result<(&[u8], &mut [u8]), BuildError> {
        self.length = 0;
        let length = request.build(self.profile, &mut self.sent)?;
        let sent = self.sent.get(..length).ok_or(BuildError::BufferTooSmall)?;
        if self.profile.is_broadcast(request.unit()) {
            Ok((sent, &mut []))
        } else {
            Ok((sent, &mut self.received))
        }
    }

    /// What the bytes that came say; nothing if the request went to all units.
    fn reply<D, E>(
        &mut self,
        request: &Request<'_>,
        length: usize,
    ) -> Result<Option<Reply<'_, D>>, ClientError<E>> {
        if self.profile.is_broadcast(request.unit()) {
            return Ok(None);
        }
        self.length = length.min(LONGEST);
        let parsed = if length > LONGEST {
            Err(wrong_length(length, LONGEST))
        } else {
            request.parse_of(self.received())
        };
        match parsed {
            Ok(reply) => Ok(Some(reply)),
            Err(error) => Err(ClientError::Reply(
                self.profile.named(error),
                Some(request.about()),
            )),
        }
    }

    fn received(&self) -> &[u8] {
        self.received.get(..self.length).unwrap_or_default()
    }
}

/// The same client twice: what differs is how it waits for the transport.
macro_rules! client {
    ($client:ident, $transport:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        #[doc = $about]
        #[derive(Debug)]
        pub struct $client<T, D = AnyDevice> {
            transport: T,
            unit: Unit,
            device: PhantomData<D>,
        }

        impl<T: $transport, D: Device<Profile = Profile>> $client<T, D> {
            /// The unit of that number behind a transport.
            pub const fn new(transport: T, framing: Framing, unit: u8) -> Self {
                Self { transport, unit: Unit::new(D::PROFILE, framing, unit), device: PhantomData }
            }
        }

        impl<T: $transport> $client<T> {
            /// The unit of that number, of a device that is chosen at run time; its client takes every point.
            pub const fn for_profile(
                transport: T,
                profile: &'static Profile,
                framing: Framing,
                unit: u8,
            ) -> Self {
                Self { transport, unit: Unit::new(profile, framing, unit), device: PhantomData }
            }
        }

        impl<T, D> $client<T, D> {
            /// The same unit by another profile, as that of a gateway which translates:
            /// [`Profile::with_framings`].
            #[must_use]
            pub fn with_profile(self, profile: &'static Profile) -> Self {
                Self { unit: Unit { profile, ..self.unit }, ..self }
            }

            /// The transport, as for its settings.
            pub fn transport(&mut self) -> &mut T {
                &mut self.transport
            }

            /// The bytes of the last reply, also of one that was none; none if the line failed.
            pub fn received(&self) -> &[u8] {
                self.unit.received()
            }

            /// The transport back.
            pub fn into_transport(self) -> T {
                self.transport
            }
        }

        impl<T: $transport, D> $client<T, D> {
            /// The reply to a request, or none if the request goes to all units.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn exchange(
                &mut self,
                mut request: Request<'_>,
            ) -> Result<Option<Reply<'_, D>>, ClientError<T::Error>> {
                self.unit.number(&mut request);
                let about = Some(request.about());
                let frames = self.unit.frames(&request);
                let (sent, space) = frames.map_err(|error| ClientError::Build(error, about))?;
                let answer = self.transport.exchange(sent, space)$($wait)*;
                let length = answer.map_err(|error| ClientError::Transport(error, about))?;
                self.unit.reply(&request, length)
            }

            /// A point's raw number.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_raw<P: Readable>(&mut self) -> Result<P::Raw, ClientError<T::Error>>
            where
                D: Accepts<P::Device>,
            {
                let request = Request::read::<P>(self.unit.number);
                let reply = self.answered(request)$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(reply.raw::<P>()?)
            }

            /// The words or bits of a block, one of `blocks`: `reply.raw::<P>()` gives each point that it brings.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_block(&mut self, block: &Block<D>) -> Result<Reply<'_, D>, ClientError<T::Error>> {
                let request = Request::block(self.unit.number, block);
                self.answered(request)$($wait)*
            }

            /// The reply to a request that cannot go to all units.
            $($async)? fn answered(&mut self, request: Request<'_>) -> Result<Reply<'_, D>, ClientError<T::Error>> {
                let about = Some(request.about());
                let reply = self.exchange(request)$($wait)*?;
                reply.ok_or(ClientError::Build(BuildError::NotForAll, about))
            }

            read_methods! {
                [$($async)?], [$($wait)*], "A point", read_raw for Point;
                read read_with read_count read_count_with
            }

            write_methods! {
                [$($async)?], [$($wait)*], "Writes a value to a point.", put for Point, ClientError<T::Error>;
                write write_with write_count write_count_with write_raw write_raw_with
            }

            /// Writes a raw number that was checked.
            $($async)? fn put<P: Writable + Whole>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>> {
                let words = P::to_words(raw);
                let request = Request::write_words::<P>(self.unit.number, words.as_ref());
                self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(())
            }

            /// Gives a command, one of `commands`.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn command(&mut self, command: &Command<D>) -> Result<(), ClientError<T::Error>> {
                let request = Request::command(self.unit.number, command);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// Writes a value to a group of bits: reads the word, replaces the bits, writes the word back.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn update<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Encodable<With: NeedsNothing> + BitGroup,
                D: Accepts<P::Device>,
            {
                let raw = P::encode(value)?;
                let read = Request::read::<P>(self.unit.number);
                let reply = self.answered(read)$($wait)*.map_err(ClientError::of::<P>)?;
                let word = reply.item(0).ok_or(Error::NotBrought(Some(P::NAME)))?;
                let write = Request::update::<P>(self.unit.number, word, raw);
                self.exchange(write)$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(())
            }
        }
    };
}

client!(
    Client,
    Transport,
    "One unit behind a transport that blocks.",
    [],
    []
);
client!(
    AsyncClient,
    AsyncTransport,
    "One unit behind a transport that does not block.",
    [async],
    [.await]
);
client!(
    LocalClient,
    LocalTransport,
    "One unit behind a transport of one thread, which does not block.",
    [async],
    [.await]
);
