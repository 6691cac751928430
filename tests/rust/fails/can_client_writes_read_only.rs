// error: E0277
// says: is only read
// A client of a CAN device offers no write of what is only read.

use fieldscribe_runtime::can::Transport;
use odd_can::{points::Actual, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.write::<Actual>(1);
}
