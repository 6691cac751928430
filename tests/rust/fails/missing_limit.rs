// error: E0271
// A point whose limit is another point is not checked without it.

use sample_drive::{points::UpperLimit, Error, Writable};

pub fn wrong() -> Result<(), Error> {
    UpperLimit::check(500)
}
