// error: E0277
// says: needs the raw numbers of other points, as `sample_drive::with::UpperLimit`
// A point whose limit is another point is not checked without it.

use sample_drive::{points::UpperLimit, Error, Writable};

pub fn wrong() -> Result<(), Error> {
    UpperLimit::check(500)
}
