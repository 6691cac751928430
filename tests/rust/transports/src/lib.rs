//! What the programs talk to.

pub mod bus;
pub mod log;
pub mod uart;
