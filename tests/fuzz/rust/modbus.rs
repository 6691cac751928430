//! Answers of Modbus devices through the parser in Rust.

mod cases;

use std::io::BufWriter;

use cases::{say, Cases};
use fieldscribe_runtime::modbus::Request;
use fieldscribe_runtime::ReplyError;

fn main() {
    let mut cases = Cases::read();
    let mut out = BufWriter::new(std::io::stdout().lock());
    while cases.more() {
        let tcp = cases.byte() != 0;
        let (unit, function) = (cases.byte(), cases.byte());
        let (address, count, transaction, number) =
            (cases.word(), cases.word(), cases.word(), cases.word());
        let frame = cases.frame();
        let coils = matches!(function, 5 | 15);
        let value = |at: u16| if coils { number >> (at % 16) & 1 } else { number };
        let values: Vec<u16> = (0..count).map(value).collect();
        let request = if function <= 4 {
            Request::new(unit, function, address, count)
        } else {
            Request::write_values(unit, function, address, &values)
        };
        let request = if tcp { request.tcp(transaction) } else { request };
        let mut words = Vec::new();
        match request.parse(&frame) {
            Ok(reply) => {
                words.extend(["ok".to_owned(), "0".to_owned()]);
                words.extend(reply.items().map(|item| item.to_string()));
            }
            Err(ReplyError::Exception { code, .. }) => words.extend(["exception".to_owned(), code.to_string()]),
            Err(error) => words.extend([error.name().to_owned(), "0".to_owned()]),
        }
        say(&mut out, &words);
    }
}
