//! USS clients over a line of a made-up drive: what is sent, and what comes out.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::future::{ready, Future};
use std::pin::pin;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::client::{AsyncTransport, LocalTransport, Transport};
use fieldscribe_runtime::uss::{check_byte, Link, Request, Value};
use fieldscribe_runtime::{identifications, About, BuildError, ClientError, Identification, OtherDevice, ReplyError};
use odd_uss::OddUss;
use odd_uss::{exceptions, flags, points, tasks, with, AsyncClient, Client, Error, LocalClient};

/// A drive with one or two words for each element, which sends its process data and refuses what it does not have.
#[derive(Default)]
struct Drive {
    memory: BTreeMap<(u16, u16), Vec<u16>>,
    kept: Vec<u16>,
    actual: Vec<u16>,
    sent: Vec<Vec<u8>>,
    longer: bool,
    /// How many telegrams are taken and not answered.
    lost: usize,
    /// What a write changes the first word of a value to, if it is not taken as it is.
    changes: Option<u16>,
}

fn word(bytes: &[u8], place: usize) -> u16 {
    u16::from_be_bytes([bytes[3 + 2 * place], bytes[4 + 2 * place]])
}

impl Drive {
    fn new(memory: &[((u16, u16), &[u16])]) -> Self {
        let memory = memory.iter().map(|(key, words)| (*key, words.to_vec())).collect();
        Self { memory, actual: vec![0x0331, 0x2000, 0x0002, 0x0001], ..Self::default() }
    }

    fn answer(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, &'static str> {
        assert_eq!(check_byte(request), 0);
        self.sent.push(request.to_vec());
        if reply.is_empty() {
            return Ok(0);
        }
        let (task, key) = (word(request, 0) >> 12, (word(request, 0) & 0x0FFF, word(request, 1)));
        let mut words = self.part(task, key, [word(request, 2), word(request, 3)]);
        words.extend(&self.actual);
        if self.longer {
            words.push(0);
        }
        if self.lost > 0 {
            self.lost -= 1;
            return Err("nothing came");
        }
        let mut bytes = vec![2, u8::try_from(2 * words.len() + 2).unwrap(), request[2]];
        bytes.extend(words.iter().flat_map(|word| word.to_be_bytes()));
        bytes.push(check_byte(&bytes));
        reply[..bytes.len()].copy_from_slice(&bytes);
        Ok(bytes.len())
    }

    fn part(&mut self, task: u16, (number, index): (u16, u16), value: [u16; 2]) -> Vec<u16> {
        if task == 0 {
            return vec![0, 0, 0];
        }
        let Some(held) = self.memory.get_mut(&(number, index)) else {
            return vec![0x7000 | number, index, exceptions::NOT_NOW];
        };
        if task != 1 {
            let length = held.len();
            held.copy_from_slice(&value[..length]);
            held[0] = self.changes.unwrap_or(held[0]);
        }
        if matches!(task, 11..=14) {
            self.kept.push(task);
        }
        let array = matches!(task, 6..=8 | 11 | 12);
        let response = if array { 3 } else { 0 } + u16::try_from(held.len()).unwrap();
        let mut words = vec![response << 12 | number, index];
        words.extend(held.iter());
        words
    }
}

impl Transport for Drive {
    type Error = &'static str;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        self.answer(request, reply)
    }
}

impl AsyncTransport for Drive {
    type Error = &'static str;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> impl Future<Output = Result<usize, Self::Error>> {
        ready(self.answer(request, reply))
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

const LINK: Link = Link::new(127, 4);

fn drive() -> Drive {
    Drive::new(&[
        ((700, 0), &[2]),
        ((0, 0x8000), &[0x4248, 0]),
        ((10, 0x8001), &[6]),
        ((52, 0), &[0]),
        ((60, 0), &[0x00FF]),
        ((1999, 0xF0FF), &[0, 5]),
    ])
}

fn parameters_are_read_and_written() {
    let mut client = Client::new(drive(), LINK, 3);
    assert_eq!(client.read::<points::Source>(), Ok(2));
    assert_eq!(client.write::<points::Source>(5), Ok(()));
    assert_eq!(client.store::<points::Source>(6), Ok(()));
    let far = client.write::<points::Source>(7).unwrap_err();
    assert_eq!(far.to_string(), "source: raw 7 is outside 0 to 6");
    assert_eq!(client.read::<points::Reference>(), Ok(50.0));
    assert_eq!(client.write::<points::Reference>(60.0), Ok(()));
    assert_eq!(client.read::<points::BaudIndex1>(), Ok(6));
    assert_eq!(client.store::<points::BaudIndex1>(9), Ok(()));
    assert_eq!(client.read::<points::WideIndex255>(), Ok(5));
    assert_eq!(client.write::<points::WideIndex255>(0x0001_0002), Ok(()));
    // The drive has no task that keeps double words of arrays.
    assert_eq!(client.store::<points::WideIndex255>(1), Err(ClientError::Build(BuildError::BadTask, Some(About::Point("wide_index_255")))));
    assert_eq!(client.read::<points::LowBits>(), Ok(15));
    assert_eq!(client.update::<points::LowBits>(3), Ok(()));
    assert_eq!(client.store_update::<points::LowBits>(4), Ok(()));
    assert_eq!(client.read::<points::Status>(), Ok(flags::Status(0)));
    let drive = client.into_transport();
    assert_eq!(drive.memory[&(700, 0)], [6]);
    assert_eq!(drive.memory[&(0, 0x8000)], [0x4270, 0]);
    assert_eq!(drive.memory[&(60, 0)], [0x80F4]);
    assert_eq!(drive.memory[&(1999, 0xF0FF)], [1, 2]);
    assert_eq!(drive.kept, [14, 12, 14]);
    assert_eq!(drive.sent[0][..8], [2, 18, 3, 0x12, 0xBC, 0, 0, 0]);
}

fn refusals_and_wrong_answers_are_told() {
    let mut client = Client::new(Drive::new(&[((0, 0x8000), &[1])]), LINK, 3);
    let refused = ClientError::Reply(ReplyError::Refused { error: exceptions::NOT_NOW, name: Some("not_now") }, Some(About::Point("source")));
    assert_eq!(client.read::<points::Source>(), Err(refused));
    assert_eq!(client.read::<points::Reference>(), Err(ClientError::Point(Error::WrongLength(Some("reference")))));
    let mut drive = client.into_transport();
    drive.longer = true;
    let mut client = Client::new(&mut drive, Link::new(3, 4), 3);
    assert_eq!(client.cycle(), Err(ClientError::Reply(ReplyError::WrongLength, None)));
    let mut client = Client::new(&mut drive, LINK, 32);
    assert_eq!(client.cycle(), Err(ClientError::Build(BuildError::BadUnit, None)));
    let mut client = Client::new(&mut drive, LINK, 3);
    let other = client.exchange(Request::cyclic(4)).err();
    assert_eq!(other, Some(ClientError::Build(BuildError::OtherUnit, None)));
    let mut client = Client::new(&mut drive, Link::new(127, 200), 3);
    assert_eq!(client.cycle(), Err(ClientError::Build(BuildError::BadLink, None)));
    assert_eq!(client.broadcast([0; 4]), Err(ClientError::Build(BuildError::BadLink, None)));
}

fn process_data_go_both_ways() {
    let fifty = 0x4248_0000;
    let mut client = Client::new(drive(), LINK, 3);
    assert_eq!(client.heard::<points::StatusWord>(), Err(Error::NotHeard(Some("status_word"))));
    assert_eq!(client.cycle(), Ok(()));
    assert_eq!(client.heard::<points::StatusWord>(), Ok(flags::StatusWord(0x0331)));
    assert_eq!(client.heard::<points::Energy>(), Ok(0x0001_0002));
    assert_eq!(client.set::<points::ControlWord>(flags::ControlWord(0x047F)), Ok(()));
    assert_eq!(client.set_bits::<points::Jog>(2), Ok(()));
    assert_eq!(client.set::<points::Position>(1), Err(Error::BeyondLink(Some("position"))));
    assert_eq!(client.set::<points::FarWord>(1), Err(Error::BeyondLink(Some("far_word"))));
    let setpoint = with::MainSetpoint { reference: fifty };
    assert_eq!(client.send_with::<points::MainSetpoint>(25.0, setpoint), Ok(()));
    let none = with::MainSetpoint { reference: 0x7F80_0000 };
    assert_eq!(client.set_with::<points::MainSetpoint>(1.0, none), Err(Error::ZeroFactor(Some("main_setpoint"))));
    let limit = with::LimitedSetpoint { reference: 0x4270_0000 };
    let far = client.set_with::<points::LimitedSetpoint>(16385, limit).unwrap_err();
    assert_eq!(far.to_string(), "limited_setpoint: raw 16385 is outside 0 to 16384");
    assert_eq!(client.receive_with::<points::MainActual>(with::MainActual { reference: fifty }), Ok(25.0));
    assert_eq!(client.exchange(Request::new(3, tasks::TASK_1, 700, 0)).unwrap().word(), Ok(2));
    assert_eq!(client.broadcast([6, 0xFFFF, 0, 0]), Ok(()));
    let sent = client.into_transport().sent;
    // Until something is set nothing is: a control word of fixed bits alone would stop the drive.
    assert_eq!(data(&sent[0]), [0, 0, 0, 0]);
    assert_eq!(data(&sent[1]), [0x047F, 0x2000, 0, 0x8002]);
    assert_eq!(data(&sent[3]), data(&sent[1]));
    assert_eq!((sent[4][2], word(&sent[4], 1)), (32, 0xFFFF));
}

fn data(telegram: &[u8]) -> [u16; 4] {
    [4, 5, 6, 7].map(|place| word(telegram, place))
}

/// Sends what starts the drive, and has the answer.
fn started<T: Transport>(line: T) -> Client<T>
where
    T::Error: std::fmt::Debug + PartialEq,
{
    let mut client = Client::new(line, LINK, 3);
    client.set::<points::ControlWord>(flags::ControlWord(0x047F)).unwrap();
    client.send_bits::<points::Jog>(2).unwrap();
    assert_eq!(client.words(), [0x047F, 0, 0, 0x8002]);
    client
}

fn neither_old_nor_new_words_are_repeated_after_a_failure() {
    let mut line = drive();
    let mut client = started(&mut line);
    client.transport().lost = 1;
    let lost = |point| Err(ClientError::Transport("nothing came", Some(About::Point(point))));
    assert_eq!(client.send::<points::ControlWord>(flags::ControlWord(0x047E)), lost("control_word"));
    assert_eq!(client.words(), [0; 4]);
    assert_eq!(client.read::<points::Source>(), Ok(2));
    client.transport().lost = 1;
    client.set::<points::ControlWord>(flags::ControlWord(0x047E)).unwrap();
    assert_eq!(client.write::<points::Source>(3), lost("source"));
    assert_eq!(client.cycle(), Ok(()));
    // A telegram that was not sent changes nothing.
    assert_eq!(client.send::<points::ControlWord>(flags::ControlWord(0x047E)), Ok(()));
    assert_eq!(client.exchange(Request::new(3, 9, 1, 0)).err(), Some(ClientError::Build(BuildError::BadTask, None)));
    assert_eq!(client.words(), [0x047E, 0, 0, 0]);
    let sent: Vec<_> = line.sent.iter().map(|telegram| data(telegram)).collect();
    let stop = [0x047E, 0, 0, 0];
    assert_eq!(sent[1..], [[0x047E, 0, 0, 0x8002], [0; 4], stop, [0; 4], stop]);
}

fn words_that_the_drive_has_are_repeated() {
    let mut line = drive();
    let mut client = started(&mut line);
    client.transport().lost = 1;
    assert!(client.cycle().is_err());
    assert_eq!(client.heard::<points::StatusWord>(), Err(Error::NotHeard(Some("status_word"))));
    client.set::<points::ControlWord>(flags::ControlWord(0x047F)).unwrap();
    client.transport().lost = 1;
    assert!(client.cycle().is_err());
    assert_eq!(client.words(), [0x047F, 0, 0, 0x8002]);
}

fn a_refused_task_brings_process_data() {
    let mut line = drive();
    line.memory.clear();
    let mut client = started(&mut line);
    client.set::<points::ControlWord>(flags::ControlWord(0x047E)).unwrap();
    let refused = ClientError::Reply(ReplyError::Refused { error: exceptions::NOT_NOW, name: Some("not_now") }, Some(About::Point("source")));
    client.transport().actual[0] = 0x0008;
    assert_eq!(client.read::<points::Source>(), Err(refused));
    assert_eq!(client.heard::<points::StatusWord>(), Ok(flags::StatusWord(8)));
    assert_eq!(client.words(), [0x047E, 0, 0, 0x8002]);
}

fn constant_bits_come_with_their_own_word() {
    let mut client = Client::new(drive(), LINK, 3);
    let setpoint = with::MainSetpoint { reference: 0x4248_0000 };
    assert_eq!(client.send_with::<points::MainSetpoint>(25.0, setpoint), Ok(()));
    assert_eq!(client.send::<points::ControlWord>(flags::ControlWord(1)), Ok(()));
    assert_eq!(client.set_word(3, 7), Ok(()));
    assert_eq!(client.set_word(4, 7), Err(Error::BeyondLink(None)));
    assert_eq!(client.cycle(), Ok(()));
    assert_eq!((client.heard_word(3), client.heard_word(4)), (Ok(1), Err(Error::BeyondLink(None))));
    let sent = client.into_transport().sent;
    assert_eq!(data(&sent[0]), [0, 0x2000, 0, 0]);
    assert_eq!(data(&sent[2]), [0x0401, 0x2000, 0, 7]);
}

fn answers_are_held_against_what_was_written() {
    let mut line = drive();
    line.changes = Some(0);
    let mut client = Client::new(&mut line, LINK, 3);
    let mismatch = |written, name| {
        let other = ReplyError::OtherNumber { written, answered: Some(0) };
        Err(ClientError::Reply(other, Some(About::Point(name))))
    };
    assert_eq!(client.write::<points::Source>(4), mismatch(4, "source"));
    assert_eq!(client.store::<points::Source>(4), mismatch(4, "source"));
    assert_eq!(client.update::<points::LowBits>(3), mismatch(0x80F3, "low_bits"));
    let far = client.write::<points::Reference>(60.0).unwrap_err();
    assert_eq!(far.to_string(), "reference: 60 was written, the device answered 0");
    // 33.33 is 0x420551EC; a drive may round: 0x4205_47AE is 33.32, 0x4204_0000 is 33.
    client.transport().changes = Some(0x4205);
    assert_eq!(client.write::<points::Reference>(33.33), Ok(()));
    client.transport().changes = Some(0x4204);
    assert!(client.write::<points::Reference>(33.33).is_err());
    client.transport().changes = Some(0x7FC0);
    assert!(client.write::<points::Reference>(33.33).is_err());
}

fn all_units_are_sent_valid_words() {
    let mut line = drive();
    let mut client = Client::new(&mut line, LINK, 3);
    let bad = Err(ClientError::Build(BuildError::BadMask, None));
    // Nobody set the control word, whose constant bit makes it valid; it does not matter where it is not meant.
    assert_eq!(client.broadcast([6, 0xFFFF, 0, 0]), bad);
    assert_eq!(client.broadcast([4, 0, 0, 0]), Ok(()));
    client.set::<points::ControlWord>(flags::ControlWord(0)).unwrap();
    assert_eq!(client.broadcast([2, 0x0001, 0, 0]), bad);
    assert_eq!(client.broadcast([2, 0x0401, 0, 0]), Ok(()));
    // No unit confirms it.
    client.transport().lost = 1;
    assert!(client.cycle().is_err());
    assert_eq!(client.words(), [0; 4]);
    assert_eq!(data(&line.sent[1]), [0x0400, 0, 0, 0]);
}

fn is_send<T: Send>(_: &T) {}

fn waits_without_blocking() {
    let mut client = AsyncClient::new(drive(), LINK, 3);
    assert_eq!(finish(client.read::<points::Source>()), Ok(2));
    assert_eq!(finish(client.store::<points::Source>(1)), Ok(()));
    assert_eq!(finish(client.receive::<points::StatusWord>()), Ok(flags::StatusWord(0x0331)));
    // A task of a runtime with several threads may hold it.
    is_send(&client.send::<points::ControlWord>(flags::ControlWord(0)));
    is_send(&client.read::<points::Source>());
    assert_eq!(client.into_transport().kept, [14]);
}

/// A line that cannot leave its thread.
struct Shared(Rc<RefCell<Drive>>);

impl LocalTransport for Shared {
    type Error = &'static str;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        self.0.borrow_mut().answer(request, reply)
    }
}

fn a_transport_may_stay_on_its_thread() {
    let line = Rc::new(RefCell::new(drive()));
    let mut client = LocalClient::new(Shared(Rc::clone(&line)), LINK, 3);
    assert_eq!(finish(client.read_count::<points::Source>()), Ok(2));
    assert_eq!(finish(client.store_raw::<points::Source>(1)), Ok(()));
    assert_eq!(finish(client.read::<points::Source>()), Ok(1));
    assert_eq!((line.borrow().sent.len(), line.borrow().kept.len()), (3, 1));
}

fn a_drive_is_identified_by_its_numbers() {
    let rows: &[Identification<OddUss>] = identifications! { points:
        StatusWord holds Raw 0x0331;
        Source of "model" "small" holds Raw 5;
        Source of "model" "large" holds Raw 6;
        Source of "model" "larger" holds Raw 6;
    };
    let mut client = Client::new(Drive::new(&[((700, 0), &[6])]), LINK, 3);
    let found: Vec<_> = client.identify(rows).unwrap().unwrap().iter().collect();
    assert_eq!(found, [("model", "large")]); // the first that fits
    client.transport().memory.clear();
    let refused = client.identify(rows).unwrap_err(); // the drive may refuse for now: it need not be another
    assert_eq!((refused.name(), refused.point()), ("refused", Some("source")));
    client.transport().actual[0] = 0;
    assert_eq!(client.identify(rows), Ok(Err(OtherDevice("status_word"))));
}

/// A drive whose answers nobody waits for.
struct Silent(Drive, bool);

impl AsyncTransport for Silent {
    type Error = &'static str;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        let length = self.0.answer(request, reply)?;
        if self.1 { std::future::pending().await } else { Ok(length) }
    }
}

fn a_dropped_exchange_is_a_failed_one() {
    let mut client = AsyncClient::new(Silent(drive(), false), LINK, 3);
    assert_eq!(finish(client.send::<points::ControlWord>(flags::ControlWord(0x047F))), Ok(()));
    client.transport().1 = true;
    {
        let mut stop = pin!(client.send::<points::ControlWord>(flags::ControlWord(0x047E)));
        let waker = Waker::from(Arc::new(Busy));
        assert!(stop.as_mut().poll(&mut Context::from_waker(&waker)).is_pending());
    }
    assert_eq!(client.words(), [0; 4]);
}

/// Executors of several threads take the futures over any transport; this would not compile if they did not.
#[allow(dead_code, reason = "it only has to compile")]
fn futures_are_send<T: AsyncTransport>(client: &mut AsyncClient<T>) {
    fn send<F: Future + Send>(_: F) {}
    send(client.read::<points::Source>());
    send(client.write::<points::Source>(5));
    send(client.cycle());
}

fn main() {
    parameters_are_read_and_written();
    refusals_and_wrong_answers_are_told();
    process_data_go_both_ways();
    neither_old_nor_new_words_are_repeated_after_a_failure();
    words_that_the_drive_has_are_repeated();
    a_refused_task_brings_process_data();
    constant_bits_come_with_their_own_word();
    answers_are_held_against_what_was_written();
    all_units_are_sent_valid_words();
    a_drive_is_identified_by_its_numbers();
    a_dropped_exchange_is_a_failed_one();
    waits_without_blocking();
    a_transport_may_stay_on_its_thread();
}
