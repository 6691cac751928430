// SPDX-License-Identifier: 0BSD
//! Vectors of messages and of telegrams.

use std::collections::VecDeque;

use fieldscribe_runtime::can::{
    self, AsyncClient, Carried, Client, Frame, Message, Numbers, Parameter, ParseError, Profile,
    Received, Receiver, Signals, Telegram,
};
use fieldscribe_runtime::{
    BitGroup, ClientError, Decoded, Encodable, Error, PointInfo, Readable, Whole, Writable,
};

pub use super::can_clients::check;
use super::{bytes, data_of, same, Number, Outcome, Script, Vector};

/// Frames in bytes: the identifier in four and the data.
struct Bus {
    script: Script,
    came: VecDeque<Frame>,
}

impl Bus {
    fn new(vector: &Vector) -> Self {
        Self {
            script: Script::new(vector),
            came: VecDeque::new(),
        }
    }

    fn sent(&mut self, frame: &Frame) -> Result<(), ()> {
        let data = [&frame.id().to_be_bytes(), frame.bytes()].concat();
        let answer = self.script.answer(&data).ok_or(())?;
        if let Some((id, data)) = answer.split_first_chunk() {
            self.came
                .push_back(Frame::new(u32::from_be_bytes(*id), data));
        }
        Ok(())
    }
}

impl can::Transport for Bus {
    type Error = ();

    fn send(&mut self, frame: &Frame) -> Result<(), ()> {
        self.sent(frame)
    }

    fn receive(&mut self) -> Result<Frame, ()> {
        self.came.pop_front().ok_or(())
    }

    fn pending(&mut self) -> Result<Option<Frame>, ()> {
        Ok(self.came.pop_front())
    }
}

impl can::AsyncTransport for Bus {
    type Error = ();

    async fn send(&mut self, frame: &Frame) -> Result<(), ()> {
        self.sent(frame)
    }

    async fn receive(&mut self) -> Result<Frame, ()> {
        self.came.pop_front().ok_or(())
    }

    async fn pending(&mut self) -> Result<Option<Frame>, ()> {
        Ok(self.came.pop_front())
    }
}

impl AsRef<Script> for Bus {
    fn as_ref(&self) -> &Script {
        &self.script
    }
}

fn blocking(vector: &Vector, profile: &'static Profile, _base: &str) -> Client<Bus> {
    Client::for_profile(Bus::new(vector), profile, vector.raw("unit"))
}

fn waiting(vector: &Vector, profile: &'static Profile, _base: &str) -> AsyncClient<Bus> {
    AsyncClient::for_profile(Bus::new(vector), profile, vector.raw("unit"))
}

with_clients!(Bus, Parameter, Parameter);

/// A parameter that cannot be read is written as it is.
pub fn write_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole + Parameter,
{
    let words = P::to_words(vector.raw("raw"));
    let word = words.as_ref().first().copied().unwrap_or_default();
    both!(vector, profile, P::BASE, |client| client
        .write_word(P::ADDRESS, word));
    Ok(())
}

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

/// Frames that a receiver of a telegram takes, or does not.
pub fn can_taken<T: Telegram>(vector: &Vector) -> Outcome {
    let mut receiver = Receiver::<T>::new(unit(vector));
    let frames = vector.pairs("frames");
    let taken = frames.iter().map(|(id, data)| {
        let id = id.parse().unwrap_or(u32::MAX);
        u8::from(receiver.take(&Frame::new(id, &bytes(data))))
    });
    let taken: Vec<u8> = taken.collect();
    same(vector.numbers("taken"), taken)
}

/// What the line of a device is like.
pub fn bus(vector: &Vector, profile: &Profile, bitrate: Option<u32>) -> Outcome {
    same(vector.raw("identifier_bits"), profile.identifier_bits())?;
    same(vector.number("bitrate"), bitrate.map(i128::from))
}

/// The name of the message whose frames carry a telegram.
pub fn can_carrier<T: Telegram>(vector: &Vector) -> Outcome {
    same(vector.text("telegram").as_str(), T::NAME)?;
    same(vector.text("carrier").as_str(), T::MESSAGE.name())
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
            if let Some(value) = data_of(vector, P::INFO.any()) {
                let point = PointInfo::new(P::FACTS);
                same(Ok(value), receiver.value_of(point))?;
            }
            same(vector.raw("raw"), raw)
        }
        Err(error) => {
            same(vector.number("raw"), None)?;
            same(vector.text("status").as_str(), error.name())
        }
    }
}

/// A signal out of a frame, and into one.
pub fn can_signal<P>(vector: &Vector) -> Outcome
where
    P: Carried<Raw: Number + PartialEq + std::fmt::Debug + Copy>,
{
    same(vector.text("telegram").as_str(), P::Message::NAME)?;
    let data = vector.bytes("bytes");
    let taken = Numbers::<P::Message>::take(unit(vector), vector.raw("id"), &data);
    let status = vector.text("status");
    let found = match taken {
        Ok(numbers) => numbers.raw::<P>().map_err(Error::name),
        Err(error) => Err(error.name()),
    };
    match found {
        Ok(raw) => {
            same(status.as_str(), "ok")?;
            same(vector.raw("raw"), raw)?;
            let mut numbers = Numbers::<P::Message>::default();
            numbers.select::<P>();
            numbers.put_raw::<P>(raw);
            let (mut room, mut less) = (vec![0xA5; data.len() + 1], vec![0; data.len() - 1]);
            same(
                Some(vector.bytes("packed").as_slice()),
                numbers.data(&mut room),
            )?;
            same(None, numbers.data(&mut less))
        }
        Err(error) => {
            same(vector.number("raw"), None)?;
            same(status.as_str(), error)
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
