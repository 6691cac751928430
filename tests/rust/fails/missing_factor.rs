// error: E0277
// says: the function whose name ends in `_with` takes them
// A point whose scale needs another point is not encoded without it.

use sample_drive::{points::VoltageSetpoint, Encodable, Error};

pub fn wrong() -> Result<u16, Error> {
    VoltageSetpoint::encode(230.0)
}
