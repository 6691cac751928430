// SPDX-License-Identifier: 0BSD
//! Modbus frames without I/O: builds requests and parses replies in the caller's buffers.
//!
//! ```
//! use fieldscribe_runtime::modbus::{Framing, Function, Profile, Request};
//!
//! const FUNCTIONS: &[Function] = &[Function::new(3, 4)];
//! static PROFILE: Profile = Profile::new(FUNCTIONS, &[Framing::Rtu], (1, 32), Some(0));
//! let request = Request::new(1, 3, 0x1028, 1);
//! let mut frame = [0; 256];
//! assert_eq!(request.build(&PROFILE, &mut frame), Ok(8));
//! ```

mod base;
mod client;
mod function;
mod memory;
mod profile;
mod reply;
mod request;
mod steps;

pub use base::{Base, Chain, FoundBlock, Given, GivenBase};
pub use client::{AsyncClient, Client, LocalClient};
pub use function::{read_function, write_function};
pub use memory::{Forgets, Memory, Remembers};
pub use profile::{Block, Command, Function, Profile};
pub use reply::{reply_length, Reply};
pub use request::{framing_of, Request};
pub use steps::{Step, StepWord, SteppedCommand};

/// The longest frame of both framings, in bytes.
pub const LONGEST: usize = 260;

/// How a PDU is wrapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Framing {
    /// Unit, PDU, CRC with the low byte first.
    Rtu,
    /// Transaction, protocol 0, length, unit, PDU.
    Tcp,
}

/// The Modbus CRC: polynomial `A001h`, start `FFFFh`.
#[must_use]
pub fn crc(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0xFFFF, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte), |crc, _| {
            let shifted = crc >> 1;
            if crc & 1 == 1 {
                shifted ^ 0xA001
            } else {
                shifted
            }
        })
    })
}
