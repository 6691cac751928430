//! Reads each point as data; the line is standard input and output.

use std::io::{stdin, stdout, Error as IoError, Read, Write};

use fieldscribe_runtime::client::Transport;
use fieldscribe_runtime::uss::Link;
use siemens_mm4::{Client, POINTS};

struct Pipe;

impl Transport for Pipe {
    type Error = IoError;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, IoError> {
        stdout().write_all(request)?;
        stdout().flush()?;
        stdin().read_exact(&mut reply[..2])?;
        let end = usize::from(reply[1]) + 2;
        stdin().read_exact(&mut reply[2..end])?;
        Ok(end)
    }
}

fn main() {
    let mut client = Client::new(Pipe, Link::new(127, 4), 1);
    for point in POINTS.iter() {
        if let Ok(value) = client.read_point(point) {
            eprintln!("{} 0 {value}", point.name);
        }
    }
}
