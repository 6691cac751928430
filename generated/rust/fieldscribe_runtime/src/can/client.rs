// SPDX-License-Identifier: 0BSD
//! Reading and writing points of a CAN device over a transport of the caller.

use core::future::Future;
use core::marker::PhantomData;

use super::{Dialogue, Frame, Message, Parameter, Profile, Received, Receiver, Telegram};
use crate::client::{bits_methods, data_methods, read_methods, write_methods, MOST_NEEDS};
use crate::identification::{divided, holds, NOTHING_HELD};
use crate::point::{ascending, in_address_order, in_reading_order};
use crate::trace::{self, Way};
use crate::{
    Accepts, AnyDevice, AnyValue, BitGroup, BuildError, ClientError, CountReadable, CountWritable,
    Decoded, Device, Encodable, EncodableAlone, Error, Identification, NeedsNothing, OtherDevice,
    PointFacts, PointInfo, Points, Raw, Readable, ReplyError, Variants, Whole, Writable,
};

/// Sends frames and waits for frames.
///
/// These are data frames whose identifiers have as many bits as the device's ([`Profile::identifier_bits`]).
/// A transport drops remote frames, and extended ones where the device's are not: a [`Frame`] does not tell
/// them apart.
pub trait Transport {
    /// What can go wrong on the bus.
    type Error;

    /// Sends a frame.
    ///
    /// # Errors
    /// Any failure of the bus.
    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error>;

    /// Waits for the next frame.
    ///
    /// # Errors
    /// Any failure of the bus, also if nothing arrives in time.
    fn receive(&mut self) -> Result<Frame, Self::Error>;

    /// A frame that has already arrived; [`None`] at once if there is none.
    ///
    /// A client empties the bus with this before a request, so that a late answer to an earlier request is not taken
    /// for the answer to this one. A transport that cannot tell returns [`None`], and takes that risk.
    ///
    /// # Errors
    /// Any failure of the bus.
    fn pending(&mut self) -> Result<Option<Frame>, Self::Error>;
}

/// Sends frames and waits for frames without blocking.
pub trait AsyncTransport: Send {
    /// What can go wrong on the bus.
    type Error: Send;

    /// As [`Transport::send`].
    fn send(&mut self, frame: &Frame) -> impl Future<Output = Result<(), Self::Error>> + Send;

    /// As [`Transport::receive`].
    ///
    /// Dropping the future must not lose a frame.
    fn receive(&mut self) -> impl Future<Output = Result<Frame, Self::Error>> + Send;

    /// As [`Transport::pending`].
    fn pending(&mut self) -> impl Future<Output = Result<Option<Frame>, Self::Error>> + Send;
}

/// Sends frames and waits for frames without blocking, on one thread: its futures need not be [`Send`].
pub trait LocalTransport {
    /// What can go wrong on the bus.
    type Error;

    /// As [`Transport::send`].
    fn send(&mut self, frame: &Frame) -> impl Future<Output = Result<(), Self::Error>>;

    /// As [`AsyncTransport::receive`].
    fn receive(&mut self) -> impl Future<Output = Result<Frame, Self::Error>>;

    /// As [`Transport::pending`].
    fn pending(&mut self) -> impl Future<Output = Result<Option<Frame>, Self::Error>>;
}

/// Clients can share one bus: each borrows it while it lives.
impl<T: Transport + ?Sized> Transport for &mut T {
    type Error = T::Error;

    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        (**self).send(frame)
    }

    fn receive(&mut self) -> Result<Frame, Self::Error> {
        (**self).receive()
    }

    fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        (**self).pending()
    }
}

/// As for [`Transport`].
impl<T: AsyncTransport + ?Sized> AsyncTransport for &mut T {
    type Error = T::Error;

    fn send(&mut self, frame: &Frame) -> impl Future<Output = Result<(), Self::Error>> + Send {
        (**self).send(frame)
    }

    fn receive(&mut self) -> impl Future<Output = Result<Frame, Self::Error>> + Send {
        (**self).receive()
    }

    fn pending(&mut self) -> impl Future<Output = Result<Option<Frame>, Self::Error>> + Send {
        (**self).pending()
    }
}

/// As for [`Transport`].
impl<T: LocalTransport + ?Sized> LocalTransport for &mut T {
    type Error = T::Error;

    fn send(&mut self, frame: &Frame) -> impl Future<Output = Result<(), Self::Error>> {
        (**self).send(frame)
    }

    fn receive(&mut self) -> impl Future<Output = Result<Frame, Self::Error>> {
        (**self).receive()
    }

    fn pending(&mut self) -> impl Future<Output = Result<Option<Frame>, Self::Error>> {
        (**self).pending()
    }
}

/// Takes the frames that a client does not wait for: a [`Receiver`], a pair of listeners, or `()` for none.
///
/// `receive` waits for a point of a telegram whose receiver the listener has: [`Hears`]. Which one of a pair that would
/// be, nobody can tell; a pair is asked by its parts, `client.listener().0`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` hears no frames",
    note = "listen with `Receiver::<telegrams::...>::new(unit)`, a pair of them, or your own `Listener`"
)]
pub trait Listener {
    /// Takes a frame, which may be for another listener.
    fn hear(&mut self, frame: &Frame);
}

impl Listener for () {
    fn hear(&mut self, _: &Frame) {}
}

impl<T: Telegram> Listener for Receiver<T> {
    fn hear(&mut self, frame: &Frame) {
        self.take(frame);
    }
}

/// A listener with the receiver of a telegram, so that a client can wait for it.
///
/// To wait for points of several telegrams, write a type of your own:
///
/// ```
/// use fieldscribe_runtime::can::{Frame, Hears, Listener, Receiver, Telegram};
///
/// struct Both<A: Telegram, B: Telegram>(Receiver<A>, Receiver<B>);
///
/// impl<A: Telegram, B: Telegram> Listener for Both<A, B> {
///     fn hear(&mut self, frame: &Frame) {
///         self.0.hear(frame);
///         self.1.hear(frame);
///     }
/// }
///
/// struct Fast;
/// struct Slow;
/// # use fieldscribe_runtime::can::{Message, Profile, Role, Slot};
/// # const MESSAGE: &Message = &Message::new("m", 1, true, [Role::Constant(0); 8]);
/// # static PROFILE: Profile = Profile::new((1, 9), 11, None, None);
/// # impl Telegram for Fast {
/// #     type Device = fieldscribe_runtime::AnyDevice;
/// #     const NAME: &'static str = "fast";
/// #     const MESSAGE: &'static Message = MESSAGE;
/// #     const PROFILE: &'static Profile = &PROFILE;
/// #     type Slots = [Slot; 1];
/// #     const EMPTY: Self::Slots = [Slot::EMPTY];
/// # }
/// # impl Telegram for Slow {
/// #     type Device = fieldscribe_runtime::AnyDevice;
/// #     const NAME: &'static str = "slow";
/// #     const MESSAGE: &'static Message = MESSAGE;
/// #     const PROFILE: &'static Profile = &PROFILE;
/// #     type Slots = [Slot; 1];
/// #     const EMPTY: Self::Slots = [Slot::EMPTY];
/// # }
///
/// impl Hears<Fast> for Both<Fast, Slow> {
///     fn receiver(&self) -> &Receiver<Fast> {
///         &self.0
///     }
/// }
///
/// impl Hears<Slow> for Both<Fast, Slow> {
///     fn receiver(&self) -> &Receiver<Slow> {
///         &self.1
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "nothing listens to the telegram `{T}`",
    label = "this client waits for none of its points",
    note = "give the client a receiver first: `client.listening(Receiver::<{T}>::new(unit))`",
    note = "a pair of receivers is asked by its parts after `client.listen()`: `client.listener().0.value::<P>()`"
)]
pub trait Hears<T: Telegram>: Listener {
    /// The receiver of the telegram.
    fn receiver(&self) -> &Receiver<T>;
}

impl<T: Telegram> Hears<T> for Receiver<T> {
    fn receiver(&self) -> &Self {
        self
    }
}

impl<T: Telegram, L: Hears<T> + ?Sized> Hears<T> for &mut L {
    fn receiver(&self) -> &Receiver<T> {
        (**self).receiver()
    }
}

impl<A: Listener, B: Listener> Listener for (A, B) {
    fn hear(&mut self, frame: &Frame) {
        self.0.hear(frame);
        self.1.hear(frame);
    }
}

impl<L: Listener + ?Sized> Listener for &mut L {
    fn hear(&mut self, frame: &Frame) {
        (**self).hear(frame);
    }
}

/// The error for a failure of the bus; the caller adds the point.
const fn lost<E>(error: E) -> ClientError<E> {
    ClientError::Transport(error, None)
}

/// The default number of other frames that a client lets pass while it waits.
const PATIENCE: u32 = 10_000;

/// One unit of a bus.
#[derive(Debug)]
struct Unit {
    profile: &'static Profile,
    number: u8,
    patience: u32,
}

impl Unit {
    const fn new(profile: &'static Profile, number: u8) -> Self {
        Self {
            profile,
            number,
            patience: PATIENCE,
        }
    }

    /// The messages of a dialogue and the frame of the request.
    fn ask(
        &self,
        dialogue: Option<Dialogue>,
        address: u16,
        raw: u16,
    ) -> Result<(Dialogue, Frame), BuildError> {
        let dialogue = dialogue.ok_or(BuildError::NoMessage)?;
        let message = dialogue.request;
        let frame = message.build(self.profile, self.number, address, raw)?;
        Ok((dialogue, frame))
    }

    /// Logs a frame on the bus.
    fn trace(&self, way: Way, frame: &Frame) {
        trace::frame(self.number, way, Some(frame.id()), frame.bytes());
    }

    /// The raw number in a frame, if it answers for this address.
    fn answer(&self, answer: &Message, address: u16, frame: &Frame) -> Option<u16> {
        let content = answer.parse(self.number, frame).ok()?;
        let fits = content.address == address || !answer.carries_address();
        fits.then_some(content.raw)
    }

    /// Compares the answer to a write with what was written, if the answer has a number.
    fn confirm(&self, written: u16, answered: u16) -> Result<(), ReplyError> {
        let answer = self.profile.write.and_then(|dialogue| dialogue.answer);
        if answered == written || !answer.is_some_and(Message::carries_raw) {
            return Ok(());
        }
        let (written, answered) = (written.into(), Some(answered.into()));
        Err(ReplyError::OtherNumber { written, answered })
    }
}

/// The client, for each way to wait for the transport.
macro_rules! client {
    ($client:ident, $transport:ident, $about:literal, [$($async:ident)?], [$($wait:tt)*]) => {
        #[doc = $about]
        ///
        /// A [`Listener`] takes all frames that are no answer to the request.
        #[derive(Debug)]
        pub struct $client<T, L = (), D = AnyDevice> {
            transport: T,
            listener: L,
            unit: Unit,
            device: PhantomData<D>,
        }

        impl<T: $transport, D: Device<Profile = Profile>> $client<T, (), D> {
            /// A unit of a bus.
            pub const fn new(transport: T, unit: u8) -> Self {
                Self { transport, listener: (), unit: Unit::new(D::PROFILE, unit), device: PhantomData }
            }
        }

        impl<T: $transport> $client<T> {
            /// A unit with a device that is chosen at run time; its client takes every point.
            pub const fn for_profile(transport: T, profile: &'static Profile, unit: u8) -> Self {
                Self { transport, listener: (), unit: Unit::new(profile, unit), device: PhantomData }
            }
        }

        impl<T, L, D> $client<T, L, D> {
            /// The same client with another listener, such as a [`Receiver`] of a telegram.
            pub fn listening<M: Listener>(self, listener: M) -> $client<T, M, D> {
                $client { transport: self.transport, listener, unit: self.unit, device: PhantomData }
            }

            /// The same client with another number of frames that may pass while it waits; the default is ten thousand.
            #[must_use]
            pub fn patient(self, frames: u32) -> Self {
                Self { unit: Unit { patience: frames, ..self.unit }, ..self }
            }

            /// The listener, with what it has received: `client.listener().raw::<P>()` of a [`Receiver`].
            pub const fn listener(&self) -> &L {
                &self.listener
            }

            /// The transport, for example to change its settings.
            pub fn transport(&mut self) -> &mut T {
                &mut self.transport
            }

            /// Returns the transport.
            pub fn into_transport(self) -> T {
                self.transport
            }
        }

        impl<T: $transport, L: Listener, D> $client<T, L, D> {
            /// Sends a request and returns the raw number of the answer.
            $($async)? fn exchange(
                &mut self,
                dialogue: Option<Dialogue>,
                address: u16,
                raw: u16,
            ) -> Result<u16, ClientError<T::Error>> {
                let (dialogue, asked) = self.unit.ask(dialogue, address, raw)?;
                self.drain()$($wait)*?;
                self.transport.send(&asked)$($wait)*.map_err(lost)?;
                self.unit.trace(Way::Sent, &asked);
                let Some(answer) = dialogue.answer else {
                    return Ok(raw);
                };
                for _ in 0..self.unit.patience {
                    let frame = self.transport.receive()$($wait)*.map_err(lost)?;
                    self.unit.trace(Way::Came, &frame);
                    if let Some(raw) = self.unit.answer(answer, address, &frame) {
                        return Ok(raw);
                    }
                    self.listener.hear(&frame);
                }
                Err(ReplyError::NoAnswer.into())
            }

            /// Passes frames that have already arrived to the listener: they answer no later request.
            $($async)? fn drain(&mut self) -> Result<(), ClientError<T::Error>> {
                for _ in 0..self.unit.patience {
                    let frame = self.transport.pending()$($wait)*.map_err(lost)?;
                    let Some(frame) = frame else {
                        break;
                    };
                    self.unit.trace(Way::Came, &frame);
                    self.listener.hear(&frame);
                }
                Ok(())
            }

            /// The word at an address.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn read_word(&mut self, address: u16) -> Result<u16, ClientError<T::Error>> {
                self.exchange(self.unit.profile.read, address, 0)$($wait)*
            }

            /// Writes a word to an address.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn write_word(
                &mut self,
                address: u16,
                word: u16,
            ) -> Result<(), ClientError<T::Error>> {
                let answered = self.exchange(self.unit.profile.write, address, word)$($wait)*?;
                self.unit.confirm(word, answered)?;
                Ok(())
            }

            /// Reads a parameter's raw number into `raw`, word by word if it has several.
            $($async)? fn get_raw<P>(&mut self, raw: &mut P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Readable + Parameter,
            {
                let mut words = P::Raw::MIN.into_words();
                for (place, address) in words.as_mut().iter_mut().zip(ascending(P::ADDRESSES)) {
                    *place = self.read_word(address)$($wait)*.map_err(ClientError::of::<P>)?;
                }
                *raw = P::from_words(words);
                Ok(())
            }

            read_methods! {
                [$($async)?], [$($wait)*], "A parameter", get_raw for Parameter;
                read read_with read_count read_count_with read_raw
            }

            write_methods! {
                [$($async)?], [$($wait)*],
                "Writes a value to a parameter, word by word: when one fails, those before it are written.",
                put for Parameter, ClientError<T::Error>;
                write write_with write_count write_count_with write_raw write_raw_with
            }

            /// Writes a checked raw number, word by word.
            $($async)? fn put<P: Whole + Parameter>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>> {
                let words = P::to_words(raw);
                for (word, address) in words.as_ref().iter().zip(ascending(P::ADDRESSES)) {
                    self.write_word(address, *word)$($wait)*.map_err(ClientError::of::<P>)?;
                }
                Ok(())
            }

            bits_methods! {
                [$($async)?], [$($wait)*],
                "Writes a value to a group of bits: reads the word, replaces the bits, writes the word back.",
                put_bits for Readable | Parameter, ClientError<T::Error>;
                update update_with
            }

            /// Writes a checked raw number to a group of bits.
            $($async)? fn put_bits<P>(&mut self, raw: P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: BitGroup + Parameter,
            {
                let word = self.read_word(P::ADDRESS)$($wait)*.map_err(ClientError::of::<P>)?;
                let written = self.write_word(P::ADDRESS, P::insert(word, raw))$($wait)*;
                written.map_err(ClientError::of::<P>)
            }

            data_methods! { [$($async)?], [$($wait)*], words_of put_data }

            /// The words of a parameter as data.
            $($async)? fn words_of<const N: usize>(
                &mut self,
                point: &PointFacts,
            ) -> Result<[u16; N], ClientError<T::Error>> {
                point.outside_telegrams()?;
                let mut words = [0; N];
                for (place, address) in words.iter_mut().zip(ascending(point.addresses)) {
                    *place = self.read_word(address)$($wait)*?;
                }
                Ok(in_reading_order(words, point.addresses))
            }

            /// Writes a checked raw number to a parameter as data, word by word.
            $($async)? fn put_data(&mut self, point: &PointFacts, raw: i128) -> Result<(), ClientError<T::Error>> {
                point.outside_telegrams()?;
                let mut word = 0;
                if point.mask.is_some() {
                    word = self.read_word(point.address)$($wait)*?;
                }
                let words = in_address_order(point.words_of(raw, word)?, point.addresses);
                for (word, address) in words.iter().zip(ascending(point.addresses)) {
                    self.write_word(address, *word)$($wait)*?;
                }
                Ok(())
            }

            /// Waits for a frame, and passes it to the listener.
            ///
            /// # Errors
            /// Any [`ClientError`].
            pub $($async)? fn listen(&mut self) -> Result<(), ClientError<T::Error>> {
                let frame = self.transport.receive()$($wait)*.map_err(lost)?;
                self.unit.trace(Way::Came, &frame);
                self.listener.hear(&frame);
                Ok(())
            }

            read_methods! {
                [$($async)?], [$($wait)*],
                "A point of a telegram when all its words came again and belong together",
                get_received for Received, [L: Hears<P::Telegram>];
                receive receive_with receive_count receive_count_with receive_raw
            }

            /// Reads the raw number of a point of a telegram into `raw`.
            $($async)? fn get_received<P>(&mut self, raw: &mut P::Raw) -> Result<(), ClientError<T::Error>>
            where
                P: Received,
                L: Hears<P::Telegram>,
            {
                let taken = self.listener.receiver().taken();
                let mut found = Err(Error::NotReceived(Some(P::NAME)));
                for _ in 0..self.unit.patience {
                    self.listen()$($wait)*.map_err(ClientError::of::<P>)?;
                    let receiver = self.listener.receiver();
                    if receiver.came_since::<P>(taken) {
                        found = receiver.raw::<P>();
                    }
                    if found.is_ok() {
                        break;
                    }
                }
                *raw = found?;
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
