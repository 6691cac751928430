// SPDX-License-Identifier: 0BSD
//! What clients, requests and replies of Modbus do for every device, also where no vector of this one shows it.

#![allow(clippy::too_many_lines, reason = "a line for each case")]

use fieldscribe_runtime::modbus::{
    crc, read_function, reply_length, write_function, AsyncClient, Base, Block, Chain, Client,
    Command, FoundBlock, Framing, Function, Given, GivenBase, LocalClient, Profile, Request,
};
use fieldscribe_runtime::{
    About, AnyDevice, BitGroup, BuildError, ClientError, Error, Point, ReplyError, Space, Whole,
};

use super::now;
use super::runtime::{at_once, Line, Lost, REFUSED};

made_up!(Word u16, Holding 0x10, &[0x10], 1);
made_up!(Long u32, Holding 0x20, &[0x20, 0x21], 2);
made_up!(Group u16, Holding 0x30, &[0x30], 1);
made_up!(Wide u32, Holding 0x21, &[0x21, 0x22], 2);
made_up!(Beyond u32, Holding 0xFFFF, &[0xFFFF], 2);
made_up!(Relay bool, Coil 0x40, &[0x40], 1);

fieldscribe_runtime::point! {
    /// A word of a block.
    Placed: u16 = "placed";
    at Holding 0x0003 from "blocks_7";
    => value u16 as plain();
    read { count i32; }
    write { count i32; }
}

fieldscribe_runtime::point! {
    /// A word that the device takes only with two others.
    Paired: u16 = "paired";
    at Holding 0x0004;
    written_with ["placed", "word"];
    => value u16 as plain();
    read { count i32; }
    write { count i32; }
}

const CHAIN: Chain = Chain::new(3, &[0x5375, 0x6E53], &[40000, 0], 0xFFFF);
const SEVENTH: FoundBlock = FoundBlock::new("blocks_7", &CHAIN, 7);
const ALONE: &str = "paired: `Request::write_values` writes it in one request with placed, word";
const SLOTS: &[Given] = &[Given::new(1, 15, 1000), Given::new(0, 3, -10)];
const SLOT: GivenBase = GivenBase::new("blocks_7", 100, SLOTS);

impl Whole for Word {}
impl Whole for Long {}

impl BitGroup for Group {
    const SHIFT: u32 = 4;
    const MASK: u16 = 0x00F0;
}

const FUNCTIONS: &[Function] = &[
    Function::new(1, 3000),
    Function::new(3, 4),
    Function::new(5, 1),
    Function::new(6, 1).without_broadcast(),
    Function::new(8, 1),
    Function::new(15, 10),
    Function::new(16, 4),
    Function::new(20, 1),
];
const BOTH: &[Framing] = &[Framing::Rtu, Framing::Tcp];
static PROFILE: Profile = Profile::new(FUNCTIONS, BOTH, (1, 9), Some(0)).naming(named);
static RTU: Profile = PROFILE.with_framings(&[Framing::Rtu]);
static BEHIND_GATEWAY: Profile = RTU.with_framings(&[Framing::Tcp]);
static PADDED: Profile = Profile::new(FUNCTIONS, &[Framing::Tcp], (1, 9), None).padding_coils();

/// What the device calls its one exception code.
fn named(code: u8) -> Option<&'static str> {
    (code == 2).then_some("no_such_address")
}

/// Panics where the runtime is not as it should be.
pub fn check() {
    functions();
    requests();
    replies();
    at_once_over_tcp();
    now_over_tcp();
    at_once_over_rtu();
    now_over_rtu();
    staying_over_tcp();
    staying_over_rtu();
    more_at_once();
    more_now();
    more_staying();
    bases();
    found_at_once();
    found_now();
    found_staying();
}

fn bases() {
    let base = |slot, part| SLOT.at(&[slot, part]);
    assert_eq!(base(3, 2), Some(Base::at("blocks_7", 3080)));
    assert_eq!(base(15, 0), Some(Base::new("blocks_7", 15100, 50435)));
    assert_eq!([base(0, 0), base(16, 0), base(1, 4)], [None; 3]);
    assert_eq!([SLOT.at(&[3]), SLOT.at(&[3, 0, 0])], [None; 2]);
    let built = |request: Request<'_>| {
        let mut frame = [0; 8];
        request
            .build(&PROFILE, &mut frame)
            .map(|_| super::hex(&frame[..6]))
    };
    let read = Request::read::<Placed>(5);
    assert_eq!(built(read), Err(BuildError::NoBase));
    assert_eq!(
        built(read.at(&Base::at("other", 7))),
        Err(BuildError::NoBase)
    );
    let within = |last| built(read.at(&Base::new("blocks_7", 0x1000, last)));
    assert_eq!(within(3).as_deref(), Ok("050310030001"));
    assert_eq!(within(2), Err(BuildError::BadAddress));
    let write = Request::write::<Placed>(5, 9).at(&Base::at("blocks_7", 0x1000));
    assert_eq!(built(write).as_deref(), Ok("050610030009"));
    let block = Any::new(Space::Holding, 3, 2, 2);
    assert!(!block.brings::<Placed>() && block.counted_from("blocks_7").brings::<Placed>());
    assert!(!block.counted_from("blocks_7").brings::<Word>());
    assert_eq!(Any::of(<Placed as Point>::INFO).base, "blocks_7");
}

/// A read of any device.
type Any = Block<AnyDevice>;

fn functions() {
    for (space, reads, one, several) in [
        (Space::Coil, 1, 5, 15),
        (Space::Discrete, 2, 0, 0),
        (Space::Holding, 3, 6, 16),
        (Space::Input, 4, 0, 0),
        (Space::Parameter, 0, 0, 0),
    ] {
        assert_eq!(read_function(space), reads);
        assert_eq!(
            (write_function(space, 1), write_function(space, 2)),
            (one, several)
        );
    }
    let broadcast = [1, 2, 3, 4, 5, 6, 8, 15, 16].map(|number| Function::new(number, 1).broadcast);
    assert_eq!(
        broadcast,
        [false, false, false, false, true, true, false, true, true]
    );
    let single = Function::new(6, 7).without_broadcast();
    assert_eq!(
        (single.number, single.most, single.broadcast),
        (6, 1, false)
    );
    assert_eq!(
        [6, 7, 20].map(|number| PROFILE.knows(number)),
        [true, false, false]
    );
    assert_eq!(
        BOTH.iter()
            .map(|one| PADDED.speaks(*one))
            .collect::<Vec<_>>(),
        [false, true]
    );
    for (profile, speaks) in [(RTU, [true, false]), (BEHIND_GATEWAY, [false, true])] {
        assert_eq!([0, 1].map(|place| profile.speaks(BOTH[place])), speaks);
        assert_eq!((profile.knows(6), profile.is_broadcast(0)), (true, true));
    }
    let exceptions = [2, 4, 7].map(|code| RTU.named(refused(code)).to_string());
    let shown = [
        "02h (no_such_address)",
        "04h (server_device_failure)",
        "07h",
    ];
    assert_eq!(
        exceptions,
        shown.map(|code| format!("the device refused with exception {code}"))
    );
    assert_eq!(PROFILE.named(ReplyError::BadCrc), ReplyError::BadCrc);
    assert_eq!([0, 1].map(|unit| PROFILE.is_broadcast(unit)), [true, false]);
    assert_eq!([0, 1].map(|unit| PADDED.is_broadcast(unit)), [false, false]);
    let brings = |address, count| Any::new(Space::Holding, 3, address, count).brings::<Long>();
    assert_eq!(
        [(0x1F, 3), (0x20, 2)].map(|(address, count)| brings(address, count)),
        [true, true]
    );
    assert_eq!(
        [(0x1F, 2), (0x20, 1), (0x21, 9)].map(|(address, count)| brings(address, count)),
        [false; 3]
    );
    assert!(!Any::new(Space::Input, 4, 0x20, 2).brings::<Long>());
    assert!(!Any::new(Space::Holding, 3, 0, 0xFFFF).brings::<Beyond>());
    assert_eq!(crc(b"123456789"), 0x4B37);
}

/// A frame over TCP as transaction 7 of unit 5, without its head.
fn frame(request: Request, profile: &Profile) -> Result<String, BuildError> {
    let mut buffer = [0; 260];
    let length = request.tcp(7).build(profile, &mut buffer)?;
    let head = super::hex(&buffer[..7]);
    assert_eq!(head, format!("00070000{:04x}05", length - 6));
    Ok(super::hex(&buffer[7..length]))
}

fn requests() {
    let write = |function, address, values| Request::write_values(5, function, address, values);
    for (request, profile, found) in [
        (Request::new(5, 1, 2, 2000), &PROFILE, Ok("01000207d0")),
        (
            Request::new(5, 1, 2, 2001),
            &PROFILE,
            Err(BuildError::BadCount),
        ),
        (
            Request::new(5, 3, 2, 5),
            &PROFILE,
            Err(BuildError::BadCount),
        ),
        (
            Request::new(5, 3, 2, 0),
            &PROFILE,
            Err(BuildError::BadCount),
        ),
        (Request::new(5, 3, 0xFFFC, 4), &PROFILE, Ok("03fffc0004")),
        (
            Request::new(5, 3, 0xFFFD, 4),
            &PROFILE,
            Err(BuildError::BadAddress),
        ),
        (
            Request::new(5, 4, 0, 1),
            &PROFILE,
            Err(BuildError::BadFunction),
        ),
        (
            Request::new(5, 20, 0, 1),
            &PROFILE,
            Err(BuildError::BadFunction),
        ),
        (Request::read::<Long>(5), &PROFILE, Ok("0300200002")),
        (
            Request::block(5, &Block::<AnyDevice>::new(Space::Coil, 1, 3, 9)),
            &PROFILE,
            Ok("0100030009"),
        ),
        (
            Request::command(5, &Command::<AnyDevice>::new(6, 3, Some(9))),
            &PROFILE,
            Ok("0600030009"),
        ),
        (
            Request::command(5, &Command::<AnyDevice>::new(5, 3, None)),
            &PROFILE,
            Ok("050003ff00"),
        ),
        (
            Request::write::<Long>(5, 0x0102_0304),
            &PROFILE,
            Ok("10002000020401020304"),
        ),
        (
            Request::update::<Group>(5, 0xABCD, 7),
            &PROFILE,
            Ok("060030ab7d"),
        ),
        (
            Request::write_words::<Word>(5, &[9]),
            &PROFILE,
            Ok("0600100009"),
        ),
        (write(5, 1, &[0]), &PROFILE, Ok("0500010000")),
        (write(5, 1, &[2]), &PROFILE, Err(BuildError::BadBit)),
        (write(15, 1, &[1, 2]), &PROFILE, Err(BuildError::BadBit)),
        (write(16, 1, &[1, 2]), &PROFILE, Ok("10000100020400010002")),
        (write(8, 0, &[0xA537]), &PROFILE, Ok("080000a537")),
        (
            write(8, 1, &[0xA537]),
            &PROFILE,
            Err(BuildError::BadAddress),
        ),
        (write(6, 1, &[]), &PROFILE, Err(BuildError::BadCount)),
        (write(6, 1, &[1, 2]), &PROFILE, Err(BuildError::BadCount)),
        (
            Request::new(5, 6, 1, 1),
            &PROFILE,
            Err(BuildError::BadCount),
        ),
        (
            write(15, 1, &[1, 0, 1, 1, 0, 0, 0, 0, 1]),
            &PROFILE,
            Ok("0f00010009020d01"),
        ),
        (write(15, 1, &[0, 1]), &PROFILE, Ok("0f000100020102")),
        (write(15, 1, &[0, 1]), &PADDED, Ok("0f00010002020200")),
        (
            write(15, 1, &[0, 1, 0, 0, 0, 0, 0, 0, 1]),
            &PADDED,
            Ok("0f00010009020201"),
        ),
    ] {
        assert_eq!(frame(request, profile), found.map(str::to_owned));
    }
    let mut buffer = [0; 260];
    let unit = |unit, function, profile| {
        let request = Request::write_values(unit, function, 1, &[1]).tcp(1);
        request.build(profile, &mut [0; 260])
    };
    assert_eq!([1, 9].map(|one| unit(one, 6, &PROFILE)), [Ok(12), Ok(12)]);
    assert_eq!(unit(10, 6, &PROFILE), Err(BuildError::BadUnit));
    assert_eq!(
        (unit(0, 6, &PROFILE), unit(0, 16, &PROFILE)),
        (Err(BuildError::NotForAll), Ok(15))
    );
    assert_eq!(unit(0, 16, &PADDED), Err(BuildError::BadUnit));
    let request = Request::new(5, 3, 0x10, 1);
    assert_eq!(request.unit(), 5);
    assert_eq!(
        request.build(&PADDED, &mut buffer),
        Err(BuildError::BadFraming)
    );
    assert_eq!(request.build(&PROFILE, &mut buffer), Ok(8));
    assert_eq!(super::hex(&buffer[..8]), "050300100001844b");
    for length in 0..8 {
        assert_eq!(
            request.build(&PROFILE, &mut buffer[..length]),
            Err(BuildError::BufferTooSmall)
        );
    }
}

/// Bytes with their checksum, the low byte first.
fn rtu(body: &str) -> Vec<u8> {
    let bytes = super::bytes(body);
    let sum = crc(&bytes).to_le_bytes();
    [bytes.as_slice(), &sum].concat()
}

/// An exception that nobody has named yet.
const fn refused(code: u8) -> ReplyError {
    ReplyError::Exception { code, name: None }
}

const fn answered_by(received: u8) -> ReplyError {
    ReplyError::WrongUnit {
        expected: 5,
        received,
    }
}

const fn counted(expected: u16, received: u16) -> ReplyError {
    ReplyError::BadByteCount { expected, received }
}

const fn too_short(expected: u16, received: u16) -> ReplyError {
    ReplyError::ShortFrame { expected, received }
}

const fn too_long(expected: u16, received: u16) -> ReplyError {
    ReplyError::LongFrame { expected, received }
}

const fn other_transaction(received: u16) -> ReplyError {
    let expected = 7;
    ReplyError::WrongTransaction { expected, received }
}

/// What was written and what the reply repeats: addresses, and values or counts.
const fn repeated(expected: (u16, u16), received: (u16, u16)) -> ReplyError {
    ReplyError::EchoMismatch { expected, received }
}

fn replies() {
    let wrong = |point| Error::NotBrought(Some(point));
    let read = Request::new(5, 3, 0x1F, 3);
    let received = rtu("050306000100020003");
    let reply = read.parse(&received).expect("a reply");
    assert_eq!(
        (reply.count(), reply.items().collect::<Vec<_>>()),
        (3, vec![1, 2, 3])
    );
    assert_eq!(
        [0, 2, 3].map(|place| reply.item(place)),
        [Some(1), Some(3), None]
    );
    assert_eq!(
        (reply.raw::<Long>(), reply.raw::<Relay>()),
        (Ok(0x0002_0003), Err(Error::WrongSpace(Some("Relay"))))
    );
    assert_eq!(
        (reply.raw::<Word>(), reply.raw::<Group>()),
        (Err(wrong("Word")), Err(wrong("Group")))
    );
    assert_eq!(reply.raw::<Beyond>(), Err(wrong("Beyond")));
    let received = rtu("050600100009");
    let reply = Request::write::<Word>(5, 9)
        .parse(&received)
        .expect("an echo");
    assert_eq!(
        (reply.count(), reply.raw::<Word>(), reply.raw::<Relay>()),
        (1, Ok(9), Err(Error::WrongSpace(Some("Relay"))))
    );
    let received = rtu("05050040ff00");
    let relay = Request::write_values(5, 5, 0x40, &[1]);
    let reply = relay.parse(&received).expect("an echo");
    assert_eq!((reply.item(0), reply.raw::<Relay>()), (Some(1), Ok(true)));
    let received = rtu("051000200002");
    let long = Request::write::<Long>(5, 1);
    assert_eq!(long.parse(&received).map(|reply| reply.count()), Ok(0));
    let bits = Request::new(5, 1, 0x40, 9);
    let received = rtu("0501020181");
    let reply = bits.parse(&received).expect("a reply");
    assert_eq!(
        reply.items().collect::<Vec<_>>(),
        [1, 0, 0, 0, 0, 0, 0, 0, 1]
    );
    for (request, bytes, error) in [
        (
            Request::new(5, 20, 0, 1),
            rtu("051400000000"),
            ReplyError::BadFunction,
        ),
        (read, vec![5, 3], too_short(5, 2)),
        (read, vec![5, 3, 6, 0], too_short(11, 4)),
        (read, rtu("0503060001000200"), too_short(11, 10)),
        (read, rtu("05030600010002000304"), too_long(11, 12)),
        (read, rtu("0503040001000200"), too_long(9, 10)),
        (read, rtu("05030400010002"), counted(6, 4)),
        (
            read,
            vec![5, 3, 6, 0, 1, 0, 2, 0, 3, 0, 0],
            ReplyError::BadCrc,
        ),
        (read, rtu("040306000100020003"), answered_by(4)),
        (
            read,
            rtu("050406000100020003"),
            ReplyError::WrongFunction {
                expected: 3,
                received: 4,
            },
        ),
        (read, rtu("058302"), refused(2)),
        (read, rtu("05830200"), too_long(5, 6)),
        (bits, rtu("05010101"), counted(2, 1)),
        (long, rtu("051000200003"), repeated((0x20, 2), (0x20, 3))),
        (long, rtu("051000210002"), repeated((0x20, 2), (0x21, 2))),
        (
            relay,
            rtu("050500400000"),
            repeated((0x40, 0xFF00), (0x40, 0)),
        ),
        (relay, rtu("0505004000"), too_short(8, 7)),
        (relay, rtu("05050040ff0000"), too_long(8, 9)),
    ] {
        assert_eq!(request.parse(&bytes).map(|_| ()), Err(error));
    }
    for (bytes, error) in [
        ("0007000000030503", too_short(9, 8)),
        ("000700010009050306000100020003", ReplyError::BadProtocol),
        ("000701000009050306000100020003", ReplyError::BadProtocol),
        ("00070000000a050306000100020003", too_short(16, 15)),
        ("000700000008050306000100020003", too_long(14, 15)),
        ("000800000009050306000100020003", other_transaction(8)),
        ("000700000009060306000100020003", answered_by(6)),
        ("000700000003050306", counted(6, 0)),
        ("0007000000040503060a", counted(6, 1)),
        ("000700000003058304", refused(4)),
        ("00070000000405830400", too_long(9, 10)),
    ] {
        assert_eq!(
            read.tcp(7).parse(&super::bytes(bytes)).map(|_| ()),
            Err(error)
        );
    }
    let head = |head: &str| reply_length(Framing::Tcp, &super::bytes(head));
    assert_eq!(
        [
            "00010000000505",
            "000700000105",
            "0001000000",
            "000100010005"
        ]
        .map(head),
        [Some(11), Some(267), None, None]
    );
    let length = |head: &str| reply_length(Framing::Rtu, &super::bytes(head));
    assert_eq!(
        (length("05"), length("0503"), length("050306")),
        (None, None, Some(11))
    );
    assert_eq!(
        (length("050102"), length("050600"), length("051000")),
        (Some(7), Some(8), Some(8))
    );
    assert_eq!(
        (
            length("0583"),
            length("058302"),
            length("050700"),
            length("058700")
        ),
        (None, Some(5), None, None)
    );
}

/// The same conversation with the client that blocks and the one that does not.
macro_rules! conversations {
    ($tcp:ident $rtu:ident $more:ident $found:ident $client:ident $wait:ident) => {
        fn $found() {
            let step = |sent: &str, came: &str| (rtu(sent), super::hex(&rtu(came)));
            let talk = |steps: &[(&str, &str)]| {
                let steps: Vec<_> = steps.iter().map(|(sent, came)| step(sent, came)).collect();
                $client::for_profile(Line::new(&steps), &PROFILE, Framing::Rtu, 5)
            };
            let mut client = talk(&[
                ("05039c400002", "058302"),
                ("050300000002", "05030453756e53"),
                ("050300020002", "05030400010001"),
                ("050300050002", "05030400070002"),
                ("050300080001", "0503021234"),
                ("050600080009", "050600080009"),
                ("050300070002", "05030456781234"),
            ]);
            assert_eq!(
                $wait(client.read::<Placed>()),
                Err(ClientError::Build(
                    BuildError::NoBase,
                    Some(About::Point("placed"))
                ))
            );
            assert_eq!(
                $wait(client.find(&SEVENTH)),
                Ok(Some(Base::new("blocks_7", 5, 3)))
            );
            assert_eq!($wait(client.read::<Placed>()), Ok(0x1234));
            assert_eq!($wait(client.write::<Placed>(9)), Ok(()));
            let block = Any::new(Space::Holding, 3, 2, 2).counted_from("blocks_7");
            let reply = $wait(client.read_block(&block)).expect("a reply");
            assert_eq!(reply.value::<Placed>(), Ok(0x1234));
            assert_eq!(reply.raw_of(<Placed as Point>::INFO), Ok(0x1234));
            assert!(reply.value::<Word>().is_err());
            client.into_transport().done();
            let marked = ("05039c400002", "05030453756e53");
            for (steps, found) in [
                (vec![marked, ("05039c420002", "050304ffff0000")], Ok(None)),
                (
                    vec![
                        marked,
                        ("05039c420002", "05030400080001"),
                        ("05039c450002", "050304ffff0000"),
                    ],
                    Ok(None),
                ),
                (
                    vec![
                        ("05039c400002", "05030400000000"),
                        ("050300000002", "058302"),
                    ],
                    Ok(None),
                ),
                (
                    vec![marked, ("05039c420002", "050304000763bc")],
                    Ok(Some(Base::new("blocks_7", 40002, 0x63BD))),
                ),
                (
                    vec![marked, ("05039c420002", "050304000763bd")],
                    Err(BuildError::BadAddress.into()),
                ),
                (
                    vec![marked, ("05039c420002", "050304000863bc")],
                    Err(BuildError::BadAddress.into()),
                ),
            ] {
                let mut client = talk(&steps);
                assert_eq!($wait(client.find(&SEVENTH)), found);
                client.into_transport().done();
            }
        }

        fn $tcp() {
            let step = |sent: &str, came: &str| (super::bytes(sent), came.to_owned());
            let mut client = $client::for_profile(
                Line::new(&[
                    step("000100000006050300100001", "0001000000050503021234"),
                    step("000200000006050300100001", "000200000005050302ffff"),
                ]),
                &PROFILE,
                Framing::Tcp,
                5,
            );
            assert_eq!($wait(client.read::<Word>()), Ok(0x1234));
            assert_eq!(client.transport().space, 260);
            assert_eq!(
                $wait(client.read::<Word>()),
                Err(ClientError::Point(REFUSED))
            );
            client.into_transport().done();
        }

        fn $more() {
            let step = |sent: &str, came: &str| (rtu(sent), super::hex(&rtu(came)));
            let line = Line::new(&[
                step("050300200002", "05030400010002"),
                step("050300200002", "05030400010002"),
                step("050300100001", "050302ffff"),
                step("0510002000020400010003", "051000200002"),
                step("050600100007", "050600100007"),
                step("0510002000020400010004", "051000200002"),
                step("050600100008", "050600100008"),
                step("050600100009", "050600100009"),
                step("05050040ff00", "05050040ff00"),
                step("0503001f0003", "050306000100020003"),
                step("0503001f0003", "050306000100020003"),
                step("0503001f0003", "058302"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Framing::Rtu, 5);
            assert_eq!($wait(client.read_count::<Long>()), Ok([0x0001_0002]));
            assert_eq!($wait(client.read_count_with::<Long>(())), Ok([0x0001_0002]));
            let wrong = ClientError::Point(REFUSED);
            assert_eq!($wait(client.read_count::<Word>()), Err(wrong));
            assert_eq!($wait(client.write_count::<Long>([0x0001_0003])), Ok(()));
            assert_eq!($wait(client.write_count_with::<Word>([7], ())), Ok(()));
            assert_eq!($wait(client.write_raw::<Long>(0x0001_0004)), Ok(()));
            assert_eq!($wait(client.write_raw_with::<Word>(8, ())), Ok(()));
            for refused in [
                $wait(client.write_count::<Word>([0xFFFF])),
                $wait(client.write_raw::<Word>(0xFFFF)),
            ] {
                assert_eq!(refused, Err(wrong));
            }
            let command = |function, address, value| Command::new(function, address, value);
            assert_eq!($wait(client.command(&command(6, 0x10, Some(9)))), Ok(()));
            assert_eq!($wait(client.command(&command(5, 0x40, None))), Ok(()));
            let block = Block::new(Space::Holding, 3, 0x1F, 3);
            let reply = $wait(client.read_block(&block)).map(|reply| reply.raw::<Long>());
            assert_eq!(reply, Ok(Ok(0x0002_0003)));
            let missing = $wait(client.read_block(&block)).map(|reply| {
                let error = |found: Result<u16, Error>| found.unwrap_err().to_string();
                (
                    reply.value::<Long>(),
                    error(reply.value_with::<Word>(())),
                    reply.raw::<Wide>().unwrap_err().to_string(),
                )
            });
            let text = |name| format!("{name}: the reply does not bring the point");
            assert_eq!(missing, Ok((Ok(0x0002_0003), text("Word"), text("Wide"))));
            let (code, name) = (2, Some("no_such_address"));
            let refused = $wait(client.read_block(&block)).map(|_| ()).unwrap_err();
            let about = About::Request {
                unit: 5,
                function: block.function,
                address: block.address,
                count: block.count,
            };
            let exception = ReplyError::Exception { code, name };
            assert_eq!(refused, ClientError::Reply(exception, Some(about)));
            assert_eq!(refused.point(), None);
            let what = format!(
                "unit 5, function 3 at {:04X}h, {} items: ",
                block.address, block.count
            );
            assert_eq!(refused.to_string(), format!("{what}{exception}"));
            let point = About::Point("Word");
            assert_eq!(
                refused.of::<Word>(),
                ClientError::Reply(exception, Some(point))
            );
            client.into_transport().done();
        }

        fn $rtu() {
            let step = |sent: &str, came: &str| match came {
                "" | "?" | "!" => (rtu(sent), came.to_owned()),
                came => (rtu(sent), super::hex(&rtu(came))),
            };
            let line = Line::new(&[
                step("050300200002", "05030400010002"),
                step("0510002000020400010003", "?"),
                step("050600100007", "!"),
                step("050600100008", "058602"),
                step("050300300001", "050302abcd"),
                step("05060030ab7d", "?"),
                step("050300300001", "?"),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Framing::Rtu, 5);
            assert_eq!($wait(client.read_with::<Long>(())), Ok(0x0001_0002));
            let lost = |point| Err(ClientError::Transport(Lost, Some(About::Point(point))));
            assert_eq!($wait(client.write::<Long>(0x0001_0003)), lost("Long"));
            let long = Err(ClientError::Reply(
                too_long(260, 261),
                Some(About::Point("Word")),
            ));
            assert_eq!($wait(client.write_with::<Word>(7, ())), long);
            let (code, name) = (2, Some("no_such_address"));
            let exception = ReplyError::Exception { code, name };
            let refused = Err(ClientError::Reply(exception, Some(About::Point("Word"))));
            assert_eq!($wait(client.write::<Word>(8)), refused);
            let wrong = Err(ClientError::Point(REFUSED));
            assert_eq!($wait(client.write::<Word>(0xFFFF)), wrong);
            assert_eq!($wait(client.update::<Group>(0xFFFF)), wrong);
            assert_eq!($wait(client.update::<Group>(7)), lost("Group"));
            assert_eq!($wait(client.update::<Group>(7)), lost("Group"));
            let alone = $wait(client.write_point(<Paired as Point>::INFO, 7)).unwrap_err();
            assert_eq!(
                (alone.name(), alone.point()),
                ("not_together", Some("paired"))
            );
            assert_eq!(alone.to_string(), ALONE);
            client.into_transport().done();
            let line = Line::new(&[
                step("0010002000020400010003", ""),
                step("001000200001020001", ""),
            ]);
            let mut client = $client::for_profile(line, &PROFILE, Framing::Rtu, 0);
            assert_eq!($wait(client.write::<Long>(0x0001_0003)), Ok(()));
            assert_eq!(client.transport().space, 0);
            assert_eq!(
                $wait(client.command(&Command::<AnyDevice>::new(16, 0x20, None))),
                Ok(())
            );
            let none = Err(ClientError::Build(
                BuildError::NotForAll,
                Some(About::Point("Long")),
            ));
            assert_eq!($wait(client.read::<Long>()), none);
            client.into_transport().done();
        }
    };
}

conversations!(at_once_over_tcp at_once_over_rtu more_at_once found_at_once Client at_once);
conversations!(now_over_tcp now_over_rtu more_now found_now AsyncClient now);
conversations!(staying_over_tcp staying_over_rtu more_staying found_staying LocalClient now);
