// SPDX-License-Identifier: 0BSD
//! Dates and times in parts: each part is a number in some bits of the words of a point.

use core::fmt;

/// A date, a time, or both, as a device keeps it: without a zone.
///
/// A field for which a point has no part is 0 when the point is read, and ignored when it is written.
///
/// ```
/// use fieldscribe_runtime::DateTime;
///
/// let start = DateTime { hour: 6, minute: 30, ..DateTime::default() };
/// assert_eq!(start.to_string(), "06:30:00");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DateTime {
    /// The year with all its digits.
    pub year: u16,
    /// The month, from 1 on.
    pub month: u8,
    /// The day of the month, from 1 on.
    pub day: u8,
    /// The hour, from 0 to 23.
    pub hour: u8,
    /// The minute.
    pub minute: u8,
    /// The second.
    pub second: u8,
    /// The millisecond of the second.
    pub millisecond: u16,
}

impl DateTime {
    /// True if the date exists.
    #[must_use]
    pub const fn is_date(self) -> bool {
        let days = match (self.month, self.is_leap()) {
            (2, true) => 29,
            (2, false) => 28,
            (month, _) => 30 + ((month ^ (month >> 3)) & 1),
        };
        let is_day = matches!(self.month, 1..=12) && self.day >= 1 && self.day <= days;
        matches!(self.year, 1..=9999) && is_day
    }

    /// True if the time exists.
    #[must_use]
    pub const fn is_time(self) -> bool {
        self.hour < 24 && self.minute < 60 && self.second < 60 && self.millisecond < 1000
    }

    const fn is_leap(self) -> bool {
        self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0)
    }

    /// The number of the weekday of a date, Sunday's being `sunday`; days count from 0000-03-01, a Wednesday.
    fn weekday(self, sunday: u16) -> u16 {
        let year = u32::from(self.year).saturating_sub(u32::from(self.month < 3));
        let month = u32::from(self.month).wrapping_add(9) % 12;
        let leaps = (year / 4).wrapping_sub(year / 100).wrapping_add(year / 400);
        let months = month.wrapping_mul(153).wrapping_add(2) / 5;
        let days = [leaps, months, u32::from(self.day)].into_iter();
        let days = days.fold(year.wrapping_mul(365), u32::wrapping_add);
        let (from, first) = if sunday < 6 {
            (2, sunday)
        } else {
            (1, sunday - 6)
        };
        let number = days.wrapping_add(from) % 7;
        u16::try_from(number)
            .unwrap_or_default()
            .wrapping_add(first)
    }
}

impl fmt::Display for DateTime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_dated = self.day != 0;
        if is_dated {
            write!(
                formatter,
                "{:04}-{:02}-{:02}",
                self.year, self.month, self.day
            )?;
            formatter.write_str("T")?;
        }
        write!(
            formatter,
            "{:02}:{:02}:{:02}",
            self.hour, self.minute, self.second
        )?;
        match self.millisecond {
            0 => Ok(()),
            milliseconds => write!(formatter, ".{milliseconds:03}"),
        }
    }
}

/// The kind of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DateField {
    /// The year.
    Year,
    /// The month.
    Month,
    /// The day of the month.
    Day,
    /// The weekday; ignored when it is read.
    Weekday,
    /// The hour.
    Hour,
    /// The minute.
    Minute,
    /// The second.
    Second,
    /// The millisecond; of the minute, if there is no second.
    Millisecond,
}

/// A part: its kind, its word, its lowest bit there, a mask of its number, and the year of the number 0, or the number
/// of Sunday.
#[derive(Clone, Copy, Debug)]
pub struct DatePart(pub DateField, pub usize, pub u32, pub u16, pub u16);

/// The parts of a point.
#[derive(Clone, Copy, Debug)]
pub struct DateForm {
    parts: &'static [DatePart],
    is_bcd: bool,
    low_first: bool,
}

impl DateForm {
    /// Returns these parts: in decimal digits of four bits each if `is_bcd`, with the bytes of each word swapped if
    /// `low_first`.
    #[must_use]
    pub const fn new(is_bcd: bool, low_first: bool, parts: &'static [DatePart]) -> Self {
        Self {
            parts,
            is_bcd,
            low_first,
        }
    }

    /// The date and time in the words; none if they hold no valid one.
    #[must_use]
    pub fn decoded(&self, words: &[u16]) -> Option<DateTime> {
        let mut found = DateTime::default();
        for DatePart(field, word, low, mask, base) in self.parts.iter().copied() {
            let word = self.ordered(*words.get(word)?);
            let bits = word.checked_shr(low)? & mask;
            if field == DateField::Weekday {
                continue;
            }
            let number = if self.is_bcd { decimal(bits)? } else { bits };
            let number = number.checked_add(base)?;
            match field {
                DateField::Year => found.year = number,
                DateField::Month => found.month = u8::try_from(number).ok()?,
                DateField::Day => found.day = u8::try_from(number).ok()?,
                DateField::Hour => found.hour = u8::try_from(number).ok()?,
                DateField::Minute => found.minute = u8::try_from(number).ok()?,
                DateField::Second => found.second = u8::try_from(number).ok()?,
                DateField::Millisecond => found.millisecond = number,
                DateField::Weekday => {}
            }
        }
        if !self.has(DateField::Second) {
            found.second = u8::try_from(found.millisecond / 1000).ok()?;
            found.millisecond %= 1000;
        }
        self.is_real(found).then_some(found)
    }

    /// Fills in the words of a date and time; none if it does not exist or a part has no room for its number.
    #[must_use]
    pub fn encoded(&self, value: DateTime, words: &mut [u16]) -> Option<()> {
        let value = self.written(value);
        if !self.is_real(value) {
            return None;
        }
        for DatePart(field, word, low, mask, base) in self.parts.iter().copied() {
            let number = match field {
                DateField::Year => value.year.checked_sub(base)?,
                DateField::Month => value.month.into(),
                DateField::Day => value.day.into(),
                DateField::Weekday => value.weekday(base),
                DateField::Hour => value.hour.into(),
                DateField::Minute => value.minute.into(),
                DateField::Second => value.second.into(),
                DateField::Millisecond if self.has(DateField::Second) => value.millisecond,
                DateField::Millisecond => u16::from(value.second)
                    .wrapping_mul(1000)
                    .wrapping_add(value.millisecond),
            };
            let bits = if self.is_bcd { digits(number)? } else { number };
            let place = words.get_mut(word)?;
            *place |= self.ordered((bits & mask).checked_shl(low)?);
            if bits & mask != bits {
                return None;
            }
        }
        Some(())
    }

    fn has(&self, field: DateField) -> bool {
        self.parts.iter().any(|part| part.0 == field)
    }

    /// The time without the fields that have no part; the second may be counted in the milliseconds.
    fn written(&self, mut value: DateTime) -> DateTime {
        if !self.has(DateField::Minute) {
            value.minute = 0;
        }
        if !self.has(DateField::Millisecond) {
            value.millisecond = 0;
            if !self.has(DateField::Second) {
                value.second = 0;
            }
        }
        value
    }

    fn is_real(&self, value: DateTime) -> bool {
        (value.is_date() || !self.has(DateField::Day))
            && (value.is_time() || !self.has(DateField::Hour))
    }

    const fn ordered(&self, word: u16) -> u16 {
        if self.low_first {
            word.swap_bytes()
        } else {
            word
        }
    }
}

/// The number of decimal digits of four bits each; none if one is no digit.
fn decimal(bits: u16) -> Option<u16> {
    let mut places = [12, 8, 4, 0].into_iter();
    places.try_fold(0_u16, |number, low| match bits.wrapping_shr(low) & 0xF {
        digit @ 0..=9 => Some(number.wrapping_mul(10).wrapping_add(digit)),
        _ => None,
    })
}

/// The digits of a number, four bits each; none of one that has more than four.
fn digits(number: u16) -> Option<u16> {
    let places = [(1000_u16, 12), (100, 8), (10, 4), (1, 0)].into_iter();
    (number < 10_000).then(|| {
        places.fold(0, |bits, (ten, low)| {
            bits | (number.checked_div(ten).unwrap_or_default() % 10).wrapping_shl(low)
        })
    })
}
