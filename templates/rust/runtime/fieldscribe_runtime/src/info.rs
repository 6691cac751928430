// SPDX-License-Identifier: 0BSD
//! Points that are chosen at run time: a crate's table of points, to list them or find one by name or code.

use core::fmt::{self, Write};
use core::marker::PhantomData;
use core::ops::Deref;

use crate::data::PointFacts;
use crate::AnyDevice;

/// The access to a point over the bus.
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
    /// True if the point can be read.
    #[must_use]
    pub const fn reads(self) -> bool {
        matches!(self, Self::Read | Self::ReadWrite)
    }

    /// True if the point can be written.
    #[must_use]
    pub const fn writes(self) -> bool {
        matches!(self, Self::Write | Self::ReadWrite)
    }
}

/// A point of the device `D` as data: its fields and methods are those of its [facts](PointFacts).
///
/// If you know the point when you write the program, use its own type instead. `decode` and `encode` do at run time
/// what those of the type do; `read_point` and `write_point` of a client do it over the bus.
///
/// ```
/// use fieldscribe_runtime::{point_table, Points};
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
/// const POINTS: Points = point_table! { points: BaseFrequency };
///
/// let found = POINTS.find("a003").unwrap();
/// assert_eq!((found.name, found.address, found.unit), ("base_frequency", 0x1019, "Hz"));
/// assert_eq!(found.title().to_string(), "Base frequency");
/// assert!(found.access.reads() && !found.access.writes());
/// assert_eq!(found.decode(500, &[]), Ok(50.0.into()));
/// ```
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct PointInfo<D = AnyDevice> {
    pub(crate) facts: &'static PointFacts,
    device: PhantomData<D>,
}

impl<D> PointInfo<D> {
    /// The point of these facts.
    #[must_use]
    pub const fn new(facts: &'static PointFacts) -> Self {
        let device = PhantomData;
        Self { facts, device }
    }

    /// The same point for a client whose device is chosen at run time.
    #[must_use]
    pub const fn any(self) -> PointInfo {
        PointInfo::new(self.facts)
    }

    /// The points whose raw numbers `decode` needs, in this order.
    #[must_use]
    pub fn needs(self) -> Points<D> {
        Points::new((self.facts.others)().needs)
    }

    /// The points whose raw numbers `encode` and `check` need, in this order.
    #[must_use]
    pub fn write_needs(self) -> Points<D> {
        let none: &[&PointFacts] = &[];
        let writing = self.facts.writing.as_ref();
        Points::new(writing.map_or(none, |writing| (writing.needs)()))
    }

    /// The name in words, with a capital: `Base frequency`.
    #[must_use]
    pub const fn title(self) -> Title {
        Title(self.facts.name)
    }
}

impl<D> Clone for PointInfo<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for PointInfo<D> {}

impl<D> Deref for PointInfo<D> {
    type Target = PointFacts;

    fn deref(&self) -> &PointFacts {
        self.facts
    }
}

/// The name of a point in words; formatting it allocates nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Title(&'static str);

impl fmt::Display for Title {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut is_first = true;
        for letter in self.0.chars() {
            formatter.write_char(match letter {
                '_' => ' ',
                _ if is_first => letter.to_ascii_uppercase(),
                _ => letter,
            })?;
            is_first = false;
        }
        Ok(())
    }
}

/// Points of the device `D`, such as all of a crate: `POINTS`.
#[derive(Debug)]
pub struct Points<D = AnyDevice> {
    rows: &'static [&'static PointFacts],
    device: PhantomData<D>,
}

impl<D> Points<D> {
    /// The points of these facts; [`point_table!`](crate::point_table) makes them of a module's points.
    #[must_use]
    pub const fn new(rows: &'static [&'static PointFacts]) -> Self {
        let device = PhantomData;
        Self { rows, device }
    }

    /// The same points for a client whose device is chosen at run time.
    #[must_use]
    pub const fn any(self) -> Points {
        Points::new(self.rows)
    }

    /// The number of points.
    #[must_use]
    pub const fn len(self) -> usize {
        self.rows.len()
    }

    /// True if there are none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.rows.is_empty()
    }

    /// Each of them, in the order of the description.
    pub fn iter(self) -> impl Iterator<Item = PointInfo<D>> {
        self.rows.iter().map(|row| PointInfo::new(row))
    }

    /// The point with this name, or else the first with this code of the manual, in either case.
    #[must_use]
    pub fn find(self, name_or_code: &str) -> Option<PointInfo<D>> {
        let is_coded = |point: &PointInfo<D>| {
            let code = point.facts.code;
            code.is_some_and(|code| code.eq_ignore_ascii_case(name_or_code))
        };
        let named = self.iter().find(|point| point.facts.name == name_or_code);
        named.or_else(|| self.iter().find(is_coded))
    }
}

impl<D> Clone for Points<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Points<D> {}

/// The points of a module as a table: [`Points`].
#[macro_export]
macro_rules! point_table {
    ($module:ident: $($point:ident)*) => {
        $crate::Points::new(&[$(<$module::$point as $crate::Point>::FACTS),*])
    };
}
