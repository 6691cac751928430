// SPDX-License-Identifier: 0BSD
//! Vectors of messages and of telegrams.

use fieldscribe_runtime::can::{Frame, Message, ParseError, Profile, Received, Receiver, Telegram};

use super::{bytes, same, Number, Outcome, Vector};

/// A message into a frame. What an address or a raw number cannot be in Rust is refused here.
pub fn build(vector: &Vector, profile: &Profile, messages: &[&Message]) -> Outcome {
    let message = find(vector, messages)?;
    let (address, raw) = (word(vector, "address"), word(vector, "raw"));
    let (address_held, raw_held) = (address.unwrap_or_default(), raw.unwrap_or_default());
    let found = message.build(profile, unit(vector), address_held, raw_held);
    let (status, id, data) = match (found, address, raw) {
        (Err(error), ..) => (error.name(), 0, Vec::new()),
        (Ok(_), None, _) => ("bad_address", 0, Vec::new()),
        (Ok(_), _, None) => ("bad_value", 0, Vec::new()),
        (Ok(frame), ..) => ("ok", frame.id(), frame.bytes().to_vec()),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.count("id"), id)?;
    same(vector.bytes("bytes"), data)
}

/// A frame as a message.
pub fn parse(vector: &Vector, messages: &[&Message]) -> Outcome {
    let message = find(vector, messages)?;
    let frame = Frame::new(vector.raw("id"), &vector.bytes("bytes"));
    let found = message.parse(unit(vector), &frame);
    same(
        vector.text("status").as_str(),
        found.map_or_else(ParseError::name, |_| "ok"),
    )?;
    let content = found.unwrap_or_default();
    same(vector.count("address"), content.address)?;
    same(vector.count("raw"), content.raw)
}

/// Frames of a telegram, and a point of it.
pub fn can_telegram<P>(vector: &Vector) -> Outcome
where
    P: Received<Raw: Number + PartialEq + std::fmt::Debug>,
{
    same(vector.text("telegram").as_str(), P::Telegram::NAME)?;
    let mut receiver = Receiver::<P::Telegram>::new(unit(vector));
    let frames = vector.pairs("frames");
    let taken = frames.iter().map(|(id, data)| {
        let id = id.parse().unwrap_or(u32::MAX);
        u8::from(receiver.take(&Frame::new(id, &bytes(data))))
    });
    let taken: Vec<u8> = taken.collect();
    same(vector.numbers("taken"), taken)?;
    match receiver.raw::<P>() {
        Ok(raw) => {
            same(vector.text("status").as_str(), "ok")?;
            same(vector.raw("raw"), raw)
        }
        Err(error) => {
            same(vector.number("raw"), None)?;
            same(vector.text("status").as_str(), error.name())
        }
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
