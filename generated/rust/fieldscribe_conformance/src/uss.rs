// SPDX-License-Identifier: 0BSD
//! Vectors of USS telegrams.

use fieldscribe_runtime::uss::{
    self, AsyncClient, Client, Link, Parameter, Profile, Received, Request, Sent, Value, LONGEST,
};
use fieldscribe_runtime::{
    BitGroup, BuildError, ClientError, Decoded, Encodable, Error, PointInfo, Readable, ReplyError,
    Whole, Writable,
};

use super::clients::exchanged;
pub use super::uss_clients::check;
use super::{same, Number, Outcome, Script, Vector};

fn blocking(vector: &Vector, profile: &'static Profile, _base: &str) -> Client<Script> {
    let (script, unit) = (Script::new(vector), vector.raw("unit"));
    Client::for_profile(script, profile, link(vector), unit)
}

fn waiting(vector: &Vector, profile: &'static Profile, _base: &str) -> AsyncClient<Script> {
    let (script, unit) = (Script::new(vector), vector.raw("unit"));
    AsyncClient::for_profile(script, profile, link(vector), unit)
}

with_clients!(Script, Parameter, Parameter);

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
        Ok(_) if value.is_none() => (BuildError::NoRoom.name(), 0),
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

/// That the profile names an error value as the drive does.
pub fn named(vector: &Vector, profile: &Profile) -> Outcome {
    let found = match profile.refusal(vector.raw("number")) {
        ReplyError::Refused { name, .. } => name,
        _ => None,
    };
    same(vector.said("name").as_deref(), found)
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
        Err(ReplyError::Refused { error, .. }) => ("refused", 7, error),
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

/// The value of a raw number is stored.
pub fn store<P>(
    vector: &Vector,
    profile: &'static Profile,
    factors: P::Factors,
    with: P::With,
) -> Outcome
where
    P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + Whole + Parameter,
{
    let value = P::decode_with(vector.raw("raw"), factors)
        .into_result()
        .map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| {
        client.store_with::<P>(value, with)
    })?;
    Ok(())
}

/// A group of bits is stored in its word.
pub fn store_update<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Readable<Raw: Number, Factors = (), Value: Copy>
        + Encodable<With = ()>
        + BitGroup
        + Parameter,
{
    store_update_with::<P>(vector, profile, (), ())
}

/// The same for a group that needs other points.
pub fn store_update_with<P>(
    vector: &Vector,
    profile: &'static Profile,
    factors: P::Factors,
    with: P::With,
) -> Outcome
where
    P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + BitGroup + Parameter,
{
    let value = P::decode_with(vector.raw("raw"), factors)
        .into_result()
        .map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| {
        client.store_update_with::<P>(value, with)
    })?;
    Ok(())
}

/// A parameter that cannot be read is written as it is.
pub fn write_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole + Parameter,
{
    given(
        vector,
        profile,
        Request::write::<P>(vector.raw("unit"), vector.raw("raw")),
    )
}

/// The same in the EEPROM too.
pub fn store_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole + Parameter,
{
    given(
        vector,
        profile,
        Request::store::<P>(vector.raw("unit"), vector.raw("raw")),
    )
}

fn given(vector: &Vector, profile: &'static Profile, request: Request) -> Outcome {
    let mut client = blocking(vector, profile, "");
    let found = client.exchange(request).map(|_| ());
    exchanged(vector, found, &client.into_transport()).map(|_| ())
}

/// Words of the process data that are sent as they are.
pub fn send_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole + Sent,
{
    let words = crate::words_of::<P>(vector.raw("raw"));
    let mut client = blocking(vector, profile, "");
    for (position, word) in (P::ADDRESS..).zip(&words) {
        client.set_word(position, *word).map_err(Error::name)?;
    }
    let found = client.cycle();
    exchanged(vector, found, &client.into_transport()).map(|_| ())
}

/// A point of the process data that comes back.
pub fn receive<P>(vector: &Vector, profile: &'static Profile, factors: P::Factors) -> Outcome
where
    P: Readable<Raw: Number, Factors: Copy, Value: PartialEq + std::fmt::Debug> + Received,
{
    let found = blocked(vector, profile, P::BASE, &|client| {
        client.receive_with::<P>(factors)
    })?;
    let expected = P::decode_with(vector.raw("raw"), factors)
        .into_result()
        .map_err(Error::name)?;
    same(Some(expected), found)?;
    read_data(vector, profile, P::INFO.any())
}

/// A point of the process data that is sent.
pub fn send<P>(
    vector: &Vector,
    profile: &'static Profile,
    factors: P::Factors,
    with: P::With,
) -> Outcome
where
    P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + Whole + Sent,
{
    let value = P::decode_with(vector.raw("raw"), factors)
        .into_result()
        .map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| {
        client.send_with::<P>(value, with)
    })?;
    write_data(vector, profile, P::INFO.any())
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
