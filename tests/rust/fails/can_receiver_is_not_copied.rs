// error: E0382
// A receiver that was given away is gone: a copy of it would hear nothing.

use fieldscribe_runtime::can::{Client, Receiver, Transport};
use odd_can::{telegrams::Measured, PROFILE};

pub fn wrong<T: Transport>(line: T) -> u64 {
    let receiver = Receiver::<Measured>::new(5);
    let _client = Client::new(line, &PROFILE, 5).listening(receiver);
    receiver.taken()
}
