//! A controller of embedded-can on a bus in memory, with an MPU2-S that answers.

use std::collections::VecDeque;
use std::convert::Infallible;

use embedded_can::{blocking, nb as non_blocking, ErrorKind, ExtendedId, Frame, Id, StandardId};

/// The number of the unit.
pub const UNIT: u8 = 5;

/// A frame.
#[derive(Clone, Debug, PartialEq)]
pub struct OnBus {
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
pub struct Controller {
    /// Whether it sends its telegram unasked.
    pub speaks: bool,
    pub setpoint: u16,
    pub came: VecDeque<OnBus>,
    pub busy: u32,
    pub replaced: Option<OnBus>,
    pub sent: usize,
}

fn summed(bytes: [u8; 6]) -> [u8; 8] {
    let [a, b, c, d, e, f] = bytes;
    [a, b, c, d, e, f, a ^ c ^ e, b ^ d ^ f]
}

fn from_unit() -> StandardId {
    StandardId::new(0x320 + u16::from(UNIT)).unwrap()
}

/// The frame with 49.98 Hz.
fn part_of_the_telegram() -> OnBus {
    OnBus::new(from_unit(), &[0xDD, 0, 0x05, 0x15, 0x13, 0x86, 0, 0]).unwrap()
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
        let standard = from_unit();
        let [high, low] = self.setpoint.to_be_bytes();
        let wrong = summed([kind, unit, a, b, 0xAA, 0xAA]);
        let same_number = ExtendedId::new(u32::from(standard.as_raw())).unwrap();
        self.came.extend([
            OnBus::new(same_number, &wrong).unwrap(),
            OnBus::new_remote(standard, 8).unwrap(),
            part_of_the_telegram(),
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
        let unasked = self.speaks.then(part_of_the_telegram);
        self.came.pop_front().or(unasked).ok_or(ErrorKind::Overrun)
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
