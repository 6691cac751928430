//! Reads each point as data; the bus is standard input and output, 13 bytes a frame.

use std::io::{stdin, stdout, Error as IoError, Read, Write};

use fieldscribe_runtime::can::{Frame, Receiver, Transport};
use woodward_mpu2s::telegrams::Visualisation;
use woodward_mpu2s::{Client, POINTS};

struct Pipe;

impl Transport for Pipe {
    type Error = IoError;

    fn send(&mut self, frame: &Frame) -> Result<(), IoError> {
        let mut bytes = [0; 13];
        bytes[..4].copy_from_slice(&frame.id().to_be_bytes());
        bytes[4] = 8;
        bytes[5..].copy_from_slice(frame.bytes());
        stdout().write_all(&bytes)?;
        stdout().flush()
    }

    fn receive(&mut self) -> Result<Frame, IoError> {
        let mut bytes = [0; 13];
        stdin().read_exact(&mut bytes)?;
        Ok(Frame::new(u32::from_be_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]), &bytes[5..]))
    }

    fn pending(&mut self) -> Result<Option<Frame>, IoError> {
        Ok(None)
    }
}

fn main() {
    let mut client = Client::new(Pipe, 3).listening(Receiver::<Visualisation>::new(3));
    for point in POINTS.iter() {
        if let Ok(value) = client.read_point(point) {
            eprintln!("{} 0 {value}", point.name);
        }
    }
}
