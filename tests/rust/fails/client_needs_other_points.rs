// error: E0277
// says: `write_with`
// A point that needs other points is not written without them.

use fieldscribe_runtime::client::Transport;
use sample_drive::{points::VoltageSetpoint, Client};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.write::<VoltageSetpoint>(230.0);
}
