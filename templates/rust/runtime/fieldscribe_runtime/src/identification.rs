// SPDX-License-Identifier: 0BSD
//! What tells a device, and each of its variants, from others: what its points hold.

use core::fmt;

use crate::{AnyDevice, BuildError, Decoded, Error, PointInfo, Raw, Readable};

/// What a point holds in a device, or in one of its variants; several rows of one point and variant are alternatives.
#[derive(Clone, Copy, Debug)]
pub struct Identification<D = AnyDevice> {
    /// The point.
    pub point: PointInfo<D>,
    /// The axis and the value of the variant that it tells; `None` for the device.
    pub variant: Option<(&'static str, &'static str)>,
    /// What the point holds.
    pub holds: Held,
}

/// A raw number, or the text of a point that is a text.
#[derive(Clone, Copy, Debug)]
pub enum Held {
    /// A raw number.
    Raw(i128),
    /// A text, and the function that compares it with words.
    Text(&'static str, fn(&HeldWords, &str) -> Result<bool, Error>),
}

/// The words of a point in reading order, and words that do not count: as many as Modbus reads at once.
pub type HeldWords = [u16; 125];

/// Words before anything was read.
pub(crate) const NOTHING_HELD: HeldWords = [0; 125];

/// The first rows, which are alike, and the others.
pub(crate) fn divided<D>(
    rows: &[Identification<D>],
    is_alike: impl Fn(&Identification<D>) -> bool,
) -> (&[Identification<D>], &[Identification<D>]) {
    let count = rows.iter().take_while(|row| is_alike(row)).count();
    let (first, others) = (rows.get(..count), rows.get(count..));
    (first.unwrap_or_default(), others.unwrap_or_default())
}

/// Whether the words hold what one of the alternatives says; words that are no text do not.
pub(crate) fn holds<D>(rows: &[Identification<D>], words: &HeldWords) -> Result<bool, Error> {
    let [a, b, c, d, ..] = *words;
    for row in rows {
        let is_held = match row.holds {
            Held::Raw(raw) => row.point.raw_of([a, b, c, d]) == raw,
            Held::Text(text, is_text) => match is_text(words, text) {
                Err(Error::Malformed(_)) => false,
                compared => compared?,
            },
        };
        if is_held {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether the words of a point are a text.
///
/// # Errors
/// Those of decoding; [`Error::WrongLength`] of a text that is too long.
#[doc(hidden)]
pub fn is_text<P>(held: &HeldWords, text: &str) -> Result<bool, Error>
where
    P: Readable<Factors = (), Value: PartialEq + for<'t> TryFrom<&'t str>>,
{
    let mut words = P::Raw::MIN.into_words();
    if words.as_ref().len() > held.len() {
        return Err(Error::WrongLength(Some(P::NAME)));
    }
    for (word, held) in words.as_mut().iter_mut().zip(held) {
        *word = *held;
    }
    let value = P::decode(P::Raw::from_words(words)).into_result()?;
    Ok(P::Value::try_from(text).is_ok_and(|text| text == value))
}

/// The variant that a device was found to be: of each axis the value that fits what it holds, if one does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variants([Option<(&'static str, &'static str)>; 8]);

impl Variants {
    /// The value of an axis; none if the device holds what none of them says.
    #[must_use]
    pub fn value(&self, axis: &str) -> Option<&'static str> {
        let mut found = self.iter().filter(|(name, _)| *name == axis);
        found.next().map(|(_, value)| value)
    }

    /// The axes and their values.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &'static str)> + '_ {
        self.0.iter().copied().flatten()
    }

    /// Adds a variant.
    pub(crate) fn add(&mut self, variant: (&'static str, &'static str)) -> Result<(), BuildError> {
        let place = self.0.iter_mut().find(|place| place.is_none());
        *place.ok_or(BuildError::BufferTooSmall)? = Some(variant);
        Ok(())
    }
}

/// What answers is another device: the point of that name holds something else, or cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OtherDevice(pub &'static str);

impl fmt::Display for OtherDevice {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "it is another device by its {}", self.0)
    }
}

impl core::error::Error for OtherDevice {}

/// The rows of [`Identification`] in the order of reading, of the points of a module.
#[macro_export]
#[doc(hidden)]
macro_rules! identifications {
    ($points:ident: $($point:ident $(of $axis:literal $value:literal)? holds $kind:ident $held:literal;)*) => {
        &[$($crate::Identification {
            point: <$points::$point as $crate::Point>::INFO,
            variant: $crate::identifications!(@of $($axis $value)?),
            holds: $crate::identifications!(@holds $kind $held $points::$point),
        }),*]
    };
    (@of) => { None };
    (@of $axis:literal $value:literal) => { Some(($axis, $value)) };
    (@holds Raw $held:literal $point:path) => { $crate::Held::Raw($held) };
    (@holds Text $held:literal $point:path) => { $crate::Held::Text($held, $crate::is_text::<$point>) };
}
