// error: E0277
// says: is only read
// The client offers no write of such a point either.

use fieldscribe_runtime::client::Transport;
use sample_drive::{points::Running, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.write::<Running>(true);
}
