// SPDX-License-Identifier: 0BSD
//! Runs conformance vectors: what each kind means, for any point. The tables of a device's points stand beside it.

#![allow(dead_code, reason = "not every device has points of every kind")]

pub mod frames;

use std::collections::BTreeMap;
use std::process::ExitCode;

use fieldscribe_runtime::{
    BitGroup, CountReadable, CountWritable, Decoded, Encodable, Error, Point, Raw, Readable, Text,
    Whole, Writable,
};
use serde_json::Value;

/// Nothing, or what differs.
pub type Outcome = Result<(), String>;

/// The kinds of vectors in the order of the report.
const KINDS: [&str; 31] = [
    "decode",
    "encode",
    "decode_count",
    "encode_count",
    "check",
    "name",
    "special",
    "flag",
    "flag_name",
    "bits",
    "words",
    "address",
    "build",
    "reply",
    "printed_build",
    "printed_reply",
    "block",
    "place",
    "fixed",
    "text_decode",
    "text_encode",
    "digits",
    "digits_encode",
    "can_build",
    "can_parse",
    "can_telegram",
    "uss_build",
    "uss_broadcast",
    "uss_reply",
    "uss_printed_build",
    "uss_printed_reply",
];

/// The keys of an `address` vector that are no numbering of the manual.
const OWN_KEYS: [&str; 9] = [
    "kind", "point", "space", "address", "words", "code", "raw_min", "raw_max", "decimals",
];

/// A function over the points of a device: which of them runs a vector, none if it is not in the table.
#[macro_export]
macro_rules! table {
    ($kind:ident $run:ident {}) => {
        fn $kind(_: &runner::Vector) -> Option<runner::Outcome> {
            None
        }
    };
    ($kind:ident $run:ident { $($item:literal $point:ident $with:tt;)+ }) => {
        fn $kind(vector: &runner::Vector) -> Option<runner::Outcome> {
            Some(match vector.subject().as_str() {
                $($item => table!($run $point $with vector),)+
                _ => return None,
            })
        }
    };
    ($run:ident $point:ident () $vector:ident) => {
        runner::$run::<device::points::$point>($vector, ())
    };
    ($run:ident $point:ident ($with:ident: $($field:ident $name:literal)+) $vector:ident) => {
        runner::$run::<device::points::$point>(
            $vector,
            device::with::$with { $($field: $vector.with($name)),+ },
        )
    };
    ($run:ident $point:ident (alone) $vector:ident) => {
        runner::$run::<device::points::$point>($vector)
    };
    ($run:ident $point:ident (at $($constant:ident $key:literal)*) $vector:ident) => {
        runner::$run::<device::points::$point>(
            $vector,
            &[$(($key, device::points::$point::$constant.into())),*],
        )
    };
    ($run:ident $point:ident (text $($constant:ident $key:literal)*) $vector:ident) => {
        runner::place_of::<device::points::$point>(
            $vector,
            &[$(($key, device::points::$point::$constant.into())),*],
        )
    };
    ($run:ident $point:ident (sizes $characters:literal $words:literal) $vector:ident) => {
        runner::$run::<device::points::$point, $characters, $words>($vector)
    };
    ($run:ident $point:ident (digits $count:literal $number:ident) $vector:ident) => {
        runner::$run::<device::points::$point, _, $number, $count>($vector)
    };
    ($run:ident $point:ident (frames) $vector:ident) => {
        runner::frames::$run::<device::points::$point>($vector)
    };
    ($run:ident $word:ident (value $constant:ident) $vector:ident) => {
        runner::$run($vector, u64::from(device::flags::$word::$constant))
    };
    ($run:ident $point:ident (one $special:ident) $vector:ident) => {{
        let raw = device::points::$point::$special;
        runner::special($vector, raw, raw)
    }};
    ($run:ident $point:ident (several $special:ident) $vector:ident) => {{
        let range = device::points::$point::$special;
        runner::special($vector, *range.start(), *range.end())
    }};
    ($run:ident $enum:ident (enum $raw:ident) $vector:ident) => {{
        let raw: $raw = $vector.raw("raw");
        let value = device::enums::$enum::from(raw);
        runner::name($vector, value.name(), $raw::from(value) == raw)
    }};
    ($run:ident $word:ident (on $raw:ident $get:ident $set:ident) $vector:ident) => {{
        let word = device::flags::$word::from($vector.raw::<$raw>("raw"));
        let same = word.$set(word.$get()) == word && word.$set(!word.$get()).$get() != word.$get();
        runner::flag($vector, u64::from(word.$get()), same)
    }};
    ($run:ident $word:ident (off $raw:ident $get:ident $set:ident) $vector:ident) => {{
        let word = device::flags::$word::from($vector.raw::<$raw>("raw"));
        let same = word.$set(word.$get()) == word && word.$set(!word.$get()).$get() != word.$get();
        runner::flag($vector, u64::from(!word.$get()), same)
    }};
    ($run:ident $word:ident (bits $raw:ident $get:ident $set:ident) $vector:ident) => {{
        let word = device::flags::$word::from($vector.raw::<$raw>("raw"));
        let other = !word.$get();
        let same = word.$set(word.$get()) == word && word.$set(other).$set(word.$get()) == word;
        runner::flag($vector, u64::from(word.$get()), same && word.$set(other) != word)
    }};
}

/// One vector.
pub struct Vector(Value);

impl Vector {
    /// A text; empty if there is none.
    pub fn text(&self, key: &str) -> &str {
        self.0[key].as_str().unwrap_or_default()
    }

    /// An integer, if it is there.
    pub fn number(&self, key: &str) -> Option<i128> {
        number(&self.0[key])
    }

    /// The integers of an array, if it is there.
    pub fn numbers<T: Number>(&self, key: &str) -> Option<Vec<T>> {
        let items = self.0[key].as_array()?.iter();
        Some(
            items
                .filter_map(number)
                .filter_map(T::from_number)
                .collect(),
        )
    }

    /// A raw number; the vectors hold none that its type does not.
    pub fn raw<T: Number>(&self, key: &str) -> T {
        let number = self.number(key).and_then(T::from_number);
        number.unwrap_or_else(|| panic!("{key} of {} is no such number", self.0))
    }

    /// The raw number of a point that this one needs.
    pub fn with<T: Number>(&self, name: &str) -> T {
        let number = number(&self.0["with"][name]).and_then(T::from_number);
        number.unwrap_or_else(|| panic!("{} lacks {name}", self.0))
    }

    /// The point, and what of it.
    pub fn subject(&self) -> String {
        let mut part = [self.text("special"), self.text("flag")].concat();
        if self.text("kind") == "flag_name" {
            part = format!("{part} {}", self.text("name"));
        }
        let point = self.text("point");
        if part.is_empty() {
            point.to_owned()
        } else {
            format!("{point} {part}")
        }
    }

    /// A truth.
    pub fn truth(&self, key: &str) -> bool {
        self.0[key].as_bool().unwrap_or_default()
    }

    /// Pairs of a number and bytes.
    pub fn pairs(&self, key: &str) -> Vec<(i128, Vec<u8>)> {
        let pairs = self.0[key].as_array().into_iter().flatten();
        let pair = |pair: &Value| Some((number(&pair[0])?, bytes(pair[1].as_str()?)));
        pairs.filter_map(pair).collect()
    }

    fn float(&self) -> f64 {
        f64::from_bits(u64::from_str_radix(self.text("float"), 16).unwrap_or_default())
    }

    /// Whether the status, and what is expected beside it, are what came out.
    fn expect(&self, found: Result<Value, Error>, key: &str) -> Outcome {
        let (status, value) = match found {
            Ok(value) => ("ok", value),
            Err(error) => (error.name(), Value::Null),
        };
        same(self.text("status"), status)?;
        same(&self.0[key], &value)
    }
}

fn number(value: &Value) -> Option<i128> {
    let signed = value.as_i64().map(i128::from);
    signed.or_else(|| value.as_u64().map(i128::from))
}

/// Bytes as the vectors have them.
pub fn hex(bytes: &[u8]) -> String {
    bytes
        .iter()
        .fold(String::new(), |text, byte| format!("{text}{byte:02x}"))
}

/// The bytes of a text of hexadecimal digits.
pub fn bytes(text: &str) -> Vec<u8> {
    let digits = (0..text.len() / 2).map(|place| &text[2 * place..2 * place + 2]);
    digits
        .filter_map(|pair| u8::from_str_radix(pair, 16).ok())
        .collect()
}

/// The two are equal.
pub fn same<T: PartialEq + std::fmt::Debug>(expected: T, found: T) -> Outcome {
    let pair = (expected, found);
    if pair.0 == pair.1 {
        Ok(())
    } else {
        Err(format!("expected {:?}, found {:?}", pair.0, pair.1))
    }
}

/// A type of raw numbers and counts.
pub trait Number: Sized + Copy {
    /// The number, if the type holds it.
    fn from_number(number: i128) -> Option<Self>;
    /// The number as JSON has it.
    fn to_value(self) -> Value;
}

macro_rules! number {
    ($($type:ty)+) => {
        $(impl Number for $type {
            fn from_number(number: i128) -> Option<Self> {
                Self::try_from(number).ok()
            }

            fn to_value(self) -> Value {
                Value::from(self)
            }
        })+
    };
}

number!(u8 u16 u32 u64 i8 i16 i32 i64);

impl Number for i128 {
    fn from_number(number: i128) -> Option<Self> {
        Some(number)
    }

    fn to_value(self) -> Value {
        i64::try_from(self).map_or_else(|_| u64::try_from(self).ok().into(), Value::from)
    }
}

impl Number for bool {
    fn from_number(number: i128) -> Option<Self> {
        [false, true].get(usize::try_from(number).ok()?).copied()
    }

    fn to_value(self) -> Value {
        Value::from(u8::from(self))
    }
}

/// A raw number to a value.
pub fn decode<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: Readable<Raw: Number, Value = f64>,
{
    let found = P::decode_with(vector.raw("raw"), with).into_result();
    let bits = found.map(|value| Value::from(format!("{:016x}", value.to_bits())));
    vector.expect(bits, "float")
}

/// A value to a raw number.
pub fn encode<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: Encodable<Raw: Number, Value = f64>,
{
    let found = P::encode_with(vector.float(), with);
    vector.expect(found.map(Number::to_value), "raw")
}

/// A raw number to a count.
pub fn decode_count<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: CountReadable<Raw: Number, Count: Number>,
{
    let found = P::decode_count_with(vector.raw("raw"), with).into_result();
    vector.expect(found.map(Number::to_value), "count")
}

/// A raw number to a count, which is itself, and to the value that has that number.
pub fn decode_plain<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: CountReadable<Raw: Number, Count: Number, Value: From<P::Raw> + PartialEq>,
{
    let raw = vector.raw("raw");
    if let Ok(value) = P::decode_with(raw, with).into_result() {
        same(true, value == P::Value::from(raw))?;
    }
    decode_count::<P>(vector, with)
}

/// A count to a raw number. A count that the type does not hold is out of range.
pub fn encode_count<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: CountWritable<Raw: Number, Count: Number>,
{
    let Some(count) = vector.number("count").and_then(P::Count::from_number) else {
        return same(vector.text("status"), "out_of_range");
    };
    let found = P::encode_count_with(count, with);
    vector.expect(found.map(Number::to_value), "raw")
}

/// A count to a raw number, and the value that has that number.
pub fn encode_plain<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: CountWritable<Raw: Number, Count: Number> + Encodable<Value: From<P::Raw>>,
{
    if let Some(raw) = vector.number("count").and_then(P::Raw::from_number) {
        let found = P::encode_with(P::Value::from(raw), with);
        vector.expect(found.map(Number::to_value), "raw")?;
    }
    encode_count::<P>(vector, with)
}

/// Whether a raw number may be written.
pub fn check<P: Writable<Raw: Number>>(vector: &Vector, with: P::With) -> Outcome {
    let found = P::check_with(vector.raw("raw"), with);
    vector.expect(found.map(|()| Value::Null), "none")
}

/// The name of a number.
pub fn name(vector: &Vector, found: Option<&str>, same_number: bool) -> Outcome {
    same(vector.0["name"].as_str(), found)?;
    same(true, same_number)
}

/// Numbers that are no quantity.
pub fn special<T: Number + PartialEq + std::fmt::Debug>(
    vector: &Vector,
    low: T,
    high: T,
) -> Outcome {
    same((vector.raw("low"), vector.raw("high")), (low, high))
}

/// A flag's number as it is in the word, and that setting it does what getting it says.
pub fn flag(vector: &Vector, found: u64, same_word: bool) -> Outcome {
    same(vector.raw::<u64>("number"), found)?;
    same(true, same_word)
}

/// The number that a name of a flag's numbers stands for.
pub fn flag_name(vector: &Vector, found: u64) -> Outcome {
    same(vector.raw("raw"), found)
}

/// A group of bits out of a word and into it.
pub fn bits<P>(vector: &Vector) -> Outcome
where
    P: BitGroup<Raw: Number + PartialEq + std::fmt::Debug>,
{
    let word = vector.raw("word");
    same(vector.raw::<P::Raw>("raw"), P::extract(word))?;
    same(
        vector.raw("result"),
        P::insert(word, vector.raw("replaced")),
    )
}

/// The words of a point in the order of their addresses.
pub fn words<P>(vector: &Vector) -> Outcome
where
    P: Whole<Raw: Number + PartialEq + std::fmt::Debug>,
{
    let raw: P::Raw = vector.raw("raw");
    let words: Vec<u16> = vector.numbers("words").unwrap_or_default();
    same(words.as_slice(), P::to_words(raw).as_ref())?;
    same(Ok(raw), P::from_received(words.iter().copied()))?;
    same(
        Err(Error::WrongLength),
        P::from_received(words.iter().skip(1).copied()),
    )?;
    same(
        Err(Error::WrongLength),
        P::from_received(words.iter().chain([&0]).copied()),
    )
}

/// Where a point is, and what stands beside it: the manual's code and other numberings, the outer limits, decimals.
pub fn address<P>(vector: &Vector, references: &[(&str, Value)]) -> Outcome
where
    P: Point<Raw: Number + PartialEq + std::fmt::Debug>,
{
    if vector.number("raw_min").is_some() {
        same(vector.raw("raw_min"), P::RAW_MIN)?;
        same(vector.raw("raw_max"), P::RAW_MAX)?;
    }
    place_of::<P>(vector, references)
}

/// The same but for the limits, which a text has not.
pub fn place_of<P: Point>(vector: &Vector, references: &[(&str, Value)]) -> Outcome {
    same(vector.text("space"), P::SPACE.name())?;
    same(vector.text("point"), P::NAME)?;
    same(vector.raw("address"), P::ADDRESS)?;
    same(vector.raw("words"), P::WORDS)?;
    same(vector.0["code"].as_str(), P::CODE)?;
    let decimals = vector.number("decimals").unwrap_or_default();
    same(decimals, i128::from(P::DECIMALS))?;
    for (key, number) in references {
        same(&vector.0[*key], number)?;
    }
    let keys = vector.0.as_object().into_iter().flat_map(|all| all.keys());
    let others = keys.filter(|key| !OWN_KEYS.contains(&key.as_str())).count();
    same(others, references.len())
}

/// What says where a point is beside its lowest address.
pub fn place<P: Point>(vector: &Vector) -> Outcome {
    let addresses = vector.numbers("addresses").unwrap_or_default();
    same(addresses.as_slice(), P::ADDRESSES)?;
    same(vector.number("index"), P::INDEX.map(i128::from))?;
    same(vector.0["telegram"].as_str(), P::TELEGRAM)
}

/// The bits of a word that are always written as a constant.
pub fn fixed<P: Point>(vector: &Vector) -> Outcome {
    same(vector.raw("mask"), P::FIXED_MASK)?;
    same(vector.raw("bits"), P::FIXED_BITS)
}

/// Words to a text.
pub fn text_decode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw = [u16; W], Value = Text<N>, Factors = ()>,
{
    let words: Vec<u16> = vector.numbers("words").unwrap_or_default();
    let mut raw = [0; W];
    raw.copy_from_slice(&words);
    let text = P::decode(raw).into_result().map_err(Error::name)?;
    same(vector.text("text"), hex(text.as_bytes()).as_str())?;
    same(text.as_bytes().len(), text.to_string().chars().count())
}

/// A text to words.
pub fn text_encode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw = [u16; W], Value = Text<N>, With = ()> + Whole,
{
    let bytes = bytes(vector.text("text"));
    let latin: String = bytes.iter().copied().map(char::from).collect();
    same(Text::<N>::from_bytes(&bytes), Text::new(&latin))?;
    let (status, words) = match Text::from_bytes(&bytes).and_then(P::encode) {
        Ok(raw) => {
            let received = P::to_words(raw).into_iter();
            same(Ok(raw), P::from_received(received))?;
            ("ok", raw.into_words().to_vec())
        }
        Err(error) => (error.name(), Vec::new()),
    };
    same(vector.text("status"), status)?;
    same(vector.numbers("words").unwrap_or_default(), words)
}

/// A number to its digits.
pub fn digits<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw: Number, Value = [E; N], Factors = ()>,
    C: From<E> + Into<i128>,
{
    let found = P::decode(vector.raw("raw")).into_result();
    let found = found.map_err(Error::name)?;
    let numbers: Vec<i128> = found.map(|digit| C::from(digit).into()).to_vec();
    same(vector.numbers("digits").unwrap_or_default(), numbers)
}

/// Digits to a number.
pub fn digits_encode<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw: Number, Value = [E; N], With = ()>,
    E: From<C> + Copy,
    C: Number,
{
    let numbers: Vec<C> = vector.numbers("digits").unwrap_or_default();
    let digits: Vec<E> = numbers.into_iter().map(E::from).collect();
    let digits = <[E; N]>::try_from(digits).map_err(|_| "there are other digits".to_owned())?;
    vector.expect(P::encode(digits).map(Number::to_value), "raw")
}

/// Runs all vectors of the file and reports one line per kind.
pub fn main(default: &str, run: impl Fn(&str, &Vector) -> Option<Outcome>) -> ExitCode {
    let path = std::env::var("FIELDSCRIBE_VECTORS").unwrap_or_else(|_| default.to_owned());
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let file: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut tally: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for one in file["vectors"].as_array().into_iter().flatten() {
        let vector = Vector(one.clone());
        let kind = KINDS
            .into_iter()
            .find(|kind| *kind == vector.text("kind"))
            .unwrap_or("unknown");
        let outcome =
            run(kind, &vector).unwrap_or_else(|| Err("nothing runs this vector".to_owned()));
        let failed = usize::from(outcome.is_err());
        let counts = tally.entry(kind).or_default();
        *counts = [counts[0] + 1 - failed, counts[1] + failed];
        if let Err(difference) = outcome {
            eprintln!("{one}: {difference}");
        }
    }
    report(&file, &tally)
}

fn report(file: &Value, tally: &BTreeMap<&str, [usize; 2]>) -> ExitCode {
    let mut total = [0, 0];
    let mut complete = true;
    for kind in KINDS.into_iter().chain(["unknown"]) {
        let [passed, failed] = tally.get(kind).copied().unwrap_or_default();
        let announced = file["counts"][kind].as_u64().unwrap_or_default();
        complete &= usize::try_from(announced) == Ok(passed + failed);
        if passed + failed > 0 {
            println!("{kind} {passed} passed, {failed} failed");
        }
        total = [total[0] + passed, total[1] + failed];
    }
    println!("total {} passed, {} failed", total[0], total[1]);
    if !complete {
        eprintln!("the file has other counts of vectors than it says");
    }
    if total[1] == 0 && total[0] > 0 && complete {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
