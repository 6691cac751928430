// SPDX-License-Identifier: 0BSD
//! Vectors of Modbus frames and of batched reads.

use fieldscribe_runtime::modbus::{
    AsyncClient, Base, Block, BuildError, Client, ClientError, Command, Framing, Profile,
    ReplyError, Request, SteppedCommand, LONGEST,
};
use fieldscribe_runtime::{
    BitGroup, Decoded, Encodable, Error, PointInfo, Readable, Whole, Writable,
};

pub use super::modbus_clients::check;
use super::{data_of, exchanged, now, same, written_data_of, Number, Outcome, Script, Vector};

/// What a client found.
type Found<T> = Result<T, ClientError<()>>;

/// What the client that blocks does with the script of the vector.
///
/// Each point is tried with it; `modbus_clients` shows that the client that does not block has the same methods.
fn blocked<T>(
    vector: &Vector,
    profile: &'static Profile,
    base_name: &'static str,
    call: &dyn Fn(&mut Client<Script>) -> Found<T>,
) -> Result<Option<T>, String> {
    let mut client = blocking(vector, profile);
    client.set_base(base(vector, base_name));
    let found = call(&mut client);
    exchanged(vector, found, name, &client.into_transport())
}

/// The same operation with the client that blocks and the one that does not, each over a script of its own.
macro_rules! both {
    ($vector:ident, $profile:ident, $base:expr, |$client:ident| $call:expr) => {{
        let found = blocked($vector, $profile, $base, &|$client| $call)?;
        let mut client = waiting($vector, $profile);
        client.set_base(base($vector, $base));
        let $client = &mut client;
        let again = now($call);
        let again = exchanged($vector, again, name, &client.into_transport())?;
        same(true, found == again)?;
        found
    }};
}

/// Where the base of that name is, by the vector.
fn base(vector: &Vector, name: &'static str) -> Base {
    let number = |key| {
        let mut pairs = vector.pairs(key).into_iter();
        pairs.find(|(known, _)| known == name)?.1.parse().ok()
    };
    match (number("starts"), number("lasts")) {
        (Some(start), Some(last)) => Base::new(name, start, last),
        _ => Base::at("", 0),
    }
}

fn blocking(vector: &Vector, profile: &'static Profile) -> Client<Script> {
    Client::for_profile(
        Script::new(vector),
        profile,
        framing(vector),
        vector.raw("unit"),
    )
}

fn waiting(vector: &Vector, profile: &'static Profile) -> AsyncClient<Script> {
    AsyncClient::for_profile(
        Script::new(vector),
        profile,
        framing(vector),
        vector.raw("unit"),
    )
}

/// A request into bytes.
pub fn build(vector: &Vector, profile: &Profile) -> Outcome {
    let values = vector.numbers("values");
    let request = request(vector, &values);
    let mut buffer = [0; LONGEST];
    let (status, length) = match request.build(profile, &mut buffer) {
        Ok(length) => ("ok", length),
        Err(error) => (error.name(), 0),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.bytes("bytes").as_slice(), &buffer[..length])?;
    if length > 0 {
        let short = request.build(profile, &mut buffer[..length - 1]);
        same(Err("buffer_too_small"), short.map_err(BuildError::name))?;
    }
    Ok(())
}

/// Bytes as the reply to a request.
pub fn reply(vector: &Vector) -> Outcome {
    let values = vector.numbers("values");
    let request = request(vector, &values);
    let bytes = vector.bytes("bytes");
    let (status, items, exception) = match request.parse(&bytes) {
        Ok(reply) => ("ok", reply.items().collect::<Vec<_>>(), 0),
        Err(ReplyError::Exception { code, name: None }) => ("exception", Vec::new(), code),
        Err(error) => (error.name(), Vec::new(), 0),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("values_out"), items)?;
    same(vector.count("exception"), exception)
}

/// That the profile names an exception code as the device does.
pub fn named(vector: &Vector, profile: &Profile) -> Outcome {
    let (code, name) = (vector.raw("number"), None);
    let found = match profile.named(ReplyError::Exception { code, name }) {
        ReplyError::Exception { name, .. } => name,
        _ => None,
    };
    same(vector.said("name").as_deref(), found)
}

fn framing(vector: &Vector) -> Framing {
    match vector.text("framing").as_str() {
        "tcp" => Framing::Tcp,
        _ => Framing::Rtu,
    }
}

fn name(error: ClientError<()>) -> &'static str {
    match error {
        ClientError::Point(error) => error.name(),
        ClientError::Build(error, _) => error.name(),
        ClientError::Reply(error, _) => error.name(),
        _ => "timeout",
    }
}

/// A point's raw number.
pub fn read<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Readable<Raw: Number>,
{
    let found = blocked(vector, profile, P::BASE, &|client| {
        client.read_raw::<P>().map(Number::to_number)
    })?;
    same(vector.number("raw"), found)?;
    read_data(vector, profile, P::INFO.any())
}

/// A text's words.
pub fn read_text<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Readable + Whole,
{
    let found = blocked(vector, profile, P::BASE, &|client| {
        client
            .read_raw::<P>()
            .map(|raw| P::to_words(raw).as_ref().to_vec())
    })?;
    same(vector.numbers("words"), found.unwrap_or_default())
}

/// The same by the data of a point that needs no others.
fn read_data(vector: &Vector, profile: &'static Profile, point: PointInfo) -> Outcome {
    if let Some(value) = data_of(vector, point) {
        let found = both!(vector, profile, point.base, |client| client
            .read_point(point));
        same(Some(value), found)?;
    }
    Ok(())
}

fn write_data(vector: &Vector, profile: &'static Profile, point: PointInfo) -> Outcome {
    if let Some(value) = written_data_of(vector, point) {
        both!(vector, profile, point.base, |client| client
            .write_point(point, value));
    }
    Ok(())
}

/// The value of a raw number is written.
pub fn write<P>(
    vector: &Vector,
    profile: &'static Profile,
    factors: P::Factors,
    with: P::With,
) -> Outcome
where
    P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + Whole,
{
    let value = P::decode_with(vector.raw("raw"), factors)
        .into_result()
        .map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| {
        client.write_with::<P>(value, with)
    })?;
    write_data(vector, profile, P::INFO.any())
}

/// A text is written.
pub fn write_text<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Readable<Factors = (), Value: Copy> + Encodable<With = ()> + Whole,
{
    let words: Vec<u16> = vector.numbers("words");
    let raw = P::from_received(words.into_iter()).map_err(Error::name)?;
    let value = P::decode(raw).into_result().map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| client.write::<P>(value))?;
    Ok(())
}

/// A group of bits is written into its word.
pub fn update<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Readable<Raw: Number, Factors = (), Value: Copy> + Encodable<With = ()> + BitGroup,
{
    let value = P::decode(vector.raw("raw"))
        .into_result()
        .map_err(Error::name)?;
    blocked(vector, profile, P::BASE, &|client| {
        client.update::<P>(value)
    })?;
    write_data(vector, profile, P::INFO.any())
}

/// A point that cannot be read is written as it is.
pub fn write_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole,
{
    let unit = vector.raw("unit");
    let request = Request::write::<P>(unit, vector.raw("raw")).at(&base(vector, P::BASE));
    let mut client = Client::for_profile(Script::new(vector), profile, framing(vector), unit);
    let found = client.exchange(request).map(|_| ());
    exchanged(vector, found, name, &client.into_transport()).map(|_| ())
}

/// A command.
pub fn command<D>(vector: &Vector, profile: &'static Profile, command: &Command<D>) -> Outcome {
    let command = Command::new(command.function, command.address, command.value);
    both!(vector, profile, "", |client| client.command(&command));
    same(vector.raw("value"), command.value.unwrap_or(1))
}

/// A step of a command: its requests, and its words in place of those that the device held.
pub fn step(vector: &Vector, commands: &[SteppedCommand]) -> Outcome {
    let name = vector.text("command");
    let command = commands.iter().find(|command| command.name == name);
    let command = command.ok_or_else(|| "there is no such command".to_owned())?;
    let step = command.steps.get(usize::from(vector.raw::<u16>("index")));
    let step = step.ok_or_else(|| "there is no such step".to_owned())?;
    let given = vector.pairs("with");
    let names = command.arguments.iter().map(|(name, _, _)| *name);
    same(true, names.eq(given.iter().map(|(name, _)| name.as_str())))?;
    let numbers: Vec<i32> = given
        .iter()
        .filter_map(|(_, text)| text.parse().ok())
        .collect();
    let beyond: Vec<i32> = numbers.iter().map(|number| number + 1000).collect();
    same(true, command.takes(&numbers))?;
    same(numbers.is_empty(), command.takes(&beyond))?;
    let held: Vec<u16> = vector.numbers("held");
    let mut words = held.clone();
    let unchanged = step.fill(&numbers, &mut words);
    same(vector.numbers("words"), words.clone())?;
    same(words == held, unchanged)?;
    same(held.len(), step.words.len())?;
    same(vector.number("read"), step.read.map(i128::from))?;
    same(vector.number("write"), step.write.map(i128::from))?;
    same(vector.raw("address"), step.address)?;
    same(vector.count::<u32>("within"), step.within)?;
    same(vector.raw::<u8>("conditional") == 1, step.is_conditional)?;
    same(vector.text("base"), step.base.to_owned())
}

/// A batched read.
pub fn block<D>(vector: &Vector, blocks: &[(&str, &[Block<D>])]) -> Outcome {
    let group = blocks
        .iter()
        .find(|(name, _)| *name == vector.text("group"));
    let (space, address) = (vector.text("space"), vector.raw("address"));
    let is_there =
        |block: &&Block<D>| (space.as_str(), address) == (block.space.name(), block.address);
    let block = group.and_then(|(_, blocks)| blocks.iter().find(is_there));
    let block = block.ok_or_else(|| "there is no such block".to_owned())?;
    same(vector.raw("function"), block.function)?;
    same(vector.raw("count"), block.count)
}

fn request<'a>(vector: &Vector, values: &'a [u16]) -> Request<'a> {
    let (unit, function) = (vector.raw("unit"), vector.raw("function"));
    let address = vector.raw("address");
    let request = match function {
        1..=4 => Request::new(unit, function, address, vector.raw("count")),
        _ => Request::write_values(unit, function, address, values),
    };
    match vector.text("framing").as_str() {
        "tcp" => request.tcp(vector.raw("transaction")),
        _ => request,
    }
}
