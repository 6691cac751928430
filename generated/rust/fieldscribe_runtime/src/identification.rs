// SPDX-License-Identifier: 0BSD
//! What tells a device, and each of its variants, from others: what its points hold.

/// What a point holds in a device, or in one of its variants; several rows of one point and variant are alternatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identification {
    /// The name of the point.
    pub point: &'static str,
    /// The axis and the value of the variant that it tells; `None` for the device.
    pub variant: Option<(&'static str, &'static str)>,
    /// What the point holds.
    pub holds: Held,
}

/// A raw number, or the text of a point that is a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// A raw number.
    Raw(i128),
    /// A text.
    Text(&'static str),
}

/// The rows of [`Identification`] in the order of reading.
#[macro_export]
#[doc(hidden)]
macro_rules! identifications {
    ($($point:literal $(of $axis:literal $value:literal)? holds $kind:ident $held:literal;)*) => {
        &[$($crate::Identification {
            point: $point,
            variant: $crate::identifications!(@ $($axis $value)?),
            holds: $crate::Held::$kind($held),
        }),*]
    };
    (@) => { None };
    (@ $axis:literal $value:literal) => { Some(($axis, $value)) };
}
