//! Controllers of embedded-can, blocking and not.

use embedded_can::{ErrorKind, Frame, StandardId};
use programs::bus::{Controller, OnBus, UNIT};
use woodward_mpu2s::runtime::transports::embedded_can::{Blocking, BusError, NonBlocking};
use woodward_mpu2s::runtime::About;
use woodward_mpu2s::{points as p, telegrams::Visualisation, Client, ClientError, Receiver, PROFILE};

fn waits() {
    let bus = Blocking::new(Controller::default(), &PROFILE);
    let mut client = Client::new(bus, UNIT).listening(Receiver::<Visualisation>::new(UNIT));
    client.write::<p::GeneratorFrequencySetpoint>(60.0).unwrap();
    assert_eq!(client.read::<p::GeneratorFrequencySetpoint>().unwrap(), 60.0);
    assert_eq!(client.listener().value::<p::GeneratorFrequency>(), Ok(49.98));
    let lost = client.receive::<p::OperatingHours>().unwrap_err();
    assert_eq!(lost, ClientError::Transport(BusError::Bus(ErrorKind::Overrun), Some(About::Point("operating_hours"))));
    assert_eq!(lost.to_string(), format!("operating_hours: {}", ErrorKind::Overrun));
}

fn does_not_wait() {
    let mut client = Client::new(NonBlocking::new(Controller::default(), &PROFILE, |waited| waited < 3), UNIT);
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
    assert_eq!(busy, ClientError::Transport(BusError::TimedOut, Some(About::Point("generator_frequency_setpoint"))));
}

fn main() {
    programs::log::keep();
    waits();
    assert_eq!(programs::log::kept()[..2], ["unit 5 -> 33Fh EE 05 00 0B 3C 00 D2 0E", "unit 5 <- 325h DD 00 05 15 13 86 00 00"]);
    does_not_wait();
    assert!(programs::log::kept().last().is_some_and(|last| last.starts_with("unit 5 <-"))); // no request that was not sent
}
