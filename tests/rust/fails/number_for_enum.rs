// error: E0308
// A number is not taken for a named value.

use sample_drive::{points::FrequencySource, Encodable, Error};

pub fn wrong() -> Result<u16, Error> {
    FrequencySource::encode(1)
}
