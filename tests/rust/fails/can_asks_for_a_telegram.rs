// error: E0277
// says: `client.receive::<P>()` waits for it
// Nobody answers when a point of a telegram is asked for as a parameter.

use fieldscribe_runtime::can::Transport;
use odd_can::{points::Frequency, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.read::<Frequency>();
}
