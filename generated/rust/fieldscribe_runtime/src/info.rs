// SPDX-License-Identifier: 0BSD
//! What a table says of points: to list them, or to find one by its name or code at run time.

use crate::Space;

/// What can be done with a point over the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// It is neither read nor written by itself.
    None,
    /// It is read.
    Read,
    /// It is written.
    Write,
    /// It is read and written.
    ReadWrite,
}

impl Access {
    /// Whether the point can be read.
    #[must_use]
    pub const fn reads(self) -> bool {
        matches!(self, Self::Read | Self::ReadWrite)
    }

    /// Whether the point can be written.
    #[must_use]
    pub const fn writes(self) -> bool {
        matches!(self, Self::Write | Self::ReadWrite)
    }
}

/// What a point is called, where it is, and what can be done with it: a row of a crate's `POINTS`.
///
/// What is known before the program runs is better asked of the point's own type.
///
/// ```
/// use fieldscribe_runtime::{point_table, PointInfo};
///
/// mod points {
///     fieldscribe_runtime::point! {
///         /// Base frequency.
///         BaseFrequency: u16 = "base_frequency", "A003";
///         at Holding 0x1019;
///         unit "Hz";
///         decimals 1;
///         => value f64 as scaled(10, 1);
///         read { count i32; }
///     }
/// }
///
/// const POINTS: &[PointInfo] = point_table! { points: BaseFrequency };
///
/// let found = PointInfo::find(POINTS, "a003").unwrap();
/// assert_eq!((found.name, found.address, found.unit), ("base_frequency", 0x1019, "Hz"));
/// assert!(found.access.reads() && !found.access.writes());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct PointInfo {
    /// The name in the description.
    pub name: &'static str,
    /// The manual's own code.
    pub code: Option<&'static str>,
    /// Where the address counts.
    pub space: Space,
    /// The zero-based address on the wire, the lowest if the point has several words.
    pub address: u16,
    /// How many words, or bits of a bit space, the point takes.
    pub words: u16,
    /// The point's bits in a word which it shares with others.
    pub mask: Option<u16>,
    /// The index beside the address.
    pub index: Option<u8>,
    /// The telegram whose words the address counts.
    pub telegram: Option<&'static str>,
    /// The symbol of the value's unit; empty for a plain number.
    pub unit: &'static str,
    /// How many decimals counts have.
    pub decimals: u32,
    /// With how many decimals people see the value, where the description says it.
    pub display_decimals: Option<u32>,
    /// What can be done with it.
    pub access: Access,
}

impl PointInfo {
    /// The point with that name; if there is none, the first with that code of the manual, in capitals or not.
    #[must_use]
    pub fn find<'a>(points: &'a [Self], name_or_code: &str) -> Option<&'a Self> {
        let named = points.iter().find(|point| point.name == name_or_code);
        let coded = |point: &&Self| {
            point
                .code
                .is_some_and(|code| code.eq_ignore_ascii_case(name_or_code))
        };
        named.or_else(|| points.iter().find(coded))
    }
}

/// A slice of what a table says of these points of a module.
#[macro_export]
macro_rules! point_table {
    ($module:ident: $($point:ident)*) => {
        &[$(<$module::$point as $crate::Point>::INFO),*]
    };
}
