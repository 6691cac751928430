// error: E0277
// Counts that no integer of 64 bits holds do not exist.

use kitchen_sink::{points::UnevenVoltage, CountReadable};

pub fn countable<P: CountReadable>() {}

pub fn wrong() {
    countable::<UnevenVoltage>();
}
