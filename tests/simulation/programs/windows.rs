//! Reads and writes points of a window in the order of support/windows.py: `windows PORT HOW`.

use std::env::args;
use std::fmt::Display;
use std::future::{ready, Future};
use std::io::{Error, Read, Write};
use std::net::TcpStream;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::modbus::Request;
use fieldscribe_runtime::{AsyncTransport, ClientError, LocalTransport, Transport};
use kitchen_sink::{points as p, AsyncClient, Client, Framing, LocalClient, POINTS};

struct Line(TcpStream);

impl Line {
    fn asked(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
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

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
        self.asked(request, reply)
    }
}

struct Idle;

impl Wake for Idle {
    fn wake(self: Arc<Self>) {}
}

fn now<F: Future>(future: F) -> F::Output {
    match pin!(future).poll(&mut Context::from_waker(&Waker::from(Arc::new(Idle)))) {
        Poll::Ready(found) => found,
        Poll::Pending => panic!("nothing waits here"),
    }
}

fn shown<T: Display>(found: Result<T, ClientError<Error>>) {
    match found {
        Ok(number) => println!("ok {number}"),
        Err(error) => println!("{}", error.name()),
    }
}

fn done(found: Result<(), ClientError<Error>>) {
    println!("{}", found.map_or_else(|error| error.name(), |()| "ok"));
}

macro_rules! in_order {
    ($client:ident $($wait:tt)*) => {
        shown($client.read_count::<p::InputDelayIndex2>()$($wait)*);
        shown($client.read::<p::InputCounterIndex2>()$($wait)*);
        shown($client.read_raw::<p::Page>()$($wait)*);
        shown($client.read_count::<p::InputDelayIndex2>()$($wait)*);
        done($client.write_count::<p::InputDelayIndex3>(45)$($wait)*);
        shown($client.read_raw::<p::OutputMode>()$($wait)*);
        shown($client.read_count::<p::InputDelayIndex3>()$($wait)*);
        done($client.write_raw::<p::Page>(0)$($wait)*);
        shown($client.read_count::<p::InputDelayIndex3>()$($wait)*);
        done($client.write_count::<p::InputDelayIndex1>(501)$($wait)*);
        shown($client.read_count::<p::InputDelayIndex3>()$($wait)*);
        done($client.exchange(Request::new(1, 3, 0x7FFF, 1))$($wait)*.map(|_| ()));
        shown($client.read_count::<p::InputDelayIndex3>()$($wait)*);
    };
}

macro_rules! by_name {
    ($client:ident $($wait:tt)*) => {
        let point = |name| POINTS.find(name).unwrap();
        let [delay_1, delay_2, delay_3] =
            ["input_delay_index_1", "input_delay_index_2", "input_delay_index_3"].map(point);
        shown($client.read_point(delay_2)$($wait)*);
        shown($client.read_point(point("input_counter_index_2"))$($wait)*);
        shown($client.read_point(point("page"))$($wait)*);
        shown($client.read_point(delay_2)$($wait)*);
        done($client.write_point(delay_3, 4.5)$($wait)*);
        shown($client.read_point(point("output_mode"))$($wait)*);
        shown($client.read_point(delay_3)$($wait)*);
        done($client.write_point(point("page"), "system")$($wait)*);
        shown($client.read_point(delay_3)$($wait)*);
        done($client.write_point(delay_1, 50.1)$($wait)*);
        shown($client.read_point(delay_3)$($wait)*);
        done($client.exchange(Request::new(1, 3, 0x7FFF, 1))$($wait)*.map(|_| ()));
        shown($client.read_point(delay_3)$($wait)*);
    };
}

fn main() {
    let [port, how] = [1, 2].map(|place| args().nth(place).unwrap());
    let line = Line(TcpStream::connect(format!("127.0.0.1:{port}")).unwrap());
    match how.as_str() {
        "blocking" => {
            let mut client = Client::new(line, Framing::Tcp, 1);
            in_order!(client);
        }
        "async" => {
            let mut client = AsyncClient::new(line, Framing::Tcp, 1);
            now(async { in_order!(client .await); });
        }
        "local" => {
            let mut client = LocalClient::new(line, Framing::Tcp, 1);
            now(async { in_order!(client .await); });
        }
        _ => {
            let mut client = AsyncClient::new(line, Framing::Tcp, 1);
            now(async { by_name!(client .await); });
        }
    }
}
