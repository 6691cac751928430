//! Every raw number of a 16-bit point of each kind of rule survives raw, value, raw and raw, count, raw.

use trips::points::{Falling, Fine, Sevenths, Shifted, Tenth};
use trips::{CountReadable, CountWritable, Encodable, Readable};

macro_rules! trip {
    ($point:ident, $raws:expr) => {
        for raw in $raws {
            assert_eq!($point::encode($point::decode(raw)), Ok(raw));
            assert_eq!($point::encode_count($point::decode_count(raw)), Ok(raw));
        }
    };
}

fn main() {
    trip!(Tenth, 0..=u16::MAX);
    trip!(Fine, 0..=u16::MAX);
    trip!(Sevenths, 0..=u16::MAX);
    trip!(Falling, i16::MIN..=i16::MAX);
    trip!(Shifted, i16::MIN..=i16::MAX);
}
