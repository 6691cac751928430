// error: E0277
// Scales with numbers of more than 53 bits have no values that could be encoded.

use kitchen_sink::{points::EnergyTotal, Encodable};

pub fn encodable<P: Encodable>() {}

pub fn wrong() {
    encodable::<EnergyTotal>();
}
