//! Answers of USS drives through the parser in Rust, with the tasks of `kitchen_uss`.

mod cases;

use std::io::BufWriter;

use cases::{say, Cases};
use fieldscribe_runtime::uss::{Link, Request, Value};
use fieldscribe_runtime::ReplyError;

fn main() {
    let mut cases = Cases::read();
    let mut out = BufWriter::new(std::io::stdout().lock());
    while cases.more() {
        let link = Link::new(cases.byte(), cases.byte());
        let link = if cases.byte() != 0 { link.single_first() } else { link };
        let request = Request::new(cases.byte(), cases.byte(), cases.word(), cases.word());
        let frame = cases.frame();
        let found = request.parse(&kitchen_uss::PROFILE, link, &frame);
        let (status, response, error) = match found {
            Ok(reply) => ("ok", reply.response(), 0),
            Err(ReplyError::Refused { error, .. }) => ("refused", 7, error),
            Err(error) => (error.name(), 0, 0),
        };
        let (width, value) = match found.map_or(Value::Nothing, |reply| reply.value()) {
            Value::Nothing => (0, 0),
            Value::Word(word) => (1, u32::from(word)),
            Value::Double(value) => (2, value),
        };
        let mut words = vec![status.to_owned()];
        words.extend([u32::from(response), width, value, u32::from(error)].map(|one| one.to_string()));
        if !matches!(found, Err(ReplyError::WrongLength)) {
            if let Ok(process) = request.process_words(link, &frame) {
                words.extend(process.map(|word| word.to_string()));
            }
        }
        say(&mut out, &words);
    }
}
