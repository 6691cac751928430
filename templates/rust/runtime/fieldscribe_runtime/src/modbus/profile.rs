// SPDX-License-Identifier: 0BSD
//! The facts of a device that frames need, as constants in the generated code.

use core::marker::PhantomData;

use super::function::{longest_count, read_function, writes};
use super::Framing;
use crate::{Accepts, AnyDevice, PointInfo, Readable, ReplyError, Space};

/// A function that a device supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Function {
    /// The number in the frame.
    pub number: u8,
    /// The most items in one request: the limit of the device and of a frame.
    pub most: u16,
    /// True if it may be broadcast.
    pub broadcast: bool,
}

impl Function {
    /// A function with the most items in one request; it may be broadcast if it writes.
    #[must_use]
    pub const fn new(number: u8, most: u16) -> Self {
        let longest = longest_count(number);
        Self {
            number,
            most: if most < longest { most } else { longest },
            broadcast: writes(number),
        }
    }

    /// The same function, which the device does not take as a broadcast.
    #[must_use]
    pub const fn without_broadcast(self) -> Self {
        Self {
            broadcast: false,
            ..self
        }
    }
}

/// The facts of a device that frames need.
#[derive(Clone, Copy, Debug)]
pub struct Profile {
    functions: &'static [Function],
    /// Support of RTU and of TCP.
    framings: [bool; 2],
    pub(super) units: (u8, u8),
    broadcast: Option<u8>,
    pub(super) pad_coil_bytes_even: bool,
    name: fn(u8) -> Option<&'static str>,
}

impl Profile {
    /// The functions, the framings, the least and the greatest unit, the broadcast unit.
    #[must_use]
    pub const fn new(
        functions: &'static [Function],
        framings: &'static [Framing],
        units: (u8, u8),
        broadcast: Option<u8>,
    ) -> Self {
        Self {
            functions,
            framings: spoken(framings),
            units,
            broadcast,
            pad_coil_bytes_even: false,
            name: |_| None,
        }
    }

    /// The same device after a gateway with these framings.
    ///
    /// ```
    /// use fieldscribe_runtime::modbus::{Framing, Function, Profile};
    ///
    /// // The device's own profile, which its crate has: it speaks RTU.
    /// static PROFILE: Profile = Profile::new(&[Function::new(3, 4)], &[Framing::Rtu], (1, 32), Some(0));
    /// static BEHIND_GATEWAY: Profile = PROFILE.with_framings(&[Framing::Tcp]);
    /// assert!(BEHIND_GATEWAY.speaks(Framing::Tcp));
    /// ```
    #[must_use]
    pub const fn with_framings(self, framings: &'static [Framing]) -> Self {
        Self {
            framings: spoken(framings),
            ..self
        }
    }

    /// The same device, with names of its exception codes.
    #[must_use]
    pub const fn naming(self, name: fn(u8) -> Option<&'static str>) -> Self {
        Self { name, ..self }
    }

    /// The same error, with the name that the device has for an exception code.
    #[must_use]
    pub fn named(&self, mut error: ReplyError) -> ReplyError {
        if let ReplyError::Exception { code, name } = &mut error {
            *name = (self.name)(*code);
        }
        error
    }

    /// The same device, which needs 0Fh to have an even number of data bytes.
    #[must_use]
    pub const fn padding_coils(self) -> Self {
        Self {
            pad_coil_bytes_even: true,
            ..self
        }
    }

    /// True if the device supports the framing.
    #[must_use]
    pub fn speaks(&self, framing: Framing) -> bool {
        let [rtu, tcp] = self.framings;
        match framing {
            Framing::Rtu => rtu,
            Framing::Tcp => tcp,
        }
    }

    /// True if the device supports the function.
    #[must_use]
    pub fn knows(&self, function: u8) -> bool {
        self.find(function).is_some()
    }

    /// True if this is the broadcast unit, so that nobody answers.
    #[must_use]
    pub fn is_broadcast(&self, unit: u8) -> bool {
        self.broadcast == Some(unit)
    }

    pub(super) fn find(&self, function: u8) -> Option<&Function> {
        let mut known = self.functions.iter();
        known.find(|one| one.number == function && one.most > 0)
    }
}

/// Whether the framings include RTU, and TCP.
const fn spoken(mut framings: &[Framing]) -> [bool; 2] {
    let [mut rtu, mut tcp] = [false; 2];
    while let [framing, others @ ..] = framings {
        match framing {
            Framing::Rtu => rtu = true,
            Framing::Tcp => tcp = true,
        }
        framings = others;
    }
    [rtu, tcp]
}

/// A read of consecutive addresses within the limits of the device, and without gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block<D = AnyDevice> {
    /// The space of the addresses.
    pub space: Space,
    /// The function that reads them.
    pub function: u8,
    /// The first address.
    pub address: u16,
    /// The number of items.
    pub count: u16,
    /// The name of the base that the address counts from; empty for 0.
    pub base: &'static str,
    device: PhantomData<D>,
}

impl<D> Block<D> {
    /// `count` items from `address`.
    #[must_use]
    pub const fn new(space: Space, function: u8, address: u16, count: u16) -> Self {
        Self {
            space,
            function,
            address,
            count,
            base: "",
            device: PhantomData,
        }
    }

    /// The same block, with an address that counts from a base.
    #[must_use]
    pub const fn counted_from(self, base: &'static str) -> Self {
        Self { base, ..self }
    }

    /// The words, or the bits, of a point that is chosen at run time.
    ///
    /// ```
    /// use fieldscribe_runtime::modbus::Block;
    /// use fieldscribe_runtime::{point, Point, Space};
    ///
    /// point! {
    ///     /// Jump frequency.
    ///     JumpFrequency: u16 = "jump_frequency";
    ///     at Holding 0x1028;
    ///     => value f64 as scaled(10, 1);
    ///     read {}
    /// }
    ///
    /// let block: Block = Block::of(JumpFrequency::INFO);
    /// assert_eq!(block, Block::new(Space::Holding, 3, 0x1028, 1));
    /// ```
    #[must_use]
    pub const fn of(point: PointInfo<D>) -> Self {
        let facts = point.facts;
        let function = read_function(facts.space);
        Self::new(facts.space, function, facts.address, facts.span()).counted_from(facts.base)
    }

    /// True if the block has all of the point.
    #[must_use]
    pub fn brings<P: Readable>(&self) -> bool
    where
        D: Accepts<P::Device>,
    {
        self.covers(P::SPACE, P::BASE, P::ADDRESS, P::SPAN)
    }

    /// True if the block has all of a point as data.
    #[must_use]
    pub fn brings_point<P>(&self, point: PointInfo<P>) -> bool
    where
        D: Accepts<P>,
    {
        let facts = point.facts;
        facts.access.reads() && self.covers(facts.space, facts.base, facts.address, facts.span())
    }

    fn covers(&self, space: Space, base: &str, address: u16, words: u16) -> bool {
        let offset = address.checked_sub(self.address);
        let end = offset.and_then(|offset| offset.checked_add(words));
        self.space == space && self.base == base && end.is_some_and(|end| end <= self.count)
    }
}

/// A named constant write. The value is [`None`] if the device takes any.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Command<D = AnyDevice> {
    /// The function that writes it.
    pub function: u8,
    /// The address that takes it.
    pub address: u16,
    /// What to write.
    pub value: Option<u16>,
    device: PhantomData<D>,
}

impl<D> Command<D> {
    /// A write of `value`, or of anything, to `address`.
    #[must_use]
    pub const fn new(function: u8, address: u16, value: Option<u16>) -> Self {
        Self {
            function,
            address,
            value,
            device: PhantomData,
        }
    }
}
