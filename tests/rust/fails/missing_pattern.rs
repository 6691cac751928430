// error: E0277
// says: the function whose name ends in `_with` takes them
// A scale with the value of a floating-point parameter is not decoded without it.

use odd_uss::{points::MainActual, Readable};

pub fn wrong() -> Result<f64, odd_uss::Error> {
    MainActual::decode(0x2000)
}
