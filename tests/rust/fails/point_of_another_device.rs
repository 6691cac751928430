// error: E0277
// says: a point of the device `Trips` is no point of the device `SampleDrive`
// A client takes the points of its device alone, and the compiler names both.

use sample_drive::{Client, Transport};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.read::<trips::points::Tenth>();
}
