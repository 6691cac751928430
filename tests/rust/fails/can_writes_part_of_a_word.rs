// error: E0277
// says: `client.update::<P>(value)` reads the word
// A group of bits is not written as if the word were its own: that is an update.

use fieldscribe_runtime::can::Transport;
use odd_can::{points::Mode, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.write::<Mode>(3);
}
