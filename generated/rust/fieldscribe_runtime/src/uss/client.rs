// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a USS drive over a transport that the caller brings.

use core::fmt;

use super::{
    broadcast, BuildError, Link, Parameter, ParseError, Profile, Received, Reply, Request, Sent,
    Value, LONGEST,
};
use crate::client::{AsyncTransport, LocalTransport, Transport};
use crate::error::lead;
use crate::point::joined;
use crate::{BitGroup, CountReadable, CountWritable, Decoded, Encodable, Error, NeedsNothing};
use crate::{Point, Raw, Readable, Whole, Writable};

/// The most words of process data that a client keeps.
const WORDS: usize = 16;
/// The longest telegram that a client sends: four words of the parameter part, and the process data.
const SENT: usize = 4 + 2 * (4 + WORDS);

/// Why a point could not be read or written.
///
/// Its text is the point's name and all that the error in it says; its source is what caused that one, so a chain says
/// nothing twice. The text beside an error is the point's name; there is none where no point had to do with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ClientError<E> {
    /// The number could not be encoded or decoded, or is not in the telegram.
    Point(Error),
    /// The telegram could not be built.
    Build(BuildError, Option<&'static str>),
    /// The answer was none, or the drive refused.
    Reply(ParseError, Option<&'static str>),
    /// The drive answered a write with this other value.
    EchoMismatch(Value, Option<&'static str>),
    /// The transport failed.
    Transport(E, Option<&'static str>),
}

impl<E> ClientError<E> {
    /// The name of the point that it is about, if it is about one.
    #[must_use]
    pub const fn point(&self) -> Option<&'static str> {
        match self {
            Self::Point(error) => error.point(),
            Self::Build(_, point)
            | Self::Reply(_, point)
            | Self::EchoMismatch(_, point)
            | Self::Transport(_, point) => *point,
        }
    }

    /// The same about this point, where it does not say yet which it is about.
    #[must_use]
    pub fn of<P: Point>(mut self) -> Self {
        match &mut self {
            Self::Point(error) => *error = error.of::<P>(),
            Self::Build(_, point)
            | Self::Reply(_, point)
            | Self::EchoMismatch(_, point)
            | Self::Transport(_, point) => *point = point.or(Some(P::NAME)),
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

impl<E> From<ParseError> for ClientError<E> {
    fn from(error: ParseError) -> Self {
        Self::Reply(error, None)
    }
}

impl<E: fmt::Display> fmt::Display for ClientError<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::Point(error) = self {
            return error.fmt(formatter);
        }
        lead(self.point(), formatter)?;
        match self {
            Self::Point(_) => Ok(()),
            Self::Build(error, _) => error.fmt(formatter),
            Self::Reply(error, _) => error.fmt(formatter),
            Self::EchoMismatch(value, _) => {
                write!(formatter, "the drive answered {value} to a write")
            }
            Self::Transport(error, _) => error.fmt(formatter),
        }
    }
}

impl<E: core::error::Error + 'static> core::error::Error for ClientError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Transport(error, _) => error.source(),
            _ => None,
        }
    }
}

/// The words that are sent again and again, and whether the drive may not have them yet.
#[derive(Clone, Copy, Debug)]
struct Process {
    words: [u16; WORDS],
    is_changed: bool,
}

impl Process {
    /// Words that command nothing.
    const NOTHING: Self = Self {
        words: [0; WORDS],
        is_changed: false,
    };
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
            process: Process::NOTHING,
            heard: [0; WORDS],
            count: 0,
            sent: [0; SENT],
            received: [0; LONGEST],
        }
    }

    /// The telegram to send and the space for its answer.
    ///
    /// From here on until the answer nobody knows which of two sets of words the drive has, so neither may be repeated:
    /// the old words could start again what the new ones stopped. That also holds if nobody waits for the answer.
    fn telegrams(
        &mut self,
        request: &Request,
        process: &Process,
    ) -> Result<(&[u8], &mut [u8]), BuildError> {
        if request.unit != self.unit {
            return Err(BuildError::OtherUnit);
        }
        let words = process.words.get(..usize::from(self.link.pzd));
        let words = words.ok_or(BuildError::BadLink)?;
        let length = request.build(self.profile, self.link, words, &mut self.sent)?;
        let sent = self.sent.get(..length).ok_or(BuildError::BufferTooSmall)?;
        self.count = 0;
        if process.is_changed {
            self.process = Process::NOTHING;
        }
        Ok((sent, &mut self.received))
    }

    /// The telegram to all units.
    fn for_all(&mut self, masks: [u16; 4]) -> Result<&[u8], BuildError> {
        let words = self.process.words.get(..usize::from(self.link.pzd));
        let words = words.ok_or(BuildError::BadLink)?;
        let [places, meant, ..] = masks;
        let needed = self.profile.valid_bits();
        let sent = words.first().copied().unwrap_or_default() & meant;
        if places >> 1 & 1 == 1 && sent & needed != needed {
            return Err(BuildError::BadMask);
        }
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
        let reply = request.parse(self.profile, self.link, received);
        // A drive that does not do the task has taken the process data of the telegram all the same.
        let is_about_this = matches!(
            reply,
            Ok(_) | Err(ParseError::Refused { .. } | ParseError::NoRights | ParseError::NoAnswer)
        );
        if is_about_this {
            self.process = Process {
                is_changed: false,
                ..*process
            };
            let words = request.process_words(self.link, received)?;
            for (place, word) in self.heard.iter_mut().zip(words) {
                *place = word;
                self.count = self.count.saturating_add(1);
            }
        }
        reply
    }

    /// Sets a point to a raw number that was checked.
    fn put<P: Sent>(&mut self, raw: P::Raw) -> Result<(), Error> {
        self.process = self.with_words::<P>(raw.into_words().as_ref())?;
        Ok(())
    }

    /// The process data with other words of a point.
    fn with_words<P: Sent>(&self, words: &[u16]) -> Result<Process, Error> {
        self.changed(|all| {
            for (position, word) in P::ADDRESSES.iter().zip(words) {
                *all.get_mut(usize::from(*position))
                    .ok_or(Error::BeyondLink(None))? = *word;
            }
            Ok(())
        })
        .map_err(Error::of::<P>)
    }

    /// The process data with another word.
    fn with_word(&self, position: u16, word: u16) -> Result<Process, Error> {
        self.changed(|all| {
            let place = all.get_mut(usize::from(position));
            *place.ok_or(Error::BeyondLink(None))? = word;
            Ok(())
        })
    }

    /// The process data with another number of a group of bits.
    fn with_bits<P: Sent + BitGroup>(&self, raw: P::Raw) -> Result<Process, Error> {
        self.changed(|all| {
            let word = all.get_mut(usize::from(P::ADDRESS));
            let word = word.ok_or(Error::BeyondLink(None))?;
            *word = P::insert(*word, raw);
            Ok(())
        })
        .map_err(Error::of::<P>)
    }

    fn changed(
        &self,
        change: impl FnOnce(&mut [u16]) -> Result<(), Error>,
    ) -> Result<Process, Error> {
        let mut words = self.process.words;
        let linked = words.get_mut(..usize::from(self.link.pzd));
        change(linked.ok_or(Error::BeyondLink(None))?)?;
        Ok(Process {
            words,
            is_changed: self.process.is_changed || words != self.process.words,
        })
    }

    /// The raw number of a point in the last answer.
    fn heard<P: Received>(&self) -> Result<P::Raw, Error> {
        let mut words = P::Raw::MIN.into_words();
        for (place, position) in words.as_mut().iter_mut().zip(P::ADDRESSES) {
            *place = self.heard_word(*position).map_err(Error::of::<P>)?;
        }
        Ok(joined::<P>(words))
    }

    fn heard_word(&self, position: u16) -> Result<u16, Error> {
        let heard = self.heard.get(..self.count).unwrap_or_default();
        if heard.is_empty() {
            return Err(Error::NotHeard(None));
        }
        let word = heard.get(usize::from(position));
        word.copied().ok_or(Error::BeyondLink(None))
    }
}

/// The same client twice: what differs is how it waits for the transport.
macro_rules! client {
    ($client:ident, $transport:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        #[doc = $about]
        ///
        /// Every telegram carries the words of process data as they were set last, and 0 for words that were never set:
        /// the constant bits of a word, as the one that makes a control word valid, come with the first point of that
        /// word. A drive without a valid control word goes on as before.
        ///
        /// When words are new and their telegram fails (no answer, a wrong one, or nobody waited for it), nobody knows
        /// which words the drive has. So neither the old nor the new ones are repeated: all words are 0 from then on,
        /// until they are set again, each of them. A drive that refuses a task has taken the words all the same.
        #[derive(Debug)]
        pub struct $client<T> {
            transport: T,
            drive: Drive,
        }

        impl<T> $client<T> {
            /// The drive of that unit behind a transport; the profile is the device's own.
            pub const fn new(transport: T, profile: &'static Profile, link: Link, unit: u8) -> Self
            where
                T: $transport,
            {
                Self { transport, drive: Drive::new(profile, link, unit) }
            }

            /// The transport, as for its settings.
            pub fn transport(&mut self) -> &mut T {
                &mut self.transport
            }

            /// The transport back.
            pub fn into_transport(self) -> T {
                self.transport
            }

            /// Sets a point of the process data, which the next telegram carries.
            ///
            /// # Errors
            /// What encoding says; [`Error::BeyondLink`] if the link has not so many words.
            pub fn set<P>(&mut self, value: P::Value) -> Result<(), Error>
            where
                P: Encodable<With: NeedsNothing> + Whole + Sent,
            {
                self.set_with::<P>(value, NeedsNothing::nothing())
            }

            /// As `set`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// The same.
            pub fn set_with<P>(&mut self, value: P::Value, with: P::With) -> Result<(), Error>
            where
                P: Encodable + Whole + Sent,
            {
                self.drive.put::<P>(P::encode_with(value, with)?)
            }

            /// Sets a point of the process data to a count: its value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// The same.
            pub fn set_count<P>(&mut self, count: P::Count) -> Result<(), Error>
            where
                P: CountWritable<With: NeedsNothing> + Whole + Sent,
            {
                self.set_count_with::<P>(count, NeedsNothing::nothing())
            }

            /// As `set_count`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// The same.
            pub fn set_count_with<P>(&mut self, count: P::Count, with: P::With) -> Result<(), Error>
            where
                P: CountWritable + Whole + Sent,
            {
                self.drive.put::<P>(P::encode_count_with(count, with)?)
            }

            /// Sets a group of bits of the process data, which the next telegram carries.
            ///
            /// # Errors
            /// What encoding says; [`Error::BeyondLink`] if the link has not so many words.
            pub fn set_bits<P>(&mut self, value: P::Value) -> Result<(), Error>
            where
                P: Encodable<With: NeedsNothing> + BitGroup + Sent,
            {
                self.drive.process = self.drive.with_bits::<P>(P::encode(value)?)?;
                Ok(())
            }

            /// Sets a word of the process data by its position from 0 on, for what has no point; all its bits are the
            /// caller's.
            ///
            /// # Errors
            /// [`Error::BeyondLink`] if the link has not so many words.
            pub fn set_word(&mut self, position: u16, word: u16) -> Result<(), Error> {
                self.drive.process = self.drive.with_word(position, word)?;
                Ok(())
            }

            /// The words of process data that the next telegram carries; all 0 after a failure.
            pub fn words(&self) -> &[u16] {
                let words = &self.drive.process.words;
                words.get(..usize::from(self.drive.link.pzd)).unwrap_or(words)
            }

            /// A word of the process data of the last answer by its position from 0 on.
            ///
            /// # Errors
            /// As for `heard`.
            pub fn heard_word(&self, position: u16) -> Result<u16, Error> {
                self.drive.heard_word(position)
            }

            /// A point of the process data of the last answer, also of one that refused a task.
            ///
            /// # Errors
            /// What decoding says; [`Error::NotHeard`] if the last telegram was not answered; [`Error::BeyondLink`] if
            /// the link has not so many words.
            pub fn heard<P>(&self) -> Result<P::Value, Error>
            where
                P: Readable<Factors: NeedsNothing> + Received,
            {
                self.heard_with::<P>(NeedsNothing::nothing())
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

            /// As `heard`, as a count: the value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// The same.
            pub fn heard_count<P>(&self) -> Result<P::Count, Error>
            where
                P: CountReadable<Factors: NeedsNothing> + Received,
            {
                self.heard_count_with::<P>(NeedsNothing::nothing())
            }

            /// As `heard_count`, by the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// The same.
            pub fn heard_count_with<P>(&self, with: P::Factors) -> Result<P::Count, Error>
            where
                P: CountReadable + Received,
            {
                P::decode_count_with(self.drive.heard::<P>()?, with).into_result()
            }
        }

        impl<T: $transport> $client<T> {
            /// The answer to a request; the telegram carries the process data too.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells; [`BuildError::OtherUnit`] for a request to another unit, which is not to
            /// take this one's process data.
            pub $($async)? fn exchange(
                &mut self,
                request: Request,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                self.exchange_with(request, self.drive.process)$($wait)*
            }

            /// The answer to a request that carries these process data, which stay in force if the drive answers.
            $($async)? fn exchange_with(
                &mut self,
                request: Request,
                process: Process,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                let (sent, space) = self.drive.telegrams(&request, &process)?;
                let answer = self.transport.exchange(sent, space)$($wait)*;
                let length = answer.map_err(|error| ClientError::Transport(error, None))?;
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

            /// Sends this client's process data to all units, of which none answers: nobody knows who heard it.
            ///
            /// The first mask says which words are meant: bit 1 the first word, bit 2 the second. The second mask says
            /// which bits of the first word are meant, the others which of a further control word: `[6, 0xFFFF, 0, 0]`
            /// is a whole control word and its setpoint. Other clients on the bus do not know of it and repeat their
            /// own words with their next telegram: set those too, or a stop for all lasts until then.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells; [`BuildError::BadMask`] if the first word is meant without the bits that
            /// make it valid, which are in the word as soon as one of its points was set.
            pub $($async)? fn broadcast(
                &mut self,
                masks: [u16; 4],
            ) -> Result<(), ClientError<T::Error>> {
                let sent = self.drive.for_all(masks)?;
                let answer = self.transport.exchange(sent, &mut [])$($wait)*;
                answer.map_err(|error| ClientError::Transport(error, None))?;
                Ok(())
            }

            /// Sets a point of the process data and sends it. It stays set if the drive answers.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Encodable<With: NeedsNothing> + Whole + Sent,
            {
                self.send_with::<P>(value, NeedsNothing::nothing())$($wait)*
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
                P: Encodable + Whole + Sent,
            {
                let words = P::encode_with(value, with)?.into_words();
                let process = self.drive.with_words::<P>(words.as_ref())?;
                self.send_process::<P>(process)$($wait)*
            }

            /// As `send`, from a count: the value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send_count<P>(&mut self, count: P::Count) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable<With: NeedsNothing> + Whole + Sent,
            {
                self.send_count_with::<P>(count, NeedsNothing::nothing())$($wait)*
            }

            /// As `send_count`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send_count_with<P>(
                &mut self,
                count: P::Count,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable + Whole + Sent,
            {
                let words = P::encode_count_with(count, with)?.into_words();
                let process = self.drive.with_words::<P>(words.as_ref())?;
                self.send_process::<P>(process)$($wait)*
            }

            /// Sends process data that are new in a point.
            $($async)? fn send_process<P: Sent>(
                &mut self,
                process: Process,
            ) -> Result<(), ClientError<T::Error>> {
                let request = Request::cyclic(self.drive.unit);
                let reply = self.exchange_with(request, process)$($wait)*;
                reply.map(drop).map_err(ClientError::of::<P>)
            }

            /// Sets a group of bits of the process data and sends it. It stays set if the drive answers.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn send_bits<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Encodable<With: NeedsNothing> + BitGroup + Sent,
            {
                let process = self.drive.with_bits::<P>(P::encode(value)?)?;
                self.send_process::<P>(process)$($wait)*
            }

            /// The value of a point of the process data, which the drive is asked for.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn receive<P>(&mut self) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable<Factors: NeedsNothing> + Received,
            {
                self.receive_with::<P>(NeedsNothing::nothing())$($wait)*
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
                self.cycle()$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(self.heard_with::<P>(with)?)
            }

            /// As `receive`, as a count: the value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn receive_count<P>(&mut self) -> Result<P::Count, ClientError<T::Error>>
            where
                P: CountReadable<Factors: NeedsNothing> + Received,
            {
                self.receive_count_with::<P>(NeedsNothing::nothing())$($wait)*
            }

            /// As `receive_count`, by the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn receive_count_with<P>(
                &mut self,
                with: P::Factors,
            ) -> Result<P::Count, ClientError<T::Error>>
            where
                P: CountReadable + Received,
            {
                self.cycle()$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(self.heard_count_with::<P>(with)?)
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
                let reply = self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(reply.raw::<P>()?)
            }

            /// A parameter's value.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read<P>(&mut self) -> Result<P::Value, ClientError<T::Error>>
            where
                P: Readable<Factors: NeedsNothing> + Parameter,
            {
                self.read_with::<P>(NeedsNothing::nothing())$($wait)*
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

            /// A parameter's count: its value in units of `10^-DECIMALS`, without floating point.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_count<P>(&mut self) -> Result<P::Count, ClientError<T::Error>>
            where
                P: CountReadable<Factors: NeedsNothing> + Parameter,
            {
                self.read_count_with::<P>(NeedsNothing::nothing())$($wait)*
            }

            /// A parameter's count, by the raw numbers that its scale needs.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn read_count_with<P>(
                &mut self,
                with: P::Factors,
            ) -> Result<P::Count, ClientError<T::Error>>
            where
                P: CountReadable + Parameter,
            {
                let raw = self.read_raw::<P>()$($wait)*?;
                Ok(P::decode_count_with(raw, with).into_result()?)
            }

            /// Changes a parameter until the power is off.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Encodable<With: NeedsNothing> + Whole + Parameter,
            {
                self.write_with::<P>(value, NeedsNothing::nothing())$($wait)*
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
                P: Encodable + Whole + Parameter,
            {
                let raw = P::encode_with(value, with)?;
                self.change::<P>(Request::write::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a parameter to a count until the power is off: its value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write_count<P>(&mut self, count: P::Count) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable<With: NeedsNothing> + Whole + Parameter,
            {
                self.write_count_with::<P>(count, NeedsNothing::nothing())$($wait)*
            }

            /// As `write_count`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write_count_with<P>(
                &mut self,
                count: P::Count,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable + Whole + Parameter,
            {
                let raw = P::encode_count_with(count, with)?;
                self.change::<P>(Request::write::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a parameter to a raw number until the power is off, if it may be written.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write_raw<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With: NeedsNothing> + Whole + Parameter,
            {
                self.write_raw_with::<P>(raw, NeedsNothing::nothing())$($wait)*
            }

            /// As `write_raw`, by the raw numbers that the point's limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn write_raw_with<P>(
                &mut self,
                raw: P::Raw,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                P::check_with(raw, with)?;
                self.change::<P>(Request::write::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a parameter in the EEPROM too, which stands a limited number of writes.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Encodable<With: NeedsNothing> + Whole + Parameter,
            {
                self.store_with::<P>(value, NeedsNothing::nothing())$($wait)*
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
                P: Encodable + Whole + Parameter,
            {
                let raw = P::encode_with(value, with)?;
                self.change::<P>(Request::store::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a parameter to a count in the EEPROM too: its value in units of `10^-DECIMALS`.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_count<P>(&mut self, count: P::Count) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable<With: NeedsNothing> + Whole + Parameter,
            {
                self.store_count_with::<P>(count, NeedsNothing::nothing())$($wait)*
            }

            /// As `store_count`, by the raw numbers that the point's scale and limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_count_with<P>(
                &mut self,
                count: P::Count,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: CountWritable + Whole + Parameter,
            {
                let raw = P::encode_count_with(count, with)?;
                self.change::<P>(Request::store::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a parameter to a raw number in the EEPROM too, if it may be written.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_raw<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Writable<With: NeedsNothing> + Whole + Parameter,
            {
                self.store_raw_with::<P>(raw, NeedsNothing::nothing())$($wait)*
            }

            /// As `store_raw`, by the raw numbers that the point's limits need.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn store_raw_with<P>(
                &mut self,
                raw: P::Raw,
                with: P::With,
            ) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                P::check_with(raw, with)?;
                self.change::<P>(Request::store::<P>(self.drive.unit, raw))$($wait)*
            }

            /// Changes a group of bits until the power is off: reads the word, replaces the bits, writes the word back.
            ///
            /// # Errors
            /// Whatever [`ClientError`] tells.
            pub $($async)? fn update<P>(&mut self, value: P::Value) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Encodable<With: NeedsNothing> + BitGroup + Parameter,
            {
                let raw = P::encode(value)?;
                let word = self.parameter_word::<P>()$($wait)*?;
                self.change::<P>(Request::update::<P>(self.drive.unit, word, raw))$($wait)*
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
                P: Readable + Encodable<With: NeedsNothing> + BitGroup + Parameter,
            {
                let raw = P::encode(value)?;
                let word = self.parameter_word::<P>()$($wait)*?;
                self.change::<P>(Request::store_update::<P>(self.drive.unit, word, raw))$($wait)*
            }

            /// Writes a parameter and holds the answer against what was written.
            $($async)? fn change<P: Parameter>(
                &mut self,
                request: Request,
            ) -> Result<(), ClientError<T::Error>> {
                let reply = self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                if request.is_confirmed::<P>(&reply) {
                    Ok(())
                } else {
                    Err(ClientError::EchoMismatch(reply.value(), Some(P::NAME)))
                }
            }

            /// The whole word that a group of bits is in.
            $($async)? fn parameter_word<P>(&mut self) -> Result<u16, ClientError<T::Error>>
            where
                P: Readable + BitGroup + Parameter,
            {
                let request = Request::read::<P>(self.drive.unit);
                let reply = self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                Ok(reply.word().map_err(Error::of::<P>)?)
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
client!(
    AsyncClient,
    AsyncTransport,
    "One drive behind a transport that does not block.",
    [async],
    [.await]
);
client!(
    LocalClient,
    LocalTransport,
    "One drive behind a transport of one thread, which does not block.",
    [async],
    [.await]
);
