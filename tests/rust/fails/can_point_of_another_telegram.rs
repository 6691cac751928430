// error: E0271
// A receiver has no point of another telegram.

use fieldscribe_runtime::can::Receiver;
use odd_can::{points::Beats, telegrams::Measured};

pub fn wrong(receiver: &Receiver<Measured>) {
    let _ = receiver.raw::<Beats>();
}
