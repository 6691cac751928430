// SPDX-License-Identifier: 0BSD
//! Vectors of messages and of telegrams.

use fieldscribe_runtime::can::{Frame, Message, ParseError, Profile, Received, Receiver, Telegram};

use super::{bytes, hex, same, Number, Outcome, Vector};

/// A message into a frame. What an address or a raw number cannot be in Rust is refused here.
pub fn build(vector: &Vector, profile: &Profile, messages: &[&Message]) -> Outcome {
    let message = find(vector, messages)?;
    let (address, raw) = (word(vector, "address"), word(vector, "raw"));
    let (address_held, raw_held) = (address.unwrap_or_default(), raw.unwrap_or_default());
    let found = message.build(profile, unit(vector), address_held, raw_held);
    let (status, id, data) = match (found, address, raw) {
        (Err(error), ..) => (error.name(), 0, String::new()),
        (Ok(_), None, _) => ("bad_address", 0, String::new()),
        (Ok(_), _, None) => ("bad_value", 0, String::new()),
        (Ok(frame), ..) => ("ok", frame.id(), hex(frame.bytes())),
    };
    same(vector.text("status"), status)?;
    same(vector.raw("id"), id)?;
    same(vector.text("bytes"), data.as_str())
}

/// A frame as a message.
pub fn parse(vector: &Vector, messages: &[&Message]) -> Outcome {
    let message = find(vector, messages)?;
    let frame = Frame::new(vector.raw("id"), &bytes(vector.text("bytes")));
    let found = message.parse(unit(vector), &frame);
    same(
        vector.text("status"),
        found.map_or_else(ParseError::name, |_| "ok"),
    )?;
    let content = found.unwrap_or_default();
    same(vector.raw("address"), content.address)?;
    same(vector.raw("raw"), content.raw)
}

/// Frames of a telegram, and a point of it.
pub fn can_telegram<P>(vector: &Vector) -> Outcome
where
    P: Received<Raw: Number + PartialEq + std::fmt::Debug>,
{
    same(vector.text("telegram"), P::Telegram::NAME)?;
    let mut receiver = Receiver::<P::Telegram>::new(unit(vector));
    let frames = vector.pairs("frames");
    let taken = frames.iter().map(|(id, data)| {
        let id = u32::try_from(*id).unwrap_or(u32::MAX);
        u8::from(receiver.take(&Frame::new(id, data)))
    });
    let taken: Vec<u8> = taken.collect();
    same(vector.numbers("taken").unwrap_or_default(), taken)?;
    match receiver.raw::<P>() {
        Ok(raw) => {
            same(vector.text("status"), "ok")?;
            same(vector.raw("raw"), raw)
        }
        Err(error) => same(vector.text("status"), error.name()),
    }
}

fn find<'a>(vector: &Vector, messages: &[&'a Message]) -> Result<&'a Message, String> {
    let mut named = messages
        .iter()
        .filter(|message| message.name() == vector.text("message"));
    named
        .next()
        .copied()
        .ok_or_else(|| "there is no such message".to_owned())
}

/// The unit; one that is no byte is as wrong as the last.
fn unit(vector: &Vector) -> u8 {
    let unit = vector.number("unit").and_then(Number::from_number);
    unit.unwrap_or(u8::MAX)
}

fn word(vector: &Vector, key: &str) -> Option<u16> {
    vector.number(key).and_then(Number::from_number)
}
