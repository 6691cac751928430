//! CAN frames through the parser and the receivers in Rust, with the messages of `kitchen_can`.

mod cases;

use std::io::BufWriter;

use cases::{say, Cases};
use fieldscribe_runtime::can::{Frame, ParseError, Receiver, Telegram};
use fieldscribe_runtime::Error;
use kitchen_can::telegrams::{Heartbeat, Measurements};

const UNIT: u8 = 5;

/// Offers a frame to a receiver, and says whether it was taken and what one word is now.
fn hear<T: Telegram>(receiver: &mut Receiver<T>, frame: &Frame, position: u16) -> [String; 3] {
    let taken = u8::from(receiver.take(frame)).to_string();
    let word = receiver.word(position);
    let status = word.map_or_else(Error::name, |_| "ok");
    [taken, status.to_owned(), word.unwrap_or_default().to_string()]
}

fn main() {
    let mut cases = Cases::read();
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut measurements = Receiver::<Measurements>::new(UNIT);
    let mut heartbeat = Receiver::<Heartbeat>::new(UNIT);
    while cases.more() {
        let (message, unit, position) = (cases.byte(), cases.byte(), cases.word());
        let id = u32::from(cases.word()) | u32::from(cases.word()) << 16;
        let frame = Frame::new(id, &cases.frame());
        let found = kitchen_can::MESSAGES[usize::from(message)].parse(unit, &frame);
        let content = found.unwrap_or_default();
        let mut words = vec![
            found.map_or_else(ParseError::name, |_| "ok").to_owned(),
            content.address.to_string(),
            content.raw.to_string(),
        ];
        words.extend(hear(&mut measurements, &frame, position));
        words.extend(hear(&mut heartbeat, &frame, 0));
        say(&mut out, &words);
    }
}
