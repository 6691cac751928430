// error: E0271
// A point whose scale needs another point is not encoded without it.

use sample_drive::{points::VoltageSetpoint, Encodable, Error};

pub fn wrong() -> Result<u16, Error> {
    VoltageSetpoint::encode(230.0)
}
