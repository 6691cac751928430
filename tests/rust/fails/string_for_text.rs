// error: E0308
// A string may be too long for a text: that is asked first.

use odd_can::{points::Name, Encodable, Error};

pub fn wrong() -> Result<[u16; 8], Error> {
    Name::encode("Generator 1")
}
