// SPDX-License-Identifier: 0BSD
//! What clients, requests and answers of USS do for every device, also where no vector of this one shows it.

#![allow(clippy::too_many_lines, reason = "a line for each case")]

use fieldscribe_runtime::uss::{
    broadcast, check_byte, AsyncClient, Client, FixedBits, Link, LocalClient, Parameter, Profile,
    Received, Request, Sent, Task, Value,
};
use fieldscribe_runtime::{
    About, AnyDevice, BitGroup, BuildError, ClientError, Error, Point, ReplyError, Space, Whole,
};

use super::now;
use super::runtime::{at_once, Line, Lost, REFUSED};

made_up!(Word u16, Parameter 700, &[700], 1);
made_up!(Long u32, Parameter 2001, &[2001], 2);
made_up!(Group u16, Parameter 60, &[60], 1);
made_up!(Speed u16, Telegram 1, &[1], 1);
made_up!(Jog u16, Telegram 0, &[0], 1);
made_up!(Position u32, Telegram 1, &[2, 1], 2);
made_up!(Far u32, Telegram 2, &[2, 3], 2);

/// The control word, whose highest bits are constant.
#[derive(Clone, Copy)]
struct Control;

impl Point for Control {
    type Device = AnyDevice;
    type Raw = u16;
    type Value = u16;
    const NAME: &'static str = "Control";
    const SPACE: Space = Space::Telegram;
    const ADDRESS: u16 = 0;
    const FIXED_MASK: u32 = 0xC000;
    const FIXED_BITS: u32 = 0x8000;
}

/// A number in binary32, which a drive rounds.
#[derive(Clone, Copy)]
struct Ramp;

impl Point for Ramp {
    type Device = AnyDevice;
    type Raw = u32;
    type Value = u32;
    const NAME: &'static str = "Ramp";
    const SPACE: Space = Space::Parameter;
    const ADDRESS: u16 = 1120;
    const INDEX: Option<u8> = Some(3);
    const FLOATING: bool = true;
    const WORDS: u16 = 2;
}

impl fieldscribe_runtime::Writable for Ramp {
    type With = ();

    fn check_with(_: u32, (): ()) -> Result<(), Error> {
        Ok(())
    }
}

impl Whole for Word {}
impl Whole for Long {}
impl Whole for Ramp {}
impl Whole for Speed {}
impl Whole for Position {}
impl Whole for Far {}
impl Parameter for Word {}
impl Parameter for Long {}
impl Parameter for Group {}
impl Parameter for Ramp {}
impl Sent for Control {}
impl Sent for Speed {}
impl Sent for Jog {}
impl Sent for Position {}
impl Sent for Far {}
impl Received for Speed {}
impl Received for Position {}
impl Received for Far {}

impl BitGroup for Group {
    const SHIFT: u32 = 4;
    const MASK: u16 = 0x00F0;
}

impl BitGroup for Jog {
    const SHIFT: u32 = 8;
    const MASK: u16 = 0x0300;
}

const TASKS: &[Task] = &[
    Task::new(0, &[0]),
    Task::new(1, &[1, 2, 4, 5]),
    Task::new(2, &[1]),
    Task::new(3, &[2]),
    Task::new(7, &[4]),
    Task::new(8, &[5]),
    Task::new(11, &[5]),
    Task::new(12, &[4]),
    Task::new(13, &[2]),
    Task::new(14, &[1]),
];
const FIXED: &[FixedBits] = &[FixedBits::of::<Control>()];
const LENGTHS: &[u8] = &[0, 3, 4, 127];
static PROFILE: Profile =
    Profile::new(TASKS, (1, 30), LENGTHS, (0, 20), Some(32), FIXED).naming(named);
static FEW: Profile = Profile::new(TASKS, (0, 31), &[4], (2, 2), None, &[]);

/// What the drive says that cannot do it now.
const NOT_NOW: ReplyError = ReplyError::Refused {
    error: 17,
    name: Some("not_now"),
};

/// What the drive calls its one error value.
fn named(error: u16) -> Option<&'static str> {
    (error == 17).then_some("not_now")
}

/// Panics where the runtime is not as it should be.
pub fn check() {
    requests();
    broadcasts();
    confirmations();
    answers();
    parameters_at_once();
    parameters_now();
    process_at_once();
    process_now();
    parameters_staying();
    process_staying();
}

const fn other<E>(written: u32, answered: u32, point: &'static str) -> ClientError<E> {
    let answered = Some(answered);
    let error = ReplyError::OtherNumber { written, answered };
    ClientError::Reply(error, Some(About::Point(point)))
}

/// A telegram of these words to or from unit 3.
fn telegram(words: &str) -> Vec<u8> {
    let words = super::bytes(&words.replace(' ', ""));
    let length = u8::try_from(words.len() + 2).expect("a telegram");
    let mut bytes = [&[2, length, 3], words.as_slice()].concat();
    bytes.push(bytes.iter().fold(0, |check, byte| check ^ byte));
    bytes
}

fn built(request: Request, link: Link, words: &[u16]) -> Result<Vec<u8>, BuildError> {
    let mut buffer = [0; 60];
    let length = request.build(&PROFILE, link, words, &mut buffer)?;
    for less in [0, length - 1] {
        let short = request.build(&PROFILE, link, words, &mut buffer[..less]);
        assert_eq!(short, Err(BuildError::BufferTooSmall));
    }
    Ok(buffer[..length].to_vec())
}

fn requests() {
    let (four, variable) = (Link::new(4, 0), Link::new(127, 0));
    for (request, link, words) in [
        (Request::cyclic(3), Link::new(0, 0), ""),
        (Request::cyclic(3), Link::new(3, 0), "0000 0000 0000"),
        (Request::read::<Word>(3), Link::new(3, 0), "12bc 0000 0000"),
        (Request::read::<Long>(3), variable, "1001 8000 0000 0000"),
        (Request::write::<Word>(3, 7), four, "22bc 0000 0000 0007"),
        (
            Request::write::<Word>(3, 7),
            four.single_first(),
            "22bc 0000 0007 0000",
        ),
        (
            Request::write::<Word>(3, 7),
            variable,
            "22bc 0000 0007 0000",
        ),
        (
            Request::store::<Word>(3, 7),
            variable,
            "e2bc 0000 0007 0000",
        ),
        (
            Request::write::<Long>(3, 0x0001_0203),
            four,
            "3001 8000 0001 0203",
        ),
        (
            Request::store::<Long>(3, 0x0001_0203),
            four,
            "d001 8000 0001 0203",
        ),
        (
            Request::write::<Ramp>(3, 0x0001_0203),
            four,
            "8460 0003 0001 0203",
        ),
        (
            Request::store::<Ramp>(3, 0x0001_0203),
            four,
            "b460 0003 0001 0203",
        ),
        (
            Request::update::<Group>(3, 0xABCD, 7),
            variable,
            "203c 0000 ab7d 0000",
        ),
        (
            Request::store_update::<Group>(3, 0xABCD, 7),
            variable,
            "e03c 0000 ab7d 0000",
        ),
        (
            Request::new(3, 12, 31_999, 255).with(Value::Word(7)),
            four,
            "c7cf f0ff 0000 0007",
        ),
    ] {
        assert_eq!(built(request, link, &[]), Ok(telegram(words)));
    }
    assert_eq!(
        built(Request::cyclic(3), Link::new(0, 2), &[0xA1B2, 3]),
        Ok(telegram("a1b2 0003"))
    );
    let double = Request::write::<Long>(3, 1);
    for (request, link, words, error) in [
        (Request::cyclic(3), Link::new(5, 0), 0, BuildError::BadLink),
        (
            Request::cyclic(3),
            Link::new(4, 21),
            21,
            BuildError::BadLink,
        ),
        (Request::cyclic(3), Link::new(4, 2), 1, BuildError::BadLink),
        (Request::cyclic(0), four, 0, BuildError::BadUnit),
        (Request::cyclic(31), four, 0, BuildError::BadUnit),
        (Request::new(3, 6, 1, 0), four, 0, BuildError::BadTask),
        (
            Request::new(3, 1, 1, 0),
            Link::new(0, 0),
            0,
            BuildError::BadTask,
        ),
        (
            Request::new(3, 1, 32_000, 0),
            four,
            0,
            BuildError::BadParameter,
        ),
        (Request::new(3, 1, 1, 256), four, 0, BuildError::BadIndex),
        (double, Link::new(3, 0), 0, BuildError::NoRoom),
    ] {
        assert_eq!(built(request, link, &[0; 21][..words]), Err(error));
    }
    assert_eq!(
        [1, 30].map(|unit| built(Request::cyclic(unit), four, &[]).is_ok()),
        [true, true]
    );
    let few = |link, words: &[u16]| Request::cyclic(3).build(&FEW, link, words, &mut [0; 60]);
    assert_eq!(few(Link::new(4, 2), &[1, 2]), Ok(16));
    assert_eq!(few(Link::new(4, 1), &[1]), Err(BuildError::BadLink));
    assert_eq!(few(Link::new(4, 3), &[1, 2, 3]), Err(BuildError::BadLink));
    assert_eq!(check_byte(&telegram("a1b2 0003")), 0);
}

fn broadcasts() {
    let mut buffer = [0; 60];
    let link = Link::new(127, 2);
    let masks = [6, 0xFFFF, 1, 2];
    assert_eq!(
        broadcast(&PROFILE, link, masks, &[5, 6], &mut buffer),
        Ok(16)
    );
    assert_eq!(buffer[..16], all("0006 ffff 0001 0002 0005 0006"));
    let few = broadcast(&FEW, link, masks, &[5, 6], &mut buffer);
    assert_eq!(few, Err(BuildError::NoBroadcast));
    let short = broadcast(&PROFILE, link, masks, &[5], &mut buffer);
    assert_eq!(short, Err(BuildError::BadLink));
    let small = broadcast(&PROFILE, link, masks, &[5, 6], &mut buffer[..15]);
    assert_eq!(small, Err(BuildError::BufferTooSmall));
}

fn confirmations() {
    let confirms = |written: f32, answered: f32| {
        let value = answered.to_bits();
        let received = telegram(&format!("5460 0003 {value:08x}"));
        let request = Request::write::<Ramp>(3, written.to_bits());
        let reply = request.parse(&PROFILE, Link::new(4, 0), &received);
        let reply = reply.expect("an answer");
        (
            request.is_confirmed::<Ramp>(&reply),
            request.is_confirmed::<Long>(&reply),
        )
    };
    assert_eq!(confirms(1024.0, 1024.0), (true, true));
    assert_eq!(
        [1025.0, 1023.0].map(|answered| confirms(1024.0, answered)),
        [(true, false); 2]
    );
    assert_eq!(
        [1025.5, 1022.5].map(|answered| confirms(1024.0, answered)),
        [(false, false); 2]
    );
    assert_eq!(
        [-1025.0, -1023.0].map(|answered| confirms(-1024.0, answered)),
        [(true, false); 2]
    );
    assert_eq!(
        [-1025.5, 1024.0].map(|answered| confirms(-1024.0, answered)),
        [(false, false); 2]
    );
    assert_eq!(confirms(0.0, f32::MIN_POSITIVE), (false, false));
    assert!(!confirms(f32::NAN, f32::NAN).0);
}

fn answers() {
    let link = Link::new(4, 2);
    let request = Request::read::<Word>(3);
    let parsed = |bytes: &[u8]| {
        request
            .parse(&PROFILE, link, bytes)
            .map(|reply| reply.value())
    };
    let received = telegram("12bc 0000 0000 0007 a1b2 0003");
    let reply = request.parse(&PROFILE, link, &received).expect("an answer");
    assert_eq!(
        (reply.response(), reply.value(), reply.word()),
        (1, Value::Word(7), Ok(7))
    );
    assert_eq!(reply.words().collect::<Vec<_>>(), [0xA1B2, 3]);
    assert_eq!(
        (reply.raw::<Word>(), reply.raw::<Long>()),
        (Ok(7), Err(Error::WrongLength(Some("Long"))))
    );
    let first = request.parse(&PROFILE, link.single_first(), &received);
    assert_eq!(first.map(|reply| reply.value()), Ok(Value::Word(0)));
    let double = telegram("22bc 0000 0001 0203 a1b2 0003");
    let reply = request.parse(&PROFILE, link, &double).expect("an answer");
    assert_eq!(
        (reply.value(), reply.word()),
        (Value::Double(0x0001_0203), Err(Error::WrongLength(None)))
    );
    assert_eq!(
        (reply.raw::<Long>(), reply.raw::<Word>()),
        (Ok(0x0001_0203), Err(Error::WrongLength(Some("Word"))))
    );
    let cyclic = Request::cyclic(3)
        .parse(&PROFILE, link, &received)
        .expect("an answer");
    assert_eq!(
        (cyclic.response(), cyclic.value(), cyclic.word()),
        (1, Value::Nothing, Err(Error::WrongLength(None)))
    );
    let none = telegram("a1b2 0003");
    let reply = Request::cyclic(3)
        .parse(&PROFILE, Link::new(0, 2), &none)
        .expect("an answer");
    assert_eq!((reply.response(), reply.words().count()), (0, 2));
    for (words, error) in [
        ("02bc 0000 0000 0007 a1b2 0003", ReplyError::NoAnswer),
        ("72bc 0000 0011 0007 a1b2 0003", NOT_NOW),
        ("82bc 0000 0000 0007 a1b2 0003", ReplyError::NoRights),
        (
            "32bc 0000 0000 0007 a1b2 0003",
            ReplyError::WrongResponse {
                task: 1,
                response: 3,
            },
        ),
        ("12bd 0000 0000 0007 a1b2 0003", ReplyError::WrongParameter),
        ("12bc 0001 0000 0007 a1b2 0003", ReplyError::WrongParameter),
        ("12bc 0000 0000 0007 a1b2", ReplyError::WrongLength),
        (
            "12bc 0000 0000 0007 a1b2 0003 0000",
            ReplyError::WrongLength,
        ),
        ("12bc 0000 0000 0007 a1b2 00", ReplyError::WrongLength),
        ("a1b2", ReplyError::WrongLength),
    ] {
        assert_eq!(parsed(&telegram(words)), Err(error));
    }
    let changed = |place: usize, byte| {
        let mut bytes = received.clone();
        bytes[place] ^= byte;
        parsed(&bytes)
    };
    assert_eq!(changed(0, 1), Err(ReplyError::WrongStart));
    assert_eq!(
        [1, 3].map(|byte| changed(1, byte)),
        [Err(ReplyError::WrongLength); 2]
    );
    assert_eq!(
        (changed(2, 1), changed(15, 1)),
        (Err(ReplyError::WrongCheck), Err(ReplyError::WrongCheck))
    );
    assert_eq!(
        (parsed(&[]), parsed(&[2, 0, 3])),
        (Err(ReplyError::WrongStart), Err(ReplyError::WrongLength))
    );
    let other = Request::read::<Word>(4).parse(&PROFILE, link, &received);
    assert_eq!(
        other.map(|_| ()),
        Err(ReplyError::WrongUnit {
            expected: 4,
            received: 3
        })
    );
    for (pkw, sizes) in [
        (3, [false, true, false, false]),
        (127, [false, true, true, true]),
        (4, [false, false, true, false]),
    ] {
        let parts = [
            "12bc 0000",
            "12bc 0000 0007",
            "12bc 0000 0007 0000",
            "12bc 0000 0007 0000 0000",
        ];
        let fits = parts.map(|part| {
            request
                .parse(&PROFILE, Link::new(pkw, 0), &telegram(part))
                .is_ok()
        });
        assert_eq!(fits, sizes);
    }
    let words = request
        .process_words(link, &telegram("72bc 0000 0011 0007 a1b2 0003"))
        .map(Iterator::collect);
    assert_eq!(words, Ok(vec![0xA1B2, 3]));
}

/// The same conversations with the client that blocks and the one that does not.
macro_rules! conversations {
    ($parameters:ident $process:ident $client:ident $wait:ident) => {
        fn $parameters() {
            let step = |sent: &str, came: &str| match came {
                "?" | "!" => (telegram(sent), came.to_owned()),
                came => (telegram(sent), super::hex(&telegram(came))),
            };
            let line = Line::new(&[
                step("12bc 0000 0000 0000 0000", "12bc 0000 0007 00f0"),
                step("12bc 0000 0000 0000 0000", "12bc 0000 ffff 00f0"),
                step("1001 8000 0000 0000 0000", "2001 8000 0001 0002 00f0"),
                step("22bc 0000 0008 0000 0000", "12bc 0000 0008 00f0"),
                step("e2bc 0000 0009 0000 0000", "12bc 0000 0008 00f0"),
                step("3001 8000 0001 0203 0000", "7001 8000 0011 00f0"),
                step("d001 8000 0001 0203 0000", "?"),
                step("103c 0000 0000 0000 0000", "103c 0000 abcd 00f0"),
                step("203c 0000 ab7d 0000 0000", "103c 0000 ab7d 00f0"),
                step("103c 0000 0000 0000 0000", "103c 0000 abcd 00f0"),
                step("e03c 0000 ab6d 0000 0000", "103c 0000 ab7d 00f0"),
                step("103c 0000 0000 0000 0000", "203c 0000 0000 abcd 00f0"),
                step("12bc 0000 0000 0000 0000", "!"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(127, 1), 3);
            let wrong = ClientError::Point(REFUSED);
            assert_eq!($wait(client.read::<Word>()), Ok(7));
            assert_eq!(client.transport().space, 256);
            assert_eq!($wait(client.read::<Word>()), Err(wrong));
            assert_eq!($wait(client.read_with::<Long>(())), Ok(0x0001_0002));
            assert_eq!($wait(client.write::<Word>(8)), Ok(()));
            let mismatch = other(9, 8, "Word");
            assert_eq!($wait(client.store::<Word>(9)), Err(mismatch));
            let refused = ClientError::Reply(NOT_NOW, Some(About::Point("Long")));
            assert_eq!(
                $wait(client.write_with::<Long>(0x0001_0203, ())),
                Err(refused)
            );
            let lost = ClientError::Transport(Lost, Some(About::Point("Long")));
            assert_eq!($wait(client.store_with::<Long>(0x0001_0203, ())), Err(lost));
            for found in [
                $wait(client.write::<Word>(0xFFFF)),
                $wait(client.store::<Word>(0xFFFF)),
                $wait(client.update::<Group>(0xFFFF)),
                $wait(client.store_update::<Group>(0xFFFF)),
            ] {
                assert_eq!(found, Err(wrong));
            }
            assert_eq!($wait(client.update::<Group>(7)), Ok(()));
            let mismatch = other(0xAB6D, 0xAB7D, "Group");
            assert_eq!($wait(client.store_update::<Group>(6)), Err(mismatch));
            let long = ClientError::Point(Error::WrongLength(Some("Group")));
            assert_eq!($wait(client.update::<Group>(7)), Err(long));
            let long = ClientError::Reply(ReplyError::WrongLength, Some(About::Point("Word")));
            assert_eq!($wait(client.read_raw::<Word>()), Err(long));
            let other = $wait(client.exchange(Request::cyclic(4))).map(|_| ());
            assert_eq!(other, Err(ClientError::Build(BuildError::OtherUnit, None)));
            client.into_transport().done();
            let line = Line::new(&[
                step("1001 8000 0000 0000 0000", "2001 8000 0001 0002 00f0"),
                step("22bc 0000 0007 0000 0000", "12bc 0000 0007 00f0"),
                step("22bc 0000 0008 0000 0000", "12bc 0000 0008 00f0"),
                step("e2bc 0000 0009 0000 0000", "12bc 0000 0009 00f0"),
                step("e2bc 0000 000a 0000 0000", "12bc 0000 000a 00f0"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(127, 1), 3);
            assert_eq!($wait(client.read_count::<Long>()), Ok([0x0001_0002]));
            assert_eq!($wait(client.write_count::<Word>([7])), Ok(()));
            assert_eq!($wait(client.write_raw::<Word>(8)), Ok(()));
            assert_eq!($wait(client.store_count::<Word>([9])), Ok(()));
            assert_eq!($wait(client.store_raw::<Word>(10)), Ok(()));
            for found in [
                $wait(client.write_count::<Word>([0xFFFF])),
                $wait(client.write_raw::<Word>(0xFFFF)),
                $wait(client.store_count::<Word>([0xFFFF])),
                $wait(client.store_raw::<Word>(0xFFFF)),
            ] {
                assert_eq!(found, Err(wrong));
            }
            client.into_transport().done();
        }

        fn $process() {
            let step = |sent: &str, came: &str| match came {
                "?" => (telegram(sent), came.to_owned()),
                came => (telegram(sent), super::hex(&telegram(came))),
            };
            let line = Line::new(&[
                step("0000 0000 0000", "00a1 00b2 00c3"),
                step("0000 0005 0000", "00a1 00b2 ffff"),
                step("0300 0005 0000", "?"),
                step("0000 0000 0000", "00a1 00b2 00c3"),
                step("0000 0009 0008", "00a1 00b2 00c3"),
                step("0000 0009 0008", "?"),
                step("0000 0009 0008", "00a1 ffff ffff"),
                step("0000 0009 0001", "00a1 00b2"),
                step("0000 0000 0000", "00a1 00b2 00c3"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(0, 3), 3);
            let far = Error::BeyondLink(Some("Far"));
            assert_eq!(client.heard_word(0), Err(Error::NotHeard(None)));
            assert_eq!(client.heard::<Speed>(), Err(Error::NotHeard(Some("Speed"))));
            assert_eq!($wait(client.cycle()), Ok(()));
            assert_eq!(
                [0, 2, 3].map(|one| client.heard_word(one)),
                [Ok(0xA1), Ok(0xC3), Err(Error::BeyondLink(None))]
            );
            assert_eq!(
                (client.heard::<Speed>(), client.heard_with::<Position>(())),
                (Ok(0xB2), Ok(0x00C3_00B2))
            );
            assert_eq!(client.heard::<Far>(), Err(far));
            assert_eq!(client.set::<Speed>(0xFFFF), Err(REFUSED));
            assert_eq!(client.set_bits::<Jog>(0xFFFF), Err(REFUSED));
            assert_eq!(client.set::<Far>(1), Err(far));
            assert_eq!(client.set_word(3, 1), Err(Error::BeyondLink(None)));
            assert_eq!(client.words(), [0, 0, 0]);
            assert_eq!(client.set_count::<Speed>([0xFFFF]), Err(REFUSED));
            assert_eq!(client.set_count::<Speed>([4]), Ok(()));
            assert_eq!(client.words(), [0, 4, 0]);
            assert_eq!(client.heard_count::<Position>(), Ok([0x00C3_00B2]));
            assert_eq!(client.set_count::<Speed>([0]), Ok(()));
            assert_eq!($wait(client.send::<Speed>(5)), Ok(()));
            assert_eq!(client.words(), [0, 5, 0]);
            let lost = ClientError::Transport(Lost, None);
            assert_eq!($wait(client.send_bits::<Jog>(3)), Err(lost.of::<Jog>()));
            assert_eq!(
                (client.words(), client.heard_word(0)),
                (&[0; 3][..], Err(Error::NotHeard(None)))
            );
            assert_eq!($wait(client.receive::<Speed>()), Ok(0xB2));
            assert_eq!($wait(client.send_with::<Position>(0x0008_0009, ())), Ok(()));
            // Words that the drive has already stay when an answer is lost.
            assert_eq!($wait(client.cycle()), Err(lost));
            assert_eq!(client.words(), [0, 9, 8]);
            let wrong = ClientError::Point(REFUSED);
            assert_eq!($wait(client.receive_with::<Speed>(())), Err(wrong));
            assert_eq!(client.set_word(2, 1), Ok(()));
            let short = ClientError::Reply(ReplyError::WrongLength, None);
            assert_eq!($wait(client.cycle()), Err(short));
            assert_eq!(client.words(), [0; 3]);
            let long = ClientError::Point(far);
            assert_eq!($wait(client.send::<Far>(1)), Err(long));
            assert_eq!($wait(client.receive::<Far>()), Err(long));
            client.into_transport().done();
            let part = "22bc 0000 0008 0000";
            let line = Line::new(&[
                step(&format!("{part} 0200 0007"), "72bc 0000 0011 0001 0002"),
                step(&format!("{part} 0200 0006"), "82bc 0000 0000 0001 0002"),
                step(&format!("{part} 0200 0005"), "02bc 0000 0000 0001 0002"),
                step(&format!("{part} 0200 0004"), "12bd 0000 0008 0001 0002"),
                (all("0002 ffff 0000 0000 8000 0000"), String::new()),
                (all("0004 ffff 0000 0000 8000 0000"), "?".to_owned()),
                (all("0004 0000 0000 0000 0000 0000"), String::new()),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(127, 2), 3);
            assert_eq!(client.set_bits::<Jog>(2), Ok(()));
            for (speed, error) in [
                (7, NOT_NOW),
                (6, ReplyError::NoRights),
                (5, ReplyError::NoAnswer),
            ] {
                assert_eq!(client.set_with::<Speed>(speed, ()), Ok(()));
                assert_eq!(
                    $wait(client.write::<Word>(8)),
                    Err(ClientError::Reply(error, Some(About::Point("Word"))))
                );
                assert_eq!(
                    (client.words(), client.heard_word(1)),
                    (&[0x200, speed][..], Ok(2))
                );
            }
            assert_eq!(client.set::<Speed>(4), Ok(()));
            let other = ClientError::Reply(ReplyError::WrongParameter, Some(About::Point("Word")));
            assert_eq!($wait(client.write::<Word>(8)), Err(other));
            assert_eq!(
                (client.words(), client.heard_word(1)),
                (&[0, 0][..], Err(Error::NotHeard(None)))
            );
            let bad = Err(ClientError::Build(BuildError::BadMask, None));
            assert_eq!($wait(client.broadcast([2, 0xFFFF, 0, 0])), bad);
            assert_eq!(client.set_word(0, 0x8000), Ok(()));
            assert_eq!($wait(client.broadcast([2, 0x7FFF, 0, 0])), bad);
            assert_eq!($wait(client.broadcast([2, 0xFFFF, 0, 0])), Ok(()));
            assert_eq!(client.transport().space, 0);
            assert_eq!($wait(client.broadcast([4, 0xFFFF, 0, 0])), Err(lost));
            assert_eq!(client.set_word(0, 0), Ok(()));
            assert_eq!($wait(client.broadcast([4, 0, 0, 0])), Ok(()));
            client.into_transport().done();
            let line = Line::new(&[
                step("0000 0000 0000", "00a1 00b2 00c3"),
                step("0000 0005 0000", "00a1 00b2 00c3"),
                step("0000 0005 0000", "?"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(0, 3), 3);
            assert_eq!($wait(client.receive_count::<Speed>()), Ok([0xB2]));
            assert_eq!($wait(client.send_count::<Speed>([5])), Ok(()));
            assert_eq!($wait(client.send_count::<Speed>([0xFFFF])), Err(wrong));
            let lost = Err(ClientError::Transport(Lost, Some(About::Point("Position"))));
            assert_eq!($wait(client.receive_count_with::<Position>(())), lost);
            client.into_transport().done();
            // A client keeps sixteen words and no more.
            let most = step(&"0000 ".repeat(15), &"0001".repeat(15)).0;
            assert_eq!(most.len(), 34);
            let words = "0000".repeat(16);
            let line = Line::new(&[step(&words, &words)]);
            let mut client = $client::for_profile(line, &PROFILE, Link::new(0, 16), 3);
            assert_eq!(
                ($wait(client.cycle()), client.heard_word(15)),
                (Ok(()), Ok(0))
            );
            client.into_transport().done();
            let mut client = $client::for_profile(Line::new(&[]), &PROFILE, Link::new(0, 17), 3);
            let bad = Err(ClientError::Build(BuildError::BadLink, None));
            assert_eq!(
                ($wait(client.cycle()), $wait(client.broadcast([2, 0, 0, 0]))),
                (bad, bad)
            );
            assert_eq!(
                (client.set_word(0, 1), client.words().len()),
                (Err(Error::BeyondLink(None)), 16)
            );
        }
    };
}

/// A telegram to all units.
fn all(words: &str) -> Vec<u8> {
    let mut bytes = telegram(words);
    bytes[2] = 32;
    let last = bytes.len() - 1;
    bytes[last] ^= 3 ^ 32;
    bytes
}

conversations!(parameters_at_once process_at_once Client at_once);
conversations!(parameters_now process_now AsyncClient now);
conversations!(parameters_staying process_staying LocalClient now);
