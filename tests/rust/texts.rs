//! Texts over Modbus: words in the order of their addresses on the line, characters in reading order in the value.

extern crate kitchen_sink;

use fieldscribe_runtime::client::Transport;
use fieldscribe_runtime::modbus::{crc, Client, Framing, Function, Profile, Request};
use fieldscribe_runtime::BuildError;
use fieldscribe_runtime::{Error, Text};
use rare::{points, Encodable, Point, Whole};

static PROFILE: Profile = Profile::new(&[Function::new(3, 125), Function::new(16, 123)], &[Framing::Rtu], (1, 9), None);

/// Registers from 100 on.
struct Registers([u16; 8]);

impl Transport for Registers {
    type Error = ();

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, ()> {
        assert_eq!(request[2..6], [0, 100, 0, 8]);
        let mut bytes = if request[1] == 16 {
            for (register, pair) in self.0.iter_mut().zip(request[7..].chunks(2)) {
                *register = u16::from_be_bytes([pair[0], pair[1]]);
            }
            request[..6].to_vec()
        } else {
            let words = self.0.iter().flat_map(|word| word.to_be_bytes());
            [1, 3, 16].into_iter().chain(words).collect()
        };
        bytes.extend(crc(&bytes).to_le_bytes());
        reply[..bytes.len()].copy_from_slice(&bytes);
        Ok(bytes.len())
    }
}

/// A device that speaks RTU alone is not asked over TCP.
fn framings_are_checked() {
    let mut buffer = [0; 256];
    let request = Request::read::<points::Name>(1);
    assert!(request.build(&PROFILE, &mut buffer).is_ok());
    assert_eq!(request.tcp(7).build(&PROFILE, &mut buffer), Err(BuildError::BadFraming));
}

fn main() {
    framings_are_checked();
    let text = Text::new("First to last").unwrap();
    let mut client = Client::for_profile(Registers([0; 8]), &PROFILE, Framing::Rtu, 1);
    assert_eq!(client.write::<points::Name>(text), Ok(()));
    assert_eq!(client.read::<points::Name>(), Ok(text));
    let registers = client.into_transport().0;
    assert_eq!((registers[7], registers[0]), (0x4669, 0x2020));
    assert_eq!(points::Name::ADDRESSES, [107, 106, 105, 104, 103, 102, 101, 100]);

    // A request that keeps its own words has room for four; it never sends fewer than the point has.
    let raw = points::Name::encode(text).unwrap();
    let mut frame = [0; 260];
    let own = Request::write::<points::Name>(1, raw);
    assert_eq!(own.build(&PROFILE, &mut frame), Err(BuildError::BadCount));
    let words = points::Name::to_words(raw);
    assert_eq!(Request::write_words::<points::Name>(1, &words).build(&PROFILE, &mut frame), Ok(25));

    // Three words out of order: 110, 112, 111.
    let raw = points::Note::encode(Text::from_bytes(b"aabbcc").unwrap()).unwrap();
    assert_eq!(points::Note::to_words(raw), [0x6161, 0x6363, 0x6262]);
    assert_eq!(points::Note::from_received([0x6161, 0x6363, 0x6262].into_iter()), Ok(raw));
    assert_eq!(points::Note::from_received([0x6161, 0x6363].into_iter()), Err(Error::WrongLength(Some("note"))));

    // Words that are not neighbours: no request reads all, and the words of several requests are the number.
    let scattered = Request::read::<kitchen_sink::points::SplitCounter>(1);
    assert_eq!(scattered.build(&PROFILE, &mut frame), Err(BuildError::BadCount));
    assert_eq!(kitchen_sink::points::SplitCounter::from_received([1, 2].into_iter()), Ok(0x1_0002));

    let blanks = Text::<4>::from_bytes(b"a  ").unwrap();
    assert_eq!((blanks.as_bytes(), blanks), (&b"a"[..], Text::new("a").unwrap()));
    assert_eq!(Text::<4>::from_bytes(b"a    "), Err(Error::BadText(None)));
    assert_eq!(Text::<4>::new("\u{100}"), Err(Error::BadText(None)));
    let high = Text::<4>::from_bytes(b"\xe4\0").unwrap();
    assert_eq!((high.as_str(), high.to_string().as_str()), (None, "ä\0"));
    assert_eq!((Text::<4>::EMPTY.as_str(), Text::<4>::default().to_string().len()), (Some(""), 0));
    assert_eq!(format!("{high:?}"), "\"ä\\0\"");
}
