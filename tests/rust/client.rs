//! The clients over a transport of canned replies: what is sent, and what comes out.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::future::Future;
use std::pin::pin;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::client::{AsyncTransport, LocalTransport, Transport};
use fieldscribe_runtime::modbus::{crc, reply_length, Framing, Profile, Request};
use fieldscribe_runtime::{About, BuildError, ClientError, ReplyError};
use sample_drive::{blocks, commands, enums, exceptions, points, with, Access, AsyncClient, Client, Error, LocalClient};
use sample_drive::{Readable, POINTS, PROFILE};

/// Requests that came, and replies to give, as hexadecimal PDUs behind the unit.
struct Line {
    framing: Framing,
    sent: Vec<String>,
    replies: VecDeque<&'static str>,
}

impl Line {
    fn new(framing: Framing, replies: &[&'static str]) -> Self {
        Self { framing, sent: Vec::new(), replies: replies.iter().copied().collect() }
    }

    fn answer(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, &'static str> {
        let (head, body) = match self.framing {
            Framing::Rtu => request.split_at(0),
            Framing::Tcp => request.split_at(6),
        };
        let end = body.len() - if self.framing == Framing::Rtu { 2 } else { 0 };
        self.sent.push(body[..end].iter().map(|byte| format!("{byte:02x}")).collect());
        if reply.is_empty() {
            return Ok(0);
        }
        let text = self.replies.pop_front().ok_or("nothing came")?;
        let body = (0..text.len()).step_by(2).map(|at| u8::from_str_radix(&text[at..at + 2], 16).unwrap());
        let mut bytes: Vec<u8> = body.collect();
        match self.framing {
            Framing::Rtu => {
                bytes.extend(crc(&bytes).to_le_bytes());
                assert_eq!(reply_length(self.framing, &bytes[..3]), Some(bytes.len()));
            }
            Framing::Tcp => {
                let length = u8::try_from(bytes.len()).unwrap();
                bytes.splice(0..0, [head[0], head[1], 0, 0, 0, length]);
                assert_eq!(reply_length(self.framing, &bytes[..6]), Some(bytes.len()));
            }
        }
        reply[..bytes.len()].copy_from_slice(&bytes);
        Ok(bytes.len())
    }
}

impl Transport for Line {
    type Error = &'static str;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        self.answer(request, reply)
    }
}

struct Slow(Line);

impl AsyncTransport for Slow {
    type Error = &'static str;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        let mut waited = false;
        std::future::poll_fn(|context| {
            if std::mem::replace(&mut waited, true) {
                return Poll::Ready(());
            }
            context.waker().wake_by_ref();
            Poll::Pending
        })
        .await;
        self.0.answer(request, reply)
    }
}

struct Busy;

impl Wake for Busy {
    fn wake(self: Arc<Self>) {}
}

fn finish<T>(future: impl Future<Output = T>) -> T {
    let waker = Waker::from(Arc::new(Busy));
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(value) = future.as_mut().poll(&mut Context::from_waker(&waker)) {
            return value;
        }
    }
}

fn reads_and_writes(framing: Framing) {
    let replies = ["01030201f4", "0106102801f4", "01030201f4", "01030203e7", "0103023fff", "01062012ffff", "018321", "01030404d20001"];
    let mut client = Client::new(Line::new(framing, &replies), framing, 1);
    assert_eq!(client.read::<points::BaseFrequency>(), Ok(50.0));
    assert_eq!(client.write::<points::BaseFrequency>(50.0), Ok(()));
    let ratio = with::VoltageSetpoint { voltage_ratio: 400 };
    assert_eq!(client.read_with::<points::VoltageSetpoint>(ratio), Ok(500.0));
    assert_eq!(client.read::<points::FrequencySource>(), Ok(enums::FrequencySource::Unknown(999)));
    assert_eq!(client.update::<points::DelayClass>(3), Ok(()));
    let refused = client.read::<points::BaseFrequency>().unwrap_err();
    let (code, name) = (exceptions::VALUE_OUT_OF_RANGE, Some("value_out_of_range"));
    assert_eq!(refused, ClientError::Reply(ReplyError::Exception { code, name }, Some(About::Point("base_frequency"))));
    assert_eq!(refused.to_string(), "base_frequency: the device refused with exception 21h (value_out_of_range)");
    assert_eq!(refused.point(), Some("base_frequency"));
    let far = client.write::<points::BaseFrequency>(401.0).unwrap_err();
    assert_eq!(far.to_string(), "base_frequency: 401 Hz is outside 0 to 400 Hz (raw 0 to 4000)");
    let block = blocks::MAIN.iter().find(|block| block.brings::<points::AccelerationTime>()).unwrap();
    let reply = client.exchange(Request::block(1, block)).unwrap().unwrap();
    let raw = reply.raw::<points::AccelerationTime>().unwrap();
    assert_eq!(points::AccelerationTime::decode(raw), 808_714.25);
    assert_eq!(reply.raw::<points::BaseFrequency>(), Err(Error::NotBrought(Some("base_frequency"))));
    assert_eq!(reply.value::<points::AccelerationTime>(), Ok(808_714.25));
    assert_eq!(client.read::<points::BaseFrequency>(), Err(ClientError::Transport("nothing came", Some(About::Point("base_frequency")))));
    let sent = client.into_transport().sent;
    assert_eq!(sent[1..3], ["0106102801f4", "010320080001"]);
    assert_eq!(sent[4..6], ["010320120001", "01062012ffff"]);
    assert_eq!(sent.len(), 9);
}

/// A line that cannot leave its thread.
struct Shared(Rc<RefCell<Line>>);

impl LocalTransport for Shared {
    type Error = &'static str;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        self.0.borrow_mut().answer(request, reply)
    }
}

fn a_transport_may_stay_on_its_thread() {
    let line = Rc::new(RefCell::new(Line::new(Framing::Rtu, &["01030201f4", "0106102801f4", "01030201f4"])));
    let mut shared = Shared(Rc::clone(&line));
    let mut client = LocalClient::new(&mut shared, Framing::Rtu, 1);
    assert_eq!(finish(client.read::<points::BaseFrequency>()), Ok(50.0));
    assert_eq!(finish(client.write_count::<points::BaseFrequency>(500)), Ok(()));
    let mut client = LocalClient::new(shared, Framing::Rtu, 1);
    assert_eq!(finish(client.read_count::<points::BaseFrequency>()), Ok(500));
    assert_eq!(line.borrow().sent[1], "0106102801f4");
}

/// Each kind of client reads what a point needs.
fn needs_are_read() {
    let line = || Line::new(Framing::Rtu, &["0103020190"]);
    let needed = with::VoltageSetpoint { voltage_ratio: 400 };
    assert_eq!(with::VoltageSetpoint::read(&mut Client::new(line(), Framing::Rtu, 1)), Ok(needed));
    let mut client = AsyncClient::new(Slow(line()), Framing::Rtu, 1);
    assert_eq!(finish(with::VoltageSetpoint::read_async(&mut client)), Ok(needed));
    let mut client = LocalClient::new(Shared(Rc::new(RefCell::new(line()))), Framing::Rtu, 1);
    assert_eq!(finish(with::VoltageSetpoint::read_local(&mut client)), Ok(needed));
}

/// A gateway speaks TCP to us where the device knows RTU alone.
fn a_gateway_speaks_another_framing() {
    static RTU: Profile = PROFILE.with_framings(&[Framing::Rtu]);
    static BEHIND_GATEWAY: Profile = RTU.with_framings(&[Framing::Tcp]);
    let line = || Line::new(Framing::Tcp, &["01030201f4"]);
    let mut client = Client::new(line(), Framing::Tcp, 1).with_profile(&RTU);
    let refused = Err(ClientError::Build(BuildError::BadFraming, Some(About::Point("base_frequency"))));
    assert_eq!(client.read::<points::BaseFrequency>(), refused);
    let mut client = Client::new(line(), Framing::Tcp, 1).with_profile(&BEHIND_GATEWAY);
    assert_eq!(client.read::<points::BaseFrequency>(), Ok(50.0));
}

fn points_are_found_by_name_and_code() {
    let found = POINTS.find("base_frequency").unwrap();
    assert_eq!((found.address, found.unit, found.decimals), (0x1028, "Hz", 1));
    assert_eq!(found.access, Access::ReadWrite);
    assert_eq!(found.code.and_then(|code| POINTS.find(code)), Some(found));
    assert_eq!(POINTS.find("base frequency"), None);
}

/// What a point as data needs is read first, and an error says what is wrong with a value.
fn points_are_read_and_written_as_data() {
    let line = || Line::new(Framing::Rtu, &["0103020190", "01030201f4"]);
    let point = |name| POINTS.find(name).unwrap();
    let voltage = point("voltage_setpoint");
    let mut client = Client::new(line(), Framing::Rtu, 1);
    assert_eq!(client.read_point(voltage), Ok(500.0.into()));
    assert_eq!(finish(AsyncClient::new(Slow(line()), Framing::Rtu, 1).read_point(voltage)), Ok(500.0.into()));
    let shared = Shared(Rc::new(RefCell::new(line())));
    assert_eq!(finish(LocalClient::new(shared, Framing::Rtu, 1).read_point(voltage)), Ok(500.0.into()));
    for (name, value, text) in [
        ("base_frequency", "fast", "\"fast\" is not a number"),
        ("frequency_source", "Logic", "\"Logic\" is not a number, nor one of the names keypad, terminal, logic"),
        ("frequency_source", "77", "nothing has the number 77"),
        ("base_frequency", "500", "500 Hz is outside 0 to 400 Hz (raw 0 to 4000)"),
        ("temperature", "no_sensor", "the number is the special code no_sensor and no quantity, which is only read"),
        ("power", "1", "the point is only read"),
        ("running", "1", "the point is only read"),
    ] {
        let error = client.write_point(point(name), value).unwrap_err();
        assert_eq!(error.to_string(), format!("{name}: {text}"));
    }
    let missing = "voltage_setpoint: the raw numbers of other points are missing: voltage_ratio";
    assert_eq!(voltage.decode(500, &[]).unwrap_err().to_string(), missing);
    assert_eq!(voltage.encode(50.0, &[]).unwrap_err().to_string(), missing);
}

/// What an error says, and what its sources say: nothing twice.
fn errors_say_all_once_and_name_the_point() {
    let mut client = Client::new(Line::new(Framing::Rtu, &[]), Framing::Rtu, 1);
    let error = client.write::<points::BaseFrequency>(f64::NAN).unwrap_err();
    assert_eq!(error.to_string(), "base_frequency: the value is not a number");
    let error: ClientError<std::io::Error> = Error::NotANumber("level").into();
    assert_eq!(error.to_string(), "level: the value is not a number");
    assert!(std::error::Error::source(&error).is_none());
    assert_eq!(enums::FrequencySource::Unknown(999).to_string(), "999");
    assert_eq!(enums::FrequencySource::from(1).to_string(), enums::FrequencySource::from(1).name().unwrap());
}

fn all_units_get_a_write_and_none_answers() {
    let mut client = Client::new(Line::new(Framing::Rtu, &[]), Framing::Rtu, 0);
    assert_eq!(client.write::<points::BaseFrequency>(50.0), Ok(()));
    assert!(client.exchange(Request::command(0, &commands::ENTER)).unwrap().is_none());
    let none = client.read::<points::BaseFrequency>().unwrap_err();
    assert_eq!(none, ClientError::Build(BuildError::NotForAll, Some(About::Point("base_frequency"))));
    assert_eq!(none.to_string(), "base_frequency: this cannot be sent to all units");
    assert_eq!(client.into_transport().sent, ["0006102801f4", "000609000001"]);
}

fn waits_without_blocking() {
    let line = Line::new(Framing::Tcp, &["01030201f4", "0106102801f4"]);
    let mut client = AsyncClient::new(Slow(line), Framing::Tcp, 1);
    assert_eq!(finish(client.read::<points::BaseFrequency>()), Ok(50.0));
    assert_eq!(finish(client.write::<points::BaseFrequency>(50.0)), Ok(()));
}

fn a_reply_of_another_space_is_no_point() {
    let replies = ["0103020001", "01010101", "0106102801f4"];
    let mut client = Client::new(Line::new(Framing::Rtu, &replies), Framing::Rtu, 1);
    let mut raw = |request| client.exchange(request).unwrap().unwrap().raw::<points::BaseFrequency>();
    assert_eq!(raw(Request::new(1, 3, 0x1028, 1)), Ok(1));
    assert_eq!(raw(Request::new(1, 1, 0x1028, 1)), Err(Error::WrongSpace(Some("base_frequency"))));
    assert_eq!(raw(Request::write_values(1, 6, 0x1028, &[500])), Ok(500));
}

fn clients_share_a_bus() {
    let mut line = Line::new(Framing::Rtu, &["01030201f4", "02030201f4"]);
    for unit in 1..=2 {
        let mut client = Client::new(&mut line, Framing::Rtu, unit);
        assert_eq!(client.read::<points::BaseFrequency>(), Ok(50.0));
    }
    assert_eq!(line.sent, ["010310280001", "020310280001"]);
    let mut slow = Slow(Line::new(Framing::Rtu, &["01030201f4"]));
    let mut client = AsyncClient::new(&mut slow, Framing::Rtu, 1);
    assert_eq!(finish(client.read::<points::BaseFrequency>()), Ok(50.0));
    assert_eq!(slow.0.sent.len(), 1);
}

/// Executors of several threads take the futures over any transport; this would not compile if they did not.
#[allow(dead_code, reason = "it only has to compile")]
fn futures_are_send<T: AsyncTransport>(client: &mut AsyncClient<T>) {
    fn send<F: Future + Send>(_: F) {}
    send(client.read::<points::BaseFrequency>());
    send(client.write::<points::BaseFrequency>(50.0));
    send(client.update::<points::DelayClass>(3));
    send(with::VoltageSetpoint::read_async(client));
    send(client.read_point(POINTS.find("A020").unwrap()));
    send(client.write_point(POINTS.find("A020").unwrap(), 50.0));
}

fn main() {
    a_reply_of_another_space_is_no_point();
    clients_share_a_bus();
    reads_and_writes(Framing::Rtu);
    reads_and_writes(Framing::Tcp);
    all_units_get_a_write_and_none_answers();
    waits_without_blocking();
    a_transport_may_stay_on_its_thread();
    needs_are_read();
    a_gateway_speaks_another_framing();
    points_are_found_by_name_and_code();
    points_are_read_and_written_as_data();
    errors_say_all_once_and_name_the_point();
}
