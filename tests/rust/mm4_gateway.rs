//! A gateway for a MICROMASTER 4 as its maker would write it, on a drive made after the manual: blocking and async.

use std::collections::BTreeMap;
use std::future::{ready, Future};
use std::pin::pin;
use std::sync::{Arc, Mutex};
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::client::{AsyncTransport, Transport};
use fieldscribe_runtime::uss::{check_byte, Link, Request, Value};
use fieldscribe_runtime::{About, ClientError, ReplyError};
use siemens_mm4::flags::{ControlWord, StatusWord};
use siemens_mm4::{enums, exceptions, points, with, AsyncClient, Client, Error, Point};

/// What the drive is and does: parameters of one or two words, a motor that turns, a line that may fail.
struct Drive {
    words: BTreeMap<u16, Vec<u16>>,
    /// The words of the parameter part, as P2013 says.
    pkw: u8,
    /// Firmware 1.05 of the 420 keeps single words in the first value word.
    single_first: bool,
    control: u16,
    setpoint: u16,
    faulty: bool,
    loses: usize,
    telegrams: usize,
}

type Shared = Arc<Mutex<Drive>>;

impl Drive {
    fn new() -> Shared {
        let words = [(700, vec![4]), (1000, vec![4]), (1082, vec![0x4248, 0]), (1120, vec![0x4120, 0])];
        let page = [(2000, vec![0x4248, 0]), (2009, vec![0]), (2010, vec![6])];
        let words = words.into_iter().chain(page).collect();
        Arc::new(Mutex::new(Self {
            words,
            pkw: 127,
            single_first: false,
            control: 0x047E,
            setpoint: 0,
            faulty: false,
            loses: 0,
            telegrams: 0,
        }))
    }

    /// Table of ZSW: bits 3 of a fault; 4, 5, 8, 11, 13 and 15 are 1 when nothing is wrong.
    fn status(&self) -> u16 {
        let on = self.turns();
        0xFA31 | if on { 0x0006 } else { 0 } | if self.faulty { 0x0008 } else { 0 }
    }

    fn turns(&self) -> bool {
        self.control & 0x000F == 0x000F && !self.faulty
    }

    /// The parameter part of the answer.
    fn part(&mut self, part: [u16; 4]) -> Vec<u16> {
        let [pke, index, first, second] = part;
        let (task, number) = (pke >> 12, pke & 0x07FF);
        let parameter = number + if index & 0x8000 == 0 { 0 } else { 2000 };
        let first_value = if self.pkw == 4 && !self.single_first { second } else { first };
        let running = self.turns();
        let refused = |error: u16| vec![0x7000 | number, index, error];
        if task == 0 {
            return vec![0, 0, 0];
        }
        let Some(held) = self.words.get_mut(&parameter) else {
            return refused(0);
        };
        match (task, held.len()) {
            (1, _) => {}
            (2 | 14 | 3 | 13, _) if parameter == 1082 && running => return refused(17),
            (2 | 7 | 12 | 14, 1) => held[0] = first_value,
            (3 | 8 | 11 | 13, 2) => *held = vec![first, second],
            _ => return refused(5),
        }
        let array = if matches!(task, 7 | 8 | 11 | 12) { 3 } else { 0 };
        match held[..] {
            [word] if self.pkw == 4 && !self.single_first => vec![(1 + array) << 12 | number, index, 0, word],
            [word] => vec![(1 + array) << 12 | number, index, word],
            [high, low] => vec![(2 + array) << 12 | number, index, high, low],
            _ => unreachable!(),
        }
    }

    fn exchange(&mut self, sent: &[u8], reply: &mut [u8]) -> Result<usize, &'static str> {
        assert_eq!((sent[0], check_byte(sent), usize::from(sent[1]) + 2), (2, 0, sent.len()));
        let words: Vec<u16> = sent[3..sent.len() - 1].chunks(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect();
        let &[a, b, c, d, stw, hsw] = &words[..] else { panic!("other words than P2012 and P2013 say") };
        self.telegrams += 1;
        let all = sent[2] == 0x20;
        if all && a & 2 != 0 && b & 0x0400 == 0 {
            return Ok(0);
        }
        let mask = if !all { 0xFFFF } else if a & 2 != 0 { b } else { 0 };
        if stw & mask & 0x0400 != 0 {
            self.control = (self.control & !mask) | (stw & mask);
            self.setpoint = if all && a & 4 == 0 { self.setpoint } else { hsw };
        }
        if all || self.loses > 0 {
            self.loses = self.loses.saturating_sub(1);
            return if all { Ok(0) } else { Err("nothing came") };
        }
        let mut answer = self.part([a, b, c, d]);
        if self.pkw == 4 {
            answer.resize(4, 0);
        }
        answer.extend([self.status(), if self.turns() { self.setpoint } else { 0 }]);
        let mut bytes = vec![2, u8::try_from(2 * answer.len() + 2).unwrap(), sent[2]];
        bytes.extend(answer.iter().flat_map(|word| word.to_be_bytes()));
        bytes.push(check_byte(&bytes));
        reply[..bytes.len()].copy_from_slice(&bytes);
        Ok(bytes.len())
    }
}

struct Port(Shared);

impl Transport for Port {
    type Error = &'static str;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        self.0.lock().unwrap().exchange(request, reply)
    }
}

impl AsyncTransport for Port {
    type Error = &'static str;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> impl Future<Output = Result<usize, Self::Error>> {
        ready(self.0.lock().unwrap().exchange(request, reply))
    }
}

/// 047E: neither OFF2 nor OFF3, everything enabled, not on.
const READY: ControlWord = ControlWord::ALL_FALSE
    .with_enable_operation(true)
    .with_ramp_generator_operating(true)
    .with_enable_ramp_generator(true)
    .with_enable_setpoint(true);
const RUN: ControlWord = READY.with_on(true);

fn forty_hertz() -> with::MainSetpoint {
    with::MainSetpoint { uss_normalisation: 0, reference_frequency: 50_f32.to_bits() }
}

fn runs_and_stops() {
    let drive = Drive::new();
    let mut client = Client::new(Port(drive.clone()), Link::new(127, 2), 3);
    let reference = client.read_raw::<points::ReferenceFrequency>().unwrap();
    let normalisation = client.read_raw::<points::UssNormalisationRs485>().unwrap();
    let setpoint = with::MainSetpoint { uss_normalisation: normalisation, reference_frequency: reference };
    assert_eq!(setpoint, forty_hertz());
    client.set_with::<points::MainSetpoint>(40.0, setpoint).unwrap();
    client.send::<points::ControlWord>(READY).unwrap();
    assert_eq!(drive.lock().unwrap().control, 0x047E);
    assert_eq!(drive.lock().unwrap().setpoint, 0x3333);
    assert_eq!(u16::from(client.heard::<points::StatusWord>().unwrap()), 0xFA31);
    client.send::<points::ControlWord>(RUN).unwrap();
    assert_eq!(drive.lock().unwrap().control, 0x047F);
    let status = client.receive::<points::StatusWord>().unwrap();
    assert!(status.operation_enabled() && !status.motor_overload() && !status.off2_pending());
    let actual = with::MainActualValue { uss_normalisation: normalisation, reference_frequency: reference };
    let hertz = client.heard_with::<points::MainActualValue>(actual).unwrap();
    assert!((hertz - 40.0).abs() < 0.01);
    // A refused task tells of the fault that came with it.
    drive.lock().unwrap().faulty = true;
    let refused = client.read::<points::UserAccessLevel>().unwrap_err();
    let (error, name) = (exceptions::PARAMETER_NUMBER_NOT_ALLOWED, Some("parameter_number_not_allowed"));
    assert_eq!(refused, ClientError::Reply(ReplyError::Refused { error, name }, Some(About::Point("user_access_level"))));
    assert!(client.heard::<points::StatusWord>().unwrap().fault());
    assert!(drive.lock().unwrap().control & 1 == 1);
}

fn a_lost_stop_stays_a_stop() {
    let drive = Drive::new();
    let mut client = Client::new(Port(drive.clone()), Link::new(127, 2), 3);
    client.send::<points::ControlWord>(RUN).unwrap();
    drive.lock().unwrap().loses = 1;
    assert!(client.send::<points::ControlWord>(READY).is_err());
    for _ in 0..3 {
        client.cycle().unwrap();
        client.read::<points::CommandSource>().unwrap();
        assert!(!drive.lock().unwrap().turns());
    }
    assert_eq!(client.words(), [0, 0]);
}

fn a_setpoint_alone_stops_nothing() {
    let drive = Drive::new();
    drive.lock().unwrap().control = 0x047F;
    let mut client = Client::new(Port(drive.clone()), Link::new(127, 2), 3);
    client.send_with::<points::MainSetpoint>(40.0, forty_hertz()).unwrap();
    assert!(drive.lock().unwrap().turns());
}

fn wrong_links_are_noticed() {
    let drive = Drive::new();
    drive.lock().unwrap().pkw = 4;
    drive.lock().unwrap().single_first = true;
    let mut client = Client::new(Port(drive.clone()), Link::new(4, 2), 3);
    let usual = enums::CommandSource::from(5);
    let other = ReplyError::OtherNumber { written: 5, answered: Some(0) };
    let wrong = ClientError::Reply(other, Some(About::Point("command_source")));
    assert_eq!(client.write::<points::CommandSource>(usual), Err(wrong));
    let mut client = Client::new(Port(drive), Link::new(4, 2).single_first(), 3);
    assert_eq!(client.write::<points::CommandSource>(usual), Ok(()));
    assert_eq!(client.read::<points::CommandSource>(), Ok(usual));
}

fn parameters_are_changed() {
    let drive = Drive::new();
    let mut client = Client::new(Port(drive.clone()), Link::new(127, 2), 3);
    assert_eq!(client.write::<points::MaximumFrequency>(40.0), Ok(()));
    assert_eq!(client.store::<points::MaximumFrequency>(33.3), Ok(()));
    let nan = client.write::<points::MaximumFrequency>(f64::NAN);
    assert_eq!(nan, Err(ClientError::Point(Error::NotANumber("maximum_frequency"))));
    client.send::<points::ControlWord>(RUN).unwrap();
    let running = client.write::<points::MaximumFrequency>(50.0).unwrap_err();
    assert_eq!(running.to_string(), "maximum_frequency: the drive refused with error 17 (not_in_this_operating_state)");
    // P1120 has no point, as nobody says its scale; its address is at the head of the points.
    let ramp = client.exchange(Request::new(3, 1, 1120, 0)).unwrap().value();
    assert_eq!(ramp, Value::Double(10_f32.to_bits()));
}

fn all_drives_are_stopped() {
    let drive = Drive::new();
    let mut client = Client::new(Port(drive.clone()), Link::new(127, 2), 3);
    client.send::<points::ControlWord>(RUN).unwrap();
    client.set::<points::ControlWord>(READY).unwrap();
    assert!(client.broadcast([2, ControlWord::ON, 0, 0]).is_err());
    client.broadcast([2, ControlWord::ON | ControlWord::SETPOINTS_VALID, 0, 0]).unwrap();
    assert!(!drive.lock().unwrap().turns());
}

fn words_are_shown_by_what_is_true() {
    assert_eq!(
        format!("{:?}", StatusWord::from(0xFA31)),
        "StatusWord(0xFA31: ready_to_switch_on, deviation, control_requested, clockwise)"
    );
    assert_eq!(format!("{:?}", ControlWord::default()), "ControlWord(0x0006)");
    assert!(ControlWord::ALL_FALSE.with_off2(true).off2());
    assert_eq!(ControlWord::ALL_FALSE.with_off2(true).0 & ControlWord::OFF2_ACTIVE_LOW, 0);
    assert_eq!((points::StatusWord::NAME, points::StatusWord::CODE), ("status_word", Some("ZSW")));
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

async fn runs_async(drive: &Shared) -> Result<StatusWord, ClientError<&'static str>> {
    let mut client = AsyncClient::new(Port(drive.clone()), Link::new(127, 2), 3);
    let reference_frequency = client.read_raw::<points::ReferenceFrequency>().await?;
    let uss_normalisation = client.read_raw::<points::UssNormalisationRs485>().await?;
    let setpoint = with::MainSetpoint { uss_normalisation, reference_frequency };
    client.set_with::<points::MainSetpoint>(20.0, setpoint)?;
    client.send::<points::ControlWord>(READY).await?;
    client.send::<points::ControlWord>(RUN).await?;
    client.receive::<points::StatusWord>().await
}

fn main() {
    runs_and_stops();
    a_lost_stop_stays_a_stop();
    a_setpoint_alone_stops_nothing();
    wrong_links_are_noticed();
    parameters_are_changed();
    all_drives_are_stopped();
    words_are_shown_by_what_is_true();
    let drive = Drive::new();
    assert!(finish(runs_async(&drive)).unwrap().operation_enabled());
    assert!(drive.lock().unwrap().turns());
    assert_eq!(drive.lock().unwrap().telegrams, 5);
}
