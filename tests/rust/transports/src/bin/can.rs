//! Controllers of embedded-can on a bus in memory, with an MPU2-S that answers.

use std::collections::VecDeque;
use std::convert::Infallible;

use embedded_can::{blocking, nb as non_blocking, ErrorKind, ExtendedId, Frame, Id, StandardId};
use woodward_mpu2s::runtime::transports::embedded_can::{Blocking, BusError, NonBlocking};
use woodward_mpu2s::{points as p, telegrams::Visualisation, Client, ClientError, Receiver, PROFILE};

const UNIT: u8 = 5;

#[derive(Clone, Debug, PartialEq)]
struct OnBus {
    id: Id,
    is_remote: bool,
    data: Vec<u8>,
}

impl Frame for OnBus {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        Some(Self { id: id.into(), is_remote: false, data: data.to_vec() })
    }

    fn new_remote(id: impl Into<Id>, _: usize) -> Option<Self> {
        Some(Self { id: id.into(), is_remote: true, data: Vec::new() })
    }

    fn is_extended(&self) -> bool {
        matches!(self.id, Id::Extended(_))
    }

    fn is_remote_frame(&self) -> bool {
        self.is_remote
    }

    fn id(&self) -> Id {
        self.id
    }

    fn dlc(&self) -> usize {
        self.data.len()
    }

    fn data(&self) -> &[u8] {
        &self.data
    }
}

/// A controller on the bus of one device, which holds parameters and sends part of its telegram now and then.
#[derive(Default)]
struct Controller {
    setpoint: u16,
    came: VecDeque<OnBus>,
    busy: u32,
    replaced: Option<OnBus>,
    sent: usize,
}

fn summed(bytes: [u8; 6]) -> [u8; 8] {
    let [a, b, c, d, e, f] = bytes;
    [a, b, c, d, e, f, a ^ c ^ e, b ^ d ^ f]
}

impl Controller {
    fn hears(&mut self, frame: &OnBus) {
        self.sent += 1;
        if frame.id == Id::Standard(StandardId::MAX) {
            return; // of somebody else
        }
        let (Id::Standard(id), &[kind, unit, a, b, c, d, ..]) = (frame.id, frame.data()) else { panic!("{frame:?}") };
        assert_eq!(id.as_raw(), 0x33F);
        if kind == 0xEE {
            self.setpoint = u16::from_be_bytes([c, d]);
        }
        let standard = StandardId::new(0x320 + u16::from(UNIT)).unwrap();
        let [high, low] = self.setpoint.to_be_bytes();
        let wrong = summed([kind, unit, a, b, 0xAA, 0xAA]);
        let same_number = ExtendedId::new(u32::from(standard.as_raw())).unwrap();
        self.came.extend([
            OnBus::new(same_number, &wrong).unwrap(),
            OnBus::new_remote(standard, 8).unwrap(),
            OnBus::new(standard, &[0xDD, 0, 0x05, 0x15, 0x13, 0x86, 0, 0]).unwrap(),
            OnBus::new(standard, &summed([kind, unit, a, b, high, low])).unwrap(),
        ]);
    }
}

impl blocking::Can for Controller {
    type Frame = OnBus;
    type Error = ErrorKind;

    fn transmit(&mut self, frame: &OnBus) -> Result<(), ErrorKind> {
        self.hears(frame);
        Ok(())
    }

    fn receive(&mut self) -> Result<OnBus, ErrorKind> {
        self.came.pop_front().ok_or(ErrorKind::Overrun)
    }
}

impl non_blocking::Can for Controller {
    type Frame = OnBus;
    type Error = Infallible;

    fn transmit(&mut self, frame: &OnBus) -> nb::Result<Option<OnBus>, Infallible> {
        if self.busy > 0 {
            self.busy -= 1;
            return Err(nb::Error::WouldBlock);
        }
        self.hears(frame);
        Ok(self.replaced.take())
    }

    fn receive(&mut self) -> nb::Result<OnBus, Infallible> {
        self.came.pop_front().ok_or(nb::Error::WouldBlock)
    }
}

fn waits() {
    let bus = Blocking::new(Controller::default(), &PROFILE);
    let mut client = Client::new(bus, &PROFILE, UNIT).listening(Receiver::<Visualisation>::new(UNIT));
    client.write::<p::GeneratorFrequencySetpoint>(60.0).unwrap();
    assert_eq!(client.read::<p::GeneratorFrequencySetpoint>().unwrap(), 60.0);
    assert_eq!(client.listener().value::<p::GeneratorFrequency>(), Ok(49.98));
    let lost = client.receive::<p::OperatingHours>().unwrap_err();
    assert_eq!(lost, ClientError::Transport(BusError::Bus(ErrorKind::Overrun), Some("operating_hours")));
    assert_eq!(lost.to_string(), format!("operating_hours: {}", ErrorKind::Overrun));
}

fn does_not_wait() {
    let mut client = Client::new(NonBlocking::new(Controller::default(), &PROFILE, |waited| waited < 3), &PROFILE, UNIT);
    let controller = client.transport().controller();
    controller.busy = 3;
    controller.replaced = OnBus::new(StandardId::MAX, &[0]);
    client.write::<p::GeneratorFrequencySetpoint>(60.0).unwrap();
    assert_eq!(client.transport().controller().sent, 2);
    let late = client.transport().controller().came.len();
    client.transport().controller().came.extend(OnBus::new_remote(StandardId::MAX, 0));
    assert_eq!(client.read::<p::GeneratorFrequencySetpoint>().unwrap(), 60.0);
    assert_eq!((late, client.transport().controller().came.len()), (0, 0));
    client.transport().controller().busy = 4;
    let busy = client.read::<p::GeneratorFrequencySetpoint>().unwrap_err();
    assert_eq!(busy, ClientError::Transport(BusError::TimedOut, Some("generator_frequency_setpoint")));
}

fn main() {
    waits();
    does_not_wait();
}
