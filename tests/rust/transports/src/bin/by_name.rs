//! Points by their names, on a server of tokio-modbus: each is read, each is written and read back.

use std::collections::HashMap;
use std::future::{ready, Ready};
use std::sync::{Arc, Mutex};
use std::thread::spawn;

use fieldscribe_runtime::modbus::{Client, Profile};
use fieldscribe_runtime::ClientError;
use fieldscribe_runtime::transports::tcp::TcpLine;
use fieldscribe_runtime::{AnyValue, Device, PointFacts, Points};
use hitachi_l200::Framing;
use tokio::net::TcpListener;
use tokio_modbus::server::tcp::{accept_tcp_connection, Server};
use tokio_modbus::server::Service;
use tokio_modbus::{ExceptionCode, Request, Response};

/// Registers, which are 60 before they are written, and coils, which are off.
#[derive(Clone, Default)]
struct Memory(Arc<Mutex<HashMap<(bool, u16), u16>>>);

impl Memory {
    fn words(&self, address: u16, count: u16) -> Vec<u16> {
        let words = self.0.lock().unwrap();
        (address..).take(count.into()).map(|address| words.get(&(true, address)).copied().unwrap_or(60)).collect()
    }

    fn bits(&self, address: u16, count: u16) -> Vec<bool> {
        let bits = self.0.lock().unwrap();
        (address..).take(count.into()).map(|address| bits.contains_key(&(false, address))).collect()
    }

    fn put(&self, is_word: bool, address: u16, values: impl IntoIterator<Item = u16>) {
        let mut all = self.0.lock().unwrap();
        for (address, value) in (address..).zip(values) {
            all.remove(&(is_word, address));
            if is_word || value != 0 {
                all.insert((is_word, address), value);
            }
        }
    }
}

impl Service for Memory {
    type Request = Request<'static>;
    type Response = Response;
    type Exception = ExceptionCode;
    type Future = Ready<Result<Response, ExceptionCode>>;

    fn call(&self, request: Request<'static>) -> Self::Future {
        ready(Ok(match request {
            Request::ReadCoils(address, count) => Response::ReadCoils(self.bits(address, count)),
            Request::ReadDiscreteInputs(address, count) => Response::ReadDiscreteInputs(self.bits(address, count)),
            Request::ReadHoldingRegisters(address, count) => Response::ReadHoldingRegisters(self.words(address, count)),
            Request::ReadInputRegisters(address, count) => Response::ReadInputRegisters(self.words(address, count)),
            Request::WriteSingleCoil(address, is_on) => {
                self.put(false, address, [u16::from(is_on)]);
                Response::WriteSingleCoil(address, is_on)
            }
            Request::WriteSingleRegister(address, word) => {
                self.put(true, address, [word]);
                Response::WriteSingleRegister(address, word)
            }
            Request::WriteMultipleRegisters(address, words) => {
                self.put(true, address, words.iter().copied());
                Response::WriteMultipleRegisters(address, words.len() as u16)
            }
            _ => return ready(Err(ExceptionCode::IllegalFunction)),
        }))
    }
}

fn server() -> String {
    let (sender, address) = std::sync::mpsc::channel();
    spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(async {
            let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
            sender.send(listener.local_addr().unwrap().to_string()).unwrap();
            let memory = Memory::default();
            let service = |_| Ok(Some(memory.clone()));
            let connected = |stream, from| ready(accept_tcp_connection(stream, from, service));
            Server::new(listener).serve(&connected, |_| ()).await.unwrap();
        });
    });
    address.recv().unwrap()
}

/// What could be written to a point: its first name, its limits, and small numbers.
fn candidates(point: &PointFacts) -> Vec<AnyValue<'static>> {
    let names = point.names().iter().take(1).map(|(_, name)| (*name).into());
    let limits = point.limits().into_iter().flat_map(|(low, high)| [high, low]).map(AnyValue::from);
    names.chain(limits).chain([60.0, 1.0, 0.0, 5.0, 500.0].map(AnyValue::from)).collect()
}

fn number(point: &PointFacts, value: AnyValue) -> f64 {
    match value {
        AnyValue::Integer(number) => number as f64,
        AnyValue::Number(number) => number,
        AnyValue::Name(name) => {
            let named = point.names().iter().find(|(_, one)| *one == name);
            named.map_or(f64::NAN, |(number, _)| *number as f64)
        }
    }
}

/// Reads all readable points, writes all writable ones and reads them back.
fn all_of<D: Device<Profile = Profile>>(points: Points<D>) {
    assert!(!points.is_empty());
    let profile = D::PROFILE.with_framings(&[Framing::Tcp]);
    let unit = Client::<_, D>::new(TcpLine::new(server()), Framing::Tcp, 1);
    let mut unit = unit.with_profile(Box::leak(Box::new(profile)));
    for point in points.iter().filter(|point| point.access.reads()) {
        unit.read_point(point).unwrap_or_else(|error| panic!("{error}"));
    }
    for point in points.iter().filter(|point| point.access.writes()) {
        let mut taken = candidates(&point).into_iter().filter(|value| match unit.write_point(point, *value) {
            Ok(()) => true,
            Err(ClientError::Point(_)) => false,
            Err(error) => panic!("{error}"),
        });
        let Some(value) = taken.next() else { panic!("{} takes nothing", point.name) };
        drop(taken);
        if point.access.reads() {
            let back = unit.read_point(point).unwrap();
            let same = back == value || (number(&point, back) - number(&point, value)).abs() < 1e-3;
            assert!(same, "{}: {value:?} was written, {back:?} is read", point.name);
        }
    }
}

fn main() {
    all_of(hitachi_l200::POINTS);
    all_of(nord_sk5xxe::POINTS);
    all_of(jumo_controller::POINTS);
}
