// SPDX-License-Identifier: 0BSD
//! CAN devices with messages of their own: frames built and read, multiplexed telegrams put together, clients.
//!
//! ```
//! use fieldscribe_runtime::can::{Frame, Message, Profile, Role};
//!
//! const ASK: Message = Message::new("ask", 0x33F, false, [
//!     Role::Constant(0xFF), Role::Unit(0), Role::Address(8), Role::Address(0),
//!     Role::Constant(0), Role::Constant(0), Role::Xor(0b0011_1111), Role::Constant(0),
//! ]);
//! static PROFILE: Profile = Profile::new((0, 30), 11, None, None);
//! let frame = ASK.build(&PROFILE, 5, 0x01FB, 0).unwrap();
//! assert_eq!(frame, Frame::new(0x33F, &[0xFF, 5, 0x01, 0xFB, 0, 0, 0x00, 0]));
//! ```

mod client;
mod error;
mod message;
mod receiver;
mod signals;

pub use client::{AsyncClient, AsyncTransport, Client};
pub use client::{Hears, Listener, LocalClient, LocalTransport, Transport};
pub use error::ParseError;
pub use message::{Content, Dialogue, Message, Profile, Role};
pub use receiver::{Received, Receiver, Slot, Telegram};
pub use signals::{Carried, Numbers, Signal, Signals};

use crate::Point;

/// The number of bytes of every message.
pub const LENGTH: usize = 8;

/// A frame on the bus: its identifier and at most eight bytes of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Frame {
    id: u32,
    length: usize,
    data: [u8; LENGTH],
}

impl Frame {
    /// A frame with this identifier and data. If the data are too long for a frame, the first eight bytes are kept, and
    /// it matches no message.
    #[must_use]
    pub fn new(id: u32, bytes: &[u8]) -> Self {
        let mut data = [0; LENGTH];
        for (place, byte) in data.iter_mut().zip(bytes) {
            *place = *byte;
        }
        Self {
            id,
            length: bytes.len(),
            data,
        }
    }

    /// The identifier.
    #[must_use]
    pub const fn id(&self) -> u32 {
        self.id
    }

    /// The data.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.data.get(..self.length).unwrap_or(&self.data)
    }

    /// The data of a frame that may be a message.
    const fn whole(&self) -> Option<[u8; LENGTH]> {
        if self.length == LENGTH {
            Some(self.data)
        } else {
            None
        }
    }
}

/// A point whose words are read and written one by one, each by messages that name its address.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no parameter: nobody asks for it or writes it by its address",
    label = "a point of a telegram",
    note = "`client.receive::<P>()` waits for it; a `Receiver` of the telegram has what was heard"
)]
pub trait Parameter: Point {}
