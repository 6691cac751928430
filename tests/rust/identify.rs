//! What the device at an address says that it is, by the client that blocks and by those that do not: `identify PLACE`.

use std::env::args;
use std::future::{ready, Future};
use std::io::{Error, Read, Write};
use std::net::TcpStream;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::{AsyncTransport, ClientError, LocalTransport, OtherDevice, Transport, Variants};
use kitchen_sink::{AsyncClient, Client, Framing, LocalClient, IDENTIFICATIONS};

/// A connection, and how many requests went over it.
struct Line(TcpStream, usize);

impl Line {
    fn new() -> Self {
        Self(TcpStream::connect(args().nth(1).unwrap()).unwrap(), 0)
    }

    fn asked(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
        self.1 += 1;
        self.0.write_all(request)?;
        self.0.read_exact(&mut reply[..6])?;
        let end = 6 + usize::from(reply[5]);
        self.0.read_exact(&mut reply[6..end])?;
        Ok(end)
    }
}

impl Transport for Line {
    type Error = Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
        self.asked(request, reply)
    }
}

impl AsyncTransport for Line {
    type Error = Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> impl Future<Output = Result<usize, Error>> + Send {
        ready(self.asked(request, reply))
    }
}

impl LocalTransport for Line {
    type Error = Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> impl Future<Output = Result<usize, Error>> {
        ready(self.asked(request, reply))
    }
}

struct Busy;

impl Wake for Busy {
    fn wake(self: Arc<Self>) {}
}

fn finish<T>(future: impl Future<Output = T>) -> T {
    match pin!(future).poll(&mut Context::from_waker(&Waker::from(Arc::new(Busy)))) {
        Poll::Ready(value) => value,
        Poll::Pending => panic!("a transport that is ready was waited for"),
    }
}

fn told(requests: usize, found: Result<Result<Variants, OtherDevice>, ClientError<Error>>) {
    match found.unwrap() {
        Ok(found) => {
            let all: Vec<String> = found.iter().map(|(axis, value)| format!("{axis}={value}")).collect();
            assert!(found.iter().all(|(axis, value)| found.value(axis) == Some(value)));
            println!("{requests} {}", all.join(" "));
        }
        Err(other) => println!("{requests} {other}"),
    }
}

fn main() {
    let mut client = Client::new(Line::new(), Framing::Tcp, 1);
    let found = client.identify(IDENTIFICATIONS);
    told(client.transport().1, found);
    let mut client = AsyncClient::new(Line::new(), Framing::Tcp, 1);
    let found = finish(client.identify(IDENTIFICATIONS));
    told(client.transport().1, found);
    let mut client = LocalClient::new(Line::new(), Framing::Tcp, 1);
    let found = finish(client.identify(IDENTIFICATIONS));
    told(client.transport().1, found);
}
