// error: E0277
// says: client.listening(Receiver::<Measured>::new(unit))
// A client without a receiver cannot wait for the words of a telegram.

use fieldscribe_runtime::can::{Client, Transport};
use odd_can::points::Frequency;

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.receive::<Frequency>();
}
