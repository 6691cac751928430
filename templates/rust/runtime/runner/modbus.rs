// SPDX-License-Identifier: 0BSD
//! Vectors of Modbus frames and of batched reads.

use fieldscribe_runtime::modbus::{Block, BuildError, Profile, ReplyError, Request, LONGEST};

use super::{same, Outcome, Vector};

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
        Err(ReplyError::Exception(code)) => ("exception", Vec::new(), code),
        Err(error) => (error.name(), Vec::new(), 0),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("values_out"), items)?;
    same(vector.count("exception"), exception)
}

/// A batched read.
pub fn block(vector: &Vector, blocks: &[(&str, &[Block])]) -> Outcome {
    let group = blocks
        .iter()
        .find(|(name, _)| *name == vector.text("group"));
    let index = usize::from(vector.raw::<u16>("index"));
    let block = group.and_then(|(_, blocks)| blocks.get(index));
    let block = block.ok_or_else(|| "there is no such block".to_owned())?;
    same(vector.text("space").as_str(), block.space.name())?;
    same(vector.raw("function"), block.function)?;
    same(vector.raw("address"), block.address)?;
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
