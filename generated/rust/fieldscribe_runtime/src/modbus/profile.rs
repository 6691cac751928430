// SPDX-License-Identifier: 0BSD
//! What the frames need to know of a device, as constants of the generated code.

use core::marker::PhantomData;

use super::function::{longest_count, read_function, writes};
use super::Framing;
use crate::{Accepts, AnyDevice, PointInfo, Readable, ReplyError, Space};

/// A function that a device knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Function {
    /// The number in the frame.
    pub number: u8,
    /// The largest count of items in one request: what the device takes and a frame holds.
    pub most: u16,
    /// Whether it may be sent to all units at once.
    pub broadcast: bool,
}

impl Function {
    /// A function and the largest count of items in one request; it may be broadcast if it writes.
    #[must_use]
    pub const fn new(number: u8, most: u16) -> Self {
        let longest = longest_count(number);
        Self {
            number,
            most: if most < longest { most } else { longest },
            broadcast: writes(number),
        }
    }

    /// The same function where the device does not take it as a broadcast.
    #[must_use]
    pub const fn without_broadcast(self) -> Self {
        Self {
            broadcast: false,
            ..self
        }
    }
}

/// What the frames need to know of a device.
#[derive(Clone, Copy, Debug)]
pub struct Profile {
    functions: &'static [Function],
    /// Whether it speaks RTU, and TCP.
    framings: [bool; 2],
    pub(super) units: (u8, u8),
    broadcast: Option<u8>,
    pub(super) pad_coil_bytes_even: bool,
    name: fn(u8) -> Option<&'static str>,
}

impl Profile {
    /// The functions, the framings, the least and the greatest unit, the unit that means all.
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

    /// The same device behind a gateway that speaks these framings to us.
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

    /// The same device, whose exception codes have names.
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

    /// The same device, of which 0Fh pads its bytes to an even count.
    #[must_use]
    pub const fn padding_coils(self) -> Self {
        Self {
            pad_coil_bytes_even: true,
            ..self
        }
    }

    /// Whether the device speaks the framing.
    #[must_use]
    pub fn speaks(&self, framing: Framing) -> bool {
        let [rtu, tcp] = self.framings;
        match framing {
            Framing::Rtu => rtu,
            Framing::Tcp => tcp,
        }
    }

    /// Whether the device knows the function.
    #[must_use]
    pub fn knows(&self, function: u8) -> bool {
        self.find(function).is_some()
    }

    /// Whether a frame to this unit goes to all units, so that none answers.
    #[must_use]
    pub fn is_broadcast(&self, unit: u8) -> bool {
        self.broadcast == Some(unit)
    }

    pub(super) fn find(&self, function: u8) -> Option<&Function> {
        let mut known = self.functions.iter();
        known.find(|one| one.number == function && one.most > 0)
    }
}

/// Whether RTU is among the framings, and whether TCP is.
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

/// A read of consecutive addresses that keeps to the device's limits and holes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block<D = AnyDevice> {
    /// Where the addresses count.
    pub space: Space,
    /// The function that reads them.
    pub function: u8,
    /// The first address.
    pub address: u16,
    /// How many items.
    pub count: u16,
    /// What the address counts from, by its name; empty for 0.
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

    /// The same block, whose address counts from the base of that name.
    #[must_use]
    pub const fn counted_from(self, base: &'static str) -> Self {
        Self { base, ..self }
    }

    /// The words, or the bits, of a point that is known at run time only.
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

    /// Whether the block brings the point.
    #[must_use]
    pub fn brings<P: Readable>(&self) -> bool
    where
        D: Accepts<P::Device>,
    {
        self.covers(P::SPACE, P::BASE, P::ADDRESS, P::SPAN)
    }

    /// Whether the block brings the point as data.
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

/// A named constant write. The value is none where any does.
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
