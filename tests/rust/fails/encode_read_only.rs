// error: E0599
// A point that the device does not take cannot be encoded.

use sample_drive::{points::Power, Encodable, Error};

pub fn wrong() -> Result<i16, Error> {
    Power::encode(1.0)
}

pub fn same_trait<P: Encodable>() {}
