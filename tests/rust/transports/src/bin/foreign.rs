//! Asks by tokio-modbus alone: `foreign tcp|rtu PORT UNIT` or `foreign serial PATH UNIT`; a line for each request.

use std::env::args;
use std::io::stdin;

use tokio::net::TcpStream;
use tokio_modbus::client::{rtu, tcp, Context, Reader, Writer};
use tokio_modbus::{Result, Slave};

async fn connected(framing: &str, place: &str, unit: Slave) -> Context {
    let socket = || format!("127.0.0.1:{place}").parse().unwrap();
    match framing {
        "tcp" => tcp::connect_slave(socket(), unit).await.unwrap(),
        "rtu" => {
            let stream = TcpStream::connect(socket()).await.unwrap();
            stream.set_nodelay(true).unwrap();
            rtu::attach_slave(stream, unit)
        }
        _ => rtu::attach_slave(tokio_serial::SerialStream::open(&tokio_serial::new(place, 19200)).unwrap(), unit),
    }
}

fn words(bits: Vec<bool>) -> Vec<u16> {
    bits.into_iter().map(u16::from).collect()
}

async fn asked(bus: &mut Context, function: u16, address: u16, items: &[u16]) -> Result<Vec<u16>> {
    let bits: Vec<bool> = items.iter().map(|item| *item != 0).collect();
    let nothing = |done: Result<()>| done.map(|done| done.map(|()| Vec::new()));
    match function {
        1 => bus.read_coils(address, items[0]).await.map(|read| read.map(words)),
        2 => bus.read_discrete_inputs(address, items[0]).await.map(|read| read.map(words)),
        3 => bus.read_holding_registers(address, items[0]).await,
        4 => bus.read_input_registers(address, items[0]).await,
        5 => nothing(bus.write_single_coil(address, bits[0]).await),
        6 => nothing(bus.write_single_register(address, items[0]).await),
        15 => nothing(bus.write_multiple_coils(address, &bits).await),
        _ => nothing(bus.write_multiple_registers(address, items).await),
    }
}

#[tokio::main(flavor = "current_thread")]
async fn main() {
    let [framing, place, unit] = [1, 2, 3].map(|number| args().nth(number).unwrap());
    let mut bus = connected(&framing, &place, Slave(unit.parse().unwrap())).await;
    for line in stdin().lines() {
        let numbers: Vec<u16> = line.unwrap().split_whitespace().map(|word| word.parse().unwrap()).collect();
        let items = if numbers[0] < 5 { &numbers[2..] } else { &numbers[3..] };
        match asked(&mut bus, numbers[0], numbers[1], items).await {
            Ok(Ok(read)) => println!("ok {}", read.iter().map(u16::to_string).collect::<Vec<_>>().join(" ")),
            Ok(Err(refused)) => println!("refused {}", u8::from(refused)),
            Err(error) => println!("failed {error}"),
        }
    }
}
