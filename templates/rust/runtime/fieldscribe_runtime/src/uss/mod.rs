// SPDX-License-Identifier: 0BSD
//! USS telegrams without input or output: a request into the caller's buffer, an answer out of one; and clients.
//!
//! ```
//! use fieldscribe_runtime::uss::{Link, Profile, Request, Task};
//!
//! static PROFILE: Profile = Profile::new(&[Task::new(1, &[1, 2])], (0, 31), &[127], (0, 8), None, &[]);
//! let mut telegram = [0; 28];
//! let request = Request::new(3, 1, 1082, 0);
//! assert_eq!(request.build(&PROFILE, Link::new(127, 2), &[0x047E, 0], &mut telegram), Ok(16));
//! ```

mod client;
mod profile;
mod reply;
mod request;

pub use client::{AsyncClient, Client, LocalClient};
pub use profile::{FixedBits, Link, Profile, Task};
pub use reply::Reply;
pub use request::{broadcast, Request, Value};

use crate::Point;

/// The longest telegram in bytes.
pub const LONGEST: usize = 256;

/// The setting for a parameter part whose length follows from the value.
pub const VARIABLE: u8 = 127;

const START: u8 = 0x02;
const LAST_PARAMETER: u16 = 31_999;

/// A point that is read and written as a parameter, in a parameter part.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no parameter, but a point of the process data",
    label = "no task is for it",
    note = "`client.send::<P>(value)` sends it, or `client.receive::<P>()` asks for it, by its direction"
)]
pub trait Parameter: Point {}

/// A point that the master sends in the process data.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not sent in the process data",
    label = "the drive answers with it, or it is a parameter",
    note = "`client.receive::<P>()` asks for it in the process data, `client.write::<P>(value)` changes a parameter"
)]
pub trait Sent: Point {}

/// A point that the drive answers with in the process data.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not come in the process data",
    label = "it is sent, or is a parameter",
    note = "`client.send::<P>(value)` sends it in the process data, `client.read::<P>()` reads a parameter"
)]
pub trait Received: Point {}

/// All bytes combined by exclusive or: 0 for a whole telegram.
#[must_use]
pub fn check_byte(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |check, byte| check ^ byte)
}

/// The words that name an element of a parameter: its number within a page, and its index with the bits of the page.
fn element(parameter: u16, index: u16) -> [u16; 2] {
    let page = parameter / 2000;
    let pages = (page & 1) << 15 | (page >> 1 & 7) << 12;
    [parameter % 2000, pages | index]
}
