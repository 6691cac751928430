// error: E0277
// says: a pair of receivers is asked by its parts
// Nobody can tell which receiver of a pair waits.

use fieldscribe_runtime::can::{Receiver, Transport};
use odd_can::{points::Frequency, telegrams, Client};

type Pair = (Receiver<telegrams::Measured>, Receiver<telegrams::Telegram>);

pub fn wrong<T: Transport>(client: &mut Client<T, Pair>) {
    let _ = client.receive::<Frequency>();
}
