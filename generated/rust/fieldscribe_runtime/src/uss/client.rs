// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a USS drive over a transport that the caller brings.

use core::marker::PhantomData;

use super::{broadcast, Link, Parameter, Profile, Received, Reply, Request, Sent, Value, LONGEST};
use crate::client::{
    bits_methods, data_methods, read_methods, write_methods, AsyncTransport, LocalTransport,
    Transport, MOST_NEEDS,
};
use crate::identification::{divided, holds, NOTHING_HELD};
use crate::point::{joined, split};
use crate::trace::{self, Way};
use crate::{
    Accepts, AnyDevice, AnyValue, BitGroup, BuildError, ClientError, CountReadable, CountWritable,
    Decoded, Device, Encodable, EncodableAlone, Error, Identification, NeedsNothing, OtherDevice,
    PointFacts, PointInfo, Points, Raw, Readable, ReplyError, Variants, Whole, Writable,
};

/// The most words of process data that a client keeps.
const WORDS: usize = 16;
/// The longest telegram that a client sends: four words of the parameter part, and the process data.
const SENT: usize = 4 + 2 * (4 + WORDS);

/// The words that every telegram repeats, and whether the drive may not have received them yet.
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

/// One drive of a bus: keeps the words that every telegram to it repeats, and those of its last answer.
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
    /// Until the answer arrives, it is unknown which of two sets of words the drive has, so neither may be repeated:
    /// the old words could restart what the new ones stopped. The same holds if nobody waits for the answer.
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
        trace::frame(self.unit, Way::Sent, None, sent);
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
        let sent = self.sent.get(..length).ok_or(BuildError::BufferTooSmall)?;
        trace::frame(self.unit, Way::Sent, None, sent);
        Ok(sent)
    }

    /// Parses the first bytes that were received, and keeps the process data of the answer.
    fn reply(
        &mut self,
        request: &Request,
        process: &Process,
        length: usize,
    ) -> Result<Reply<'_>, ReplyError> {
        let received = self.received.get(..length);
        let received = received.ok_or(ReplyError::WrongLength)?;
        trace::frame(self.unit, Way::Came, None, received);
        let reply = request.parse(self.profile, self.link, received);
        // A drive that refuses the task has taken the process data of the telegram nevertheless.
        let is_about_this = matches!(
            reply,
            Ok(_) | Err(ReplyError::Refused { .. } | ReplyError::NoRights | ReplyError::NoAnswer)
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

    /// The process data with another raw number of a point as data.
    fn with_data(&self, point: &PointFacts, raw: i128) -> Result<Process, Error> {
        let position = usize::from(point.address);
        let word = self.process.words.get(position).copied();
        let words = point.words_of(raw, word.unwrap_or_default())?;
        self.changed(|all| {
            for (position, word) in point.addresses.iter().zip(words) {
                *all.get_mut(usize::from(*position))
                    .ok_or(Error::BeyondLink(None))? = word;
            }
            Ok(())
        })
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

/// The error of a line, which is traced.
fn failed<E>(unit: u8, error: E) -> ClientError<E> {
    trace::failed(unit);
    ClientError::Transport(error, None)
}

/// The same client twice, blocking and async: only how it waits for the transport differs.
macro_rules! client {
    ($client:ident, $transport:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        #[doc = $about]
        ///
        /// Every telegram carries the words of process data as they were last set, and 0 for words that were never set.
        /// The constant bits of a word, such as the one that makes a control word valid, come with the first point of
        /// that word. A drive without a valid control word goes on as before.
        ///
        /// If a telegram with new words fails (no answer, a wrong one, or nobody waited for it), it is unknown which
        /// words the drive has. Then neither the old nor the new words are repeated: all words are 0 until each is set
        /// again. A drive that refuses a task has taken the words nevertheless.
        #[derive(Debug)]
        pub struct $client<T, D = AnyDevice> {
            transport: T,
            drive: Drive,
            device: PhantomData<D>,
        }

        impl<T: $transport, D: Device<Profile = Profile>> $client<T, D> {
            /// Returns a client for the drive with this unit number behind a transport.
            pub const fn new(transport: T, link: Link, unit: u8) -> Self {
                Self { transport, drive: Drive::new(D::PROFILE, link, unit), device: PhantomData }
            }
        }

        impl<T: $transport> $client<T> {
            /// Returns a client for a device that is chosen at run time; it takes the points of every device.
            pub const fn for_profile(
                transport: T,
                profile: &'static Profile,
                link: Link,
                unit: u8,
            ) -> Self {
                Self { transport, drive: Drive::new(profile, link, unit), device: PhantomData }
            }
        }

        impl<T, D> $client<T, D> {

            /// The transport, for example to change its settings.
            pub fn transport(&mut self) -> &mut T {
                &mut self.transport
            }

            /// The transport back.
            pub fn into_transport(self) -> T {
                self.transport
            }

            write_methods! {
                [], [], "Sets a point of the process data, which the next telegram carries; \
                [`Error::BeyondLink`] if the link has fewer words.", put for Sent, Error;
                set set_with set_count set_count_with set_raw set_raw_with
            }

            /// Sets a point to a raw number that was checked.
            fn put<P: Sent>(&mut self, raw: P::Raw) -> Result<(), Error> {
                self.drive.process = self.drive.with_words::<P>(split::<P>(raw).as_ref())?;
                Ok(())
            }

            bits_methods! {
                [], [], "Sets a group of bits of the process data, which the next telegram carries; \
                [`Error::BeyondLink`] if the link has fewer words.", put_bits for Sent, Error;
                set_bits set_bits_with
            }

            /// Sets a group of bits to a raw number that was checked.
            fn put_bits<P: BitGroup + Sent>(&mut self, raw: P::Raw) -> Result<(), Error> {
                self.drive.process = self.drive.with_bits::<P>(raw)?;
                Ok(())
            }

            /// Sets a word of the process data by its position from 0 on, for what has no point; all its bits are the
            /// caller's.
            ///
            /// # Errors
            /// [`Error::BeyondLink`] if the link has fewer words.
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
            /// Those of decoding; [`Error::NotHeard`] if the last telegram was not answered; [`Error::BeyondLink`] if
            /// the link has fewer words.
            pub fn heard<P>(&self) -> Result<P::Value, Error>
            where
                P: Readable<Factors: NeedsNothing> + Received,
                D: Accepts<P::Device>,
            {
                self.heard_with::<P>(NeedsNothing::nothing())
            }

            /// As `heard`, with the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// The same.
            pub fn heard_with<P>(&self, with: P::Factors) -> Result<P::Value, Error>
            where
                P: Readable + Received,
                D: Accepts<P::Device>,
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
                D: Accepts<P::Device>,
            {
                self.heard_count_with::<P>(NeedsNothing::nothing())
            }

            /// As `heard_count`, with the raw numbers that the point's scale needs.
            ///
            /// # Errors
            /// The same.
            pub fn heard_count_with<P>(&self, with: P::Factors) -> Result<P::Count, Error>
            where
                P: CountReadable + Received,
                D: Accepts<P::Device>,
            {
                P::decode_count_with(self.drive.heard::<P>()?, with).into_result()
            }
        }

        impl<T: $transport, D> $client<T, D> {
            /// The answer to a request; the telegram carries the process data too.
            ///
            /// # Errors
            /// Any [`ClientError`]; [`BuildError::OtherUnit`] for a request to another unit, which must not receive the
            /// process data of this one.
            pub $($async)? fn exchange(
                &mut self,
                request: Request,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                self.exchange_with(request, self.drive.process)$($wait)*
            }

            /// Returns the answer to a request with these process data, which are kept if the drive answers.
            $($async)? fn exchange_with(
                &mut self,
                request: Request,
                process: Process,
            ) -> Result<Reply<'_>, ClientError<T::Error>> {
                let (sent, space) = self.drive.telegrams(&request, &process)?;
                let answer = self.transport.exchange(sent, space)$($wait)*;
                let length = answer.map_err(|error| failed(self.drive.unit, error))?;
                Ok(self.drive.reply(&request, &process, length)?)
            }

            /// Sends the process data and keeps those of the answer.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn cycle(&mut self) -> Result<(), ClientError<T::Error>> {
                let request = Request::cyclic(self.drive.unit);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            /// Sends this client's process data to all units. None of them answers, so it is unknown which received it.
            ///
            /// The first mask says which words are meant: bit 1 the first word, bit 2 the second. The second mask says
            /// which bits of the first word are meant, the others which of a further control word: `[6, 0xFFFF, 0, 0]`
            /// is a whole control word and its setpoint. Other clients on the bus do not know of it and repeat their
            /// own words with their next telegram: set those too, or a stop for all lasts until then.
            ///
            /// # Errors
            /// Any [`ClientError`]; [`BuildError::BadMask`] if the first word is meant without the bits that make it
            /// valid, which are in the word as soon as one of its points was set.
            pub $($async)? fn broadcast(
                &mut self,
                masks: [u16; 4],
            ) -> Result<(), ClientError<T::Error>> {
                let sent = self.drive.for_all(masks)?;
                let answer = self.transport.exchange(sent, &mut [])$($wait)*;
                answer.map_err(|error| failed(self.drive.unit, error))?;
                Ok(())
            }

            write_methods! {
                [$($async)?], [$($wait)*],
                "Sets a point of the process data and sends it. It stays set if the drive answers.",
                send_words for Sent, ClientError<T::Error>;
                send send_with send_count send_count_with send_raw send_raw_with
            }

            /// Sends a point with a raw number that was checked.
            $($async)? fn send_words<P: Sent>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>> {
                let process = self.drive.with_words::<P>(split::<P>(raw).as_ref())?;
                self.send_process::<P>(process)$($wait)*
            }

            /// Sends process data that are new in a point.
            $($async)? fn send_process<P: Sent>(
                &mut self,
                process: Process,
            ) -> Result<(), ClientError<T::Error>> {
                let reply = self.exchange_with(Request::cyclic(self.drive.unit), process)$($wait)*;
                reply.map(drop).map_err(ClientError::of::<P>)
            }

            bits_methods! {
                [$($async)?], [$($wait)*],
                "Sets a group of bits of the process data and sends it. It stays set if the drive answers.",
                transfer_bits for Sent, ClientError<T::Error>;
                send_bits send_bits_with
            }

            /// Sends a group of bits as a raw number that was checked.
            $($async)? fn transfer_bits<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: BitGroup + Sent,
            {
                let process = self.drive.with_bits::<P>(raw)?;
                self.send_process::<P>(process)$($wait)*
            }

            read_methods! {
                [$($async)?], [$($wait)*], "A point of the process data, which the drive is asked for",
                get_received for Received;
                receive receive_with receive_count receive_count_with receive_raw
            }

            /// Puts the raw number of a point of the process data into place.
            $($async)? fn get_received<P: Received>(&mut self, raw: &mut P::Raw) -> Result<(), ClientError<T::Error>> {
                self.cycle()$($wait)*.map_err(ClientError::of::<P>)?;
                *raw = self.drive.heard::<P>()?;
                Ok(())
            }

            /// Puts a parameter's raw number into place.
            $($async)? fn get_raw<P>(&mut self, raw: &mut P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Parameter,
            {
                let request = Request::read::<P>(self.drive.unit);
                let reply = self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                *raw = reply.raw::<P>()?;
                Ok(())
            }

            read_methods! {
                [$($async)?], [$($wait)*], "A parameter", get_raw for Parameter;
                read read_with read_count read_count_with read_raw
            }

            write_methods! {
                [$($async)?], [$($wait)*], "Changes a parameter until the power is off.",
                change for Parameter, ClientError<T::Error>;
                write write_with write_count write_count_with write_raw write_raw_with
            }

            write_methods! {
                [$($async)?], [$($wait)*],
                "Changes a parameter in the EEPROM too, which stands a limited number of writes.",
                keep for Parameter, ClientError<T::Error>;
                store store_with store_count store_count_with store_raw store_raw_with
            }

            /// Changes a parameter to a raw number that was checked.
            $($async)? fn change<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                self.confirmed::<P>(Request::write::<P>(self.drive.unit, raw))$($wait)*
            }

            /// As `change`, in the EEPROM too.
            $($async)? fn keep<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + Parameter,
            {
                self.confirmed::<P>(Request::store::<P>(self.drive.unit, raw))$($wait)*
            }

            bits_methods! {
                [$($async)?], [$($wait)*],
                "Changes a group of bits until power-off: reads the word, replaces the bits, writes the word back.",
                change_bits for Readable | Parameter, ClientError<T::Error>;
                update update_with
            }

            bits_methods! {
                [$($async)?], [$($wait)*],
                "As `update`, in the EEPROM too.",
                keep_bits for Readable | Parameter, ClientError<T::Error>;
                store_update store_update_with
            }

            /// Changes a group of bits to a raw number that was checked.
            $($async)? fn change_bits<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Writable + BitGroup + Parameter,
            {
                let word = self.parameter_word::<P>()$($wait)*?;
                self.confirmed::<P>(Request::update::<P>(self.drive.unit, word, raw))$($wait)*
            }

            /// As `change_bits`, in the EEPROM too.
            $($async)? fn keep_bits<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Writable + BitGroup + Parameter,
            {
                let word = self.parameter_word::<P>()$($wait)*?;
                self.confirmed::<P>(Request::store_update::<P>(self.drive.unit, word, raw))$($wait)*
            }

            /// Writes a parameter and compares the answer with what was written.
            $($async)? fn confirmed<P: Parameter>(
                &mut self,
                request: Request,
            ) -> Result<(), ClientError<T::Error>> {
                let reply = self.exchange(request)$($wait)*.map_err(ClientError::of::<P>)?;
                if request.is_confirmed::<P>(&reply) {
                    Ok(())
                } else {
                    Err(ClientError::from(request.other_number(reply.value(), P::FLOATING)).of::<P>())
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

            data_methods! { [$($async)?], [$($wait)*], words_of put_data }

            /// The words of a point as data: of the process data that the drive is asked for, or of a parameter.
            $($async)? fn words_of<const N: usize>(
                &mut self,
                point: &PointFacts,
            ) -> Result<[u16; N], ClientError<T::Error>> {
                let mut words = [0; N];
                if point.telegram.is_some() {
                    self.cycle()$($wait)*?;
                    for (place, position) in words.iter_mut().zip(point.addresses) {
                        *place = self.drive.heard_word(*position)?;
                    }
                } else {
                    let value = self.parameter_value(point)$($wait)*?;
                    let places = words.get_mut(..usize::from(point.words));
                    value.fill(places.unwrap_or_default())?;
                }
                Ok(words)
            }

            /// Sends a raw number that was checked in the process data, or changes a parameter until the power is off.
            $($async)? fn put_data(&mut self, point: &PointFacts, raw: i128) -> Result<(), ClientError<T::Error>> {
                if point.telegram.is_some() {
                    let process = self.drive.with_data(point, raw)?;
                    self.exchange_with(Request::cyclic(self.drive.unit), process)$($wait)*?;
                    return Ok(());
                }
                let mut word = [0];
                if point.mask.is_some() {
                    self.parameter_value(point)$($wait)*?.fill(&mut word)?;
                }
                let [word] = word;
                let words = point.words_of(raw, word)?;
                let words = words.get(..usize::from(point.words)).unwrap_or(&words);
                let element = (point.address, point.index);
                let request = Request::write_words(self.drive.unit, element, words, false);
                let answer = self.exchange(request)$($wait)*?.value();
                if request.is_answered(answer, point.is_floating()) {
                    Ok(())
                } else {
                    Err(request.other_number(answer, point.is_floating()).into())
                }
            }

            /// The value that a parameter as data has.
            $($async)? fn parameter_value(&mut self, point: &PointFacts) -> Result<Value, ClientError<T::Error>> {
                let index = point.index.map_or(0, u16::from);
                let request = Request::new(self.drive.unit, 1, point.address, index);
                Ok(self.exchange(request)$($wait)*?.value())
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
