//! CAN clients over a bus of canned frames: what is sent, what comes out, what receivers make of the frames between.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::future::Future;
use std::pin::pin;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::can::{
    AsyncTransport, Content, Frame, Hears, Listener, LocalTransport, ParseError, Receiver, Transport,
};
use fieldscribe_runtime::{identifications, About, BuildError, ClientError, Identification, OtherDevice, ReplyError, Text};
use odd_can::OddCan;
use odd_can::{enums, flags, messages, points, telegrams, with, AsyncClient, Client, Error, LocalClient, PROFILE};

/// A device that answers from its memory, with other frames before each answer.
#[derive(Default)]
struct Bus {
    sent: Vec<String>,
    memory: std::collections::BTreeMap<u16, u16>,
    waiting: VecDeque<Frame>,
    noise: Vec<Frame>,
    later: VecDeque<Frame>,
}

impl Bus {
    fn new(words: &[(u16, u16)], noise: Vec<Frame>) -> Self {
        Self { memory: words.iter().copied().collect(), noise, ..Self::default() }
    }

    /// The same bus with frames that come when all others have come.
    fn then(self, frames: &[Frame]) -> Self {
        Self { later: frames.iter().copied().collect(), ..self }
    }

    fn answer(&mut self, frame: &Frame) {
        self.sent.push(frame.bytes().iter().map(|byte| format!("{byte:02x}")).collect());
        self.waiting.extend(self.noise.drain(..));
        let unit = frame.bytes()[1];
        let message = if let Ok(content) = messages::WRITE_REQUEST.parse(unit, frame) {
            self.memory.insert(content.address, content.raw);
            messages::WRITE_ANSWER
        } else {
            messages::READ_ANSWER
        };
        let address = u16::from_be_bytes([frame.bytes()[2], frame.bytes()[3]]);
        if let Some(word) = self.memory.get(&address) {
            // An answer about another address comes first.
            self.waiting.push_back(message.build(&PROFILE, unit, address + 1, 7).unwrap());
            self.waiting.push_back(message.build(&PROFILE, unit, address, *word).unwrap());
        }
    }

    fn next(&mut self) -> Result<Frame, &'static str> {
        self.waiting.pop_front().or_else(|| self.later.pop_front()).ok_or("nothing came")
    }
}

impl Transport for Bus {
    type Error = &'static str;

    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        self.answer(frame);
        Ok(())
    }

    fn receive(&mut self) -> Result<Frame, Self::Error> {
        self.next()
    }

    fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(self.waiting.pop_front())
    }
}

struct Slow(Bus);

async fn pause() {
    let mut waited = false;
    std::future::poll_fn(|context| {
        context.waker().wake_by_ref();
        if std::mem::replace(&mut waited, true) { Poll::Ready(()) } else { Poll::Pending }
    })
    .await;
}

impl AsyncTransport for Slow {
    type Error = &'static str;

    async fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        pause().await;
        self.0.answer(frame);
        Ok(())
    }

    async fn receive(&mut self) -> Result<Frame, Self::Error> {
        pause().await;
        self.0.next()
    }

    async fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(self.0.waiting.pop_front())
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

fn part(multiplexer: u8, words: [u16; 3]) -> Frame {
    let mut data = vec![0xDD, multiplexer];
    data.extend(words.iter().flat_map(|word| word.to_be_bytes()));
    Frame::new(0x325, &data)
}

fn told<T: std::fmt::Debug, E: std::fmt::Debug>(found: Result<T, ClientError<E>>, name: &str) {
    let Err(ClientError::Point(error)) = found else { panic!("{found:?}") };
    assert_eq!(error.name(), name);
}

fn parameters_are_read_and_written() {
    let mut memory: Vec<(u16, u16)> = (732..740).map(|address| (address, 0)).collect();
    memory.extend([(507, 200), (10, 0x0064), (19, 0xC0F0), (404, 1050), (407, 9), (30, 0)]);
    let mut client = Client::new(Bus::new(&memory, vec![part(0, [5000, 0, 0])]), 5);
    assert_eq!(client.read::<points::Ratio>(), Ok(200));
    assert_eq!(client.read_with::<points::Level>(with::Level { ratio: 200 }), Ok(200.0));
    assert_eq!(client.write_with::<points::Level>(400.0, with::Level { ratio: 200 }), Ok(()));
    assert_eq!(client.write::<points::Target>(45.0), Ok(()));
    told(client.write::<points::Target>(90.0), "out_of_range");
    assert_eq!(client.read::<points::Mode>(), Ok(3));
    assert_eq!(client.update::<points::Mode>(0), Ok(()));
    assert_eq!(client.write::<points::Control>(flags::Control(0x8000)), Ok(()));
    let digits = client.read::<points::Delays>().unwrap();
    assert_eq!(digits.map(u16::from), [1, 0, 5, 0]);
    assert_eq!(client.write::<points::Delays>([enums::Digit::Late; 4]), Ok(()));
    let unknown = client.write::<points::Delays>([enums::Digit::from(3); 4]);
    told(unknown, "unknown_value");
    assert_eq!(client.write::<points::Name>("Genset 1".try_into().unwrap()), Ok(()));
    let read = client.read::<points::Name>().unwrap();
    assert_eq!((read.as_str(), read.to_string().as_str()), (Some("Genset 1"), "Genset 1"));
    assert_eq!(format!("{read:?}"), "\"Genset 1\"");
    let umlaut = client.write::<points::Name>(Text::new("Gerät").unwrap());
    assert_eq!(umlaut, Err(ClientError::Point(Error::BadText(Some("name")))));
    assert_eq!(client.write::<points::Password>(1234), Ok(()));
    assert_eq!(client.read_word(999), Err(ClientError::Transport("nothing came", None)));
    let bus = client.into_transport();
    assert_eq!(bus.sent[0], "ff0501fb0000fefe");
    assert!(bus.sent.contains(&"ee05000b2d00c30e".to_owned()));
    assert_eq!(bus.memory[&10], 200);
    assert_eq!(bus.memory[&19], 0x0001);
    assert_eq!(bus.memory[&30], 0x8406);
    assert_eq!(bus.memory[&404], 5555);
    assert_eq!((bus.memory[&739], bus.memory[&736], bus.memory[&732]), (0x4765, 0x2031, 0x2020));
}

fn receivers_hear_what_others_are_told() {
    let noise = vec![part(0, [5000, 7, 0xFE00]), part(2, [0, 0, 4]), part(1, [0, 0, 1]), part(2, [9, 0, 4])];
    let later = [part(1, [0, 0, 1]), part(0, [4900, 7, 0xFE00]), part(0, [4900, 8, 0xFF00]), part(0, [0, 9, 0])];
    let bus = Bus::new(&[(407, 1)], noise).then(&later);
    let mut client = Client::new(bus, 5).listening(Receiver::<telegrams::Measured>::new(5));
    assert_eq!(client.read::<points::Actual>(), Ok(1));
    assert_eq!(client.listener().raw::<points::Frequency>(), Ok(5000));
    // Its high word came once: nobody knows whether it was the same before the low one.
    assert_eq!(client.listener().raw::<points::Hours>(), Err(Error::Torn(Some("hours"))));
    assert_eq!(client.listener().raw::<points::Starts>(), Err(Error::NotReceived(Some("starts"))));
    // What was heard before is not taken for what is true now.
    assert_eq!(client.receive::<points::Frequency>(), Ok(49.0));
    assert_eq!(client.listener().raw::<points::Hours>(), Ok(0x0001_0009));
    let exponent = client.receive::<points::Exponent>().unwrap();
    assert_eq!(client.receive_with::<points::Power>(with::Power { exponent }), Ok(0.9));
    assert_eq!(client.receive::<points::Hours>(), Err(ClientError::Transport("nothing came", Some(About::Point("hours")))));
    let mut client = client.patient(0);
    assert_eq!(client.receive::<points::Hours>(), Err(ClientError::Point(Error::NotReceived(Some("hours")))));
    assert_eq!(client.read_word(407), Err(ClientError::Reply(ReplyError::NoAnswer, None)));
}

fn numbers_of_two_frames_are_waited_for() {
    let [high, low] = [part(1, [0, 0, 1]), part(2, [9, 0, 0])];
    let bus = Bus::default().then(&[low, high, low, high, low]);
    let mut client = Client::new(bus, 5).listening(Receiver::<telegrams::Measured>::new(5));
    assert_eq!(client.receive::<points::Hours>(), Ok(0x0001_0009));
    let bus = client.into_transport();
    assert_eq!(bus.later.len(), 1);
    let bus = Bus::default().then(&[low, high, part(2, [9, 0, 0]), part(1, [0, 0, 2])]);
    let mut client = Client::new(bus, 5).listening(Receiver::<telegrams::Measured>::new(5)).patient(4);
    assert_eq!(client.receive::<points::Hours>(), Err(ClientError::Point(Error::Torn(Some("hours")))));
}

/// A device that takes the nearest number it likes.
fn other_numbers_are_told() {
    let nearest = messages::WRITE_ANSWER.build(&PROFILE, 5, 507, 399).unwrap();
    let bus = Bus::new(&[(507, 1)], vec![nearest]);
    let mut client = Client::new(bus, 5);
    let told = ClientError::Reply(ReplyError::OtherNumber { written: 400, answered: Some(399) }, Some(About::Point("ratio")));
    assert_eq!(client.write::<points::Ratio>(400), Err(told));
}

fn listeners_are_lent_and_paired() {
    let mut receiver = Receiver::<telegrams::Measured>::new(5);
    let mut bus = Bus::new(&[(407, 1)], vec![part(3, [1, 2, 3]), Frame::new(1, &[0; 9])]);
    let pair = (&mut receiver, Receiver::<telegrams::Telegram>::new(5));
    let mut client = Client::new(&mut bus, 5).listening(pair);
    assert_eq!(client.read::<points::Actual>(), Ok(1));
    assert_eq!(receiver.raw::<points::Starts>(), Ok(0x0001_0002));
    assert_eq!(receiver.word(9), Ok(1));
    assert_eq!(receiver.word(19), Err(Error::NotReceived(None)));
    assert_eq!(receiver.word(u16::MAX), Err(Error::NotReceived(None)));
}

/// The receivers of two telegrams, for both of which a client can wait.
struct Both(Receiver<telegrams::Measured>, Receiver<telegrams::Telegram>);

impl Listener for Both {
    fn hear(&mut self, frame: &Frame) {
        self.0.hear(frame);
        self.1.hear(frame);
    }
}

impl Hears<telegrams::Measured> for Both {
    fn receiver(&self) -> &Receiver<telegrams::Measured> {
        &self.0
    }
}

fn a_listener_of_several_telegrams_waits_for_each() {
    let bus = Bus::default().then(&[part(3, [1, 2, 3]), part(0, [4900, 0, 0])]);
    let both = Both(Receiver::new(5), Receiver::new(5));
    let mut client = Client::new(bus, 5).listening(both);
    assert_eq!(client.receive::<points::Frequency>(), Ok(49.0));
    let missing = client.patient(0).receive::<points::Starts>().unwrap_err();
    assert_eq!(missing.to_string(), "starts: the frame with the word never came");
}

fn units_are_checked() {
    let mut client = Client::new(Bus::default(), 31);
    assert_eq!(client.read::<points::Ratio>(), Err(ClientError::Build(BuildError::BadUnit, Some(About::Point("ratio")))));
    assert!(client.into_transport().sent.is_empty());
}

/// Constants, unit and checksum of a cyclic message count as they do in an answer.
fn wrong_bytes_are_of_no_telegram() {
    const RIGHT: [u8; 8] = [5, 5, 0x34, 0x12, 0, 0, 5 ^ 0x34, 5 ^ 0x12];
    let mut receiver = Receiver::<telegrams::Telegram>::new(5);
    let expected = [
        (0, ParseError::WrongConstant),
        (1, ParseError::WrongUnit),
        (2, ParseError::WrongCheck),
        (3, ParseError::WrongCheck),
        (4, ParseError::WrongConstant),
        (5, ParseError::WrongConstant),
        (6, ParseError::WrongCheck),
        (7, ParseError::WrongCheck),
    ];
    for (place, reason) in expected {
        let mut bytes = RIGHT;
        bytes[place] ^= 0x20;
        let frame = Frame::new(messages::MESSAGE.id(5), &bytes);
        assert!(!receiver.take(&frame), "byte {place}");
        assert_eq!(messages::MESSAGE.parse(5, &frame), Err(reason), "byte {place}");
    }
    assert!(receiver.take(&Frame::new(messages::MESSAGE.id(5), &RIGHT)));
    assert_eq!(receiver.word(0), Ok(0x1234));
    let mut nobody = Receiver::<telegrams::Telegram>::new(31);
    let frame = Frame::new(messages::MESSAGE.id(31), &[5, 31, 0, 0, 0, 0, 5, 31]);
    assert_eq!(messages::MESSAGE.parse(31, &frame), Ok(Content::default()));
    assert!(!nobody.take(&frame));
}

fn is_send<T: Send>(_: &T) {}

fn waits_without_blocking() {
    let bus = Bus::new(&[(507, 200)], vec![]).then(&[part(0, [100, 0, 0])]);
    let mut client = AsyncClient::new(Slow(bus), 5).listening(Receiver::<telegrams::Measured>::new(5));
    assert_eq!(finish(client.read::<points::Ratio>()), Ok(200));
    assert_eq!(finish(client.write::<points::Ratio>(300)), Ok(()));
    assert_eq!(finish(client.receive_count::<points::Frequency>()), Ok(100));
    assert_eq!(client.listener().count::<points::Frequency>(), Ok(100));
    is_send(&client.write::<points::Ratio>(300));
    is_send(&client.receive::<points::Frequency>());
    assert_eq!(client.into_transport().0.memory[&507], 300);
}

/// A bus that cannot leave its thread.
struct Shared(Rc<RefCell<Bus>>);

impl LocalTransport for Shared {
    type Error = &'static str;

    async fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        self.0.borrow_mut().answer(frame);
        Ok(())
    }

    async fn receive(&mut self) -> Result<Frame, Self::Error> {
        self.0.borrow_mut().next()
    }

    async fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(self.0.borrow_mut().waiting.pop_front())
    }
}

fn a_transport_may_stay_on_its_thread() {
    let bus = Rc::new(RefCell::new(Bus::new(&[(507, 200)], vec![])));
    let mut shared = Shared(Rc::clone(&bus));
    let mut client = LocalClient::new(&mut shared, 5);
    assert_eq!(finish(client.read_count::<points::Ratio>()), Ok(200));
    assert_eq!(finish(client.write_raw::<points::Ratio>(300)), Ok(()));
    assert_eq!(finish(LocalClient::new(shared, 5).read::<points::Ratio>()), Ok(300));
    assert_eq!(bus.borrow().sent.len(), 3);
}

fn a_late_answer_is_not_taken_for_the_next() {
    let late = messages::READ_ANSWER.build(&PROFILE, 5, 407, 1).unwrap();
    let mut bus = Bus::new(&[(407, 2)], vec![]);
    bus.waiting.extend([late, part(0, [5000, 0, 0])]);
    let mut client = Client::new(&mut bus, 5).listening(Receiver::<telegrams::Measured>::new(5));
    assert_eq!(client.read::<points::Actual>(), Ok(2));
    assert_eq!(client.listener().raw::<points::Frequency>(), Ok(5000));
    let mut bus = Bus::new(&[(407, 2)], vec![]);
    bus.waiting.push_back(late);
    let mut client = AsyncClient::new(Slow(bus), 5);
    assert_eq!(finish(client.read::<points::Actual>()), Ok(2));
}

const ROWS: &[Identification<OddCan>] = identifications! { points:
    Actual holds Raw 3;
    Actual holds Raw 7;
    Name of "model" "small" holds Text "Pump";
    Name of "model" "large" holds Text "Pump 12";
};

fn a_device_is_identified_by_numbers_and_texts() {
    let words = [(739, 0x5075), (738, 0x6D70), (737, 0x2031), (736, 0x3220)];
    let memory: Vec<(u16, u16)> = words.into_iter().chain((732..736).map(|address| (address, 0x2020))).collect();
    let mut bus = Bus::new(&memory, vec![part(0, [5000, 0, 0])]);
    bus.memory.insert(407, 7);
    assert_eq!(Client::new(&mut bus, 5).identify(ROWS).unwrap().unwrap().value("model"), Some("large"));
    assert_eq!(bus.sent.len(), 1 + 8); // each word once
    bus.memory.insert(407, 8);
    assert_eq!(Client::new(&mut bus, 5).identify(ROWS), Ok(Err(OtherDevice("actual"))));
    bus.memory.remove(&407);
    let silent = Client::new(&mut bus, 5).identify(ROWS).unwrap_err();
    assert_eq!((silent.name(), silent.point()), ("line", Some("actual")));
}

/// Executors of several threads take the futures over any transport; this would not compile if they did not.
#[allow(dead_code, reason = "it only has to compile")]
fn futures_are_send<T: AsyncTransport>(client: &mut AsyncClient<T>) {
    fn send<F: Future + Send>(_: F) {}
    send(client.read::<points::Ratio>());
    send(client.write::<points::Target>(45.0));
    send(client.update::<points::Mode>(0));
    send(client.listen());
    send(client.identify(ROWS));
}

fn main() {
    a_late_answer_is_not_taken_for_the_next();
    parameters_are_read_and_written();
    receivers_hear_what_others_are_told();
    numbers_of_two_frames_are_waited_for();
    other_numbers_are_told();
    listeners_are_lent_and_paired();
    units_are_checked();
    a_listener_of_several_telegrams_waits_for_each();
    wrong_bytes_are_of_no_telegram();
    a_device_is_identified_by_numbers_and_texts();
    waits_without_blocking();
    a_transport_may_stay_on_its_thread();
}
