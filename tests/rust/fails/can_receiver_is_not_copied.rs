// error: E0382
// A receiver that was given away is gone: a copy of it would hear nothing.

use fieldscribe_runtime::can::{Receiver, Transport};
use odd_can::{telegrams::Measured, Client};

pub fn wrong<T: Transport>(line: T) -> u64 {
    let receiver = Receiver::<Measured>::new(5);
    let _client = Client::new(line, 5).listening(receiver);
    receiver.taken()
}
