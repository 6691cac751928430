// error: E0308
// Digits are given by what they mean, not as a number.

use odd_can::{points::Delays, Encodable, Error};

pub fn wrong() -> Result<u16, Error> {
    Delays::encode(1111)
}
