// SPDX-License-Identifier: 0BSD
//! Messages: layouts of eight bytes, as constants of the generated code.

use super::{Frame, ParseError, LENGTH};
use crate::BuildError;

/// The content of one byte of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Always this byte.
    Constant(u8),
    /// Bits of the unit number from this one on.
    Unit(u8),
    /// Bits of the address from this one on.
    Address(u8),
    /// Bits of the raw number from this one on.
    Raw(u8),
    /// Which part of a telegram the frame carries.
    Multiplexer,
    /// A byte of the frame's words: twice the word's index, plus 1 for its low byte.
    Word(u8),
    /// The bytes of this mask combined by exclusive or.
    Xor(u8),
}

/// A layout of eight bytes with an identifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message {
    name: &'static str,
    id: u32,
    adds_unit: bool,
    roles: [Role; LENGTH],
}

/// The content of a message; 0 for what it does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Content {
    /// The address.
    pub address: u16,
    /// The raw number.
    pub raw: u16,
}

impl Message {
    /// A message with its name, its identifier, whether the unit number is added to that, and its bytes.
    #[must_use]
    pub const fn new(name: &'static str, id: u32, adds_unit: bool, roles: [Role; LENGTH]) -> Self {
        Self {
            name,
            id,
            adds_unit,
            roles,
        }
    }

    /// The name in the description.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The identifier that carries the message to or from a unit.
    #[must_use]
    pub fn id(&self, unit: u8) -> u32 {
        if self.adds_unit {
            self.id.saturating_add(u32::from(unit))
        } else {
            self.id
        }
    }

    /// The frame of the message; content that the message does not have is ignored.
    ///
    /// # Errors
    /// [`BuildError::BadUnit`].
    pub fn build(
        &self,
        profile: &Profile,
        unit: u8,
        address: u16,
        raw: u16,
    ) -> Result<Frame, BuildError> {
        if !profile.has_unit(unit) {
            return Err(BuildError::BadUnit);
        }
        let mut data = self.roles.map(|role| match role {
            Role::Constant(byte) => byte,
            Role::Unit(shift) => byte_of(u16::from(unit), shift),
            Role::Address(shift) => byte_of(address, shift),
            Role::Raw(shift) => byte_of(raw, shift),
            Role::Multiplexer | Role::Word(_) | Role::Xor(_) => 0,
        });
        for (place, role) in self.roles.iter().enumerate() {
            if let Role::Xor(mask) = *role {
                let check = combined(data, mask);
                if let Some(byte) = data.get_mut(place) {
                    *byte = check;
                }
            }
        }
        Ok(Frame::new(self.id(unit), &data))
    }

    /// The content of a frame as this message of a unit. Any bytes of any length are safe.
    ///
    /// # Errors
    /// Why the frame is not this message.
    pub fn parse(&self, unit: u8, frame: &Frame) -> Result<Content, ParseError> {
        let data = self.laid_out(unit, frame)?;
        let mut content = Content::default();
        for (role, byte) in self.roles.iter().zip(data) {
            match *role {
                Role::Address(shift) => content.address |= word_of(byte, shift),
                Role::Raw(shift) => content.raw |= word_of(byte, shift),
                _ => {}
            }
        }
        Ok(content)
    }

    /// Whether a byte of the message is part of an address.
    pub(super) fn carries_address(&self) -> bool {
        let carries = |role: &Role| matches!(role, Role::Address(_));
        self.roles.iter().any(carries)
    }

    /// Whether a byte of the message is part of a raw number.
    pub(super) fn carries_raw(&self) -> bool {
        let carries = |role: &Role| matches!(role, Role::Raw(_));
        self.roles.iter().any(carries)
    }

    /// The number of words of a telegram in a frame.
    pub(super) fn words(&self) -> usize {
        let is_word = |role: &&Role| matches!(role, Role::Word(_));
        self.roles.iter().filter(is_word).count() / 2
    }

    /// The multiplexer and the words of a frame; [`None`] if it is not this message of the unit.
    pub(super) fn part(&self, unit: u8, frame: &Frame) -> Option<(u8, [u16; LENGTH / 2])> {
        let data = self.laid_out(unit, frame).ok()?;
        let mut multiplexer = 0;
        let mut words = [0; LENGTH / 2];
        for (role, byte) in self.roles.iter().zip(data) {
            match *role {
                Role::Multiplexer => multiplexer = byte,
                Role::Word(place) => {
                    if let Some(word) = words.get_mut(usize::from(place / 2)) {
                        *word |= word_of(byte, if place % 2 == 0 { 8 } else { 0 });
                    }
                }
                _ => {}
            }
        }
        Some((multiplexer, words))
    }

    /// The bytes of a frame, if it is this message of the unit.
    fn laid_out(&self, unit: u8, frame: &Frame) -> Result<[u8; LENGTH], ParseError> {
        if frame.id() != self.id(unit) {
            return Err(ParseError::WrongId);
        }
        let data = frame.whole().ok_or(ParseError::WrongLength)?;
        let bytes = || self.roles.iter().zip(data);
        if bytes().any(|(role, byte)| matches!(role, Role::Constant(own) if *own != byte)) {
            return Err(ParseError::WrongConstant);
        }
        let own = |shift: u8| byte_of(u16::from(unit), shift);
        if bytes().any(|(role, byte)| matches!(role, Role::Unit(shift) if own(*shift) != byte)) {
            return Err(ParseError::WrongUnit);
        }
        if bytes()
            .any(|(role, byte)| matches!(role, Role::Xor(mask) if combined(data, *mask) != byte))
        {
            return Err(ParseError::WrongCheck);
        }
        Ok(data)
    }
}

/// The byte of a word from that bit on.
fn byte_of(word: u16, shift: u8) -> u8 {
    let [_, low] = word
        .checked_shr(u32::from(shift))
        .unwrap_or_default()
        .to_be_bytes();
    low
}

/// A byte as the part of a word from that bit on.
fn word_of(byte: u8, shift: u8) -> u16 {
    u16::from(byte)
        .checked_shl(u32::from(shift))
        .unwrap_or_default()
}

/// The bytes of a mask, combined by exclusive or.
fn combined(data: [u8; LENGTH], mask: u8) -> u8 {
    let places = data.into_iter().enumerate();
    places.fold(0, |check, (place, byte)| {
        if mask >> (place % LENGTH) & 1 == 1 {
            check ^ byte
        } else {
            check
        }
    })
}

/// A request and the answer to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dialogue {
    /// The request.
    pub request: &'static Message,
    /// The answer of the device, if it answers.
    pub answer: Option<&'static Message>,
}

/// The facts of a device that messages need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Profile {
    units: (u8, u8),
    identifier_bits: u8,
    pub(super) read: Option<Dialogue>,
    pub(super) write: Option<Dialogue>,
}

impl Profile {
    /// The least and the greatest unit, the bits of an identifier, the messages that read and write a parameter.
    #[must_use]
    pub const fn new(
        units: (u8, u8),
        identifier_bits: u8,
        read: Option<Dialogue>,
        write: Option<Dialogue>,
    ) -> Self {
        Self {
            units,
            identifier_bits,
            read,
            write,
        }
    }

    /// True if the device can have this unit number.
    #[must_use]
    pub fn has_unit(&self, unit: u8) -> bool {
        let (least, greatest) = self.units;
        (least..=greatest).contains(&unit)
    }

    /// The number of bits of an identifier: 11, or 29 in extended frames.
    #[must_use]
    pub const fn identifier_bits(&self) -> u8 {
        self.identifier_bits
    }
}
