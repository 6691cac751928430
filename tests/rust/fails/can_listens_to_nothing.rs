// error: E0277
// says: client.listening(Receiver::<Measured>::new(unit))
// A client without a receiver cannot wait for the words of a telegram.

use fieldscribe_runtime::can::Transport;
use odd_can::{points::Frequency, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.receive::<Frequency>();
}
