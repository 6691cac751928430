// error: E0277
// says: is only read
// A client of a drive offers no write of what is only read.

use fieldscribe_runtime::client::Transport;
use odd_uss::{flags, points::Status, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.store::<Status>(flags::Status(1));
}
