// SPDX-License-Identifier: 0BSD
//! What the runtime does for every device, also where no vector of this one shows it.

#![allow(clippy::too_many_lines, reason = "a line for each case")]

use std::collections::VecDeque;
use std::fmt;

use fieldscribe_runtime::arithmetic;
use fieldscribe_runtime::client::{AsyncTransport, LocalTransport, Transport};
use fieldscribe_runtime::flags::{show, Flag, Flags};
use fieldscribe_runtime::form::floating::Pattern;
use fieldscribe_runtime::{
    digits, in_address_order, in_reading_order, point_table, quantity, text, written, AnyDevice,
    AnyValue, Code, Coded, CountWritable, Digits, Encodable, Error, Outside, Point, Points, Raw,
    Reading, Refused, Rule, Space, Special, Text, Whole, Writable,
};

/// A point that is a plain number; the greatest of its type may not be.
macro_rules! made_up {
    ($name:ident $raw:ty, $space:ident $address:literal, $addresses:expr, $words:literal) => {
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl fieldscribe_runtime::Point for $name {
            type Device = fieldscribe_runtime::AnyDevice;
            type Raw = $raw;
            type Value = $raw;
            const NAME: &'static str = stringify!($name);
            const SPACE: fieldscribe_runtime::Space = fieldscribe_runtime::Space::$space;
            const ADDRESS: u16 = $address;
            const ADDRESSES: &'static [u16] = $addresses;
            const WORDS: u16 = $words;
        }

        impl fieldscribe_runtime::WrittenAlone for $name {}

        impl fieldscribe_runtime::Readable for $name {
            type Factors = ();
            type Output<V> = Result<V, fieldscribe_runtime::Error>;

            fn decode_with(raw: $raw, (): ()) -> Result<$raw, fieldscribe_runtime::Error> {
                <Self as fieldscribe_runtime::Writable>::check_with(raw, ()).map(|()| raw)
            }
        }

        impl fieldscribe_runtime::Writable for $name {
            type With = ();

            fn check_with(raw: $raw, (): ()) -> Result<(), fieldscribe_runtime::Error> {
                if raw == <$raw as fieldscribe_runtime::Raw>::MAX {
                    Err(super::runtime::REFUSED)
                } else {
                    Ok(())
                }
            }
        }

        impl fieldscribe_runtime::Encodable for $name {
            fn encode_with(value: $raw, (): ()) -> Result<$raw, fieldscribe_runtime::Error> {
                <Self as fieldscribe_runtime::Writable>::check(value).map(|()| value)
            }
        }

        impl fieldscribe_runtime::CountReadable for $name {
            type Count = [$raw; 1];

            fn decode_count_with(
                raw: $raw,
                (): (),
            ) -> Result<[$raw; 1], fieldscribe_runtime::Error> {
                <Self as fieldscribe_runtime::Readable>::decode_with(raw, ()).map(|raw| [raw])
            }
        }

        impl fieldscribe_runtime::CountWritable for $name {
            type Count = [$raw; 1];

            fn encode_count_with(
                [count]: [$raw; 1],
                (): (),
            ) -> Result<$raw, fieldscribe_runtime::Error> {
                <Self as fieldscribe_runtime::Encodable>::encode_with(count, ())
            }
        }
    };
}

/// What made-up points say of the greatest number.
pub const REFUSED: Error = Error::OutOfRange(Refused::Raw(Outside {
    point: "made_up",
    given: 7,
    low: 0,
    high: 6,
}));

/// What a transport says when nothing came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lost;

impl fmt::Display for Lost {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("nothing came")
    }
}

impl std::error::Error for Lost {}

/// A line on which this is sent in this order, and that comes back.
///
/// A question mark is no answer in time, an exclamation mark one that is longer than its space.
pub struct Line {
    steps: VecDeque<(Vec<u8>, String)>,
    /// The space that was there for the last answer.
    pub space: usize,
}

impl Line {
    /// A line of such steps, in hexadecimal.
    pub fn new(steps: &[(Vec<u8>, String)]) -> Self {
        let steps = steps.iter().cloned().collect();
        Self { steps, space: 0 }
    }

    /// That all was sent.
    pub fn done(&self) {
        assert_eq!(self.steps.front(), None, "was not sent");
    }

    fn answered(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Lost> {
        let (sent, came) = self.steps.pop_front().expect("sent too much");
        assert_eq!(super::hex(&sent), super::hex(request));
        self.space = reply.len();
        match came.as_str() {
            "?" => Err(Lost),
            "!" => Ok(reply.len() + 1),
            came => {
                let bytes = super::bytes(came);
                reply[..bytes.len()].copy_from_slice(&bytes);
                Ok(bytes.len())
            }
        }
    }
}

impl Transport for Line {
    type Error = Lost;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Lost> {
        self.answered(request, reply)
    }
}

impl AsyncTransport for Line {
    type Error = Lost;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Lost> {
        self.answered(request, reply)
    }
}

impl LocalTransport for Line {
    type Error = Lost;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Lost> {
        self.answered(request, reply)
    }
}

/// What a transport says that fails for a reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failed(Lost);

impl fmt::Display for Failed {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the line is down")
    }
}

impl std::error::Error for Failed {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.0)
    }
}

/// An error, all that it and what caused it say, in this order; nothing of it is said twice.
pub fn chain<E: std::error::Error>(error: &E) -> Vec<String> {
    let mut texts = vec![error.to_string()];
    let mut source = error.source();
    while let Some(cause) = source {
        texts.push(cause.to_string());
        source = cause.source();
    }
    texts
}

/// What a client of that family says of a transport that fails.
pub const FAILED: Failed = Failed(Lost);

/// What a transport that fails for a reason is told as.
pub const FAILURE: [&str; 2] = ["the line is down", "nothing came"];

/// The result of a client that blocks.
pub fn at_once<T>(result: T) -> T {
    result
}

/// That errors have these names and are shown so.
pub fn tells<E: fmt::Display + Copy>(name: impl Fn(E) -> &'static str, rows: &[(E, &str, &str)]) {
    for (error, named, shown) in rows {
        assert_eq!(name(*error), *named);
        assert_eq!(error.to_string(), *shown);
    }
}

/// Panics where the runtime is not as it should be.
pub fn check() {
    errors();
    rounding();
    bits();
    numbers();
    rules();
    rules_at_their_ends();
    orders();
    words_of_digits();
    words_of_flags();
    codes();
    texts();
    tables();
}

const COUNT: Outside<i64> = Outside {
    point: "speed",
    given: -5,
    low: 1,
    high: 9,
};

const LEVEL: Outside<f64> = Outside {
    point: "level",
    given: 7.5,
    low: -1.0,
    high: 2.5,
};

fn errors() {
    assert_eq!(
        (
            REFUSED.refused().map(Refused::point),
            Error::NoCase(None).refused()
        ),
        (Some("made_up"), None)
    );
    assert_eq!(chain(&FAILED), FAILURE);
    let nameless = [
        Error::BadText,
        Error::BadDate,
        Error::ZeroFactor,
        Error::NoCase,
        Error::Overflow,
        Error::Malformed,
        Error::WrongLength,
        Error::WrongSpace,
        Error::NotHeard,
        Error::NotReceived,
        Error::Torn,
    ];
    for error in nameless {
        assert_eq!((error(None).point(), error(None).refused()), (None, None));
        assert_eq!(error(None).of::<Number>(), error(Some("Number")));
        assert_eq!(error(Some("level")).of::<Number>(), error(Some("level")));
        let shown = format!("level: {}", error(None));
        assert_eq!(error(Some("level")).to_string(), shown);
    }
    for error in [
        REFUSED,
        Error::NotANumber("made_up"),
        Error::Special {
            point: "made_up",
            code: "off",
            is_writable: false,
        },
    ] {
        assert_eq!(error.point(), Some("made_up"));
        assert_eq!(error.of::<Number>(), error);
    }
    tells(
        Error::name,
        &[
            (REFUSED, "out_of_range", "made_up: raw 7 is outside 0 to 6"),
            (
                Error::OutOfRange(Refused::Count(COUNT)),
                "out_of_range",
                "speed: count -5 is outside 1 to 9",
            ),
            (
                Error::OutOfRange(Refused::Value {
                    outside: LEVEL,
                    unit: "",
                    raw: None,
                }),
                "out_of_range",
                "level: 7.5 is outside -1 to 2.5",
            ),
            (
                Error::OutOfRange(Refused::Value {
                    outside: LEVEL,
                    unit: "kPa",
                    raw: Some((-100, 250)),
                }),
                "out_of_range",
                "level: 7.5 kPa is outside -1 to 2.5 kPa (raw -100 to 250)",
            ),
            (
                Error::OutOfRange(Refused::Value {
                    outside: Outside {
                        low: 65.0,
                        high: 60.0,
                        ..LEVEL
                    },
                    unit: "Hz",
                    raw: Some((650, 600)),
                }),
                "out_of_range",
                "level: 7.5 Hz is refused, as nothing is allowed now: \
                 the least is 65 Hz, the greatest 60 Hz (raw 650 to 600)",
            ),
            (
                Error::UnknownValue(COUNT),
                "unknown_value",
                "speed: nothing has the number -5",
            ),
            (
                Error::OutOfRange(Refused::FixedBits {
                    point: "control",
                    given: 3,
                    mask: 0x8000,
                    bits: 0x8000,
                }),
                "out_of_range",
                "control: raw 3 lacks constant bits: those of mask 8000h are always written as 8000h",
            ),
            (
                Error::OutOfRange(Refused::Fraction {
                    point: "speed",
                    given: 3.5,
                }),
                "out_of_range",
                "speed: 3.5 is not a whole number",
            ),
            (
                Error::Missing {
                    point: "speed",
                    needs: &[],
                },
                "wrong_length",
                "speed: the raw numbers of other points are missing",
            ),
            (
                Error::BadText(None),
                "out_of_range",
                "the text is too long, or has a character that is none of its encoding",
            ),
            (
                Error::NotANumber("level"),
                "not_a_number",
                "level: the value is not a number",
            ),
            (
                Error::ZeroFactor(None),
                "zero_factor",
                "a factor is zero or no quantity",
            ),
            (
                Error::NotBrought(None),
                "wrong_length",
                "the reply does not bring the point",
            ),
            (
                Error::BeyondLink(Some("speed")),
                "wrong_length",
                "speed: the link has not so many words of process data",
            ),
            (Error::NoCase(None), "no_case", "no case of the scale holds"),
            (
                Error::Overflow(None),
                "overflow",
                "the result does not fit its type",
            ),
            (
                Error::Special {
                    point: "level",
                    code: "off",
                    is_writable: false,
                },
                "special",
                "level: the number is the special code off and no quantity, which is only read",
            ),
            (
                Error::Special {
                    point: "level",
                    code: "off",
                    is_writable: true,
                },
                "special",
                "level: the number is the special code off and no quantity: \
                 write it as Reading::Special(...)",
            ),
            (
                Error::WrongLength(None),
                "wrong_length",
                "the point has another number of words",
            ),
            (
                Error::WrongSpace(None),
                "wrong_space",
                "the reply is of another space than the point's",
            ),
            (
                Error::NotHeard(None),
                "not_heard",
                "the last telegram was not answered",
            ),
            (
                Error::NotReceived(None),
                "missing",
                "the frame with the word never came",
            ),
            (
                Error::Torn(None),
                "torn",
                "the words may belong to different moments",
            ),
        ],
    );
    for (space, name) in [
        (Space::Coil, "coil"),
        (Space::Discrete, "discrete"),
        (Space::Input, "input"),
        (Space::Holding, "holding"),
        (Space::Parameter, "parameter"),
        (Space::Telegram, "telegram"),
        (Space::Other("drum"), "drum"),
    ] {
        assert_eq!(space.name(), name);
    }
}

fn rounding() {
    for (number, nearest) in [
        (0.49, 0),
        (0.5, 1),
        (-0.49, 0),
        (-0.5, -1),
        (2.5, 3),
        (-2.5, -3),
        (1_000_000.25, 1_000_000),
        (-1_000_000.75, -1_000_001),
    ] {
        assert_eq!(arithmetic::round_i32(number), Some(nearest));
        assert_eq!(arithmetic::round_i64(number), Some(i64::from(nearest)));
        assert_eq!(arithmetic::round_i128(number), Some(i128::from(nearest)));
    }
    let power = |exponent: u64| f64::from_bits((1023 + exponent) << 52);
    assert_eq!(arithmetic::round_i32(power(31) - 0.75), Some(i32::MAX));
    assert_eq!(arithmetic::round_i32(power(31) - 0.5), None);
    assert_eq!(arithmetic::round_i32(power(31)), None);
    assert_eq!(arithmetic::round_i32(-power(31) - 0.25), Some(i32::MIN));
    assert_eq!(arithmetic::round_i32(-power(31) - 0.5), None);
    assert_eq!(arithmetic::round_i64(power(63)), None);
    assert_eq!(arithmetic::round_i64(power(62)), Some(1 << 62));
    assert_eq!(arithmetic::round_i64(-power(63)), Some(i64::MIN));
    assert_eq!(arithmetic::round_i64(-power(63) - 2048.0), None);
    assert_eq!(arithmetic::round_i128(power(65)), None);
    assert_eq!(
        arithmetic::round_i128(power(65) - 8192.0),
        Some((1 << 65) - 8192)
    );
    assert_eq!(arithmetic::round_i128(-power(65)), Some(-(1 << 65)));
    assert_eq!(arithmetic::round_i128(-power(65) - 8192.0), None);
    assert_eq!(arithmetic::round_i32(f64::NAN), None);
    for dividend in -20_i8..20 {
        let away = |half: i8| dividend.signum() * ((dividend.abs() + half) / (2 * half));
        assert_eq!(
            arithmetic::div_round_i64(dividend.into(), 8),
            away(4).into()
        );
        assert_eq!(
            arithmetic::div_round_i64(dividend.into(), 6),
            away(3).into()
        );
        assert_eq!(
            arithmetic::div_round_i128(dividend.into(), 4),
            away(2).into()
        );
    }
    assert_eq!(arithmetic::div_round_i64(i64::MIN, 1), i64::MIN);
    assert_eq!(arithmetic::div_round_i64(8, 3), 3);
    assert_eq!(arithmetic::div_round_i64(8, 0), 0);
    assert_eq!(arithmetic::to_f64(-3).to_bits(), (-3.0_f64).to_bits());
    for (dividend, divisor, value) in [
        (0, 7, 0.0),
        (7, 0, 0.0),
        (1, 3, 1.0 / 3.0),
        (-7, 2, -3.5),
        (i128::from(u64::MAX), 1, power(64)),
        ((1 << 53) + 1, 1, power(53)),
        ((1 << 54) + 3, 1, power(54) + 4.0),
        ((1 << 100) + 1, 1 << 47, power(53)),
        (((1 << 53) + 1) * 3 + 1, 3, power(53) + 2.0),
    ] {
        assert_eq!(
            arithmetic::quotient(dividend, divisor).to_bits(),
            value.to_bits()
        );
    }
}

fn bits() {
    let exponents = [-3_i16, -2, 4, 5].map(|raw| arithmetic::exponent("power", raw, -2, 4));
    let broken = |given| Error::BrokenFactor {
        factor: Outside {
            point: "power",
            given,
            low: -2,
            high: 4,
        },
        point: None,
    };
    assert_eq!(exponents, [Err(broken(-3)), Ok(-2), Ok(4), Err(broken(5))]);
    let shown = "level: the factor power is 5, outside -2 to 4";
    assert_eq!(broken(5).of::<told::Level>().to_string(), shown);
    assert_eq!(arithmetic::line(5_u16, -3, 7), Ok(-8));
    assert_eq!(arithmetic::line(i64::MAX, 2, 0), Err(Error::Overflow(None)));
    assert_eq!(arithmetic::line(i64::MAX, 1, 1), Err(Error::Overflow(None)));
    assert_eq!(arithmetic::extract(0xABCD, 4, 0x0FF0), 0xBC);
    assert_eq!(arithmetic::extract(0xABCD, 16, 0xFFFF), 0);
    assert_eq!(arithmetic::extract_signed(0x0B00, 8, 0x0F00), 0xFFFB);
    assert_eq!(arithmetic::extract_signed(0xF7FF, 8, 0x0F00), 7);
    assert_eq!(arithmetic::extract_signed(0xF7FF, 0, 0), 0);
    assert_eq!(arithmetic::extract_signed(0xF7FF, 16, 0xFFFF), 0);
    assert_eq!(arithmetic::insert(0xA5C3, 4, 0x0FF0, 0x1E7), 0xAE73);
    assert_eq!(arithmetic::insert(0xA5C3, 16, 0xFFFF, 1), 0xA5C3);
}

/// A type of raw numbers: its words, its ends, and what is rounded to it.
fn number_of<R: Raw + PartialEq + fmt::Debug>(
    raw: R,
    wide: i64,
    words: &[u16],
    low: f64,
    high: f64,
) {
    assert_eq!(raw.to_i64(), wide);
    assert_eq!(raw.into_words().as_ref(), words);
    assert_eq!(R::from_words(raw.into_words()), raw);
    assert_eq!(R::round(low), Some(R::MIN));
    assert_eq!(R::round(low - 1.0), None);
    assert_eq!(R::round(high), Some(R::MAX));
    assert_eq!(R::round(high + 1.0), None);
}

fn numbers() {
    number_of(0xA5_u8, 0xA5, &[0x00A5], 0.0, 255.0);
    number_of(-3_i8, -3, &[0xFFFD], -128.0, 127.0);
    number_of(0xA5C3_u16, 0xA5C3, &[0xA5C3], 0.0, 65_535.0);
    number_of(-3_i16, -3, &[0xFFFD], -32_768.0, 32_767.0);
    number_of(
        0xA5C3_1234_u32,
        0xA5C3_1234,
        &[0xA5C3, 0x1234],
        0.0,
        4_294_967_295.0,
    );
    number_of(
        -3_i32,
        -3,
        &[0xFFFF, 0xFFFD],
        -2_147_483_648.0,
        2_147_483_647.0,
    );
    number_of(true, 1, &[1], 0.0, 1.0);
    assert_eq!(
        0x0123_4567_89AB_CDEF_i64.into_words(),
        [0x0123, 0x4567, 0x89AB, 0xCDEF]
    );
    assert_eq!(
        u64::from_words([0x0123, 0x4567, 0x89AB, 0xCDEF]),
        0x0123_4567_89AB_CDEF
    );
    assert_eq!(i64::from_words([0x8000, 0, 0, 1]).to_i64(), i64::MIN + 1);
    assert_eq!((<i64 as Raw>::MIN, <i64 as Raw>::MAX), (i64::MIN, i64::MAX));
    assert_eq!((<u64 as Raw>::MIN, <u64 as Raw>::MAX), (0, u64::MAX));
    assert_eq!([5, u64::MAX].map(Raw::to_i64), [5, i64::MAX]);
    assert_eq!(
        <u64 as Raw>::round(18_446_744_073_709_549_568.0),
        Some(u64::MAX - 2047)
    );
    assert_eq!(<u64 as Raw>::round(18_446_744_073_709_551_616.0), None);
    assert_eq!(<i64 as Raw>::round(-0.5), Some(-1));
    assert!(bool::from_words([0x0100]));
    assert!(!bool::from_words([0]));
    assert_eq!(<[u16; 2] as Raw>::round(0.0), None);
    assert_eq!(Raw::to_i64([7_u16; 2]), 0);
    assert_eq!(
        (<[u16; 2] as Raw>::MIN, <[u16; 2] as Raw>::MAX),
        ([0; 2], [0xFFFF; 2])
    );
}

/// A quotient rounded to nearest, halves away from zero.
fn nearest(dividend: i64, divisor: i64) -> i64 {
    let size = (2 * dividend.abs() + divisor.abs()) / (2 * divisor.abs());
    size * dividend.signum() * divisor.signum()
}

/// Rules with a factor of eighths against fractions.
fn rules() {
    let factors = [1.0, 0.125, -0.375, 2.5, -8.0_f32];
    for eighths in [8, 1, -3, 20, -64].iter().zip(factors) {
        for (num, den) in [(1, 1), (-3, 2), (7, 5), (2, 3)] {
            for (offset, over) in [(0, 1), (1, 2), (-7, 3), (1, 1)] {
                let rule = Rule::new(num, den).plus(offset, over);
                for raw in -12..12 {
                    rule_with(rule, [num, den, offset, over], (*eighths.0, eighths.1), raw);
                }
            }
        }
    }
}

fn rule_with(
    rule: Rule,
    [num, den, offset, over]: [i64; 4],
    (eighths, factor): (i64, f32),
    raw: i64,
) {
    let (bits, real) = (factor.to_bits(), arithmetic::to_f64);
    let times = rule.times_f32(bits).expect("a factor");
    let divided = rule.over_f32(bits).expect("a divisor");
    let limited = rule.limited_by_f32(bits).expect("a factor");
    for (rule, [up, down]) in [
        (rule, [1, 1]),
        (times, [eighths, 8]),
        (divided, [8, eighths]),
        (rule.times(eighths).expect("a factor"), [eighths, 1]),
        (rule.limited_by(eighths).expect("a factor"), [eighths, 1]),
        (limited, [eighths, 8]),
    ] {
        let (above, below) = (num * up, den * down);
        let sum = |count: i64, per: i64| {
            (
                count * above * over + offset * below * per,
                below * per * over,
            )
        };
        let (total, by) = sum(raw, 10);
        assert_eq!(rule.encode_count(raw, 10), Some(nearest(total, by)));
        let (total, by) = sum(1, 1);
        assert_eq!(rule.limit(), Ok(nearest(total, by)));
        let back = (raw * over - offset) * below;
        assert_eq!(
            rule.decode_count(raw, 10),
            Ok(nearest(back * 10, above * over))
        );
        let value = rule.decode(raw).expect("a value");
        assert_eq!(
            value.abs().to_bits(),
            (real(back) / real(above * over)).abs().to_bits()
        );
        assert_eq!(value < 0.0, back.signum() * above.signum() < 0);
        let found = rule.encode(real(raw) / 4.0);
        let exact = real(raw) / 4.0 * real(above) / real(below) + real(offset) / real(over);
        assert!((found - exact).abs() < 1e-9, "{found} is not {exact}");
    }
}

fn rules_at_their_ends() {
    let (one, most) = (Rule::new(1, 1), Rule::new(i64::MAX, 1));
    let power = |exponent: i16| u32::nearest(2_f64.powi(exponent.into()));
    let ten = (one.times(1000), one.over(1000));
    assert_eq!((one.times_ten_to(3), one.times_ten_to(-3)), ten);
    assert_eq!((one.over_ten_to(-3), one.over_ten_to(3)), ten);
    for wrong in [
        most.times(2),
        most.limited_by(2),
        Rule::new(1, i64::MAX).over(2),
        Rule::new(i64::MIN, 1).times_f32((-1.0_f32).to_bits()),
        one.times_ten_to(19),
        one.times_ten_to(i64::MIN),
        one.over_ten_to(i64::MIN),
    ] {
        assert_eq!(wrong, Err(Error::Overflow(None)));
    }
    let odd = 0x4B7F_FFFF;
    let twice = one.times_f32(odd).and_then(|rule| rule.times_f32(odd));
    assert_eq!(
        twice.and_then(|rule| rule.times_f32(odd)),
        Err(Error::Overflow(None))
    );
    for none in [0, 0x8000_0000, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0000] {
        assert_eq!(one.times_f32(none), Err(Error::ZeroFactor(None)));
        assert_eq!(one.over_f32(none), Err(Error::ZeroFactor(None)));
        assert_eq!(
            one.plus(5, 1).limited_by_f32(none).and_then(Rule::limit),
            Ok(5)
        );
    }
    assert_eq!(
        (one.times(0), one.over(0)),
        (Err(Error::ZeroFactor(None)), Err(Error::ZeroFactor(None)))
    );
    let nothing = one.limited_by(0).expect("a limit");
    assert_eq!(
        (nothing.limit(), nothing.decode(1)),
        (Ok(0), Err(Error::ZeroFactor(None)))
    );
    assert_eq!(nothing.decode_count(1, 1), Err(Error::ZeroFactor(None)));
    let nothing = nothing.times_f32(power(0)).expect("a limit");
    assert_eq!(
        (nothing.limit(), nothing.decode_count(1, 1)),
        (Ok(0), Err(Error::ZeroFactor(None)))
    );
    for end in [i64::MIN, -1, i64::MAX] {
        assert_eq!(
            (one.encode_count(end, 1), one.decode_count(end, 1)),
            (Some(end), Ok(end))
        );
        let same = one.times_f32(power(0)).expect("a factor");
        assert_eq!(
            (same.encode_count(end, 1), same.decode_count(end, 1)),
            (Some(end), Ok(end))
        );
    }
    assert_eq!(most.encode_count(2, 1), None);
    assert_eq!(most.plus(1, 1).encode_count(1, 1), None);
    assert_eq!(most.plus(1, 1).limit(), Err(Error::Overflow(None)));
    assert_eq!(
        Rule::new(1, 2).decode_count(i64::MAX, 1),
        Err(Error::Overflow(None))
    );
    assert_eq!(Rule::new(1, 2).decode(i64::MAX), Err(Error::Overflow(None)));
    assert_eq!(one.plus(-1, 1).decode(i64::MAX), Err(Error::Overflow(None)));
    assert_eq!(
        Rule::new(-1, 1).decode_count(i64::MIN, 1),
        Err(Error::Overflow(None))
    );
    let large = one.times_f32(power(63)).expect("a factor");
    assert_eq!(
        (large.encode_count(1, 1), large.limit()),
        (None, Err(Error::Overflow(None)))
    );
    assert_eq!(
        (large.encode_count(-1, 1), large.encode_count(0, 1)),
        (Some(i64::MIN), Some(0))
    );
    let largest = one
        .times_f32(power(127))
        .and_then(|rule| rule.times_f32(power(127)))
        .expect("factors");
    assert_eq!(
        (largest.encode_count(0, 1), largest.encode_count(1, 1)),
        (Some(0), None)
    );
    assert_eq!(largest.decode_count(i64::MAX, 1), Ok(0));
    let divided = one.over_f32(power(63)).expect("a divisor");
    assert_eq!(
        (divided.decode_count(-1, 1), divided.decode_count(1, 1)),
        (Ok(i64::MIN), Err(Error::Overflow(None)))
    );
    for (count, offset, found) in [
        (1, 0, 0),
        (1, 1, 1),
        (1, -1, 0),
        (-1, 1, 0),
        (-1, -1, -1),
        (0, 1, 1),
        (0, -1, -1),
    ] {
        let tiny = one
            .plus(offset, 2)
            .times_f32(power(-149))
            .expect("a factor");
        assert_eq!(tiny.encode_count(count, 1), Some(found));
        let third = Rule::new(1, 3)
            .plus(offset, 2)
            .times_f32(power(-40))
            .expect("a factor");
        assert_eq!(third.encode_count(count, 1), Some(found));
    }
    let third = Rule::new(1, 3).times_f32(power(62)).expect("a factor");
    assert_eq!(third.encode_count(1, 1), Some(1_537_228_672_809_129_301));
    assert_eq!(third.encode_count(-2, 1), Some(-3_074_457_345_618_258_603));
    let repeated = |bits: u32| {
        (0..9)
            .try_fold(one, |rule, _| rule.times_f32(bits))
            .expect("factors")
    };
    assert_eq!(repeated(power(127)).encode(1.0).to_bits(), 2046 << 52);
    assert_eq!(repeated(power(-149)).encode(1.0).to_bits(), 0);
    assert_eq!(
        one.times_f32(1).map(|rule| rule.encode(1.0)),
        Ok(f64::from(f32::from_bits(1)))
    );
    assert_eq!(
        one.times_f32(0x7F_FFFF).map(|rule| rule.encode(1.0)),
        Ok(f64::from(f32::from_bits(0x7F_FFFF)))
    );
    assert_eq!(
        one.times_f32(0xFF7F_FFFF).map(|rule| rule.encode(1.0)),
        Ok(f64::from(f32::MIN))
    );
}

fn orders() {
    let addresses = [30, 10, 40, 20];
    assert_eq!(in_reading_order([1, 2, 3, 4], &addresses), [3, 1, 4, 2]);
    assert_eq!(in_address_order([3, 1, 4, 2], &addresses), [1, 2, 3, 4]);
}

made_up!(Number u16, Parameter 0, &[0], 1);

impl Whole for Number {}

impl Digits for Number {
    const NUMBERS: &'static [u16] = &[0, 1, 5, 6, 7];
}

fn words_of_digits() {
    assert_eq!(digits::split(40_567), [4, 0, 5, 6, 7]);
    assert_eq!(digits::split(40_567), [405, 6, 7]);
    assert_eq!(digits::split::<0>(40_567), []);
    assert_eq!(digits::join::<Number>(&[5_u16, 0, 6]), Ok(506));
    let unknown = |given| {
        Err(Error::UnknownValue(Outside {
            point: "Number",
            given,
            low: 0,
            high: 65_535,
        }))
    };
    assert_eq!(digits::join::<Number>(&[5_u16, 3]), unknown(3));
    assert_eq!(digits::join::<Number>(&[6_u16, 5, 5, 1, 6]), Ok(65_516));
    assert_eq!(digits::join::<Number>(&[7_u16, 0, 0, 0, 0]), unknown(0));
    assert_eq!(digits::join::<Number>(&[6_u16, 5, 5, 5, 0]), unknown(0));
    assert_eq!(digits::join::<Number>(&[-1_i32]), unknown(-1));
    assert_eq!(
        digits::join::<Number>(&[i128::MAX, i128::MIN]),
        unknown(i64::MAX)
    );
    assert_eq!(digits::check::<Number, 2>(57), Ok(()));
    let failed = |raw| digits::check::<Number, 2>(raw).map_err(Error::name);
    assert_eq!([37, 53].map(failed), [Err("unknown_value"); 2]);
}

/// A word with a bit of each kind.
#[derive(Clone, Copy)]
struct Word(u64);

impl Flags for Word {
    const NAME: &'static str = "Word";
    const FLAGS: &'static [Flag] = &[
        Flag::new("ready", 0x0001),
        Flag::active_low("fault", 0x0008),
        Flag::new("state", 0x0030),
        Flag::named("mode", 0x0300, &[(1, "slow"), (3, "fast")]),
    ];

    fn bits(self) -> u64 {
        self.0
    }
}

impl fmt::Debug for Word {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        show(*self, formatter)
    }
}

fn words_of_flags() {
    let shown = [0x0008, 0x2031, 0x0309, 0x0209].map(|bits| format!("{:?}", Word(bits)));
    let expected = [
        "Word(0x0008)",
        "Word(0x2031: ready, fault, state=3)",
        "Word(0x0309: ready, mode=fast)",
        "Word(0x0209: ready, mode=2)",
    ];
    assert_eq!(shown, expected);
    let [ready, fault, state, mode] = Word::FLAGS else {
        panic!("there are four flags");
    };
    assert_eq!(
        [1, 2].map(|number| mode.name_of(number)),
        [Some("slow"), None]
    );
    assert_eq!(
        (ready.name(), ready.mask(), ready.is_active_low()),
        ("ready", 1, false)
    );
    assert_eq!(
        (fault.name(), fault.mask(), fault.is_active_low()),
        ("fault", 8, true)
    );
    assert_eq!((state.number(0xFFEF), Flag::new("", 0).number(7)), (2, 0));
}

impl Coded for Number {
    const CODES: &'static [Code<u16>] = &[
        Code::one(Special::new("odd", 7)),
        Code::band(Special::writable("band", 10), 12),
        Code::one(Special::no_value("gone", 20)),
        Code::one(Special::writable_no_value("off", 21)),
    ];
}

fn codes() {
    let found = |raw| {
        let code = Number::special(raw)?;
        Some((
            code.to_string(),
            code.raw(),
            code.is_no_value(),
            code.is_writable(),
        ))
    };
    let row =
        |name: &str, raw, no_value, writable| Some((name.to_owned(), raw, no_value, writable));
    assert_eq!(found(7), row("odd", 7, false, false));
    assert_eq!(
        [found(10), found(12)],
        [row("band", 10, false, true), row("band", 12, false, true)]
    );
    assert_eq!(found(20), row("gone", 20, true, false));
    assert_eq!(found(21), row("off", 21, true, true));
    assert_eq!([6, 8, 9, 13].map(found), [None, None, None, None]);
    assert_eq!(Number::CODES[1].name(), "band");
    assert_eq!(
        (Number::CODES[0].ends(), Number::CODES[1].ends()),
        ((7, 7), (10, 12))
    );
    let band = Special::writable("band", 11);
    let special = Error::Special {
        point: "Number",
        code: "odd",
        is_writable: false,
    };
    assert_eq!(
        (written::<Number>(band), band.checked::<Number>()),
        (Ok(11), Ok(()))
    );
    assert_eq!(Special::new("odd", 7).checked::<Number>(), Err(special));
    assert_eq!(written::<Number>(Special::new("odd", 7)), Err(special));
    let wrong = [("odd", 11), ("band", 13)]
        .map(|(name, raw)| written::<Number>(Special::writable(name, raw)));
    assert_eq!(
        wrong.map(|found| found.map_err(Error::name)),
        [Err("unknown_value"); 2]
    );
    assert_eq!(
        (quantity::<Number>(7), quantity::<Number>(8)),
        (Err(special), Ok(8))
    );
    let rule = Rule::new(1, 1);
    assert_eq!(
        (rule.unless(false), rule.unless(true)),
        (Ok(rule), Err(Error::ZeroFactor(None)))
    );
    let (value, code): (Reading<u16, u16>, _) =
        (Reading::from(5), Reading::Special::<u16, u16>(band));
    assert_eq!((value.value(), value.special()), (Some(5), None));
    assert_eq!((code.value(), code.special()), (None, Some(band)));
}

fn texts() {
    let short = Text::<5>::new("aé ").expect("a text");
    assert_eq!((short.as_bytes(), short.as_str()), (&b"a\xE9"[..], None));
    assert_eq!(
        (short.to_string(), format!("{short:?}")),
        ("aé".to_owned(), "\"aé\"".to_owned())
    );
    assert_eq!(short.into_words::<3>(), [0x61E9, 0x2020, 0x2020]);
    assert_eq!(short.into_words::<4>(), [0x61E9, 0x2020, 0x2020, 0x2020]);
    assert_eq!(short.chars().collect::<Vec<_>>(), ['a', 'é']);
    assert_eq!(
        Text::<5>::from_words(&[0x6162, 0x2063, 0x6465]),
        Text::from_bytes(b"ab cd").expect("a text")
    );
    assert_eq!(
        Text::<2>::try_from("ab").expect("a text").as_str(),
        Some("ab")
    );
    assert_eq!(
        Text::<2>::try_from(&b"a"[..]).expect("a text").as_ref(),
        b"a"
    );
    assert_eq!(
        (Text::<2>::new("abc"), Text::<2>::new("€")),
        (Err(Error::BadText(None)), Err(Error::BadText(None)))
    );
    assert_eq!(Text::<2>::from_bytes(b"abc"), Err(Error::BadText(None)));
    assert_eq!(
        (Text::<2>::default(), Text::<2>::EMPTY.as_bytes()),
        (Text::EMPTY, &b""[..])
    );
    assert_eq!(Text::<2>::EMPTY.into_words::<1>(), [0x2020]);
    assert_eq!(
        format!("{:?}", Text::<1>::new("\"").expect("a text")),
        "\"\\\"\""
    );
    for (word, ascii, latin) in [
        (0x2041, true, true),
        (0x7E41, true, true),
        (0x1F41, false, false),
        (0x7F41, false, false),
        (0x9F41, false, false),
        (0xA041, false, true),
        (0x41FF, false, true),
    ] {
        assert_eq!(
            (text::is_ascii(&[word]), text::is_latin_1(&[word])),
            (ascii, latin)
        );
    }
}

/// Points with every fact that a table tells, made by the macro that generated crates use.
mod told {
    use fieldscribe_runtime::point;

    point! {
        /// A group of bits that is read.
        Bits: u8 = "bits", "b1";
        at Telegram 7;
        telegram "status";
        bits 4 0x00F0 group;
        => value u8 as plain();
        read { count i32; }
    }

    point! {
        /// A value of two words that is written.
        Level: u32 = "level", "bits";
        at Holding 0x10;
        addresses [0x11, 0x10];
        words 2;
        index 3;
        unit "kPa";
        decimals 1;
        raw 5..=600;
        => value f64 as scaled(10, 1);
        write { count i32; }
    }

    point! {
        /// A number in its unit, which is read and written.
        Plain: u16 = "plain";
        at Holding 0x12;
        unit "Hz";
        raw 30..=400;
        => value u16 as plain();
        read { count i32; }
        write { count i32; }
    }

    point! {
        /// A word with a bit that is always written as 1.
        Control: u16 = "control";
        at Holding 0x13;
        fixed 0x8000 0x8000;
        => value u16 as plain();
        write { count i32; }
    }

    point! {
        /// A word that nobody asks for by itself.
        Neither: u16 = "neither";
        at Coil 1;
        => value u16 as plain();
    }
}

fn tables() {
    const POINTS: Points = point_table! { told: Bits Level Plain Neither };
    let places: Vec<_> = POINTS.iter().map(|one| (one.space, one.address)).collect();
    assert_eq!(
        places,
        [
            (Space::Telegram, 7),
            (Space::Holding, 0x10),
            (Space::Holding, 0x12),
            (Space::Coil, 1)
        ]
    );
    let beside = |name| {
        let found = POINTS.find(name)?;
        Some((
            found.name,
            found.words,
            found.mask,
            found.index,
            found.telegram,
        ))
    };
    // A name goes before the same code of another point.
    assert_eq!(
        beside("bits"),
        Some(("bits", 1, Some(0xF0), None, Some("status")))
    );
    assert_eq!(beside("b1"), beside("bits"));
    assert_eq!(beside("level"), Some(("level", 2, None, Some(3), None)));
    assert_eq!(
        (beside("b"), Points::<AnyDevice>::new(&[]).find("bits")),
        (None, None)
    );
    let meant = POINTS.iter().map(|one| (one.code, one.unit, one.decimals));
    let plain = [(None, "Hz", 0), (None, "", 0)];
    let coded = [(Some("b1"), "", 0), (Some("bits"), "kPa", 1)];
    assert_eq!(meant.collect::<Vec<_>>(), [coded, plain].concat());
    let access = POINTS
        .iter()
        .map(|one| (one.access.reads(), one.access.writes()));
    let expected = [(true, false), (false, true), (true, true), (false, false)];
    assert_eq!(access.collect::<Vec<_>>(), expected);
    let told = |error: Result<u16, Error>| error.map_err(|error| error.to_string());
    let shown = "plain: 500 Hz is outside 30 to 400 Hz";
    assert_eq!(told(told::Plain::encode(500)), Err(shown.to_owned()));
    let shown = "plain: raw 500 is outside 30 to 400";
    assert_eq!(told(told::Plain::encode_count(500)), Err(shown.to_owned()));
    let shown =
        "control: raw 3 lacks constant bits: those of mask 8000h are always written as 8000h";
    let raw = told::Control::check(3).map_err(|error| error.to_string());
    assert_eq!(raw, Err(shown.to_owned()));
    assert_eq!(told::Control::encode(3), Ok(0x8003));
    let data = |value: AnyValue<'_>| {
        let encoded = told::Control::INFO.encode(value, &[]);
        encoded.map_err(|error| error.to_string())
    };
    for (value, shown) in [
        ("3".into(), Ok(0x8003)),
        (3.0.into(), Ok(0x8003)),
        (3.5.into(), Err("3.5 is not a whole number")),
        ("70000".into(), Err("raw 70000 is outside 0 to 65535")),
        (1e5.into(), Err("raw 100000 is outside 0 to 65535")),
        ("a\"b".into(), Err("\"a\\\"b\" is not a number")),
        (
            "a text of more than 30 characters, \u{e9}".into(),
            Err("\"a text of more than 30 charact\"... is not a number"),
        ),
    ] {
        assert_eq!(
            data(value),
            shown.map_err(|text| format!("control: {text}"))
        );
    }
    let level = |value| told::Level::encode(value).map_err(|error| error.to_string());
    let shown = "level: 0.4 kPa is outside 0.5 to 60 kPa (raw 5 to 600)";
    assert_eq!(level(0.4), Err(shown.to_owned()));
    let shown = "level: 1000000000 kPa is outside 0.5 to 60 kPa (raw 5 to 600)";
    assert_eq!(level(1e9), Err(shown.to_owned()));
    let shown = "level: the value is not a number";
    assert_eq!(level(f64::NAN), Err(shown.to_owned()));
}
