//! Ports of embedded-io and embedded-io-async over a line in memory.

use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::modbus::Request;
use fieldscribe_runtime::transports::{embedded_io, embedded_io_async, LineError, Protocol};
use fieldscribe_runtime::About;
use hitachi_l200::{points as p, Client, ClientError, Framing, LocalClient};
use programs::uart::{word, Uart};

fn blocking() {
    let uart = Uart::new(&[&word(7), b"", &word(8), &[9; 40], &word(9)]);
    let mut waits = 0;
    let line = embedded_io::Line::new(uart, |waited| {
        waits += 1;
        waited < 9
    });
    let mut client = Client::new(line, Framing::Rtu, 1);
    client.transport().port().came.extend([1, 3, 2, 0]); // half an answer of before
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.7));
    let late = client.read::<p::OutputFrequency>();
    assert_eq!(late, Err(ClientError::Transport(LineError::TimedOut, Some(About::Point("output_frequency")))));
    client.transport().port().came.extend(word(66));
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.8));
    assert!(matches!(client.read::<p::OutputFrequency>(), Err(ClientError::Reply(..))));
    assert_eq!(client.read::<p::OutputFrequency>(), Ok(0.9));
    assert!(client.exchange(Request::write::<p::BaseFrequency>(0, 500)).unwrap().is_none());
    assert_eq!(client.transport().port().sent.len(), 6 * 8);
    assert_eq!(waits, 20); // once for the answer that did not come, once before the next request
}

/// P1082 is 50 Hz; the answer is that of the manual's form, with the checksum over all bytes.
fn uss() {
    use siemens_mm4::{points as p, Client, Link};

    let mut answer = vec![2, 10, 3, 0x24, 0x3A, 0, 0, 0x42, 0x48, 0, 0];
    answer.push(answer.iter().fold(0, |check, byte| check ^ byte));
    let line = embedded_io::Line::speaking(Protocol::Uss, Uart::new(&[&answer]), |_| false);
    let mut client = Client::new(line, Link::new(127, 0), 3);
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
    let mut client = LocalClient::new(line, Framing::Rtu, 1);
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
