//! Each point of a simulated device by our client: `simulated DEVICE tcp|rtu|serial PLACE UNIT`; a line for each point.

use std::env::args;
use std::time::Duration;

use fieldscribe_runtime::modbus::{Client, FoundBlock, Profile};
use fieldscribe_runtime::ClientError;
use fieldscribe_runtime::transports::{stream::StreamLine, tcp::TcpLine};
use fieldscribe_runtime::{AnyValue, Device, Points, Transport};
use fronius_datamanager::bases;
use hitachi_l200::Framing;

const SECOND: Duration = Duration::from_secs(1);
const BLOCKS: [FoundBlock; 8] = [
    bases::MODELS_1,
    bases::MODELS_103,
    bases::MODELS_120,
    bases::MODELS_121,
    bases::MODELS_122,
    bases::MODELS_123,
    bases::MODELS_160,
    bases::MODELS_124,
];

/// Reads all points, writes back what was read, and tries a number beyond the limits.
fn all_of<D: Device<Profile = Profile>>(points: Points<D>, line: impl Transport, framing: Framing, unit: u8) {
    let framings: &'static [Framing] = if framing == Framing::Tcp { &[Framing::Tcp] } else { &[Framing::Rtu] };
    let profile: &'static Profile = Box::leak(Box::new(D::PROFILE.with_framings(framings)));
    let mut client = Client::<_, D>::new(line, framing, unit).with_profile(profile);
    let mut known = "";
    for point in points.iter().filter(|point| point.access.reads()) {
        if let Some(block) = BLOCKS.iter().find(|block| block.name == point.base && block.name != known) {
            assert!(matches!(client.find(block), Ok(Some(_))), "{}", block.name);
            known = block.name;
        }
        let Ok(value) = client.read_point(point) else {
            println!("{} unread", point.name);
            continue;
        };
        let refused = match point.limits() {
            Some((_, high)) if point.access.writes() => {
                let beyond = client.write_point(point, AnyValue::from(high + 1e12));
                matches!(beyond, Err(ClientError::Point(_)))
            }
            _ => false,
        };
        let written = point.access.writes() && client.write_point(point, value).is_ok();
        println!("{} {value} {written} {refused}", point.name);
    }
}

fn asked(device: &str, line: impl Transport, framing: Framing, unit: u8) {
    match device {
        "eastron_sdm630" => all_of(eastron_sdm630::POINTS, line, framing, unit),
        "fronius_datamanager" => all_of(fronius_datamanager::POINTS, line, framing, unit),
        "hitachi_l200" => all_of(hitachi_l200::POINTS, line, framing, unit),
        "jumo_controller" => all_of(jumo_controller::POINTS, line, framing, unit),
        _ => all_of(nord_sk5xxe::POINTS, line, framing, unit),
    }
}

fn main() {
    let [device, framing, place, unit] = [1, 2, 3, 4].map(|number| args().nth(number).unwrap());
    let unit = unit.parse().unwrap();
    if framing == "serial" {
        let port = serialport::new(place, 19200).timeout(SECOND).open().unwrap();
        return asked(&device, StreamLine::new(port), Framing::Rtu, unit);
    }
    let framing = if framing == "tcp" { Framing::Tcp } else { Framing::Rtu };
    asked(&device, TcpLine::new(format!("127.0.0.1:{place}")), framing, unit);
}
