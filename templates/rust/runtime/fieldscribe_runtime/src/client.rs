// SPDX-License-Identifier: 0BSD
//! Transports of families that ask and answer; the caller provides them. Nothing here does I/O itself;
//! [`crate::transports`] has transports that do.
//!
//! The clients are in [`crate::modbus`], [`crate::uss`] and [`crate::can`].

use core::future::Future;

/// Sends a request and waits for its reply.
///
/// ```
/// use fieldscribe_runtime::modbus::{Client, Framing, Function, Profile};
/// use fieldscribe_runtime::{point, Device, Transport};
///
/// /// A line with a fixed answer.
/// struct Canned(&'static [u8]);
///
/// impl Transport for Canned {
///     type Error = std::io::Error;
///
///     fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
///         assert_eq!(request, b"\x01\x03\x10\x28\x00\x01\x00\xC2");
///         reply[..self.0.len()].copy_from_slice(self.0);
///         Ok(self.0.len())
///     }
/// }
///
/// #[derive(Debug)]
/// pub struct Drive;
///
/// impl Device for Drive {
///     type Profile = Profile;
///     const NAME: &'static str = "drive";
///     const PROFILE: &'static Profile = &Profile::new(&[Function::new(3, 4)], &[Framing::Rtu], (1, 32), Some(0));
/// }
///
/// point! {
///     /// Jump frequency.
///     JumpFrequency of Drive: u16 = "jump_frequency";
///     at Holding 0x1028;
///     unit "Hz";
///     decimals 1;
///     => value f64 as scaled(10, 1);
///     read { count i32; }
/// }
///
/// type DriveClient<T> = Client<T, Drive>;
/// let mut client = DriveClient::new(Canned(b"\x01\x03\x02\x01\xF4\xB8\x53"), Framing::Rtu, 1);
/// assert_eq!(client.read::<JumpFrequency>().unwrap(), 50.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no transport for a `Client`",
    note = "a transport that does not block goes with `AsyncClient` or `LocalClient`"
)]
pub trait Transport {
    /// What can go wrong on the line.
    type Error;

    /// Sends `request`, puts the reply into `reply` and returns its length in bytes.
    ///
    /// [`reply_length`](crate::modbus::reply_length) tells from its first bytes when a Modbus reply is complete.
    ///
    /// Discard bytes that arrived before the request: a late answer to an earlier request that was given up could be
    /// taken for the answer to this one, as nothing in it tells them apart.
    ///
    /// An empty `reply` means that there is no answer: the request is a broadcast.
    ///
    /// # Errors
    /// Any failure of the line, also if nothing arrives in time.
    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error>;
}

/// Sends a request and waits for its reply without blocking.
///
/// Its futures are [`Send`], and so are those of the clients over it: multi-threaded executors accept them.
///
/// ```
/// use fieldscribe_runtime::modbus::AsyncClient;
/// use fieldscribe_runtime::{AsyncTransport, Readable};
///
/// fn spawn(task: impl Future + Send) {}
/// # use std::future::Future;
///
/// fn poll<T: AsyncTransport, P: Readable<Factors = ()>>(mut client: AsyncClient<T>) {
///     spawn(async move { client.read::<P>().await });
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no transport for an `AsyncClient`",
    note = "a transport that blocks goes with `Client`, one of a single thread with `LocalClient`"
)]
pub trait AsyncTransport: Send {
    /// What can go wrong on the line.
    type Error: Send;

    /// As [`Transport::exchange`].
    ///
    /// Dropping the future gives up the request.
    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>> + Send;
}

/// Sends a request and waits for its reply without blocking, on one thread: its futures need not be [`Send`].
///
/// It is [`AsyncTransport`] for executors that keep their tasks on one thread, and for transports that hold what cannot
/// leave it. Each family has a `LocalClient` over it.
///
/// ```
/// use std::{cell::RefCell, io::Error, rc::Rc};
///
/// use fieldscribe_runtime::LocalTransport;
///
/// struct Shared(Rc<RefCell<Vec<u8>>>);
///
/// impl LocalTransport for Shared {
///     type Error = Error;
///
///     async fn exchange(&mut self, request: &[u8], _reply: &mut [u8]) -> Result<usize, Error> {
///         self.0.borrow_mut().extend(request);
///         Ok(0)
///     }
/// }
/// ```
pub trait LocalTransport {
    /// What can go wrong on the line.
    type Error;

    /// As [`AsyncTransport::exchange`].
    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>>;
}

/// Methods that read points: raw numbers, values and counts, with and without other points. They use a method that
/// stores the raw number in place.
///
/// They take points of the trait `$reach`, which implies the other bounds. A raw number in place needs less code than
/// one in a `Result`, whose error would be copied once more.
macro_rules! read_methods {
    (
        [$($async:ident)?], [$($wait:tt)*], $about:literal, $get:ident for $reach:path $(, [$($condition:tt)+])?;
        $value:ident $value_with:ident $count:ident $count_with:ident $raw:ident
    ) => {
        #[doc = concat!($about, ", as its raw number.")]
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn $raw<P>(&mut self) -> Result<P::Raw, ClientError<T::Error>>
        where
            P: Readable + $reach,
            D: Accepts<P::Device>,
            $($($condition)+)?
        {
            let mut raw = P::Raw::MIN;
            self.$get::<P>(&mut raw)$($wait)*?;
            Ok(raw)
        }

        #[doc = concat!($about, ", as its value.")]
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn $value<P>(&mut self) -> Result<P::Value, ClientError<T::Error>>
        where
            P: Readable<Factors: NeedsNothing> + $reach,
            D: Accepts<P::Device>,
            $($($condition)+)?
        {
            self.$value_with::<P>(NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($value), "`, by the raw numbers that the point's scale needs.")]
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn $value_with<P>(
            &mut self,
            with: P::Factors,
        ) -> Result<P::Value, ClientError<T::Error>>
        where
            P: Readable + $reach,
            D: Accepts<P::Device>,
            $($($condition)+)?
        {
            let mut raw = P::Raw::MIN;
            self.$get::<P>(&mut raw)$($wait)*?;
            Ok(P::decode_with(raw, with).into_result()?)
        }

        #[doc = concat!($about, ", as a count: its value in units of `10^-DECIMALS`, without floating point.")]
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn $count<P>(&mut self) -> Result<P::Count, ClientError<T::Error>>
        where
            P: CountReadable<Factors: NeedsNothing> + $reach,
            D: Accepts<P::Device>,
            $($($condition)+)?
        {
            self.$count_with::<P>(NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($count), "`, by the raw numbers that the point's scale needs.")]
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn $count_with<P>(
            &mut self,
            with: P::Factors,
        ) -> Result<P::Count, ClientError<T::Error>>
        where
            P: CountReadable + $reach,
            D: Accepts<P::Device>,
            $($($condition)+)?
        {
            let mut raw = P::Raw::MIN;
            self.$get::<P>(&mut raw)$($wait)*?;
            Ok(P::decode_count_with(raw, with).into_result()?)
        }
    };
}

/// Methods that write points (values, counts and raw numbers) by a method that takes checked raw numbers.
macro_rules! write_methods {
    (
        [$($async:ident)?], [$($wait:tt)*], $about:literal, $put:ident for $reach:path, $error:ty;
        $value:ident $value_with:ident $count:ident $count_with:ident $raw:ident $raw_with:ident
    ) => {
        #[doc = $about]
        ///
        /// # Errors
        /// What encoding says, and what the bus does.
        pub $($async)? fn $value<P>(&mut self, value: P::Value) -> Result<(), $error>
        where
            P: EncodableAlone + Whole + $reach,
            D: Accepts<P::Device>,
        {
            self.$value_with::<P>(value, NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($value), "`, by the raw numbers that the point's scale and limits need.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $value_with<P>(&mut self, value: P::Value, with: P::With) -> Result<(), $error>
        where
            P: Encodable + Whole + $reach,
            D: Accepts<P::Device>,
        {
            self.$put::<P>(P::encode_with(value, with)?)$($wait)*
        }

        #[doc = concat!("As `", stringify!($value), "`, from a count: the value in units of `10^-DECIMALS`.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $count<P>(&mut self, count: P::Count) -> Result<(), $error>
        where
            P: CountWritable<With: NeedsNothing> + Whole + $reach,
            D: Accepts<P::Device>,
        {
            self.$count_with::<P>(count, NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($count), "`, by the raw numbers that the point's scale and limits need.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $count_with<P>(&mut self, count: P::Count, with: P::With) -> Result<(), $error>
        where
            P: CountWritable + Whole + $reach,
            D: Accepts<P::Device>,
        {
            self.$put::<P>(P::encode_count_with(count, with)?)$($wait)*
        }

        #[doc = concat!("As `", stringify!($value), "`, from a raw number, if it may be written.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $raw<P>(&mut self, raw: P::Raw) -> Result<(), $error>
        where
            P: Writable<With: NeedsNothing> + Whole + $reach,
            D: Accepts<P::Device>,
        {
            self.$raw_with::<P>(raw, NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($raw), "`, by the raw numbers that the point's limits need.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $raw_with<P>(&mut self, raw: P::Raw, with: P::With) -> Result<(), $error>
        where
            P: Writable + Whole + $reach,
            D: Accepts<P::Device>,
        {
            P::check_with(raw, with)?;
            self.$put::<P>(raw)$($wait)*
        }
    };
}

/// Methods that write values to groups of bits by a method that takes checked raw numbers.
macro_rules! bits_methods {
    (
        [$($async:ident)?], [$($wait:tt)*], $about:literal, $put:ident for $($reach:path)|+, $error:ty;
        $value:ident $value_with:ident
    ) => {
        #[doc = $about]
        ///
        /// # Errors
        /// What encoding says, and what the bus does.
        pub $($async)? fn $value<P>(&mut self, value: P::Value) -> Result<(), $error>
        where
            P: EncodableAlone + BitGroup $(+ $reach)+,
            D: Accepts<P::Device>,
        {
            self.$value_with::<P>(value, NeedsNothing::nothing())$($wait)*
        }

        #[doc = concat!("As `", stringify!($value), "`, by the raw numbers that the point's scale and limits need.")]
        ///
        /// # Errors
        /// The same.
        pub $($async)? fn $value_with<P>(&mut self, value: P::Value, with: P::With) -> Result<(), $error>
        where
            P: Encodable + BitGroup $(+ $reach)+,
            D: Accepts<P::Device>,
        {
            self.$put::<P>(P::encode_with(value, with)?)$($wait)*
        }
    };
}

/// Methods that access points as data by `$get`, which returns the words of a point in reading order, and `$put`.
macro_rules! data_methods {
    ([$($async:ident)?], [$($wait:tt)*], $get:ident $put:ident) => {
        /// The value of a point as data; reads other points that its scale needs first.
        ///
        /// # Errors
        /// Any [`ClientError`].
        pub $($async)? fn read_point<P>(
            &mut self,
            point: PointInfo<P>,
        ) -> Result<AnyValue<'static>, ClientError<T::Error>>
        where
            D: Accepts<P>,
        {
            let (raws, count) = self.raws_of(point.needs().any())$($wait)*?;
            let raw = self.raw_of(point.facts)$($wait)*?;
            Ok(point.decode(raw, raws.get(..count).unwrap_or(&raws))?)
        }

        /// Writes a value to a point as data; reads other points that its scale and limits need, and the word that it
        /// shares with others, first.
        ///
        /// # Errors
        /// [`NotTogether`](crate::Error::NotTogether) if the device takes the point only with others; what encoding
        /// says, and what the bus does.
        pub $($async)? fn write_point<'v, P>(
            &mut self,
            point: PointInfo<P>,
            value: impl Into<AnyValue<'v>>,
        ) -> Result<(), ClientError<T::Error>>
        where
            D: Accepts<P>,
        {
            point.written_alone()?;
            let value = value.into();
            let (raws, count) = self.raws_of(point.write_needs().any())$($wait)*?;
            let raw = point.encode(value, raws.get(..count).unwrap_or(&raws))?;
            let written = self.$put(point.facts, raw)$($wait)*;
            written.map_err(|error| error.named(point.name))
        }

        /// The raw numbers of points, and their number.
        $($async)? fn raws_of(&mut self, points: Points) -> Result<([i128; MOST_NEEDS], usize), ClientError<T::Error>> {
            let mut raws = [0; MOST_NEEDS];
            for (place, point) in raws.iter_mut().zip(points.iter()) {
                *place = self.raw_of(point.facts)$($wait)*?;
            }
            Ok((raws, points.len()))
        }

        /// The raw number of a point.
        $($async)? fn raw_of(&mut self, point: &PointFacts) -> Result<i128, ClientError<T::Error>> {
            point.readable()?;
            let words = self.$get(point)$($wait)*;
            Ok(point.raw_of(words.map_err(|error| error.named(point.name))?))
        }

        /// Reads the points that identify the device, then its variants: `IDENTIFICATIONS` of its crate.
        ///
        /// # Errors
        /// Any [`ClientError`]; another device is an error of the inner result: `identify(rows)??`.
        pub $($async)? fn identify<P>(
            &mut self,
            rows: &[Identification<P>],
        ) -> Result<Result<Variants, OtherDevice>, ClientError<T::Error>>
        where
            D: Accepts<P>,
        {
            let (mut found, mut words, mut read) = (Variants::default(), NOTHING_HELD, None);
            let mut left = rows;
            while let Some(first) = left.first() {
                let (mut rows, others) = divided(left, |row| row.variant == first.variant);
                left = others;
                if first.variant.is_some_and(|(axis, _)| found.value(axis).is_some()) {
                    continue;
                }
                let mut misfit = None;
                while let (Some(row), None) = (rows.first(), misfit) {
                    let point = row.point.facts;
                    let (alternatives, others) = divided(rows, |row| row.point.facts == point);
                    rows = others;
                    if read != Some(point) {
                        read = match self.$get(point)$($wait)* {
                            Ok(held) => {
                                words = held;
                                Some(point)
                            }
                            Err(ClientError::Reply(ReplyError::Exception { .. }, _)) => None,
                            Err(error) => return Err(error.named(point.name)),
                        };
                    }
                    if read.is_none() || !holds(alternatives, &words)? {
                        misfit = Some(point.name);
                    }
                }
                match (first.variant, misfit) {
                    (None, Some(point)) => return Ok(Err(OtherDevice(point))),
                    (Some(variant), None) => found.add(variant)?,
                    _ => {}
                }
            }
            Ok(Ok(found))
        }
    };
}

pub(crate) use {bits_methods, data_methods, read_methods, write_methods};

/// The most points that are read before a point that needs them.
pub(crate) const MOST_NEEDS: usize = 8;

/// Clients can share one bus: each borrows it while it lives.
impl<T: Transport + ?Sized> Transport for &mut T {
    type Error = T::Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        (**self).exchange(request, reply)
    }
}

/// Clients on one line, also in several threads, take turns. Needs the feature `std`.
#[cfg(feature = "std")]
impl<T: Transport> Transport for &std::sync::Mutex<T> {
    type Error = T::Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        let line = self.lock();
        // A panic leaves no half-done exchange for the next client.
        let mut line = line.unwrap_or_else(std::sync::PoisonError::into_inner);
        line.exchange(request, reply)
    }
}

/// As for [`Transport`].
impl<T: AsyncTransport + ?Sized> AsyncTransport for &mut T {
    type Error = T::Error;

    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>> + Send {
        (**self).exchange(request, reply)
    }
}

/// As for [`Transport`].
impl<T: LocalTransport + ?Sized> LocalTransport for &mut T {
    type Error = T::Error;

    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>> {
        (**self).exchange(request, reply)
    }
}
