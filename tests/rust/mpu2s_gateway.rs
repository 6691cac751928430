//! A gateway for an MPU2-S as its maker would write it, on a device made after the manual: blocking and async.

use std::collections::{BTreeMap, VecDeque};
use std::future::{ready, Future};
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::can::{AsyncTransport, Frame, Receiver, Transport};
use fieldscribe_runtime::{About, ClientError};
use woodward_mpu2s::telegrams::Visualisation;
use woodward_mpu2s::{enums, points, with, AsyncClient, Client, Error, Readable};

const UNIT: u8 = 5;

/// The device on its bus: it sends a part of the visualisation now and then, and needs the password before a write;
/// what it answers to a write without it, the manual does not say: here what it holds.
struct Device {
    parameters: BTreeMap<u16, u16>,
    telegram: [u16; 69],
    next: u8,
    unlocked: bool,
    waiting: VecDeque<Frame>,
    /// How many frames come only when the one that waited for them has given up.
    slow: usize,
}

fn summed(bytes: [u8; 6]) -> [u8; 8] {
    let [a, b, c, d, e, f] = bytes;
    [a, b, c, d, e, f, a ^ c ^ e, b ^ d ^ f]
}

impl Device {
    fn new() -> Self {
        let parameters = [(500, 0), (11, 12800), (507, 200), (10, 2000), (19, 0x8FFF), (404, 1050)];
        let mut telegram = [0; 69];
        telegram[..6].copy_from_slice(&[1301, 4998, 250, 0x03FE, 1400, 2000]);
        telegram[19] = 40_000;
        [telegram[44], telegram[45]] = [1, 0x86A0];
        Self {
            parameters: parameters.into_iter().collect(),
            telegram,
            next: 0,
            unlocked: false,
            waiting: VecDeque::new(),
            slow: 0,
        }
    }

    fn shows(&mut self) -> Frame {
        let at = usize::from(self.next);
        let mut data = vec![0xDD, self.next];
        data.extend(self.telegram[3 * at..3 * at + 3].iter().flat_map(|word| word.to_be_bytes()));
        self.next = (self.next + 1) % 23;
        Frame::new(0x320 + u32::from(UNIT), &data)
    }

    fn hears(&mut self, frame: &Frame) {
        let &[kind, unit, a, b, c, d, ..] = frame.bytes() else { panic!("all messages have eight bytes") };
        assert_eq!((frame.id(), frame.bytes()), (0x33F, &summed([kind, unit, a, b, c, d])[..]));
        let (address, word) = (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]));
        let Some(held) = self.parameters.get_mut(&address) else {
            return;
        };
        if kind == 0xEE && (self.unlocked || address == 500) {
            *held = word;
            self.unlocked |= address == 500 && word == 1234;
        }
        let [high, low] = held.to_be_bytes();
        let shown = self.shows();
        let answer = Frame::new(0x320 + u32::from(UNIT), &summed([kind, unit, a, b, high, low]));
        self.waiting.extend([shown, answer]);
    }

    fn sends(&mut self) -> Result<Frame, &'static str> {
        if self.slow > 0 {
            self.slow -= 1;
            return Err("nothing came");
        }
        let shown = self.waiting.pop_front();
        Ok(shown.unwrap_or_else(|| self.shows()))
    }
}

impl Transport for Device {
    type Error = &'static str;

    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        self.hears(frame);
        Ok(())
    }

    fn receive(&mut self) -> Result<Frame, Self::Error> {
        self.sends()
    }

    fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(self.waiting.pop_front())
    }
}

struct Slow(Device);

impl AsyncTransport for Slow {
    type Error = &'static str;

    async fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        self.0.hears(frame);
        Ok(())
    }

    fn receive(&mut self) -> impl Future<Output = Result<Frame, Self::Error>> {
        ready(self.0.sends())
    }

    async fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(self.0.waiting.pop_front())
    }
}

fn measured_values_are_published() {
    let mut client = Client::new(Device::new(), UNIT).listening(Receiver::<Visualisation>::new(UNIT));
    assert_eq!(client.receive::<points::TelegramIdentification>(), Ok(1301));
    assert_eq!(client.receive::<points::OperatingHours>(), Ok(100_000));
    let receiver = client.listener();
    assert_eq!(receiver.value::<points::GeneratorFrequency>(), Ok(49.98));
    let power = with::GeneratorActivePower {
        generator_power_exponent: receiver.raw::<points::GeneratorPowerExponent>().unwrap(),
    };
    assert_eq!(receiver.value_with::<points::GeneratorActivePower>(power), Ok(250_000.0));
    let voltage = with::GeneratorVoltageL1L2 {
        generator_voltage_exponent: receiver.raw::<points::GeneratorVoltageExponent>().unwrap(),
    };
    assert_eq!(receiver.value_with::<points::GeneratorVoltageL1L2>(voltage), Ok(400.0));
    assert_eq!(receiver.value::<points::MainsState>(), Ok(enums::SupplyPresence::Absent));
    assert_eq!(points::GeneratorActivePower::decode_with(-1, power), Ok(-1000.0));
    let wrong = with::GeneratorActivePower { generator_power_exponent: 100 };
    let broken = receiver.value_with::<points::GeneratorActivePower>(wrong).unwrap_err();
    let shown = "generator_active_power: the factor generator_power_exponent is 100, outside 0 to 5";
    assert_eq!(broken.to_string(), shown);
    let empty = Receiver::<Visualisation>::new(UNIT).value::<points::GeneratorFrequency>();
    assert_eq!(empty, Err(Error::NotReceived(Some("generator_frequency"))));
}

fn parameters_are_changed() {
    let mut client = Client::new(Device::new(), UNIT);
    // Without the password the device keeps what it has, and says so.
    let locked = client.write::<points::GeneratorFrequencySetpoint>(60.0);
    assert_eq!(locked.unwrap_err().to_string(), "generator_frequency_setpoint: 15360 was written, the device answered 12800");
    assert_eq!(client.write::<points::PasswordLevel2>(1234), Ok(()));
    assert_eq!(client.write::<points::GeneratorFrequencySetpoint>(60.0), Ok(()));
    assert_eq!(client.read::<points::GeneratorFrequencySetpoint>(), Ok(60.0));
    let far = client.write::<points::GeneratorFrequencySetpoint>(71.0);
    let Err(ClientError::Point(Error::OutOfRange(refused))) = far else { panic!("{far:?}") };
    assert_eq!(refused.point(), "generator_frequency_setpoint");
    let factor = with::GeneratorVoltageSetpoint400v {
        generator_voltage_factor: client.read_raw::<points::GeneratorVoltageFactor>().unwrap(),
    };
    assert_eq!(client.write_with::<points::GeneratorVoltageSetpoint400v>(400.0, factor), Ok(()));
    assert_eq!(client.read_with::<points::GeneratorVoltageSetpoint400v>(factor), Ok(400.0));
}

fn a_late_answer_answers_nothing() {
    let mut client = Client::new(Device::new(), UNIT).listening(Receiver::<Visualisation>::new(UNIT));
    client.transport().slow = 1;
    let late = client.read::<points::GeneratorFrequencySetpoint>();
    assert_eq!(late, Err(ClientError::Transport("nothing came", Some(About::Point("generator_frequency_setpoint")))));
    client.transport().parameters.insert(11, 15360);
    assert_eq!(client.read::<points::GeneratorFrequencySetpoint>(), Ok(60.0));
    assert_eq!(client.listener().taken(), 2);
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

async fn gateway(device: Slow) -> Result<(f64, f64), ClientError<&'static str>> {
    let mut client = AsyncClient::new(device, UNIT).listening(Receiver::<Visualisation>::new(UNIT));
    client.write::<points::PasswordLevel2>(1234).await?;
    client.write::<points::GeneratorFrequencySetpoint>(50.5).await?;
    let setpoint = client.read::<points::GeneratorFrequencySetpoint>().await?;
    Ok((setpoint, client.receive::<points::GeneratorFrequency>().await?))
}

fn main() {
    measured_values_are_published();
    parameters_are_changed();
    a_late_answer_answers_nothing();
    assert_eq!(finish(gateway(Slow(Device::new()))), Ok((50.5, 49.98)));
}
