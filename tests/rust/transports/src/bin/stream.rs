//! A serial port on a server of pymodbus, and a line whose other end is late and noisy.

use std::io::{ErrorKind, Read, Write};
use std::os::unix::net::UnixStream;
use std::thread::{sleep, spawn};
use std::time::Duration;

use hitachi_l200::runtime::modbus::crc;
use hitachi_l200::runtime::transports::stream::StreamLine;
use hitachi_l200::{points as p, Client, ClientError, Framing, Transport};

const QUICK: Duration = Duration::from_millis(200);

fn talks(device: &str) {
    let port = serialport::new(device, 9600).timeout(Duration::from_millis(500)).open().unwrap();
    let mut client = Client::new(StreamLine::new(port), Framing::Rtu, 1);
    client.write::<p::BaseFrequency>(50.0).unwrap();
    assert_eq!(client.read::<p::BaseFrequency>().unwrap(), 50.0);
}

fn word(word: u8) -> Vec<u8> {
    let mut reply = vec![1, 3, 2, 0, word];
    reply.extend(crc(&reply).to_le_bytes());
    reply
}

fn a_failure_is_waited_out() {
    let (near, mut far) = UnixStream::pair().unwrap();
    near.set_read_timeout(Some(QUICK)).unwrap();
    spawn(move || {
        let mut request = [0; 8];
        for number in 0.. {
            if far.read_exact(&mut request).is_err() {
                return;
            }
            let reply = match number {
                1 => {
                    sleep(QUICK + QUICK / 10); // comes when the next request may have been sent
                    word(99)
                }
                3 => [&[0x01, 0x03], &word(98)[..], &word(97)].concat(),
                _ => word(7),
            };
            far.write_all(&reply).unwrap();
        }
    });
    let mut client = Client::new(StreamLine::new(near), Framing::Rtu, 1);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7);
    let Err(ClientError::Transport(late, _)) = client.read::<p::OutputFrequency>() else { panic!() };
    assert!(matches!(late.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock));
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7);
    assert!(matches!(client.read::<p::OutputFrequency>(), Err(ClientError::Reply(..))));
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7);
}

fn nobody_answers_for_all() {
    let (near, mut far) = UnixStream::pair().unwrap();
    let mut line = StreamLine::new(near);
    assert_eq!(line.exchange(b"\x00\x05\x00\x00\xFF\x00\x8D\xEB", &mut []).unwrap(), 0);
    let mut sent = [0; 8];
    far.read_exact(&mut sent).unwrap();
}

fn main() {
    talks(&std::env::args().nth(1).unwrap());
    a_failure_is_waited_out();
    nobody_answers_for_all();
}
