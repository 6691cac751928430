// SPDX-License-Identifier: 0BSD
//! Vectors of Modbus frames and of batched reads.

use fieldscribe_runtime::modbus::{
    AsyncClient, Base, Block, Client, Command, FoundBlock, Framing, GivenBase, Profile, Request,
    SteppedCommand, LONGEST,
};
use fieldscribe_runtime::{
    BitGroup, BuildError, ClientError, Decoded, Encodable, Error, Point, PointInfo, Readable,
    ReplyError, Whole, Writable, WrittenAlone,
};

use super::clients::exchanged;
pub use super::modbus_clients::check;
use super::{same, Number, Outcome, Script, Vector};

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

fn blocking(vector: &Vector, profile: &'static Profile, name: &'static str) -> Client<Script> {
    let (script, unit) = (Script::new(vector), vector.raw("unit"));
    let mut client = Client::for_profile(script, profile, framing(vector), unit);
    client.set_base(base(vector, name));
    client
}

fn waiting(vector: &Vector, profile: &'static Profile, name: &'static str) -> AsyncClient<Script> {
    let (script, unit) = (Script::new(vector), vector.raw("unit"));
    let mut client = AsyncClient::for_profile(script, profile, framing(vector), unit);
    client.set_base(base(vector, name));
    client
}

with_clients!(
    Script,
    fieldscribe_runtime::Point,
    fieldscribe_runtime::WrittenAlone
);

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

/// A point that cannot be read is written as it is; one that others select by a client, which writes these first.
pub fn write_only<P>(vector: &Vector, profile: &'static Profile) -> Outcome
where
    P: Writable<Raw: Number> + Whole + WrittenAlone,
{
    if !P::SELECTS.is_empty() {
        same(
            true,
            crate::written_data_of(vector, P::INFO.any()).is_some(),
        )?;
        return write_data(vector, profile, P::INFO.any());
    }
    let unit = vector.raw("unit");
    let request = Request::write::<P>(unit, vector.raw("raw")).at(&base(vector, P::BASE));
    let mut client = Client::for_profile(Script::new(vector), profile, framing(vector), unit);
    let found = client.exchange(request).map(|_| ());
    exchanged(vector, found, &client.into_transport()).map(|_| ())
}

/// What the device takes only with other points is not written alone, before any request.
pub fn alone<P: Point>(vector: &Vector, profile: &'static Profile) -> Outcome {
    let raw = vector.number("raw").unwrap_or_default();
    both!(vector, profile, P::BASE, |client| client
        .write_point(P::INFO.any(), raw));
    same(false, P::INFO.written_with().is_empty())
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

/// Where a base is that follows from given numbers, or the start of a block: that is found in the first requests.
pub fn base_of(
    vector: &Vector,
    profile: &'static Profile,
    given: &[GivenBase],
    blocks: &[FoundBlock],
) -> Outcome {
    let (name, status) = (vector.text("base"), vector.text("status"));
    let expected = (vector.number("start"), vector.number("last"));
    let (found, said) = if let Some(base) = given.iter().find(|base| base.name == name) {
        let numbers = vector.pairs("given").into_iter();
        let numbers: Vec<u16> = numbers.filter_map(|(_, text)| text.parse().ok()).collect();
        let _ = vector.said("script");
        (base.at(&numbers), "bad_base")
    } else {
        let block = blocks.iter().find(|block| block.name == name);
        let block = block.ok_or_else(|| "there is no such base".to_owned())?;
        same(None, vector.said("given"))?;
        let mut client = blocking(vector, profile, "");
        let found = client.find(block);
        client.into_transport().keeps_to_it()?;
        match found {
            Ok(None) if status == "no_marker" => (None, "no_marker"),
            Ok(found) => (found, "no_block"),
            Err(ClientError::Build(BuildError::BadAddress, _)) => (None, "bad_chain"),
            Err(error) => (None, error.name()),
        }
    };
    same(status.as_str(), if found.is_some() { "ok" } else { said })?;
    same(found.is_some(), found.is_some_and(|base| base.name == name))?;
    let found = found.map(|base| (i128::from(base.start), i128::from(base.last)));
    same(expected, found.unzip())
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
