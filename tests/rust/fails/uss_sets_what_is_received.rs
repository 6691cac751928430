// error: E0277 E0277
// says: is not sent in the process data
// What the drive sends is not set.

use fieldscribe_runtime::client::Transport;
use odd_uss::{flags, points::StatusWord, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.set::<StatusWord>(flags::StatusWord(1));
}
