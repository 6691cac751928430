// SPDX-License-Identifier: 0BSD
//! Vectors of USS telegrams.

use fieldscribe_runtime::uss::{
    self, BuildError, Link, ParseError, Profile, Request, Value, LONGEST,
};

use super::{same, Number, Outcome, Vector};

/// A request into bytes. What a value cannot be in Rust is refused here.
pub fn build(vector: &Vector, profile: &Profile) -> Outcome {
    let words: Vec<u16> = vector.numbers("words");
    let (link, value) = (link(vector), value(vector));
    let width = vector.number("width");
    let least = if width == Some(2) {
        Value::Double(0)
    } else {
        Value::Nothing
    };
    let request = request(vector).with(value.unwrap_or(least));
    let mut buffer = [0; LONGEST];
    let (status, length) = match request.build(profile, link, &words, &mut buffer) {
        Err(error) => (error.name(), 0),
        Ok(_) if value.is_none() => (BuildError::BadValue.name(), 0),
        Ok(length) => ("ok", length),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.bytes("bytes").as_slice(), &buffer[..length])?;
    if length > 0 {
        let short = request.build(profile, link, &words, &mut buffer[..length - 1]);
        same(Err(BuildError::BufferTooSmall), short)?;
    }
    Ok(())
}

/// A telegram to all units.
pub fn broadcast(vector: &Vector, profile: &Profile) -> Outcome {
    let words: Vec<u16> = vector.numbers("words");
    let masks: Vec<u16> = vector.numbers("mask");
    let masks = <[u16; 4]>::try_from(masks).map_err(|_| "there are not four masks".to_owned())?;
    let mut buffer = [0; LONGEST];
    let found = uss::broadcast(profile, link(vector), masks, &words, &mut buffer);
    same(
        vector.text("status").as_str(),
        found.map_or_else(BuildError::name, |_| "ok"),
    )?;
    let length = found.unwrap_or_default();
    same(vector.bytes("bytes").as_slice(), &buffer[..length])
}

/// Bytes as the answer to a request.
pub fn reply(vector: &Vector, profile: &Profile) -> Outcome {
    let received = vector.bytes("bytes");
    let found = request(vector).parse(profile, link(vector), &received);
    let (status, response, error) = match found {
        Ok(reply) => ("ok", reply.response(), 0),
        Err(ParseError::Refused(error)) => ("refused", 7, error),
        Err(error) => (error.name(), 0, 0),
    };
    let value = found.map_or(Value::Nothing, |reply| reply.value());
    let words = found.map_or_else(|_| Vec::new(), |reply| reply.words().collect());
    let (width, number) = match value {
        Value::Nothing => (0, 0),
        Value::Word(word) => (1, u32::from(word)),
        Value::Double(value) => (2, value),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.count("response"), response)?;
    same(vector.count("error"), error)?;
    same(vector.count("width"), width)?;
    same(vector.count("value"), number)?;
    same(vector.numbers("words"), words)
}

fn link(vector: &Vector) -> Link {
    let link = Link::new(vector.raw("pkw"), vector.raw("pzd"));
    if vector.count::<u8>("single_first") == 1 {
        link.single_first()
    } else {
        link
    }
}

/// The request without its value; what a number cannot be in Rust is as wrong as the type's last.
fn request(vector: &Vector) -> Request {
    let unit = held(vector, "unit").unwrap_or(u8::MAX);
    let task = held(vector, "task").unwrap_or(u8::MAX);
    let parameter = held(vector, "parameter").unwrap_or(u16::MAX);
    let index = held(vector, "index").unwrap_or(u16::MAX);
    Request::new(unit, task, parameter, index)
}

fn value(vector: &Vector) -> Option<Value> {
    match vector.number("width") {
        Some(1) => held(vector, "value").map(Value::Word),
        Some(2) => held(vector, "value").map(Value::Double),
        _ => (vector.number("value") == Some(0)).then_some(Value::Nothing),
    }
}

fn held<T: Number>(vector: &Vector, key: &str) -> Option<T> {
    vector.number(key).and_then(T::from_number)
}
