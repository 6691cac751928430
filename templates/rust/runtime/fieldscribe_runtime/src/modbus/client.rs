// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a Modbus device over a transport of the caller.

use core::marker::PhantomData;

use super::base::MOST_BLOCKS;
use super::function::read_function;
use super::memory::{Forgets, Memory};
use super::reply::wrong_length;
use super::{Base, Block, Command, FoundBlock, Framing, Profile, Reply, Request, LONGEST};
use crate::client::{
    bits_methods, data_methods, read_methods, write_methods, AsyncTransport, LocalTransport,
    Transport, MOST_NEEDS,
};
use crate::identification::{divided, holds, NOTHING_HELD};
use crate::point::{counted, counted_mut, in_reading_order};
use crate::trace::{self, Way};
use crate::{
    Accepts, AnyDevice, AnyValue, BitGroup, BuildError, ClientError, CountReadable, CountWritable,
    Decoded, Device, Encodable, EncodableAlone, Identification,
};
use crate::{
    NeedsNothing, OtherDevice, Point, PointFacts, PointInfo, Points, Raw, Readable, ReplyError,
    Selection, Variants, Whole, Writable, WrittenAlone,
};

/// One unit of a bus: numbers the requests and stores the frames.
#[derive(Debug)]
struct Unit {
    profile: &'static Profile,
    framing: Framing,
    number: u8,
    transaction: u16,
    base: Base,
    sent: [u8; LONGEST],
    received: [u8; LONGEST],
    /// The number of bytes of the last reply.
    length: usize,
}

impl Unit {
    const fn new(profile: &'static Profile, framing: Framing, number: u8) -> Self {
        Self {
            profile,
            framing,
            number,
            transaction: 0,
            base: Base::NONE,
            sent: [0; LONGEST],
            received: [0; LONGEST],
            length: 0,
        }
    }

    /// Gives the request this unit's framing, the next transaction number, and its base if known.
    fn number(&mut self, request: &mut Request<'_>) {
        request.place(&self.base);
        request.framing = self.framing;
        self.transaction = self.transaction.wrapping_add(1);
        request.transaction = self.transaction;
    }

    /// The frame to send and the buffer for its reply, empty for a broadcast.
    fn frames(&mut self, request: &Request<'_>) -> Result<(&[u8], &mut [u8]), BuildError> {
        self.length = 0;
        let sent = request.build_in(self.profile, &mut self.sent)?;
        let is_broadcast = self.profile.is_broadcast(request.unit());
        let end = if is_broadcast { 0 } else { LONGEST };
        trace::frame(request.unit(), Way::Sent, None, sent);
        Ok((sent, self.received.get_mut(..end).unwrap_or_default()))
    }

    /// Checks that the received bytes are a reply to the request.
    fn prove(&mut self, request: &Request<'_>, length: usize) -> Result<(), ReplyError> {
        self.length = length;
        trace::frame(request.unit(), Way::Came, None, self.received());
        let proven = match self.received.get(..length) {
            Some(received) => request.prove(received),
            None => Err(wrong_length(length, LONGEST)),
        };
        proven.map_err(|error| self.profile.named(error))
    }

    /// The reply to a request, after it was checked.
    fn reply<D>(&self, request: &Request<'_>) -> Reply<'_, D> {
        request.reply(self.received())
    }

    /// Copies the words of a point, or its bit, out of a checked reply.
    fn copy(&self, request: &Request<'_>, words: &mut [u16]) {
        for (word, item) in words
            .iter_mut()
            .zip(self.reply::<AnyDevice>(request).items())
        {
            *word = item;
        }
    }

    fn received(&self) -> &[u8] {
        self.received.get(..self.length).unwrap_or(&self.received)
    }
}

/// The client, for each way to wait for the transport.
macro_rules! client {
    ($client:ident, $transport:ident, $ask:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        /// Sends a request and checks its reply; a broadcast has none.
        $($async)? fn $ask<T: $transport>(
            transport: &mut T,
            unit: &mut Unit,
            request: &mut Request<'_>,
        ) -> Result<(), ClientError<T::Error>> {
            unit.number(request);
            let (sent, space) = match unit.frames(request) {
                Ok(frames) => frames,
                Err(error) => return Err(ClientError::Build(error, Some(request.about()))),
            };
            let is_for_all = space.is_empty();
            match transport.exchange(sent, space)$($wait)* {
                Ok(_) if is_for_all => Ok(()),
                Ok(length) => match unit.prove(request, length) {
                    Ok(()) => Ok(()),
                    Err(error) => Err(ClientError::Reply(error, Some(request.about()))),
                },
                Err(error) => {
                    trace::failed(request.unit());
                    Err(ClientError::Transport(error, Some(request.about())))
                }
            }
        }

        #[doc = $about]
        #[derive(Debug)]
        pub struct $client<T, D = AnyDevice, M = Forgets> {
            transport: T,
            unit: Unit,
            memory: M,
            device: PhantomData<D>,
        }

        impl<T: $transport, D: Device<Profile = Profile>, M: Memory> $client<T, D, M> {
            /// A unit of a bus.
            pub const fn new(transport: T, framing: Framing, unit: u8) -> Self {
                Self { transport, unit: Unit::new(D::PROFILE, framing, unit), memory: M::NOTHING, device: PhantomData }
            }
        }

        impl<T: $transport> $client<T> {
            /// A unit with a device that is chosen at run time; its client takes every point.
            pub const fn for_profile(
                transport: T,
                profile: &'static Profile,
                framing: Framing,
                unit: u8,
            ) -> Self {
                Self { transport, unit: Unit::new(profile, framing, unit), memory: Forgets, device: PhantomData }
            }
        }

        impl<T, D, M> $client<T, D, M> {
            /// The same unit with another profile, such as that of a translating gateway:
            /// [`Profile::with_framings`].
            #[must_use]
            pub fn with_profile(self, profile: &'static Profile) -> Self {
                Self { unit: Unit { profile, ..self.unit }, ..self }
            }

            /// The transport, for example to change its settings.
            pub fn transport(&mut self) -> &mut T {
                &mut self.transport
            }

            /// The bytes of the last reply, even if it was invalid; empty if the line failed.
            pub fn received(&self) -> &[u8] {
                self.unit.received()
            }

            /// Returns the transport.
            pub fn into_transport(self) -> T {
                self.transport
            }
        }

        impl<T: $transport, D, M: Memory> $client<T, D, M> {
            /// Sets a base: addresses of its points count from it until another one is set.
            pub fn set_base(&mut self, base: Base) {
                self.unit.base = base;
            }

            /// Finds a block and sets it as the base; [`None`] if the device has no such block.
            ///
            /// # Errors
            /// Any [`ClientError`]; [`BuildError::BadAddress`] for blocks that do not end.
            pub $($async)? fn find(&mut self, block: &FoundBlock) -> Result<Option<Base>, ClientError<T::Error>> {
                let chain = block.chain;
                let mut place = None;
                for start in chain.places {
                    let count = u16::try_from(chain.marker.len()).unwrap_or(u16::MAX);
                    match self.exchange(Request::new(self.unit.number, chain.function, *start, count))$($wait)* {
                        Ok(Some(reply)) if reply.items().eq(chain.marker.iter().copied()) => {
                            place = start.checked_add(count);
                            break;
                        }
                        Ok(_) | Err(ClientError::Reply(ReplyError::Exception { .. }, _)) => {}
                        Err(error) => return Err(error),
                    }
                }
                let Some(mut place) = place else { return Ok(None) };
                for _ in 0..MOST_BLOCKS {
                    let request = Request::new(self.unit.number, chain.function, place, 2);
                    let reply = self.exchange(request)$($wait)*?;
                    let head = reply.and_then(|reply| Some((reply.item(0)?, reply.item(1)?)));
                    let Some((id, length)) = head else { return Ok(None) };
                    if id == chain.end {
                        return Ok(None);
                    }
                    let last = length.saturating_add(1);
                    let Some(end) = place.checked_add(last) else { break };
                    if id == block.id {
                        let base = Base::new(block.name, place, last);
                        self.set_base(base);
                        return Ok(Some(base));
                    }
                    let Some(next) = end.checked_add(1) else { break };
                    place = next;
                }
                Err(BuildError::BadAddress.into())
            }

            /// Sends a request and returns its reply, or [`None`] for a broadcast.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn exchange(
                &mut self,
                mut request: Request<'_>,
            ) -> Result<Option<Reply<'_, D>>, ClientError<T::Error>> {
                $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*?;
                let is_for_all = self.unit.profile.is_broadcast(request.unit());
                Ok((!is_for_all).then(|| self.unit.reply(&request)))
            }

            /// Reads a point's raw number into `raw`.
            $($async)? fn get_raw<P: Readable>(&mut self, raw: &mut P::Raw) -> Result<(), ClientError<T::Error>> {
                let mut words = P::Raw::MIN.into_words();
                self.get::<P>(counted_mut::<P>(words.as_mut()))$($wait)*?;
                *raw = P::from_words(words);
                Ok(())
            }

            /// Reads the words of a point, or its bit.
            $($async)? fn get<P: Readable>(&mut self, words: &mut [u16]) -> Result<(), ClientError<T::Error>> {
                let mut request = Request::read::<P>(self.unit.number);
                if !P::SELECTS.is_empty() {
                    self.select(P::SELECTS)$($wait)*?;
                }
                let standing = self.memory.standing(self.unit.transaction);
                $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*?;
                self.memory.keep(self.unit.transaction, standing);
                self.unit.copy(&request, words);
                Ok(())
            }

            /// The words or bits of a block, one of `blocks`: `reply.raw::<P>()` returns each of its points.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn read_block(&mut self, block: &Block<D>) -> Result<Reply<'_, D>, ClientError<T::Error>> {
                let mut request = Request::block(self.unit.number, block);
                let standing = self.memory.standing(self.unit.transaction);
                $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*?;
                self.memory.keep(self.unit.transaction, standing);
                Ok(self.unit.reply(&request))
            }

            read_methods! {
                [$($async)?], [$($wait)*], "A point", get_raw for Point;
                read read_with read_count read_count_with read_raw
            }

            write_methods! {
                [$($async)?], [$($wait)*], "Writes a value to a point.", put for WrittenAlone, ClientError<T::Error>;
                write write_with write_count write_count_with write_raw write_raw_with
            }

            /// Writes a checked raw number.
            $($async)? fn put<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Writable + Whole + WrittenAlone,
            {
                let words = P::to_words(raw);
                let mut request = Request::write_words::<P>(self.unit.number, counted::<P>(words.as_ref()));
                if !P::SELECTS.is_empty() {
                    self.select(P::SELECTS)$($wait)*?;
                }
                let done = $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*;
                if !P::SELECTS.is_empty() && done.is_ok() {
                    self.memory.keep(self.unit.transaction, P::SELECTS);
                }
                done
            }

            /// Writes what other points must hold before the address means this one, except what they hold already.
            $($async)? fn select(&mut self, selects: &'static [Selection]) -> Result<(), ClientError<T::Error>> {
                let standing = self.memory.standing(self.unit.transaction);
                for Selection { point, raw } in selects.iter().filter(|row| !standing.contains(row)) {
                    let written = self.put_here(point, *raw)$($wait)*;
                    written.map_err(|error| error.named(point.name))?;
                }
                self.memory.keep(self.unit.transaction, selects);
                Ok(())
            }

            data_methods! { [$($async)?], [$($wait)*], words_of put_data }

            /// Writes a checked raw number to a point as data.
            $($async)? fn put_data(&mut self, point: &PointFacts, raw: i128) -> Result<(), ClientError<T::Error>> {
                let selects = point.selects();
                if !selects.is_empty() {
                    self.select(selects)$($wait)*?;
                }
                self.put_here(point, raw)$($wait)*?;
                self.memory.keep(self.unit.transaction, selects);
                Ok(())
            }

            /// Writes a raw number of a point that is selected.
            $($async)? fn put_here(&mut self, point: &PointFacts, raw: i128) -> Result<(), ClientError<T::Error>> {
                let mut before = [0; 4];
                if point.mask.is_some() {
                    before = self.words_here(point)$($wait)*?;
                }
                let (words, count) = point.words_from_raw(raw, before[0])?;
                let (function, address) = point.write_place();
                let values = words.get(..count).unwrap_or(&words);
                let mut request =
                    Request::write_values(self.unit.number, function, address, values).counted_from(point.base);
                $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*
            }

            /// The words of a point as data, in reading order.
            $($async)? fn words_of<const N: usize>(
                &mut self,
                point: &PointFacts,
            ) -> Result<[u16; N], ClientError<T::Error>> {
                let selects = point.selects();
                if !selects.is_empty() {
                    self.select(selects)$($wait)*?;
                }
                let standing = self.memory.standing(self.unit.transaction);
                let words = self.words_here(point)$($wait)*?;
                self.memory.keep(self.unit.transaction, standing);
                Ok(words)
            }

            /// The words of a point that is selected, in reading order.
            $($async)? fn words_here<const N: usize>(
                &mut self,
                point: &PointFacts,
            ) -> Result<[u16; N], ClientError<T::Error>> {
                let (function, mut words) = (read_function(point.space), [0; N]);
                let mut request = Request::new(self.unit.number, function, point.address, point.span())
                    .counted_from(point.base);
                $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*?;
                self.unit.copy(&request, &mut words);
                Ok(in_reading_order(words, point.addresses))
            }

            /// Sends a command, one of `commands`.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn command(&mut self, command: &Command<D>) -> Result<(), ClientError<T::Error>> {
                let request = Request::command(self.unit.number, command);
                self.exchange(request)$($wait)*?;
                Ok(())
            }

            bits_methods! {
                [$($async)?], [$($wait)*],
                "Writes a value to a group of bits: reads the word, replaces the bits, writes the word back.",
                put_bits for Readable | WrittenAlone, ClientError<T::Error>;
                update update_with
            }

            /// Writes a checked raw number to a group of bits.
            $($async)? fn put_bits<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Writable + BitGroup + WrittenAlone,
            {
                let mut word = [0];
                self.get::<P>(&mut word)$($wait)*?;
                let [word] = word;
                let mut request = Request::update::<P>(self.unit.number, word, raw);
                let done = $ask(&mut self.transport, &mut self.unit, &mut request)$($wait)*;
                if !P::SELECTS.is_empty() && done.is_ok() {
                    self.memory.keep(self.unit.transaction, P::SELECTS);
                }
                done
            }
        }
    };
}

client!(
    Client,
    Transport,
    ask,
    "One unit behind a transport that blocks.",
    [],
    []
);
client!(
    AsyncClient,
    AsyncTransport,
    ask_async,
    "One unit behind a transport that does not block.",
    [async],
    [.await]
);
client!(
    LocalClient,
    LocalTransport,
    ask_local,
    "One unit behind a transport of one thread, which does not block.",
    [async],
    [.await]
);
