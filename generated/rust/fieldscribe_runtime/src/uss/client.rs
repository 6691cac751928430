// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a USS drive over a transport that the caller brings.

use core::fmt;

use super::{
    broadcast, BuildError, Link, Parameter, ParseError, Profile, Received, Reply, Request, Sent,
    LONGEST,
};
use crate::client::{AsyncTransport, Transport};
use crate::point::joined;
use crate::{BitGroup, Decoded, Error, Raw, Readable, Whole, Writable};

/// The most words of process data that a client keeps.
const WORDS: usize = 16;
/// The longest telegram that a client sends: four words of the parameter part, and the process data.
const SENT: usize = 4 + 2 * (4 + WORDS);

/// Why a point could not be read or written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClientError<E> {
    /// The number could not be encoded or decoded, or is not in the telegram.
    Point(Error),
    /// The telegram could not be built.
    Build(BuildError),
    /// The answer was none, or the drive refused.
    Reply(ParseError),
    /// The transport failed.
    Transport(E),
}

impl<E> From<Error> for ClientError<E> {
    fn from(error: Error) -> Self {
        Self::Point(error)
    }
}

impl<E> From<BuildError> for ClientError<E> {
    fn from(error: BuildError) -> Self {
        Self::Build(error)
    }
}

impl<E> From<ParseError> for ClientError<E> {
    fn from(error: ParseError) -> Self {
        Self::Reply(error)
    }
}

impl<E: fmt::Display> fmt::Display for ClientError<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(error) => error.fmt(formatter),
            Self::Build(error) => error.fmt(formatter),
            Self::Reply(error) => error.fmt(formatter),
            Self::Transport(error) => error.fmt(formatter),
        }
    }
}

impl<E: core::error::Error + 'static> core::error::Error for ClientError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Point(error) => Some(error),
            Self::Build(error) => Some(error),
            Self::Reply(error) => Some(error),
            Self::Transport(error) => Some(error),
        }
    }
}

/// The words that are sent again and again: all 0 until one of them was set.
#[derive(Clone, Copy, Debug)]
struct Process {
    words: [u16; WORDS],
    is_set: bool,
}

/// One drive of a bus: keeps the words that it is sent again and again, and those that it answered with.
#[derive(Debug)]
struct Drive {
    profile: &'static Profile,
    link: Link,
    unit: u8,
    process: Process,
    heard: [u16; WORDS],
    count: usize,
    sent: [u8; SENT],
    received: [u8; LONGEST],
}

impl Drive {
    const fn new(profile: &'static Profile, link: Link, unit: u8) -> Self {
        Self {
            profile,
            link,
            unit,
            process: Process {
                words: [0; WORDS],
                is_set: false,
            },
            heard: [0; WORDS],
            count: 0,
            sent: [0; SENT],
            received: [0; LONGEST],
        }
    }

    /// The telegram to send and the space for its answer.
    fn telegrams(
        &mut self,
        request: &Request,
        process: &Process,
    ) -> Result<(&[u8], &mut [u8]), BuildError> {
        let words = process.words.get(..usize::from(self.link.pzd));
        let words = words.ok_or(BuildError::BadLink)?;
        let length = request.build(self.profile, self.link, words, &mut self.sent)?;
        let sent = self.sent.get(..length).ok_or(BuildError::BufferTooSmall)?;
        Ok((sent, &mut self.received))
    }

    /// The telegram to all units.
    fn for_all(&mut self, masks: [u16; 4]) -> Result<&[u8], BuildError> {
        let words = self.process.words.get(..usize::from(self.link.pzd));
        let words = words.ok_or(BuildError::BadLink)?;
        let length = broadcast(self.profile, self.link, masks, words, &mut self.sent)?;
        self.sent.get(..length).ok_or(BuildError::BufferTooSmall)
    }

    /// The answer in the first bytes that were received; its process data are kept.
    fn reply(
        &mut self,
        request: &Request,
        process: &Process,
        length: usize,
    ) -> Result<Reply<'_>, ParseError> {
        let received = self.received.get(..length);
        let received = received.ok_or(ParseError::WrongLength)?;
        let reply = request.parse(self.profile, self.link, received)?;
        self.process = *process;
        self.count = 0;
        for (place, word) in self.heard.iter_mut().zip(reply.words()) {
            *place = word;
            self.count = self.count.saturating_add(1);
        }
        Ok(reply)
    }

    /// The process data with other words of a point; the first time the words not set get their fixed bits.
    fn with_words<P: Sent>(&self, words: &[u16]) -> Result<Process, Error> {
        self.changed(|all| {
            for (position, word) in P::ADDRESSES.iter().zip(words) {
                *all.get_mut(usize::from(*position))
                    .ok_or(Error::WrongLength)? = *word;
            }
            Ok(())
        })
    }

    /// The process data with another number of a group of bits.
    fn with_bits<P: Sent + BitGroup>(&self, raw: P::Raw) -> Result<Process, Error> {
        self.changed(|all| {
            let word = all.get_mut(usize::from(P::ADDRESS));
            let word = word.ok_or(Error::WrongLength)?;
            *word = P::insert(*word, raw);
            Ok(())
        })
    }

    fn changed(
        &self,
        change: impl FnOnce(&mut [u16]) -> Result<(), Error>,
    ) -> Result<Process, Error> {
        let mut words = self.process.words;
        if !self.process.is_set {
            for fixed in self.profile.fixed {
                if let Some(word) = words.get_mut(usize::from(fixed.position)) {
                    *word |= fixed.bits;
                }
            }
        }
        let linked = words.get_mut(..usize::from(self.link.pzd));
        change(linked.ok_or(Error::WrongLength)?)?;
        Ok(Process {
            words,
            is_set: true,
        })
    }

    /// The raw number of a point in the last answer.
    fn heard<P: Received>(&self) -> Result<P::Raw, Error> {
        let heard = self.heard.get(..self.count).unwrap_or_default();
        let mut words = P::Raw::MIN.into_words();
        for (place, position) in words.as_mut().iter_mut().zip(P::ADDRESSES) {
            let word = heard.get(usize::from(*position));
            *place = word.copied().ok_or(Error::WrongLength)?;
        }
        Ok(joined::<P>(words))
    }
}

/// The same client twice: what differs is how it waits for the transport.
macro_rules! client {
    ($client:ident, $transport:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        #[doc = $about]
        ///
        /// Every telegram carries the words of process data as they were set last. They are all 0 until one is set; then
        /// those that are not carry their fixed bits.
        #[derive(Debug)]
        pub struct $client<T> {
            transport: T,
            drive: Drive,
        }

        impl<T> $client<T> {
            /// The drive of that unit behind a transport; the profile is the device's own.
            pub const fn new(transport: T, profile: &'static Profile, link: Link, unit: u8) -> Self {
                Self { transport, drive: Drive::new(profile, link, unit) }
            }

            /// The transport back.
            pub fn into_transport(self) -> T {
                self.transport
            }

            /// Sets a point of the process data, which the next telegram carries.
            ///
            /// # Errors
            /// What encoding says; [`Error::WrongLength`] if the link has not so many words.
            pub fn set<P>(&mut self, value: P::Value) -> Result<(), Error>
            where
                P: Writable<With = ()> + Whole + Sent,
            {
                self.set_with::<P>(value, ())
            }

            /// As `set`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// The same.
            pub fn set_with<P>(&mut self, value: P::Value, with: P::With) -> Result<(), Error>
            where
                P: Writable + Whole + Sent,
            {
                let words = P::encode_with(value, with)?.into_words();
                self.drive.process = self.drive.with_words::<P>(words.as_ref())?;
                Ok(())
            }

            /// Sets a group of bits of the process data, which the next telegram carries.
            ///
            /// # Errors
            /// What encoding says; [`Error::WrongLength`] if the link has not so many words.
            pub fn set_bits<P>(&mut self, value: P::Value) -> Result<(), Error>
            where
                P: Writable<With = ()> + BitGroup + Sent,
            {
                self.drive.process = self.drive.with_bits::<P>(P::encode(value)?)?;
                Ok(())
            }

            /// A point of the process data as the last answer had it.
            ///
            /// # Errors
            /// What decoding says; [`Error::WrongLength`] if no answer had so many words.
            pub fn heard<P>(&self) -> Result<P::Value, Error>
            where
                P: Readable<Factors = ()> + Received,
            {
                self.heard_with::<P>(())
            }

            /// As `heard`, by the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// The same.
            pub fn heard_with<P>(&self, with: P::Factors) -> Result<P::Value, Error>
            where
                P: Readable + Received,
            {
                P::decode_with(self.drive.heard::<P>()?, with).into_result()
            }
        }

        impl<T: $transport> $client<T> {
            /// The answer to a request; the telegram carries the process data too.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn exchange(
                &mut self,
                request: Request,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                self.exchange_with(request, self.drive.process)$($wait)*
            }

            /// The answer to a request that carries these process data, which stay in force if it succeeds: after a
            /// failure no later telegram may start what seemed to have failed.
            $($async)? fn exchange_with(
                &mut self,
                request: Request,
                process: Process,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                let (sent, space) = self.drive.telegrams(&request, &process)?;
                let answer = self.transport.exchange(sent, space)$($wait)*;
                let length = answer.map_err(ClientError::Transport)?;
                Ok(self.drive.reply(&request, &process, length)?)
            }

            /// Sends the process data and keeps what the drive answers with.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn cycle(&mut self) -> Result<(), ClientError<T::Error>> {
                let request = Request::cyclic(self.drive.unit);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// Sends the process data to all units: of each word the bits of its mask are meant. None answers.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn broadcast(
                &mut self,
                masks: [u16; 4],
            ) -> Result<(), ClientError<T::Error>> {
                let sent = self.drive.for_all(masks)?;
                let answer = self.transport.exchange(sent, &mut [])$($wait)*;
                answer.map_err(ClientError::Transport)?;
                Ok(())
            }

            /// Sets a point of the process data and sends it. It stays set if the drive answers.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With = ()> + Whole + Sent,
            {
                self.send_with::<P>(value, ())$($wait)*
            }

            /// As `send`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send_with<P>(
                &mut self,
                value: P::Value,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Sent,
            {
                let words = P::encode_with(value, with)?.into_words();
                let process = self.drive.with_words::<P>(words.as_ref())?;
                let request = Request::cyclic(self.drive.unit);
                self.exchange_with(request, process)$($wait)*?;
                Ok(())
            }

            /// Sets a group of bits of the process data and sends it. It stays set if the drive answers.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send_bits<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With = ()> + BitGroup + Sent,
            {
                let process = self.drive.with_bits::<P>(P::encode(value)?)?;
                let request = Request::cyclic(self.drive.unit);
                self.exchange_with(request, process)$($wait)*?;
                Ok(())
            }

            /// The value of a point of the process data, which the drive is asked for.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn receive<P>(&mut self) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable<Factors = ()> + Received,
            {
                self.receive_with::<P>(())$($wait)*
            }

            /// As `receive`, by the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn receive_with<P>(
                &mut self,
                with: P::Factors,
            ) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable + Received,
            {
                self.cycle()$($wait)*?;
                Ok(self.heard_with::<P>(with)?)
            }

            /// A parameter's raw number.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_raw<P>(&mut self) -> Result<P::Raw, ClientError<T::Error>>
            where
                P: Readable + Parameter,
            {
                let request = Request::read::<P>(self.drive.unit);
                let reply = self.exchange(request)$($wait)*?;
                Ok(reply.raw::<P>()?)
            }

            /// A parameter's value.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read<P>(&mut self) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable<Factors = ()> + Parameter,
            {
                self.read_with::<P>(())$($wait)*
            }

            /// A parameter's value, by the raw numbers that its scale needs.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_with<P>(
                &mut self,
                with: P::Factors,
            ) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable + Parameter,
            {
                let raw = self.read_raw::<P>()$($wait)*?;
                Ok(P::decode_with(raw, with).into_result()?)
            }

            /// Changes a parameter until the power is off.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With = ()> + Whole + Parameter,
            {
                self.write_with::<P>(value, ())$($wait)*
            }

            /// As `write`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write_with<P>(
                &mut self,
                value: P::Value,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                let raw = P::encode_with(value, with)?;
                let request = Request::write::<P>(self.drive.unit, raw);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// Changes a parameter in the EEPROM too, which stands a limited number of writes.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With = ()> + Whole + Parameter,
            {
                self.store_with::<P>(value, ())$($wait)*
            }

            /// As `store`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_with<P>(
                &mut self,
                value: P::Value,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                let raw = P::encode_with(value, with)?;
                let request = Request::store::<P>(self.drive.unit, raw);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// Changes a group of bits until the power is off: reads the word, replaces the bits, writes the word back.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn update<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Writable<With = ()> + BitGroup + Parameter,
            {
                let raw = P::encode(value)?;
                let word = self.parameter_word::<P>()$($wait)*?;
                let request = Request::update::<P>(self.drive.unit, word, raw);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// As `update`, in the EEPROM too.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_update<P>(
                &mut self,
                value: P::Value,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Writable<With = ()> + BitGroup + Parameter,
            {
                let raw = P::encode(value)?;
                let word = self.parameter_word::<P>()$($wait)*?;
                let request = Request::store_update::<P>(self.drive.unit, word, raw);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// The whole word that a group of bits is in.
            $($async)? fn parameter_word<P>(&mut self) -> Result<u16, ClientError<T::Error>>
            where
                P: Readable + BitGroup + Parameter,
            {
                let request = Request::read::<P>(self.drive.unit);
                let reply = self.exchange(request)$($wait)*?;
                Ok(reply.word()?)
            }
        }
    };
}

client!(
    Client,
    Transport,
    "One drive behind a transport that blocks.",
    [],
    []
);
client!(AsyncClient, AsyncTransport, "One drive behind a transport that does not block.", [async], [.await]);
