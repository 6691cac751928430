// SPDX-License-Identifier: 0BSD
//! What clients, messages and receivers of CAN do for every device, also where no vector of this one shows it.

#![allow(clippy::too_many_lines, reason = "a line for each case")]

use std::collections::VecDeque;

use fieldscribe_runtime::can::{
    AsyncClient, AsyncTransport, Client, Content, Dialogue, Frame, Listener, LocalClient,
    LocalTransport, Message, Parameter, ParseError, Profile, Received, Receiver, Role, Slot,
    Telegram, Transport,
};
use fieldscribe_runtime::{
    About, AnyDevice, BitGroup, BuildError, ClientError, Error, ReplyError, Whole,
};

use super::now;
use super::runtime::{at_once, chain, tells, Lost, REFUSED};

made_up!(Word u16, Parameter 0x0102, &[0x0102], 1);
made_up!(Long u32, Parameter 0x0201, &[0x0202, 0x0201], 2);
made_up!(Group u16, Parameter 0x0030, &[0x0030], 1);
made_up!(Speed u16, Telegram 1, &[1], 1);
made_up!(Whole3 u32, Telegram 3, &[4, 3], 2);
made_up!(Hours u32, Telegram 2, &[3, 2], 2);
made_up!(Date u64, Telegram 2, &[2, 3, 4, 5], 4);

impl Whole for Word {}
impl Whole for Long {}
impl Parameter for Word {}
impl Parameter for Long {}
impl Parameter for Group {}

impl BitGroup for Group {
    const SHIFT: u32 = 4;
    const MASK: u16 = 0x00F0;
}

impl Received for Speed {
    type Telegram = Measured;
}

impl Received for Whole3 {
    type Telegram = Measured;
}

impl Received for Hours {
    type Telegram = Measured;
}

impl Received for Date {
    type Telegram = Measured;
}

const SUM: Role = Role::Xor(0b0111_1111);
const NOTHING: Role = Role::Constant(0);
const ASK: Message = Message::new(
    "ask",
    0x300,
    false,
    [
        Role::Constant(0xFF),
        Role::Unit(0),
        Role::Address(8),
        Role::Address(0),
        NOTHING,
        NOTHING,
        NOTHING,
        SUM,
    ],
);
const ANSWER: Message = Message::new(
    "answer",
    0x310,
    true,
    [
        Role::Constant(0xFF),
        Role::Unit(0),
        Role::Address(8),
        Role::Address(0),
        Role::Raw(8),
        Role::Raw(0),
        NOTHING,
        SUM,
    ],
);
const CHANGE: Message = Message::new(
    "change",
    0x300,
    false,
    [
        Role::Constant(0xEE),
        Role::Unit(0),
        Role::Address(8),
        Role::Address(0),
        Role::Raw(8),
        Role::Raw(0),
        NOTHING,
        SUM,
    ],
);
const DONE: Message = Message::new(
    "done",
    0x310,
    true,
    [
        Role::Constant(0xEE),
        Role::Unit(0),
        NOTHING,
        NOTHING,
        NOTHING,
        NOTHING,
        NOTHING,
        SUM,
    ],
);
const MEASURED: Message = Message::new(
    "measured",
    0x400,
    true,
    [
        Role::Multiplexer,
        Role::Word(1),
        Role::Word(0),
        Role::Word(2),
        Role::Word(3),
        Role::Word(4),
        Role::Word(5),
        NOTHING,
    ],
);
const READ: Option<Dialogue> = Some(Dialogue {
    request: &ASK,
    answer: Some(&ANSWER),
});

const fn writes(answer: Option<&'static Message>) -> Dialogue {
    Dialogue {
        request: &CHANGE,
        answer,
    }
}

static PROFILE: Profile = Profile::new((1, 9), 11, READ, Some(writes(Some(&ANSWER))));
static BRIEF: Profile = Profile::new((1, 9), 29, None, Some(writes(Some(&DONE))));
static SILENT: Profile = Profile::new((1, 9), 29, None, Some(writes(None)));

/// Two frames of three words.
#[derive(Clone, Copy, Debug)]
pub struct Measured;

impl Telegram for Measured {
    type Device = AnyDevice;
    const NAME: &'static str = "measured";
    const MESSAGE: &'static Message = &MEASURED;
    const PROFILE: &'static Profile = &PROFILE;
    type Slots = [Slot; 2];
    const EMPTY: Self::Slots = [Slot::EMPTY; 2];
}

/// Panics where the runtime is not as it should be.
pub fn check() {
    errors();
    frames();
    receivers();
    torn_words();
    parameters_at_once();
    parameters_now();
    telegrams_at_once();
    telegrams_now();
    parameters_staying();
    telegrams_staying();
}

fn errors() {
    tells(
        ParseError::name,
        &[
            (
                ParseError::WrongId,
                "wrong_id",
                "the frame has another identifier",
            ),
            (
                ParseError::WrongLength,
                "wrong_length",
                "the frame has not eight bytes",
            ),
            (
                ParseError::WrongConstant,
                "wrong_constant",
                "a constant byte is another",
            ),
            (
                ParseError::WrongUnit,
                "wrong_unit",
                "the frame is of another unit",
            ),
            (
                ParseError::WrongCheck,
                "wrong_check",
                "the check byte is wrong",
            ),
        ],
    );
}

fn frames() {
    let short = Frame::new(0x310, &[1, 2]);
    assert_eq!((short.id(), short.bytes()), (0x310, &[1, 2][..]));
    assert_eq!(short, Frame::new(0x310, &[1, 2]));
    assert_eq!(
        Frame::new(1, &[1, 2, 3, 4, 5, 6, 7, 8, 9]).bytes(),
        [1, 2, 3, 4, 5, 6, 7, 8]
    );
    assert_eq!(
        format!("{short:?}"),
        "Frame { id: 784, length: 2, data: [1, 2, 0, 0, 0, 0, 0, 0] }"
    );
    assert_eq!(
        (ANSWER.name(), ANSWER.id(5), ASK.id(5)),
        ("answer", 0x315, 0x300)
    );
    let build = |message: &Message, unit| message.build(&PROFILE, unit, 0xA1B2, 0xC3D4);
    let whole = build(&ANSWER, 5).expect("a frame");
    assert_eq!(
        whole,
        Frame::new(0x315, &[0xFF, 5, 0xA1, 0xB2, 0xC3, 0xD4, 0, 0xFE])
    );
    assert_eq!(
        build(&ASK, 9),
        Ok(Frame::new(0x300, &[0xFF, 9, 0xA1, 0xB2, 0, 0, 0, 0xE5]))
    );
    assert_eq!(build(&MEASURED, 1), Ok(Frame::new(0x401, &[0; 8])));
    assert_eq!(
        [0, 10].map(|unit| build(&ASK, unit)),
        [Err(BuildError::BadUnit); 2]
    );
    assert_eq!(
        [0, 1, 9, 10].map(|unit| PROFILE.has_unit(unit)),
        [false, true, true, false]
    );
    assert_eq!(
        (PROFILE.identifier_bits(), BRIEF.identifier_bits()),
        (11, 29)
    );
    let (address, raw) = (0xA1B2, 0xC3D4);
    assert_eq!(ANSWER.parse(5, &whole), Ok(Content { address, raw }));
    let changed = |place: usize, byte| {
        let mut bytes = whole.bytes().to_vec();
        bytes[place] ^= byte;
        ANSWER.parse(5, &Frame::new(0x315, &bytes))
    };
    assert_eq!(
        (changed(0, 1), changed(6, 1)),
        (
            Err(ParseError::WrongConstant),
            Err(ParseError::WrongConstant)
        )
    );
    assert_eq!(
        (changed(1, 1), changed(1, 0x80)),
        (Err(ParseError::WrongUnit), Err(ParseError::WrongUnit))
    );
    assert_eq!(
        (changed(2, 1), changed(7, 0x80)),
        (Err(ParseError::WrongCheck), Err(ParseError::WrongCheck))
    );
    assert_eq!(ANSWER.parse(4, &whole), Err(ParseError::WrongId));
    for wrong in [&whole.bytes()[..7], &[whole.bytes(), &[0]].concat()] {
        assert_eq!(
            ANSWER.parse(5, &Frame::new(0x315, wrong)),
            Err(ParseError::WrongLength)
        );
    }
}

/// A part of the telegram of unit 5.
fn part(multiplexer: u8, words: [u16; 3]) -> Frame {
    let [first, second, third] = words.map(u16::to_be_bytes);
    let first = [multiplexer, first[1], first[0]];
    Frame::new(0x405, &[&first[..], &second, &third, &[0]].concat())
}

fn receivers() {
    let mut receiver = Receiver::<Measured>::new(5);
    assert_eq!(
        (receiver.taken(), receiver.word(0)),
        (0, Err(Error::NotReceived(None)))
    );
    let missing = Error::NotReceived(Some("Speed"));
    assert_eq!(receiver.raw::<Speed>(), Err(missing));
    assert_eq!(missing.point(), Some("Speed"));
    assert_eq!(
        chain(&missing),
        ["Speed: the frame with the word never came"]
    );
    assert!(!receiver.came_since::<Speed>(0));
    assert!(!receiver.take(&part(2, [1, 2, 3])));
    assert!(!receiver.take(&Frame::new(0x404, part(0, [1, 2, 3]).bytes())));
    assert!(receiver.take(&part(0, [0x0102, 0x0304, 0x0506])));
    assert_eq!(receiver.taken(), 1);
    assert_eq!(
        [0, 1, 2].map(|one| receiver.word(one)),
        [Ok(0x0102), Ok(0x0304), Ok(0x0506)]
    );
    assert_eq!(
        [3, 6, 7].map(|one| receiver.word(one)),
        [Err(Error::NotReceived(None)); 3]
    );
    assert_eq!(
        (receiver.raw::<Speed>(), receiver.value::<Speed>()),
        (Ok(0x0304), Ok(0x0304))
    );
    assert_eq!(
        (receiver.count::<Speed>(), receiver.count_with::<Speed>(())),
        (Ok([0x0304]), Ok([0x0304]))
    );
    assert_eq!(
        (
            receiver.came_since::<Speed>(0),
            receiver.came_since::<Speed>(1)
        ),
        (true, false)
    );
    assert!(!receiver.came_since::<Hours>(0));
    assert!(receiver.take(&part(1, [7, 8, 9])));
    assert_eq!(
        (receiver.taken(), receiver.came_since::<Hours>(0)),
        (2, true)
    );
    assert!(!receiver.came_since::<Hours>(1));
    assert_eq!(receiver.raw::<Whole3>(), Ok(0x0008_0007));
    assert_eq!(receiver.raw::<Date>(), Ok(0x0506_0007_0008_0009));
    assert!(receiver.take(&part(0, [0, 0xFFFF, 0])));
    let wrong = REFUSED;
    assert_eq!(
        (receiver.value::<Speed>(), receiver.value_with::<Speed>(())),
        (Err(wrong), Err(wrong))
    );
    let mut nobody = Receiver::<Measured>::new(0);
    assert!(!nobody.take(&Frame::new(0x400, part(0, [1, 2, 3]).bytes())));
}

/// The high word is in the frame 1, the low one in the frame 0.
fn torn_words() {
    let (low, high) = (|word| part(0, [0, 0, word]), |word| part(1, [word, 0, 0]));
    let torn = Err(Error::Torn(Some("Hours")));
    for (frames, found) in [
        (vec![low(7), high(1)], torn),
        (vec![high(1), low(7)], torn),
        (vec![high(1), low(7), high(1)], Ok(0x0001_0007)),
        (vec![high(1), low(7), high(2)], torn),
        (vec![low(7), high(1), high(1)], torn),
        (vec![high(1), high(1), low(7)], torn),
        (vec![high(1), low(7), high(1), low(8)], Ok(0x0001_0007)),
        (vec![high(1), low(7), high(1), low(8), low(9)], torn),
        (
            vec![high(1), low(7), high(1), low(8), high(1)],
            Ok(0x0001_0008),
        ),
        (vec![low(6), high(1), high(1), low(8)], torn),
    ] {
        let mut receiver = Receiver::<Measured>::new(5);
        assert!(frames.iter().all(|frame| receiver.take(frame)));
        assert_eq!(receiver.raw::<Hours>(), found);
    }
}

/// A bus on which this is sent in this order; an answer comes before what is there already.
#[derive(Default)]
struct Bus {
    steps: VecDeque<(Frame, Vec<Frame>)>,
    stale: VecDeque<Frame>,
    came: VecDeque<Frame>,
}

impl Bus {
    fn new(steps: &[(Frame, Vec<Frame>)]) -> Self {
        Self {
            steps: steps.iter().cloned().collect(),
            ..Self::default()
        }
    }

    fn hears(frames: &[Frame]) -> Self {
        Self {
            came: frames.iter().copied().collect(),
            ..Self::default()
        }
    }

    fn sent(&mut self, frame: &Frame) -> Result<(), Lost> {
        assert!(self.stale.is_empty(), "the bus is emptied first");
        let (sent, answers) = self.steps.pop_front().ok_or(Lost)?;
        assert_eq!(sent, *frame);
        self.came = answers.into();
        Ok(())
    }
}

impl Transport for Bus {
    type Error = Lost;

    fn send(&mut self, frame: &Frame) -> Result<(), Lost> {
        self.sent(frame)
    }

    fn receive(&mut self) -> Result<Frame, Lost> {
        self.came.pop_front().ok_or(Lost)
    }

    fn pending(&mut self) -> Result<Option<Frame>, Lost> {
        Ok(self.stale.pop_front())
    }
}

impl AsyncTransport for Bus {
    type Error = Lost;

    async fn send(&mut self, frame: &Frame) -> Result<(), Lost> {
        self.sent(frame)
    }

    async fn receive(&mut self) -> Result<Frame, Lost> {
        self.came.pop_front().ok_or(Lost)
    }

    async fn pending(&mut self) -> Result<Option<Frame>, Lost> {
        Ok(self.stale.pop_front())
    }
}

impl LocalTransport for Bus {
    type Error = Lost;

    async fn send(&mut self, frame: &Frame) -> Result<(), Lost> {
        self.sent(frame)
    }

    async fn receive(&mut self) -> Result<Frame, Lost> {
        self.came.pop_front().ok_or(Lost)
    }

    async fn pending(&mut self) -> Result<Option<Frame>, Lost> {
        Ok(self.stale.pop_front())
    }
}

/// Hears everything.
#[derive(Default)]
struct Log(Vec<Frame>);

impl Listener for Log {
    fn hear(&mut self, frame: &Frame) {
        self.0.push(*frame);
    }
}

fn frame(message: &Message, address: u16, raw: u16) -> Frame {
    message.build(&PROFILE, 5, address, raw).expect("a frame")
}

/// The same conversations with the client that blocks and the one that does not.
macro_rules! conversations {
    ($parameters:ident $telegrams:ident $client:ident $wait:ident) => {
        fn $parameters() {
            let asked = |address| frame(&ASK, address, 0);
            let answered = |address, raw| frame(&ANSWER, address, raw);
            let change = |address, raw| frame(&CHANGE, address, raw);
            let noise = part(0, [1, 2, 3]);
            let mut bus = Bus::new(&[
                (
                    asked(0x0102),
                    vec![noise, answered(0x0103, 8), answered(0x0102, 7)],
                ),
                (asked(0x0102), vec![answered(0x0102, 0xFFFF)]),
                (asked(0x0201), vec![answered(0x0201, 2)]),
                (asked(0x0202), vec![answered(0x0202, 1)]),
                (change(0x0102, 8), vec![answered(0x0102, 8)]),
                (change(0x0102, 9), vec![answered(0x0102, 8)]),
                (change(0x0201, 4), vec![answered(0x0201, 4)]),
                (change(0x0202, 3), vec![answered(0x0202, 3)]),
                (asked(0x0030), vec![answered(0x0030, 0xABCD)]),
                (change(0x0030, 0xAB7D), vec![answered(0x0030, 0xAB7D)]),
                (change(0x0030, 1), vec![]),
                (asked(0x0102), vec![noise; 4]),
                (asked(0x0102), vec![noise, noise, answered(0x0102, 7)]),
            ]);
            bus.stale = [noise, answered(0x0102, 6)].into();
            let client = $client::for_profile(bus, &PROFILE, 5).listening(Log::default());
            let mut client = client.patient(3);
            assert_eq!($wait(client.read::<Word>()), Ok(7));
            let heard = &client.listener().0;
            assert_eq!(
                *heard,
                [noise, answered(0x0102, 6), noise, answered(0x0103, 8)]
            );
            let wrong = ClientError::Point(REFUSED);
            assert_eq!($wait(client.read::<Word>()), Err(wrong));
            assert_eq!($wait(client.read_with::<Long>(())), Ok(0x0001_0002));
            assert_eq!($wait(client.write::<Word>(8)), Ok(()));
            assert_eq!(
                $wait(client.write::<Word>(9)),
                Err(ClientError::Reply(
                    ReplyError::OtherNumber {
                        written: 9,
                        answered: Some(8)
                    },
                    Some(About::Point("Word"))
                ))
            );
            assert_eq!($wait(client.write_with::<Long>(0x0003_0004, ())), Ok(()));
            assert_eq!($wait(client.update::<Group>(7)), Ok(()));
            assert_eq!(
                $wait(client.write_word(0x0030, 1)),
                Err(ClientError::Transport(Lost, None))
            );
            assert_eq!($wait(client.write::<Word>(0xFFFF)), Err(wrong));
            assert_eq!($wait(client.update::<Group>(0xFFFF)), Err(wrong));
            client.transport().came.clear();
            assert_eq!(
                $wait(client.read_word(0x0102)),
                Err(ClientError::Reply(ReplyError::NoAnswer, None))
            );
            client.transport().stale = [noise; 2].into();
            assert_eq!($wait(client.read_raw::<Word>()), Ok(7));
            assert_eq!(client.listener().0.len(), 4 + 3 + 2 + 2);
            assert!(client.into_transport().steps.is_empty());
            // An answer that carries neither address nor raw number answers all; a device may not answer at all.
            let bus = Bus::new(&[(change(0x0102, 9), vec![frame(&DONE, 0, 0)])]);
            let mut client = $client::for_profile(bus, &BRIEF, 5);
            assert_eq!($wait(client.write::<Word>(9)), Ok(()));
            let none = ClientError::Build(BuildError::NoMessage, Some(About::Point("Word")));
            assert_eq!($wait(client.read::<Word>()), Err(none));
            let bus = Bus::new(&[(change(0x0102, 9), vec![])]);
            let mut client = $client::for_profile(bus, &SILENT, 5);
            assert_eq!($wait(client.write::<Word>(9)), Ok(()));
            let mut client = $client::for_profile(Bus::default(), &PROFILE, 10);
            let bad = ClientError::Build(BuildError::BadUnit, Some(About::Point("Word")));
            assert_eq!($wait(client.read::<Word>()), Err(bad));
            let lost = ClientError::Transport(Lost, None);
            assert_eq!($wait(client.listen()), Err(lost));
            let bus = Bus::new(&[
                (asked(0x0102), vec![answered(0x0102, 7)]),
                (change(0x0102, 8), vec![answered(0x0102, 8)]),
                (change(0x0201, 4), vec![answered(0x0201, 4)]),
                (change(0x0202, 3), vec![answered(0x0202, 3)]),
            ]);
            let mut client = $client::for_profile(bus, &PROFILE, 5);
            assert_eq!($wait(client.read_count::<Word>()), Ok([7]));
            assert_eq!($wait(client.write_count::<Word>([8])), Ok(()));
            assert_eq!($wait(client.write_raw::<Long>(0x0003_0004)), Ok(()));
            for found in [
                $wait(client.write_count::<Word>([0xFFFF])),
                $wait(client.write_raw::<Word>(0xFFFF)),
            ] {
                assert_eq!(found, Err(wrong));
            }
            assert!(client.into_transport().steps.is_empty());
            let bus = Bus::new(&[(asked(0x0102), vec![noise; 10_000])]);
            let mut client = $client::for_profile(bus, &PROFILE, 5);
            let none = ClientError::Reply(ReplyError::NoAnswer, Some(About::Point("Word")));
            assert_eq!($wait(client.read::<Word>()), Err(none));
        }

        fn $telegrams() {
            let (low, high) = (
                |word| part(0, [0, word, word]),
                |word| part(1, [word, 0, 0]),
            );
            let bus = Bus::hears(&[
                low(5),
                high(1),
                low(7),
                low(0xFFFF),
                high(1),
                low(8),
                high(1),
                high(1),
                high(2),
                low(2),
                high(2),
            ]);
            let receiver = Receiver::<Measured>::new(5);
            let mut client = $client::for_profile(bus, &PROFILE, 5)
                .listening(receiver.clone())
                .patient(4);
            assert_eq!($wait(client.receive::<Speed>()), Ok(5));
            assert_eq!(client.listener().raw::<Speed>(), Ok(5));
            assert_eq!($wait(client.receive_with::<Speed>(())), Ok(7));
            let wrong = ClientError::Point(REFUSED);
            assert_eq!($wait(client.receive::<Speed>()), Err(wrong));
            assert_eq!($wait(client.receive::<Hours>()), Ok(0x0001_FFFF));
            let torn = ClientError::Point(Error::NotReceived(Some("Speed")));
            assert_eq!($wait(client.patient(2).receive::<Speed>()), Err(torn));
            let bus = Bus::hears(&[low(5), low(7)]);
            let mut client = $client::for_profile(bus, &PROFILE, 5).listening(receiver.clone());
            assert_eq!($wait(client.receive_count::<Speed>()), Ok([5]));
            assert_eq!($wait(client.receive_raw::<Speed>()), Ok(7));
            let lost = Err(ClientError::Transport(Lost, Some(About::Point("Speed"))));
            assert_eq!($wait(client.receive_count_with::<Speed>(())), lost);
            let bus = Bus::hears(&[high(1), low(7), high(2)]);
            let client =
                $client::for_profile(bus, &PROFILE, 5).listening((Log::default(), Log::default()));
            let mut client = client;
            assert_eq!($wait(client.listen()), Ok(()));
            assert_eq!(
                (&client.listener().0 .0, &client.listener().1 .0),
                (&vec![high(1)], &vec![high(1)])
            );
            let bus = Bus::hears(&[high(1), low(7), high(2)]);
            let mut client = $client::for_profile(bus, &PROFILE, 5)
                .listening(receiver)
                .patient(3);
            let torn = ClientError::Point(Error::Torn(Some("Hours")));
            assert_eq!($wait(client.receive::<Hours>()), Err(torn));
        }
    };
}

conversations!(parameters_at_once telegrams_at_once Client at_once);
conversations!(parameters_now telegrams_now AsyncClient now);
conversations!(parameters_staying telegrams_staying LocalClient now);
