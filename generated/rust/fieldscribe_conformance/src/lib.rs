// SPDX-License-Identifier: 0BSD
//! Runs conformance vectors: what each kind means, for any point.
//!
//! The tables of a device's points stand in its own test.

#![forbid(unsafe_code)]
#![allow(
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    clippy::must_use_candidate,
    reason = "it is for tests, which end by it"
)]

#[macro_use]
mod clients;
#[macro_use]
mod runtime;

pub mod can;
mod can_clients;
mod client_errors;
pub mod modbus;
mod modbus_clients;
pub mod uss;
mod uss_clients;

use std::cell::Cell;
use std::future::Future;
use std::pin::{pin, Pin};
use std::process::ExitCode;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use fieldscribe_runtime::{
    AnyValue, BitGroup, Code, Coded, CountReadable, CountWritable, DateTime, Decoded, Displayed,
    Documented, Encodable, Error, Flags, Held, Identification, Point, PointInfo, Points, Raw,
    Readable, Reading, Refused, Space, Text, Utf8, Whole, Writable,
};

/// Numberings of a point, and what it is in them.
pub type References<'a> = &'a [(&'a str, &'a dyn std::fmt::Display)];

/// Nothing, or what differs.
pub type Outcome = Result<(), String>;

/// A function over the points of a device: which of them runs a vector, none if it is not in the table.
#[macro_export]
macro_rules! table {
    ($kind:ident $run:ident { $($item:literal $point:ident $with:tt;)+ }) => {
        fn $kind(vector: &$crate::Vector) -> Option<$crate::Outcome> {
            Some(match vector.subject().as_str() {
                $($item => $crate::table!($run $point $with vector),)+
                _ => return None,
            })
        }
    };
    ($run:ident $point:ident () $vector:ident) => {
        $crate::$run::<device::points::$point>($vector, ())
    };
    ($run:ident $point:ident ($with:ident: $($field:ident $name:literal)+) $vector:ident) => {
        $crate::$run::<device::points::$point>(
            $vector,
            device::with::$with { $($field: $vector.with($name)),+ },
        )
    };
    ($run:ident $point:ident (alone) $vector:ident) => {
        $crate::$run::<device::points::$point>($vector)
    };
    ($run:ident $point:ident (at $($constant:ident $key:literal)*) $vector:ident) => {
        $crate::$run::<device::points::$point>(
            $vector,
            &[$(($key, &device::points::$point::$constant)),*],
        )
    };
    ($run:ident $point:ident (text $($constant:ident $key:literal)*) $vector:ident) => {
        $crate::place_of::<device::points::$point>(
            $vector,
            &[$(($key, &device::points::$point::$constant)),*],
        )
    };
    ($run:ident $point:ident (sizes $characters:literal $words:literal) $vector:ident) => {
        $crate::$run::<device::points::$point, $characters, $words>($vector)
    };
    ($run:ident $point:ident (size $words:literal) $vector:ident) => {
        $crate::$run::<device::points::$point, $words>($vector)
    };
    ($run:ident $point:ident (digits $count:literal $number:ident) $vector:ident) => {
        $crate::$run::<device::points::$point, _, $number, $count>($vector)
    };
    ($run:ident $point:ident (frames) $vector:ident) => {
        frames::$run::<device::points::$point>($vector)
    };
    ($run:ident $module:ident (telegram $name:ident) $vector:ident) => {
        frames::$run::<device::$module::$name>($vector)
    };
    ($run:ident $module:ident (documented $name:ident) $vector:ident) => {
        $crate::documented($vector, &device::$module::documented::$name)
    };
    ($run:ident $module:ident (code $constant:ident) $vector:ident) => {
        $crate::code(
            $vector,
            u64::from(device::$module::$constant),
            $vector.said("name").as_deref(),
        )
    };
    ($run:ident $module:ident (named $constant:ident) $vector:ident) => {
        $crate::code(
            $vector,
            u64::from(device::$module::$constant),
            device::$module::name(device::$module::$constant),
        )
    };
    ($run:ident $module:ident (sent $constant:ident) $vector:ident) => {
        frames::command($vector, &device::PROFILE, &device::$module::$constant)
    };
    ($run:ident $point:ident (wire) $vector:ident) => {
        frames::$run::<device::points::$point>($vector, &device::PROFILE)
    };
    ($run:ident $point:ident (wire $($with:tt)+) $vector:ident) => {
        frames::$run::<device::points::$point>(
            $vector,
            &device::PROFILE,
            $($crate::table!(struct $with $vector)),+
        )
    };
    (struct () $vector:ident) => {
        ()
    };
    (struct ($with:ident: $($field:ident $name:literal)+) $vector:ident) => {
        device::with::$with { $($field: $vector.with($name)),+ }
    };
    ($run:ident $word:ident (value $constant:ident) $vector:ident) => {
        $crate::$run($vector, u64::from(device::flags::$word::$constant))
    };
    ($run:ident $enum:ident (enum $raw:ident) $vector:ident) => {{
        let raw: $raw = $vector.raw("raw");
        let value = device::enums::$enum::from(raw);
        $crate::name($vector, value.name(), $raw::from(value) == raw)
    }};
    ($run:ident $word:ident (flag $raw:ident $get:ident $set:ident) $vector:ident) => {{
        let word = device::flags::$word::from($vector.raw::<$raw>("raw"));
        let set = [word.$get(), !word.$get()].map(|state| word.$set(state));
        $crate::same($raw::from(word), $vector.raw("raw"))
            .and_then(|()| $crate::flag($vector, word, u64::from(word.$get()), set))
    }};
}

/// The fields of a kind or a set: their names, and whether they are for people alone.
struct Shape<'a> {
    name: &'a str,
    keys: Vec<(&'a str, bool)>,
    announced: usize,
    /// Other languages say this in more than comments.
    elsewhere: bool,
    passed: usize,
    failed: usize,
}

impl<'a> Shape<'a> {
    /// A line of the head, behind its first word.
    fn new(parts: &[&'a str], counted: bool) -> Self {
        let (name, announced) = (parts[0], parts.get(1).and_then(|count| count.parse().ok()));
        let fields = parts.iter().skip(if counted { 2 } else { 1 });
        let only = fields.clone().find_map(|field| field.strip_prefix("only:"));
        let fields = fields.filter(|field| !field.starts_with("only:"));
        let keys = fields.map(|field| field.split_once(':').unwrap_or((field, "")));
        Self {
            name,
            keys: keys.map(|(key, form)| (key, form == "note")).collect(),
            announced: announced.unwrap_or_default(),
            elsewhere: only.is_some_and(|only| !only.split('.').any(|one| one == "rust")),
            passed: 0,
            failed: 0,
        }
    }
}

/// One line: what it asks and answers, and what the sets before it say.
pub struct Vector<'a> {
    line: &'a str,
    kind: &'a str,
    fields: Vec<(&'a str, &'a str)>,
    shared: Vec<(&'a str, &'a str)>,
    used: Cell<u32>,
}

impl<'a> Vector<'a> {
    /// A field; none where it is absent. A field that nothing has is a fault of the runner.
    fn field(&self, key: &str) -> Option<&'a str> {
        let own = self.fields.iter().position(|(name, _)| *name == key);
        if let Some(place) = own {
            self.used.set(self.used.get() | 1 << place);
        }
        let shared = self.shared.iter().rev().find(|(name, _)| *name == key);
        let field = own.map_or_else(
            || shared.map(|pair| pair.1),
            |place| Some(self.fields[place].1),
        );
        field.filter(|field| *field != "-")
    }

    /// A text with its escapes undone, if it is there.
    pub fn said(&self, key: &str) -> Option<String> {
        self.field(key).map(unescaped)
    }

    /// A text; empty if there is none.
    pub fn text(&self, key: &str) -> String {
        self.said(key).unwrap_or_default()
    }

    /// An integer, if it is there.
    pub fn number(&self, key: &str) -> Option<i128> {
        self.field(key)?.parse().ok()
    }

    /// The integers of a list; none if it is absent.
    pub fn numbers<T: Number>(&self, key: &str) -> Vec<T> {
        let items = self.field(key).into_iter().flat_map(|list| list.split(','));
        let numbers = items.filter_map(|item| item.parse().ok());
        numbers.filter_map(T::from_number).collect()
    }

    /// Bytes; none if they are absent.
    pub fn bytes(&self, key: &str) -> Vec<u8> {
        self.field(key).map(bytes).unwrap_or_default()
    }

    /// A raw number; the vectors hold none that its type does not.
    pub fn raw<T: Number>(&self, key: &str) -> T {
        let number = self.number(key).and_then(T::from_number);
        number.unwrap_or_else(|| panic!("{key} of {} is no such number", self.line))
    }

    /// A raw number that is 0 where it is absent.
    pub fn count<T: Number + Default>(&self, key: &str) -> T {
        let number = self.number(key).and_then(T::from_number);
        number.unwrap_or_default()
    }

    /// The names and texts of a map.
    pub fn pairs(&self, key: &str) -> Vec<(String, String)> {
        let pairs = self.field(key).into_iter().flat_map(|list| list.split(','));
        let pairs = pairs.filter_map(|pair| pair.split_once('='));
        pairs
            .map(|(name, text)| (unescaped(name), unescaped(text)))
            .collect()
    }

    /// The raw number of a point that this one needs.
    pub fn with<T: Number>(&self, name: &str) -> T {
        let pairs = self.pairs("with").into_iter();
        let number = pairs
            .filter(|(one, _)| one == name)
            .find_map(|(_, raw)| raw.parse().ok());
        let number = number.and_then(T::from_number);
        number.unwrap_or_else(|| panic!("{} lacks {name}", self.line))
    }

    /// The raw numbers of these points; none where the table cannot name those that are needed.
    fn needs<T>(&self, points: Points) -> Option<Vec<i128>> {
        self.needed(std::mem::size_of::<T>() == 0, points)
    }

    fn needed(&self, nothing: bool, points: Points) -> Option<Vec<i128>> {
        let is_known = nothing || !points.is_empty();
        is_known.then(|| points.iter().map(|point| self.with(point.name)).collect())
    }

    /// The point, and what of it.
    pub fn subject(&self) -> String {
        let part = match self.kind {
            "flag" => self.text("flag"),
            "flag_name" => [self.text("flag"), self.text("name")].join(" "),
            "code" | "constant" => return [self.text("what"), self.text("name")].join(" "),
            "command" => return self.text("command"),
            "can_taken" | "can_carrier" => return self.text("telegram"),
            "documented" | "identification" => return self.text("name"),
            _ => return self.text("point"),
        };
        [self.text("point"), part].join(" ")
    }

    fn float(&self) -> f64 {
        let digits = format!("{:0<16}", self.field("value").unwrap_or_default());
        f64::from_bits(u64::from_str_radix(&digits, 16).unwrap_or_default())
    }

    /// Whether the status, and what is expected beside it, are what came out.
    fn expect<T: Number>(&self, found: Result<T, Error>, key: &str, gaps: bool) -> Outcome {
        self.refuses(found.as_ref().err().copied(), gaps)?;
        let status = found.as_ref().map_or_else(|error| error.name(), |_| "ok");
        same(self.text("status").as_str(), status)?;
        same(self.number(key), found.ok().map(Number::to_number))
    }

    /// Whether an error tells the point, what was given, and limits beyond which that is, if there are no gaps in them;
    /// the words of a text have no point yet when they are none.
    fn refuses(&self, error: Option<Error>, gaps: bool) -> Outcome {
        let refused = match error {
            Some(Error::OutOfRange(refused)) => refused,
            Some(error) => return same(Some(self.text("point").as_str()), error.point()),
            None => return Ok(()),
        };
        same(self.text("point").as_str(), refused.point())?;
        let (ordered, beyond) = match refused {
            Refused::Value { outside, .. } => {
                let asked = self.field("value").map(|_| self.float());
                same(asked.unwrap_or(outside.given), outside.given)?;
                ends(outside.given, outside.low, outside.high)
            }
            Refused::Count(outside) => {
                same(self.number("count"), Some(outside.given.into()))?;
                ends(outside.given, outside.low, outside.high)
            }
            Refused::Raw(outside) => ends(outside.given, outside.low, outside.high),
            _ => (true, true),
        };
        same((true, true), (ordered || gaps, beyond || gaps))
    }

    /// Whether what was read (a value, or the name of a special code) has the status, the code and the value expected.
    fn reads<T>(
        &self,
        found: Result<Result<T, &str>, Error>,
        value: impl FnOnce(T) -> Outcome,
    ) -> Outcome {
        let status = match &found {
            Ok(Ok(_)) => "ok",
            Ok(Err(_)) => "special",
            Err(error) => error.name(),
        };
        same(self.text("status").as_str(), status)?;
        match found {
            Ok(Ok(found)) => value(found),
            Ok(Err(name)) => same(self.text("special").as_str(), name),
            Err(_) => Ok(()),
        }
    }

    /// The same for a value; which of the numbers that are none it is, is not told.
    fn reads_value(&self, found: Result<Result<f64, &str>, Error>) -> Outcome {
        self.reads(found, |value| {
            let expected = self.float();
            let nans = expected.is_nan() && value.is_nan();
            same(true, nans || expected.to_bits() == value.to_bits())
        })
    }

    /// The same for a count.
    fn reads_count(&self, found: Result<Result<i128, &str>, Error>) -> Outcome {
        self.reads(found, |count| same(self.number("count"), Some(count)))
    }

    /// That every field was held against something, but for those that are for people alone.
    fn complete(&self, shape: &Shape) -> Outcome {
        for (place, (key, note)) in shape.keys.iter().enumerate() {
            let used = *note || self.used.get() & 1 << place != 0 || self.fields[place].1 == "-";
            same(true, used).map_err(|_| format!("nothing reads {key}"))?;
        }
        Ok(())
    }
}

/// Whether the ends are in order, and whether a number is beyond them, or is one that was rounded to it.
fn ends<T: PartialOrd + Copy>(given: T, low: T, high: T) -> (bool, bool) {
    (low <= high, given <= low || given >= high)
}

/// A text with its escapes undone; a percent sign alone is an empty one.
fn unescaped(field: &str) -> String {
    let mut parts = field.split('%');
    let mut found = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts.filter(|part| part.len() >= 2) {
        found.extend(bytes(&part[..2]));
        found.extend(part[2..].bytes());
    }
    String::from_utf8_lossy(&found).into_owned()
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
    /// The number in a type that holds them all.
    fn to_number(self) -> i128;
}

macro_rules! number {
    ($($type:ty)+) => {
        $(impl Number for $type {
            fn from_number(number: i128) -> Option<Self> {
                Self::try_from(number).ok()
            }

            fn to_number(self) -> i128 {
                i128::from(self)
            }
        })+
    };
}

number!(u8 u16 u32 u64 i8 i16 i32 i64);

impl Number for i128 {
    fn from_number(number: i128) -> Option<Self> {
        Some(number)
    }

    fn to_number(self) -> i128 {
        self
    }
}

impl Number for bool {
    fn from_number(number: i128) -> Option<Self> {
        [false, true].get(usize::try_from(number).ok()?).copied()
    }

    fn to_number(self) -> i128 {
        i128::from(self)
    }
}

/// What a point means: a value, or one beside special codes.
pub trait Meaning<T>: Sized {
    /// What means the value.
    fn of(value: T) -> Self;
    /// The value, or the name of the special code.
    fn read(self) -> Result<T, &'static str>;
}

macro_rules! meaning {
    ($($type:ty)+) => {
        $(impl Meaning<Self> for $type {
            fn of(value: Self) -> Self {
                value
            }

            fn read(self) -> Result<Self, &'static str> {
                Ok(self)
            }
        })+
    };
}

meaning!(f64 u8 u16 u32 u64 i8 i16 i32 i64 i128 bool);

impl<T, R: Copy> Meaning<T> for Reading<T, R> {
    fn of(value: T) -> Self {
        Self::Value(value)
    }

    fn read(self) -> Result<T, &'static str> {
        match self {
            Self::Value(value) => Ok(value),
            Self::Special(special) => Err(special.name()),
        }
    }
}

/// A count, or one beside special codes.
pub trait Counted: Sized {
    /// What means the count, if its type holds it.
    fn from_count(count: i128) -> Option<Self>;
    /// The count, or the name of the special code.
    fn read_count(self) -> Result<i128, &'static str>;
}

impl<T: Number> Counted for T {
    fn from_count(count: i128) -> Option<Self> {
        T::from_number(count)
    }

    fn read_count(self) -> Result<i128, &'static str> {
        Ok(self.to_number())
    }
}

impl<T: Number, R: Copy> Counted for Reading<T, R> {
    fn from_count(count: i128) -> Option<Self> {
        T::from_number(count).map(Self::Value)
    }

    fn read_count(self) -> Result<i128, &'static str> {
        self.read().map(Number::to_number)
    }
}

/// A value that has a raw number, beside special codes.
pub trait OfRaw<R> {
    /// The value of the raw number.
    fn of_raw(raw: R) -> Self;
}

impl<V: From<R>, R> OfRaw<R> for Reading<V, R> {
    fn of_raw(raw: R) -> Self {
        Self::Value(V::from(raw))
    }
}

/// A raw number to a value.
pub fn decode<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: Readable<Raw: Number, Value: Meaning<f64>>,
{
    let found = P::decode_with(vector.raw("raw"), with).into_result();
    vector.reads_value(found.map(Meaning::read))?;
    let needs = vector.needs::<P::Factors>(P::INFO.needs().any());
    decoded(vector, P::INFO.any(), needs)
}

/// The same by the point's data.
fn decoded(vector: &Vector, point: PointInfo, needs: Option<Vec<i128>>) -> Outcome {
    let Some(needs) = needs else {
        return Ok(());
    };
    let found = point.decode(vector.raw("raw"), &needs);
    vector.reads_value(found.map(|value| match value {
        AnyValue::Number(number) => Ok(number),
        AnyValue::Name(name) => Err(name),
        AnyValue::Integer(_) => Ok(f64::NAN),
    }))
}

/// A value to a raw number.
pub fn encode<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: Encodable<Raw: Number, Value: Meaning<f64>>,
{
    let found = P::encode_with(P::Value::of(vector.float()), with);
    vector.expect(found, "raw", !P::IS_CONTIGUOUS)?;
    let needs = vector.needs::<P::With>(P::INFO.write_needs().any());
    let value = vector.float();
    encoded(vector, P::INFO.any(), needs, value, !P::IS_CONTIGUOUS)
}

/// The same by the point's data.
fn encoded<'a>(
    vector: &Vector,
    point: PointInfo,
    needs: Option<Vec<i128>>,
    value: impl Into<AnyValue<'a>>,
    gaps: bool,
) -> Outcome {
    let found = needs.map(|needs| point.encode(value, &needs));
    found.map_or(Ok(()), |found| vector.expect(found, "raw", gaps))
}

/// A raw number to a count.
pub fn decode_count<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: CountReadable<Raw: Number, Count: Counted>,
{
    let found = P::decode_count_with(vector.raw("raw"), with).into_result();
    vector.reads_count(found.map(Counted::read_count))
}

/// A raw number to a count, which is itself, and to the value that has that number.
pub fn decode_plain<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: CountReadable<Raw: Number, Count: Counted, Value: From<P::Raw> + PartialEq>,
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
    P: CountWritable<Raw: Number, Count: Counted>,
{
    let Some(count) = vector.number("count").and_then(P::Count::from_count) else {
        return same(vector.text("status").as_str(), "out_of_range");
    };
    let found = P::encode_count_with(count, with);
    vector.expect(found, "raw", !P::IS_CONTIGUOUS)
}

/// A count to a raw number, and the value that has that number.
pub fn encode_plain<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: CountWritable<Raw: Number, Count: Counted> + Encodable<Value: From<P::Raw>>,
{
    if let Some(raw) = vector.number("count").and_then(P::Raw::from_number) {
        let found = P::encode_with(P::Value::from(raw), with);
        vector.expect(found, "raw", !P::IS_CONTIGUOUS)?;
        let needs = vector.needs::<P::With>(P::INFO.write_needs().any());
        let raw = raw.to_number();
        encoded(vector, P::INFO.any(), needs, raw, !P::IS_CONTIGUOUS)?;
    }
    encode_count::<P>(vector, with)
}

/// As `decode_plain`, for a point that has special codes.
pub fn decode_coded<P>(vector: &Vector, with: P::Factors) -> Outcome
where
    P: CountReadable<Raw: Number, Count: Counted, Value: OfRaw<P::Raw> + PartialEq> + Coded,
{
    let raw = vector.raw("raw");
    if let Ok(value) = P::decode_with(raw, with).into_result() {
        let same_value = value == P::Value::of_raw(raw);
        same(P::special(raw).is_none(), same_value)?;
    }
    decode_count::<P>(vector, with)
}

/// As `encode_plain`, for a point that has special codes.
pub fn encode_coded<P>(vector: &Vector, with: P::With) -> Outcome
where
    P: CountWritable<Raw: Number, Count: Counted> + Encodable<Value: OfRaw<P::Raw>>,
{
    if let Some(raw) = vector.number("count").and_then(P::Raw::from_number) {
        let found = P::encode_with(P::Value::of_raw(raw), with);
        vector.expect(found, "raw", !P::IS_CONTIGUOUS)?;
    }
    encode_count::<P>(vector, with)
}

/// Whether a raw number may be written.
pub fn check<P: Writable<Raw: Number>>(vector: &Vector, with: P::With) -> Outcome {
    let typed = P::check_with(vector.raw("raw"), with);
    let needs = vector.needs::<P::With>(P::INFO.write_needs().any());
    checked(vector, typed, P::INFO.any(), needs, !P::IS_CONTIGUOUS)
}

/// The same of the point's function and of its data.
fn checked(
    vector: &Vector,
    typed: Result<(), Error>,
    point: PointInfo,
    needs: Option<Vec<i128>>,
    gaps: bool,
) -> Outcome {
    let listed = needs.map(|needs| point.check(vector.raw("raw"), &needs));
    for found in [Some(typed), listed].into_iter().flatten() {
        vector.refuses(found.err(), gaps)?;
        same(
            vector.text("status").as_str(),
            found.map_or_else(Error::name, |()| "ok"),
        )?;
    }
    Ok(())
}

/// The value of the vector's raw number as data; none where it needs other points.
#[must_use]
pub fn data_of(vector: &Vector, point: PointInfo) -> Option<AnyValue<'static>> {
    point.decode(vector.number("raw")?, &[]).ok()
}

/// The same, for a value that is written and needs no other points.
#[must_use]
pub fn written_data_of(vector: &Vector, point: PointInfo) -> Option<AnyValue<'static>> {
    let value = data_of(vector, point)?;
    let raw = point.encode(value, &[]).ok();
    (raw == vector.number("raw")).then_some(value)
}

/// The name of a number.
pub fn name(vector: &Vector, found: Option<&str>, same_number: bool) -> Outcome {
    same(vector.said("name").as_deref(), found)?;
    same(true, same_number)
}

/// The ends of a special code.
pub fn special<P>(vector: &Vector) -> Outcome
where
    P: Coded<Raw: Number + PartialEq + std::fmt::Debug>,
{
    let name = vector.text("special");
    let code = P::CODES.iter().find(|code| code.name() == name);
    let ends = (vector.raw("low"), vector.raw("high"));
    same(Some(ends), code.map(Code::ends))
}

/// The special code that a raw number is.
pub fn special_name<P: Coded<Raw: Number>>(vector: &Vector) -> Outcome {
    let code = P::special(vector.raw("raw"));
    let name = code.map(|code| code.name());
    same(vector.said("name").as_deref(), name)?;
    let no_value = code.map(|code| i128::from(code.is_no_value()));
    same(vector.number("no_value"), no_value)
}

/// Where the words of a point are that is documented only.
pub fn documented(vector: &Vector, found: &Documented) -> Outcome {
    same(vector.text("space").as_str(), found.space.name())?;
    same(vector.raw("address"), found.address)?;
    same(vector.raw("words"), found.words)?;
    same(vector.number("index"), found.index.map(i128::from))
}

/// What identifies the device or a variant, an alternative at a time.
pub fn identification<D>(vector: &Vector, rows: &[Identification<D>]) -> Option<Outcome> {
    let axis = vector.pairs("variant");
    let is_row = |row: &&Identification<D>| {
        let (axis_of_row, value) = row.variant.unzip();
        let held = match row.holds {
            Held::Raw(raw) => vector.number("raw") == Some(raw),
            Held::Text(text, _) => vector.said("text").as_deref() == Some(text),
        };
        let variant = axis
            .first()
            .map(|(axis, value)| (axis.as_str(), value.as_str()));
        let point = row.point.name;
        let named = vector.text("name").contains(point); // the name of a macro of C
        named && held && variant.unzip() == (axis_of_row, value) && point == vector.text("of")
    };
    Some(same(rows.iter().filter(is_row).count(), 1))
}

/// A number of the protocol by its name, and its name where a function tells it.
pub fn code(vector: &Vector, number: u64, name: Option<&str>) -> Outcome {
    same(vector.raw::<u64>("number"), number)?;
    same(vector.said("name").as_deref(), name)
}

/// A flag of a word: what it is called and which bits it has, what getting it says of this word, and what setting it to
/// that and to the opposite makes of the word.
pub fn flag<F>(vector: &Vector, word: F, found: u64, set: [F; 2]) -> Outcome
where
    F: Flags + Default + std::fmt::Debug,
{
    let name = vector.text("flag");
    let flag = F::FLAGS.iter().find(|flag| flag.name() == name);
    let flag = flag.ok_or_else(|| "it is not in the table".to_owned())?;
    let number = vector.raw::<u64>("number");
    let truth = vector.number("truth").map(|truth| u64::from(truth == 1));
    same(truth.unwrap_or(number), found)?;
    same(found, flag.number(word.bits()))?;
    same(
        truth.is_some_and(|truth| truth != number),
        flag.is_active_low(),
    )?;
    let mask = flag.mask();
    same(number, (word.bits() & mask) >> mask.trailing_zeros())?;
    same(set.map(F::bits), [word.bits(), word.bits() ^ mask])?;
    let named = F::FLAGS.iter().fold(0, |named, flag| named | flag.mask());
    let nothing = F::default().bits();
    same((0, 0), (flag.number(nothing), nothing & !named))?;
    same(
        true,
        format!("{word:?}").starts_with(&format!("{}(0x", F::NAME)),
    )
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
    let words: Vec<u16> = vector.numbers("words");
    same(words.as_slice(), words_of::<P>(raw).as_slice())?;
    let mut all = raw.into_words();
    if P::LOW_BYTE_FIRST {
        for word in all.as_mut() {
            *word = word.swap_bytes();
        }
    }
    let above = all.as_ref().len() - words.len();
    if !P::CODED {
        in_order(&words, P::ADDRESSES, &all.as_ref()[above..])?;
    }
    let more = [words.as_slice(), &[0]].concat();
    let received = |words: &[u16]| P::from_received(words.iter().copied());
    same(Ok(raw), received(&words))?;
    let wrong = Err(Error::WrongLength(Some(P::NAME)));
    same(wrong, received(&words[1..]))?;
    same(wrong, received(&more))
}

/// The words of a raw number that count.
pub fn words_of<P: Whole>(raw: P::Raw) -> Vec<u16> {
    let words = P::to_words(raw);
    let count = if P::WIDTH == 0 {
        words.as_ref().len()
    } else {
        usize::from(P::WORDS)
    };
    words.as_ref()[..count].to_vec()
}

/// The words by address are those in reading order.
fn in_order(words: &[u16], addresses: &[u16], read: &[u16]) -> Outcome {
    if addresses.len() == 1 {
        return Ok(());
    }
    let mut parts: Vec<_> = addresses.iter().zip(read).collect();
    parts.sort();
    let found: Vec<u16> = parts.into_iter().map(|(_, word)| *word).collect();
    same(words, found.as_slice())
}

/// Where a point is, and what stands beside it: the manual's code and other numberings, the outer limits, decimals.
pub fn address<P>(vector: &Vector, references: References) -> Outcome
where
    P: Point<Raw: Number + PartialEq + std::fmt::Debug>,
{
    reaches(vector, P::RAW_MIN.to_number(), P::RAW_MAX.to_number())?;
    if P::SPAN == P::WORDS {
        ascending(P::ADDRESS, P::ADDRESSES, P::WORDS, P::SPACE)?;
    }
    place_of::<P>(vector, references)
}

fn reaches(vector: &Vector, least: i128, most: i128) -> Outcome {
    let Some(known) = vector.number("raw_min") else {
        return Ok(());
    };
    same(known, least)?;
    same(vector.number("raw_max"), Some(most))
}

/// The addresses of several words follow each other from the lowest one on, but for a parameter that has one for all.
fn ascending(lowest: u16, addresses: &[u16], words: u16, space: Space) -> Outcome {
    let mut found = addresses.to_vec();
    found.sort_unstable();
    let is_one_for_all = space == Space::Parameter && addresses.len() == 1;
    let words = if is_one_for_all { 1 } else { words };
    same(found, (lowest..).take(words.into()).collect())
}

/// What came out, and that the table of all points has the point, once and there.
pub fn listed<D>(vector: &Vector, points: Points<D>, outcome: Option<Outcome>) -> Option<Outcome> {
    outcome.map(|found| found.and_then(|()| is_listed(vector, points)))
}

fn is_listed<D>(vector: &Vector, points: Points<D>) -> Outcome {
    let name = vector.text("point");
    let named = points.iter().filter(|point| point.name == name);
    same(1, named.count())?;
    let found = points
        .find(&name)
        .map(|point| (point.space.name(), point.address));
    let space = vector.text("space");
    same(Some((space.as_str(), vector.raw("address"))), found)
}

/// The same but for the limits, which a text has not.
pub fn place_of<P: Point>(vector: &Vector, references: References) -> Outcome {
    let names = [Some(P::SPACE.name()), Some(P::NAME), P::CODE];
    placed(
        vector,
        (P::ADDRESS, P::WORDS, P::DECIMALS),
        names,
        references,
    )
}

fn placed(
    vector: &Vector,
    (address, words, found): (u16, u16, u32),
    names: [Option<&str>; 3],
    references: References,
) -> Outcome {
    same(vector.raw("address"), address)?;
    same(vector.raw("words"), words)?;
    let expected = [vector.text("space"), vector.text("point")].map(Some);
    let [space, point] = expected;
    let expected = [space, point, vector.said("code")];
    same(expected, names.map(|name| name.map(str::to_owned)))?;
    let decimals = vector.number("decimals").unwrap_or_default();
    same(decimals, i128::from(found))?;
    let references = references
        .iter()
        .map(|(key, text)| ((*key).to_owned(), text.to_string()));
    same(vector.pairs("references"), references.collect())
}

/// What says where a point is beside its lowest address.
pub fn place<P: Point>(vector: &Vector) -> Outcome {
    let addresses: Vec<u16> = vector.numbers("addresses");
    same(addresses.as_slice(), P::ADDRESSES)?;
    same(vector.number("index"), P::INDEX.map(i128::from))?;
    same(vector.said("telegram").as_deref(), P::TELEGRAM)
}

/// Where a point is written, if that is not where it is read.
pub fn write_address<P: Point>(vector: &Vector) -> Outcome {
    same(vector.raw("address"), P::WRITE_ADDRESS)
}

/// The symbol of a point's unit.
pub fn symbol<P: Point>(vector: &Vector) -> Outcome {
    same(vector.text("symbol").as_str(), P::UNIT)
}

/// With how many decimals people see values.
pub fn display<P: Point>(vector: &Vector) -> Outcome {
    same(
        vector.number("decimals"),
        P::DISPLAY_DECIMALS.map(i128::from),
    )?;
    same(P::INFO.display_decimals, P::DISPLAY_DECIMALS)
}

/// What people see of a raw number.
pub fn told<P: Displayed<Raw: Number>>(vector: &Vector, needs: P::Needs) -> Outcome {
    let (status, text) = match P::told_with(vector.raw("raw"), needs) {
        Ok(shown) => ("ok", Some(shown.to_string())),
        Err(error) => (error.name(), None),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.said("text"), text)
}

/// The bits of a word that are always written as a constant.
pub fn fixed<P: Point>(vector: &Vector) -> Outcome {
    same(vector.raw("mask"), P::FIXED_MASK)?;
    same(vector.raw("bits"), P::FIXED_BITS)
}

/// From when a time counts.
pub fn epoch<P: Point>(vector: &Vector) -> Outcome {
    same(vector.number("seconds"), P::EPOCH.map(i128::from))
}

/// Words to a text.
pub fn text_decode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw = [u16; W], Value = Text<N>, Factors = ()>,
{
    let words: Vec<u16> = vector.numbers("words");
    let mut raw = [0; W];
    raw.copy_from_slice(&words);
    let text = P::decode(raw).into_result().map_err(Error::name)?;
    same(vector.bytes("text").as_slice(), text.as_bytes())?;
    same(text.as_bytes().len(), text.to_string().chars().count())
}

/// A text to words.
pub fn text_encode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw = [u16; W], Value = Text<N>, With = ()> + Whole,
{
    let bytes = vector.bytes("text");
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
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("words"), words)
}

/// Words to a text of Unicode.
pub fn unicode_decode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw = [u16; W], Value = Utf8<N>, Factors = ()>,
{
    let mut raw = [0; W];
    raw.copy_from_slice(&vector.numbers::<u16>("words"));
    let (status, text) = match P::decode(raw).into_result() {
        Ok(text) => ("ok", text.as_str().as_bytes().to_vec()),
        Err(error) => (error.name(), Vec::new()),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.bytes("text"), text)
}

/// A text of Unicode to words.
pub fn unicode_encode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw = [u16; W], Value = Utf8<N>, With = ()> + Whole,
{
    let text = String::from_utf8(vector.bytes("text")).map_err(|_| "no UTF-8")?;
    let (status, words) = match Utf8::new(&text).and_then(P::encode) {
        Ok(raw) => ("ok", raw.into_words().to_vec()),
        Err(error) => (error.name(), Vec::new()),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("words"), words)
}

/// The numbers of a date and time, in the order of the vectors.
fn date_numbers(date: DateTime) -> Vec<u16> {
    let numbers = [date.month, date.day, date.hour, date.minute, date.second].map(u16::from);
    [&[date.year], numbers.as_slice(), &[date.millisecond]].concat()
}

/// Words to a date and time.
pub fn date_decode<P, const W: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw = [u16; W], Value = DateTime, Factors = ()>,
{
    let mut raw = [0; W];
    raw.copy_from_slice(&vector.numbers::<u16>("words"));
    let (status, numbers) = match P::decode(raw).into_result() {
        Ok(date) => ("ok", date_numbers(date)),
        Err(error) => (error.name(), Vec::new()),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("numbers"), numbers)
}

/// A date and time to words.
pub fn date_encode<P, const W: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw = [u16; W], Value = DateTime, With = ()> + Whole,
{
    let numbers = vector.numbers::<u16>("numbers");
    let short = |place: usize| u8::try_from(numbers[place]).unwrap_or(u8::MAX);
    let date = DateTime {
        year: numbers[0],
        month: short(1),
        day: short(2),
        hour: short(3),
        minute: short(4),
        second: short(5),
        millisecond: numbers[6],
    };
    let (status, words) = match P::encode(date) {
        Ok(raw) => ("ok", raw.into_words().to_vec()),
        Err(error) => (error.name(), Vec::new()),
    };
    same(vector.text("status").as_str(), status)?;
    same(vector.numbers("words"), words)
}

/// Words to bytes.
pub fn bytes_decode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw = [u16; W], Value = [u8; N], Factors = ()>,
{
    let mut raw = [0; W];
    raw.copy_from_slice(&vector.numbers::<u16>("words"));
    same(
        Ok(vector.bytes("bytes")),
        P::decode(raw).into_result().map(Vec::from),
    )
}

/// Bytes to words.
pub fn bytes_encode<P, const N: usize, const W: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw = [u16; W], Value = [u8; N], With = ()> + Whole,
{
    let bytes = vector
        .bytes("bytes")
        .try_into()
        .map_err(|_| "other bytes")?;
    same(Ok(vector.numbers("words")), P::encode(bytes).map(Vec::from))
}

/// A number to its digits.
pub fn digits<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw: Number, Value = [E; N], Factors = ()>,
    C: From<E> + Into<i128>,
{
    let found = P::decode(vector.raw("raw")).into_result();
    vector.reads(found.map(Ok), |digits| {
        let numbers: Vec<i128> = digits.map(|digit| C::from(digit).into()).to_vec();
        same(vector.numbers("digits"), numbers)
    })
}

/// As `digits`, for a point that has special codes.
pub fn digits_coded<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Readable<Raw: Number, Value = Reading<[E; N], <P as Point>::Raw>, Factors = ()>,
    C: From<E> + Into<i128>,
{
    let found = P::decode(vector.raw("raw")).into_result();
    vector.reads(found.map(Meaning::read), |digits| {
        let numbers: Vec<i128> = digits.map(|digit| C::from(digit).into()).to_vec();
        same(vector.numbers("digits"), numbers)
    })
}

/// Digits to a number.
pub fn digits_encode<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw: Number, Value = [E; N], With = ()>,
    E: From<C> + Copy,
    C: Number,
{
    let numbers: Vec<C> = vector.numbers("digits");
    let digits: Vec<E> = numbers.into_iter().map(E::from).collect();
    let digits = <[E; N]>::try_from(digits).map_err(|_| "there are other digits".to_owned())?;
    vector.expect(P::encode(digits), "raw", true)
}

/// As `digits_encode`, for a point that has special codes.
pub fn digits_encode_coded<P, E, C, const N: usize>(vector: &Vector) -> Outcome
where
    P: Encodable<Raw: Number, Value = Reading<[E; N], <P as Point>::Raw>, With = ()>,
    E: From<C> + Copy,
    C: Number,
{
    let numbers: Vec<C> = vector.numbers("digits");
    let digits: Vec<E> = numbers.into_iter().map(E::from).collect();
    let digits = <[E; N]>::try_from(digits).map_err(|_| "there are other digits".to_owned())?;
    vector.expect(P::encode(Reading::Value(digits)), "raw", true)
}

/// A transport that expects what the script of a vector says is sent, and answers as it says.
pub struct Script {
    /// The bytes of the transaction, which is the same in all steps.
    head: usize,
    /// Whether all came in the order of the script so far.
    in_order: bool,
    steps: Vec<(Vec<u8>, Vec<u8>)>,
    fault: Option<String>,
}

impl Script {
    /// The script of a vector; what other points are asked for is not asked here.
    pub fn new(vector: &Vector) -> Self {
        let _ = vector.field("needs");
        let steps = vector.pairs("script").into_iter();
        let steps = steps.map(|(sent, received)| (bytes(&sent), bytes(&received)));
        let is_tcp = vector.said("framing").as_deref() == Some("tcp");
        Self {
            head: if is_tcp { 2 } else { 0 },
            in_order: true,
            steps: steps.collect(),
            fault: None,
        }
    }

    /// What answers a request; nothing if it should not be sent.
    pub fn answer(&mut self, request: &[u8]) -> Option<Vec<u8>> {
        let body = |frame: &[u8]| frame.get(self.head..).map(<[u8]>::to_vec);
        let place = self
            .steps
            .iter()
            .position(|(sent, _)| body(sent) == body(request));
        if place.is_none() {
            self.fault = Some(format!("sent {}", hex(request)));
        }
        self.in_order &= place == Some(0);
        let (sent, mut answer) = self.steps.remove(place?);
        let own = sent.iter().zip(request).take(self.head);
        for (byte, (one, other)) in answer.iter_mut().zip(own) {
            *byte ^= one ^ other;
        }
        Some(answer)
    }

    /// That nothing was sent that should not be.
    pub fn keeps_to_it(&self) -> Outcome {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// That all was sent that should be, in this order, and nothing else.
    pub fn done(&self) -> Outcome {
        if !self.in_order {
            return Err("it was sent in another order".to_owned());
        }
        let left = self.steps.first();
        let left = left.map(|(sent, _)| format!("{} was not sent", hex(sent)));
        self.fault.clone().or(left).map_or(Ok(()), Err)
    }

    fn exchanged(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, ()> {
        let answer = self.answer(request).ok_or(())?;
        let place = reply.get_mut(..answer.len()).ok_or(())?;
        place.copy_from_slice(&answer);
        Ok(answer.len())
    }
}

impl AsRef<Self> for Script {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl fieldscribe_runtime::client::Transport for Script {
    type Error = ();

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, ()> {
        self.exchanged(request, reply)
    }
}

impl fieldscribe_runtime::client::AsyncTransport for Script {
    type Error = ();

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, ()> {
        self.exchanged(request, reply)
    }
}

struct Idle;

impl Wake for Idle {
    fn wake(self: Arc<Self>) {}
}

/// The result of a future that never really waits.
pub fn now<F: Future>(future: F) -> F::Output {
    polled(pin!(future))
}

/// The same, once for all futures of a result.
fn polled<T>(future: Pin<&mut dyn Future<Output = T>>) -> T {
    let waker = Waker::from(Arc::new(Idle));
    match future.poll(&mut Context::from_waker(&waker)) {
        Poll::Ready(result) => result,
        Poll::Pending => panic!("it waits for something else than its transport"),
    }
}

/// Runs all vectors of the file and reports one line per kind.
pub fn main(
    default: &str,
    device: [&str; 3],
    [major, minor, patch, number]: [u32; 4],
    run: impl Fn(&str, &Vector) -> Option<Outcome>,
    check: impl Fn(),
) -> ExitCode {
    let vectors = std::env::var("FIELDSCRIBE_VECTORS").unwrap_or_else(|_| default.to_owned());
    let text = match std::fs::read_to_string(&vectors) {
        Ok(text) => text,
        Err(error) => {
            let [name, ..] = device;
            eprintln!("cannot read the vectors {vectors}: {error}");
            eprintln!("set FIELDSCRIBE_VECTORS to the absolute path of {name}.txt, which");
            eprintln!(
                "`fieldscribe generate {name} --target vectors` writes into generated/vectors"
            );
            return ExitCode::FAILURE;
        }
    };
    let (mut kinds, mut sets): (Vec<Shape>, Vec<Shape>) = (Vec::new(), Vec::new());
    let mut held: Vec<Vec<(&str, &str)>> = Vec::new();
    for line in text.lines() {
        let parts: Vec<&str> = line.split('\t').collect();
        match parts[0] {
            "vectors" => {
                assert_eq!(parts[1], "2", "{vectors} is of another format");
                assert_eq!(parts[2..], device, "{vectors} is of another description");
                assert_eq!(parts[3], format!("{major}.{minor}.{patch}"));
                assert_eq!(number, (major * 1000 + minor) * 1000 + patch);
            }
            "set" => sets.push(Shape::new(&parts[1..], false)),
            "kind" => kinds.push(Shape::new(&parts[1..], true)),
            name => {
                if let Some(place) = sets.iter().position(|set| set.name == name) {
                    held.resize(place, Vec::new());
                    held.push(fields(&sets[place], &parts[1..]));
                } else {
                    let kind = kinds.iter_mut().find(|kind| kind.name == name);
                    let kind = kind.unwrap_or_else(|| panic!("{vectors}: {line}: what is {name}?"));
                    if kind.elsewhere {
                        continue;
                    }
                    tally(kind, line, &parts[1..], held.concat(), &run);
                }
            }
        }
    }
    let result = report(&kinds);
    runtime::check();
    client_errors::check();
    check();
    result
}

/// The fields of a line by their names; those that are left out are absent.
fn fields<'a>(shape: &Shape<'a>, parts: &[&'a str]) -> Vec<(&'a str, &'a str)> {
    assert!(parts.len() <= shape.keys.len(), "{}: {parts:?}", shape.name);
    let parts = parts.iter().copied().chain(std::iter::repeat("-"));
    shape.keys.iter().map(|(key, _)| *key).zip(parts).collect()
}

/// Runs one vector and counts it.
fn tally<'a>(
    kind: &mut Shape<'a>,
    line: &'a str,
    parts: &[&'a str],
    shared: Vec<(&'a str, &'a str)>,
    run: &impl Fn(&str, &Vector) -> Option<Outcome>,
) {
    let vector = Vector {
        line,
        kind: kind.name,
        fields: fields(kind, parts),
        shared,
        used: Cell::new(0),
    };
    let outcome =
        run(kind.name, &vector).unwrap_or_else(|| Err("nothing runs this vector".to_owned()));
    match outcome.and_then(|()| vector.complete(kind)) {
        Ok(()) => kind.passed += 1,
        Err(difference) => {
            kind.failed += 1;
            eprintln!("{:?} {line}: {difference}", vector.shared);
        }
    }
}

fn report(kinds: &[Shape]) -> ExitCode {
    let mut total = [0, 0];
    let mut complete = true;
    for kind in kinds.iter().filter(|kind| !kind.elsewhere) {
        complete &= kind.announced == kind.passed + kind.failed;
        println!(
            "{} {} passed, {} failed",
            kind.name, kind.passed, kind.failed
        );
        total = [total[0] + kind.passed, total[1] + kind.failed];
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
