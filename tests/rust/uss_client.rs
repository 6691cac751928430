//! USS clients over a line of a made-up drive: what is sent, and what comes out.

use std::collections::BTreeMap;
use std::future::{ready, Future};
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::client::{AsyncTransport, Transport};
use fieldscribe_runtime::uss::{check_byte, AsyncClient, BuildError, Client, ClientError, Link, ParseError, Request};
use odd_uss::{exceptions, flags, points, tasks, with, Error, PROFILE};

/// A drive with one or two words for each element, which sends its process data and refuses what it does not have.
#[derive(Default)]
struct Drive {
    memory: BTreeMap<(u16, u16), Vec<u16>>,
    kept: Vec<u16>,
    actual: Vec<u16>,
    sent: Vec<Vec<u8>>,
    longer: bool,
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
    let mut client = Client::new(drive(), &PROFILE, LINK, 3);
    assert_eq!(client.read::<points::Source>(), Ok(2));
    assert_eq!(client.write::<points::Source>(5), Ok(()));
    assert_eq!(client.store::<points::Source>(6), Ok(()));
    assert_eq!(client.write::<points::Source>(7), Err(ClientError::Point(Error::OutOfRange)));
    assert_eq!(client.read::<points::Reference>(), Ok(50.0));
    assert_eq!(client.write::<points::Reference>(60.0), Ok(()));
    assert_eq!(client.read::<points::BaudIndex1>(), Ok(6));
    assert_eq!(client.store::<points::BaudIndex1>(9), Ok(()));
    assert_eq!(client.read::<points::WideIndex255>(), Ok(5));
    assert_eq!(client.write::<points::WideIndex255>(0x0001_0002), Ok(()));
    // The drive has no task that keeps double words of arrays.
    assert_eq!(client.store::<points::WideIndex255>(1), Err(ClientError::Build(BuildError::BadTask)));
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
    let mut client = Client::new(Drive::new(&[((0, 0x8000), &[1])]), &PROFILE, LINK, 3);
    let refused = ClientError::Reply(ParseError::Refused(exceptions::NOT_NOW));
    assert_eq!(client.read::<points::Source>(), Err(refused));
    assert_eq!(client.read::<points::Reference>(), Err(ClientError::Point(Error::WrongLength)));
    let mut drive = client.into_transport();
    drive.longer = true;
    let mut client = Client::new(&mut drive, &PROFILE, Link::new(3, 4), 3);
    assert_eq!(client.cycle(), Err(ClientError::Reply(ParseError::WrongLength)));
    let mut client = Client::new(&mut drive, &PROFILE, LINK, 32);
    assert_eq!(client.cycle(), Err(ClientError::Build(BuildError::BadUnit)));
    let mut client = Client::new(&mut drive, &PROFILE, Link::new(127, 200), 3);
    assert_eq!(client.cycle(), Err(ClientError::Build(BuildError::BadLink)));
    assert_eq!(client.broadcast([0; 4]), Err(ClientError::Build(BuildError::BadLink)));
}

fn process_data_go_both_ways() {
    let fifty = 0x4248_0000;
    let mut client = Client::new(drive(), &PROFILE, LINK, 3);
    assert_eq!(client.heard::<points::StatusWord>(), Err(Error::WrongLength));
    assert_eq!(client.cycle(), Ok(()));
    assert_eq!(client.heard::<points::StatusWord>(), Ok(flags::StatusWord(0x0331)));
    assert_eq!(client.heard::<points::Energy>(), Ok(0x0001_0002));
    assert_eq!(client.set::<points::ControlWord>(flags::ControlWord(0x047F)), Ok(()));
    assert_eq!(client.set_bits::<points::Jog>(2), Ok(()));
    assert_eq!(client.set::<points::Position>(1), Err(Error::WrongLength));
    assert_eq!(client.set::<points::FarWord>(1), Err(Error::WrongLength));
    let setpoint = with::MainSetpoint { reference: fifty };
    assert_eq!(client.send_with::<points::MainSetpoint>(25.0, setpoint), Ok(()));
    let none = with::MainSetpoint { reference: 0x7F80_0000 };
    assert_eq!(client.set_with::<points::MainSetpoint>(1.0, none), Err(Error::ZeroFactor));
    let limit = with::LimitedSetpoint { reference: 0x4270_0000 };
    assert_eq!(client.set_with::<points::LimitedSetpoint>(16385, limit), Err(Error::OutOfRange));
    assert_eq!(client.receive_with::<points::MainActual>(with::MainActual { reference: fifty }), Ok(25.0));
    assert_eq!(client.exchange(Request::new(3, tasks::TASK_1, 700, 0)).unwrap().word(), Ok(2));
    assert_eq!(client.broadcast([6, 0xFFFF, 0, 0]), Ok(()));
    let sent = client.into_transport().sent;
    let data = |telegram: &[u8]| (4..8).map(|place| word(telegram, place)).collect::<Vec<_>>();
    // Until something is set nothing is: a control word of fixed bits alone would stop the drive.
    assert_eq!(data(&sent[0]), [0, 0, 0, 0]);
    assert_eq!(data(&sent[1]), [0x047F, 0x2000, 0, 0x8002]);
    assert_eq!(data(&sent[3]), data(&sent[1]));
    assert_eq!((sent[4][2], word(&sent[4], 1)), (32, 0xFFFF));
}

fn what_failed_is_not_sent_again() {
    let mut line = drive();
    line.longer = true;
    let mut client = Client::new(&mut line, &PROFILE, Link::new(3, 4), 3);
    assert!(client.send::<points::ControlWord>(flags::ControlWord(0x047F)).is_err());
    assert!(client.send_bits::<points::Jog>(1).is_err());
    assert!(client.cycle().is_err());
    let word_of = |place: usize| u16::from_be_bytes([line.sent[place][9], line.sent[place][10]]);
    assert_eq!([word_of(0), word_of(1), word_of(2)], [0x047F, 0x0400, 0]);
    line.longer = false;
    let mut client = Client::new(&mut line, &PROFILE, Link::new(3, 4), 3);
    assert_eq!(client.send_bits::<points::Jog>(1), Ok(()));
    assert_eq!(client.cycle(), Ok(()));
    assert_eq!(line.sent[4][9..17], [0x04, 0, 0, 0, 0, 0, 0x80, 1]);
}

fn waits_without_blocking() {
    let mut client = AsyncClient::new(drive(), &PROFILE, LINK, 3);
    assert_eq!(finish(client.read::<points::Source>()), Ok(2));
    assert_eq!(finish(client.store::<points::Source>(1)), Ok(()));
    assert_eq!(finish(client.receive::<points::StatusWord>()), Ok(flags::StatusWord(0x0331)));
    assert_eq!(client.into_transport().kept, [14]);
}

fn main() {
    parameters_are_read_and_written();
    refusals_and_wrong_answers_are_told();
    process_data_go_both_ways();
    what_failed_is_not_sent_again();
    waits_without_blocking();
}
