//! Ports of embedded-io and embedded-io-async over a line in memory.

use std::collections::VecDeque;
use std::future::{poll_fn, Future};
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::transports::{embedded_io, embedded_io_async, LineError, Protocol};
use fieldscribe_runtime::modbus::{crc, Request};
use hitachi_l200::{points as p, Client, ClientError, Framing, LocalClient, PROFILE};

/// A UART on whose line somebody answers each request with the next bytes, if there are any.
#[derive(Default)]
struct Uart {
    came: VecDeque<u8>,
    sent: Vec<u8>,
    answers: VecDeque<Vec<u8>>,
}

impl Uart {
    fn new(answers: &[&[u8]]) -> Self {
        Self { answers: answers.iter().map(|answer| answer.to_vec()).collect(), ..Self::default() }
    }

    fn take(&mut self, bytes: &mut [u8]) -> usize {
        bytes[0] = self.came.pop_front().unwrap(); // as a UART without a buffer does
        1
    }

    fn answer(&mut self) {
        self.came.extend(self.answers.pop_front().unwrap_or_default());
    }
}

impl ::embedded_io::ErrorType for Uart {
    type Error = ::embedded_io::ErrorKind;
}

impl ::embedded_io::Read for Uart {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        Ok(self.take(bytes))
    }
}

impl ::embedded_io::ReadReady for Uart {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(!self.came.is_empty())
    }
}

impl ::embedded_io::Write for Uart {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        self.sent.push(bytes[0]);
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Self::Error> {
        self.answer();
        Ok(())
    }
}

impl ::embedded_io_async::Read for Uart {
    async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        poll_fn(|_| if self.came.is_empty() { Poll::Pending } else { Poll::Ready(()) }).await;
        Ok(self.take(bytes))
    }
}

impl ::embedded_io_async::Write for Uart {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        self.sent.push(bytes[0]);
        Ok(1)
    }

    async fn flush(&mut self) -> Result<(), Self::Error> {
        self.answer();
        Ok(())
    }
}

fn word(word: u8) -> Vec<u8> {
    let mut reply = vec![1, 3, 2, 0, word];
    reply.extend(crc(&reply).to_le_bytes());
    reply
}

fn blocking() {
    let uart = Uart::new(&[&word(7), b"", &word(8), &[9; 40], &word(9)]);
    let mut waits = 0;
    let line = embedded_io::Line::new(uart, |waited| {
        waits += 1;
        waited < 9
    });
    let mut client = Client::new(line, &PROFILE, Framing::Rtu, 1);
    client.transport().port().came.extend([1, 3, 2, 0]); // half an answer of before
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.7));
    let late = client.read::<p::OutputFrequency>();
    assert_eq!(late, Err(ClientError::Transport(LineError::TimedOut, Some("output_frequency"))));
    client.transport().port().came.extend(word(66));
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.8));
    assert!(matches!(client.read::<p::OutputFrequency>(), Err(ClientError::Reply(..))));
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.9));
    assert!(client.exchange(Request::write::<p::BaseFrequency>(0, 500)).unwrap().is_none());
    assert_eq!(client.transport().port().sent.len(), 6 * 8);
    assert_eq!(waits, 10);
}

/// P1082 is 50 Hz; the answer is that of the manual's form, with the checksum over all bytes.
fn uss() {
    use siemens_mm4::{points as p, Client, Link, PROFILE};

    let mut answer = vec![2, 10, 3, 0x24, 0x3A, 0, 0, 0x42, 0x48, 0, 0];
    answer.push(answer.iter().fold(0, |check, byte| check ^ byte));
    let line = embedded_io::Line::speaking(Protocol::Uss, Uart::new(&[&answer]), |_| false);
    let mut client = Client::new(line, &PROFILE, Link::new(127, 0), 3);
    assert_eq!(client.read::<p::MaximumFrequency>(), Ok(50.0));
}

struct Busy;

impl Wake for Busy {
    fn wake(self: Arc<Self>) {}
}

/// What a future gives when it is asked once.
fn asked<T>(future: impl Future<Output = T>) -> Option<T> {
    let waker = Waker::from(Arc::new(Busy));
    match pin!(future).poll(&mut Context::from_waker(&waker)) {
        Poll::Ready(value) => Some(value),
        Poll::Pending => None,
    }
}

fn not_blocking() {
    let line = embedded_io_async::Line::new(Uart::new(&[&word(7), b"", &word(8)]));
    let mut client = LocalClient::new(line, &PROFILE, Framing::Rtu, 1);
    assert_eq!(asked(client.read::<p::OutputFrequency>()), Some(Ok(0.7)));
    assert_eq!(asked(client.read::<p::OutputFrequency>()), None); // dropped: the executor's time is over
    client.transport().port().came.extend(word(66));
    assert_eq!(asked(client.read::<p::OutputFrequency>()), Some(Ok(0.8)));
}

fn main() {
    blocking();
    uss();
    not_blocking();
}
